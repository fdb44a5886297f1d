//! Stackings, tops, bases and loads on the command line, and the stability of piles.

use super::{cannonpile, only_reasons, refusal, stdout};

/// Returns the named columns of a summary, and the exit status.
fn summary(arguments: &str, names: &[&str]) -> (Vec<String>, Option<i32>) {
    let output = cannonpile(&format!("summary {arguments} --format csv"));
    let csv = String::from_utf8(output.stdout.clone()).expect("text");
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let headers = reader.headers().expect("headers").clone();
    let row = reader.records().next().expect("a row").expect("a record");
    // Stderr contains the reasons of empty columns, and nothing else.
    assert!(only_reasons(&output.stderr), "{arguments}: {output:?}");
    let said = String::from_utf8_lossy(&output.stderr);
    let notes = said
        .lines()
        .filter_map(|line| line.strip_prefix("note: no "));
    let columns = notes.filter_map(|note| note.split_once(": "));
    let explained: Vec<&str> = columns.flat_map(|(names, _)| names.split(", ")).collect();
    // Unstable and weightless piles have no margin.
    // Notes do not repeat the unit of a ratio.
    let heads = headers
        .iter()
        .filter_map(|head| head.split("_over_").next());
    let columns = heads.zip(&row);
    for (name, value) in columns.filter(|(name, _)| *name != "margin_squared") {
        assert_eq!(
            explained.contains(&name),
            value.is_empty(),
            "{arguments}: {said}"
        );
    }
    let column = |name: &&str| {
        let place = headers.iter().position(|header| header == *name);
        row[place.expect("a column")].to_owned()
    };
    (names.iter().map(column).collect(), output.status.code())
}

#[test]
fn exit_status_reports_stability() {
    for (arguments, stands, status) in [
        ("--stacking hcp --layers 5", "yes", 0),
        ("--stacking hcp --layers 6", "no", 1),
        ("--stacking dhcp --layers 6", "no", 1),
        // Spheres two layers apart touch.
        ("--stacking hcp --layers 6 --spacing 3/2", "undetermined", 1),
        ("--stacking hcp --layers 5 --spacing 3/2", "yes", 0),
        ("--stacking hcp --layers 6 --spacing 1", "yes", 0),
        ("--stacking hcp --layers 7 --spacing 1", "no", 1),
        ("--top hexagon:9 --layers 40", "yes", 0),
        // There is no verdict on spheres without weight.
        (
            "--stacking hcp --layers 6 --weightless --load 0,0,0=1",
            "",
            0,
        ),
    ] {
        let (row, code) = summary(arguments, &["stands"]);
        assert_eq!(
            (row[0].as_str(), code),
            (stands, Some(status)),
            "{arguments}"
        );
    }
}

#[test]
fn summary_of_one_pile() {
    let names = [
        "layers",
        "stacking",
        "spheres",
        "min_contact",
        "base_spheres",
        "weight",
        "plan",
    ];
    let (row, _) = summary("--stacking hcp --layers 5", &names);
    assert_eq!(row[3..6], ["8/27", "19", "42"]);
    // This load makes the pile unstable.
    let (row, _) = summary("--stacking hcp --layers 5 --load 0,0,0=5/2", &names);
    assert_eq!(row, ["5", "hcp", "42", "-1/6", "19", "89/2", "sweep"]);
    let (row, _) = summary("--base hexagon:3 --stacking=+--", &names);
    assert_eq!(row[..3], ["4", "+--", "41"]);
    let (row, _) = summary("--base triangle:6", &names);
    assert_eq!(row[..3], ["6", "fcc", "56"]);
    let (row, _) = summary("--stacking=-(2,1,1000000000000)", &names);
    assert_eq!(row[..2], ["1000000000004", "-(2,1,1000000000000)"]);
    assert_eq!(row[6], "tree");
}

/// Several notations of one stacking give the same forces.
#[test]
fn notations_agree() {
    let base = stdout("base --stacking=++-+ --format csv");
    for stacking in ["ABCBC", "BCACA", "chh", "(2,1,1)"] {
        assert_eq!(
            stdout(&format!("base --stacking={stacking} --format csv")),
            base
        );
    }
}

#[test]
fn pile_of_1e30_layers_with_two_sign_changes() {
    let csv = stdout("base --stacking (2,1,1000000000000000000000000000000) --at 5,7 --format csv");
    let row = "5,7,1000000000000000000000000000007/3,-499999999999999999999999999990/3,\
               -166666666666666666666666666664";
    assert_eq!(csv.lines().nth(1), Some(row));
}

/// The forces of an unstable pile are printed, with a note.
#[test]
fn unstable_pile_has_a_note() {
    for command in ["base", "contacts", "spheres"] {
        let output = cannonpile(&format!("{command} --stacking hcp --layers 7 --format csv"));
        assert_eq!(output.status.code(), Some(0), "{command}");
        assert!(output.stdout.len() > 500, "{command}");
        let told = String::from_utf8(output.stderr).expect("text");
        assert_eq!(told.lines().count(), 1, "{told}");
        assert!(
            told.contains("unstable") && told.contains("below layer k = 4"),
            "{told}"
        );
    }
}

