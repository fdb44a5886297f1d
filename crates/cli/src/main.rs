//! The command line: parse, call, print. No mathematics.

mod args;
mod command;
mod culprit;
mod error;
mod hashed;
mod output;
mod progress;
mod signals;
mod tables;

use std::io;
use std::process::ExitCode;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory, Parser, Subcommand};

use args::SceneOptions;
use command::forces::{Base, Contacts};
use command::{
    bounds, cases, census, check, completions, ensemble, explain, export, man, mean, plot, prove,
    scene, spheres, summary, verify,
};
use culprit::Culprit;
use error::Error;
use output::{Failure, complain};

const START: &str = "\
Examples:
  cannonpile base --layers 10              the force of each bottom sphere on the floor
  cannonpile summary --stacking hcp        whether ten layers of HCP stand
  cannonpile export pile --to lammps       input for LAMMPS, and
  cannonpile verify pile/forces.dump       what it measured against the exact forces

'cannonpile COMMAND --help' says more about each. Exit status: 0; 1 if the answer is no; 2 for bad use, with one line on
stderr.";

/// Exact contact forces in regular piles of spheres: the stack of cannonballs, in rationals, roots and floats
#[derive(Parser)]
#[command(name = "cannonpile", version, max_term_width = 100, arg_required_else_help = true, after_help = START)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// The pile in one row: counts, weight, extreme forces
    Summary(summary::Summary),
    /// The force of each bottom sphere on the floor
    #[command(after_help = Base::HELP)]
    Base(Base),
    /// The force of each contact between two spheres
    #[command(after_help = Contacts::HELP)]
    Contacts(Contacts),
    /// What each bottom sphere can bear at least and at most at a = R, horizontal contacts included
    Bounds(bounds::Bounds),
    /// The place, size and mass of each sphere, in SI units
    Spheres(spheres::Spheres),
    /// Which stackings stand, under one sphere or on a base
    Census(census::Census),
    /// What the base bears in the mean over random stackings
    Mean(mean::Mean),
    /// Random stackings one by one: how many stand, and how their forces are distributed
    Ensemble(ensemble::EnsembleOf),
    /// Parts of an ensemble, counted apart, put together
    Merge(ensemble::Merge),
    /// How a question would be answered, what that takes at most, and what it took
    Explain(explain::Explain),
    /// The whole pile as files: tables, input for LAMMPS and YADE, geometry for ParaView; in SI units
    Export(export::Export),
    /// The benchmark cases, with names that others can quote
    Cases(cases::Cases),
    /// The scene as a TOML file, which --scene reads
    Scene(scene::WriteScene),
    /// What is proved for every pile, with the proofs; exit status 1 if one fails
    Prove(prove::Prove),
    /// Measured contact forces against the exact ones; exit status 1 if they differ
    Verify(verify::Verify),
    /// A certificate of what a pile with horizontal contacts bears; exit status 1 if it is refused
    Check(check::Check),
    /// A figure, as SVG
    #[command(subcommand, arg_required_else_help = true)]
    Plot(plot::Plot),
    /// A script with which a shell completes commands and options
    Completions(completions::Completions),
    /// Pages of the manual, which man shows, one for each command
    Man(man::Man),
}

impl Command {
    /// Answers, and returns whether the answer is yes.
    fn run(&self) -> Result<bool, Failure> {
        match self {
            Self::Summary(command) => command.run(),
            Self::Base(command) => command.run(),
            Self::Contacts(command) => command.run(),
            Self::Bounds(command) => command.run(),
            Self::Spheres(command) => command.run(),
            Self::Census(command) => command.run(),
            Self::Mean(command) => command.run(),
            Self::Ensemble(command) => command.run(),
            Self::Merge(command) => command.run(),
            Self::Explain(command) => command.run(),
            Self::Export(command) => command.run(),
            Self::Cases(command) => command.run(),
            Self::Scene(command) => command.run(),
            Self::Prove(command) => command.run(),
            Self::Verify(command) => command.run(),
            Self::Check(command) => command.run(),
            Self::Plot(command) => command.run(),
            Self::Completions(command) => command.print(Arguments::command()),
            Self::Man(command) => command.write(Arguments::command()),
        }
    }

    /// Returns the scene options, of a command that has them.
    const fn scene(&self) -> Option<&SceneOptions> {
        Some(match self {
            Self::Summary(command) => &command.scene,
            Self::Base(command) => &command.scene,
            Self::Contacts(command) => &command.scene,
            Self::Bounds(command) => &command.scene,
            Self::Ensemble(command) => &command.scene,
            Self::Spheres(command) => &command.scene,
            Self::Explain(command) => &command.scene,
            Self::Export(command) => &command.scene,
            Self::Scene(command) => &command.scene,
            Self::Verify(command) => &command.scene,
            Self::Plot(command) => return command.scene(),
            Self::Cases(_)
            | Self::Census(_)
            | Self::Mean(_)
            | Self::Merge(_)
            | Self::Prove(_)
            | Self::Check(_)
            | Self::Completions(_)
            | Self::Man(_) => return None,
        })
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
    match arguments.command.run() {
        Ok(true) | Err(Failure::Closed) => return ExitCode::SUCCESS,
        Ok(false) => return ExitCode::from(NO),
        Err(Failure::Refused(refused)) => {
            let message = SceneOptions::message(arguments.command.scene(), &refused);
            complain(&format!("error: {message}"));
        }
        Err(Failure::Message(message)) => complain(&format!("error: {message}")),
    }
    ExitCode::from(BAD_USE)
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
    let said = said.join(" ").replace(" tip: ", "; tip: ");
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
    complain(&format!("{said}{remedy}"));
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
