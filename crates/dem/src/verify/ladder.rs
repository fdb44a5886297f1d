//! A ladder of simulations of one pile: its errors at several stiffnesses or time steps, and the order in which they vanish.
//!
//! A code whose errors fall is not yet right: they must fall to 0, and as fast as its method says. With the exact
//! forces known, both are seen from a few simulations that differ in nothing but a parameter h.
//!
//! * h = 1/k of a [stiffness](Refinement::Stiffness) k, h = Δt of a [time step](Refinement::TimeStep) Δt. Rungs go from
//!   the coarsest, with the greatest h, to the finest.
//! * The error of a rung is the largest relative error of its contacts, or the root of their mean square
//!   ([`Norm`]): those of its [`Comparison`].
//! * The order observed between neighbouring rungs is p = ln(e₁/e₂)/ln(h₁/h₂). That of the ladder is the slope of the
//!   line ln e = ln C + p ln h through the rungs above the floor ([`Fit`]).
//! * What the error would be at h → 0 is e∞ of e = e∞ + C hᵖ ([`Limit`]): 0, as far as it is known, for a code that
//!   solves the problem it says.
//!
//! # The floor
//! An error falls until something else is greater: rounding, an iteration that stops early, a force that should not be
//! there. Which rungs are above that floor is decided by one rule ([`RungPlace`]). It begins behind the first rung, from the
//! coarsest on, from which no finer one falls with an order of ½ or more, nor, from the third rung on, of ⅔ or more of the
//! order with which errors fell from the coarsest down to it. Of this rung and the next one the lesser error is the height
//! of the floor: coarser rungs with less than three times that are near enough to be on it too, as long as two are left. So
//! a method of an order below ½ is taken for one that does not converge.

mod files;
mod fit;
mod limit;
mod read;
mod report;

pub use files::{LadderFile, LadderFiles, NoLadderFiles};
pub use fit::{Fit, NoOrder};
pub use limit::Limit;
pub use report::LadderReport;

use core::fmt;

use super::comparison::Comparison;

/// The most rungs of a ladder.
pub const MAX_RUNGS: usize = 1000;

/// What is refined from rung to rung.
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

/// A simulation of the ladder: its parameter, and what its comparison with the exact forces says.
///
/// # Examples
/// ```
/// use cannonpile_dem::verify::{Norm, Rung};
///
/// let rung = Rung::of_errors(1e6, 495, 4e-6, 1e-6);
/// assert!(rung.is_whole());
/// assert_eq!(rung.error(Norm::Rms), 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rung {
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

impl Rung {
    /// The rung of a comparison; pairs besides the contacts count as extra if they carry more than `tolerance` times the
    /// largest exact force.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile_dem::verify::{Comparison, Measured, Rung};
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let measured = [2, 3].map(|id| Measured::new([1, id], 0.46225016352102427));
    /// let rung = Rung::new(1e6, &Comparison::new(&packing, measured)?, 1e-6);
    /// assert_eq!((rung.matched, rung.missing, rung.largest_error), (2, 1, 0.0));
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

    /// A rung of which the errors are known, with all contacts measured.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Rung;
    ///
    /// let rung = Rung::of_errors(1e-3, 30, 2e-5, 1e-5);
    /// assert_eq!((rung.parameter, rung.matched), (1e-3, 30));
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
    /// use cannonpile_dem::verify::Rung;
    ///
    /// let rung = Rung::of_errors(10.0, 30, 0.1, 0.05);
    /// assert!(rung.is_whole() && !Rung { missing: 3, matched: 27, ..rung }.is_whole());
    /// ```
    #[must_use]
    pub const fn is_whole(&self) -> bool {
        self.matched > 0 && self.missing == 0 && self.extra == 0
    }

    /// The error in a norm.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Norm, Rung};
    ///
    /// let rung = Rung::of_errors(1e6, 30, 2e-5, 1e-5);
    /// assert_eq!(Norm::ALL.map(|norm| rung.error(norm)), [2e-5, 1e-5]);
    /// ```
    #[must_use]
    pub const fn error(&self, norm: Norm) -> f64 {
        match norm {
            Norm::Largest => self.largest_error,
            Norm::Rms => self.rms_error,
        }
    }
}

/// Where a rung is, as the order of the ladder sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RungPlace {
    /// Above the floor: it counts.
    Above,
    /// On the floor, where errors do not fall as they did: left out.
    Floor,
    /// Contacts are missing or extra, or none was measured: left out.
    Incomplete,
    /// Its error is 0 or infinite, and has no logarithm: left out.
    NoLogarithm,
}

