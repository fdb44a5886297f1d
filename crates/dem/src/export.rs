//! The export of a pile to files.

use std::io::Write;
use std::path::Path;

use num_bigint::BigUint;

use super::card::CardTitle;
use super::file::{OtherFile, PileFile, PileFormat, Written};
use super::matrix::{Equations, Rows};
use super::numbered::NumberedPile;
use super::rough::{self, Friction};
use super::{card, csv, lammps, vtp, yade};
use crate::Error;
use crate::table::{Progress, WriteError, write_all};
use cannonpile::Packing;
use cannonpile::shape::{Numbering, Selection};
use cannonpile_stability::RoughPacking;

/// A pile with its export options.
///
/// # Examples
/// ```
/// use cannonpile_dem::{PileExport, PileFormat};
/// use cannonpile::geometry::Spacing;
/// use cannonpile::{Packing, Pile};
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(10)?;
/// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
/// let export = PileExport::new(&packing)?;
///
/// let folder = tempfile::tempdir()?;
/// let written = export.write(&[PileFormat::Lammps], folder.path(), &mut |_| {})?;
/// assert_eq!(written[0].rows, Some(220));
/// assert!(folder.path().join("pile.in").exists());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct PileExport<'p> {
    pile: NumberedPile<'p>,
    scene: Option<String>,
    title: CardTitle,
    /// The coefficients of friction, on a rough floor.
    friction: Option<Friction>,
    /// True if the files of spheres contain their stress.
    with_stress: bool,
    /// True if the equations of equilibrium are in newtons, not in f₀.
    equations_in_si: bool,
}

impl<'p> PileExport<'p> {
    /// Returns the export of a packing.
    ///
    /// # Errors
    /// [`Error::TooManyRows`](cannonpile::Error::TooManyRows) for more than [`MAX_ROWS`](crate::table::MAX_ROWS)
    /// contacts; [`Error::TooLarge`](cannonpile::Error::TooLarge) if the forces need a sweep and a layer does not fit
    /// in memory.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::PileExport;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let pile = Pile::triangular(100_000)?;
    /// assert!(PileExport::new(&Packing::new(&pile, &spacing)?).is_err());
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn new(packing: &Packing<'p>) -> Result<Self, Error> {
        let pile = packing.pile();
        let numbered = NumberedPile::new(packing)?;
        pile.plan(Selection::All)?;
        pile.plan(Selection::Base)?;
        Ok(Self {
            pile: numbered,
            scene: None,
            title: CardTitle::default(),
            friction: None,
            with_stress: false,
            equations_in_si: false,
        })
    }

