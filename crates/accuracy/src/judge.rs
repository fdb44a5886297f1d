//! The checks of a number type.

use core::cmp::Ordering;
use core::num::NonZeroI64;
use std::time::Instant;

use cannonpile::geometry::Load;
use cannonpile::lattice::{Region, Site};
use cannonpile::scalar::laws::{self, BrokenLaw};
use cannonpile::scalar::{Algebra, Exactness, Field};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Error, Pile, ratio};
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::judgement::{Check, Finding, Growth, Judgement};
use crate::value::{distance, dyadic, fraction, value};

const TWO: NonZeroI64 = NonZeroI64::new(2).unwrap();
const THREE: NonZeroI64 = NonZeroI64::new(3).unwrap();
/// Powers of two up to this exponent are tried.
const MAX_POWER: i64 = 1200;
/// Powers of two up to this exponent are tried for exact types that do not say so. They convert long integers bit by bit.
const MAX_POWER_BY_BITS: i64 = 200;
/// The numbers of layers at which the error is measured. The last one is left out if errors cannot grow.
const HEIGHTS: [i128; 3] = [10, 40, 160];

/// Judges a number type: whether it keeps the promise of its [`EXACTNESS`](cannonpile::scalar::Algebra::EXACTNESS), and how large
/// its errors are.
///
/// It runs the [laws](cannonpile::scalar::laws) of the core, compares single operations and the forces of several piles with exact
/// ones, measures the growth of the error with the number of layers, and looks for the ends of the range. Values are found by
/// comparisons with rationals, so the type needs an order and no other conversion. In formats that are not binary, measured
/// errors are off by up to one rounding.
///
/// A float keeps its promise if each operation does, if the forces stay within
/// [`Layer::error_bound`](cannonpile::Layer::error_bound), and if no overflow passes unnoticed. Results below the smallest normal
/// number must be those of gradual underflow, or consistently zero.
///
/// It takes a few seconds for `f64` in a release build, and longer for slow types.
///
/// # Examples
/// ```
/// use cannonpile_accuracy::judge;
///
/// let judgement = judge::<f32>();
/// assert!(judgement.keeps_promise());
/// assert_eq!(judgement.stagnation, Some(24));
/// println!("{judgement}");
/// ```
#[must_use]
pub fn judge<T: Field + PartialOrd>() -> Judgement {
    let mut examiner = Examiner::<T>::new();
    examiner.laws();
    examiner.operations();
    let judged = examiner
        .piles()
        .and_then(|()| examiner.growth())
        .and_then(|()| examiner.time());
    if let Err(error) = judged {
        examiner.report(Check::Piles, error.to_string());
    }
    examiner.overflow();
    examiner.underflow();
    examiner.stagnation();
    examiner.judgement
}

/// The true result of an operation, compared with the result of the type.
enum Outcome {
    /// The type cannot hold the result, and says so.
    Refused,
    /// The distance from the true result. It is 0 for an exact type, and for bounds that contain the true result.
    Off(BigRational),
    /// A result that the type excludes.
    Wrong,
}

struct Examiner<T> {
    judgement: Judgement,
    /// The unit u of errors.
    unit: BigRational,
    /// The largest relative error of a single operation or conversion that was measured.
    rounding: BigRational,
    /// The largest number of bits of a value.
    bits: u64,
    /// Powers of two up to this exponent are tried.
    powers: i64,
    operands: Vec<(BigRational, T)>,
}

impl<T: Field + PartialOrd> Examiner<T> {
    fn new() -> Self {
        let is_exact = T::EXACTNESS == Exactness::Unknown && has_exact_thirds::<T>();
        let (unit, bits) = match T::EXACTNESS {
            Exactness::Rounded { bits } => (power(-i64::from(bits)), u64::from(bits) + 80),
            // A search for the binary digits of an exact third would find no end.
            _ => (BigRational::zero(), if is_exact { 1 } else { 256 }),
        };
        let operands = operands().into_iter();
        let operands = operands.map(|r| (r.clone(), T::from_rational(&r)));
        Self {
            judgement: Judgement::new::<T>(),
            unit,
            rounding: BigRational::zero(),
            bits,
            powers: if is_exact {
                MAX_POWER_BY_BITS
            } else {
                MAX_POWER
            },
            operands: operands.collect(),
        }
    }

