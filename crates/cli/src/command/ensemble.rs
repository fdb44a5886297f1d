//! `ensemble` and `merge`: statistics over random stackings, computed in parts if needed.

use core::fmt::Display;
use std::path::{Path, PathBuf};

use cannonpile::Pile;
use cannonpile::lattice::Region;
use cannonpile::stacking::Stacking;
use cannonpile_dem::Key;
use cannonpile_dem::scene::{Anchor, parse};
use cannonpile_dem::table::WriteError;
use cannonpile_disorder::{
    Choice, Ensemble, FirstSign, ForceKind, RandomStackings, Samples, Shard, TallyRecord,
    Unmergeable,
};
use cannonpile_horizontal::certificate::Claim;
use cannonpile_horizontal::equilibrium;
use clap::{ArgGroup, Args, ValueEnum};
use num_rational::BigRational;

use super::{fault_probability, has_horizontal_contacts};
use crate::args::{Format, Number, Output, SceneOptions};
use crate::output::{Failure, InputError, READABLE_FILE, open, unusable, write_to};
use crate::progress::Progress;
use crate::{Error, tables};

const HELP: &str = "\
The ensemble consists of random stackings below a top layer, or above a base. The first sign is --first. Each later sign
differs from the one before with the fault probability q; such a sign change is a fault. --all enumerates all stackings
(at most 2^24 in one run), and its counts hold for every q. --samples draws random ones; sample n depends only on --seed
and n.

Columns, a row for each number of faults:
  faults, stackings           number of faults, and number of stackings with them
  left_out                    with --base: stackings that the base does not support; no other column counts them
  stand                       stable stackings: no contact needs tension
  held                        with --spacing 1: stackings that are stable with horizontal contacts
  min_contact, max_contact    range of the contact forces, in mg/(3cosθ), over all stackings
  normal_min, normal_max      range of the base normal forces, in mg, over all stackings
  standing_...                the same ranges over the stable stackings
  stacking                    first stacking with the smallest contact force
The ranges over all stackings include unstable ones: only a prestressed pile can have their tensile forces.

With --base every pile has this bottom layer, and the sites of a layer are those with three supports. A stacking whose top
layer would be empty is left out: means and probabilities are over the other stackings. --layers is required. --first is
the sign below the top layer, as in the command mean. The column stacking is read from the base up, as --stacking is; the
json record lists signs from the top.

standing_probability is exact with --all. With --samples there is Wilson's 95 % interval, in floats.
--histogram prints the mean number of forces in each bin, from <= f < to, over all piles and over the stable ones.
--format json prints the whole record, which merge and plot distribution read.
--shard I/N computes one of N parts. merge joins them into the same bytes as one run.

Examples:
  cannonpile ensemble --layers 12 --all
  cannonpile ensemble --top hexagon:3 --layers 8 --all --histogram forces --fault-probability 1/4
  cannonpile ensemble --base hexagon:6 --layers 7 --all
  cannonpile ensemble --layers 30 --samples 1000000 --seed 7 --output samples.json
  cannonpile ensemble --layers 20 --all --shard 2/3 --output part2.json";

#[derive(Args)]
#[command(after_help = HELP, group = ArgGroup::new("choice").required(true))]
pub(crate) struct RunEnsemble {
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    /// Enumerate all stackings
    #[arg(long, group = "choice")]
    all: bool,
    /// Number of stackings to draw at random
    #[arg(long, value_name = "N", group = "choice", allow_hyphen_values = true, value_parser = natural)]
    samples: Option<u64>,
    /// Seed of the samples, 0 to 2^64 - 1 [default: 1]
    #[arg(long, value_name = "S", conflicts_with = "all", allow_hyphen_values = true, value_parser = natural)]
    seed: Option<u64>,
    /// Probability q that a sign differs from the one before
    #[arg(long, value_name = "Q", default_value = "1/2", allow_hyphen_values = true, value_parser = fault_probability)]
    fault_probability: BigRational,
    /// Sign of the first step: +, - or random
    #[arg(long, value_name = "SIGN", default_value = "+", allow_hyphen_values = true, value_parser = str::parse::<FirstSign>)]
    first: FirstSign,
    /// Width of the histogram bins: in mg/(3cosθ) for contact forces, in mg for normal forces
    #[arg(long, value_name = "W", default_value = "1/3", allow_hyphen_values = true, value_parser = parse::rational)]
    bins: BigRational,
    /// Part I of N, with I from 1 to N
    #[arg(long, value_name = "I/N", default_value = "1/1", allow_hyphen_values = true, value_parser = str::parse::<Shard>)]
    shard: Shard,
    /// Print a histogram of these forces instead
    #[arg(long, value_enum, help_heading = "Output")]
    histogram: Option<HistogramForces>,
    /// Format of numbers; json is always exact
    #[arg(long, value_enum, default_value = "exact", help_heading = "Output")]
    number: Number,
    #[command(flatten)]
    output: Output,
}

