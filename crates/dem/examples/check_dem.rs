//! Checks a small DEM code: ten spheres settle on springs, and their contact forces are compared with the exact ones.
//! Run it with `cargo run --package cannonpile-dem --example check_dem`.

use std::error::Error;

use cannonpile::{Packing, Pile};
use cannonpile_dem::verify::{Comparison, Measured};

type Vector = [f64; 3];

fn main() -> Result<(), Box<dyn Error>> {
    // R = m = g = 1: the default sizes of a packing.
    let pile = Pile::triangular(3)?;
    let packing = Packing::new(&pile, &"1.2".parse()?)?;
    // Spheres are numbered from 1, those on the floor last.
    let mobile = usize::try_from(pile.numbering()?.first_on_floor() - 1)?;
    let mut errors = Vec::new();
    for stiffness in [1e3, 1e4, 1e5] {
        let mut centres = Vec::new();
        for site in pile.shape().sites() {
            let nearest = packing.position(site)?.map(|x| x.nearest());
            centres.push(nearest.map(|x| x.expect("a position within the range of f64")));
        }
        settle(&mut centres, mobile, stiffness);
        let measured = contacts(&centres, stiffness).map(|([one, other], vector)| {
            let ids = [one as u64 + 1, other as u64 + 1];
            Measured::new(ids, norm(vector)).with_vector(vector)
        });
        let comparison = Comparison::new(&packing, measured)?;
        let (matched, error) = (comparison.matched(), comparison.largest_error().unwrap());
        println!("stiffness {stiffness:e} mg/R: {matched} contacts, largest error {error:.2e}");
        assert!(comparison.accepted(10.0 / stiffness));
        errors.push(error);
    }
    // The remaining error comes from the compliance of the springs: ten times the stiffness gives a tenth of the error.
    assert!(errors.windows(2).all(|pair| pair[1] < pair[0] / 5.0));
    Ok(())
}

/// Integrates damped motion until the spheres are at rest. Only the first `mobile` spheres can move.
fn settle(centres: &mut [Vector], mobile: usize, stiffness: f64) {
    let step = 0.1 / stiffness.sqrt();
    let mut velocities = vec![[0.0; 3]; centres.len()];
    for _ in 0..20_000 {
        let mut forces = vec![[0.0, 0.0, -1.0]; centres.len()];
        for ([one, other], vector) in contacts(centres, stiffness) {
            for axis in 0..3 {
                forces[one][axis] += vector[axis];
                forces[other][axis] -= vector[axis];
            }
        }
        for sphere in 0..mobile {
            for axis in 0..3 {
                let drag = 0.2 * stiffness.sqrt() * velocities[sphere][axis];
                velocities[sphere][axis] += step * (forces[sphere][axis] - drag);
                centres[sphere][axis] += step * velocities[sphere][axis];
            }
        }
    }
}

/// Returns the overlapping pairs, each with the force on its first sphere, which is proportional to the overlap.
fn contacts(centres: &[Vector], stiffness: f64) -> impl Iterator<Item = ([usize; 2], Vector)> {
    let pairs = (0..centres.len()).flat_map(|one| (0..one).map(move |other| [one, other]));
    pairs.filter_map(move |pair| {
        let [one, other] = pair.map(|sphere| centres[sphere]);
        let apart: Vector = std::array::from_fn(|axis| one[axis] - other[axis]);
        let overlap = 2.0 - norm(apart);
        let vector = apart.map(|x| stiffness * overlap * x / norm(apart));
        (overlap > 0.0).then_some((pair, vector))
    })
}

fn norm(vector: Vector) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}
