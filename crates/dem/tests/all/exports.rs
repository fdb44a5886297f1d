//! Exported files: compared with the tables and with mechanics, and the folder after a failure.

mod arrays;
mod cards;
mod compliance;
mod files;
mod physics;
mod refusals;
