//! Tests of the command `verify` on tables of other codes: columns, presets, positions, refinement studies, records,
//! errors.

use serde_json::Value;

use super::Folder;

impl Folder {
    /// Creates a folder with the exports of ten layers at a = 1.2 R.
    fn exported() -> Self {
        let folder = Self::new();
        folder.stdout("export pile --to csv,vtp --layers 10 --spacing 1.2");
        folder
    }

    /// Writes a table with a header and one line for each row of contacts.csv.
    fn table(&self, name: &str, header: &str, line: impl Fn(&[&str]) -> String) {
        let contacts = self.read(CONTACTS);
        let rows = contacts.lines().skip(1).map(|row| {
            let fields: Vec<&str> = row.split(',').collect();
            line(&fields)
        });
        let lines: Vec<String> = std::iter::once(header.to_owned()).chain(rows).collect();
        self.write(name, lines.join("\n") + "\n");
    }
}

const CONTACTS: &str = "pile/contacts.csv";

const SCENE: &str = "--layers 10 --spacing 1.2";

#[test]
fn accepts_tables_of_other_codes() {
    let exported = Folder::exported();
    exported.table("a.txt", "# A B Fn", |row| {
        let less = |id: &str| id.parse::<u64>().expect("a number") - 1;
        format!("{} {} -{}", less(row[0]), less(row[1]), row[2])
    });
    let columns = "--columns id1=A,id2=B,force=-Fn --first-id 0";
    let table = exported.stdout(&format!("verify a.txt {columns} {SCENE} --accept 0"));
    assert!(table.starts_with("yes: "), "{table}");
    let lines = "pile/contacts.vtp";
    for matching in ["numbers", "place", "place --within 0.01"] {
        let table = exported.stdout(&format!(
            "verify {lines} --match {matching} {SCENE} --accept 0"
        ));
        assert!(!table.contains("\nframe"), "{table}");
    }
    let table = exported.stdout(&format!("verify {lines} --preset lethe {SCENE} --accept 0"));
    assert!(table.contains("yes"), "{table}");
}

#[test]
fn residual_forces_are_written_to_a_file() {
    let exported = Folder::exported();
    for ending in ["csv", "json"] {
        let rest = format!("rest.{ending}");
        let table = exported.stdout(&format!("verify {CONTACTS} {SCENE} --unbalanced {rest}"));
        assert!(table.starts_with("yes: "), "{table}");
        let text = exported.read(&rest);
        let rows = match ending {
            "csv" => text.lines().count() - 1,
            _ => serde_json::from_str::<Vec<Value>>(&text)
                .expect("json")
                .len(),
        };
        // One row for each sphere above the bottom layer.
        assert_eq!(rows, 165);
    }
}

#[test]
fn record_contains_scene_and_hash() {
    let exported = Folder::exported();
    let json = exported.stdout(&format!("verify {CONTACTS} {SCENE} --format json"));
    let record: Value = serde_json::from_str(&json).expect("json");
    let source = &record[0]["source"];
    assert_eq!(source["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(source["file"], CONTACTS);
    assert_eq!(source["bytes"], exported.read(CONTACTS).len());
    // The program `sha256sum` computed the expected digest.
    exported.write("header.csv", "id1,id2,force\n1,2,1\n");
    let json = exported.cannonpile(&format!("verify header.csv {SCENE} --format json"));
    let json = json.stdout;
    let other: Value = serde_json::from_slice(&json).expect("json");
    assert_eq!(
        other[0]["source"]["sha256"],
        "d7d1f779ebeb0e29bfc61d26069ec90ea5f96c47c9edcb9eb89a3bf3d95aaa80"
    );
    exported.write("again.toml", source["scene"].as_str().expect("text"));
    let table = exported.stdout(&format!("verify {CONTACTS} --scene again.toml --accept 0"));
    assert!(table.contains("yes"), "{table}");
}

#[test]
fn refinement_has_an_order() {
    let exported = Folder::exported();
    let mut files = Vec::new();
    for stiffness in ["1e4", "1e5", "1e6", "1e7"] {
        let k: f64 = stiffness.parse().expect("a number");
        exported.table(stiffness, "id1,id2,force", |row| {
            let force: f64 = row[2].parse().expect("a number");
            format!("{},{},{:?}", row[0], row[1], force * (1.0 + 4.0 / k))
        });
        files.push(format!("{stiffness}={stiffness}"));
    }
    let (list, json) = (files.join(","), "refinement.json");
    let table = exported.stdout(&format!("verify --refinement {list} {SCENE} --accept 1e-3"));
    assert!(
        table.contains("stiffness") && table.contains("order"),
        "{table}"
    );
    exported.stdout(&format!(
        "verify --refinement {list} {SCENE} --format json --output {json}"
    ));
    let text = exported.read(json);
    let record: Value = serde_json::from_str(&text).expect("json");
    assert_eq!(record["files"].as_array().expect("an array").len(), 4);
    assert_eq!(record["levels"].as_array().expect("an array").len(), 4);
    assert!(
        record["scene"]
            .as_str()
            .expect("text")
            .contains("layers = 10")
    );
    // Errors that do not depend on the time step have no observed order, so the exit status is 1.
    let flat = "1e-3=1e4,1e-4=1e4,1e-5=1e4";
    let output = exported.cannonpile(&format!(
        "verify --refinement {flat} --parameter time-step {SCENE}"
    ));
    assert_eq!(output.status.code(), Some(1));
}

#[test]
fn errors_in_tables_name_the_option() {
    for (table, said) in [
        ("id1,id2,force\n1,\"2,1\n", "use --quote none"),
        ("id1;id2;force\n1;2;1,234\n", "use --decimal comma"),
        ("id1,id2,force\n#1,2,1\n#1,3,1\n", "use --comment none"),
        (
            "step,id1,id2,force\n1,1,2,1\n2,1,2,1\n1,1,3,1\n",
            "choose one of them with --step",
        ),
    ] {
        let folder = Folder::with("in.csv", table);
        let line = folder.refusal("verify in.csv --layers 2 --spacing 1.2");
        assert!(line.contains(said), "{line}");
    }
}

#[test]
fn usage_errors_of_tables() {
    let exported = Folder::exported();
    for (options, said) in [
        ("--columns mass=A", "'mass' is not one of id1"),
        ("--columns id1=A", "no column 'A' for id1"),
        ("--preset matlab", "'matlab' is not lammps, yade"),
        ("--within 0.1", "--within requires --match place"),
        ("--match place", "no column x, only"),
        ("--match place --within 0.7", "--within: 0.7 radii"),
        (
            "--match place --first-id 0",
            "--first-id requires --match numbers",
        ),
        ("--parameter time-step", "--refinement"),
        ("--refinement 1e5=a.csv", "cannot be used with"),
    ] {
        let line = exported.refusal(&format!("verify {CONTACTS} {options} {SCENE}"));
        assert!(line.contains(said), "{options}: {line}");
    }
    for (list, said) in [
        ("a.csv", "has no ="),
        ("1e5=a.csv,1e5=b.csv", "1e5"),
        ("0=a.csv", "0"),
        ("1e5=,1e6=b.csv", "1e5="),
    ] {
        let line = exported.refusal(&format!("verify --refinement {list} {SCENE}"));
        assert!(line.contains(said), "{list}: {line}");
    }
    let line = exported.refusal(&format!(
        "verify --refinement 1e5={CONTACTS},1e6=/not/there {SCENE}"
    ));
    assert!(line.contains("/not/there cannot be read"), "{line}");
}
