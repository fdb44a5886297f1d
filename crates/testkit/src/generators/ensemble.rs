//! Ensembles of stackings under one top layer or on one base, small enough to examine every contact, and the choice of stackings.

use arbitrary::{Result, Unstructured};
use cannonpile::lattice::Region;
use cannonpile::shape::Anchor;
use cannonpile_disorder::{Choice, FirstSign, Samples};
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::{number, rarely, region};
use crate::tally::{Scene, all_signs};

/// A top layer with or without loads, or a base, with or without weight, and the number of steps.
pub fn scene(u: &mut Unstructured<'_>) -> Result<(Scene, u32)> {
    let (scene, most) = if rarely(u, 3)? {
        on_base(u)?
    } else {
        under_top(u)?
    };
    Ok((scene, u.int_in_range(0..=most)?))
}

/// A base, and the greatest number of steps for which it supports a stacking.
fn on_base(u: &mut Unstructured<'_>) -> Result<(Scene, u32)> {
    let scene = Scene {
        anchor: Anchor::Base(region::small_region(u)?),
        weightless: rarely(u, 3)?,
        first: first(u)?,
        width: number::ratio(u.int_in_range(1..=40)?, u.int_in_range(1..=40)?),
        loads: Vec::new(),
    };
    let is_supported = |steps: &u32| {
        let stackings = all_signs(*steps, scene.first);
        stackings.iter().any(|signs| scene.pile(signs).is_ok())
    };
    let most = (0..=5).take_while(is_supported).last();
    Ok((scene, most.expect("the base alone is a pile")))
}

fn first(u: &mut Unstructured<'_>) -> Result<FirstSign> {
    let firsts = [FirstSign::Plus, FirstSign::Minus, FirstSign::Random];
    u.choose(&firsts).copied()
}

/// A top layer with or without loads and weight, and the greatest number of steps below it.
fn under_top(u: &mut Unstructured<'_>) -> Result<(Scene, u32)> {
    let (top, most) = if u.arbitrary()? {
        (Region::SITE, 5)
    } else {
        (region::small_region(u)?, 3)
    };
    let mut loads = Vec::new();
    for _ in 0..u.int_in_range(0..=3)? {
        let row = u.choose_index(top.rows(0).count())?;
        let row = top.rows(0).nth(row).expect("a row");
        let i = u.int_in_range(row.i.start..=row.i.end - 1)?;
        let load = match u.int_in_range(0..=2)? {
            0 => number::ratio(u.int_in_range(0..=9)?, 1),
            1 => number::ratio(u.int_in_range(0..=99)?, u.int_in_range(1..=99)?),
            _ => number::power(2, u.int_in_range(-70..=130)?),
        };
        loads.push(([i, row.j], load));
    }
    // The width gives dozens of bins, at most thousands.
    let greatest = loads.iter().map(|(_, load)| load.clone());
    let greatest = greatest.fold(BigRational::one(), BigRational::max);
    let part = number::ratio(u.int_in_range(1..=40)?, u.int_in_range(1..=40)?);
    let scene = Scene {
        anchor: Anchor::Top(top),
        loads,
        weightless: rarely(u, 3)?,
        first: first(u)?,
        width: greatest * part,
    };
    Ok((scene, most))
}

/// All stackings, or some samples.
pub fn choice(u: &mut Unstructured<'_>) -> Result<Choice> {
    if u.arbitrary()? {
        return Ok(Choice::All);
    }
    let of = u.int_in_range(1..=u32::MAX)?;
    let q = match u.int_in_range(0..=3)? {
        0 => BigRational::zero(),
        1 => BigRational::one(),
        _ => number::ratio(u.int_in_range(0..=of)?.into(), of.into()),
    };
    let samples = Samples::new(u.int_in_range(1..=12)?, u.arbitrary()?, q);
    Ok(Choice::Drawn(samples.expect("some samples")))
}
