//! Rules for the sources of all crates that Cargo does not check: an error instead of a default for impossible cases, a
//! proof of every formula, and short roots. `.ci/circles` checks the dependencies between files.
//!
//! The checks are textual. They recognise enough of Rust to skip comments, strings and unit tests. A test shows that each
//! check rejects invalid text.

mod comparisons;
mod long_numbers;
mod no_silent_default;
mod proved_formulas;

use std::fs;
use std::path::Path;

/// A source file of a crate.
struct Source {
    /// The folder of the crate in `crates`, or `core` for the root crate.
    package: String,
    /// The path from `src`, with slashes: `scalar/fixed.rs`.
    path: String,
    text: String,
}

impl Source {
    /// Returns a file of the root crate.
    fn new(path: &str, text: &str) -> Self {
        Self::of("core", path, text)
    }

    fn of(package: &str, path: &str, text: &str) -> Self {
        let [package, path, text] = [package, path, text].map(String::from);
        Self {
            package,
            path,
            text,
        }
    }

    /// The top-level module of this file: `scalar`; `lib` for `lib.rs`.
    fn top_module(&self) -> &str {
        let path = self.path.strip_suffix(".rs").unwrap_or(&self.path);
        path.split('/').next().unwrap_or(path)
    }
}

/// The sources of all crates, ordered by path.
fn sources() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut sources = sources_of("core", &root.join("src"));
    assert!(sources.len() > 80, "sources are missing: {}", sources.len());
    let crates = fs::read_dir(root.join("crates")).expect("the folder of crates");
    let mut crates: Vec<_> = crates
        .map(|entry| entry.expect("a crate").path())
        .filter(|path| path.join("Cargo.toml").exists())
        .collect();
    crates.sort();
    assert!(crates.len() > 7, "crates are missing: {crates:?}");
    for path in crates {
        let name = path.file_name().expect("a name").to_string_lossy();
        sources.extend(sources_of(&name, &path.join("src")));
    }
    sources
}

/// The sources of one crate.
fn sources_of(package: &str, root: &Path) -> Vec<Source> {
    let mut sources = Vec::new();
    let mut folders = vec![root.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder of sources") {
            let path = entry.expect("an entry of a folder").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = fs::read_to_string(&path).expect("a source");
                let parts = path.strip_prefix(root).expect("below src").components();
                let parts: Vec<_> = parts
                    .map(|part| part.as_os_str().to_string_lossy())
                    .collect();
                sources.push(Source::of(package, &parts.join("/"), &text));
            }
        }
    }
    sources.sort_by(|a, b| a.path.cmp(&b.path));
    sources
}

/// Replaces each character of comments, literals and unit tests by a space. Lines keep their numbers.
///
fn code(text: &str) -> String {
    without_tests(&without_literals(text))
}

/// Removes comments and literals.
fn without_literals(text: &str) -> String {
    let text: Vec<char> = text.chars().collect();
    let mut code = String::new();
    let mut at = 0;
    while at < text.len() {
        let (length, stays) = lexeme(&text[at..]);
        let of_it = &text[at..at + length];
        code.extend(
            of_it
                .iter()
                .map(|&c| if stays || c == '\n' { c } else { ' ' }),
        );
        at += length;
    }
    code
}

/// The length of the word, comment, literal or character at the start, and whether it is code.
fn lexeme(text: &[char]) -> (usize, bool) {
    let starts = |with: &str| {
        with.chars()
            .enumerate()
            .all(|(n, c)| text.get(n) == Some(&c))
    };
    if starts("//") {
        let end = text.iter().position(|&c| c == '\n');
        return (end.unwrap_or(text.len()), false);
    }
    if starts("/*") {
        return (block_comment(text), false);
    }
    if text[0] == '"' {
        return (until_quote(text, 1), false);
    }
    if text[0] == '\'' {
        return character(text);
    }
    if is_of_word(text[0]) {
        let word = text.iter().take_while(|&&c| is_of_word(c)).count();
        let prefix: String = text[..word].iter().collect();
        let hashes = text[word..].iter().take_while(|&&c| c == '#').count();
        return match prefix.as_str() {
            "r" | "br" | "cr" if text.get(word + hashes) == Some(&'"') => {
                let close: Vec<char> = format!("\"{}", "#".repeat(hashes)).chars().collect();
                let inside = &text[word + hashes + 1..];
                let end = inside.windows(close.len()).position(|at| at == close);
                let length = end.map_or(text.len(), |end| word + 2 * hashes + 2 + end);
                (length, false)
            }
            "b" | "c" if text.get(word) == Some(&'"') => (until_quote(text, word + 1), false),
            _ => (word, true),
        };
    }
    (1, true)
}

