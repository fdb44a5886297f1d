//! Is every float the nearest one? Ten million random and adversarial values of each quantity.
//!
//! `cargo bench --bench rounding` rounds roots, rationals and every physical quantity of piles of all kinds to `f64` and
//! `f32`, and has each float judged in integers, by the squares of the points halfway to its neighbours. It prints how
//! many values were judged, how many roundings were wrong, how many of them the screen left to integers, and nanoseconds a value, of which making it and judging it are
//! the greater part; and it asserts that none is wrong. With `-- --smoke` it tries some hundreds; with the name of a
//! quantity, or a part of it, only that one.
//!
//! With `-- --stress` it measures the table of `tests/stress` instead, and below it the pile that takes too long for a
//! test: a change of sign at every one of 1,000 layers, under a hexagon of 40 spheres a side.

#[path = "../tests/judge/mod.rs"]
mod judge;
#[path = "../tests/rounding/mod.rs"]
mod rounding;
#[path = "../tests/stress/mod.rs"]
mod stress;

use std::env;
use std::time::Instant;

use cannonpile::Pile;
use cannonpile::lattice::Selection;
use cannonpile::scalar::{Algebra, DoubleDouble, Exactness, Interval, RealEmbeddable};
use num_rational::BigRational;
use num_traits::Signed;
use rounding::numbers;
use rounding::quantities::Quantity;
use rounding::random::Random;
use rounding::tally::Tally;
use stress::cases::{self, Case};
use stress::errors::{Worst, distance, unit};
use stress::table::{self, Answers};

fn main() {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let smoke = arguments.iter().any(|argument| argument == "--smoke");
    let cases = if smoke { 500 } else { 10_000_000 };
    if arguments.iter().any(|argument| argument == "--stress") {
        return stress_table(!smoke);
    }
    let named: Vec<&String> = arguments.iter().filter(|a| !a.starts_with('-')).collect();
    let wanted = |name: &str| named.is_empty() || named.iter().any(|part| name.contains(*part));

    println!("quantity                        cases  wrong  by integers  ns a case");
    for (name, tally) in [
        ("random roots", numbers::random_roots as Source),
        ("critical roots", numbers::critical_roots),
        ("rationals", numbers::rationals),
    ] {
        if wanted(name) {
            report(name, |random| tally(random, cases));
        }
    }
    for quantity in Quantity::ALL {
        if wanted(quantity.name()) {
            report(quantity.name(), |random| quantity.tally(random, cases));
        }
    }
}

fn stress_table(with_deep: bool) {
    print!("{}", table::HEAD);
    for case in cases::all() {
        let rows = table::rows(&case, &Answers::of(&case.pile));
        print!("{}", rows.unwrap_or_else(|fault| panic!("{fault}")));
    }
    if with_deep {
        deep(&cases::alternating(40, 1000));
    }
}

/// The contact forces of some spheres just above the floor, by a sweep in every scalar, against the exact engine: too much
/// for the rows of the table.
fn deep(case: &Case) {
    let (pile, k) = (&case.pile, case.pile.layers() - 2);
    let mut engine = pile.exact_sweep().expect("room");
    engine.advance(k).expect("a layer");
    let sites = pile.rows(Selection::Layer(k)).expect("a layer").flatten();
    let exact: Sample = sites
        .enumerate()
        .step_by(997)
        .map(|(place, site)| (place, engine.passed_on(site).expect("forces")))
        .collect();
    drop(engine);
    let forces = exact.iter().flat_map(|(_, forces)| forces);
    let greatest = forces.map(Signed::abs).max().expect("a force");
    println!(
        "\n{}: {} contacts above the floor",
        case.name,
        3 * exact.len()
    );
    let (double, single) = (unit::<f64>(&greatest), unit::<f32>(&greatest));
    println!(
        "f64, ulps            {}",
        swept::<f64>(pile, &exact, &double)
    );
    println!(
        "f32, ulps            {}",
        swept::<f32>(pile, &exact, &single)
    );
    let twice = swept::<DoubleDouble>(pile, &exact, &double).as_power();
    println!("double-double, ulps  {twice}");
    let widths = swept::<Interval>(pile, &exact, &double).as_power();
    println!("interval, ulps       {widths}");
}

/// Places in a layer, and the exact forces to the spheres below.
type Sample = Vec<(usize, [BigRational; 3])>;

/// The worst error of a sweep; of intervals, which must hold the exact forces, how far their ends are off.
fn swept<T: Algebra + RealEmbeddable>(pile: &Pile, exact: &Sample, ulp: &BigRational) -> Worst {
    let mut sweep = pile.sweep::<T>().expect("room");
    sweep.advance(pile.layers() - 2).expect("a layer");
    let spheres = sweep.spheres().expect("few");
    let mut forces = [(); 3].map(|()| vec![T::from_rational(ulp); spheres]);
    let [a, b, c] = forces.each_mut().map(Vec::as_mut_slice);
    sweep.fill([a, b, c]).expect("forces");
    let mut worst = Worst::none();
    for (place, exact) in exact {
        for (forces, exact) in forces.iter().zip(exact) {
            let force = &forces[*place];
            if T::EXACTNESS == Exactness::Enclosure {
                let bounds = force.enclosure();
                assert!(
                    bounds.is_none_or(|bounds| bounds.contains(exact)),
                    "{exact}"
                );
            }
            worst.meet(distance(force, exact).map(|error| error / ulp));
        }
    }
    worst
}

type Source = fn(&mut Random, u64) -> Tally;

fn report(name: &str, tally: impl FnOnce(&mut Random) -> Tally) {
    let start = Instant::now();
    // Another sequence than that of the tests.
    let Tally {
        cases,
        wrong,
        witness,
        by_integers,
    } = tally(&mut Random::new(1611));
    #[expect(clippy::cast_precision_loss, reason = "a few digits are printed")]
    let each = start.elapsed().as_secs_f64() * 1e9 / cases as f64;
    println!("{name:26} {cases:10} {wrong:6} {by_integers:12} {each:10.0}");
    assert_eq!(wrong, 0, "{witness:?}");
}