    fn report(&mut self, check: Check, witness: String) {
        self.judgement.findings.push(Finding { check, witness });
    }

    fn outcome(&self, got: &T, want: &BigRational) -> Outcome {
        let image = T::from_rational(want);
        let is_right = match T::EXACTNESS {
            Exactness::ExactOrFault | Exactness::Enclosure if !got.is_defined() => {
                return Outcome::Refused;
            }
            Exactness::Exact | Exactness::ExactOrFault => got.equals(&image),
            // Bounds that overlap are unordered.
            Exactness::Enclosure => matches!(got.partial_cmp(&image), None | Some(Ordering::Equal)),
            _ => match value(got, self.bits) {
                None => return Outcome::Refused,
                // A number with more bits, such as a third, may be equal to the true result.
                Some(found) if found.is_exact || !got.equals(&image) => {
                    return Outcome::Off(distance(&found.rational, want));
                }
                Some(_) => true,
            },
        };
        if is_right {
            Outcome::Off(BigRational::zero())
        } else {
            Outcome::Wrong
        }
    }

    /// Returns an error in units of u times `scale`.
    fn in_units(&self, error: &BigRational, scale: &BigRational) -> f64 {
        if error.is_zero() {
            return 0.0;
        }
        let unit = &self.unit * scale;
        if unit.is_zero() {
            return f64::INFINITY;
        }
        f64::from_rational(&(error / unit))
    }

    fn laws(&mut self) {
        let mut broken: Vec<BrokenLaw> = Vec::new();
        let mut count = 0;
        let mut check = |result: Result<(), BrokenLaw>| {
            count += 1;
            if let Err(law) = result
                && broken.iter().all(|other| other.law != law.law)
            {
                broken.push(law);
            }
        };
        let bits = self.bits;
        let bounds = |x: &T| value(x, bits).map(|found| [found.rational.clone(), found.rational]);
        let next = self.operands.iter().cycle().skip(1);
        for ((r, a), (_, c)) in self.operands.iter().zip(next) {
            for (s, b) in &self.operands {
                check(laws::algebra(a, b, c));
                check(laws::numerators::<T>(r, s));
                if let Exactness::Rounded { .. } = T::EXACTNESS {
                    check(laws::embedding(r, s, bounds));
                }
            }
        }
        for n in [0, 8, 11, 24, 53, 63, 100, 126].map(|e| 1_i128 << e) {
            for n in [n, n + 1, -n, -n - 1] {
                check(laws::integers::<T>(n));
            }
        }
        self.judgement.law_count = count;
        for BrokenLaw { law, witness, .. } in broken {
            self.report(Check::Laws, format!("{law}: {witness}"));
        }
    }

