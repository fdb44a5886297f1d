//! Stability with horizontal contacts, and elastic states.

use std::collections::BTreeSet;

use cannonpile::Error as Core;
use cannonpile::Pile;
use cannonpile::lattice::{Region, Site};
use cannonpile::shape::Selection;
use cannonpile_horizontal::certificate::{Certificate, Claim, Condition, Refusal};
use cannonpile_horizontal::{Error, elastic, equilibrium};
use num_traits::Signed;

use crate::stackings;
use cannonpile_testkit::cases::repeated;
use cannonpile_testkit::oracles::balance::ratio;

fn under_one_sphere(stacking: &str) -> Pile {
    Pile::under(Region::SITE, stacking.parse().unwrap()).unwrap()
}

#[test]
fn every_stacking_is_decided_with_its_prefixes() {
    let mut standing = BTreeSet::from([String::new()]);
    let mut counts = Vec::new();
    for steps in 1..=7 {
        let mut count = 0;
        for stacking in stackings(steps) {
            let pile = under_one_sphere(&stacking);
            let certificate = equilibrium(&pile).unwrap();
            assert_eq!(certificate.check(), Ok(()), "{stacking}");
            assert_eq!(certificate.pile, pile);
            let stands = certificate.claim == Claim::Stands;
            if pile.first_failure().unwrap().is_none() {
                assert!(stands, "{stacking}");
            }
            if stands {
                assert!(standing.contains(&stacking[..steps - 1]), "{stacking}");
                standing.insert(stacking.clone());
                count += 1;
            }
            // The elastic state exists if and only if the pile is stable.
            let springs = elastic(&pile, &ratio(1, 1));
            assert_eq!(springs.is_ok(), stands, "{stacking}");
            if !stands {
                assert_eq!(springs.unwrap_err(), Error::CannotStand);
            }
        }
        counts.push(count);
    }
    // Without horizontal contacts HCP of six layers would be missing.
    assert_eq!(counts, [1, 2, 4, 8, 12, 12, 12]);
}

#[test]
fn large_piles_are_decided_by_first_layers() {
    let hcp = under_one_sphere(&repeated("+-", 999));
    let certificate = equilibrium(&hcp).unwrap();
    assert_eq!(certificate.claim, Claim::CannotStand);
    assert_eq!(certificate.check(), Ok(()));
    assert!(certificate.pile.layers() < 20);
    // The search starts one layer below the first failure and extends by half each time.
    for (stacking, layers) in [
        ("+-+-++-".to_owned() + &repeated("+-", 100), 10),
        ("++----+".to_owned() + &repeated("-+", 100), 8),
    ] {
        let certificate = equilibrium(&under_one_sphere(&stacking)).unwrap();
        assert_eq!(certificate.claim, Claim::CannotStand);
        assert!(certificate.pile.layers() <= layers, "{stacking}");
    }
    // Below the last sign change all forces increase.
    let straight_below = under_one_sphere(&format!("+-+-+{}", "+".repeat(300)));
    let certificate = equilibrium(&straight_below).unwrap();
    assert_eq!(certificate.claim, Claim::Stands);
    assert_eq!(certificate.check(), Ok(()));
    let loaded = straight_below
        .with_load(Site { i: 0, j: 0, k: 250 }, ratio(5, 3))
        .unwrap();
    assert_eq!(equilibrium(&loaded).unwrap().claim, Claim::Stands);
    let on_a_base = Pile::on(
        Region::hexagon(9, 8).unwrap(),
        repeated("-+", 7).parse().unwrap(),
    );
    let certificate = equilibrium(&on_a_base.unwrap()).unwrap();
    assert_eq!(certificate.check(), Ok(()));
}

