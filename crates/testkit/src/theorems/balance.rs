//! The balance of every single sphere.

use cannonpile::geometry::Vector;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::{Verdict, same};
use crate::answers::{Answers, below};

/// On every sphere the forces of the spheres below, of the spheres above (the opposite of what those
/// feel) and the weight cancel; on the bottom layer the floor receives what is left.
pub fn every_sphere_is_balanced(pile: &Answers) -> Verdict {
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
            // From mg into f₀ cosθ.
            left = left - &force.clone().map(|c| c * &pile.weight);
        }
        same(site, &left, &Vector::zero())?;
    }
    Ok(())
}

/// What a sphere says it receives from above is what the spheres above say they give; at the surface
/// nothing.
pub fn neighbours_agree(pile: &Answers) -> Verdict {
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

/// Every force pushes, along the line from the centre of the lower sphere to that of the upper one.
pub fn forces_lie_along_contacts(pile: &Answers) -> Verdict {
    for ((site, direction), contact) in &pile.contacts {
        let lower = &pile.spheres[&below(*site, *direction)].position;
        let lean = pile.spheres[site].position.clone() - lower;
        let along = lean.scaled(&contact.force);
        same((site, direction), &contact.vector, &along)?;
        same((site, direction), &contact.force.is_positive(), &true)?;
    }
    Ok(())
}

/// The resultant of the forces from above points away from the apex and grows with the distance:
/// mg/(6R cosθ)·r, which is r/(2R) in f₀ (`paper`, "Closed form"). Of an equilateral base and of discs.
pub fn resultants_are_central(pile: &Answers) -> Verdict {
    for (site, sphere) in &pile.spheres {
        same(site, &sphere.resultant_above, &sphere.position)?;
    }
    Ok(())
}