    /// Compares single operations with exact ones. For a type that promises nothing, the largest error is the unit.
    fn operations(&mut self) {
        let mut rounding = BigRational::zero();
        let mut worst = (BigRational::zero(), String::new());
        let mut wrong = None;
        let mut check = |name: &str, operands: [&T; 2], got: &T, want: &BigRational| {
            let witness = || format!("{name} of {operands:?} is {got:?} in place of {want}");
            match self.outcome(got, want) {
                Outcome::Wrong => wrong = wrong.take().or_else(|| Some(witness())),
                Outcome::Off(error) if !want.is_zero() => {
                    let error = error / want.abs();
                    if (&error - &rounding).is_positive() {
                        rounding.clone_from(&error);
                    }
                    // Conversions of a type that promises nothing may be rounded several times.
                    let counts = name != "conversion" || T::EXACTNESS != Exactness::Unknown;
                    if counts && (&error - &worst.0).is_positive() {
                        worst = (error, witness());
                    }
                }
                Outcome::Off(_) | Outcome::Refused => {}
            }
        };
        // Operations are judged on the stored values.
        let stored = |x: &T, r: &BigRational| match value(x, self.bits) {
            Some(found) if found.is_exact && is_float::<T>() => found.rational,
            _ => r.clone(),
        };
        let stored: Vec<_> = self.operands.iter().map(|(r, x)| stored(x, r)).collect();
        for ((r, a), p) in self.operands.iter().zip(&stored) {
            check("conversion", [a, a], a, r);
            let third = a.clone().div_int(THREE);
            check("third", [a, a], &third, &(p / BigInt::from(3)));
            for ((_, b), q) in self.operands.iter().zip(&stored) {
                check("sum", [a, b], &(a.clone() + b), &(p + q));
                check("difference", [a, b], &(a.clone() - b), &(p - q));
                check("product", [a, b], &(a.clone() * b), &(p * q));
                if let (Some(quotient), false) = (a.checked_div(b), q.is_zero()) {
                    check("quotient", [a, b], &quotient, &(p / q));
                }
            }
        }
        let (worst, witness) = worst;
        let is_promised = matches!(T::EXACTNESS, Exactness::Rounded { .. });
        if is_promised && (&worst - &self.unit).is_positive() {
            self.report(Check::Operations, witness);
        } else if let Some(witness) = wrong {
            self.report(Check::Operations, witness);
        }
        if !is_promised {
            self.unit = worst.clone();
            if self.unit.is_zero() {
                // Results are equal to the true ones, or wrong. How wrong is not looked for.
                self.bits = 1;
            }
        }
        self.rounding = rounding;
        self.judgement.unit = f64::from_rational(&self.unit);
        self.judgement.largest_operation_error = self.in_units(&worst, &BigRational::one());
    }

    /// Compares all forces of several piles with exact ones.
    fn piles(&mut self) -> Result<(), Error> {
        for pile in piles()? {
            self.compare(Check::Piles, &pile, Selection::All)?;
        }
        Ok(())
    }

    fn growth(&mut self) -> Result<(), Error> {
        let count = HEIGHTS.len() - usize::from(self.unit.is_zero());
        for layers in HEIGHTS.into_iter().take(count) {
            let worst = self.compare(Check::Growth, &hcp(layers)?, Selection::Layer(layers - 2))?;
            let heights = f64::from_rational(&BigRational::from_integer(layers.into()));
            self.judgement.growth.push(Growth {
                layers,
                error: worst,
                error_per_root_of_layers: worst.map(|worst| worst / heights.sqrt()),
            });
        }
        Ok(())
    }

    /// Compares the forces of a part of a pile. Returns the largest error, in u times the largest force of its layer, or
    /// `None` if the type cannot hold one of the forces.
    fn compare(
        &mut self,
        check: Check,
        pile: &Pile,
        part: Selection,
    ) -> Result<Option<f64>, Error> {
        let (mut forces, exact) = (pile.forces::<T>(), pile.forces::<BigRational>());
        if T::EXACTNESS == Exactness::Exact {
            // Without a load in the scalar, the core computes with integers and not with the type.
            let [[i, j], ..] = pile.shape().layer(0)?.corners();
            forces = forces.with_load(Site { i, j, k: 0 }, T::zero())?;
        }
        let (mut layers, mut exact) = (forces.layers(part)?, exact.layers(part)?);
        let mut worst = Some(0.0);
        while let (Some(layer), Some(exact)) = (layers.next_layer()?, exact.next_layer()?) {
            let spheres = layer.sphere_count();
            let mut got = [(); 3].map(|()| vec![T::zero(); spheres]);
            let mut want = [(); 3].map(|()| vec![BigRational::zero(); spheres]);
            let (into, exact_into) = (
                got.each_mut().map(|x| &mut x[..]),
                want.each_mut().map(|x| &mut x[..]),
            );
            let filled = if layer.is_floor() {
                exact.fill_base(exact_into)?;
                layer.fill_base(into)
            } else {
                exact.fill(exact_into)?;
                layer.fill(into)
            };
            if check == Check::Piles {
                self.judgement.force_count += 3 * spheres;
            }
            match filled {
                Ok(()) => {}
                Err(error @ Error::Overflow { .. }) => {
                    if T::EXACTNESS == Exactness::Exact {
                        self.report(check, format!("{pile}: {error}"));
                    }
                    if check == Check::Piles {
                        self.judgement.refused_count += 3 * spheres;
                    }
                    worst = None;
                    continue;
                }
                Err(error) => return Err(error),
            }
            // The floor has no bound of its own.
            let bound = layer.error_bound().filter(|_| !layer.is_floor());
            let (error, scale, witness) = self.worst(&got.concat(), &want.concat());
            let is_wrong =
                witness.is_some() || bound.is_some_and(|bound| (&error - bound).is_positive());
            if is_wrong
                && self
                    .judgement
                    .findings
                    .iter()
                    .all(|finding| finding.check != check)
            {
                let witness = witness.unwrap_or_else(|| {
                    format!("an error of {:.1} u", self.in_units(&error, &scale))
                });
                self.report(check, format!("{pile}, layer {}: {witness}", layer.k()));
            }
            let error = self.in_units(&error, &scale);
            worst = worst.map(|worst: f64| worst.max(error));
            if check == Check::Piles {
                self.judgement.largest_force_error = self.judgement.largest_force_error.max(error);
            }
        }
        Ok(worst)
    }

