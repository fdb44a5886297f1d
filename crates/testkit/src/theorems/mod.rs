//! What must hold of the answers about any pile: each theorem a function of plain data, so that it
//! can be shown to refuse corrupted ones.

pub mod balance;
pub mod base;
pub mod symmetry;

use core::fmt::Debug;

use crate::answers::Answers;

/// Nothing, or what contradicts the theorem.
pub type Verdict = Result<(), String>;

/// `got` is `want`; `what` names it where it is not.
pub fn same<T: PartialEq + Debug>(what: impl Debug, got: &T, want: &T) -> Verdict {
    if got == want {
        Ok(())
    } else {
        Err(format!("{what:?}: {got:?} is not {want:?}"))
    }
}

/// Two sources say the same of a pile, item by item.
pub fn agree(library: &Answers, oracle: &Answers) -> Verdict {
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