/// The forces of a histogram.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum HistogramForces {
    /// Contact forces between spheres
    Forces,
    /// Base normal forces
    Normals,
}

impl From<HistogramForces> for ForceKind {
    fn from(forces: HistogramForces) -> Self {
        match forces {
            HistogramForces::Forces => Self::Contact,
            HistogramForces::Normals => Self::Normal,
        }
    }
}

/// Parses an integer from 0 to 2⁶⁴ − 1, such as `1e6`.
fn natural(text: &str) -> Result<u64, Error> {
    let number = parse::integer(text)?;
    let expected = "a number from 0 to 2^64 - 1";
    u64::try_from(number).map_err(|_| cannonpile::Error::syntax(text, expected).into())
}

/// Returns whether a pile is stable with horizontal contacts.
fn stands(pile: &Pile) -> Result<bool, Error> {
    Ok(equilibrium(pile)?.claim == Claim::Stands)
}

/// Prefixes an error with its option.
fn of_option<E: Display>(option: &'static str) -> impl Fn(E) -> Failure {
    move |error| Failure::Message(format!("--{option}: {error}"))
}

impl RunEnsemble {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let format = self.output.format()?;
        self.check_histogram(format)?;
        let ensemble = self.ensemble()?;
        let q = &self.fault_probability;
        let choice = match self.samples {
            None => Choice::All,
            Some(samples) => {
                let seed = self.seed.unwrap_or(1);
                let option = if samples == 0 {
                    "samples"
                } else {
                    "fault-probability"
                };
                let samples = Samples::new(samples, seed, q.clone());
                Choice::Drawn(samples.map_err(of_option(option))?)
            }
        };
        let tally = {
            // Fails here if there are too many stackings, before the progress line appears.
            let part = ensemble.size(&choice, self.shard)?;
            let progress = Progress::of_rows("analysing stackings", Some(part));
            ensemble.run_judged(&choice, self.shard, &|more| progress.advance(more), &stands)?
        };
        let record = TallyRecord::new(tally, q.clone()).map_err(of_option("fault-probability"))?;
        let progress = Progress::begin("writing");
        let (tally, q) = (record.tally(), record.fault_probability());
        if let Some(measured) = self.histogram {
            let histogram = tables::histogram(tally, measured.into(), q)?;
            // A part was refused before the run.
            let histogram = histogram.ok_or_else(|| Self::without_stackings(&choice))?;
            self.output.write_table(histogram, self.number, &progress)?;
            return Ok(true);
        }
        match format {
            Format::Json => self
                .output
                .write(&progress, |mut out| Ok(record.write(&mut out)?))?,
            Format::Csv => {
                let rows = tables::ensemble(tally);
                self.output.write_table(rows, self.number, &progress)?;
            }
            Format::Table => {
                let summary = tables::ensemble_summary(tally, q)?;
                self.output.write(&progress, |out| {
                    summary.write(format.into(), self.number.into(), out)?;
                    writeln!(out)?;
                    tables::ensemble(tally).write(format.into(), self.number.into(), out)
                })?;
            }
        }
        Ok(true)
    }

    fn check_histogram(&self, format: Format) -> Result<(), Failure> {
        if self.histogram.is_none() {
            return Ok(());
        }
        if format == Format::Json {
            return Err(Failure::Message(
                "--histogram: the json record already has both histograms: leave it out, or use csv".to_owned(),
            ));
        }
        if self.shard != Shard::WHOLE {
            return Err(Self::of_a_part());
        }
        Ok(())
    }

    fn of_a_part() -> Failure {
        Failure::Message(
            "--histogram: a part of an ensemble has no means: leave out --shard, or write json and merge the parts"
                .to_owned(),
        )
    }

    fn without_stackings(choice: &Choice) -> Failure {
        let what = match choice {
            Choice::All => {
                "--fault-probability: the base supports no stacking that occurs at this value: use another one"
            }
            Choice::Drawn(_) => {
                "--samples: the base supports none of the samples: draw more, or use another --fault-probability"
            }
        };
        Failure::Message(what.to_owned())
    }

    fn ensemble(&self) -> Result<Ensemble, Failure> {
        let scene = self.scene.read_for_all_stackings()?;
        let anchor = scene.anchor.unwrap_or(Anchor::Top(Region::SITE));
        let layers = self.scene.layers_of_all_stackings(&scene)?;
        let stackings = RandomStackings::new(layers, self.first)?;
        let ensemble = match anchor {
            Anchor::Top(top) => Ensemble::under(top, stackings)?,
            Anchor::Base(base) => Ensemble::on(base, stackings)?,
        };
        let mut ensemble = ensemble
            .with_bin_width(self.bins.clone())
            .map_err(of_option("bins"))?;
        for (at, load) in &scene.loads {
            let loaded = ensemble.with_load([at.i, at.j], load.down.clone());
            ensemble = loaded.map_err(|error| InputError::of(Key::Load, error))?;
        }
        if scene.weightless {
            ensemble = ensemble.weightless();
        }
        // A pile with a sign change has the smallest gaps. With a base it is a pile under that layer.
        let (Anchor::Top(layer) | Anchor::Base(layer)) = anchor;
        let with_a_change = || Pile::under(layer, Stacking::hcp(layers.min(3))?);
        if has_horizontal_contacts(scene.spacing.as_ref(), with_a_change)? {
            if scene.weightless {
                return Err(Failure::Message(
                    "--weightless: stability with horizontal contacts needs the weight of the spheres: leave it out, or leave \
                     out --spacing 1"
                        .to_owned(),
                ));
            }
            ensemble = ensemble.with_horizontal_contacts()?;
        }
        Ok(ensemble)
    }
}

