//! Layers as plain sets of sites, by the definitions alone. This is the oracle of regions and of the engines.
//!
//! A site is stored as (j, i), so a set is in row order.

use std::collections::BTreeSet;

use cannonpile::lattice::Sign;

/// The sites of one layer, each as (j, i).
pub type Sites = BTreeSet<(i128, i128)>;

/// The supports α, β, γ of a sphere (j, i) (`paper`, "Stackings").
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

/// All supports of all sites.
pub fn dilated(layer: &Sites, sign: Sign) -> Sites {
    layer
        .iter()
        .flat_map(|site| supports(*site, sign))
        .collect()
}

/// All sites with three supports in the layer.
pub fn eroded(layer: &Sites, sign: Sign) -> Sites {
    let is_supported =
        |site: &(i128, i128)| supports(*site, sign).iter().all(|s| layer.contains(s));
    // A sphere has the same name as its α support.
    layer.iter().copied().filter(is_supported).collect()
}

/// The layers of a pile that grows down from its top, the top first.
pub fn under(top: Sites, signs: &[Sign]) -> Vec<Sites> {
    let mut layers = vec![top];
    for (k, sign) in signs.iter().enumerate() {
        layers.push(dilated(&layers[k], *sign));
    }
    layers
}

/// The layers of a pile that grows up from its base, the top first. Some may be empty.
pub fn on(base: Sites, signs: &[Sign]) -> Vec<Sites> {
    let mut layers = vec![base];
    for (k, sign) in signs.iter().rev().enumerate() {
        layers.push(eroded(&layers[k], *sign));
    }
    layers.reverse();
    layers
}
