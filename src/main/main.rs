//! The command line: parse, call, print. No mathematics.

mod completions;
mod export;
mod options;
mod plot;
mod scene;
mod verify;

use std::io::{self, BufWriter, Write};
use std::path::Path;
use std::process::ExitCode;

use cannonpile::census::{self, Entry};
use cannonpile::scene::Scene;
use cannonpile::table::{
    self, Explanation, NumberFormat, Summary, Table, Units, WriteError, write_aside,
};
use cannonpile::theorem::{self, Listing};
use cannonpile::{Error, Pile, Verdict};
use clap::Parser;
use clap::error::ErrorKind;

use options::{Arguments, Command, Format, Output, Refused, UnitSystem};

/// The answer is no.
const NO: u8 = 1;

/// Bad use: nothing on stdout, one line on stderr.
const BAD_USE: u8 = 2;

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => return usage(&error),
    };
    let command = &arguments.command;
    match run(command) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(NO),
        // Whoever reads has seen enough.
        Err(Failure::Write(WriteError::Io(error))) if error.kind() == io::ErrorKind::BrokenPipe => {
            ExitCode::SUCCESS
        }
        Err(Failure::Write(WriteError::Answer(error))) => refuse(command, &error.into()),
        Err(Failure::Refused(refused)) => refuse(command, &refused),
        Err(Failure::Write(WriteError::File { path, error })) => {
            cannot_write(&path.display().to_string(), &error.kind().to_string())
        }
        Err(Failure::Told(reason)) => {
            complain(&format!("error: {reason}"));
            ExitCode::from(BAD_USE)
        }
        Err(Failure::Write(error)) => {
            let reason = match &error {
                // The text of an error may name the file written aside; its kind does not.
                WriteError::Io(error) => error.kind().to_string(),
                other => other.to_string(),
            };
            cannot_write(&command.target(), &reason)
        }
    }
}

fn cannot_write(target: &str, reason: &str) -> ExitCode {
    let remedy = "choose a place that exists, can be written and has room";
    complain(&format!("error: cannot write {target}: {reason}; {remedy}"));
    ExitCode::from(BAD_USE)
}

/// Why there is no answer.
enum Failure {
    Refused(Refused),
    Write(WriteError),
    /// What is wrong, and with what.
    Told(String),
}

impl From<Refused> for Failure {
    fn from(refused: Refused) -> Self {
        Self::Refused(refused)
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self::Refused(error.into())
    }
}

impl From<WriteError> for Failure {
    fn from(error: WriteError) -> Self {
        Self::Write(error)
    }
}

fn refuse(command: &Command, Refused { option, error }: &Refused) -> ExitCode {
    let option = option.or_else(|| option_of(error));
    let place = |option| match command.scene().and_then(|scene| scene.line_of(option)) {
        Some(line) => format!("{line}: "),
        None => format!("--{option}: "),
    };
    let place = option.map_or_else(String::new, place);
    let note = command.scene().and_then(|scene| scene.note(error));
    let note = note.unwrap_or_default();
    complain(&format!("error: {place}{error}{note}"));
    ExitCode::from(BAD_USE)
}

