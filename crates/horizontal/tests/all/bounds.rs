//! Bounds of bottom spheres, with every certificate checked.

use std::collections::BTreeMap;

use cannonpile::Error as Core;
use cannonpile::lattice::{Region, Site};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Interrupt, Pile};
use cannonpile_horizontal::certificate::{Certificate, Claim, Extreme};
use cannonpile_horizontal::{Error, NormalBound, base_bounds, bounds, elastic};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::stackings;
use cannonpile_testkit::oracles::balance::ratio;

fn bottom(pile: &Pile) -> impl Iterator<Item = Site> + '_ {
    pile.rows(Selection::Base).unwrap().flatten()
}

/// Returns both bounds of every bottom sphere.
fn all(pile: &Pile) -> BTreeMap<Site, [NormalBound; 2]> {
    let bounds = base_bounds(pile, Selection::Base)
        .unwrap()
        .map(Result::unwrap);
    bounds
        .map(|(site, bounds)| (site, [bounds.least, bounds.greatest]))
        .collect()
}

fn is_proved(bound: &NormalBound) {
    if let Some(certificate) = &bound.certificate {
        assert_eq!(certificate.check(), Ok(()));
        let (Claim::Least(extreme) | Claim::Greatest(extreme)) = &certificate.claim else {
            panic!("{:?}", certificate.claim);
        };
        assert_eq!(
            (&extreme.normal, extreme.attained),
            (&bound.normal, bound.attained)
        );
    }
}

/// Returns the upper bound that the page `cannonpile::paper` states, from the sorted coordinates n*.
fn formula(k: i128, site: Site) -> BigRational {
    let mut n = [k - site.i - site.j, site.i, site.j];
    n.sort_unstable();
    let [c, b, a] = n;
    let [a, b, c] = [a, b, c].map(BigInt::from);
    let above = if b.is_zero() {
        a * 3 - 2
    } else if c.is_zero() && a == b {
        &a * &b * 2
    } else if c.is_zero() {
        (b + 1) * 2 * (a - 1) + 1
    } else {
        [a, b, c]
            .into_iter()
            .map(|n| (&n + 1) * (&n + 2) * n / 6)
            .sum()
    };
    BigRational::one() + BigRational::new(above, 3.into())
}

#[test]
fn straight_piles_match_formulas() {
    for layers in 3..=9 {
        let (pile, k) = (Pile::triangular(layers).unwrap(), layers - 1);
        for (site, [least, greatest]) in all(&pile) {
            is_proved(&least);
            is_proved(&greatest);
            assert!(least.attained && greatest.attained, "{site}");
            let n = [k - site.i - site.j, site.i, site.j];
            let is_corner = n.contains(&k);
            let expected = if is_corner {
                BigRational::new((layers + 2).into(), 3.into())
            } else {
                BigRational::one()
            };
            assert_eq!(least.normal, expected, "{site}");
            let most = formula(k, site);
            if n.contains(&0) || n == [k / 3; 3] {
                // The bound is attained at corners, on edges and at the centre.
                assert_eq!(greatest.normal, most, "{site}");
            } else {
                assert!(greatest.normal <= most, "{site}");
            }
        }
    }
}

#[test]
fn minus_piles_are_rotated_plus_piles() {
    let turned = Pile::under(Region::SITE, "-----".parse().unwrap()).unwrap();
    let plus = all(&Pile::triangular(6).unwrap());
    let minus = all(&turned);
    assert_eq!(plus.len(), minus.len());
    for (Site { i, j, k }, bounds) in minus {
        bounds.iter().for_each(is_proved);
        let image = &plus[&Site { i: -i, j: -j, k }];
        let numbers = |bounds: &[NormalBound; 2]| {
            bounds
                .each_ref()
                .map(|bound| (bound.normal.clone(), bound.attained))
        };
        assert_eq!(numbers(&bounds), numbers(image), "({i},{j})");
    }
}

#[test]
fn long_edges_attain_their_bound() {
    let layers = 33;
    let (pile, k) = (Pile::triangular(layers).unwrap(), layers - 1);
    // Sites on each of the three edges, with both orders of their coordinates.
    for [i, j] in [[1, 0], [0, 11], [k - 16, 16], [21, k - 21]] {
        let site = Site { i, j, k };
        let bounds = bounds(&pile, site).unwrap();
        is_proved(&bounds.greatest);
        assert!(bounds.greatest.attained, "{site}");
        assert_eq!(bounds.greatest.normal, formula(k, site), "{site}");
    }
}

#[test]
fn very_high_piles_match_formulas() {
    let layers = 10_i128.pow(30);
    let (pile, k) = (Pile::triangular(layers).unwrap(), layers - 1);
    for [i, j] in [[0, 0], [0, 1], [1, 1], [k / 2, k / 3], [k, 0]] {
        let site = Site { i, j, k };
        let bounds = bounds(&pile, site).unwrap();
        let is_corner = [0, k].contains(&i) && j == 0;
        assert!(bounds.least.attained);
        assert_eq!(bounds.greatest.attained, is_corner);
        assert_eq!(bounds.greatest.normal, formula(k, site));
    }
}

