//! Small tables in the forms that people have, each with its right answer.
//!
//! They were made from the exact forces of three layers, in the shapes of public files and reports. A table is accepted
//! with all twelve contacts, or refused for the reason that the test names.

use std::path::Path;

use super::{command, output};

/// The right answer.
enum Answer {
    /// All contacts, with at most this error.
    Accepted(f64),
    /// A report with exit status 1 that contains these texts.
    Rejected(&'static [&'static str]),
    /// An error with exit status 2 that contains these texts.
    Refused(&'static [&'static str]),
}

use Answer::{Accepted, Refused, Rejected};

const EXACT: Answer = Accepted(0.0);
const ROUNDED: Answer = Accepted(2e-16);

/// Runs `verify` in the folder of a table.
fn verify(folder: &str, arguments: &[&str]) -> (Option<i32>, String, String) {
    let tables = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/all/cli/tables");
    let mut command = command();
    command
        .current_dir(tables.join(folder))
        .args(["verify", "--layers", "3", "--format", "json"])
        .args(arguments);
    let output = output(&mut command);
    let text = |bytes| String::from_utf8(bytes).expect("text");
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}

fn answers(folder: &str, arguments: &str, answer: &Answer) {
    // No name of a column in these tables contains two blanks.
    let arguments: Vec<&str> = arguments.split("  ").collect();
    let (status, out, err) = verify(folder, &arguments);
    let said = format!("{folder}: {status:?}\n{out}{err}");
    let value = |key: &str| {
        let report: serde_json::Value = serde_json::from_str(&out).expect(&said);
        report[0][key].clone()
    };
    match answer {
        Accepted(error) => {
            assert_eq!(status, Some(0), "{said}");
            assert_eq!(
                (value("matched"), value("missing")),
                (12.into(), 0.into()),
                "{said}"
            );
            assert!(
                value("largest_error").as_f64().expect(&said) <= *error,
                "{said}"
            );
            assert!(value("rows").as_u64() >= Some(12), "{said}");
        }
        Rejected(texts) => {
            assert_eq!(status, Some(1), "{said}");
            assert!(texts.iter().all(|text| out.contains(text)), "{said}");
        }
        Refused(texts) => {
            assert_eq!((status, out.as_str()), (Some(2), ""), "{said}");
            assert!(texts.iter().all(|text| err.contains(text)), "{said}");
        }
    }
}

#[test]
fn vtk_files() {
    let chain = "in.vtp  --columns  id1=FORCE_CHAIN_GLOBAL_ID1,id2=FORCE_CHAIN_GLOBAL_ID2,force=FORCE_CHAIN_FN_MAG";
    let by_place = "in.vtp  --match  place";
    for (folder, arguments, answer) in [
        (
            "vtp-array-longer-than-cells",
            by_place,
            Refused(&["13", "12"]),
        ),
        ("vtp-one-vertex-before-lines", by_place, EXACT),
        ("vtp-points-as-vertices-and-lines", by_place, EXACT),
        ("vtp-bit-array", by_place, EXACT),
        ("vtp-string-in-field-data", by_place, EXACT),
        ("vtp-velocity-nan-ind", by_place, EXACT),
        ("contacts-as-vertices", chain, EXACT),
        // Its numbers are of 32 bits.
        ("mfix-force-chain", chain, Accepted(1e-7)),
        ("pvtp", "in.pvtp  --match  place", EXACT),
    ] {
        answers(folder, arguments, &answer);
    }
}

#[test]
fn files_without_contacts() {
    for (folder, arguments, answer) in [
        ("header-only", "in.csv", Refused(&["no rows"])),
        (
            "html-page-in-place-of-data",
            "in.csv",
            Refused(&["an HTML page"]),
        ),
        (
            "kind-that-no-row-has",
            "in.csv  --columns  kind=type:SS",
            Refused(&["12 rows", "'sphere-sphere'"]),
        ),
        (
            "last-snapshot-empty",
            "in.dump",
            Refused(&["no rows", "12", "--step"]),
        ),
        (
            "rows-that-begin-with-a-hash",
            "in.csv",
            Refused(&["12 lines are comments", "--comment none"]),
        ),
        (
            "rows-that-begin-with-a-hash",
            "in.csv  --comment  none",
            EXACT,
        ),
        ("xml-that-is-no-vtk", "in.xml", Refused(&["XML"])),
    ] {
        answers(folder, arguments, &answer);
    }
}

