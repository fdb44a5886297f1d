//! Compares the compliance with three sources: piles on springs, relaxed by Newton's method from their geometry alone;
//! the closed forms of straight piles; and measurements in LAMMPS.

use std::collections::BTreeSet;

use cannonpile::lattice::{Region, Site};
use cannonpile::stacking::Stacking;
use cannonpile::{Packing, Pile};
use cannonpile_dem::verify::{self, Comparison};
use cannonpile_dem::{Compliance, NoCompliance, NumberedPile, SoftContact};
use num_rational::BigRational;

type Point = [f64; 3];

fn ratio(n: i64, d: i64) -> BigRational {
    BigRational::new(n.into(), d.into())
}

fn packing<'p>(pile: &'p Pile, spacing: &str) -> Packing<'p> {
    Packing::new(pile, &spacing.parse().unwrap()).unwrap()
}

fn soft(packing: &Packing<'_>) -> (Compliance, Vec<SoftContact>) {
    let mut contacts = Vec::new();
    let compliance = Compliance::inspected(packing, |contact| contacts.push(*contact)).unwrap();
    (compliance, contacts)
}

/// Spheres with R = 1, their weights, and the number of free spheres; the others are fixed.
struct Springs {
    centres: Vec<Point>,
    weights: Vec<f64>,
    contacts: Vec<[usize; 2]>,
    free: usize,
}

/// Returns the sites of the layers from the top, for the signs of the steps.
fn layers(top: &[[i32; 2]], signs: &str, discs: bool) -> Vec<BTreeSet<[i32; 2]>> {
    // Sorted by j, then by i, as spheres are numbered.
    let mut layers = vec![top.iter().map(|[i, j]| [*j, *i]).collect::<BTreeSet<_>>()];
    for sign in signs.chars() {
        let step = if sign == '+' { 1 } else { -1 };
        let above = layers.last().unwrap().iter();
        let below = above.flat_map(|[j, i]| {
            let beta = [*j, i + step];
            let gamma = if discs { beta } else { [j + step, *i] };
            [[*j, *i], beta, gamma]
        });
        let below = below.collect();
        layers.push(below);
    }
    layers
}

impl Springs {
    /// Returns a pile whose neighbours in a layer are at the distance 2a.
    fn new(top: &[[i32; 2]], signs: &str, a: f64, discs: bool) -> Self {
        let layers = layers(top, signs, discs);
        let drop = if discs {
            4.0 - a * a
        } else {
            4.0 - 4.0 * a * a / 3.0
        };
        let hollow = if discs {
            [a, 0.0]
        } else {
            [a, a / 3.0_f64.sqrt()]
        };
        let (mut origin, mut z) = ([0.0; 2], 0.0);
        let mut centres = Vec::new();
        for (layer, sign) in layers.iter().zip(signs.chars().chain(['+'])) {
            for [j, i] in layer.iter().map(|site| site.map(f64::from)) {
                let x = origin[0] + 2.0 * a * (i + j / 2.0);
                centres.push([x, origin[1] + a * 3.0_f64.sqrt() * j, z]);
            }
            // A sphere lies above the centroid of its supports.
            let side = if sign == '+' { -1.0 } else { 1.0 };
            origin = [0, 1].map(|axis| origin[axis] + side * hollow[axis]);
            z -= drop.sqrt();
        }
        let free = centres.len() - layers.last().unwrap().len();
        Self::of(centres, free)
    }

    fn of(centres: Vec<Point>, free: usize) -> Self {
        let mut contacts = Vec::new();
        for upper in 0..free {
            for lower in upper + 1..centres.len() {
                let [from, to] = [centres[upper], centres[lower]];
                if (length(between(&from, &to)) - 2.0).abs() < 1e-9 {
                    contacts.push([upper, lower]);
                }
            }
        }
        let weights = vec![1.0; centres.len()];
        Self {
            centres,
            weights,
            contacts,
            free,
        }
    }

