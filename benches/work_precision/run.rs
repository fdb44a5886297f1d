//! The measurement of a method on a pile.

use std::hint::black_box;
use std::time::Instant;

/// A method that computes all contact forces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Method {
    /// Slices filled from a table of the distinct forces.
    Table,
    /// The closed form, force by force.
    Closed,
    /// The recursion from layer to layer in the scalar itself.
    Transfer,
    /// The recursion on integer numerators.
    Engine,
    /// A sparse LU factorisation of the equations of equilibrium.
    Lu,
    /// Conjugate gradients on these equations.
    Gradients,
    /// Damped relaxation of springs.
    Springs,
}

impl Method {
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Table => "closed form, table",
            Self::Closed => "closed form",
            Self::Transfer => "transfer",
            Self::Engine => "exact engine",
            Self::Lu => "sparse LU",
            Self::Gradients => "CGLS",
            Self::Springs => "springs",
        }
    }
}

/// A method in a scalar on a pile: one row of the table.
pub(crate) struct Run {
    pub(crate) pile: String,
    pub(crate) contacts: f64,
    pub(crate) method: Method,
    pub(crate) scalar: &'static str,
    /// Tolerance or stiffness, if the method has one.
    pub(crate) setting: String,
    /// Time and error, or the reason why there are none.
    pub(crate) outcome: Result<Measured, String>,
    /// A remark on the result.
    pub(crate) remark: String,
}

/// The median time to compute all forces, and the relative error of the worst force.
#[derive(Clone, Copy)]
pub(crate) struct Measured {
    pub(crate) seconds: f64,
    /// 0 if and only if all forces are exact.
    pub(crate) error: f64,
}

/// The shortest time in seconds of a run that is not repeated, because noise does not affect it.
const LONG: f64 = 10.0;

/// Returns the median time of some runs, and the last result.
pub(crate) fn timed<A>(repetitions: usize, mut run: impl FnMut() -> A) -> (f64, A) {
    let mut once = || {
        let begun = Instant::now();
        let answer = black_box(run());
        (begun.elapsed().as_secs_f64(), answer)
    };
    let (first, mut answer) = once();
    let mut times = vec![first];
    let repetitions = if first > LONG { 1 } else { repetitions };
    for _ in 1..repetitions {
        let (time, again) = once();
        times.push(time);
        answer = again;
    }
    times.sort_by(f64::total_cmp);
    (times[repetitions / 2], answer)
}
