//! The tilts that a pile bears, against all its contacts.

use cannonpile::lattice::{Region, Site};
use cannonpile::shape::Selection;
use cannonpile::{Load, Pile, ratio};
use cannonpile_stability::{Affine, Error, Tilts, force_by_tilt, margin, tilts};
use cannonpile_testkit::cases::all_signs;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

fn under(top: Region, stacking: &str) -> Pile {
    Pile::under(top, stacking.parse().unwrap()).unwrap()
}

/// Checks the polygon with the force of every contact: no force is negative at a corner, and every side is the line on
/// which some force is zero. So the polygon is the set of all tilts without a negative force. The margin is the least
/// distance of these lines.
fn check(pile: &Pile) {
    let Tilts {
        margin: whole,
        corners,
        ..
    } = tilts(pile).unwrap();
    let floor = pile.layers() - 1;
    let sites = pile.sites(Selection::All).unwrap();
    let contacts = sites.filter(|site| site.k < floor);
    let contacts = contacts.flat_map(|site| {
        let directions = pile.dimension().directions();
        directions.iter().map(move |direction| (site, *direction))
    });
    let forces: Vec<(_, Affine)> = contacts
        .map(|contact| (contact, force_by_tilt(pile, contact.0, contact.1).unwrap()))
        .collect();
    for corner in &corners {
        assert!(
            forces
                .iter()
                .all(|(_, force)| !force.at(corner).is_negative()),
            "{pile}"
        );
    }
    let next = corners.iter().cycle().skip(1);
    for (here, next) in corners.iter().zip(next) {
        let is_side = |force: &Affine| {
            let varies = !(force.a.is_zero() && force.b.is_zero());
            varies && force.at(here).is_zero() && force.at(next).is_zero()
        };
        let discs = pile.sin_phi().is_zero();
        let mut sides = forces.iter().map(|(_, force)| force);
        if discs {
            assert!(sides.any(|force| force.at(here).is_zero() && !force.a.is_zero()));
        } else {
            assert!(sides.any(is_side), "{pile} {here:?} {next:?}");
        }
    }
    let s = pile.sin_phi();
    let across = (ratio!(1) - s * s) * ratio!(4);
    let distances = forces.iter().filter_map(|(_, Affine { c, a, b })| {
        let square = a * a + b * b / &across;
        (!square.is_zero()).then(|| c * c / square)
    });
    let stands = forces.iter().all(|(_, force)| !force.c.is_negative());
    let least = distances.min().filter(|_| stands);
    for margin in [whole, margin(pile).unwrap()] {
        assert_eq!(
            margin.as_ref().map(|margin| &margin.squared),
            least.as_ref(),
            "{pile}"
        );
        let Some(margin) = margin else { continue };
        let (_, opens) = forces
            .iter()
            .find(|(contact, _)| *contact == margin.opens)
            .unwrap();
        assert!(opens.at(&margin.tilt).is_zero());
        let [x, y] = &margin.tilt;
        assert_eq!(x * x + y * y * &across, margin.squared);
    }
}

#[test]
fn polygons_of_all_stackings() {
    for steps in 1..=5 {
        for signs in all_signs(steps) {
            check(&under(Region::SITE, &signs));
        }
    }
    for signs in all_signs(3) {
        check(&under(Region::hexagon(2, 3).unwrap(), &signs));
    }
    for signs in all_signs(2) {
        let base = Region::hexagon(5, 4).unwrap();
        check(&Pile::on(base, signs.parse().unwrap()).unwrap());
    }
}

#[test]
fn polygons_of_other_piles() {
    check(&Pile::discs(5).unwrap());
    check(&Pile::isosceles(5, ratio!(1 / 3)).unwrap());
    check(&Pile::isosceles(5, ratio!(3 / 4)).unwrap());
    let pile = under(Region::SITE, "+-++");
    let site = Site::new(1, 0, 2);
    let load = Load {
        down: ratio!(2),
        x: ratio!(1 / 5),
        y: ratio!(-1 / 10),
    };
    check(&pile.clone().with_load(site, load).unwrap());
    check(&pile.clone().with_weight(site, ratio!(7)).unwrap());
    check(&pile.clone().with_weight(Site::APEX, ratio!(0)).unwrap());
    // A load so great that the pile bears a tilt of 10¹².
    let heavy = under(Region::SITE, "+").with_load(Site::APEX, ratio!(1_000_000_000_000));
    check(&heavy.unwrap());
}

/// A pile with more contacts than `margin` examines has the margin of its polygon.
#[test]
fn margins_of_small_and_large_piles() {
    let straight = |layers| Pile::isosceles(layers, ratio!(2 / 5)).unwrap();
    let [small, large] = [5, 40].map(|layers| margin(&straight(layers)).unwrap().unwrap());
    assert!(straight(40).contact_count() > 20_000_u32.into());
    assert_eq!(small.squared, large.squared);
    // All three contacts of the apex open at this distance, and all contacts that carry one sphere.
    let nine = Pile::triangular(9).unwrap();
    let opens = margin(&nine).unwrap().unwrap().opens;
    assert_eq!(opens, (Site::APEX, cannonpile::lattice::Direction::Alpha));
}