#[test]
fn dialects() {
    let counted = "in.csv  --columns  id1=#1,id2=#2,force=#3";
    let ovito =
        "in.csv  --columns  id1=Particle Identifiers.1,id2=Particle Identifiers.2,force=Force";
    for (folder, arguments, answer) in [
        ("cr-after-header-lf-after-rows", "in.csv", EXACT),
        ("cr-only", "in.csv", EXACT),
        ("cr-only-blanks", "in.csv", EXACT),
        ("blanks-and-commas-in-a-cell", counted, EXACT),
        ("semicolons-and-a-comma-in-a-name", "in.csv", EXACT),
        ("semicolons-decimal-commas-no-header", counted, EXACT),
        ("tabs-and-a-comma-in-a-name", "in.csv", EXACT),
        (
            "counted-columns-in-a-dump",
            "in.dump  --columns  id1=#1,id2=#2,force=#3",
            EXACT,
        ),
        (
            "name-with-a-comma",
            "in.csv  --columns  id1=A,id2=B,force=\"Force, normal\"",
            EXACT,
        ),
        (
            "name-with-a-plus",
            "in.csv  --columns  id1=A,id2=B,force=1*Fn+Ft",
            EXACT,
        ),
        ("names-as-r-writes-them", "in.csv", EXACT),
        ("ovito-quoted-names-with-blanks", ovito, EXACT),
        ("quoted-cell-with-blank", "in.csv", EXACT),
        (
            "dem-engine-without-points-by-numbers",
            "in.csv  --preset  dem-engine  --match  numbers  --columns  id1=A,id2=B",
            ROUNDED,
        ),
        ("two-columns-x-that-are-not-needed", "in.csv", EXACT),
    ] {
        answers(folder, arguments, &answer);
    }
}

#[test]
fn contacts() {
    let fstat = "in.fstat  --columns  id1=#2,id2=#3,force=#9  --first-id  0";
    let local = "in.dump  --columns  id1=c_cp[7],id2=c_cp[8],fx=c_cp[10],fy=c_cp[11],fz=c_cp[12]";
    for (folder, arguments, answer) in [
        (
            "all-forces-0",
            "in.csv",
            Rejected(&[
                "\"largest_error\": 1.0",
                "\"beyond\": 12",
                "all measured forces are 0",
            ]),
        ),
        (
            "listed-with-force-0",
            "in.csv",
            Rejected(&[
                "\"matched\": 12",
                "\"beyond\": 1,",
                "a force of 0 was measured at 1",
            ]),
        ),
        (
            "negative-zero",
            "in.csv",
            Rejected(&[
                "\"matched\": 12",
                "\"beyond\": 1,",
                "a force of 0 was measured at 1",
            ]),
        ),
        ("csv-both-directions", "in.csv", EXACT),
        ("liggghts-across-a-boundary", local, ROUNDED),
        ("mercury-fstat-each-contact-twice", fstat, EXACT),
        (
            "mercury-fstat-each-contact-twice",
            "in.fstat  --preset  mercurydpm",
            EXACT,
        ),
        (
            "two-time-steps-in-one-table",
            "in.fstat  --preset  mercurydpm",
            EXACT,
        ),
        ("parallel-dump-two-pieces-one-step", "in.dump", EXACT),
        ("step-column", "in.csv", EXACT),
        (
            "step-column",
            "in.csv  --step  0",
            Rejected(&["\"step\": \"0\""]),
        ),
        (
            "step-column",
            "in.csv  --step  50",
            Refused(&["no step '50'", "'0', '100'"]),
        ),
        ("two-time-steps-in-one-table", fstat, EXACT),
        (
            "two-time-steps-in-one-table",
            "in.fstat  --columns  id1=#2,id2=#3,force=#9,step=#1  --first-id  0",
            EXACT,
        ),
        (
            "frame-tilted-about-y",
            "in.csv  --match  place",
            Refused(&["no frame matches", "turn positions and vectors"]),
        ),
        (
            "force-0-vectors-right",
            "in.csv",
            Rejected(&[
                "force and vector disagree at 12 of the contacts: all vectors are the exact ones",
            ]),
        ),
        (
            "vectors-0-force-right",
            "in.csv",
            Rejected(&[
                "force and vector disagree at 12 of the contacts: all forces are the exact ones",
            ]),
        ),
    ] {
        answers(folder, arguments, &answer);
    }
}

