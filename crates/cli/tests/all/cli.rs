//! The command line as seen by a user: output, errors, exit status.

mod cases;
mod completions;
mod console;
mod ensemble;
mod explain;
mod export;
mod found_tables;
mod man;
mod mean;
mod outputs;
mod plot;
mod scene;
mod stackings;
mod tables;
mod verify;

use std::fs;
use std::io::Read;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

use crate::binary::{command, without_times};
use cannonpile_testkit::processes::{Process, within};
use tempfile::TempDir;

/// A temporary folder in which commands run, so that command lines name files without its path. The path may contain blanks
/// and any letters.
struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().expect("a folder"))
    }

    /// Creates a folder with one file.
    fn with(name: &str, content: impl AsRef<[u8]>) -> Self {
        let folder = Self::new();
        folder.write(name, content);
        folder
    }

    /// Returns the path of a file in this folder.
    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).expect("a file is written");
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).expect(name)
    }

    /// Returns the names of the files in a folder below this one, or in this one if `below` is empty, sorted.
    fn names(&self, below: &str) -> Vec<String> {
        let entries = fs::read_dir(self.path(below)).expect("a folder");
        let names = entries.map(|entry| entry.expect("an entry").file_name());
        let mut names: Vec<String> = names
            .map(|name| name.into_string().expect("text"))
            .collect();
        names.sort();
        names
    }

    /// Runs a command, whose arguments are separated by blanks.
    fn cannonpile(&self, arguments: &str) -> Output {
        let mut command = command();
        command.args(arguments.split_whitespace());
        output(command.current_dir(self.path("")))
    }

    /// Returns the output of a successful command.
    ///
    /// Only two kinds of notes may appear on stderr: the reasons of empty columns of a summary, and the definition of a
    /// mean.
    fn stdout(&self, arguments: &str) -> String {
        let output = self.cannonpile(arguments);
        assert_eq!(output.status.code(), Some(0), "{arguments}: {output:?}");
        let reasons = arguments.starts_with("summary") && only_reasons(&output.stderr);
        let said = String::from_utf8_lossy(&output.stderr);
        let mut said = said.lines();
        let of_means = arguments.starts_with("plot response --fault-probability")
            && said.all(|line| line.starts_with("note: the mean is over all stackings"));
        assert!(
            output.stderr.is_empty() || reasons || of_means,
            "{arguments}: {output:?}"
        );
        String::from_utf8(output.stdout).expect("text")
    }

    /// Returns the error of a command: one line on stderr, with nothing on stdout and exit status 2.
    fn refusal(&self, arguments: &str) -> String {
        let output = self.cannonpile(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments}: {output:?}");
        assert!(output.stdout.is_empty(), "{arguments}: {output:?}");
        let line = String::from_utf8(output.stderr).expect("text");
        assert_eq!(line.lines().count(), 1, "{arguments}: {line}");
        line
    }
}

/// Runs a command to its end.
fn output(command: &mut Command) -> Output {
    let piped = command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let process = Process::start(piped).expect("the binary runs");
    without_times(process.output())
}

/// Sends this text to a command and returns the output.
fn output_of(command: &mut Command, text: String) -> Output {
    use std::io::Write as _;

    let piped = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let process = Process::start(piped).expect("the binary runs");
    // The command may end before it has read everything.
    without_times(process.output_of(move |mut stdin| drop(stdin.write_all(text.as_bytes()))))
}

/// Runs a command in an empty folder.
fn cannonpile(arguments: &str) -> Output {
    Folder::new().cannonpile(arguments)
}

/// Returns the output of a successful command in an empty folder, as [`Folder::stdout`] does.
fn stdout(arguments: &str) -> String {
    Folder::new().stdout(arguments)
}

/// Returns the error of a command in an empty folder, as [`Folder::refusal`] does.
fn refusal(arguments: &str) -> String {
    Folder::new().refusal(arguments)
}

