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
//! * The extrapolated error for h → 0 is e∞ in e = e∞ + C hᵖ ([`Limit`]). For a correct code it is 0 within its
//!   standard error.
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

mod files;
mod fit;
mod limit;
mod read;
mod report;

pub use files::{NoRefinementFiles, RefinementFile, RefinementFiles};
pub use fit::{Fit, NoOrder};
pub use limit::Limit;
pub use report::RefinementReport;

use crate::Each;
use core::fmt;

use super::comparison::Comparison;

/// The largest number of levels of a refinement study.
pub const MAX_LEVELS: usize = 1000;

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
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Refinement;
    ///
    /// assert_eq!(Refinement::TimeStep.name(), "timestep");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Stiffness => "stiffness",
            Self::TimeStep => "timestep",
        }
    }

    /// Returns the refinement parameter h for a stiffness or a time step.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Refinement;
    ///
    /// assert_eq!([Refinement::Stiffness, Refinement::TimeStep].map(|of| of.h(4.0)), [0.25, 4.0]);
    /// ```
    #[must_use]
    pub const fn h(self, parameter: f64) -> f64 {
        match self {
            Self::Stiffness => 1.0 / parameter,
            Self::TimeStep => parameter,
        }
    }

    /// Returns ln h. The logarithm of the parameter never overflows, although 1/k may.
    fn ln_h(self, parameter: f64) -> f64 {
        match self {
            Self::Stiffness => -parameter.ln(),
            Self::TimeStep => parameter.ln(),
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

    /// Returns the name of the norm, as in tables: `largest` or `rms`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Norm;
    ///
    /// assert_eq!(Norm::ALL.map(Norm::name), ["largest", "rms"]);
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Largest => "largest",
            Self::Rms => "rms",
        }
    }
}

