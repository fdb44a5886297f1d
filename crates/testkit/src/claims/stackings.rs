//! Every parsed stacking follows the rules of its notation. It is printed and read again in all four notations.
//!
//! The oracle reads each notation by its own rule into runs of booleans and big integers. Its only limit is the number of
//! layers.

use arbitrary::Unstructured;
use cannonpile::Error;
use cannonpile::lattice::{MAX_LAYERS, Sign};
use cannonpile::stacking::{Notation, Run, Stacking};
use num_bigint::{BigInt, BigUint, ToBigUint};
use num_traits::{One, Zero};

use super::{Checked, Failure, demand, one_line, same};
use crate::generators::stacking;

/// Beyond this number of layers, only runs are printed.
const SPELLED_OUT: i128 = 5_000;

/// Any text is read or rejected as the rules require.
pub fn any_text(u: &mut Unstructured<'_>) -> Checked {
    let text = stacking::text(u)?;
    as_the_rules_say(&text, &text.parse())?;
    match text.parse::<Stacking>() {
        Ok(stacking) => printed_again(&stacking, str::parse),
        Err(refusal) => one_line(&refusal),
    }
}

/// A list of runs makes a stacking if no run is negative and the total is within the limit.
pub fn of_runs(u: &mut Unstructured<'_>) -> Checked {
    let runs = stacking::runs(u)?;
    let made = Stacking::from_runs(runs.iter().copied());
    joined_as_listed(&runs, &made)?;
    let Ok(stacking) = made else {
        return Ok(());
    };
    let listed: Vec<Run> = stacking.runs().collect();
    let mut turned = listed.clone();
    turned.reverse();
    let reversed: Vec<Run> = stacking.reversed().runs().collect();
    same("the reversed stacking", &reversed, &turned)?;
    let mut opposite = listed;
    for run in &mut opposite {
        run.sign = -run.sign;
    }
    let mirrored: Vec<Run> = stacking.mirrored().runs().collect();
    same("the mirrored stacking", &mirrored, &opposite)?;
    printed_again(&stacking, str::parse)
}

/// The oracle's form of runs: + is `true`, neighbours have opposite signs, and no run is empty.
type Runs = Vec<(bool, BigUint)>;

/// Appends steps of one sign.
fn push(runs: &mut Runs, plus: bool, steps: BigUint) {
    if steps.is_zero() {
        return;
    }
    match runs.last_mut() {
        Some((sign, length)) if *sign == plus => *length += steps,
        _ => runs.push((plus, steps)),
    }
}

fn fits(runs: &Runs) -> bool {
    let steps = runs.iter().fold(BigUint::zero(), |sum, run| sum + &run.1);
    BigInt::from(steps) < BigInt::from(MAX_LAYERS)
}

/// The runs of a text by the rule of its notation. `None` if it breaks the rule.
fn read(text: &str) -> Option<Runs> {
    let made_of = |letters: &str| !text.is_empty() && text.chars().all(|c| letters.contains(c));
    let mut runs = Runs::new();
    if made_of("+-") {
        text.chars()
            .for_each(|c| push(&mut runs, c == '+', BigUint::one()));
    } else if made_of("ABC") {
        for pair in text.as_bytes().windows(2) {
            let up = [b"AB", b"BC", b"CA"].iter().any(|up| *up == pair);
            let down = [b"BA", b"CB", b"AC"].iter().any(|down| *down == pair);
            (up || down).then(|| push(&mut runs, up, BigUint::one()))?;
        }
    } else if made_of("hc") {
        let mut plus = true;
        push(&mut runs, plus, BigUint::one());
        for letter in text.chars() {
            plus ^= letter == 'h';
            push(&mut runs, plus, BigUint::one());
        }
    } else {
        // A − before the lengths is the first sign.
        let minus = text.starts_with('-');
        let lengths = text.strip_prefix('-').unwrap_or(text);
        let inside = lengths.strip_prefix('(')?.strip_suffix(')')?;
        let lengths = inside.split(',').filter(|_| !inside.is_empty());
        for (n, length) in lengths.enumerate() {
            let digits = !length.is_empty() && length.bytes().all(|byte| byte.is_ascii_digit());
            let steps: BigUint = digits.then(|| length.parse().ok())??;
            (!steps.is_zero()).then(|| push(&mut runs, (n % 2 == 0) != minus, steps))?;
        }
    }
    Some(runs)
}

/// The runs of a stacking in the oracle's form.
fn runs_of(stacking: &Stacking) -> Option<Runs> {
    let run = |run: Run| Some((run.sign == Sign::Plus, run.steps.to_biguint()?));
    stacking.runs().map(run).collect()
}

fn as_the_rules_say(text: &str, parsed: &Result<Stacking, Error>) -> Checked {
    let want = read(text).filter(fits);
    let got = parsed.as_ref().ok().map(runs_of);
    demand(got == want.clone().map(Some), || {
        format!("'{text}' is read as {parsed:?}, not {want:?}")
    })
}

