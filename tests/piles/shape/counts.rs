//! Sites, neighbours, rows and sums, compared with explicit lists.

use std::collections::BTreeSet;

use cannonpile::lattice::{Dimension, Direction, MAX_LAYERS, Region, Row, Site, count};
use cannonpile::shape::{Anchor, Selection, Shape as Sites};
use cannonpile::{Error, Pile};
use cannonpile_testkit::answers::{Shape, above, below, ratio};
use cannonpile_testkit::cases::stacking;
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;

const SHAPES: [Dimension; 2] = [Dimension::Two, Dimension::Three];

fn shape(dimension: Dimension) -> Shape {
    match dimension {
        Dimension::Two => Shape::Discs,
        Dimension::Three => Shape::equilateral(),
    }
}

/// Every pile up to 15 layers, with its sites.
fn piles() -> impl Iterator<Item = (Shape, Pile, Vec<Site>)> {
    SHAPES.into_iter().flat_map(|dimension| {
        let shape = shape(dimension);
        (1..=15).map(move |layers| (shape.clone(), shape.pile(layers), shape.sites(layers)))
    })
}

#[test]
fn spheres_contacts_and_base() {
    for (shape, pile, sites) in piles() {
        assert_eq!(pile.sphere_count(), sites.len().into());
        let base = sites
            .iter()
            .filter(|site| site.k == pile.layers() - 1)
            .count();
        assert_eq!(pile.base_sphere_count(), base.into());
        let contacts = (sites.len() - base) * shape.directions().len();
        assert_eq!(pile.contact_count(), contacts.into());
    }
}

/// The contacts by the number of spheres above on their line, from a walk up.
#[test]
fn contacts_of_each_strength() {
    for (shape, pile, sites) in piles() {
        for direction in shape.directions() {
            let mut found = vec![0_u32; 20];
            for site in sites.iter().filter(|site| site.k < pile.layers() - 1) {
                let up = |at: &Site| Some(above(*at, *direction)).filter(|at| sites.contains(at));
                let line = std::iter::successors(Some(*site), up).count();
                found[line] += 1;
            }
            for (strength, contacts) in found.into_iter().enumerate() {
                let strength = i128::try_from(strength).unwrap();
                assert_eq!(pile.contact_count_of_strength(strength), contacts.into());
            }
        }
        for outside in [i128::MIN, -1, 0, pile.layers(), i128::MAX] {
            assert_eq!(pile.contact_count_of_strength(outside), BigUint::ZERO);
        }
    }
}

#[test]
fn sites_are_in_order_and_numbered() {
    for (shape, pile, sites) in piles() {
        assert!(sites.is_sorted());
        let listed: Vec<_> = pile.shape().sites().collect();
        assert_eq!(listed, sites);
        for (number, Site { i, j, k }) in sites.into_iter().enumerate() {
            // The layers above, the rows 0 … j−1 with k+1, k, … spheres, and i in the row.
            let above = count::spheres(
                &BigRational::from_integer(k.into()),
                shape.dimension().number(),
            );
            let before = above + BigInt::from((0..j).map(|row| k + 1 - row).sum::<i128>() + i);
            assert_eq!(before, BigRational::from_integer(number.into()));
        }
    }
}

#[test]
fn rows_contain_the_selection() {
    for (_, pile, sites) in piles() {
        let floor = pile.layers() - 1;
        let one = sites.iter().map(|site| Selection::One(*site));
        let layers = (0..=floor).map(Selection::Layer);
        for selection in one.chain(layers).chain([Selection::Base, Selection::All]) {
            let selected = |site: &&Site| match selection {
                Selection::One(one) => **site == one,
                Selection::Layer(k) => site.k == k,
                Selection::Base => site.k == floor,
                Selection::All => true,
            };
            let wanted: Vec<_> = sites.iter().filter(selected).copied().collect();
            let rows = pile.rows(selection).unwrap();
            let walked: Vec<_> = rows.clone().flatten().collect();
            assert_eq!(walked, wanted, "{selection:?}");
            let off: Vec<_> = rows.off_the_floor().flatten().collect();
            let wanted: Vec<_> = wanted.into_iter().filter(|site| site.k < floor).collect();
            assert_eq!(off, wanted, "{selection:?}");
        }
    }
}

/// `site_count` decreases with each row. Each row is complete and has a known length.
#[test]
fn rows_report_the_remaining_sites() {
    for (_, pile, sites) in piles() {
        let layers = (0..pile.layers()).map(Selection::Layer);
        for selection in layers.chain([Selection::Base, Selection::All, Selection::One(sites[0])]) {
            let mut rows = pile.rows(selection).unwrap();
            let mut left = rows.clone().flatten().count();
            assert_eq!(rows.site_count(), left.into(), "{selection:?}");
            while let Some(row) = rows.next() {
                let length = row.clone().into_iter().count();
                assert_eq!(row.into_iter().size_hint(), (length, Some(length)));
                left -= length;
                assert_eq!(rows.site_count(), left.into(), "{selection:?}");
            }
            assert_eq!(left, 0);
        }
    }
}

