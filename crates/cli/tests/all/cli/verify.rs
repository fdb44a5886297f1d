//! The command `verify`: accepted files, rejected files, usage errors.

use std::io::Write;
use std::process::{Output, Stdio};

use cannonpile_testkit::processes::Process;

use super::{Folder, command, output_of, refusal, stdout};

const LAMMPS: &[u8] = include_bytes!("../../../../dem/tests/all/verify/lammps.dump");

/// Returns the exact contact forces of a scene as a table for `verify`, built from the tables of the command line.
fn exact(scene: &str) -> String {
    let rows = |arguments: String| -> Vec<Vec<String>> {
        let csv = stdout(&format!("{arguments} {scene} --number f64 --format csv"));
        let fields = |line: &str| line.split(',').map(str::to_owned).collect();
        csv.lines().skip(1).map(fields).collect()
    };
    let spheres = rows("spheres".into());
    let id = |site: [&str; 3]| {
        let row = spheres.iter().find(|row| row[1..4] == site);
        &row.expect("a sphere")[0]
    };
    let mut csv = "id1,id2,force,fx,fy,fz\n".to_owned();
    for row in rows("contacts --units si".into()) {
        let [k, i, j]: [i32; 3] = [0, 1, 2].map(|n| row[n].parse().expect("an integer"));
        let below = match &*row[3] {
            "alpha" => [k + 1, i, j],
            "beta" => [k + 1, i + 1, j],
            _ => [k + 1, i, j + 1],
        };
        let below = below.map(|n| n.to_string());
        let below = id(below.each_ref().map(|n| &**n));
        let upper = id([&*row[0], &*row[1], &*row[2]]);
        let force = row[4..8].join(",");
        csv += &[&**upper, below, &force].join(",");
        csv.push('\n');
    }
    csv
}

fn no(folder: &Folder, arguments: &str) -> String {
    let Output {
        status,
        stdout,
        stderr,
    } = folder.cannonpile(arguments);
    assert_eq!(status.code(), Some(1), "{arguments}");
    assert!(stderr.is_empty(), "{arguments}");
    String::from_utf8(stdout).expect("text")
}

/// Returns the record of a report in json.
fn record(json: &str) -> serde_json::Value {
    let rows: serde_json::Value = serde_json::from_str(json).expect("json");
    rows[0].clone()
}

#[test]
fn exact_forces_have_zero_error() {
    for scene in [
        "--layers 3",
        "--layers 4 --mass 0.3 --gravity 9.81 --radius 0.01 --spacing 5/4",
    ] {
        let folder = Folder::with("exact.csv", exact(scene));
        let json = folder.stdout(&format!(
            "verify exact.csv {scene} --accept 0 --format json"
        ));
        let record = record(&json);
        assert_eq!(record["accepted"], true);
        for name in ["missing", "extra", "largest_error"] {
            assert_eq!(record[name].as_f64(), Some(0.0), "{name}");
        }
        assert_eq!(record["matched"], record["contacts"]);
    }
}

#[test]
fn simulation_is_accepted_within_the_error_of_its_springs() {
    let folder = Folder::with("lammps.dump", LAMMPS);
    let Output {
        status,
        stdout,
        stderr,
    } = folder.cannonpile("verify lammps.dump --layers 4 --format csv");
    assert_eq!(status.code(), Some(0));
    let csv = String::from_utf8(stdout).expect("text");
    let header = "accepted,accept,contacts,matched,repeated,missing,extra,noise,fixed,largest_error,rms_error,worst,beyond,factor,\
                  walls,floor,floor_error,frame,unbalanced,findings,rows,left_out,table,step";
    assert_eq!(csv.lines().next(), Some(header));
    assert!(
        csv.lines()
            .nth(1)
            .unwrap()
            .starts_with("yes,1e-6,30,30,0,0,0,0,0,1.1978"),
        "{csv}"
    );
    let note = String::from_utf8(stderr).expect("text");
    let want = "note: lammps.dump has 2 steps; this report is about step 40000\n";
    assert_eq!(note, want);
    let strict = folder.cannonpile("verify lammps.dump --layers 4 --accept 1e-7");
    assert_eq!(strict.status.code(), Some(1));
    let other = folder.cannonpile("verify lammps.dump --layers 4 --spacing 1.21");
    assert_eq!(other.status.code(), Some(1));
}

