//! Two layers on a rough floor: forces without loads are zero, under every connected upper layer of up to eight spheres.
//!
//! The equations of equilibrium have integer coefficients at sinθ = 3/5 and cosθ = 4/5. If their columns are independent
//! modulo a prime, they are independent over the rationals. Upper spheres that share no lower sphere, directly or through
//! others, have separate equations, so connected layers suffice.

use std::collections::{BTreeMap, BTreeSet};

use cannonpile::lattice::{Direction, Sign};

const PRIME: u64 = (1 << 31) - 1;

type Place = [i128; 2];
type Layer = BTreeSet<Place>;
type Vector = [i64; 3];

/// The vectors from a support to the spheres above it, in units of R/10 along x and z and of 2cosφ·R/10 along y.
const ALONG: [Vector; 3] = [[3, 3, -8], [3, -3, -8], [-6, 0, -8]];
/// The vector from the centre of a lower sphere to its point on the floor.
const DOWN: Vector = [0, 0, 10];

/// Adds the equations of one sphere: the sums of forces and of moments about its centre. Each force has its point, its
/// first unknown and its sign.
fn add_balance(rows: &mut Vec<Vec<u64>>, unknowns: usize, forces: &[(Vector, usize, i64)]) {
    let mut sums = vec![vec![0; unknowns]; 6];
    for ([x, y, z], first, sign) in forces {
        let factors: [[i64; 3]; 6] = [
            [1, 0, 0],
            [0, 1, 0],
            [0, 0, 1],
            [0, -z, *y],
            [*z, 0, -x],
            [-y, *x, 0],
        ];
        for (row, factors) in sums.iter_mut().zip(factors) {
            for (axis, factor) in factors.into_iter().enumerate() {
                let residue = (sign * factor).rem_euclid(i64::try_from(PRIME).unwrap());
                row[first + axis] = u64::try_from(residue).unwrap();
            }
        }
    }
    rows.append(&mut sums);
}

/// Returns the inverse modulo the prime.
fn inverse(x: u64) -> u64 {
    let (mut result, mut power, mut rest) = (1, x, PRIME - 2);
    while rest > 0 {
        if rest % 2 == 1 {
            result = result * power % PRIME;
        }
        power = power * power % PRIME;
        rest /= 2;
    }
    result
}

/// Returns the rank modulo the prime.
fn rank(mut rows: Vec<Vec<u64>>) -> usize {
    let unknowns = rows.first().map_or(0, Vec::len);
    let mut rank = 0;
    for column in 0..unknowns {
        let Some(place) = rows.iter().position(|row| row[column] != 0) else {
            continue;
        };
        let pivot = rows.swap_remove(place);
        rank += 1;
        let scale = inverse(pivot[column]);
        for row in rows.iter_mut().filter(|row| row[column] != 0) {
            let times = PRIME - row[column] * scale % PRIME;
            for (n, factor) in pivot
                .iter()
                .enumerate()
                .skip(column)
                .filter(|(_, f)| **f != 0)
            {
                row[n] = (row[n] + times * factor) % PRIME;
            }
        }
    }
    rank
}

fn below([i, j]: Place, direction: Direction) -> Place {
    let [di, dj] = Sign::Plus.descent(direction);
    [i + di, j + dj]
}

/// Returns the number of unknown components of forces, and the rank of all equations. `floor` is the vector to the
/// points on the floor.
fn equations(top: &Layer, floor: Vector) -> [usize; 2] {
    let contacts: Vec<(Place, Direction)> = top
        .iter()
        .flat_map(|site| Direction::ALL.map(|direction| (*site, direction)))
        .collect();
    let mut lower: BTreeMap<Place, Vec<(Vector, usize, i64)>> = BTreeMap::new();
    for (n, (site, direction)) in contacts.iter().enumerate() {
        let at = lower.entry(below(*site, *direction)).or_default();
        at.push((ALONG[direction.index()], 3 * n, -1));
    }
    let unknowns = 3 * (contacts.len() + lower.len());
    let mut rows = Vec::new();
    for first in (0..contacts.len()).step_by(3) {
        let forces = [0, 1, 2].map(|n| (ALONG[n].map(|part| -part), 3 * (first + n), 1));
        add_balance(&mut rows, unknowns, &forces);
    }
    for (n, forces) in lower.values_mut().enumerate() {
        forces.push((floor, 3 * (contacts.len() + n), 1));
        add_balance(&mut rows, unknowns, forces);
    }
    [unknowns, rank(rows)]
}

/// Returns the layer, moved so that its smallest i and j are 0.
fn moved(layer: &Layer) -> Layer {
    let least = [0, 1].map(|axis| layer.iter().map(|site| site[axis]).min().unwrap());
    layer
        .iter()
        .map(|[i, j]| [i - least[0], j - least[1]])
        .collect()
}

/// Returns whether no image of the layer under the six symmetries of a pile with + steps is smaller. They permute
/// −i−j, i and j.
fn is_first_of_its_images(layer: &Layer) -> bool {
    let image = |[a, b]: [usize; 2]| {
        let part = |[i, j]: &Place, n: usize| [-i - j, *i, *j][n];
        moved(
            &layer
                .iter()
                .map(|site| [part(site, a), part(site, b)])
                .collect(),
        )
    };
    let all = [[1, 2], [2, 1], [0, 1], [1, 0], [0, 2], [2, 0]].map(image);
    all.iter().all(|other| layer <= other)
}

/// Returns the connected layers with one sphere more.
fn grown(layers: &BTreeSet<Layer>) -> BTreeSet<Layer> {
    let neighbours = |[i, j]: &Place| {
        [[1, 0], [0, 1], [-1, 1], [-1, 0], [0, -1], [1, -1]].map(|[di, dj]| [i + di, j + dj])
    };
    let mut all = BTreeSet::new();
    for layer in layers {
        for site in layer.iter().flat_map(neighbours) {
            if !layer.contains(&site) {
                let mut more = layer.clone();
                more.insert(site);
                all.insert(moved(&more));
            }
        }
    }
    all
}

#[test]
fn no_forces_without_loads_under_any_connected_top() {
    let mut layers = BTreeSet::from([Layer::from([[0, 0]])]);
    // The number of connected layers up to translations (OEIS A001207).
    for count in [1, 3, 11, 44, 186, 814, 3652, 16689] {
        assert_eq!(layers.len(), count);
        for top in layers.iter().filter(|layer| is_first_of_its_images(layer)) {
            let [unknowns, rank] = equations(top, DOWN);
            assert_eq!(rank, unknowns, "{top:?}");
        }
        if count < 16689 {
            layers = grown(&layers);
        }
    }
}

/// If the floor acted at the height of the contacts, three spheres above one would have forces without loads. So the test
/// can fail.
#[test]
fn a_wrong_point_on_the_floor_is_noticed() {
    let three = Layer::from([[0, 0], [1, 0], [0, 1]]);
    let [unknowns, rank] = equations(&three, [0, 0, -8]);
    assert!(rank < unknowns, "{rank}");
}
