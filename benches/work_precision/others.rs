//! Methods that do not use the closed form, in floats.
//!
//! Their time includes the assembly of the equations of equilibrium, but not the geometry of the pile.

use cannonpile::scalar::Algebra;
use cannonpile_testkit::real::Bounded;
use faer::traits::ComplexField;
use num_traits::{Float, Signed};

use crate::Bench;
use crate::peers::equations::Equations;
use crate::peers::iterative::squared;
use crate::peers::springs::{Relaxed, relax};
use crate::peers::{inclination, iterative, lu};
use crate::reference::{Unit, by_sphere};
use crate::run::{Measured, Method, Run, timed};

/// Runs LU and conjugate gradients in two float types, and springs of several stiffnesses.
pub(crate) fn runs(bench: &Bench) -> Vec<Run> {
    let mut runs = vec![factorised::<f32>(bench), factorised::<f64>(bench)];
    runs.extend([1e-3, 1e-5].map(|tolerance: f32| iterated(bench, tolerance)));
    runs.extend([1e-3, 1e-6, 1e-9, 1e-12].map(|tolerance: f64| iterated(bench, tolerance)));
    runs.extend(springs(bench));
    runs
}

fn factorised<F: Algebra + Bounded + ComplexField + Float>(bench: &Bench) -> Run {
    let (seconds, forces) = timed(bench.repetitions, || {
        lu::forces(&Equations::<F>::new(&bench.network))
    });
    let error = held(bench, forces);
    bench.run(Method::Lu, F::NAME, Measured { seconds, error })
}

fn iterated<F: Algebra + Bounded + Float>(bench: &Bench, tolerance: F) -> Run {
    // In exact arithmetic the iteration ends after at most as many steps as there are unknowns.
    let most = 40 * usize::from(bench.case.layers);
    let (seconds, answer) = timed(bench.repetitions, || {
        iterative::forces(&Equations::new(&bench.network), tolerance, most)
    });
    let error = held(bench, answer.forces);
    let run = bench.run(Method::Gradients, F::NAME, Measured { seconds, error });
    let iterations = answer.iterations;
    Run {
        setting: format!("residual {tolerance:?}"),
        remark: if answer.converged {
            format!("{iterations} iterations")
        } else {
            format!("did not converge in {iterations} iterations")
        },
        ..run
    }
}

/// Returns the error, and asserts that the residual r bounds it by √K·‖r‖/σ.
///
/// σ is the smallest singular value of the unit vectors of three contacts. Layer k adds at most ‖r_k‖/σ to the error from
/// above, which it does not amplify.
fn held<F: Algebra + Bounded + Float>(bench: &Bench, forces: Vec<F>) -> f64 {
    let Bench {
        case,
        network,
        reference,
        ..
    } = bench;
    let floats: Vec<f64> = forces
        .iter()
        .map(|f| f.to_f64().expect("a float"))
        .collect();
    let residual = squared(&Equations::new(network).residual(&floats)).sqrt();
    let greatest = floats.iter().copied().map(f64::abs).fold(1.0, f64::max);
    // The margin covers the rounding of the residual and of the directions: six products and a weight.
    let rounded = 16.0 * f64::EPSILON * greatest * case.contacts().sqrt();

    let [sin2, cos2] = [inclination().sin2(), &inclination().cos2()].map(f64::from_rational);
    let sigma = (1.5 * sin2).min(3.0 * cos2).sqrt();
    let layers = f64::from(case.layers - 1);
    let weight = 3.0 * cos2.sqrt();
    let most = layers.sqrt() * (residual + rounded) / sigma * weight;
    let bound = most / f64::from_rational(&reference.greatest);

    let error = reference.error(&by_sphere(forces), Unit::Weights);
    assert!(
        error <= bound,
        "{}: error {error:e} exceeds {bound:e}, which the residual allows",
        case.name
    );
    error
}

fn springs(bench: &Bench) -> Vec<Run> {
    let pulls = bench
        .reference
        .forces
        .iter()
        .flatten()
        .any(Signed::is_negative);
    if pulls {
        let none = "no equilibrium: some contacts need tension, and the springs have none";
        return vec![bench.without(Method::Springs, "f64", none)];
    }
    [1e4, 1e5, 1e6, 1e7, 1e8, 1e10]
        .map(|stiffness| relaxed(bench, stiffness))
        .into()
}

/// Runs springs of a stiffness in mg/R.
fn relaxed(bench: &Bench, stiffness: f64) -> Run {
    let layers = f64::from(bench.case.layers);
    let (seconds, answer) = timed(bench.repetitions, || {
        relax(&bench.network, bench.case.layers, stiffness)
    });
    let remark = answer.to_string();
    let setting = format!("k = {stiffness:.0e} mg/R");
    let Relaxed::Rest { forces, .. } = answer else {
        let run = bench.without(Method::Springs, "f64", &remark);
        return Run { setting, ..run };
    };
    let error = bench.reference.error(&by_sphere(forces), Unit::Weights);
    // This bound is twice the measured error of compliance and rounding. The bound is empirical, and fails near collapse.
    let bound = layers / stiffness + 1e-15 * layers * stiffness;
    let near_collapse = stiffness < layers.powi(3);
    assert!(
        near_collapse || error <= bound,
        "{}: error {error:e} of springs exceeds {bound:e}",
        bench.case.name
    );
    let run = bench.run(Method::Springs, "f64", Measured { seconds, error });
    Run {
        setting,
        remark,
        ..run
    }
}