    /// Returns the force of each contact on its upper sphere, in equilibrium at this stiffness.
    fn relaxed(&self, stiffness: f64) -> Vec<Point> {
        let mut centres = self.centres.clone();
        let mut forces = Vec::new();
        for _ in 0..12 {
            let unknowns = 3 * self.free;
            let mut matrix = vec![vec![0.0; unknowns + 1]; unknowns];
            for (sphere, weight) in self.weights.iter().enumerate().take(self.free) {
                matrix[3 * sphere + 2][unknowns] = -weight;
                // Discs have no force normal to their plane.
                matrix[3 * sphere + 1][3 * sphere + 1] = 1e-9;
            }
            forces.clear();
            for [upper, lower] in &self.contacts {
                let apart = between(&centres[*lower], &centres[*upper]);
                let distance = length(apart);
                let ray = apart.map(|x| x / distance);
                let push = stiffness * (2.0 - distance);
                forces.push(ray.map(|x| x * push));
                for row in 0..3 {
                    let force = push * ray[row];
                    matrix[3 * upper + row][unknowns] += force;
                    if *lower < self.free {
                        matrix[3 * lower + row][unknowns] -= force;
                    }
                    for column in 0..3 {
                        let same = f64::from(u8::from(row == column));
                        let across = same - ray[row] * ray[column];
                        // The negative derivative of the force with respect to the position of the upper sphere.
                        let stiff = stiffness * ray[row] * ray[column] - push / distance * across;
                        matrix[3 * upper + row][3 * upper + column] += stiff;
                        if *lower < self.free {
                            matrix[3 * lower + row][3 * lower + column] += stiff;
                            matrix[3 * upper + row][3 * lower + column] -= stiff;
                            matrix[3 * lower + row][3 * upper + column] -= stiff;
                        }
                    }
                }
            }
            for (n, step) in solved(matrix).into_iter().enumerate() {
                centres[n / 3][n % 3] += step;
            }
        }
        forces
    }
}

fn between(from: &Point, to: &Point) -> Point {
    [0, 1, 2].map(|axis| to[axis] - from[axis])
}