fn joined_as_listed(listed: &[Run], made: &Result<Stacking, Error>) -> Checked {
    let mut want = Runs::new();
    for run in listed {
        // The runs up to here may already be too long in total, so either error is correct.
        let Some(steps) = run.steps.to_biguint() else {
            return demand(made.is_err(), || format!("{listed:?} are read as {made:?}"));
        };
        push(&mut want, run.sign == Sign::Plus, steps);
    }
    let want = fits(&want).then_some(want);
    match made {
        Ok(stacking) => {
            same("the stacking", &runs_of(stacking), &want)?;
            let steps = listed.iter().map(|run| run.steps).sum::<i128>();
            same("the layers", &stacking.layers(), &(steps + 1))?;
            let changes = want.map_or(0, |runs| runs.len().saturating_sub(1));
            same("the changes", &stacking.changes(), &changes)
        }
        Err(refusal) => {
            same("the stacking", &None, &want)?;
            one_line(refusal)
        }
    }
}

/// Each notation reads its printed form, except for the first sign if the notation omits it.
fn printed_again(stacking: &Stacking, parse: impl Fn(&str) -> Result<Stacking, Error>) -> Checked {
    let minus_first = stacking
        .runs()
        .next()
        .is_some_and(|run| run.sign == Sign::Minus);
    let plus_first = if minus_first {
        stacking.mirrored()
    } else {
        stacking.clone()
    };
    let reads_back = |shown: String, want: &Stacking| {
        let read: Result<_, Failure> = parse(&shown).map_err(Failure::from);
        let read = read?;
        demand(runs_of(&read) == runs_of(want), || {
            format!("'{shown}' is read as {read:?}, not {want:?}")
        })
    };
    reads_back(
        stacking.in_notation(Notation::Zhdanov).to_string(),
        &plus_first,
    )?;
    let layers = stacking.layers();
    if layers > SPELLED_OUT {
        return Ok(());
    }
    reads_back(stacking.in_notation(Notation::Abc).to_string(), stacking)?;
    // An empty text is invalid.
    if layers > 1 {
        reads_back(stacking.in_notation(Notation::Hagg).to_string(), stacking)?;
    }
    if layers > 2 {
        reads_back(
            stacking.in_notation(Notation::Jagodzinski).to_string(),
            &plus_first,
        )?;
    }
    Ok(())
}

#[cfg(test)]
mod injected_faults {
    use super::*;

    fn parsed(text: &str) -> Stacking {
        text.parse().unwrap()
    }

    #[test]
    fn a_text_read_as_another_stacking_is_caught() {
        for text in ["++-+", "ABCBC", "chh", "(2,1,1)"] {
            assert!(as_the_rules_say(text, &text.parse()).is_ok());
            for wrong in ["+++-", "--+-", "++-"] {
                assert!(
                    as_the_rules_say(text, &wrong.parse()).is_err(),
                    "{text} {wrong}"
                );
            }
            assert!(as_the_rules_say(text, &"".parse()).is_err());
        }
        for refused in ["", "AA", "(0)", "(1,,2)", "++h"] {
            assert!(as_the_rules_say(refused, &refused.parse()).is_ok());
            assert!(
                as_the_rules_say(refused, &"+".parse()).is_err(),
                "{refused}"
            );
        }
    }

    #[test]
    fn a_lost_run_is_caught() {
        let run = |sign, steps| Run { sign, steps };
        let listed = [run(Sign::Minus, 2), run(Sign::Plus, 0), run(Sign::Minus, 1)];
        assert!(joined_as_listed(&listed, &"---".parse()).is_ok());
        for wrong in ["--", "+++", "--+-"] {
            assert!(
                joined_as_listed(&listed, &wrong.parse()).is_err(),
                "{wrong}"
            );
        }
        let negative = [run(Sign::Plus, 1), run(Sign::Plus, -1)];
        assert!(joined_as_listed(&negative, &"A".parse()).is_err());
        let tall = [run(Sign::Plus, MAX_LAYERS)];
        assert!(joined_as_listed(&tall, &Stacking::fcc(MAX_LAYERS)).is_err());
    }

    #[test]
    fn a_wrong_reader_of_one_notation_is_caught() {
        let stacking = parsed("--+--");
        assert!(printed_again(&stacking, str::parse).is_ok());
        for notation in ["+", "A", "c", "("] {
            let off = |text: &str| -> Result<Stacking, Error> {
                let stacking: Stacking = text.parse()?;
                let here =
                    text.starts_with(|c| notation.contains(c) || (c == '-' && notation == "+"));
                Ok(if here { stacking.mirrored() } else { stacking })
            };
            assert!(printed_again(&stacking, off).is_err(), "{notation}");
        }
    }
}
