//! The files of an export.

use crate::Each;
use core::fmt;
use std::io::Write;
use std::path::PathBuf;

use crate::table::{Cell, Column, Table, WriteError};

/// An export format, named after the program that reads it.
///
/// # Examples
/// ```
/// use cannonpile_dem::PileFormat;
///
/// let names = PileFormat::Lammps.files().iter().map(|file| file.name());
/// assert!(names.eq(["pile.data", "pile.in"]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum PileFormat {
    /// Any program: `spheres.csv`, `contacts.csv`, `base.csv`, and `columns.csv`, which explains their columns.
    Csv,
    /// LAMMPS: `pile.data`, and `pile.in`, which relaxes the pile and writes its forces. All springs are equal, so
    /// forces given to horizontal contacts are not reproduced.
    Lammps,
    /// ParaView: `spheres.vtp`, `contacts.vtp`.
    Vtp,
    /// YADE: `spheres.txt`, and `pile.py`, which relaxes the pile and writes its forces. All springs are equal, as for
    /// LAMMPS.
    Yade,
    /// A benchmark card: `card.md` for readers, `card.json` for programs. It contains the pile, the exact answers,
    /// their accuracy, the criteria for a code, and the references.
    Card,
    /// Solvers of linear equations: `equilibrium.mtx`, `loads.mtx`, `forces.mtx`, `forces_exact.txt` and
    /// `properties.json`. It needs two layers, and a pile without horizontal contact forces.
    Mtx,
}

impl PileFormat {
    /// All formats.
    pub const ALL: [Self; 6] = [
        Self::Csv,
        Self::Lammps,
        Self::Vtp,
        Self::Yade,
        Self::Card,
        Self::Mtx,
    ];

    /// Returns the files of the format, in writing order.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::{PileFile, PileFormat};
    ///
    /// assert_eq!(PileFormat::Yade.files(), [PileFile::YadeSpheres, PileFile::YadeScript]);
    /// assert_eq!(PileFormat::ALL.map(|format| format.files().len()), [4, 2, 2, 2, 2, 5]);
    /// ```
    #[must_use]
    pub const fn files(self) -> &'static [PileFile] {
        match self {
            Self::Csv => &[
                PileFile::SpheresCsv,
                PileFile::ContactsCsv,
                PileFile::BaseCsv,
                PileFile::ColumnsCsv,
            ],
            Self::Lammps => &[PileFile::LammpsData, PileFile::LammpsInput],
            Self::Vtp => &[PileFile::SpheresVtp, PileFile::ContactsVtp],
            Self::Yade => &[PileFile::YadeSpheres, PileFile::YadeScript],
            Self::Card => &[PileFile::CardMarkdown, PileFile::CardJson],
            Self::Mtx => &[
                PileFile::EquilibriumMtx,
                PileFile::LoadsMtx,
                PileFile::ForcesMtx,
                PileFile::ForcesExact,
                PileFile::PropertiesJson,
            ],
        }
    }
}

/// A file of an export.
///
/// All numbers are in SI units and correctly rounded, with the fewest digits that read back the same; the files of
/// [`PileFormat::Mtx`] are exact unless the export is [in SI units](super::PileExport::with_equations_in_si). Spheres have the
/// numbers of [`Numbering`](cannonpile::shape::Numbering) in all files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum PileFile {
    /// `spheres.csv`: the table of [`table::spheres`](crate::table::spheres), and `load`, the downward force in
    /// addition to the weight. With [`with_stress`](super::PileExport::with_stress) the columns of
    /// [`table::spheres_with_stress`](crate::table::spheres_with_stress) follow, in SI units.
    SpheresCsv,
    /// `contacts.csv`: `id1,id2,force,fx,fy,fz,k,i,j,direction`. The force acts on id1, the upper sphere, which has the
    /// site k, i, j.
    ContactsCsv,
    /// `base.csv`: the table of [`table::base`](crate::table::base), one row per bottom sphere, with its `id`.
    BaseCsv,
    /// `columns.csv`: `file,column,unit,meaning`, one row per column of the other three files.
    ColumnsCsv,
    /// `pile.data`: spheres of `atom_style sphere`; bottom spheres have type 2.
    LammpsData,
    /// `pile.in`: relaxes the pile on springs, and writes the forces to `forces.dump`.
    LammpsInput,
    /// `spheres.vtp`: points with `id`, `layer`, `radius`, `weight`, `load` and `reaction`, the force from the floor. With
    /// [`with_stress`](super::PileExport::with_stress) also `stress`, times the volume, as nine components.
    SpheresVtp,
    /// `contacts.vtp`: lines between centres with `id1`, `id2`, `direction` (0, 1, 2 for α, β, γ), `force`, and
    /// `force_vector` on the upper sphere. Both end points also have `force`, for the width of tubes.
    ContactsVtp,
    /// `spheres.txt`: `x y z r` for `ymport.text`; sphere n is body n − 1.
    YadeSpheres,
    /// `pile.py`: relaxes the pile, and writes the forces to `forces.csv`.
    YadeScript,
    /// `card.md`: the benchmark in Markdown. Lists of more than 130 rows are only in the csv files.
    CardMarkdown,
    /// `card.json`: the benchmark for programs. Each number is `{"exact": …, "float": …}`, with the exact number as
    /// text. Lists of more than 10,000 rows are only in the csv files.
    CardJson,
    /// `equilibrium.mtx`: the equations of equilibrium of the spheres above the floor as a sparse matrix in the format of
    /// Matrix Market. Column d (id − 1) + l + 1 is the contact force of sphere `id` along line l = 0 … d − 1, with d = 3
    /// for spheres and 2 for discs.
    EquilibriumMtx,
    /// `loads.mtx`: the right-hand side, times the denominator in its comment.
    LoadsMtx,
    /// `forces.mtx`: the solution, correctly rounded.
    ForcesMtx,
    /// `forces_exact.txt`: the exact solution, a number a line.
    ForcesExact,
    /// `properties.json`: the size, the determinant, the condition number and the singular values of the matrix.
    PropertiesJson,
    /// `scene.toml`: the scene of the pile, written with any format if it is [given](super::PileExport::with_scene).
    Scene,
}

