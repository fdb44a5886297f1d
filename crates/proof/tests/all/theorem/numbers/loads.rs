//! Piles under gravity that leans: totals on the floor, and the least tilt that opens a contact.

use cannonpile::shape::Selection;
use cannonpile::{FloorForce, Pile};
use num_rational::BigRational as Q;

use super::{int, prove, ratio, value};

/// A bottom sphere: its force in mg/W and f₀, and its horizontal position in 2R.
struct Bottom {
    force: FloorForce<Q>,
    x: Q,
    y: Q,
}

fn base(pile: &Pile) -> Vec<Bottom> {
    let forces = pile.forces::<Q>();
    let weight = forces.increment_sum().expect("W");
    let of_force = |force: FloorForce<Q>| {
        let at = forces.position(force.site).expect("a position");
        Bottom {
            force: FloorForce {
                normal: force.normal * &weight,
                shear_x: force.shear_x * &weight,
                shear_y: force.shear_y * &weight,
                ..force
            },
            x: at.x,
            y: at.y,
        }
    };
    let bottom = forces.base(Selection::Base).expect("rows");
    bottom
        .map(|force| of_force(force.expect("a force")))
        .collect()
}

/// Σ over the base.
fn over(base: &[Bottom], term: impl Fn(&Bottom) -> Q) -> Q {
    base.iter().map(term).sum()
}

/// Piles of 1 to `layers` layers on five bases: the equilateral one, with a smaller and a greater sin φ, and with one
/// close to zero.
fn piles(layers: i128) -> impl Iterator<Item = Pile> {
    let sines = [(1, 2), (1, 3), (2, 5), (7, 9), (1, 1000)].map(|(n, d)| ratio(n, d));
    let of_one_base =
        move |s: Q| (1..=layers).map(move |l| Pile::isosceles(l, s.clone()).expect("a pile"));
    sines.into_iter().flat_map(of_one_base)
}

/// Several tilts (x, y).
fn tilts() -> [[Q; 2]; 3] {
    [[(0, 1), (1, 9)], [(1, 5), (-1, 7)], [(-3, 1), (2, 1)]]
        .map(|tilt| tilt.map(|(n, d)| ratio(n, d)))
}

#[test]
fn total_force_and_moment() {
    let proof = prove("tilt-total");
    for pile in piles(5) {
        for [x, y] in tilts() {
            let tilted = pile.clone().with_tilt([x.clone(), y.clone()]);
            let base = base(&tilted.expect("a pile"));
            let mut values = vec![("L", int(pile.layers())), ("s", pile.sin_phi().clone())];
            values.extend([("x", x), ("y", y)]);
            let value = |claim| value(&proof, claim, &values);
            assert_eq!(value("x: ΣF ="), over(&base, |b| b.force.shear_x.clone()));
            assert_eq!(value("y: ΣF ="), over(&base, |b| b.force.shear_y.clone()));
            assert_eq!(value("z: ΣF ="), over(&base, |b| b.force.normal.clone()));
            let depth = int(pile.layers() - 1);
            assert_eq!(
                value("x: ΣF × r_b"),
                over(&base, |b| &b.force.shear_y * &depth
                    - &b.force.normal * &b.y)
            );
            assert_eq!(
                value("y: ΣF × r_b"),
                over(&base, |b| &b.force.normal * &b.x
                    - &b.force.shear_x * &depth)
            );
            assert_eq!(
                value("z: ΣF × r_b"),
                over(&base, |b| &b.force.shear_x * &b.y - &b.force.shear_y * &b.x)
            );
        }
    }
}

fn margin(pile: &Pile) -> Q {
    let margin = cannonpile_stability::tilts(pile).expect("a verdict").margin;
    margin.expect("a stable pile").squared
}

/// The least tilt of theorem `tilt` is the smaller of s² and (1−s)/2 for every base, and 1 for discs. A single layer has
/// no contacts.
#[test]
fn least_tilts() {
    for pile in piles(4).filter(|pile| pile.layers() > 1) {
        let s = pile.sin_phi();
        let least = (s * s).min((int(1) - s) / int(2));
        assert_eq!(margin(&pile), least);
    }
    for layers in [2, 3, 7] {
        assert_eq!(margin(&Pile::discs(layers).expect("discs")), int(1));
    }
}
