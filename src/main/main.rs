//! The command line: parse, call, print. No mathematics.

mod options;

use std::io::{self, BufWriter, Write};
use std::process::ExitCode;

use cannonpile::export::{Table, Units, WriteError, tables, write_aside};
use cannonpile::scene::Scene;
use cannonpile::{Error, Packing, Pile};
use clap::Parser;
use clap::error::ErrorKind;

use options::{Arguments, Command, Output, UnitSystem};

/// Bad use: nothing on stdout, one line on stderr.
const BAD_USE: u8 = 2;

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => return usage(&error),
    };
    match run(&arguments.command) {
        Ok(()) => ExitCode::SUCCESS,
        // Whoever reads has seen enough.
        Err(WriteError::Io(error)) if error.kind() == io::ErrorKind::BrokenPipe => {
            ExitCode::SUCCESS
        }
        Err(WriteError::Answer(error)) => {
            eprintln!("error: {}{error}", option_of(&error));
            ExitCode::from(BAD_USE)
        }
        Err(error) => {
            eprintln!(
                "error: cannot write {}: {error}",
                arguments.command.output().target()
            );
            ExitCode::from(BAD_USE)
        }
    }
}

fn run(command: &Command) -> Result<(), WriteError> {
    let scene = command.scene().read()?;
    let pile = scene.pile()?;
    let output = command.output();
    let table = match command {
        Command::Summary { .. } => {
            // The touching spheres are those at the default spacing only where that fits.
            let packing = scene.packing(&pile);
            let units = units(&scene, &pile, output)?;
            tables::summary(&units, packing.as_ref().ok().map(Packing::touching))
        }
        Command::Base { at, .. } => {
            let selection = at.on_base(&pile)?;
            tables::base(&units(&scene, &pile, output)?, selection)
        }
        Command::Contacts { part, .. } => {
            let selection = part.selection(&pile)?;
            tables::contacts(&units(&scene, &pile, output)?, selection)
        }
        Command::Spheres { part, .. } => {
            let selection = part.selection(&pile)?;
            tables::spheres(&scene.packing(&pile)?, selection)
        }
    }?;
    write(table, output)
}

fn units<'p>(scene: &Scene, pile: &'p Pile, output: &Output) -> Result<Units<'p>, Error> {
    Ok(match output.units {
        UnitSystem::Pile => Units::of_pile(pile),
        UnitSystem::Si => Units::of_packing(scene.packing(pile)?),
    })
}

fn write(table: Table<'_>, output: &Output) -> Result<(), WriteError> {
    let (format, numbers) = (output.format.into(), output.number.into());
    if let Some(path) = &output.file {
        return write_aside(path, |out| table.write(format, numbers, out));
    }
    let mut out = BufWriter::new(io::stdout().lock());
    table.write(format, numbers, &mut out)?;
    Ok(out.flush()?)
}

/// The option to change, as a prefix of the message.
fn option_of(error: &Error) -> String {
    match error {
        Error::Layers { .. } => "--layers: ".into(),
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

/// What clap has to say: help and version as it is, an error in one line.
fn usage(error: &clap::Error) -> ExitCode {
    if matches!(
        error.kind(),
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion
    ) {
        return match error.print() {
            Ok(()) => ExitCode::SUCCESS,
            Err(_) => ExitCode::from(BAD_USE),
        };
    }
    let text = error.to_string();
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let told: Vec<&str> = lines
        .take_while(|line| !line.starts_with("Usage:") && !line.starts_with("For more information"))
        .collect();
    eprintln!("{}", told.join(" "));
    ExitCode::from(BAD_USE)
}
