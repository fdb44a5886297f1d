//! The methods of the library, in every scalar, with an assertion of the accuracy of each scalar.

use cannonpile::geometry::Spacing;
use cannonpile::scalar::{Algebra, CorrectlyRounded, DoubleDouble, Exactness, Interval};
use cannonpile::shape::Selection;
use cannonpile::{Forces, Packing, Pile};
use cannonpile_testkit::real::Bounded;
use num_rational::BigRational;

use crate::Bench;
use crate::reference::{Unit, by_sphere};
use crate::run::{Measured, Method, Run, timed};

/// Runs all methods in all scalars.
pub(crate) fn runs(bench: &Bench) -> Vec<Run> {
    let straight = bench.case.pile.shape().stacking().is_straight();
    let mut runs = Vec::new();
    if straight {
        runs.extend(tables(bench));
        runs.extend([
            closed::<f32>(bench),
            closed::<f64>(bench),
            closed::<DoubleDouble>(bench),
            closed::<Interval>(bench),
            closed::<BigRational>(bench),
        ]);
    } else {
        let none = "no closed form after a sign change";
        runs.extend(
            [Method::Table, Method::Closed].map(|method| bench.without(method, "any", none)),
        );
    }
    runs.extend([
        recursion::<f32>(bench),
        recursion::<f64>(bench),
        recursion::<DoubleDouble>(bench),
        recursion::<Interval>(bench),
        recursion::<BigRational>(bench),
    ]);
    runs.push(engine(bench));
    runs
}

/// Fills slices with correctly rounded forces in mg, and with multiples of f₀.
fn tables(bench: &Bench) -> [Run; 3] {
    let spacing = Spacing::new(BigRational::new(6.into(), 5.into())).expect("a spacing");
    let packing = Packing::new(&bench.case.pile, &spacing).expect("room");
    let (seconds, forces) = timed(bench.repetitions, || {
        let layers = bench
            .case
            .pile
            .forces::<BigRational>()
            .layers(Selection::All);
        let layers = layers.expect("room").numerators::<i64>().expect("integers");
        filled(layers.slice_len().expect("as many as fit"), |slices| {
            layers.fill(slices).expect("lengths that fit");
        })
    });
    let forces: Vec<[BigRational; 3]> = forces
        .into_iter()
        .map(|forces| forces.map(|n| BigRational::from_integer(n.into())))
        .collect();
    let exact = held(bench, Method::Table, &forces, Unit::PileUnits);
    [
        table(bench, || nearest::<f32>(&packing)),
        table(bench, || nearest::<f64>(&packing)),
        bench.run(
            Method::Table,
            "i64",
            Measured {
                seconds,
                error: exact,
            },
        ),
    ]
}

fn table<T: Algebra + Bounded>(bench: &Bench, run: impl FnMut() -> Vec<[T; 3]>) -> Run {
    let (seconds, forces) = timed(bench.repetitions, run);
    let error = held(bench, Method::Table, &forces, Unit::Weights);
    bench.run(Method::Table, T::NAME, Measured { seconds, error })
}

fn nearest<F: CorrectlyRounded + Default>(packing: &Packing<'_>) -> Vec<[F; 3]> {
    let layers = packing.layers::<F>(Selection::All).expect("floats");
    filled(layers.slice_len().expect("as many as fit"), |slices| {
        layers.fill(slices).expect("lengths that fit");
    })
}

fn filled<V: Copy + Default>(spheres: usize, fill: impl FnOnce([&mut [V]; 3])) -> Vec<[V; 3]> {
    let mut forces = [(); 3].map(|()| vec![V::default(); spheres]);
    fill(forces.each_mut().map(Vec::as_mut_slice));
    by_direction(forces)
}

fn by_direction<V>([a, b, c]: [Vec<V>; 3]) -> Vec<[V; 3]> {
    let forces = a.into_iter().zip(b).zip(c);
    forces.map(|((a, b), c)| [a, b, c]).collect()
}

fn closed<T: Algebra + Bounded>(bench: &Bench) -> Run {
    measured::<T>(bench, Method::Closed, || {
        contacts(&bench.case.pile.forces::<T>())
    })
}

fn recursion<T: Algebra + Bounded>(bench: &Bench) -> Run {
    measured::<T>(bench, Method::Transfer, || swept(&bench.case.pile))
}

fn engine(bench: &Bench) -> Run {
    let run = measured::<BigRational>(bench, Method::Engine, || {
        let forces = bench.case.pile.forces::<BigRational>();
        contacts(
            &forces
                .with_method(cannonpile::Method::Sweep)
                .expect("spheres"),
        )
    });
    Run {
        scalar: "integers",
        ..run
    }
}

/// Computes all contact forces, layer by layer.
fn swept<T: Algebra>(pile: &Pile) -> Vec<[T; 3]> {
    let forces = pile.forces::<T>().with_method(cannonpile::Method::Sweep);
    let layers = forces.and_then(|forces| forces.layers(Selection::All));
    let layers = layers.expect("room");
    let spheres = layers.slice_len().expect("few");
    let mut forces = [(); 3].map(|()| vec![T::zero(); spheres]);
    layers
        .fill(forces.each_mut().map(Vec::as_mut_slice))
        .expect("forces");
    by_direction(forces)
}

/// Computes all contact forces by single queries.
fn contacts<T: Algebra>(forces: &Forces<'_, T>) -> Vec<[T; 3]> {
    let contacts = forces.contacts(Selection::All).expect("a plan");
    by_sphere(contacts.map(|c| c.expect("a force").force).collect())
}

fn measured<T: Algebra + Bounded>(
    bench: &Bench,
    method: Method,
    run: impl FnMut() -> Vec<[T; 3]>,
) -> Run {
    let (seconds, forces) = timed(bench.repetitions, run);
    let error = held(bench, method, &forces, Unit::PileUnits);
    bench.run(method, T::NAME, Measured { seconds, error })
}

/// Returns the error, and asserts that it agrees with the scalar: zero, inside the enclosure, or a few roundings.
///
/// The closed form has a few roundings. The recursion has at most ten roundings for each layer, and no step amplifies
/// errors. Each rounding is relative to a bound on all forces, √(KC) f₀ for C contacts in K layers.
fn held<T: Algebra + Bounded>(bench: &Bench, method: Method, forces: &[[T; 3]], unit: Unit) -> f64 {
    let (name, scalar) = (&bench.case.name, T::NAME);
    let error = bench.reference.error(forces, unit);
    match T::EXACTNESS {
        Exactness::Enclosure => assert!(
            bench.reference.is_enclosed_by(forces),
            "{name}: an interval lost a force"
        ),
        Exactness::Rounded { bits } => {
            let bits = i32::try_from(bits).expect("some bits");
            let roundings = match method {
                Method::Transfer => {
                    let layers = f64::from(bench.case.layers);
                    let most = (layers * bench.case.contacts()).sqrt();
                    10.0 * layers * most / f64::from_rational(&bench.reference.greatest)
                }
                _ => 4.0,
            };
            let bound = roundings * 2.0_f64.powi(-bits);
            assert!(
                error <= bound,
                "{name}, {scalar}: error {error:e} exceeds {bound:e}"
            );
        }
        // Exact scalars have no error.
        _ => assert!(
            error <= 0.0,
            "{name}, {scalar}: error {error:e} of an exact scalar"
        ),
    }
    error
}
