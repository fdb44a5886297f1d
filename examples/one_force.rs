//! The force of one contact, exactly and as a float.
//!
//! The type parameter of `forces` chooses the scalar type, and the query stays the same. Contact forces are in units of
//! f₀ = mg/(3 cosθ), and normal forces at the base in units of mg. Run it with `cargo run --example one_force`.

use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::num_rational::BigRational;
use cannonpile::stacking::Stacking;
use cannonpile::{Error, Pile, ratio};

fn main() -> Result<(), Error> {
    // Six layers of hexagonal close packing under one sphere. The site is (i, j, k), and k = 0 is the top layer.
    let pile = Pile::under(Region::SITE, Stacking::hcp(6)?)?;
    let site = Site::new(0, 0, 2);

    let exact = pile
        .forces::<BigRational>()
        .contact(site, Direction::Alpha)?;
    let float = pile.forces::<f64>().contact(site, Direction::Alpha)?;
    println!("The sphere at {site} transmits {exact} f₀ = {float} f₀ along α.");
    assert_eq!(exact, ratio!(5 / 3));
    assert!((float - 5.0 / 3.0).abs() < 1e-15);
    Ok(())
}
