//! `verify`: compares measured contact forces with the exact ones.

mod refinement;

use std::io::{self, BufReader, Write};
use std::path::{Path, PathBuf};

use cannonpile::Packing;
use cannonpile_dem::scene::{Floor, Scene};
use cannonpile_dem::table::{FileFormat, NumberFormat};
use cannonpile_dem::verify::{
    Columns, Compared, DialectOptions, Mark, Preset, Reader, Refusal, Report, Separator, Source,
    TextEncoding,
};
use clap::{Args, ValueEnum};
use contact_tables::Error;

use super::note_instability;
use crate::args::{Format, Output, SceneOptions, in_state};
use crate::input::{Input, name_of};
use crate::output::{Failure, READABLE_FILE_OR_STDIN, print_message, unreadable, write_to};
use crate::progress::Progress;

const HELP: &str = "\
Error of a contact: relative to its exact force, or to the largest exact force if its own is 0. A contact that is listed
with force 0 is measured, with an error of 1. A pair may be in two rows, once in each order; the worse row counts.

Pairs of spheres without an exact contact are extra, or noise if their force is below --accept times the largest force.
Pairs of bottom spheres are fixed, and not compared, unless the floor is rough. A bottom sphere paired with a number outside the pile touches the floor
or a wall: the vertical forces on it are compared with the exact normal force of the floor.

With --floor rough, tangential forces are compared too. They are in the columns tx, ty, tz, and fx, fy, fz is then the normal
force. Without these columns, fx, fy, fz is the whole force. --floor-table adds the forces of the floor: one row for each
bottom sphere, with columns of these names and a dialect that its first lines decide. The friction of the floor is compared,
and the largest sum of moments on a sphere is reported.

The first line of the report is the verdict with its reason; the others say what else there is to say. Findings explain the
differences: a constant factor, one sphere of another mass, soft springs, swapped axes, and so on. --format csv and json have the full
record; json also has the scene, the SHA-256 of the file and the version of this program. Without scene options, the file
scene.toml beside FILE is read.

The kind of FILE is known by its content: a text table, a LAMMPS dump local file, a VTK file (.vtp, .vtu, .vtk), or a file of
ParaView that names the pieces of one table (.pvtp, .pvtu). It may be compressed by gzip. Of a text table the first
lines decide the dialect: separator, quotes, comments, decimal sign, header, row of units. The report shows it, and the
options under Table override it. Only the columns that are needed are read.

--columns takes names of the header, or #N for the N-th column. It accepts signs, factors and sums: fx=-#10-#13, fx=fx-tx,
force=1e7*overlap. A name with a comma is quoted: force=\"Force, normal\". kind=contact_type:SS reads only rows with SS in
this column; the other rows are contacts with walls. step=time names the column of the time step: the last one is read, or
that of --step. With two centres x1…z2, fx,fy,fz is the force on the first sphere. With a contact point x,y,z, the force is
compressive unless force is negative.

Refinement study: --refinement takes a file for each stiffness or time step. It prints the error of each level and the observed
order of accuracy. The exit status is 1 if the errors show no order.

