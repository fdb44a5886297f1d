//! `checkPile.py`: a check in the style of `scripts/checks-and-tests/checks` of YADE.

use std::io::Write;

use super::numbered::NumberedPile;
use super::springs::{Springs, density};
use super::suite::{Forces, Outcome, TOLERANCE};
use super::template::fill;
use super::weights::inertias;
use super::yade::{blocked, by_id, loads};
use crate::Error;
use crate::table::WriteError;

/// Writes the check.
pub(super) fn write(
    pile: &NumberedPile<'_>,
    title: &str,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let forces = Forces::of(pile)?;
    if forces.outcome == Outcome::Unclear {
        return Err(Error::MustPull {
            remedy: "use --to yade",
        }
        .into());
    }
    Ok(out.write_all(text(pile, title, &forces)?.as_bytes())?)
}

fn text(pile: &NumberedPile<'_>, title: &str, forces: &Forces) -> Result<String, Error> {
    let springs = Springs::of(pile)?;
    let number = |x: f64| format!("{x:?}");
    let mut masses = Vec::new();
    for (site, mass) in inertias(pile)? {
        masses.push((pile.numbering().id(site)?, mass));
    }
    let spheres = pile.centres()?.map(|centre| {
        let (_, [x, y, z]) = centre?;
        Ok(format!("\t({x:?}, {y:?}, {z:?}),\n"))
    });
    let contacts = pile.forces()?.map(|contact| {
        let contact = contact?;
        let ([first, second], force) = (contact.ids, contact.force);
        Ok(format!("\t({first}, {second}, {force:?}),\n"))
    });
    let falls = if forces.outcome == Outcome::Falls {
        "True"
    } else {
        "False"
    };
    Ok(fill(
        include_str!("check_pile.py"),
        &[
            ("version", env!("CARGO_PKG_VERSION").to_owned()),
            ("falls", falls.to_owned()),
            ("tolerance", number(TOLERANCE)),
            ("first", pile.numbering().first_on_floor().to_string()),
            ("stiffness", number(springs.stiffness)),
            ("radius", number(springs.radius)),
            ("density", number(density(springs.mass, springs.radius)?)),
            ("gravity", number(springs.gravity)),
            ("timestep", number(springs.timestep)),
            ("rest", number(2.0 * springs.rest())),
            ("most_steps", springs.most_steps.to_string()),
            ("blocked", blocked(pile).to_owned()),
            ("loads", by_id(loads(pile)?)),
            ("masses", by_id(masses)),
            ("spheres", spheres.collect::<Result<String, Error>>()?),
            ("contacts", contacts.collect::<Result<String, Error>>()?),
            // Whatever stands there is not filled in again.
            ("title", title.to_owned()),
        ],
    ))
}
