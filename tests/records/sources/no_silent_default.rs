//! If an invariant makes a case impossible, the crates return an error that names it. They never continue with zero, an
//! empty value or a bound.
//!
//! A harmless default has a comment above it with the reason.

use super::{Source, code, is_of_word, sources};

/// The methods that take a default value.
const CALLS: [&str; 5] = [
    "unwrap_or_default",
    "unwrap_or",
    "unwrap_or_else",
    "map_or",
    "clamp",
];

/// Words that mark a value as an arbitrary default.
const ARBITRARY: [&str; 15] = [
    "MAX", "MIN", "NAN", "ZERO", "ONE", "WHOLE", "EMPTY", "None", "zero", "one", "default", "new",
    "empty", "vec", "INFINITY",
];

const REASON: &str = "// ";

/// The line numbers, from 1, of defaults that hide an impossible case without a reason.
fn silent_defaults(text: &str) -> Vec<usize> {
    let code = code(text);
    let lines: Vec<_> = text.lines().map(str::trim).collect();
    let mut found = Vec::new();
    for (at, _) in code.match_indices('.') {
        let called = code[at + 1..].trim_start();
        let name: String = called.chars().take_while(|&c| is_of_word(c)).collect();
        let Some(arguments) = called[name.len()..].strip_prefix('(') else {
            continue;
        };
        if CALLS.contains(&name.as_str()) && is_silent(&name, in_brackets(arguments)) {
            let line = code[..at].matches('\n').count();
            let above = lines[..line]
                .iter()
                .rev()
                .take_while(|line| line.starts_with("//"));
            let mut above = above.filter_map(|line| line.strip_prefix(REASON));
            if !above.any(|reason| !reason.trim().is_empty()) {
                found.push(line + 1);
            }
        }
    }
    found
}

/// Returns whether a call with these arguments uses an arbitrary default.
fn is_silent(name: &str, arguments: &str) -> bool {
    match name {
        "unwrap_or_default" | "clamp" => true,
        // The closure ignores the error.
        "unwrap_or_else" if arguments.trim_start().starts_with("|_|") => true,
        "map_or" => is_arbitrary(first_of(arguments)),
        _ => is_arbitrary(arguments),
    }
}

/// Returns whether a value is a literal, the end of a range, or a value of every type.
fn is_arbitrary(value: &str) -> bool {
    let words = value
        .split(|c| !is_of_word(c))
        .filter(|word| !word.is_empty());
    let of_it: Vec<_> = words.collect();
    // Strings are blank in the code.
    let is_literal = |word: &&&str| word.starts_with(|c: char| c.is_ascii_digit());
    let is_text = of_it.is_empty();
    let starts_literal = of_it.first().iter().any(is_literal);
    is_text || starts_literal || of_it.iter().any(|word| ARBITRARY.contains(word))
}

/// The text up to the closing bracket.
fn in_brackets(arguments: &str) -> &str {
    let mut depth = 1;
    let close = arguments.find(|c| {
        depth += i32::from("([{".contains(c)) - i32::from(")]}".contains(c));
        depth == 0
    });
    &arguments[..close.unwrap_or(arguments.len())]
}

/// The first argument, up to its comma.
fn first_of(arguments: &str) -> &str {
    let mut depth = 0;
    let comma = arguments.find(|c| {
        depth += i32::from("([{".contains(c)) - i32::from(")]}".contains(c));
        depth == 0 && c == ','
    });
    &arguments[..comma.unwrap_or(arguments.len())]
}

/// Files, options and pictures may have defaults. The crates that compute may not.
fn is_checked(source: &Source) -> bool {
    !["cli", "contact-tables", "dem", "figure", "testkit"].contains(&source.package.as_str())
}

#[test]
fn no_crate_has_a_silent_default() {
    let mut found = Vec::new();
    for source in sources().iter().filter(|source| is_checked(source)) {
        let lines = silent_defaults(&source.text);
        if !lines.is_empty() {
            found.push(format!("{}: {}: {lines:?}", source.package, source.path));
        }
    }
    assert!(found.is_empty(), "file, lines: {found:#?}");
}

#[test]
fn silent_defaults_are_found() {
    for silent in [
        "a.unwrap_or_default()",
        "a.unwrap_or(0)",
        "a.unwrap_or(0.0)",
        "a.unwrap_or((0, 1))",
        "a.unwrap_or(-1_i64)",
        "a.unwrap_or(1 << 7)",
        "a.unwrap_or(usize::MAX)",
        "a.unwrap_or(i128::MAX)",
        "a.unwrap_or(i64::MAX / 4)",
        "a.unwrap_or(usize::MAX - 1)",
        "a.unwrap_or(T::zero())",
        "a.unwrap_or(&\"N\")",
        "a.unwrap_or(\"\")",
        "a.unwrap_or(Self::WHOLE)",
        "a.unwrap_or(Self::new(f64::NAN))",
        "a.unwrap_or_else(|_| Surd::zero())",
        "a.unwrap_or_else(|_| other())",
        "a.unwrap_or_else(T::zero)",
        "a.unwrap_or_else(Vec::new)",
        "a.unwrap_or_else(|| vec![])",
        "a\n    .ok()\n    .unwrap_or(0)",
        "a.unwrap_or(\n    0,\n)",
        "a.map_or(0, |run| run.index)",
        "a.map_or(T::zero(), |(b, c)| f(b, c))",
        "a.clamp(-FAR, FAR)",
    ] {
        assert_eq!(silent_defaults(silent).len(), 1, "{silent}");
        let below =
            |comment: &str| silent_defaults(&format!("fn f() {{\n    {comment}\n    {silent}\n}}"));
        if !silent.contains("\n    .") {
            assert!(below("// Nothing is there.").is_empty(), "{silent}");
            assert!(below("// Nothing\n    // is there.").is_empty(), "{silent}");
            assert_eq!(below("//"), [3], "{silent}");
            assert_eq!(below("/// It documents."), [3], "{silent}");
            assert_eq!(below("let b = 3; // No line of its own."), [3], "{silent}");
        }
    }
}

#[test]
fn harmless_values_are_accepted() {
    for clear in [
        "a.unwrap_or(top)",
        "a.unwrap_or_else(|| self.ordinary())",
        "a.unwrap_or_else(|error| error.into_inner())",
        "a.map_or(top, |run| run.index + 1)",
        "a.map_or(row.i.end - 1, |until| until)",
        "a.map_or_else(|| f(), g)",
        "a.ok_or_else(|| bug(\"0\"))?",
        "fn unwrap_or_default() {}",
        "// a.unwrap_or(0)",
        "\"a.unwrap_or(0)\"",
        "#[cfg(test)]\nmod tests { fn f() { a.unwrap_or(0) } }",
        "a\n    // Nothing is there.\n    .unwrap_or(0)",
    ] {
        assert_eq!(silent_defaults(clear), [0; 0], "{clear}");
    }
}
