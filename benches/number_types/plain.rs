//! One program for each number type that needs no glue. A check counts their lines: at most five each.

use cannonpile::lattice::{Direction, Site};
use cannonpile::num_rational::{BigRational, Ratio};
use cannonpile::scalar::Plain;
use cannonpile::scalar::promise::{Exact, Rounded};
use cannonpile::{Error, Pile};
use dashu_ratio::RBig;
use fixed::types::I96F32;
use half::{bf16, f16};
use num_dual::Dual64;
use softposit::P32;
use twofloat::TwoFloat;

const SITE: Site = Site { i: 0, j: 0, k: 2 };

pub fn half_precision(pile: &Pile) -> Result<f16, Error> {
    let forces = pile.forces::<Plain<f16, Rounded>>();
    Ok(forces.contact(SITE, Direction::Alpha)?.0)
}

pub fn brain_float(pile: &Pile) -> Result<bf16, Error> {
    let forces = pile.forces::<Plain<bf16, Rounded>>();
    Ok(forces.contact(SITE, Direction::Alpha)?.0)
}

pub fn single(pile: &Pile) -> Result<f32, Error> {
    pile.forces::<f32>().contact(SITE, Direction::Alpha)
}

pub fn double(pile: &Pile) -> Result<f64, Error> {
    pile.forces::<f64>().contact(SITE, Direction::Alpha)
}

pub fn two_floats(pile: &Pile) -> Result<TwoFloat, Error> {
    let forces = pile.forces::<Plain<TwoFloat>>();
    Ok(forces.contact(SITE, Direction::Alpha)?.0)
}

pub fn posit(pile: &Pile) -> Result<P32, Error> {
    let forces = pile.forces::<Plain<P32>>();
    Ok(forces.contact(SITE, Direction::Alpha)?.0)
}

pub fn fixed_point(pile: &Pile) -> Result<I96F32, Error> {
    let forces = pile.forces::<Plain<I96F32>>();
    Ok(forces.contact(SITE, Direction::Alpha)?.0)
}

/// The force under a load p on the apex, and its derivative by p at p = 1.
pub fn derivative(pile: &Pile) -> Result<Dual64, Error> {
    let load = Plain::from(Dual64::new(1.0, 1.0));
    let forces = pile.forces::<Plain<Dual64>>().with_load(Site::APEX, load)?;
    Ok(forces.contact(SITE, Direction::Alpha)?.0)
}

pub fn rational_of_dashu(pile: &Pile) -> Result<RBig, Error> {
    let forces = pile.forces::<Plain<RBig, Exact>>();
    Ok(forces.contact(SITE, Direction::Alpha)?.0)
}

pub fn rational_of_num(pile: &Pile) -> Result<BigRational, Error> {
    pile.forces::<BigRational>().contact(SITE, Direction::Alpha)
}

/// Refused: the integers of the ratio may wrap.
pub fn ratio_of_words(pile: &Pile) -> Result<Ratio<i64>, Error> {
    let forces = pile.forces::<Plain<Ratio<i64>>>();
    Ok(forces.contact(SITE, Direction::Alpha)?.0)
}
