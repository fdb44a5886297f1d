//! The files that a pile is written to.

use core::fmt;
use std::io::Write;
use std::path::PathBuf;

use crate::table::{Cell, Column, Table, WriteError};

/// The program that a pile is written for.
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
    /// Any: `spheres.csv`, `contacts.csv`, `base.csv`, and `columns.csv`, which says what is in their columns.
    Csv,
    /// LAMMPS: `pile.data`, and `pile.in`, which relaxes it and writes the forces: those of springs that are all alike, whatever
    /// forces horizontal contacts were given.
    Lammps,
    /// ParaView: `spheres.vtp`, `contacts.vtp`.
    Vtp,
    /// YADE: `spheres.txt`, and `pile.py`, which relaxes it and writes the forces, as LAMMPS does.
    Yade,
    /// A benchmark card: `card.md` for people, `card.json` for machines. What the pile is, the exact answers, how exact they are,
    /// what a code must satisfy, how to cite.
    Card,
    /// The suite of LAMMPS: `dem-pile.yaml`, a test in the style of `unittest/granular`, of up to 2000 spheres that come to rest,
    /// on springs that are all alike.
    LammpsTest,
    /// The suite of YADE: `checkPile.py`, a check in the style of `scripts/checks-and-tests/checks`, of up to 2000 spheres; of a
    /// pile that cannot stand it checks that contacts are lost.
    YadeCheck,
}

impl PileFormat {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Csv,
        Self::Lammps,
        Self::Vtp,
        Self::Yade,
        Self::Card,
        Self::LammpsTest,
        Self::YadeCheck,
    ];

    /// Its files, in the order in which they are written.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::{PileFile, PileFormat};
    ///
    /// assert_eq!(PileFormat::Yade.files(), [PileFile::YadeSpheres, PileFile::YadeScript]);
    /// assert_eq!(PileFormat::ALL.map(|format| format.files().len()), [4, 2, 2, 2, 2, 1, 1]);
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
            Self::LammpsTest => &[PileFile::LammpsTest],
            Self::YadeCheck => &[PileFile::YadeCheck],
        }
    }
}

/// One of the files that a pile is written to.
///
/// All numbers are in SI, each the float nearest to the exact one, with the digits that read back the same. Spheres
/// have the numbers of [`Numbering`](cannonpile::shape::Numbering) in all of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum PileFile {
    /// `spheres.csv`: the table of [`table::spheres`](crate::table::spheres), and `load`, the force downwards that acts
    /// besides the weight.
    SpheresCsv,
    /// `contacts.csv`: `id1,id2,force,fx,fy,fz,k,i,j,direction`; id1 is the upper sphere, on which the force acts, at
    /// k, i, j.
    ContactsCsv,
    /// `base.csv`: the table of [`table::base`](crate::table::base), a row for each sphere of the floor, and its `id`.
    BaseCsv,
    /// `columns.csv`: `file,column,unit,meaning`, a row for each column of the other three.
    ColumnsCsv,
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
    /// `card.md`: the benchmark in Markdown; lists of more than 130 rows are left to the csv files.
    CardMarkdown,
    /// `card.json`: the same for machines, each number as `{"exact": …, "float": …}`, the exact one as text; lists of more than
    /// 10,000 rows are left to the csv files.
    CardJson,
    /// `dem-pile.yaml`: the pile, and where its spheres come to rest.
    LammpsTest,
    /// `checkPile.py`: the pile and its forces; raises `YadeCheckError` with the worst contact.
    YadeCheck,
    /// `scene.toml`: the scene that the pile was made of, written with any format if it is
    /// [given](super::PileExport::with_scene).
    Scene,
}

impl PileFile {
    /// The name of the file.
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
            Self::LammpsTest => "dem-pile.yaml",
            Self::YadeCheck => "checkPile.py",
            Self::Scene => "scene.toml",
        }
    }
}

/// A file that was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// Which file of this crate it is; `None` for an [`OtherFile`].
    pub file: Option<PileFile>,
    /// Where it is.
    pub path: PathBuf,
    /// Its spheres or contacts; none in a script, a card, a scene, a list of columns, or another file.
    pub rows: Option<u64>,
    /// Its size.
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

/// Files that were written, one a row: `file, rows, bytes`.
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
    let columns = ["file", "rows", "bytes"].map(Column::plain).into();
    Table::of_rows(columns, "files", written.iter().map(row))
}
