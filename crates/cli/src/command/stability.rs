//! `stability`: the tilts of gravity that a pile bears.

use cannonpile::Pile;
use cannonpile::geometry::LayerGap;
use cannonpile_dem::angle;
use cannonpile_dem::scene::Scene;
use clap::Args;

use super::of_weight;
use crate::args::{Number, Output, SceneOptions};
use crate::output::{Failure, print_message};
use crate::progress::Progress;
use crate::{Error, tables};

const HELP: &str = "\
Under a tilt t = (x, y) of gravity, each contact force is a linear function of x and y. A contact opens where its force
becomes zero. The margin t_c is the least |t| at which a contact opens, with |t|² = x² + 3y² (x² + 4cos²φ·y² with --sin-phi).
With --tilt, the tilts are in addition to the given one.

Columns:
  margin_squared      t_c², exact
  angle               angle of the least tilt at --spacing, in degrees: atan(t_c·tanθ)
  k, i, j, direction  a contact that opens at this tilt
Columns of --polygon, a row for each corner, counterclockwise:
  x, y                tilt, in tanθ and √3·tanθ (2cosφ·tanθ with --sin-phi)

The margin is 0 if a contact of the pile has no force and opens at the slightest tilt. An unstable pile has no margin, and
the exit status is 1. A straight pile has the margin 1/2 for every number of layers.

Examples:
  cannonpile stability --stacking=+-+++ --spacing 1.2
  cannonpile stability --stacking=+-+++ --polygon
  cannonpile stability --layers 1000000 --spacing 1";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Stability {
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    /// List the corners of the polygon of tilts that the pile bears
    #[arg(long, help_heading = "Output")]
    polygon: bool,
    /// Format of numbers; the angle is a float
    #[arg(long, value_enum, default_value = "exact", help_heading = "Output")]
    number: Number,
    #[command(flatten)]
    output: Output,
}

impl Stability {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let (scene, pile) = self.scene.read()?;
        self.output.format()?;
        // The default spacing may be invalid for this pile.
        let touching = pile.clearance().check(&scene.spacing()?);
        let progress = Progress::begin("searching for the contacts that open first");
        let stability = pile.stability().map_err(|error| of_weight(&pile, error))?;
        let (least, corners) = (stability.margin, stability.corners);
        let angle = match &least {
            Some(margin) if !self.polygon => angle_of(&scene, &pile, &margin.squared)?,
            _ => None,
        };
        let table = match &least {
            _ if self.polygon => Some(tables::polygon(&pile, corners)),
            Some(margin) => Some(tables::margin(&pile, margin, angle)),
            None => None,
        };
        if let Some(table) = table {
            self.output.write_table(table, self.number, &progress)?;
        }
        drop(progress);
        if least.is_none() {
            print_message(&instability(&pile, touching.as_deref().unwrap_or_default()));
            return Ok(false);
        }
        match touching {
            Err(error) if !self.polygon => print_message(&format!("note: no angle: {error}")),
            Ok(touching) if !touching.is_empty() => print_message(SLOPING_ONLY),
            _ => {}
        }
        Ok(true)
    }
}

/// The answer includes no forces of further contacts, such as horizontal ones. These forces may be zero, so they never
/// reduce the margin.
const SLOPING_ONLY: &str = "note: further spheres touch at this spacing (horizontal contacts at a = R): this answer is for the sloping contacts \
     alone, and the pile may bear more";

/// Returns the angle of the margin, or `None` if the default spacing does not fit the pile.
fn angle_of(
    scene: &Scene,
    pile: &Pile,
    squared: &num_rational::BigRational,
) -> Result<Option<f64>, Error> {
    match scene.packing(pile) {
        Ok(packing) => Ok(Some(angle::of_tilt(&packing, squared)?)),
        Err(error) if scene.spacing.is_some() => Err(error.into()),
        Err(_) => Ok(None),
    }
}

/// Returns the message that an unstable pile has no margin.
fn instability(pile: &Pile, touching: &[LayerGap]) -> String {
    let contacts = if touching.is_empty() {
        ""
    } else {
        " without the further contacts at this spacing"
    };
    let reason = match pile.first_failure() {
        Ok(Some(layer)) => format!(": below layer k = {layer} some contact needs tension"),
        _ => String::new(),
    };
    format!("no margin: this pile is unstable{contacts}{reason}")
}