#[test]
fn wrong_missing_and_extra_contacts_are_named() {
    let csv = exact("--layers 3").replace("\n1,4,0.46225016352102427,", "\n1,4,0.5,");
    let folder = Folder::with("wrong.csv", csv);
    let table = no(&folder, "verify wrong.csv --layers 3");
    let reason = "no: 1 of 12 contacts is off by more than 1e-6, by up to 0.08167\n";
    assert!(table.starts_with(reason), "{table}");
    let worst = "worst: contact of sphere 1 (k=0, i=0, j=0) with sphere 4 along gamma: measured 0.5 N, exact 0.46225016352102427 N";
    assert!(table.contains(worst), "{table}");

    let gone = exact("--layers 3")
        .lines()
        .filter(|line| !line.starts_with("3,"))
        .fold(String::new(), |text, line| text + line + "\n");
    folder.write("gone.csv", gone + "2,3,0.25,0,0,0\n");
    let table = no(&folder, "verify gone.csv --layers 3");
    let reason = "no: 3 of 12 contacts are missing; 1 of the other pairs has a force\n";
    assert!(table.starts_with(reason), "{table}");
    let missing = "missing: contact of sphere 3 (k=1, i=1, j=0) with sphere 6 along alpha: not measured, exact 0.46225016352102427 N";
    assert!(table.contains(missing), "{table}");
    let extra =
        "extra: spheres 2 (k=1, i=0, j=0) and 3 (k=1, i=1, j=0) have no contact: measured 0.25 N";
    assert!(table.contains(extra), "{table}");

    let json = no(&folder, "verify gone.csv --layers 3 --format json");
    let row = record(&json);
    assert_eq!(row["accepted"], false);
    assert_eq!(
        (&row["matched"], &row["missing"], &row["extra"]),
        (&9.into(), &3.into(), &1.into())
    );
    assert_eq!(row["missing_contacts"].as_array().map(Vec::len), Some(3));
    assert_eq!(row["missing_contacts"][0]["direction"], "alpha");
    assert_eq!(row["extra_pairs"][0]["sites"][1]["i"], 1);
    assert_eq!(row["worst"]["error"], 0.0);
}

#[test]
fn wrong_gravity_is_reported_as_a_factor() {
    let folder = Folder::with("g.csv", exact("--layers 3 --gravity 9.81"));
    let wrong = record(&no(&folder, "verify g.csv --layers 3 --format json"));
    assert_eq!(wrong["beyond"], wrong["contacts"]);
    let factor = wrong["factor"].as_f64().expect("a number");
    assert!((factor - 9.81).abs() < 1e-12);
    let right = record(&folder.stdout("verify g.csv --layers 3 --gravity 9.81 --format json"));
    assert_eq!(right["beyond"], 0);
    assert!(right["factor"].is_null());
}

