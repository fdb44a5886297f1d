//! A naive oracle: the equilibrium of one sphere after the other, from the top down. Each sphere is a linear system.
//!
//! It uses none of the library's formulas. It starts from the unit vectors of the paper's (1), the weight, and the contacts
//! (`paper`, "Notation"). Gaussian elimination finds the forces.

use cannonpile::geometry::Vector;
use cannonpile::lattice::Site;
use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::answers::{Answers, Contact, Shape, Sphere, below, ratio};

/// Solves a pile for every position, contact force and force on the floor.
///
/// The unit f₀ of force is chosen so that a sphere weighs 2(1+s) f₀ cosθ, or 2 f₀ cosθ for discs.
pub fn solve(shape: &Shape, layers: i128) -> Answers {
    solve_loaded(shape, layers, |_| BigRational::one())
}

/// Solves a pile with a given external force on each sphere, in mg, which includes the weight.
pub fn solve_loaded(shape: &Shape, layers: i128, acting: impl Fn(Site) -> BigRational) -> Answers {
    let weight = match shape {
        Shape::Discs => ratio(2, 1),
        Shape::Spheres(s) => (s + BigRational::one()) * ratio(2, 1),
    };
    let e = unit_vectors(shape);
    let mut answers = Answers::none(shape, layers, weight);
    for site in shape.sites(layers) {
        let sphere = receive(&answers, &e, site);
        let weight = times(&answers.weight_vector(), &acting(site));
        let load = sphere.resultant_above.clone() + &weight;
        answers.spheres.insert(site, sphere);
        if site.k == layers - 1 {
            let in_mg = load.map(|c| c / &answers.weight);
            answers.floor.insert(site, in_mg);
            continue;
        }
        // Σ f_m ê_m + load = 0
        for ((direction, e), force) in shape.directions().iter().zip(&e).zip(supports(&e, &load)) {
            let vector = times(e, &force);
            answers
                .contacts
                .insert((site, *direction), Contact { force, vector });
        }
    }
    answers
}

/// ê_a, ê_b, ê_c of the paper's (1) over (sinθ, 2cosφ·sinθ, cosθ), with z down. The two vectors of a disc lie in the x–z
/// plane.
fn unit_vectors(shape: &Shape) -> Vec<Vector<BigRational>> {
    let vector = |x: BigRational, y| Vector {
        x,
        y,
        z: ratio(-1, 1),
    };
    let none = BigRational::zero;
    match shape {
        Shape::Discs => vec![vector(ratio(1, 1), none()), vector(ratio(-1, 1), none())],
        Shape::Spheres(s) => vec![
            vector(s.clone(), ratio(1, 2)),
            vector(s.clone(), ratio(-1, 2)),
            vector(ratio(-1, 1), none()),
        ],
    }
}

/// The forces on a sphere from above, and its position: 2R from each sphere above, against ê.
fn receive(answers: &Answers, e: &[Vector<BigRational>], site: Site) -> Sphere {
    let mut sphere = Sphere {
        position: Vector::zero(),
        from_above: [0, 1, 2].map(|_| BigRational::zero()),
        resultant_above: Vector::zero(),
    };
    // Finds the spheres of the layer above that this one supports.
    for (m, (direction, e)) in answers.shape.directions().iter().zip(e).enumerate() {
        for (upper, there) in answers.spheres.range(layer(site.k - 1)..layer(site.k)) {
            if below(*upper, *direction) == site {
                let contact = &answers.contacts[&(*upper, *direction)];
                sphere.position = there.position.clone() - e;
                sphere.from_above[m] = contact.force.clone();
                sphere.resultant_above = sphere.resultant_above - &contact.vector;
            }
        }
    }
    sphere
}

/// The first site of a layer.
fn layer(k: i128) -> Site {
    Site { i: 0, j: 0, k }
}

/// The forces f with Σ f_m ê_m = −load, by Gaussian elimination.
fn supports(e: &[Vector<BigRational>], load: &Vector<BigRational>) -> Vec<BigRational> {
    let components: fn(&Vector<BigRational>) -> Vec<BigRational> = match e.len() {
        2 => |v| vec![v.x.clone(), v.z.clone()],
        _ => |v| vec![v.x.clone(), v.y.clone(), v.z.clone()],
    };
    let columns: Vec<_> = e.iter().map(components).collect();
    let rows = components(load).into_iter().enumerate().map(|(row, load)| {
        let mut equation: Vec<_> = columns.iter().map(|column| column[row].clone()).collect();
        equation.push(-load);
        equation
    });
    eliminate(rows.collect())
}

/// The solution of n linear equations, each with n coefficients and its right side.
fn eliminate(mut rows: Vec<Vec<BigRational>>) -> Vec<BigRational> {
    let n = rows.len();
    for column in 0..n {
        let pivot = (column..n).find(|row| !rows[*row][column].is_zero());
        rows.swap(column, pivot.expect("a nonsingular system"));
        let scale = rows[column][column].clone();
        let pivot: Vec<_> = rows[column].iter().map(|c| c / &scale).collect();
        for row in &mut rows {
            let factor = row[column].clone();
            for (c, p) in row.iter_mut().zip(&pivot) {
                *c -= &factor * p;
            }
        }
        rows[column] = pivot;
    }
    rows.into_iter().filter_map(|mut row| row.pop()).collect()
}

fn times(v: &Vector<BigRational>, factor: &BigRational) -> Vector<BigRational> {
    v.clone().map(|c| c * factor)
}
