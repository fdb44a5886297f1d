//! The closed forms of singular values, compared with a dense decomposition of matrices that are made from the places of
//! the spheres.

use std::collections::HashMap;

use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Dimension, Direction, Region, Site};
use cannonpile::num_bigint::BigUint;
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Packing, Pile, ratio};
use cannonpile_accuracy::{condition_bound, condition_number, singular_values};

type Matrix = Vec<Vec<f64>>;

/// Returns the singular values of a matrix, in ascending order, by the one-sided rotations of Hestenes and Jacobi. The
/// matrix is given by its columns.
fn dense_singular_values(mut columns: Matrix) -> Vec<f64> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    loop {
        let mut largest = 0.0_f64;
        for p in 0..columns.len() {
            for q in p + 1..columns.len() {
                let (left, right) = columns.split_at_mut(q);
                let (a, b) = (&mut left[p], &mut right[0]);
                let (aa, bb, ab) = (dot(a, a), dot(b, b), dot(a, b));
                let cosine = ab.abs() / (aa * bb).sqrt();
                largest = largest.max(cosine);
                if cosine < 1e-15 {
                    continue;
                }
                let zeta = (bb - aa) / (2.0 * ab);
                let t = zeta.signum() / (zeta.abs() + zeta.hypot(1.0));
                let c = t.hypot(1.0).recip();
                for (x, y) in a.iter_mut().zip(b.iter_mut()) {
                    (*x, *y) = (c * (*x - t * *y), c * (t * *x + *y));
                }
            }
        }
        if largest < 1e-13 {
            break;
        }
    }
    let mut values: Vec<_> = columns
        .iter()
        .map(|column| dot(column, column).sqrt())
        .collect();
    values.sort_by(f64::total_cmp);
    values
}

/// Returns the columns of the equilibrium matrix in newtons, and of the same matrix with each sphere's balance resolved
/// along its own three directions, which is I − S.
fn matrices(pile: &Pile, spacing: &Spacing) -> [Matrix; 2] {
    let packing = Packing::new(pile, spacing).unwrap();
    let (shape, discs) = (pile.shape(), pile.dimension() == Dimension::Two);
    let directions = if discs {
        &Direction::ALL[..2]
    } else {
        &Direction::ALL
    };
    let places: HashMap<_, _> = pile
        .sites(Selection::All)
        .unwrap()
        .map(|site| (site, packing.position(site).unwrap().map(|x| x.to_f64())))
        .collect();
    let sites: Vec<_> = pile
        .sites(Selection::All)
        .unwrap()
        .filter(|site| site.k < pile.layers() - 1)
        .collect();
    // The unit vector from a sphere to its support, in two dimensions without y.
    let unit = |from: Site, direction: &Direction| {
        let (a, b) = (
            places[&from],
            places[&shape.below(from, *direction).unwrap()],
        );
        let difference = [0, 1, 2].map(|axis| b[axis] - a[axis]);
        let length = difference.iter().map(|x| x * x).sum::<f64>().sqrt();
        let axes: &[usize] = if discs { &[0, 2] } else { &[0, 1, 2] };
        axes.iter()
            .map(|axis| difference[*axis] / length)
            .collect::<Vec<_>>()
    };
    let d = directions.len();
    let row_of: HashMap<_, _> = sites
        .iter()
        .enumerate()
        .map(|(n, site)| (*site, n * d))
        .collect();
    let mut newtons = Vec::new();
    let mut by_lines = Vec::new();
    for site in &sites {
        for direction in directions {
            let force = unit(*site, direction);
            let [mut column, mut resolved] = [(); 2].map(|()| vec![0.0; sites.len() * d]);
            let ends = [(Some(*site), 1.0), (shape.below(*site, *direction), -1.0)];
            for (end, sign) in ends {
                // The floor supports what reaches the bottom layer.
                let Some(row) = end.and_then(|end| row_of.get(&end)) else {
                    continue;
                };
                let own: Vec<_> = directions
                    .iter()
                    .map(|other| unit(end.unwrap(), other))
                    .collect();
                let along = solve(&own, &force);
                for axis in 0..d {
                    column[row + axis] = sign * force[axis];
                    resolved[row + axis] = sign * along[axis];
                }
            }
            newtons.push(column);
            by_lines.push(resolved);
        }
    }
    [newtons, by_lines]
}