/// Runs of two steps are never too long, whatever their loads are. The program with 23,610 equations is too large
/// to solve.
#[test]
fn heavy_edge_is_not_a_long_run() {
    let heavy = Site { i: 60, j: -1, k: 2 };
    let pile = Pile::under(Region::triangle(60).unwrap(), "+--+".parse().unwrap());
    let pile = pile.unwrap().with_load(heavy, ratio(10, 1)).unwrap();
    let refused = equilibrium(&pile);
    assert!(
        matches!(refused, Err(Error::Core(Core::TooLarge { .. }))),
        "{refused:?}"
    );
}

#[test]
fn elastic_state_of_straight_piles_is_isostatic() {
    for pile in [
        Pile::triangular(9).unwrap(),
        Pile::discs(9).unwrap(),
        under_one_sphere("-----"),
        Pile::under(Region::hexagon(3, 2).unwrap(), "----".parse().unwrap()).unwrap(),
        Pile::on(Region::hexagon(5, 6).unwrap(), "+++".parse().unwrap()).unwrap(),
    ] {
        for stiffness in [ratio(1, 1000), ratio(1, 1), ratio(77, 2)] {
            let springs = elastic(&pile, &stiffness).unwrap();
            assert_eq!(springs.pile(), &pile);
            assert_eq!(springs.certificate().unwrap().check(), Ok(()));
        }
    }
    let high = Pile::triangular(10_i128.pow(20)).unwrap();
    let springs = elastic(&high, &ratio(1, 1)).unwrap();
    assert_eq!((springs.pile(), springs.certificate()), (&high, None));
}

#[test]
fn elastic_forces_balance_pile() {
    let mut pushing = 0;
    let stackings = ["+-+-+", "+-+-++", "++-+-+", "+-+-+++"];
    let loads = [ratio(0, 1), ratio(1, 30), ratio(1, 3)];
    let cases = stackings
        .into_iter()
        .flat_map(|stacking| loads.iter().map(move |load| (stacking, load)));
    for (stacking, load) in cases {
        let pile = under_one_sphere(stacking);
        let pile = pile.with_load(Site::APEX, load.clone()).unwrap();
        let Ok(springs) = elastic(&pile, &ratio(3, 2)) else {
            assert_eq!(equilibrium(&pile).unwrap().claim, Claim::CannotStand);
            continue;
        };
        let state = springs.pile();
        pushing += state.horizontal_forces().len();
        assert!(
            state
                .horizontal_forces()
                .all(|(_, force)| force.is_positive())
        );
        assert_eq!(state.first_failure(), Ok(None));
        let [normal, shear_x, shear_y] = state.forces().sum_on_floor(Selection::Base).unwrap();
        assert_eq!(
            [normal, shear_x, shear_y],
            [pile.weight(), ratio(0, 1), ratio(0, 1)]
        );
        // Horizontal forces that were assigned before make no difference.
        assert_eq!(elastic(state, &ratio(3, 2)).as_ref(), Ok(&springs));
        let forces = springs.certificate().unwrap();
        assert_eq!(forces.check(), Ok(()));
    }
    assert!(pushing > 0);
}

#[test]
fn invalid_elastic_requests_are_errors() {
    let pile = Pile::triangular(4).unwrap();
    let given = ratio(0, 1);
    let refused = elastic(&pile, &given).unwrap_err();
    assert_eq!(
        refused,
        Core::NotPositive {
            quantity: "stiffness-ratio",
            given
        }
        .into()
    );
    let leaning = Pile::isosceles(4, ratio(1, 3)).unwrap();
    assert!(matches!(
        elastic(&leaning, &ratio(1, 1)),
        Err(Error::Core(Core::NoHorizontalContacts { .. }))
    ));
    assert!(matches!(
        equilibrium(&leaning),
        Err(Error::Core(Core::NoHorizontalContacts { .. }))
    ));
}

