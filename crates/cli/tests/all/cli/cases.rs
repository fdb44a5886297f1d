//! Benchmark cases: the command `cases` and the option `--case`.

use std::collections::BTreeMap;
use std::fs;

use cannonpile_dem::scene::{Floor, cases};

use super::{Folder, cannonpile, stdout};

impl Folder {
    /// Runs `export`, and ignores notes about unstable piles.
    fn export(&self, into: &str, arguments: &str) {
        let output = self.cannonpile(&format!("export {into} {arguments}"));
        assert_eq!(output.status.code(), Some(0), "{arguments}: {output:?}");
    }

    /// Returns the files of a folder below this one, sorted by name.
    fn files(&self, below: &str) -> Vec<(String, Vec<u8>)> {
        let files = self.names(below).into_iter().map(|name| {
            let content = fs::read(self.path(below).join(&name));
            (name, content.expect("a file"))
        });
        files.collect()
    }
}

#[test]
fn case_equals_its_scene() {
    let folder = Folder::new();
    for case in cases() {
        let name = case.name();
        let at = |what: &str| format!("{name}-{what}");
        let is_rough = case.scene().expect("a scene").floor == Floor::Rough;
        let (formats, count) = if is_rough {
            ("--to lammps,yade", 5)
        } else {
            ("--to csv,lammps,vtp,yade", 11)
        };
        let file = at("scene.toml");
        folder.write(&file, case.toml());
        folder.export(&at("case"), &format!("--case {name} {formats}"));
        folder.export(&at("scene"), &format!("--scene {file} {formats}"));
        let [of_case, of_scene] = [at("case"), at("scene")].map(|below| folder.files(&below));
        assert_eq!(of_case.len(), count, "{name}");
        assert!(of_case == of_scene, "{name}");
        if is_rough {
            continue;
        }
        // The exported forces are exact, so verify accepts them.
        let contacts = at("case") + "/contacts.csv";
        let said = folder.cannonpile(&format!(
            "verify {contacts} --case {name} --accept 0 --format csv"
        ));
        assert_eq!(said.status.code(), Some(0), "{name}: {said:?}");
        assert!(
            said.stdout.windows(5).any(|part| part == b"\nyes,"),
            "{name}: {said:?}"
        );
    }
}

#[test]
fn command_of_each_case_runs() {
    let folder = Folder::new();
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
        folder.export(into, arguments);
        let card = folder.read(&format!("{into}/card.md"));
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
    let folder = Folder::new();
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
        let line = folder.refusal(&format!("export pile --case C2 {option}"));
        let name = option.split(' ').next().expect("an option");
        for part in ["--case <NAME>", name, "leave one of the two out"] {
            assert!(line.contains(part), "{line}");
        }
    }
    for (arguments, parts) in [
        ("summary --case C23", ["--case", "did you mean 'C2'?"]),
        (
            "summary --case straight",
            ["--case", "'cannonpile cases' lists"],
        ),
        (
            "summary --case C10",
            ["--case C10: state", "--state isostatic"],
        ),
        (
            "export pile --case C8 --to lammps-test",
            ["invalid value 'lammps-test'", "possible values"],
        ),
        (
            "export pile --layers 3 --state elastic --stiffness-ratio 2 --to yade",
            ["--stiffness-ratio", "use 1"],
        ),
    ] {
        let line = folder.refusal(arguments);
        for part in parts {
            assert!(line.contains(part), "{line}");
        }
    }
    assert!(folder.names("").is_empty());
}

/// With another `--state` the scene is not the case any more, so the card does not have its name.
#[test]
fn card_names_its_case() {
    let folder = Folder::new();
    let head = |arguments: &str| {
        let into = arguments.replace([' ', '-'], "");
        folder.export(&into, &format!("{arguments} --to card"));
        let card = folder.read(&format!("{into}/card.md"));
        card.lines().next().expect("a head").to_owned()
    };
    assert!(head("--case C10 --state elastic").starts_with("# C10: "));
    assert_eq!(
        head("--case C10 --state isostatic"),
        "# A pile of 120 spheres in 8 layers"
    );
}
