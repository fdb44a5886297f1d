//! Runs a claim on random bytes. The runs are deterministic and use the same generators as fuzzing.
//!
//! A failure prints the shortest bytes that proptest finds, and the witness of the claim.

use core::cell::RefCell;
use std::collections::BTreeMap;

use arbitrary::Unstructured;
use proptest::collection::vec;
use proptest::prelude::any;
use proptest::test_runner::{Config, RngSeed, TestCaseError, TestError, TestRunner};

use crate::claims::{Claim, Failure};

/// The greatest number of random bytes. No claim reads more, and missing bytes are read as zeros.
const BYTES: usize = 256;

/// Declares a test for each claim: `name: claim, number of cases;`.
#[macro_export]
macro_rules! properties {
    ($($name:ident: $claim:path, $cases:literal;)*) => {$(
        #[test]
        fn $name() {
            $crate::properties::holds($claim, $cases);
        }
    )*};
}

/// Panics unless the claim holds for `cases` random byte strings. They are the same in every run.
pub fn holds(claim: Claim, cases: u32) {
    let judged = |u: &mut Unstructured<'_>| {
        claim(u).map_err(|failure| match failure {
            Failure::NoInput(_) => TestCaseError::reject(failure.to_string()),
            Failure::Refuted(witness) => TestCaseError::fail(witness),
        })
    };
    if let Err(failure) = for_all(cases, judged) {
        panic!("{failure}");
    }
}

fn for_all(
    cases: u32,
    test: impl Fn(&mut Unstructured<'_>) -> Result<(), TestCaseError>,
) -> Result<(), TestError<Vec<u8>>> {
    let config = Config {
        cases,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1998),
        ..Config::default()
    };
    let bytes = vec(any::<u8>(), 0..=BYTES);
    TestRunner::new(config).run(&bytes, |bytes| test(&mut Unstructured::new(&bytes)))
}

/// Counts how often each kind of input occurs in 400 random byte strings.
pub fn census(
    kind: impl Fn(&mut Unstructured<'_>) -> arbitrary::Result<String>,
) -> BTreeMap<String, u32> {
    let counts = RefCell::new(BTreeMap::new());
    let outcome = for_all(400, |u| {
        let kind = kind(u).map_err(|error| TestCaseError::fail(error.to_string()))?;
        *counts.borrow_mut().entry(kind).or_default() += 1;
        Ok(())
    });
    outcome.expect("a generator never fails");
    counts.into_inner()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::demand;

    /// Proptest refutes a claim that is wrong for one byte in 256, and confirms a true one.
    #[test]
    fn a_rare_exception_is_found() {
        let below = |limit: u8| {
            for_all(1024, move |u| {
                let byte = u.arbitrary::<u8>()?;
                demand(byte < limit, || byte.to_string())
                    .map_err(|failure| TestCaseError::fail(failure.to_string()))
            })
        };
        assert!(below(u8::MAX).is_err());
        assert_eq!(below(0).unwrap_err().to_string().matches("[]").count(), 1);
    }
}
