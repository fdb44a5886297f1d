//! The command `explain`, and the options `--method` and `--number interval`.

use super::{refusal, stdout};

/// Returns the value after a name, in a table of names and values.
fn value<'t>(table: &'t str, name: &str) -> &'t str {
    let line = table
        .lines()
        .find(|line| line.split_whitespace().next() == Some(name));
    let line = line.unwrap_or_else(|| panic!("no {name} in {table}"));
    line[name.len()..].trim()
}

#[test]
fn counters_are_below_the_plan() {
    let table = stdout("explain --layers 10");
    assert_eq!(value(&table, "method"), "closed");
    for (name, count) in [("visited", "165"), ("rows", "495")] {
        assert_eq!(value(&table, name), count);
        assert_eq!(value(&table, &format!("counted_{name}")), count);
    }
    let table = stdout("explain --stacking hcp --layers 30 --of base --units si");
    assert_eq!(value(&table, "method"), "sweep");
    assert_eq!(value(&table, "bytes"), "16200");
    assert_ne!(value(&table, "counted_turned"), "0");
}

#[test]
fn csv_and_json_have_one_row() {
    let csv = stdout("explain --stacking hcp --layers 12 --at 5,1,1 --format csv");
    let [head, row] = [0, 1].map(|n| csv.lines().nth(n).unwrap());
    assert!(head.starts_with("method,visited,of,reason,rows,bits,bytes,roots,pivots,"));
    assert!(head.ends_with("counted_passes,counted_rows"));
    assert_eq!(head.split(',').count(), row.split(',').count());
    assert!(row.starts_with("tree,"));
    let json = stdout("explain --layers 4 --of spheres --format json");
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json[0]["counted_rows"], 20);
    assert_eq!(json[0]["roots"], 3);
}

#[test]
fn no_run_plans_a_pile_of_any_size() {
    let huge = "1000000000000000000000000";
    let table = stdout(&format!("explain --layers {huge} --no-run"));
    assert!(value(&table, "rows").len() > 70);
    assert!(!table.contains("counted"));
    let refused = refusal(&format!("explain --layers {huge}"));
    assert!(refused.contains("the plan only"), "{refused}");
}

#[test]
fn methods_agree() {
    for scene in ["--layers 7", "--stacking ++-++ --top hexagon:2"] {
        for command in ["contacts", "base"] {
            let cheapest = stdout(&format!("{command} {scene} --format csv"));
            for method in ["tree", "sweep"] {
                let other = stdout(&format!("{command} {scene} --method {method} --format csv"));
                assert_eq!(other, cheapest, "{command} {scene} {method}");
            }
        }
    }
    let refused = refusal("contacts --stacking hcp --method closed");
    assert!(refused.starts_with("error: --method: "), "{refused}");
    assert!(refusal("base --dimension 2 --method sweep").contains("discs"));
}

#[test]
fn intervals_have_two_columns() {
    let csv = stdout("base --layers 3 --units si --number interval --format csv");
    let head = "i,j,normal_lo,normal_hi,shear_x_lo,shear_x_hi,shear_y_lo,shear_y_hi";
    assert_eq!(csv.lines().next(), Some(head));
    for line in csv.lines().skip(1) {
        let numbers: Vec<f64> = line.split(',').map(|text| text.parse().unwrap()).collect();
        for ends in numbers[2..].chunks(2) {
            // The bounds are equal if the value is a float, such as 0. Otherwise they are neighbours, as for 5/3 N.
            assert!([ends[0], ends[0].next_up()].contains(&ends[1]), "{line}");
        }
        let normal = [1.666_666_666_666_666_5, 1.666_666_666_666_666_7];
        assert_eq!(numbers[2..4], normal);
    }
    let json = stdout("contacts --layers 2 --number interval --format json");
    assert!(json.contains(r#""force_lo":1.0,"force_hi":1.0}"#), "{json}");
    let table = stdout("summary --layers 4 --units si --number interval");
    assert_eq!(value(&table, "min_contact_lo"), "0.4622501635210242 N");
    let table = stdout("base --layers 3 --number interval");
    assert_eq!(table.lines().last(), Some("6 bottom spheres"));
}
