//! A whole pile as files: for spreadsheets, LAMMPS, ParaView, YADE.

mod base;
mod contacts;
mod folder;
mod lammps;
mod polydata;
mod progress;
mod rounded;
mod spheres;
mod springs;
mod vtp;
mod yade;

use std::io::Write;
use std::path::{Path, PathBuf};

use num_bigint::BigUint;

use crate::shape::{Numbering, Selection};
use crate::table::{Cell, Column, Table, WriteError, refuse_beyond};
use crate::{Error, Packing, Pile};

use progress::Progress;

/// The program that a pile is written for.
///
/// # Examples
/// ```
/// use cannonpile::dem::PileFormat;
///
/// let names = PileFormat::Lammps.files().iter().map(|file| file.name());
/// assert!(names.eq(["pile.data", "pile.in"]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PileFormat {
    /// Any: `spheres.csv`, `contacts.csv`, `base.csv`.
    Csv,
    /// LAMMPS: `pile.data`, and `pile.in`, which relaxes it and writes the forces.
    Lammps,
    /// ParaView: `spheres.vtp`, `contacts.vtp`.
    Vtp,
    /// YADE: `spheres.txt`, and `pile.py`, which relaxes it and writes the forces.
    Yade,
}

impl PileFormat {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Csv, Self::Lammps, Self::Vtp, Self::Yade];

    /// Its files, in the order in which they are written.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::dem::{PileFile, PileFormat};
    ///
    /// assert_eq!(PileFormat::Yade.files(), [PileFile::YadeSpheres, PileFile::YadeScript]);
    /// assert_eq!(PileFormat::ALL.map(|format| format.files().len()), [3, 2, 2, 2]);
    /// ```
    #[must_use]
    pub const fn files(self) -> &'static [PileFile] {
        match self {
            Self::Csv => &[
                PileFile::SpheresCsv,
                PileFile::ContactsCsv,
                PileFile::BaseCsv,
            ],
            Self::Lammps => &[PileFile::LammpsData, PileFile::LammpsInput],
            Self::Vtp => &[PileFile::SpheresVtp, PileFile::ContactsVtp],
            Self::Yade => &[PileFile::YadeSpheres, PileFile::YadeScript],
        }
    }
}

/// One of the files that a pile is written to.
///
/// All numbers are in SI, each the float nearest to the exact one, with the digits that read back the same. Spheres
/// have the numbers of [`Numbering`] in all of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PileFile {
    /// `spheres.csv`: the table of [`table::spheres`](crate::table::spheres).
    SpheresCsv,
    /// `contacts.csv`: `id1,id2,force,fx,fy,fz`; id1 is the upper sphere, on which the force acts.
    ContactsCsv,
    /// `base.csv`: the table of [`table::base`](crate::table::base), a row for each sphere of the floor; the n-th is
    /// that of sphere [`first_on_floor`](Numbering::first_on_floor) + n − 1.
    BaseCsv,
    /// `pile.data`: spheres of `atom_style sphere`, those on the floor of type 2.
    LammpsData,
    /// `pile.in`: lets the pile relax on springs, and writes the forces to `forces.dump`.
    LammpsInput,
    /// `spheres.vtp`: points with `id`, `layer`, `radius`, `weight`, `load` and `reaction`, the force of the floor.
    SpheresVtp,
    /// `contacts.vtp`: lines between centres with `id1`, `id2`, `direction` (0, 1, 2 for α, β, γ), `force` and
    /// `force_vector`, that on the upper sphere; `force` at the ends too, which tubes are as wide as.
    ContactsVtp,
    /// `spheres.txt`: `x y z r`, for `ymport.text`; sphere n is body n − 1.
    YadeSpheres,
    /// `pile.py`: lets the pile relax, and writes the forces to `forces.csv`.
    YadeScript,
}

impl PileFile {
    /// The name of the file.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::dem::PileFile;
    ///
    /// assert_eq!(PileFile::ContactsCsv.name(), "contacts.csv");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::SpheresCsv => "spheres.csv",
            Self::ContactsCsv => "contacts.csv",
            Self::BaseCsv => "base.csv",
            Self::LammpsData => "pile.data",
            Self::LammpsInput => "pile.in",
            Self::SpheresVtp => "spheres.vtp",
            Self::ContactsVtp => "contacts.vtp",
            Self::YadeSpheres => "spheres.txt",
            Self::YadeScript => "pile.py",
        }
    }
}

/// A file that was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// Which one.
    pub file: PileFile,
    /// Where it is.
    pub path: PathBuf,
    /// Its spheres or contacts; none in a script.
    pub rows: Option<u64>,
    /// Its size.
    pub bytes: u64,
}

/// A pile to be written as files.
///
/// # Examples
/// ```
/// use cannonpile::dem::{PileExport, PileFormat};
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
    packing: Packing<'p>,
    numbering: Numbering<'p>,
}