#[test]
fn census_of_seven_layers() {
    let csv = stdout("census --layers 7 --standing --format csv");
    assert_eq!(
        csv.lines().next(),
        Some(
            "stacking,layers,stands,min_contact,base_spheres,normal_min,normal_max,k,i,j,direction,margin_squared_over_tan2_theta"
        )
    );
    assert_eq!(csv.lines().count(), 1 + 11);
    assert!(csv.lines().skip(1).all(|row| row.contains(",7,yes,")));
    let all = stdout("census --layers 7 --format csv");
    assert!(
        all.lines()
            .any(|row| row.starts_with("+-+-+,6,no,-22/81,27,,,4,1,-2,gamma"))
    );
    let on_base = stdout("census --base triangle:4 --format csv");
    assert!(
        on_base
            .lines()
            .any(|row| row.starts_with("+++,4,yes,1,10,2,2,")),
        "{on_base}"
    );
}

#[test]
fn errors_name_the_option() {
    for (arguments, told) in [
        ("summary --stacking bcc", "--stacking"),
        (
            "summary --stacking ++ --layers 4",
            "--layers: the stacking has 3 layers, not 4",
        ),
        ("summary --base triangle:3 --layers 5", "at most 3"),
        ("summary --base triangle:3 --top triangle:3", "--top"),
        ("summary --top hexagon:0", "--top"),
        ("summary --top region:1..0,0..1,0..1", "no site"),
        ("summary --stacking hcp --dimension 2", "--stacking"),
        ("summary --top triangle:2 --sin-phi 1/3", "--sin-phi"),
        ("base --load 0,0,0", "--load"),
        (
            "base --load 0,0,0=-1",
            "--load: the load of the sphere (i,j,k) = (0,0,0) must not be negative",
        ),
        ("base --load 0,5,0=1", "--load: no sphere"),
        (
            "base --stacking hcp --layers 4 --at 9,9",
            "--at: no sphere at k=3, i=9, j=9: layer 3 has",
        ),
        ("base --stacking hcp --layers 3 --spacing 8/5", "--spacing"),
        ("base --stacking hcp --layers 10000000", "--stacking"),
        ("census --base triangle:3 --layers 5", "--base"),
        ("census --layers 0", "--layers"),
        ("census --base hexagon:40", "--base"),
        (
            "contacts --stacking hcp --at=99,0,0",
            "--at: no layer 99: the layers run from 0",
        ),
    ] {
        let line = refusal(arguments);
        assert!(line.contains(told), "{arguments}: {line}");
    }
}

/// The pile is too large for all its forces, but its first failure near the top decides the verdict.
#[test]
fn verdict_on_a_pile_that_is_too_large() {
    let (row, code) = summary(
        "--stacking hcp --layers 3000 --load 0,0,0=1",
        &["stands", "min_contact", "normal_max", "plan"],
    );
    assert_eq!(
        (row, code),
        (
            vec!["no".into(), String::new(), String::new(), String::new()],
            Some(1)
        )
    );
}

/// For a single layer the note depends only on the printed forces, in every number format.
#[test]
fn tensile_layer_has_a_note() {
    for number in ["exact", "f64", "f32", "interval"] {
        for (layer, pulls) in [(6, true), (2, false)] {
            for units in ["pile", "si"] {
                let arguments = format!(
                    "contacts --stacking hcp --layers 9 --layer {layer} --number {number} --units {units}"
                );
                let output = cannonpile(&arguments);
                let said = String::from_utf8(output.stderr).expect("text");
                assert_eq!(said.contains("needs tension"), pulls, "{arguments}: {said}");
            }
        }
    }
}

/// An overflow in another part of the pile does not matter.
#[test]
fn overflow_elsewhere_is_ignored() {
    let huge = "1000000000000000000000000000000000000";
    for (arguments, row) in [
        (
            format!("base --layers {huge} --at 5,7"),
            "5,7,3.3333332e35,-1.6666666e35,-1.6666666e35",
        ),
        (
            format!("contacts --layers {huge} --layer 0"),
            "0,0,0,alpha,1.0",
        ),
        (
            format!("spheres --layers {huge} --at 0,0,0 --spacing 1 --radius 1e-36"),
            "1,0,0,0,0.0,0.0,1.6329932,1e-36,1.0,0",
        ),
        (
            "spheres --layers 2 --load 0,0,0=1e39 --at 1,0,0".to_owned(),
            "2,1,0,0,-0.6928203,-1.2,0.0,1.0,1.0,1",
        ),
    ] {
        let csv = stdout(&format!("{arguments} --number f32 --format csv"));
        assert_eq!(csv.lines().nth(1), Some(row), "{arguments}");
    }
    // An overflow in the first row leaves stdout empty.
    refusal("base --layers 4 --at 1,1 --units si --mass 1e39 --number f32 --format csv");
    refusal("contacts --layers 4 --units si --mass 1e39 --number f32 --format csv");
}
