//! The fitted line through the levels above the floor, on logarithmic axes.

use core::fmt;

use super::{LevelPlace, Log, Norm, RefinementStudy};

/// The smallest order at which an error counts as falling.
const MIN_ORDER: f64 = 0.5;

/// The share of the order so far that the error must keep until the floor is reached.
const KEPT_ORDER: f64 = 2.0 / 3.0;

/// An error below this multiple of the floor is partly due to the floor.
const NEAR: f64 = 3.0;

/// The fitted line e = C hᵖ through the levels above the floor: least squares of ln e = ln C + p ln h, with equal
/// weights.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Fit {
    /// The observed order p.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{RefinementStudy, Norm, Refinement, Level};
    ///
    /// let levels = [1e-2, 1e-3, 1e-4].map(|step| Level::of_errors(step, 30, 7.0 * step * step, step));
    /// let study = RefinementStudy::new(Refinement::TimeStep, levels)?;
    /// assert!((study.fit(Norm::Largest)?.order - 2.0).abs() < 1e-12);
    /// assert!((study.fit(Norm::Rms)?.order - 1.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub order: f64,
    /// The standard error of the order, √(Σr²/(n − 2)/Σ(ln h − mean)²), with the residuals r of n levels. For two
    /// levels it is not defined, because the line goes through both.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{RefinementStudy, Norm, Refinement, Level};
    ///
    /// let levels = [(1e4, 5.1e-4), (1e5, 4.9e-5), (1e6, 5.1e-6)].map(|(k, error)| Level::of_errors(k, 30, error, error));
    /// let all = RefinementStudy::new(Refinement::Stiffness, levels)?.fit(Norm::Largest)?;
    /// assert!((0.005..0.015).contains(&all.standard_error.unwrap()));
    /// let two = RefinementStudy::new(Refinement::Stiffness, levels.into_iter().take(2))?;
    /// assert_eq!(two.fit(Norm::Largest)?.standard_error, None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub standard_error: Option<f64>,
    /// The constant C, the error at h = 1. For springs and p = 1 it has the unit of the stiffness. It is infinite or 0
    /// if the value overflows or underflows.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{RefinementStudy, Norm, Refinement, Level};
    ///
    /// let levels = [1e4, 1e5].map(|k| Level::of_errors(k, 30, 4.8 / k, 1.0 / k));
    /// let fit = RefinementStudy::new(Refinement::Stiffness, levels)?.fit(Norm::Largest)?;
    /// assert!((fit.constant - 4.8).abs() < 1e-10);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub constant: f64,
    /// The root mean square of ln e − ln(C hᵖ). A value of 0.01 means that the levels deviate from the line by about
    /// 1%.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{RefinementStudy, Norm, Refinement, Level};
    ///
    /// let levels = [(1e4, 5.1e-4), (1e5, 4.9e-5), (1e6, 5.1e-6)].map(|(k, error)| Level::of_errors(k, 30, error, error));
    /// let fit = RefinementStudy::new(Refinement::Stiffness, levels)?.fit(Norm::Largest)?;
    /// assert!((0.01..0.03).contains(&fit.residual));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub residual: f64,
    /// The number of levels above the floor.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{RefinementStudy, Norm, Refinement, Level};
    ///
    /// let levels = [1e-2, 1e-3, 1e-4, 1e-5].map(|step: f64| Level::of_errors(step, 30, step.max(1e-4), step));
    /// let study = RefinementStudy::new(Refinement::TimeStep, levels)?;
    /// assert_eq!((study.fit(Norm::Largest)?.levels, study.fit(Norm::Rms)?.levels), (2, 4));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub levels: usize,
}

impl Fit {
    /// Returns the error on the line at a refinement parameter h: C hᵖ.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{RefinementStudy, Norm, Refinement, Level};
    ///
    /// let levels = [1e-2, 1e-3].map(|step| Level::of_errors(step, 30, 7.0 * step, step));
    /// let fit = RefinementStudy::new(Refinement::TimeStep, levels)?.fit(Norm::Largest)?;
    /// assert!((fit.at(1e-5) / 7e-5 - 1.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn at(&self, h: f64) -> f64 {
        self.constant * h.powf(self.order)
    }

    /// Returns the least-squares line through these points.
    fn through(points: &[Log]) -> Result<Self, NoOrder> {
        let few = NoOrder::Few {
            levels: points.len(),
            least: 2,
        };
        if points.len() < 2 {
            return Err(few);
        }
        let count = count(points.len());
        let mean = |of: fn(&Log) -> f64| points.iter().map(of).sum::<f64>() / count;
        let middle = Log {
            h: mean(|point| point.h),
            e: mean(|point| point.e),
        };
        let apart = points
            .iter()
            .map(|point| (point.h - middle.h, point.e - middle.e));
        let spread: f64 = apart.clone().map(|(h, _)| h * h).sum();
        let slope: f64 = apart.clone().map(|(h, e)| h * e).sum();
        let order = slope / spread;
        if !order.is_finite() {
            return Err(NoOrder::Alike);
        }
        let squares: f64 = apart.map(|(h, e)| (e - order * h) * (e - order * h)).sum();
        let free = count - 2.0;
        Ok(Self {
            order,
            standard_error: (free > 0.0).then(|| (squares / free / spread).sqrt()),
            constant: (middle.e - order * middle.h).exp(),
            residual: (squares / count).sqrt(),
            levels: points.len(),
        })
    }
}

