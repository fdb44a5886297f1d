//! Which beginnings stand with horizontal contacts where they do not without.

#[cfg(not(feature = "horizontal"))]
pub(super) use without::Survivors;

#[cfg(feature = "horizontal")]
pub(super) use with::Survivors;

#[cfg(feature = "horizontal")]
mod with {
    use alloc::collections::BTreeMap;
    use alloc::vec::Vec;
    use std::sync::{Mutex, PoisonError};

    use crate::Error;
    use crate::certificate::Claim;
    use crate::disorder::Ensemble;
    use crate::lattice::Sign;
    use crate::stacking::Stacking;

    /// The beginnings that were asked about so far: each is decided once.
    pub(in crate::disorder::ensemble) struct Survivors {
        ensemble: Ensemble,
        known: Mutex<BTreeMap<Vec<Sign>, bool>>,
    }

    impl Survivors {
        pub(in crate::disorder::ensemble) fn of(ensemble: &Ensemble) -> Self {
            Self {
                ensemble: ensemble.clone(),
                known: Mutex::default(),
            }
        }

        /// Whether the stacking of these signs stands with horizontal contacts.
        pub(in crate::disorder::ensemble) fn are_held(
            &self,
            signs: &[Sign],
        ) -> Result<bool, Error> {
            // What another thread has left there is whole.
            let known = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
            let found = known().get(signs).copied();
            if let Some(found) = found {
                return Ok(found);
            }
            let pile = self
                .ensemble
                .pile(Stacking::from_signs(signs.iter().copied())?)?;
            let is_held = pile.equilibrium()?.claim == Claim::Stands;
            known().insert(signs.to_vec(), is_held);
            Ok(is_held)
        }
    }
}

#[cfg(not(feature = "horizontal"))]
mod without {
    use crate::Error;
    use crate::lattice::Sign;

    /// There are none.
    pub(in crate::disorder::ensemble) enum Survivors {}

    impl Survivors {
        pub(in crate::disorder::ensemble) fn are_held(&self, _: &[Sign]) -> Result<bool, Error> {
            match *self {}
        }
    }
}
