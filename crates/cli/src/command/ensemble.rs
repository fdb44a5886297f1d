//! `ensemble` and `merge`: random stackings one by one, and in parts.

use core::fmt::Display;
use std::path::{Path, PathBuf};

use cannonpile::Pile;
use cannonpile::lattice::Region;
use cannonpile::stacking::Stacking;
use cannonpile_dem::Key;
use cannonpile_dem::scene::{Anchor, Scene, parse};
use cannonpile_dem::table::WriteError;
use cannonpile_disorder::{
    Binned, Choice, Ensemble, FirstSign, RandomStackings, Samples, Shard, TallyRecord, Unmergeable,
};
use cannonpile_horizontal::certificate::Claim;
use cannonpile_horizontal::equilibrium;
use clap::{ArgGroup, Args, ValueEnum};
use num_rational::BigRational;

use super::{fault_probability, has_horizontal_contacts};
use crate::args::{Format, Number, Output, SceneOptions};
use crate::output::{Failure, Refused, open, write_to};
use crate::progress::Progress;
use crate::{Error, tables};

const HELP: &str = "\
Every stacking of the layers below a top layer: its first sign is --first, each later one differs from the one before
with the fault probability q, a fault. What is not linear in the stackings is counted, exactly and by number of faults: how
many stand, the least and greatest contact force, in mg/(3cosθ), and normal force of a bottom sphere, in mg, and their
histograms. --all goes through all of them, at most 2^24 at a time; the counts then hold for any q. --samples draws some with
their probabilities; sample n depends on --seed and n alone.

stand: no contact pulls. held: with --spacing 1, those that stand with horizontal contacts. standing_probability is exact;
of samples there is Wilson's 95 % interval, in floats. Columns of all stackings include those of which some contact pulls:
only a prestressed pile can have such forces. Of a weightless pile stand means that none of its contacts pulls.

  rows                   faults, stackings, stand, held, least and greatest forces of all and of those that stand, and the
                         first stacking that has the least contact force
  --histogram            from, to, all, standing: the mean number of forces in a pile with from <= f < to, at the fault
                         probability; of all piles, and of those that stand
  --format json          the whole record, with all counts: what merge reads

The same bytes come out however the work is cut up: --shard I/N is one of N parts, and merge puts them together.

Examples:
  cannonpile ensemble --layers 12 --all
  cannonpile ensemble --top hexagon:3 --layers 8 --all --histogram forces --fault-probability 1/4
  cannonpile ensemble --layers 30 --samples 1000000 --seed 7 --output samples.json
  cannonpile ensemble --layers 20 --all --shard 2/3 --output part2.json";

#[derive(Args)]
#[command(after_help = HELP, group = ArgGroup::new("choice").required(true))]
pub(crate) struct EnsembleOf {
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    /// Every stacking
    #[arg(long, group = "choice")]
    all: bool,
    /// So many stackings, drawn at random
    #[arg(long, value_name = "N", group = "choice", allow_hyphen_values = true, value_parser = natural)]
    samples: Option<u64>,
    /// What the samples depend on, beside their number [default: 1]
    #[arg(long, value_name = "S", conflicts_with = "all", allow_hyphen_values = true, value_parser = natural)]
    seed: Option<u64>,
    /// The probability q that a sign differs from the one before
    #[arg(long, value_name = "Q", default_value = "1/2", allow_hyphen_values = true, value_parser = fault_probability)]
    fault_probability: BigRational,
    /// The sign of the first step: +, - or random
    #[arg(long, value_name = "SIGN", default_value = "+", allow_hyphen_values = true, value_parser = str::parse::<FirstSign>)]
    first: FirstSign,
    /// The width of the bins, in mg/(3cosθ) of contact forces, in mg of normal forces
    #[arg(long, value_name = "W", default_value = "1/3", allow_hyphen_values = true, value_parser = parse::rational)]
    bins: BigRational,
    /// One of N parts, I from 1 to N
    #[arg(long, value_name = "I/N", default_value = "1/1", allow_hyphen_values = true, value_parser = str::parse::<Shard>)]
    shard: Shard,
    /// The histogram of these forces, in place of a row for each number of faults
    #[arg(long, value_enum, help_heading = "Output")]
    histogram: Option<Measured>,
    /// How numbers are printed; json is always exact
    #[arg(long, value_enum, default_value = "exact", help_heading = "Output")]
    number: Number,
    #[command(flatten)]
    output: Output,
}

/// Forces that have a histogram.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum Measured {
    /// Of contacts between spheres
    Forces,
    /// Of bottom spheres on the floor
    Normals,
}

impl From<Measured> for Binned {
    fn from(measured: Measured) -> Self {
        match measured {
            Measured::Forces => Self::Forces,
            Measured::Normals => Self::Normals,
        }
    }
}

