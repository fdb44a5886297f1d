//! The extrapolated error, in the limit of a vanishing refinement parameter.

use super::fit::count;
use super::{Level, LevelPlace, NoOrder, Norm, RefinementStudy};

/// The error at h → 0: a least-squares fit of e = e∞ + C hᵖ with a given order p (Richardson extrapolation).
///
/// The fit uses the complete levels from the coarsest to the one with the smallest error. On finer levels rounding
/// errors rise, so they are left out. A constant error stays in the data, such as a rounding floor or a spurious force:
/// e∞ measures it. Residuals are relative: the fit minimises the sum of ((e∞ + C hᵖ − e)/e)². It needs at least three
/// levels.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Limit {
    /// The extrapolated error e∞. A true value of 0 may yield a small negative number: see
    /// [`standard_error`](Self::standard_error).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{RefinementStudy, Norm, Refinement, Level};
    ///
    /// // Every force is one percent too great, in addition to the error of the springs.
    /// let levels = [1e2, 1e3, 1e4, 1e5].map(|k| Level::of_errors(k, 30, 0.01 + 5.0 / k, 1.0 / k));
    /// let study = RefinementStudy::new(Refinement::Stiffness, levels)?;
    /// assert!((study.limit(Norm::Largest, 1.0)?.error - 0.01).abs() < 1e-12);
    /// assert!(study.limit(Norm::Rms, 1.0)?.error.abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub error: f64,
    /// The standard error of e∞, from the residuals. An e∞ within about two standard errors of 0 is consistent with 0.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{RefinementStudy, Norm, Refinement, Level};
    ///
    /// let levels = [(1e4, 5.1e-4), (1e5, 4.9e-5), (1e6, 5.1e-6)].map(|(k, error)| Level::of_errors(k, 30, error, error));
    /// let limit = RefinementStudy::new(Refinement::Stiffness, levels)?.limit(Norm::Largest, 1.0)?;
    /// assert!(limit.error.abs() < 2.0 * limit.standard_error);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub standard_error: f64,
    /// The given order p.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{RefinementStudy, Norm, Refinement, Level};
    ///
    /// let levels = [0.1, 0.01, 0.001].map(|step| Level::of_errors(step, 30, step * step, step));
    /// let study = RefinementStudy::new(Refinement::TimeStep, levels)?;
    /// assert_eq!(study.limit(Norm::Largest, 2.0)?.order, 2.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub order: f64,
    /// The number of levels of the fit.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{RefinementStudy, Norm, Refinement, Level};
    ///
    /// let errors = [(1e2, 0.06), (1e3, 0.015), (1e4, 0.0105), (1e5, 0.0107)];
    /// let levels = errors.map(|(k, error)| Level::of_errors(k, 30, error, error));
    /// let study = RefinementStudy::new(Refinement::Stiffness, levels)?;
    /// // The finest level does not have the smallest error.
    /// assert_eq!(study.limit(Norm::Largest, 1.0)?.levels, 3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub levels: usize,
}

impl RefinementStudy {
    /// Returns the error at h → 0 for an order p. Use p = 1 for the stiffness of linear springs. For other parameters
    /// use the known order of the method, or the [observed order](super::Fit::order).
    ///
    /// # Errors
    /// [`NoOrder`] if the order is not positive and finite, if any complete level has an error of 0, or if fewer than
    /// three complete levels lead down to the smallest error. Errors must also fall from each level to the next.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{RefinementStudy, NoOrder, Norm, Refinement, Level};
    ///
    /// let levels = [0.4, 0.2, 0.1].map(|step| Level::of_errors(step, 30, 1e-3 + step * step, step));
    /// let study = RefinementStudy::new(Refinement::TimeStep, levels)?;
    /// assert!((study.limit(Norm::Largest, 2.0)?.error - 1e-3).abs() < 1e-15);
    /// assert_eq!(study.limit(Norm::Largest, 0.0), Err(NoOrder::Order { order: 0.0 }));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn limit(&self, norm: Norm, order: f64) -> Result<Limit, NoOrder> {
        if order <= 0.0 || !order.is_finite() {
            return Err(NoOrder::Order { order });
        }
        let places = self.places(norm);
        let whole = self.levels().iter().zip(places);
        let whole = whole.filter(|(_, place)| *place != LevelPlace::Incomplete);
        let mut levels: Vec<&Level> = Vec::new();
        for (level, place) in whole {
            if level.error(norm) == 0.0 {
                let parameter = level.parameter;
                return Err(NoOrder::Zero { parameter });
            }
            // An infinite error marks a level without a result, so it is left out.
            if place != LevelPlace::NoLogarithm {
                levels.push(level);
            }
        }
        let least = levels.iter().map(|level| level.error(norm));
        let least = least.fold(f64::INFINITY, f64::min);
        let last = levels.iter().position(|level| level.error(norm) <= least);
        levels.truncate(last.map_or(0, |last| last + 1));
        let few = NoOrder::Few {
            levels: levels.len(),
            least: 3,
        };
        let (Some(coarsest), true) = (levels.first(), levels.len() >= 3) else {
            return Err(few);
        };
        let falls = |pair: &&[&Level]| matches!(pair, [a, b] if a.error(norm) > b.error(norm));
        if let Some([_, level]) = levels.windows(2).find(|pair| !falls(pair)) {
            let parameter = level.parameter;
            return Err(NoOrder::Rising { parameter });
        }
        let ln_h = |level: &Level| self.refinement().ln_h(level.parameter);
        let begin = ln_h(coarsest);
        // Errors are relative to the smallest one, and h to the coarsest level, so that no term overflows.
        let terms = levels.iter().map(|level| {
            let error = level.error(norm);
            let share = least / error;
            let falling = (order * (ln_h(level) - begin)).exp() * (coarsest.error(norm) / error);
            (share, falling)
        });
        let sum = |of: fn((f64, f64)) -> f64| terms.clone().map(of).sum::<f64>();
        let (aa, ab, bb) = (
            sum(|(a, _)| a * a),
            sum(|(a, b)| a * b),
            sum(|(_, b)| b * b),
        );
        let (a, b) = (sum(|(a, _)| a), sum(|(_, b)| b));
        // The component of the falling term that is orthogonal to the constant term.
        let apart = bb - ab / aa * ab;
        let falling = (b - ab / aa * a) / apart;
        let rest = (a - falling * ab) / aa;
        let squares: f64 = terms
            .clone()
            .map(|(a, b)| rest * a + falling * b - 1.0)
            .map(|residual| residual * residual)
            .sum();
        let free = count(levels.len()) - 2.0;
        let spread = (squares / free * (bb / (aa * apart))).sqrt();
        let (error, standard_error) = (rest * least, spread * least);
        if !(error.is_finite() && standard_error.is_finite()) {
            return Err(NoOrder::Alike);
        }
        Ok(Limit {
            error,
            standard_error,
            order,
            levels: levels.len(),
        })
    }
}
