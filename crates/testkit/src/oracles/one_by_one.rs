//! All stackings one by one: each pile built sphere by sphere, with the forces on each sphere in balance.
//!
//! Nothing of the library is used. Spheres are at places of the plane, counted along the horizontal
//! parts of the contacts β and γ of a + step; those of α lead by their negative sum, and a − step turns all of them round.

use std::collections::{BTreeMap, BTreeSet};

use num_rational::BigRational;
use num_traits::Zero;

/// A place, by its steps along β and γ.
pub type Place = [i64; 2];

/// What the floor feels under a sphere: normal in mg, shear_x in mg·tanθ, shear_y in √3·mg·tanθ.
pub type Floor = [BigRational; 3];

/// What a pile grows from.
#[derive(Clone, Debug)]
pub enum Grown {
    /// Layers that fill the plane: only what bears something is kept.
    Plane,
    /// These spheres, downwards.
    Top(BTreeSet<Place>),
    /// These spheres, upwards.
    Base(BTreeSet<Place>),
}

/// The place of a site of the layer by which sites are named.
pub fn of_site([i, j]: [i64; 2]) -> Place {
    [2 * i + j, i + 2 * j]
}

/// The contacts below a sphere after a step of a sign: α, β, γ.
fn contacts([a, b]: Place, sign: i64) -> [Place; 3] {
    [[a - sign, b - sign], [a + sign, b], [a, b + sign]]
}

/// Every sequence of signs of so many steps with this first sign, or with either.
pub fn sequences(steps: usize, first: Option<i64>) -> Vec<Vec<i64>> {
    let all = (0..1_u32 << steps).map(|bits| {
        let sign = |step: usize| if bits >> step & 1 == 0 { 1 } else { -1 };
        (0..steps).map(sign).collect::<Vec<_>>()
    });
    all.filter(|signs| first.is_none() || signs.first().is_none_or(|sign| Some(*sign) == first))
        .collect()
}

/// How often the sign changes.
pub fn faults(signs: &[i64]) -> usize {
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// The layers of a pile, from the top; `None` of a base that does not carry them.
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
                // A sphere above has one of its contacts, α, in the layer below.
                let above = below.iter().map(|[a, b]| [a + sign, b + sign]);
                let stands = |at: &Place| contacts(*at, *sign).iter().all(|c| below.contains(c));
                let above: BTreeSet<_> = above.filter(stands).collect();
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

/// Every sphere of the bottom layer, with what the floor feels; in the plane those places alone that some force comes to.
/// `None` if there is no such pile.
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
    // What comes to a sphere: along each contact from above.
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
            // Both components of the horizontal force, along β and γ.
            let over = BigRational::from_integer(sign_above.into());
            let along_b = (&fb - &fa) * &over;
            let along_c = (&fc - &fa) * &over;
            let mut vertical = fa + fb + fc + weight;
            if k == 0 {
                vertical += loads.get(at).cloned().unwrap_or_default();
            }
            match signs.get(k) {
                None => {
                    // β points to (−½, ½) of the units of shear, γ to (1, 0).
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