    /// Returns the largest error of some forces, the largest force, and the first result that the type excludes.
    fn worst(&self, got: &[T], want: &[BigRational]) -> (BigRational, BigRational, Option<String>) {
        // Fixed point is faster than fractions.
        let places = self.unit.denom().bits() + 64;
        let fixed = |r: &BigRational| (r.numer() << places).div_floor(r.denom());
        let points: Vec<_> = want.iter().map(fixed).collect();
        let scale = points
            .iter()
            .zip(want)
            .max_by_key(|(point, _)| point.magnitude().clone());
        let scale = scale.map_or_else(BigRational::zero, |(_, want)| want.abs());
        let mut worst = BigRational::zero();
        let mut witness = None;
        let mut span: Option<BigInt> = None;
        for ((got, want), point) in got.iter().zip(want).zip(&points) {
            // Most errors are smaller than the largest one so far, and a comparison with two bounds shows it.
            if let Some(span) = &span {
                let ends = [point - span, point + span];
                let [lower, upper] = ends.map(|end| T::from_rational(&fraction(end, places)));
                if lower <= *got && *got <= upper {
                    continue;
                }
            }
            match self.outcome(got, want) {
                Outcome::Off(error) if (&error - &worst).is_positive() => {
                    worst = error;
                    // The bounds are rounded too. Fixed point is within a step.
                    let rounding = (&self.rounding + &self.rounding) * &scale;
                    let rest = fixed(&(&worst - rounding)) - BigInt::from(2);
                    span = Some(rest).filter(|rest| rest.is_positive() && is_float::<T>());
                }
                Outcome::Off(_) | Outcome::Refused => {}
                Outcome::Wrong => {
                    witness = witness.or_else(|| Some(format!("{got:?} in place of {want}")));
                }
            }
        }
        (worst, scale, witness)
    }

    /// Measures the time for each force.
    fn time(&mut self) -> Result<(), Error> {
        let pile = hcp(40)?;
        let forces = pile.forces::<T>();
        for _ in 0..3 {
            let layers = forces.layers(Selection::All)?;
            let spheres = layers.slice_len()?;
            let mut slices = [(); 3].map(|()| vec![T::zero(); spheres]);
            let began = Instant::now();
            match layers.fill(slices.each_mut().map(|slice| &mut slice[..])) {
                Err(Error::Overflow { .. }) => return Ok(()),
                filled => filled?,
            }
            let count = f64::from_rational(&BigRational::from_integer((3 * spheres).into()));
            let time = began.elapsed().as_secs_f64() / count;
            let least = self.judgement.seconds_per_force;
            self.judgement.seconds_per_force = Some(least.map_or(time, |least| least.min(time)));
        }
        Ok(())
    }