impl RungPlace {
    /// The name, as in tables: `above`, `floor`, `incomplete` or `no logarithm`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::RungPlace;
    ///
    /// assert_eq!(RungPlace::Floor.name(), "floor");
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

/// Rungs with different parameters, from the coarsest to the finest: a pile simulated at several stiffnesses or time
/// steps.
///
/// # Examples
/// ```
/// use cannonpile_dem::verify::{Ladder, Norm, Refinement, Rung, RungPlace};
///
/// // Errors of 5/k, and below them a floor of rounding that rises with k.
/// let rungs = [1e3, 1e4, 1e5, 1e6, 1e7].map(|k| {
///     let error = 5.0 / k + 1e-12 * k;
///     Rung::of_errors(k, 30, error, error / 3.0)
/// });
/// let ladder = Ladder::new(Refinement::Stiffness, rungs)?;
/// let fit = ladder.fit(Norm::Largest)?;
/// assert!((fit.order - 1.0).abs() < 1e-3 && (fit.constant / 5.0 - 1.0).abs() < 0.01);
/// assert_eq!(fit.rungs, 3);
/// assert_eq!(ladder.places(Norm::Largest).last(), Some(&RungPlace::Floor));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Ladder {
    refinement: Refinement,
    rungs: Vec<Rung>,
}

impl Ladder {
    /// The ladder of some rungs, in whatever order they come.
    ///
    /// # Errors
    /// [`NoLadder`] for no rungs or more than [`MAX_RUNGS`], a parameter that is not positive and normal or that is there
    /// twice, and an error that is negative or no number.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Ladder, NoLadder, Refinement, Rung};
    ///
    /// let rungs = [1e3, 1e5, 1e4].map(|k| Rung::of_errors(k, 30, 5.0 / k, 2.0 / k));
    /// let ladder = Ladder::new(Refinement::Stiffness, rungs)?;
    /// assert_eq!(ladder.rungs().iter().map(|rung| rung.parameter).collect::<Vec<_>>(), [1e3, 1e4, 1e5]);
    /// let twice = Ladder::new(Refinement::Stiffness, [rungs[0], rungs[0]]);
    /// assert_eq!(twice, Err(NoLadder::Twice { parameter: 1e3 }));
    /// # Ok::<(), NoLadder>(())
    /// ```
    pub fn new(
        refinement: Refinement,
        rungs: impl IntoIterator<Item = Rung>,
    ) -> Result<Self, NoLadder> {
        let mut rungs: Vec<Rung> = rungs.into_iter().take(MAX_RUNGS + 1).collect();
        if rungs.is_empty() {
            return Err(NoLadder::Empty);
        }
        if rungs.len() > MAX_RUNGS {
            return Err(NoLadder::TooMany { limit: MAX_RUNGS });
        }
        for rung in &rungs {
            check_parameter(rung.parameter)?;
            let predicted = rung.predicted_error;
            for error in Norm::ALL
                .map(|norm| rung.error(norm))
                .into_iter()
                .chain(predicted)
            {
                if error.is_nan() || error < 0.0 {
                    return Err(NoLadder::Error { error });
                }
            }
        }
        // By the parameter itself: two that are next to each other may have one logarithm.
        rungs.sort_by(|a, b| match refinement {
            Refinement::Stiffness => a.parameter.total_cmp(&b.parameter),
            Refinement::TimeStep => b.parameter.total_cmp(&a.parameter),
        });
        let parameters = rungs.iter().map(|rung| rung.parameter);
        match repeated(parameters) {
            Some(parameter) => Err(NoLadder::Twice { parameter }),
            None => Ok(Self { refinement, rungs }),
        }
    }

    /// The ladder with what theory says of the largest error at each parameter.
    ///
    /// # Errors
    /// [`NoLadder::Error`] for a prediction that is negative or no number.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Ladder, NoLadder, Refinement, Rung};
    ///
    /// let rungs = [1e3, 1e4].map(|k| Rung::of_errors(k, 30, 5.0 / k, 2.0 / k));
    /// let ladder = Ladder::new(Refinement::Stiffness, rungs)?.predicted(|k| 4.8 / k)?;
    /// assert_eq!(ladder.rungs()[0].predicted_error, Some(4.8e-3));
    /// # Ok::<(), NoLadder>(())
    /// ```
    pub fn predicted(self, error: impl Fn(f64) -> f64) -> Result<Self, NoLadder> {
        let rungs = self.rungs.into_iter().map(|rung| Rung {
            predicted_error: Some(error(rung.parameter)),
            ..rung
        });
        Self::new(self.refinement, rungs)
    }

