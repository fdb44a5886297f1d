//! Random inputs from plain bytes, biased towards difficult cases.
//!
//! Every generator reads an `Unstructured`. The property tests feed it bytes from proptest, the fuzz targets bytes from
//! libFuzzer. So one description of the inputs serves both, and each can replay a byte string of the other. A generator
//! never fails for lack of bytes: it reads missing bytes as zeros, which select the first choice everywhere. So the first
//! choice is the ordinary case. [`rarely`] draws a rare case, because `ratio` returns true if no bytes are left.
//!
//! | file | contents |
//! |---|---|
//! | `disorder` | piles of random stackings (feature `disorder`) |
//! | `ensemble` | stackings under a top layer, all or samples (feature `disorder`) |
//! | `number` | integers, rationals, floats, sin φ, radii and masses, roots |
//! | `pile` | layers, piles, sites, directions, spacings, packings |
//! | `region` | regions and their bounds, sites about them, small piles with weights and loads |
//! | `scene` | scenes that can be written down; files of them, valid and damaged (feature `dem`) |
//! | `stacking` | signs, runs, stackings as text |
//! | `text` | numbers and sites as text: valid, with their values, and damaged |
//! | `vtk` | files of VTK, of every kind and encoding (feature `dem`) |

use arbitrary::{Result, Unstructured};

#[cfg(feature = "disorder")]
pub mod disorder;
#[cfg(feature = "disorder")]
pub mod ensemble;
pub mod number;
pub mod pile;
pub mod region;
#[cfg(feature = "dem")]
pub mod scene;
pub mod stacking;
pub mod text;
#[cfg(feature = "dem")]
pub mod vtk;

/// Returns true once in `of` draws on average, and false if the bytes are exhausted.
pub fn rarely(u: &mut Unstructured<'_>, of: u8) -> Result<bool> {
    let of = of.max(1);
    Ok(u.int_in_range(1..=of)? == of)
}

/// Replaces, adds or removes up to three characters of `text`, by some of the `intruders`.
pub fn damaged_by(u: &mut Unstructured<'_>, text: &str, intruders: &[char]) -> Result<String> {
    let mut letters: Vec<char> = text.chars().collect();
    for _ in 0..u.int_in_range(1..=3)? {
        let place = u.int_in_range(0..=letters.len())?;
        let intruder = *u.choose(intruders)?;
        match (u.int_in_range(0..=2)?, letters.get_mut(place)) {
            (0, Some(letter)) => *letter = intruder,
            (1, Some(_)) => drop(letters.remove(place)),
            _ => letters.insert(place, intruder),
        }
    }
    Ok(letters.into_iter().collect())
}
