//! Forces and positions of elastic states in SI units are correctly rounded.

use cannonpile_testkit::rounding::quantities::Quantity;
use cannonpile_testkit::rounding::random::Random;
use cannonpile_testkit::rounding::tally::Tally;

#[test]
fn elastic_states_are_correctly_rounded() {
    let Tally {
        cases,
        wrong,
        witness,
        ..
    } = Quantity::Elastic.tally(&mut Random::new(1998), 100_000);
    assert!(cases >= 100_000);
    assert_eq!(wrong, 0, "{witness:?}");
}
