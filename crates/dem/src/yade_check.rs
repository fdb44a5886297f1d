//! `checkPile.py`: a check in the style of `scripts/checks-and-tests/checks` of YADE.

use std::io::Write;

use super::numbered::NumberedPile;
use super::suite::{Forces, Outcome, TOLERANCE};
use super::template::fill;
use super::yade::texts;
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
    Ok(out.write_all(script(pile, title, &forces)?.as_bytes())?)
}

fn script(pile: &NumberedPile<'_>, title: &str, forces: &Forces) -> Result<String, Error> {
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
    let mut texts = texts(pile)?;
    texts.extend([
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("falls", falls.to_owned()),
        ("tolerance", format!("{TOLERANCE:?}")),
        ("spheres", spheres.collect::<Result<String, Error>>()?),
        ("contacts", contacts.collect::<Result<String, Error>>()?),
        ("title", title.to_owned()),
    ]);
    Ok(fill(include_str!("check_pile.py"), &texts))
}
