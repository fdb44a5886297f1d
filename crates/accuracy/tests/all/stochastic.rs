//! Stochastic rounding: single operations, the variance law, and the probable bound.

use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::num_rational::BigRational;
use cannonpile::num_traits::{One, Zero};
use cannonpile::scalar::laws;
use cannonpile::scalar::{Algebra, DoubleDouble};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Pile, formula};
use cannonpile_accuracy::{Stochastic, probable_bounds, residuals, stochastic_forces};

/// Operands of many magnitudes, with 24 bits.
fn operands() -> Vec<f32> {
    let mut state = 1_u64;
    let mut next = move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        state >> 33
    };
    (0..60)
        .map(|n| {
            let digits = f32::from_rational(&BigRational::new(next().into(), (1_u64 << 31).into()));
            let sign = if next() % 2 == 0 { 1.0 } else { -1.0 };
            (sign + digits) * [1.0, 0.5, 3e-8, 6e7, 1e-3][n % 5]
        })
        .chain([0.0, 1.0, -1.0, 3.0, 16_777_215.0, 1.0 / 3.0])
        .collect()
}

#[test]
#[expect(clippy::float_cmp, reason = "the results are those of f32")]
fn without_a_state_it_rounds_to_nearest() {
    let of = |x: f32| Stochastic::<24>::new(x.into(), 0);
    for a in operands() {
        assert_eq!(of(a).value(), f64::from(a));
        assert_eq!(
            of(a).div_int(3.try_into().unwrap()).value(),
            f64::from(a / 3.0),
            "{a}/3"
        );
        for b in operands() {
            assert_eq!((of(a) + of(b)).value(), f64::from(a + b), "{a} + {b}");
            assert_eq!((of(a) - of(b)).value(), f64::from(a - b), "{a} - {b}");
            assert_eq!((of(a) * of(b)).value(), f64::from(a * b), "{a} {b}");
            let quotient = of(a).checked_div(&of(b)).map(Stochastic::value);
            assert_eq!(quotient, a.checked_div(&b).map(f64::from), "{a}/{b}");
            let ratio = BigRational::from_float(a).unwrap() * BigRational::new(1.into(), 7.into());
            assert_eq!(
                Stochastic::<24>::from_rational(&ratio).value(),
                f64::from(f32::from_rational(&ratio))
            );
            assert_eq!(
                Stochastic::<53>::from_rational(&ratio).value(),
                f64::from_rational(&ratio)
            );
        }
    }
}

