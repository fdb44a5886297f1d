//! The commands `ensemble` and `merge`: parts, merged records, invalid parts.

use num_rational::BigRational;
use num_traits::Signed;
use serde_json::Value;

use super::{Folder, cannonpile, command, output, stdout};

impl Folder {
    /// Writes a part of an ensemble.
    fn part(&self, scene: &str, shard: &str, name: &str) {
        let said = self.stdout(&format!("ensemble {scene} --shard {shard} --output {name}"));
        assert_eq!(said, "");
    }
}

const SCENES: [&str; 6] = [
    "--top hexagon:3 --layers 8 --all",
    "--layers 9 --all --first random --load 0,0,0=2/3 --fault-probability 1/5",
    "--top triangle:2 --layers 9 --samples 5000 --seed 3 --fault-probability 1/3 --first random --bins 1/7",
    "--layers 8 --all --spacing 1",
    "--base hexagon:4 --layers 6 --all --first random --spacing 1",
    "--base hexagon:3,4 --layers 5 --samples 500 --seed 2 --fault-probability 2/5",
];

#[test]
fn merged_parts_equal_the_whole_in_any_order() {
    for scene in SCENES {
        let folder = Folder::new();
        let parts = ["1.json", "2.json", "3.json"];
        for (i, part) in (1..).zip(parts) {
            folder.part(scene, &format!("{i}/3"), part);
        }
        let whole = stdout(&format!("ensemble {scene} --format json"));
        for [a, b, c] in [
            [0, 1, 2],
            [0, 2, 1],
            [1, 0, 2],
            [1, 2, 0],
            [2, 0, 1],
            [2, 1, 0],
        ] {
            let merged = folder.stdout(&format!("merge {} {} {}", parts[a], parts[b], parts[c]));
            assert!(merged == whole, "{scene}: {a} {b} {c}");
        }
        // Merging a merged record again does not change it.
        let said = folder.stdout("merge 1.json 2.json 3.json --output whole.json");
        assert_eq!(said, "");
        assert_eq!(folder.stdout("merge whole.json"), whole);
    }
}

#[test]
fn result_does_not_depend_on_thread_count() {
    // Samples are drawn 8192 at a time.
    for scene in [
        "--layers 12 --all",
        "--layers 30 --samples 9000",
        "--base hexagon:5 --layers 8 --all",
    ] {
        let arguments = format!("ensemble {scene} --format json");
        let of_threads = |number: &str| {
            let mut command = command();
            command.args(arguments.split_whitespace());
            output(command.env("RAYON_NUM_THREADS", number)).stdout
        };
        // Also on a machine with one core there are several threads.
        let expected = stdout(&arguments).into_bytes();
        for number in ["1", "3"] {
            assert!(of_threads(number) == expected, "{scene}: {number}");
        }
    }
}

