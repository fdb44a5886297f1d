//! Moments of every stacking and of the mean, compared with sums over all places, and the waves of the mean.

use cannonpile::lattice::Sign;
use cannonpile::stacking::Stacking;
use cannonpile_disorder::{Error, FirstSign, Moments, RandomStackings, Wave};
use num_rational::BigRational;
use num_traits::{One, Zero, pow};

use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::disorder::{Piles, faults, probabilities};

/// Returns Σ v r², Σ v r³cos3φ and Σ v r⁴ below one stacking, summed over the spheres.
fn summed(described: &Piles, signs: &[i64]) -> [BigRational; 3] {
    let mut sums = [(); 3].map(|()| BigRational::zero());
    for ([a, b], [normal, ..]) in described.bottom(signs) {
        let square = a * a - a * b + b * b;
        // φ is measured from u_α, the place (−1, −1).
        let twice_cube = 2 * (a * a * a + b * b * b) - 3 * a * b * (a + b);
        let powers = [
            ratio(square, 1),
            ratio(twice_cube, 2),
            ratio(square * square, 1),
        ];
        for (sum, power) in sums.iter_mut().zip(powers) {
            *sum += power * &normal;
        }
    }
    sums
}

fn of_library(moments: Moments) -> [BigRational; 3] {
    [moments.second, moments.third, moments.fourth]
}

fn stacking(signs: &[i64]) -> Stacking {
    if signs.is_empty() {
        return Stacking::single_layer();
    }
    let sign = |sign: &i64| if *sign > 0 { Sign::Plus } else { Sign::Minus };
    Stacking::from_signs(signs.iter().map(sign)).unwrap()
}

#[test]
fn moments_of_stackings_agree_with_sums() {
    for steps in 0..=5 {
        let described = Piles::response(steps, FirstSign::Random);
        for signs in described.stackings() {
            let found = of_library(Moments::of(&stacking(&signs)).unwrap());
            assert_eq!(found, summed(&described, &signs), "{signs:?}");
        }
    }
    // In FCC three loads of 1/3 have r = n.
    let fcc = Moments::of(&Stacking::fcc(41).unwrap()).unwrap();
    assert_eq!(
        of_library(fcc),
        [1600, 64_000, 2_560_000].map(|n| ratio(n, 1))
    );
}

#[test]
fn moments_of_the_mean_agree_with_enumeration() {
    for first in [FirstSign::Plus, FirstSign::Minus, FirstSign::Random] {
        for steps in 0..=4 {
            let described = Piles::response(steps, first);
            let all = described.stackings();
            let summed = all.iter().map(|signs| summed(&described, signs));
            let summed: Vec<_> = summed.collect();
            let stackings = RandomStackings::new(steps as i128 + 1, first).unwrap();
            for q in probabilities() {
                let mut means = [(); 3].map(|()| BigRational::zero());
                let mut whole = BigRational::zero();
                for (signs, moments) in all.iter().zip(&summed) {
                    let d = faults(signs);
                    let straight = steps.saturating_sub(1) - d;
                    let share = pow(q.clone(), d) * pow(BigRational::one() - &q, straight);
                    for (mean, moment) in means.iter_mut().zip(moments) {
                        *mean += moment * &share;
                    }
                    whole += share;
                }
                let means = means.map(|mean| mean / &whole);
                let found = of_library(stackings.moments(&q).unwrap());
                assert_eq!(found, means, "{first} {steps} {q}");
            }
        }
    }
}

/// At q = 1/2 the signs are independent, and the moments are 3n − 2 and n(2n³+2n²−2n+1)/3, up to the limit of layers.
#[test]
fn moments_are_limited_to_ten_thousand_layers() {
    let half = ratio(1, 2);
    let of = |layers| RandomStackings::new(layers, FirstSign::Plus).unwrap();
    let n = ratio(9999, 1);
    let cube = &n * &n * &n;
    let fourth = &n * (&cube + &n * &n - &n) * ratio(2, 3) + &n / ratio(3, 1);
    assert_eq!(
        of_library(of(10_000).moments(&half).unwrap()),
        [&n * &n, ratio(29_995, 1), fourth]
    );
    let stacking = Stacking::fcc(10_001).unwrap();
    for refused in [of(10_001).moments(&half), Moments::of(&stacking)] {
        let refused = refused.unwrap_err();
        let Error::Core(cannonpile::Error::TooLarge { needed, limit, .. }) = refused else {
            panic!("{refused:?}");
        };
        assert_eq!((needed, limit), (10_001_u32.into(), 10_000));
    }
}

/// a = (1−q)/(16q) and b = (13q²−42q+21)/(768q²).
#[test]
fn waves_have_the_documented_constants() {
    for (q, damping, dispersion) in [
        (ratio(1, 3), ratio(1, 8), ratio(19, 192)),
        (ratio(1, 2), ratio(1, 16), ratio(13, 768)),
        (ratio(5, 7), ratio(1, 40), ratio(-29, 4800)),
        (ratio(1, 1), ratio(0, 1), ratio(-1, 96)),
    ] {
        let wave = Wave::at(&q).unwrap().unwrap();
        assert_eq!((&wave.damping, &wave.dispersion), (&damping, &dispersion));
        // w² = (1−q)n/(8q).
        for n in [0, 1, 30] {
            let width = (ratio(1, 1) - &q) * ratio(n, 8) / &q;
            assert_eq!(wave.squared_width(n.into()), width);
        }
    }
    assert_eq!(Wave::at(&ratio(0, 1)), Ok(None));
}

#[test]
fn moments_and_waves_check_the_probability() {
    let stackings = RandomStackings::new(4, FirstSign::Plus).unwrap();
    for q in [ratio(-1, 9), ratio(10, 9)] {
        for refused in [
            stackings.moments(&q).unwrap_err(),
            Wave::at(&q).unwrap_err(),
        ] {
            let Error::FaultProbability { given, .. } = refused else {
                panic!("{refused:?}");
            };
            assert_eq!(given, q);
        }
    }
}