Examples:
  cannonpile verify pile/forces.dump --layers 10 --spacing 1.2
  cannonpile verify measured.csv --scene pile.toml --accept 1e-3
  cannonpile verify contacts.txt --columns id1=A,id2=B,force=Fn --first-id 0 --layers 10 --spacing 1.2
  cannonpile verify Contact_pairs_0100.csv --preset dem-engine --scene pile.toml --accept 1e-3
  cannonpile verify --refinement 1e5=soft.csv,1e6=firm.csv,1e7=stiff.csv --scene pile.toml
  cannonpile verify table.csv.gz --separator ';' --decimal comma --step 500 --scene pile.toml
  cannonpile verify pile/forces.dump --layers 2 --floor rough --floor-table pile/floor.dump --accept 1e-5
  cannonpile verify forces.csv --match place --columns x=cx,y=cy,z=cz --scene pile.toml --unbalanced rest.csv";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Verify {
    /// Table with columns id1, id2, force or fx, fy, fz; LAMMPS dump local file; or VTK file; - for stdin
    #[arg(value_name = "FILE", required_unless_present = "refinement")]
    measured: Option<PathBuf>,
    /// Refinement study: a file for each stiffness or time step, in place of FILE
    #[arg(
        long,
        value_name = "K1=FILE1,K2=FILE2,...",
        value_delimiter = ',',
        value_parser = level_file,
        conflicts_with_all = ["measured", "unbalanced"],
        help_heading = "Refinement study"
    )]
    refinement: Option<Vec<LevelFile>>,
    /// Refinement parameter of --refinement [default: stiffness]
    #[arg(
        long,
        value_enum,
        value_name = "WHAT",
        help_heading = "Refinement study"
    )]
    parameter: Option<Parameter>,
    #[command(flatten)]
    pub(crate) scene: Option<SceneOptions>,
    /// Largest accepted relative error; 0 requires correctly rounded forces
    #[arg(long, value_name = "E", default_value = "1e-6", allow_hyphen_values = true, value_parser = tolerance, help_heading = "Output")]
    accept: f64,
    /// Columns for id1, id2, force, fx, fy, fz, tx, ty, tz (tangential), x1 … z2 (centres), x, y, z (contact point), kind and step
    #[arg(
        long,
        value_name = "QUANTITY=COLUMN,...",
        allow_hyphen_values = true,
        help_heading = "Table"
    )]
    columns: Option<Columns>,
    /// Columns of a known code: lammps, yade, exadem, exadem-vtp, dem-engine, kratos, mddem (also DIRT), lethe or mercurydpm;
    /// --columns overrides them
    #[arg(long, value_name = "CODE", help_heading = "Table")]
    preset: Option<Preset>,
    /// Matching of the contacts of table and scene [default: numbers, or that of the preset]
    #[arg(long = "match", value_enum, value_name = "BY", help_heading = "Table")]
    matching: Option<Matching>,
    /// Largest distance of a sphere from its exact position, in R, for --match place [default: 0.1]
    #[arg(long, value_name = "SHARE", allow_hyphen_values = true, value_parser = tolerance, help_heading = "Table")]
    within: Option<f64>,
    /// Number of the first sphere [default: 1, or that of the preset]
    #[arg(long, value_name = "N", help_heading = "Table")]
    first_id: Option<u64>,
    /// File with the force of the floor on each sphere: columns id, fx, fy, fz, and possibly tx, ty, tz
    #[arg(
        long,
        value_name = "FILE",
        conflicts_with = "refinement",
        help_heading = "Table"
    )]
    floor_table: Option<PathBuf>,
    #[command(flatten)]
    dialect: DialectArgs,
    /// Step to read of a file with several, by its number or time [default: the last]
    #[arg(
        long,
        value_name = "STEP",
        allow_hyphen_values = true,
        help_heading = "Table"
    )]
    step: Option<String>,
    /// File for the residual force on each sphere above the floor, in N: csv, or json if it has this extension
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    unbalanced: Option<PathBuf>,
    #[command(flatten)]
    output: Output,
}

/// The dialect of a text table. Its first lines decide what is not given.
#[derive(Args)]
struct DialectArgs {
    /// Separator of cells: one character, tab or blanks [default: what makes most cells numbers]
    #[arg(long, value_name = "MARK", help_heading = "Table")]
    separator: Option<Separator>,
    /// Decimal sign [default: point, unless there are only commas]
    #[arg(long, value_enum, value_name = "MARK", help_heading = "Table")]
    decimal: Option<Decimal>,
    /// Quote around cells, or none [default: \" or ']
    #[arg(long, value_name = "MARK", help_heading = "Table")]
    quote: Option<Mark<char>>,
    /// Beginning of a comment, or none [default: #, %, // or !]
    #[arg(long, value_name = "MARK", help_heading = "Table")]
    comment: Option<Mark<String>>,
    /// Number of lines above the table [default: those above the header]
    #[arg(long, value_name = "N", help_heading = "Table")]
    skip: Option<u64>,
    /// true if a row of units follows the header, false if not [default: true if the row has no number]
    #[arg(long, value_name = "BOOL", help_heading = "Table")]
    unit_row: Option<bool>,
    /// Encoding, such as utf-16le or windows-1252 [default: UTF-8, UTF-16 with a byte order mark, or windows-1252]
    #[arg(long, value_name = "NAME", help_heading = "Table")]
    encoding: Option<TextEncoding>,
}

/// The decimal sign.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Decimal {
    /// 0.5
    Point,
    /// 0,5
    Comma,
}

impl DialectArgs {
    fn options(&self) -> DialectOptions {
        DialectOptions {
            encoding: self.encoding,
            separator: self.separator,
            quote: self.quote.clone(),
            comment: self.comment.clone(),
            decimal_comma: self.decimal.map(|decimal| decimal == Decimal::Comma),
            skip: self.skip,
            unit_row: self.unit_row,
        }
    }
}

