//! A million contact forces, correctly rounded, written into caller-provided slices. A second pile with sign changes is
//! computed layer by layer. Run it with `cargo run --release --example million_forces`.

use cannonpile::lattice::Region;
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Error, Pile};

fn main() -> Result<(), Error> {
    straight()?;
    mixed()
}

/// The straight pile: 126 layers have 125 distinct forces. Each is rounded once and copied to its contacts.
fn straight() -> Result<(), Error> {
    let pile = Pile::triangular(126)?;
    // Steel balls with a radius of 1 cm, on the moon.
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

    // The slices have the order of the sites, row by row.
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

/// HCP layers under a hexagon: the sweep computes the forces layer by layer.
fn mixed() -> Result<(), Error> {
    let pile = Pile::under(Region::hexagon(70, 70)?, Stacking::hcp(24)?)?;

    let mut count = 0;
    let [mut alpha, mut beta, mut gamma] = [vec![], vec![], vec![]];
    let mut layers = pile.forces::<f64>().layers(Selection::All)?;
    while let Some(layer) = layers.next_layer()? {
        if layer.is_floor() {
            break;
        }
        for forces in [&mut alpha, &mut beta, &mut gamma] {
            forces.resize(layer.sphere_count(), 0.0);
        }
        layer.fill([&mut alpha, &mut beta, &mut gamma])?;
        count += 3 * layer.sphere_count();
    }

    // The lowest contacts carry the weight of all spheres above the floor, in units of a third of mg.
    let sum: f64 = slices.iter().flatten().sum();
    let above = pile.weight() - BigRational::from_integer(pile.base_sphere_count().into());
    let weight = Surd::from(&above * BigRational::from_integer(3.into())).nearest::<f64>();
    println!(
        "  The forces of the lowest contacts sum to {sum}, three times the number of spheres above, {above}."
    );
    assert!(weight.is_some_and(|weight| (sum - weight).abs() < 1e-9 * weight));
    Ok(())
}