fn length(of: Point) -> f64 {
    of.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Solves a linear system by Gaussian elimination. The last column is the right-hand side.
fn solved(mut matrix: Vec<Vec<f64>>) -> Vec<f64> {
    let size = matrix.len();
    for n in 0..size {
        let pivot = (n..size).max_by(|a, b| matrix[*a][n].abs().total_cmp(&matrix[*b][n].abs()));
        matrix.swap(n, pivot.unwrap());
        let (done, rest) = matrix.split_at_mut(n + 1);
        let pivot = &done[n];
        for row in rest {
            let factor = row[n] / pivot[n];
            if factor != 0.0 {
                for (x, from) in row.iter_mut().zip(pivot).skip(n) {
                    *x -= factor * from;
                }
            }
        }
    }
    let mut answer = vec![0.0; size];
    for n in (0..size).rev() {
        let known: f64 = (n + 1..size).map(|m| matrix[n][m] * answer[m]).sum();
        answer[n] = (matrix[n][size] - known) / matrix[n][n];
    }
    answer
}

/// Relaxes the springs at two stiffnesses, and compares the errors, extrapolated to infinite stiffness, with the
/// compliance.
fn check(packing: &Packing<'_>, springs: &Springs) {
    let (compliance, contacts) = soft(packing);
    assert_eq!(contacts.len(), springs.contacts.len());
    let numbered = NumberedPile::new(packing).unwrap();
    let exact: Vec<_> = numbered.contacts().unwrap().map(Result::unwrap).collect();
    let stiffness = 2e4;
    let relaxed = [1.0, 2.0].map(|times| springs.relaxed(times * stiffness));
    let (mut largest, mut of_vectors) = (0.0_f64, 0.0_f64);
    for contact in &contacts {
        let ids = contact.ids.map(|id| usize::try_from(id).unwrap() - 1);
        let n = springs
            .contacts
            .iter()
            .position(|pair| *pair == ids)
            .unwrap();
        let exact = exact.iter().find(|exact| exact.ids == contact.ids).unwrap();
        // The direction of the rigid contact is computed from these centres, not taken from the library.
        let [upper, lower] = ids.map(|id| springs.centres[id]);
        let ray = between(&lower, &upper).map(|x| x / 2.0);
        let changes = [0, 1].map(|of| {
            let times = stiffness * [1.0, 2.0][of] / exact.force;
            let force = relaxed[of][n];
            let vector = [0, 1, 2].map(|axis| (force[axis] - exact.force * ray[axis]) * times);
            ((length(force) - exact.force) * times, vector)
        });
        // The extrapolation removes the term linear in 1/κ.
        let [(one, at_one), (two, at_two)] = changes;
        let change = 2.0 * two - one;
        let vector = length([0, 1, 2].map(|axis| 2.0 * at_two[axis] - at_one[axis]));
        assert!(
            (contact.coefficient - change).abs() < 2e-5 * compliance.coefficient(),
            "{contact:?}: {change}"
        );
        assert!(
            (contact.vector_coefficient - vector).abs() < 2e-5 * compliance.coefficient(),
            "{contact:?}: {vector}"
        );
        largest = largest.max(change.abs());
        of_vectors = of_vectors.max(vector);
    }
    assert!((compliance.coefficient() / largest - 1.0).abs() < 2e-5);
    assert!((compliance.vector_coefficient() / of_vectors - 1.0).abs() < 2e-5);
}

#[test]
fn relaxed_straight_piles() {
    for (layers, spacing, a) in [
        (2, "6/5", 1.2),
        (5, "6/5", 1.2),
        (4, "3/2", 1.5),
        (4, "1.01", 1.01),
    ] {
        let pile = Pile::triangular(layers).unwrap();
        let signs = "+".repeat(usize::try_from(layers).unwrap() - 1);
        check(
            &packing(&pile, spacing),
            &Springs::new(&[[0, 0]], &signs, a, false),
        );
    }
}

#[test]
fn relaxed_stackings_with_faults() {
    for (side, signs) in [(2, "+-+"), (3, "+-"), (2, "++-"), (2, "-+")] {
        let top = Region::hexagon(side, side).unwrap();
        let sites: Vec<[i32; 2]> = top
            .rows(0)
            .flatten()
            .map(|Site { i, j, .. }| [i, j].map(|x| i32::try_from(x).unwrap()))
            .collect();
        let pile = Pile::under(top, signs.parse().unwrap()).unwrap();
        check(
            &packing(&pile, "6/5"),
            &Springs::new(&sites, signs, 1.2, false),
        );
    }
}

#[test]
fn a_relaxed_pile_under_loads() {
    let (apex, side) = (Site::APEX, Site { i: 1, j: 0, k: 2 });
    let pile = Pile::triangular(4).unwrap();
    let pile = pile
        .with_load(apex, ratio(1, 2))
        .unwrap()
        .with_load(side, ratio(5, 2))
        .unwrap();
    let mut springs = Springs::new(&[[0, 0]], "+++", 1.3, false);
    springs.weights[0] += 0.5;
    // Index 5 is the second sphere of the third layer, after one sphere, three spheres, and the first of that layer.
    springs.weights[5] += 2.5;
    check(&packing(&pile, "13/10"), &springs);
}

#[test]
fn relaxed_discs() {
    for (layers, spacing, a) in [(2, "6/5", 1.2), (6, "6/5", 1.2), (5, "3/2", 1.5)] {
        let pile = Pile::discs(layers).unwrap();
        let signs = "+".repeat(usize::try_from(layers).unwrap() - 1);
        check(
            &packing(&pile, spacing),
            &Springs::new(&[[0, 0]], &signs, a, true),
        );
    }
}

/// The positions are those of the library, which other tests check.
#[test]
fn a_relaxed_isosceles_pile() {
    let pile = Pile::isosceles(4, ratio(2, 5)).unwrap();
    let packing = packing(&pile, "6/5");
    let sites: Vec<Site> = pile.shape().sites().collect();
    let centre = |site: &Site| {
        packing
            .position(*site)
            .unwrap()
            .map(|x| x.nearest().unwrap())
    };
    check(
        &packing,
        &Springs::of(sites.iter().map(centre).collect(), 10),
    );
}

/// Returns ε of the module's documentation, in f₀/(κR).
fn closed_form(discs: bool, q: f64, layers: f64, n: f64, k: f64) -> f64 {
    let common = q * (2.0 * layers + q - 4.0);
    if discs {
        ((4.0 - q) * (6.0 - q) * n - 4.0 * (4.0 - q) * k + common) / (2.0 * q * (4.0 - q))
    } else {
        ((4.0 - q) * (5.0 - q) * n - 2.0 * (5.0 - q) * k + common) / (2.0 * q * (3.0 - q))
    }
}

#[test]
#[expect(clippy::cast_precision_loss, reason = "small indices")]
fn straight_piles_have_a_closed_form() {
    for discs in [false, true] {
        for (spacing, a) in [("6/5", 1.2), ("3/2", 1.5), ("1.6", 1.6), ("1.01", 1.01)] {
            for layers in [1, 2, 3, 10, 40] {
                let pile = if discs {
                    Pile::discs(layers)
                } else {
                    Pile::triangular(layers)
                }
                .unwrap();
                let packing = packing(&pile, spacing);
                let (compliance, contacts) = soft(&packing);
                let unit = packing.unit_force().nearest::<f64>().unwrap();
                let of = |n: f64, k: f64| unit * closed_form(discs, a * a, layers as f64, n, k);
                for contact in &contacts {
                    let Site { i, j, k } = contact.site;
                    let n = [k - i - j, i, j][contact.direction.index()];
                    let expected = of(n as f64, k as f64);
                    let error = (contact.coefficient - expected).abs();
                    assert!(error < 1e-11 * layers as f64, "{contact:?}: {expected}");
                }
                // The largest error is at a corner.
                let last = layers as f64 - 2.0;
                let corners = [of(0.0, 0.0), of(0.0, last), of(last, last)].map(f64::abs);
                let largest = if layers == 1 {
                    0.0
                } else {
                    corners.into_iter().fold(0.0, f64::max)
                };
                assert!((compliance.coefficient() - largest).abs() < 1e-11 * layers as f64);
            }
        }
    }
}

/// Four layers at a/R = 6/5 and k = 1e7 mg/R. Rounding contributes 1e-15 kR/mg, about 0.05 in these coefficients.
#[test]
fn lammps_measured_the_compliance() {
    let reading = verify::read(&include_bytes!("../verify/lammps.dump")[..]).unwrap();
    let pile = Pile::triangular(4).unwrap();
    let packing = packing(&pile, "6/5");
    let (compliance, contacts) = soft(&packing);
    let numbered = NumberedPile::new(&packing).unwrap();
    let exact: Vec<_> = numbered.contacts().unwrap().map(Result::unwrap).collect();
    for (contact, exact) in contacts.iter().zip(&exact) {
        let same = |ids: [u64; 2]| BTreeSet::from(ids) == BTreeSet::from(contact.ids);
        let entry = reading.iter().find(|entry| same(entry.ids)).unwrap();
        let measured = (entry.force / exact.force - 1.0) * 1e7;
        assert!(
            (measured - contact.coefficient).abs() < 0.06,
            "{contact:?}: {measured}"
        );
    }
    let comparison: Comparison = Comparison::new(&packing, reading.iter().copied()).unwrap();
    let [largest, rms] = [
        comparison.largest_error().unwrap(),
        comparison.rms_error().unwrap(),
    ];
    assert!(
        (largest / compliance.largest_vector_error(1e7) - 1.0).abs() < 0.02,
        "{largest}"
    );
    assert!(
        (rms / compliance.rms_vector_error(1e7) - 1.0).abs() < 0.05,
        "{rms}"
    );
}

/// The error is c·mg/(κR) in any units.
#[test]
fn errors_scale_with_weight_and_size() {
    let pile = Pile::triangular(5).unwrap();
    let bare = Compliance::new(&packing(&pile, "6/5")).unwrap();
    let sized = packing(&pile, "6/5").with_radius(ratio(1, 100)).unwrap();
    let sized = sized
        .with_mass(ratio(3, 1000))
        .unwrap()
        .with_gravity(ratio(981, 100))
        .unwrap();
    let sized = Compliance::new(&sized).unwrap();
    assert!((sized.coefficient() / bare.coefficient() - 1.0).abs() < 1e-14);
    let times = 0.003 * 9.81 / 0.01;
    for of in [
        Compliance::largest_error,
        Compliance::largest_vector_error,
        Compliance::rms_error,
        Compliance::rms_vector_error,
    ] {
        assert!((of(&sized, 1e6) / (times * of(&bare, 1e6)) - 1.0).abs() < 1e-14);
    }
}

#[test]
fn packings_without_a_compliance_are_refused() {
    let touching = |pile: Pile, spacing| {
        assert_eq!(
            Compliance::new(&packing(&pile, spacing)),
            Err(NoCompliance::Touching)
        );
    };
    touching(Pile::triangular(3).unwrap(), "1");
    touching(
        Pile::under(Region::SITE, Stacking::hcp(3).unwrap()).unwrap(),
        "3/2",
    );
    let slack = |pile: Pile, says: &str| {
        let refused = Compliance::new(&packing(&pile, "6/5")).unwrap_err();
        assert!(matches!(refused, NoCompliance::Slack { .. }));
        assert!(refused.to_string().contains(says), "{refused}");
    };
    // The three lines of contacts below the load bear it, and all other contacts have no force.
    let idle = Pile::triangular(3).unwrap().weightless();
    let idle = idle.with_load(Site::APEX, ratio(1, 1)).unwrap();
    slack(idle, "sphere (k=1, i=0, j=0) along beta");
    slack(
        Pile::under(Region::SITE, Stacking::hcp(6).unwrap()).unwrap(),
        "has no force or a tensile one",
    );
    // Without contacts the error is 0.
    let one = Pile::triangular(1).unwrap();
    let (compliance, contacts) = soft(&packing(&one, "6/5"));
    assert!(contacts.is_empty());
    assert!(compliance.coefficient() <= 0.0 && compliance.rms_error(1.0) <= 0.0);
}
