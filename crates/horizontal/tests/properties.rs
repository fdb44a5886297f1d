//! Claims about horizontal contacts on random input. The test is deterministic, and its generators are those of the
//! fuzz targets.
//!
//! Each claim is a function of bytes. `cannonpile_testkit` defines the claims, and mutants that each claim must reject. A
//! failure prints the shortest input that proptest finds, and the counterexample of the claim.

use cannonpile_testkit::claims;
use cannonpile_testkit::generators::region;
use cannonpile_testkit::properties;
use cannonpile_testkit::properties::census;

properties! {
    results_match_exact_linear_program: claims::horizontal::any_pile, 192;
    accepted_certificates_are_true: claims::certificates::changed, 384;
    damaged_certificates_are_refused_or_true: claims::certificates::damaged, 512;
    both_checkers_come_to_one_verdict: claims::certificates::checkers_agree, 384;
}

#[test]
fn tiny_piles_cover_all_verdicts() {
    let kinds = census(|u| {
        let pile = region::tiny(u, 5)?
            .pile()
            .expect("the description is a valid pile");
        let alone = pile.first_failure().expect("a verdict").is_none();
        let claim = cannonpile_horizontal::equilibrium(&pile)
            .expect("a verdict")
            .claim;
        Ok(format!("{claim:?} alone={alone}"))
    });
    // Three of four combinations: a pile that is stable without horizontal contacts is stable with them.
    assert_eq!(kinds.len(), 3, "{kinds:?}");
}

#[test]
fn tiny_piles_have_at_most_the_given_layers() {
    for most in 1..=5 {
        let heights = census(|u| Ok((region::tiny(u, most)?.signs.len() + 1).to_string()));
        let greatest = most.to_string();
        assert_eq!(heights.keys().max(), Some(&greatest), "{heights:?}");
    }
}