/// The parameter of a refinement study.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Parameter {
    /// Spring stiffness k, in N/m; errors fall as 1/k
    Stiffness,
    /// Time step, in s
    TimeStep,
}

/// The method that matches contacts.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Matching {
    /// Numbers of the two spheres, in the order of the exports
    Numbers,
    /// Positions: both centres or the contact point, which may be shifted, turned about the vertical, mirrored, with any axes
    Place,
}

impl Verify {
    /// Returns whether the file is accepted, or whether the errors of the refinement study show an order.
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let is_stdin = |path: &Option<PathBuf>| path.as_deref() == Some(Path::new("-"));
        let given = [
            ("FILE", is_stdin(&self.measured)),
            ("--floor-table", is_stdin(&self.floor_table)),
            ("--scene", SceneOptions::is_from_stdin(self.scene.as_ref())),
        ];
        let from_stdin = given.iter().filter(|(_, is_stdin)| *is_stdin);
        if let [(one, _), (other, _), ..] = from_stdin.collect::<Vec<_>>()[..] {
            return Err(Failure::Message(format!(
                "{one} and {other} are both -: only one of them can come from stdin, give a file for the other"
            )));
        }
        if self.parameter.is_some() && self.refinement.is_none() {
            let reason = "--parameter requires --refinement: add it, or leave out --parameter";
            return Err(Failure::Message(reason.into()));
        }
        let (options, scene_file) = match (&self.scene, &self.measured) {
            (Some(options), _) => (options.clone(), None),
            (None, Some(table)) => SceneOptions::beside(table)?,
            (None, None) => Default::default(),
        };
        let (scene, pile) = options.read_any()?;
        let pile = in_state(&scene, pile)?;
        let packing = scene.packing(&pile)?;
        let verdict = match (&self.measured, &self.refinement) {
            (Some(path), _) => self.compare_file(path, scene_file.as_deref(), &scene, &packing)?,
            (None, Some(_)) if scene.floor == Floor::Rough => {
                let reason = "--refinement: its theory has no friction: leave out --floor rough, or give one FILE";
                return Err(Failure::Message(reason.into()));
            }
            (None, Some(files)) => self.compare_refinement(files, &scene, &packing)?,
            // The parser requires one of the two.
            (None, None) => false,
        };
        note_instability(&pile);
        Ok(verdict)
    }

    /// Compares one file.
    fn compare_file(
        &self,
        path: &Path,
        scene_file: Option<&str>,
        scene: &Scene,
        packing: &Packing<'_>,
    ) -> Result<bool, Failure> {
        let format = self.output.format()?;
        let reader = self.reader()?.on_floor(scene.floor);
        let progress = Progress::begin("comparing the measured forces with the exact ones");
        let read = compare(
            &reader,
            packing,
            (path, self.floor_table.as_deref()),
            format,
        );
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
        let report = report.with_scene_file(scene_file);
        let content = |out: &mut dyn Write| report.write(format.into(), out);
        self.output.write_with(&progress, content, None, || {
            let Some(file) = &self.unbalanced else {
                return Ok(());
            };
            let table = read.unbalanced.table(packing)?;
            write_to("unbalanced", Some(file), |out| {
                table.write(format_of_extension(file), NumberFormat::F64, out)
            })
        })?;
        drop(progress);
        if let Some(note) = other_steps(path, &read) {
            print_message(&note);
        }
        Ok(read.comparison.accepted(self.accept))
    }
}

impl Verify {
    /// Returns the reader that the options describe.
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
            let reason = "--within requires --match place: add it, or leave out --within";
            return Err(Failure::Message(reason.into()));
        }
        if by_place && self.first_id.is_some() {
            let reason = "--first-id requires --match numbers: add it, or leave out --first-id";
            return Err(Failure::Message(reason.into()));
        }
        let reader = Reader::new()
            .with_columns(columns)
            .with_dialect(self.dialect.options());
        let reader = match &self.step {
            Some(step) => reader.with_step(step.clone()),
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
        let (name, is_measured, refusal) = match (refusal, &self.floor_table) {
            (Refusal::FloorTable(refusal), Some(floor)) => (
                format!("--floor-table: {}", name_of(floor)),
                false,
                *refusal,
            ),
            (refusal, _) => (name_of(path), true, refusal),
        };
        Failure::Message(match refusal {
            Refusal::Scene(error) => return error.into(),
            Refusal::OutOfRange => format!(
                "{}: {refusal}",
                self.scene.clone().unwrap_or_default().place_of_size(scene)
            ),
            Refusal::Table(Error::Io(error)) if error.kind() == io::ErrorKind::InvalidData => {
                format!("{name}, {error}: compress it again, or give it as it is")
            }
            Refusal::Table(Error::Io(error)) => {
                return unreadable(name, &error, READABLE_FILE_OR_STDIN);
            }
            refusal @ Refusal::Table(Error::NoColumn { .. }) if is_measured => {
                format!("{name}, {refusal}; --columns can name them")
            }
            refusal => {
                let mut text = refusal.to_string();
                for (said, option) in OPTIONS.iter().filter(|_| is_measured) {
                    text = text.replace(said, option);
                }
                format!("{name}, {text}")
            }
        })
    }
}