/// Returns whether stderr contains only the reasons of empty columns.
fn only_reasons(stderr: &[u8]) -> bool {
    let said = String::from_utf8_lossy(stderr);
    said.lines().all(|line| line.starts_with("note: no "))
}

#[test]
fn base_of_the_paper() {
    let table = stdout("base --layers 10");
    let rows: Vec<Vec<&str>> = table
        .lines()
        .map(|l| l.split_whitespace().collect())
        .collect();
    let spheres = &rows[2..57];
    assert!(spheres.iter().all(|row| row.len() == 5 && row[2] == "4"));
    assert!(rows[57][0].starts_with("---"));
    assert_eq!(rows[58], ["total", "220", "0", "0"]);
    assert_eq!(table.lines().last(), Some("55 bottom spheres"));
}

#[test]
fn base_forces_in_si() {
    let csv = stdout("base --layers 10 --spacing 6/5 --units si --number exact --format csv");
    assert_eq!(
        csv.lines().nth(1),
        Some("0,0,4,-3/13*sqrt(39),-9/13*sqrt(13)")
    );
    let floats = stdout("base --layers 10 --spacing 6/5 --units si --number f64 --format csv");
    assert_eq!(
        floats.lines().nth(1),
        Some("0,0,4.0,-1.4411533842457842,-2.496150883013531")
    );
}

#[test]
fn pile_of_1e30_layers() {
    let huge = "1000000000000000000000000000000";
    let csv = stdout(&format!("base --layers {huge} --at 5,7 --format csv"));
    let row = "5,7,333333333333333333333333333334,-166666666666666666666666666663,\
               -499999999999999999999999999991/3";
    assert_eq!(csv.lines().nth(1), Some(row));
    let summary = stdout(&format!("summary --layers {huge} --format csv"));
    assert!(
        summary
            .lines()
            .nth(1)
            .unwrap()
            .starts_with(&format!("{huge},fcc,1666666"))
    );
}

#[test]
fn headers_of_tables() {
    for (arguments, header) in [
        (
            "summary",
            "layers,stacking,spheres,contacts,weight,stands,min_contact,base_spheres,normal_min,\
             normal_max,max_shear_ratio_over_tan_theta,touching,plan,margin_squared_over_tan2_theta",
        ),
        ("base", "i,j,normal,shear_x,shear_y"),
        ("base --dimension 2", "i,normal,shear_x"),
        ("contacts", "k,i,j,direction,force"),
        ("contacts --dimension 2", "k,i,direction,force"),
        (
            "contacts --units si",
            "k,i,j,direction,force,fx,fy,fz,x,y,z",
        ),
        ("spheres", "id,k,i,j,x,y,z,radius,mass,fixed"),
    ] {
        let csv = stdout(&format!("{arguments} --layers 3 --format csv"));
        assert_eq!(csv.lines().next(), Some(header), "{arguments}");
    }
}

#[test]
fn single_layer_has_no_contacts() {
    assert_eq!(
        stdout("contacts --layers 1 --format csv").lines().count(),
        1
    );
    assert_eq!(stdout("contacts --layers 1 --format json"), "[]\n");
    let summary = stdout("summary --layers 1 --format csv");
    assert_eq!(
        summary.lines().nth(1),
        Some("1,fcc,1,0,1,yes,,1,1,1,0,none,closed,")
    );
}

#[test]
fn json_is_an_array_of_rows() {
    let json = stdout("spheres --layers 2 --format json --number f64");
    let rows: serde_json::Value = serde_json::from_str(&json).expect("json");
    let rows = rows.as_array().expect("an array");
    assert_eq!(rows.len(), 4);
    assert_eq!(rows[0]["id"], 1);
    assert_eq!(rows[0]["fixed"], false);
    assert_eq!(rows[3]["fixed"], true);
    assert_eq!(rows[1]["z"].as_f64(), Some(0.0));
    let exact = stdout("base --layers 2 --format json");
    let rows: serde_json::Value = serde_json::from_str(&exact).expect("json");
    assert_eq!(rows[0]["normal"], "4/3");
}

