//! All contact forces of a straight pile, written into slices, against filling the slices with one value.

use std::fmt::Debug;
use std::hint::black_box;

use cannonpile::geometry::Spacing;
use cannonpile::lattice::Site;
use cannonpile::{Packing, Pile, Strengths};
use num_rational::BigRational;

use crate::time::{ratio, seconds};
use crate::{Extent, Results};

pub(crate) fn measure(extent: Extent, results: &mut Results) {
    let pile = Pile::triangular(extent.size(560, 20)).expect("a pile");
    let spacing = Spacing::new(BigRational::new(6.into(), 5.into())).expect("a spacing");
    let packing = Packing::new(&pile, &spacing).expect("room");
    let strengths = Strengths::<f64>::nearest(&packing).expect("floats");
    let nearest = |site, direction| {
        packing
            .contact(site, direction)
            .expect("a contact")
            .nearest()
    };
    let fill = over_memset(&pile, &strengths, 1.5, extent.pairs, nearest);
    results.push(("fill_f64_over_memset".into(), fill));

    let statics = pile.forces::<BigRational>();
    let strengths = Strengths::<i64>::multiples(&pile).expect("integers");
    let multiple = |site, direction| {
        let force = statics.contact(site, direction).expect("a contact");
        force.to_integer().try_into().ok()
    };
    let fill = over_memset(&pile, &strengths, 3, extent.pairs, multiple);
    results.push(("fill_exact_i64_over_memset".into(), fill));
}

/// One slice for each direction, buffers touched before, and a value that is not zero.
fn over_memset<V: Copy + PartialEq + Debug + Send + Sync>(
    pile: &Pile,
    strengths: &Strengths<V>,
    value: V,
    pairs: usize,
    exact: impl Fn(Site, cannonpile::lattice::Direction) -> Option<V>,
) -> f64 {
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
            let time = seconds(|| memset(&mut other, value));
            black_box(&other);
            time
        },
    );
    check(pile, &slices, exact);
    ratio
}

/// Fills slices with one value.
pub(crate) fn memset<V: Copy>(slices: &mut [Vec<V>; 3], value: V) {
    for slice in slices {
        black_box(slice.as_mut_slice()).fill(black_box(value));
    }
}

/// Every thousandth sphere's forces, asked for one by one.
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
