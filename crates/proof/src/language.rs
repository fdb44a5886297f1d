//! The syntax of a definition in Coq.

use cannonpile::engine::bug;
use cannonpile::lattice::{Direction, Sign};
use cannonpile::scalar::Symbol;
use num_bigint::BigInt;
use num_traits::Signed;

use crate::definition::{Body, CaseValue, Definition, Kind, Value};
use crate::{Error, Expression, Operation};

/// The type of the numbers in a definition.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Carrier {
    Rationals,
    Integers,
}

/// Binding strengths of an expression: sum, product, atom.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Strength {
    Sum,
    Product,
    Atom,
}

/// The maximum line width. The parts of a longer value are written on separate lines.
const WIDTH: usize = 100;

impl Carrier {
    /// Returns a definition with its comment.
    pub(crate) fn definition(self, definition: &Definition) -> Result<String, Error> {
        let Definition {
            name,
            about,
            parameters,
            body,
        } = definition;
        let kind = body
            .kind()
            .ok_or_else(|| bug("a definition has at least one case"))?;
        let of = |(name, kind): &(&str, Kind)| format!(" ({name} : {})", self.kind(*kind));
        let parameters = parameters.iter().map(of).collect::<Vec<_>>().concat();
        let (kind, body) = (self.kind(kind), body_of(body)?);
        Ok(format!(
            "(** {about} *)\nDefinition {name}{parameters} : {kind} :=\n  {body}.\n"
        ))
    }

    fn kind(self, kind: Kind) -> String {
        let number = match self {
            Self::Rationals => "Q",
            Self::Integers => "Z",
        };
        let product = |part: &str, n| format!("({})%type", vec![part; n].join(" * "));
        match kind {
            Kind::Number => number.into(),
            Kind::Pair => product(number, 2),
            Kind::Three => format!("three {number}"),
            Kind::Fours => format!("three {}", product(number, 4)),
            Kind::Vector => "vector".into(),
            Kind::Directions => "three vector".into(),
            Kind::Site => product("Z", 2),
            Kind::Direction => "direction".into(),
            Kind::Sign => "sign".into(),
            Kind::Truth => "bool".into(),
        }
    }
}

fn body_of(body: &Body) -> Result<String, Error> {
    let (of, cases) = match body {
        Body::Value(value) => return value_of(value, 2),
        Body::Cases { of, cases } => (of, cases),
    };
    let mut text = format!("match {} with\n", of.join(", "));
    for (case, value) in cases {
        let case: Vec<_> = case.iter().map(|value| constructor(*value)).collect();
        let value = value_of(value, 6)?;
        text.extend(["  | ", &case.join(", "), " => ", &value, "\n"]);
    }
    text += "  end";
    Ok(text)
}

const fn constructor(value: CaseValue) -> &'static str {
    match value {
        CaseValue::Direction(Direction::Alpha) => "Alpha",
        CaseValue::Direction(Direction::Beta) => "Beta",
        CaseValue::Direction(Direction::Gamma) => "Gamma",
        CaseValue::Sign(Sign::Plus) => "Plus",
        CaseValue::Sign(Sign::Minus) => "Minus",
        CaseValue::Truth(true) => "true",
        CaseValue::Truth(false) => "false",
    }
}

/// Returns a value as text. Long parts are written on separate lines with the given indentation.
fn value_of(value: &Value, indent: usize) -> Result<String, Error> {
    Ok(match value {
        Value::Number(number) => written(number)?.0,
        Value::Several(numbers) => several(numbers)?,
        Value::Three(numbers) => {
            let parts = numbers.iter().map(part);
            constructed("Three", &parts.collect::<Result<Vec<_>, _>>()?, indent)
        }
        Value::Fours(fours) => {
            let parts = fours.iter().map(|four| several(four));
            constructed("Three", &parts.collect::<Result<Vec<_>, _>>()?, indent)
        }
        Value::Vector(v) => {
            let parts = [&v.x, &v.y, &v.z].into_iter().map(part);
            constructed("Vector", &parts.collect::<Result<Vec<_>, _>>()?, indent)
        }
        Value::Directions(directions) => {
            let parts = directions.iter().map(|v| {
                let whole = value_of(&Value::Vector(v.clone()), indent + 2)?;
                Ok::<_, Error>(format!("({whole})"))
            });
            constructed("Three", &parts.collect::<Result<Vec<_>, _>>()?, indent)
        }
        Value::Site([i, j]) => format!("({i}, {j})%Z"),
    })
}

