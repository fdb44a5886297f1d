//! In the root crate (the core), a module uses only modules above it in the map of `lib.rs`. In every crate, the files
//! have no dependency cycle.

use std::collections::{BTreeMap, BTreeSet};

use super::{Source, block, by_crate, code, is_of_word, sources};

/// Every module may use this one, and its variants may name types of all modules.
const ERRORS: &str = "error";

/// These items of the serialisation module are available to every type that is written.
const WRITERS: &[&str] = &["Number", "as_text", "number"];

/// Modules that may not be used although they are above: the engines must not depend on a validated pile, and the theorems
/// are about formulas only.
const FORBIDDEN: &[(&str, &[&str])] = &[
    ("engine", &["pile", "Pile"]),
    ("theorem", &["pile"]),
    ("theorem", &["engine"]),
    ("theorem", &["forces"]),
    ("theorem", &["packing"]),
    ("theorem", &["standing"]),
    ("theorem", &["census"]),
];

/// A use of one module by another that violates the map.
#[derive(Debug, PartialEq)]
struct Violation {
    /// The file.
    path: String,
    from: String,
    to: String,
    /// The path in the source, from `crate::` on.
    uses: String,
}

/// The modules of the core in the order of the map in `lib.rs`, from the second column of its table.
fn map(lib: &str, exports: &BTreeMap<String, String>) -> Vec<String> {
    let (_, map) = lib.split_once("//! # Map\n").expect("a map");
    let (map, _) = map.split_once("//! # ").expect("an end of the map");
    let mut modules = Vec::new();
    for row in map.lines().filter_map(|line| line.strip_prefix("//! |")) {
        let names = row.split('|').nth(1).expect("a second column");
        for name in names.split('`').skip(1).step_by(2) {
            let module = exports.get(name).map_or(name, String::as_str);
            if !modules.iter().any(|known| known == module) {
                modules.push(module.to_owned());
            }
        }
    }
    modules
}

/// The uses that violate the order.
fn violations_in(sources: &[Source]) -> Vec<Violation> {
    let lib = sources.iter().find(|source| source.path == "lib.rs");
    let lib = &lib.expect("a root").text;
    let exports = exports(lib);
    let map = map(lib, &exports);
    let place = |top_module: &str| map.iter().position(|module| module == top_module);
    let mut violations = Vec::new();
    // `lib.rs` re-exports names of all modules.
    for source in sources
        .iter()
        .filter(|source| ![ERRORS, "lib"].contains(&source.top_module()))
    {
        for path in paths(source) {
            let first = &path[0];
            let mut to = vec![first.as_str()];
            if place(first).is_none() && first != ERRORS {
                to = exports
                    .get(first)
                    .map_or(to, |top_module| vec![top_module, first]);
            }
            to.extend(path[1..].iter().map(String::as_str));
            let is_writer = to[0] == "data" && to.get(1).is_some_and(|name| WRITERS.contains(name));
            let forbidden = |(top_module, what): &(&str, &[&str])| {
                *top_module == source.top_module() && to.starts_with(what)
            };
            let downwards = match (place(source.top_module()), place(to[0])) {
                (Some(from), Some(to)) => to <= from,
                // A module outside the map, or an unknown name.
                _ => false,
            };
            let is_allowed = is_writer || downwards && !FORBIDDEN.iter().any(forbidden);
            if to[0] != ERRORS && !is_allowed {
                violations.push(Violation {
                    path: source.path.clone(),
                    from: source.top_module().into(),
                    to: to[0].into(),
                    uses: to.join("::"),
                });
            }
        }
    }
    violations
}

/// The names that `lib.rs` exports, with their modules.
fn exports(lib: &str) -> BTreeMap<String, String> {
    let code = code(lib);
    let mut names = BTreeMap::new();
    for (_, after) in code
        .match_indices("use ")
        .map(|(at, key)| code.split_at(at + key.len()))
    {
        for path in tree(after) {
            if let [top_module, .., name] = &path[..] {
                names.insert(name.clone(), top_module.clone());
            }
        }
    }
    names
}

