//! A million contact forces, written layer by layer into slices.
//!
//! This is the fastest way to compute many forces, and it needs the memory of one layer. With the feature `rayon` it
//! uses all cores. Run it with `cargo run --release --features rayon --example million_forces`.

use cannonpile::lattice::Region;
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Error, Pile};

fn main() -> Result<(), Error> {
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

    // The slices now contain the forces on the base. Each sphere above the base has three contacts and adds 3 f₀ to
    // these forces, so their sum equals the number of contacts.
    let sum: f64 = [alpha, beta, gamma].iter().flatten().sum();
    println!("{count} forces; those of the lowest layer add up to {sum} f₀.");
    assert_eq!(format!("{sum:.0}"), count.to_string());
    Ok(())
}
