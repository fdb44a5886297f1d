//! Which key may have been meant.

/// The longest word that is compared, in characters; no key has half as many.
const LONGEST: usize = 32;

/// The key that takes the fewest changes to reach, if they are few: one, or at most a third of the word.
///
/// A change is a character more, less or replaced, or two neighbours swapped; capitals, `_` and spaces cost nothing.
pub(in crate::scene) fn nearest(given: &str, known: &[&'static str]) -> Option<&'static str> {
    if given.chars().nth(LONGEST).is_some() {
        return None;
    }
    let given: String = given.chars().map(plain).collect();
    let distances = known.iter().map(|key| {
        (
            strsim::osa_distance(&given, &key.to_ascii_lowercase()),
            *key,
        )
    });
    let (changes, key) = distances.min_by_key(|(changes, _)| *changes)?;
    let few = (given.chars().count().max(key.len()) / 3).max(1);
    (changes <= few).then_some(key)
}

fn plain(c: char) -> char {
    match c {
        '_' | ' ' => '-',
        c => c.to_ascii_lowercase(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_recognised_and_other_words_are_not() {
        let known = ["layers", "stacking", "sin-phi", "load", "mass", "at"];
        for (given, meant) in [
            ("layer", Some("layers")),
            ("Layers", Some("layers")),
            ("sin_phi", Some("sin-phi")),
            ("sinphi", Some("sin-phi")),
            ("staking", Some("stacking")),
            ("loads", Some("load")),
            ("colour", None),
            ("", None),
            ("a key that goes on for much longer than any", None),
        ] {
            assert_eq!(nearest(given, &known), meant, "{given}");
        }
    }
}
