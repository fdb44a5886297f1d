//! A million contact forces, each the float nearest to the exact one, written into a slice of one's own; and those of a
//! pile that is not straight, layer by layer. `cargo run --release --example million_forces`

use std::time::Instant;

use cannonpile::lattice::{Direction, Region};
use cannonpile::scalar::Surd;
use cannonpile::scene::parse;
use cannonpile::stacking::Stacking;
use cannonpile::{Error, Packing, Pile, Strengths};
use num_rational::BigRational;

fn main() -> Result<(), Error> {
    straight()?;
    mixed()
}

/// The cannonball stack: 126 layers have 125 distinct forces. They are rounded once, the rest is filling.
fn straight() -> Result<(), Error> {
    let pile = Pile::triangular(126)?;
    // Steel balls of 1 cm, on the moon.
    let packing = Packing::new(&pile, &"1.2".parse()?)?
        .with_radius(parse::rational("0.01")?)?
        .with_mass(parse::rational("0.033")?)?
        .with_gravity(parse::rational("1.62")?)?;
    let strengths = Strengths::<f64>::nearest(&packing)?;
    let mut forces = vec![[0.0; 3]; strengths.spheres()?];
    let start = Instant::now();
    strengths.fill_interleaved(&mut forces)?;
    report("straight, in newtons", 3 * forces.len(), start);
    assert_eq!(3 * forces.len(), 1_000_125);

    // Row after row, as the sites of the pile.
    for (site, forces) in pile.shape().sites().zip(&forces).step_by(150_000) {
        for (direction, force) in Direction::ALL.into_iter().zip(forces) {
            let exact = packing.contact(site, direction)?;
            assert_eq!(exact.nearest(), Some(*force));
            println!("  below {site} along {direction:5}  {exact} N = {force} N");
        }
    }
    Ok(())
}

/// Layers under a hexagon, + and − in turn: the forces change everywhere, and are swept down layer by layer.
fn mixed() -> Result<(), Error> {
    let pile = Pile::under(Region::hexagon(70, 70)?, Stacking::hcp(24)?)?;
    let start = Instant::now();
    let (mut sweep, mut filled) = (pile.sweep::<f64>()?, 0);
    let mut slices = [(); 3].map(|()| Vec::new());
    for k in 0..pile.layers() - 1 {
        sweep.advance(k)?;
        let spheres = sweep.spheres()?;
        let [alpha, beta, gamma] = slices.each_mut().map(|slice| {
            slice.resize(spheres, 0.0);
            slice.as_mut_slice()
        });
        sweep.fill([alpha, beta, gamma])?;
        filled += 3 * spheres;
    }
    report("24 layers of hcp, in mg/(3 cosθ)", filled, start);

    // The lowest contacts bear all that lies above the floor: an increment is a third of a sphere.
    let sum: f64 = slices.iter().flatten().sum();
    let above = pile.weight() - BigRational::from_integer(pile.base_spheres().into());
    let weight = Surd::from(&above * BigRational::from_integer(3.into())).nearest::<f64>();
    println!(
        "  The lowest ones sum to {sum}; the {above} spheres above weigh a third of that in mg."
    );
    assert!(weight.is_some_and(|weight| (sum - weight).abs() < 1e-9 * weight));
    Ok(())
}

fn report(what: &str, forces: usize, start: Instant) {
    let nanoseconds = start.elapsed().as_nanos().max(1);
    let pace = forces as u128 * 1_000_000_000 / nanoseconds;
    println!("{forces} forces, {what}: {pace} a second");
}
