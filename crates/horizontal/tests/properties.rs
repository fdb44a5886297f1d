//! The claims about horizontal contacts on random input: deterministic, from the generators that fuzzing shares.
//!
//! Each claim is a function of bytes; its planted faults stand beside it in `cannonpile_testkit`. A failure prints the
//! shortest bytes that proptest could find, and the claim's own witness.

use cannonpile_testkit::claims;
use cannonpile_testkit::generators::region;
use cannonpile_testkit::properties;
use cannonpile_testkit::properties::census;

properties! {
    what_can_be_borne_is_what_an_exact_program_says: claims::horizontal::any_pile, 192;
    what_a_checker_accepts_is_true: claims::certificates::changed, 384;
    damaged_certificates_are_refused_or_true: claims::certificates::damaged, 512;
    both_checkers_come_to_one_verdict: claims::certificates::judged_twice, 384;
}

#[test]
fn tiny_piles_stand_or_not_with_pushes_or_without() {
    let kinds = census(|u| {
        let pile = region::tiny(u)?
            .pile()
            .expect("what was described is a pile");
        let alone = pile.first_failure().expect("a verdict").is_none();
        let claim = cannonpile_horizontal::equilibrium(&pile)
            .expect("a verdict")
            .claim;
        Ok(format!("{claim:?} alone={alone}"))
    });
    // What stands alone stands.
    assert_eq!(kinds.len(), 3, "{kinds:?}");
}
