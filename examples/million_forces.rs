//! A million contact forces, each the float nearest to the exact one, written into slices of one's own; and those of a
//! pile that is not straight, layer by layer. `cargo run --release --example million_forces`

use std::time::Instant;

use cannonpile::lattice::{Direction, Region};
use cannonpile::scalar::Surd;
use cannonpile::scalar::parse;
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Error, Packing, Pile};
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
    let layers = packing.layers::<f64>(Selection::All)?;
    let spheres = layers.slice_len()?;
    let mut forces = [(); 3].map(|()| vec![0.0; spheres]);
    let start = Instant::now();
    layers.fill(forces.each_mut().map(Vec::as_mut_slice))?;
    report("straight, in newtons", 3 * spheres, start);
    assert_eq!(3 * spheres, 1_000_125);

    // Row after row, as the sites of the pile.
    for (n, site) in pile
        .shape()
        .sites()
        .take(spheres)
        .enumerate()
        .step_by(150_000)
    {
        for direction in Direction::ALL {
            let exact = packing.contact(site, direction)?;
            let force = forces[direction.index()][n];
            assert_eq!(exact.nearest(), Some(force));
            println!("  below {site} along {direction:5}  {exact} N = {force} N");
        }
    }
    Ok(())
}

/// Layers under a hexagon, + and − in turn: the forces change everywhere, and are swept down layer by layer.
fn mixed() -> Result<(), Error> {
    let pile = Pile::under(Region::hexagon(70, 70)?, Stacking::hcp(24)?)?;
    let start = Instant::now();
    let (mut layers, mut filled) = (pile.forces::<f64>().layers(Selection::All)?, 0);
    let mut slices = [(); 3].map(|()| Vec::new());
    while let Some(layer) = layers.next_layer()? {
        if layer.is_floor() {
            break;
        }
        for slice in &mut slices {
            slice.resize(layer.sphere_count(), 0.0);
        }
        layer.fill(slices.each_mut().map(Vec::as_mut_slice))?;
        filled += 3 * layer.sphere_count();
    }
    report("24 layers of hcp, in mg/(3 cosθ)", filled, start);

    // The lowest contacts bear all that lies above the floor: an increment is a third of a sphere.
    let sum: f64 = slices.iter().flatten().sum();
    let above = pile.weight() - BigRational::from_integer(pile.base_sphere_count().into());
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
