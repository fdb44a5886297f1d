//! Regions compared with sets of sites: bounds are tight and complete, and rows are in order.

use cannonpile::lattice::{Region, Row};

use crate::lattice::{each_bounds, random_bounds, region};
use cannonpile_testkit::oracles::sets::{Sites, within};

/// A bound that lies outside every tested region.
const REACH: i128 = 8;

/// The region has exactly these sites, and all its accessors agree with them.
fn agrees(region: &Region, sites: &Sites) {
    let every = (-REACH..=REACH).flat_map(|j| (-REACH..=REACH).map(move |i| (j, i)));
    for (j, i) in every {
        assert_eq!(region.contains(i, j), sites.contains(&(j, i)), "({i}, {j})");
    }
    assert_eq!(region.site_count(), sites.len().into());
    is_tight(region, sites);
    rows_are_in_order(region, sites);
    corners_are_attained(region, sites);
    let [x, y, s] = [region.x(), region.y(), region.s()];
    let shown = format!(
        "{}..{},{}..{},{}..{}",
        x.start(),
        x.end(),
        y.start(),
        y.end(),
        s.start(),
        s.end()
    );
    assert_eq!(region.to_string(), shown);
    mirror_images(region, sites);
}

/// The value i, j or i+j of a site (j, i).
type Coordinate = fn(&(i128, i128)) -> i128;

/// Each bound is the extreme value of its coordinate.
fn is_tight(region: &Region, sites: &Sites) {
    let along: [Coordinate; 3] = [|(_, i)| *i, |(j, _)| *j, |(j, i)| i + j];
    let bounds = [region.x(), region.y(), region.s()];
    for (coordinate, bound) in along.into_iter().zip(bounds) {
        let least = sites.iter().map(coordinate).min();
        let most = sites.iter().map(coordinate).max();
        assert_eq!(least.zip(most), Some(bound.into_inner()), "{region}");
    }
}

fn rows_are_in_order(region: &Region, sites: &Sites) {
    let rows: Vec<Row> = region.rows(7).collect();
    for row in &rows {
        assert!(row.k == 7 && !row.i.is_empty(), "{region}: {row:?}");
    }
    let walked = rows.into_iter().flatten().map(|site| (site.j, site.i));
    assert!(walked.eq(sites.iter().copied()), "{region}");
}

/// The six corners in order are the extremes of i, j and i+j.
fn corners_are_attained(region: &Region, sites: &Sites) {
    let corners = region.corners();
    for [i, j] in corners {
        assert!(sites.contains(&(j, i)), "{region}: corner ({i}, {j})");
    }
    let [x, y, s] = [region.x(), region.y(), region.s()];
    // The sides y₀, x₁, s₁, y₁, x₀, s₀. Each corner ends one side and begins the next.
    let sides: [(Coordinate, &i128); 6] = [
        (|(j, _)| *j, y.start()),
        (|(_, i)| *i, x.end()),
        (|(j, i)| i + j, s.end()),
        (|(j, _)| *j, y.end()),
        (|(_, i)| *i, x.start()),
        (|(j, i)| i + j, s.start()),
    ];
    for (n, (coordinate, bound)) in sides.into_iter().enumerate() {
        for [i, j] in [corners[n], corners[(n + 1) % 6]] {
            assert_eq!(coordinate(&(j, i)), *bound, "{region}: side {n}");
        }
    }
}

/// Checks the image under (i, j) → (−i, −j), and whether a translation maps it to the region.
fn mirror_images(region: &Region, sites: &Sites) {
    let image: Sites = sites.iter().map(|(j, i)| (-j, -i)).collect();
    let mirrored = region.mirrored();
    assert_eq!(mirrored.mirrored(), *region, "{region}");
    is_tight(&mirrored, &image);
    rows_are_in_order(&mirrored, &image);
    let moved_onto = |(j, i): (i128, i128), to: (i128, i128)| {
        let moved = image
            .iter()
            .map(|site| (site.0 - j + to.0, site.1 - i + to.1));
        moved.collect::<Sites>() == *sites
    };
    // A translation must map the first site in row order to the first.
    let same = image.first().zip(sites.first());
    let same = same.is_some_and(|(from, to)| moved_onto(*from, *to));
    assert_eq!(region.is_its_own_mirror_image(), same, "{region}");
}

/// The region with these bounds has exactly the enclosed sites.
fn is_enclosed(bounds: [i128; 6]) {
    let sites = within(bounds, REACH);
    let made = region(bounds);
    if sites.is_empty() {
        let refusal = made.expect_err("no site is enclosed").to_string();
        let [x0, x1, y0, y1, s0, s1] = bounds;
        let expected = format!("{x0}..{x1},{y0}..{y1},{s0}..{s1} has no site");
        assert!(refusal.contains(&expected), "{refusal}");
    } else {
        agrees(&made.expect("some site is enclosed"), &sites);
    }
}

#[test]
fn all_small_bounds() {
    each_bounds(2, is_enclosed);
}

#[test]
fn random_bounds_up_to_six() {
    random_bounds(6, 4_000, is_enclosed);
}

#[test]
fn named_regions() {
    for n in 1..=5 {
        let triangle = Region::triangle(n).expect("a side");
        agrees(&triangle, &within([0, n - 1, 0, n - 1, 0, n - 1], REACH));
        for q in 1..=5 {
            let hexagon = Region::hexagon(n, q).expect("two sides");
            let [low, high] = [1 - q, n - 1];
            agrees(&hexagon, &within([low, high, low, high, low, high], REACH));
        }
    }
    assert_eq!(Region::SITE, Region::triangle(1).expect("a side"));
}

/// The check rejects a region with other sites.
#[test]
#[should_panic(expected = "(0, 2)")]
fn a_site_too_few_is_caught() {
    let mut sites = within([0, 2, 0, 2, 0, 2], REACH);
    sites.insert((2, 0));
    let smaller = region([0, 2, 0, 1, 0, 2]).expect("a trapezium");
    agrees(&smaller, &sites);
}
