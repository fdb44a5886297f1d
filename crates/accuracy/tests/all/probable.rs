//! The probable bound: its formula on a pile that is small enough for a pencil, and real errors within it.

use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::num_rational::BigRational;
use cannonpile::num_traits::ToPrimitive;
use cannonpile::scalar::Algebra;
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Load, Pile, ratio};
use cannonpile_accuracy::probable_bounds;

/// "+-+" under one sphere. Sums and powers of two by hand: of g = (1, 0, 0), and then of (2/3, 2/3, 2/3), which are above those of
/// (5/3, 0, 0).
#[test]
fn the_bound_of_three_layers_is_that_by_hand() {
    let pile = Pile::under(Region::SITE, "+-+".parse().unwrap()).unwrap();
    let bounds = probable_bounds(&pile, 24, 0.02).unwrap();
    assert_eq!(bounds.len(), 3);
    let u = 2.0_f64.powi(-24);
    let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-5, "{a}, {b}");
    close(bounds[0].scale, u);
    close(bounds[1].greatest, 5.0 / 3.0);
    // x is 1, 1, 2/3, y is 2/3 at most, and f is 5/3 at most.
    let second = 4.0 / 3.0 + 4.0 / 3.0 + 3.0 / 4.0 + 1.0 / 4.0 + 1.0;
    close(bounds[1].scale, u * f64::sqrt(1.0 + second));
    // x is 4/3, 2, 4/3, y is 2/3, and f is 5/3.
    let third = 4.0 / 3.0 + 16.0 / 3.0 + 3.0 + 1.0 / 4.0 + 1.0;
    close(bounds[2].scale, u * f64::sqrt(1.0 + second + third));
    close(bounds[1].lambda_of_one, (2.0 * 200.0_f64.ln()).sqrt());
    // Three spheres.
    close(bounds[1].lambda_of_all, (2.0 * 1800.0_f64.ln()).sqrt());
    close(
        bounds[1].of_all(),
        bounds[1].lambda_of_all * bounds[1].scale,
    );
}

#[test]
fn the_bound_of_a_straight_pile_has_no_sign_change() {
    for (pile, lines) in [
        (Pile::triangular(5).unwrap(), 3.0),
        (Pile::discs(5).unwrap(), 2.0),
    ] {
        let bounds = probable_bounds(&pile, 53, 0.01).unwrap();
        let last = bounds.last().unwrap();
        // The powers of two of 1, 2, 3 and 4.
        let squares = 1.0_f64 + 4.0 + 4.0 + 16.0;
        assert!((last.scale / squares.sqrt() * 2.0_f64.powi(53) - 1.0).abs() < 1e-6);
        let contacts = if lines > 2.0 { 30.0 } else { 8.0 };
        let lambda = (2.0_f64 * (400.0_f64 * contacts).ln()).sqrt();
        assert!((last.lambda_of_all / lambda - 1.0).abs() < 1e-12);
    }
}

#[test]
fn a_load_adds_a_rounding() {
    let pile = Pile::triangular(3).unwrap();
    let load = Load {
        down: ratio!(2),
        x: ratio!(0),
        y: ratio!(0),
    };
    let loaded = pile.clone().with_load(Site::APEX, load).unwrap();
    let [plain, loaded] =
        [pile, loaded].map(|pile| probable_bounds(&pile, 24, 0.01).unwrap()[0].scale);
    // 1 is the greatest force without the load, and 3 with it. The partial sum is at most 2 + 3.
    assert!(
        (loaded / plain - (4.0_f64 + 16.0).sqrt()).abs() < 1e-4,
        "{}",
        loaded / plain
    );
}

/// A sphere below a sign change receives (0, 1, 0) and bears a load of 6: x is 1, 1, 2/3, y is 2/3 at most, the partial sum is
/// at most 2/3 + 7 + 2, and f is at most 7 + 2/3.
#[test]
fn a_load_counts_on_its_own_sphere() {
    let pile = Pile::under(Region::SITE, "+-".parse().unwrap()).unwrap();
    let site = pile.shape().below(Site::APEX, Direction::Beta).unwrap();
    let bounds = probable_bounds(&pile.with_load(site, ratio!(6)).unwrap(), 24, 0.01).unwrap();
    let [first, second] = [&bounds[0], &bounds[1]].map(|bound| bound.scale * 2.0_f64.powi(24));
    assert!((first - (4.0_f64 + 1.0).sqrt()).abs() < 1e-4, "{first}");
    let below = 4.0 / 3.0 + 4.0 / 3.0 + 3.0 / 4.0 + 1.0 / 4.0 + 64.0 + 16.0;
    assert!((second - f64::sqrt(5.0 + below)).abs() < 1e-4, "{second}");
}

/// A load of 2 under a tilt of 4, along x and along y: the increments are at most 3 + 2·4 and 3 + 3·4, and a sphere without the
/// load would add at most 2 + 2·4 and 2 + 4·4.
#[test]
fn a_tilt_counts_in_partial_sums() {
    for (tilt, squares) in [
        ([ratio!(4), ratio!(0)], 256.0 + 64.0),
        ([ratio!(0), ratio!(4)], 1024.0 + 64.0),
    ] {
        let pile = Pile::triangular(3).unwrap().with_tilt(tilt).unwrap();
        let pile = pile.with_load(Site::APEX, ratio!(2)).unwrap();
        let scale = probable_bounds(&pile, 24, 0.01).unwrap()[0].scale;
        assert!((scale * 2.0_f64.powi(24) / f64::sqrt(squares) - 1.0).abs() < 1e-4);
    }
}

