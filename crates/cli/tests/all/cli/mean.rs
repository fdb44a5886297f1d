//! The command `mean`, compared with an enumeration of all stackings.

use cannonpile::lattice::Region;
use cannonpile_dem::scene::parse;
use cannonpile_disorder::FirstSign;
use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::cannonpile;
use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::disorder::{Anchor, Means, Piles, Place, alike};

/// Returns piles with the options that describe them.
fn described() -> Vec<(Piles, &'static str)> {
    let hexagon = Region::hexagon(2, 2).unwrap();
    let mut two = Piles::response(3, FirstSign::Minus);
    two.loads.push(([1, -1], ratio(3, 2)));
    let mut loaded = Piles::heavy(Anchor::Top(hexagon), 3, FirstSign::Random);
    loaded.loads.push(([0, 1], ratio(5, 2)));
    vec![
        (
            Piles::response(4, FirstSign::Plus),
            "--top plane --weightless --load 0,0,0=1 --layers 5",
        ),
        (
            two,
            "--top plane --weightless --load 0,0,0=1 --load 0,1,-1=3/2 --layers 4 --first=-",
        ),
        (
            Piles::heavy(Anchor::Top(Region::SITE), 6, FirstSign::Plus),
            "--layers 7",
        ),
        (
            loaded,
            "--top hexagon:2 --layers 4 --first random --load 0,0,1=5/2",
        ),
        (
            Piles::heavy(
                Anchor::Base(Region::hexagon(3, 3).unwrap()),
                3,
                FirstSign::Random,
            ),
            "--base hexagon:3 --layers 4 --first random",
        ),
    ]
}

/// Returns the output of a successful command, and ignores the note on stderr.
fn stdout(arguments: &str) -> String {
    let output = cannonpile(arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments}: {output:?}");
    String::from_utf8(output.stdout).expect("text")
}

/// Returns the rows of a csv text, after checking its header.
fn rows(csv: &str, headers: &str) -> Vec<Vec<String>> {
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some(headers));
    let cells = |line: &str| line.split(',').map(str::to_owned).collect();
    lines.map(cells).collect()
}

const HEADERS: &str = "a,b,probability,normal,shear_x,shear_y";

fn place(row: &[String]) -> Place {
    [0, 1].map(|n| row[n].parse().expect("a place"))
}

fn number(text: &str) -> BigRational {
    parse::rational(text).expect("a number")
}

fn means(csv: &str) -> Means {
    let rows = rows(csv, HEADERS).into_iter();
    let numbers = |row: &[String]| [2, 3, 4, 5].map(|n| number(&row[n]));
    rows.map(|row| (place(&row), numbers(&row))).collect()
}

#[test]
fn means_over_all_stackings() {
    for (described, options) in described() {
        let sums = described.sums();
        for q in ["0", "1/3", "1/2", "1"] {
            let expected = described.means(&sums, &number(q));
            let command = format!("mean {options} --fault-probability {q} --format csv");
            alike(&command, &expected, &means(&stdout(&command))).unwrap();
            let given = means(&stdout(&format!("{command} --given sphere")));
            let of_given = expected.iter().filter(|(_, [p, ..])| *p != ratio(0, 1));
            let divided = of_given
                .map(|(place, [p, normal, x, y])| (*place, [p.clone(), normal / p, x / p, y / p]));
            alike("given", &divided.collect(), &given).unwrap();
            for row in rows(&stdout(&format!("{command} --number f64")), HEADERS) {
                let exact = &expected[&place(&row)];
                for (float, exact) in row[2..].iter().zip(exact) {
                    let float: f64 = float.parse().expect("a float");
                    assert!((float - exact.to_f64().unwrap()).abs() < 1e-13, "{command}");
                }
            }
        }
        // The default is q = 1/2: all stackings are equally likely.
        let half = stdout(&format!("mean {options} --format csv"));
        alike(
            options,
            &described.means(&sums, &ratio(1, 2)),
            &means(&half),
        )
        .unwrap();
    }
}

#[test]
fn sums_by_faults() {
    for (described, options) in described() {
        let csv = stdout(&format!("mean {options} --by faults --format csv"));
        let found = rows(&csv, "a,b,faults,stackings,normal")
            .into_iter()
            .map(|row| {
                let key = (place(&row), row[2].parse::<usize>().expect("faults"));
                (key, (row[3].parse().expect("a count"), number(&row[4])))
            });
        let expected = described
            .sums()
            .into_iter()
            .map(|(key, (count, [normal, _, _]))| (key, (count, normal)));
        alike(options, &expected.collect(), &found.collect()).unwrap();
    }
}

