//! Contacts between spheres, read from the tables that DEM codes write.
//!
//! A [`Contact`] is a row of a table: two spheres, known by number or by position, and the force between them. [`read`]
//! returns the contacts of a file of any kind: a text table in any dialect, a `dump local` file of LAMMPS, or a file of VTK. A
//! [`Format`] says what the user knows about the file, above all its [`Columns`].
//! ```
//! use contact_tables::{Contact, Force, Format, Spheres};
//!
//! let table = "A;B;Fn\n1;2;0,5\n1;3;0,25\n";
//! let format = Format::of("id1=A,id2=B,force=Fn".parse()?);
//! let contacts: Vec<Contact> = contact_tables::read(table.as_bytes(), &format)?.collect::<Result<_, _>>()?;
//! assert_eq!(contacts[0].spheres, Spheres::Numbers([1, 2]));
//! assert_eq!(contacts[1].force, Force::Along(0.25));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Map
//! The way of a file, from its bytes to its rows. The modules are roughly in the order in which they build on each other.
//!
//! | module | contents |
//! |---|---|
//! | `kind` | [`FileKind`]: the kind of a file, by its first bytes |
//! | `error` | [`Error`]: why a file is refused |
//! | `encoding`, `input`, `lines` | the [`TextEncoding`]; the bytes of a file, decompressed, as text, line by line |
//! | `contact` | [`Contact`]: a row |
//! | `number`, `cut`, `dialect` | the [`Dialect`] of a text: numbers and cells |
//! | `columns`, `preset`, `format` | the [`Columns`] of the quantities; those of known codes; all that a user tells |
//! | `header` | the columns of a table, and the parser of its rows |
//! | `detect` | the dialect and the header that the first lines show |
//! | `counts`, `steps` | the rows that were left out, and the step that is read |
//! | `text`, `dump`, `vtk` | the rows of a text, of a LAMMPS dump, and of a VTK file |
//! | `contacts` | [`read`], [`Contacts`] |

mod columns;
mod contact;
mod contacts;
mod counts;
mod cut;
mod detect;
mod dialect;
mod dump;
mod encoding;
mod error;
mod format;
mod header;
mod input;
mod kind;
mod lines;
mod number;
mod preset;
mod steps;
mod text;
mod vtk;

pub use columns::{Columns, Identity};
pub use contact::{Contact, Force, Place, Spheres};
pub use contacts::{Contacts, read};
pub use counts::RowCounts;
pub use cut::Separator;
pub use dialect::{Dialect, DialectOptions, Mark};
pub use encoding::TextEncoding;
pub use error::{Error, Syntax};
pub use format::Format;
pub use kind::FileKind;
pub use preset::Preset;
pub use steps::is_same_step;

/// The examples of README.md, run as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
