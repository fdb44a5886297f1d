//! Compares the output of the commands in `commands/*.console` word for word. `.ci/docs` does so for README and the
//! guide.
//!
//! | line | meaning |
//! |---|---|
//! | `$ cannonpile …` | a command, run in a new folder with the files of `commands/files`; `< FILE` is its input |
//! | `> …` | another command in the same folder; `cat FILE` and `ls FOLDER` are supported too |
//! | `? N` | the exit status, if it is not 0 |
//! | `! …` | a line on stderr |
//! | `…` | any number of lines |
//!
//! All other lines are stdout. `CANNONPILE_OVERWRITE=1 cargo test -p cannonpile-cli --test all console` updates the snapshots that
//! differ. Read the difference before you commit it.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::{env, iter};

use tempfile::TempDir;

use super::output;
use crate::binary;

macro_rules! console {
    ($($name:ident: $commands:literal;)*) => {
        $(#[test]
        fn $name() {
            holds(stringify!($name), $commands);
        })*

        #[test]
        fn every_console_file_is_run() {
            let mut files: Vec<_> = fs::read_dir(folder()).expect("commands").map(|file| file.expect("a file").path()).collect();
            files.retain(|file| file.extension().is_some_and(|extension| extension == "console"));
            files.sort();
            assert_eq!(files, [$(folder().join(concat!(stringify!($name), ".console"))),*]);
        }
    };
}

// The number of commands of each file.
console! {
    base: 114;
    bounds: 20;
    cases: 20;
    census: 21;
    check: 12;
    completions: 2;
    contacts: 61;
    ensemble: 56;
    explain: 24;
    export: 60;
    help: 18;
    mean: 49;
    merge: 18;
    plot: 44;
    prove: 11;
    response: 9;
    scene: 22;
    sensitivity: 15;
    spheres: 22;
    stability: 31;
    summary: 42;
    tables: 7;
    verify: 16;
}

/// A command of a snapshot, with the lines below it.
struct Shown<'a> {
    line: &'a str,
    below: Vec<&'a str>,
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/all/cli/commands")
}

/// Returns the commands of a text, without the empty lines between them.
fn shown(text: &str) -> Vec<Shown<'_>> {
    let mut all: Vec<Shown<'_>> = Vec::new();
    for line in text.lines() {
        match all.last_mut() {
            _ if line.starts_with("$ ") || line.starts_with("> ") => {
                let below = Vec::new();
                all.push(Shown { line, below });
            }
            Some(last) => last.below.push(line),
            None => panic!("not below a command: {line}"),
        }
    }
    for shown in &mut all {
        while shown.below.pop_if(|line| line.is_empty()).is_some() {}
    }
    all
}

/// Creates a temporary folder with the files of `commands/files`.
fn fresh() -> TempDir {
    let fresh = tempfile::tempdir().expect("a folder");
    for file in fs::read_dir(folder().join("files")).expect("files") {
        let file = file.expect("a file");
        fs::copy(file.path(), fresh.path().join(file.file_name())).expect("a copy");
    }
    fresh
}

/// Splits a command into words. A quoted text is one word.
fn words(command: &str) -> Vec<String> {
    let mut words = Vec::new();
    let (mut word, mut quote) = (None::<String>, None);
    for c in command.chars() {
        match quote {
            Some(close) if c == close => quote = None,
            None if c == '\'' || c == '"' => {
                quote = Some(c);
                word.get_or_insert_default();
            }
            None if c == ' ' => words.extend(word.take()),
            _ => word.get_or_insert_default().push(c),
        }
    }
    words.into_iter().chain(word).collect()
}

/// Runs a command and returns its output in the format of a snapshot.
fn run(command: &str, folder: &Path) -> Vec<String> {
    let mut words = words(command);
    let mut input = Stdio::null();
    if let Some(at) = words.iter().position(|word| word == "<") {
        input = File::open(folder.join(&words[at + 1]))
            .expect("input")
            .into();
        words.truncate(at);
    }
    let [program, arguments @ ..] = &words[..] else {
        panic!("no command");
    };
    if program == "ls" {
        let names = fs::read_dir(folder.join(&arguments[0])).expect("a folder");
        let mut names: Vec<_> = names
            .map(|name| {
                name.expect("a name")
                    .file_name()
                    .into_string()
                    .expect("text")
            })
            .collect();
        names.sort();
        return names;
    }
    if program == "cat" {
        let text = fs::read_to_string(folder.join(&arguments[0])).expect("a file");
        return text.lines().map(String::from).collect();
    }
    assert_eq!(program, "cannonpile");
    let mut binary = binary::command();
    let output = output(binary.args(arguments).current_dir(folder).stdin(input));
    let status = output.status.code().expect("no signal");
    let status = (status != 0).then(|| format!("? {status}"));
    let [stdout, stderr] =
        [output.stdout, output.stderr].map(|text| String::from_utf8(text).expect("text"));
    let stderr = stderr.lines().map(|line| format!("! {line}"));
    let mut lines: Vec<String> = status
        .into_iter()
        .chain(stdout.lines().map(String::from))
        .chain(stderr)
        .collect();
    while lines.pop_if(|line| line.is_empty()).is_some() {}
    lines
}

