//! Every public function that takes or returns exact numbers runs with long ones in a small stack.
//!
//! `crates/cli/tests/all/long_numbers.rs` is the list of these operations, and `api` that of the public functions.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use super::{is_of_word, without_literals};

/// Functions that the list calls under another name: by an operator, a trait, or another function.
const INDIRECT: [&str; 13] = [
    "add",
    "cmp",
    "deserialize",
    "eq",
    "fmt",
    "from_str",
    "hash",
    "mul",
    "neg",
    "partial_cmp",
    "quotient",
    "serialize",
    "sub",
];

/// Declarations in traits, whose implementations the list calls, a wrapper of `Polynomial::from_rational`, and half precision,
/// which rounds by the provided method that rounds to `f32`.
const DECLARED: [&str; 5] = [
    "Algebra::from_rational",
    "CorrectlyRounded::nearest_to_rational",
    "Expression::from_rational",
    "bf16::nearest_to_rational",
    "f16::nearest_to_rational",
];

/// A public function, as a list of public names declares it.
#[derive(Debug, PartialEq)]
struct Function {
    /// The type or module that it belongs to, without generic parameters.
    owner: String,
    name: String,
    is_method: bool,
}

impl Function {
    /// Reads a line such as `pub fn exact_surd::Surd::sign(&self) -> …`.
    fn parse(line: &str) -> Self {
        let (head, arguments) = line.split_once('(').expect("arguments");
        let mut depth = 0;
        let head = head.chars().filter(|c| {
            depth += i32::from(*c == '<') - i32::from(*c == '>');
            depth == 0 && *c != '>'
        });
        let head: String = head.collect();
        let path = head.split(' ').next_back().expect("a path");
        let (owner, name) = path.rsplit_once("::").expect("a path of two names");
        let first = arguments.split([',', ')']).next();
        Self {
            owner: owner.into(),
            name: name.into(),
            is_method: first.is_some_and(|first| first.trim_start_matches('&') == "self"),
        }
    }

    /// The last name of the owner: `Surd`, or `parse` of `exact_surd::parse`.
    fn of(&self) -> &str {
        self.owner.rsplit("::").next().unwrap_or(&self.owner)
    }

    fn is_associated(&self) -> bool {
        self.of().starts_with(char::is_uppercase) || ["f32", "f64"].contains(&self.of())
    }

    fn is_listed_otherwise(&self) -> bool {
        let path = format!("{}::{}", self.of(), self.name);
        INDIRECT.contains(&&*self.name) || DECLARED.contains(&&*path)
    }

    /// The functions whose calls look alike: all methods of one name, but associated functions of one type.
    fn look(&self) -> String {
        let Self { name, .. } = self;
        if self.is_method {
            format!(".{name}")
        } else {
            format!("{}::{name}", self.of())
        }
    }

    /// What differs between functions that look alike. Some lists name a type by another path.
    fn distinction(&self) -> &str {
        if self.is_associated() {
            self.of()
        } else {
            &self.owner
        }
    }

    /// Counts the calls in code: `.name(`, `Owner::name`, `<Owner as Trait>::name`, and `name(` of a function of a
    /// module.
    fn calls(&self, code: &str) -> usize {
        let Self { name, .. } = self;
        let path = format!("{}::{name}", self.of());
        let by_path = found(code, &path, |before| !is_of_word(before));
        let bare = if self.is_method {
            found(code, &format!(".{name}("), |_| true)
        } else if self.is_associated() {
            0
        } else {
            let alone = |before| !is_of_word(before) && !['.', ':'].contains(&before);
            found(code, &format!("{name}("), alone)
        };
        let as_trait = format!("<{} as ", self.of());
        let by_trait = code.split(&as_trait).skip(1).filter(|after| {
            let after = after.split_once(">::").map(|(_, after)| after);
            let end = after.and_then(|after| after.strip_prefix(name.as_str()));
            end.is_some_and(|end| !end.starts_with(is_of_word))
        });
        by_path + by_trait.count() + bare
    }
}