/// The commands for one stacking on a base give the forces of each stacking of the ensemble.
#[test]
fn ensemble_on_a_base_covers_its_piles() {
    const BASE: &str = "--base hexagon:3,4 --layers 5";
    let numbers = |command: &str, column: usize, stacking: &str| -> Option<Vec<BigRational>> {
        let arguments = format!("{command} {BASE} --stacking={stacking} --format csv");
        let output = cannonpile(&arguments);
        let said = String::from_utf8_lossy(&output.stderr);
        if output.status.code() == Some(2) {
            assert!(
                said.contains("with this stacking it carries at most"),
                "{said}"
            );
            return None;
        }
        let csv = String::from_utf8(output.stdout).expect("text");
        let rows = csv.lines().skip(1);
        let cells = rows.map(|row| row.split(',').nth(column).expect("a force").to_owned());
        Some(cells.map(|cell| cell.parse().expect("a number")).collect())
    };
    // The first sign below the top layer is the last one from the base up.
    let stackings = (0..8_u32).map(|bits| {
        let sign = |bit: u32| if bits >> bit & 1 == 0 { '+' } else { '-' };
        format!("{}{}{}+", sign(0), sign(1), sign(2))
    });
    let mut left_out = [0_u32; 4];
    let mut piles: [Vec<[Vec<BigRational>; 2]>; 4] = Default::default();
    for stacking in stackings {
        let faults = stacking.as_bytes().windows(2);
        let faults = faults.filter(|pair| pair[0] != pair[1]).count();
        let forces = numbers("contacts", 4, &stacking).zip(numbers("base", 2, &stacking));
        match forces {
            Some((contacts, normals)) => piles[faults].push([contacts, normals]),
            None => left_out[faults] += 1,
        }
    }
    let csv = stdout(&format!("ensemble {BASE} --all --format csv"));
    for (faults, row) in csv.lines().skip(1).enumerate() {
        let piles = &piles[faults];
        let stable = |pile: &&[Vec<BigRational>; 2]| pile[0].iter().all(|f| !f.is_negative());
        let end = |of: usize, least: bool| {
            let forces = piles.iter().flat_map(|pile| &pile[of]);
            let end = if least { forces.min() } else { forces.max() };
            end.map_or_else(String::new, BigRational::to_string)
        };
        let expected = [
            faults.to_string(),
            piles.len().to_string(),
            left_out[faults].to_string(),
            piles.iter().filter(stable).count().to_string(),
            end(0, true),
            end(0, false),
            end(1, true),
            end(1, false),
        ];
        let found: Vec<&str> = row.split(',').collect();
        assert_eq!(found[..8], expected, "{row}");
        if !piles.is_empty() {
            let stacking = found[12];
            let contacts = numbers("contacts", 4, stacking).expect("a pile");
            let least = contacts.into_iter().min().expect("a contact");
            assert_eq!(least.to_string(), found[4], "{row}");
        }
    }
}

#[test]
fn distribution_on_a_base_names_the_base() {
    let folder = Folder::new();
    let scene = "--base hexagon:4 --layers 4 --all";
    folder.part(scene, "1/1", "whole.json");
    let svg = folder.stdout("plot distribution whole.json");
    assert!(svg.contains("4 layers, base hexagon:4, "), "{svg}");
    folder.part("--base triangle:3 --layers 3 --all", "1/1", "none.json");
    let said = folder.refusal("plot distribution none.json --fault-probability 1");
    assert!(
        said.contains("none.json has no stackings at this fault probability"),
        "{said}"
    );
}

fn record(arguments: &str) -> Value {
    serde_json::from_str(&stdout(&format!("ensemble {arguments} --format json"))).expect("json")
}

#[test]
fn probabilities_are_exact_or_intervals() {
    let all = record("--layers 8 --all --first random --spacing 1");
    for (key, expected) in [
        ("cannonpile", env!("CARGO_PKG_VERSION")),
        ("shard", "1/1"),
        ("standing_probability", "11/64"),
        ("held_probability", "3/16"),
    ] {
        assert_eq!(all[key], expected, "{key}");
    }
    for (key, expected) in [("stackings", 128), ("standing", 22), ("held", 24)] {
        assert_eq!(all[key], expected, "{key}");
    }
    assert_eq!(all["ensemble"]["horizontal_contacts"], true);
    assert!(all.get("standing_interval").is_none() && all.get("held_interval").is_none());
    // Only FCC for q = 0, only HCP for q = 1.
    for (q, expected) in [("0", "1"), ("1", "0")] {
        let all = record(&format!("--layers 8 --all --fault-probability {q}"));
        assert_eq!(all["standing_probability"], expected);
    }
    let drawn = record("--layers 8 --samples 2000 --seed 5");
    assert!(drawn.get("standing_probability").is_none() && drawn.get("held").is_none());
    assert_eq!(drawn["choice"]["drawn"]["samples"], 2000);
    let bounds = drawn["standing_interval"].as_array().expect("two floats");
    let [lower, upper] = [0, 1].map(|n| bounds[n].as_f64().expect("a float"));
    assert!(lower < 0.171_875 && 0.171_875 < upper, "{lower} {upper}");
    // A part has no probability.
    let part = record("--layers 8 --all --shard 1/2");
    assert!(part.get("standing_probability").is_none());
    // A histogram counts every contact once.
    for with in all["faults"].as_array().expect("rows") {
        let counts = with["all"]["forces"]["counts"].as_array().expect("counts");
        let counts = counts.iter().map(|n| n.as_u64().expect("a count"));
        assert_eq!(counts.sum::<u64>(), with["all"]["contacts"]);
    }
}

