//! The command line: parse, call, print. No mathematics.

mod options;

use std::io::{self, BufWriter, Write};
use std::process::ExitCode;

use cannonpile::export::{NumberFormat, Table, Units, WriteError, tables, write_aside};
use cannonpile::scene::Scene;
use cannonpile::theorem::{self, Listing};
use cannonpile::{Error, Pile};
use clap::Parser;
use clap::error::ErrorKind;

use options::{Arguments, Command, Format, Numbers, Output, UnitSystem};

/// The answer is no.
const NO: u8 = 1;

/// Bad use: nothing on stdout, one line on stderr.
const BAD_USE: u8 = 2;

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => return usage(&error),
    };
    match run(&arguments.command) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(NO),
        // Whoever reads has seen enough.
        Err(WriteError::Io(error)) if error.kind() == io::ErrorKind::BrokenPipe => {
            ExitCode::SUCCESS
        }
        Err(WriteError::Answer(error)) => {
            complain(&format!("error: {}{error}", option_of(&error)));
            ExitCode::from(BAD_USE)
        }
        Err(error) => {
            let target = arguments.command.output().target();
            let reason = match &error {
                // The text of an error may name the file written aside; its kind does not.
                WriteError::Io(error) => error.kind().to_string(),
                other => other.to_string(),
            };
            let remedy = "choose a place that exists and can be written";
            complain(&format!("error: cannot write {target}: {reason}; {remedy}"));
            ExitCode::from(BAD_USE)
        }
    }
}

/// Answers, and tells whether the answer is yes.
fn run(command: &Command) -> Result<bool, WriteError> {
    match command {
        Command::Summary {
            scene,
            numbers,
            output,
        } => {
            let (scene, pile) = scene.read()?;
            let units = units(&scene, &pile, numbers)?;
            // At the default spacing, where none is given: if that fits.
            let touching = pile.clearance().check(&scene.spacing()?).ok();
            let table = tables::summary(&units, touching.as_deref())?;
            write_table(table, numbers, output)?;
        }
        Command::Base {
            scene,
            at,
            numbers,
            output,
        } => {
            let (scene, pile) = scene.read()?;
            let selection = at.on_base(&pile)?;
            let table = tables::base(&units(&scene, &pile, numbers)?, selection)?;
            write_table(table, numbers, output)?;
        }
        Command::Contacts {
            scene,
            part,
            numbers,
            output,
        } => {
            let (scene, pile) = scene.read()?;
            let selection = part.selection(&pile)?;
            let table = tables::contacts(&units(&scene, &pile, numbers)?, selection)?;
            write_table(table, numbers, output)?;
        }
        Command::Spheres {
            scene,
            part,
            numbers,
            output,
        } => {
            let (scene, pile) = scene.read()?;
            let selection = part.selection(&pile)?;
            let table = tables::spheres(&scene.packing(&pile)?, selection)?;
            write_table(table, numbers, output)?;
        }
        Command::Prove { theorem, output } => return prove(theorem.as_deref(), output),
    }
    Ok(true)
}

fn units<'p>(scene: &Scene, pile: &'p Pile, numbers: &Numbers) -> Result<Units<'p>, Error> {
    Ok(match numbers.units {
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
            let table = tables::theorems(proved.into_iter());
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

fn write_table(table: Table<'_>, numbers: &Numbers, output: &Output) -> Result<(), WriteError> {
    write(output, |out| {
        table.write(output.format.into(), numbers.number.into(), out)
    })
}

/// To the file, whole or not at all, or to stdout.
fn write(
    output: &Output,
    content: impl FnOnce(&mut dyn Write) -> Result<(), WriteError>,
) -> Result<(), WriteError> {
    if let Some(path) = &output.file {
        return write_aside(path, content);
    }
    let mut out = BufWriter::new(io::stdout().lock());
    content(&mut out)?;
    Ok(out.flush()?)
}

/// The option to change, as a prefix of the message.
fn option_of(error: &Error) -> String {
    match error {
        Error::Layers { .. } | Error::TooManyRows { .. } => "--layers: ".into(),
        Error::SinPhi { .. } | Error::SinPhiOfDiscs | Error::NoSpacing { .. } => {
            "--sin-phi: ".into()
        }
        Error::Overlap { .. } | Error::TooFlat { .. } => "--spacing: ".into(),
        Error::NotPositive { quantity, .. } => format!("--{quantity}: "),
        // The other texts are read, and named, by the parser of the options.
        Error::Syntax { .. } | Error::SiteOutside { .. } | Error::NotOnFloor { .. } => {
            "--at: ".into()
        }
        Error::LayerOutside { .. } => "--layer: ".into(),
        Error::Overflow { .. } => "--number: ".into(),
        _ => String::new(),
    }
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
