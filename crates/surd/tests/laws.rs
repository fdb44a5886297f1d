//! The laws in the documentation of the crate, on random and adversarial numbers. The test is deterministic.

use std::cmp::Ordering;
use std::hash::{BuildHasher, Hash, RandomState};

use arbitrary::Unstructured;
use cannonpile_testkit::claims::{Checked, demand, same};
use cannonpile_testkit::generators::number;
use cannonpile_testkit::properties;
use exact_surd::{DoubleDouble, Surd, SurdSum};
use num_rational::BigRational;
use num_traits::{One, Zero};

properties! {
    surds_have_a_total_order: total_order, 256;
    equal_surds_have_equal_hashes: hashes, 256;
    products_commute_and_associate: products, 256;
    quotients_and_squares_invert_products: quotients, 256;
    printed_surds_are_read_back: printed, 256;
    conversion_to_floats_is_monotone: monotone, 256;
    sums_commute_and_distribute: sums, 256;
    sums_compare_as_their_difference: comparisons_of_sums, 256;
    double_doubles_have_symmetric_operations: double_doubles, 512;
}

fn surd(u: &mut Unstructured<'_>) -> Result<Surd, arbitrary::Error> {
    let (c, r) = number::root(u)?;
    Ok(Surd::new(c, r).expect("a radicand that is not negative"))
}

/// Another form of the same number: its stored radicand has the square of a prime that is not extracted.
fn in_other_form(x: &Surd) -> Surd {
    let p = BigRational::from_integer(1009.into());
    let radicand = BigRational::from_integer(x.radicand().clone().into());
    Surd::new(x.coefficient() / &p, radicand * &p * &p).expect("a positive radicand")
}

fn total_order(u: &mut Unstructured<'_>) -> Checked {
    let mut sorted = [surd(u)?, surd(u)?, surd(u)?];
    sorted.sort();
    let [x, y, z] = &sorted;
    demand(x <= y && y <= z && x <= z, || format!("{x}, {y}, {z}"))?;
    same("the opposite comparison", &y.cmp(x), &x.cmp(y).reverse())?;
    same(
        "the order of the negatives",
        &(-x.clone()).cmp(&-z.clone()),
        &z.cmp(x),
    )?;
    same(
        "the sign",
        &x.cmp(&Surd::zero()),
        &x.coefficient().cmp(&BigRational::zero()),
    )?;
    // A positive factor keeps the order, a negative one reverses it.
    let factor = surd(u)?;
    let order = match factor.cmp(&Surd::zero()) {
        Ordering::Less => y.cmp(x),
        Ordering::Equal => Ordering::Equal,
        Ordering::Greater => x.cmp(y),
    };
    same(
        "the order of the products",
        &(x.clone() * &factor).cmp(&(y.clone() * &factor)),
        &order,
    )
}

fn hashes(u: &mut Unstructured<'_>) -> Checked {
    let (x, y) = (surd(u)?, surd(u)?);
    let (other, state) = (in_other_form(&x), RandomState::new());
    same("another form", &other, &x)?;
    same("its hash", &state.hash_one(&other), &state.hash_one(&x))?;
    let sum = |x: &Surd, y: &Surd| SurdSum::new(x.clone(), y.clone());
    same(
        "the hash of a sum",
        &state.hash_one(sum(&y, &other)),
        &state.hash_one(sum(&x, &y)),
    )?;
    // A hash that is the same for all numbers would satisfy this law.
    demand(x == y || differs(&x, &y), || {
        format!("{x} and {y} have one hash")
    })
}

fn differs(x: &impl Hash, y: &impl Hash) -> bool {
    let state = RandomState::new();
    state.hash_one(x) != state.hash_one(y)
}

fn products(u: &mut Unstructured<'_>) -> Checked {
    let (x, y, z) = (surd(u)?, surd(u)?, surd(u)?);
    let product = x.clone() * &y;
    same("y·x", &(y.clone() * &x), &product)?;
    same(
        "x·(y·z)",
        &(x.clone() * &(y.clone() * &z)),
        &(product.clone() * &z),
    )?;
    same("(−x)·y", &(-x.clone() * &y), &-product.clone())?;
    same(
        "the product in another form",
        &(in_other_form(&x) * &y),
        &product,
    )?;
    let one = Surd::from(BigRational::one());
    same("x·1", &(x.clone() * &one), &x)?;
    same("x·0", &(x * &Surd::zero()), &Surd::zero())
}

fn quotients(u: &mut Unstructured<'_>) -> Checked {
    let (x, y) = (surd(u)?, surd(u)?);
    same("x²", &(x.clone() * &x), &Surd::from(x.square()))?;
    let root = Surd::sqrt(x.square())?;
    same(
        "√(x²)",
        &root,
        &if x < Surd::zero() {
            -x.clone()
        } else {
            x.clone()
        },
    )?;
    match y.checked_recip() {
        None => same("a number without inverse", &y, &Surd::zero()),
        Some(inverse) => {
            same("1/(1/y)", &inverse.checked_recip(), &Some(y.clone()))?;
            same("x/y·y", &(x.clone() * &inverse * &y), &x)
        }
    }
}

