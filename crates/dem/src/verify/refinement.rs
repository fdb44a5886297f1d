//! A refinement study of simulations of one pile: its errors at several stiffnesses or time steps, and the order in which they vanish.
//!
//! A code whose errors fall is not yet right: they must fall to 0, and as fast as its method says. With the exact
//! forces known, both are seen from a few simulations that differ in nothing but a parameter h.
//!
//! * h = 1/k of a [stiffness](Refinement::Stiffness) k, h = Δt of a [time step](Refinement::TimeStep) Δt. Levels go from
//!   the coarsest, with the greatest h, to the finest.
//! * The error of a level is the largest relative error of its contacts, or the root of their mean square
//!   ([`Norm`]): those of its [`Comparison`].
//! * The order observed between neighbouring levels is p = ln(e₁/e₂)/ln(h₁/h₂). That of the refinement study is the slope of the
//!   line ln e = ln C + p ln h through the levels above the floor ([`Fit`]).
//! * What the error would be at h → 0 is e∞ of e = e∞ + C hᵖ ([`Limit`]): 0, as far as it is known, for a code that
//!   solves the problem it says.
//!
//! # The floor
//! An error falls until something else is greater: rounding, an iteration that stops early, a force that should not be
//! there. Which levels are above that floor is decided by one rule ([`LevelPlace`]). It begins behind the first level, from the
//! coarsest on, from which no finer one falls with an order of ½ or more, nor, from the third level on, of ⅔ or more of the
//! order with which errors fell from the coarsest down to it. Of this level and the next one the lesser error is the height
//! of the floor: coarser levels with less than three times that are near enough to be on it too, as long as two are left. So
//! a method of an order below ½ is taken for one that does not converge.

mod files;
mod fit;
mod limit;
mod read;
mod report;

pub use files::{NoRefinementFiles, RefinementFile, RefinementFiles};
pub use fit::{Fit, NoOrder};
pub use limit::Limit;
pub use report::RefinementReport;

use core::fmt;

use super::comparison::Comparison;

/// The most levels of a refinement study.
pub const MAX_LEVELS: usize = 1000;

/// What is refined from level to level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refinement {
    /// The stiffness k of the springs: h = 1/k.
    Stiffness,
    /// The time step Δt: h = Δt.
    TimeStep,
}

impl Refinement {
    /// The name of the parameter, as a column: `stiffness` or `timestep`.
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

    /// The refinement parameter h of a stiffness or a time step.
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

    /// ln h, which no float is too great or too small for.
    fn ln_h(self, parameter: f64) -> f64 {
        match self {
            Self::Stiffness => -parameter.ln(),
            Self::TimeStep => parameter.ln(),
        }
    }
}

/// Which error of many contacts is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Norm {
    /// The largest.
    Largest,
    /// The root of the mean square.
    Rms,
}

impl Norm {
    /// Both, in the order of tables.
    pub const ALL: [Self; 2] = [Self::Largest, Self::Rms];

    /// The name, as in tables: `largest` or `rms`.
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

/// A simulation of the study: its parameter, and what its comparison with the exact forces says.
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
    /// How many contacts the pile has.
    pub contacts: u64,
    /// How many of them were measured.
    pub matched: u64,
    /// How many have a force and were not measured.
    pub missing: u64,
    /// How many pairs that are no contacts carry more than noise.
    pub extra: u64,
    /// The largest relative error.
    pub largest_error: f64,
    /// The root of the mean square of the relative errors.
    pub rms_error: f64,
    /// What theory says that the largest error is, where there is one.
    pub predicted_error: Option<f64>,
}

impl Level {
    /// The level of a comparison; pairs besides the contacts count as extra if they carry more than `tolerance` times the
    /// largest exact force.
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
            largest_error: comparison.largest_error(),
            rms_error: comparison.rms_error(),
            predicted_error: None,
        }
    }

    /// A level of which the errors are known, with all contacts measured.
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

    /// Whether the simulated pile is the pile: something was measured, nothing is missing, nothing extra. Springs that are
    /// too soft let a pile collapse, and its errors are then of another pile.
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

    /// The error in a norm.
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