#[expect(clippy::float_cmp, reason = "an exact result has no error")]
/// With a state, a result is one of the two neighbours of the exact one, and on average the exact one.
fn mean_is_exact<const P: u32>() {
    let of = |x: f32, state| Stochastic::<P>::new(x.into(), state);
    let unit = (-f64::from(P)).exp2();
    let exactly = |x: f64| BigRational::from_float(x).unwrap();
    let operands = operands();
    let (mut count, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for (n, (a, b)) in operands.iter().zip(operands.iter().rev()).enumerate() {
        for seed in 1..200_u64 {
            let [a, b] = [(a, 1_000), (b, 2_000)].map(|(x, m)| of(*x, m * seed + n as u64));
            let [p, q] = [a, b].map(|x| exactly(x.value()));
            let three = BigRational::from_integer(3.into());
            for (got, want) in [
                (a + b, &p + &q),
                (a - b, &p - &q),
                (a * b, &p * &q),
                (a.div_int(3.try_into().unwrap()), p / three),
            ] {
                let error = exactly(got.value()) - &want;
                let neighbours = Stochastic::<P>::from_rational(&want).value();
                if error.is_zero() {
                    assert_eq!(got.value(), neighbours);
                    continue;
                }
                let relative = f64::from_rational(&(error / want)) / unit;
                assert!(relative.abs() < 2.0, "{a:?}, {b:?}: {got:?}, {relative} u");
                count += 1.0;
                sum += relative;
                squares += relative * relative;
            }
        }
    }
    assert!(count > 10_000.0, "{count}");
    // The mean of the errors is within three and a half standard deviations, and errors are as large as they should be.
    let deviation = (squares / count / count).sqrt();
    assert!(
        (sum / count).abs() < 3.5 * deviation,
        "{P}: {} of {deviation}",
        sum / count
    );
    assert!(
        (0.2..0.5).contains(&(squares / count)),
        "{P}: {}",
        squares / count
    );
}

#[test]
fn errors_have_the_mean_zero() {
    mean_is_exact::<8>();
    mean_is_exact::<24>();
}

#[test]
fn the_laws_of_scalars_hold() {
    let operands = operands();
    for (n, a) in operands.iter().enumerate() {
        let [a, b, c] = [*a, operands[(n + 7) % operands.len()], 1.25]
            .map(|x| Stochastic::<24>::new(x.into(), n as u64));
        laws::algebra(&a, &b, &c).unwrap();
    }
    for n in [0, 1, -1, 1 << 24, (1 << 24) + 1, i128::MAX] {
        laws::integers::<Stochastic<24>>(n).unwrap();
    }
}

/// How the sum of three forces is divided by 3.
#[derive(Clone, Copy, PartialEq)]
enum Third {
    Divided,
    /// A planted fault: the product with a third that is rounded once. Its error is a bias.
    Stored,
}

type Forces<T> = [Vec<T>; 3];

/// Returns the contact forces below all layers with supports, with a state of random numbers for each place.
fn sweep<const P: u32>(pile: &Pile, seed: u64, third: Third) -> Vec<Forces<DoubleDouble>> {
    let shape = pile.shape();
    let stored = Stochastic::<P>::from_rational(&BigRational::new(1.into(), 3.into()));
    let mut layers: Vec<Forces<DoubleDouble>> = Vec::new();
    let mut upper: Vec<(Site, [f64; 3])> = Vec::new();
    for k in 0..pile.layers() - 1 {
        let sites: Vec<Site> = pile.sites(Selection::Layer(k)).unwrap().collect();
        let mut received: std::collections::HashMap<_, _> =
            sites.iter().map(|site| (*site, [0.0; 3])).collect();
        for (site, forces) in &upper {
            for direction in Direction::ALL {
                let below = shape.below(*site, direction).unwrap();
                received.get_mut(&below).unwrap()[direction.index()] = forces[direction.index()];
            }
        }
        upper.clear();
        for (n, site) in sites.iter().enumerate() {
            let place = (seed << 32) + (u64::try_from(k).unwrap() << 20) + (n as u64) * 4 + 1;
            let [a, b, c] = received[site];
            let g = [(a, 0), (b, 1), (c, 2)].map(|(x, line)| Stochastic::<P>::new(x, place + line));
            let turns = k > 0 && shape.sign_below(k) != shape.sign_below(k - 1);
            let turned = match third {
                _ if !turns => g,
                Third::Divided => formula::half_turn::<Stochastic<P>>(&g),
                Third::Stored => {
                    let sum = g[0] + g[1] + g[2];
                    let mean = (sum + sum) * stored;
                    g.map(|x| mean - x)
                }
            };
            upper.push((*site, turned.map(|x| (x + Stochastic::one()).value())));
        }
        layers.push([0, 1, 2].map(|line| {
            upper
                .iter()
                .map(|(_, f)| DoubleDouble::from(f[line]))
                .collect()
        }));
    }
    layers
}

fn exact(pile: &Pile) -> Vec<Forces<DoubleDouble>> {
    let forces = pile.forces::<BigRational>();
    let mut layers = forces.layers(Selection::All).unwrap();
    let mut exact = Vec::new();
    while let Some(layer) = layers
        .next_layer()
        .unwrap()
        .filter(|layer| !layer.is_floor())
    {
        let mut want = [(); 3].map(|()| vec![BigRational::zero(); layer.sphere_count()]);
        layer
            .fill(want.each_mut().map(|slice| &mut slice[..]))
            .unwrap();
        exact.push(want.map(|line| line.iter().map(DoubleDouble::from_rational).collect()));
    }
    exact
}

fn squares<'d>(values: impl Iterator<Item = &'d DoubleDouble>) -> f64 {
    values.map(|x| x.high() * x.high()).sum()
}

/// Returns the mean of ‖e‖² below the last layer, over the mean of Σ‖δ‖² of all layers.
fn ratio_of_variances<const P: u32>(pile: &Pile, seeds: u64, third: Third) -> f64 {
    let exact = exact(pile);
    let (mut errors, mut local) = (0.0, 0.0);
    for seed in 1..=seeds {
        let computed = sweep::<P>(pile, seed, third);
        for (n, below) in computed.iter().enumerate() {
            let above = n
                .checked_sub(1)
                .map_or([&[][..]; 3], |n| computed[n].each_ref().map(|x| &x[..]));
            let found =
                residuals(pile, n as i128, above, below.each_ref().map(|x| &x[..])).unwrap();
            local += squares(found.as_flattened().iter());
        }
        let pairs = computed
            .last()
            .unwrap()
            .iter()
            .flatten()
            .zip(exact.last().unwrap().iter().flatten());
        let differences: Vec<_> = pairs.map(|(got, want)| *got - want).collect();
        errors += squares(differences.iter());
    }
    errors / local
}

fn check_variances<const P: u32>() {
    let pile = Pile::under(Region::hexagon(6, 6).unwrap(), Stacking::hcp(5).unwrap()).unwrap();
    let ratio = ratio_of_variances::<P>(&pile, 300, Third::Divided);
    println!("{P} bits: {ratio:.4}");
    assert!((ratio - 1.0).abs() < 0.01, "{P} bits: {ratio}");
}

#[test]
fn variances_add_exactly_in_8_bits() {
    check_variances::<8>();
}

#[test]
fn variances_add_exactly_in_11_bits() {
    check_variances::<11>();
}

#[test]
fn variances_add_exactly_in_17_bits() {
    check_variances::<17>();
}

