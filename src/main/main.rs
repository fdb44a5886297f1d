//! The command line: parse, call, print. No mathematics.

mod args;
mod command;
mod output;
mod progress;
mod signals;

use std::io;
use std::process::ExitCode;

use cannonpile::table::WriteError;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory, Parser, Subcommand};

use args::SceneOptions;
use command::{
    Base, Census, Command, Completions, Contacts, Explain, Export, Plot, Prove, Spheres, Summary,
    Verify, WriteScene,
};
use output::{Failure, complain, reason};

const START: &str = "\
Examples:
  cannonpile base --layers 10              the force of each bottom sphere on the floor
  cannonpile summary --stacking hcp        whether ten layers of HCP stand
  cannonpile export pile --to lammps       input for LAMMPS, and
  cannonpile verify pile/forces.dump       what it measured against the exact forces

'cannonpile COMMAND --help' says more of each. Exit status: 0; 1 if the answer is no; 2 for bad use, with one line on
stderr.";

/// Exact contact forces in regular piles of spheres.
#[derive(Parser)]
#[command(version, about, max_term_width = 100, arg_required_else_help = true, after_help = START)]
struct Arguments {
    #[command(subcommand)]
    command: Commands,
}

#[derive(Subcommand)]
enum Commands {
    /// The pile in one row: counts, weight, extreme forces
    Summary(Summary),
    /// The force of each bottom sphere on the floor
    Base(Base),
    /// The force of each contact between two spheres
    Contacts(Contacts),
    /// The place, size and mass of each sphere, in SI units
    Spheres(Spheres),
    /// Which stackings stand, under one sphere or on a base
    Census(Census),
    /// How a question would be answered, what that takes at most, and what it took
    Explain(Explain),
    /// The whole pile as files: tables, input for LAMMPS and YADE, geometry for ParaView; in SI units
    Export(Export),
    /// The scene as a TOML file, which --scene reads
    Scene(WriteScene),
    /// What is proved for every pile, with the proofs; exit status 1 if one fails
    Prove(Prove),
    /// Measured contact forces against the exact ones; exit status 1 if they differ
    Verify(Verify),
    /// A figure, as SVG
    #[command(subcommand, arg_required_else_help = true)]
    Plot(Plot),
    /// A script with which a shell completes commands and options
    Completions(Completions),
}

impl Commands {
    /// Returns the command; or the one that is about all the others.
    fn command(&self) -> Result<&dyn Command, &Completions> {
        Ok(match self {
            Self::Summary(command) => command,
            Self::Base(command) => command,
            Self::Contacts(command) => command,
            Self::Spheres(command) => command,
            Self::Census(command) => command,
            Self::Explain(command) => command,
            Self::Export(command) => command,
            Self::Scene(command) => command,
            Self::Prove(command) => command,
            Self::Verify(command) => command,
            Self::Plot(command) => command,
            Self::Completions(completions) => return Err(completions),
        })
    }

    fn run(&self) -> Result<bool, Failure> {
        match self.command() {
            Ok(command) => command.run(),
            Err(completions) => completions.print(Arguments::command()),
        }
    }
}

/// The answer is no.
const NO: u8 = 1;

/// Bad use: nothing on stdout, one line on stderr.
const BAD_USE: u8 = 2;

fn main() -> ExitCode {
    signals::clean_up_after();
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => return usage(&error),
    };
    let failure = match arguments.command.run() {
        Ok(true) => return ExitCode::SUCCESS,
        Ok(false) => return ExitCode::from(NO),
        Err(failure) => failure,
    };
    let command = arguments.command.command().ok();
    let target = || command.map_or_else(|| "to stdout".into(), Command::target);
    match failure {
        // The reader has seen enough.
        Failure::Write(WriteError::Io(error)) if error.kind() == io::ErrorKind::BrokenPipe => {
            return ExitCode::SUCCESS;
        }
        Failure::Write(WriteError::File { path, error }) => {
            cannot_write(&path.display().to_string(), &reason(&error));
        }
        // The text of an error may name the file written aside; its kind does not.
        Failure::Write(WriteError::Io(error)) => cannot_write(&target(), &reason(&error)),
        Failure::Write(error) => cannot_write(&target(), &error.to_string()),
        Failure::Refused(refused) => {
            let message = SceneOptions::message(command.and_then(Command::scene), &refused);
            complain(&format!("error: {message}"));
        }
        Failure::BadUse(reason) => complain(&format!("error: {reason}")),
    }
    ExitCode::from(BAD_USE)
}

fn cannot_write(target: &str, reason: &str) {
    let remedy = "choose a place that exists, can be written and has room";
    complain(&format!("error: cannot write {target}: {reason}; {remedy}"));
}

/// Prints what clap has to say: help and version as they are, an error in one line with a remedy.
fn usage(error: &clap::Error) -> ExitCode {
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => {
            // Into a closed pipe there is nothing to say.
            let _ = error.print();
            return ExitCode::SUCCESS;
        }
        // A bare command asks for its help: no error, and on stdout.
        ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            let _ = io::Write::write_all(&mut io::stdout(), error.to_string().as_bytes());
            return ExitCode::SUCCESS;
        }
        _ => {}
    }
    let text = error.to_string();
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let said: Vec<&str> = lines
        .take_while(|line| !line.starts_with("Usage:") && !line.starts_with("For more information"))
        .collect();
    // Clap has a remedy where it knows a similar word, or all words there are.
    let advised = [
        ContextKind::SuggestedArg,
        ContextKind::SuggestedSubcommand,
        ContextKind::SuggestedValue,
        ContextKind::ValidValue,
        ContextKind::ValidSubcommand,
    ];
    let advised = advised.into_iter().any(|kind| match error.get(kind) {
        Some(ContextValue::Strings(words)) => !words.is_empty(),
        known => known.is_some(),
    });
    let remedy = match error.kind() {
        _ if advised => String::new(),
        ErrorKind::ArgumentConflict => ": leave one of the two out".into(),
        ErrorKind::UnknownArgument
        | ErrorKind::InvalidSubcommand
        | ErrorKind::InvalidValue
        | ErrorKind::MissingRequiredArgument
        | ErrorKind::TooManyValues
        | ErrorKind::NoEquals => format!("; '{} --help' lists what there is", named_command()),
        _ => String::new(),
    };
    complain(&format!("{}{remedy}", said.join(" ")));
    ExitCode::from(BAD_USE)
}

/// Returns the command that the line begins with, as far as there is one.
fn named_command() -> String {
    let mut command = Arguments::command();
    let mut names = String::from("cannonpile");
    for word in std::env::args().skip(1) {
        let Some(found) = command.find_subcommand(&word) else {
            break;
        };
        names = format!("{names} {word}");
        command = found.clone();
    }
    names
}
