//! The response to a load, and its mean over random stackings.

use super::parts::{E, of_numbers, symbol};
use crate::Formulas;
use crate::definition::{Definition, Value};

pub(super) fn disorder(f: &Formulas<E>) -> Vec<Definition> {
    let [n, s, t, mu, power, q, x, y] = ["n", "s", "t", "mu", "power", "q", "x", "y"].map(symbol);
    vec![
        of_numbers(
            "third_moment",
            "The contribution of the sign of step s to the third moment of a unit load at depth n.",
            &["n", "s"],
            Value::Number((f.third_moment)(&n, &s)),
        ),
        of_numbers(
            "fourth_moment",
            "The part of the fourth moment of a unit load at depth n that does not depend on signs.",
            &["n"],
            Value::Number((f.fourth_moment)(&n)),
        ),
        of_numbers(
            "fourth_moment_of_pair",
            "The coefficient of the product of the signs of steps s < t in the fourth moment of that load.",
            &["n", "s", "t"],
            Value::Number((f.fourth_moment_of_pair)(&n, &s, &t)),
        ),
        of_numbers(
            "mean_third_moment",
            "The mean third moment over random stackings, times (1-mu)^3; power is mu^n.",
            &["n", "mu", "power"],
            Value::Number((f.mean_third_moment)(&n, &mu, &power)),
        ),
        of_numbers(
            "mean_fourth_moment_of_pairs",
            "The mean contribution of pairs of signs to the fourth moment, times (1-mu)^4; power is mu^n.",
            &["n", "mu", "power"],
            Value::Number((f.mean_fourth_moment_of_pairs)(&n, &mu, &power)),
        ),
        of_numbers(
            "wave",
            "Damping and dispersion of the waves of the mean, times q and q^2.",
            &["q"],
            Value::Several((f.wave)(&q).into()),
        ),
        of_numbers(
            "registry_excess",
            "The excess of the probability of a registry over 1/3, one layer further down.",
            &["x", "y", "q"],
            Value::Number((f.registry_excess)(&x, &y, &q)),
        ),
    ]
}
