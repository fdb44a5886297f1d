//! Faults that count spheres wrongly or take wrong steps.

use cannonpile::lattice::{Direction, Sign};
use cannonpile::scalar::Ring;
use cannonpile::theorem::Formulas;
use num_traits::{One, Zero};

use super::parts::{Fault, P, RIGHT, faults, over, swapped, twice};

/// L − 1.
fn one_less(l: &P) -> P {
    l.clone() - &P::one()
}

pub(super) fn faults() -> Vec<Fault> {
    faults! {
        "a sphere lies above the apex": above = |i, j, k| {
            let [a, b, c] = (RIGHT.above)(i, j, k);
            [if k.is_zero() { P::one() } else { a }, b, c]
        } => ["counts"];
        "every sphere is above itself": above = |i, j, k| (RIGHT.above)(i, j, k).map(|n| n + &P::one())
            => ["counts", "strengths", "surface", "central-force", "base-normal", "weight", "total-moment",
                "second-moment", "shear-ratio", "discs", "region-counts", "tilt-total", "elastic-energy",
                "settlement"];
        "α for β": above = |i, j, k| swapped(&(RIGHT.above)(i, j, k))
            => ["counts", "rotation", "surface", "action-reaction", "central-force", "shear", "shear-on-axis",
                "discs", "region-counts", "elastic-straight"];
        "k for k−i−j": above = |i, j, k| [k.clone(), i.clone(), j.clone()]
            => ["counts", "rotation", "surface", "central-force", "base-normal", "uniform-base", "weight",
                "shear", "total-shear", "total-moment", "second-moment", "shear-on-axis", "shear-ratio",
                "discs", "region-counts", "tilt-total", "elastic-straight", "elastic-energy", "settlement"];

        "β goes down along j, γ along i": descent = |sign, direction| {
            let [di, dj] = sign.descent(direction);
            [dj, di]
        } => ["counts", "action-reaction", "region-counts", "elastic-straight", "elastic-monotone"];
        "α goes down along j, γ straight": descent = |sign, direction| sign.descent(match direction {
            Direction::Alpha => Direction::Gamma,
            Direction::Beta => Direction::Beta,
            Direction::Gamma => Direction::Alpha,
        }) => ["counts", "action-reaction", "region-counts", "elastic-straight", "elastic-monotone"];
        "α goes down along i": descent = |sign, direction| sign.descent(match direction {
            Direction::Alpha => Direction::Beta,
            other => other,
        }) => ["counts", "action-reaction", "region-counts", "elastic-straight", "elastic-monotone"];
        "two sites at a time": descent = |sign, direction| sign.descent(direction).map(|d| 2 * d)
            => ["counts", "action-reaction", "region-counts", "elastic-straight", "elastic-monotone"];
        "− steps taken as + steps": descent = |_, direction| Sign::Plus.descent(direction)
            => ["region-counts"];
        "+ steps taken as − steps": descent = |_, direction| Sign::Minus.descent(direction)
            => ["counts", "action-reaction", "region-counts", "elastic-straight", "elastic-monotone"];

        "the bottom layer not counted": spheres = |l, d| (RIGHT.spheres)(&one_less(l), d)
            => ["spheres", "contacts", "weight", "discs", "dimensions", "tilt-total"];
        "square pyramids in four dimensions": spheres = |l, d| {
            let right = (RIGHT.spheres)(l, d);
            if d == 4 { right + &(RIGHT.spheres)(&one_less(l), d) } else { right }
        } => ["dimensions"];

        "layers numbered from 1": spheres_in_layer = |k, d| (RIGHT.spheres_in_layer)(&one_less(k), d)
            => ["spheres", "dimensions"];
        "squares for the layers of three dimensions": spheres_in_layer = |k, d| match d {
            3 => k.clone() * k,
            _ => (RIGHT.spheres_in_layer)(k, d),
        } => ["spheres", "dimensions"];
        "five dimensions for six": spheres_in_layer = |k, d| (RIGHT.spheres_in_layer)(k, d.min(5))
            => ["dimensions"];

        "contacts with the floor counted": contacts = |l, d| (RIGHT.spheres)(l, d) * &P::from_integer(d.into())
            => ["contacts", "strengths"];
        "one contact below each sphere": contacts = |l, d| (RIGHT.spheres)(&one_less(l), d)
            => ["contacts", "strengths"];

        "strengths from 0": contacts_of_strength = |l, n, d| {
            (RIGHT.contacts_of_strength)(l, &(n.clone() + &P::one()), d)
        } => ["strengths"];
        "as many strong contacts as weak ones": contacts_of_strength = |l, n, d| {
            (RIGHT.contacts_of_strength)(l, &(l.clone() - n), d)
        } => ["strengths"];
        "half a square for a triangle": contacts_of_strength = |l, n, _| {
            let rest = l.clone() - n;
            over(rest.clone() * &rest, 2)
        } => ["strengths"];

        "lines of α and β swapped": bounds_above = |i, j, lower, upper, m, sign| {
            let [alpha, beta, gamma] = (RIGHT.bounds_above)(i, j, lower, upper, m, sign);
            [beta, alpha, gamma]
        } => ["region-counts", "edge", "elastic-monotone"];
        "an upper bound one site too large": bounds_above = |i, j, lower, upper, m, sign| {
            let wider = upper.each_ref().map(|bound| bound.clone() + &P::one());
            (RIGHT.bounds_above)(i, j, lower, &wider, m, sign)
        } => ["region-counts", "edge"];
        "a lower bound one site too large": bounds_above = |i, j, lower, upper, m, sign| {
            let narrower = lower.each_ref().map(|bound| bound.clone() + &P::one());
            (RIGHT.bounds_above)(i, j, &narrower, upper, m, sign)
        } => ["region-counts", "edge"];
        "every sphere twice": bounds_above = |i, j, lower, upper, m, sign| {
            (RIGHT.bounds_above)(i, j, lower, upper, m, sign).map(|of_line| of_line.each_ref().map(twice))
        } => ["region-counts", "elastic-monotone"];
        "infinite runs": bounds_above = |i, j, lower, upper, m, sign| {
            let mut bounds = (RIGHT.bounds_above)(i, j, lower, upper, m, sign);
            for of_line in &mut bounds {
                of_line[0] = of_line[1].clone();
            }
            bounds
        } => ["region-counts", "elastic-monotone"];
        "curved bounds": bounds_above = |i, j, lower, upper, m, sign| {
            let bend = i.clone() * i + &twice(&(j.clone() * j));
            (RIGHT.bounds_above)(i, j, lower, upper, m, sign).map(|of_line| of_line.map(|bound| bound + &bend))
        } => ["region-counts", "edge", "elastic-monotone", "no-dip"];
        "− steps counted as + steps": bounds_above = |i, j, lower, upper, m, _| {
            (RIGHT.bounds_above)(i, j, lower, upper, m, Sign::Plus)
        } => ["region-counts", "edge", "elastic-monotone"];
    }
}
