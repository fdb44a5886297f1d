//! Forces in newtons and positions in metres.
//!
//! A `Packing` gives a pile its spacing, radius, mass and gravity. Its answers are exact numbers c·√n, and each converts
//! to a correctly rounded float. Run it with `cargo run --example newtons`.

use cannonpile::lattice::{Direction, Site};
use cannonpile::{Error, Packing, Pile, ratio};

fn main() -> Result<(), Error> {
    // Steel balls with a radius of 1 cm. Neighbours of a layer are 2a = 2.4 cm apart.
    let pile = Pile::triangular(10)?;
    let packing = Packing::new(&pile, &"1.2".parse()?)?
        .with_radius(ratio!(1 / 100))?
        .with_mass(ratio!(33 / 1000))?
        .with_gravity(ratio!(981 / 100))?;

    let force = packing.contact(Site::new(1, 2, 5), Direction::Alpha)?;
    println!("contact force  {force} N = {} N", force.to_f64());
    let [.., height] = packing.position(Site::APEX)?;
    println!("height of apex {height} m = {} m", height.to_f64());
    let normal = packing.on_floor(Site::new(1, 2, 9))?.normal;
    println!("normal force   {normal} N");

    assert_eq!(force.to_string(), "32373/260000*sqrt(13)");
    assert_eq!(height.nearest(), Some(0.129_799_845_916_703_63));
    assert_eq!(normal.to_string(), "32373/25000");
    Ok(())
}
