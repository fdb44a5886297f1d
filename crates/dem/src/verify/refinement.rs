//! A refinement study: the errors of several simulations of one pile, and the order at which they vanish.
//!
//! Falling errors alone do not show that a code is correct. They must fall to 0, at the order of the method. The exact
//! forces show both from a few simulations that differ in one parameter only.
//!
//! * The refinement parameter is h = 1/k for a [stiffness](Refinement::Stiffness) k, and h = Δt for a
//!   [time step](Refinement::TimeStep) Δt. Levels are sorted from the coarsest, with the greatest h, to the finest.
//! * The error of a level comes from its [`Comparison`]: the largest relative error of its contacts, or the root mean
//!   square ([`Norm`]).
//! * The observed order between neighbouring levels is p = ln(e₁/e₂)/ln(h₁/h₂). The order of the whole study is the
//!   slope of the line ln e = ln C + p ln h through the levels above the floor ([`Fit`]).
//!
//! # The error floor
//! An error falls until another error dominates: rounding, an iteration that stops early, a spurious force. One rule
//! decides which levels are above this floor ([`LevelPlace`]).
//!
//! * Each level has a threshold: an order of ½. From the third level on, it is at least ⅔ of the order observed from
//!   the coarsest level to this one.
//! * The floor begins after the first level, from the coarsest on, from which no finer level reaches the threshold. If
//!   this is the finest level, the study has no floor.
//! * The height of the floor is the smaller error of this level and the next one.
//! * Levels just above the floor are on it too if their errors are less than three times its height. The two coarsest
//!   levels always stay above the floor, unless it begins before the second one.
//!
//! So the rule treats a method of an order below ½ as not converging.

mod report;

pub use report::RefinementReport;

use core::fmt;

use super::comparison::Comparison;

/// The largest number of levels of a refinement study.
pub const MAX_LEVELS: usize = 1000;

/// The smallest order at which an error counts as falling.
const MIN_ORDER: f64 = 0.5;

/// The share of the order so far that the error must keep until the floor is reached.
const KEPT_ORDER: f64 = 2.0 / 3.0;

/// An error below this multiple of the floor is partly due to the floor.
const NEAR: f64 = 3.0;

/// The parameter that changes from level to level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refinement {
    /// The spring stiffness k: h = 1/k.
    Stiffness,
    /// The time step Δt: h = Δt.
    TimeStep,
}

impl Refinement {
    /// Returns the name of the parameter, as in columns: `stiffness` or `timestep`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Stiffness => "stiffness",
            Self::TimeStep => "timestep",
        }
    }
}

/// A norm of the errors of many contacts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Norm {
    /// The largest error.
    Largest,
    /// The root mean square of the errors.
    Rms,
}

impl Norm {
    /// Both norms, in the order of the columns in tables.
    pub const ALL: [Self; 2] = [Self::Largest, Self::Rms];
}

/// One simulation of a refinement study: its parameter, and the summary of its comparison with the exact forces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Level {
    /// The stiffness or the time step, in the unit of the simulation.
    pub parameter: f64,
    /// The number of contacts of the pile.
    pub contacts: u64,
    /// The number of contacts that were measured.
    pub matched: u64,
    /// The number of contacts with a force that were not measured.
    pub missing: u64,
    /// The number of pairs without a contact whose force is more than noise.
    pub extra: u64,
    /// The largest relative error. Infinite if no contact was measured.
    pub largest_error: f64,
    /// The root mean square of the relative errors. Infinite if no contact was measured.
    pub rms_error: f64,
    /// The largest relative error that theory predicts, if there is a prediction.
    pub predicted_error: Option<f64>,
}

