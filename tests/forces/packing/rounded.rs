//! Every quantity of every pile is rounded correctly: 100,000 random and adversarial values of each.
//!
//! The bench `rounding` checks ten million values in the same way.

use cannonpile::scalar::Surd;
use num_bigint::BigInt;
use num_rational::BigRational;

use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::rounding::numbers;
use cannonpile_testkit::rounding::quantities::Quantity;
use cannonpile_testkit::rounding::random::Random;
use cannonpile_testkit::rounding::tally::Tally;

/// The number of values for each quantity.
const CASES: u64 = 100_000;

fn all_are_correct(tally: impl FnOnce(&mut Random, u64) -> Tally) {
    let Tally {
        cases,
        wrong,
        witness,
        ..
    } = tally(&mut Random::new(1998), CASES);
    assert!(cases >= CASES);
    assert_eq!(wrong, 0, "{witness:?}");
}

#[test]
fn random_roots() {
    all_are_correct(numbers::random_roots);
}

#[test]
fn critical_roots() {
    all_are_correct(numbers::critical_roots);
}

#[test]
fn rationals() {
    all_are_correct(numbers::rationals);
}

macro_rules! quantities {
    ($($name:ident: $quantity:ident;)*) => {$(
        #[test]
        fn $name() {
            all_are_correct(|random, cases| Quantity::$quantity.tally(random, cases));
        }
    )*};
}

quantities! {
    contact_forces: Contact;
    components_of_contact_forces: ContactVector;
    contact_points: ContactPoint;
    positions: Position;
    forces_on_the_floor: OnFloor;
    unit_forces: UnitForce;
    masses_weights_and_sizes: Weight;
    filled_in_contact_forces: Filled;
    filled_in_contact_forces_of_stackings: FilledStacking;
}

/// (2^p + 1)·(1 ± δ), close to the midpoint of two floats of p bits. No double-double resolves it.
fn near_ties(bits: u32) -> impl Iterator<Item = Surd> {
    let one = || BigRational::from_integer(1.into());
    let middle = BigRational::from_integer((1_i64 << bits).into()) + one();
    let square = &middle * &middle;
    let hairs = [100, 150, 200, 1000].map(|k| BigRational::new(1.into(), BigInt::from(1) << k));
    let factors = hairs
        .into_iter()
        .flat_map(move |h| [one() - &h, one() + &h]);
    let roots = factors.map(move |factor| Surd::sqrt(&square * factor).expect("not negative"));
    roots.flat_map(|root| {
        let scales = [-80, -1, 0, 60].map(|e: i32| match u32::try_from(e) {
            Ok(e) => BigRational::from_integer(BigInt::from(1) << e),
            Err(_) => BigRational::new(1.into(), BigInt::from(1) << -e),
        });
        scales.map(|scale| root.scaled(&scale))
    })
}

#[test]
fn near_ties_and_roots_of_integers_are_rounded_correctly() {
    let mut tally = Tally::default();
    for surd in near_ties(53).chain(near_ties(24)) {
        tally.check(&surd);
    }
    assert_eq!((tally.cases, tally.wrong), (64, 0));
    for n in (2..5000).filter(|n: &i64| n.isqrt().pow(2) != *n) {
        tally.check(&Surd::sqrt(ratio(n, 1)).expect("not negative"));
    }
    assert_eq!(tally.wrong, 0);
}

#[test]
fn a_wrong_float_is_counted() {
    let root = Surd::sqrt(ratio(2, 1)).expect("not negative");
    let mut tally = Tally::default();
    for float in [2_f64.sqrt(), 2_f64.sqrt().next_up()] {
        tally.check_float(Some(float), &root);
    }
    tally.check_float(None::<f32>, &root);
    tally.check(&root);
    assert_eq!((tally.cases, tally.wrong), (4, 2));
    assert!(
        tally
            .witness
            .is_some_and(|witness| witness.contains("1.4142135623730954)"))
    );
}
