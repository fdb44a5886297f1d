//! The limits of sweeps on this machine: hand-written loops with the data flow of a sweep, but without its geometry.
//!
//! A sweep through sign changes reads three numbers of each sphere, turns them, adds three increments, and writes them back.
//! In floats it also writes three forces into slices. Here a layer is a flat slice with as many numbers, and every sphere has
//! the same increment.

use std::hint::black_box;

use cannonpile::Pile;
use cannonpile::shape::Selection;
use cannonpile_testkit::cases;
use num_traits::ToPrimitive;

use crate::fill::memset;
use crate::sweeps::{alternating, slices};
use crate::time::{ratio, seconds};
use crate::{Extent, Results, pool};

pub(crate) fn measure(extent: Extent, results: &mut Results) {
    let pile = alternating(extent.size(200, 12));
    let (mut filled, mut other) = (slices(&pile), slices(&pile));
    let loops = ratio(
        extent.pairs,
        || seconds(|| sweep_floats(&layers(&pile), &mut filled)),
        || seconds(|| memset(&mut other, 1.5)),
    );
    black_box((&filled, &other));
    results.push(("loop_f64_over_memset".into(), loops));

    for (full, smoke) in [(60, 6), (200, 8), (400, 10)] {
        let pile = alternating(extent.size(full, smoke));
        let planes = cases::limbs(pile.plan(Selection::Base).expect("a plan").bits);
        let mut other = slices(&pile);
        let loops = ratio(
            extent.pairs,
            || seconds(|| sweep_limbs(&layers(&pile), planes)),
            || seconds(|| memset(&mut other, 1.5)),
        );
        black_box(&other);
        results.push((format!("loop_limbs_over_memset_{full}"), loops));
    }
}

/// Compares loops on one thread with the same loops on two: in memory, and within the first cache.
pub(crate) fn measure_threads(extent: Extent, results: &mut Results) {
    for (name, length, repeats) in [
        ("memory", extent.size(1 << 23, 1 << 10), 1),
        ("cache", 1 << 10, extent.size(1 << 13, 4)),
    ] {
        let length = length.to_usize().expect("a length");
        let run = |numbers: &mut [f64]| {
            for _ in 0..repeats {
                for number in black_box(&mut *numbers) {
                    *number = *number * 0.5 + 1.0;
                }
            }
        };
        let time = |threads| {
            let pool = pool(threads);
            let [mut a, mut b] = [(); 2].map(|()| vec![1.5; length]);
            move || {
                pool.install(|| {
                    seconds(|| {
                        rayon::join(|| run(&mut a), || run(&mut b));
                    })
                })
            }
        };
        let speedup = ratio(extent.pairs, time(1), time(2));
        results.push((format!("two_threads_speedup_of_loop_in_{name}"), speedup));
    }
}

/// Returns the number of spheres of each layer above the floor.
fn layers(pile: &Pile) -> Vec<usize> {
    let layers = 0..pile.layers() - 1;
    let spheres = layers.map(|k| pile.shape().layer(k).expect("a layer").site_count());
    spheres.map(|n| n.to_usize().expect("few")).collect()
}

/// Updates the state of each layer, and writes its forces.
fn sweep_floats(layers: &[usize], slices: &mut [Vec<f64>; 3]) {
    let most = layers.last().copied().unwrap_or(0);
    let [mut a, mut b, mut c] = [(); 3].map(|()| vec![0.0; most]);
    let mut begin = 0;
    for spheres in layers {
        let [x, y, z] = slices
            .each_mut()
            .map(|slice| &mut slice[begin..begin + spheres]);
        let state = a.iter_mut().zip(&mut b).zip(&mut c);
        for (((a, b), c), ((x, y), z)) in state.zip(x.iter_mut().zip(y).zip(z)) {
            let whole = (*a + *b + *c) * (2.0 / 3.0) + 1.0;
            (*a, *b, *c) = (whole - *a, whole - *b, whole - *c);
            (*x, *y, *z) = (*a, *b, *c);
        }
        begin += spheres;
    }
}

/// Updates the state of a third of each layer, in limbs, and propagates carries once in three layers, as the sweep does.
fn sweep_limbs(layers: &[usize], planes: u64) {
    let most = layers.last().copied().unwrap_or(0) / 3 + 1;
    let mut limbs: Vec<[Vec<i64>; 3]> = (0..planes)
        .map(|_| [(); 3].map(|()| vec![1; most]))
        .collect();
    for (k, spheres) in layers.iter().enumerate() {
        let third = spheres / 3 + 1;
        for [a, b, c] in &mut limbs {
            for ((a, b), c) in a[..third]
                .iter_mut()
                .zip(&mut b[..third])
                .zip(&mut c[..third])
            {
                let whole = a
                    .wrapping_add(*b)
                    .wrapping_add(*c)
                    .wrapping_mul(2)
                    .wrapping_add(1);
                let turned = |x: i64| whole.wrapping_sub(x.wrapping_mul(3));
                (*a, *b, *c) = (turned(*a), turned(*b), turned(*c));
            }
        }
        if k % 3 == 2 {
            for p in 1..limbs.len() {
                let (below, above) = limbs.split_at_mut(p);
                for (lower, upper) in below[p - 1].iter_mut().zip(&mut above[0]) {
                    for (lower, upper) in lower[..third].iter_mut().zip(&mut upper[..third]) {
                        let carry = *lower >> 55;
                        *upper = upper.wrapping_add(carry);
                        *lower -= carry << 55;
                    }
                }
            }
        }
        black_box(&mut limbs);
    }
}
