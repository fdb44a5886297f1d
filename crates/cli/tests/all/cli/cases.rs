//! Benchmark cases: the command `cases` and the option `--case`.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use cannonpile_dem::scene::{Floor, cases};

use super::{cannonpile, refusal, stdout};

/// Runs `export`, and ignores notes about unstable piles.
fn export(folder: &Path, arguments: &str) {
    let output = cannonpile(&format!("export {} {arguments}", folder.display()));
    assert_eq!(output.status.code(), Some(0), "{arguments}: {output:?}");
}

/// Returns the files of a folder, sorted by name.
fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(folder).expect("a folder");
    let files = entries.map(|entry| {
        let entry = entry.expect("an entry");
        let name = entry.file_name().to_string_lossy().into_owned();
        (name, fs::read(entry.path()).expect("a file"))
    });
    let mut files: Vec<_> = files.collect();
    files.sort();
    files
}

#[test]
fn case_equals_its_scene() {
    let folder = tempfile::tempdir().expect("a folder");
    for case in cases() {
        let name = case.name();
        let at = |what: &str| folder.path().join(format!("{name}-{what}"));
        let is_rough = case.scene().expect("a scene").floor == Floor::Rough;
        let (formats, count) = if is_rough {
            ("--to lammps,yade", 5)
        } else {
            ("--to csv,lammps,vtp,yade", 11)
        };
        let file = at("scene.toml");
        fs::write(&file, case.toml()).expect("a scene");
        export(&at("case"), &format!("--case {name} {formats}"));
        export(
            &at("scene"),
            &format!("--scene {} {formats}", file.display()),
        );
        let [of_case, of_scene] = [at("case"), at("scene")].map(|folder| files(&folder));
        assert_eq!(of_case.len(), count, "{name}");
        assert!(of_case == of_scene, "{name}");
        if is_rough {
            continue;
        }
        // The exported forces are exact, so verify accepts them.
        let contacts = at("case").join("contacts.csv");
        let arguments = format!(
            "verify {} --case {name} --accept 0 --format csv",
            contacts.display()
        );
        let said = cannonpile(&arguments);
        assert_eq!(said.status.code(), Some(0), "{name}: {said:?}");
        assert!(
            said.stdout.windows(5).any(|part| part == b"\nyes,"),
            "{name}: {said:?}"
        );
    }
}

#[test]
fn command_of_each_case_runs() {
    let folder = tempfile::tempdir().expect("a folder");
    let csv = stdout("cases --format csv");
    let mut reader = ::csv::Reader::from_reader(csv.as_bytes());
    let rows: Vec<_> = reader.records().map(|row| row.expect("a row")).collect();
    assert_eq!(rows.len(), cases().len());
    for (row, case) in rows.iter().zip(cases()) {
        let arguments = row[7]
            .strip_prefix("cannonpile export ")
            .expect("an export");
        let (into, arguments) = arguments.split_once(' ').expect("options");
        assert_eq!(
            (into, &row[0], &row[1]),
            (case.name(), case.name(), case.title())
        );
        let into = folder.path().join(into);
        export(&into, arguments);
        let card = fs::read_to_string(into.join("card.md")).expect("a card");
        assert!(card.starts_with(&format!("# {}: {}\n", case.name(), case.title())));
        let summary = cannonpile(&format!(
            "summary --case {} --state isostatic --format csv",
            &row[0]
        ));
        let summary = String::from_utf8(summary.stdout).expect("text");
        let mut lines = summary.lines().map(|line| line.split(','));
        let [names, cells] = [(); 2].map(|()| lines.next().expect("a row"));
        let summary: BTreeMap<&str, &str> = names.zip(cells).collect();
        let said = ["layers", "spheres", "contacts", "stands"].map(|name| summary[name]);
        assert_eq!([&row[3], &row[4], &row[5], &row[6]], said);
    }
    let json: serde_json::Value =
        serde_json::from_str(&stdout("cases --format json")).expect("JSON");
    assert_eq!(json.as_array().map(Vec::len), Some(cases().len()));
}

#[test]
fn case_excludes_scene_options() {
    for option in [
        "--layers 4",
        "--stacking hcp",
        "--top hexagon:2",
        "--base hexagon:2",
        "--dimension 2",
        "--sin-phi 1/3",
        "--load 0,0,0=1",
        "--weightless",
        "--spacing 1.1",
        "--radius 2",
        "--mass 2",
        "--gravity 2",
        "--stiffness-ratio 2",
    ] {
        let line = refusal(&format!("export pile --case C2 {option}"));
        let name = option.split(' ').next().expect("an option");
        for part in ["--case <NAME>", name, "leave one of the two out"] {
            assert!(line.contains(part), "{line}");
        }
    }
    for (arguments, parts) in [
        ("summary --case C22", ["--case", "did you mean 'C2'?"]),
        (
            "summary --case straight",
            ["--case", "'cannonpile cases' lists"],
        ),
        (
            "summary --case C10",
            ["--case C10: state", "--state isostatic"],
        ),
        (
            "export pile --case C14 --to yade-check",
            ["--case C14: layers", "--to lammps,yade"],
        ),
        (
            "export pile --case C8 --to lammps-test",
            ["need a tensile force", "yade-check"],
        ),
        (
            "export pile --layers 3 --state elastic --stiffness-ratio 2 --to yade-check",
            ["--stiffness-ratio", "use 1"],
        ),
    ] {
        let line = refusal(arguments);
        for part in parts {
            assert!(line.contains(part), "{line}");
        }
    }
    assert!(!Path::new("pile").exists());
}

/// With another `--state` the scene is not the case any more, so the card does not have its name.
#[test]
fn card_names_its_case() {
    let folder = tempfile::tempdir().expect("a folder");
    let head = |arguments: &str| {
        let into = folder.path().join(arguments.replace(' ', "-"));
        export(&into, &format!("{arguments} --to card"));
        let card = fs::read_to_string(into.join("card.md")).expect("a card");
        card.lines().next().expect("a head").to_owned()
    };
    assert!(head("--case C10 --state elastic").starts_with("# C10: "));
    assert_eq!(
        head("--case C10 --state isostatic"),
        "# A pile of 120 spheres in 8 layers"
    );
}