/// Contacts of spheres without weight and load have no unique displacement field: any field without compression is
/// valid.
#[test]
fn contacts_without_force_are_open() {
    let base = Region::new(-3..=0, -3..=1, -5..=-1).unwrap();
    let pile = Pile::on(base, "+++".parse().unwrap()).unwrap();
    let loaded = pile.with_load(Site { i: -2, j: -3, k: 1 }, ratio(1, 1));
    let pile = loaded.unwrap().weightless();
    let springs = elastic(&pile, &ratio(1, 1)).unwrap();
    assert_eq!(springs.certificate().unwrap().check(), Ok(()));
}

/// Not every choice of the undetermined gaps is valid: those nearest to the float solution overlap, others do not.
#[test]
fn overlapping_gaps_are_corrected() {
    for (top, stacking, loads) in [
        (
            Region::hexagon(1, 2).unwrap(),
            "++",
            vec![([0, 0, -1], ratio(1, 3)), ([2, 1, 0], ratio(5, 7))],
        ),
        (
            Region::hexagon(2, 2).unwrap(),
            "++",
            vec![([0, -1, 1], ratio(1, 3))],
        ),
    ] {
        let pile = Pile::under(top, stacking.parse().unwrap()).unwrap();
        let pile = loads.iter().fold(pile, |pile, ([k, i, j], load)| {
            let site = Site {
                i: *i,
                j: *j,
                k: *k,
            };
            pile.with_load(site, load.clone()).unwrap()
        });
        let springs = elastic(&pile.weightless(), &ratio(1, 1)).unwrap();
        assert_eq!(springs.certificate().unwrap().check(), Ok(()));
    }
}

/// Some contacts have neither force nor gap, so floats cannot decide which of them are open.
#[test]
fn degenerate_contacts_are_decided_exactly() {
    let base = Region::new(-6..=0, -3..=3, -5..=2).unwrap();
    let mut pile = Pile::on(base, "---".parse().unwrap()).unwrap();
    for ([k, i, j], weight) in [([0, -2, 0], 0), ([2, -4, 2], 0), ([2, -1, 1], 5)] {
        pile = pile
            .with_weight(Site { i, j, k }, ratio(weight, 1))
            .unwrap();
    }
    for stiffness in [ratio(1, 9), ratio(1, 1), ratio(9, 2)] {
        let springs = elastic(&pile, &stiffness).unwrap();
        assert_eq!(springs.certificate().unwrap().check(), Ok(()));
    }
}

/// Most spheres have neither weight nor load.
#[test]
fn contacts_of_weightless_spheres_are_decided() {
    let base = Region::new(-3..=3, -3..=2, -2..=4).unwrap();
    let mut pile = Pile::on(base, "--+".parse().unwrap()).unwrap().weightless();
    for ([k, i, j], load) in [([2, -1, 0], ratio(5, 4)), ([3, -2, 2], ratio(7, 1))] {
        pile = pile.with_load(Site { i, j, k }, load).unwrap();
    }
    let springs = elastic(&pile, &ratio(4, 7)).unwrap();
    assert_eq!(springs.certificate().unwrap().check(), Ok(()));

    // Here degenerate contacts are opened and closed in turn, one by one.
    let base = Region::new(-2..=4, -2..=4, -2..=4).unwrap();
    let pile = Pile::on(base, "+++-".parse().unwrap())
        .unwrap()
        .weightless();
    let [top, below] = [[0, 1, -1], [3, 1, 3]].map(|[k, i, j]| Site { i, j, k });
    let pile = pile.with_load(below, ratio(6, 1)).unwrap();
    let springs = elastic(&pile, &ratio(1, 4)).unwrap();
    assert_eq!(springs.certificate().unwrap().check(), Ok(()));

    // The weight of one sphere acts as its load would.
    let heavy = pile.clone().with_weight(top, ratio(5, 4)).unwrap();
    let loaded = pile.with_load(top, ratio(5, 4)).unwrap();
    for pile in [heavy, loaded] {
        assert_eq!(elastic(&pile, &ratio(1, 4)), Err(Error::CannotStand));
        let certificate = equilibrium(&pile).unwrap();
        assert_eq!(certificate.check(), Ok(()));
    }
}

