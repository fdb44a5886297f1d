//! Compares the time to write all contact forces of a straight pile into slices with the time to fill these slices with
//! one value.

use std::fmt::Debug;
use std::hint::black_box;

use cannonpile::geometry::Spacing;
use cannonpile::lattice::Site;
use cannonpile::shape::Selection;
use cannonpile::{Packing, Pile};
use num_rational::BigRational;

use crate::time::{ratio, seconds};
use crate::{Extent, Results};

pub(crate) fn measure(extent: Extent, results: &mut Results) {
    let pile = Pile::triangular(extent.size(560, 20)).expect("a pile");
    let spacing = Spacing::new(BigRational::new(6.into(), 5.into())).expect("a spacing");
    let packing = Packing::new(&pile, &spacing).expect("room");
    let nearest = |site, direction| {
        packing
            .contact(site, direction)
            .expect("a contact")
            .nearest()
    };
    let filling = |slices: [&mut [f64]; 3]| {
        let layers = packing.layers::<f64>(Selection::All).expect("floats");
        seconds(|| layers.fill(black_box(slices)).expect("lengths that fit"))
    };
    let fill = over_memset(&pile, filling, 1.5, extent.pairs, nearest);
    results.push(("fill_f64_over_memset".into(), fill));

    let forces = pile.forces::<BigRational>();
    let multiple = |site, direction| {
        let force = forces.contact(site, direction).expect("a contact");
        force.to_integer().try_into().ok()
    };
    let filling = |slices: [&mut [i64]; 3]| {
        let layers = forces.layers(Selection::All).expect("room");
        let layers = layers.numerators::<i64>().expect("integers");
        seconds(|| {
            let denominator = layers.fill(black_box(slices)).expect("lengths that fit");
            assert_eq!(denominator, 1.into());
        })
    };
    let fill = over_memset(&pile, filling, 3, extent.pairs, multiple);
    results.push(("fill_exact_i64_over_memset".into(), fill));
}

/// Returns the median ratio of the time of `filling` to that of [`memset`] on slices of the same length.
///
/// The slices contain `value` from the start. It is not zero, so that the memory is already mapped.
fn over_memset<V: Copy + PartialEq + Debug + Send + Sync>(
    pile: &Pile,
    mut filling: impl FnMut([&mut [V]; 3]) -> f64,
    value: V,
    pairs: usize,
    exact: impl Fn(Site, cannonpile::lattice::Direction) -> Option<V>,
) -> f64 {
    let layers = pile.forces::<f64>().layers(Selection::All);
    let spheres = layers
        .and_then(|layers| layers.slice_len())
        .expect("as many as fit");
    let mut slices = [value; 3].map(|value| vec![value; spheres]);
    let mut other = slices.clone();
    let ratio = ratio(
        pairs,
        || {
            let time = filling(slices.each_mut().map(Vec::as_mut_slice));
            black_box(&slices);
            time
        },
        || {
            let time = seconds(|| memset(&mut other, value));
            black_box(&other);
            time
        },
    );
    check(pile, &slices, exact);
    ratio
}

/// Fills each slice with one value.
pub(crate) fn memset<V: Copy>(slices: &mut [Vec<V>; 3], value: V) {
    for slice in slices {
        black_box(slice.as_mut_slice()).fill(black_box(value));
    }
}

/// Compares the forces of up to a thousand spheres, evenly spaced in row order, with single queries.
pub(crate) fn check<V: PartialEq + Debug + Copy>(
    pile: &Pile,
    slices: &[Vec<V>; 3],
    exact: impl Fn(Site, cannonpile::lattice::Direction) -> Option<V>,
) {
    let rows = pile.rows(cannonpile::shape::Selection::All).expect("rows");
    let sites = rows.off_the_floor().flatten();
    let step = slices[0].len() / 1000 + 1;
    for (place, site) in sites.enumerate().step_by(step) {
        for direction in cannonpile::lattice::Direction::ALL {
            let found = slices[direction.index()][place];
            assert_eq!(Some(found), exact(site, direction), "{site} {direction}");
        }
    }
}
