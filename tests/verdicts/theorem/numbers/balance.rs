//! Forces on every sphere of piles on every base.

use cannonpile::Pile;
use cannonpile::formula::half_turn;
use cannonpile::geometry::{Vector, squared_distance};
use cannonpile::lattice::{Direction, Site};
use cannonpile::scalar::{Polynomial, Ring};
use cannonpile::theorem::{Formulas, find};
use num_rational::BigRational as Q;
use num_traits::Zero;

use super::{RIGHT, at_site, equilateral_piles, evaluated, int, piles, prove, ratio, sines, value};

const LAYERS: i128 = 5;

/// Visits every sphere of every pile, with the values of i, j, k and s.
fn every_sphere(mut visit: impl FnMut(&Pile, Site, &[(&'static str, Q)])) {
    for pile in piles(LAYERS) {
        for site in pile.shape().sites() {
            let mut values = at_site(site);
            values.push(("s", pile.sin_phi().clone()));
            visit(&pile, site, &values);
        }
    }
}

/// The apex gives each line its increment.
#[test]
fn increments_solve_the_papers_system() {
    let proof = prove("paper-system");
    for s in sines() {
        let pile = Pile::isosceles(2, s.clone()).expect("a pile");
        let forces = pile.forces::<Q>();
        let [alpha, beta, gamma] = Direction::ALL
            .map(|direction| forces.contact(Site::APEX, direction).expect("a contact"));
        let at = [("s", s.clone())];
        assert_eq!(
            value(&proof, "along x", &at),
            &s * (&alpha + &beta) - &gamma
        );
        assert_eq!(value(&proof, "along y", &at), &alpha - &beta);
        assert_eq!(value(&proof, "along z", &at), alpha + beta + gamma);
        assert_eq!(
            value(&proof, "W =", &at),
            forces.increment_sum().expect("W")
        );
    }
}

/// The triple product of any three directions, here with integer components.
#[test]
fn the_product_of_directions_is_their_determinant() {
    let skew: Formulas = Formulas {
        directions: |_| {
            [[1, 2, 3], [4, 5, 7], [11, 13, 17]].map(|direction| {
                let [x, y, z] = direction.map(Polynomial::from_integer);
                Vector { x, y, z }
            })
        },
        ..RIGHT
    };
    let proof = find("paper-system").expect("a theorem").prove_for(&skew);
    let product = proof.steps.last().expect("a step");
    assert_eq!(product.claim, "ê_a·(ê_b × ê_c) = 1+s");
    let sides = evaluated(product, &[("s", ratio(1, 2))]);
    assert_eq!(sides, [int(3), ratio(3, 2)]);
}

/// The quadratic form gives the same distances as the components of positions in the basis (sinθ, 2cosφ·sinθ, cosθ).
#[test]
fn distances_follow_from_positions() {
    let proof = prove("unit-directions");
    let sin2 = ratio(12, 25);
    for s in sines() {
        let pile = Pile::isosceles(4, s.clone()).expect("a pile");
        for site in pile.shape().sites() {
            let n = [site.k - site.i - site.j, site.i, site.j].map(int);
            let [a, b, c] = n.clone();
            let values = [
                ("a", a),
                ("b", b),
                ("c", c),
                ("s", s.clone()),
                ("σ", sin2.clone()),
            ];
            let square = value(&proof, "the Gram form", &values);
            assert_eq!(square, squared_distance(&n, &s, &sin2));
            let Vector { x, y, z } = pile.forces::<Q>().position(site).expect("a position");
            let across = int(4) * (int(1) - &s * &s);
            let horizontal = &x * &x + across * &y * &y;
            assert_eq!(square, horizontal * &sin2 + &z * &z * (int(1) - &sin2));
        }
    }
}

/// The supports of every sphere balance the contacts above and the weight.
#[test]
fn supports_balance_the_contacts_above() {
    let proof = prove("equilibrium");
    every_sphere(|pile, site, values| {
        let forces = pile.forces::<Q>();
        if site.k == pile.layers() - 1 {
            return;
        }
        let contact = |site, direction| forces.contact_vector(site, direction).expect("a contact");
        let mut supports = Vector::zero();
        let mut load = Vector {
            z: forces.increment_sum().expect("W"),
            ..Vector::zero()
        };
        for direction in Direction::ALL {
            supports = supports + &contact(site, direction);
            if let Some(above) = pile.shape().above(site, direction) {
                load = load - &contact(above, direction);
            }
        }
        let of_theorem =
            ["x", "y", "z"].map(|axis| value(&proof, &format!("{axis}: supports"), values));
        assert_eq!(of_theorem, supports.into_array());
        assert_eq!(of_theorem, (-load).into_array());
        let left = forces.unbalanced(site).expect("forces").into_array();
        assert_eq!(
            ["x", "y", "z"].map(|axis| value(
                &proof,
                &format!("{axis}: the resultant of all"),
                values
            )),
            left
        );
    });
}

#[test]
fn forces_from_above_equal_transmitted_forces() {
    let (surface, reaction) = (prove("surface"), prove("action-reaction"));
    every_sphere(|pile, site, values| {
        let forces = pile.forces::<Q>();
        let received = forces.from_above(site).expect("forces");
        for (direction, received) in Direction::ALL.into_iter().zip(received) {
            if let Some(above) = pile.shape().above(site, direction) {
                let mut values = at_site(above);
                values.push(("s", pile.sin_phi().clone()));
                let given = value(&reaction, &format!("{direction}: given"), &values);
                assert_eq!(given, received);
                assert_eq!(given, forces.contact(above, direction).expect("a contact"));
            } else {
                let claim = ["along α", "along β", "along γ"][direction.index()];
                assert_eq!(value(&surface, claim, values), received);
            }
        }
    });
}

#[test]
fn resultants_are_positions() {
    let proof = prove("central-force");
    for pile in equilateral_piles(8) {
        let forces = pile.forces::<Q>();
        for site in pile.shape().sites() {
            let force = forces.resultant_above(site).expect("a force");
            let at = forces.position(site).expect("a position");
            for (what, vector) in [("the resultant", force), ("the position", at)] {
                let of_theorem = ["x", "y", "z"].map(|axis| {
                    let claim = format!("{axis}: twice {what}");
                    value(&proof, &claim, &at_site(site)) / int(2)
                });
                assert_eq!(of_theorem, vector.into_array());
            }
        }
    }
}

#[test]
fn half_turns_are_rotations() {
    let proof = prove("half-turn");
    let [names_g, names_h] = [["g_1", "g_2", "g_3"], ["h_1", "h_2", "h_3"]];
    let dot = |a: &[Q; 3], b: &[Q; 3]| -> Q { a.iter().zip(b).map(|(x, y)| x * y).sum() };
    // Fractions are integers over a common denominator, 21 · 3.
    let turn = |g: &[Q; 3]| {
        let numerators = g.each_ref().map(|g| (g * int(63)).to_integer());
        half_turn::<Q>(&numerators).map(|tripled| Q::new(tripled, 189.into()))
    };
    for n in 0..30 {
        let g = [ratio(n, 1), ratio(5 - n, 3), ratio(n * n, 7)];
        let h = [ratio(1, 2), ratio(-n, 5), ratio(3, 1)];
        let named = names_g
            .into_iter()
            .zip(g.clone())
            .chain(names_h.into_iter().zip(h.clone()));
        let values: Vec<_> = named.collect();
        let turned = turn(&g);
        assert_eq!(value(&proof, "|Gg|²", &values), dot(&turned, &turned));
        assert_eq!(value(&proof, "h·Gg", &values), dot(&h, &turned));
        assert_eq!(turn(&turned), g);
        // A half-turn about (1, 1, 1) keeps the component along the axis and reverses the rest.
        let mean = g.iter().sum::<Q>() / int(3);
        for (x, turned) in g.iter().zip(&turned) {
            assert!((x - &mean + turned - &mean).is_zero());
        }
    }
}
