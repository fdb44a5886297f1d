//! Each room uses the rooms above it in the list, never one below.

use std::collections::{BTreeMap, BTreeSet};

use super::{Source, block, code, is_of_word, sources};

/// The rooms, storey by storey.
const STOREYS: &[(&str, &[&str])] = &[
    ("numbers", &["scalar"]),
    ("places", &["lattice", "stacking", "shape", "geometry"]),
    ("physics", &["formula", "pile"]),
    (
        "answers",
        &[
            "engine",
            "forces",
            "packing",
            "standing",
            "census",
            "certificate",
            "horizontal",
            "disorder",
            "theorem",
        ],
    ),
    (
        "tools",
        &[
            "scene", "table", "dem", "verify", "figure", "proof", "serde", "main",
        ],
    ),
];

/// All rooms may use it, and it may name what is in all of them.
const ROOF: &str = "error";

/// What a room may not use although it stands above: engines know no validated pile, and what is proved is proved of
/// formulas.
const FORBIDDEN: &[(&str, &[&str])] = &[
    ("engine", &["pile", "Pile"]),
    ("theorem", &["pile"]),
    ("theorem", &["engine"]),
    ("theorem", &["forces"]),
    ("theorem", &["packing"]),
    ("theorem", &["standing"]),
    ("theorem", &["census"]),
];

/// Whether the room is of the core: all that is no tool.
pub(super) fn is_of_core(room: &str) -> bool {
    place(room).is_some_and(|at| Some(at) < place("scene"))
}

/// A use of one room by another that the table does not allow.
#[derive(Debug, PartialEq)]
struct Arrow {
    /// The file.
    path: String,
    from: String,
    to: String,
    /// As it was found: `crate::` and so on.
    uses: String,
}

/// The place of a room in the list.
fn place(room: &str) -> Option<usize> {
    STOREYS
        .iter()
        .flat_map(|(_, rooms)| *rooms)
        .position(|of_list| *of_list == room)
}

/// The arrows that run back, and what they should not have found.
fn arrows_back(sources: &[Source]) -> Vec<Arrow> {
    let front_door = front_door(sources);
    let mut arrows = Vec::new();
    // `lib.rs` is the front door, and opens into all rooms.
    for source in sources
        .iter()
        .filter(|source| ![ROOF, "lib"].contains(&source.room()))
    {
        for path in paths(source) {
            let first = &path[0];
            let mut to = vec![first.as_str()];
            if place(first).is_none() && first != ROOF {
                to = front_door.get(first).map_or(to, |room| vec![room, first]);
            }
            to.extend(path[1..].iter().map(String::as_str));
            if to[0] != ROOF && !is_allowed(source.room(), &to) {
                arrows.push(Arrow {
                    path: source.path.clone(),
                    from: source.room().into(),
                    to: to[0].into(),
                    uses: to.join("::"),
                });
            }
        }
    }
    arrows
}

fn is_allowed(from: &str, to: &[&str]) -> bool {
    let forbidden = |(room, what): &(&str, &[&str])| *room == from && to.starts_with(what);
    let downwards = match (place(from), place(to[0])) {
        (Some(from), Some(to)) => to <= from,
        // A room that is not in the table, or a name that nobody knows.
        _ => false,
    };
    downwards && !FORBIDDEN.iter().any(forbidden)
}

/// What `lib.rs` lets out, by name, with the room it comes from.
fn front_door(sources: &[Source]) -> BTreeMap<String, String> {
    let root = sources.iter().find(|source| source.path == "lib.rs");
    let code = root.map(|root| code(&root.text)).unwrap_or_default();
    let mut names = BTreeMap::new();
    for (_, after) in code
        .match_indices("use ")
        .map(|(at, key)| code.split_at(at + key.len()))
    {
        for path in tree(after) {
            if let [room, .., name] = &path[..] {
                names.insert(name.clone(), room.clone());
            }
        }
    }
    names
}

