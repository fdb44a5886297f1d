//! Piles of mixed stackings compared with sets of sites, layer by layer: sites, rows and counts.

use cannonpile::Error;
use cannonpile::lattice::{Direction, Region, Row, Sign, Site};
use cannonpile::shape::{Rows, Selection, Shape};
use cannonpile::stacking::Stacking;
use num_bigint::BigUint;

use crate::lattice::{each_bounds, each_signs, random_bounds, region, sites_of};
use cannonpile_testkit::oracles::sets::{Sites, on, supports, under};

/// The sites of the layers from one number on, in order.
fn in_order(layers: &[Sites], from: usize) -> Vec<Site> {
    let numbered = layers.iter().zip(0..).skip(from);
    numbered
        .flat_map(|(layer, k)| layer.iter().map(move |(j, i)| Site { i: *i, j: *j, k }))
        .collect()
}

/// Rows are in order and nonempty. The count is correct before each row and at the end.
fn has_rows(mut rows: Rows<'_>, want: &[Site]) {
    let mut left = want;
    loop {
        assert_eq!(rows.site_count(), BigUint::from(left.len()));
        let Some(row) = rows.next() else { break };
        let sites: Vec<Site> = row.clone().into_iter().collect();
        assert!(!sites.is_empty() && left.starts_with(&sites), "{row:?}");
        left = &left[sites.len()..];
    }
    assert!(left.is_empty() && rows.next().is_none(), "{left:?}");
}

/// The shape has exactly these layers.
fn has_layers(shape: &Shape, layers: &[Sites], signs: &[Sign]) {
    let count = i128::try_from(layers.len()).expect("few");
    assert_eq!(shape.layers(), count);
    let all = in_order(layers, 0);
    assert_eq!(shape.sphere_count(), all.len().into(), "{shape:?}");
    assert!(shape.sites().eq(all.iter().copied()), "{shape:?}");
    has_rows(shape.rows(Selection::All).expect("all"), &all);
    let off_the_floor = shape.rows(Selection::All).expect("all").off_the_floor();
    has_rows(off_the_floor, &in_order(&layers[..layers.len() - 1], 0));
    let base = in_order(layers, layers.len() - 1);
    has_rows(shape.rows(Selection::Base).expect("the base"), &base);
    assert_eq!(sites_of(&shape.base()), layers[layers.len() - 1]);
    for (k, layer) in (0..).zip(layers) {
        let here = in_order(&layers[..=usize::try_from(k).expect("few")], 0);
        let here = &here[here.len() - layer.len()..];
        has_rows(shape.rows(Selection::Layer(k)).expect("a layer"), here);
        assert_eq!(sites_of(&shape.layer(k).expect("a layer")), *layer);
    }
    for k in [-1, count, i128::MIN, i128::MAX] {
        let refused = Error::LayerOutside {
            layer: k,
            layers: count,
        };
        assert_eq!(shape.layer(k), Err(refused.clone()));
        assert_eq!(shape.rows(Selection::Layer(k)).err(), Some(refused));
        assert_eq!(shape.sign_below(k), None);
    }
    for (k, sign) in (0..).zip(signs) {
        assert_eq!(shape.sign_below(k), Some(*sign));
    }
}

/// Every sphere has its number, its supports and its spheres above. All other sites are rejected.
fn every_site_is_correct(shape: &Shape, layers: &[Sites], signs: &[Sign]) {
    for (number, site) in in_order(layers, 0).into_iter().enumerate() {
        assert_eq!(shape.before(site), Ok(number.into()), "{site} {shape:?}");
        has_rows(shape.rows(Selection::One(site)).expect("a sphere"), &[site]);
        let k = usize::try_from(site.k).expect("few");
        for direction in Direction::ALL {
            let m = direction.index();
            let below = signs
                .get(k)
                .map(|sign| supports((site.j, site.i), *sign)[m]);
            let below = below.map(|(j, i)| Site {
                i,
                j,
                k: site.k + 1,
            });
            assert_eq!(
                shape.below(site, direction),
                below,
                "{site} {direction} {shape:?}"
            );
            let above = k.checked_sub(1).and_then(|k| {
                let is_supported =
                    |from: &&(i128, i128)| supports(**from, signs[k])[m] == (site.j, site.i);
                layers[k].iter().find(is_supported)
            });
            let above = above.map(|(j, i)| Site {
                i: *i,
                j: *j,
                k: site.k - 1,
            });
            assert_eq!(
                shape.above(site, direction),
                above,
                "{site} {direction} {shape:?}"
            );
        }
    }
    for (k, layer) in (0..).zip(layers) {
        let nearby = layer
            .iter()
            .flat_map(|(j, i)| [(j - 1, *i), (*j, i - 1), (j + 1, *i), (*j, i + 1)]);
        for (j, i) in nearby.filter(|site| !layer.contains(site)) {
            let site = Site { i, j, k };
            let refused = [shape.check(site).err(), shape.before(site).err()];
            for refusal in refused {
                assert!(
                    matches!(refusal, Some(Error::SiteOutside { .. })),
                    "{site} {shape:?}"
                );
            }
        }
    }
}

fn stacking(signs: &[Sign]) -> Stacking {
    Stacking::from_signs(signs.iter().copied()).expect("short")
}

/// Grows piles down and up with all stackings of `steps` steps. Upwards, only those that fit.
fn both_ways(bounds: [i128; 6], steps: usize) {
    let Ok(region) = region(bounds) else {
        return;
    };
    for signs in each_signs(steps) {
        let layers = under(sites_of(&region), &signs);
        let shape = Shape::under(region, stacking(&signs)).expect("small");
        assert!(!shape.is_grown_from_base());
        has_layers(&shape, &layers, &signs);
        every_site_is_correct(&shape, &layers, &signs);
        let layers = on(sites_of(&region), &signs);
        if let Ok(shape) = Shape::on(region, stacking(&signs)) {
            assert!(shape.is_grown_from_base());
            has_layers(&shape, &layers, &signs);
            every_site_is_correct(&shape, &layers, &signs);
        }
    }
}

#[test]
fn of_all_small_regions() {
    each_bounds(1, |bounds| both_ways(bounds, 2));
}

#[test]
fn of_random_regions() {
    random_bounds(4, 24, |bounds| both_ways(bounds, 4));
}

#[test]
fn of_the_apex() {
    for steps in 0..=5 {
        both_ways([0; 6], steps);
    }
}

#[test]
fn a_cloned_iterator_continues_at_the_same_row() {
    let shape = Shape::under(Region::SITE, stacking(&[Sign::Plus, Sign::Minus])).expect("small");
    let mut rows = shape.rows(Selection::All).expect("all");
    assert_eq!(
        rows.by_ref()
            .take(3)
            .map(|row| row.i.end - row.i.start)
            .sum::<i128>(),
        4
    );
    let copy = rows.clone();
    assert_eq!(
        rows.next(),
        Some(Row {
            k: 2,
            j: -1,
            i: 0..2
        })
    );
    assert_eq!(
        (rows.site_count(), copy.site_count()),
        (5_u32.into(), 7_u32.into())
    );
    has_rows(copy.off_the_floor(), &[]);
}
