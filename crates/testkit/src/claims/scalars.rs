//! In every scalar the forces of a mixed pile agree with the equations to the accuracy that the scalar states, or it reports
//! an overflow.

use crate::real::Bounded;
use arbitrary::Unstructured;
use cannonpile::scalar::{Algebra, FixedRational, Interval};
use cannonpile::shape::Selection;
use cannonpile::{Error, Forces};
use num_rational::BigRational;

use super::reference::{Contacts, Floor, Solved, contacts_of, floor_of};
use super::{Checked, demand, same};
use crate::generators::region;

/// Checks intervals and narrow rationals. The claim `slices` checks the bounds of floats.
pub fn mixed(u: &mut Unstructured<'_>) -> Checked {
    let described = region::described(u)?;
    let solved = Solved::of(&described);
    let pile = described.pile()?;
    let (contacts, floor) = (contacts_of(&solved), floor_of(&solved));
    encloses(&pile.forces::<Interval>(), &contacts, &floor)?;
    encloses(&pile.forces::<FixedRational<i16>>(), &contacts, &floor)?;
    encloses(&pile.forces::<FixedRational<i64>>(), &contacts, &floor)?;
    encloses(&pile.forces::<FixedRational<i128>>(), &contacts, &floor)
}

/// Every answer contains the exact value.
fn encloses<T: Algebra + Bounded>(
    forces: &Forces<'_, T>,
    contacts: &Contacts,
    floor: &Floor,
) -> Checked {
    let swept = forces.contacts(Selection::All).and_then(Iterator::collect);
    let wanted = contacts.iter().map(|contact| &contact.force);
    if let Some(swept) = or_overflow::<Vec<_>>(swept)? {
        let got: Vec<T> = swept
            .into_iter()
            .map(|contact: cannonpile::ContactForce<T>| contact.force)
            .collect();
        hold(&got, wanted)?;
    }
    let swept = forces.base(Selection::Base).and_then(Iterator::collect);
    let wanted = floor
        .iter()
        .flat_map(|force| [&force.normal, &force.shear_x, &force.shear_y]);
    if let Some(swept) = or_overflow::<Vec<_>>(swept)? {
        let parts = |force: cannonpile::FloorForce<T>| [force.normal, force.shear_x, force.shear_y];
        hold(
            &swept.into_iter().flat_map(parts).collect::<Vec<T>>(),
            wanted,
        )?;
    }
    Ok(())
}

/// Returns `None` if the scalar is too narrow.
fn or_overflow<A>(answer: Result<A, Error>) -> Result<Option<A>, Error> {
    match answer {
        Err(Error::Overflow { .. }) => Ok(None),
        answer => answer.map(Some),
    }
}

fn hold<'w, T: Bounded + core::fmt::Debug>(
    got: &[T],
    wanted: impl Iterator<Item = &'w BigRational>,
) -> Checked {
    let mut compared = 0;
    for (got, want) in got.iter().zip(wanted) {
        // A value without bounds may be any number.
        let holds = got
            .enclosure()
            .is_none_or(|bounds| (bounds.lower..=bounds.upper).contains(want));
        demand(holds, || format!("{got:?} does not contain {want}"))?;
        compared += 1;
    }
    same("all answers", &compared, &got.len())
}

#[cfg(test)]
mod injected_faults {
    use super::*;
    use crate::generators::number::ratio;

    #[test]
    fn bounds_that_miss_the_value_are_caught() {
        let third = [Interval::from_rational(&ratio(1, 3))];
        let holds = |want: BigRational| hold(&third, [want].iter()).is_ok();
        assert!(holds(ratio(1, 3)));
        assert!(!holds(
            ratio(1, 3) + crate::generators::number::power(2, -50)
        ));
        let narrow = [FixedRational::<i16>::new(44, 1)];
        assert!(hold(&narrow, [ratio(300, 1)].iter()).is_err());
    }
}
