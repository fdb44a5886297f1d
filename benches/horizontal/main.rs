//! The cost of exact bounds and elastic states, compared with an interior point method in floats.
//!
//! `cargo bench --manifest-path benches/Cargo.toml --bench horizontal --features all`
//! prints seconds and, last, lines `ratio NAME VALUE`: medians of ratios of two times, measured alternately in one run. With
//! `-- --smoke` it only asserts the results of small piles. It checks every certificate again, outside the measured time,
//! and compares the results with the formulas and the floats.

mod floats;

use std::env;
use std::time::Instant;

use cannonpile::Pile;
use cannonpile::lattice::{Region, Site};
use cannonpile::shape::Selection;
use cannonpile_horizontal as horizontal;
use cannonpile_horizontal::{ElasticState, NormalBounds};
use num_rational::BigRational;
use num_traits::{One, ToPrimitive};

use floats::Floats;

/// The extent of the measurement.
#[derive(Clone, Copy)]
struct Extent {
    /// Assert the results only.
    smoke: bool,
    repetitions: usize,
}

impl Extent {
    /// Returns the size of the pile to measure, or the small one for `--smoke`.
    fn size(self, full: usize, smoke: usize) -> usize {
        if self.smoke { smoke } else { full }
    }

    /// Returns the result, and the median time in seconds.
    fn timed<T>(self, mut run: impl FnMut() -> T) -> (T, f64) {
        let mut once = || {
            let begun = Instant::now();
            let answer = run();
            (answer, begun.elapsed().as_secs_f64())
        };
        let (answer, first) = once();
        let others = (1..self.repetitions).map(|_| once().1);
        let times = median(core::iter::once(first).chain(others));
        (answer, times)
    }
}

fn main() {
    let smoke = env::args().any(|argument| argument == "--smoke");
    let repetitions = if smoke { 1 } else { 5 };
    let extent = Extent { smoke, repetitions };
    println!("seconds  computation");
    let ratios = [bounds(extent), elastic(extent)];
    for (name, value) in ratios {
        println!("ratio {name} {value:.2}");
    }
}

/// Measures both bounds of one sphere and of all spheres. Returns the ratio of the time of an exact upper bound to that
/// of the same bound in floats.
fn bounds(extent: Extent) -> (&'static str, f64) {
    for layers in [extent.size(10, 4), extent.size(16, 7)] {
        let (pile, site) = straight(layers);
        let (bounds, seconds) = extent.timed(|| horizontal::bounds(&pile, site).expect("bounds"));
        prove(&bounds);
        // The upper bound is 1 + C(k+2, 3).
        let k = (layers - 1) / 3;
        let most = BigRational::from_integer((1 + k * (k + 1) * (k + 2) / 6).into());
        assert_eq!(bounds.greatest.normal, most);
        say(
            &format!("bounds of the centre, straight, {layers} layers"),
            seconds,
        );
    }
    let once = Extent {
        repetitions: 1,
        ..extent
    };
    let mixed = under_one_sphere("+-+-+", extent.size(12, 6));
    for (name, pile) in [
        ("straight", straight(extent.size(16, 5)).0),
        ("+-+-+…", mixed),
    ] {
        let all = || -> Vec<NormalBounds> {
            let all = horizontal::base_bounds(&pile, Selection::Base).expect("a base");
            all.map(|bounds| bounds.expect("bounds").1).collect()
        };
        let (all, seconds) = once.timed(all);
        all.iter().for_each(prove);
        let layers = pile.layers();
        say(
            &format!("bounds of {} spheres, {name}, {layers} layers", all.len()),
            seconds,
        );
    }
    let (pile, site) = straight(extent.size(16, 7));
    let floats = Floats::of(&pile);
    let ratio = ratio(
        extent,
        || {
            horizontal::bounds(&pile, site)
                .expect("bounds")
                .greatest
                .normal
        },
        || floats.greatest(site),
    );
    ("bounds_16_centre_over_clarabel", ratio)
}

/// Measures elastic states of stackings that are stable only with horizontal contacts. Returns the ratio of the time of
/// one exact state to that of the same state in floats.
fn elastic(extent: Extent) -> (&'static str, f64) {
    let stiffness_ratio = BigRational::one();
    let solve = |pile: &Pile| horizontal::elastic(pile, &stiffness_ratio).expect("a state");
    for signs in ["+-+-+", "++-+", "+--+-"] {
        let pile = under_one_sphere(signs, extent.size(14, 7));
        let (state, seconds) = extent.timed(|| solve(&pile));
        let certificate = state.certificate().expect("a certificate");
        assert_eq!(certificate.check(), Ok(()));
        let (layers, pushing) = (pile.layers(), state.pile().horizontal_forces().len());
        let what = format!("elastic state, {signs}…, {layers} layers, {pushing} closed contacts");
        say(&what, seconds);
    }
    let pile = under_one_sphere("+-+-+", extent.size(14, 7));
    let floats = Floats::of(&pile);
    let ratio = ratio(extent, || energy(&solve(&pile)), || floats.energy());
    ("elastic_14_over_clarabel", ratio)
}

/// Returns the straight pile, and the bottom sphere at the centre or next to it.
fn straight(layers: usize) -> (Pile, Site) {
    let layers = i128::try_from(layers).expect("few");
    let (k, i) = (layers - 1, (layers - 1) / 3);
    let pile = Pile::triangular(layers).expect("a pile");
    (pile, Site { i, j: i, k })
}

/// Returns the pile with these signs, the last one repeated.
fn under_one_sphere(signs: &str, layers: usize) -> Pile {
    let last = signs.chars().last();
    let more = core::iter::repeat_n(last, layers - 1 - signs.len()).flatten();
    let signs: String = signs.chars().chain(more).collect();
    let stacking = signs.parse().expect("a stacking");
    Pile::under(Region::SITE, stacking).expect("a pile")
}

/// Returns ½ (Σ f² + Σ X²).
fn energy(state: &ElasticState) -> BigRational {
    let pile = state.pile();
    let forces = pile.forces::<BigRational>();
    let sloping = forces.contacts(Selection::All).expect("contacts");
    let sloping = sloping.map(|contact| contact.expect("a contact").force);
    let horizontal = pile.horizontal_forces().map(|(_, force)| force.clone());
    let squares = sloping.chain(horizontal).map(|force| &force * &force);
    squares.sum::<BigRational>() / BigRational::from_integer(2.into())
}

/// Checks that a certificate, if there is one, claims this bound.
fn prove(bounds: &NormalBounds) {
    for bound in [&bounds.least, &bounds.greatest] {
        assert!(bound.attained, "{bound:?}");
        if let Some(certificate) = &bound.certificate {
            assert_eq!(certificate.check(), Ok(()));
        }
    }
}

/// Returns the median ratio of the times of an exact result and the same in floats.
fn ratio(extent: Extent, exact: impl Fn() -> BigRational, floats: impl Fn() -> f64) -> f64 {
    let once = Extent {
        repetitions: 1,
        ..extent
    };
    let pairs = (0..extent.repetitions).map(|_| {
        let (exact, exact_seconds) = once.timed(&exact);
        let (float, float_seconds) = once.timed(&floats);
        let exact = exact.to_f64().expect("a number");
        assert!((float / exact - 1.0).abs() < 1e-6, "{float} for {exact}");
        exact_seconds / float_seconds
    });
    median(pairs)
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn say(what: &str, seconds: f64) {
    println!("{seconds:7.3}  {what}");
}
