//! Roots are rounded correctly, to nearest with ties to even. The reference is [`crate::judge`].

use arbitrary::Unstructured;
use cannonpile::scalar::{CorrectlyRounded, Surd};
use num_bigint::Sign;
use num_traits::Zero;

use super::{Checked, Failure, same};
use crate::generators::number::{self, ratio};
use crate::judge::{self, Float, Value};

/// c·√r is rounded correctly to both formats.
pub fn of_a_root(u: &mut Unstructured<'_>) -> Checked {
    let (c, r) = number::root(u)?;
    let surd = Surd::new(c.clone(), r.clone())?;
    nearest(&surd, &Value::root(&c, &r))
}

/// A rational is rounded correctly to both formats. A float is rounded to itself.
pub fn of_a_rational(u: &mut Unstructured<'_>) -> Checked {
    let r = number::rational(u)?;
    let value = Value::root(&r, &ratio(1, 1));
    is_nearest(f64::nearest_to_rational(&r), &value)?;
    is_nearest(f32::nearest_to_rational(&r), &value)?;
    let x = number::float(u)?;
    let back = f64::nearest_to_rational(&number::exactly(x));
    same("a float, rounded,", &back, &Some(x))
}

/// `surd` has this value and is rounded correctly to both formats.
pub fn nearest(surd: &Surd, value: &Value) -> Checked {
    let square = value.square();
    same("the square", &surd.square(), &square)?;
    let sign = match (square.is_zero(), value.is_negative()) {
        (true, _) => Sign::NoSign,
        (false, true) => Sign::Minus,
        (false, false) => Sign::Plus,
    };
    same("the sign", &surd.sign(), &sign)?;
    is_nearest(surd.nearest::<f64>(), value)?;
    is_nearest(surd.nearest::<f32>(), value)
}

/// Tells whether `got` is the correctly rounded value. `None` stands for infinity.
fn is_nearest<F: Float>(got: Option<F>, value: &Value) -> Checked {
    judge::is_nearest(got, value).map_err(Failure::Refuted)
}

#[cfg(test)]
mod injected_faults {
    use super::*;
    use crate::generators::number::{exactly, power};

    fn rounds_to(got: Option<f64>, value: &Value) -> bool {
        is_nearest(got, value).is_ok()
    }

    #[test]
    fn the_next_float_is_caught() {
        for (c, r) in [(1, 2), (-7, 3), (1, 1_000_003)] {
            let value = Value::root(&ratio(c, 1), &ratio(r, 1));
            let x = Surd::new(ratio(c, 1), ratio(r, 1)).unwrap().nearest();
            let x: f64 = x.unwrap();
            assert!(rounds_to(Some(x), &value));
            for wrong in [x.next_up(), x.next_down(), -x, f64::INFINITY, f64::NAN] {
                assert!(!rounds_to(Some(wrong), &value), "{wrong} for {value:?}");
            }
            assert!(!rounds_to(None, &value));
        }
    }

    #[test]
    fn a_tie_to_odd_is_caught() {
        let tie = (exactly(1.0) + exactly(1.0_f64.next_up())) / ratio(2, 1);
        let value = Value::root(&tie, &ratio(1, 1));
        assert!(rounds_to(Some(1.0), &value));
        assert!(!rounds_to(Some(1.0_f64.next_up()), &value));
        let above = Value::root(&(tie + power(2, -300)), &ratio(1, 1));
        assert!(!rounds_to(Some(1.0), &above));
    }

    #[test]
    fn a_wrong_overflow_is_caught() {
        let largest = Value::root(&exactly(f64::MAX), &ratio(1, 1));
        let beyond = Value::root(&power(2, 1024), &ratio(1, 1));
        let [finite, infinite] = [Some(f64::MAX), None];
        assert!(rounds_to(finite, &largest) && !rounds_to(infinite, &largest));
        assert!(rounds_to(infinite, &beyond) && !rounds_to(finite, &beyond));
    }

    #[test]
    fn a_subnormal_flushed_to_zero_is_caught() {
        let least = Value::root(&exactly(f64::from_bits(1)), &ratio(1, 1));
        assert!(rounds_to(Some(f64::from_bits(1)), &least));
        assert!(!rounds_to(Some(0.0), &least));
    }
}
