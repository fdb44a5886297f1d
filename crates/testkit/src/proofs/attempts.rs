//! The theorems of a crate, applied to wrong formulas.

use std::collections::BTreeSet;

use cannonpile::theorem::{Library, Listing, Proof, Step, Theorem};

use super::Fault;

/// Theorems with the results of their proofs, for each fault. All tests share them.
pub struct Attempts<F: 'static> {
    theorems: Vec<&'static Theorem<F>>,
    /// The proofs, in the order of the theorems.
    attempts: Vec<(Fault<F>, Vec<Proof>)>,
}

impl<F: Library> Attempts<F> {
    /// Applies each theorem to each fault.
    pub fn new(
        theorems: impl IntoIterator<Item = &'static Theorem<F>>,
        faults: impl IntoIterator<Item = Fault<F>>,
    ) -> Self {
        let theorems: Vec<_> = theorems.into_iter().collect();
        let attempts = |fault: Fault<F>| {
            let proofs = theorems.iter();
            let proofs = proofs.map(|theorem| theorem.prove_for(&fault.formulas));
            let proofs = proofs.collect();
            (fault, proofs)
        };
        let attempts = faults.into_iter().map(attempts).collect();
        Self { theorems, attempts }
    }

    fn tried(&self) -> impl Iterator<Item = (&'static Theorem<F>, &Proof)> {
        let theorems = self.theorems.iter().copied();
        let tried = self.attempts.iter().map(|(_, proofs)| proofs);
        tried.flat_map(move |proofs| theorems.clone().zip(proofs))
    }

    /// Panics unless each fault refutes exactly the theorems that it lists.
    pub fn fail_as_listed(&self) {
        let mut otherwise = Vec::new();
        for (fault, proofs) in &self.attempts {
            let tried = self.theorems.iter().zip(proofs);
            let failing = tried.filter(|(_, proof)| !proof.holds());
            let failing: Vec<_> = failing.map(|(theorem, _)| theorem.name).collect();
            let is_here = |name: &&str| self.theorems.iter().any(|theorem| theorem.name == *name);
            let expected: Vec<_> = fault.refuted_by.iter().copied().filter(is_here).collect();
            if failing != expected || fault.refuted_by.is_empty() {
                otherwise.push(format!("{} ({}): {failing:?}", fault.what, fault.field));
            }
        }
        assert!(otherwise.is_empty(), "{}", otherwise.join("\n"));
    }

    /// Panics unless some fault refutes each theorem. The first such fault must make a step fail.
    pub fn every_theorem_has_a_fault(&self) {
        for theorem in &self.theorems {
            let refuses = |fault: &&Fault<F>| fault.refuted_by.contains(&theorem.name);
            let fault = self.attempts.iter().map(|(fault, _)| fault).find(refuses);
            let fault = fault.unwrap_or_else(|| panic!("no fault for {}", theorem.name));
            let proof = theorem.prove_for(&fault.formulas);
            assert!(!proof.holds(), "{}: {}", theorem.name, fault.what);
            let fails = |step: &Step| !step.holds();
            assert!(proof.steps.iter().any(fails), "{}", theorem.name);
        }
    }

    /// Panics unless some fault refutes each step. A step that no fault refutes is redundant.
    pub fn every_step_has_a_fault(&self) {
        let mut refused = BTreeSet::new();
        for (theorem, proof) in self.tried() {
            let steps = proof.steps.iter().enumerate();
            let failing = steps.filter(|(_, step)| !step.holds());
            refused.extend(failing.map(|(n, _)| (theorem.name, n)));
        }
        let mut redundant = Vec::new();
        for theorem in &self.theorems {
            for (n, step) in theorem.prove().steps.iter().enumerate() {
                if !refused.contains(&(theorem.name, n)) {
                    redundant.push(format!("{}: {}", theorem.name, step.claim));
                }
            }
        }
        assert!(redundant.is_empty(), "{}", redundant.join("\n"));
    }

    /// Panics unless a printed proof reports its failures. Of each theorem, one proof that holds is printed.
    pub fn report_failures(&self) {
        let mut printed = BTreeSet::new();
        let is_new = |(theorem, proof): &(&Theorem<F>, &Proof)| {
            !proof.holds() || printed.insert(theorem.name)
        };
        for (theorem, proof) in self.tried().filter(is_new) {
            for whole in [false, true] {
                let listing = Listing {
                    theorem,
                    proof,
                    whole,
                };
                let text = listing.to_string();
                let failures = proof.steps.iter().filter(|step| !step.holds()).count();
                let verdicts = text.matches("FAILS").count();
                let expected = failures + usize::from(failures > 0);
                assert_eq!(verdicts, expected, "{text}");
            }
        }
    }

    /// Panics unless exactly these formulas have faults.
    pub fn are_faults_of(&self, fields: &[&'static str]) {
        let wrong: BTreeSet<_> = self.attempts.iter().map(|(fault, _)| fault.field).collect();
        assert_eq!(wrong, fields.iter().copied().collect());
    }
}
