//! Counts of checked roundings and of wrong ones.

use cannonpile::scalar::{CorrectlyRounded, Surd};
use num_rational::BigRational;

use crate::judge::{Float, Value, Verdict, is_nearest};

/// The results for one quantity. A case is an exact value, rounded to `f64` and to `f32`. In slices, each float is a case.
#[derive(Debug, Default)]
pub struct Tally {
    /// The number of rounded values.
    pub cases: u64,
    /// The number of values with a wrong float, in one format or both.
    pub wrong: u64,
    /// A description of the first wrong value.
    pub witness: Option<String>,
}

impl Tally {
    /// Rounds a value and checks it.
    pub fn check(&mut self, exact: &Surd) {
        let value = Value::of(exact);
        let (double, single) = (exact.nearest::<f64>(), exact.nearest::<f32>());
        self.count(is_nearest(double, &value).and_then(|()| is_nearest(single, &value)));
    }

    /// Rounds a rational directly and as a surd, and checks both.
    pub fn check_rational(&mut self, exact: &BigRational) {
        let value = Value::of(&exact.clone().into());
        self.count(
            is_nearest(f64::nearest_to_rational(exact), &value)
                .and_then(|()| is_nearest(f32::nearest_to_rational(exact), &value)),
        );
        self.check(&exact.clone().into());
    }

    /// Checks an already rounded float. `None` stands for infinity.
    pub fn check_float<F: Float>(&mut self, got: Option<F>, exact: &Surd) {
        self.count(is_nearest(got, &Value::of(exact)));
    }

    fn count(&mut self, verdict: Verdict) {
        self.cases += 1;
        if let Err(witness) = verdict {
            self.wrong += 1;
            self.witness.get_or_insert(witness);
        }
    }
}
