//! `explain`: how a question is answered, and what that takes.

use cannonpile::shape::Selection;
use cannonpile::{Pile, Quantity};
use cannonpile_dem::table::{NumberFormat, Table, WriteError};
use clap::{Args, ValueEnum};

use crate::args::{ByMethod, Format, Output, Part, SceneOptions, UnitSystem};
use crate::output::{Failure, Refused};
use crate::progress::Progress;
use crate::tables::Explanation;
use crate::{Culprit, Error};

const HELP: &str = "\
Rows of the plan, which are bounds:
  quantity  what is asked             runs      runs of equal steps that matter
  method    how it is answered        visited   spheres whose forces are found
  turned    those of them that are below a change of sign
  passes    steps from a layer to the next
  numbers   numbers kept at a time    bits      bits of the widest of them
  planes    machine words for each    roots     square roots taken
  rows      rows of the answer        bytes     memory for the numbers
counted_visited, counted_turned, … say what the run took.

Examples:
  cannonpile explain --stacking hcp --layers 30
  cannonpile explain --of base --layers 1000000 --at 5,7 --no-run";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Explain {
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    /// What is asked of the spheres
    #[arg(long, value_enum, default_value = "contacts", help_heading = "Output")]
    of: Asked,
    #[command(flatten)]
    part: Part,
    /// The units of forces
    #[arg(long, value_enum, default_value = "pile", help_heading = "Output")]
    units: UnitSystem,
    #[command(flatten)]
    method: ByMethod,
    /// The plan only: nothing is run
    #[arg(long, help_heading = "Output")]
    no_run: bool,
    #[command(flatten)]
    output: Output,
}

/// What is asked of spheres.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Asked {
    /// What `contacts` prints
    Contacts,
    /// The magnitudes alone; in SI
    Magnitudes,
    /// What `base` prints
    Base,
    /// What `spheres` prints: places, in SI
    Spheres,
}

impl Asked {
    /// Returns the quantity, and the units that it is in: magnitudes and places are in SI.
    const fn quantity(self, units: UnitSystem) -> (Quantity, UnitSystem) {
        match (self, units) {
            (Self::Contacts, UnitSystem::Pile) => (Quantity::ContactMultiples, units),
            (Self::Contacts, UnitSystem::Si) => (Quantity::ContactVectors, units),
            (Self::Magnitudes, _) => (Quantity::ContactMagnitudes, UnitSystem::Si),
            (Self::Base, UnitSystem::Pile) => (Quantity::FloorMultiples, units),
            (Self::Base, UnitSystem::Si) => (Quantity::FloorForces, units),
            (Self::Spheres, _) => (Quantity::Positions, UnitSystem::Si),
        }
    }

    /// Returns the part that is asked about: on the floor there is but the base.
    fn part(self, part: Selection, pile: &Pile) -> Selection {
        match part {
            Selection::All if self == Self::Base => Selection::Base,
            Selection::Layer(k) if self == Self::Base && k == pile.layers() - 1 => Selection::Base,
            part => part,
        }
    }
}

impl Explain {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let (scene, pile) = self.scene.read()?;
        let part = self.of.part(self.part.selection(&pile)?, &pile);
        let (quantity, system) = self.of.quantity(self.units);
        let units = self.method.of(system.of(&scene, &pile)?)?;
        let explanation = Explanation::new(&units, quantity, part);
        // Where a layer was named, no sphere was.
        self.write(&explanation.map_err(|error| match (part, error.into()) {
            (Selection::Layer(_), error @ Error::Core(cannonpile::Error::NotOnFloor { .. })) => {
                Refused::of(Culprit::Layer, error)
            }
            (_, error) => error.into(),
        })?)?;
        Ok(true)
    }

    /// Writes the plan, before anything is run, and then what was counted.
    fn write(&self, explanation: &Explanation<'_>) -> Result<(), Failure> {
        let format = self.output.format()?;
        if !self.no_run {
            let asked = explanation.check();
            asked.map_err(|error| Refused::of_rows(error, "--layer, --at or --no-run"))?;
        }
        let progress = Progress::begin("counting");
        self.output.write(&progress, |out| {
            let mut write = |table: Table<'_>| {
                table.write(format.into(), NumberFormat::Exact, out)?;
                Ok::<_, WriteError>(out.flush()?)
            };
            if format != Format::Table || self.no_run {
                let counters = (!self.no_run).then(|| explanation.run()).transpose()?;
                return write(explanation.table(counters.as_ref()));
            }
            write(explanation.table(None))?;
            write(Explanation::counted(&explanation.run()?))
        })
    }
}
