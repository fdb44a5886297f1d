//! Six-sided regions as the sets of sites that they are: bounds, corners, rows, dilation, erosion, mirror images.

use cannonpile::lattice::{Region, Sign};

use cannonpile_testkit::cases::{Bounds, Random};
use cannonpile_testkit::oracles::balance::{Balance, Sites};

/// The sites of a region, from its rows.
fn sites(region: &Region) -> Sites {
    let rows = region.rows(0).flatten();
    rows.map(|site| (site.j, site.i)).collect()
}

fn random_regions(seed: u64) -> impl Iterator<Item = (Bounds, Region)> {
    let mut random = Random(seed);
    (0..300).map(move |_| {
        let bounds = random.bounds(6);
        (bounds, bounds.region())
    })
}

const SIGNS: [(Sign, &str); 2] = [(Sign::Plus, "+"), (Sign::Minus, "-")];

#[test]
fn any_region_is_its_sites_and_its_bounds_are_tight() {
    for (bounds, region) in random_regions(10) {
        let expected = bounds.sites();
        assert_eq!(sites(&region), expected, "{bounds:?}");
        assert_eq!(region.site_count(), expected.len().into());
        let range = |pick: fn(&(i128, i128)) -> i128| {
            let values = || expected.iter().map(pick);
            values().min().unwrap()..=values().max().unwrap()
        };
        assert_eq!(region.x(), range(|site| site.1));
        assert_eq!(region.y(), range(|site| site.0));
        assert_eq!(region.s(), range(|site| site.0 + site.1));
        for (j, i) in (-9..=14).flat_map(|j| (-9..=14).map(move |i| (j, i))) {
            assert_eq!(region.contains(i, j), expected.contains(&(j, i)));
        }
    }
}

#[test]
fn regions_without_a_site_are_refused() {
    let mut random = Random(15);
    let mut empty = 0;
    for _ in 0..2000 {
        let mut bound = || random.up_to(8) - 4;
        let bounds = Bounds {
            x: (bound(), bound()),
            y: (bound(), bound()),
            s: (bound(), bound()),
        };
        let Bounds { x, y, s } = bounds;
        let region = Region::new(x.0..=x.1, y.0..=y.1, s.0..=s.1);
        assert_eq!(region.is_err(), bounds.sites().is_empty(), "{bounds:?}");
        empty += u32::from(region.is_err());
    }
    assert!((500..1900).contains(&empty), "{empty}");
}

#[test]
fn corners_are_the_sites_where_two_bounds_meet() {
    for (bounds, region) in random_regions(16) {
        let all = bounds.sites();
        let corners = region.corners();
        for [i, j] in corners {
            assert!(all.contains(&(j, i)), "{bounds:?} {i} {j}");
            let on_bounds = [
                i == *region.x().start(),
                i == *region.x().end(),
                j == *region.y().start(),
                j == *region.y().end(),
                i + j == *region.s().start(),
                i + j == *region.s().end(),
            ];
            assert!(on_bounds.iter().filter(|on| **on).count() >= 2);
        }
        // In turn: from one to the next along a side.
        for n in 0..6 {
            let ([i0, j0], [i1, j1]) = (corners[n], corners[(n + 1) % 6]);
            assert!(i0 == i1 || j0 == j1 || i0 + j0 == i1 + j1, "{bounds:?}");
        }
    }
}

#[test]
fn dilation_is_all_supports_and_erosion_all_that_is_supported() {
    for (bounds, region) in random_regions(17) {
        for (sign, signs) in SIGNS {
            let all = bounds.sites();
            let below = region.dilated(sign).unwrap();
            let balance = Balance::under(&all, signs);
            assert_eq!(sites(&below), balance.layers[1], "{bounds:?}");
            assert_eq!(below.eroded(sign), Some(region));
            let above = Balance::on(&all, signs).map(|balance| balance.layers[0].clone());
            assert_eq!(region.eroded(sign).map(|above| sites(&above)), above);
            let five = Balance::under(&all, &signs.repeat(5));
            let far_below = region.dilated_by(sign, 5).unwrap();
            assert_eq!(Some(&sites(&far_below)), five.layers.last());
        }
    }
}

#[test]
fn spheres_above_are_counted_along_each_line() {
    for (bounds, region) in random_regions(18).take(60) {
        for (sign, signs) in SIGNS {
            let Some(balance) = (0..=4)
                .rev()
                .find_map(|n| Balance::on(&bounds.sites(), &signs.repeat(n)))
            else {
                continue;
            };
            let bottom = i128::try_from(balance.signs.len()).unwrap();
            for (j, i) in bounds.sites() {
                let counted = [0, 1, 2].map(|m| {
                    let mut at = (bottom, j, i);
                    let mut count = 0;
                    while let Some(above) = balance.above(at, m) {
                        (at, count) = (above, count + 1);
                    }
                    count
                });
                assert_eq!(region.spheres_above(i, j, sign, bottom), counted);
            }
        }
    }
}

#[test]
fn the_mirror_image_of_a_region_has_the_mirror_images_of_its_sites() {
    for (bounds, region) in random_regions(19) {
        let mirrored: Sites = bounds.sites().iter().map(|(j, i)| (-j, -i)).collect();
        assert_eq!(sites(&region.mirrored()), mirrored);
        assert_eq!(region.mirrored().mirrored(), region);
    }
}
