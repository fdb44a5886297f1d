//! The methods of the library, in every scalar, each held to what its scalar promises.

use cannonpile::geometry::Spacing;
use cannonpile::scalar::{Algebra, DoubleDouble, Exactness, Interval, RealEmbeddable};
use cannonpile::shape::Selection;
use cannonpile::{Forces, Packing, Pile, Strengths};
use num_rational::BigRational;

use crate::Bench;
use crate::reference::{Unit, by_sphere};
use crate::run::{Measured, Method, Run, timed};

/// All methods in all scalars.
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
        let none = "there is none across a change of sign";
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

/// Slices filled with forces in mg, each the nearest float, and with multiples of f₀.
fn tables(bench: &Bench) -> [Run; 3] {
    let spacing = Spacing::new(BigRational::new(6.into(), 5.into())).expect("a spacing");
    let packing = Packing::new(&bench.case.pile, &spacing).expect("room");
    let integers = || Strengths::<i64>::multiples(&bench.case.pile).expect("integers");
    let (seconds, forces) = timed(bench.repetitions, || filled(&integers()));
    let forces: Vec<[BigRational; 3]> = forces
        .into_iter()
        .map(|forces| forces.map(|n| BigRational::from_integer(n.into())))
        .collect();
    let exact = held(bench, Method::Table, &forces, Unit::PileUnits);
    [
        table(bench, || {
            filled(&Strengths::<f32>::nearest(&packing).expect("floats"))
        }),
        table(bench, || {
            filled(&Strengths::<f64>::nearest(&packing).expect("floats"))
        }),
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

fn table<T: Algebra + RealEmbeddable>(bench: &Bench, run: impl FnMut() -> Vec<[T; 3]>) -> Run {
    let (seconds, forces) = timed(bench.repetitions, run);
    let error = held(bench, Method::Table, &forces, Unit::Weights);
    bench.run(Method::Table, T::NAME, Measured { seconds, error })
}

fn filled<V: Copy + Default + Send + Sync>(strengths: &Strengths<V>) -> Vec<[V; 3]> {
    let spheres = strengths.spheres().expect("as many as fit");
    let mut forces = vec![[V::default(); 3]; spheres];
    strengths
        .fill_interleaved(&mut forces)
        .expect("lengths that fit");
    forces
}

fn closed<T: Algebra + RealEmbeddable>(bench: &Bench) -> Run {
    measured::<T>(bench, Method::Closed, || {
        contacts(&bench.case.pile.forces::<T>())
    })
}

fn recursion<T: Algebra + RealEmbeddable>(bench: &Bench) -> Run {
    measured::<T>(bench, Method::Transfer, || swept(&bench.case.pile))
}

fn engine(bench: &Bench) -> Run {
    let run = measured::<BigRational>(bench, Method::Engine, || {
        let statics = bench.case.pile.forces::<BigRational>();
        contacts(&statics.by(cannonpile::Method::Sweep).expect("spheres"))
    });
    Run {
        scalar: "integers",
        ..run
    }
}

/// All contact forces, layer after layer.
fn swept<T: Algebra>(pile: &Pile) -> Vec<[T; 3]> {
    let mut sweep = pile.sweep::<T>().expect("room");
    let mut forces = Vec::new();
    for k in 0..pile.layers() - 1 {
        sweep.advance(k).expect("a layer");
        let spheres = sweep.spheres().expect("few");
        let mut layer = [(); 3].map(|()| vec![T::zero(); spheres]);
        let [a, b, c] = layer.each_mut().map(Vec::as_mut_slice);
        sweep.fill([a, b, c]).expect("forces");
        let [a, b, c] = layer;
        forces.extend(a.into_iter().zip(b).zip(c).map(|((a, b), c)| [a, b, c]));
    }
    forces
}

/// All contact forces, as they are asked for one after the other.
fn contacts<T: Algebra>(statics: &Forces<'_, T>) -> Vec<[T; 3]> {
    let rows = statics.pile().rows(Selection::All).expect("rows");
    let forces = statics.contacts(rows).map(|c| c.expect("a force").force);
    by_sphere(forces.collect())
}

fn measured<T: Algebra + RealEmbeddable>(
    bench: &Bench,
    method: Method,
    run: impl FnMut() -> Vec<[T; 3]>,
) -> Run {
    let (seconds, forces) = timed(bench.repetitions, run);
    let error = held(bench, method, &forces, Unit::PileUnits);
    bench.run(method, T::NAME, Measured { seconds, error })
}

/// The error, which must be what the scalar promises: none, one that the bounds enclose, or one that roundings explain.
///
/// Of the closed form a few roundings. Of the recursion, where no step amplifies what came before, ten for each layer,
/// each of what no force exceeds: √(3KN) f₀ for N spheres in K layers.
fn held<T: Algebra + RealEmbeddable>(
    bench: &Bench,
    method: Method,
    forces: &[[T; 3]],
    unit: Unit,
) -> f64 {
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
        // Exact, one way or the other.
        _ => assert!(
            error <= 0.0,
            "{name}, {scalar}: error {error:e} of an exact scalar"
        ),
    }
    error
}