/// Inside the base of a high pile, the field with the best cuts proves a smaller bound than the formula. Above 83 layers
/// only the formula is left.
#[test]
fn high_piles_have_certified_bounds() {
    for [a, i, j] in [[15, 10, 7], [40, 30, 12], [40, 30, 13]] {
        let k = a + i + j;
        let pile = Pile::triangular(k + 1).unwrap();
        let site = Site { i, j, k };
        let greatest = bounds(&pile, site).unwrap().greatest;
        is_proved(&greatest);
        assert!(!greatest.attained, "{site}");
        assert_eq!(greatest.certificate.is_some(), k < 83, "{site}");
        if k < 83 {
            assert!(greatest.normal < formula(k, site), "{site}");
        } else {
            assert_eq!(greatest.normal, formula(k, site));
        }
    }
}

/// The field proves 1 + 170/3, which no forces attain. The program gives 1 + 169½/3.
#[test]
fn bound_that_is_not_attained_is_left_to_the_program() {
    let site = Site { i: 7, j: 2, k: 16 };
    let greatest = bounds(&Pile::triangular(17).unwrap(), site)
        .unwrap()
        .greatest;
    is_proved(&greatest);
    assert!(greatest.attained);
    assert_eq!(greatest.normal, ratio(115, 2));
}

#[test]
fn requested_interrupts_end_bounds_inside() {
    for layers in [16, 40] {
        let pile = Pile::triangular(layers).unwrap();
        let site = Site {
            i: 5,
            j: 4,
            k: layers - 1,
        };
        let interrupt = Interrupt::new();
        interrupt.request();
        let ended = interrupt.during(|| bounds(&pile, site));
        assert_eq!(ended, Err(Error::Core(Core::Interrupted)), "{layers}");
    }
}

/// Checks that a field of zeros and ones, by direction, proves the upper bound for n.
fn proves(layers: i128, n: [i128; 3], field: impl Fn([i128; 3]) -> [bool; 3]) {
    let pile = Pile::triangular(layers).unwrap();
    let ones = |on: [bool; 3]| on.map(|on| BigRational::from_integer(i32::from(on).into()));
    let free = pile.shape().sites().filter(|site| site.k < layers - 1);
    let field = free.map(|site| {
        let Site { i, j, k } = site;
        (site, ones(field([k - i - j, i, j])))
    });
    let site = Site {
        i: n[1],
        j: n[2],
        k: layers - 1,
    };
    let normal = formula(layers - 1, site);
    let certificate = Certificate {
        claim: Claim::Greatest(Extreme {
            site,
            normal,
            attained: false,
        }),
        pile: pile.clone(),
        horizontal: BTreeMap::new(),
        field: field.collect(),
    };
    assert_eq!(certificate.check(), Ok(()), "{n:?}");
}

#[test]
fn fields_of_paper_page_prove_upper_bounds() {
    for layers in 3..=10 {
        let pile = Pile::triangular(layers).unwrap();
        for Site { i, j, k } in bottom(&pile) {
            let star = [k - i - j, i, j];
            if star.iter().all(|n| *n > 0) {
                proves(layers, star, |n| {
                    let beyond = |l: usize| (0..3).all(|m| m == l || n[m] >= star[m]);
                    [beyond(0), beyond(1), beyond(2)]
                });
            }
        }
        for j in 1..=(layers - 1) / 2 {
            let k = layers - 1 - j;
            let c = (j + 1).min(k);
            proves(layers, [k, j, 0], |[a, b, gamma]| {
                let on_face = gamma == 0;
                let s0 = on_face && (b == j && a < k || b > j && a + b < j + c);
                let s1 = on_face && a >= c && b <= j;
                [s0, s1, s0 && a >= 1 || s1 && b >= 1]
            });
        }
    }
}

#[test]
fn elastic_forces_lie_between_bounds() {
    let mut proved = 0;
    for stacking in stackings(5) {
        let pile = Pile::under(Region::SITE, stacking.parse().unwrap()).unwrap();
        let states = [(1, 1), (1, 7), (30, 1)].map(|(n, d)| elastic(&pile, &ratio(n, d)));
        if states.iter().any(Result::is_err) {
            let site = bottom(&pile).next().unwrap();
            assert_eq!(bounds(&pile, site), Err(Error::CannotStand), "{stacking}");
            continue;
        }
        let found = all(&pile);
        for (site, [least, greatest]) in &found {
            is_proved(least);
            is_proved(greatest);
            proved += usize::from(least.attained && greatest.attained);
            for state in states.iter().flatten() {
                let forces = state.pile().forces::<BigRational>();
                let normal = forces.on_floor(*site).unwrap().normal;
                assert!(
                    least.normal <= normal && normal <= greatest.normal,
                    "{stacking} {site}"
                );
            }
        }
        // Images of a sphere have the same bounds.
        for site in bottom(&pile).step_by(3) {
            let alone = bounds(&pile, site).unwrap();
            let [least, greatest] = &found[&site];
            assert_eq!(
                [&alone.least.normal, &alone.greatest.normal],
                [&least.normal, &greatest.normal]
            );
        }
    }
    assert!(proved > 300, "{proved}");
}

