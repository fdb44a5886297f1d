//! Texts for the parsers: valid ones with their values, and damaged ones.

use arbitrary::{Result, Unstructured};
use num_bigint::BigInt;
use num_rational::BigRational;

use super::{damaged_by, number, region, stacking};

/// A number as a user may write it, and its value.
pub struct Written {
    /// The text.
    pub text: String,
    /// The value.
    pub value: BigRational,
}

/// A valid fraction or decimal, with a sign, extra zeros and an exponent.
pub fn number(u: &mut Unstructured<'_>) -> Result<Written> {
    let (sign, factor) = [("", 1), ("-", -1), ("+", 1)][u.choose_index(3)?];
    let unsigned = if u.arbitrary()? {
        fraction(u)?
    } else {
        decimal(u)?
    };
    Ok(Written {
        text: format!("{sign}{}", unsigned.text),
        value: unsigned.value * number::ratio(factor, 1),
    })
}

/// `numerator/denominator`.
fn fraction(u: &mut Unstructured<'_>) -> Result<Written> {
    let (numer, denom) = (digits(u, 30)?, format!("{}1", digits(u, 30)?));
    Ok(Written {
        text: format!("{numer}/{denom}"),
        value: BigRational::new(integer(&numer), integer(&denom)),
    })
}

/// `whole.fraction` with an exponent. Any part may be missing.
fn decimal(u: &mut Unstructured<'_>) -> Result<Written> {
    let (whole, fraction) = (digits(u, 40)?, digits(u, 40)?);
    let (mantissa, places) = match u.int_in_range(0..=3)? {
        0 => (whole.clone(), 0),
        1 => (format!("{whole}."), 0),
        2 => (format!(".{fraction}"), fraction.len()),
        _ => (format!("{whole}.{fraction}"), fraction.len()),
    };
    let all = mantissa.replace('.', "");
    let places = i32::try_from(places).expect("at most 40");
    let exponent = [0, u.int_in_range(-400..=400)?][u.choose_index(2)?];
    let text = match (exponent, u.int_in_range(0..=2)?) {
        (0, 0) => mantissa,
        (_, 1) => format!("{mantissa}E{exponent:+}"),
        _ => format!("{mantissa}e{exponent}"),
    };
    Ok(Written {
        text,
        value: number::power(10, exponent - places) * integer(&all),
    })
}

/// From 1 to `most` decimal digits.
fn digits(u: &mut Unstructured<'_>, most: usize) -> Result<String> {
    let length = u.int_in_range(1..=most)?;
    (0..length)
        .map(|_| Ok(char::from(b'0' + u.int_in_range(0..=9_u8)?)))
        .collect()
}

/// The integer with these digits, computed digit by digit.
fn integer(digits: &str) -> BigInt {
    digits
        .bytes()
        .fold(BigInt::ZERO, |n, digit| n * 10 + (digit - b'0'))
}

/// A text for any parser: valid, damaged, or arbitrary.
pub fn any(u: &mut Unstructured<'_>) -> Result<String> {
    match u.int_in_range(0..=4)? {
        0 => Ok(u.arbitrary::<&str>()?.to_owned()),
        1 => {
            let valid = valid(u)?;
            damaged(u, &valid)
        }
        2 => {
            let text = valid(u)?;
            let times = [990, 1_001, 4_990, 5_001][u.choose_index(4)?] / text.len().max(1);
            Ok(text.repeat(times + u.int_in_range(0..=1)?))
        }
        _ => valid(u),
    }
}

/// A text that some parser accepts: a number, a site, a word, or an exponent at the limit.
fn valid(u: &mut Unstructured<'_>) -> Result<String> {
    Ok(match u.int_in_range(0..=4)? {
        0 => number(u)?.text,
        1 => number::machine_integer(u)?.to_string(),
        2 => {
            let count = u.int_in_range(1..=4)?;
            let part = |_| number::machine_integer(u).map(|n| n.to_string());
            (0..count).map(part).collect::<Result<Vec<_>>>()?.join(",")
        }
        3 => ["alpha", "beta", "gamma", "2", "3"][u.choose_index(5)?].to_owned(),
        _ => format!("{}e{}", digits(u, 5)?, u.int_in_range(-10_001..=10_001)?),
    })
}

/// A text for the parsers of options: a region, a root, a stacking, columns, a load, a part or a word. Sometimes it is
/// damaged.
pub fn word(u: &mut Unstructured<'_>) -> Result<String> {
    let valid = match u.int_in_range(0..=7)? {
        0 => {
            let region = region::region(u)?;
            if u.arbitrary()? {
                format!("{region:#}")
            } else {
                region.to_string()
            }
        }
        1 => {
            let [p, q] = [number::machine_integer(u)?, u.int_in_range(-1..=9)?];
            format!(
                "{}:{p},{q}",
                ["hexagon", "triangle", "region"][u.choose_index(3)?]
            )
        }
        2 => {
            let (coefficient, radicand) = number::root(u)?;
            format!("{coefficient}*sqrt({radicand})")
        }
        3 => stacking::text(u)?,
        4 => columns(u)?,
        5 => {
            let [k, i] = [number::machine_integer(u)?, u.int_in_range(-1..=9)?];
            format!("{k},{i},0={}", number(u)?.text)
        }
        6 => format!("{}/{}", u.int_in_range(0..=9)?, u.arbitrary::<u64>()?),
        _ => (*u.choose(&WORDS)?).to_owned(),
    };
    match u.int_in_range(0..=2)? {
        0 => Ok(valid),
        1 => damaged(u, &valid),
        _ => damaged_by(u, &valid, &MARKS),
    }
}

/// Complete values of options.
const WORDS: [&str; 20] = [
    "fcc",
    "hcp",
    "dhcp",
    "plus",
    "minus",
    "random",
    "+",
    "-",
    "elastic",
    "isostatic",
    "lammps",
    "yade",
    "exadem-vtp",
    "dem-engine",
    "mddem",
    "lethe",
    "alpha-beta",
    "sqrt(2)",
    "-sqrt(1/3)",
    "hexagon:3",
];

/// The characters of options apart from digits.
const MARKS: [char; 20] = [
    '*', '=', '#', ':', '|', ',', '+', '-', '.', '(', ')', 's', 'q', 'h', 'x', '0', '1', '9', ' ',
    'A',
];

/// The columns of some table.
fn columns(u: &mut Unstructured<'_>) -> Result<String> {
    const QUANTITIES: [&str; 8] = ["id1", "id2", "force", "fx", "fz", "x", "x1", "kind"];
    const TERMS: [&str; 12] = [
        "A",
        "#1",
        "-#10-#13",
        "1e7*overlap",
        "-f_x",
        "a+-b",
        "#5:0|1|2",
        "t:SS",
        "2.5*a+b",
        "0.1*#3",
        "-1e-300*A",
        "c_1[2]",
    ];
    let count = u.int_in_range(1..=4)?;
    let name = |_| Ok(format!("{}={}", u.choose(&QUANTITIES)?, u.choose(&TERMS)?));
    Ok((0..count).map(name).collect::<Result<Vec<_>>>()?.join(","))
}

/// Replaces, adds or removes up to three characters of `text`.
pub fn damaged(u: &mut Unstructured<'_>, text: &str) -> Result<String> {
    // The characters of numbers, and similar ones: other digits, spaces, signs, the empty text.
    const INTRUDERS: [char; 16] = [
        '+', '-', '.', '/', ',', 'e', 'E', '_', '0', '9', ' ', '\t', '\0', '٣', '−', '𝟙',
    ];
    damaged_by(u, text, &INTRUDERS)
}
