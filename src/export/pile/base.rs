//! `base.csv`: the force of every bottom sphere on the floor.

use std::io::Write;

use super::PileExport;
use super::progress::Progress;
use crate::export::{FileFormat, NumberFormat, Units, WriteError, tables};
use crate::shape::Selection;

pub(super) fn write(
    export: &PileExport<'_>,
    out: &mut dyn Write,
    progress: &mut Progress<'_>,
) -> Result<(), WriteError> {
    let units = Units::of_packing(export.packing.clone());
    let mut table = tables::base(&units, Selection::Base)?;
    table.rows = Box::new(table.rows.inspect(|_| progress.row()));
    table.write(FileFormat::Csv, NumberFormat::F64, out)
}
