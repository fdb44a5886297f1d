//! `export`: a whole pile as files.

use std::io::{self, IsTerminal};
use std::path::{self, Path, PathBuf};
use std::time::Instant;

use cannonpile::Error;
use cannonpile::dem::{self, PileExport, PileFormat, Written};
use cannonpile::table::{NumberFormat, WriteError};
use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::options::{Output, SceneOptions};
use crate::{Failure, complain, warn_if_it_falls};

#[derive(Args)]
pub(crate) struct Export {
    /// The folder, made if it is not there; other files in it stay as they are
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// For what; several with commas between, or the option again
    #[arg(
        long,
        value_enum,
        value_delimiter = ',',
        value_name = "FORMAT",
        default_value = "csv"
    )]
    to: Vec<Target>,
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    // Of the list of files.
    #[command(flatten)]
    pub(crate) output: Output,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Target {
    /// spheres.csv, contacts.csv, base.csv: in SI, spheres by number; base.csv has the last ones, in order
    Csv,
    /// For LAMMPS: pile.data, and pile.in, which relaxes it and writes forces.dump
    Lammps,
    /// For ParaView: spheres.vtp, contacts.vtp
    Vtp,
    /// For YADE: spheres.txt, and pile.py, which relaxes it and writes forces.csv
    Yade,
    /// All of these
    All,
}

impl Target {
    fn formats(self) -> &'static [PileFormat] {
        match self {
            Self::Csv => &[PileFormat::Csv],
            Self::Lammps => &[PileFormat::Lammps],
            Self::Vtp => &[PileFormat::Vtp],
            Self::Yade => &[PileFormat::Yade],
            Self::All => &PileFormat::ALL,
        }
    }
}

/// From this many rows on a bar shows how far it is.
const LONG: u64 = 300_000;

/// Writes the files, and then what they are.
pub(crate) fn run(export: &Export) -> Result<(), Failure> {
    let (scene, pile) = export.scene.read()?;
    let packing = scene.packing(&pile)?;
    let files = PileExport::new(&packing)?;
    let formats = export.to.iter().flat_map(|target| target.formats());
    let formats: Vec<PileFormat> = formats.copied().collect();
    keep_apart(export, &formats)?;
    let begun = Instant::now();
    let bar = bar(rows(&files, &formats));
    let written = files.write(&formats, &export.folder, &mut |rows| bar.inc(rows));
    bar.finish_and_clear();
    let written = written.map_err(|error| refused(&export.scene, error))?;
    let table = dem::files(&written);
    crate::write_table(table, NumberFormat::Exact, &export.output)?;
    warn_if_it_falls(&pile);
    tell_rate(&written, begun);
    Ok(())
}

/// The list must not take the place of one of the files that it lists.
fn keep_apart(export: &Export, formats: &[PileFormat]) -> Result<(), Failure> {
    let Some(list) = &export.output.file else {
        return Ok(());
    };
    let place = |path: &Path| path::absolute(path).ok();
    let files = formats.iter().flat_map(|format| format.files());
    let mut paths = files.map(|file| export.folder.join(file.name()));
    if paths.any(|path| place(&path) == place(list)) {
        let list = list.display();
        return Err(Failure::Told(format!(
            "--output: {list} is one of the files of the export: name another file for the list"
        )));
    }
    Ok(())
}

/// The rows of all files, each format once.
fn rows(files: &PileExport<'_>, formats: &[PileFormat]) -> u64 {
    let chosen = PileFormat::ALL
        .iter()
        .filter(|format| formats.contains(format));
    let rows = chosen.flat_map(|format| format.files());
    rows.filter_map(|file| files.rows(*file)).sum()
}

fn bar(rows: u64) -> ProgressBar {
    if rows < LONG || !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::with_draw_target(Some(rows), ProgressDrawTarget::stderr());
    let template = "{bar:40} {percent}% of {human_len} rows, {per_sec}, {eta} left";
    match ProgressStyle::with_template(template) {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

/// One line on stderr for who waits for it: at a terminal, or for more than a second.
fn tell_rate(written: &[Written], begun: Instant) {
    let seconds = begun.elapsed().as_secs_f64();
    if seconds < 1.0 && !io::stderr().is_terminal() {
        return;
    }
    let rows: u64 = written.iter().filter_map(|file| file.rows).sum();
    let bytes: u64 = written.iter().map(|file| file.bytes).sum();
    #[expect(
        clippy::cast_precision_loss,
        reason = "rows that fit on a disk are exact enough as floats"
    )]
    let rate = rows as f64 / seconds;
    let files = written.len();
    complain(&format!(
        "{rows} rows and {bytes} bytes in {files} files in {seconds:.1} s: {rate:.0} rows/s"
    ));
}

/// The option to change where a number does not fit: there is no other format of numbers.
fn refused(scene: &SceneOptions, error: WriteError) -> Failure {
    match error {
        WriteError::Answer(Error::Overflow { quantity, scalar }) => {
            let option = match quantity {
                "radius" | "a position" | "the volume of a sphere" => "radius",
                "gravity" => "gravity",
                _ => "mass",
            };
            let place = scene.line_of(option);
            let place = place.unwrap_or_else(|| format!("--{option}"));
            Failure::Told(format!(
                "{place}: {quantity} does not fit in {scalar}: give radius, mass and gravity in other units"
            ))
        }
        error => error.into(),
    }
}
