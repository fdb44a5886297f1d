//! `verify`: measured forces against the exact ones.

mod ladder;

use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};

use cannonpile::Packing;
use cannonpile_dem::scene::Scene;
use cannonpile_dem::table::{FileFormat, NumberFormat};
use cannonpile_dem::verify::{
    Columns, Compared, Fault, LadderFiles, Preset, Reader, Refusal, Report, Source,
};
use clap::{Args, ValueEnum};

use super::note_if_it_falls;
use crate::args::{Format, Output, SceneOptions};
use crate::hashed::Hashed;
use crate::output::{A_FILE_OR_STDIN, Failure, complain, unreadable, write_to};
use crate::progress::Progress;

const HELP: &str = "\
Errors are relative to the exact force of the contact; where that is 0, to the largest exact force. Pairs that are no
contact are extra, or noise if their force is below --accept times the largest; pairs of bottom spheres are fixed, and not
judged. Findings name what all differences have in common. As json the report is a record to keep: with the scene, the
file's SHA-256 and this version.

Columns are separated by commas, semicolons, tabs or blanks; a column is a name of the header, or #3 in a table without
one, and may have a sign, a factor and others added: fx=-#10-#13, force=1e7*overlap. kind=contact_type:SS reads the rows
with SS there; the others are contacts with walls. By place, fx,fy,fz without force are those on the first of two centres;
at a contact point they push, unless force is negative.

Examples:
  cannonpile verify pile/forces.dump --layers 10 --spacing 1.2
  cannonpile verify measured.csv --scene pile.toml --accept 1e-3
  cannonpile verify contacts.txt --columns id1=A,id2=B,force=Fn --first-id 0 --layers 10 --spacing 1.2
  cannonpile verify Contact_pairs_0100.csv --preset dem-engine --scene pile.toml --accept 1e-3
  cannonpile verify --ladder 1e5=soft.csv,1e6=firm.csv,1e7=stiff.csv --scene pile.toml
  cannonpile verify forces.csv --match place --columns x=cx,y=cy,z=cz --scene pile.toml --unbalanced rest.csv";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Verify {
    /// A table with columns id1, id2, force, and fx, fy, fz if there are vectors; a LAMMPS dump local file with these columns,
    /// of which the last snapshot counts; or VTK's XML, lines with data (.vtp, .vtu); - for stdin
    #[arg(value_name = "FILE", required_unless_present = "ladder")]
    measured: Option<PathBuf>,
    /// Instead, one file for each of several stiffnesses of the springs, or time steps: the errors, their observed order, and what
    /// remains of them; exit 1 if there is no order
    #[arg(
        long,
        value_name = "K1=FILE1,K2=FILE2,...",
        conflicts_with_all = ["measured", "unbalanced"],
        help_heading = "Ladder"
    )]
    ladder: Option<LadderFiles>,
    /// What the numbers of --ladder are [default: stiffness]
    #[arg(long, value_enum, value_name = "WHAT", help_heading = "Ladder")]
    refine: Option<Refine>,
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    /// The greatest relative error accepted; 0 for forces that are the nearest floats
    #[arg(long, value_name = "E", default_value = "1e-6", allow_hyphen_values = true, value_parser = tolerance, help_heading = "Output")]
    accept: f64,
    /// Which columns hold what: id1, id2, force, fx, fy, fz, x1 … z2 (the centres), x, y, z (the contact point), kind
    #[arg(
        long,
        value_name = "QUANTITY=COLUMN,...",
        allow_hyphen_values = true,
        help_heading = "Table"
    )]
    columns: Option<Columns>,
    /// The columns of a known code: lammps, yade, exadem, exadem-vtp, dem-engine, mddem, lethe; --columns names others
    #[arg(long, value_name = "CODE", help_heading = "Table")]
    preset: Option<Preset>,
    /// How the table's contacts are found in the scene [default: numbers, or as the preset does]
    #[arg(long = "match", value_enum, value_name = "BY", help_heading = "Table")]
    matching: Option<Matching>,
    /// How far from its exact place a sphere may be, in R, by place [default: 0.1]
    #[arg(long, value_name = "SHARE", allow_hyphen_values = true, value_parser = tolerance, help_heading = "Table")]
    within: Option<f64>,
    /// The number of the first sphere [default: 1, or that of the preset]
    #[arg(long, value_name = "N", help_heading = "Table")]
    first_id: Option<u64>,
    /// Write the force that is left on each sphere above the floor, in N, to this file: csv, or json by its ending
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    unbalanced: Option<PathBuf>,
    #[command(flatten)]
    output: Output,
}

/// What is refined from rung to rung of a ladder.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Refine {
    /// The stiffness of the springs, in N/m: errors fall as 1/k
    Stiffness,
    /// The time step, in s
    TimeStep,
}

/// How contacts are found.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Matching {
    /// By the numbers of the two spheres, in the order of the exports
    Numbers,
    /// By where they are: both centres, or the contact point; the frame is found
    Place,
}