/// Returns the coefficients of a vector in a basis, by Cramer's rule.
fn solve(basis: &[Vec<f64>], vector: &[f64]) -> Vec<f64> {
    let determinant = |m: &[Vec<f64>]| match m {
        [a, b] => a[0] * b[1] - a[1] * b[0],
        [a, b, c] => (0..3)
            .map(|i| a[i] * (b[(i + 1) % 3] * c[(i + 2) % 3] - b[(i + 2) % 3] * c[(i + 1) % 3]))
            .sum(),
        _ => unreachable!("two or three dimensions"),
    };
    let whole = determinant(basis);
    (0..basis.len())
        .map(|n| {
            let mut basis = basis.to_vec();
            basis[n] = vector.to_vec();
            determinant(&basis) / whole
        })
        .collect()
}

/// Piles of every kind, with spacings at which they fit. The last of them is √2, at which the directions of the equilateral
/// base, and of discs, are orthogonal.
fn piles() -> Vec<(Pile, Vec<Spacing>)> {
    let spacings = |text: &[&str]| text.iter().map(|text| text.parse().unwrap()).collect();
    let usual = || spacings(&["1", "3/2", "sqrt(2)"]);
    let under = |top: Region, stacking: &str| Pile::under(top, stacking.parse().unwrap()).unwrap();
    let mut piles = vec![
        (Pile::triangular(2).unwrap(), usual()),
        (
            Pile::triangular(5).unwrap(),
            spacings(&["1", "8/5", "sqrt(2)"]),
        ),
        (Pile::discs(7).unwrap(), spacings(&["1", "8/5", "sqrt(2)"])),
        (under(Region::SITE, "+-+-+"), usual()),
        (under(Region::SITE, "--+-"), usual()),
        (under(Region::hexagon(2, 2).unwrap(), "+-"), usual()),
        (under(Region::hexagon(3, 1).unwrap(), "-+-"), usual()),
        (
            under(Region::new(0..=3, 0..=1, 1..=4).unwrap(), "+-"),
            usual(),
        ),
        (
            under(Region::new(2..=2, 0..=4, 2..=6).unwrap(), "-+"),
            usual(),
        ),
        (
            Pile::on(Region::hexagon(3, 3).unwrap(), Stacking::fcc(3).unwrap()).unwrap(),
            usual(),
        ),
        (
            Pile::on(Region::triangle(5).unwrap(), "+++".parse().unwrap()).unwrap(),
            usual(),
        ),
        (
            Pile::on(
                Region::new(0..=5, 0..=4, 2..=7).unwrap(),
                "+-+".parse().unwrap(),
            )
            .unwrap(),
            usual(),
        ),
    ];
    for s in [ratio!(2 / 5), ratio!(3 / 5), ratio!(1 / 4)] {
        piles.push((Pile::isosceles(5, s).unwrap(), spacings(&["6/5", "7/5"])));
    }
    piles
}

fn closed_values(pile: &Pile) -> Vec<f64> {
    let repeated = singular_values(pile.shape()).flat_map(|value| {
        let times = usize::try_from(value.multiplicity()).unwrap();
        std::iter::repeat_n(value.value(), times)
    });
    let mut values: Vec<_> = repeated.collect();
    values.sort_by(f64::total_cmp);
    values
}

