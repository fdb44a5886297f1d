//! Foreign number types as scalars: lines of glue, errors and run times.
//!
//! `cargo bench --manifest-path benches/Cargo.toml --bench number_types --features all`
//! computes the contact forces of HCP under a hexagon with four spheres on a side, in each type, with 10, 40 and 160 layers.
//! It compares those below the last but one layer with exact fractions, and prints the table of `docs/number-types.md`. The
//! last column has nanoseconds for each contact force of 40 layers, on one thread. Malachite takes minutes to build: its row
//! needs `--features malachite`.
//!
//! With `-- --smoke` it only compares all other columns with those of the page. It also runs a program of at most five lines
//! for each type that needs no glue, and an identity of 400 layers in residues.

mod error;
mod newtypes;
mod page;
mod plain;
mod residues;
mod table;

use std::env;

use cannonpile::Error;

fn main() -> Result<(), Error> {
    let smoke = env::args().any(|argument| argument == "--smoke");
    page::programs()?;
    residues::identity(if smoke { 40 } else { 400 })?;
    let rows = table::rows(!smoke)?;
    for row in &rows {
        println!("{row}");
    }
    page::compare(&rows);
    Ok(())
}
