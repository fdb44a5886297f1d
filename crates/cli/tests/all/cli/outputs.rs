//! Where `--output` writes: stdout, pipes, devices and links are what they are, and no file is lost.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::symlink;
use std::process::Command;

use num_bigint::BigInt;
use tempfile::{TempDir, tempdir};

const TABLE: &str =
    "i,j,normal,shear_x,shear_y\n0,0,4/3,-1/6,-1/6\n1,0,4/3,-1/6,1/6\n0,1,4/3,1/3,0\n";

/// Runs a line of a shell in which `$0` is the binary, and returns its stdout and stderr. Its programs, such as `cat`, are where
/// every Unix has them, whatever path the parent has.
fn shell(folder: &TempDir, line: &str) -> String {
    let mut shell = Command::new("/bin/sh");
    shell.env("PATH", "/bin:/usr/bin");
    shell.args(["-c", line, env!("CARGO_BIN_EXE_cannonpile")]);
    let output = shell.current_dir(folder.path()).output().expect("a shell");
    let [out, error] =
        [output.stdout, output.stderr].map(|text| String::from_utf8(text).expect("text"));
    out + &error
}

#[test]
fn stdout_is_written_in_place() {
    let folder = tempdir().expect("a folder");
    for output in ["-", "/dev/stdout", "/dev/fd/1", "out"] {
        let _ = symlink("/dev/stdout", folder.path().join("out"));
        let command = format!(
            "(echo before; \"$0\" base --layers 2 --format csv --output {output}; echo after $?)"
        );
        let expected = format!("before\n{TABLE}after 0\n");
        assert_eq!(
            shell(&folder, &format!("{command} 2>&1 | cat")),
            expected,
            "{output}"
        );
        for redirection in [">", ">>"] {
            let written = shell(
                &folder,
                &format!("rm -f log; {command} {redirection} log; cat log"),
            );
            assert_eq!(written, expected, "{redirection} {output}");
        }
        assert!(!folder.path().join("-").exists());
    }
}

#[test]
fn certificates_and_figures_go_to_stdout_too() {
    let folder = tempdir().expect("a folder");
    for command in [
        "plot base --layers 2 --output -",
        "summary --layers 2 --spacing 1 --certificate -",
        "scene --layers 2 --output -",
        "export pile --layers 2 --to csv --list -",
    ] {
        assert!(
            !shell(&folder, &format!("\"$0\" {command}")).is_empty(),
            "{command}"
        );
        assert!(!folder.path().join("-").exists(), "{command}");
    }
}

/// A file that is open is written at its end, and what it contains stays.
#[test]
fn open_files_and_pipes_are_not_replaced() {
    let folder = tempdir().expect("a folder");
    let command = "\"$0\" base --layers 2 --format csv --output";
    let written = shell(
        &folder,
        &format!("echo before > log; {command} /dev/fd/3 3>> log; cat log"),
    );
    assert_eq!(written, format!("before\n{TABLE}"));
    let piped = shell(
        &folder,
        &format!("mkfifo pipe; cat pipe & {command} pipe; wait; test -p pipe && echo pipe"),
    );
    assert_eq!(piped, format!("{TABLE}pipe\n"));
    assert_eq!(
        shell(
            &folder,
            &format!("{command} /dev/null; test -c /dev/null && echo device")
        ),
        "device\n"
    );
}

#[test]
fn links_are_followed_to_new_files() {
    let folder = tempdir().expect("a folder");
    let line = "mkdir later; ln -s later/table.csv link.csv; ln -s link.csv chain.csv; \"$0\" base --layers 2 --output chain.csv; \
                echo $?; cat later/table.csv; test -L link.csv && ls later";
    assert_eq!(shell(&folder, line), format!("0\n{TABLE}table.csv\n"));
    let again = "ln -s loop.csv loop.csv; \"$0\" base --layers 2 --output loop.csv; echo $?";
    let refused = shell(&folder, again);
    assert!(
        refused.starts_with("2\nerror: cannot write --output loop.csv: "),
        "{refused}"
    );
    assert!(fs::read_link(folder.path().join("loop.csv")).is_ok());
}

#[test]
fn a_full_stdout_has_no_folder() {
    let folder = tempdir().expect("a folder");
    if std::path::Path::new("/dev/full").exists() {
        let refused = shell(&folder, "\"$0\" base --layers 2 > /dev/full");
        assert!(
            refused.starts_with("error: cannot write to stdout: ") && !refused.contains("folder"),
            "{refused}"
        );
    }
}

/// The sum of two loads of 4000 digits has too many digits for `check`.
#[test]
fn a_certificate_that_check_would_refuse_is_not_written() {
    let folder = tempdir().expect("a folder");
    let [first, second] =
        [(2, 13_000), (3, 8_200)].map(|(base, power)| BigInt::from(base).pow(power));
    let scene = format!("layers = 3\nload = [\"0,0,0=1/{first}\", \"1,0,1=1/{second}\"]\n");
    fs::write(folder.path().join("scene.toml"), scene).expect("a scene");
    for command in ["contacts", "base --output base.csv"] {
        let refused = shell(
            &folder,
            &format!("\"$0\" {command} --scene scene.toml --certificate c.json; echo $?; ls"),
        );
        assert!(
            refused.starts_with(
                "2\nscene.toml\nerror: --certificate: leave it out, because check would refuse it: "
            ),
            "{refused}"
        );
        assert!(
            refused.contains("at most 5000 digits") && refused.len() < 500,
            "{refused}"
        );
    }
}