impl RefinementStudy {
    /// Returns the position of each level relative to the floor. The order is fitted to the levels above it.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{RefinementStudy, Norm, Refinement, Level, LevelPlace};
    ///
    /// let levels = [(10.0, 0.2), (1e3, 2e-3), (1e4, 2e-4), (1e5, 5e-5), (1e6, 6e-5)];
    /// let mut levels = levels.map(|(k, error)| Level::of_errors(k, 30, error, error));
    /// levels[0].missing = 3;
    /// let study = RefinementStudy::new(Refinement::Stiffness, levels)?;
    /// let places = study.places(Norm::Largest);
    /// assert_eq!(places, [LevelPlace::Incomplete, LevelPlace::Above, LevelPlace::Above, LevelPlace::Floor, LevelPlace::Floor]);
    /// # Ok::<(), cannonpile_dem::verify::NoRefinement>(())
    /// ```
    #[must_use]
    pub fn places(&self, norm: Norm) -> Vec<LevelPlace> {
        let logs: Vec<_> = self.logs(norm).collect();
        let points: Vec<Log> = logs.iter().filter_map(|log| log.ok()).collect();
        let above = above(&points);
        let mut met = 0;
        let mut place = || {
            met += 1;
            if met <= above {
                LevelPlace::Above
            } else {
                LevelPlace::Floor
            }
        };
        let places = logs
            .into_iter()
            .map(|log| log.map_or_else(|place| place, |_| place()));
        places.collect()
    }

    /// Returns the line through the levels above the floor.
    ///
    /// # Errors
    /// [`NoOrder`] for fewer than two such levels, and for parameters too close to each other to show a slope.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{RefinementStudy, NoOrder, Norm, Refinement, Level};
    ///
    /// let levels = [1e4, 1e5, 1e6].map(|k| Level::of_errors(k, 30, 4.8 / k, 0.01));
    /// let study = RefinementStudy::new(Refinement::Stiffness, levels)?;
    /// assert!((study.fit(Norm::Largest)?.order - 1.0).abs() < 1e-12);
    /// // These errors do not fall: all levels but the first are on the floor.
    /// assert_eq!(study.fit(Norm::Rms), Err(NoOrder::Few { levels: 1, least: 2 }));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn fit(&self, norm: Norm) -> Result<Fit, NoOrder> {
        let mut points: Vec<Log> = self.logs(norm).filter_map(Result::ok).collect();
        points.truncate(above(&points));
        Fit::through(&points)
    }

    /// Returns for each level its point, or the reason why it is left out.
    fn logs(&self, norm: Norm) -> impl Iterator<Item = Result<Log, LevelPlace>> {
        self.levels().iter().map(move |level| {
            if level.is_whole() {
                self.log(level, norm).ok_or(LevelPlace::NoLogarithm)
            } else {
                Err(LevelPlace::Incomplete)
            }
        })
    }
}

/// Returns the number of points above the floor, by the rule in [`refinement`](super).
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

#[expect(clippy::cast_precision_loss, reason = "at most a thousand levels")]
pub(super) fn count(levels: usize) -> f64 {
    levels as f64
}

/// The reason why a refinement study has no order or no limit: one line with the remedy.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum NoOrder {
    /// Too few levels.
    Few {
        /// The number of levels above the floor; for a limit, the number down to the smallest error.
        levels: usize,
        /// The number of levels that are required.
        least: usize,
    },
    /// Parameters too close to each other to show a slope.
    Alike,
    /// Errors that do not fall from level to level down to the smallest one.
    Rising {
        /// The stiffness or the time step of the level whose error is not below that of the coarser level.
        parameter: f64,
    },
    /// An error of 0 among the levels of the limit.
    Zero {
        /// The stiffness or the time step of this level.
        parameter: f64,
    },
    /// An order that is not positive and finite.
    Order {
        /// The order.
        order: f64,
    },
}

impl fmt::Display for NoOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Few { levels, least } => write!(
                f,
                "only {levels} of the {least} levels needed have all contacts and a falling error: add coarser levels, which are \
                 farther above the floor"
            ),
            Self::Alike => f.write_str(
                "the parameters are too close to each other: choose them a factor of 2 or more apart",
            ),
            Self::Rising { parameter } => write!(
                f,
                "the error at {parameter:e} is not below that of the coarser level: only falling errors have a limit"
            ),
            Self::Zero { parameter } => write!(
                f,
                "the error at {parameter:e} is 0, so the limit cannot be fitted: leave this level out"
            ),
            Self::Order { order } => write!(f, "{order:e} is not an order of accuracy: give a positive number"),
        }
    }
}

impl core::error::Error for NoOrder {}
