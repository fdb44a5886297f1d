//! The formulas in the Coq files, read back and evaluated, equal the library's formulas in rationals.
//!
//! The reader is small and independent of the writer. It reads signs, brackets and fractions as Coq does.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use arbitrary::Unstructured;
use cannonpile::formula;
use cannonpile::geometry;
use cannonpile::geometry::Vector;
use cannonpile::lattice::count;
use cannonpile_disorder::formula as disorder;
use cannonpile_horizontal::formula as horizontal;
use num_bigint::BigInt;
use num_rational::BigRational as Q;
use num_traits::Zero;

use super::{Checked, demand};
use crate::generators::number;

/// Evaluates one definition with numeric parameters and compares it with the library. It picks one definition because no
/// input has values for all of them.
pub fn any_values(u: &mut Unstructured<'_>) -> Checked {
    let (name, of) = u.choose(ORACLES)?;
    let definition = Definition::find(&FORMULAS, name);
    let mut values = Vec::new();
    for _ in &definition.parameters {
        values.push(number::rational(u)?);
    }
    let got = definition.evaluate(&values);
    let want = of(&values);
    demand(got == want, || {
        format!("{name} of {values:?} is {got:?} in Coq, not {want:?}")
    })
}

/// The Coq text of all formulas. It is always the same.
static FORMULAS: LazyLock<String> = LazyLock::new(|| {
    let files = cannonpile_proof::files().expect("the library's own formulas");
    let text = files.iter().find(|file| file.name() == "Formulas.v");
    text.expect("the formulas").text().to_owned()
});

/// A formula as a function of its parameters in order. Triples and vectors are split into components.
type Oracle = fn(&[Q]) -> Vec<Q>;

const ORACLES: &[(&str, Oracle)] = &[
    ("above", |v| count::above(&v[0], &v[1], &v[2]).into()),
    ("spheres_3", |v| vec![count::spheres(&v[0], 3)]),
    ("spheres_6", |v| vec![count::spheres(&v[0], 6)]),
    ("spheres_in_layer_4", |v| {
        vec![count::spheres_in_layer(&v[0], 4)]
    }),
    ("contacts_3", |v| vec![count::contacts(&v[0], 3)]),
    ("contacts_of_strength_5", |v| {
        vec![count::contacts_of_strength(&v[0], &v[1], 5)]
    }),
    ("directions", |v| flat(geometry::directions(&v[0]))),
    ("squared_distance", |v| {
        vec![geometry::squared_distance(&three(v), &v[3], &v[4])]
    }),
    ("position", |v| {
        parts(geometry::position(&three(v), &vectors(&v[3..])))
    }),
    ("increments", |v| formula::increments(&v[0]).into()),
    ("weight", |v| vec![formula::weight(&three(v))]),
    ("weight_5", |v| vec![formula::weight(v)]),
    ("force", |v| vec![formula::force(v[0].clone(), &v[1])]),
    ("transmitted", |v| {
        vec![formula::transmitted(v[0].clone(), &v[1])]
    }),
    ("resultant", |v| {
        parts(formula::resultant(&three(v), &vectors(&v[3..])))
    }),
    ("support_load", |v| {
        parts(formula::support_load(&three(v), &vectors(&v[3..]), &v[12]))
    }),
    ("unbalanced", |v| {
        let (below, over) = (vectors(&v[3..]), vectors(&v[15..]));
        parts(formula::unbalanced(
            &three(v),
            &below,
            &three(&v[12..]),
            &over,
            &v[24],
        ))
    }),
    ("half_turn", |v| {
        // By the definition: (2/3)Σg − g.
        let twice = (v[0].clone() + &v[1] + &v[2]) * Q::new(2.into(), 3.into());
        v.iter().map(|g| &twice - g).collect()
    }),
    ("tripled_half_turn", |v| {
        formula::tripled_half_turn(&three(v)).into()
    }),
    ("tripled_apart", |v| {
        formula::tripled_apart(&three(v)).into()
    }),
    ("contact_drop", |v| {
        vec![horizontal::contact_drop(v[0].clone(), &v[1])]
    }),
    ("elastic_field", |v| {
        vec![horizontal::elastic_field(&v[0], &v[1])]
    }),
    ("greatest_on_corner", |v| {
        vec![horizontal::greatest_on_corner(&v[0])]
    }),
    ("greatest_inside", |v| {
        vec![horizontal::greatest_inside(&three(v))]
    }),
    ("greatest_on_edge", |v| {
        vec![horizontal::greatest_on_edge(&v[0], &v[1], &v[2])]
    }),
    ("arch", |v| horizontal::arch(&three(v)).into()),
    ("third_moment", |v| {
        vec![disorder::third_moment(&v[0], &v[1])]
    }),
    ("fourth_moment", |v| vec![disorder::fourth_moment(&v[0])]),
    ("fourth_moment_of_pair", |v| {
        vec![disorder::fourth_moment_of_pair(&v[0], &v[1], &v[2])]
    }),
    ("mean_third_moment", |v| {
        vec![disorder::mean_third_moment(&v[0], &v[1], &v[2])]
    }),
    ("mean_fourth_moment_of_pairs", |v| {
        vec![disorder::mean_fourth_moment_of_pairs(&v[0], &v[1], &v[2])]
    }),
    ("wave", |v| disorder::wave(&v[0]).into()),
    ("registry_excess", |v| {
        vec![disorder::registry_excess(&v[0], &v[1], &v[2])]
    }),
];

fn three(v: &[Q]) -> [Q; 3] {
    [v[0].clone(), v[1].clone(), v[2].clone()]
}

fn vectors(v: &[Q]) -> [Vector<Q>; 3] {
    [0, 3, 6].map(|at| {
        let [x, y, z] = three(&v[at..]);
        Vector { x, y, z }
    })
}

