//! One formula in six scalar types: the load that a sphere transmits, in fractions, floats, bounds and symbols.
//!
//! The generic body is written once, over `Algebra`. The scalar type decides how exact the answer is, and a polynomial
//! gives the answer for every pile at once. Run it with `cargo run --example five_scalars`.

use core::array;

use cannonpile::formula::{force, handed_on, increments, weight};
use cannonpile::geometry::directions;
use cannonpile::lattice::{Site, count};
use cannonpile::scalar::{
    Algebra, DoubleDouble, FixedRational, Interval, Polynomial, RealEmbeddable, Symbol,
};
use cannonpile::{Error, Pile};
use num_rational::BigRational;
use num_traits::Signed;

/// Returns the vertical force that sphere (i, j) of layer k transmits to the layer below, in units of mg/(2(1+s)). Its own
/// weight is included, and s = sin φ is the angle of the base triangle.
fn carried<T: Algebra>([i, j, k, s]: [T; 4]) -> T {
    let (above, own) = (count::above(&i, &j, &k), increments(&s));
    let received = array::from_fn(|line| force(above[line].clone(), &own[line]));
    handed_on(&received, &directions(&s), &weight(&own)).z
}

/// The answer for these numbers, each turned into the scalar.
fn answer<T: Algebra>(numbers: &[BigRational; 4]) -> T {
    carried(numbers.each_ref().map(T::from_rational))
}

fn main() -> Result<(), Error> {
    // Layer 9 of the pile, sphere (4, 1), on a base with sin φ = 1/3. No float is equal to 1/3.
    let ratio = |n: i64, d: i64| BigRational::new(n.into(), d.into());
    let numbers = [ratio(4, 1), ratio(1, 1), ratio(9, 1), ratio(1, 3)];

    let exact: BigRational = answer(&numbers);
    println!("a fraction of any size   {exact}");

    let fixed: FixedRational<i64> = answer(&numbers);
    println!("a fraction of 64 bits    {fixed}, or an overflow that is never silent");
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
    let miss = twice.enclosure().map(|point| (point.lower - &exact).abs());
    assert!(miss.is_some_and(|miss| miss < BigRational::new(1.into(), 10_i128.pow(30).into())));

    let bounds: Interval = answer(&numbers);
    println!(
        "bounds that hold it      {:?} to {:?}",
        bounds.lower(),
        bounds.upper()
    );
    assert!(bounds.contains(&exact));

    // Symbols in place of the numbers give one answer for every sphere of every pile.
    let symbols = ["i", "j", "k", "s"].map(Symbol);
    let formula = carried(symbols.map(Polynomial::from));
    println!("a polynomial             {formula}");
    let values: Vec<_> = symbols.into_iter().zip(numbers.clone()).collect();
    assert_eq!(formula.evaluate(&values), Some(exact.clone()));

    // A pile answers queries in the same scalar types, in units of mg.
    let pile = Pile::isosceles(10, numbers[3].clone())?;
    let site = Site { i: 4, j: 1, k: 9 };
    let normal = pile.forces::<BigRational>().on_floor(site)?.normal;
    println!("\nOn the floor of 10 layers, sphere (4, 1) presses with {normal} mg.");
    assert_eq!(normal, exact / ratio(8, 3));
    Ok(())
}
