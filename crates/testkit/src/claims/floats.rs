//! Answers in `f32` and `f64` differ from the exact answer by at most a few roundings, for every real sin φ.
//!
//! # The bound
//! The unit roundoff is u = 2^−p, with p = 24 or 53. Every answer is a sum Σ ±t of products. The table counts the
//! roundings in each quantity. Each rounding has a relative error of at most u. N is a count of spheres, w an
//! increment, s is sin φ, and W = 1 + 1 + 2s is the sum of the increments.
//!
//! | quantity | roundings |
//! |---|---|
//! | a count N, or s (½ and 1 are exact) | 1 |
//! | an increment w = 2s (doubling is exact) | 1 |
//! | a force Nw | 1 + 1 + 1 = 3 |
//! | a component of a force, times s | 3 + 1 + 1 = 5 |
//! | a sum of three components, the first added to zero | 5 + 2 = 7 |
//! | W = 1 + 1 + 2s | 2 |
//! | a force on the floor in f₀: a sum of three components, plus W | 7 + 1 = 8 |
//! | a force on the floor in mg: divided by W | 8 + 2 + 1 = 11 |
//! | the resultant on a sphere: a sum of three components of (N + 1)w (8), plus a force on the floor (8) | 8 + 1 = 9 |
//!
//! So the error is below 12 u Σ|t|, with one u to spare for products of errors. This bound is 6 to 12 units in the
//! last place of Σ|t|. For contact and normal forces all terms are positive, so Σ|t| is the answer. The terms of a
//! shear force may cancel, so that the answer is smaller than Σ|t|.
//!
//! If s or a product underflows, its error is at most η/2 instead, with the least subnormal η. A count of at most L
//! layers multiplies each of these errors. Their sum is below 4Lη.

use core::fmt::Debug;

use crate::real::Bounded;
use arbitrary::Unstructured;
use cannonpile::geometry::Vector;
use cannonpile::lattice::{Direction, Site};
use cannonpile::scalar::{Algebra, CorrectlyRounded};
use cannonpile::{Error, Forces, Pile};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Signed;

use super::{Checked, demand};
use crate::generators::{number, pile};

/// The errors are below this multiple of u Σ|t|.
const ROUNDINGS: i64 = 12;

/// A rounded scalar.
pub trait Float: Algebra + Bounded + CorrectlyRounded {}

impl<F: Algebra + Bounded + CorrectlyRounded> Float for F {}

/// Checks `f32` and `f64` for a pile whose sin φ is a float.
pub fn real_pile(u: &mut Unstructured<'_>) -> Checked {
    let pile = pile::real_pile(u)?;
    let site = pile::site(u, &pile)?;
    every_answer::<f64>(&pile, site)?;
    every_answer::<f32>(&pile, site)
}

/// Checks `f32` and `f64` for a pile whose sin φ is a rational.
pub fn any_pile(u: &mut Unstructured<'_>) -> Checked {
    let pile = pile::pile(u)?;
    let site = pile::site(u, &pile)?;
    every_answer::<f64>(&pile, site)?;
    every_answer::<f32>(&pile, site)
}

/// Checks all answers about one sphere.
fn every_answer<F: Float>(pile: &Pile, site: Site) -> Checked {
    let (rounded, exact) = (pile.forces::<F>(), pile.forces::<BigRational>());
    let bound = Bound::of::<F>(pile);
    let above = exact.from_above(site)?;
    for (got, want) in rounded.from_above(site)?.iter().zip(&above) {
        bound.holds("a force from above", got, want, want)?;
    }
    bound.holds_along(
        "the position",
        rounded.position(site)?,
        exact.position(site)?,
        magnitudes(&exact, &counts(site))?,
    )?;
    bound.holds_along(
        "the resultant",
        rounded.resultant_above(site)?,
        exact.resultant_above(site)?,
        magnitudes(&exact, &above)?,
    )?;
    if site.k == pile.layers() - 1 {
        return on_floor(&bound, &rounded, &exact, site);
    }
    let mut below = [const { BigRational::ZERO }; 3];
    for &direction in pile.dimension().directions() {
        let (got, want) = (
            rounded.contact(site, direction)?,
            exact.contact(site, direction)?,
        );
        bound.holds("a contact force", &got, &want, &want)?;
        let vector = exact.contact_vector(site, direction)?;
        bound.holds_along(
            "a contact vector",
            rounded.contact_vector(site, direction)?,
            vector.clone(),
            vector.map(|c| c.abs()),
        )?;
        below[direction.index()] = want;
    }
    let mut terms = magnitudes(&exact, &above)? + &magnitudes(&exact, &below)?;
    terms.z += exact.increment_sum()?;
    bound.holds_along(
        "the unbalanced force",
        rounded.unbalanced(site)?,
        Vector::zero(),
        terms,
    )
}