/// Returns whether the output agrees with the snapshot, where `…` matches any lines.
fn agree(shown: &[&str], lines: &[String]) -> bool {
    let Some(gap) = shown.iter().position(|line| *line == "…") else {
        return shown == lines;
    };
    let (before, after) = (&shown[..gap], &shown[gap + 1..]);
    lines.len() >= before.len() + after.len()
        && before == &lines[..gap]
        && after == &lines[lines.len() - after.len()..]
}

/// Formats output as a snapshot. A line `…` stays at its position, and long output gets a new one.
fn cut(shown: &[&str], lines: &[String]) -> Vec<String> {
    const LONG: usize = 30;
    let errors = |line: &str| line.starts_with("! ");
    let (stderr, stdout): (Vec<_>, Vec<_>) = lines.iter().cloned().partition(|line| errors(line));
    let (before, after) = match shown.iter().position(|line| *line == "…") {
        Some(gap) => (
            gap,
            shown[gap + 1..].iter().filter(|line| !errors(line)).count(),
        ),
        None if stdout.len() > LONG => (LONG / 2, 3),
        None => (stdout.len(), 0),
    };
    if stdout.len() <= before + after {
        return lines.to_vec();
    }
    let (first, last) = (&stdout[..before], &stdout[stdout.len() - after..]);
    [first, &["…".to_owned()], last, &stderr].concat()
}

/// Checks the output of every command of a file, and the number of commands.
fn holds(name: &str, commands: usize) {
    let path = folder().join(name).with_extension("console");
    let text = fs::read_to_string(&path).expect("commands");
    let all = shown(&text);
    let mut now = String::new();
    let mut differences = String::new();
    let mut folder = fresh();
    for Shown { line, below } in &all {
        let (mark, command) = line.split_at(2);
        if mark == "$ " {
            folder = fresh();
        }
        let lines = run(command, folder.path());
        if !now.is_empty() && mark == "$ " {
            now.push('\n');
        }
        if agree(below, &lines) {
            now.extend(iter::once(line).chain(below).flat_map(|line| [line, "\n"]));
        } else {
            let (cut, lines) = (cut(below, &lines).join("\n"), lines.join("\n"));
            now.extend([line, "\n", &cut, "\n"]);
            differences.extend([
                line,
                "\n",
                &lines,
                "\nsnapshot:\n",
                &below.join("\n"),
                "\n\n",
            ]);
        }
    }
    if env::var_os("CANNONPILE_OVERWRITE").is_some() {
        fs::write(&path, now).expect("written again");
    } else {
        assert!(differences.is_empty(), "{}:\n{differences}", path.display());
        assert_eq!(
            all.len(),
            commands,
            "update the number of commands in `console.rs`"
        );
    }
}

#[test]
fn snapshots_detect_differences() {
    let lines = |text: &str| -> Vec<String> { text.split(' ').map(String::from).collect() };
    for (shown, printed, holds) in [
        ("a b", "a b", true),
        ("a b", "a b c", false),
        ("a b", "a", false),
        ("a …", "a", true),
        ("a … c", "a b b c", true),
        ("a … c", "a c", true),
        ("a b … b c", "a b c", false),
        ("a … c", "a b", false),
        ("… c", "b c", true),
    ] {
        let shown: Vec<_> = shown.split(' ').collect();
        assert_eq!(agree(&shown, &lines(printed)), holds, "{shown:?} {printed}");
    }
    assert_eq!(words("a  '(2,1)' --b=\"c d\"''"), ["a", "(2,1)", "--b=c d"]);
    let [first, second] = &shown("$ a\n? 2\n\n> b\nc\n\nd\n")[..] else {
        panic!("two commands");
    };
    assert_eq!((first.line, &first.below[..]), ("$ a", &["? 2"][..]));
    assert_eq!(
        (second.line, &second.below[..]),
        ("> b", &["c", "", "d"][..])
    );
    let wrong = run("cannonpile base --layers 0", fresh().path());
    assert_eq!((wrong[0].as_str(), wrong.len()), ("? 2", 2), "{wrong:?}");
    assert!(wrong[1].starts_with("! error: "), "{wrong:?}");
}
