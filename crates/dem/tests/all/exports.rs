//! Tests of exported files: they agree with the tables and with mechanics, and a failure leaves no new file.

mod cards;
mod compliance;
mod files;
mod matrix;
mod physics;
mod refusals;