    /// What is refined.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Ladder, NoLadder, Refinement, Rung};
    ///
    /// let ladder = Ladder::new(Refinement::TimeStep, [Rung::of_errors(1e-3, 30, 0.1, 0.05)])?;
    /// assert_eq!(ladder.refinement(), Refinement::TimeStep);
    /// # Ok::<(), NoLadder>(())
    /// ```
    #[must_use]
    pub const fn refinement(&self) -> Refinement {
        self.refinement
    }

    /// The rungs, from the coarsest, with the greatest h, to the finest.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Ladder, NoLadder, Refinement, Rung};
    ///
    /// let rungs = [1e-4, 1e-3].map(|step| Rung::of_errors(step, 30, step, step / 3.0));
    /// let ladder = Ladder::new(Refinement::TimeStep, rungs)?;
    /// assert_eq!(ladder.rungs()[0].parameter, 1e-3);
    /// # Ok::<(), NoLadder>(())
    /// ```
    #[must_use]
    pub fn rungs(&self) -> &[Rung] {
        &self.rungs
    }

    /// The orders observed: p = ln(e₁/e₂)/ln(h₁/h₂) of each rung and the one before it. The first has none, nor has one
    /// beside an error that is 0 or infinite.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Ladder, NoLadder, Norm, Refinement, Rung};
    ///
    /// let rungs = [0.1, 0.01].map(|step| Rung::of_errors(step, 30, step * step, 0.0));
    /// let ladder = Ladder::new(Refinement::TimeStep, rungs)?;
    /// let [none, order] = ladder.orders(Norm::Largest)[..] else { panic!() };
    /// assert!(none.is_none() && (order.unwrap() - 2.0).abs() < 1e-12);
    /// assert_eq!(ladder.orders(Norm::Rms), [None, None]);
    /// # Ok::<(), NoLadder>(())
    /// ```
    #[must_use]
    pub fn orders(&self, norm: Norm) -> Vec<Option<f64>> {
        let logs: Vec<_> = self.rungs.iter().map(|rung| self.log(rung, norm)).collect();
        let between = logs.windows(2).map(|pair| match pair {
            [Some(coarse), Some(fine)] => Some(coarse.order_to(*fine)).filter(|p| p.is_finite()),
            _ => None,
        });
        core::iter::once(None).chain(between).collect()
    }

    /// ln h and ln e, if the error has a logarithm.
    fn log(&self, rung: &Rung, norm: Norm) -> Option<Log> {
        let error = rung.error(norm);
        (error > 0.0 && error.is_finite()).then(|| Log {
            h: self.refinement.ln_h(rung.parameter),
            e: error.ln(),
        })
    }
}

/// A point of the ladder on logarithmic axes.
#[derive(Clone, Copy, Debug)]
struct Log {
    /// ln h.
    h: f64,
    /// ln e.
    e: f64,
}

impl Log {
    /// The order with which the error falls from here to a finer rung.
    fn order_to(self, finer: Self) -> f64 {
        (self.e - finer.e) / (self.h - finer.h)
    }
}

/// Why there is no ladder: one line with the remedy.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum NoLadder {
    /// There is no rung.
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
    /// Two rungs have it.
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

impl fmt::Display for NoLadder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("a ladder has rungs: give at least one"),
            Self::TooMany { limit } => write!(f, "more than {limit} rungs: leave some out"),
            Self::Parameter { parameter } => write!(
                f,
                "{parameter:e} is no stiffness and no time step: give a positive number, not below 2.3e-308"
            ),
            Self::Twice { parameter } => write!(
                f,
                "two rungs at {parameter:e}: give each stiffness or time step once"
            ),
            Self::Error { error } => {
                write!(f, "{error:e} is no relative error: give one of 0 or more")
            }
        }
    }
}

impl core::error::Error for NoLadder {}

fn check_parameter(parameter: f64) -> Result<(), NoLadder> {
    if parameter.is_normal() && parameter > 0.0 {
        Ok(())
    } else {
        Err(NoLadder::Parameter { parameter })
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
