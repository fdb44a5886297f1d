//! Writes the manual pages, one for each command: `cargo run -p cannonpile-cli --example man -- DIR`.

use std::{env, fs, io};

fn main() -> io::Result<()> {
    let folder = env::args_os().nth(1);
    let folder = folder.ok_or_else(|| io::Error::other("the folder for the pages is missing"))?;
    fs::create_dir_all(&folder)?;
    clap_mangen::generate_to(cannonpile_cli::command(), folder)
}
