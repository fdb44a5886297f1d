//! Faults in the increments of loads of any direction.

use cannonpile::Load;
use cannonpile::lattice::Sign;
use cannonpile::theorem::Formulas;
use num_traits::{One, Zero};

use super::parts::{Fault, P, RIGHT, faults, over, swapped, twice};

/// The load with changed components.
fn changed(load: &Load<P>, change: impl FnOnce(&mut Load<P>)) -> Load<P> {
    let mut load = load.clone();
    change(&mut load);
    load
}

pub(super) fn faults() -> Vec<Fault> {
    faults! {
        "X reversed": load_increments = |load, s, sign| {
            (RIGHT.load_increments)(&changed(load, |load| load.x = -load.x.clone()), s, sign)
        } => ["load", "tilt", "tilt-total"];
        "twice X": load_increments = |load, s, sign| {
            (RIGHT.load_increments)(&changed(load, |load| load.x = twice(&load.x)), s, sign)
        } => ["load", "tilt", "tilt-total"];
        "Y reversed": load_increments = |load, s, sign| swapped(&(RIGHT.load_increments)(load, s, sign)) => [
                "load", "tilt", "tilt-total"];
        "Y with the factor 2 whatever s": load_increments = |load, s, sign| {
            let [a, b, _] = (RIGHT.load_increments)(load, &P::zero(), sign);
            let [.., c] = (RIGHT.load_increments)(load, s, sign);
            [a, b, c]
        } => ["load", "tilt", "tilt-total"];
        "X and Y left out": load_increments = |load, s, sign| {
            (RIGHT.load_increments)(&load.down.clone().into(), s, sign)
        } => ["load", "tilt", "tilt-total"];
        "weightless spheres": load_increments = |load, s, sign| {
            (RIGHT.load_increments)(&changed(load, |load| load.down = P::zero()), s, sign)
        } => ["load", "tilt", "tilt-total"];
        "under − as under +": load_increments = |load, s, _| (RIGHT.load_increments)(load, s, Sign::Plus) =>
                ["load", "mean-closure"];
        "the signs interchanged": load_increments = |load, s, sign| {
            (RIGHT.load_increments)(load, s, sign.opposite())
        } => ["load", "tilt", "tilt-total"];
        "φ = π/6 whatever s": load_increments = |load, _, sign| {
            (RIGHT.load_increments)(load, &over(P::one(), 2), sign)
        } => ["load", "tilt", "tilt-total"];

        "X reversed": disc_load_increments = |load, sign| swapped(&(RIGHT.disc_load_increments)(load, sign)) => [
                "load", "tilt"];
        "X left out": disc_load_increments = |load, sign| {
            (RIGHT.disc_load_increments)(&load.down.clone().into(), sign)
        } => ["load", "tilt"];
        "twice the load": disc_load_increments = |load, sign| {
            (RIGHT.disc_load_increments)(load, sign).each_ref().map(twice)
        } => ["load", "tilt"];
        "under − as under +": disc_load_increments = |load, _| (RIGHT.disc_load_increments)(load, Sign::Plus) =>
                ["load"];
        "a third contact": disc_load_increments = |load, sign| {
            let [a, b, _] = (RIGHT.disc_load_increments)(load, sign);
            [a, b, load.down.clone() + &load.x]
        } => ["load"];
    }
}