impl Level {
    /// Returns the level of a comparison. A pair without a contact counts as extra if its force exceeds `tolerance`
    /// times the largest exact force.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Comparison, Measured, Level};
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &"1.2".parse()?)?;
    /// let measured = [2, 3].map(|id| Measured::new([1, id], 0.46225016352102427));
    /// let level = Level::new(1e6, &Comparison::new(&packing, measured)?, 1e-6);
    /// assert_eq!((level.matched, level.missing, level.largest_error), (2, 1, 0.0));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn new(parameter: f64, comparison: &Comparison, tolerance: f64) -> Self {
        Self {
            parameter,
            contacts: comparison.contacts(),
            matched: comparison.matched(),
            missing: comparison.missing(),
            extra: comparison.extra(tolerance),
            // An error of nothing has no bound.
            largest_error: comparison.largest_error().unwrap_or(f64::INFINITY),
            rms_error: comparison.rms_error().unwrap_or(f64::INFINITY),
            predicted_error: None,
        }
    }

    /// Returns whether the comparison covers the whole pile: some contacts were measured, none is missing and no pair
    /// is extra. Soft springs can let a pile collapse; its errors are then those of another pile.
    #[must_use]
    pub const fn is_whole(&self) -> bool {
        self.matched > 0 && self.missing == 0 && self.extra == 0
    }

    /// Returns the relative error in a norm.
    #[must_use]
    pub const fn error(&self, norm: Norm) -> f64 {
        match norm {
            Norm::Largest => self.largest_error,
            Norm::Rms => self.rms_error,
        }
    }
}

/// The position of a level relative to the error floor. Only levels above it determine the order of the study.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LevelPlace {
    /// Above the floor: the level counts.
    Above,
    /// On the floor, where the error no longer falls: left out.
    Floor,
    /// Contacts are missing or pairs are extra, or none was measured: left out.
    Incomplete,
    /// The error is 0 or infinite, so that it has no logarithm: left out.
    NoLogarithm,
}

impl LevelPlace {
    /// Returns the name, as in tables: `above`, `floor`, `incomplete` or `no logarithm`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Above => "above",
            Self::Floor => "floor",
            Self::Incomplete => "incomplete",
            Self::NoLogarithm => "no logarithm",
        }
    }
}

/// The levels of one pile, simulated at several stiffnesses or time steps, from the coarsest to the finest.
///
/// # Examples
/// ```
/// use cannonpile_dem::verify::{RefinementStudy, Norm, Refinement, Level, LevelPlace};
///
/// // Errors of 5/k, above a floor of rounding that rises with k.
/// let levels = [1e3, 1e4, 1e5, 1e6, 1e7].map(|k| {
///     let error = 5.0 / k + 1e-12 * k;
///     Level { parameter: k, contacts: 30, matched: 30, largest_error: error, rms_error: error / 3.0, ..Level::default() }
/// });
/// let study = RefinementStudy::new(Refinement::Stiffness, levels)?;
/// let fit = study.fit(Norm::Largest)?;
/// assert!((fit.order - 1.0).abs() < 1e-3 && (fit.constant / 5.0 - 1.0).abs() < 0.01);
/// assert_eq!(fit.levels, 3);
/// assert_eq!(study.places(Norm::Largest).last(), Some(&LevelPlace::Floor));
/// # Ok::<(), cannonpile_dem::verify::NoRefinement>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RefinementStudy {
    refinement: Refinement,
    levels: Vec<Level>,
}

impl RefinementStudy {
    /// Returns the refinement study of these levels, which may come in any order.
    ///
    /// # Errors
    /// [`NoRefinement`] for no levels or more than [`MAX_LEVELS`], for an error that is negative or not a number, and for
    /// a parameter that is not positive and normal, or that occurs twice.
    pub fn new(
        refinement: Refinement,
        levels: impl IntoIterator<Item = Level>,
    ) -> Result<Self, NoRefinement> {
        let mut levels: Vec<Level> = levels.into_iter().take(MAX_LEVELS + 1).collect();
        if levels.is_empty() {
            return Err(NoRefinement::Empty);
        }
        if levels.len() > MAX_LEVELS {
            return Err(NoRefinement::TooMany { limit: MAX_LEVELS });
        }
        for level in &levels {
            let parameter = level.parameter;
            if !(parameter.is_normal() && parameter > 0.0) {
                return Err(NoRefinement::Parameter { parameter });
            }
            let errors = [
                Some(level.largest_error),
                Some(level.rms_error),
                level.predicted_error,
            ];
            let is_wrong = |error: &f64| error.is_nan() || *error < 0.0;
            if let Some(error) = errors.into_iter().flatten().find(is_wrong) {
                return Err(NoRefinement::Error { error });
            }
        }
        // Sorted by the parameter itself: two neighbouring floats may have the same logarithm.
        levels.sort_by(|a, b| match refinement {
            Refinement::Stiffness => a.parameter.total_cmp(&b.parameter),
            Refinement::TimeStep => b.parameter.total_cmp(&a.parameter),
        });
        let mut pairs = levels.iter().zip(levels.iter().skip(1));
        match pairs.find(|(one, next)| one.parameter.total_cmp(&next.parameter).is_eq()) {
            Some((Level { parameter, .. }, _)) => Err(NoRefinement::Twice {
                parameter: *parameter,
            }),
            None => Ok(Self { refinement, levels }),
        }
    }

