//! Overlap by brute force: the distances of all pairs of spheres in a pile.
//!
//! Relative to the apex, centres are r = −2R[(k−i−j) ê_a + i ê_b + j ê_c] (`paper`, "Notation"). All values are machine
//! integers over a common denominator. Debug builds check them for overflow.

use std::collections::BTreeSet;

use cannonpile::Error;
use cannonpile::geometry::LayerGap;
use num_rational::BigRational;
use num_traits::ToPrimitive;

use cannonpile_testkit::answers::Shape;

/// The difference of two spheres, in steps of 2R along ê_a, ê_b, ê_c.
pub(crate) type Difference = [i128; 3];

/// The differences of all pairs of spheres in a pile, from the higher sphere to the lower one.
pub(crate) fn differences(shape: &Shape, layers: i128) -> BTreeSet<Difference> {
    let steps = |shape: &Shape| {
        shape
            .sites(layers)
            .into_iter()
            .map(|s| [s.k - s.i - s.j, s.i, s.j])
    };
    let mut differences = BTreeSet::new();
    for (place, [a, b, c]) in steps(shape).enumerate() {
        for [x, y, z] in steps(shape).skip(place + 1) {
            differences.insert([x - a, y - b, z - c]);
        }
    }
    differences
}

/// The squared horizontal distance over 4R²sin²θ, as numerator and denominator.
///
/// By components: x = (n_a + n_b) s − n_c and y = (n_a − n_b) cosφ, or x = n_a − n_b for discs.
fn horizontal(shape: &Shape, [a, b, c]: Difference) -> (i128, i128) {
    match shape {
        Shape::Discs => ((a - b).pow(2), 1),
        Shape::Spheres(sin_phi) => {
            let (s, r) = machine(sin_phi);
            let x = (a + b) * s - c * r;
            (x.pow(2) + (a - b).pow(2) * (r * r - s * s), r * r)
        }
    }
}

/// q at sin²θ = 1, where a contact would be horizontal.
pub(crate) fn flat(shape: &Shape) -> i128 {
    match shape {
        Shape::Discs => 4,
        Shape::Spheres(_) => 3,
    }
}

/// The squared distance over 4R² at spacing √q, as numerator and denominator:
/// sin²θ (x² + y²) + cos²θ z², with z = n_a + n_b + n_c and sin²θ = q/3, q/4 for discs.
pub(crate) fn squared_distance(shape: &Shape, n: Difference, q: &BigRational) -> (i128, i128) {
    let (u, v) = machine(q);
    let (h, r) = horizontal(shape, n);
    let z: i128 = n.iter().sum();
    let one = flat(shape) * v;
    (u * h + (one - u) * z * z * r, one * r)
}

/// The positive q at which spheres with the difference n touch, if it exists.
pub(crate) fn touching_at(shape: &Shape, n: Difference) -> Option<BigRational> {
    // q/flat·(h − z²) = 1 − z²
    let (h, r) = horizontal(shape, n);
    let z: i128 = n.iter().sum();
    let (slope, rise) = (h - z * z * r, flat(shape) * (1 - z * z) * r);
    (slope != 0 && slope.signum() == rise.signum())
        .then(|| BigRational::new(rise.into(), slope.into()))
}

/// Tells whether spacing √q is allowed. If it is, returns the layer gaps of pairs that touch in addition to the contacts.
/// `None` if some spheres overlap or a sphere would fall through.
pub(crate) fn allowed_gaps(
    shape: &Shape,
    differences: &BTreeSet<Difference>,
    q: &BigRational,
) -> Option<BTreeSet<i128>> {
    let (u, v) = machine(q);
    if u >= flat(shape) * v {
        return None;
    }
    let mut touching = BTreeSet::new();
    for n in differences {
        let (distance, one) = squared_distance(shape, *n, q);
        if distance < one {
            return None;
        }
        let contact = matches!(n, [1, 0, 0] | [0, 1, 0] | [0, 0, 1]);
        if distance == one && !contact {
            touching.insert(n.iter().sum());
        }
    }
    Some(touching)
}

/// Tells whether the library gives the same answer.
pub(crate) fn agree(
    allowed_gaps: Option<&BTreeSet<i128>>,
    answer: &Result<Vec<LayerGap>, Error>,
) -> bool {
    match (allowed_gaps, answer) {
        (None, Err(_)) => true,
        (Some(touching), Ok(apart)) => {
            let gaps = apart.iter().map(|apart| i128::from(apart.layers));
            gaps.eq(touching.iter().copied())
        }
        _ => false,
    }
}

fn machine(r: &BigRational) -> (i128, i128) {
    let part = |n: &num_bigint::BigInt| n.to_i128().expect("a small number");
    (part(r.numer()), part(r.denom()))
}
