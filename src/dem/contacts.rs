//! `contacts.csv`: the force of every contact.

use std::io::Write;

use super::PileExport;
use super::progress::Progress;
use super::rounded::{Forces, contacts};
use crate::table::WriteError;

pub(super) fn write(
    export: &PileExport<'_>,
    out: &mut dyn Write,
    progress: &mut Progress<'_>,
) -> Result<(), WriteError> {
    writeln!(out, "id1,id2,force,fx,fy,fz")?;
    let mut forces = Forces::new(&export.packing, |force, [x, y, z]| {
        format!("{force:?},{x:?},{y:?},{z:?}")
    });
    for contact in contacts(&export.packing, &export.numbering)? {
        let (touch, multiple) = contact?;
        let force = forces.of(&touch, multiple)?;
        writeln!(out, "{},{},{force}", touch.upper, touch.lower)?;
        progress.row();
    }
    Ok(())
}