    /// Returns the levels, from the coarsest, with the greatest h, to the finest.
    #[must_use]
    pub fn levels(&self) -> &[Level] {
        &self.levels
    }

    /// Returns the observed order p = ln(e₁/e₂)/ln(h₁/h₂) of each level and the level before it. The first level has no
    /// order. Levels next to an error that is 0 or infinite have none either.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{RefinementStudy, NoRefinement, Norm, Refinement, Level};
    ///
    /// let levels = [0.1, 0.01].map(|step| Level { parameter: step, largest_error: step * step, ..Level::default() });
    /// let study = RefinementStudy::new(Refinement::TimeStep, levels)?;
    /// let [none, order] = study.orders(Norm::Largest)[..] else { panic!() };
    /// assert!(none.is_none() && (order.unwrap() - 2.0).abs() < 1e-12);
    /// assert_eq!(study.orders(Norm::Rms), [None, None]);
    /// # Ok::<(), NoRefinement>(())
    /// ```
    #[must_use]
    pub fn orders(&self, norm: Norm) -> Vec<Option<f64>> {
        let logs = self.levels.iter().map(|level| self.log(level, norm));
        let finer = logs.clone().skip(1);
        let between = logs.zip(finer).map(|(coarse, fine)| {
            let order = coarse?.order_to(fine?);
            Some(order).filter(|order| order.is_finite())
        });
        core::iter::once(None).chain(between).collect()
    }

    /// Returns the position of each level relative to the floor. The order is fitted to the levels above it.
    #[must_use]
    pub fn places(&self, norm: Norm) -> Vec<LevelPlace> {
        let mut above = above(&self.points(norm));
        let places = self.levels.iter().map(|level| {
            if !level.is_whole() {
                LevelPlace::Incomplete
            } else if self.log(level, norm).is_none() {
                LevelPlace::NoLogarithm
            } else if above == 0 {
                LevelPlace::Floor
            } else {
                above -= 1;
                LevelPlace::Above
            }
        });
        places.collect()
    }

    /// Returns the line through the levels above the floor.
    ///
    /// # Errors
    /// [`NoRefinement::Few`] for fewer than two such levels, and [`NoRefinement::Alike`] for parameters too close to
    /// each other to show a slope.
    pub fn fit(&self, norm: Norm) -> Result<Fit, NoRefinement> {
        let mut points = self.points(norm);
        points.truncate(above(&points));
        Fit::through(&points)
    }

    /// Returns the points of the levels that are complete and have a logarithm.
    fn points(&self, norm: Norm) -> Vec<Log> {
        let whole = self.levels.iter().filter(|level| level.is_whole());
        whole.filter_map(|level| self.log(level, norm)).collect()
    }

    /// Returns ln h and ln e, if the error has a logarithm.
    fn log(&self, level: &Level, norm: Norm) -> Option<Log> {
        let error = level.error(norm);
        // The logarithm of the parameter never overflows, although 1/k may.
        let h = match self.refinement {
            Refinement::Stiffness => -level.parameter.ln(),
            Refinement::TimeStep => level.parameter.ln(),
        };
        let e = error.ln();
        (error > 0.0 && error.is_finite()).then_some(Log { h, e })
    }
}

/// A level as a point on logarithmic axes.
#[derive(Clone, Copy, Debug)]
struct Log {
    /// ln h.
    h: f64,
    /// ln e.
    e: f64,
}

impl Log {
    /// Returns the order at which the error falls from this level to a finer one.
    fn order_to(self, finer: Self) -> f64 {
        (self.e - finer.e) / (self.h - finer.h)
    }
}