/// Counts the places of a pattern that stand alone.
fn found(code: &str, pattern: &str, may_precede: impl Fn(char) -> bool) -> usize {
    let stands_alone = |at: usize| {
        let behind = &code[at + pattern.len()..];
        code[..at].chars().next_back().is_none_or(&may_precede)
            && !(pattern.ends_with(is_of_word) && behind.starts_with(is_of_word))
    };
    let places = code.match_indices(pattern);
    places.filter(|(at, _)| stands_alone(*at)).count()
}

/// Removes the types of `::<…>`.
fn without_types(mut code: String) -> String {
    while let Some(start) = code.find("::<") {
        let mut depth = 0;
        let end = code[start..].find(|c| {
            depth += i32::from(c == '<') - i32::from(c == '>');
            depth == 0 && c == '>'
        });
        code.replace_range(start..=start + end.expect("an end of types"), "");
    }
    code
}

/// Describes each function that the list calls less often than there are functions of this look.
fn missing(functions: Vec<Function>, list: &str) -> Vec<String> {
    let code = without_types(without_literals(list));
    let mut looks: BTreeMap<String, Vec<Function>> = BTreeMap::new();
    for function in functions {
        if !function.is_listed_otherwise() {
            looks.entry(function.look()).or_default().push(function);
        }
    }
    let short = looks.into_iter().filter_map(|(look, functions)| {
        let needed: BTreeSet<_> = functions.iter().map(Function::distinction).collect();
        let calls = functions
            .iter()
            .map(|function| function.calls(&code))
            .max()?;
        (calls < needed.len()).then(|| format!("{look} of {needed:?}: {calls} calls"))
    });
    short.collect()
}

#[test]
fn operations_on_exact_numbers_are_listed() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let list = fs::read_to_string(root.join("crates/cli/tests/all/long_numbers.rs"));
    let mut functions = Vec::new();
    for entry in fs::read_dir(root.join("api")).expect("the lists of public names") {
        let path = entry.expect("a list").path();
        if path.extension().is_none_or(|extension| extension != "txt") {
            continue;
        }
        for line in fs::read_to_string(&path).expect("a list").lines() {
            let mut words = line.split(|c| !is_of_word(c));
            if line.contains("fn ")
                && words.any(|word| ["BigRational", "Surd", "SurdSum"].contains(&word))
            {
                functions.push(Function::parse(line));
            }
        }
    }
    let count = functions.len();
    assert!(count > 100, "functions are missing: {count}");
    let missing = missing(functions, &list.expect("the list of operations"));
    assert!(
        missing.is_empty(),
        "run these in crates/cli/tests/all/long_numbers.rs: {missing:#?}"
    );
}

#[test]
fn a_call_names_its_function() {
    let public = [
        "pub fn a::Surd::at(&self, &BigRational) -> Self",
        "pub fn a::Wave<'_>::at(&BigRational) -> Self",
        "pub const fn a::parse::tilt<T: Of<u8>>(&str) -> BigRational",
    ];
    let functions = || public.map(Function::parse).into_iter().collect();
    let all = "surd.at(&a); Wave::<f64>::at(&a); tilt(text);";
    assert_eq!(missing(functions(), all), [""; 0]);
    for (faulty, look) in [
        ("x.at; Wave::at(&a); parse::tilt(text);", ".at"),
        ("surd.at(&a); Waves::at(&a); parse::tilt(text);", "Wave::at"),
        (
            "surd.at(&a); Wave::at(&a); with_tilt(text); pile.tilt();",
            "parse::tilt",
        ),
        (
            "surd.at(&a); Wave::at(&a); \"tilt(text)\"; // tilt(text)",
            "parse::tilt",
        ),
    ] {
        let missing = missing(functions(), faulty);
        assert!(
            missing.len() == 1 && missing[0].starts_with(look),
            "{missing:?}"
        );
    }
    let by_trait = "surd.at(&a); <Wave as Field>::at(&a); tilt(text);";
    assert_eq!(missing(functions(), by_trait), [""; 0]);
    let two = ["pub fn a::X::at(&self)", "pub fn a::Y::at(&self)"];
    let two = || two.map(Function::parse).into_iter().collect();
    assert_eq!(missing(two(), "x.at(); y.at()"), [""; 0]);
    assert_eq!(missing(two(), "x.at()").len(), 1);
}
