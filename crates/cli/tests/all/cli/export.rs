//! The command `export`: files, list of the files, errors.

use std::fs;

use super::{Folder, stdout};

#[test]
fn files_by_format() {
    let folder = Folder::new();
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
        folder.stdout(&format!("export {name} {to} --layers 3"));
        assert_eq!(folder.names(name), files, "{to}");
    }
    let list = folder.stdout("export all --to all --layers 3 --format csv");
    let mut lines = list.lines();
    assert_eq!(lines.next(), Some("file,rows,bytes"));
    let listed: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    assert_eq!(listed.len(), 13);
    assert_eq!(folder.names("all").len(), 13);
    for file in &listed {
        let bytes = fs::metadata(folder.path(file[0])).expect("a file").len();
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
    let folder = Folder::new();
    let scene = "--top hexagon:3 --stacking=+-+ --spacing 1.1 --radius 1/2 --load 1,0,0=2";
    folder.stdout(&format!("export . {scene}"));
    let printed = |command: &str| stdout(&format!("{command} {scene} --number f64 --format csv"));
    let without_last = |csv: String| {
        let lines = csv
            .lines()
            .map(|line| line.rsplit_once(',').expect("columns").0);
        lines.fold(String::new(), |text, line| text + line + "\n")
    };
    assert_eq!(without_last(folder.read("spheres.csv")), printed("spheres"));
    assert_eq!(
        without_last(folder.read("base.csv")),
        printed("base --units si")
    );
    let forces = printed("contacts --units si");
    let forces = forces
        .lines()
        .map(|line| line.split(',').skip(4).take(4).collect::<Vec<_>>());
    let found = folder.read("contacts.csv");
    let found = found
        .lines()
        .map(|line| line.split(',').skip(2).take(4).collect::<Vec<_>>());
    assert!(found.eq(forces));
}

#[test]
fn unstable_pile_is_exported_with_a_note() {
    let folder = Folder::new();
    let output = folder.cannonpile("export . --to lammps --stacking hcp --layers 7");
    assert_eq!(output.status.code(), Some(0));
    let note = String::from_utf8(output.stderr).expect("text");
    assert_eq!(note.lines().count(), 1);
    assert!(note.contains("unstable"), "{note}");
    assert_eq!(folder.names(""), ["pile.data", "pile.in", "scene.toml"]);
}

#[test]
fn failed_export_leaves_no_file() {
    let folder = Folder::with("file", "");
    for (arguments, fragments) in [
        ("export", ["DIR", "required"]),
        ("export ./new --to blend", ["--to", "lammps"]),
        ("export ./new --spacing 1.7", ["--spacing", "overlap"]),
        (
            "export ./new --layers 100000",
            ["--layers", "rows are too many"],
        ),
        ("export ./new --radius 1e999", ["--radius", "other units"]),
        ("export ./new --mass 1e999", ["--mass", "other units"]),
        (
            "export ./new --output ././new/base.csv",
            ["--list", "another file"],
        ),
        ("export ./new --to lammps --mass 1e-400", ["--mass", "f64"]),
        (
            "export ./new --to yade --radius 1e-120",
            ["--radius", "volume"],
        ),
        ("export ./file", ["/file: not a directory", "cannot write"]),
        ("export ./file/new", ["/file/new", "cannot write"]),
    ] {
        let line = folder.refusal(arguments);
        for fragment in fragments {
            assert!(
                line.contains(fragment),
                "{arguments}: no '{fragment}' in: {line}"
            );
        }
        assert_eq!(folder.names(""), ["file"], "{arguments}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn full_disk_error_names_the_file() {
    let folder = Folder::new();
    std::os::unix::fs::symlink("/dev/full", folder.path("contacts.csv")).expect("a link");
    let line = folder.refusal("export .");
    assert!(line.contains("contacts.csv: no storage space"), "{line}");
    assert_eq!(folder.names(""), ["contacts.csv"]);
}
