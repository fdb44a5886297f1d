//! The command `export`: files, list of the files, errors.

use std::fs;
use std::path::Path;

use super::{cannonpile, refusal, stdout};

/// Returns the file names in a folder, with hidden files.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let names = entries.map(|entry| entry.expect("an entry").file_name());
    let mut names: Vec<String> = names.map(|name| name.to_string_lossy().into()).collect();
    names.sort();
    names
}

#[test]
fn files_by_format() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    for (name, to, files) in [
        (
            "default",
            "",
            &[
                "base.csv",
                "columns.csv",
                "contacts.csv",
                "scene.toml",
                "spheres.csv",
            ][..],
        ),
        (
            "lammps",
            "--to lammps",
            &["pile.data", "pile.in", "scene.toml"],
        ),
        (
            "two",
            "--to vtp,yade --to vtp",
            &[
                "contacts.vtp",
                "pile.py",
                "scene.toml",
                "spheres.txt",
                "spheres.vtp",
            ],
        ),
    ] {
        let into = at(name);
        stdout(&format!("export {} {to} --layers 3", into.display()));
        assert_eq!(names(&into), files, "{to}");
    }
    let all = at("all");
    let list = stdout(&format!(
        "export {} --to all --layers 3 --format csv",
        all.display()
    ));
    let mut lines = list.lines();
    assert_eq!(lines.next(), Some("file,rows,bytes"));
    let listed: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    assert_eq!(listed.len(), 13);
    assert_eq!(names(&all).len(), 13);
    for file in &listed {
        let bytes = fs::metadata(file[0]).expect("a file").len();
        assert_eq!(file[2], bytes.to_string());
    }
    let rows: Vec<&str> = listed.iter().map(|file| file[1]).collect();
    assert_eq!(
        rows,
        [
            "10", "12", "6", "", "10", "", "10", "12", "10", "", "", "", ""
        ]
    );
}

#[test]
fn csv_files_equal_the_tables() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = "--top hexagon:3 --stacking=+-+ --spacing 1.1 --radius 1/2 --load 1,0,0=2";
    stdout(&format!("export {} {scene}", folder.path().display()));
    let read = |name| fs::read_to_string(folder.path().join(name)).expect("a file");
    let printed = |command: &str| stdout(&format!("{command} {scene} --number f64 --format csv"));
    let without_last = |csv: String| {
        let lines = csv
            .lines()
            .map(|line| line.rsplit_once(',').expect("columns").0);
        lines.fold(String::new(), |text, line| text + line + "\n")
    };
    assert_eq!(without_last(read("spheres.csv")), printed("spheres"));
    assert_eq!(without_last(read("base.csv")), printed("base --units si"));
    let forces = printed("contacts --units si");
    let forces = forces
        .lines()
        .map(|line| line.split(',').skip(4).take(4).collect::<Vec<_>>());
    let found = read("contacts.csv");
    let found = found
        .lines()
        .map(|line| line.split(',').skip(2).take(4).collect::<Vec<_>>());
    assert!(found.eq(forces));
}

#[test]
fn unstable_pile_is_exported_with_a_note() {
    let folder = tempfile::tempdir().expect("a folder");
    let into = folder.path().display();
    let output = cannonpile(&format!(
        "export {into} --to lammps --stacking hcp --layers 7"
    ));
    assert_eq!(output.status.code(), Some(0));
    let note = String::from_utf8(output.stderr).expect("text");
    assert_eq!(note.lines().count(), 1);
    assert!(note.contains("unstable"), "{note}");
    assert_eq!(names(folder.path()), ["pile.data", "pile.in", "scene.toml"]);
}

#[test]
fn failed_export_leaves_no_file() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("file"), "").expect("a file");
    let inside = folder.path().display();
    for (arguments, fragments) in [
        ("export", ["DIR", "required"]),
        ("export {}/new --to blend", ["--to", "lammps"]),
        ("export {}/new --spacing 1.7", ["--spacing", "overlap"]),
        (
            "export {}/new --layers 100000",
            ["--layers", "rows are too many"],
        ),
        ("export {}/new --radius 1e999", ["--radius", "other units"]),
        ("export {}/new --mass 1e999", ["--mass", "other units"]),
        (
            "export {}/new --output {}/./new/base.csv",
            ["--list", "another file"],
        ),
        ("export {}/new --to lammps --mass 1e-400", ["--mass", "f64"]),
        (
            "export {}/new --to yade --radius 1e-120",
            ["--radius", "volume"],
        ),
        ("export {}/file", ["/file: not a directory", "cannot write"]),
        ("export {}/file/new", ["/file/new", "cannot write"]),
    ] {
        let line = refusal(&arguments.replace("{}", &inside.to_string()));
        for fragment in fragments {
            assert!(
                line.contains(fragment),
                "{arguments}: no '{fragment}' in: {line}"
            );
        }
        assert_eq!(names(folder.path()), ["file"], "{arguments}");
    }
}

#[cfg(unix)]
#[test]
fn signals_remove_unfinished_files() {
    use std::io::Read;
    use std::process::{Command, Stdio};
    use std::thread::sleep;
    use std::time::Duration;

    for (signal, status) in [
        ("INT", 130),
        ("TERM", 143),
        ("HUP", 129),
        ("QUIT", 131),
        ("USR1", 138),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let into = folder.path().join("new/pile");
        let mut export = Command::new(env!("CARGO_BIN_EXE_cannonpile"))
            .args(["export", "--layers", "200"])
            .arg(&into)
            .stderr(Stdio::piped())
            .spawn()
            .expect("the binary runs");
        while !into.exists() || names(&into).is_empty() {
            if let Some(ended) = export.try_wait().expect("a child") {
                let mut said = String::new();
                let stderr = export.stderr.as_mut().expect("a pipe");
                stderr.read_to_string(&mut said).expect("text");
                panic!("{ended} before the signal: {said}");
            }
            sleep(Duration::from_millis(2));
        }
        let id = export.id().to_string();
        let sent = Command::new("kill").args(["-s", signal, &id]).status();
        assert!(sent.expect("a signal").success());
        assert_eq!(export.wait().expect("it ends").code(), Some(status));
        assert!(names(folder.path()).is_empty(), "{signal}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn full_disk_error_names_the_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let full = folder.path().join("contacts.csv");
    std::os::unix::fs::symlink("/dev/full", full).expect("a link");
    let line = refusal(&format!("export {}", folder.path().display()));
    assert!(line.contains("contacts.csv: no storage space"), "{line}");
    assert_eq!(names(folder.path()), ["contacts.csv"]);
}
