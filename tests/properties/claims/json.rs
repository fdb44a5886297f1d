//! What is written as JSON is read back the same, and any JSON is read as something valid or refused.

use core::fmt::Debug;

use arbitrary::Unstructured;
use cannonpile::Pile;
use cannonpile::lattice::Region;
use cannonpile::scalar::Surd;
use cannonpile::scene::Scene;
use cannonpile::stacking::Stacking;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::{Checked, Failure, same};
use crate::generators::{number, region, stacking};

/// A value comes back.
fn reads_back<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T) -> Checked {
    let refuted = |error: serde_json::Error| Failure::Refuted(format!("{error}: {value:?}"));
    let text = serde_json::to_string(value).map_err(refuted)?;
    let read: T = serde_json::from_str(&text).map_err(refuted)?;
    same("what was read back", &read, value)
}

/// Piles, regions, stackings and roots of every kind.
pub(crate) fn any_value(u: &mut Unstructured<'_>) -> Checked {
    reads_back(&region::region(u)?)?;
    let (coefficient, radicand) = number::root(u)?;
    reads_back(&Surd::new(coefficient, radicand)?)?;
    if let Ok(stacking) = Stacking::from_runs(stacking::runs(u)?) {
        reads_back(&stacking)?;
    }
    reads_back(&region::described(u)?.pile()?)
}

/// A valid pile with some letters exchanged is a valid pile or none: every force of it can be asked for.
pub(crate) fn damaged(u: &mut Unstructured<'_>) -> Checked {
    let pile = region::described(u)?.pile()?;
    let text = serde_json::to_string(&pile).map_err(|error| Failure::Refuted(error.to_string()))?;
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
    if let Ok(pile) = serde_json::from_str::<Pile>(&text) {
        reads_back(&pile)?;
        // Shapes are tight: every layer has a site.
        for k in [0, pile.layers() - 1] {
            pile.shape().layer(k)?;
        }
    }
    let _ = serde_json::from_str::<Scene>(&text);
    let _ = serde_json::from_str::<Region>(&text);
    Ok(())
}

/// A scene, whatever it says.
#[cfg(feature = "toml")]
pub(crate) fn any_scene(u: &mut Unstructured<'_>) -> Checked {
    reads_back(&crate::generators::scene::scene(u)?)
}

#[cfg(test)]
mod planted {
    use super::*;

    /// Comes back with its sign lost.
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