/// Answers, and tells whether the answer is yes.
fn run(command: &Command) -> Result<bool, Failure> {
    match command {
        Command::Summary {
            scene,
            numbers,
            output,
        } => {
            let (scene, pile) = scene.read()?;
            let units = units(&scene, &pile, numbers.units)?;
            // At the default spacing, where none is given: if that fits.
            let touching = pile.clearance().check(&scene.spacing()?).ok();
            let summary = Summary::new(&units, touching)?;
            write_table(summary.table()?, numbers.number, output)?;
            return Ok(matches!(summary.verdict(), None | Some(Verdict::Yes)));
        }
        Command::Base {
            scene,
            at,
            numbers,
            method,
            output,
        } => {
            let (scene, pile) = scene.read()?;
            let selection = at.on_base(&pile)?;
            let units = method.of(units(&scene, &pile, numbers.units)?)?;
            let table = table::base(&units, selection)?;
            write_table(table, numbers.number, output)?;
            warn_if_it_falls(&pile);
        }
        Command::Contacts {
            scene,
            part,
            numbers,
            method,
            output,
        } => {
            let (scene, pile) = scene.read()?;
            let selection = part.selection(&pile)?;
            let units = method.of(units(&scene, &pile, numbers.units)?)?;
            let table = table::contacts(&units, selection)?;
            write_table(table, numbers.number, output)?;
            warn_if_it_falls(&pile);
        }
        Command::Spheres {
            scene,
            part,
            numbers,
            output,
        } => {
            let (scene, pile) = scene.read()?;
            let selection = part.selection(&pile)?;
            let table = table::spheres(&scene.packing(&pile)?, selection)?;
            write_table(table, numbers.number, output)?;
            warn_if_it_falls(&pile);
        }
        Command::Census {
            layers,
            base,
            standing,
            number,
            output,
        } => {
            let table = match base {
                None => table::census(census::under_one_sphere(*layers, !standing)?),
                Some(base) => {
                    let entries =
                        census::on_base(*base).map_err(|error| Refused::of("base", error))?;
                    let wanted = |entry: &Result<Entry, Error>| {
                        !standing || entry.as_ref().map_or(true, Entry::stands)
                    };
                    table::census(entries.filter(move |entry| wanted(entry)))
                }
            };
            write_table(table, *number, output)?;
        }
        Command::Explain {
            scene,
            of,
            part,
            units: system,
            method,
            no_run,
            output,
        } => {
            let (scene, pile) = scene.read()?;
            let part = of.part(part.selection(&pile)?, &pile);
            let (quantity, system) = of.quantity(*system);
            let units = method.of(units(&scene, &pile, system)?)?;
            explain(&Explanation::new(&units, quantity, part)?, *no_run, output)?;
        }
        Command::Export(export) => export::run(export)?,
        Command::Verify(verify) => return verify.run(),
        Command::Scene(command) => command.run()?,
        Command::Completions(command) => command.run()?,
        Command::Plot(figure) => figure.run()?,
        Command::Prove { theorem, output } => return Ok(prove(theorem.as_deref(), output)?),
    }
    Ok(true)
}

/// The plan, before anything is run, and then what was counted.
fn explain(explanation: &Explanation<'_>, no_run: bool, output: &Output) -> Result<(), WriteError> {
    let format = output.format;
    if !no_run {
        explanation.check()?;
    }
    write(output, |out| {
        if format != Format::Table || no_run {
            let counters = (!no_run).then(|| explanation.run()).transpose()?;
            let table = explanation.table(counters.as_ref());
            return table.write(format.into(), NumberFormat::Exact, out);
        }
        let mut write = |table: Table<'_>| {
            table.write(format.into(), NumberFormat::Exact, out)?;
            Ok::<_, WriteError>(out.flush()?)
        };
        write(explanation.table(None))?;
        write(Explanation::counted(&explanation.run()?))
    })
}

/// One line on stderr for forces that no pile can bear.
fn warn_if_it_falls(pile: &Pile) {
    if pile.is_weightless() {
        return;
    }
    let told = match pile.first_failure() {
        Ok(failure) => failure.map(|layer| {
            format!(
                "note: this pile does not stand without further contacts: below layer {layer} spheres would have to \
                 pull; its forces are the only balance there is"
            )
        }),
        Err(error) => Some(format!("note: whether this pile stands is not known: {error}")),
    };
    if let Some(told) = told {
        complain(&told);
    }
}

fn units<'p>(scene: &Scene, pile: &'p Pile, system: UnitSystem) -> Result<Units<'p>, Error> {
    Ok(match system {
        UnitSystem::Pile => Units::of_pile(pile),
        UnitSystem::Si => Units::of_packing(scene.packing(pile)?),
    })
}