fn printed(u: &mut Unstructured<'_>) -> Checked {
    for x in [surd(u)?, in_other_form(&surd(u)?)] {
        let text = x.to_string();
        // Numbers with more than 5000 digits are not read.
        let read: Surd = text.parse()?;
        same("the number read", &read, &x)?;
        same("the text printed again", &read.to_string(), &text)?;
    }
    Ok(())
}

fn monotone(u: &mut Unstructured<'_>) -> Checked {
    let mut sorted = [surd(u)?, surd(u)?];
    sorted.sort();
    let [x, y] = &sorted;
    demand(x.to_f64() <= y.to_f64(), || format!("{x} and {y}"))?;
    same("the float of −x", &(-x.clone()).to_f64(), &-x.to_f64())?;
    // A float rounds to itself.
    let float = number::float(u)?;
    let exact = Surd::from(number::exactly(float));
    same("a float", &exact.to_f64(), &float)?;
    // Rounding keeps the order with floats, which are their own roundings.
    let order = x.partial_cmp(&float).expect("a finite float");
    let rounded = x.to_f64().partial_cmp(&float).expect("a finite float");
    demand(order == rounded || rounded.is_eq(), || {
        format!("{x} against {float:e}")
    })
}

fn sums(u: &mut Unstructured<'_>) -> Checked {
    let (x, y, factor) = (surd(u)?, surd(u)?, surd(u)?);
    let sum = SurdSum::new(x.clone(), y.clone());
    same("y + x", &SurdSum::new(y.clone(), x.clone()), &sum)?;
    let [first, second] = sum.terms().clone();
    same("the sum of its terms", &SurdSum::new(second, first), &sum)?;
    let distributed = SurdSum::new(x.clone() * &factor, y.clone() * &factor);
    same("(x + y)·z", &(sum.clone() * &factor), &distributed)?;
    same(
        "x + 0",
        &SurdSum::new(x.clone(), Surd::zero()),
        &SurdSum::from(x.clone()),
    )?;
    same(
        "a sum that is a surd",
        &sum.to_surd().cloned(),
        &x.checked_add(&y),
    )?;
    same("y + x as a surd", &y.checked_add(&x), &x.checked_add(&y))?;
    let negative = SurdSum::new(-x, -y);
    let opposite = sum.nearest::<f64>().map(|float| -float);
    same("the float of −x − y", &negative.nearest(), &opposite)
}

/// x + y has the sign that the order of x and −y has, and its float has this sign.
fn comparisons_of_sums(u: &mut Unstructured<'_>) -> Checked {
    let (x, y) = (surd(u)?, surd(u)?);
    let sum = SurdSum::new(x.clone(), y.clone());
    let order = x.cmp(&-y);
    same("the order with zero", &sum.partial_cmp(&0.0), &Some(order))?;
    if let Some(float) = sum.nearest::<f64>() {
        same(
            "the sign of the float",
            &float.is_sign_negative(),
            &order.is_lt(),
        )?;
        let around = [float.next_down(), float.next_up()].map(|float| sum.partial_cmp(&float));
        let [above, below] = [Some(Ordering::Greater), Some(Ordering::Less)];
        same(
            "the order with the neighbours of the float",
            &around,
            &[above, below],
        )?;
    }
    Ok(())
}

fn double_doubles(u: &mut Unstructured<'_>) -> Checked {
    let [x, y] =
        [number::rational(u)?, number::rational(u)?].map(|r| DoubleDouble::from_rational(&r));
    let (Some(v), Some(w)) = (x.to_rational(), y.to_rational()) else {
        return Ok(());
    };
    same("the order", &x.partial_cmp(&y), &Some(v.cmp(&w)))?;
    same("equality", &(x == y), &(v == w))?;
    same(
        "the parts",
        &DoubleDouble::from_parts(x.high(), x.low()),
        &Some(x),
    )?;
    same("the value of −x", &(-x).to_rational(), &Some(-v.clone()))?;
    if [x, y, x + y, x * y].iter().all(DoubleDouble::is_finite) {
        same("y + x", &(y + x), &(x + y))?;
        same("y·x", &(y * x), &(x * y))?;
        same("−x − y", &(-x - y), &-(x + y))?;
        same("(−x)·y", &(-x * y), &-(x * y))?;
    }
    let zero = DoubleDouble::new(0.0);
    same("x + (−x)", &(x + -x), &zero)?;
    same("x + 0", &(x + zero), &x)?;
    same("x·1", &(x * DoubleDouble::new(1.0)), &x)?;
    same("x/1", &x.checked_div(&DoubleDouble::new(1.0)), &Some(x))
}