/// The stiffness ratios range from very soft to very stiff horizontal springs.
#[test]
fn active_contacts_are_found_at_every_stiffness_ratio() {
    let loaded = Pile::triangular(6).unwrap();
    let site = Site { i: 1, j: 0, k: 2 };
    let piles = [
        under_one_sphere("+-+-+"),
        under_one_sphere("+-+-+++"),
        loaded.with_load(site, ratio(30, 1)).unwrap(),
    ];
    let tiny = ratio(1, 1_000_000_000_000) * ratio(1, 1_000_000_000_000);
    let ratios = [
        tiny.clone(),
        ratio(1, 1_000_000_000),
        ratio(1, 1_000_000),
        ratio(1, 1000),
        ratio(1_000_000, 1),
        tiny.recip(),
    ];
    for pile in &piles {
        for stiffness in &ratios {
            let springs = elastic(pile, stiffness).unwrap();
            assert_eq!(
                springs.certificate().unwrap().check(),
                Ok(()),
                "{stiffness}"
            );
        }
    }
}

#[test]
fn certificate_with_forces_in_pile_is_refused() {
    let springs = elastic(&under_one_sphere("+-+-+"), &ratio(1, 1)).unwrap();
    let certificate = springs.certificate().unwrap().clone();
    let pile = springs.pile().clone();
    let (contact, _) = pile.horizontal_forces().next().unwrap();
    let invalid = Certificate {
        pile,
        ..certificate
    };
    let refusal = invalid.check().unwrap_err();
    assert!(matches!(refusal, Refusal::Violated(Condition::Pile, _)));
    let text = format!("the horizontal contact {contact}; move it to the certificate");
    assert!(refusal.to_string().ends_with(&text), "{refusal}");
}

/// A certificate about more than 10⁵ spheres covers the layers down to one below the last sign change, with their
/// weights and loads. A certificate about fewer spheres covers the whole pile.
#[test]
fn certificates_of_large_piles_cover_first_layers() {
    let large = under_one_sphere("(1,1,98)");
    let certificate = equilibrium(&large).unwrap();
    assert_eq!(
        (certificate.claim, certificate.pile),
        (Claim::Stands, under_one_sphere("+-+"))
    );
    let [apex, second, deep] = [(0, 0), (0, 1), (0, 50)].map(|(i, k)| Site { i, j: 0, k });
    let changed = |pile: Pile| {
        let pile = pile.with_weight(second, ratio(1, 2)).unwrap();
        pile.with_load(apex, ratio(1, 9)).unwrap()
    };
    let other = changed(large).with_weight(deep, ratio(3, 1)).unwrap();
    let other = other.with_load(deep, ratio(5, 1)).unwrap();
    let certificate = equilibrium(&other).unwrap();
    assert_eq!(certificate.check(), Ok(()));
    assert_eq!(certificate.pile, changed(under_one_sphere("+-+")));
    for stacking in ["+-+-++", "+-+-+++", "(1,30)"] {
        let pile = under_one_sphere(stacking);
        assert_eq!(equilibrium(&pile).unwrap().pile, pile, "{stacking}");
    }
}

/// The elastic state is known for all sizes only for the straight pile of equal spheres.
#[test]
fn large_piles_are_straight_or_too_large() {
    let one = ratio(1, 1);
    let straight = Pile::triangular(100).unwrap();
    let state = elastic(&straight, &one).unwrap();
    assert!(state.certificate().is_none() && state.pile().horizontal_forces().next().is_none());
    let loaded = straight.with_load(Site::APEX, ratio(5, 1)).unwrap();
    for pile in [loaded, under_one_sphere("(1,99)")] {
        let refused = elastic(&pile, &one).err();
        assert!(
            matches!(refused, Some(Error::Core(Core::TooLarge { .. }))),
            "{refused:?}"
        );
    }
}
