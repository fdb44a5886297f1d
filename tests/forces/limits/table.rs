//! The table of the worst errors, with a row for each pile and quantity and a column for each scalar, and the bounds of
//! every row.

use core::fmt::{self, Write as _};

use cannonpile::lattice::{Direction, Site};
use cannonpile::scalar::{Algebra, DoubleDouble, Interval, Surd};
use cannonpile::{Error, Packing, Pile};
use cannonpile_testkit::real::Bounded;
use num_rational::BigRational;
use num_traits::{One, Pow, Signed, Zero};

use super::cases::{Case, ratio};
use super::errors::{Worst, distance, rounding, unit};
use super::forces::{Forces, OfSphere};
use cannonpile_testkit::judge::{Float, Value, is_nearest};

/// The text above the rows.
pub(crate) const HEAD: &str = "\
The worst errors at the limits, in units in the last place (ulp) of the format. For double-doubles and for the width of
intervals the unit is the ulp of `f64`.

The column `nearest` shows the errors of exact values rounded to `f64` and `f32`, in pile units and in SI, in ulps of
the value. Correct rounding has an error of at most ½. The other columns show the errors of scalars in pile units. In
straight piles the errors of contact and normal forces are in ulps of the value, and those of shear forces, which are
differences, in ulps of the normal force. After sign changes all errors of forces are in ulps of the greatest force of
the layer. The errors of positions are in ulps of the greatest component. Each interval contains the exact value.

| pile | quantity | nearest | `f64` | `f32` | double-double | interval |
|---|---|--:|--:|--:|--:|--:|
";

/// One quantity of one pile.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pile: String,
    quantity: &'static str,
    nearest: Worst,
    f64: Outcome,
    f32: Outcome,
    double: Outcome,
    /// The width of the intervals, if all of them contain the exact value.
    interval: Outcome,
}

/// The worst error, or an overflow of the scalar.
#[derive(Clone, Debug)]
enum Outcome {
    Errs(Worst),
    Overflows,
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let power = |outcome: &Outcome| match outcome {
            Outcome::Errs(worst) => worst.as_power(),
            Outcome::Overflows => "overflow".into(),
        };
        let (pile, quantity, nearest) = (&self.pile, self.quantity, &self.nearest);
        let [double, single] = [&self.f64, &self.f32].map(ToString::to_string);
        let (twice, width) = (power(&self.double), &self.interval);
        writeln!(
            f,
            "| {pile} | {quantity} | {nearest} | {double} | {single} | {twice} | {width} |"
        )
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Errs(worst) => worst.fmt(f),
            Self::Overflows => f.write_str("overflow"),
        }
    }
}

/// An exact value, and the number whose unit in the last place is the unit of its error.
struct Wanted {
    value: BigRational,
    about: BigRational,
}

/// The answers of every scalar about a pile.
#[derive(Clone, Debug)]
pub(crate) struct Answers {
    /// In `f64`.
    pub(crate) f64: Result<Forces<f64>, Error>,
    /// In `f32`.
    pub(crate) f32: Result<Forces<f32>, Error>,
    /// In double-doubles.
    pub(crate) double: Result<Forces<DoubleDouble>, Error>,
    /// In intervals.
    pub(crate) interval: Result<Forces<Interval>, Error>,
}

impl Answers {
    /// Computes the answers about a pile.
    pub(crate) fn of(pile: &Pile) -> Self {
        Self {
            f64: Forces::of(pile),
            f32: Forces::of(pile),
            double: Forces::of(pile),
            interval: Forces::of(pile),
        }
    }
}

