//! Regions compared with plain sets of sites, and enumerations of small regions and stackings for other tests.
//!
//! | file | contents |
//! |---|---|
//! | `bounds` | regions of all small bounds and of random ones |
//! | `growth` | dilation, erosion, and the spheres above on each line |
//! | `limits` | regions near the greatest coordinates |

mod bounds;
mod growth;
mod limits;

use cannonpile::Error;
use cannonpile::lattice::{Region, Sign};
use proptest::collection::vec;
use proptest::test_runner::{Config, RngSeed, TestRunner};

use cannonpile_testkit::oracles::sets::Sites;

/// The region with the bounds x₀, x₁, y₀, y₁, s₀, s₁.
pub(crate) fn region([x0, x1, y0, y1, s0, s1]: [i128; 6]) -> Result<Region, Error> {
    Region::new(x0..=x1, y0..=y1, s0..=s1)
}

/// The sites of a region, in iteration order.
pub(crate) fn sites_of(region: &Region) -> Sites {
    let sites = region.rows(0).flatten();
    sites.map(|site| (site.j, site.i)).collect()
}

/// Calls `visit` for all six bounds, each from −reach to reach.
pub(crate) fn each_bounds(reach: i128, mut visit: impl FnMut([i128; 6])) {
    let places = 2 * reach + 1;
    for mut n in 0..places.pow(6) {
        visit([0; 6].map(|_: i128| {
            let bound = n % places - reach;
            n /= places;
            bound
        }));
    }
}

/// Calls `visit` for random ordered bounds from −reach to reach. They are the same in every run.
pub(crate) fn random_bounds(reach: i128, cases: u32, visit: impl Fn([i128; 6])) {
    let config = Config {
        cases,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1998),
        ..Config::default()
    };
    let bounds = vec(-reach..=reach, 6);
    let outcome = TestRunner::new(config).run(&bounds, |bounds| {
        let [x, y, s] =
            [0, 2, 4].map(|n| [bounds[n].min(bounds[n + 1]), bounds[n].max(bounds[n + 1])]);
        visit([x[0], x[1], y[0], y[1], s[0], s[1]]);
        Ok(())
    });
    if let Err(failure) = outcome {
        panic!("{failure}");
    }
}

/// All sequences of `steps` signs.
pub(crate) fn each_signs(steps: usize) -> impl Iterator<Item = Vec<Sign>> {
    let sign = |bit| if bit { Sign::Minus } else { Sign::Plus };
    (0..1_u32 << steps).map(move |bits| (0..steps).map(|n| sign(bits >> n & 1 == 1)).collect())
}