fn prove(name: Option<&str>, output: &Output) -> Result<bool, WriteError> {
    let wanted = theorem::all().filter(|theorem| name.is_none_or(|name| theorem.name == name));
    let proved: Vec<_> = wanted.map(|theorem| (theorem, theorem.prove())).collect();
    let all_hold = proved.iter().all(|(_, proof)| proof.holds());
    write(output, |out| {
        if output.format != Format::Table {
            let table = table::theorems(proved.into_iter());
            return table.write(output.format.into(), NumberFormat::Exact, out);
        }
        for (place, (theorem, proof)) in proved.iter().enumerate() {
            let gap = if place > 0 { "\n" } else { "" };
            let whole = name.is_some();
            write!(
                out,
                "{gap}{}",
                Listing {
                    theorem,
                    proof,
                    whole
                }
            )?;
        }
        if name.is_none() {
            let holding = proved.iter().filter(|(_, proof)| proof.holds()).count();
            writeln!(out, "\n{holding} of {} theorems hold", proved.len())?;
        }
        Ok(())
    })?;
    Ok(all_hold)
}

fn write_table(
    table: Table<'_>,
    number: impl Into<NumberFormat>,
    output: &Output,
) -> Result<(), WriteError> {
    write(output, |out| {
        table.write(output.format.into(), number.into(), out)
    })
}

fn write(
    output: &Output,
    content: impl FnOnce(&mut dyn Write) -> Result<(), WriteError>,
) -> Result<(), WriteError> {
    write_to(output.file.as_deref(), content)
}

/// To the file, whole or not at all, or to stdout.
fn write_to(
    file: Option<&Path>,
    content: impl FnOnce(&mut dyn Write) -> Result<(), WriteError>,
) -> Result<(), WriteError> {
    if let Some(path) = file {
        return write_aside(path, content);
    }
    let mut out = BufWriter::new(io::stdout().lock());
    content(&mut out)?;
    Ok(out.flush()?)
}

/// The option to change.
fn option_of(error: &Error) -> Option<&'static str> {
    Some(match error {
        Error::TooManyMarks { what, .. } if what.ends_with("a layer") => "layer",
        Error::Layers { .. }
        | Error::TooManyRows { .. }
        | Error::TooManyMarks { .. }
        | Error::TooHigh { .. }
        | Error::RegionTooLarge { .. }
        | Error::TooLarge { .. }
        | Error::LayersOfStacking { .. } => "layers",
        Error::NoSuchMethod { .. } => "method",
        Error::TooManyRuns { .. } => "stacking",
        Error::NegativeLoad { .. } => "load",
        Error::Excluded { given, .. } => given,
        Error::SinPhi { .. } | Error::SinPhiOfDiscs | Error::NoSpacing { .. } => "sin-phi",
        Error::Overlap { .. } | Error::TooFlat { .. } => "spacing",
        Error::NotPositive { quantity, .. } => quantity,
        // The other texts are read, and named, by the parser of the options.
        Error::Syntax { .. } | Error::SiteOutside { .. } | Error::NotOnFloor { .. } => "at",
        Error::LayerOutside { .. } => "layer",
        Error::Overflow { .. } => "number",
        _ => return None,
    })
}

/// One line on stderr, whatever the text; if even that is closed, the exit status has to say it.
fn complain(message: &str) {
    let line: String = message
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    let _ = writeln!(io::stderr(), "{line}");
}

/// What clap has to say: help and version as it is, an error in one line.
fn usage(error: &clap::Error) -> ExitCode {
    if matches!(
        error.kind(),
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion
    ) {
        // Into a closed pipe there is nothing to say.
        let _ = error.print();
        return ExitCode::SUCCESS;
    }
    let text = error.to_string();
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let told: Vec<&str> = lines
        .take_while(|line| !line.starts_with("Usage:") && !line.starts_with("For more information"))
        .collect();
    complain(&told.join(" "));
    ExitCode::from(BAD_USE)
}
