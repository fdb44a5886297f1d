//! One formula in several scalars: the force of a sphere on the floor as a fraction, a fraction of fixed width, a float, a
//! double-double, an interval, and a polynomial that covers every pile.
//!
//! The formula is written once, generic over the scalar type. The scalar determines the accuracy of the result.
//! Run it with `cargo run --example five_scalars`.

use core::array;

use cannonpile::formula::{force, increments, support_load, weight};
use cannonpile::geometry::directions;
use cannonpile::lattice::{Site, count};
use cannonpile::scalar::{Algebra, DoubleDouble, FixedRational, Interval, Polynomial, Symbol};
use cannonpile::{Error, Pile};
use num_rational::BigRational;
use num_traits::Signed;

/// Returns the vertical force of sphere (i, j) of layer k on the layer below, in mg/(2(1+s)). It includes the sphere's
/// own weight.
///
/// s = sin φ is the sine of the angle of the base triangle.
fn carried<T: Algebra>([i, j, k, s]: [T; 4]) -> T {
    let (above, own) = (count::above(&i, &j, &k), increments(&s));
    let received = array::from_fn(|line| force(above[line].clone(), &own[line]));
    support_load(&received, &directions(&s), &weight(&own)).z
}

/// Evaluates the formula at these numbers in the scalar `T`.
fn answer<T: Algebra>(numbers: &[BigRational; 4]) -> T {
    carried(numbers.each_ref().map(T::from_rational))
}

fn main() -> Result<(), Error> {
    // Sphere (4, 1) of layer 9, on a base with sin φ = 1/3, which f64 cannot represent exactly.
    let ratio = |n: i64, d: i64| BigRational::new(n.into(), d.into());
    let numbers = [ratio(4, 1), ratio(1, 1), ratio(9, 1), ratio(1, 3)];

    let exact: BigRational = answer(&numbers);
    println!("a fraction of any size   {exact}");

    let fixed: FixedRational<i64> = answer(&numbers);
    println!("a fraction of 64 bits    {fixed} (an overflow would be reported)");
    assert_eq!(fixed.to_rational(), Some(exact.clone()));

    let float: f64 = answer(&numbers);
    println!("a float                  {float}");
    assert!(exact == ratio(34, 3) && (float - 34.0 / 3.0).abs() < 1e-14);

    let twice: DoubleDouble = answer(&numbers);
    println!(
        "two floats               {} {:+e}",
        twice.high(),
        twice.low()
    );
    let miss = twice.to_rational().map(|value| (value - &exact).abs());
    assert!(miss.is_some_and(|miss| miss < BigRational::new(1.into(), 10_i128.pow(30).into())));

    let bounds: Interval = answer(&numbers);
    println!(
        "bounds that contain it   {:?} to {:?}",
        bounds.lower(),
        bounds.upper()
    );
    assert!(bounds.contains(&exact));

    // With symbols instead of numbers, the result covers every sphere of every pile.
    let symbols = ["i", "j", "k", "s"].map(Symbol);
    let formula = carried(symbols.map(Polynomial::from));
    println!("a polynomial             {formula}");
    let values: Vec<_> = symbols.into_iter().zip(numbers.clone()).collect();
    assert_eq!(formula.evaluate(&values), Some(exact.clone()));

    // A `Pile` computes the same force in any of these scalars, in mg.
    let pile = Pile::isosceles(10, numbers[3].clone())?;
    let site = Site { i: 4, j: 1, k: 9 };
    let normal = pile.forces::<BigRational>().on_floor(site)?.normal;
    println!("\nOn the floor of 10 layers, the normal force of sphere (4, 1) is {normal} mg.");
    assert_eq!(normal, exact / ratio(8, 3));
    Ok(())
}
