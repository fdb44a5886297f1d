//! Layers as plain sets of sites, by the definitions alone: the oracle of regions and of the engines.
//!
//! A site is kept as (j, i), so that a set is in row order.

use std::collections::BTreeSet;

use cannonpile::lattice::Sign;

/// The sites of one layer, each as (j, i).
pub type Sites = BTreeSet<(i128, i128)>;

/// Where a sphere (j, i) stands: on its supports α, β, γ (`paper`, "Stackings").
pub fn supports((j, i): (i128, i128), sign: Sign) -> [(i128, i128); 3] {
    match sign {
        Sign::Plus => [(j, i), (j, i + 1), (j + 1, i)],
        Sign::Minus => [(j, i), (j, i - 1), (j - 1, i)],
    }
}

/// The sites between six bounds x₀, x₁, y₀, y₁, s₀, s₁ that are all within ±`reach`.
pub fn within([x0, x1, y0, y1, s0, s1]: [i128; 6], reach: i128) -> Sites {
    let square = (-reach..=reach).flat_map(|j| (-reach..=reach).map(move |i| (j, i)));
    square
        .filter(|(j, i)| {
            let s = i + j;
            x0 <= *i && *i <= x1 && y0 <= *j && *j <= y1 && s0 <= s && s <= s1
        })
        .collect()
}

/// Every support of every site.
pub fn dilated(layer: &Sites, sign: Sign) -> Sites {
    layer
        .iter()
        .flat_map(|site| supports(*site, sign))
        .collect()
}

/// Every site whose three supports are there.
pub fn eroded(layer: &Sites, sign: Sign) -> Sites {
    let stands = |site: &(i128, i128)| supports(*site, sign).iter().all(|s| layer.contains(s));
    // Its own α support has the name of the sphere.
    layer.iter().copied().filter(stands).collect()
}

/// The layers of a pile grown down from its top, the top first.
pub fn under(top: Sites, signs: &[Sign]) -> Vec<Sites> {
    let mut layers = vec![top];
    for (k, sign) in signs.iter().enumerate() {
        layers.push(dilated(&layers[k], *sign));
    }
    layers
}

/// The layers of a pile grown up from its base, the top first; some may be empty.
pub fn on(base: Sites, signs: &[Sign]) -> Vec<Sites> {
    let mut layers = vec![base];
    for (k, sign) in signs.iter().rev().enumerate() {
        layers.push(eroded(&layers[k], *sign));
    }
    layers.reverse();
    layers
}
