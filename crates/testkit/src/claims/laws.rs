//! Every scalar passes the law suite for any operands.
//!
//! The tests with fixed operands show that the suite rejects flawed scalars.

use crate::real::Bounded;
use arbitrary::Unstructured;
use cannonpile::engine::quotient;
use cannonpile::scalar::{DoubleDouble, Field, FixedRational, Interval, laws};
use num_rational::BigRational;
use num_traits::Zero;

use super::{Checked, in_lowest_terms, same};
use crate::generators::number;
use crate::pair::Pair;

/// Checks one scalar of the crate.
pub fn one_scalar(u: &mut Unstructured<'_>) -> Checked {
    let suite = u.choose(&SUITES)?;
    suite(&Operands::any(u)?)
}

const SUITES: [fn(&Operands) -> Checked; 11] = [
    suite::<f32>,
    suite::<f64>,
    suite::<DoubleDouble>,
    suite::<Interval>,
    suite::<Pair<BigRational, Interval>>,
    suite::<BigRational>,
    suite::<FixedRational<i8>>,
    suite::<FixedRational<i16>>,
    suite::<FixedRational<i32>>,
    suite::<FixedRational<i64>>,
    suite::<FixedRational<i128>>,
];

/// A ratio of integers is the rational in lowest terms. The denominator is not zero.
pub fn ratios_of_integers(u: &mut Unstructured<'_>) -> Checked {
    let (n, d) = (number::integer(u)?, number::integer(u)?);
    let want = (!d.is_zero()).then(|| BigRational::new(n.clone(), d.clone()));
    let got = (!d.is_zero()).then(|| quotient(n, &d));
    same("n/d", &got, &want)?;
    got.as_ref().map_or(Ok(()), in_lowest_terms)
}

struct Operands {
    rationals: [BigRational; 3],
    integer: i128,
}

impl Operands {
    fn any(u: &mut Unstructured<'_>) -> arbitrary::Result<Self> {
        Ok(Self {
            rationals: [
                number::rational(u)?,
                number::rational(u)?,
                number::rational(u)?,
            ],
            integer: number::machine_integer(u)?,
        })
    }
}

fn suite<T: Field + Bounded>(operands: &Operands) -> Checked {
    let [x, y, z] = &operands.rationals;
    let [a, b, c] = [x, y, z].map(T::from_rational);
    laws::algebra(&a, &b, &c)?;
    laws::embedding(x, y, T::bounds)?;
    laws::embedding(z, z, T::bounds)?;
    laws::integers::<T>(operands.integer)?;
    laws::numerators::<T>(x, y)?;
    Ok(())
}
