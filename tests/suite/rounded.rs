//! No quantity of any pile is rounded to a wrong float: 100,000 random and adversarial values of each.
//!
//! The bench `rounding` judges ten million in the same way.

use cannonpile::scalar::Surd;

use crate::answers::ratio;
use crate::rounding::numbers;
use crate::rounding::quantities::Quantity;
use crate::rounding::random::Random;
use crate::rounding::tally::Tally;

/// Values of each quantity.
const CASES: u64 = 100_000;

fn none_is_wrong(tally: impl FnOnce(&mut Random, u64) -> Tally) {
    let Tally {
        cases,
        wrong,
        witness,
    } = tally(&mut Random::new(1998), CASES);
    assert!(cases >= CASES);
    assert_eq!(wrong, 0, "{witness:?}");
}

#[test]
fn random_roots() {
    none_is_wrong(numbers::random_roots);
}

#[test]
fn critical_roots() {
    none_is_wrong(numbers::critical_roots);
}

#[test]
fn rationals() {
    none_is_wrong(numbers::rationals);
}

macro_rules! quantities {
    ($($name:ident: $quantity:ident;)*) => {$(
        #[test]
        fn $name() {
            none_is_wrong(|random, cases| Quantity::$quantity.tally(random, cases));
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
}

#[test]
fn a_wrong_float_is_counted() {
    let root = Surd::sqrt(ratio(2, 1)).expect("not negative");
    let mut tally = Tally::default();
    for float in [2_f64.sqrt(), 2_f64.sqrt().next_up()] {
        tally.meet_float(Some(float), &root);
    }
    tally.meet_float(None::<f32>, &root);
    tally.meet(&root);
    assert_eq!((tally.cases, tally.wrong), (4, 2));
    assert!(
        tally
            .witness
            .is_some_and(|witness| witness.contains("1.4142135623730954)"))
    );
}