fn parts(v: Vector<Q>) -> Vec<Q> {
    v.into_array().into()
}

fn flat(v: [Vector<Q>; 3]) -> Vec<Q> {
    v.into_iter().flat_map(parts).collect()
}

/// A Coq definition: its numeric parameters, with `g.(alpha)` for a component of g, and its body.
struct Definition<'t> {
    parameters: Vec<String>,
    body: Vec<&'t str>,
}

impl<'t> Definition<'t> {
    fn find(text: &'t str, name: &str) -> Self {
        let begin = format!("Definition {name} ");
        let (_, after) = text.split_once(&begin).expect("the definition");
        let (head, after) = after.split_once(":=\n").expect("its body");
        let (body, _) = after.split_once(".\n").expect("its end");
        let mut parameters = Vec::new();
        for parameter in head.split('(').skip(1) {
            // The result type is in brackets too.
            let Some((name, kind)) = parameter.split_once(" : ") else {
                continue;
            };
            let directions = ["alpha", "beta", "gamma"].map(|part| format!("{name}.({part})"));
            let components = |of: &String| {
                ["along_x", "along_y", "along_z"].map(|part| format!("{of}.({part})"))
            };
            match kind.split(')').next().unwrap_or(kind) {
                "Q" => parameters.push(name.into()),
                "three Q" => parameters.extend(directions),
                "three vector" => parameters.extend(directions.iter().flat_map(components)),
                kind => panic!("not numeric: {kind}"),
            }
        }
        let body = tokens(body);
        Self { parameters, body }
    }

    fn evaluate(&self, values: &[Q]) -> Vec<Q> {
        let names = self.parameters.iter().map(String::as_str);
        let values: BTreeMap<&str, &Q> = names.zip(values).collect();
        let mut reader = Reader {
            left: &self.body,
            values: &values,
        };
        let value = reader.value();
        assert!(reader.left.is_empty(), "{:?} is left", reader.left);
        value
    }
}

/// Splits a text into names with their components, numbers, and signs.
fn tokens(text: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let mut left = text.trim_start();
    while let Some(first) = left.chars().next() {
        let of_word = |c: char| c.is_alphanumeric() || c == '_';
        let mut length = first.len_utf8();
        if of_word(first) {
            length = left.find(|c| !of_word(c)).unwrap_or(left.len());
            while left[length..].starts_with(".(") {
                length += left[length..].find(')').expect("a part") + 1;
            }
        }
        found.push(&left[..length]);
        left = left[length..].trim_start();
    }
    found
}

struct Reader<'a> {
    left: &'a [&'a str],
    values: &'a BTreeMap<&'a str, &'a Q>,
}

impl<'a> Reader<'a> {
    fn next(&mut self) -> &'a str {
        let (first, left) = self.left.split_first().expect("more");
        self.left = left;
        first
    }

    fn is(&mut self, token: &str) -> bool {
        let found = self.left.first() == Some(&token);
        if found {
            self.next();
        }
        found
    }

    /// Returns several values: the arguments of a constructor, a list with commas, or a single value.
    fn value(&mut self) -> Vec<Q> {
        if self.is("Three") || self.is("Vector") {
            return (0..3).flat_map(|_| self.argument()).collect();
        }
        // A pair, or a sum that begins with a bracket.
        let begun = self.left;
        if begun.first() == Some(&"(") {
            let several = self.argument();
            if several.len() > 1 {
                return several;
            }
            self.left = begun;
        }
        vec![self.sum()]
    }

    fn argument(&mut self) -> Vec<Q> {
        if !self.is("(") {
            return vec![self.atom()];
        }
        let mut all = self.value();
        while !self.is(")") {
            if self.is("#") {
                let denominator = self.sum();
                all = vec![all[0].clone() / denominator];
            } else {
                assert_eq!(self.next(), ",");
                all.extend(self.value());
            }
        }
        all
    }

    fn sum(&mut self) -> Q {
        let mut sum = self.product();
        loop {
            if self.is("+") {
                sum += self.product();
            } else if self.is("-") {
                sum -= self.product();
            } else {
                return sum;
            }
        }
    }

    fn product(&mut self) -> Q {
        let mut product = self.atom();
        while self.is("*") {
            product *= self.atom();
        }
        product
    }

    fn atom(&mut self) -> Q {
        if self.is("-") {
            return -self.atom();
        }
        if self.left.first() == Some(&"(") {
            let mut values = self.argument();
            return values.pop().unwrap_or_else(Q::zero);
        }
        let token = self.next();
        match token.parse::<BigInt>() {
            Ok(number) => number.into(),
            Err(_) => (*self.values.get(token).expect(token)).clone(),
        }
    }
}

#[cfg(test)]
mod injected_faults {
    use super::*;
    use crate::generators::number::ratio;

    #[test]
    fn signs_and_brackets_matter() {
        let value = |body: &str| {
            let text = format!("Definition f (x : Q) (g : three Q) : Q :=\n  {body}.\n");
            Definition::find(&text, "f").evaluate(&[1, 2, 3, 4].map(|n| ratio(n, 2)))
        };
        assert_eq!(value("x - g.(alpha) - x * (1 # 3)"), [ratio(-2, 3)]);
        assert_eq!(value("x - (g.(alpha) - x) * (1 # 3)"), [ratio(1, 3)]);
        assert_eq!(
            value("Three (- x) (-1) (x + 2 * g.(gamma))"),
            [ratio(-1, 2), ratio(-1, 1), ratio(9, 2)]
        );
        assert_eq!(value("(x, g.(beta))"), [ratio(1, 2), ratio(3, 2)]);
        assert_eq!(value("(x - g.(beta)) * 2"), [ratio(-2, 1)]);
    }
}
