//! What must hold of the answers about any pile: each theorem a function of plain data, so that it
//! can be shown to refuse corrupted ones.

#![allow(dead_code, reason = "each test file uses a part of it")]

pub(crate) mod balance;
pub(crate) mod base;
pub(crate) mod symmetry;

use core::fmt::Debug;

use crate::support::answers::Answers;

/// Nothing, or what contradicts the theorem.
pub(crate) type Verdict = Result<(), String>;

/// `got` is `want`; `what` names it where it is not.
pub(crate) fn same<T: PartialEq + Debug>(what: impl Debug, got: &T, want: &T) -> Verdict {
    if got == want {
        Ok(())
    } else {
        Err(format!("{what:?}: {got:?} is not {want:?}"))
    }
}

/// Two sources say the same of a pile, item by item.
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
    // And the library names nothing that is not there.
    same("all", library, oracle)
}
