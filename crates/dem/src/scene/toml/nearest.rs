//! Suggestions for misspelt keys.

/// The maximal length of a compared word, in characters. No key is half as long.
const LONGEST: usize = 32;

/// Returns the key with the fewest edits from `given`, if they are few: one edit, or at most a third of the word.
///
/// An edit inserts, deletes or replaces a character, or swaps two adjacent ones. Capitals, `_` and spaces cost nothing.
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
    fn suggests_keys_for_misspelt_words_only() {
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