fn is_of_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// The length from the start of a literal's content to its closing quote, inclusive.
fn until_quote(text: &[char], content: usize) -> usize {
    let mut at = content;
    while at < text.len() && text[at] != '"' {
        at += if text[at] == '\\' { 2 } else { 1 };
    }
    (at + 1).min(text.len())
}

/// A character literal, or the tick of a lifetime.
fn character(text: &[char]) -> (usize, bool) {
    let content = if text.get(1) == Some(&'\\') { 2 } else { 1 };
    let rest = text.get(content + 1..).unwrap_or_default();
    match rest.iter().position(|&c| c == '\'') {
        // '\u{1f600}' is the longest.
        Some(end) if end == 0 || content == 2 && end < 10 => (content + end + 2, false),
        _ => (1, true),
    }
}

/// Block comments can be nested.
fn block_comment(text: &[char]) -> usize {
    let (mut depth, mut at) = (0, 0);
    loop {
        match text.get(at..at + 2) {
            Some(['/', '*']) => (depth, at) = (depth + 1, at + 2),
            Some(['*', '/']) => (depth, at) = (depth - 1, at + 2),
            Some(_) => at += 1,
            None => return text.len(),
        }
        if depth == 0 {
            return at;
        }
    }
}

/// Removes the code that is compiled only for tests.
fn without_tests(code: &str) -> String {
    let mut code = code.to_owned();
    while let Some(start) = code.find("#[cfg(test)]") {
        let item = &code[start..];
        let end = match item.find(['{', ';']) {
            Some(at) if item[at..].starts_with('{') => at + block(&item[at..]),
            Some(at) => at + 1,
            None => item.len(),
        };
        let blank: String = item[..end]
            .chars()
            .map(|c| if c == '\n' { c } else { ' ' })
            .collect();
        code.replace_range(start..start + end, &blank);
    }
    code
}

/// The length of the block in braces that starts here.
fn block(code: &str) -> usize {
    let mut depth = 0;
    for (at, c) in code.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return at + 1;
        }
    }
    code.len()
}

#[test]
fn code_is_separated_from_comments_and_literals() {
    let text = r##"use a; // use b
/* use c; /* use d; */ use e; */ use f;
const TEXT: &str = "use g; \" // no comment";
const RAW: &str = r#"use h; " "#;
fn of<'a>(tick: &'a str) -> char { '"' } // "
fn quote() -> [char; 3] { ['\'', '\u{22}', 'x'] }
#[cfg(test)]
mod tests { fn one() { { use i; } } }
#[cfg(test)]
use j;
use k;"##;
    let code = code(text);
    for (name, is_code) in "a b c d e f g h i j k"
        .split(' ')
        .zip("ynnnnynnnny".chars())
    {
        let found = code.contains(&format!("use {name}"));
        assert_eq!(found, is_code == 'y', "{name}: {code}");
    }
    assert!(
        code.contains("fn of<'a>(tick: &'a str) -> char {"),
        "{code}"
    );
    let lines = |text: &str| text.lines().count();
    assert_eq!(lines(&code), lines(text));
    assert_eq!(
        code.lines().nth(5),
        Some("fn quote() -> [char; 3] { [    ,         ,    ] }")
    );
}

/// The root file of each crate is short enough to read.
#[test]
fn roots_are_short() {
    for source in sources().iter().filter(|source| source.path == "lib.rs") {
        let lines = source.text.lines().count();
        assert!(lines < 200, "{}: {lines} lines", source.package);
    }
}

#[test]
fn files_belong_to_top_modules() {
    for (path, top_module) in [
        ("lib.rs", "lib"),
        ("verdict.rs", "verdict"),
        ("scalar/fixed.rs", "scalar"),
    ] {
        assert_eq!(Source::new(path, "").top_module(), top_module);
    }
}