#[test]
fn selections() {
    assert_eq!(
        stdout("contacts --layers 5 --layer 2 --format csv")
            .lines()
            .count(),
        1 + 18
    );
    assert_eq!(
        stdout("contacts --layers 5 --at 3,1,1 --format csv")
            .lines()
            .count(),
        1 + 3
    );
    assert_eq!(
        stdout("spheres --layers 5 --at 1,1 --format csv")
            .lines()
            .count(),
        1 + 1
    );
    assert_eq!(
        stdout("base --dimension 2 --layers 5 --at 2 --format csv")
            .lines()
            .count(),
        2
    );
}

#[test]
fn errors_name_option_and_remedy() {
    for (arguments, fragments) in [
        ("base --layers 0", ["--layers", "at least 1"]),
        ("base --layers -3", ["--layers", "not -3"]),
        ("base --layers ten", ["--layers", "'ten'"]),
        (
            "base --layers 1000000000000000000000000000000000001",
            ["--layers", "10^36"],
        ),
        (
            "base --spacing 1.64",
            ["--spacing", "at most 2/3*sqrt(6) = 1.632993…"],
        ),
        ("base --spacing 9/10", ["--spacing", "at least 1"]),
        (
            "base --spacing x",
            ["--spacing", "'x' is not a number such as"],
        ),
        ("base --spacing 1/0", ["--spacing", "other than zero"]),
        ("base --spacing -6/5", ["--spacing", "positive"]),
        (
            "base --layers 3 --spacing 2",
            ["--spacing", "below sqrt(3)"],
        ),
        ("base --sin-phi 1", ["--sin-phi", "between 0 and 1"]),
        ("base --sin-phi 0", ["--sin-phi", "between 0 and 1"]),
        (
            "base --sin-phi 9/10 --units si",
            ["--sin-phi", "at most 5/6"],
        ),
        (
            "base --sin-phi 1/2 --dimension 2",
            ["--sin-phi", "dimension 3"],
        ),
        (
            "base --dimension 4",
            ["--dimension", "2 (discs) or 3 (spheres)"],
        ),
        ("base --mass 0", ["--mass", "positive"]),
        ("base --radius -1", ["--radius", "positive"]),
        ("base --gravity 0/5", ["--gravity", "positive"]),
        ("base --at 9,9", ["--at", "0 <= i <= k-j"]),
        ("base --at 3,0,0", ["--at", "does not touch the floor"]),
        ("base --at=-5,-7", ["--at", "no sphere at"]),
        ("base --at 1,2,3,4", ["--at", "K,I,J"]),
        ("contacts --layer 10", ["--layer", "to 9 on the floor"]),
        ("contacts --layer 1 --at 0,0", ["--layer", "--at"]),
        ("base --layers 1000000000000", ["rows are too many", "--at"]),
        ("contacts --layers 100000", ["rows are too many", "--layer"]),
        (
            "base --mass 1e300 --gravity 1e300 --units si --number f64",
            ["--number", "normal"],
        ),
        ("base --colour red", ["--colour", "unexpected"]),
        ("base --number f16", ["--number", "f32"]),
        ("heap", ["heap", "unrecognized"]),
        ("contacts --at 1,1", ["--at", "command base"]),
        (
            "contacts --layers 100000000 --layer 99999998",
            ["one sphere", "(--at)"],
        ),
        ("base 3", ["'3'", "'cannonpile base --help'"]),
        ("base --format json --output x.csv", ["--format", "csv"]),
    ] {
        let line = refusal(arguments);
        for fragment in fragments {
            assert!(
                line.contains(fragment),
                "{arguments}: no '{fragment}' in: {line}"
            );
        }
    }
}