#[test]
fn loads_tops_and_bases() {
    let hexagon = Region::hexagon(2, 3).unwrap();
    let base = Region::hexagon(4, 4).unwrap();
    let piles = [
        Pile::under(hexagon, "+-+".parse().unwrap()).unwrap(),
        Pile::on(base, "-++".parse().unwrap()).unwrap(),
        Pile::discs(6).unwrap(),
        Pile::triangular(5)
            .unwrap()
            .with_load(Site { i: 1, j: 0, k: 2 }, ratio(70, 3))
            .unwrap(),
        Pile::triangular(4)
            .unwrap()
            .with_weight(Site::APEX, ratio(0, 1))
            .unwrap(),
    ];
    for pile in piles {
        let bounds = all(&pile);
        let sum = |end: usize| {
            bounds
                .values()
                .map(|bounds| bounds[end].normal.clone())
                .sum::<BigRational>()
        };
        assert!(sum(0) < pile.weight() && pile.weight() < sum(1));
        for bound in bounds.values().flatten() {
            is_proved(bound);
            assert!(bound.attained);
        }
    }
    // A sphere of a single layer carries its own weight.
    for pile in [
        Pile::discs(1).unwrap(),
        Pile::under(hexagon, Stacking::single_layer()).unwrap(),
    ] {
        for bound in all(&pile).into_values().flatten() {
            is_proved(&bound);
            assert_eq!((bound.normal, bound.attained), (ratio(1, 1), true));
        }
        assert_eq!(elastic(&pile, &ratio(1, 1)).unwrap().pile(), &pile);
    }
    let one = bounds(&Pile::triangular(1).unwrap(), Site::APEX).unwrap();
    assert_eq!(
        [one.least.normal, one.greatest.normal],
        [ratio(1, 1), ratio(1, 1)]
    );
}

#[test]
fn invalid_requests_are_errors() {
    let site = Site { i: 0, j: 0, k: 3 };
    let leaning = Pile::isosceles(4, ratio(1, 3)).unwrap();
    assert!(matches!(
        bounds(&leaning, site),
        Err(Error::Core(Core::NoHorizontalContacts { sin_phi, .. })) if sin_phi == ratio(1, 3)
    ));
    let pile = Pile::triangular(4).unwrap();
    assert_eq!(
        bounds(&pile, Site::APEX),
        Err(Core::NotOnFloor {
            site: Site::APEX,
            floor: 3
        }
        .into())
    );
    assert!(matches!(
        bounds(&pile, Site { i: 4, ..site }),
        Err(Error::Core(Core::SiteOutside { .. }))
    ));
    assert_eq!(
        bounds(&pile.clone().weightless(), site),
        Err(Error::Weightless)
    );
    let high = Pile::under(
        Region::SITE,
        format!("+-{}", "+".repeat(60)).parse().unwrap(),
    )
    .unwrap();
    let site = bottom(&high).next().unwrap();
    assert!(matches!(
        bounds(&high, site),
        Err(Error::Core(Core::TooLarge { .. }))
    ));
    assert!(BigRational::zero() < high.weight());
}

/// The first of up to six images has a certificate, the others have none.
#[test]
fn images_have_no_certificates() {
    for stacking in ["+++", "+-+"] {
        let pile = Pile::under(Region::SITE, stacking.parse().unwrap()).unwrap();
        let shift = pile.shape().stacking().runs().count();
        let o = if shift == 1 { 3 } else { 1 };
        let mut met = std::collections::BTreeSet::new();
        for (site, [least, greatest]) in all(&pile) {
            let mut orbit = [o - site.i - site.j, site.i, site.j];
            orbit.sort_unstable();
            let is_first = met.insert(orbit);
            for bound in [least, greatest] {
                assert_eq!(bound.certificate.is_some(), is_first, "{stacking}: {site}");
            }
        }
    }
    // Without symmetry every sphere has its own certificate.
    let pile = Pile::under(Region::hexagon(2, 1).unwrap(), "++".parse().unwrap()).unwrap();
    for (site, bounds) in all(&pile) {
        let certified = bounds.iter().all(|bound| bound.certificate.is_some());
        assert!(certified, "{site}");
    }
}

#[test]
fn size_hint_counts_remaining_items() {
    let pile = Pile::triangular(4).unwrap();
    let mut bounds = base_bounds(&pile, Selection::Base).unwrap();
    for left in (0..=10).rev() {
        let (least, most) = bounds.size_hint();
        assert!(
            least <= left && most.is_none_or(|most| left <= most),
            "{left}"
        );
        // Within a row of four the number of remaining items is exact.
        assert!(left != 9 || least >= 3, "{least}");
        assert_eq!(bounds.next().is_some(), left > 0);
    }
}
