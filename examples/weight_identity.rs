//! The floor carries the weight of the pile: exactly for 10³⁶ layers, and force by force for 2,000.
//!
//! Run it with `cargo run --release --example weight_identity`.

use cannonpile::num_rational::BigRational;
use cannonpile::shape::Selection;
use cannonpile::{Error, Pile};

fn main() -> Result<(), Error> {
    // The sum of about 5·10⁷¹ forces, in closed form and without rounding.
    let huge = Pile::triangular(10_i128.pow(36))?;
    let [normal, shear_x, shear_y] = huge.forces::<BigRational>().sum_on_floor(Selection::Base)?;
    assert_eq!(normal, huge.weight());
    assert_eq!(
        [shear_x, shear_y],
        [0, 0].map(|zero| BigRational::from_integer(zero.into()))
    );

    // 2,001,000 forces one by one, exact and in f64.
    let pile = Pile::triangular(2000)?;
    let mut sum = BigRational::from_integer(0.into());
    for force in pile.forces::<BigRational>().base(Selection::Base)? {
        sum += force?.normal;
    }
    assert_eq!(sum, pile.weight());
    let mut float = 0.0;
    for force in pile.forces::<f64>().base(Selection::Base)? {
        float += force?.normal;
    }
    let weight = 1_335_334_000.0;
    assert_eq!(sum, BigRational::from_integer(1_335_334_000.into()));
    let error = (float - weight) / weight;
    println!("the sum of 2,001,000 floats is off by {error:.1e} of the weight");
    assert!(error.abs() < 1e-9);
    Ok(())
}
