//! How fast all forces of a pile are written, against filling the same memory with one value.
//!
//! `cargo bench --bench throughput` prints, last, lines `ratio NAME VALUE`, medians of pairs measured in turn in one run;
//! with `-- --smoke` it only checks the answers, on small piles, and that the bench runs.

use std::env;
use std::hint::black_box;
use std::time::Instant;

use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Region, Selection, Site};
use cannonpile::scalar::Algebra;
use cannonpile::stacking::Stacking;
use cannonpile::{Packing, Pile, Strengths};
use num_rational::BigRational;

fn main() {
    let smoke = env::args().any(|argument| argument == "--smoke");
    let pairs = if smoke { 1 } else { 9 };
    let layers = if smoke { 20 } else { 560 };
    let pile = Pile::triangular(layers).expect("a pile");
    let spacing = Spacing::new(BigRational::new(6.into(), 5.into())).expect("a spacing");
    let packing = Packing::new(&pile, &spacing).expect("room");

    let strengths = Strengths::<f64>::nearest(&packing).expect("floats");
    let fill_f64 = fill_over_memset(&strengths, 1.5, pairs);
    let strengths = Strengths::<i64>::multiples(&pile).expect("integers");
    let fill_exact_i64 = fill_over_memset(&strengths, 3, pairs);

    let alternating = |layers| {
        let stacking = Stacking::hcp(layers).expect("a stacking");
        Pile::under(Region::SITE, stacking).expect("a pile")
    };
    let layers = if smoke { [6, 8, 10] } else { [60, 200, 400] };
    let exact_over_f64 = layers.map(|layers| {
        let pile = alternating(layers);
        ratio(
            pairs,
            || time_base::<BigRational>(&pile),
            || time_base::<f64>(&pile),
        )
    });

    println!("ratio fill_f64_over_memset {fill_f64:.2}");
    println!("ratio fill_exact_i64_over_memset {fill_exact_i64:.2}");
    for (layers, value) in layers.iter().zip(exact_over_f64) {
        println!("ratio base_exact_over_f64_{layers} {value:.1}");
    }
}

/// The median of `pairs` ratios of two times, measured in turn.
fn ratio(pairs: usize, mut one: impl FnMut() -> f64, mut other: impl FnMut() -> f64) -> f64 {
    let mut ratios: Vec<f64> = (0..pairs).map(|_| one() / other()).collect();
    ratios.sort_by(f64::total_cmp);
    ratios[pairs / 2]
}

fn seconds(run: impl FnOnce()) -> f64 {
    let begun = Instant::now();
    run();
    begun.elapsed().as_secs_f64()
}

/// All forces, one slice for each direction, against filling the slices with a value that is not zero.
fn fill_over_memset<V>(strengths: &Strengths<V>, value: V, pairs: usize) -> f64
where
    V: Copy + PartialEq + std::fmt::Debug,
{
    let spheres = strengths.spheres().expect("as many as fit");
    let mut slices = [value; 3].map(|value| vec![value; spheres]);
    let mut other = slices.clone();
    let ratio = ratio(
        pairs,
        || {
            let [a, b, c] = slices.each_mut().map(Vec::as_mut_slice);
            let time = seconds(|| {
                strengths
                    .fill(black_box([a, b, c]))
                    .expect("lengths that fit");
            });
            black_box(&slices);
            time
        },
        || {
            let time = seconds(|| {
                for slice in &mut other {
                    black_box(slice.as_mut_slice()).fill(black_box(value));
                }
            });
            black_box(&other);
            time
        },
    );
    // The last sphere above the floor has all its spheres above along γ, and none along α and β.
    let [a, b, c] = &slices;
    let last = spheres - 1;
    assert_eq!([a[last], b[last], c[0]], [a[0], b[0], a[0]]);
    let apart = a.iter().zip(&b[..]).filter(|(a, b)| a == b).count();
    assert!(apart < spheres && c[last] != c[0]);
    ratio
}

/// The base of a pile, all of it, by a sweep.
fn time_base<T: Algebra>(pile: &Pile) -> f64 {
    let statics = pile.statics::<T>();
    let rows = pile.rows(Selection::Base).expect("a base");
    let mut last = None;
    let time = seconds(|| last = black_box(statics.base(rows)).last());
    let found = last.expect("a sphere").expect("a force");
    let Site { k, .. } = found.site;
    assert_eq!(k, pile.layers() - 1);
    time
}
