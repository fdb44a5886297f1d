//! Error bounds of the forces of a layer: 13 units in the last place for each pass and each sum, relative to a bound on all
//! forces.

use cannonpile::lattice::{Region, Site};
use cannonpile::scalar::{Algebra, Interval};
use cannonpile::shape::Selection;
use cannonpile::{Error, Pile};
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;

use cannonpile_testkit::answers::ratio;

/// The number of runs among the steps of layers 0 … k.
fn runs(signs: &str, k: usize) -> usize {
    let steps: Vec<char> = signs.chars().take(k + 1).collect();
    1 + steps.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// A bound on all forces: (⌊√(36 K N)⌋ + 1)/3 for the weights of K layers with N spheres, plus twice the load.
fn greatest(layers: usize, spheres: usize, load: &BigRational) -> BigRational {
    let root = BigUint::from(36 * layers * spheres).sqrt() + 1_u32;
    (BigRational::from_integer(BigInt::from(root)) + load * ratio(6, 1)) / ratio(3, 1)
}

/// The bounds of all layers above the bottom layer, in order.
fn bounds<T: Algebra>(pile: &Pile) -> Vec<(usize, Option<BigRational>)> {
    let mut layers = pile.forces::<T>().layers(Selection::All).unwrap();
    let mut bounds = Vec::new();
    while let Some(layer) = layers.next_layer().unwrap() {
        bounds.push((layer.sphere_count(), layer.error_bound()));
    }
    bounds.pop();
    bounds
}

fn counts_every_step<T: Algebra>(pile: &Pile, signs: &str, bits: u32, loads: &[(usize, i64)]) {
    let load: i64 = loads.iter().map(|(_, load)| load).sum();
    let mut spheres = 0;
    for (k, (of_layer, bound)) in bounds::<T>(pile).into_iter().enumerate() {
        spheres += of_layer;
        let loaded = loads.iter().filter(|(at, _)| *at <= k).count();
        // One step for each layer that was read (a stop), each run and each load, and one for the sphere's own weight.
        let steps = (k + 1) + runs(signs, k) + loaded + 1;
        let units = BigRational::new((13 * steps).into(), BigInt::from(1) << bits);
        // A factor of 65/64 covers underflow.
        let wanted = units * greatest(k + 1, spheres, &ratio(load, 1)) * ratio(65, 64);
        assert_eq!(bound, Some(wanted), "{signs}, layer {k}");
    }
}

#[test]
fn every_pass_and_sum_counts() {
    for signs in ["+-+-+-", "++-+---+", "-+--+"] {
        let pile = Pile::under(Region::SITE, signs.parse().unwrap()).unwrap();
        counts_every_step::<f64>(&pile, signs, 53, &[]);
        counts_every_step::<f32>(&pile, signs, 24, &[]);
        let loaded = pile.with_load(Site::APEX, ratio(5, 1)).unwrap();
        let site = loaded.rows(Selection::Layer(3)).unwrap().flatten().nth(4);
        let loaded = loaded.with_load(site.unwrap(), ratio(7, 1)).unwrap();
        counts_every_step::<f64>(&loaded, signs, 53, &[(0, 5), (3, 7)]);
    }
}

#[test]
fn skipped_layers_are_not_stops() {
    let pile = Pile::under(Region::SITE, "+-+-+-".parse().unwrap()).unwrap();
    let forces = pile.forces::<f64>();
    let mut one = forces.layers(Selection::Layer(5)).unwrap();
    let alone = one.next_layer().unwrap().unwrap().error_bound().unwrap();
    let (_, among) = bounds::<f64>(&pile).pop().unwrap();
    // 1 stop instead of 6, 6 runs, and one for the sphere's own weight.
    assert_eq!(alone / among.unwrap(), ratio(1 + 6 + 1, 6 + 6 + 1));
}

/// 10⁻⁴⁰ is subnormal in `f32`, with few digits. `f64` represents it with full precision.
#[test]
fn forces_that_underflow_have_no_bound() {
    let pile = Pile::under(Region::SITE, "+-+".parse().unwrap()).unwrap();
    let loaded = |power: u32| {
        let little = BigRational::new(1.into(), BigInt::from(10).pow(power));
        pile.clone()
            .weightless()
            .with_load(Site::APEX, little)
            .unwrap()
    };
    let are_bound = |power| {
        let pile = loaded(power);
        let all = |bounds: Vec<(usize, Option<BigRational>)>| {
            assert!(
                bounds
                    .iter()
                    .all(|(_, bound)| bound.is_some() == bounds[0].1.is_some())
            );
            bounds[0].1.is_some()
        };
        [all(bounds::<f32>(&pile)), all(bounds::<f64>(&pile))]
    };
    assert_eq!(are_bound(30), [true, true]);
    assert_eq!(are_bound(40), [false, true]);
    assert_eq!(are_bound(280), [false, true]);
    assert_eq!(are_bound(310), [false, false]);
    // Zero forces are exact.
    let none = bounds::<f32>(&pile.clone().weightless());
    assert!(none.iter().all(|(_, bound)| *bound == Some(ratio(0, 1))));
}

#[test]
fn exact_scalars_have_zero_error_bound() {
    let pile = Pile::under(Region::SITE, "+-+".parse().unwrap()).unwrap();
    for (_, bound) in bounds::<BigRational>(&pile) {
        assert_eq!(bound, Some(ratio(0, 1)));
    }
    assert!(bounds::<Interval>(&pile).iter().all(|(_, b)| b.is_none()));
}

/// 10³⁹ overflows `f32`: at the loaded sphere, below it, and below a sign change.
#[test]
fn an_overflow_is_an_error_in_every_layer() {
    let pile = Pile::under(Region::SITE, "++-+".parse().unwrap()).unwrap();
    let great = BigRational::from_integer(BigInt::from(10).pow(39));
    let pile = pile.with_load(Site::APEX, great).unwrap();
    let forces = pile.forces::<f32>();
    for k in 0..4 {
        let mut layers = forces.layers(Selection::Layer(k)).unwrap();
        let layer = layers.next_layer().unwrap().unwrap();
        let [mut a, mut b, mut c] = [(); 3].map(|()| vec![0.0; layer.sphere_count()]);
        let filled = layer.fill([&mut a, &mut b, &mut c]);
        assert!(matches!(filled, Err(Error::Overflow { .. })), "layer {k}");
    }
    // `f64` can represent it.
    let mut layers = pile.forces::<f64>().layers(Selection::Layer(1)).unwrap();
    let layer = layers.next_layer().unwrap().unwrap();
    let [mut a, mut b, mut c] = [[0.0; 3]; 3];
    assert_eq!(layer.fill([&mut a, &mut b, &mut c]), Ok(()));
    assert!((a[0] / 1e39 - 1.0).abs() < 1e-15);
}

/// A query of some layers ignores an overflow below them.
#[test]
fn layers_outside_the_query_cannot_overflow() {
    let pile = Pile::triangular(3).unwrap();
    let packing = super::layers::packing_of(&pile);
    let light = packing.unit_force().nearest::<f64>().unwrap();
    let mass = BigRational::from_float(2e38 / light).unwrap() / ratio(7, 1);
    let packing = packing.with_mass(mass).unwrap();
    let mut layers = packing.layers::<f32>(Selection::Layer(0)).unwrap();
    let [mut a, mut b, mut c] = [[0.0_f32]; 3];
    let apex = layers.next_layer().unwrap().unwrap();
    apex.fill([&mut a, &mut b, &mut c]).unwrap();
    assert_eq!(Some(a[0]), packing.unit_force().nearest());
    assert!((a[0] / 2e38 - 1.0).abs() < 1e-6);
    let twice = packing.layers::<f32>(Selection::Layer(1)).err();
    assert!(matches!(twice, Some(Error::Overflow { .. })), "{twice:?}");
}

/// The final forces are representable but the intermediate sums overflow. No infinity may be returned as a force.
#[test]
fn intermediate_sums_overflow_too() {
    let pile = Pile::under(Region::SITE, "++--+++-+--++---+-++++".parse().unwrap()).unwrap();
    let load = BigRational::from_float(0.3 * f64::MAX).unwrap();
    let pile = pile.with_load(Site::APEX, load).unwrap();
    let forces = pile.forces::<f64>();
    let mut layers = forces.layers(Selection::Layer(19)).unwrap();
    let layer = layers.next_layer().unwrap().unwrap();
    let [mut a, mut b, mut c] = [(); 3].map(|()| vec![0.0; layer.sphere_count()]);
    match layer.fill([&mut a, &mut b, &mut c]) {
        Ok(()) => assert!([a, b, c].iter().flatten().all(|force| force.is_finite())),
        refused => assert!(matches!(refused, Err(Error::Overflow { .. }))),
    }
}
