//! What a command inherits from the process that starts it: signals that are ignored, and the limit of its memory.
//!
//! These are properties of a whole process, so these tests have a process of their own.
#![cfg(unix)]

#[path = "all/binary.rs"]
mod binary;

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::sync::Arc;
use std::thread::sleep;
use std::time::{Duration, Instant};

use cannonpile_testkit::processes::{LONGEST_WAIT, Process, left_out};
use rustix::process::{Pid, Signal, kill_process};
use signal_hook::{consts, flag};

/// Starts a command in a folder, and reads what it prints.
fn start(command: &mut Command, folder: &Path) -> Process {
    command
        .current_dir(folder)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    Process::start(command).expect("the program runs")
}

/// Returns the names of the files in a folder, also of hidden ones.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let names = entries.map(|entry| entry.expect("an entry").file_name());
    names
        .map(|name| name.into_string().expect("text"))
        .collect()
}

/// Lets commands receive a signal that this process may have inherited as ignored, as from `nohup` or from a script that
/// starts it in the background: a command begins with the default action of a signal that its parent catches.
fn catch(signal: i32) {
    flag::register(signal, Arc::default()).expect("a handler");
}

/// Returns the signals that this process and its children do not receive, as bits, where the system lists them.
fn blocked() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigBlk:"));
    mask.map_or(0, |mask| {
        u64::from_str_radix(mask.trim(), 16).expect("bits")
    })
}

#[test]
fn signals_remove_unfinished_files() {
    for (signal, number, status) in [
        (Signal::INT, consts::SIGINT, 130),
        (Signal::TERM, consts::SIGTERM, 143),
        (Signal::HUP, consts::SIGHUP, 129),
        (Signal::QUIT, consts::SIGQUIT, 131),
        (Signal::USR1, consts::SIGUSR1, 128 + consts::SIGUSR1),
    ] {
        if (blocked() >> (number - 1)) & 1 == 1 {
            left_out(&format!("signal {number}: this process has it blocked"));
            continue;
        }
        catch(number);
        // A larger export is tried where this process came too late.
        let ended = ["200", "300", "400"].iter().find_map(|layers| {
            let folder = tempfile::tempdir().expect("a folder");
            let status = interrupted(signal, layers, folder.path())?;
            assert!(names(folder.path()).is_empty(), "{signal:?}");
            Some(status)
        });
        assert_eq!(ended, Some(status), "{signal:?}");
    }
}

/// Sends a signal to an export that has begun to write, and returns its exit status. `None` if it ended before the signal.
fn interrupted(signal: Signal, layers: &str, folder: &Path) -> Option<i32> {
    let into = folder.join("new/pile");
    let mut command = binary::command();
    command.args(["export", "--layers", layers, "new/pile"]);
    let mut export = start(&mut command, folder);
    let begun = Instant::now();
    while !into.exists() || names(&into).is_empty() {
        if export.status().is_some() {
            let output = export.output();
            assert!(output.status.success(), "before the signal: {output:?}");
            return None;
        }
        assert!(begun.elapsed() < LONGEST_WAIT, "no file appears");
        sleep(Duration::from_millis(2));
    }
    let id = i32::try_from(export.id()).ok().and_then(Pid::from_raw);
    kill_process(id.expect("a process"), signal).expect("a signal is sent");
    let status = export.output().status.code();
    Some(status.expect("an exit status")).filter(|status| *status != 0)
}

/// Runs a command with 250 000 kB of address space. A shell sets the limit: that of this process would stop its threads.
#[cfg(target_os = "linux")]
fn limited(arguments: &str) -> Output {
    let folder = tempfile::tempdir().expect("a folder");
    let mut command = Command::new("/bin/sh");
    command
        .args(["-c", "ulimit -S -v 250000 && exec \"$@\"", "sh"])
        .arg(binary::command().get_program())
        .args(arguments.split_whitespace())
        .env_clear()
        .stdin(Stdio::null());
    binary::without_times(start(&mut command, folder.path()).output())
}

#[cfg(target_os = "linux")]
#[test]
fn requests_above_the_limit_fail_in_one_line() {
    for (arguments, quantity) in [
        (
            "base --stacking hcp --layers 1000 --number f64",
            "the forces on spheres this far below so many sign changes",
        ),
        (
            "mean --layers 80 --symbolic",
            "the mean over random stackings",
        ),
        (
            "verify --layers 560 /dev/null",
            "a comparison of all contacts",
        ),
    ] {
        let output = limited(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments}: {output:?}");
        assert!(output.stdout.is_empty(), "{arguments}: {output:?}");
        let line = String::from_utf8(output.stderr).expect("text");
        let beginning = format!("error: --layers: {quantity} would take ");
        assert!(
            line.starts_with(&beginning) && line.lines().count() == 1,
            "{line}"
        );
    }
}

#[cfg(target_os = "linux")]
#[test]
fn summary_names_columns_without_memory() {
    let output = limited("summary --stacking hcp --layers 1000");
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let notes = String::from_utf8(output.stderr).expect("text");
    let columns = |line: &str| {
        let told = line
            .strip_prefix("note: no ")
            .and_then(|line| line.split_once(": "));
        told.map(|(columns, _)| columns.to_owned())
    };
    let columns: Option<Vec<String>> = notes.lines().map(columns).collect();
    let extremes = "normal_min, normal_max, max_shear_ratio";
    let none = ["min_contact", extremes, "plan"].map(str::to_owned);
    assert_eq!(columns, Some(none.into()), "{notes}");
}

#[cfg(target_os = "linux")]
#[test]
fn requests_below_the_limit_succeed() {
    let output = limited("base --stacking hcp --layers 100 --number f64");
    assert_eq!(output.status.code(), Some(0), "{output:?}");
}
