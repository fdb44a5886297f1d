//! `base` and `contacts`: base forces and contact forces.

use std::io::Write;
use std::path::PathBuf;

use cannonpile::Pile;
use cannonpile::shape::Selection;
use cannonpile_dem::scene::{Floor, Scene, State};
use cannonpile_dem::table;
use cannonpile_dem::table::{Table, Units};
use cannonpile_horizontal::certificate::{Certificate, write_certificate};
use clap::Args;

use super::{CERTIFICATE_ON_ROUGH_FLOOR, ELASTIC, TensionCheck, write_accepted};
use crate::Culprit;
use crate::args::{
    BasePart, ExplainOption, MethodOption, Number, Numbers, Output, Part, SceneOptions, in_state,
    spheres, with_row_options,
};
use crate::output::{Failure, InputError};
use crate::progress::Progress;
use crate::tables::{Explanation, Wanted, Work};

/// The options of `base` and `contacts`: scene, selection `P`, numbers, method and output.
#[derive(Args)]
pub(crate) struct Forces<P: Args> {
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    #[command(flatten)]
    part: P,
    #[command(flatten)]
    numbers: Numbers,
    #[command(flatten)]
    method: MethodOption,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    explain: ExplainOption,
    /// File for the certificate of all forces of the pile, which the command check reads
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    certificate: Option<PathBuf>,
}

/// `base`: the force of each bottom sphere on the floor.
pub(crate) type Base = Forces<BasePart>;

/// `contacts`: the force of each contact between two spheres.
pub(crate) type Contacts = Forces<ContactPart>;

/// The selection of `contacts`: a part of the pile, and the kinds of contacts.
#[derive(Args)]
pub(crate) struct ContactPart {
    #[command(flatten)]
    part: Part,
    /// List the open horizontal contacts too, with --state elastic
    #[arg(long, help_heading = "Output")]
    touching: bool,
}

/// A table of forces.
struct ForceQuery {
    /// The text of the progress line.
    doing: &'static str,
    /// The column with the force, positive in compression.
    column: &'static str,
    wanted: Wanted,
    /// The number of rows of a sphere.
    rows: usize,
    /// The table of a pile on a rough floor.
    rough: for<'p> fn(&Units<'p>, Selection) -> Result<Table<'p>, cannonpile_dem::Error>,
    table: for<'p> fn(&Units<'p>, Selection) -> Result<Table<'p>, cannonpile_dem::Error>,
}

impl<P: Args> Forces<P> {
    /// Returns the scene, its pile with the horizontal forces of its state, and the certificate, if `--certificate` is given.
    fn read(&self) -> Result<(Scene, Pile, Option<Certificate>), Failure> {
        let (scene, pile) = self.scene.read_any()?;
        if scene.floor == Floor::Rough {
            self.method
                .refuse("forces on a rough floor have only one method")?;
            if self.certificate.is_some() {
                return Err(Failure::Message(CERTIFICATE_ON_ROUGH_FLOOR.to_owned()));
            }
        }
        if self.certificate.is_none() {
            let pile = in_state(&scene, pile)?;
            return Ok((scene, pile, None));
        }
        if scene.state == State::Isostatic {
            let progress = Progress::begin("computing the certificate");
            let exact = Certificate::of_forces(&pile)?;
            drop(progress);
            let certificate = match self.numbers.number {
                Number::F64 => exact.rounded()?,
                _ => exact,
            };
            return Ok((scene, pile, Some(certificate)));
        }
        let progress = Progress::begin("computing the elastic state");
        let elastic = scene.elastic(&pile)?;
        drop(progress);
        let certificate = elastic.certificate().cloned();
        let certificate = certificate.ok_or_else(|| {
            Failure::Message(
                "--certificate: the certificate of this pile would be too large (the elastic state of straight piles is \
                 proved for every L): leave it out, or use fewer layers"
                    .to_owned(),
            )
        })?;
        Ok((scene, elastic.pile().clone(), Some(certificate)))
    }