/// Without weights the bound is that of the load.
#[test]
fn weightless_piles_have_bounds_of_their_loads() {
    let pile = Pile::triangular(3).unwrap().weightless();
    let pile = pile.with_load(Site::APEX, ratio!(1 / 1024)).unwrap();
    let scale = probable_bounds(&pile, 24, 0.01).unwrap()[0].scale;
    // A partial sum and a force.
    assert!((scale * 2.0_f64.powi(34) - 2.0_f64.sqrt()).abs() < 1e-4);
}

#[test]
fn without_a_bound_it_is_infinite() {
    let pile = Pile::triangular(3).unwrap();
    for (bits, probability) in [
        (3, 0.01),
        (1001, 0.01),
        (0, 0.01),
        (24, 0.0),
        (24, 1.0),
        (24, -1.0),
        (24, f64::NAN),
    ] {
        let bounds = probable_bounds(&pile, bits, probability).unwrap();
        assert!(
            bounds.iter().all(|bound| bound.of_one() == f64::INFINITY),
            "{bits}, {probability}"
        );
    }
    assert!(
        probable_bounds(&Pile::triangular(1).unwrap(), 24, 0.01)
            .unwrap()
            .is_empty()
    );
}

/// Returns the largest error of the contact forces below each layer.
fn errors<T: Algebra + Into<f64>>(pile: &Pile) -> Vec<f64> {
    let mut layers = pile.forces::<T>().layers(Selection::All).unwrap();
    let exact = pile.forces::<BigRational>();
    let mut exact = exact.layers(Selection::All).unwrap();
    let mut errors = Vec::new();
    while let (Some(layer), Some(exact)) =
        (layers.next_layer().unwrap(), exact.next_layer().unwrap())
    {
        if layer.is_floor() {
            break;
        }
        let mut got = [(); 3].map(|()| vec![T::zero(); layer.sphere_count()]);
        let mut want = [(); 3].map(|()| vec![BigRational::default(); layer.sphere_count()]);
        layer
            .fill(got.each_mut().map(|slice| &mut slice[..]))
            .unwrap();
        exact
            .fill(want.each_mut().map(|slice| &mut slice[..]))
            .unwrap();
        let pairs = got.into_iter().flatten().zip(want.into_iter().flatten());
        let error = |(got, want): (T, BigRational)| {
            let got = BigRational::from_float(got.into()).unwrap();
            (got - want).to_f64().unwrap().abs()
        };
        errors.push(pairs.map(error).fold(0.0, f64::max));
    }
    errors
}

/// Rounding to nearest is within the bound of the model, and far below it.
#[test]
fn errors_of_f32_are_within_the_bound() {
    for stacking in ["+-+-+-+-+-+-", "++--++--++--", "+-++-+--+-++"] {
        for top in [Region::SITE, Region::hexagon(3, 2).unwrap()] {
            let site = Site::new(0, 0, 3);
            let plain = Pile::under(top, stacking.parse().unwrap()).unwrap();
            let loaded = plain
                .clone()
                .with_load(Site::APEX, Load::from(ratio!(7 / 2)));
            let loaded = loaded.unwrap().with_weight(site, ratio!(1 / 4)).unwrap();
            for pile in [plain, loaded] {
                let bounds = probable_bounds(&pile, 24, 0.01).unwrap();
                for (error, bound) in errors::<f32>(&pile).into_iter().zip(&bounds) {
                    assert!(error < bound.of_all() / 2.0, "{pile}: {error}, {bound:?}");
                    // A planted fault: with a precision of six bits more the bound is not one.
                    assert!(
                        bound.layer < 6 || error > bound.of_all() / 64.0,
                        "{pile}: {error}, {bound:?}"
                    );
                }
            }
        }
    }
}

/// The bound grows like √L times the forces, and the worst case about like L².
#[test]
fn the_bound_is_far_below_the_worst_case() {
    let pile = Pile::under(Region::hexagon(4, 4).unwrap(), Stacking::hcp(40).unwrap()).unwrap();
    let bounds = probable_bounds(&pile, 24, 0.01).unwrap();
    let mut layers = pile.forces::<f32>().layers(Selection::Layer(38)).unwrap();
    let layer = layers.next_layer().unwrap().unwrap();
    let worst = layer.error_bound().unwrap().to_f64().unwrap();
    let last = bounds.last().unwrap();
    assert!(worst > 100.0 * last.of_all(), "{worst}, {last:?}");
    // With few bits the errors from above are a part of each result.
    let coarse = *probable_bounds(&pile, 8, 0.01).unwrap().last().unwrap();
    assert!(
        coarse.of_all() * 2.0_f64.powi(-16) > 1.3 * last.of_all(),
        "{coarse:?}"
    );
    let exact = pile
        .forces::<BigRational>()
        .contact(Site::new(0, 0, 38), Direction::Alpha);
    assert!(exact.unwrap().to_f64().unwrap() <= last.greatest);
}