/// One simulation of a refinement study: its parameter, and the summary of its comparison with the exact forces.
///
/// # Examples
/// ```
/// use cannonpile_dem::verify::{Norm, Level};
///
/// let level = Level::of_errors(1e6, 495, 4e-6, 1e-6);
/// assert!(level.is_whole());
/// assert_eq!(level.error(Norm::Rms), 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
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
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile_dem::verify::{Comparison, Measured, Level};
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
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

    /// Returns a level with known errors and all contacts measured.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Level;
    ///
    /// let level = Level::of_errors(1e-3, 30, 2e-5, 1e-5);
    /// assert_eq!((level.parameter, level.matched), (1e-3, 30));
    /// ```
    #[must_use]
    pub const fn of_errors(
        parameter: f64,
        contacts: u64,
        largest_error: f64,
        rms_error: f64,
    ) -> Self {
        Self {
            parameter,
            contacts,
            matched: contacts,
            missing: 0,
            extra: 0,
            largest_error,
            rms_error,
            predicted_error: None,
        }
    }

    /// Returns whether the comparison covers the whole pile: some contacts were measured, none is missing and no pair
    /// is extra. Soft springs can let a pile collapse; its errors are then those of another pile.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Level;
    ///
    /// let level = Level::of_errors(10.0, 30, 0.1, 0.05);
    /// assert!(level.is_whole() && !Level { missing: 3, matched: 27, ..level }.is_whole());
    /// ```
    #[must_use]
    pub const fn is_whole(&self) -> bool {
        self.matched > 0 && self.missing == 0 && self.extra == 0
    }

    /// Returns the relative error in a norm.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Norm, Level};
    ///
    /// let level = Level::of_errors(1e6, 30, 2e-5, 1e-5);
    /// assert_eq!(Norm::ALL.map(|norm| level.error(norm)), [2e-5, 1e-5]);
    /// ```
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
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::LevelPlace;
    ///
    /// assert_eq!(LevelPlace::Floor.name(), "floor");
    /// ```
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
///     Level::of_errors(k, 30, error, error / 3.0)
/// });
/// let study = RefinementStudy::new(Refinement::Stiffness, levels)?;
/// let fit = study.fit(Norm::Largest)?;
/// assert!((fit.order - 1.0).abs() < 1e-3 && (fit.constant / 5.0 - 1.0).abs() < 0.01);
/// assert_eq!(fit.levels, 3);
/// assert_eq!(study.places(Norm::Largest).last(), Some(&LevelPlace::Floor));
/// # Ok::<(), Box<dyn std::error::Error>>(())
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
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{RefinementStudy, NoRefinement, Refinement, Level};
    ///
    /// let levels = [1e3, 1e5, 1e4].map(|k| Level::of_errors(k, 30, 5.0 / k, 2.0 / k));
    /// let study = RefinementStudy::new(Refinement::Stiffness, levels)?;
    /// assert_eq!(study.levels().iter().map(|level| level.parameter).collect::<Vec<_>>(), [1e3, 1e4, 1e5]);
    /// let twice = RefinementStudy::new(Refinement::Stiffness, [levels[0], levels[0]]);
    /// assert_eq!(twice, Err(NoRefinement::Twice { parameter: 1e3 }));
    /// # Ok::<(), NoRefinement>(())
    /// ```
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
            check_parameter(level.parameter)?;
            let predicted = level.predicted_error;
            for error in Norm::ALL
                .each(|norm| level.error(norm))
                .into_iter()
                .chain(predicted)
            {
                if error.is_nan() || error < 0.0 {
                    return Err(NoRefinement::Error { error });
                }
            }
        }
        // Sorted by the parameter itself: two neighbouring floats may have the same logarithm.
        levels.sort_by(|a, b| match refinement {
            Refinement::Stiffness => a.parameter.total_cmp(&b.parameter),
            Refinement::TimeStep => b.parameter.total_cmp(&a.parameter),
        });
        let parameters = levels.iter().map(|level| level.parameter);
        match repeated(parameters) {
            Some(parameter) => Err(NoRefinement::Twice { parameter }),
            None => Ok(Self { refinement, levels }),
        }
    }

    /// Returns the refinement study with the largest error that theory predicts at each parameter.
    ///
    /// # Errors
    /// [`NoRefinement::Error`] for a prediction that is negative or not a number.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{RefinementStudy, NoRefinement, Refinement, Level};
    ///
    /// let levels = [1e3, 1e4].map(|k| Level::of_errors(k, 30, 5.0 / k, 2.0 / k));
    /// let study = RefinementStudy::new(Refinement::Stiffness, levels)?.predicted(|k| 4.8 / k)?;
    /// assert_eq!(study.levels()[0].predicted_error, Some(4.8e-3));
    /// # Ok::<(), NoRefinement>(())
    /// ```
    pub fn predicted(self, error: impl Fn(f64) -> f64) -> Result<Self, NoRefinement> {
        let levels = self.levels.into_iter().map(|level| Level {
            predicted_error: Some(error(level.parameter)),
            ..level
        });
        Self::new(self.refinement, levels)
    }

    /// Returns the parameter that changes from level to level.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{RefinementStudy, NoRefinement, Refinement, Level};
    ///
    /// let study = RefinementStudy::new(Refinement::TimeStep, [Level::of_errors(1e-3, 30, 0.1, 0.05)])?;
    /// assert_eq!(study.refinement(), Refinement::TimeStep);
    /// # Ok::<(), NoRefinement>(())
    /// ```
    #[must_use]
    pub const fn refinement(&self) -> Refinement {
        self.refinement
    }

    /// Returns the levels, from the coarsest, with the greatest h, to the finest.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{RefinementStudy, NoRefinement, Refinement, Level};
    ///
    /// let levels = [1e-4, 1e-3].map(|step| Level::of_errors(step, 30, step, step / 3.0));
    /// let study = RefinementStudy::new(Refinement::TimeStep, levels)?;
    /// assert_eq!(study.levels()[0].parameter, 1e-3);
    /// # Ok::<(), NoRefinement>(())
    /// ```
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
    /// let levels = [0.1, 0.01].map(|step| Level::of_errors(step, 30, step * step, 0.0));
    /// let study = RefinementStudy::new(Refinement::TimeStep, levels)?;
    /// let [none, order] = study.orders(Norm::Largest)[..] else { panic!() };
    /// assert!(none.is_none() && (order.unwrap() - 2.0).abs() < 1e-12);
    /// assert_eq!(study.orders(Norm::Rms), [None, None]);
    /// # Ok::<(), NoRefinement>(())
    /// ```
    #[must_use]
    pub fn orders(&self, norm: Norm) -> Vec<Option<f64>> {
        let logs: Vec<_> = self
            .levels
            .iter()
            .map(|level| self.log(level, norm))
            .collect();
        let between = logs.windows(2).map(|pair| match pair {
            [Some(coarse), Some(fine)] => Some(coarse.order_to(*fine)).filter(|p| p.is_finite()),
            _ => None,
        });
        core::iter::once(None).chain(between).collect()
    }

    /// Returns ln h and ln e, if the error has a logarithm.
    fn log(&self, level: &Level, norm: Norm) -> Option<Log> {
        let error = level.error(norm);
        (error > 0.0 && error.is_finite()).then(|| Log {
            h: self.refinement.ln_h(level.parameter),
            e: error.ln(),
        })
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

/// The reason why levels form no refinement study: one line with the remedy.
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
            Self::Twice { parameter } => write!(
                f,
                "two levels at {parameter:e}: give each stiffness or time step once"
            ),
            Self::Error { error } => {
                write!(
                    f,
                    "{error:e} is not a relative error: give a number of 0 or more"
                )
            }
        }
    }
}

impl core::error::Error for NoRefinement {}

fn check_parameter(parameter: f64) -> Result<(), NoRefinement> {
    if parameter.is_normal() && parameter > 0.0 {
        Ok(())
    } else {
        Err(NoRefinement::Parameter { parameter })
    }
}

/// Returns the first number that occurs twice in a sorted sequence.
fn repeated(sorted: impl Iterator<Item = f64>) -> Option<f64> {
    let mut before = None;
    for number in sorted {
        if before == Some(number) {
            return Some(number);
        }
        before = Some(number);
    }
    None
}
