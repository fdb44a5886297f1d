//! Piles of random stackings in two forms: for the library, and for an oracle that enumerates all stackings.

use std::collections::BTreeMap;
use std::fmt::Debug;

use cannonpile::lattice::{Region, Site};
use cannonpile::scalar::{Polynomial, Symbol};
use cannonpile_disorder::{Error, FirstSign, Mean, MeanForce, RandomPiles, RandomStackings};
use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero, pow};

use crate::oracles::balance::{Balance, Sites};

/// A position in the plane, by its steps along the horizontal parts of the contacts β and γ of a step with sign +.
pub type Place = [i64; 2];

/// The force on the floor below a sphere: normal in mg, shear_x in mg·tanθ, shear_y in √3·mg·tanθ.
pub type Floor = [BigRational; 3];

/// The layer that the piles grow from: a plane, a top layer or a base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Anchor {
    /// An infinite plane. All piles on it have the same sites.
    Plane,
    /// A top layer.
    Top(Region),
    /// A base.
    Base(Region),
}

/// Piles of random stackings and their description.
#[derive(Clone, Debug)]
pub struct Piles {
    /// The layer that the piles grow from.
    pub anchor: Anchor,
    /// The steps between layers.
    pub steps: usize,
    /// The first sign.
    pub first: FirstSign,
    /// True if the spheres are weightless.
    pub weightless: bool,
    /// The loads on sites of the top layer.
    pub loads: Vec<([i64; 2], BigRational)>,
}

/// By position and number of faults: the number of stackings that have a sphere there, and the sum of its forces on the
/// floor.
pub type Sums = BTreeMap<(Place, usize), (BigUint, Floor)>;

/// Probability, normal, shear_x and shear_y by position.
pub type Means = BTreeMap<Place, [BigRational; 4]>;

fn zeros<const N: usize>() -> [BigRational; N] {
    [(); N].map(|()| BigRational::zero())
}

fn small(n: i128) -> i64 {
    i64::try_from(n).expect("the piles in tests are small")
}

/// The position in the oracle's type.
pub fn named(place: cannonpile_disorder::Place) -> Place {
    [small(place.a), small(place.b)]
}

/// The position of a site of a layer, `net` + steps further down than − steps.
pub fn of_site([i, j]: [i64; 2], net: i64) -> Place {
    [2 * i + j - net, i + 2 * j - net]
}

/// All sequences of `steps` signs with this first sign, or with either.
fn sequences(steps: usize, first: Option<i64>) -> Vec<Vec<i64>> {
    let all = (0..1_u32 << steps).map(|bits| {
        let sign = |step: usize| if bits >> step & 1 == 0 { 1 } else { -1 };
        (0..steps).map(sign).collect::<Vec<_>>()
    });
    all.filter(|signs| first.is_none() || signs.first().is_none_or(|sign| Some(*sign) == first))
        .collect()
}

