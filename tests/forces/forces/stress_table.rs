//! At the limits of floats, the errors of each scalar equal the table in `tests/forces/limits/table.md` and respect
//! their bounds.

use std::fs;

use cannonpile::scalar::Interval;

use cannonpile_testkit::judge::exact;

use crate::limits::cases::{self, Case};
use crate::limits::errors::{Worst, unit};
use crate::limits::table::{self, Answers};

fn rows(case: &Case) -> Result<String, String> {
    table::rows(case, &Answers::of(&case.pile))
}

#[test]
fn errors_at_the_limits_match_the_table() {
    let cases: Vec<Case> = cases::all();
    let rows = cases.iter().map(rows).collect::<Result<String, _>>();
    let measured = table::HEAD.to_owned() + &rows.unwrap_or_else(|fault| panic!("{fault}"));
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/forces/limits/table.md");
    if std::env::var_os("STRESS_TABLE_RENEW").is_some() {
        fs::write(path, &measured).expect("the table is written");
    }
    let table = fs::read_to_string(path).expect("the table");
    for (measured, written) in measured.lines().zip(table.lines()) {
        assert_eq!(
            measured, written,
            "if the new errors are right, renew the table: STRESS_TABLE_RENEW=1 cargo test --release --test forces stress_table"
        );
    }
    assert_eq!(measured.lines().count(), table.lines().count());
}

/// Of a pile with a thousand sign changes this test measures only floats, unless the tables are renewed, because other
/// scalars take minutes. Without optimisation even the exact forces are slow.
#[cfg(not(debug_assertions))]
#[test]
fn errors_after_many_changes_of_sign_are_those_of_the_table() {
    use crate::limits::deep::Deep;

    let [in_floats, in_all] = Deep::LAYERS;
    let deep = if std::env::var_os("STRESS_TABLE_RENEW").is_some() {
        Deep::measured(in_floats)
    } else {
        Deep::in_floats(in_floats)
    };
    // The title of a table and its rows.
    let parts: Vec<&str> = include_str!("../limits/deep.md").split("\n\n").collect();
    for (measured, layers) in [(deep, in_floats), (Deep::measured(in_all), in_all)] {
        let mut tables = parts.chunks(2);
        let written = tables.find(|table| table[0].starts_with(&format!("{layers} layers ")));
        let written = written
            .expect("a table for this number of layers")
            .join("\n\n");
        for line in measured.to_string().lines() {
            assert!(
                written.contains(line),
                "not in tests/forces/limits/deep.md: {line}"
            );
        }
    }
}

/// Single precision presented as double, and intervals that are one float too short.
#[test]
fn wrong_answers_break_the_table() {
    for case in [cases::alternating(2, 6), cases::tall().swap_remove(2)] {
        let right = Answers::of(&case.pile);
        assert!(table::rows(&case, &right).is_ok());
        let single = right.f32.clone().map(|forces| forces.map(f64::from));
        let disguised = Answers {
            f64: single,
            ..right.clone()
        };
        let fault = table::rows(&case, &disguised).expect_err("far off");
        assert!(fault.contains("out of bounds"), "{fault}");
        let lower_end = |interval: Interval| Interval::point(interval.lower().next_down());
        let short = Answers {
            interval: right.interval.clone().map(|forces| forces.map(lower_end)),
            ..right
        };
        let fault = table::rows(&case, &short).expect_err("too short");
        assert!(fault.contains("does not contain"), "{fault}");
    }
}

#[test]
fn units_in_the_last_place() {
    let of = |x: f64| unit::<f64>(&exact(x));
    for (x, next) in [(1.0, 1.0_f64.next_up()), (7.5, 7.5_f64.next_up())] {
        assert_eq!(of(x), exact(next) - exact(x));
    }
    assert_eq!(
        of(1.0_f64.next_down()),
        exact(1.0) - exact(1.0_f64.next_down())
    );
    for subnormal in [0.0, 5e-324, 1e-310, f64::MIN_POSITIVE] {
        assert_eq!(of(subnormal), exact(5e-324));
    }
    assert_eq!(unit::<f32>(&exact(1.0)), exact(f32::EPSILON));
}

#[test]
fn errors_are_printed_to_a_hundredth_or_as_a_power() {
    let printed = |x: f64| {
        let mut worst = Worst::none();
        worst.add(Some(exact(0.0)));
        worst.add(Some(exact(x)));
        worst.add(Some(exact(x / 2.0)));
        (worst.to_string(), worst.as_power())
    };
    assert_eq!(printed(0.0), ("0.00".into(), "0".into()));
    assert_eq!(printed(0.375), ("0.38".into(), "2^-1".into()));
    assert_eq!(printed(8.0), ("8.00".into(), "2^3".into()));
    assert_eq!(printed(70_000.0), ("2^17".into(), "2^17".into()));
    let mut worst = Worst::none();
    worst.add(None);
    worst.add(Some(exact(1.0)));
    assert_eq!(worst.to_string(), "unbounded");
}
