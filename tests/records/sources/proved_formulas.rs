//! The proofs cover the code that runs. Every formula in a theorem is called by an engine or a query of some crate, and
//! every formula of any crate occurs in a theorem.

use std::collections::BTreeSet;

use super::{Source, code, is_of_word, sources};

/// The files with the formulas in the theorems: package and path.
const FORMULAS: [(&str, &str); 2] = [("core", "theorem/formulas.rs"), ("proof", "formulas.rs")];

/// A formula: its package, module and name, such as (`core`, `count`, `above`).
type Formula = (String, String, String);

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

/// The formulas in the rows `field: module::function,` of `Formulas::LIBRARY`. A path of another crate begins with its name,
/// such as `cannonpile_horizontal`.
fn proved(package: &str, formulas: &str) -> BTreeSet<Formula> {
    let code = code(formulas);
    let library = code
        .split("LIBRARY: Self = Self {")
        .nth(1)
        .expect("the library's formulas");
    let library = library.split('}').next().unwrap_or(library);
    let rows = library.lines().filter_map(|row| row.split_once(": "));
    // The formulas of the core, as a whole.
    let rows = rows.filter(|(field, _)| field.trim() != "core");
    let paths = rows.map(|(_, path)| path.trim_end_matches(',').split("::<").next());
    let paths = paths.filter_map(|path| path?.rsplit_once("::"));
    paths
        .map(|(module, name)| {
            let (package, module) = module
                .strip_prefix("cannonpile_")
                .and_then(|path| path.split_once("::"))
                .unwrap_or((package, module));
            (package.to_owned(), module.to_owned(), name.to_owned())
        })
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

/// The formulas in all theorems.
fn all_proved(sources: &[Source]) -> BTreeSet<Formula> {
    let listed = sources
        .iter()
        .filter(|source| FORMULAS.contains(&(source.package.as_str(), source.path.as_str())));
    listed
        .flat_map(|source| proved(&source.package, &source.text))
        .collect()
}

/// The proved formulas without a call in any crate, and the formulas without a proof.
fn missing(sources: &[Source]) -> Vec<String> {
    let proved = all_proved(sources);
    assert!(!proved.is_empty(), "no formulas");
    let outside = sources
        .iter()
        .filter(|source| source.top_module() != "theorem")
        // These crates handle formulas but do not compute answers with them.
        .filter(|source| !["proof", "testkit"].contains(&source.package.as_str()));
    let outside: Vec<_> = outside.map(|source| (source, code(&source.text))).collect();
    let not_called = proved.iter().filter(|(package, module, name)| {
        let called = |(source, code): &(&Source, String)| {
            calls(
                &source.path,
                code,
                (module.as_str(), source.package == *package),
                name,
            )
        };
        !outside.iter().any(called)
    });
    let mut missing: Vec<_> = not_called
        .map(|(package, module, name)| {
            format!("{package}: {module}::{name} is proved and never called")
        })
        .collect();
    for (Source { package, path, .. }, code) in &outside {
        let module = match path.as_str() {
            "lattice/count.rs" => "count",
            _ if path.starts_with("formula") => "formula",
            _ => continue,
        };
        for function in code.split("pub fn ").skip(1) {
            let name: String = function.chars().take_while(|c| is_of_word(*c)).collect();
            if !proved.contains(&(package.clone(), module.to_owned(), name.clone())) {
                missing.push(format!(
                    "{package}: {module}::{name} is a formula and not proved"
                ));
            }
        }
    }
    missing
}

#[test]
fn proved_formulas_are_called() {
    let sources = sources();
    assert_eq!(missing(&sources), Vec::<String>::new());
    let proved = all_proved(&sources).into_iter();
    let packages: BTreeSet<_> = proved.map(|(package, ..)| package).collect();
    assert!(packages.iter().eq(["core", "disorder", "horizontal"]));
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
    let not_called = vec!["core: formula::turn is proved and never called"];
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
        assert_eq!(missing(&small(both, formula, engine)), expected, "{engine}");
    }
    // A call by another formula counts as a call. A mere definition does not.
    let chained = "pub fn force(n: T) { turn(n) }\npub fn turn<T>(g: T) {}";
    assert!(missing(&small(both, chained, "formula::force(n)")).is_empty());
    let unproved = missing(&small(
        "force: formula::force,",
        formula,
        "formula::force(n)",
    ));
    assert_eq!(
        unproved,
        ["core: formula::turn is a formula and not proved"]
    );
    // A formula of another crate, which the crate of proofs lists.
    let mut other = small(both, chained, "formula::force(n)");
    let library = "const LIBRARY: Self = Self {\ncore: cannonpile::theorem::Formulas::LIBRARY,\n\
                   drop: cannonpile_horizontal::formula::drop,\n};";
    other.extend([
        Source::of("proof", "formulas.rs", library),
        Source::of(
            "proof",
            "recorded.rs",
            "cannonpile_horizontal::formula::drop(x)",
        ),
        Source::of(
            "horizontal",
            "formula.rs",
            "pub fn drop(x: T) {}\npub fn rise(x: T) {}",
        ),
    ]);
    assert_eq!(
        missing(&other),
        [
            "horizontal: formula::drop is proved and never called",
            "horizontal: formula::rise is a formula and not proved"
        ]
    );
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
        missing(&sources),
        ["core: formula::tripled_apart is proved and never called"]
    );
}