/// The number of sign changes.
pub fn faults(signs: &[i64]) -> usize {
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

fn sites(region: Region) -> Sites {
    let rows = region.rows(0);
    rows.flat_map(|row| row.i.map(move |i| (row.j, i)))
        .collect()
}

impl Piles {
    /// The response to a load on one sphere of the plane.
    pub fn response(steps: usize, first: FirstSign) -> Self {
        Self {
            anchor: Anchor::Plane,
            steps,
            first,
            weightless: true,
            loads: vec![([0, 0], BigRational::one())],
        }
    }

    /// Piles under their own weight, without loads.
    pub fn heavy(anchor: Anchor, steps: usize, first: FirstSign) -> Self {
        Self {
            anchor,
            steps,
            first,
            weightless: false,
            loads: Vec::new(),
        }
    }

    /// The piles in the library's type.
    pub fn piles(&self) -> Result<RandomPiles, Error> {
        let stackings = RandomStackings::new(self.steps as i128 + 1, self.first)?;
        let mut piles = match self.anchor {
            Anchor::Plane => RandomPiles::plane(stackings),
            Anchor::Top(top) => RandomPiles::under(top, stackings),
            Anchor::Base(base) => RandomPiles::on(base, stackings),
        };
        for ([i, j], load) in &self.loads {
            let (i, j) = (i128::from(*i), i128::from(*j));
            piles = piles.with_load(Site { i, j, k: 0 }, load.clone())?;
        }
        Ok(if self.weightless {
            piles.weightless()
        } else {
            piles
        })
    }

    /// All stackings, as signs.
    pub fn stackings(&self) -> Vec<Vec<i64>> {
        let first = match self.first {
            FirstSign::Plus => Some(1),
            FirstSign::Minus => Some(-1),
            FirstSign::Random => None,
        };
        sequences(self.steps, first)
    }

    /// The force on the floor below each sphere of one stacking. Empty if the base does not support the stacking.
    pub fn bottom(&self, signs: &[i64]) -> BTreeMap<Place, Floor> {
        let steps = signs.iter().map(|sign| if *sign > 0 { '+' } else { '-' });
        let steps: String = steps.collect();
        let loaded = self
            .loads
            .iter()
            .map(|([i, j], _)| (i128::from(*j), i128::from(*i)));
        let balance = match self.anchor {
            // The spheres that no load reaches transmit nothing.
            Anchor::Plane => Some(Balance::under(&loaded.collect(), &steps)),
            Anchor::Top(top) => Some(Balance::under(&sites(top), &steps)),
            Anchor::Base(base) => Balance::on(&sites(base), &steps),
        };
        let Some(mut balance) = balance else {
            return BTreeMap::new();
        };
        if self.weightless {
            balance.ordinary = BigRational::zero();
        }
        for ([i, j], load) in &self.loads {
            let at = (0, i128::from(*j), i128::from(*i));
            let before = balance.weight(at).clone();
            balance.weights.insert(at, before + load);
        }
        let net = match self.anchor {
            // Positions are those of the base.
            Anchor::Base(_) => 0,
            Anchor::Plane | Anchor::Top(_) => signs.iter().sum(),
        };
        let floor = balance.forces().floor.into_iter();
        let mut bottom: BTreeMap<Place, Floor> = floor
            .map(|((_, j, i), floor)| (of_site([i, j].map(small), net), floor))
            .collect();
        if self.anchor == Anchor::Plane {
            // The library also lists the spheres that a load can reach in another stacking. Their force is zero.
            let n = i64::try_from(self.steps).expect("few steps");
            for [x, y] in self.loads.iter().map(|(site, _)| of_site(*site, 0)) {
                for (a, b) in (-n..=n).flat_map(|a| (-n..=n).map(move |b| (a, b))) {
                    let reached = a.max(b).max(0) - a.min(b).min(0) <= n;
                    if reached && (x + a + y + b - net).rem_euclid(3) == 0 {
                        bottom.entry([x + a, y + b]).or_insert_with(zeros);
                    }
                }
            }
        }
        bottom
    }

    /// The sums over all stackings, by number of faults.
    pub fn sums(&self) -> Sums {
        let mut sums = Sums::new();
        for signs in self.stackings() {
            for (place, floor) in self.bottom(&signs) {
                let sum = sums.entry((place, faults(&signs)));
                let (stackings, sum) = sum.or_insert_with(|| (BigUint::zero(), zeros()));
                *stackings += 1_u32;
                sum.iter_mut()
                    .zip(floor)
                    .for_each(|(sum, force)| *sum += force);
            }
        }
        sums
    }

    /// The means at a fault probability. Each stacking counts with its own probability.
    pub fn means(&self, sums: &Sums, q: &BigRational) -> Means {
        let choices = self.steps.saturating_sub(1);
        let firsts = if self.first == FirstSign::Random && self.steps > 0 {
            2
        } else {
            1
        };
        let mut means = Means::new();
        for ((place, faults), (stackings, floor)) in sums {
            let straight = BigRational::one() - q;
            let share = pow(q.clone(), *faults) * pow(straight, choices - faults)
                / BigRational::from_integer(firsts.into());
            let mean = means.entry(*place).or_insert_with(zeros);
            let [normal, shear_x, shear_y] = floor.clone();
            let stackings = BigRational::from_integer(stackings.clone().into());
            for (mean, sum) in mean.iter_mut().zip([stackings, normal, shear_x, shear_y]) {
                *mean += sum * &share;
            }
        }
        means
    }
}

/// The library's sums by number of faults.
pub fn by_faults(piles: &RandomPiles) -> Result<Sums, Error> {
    let by_faults = piles.by_faults()?;
    let rows = by_faults.rows().map(|row| {
        let row = row?;
        let sums = (row.stackings, [row.normal, row.shear_x, row.shear_y]);
        Ok(((named(row.place), row.faults as usize), sums))
    });
    rows.collect()
}

/// The four values of a row.
pub fn numbers<T>(row: MeanForce<T>) -> [T; 4] {
    [row.probability, row.normal, row.shear_x, row.shear_y]
}

/// The library's means by position.
pub fn by_place(mean: Mean<BigRational>) -> Means {
    let rows = mean.into_rows().into_iter();
    rows.map(|row| (named(row.place), numbers(row))).collect()
}

/// The fault probabilities of the comparisons: FCC, HCP, equal weights of all stackings, and others.
pub fn probabilities() -> [BigRational; 5] {
    [(0, 1), (1, 3), (1, 2), (5, 7), (1, 1)].map(|(n, d)| BigRational::new(n.into(), d.into()))
}

/// Compares two maps. An error says where they differ.
pub fn alike<K: Ord + Debug, V: PartialEq + Debug>(
    what: &str,
    expected: &BTreeMap<K, V>,
    answer: &BTreeMap<K, V>,
) -> Result<(), String> {
    for key in expected.keys().chain(answer.keys()) {
        let (expected, answer) = (expected.get(key), answer.get(key));
        if expected != answer {
            return Err(format!("{what} at {key:?}: {answer:?}, not {expected:?}"));
        }
    }
    Ok(())
}

/// Compares all answers of the library about these piles with an enumeration of all stackings: by faults, at
/// [`probabilities`], as polynomials, and in floats.
pub fn agrees(described: &Piles) -> Result<(), String> {
    agrees_at(described, &described.sums(), &probabilities())
}

/// Makes the same comparison at other fault probabilities, for given sums.
pub fn agrees_at(
    described: &Piles,
    expected: &Sums,
    probabilities: &[BigRational],
) -> Result<(), String> {
    let witness = |error: Error| format!("{described:?}: {error}");
    let piles = described.piles().map_err(witness)?;
    let by_faults = match piles.by_faults() {
        // No stacking is that high.
        Err(Error::NoStacking { .. }) if expected.is_empty() => return Ok(()),
        by_faults => by_faults.map_err(witness)?,
    };
    alike(
        "by faults",
        expected,
        &self::by_faults(&piles).map_err(witness)?,
    )?;
    let polynomials = by_faults.polynomial().map_err(witness)?;
    for q in probabilities {
        let expected = described.means(expected, q);
        let exact = piles.exact(q).map_err(witness)?;
        alike("exact", &expected, &by_place(exact.clone()))?;
        alike(
            "at",
            &expected,
            &by_place(by_faults.at(q).map_err(witness)?),
        )?;
        let put_in = polynomials.rows().iter().map(|row| {
            let values =
                numbers(row.clone()).map(|p: Polynomial| p.evaluate(&[(Symbol("q"), q.clone())]));
            (
                named(row.place),
                values.map(|value| value.expect("a polynomial in q")),
            )
        });
        alike("polynomials", &expected, &put_in.collect())?;
        let float = piles.mean(&q.to_f64().expect("a float")).map_err(witness)?;
        let weight = described
            .loads
            .iter()
            .map(|(_, load)| load.to_f64().expect("a float"));
        near(
            &exact,
            &float,
            1e-13 * weight.fold(1.0, |sum: f64, load| sum + load),
        )?;
    }
    Ok(())
}

/// The floats differ from the exact values by at most `within`.
pub fn near(exact: &Mean<BigRational>, float: &Mean<f64>, within: f64) -> Result<(), String> {
    if exact.rows().len() != float.rows().len() {
        return Err("the floats have other positions".to_owned());
    }
    for (exact, float) in exact.rows().iter().zip(float.rows()) {
        let place = (exact.place, float.place);
        if place.0 != place.1 {
            return Err(format!("{place:?}"));
        }
        let pairs = numbers(exact.clone())
            .into_iter()
            .zip(numbers(float.clone()));
        for (exact, float) in pairs {
            let error = (exact.to_f64().expect("a float") - float).abs();
            // Not-a-number is never near a value.
            if error.is_nan() || error > within {
                return Err(format!("{float} for {exact} at {place:?}"));
            }
        }
    }
    Ok(())
}
