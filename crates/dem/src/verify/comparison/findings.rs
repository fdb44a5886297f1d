//! The explanations of the differences of a comparison.

use super::Comparison;
use crate::verify::finding::{Finding, FindingKind, counted};
use crate::verify::measured::over;

impl Comparison {
    /// Returns the common factor between measured and exact forces, if it differs from 1 by more than `tolerance`, and takes away
    /// most of the error. Forces of 0 are left out. `None` for fewer than two contacts with a force.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // A simulation at g = 9.81 m/s², compared with a pile at 1 m/s².
    /// let measured = [2, 3, 4].map(|id| Measured::new([1, id], 9.81 * 0.462250163));
    /// let comparison = Comparison::new(&packing, measured)?;
    /// assert!((comparison.common_factor(1e-6).unwrap() - 9.81).abs() < 1e-6);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn common_factor(&self, tolerance: f64) -> Option<f64> {
        Some(self.0.symptoms.factor(tolerance)?.0)
    }

    /// Explains the differences: one wrong factor, swapped axes, a missing layer (see [`Finding`]). The list
    /// is empty if the comparison is accepted at `tolerance`.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, FindingKind, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let weighed = [2, 3, 4].map(|id| Measured::new([1, id], 9.81 * 0.46225016352102427));
    /// let comparison = Comparison::new(&packing, weighed)?;
    /// let [finding] = &comparison.findings(1e-6)[..] else { panic!() };
    /// assert_eq!(finding.kind, FindingKind::Factor);
    /// assert!(finding.text.starts_with("all forces are 9.81 times the exact ones"));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn findings(&self, tolerance: f64) -> Vec<Finding> {
        if self.accepted(tolerance) {
            return Vec::new();
        }
        // Without a matched contact there is no error to explain.
        let error = self.largest_error().unwrap_or(0.0);
        let digits = self.0.symptoms.digits.explain(error, self.0.difference);
        let mut findings = match digits.filter(|_| error > tolerance) {
            Some(digits) => vec![digits],
            None => self.0.symptoms.findings(tolerance),
        };
        let pairs = self.contradictory(tolerance);
        findings.extend((pairs > 0).then(|| {
            let text = format!("two rows disagree on the force of {pairs} of the pairs: does the table hold several steps?");
            Finding::new(FindingKind::Contradiction, text)
        }));
        if !findings.iter().any(Finding::hides_others) {
            findings.extend(self.of_forces(error, tolerance));
        }
        findings.extend(self.0.off_floor.map(|(spheres, first)| {
            let spheres = counted(spheres, "bottom sphere");
            let text = format!("the force of the floor is missing below {spheres}, first sphere {first}: do they touch the floor?");
            Finding::new(FindingKind::OffFloor, text)
        }));
        let fallen: Vec<u64> = self.0.fallen(tolerance).collect();
        findings.extend(fallen.first().map(|first| {
            let (others, are) = match fallen.len() {
                1 => ("touches".to_owned(), "is"),
                2 => ("and another touch".to_owned(), "are"),
                more => (format!("and {} others touch", more - 1), "are"),
            };
            let text = format!("sphere {first} {others} the floor, but {are} above the bottom layer: has the pile fallen?");
            Finding::new(FindingKind::Fallen, text)
        }));
        findings
    }

    /// Returns the explanations of the values of the forces: the first that fits.
    fn of_forces(&self, error: f64, tolerance: f64) -> Vec<Finding> {
        let (judged, is_right) = (&self.0, error <= tolerance);
        let mut findings = Vec::new();
        let is_soft = !is_right && judged.loads.may_be_soft(error);
        if let Some(stiffness) = judged.stiffness.filter(|_| is_soft) {
            let text = format!(
                "springs of {stiffness:.2e} N/m explain the errors: they are too soft; the errors shrink as the stiffness grows"
            );
            findings.push(Finding::new(FindingKind::Springs, text));
        } else if let Some(friction) = &judged.friction {
            let factor = judged.symptoms.factor(tolerance);
            let explains =
                |(factor, left): &(f64, f64)| friction.has_factor(*factor, left.max(tolerance));
            if !factor.as_ref().is_some_and(explains) {
                findings = friction.findings(tolerance, is_right);
            }
            let of_contacts = [FindingKind::Moment, FindingKind::Friction];
            if !findings
                .iter()
                .any(|finding| of_contacts.contains(&finding.kind))
            {
                findings.splice(0..0, factor.map(Finding::factor));
            }
        } else if !is_right {
            findings = judged.loads.findings(&judged.symptoms, error, tolerance);
        }
        // A cause that explains the contacts explains the floor too.
        let floor = self.floor_error().filter(|error| *error > tolerance);
        if let Some(error) = floor.filter(|_| is_right || findings.is_empty()) {
            let spheres = over(&judged.floor_errors, tolerance);
            let text = format!(
                "the normal force of the floor is wrong at {spheres} of the bottom spheres, by up to {error:.1e} of the exact \
                 force: are they held in place by other means?"
            );
            findings.push(Finding::new(FindingKind::Floor, text));
        }
        findings
    }
}
