//! `spheres`: the position, radius, mass and stress of each sphere.

use cannonpile::shape::Selection;
use cannonpile_dem::scene::State;
use cannonpile_dem::table::{self, Units};
use clap::Args;

use super::{ELASTIC, note_instability};
use crate::args::{
    ExplainOption, Numbers, Output, Part, SceneOptions, UnitSystem, spheres, with_row_options,
};
use crate::output::Failure;
use crate::progress::Progress;
use crate::tables::{Explanation, Wanted, Work};

const HELP: &str = "\
Columns:
  id             number of the sphere, from 1 at the top, as in export and verify
  k, i, j        layer, from 0 at the top, and indices in the layer
  x, y, z        centre, in m; z points up
  radius, mass   in m and kg
  fixed          1 in the bottom layer, otherwise 0

With --stress further columns give the stress of each sphere times its volume 4πR³/3, which is R Σ f ê⊗ê over its contacts:
  stress_xx, stress_yy   in mgR·sinθ·tanθ
  stress_zz              in mgR·cosθ
  stress_xy              in √3·mgR·sinθ·tanθ (in 2cosφ·mgR·sinθ·tanθ with --sin-phi)
  stress_xz              in mgR·sinθ
  stress_yz              in √3·mgR·sinθ (in 2cosφ·mgR·sinθ with --sin-phi)
With --units si they are in N·m; divide by the volume for Pa. Compression is positive. LAMMPS' compute stress/atom has the
opposite sign. The forces of the floor and the loads are not included.

Examples:
  cannonpile spheres --layers 4
  cannonpile spheres --layers 4 --radius 1/100 --number f64 --output spheres.json
  cannonpile spheres --layers 4 --stress --units si --number f64";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Spheres {
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    #[command(flatten)]
    part: Part,
    /// Add the stress of each sphere times its volume
    #[arg(long, help_heading = "Output")]
    stress: bool,
    #[command(flatten)]
    numbers: Numbers,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    explain: ExplainOption,
}

impl Spheres {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let (scene, pile) = if self.stress {
            self.scene.read_state()?
        } else {
            self.scene.read_whole()?
        };
        let selection = self.part.selection(&pile)?;
        self.output.format()?;
        let rows = spheres(&pile, selection)?;
        let progress = Progress::of_rows("positions", rows.try_into().ok());
        let packing = scene.packing(&pile)?;
        let table = if self.stress {
            let in_si = matches!(self.numbers.units, UnitSystem::Si);
            table::spheres_with_stress(&packing, in_si, selection)
        } else {
            table::spheres(&packing, selection)
        };
        let table = table.map_err(|error| with_row_options(error, selection))?;
        self.output
            .write_table(table, self.numbers.number, &progress)?;
        drop(progress);
        self.explain.print(|| {
            if self.stress && scene.state == State::Elastic {
                return Ok(Work::of_whole(&pile, ELASTIC));
            }
            let wanted = if self.stress {
                Wanted::Contacts
            } else {
                Wanted::Spheres
            };
            Ok(Explanation::new(&Units::of_packing(packing), wanted, selection)?.work(None))
        })?;
        // The stability check takes longer than the positions of a part of the pile.
        if selection == Selection::All {
            note_instability(&pile);
        }
        Ok(true)
    }
}
