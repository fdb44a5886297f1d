//! Commands that need more memory than the limit of the process fail before they start.
#![cfg(target_os = "linux")]

use std::process::{Command, Output};

/// Runs a command with this limit of its memory, in kilobytes.
fn within(kilobytes: u32, arguments: &str) -> Output {
    Command::new("sh")
        .arg("-c")
        .arg(format!("ulimit -v {kilobytes} && exec \"$0\" {arguments}"))
        .arg(env!("CARGO_BIN_EXE_cannonpile"))
        .output()
        .expect("a shell runs")
}

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
        let output = within(250_000, arguments);
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

#[test]
fn summary_names_columns_without_memory() {
    let output = within(250_000, "summary --stacking hcp --layers 1000");
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

#[test]
fn requests_below_the_limit_succeed() {
    let output = within(250_000, "base --stacking hcp --layers 100 --number f64");
    assert_eq!(output.status.code(), Some(0), "{output:?}");
}
