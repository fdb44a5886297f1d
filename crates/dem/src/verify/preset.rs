//! The columns of known codes.

use core::fmt;
use core::str::FromStr;

use super::columns::Columns;
use crate::Error;

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
    /// LAMMPS (22 Jul 2025), its own `dump local` files: `patom1 patom2` (or `natom1 natom2`) of
    /// `compute property/local`, and `force fx fy fz` of `compute pair/local`. `dump_modify colname` sets these names.
    /// Matched by the numbers of the atoms.
    Lammps,
    /// YADE (2023.02a), tables written by scripts: `id1,id2,force`. Bodies are counted from 0, as in `Interaction.id1`.
    Yade,
    /// exaDEM (1.2.2, `src/interaction/include/exaDEM/itools/writer.hpp`): the csv of `write_interaction_data`, with 21
    /// columns and no header. Matched by the positions of both centres. The force on the second particle is its
    /// `fn + ft`. The interactions 0 to 3 are between particles, and 4 to 12 with drivers.
    ExaDem,
    /// exaDEM (1.2.2, `src/interaction/include/exaDEM/network.hpp`): the contact network of `dump_contact_network` in
    /// `.vtp`. Lines between centres carry the vectors `fn` and `ft`. Matched by the positions of both centres. The
    /// force on the second particle is `fn + ft`.
    ExaDemVtp,
    /// DEM-Engine (2.1.0, `src/DEM/dT.cpp`, `writeContactsAsCsv`, and `Structs.h`):
    /// `contact_type,A,B,f_x,f_y,f_z,X,Y,Z`. Matched by the position of the contact point. Contacts of type `SS` are
    /// between two spheres.
    DemEngine,
    /// MDDEM (0.1.3, `crates/dem_contact_analysis/src/lib.rs`): `i_tag,j_tag,overlap,cx,cy,cz,nx,ny,nz`. Matched by the
    /// position of the contact point. The table contains no force: add the stiffness k of the linear spring with
    /// `force=k*overlap`.
    Mddem,
    /// Lethe (`source/dem/force_chains_visualization.cc`): the force chains in `.vtu`, lines between centres with the
    /// normal force `force`. Matched by the positions of both centres.
    Lethe,
}

impl Preset {
    /// All presets.
    ///
    /// Kratos is missing because its DEM application writes no table of contacts. Its `dem_vtk_output.py` lists the
    /// method as still to be added.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Preset;
    ///
    /// for preset in Preset::ALL {
    ///     assert_eq!(preset.name().parse(), Ok(preset));
    /// }
    /// ```
    pub const ALL: [Self; 7] = [
        Self::Lammps,
        Self::Yade,
        Self::ExaDem,
        Self::ExaDemVtp,
        Self::DemEngine,
        Self::Mddem,
        Self::Lethe,
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
            Self::Mddem => "mddem",
            Self::Lethe => "lethe",
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
        let named = match self {
            Self::Yade => return Columns::default().with_first_id(0),
            Self::Lammps | Self::Lethe => return Columns::default(),
            Self::ExaDem => {
                "kind=#5:0|1|2|3,fx=-#10-#13,fy=-#11-#14,fz=-#12-#15,x1=#16,y1=#17,z1=#18,x2=#19,y2=#20,z2=#21"
            }
            Self::ExaDemVtp => "fx=-fn_x+-ft_x,fy=-fn_y+-ft_y,fz=-fn_z+-ft_z",
            Self::DemEngine => "kind=contact_type:SS,fx=f_x,fy=f_y,fz=f_z,x=X,y=Y,z=Z",
            Self::Mddem => "x=cx,y=cy,z=cz,force=overlap",
        };
        // Not a default: the tests parse the columns of every preset, so none is rejected.
        named.parse().unwrap_or_default()
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
            Self::ExaDem | Self::ExaDemVtp | Self::DemEngine | Self::Mddem | Self::Lethe
        )
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
        let expected = "lammps, yade, exadem, exadem-vtp, dem-engine, mddem or lethe";
        let mut all = Self::ALL.into_iter();
        all.find(|preset| preset.name() == text)
            .ok_or_else(|| Error::syntax(text, expected))
    }
}
