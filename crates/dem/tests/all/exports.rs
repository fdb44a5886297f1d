//! Piles as files: against the tables, against mechanics, and what is left behind when a file cannot be written.

mod arrays;
mod cards;
mod compliance;
mod files;
mod physics;
mod refusals;
