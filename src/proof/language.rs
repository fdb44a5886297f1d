//! How a definition is written in the language of a proof assistant.

use num_bigint::BigInt;
use num_traits::Signed;

use super::Assistant;
use super::definition::{Asked, Body, Definition, Kind, Value};
use crate::Error;
use crate::error::bug;
use crate::lattice::{Direction, Sign};
use crate::scalar::{Expression, Operation};

/// What numbers are.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Carrier {
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

/// A language, and what numbers are in it.
#[derive(Clone, Copy)]
pub(super) struct Language {
    pub(super) assistant: Assistant,
    pub(super) carrier: Carrier,
}

impl Language {
    /// A definition with its comment.
    pub(super) fn definition(self, definition: &Definition) -> Result<String, Error> {
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
        let kind = self.kind(kind);
        let body = self.body(body)?;
        Ok(match self.assistant {
            Assistant::Coq => {
                format!("(** {about} *)\nDefinition {name}{parameters} : {kind} :=\n  {body}.\n")
            }
            Assistant::Lean => {
                format!("/-- {about} -/\ndef {name}{parameters} : {kind} :=\n  {body}\n")
            }
        })
    }

    fn kind(self, kind: Kind) -> String {
        let number = match (self.assistant, self.carrier) {
            (Assistant::Coq, Carrier::Rationals) => "Q",
            (Assistant::Coq, Carrier::Integers) => "Z",
            (Assistant::Lean, Carrier::Rationals) => "Rat",
            (Assistant::Lean, Carrier::Integers) => "Int",
        };
        let [three, vector, direction, sign, truth, integer, times] = match self.assistant {
            Assistant::Coq => ["three", "vector", "direction", "sign", "bool", "Z", "*"],
            Assistant::Lean => ["Three", "Vector3", "Direction", "Sign", "Bool", "Int", "×"],
        };
        let product = |part: &str, n| {
            let parts = vec![part; n].join(&format!(" {times} "));
            match self.assistant {
                Assistant::Coq => format!("({parts})%type"),
                Assistant::Lean => format!("({parts})"),
            }
        };
        match kind {
            Kind::Number => number.into(),
            Kind::Pair => product(number, 2),
            Kind::Three => format!("{three} {number}"),
            Kind::Fours => format!("{three} {}", product(number, 4)),
            Kind::Vector => vector.into(),
            Kind::Directions => format!("{three} {vector}"),
            Kind::Site => product(integer, 2),
            Kind::Direction => direction.into(),
            Kind::Sign => sign.into(),
            Kind::Truth => truth.into(),
        }
    }

    fn body(self, body: &Body) -> Result<String, Error> {
        let (of, cases) = match body {
            Body::Value(value) => return self.value(value, 2),
            Body::Cases { of, cases } => (of, cases),
        };
        let mut text = format!("match {} with\n", of.join(", "));
        for (asked, value) in cases {
            let asked: Vec<_> = asked.iter().map(|asked| self.asked(*asked)).collect();
            let value = self.value(value, 6)?;
            text.extend(["  | ", &asked.join(", "), " => ", &value, "\n"]);
        }
        if self.assistant == Assistant::Coq {
            text += "  end";
        }
        Ok(text.trim_end().into())
    }

