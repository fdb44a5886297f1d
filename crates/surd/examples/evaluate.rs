//! Answers questions about exact numbers, one a line, from standard input.
//!
//! `peers/surd.py` asks random and adversarial questions, and compares the answers with another library. By hand:
//!
//! ```text
//! $ echo 'round 5/6*sqrt(3) -1/6*sqrt(39)' | cargo run -p exact-surd --example evaluate
//! 5/6*sqrt(3)-1/6*sqrt(39) 3fd9c342583420c8 3ece1a13
//! ```
//!
//! | question | answer |
//! |---|---|
//! | `parse X` | x as printed, or `error`; X is the rest of the line |
//! | `round X`, `round X Y` | x or x + y as printed, the bits of its `f64` and of its `f32` |
//! | `order X Y` | `less`, `equal` or `greater`; for equal numbers `unequal hashes` is a possible answer |
//! | `sign X Y` | the sign of x + y: `-`, `0` or `+` |
//! | `float X F`, `float X Y F` | the order of x or x + y and the `f64` with the bits F; `none` for not-a-number |
//! | `times X Y`, `times X Y Z` | the product of x and y, or of x + y and z, as printed |
//! | `sum X Y` | x + y as printed, or `none` if it is no surd |
//! | `inverse X`, `square X` | 1/x as printed, or `none` for zero; x² as printed |
//! | `add`, `subtract`, `multiply`, `divide` and the bits of two double-doubles | the bits of the result, or `none` |
//! | `compare` and the bits of two double-doubles | their order |
//! | `double R` | the bits of the double-double of a rational |

use std::cmp::Ordering;
use std::collections::hash_map::DefaultHasher;
use std::error::Error;
use std::hash::{Hash, Hasher};
use std::io::{self, BufRead, Write};

use exact_surd::num_bigint::Sign;
use exact_surd::{CorrectlyRounded, DoubleDouble, Surd, SurdSum, parse};

type Answer = Result<String, Box<dyn Error>>;

fn main() -> Result<(), Box<dyn Error>> {
    let mut output = io::BufWriter::new(io::stdout().lock());
    for line in io::stdin().lock().lines() {
        let line = line?;
        let answer = answer(&line).map_err(|error| format!("{line}: {error}"))?;
        writeln!(output, "{answer}")?;
    }
    output.flush()?;
    Ok(())
}

fn answer(line: &str) -> Answer {
    let (question, rest) = line.split_once(' ').ok_or("the operand is missing")?;
    if question == "parse" {
        let read = rest.parse::<Surd>();
        return Ok(read.map_or("error".into(), |x| x.to_string()));
    }
    let operands: Vec<&str> = rest.split(' ').collect();
    Ok(match (question, &operands[..]) {
        ("round", [x]) => rounded(&x.parse::<Surd>()?),
        ("round", [x, y]) => rounded_sum(&SurdSum::new(x.parse()?, y.parse()?)),
        ("order", [x, y]) => order(&x.parse()?, &y.parse()?).into(),
        ("sign", [x, y]) => match SurdSum::new(x.parse()?, y.parse()?).sign() {
            Sign::Minus => "-".into(),
            Sign::NoSign => "0".into(),
            Sign::Plus => "+".into(),
        },
        ("float", [x, float]) => name(x.parse::<Surd>()?.partial_cmp(&from_bits(float)?)).into(),
        ("float", [x, y, float]) => {
            let sum = SurdSum::new(x.parse()?, y.parse()?);
            name(sum.partial_cmp(&from_bits(float)?)).into()
        }
        ("times", [x, y]) => (x.parse::<Surd>()? * y.parse::<Surd>()?).to_string(),
        ("times", [x, y, z]) => (SurdSum::new(x.parse()?, y.parse()?) * &z.parse()?).to_string(),
        ("sum", [x, y]) => or_none(x.parse::<Surd>()?.checked_add(&y.parse()?)),
        ("inverse", [x]) => or_none(x.parse::<Surd>()?.checked_recip()),
        ("square", [x]) => x.parse::<Surd>()?.square().to_string(),
        ("double", [r]) => bits(DoubleDouble::from_rational(&parse::rational(r)?)),
        (operation, [a, b, c, d]) => {
            return of_double_doubles(operation, double_double(a, b)?, double_double(c, d)?);
        }
        _ => return Err("no such question".into()),
    })
}

fn rounded(x: &Surd) -> String {
    // An overflow is an infinity, as in `to_f64`.
    let single = x.nearest().unwrap_or(match x.sign() {
        Sign::Minus => f32::NEG_INFINITY,
        _ => f32::INFINITY,
    });
    format!("{x} {:016x} {:08x}", x.to_f64().to_bits(), single.to_bits())
}

fn rounded_sum(x: &SurdSum) -> String {
    let negative = x.sign() == Sign::Minus;
    let double = nearest(x, negative, f64::INFINITY);
    let single = nearest(x, negative, f32::INFINITY);
    format!("{x} {:016x} {:08x}", double.to_bits(), single.to_bits())
}

fn nearest<F: CorrectlyRounded + PartialEq + std::ops::Neg<Output = F>>(
    x: &SurdSum,
    negative: bool,
    infinity: F,
) -> F {
    let overflow = if negative { -infinity } else { infinity };
    x.nearest().unwrap_or(overflow)
}

fn order(x: &Surd, y: &Surd) -> &'static str {
    let hash = |x: &Surd| {
        let mut hasher = DefaultHasher::new();
        x.hash(&mut hasher);
        hasher.finish()
    };
    if x == y && hash(x) != hash(y) {
        return "unequal hashes";
    }
    name(Some(x.cmp(y)))
}

const fn name(order: Option<Ordering>) -> &'static str {
    match order {
        Some(Ordering::Less) => "less",
        Some(Ordering::Equal) => "equal",
        Some(Ordering::Greater) => "greater",
        None => "none",
    }
}

fn or_none(x: Option<Surd>) -> String {
    x.map_or("none".into(), |x| x.to_string())
}

fn from_bits(text: &str) -> Result<f64, Box<dyn Error>> {
    Ok(f64::from_bits(u64::from_str_radix(text, 16)?))
}

fn double_double(high: &str, low: &str) -> Result<DoubleDouble, Box<dyn Error>> {
    let parts = DoubleDouble::from_parts(from_bits(high)?, from_bits(low)?);
    parts.ok_or_else(|| "the low part is too large".into())
}

fn bits(x: DoubleDouble) -> String {
    format!("{:016x} {:016x}", x.high().to_bits(), x.low().to_bits())
}

fn of_double_doubles(operation: &str, x: DoubleDouble, y: DoubleDouble) -> Answer {
    Ok(match operation {
        "add" => bits(x + y),
        "subtract" => bits(x - y),
        "multiply" => bits(x * y),
        "divide" => x.checked_div(&y).map_or("none".into(), bits),
        "compare" => name(x.partial_cmp(&y)).into(),
        _ => return Err("no such operation".into()),
    })
}
