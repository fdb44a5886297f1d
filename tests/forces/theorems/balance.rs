//! The equilibrium of every single sphere.

use cannonpile::geometry::Vector;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::{Verdict, same};
use cannonpile_testkit::answers::{Answers, below};

/// The forces from the spheres below, the reactions to the forces on the spheres above, and the weight sum to zero on every
/// sphere. In the bottom layer the floor takes the difference.
pub(crate) fn every_sphere_is_balanced(pile: &Answers) -> Verdict {
    for site in pile.spheres.keys() {
        let mut left = pile.weight_vector();
        for direction in pile.shape.directions() {
            if let Some(contact) = pile.contacts.get(&(*site, *direction)) {
                left = left + &contact.vector;
            }
            if let Some(contact) = pile.contact_above(*site, *direction) {
                left = left - &contact.vector;
            }
        }
        if let Some(force) = pile.floor.get(site) {
            // Converts mg to f₀ cosθ.
            left = left - &force.clone().map(|c| c * &pile.weight);
        }
        same(site, &left, &Vector::zero())?;
    }
    Ok(())
}

/// The forces from above on a sphere equal the forces that the spheres above transmit. At the surface they are zero.
pub(crate) fn neighbours_agree(pile: &Answers) -> Verdict {
    for (site, sphere) in &pile.spheres {
        let mut sum = Vector::zero();
        let mut received = [0, 1, 2].map(|_| BigRational::zero());
        for direction in pile.shape.directions() {
            if let Some(contact) = pile.contact_above(*site, *direction) {
                received[direction.index()] = contact.force.clone();
                sum = sum - &contact.vector;
            }
        }
        same(site, &sphere.from_above, &received)?;
        same(site, &sphere.resultant_above, &sum)?;
    }
    Ok(())
}

/// Every force is compressive and acts along the line of centres.
pub(crate) fn forces_lie_along_contacts(pile: &Answers) -> Verdict {
    for ((site, direction), contact) in &pile.contacts {
        let lower = &pile.spheres[&below(*site, *direction)].position;
        let lean = pile.spheres[site].position.clone() - lower;
        let along = lean.scaled(&contact.force);
        same((site, direction), &contact.vector, &along)?;
        same((site, direction), &contact.force.is_positive(), &true)?;
    }
    Ok(())
}

/// The resultant of the forces from above points away from the apex and is proportional to the distance: mg/(6R cosθ)·r,
/// which is r/(2R) in f₀ (`paper`, "Closed form"). This holds for an equilateral base and for discs.
pub(crate) fn resultants_are_central(pile: &Answers) -> Verdict {
    for (site, sphere) in &pile.spheres {
        same(site, &sphere.resultant_above, &sphere.position)?;
    }
    Ok(())
}
