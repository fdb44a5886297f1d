//! The meaning of a file, as far as the user states it.

use std::path::PathBuf;

use crate::columns::{Columns, Identity};
use crate::dialect::DialectOptions;
use crate::preset::Preset;

/// The meaning of a file, as far as the user states it. The first bytes of the file decide the rest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Format {
    /// The columns of the quantities.
    pub columns: Columns,
    /// How the two spheres of a row are known.
    pub identity: Identity,
    /// True if tangential forces are read besides the normal ones.
    pub tangential: bool,
    /// The dialect of a text.
    pub dialect: DialectOptions,
    /// The step that is read of a file with several. Without it, the last.
    pub step: Option<String>,
    /// The largest number of rows in a step. A longer table is refused at the first row beyond it, so that a table without
    /// end takes no more memory than that. Without it, all rows are read.
    pub most_rows: Option<u64>,
    /// The folder of the file. Files of ParaView such as `.pvtp` name others in it.
    pub folder: Option<PathBuf>,
}

impl Format {
    /// Returns the format of a file with these columns, whose spheres are known by number.
    ///
    /// # Examples
    /// ```
    /// use contact_tables::{Columns, Format};
    ///
    /// assert_eq!(Format::of(Columns::default()), Format::default());
    /// ```
    #[must_use]
    pub fn of(columns: Columns) -> Self {
        Self {
            columns,
            ..Self::default()
        }
    }

    /// Returns the largest number of bytes of a file that is kept as a whole: 1 GiB, and 1 KiB for each row.
    pub(crate) fn most_bytes(&self) -> Option<u64> {
        let rows = self.most_rows?;
        Some(rows.saturating_mul(1 << 10).saturating_add(1 << 30))
    }
}

impl From<Preset> for Format {
    /// Returns the format of the files of a known code.
    fn from(preset: Preset) -> Self {
        let identity = if preset.is_by_place() {
            Identity::Places
        } else {
            Identity::Numbers
        };
        Self {
            identity,
            ..Self::of(preset.columns())
        }
    }
}
