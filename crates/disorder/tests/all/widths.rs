//! The width of the integers: 64 bits, 128 bits and big integers give the same results.

use cannonpile::lattice::{Region, Site};
use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;

use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::disorder::{Anchor, Piles, by_faults, by_place};

fn power(bits: usize) -> BigRational {
    BigRational::from_integer(BigInt::one() << bits)
}

/// A very large or very small load leads to longer integers, and scales the results.
#[test]
fn results_scale_with_the_load() {
    let stackings = RandomStackings::new(10, FirstSign::Random).unwrap();
    let loaded = |load: &BigRational| {
        let plane = RandomPiles::plane(stackings).weightless();
        let plane = plane.with_load(Site::APEX, load.clone()).unwrap();
        plane
            .with_load(Site { i: 1, j: -2, k: 0 }, load * ratio(2, 3))
            .unwrap()
    };
    let one = ratio(1, 1);
    let by_one = by_faults(&loaded(&one)).unwrap();
    let exact = by_place(loaded(&one).exact(&ratio(3, 7)).unwrap());
    // Sums of 9 steps have about 25 bits. The loads cover every width, and both sides of each limit.
    for bits in (1..=130).chain([300]) {
        for load in [power(bits), power(bits).recip() * ratio(1, 3)] {
            let piles = loaded(&load);
            if bits % 8 == 0 {
                let exact_of = by_place(piles.exact(&ratio(3, 7)).unwrap());
                for (place, [probability, normal, shear_x, shear_y]) in exact_of {
                    let [normal, shear_x, shear_y] = [normal, shear_x, shear_y].map(|x| x / &load);
                    assert_eq!(
                        [probability, normal, shear_x, shear_y],
                        exact[&place],
                        "{bits}"
                    );
                }
            }
            for (key, (count, floor)) in by_faults(&piles).unwrap() {
                let floor = floor.map(|force| force / &load);
                assert_eq!((count, floor), by_one[&key], "{bits} {key:?}");
            }
        }
    }
}

/// Probabilities with long denominators agree with the polynomials.
#[test]
fn long_denominators_agree() {
    let piles = Piles::heavy(Anchor::Top(Region::SITE), 6, FirstSign::Plus)
        .piles()
        .unwrap();
    let by_faults = piles.by_faults().unwrap();
    for bits in 1..=40 {
        let q = (power(bits) - ratio(1, 1)) / (power(bits) * ratio(3, 1));
        assert_eq!(
            piles.exact(&q).unwrap(),
            by_faults.at(&q).unwrap(),
            "{bits}"
        );
    }
}

/// At the depths where the width changes the sums are still correct.
#[test]
fn sums_are_correct_for_each_width() {
    for steps in [25, 26, 27, 28, 29, 30] {
        let piles = Piles::response(steps, FirstSign::Plus).piles().unwrap();
        let answer = piles.by_faults().unwrap();
        let mut sums = vec![ratio(0, 1); steps];
        for row in answer.rows() {
            let row = row.unwrap();
            sums[row.faults as usize] += row.normal;
        }
        for (d, sum) in (0..).zip(sums) {
            let count = piles.stackings().count_with(d).unwrap();
            assert_eq!(sum, BigRational::from_integer(count.into()), "{steps} {d}");
        }
    }
}

/// The sums of a recursion in floats may exceed the greatest float although no mean does.
#[test]
fn loads_near_the_greatest_float_have_means() {
    let stackings = RandomStackings::new(6, FirstSign::Plus).unwrap();
    let loaded = |load: BigRational| {
        let plane = RandomPiles::plane(stackings).weightless();
        plane.with_load(Site::APEX, load).unwrap()
    };
    let (one, great) = (loaded(ratio(1, 1)), loaded(power(1023)));
    let (one, great) = (one.mean(&0.25).unwrap(), great.mean(&0.25).unwrap());
    assert!(one.rows().len() > 20);
    let scale = 2.0_f64.powi(1023);
    for (one, great) in one.rows().iter().zip(great.rows()) {
        for (one, great) in [
            (one.probability, great.probability),
            (one.normal, great.normal / scale),
            (one.shear_x, great.shear_x / scale),
            (one.shear_y, great.shear_y / scale),
        ] {
            assert!((one - great).abs() < 1e-15, "{one} {great}");
        }
    }
}
