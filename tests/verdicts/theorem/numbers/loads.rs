//! Piles under gravity that leans: totals on the floor, and the least tilt that opens a contact.

use cannonpile::Pile;
use cannonpile_testkit::rational::ratio;
use num_rational::BigRational as Q;

use super::base::{at_layers, base, over};
use super::{int, piles, prove, value};

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
            let mut values = at_layers(&pile);
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
    let margin = pile.stability().expect("a verdict").margin;
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
