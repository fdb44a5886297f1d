//! `stability`: the tilts of gravity that a pile bears.

use cannonpile::geometry::LayerGap;
use cannonpile::lattice::{Direction, Site};
use cannonpile::{Pile, Verdict};
use cannonpile_dem::angle;
use cannonpile_dem::scene::Scene;
use cannonpile_stability::Tilt;
use clap::Args;
use num_rational::BigRational;

use super::{instability, of_weight};
use crate::args::{ExplainOption, Number, Output, SceneOptions};
use crate::output::{Failure, print_message};
use crate::progress::Progress;
use crate::tables::Work;
use crate::{Error, tables};

const HELP: &str = "\
Under a tilt t = (x, y) of gravity, each contact force is a linear function of x and y. A contact opens where its force
becomes zero. The margin t_c is the least |t| at which a contact opens, with |t|² = x² + 3y² (x² + 4cos²φ·y² with --sin-phi).
With --tilt, the tilts are in addition to the given one.

Columns:
  margin_squared      t_c², exact
  angle               angle of the least tilt at --spacing, in degrees: atan(t_c·tanθ)
  k, i, j, direction  a contact that opens at this tilt
  stands              yes; no: the pile is unstable; undetermined: further contacts may support it, or it is too large
Columns of --polygon, a row for each corner, counterclockwise:
  x, y                tilt, in tanθ and √3·tanθ (2cosφ·tanθ with --sin-phi); csv and json name these units

At a = R horizontal contacts may support the pile. Then forces are not unique, and no contact is named: beyond the margin no
compressive forces balance the pile. The command summary writes a proof for a given tilt: --tilt X,Y --certificate FILE.

The margin is 0 if a contact of the pile has no force and opens at the slightest tilt. If stands is no or undetermined, there
is no margin, and the exit status is 1. A straight pile has the margin 1/2 for every number of layers.

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
    #[command(flatten)]
    explain: ExplainOption,
}

impl Stability {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let (scene, pile) = self.scene.read()?;
        self.output.format()?;
        // The default spacing may be invalid for this pile.
        let touching = pile.clearance().check(&scene.spacing()?);
        let progress = Progress::begin("searching for the contacts that open first");
        let answer = self.answer(&pile, touching.as_deref().unwrap_or_default());
        let Answer {
            squared,
            opens,
            corners,
            contacts,
        } = answer.map_err(|error| of_weight(&pile, error))?;
        let verdict = match (&squared, &contacts) {
            (Some(_), _) => Verdict::Yes,
            (None, Contacts::Sloping | Contacts::Horizontal) => Verdict::No,
            (None, Contacts::SlopingOnly | Contacts::TooMany(_)) => Verdict::Undetermined,
        };
        let table = if self.polygon {
            tables::polygon(&pile, corners)
        } else {
            let angle = squared
                .as_ref()
                .map(|squared| angle_of(&scene, &pile, squared));
            tables::margin(&pile, squared, angle.transpose()?.flatten(), opens, verdict)
        };
        self.output.write_table(table, self.number, &progress)?;
        drop(progress);
        self.explain
            .print(|| Ok(Work::of_whole(&pile, "any contact may open first")))?;
        if verdict != Verdict::Yes {
            print_message(&format!("no margin: {}", contacts.instability(&pile)));
            return Ok(false);
        }
        if let (Err(error), false) = (touching, self.polygon) {
            print_message(&format!("note: no angle: {error}"));
        }
        if let Contacts::SlopingOnly = contacts {
            print_message(
                "note: further spheres touch at this spacing: this answer is without their contacts, and the pile may bear more",
            );
        }
        Ok(true)
    }

    fn answer(&self, pile: &Pile, touching: &[LayerGap]) -> Result<Answer, Error> {
        if touching.is_empty() {
            return self.of_sloping_contacts(pile, Contacts::Sloping);
        }
        if *touching == [LayerGap { layers: 0 }] && pile.is_regular() {
            let (squared, corners, contacts) = match self.with_horizontal_contacts(pile) {
                Ok((squared, corners)) => (squared, corners, Contacts::Horizontal),
                Err(Error::Core(error @ cannonpile::Error::TooLarge { .. })) => {
                    (None, Vec::new(), Contacts::TooMany(error))
                }
                Err(error) => return Err(error),
            };
            return Ok(Answer {
                squared,
                opens: None,
                corners,
                contacts,
            });
        }
        self.of_sloping_contacts(pile, Contacts::SlopingOnly)
    }

    fn of_sloping_contacts(&self, pile: &Pile, contacts: Contacts) -> Result<Answer, Error> {
        let (margin, corners) = if self.polygon {
            let tilts = cannonpile_stability::tilts(pile)?;
            (tilts.margin, tilts.corners)
        } else {
            (cannonpile_stability::margin(pile)?, Vec::new())
        };
        Ok(Answer {
            opens: margin.as_ref().map(|margin| margin.opens),
            squared: margin.map(|margin| margin.squared),
            corners,
            contacts,
        })
    }

    fn with_horizontal_contacts(
        &self,
        pile: &Pile,
    ) -> Result<(Option<BigRational>, Vec<Tilt>), Error> {
        let (margin, corners) = if self.polygon {
            let tilts = cannonpile_horizontal::tilts(pile)?;
            (tilts.margin, tilts.corners)
        } else {
            (cannonpile_horizontal::margin(pile)?, Vec::new())
        };
        Ok((margin.map(|margin| margin.squared), corners))
    }
}

/// The square of the margin, unless the pile is unstable, the contact that opens there, and the corners of the polygon.
struct Answer {
    squared: Option<BigRational>,
    opens: Option<(Site, Direction)>,
    corners: Vec<Tilt>,
    contacts: Contacts,
}

/// The contacts that an answer is about.
enum Contacts {
    /// Sloping contacts, the only ones.
    Sloping,
    /// Sloping contacts, although further spheres touch. The forces of these may be zero, so they never reduce the margin.
    SlopingOnly,
    /// Sloping and horizontal contacts.
    Horizontal,
    /// Sloping and horizontal contacts, too many for a program.
    TooMany(cannonpile::Error),
}

impl Contacts {
    /// Returns the reason why there is no margin.
    fn instability(&self, pile: &Pile) -> String {
        match self {
            Self::Sloping => instability(pile, ""),
            Self::SlopingOnly => format!(
                "undetermined: {}, which may support it",
                instability(pile, " without the further contacts at this spacing")
            ),
            Self::TooMany(error) => format!("undetermined: {error}"),
            Self::Horizontal => "this pile is unstable, with horizontal contacts too".to_owned(),
        }
    }
}

/// Returns the angle of the margin, or `None` if the default spacing does not fit the pile.
fn angle_of(scene: &Scene, pile: &Pile, squared: &BigRational) -> Result<Option<f64>, Error> {
    match scene.packing(pile) {
        Ok(packing) => Ok(Some(angle::of_tilt(&packing, squared)?)),
        Err(error) if scene.spacing.is_some() => Err(error.into()),
        Err(_) => Ok(None),
    }
}
