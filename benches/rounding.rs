//! Checks the correct rounding of ten million random and adversarial values of each quantity.
//!
//! `cargo bench --manifest-path benches/Cargo.toml --bench rounding --features all`
//! rounds roots, rationals and every physical quantity of all kinds of piles to `f64` and `f32`. It checks each float in
//! integers, by the squares of the midpoints to its neighbours, and asserts that no float is wrong. It prints the number of
//! values, the number of wrong roundings, and nanoseconds for each value. Most of this time generates and checks the value.
//! With `-- --smoke` it checks some hundred values. With a name, or a part of it, it checks this quantity only.

use std::env;
use std::time::Instant;

use cannonpile_testkit::rounding::numbers;
use cannonpile_testkit::rounding::quantities::Quantity;
use cannonpile_testkit::rounding::random::Random;
use cannonpile_testkit::rounding::tally::Tally;

fn main() {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let smoke = arguments.iter().any(|argument| argument == "--smoke");
    let cases = if smoke { 500 } else { 10_000_000 };
    let named: Vec<&String> = arguments.iter().filter(|a| !a.starts_with('-')).collect();
    let wanted = |name: &str| named.is_empty() || named.iter().any(|part| name.contains(*part));

    println!("quantity                        cases  wrong  ns a case");
    for (name, tally) in [
        ("random roots", numbers::random_roots as Source),
        ("critical roots", numbers::critical_roots),
        ("rationals", numbers::rationals),
    ] {
        if wanted(name) {
            report(name, |random| tally(random, cases));
        }
    }
    for quantity in Quantity::ALL {
        if wanted(quantity.name()) {
            report(quantity.name(), |random| quantity.tally(random, cases));
        }
    }
}

type Source = fn(&mut Random, u64) -> Tally;

fn report(name: &str, tally: impl FnOnce(&mut Random) -> Tally) {
    let start = Instant::now();
    // This seed differs from that of the tests.
    let Tally {
        cases,
        wrong,
        witness,
    } = tally(&mut Random::new(1611));
    #[expect(clippy::cast_precision_loss, reason = "a few digits are printed")]
    let each = start.elapsed().as_secs_f64() * 1e9 / cases as f64;
    println!("{name:26} {cases:10} {wrong:6} {each:10.0}");
    assert_eq!(wrong, 0, "{witness:?}");
}
