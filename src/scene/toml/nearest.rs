//! Which key may have been meant.

use alloc::vec::Vec;

/// The longest word that is compared, in characters; no key has half as many.
const LONGEST: usize = 32;

/// The key that takes the fewest changes to reach, if they are few: one, or at most a third of the word.
///
/// A change is a character more, less or replaced, or two neighbours swapped; capitals, `_` and spaces cost nothing.
pub(super) fn nearest(given: &str, known: &[&'static str]) -> Option<&'static str> {
    let given: Vec<char> = given.chars().take(LONGEST + 1).map(plain).collect();
    if given.len() > LONGEST {
        return None;
    }
    let distances = known.iter().map(|key| {
        let key_chars: Vec<char> = key.chars().collect();
        (distance(&given, &key_chars), *key)
    });
    let (changes, key) = distances.min_by_key(|(changes, _)| *changes)?;
    let few = (given.len().max(key.len()) / 3).max(1);
    (changes <= few).then_some(key)
}

fn plain(c: char) -> char {
    match c {
        '_' | ' ' => '-',
        c => c.to_ascii_lowercase(),
    }
}

/// The number of changes: the Damerau–Levenshtein distance, with no character changed twice.
fn distance(a: &[char], b: &[char]) -> usize {
    // Rows of the table of distances of beginnings: two above, above, and this one.
    let mut above: Vec<usize> = (0..=b.len()).collect();
    let mut two_above: Vec<usize> = Vec::new();
    let mut last_a = None;
    for (n, &from) in a.iter().enumerate() {
        let mut row = Vec::with_capacity(above.len());
        row.push(n + 1);
        let mut last_b = None;
        let columns = b.iter().zip(above.iter().zip(above.iter().skip(1)));
        for (m, (&to, (&diagonal, &up))) in columns.enumerate() {
            let left = row.last().copied().unwrap_or(n);
            let mut changes = (diagonal + usize::from(from != to))
                .min(up + 1)
                .min(left + 1);
            if last_a == Some(to) && last_b == Some(from) {
                let before = m.checked_sub(1).and_then(|column| two_above.get(column));
                changes = before.map_or(changes, |before| changes.min(before + 1));
            }
            row.push(changes);
            last_b = Some(to);
        }
        two_above = core::mem::replace(&mut above, row);
        last_a = Some(from);
    }
    above.last().copied().unwrap_or(a.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn between(a: &str, b: &str) -> usize {
        let chars = |text: &str| text.chars().collect::<Vec<_>>();
        distance(&chars(a), &chars(b))
    }

    #[test]
    fn distances() {
        for (a, b, changes) in [
            ("", "", 0),
            ("", "abc", 3),
            ("mass", "mass", 0),
            ("kitten", "sitting", 3),
            ("spcaing", "spacing", 1),
            ("spcaign", "spacing", 2),
            ("ca", "abc", 3),
            ("load", "laod", 1),
        ] {
            assert_eq!(between(a, b), changes, "{a} {b}");
            assert_eq!(between(b, a), changes, "{b} {a}");
        }
    }

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