fn assert_close(closed: &[f64], dense: &[f64], context: &str) {
    assert_eq!(closed.len(), dense.len(), "{context}");
    for (closed, dense) in closed.iter().zip(dense) {
        assert!(
            (closed - dense).abs() < 1e-12,
            "{context}: {closed}, {dense}"
        );
    }
}

#[test]
fn closed_forms_are_the_dense_decomposition() {
    for (pile, spacings) in piles() {
        let closed = closed_values(&pile);
        let condition = condition_number(pile.shape()).unwrap();
        for spacing in &spacings {
            let context = format!("{pile}, {spacing}");
            let [newtons, by_lines] = matrices(&pile, spacing);
            // I − S does not depend on the spacing.
            if *spacing == spacings[0] {
                let dense = dense_singular_values(by_lines);
                assert_close(&closed, &dense, &context);
                let ratio = dense[dense.len() - 1] / dense[0];
                assert!((condition / ratio - 1.0).abs() < 1e-12, "{context}");
            }
            let dense = dense_singular_values(newtons);
            let ratio = dense[dense.len() - 1] / dense[0];
            let bound = condition_bound(&Packing::new(&pile, spacing).unwrap()).unwrap();
            assert!(
                ratio <= bound * (1.0 + 1e-12),
                "{context}: {ratio}, {bound}"
            );
            // With orthogonal directions both matrices have the same singular values.
            if *spacing.square() == ratio!(2) && *pile.sin_phi() == ratio!(1 / 2) {
                assert_close(&closed, &dense, &context);
                assert!((bound / condition - 1.0).abs() < 1e-13, "{context}");
            }
            assert!(bound < 4.0 * ratio, "{context}: {ratio}, {bound}");
        }
    }
}

#[test]
fn a_wrong_closed_form_is_found() {
    let pile = Pile::under(Region::SITE, "+-+".parse().unwrap()).unwrap();
    let [_, mut by_lines] = matrices(&pile, &"1".parse().unwrap());
    by_lines[0][0] += 1e-6;
    let dense = dense_singular_values(by_lines);
    let difference = closed_values(&pile)
        .iter()
        .zip(&dense)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max);
    assert!(difference > 1e-8, "{difference}");
}

#[test]
fn multiplicities_count_the_unknowns_and_the_determinant_is_one() {
    for (pile, _) in piles() {
        let count: BigUint = singular_values(pile.shape())
            .map(|value| value.multiplicity().clone())
            .sum();
        assert_eq!(count, pile.contact_count());
        let logarithm: f64 = closed_values(&pile).iter().map(|value| value.ln()).sum();
        assert!(logarithm.abs() < 1e-12, "{pile}: {logarithm}");
    }
}

#[test]
fn one_layer_has_no_singular_value() {
    let pile = Pile::triangular(1).unwrap();
    assert_eq!(singular_values(pile.shape()).count(), 0);
    assert_eq!(condition_number(pile.shape()), None);
    assert_eq!(
        condition_bound(&Packing::new(&pile, &"1".parse().unwrap()).unwrap()),
        None
    );
}

#[test]
#[expect(clippy::float_cmp, reason = "the values are correctly rounded")]
fn values_of_many_layers_keep_their_digits() {
    let pile = Pile::triangular(10_i128.pow(36)).unwrap();
    let mut values = singular_values(pile.shape());
    assert_eq!(values.next().unwrap().value(), 2.0);
    let condition = condition_number(pile.shape()).unwrap();
    assert_eq!(condition, 1.273_239_544_735_162_6e36);

    // The smallest value of four chains, by mpmath at 50 digits.
    for (layers, smallest) in [
        (2, 1.0),
        (11, 0.149_460_187_172_848_5),
        (1_001, 0.001_570_011_159_885_304_5),
    ] {
        let pile = Pile::triangular(layers).unwrap();
        let last = singular_values(pile.shape())
            .take_while(|value| value.chain_length() == layers - 1)
            .last()
            .unwrap();
        assert_eq!(last.value(), smallest, "{layers}");
    }
}