/// Reads an integer that is not negative and below 2⁶⁴, `1e6` too.
fn natural(text: &str) -> Result<u64, Error> {
    let number = parse::integer(text)?;
    let expected = "a number from 0 to 2^64 - 1";
    u64::try_from(number).map_err(|_| cannonpile::Error::syntax(text, expected).into())
}

/// Whether a pile stands with horizontal contacts.
fn stands(pile: &Pile) -> Result<bool, Error> {
    Ok(equilibrium(pile)?.claim == Claim::Stands)
}

/// Says which option is refused.
fn of_option<E: Display>(option: &'static str) -> impl Fn(E) -> Failure {
    move |error| Failure::Message(format!("--{option}: {error}"))
}

impl EnsembleOf {
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
            // Before they are gone through.
            let part = ensemble.size(&choice, self.shard)?;
            let progress = Progress::of_stackings("going through stackings", part);
            ensemble.run_judged(&choice, self.shard, &|more| progress.advance(more), &stands)?
        };
        let record = TallyRecord::new(tally, q.clone()).map_err(of_option("fault-probability"))?;
        let progress = Progress::begin("writing");
        let (tally, q) = (record.tally(), record.fault_probability());
        if let Some(measured) = self.histogram {
            let histogram = tables::histogram(tally, measured.into(), q)?;
            let histogram = histogram.ok_or_else(Self::of_a_part)?;
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
                "--histogram: json is the whole record, with both histograms: leave it out, or use csv".to_owned(),
            ));
        }
        if self.shard != Shard::WHOLE {
            return Err(Self::of_a_part());
        }
        Ok(())
    }

    fn of_a_part() -> Failure {
        Failure::Message(
            "--histogram: means are those of the whole, and this is a part: leave out --shard, or write json and merge it"
                .to_owned(),
        )
    }

    fn ensemble(&self) -> Result<Ensemble, Failure> {
        let scene = self.scene.of_all_stackings()?;
        let top = match scene.anchor {
            Some(Anchor::Top(top)) => top,
            _ => Region::SITE,
        };
        let layers = scene.layers.unwrap_or(Scene::LAYERS);
        let stackings = RandomStackings::new(layers, self.first)?;
        let mut ensemble = Ensemble::under(top, stackings)?
            .with_bins(self.bins.clone())
            .map_err(of_option("bins"))?;
        for (at, load) in &scene.loads {
            let loaded = ensemble.with_load([at.i, at.j], load.clone());
            ensemble = loaded.map_err(|error| Refused::of(Key::Load, error))?;
        }
        if scene.weightless {
            ensemble = ensemble.weightless();
        }
        // A pile with a change of sign leaves the least room.
        let with_a_change = || Pile::under(top, Stacking::hcp(layers.min(3))?);
        if has_horizontal_contacts(scene.spacing.as_ref(), with_a_change)? {
            if scene.weightless {
                return Err(Failure::Message(
                    "--weightless: which piles stand with horizontal contacts is asked of spheres that weigh something: leave it \
                     out, or --spacing 1"
                        .to_owned(),
                ));
            }
            ensemble = ensemble.with_horizontal_contacts()?;
        }
        Ok(ensemble)
    }
}

const MERGE_HELP: &str = "\
Each file is json that ensemble --shard I/N has written; they may come in any order. A part of another scene, seed, version or
width of bins is refused by name, and so is one that is there twice; if parts are missing, it says which. The record is that
of ensemble without --shard, byte for byte.

Examples:
  cannonpile merge part1.json part2.json part3.json --output whole.json";

#[derive(Args)]
#[command(after_help = MERGE_HELP)]
pub(crate) struct Merge {
    /// The parts, as JSON
    #[arg(value_name = "FILE", required = true)]
    parts: Vec<PathBuf>,
    /// Write to a file, which is replaced only when all is written
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    output: Option<PathBuf>,
}

impl Merge {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let progress = Progress::begin("reading FILE");
        let parts: Result<Vec<_>, Failure> = self.parts.iter().map(|path| read(path)).collect();
        let whole = TallyRecord::merge(&parts?).map_err(|refused| self.message(&refused))?;
        drop(progress);
        write_to("output", self.output.as_deref(), |mut out| {
            Ok::<_, WriteError>(whole.write(&mut out)?)
        })?;
        Ok(true)
    }

    /// Says which file is to blame.
    fn message(&self, refused: &Unmergeable) -> Failure {
        let place = match refused {
            Unmergeable::Other { place, .. }
            | Unmergeable::Twice { place, .. }
            | Unmergeable::Impossible { place } => self.parts.get(*place),
            _ => None,
        };
        let file = place.map_or_else(String::new, |path| format!("{}: ", path.display()));
        Failure::Message(format!("FILE: {file}{refused}"))
    }
}

pub(super) fn read(path: &Path) -> Result<TallyRecord, Failure> {
    let name = path.display();
    TallyRecord::read(open(path)?).map_err(|error| {
        Failure::Message(format!(
            "FILE: {name} is no part of an ensemble: {error}; 'cannonpile ensemble --shard I/N --format json' writes one"
        ))
    })
}
