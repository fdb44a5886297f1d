//! Theorems about the answers for any pile. Each is a function of plain data, so tests can show that it rejects corrupted
//! answers.

pub(crate) mod balance;
pub(crate) mod base;
pub(crate) mod symmetry;

use core::fmt::Debug;

use cannonpile_testkit::answers::Answers;

/// `Ok`, or a description of the answer that contradicts the theorem.
pub(crate) type Verdict = Result<(), String>;

/// `got` equals `want`. The error names the item `what`.
pub(crate) fn same<T: PartialEq + Debug>(what: impl Debug, got: &T, want: &T) -> Verdict {
    if got == want {
        Ok(())
    } else {
        Err(format!("{what:?}: {got:?} is not {want:?}"))
    }
}

/// The library and the oracle agree on a pile, item by item.
pub(crate) fn agree(library: &Answers, oracle: &Answers) -> Verdict {
    same("weight", &library.weight, &oracle.weight)?;
    for (site, sphere) in &oracle.spheres {
        same(site, &library.spheres.get(site), &Some(sphere))?;
    }
    for (place, contact) in &oracle.contacts {
        same(place, &library.contacts.get(place), &Some(contact))?;
    }
    for (site, force) in &oracle.floor {
        same(site, &library.floor.get(site), &Some(force))?;
    }
    // The library lists no additional items.
    same("all", library, oracle)
}