const MERGE_HELP: &str = "\
Each file is the JSON record of ensemble --shard I/N; the order does not matter. All parts must have the same scene, seed,
bins and version, each exactly once. The merged record equals that of ensemble without --shard, byte for byte.

Examples:
  cannonpile merge part1.json part2.json part3.json --output whole.json";

#[derive(Args)]
#[command(after_help = MERGE_HELP)]
pub(crate) struct Merge {
    /// Parts of the ensemble, as JSON
    #[arg(value_name = "FILE", required = true)]
    parts: Vec<PathBuf>,
    /// File for the record, written atomically [default: stdout]
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    output: Option<PathBuf>,
}

impl Merge {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let progress = Progress::begin("reading the parts");
        let parts: Result<Vec<_>, Failure> = self.parts.iter().map(|path| read(path)).collect();
        let whole = TallyRecord::merge(&parts?).map_err(|refused| self.message(&refused))?;
        drop(progress);
        write_to("output", self.output.as_deref(), |mut out| {
            Ok::<_, WriteError>(whole.write(&mut out)?)
        })?;
        Ok(true)
    }

    /// Prefixes an error with the file that causes it.
    fn message(&self, refused: &Unmergeable) -> Failure {
        let place = match refused {
            Unmergeable::Other { place, .. } | Unmergeable::Twice { place, .. } => {
                self.parts.get(*place)
            }
            _ => None,
        };
        let file = place.map_or_else(String::new, |path| format!("{}: ", path.display()));
        Failure::Message(format!("{file}{refused}"))
    }
}

pub(super) fn read(path: &Path) -> Result<TallyRecord, Failure> {
    let expected = [
        "part of an ensemble",
        "'cannonpile ensemble --shard I/N --format json' writes one",
    ];
    TallyRecord::read(open(path)?)
        .map_err(|error| unusable(path.display(), &error, expected, READABLE_FILE))
}
