//! Sweeps of alternating layers: in floats, in the exact engine, in plain rationals, on two threads.

use std::hint::black_box;

use cannonpile::Pile;
use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::scalar::Algebra;
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use num_rational::BigRational;
use num_traits::ToPrimitive;

use crate::fill::memset;
use crate::plain::Plain;
use crate::time::{ratio, seconds};
use crate::{Extent, Results};

pub(crate) fn measure(extent: Extent, results: &mut Results) {
    let pairs = extent.pairs;
    let pile = alternating(extent.size(200, 12));
    results.push(("transfer_f64_over_memset".into(), over_memset(&pile, pairs)));

    for (full, smoke) in [(60, 6), (200, 8), (400, 10)] {
        let pile = alternating(extent.size(full, smoke));
        check_engine(&pile);
        let ratio = ratio(pairs, || time_exact(&pile), || time_in::<f64>(&pile));
        results.push((format!("transfer_integer_over_f64_{full}"), ratio));
        if full == 60 {
            results.push(("transfer_integer_over_f64".into(), ratio));
        }
    }

    let pile = alternating(extent.size(60, 6));
    // The slow one once for each of a few pairs.
    let few = pairs.min(3);
    let over_integer = ratio(few, || time_in::<Plain>(&pile), || time_exact(&pile));
    results.push(("bigrational_over_integer".into(), over_integer));
}

/// The exact sweep on one thread, against two.
#[cfg(feature = "rayon")]
pub(crate) fn measure_threads(extent: Extent, results: &mut Results) {
    let pile = alternating(extent.size(400, 30));
    let pool = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().expect("threads")
    };
    let (one, two) = (pool(1), pool(2));
    let speedup = ratio(
        extent.pairs,
        || one.install(|| time_exact(&pile)),
        || two.install(|| time_exact(&pile)),
    );
    results.push(("two_threads_speedup".into(), speedup));
}

fn alternating(layers: i128) -> Pile {
    let stacking = Stacking::hcp(layers).expect("a stacking");
    Pile::under(Region::SITE, stacking).expect("a pile")
}

/// All contact forces by a sweep in floats, written into slices, against filling them with one value.
fn over_memset(pile: &Pile, pairs: usize) -> f64 {
    let rows = pile.rows(Selection::All).expect("rows").off_the_floor();
    let spheres = rows.sites().to_usize().expect("as many as fit");
    let mut slices = [(); 3].map(|()| vec![1.5; spheres]);
    let mut other = slices.clone();
    let ratio = ratio(
        pairs,
        || {
            let time = seconds(|| fill(pile, &mut slices));
            black_box(&slices);
            time
        },
        || {
            let time = seconds(|| memset(&mut other, 1.5));
            black_box(&other);
            time
        },
    );
    let exact = pile.forces::<BigRational>();
    let layer = pile.layers() - 2;
    let last = pile.rows(Selection::Layer(layer)).expect("a layer");
    let first = spheres - last.sites().to_usize().expect("few");
    let contacts = exact
        .contacts(last)
        .map(|contact| contact.expect("a force"));
    let mut sweep = pile.sweep::<f64>().expect("room");
    sweep.advance(layer).expect("a layer");
    let bound = sweep
        .error_bound()
        .expect("floats")
        .to_f64()
        .expect("small");
    for (place, contact) in contacts.enumerate() {
        let found = slices[contact.direction.index()][first + place / 3];
        let exact = contact.force.to_f64().expect("a float");
        assert!(
            (found - exact).abs() <= 200.0 * bound,
            "{found} is not {exact}"
        );
    }
    ratio
}

fn fill(pile: &Pile, slices: &mut [Vec<f64>; 3]) {
    let mut sweep = pile.sweep::<f64>().expect("room");
    let mut rest = slices.each_mut().map(Vec::as_mut_slice);
    for k in 0..pile.layers() - 1 {
        sweep.advance(k).expect("a layer");
        let n = sweep.spheres().expect("few");
        let layer = rest
            .each_mut()
            .map(|rest| rest.split_off_mut(..n).expect("as many"));
        sweep.fill(layer).expect("forces");
    }
}

/// The way down to the lowest contacts in a scalar.
fn time_in<T: Algebra>(pile: &Pile) -> f64 {
    let mut sweep = pile.sweep::<T>().expect("room");
    let time = seconds(|| sweep.advance(pile.layers() - 2).expect("a layer"));
    black_box(&sweep);
    time
}

/// The same in the exact engine.
fn time_exact(pile: &Pile) -> f64 {
    let mut sweep = pile.exact_sweep().expect("room");
    let time = seconds(|| sweep.advance(pile.layers() - 2).expect("a layer"));
    black_box(&sweep);
    time
}

/// The engine, the plain rationals and single questions agree, where the pile is small enough for all of them.
fn check_engine(pile: &Pile) {
    let layer = pile.layers() - 2;
    let mut engine = pile.exact_sweep().expect("room");
    engine.advance(layer).expect("a layer");
    let statics = pile.forces::<BigRational>();
    let sites: Vec<Site> = pile
        .rows(Selection::Layer(layer))
        .expect("a layer")
        .flatten()
        .collect();
    let step = sites.len() / 3 + 1;
    for site in sites.into_iter().step_by(step) {
        let forces = engine.passed_on(site).expect("forces");
        for (direction, force) in Direction::ALL.into_iter().zip(forces) {
            assert_eq!(
                statics.contact(site, direction),
                Ok(force),
                "{site} {direction}"
            );
        }
    }
}