/// Returns a constructor applied to its parts.
fn constructed(constructor: &str, parts: &[String], indent: usize) -> String {
    let length: usize = parts.iter().map(|part| part.chars().count() + 2).sum();
    if length + indent + constructor.len() <= WIDTH {
        return format!("{constructor} {}", parts.join(" "));
    }
    let apart = format!("\n{:indent$}  ", "");
    format!("{constructor}{apart}{}", parts.join(&apart))
}

/// Returns an argument of a constructor.
fn part(number: &Expression) -> Result<String, Error> {
    let (text, strength) = written(number)?;
    Ok(match strength {
        Strength::Sum | Strength::Product => format!("({text})"),
        Strength::Atom => text,
    })
}

fn several(numbers: &[Expression]) -> Result<String, Error> {
    let parts: Vec<_> = numbers
        .iter()
        .map(|number| Ok(written(number)?.0))
        .collect::<Result<_, Error>>()?;
    Ok(format!("({})", parts.join(", ")))
}

/// Returns an expression as text, from left to right as it was recorded.
fn written(expression: &Expression) -> Result<(String, Strength), Error> {
    let within = |(text, strength): (String, Strength), least: Strength| {
        if strength < least {
            format!("({text})")
        } else {
            text
        }
    };
    let sum = |a, sign, b| {
        let text = format!(
            "{} {sign} {}",
            within(a, Strength::Sum),
            within(b, Strength::Product)
        );
        (text, Strength::Sum)
    };
    let product = |a, sign, b| {
        let text = format!(
            "{} {sign} {}",
            within(a, Strength::Product),
            within(b, Strength::Atom)
        );
        (text, Strength::Product)
    };
    expression.fold(|operation| match operation {
        Operation::Symbol(Symbol(name)) => (symbol(name), Strength::Atom),
        Operation::Number(number) => (fraction(number.numer(), number.denom()), Strength::Atom),
        Operation::Negative(a) => (format!("(- {})", within(a, Strength::Atom)), Strength::Atom),
        Operation::Sum(a, b) => sum(a, '+', b),
        Operation::Difference(a, b) => sum(a, '-', b),
        Operation::Product(a, b) => product(a, '*', b),
        Operation::Quotient(a, n) => {
            let part = BigInt::from(n.get().signum());
            let inverse = fraction(&part, &BigInt::from(n.get()).abs());
            product(a, '*', (inverse, Strength::Atom))
        }
    })
}

/// Returns a symbol as text: `g.alpha` becomes a projection of the parameter g.
fn symbol(name: &str) -> String {
    let mut parts = name.split('.');
    // `split` yields at least one part, also for an empty name.
    let whole = parts.next().unwrap_or(name);
    parts.fold(whole.into(), |whole, part| format!("{whole}.({part})"))
}

fn fraction(numerator: &BigInt, denominator: &BigInt) -> String {
    let whole = *denominator == BigInt::from(1);
    match (whole, numerator.is_negative()) {
        (true, true) => format!("({numerator})"),
        (true, false) => numerator.to_string(),
        (false, _) => format!("({numerator} # {denominator})"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cannonpile::geometry::Vector;

    /// The constructor, the indentation and the parts, with two more columns each, take 100 columns in the first case
    /// and 101 in the second.
    #[test]
    fn long_values_are_broken_into_lines() {
        let parts = |last: usize| ["a".repeat(40), "b".repeat(30), "c".repeat(last)];
        // 5 columns of `Three`, 4 of indentation, 40 + 30 + 15 of the parts and three times two.
        let [a, b, c] = parts(15);
        assert_eq!(
            constructed("Three", &parts(15), 4),
            format!("Three {a} {b} {c}")
        );
        let c = "c".repeat(16);
        let broken = format!("Three\n      {a}\n      {b}\n      {c}");
        assert_eq!(constructed("Three", &parts(16), 4), broken);
    }

    #[test]
    fn nested_parts_are_indented() {
        let long: Expression = Symbol("a_symbol_of_more_than_thirty_letters").into();
        let vector = || Vector {
            x: long.clone(),
            y: long.clone(),
            z: long.clone(),
        };
        let directions = Value::Directions(Box::new([vector(), vector(), vector()]));
        let text = value_of(&directions, 6).unwrap();
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(lines.len(), 1 + 3 * 4);
        assert_eq!((lines[0], lines[1]), ("Three", "        (Vector"));
        assert_eq!(lines[2], format!("          {long}"));
        assert_eq!(lines[12], format!("          {long})"));
    }

    #[test]
    fn negative_numbers_are_bracketed() {
        let fraction = |n: i64, d: i64| fraction(&n.into(), &d.into());
        assert_eq!(fraction(-2, 1), "(-2)");
        assert_eq!(fraction(2, 1), "2");
        assert_eq!(fraction(-2, 3), "(-2 # 3)");
    }
}
