//! The digits of the numbers of a table.

use super::finding::{Finding, FindingKind};
use super::measured::Measured;

/// The number of rows that are looked at.
const ROWS: u64 = 10_000;

/// The largest number of digits that is called few.
const FEW: usize = 9;

/// The largest numbers of digits, and of digits after the decimal point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Digits {
    rows: u64,
    most: usize,
    decimals: usize,
}

impl Digits {
    pub(super) fn see(&mut self, measured: &Measured) {
        if self.rows == ROWS || self.most > FEW {
            return;
        }
        self.rows += 1;
        let force = Some(measured.force).filter(|_| !measured.is_length);
        let numbers = measured.vector.into_iter().flatten().chain(force);
        for number in numbers.filter(|number| *number != 0.0) {
            // Without an exponent.
            let text = number.abs().to_string();
            let (whole, decimals) = text.split_once('.').unwrap_or((&text, ""));
            let digits = format!("{whole}{decimals}").trim_matches('0').len();
            self.most = self.most.max(digits);
            self.decimals = self.decimals.max(decimals.len());
        }
    }

    /// Returns the finding of few digits, if they explain a relative error of a force or a difference in N.
    pub(super) fn explain(self, error: f64, difference: f64) -> Option<Finding> {
        let last = |digits: usize| (0..digits).fold(1.0, |unit, _| unit / 10.0);
        // Half a unit of the last digit, and the length of three halves.
        let is_explained = error <= 5.0 * last(self.most) || difference <= last(self.decimals);
        let digits = self.most;
        let plural = if digits == 1 { "" } else { "s" };
        ((1..=FEW).contains(&digits) && is_explained).then(|| {
            let text = format!("the numbers have only {digits} significant digit{plural}, which explains the errors: write all 17 (in LAMMPS by dump_modify format float %.17g)");
            Finding::new(FindingKind::Digits, text)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_counted_as_they_are_written() {
        let seen = |forces: &[f64]| {
            let mut digits = Digits::default();
            for force in forces {
                digits.see(&Measured::new([1, 2], *force));
            }
            digits
        };
        let six = seen(&[0.46225, 1.38675, -0.000_123_457]);
        assert_eq!((six.most, six.decimals), (6, 9));
        assert!(
            six.explain(4e-6, 1.0)
                .is_some_and(|six| six.text.contains(" 6 significant digits"))
        );
        assert!(six.explain(6e-6, 1e-3).is_none());
        let fixed = seen(&[0.4623, 12.0, 123.4567, 0.0]);
        assert_eq!((fixed.most, fixed.decimals), (7, 4));
        assert!(fixed.explain(1e-3, 5e-5).is_some());
        assert!(seen(&[0.1 + 0.2]).explain(0.0, 0.0).is_none());
        assert!(seen(&[]).explain(0.0, 0.0).is_none());
    }
}