#[test]
fn corners_belong_to_the_first_and_last_layer() {
    for (shape, pile, sites) in piles() {
        let corners: BTreeSet<_> = pile.rows(Selection::Base).unwrap().corners().collect();
        // All spheres above a corner are on one line.
        let corner = |site: &&Site| {
            let counts = [site.k - site.i - site.j, site.i, site.j];
            site.k == pile.layers() - 1 && counts.contains(&site.k)
        };
        let wanted: BTreeSet<_> = sites.iter().filter(corner).copied().collect();
        assert_eq!(corners, wanted, "{shape:?}");
        let all: BTreeSet<_> = pile.rows(Selection::All).unwrap().corners().collect();
        assert_eq!(all, wanted.into_iter().chain([Site::APEX]).collect());
    }
}

/// Membership and neighbours of every site in the pile and next to it.
#[test]
fn neighbours() {
    for (shape, pile, sites) in piles().filter(|(_, pile, _)| pile.layers() <= 8) {
        let sites: BTreeSet<_> = sites.into_iter().collect();
        let pyramid = pile.shape();
        let near = -2..=pile.layers() + 1;
        for k in near.clone() {
            for j in near.clone() {
                for i in near.clone() {
                    let site = Site { i, j, k };
                    let there = sites.contains(&site);
                    assert_eq!(pyramid.contains(site), there, "{site}");
                    assert_eq!(pyramid.check(site).is_ok(), there, "{site}");
                    for direction in Direction::ALL {
                        // In a pile of discs, γ leaves the plane.
                        let known = |at: Site| Some(at).filter(|at| there && sites.contains(at));
                        let lower = known(below(site, direction));
                        assert_eq!(pyramid.below(site, direction), lower, "{shape:?} {site}");
                        let upper = known(above(site, direction));
                        assert_eq!(pyramid.above(site, direction), upper, "{shape:?} {site}");
                    }
                }
            }
        }
    }
}

/// L = 10³⁶. The values come from L(L+1)(L+2)/6 and similar formulas in another program.
#[test]
fn the_greatest_pile() {
    let number = |digits: &str| digits.parse::<BigUint>().unwrap();
    let pile = Pile::triangular(MAX_LAYERS).unwrap();
    assert_eq!(
        pile.sphere_count(),
        number(concat!(
            "166666666666666666666666666666666667",
            "166666666666666666666666666666666667000000000000000000000000000000000000",
        )),
    );
    assert_eq!(
        pile.contact_count(),
        number(concat!(
            "499999999999999999999999999999999999",
            "999999999999999999999999999999999999500000000000000000000000000000000000",
        )),
    );
    let triangle = "500000000000000000000000000000000000500000000000000000000000000000000000";
    assert_eq!(pile.base_sphere_count(), number(triangle));
    assert_eq!(
        pile.contact_count_of_strength(10_i128.pow(35)),
        number("405000000000000000000000000000000000450000000000000000000000000000000000"),
    );
    assert_eq!(
        pile.rows(Selection::All).unwrap().site_count(),
        pile.sphere_count()
    );

    let discs = Pile::discs(MAX_LAYERS).unwrap();
    assert_eq!(discs.sphere_count(), number(triangle));
    assert_eq!(
        discs.contact_count(),
        number("999999999999999999999999999999999999000000000000000000000000000000000000"),
    );
    assert_eq!(
        discs.base_sphere_count(),
        number("1000000000000000000000000000000000000")
    );
    assert_eq!(
        discs.contact_count_of_strength(10_i128.pow(35)),
        number("900000000000000000000000000000000000"),
    );
}

#[test]
fn layers_have_limits() {
    for dimension in SHAPES {
        for layers in [i128::MIN, -1, 0, MAX_LAYERS + 1, i128::MAX] {
            let given = layers.into();
            assert_eq!(
                Sites::pyramid(layers, dimension),
                Err(Error::Layers { given })
            );
        }
        assert!(Sites::pyramid(1, dimension).is_ok());
        assert!(Sites::pyramid(MAX_LAYERS, dimension).is_ok());
    }
    for layers in [i128::MIN, 0, MAX_LAYERS + 1] {
        assert!(matches!(
            Pile::triangular(layers),
            Err(Error::Layers { .. })
        ));
        assert!(matches!(Pile::discs(layers), Err(Error::Layers { .. })));
        assert!(matches!(
            Pile::isosceles(layers, ratio(1, 3)),
            Err(Error::Layers { .. })
        ));
    }
}