    fn asked(self, asked: Asked) -> &'static str {
        match (asked, self.assistant) {
            (Asked::Direction(Direction::Alpha), Assistant::Coq) => "Alpha",
            (Asked::Direction(Direction::Beta), Assistant::Coq) => "Beta",
            (Asked::Direction(Direction::Gamma), Assistant::Coq) => "Gamma",
            (Asked::Sign(Sign::Plus), Assistant::Coq) => "Plus",
            (Asked::Sign(Sign::Minus), Assistant::Coq) => "Minus",
            (Asked::Direction(Direction::Alpha), Assistant::Lean) => ".alpha",
            (Asked::Direction(Direction::Beta), Assistant::Lean) => ".beta",
            (Asked::Direction(Direction::Gamma), Assistant::Lean) => ".gamma",
            (Asked::Sign(Sign::Plus), Assistant::Lean) => ".plus",
            (Asked::Sign(Sign::Minus), Assistant::Lean) => ".minus",
            (Asked::Truth(true), _) => "true",
            (Asked::Truth(false), _) => "false",
        }
    }

    /// A value, its parts on lines of their own if they are long, so many spaces from the left.
    fn value(self, value: &Value, indent: usize) -> Result<String, Error> {
        Ok(match value {
            Value::Number(number) => self.number(number)?.0,
            Value::Several(numbers) => self.several(numbers)?,
            Value::Three(numbers) => {
                let parts = numbers.iter().map(|number| self.part(number));
                self.made("Three", &parts.collect::<Result<Vec<_>, _>>()?, indent)
            }
            Value::Fours(fours) => {
                let parts = fours.iter().map(|four| self.several(four));
                self.made("Three", &parts.collect::<Result<Vec<_>, _>>()?, indent)
            }
            Value::Vector(v) => {
                let parts = [&v.x, &v.y, &v.z].map(|part| self.part(part));
                self.made(
                    "Vector",
                    &parts.into_iter().collect::<Result<Vec<_>, _>>()?,
                    indent,
                )
            }
            Value::Directions(directions) => {
                let parts = directions.iter().map(|v| {
                    let whole = self.value(&Value::Vector(v.clone()), indent + 2)?;
                    Ok::<_, Error>(match self.assistant {
                        Assistant::Coq => format!("({whole})"),
                        Assistant::Lean => whole,
                    })
                });
                self.made("Three", &parts.collect::<Result<Vec<_>, _>>()?, indent)
            }
            Value::Site([i, j]) => match self.assistant {
                Assistant::Coq => format!("({i}, {j})%Z"),
                Assistant::Lean => format!("({i}, {j})"),
            },
        })
    }

    /// What a constructor makes of its parts.
    fn made(self, constructor: &str, parts: &[String], indent: usize) -> String {
        let length: usize = parts.iter().map(|part| part.chars().count() + 2).sum();
        let apart = format!("\n{:indent$}", "");
        let broken = length + indent + constructor.len() > WIDTH;
        match (self.assistant, broken) {
            (Assistant::Coq, false) => format!("{constructor} {}", parts.join(" ")),
            (Assistant::Coq, true) => {
                format!(
                    "{constructor}{apart}  {}",
                    parts.join(&format!("{apart}  "))
                )
            }
            (Assistant::Lean, false) => format!("⟨{}⟩", parts.join(", ")),
            (Assistant::Lean, true) => {
                format!("⟨{apart}  {}⟩", parts.join(&format!(",{apart}  ")))
            }
        }
    }

    /// An argument of a constructor.
    fn part(self, number: &Expression) -> Result<String, Error> {
        let (text, firm) = self.number(number)?;
        Ok(match (self.assistant, firm) {
            (Assistant::Coq, Firm::Sum | Firm::Product) => format!("({text})"),
            _ => text,
        })
    }

    fn several(self, numbers: &[Expression]) -> Result<String, Error> {
        let parts: Vec<_> = numbers
            .iter()
            .map(|number| Ok(self.number(number)?.0))
            .collect::<Result<_, Error>>()?;
        Ok(format!("({})", parts.join(", ")))
    }

    /// An expression as it was formed, from left to right.
    fn number(self, expression: &Expression) -> Result<(String, Firm), Error> {
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
            Operation::Symbol(symbol) => (self.symbol(symbol.0), Firm::Atom),
            Operation::Number(number) => {
                (self.fraction(number.numer(), number.denom()), Firm::Atom)
            }
            Operation::Negative(a) => (format!("(- {})", within(a, Firm::Atom)), Firm::Atom),
            Operation::Sum(a, b) => sum(a, '+', b),
            Operation::Difference(a, b) => sum(a, '-', b),
            Operation::Product(a, b) => product(a, '*', b),
            Operation::Quotient(a, n) => {
                let part = BigInt::from(n.get().signum());
                let inverse = self.fraction(&part, &BigInt::from(n.get()).abs());
                product(a, '*', (inverse, Firm::Atom))
            }
        })
    }

    /// `g.alpha` is a part of the parameter g.
    fn symbol(self, name: &str) -> String {
        let mut parts = name.split('.');
        // Not a default: the first part is there, of an empty name too.
        let whole = parts.next().unwrap_or(name);
        parts.fold(whole.into(), |whole, part| match self.assistant {
            Assistant::Coq => format!("{whole}.({part})"),
            Assistant::Lean => format!("{whole}.{part}"),
        })
    }

    fn fraction(self, numerator: &BigInt, denominator: &BigInt) -> String {
        let whole = *denominator == BigInt::from(1);
        match self.assistant {
            _ if whole && numerator.is_negative() => format!("({numerator})"),
            _ if whole => numerator.to_string(),
            Assistant::Coq => format!("({numerator} # {denominator})"),
            Assistant::Lean => format!("({numerator} / {denominator} : Rat)"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector;
    use crate::scalar::Symbol;

    fn language(assistant: Assistant) -> Language {
        Language {
            assistant,
            carrier: Carrier::Rationals,
        }
    }

    /// Name, parts with two more columns each, and what is left of it: a hundred columns, and one more.
    #[test]
    fn what_is_wider_than_a_line_is_broken() {
        let parts = |last: usize| ["a".repeat(40), "b".repeat(30), "c".repeat(last)];
        let [coq, lean] = [Assistant::Coq, Assistant::Lean].map(language);
        // 5 of `Three`, 4 of the indent, 40 + 30 + 15 and three times two.
        let [a, b, c] = parts(15);
        assert_eq!(
            coq.made("Three", &parts(15), 4),
            format!("Three {a} {b} {c}")
        );
        assert_eq!(
            lean.made("Three", &parts(15), 4),
            format!("⟨{a}, {b}, {c}⟩")
        );
        let c = "c".repeat(16);
        let broken = format!("Three\n      {a}\n      {b}\n      {c}");
        assert_eq!(coq.made("Three", &parts(16), 4), broken);
        let broken = format!("⟨\n      {a},\n      {b},\n      {c}⟩");
        assert_eq!(lean.made("Three", &parts(16), 4), broken);
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
        let text = language(Assistant::Coq).value(&directions, 6).unwrap();
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(lines.len(), 1 + 3 * 4);
        assert_eq!((lines[0], lines[1]), ("Three", "        (Vector"));
        assert_eq!(lines[2], format!("          {long}"));
        assert_eq!(lines[12], format!("          {long})"));
    }

    #[test]
    fn negative_numbers_have_brackets() {
        let fraction =
            |assistant, n: i64, d: i64| language(assistant).fraction(&n.into(), &d.into());
        let [coq, lean] = [Assistant::Coq, Assistant::Lean];
        for assistant in [coq, lean] {
            assert_eq!(fraction(assistant, -2, 1), "(-2)");
            assert_eq!(fraction(assistant, 2, 1), "2");
        }
        assert_eq!(fraction(coq, -2, 3), "(-2 # 3)");
        assert_eq!(fraction(lean, -2, 3), "(-2 / 3 : Rat)");
    }
}
