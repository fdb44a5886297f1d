//! Measures sweeps of HCP layers: in floats, in the exact engine, in plain rationals, and on two threads.

use std::hint::black_box;

use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::scalar::Algebra;
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Pile, ratio as rational};
use num_rational::BigRational;
use num_traits::ToPrimitive;

use crate::fill::memset;
use crate::plain::Plain;
use crate::time::{ratio, seconds};
use crate::{Extent, Results, pool};

pub(crate) fn measure(extent: Extent, results: &mut Results) {
    let pairs = extent.pairs;
    let pile = alternating(extent.size(200, 12));
    results.push(("transfer_f64_over_memset".into(), over_memset(&pile, pairs)));

    for (full, smoke) in [(60, 6), (200, 8), (400, 10)] {
        let pile = alternating(extent.size(full, smoke));
        check_engine(&pile);
        let over_floats = ratio(pairs, || time_exact(&pile), || time_in::<f64>(&pile));
        results.push((format!("transfer_integer_over_f64_{full}"), over_floats));
        if full == 60 {
            results.push(("transfer_integer_over_f64".into(), over_floats));
        }
        let mut slices = slices(&pile);
        let memset = || {
            let time = seconds(|| memset(&mut slices, 1.5));
            black_box(&slices);
            time
        };
        let over_memset = ratio(pairs, || time_exact(&pile), memset);
        results.push((format!("exact_over_memset_{full}"), over_memset));
    }

    let [upright, tilted] = without_symmetry(extent.size(200, 12));
    check_engine(&tilted);
    let floats = ratio(
        pairs,
        || time_in::<f64>(&tilted),
        || time_in::<f64>(&upright),
    );
    results.push(("tilted_over_upright_f64".into(), floats));
    let exact = ratio(pairs, || time_exact(&tilted), || time_exact(&upright));
    results.push(("tilted_over_upright".into(), exact));

    let pile = alternating(extent.size(60, 6));
    // The slow method runs in a few pairs only.
    let few = pairs.min(3);
    let over_integer = ratio(few, || time_in::<Plain>(&pile), || time_exact(&pile));
    results.push(("bigrational_over_integer".into(), over_integer));
}

/// Compares sweeps in floats and in the exact engine on one thread with those on two.
pub(crate) fn measure_threads(extent: Extent, results: &mut Results) {
    let pile = alternating(extent.size(200, 30));
    let (one, two) = (pool(1), pool(2));
    let speedup = |time: &(dyn Fn() -> f64 + Sync)| {
        ratio(extent.pairs, || one.install(time), || two.install(time))
    };
    let floats = speedup(&|| time_in::<f64>(&pile));
    results.push(("two_threads_speedup_f64".into(), floats));
    let exact = speedup(&|| time_exact(&pile));
    results.push(("two_threads_speedup".into(), exact));
}

pub(crate) fn alternating(layers: i128) -> Pile {
    let stacking = Stacking::hcp(layers).expect("a stacking");
    Pile::under(Region::SITE, stacking).expect("a pile")
}

/// Returns a pile under upright gravity and the same pile under a tilt. Its layers have no threefold symmetry, which would
/// make an upright sweep faster.
fn without_symmetry(layers: i128) -> [Pile; 2] {
    let top = Region::new(0..=2, 0..=1, 0..=3).expect("a region");
    let stacking = Stacking::hcp(layers).expect("a stacking");
    let upright = Pile::under(top, stacking).expect("a pile");
    let tilt = [rational!(1 / 5), rational!(1 / 8)];
    let tilted = upright.clone().with_tilt(tilt).expect("a tilt");
    [upright, tilted]
}

/// Returns a slice for each direction, with a number for each sphere above the floor.
pub(crate) fn slices(pile: &Pile) -> [Vec<f64>; 3] {
    let layers = pile.forces::<f64>().layers(Selection::All);
    let spheres = layers.expect("room").slice_len().expect("as many as fit");
    [(); 3].map(|()| vec![1.5; spheres])
}

/// Compares a sweep in floats that writes all contact forces into slices with filling the slices with one value.
fn over_memset(pile: &Pile, pairs: usize) -> f64 {
    let (mut slices, mut other) = (slices(pile), slices(pile));
    let ratio = ratio(
        pairs,
        || {
            let time = seconds(|| {
                let layers = pile.forces::<f64>().layers(Selection::All);
                let slices = slices.each_mut().map(Vec::as_mut_slice);
                layers.expect("room").fill(slices).expect("forces");
            });
            black_box(&slices);
            time
        },
        || {
            let time = seconds(|| memset(&mut other, 1.5));
            black_box(&other);
            time
        },
    );
    let layer = Selection::Layer(pile.layers() - 2);
    let mut layers = pile.forces::<f64>().layers(layer).expect("room");
    let last = layers.next_layer().expect("a sweep").expect("a layer");
    let first = slices[0].len() - last.sphere_count();
    let bound = last.error_bound().expect("floats");
    let bound = bound.to_f64().expect("small");
    let contacts = pile.forces::<BigRational>().contacts(layer);
    for (place, contact) in contacts.expect("a layer").enumerate() {
        let contact = contact.expect("a force");
        let found = slices[contact.direction.index()][first + place / 3];
        let exact = contact.force.to_f64().expect("a float");
        assert!(
            (found - exact).abs() <= 200.0 * bound,
            "{found} is not {exact}"
        );
    }
    ratio
}

/// Sweeps down to the lowest contacts in a scalar, without writing the forces.
fn time_in<T: Algebra>(pile: &Pile) -> f64 {
    seconds(|| {
        let layer = Selection::Layer(pile.layers() - 2);
        let mut layers = pile.forces::<T>().layers(layer).expect("room");
        black_box(layers.next_layer().expect("a sweep"));
    })
}

/// Sweeps down in the exact engine, which stores numerators as limbs and updates them in place.
fn time_exact(pile: &Pile) -> f64 {
    time_in::<BigRational>(pile)
}

/// Checks that the engine agrees with single queries, which follow the contact lines upwards.
fn check_engine(pile: &Pile) {
    // With more layers a single query visits too many spheres.
    let k = (pile.layers() - 2).min(60);
    let forces = pile.forces::<BigRational>();
    let mut layers = forces.layers(Selection::Layer(k)).expect("room");
    let layer = layers.next_layer().expect("a sweep").expect("a layer");
    let rows = pile.rows(Selection::Layer(k)).expect("a layer");
    let sites: Vec<Site> = rows.flatten().collect();
    let step = sites.len() / 3 + 1;
    for site in sites.into_iter().step_by(step) {
        let swept = layer.to_below(site).expect("forces");
        for (direction, force) in Direction::ALL.into_iter().zip(swept) {
            let single = forces.contact(site, direction);
            assert_eq!(single, Ok(force), "{site} {direction}");
        }
    }
}