#[test]
fn merge_rejects_parts_of_other_ensembles() {
    let folder = Folder::new();
    let scene = "--layers 6 --samples 90 --seed 7";
    folder.part(scene, "1/3", "first.json");
    folder.part(scene, "3/3", "third.json");
    for (other, what) in [
        (
            "--layers 7 --samples 90 --seed 7",
            "the number of layers is 7, but 6 in the first part",
        ),
        (
            "--layers 6 --samples 90 --seed 8",
            "the seed is 8, but 7 in the first part",
        ),
        (
            "--layers 6 --samples 91 --seed 7",
            "the number of samples is ",
        ),
        (
            "--layers 6 --all",
            "the number of samples is none, but 90 in the first part",
        ),
        (
            "--layers 6 --samples 90 --seed 7 --fault-probability 1/3",
            "the fault probability is ",
        ),
        (
            "--layers 6 --samples 90 --seed 7 --bins 1/4",
            "the width of bins is ",
        ),
        (
            "--layers 6 --samples 90 --seed 7 --top hexagon:2",
            "the top is ",
        ),
        (
            "--layers 6 --samples 90 --seed 7 --base hexagon:5",
            "the top is none, but hexagon:1 in the first part",
        ),
        (
            "--layers 6 --samples 90 --seed 7 --first random",
            "the first sign is ",
        ),
        (
            "--layers 6 --samples 90 --seed 7 --spacing 1",
            "the spacing is ",
        ),
        (
            "--layers 6 --samples 90 --seed 7 --load 0,0,0=1",
            "the load is ",
        ),
    ] {
        folder.part(other, "2/3", "other.json");
        let said = folder.refusal("merge first.json other.json third.json");
        assert!(
            said.contains(what) && said.contains("other.json: "),
            "{said}"
        );
    }
    // With --all the counts do not depend on the fault probability, but the records differ.
    folder.part("--layers 6 --all", "1/2", "all.json");
    folder.part(
        "--layers 6 --all --fault-probability 1/3",
        "2/2",
        "other.json",
    );
    let said = folder.refusal("merge all.json other.json");
    assert!(said.contains("the fault probability is "), "{said}");
}

#[test]
fn merge_rejects_modified_parts() {
    let folder = Folder::new();
    let scene = "--layers 6 --samples 90 --seed 7";
    for i in 1..=3 {
        folder.part(scene, &format!("{i}/3"), &format!("part{i}.json"));
    }
    let text = folder.read("part2.json");
    let changed = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        folder.write("changed.json", text.replacen(from, to, 1));
        folder.refusal("merge part1.json changed.json part3.json")
    };
    let version = env!("CARGO_PKG_VERSION");
    for (from, to) in [
        (version, "0.0.1"),
        (r#""stackings": "#, r#""stackings": 1"#),
        (r#""standing": "#, r#""standing": 1"#),
        (r#""sum_of_squares":""#, r#""sum_of_squares":"-"#),
        (r#""sha256""#, r#""sha""#),
        (r#""shard": "2/3""#, r#""shard": "5/3""#),
        (r#""contacts":"#, r#""contacts":1"#),
        (r#""faults":0"#, r#""faults":1"#),
        (r#""stacking":""#, r#""stacking":"+"#),
        (r#""first":"#, r#""second":"#),
        ("\"\n}", "\""),
    ] {
        let said = changed(from, to);
        assert!(
            said.contains("changed.json is not part of an ensemble: "),
            "{from}: {said}"
        );
    }

    let said = folder.refusal("merge part3.json part1.json");
    assert!(said.contains("1 part is missing, 2/3: "), "{said}");
    let said = folder.refusal("merge part1.json part2.json part1.json part3.json");
    assert!(said.contains("part1.json: part 1/3 occurs twice"), "{said}");
    let said = folder.refusal("merge part1.json nothing.json");
    assert!(
        said.contains("nothing.json cannot be read: no such file"),
        "{said}"
    );
    // A failed merge writes no file.
    folder.refusal("merge part1.json part3.json --output none.json");
    assert!(!folder.path("none.json").exists());
    let merged = folder.cannonpile("merge part1.json part2.json part3.json");
    assert_eq!(merged.status.code(), Some(0));
}
