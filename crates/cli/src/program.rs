//! The program: its commands, their names in help, and how it ends.

use std::io::{self, Write};
use std::process::ExitCode;

use cannonpile::engine::quoted;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory, Parser, Subcommand};

use crate::args::{SceneOptions, Top};
use crate::command::forces::{Base, Contacts};
use crate::command::{
    bounds, cases, census, check, completions, ensemble, explain, export, mean, plot, prove,
    response, scene, sensitivity, spheres, stability, summary, verify,
};
use crate::error::USAGE_ERROR;
use crate::output::{Failure, print_message};
use crate::{progress, signals, threads};

const START: &str = "\
Examples:
  cannonpile base --layers 10              list the force of each bottom sphere on the floor
  cannonpile summary --stacking hcp        check the stability of ten layers of HCP
  cannonpile export pile --to lammps       write input for LAMMPS
  cannonpile verify pile/forces.dump       compare the forces of LAMMPS with the exact ones

'cannonpile COMMAND --help' explains a command.

Exit status: 0 success; 1 the answer is no (unstable, different, rejected); 2 usage error, with one line on stderr.";

/// Exact contact forces in regular piles of spheres
#[derive(Parser)]
#[command(name = "cannonpile", version, max_term_width = 100, arg_required_else_help = true, after_help = START, mut_subcommands(adapted))]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

/// Reads names of values in any case, and hides the scene options that a command refuses from its help.
fn adapted(command: clap::Command) -> clap::Command {
    let refused = match command.get_name() {
        "bounds" => "weightless floor friction floor_friction",
        "summary" => "state stiffness_ratio",
        "spheres" => "floor friction floor_friction",
        "stability" | "response" => {
            "weightless state stiffness_ratio floor friction floor_friction"
        }
        "explain" | "sensitivity" | "ensemble" => {
            "state stiffness_ratio floor friction floor_friction"
        }
        "mean" => {
            "case stacking dimension sin_phi tilt spacing radius mass gravity state stiffness_ratio floor friction floor_friction"
        }
        _ => "",
    };
    let option = |option: clap::Arg| {
        let is_refused = refused
            .split(' ')
            .any(|name| name == option.get_id().as_str());
        let is_hidden = is_refused || option.is_hide_set();
        let has_value = option.get_action().takes_values();
        option.ignore_case(has_value).hide(is_hidden)
    };
    let command = command.mut_args(option).mut_subcommands(adapted);
    if command.get_name() != "mean" {
        return command;
    }
    // Only a mean has an infinite top layer.
    command.mut_arg("top", |top| {
        top.value_parser(Top::region_or_plane).help(
            "Top layer: hexagon:P,Q, hexagon:N, triangle:N, region:x0..x1,y0..y1,s0..s1, or plane (infinite; requires --weightless \
             and --load) [default: one sphere]",
        )
    })
}

#[derive(Subcommand)]
enum Command {
    /// Summarise a pile in one row: counts, weight, stability, extreme forces
    Summary(summary::Summary),
    /// List the force of each bottom sphere on the floor
    #[command(after_help = Base::HELP)]
    Base(Base),
    /// List the force of each contact between two spheres
    #[command(after_help = Contacts::HELP)]
    Contacts(Contacts),
    /// Find the tilt of gravity at which the first contact opens; exit status 1 if the pile is unstable
    Stability(stability::Stability),
    /// List the force of each contact per unit of a load on one sphere
    Response(response::Response),
    /// List the change of each contact force if one sphere is larger, or the effect of deviations of all radii
    Sensitivity(sensitivity::Sensitivity),
    /// Bound the base normal forces at a = R, with horizontal contacts
    Bounds(bounds::Bounds),
    /// List the position, radius and mass of each sphere, in SI units
    Spheres(spheres::Spheres),
    /// List the stable and unstable stackings, under one sphere or on a base
    Census(census::Census),
    /// Average the base forces over random stackings
    Mean(mean::Mean),
    /// Count stable stackings and collect force distributions over random stackings
    Ensemble(ensemble::RunEnsemble),
    /// Merge the parts of an ensemble
    Merge(ensemble::Merge),
    /// Show the method and the cost of a computation
    Explain(explain::Explain),
    /// Write a pile as files: tables, input for LAMMPS and YADE, geometry for ParaView
    Export(export::Export),
    /// List the benchmark cases
    Cases(cases::Cases),
    /// Write the scene options as a TOML file, which --scene reads
    Scene(scene::WriteScene),
    /// Prove the theorems behind the formulas, for every pile
    Prove(prove::Prove),
    /// Compare measured contact forces with the exact ones; exit status 1 if they differ
    Verify(verify::Verify),
    /// Check a certificate; exit status 1 if it is rejected
    Check(check::Check),
    /// Draw a figure as SVG
    #[command(subcommand, arg_required_else_help = true)]
    Plot(plot::Plot),
    /// Print a completion script for a shell
    Completions(completions::Completions),
}

