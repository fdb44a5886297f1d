//! The numbers, probabilities and registries of stackings, compared with enumeration.

use cannonpile::lattice::{MAX_LAYERS, Sign};
use cannonpile::scalar::{Polynomial, Symbol};
use cannonpile_disorder::{FirstSign, Place, RandomStackings};
use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::{One, Zero, pow};

use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::disorder::{Piles, faults, of_site, probabilities};

const FIRSTS: [FirstSign; 3] = [FirstSign::Plus, FirstSign::Minus, FirstSign::Random];

#[test]
fn counts_and_registries_agree_with_enumeration() {
    for first in FIRSTS {
        for steps in 0..=9_usize {
            let stackings = RandomStackings::new(steps as i128 + 1, first).unwrap();
            let all = Piles::response(steps, first).stackings();
            let total = BigUint::from(all.len());
            let choices = steps.saturating_sub(1);
            let counts =
                (0..=u32::try_from(choices).unwrap() + 2).map(|d| stackings.count_with(d).unwrap());
            let counts: Vec<_> = counts.collect();
            for (d, count) in counts.iter().enumerate() {
                let with = all.iter().filter(|signs| faults(signs) == d).count();
                assert_eq!(*count, BigUint::from(with), "{first} {steps} {d}");
            }
            assert_eq!(counts.iter().sum::<BigUint>(), total);
            assert_eq!(stackings.most_faults(), choices as i128);
            for q in probabilities() {
                let mut registry = [(); 3].map(|()| BigRational::zero());
                let mut sum = BigRational::zero();
                for signs in &all {
                    let d = faults(signs);
                    let share = pow(q.clone(), d) * pow(BigRational::one() - &q, choices - d);
                    let net: i64 = signs.iter().sum();
                    registry[usize::try_from(net.rem_euclid(3)).unwrap()] += &share;
                    sum += share;
                }
                let registry = registry.map(|share| share / &sum);
                assert_eq!(
                    stackings.registry(&q).unwrap(),
                    registry,
                    "{first} {steps} {q}"
                );
                let symbolic = stackings.registry(&Polynomial::from(Symbol("q"))).unwrap();
                let values = symbolic.map(|p| p.evaluate(&[(Symbol("q"), q.clone())]).unwrap());
                assert_eq!(values, registry);
            }
        }
    }
}

#[test]
fn registries_converge_by_halves_at_one_half() {
    // ρ_n = ω (−½)^(n−1).
    let stackings = RandomStackings::new(12, FirstSign::Plus).unwrap();
    let registry = stackings.registry(&ratio(1, 2)).unwrap();
    let decay = pow(ratio(-1, 2), 10);
    let expected = [ratio(-1, 3), ratio(2, 3), ratio(-1, 3)].map(|x| x * &decay + ratio(1, 3));
    assert_eq!(registry, expected);
}

/// The limit of layers: 9999 steps of FCC lead to the registry of the top layer.
#[test]
fn registries_of_ten_thousand_layers() {
    let stackings = RandomStackings::new(10_000, FirstSign::Plus).unwrap();
    let registry = stackings.registry(&ratio(0, 1)).unwrap();
    assert_eq!(registry, [1, 0, 0].map(|share| ratio(share, 1)));
}

/// Few faults or few unchanged signs are allowed in high piles. The greatest count is C(10³⁶ − 2, 10⁴), whose first
/// digits are those of (10³⁶)^10000/10000!.
#[test]
fn counts_of_high_piles_are_limited() {
    let highest = RandomStackings::new(MAX_LAYERS, FirstSign::Plus).unwrap();
    assert_eq!(
        highest.count_with(1),
        Ok(BigUint::from(10_u32).pow(36) - 2_u32)
    );
    let count = highest.count_with(10_000).unwrap();
    let factorial: BigUint = (1..=10_000_u32).product();
    let power = BigUint::from(10_u32).pow(360_000);
    let beside = &power - &count * &factorial;
    assert!(
        beside < &power / BigUint::from(10_u32).pow(28),
        "5·10^7 of 10^36"
    );
    assert!(count.bits() > 1_000_000);
    // All signs but two are unchanged.
    let layers = i128::from(u32::MAX) + 4;
    let many = RandomStackings::new(layers, FirstSign::Random).unwrap();
    let two = BigUint::from(layers.unsigned_abs() - 2) * (layers.unsigned_abs() - 3);
    assert_eq!(many.count_with(u32::MAX), Ok(two));
    for (stackings, faults) in [(highest, 10_001), (highest, u32::MAX), (many, u32::MAX / 2)] {
        let refused = stackings.count_with(faults).unwrap_err();
        assert!(
            refused.to_string().ends_with("few signs stay unchanged"),
            "{refused}"
        );
    }
}

#[test]
fn first_signs_round_trip() {
    for first in FIRSTS {
        assert_eq!(first.to_string().parse(), Ok(first));
        assert_eq!(first.name(), first.to_string());
    }
    for wrong in ["", "+-", "Random", "−"] {
        assert!(wrong.parse::<FirstSign>().is_err(), "{wrong}");
    }
    assert_eq!(FirstSign::Plus.signs(), [Sign::Plus]);
}

#[test]
fn places_and_sites_agree() {
    for net in -5..=5_i128 {
        for (i, j) in (-4..=4).flat_map(|i| (-4..=4).map(move |j| (i, j))) {
            let place = Place::of([i, j], net).unwrap();
            assert_eq!(place.site(net), Some([i, j]));
            assert_eq!(place.registry() as i128, net.rem_euclid(3));
            for other in (-5..=5).filter(|other| (other - net) % 3 != 0) {
                assert_eq!(place.site(other), None);
            }
            // In lattice vectors at 60°, three times the place is (x, y), and x² + xy + y² is three times the square of
            // the distance in ρ.
            let [x, y] = [3 * i - net, 3 * j - net];
            assert_eq!(3 * place.distance_squared().unwrap(), x * x + x * y + y * y);
            if net == 0 {
                let [a, b] = of_site([i, j].map(|x| i64::try_from(x).unwrap()), 0);
                assert_eq!(
                    place,
                    Place {
                        a: a.into(),
                        b: b.into()
                    }
                );
            }
        }
    }
    assert_eq!(Place { a: -1, b: 2 }.to_string(), "(-1,2)");
    let in_order = [(5, -1), (-3, 2), (4, 2), (-8, 3)].map(|(a, b)| Place { a, b });
    assert!(in_order.is_sorted() && in_order[0] < in_order[1]);
    let far = i128::MAX;
    assert_eq!(Place::of([far, 0], 0), None);
    assert_eq!(Place { a: far, b: 0 }.site(0), None);
    assert_eq!(Place { a: far, b: 0 }.distance_squared(), None);
}