/// Every path of the file from the root of the crate: each leaf of a group is one.
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
                let of_binary = (source.room() == "main").then(|| "main".to_owned());
                let below = tree(after).into_iter();
                paths.extend(below.map(|path| of_binary.iter().cloned().chain(path).collect()));
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

/// Each word, with where it starts.
fn words(code: &str) -> impl Iterator<Item = (usize, &str)> {
    code.split(|c| !is_of_word(c))
        .filter(|word| !word.is_empty())
        .map(|word| (word.as_ptr().addr() - code.as_ptr().addr(), word))
}

/// The modules written out in a file, with the bytes they reach over.
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

/// The paths that start here: `a::{b, c::d}` is `a::b` and `a::c::d`.
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

/// The parts of a group, at its commas.
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

/// The circles of files within each room, by the names of the files: what they take of one another, not of the room's
/// own file, which gathers them.
fn circles(sources: &[Source]) -> Vec<BTreeSet<String>> {
    let files: BTreeSet<String> = sources
        .iter()
        .filter_map(|source| Some(source.modules().get(..2)?.join("/")))
        .collect();
    let mut uses: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for source in sources {
        let modules = source.modules();
        let Some(file) = modules.get(..2).map(|modules| modules.join("/")) else {
            continue;
        };
        let used = paths(source)
            .into_iter()
            .filter_map(|path| Some(path.get(..2)?.join("/")));
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
    let of_room = |file: &str| file.split('/').next().unwrap_or_default().to_owned();
    let mut circles: Vec<BTreeSet<String>> = Vec::new();
    for file in &files {
        let back =
            |other: &&String| of_room(other) == of_room(file) && reached(other).contains(file);
        let circle: BTreeSet<String> = reached(file).iter().filter(back).cloned().collect();
        if circle.contains(file) && !circles.contains(&circle) {
            circles.push(circle);
        }
    }
    circles
}

#[test]
fn each_room_uses_those_above_it() {
    let arrows = arrows_back(&sources());
    assert!(arrows.is_empty(), "{arrows:#?}");
}

#[test]
fn no_circle_of_files_in_a_room() {
    let circles = circles(&sources());
    assert!(circles.is_empty(), "{circles:#?}");
}

/// What one file of a room is found to use wrongly, beside a front door.
fn planted(path: &str, text: &str) -> Vec<String> {
    let door = Source::new(
        "lib.rs",
        "pub use pile::Pile;\npub use forces::{ContactForce, Forces};",
    );
    let arrows = arrows_back(&[door, Source::new(path, text)]);
    arrows.into_iter().map(|arrow| arrow.uses).collect()
}

#[test]
fn planted_arrows_back_are_found() {
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
            "#[serde(with = \"crate::serde::number\")] struct A;",
            "serde::number",
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
        ("forces.rs", "use crate::cellar::Wine;", "cellar::Wine"),
        ("cellar.rs", "use crate::lattice::Site;", "lattice::Site"),
        ("error.rs", "use crate::figure::Figure;", ""),
        (
            "main/base.rs",
            "use crate::options::Options; use super::main; use cannonpile::Pile;",
            "",
        ),
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
            // Not let out by the planted front door: a name that nobody knows.
            wrong = vec!["Error", "forces::Forces"];
        }
        assert_eq!(planted(path, text), wrong, "{path}: {text}");
    }
}

#[test]
fn planted_circles_of_files_are_found() {
    let file = Source::new;
    let room = file("pile.rs", "mod a; mod b; mod c; mod d; pub use a::A;");
    let straight = |last: &str| {
        let a = file("pile/a.rs", "use super::b::B; use super::A;");
        let b = file("pile/b.rs", "use crate::pile::{self, c::C};");
        vec![
            file(&room.path, &room.text),
            a,
            b,
            file("pile/c.rs", last),
            file("pile/d.rs", "use super::a::A;"),
        ]
    };
    assert!(circles(&straight("use super::System;")).is_empty());
    let circle = BTreeSet::from(["pile/a", "pile/b", "pile/c"].map(String::from));
    assert_eq!(circles(&straight("fn f() { super::a::f() }")), [circle]);
}
