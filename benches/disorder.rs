//! Run times for random stackings: means in floats, sums by number of faults in integers, exact means at one
//! probability, enumerations, and samples.
//!
//! `cargo bench --manifest-path benches/Cargo.toml --bench disorder --features all`
//! asserts that the mean normal forces of a unit load sum to 1, and the number of stable stackings. It prints seconds and
//! the exponents of the cost. With `-- --smoke` it uses few layers.

use std::env;
use std::time::Instant;

use cannonpile::lattice::{Region, Site};
use cannonpile_disorder::{
    Choice, ContactSet, Ensemble, FirstSign, RandomPiles, RandomStackings, Samples, Shard,
};
use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::One;

fn stackings(steps: u32) -> RandomStackings {
    RandomStackings::new(i128::from(steps) + 1, FirstSign::Plus).expect("few layers")
}

/// Returns a plane with one load.
fn plane(steps: u32) -> RandomPiles {
    let plane = RandomPiles::plane(stackings(steps)).weightless();
    plane
        .with_load(Site::APEX, BigRational::one())
        .expect("a load")
}

/// Returns piles under one sphere, with weight.
fn pile(steps: u32) -> RandomPiles {
    RandomPiles::under(Region::SITE, stackings(steps))
}

fn in_floats(piles: &RandomPiles) {
    let mean = piles.mean(&0.5_f64).expect("a mean");
    let sum: f64 = mean.rows().iter().map(|row| row.normal).sum();
    if piles.is_weightless() {
        assert!((sum - 1.0).abs() < 1e-12, "{sum}");
    }
}

fn by_faults(piles: &RandomPiles) {
    let by_faults = piles.by_faults().expect("sums");
    let first = by_faults.rows().next().expect("a row").expect("a sum");
    // Without faults (FCC) the load reaches the floor at three spheres, the first row among them, with a third each.
    if piles.is_weightless() {
        assert_eq!(first.normal, BigRational::new(1.into(), 3.into()));
    }
}

fn exactly(piles: &RandomPiles) {
    let third = BigRational::new(1.into(), 3.into());
    let mean = piles.exact(&third).expect("a mean");
    let sum: BigRational = mean.rows().iter().map(|row| row.normal.clone()).sum();
    if piles.is_weightless() {
        assert!(sum.is_one());
    }
}

/// Returns the smallest time of a few runs, in seconds.
fn seconds(run: impl Fn()) -> f64 {
    let runs = (0..3).map(|_| {
        let start = Instant::now();
        run();
        start.elapsed().as_secs_f64()
    });
    runs.fold(f64::INFINITY, f64::min)
}

/// Prints the times for n and 2n steps, and the exponent.
fn measure(name: &str, steps: [u32; 2], run: impl Fn(u32)) {
    let times = steps.map(|steps| seconds(|| run(steps)));
    for (steps, time) in steps.iter().zip(times) {
        println!("{name:28} n = {steps:4} {time:10.4} s");
    }
    let exponent = (times[1] / times[0]).log2();
    let word = name.replace(' ', "_");
    println!("ratio exponent_{word} {exponent:.2}");
}

/// Measures all stackings under one sphere, and samples of twelve layers.
fn one_by_one(layers: i128, smoke: bool) {
    let under = |layers| {
        let stackings = RandomStackings::new(layers, FirstSign::Plus).expect("stackings");
        Ensemble::under(Region::SITE, stackings).expect("an ensemble")
    };
    let all = under(layers);
    let (tally, seconds) = timed(|| all.run(&Choice::All, Shard::WHOLE).expect("a tally"));
    assert_eq!(
        tally.standing(ContactSet::Sloping),
        Some(BigUint::from(11_u32))
    );
    let what = format!("all {} stackings of {layers} layers", tally.stackings());
    println!("{what:44} {seconds:10.4} s");
    let count = if smoke { 100 } else { 1_000_000 };
    let half = BigRational::new(1.into(), 2.into());
    let samples = Choice::Drawn(Samples::new(count, 1, half).expect("samples"));
    let twelve = under(12);
    let (tally, seconds) = timed(|| twelve.run(&samples, Shard::WHOLE).expect("a tally"));
    assert_eq!(tally.stackings(), count.into());
    println!(
        "{:44} {seconds:10.4} s",
        format!("{count} samples of 12 layers")
    );
}

fn timed<T>(run: impl FnOnce() -> T) -> (T, f64) {
    let begun = Instant::now();
    let answer = run();
    (answer, begun.elapsed().as_secs_f64())
}

fn main() {
    let smoke = env::args().any(|argument| argument == "--smoke");
    let depth = |deep: u32| if smoke { [2, 4] } else { [deep / 2, deep] };
    measure("floats plane", depth(160), |n| in_floats(&plane(n)));
    measure("floats pile", depth(160), |n| in_floats(&pile(n)));
    measure("by faults plane 64 bits", depth(24), |n| {
        by_faults(&plane(n));
    });
    measure("by faults pile 64 bits", depth(24), |n| by_faults(&pile(n)));
    measure("by faults plane 128 bits", depth(56), |n| {
        by_faults(&plane(n));
    });
    measure("exactly plane", depth(80), |n| exactly(&plane(n)));
    measure("squares plane", depth(80), |n| {
        let squares = plane(n).mean_square(&0.5_f64).expect("a mean");
        assert!(squares > 0.3 && squares < 0.4, "{squares}");
    });
    one_by_one(if smoke { 8 } else { 20 }, smoke);
}