/// Returns the number of points above the floor, by the rule in [`refinement`](self).
fn above(points: &[Log]) -> usize {
    let last = points.iter().enumerate().position(|(n, from)| {
        let until_here = points.first().filter(|_| n >= 2);
        let until_here = until_here.map(|first| KEPT_ORDER * first.order_to(*from));
        let least = until_here.map_or(MIN_ORDER, |order| order.max(MIN_ORDER));
        let mut finer = points.iter().skip(n + 1);
        !finer.any(|finer| from.order_to(*finer) >= least)
    });
    let (above, floor) = points.split_at(last.map_or(0, |last| last + 1));
    let (Some(last), Some(floor)) = (above.last(), floor.first()) else {
        return above.len();
    };
    let bound = last.e.min(floor.e) + NEAR.ln();
    let is_near = |point: &&Log| point.e < bound;
    let near = above.iter().skip(2).rev().take_while(is_near).count();
    above.len() - near
}

/// The fitted line e = C hᵖ through the levels above the floor: least squares of ln e = ln C + p ln h, with equal
/// weights.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Fit {
    /// The observed order p.
    pub order: f64,
    /// The standard error of the order, √(Σr²/(n − 2)/Σ(ln h − mean)²), with the residuals r of n levels. For two
    /// levels it is not defined, because the line goes through both.
    pub standard_error: Option<f64>,
    /// The constant C, the error at h = 1. For springs and p = 1 it has the unit of the stiffness. It is infinite or 0
    /// if the value overflows or underflows.
    pub constant: f64,
    /// The number of levels above the floor.
    pub levels: usize,
}

impl Fit {
    /// Returns the least-squares line through these points.
    fn through(points: &[Log]) -> Result<Self, NoRefinement> {
        let levels = points.len();
        if levels < 2 {
            return Err(NoRefinement::Few { levels });
        }
        let count: f64 = points.iter().map(|_| 1.0).sum();
        let mean = |of: fn(&Log) -> f64| points.iter().map(of).sum::<f64>() / count;
        let (h, e) = (mean(|point| point.h), mean(|point| point.e));
        let apart = points.iter().map(|point| (point.h - h, point.e - e));
        let spread: f64 = apart.clone().map(|(h, _)| h * h).sum();
        let slope: f64 = apart.clone().map(|(h, e)| h * e).sum();
        let order = slope / spread;
        if !order.is_finite() {
            return Err(NoRefinement::Alike);
        }
        let squares: f64 = apart.map(|(h, e)| (e - order * h).powi(2)).sum();
        Ok(Self {
            order,
            standard_error: (levels > 2).then(|| (squares / (count - 2.0) / spread).sqrt()),
            constant: (e - order * h).exp(),
            levels,
        })
    }
}

/// The reason why levels form no refinement study, or show no order: one line with the remedy.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum NoRefinement {
    /// No level.
    Empty,
    /// More levels than are accepted.
    TooMany {
        /// The largest number of levels.
        limit: usize,
    },
    /// A stiffness or a time step that is not positive and normal.
    Parameter {
        /// The parameter.
        parameter: f64,
    },
    /// Two levels with the same stiffness or time step.
    Twice {
        /// The parameter.
        parameter: f64,
    },
    /// A relative error that is negative or not a number.
    Error {
        /// The error.
        error: f64,
    },
    /// Fewer than two levels above the floor: no order.
    Few {
        /// The number of levels above the floor.
        levels: usize,
    },
    /// Parameters too close to each other to show a slope: no order.
    Alike,
}

impl fmt::Display for NoRefinement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("the refinement study has no levels: give at least one"),
            Self::TooMany { limit } => write!(f, "more than {limit} levels: leave some out"),
            Self::Parameter { parameter } => write!(
                f,
                "{parameter:e} is not a stiffness or a time step: give a positive number, at least 2.3e-308"
            ),
            Self::Twice { parameter } => {
                write!(f, "two levels at {parameter:e}: give each stiffness or time step once")
            }
            Self::Error { error } => {
                write!(f, "{error:e} is not a relative error: give a number of 0 or more")
            }
            Self::Few { levels } => write!(
                f,
                "only {levels} of the 2 levels needed have all contacts and a falling error: add coarser levels, which are \
                 farther above the floor"
            ),
            Self::Alike => f.write_str(
                "the parameters are too close to each other: choose them a factor of 2 or more apart",
            ),
        }
    }
}

impl core::error::Error for NoRefinement {}
