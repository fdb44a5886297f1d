//! Given forces in horizontal contacts. All methods and floats agree with the oracle on the forces that balance them.

use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Axis, HorizontalContact, Site};
use cannonpile::shape::Selection;
use cannonpile::{Error, Method, Packing, Pile};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero;

use cannonpile_testkit::cases::{Bounds, Case, Random, repeated};
use cannonpile_testkit::compare::agrees;
use cannonpile_testkit::oracles::balance::ratio;

/// Random tops and bases, with and without loads.
fn cases(number: usize, random: &mut Random) -> Vec<Case> {
    let mut cases = Vec::new();
    while cases.len() < number {
        let (steps, loads, pushes) = (random.below(8), random.below(3), 1 + random.below(9));
        let case = if cases.len() % 2 == 0 {
            let top = random.bounds(3);
            Some(Case::under(&top, &random.signs(steps)))
        } else {
            let base = random.bounds(9);
            Case::on(&base, &random.signs(steps))
        };
        cases.extend(case.map(|case| {
            case.with_random_loads(loads, random)
                .with_random_horizontal_forces(pushes, random)
        }));
    }
    cases
}

#[test]
fn every_force_equals_the_oracle() {
    let mut random = Random(41);
    let cases = cases(250, &mut random);
    let pushed = cases
        .iter()
        .filter(|case| case.pile.horizontal_forces().len() > 0);
    assert!(pushed.count() > 100);
    for case in cases {
        agrees(&case).unwrap();
    }
}

#[test]
fn all_methods_agree_exactly_and_rounded() {
    let mut random = Random(42);
    for case in cases(60, &mut random) {
        let forces = case.pile.forces::<BigRational>();
        let exact: Vec<_> = forces
            .contacts(Selection::All)
            .unwrap()
            .map(Result::unwrap)
            .collect();
        for method in [Method::Tree, Method::Sweep] {
            let by = forces.clone().with_method(method).unwrap();
            let contacts = by.contacts(Selection::All).unwrap().map(Result::unwrap);
            assert!(contacts.eq(exact.iter().cloned()), "{method:?}");
        }
        let packing = Packing::new(&case.pile, &Spacing::new(ratio(1, 1)).unwrap()).unwrap();
        let mut slices = [(); 3].map(|()| vec![0.0_f64; exact.len() / 3]);
        packing
            .layers::<f64>(Selection::All)
            .unwrap()
            .fill(slices.each_mut().map(Vec::as_mut_slice))
            .unwrap();
        for (n, contact) in exact.iter().enumerate() {
            let nearest = packing.unit_force().scaled(&contact.force).nearest::<f64>();
            assert_eq!(Some(slices[n % 3][n / 3]), nearest);
        }
        let sum: BigRational = exact.iter().map(|contact| contact.force.clone()).sum();
        assert_eq!(forces.sum_of_contacts(Selection::All), Ok(sum));
    }
}

/// The piles are symmetric under a third of a turn, until a horizontal force breaks the symmetry.
#[test]
fn one_horizontal_force_breaks_every_symmetry() {
    let contact = HorizontalContact {
        site: Site { i: 0, j: 0, k: 2 },
        axis: Axis::AlphaBeta,
    };
    for top in [Bounds::SITE, Bounds::hexagon(3, 3), Bounds::triangle(3)] {
        for signs in ["+++++", "++-+-", "-+-++-"] {
            let mut case = Case::under(&top, signs);
            let force = ratio(3, 7);
            let pile = case
                .pile
                .clone()
                .with_horizontal_force(contact, force.clone());
            case.pile = pile.unwrap();
            case.balance.add_horizontal_force((2, 0, 0), [1, 0], &force);
            agrees(&case).unwrap();
        }
    }
}

/// Horizontal forces with coprime denominators, and many sign changes, give values with many limbs.
#[test]
fn long_horizontal_forces_are_exact() {
    let denominators = [10_007_i64, 99_991, 1_000_003];
    let mut case = Case::under(&Bounds::SITE, &repeated("+-", 12));
    for (n, denominator) in denominators.into_iter().enumerate() {
        let k = 3 + 3 * n;
        let site = Site {
            i: 0,
            j: 0,
            k: i128::try_from(k).unwrap(),
        };
        let force = BigRational::new((BigInt::from(1) << 70) + n, denominator.into());
        let contact = HorizontalContact {
            site,
            axis: Axis::AlphaGamma,
        };
        case.pile = case
            .pile
            .with_horizontal_force(contact, force.clone())
            .unwrap();
        case.balance
            .add_horizontal_force((site.k, 0, 0), [0, 1], &force);
    }
    agrees(&case).unwrap();
    let exact = case.pile.forces::<BigRational>();
    let by = |method| {
        let contacts = exact
            .clone()
            .with_method(method)
            .unwrap()
            .contacts(Selection::All)
            .unwrap();
        contacts.map(Result::unwrap).collect::<Vec<_>>()
    };
    assert_eq!(by(Method::Tree), by(Method::Sweep));
}

