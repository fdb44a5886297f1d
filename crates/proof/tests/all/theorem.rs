//! The theorems of all crates, in one list, and the theorems of this crate.

mod faults;
mod numbers;
mod own;

use std::collections::BTreeSet;

use cannonpile::theorem;
use cannonpile_proof::{Formulas, Listing};
use cannonpile_testkit::proofs;

#[test]
fn names_are_unique_and_found() {
    let names: BTreeSet<_> = cannonpile_proof::all().map(|found| found.name).collect();
    assert_eq!(names.len(), cannonpile_proof::all().count());
    for name in names {
        let found = cannonpile_proof::find(name);
        assert_eq!(found.map(|found| found.name), Some(name));
        assert!(cannonpile_proof::find(&name.to_uppercase()).is_none());
    }
    assert!(cannonpile_proof::find("").is_none());
}

/// The list contains the theorems of the core and of this crate, in this order.
#[test]
fn list_is_complete_and_ordered() {
    let core = theorem::all().map(|found| (found.name, found.prove()));
    let own = cannonpile_proof::own().map(|found| (found.name, found.prove()));
    let expected: Vec<_> = core.chain(own).collect();
    assert_eq!(expected.len(), 64);
    let listed = cannonpile_proof::all().map(|found| (found.name, found.prove()));
    assert!(listed.eq(expected));
}

/// One mutant for each crate, and a theorem that rejects only this one of the three.
#[test]
fn wrong_formulas_are_rejected() {
    let mut core: Formulas = Formulas::LIBRARY;
    core.core.transmitted = |received, own| received - own;
    let mut horizontal: Formulas = Formulas::LIBRARY;
    horizontal.least_on_corner = |k| k.clone() + k;
    let mut disorder: Formulas = Formulas::LIBRARY;
    disorder.registry_excess = |x, _, _| x.clone();
    let crates = [
        (core, "action-reaction"),
        (horizontal, "corner-least"),
        (disorder, "registry"),
    ];
    for (_, name) in &crates {
        let found = cannonpile_proof::find(name).expect("a theorem");
        assert!(found.prove().holds(), "{name}");
        for (wrong, of) in &crates {
            let proof = found.prove_for(wrong);
            let is_refused = of == name;
            assert_eq!(proof.holds(), !is_refused, "{name}");
            let listing = Listing {
                theorem: &found,
                proof: &proof,
                whole: true,
            };
            assert_eq!(listing.to_string().contains("FAILS"), is_refused);
        }
    }
}

/// The core and this crate test the mutants of the core on their own theorems. Here all listed theorems that reject a mutant are
/// found, in the order of the list.
#[test]
fn mutants_list_rejecting_theorems() {
    let names: Vec<_> = cannonpile_proof::all().map(|found| found.name).collect();
    for fault in proofs::of_the_core() {
        let place = |name: &&str| names.iter().position(|listed| listed == name);
        let places: Option<Vec<_>> = fault.refuted_by.iter().map(place).collect();
        let places = places.unwrap_or_else(|| panic!("{}: {:?}", fault.what, fault.refuted_by));
        assert!(places.is_sorted_by(|a, b| a < b), "{}", fault.what);
    }
}
