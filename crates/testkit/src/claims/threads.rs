//! Threads do not change answers. Most piles are large enough that threads share the rows of a sweep, and some layers are
//! large enough that threads share their slices.
//!
//! Each call runs in pools of one and of several threads: floats and numerators, as slices.

use std::sync::OnceLock;

use arbitrary::Unstructured;
use cannonpile::Pile;
use cannonpile::lattice::{Region, Sign, Site};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::{Checked, Failure, same};
use crate::generators::number::ratio;
use crate::generators::rarely;

/// Compares the forces of all contacts, and those on the floor, in pools of one and of up to five threads.
pub fn any_number(u: &mut Unstructured<'_>) -> Checked {
    let pile = large(u)?;
    let number = u.int_in_range(2..=5)?;
    agree(&pile, number)
}

/// A pile of a few layers, with up to two loads, under a hexagon or on one.
fn large(u: &mut Unstructured<'_>) -> Result<Pile, Failure> {
    // A layer of 2·4096 spheres is written into slices by two threads. This hexagon has 8587.
    let [p, q] = if rarely(u, 6)? {
        [54, 54]
    } else {
        [u.int_in_range(24..=36)?, u.int_in_range(8..=36)?]
    };
    let mut signs = Vec::new();
    for _ in 0..u.int_in_range(1..=7)? {
        signs.push(if u.arbitrary()? {
            Sign::Plus
        } else {
            Sign::Minus
        });
    }
    let (region, stacking) = (Region::hexagon(p, q)?, Stacking::from_signs(signs)?);
    let mut pile = if rarely(u, 3)? {
        Pile::on(region, stacking)?
    } else {
        Pile::under(region, stacking)?
    };
    for _ in 0..u.int_in_range(0..=2)? {
        let k = u.int_in_range(0..=pile.layers() - 1)?;
        let corners = pile.shape().layer(k)?.corners();
        let [i, j] = *u.choose(&corners)?;
        let load = ratio(u.int_in_range(1..=9)?, u.int_in_range(1..=9)?);
        pile = pile.with_load(Site { i, j, k }, load)?;
    }
    Ok(pile)
}

/// Compares the answers about one pile. Floats must be equal to the last bit.
fn agree(pile: &Pile, number: usize) -> Checked {
    let one = in_pool(1, || Filled::of(pile))?;
    let several = in_pool(number, || Filled::of(pile))?;
    same("floats", &several.floats, &one.floats)?;
    same("numerators", &several.numerators, &one.numerators)?;
    same("floats on the floor", &several.floor, &one.floor)
}

/// Three values for each sphere.
type Slices<T> = [Vec<T>; 3];

/// The forces of all contacts, as floats and as numerators, and the floats on the floor.
struct Filled {
    floats: Slices<f64>,
    numerators: Slices<BigInt>,
    floor: Slices<f64>,
}

impl Filled {
    fn of(pile: &Pile) -> Result<Self, Failure> {
        let layers = pile.forces::<f64>().layers(Selection::All)?;
        let mut floats = empty(layers.slice_len()?);
        layers.fill(floats.each_mut().map(Vec::as_mut_slice))?;
        let layers = pile.forces::<BigRational>().layers(Selection::All)?;
        let layers = layers.numerators::<BigInt>()?;
        let mut numerators = empty(layers.slice_len()?);
        layers.fill(numerators.each_mut().map(Vec::as_mut_slice))?;
        let forces = pile.forces::<f64>();
        let mut layers = forces.layers(Selection::Base)?;
        let base = layers.next_layer()?;
        let base = base.ok_or_else(|| Failure::Refuted("no base".to_owned()))?;
        let mut floor = empty(base.sphere_count());
        base.fill_base(floor.each_mut().map(Vec::as_mut_slice))?;
        Ok(Self {
            floats,
            numerators,
            floor,
        })
    }
}

fn empty<T: Clone + Zero>(spheres: usize) -> Slices<T> {
    [(); 3].map(|()| vec![T::zero(); spheres])
}

/// Calls `work` in a pool of so many threads, at most five. The pools stay.
fn in_pool<T: Send>(
    threads: usize,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> Result<T, Failure> {
    static POOLS: [OnceLock<Option<ThreadPool>>; 6] = [const { OnceLock::new() }; 6];
    let start = || {
        let pool = ThreadPoolBuilder::new().num_threads(threads);
        pool.build().ok()
    };
    let pool = POOLS
        .get(threads)
        .and_then(|pool| pool.get_or_init(start).as_ref());
    pool.ok_or_else(|| Failure::Refuted(format!("no pool of {threads} threads")))?
        .install(work)
}

#[cfg(test)]
mod injected_faults {
    use super::*;

    #[test]
    fn pools_have_their_threads() {
        for threads in 1..=5 {
            let found = in_pool(threads, || Ok(rayon::current_num_threads()));
            assert!(found.is_ok_and(|found| found == threads));
        }
        assert!(in_pool(6, || Ok(())).is_err());
    }

    #[test]
    fn a_changed_float_is_caught() {
        let pile = Pile::triangular(3).unwrap();
        let fill = || in_pool(2, || Filled::of(&pile)).ok().unwrap().floats;
        let mut wrong = fill();
        assert!(same("floats", &wrong, &fill()).is_ok());
        wrong[2][1] = wrong[2][1].next_up();
        assert!(same("floats", &wrong, &fill()).is_err());
    }
}