/// All paths of the file that start at the root of the crate. Each leaf of a group is a path.
fn paths(source: &Source) -> Vec<Vec<String>> {
    let code = code(&source.text);
    let inner = inner_modules(&code);
    let mut paths = Vec::new();
    for (at, keyword) in words(&code) {
        let rest = &code[at..];
        let before = code[..at].trim_end();
        if before.ends_with("::") || before.ends_with("r#") {
            continue;
        }
        if keyword == "crate" {
            if let Some(after) = rest["crate".len()..].trim_start().strip_prefix("::") {
                paths.extend(tree(after));
            }
        } else if keyword == "super" {
            let mut from: Vec<String> = source.modules().into_iter().map(String::from).collect();
            from.extend(
                inner
                    .iter()
                    .filter(|(range, _)| range.contains(&at))
                    .map(|(_, name)| name.clone()),
            );
            let mut after = rest;
            while let Some(next) = after.strip_prefix("super").map(str::trim_start) {
                from.pop();
                after = next.strip_prefix("::").unwrap_or(next).trim_start();
            }
            let below = tree(after).into_iter();
            paths.extend(below.map(|path| from.iter().cloned().chain(path).collect()));
        }
    }
    paths.retain(|path: &Vec<String>| !path.is_empty());
    paths
}

/// All words with their positions.
fn words(code: &str) -> impl Iterator<Item = (usize, &str)> {
    code.split(|c| !is_of_word(c))
        .filter(|word| !word.is_empty())
        .map(|word| (word.as_ptr().addr() - code.as_ptr().addr(), word))
}

/// The inline modules of a file with their byte ranges.
fn inner_modules(code: &str) -> Vec<(std::ops::Range<usize>, String)> {
    let mut modules = Vec::new();
    for (at, _) in words(code).filter(|(_, word)| *word == "mod") {
        let rest = &code[at + "mod".len()..];
        let name: String = rest
            .trim_start()
            .chars()
            .take_while(|&c| is_of_word(c))
            .collect();
        if let Some(open) = rest
            .find(['{', ';'])
            .filter(|&open| rest[open..].starts_with('{'))
        {
            let start = at + "mod".len() + open;
            modules.push((start..start + block(&code[start..]), name));
        }
    }
    modules
}

/// The paths that start here: `a::{b, c::d}` contains `a::b` and `a::c::d`.
fn tree(code: &str) -> Vec<Vec<String>> {
    let code = code.trim_start();
    if let Some(inside) = code.strip_prefix('{') {
        let inside = &inside[..block(code).saturating_sub(2)];
        return branches(inside).into_iter().flat_map(tree).collect();
    }
    let name: String = code.chars().take_while(|&c| is_of_word(c)).collect();
    let after = code[name.len()..].trim_start().strip_prefix("::");
    let below = after
        .map(str::trim_start)
        .filter(|after| !after.starts_with('<'))
        .map(tree);
    if name.is_empty() || name == "self" {
        return vec![vec![]];
    }
    let below = below.unwrap_or_else(|| vec![vec![]]).into_iter();
    below
        .map(|path| [vec![name.clone()], path].concat())
        .collect()
}