/// Returns the rows of a pile. Checks that roundings are correct, intervals contain the exact values, and errors respect
/// their bounds.
pub(crate) fn rows(case: &Case, answers: &Answers) -> Result<String, String> {
    let mut text = String::new();
    if case.is_refused() {
        writeln!(text, "| {} | refused | | | | | |", case.name).map_err(|e| e.to_string())?;
        return Ok(text);
    }
    let fault = |error: Error| format!("{}: {error}", case.name);
    let exact = Forces::<BigRational>::of(&case.pile).map_err(fault)?;
    let packing = case.packing().map_err(fault)?;
    for quantity in Quantity::ALL {
        let wanted = quantity.wanted(case, &exact);
        let values: Vec<_> = wanted.iter().map(|wanted| wanted.value.clone()).collect();
        let nearest = quantity.roundings(&exact, &values, packing.as_ref())?;
        let row = Row {
            pile: case.name.clone(),
            quantity: quantity.name(),
            nearest,
            f64: compare::<f64, f64>(&answers.f64, quantity, &wanted),
            f32: compare::<f32, f32>(&answers.f32, quantity, &wanted),
            double: compare::<DoubleDouble, f64>(&answers.double, quantity, &wanted),
            interval: widths(&answers.interval, quantity, &wanted)?,
        };
        row.keeps_bounds(case)?;
        write!(text, "{row}").map_err(|e| e.to_string())?;
    }
    Ok(text)
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Quantity {
    Contact,
    Normal,
    Shear,
    Position,
}

impl Quantity {
    const ALL: [Self; 4] = [Self::Contact, Self::Normal, Self::Shear, Self::Position];

    const fn name(self) -> &'static str {
        match self {
            Self::Contact => "contact",
            Self::Normal => "normal",
            Self::Shear => "shear",
            Self::Position => "position",
        }
    }

    /// The values of this quantity, in the same order for all scalars.
    fn of<T: Clone>(self, forces: &Forces<T>) -> Vec<T> {
        let of = |spheres: &[OfSphere<T>], range: core::ops::Range<usize>| {
            let values = spheres
                .iter()
                .flat_map(|s| s.values[range.clone()].to_vec());
            values.collect()
        };
        match self {
            Self::Contact => of(&forces.contacts, 0..3),
            Self::Normal => of(&forces.floor, 0..1),
            Self::Shear => of(&forces.floor, 1..3),
            Self::Position => of(&forces.positions, 0..3),
        }
    }

    fn wanted(self, case: &Case, exact: &Forces<BigRational>) -> Vec<Wanted> {
        let values = self.of(exact);
        let greatest = |values: &[BigRational]| {
            let sizes = values.iter().map(Signed::abs);
            sizes.max().unwrap_or_else(BigRational::zero)
        };
        let straight = case.pile.shape().stacking().is_straight();
        let about: Vec<BigRational> = match self {
            Self::Position => values
                .chunks(3)
                .flat_map(|p| vec![greatest(p); 3])
                .collect(),
            Self::Shear if straight => {
                let normals = Self::Normal.of(exact);
                normals.into_iter().flat_map(|n| [n.clone(), n]).collect()
            }
            _ if straight => values.clone(),
            Self::Contact => vec![greatest(&values); values.len()],
            Self::Normal | Self::Shear => {
                let all = [Self::Normal.of(exact), Self::Shear.of(exact)].concat();
                vec![greatest(&all); values.len()]
            }
        };
        let pairs = values.into_iter().zip(about);
        pairs
            .map(|(value, about)| Wanted { value, about })
            .collect()
    }

    /// Rounds the exact values, in pile units and in SI units, and checks each float.
    fn roundings(
        self,
        exact: &Forces<BigRational>,
        values: &[BigRational],
        packing: Option<&Packing<'_>>,
    ) -> Result<Worst, String> {
        let mut worst = Worst::none();
        let mut surds: Vec<Surd> = values.iter().cloned().map(Surd::from).collect();
        if let Some(packing) = packing {
            surds.extend(
                self.in_si(exact, values, packing)
                    .map_err(|e| e.to_string())?,
            );
        }
        for surd in surds {
            round_to::<f64>(&surd, &mut worst)?;
            round_to::<f32>(&surd, &mut worst)?;
        }
        Ok(worst)
    }

    /// The answers in SI units. The positions include the contact points.
    fn in_si(
        self,
        exact: &Forces<BigRational>,
        values: &[BigRational],
        packing: &Packing<'_>,
    ) -> Result<Vec<Surd>, Error> {
        let weight = packing.sphere_weight();
        let s = packing.pile().sin_phi();
        let tan = packing.inclination().tan().scaled(&weight);
        let twice_cos_phi = Surd::sqrt((BigRational::one() - s * s) * ratio(4, 1))?;
        let shears = [tan.clone(), tan * &twice_cos_phi];
        let unit = packing.unit_force();
        Ok(match self {
            Self::Contact => values.iter().map(|f| unit.scaled(f)).collect(),
            Self::Normal => values.iter().map(|f| (f * &weight).into()).collect(),
            Self::Shear => {
                let units = shears.iter().cycle();
                units.zip(values).map(|(unit, f)| unit.scaled(f)).collect()
            }
            Self::Position => {
                let mut surds = Vec::new();
                for sphere in &exact.positions {
                    surds.extend(packing.position(sphere.site)?);
                    let site @ Site { k, .. } = sphere.site;
                    if k < packing.pile().layers() - 1 {
                        surds.extend(packing.contact_point(site, Direction::Beta)?);
                    }
                }
                surds
            }
        })
    }
}