#[test]
fn extremes_of_the_base_equal_those_of_its_spheres() {
    let mut random = Random(44);
    for case in cases(80, &mut random) {
        let Ok(extremes) = case.pile.base_extremes() else {
            continue;
        };
        let forces = case.balance.forces();
        let normals = || forces.floor.values().map(|[normal, ..]| normal);
        assert_eq!(Some(&extremes.normal_min), normals().min());
        assert_eq!(Some(&extremes.normal_max), normals().max());
    }
}

#[test]
fn horizontal_forces_do_not_change_the_total_weight() {
    let mut random = Random(43);
    for case in cases(60, &mut random) {
        let [normal, x, y] = case.pile.forces().sum_on_floor(Selection::Base).unwrap();
        assert_eq!(
            [normal, x, y],
            [case.balance.whole_weight(), ratio(0, 1), ratio(0, 1)]
        );
    }
}

#[test]
fn invalid_horizontal_forces_are_rejected() {
    let pile = Pile::triangular(4).unwrap();
    let contact = |i, j, k, axis| HorizontalContact {
        site: Site { i, j, k },
        axis,
    };
    let push = |contact, force| pile.clone().with_horizontal_force(contact, force);
    let one = ratio(1, 1);
    assert!(push(contact(0, 0, 2, Axis::AlphaBeta), one.clone()).is_ok());
    for outside in [
        contact(0, 0, 0, Axis::AlphaBeta),
        contact(0, 0, 2, Axis::GammaBeta),
        contact(3, 0, 2, Axis::AlphaGamma),
    ] {
        assert!(
            matches!(push(outside, one.clone()), Err(Error::SiteOutside { .. })),
            "{outside}"
        );
    }
    let past = contact(i128::MAX, 0, 2, Axis::AlphaBeta);
    assert!(matches!(
        push(past, one.clone()),
        Err(Error::SiteOutside { .. })
    ));
    let site = Site { i: 0, j: 0, k: 3 };
    assert_eq!(
        push(contact(0, 0, 3, Axis::AlphaBeta), one.clone()),
        Err(Error::OnFloor { site })
    );
    let pull = push(contact(0, 0, 2, Axis::AlphaBeta), ratio(-1, 2)).unwrap_err();
    assert_eq!(
        pull.to_string(),
        "the horizontal force of the sphere (i,j,k) = (0,0,2) must not be negative, but is -1/2"
    );
    // A force of zero leaves the pile unchanged, and so does a removed force.
    assert_eq!(
        push(contact(0, 0, 2, Axis::AlphaBeta), BigRational::zero()),
        Ok(pile.clone())
    );
    let pushed = push(contact(0, 0, 2, Axis::AlphaBeta), one.clone()).unwrap();
    assert_ne!(pushed, pile);
    assert_eq!(pushed.without_horizontal_forces(), pile);
    let leaning = Pile::isosceles(4, ratio(1, 3)).unwrap();
    let refused = leaning.with_horizontal_force(contact(0, 0, 2, Axis::AlphaBeta), one.clone());
    assert!(matches!(refused, Err(Error::NoHorizontalContacts { .. })));
    // Neighbours must touch.
    let apart = Spacing::new(ratio(6, 5)).unwrap();
    let pushed = push(contact(0, 0, 2, Axis::AlphaBeta), one.clone()).unwrap();
    assert!(matches!(
        Packing::new(&pushed, &apart),
        Err(Error::NotTouching { .. })
    ));
    let discs = Pile::discs(4).unwrap();
    assert!(
        discs
            .clone()
            .with_horizontal_force(contact(0, 0, 2, Axis::AlphaBeta), one.clone())
            .is_ok()
    );
    let across = discs.with_horizontal_force(contact(0, 0, 2, Axis::AlphaGamma), one);
    assert!(matches!(across, Err(Error::SiteOutside { .. })));
}