/// No site makes a lookup panic, and no site outside the pile is found.
#[test]
fn sites_at_the_ends_of_the_integers() {
    let ends = [
        i128::MIN,
        i128::MIN + 1,
        -1,
        0,
        1,
        MAX_LAYERS - 1,
        i128::MAX - 1,
        i128::MAX,
    ];
    for dimension in SHAPES {
        for layers in [1, 2, MAX_LAYERS] {
            let pyramid = Sites::pyramid(layers, dimension).unwrap();
            for i in ends {
                for j in ends {
                    for k in ends {
                        let site = Site { i, j, k };
                        let flat = dimension == Dimension::Three || j == 0;
                        let there = flat
                            && (0..layers).contains(&k)
                            && (0..=k).contains(&j)
                            && (0..=k - j).contains(&i);
                        assert_eq!(pyramid.contains(site), there, "{site}");
                        assert_eq!(pyramid.check(site).is_ok(), there, "{site}");
                        let one = pyramid.rows(Selection::One(site));
                        assert_eq!(one.is_ok(), there, "{site}");
                        for direction in Direction::ALL {
                            let lower = pyramid.below(site, direction);
                            let upper = pyramid.above(site, direction);
                            assert!(there || lower.or(upper).is_none(), "{site}");
                        }
                    }
                }
            }
            for k in ends {
                let layer = pyramid.rows(Selection::Layer(k));
                assert_eq!(layer.is_ok(), (0..layers).contains(&k));
            }
        }
    }
}

/// The rows at the far corner of the greatest pile end correctly.
#[test]
fn the_last_rows_of_the_greatest_pile() {
    let k = MAX_LAYERS - 1;
    let pyramid = Sites::pyramid(MAX_LAYERS, Dimension::Three).unwrap();
    let corner = Site { i: 0, j: k, k };
    let rows: Vec<_> = pyramid.rows(Selection::One(corner)).unwrap().collect();
    assert_eq!(rows, [Row { k, j: k, i: 0..1 }]);
    let discs = Sites::pyramid(MAX_LAYERS, Dimension::Two).unwrap();
    let rows: Vec<_> = discs.rows(Selection::Base).unwrap().collect();
    assert_eq!(
        rows,
        [Row {
            k,
            j: 0,
            i: 0..MAX_LAYERS
        }]
    );
}

/// Each corner occurs once, in order, those of the top first. A single sphere is its own corner.
#[test]
fn each_corner_occurs_once_in_order() {
    let pile = Pile::triangular(4).unwrap();
    let site = |(i, j, k)| Site { i, j, k };
    let corners = |part| -> Vec<Site> { pile.rows(part).unwrap().corners().collect() };
    let base = [(0, 0, 3), (3, 0, 3), (0, 3, 3)].map(site);
    assert_eq!(corners(Selection::All), [&[Site::APEX], &base[..]].concat());
    assert_eq!(corners(Selection::Base), [base, base].concat());
    let one = site((1, 0, 2));
    assert_eq!(corners(Selection::One(one)), [one]);
    let none = pile.rows(Selection::Base).unwrap().off_the_floor();
    assert_eq!(none.corners().count(), 0);
}

/// Bases away from (0, 0). Their sides vanish one after another on the way up.
#[test]
fn counts_on_any_base_equal_their_sites() {
    let mut high = 0;
    for [x0, x1, y0, y1, s0, s1] in [
        [3, 20, 5, 18, 12, 33],
        [-9, 14, 4, 11, -3, 20],
        [2, 13, -17, 3, -12, 9],
        [-20, -4, -15, -3, -30, -9],
        [7, 15, 7, 15, 14, 23],
    ] {
        let base = Region::new(x0..=x1, y0..=y1, s0..=s1).unwrap();
        for pattern in ["+", "-", "+++++-----", "--+++++++"] {
            for layers in 1.. {
                let signs = pattern.chars().cycle().take(layers - 1);
                let signs: String = signs.collect();
                let Ok(shape) = Sites::on(base, stacking(&signs)) else {
                    break;
                };
                let sites = shape.sites().count();
                assert_eq!(shape.sphere_count(), sites.into(), "{base} {signs}");
                high = high.max(layers);
            }
        }
    }
    assert!(high > 8, "{high}");
}

#[test]
fn an_anchor_prints_as_its_option() {
    assert_eq!(Anchor::Top(Region::SITE).name(), "top");
    assert_eq!(Anchor::Base(Region::SITE).name(), "base");
}

#[test]
fn a_dimension_prints_as_its_number() {
    assert_eq!(SHAPES.map(|dimension| dimension.to_string()), ["2", "3"]);
}
