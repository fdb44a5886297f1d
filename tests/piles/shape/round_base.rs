//! The example `round_base`, compared with a linear solver of its own for bases that are not six-sided.

use std::collections::BTreeMap;

use num_rational::BigRational;
use num_traits::{One, Zero};

#[path = "../../../examples/round_base.rs"]
mod example;

use example::{Layer, grown, received};

type Equation = BTreeMap<usize, BigRational>;

/// The number of each sphere with supports, by its layer and site.
type Numbers = BTreeMap<(usize, [i128; 2]), usize>;

/// The column of the right side. The contacts have the columns 0, 1, ….
const RIGHT: usize = usize::MAX;

/// The steps (i, j) to the three supports, and three times the horizontal parts of the contacts in the basis of the
/// lattice.
const SUPPORTS: [([i128; 2], [i128; 2]); 3] =
    [([0, 0], [-1, -1]), ([1, 0], [2, -1]), ([0, 1], [-1, 2])];

/// Returns the equations of equilibrium of all spheres with supports. The contact below sphere n along line l has the
/// column 3n + l.
fn equations(layers: &[Layer]) -> (Vec<Equation>, Numbers) {
    let floor = layers.len() - 1;
    let spheres = (0..floor).flat_map(|k| layers[k].iter().map(move |site| (k, *site)));
    let numbers: Numbers = spheres.zip(0..).collect();
    let mut all = Vec::new();
    for (&(k, [i, j]), &number) in &numbers {
        // Two horizontal components, and the vertical one, in which a sphere weighs 3 f₀ cosθ.
        let mut of_sphere =
            [0, 0, 3].map(|weight: i128| Equation::from([(RIGHT, integer(weight))]));
        for (line, ([di, dj], [x, y])) in SUPPORTS.into_iter().enumerate() {
            let above = k
                .checked_sub(1)
                .and_then(|above| numbers.get(&(above, [i - di, j - dj])));
            let contacts = [Some((number, 1)), above.map(|above| (*above, -1))];
            for (upper, sign) in contacts.into_iter().flatten() {
                for (equation, part) in of_sphere.iter_mut().zip([x, y, 1]) {
                    equation.insert(3 * upper + line, integer(sign * part));
                }
            }
        }
        all.extend(of_sphere);
    }
    (all, numbers)
}

/// Returns the values of all columns, by Gauss and Jordan. Panics unless there is exactly one solution.
fn solve(equations: Vec<Equation>) -> Vec<BigRational> {
    let columns = equations.len();
    let mut solved: Vec<Equation> = Vec::new();
    let mut left = equations;
    for column in 0..columns {
        let row = left.iter().position(|row| row.contains_key(&column));
        let mut pivot = left.swap_remove(row.expect("a regular matrix"));
        let scale = pivot[&column].clone();
        for entry in pivot.values_mut() {
            *entry /= &scale;
        }
        for row in solved.iter_mut().chain(&mut left) {
            let Some(factor) = row.remove(&column) else {
                continue;
            };
            for (&other, entry) in pivot.iter().filter(|(other, _)| **other != column) {
                let sum = row.entry(other).or_insert_with(BigRational::zero);
                *sum -= &factor * entry;
                if sum.is_zero() {
                    row.remove(&other);
                }
            }
        }
        solved.push(pivot);
    }
    let right = |row: &Equation| row.get(&RIGHT).cloned().unwrap_or_else(BigRational::zero);
    solved.iter().map(right).collect()
}

fn integer(n: i128) -> BigRational {
    BigRational::from_integer(n.into())
}

/// Returns whether the layer holds every site within its bounds of i, j and i + j.
fn is_six_sided(base: &Layer) -> bool {
    let bounds = |of: fn(&[i128; 2]) -> i128| {
        let values: Vec<_> = base.iter().map(of).collect();
        values
            .iter()
            .copied()
            .min()
            .zip(values.iter().copied().max())
    };
    let sides: [fn(&[i128; 2]) -> i128; 3] = [|s| s[0], |s| s[1], |s| s[0] + s[1]];
    let inside = |site: &[i128; 2]| {
        let within = |of: fn(&[i128; 2]) -> i128| {
            bounds(of).is_some_and(|(least, greatest)| (least..=greatest).contains(&of(site)))
        };
        sides.into_iter().all(within)
    };
    square(20).filter(inside).count() == base.len()
}

fn square(n: i128) -> impl Iterator<Item = [i128; 2]> {
    (-n..=n).flat_map(move |i| (-n..=n).map(move |j| [i, j]))
}

/// Twenty bases: discs about three middles, discs with a hole, and sets without any order.
fn bases() -> Vec<Layer> {
    let within = |radius2: std::ops::RangeInclusive<i128>, [x, y]: [i128; 2]| -> Layer {
        // Coordinates and distances in sixths of the distance of neighbours.
        let near = |[i, j]: &[i128; 2]| {
            let [i, j] = [6 * i - x, 6 * j - y];
            radius2.contains(&(i * i + i * j + j * j))
        };
        square(8).filter(near).collect()
    };
    let middles = [[0, 0], [3, 0], [2, 2], [1, 2]];
    let discs = middles
        .into_iter()
        .flat_map(|middle| (5..15).map(move |r| within(0..=36 * r, middle)));
    let mut bases: Vec<_> = discs
        .filter(|disc| !is_six_sided(disc))
        .step_by(2)
        .take(12)
        .collect();
    bases.push(within(36..=36 * 12, [0, 0]));
    bases.push(within(36 * 3..=36 * 13, [0, 0]));
    for seed in 1..=6_i128 {
        // One site in eight or so is missing.
        let is_present =
            |[i, j]: &[i128; 2]| (i * i * 7 + j * 13 + i * j * seed + seed * 5).rem_euclid(8) != 0;
        bases.push(square(3).filter(is_present).collect());
    }
    bases
}

#[test]
fn forces_are_those_of_the_linear_system() {
    let bases = bases();
    assert_eq!(bases.len(), 20);
    for base in bases {
        assert!(!is_six_sided(&base), "{base:?}");
        let layers = grown(base);
        assert!(layers.len() > 2);
        let (equations, numbers) = equations(&layers);
        let forces = solve(equations);
        for (&(k, site), &number) in &numbers {
            for (line, from_above) in received(&layers, k, site).into_iter().enumerate() {
                let transmitted = from_above + BigRational::one();
                assert_eq!(
                    transmitted,
                    forces[3 * number + line],
                    "{k} {site:?} {line}"
                );
            }
        }
    }
}

/// A base without its middle has other forces, so the comparison can fail.
#[test]
fn a_missing_site_changes_the_forces() {
    let whole: Layer = square(2).collect();
    let mut holed = whole.clone();
    holed.remove(&[0, 0]);
    let forces = |base| {
        let layers = grown(base);
        received(&layers, layers.len() - 1, [1, 0])
    };
    assert_ne!(forces(whole), forces(holed));
}

#[test]
fn the_example_runs() {
    example::main();
}
