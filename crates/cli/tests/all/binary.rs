//! How tests run the binary: without the environment of the user, and without a trace of the time that it takes.

use std::env;
use std::process::{Command, Output, Stdio};

/// Returns a command that runs the binary without input and without the variables of the environment of this test. So
/// neither the number of threads nor colours, width and language of a terminal depend on the user.
pub(crate) fn command() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_cannonpile"));
    // Windows needs the first variable to start a process. The second one names the file of a coverage report.
    let kept = ["SystemRoot", "LLVM_PROFILE_FILE"];
    let kept = kept.map(|name| env::var_os(name).map(|value| (name, value)));
    command
        .env_clear()
        .envs(kept.into_iter().flatten())
        .stdin(Stdio::null());
    command
}

/// Removes the lines that a command prints on stderr only if it takes long: progress after each minute, and the rate of an
/// export after a second.
pub(crate) fn without_times(mut output: Output) -> Output {
    let is_time = |line: &[u8]| {
        let line = String::from_utf8_lossy(line);
        let line = line.trim_end();
        let is_progress = line.starts_with("note: ")
            && line.rsplit_once(", after ").is_some_and(|(_, time)| {
                time.len() >= 8 && time.chars().all(|c| c.is_ascii_digit() || c == ':')
            });
        is_progress || (line.ends_with(" rows/s") && line.contains(" bytes in "))
    };
    let lines = output.stderr.split_inclusive(|byte| *byte == b'\n');
    output.stderr = lines
        .filter(|line| !is_time(line))
        .collect::<Vec<_>>()
        .concat();
    output
}
