//! A value survives a round trip through JSON. Any other JSON is read as a valid value or rejected.

use core::fmt::Debug;

use arbitrary::Unstructured;
use cannonpile::lattice::Region;
use cannonpile::scalar::Surd;
use cannonpile::stacking::Stacking;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::{Checked, Failure, same};
use crate::generators::{number, region, stacking};

/// A value survives a round trip.
pub fn reads_back<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T) -> Checked {
    let refuted = |error: serde_json::Error| Failure::Refuted(format!("{error}: {value:?}"));
    let text = serde_json::to_string(value).map_err(refuted)?;
    let read: T = serde_json::from_str(&text).map_err(refuted)?;
    same("the value read back", &read, value)
}

/// Round trips of piles, regions, stackings and roots of every kind.
pub fn any_value(u: &mut Unstructured<'_>) -> Checked {
    reads_back(&region::region(u)?)?;
    let (coefficient, radicand) = number::root(u)?;
    reads_back(&Surd::new(coefficient, radicand)?)?;
    if let Ok(stacking) = Stacking::from_runs(stacking::runs(u)?) {
        reads_back(&stacking)?;
    }
    reads_back(&region::described(u)?.pile()?)
}

/// A valid value with some replaced letters is still valid, or is rejected. A valid pile has all its forces.
pub fn damaged(u: &mut Unstructured<'_>) -> Checked {
    if u.arbitrary()? {
        let whole = region::region(u)?;
        let Some(region) = reads_damaged(u, &whole)? else {
            return Ok(());
        };
        let tight = Region::new(region.x(), region.y(), region.s())?;
        return same("a region", &region, &tight);
    }
    let pile = region::described(u)?.pile()?;
    let Some(pile) = reads_damaged(u, &pile)? else {
        return Ok(());
    };
    // Regions are tight, so every layer has a site.
    for k in [0, pile.layers() - 1] {
        pile.shape().layer(k)?;
    }
    Ok(())
}

/// Reads a value after some letters were replaced. The result survives a round trip too.
pub fn reads_damaged<T: Serialize + DeserializeOwned + PartialEq + Debug>(
    u: &mut Unstructured<'_>,
    whole: &T,
) -> Result<Option<T>, Failure> {
    let text = serde_json::to_string(whole).map_err(|error| Failure::Refuted(error.to_string()))?;
    let mut letters: Vec<char> = text.chars().collect();
    for _ in 0..u.int_in_range(1..=3)? {
        let place = u.choose_index(letters.len())?;
        if let Some(letter) = letters.get_mut(place) {
            *letter = *u.choose(&[
                '0', '1', '2', '9', '-', '+', '/', '.', ',', ':', 'A', 'h', '"', '{',
            ])?;
        }
    }
    let text: String = letters.into_iter().collect();
    let Ok(read) = serde_json::from_str(&text) else {
        return Ok(None);
    };
    reads_back(&read)?;
    Ok(Some(read))
}

#[cfg(test)]
mod injected_faults {
    use super::*;

    /// A number that loses its sign in a round trip.
    #[derive(Debug, PartialEq, serde::Deserialize)]
    struct Careless(i32);

    impl Serialize for Careless {
        fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            serializer.serialize_i32(self.0.abs())
        }
    }

    #[test]
    fn a_lost_sign_is_caught() {
        assert!(reads_back(&Careless(1)).is_ok());
        assert!(reads_back(&Careless(-1)).is_err());
    }
}