/// The elements of a group, separated by commas.
fn branches(inside: &str) -> Vec<&str> {
    let (mut depth, mut start) = (0, 0);
    let mut parts = Vec::new();
    for (at, c) in inside.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(&inside[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&inside[start..]);
    parts.retain(|part| !part.trim().is_empty());
    parts
}

/// The dependency cycles of sibling files that are `depth` modules below the root of a crate. Uses of the parent file and of
/// the error module do not count.
fn cycles(sources: &[Source], depth: usize) -> Vec<BTreeSet<String>> {
    let here = |path: &[String]| Some(path.get(..depth)?.join("/")).filter(|file| file != ERRORS);
    let of_source = |source: &Source| {
        let modules: Vec<_> = source.modules().into_iter().map(String::from).collect();
        here(&modules)
    };
    let files: BTreeSet<String> = sources.iter().filter_map(of_source).collect();
    let mut uses: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for source in sources {
        let Some(file) = of_source(source) else {
            continue;
        };
        let used = paths(source).into_iter().filter_map(|path| here(&path));
        let used = used.filter(|used| files.contains(used) && *used != file);
        uses.entry(file.clone()).or_default().extend(used);
    }
    let reached = |from: &String| {
        let mut reached = BTreeSet::new();
        let mut next: Vec<&String> = uses.get(from).into_iter().flatten().collect();
        while let Some(file) = next.pop() {
            if reached.insert(file.clone()) {
                next.extend(uses.get(file).into_iter().flatten());
            }
        }
        reached
    };
    let parent = |file: &str| file.rsplit_once('/').map(|(parent, _)| parent.to_owned());
    let mut cycles: Vec<BTreeSet<String>> = Vec::new();
    for file in &files {
        let back = |other: &&String| parent(other) == parent(file) && reached(other).contains(file);
        let cycle: BTreeSet<String> = reached(file).iter().filter(back).cloned().collect();
        if cycle.contains(file) && !cycles.contains(&cycle) {
            cycles.push(cycle);
        }
    }
    cycles
}

#[test]
fn modules_use_only_those_above() {
    let mut sources = sources();
    sources.retain(|source| source.package == "core");
    let violations = violations_in(&sources);
    assert!(violations.is_empty(), "{violations:#?}");
}

#[test]
fn files_have_no_dependency_cycle() {
    for sources in by_crate(&sources()) {
        for depth in [1, 2] {
            // The modules of the core are already ordered, except for the serialisation module.
            let cycles = cycles(sources, depth);
            if depth > 1 || sources[0].package != "core" {
                assert!(cycles.is_empty(), "{}: {cycles:#?}", sources[0].package);
            }
        }
    }
}

/// The root file of each crate is short enough to read.
#[test]
fn roots_are_short() {
    for source in sources().iter().filter(|source| source.path == "lib.rs") {
        let lines = source.text.lines().count();
        assert!(lines < 200, "{}: {lines} lines", source.package);
    }
}

/// The map lists every module of the core once.
#[test]
fn the_map_is_complete() {
    let sources = sources();
    let lib = sources.iter().find(|source| source.path == "lib.rs");
    let lib = &lib.expect("a root of the core").text;
    let mut map = map(lib, &exports(lib));
    map.sort();
    let code = code(lib);
    let modules = words(&code).filter(|(_, word)| *word == "mod");
    let modules = modules.filter_map(|(at, word)| {
        let name = code[at + word.len()..].trim_start();
        let name: String = name.chars().take_while(|&c| is_of_word(c)).collect();
        // This module contains only text.
        (name != "paper").then_some(name)
    });
    let mut modules: Vec<_> = modules.collect();
    modules.sort();
    assert_eq!(map, modules);
}

/// The violations in one file of a module, for a given `lib.rs`.
fn violations_of(path: &str, text: &str) -> Vec<String> {
    let lib = Source::new(
        "lib.rs",
        "//! # Map\n\
         //! | numbers | [`scalar`] | |\n\
         //! | places | [`lattice`] | |\n\
         //! | | [`shape`], [`geometry`] | |\n\
         //! | physics | [`formula`] | |\n\
         //! | | [`Pile`] | |\n\
         //! | answers | `engine` | |\n\
         //! | | [`Forces`], `packing` | |\n\
         //! | | [`theorem`] | |\n\
         //! | tools | [`data`] | |\n\
         //! # Guarantees\n\
         pub use pile::Pile;\npub use forces::{ContactForce, Forces};",
    );
    let violations = violations_in(&[lib, Source::new(path, text)]);
    violations
        .into_iter()
        .map(|violation| violation.uses)
        .collect()
}

#[test]
fn violations_are_found() {
    for (path, text, wrong) in [
        ("pile.rs", "use crate::forces::Forces;", "forces::Forces"),
        ("pile/load.rs", "use crate::{Error, Forces};", ""),
        (
            "pile/load.rs",
            "use crate::{\n    Pile,\n    Forces,\n};",
            "forces::Forces",
        ),
        (
            "pile.rs",
            "fn f() { crate::engine::plan::f::<u8>() }",
            "engine::plan::f",
        ),
        (
            "pile.rs",
            "macro_rules! m { () => { $crate::packing::f() } }",
            "packing::f",
        ),
        (
            "scalar/surd.rs",
            "use crate::{scalar::Ring, lattice::{Site, Sign as S}};",
            "lattice::Site lattice::Sign",
        ),
        (
            "shape/rows.rs",
            "use super::super::pile::System;",
            "pile::System",
        ),
        (
            "shape/rows.rs",
            "mod a { use super::super::super::{pile, shape}; }",
            "pile",
        ),
        ("shape.rs", "impl super::Pile { }", "pile::Pile"),
        (
            "lattice.rs",
            "#[serde(with = \"crate::data::number\")] struct A;",
            "",
        ),
        (
            "lattice.rs",
            "#[serde(with = \"crate::data::listed\")] struct A;",
            "data::listed",
        ),
        ("lattice.rs", "pub(in crate::lattice) fn f() {}", ""),
        ("lattice.rs", "use crate::lattice::{self, row};", ""),
        (
            "engine/plan.rs",
            "use crate::pile::{System, Pile};",
            "pile::Pile",
        ),
        ("engine/plan.rs", "use crate::Pile;", "pile::Pile"),
        (
            "theorem/base.rs",
            "use crate::formula::floor; use crate::engine::Lines;",
            "engine::Lines",
        ),
        (
            "forces.rs",
            "use crate::{ContactForce, lattice::Site, pile::Pile, engine, error::bug};",
            "",
        ),
        ("forces.rs", "use crate::unknown::Name;", "unknown::Name"),
        ("unknown.rs", "use crate::lattice::Site;", "lattice::Site"),
        ("error.rs", "use crate::forces::Forces;", ""),
        (
            "pile.rs",
            "// crate::forces\n#[cfg(test)]\nmod tests { use crate::forces::Forces; }",
            "",
        ),
        (
            "pile.rs",
            "/// [`crate::forces`]\nconst A: &str = \"see crate::forces\";",
            "",
        ),
    ] {
        let mut wrong: Vec<_> = wrong.split_whitespace().collect();
        if text.contains("{Error") {
            // The test's `lib.rs` does not export `Error`, so the name is unknown.
            wrong = vec!["Error", "forces::Forces"];
        }
        assert_eq!(violations_of(path, text), wrong, "{path}: {text}");
    }
}

#[test]
fn cycles_are_found() {
    let file = Source::new;
    let top_module = file("pile.rs", "mod a; mod b; mod c; mod d; pub use a::A;");
    let straight = |last: &str| {
        let a = file("pile/a.rs", "use super::b::B; use super::A;");
        let b = file("pile/b.rs", "use crate::pile::{self, c::C};");
        vec![
            file(&top_module.path, &top_module.text),
            a,
            b,
            file("pile/c.rs", last),
            file("pile/d.rs", "use super::a::A;"),
        ]
    };
    assert!(cycles(&straight("use super::System;"), 2).is_empty());
    let cycle = BTreeSet::from(["pile/a", "pile/b", "pile/c"].map(String::from));
    assert_eq!(cycles(&straight("fn f() { super::a::f() }"), 2), [cycle]);
    // Two files in the root of a crate. The error module may name all of them.
    let below = |a: &str, error: &str| {
        let files = [
            ("a.rs", a),
            ("b.rs", "use crate::a::A;"),
            ("error.rs", error),
        ];
        cycles(&files.map(|(path, text)| Source::of("dem", path, text)), 1)
    };
    assert!(below("use crate::error::Error;", "use crate::a::A;").is_empty());
    let cycle = BTreeSet::from(["a", "b"].map(String::from));
    assert_eq!(below("use crate::b::B;", ""), [cycle]);
}