impl PileFile {
    /// Returns the name of the file.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::PileFile;
    ///
    /// assert_eq!(PileFile::ContactsCsv.name(), "contacts.csv");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::SpheresCsv => "spheres.csv",
            Self::ContactsCsv => "contacts.csv",
            Self::BaseCsv => "base.csv",
            Self::ColumnsCsv => "columns.csv",
            Self::LammpsData => "pile.data",
            Self::LammpsInput => "pile.in",
            Self::SpheresVtp => "spheres.vtp",
            Self::ContactsVtp => "contacts.vtp",
            Self::YadeSpheres => "spheres.txt",
            Self::YadeScript => "pile.py",
            Self::CardMarkdown => "card.md",
            Self::CardJson => "card.json",
            Self::EquilibriumMtx => "equilibrium.mtx",
            Self::LoadsMtx => "loads.mtx",
            Self::ForcesMtx => "forces.mtx",
            Self::ForcesExact => "forces_exact.txt",
            Self::PropertiesJson => "properties.json",
            Self::Scene => "scene.toml",
        }
    }
}

/// A file that was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// The kind of file; `None` for an [`OtherFile`].
    pub file: Option<PileFile>,
    /// The path of the file.
    pub path: PathBuf,
    /// The number of spheres or contacts that the file lists; `None` for a file without such a list.
    pub rows: Option<u64>,
    /// The size of the file in bytes.
    pub bytes: u64,
}

impl Written {
    /// Returns the name of the file, without its folder.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::{PileFile, Written};
    ///
    /// let (file, path) = (Some(PileFile::Scene), "pile/scene.toml".into());
    /// let written = Written { file, path, rows: None, bytes: 20 };
    /// assert_eq!(written.name(), "scene.toml");
    /// ```
    #[must_use]
    pub fn name(&self) -> &str {
        let name = self.file.map(PileFile::name);
        name.or_else(|| self.path.file_name()?.to_str())
            .unwrap_or_default()
    }
}

/// A file of a caller, for [`PileExport::write_with`](super::PileExport::write_with).
#[derive(Clone, Copy)]
pub struct OtherFile<'f> {
    /// The name of the file.
    pub name: &'f str,
    /// Writes the contents.
    pub write: &'f dyn Fn(&mut dyn Write) -> Result<(), WriteError>,
}

impl fmt::Debug for OtherFile<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut debug = f.debug_struct("OtherFile");
        debug.field("name", &self.name).finish_non_exhaustive()
    }
}

/// Returns a table of written files, one row each: `file, rows, bytes`.
///
/// # Examples
/// ```
/// use cannonpile_dem::{PileFile, Written, files};
/// use cannonpile_dem::table::{FileFormat, NumberFormat};
///
/// let (file, path) = (Some(PileFile::LammpsData), "pile.data".into());
/// let written = [Written { file, path, rows: Some(220), bytes: 20_000 }];
/// let mut csv = Vec::new();
/// files(&written).write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
/// assert_eq!(String::from_utf8(csv)?, "file,rows,bytes\npile.data,220,20000\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn files(written: &[Written]) -> Table<'_> {
    let row = |written: &Written| {
        let rows = written.rows.map(|rows| Cell::Integer(rows.into()));
        Ok(vec![
            Cell::Word(written.path.display().to_string().into()),
            rows.unwrap_or(Cell::Missing),
            Cell::Integer(written.bytes.into()),
        ])
    };
    let columns = ["file", "rows", "bytes"].each(Column::plain).into();
    Table::of_rows(columns, "files", written.iter().map(row))
}
