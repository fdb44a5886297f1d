//! `explain`: the plan of a computation, and its counted cost.

use cannonpile::Pile;
use cannonpile::shape::Selection;
use cannonpile_dem::table::NumberFormat;
use clap::Args;

use crate::args::{Format, MethodOption, Output, Part, SceneOptions, UnitSystem};
use crate::output::{Failure, InputError};
use crate::progress::Progress;
use crate::tables::{Explanation, Wanted};
use crate::{Culprit, Error};

const HELP: &str = "\
First a sentence: how many spheres are visited, and why. Then:
  method    closed, tree or sweep
  visited   spheres whose forces are computed; without a run, at most
  of        spheres of the pile
  reason    why these are visited, and no others
  rows      rows of the result
  bits      bits of the widest number of a sweep, at most
  bytes     memory for the numbers of a sweep
  roots     square roots
  pivots    exact steps of a linear program
The rows counted_visited, counted_turned, counted_passes and counted_rows give the counts of a run.
Other commands print the sentence on stderr with --explain.

Examples:
  cannonpile explain --stacking hcp --layers 30
  cannonpile explain --of base --layers 1000000 --at 5,7 --no-run";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Explain {
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    /// Quantity to compute
    #[arg(long, value_enum, default_value = "contacts", help_heading = "Output")]
    of: Wanted,
    #[command(flatten)]
    part: Part,
    /// Units of forces
    #[arg(long, value_enum, default_value = "pile", help_heading = "Output")]
    units: UnitSystem,
    #[command(flatten)]
    method: MethodOption,
    /// Print the plan only, without a run
    #[arg(long, help_heading = "Output")]
    no_run: bool,
    #[command(flatten)]
    output: Output,
}

/// Returns the selected part. For base forces the whole pile means the base.
fn part_of(wanted: Wanted, part: Selection, pile: &Pile) -> Selection {
    match part {
        Selection::All if wanted == Wanted::Base => Selection::Base,
        Selection::Layer(k) if wanted == Wanted::Base && k == pile.layers() - 1 => Selection::Base,
        part => part,
    }
}

impl Explain {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let (scene, pile) = self.scene.read()?;
        let part = part_of(self.of, self.part.selection(&pile)?, &pile);
        let system = match self.of {
            // Magnitudes and positions are in SI.
            Wanted::Magnitudes | Wanted::Spheres => UnitSystem::Si,
            Wanted::Contacts | Wanted::Base => self.units,
        };
        let units = self.method.apply(system.of(&scene, &pile)?)?;
        let explanation = Explanation::new(&units, self.of, part);
        // The user gave --layer, so the message must not name a sphere.
        self.write(&explanation.map_err(|error| match (part, error.into()) {
            (Selection::Layer(_), error @ Error::Core(cannonpile::Error::NotOnFloor { .. })) => {
                InputError::of(Culprit::Layer, error)
            }
            (_, error) => error.into(),
        })?)?;
        Ok(true)
    }

    /// Runs the query, unless `--no-run` is given, and writes the sentence and the fields.
    fn write(&self, explanation: &Explanation<'_>) -> Result<(), Failure> {
        let format = self.output.format()?;
        if !self.no_run {
            let checked = explanation.check();
            checked.map_err(|error| InputError::of_rows(error, "--layer, --at or --no-run"))?;
        }
        let progress = Progress::begin("counting");
        let counters = (!self.no_run).then(|| explanation.run()).transpose()?;
        let table = explanation.table(counters.as_ref());
        self.output.write(&progress, |out| {
            if format == Format::Table {
                writeln!(out, "{}", explanation.work(counters.as_ref()))?;
            }
            table.write(format.into(), NumberFormat::Exact, out)?;
            Ok(out.flush()?)
        })
    }
}