impl Verify {
    /// Compares, and returns whether the file is accepted, or the ladder has an order.
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let is_stdin = |path: &PathBuf| path == Path::new("-");
        if self.measured.as_ref().is_some_and(is_stdin) && self.scene.is_from_stdin() {
            let reason = "FILE and --scene are both -: only one of them can come from stdin, name a file for the other";
            return Err(Failure::Message(reason.into()));
        }
        if self.refine.is_some() && self.ladder.is_none() {
            let reason = "--refine is of --ladder: name its files, or leave it out";
            return Err(Failure::Message(reason.into()));
        }
        let (scene, pile) = self.scene.read_state()?;
        let packing = scene.packing(&pile)?;
        let verdict = match (&self.measured, &self.ladder) {
            (Some(path), _) => self.one(path, &scene, &packing)?,
            (None, Some(files)) => self.climb(files, &scene, &packing)?,
            // One of the two is required.
            (None, None) => false,
        };
        note_if_it_falls(&pile);
        Ok(verdict)
    }

    /// Compares one file.
    fn one(&self, path: &Path, scene: &Scene, packing: &Packing<'_>) -> Result<bool, Failure> {
        let format = self.output.format()?;
        let reader = self.reader()?;
        let progress = Progress::begin("reading FILE, and comparing it with the exact forces");
        let read = compare(&reader, packing, path, format);
        let (read, source) = read.map_err(|refusal| self.refused(refusal, path, scene))?;
        let source = source.map(|source| Source {
            scene: scene.to_toml(),
            ..source
        });
        let report = Report::of_file(&read, self.accept);
        let report = match &source {
            Some(source) => report.with_source(source),
            None => report,
        };
        self.output
            .write(&progress, |out| report.write(format.into(), out))?;
        if let (Some(file), Some(unbalanced)) = (&self.unbalanced, &read.unbalanced) {
            let table = unbalanced.table(packing)?;
            write_to("unbalanced", Some(file), |out| {
                table.write(of_ending(file), NumberFormat::F64, out)
            })?;
        }
        drop(progress);
        if read.snapshots > 1 {
            complain(&format!("note: {}", judged(path, &read)));
        }
        Ok(read.comparison.accepted(self.accept))
    }
}

impl Verify {
    /// Returns how the file is read.
    fn reader(&self) -> Result<Reader, Failure> {
        let mut columns = self.preset.map_or_else(Columns::default, Preset::columns);
        if let Some(named) = &self.columns {
            columns = columns.overridden(named);
        }
        if let Some(first) = self.first_id {
            columns = columns.with_first_id(first);
        }
        let by_place = match self.matching {
            None => self.preset.is_some_and(Preset::is_by_place),
            Some(matching) => matching == Matching::Place,
        };
        if !by_place && self.within.is_some() {
            let reason = "--within is of --match place: leave it out, or name places";
            return Err(Failure::Message(reason.into()));
        }
        if by_place && self.first_id.is_some() {
            let reason = "--first-id is of --match numbers: by place no numbers are read";
            return Err(Failure::Message(reason.into()));
        }
        let reader = Reader::new().with_columns(columns);
        let reader = match &self.unbalanced {
            Some(_) => reader.with_balance(),
            None => reader,
        };
        if !by_place {
            return Ok(reader);
        }
        let within = self.within.unwrap_or(Reader::WITHIN);
        let blamed = |refusal| Failure::Message(format!("--within: {refusal}"));
        reader.by_place(within).map_err(blamed)
    }

    fn refused(&self, refusal: Refusal, path: &Path, scene: &Scene) -> Failure {
        let name = name(path);
        Failure::Message(match refusal {
            Refusal::Scene(error) => return error.into(),
            Refusal::OutOfRange => format!("{}: {refusal}", self.scene.place_of_size(scene)),
            Refusal::Io(error) => return unreadable(name, &error, A_FILE_OR_STDIN),
            refusal @ Refusal::Line {
                fault: Fault::NoColumn { .. } | Fault::NoNamedColumn { .. },
                ..
            } => {
                format!("FILE: {name}, {refusal}; --columns says which they are")
            }
            refusal => format!("FILE: {name}, {refusal}"),
        })
    }
}

/// Reads a file, or stdin, and compares it; says what was read where the answer is a record.
fn compare(
    reader: &Reader,
    packing: &Packing<'_>,
    path: &Path,
    format: Format,
) -> Result<(Compared, Option<Source>), Refusal> {
    let input: Box<dyn BufRead> = if path == Path::new("-") {
        Box::new(io::stdin().lock())
    } else {
        Box::new(BufReader::with_capacity(1 << 16, File::open(path)?))
    };
    if format != Format::Json {
        return Ok((reader.compare(packing, input)?, None));
    }
    let mut input = Hashed::new(input);
    let read = reader.compare(packing, &mut input)?;
    let (bytes, sha256) = input.finish();
    let source = Source {
        scene: String::new(),
        file: name(path),
        bytes,
        sha256,
    };
    Ok((read, Some(source)))
}

fn name(path: &Path) -> String {
    if path == Path::new("-") {
        "stdin".into()
    } else {
        path.display().to_string()
    }
}

fn judged(path: &Path, read: &Compared) -> String {
    let (name, snapshots) = (name(path), read.snapshots);
    let step = read
        .timestep
        .map(|step| format!(", of time step {step},"))
        .unwrap_or_default();
    format!("{name} has {snapshots} snapshots; the last{step} is judged")
}

/// The format that a file's ending asks for.
fn of_ending(file: &Path) -> FileFormat {
    let is_json = file.extension().is_some_and(|ending| ending == "json");
    if is_json {
        FileFormat::Json
    } else {
        FileFormat::Csv
    }
}

/// An accepted error.
fn tolerance(text: &str) -> Result<f64, String> {
    let given = text.parse::<f64>().ok();
    // Not -0 either: it would be shown.
    let given = given.filter(|error| error.is_finite() && error.is_sign_positive());
    given.ok_or_else(|| "not a relative error such as 1e-6, or 0".to_owned())
}
