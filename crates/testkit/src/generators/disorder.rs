//! Piles of random stackings that are small enough for enumeration, and queries of any size.

use arbitrary::{Result, Unstructured};
use cannonpile::lattice::{MAX_LAYERS, Region};
use cannonpile_disorder::{FirstSign, RandomStackings};
use num_rational::BigRational;

use super::{number, rarely, region};
use crate::disorder::{Anchor, Piles};

fn first(u: &mut Unstructured<'_>) -> Result<FirstSign> {
    let all = [FirstSign::Plus, FirstSign::Minus, FirstSign::Random];
    Ok(*u.choose(&all)?)
}

/// Zero, small, or so large that it fills many words.
pub fn load(u: &mut Unstructured<'_>) -> Result<BigRational> {
    Ok(match u.int_in_range(0..=2)? {
        0 => number::ratio(u.int_in_range(0..=9)?, 1),
        1 => number::ratio(u.int_in_range(0..=99)?, u.int_in_range(1..=99)?),
        _ => number::power(2, u.int_in_range(-70..=130)?),
    })
}

/// Up to five steps on the plane, under a top layer or on a base. The piles have loads if loads are possible.
pub fn piles(u: &mut Unstructured<'_>) -> Result<Piles> {
    let anchor = match u.int_in_range(0..=3)? {
        0 => Anchor::Plane,
        1 => Anchor::Top(Region::SITE),
        2 => Anchor::Top(region::small_region(u)?),
        _ => Anchor::Base(
            region::small_region(u)?
                .dilated_by(
                    if u.arbitrary()? {
                        cannonpile::lattice::Sign::Plus
                    } else {
                        cannonpile::lattice::Sign::Minus
                    },
                    u.int_in_range(0..=3)?,
                )
                .expect("a small region"),
        ),
    };
    let mut piles = Piles {
        anchor,
        steps: u.int_in_range(0..=5)?,
        first: first(u)?,
        weightless: anchor == Anchor::Plane || rarely(u, 3)?,
        loads: Vec::new(),
    };
    let least = usize::from(anchor == Anchor::Plane);
    for _ in 0..u.int_in_range(least..=3)? {
        let site = match anchor {
            Anchor::Plane => [u.int_in_range(-5..=5)?, u.int_in_range(-5..=5)?],
            Anchor::Top(top) => {
                let row = u.choose_index(top.rows(0).count())?;
                let row = top.rows(0).nth(row).expect("a row");
                let i = u.int_in_range(row.i.start..=row.i.end - 1)?;
                [i, row.j].map(|x| i64::try_from(x).expect("a small region"))
            }
            Anchor::Base(_) => break,
        };
        piles.loads.push((site, load(u)?));
    }
    Ok(piles)
}

/// The means of more layers take seconds.
const MAX_DRAWN_LAYERS: i128 = 24;

/// Any number of layers: few, dozens, possibly too many, or the maximum.
pub fn stackings(u: &mut Unstructured<'_>) -> Result<RandomStackings> {
    let layers = match u.int_in_range(0..=4)? {
        0 | 1 => u.int_in_range(1..=8)?,
        2 => u.int_in_range(9..=MAX_DRAWN_LAYERS)?,
        3 => u.int_in_range(2000..=MAX_LAYERS)?,
        _ => MAX_LAYERS - u.int_in_range(0..=3)?,
    };
    Ok(RandomStackings::new(layers, first(u)?).expect("layers within the limit"))
}