fn on_floor<F: Float>(
    bound: &Bound,
    rounded: &Forces<'_, F>,
    exact: &Forces<'_, BigRational>,
    site: Site,
) -> Checked {
    let (got, want) = (rounded.on_floor(site)?, exact.on_floor(site)?);
    let in_mg = exact.increment_sum()?.recip();
    let terms = magnitudes(exact, &exact.from_above(site)?)?.scaled(&in_mg);
    bound.holds("the normal force", &got.normal, &want.normal, &want.normal)?;
    bound.holds("the shear along x", &got.shear_x, &want.shear_x, &terms.x)?;
    bound.holds("the shear along y", &got.shear_y, &want.shear_y, &terms.y)
}

/// Returns (N_α, N_β, N_γ), the numbers of spheres above a site on its lines of contacts.
fn counts(site: Site) -> [BigRational; 3] {
    [site.k - site.i - site.j, site.i, site.j].map(|n| BigRational::from_integer(n.into()))
}

/// Returns Σ |c_m ê_m| for c_m ≥ 0, by component.
fn magnitudes(
    forces: &Forces<'_, BigRational>,
    coefficients: &[BigRational; 3],
) -> Result<Vector<BigRational>, Error> {
    let mut sum = Vector::zero();
    for (direction, coefficient) in Direction::ALL.into_iter().zip(coefficients) {
        let e = forces.direction(direction)?.map(|c| c.abs());
        sum = sum + &e.scaled(coefficient);
    }
    Ok(sum)
}

/// The bound on the error of one format, for one pile.
struct Bound {
    /// 12 u.
    relative: BigRational,
    /// 4Lη.
    absolute: BigRational,
}

impl Bound {
    fn of<F: CorrectlyRounded>(pile: &Pile) -> Self {
        let precision = i32::try_from(F::PRECISION).expect("a few dozen");
        let least = i32::try_from(F::MIN_EXPONENT).expect("about a thousand");
        Self {
            relative: number::power(2, -precision) * BigInt::from(ROUNDINGS),
            absolute: number::power(2, least) * BigInt::from(4 * pile.layers()),
        }
    }

    /// Checks that `got` differs from `want` by at most the bound. `magnitude` is Σ|t| of the terms of `want`.
    fn holds<F: Bounded + Debug>(
        &self,
        what: &str,
        got: &F,
        want: &BigRational,
        magnitude: &BigRational,
    ) -> Checked {
        let stored = got.enclosure().map(|point| point.lower);
        let allowed = &self.relative * magnitude + &self.absolute;
        let holds = stored.is_some_and(|stored| (stored - want).abs() <= allowed);
        demand(holds, || {
            format!("{what} is {got:?}, too far from {want}, with terms of {magnitude} in all")
        })
    }

    fn holds_along<F: Bounded + Debug>(
        &self,
        what: &str,
        got: Vector<F>,
        want: Vector<BigRational>,
        magnitude: Vector<BigRational>,
    ) -> Checked {
        let (want, magnitude) = (want.into_array(), magnitude.into_array());
        for ((got, want), magnitude) in got.into_array().iter().zip(&want).zip(&magnitude) {
            self.holds(what, got, want, magnitude)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod injected_faults {
    use super::*;

    #[test]
    fn an_error_of_thirteen_ulps_is_caught() {
        let pile = Pile::isosceles(10_i128.pow(30), number::ratio(2, 5)).unwrap();
        let site = Site {
            i: 0,
            j: 0,
            k: 10_i128.pow(29),
        };
        let bound = Bound::of::<f64>(&pile);
        let got: f64 = pile.forces().contact(site, Direction::Alpha).unwrap();
        let want = pile.forces().contact(site, Direction::Alpha).unwrap();
        assert!(bound.holds("force", &got, &want, &want).is_ok());
        let nearest = f64::nearest_to_rational(&want).unwrap();
        for towards in [f64::next_up, f64::next_down] {
            let wrong = (0..13).fold(nearest, |x, _| towards(x));
            assert!(bound.holds("force", &wrong, &want, &want).is_err());
        }
        assert!(bound.holds("force", &f64::NAN, &want, &want).is_err());
    }

    /// An answer of `f32` presented as one of `f64`.
    #[test]
    fn single_precision_is_caught() {
        let pile = Pile::isosceles(1 << 40, number::ratio(1, 3)).unwrap();
        let site = Site {
            i: 12_345,
            j: 0,
            k: (1 << 40) - 1,
        };
        let single = pile.forces::<f32>().on_floor(site).unwrap().normal;
        let want = pile.forces::<BigRational>().on_floor(site).unwrap().normal;
        let holds = |bound: Bound| {
            bound
                .holds("normal", &f64::from(single), &want, &want)
                .is_ok()
        };
        assert!(holds(Bound::of::<f32>(&pile)));
        assert!(!holds(Bound::of::<f64>(&pile)));
    }
}