/// The remedies of the reader of tables, and the options for them.
const OPTIONS: [(&str, &str); 4] = [
    ("set quote to", "use --quote"),
    ("set comment to", "use --comment"),
    ("set decimal to", "use --decimal"),
    ("one of them as step", "one of them with --step"),
];

/// Reads a file or stdin and compares it. For json output the result includes the source of the data.
fn compare(
    reader: &Reader,
    packing: &Packing<'_>,
    (path, floor): (&Path, Option<&Path>),
    format: Format,
) -> Result<(Compared, Option<Source>), Refusal> {
    let reader = &reader_in_folder(reader, path);
    let is_hashed = format == Format::Json;
    let in_floor = |error: io::Error| Refusal::FloorTable(Box::new(error.into()));
    let mut input = Input::open(path, is_hashed)?;
    let Some(floor) = floor else {
        let read = reader.compare(packing, &mut input)?;
        return Ok((read, source(path, input, None)?));
    };
    let mut floor_input = Input::open(floor, is_hashed).map_err(in_floor)?;
    let read = reader.compare_with_floor(packing, &mut input, &mut floor_input)?;
    let floor = source(floor, floor_input, None).map_err(in_floor)?;
    Ok((read, source(path, input, floor)?))
}

/// Returns the origin of hashed data, without the scene.
fn source(
    path: &Path,
    input: BufReader<Input>,
    floor: Option<Source>,
) -> io::Result<Option<Source>> {
    let hashed = input.into_inner().finish()?;
    Ok(hashed.map(|(bytes, sha256)| Source {
        scene: String::new(),
        file: name_of(path),
        bytes,
        sha256,
        floor: floor.map(Box::new),
    }))
}

/// Returns the reader, which knows the folder of a file.
fn reader_in_folder(reader: &Reader, path: &Path) -> Reader {
    let reader = reader.clone();
    match path.parent() {
        Some(folder) if path != Path::new("-") => reader.in_folder(folder.to_owned()),
        _ => reader,
    }
}

/// Returns a note on the steps of a file that were not compared.
fn other_steps(path: &Path, read: &Compared) -> Option<String> {
    let (name, steps) = (name_of(path), read.steps);
    let step = read.step.as_ref().filter(|_| steps > 1)?;
    Some(format!(
        "note: {name} has {steps} steps; this report is about step {step}"
    ))
}

/// Returns the format that the file name extension stands for: JSON or CSV.
fn format_of_extension(file: &Path) -> FileFormat {
    let is_json = file.extension().is_some_and(|ending| ending == "json");
    if is_json {
        FileFormat::Json
    } else {
        FileFormat::Csv
    }
}

/// A file with the forces of one simulation, and its stiffness or time step.
type LevelFile = (f64, PathBuf);

/// Parses `K=FILE`.
fn level_file(text: &str) -> Result<LevelFile, &'static str> {
    let (parameter, path) = text
        .split_once('=')
        .filter(|(_, path)| !path.is_empty())
        .ok_or("has no = with a file after it: write PARAMETER=FILE, as in 1e6=stiff.csv")?;
    let no_number = |_| "give the stiffness or the time step before the =, as in 1e6=stiff.csv";
    let parameter = parameter.trim().parse().map_err(no_number)?;
    Ok((parameter, path.into()))
}

/// Parses a relative error that is finite and not negative.
fn tolerance(text: &str) -> Result<f64, String> {
    let given = text.parse::<f64>().ok();
    // -0 is rejected too, because the report would print it.
    let given = given.filter(|error| error.is_finite() && error.is_sign_positive());
    given.ok_or_else(|| "not a relative error such as 1e-6, or 0".to_owned())
}
