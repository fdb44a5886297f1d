//! The verdict on a comparison at an accepted error, with its reason.

use core::fmt;

use super::Comparison;
use crate::verify::finding::{counted, short};
use crate::verify::friction::WithFriction;
use crate::verify::tally::Judged;

impl Comparison {
    /// Returns the reason why the comparison is not accepted, or the error up to which it is.
    pub(in crate::verify) fn reason(&self, tolerance: f64) -> String {
        let error = short(self.largest_error().unwrap_or(0.0));
        if self.accepted(tolerance) {
            let floor = match self.floor() {
                0 => String::new(),
                floor => format!(" and {floor} with the floor"),
            };
            let agree = counted(self.matched(), "contact") + &floor;
            return format!("{agree} agree within {tolerance:?}, the largest error is {error:?}");
        }
        let contacts = format!("of {}", counted(self.contacts(), "contact"));
        let off = format!("{contacts} ARE off by more than {tolerance:?}, by up to {error:?}");
        let reasons = [
            (self.missing(), contacts + " ARE missing"),
            (
                self.extra(tolerance),
                "of the other pairs HAVE a force".to_owned(),
            ),
            (self.beyond(tolerance), off),
        ];
        let reasons = reasons.into_iter().filter(|(count, _)| *count > 0);
        let reasons = reasons.map(|(count, reason)| {
            let [are, have] = if count == 1 {
                ["is", "has"]
            } else {
                ["are", "have"]
            };
            format!(
                "{count} {}",
                reason.replace("ARE", are).replace("HAVE", have)
            )
        });
        let reasons: Vec<_> = reasons.collect();
        match self.findings(tolerance).first() {
            Some(first) if reasons.is_empty() => first.to_string(),
            _ => reasons.join("; "),
        }
    }

    /// Returns whether no contact is missing, no pair is extra or contradictory, and every relative error is at most
    /// `tolerance`, also that of the floor.
    ///
    /// If one bottom sphere has a force of the floor, every other one that presses on the floor needs one too. On a rough floor all
    /// need one; the tangential force of every measured contact must be known, and the whole force of the floor. No sphere above
    /// may touch it. The net moment is not part of the verdict: it follows from the forces.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let measured = [2, 3, 4].map(|id| Measured::new([1, id], 0.462));
    /// let comparison = Comparison::new(&packing, measured)?;
    /// assert!(comparison.accepted(1e-3) && !comparison.accepted(1e-4));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn accepted(&self, tolerance: f64) -> bool {
        let errors = [
            self.largest_error(),
            self.floor_error(),
            self.tangential_error(),
            self.floor_friction_error(),
        ];
        self.missing() == 0
            && self.0.fallen(tolerance).next().is_none()
            && self.0.off_floor.is_none()
            && self.0.friction.as_ref().is_none_or(WithFriction::is_known)
            && self.extra(tolerance) == 0
            && self.contradictory(tolerance) == 0
            && errors.into_iter().flatten().all(|error| error <= tolerance)
    }
}

impl fmt::Display for Comparison {
    /// Writes one line, for the message of an assertion.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Judged {
            contacts, missing, ..
        } = self.0;
        let (matched, extra) = (self.matched(), self.0.strays.len());
        write!(
            f,
            "{matched} of {contacts} contacts measured, {missing} missing, {extra} pairs besides them"
        )?;
        for (name, error) in [
            ("largest error", self.largest_error()),
            ("rms", self.rms_error()),
            (
                "of the floor",
                self.floor_error().filter(|error| *error > 0.0),
            ),
            ("of tangential forces", self.tangential_error()),
            ("of the friction of the floor", self.floor_friction_error()),
        ] {
            if let Some(error) = error {
                write!(
                    f,
                    "{} {name} {error:e}",
                    if name == "rms" { "," } else { ";" }
                )?;
            }
        }
        if let Some(worst) = self.worst() {
            write!(f, "; worst: {worst}")?;
        }
        if let Some(missing) = self.0.first_missing.first() {
            write!(f, "; missing: {missing}")?;
        }
        if let Some(extra) = self.0.greatest_strays.first() {
            write!(f, "; extra: {extra}")?;
        }
        Ok(())
    }
}
