//! The formats of files: how bytes become rows.
//!
//! The stages, and their files:
//! 1. bytes: `source`;
//! 2. the dialect of a text table: `detect`, `dialect`, `cut`, `number`;
//! 3. its columns: `columns`, `header`;
//! 4. the rows of a text or a dump: `text`, `dump`;
//! 5. the steps: `steps`.
//!
//! Each stage counts what it leaves out (`counts`).

mod columns;
mod counts;
mod cut;
mod detect;
mod dialect;
pub(super) mod dump;
mod encoding;
mod header;
mod lines;
mod number;
mod preset;
mod source;
mod steps;
pub(super) mod text;

pub use columns::Columns;
pub use counts::RowCounts;
pub use dialect::{Dialect, DialectOptions, Mark, Separator, TextEncoding};
pub use preset::Preset;

pub(super) use counts::Counted;
pub(super) use header::{Header, Identity, Needs, shortened};
pub(super) use source::Source;
pub(super) use steps::{Steps, is_same_step};

/// The meaning of a file, as far as the user tells it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Format {
    pub(super) columns: Columns,
    pub(super) needs: Needs,
    pub(super) dialect: DialectOptions,
}
