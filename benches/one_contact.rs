//! Run times of one contact force and of one base force, in piles of 10 and of 10³⁶ layers.
//!
//! `cargo bench --manifest-path benches/Cargo.toml --bench one_contact`
//! prints nanoseconds and, last, lines `ratio NAME VALUE`. With `-- --smoke` it only asserts the results.

use std::env;
use std::hint::black_box;
use std::time::{Duration, Instant};

use cannonpile::Pile;
use cannonpile::lattice::{Direction, MAX_LAYERS, Site};
use cannonpile::scalar::{Algebra, Field};
use num_rational::BigRational;

fn main() {
    let smoke = env::args().any(|argument| argument == "--smoke");
    let pairs = if smoke { 1 } else { 15 };
    let small = Pile::triangular(10).expect("ten layers");
    let great = Pile::triangular(MAX_LAYERS).expect("the most layers");

    println!("scalar        query        L = 10 (ns)  L = 10^36 (ns)");
    let mut ratios = Vec::new();
    measure::<f64>(&small, &great, pairs, &mut ratios);
    measure::<BigRational>(&small, &great, pairs, &mut ratios);
    for (name, value) in ratios {
        println!("ratio {name} {value:.2}");
    }
}

/// Times both queries on both piles alternately, and returns the ratio of the medians.
fn measure<T: Field>(small: &Pile, great: &Pile, pairs: usize, ratios: &mut Vec<(String, f64)>) {
    let queries: [(&str, Timer); 2] = [
        ("contact", time_contact::<T>),
        ("on_floor", time_floor::<T>),
    ];
    for (query, time) in queries {
        let (mut of_small, mut of_great) = (Vec::new(), Vec::new());
        for _ in 0..pairs {
            of_small.push(time(small));
            of_great.push(time(great));
        }
        let (a, b) = (median(of_small), median(of_great));
        println!("{:13} {query:12} {a:11.1}  {b:14.1}", T::NAME);
        ratios.push((format!("{query}_great_over_small_{}", T::NAME), b / a));
    }
}

/// Times one query of a pile.
type Timer = fn(&Pile) -> Duration;

const CALLS: u32 = 2000;

fn time_contact<T: Algebra>(pile: &Pile) -> Duration {
    let forces = pile.forces::<T>();
    let k = pile.layers() / 2;
    let site = Site {
        i: k / 4,
        j: k / 3,
        k,
    };
    // Site (1, 1, 5) of the small pile has three spheres above on the line, so its force is 4.
    let want = T::from_integer(k - site.i - site.j + 1);
    assert_eq!(
        forces.contact(site, Direction::Alpha).expect("a contact"),
        want
    );
    let start = Instant::now();
    for _ in 0..CALLS {
        black_box(forces.contact(black_box(site), Direction::Alpha)).expect("a contact");
    }
    start.elapsed() / CALLS
}

fn time_floor<T: Field>(pile: &Pile) -> Duration {
    let forces = pile.forces::<T>();
    let site = Site {
        i: 1,
        j: 2,
        k: pile.layers() - 1,
    };
    let third = 3.try_into().expect("not zero");
    let want = T::from_integer(pile.layers() + 2).div_int(third);
    // In floats L + 2 and the sum of the counts may round differently.
    let normal = forces.on_floor(site).expect("a base sphere").normal;
    let off = (normal.clone() - &want)
        .checked_div(&want)
        .expect("not zero");
    assert!(
        off == T::zero() || T::NAME == "f64",
        "{normal:?} is not {want:?}"
    );
    let start = Instant::now();
    for _ in 0..CALLS {
        black_box(forces.on_floor(black_box(site))).expect("a base sphere");
    }
    start.elapsed() / CALLS
}

/// Returns the median, in nanoseconds.
fn median(mut times: Vec<Duration>) -> f64 {
    times.sort_unstable();
    times[times.len() / 2].as_secs_f64() * 1e9
}
