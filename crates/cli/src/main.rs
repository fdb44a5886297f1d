//! The program `cannonpile`. The library of this package contains all of it.

fn main() -> std::process::ExitCode {
    cannonpile_cli::run()
}