impl Command {
    /// Runs the command, and returns whether its answer is yes.
    fn run(&self) -> Result<bool, Failure> {
        match self {
            Self::Summary(command) => command.run(),
            Self::Base(command) => command.run(),
            Self::Contacts(command) => command.run(),
            Self::Stability(command) => command.run(),
            Self::Response(command) => command.run(),
            Self::Sensitivity(command) => command.run(),
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
        }
    }

    /// Returns the scene options, if the command has them.
    const fn scene(&self) -> Option<&SceneOptions> {
        Some(match self {
            Self::Summary(command) => &command.scene,
            Self::Base(command) => &command.scene,
            Self::Contacts(command) => &command.scene,
            Self::Stability(command) => &command.scene,
            Self::Response(command) => &command.scene,
            Self::Sensitivity(command) => &command.scene,
            Self::Bounds(command) => &command.scene,
            Self::Mean(command) => &command.scene,
            Self::Ensemble(command) => &command.scene,
            Self::Spheres(command) => &command.scene,
            Self::Explain(command) => &command.scene,
            Self::Export(command) => &command.scene,
            Self::Scene(command) => &command.scene,
            Self::Verify(command) => return command.scene.as_ref(),
            Self::Plot(command) => return command.scene(),
            Self::Cases(_)
            | Self::Census(_)
            | Self::Merge(_)
            | Self::Prove(_)
            | Self::Check(_)
            | Self::Completions(_) => return None,
        })
    }
}

/// The exit status if the answer is no.
const NO: u8 = 1;

/// Returns the whole command line, for manual pages.
#[must_use]
pub fn command() -> clap::Command {
    Arguments::command()
}

/// Runs the command that the arguments of this process name, and returns the exit status.
#[must_use]
pub fn run() -> ExitCode {
    let handled = signals::remove_files_on_signal();
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => return usage(&error),
    };
    if let Err(reason) = handled.and_then(|()| threads::start()) {
        print_message(&format!(
            "error: cannot start a thread: {reason}; allow this process more memory or more threads, or set RAYON_NUM_THREADS=1"
        ));
        return ExitCode::from(USAGE_ERROR);
    }
    progress::watch();
    match arguments.command.run() {
        Ok(true) | Err(Failure::Closed) => return ExitCode::SUCCESS,
        Ok(false) => return ExitCode::from(NO),
        Err(Failure::Input(refused)) => {
            let message = SceneOptions::message(arguments.command.scene(), &refused);
            print_message(&format!("error: {message}"));
        }
        Err(Failure::Message(message)) => print_message(&format!("error: {message}")),
    }
    ExitCode::from(USAGE_ERROR)
}

/// Prints a message of clap: help and version unchanged, an error in one line with a remedy.
fn usage(error: &clap::Error) -> ExitCode {
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => return printed(error.print()),
        // A command without arguments prints its help on stdout, and succeeds.
        ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            return printed(io::stdout().write_all(error.to_string().as_bytes()));
        }
        _ => {}
    }
    let mut text = error.to_string();
    if let Some(ContextValue::String(value)) = error.get(ContextKind::InvalidValue) {
        text = text.replace(value, &quoted(value));
    }
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let message: Vec<&str> = lines
        .take_while(|line| !line.starts_with("Usage:") && !line.starts_with("For more information"))
        .collect();
    let message = message.join(" ").replace(" tip: ", "; tip: ");
    // Clap adds a remedy if it suggests a similar word or lists the valid ones.
    let has_remedy = [
        ContextKind::SuggestedArg,
        ContextKind::SuggestedSubcommand,
        ContextKind::SuggestedValue,
        ContextKind::ValidValue,
        ContextKind::ValidSubcommand,
    ];
    let has_remedy = has_remedy.into_iter().any(|kind| match error.get(kind) {
        Some(ContextValue::Strings(words)) => !words.is_empty(),
        known => known.is_some(),
    });
    let remedy = match error.kind() {
        _ if has_remedy => String::new(),
        ErrorKind::ArgumentConflict => ": leave one of the two out".into(),
        ErrorKind::UnknownArgument
        | ErrorKind::InvalidSubcommand
        | ErrorKind::InvalidValue
        | ErrorKind::MissingRequiredArgument
        | ErrorKind::TooManyValues
        | ErrorKind::NoEquals => format!("; see '{} --help'", named_command()),
        _ => String::new(),
    };
    print_message(&format!("{message}{remedy}"));
    ExitCode::from(USAGE_ERROR)
}

/// Returns the exit status after a text was printed on stdout.
fn printed(written: io::Result<()>) -> ExitCode {
    let written = written.and_then(|()| io::stdout().flush());
    match written.map_err(|error| Failure::of_writing(error.into(), "output", None)) {
        Err(Failure::Message(message)) => {
            print_message(&format!("error: {message}"));
            ExitCode::from(USAGE_ERROR)
        }
        _ => ExitCode::SUCCESS,
    }
}

/// Returns the longest command that the arguments begin with.
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