impl<'p> PileExport<'p> {
    /// The files of this pile.
    ///
    /// # Errors
    /// [`Error::TooManyRows`] for more than [`MAX_ROWS`](crate::table::MAX_ROWS) contacts, [`Error::TooLarge`] if a
    /// layer does not fit in memory where forces have to be swept.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::dem::PileExport;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let pile = Pile::triangular(100_000)?;
    /// assert!(PileExport::new(&Packing::new(&pile, &spacing)?).is_err());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn new(packing: &Packing<'p>) -> Result<Self, Error> {
        let pile = packing.pile();
        let remedy = "use fewer layers, or a smaller top or base";
        refuse_beyond(&pile.spheres().max(pile.contacts()), remedy)?;
        pile.plan(Selection::All)?;
        pile.plan(Selection::Base)?;
        Ok(Self {
            numbering: pile.numbering()?,
            packing: packing.clone(),
        })
    }

    /// The pile with its sizes and weights.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::dem::PileExport;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let export = PileExport::new(&packing.with_radius(BigRational::new(1.into(), 100.into()))?)?;
    /// assert_eq!(export.packing().radius().to_string(), "1/100");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn packing(&self) -> &Packing<'p> {
        &self.packing
    }

    /// The numbers that its spheres have in all files.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::dem::PileExport;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // The row n of `base.csv` is that of sphere 165 + n.
    /// let export = PileExport::new(&packing)?;
    /// assert_eq!(export.numbering().first_on_floor(), 166);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn numbering(&self) -> &Numbering<'p> {
        &self.numbering
    }

    fn pile(&self) -> &'p Pile {
        self.packing.pile()
    }

    /// The spheres or contacts of a file; none in a script.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::dem::{PileExport, PileFile};
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let export = PileExport::new(&packing)?;
    /// assert_eq!(export.rows(PileFile::ContactsVtp), Some(495));
    /// assert_eq!(export.rows(PileFile::LammpsInput), None);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn rows(&self, file: PileFile) -> Option<u64> {
        // Not more than the most rows.
        let few = |count: BigUint| u64::try_from(count).ok();
        match file {
            PileFile::SpheresCsv
            | PileFile::LammpsData
            | PileFile::SpheresVtp
            | PileFile::YadeSpheres => Some(self.numbering.spheres()),
            PileFile::ContactsCsv | PileFile::ContactsVtp => few(self.pile().contacts()),
            PileFile::BaseCsv => few(self.pile().base_spheres()),
            PileFile::LammpsInput | PileFile::YadeScript => None,
        }
    }

    /// Writes one file. Memory does not grow with its rows; `progress` is told from time to time how many more of
    /// them are done, all of them in the end.
    ///
    /// # Errors
    /// [`WriteError::Answer`] with [`Error::Overflow`] if a number does not fit in an `f64`; [`WriteError::Io`] if the
    /// output refuses.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::dem::{PileExport, PileFile};
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
    ///     Some("1,2,0.46225016352102427,0.16012815380508713,0.2773500981126146,0.3333333333333333"),
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
        let mut progress = Progress::of(progress);
        let progress = &mut progress;
        match file {
            PileFile::SpheresCsv => spheres::write(self, out, progress),
            PileFile::ContactsCsv => contacts::write(self, out, progress),
            PileFile::BaseCsv => base::write(self, out, progress),
            PileFile::LammpsData => lammps::write_data(self, out, progress),
            PileFile::LammpsInput => lammps::write_input(self, out),
            PileFile::SpheresVtp => vtp::write_spheres(self, out, progress),
            PileFile::ContactsVtp => vtp::write_contacts(self, out, progress),
            PileFile::YadeSpheres => yade::write_spheres(self, out, progress),
            PileFile::YadeScript => yade::write_script(self, out),
        }
    }

    /// Writes all files of some formats into a folder, which is made if it is not there.
    ///
    /// They are written aside and renamed when the last is complete: a failure leaves no new file and no new folder,
    /// and what was there as it was.
    ///
    /// # Errors
    /// [`WriteError::Answer`] as for [`write_file`](Self::write_file); [`WriteError::File`], which names the file or
    /// the folder that could not be written.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::dem::{PileExport, PileFormat};
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let folder = tempfile::tempdir()?;
    /// let new = folder.path().join("new/pile");
    /// let written = PileExport::new(&packing)?.write(&PileFormat::ALL, &new, &mut |_| {})?;
    /// assert_eq!((written.len(), new.read_dir()?.count()), (9, 9));
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
        folder::write(self, formats, folder, progress)
    }
}

/// Files that were written, one a row: `file, rows, bytes`.
///
/// # Examples
/// ```
/// use cannonpile::dem::{self, PileFile, Written};
/// use cannonpile::table::{FileFormat, NumberFormat};
///
/// let (file, path) = (PileFile::LammpsData, "pile.data".into());
/// let written = [Written { file, path, rows: Some(220), bytes: 20_000 }];
/// let mut csv = Vec::new();
/// dem::files(&written).write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
/// assert_eq!(String::from_utf8(csv)?, "file,rows,bytes\npile.data,220,20000\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn files(written: &[Written]) -> Table<'static> {
    let row = |written: &Written| {
        let rows = written.rows.map(|rows| Cell::Integer(rows.into()));
        Ok(vec![
            Cell::Word(written.path.display().to_string().into()),
            rows.unwrap_or(Cell::Missing),
            Cell::Integer(written.bytes.into()),
        ])
    };
    let columns = ["file", "rows", "bytes"].map(Column::plain).into();
    Table::of_rows(columns, "files", written.iter().map(row).collect())
}
