//! Dilation and erosion compared with their definitions, and the numbers of spheres above with a walk up each line.

use cannonpile::lattice::{Region, Sign};

use crate::lattice::{each_bounds, random_bounds, region, sites_of};
use cannonpile_testkit::oracles::sets::{Sites, dilated, eroded, on, supports, under};

const SIGNS: [Sign; 2] = [Sign::Plus, Sign::Minus];

fn grows_and_shrinks(bounds: [i128; 6]) {
    let Ok(region) = region(bounds) else {
        return;
    };
    let sites = sites_of(&region);
    for sign in SIGNS {
        let grown = region.dilated(sign).expect("small");
        assert_eq!(sites_of(&grown), dilated(&sites, sign), "{region} {sign:?}");
        assert_eq!(grown.eroded(sign), Some(region), "{region} {sign:?}");
        assert_eq!(region.dilated_by(sign, 0), Ok(region));
        let by_sets = under(sites.clone(), &[sign; 5]).pop();
        let by_five = region.dilated_by(sign, 5).expect("small");
        assert_eq!(Some(sites_of(&by_five)), by_sets, "{region} {sign:?}");
        let shrunk = region.eroded(sign);
        let left = eroded(&sites, sign);
        let kept = shrunk.as_ref().map_or_else(Sites::new, sites_of);
        assert_eq!(kept, left, "{region} {sign:?}");
        assert_eq!(shrunk.is_none(), left.is_empty(), "{region} {sign:?}");
        if let Some(shrunk) = shrunk {
            let again = shrunk.dilated(sign).expect("small");
            assert!(sites_of(&again).is_subset(&sites), "{region} {sign:?}");
        }
        // The mirror image of a pile has mirrored steps.
        let image = region.mirrored().dilated(-sign).expect("small");
        assert_eq!(image, grown.mirrored(), "{region} {sign:?}");
    }
}

#[test]
fn of_all_small_regions() {
    each_bounds(2, |bounds| {
        let [x0, x1, y0, y1, s0, s1] = bounds;
        if x0 <= x1 && y0 <= y1 && s0 <= s1 {
            grows_and_shrinks(bounds);
        }
    });
}

#[test]
fn of_random_regions() {
    random_bounds(6, 1_000, grows_and_shrinks);
}

/// The numbers of spheres on the way up from a site of the last layer, along each direction.
fn walked_up(layers: &[Sites], signs: &[Sign], site: (i128, i128)) -> [i128; 3] {
    core::array::from_fn(|m| {
        let (mut here, mut count) = (site, 0);
        for (layer, sign) in layers.iter().zip(signs).rev() {
            // This sphere is support m of the one above. So the walk reverses the step down from (0, 0).
            let (dj, di) = supports((0, 0), *sign)[m];
            here = (here.0 - dj, here.1 - di);
            if !layer.contains(&here) {
                break;
            }
            count += 1;
        }
        count
    })
}

fn counts_the_spheres_above(last: &Region, layers: &[Sites], sign: Sign) {
    let steps = i128::try_from(layers.len()).expect("few") - 1;
    let signs = vec![sign; layers.len() - 1];
    for site in sites_of(last) {
        let (j, i) = site;
        let counted = last.spheres_above(i, j, sign, steps);
        let walked = walked_up(&layers[..layers.len() - 1], &signs, site);
        assert_eq!(counted, walked, "({i}, {j}) of {last} {sign:?} {steps}");
    }
}

/// Checks a pile grown down from the region, and the highest one grown up from it.
fn counts_above(bounds: [i128; 6]) {
    let Ok(region) = region(bounds) else {
        return;
    };
    for sign in SIGNS {
        for steps in 0..=4 {
            let signs = vec![sign; steps];
            let layers = under(sites_of(&region), &signs);
            let by = i128::try_from(steps).expect("few");
            let last = region.dilated_by(sign, by).expect("small");
            counts_the_spheres_above(&last, &layers, sign);
            let layers = on(sites_of(&region), &signs);
            if layers.iter().all(|layer| !layer.is_empty()) {
                counts_the_spheres_above(&region, &layers, sign);
            }
        }
    }
}

#[test]
fn spheres_above_in_all_small_regions() {
    each_bounds(1, counts_above);
}

#[test]
fn spheres_above_in_random_regions() {
    random_bounds(6, 250, counts_above);
}

/// Different sides of a hexagon end its lines.
#[test]
fn a_walk_up_distinguishes_the_directions() {
    let layers = under(sites_of(&Region::SITE), &[Sign::Plus; 5]);
    let above = walked_up(&layers[..5], &[Sign::Plus; 5], (2, 1));
    assert_eq!(above, [2, 1, 2]);
    let mirrored = under(sites_of(&Region::SITE), &[Sign::Minus; 5]);
    let above = walked_up(&mirrored[..5], &[Sign::Minus; 5], (-2, 0));
    assert_eq!(above, [3, 0, 2]);
}