#[test]
fn variances_add_exactly_in_24_bits() {
    check_variances::<24>();
}

#[test]
fn variances_add_exactly_in_53_bits() {
    check_variances::<53>();
}

/// A stored third has a bias, whose squares do not add.
#[test]
fn variances_with_a_stored_third_do_not_add() {
    let pile = Pile::under(Region::hexagon(3, 3).unwrap(), Stacking::hcp(10).unwrap()).unwrap();
    let ratio = ratio_of_variances::<24>(&pile, 5, Third::Stored);
    assert!(ratio > 1.2, "{ratio}");
}

/// Returns the errors of one contact and the largest ones of the layer above the floor, in ascending order, by seed.
fn sorted_errors<const P: u32>(pile: &Pile, seeds: u64) -> [Vec<f64>; 2] {
    let last = pile.layers() - 2;
    let exact = exact(pile).pop().unwrap().concat();
    let (mut one, mut all) = (Vec::new(), Vec::new());
    for seed in 1..=seeds {
        let forces = stochastic_forces::<P>(pile, seed).unwrap();
        let mut layers = forces.layers(Selection::Layer(last)).unwrap();
        let layer = layers.next_layer().unwrap().unwrap();
        let mut got = [(); 3].map(|()| vec![Stochastic::<P>::zero(); layer.sphere_count()]);
        layer
            .fill(got.each_mut().map(|slice| &mut slice[..]))
            .unwrap();
        let pairs = got.iter().flatten().zip(&exact);
        let errors: Vec<_> = pairs
            .map(|(got, want)| (DoubleDouble::from(got.value()) - want).high().abs())
            .collect();
        one.push(errors[layer.sphere_count() / 2]);
        all.push(errors.into_iter().fold(0.0, f64::max));
    }
    [one, all].map(|mut errors| {
        errors.sort_by(f64::total_cmp);
        errors
    })
}

#[test]
fn the_probable_bound_holds_and_is_near() {
    for stacking in ["+-+-+-+-+", "++--++--+", "+--+-+-++"] {
        let pile = Pile::under(Region::hexagon(2, 2).unwrap(), stacking.parse().unwrap()).unwrap();
        let bound = *probable_bounds(&pile, 11, 0.01).unwrap().last().unwrap();
        let [one, all] = sorted_errors::<11>(&pile, 100);
        let quantile = |errors: &[f64]| errors[errors.len() * 99 / 100];
        let ratios = [
            bound.of_one() / quantile(&one),
            bound.of_all() / quantile(&all),
        ];
        println!("{stacking}: {ratios:?}");
        assert!(
            ratios.iter().all(|ratio| (1.0..10.0).contains(ratio)),
            "{stacking}: {ratios:?}"
        );
        // A planted fault: the bound of a format with five bits more does not hold.
        let finer = probable_bounds(&pile, 16, 0.01).unwrap();
        assert!(finer.last().unwrap().of_all() < all[0]);
    }
}

/// Returns the forces of a part of a pile as bits.
fn bits(pile: &Pile, seed: u64, part: Selection) -> Vec<u64> {
    let forces = stochastic_forces::<11>(pile, seed).unwrap();
    let layers = forces.layers(part).unwrap();
    let mut slices = [(); 3].map(|()| vec![Stochastic::<11>::zero(); layers.slice_len().unwrap()]);
    layers
        .fill(slices.each_mut().map(|slice| &mut slice[..]))
        .unwrap();
    slices
        .iter()
        .flatten()
        .map(|x| x.value().to_bits())
        .collect()
}

#[test]
fn seeds_give_other_roundings_and_the_same_seed_the_same() {
    let pile = Pile::under(Region::hexagon(2, 2).unwrap(), Stacking::hcp(8).unwrap()).unwrap();
    let part = Selection::Layer(6);
    assert_eq!(bits(&pile, 1, part), bits(&pile, 1, part));
    let differ = bits(&pile, 1, part)
        .into_iter()
        .zip(bits(&pile, 2, part))
        .filter(|(a, b)| a != b)
        .count();
    assert!(differ > 100, "{differ}");
}

/// Each of these layers has enough spheres for seven bands of rows.
#[test]
fn neither_threads_nor_the_build_change_roundings() {
    let top = Region::hexagon(81, 81).unwrap();
    let pile = Pile::under(top, Stacking::hcp(5).unwrap()).unwrap();
    let in_pool = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let work = || bits(&pile, 1, Selection::Layer(3));
        pool.build().unwrap().install(work)
    };
    let one = in_pool(1);
    assert!(one.len() > 60_000);
    assert!(in_pool(2) == one, "two threads");
    assert!(in_pool(7) == one, "seven threads");
    // The digest holds in debug and in release builds, and on every processor.
    let digest = |sum: u64, bits: &u64| (sum ^ bits).wrapping_mul(0x0100_0000_01b3).rotate_left(17);
    assert_eq!(one.iter().fold(0, digest), 0xb02a_ef14_f897_6c25);
}
