//! All stackings, enumerated one by one. Each pile is built sphere by sphere, with the forces on each sphere in balance.
//!
//! The oracle uses nothing of the library. A position in the plane counts the horizontal parts of the contacts β and γ of
//! a step with sign +. A contact α moves by the negative of their sum. The sign − reverses all three.

use std::collections::{BTreeMap, BTreeSet};

use num_rational::BigRational;
use num_traits::Zero;

/// A position, by its steps along β and γ.
pub type Place = [i64; 2];

/// The force on the floor below a sphere: normal in mg, shear_x in mg·tanθ, shear_y in √3·mg·tanθ.
pub type Floor = [BigRational; 3];

/// The origin of a pile.
#[derive(Clone, Debug)]
pub enum Grown {
    /// Layers that fill the plane. Only spheres with a nonzero force are kept.
    Plane,
    /// Downwards from these spheres.
    Top(BTreeSet<Place>),
    /// Upwards from these spheres.
    Base(BTreeSet<Place>),
}

/// The position of a site of the top layer, or of the base for a pile that grows upwards.
pub fn of_site([i, j]: [i64; 2]) -> Place {
    [2 * i + j, i + 2 * j]
}

/// The contacts α, β, γ below a sphere, for a step of this sign.
fn contacts([a, b]: Place, sign: i64) -> [Place; 3] {
    [[a - sign, b - sign], [a + sign, b], [a, b + sign]]
}

/// All sequences of `steps` signs with this first sign, or with either.
pub fn sequences(steps: usize, first: Option<i64>) -> Vec<Vec<i64>> {
    let all = (0..1_u32 << steps).map(|bits| {
        let sign = |step: usize| if bits >> step & 1 == 0 { 1 } else { -1 };
        (0..steps).map(sign).collect::<Vec<_>>()
    });
    all.filter(|signs| first.is_none() || signs.first().is_none_or(|sign| Some(*sign) == first))
        .collect()
}

/// The number of sign changes.
pub fn faults(signs: &[i64]) -> usize {
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// The layers of a pile, from the top. `None` if the base does not support them.
fn layers(from: &Grown, signs: &[i64]) -> Option<Vec<BTreeSet<Place>>> {
    match from {
        Grown::Plane => None,
        Grown::Top(top) => {
            let mut layers = vec![top.clone()];
            for sign in signs {
                let above = layers.last().unwrap();
                layers.push(above.iter().flat_map(|at| contacts(*at, *sign)).collect());
            }
            Some(layers)
        }
        Grown::Base(base) => {
            let mut layers = vec![base.clone()];
            for sign in signs.iter().rev() {
                let below = layers.last().unwrap();
                // A sphere of the layer above has its α support in the layer below.
                let above = below.iter().map(|[a, b]| [a + sign, b + sign]);
                let is_supported =
                    |at: &Place| contacts(*at, *sign).iter().all(|c| below.contains(c));
                let above: BTreeSet<_> = above.filter(is_supported).collect();
                if above.is_empty() {
                    return None;
                }
                layers.push(above);
            }
            layers.reverse();
            Some(layers)
        }
    }
}

/// Every sphere of the bottom layer and its force on the floor. In the plane, only the positions that some force reaches.
/// `None` if the pile does not exist.
pub fn bottom(
    from: &Grown,
    weight: &BigRational,
    loads: &BTreeMap<Place, BigRational>,
    signs: &[i64],
) -> Option<BTreeMap<Place, Floor>> {
    let layers = match from {
        Grown::Plane => None,
        Grown::Top(_) | Grown::Base(_) => Some(layers(from, signs)?),
    };
    let third = BigRational::new(1.into(), 3.into());
    // The forces on a sphere from above, along each contact.
    let mut above: BTreeMap<Place, [BigRational; 3]> = BTreeMap::new();
    let mut sign_above = 1;
    for k in 0..=signs.len() {
        let spheres: BTreeSet<Place> = match &layers {
            Some(layers) => layers[k].clone(),
            None => above
                .keys()
                .copied()
                .chain(loads.keys().copied().filter(|_| k == 0))
                .collect(),
        };
        let mut below: BTreeMap<Place, [BigRational; 3]> = BTreeMap::new();
        let mut floor = BTreeMap::new();
        for at in &spheres {
            let zero = || [(); 3].map(|()| BigRational::zero());
            let [fa, fb, fc] = above.remove(at).unwrap_or_else(zero);
            // The components of the horizontal force along β and γ.
            let over = BigRational::from_integer(sign_above.into());
            let along_b = (&fb - &fa) * &over;
            let along_c = (&fc - &fa) * &over;
            let mut vertical = fa + fb + fc + weight;
            if k == 0 {
                vertical += loads.get(at).cloned().unwrap_or_default();
            }
            match signs.get(k) {
                None => {
                    // In the units of shear, β points to (−½, ½) and γ to (1, 0).
                    let half = BigRational::new(1.into(), 2.into());
                    let shear_y = &along_b * &half;
                    floor.insert(*at, [vertical, along_c - &shear_y, shear_y]);
                }
                Some(sign) => {
                    let turned = BigRational::from_integer((*sign).into());
                    let (b, c) = (along_b * &turned, along_c * &turned);
                    let a = (vertical - &b - &c) * &third;
                    let passed = [a.clone(), b + &a, c + &a];
                    for (direction, (to, force)) in
                        contacts(*at, *sign).into_iter().zip(passed).enumerate()
                    {
                        below.entry(to).or_insert_with(zero)[direction] += force;
                    }
                }
            }
        }
        assert!(above.is_empty(), "forces without spheres: {above:?}");
        match signs.get(k) {
            None => return Some(floor),
            Some(sign) => (above, sign_above) = (below, *sign),
        }
    }
    None
}
