//! Discs, and piles in more dimensions, sphere by sphere.

use cannonpile::lattice::Site;
use cannonpile::shape::Selection;
use cannonpile::{FloorForce, Pile};
use num_rational::BigRational as Q;
use num_traits::Zero;

use super::{Formulas, evaluated, find, int, prove, value};

#[test]
fn discs_on_the_floor() {
    let proof = prove("discs");
    for layers in 1..=12 {
        let pile = Pile::discs(layers).expect("a pile");
        let forces = pile.forces::<Q>();
        let l = ("L", int(layers));
        let (mut total, mut total_shear) = (Q::zero(), Q::zero());
        for force in forces.base(Selection::Base).expect("rows") {
            let FloorForce {
                site,
                normal,
                shear_x,
                shear_y,
            } = force.expect("a force");
            let values = [l.clone(), ("i", int(site.i))];
            // W = 2.
            assert_eq!(value(&proof, "normal force", &values), &normal * int(2));
            assert_eq!(value(&proof, "shear, in", &values), &shear_x * int(2));
            assert_eq!(value(&proof, "across the plane", &values), shear_y);
            total += normal * int(2);
            total_shear += shear_x;
        }
        assert_eq!(value(&proof, "ΣF_z", core::slice::from_ref(&l)), total);
        assert_eq!(
            total,
            Q::from_integer(pile.shape().sites().count().into()) * int(2)
        );
        assert_eq!(value(&proof, "ΣF_x", &[l]), total_shear);
        for site in pile.shape().sites().filter(|site| site.k < layers - 1) {
            let Site { i, k, .. } = site;
            let values = [("i", int(i)), ("k", int(k))];
            let left = ["x", "y", "z"].map(|axis| value(&proof, &format!("{axis}: "), &values));
            assert_eq!(left, forces.unbalanced(site).expect("forces").into_array());
        }
    }
}

/// All (n_1 … n_D) ≥ 0 with the sum k: the spheres of layer k.
fn layer<const D: usize>(k: usize) -> Vec<[i128; D]> {
    let places = (0..(k + 1).pow(u32::try_from(D).expect("few"))).map(|code| {
        core::array::from_fn(|m| code / (k + 1).pow(u32::try_from(m).expect("few")) % (k + 1))
    });
    places
        .filter(|counts: &[usize; D]| counts.iter().sum::<usize>() == k)
        .map(|counts| counts.map(|n| i128::try_from(n).expect("small")))
        .collect()
}

fn in_dimension<const D: usize>() {
    const NAMES: [&str; 6] = ["n_1", "n_2", "n_3", "n_4", "n_5", "n_6"];
    let proof = prove("dimensions");
    // Each of the d lines adds 1 for every sphere above and one for the sphere itself.
    let carried = |counts: &[i128; D]| int(counts.iter().map(|n| n + 1).sum());
    let mut spheres = 0;
    for last in 0..4 {
        let base = layer::<D>(last);
        spheres += base.len();
        let mut values = vec![("L", Q::from_integer((last + 1).into()))];
        let claim = |text: &str| format!("d = {D}: {text}");
        let in_all = value(&proof, &claim("Σ over the layers"), &values);
        assert_eq!(in_all, Q::from_integer(spheres.into()));
        let total: Q = base.iter().map(&carried).sum();
        assert_eq!(value(&proof, &claim("ΣF_z = weight"), &values), total);
        assert_eq!(total, Q::from_integer((spheres * D).into()));
        for counts in base {
            values.truncate(1);
            values.extend(NAMES.into_iter().zip(counts.map(int)));
            let normal = value(&proof, &claim("normal force"), &values);
            assert_eq!(normal, carried(&counts));
        }
    }
}

#[test]
fn every_dimension() {
    in_dimension::<2>();
    in_dimension::<3>();
    in_dimension::<4>();
    in_dimension::<5>();
    in_dimension::<6>();
}

/// If spheres transmitted g² + w in place of g + w, the horizontal force would be d times (g² − g) along a line minus the
/// sum of all.
#[test]
fn squared_forces_have_a_horizontal_resultant() {
    let mut squares: Formulas = Formulas::LIBRARY;
    squares.core.transmitted = |received, own| received.clone() * &received + own;
    let proof = find("dimensions").prove_for(&squares);
    let values = [("g_1", 2), ("g_2", 3), ("g_3", 5)].map(|(name, n)| (name, int(n)));
    for (coordinate, expected) in [(1, -22), (2, -10), (3, 32)] {
        let claim = format!("d = 3: no horizontal force, coordinate {coordinate}");
        let found = proof.steps.iter().find(|step| step.claim == claim);
        let sides = evaluated(found.expect("a step"), &values);
        assert_eq!(sides, [int(expected), int(0)], "{claim}");
    }
}
