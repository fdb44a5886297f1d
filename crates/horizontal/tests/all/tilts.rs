//! The tilts that piles bear with horizontal contacts.

use cannonpile::lattice::Region;
use cannonpile::{Load, Pile, ratio};
use cannonpile_horizontal::certificate::{Certificate, Claim};
use cannonpile_horizontal::{equilibrium, margin, tilts};
use num_rational::BigRational;
use num_traits::Zero;

fn under(top: Region, stacking: &str) -> Pile {
    Pile::under(top, stacking.parse().unwrap()).unwrap()
}

fn stands(pile: &Pile, tilt: [BigRational; 2]) -> bool {
    let certificate = equilibrium(&pile.clone().with_tilt(tilt).unwrap()).unwrap();
    assert_eq!(certificate.check(), Ok(()));
    certificate.claim == Claim::Stands
}

/// The margin of a pile that is cut off below its last sign change is that of the whole pile.
#[test]
fn margins_of_long_piles() {
    for (top, stacking) in [
        (Region::SITE, "+-++"),
        (Region::SITE, "+--"),
        (Region::SITE, "+-+-+"),
        (Region::hexagon(2, 2).unwrap(), "+-++"),
    ] {
        let pile = under(top, stacking);
        let tilted = pile.clone().with_tilt([ratio!(1 / 500), ratio!(0)]);
        for pile in [pile, tilted.unwrap()] {
            let whole = tilts(&pile).unwrap().margin.unwrap().squared;
            assert_eq!(margin(&pile).unwrap().unwrap().squared, whole, "{pile}");
        }
    }
}

/// Just inside its polygon a pile stands, and just outside it falls. Both are proved by certificates.
fn check(pile: &Pile) {
    let found = tilts(pile).unwrap();
    let scaled = |corner: &[BigRational; 2], by: &BigRational| corner.clone().map(|part| part * by);
    let next = found.corners.iter().cycle().skip(1);
    for (here, next) in found.corners.iter().zip(next) {
        let middle = [0, 1].map(|axis| (&here[axis] + &next[axis]) / ratio!(2));
        for point in [here.clone(), middle] {
            assert!(stands(pile, scaled(&point, &ratio!(99 / 100))), "{pile}");
            assert!(!stands(pile, scaled(&point, &ratio!(101 / 100))), "{pile}");
        }
    }
    // Horizontal contacts can only help.
    let alone = cannonpile_stability::tilts(pile).unwrap();
    if let Some(alone) = alone.margin {
        assert!(found.margin.as_ref().unwrap().squared >= alone.squared);
    }
    if let Some(margin) = found.margin {
        let Certificate { claim, .. } = margin.opens;
        assert_eq!(claim, Claim::CannotStand);
    }
}

#[test]
fn piles_stand_inside_their_polygon_and_fall_outside() {
    for stacking in ["+", "++", "+-", "+-+", "+--", "+-+-+"] {
        check(&under(Region::SITE, stacking));
    }
    check(&under(Region::hexagon(2, 2).unwrap(), "+-"));
}

#[test]
fn horizontal_contacts_give_no_margin_to_a_stacking_on_a_knifes_edge() {
    let pile = under(Region::SITE, "+++-+");
    assert!(
        cannonpile_stability::tilts(&pile)
            .unwrap()
            .margin
            .unwrap()
            .squared
            .is_zero()
    );
    let margin = tilts(&pile).unwrap().margin.unwrap().squared;
    assert!(margin.is_zero(), "{margin}");
}

/// The exact checker balances directed loads as well as the solver.
#[test]
fn directed_loads_are_balanced() {
    let push = |x: BigRational| Load {
        down: ratio!(0),
        x,
        y: ratio!(1 / 100),
    };
    let site = cannonpile::lattice::Site::new(1, 0, 2);
    let pile = |x| {
        under(Region::SITE, "+-+-")
            .with_load(site, push(x))
            .unwrap()
    };
    assert!(stands(
        &pile(ratio!(1 / 50)),
        [ratio!(1 / 200), ratio!(-1 / 200)]
    ));
    assert!(!stands(&pile(ratio!(-30)), [ratio!(0), ratio!(0)]));
}
