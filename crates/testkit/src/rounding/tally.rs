//! How many roundings were judged, and how many were wrong.

use cannonpile::scalar::{NearestFloat, Surd};
use num_rational::BigRational;

use crate::judge::{Float, Value, Verdict, is_nearest};

/// The verdicts about one quantity. A case is an exact value, rounded to `f64` and to `f32`; of what is filled into
/// slices, each float is one.
#[derive(Debug, Default)]
pub struct Tally {
    /// How many values were rounded.
    pub cases: u64,
    /// How many of them to a float that is not the nearest, in one format or both.
    pub wrong: u64,
    /// The first of those.
    pub witness: Option<String>,
}

impl Tally {
    /// Rounds a value and judges it.
    pub fn meet(&mut self, exact: &Surd) {
        let value = Value::of(exact);
        let (double, single) = (exact.nearest::<f64>(), exact.nearest::<f32>());
        self.count(is_nearest(double, &value).and_then(|()| is_nearest(single, &value)));
    }

    /// Rounds a rational by itself and as a surd, and judges both.
    pub fn meet_rational(&mut self, exact: &BigRational) {
        let value = Value::of(&exact.clone().into());
        self.count(
            is_nearest(f64::nearest_to_rational(exact), &value)
                .and_then(|()| is_nearest(f32::nearest_to_rational(exact), &value)),
        );
        self.meet(&exact.clone().into());
    }

    /// Judges a float that was rounded before; `None` stands for an infinite one.
    pub fn meet_float<F: Float>(&mut self, got: Option<F>, exact: &Surd) {
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