/// Where a level is, as the order of the refinement study sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LevelPlace {
    /// Above the floor: it counts.
    Above,
    /// On the floor, where errors do not fall as they did: left out.
    Floor,
    /// Contacts are missing or extra, or none was measured: left out.
    Incomplete,
    /// Its error is 0 or infinite, and has no logarithm: left out.
    NoLogarithm,
}

impl LevelPlace {
    /// The name, as in tables: `above`, `floor`, `incomplete` or `no logarithm`.
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

/// Levels with different parameters, from the coarsest to the finest: a pile simulated at several stiffnesses or time
/// steps.
///
/// # Examples
/// ```
/// use cannonpile_dem::verify::{RefinementStudy, Norm, Refinement, Level, LevelPlace};
///
/// // Errors of 5/k, and below them a floor of rounding that rises with k.
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
    /// The refinement study of some levels, in whatever order they come.
    ///
    /// # Errors
    /// [`NoRefinement`] for no levels or more than [`MAX_LEVELS`], a parameter that is not positive and normal or that is there
    /// twice, and an error that is negative or no number.
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
                .map(|norm| level.error(norm))
                .into_iter()
                .chain(predicted)
            {
                if error.is_nan() || error < 0.0 {
                    return Err(NoRefinement::Error { error });
                }
            }
        }
        // By the parameter itself: two that are next to each other may have one logarithm.
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

    /// The refinement study with what theory says of the largest error at each parameter.
    ///
    /// # Errors
    /// [`NoRefinement::Error`] for a prediction that is negative or no number.
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

    /// What is refined.
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

    /// The levels, from the coarsest, with the greatest h, to the finest.
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

    /// The orders observed: p = ln(e₁/e₂)/ln(h₁/h₂) of each level and the one before it. The first has none, nor has one
    /// beside an error that is 0 or infinite.
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

    /// ln h and ln e, if the error has a logarithm.
    fn log(&self, level: &Level, norm: Norm) -> Option<Log> {
        let error = level.error(norm);
        (error > 0.0 && error.is_finite()).then(|| Log {
            h: self.refinement.ln_h(level.parameter),
            e: error.ln(),
        })
    }
}

/// A point of the refinement study on logarithmic axes.
#[derive(Clone, Copy, Debug)]
struct Log {
    /// ln h.
    h: f64,
    /// ln e.
    e: f64,
}

impl Log {
    /// The order with which the error falls from here to a finer level.
    fn order_to(self, finer: Self) -> f64 {
        (self.e - finer.e) / (self.h - finer.h)
    }
}

/// Why there is no study: one line with the remedy.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum NoRefinement {
    /// There is no level.
    Empty,
    /// There are more than are read.
    TooMany {
        /// The most that are.
        limit: usize,
    },
    /// A stiffness or a time step that cannot be one.
    Parameter {
        /// The parameter.
        parameter: f64,
    },
    /// Two levels have it.
    Twice {
        /// The parameter.
        parameter: f64,
    },
    /// An error that cannot be one.
    Error {
        /// The error.
        error: f64,
    },
}

impl fmt::Display for NoRefinement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("a refinement study has levels: give at least one"),
            Self::TooMany { limit } => write!(f, "more than {limit} levels: leave some out"),
            Self::Parameter { parameter } => write!(
                f,
                "{parameter:e} is no stiffness and no time step: give a positive number, not below 2.3e-308"
            ),
            Self::Twice { parameter } => write!(
                f,
                "two levels at {parameter:e}: give each stiffness or time step once"
            ),
            Self::Error { error } => {
                write!(f, "{error:e} is no relative error: give one of 0 or more")
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

/// A number that is there twice, of sorted ones.
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
