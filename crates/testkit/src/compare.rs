//! Compares every answer of the library with the oracle's. An error says where they differ.

use cannonpile::shape::Selection;
use cannonpile::{ContactForce, FloorForce, Pile};
use num_rational::BigRational;

use crate::cases::Case;
use crate::oracles::balance::{Forces, direction, place, site};

/// `Ok`, or the place where two answers differ.
pub type Outcome = Result<(), String>;

/// Makes all comparisons of one pile.
pub fn agrees(case: &Case) -> Outcome {
    let forces = case.balance.forces();
    all_agree(&case.pile, &forces).map_err(|parted| {
        format!(
            "{parted}\n{:?}\n{:?}",
            case.balance.signs, case.balance.weights
        )
    })
}

/// Makes all comparisons of a pile with known forces.
pub fn all_agree(pile: &Pile, forces: &Forces) -> Outcome {
    one_by_one(pile, forces)?;
    in_rows(pile, forces)?;
    standing(pile, forces)
}

fn same<T: PartialEq + std::fmt::Debug>(what: &str, library: &T, oracle: &T) -> Outcome {
    if library == oracle {
        return Ok(());
    }
    Err(format!(
        "{what}: {library:?}, but the oracle has {oracle:?}"
    ))
}

fn text(error: &cannonpile::Error) -> String {
    error.to_string()
}

/// Compares sphere by sphere and contact by contact. The library computes these answers along lines of contacts.
pub fn one_by_one(pile: &Pile, known: &Forces) -> Outcome {
    let forces: cannonpile::Forces<BigRational> = pile.forces();
    for (at, expected) in &known.above {
        let above = forces.from_above(site(*at)).map_err(|e| text(&e))?;
        same(&format!("above {at:?}"), &above, expected)?;
    }
    for (at, expected) in &known.below {
        for (m, expected) in expected.iter().enumerate() {
            let force = forces.contact(site(*at), direction(m));
            let force = force.map_err(|e| text(&e))?;
            same(&format!("contact {at:?} {m}"), &force, expected)?;
        }
    }
    for (at, expected) in &known.floor {
        let force = forces.on_floor(site(*at)).map_err(|e| text(&e))?;
        same(&format!("floor {at:?}"), &components(force), expected)?;
    }
    Ok(())
}

/// Compares all contacts and the base in the order of tables. The library uses a sweep if the stacking is not straight.
pub fn in_rows(pile: &Pile, forces: &Forces) -> Outcome {
    contacts_in_rows(pile, Selection::All, forces)?;
    base_in_rows(pile, forces)
}

/// Compares the contacts of a part of the pile.
pub fn contacts_in_rows(pile: &Pile, selection: Selection, known: &Forces) -> Outcome {
    let layers = match selection {
        Selection::Layer(k) => k..k + 1,
        _ => 0..pile.layers(),
    };
    let forces: cannonpile::Forces<BigRational> = pile.forces();
    let mut contacts = forces.contacts(selection).map_err(|e| text(&e))?;
    let expected = known.below.iter();
    for (at, expected) in expected.filter(|(at, _)| layers.contains(&at.0)) {
        for (m, expected) in expected.iter().enumerate() {
            let contact = contacts.next().ok_or("too few contacts")?;
            let contact = contact.map_err(|e| text(&e))?;
            let expected = ContactForce {
                site: site(*at),
                direction: direction(m),
                force: expected.clone(),
            };
            same("a contact in rows", &contact, &expected)?;
        }
    }
    same("the number of surplus contacts", &contacts.count(), &0)
}

fn base_in_rows(pile: &Pile, known: &Forces) -> Outcome {
    let forces: cannonpile::Forces<BigRational> = pile.forces();
    let mut base = forces.base(Selection::Base).map_err(|e| text(&e))?;
    for (at, expected) in &known.floor {
        let force = base.next().ok_or("too few bottom spheres")?;
        let force = force.map_err(|e| text(&e))?;
        same("a bottom sphere", &place(force.site), at)?;
        same(&format!("floor {at:?}"), &components(force), expected)?;
    }
    same("the number of surplus bottom spheres", &base.count(), &0)
}

fn components(force: FloorForce<BigRational>) -> [BigRational; 3] {
    [force.normal, force.shear_x, force.shear_y]
}

/// Compares the least force, its contact, and the first failure.
pub fn standing(pile: &Pile, forces: &Forces) -> Outcome {
    let standing = pile.standing().map_err(|e| text(&e))?;
    let least = forces.least().map(|(force, at, m)| ContactForce {
        site: site(at),
        direction: direction(m),
        force,
    });
    same("the least force", &standing.least, &least)?;
    same(
        "the first failure",
        &standing.first_failure,
        &forces.first_failure(),
    )
}