#[test]
fn output_file_is_written_atomically() {
    let folder = Folder::new();
    let said = folder.stdout("base --layers 2 --format csv --output base.csv");
    assert!(said.is_empty());
    let written = folder.read("base.csv");
    assert_eq!(written, stdout("base --layers 2 --format csv"));
    // A failed command does not change the file, and leaves no other file.
    folder.refusal("base --mass 1e999 --units si --number f64 --output base.csv");
    folder.refusal("base --output none/base.csv");
    assert_eq!(folder.read("base.csv"), written);
    assert_eq!(folder.names(""), ["base.csv"]);
}

#[test]
fn file_extension_selects_the_format() {
    let folder = Folder::new();
    for (name, option) in [
        ("base.csv", "csv"),
        ("base.json", "json"),
        ("base.txt", "table"),
        ("base", "table"),
    ] {
        folder.stdout(&format!("base --layers 3 --output {name}"));
        assert_eq!(
            folder.read(name),
            stdout(&format!("base --layers 3 --format {option}"))
        );
    }
}

/// Paths may be absolute, and contain blanks and letters beyond ASCII.
#[test]
fn any_path_is_read_and_written() {
    let folder = Folder::new();
    let pile = folder.path("four layers, größer ⚪");
    let mut export = command();
    export.args(["export", "--layers", "4"]).arg(&pile);
    let exported = output(&mut export);
    assert_eq!(exported.status.code(), Some(0), "{exported:?}");
    let table = pile.join("contacts.csv");
    let mut verify = command();
    verify.args(["verify", "--accept", "0"]).arg(&table);
    let scene = pile.join("scene.toml");
    let verified = output(verify.arg("--scene").arg(scene));
    assert_eq!(verified.status.code(), Some(0), "{verified:?}");
    let missing = pile.join("no table.csv");
    let refused = output(command().arg("verify").arg(&missing));
    let said = String::from_utf8(refused.stderr).expect("text");
    let expected = "four layers, größer ⚪/no table.csv cannot be read: ";
    assert!(said.contains(expected), "{said}");
}

#[test]
fn bare_commands_print_help() {
    assert_eq!(stdout(""), stdout("--help"));
    assert_eq!(stdout("plot"), stdout("plot --help"));
}

/// A query about one sphere skips the stability check, which is slow for millions of layers.
#[test]
fn single_sphere_skips_stability_check() {
    for command in ["spheres", "contacts"] {
        stdout(&format!("{command} --at 0,0,0 --stacking=(9000000,1)"));
    }
    let output = cannonpile("contacts --stacking hcp --layers 7 --layer 5");
    let note = String::from_utf8(output.stderr).expect("text");
    assert!(note.contains("unstable"), "{note}");
    stdout("contacts --stacking hcp --layers 7 --at 0,0,0");
}

#[test]
fn closed_pipe_is_not_an_error() {
    let mut command = command();
    let command = command.args(["contacts", "--layers", "2000", "--format", "csv"]);
    let piped = command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut process = Process::start(piped).expect("the binary runs");
    let mut stdout = process.stdout();
    within(move || stdout.read_exact(&mut [0; 64]).expect("some rows"));
    let output = without_times(process.output());
    assert_eq!(output.status.code(), Some(0));
    assert!(
        output.stderr.is_empty(),
        "{:?}",
        String::from_utf8_lossy(&output.stderr)
    );
}

#[test]
fn times_are_removed_from_errors() {
    use std::process::ExitStatus;

    let left = |stderr: &str| {
        let output = Output {
            status: ExitStatus::default(),
            stdout: Vec::new(),
            stderr: stderr.into(),
        };
        String::from_utf8(without_times(output).stderr).expect("text")
    };
    let kept = "note: no plan: a reason, after all\nerror: x\n";
    let times =
        "note: working, after 00:01:00\n12 rows and 345 bytes in 3 files in 1.2 s: 10 rows/s\n";
    assert_eq!(left(&format!("{times}{kept}{times}")), kept);
    assert_eq!(left("no end of line"), "no end of line");
}
