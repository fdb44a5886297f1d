//! The first layers of a pile as a pile of their own, and certificates about them.

use std::collections::BTreeMap;

use cannonpile::Pile;
use cannonpile::shape::Anchor;
use cannonpile::stacking::{Run, Stacking};

use crate::certificate::{Certificate, Claim};
use crate::network::MAX_CERTIFIED;

/// Returns the pile itself if a certificate for all its spheres is small enough, and its layers 0 … `floor`
/// otherwise.
pub(crate) fn certified_down_to(pile: &Pile, floor: i128) -> Result<Pile, cannonpile::Error> {
    if pile.sphere_count() <= MAX_CERTIFIED.into() {
        Ok(pile.clone())
    } else {
        beginning(pile, floor)
    }
}

/// Returns layers 0 … `floor` as a pile, with the weights and loads of their spheres.
pub(crate) fn beginning(pile: &Pile, floor: i128) -> Result<Pile, cannonpile::Error> {
    let shape = pile.shape();
    let mut left = floor;
    let runs = shape.stacking().runs().map_while(|run| {
        let steps = run.steps.min(left);
        left -= steps;
        (steps > 0).then_some(Run { steps, ..run })
    });
    let stacking = Stacking::from_runs(runs)?;
    let mut first = match shape.anchor() {
        Anchor::Top(top) => Pile::under(top, stacking)?,
        Anchor::Base(_) => Pile::on(shape.layer(floor)?, stacking)?,
    };
    if pile.is_weightless() {
        first = first.weightless();
    }
    first = first.with_tilt(pile.tilt().clone())?;
    for (site, weight) in pile.weights().filter(|(site, _)| site.k <= floor) {
        first = first.with_weight(site, weight.clone())?;
    }
    for (site, load) in pile.loads().filter(|(site, _)| site.k <= floor) {
        first = first.with_load(site, load.clone())?;
    }
    Ok(first)
}

/// Returns a certificate with the given claim, without horizontal forces and without a field.
pub(crate) fn certified(pile: Pile, claim: Claim) -> Certificate {
    Certificate {
        pile,
        claim,
        horizontal: BTreeMap::new(),
        field: BTreeMap::new(),
    }
}
