//! How a definition is written in Coq.

use cannonpile::engine::bug;
use cannonpile::lattice::{Direction, Sign};
use cannonpile::scalar::Symbol;
use num_bigint::BigInt;
use num_traits::Signed;

use crate::definition::{Asked, Body, Definition, Kind, Value};
use crate::{Error, Expression, Operation};

/// The type of the numbers in a definition.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Carrier {
    Rationals,
    Integers,
}

/// How firmly a text holds together: as a sum, as a product, or by itself.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Firm {
    Sum,
    Product,
    Atom,
}

/// Columns of a line, over which parts go on lines of their own.
const WIDTH: usize = 100;

impl Carrier {
    /// A definition with its comment.
    pub(crate) fn definition(self, definition: &Definition) -> Result<String, Error> {
        let Definition {
            name,
            about,
            parameters,
            body,
        } = definition;
        let kind = body
            .kind()
            .ok_or_else(|| bug("a definition has a case at least"))?;
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
    for (asked, value) in cases {
        let asked: Vec<_> = asked.iter().map(|asked| constructor(*asked)).collect();
        let value = value_of(value, 6)?;
        text.extend(["  | ", &asked.join(", "), " => ", &value, "\n"]);
    }
    text += "  end";
    Ok(text)
}

const fn constructor(asked: Asked) -> &'static str {
    match asked {
        Asked::Direction(Direction::Alpha) => "Alpha",
        Asked::Direction(Direction::Beta) => "Beta",
        Asked::Direction(Direction::Gamma) => "Gamma",
        Asked::Sign(Sign::Plus) => "Plus",
        Asked::Sign(Sign::Minus) => "Minus",
        Asked::Truth(true) => "true",
        Asked::Truth(false) => "false",
    }
}

/// A value. Its parts are on lines of their own if they are long, indented by so many spaces.
fn value_of(value: &Value, indent: usize) -> Result<String, Error> {
    Ok(match value {
        Value::Number(number) => written(number)?.0,
        Value::Several(numbers) => several(numbers)?,
        Value::Three(numbers) => {
            let parts = numbers.iter().map(part);
            made("Three", &parts.collect::<Result<Vec<_>, _>>()?, indent)
        }
        Value::Fours(fours) => {
            let parts = fours.iter().map(|four| several(four));
            made("Three", &parts.collect::<Result<Vec<_>, _>>()?, indent)
        }
        Value::Vector(v) => {
            let parts = [&v.x, &v.y, &v.z].into_iter().map(part);
            made("Vector", &parts.collect::<Result<Vec<_>, _>>()?, indent)
        }
        Value::Directions(directions) => {
            let parts = directions.iter().map(|v| {
                let whole = value_of(&Value::Vector(v.clone()), indent + 2)?;
                Ok::<_, Error>(format!("({whole})"))
            });
            made("Three", &parts.collect::<Result<Vec<_>, _>>()?, indent)
        }
        Value::Site([i, j]) => format!("({i}, {j})%Z"),
    })
}

/// What a constructor makes of its parts.
fn made(constructor: &str, parts: &[String], indent: usize) -> String {
    let length: usize = parts.iter().map(|part| part.chars().count() + 2).sum();
    if length + indent + constructor.len() <= WIDTH {
        return format!("{constructor} {}", parts.join(" "));
    }
    let apart = format!("\n{:indent$}  ", "");
    format!("{constructor}{apart}{}", parts.join(&apart))
}

/// An argument of a constructor.
fn part(number: &Expression) -> Result<String, Error> {
    let (text, firm) = written(number)?;
    Ok(match firm {
        Firm::Sum | Firm::Product => format!("({text})"),
        Firm::Atom => text,
    })
}

fn several(numbers: &[Expression]) -> Result<String, Error> {
    let parts: Vec<_> = numbers
        .iter()
        .map(|number| Ok(written(number)?.0))
        .collect::<Result<_, Error>>()?;
    Ok(format!("({})", parts.join(", ")))
}

/// An expression as it was formed, from left to right.
fn written(expression: &Expression) -> Result<(String, Firm), Error> {
    let within = |(text, firm): (String, Firm), least: Firm| {
        if firm < least {
            format!("({text})")
        } else {
            text
        }
    };
    let sum = |a, sign, b| {
        let text = format!(
            "{} {sign} {}",
            within(a, Firm::Sum),
            within(b, Firm::Product)
        );
        (text, Firm::Sum)
    };
    let product = |a, sign, b| {
        let text = format!(
            "{} {sign} {}",
            within(a, Firm::Product),
            within(b, Firm::Atom)
        );
        (text, Firm::Product)
    };
    expression.fold(|operation| match operation {
        Operation::Symbol(Symbol(name)) => (symbol(name), Firm::Atom),
        Operation::Number(number) => (fraction(number.numer(), number.denom()), Firm::Atom),
        Operation::Negative(a) => (format!("(- {})", within(a, Firm::Atom)), Firm::Atom),
        Operation::Sum(a, b) => sum(a, '+', b),
        Operation::Difference(a, b) => sum(a, '-', b),
        Operation::Product(a, b) => product(a, '*', b),
        Operation::Quotient(a, n) => {
            let part = BigInt::from(n.get().signum());
            let inverse = fraction(&part, &BigInt::from(n.get()).abs());
            product(a, '*', (inverse, Firm::Atom))
        }
    })
}

/// `g.alpha` is a part of the parameter g.
fn symbol(name: &str) -> String {
    let mut parts = name.split('.');
    // Not a default: the first part is there, of an empty name too.
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

    /// Name, parts with two more columns each, and what is left of it: a hundred columns, and one more.
    #[test]
    fn what_is_wider_than_a_line_is_broken() {
        let parts = |last: usize| ["a".repeat(40), "b".repeat(30), "c".repeat(last)];
        // 5 of `Three`, 4 of the indent, 40 + 30 + 15 and three times two.
        let [a, b, c] = parts(15);
        assert_eq!(made("Three", &parts(15), 4), format!("Three {a} {b} {c}"));
        let c = "c".repeat(16);
        let broken = format!("Three\n      {a}\n      {b}\n      {c}");
        assert_eq!(made("Three", &parts(16), 4), broken);
    }

    #[test]
    fn parts_of_parts_stand_further_in() {
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
    fn negative_numbers_have_brackets() {
        let fraction = |n: i64, d: i64| fraction(&n.into(), &d.into());
        assert_eq!(fraction(-2, 1), "(-2)");
        assert_eq!(fraction(2, 1), "2");
        assert_eq!(fraction(-2, 3), "(-2 # 3)");
    }
}
