//! What random stackings cost: means over all of them, and all of them one by one.
//!
//! `cargo bench --manifest-path benches/Cargo.toml --bench disorder`
//! prints seconds and, last, lines `ratio NAME VALUE`: the powers of the number of steps by which times grow from half as many.
//! With `-- --smoke` it only checks the answers, of few steps. Every mean keeps the load and its second moment, every count is
//! that of the census.

use std::env;
use std::time::Instant;

use cannonpile::disorder::{
    By, Choice, Ensemble, FirstSign, RandomPiles, RandomStackings, Samples, Shard,
};
use cannonpile::lattice::{Region, Site};
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};

fn main() {
    let smoke = env::args().any(|argument| argument == "--smoke");
    println!("seconds  what");
    let steps = if smoke { [6, 12] } else { [80, 160] };
    let mean = steps.map(in_floats);
    let steps = if smoke { [4, 8] } else { [20, 40] };
    let faults = steps.map(by_faults);
    let layers = if smoke { 8 } else { 20 };
    one_by_one(layers, smoke);
    for (name, [half, whole]) in [("mean_f64_exponent", mean), ("by_faults_exponent", faults)] {
        println!("ratio {name} {:.2}", (whole / half).log2());
    }
}

/// The response to a unit load, so many steps below it.
fn response(steps: i128) -> RandomPiles {
    let stackings = RandomStackings::new(steps + 1, FirstSign::Plus).expect("stackings");
    let plane = RandomPiles::plane(stackings).weightless();
    plane
        .with_load(Site::APEX, BigRational::one())
        .expect("a load")
}

/// The mean at q = 1/2 in floats: its seconds.
fn in_floats(steps: i128) -> f64 {
    let piles = response(steps);
    let (mean, seconds) = timed(|| piles.mean(&0.5).expect("a mean"));
    let moment = |power: i32| -> f64 {
        let rows = mean.rows().iter().map(|row| {
            let square = row.place.distance_squared().and_then(|r| r.to_f64());
            row.normal * square.expect("near").powi(power)
        });
        rows.sum()
    };
    let depth = steps.to_f64().expect("few");
    assert!((moment(0) - 1.0).abs() < 1e-12);
    assert!((moment(1) / (depth * depth) - 1.0).abs() < 1e-11);
    say(&format!("mean response in f64, {steps} steps"), seconds);
    seconds
}

/// All means at once, as integers by the number of faults: its seconds.
fn by_faults(steps: i128) -> f64 {
    let piles = response(steps);
    let (faults, seconds) = timed(|| piles.by_faults().expect("counts"));
    let mut sums = vec![BigRational::zero(); faults.most_faults() + 1];
    for row in faults.rows() {
        let row = row.expect("a row");
        sums[row.faults as usize] += row.normal;
    }
    // The load, once for each stacking.
    let stackings = piles.stackings();
    for (faults, sum) in (0..).zip(sums) {
        let count = BigRational::from_integer(BigInt::from(stackings.count_with(faults)));
        assert_eq!(sum, count, "{faults} faults");
    }
    say(&format!("means by faults, exact, {steps} steps"), seconds);
    seconds
}

/// All stackings under one sphere, and samples of twelve layers.
fn one_by_one(layers: i128, smoke: bool) {
    let under = |layers| {
        let stackings = RandomStackings::new(layers, FirstSign::Plus).expect("stackings");
        Ensemble::under(Region::SITE, stackings).expect("an ensemble")
    };
    let all = under(layers);
    let (tally, seconds) = timed(|| all.run(&Choice::All, Shard::WHOLE).expect("a tally"));
    assert_eq!(tally.standing(By::Sloping), Some(BigUint::from(11_u32)));
    let what = format!("all {} stackings of {layers} layers", tally.stackings());
    say(&what, seconds);
    let count = if smoke { 100 } else { 1_000_000 };
    let half = BigRational::new(1.into(), 2.into());
    let samples = Choice::Drawn(Samples::new(count, 1, half).expect("samples"));
    let twelve = under(12);
    let (tally, seconds) = timed(|| twelve.run(&samples, Shard::WHOLE).expect("a tally"));
    assert_eq!(tally.stackings(), count.into());
    say(&format!("{count} samples of 12 layers"), seconds);
}

fn timed<T>(run: impl FnOnce() -> T) -> (T, f64) {
    let begun = Instant::now();
    let answer = run();
    (answer, begun.elapsed().as_secs_f64())
}

fn say(what: &str, seconds: f64) {
    println!("{seconds:7.3}  {what}");
}