/// Evaluates a printed polynomial such as `(2 q^3 - 4 q^2)/81`, `-q/3` or `5` at q.
fn value(text: &str, q: &BigRational) -> BigRational {
    let (terms, denominator) = match text.rsplit_once('/') {
        Some((terms, denominator)) => (terms, number(denominator)),
        None => (text, ratio(1, 1)),
    };
    let terms = terms.trim_start_matches('(').trim_end_matches(')');
    let mut sum = ratio(0, 1);
    let spaced = terms.replace(" + ", "|+").replace(" - ", "|-");
    for term in spaced.split('|') {
        let (minus, term) = match term.strip_prefix('-') {
            Some(rest) => (true, rest),
            None => (false, term.trim_start_matches('+')),
        };
        let mut product = if minus { ratio(-1, 1) } else { ratio(1, 1) };
        for factor in term.split(' ') {
            product *= match factor.strip_prefix('q') {
                None => number(factor),
                Some("") => q.clone(),
                Some(power) => {
                    let power: usize = power.trim_start_matches('^').parse().expect("a power");
                    num_traits::pow(q.clone(), power)
                }
            };
        }
        sum += product;
    }
    sum / denominator
}

#[test]
fn polynomials_equal_means_over_all_stackings() {
    assert_eq!(
        value("(-2 q^3 - 4 q^2 + 6 q)/27", &ratio(1, 2)),
        ratio(7, 108)
    );
    assert_eq!(value("-q/3", &ratio(1, 2)), ratio(-1, 6));
    for (described, options) in described() {
        let sums = described.sums();
        let csv = stdout(&format!("mean {options} --symbolic --format csv"));
        for q in [ratio(1, 3), ratio(4, 5)] {
            let printed = rows(&csv, HEADERS).into_iter();
            let values = |row: &[String]| [2, 3, 4, 5].map(|n| value(&row[n], &q));
            let found: Means = printed.map(|row| (place(&row), values(&row))).collect();
            alike(options, &described.means(&sums, &q), &found).unwrap();
        }
    }
}

/// A note explains negative normal forces in every format, and only these. The help explains every column.
#[test]
fn note_and_help_define_the_mean() {
    let point = "--top plane --weightless --load 0,0,0=1 --layers 5";
    for options in [
        "--fault-probability 1",
        "--symbolic",
        "--by faults",
        "--fault-probability 1 --given sphere --format json",
    ] {
        let output = cannonpile(&format!("mean --layers 3 {options}"));
        assert_eq!(output.status.code(), Some(0));
        assert!(output.stderr.is_empty());
        let output = cannonpile(&format!("mean {point} {options}"));
        assert_eq!(output.status.code(), Some(0));
        let told = String::from_utf8(output.stderr).expect("text");
        assert_eq!(told.lines().count(), 1, "{told}");
        assert!(
            told.contains("all stackings") && told.contains("prestressed"),
            "{told}"
        );
    }
    let help = stdout("mean --help");
    let columns = HEADERS.split(',').chain(["faults", "stackings"]);
    for word in columns.chain([
        "prestressed",
        "given sphere",
        "counts as 0",
        "mg",
        "a + b modulo 3",
    ]) {
        assert!(help.contains(word), "help does not say {word}");
    }
    for (options, footer) in [
        (
            "",
            "13 means over all stackings, where an empty position counts as 0",
        ),
        (
            "--given sphere",
            "13 means over the stackings with a sphere at the position",
        ),
        (
            "--by faults",
            "13 sums over the stackings with this number of faults",
        ),
    ] {
        let table = stdout(&format!("mean --layers 3 {options}"));
        assert_eq!(table.lines().last(), Some(footer));
    }
}

/// A missing row and a small error in a number are differences.
#[test]
fn comparison_detects_wrong_means() {
    let (described, options) = described().swap_remove(0);
    let expected = described.means(&described.sums(), &ratio(1, 2));
    let right = means(&stdout(&format!("mean {options} --format csv")));
    let mut short = right.clone();
    short.pop_first();
    assert!(alike(options, &expected, &short).is_err());
    let mut off = right;
    off.last_entry().unwrap().get_mut()[1] += ratio(1, 1_000_000);
    assert!(alike(options, &expected, &off).is_err());
}
