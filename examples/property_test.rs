//! A property test of your own code, on random piles.
//!
//! The strategies of `cannonpile::testing` generate small piles of all kinds: any stacking and region, with weights and
//! loads. proptest shrinks a failing pile. Run it with `cargo run --features proptest --example property_test`.

use cannonpile::num_rational::BigRational;
use cannonpile::shape::Selection;
use cannonpile::testing::piles;
use cannonpile::{Error, Pile};
use proptest::prelude::*;

/// The code under test: the sum of all normal forces at the base, in mg.
fn total(pile: &Pile) -> Result<BigRational, Error> {
    let base = pile.forces::<BigRational>().base(Selection::Base)?;
    base.map(|force| Ok(force?.normal)).sum()
}

fn main() {
    // In a test module, write `#[test] fn base_carries_the_weight(pile in piles())` instead. It needs no configuration.
    let config = ProptestConfig {
        failure_persistence: None,
        ..Default::default()
    };
    proptest!(config, |(pile in piles())| {
        prop_assert_eq!(total(&pile)?, pile.weight());
    });
}
