//! The proofs cover the code that runs. Every formula in a theorem is called by an engine or a query, and every formula of
//! the crate occurs in a theorem.

use std::collections::BTreeSet;

use super::{Source, code, is_of_word, sources};

/// The formulas in the theorems of a crate.
const FORMULAS: &str = "theorem/formulas.rs";

/// All occurrences of `name` as a whole word: the text before it, and the text after.
fn places<'t>(text: &'t str, name: &str) -> impl Iterator<Item = (&'t str, &'t str)> {
    let ends = text
        .match_indices(name)
        .map(|(at, word)| (at, at + word.len()));
    let places: Vec<_> = ends.map(|(at, end)| (&text[..at], &text[end..])).collect();
    places
        .into_iter()
        .filter(|(before, after)| !before.ends_with(is_of_word) && !after.starts_with(is_of_word))
}

/// Pairs such as (`count`, `above`) from the rows `field: module::function,` of `Formulas::LIBRARY`, without the formulas of
/// other crates.
fn proved(formulas: &str) -> BTreeSet<(String, String)> {
    let code = code(formulas);
    let library = code
        .split("LIBRARY: Self = Self {")
        .nth(1)
        .expect("the library's formulas");
    let library = library.split('}').next().unwrap_or(library);
    let rows = library.lines().filter_map(|row| row.split_once(": "));
    let rows = rows.filter(|(field, _)| field.trim() != "core");
    let paths = rows.map(|(_, path)| path.trim_end_matches(',').split("::<").next());
    let paths = paths.filter_map(|path| path?.rsplit_once("::"));
    paths
        .map(|(module, name)| (module.to_owned(), name.to_owned()))
        .collect()
}

/// Returns whether a file calls a function: as `module::name`, as a method, after an import, or in the module itself.
fn calls(file: &str, code: &str, (module, is_home): (&str, bool), name: &str) -> bool {
    let home = format!("/{module}.rs");
    let own = format!("/{file}").ends_with(&home) || file.starts_with(&format!("{module}/"));
    let own = own && is_home;
    let import = format!("{module}::{{");
    let imported = code.split(&import).skip(1).any(|list| {
        let list = list.split('}').next().unwrap_or(list);
        places(list, name).next().is_some()
    });
    let is_call = |(before, after): (&str, &str)| {
        let before = before.trim_end();
        let called = after.starts_with('(') || after.starts_with("::<");
        let is_type = module.starts_with(char::is_uppercase);
        before.ends_with(&format!("{module}::")) && !after.starts_with("::{")
            || is_type && before.ends_with('.') && called
            || own && called && !before.ends_with("fn") && !before.ends_with('.')
    };
    imported || places(code, name).any(is_call)
}

/// The proved formulas of a crate without a call in any crate, and the formulas of the crate without a proof.
fn missing(sources: &[Source], package: &str) -> Vec<String> {
    let is_here = |source: &Source| source.package == package;
    let formulas = sources
        .iter()
        .find(|source| is_here(source) && source.path == FORMULAS);
    let proved = proved(&formulas.expect("the formulas").text);
    assert!(!proved.is_empty(), "no formulas");
    let outside = sources
        .iter()
        .filter(|source| source.top_module() != "theorem");
    // These crates handle formulas but do not compute answers with them.
    let outside = outside.filter(|source| !["proof", "testkit"].contains(&source.package.as_str()));
    let outside: Vec<_> = outside
        .map(|source| {
            let file = source.path.as_str();
            (file, is_here(source), code(&source.text))
        })
        .collect();
    let not_called = proved.iter().filter(|(module, name)| {
        let called = |(file, is_here, code): &(&str, bool, String)| {
            calls(file, code, (module, *is_here), name)
        };
        !outside.iter().any(called)
    });
    let mut missing: Vec<_> = not_called
        .map(|(module, name)| format!("{module}::{name} is proved and never called"))
        .collect();
    for (file, _, code) in outside.iter().filter(|(_, is_here, _)| *is_here) {
        let module = match *file {
            "lattice/count.rs" => "count",
            _ if file.starts_with("formula") => "formula",
            _ => continue,
        };
        for function in code.split("pub fn ").skip(1) {
            let name: String = function.chars().take_while(|c| is_of_word(*c)).collect();
            if !proved.contains(&(module.to_owned(), name.clone())) {
                missing.push(format!("{module}::{name} is a formula and not proved"));
            }
        }
    }
    missing
}

#[test]
fn proved_formulas_are_called() {
    let sources = sources();
    let mut crates = sources.iter().filter(|source| source.path == FORMULAS);
    for package in ["core", "disorder", "horizontal"] {
        let formulas = crates.next().map(|source| source.package.as_str());
        assert_eq!(formulas, Some(package));
        assert_eq!(missing(&sources, package), Vec::<String>::new());
    }
    assert!(crates.next().is_none());
}

/// A small library: its proved formulas, their definitions, and an engine.
fn small(library: &str, formula: &str, engine: &str) -> Vec<Source> {
    let formulas = format!("const LIBRARY: Self = Self {{\n{library}\n}};");
    [
        ("theorem/formulas.rs", formulas.as_str()),
        (
            "theorem/sums.rs",
            "use crate::formula::{force, turn};\nformula::force(n); formula::turn(g);",
        ),
        ("formula.rs", formula),
        ("engine.rs", engine),
    ]
    .map(|(path, text)| Source::new(path, text))
    .into()
}

#[test]
fn missing_calls_and_proofs_are_found() {
    let both = "force: formula::force,\nturn: formula::turn::<P>,";
    let formula = "pub fn force(n: T) {}\npub fn turn<T>(g: T) {}";
    let not_called = vec!["formula::turn is proved and never called"];
    for (engine, expected) in [
        ("formula::force(n); formula::turn::<T>(g)", vec![]),
        ("use crate::formula::{force,\n turn};", vec![]),
        ("formula::force(n)", not_called.clone()),
        ("formula::force(n) // formula::turn(g)", not_called.clone()),
        (
            "/// [`formula::turn`]\nformula::force(n)",
            not_called.clone(),
        ),
        (
            "formula::force(n)\n#[cfg(test)]\nmod tests { formula::turn(g) }",
            not_called.clone(),
        ),
        (
            "formula::force(n); formula::turned(g); return_turn(g); turn(g)",
            not_called.clone(),
        ),
    ] {
        assert_eq!(
            missing(&small(both, formula, engine), "core"),
            expected,
            "{engine}"
        );
    }
    // A call by another formula counts as a call. A mere definition does not.
    let chained = "pub fn force(n: T) { turn(n) }\npub fn turn<T>(g: T) {}";
    assert!(missing(&small(both, chained, "formula::force(n)"), "core").is_empty());
    let unproved = missing(
        &small("force: formula::force,", formula, "formula::force(n)"),
        "core",
    );
    assert_eq!(unproved, ["formula::turn is a formula and not proved"]);
    // The sources without one of the functions that the library calls.
    let mut sources = sources();
    for source in &mut sources {
        let called = match source.path.as_str() {
            "formula/turn.rs" => "= tripled_apart(g)",
            "engine/limbs.rs" => "tripled_apart",
            _ => continue,
        };
        source.text = source.text.replace(called, "another");
    }
    assert_eq!(
        missing(&sources, "core"),
        ["formula::tripled_apart is proved and never called"]
    );
}