    /// Adds `scene.toml` with the text of the scene that describes the pile.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::{PileExport, PileFormat};
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(3)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let export = PileExport::new(&packing)?.with_scene("layers = 3\n".into());
    /// let folder = tempfile::tempdir()?;
    /// export.write(&[PileFormat::Yade], folder.path(), &mut |_| {})?;
    /// assert_eq!(std::fs::read(folder.path().join("scene.toml"))?, b"layers = 3\n");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_scene(self, toml: String) -> Self {
        let scene = Some(toml);
        Self { scene, ..self }
    }

    /// Adds the stress of each sphere times its volume to `spheres.csv` and `spheres.vtp`, in N·m as from
    /// [`Packing::stress`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Packing, Pile};
    /// use cannonpile_dem::{PileExport, PileFile};
    ///
    /// let pile = Pile::discs(2)?;
    /// let export = PileExport::new(&Packing::new(&pile, &"6/5".parse()?)?)?.with_stress();
    /// let mut csv = Vec::new();
    /// export.write_file(PileFile::SpheresCsv, &mut csv, &mut |_| {})?;
    /// let apex = String::from_utf8(csv)?.lines().nth(1).map(str::to_owned);
    /// assert!(apex.is_some_and(|apex| apex.ends_with(",0.45,0.8,0.0")));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_stress(self) -> Self {
        Self {
            with_stress: true,
            ..self
        }
    }

    /// Writes the equations of [`PileFormat::Mtx`] in newtons, as floats, and not as integers in f₀. They balance the
    /// components of the forces on each sphere along x, y and z, or x and z for discs.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Packing, Pile};
    /// use cannonpile_dem::{PileExport, PileFile};
    ///
    /// let pile = Pile::discs(2)?;
    /// let export = PileExport::new(&Packing::new(&pile, &"6/5".parse()?)?)?.with_equations_in_si();
    /// let mut matrix = Vec::new();
    /// export.write_file(PileFile::EquilibriumMtx, &mut matrix, &mut |_| {})?;
    /// assert!(String::from_utf8(matrix)?.ends_with("2 2 4\n1 1 0.6\n2 1 0.8\n1 2 -0.6\n2 2 0.8\n"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_equations_in_si(self) -> Self {
        Self {
            equations_in_si: true,
            ..self
        }
    }

    fn equations(&self) -> Result<Equations<'_, 'p>, Error> {
        Equations::new(&self.pile, self.equations_in_si)
    }

    /// Sets the texts of cards and the titles of tests.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::{CardTitle, PileExport, PileFile};
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(3)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let title = CardTitle { title: "Three layers".into(), ..CardTitle::default() };
    /// let mut card = Vec::new();
    /// let export = PileExport::new(&packing)?.with_title(title);
    /// export.write_file(PileFile::CardMarkdown, &mut card, &mut |_| {})?;
    /// assert!(card.starts_with(b"# Three layers\n"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_title(self, title: CardTitle) -> Self {
        Self { title, ..self }
    }

    /// Returns the export of the pile on a rough floor. Only [`PileFormat::Lammps`], [`PileFormat::Yade`] and [`PileFormat::Card`]
    /// support it.
    ///
    /// # Errors
    /// [`RoughFloor`](cannonpile_stability::Error::RoughFloor).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Packing, Pile};
    /// use cannonpile_dem::{Friction, PileExport, PileFile};
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?;
    /// let export = PileExport::new(&packing)?.on_rough_floor(Friction::sufficient(&packing)?)?;
    /// let mut script = Vec::new();
    /// export.write_file(PileFile::LammpsInput, &mut script, &mut |_| {})?;
    /// assert!(String::from_utf8(script)?.contains("wall/gran granular"));
    /// assert!(export.write_file(PileFile::ContactsCsv, &mut Vec::new(), &mut |_| {}).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn on_rough_floor(self, friction: Friction) -> Result<Self, Error> {
        RoughPacking::new(self.packing())?;
        let friction = Some(friction);
        Ok(Self { friction, ..self })
    }

    /// Returns the packing.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::PileExport;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let export = PileExport::new(&packing.with_radius(BigRational::new(1.into(), 100.into()))?)?;
    /// assert_eq!(export.packing().radius().to_string(), "1/100");
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub fn packing(&self) -> &Packing<'p> {
        self.pile.packing()
    }

    /// Returns the numbers of the spheres, which are the same in all files.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::PileExport;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // Row n of `base.csv` belongs to sphere 165 + n.
    /// let export = PileExport::new(&packing)?;
    /// assert_eq!(export.numbering().first_on_floor(), 166);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub fn numbering(&self) -> &Numbering<'p> {
        self.pile.numbering()
    }

    /// Returns the number of spheres or contacts that a file lists; `None` for a file without such a list, such as a
    /// script.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::{PileExport, PileFile};
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let export = PileExport::new(&packing)?;
    /// assert_eq!(export.rows(PileFile::ContactsVtp), Some(495));
    /// assert_eq!(export.rows(PileFile::LammpsInput), None);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub fn rows(&self, file: PileFile) -> Option<u64> {
        // The counts do not exceed the maximal number of rows.
        let few = |count: BigUint| u64::try_from(count).ok();
        match file {
            PileFile::SpheresCsv
            | PileFile::LammpsData
            | PileFile::SpheresVtp
            | PileFile::YadeSpheres => Some(self.numbering().sphere_count()),
            PileFile::ContactsCsv | PileFile::ContactsVtp => few(self.pile.contact_count()),
            PileFile::BaseCsv => few(self.pile.pile().base_sphere_count()),
            PileFile::EquilibriumMtx => few(self.equations().ok()?.entries().ok()?),
            PileFile::LoadsMtx | PileFile::ForcesMtx | PileFile::ForcesExact => {
                few(self.equations().ok()?.unknowns())
            }
            _ => None,
        }
    }

    /// Writes one file. The memory does not grow with its rows. `progress` is called from time to time with the number
    /// of further rows written, including the last ones.
    ///
    /// # Errors
    /// * [`WriteError::Answer`] with [`Error::Overflow`](cannonpile::Error::Overflow) if a number does not fit in an
    ///   `f64`.
    /// * [`WriteError::Answer`] with [`Error::NoEquations`] for the equations of a pile that has none.
    /// * [`WriteError::Answer`] with [`Error::GluedOnly`] for a file that a rough floor does not support.
    /// * [`WriteError::Io`] if writing to `out` fails.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::{PileExport, PileFile};
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let (mut csv, mut rows) = (Vec::new(), 0);
    /// let export = PileExport::new(&packing)?;
    /// export.write_file(PileFile::ContactsCsv, &mut csv, &mut |more| rows += more)?;
    /// let csv = String::from_utf8(csv)?;
    /// assert_eq!(
    ///     csv.lines().nth(1),
    ///     Some("1,2,0.46225016352102427,0.16012815380508713,0.2773500981126146,0.3333333333333333,0,0,0,alpha"),
    /// );
    /// assert_eq!(rows, 3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn write_file(
        &self,
        file: PileFile,
        out: &mut dyn Write,
        progress: &mut dyn FnMut(u64),
    ) -> Result<(), WriteError> {
        let (pile, mut row) = (&self.pile, Progress::new(progress));
        let row = &mut || row.row();
        self.check_floor(file)?;
        let scene = self.scene.as_deref();
        match file {
            PileFile::SpheresCsv => csv::write_spheres(pile, self.with_stress, out, row),
            PileFile::ContactsCsv => csv::write_contacts(pile, out, row),
            PileFile::BaseCsv => csv::write_base(pile, out, row),
            PileFile::ColumnsCsv => csv::write_columns(pile, self.with_stress, out),
            PileFile::LammpsData => lammps::write_data(pile, out, row),
            PileFile::LammpsInput => match &self.friction {
                None => lammps::write_input(pile, out),
                Some(friction) => rough::write_lammps(pile, friction, out),
            },
            PileFile::SpheresVtp => vtp::write_spheres(pile, self.with_stress, out, row),
            PileFile::ContactsVtp => vtp::write_contacts(pile, out, row),
            PileFile::YadeSpheres => yade::write_spheres(pile, out, row),
            PileFile::YadeScript => match &self.friction {
                None => yade::write_script(pile, out),
                Some(friction) => rough::write_yade(pile, friction, out),
            },
            PileFile::CardMarkdown => {
                card::write_markdown(pile, &self.title, self.friction.as_ref(), scene, out)
            }
            PileFile::CardJson => {
                card::write_json(pile, &self.title, self.friction.as_ref(), scene, out)
            }
            PileFile::EquilibriumMtx
            | PileFile::LoadsMtx
            | PileFile::ForcesMtx
            | PileFile::ForcesExact => self.equations()?.write(file, &mut Rows { out, row }),
            PileFile::PropertiesJson => {
                let properties = self.equations()?.properties(scene)?;
                Ok(writeln!(out, "{properties:#}")?)
            }
            PileFile::Scene => Ok(out.write_all(scene.unwrap_or("").as_bytes())?),
        }
    }

    /// Checks that the floor of the export supports a file.
    fn check_floor(&self, file: PileFile) -> Result<(), Error> {
        match file {
            PileFile::LammpsInput
            | PileFile::LammpsData
            | PileFile::YadeScript
            | PileFile::YadeSpheres
            | PileFile::CardMarkdown
            | PileFile::CardJson
            | PileFile::Scene => Ok(()),
            PileFile::EquilibriumMtx if self.friction.is_none() => self.equations().map(drop),
            _ if self.friction.is_none() => Ok(()),
            _ => Err(Error::GluedOnly { file: file.name() }),
        }
    }

    /// Writes all files of some formats into a folder, which is created if necessary.
    ///
    /// The files are written under temporary names, and renamed when the last one is complete. A failure leaves no new
    /// file or folder, and leaves existing files unchanged.
    ///
    /// # Errors
    /// [`WriteError::Answer`] as for [`write_file`](Self::write_file); [`WriteError::File`] with the path of the file
    /// or folder that could not be written.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::{PileExport, PileFormat};
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let folder = tempfile::tempdir()?;
    /// let new = folder.path().join("new/pile");
    /// let written = PileExport::new(&packing)?.write(&PileFormat::ALL, &new, &mut |_| {})?;
    /// assert_eq!((written.len(), new.read_dir()?.count()), (17, 17));
    /// for file in written {
    ///     assert_eq!(file.path.metadata()?.len(), file.bytes);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn write(
        &self,
        formats: &[PileFormat],
        folder: &Path,
        progress: &mut dyn FnMut(u64),
    ) -> Result<Vec<Written>, WriteError> {
        self.write_with(formats, &[], folder, progress)
    }

    /// Writes all files of some formats into a folder like [`write`](Self::write), together with files of the caller.
    ///
    /// The files of the caller follow those of the formats, and precede `scene.toml`.
    ///
    /// # Errors
    /// As for [`write`](Self::write), and the errors of the files of the caller.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Packing, Pile};
    /// use cannonpile_dem::{OtherFile, PileExport, PileFormat};
    ///
    /// let pile = Pile::triangular(3)?;
    /// let export = PileExport::new(&Packing::new(&pile, &"6/5".parse()?)?)?;
    /// let notes = OtherFile { name: "notes.txt", write: &|out| Ok(out.write_all(b"ten spheres")?) };
    /// let folder = tempfile::tempdir()?;
    /// let written = export.write_with(&[PileFormat::Yade], &[notes], folder.path(), &mut |_| {})?;
    /// let names: Vec<_> = written.iter().map(|written| written.name()).collect();
    /// assert_eq!(names, ["spheres.txt", "pile.py", "notes.txt"]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn write_with(
        &self,
        formats: &[PileFormat],
        others: &[OtherFile<'_>],
        folder: &Path,
        progress: &mut dyn FnMut(u64),
    ) -> Result<Vec<Written>, WriteError> {
        for file in formats.iter().flat_map(|format| format.files()) {
            self.check_floor(*file)?;
        }
        let mut formats = formats.to_vec();
        formats.sort_unstable();
        formats.dedup();
        let of_formats = formats.iter().flat_map(|format| format.files());
        let scene = self.scene.as_ref().map(|_| PileFile::Scene);
        let files = of_formats.map(|file| ToWrite::Own(*file));
        let files = files.chain(others.iter().map(|file| ToWrite::Other(*file)));
        let files: Vec<_> = files.chain(scene.map(ToWrite::Own)).collect();
        let paths = files.iter().map(|file| (folder.join(file.name()), *file));
        let written = write_all(folder, paths, |file, out| match file {
            ToWrite::Own(file) => self.write_file(file, out, progress),
            ToWrite::Other(file) => (file.write)(out),
        })?;
        let written = files.into_iter().zip(written);
        let written = written.map(|(file, (path, bytes))| {
            let file = file.own();
            Written {
                file,
                path,
                rows: file.and_then(|file| self.rows(file)),
                bytes,
            }
        });
        Ok(written.collect())
    }
}

/// A file of this crate, or a file of the caller.
#[derive(Clone, Copy)]
enum ToWrite<'f> {
    Own(PileFile),
    Other(OtherFile<'f>),
}

impl<'f> ToWrite<'f> {
    fn name(&self) -> &'f str {
        match self {
            Self::Own(file) => file.name(),
            Self::Other(file) => file.name,
        }
    }

    fn own(&self) -> Option<PileFile> {
        match self {
            Self::Own(file) => Some(*file),
            Self::Other(_) => None,
        }
    }
}
