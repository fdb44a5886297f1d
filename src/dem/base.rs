//! `base.csv`: the force of every bottom sphere on the floor.

use std::io::Write;

use super::PileExport;
use super::progress::Progress;
use crate::shape::Selection;
use crate::table::{self, FileFormat, NumberFormat, Units, WriteError};

pub(super) fn write(
    export: &PileExport<'_>,
    out: &mut dyn Write,
    progress: &mut Progress<'_>,
) -> Result<(), WriteError> {
    let units = Units::of_packing(export.packing.clone());
    let mut table = table::base(&units, Selection::Base)?;
    table.rows = Box::new(table.rows.inspect(|_| progress.row()));
    table.write(FileFormat::Csv, NumberFormat::F64, out)
}
