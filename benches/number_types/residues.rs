//! An identity of many layers, in words.

use cannonpile::lattice::Region;
use cannonpile::num_traits::ToPrimitive;
use cannonpile::scalar::Ring;
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Error, Pile};

use crate::error::below;
use crate::newtypes::residue::Residue;

/// Checks that the contact forces below the last but one layer of HCP bear the weight above them and loads on the top.
///
/// A contact force of 1 f₀ bears mg/3. The loads are residues at random, so that no load is special. The page states what
/// this proves.
pub fn identity(layers: i128) -> Result<(), Error> {
    let pile = Pile::under(Region::hexagon(4, 4)?, Stacking::hcp(layers)?)?;
    let mut random: u64 = 1998;
    let mut residue = || {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        Residue::from_integer(random.into())
    };
    let top = pile.sites(Selection::Layer(0))?;
    let loads: Vec<_> = top.map(|site| (site, residue())).collect();
    let spheres = pile.sphere_count() - pile.base_sphere_count();
    let spheres = Residue::from_integer(spheres.to_i128().expect("a pile that fits in memory"));
    let weight = loads.iter().fold(spheres, |sum, (_, load)| sum + load);

    let loads = loads.into_iter().map(|(site, load)| (site, load.into()));
    let forces = pile.forces::<Residue>().with_loads(loads)?;
    let forces = below(&forces, layers - 2)?;
    let sum = forces
        .iter()
        .fold(Residue::from_integer(0), |sum, force| sum + force);
    assert_eq!(sum, weight * Residue::from_integer(3), "forces and weight");
    Ok(())
}