#[test]
fn infinite_table_is_rejected_at_the_third_row_of_a_pair() {
    let mut command = command();
    let piped = command
        .args(["verify", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let process = Process::start(piped).expect("the binary runs");
    let output = process.output_of(|mut stdin| {
        stdin.write_all(b"id1,id2,force\n").expect("read");
        // Write until the reader closes the pipe.
        while stdin.write_all(b"1,2,0.5\n").is_ok() {}
    });
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(
        String::from_utf8(output.stderr).expect("text"),
        "error: stdin, line 4: spheres 1 and 2 are already on line 2: list each pair once, or once in each order; if the \
         table holds several steps, name their column with step=COLUMN in --columns, or leave one step\n"
    );
}

#[test]
fn missing_contacts_are_counted_and_the_first_are_named() {
    let folder = Folder::with("one.csv", "id1,id2,force\n1,2,0.46225016352102427\n");
    let table = no(&folder, "verify one.csv --layers 5");
    assert!(
        table.starts_with("no: 59 of 60 contacts are missing\n"),
        "{table}"
    );
    assert!(table.contains("\nmissing: 54 more\n"));
}

#[test]
fn the_scene_beside_a_table_is_read_if_none_is_given() {
    let folder = Folder::with("g.csv", exact("--layers 3 --gravity 9.81"));
    folder.write("scene.toml", "layers = 3\ngravity = 9.81\n");
    let said = "\nscene_file: scene.toml, beside the table\n";
    let table = folder.stdout("verify g.csv");
    assert!(
        table.starts_with("yes: 12 contacts agree") && table.ends_with(said),
        "{table}"
    );
    // Any option of the scene replaces the file.
    let other = no(&folder, "verify g.csv --layers 3");
    assert!(!other.contains("scene.toml"), "{other}");
    folder.write("scene.toml", "layers = 3\ngravity = fast\n");
    let line = folder.refusal("verify g.csv");
    assert!(line.starts_with("error: scene.toml: line 2"), "{line}");
}

#[test]
fn a_table_without_contacts_has_no_verdict() {
    let folder = Folder::with("none.csv", "id1,id2,force\n");
    folder.write("floor.csv", "id1,id2,force\n8,9,1\n");
    for (file, reason) in [
        (
            "none.csv",
            "the file has no rows: did the simulation write any contact?",
        ),
        (
            "floor.csv",
            "1 row was read, but none is a contact of the scene",
        ),
    ] {
        let line = folder.refusal(&format!("verify {file} --layers 3"));
        assert!(line.contains(reason), "{line}");
    }
}

#[test]
fn dash_reads_stdin() {
    let mut command = command();
    command.args(["verify", "-", "--layers", "3", "--accept", "0"]);
    let output = output_of(&mut command, exact("--layers 3"));
    assert_eq!(output.status.code(), Some(0));
}

#[test]
fn usage_errors_are_one_line() {
    let folder = Folder::with("good.csv", exact("--layers 3"));
    folder.write("bad.csv", "id1,id2,force\n1,2,one\n");
    folder.write("beyond.csv", "id1,id2,force\n1,99,1\n");
    for (arguments, want) in [
        (
            "verify bad.csv",
            "error: bad.csv, line 2: force 'one' is not a number such as 0.46 or 1e-3\n",
        ),
        (
            "verify beyond.csv --layers 3",
            "error: beyond.csv, line 2: no sphere 99: the spheres of this scene are numbered 1 to 10, from the top; does the table have more layers, or several numbers for one wall?\n",
        ),
        (
            "verify no/such.csv",
            "error: no/such.csv cannot be read: no such file or folder; give a readable file, or - for stdin\n",
        ),
        (
            "verify good.csv --layers 3 --mass 1e-350",
            "error: --mass: a contact force of this scene does not fit in f64: measure mass or gravity in another unit\n",
        ),
        (
            "verify good.csv --layers 1000",
            "error: --layers: a comparison of all contacts would take 499999500 numbers, more than 100000000: use fewer layers, or \
             a smaller top or base\n",
        ),
    ] {
        assert_eq!(folder.refusal(arguments), want);
    }
    for accept in ["-1e-6", "nan", "inf", "1e999", "x", "-0"] {
        let line = folder.refusal(&format!("verify good.csv --accept {accept}"));
        assert!(
            line.contains("--accept <E>")
                && line.contains("not a relative error such as 1e-6, or 0"),
            "{line}"
        );
    }
    for (option, said) in [
        ("--quote ab", "'ab' is not a sign such as # or \", or none"),
        (
            "--separator ab",
            "'ab' is not a separator: one character, tab or blanks",
        ),
    ] {
        let line = folder.refusal(&format!("verify good.csv {option}"));
        let name = option.split(' ').next().expect("a name");
        assert!(line.contains(name) && line.contains(said), "{line}");
    }
    assert!(refusal("verify").contains("<FILE>"));
    let line = folder.refusal("verify good.csv --spacing 0.9");
    assert!(line.starts_with("error: --spacing"), "{line}");
}

#[test]
fn unstable_pile_is_compared_with_a_note() {
    let folder = Folder::with("falls.csv", "id1,id2,force\n1,2,1\n");
    let Output { status, stderr, .. } =
        folder.cannonpile("verify falls.csv --stacking hcp --layers 12");
    assert_eq!(status.code(), Some(1));
    let note = String::from_utf8(stderr).expect("text");
    assert!(note.starts_with("note: this pile is unstable"), "{note}");
}

#[test]
fn report_is_written_to_a_file() {
    let folder = Folder::with("exact-too.csv", exact("--layers 3"));
    folder.write("report.json", "");
    let said = folder.stdout("verify exact-too.csv --layers 3 --format json --output report.json");
    assert_eq!(said, "");
    assert!(folder.read("report.json").starts_with("[\n"));
}
