//! Measures how the run time grows with the size of the pile.

use std::hint::black_box;

use cannonpile::Pile;
use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::scalar::Ring;
use cannonpile::shape::Selection;
use num_rational::BigRational;

use crate::time::{median, seconds};
use crate::{Extent, Results};

pub(crate) fn measure(extent: Extent, results: &mut Results) {
    for (name, layers) in [
        ("10", 10),
        ("1e6", 1_000_000),
        ("1e15", 1_000_000_000_000_000),
    ] {
        let nanoseconds = one_contact(extent, layers);
        results.push((format!("one_contact_ns_{name}"), nanoseconds));
    }
    let layers = [extent.size(100, 8), extent.size(400, 16)];
    let base = exponent(extent, layers, |pile| {
        let forces = pile.forces::<f64>();
        let floor = forces.base(Selection::Base).expect("a base");
        let normal = (f64::from_integer(pile.layers()) + 2.0) / 3.0;
        floor.for_each(|force| assert!((force.expect("a force").normal - normal).abs() < 1e-9));
    });
    results.push(("base_time_exponent".into(), base));
    let layers = [extent.size(50, 8), extent.size(200, 16)];
    let whole = exponent(extent, layers, |pile| {
        let forces = pile.forces::<f64>();
        let contacts = forces.contacts(Selection::All).expect("rows");
        let sum: f64 = contacts
            .map(|contact| contact.expect("a force").force)
            .sum();
        // The number of contacts with the force n is 3(L−n)(L−n+1)/2.
        let layers = pile.layers();
        let exact: i128 = (1..layers)
            .map(|n| 3 * n * (layers - n) * (layers - n + 1) / 2)
            .sum();
        assert!((sum - f64::from_integer(exact)).abs() <= 1e-6 * sum);
    });
    results.push(("pile_time_exponent".into(), whole));
    results.push(("runs_time_exponent".into(), runs(extent)));
}

fn one_contact(extent: Extent, layers: i128) -> f64 {
    let pile = Pile::triangular(layers).expect("a pile");
    let forces = pile.forces::<f64>();
    let repeats = if extent.smoke { 1 } else { 1_000_000 };
    let site = Site {
        i: layers / 5,
        j: layers / 3,
        k: layers - 2,
    };
    let times = (0..extent.pairs).map(|_| {
        seconds(|| {
            for _ in 0..repeats {
                let force = forces.contact(black_box(site), Direction::Beta);
                assert_eq!(force, Ok(f64::from_integer(site.i) + 1.0));
            }
        })
    });
    median(times) / f64::from(repeats) * 1e9
}

/// Returns the exponent of L in the time of a query, from two sizes.
fn exponent(extent: Extent, layers: [i128; 2], ask: impl Fn(&Pile)) -> f64 {
    let [small, large] = layers.map(|layers| Pile::triangular(layers).expect("a pile"));
    let ratios = (0..extent.pairs).map(|_| seconds(|| ask(&large)) / seconds(|| ask(&small)));
    let [small, large] = layers.map(f64::from_integer);
    median(ratios).ln() / (large / small).ln()
}

/// Returns the exponent of L in the time of exact queries at one sphere below six sign changes, for L = 10⁶ and 10¹⁵.
fn runs(extent: Extent) -> f64 {
    let layers = [1_000_000_i128, 1_000_000_000_000_000];
    let piles = layers.map(|layers| {
        let run = layers / 7;
        let runs = vec![run.to_string(); 7].join(",");
        let stacking = format!("({runs})").parse().expect("a stacking");
        Pile::under(Region::SITE, stacking).expect("a pile")
    });
    let [small, large] = &piles;
    let ask = |pile: &Pile| {
        let forces = pile.forces::<BigRational>();
        // A site in the middle, below all sign changes.
        let region = pile.shape().layer(pile.layers() - 2).expect("a layer");
        let [x, y] = [region.x(), region.y()].map(|range| range.start().midpoint(*range.end()));
        let site = Site {
            i: x,
            j: y,
            k: pile.layers() - 2,
        };
        let three = Direction::ALL.map(|d| forces.contact(site, d).expect("a force"));
        // One contact force alone would not reveal every error, so the balance of the whole sphere is checked.
        let left = forces.unbalanced(site).expect("forces");
        assert_eq!(left.into_array(), [(); 3].map(|()| BigRational::default()));
        black_box(three);
    };
    let ratios = (0..extent.pairs).map(|_| seconds(|| ask(large)) / seconds(|| ask(small)));
    median(ratios).ln() / 1e9_f64.ln()
}