    /// Returns whether a result is what the type has for a power of two, or a small multiple of one.
    fn is_image(&self, got: &T, want: &BigRational) -> bool {
        let image = T::from_rational(want);
        if !image.is_defined() {
            return !got.is_defined();
        }
        match T::EXACTNESS {
            Exactness::Exact | Exactness::Rounded { .. } => got.equals(&image),
            Exactness::ExactOrFault | Exactness::Enclosure => {
                !matches!(self.outcome(got, want), Outcome::Wrong)
            }
            // The conversion may round otherwise than operations, but not by a factor of two.
            _ => {
                got.equals(&image)
                    || value(got, self.bits).is_some_and(|found| {
                        (distance(&found.rational, want) - want.abs() / BigInt::from(2))
                            .is_negative()
                    })
            }
        }
    }

    /// Reports the first of some results that is not the image of `want`, and returns whether there is one. The operand x
    /// is named by its text.
    fn has_other<const N: usize>(
        &mut self,
        check: Check,
        x: &str,
        want: &BigRational,
        results: [(&str, T); N],
    ) -> bool {
        let other = results
            .into_iter()
            .find(|(_, got)| !self.is_image(got, want));
        let Some((name, got)) = other else {
            return false;
        };
        let image = T::from_rational(want);
        let witness = format!("{name} of x = {x} is {got:?} in place of {image:?}");
        self.report(check, witness);
        true
    }

    /// Doubles 1 until the type refuses the result.
    fn overflow(&mut self) {
        let two = T::from_integer(2);
        for e in 0..self.powers {
            let (text, whole) = (format!("2^{e}"), power(e + 1));
            let [x, y] = [&power(e), &whole].map(T::from_rational);
            let results = [
                ("x + x", x.clone() + &x),
                ("2 x", two.clone() * &x),
                ("x - (-x)", x.clone() - &-x.clone()),
            ];
            let negative = results.clone().map(|(name, y)| (name, -y));
            if self.has_other(Check::Overflow, &text, &whole, results)
                || self.has_other(Check::Overflow, &text, &-whole, negative)
            {
                return;
            }
            if x.equals(&y) && T::EXACTNESS != Exactness::Enclosure {
                return self.report(Check::Overflow, format!("2^{} is {text}", e + 1));
            }
            // Bounds of numbers that are too large are equal.
            if !y.is_defined() || x.equals(&y) {
                self.judgement.largest_power = Some(e);
                return;
            }
        }
    }

    /// Halves 1 until the type has no smaller number, and computes with the smallest ones.
    fn underflow(&mut self) {
        for e in (1 - self.powers..=0).rev() {
            let (text, twice, whole) = (format!("2^{e}"), power(e), power(e - 1));
            let [x, y] = [&twice, &whole].map(T::from_rational);
            let halves = [
                ("x/2", x.clone().div_int(TWO)),
                ("x 1/2", x.clone() * &T::from_rational(&power(-1))),
            ];
            if self.has_other(Check::Underflow, &text, &whole, halves) {
                return;
            }
            if x.equals(&y) && T::EXACTNESS != Exactness::Enclosure {
                return self.report(Check::Underflow, format!("2^{} is {text}", e - 1));
            }
            if !y.is_defined() || y.is_zero() || x.equals(&y) {
                self.judgement.smallest_power = Some(e);
                return self.smallest_numbers(&text, &twice);
            }
        }
    }

    /// Computes with multiples of the smallest positive number η.
    fn smallest_numbers(&mut self, text: &str, unit: &BigRational) {
        let Exactness::Rounded { .. } = T::EXACTNESS else {
            return;
        };
        let multiple = |n: i32| unit * BigInt::from(n);
        for (a, b) in (1..=4).flat_map(|a| (1..=4).map(move |b| (a, b))) {
            let [x, y] = [a, b].map(|n| T::from_rational(&multiple(n)));
            let (sum, difference) = (format!("{a}x + {b}x"), format!("{a}x - {b}x"));
            let results = [(&*sum, x.clone() + &y)];
            let differences = [(&*difference, x - &y)];
            if self.has_other(Check::Underflow, text, &multiple(a + b), results)
                || self.has_other(Check::Underflow, text, &multiple(a - b), differences)
            {
                return;
            }
        }
        for a in 1..=4 {
            // Half of an odd multiple may be rounded either way.
            let half = T::from_rational(&multiple(a)) * &T::from_rational(&power(-1));
            let exact = multiple(a) / BigInt::from(2);
            let neighbours = [exact, multiple(a / 2), multiple((a + 1) / 2)];
            if !neighbours.iter().any(|want| self.is_image(&half, want)) {
                let witness = format!("{a}x 1/2 of x = {text} is {half:?}");
                return self.report(Check::Underflow, witness);
            }
        }
    }