/// The values of t_c² of some stackings, the same for every number of layers.
#[test]
fn known_margins() {
    for layers in 6..=12_usize {
        for (begin, known) in [
            ("+", ratio!(1 / 4)),
            ("+-", ratio!(1 / 16)),
            ("+-+", ratio!(1 / 43)),
            ("++-+", ratio!(1 / 208)),
            ("+++-+", ratio!(0)),
        ] {
            // The last sign continues.
            let last = begin.chars().last().unwrap();
            let last = if begin == "+-" { '-' } else { last };
            let signs: String = begin
                .chars()
                .chain(core::iter::repeat(last))
                .take(layers - 1)
                .collect();
            let signs = match begin {
                "++-+" if layers == 6 => "++-++".to_owned(),
                _ => signs,
            };
            let pile = under(Region::SITE, &signs);
            let whole = tilts(&pile).unwrap().margin.unwrap();
            assert_eq!(whole.squared, known, "{signs}");
            assert_eq!(margin(&pile).unwrap().unwrap().squared, known, "{signs}");
        }
    }
}

/// A straight pile bears what one sphere bears: the triangle with the corners (1, 0) and (−1/2, ±1/2).
#[test]
fn straight_piles_bear_the_same_tilts() {
    let corners = [
        [ratio!(1), ratio!(0)],
        [ratio!(-1 / 2), ratio!(1 / 2)],
        [ratio!(-1 / 2), ratio!(-1 / 2)],
    ];
    for top in [
        Region::SITE,
        Region::hexagon(3, 2).unwrap(),
        Region::new(-3..=3, -4..=4, -2..=5).unwrap(),
    ] {
        for layers in [2, 3, 12] {
            let pile = under(top, &"+".repeat(layers - 1));
            let tilts = tilts(&pile).unwrap();
            assert_eq!(tilts.margin.unwrap().squared, ratio!(1 / 4));
            assert_eq!(tilts.corners.len(), 3);
            assert!(corners.iter().all(|corner| tilts.corners.contains(corner)));
        }
    }
    let high = Pile::triangular(10_i128.pow(36)).unwrap();
    assert_eq!(tilts(&high).unwrap().corners.len(), 3);
}

#[test]
fn isosceles_piles_open_along_x_or_along_y() {
    for (s, margin) in [
        (ratio!(1 / 3), ratio!(1 / 9)),
        (ratio!(1 / 2), ratio!(1 / 4)),
        (ratio!(2 / 3), ratio!(1 / 6)),
    ] {
        let pile = Pile::isosceles(7, s).unwrap();
        assert_eq!(tilts(&pile).unwrap().margin.unwrap().squared, margin);
    }
    let discs = tilts(&Pile::discs(7).unwrap()).unwrap();
    assert_eq!(discs.margin.unwrap().squared, ratio!(1));
    let ends = [-1, 1].map(|end| [BigRational::from_integer(end.into()), ratio!(0)]);
    assert_eq!(discs.corners, ends);
}

#[test]
fn a_pile_that_leans_already_has_the_rest_of_its_polygon() {
    let pile = under(Region::SITE, "+-+");
    let tilt = [ratio!(1 / 50), ratio!(-1 / 40)];
    let leaning = pile.clone().with_tilt(tilt.clone()).unwrap();
    let shifted = |corner: [BigRational; 2]| [0, 1].map(|axis| &corner[axis] - &tilt[axis]);
    let corners = tilts(&pile).unwrap().corners;
    let corners: Vec<_> = corners.into_iter().map(shifted).collect();
    let rest = tilts(&leaning).unwrap().corners;
    assert_eq!(rest.len(), corners.len());
    assert!(rest.iter().all(|corner| corners.contains(corner)));
}

#[test]
fn unstable_and_weightless_piles_have_no_margin() {
    let hcp = under(Region::SITE, "+-+-+");
    assert_eq!(tilts(&hcp).unwrap().margin, None);
    let weightless = under(Region::SITE, "+-").weightless();
    assert_eq!(tilts(&weightless).unwrap_err(), Error::NoWeight);
    let one_layer = under(Region::hexagon(3, 3).unwrap(), "A");
    assert_eq!(tilts(&one_layer).unwrap_err(), Error::NoWeight);
}

/// The weights of bottom spheres do not matter.
#[test]
fn only_weights_above_the_floor_count() {
    let weightless = |k, i| {
        let pile = under(Region::SITE, "+");
        pile.with_weight(Site { i, j: 0, k }, ratio!(0)).unwrap()
    };
    assert_eq!(margin(&weightless(0, 0)).unwrap_err(), Error::NoWeight);
    let margin = margin(&weightless(1, 1)).unwrap().unwrap();
    assert_eq!(margin.squared, ratio!(1 / 4));
}
