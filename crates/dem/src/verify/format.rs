//! The formats of files: how bytes become rows.
//!
//! The stages are: bytes (`source`), the dialect of a text table (`dialect`, `cut`, `number`), its columns (`columns`,
//! `header`), the rows of a text or a dump (`text`, `dump`) and the steps (`steps`). Each stage counts what it leaves out
//! (`rows`).

mod columns;
mod cut;
mod dialect;
pub(super) mod dump;
mod header;
mod lines;
mod number;
mod preset;
mod rows;
mod source;
mod steps;
pub(super) mod text;

pub use columns::Columns;
pub use dialect::{Dialect, DialectOptions, Mark, Separator, TextEncoding};
pub use preset::Preset;
pub use rows::Rows;

pub(super) use header::{Header, Identity};
pub(super) use rows::Counted;
pub(super) use source::Source;
pub(super) use steps::Steps;

/// The meaning of a file, as far as the user tells it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Format {
    pub(super) columns: Columns,
    pub(super) identity: Identity,
    pub(super) dialect: DialectOptions,
}
