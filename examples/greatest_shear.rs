//! The greatest shear force at the base, with a bound on its rounding error.
//!
//! In the scalar type `Interval` every result contains the exact value. A comparison with `>` is true only if it is
//! certain for the exact values. The width of the result bounds its error.
//!
//! Run it with `cargo run --example greatest_shear`.

use cannonpile::scalar::Interval;
use cannonpile::shape::Selection;
use cannonpile::{Error, Pile, ratio};

fn main() -> Result<(), Error> {
    let pile = Pile::under("hexagon:3".parse()?, "+-+--".parse()?)?;

    let mut greatest = Interval::point(0.0);
    for force in pile.forces::<Interval>().base(Selection::Base)? {
        let force = force?;
        // In units of mg·tanθ and √3·mg·tanθ.
        let (x, y) = (force.shear_x, force.shear_y);
        let square = x * x + y * y * Interval::point(3.0);
        if square > greatest {
            greatest = square;
        }
    }
    println!("The square of the greatest shear force is in {greatest} (mg·tanθ)².");
    println!(
        "It is {} to within {:e}.",
        greatest.midpoint(),
        greatest.width()
    );
    assert!(greatest.contains(&ratio!(21316 / 6561)) && greatest.width() < 1e-14);
    Ok(())
}
