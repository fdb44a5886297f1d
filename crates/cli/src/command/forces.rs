//! `base` and `contacts`: the forces on the floor, and those between spheres.

use std::path::PathBuf;

use cannonpile::Pile;
use cannonpile::shape::Selection;
use cannonpile_dem::scene::{Scene, State};
use cannonpile_dem::table;
use cannonpile_dem::table::{Table, Units};
use cannonpile_horizontal::certificate::{Certificate, write_certificate};
use clap::Args;

use super::Tension;
use crate::Culprit;
use crate::args::{BaseAt, ByMethod, Numbers, Output, Part, SceneOptions, narrower, spheres};
use crate::output::{Failure, Refused, write_to};
use crate::progress::Progress;

/// A scene, which of its spheres are asked about, and how the forces are found and shown.
#[derive(Args)]
pub(crate) struct Forces<P: Args> {
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    #[command(flatten)]
    part: P,
    #[command(flatten)]
    numbers: Numbers,
    #[command(flatten)]
    method: ByMethod,
    #[command(flatten)]
    output: Output,
    /// Write the proof of the elastic state to this file, for the command check
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    certificate: Option<PathBuf>,
}

/// `base`: the force of each bottom sphere on the floor.
pub(crate) type Base = Forces<BaseAt>;

/// `contacts`: the force of each contact between two spheres.
pub(crate) type Contacts = Forces<OfContacts>;

/// A part of the pile, and which of its contacts.
#[derive(Args)]
pub(crate) struct OfContacts {
    #[command(flatten)]
    part: Part,
    /// All horizontal contacts of the elastic state, also those that are open
    #[arg(long, help_heading = "Output")]
    touching: bool,
}

/// A table of forces.
struct Asked {
    doing: &'static str,
    /// The column with the force, positive for a push.
    column: &'static str,
    /// How many rows a sphere has.
    rows: usize,
    table: for<'p> fn(&Units<'p>, Selection) -> Result<Table<'p>, cannonpile_dem::Error>,
}

impl<P: Args> Forces<P> {
    /// Returns the scene, its pile with the horizontal forces of its state, and the proof of these, if it is wanted.
    fn read(&self) -> Result<(Scene, Pile, Option<Certificate>), Failure> {
        if self.certificate.is_none() {
            let (scene, pile) = self.scene.read_state()?;
            return Ok((scene, pile, None));
        }
        let (scene, pile) = self.scene.read_whole()?;
        if scene.state == State::Isostatic {
            return Err(Failure::Message(
                "--certificate: isostatic forces follow from balance alone and need none: give --state elastic, or leave \
                 it out"
                    .to_owned(),
            ));
        }
        let progress = Progress::begin("finding the elastic state");
        let elastic = scene.elastic(&pile)?;
        drop(progress);
        let certificate = elastic.certificate().cloned();
        let certificate = certificate.ok_or_else(|| {
            Failure::Message(
                "--certificate: that straight piles open is proved for all of them, and a file for this one would be too \
                 long: leave it out, or use fewer layers"
                    .to_owned(),
            )
        })?;
        Ok((scene, elastic.pile().clone(), Some(certificate)))
    }

    fn write(
        &self,
        (scene, pile, certificate): &(Scene, Pile, Option<Certificate>),
        selection: Selection,
        asked: &Asked,
    ) -> Result<bool, Failure> {
        self.output.format()?;
        let rows = spheres(pile, selection)? * asked.rows;
        let progress = Progress::of_rows(asked.doing, rows.try_into().ok());
        let units = self.method.of(self.numbers.units.of(scene, pile)?)?;
        let table = (asked.table)(&units, selection).map_err(|error| narrower(error, selection))?;
        if let Some(certificate) = certificate {
            write_to("certificate", self.certificate.as_deref(), |mut out| {
                Ok(write_certificate(certificate, &mut out)?)
            })?;
        }
        let pulls = Tension::in_column(asked.column);
        self.output
            .write_table(pulls.watch(table), self.numbers.number, &progress)?;
        drop(progress);
        pulls.note(pile, selection);
        Ok(true)
    }
}

impl Base {
    pub(crate) const HELP: &str = "\
Columns: i, j; normal, downwards, in mg; shear_x in mg·tanθ and shear_y in √3·mg·tanθ (2cosφ·mg·tanθ for another base
triangle), also in csv and json; with --units si all in N, for m = 1 kg and g = 1 m/s² unless these are given.

Examples:
  cannonpile base --layers 10
  cannonpile base --layers 10 --spacing 6/5 --units si --number f64 --output base.csv
  cannonpile base --layers 1000000000000000000000000000000 --at 5,7";

    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let read = self.read()?;
        let selection = self.part.selection(&read.1)?;
        let asked = Asked {
            doing: "forces on the floor",
            column: "normal",
            rows: 1,
            table: table::base,
        };
        self.write(&read, selection, &asked)
    }
}

impl Contacts {
    pub(crate) const HELP: &str = "\
Each row is a sphere (k, i, j), counted from k = 0 at the top, and its contact with the sphere below it in one direction.
The force is positive for a push, in mg/(3cosθ); with --units si in N and m, for R = 1 m, m = 1 kg and g = 1 m/s² unless
these are given, with the force on the upper sphere fx, fy, fz and the point of contact x, y, z. With --state elastic rows
of horizontal contacts that bear a force follow those of their sphere (k, i, j), whose neighbour is (i+1, j) for the
direction alpha-beta, (i, j+1) for alpha-gamma, (i+1, j-1) for gamma-beta; the neighbour has no row of its own for it.

Examples:
  cannonpile contacts --layers 4
  cannonpile contacts --stacking hcp --layers 7 --layer 4
  cannonpile contacts --stacking=+-+-+ --spacing 1 --state elastic
  cannonpile contacts --layers 20 --units si --number f64 --output contacts.csv";

    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let read = self.read()?;
        let (scene, pile, _) = &read;
        let selection = self.part.part.selection(pile)?;
        if self.part.touching && scene.state == State::Isostatic {
            return Err(Failure::Message(
                "--touching: horizontal contacts are those of the elastic state: give --state elastic, or leave it out"
                    .to_owned(),
            ));
        }
        if let Selection::One(site) = selection
            && site.k == pile.layers() - 1
        {
            return Err(Refused {
                remedy: Some("the command base"),
                ..Refused::of(Culprit::Site, cannonpile::Error::on_floor(site))
            }
            .into());
        }
        let asked = Asked {
            doing: "contact forces",
            column: "force",
            rows: pile.dimension().directions().len(),
            table: if self.part.touching {
                table::touching_contacts
            } else {
                table::contacts
            },
        };
        self.write(&read, selection, &asked)
    }
}