    fn write(
        &self,
        (scene, pile, certificate): &(Scene, Pile, Option<Certificate>),
        selection: Selection,
        query: &ForceQuery,
    ) -> Result<bool, Failure> {
        let format = self.output.format()?;
        let rows = spheres(pile, selection)? * query.rows;
        let progress = Progress::of_rows(query.doing, rows.try_into().ok());
        let units = self.method.apply(self.numbers.units.of(scene, pile)?)?;
        let table = match scene.floor {
            Floor::Rough => query.rough,
            _ => query.table,
        };
        let table = table(&units, selection).map_err(|error| with_row_options(error, selection))?;
        let tension = TensionCheck::in_column(query.column);
        let table = tension.watch(table);
        let content =
            |out: &mut dyn Write| table.write(format.into(), self.numbers.number.into(), out);
        self.output.write_with(&progress, content, None, || {
            let (Some(certificate), Some(file)) = (certificate, &self.certificate) else {
                return Ok(());
            };
            write_accepted(file, |out| write_certificate(certificate, out))
        })?;
        drop(progress);
        self.explain.print(|| match (scene.floor, scene.state) {
            (Floor::Rough, _) => Ok(Work::of_whole(
                pile,
                "friction on the floor couples all forces",
            )),
            (_, State::Elastic) => Ok(Work::of_whole(pile, ELASTIC)),
            _ => Ok(Explanation::new(&units, query.wanted, selection)?.work(None)),
        })?;
        tension.note(pile, selection);
        Ok(true)
    }
}

impl Base {
    pub(crate) const HELP: &str = "\
Columns (force of the pile on the floor):
  i, j      bottom sphere
  normal    downward force, in mg
  shear_x   horizontal force along x, in mg·tanθ
  shear_y   horizontal force along y, in √3·mg·tanθ (in 2cosφ·mg·tanθ with --sin-phi)
With --units si all forces are in N.

With --floor rough the horizontal force is friction, in friction_x and friction_y. Its units are mg·tan(θ/2) along x and
√3·mg·tan(θ/2) along y (2cosφ·mg·tan(θ/2) with --sin-phi).

--certificate writes all forces of the pile for the command check: exact ones, or with --number f64 the floats and
their largest error. With --state elastic it proves that the state has the least energy.

Examples:
  cannonpile base --layers 10
  cannonpile base --layers 10 --spacing 6/5 --units si --number f64 --output base.csv
  cannonpile base --layers 1000000000000000000000000000000 --at 5,7";

    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let read = self.read()?;
        let selection = self.part.selection(&read.1)?;
        let query = ForceQuery {
            doing: "base forces",
            column: "normal",
            wanted: Wanted::Base,
            rows: 1,
            rough: table::rough_base,
            table: table::base,
        };
        self.write(&read, selection, &query)
    }
}

impl Contacts {
    pub(crate) const HELP: &str = "\
Columns:
  k, i, j      upper sphere of the contact, with k = 0 at the top
  direction    direction to the lower sphere: alpha, beta or gamma
  force        contact force, positive in compression, in mg/(3cosθ); in N with --units si
  fx, fy, fz   with --units si: force on the upper sphere, in N
  x, y, z      with --units si: contact point, in m

With --state elastic closed horizontal contacts have rows too, once for each pair. Their direction gives the neighbour:
  alpha-beta (i+1, j)    alpha-gamma (i, j+1)    gamma-beta (i+1, j-1)

With --floor rough the columns after direction are
  normal, tangential   in mg and mg·tan(θ/2); in N with --units si
  nx to nz, tx to tz   with --units si: both forces as vectors on the upper sphere, in N
  x, y, z              with --units si: contact point, in m

--certificate writes all forces of the pile for the command check: exact ones, or with --number f64 the floats and
their largest error. With --state elastic it proves that the state has the least energy.

Examples:
  cannonpile contacts --layers 4
  cannonpile contacts --stacking hcp --layers 4 --certificate forces.json
  cannonpile contacts --stacking hcp --layers 7 --layer 4
  cannonpile contacts --stacking=+-+-+ --spacing 1 --state elastic
  cannonpile contacts --layers 2 --floor rough --units si
  cannonpile contacts --layers 20 --units si --number f64 --output contacts.csv";

    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let read = self.read()?;
        let (scene, pile, _) = &read;
        let selection = self.part.part.selection(pile)?;
        if self.part.touching && scene.floor == Floor::Rough {
            return Err(Failure::Message(
                "--touching: on a rough floor neighbours of a layer do not touch: leave it out"
                    .to_owned(),
            ));
        }
        if self.part.touching && scene.state == State::Isostatic {
            return Err(Failure::Message(
                "--touching: only the elastic state has horizontal contacts: add --state elastic, or leave it out"
                    .to_owned(),
            ));
        }
        if let Selection::One(site) = selection
            && site.k == pile.layers() - 1
        {
            return Err(InputError {
                remedy: Some("the command base"),
                ..InputError::of(Culprit::Site, cannonpile::Error::OnFloor { site })
            }
            .into());
        }
        let query = ForceQuery {
            doing: "contact forces",
            column: "force",
            wanted: Wanted::Contacts,
            rows: pile.dimension().directions().len(),
            rough: table::rough_contacts,
            table: if self.part.touching {
                table::touching_contacts
            } else {
                table::contacts
            },
        };
        self.write(&read, selection, &query)
    }
}