fn round_to<F: Float>(surd: &Surd, worst: &mut Worst) -> Result<(), String> {
    let got = surd.nearest::<F>();
    is_nearest(got, &Value::of(surd))?;
    if let Some(got) = got {
        worst.add(Some(rounding(got, surd)));
    }
    Ok(())
}

/// The worst error of a scalar, in units of a format.
fn compare<T: Algebra + Bounded, F: Float>(
    forces: &Result<Forces<T>, Error>,
    quantity: Quantity,
    wanted: &[Wanted],
) -> Outcome {
    let Ok(forces) = forces else {
        return Outcome::Overflows;
    };
    let mut worst = Worst::none();
    for (got, wanted) in quantity.of(forces).iter().zip(wanted) {
        let error = distance(got, &wanted.value);
        worst.add(error.map(|error| error / unit::<F>(&wanted.about)));
    }
    Outcome::Errs(worst)
}

/// The greatest width. Checks that every interval contains its value.
fn widths(
    forces: &Result<Forces<Interval>, Error>,
    quantity: Quantity,
    wanted: &[Wanted],
) -> Result<Outcome, String> {
    let Ok(forces) = forces else {
        return Ok(Outcome::Overflows);
    };
    let mut worst = Worst::none();
    for (got, wanted) in quantity.of(forces).iter().zip(wanted) {
        if !got.contains(&wanted.value) {
            return Err(format!("{got:?} does not contain {}", wanted.value));
        }
        let bounds = got.enclosure();
        let width = bounds.map(|bounds| bounds.upper - bounds.lower);
        worst.add(width.map(|width| width / unit::<f64>(&wanted.about)));
    }
    Ok(Outcome::Errs(worst))
}

impl Row {
    /// Checks the bounds that the library states: 12 units for a straight stacking, otherwise 16 for each layer and load. An
    /// interval grows by 5/3 at each sign change, where each force occurs once in a line.
    fn keeps_bounds(&self, case: &Case) -> Result<(), String> {
        let stacking = case.pile.shape().stacking();
        let straight = stacking.is_straight() || self.quantity == "position";
        let most = if straight {
            ratio(12, 1)
        } else {
            // The layers, the two loads, and the floor.
            BigRational::from_integer((16 * (case.pile.layers() + 3)).into())
        };
        let spread = if straight { 0 } else { stacking.changes() };
        let spread = ratio(5, 3).pow(u32::try_from(spread).unwrap_or(u32::MAX));
        let limits = [
            (&self.f64, most.clone()),
            (&self.f32, most.clone()),
            (&self.double, &most * ratio(1, 1 << 48)),
            (&self.interval, most * ratio(4, 1) * spread),
        ];
        let kept = limits.iter().all(|(outcome, limit)| match outcome {
            Outcome::Errs(worst) => worst.is_at_most(limit),
            Outcome::Overflows => false,
        });
        // These errors are computed from an approximate root, so they may slightly exceed ½. The exact check was made
        // before.
        let half = self.nearest.is_at_most(&(ratio(1, 2) + ratio(1, 1 << 60)));
        if kept && half {
            Ok(())
        } else {
            Err(format!("out of bounds: {self}"))
        }
    }
}
