//! A straight pile on a round base. The layers of a `Pile` have at most six straight sides, but the formulas need none.
//!
//! The base is any set of sites. The pile grows upwards: a layer holds each site whose three supports are present. So the
//! spheres on a line of contacts have no gap, and a contact force in f₀ is the number of spheres above it on its line. Run it
//! with `cargo run --example round_base`.
//!
//! Equilibrium holds, and the floor carries the weight. Each line of m contacts is a chain, with the singular values
//! 2 cos(jπ/(2m+1)), j = 1 … m, of the equilibrium matrix. The pressure is not uniform, and the layers above the base are
//! not round: each is the part that three shifted copies of the layer below have in common.

use std::collections::BTreeSet;
use std::iter;

use cannonpile::formula::{force, increments, support_load, transmitted, unbalanced, weight};
use cannonpile::geometry::{Vector, directions};
use cannonpile::lattice::{Direction, Sign};
use cannonpile::num_rational::BigRational;
use cannonpile::ratio;

/// The sites (i, j) of a layer.
pub(crate) type Layer = BTreeSet<[i128; 2]>;

/// Returns the site that is `steps` layers further down on a line of contacts.
fn down([i, j]: [i128; 2], line: Direction, steps: i128) -> [i128; 2] {
    let [di, dj] = Sign::Plus.descent(line);
    [i + steps * di, j + steps * dj]
}

/// Returns the layers of the highest pile on a base, the top layer first.
pub(crate) fn grown(base: Layer) -> Vec<Layer> {
    let next = |below: &Layer| {
        let present = |site, line| below.contains(&down(site, line, 1));
        let has_supports =
            |site: &[i128; 2]| Direction::ALL.iter().all(|line| present(*site, *line));
        let layer: Layer = below.iter().copied().filter(has_supports).collect();
        (!layer.is_empty()).then_some(layer)
    };
    let mut layers: Vec<_> = iter::successors(Some(base), next).collect();
    layers.reverse();
    layers
}

/// Returns the forces from above on a sphere of layer k, in f₀ = mg/(3 cosθ).
pub(crate) fn received(layers: &[Layer], k: usize, site: [i128; 2]) -> [BigRational; 3] {
    let lines = Direction::ALL.map(|line| {
        let above = (1_i128..).zip(layers[..k].iter().rev());
        let spheres = above.take_while(|(n, layer)| layer.contains(&down(site, line, -*n)));
        (spheres.count(), line.index())
    });
    let own = increments(&ratio!(1 / 2));
    lines.map(|(n, line)| force(BigRational::from_integer(n.into()), &own[line]))
}

pub(crate) fn main() {
    let (e, own) = (directions(&ratio!(1 / 2)), increments(&ratio!(1 / 2)));
    let mg = weight(&own);
    // The disc of radius 14 a: the squared distance of a site from the middle is 4a²(i² + ij + j²).
    let sites = (-8..=8).flat_map(|i| (-8..=8).map(move |j| [i, j]));
    let layers = grown(sites.filter(|[i, j]| i * i + i * j + j * j <= 49).collect());
    let floor = layers.len() - 1;
    for (k, layer) in layers[..floor].iter().enumerate() {
        for &site in layer {
            let [a, b, c] = received(&layers, k, site);
            let above = [a.clone(), b.clone(), c.clone()];
            let [x, y, z] = &own;
            let below = [transmitted(a, x), transmitted(b, y), transmitted(c, z)];
            assert_eq!(unbalanced(&below, &e, &above, &e, &mg), Vector::zero());
        }
    }
    let normal = |site| support_load(&received(&layers, floor, site), &e, &mg).z / &mg;
    let total: BigRational = layers[floor].iter().map(|site| normal(*site)).sum();
    let spheres = layers.iter().map(BTreeSet::len).sum::<usize>();
    println!(
        "{spheres} spheres in {} layers press on the floor with {total} mg.",
        floor + 1
    );
    assert_eq!(total, BigRational::from_integer(spheres.into()));

    println!("The pressure is not uniform. Along a diameter the normal forces in mg are");
    for i in -7..=7 {
        print!(" {}", normal([i, 0]));
    }
    println!();
    assert!(normal([0, 0]) > normal([7, 0]));
}
