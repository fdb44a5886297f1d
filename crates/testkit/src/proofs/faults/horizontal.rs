//! Faults in the transmission of horizontal forces.

use cannonpile::theorem::Formulas;
use num_traits::Zero;

use super::parts::{Fault, P, RIGHT, faults, twice};

pub(super) fn faults() -> Vec<Fault> {
    faults! {
        "tension instead of compression": pushed = |force, ends, leads_away| (RIGHT.pushed)(force, ends, !leads_away) => [
                "horizontal-balance", "virtual-work", "corner-greatest", "arch", "run-horizontal"];
        "squares": pushed = |force, ends, leads_away| {
            (RIGHT.pushed)(force, ends, leads_away).map(|x| x.clone() * &x)
        } => ["horizontal-balance", "virtual-work", "corner-greatest", "arch", "run-horizontal"];
        "the force added to all lines": pushed = |force, ends, leads_away| {
            (RIGHT.pushed)(force, ends, leads_away).map(|x| twice(&x) + force)
        } => ["horizontal-balance", "virtual-work", "corner-greatest", "arch", "run-horizontal"];

        "no horizontal contacts": beside = |received, own, _, _| received + own => ["horizontal-balance",
                "virtual-work", "corner-greatest", "arch", "run-horizontal"];
        "under − as under +": beside = |received, own, pushed, _| received + own - pushed => ["horizontal-balance",
                "virtual-work", "run-horizontal"];
        "weightless spheres": beside = |received, _, pushed, sign| {
            (RIGHT.beside)(received, &P::zero(), pushed, sign)
        } => ["horizontal-balance", "virtual-work", "corner-greatest", "arch", "run-horizontal"];
        "the forces from above left out": beside = |_, own, pushed, sign| {
            (RIGHT.beside)(P::zero(), own, pushed, sign)
        } => ["horizontal-balance", "virtual-work", "corner-greatest", "arch", "run-horizontal"];
        "squares": beside = |received, own, pushed, sign| {
            (RIGHT.beside)(received.clone() * &received, own, pushed, sign)
        } => ["horizontal-balance", "virtual-work", "corner-greatest", "arch", "run-horizontal"];
    }
}