    fn stagnation(&mut self) {
        if T::EXACTNESS == Exactness::Enclosure {
            return;
        }
        let stagnates = |k: &i64| {
            let x = T::from_rational(&power(*k));
            x.is_defined() && (x.clone() + &T::one()).equals(&x)
        };
        let first = (0..=self.powers).find(stagnates);
        self.judgement.stagnation = first;
        let least = match T::EXACTNESS {
            Exactness::Exact | Exactness::ExactOrFault => i64::MAX,
            Exactness::Rounded { bits } => bits.into(),
            _ => 0,
        };
        if let Some(k) = first.filter(|k| *k < least) {
            self.report(Check::Stagnation, format!("2^{k} + 1 is 2^{k}"));
        }
    }
}

/// Returns whether results have errors that can be measured.
fn is_float<T: Algebra>() -> bool {
    !matches!(
        T::EXACTNESS,
        Exactness::Exact | Exactness::ExactOrFault | Exactness::Enclosure
    )
}

/// Returns whether (4/3 − 1)·3 is 1. If 4/3 is rounded, the difference shows it.
fn has_exact_thirds<T: Algebra>() -> bool {
    let third = T::from_integer(4).div_int(THREE) - &T::one();
    (third * &T::from_integer(3)).equals(&T::one())
}

/// Returns 2^e.
fn power(e: i64) -> BigRational {
    dyadic(BigInt::one(), e)
}

/// Returns operands of magnitudes between 1/16 and 16: short fractions, numbers near 1, and numbers of 62 bits.
fn operands() -> Vec<BigRational> {
    let short = [
        (0, 1),
        (1, 1),
        (-1, 1),
        (1, 2),
        (1, 3),
        (-2, 7),
        (5, 3),
        (10, 9),
        (-22, 7),
        (3, 16),
    ];
    let mut operands: Vec<_> = short
        .map(|(n, d)| BigRational::new(n.into(), d.into()))
        .into();
    operands.extend([8, 11, 24, 53].map(|bits| power(-bits) + BigRational::one()));
    operands.extend([8, 11, 24, 53].map(|bits| power(-bits) - BigRational::one()));
    // Knuth's generator MMIX.
    let mut state = 1_u64;
    operands.extend((0..8).map(|n| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let sign = if n % 2 == 0 { 1 } else { -1 };
        dyadic(BigInt::from((state >> 2) | (1 << 61)) * sign, n - 64)
    }));
    operands
}

/// Returns HCP under a hexagon of side 4, in which every layer has a sign change.
fn hcp(layers: i128) -> Result<Pile, Error> {
    Pile::under(Region::hexagon(4, 4)?, Stacking::hcp(layers)?)
}

/// Returns piles of every kind: straight ones, discs, another angle of the base, sign changes, loads and a tilt.
fn piles() -> Result<Vec<Pile>, Error> {
    let load = Load {
        down: ratio!(3 / 7),
        x: ratio!(-1 / 5),
        y: ratio!(2),
    };
    let loaded = Pile::under(Region::triangle(2)?, "++-+--+".parse()?)?;
    Ok(vec![
        Pile::triangular(12)?,
        Pile::discs(12)?,
        Pile::isosceles(8, ratio!(2 / 5))?,
        Pile::under(Region::hexagon(2, 2)?, Stacking::hcp(12)?)?,
        Pile::on(Region::hexagon(4, 4)?, Stacking::dhcp(4)?)?,
        loaded
            .with_load(Site::APEX, load)?
            .with_tilt([ratio!(1 / 11), ratio!(-1 / 3)])?,
    ])
}