#[test]
fn errors_speak_as_the_table_does() {
    for (folder, arguments, texts) in [
        (
            "id-too-great-first-id-0",
            "in.csv  --first-id  0",
            &["no sphere 10", "0 to 9"][..],
        ),
        (
            "repeated-pair-first-id-0",
            "in.csv  --first-id  0",
            &["spheres 0 and 1", "line 2"],
        ),
        (
            "row-names-of-r",
            "in.csv",
            &["the name of the first column"],
        ),
        (
            "table-without-header",
            "in.txt  --preset  exadem",
            &["15 columns", "no header"],
        ),
        ("row-of-totals", "in.csv", &["'Total'", "line 5", "footer"]),
        ("zero-based-ids", "in.csv", &["no sphere 0", "--first-id 0"]),
    ] {
        let (status, out, err) = verify(folder, &arguments.split("  ").collect::<Vec<_>>());
        assert_eq!((status, out.as_str()), (Some(2), ""), "{folder}: {err}");
        assert!(
            texts.iter().all(|text| err.contains(text)),
            "{folder}: {err}"
        );
    }
}

/// Of a parallel run only the summary file is given. The pieces of one are there, those of the other are not.
#[test]
fn pieces_that_are_not_there_are_named() {
    answers(
        "pvtu-of-lethe",
        "in.pvtu  --preset  lethe",
        &Refused(&[".vtu"]),
    );
}

#[test]
fn floors_and_parts_of_forces() {
    let rough = "--layers 2 --top triangle:3 --spacing 1.2 --floor rough";
    let with_floor = format!("{rough} --floor-table floor.csv");
    let missing =
        |spheres: &str| format!("no: the force of the floor is missing below {spheres}, ");
    let whole = "whole-and-tangential-force";
    for (folder, arguments, said) in [
        (
            "floor-row-of-one-sphere-missing",
            "in.csv --layers 3",
            missing("1 bottom sphere"),
        ),
        (
            "floor-row-of-one-sphere-missing-by-place",
            "in.csv --layers 3 --match place",
            missing("1 bottom sphere"),
        ),
        (
            "floor-row-of-one-sphere-only",
            "in.csv --layers 3",
            missing("5 bottom spheres"),
        ),
        (
            "rough-floor-row-of-one-sphere-missing",
            &format!("in.csv {rough}"),
            missing("1 bottom sphere"),
        ),
        (
            "rough-floor-without-its-forces",
            &format!("in.csv {rough}"),
            missing("10 bottom spheres"),
        ),
        (
            whole,
            &format!("in.csv {with_floor}"),
            "no: 18 of 18 contacts are off".into(),
        ),
        (
            whole,
            &format!("in.csv {with_floor} --columns fx=fx-tx,fy=fy-ty,fz=fz-tz"),
            "yes: 18 contacts and 10 with the floor agree".into(),
        ),
        (
            "tangential-columns-dropped",
            &format!("in.csv {with_floor} --columns fx=fx,fy=fy,fz=fz"),
            "yes: 18 contacts and 10 with the floor agree".into(),
        ),
        (
            "gzip-with-zeros-at-the-end",
            "in.csv.gz --layers 3",
            "yes: 12 contacts agree".into(),
        ),
    ] {
        let tables = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/all/cli/tables");
        let mut command = command();
        command
            .current_dir(tables.join(folder))
            .arg("verify")
            .args(arguments.split(' '));
        let output = output(&mut command);
        let out = String::from_utf8(output.stdout).expect("text");
        assert!(out.starts_with(&said), "{folder}: {out}");
        let is_yes = said.starts_with("yes");
        assert_eq!(output.status.code(), Some(i32::from(!is_yes)), "{folder}");
        // One finding names the whole forces, and none a factor.
        let findings = out.lines().filter(|line| line.starts_with("finding: "));
        let findings: Vec<_> = findings.collect();
        let is_whole = !is_yes && folder == whole;
        assert_eq!(findings.len(), usize::from(is_whole), "{out}");
        assert!(
            findings
                .iter()
                .all(|said| said.contains("are the whole forces")),
            "{out}"
        );
    }
}
