//! Shell completions: each script contains every command and option.

use std::io::Write;
use std::process::{Command, Stdio};

use cannonpile_testkit::processes::{Process, left_out};

use super::{refusal, stdout};

const SHELLS: [&str; 5] = ["bash", "zsh", "fish", "elvish", "powershell"];

/// Returns the subcommands in the help of a command.
pub(super) fn commands(above: &str) -> Vec<String> {
    let help = stdout(&format!("{above} --help"));
    let list = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let list = list.take_while(|line| !line.is_empty());
    list.filter_map(|line| line.split_whitespace().next().map(str::to_owned))
        .collect()
}

/// Returns the options in the help of a command.
pub(super) fn options(command: &str) -> Vec<String> {
    let help = stdout(&format!("{command} --help"));
    let words = help.split(|c: char| !(c.is_ascii_alphanumeric() || c == '-'));
    words
        .filter_map(|word| word.strip_prefix("--"))
        .filter(|word| !word.is_empty())
        .map(str::to_owned)
        .collect()
}

#[test]
fn scripts_contain_commands_and_options() {
    let commands = commands("");
    for expected in [
        "summary",
        "contacts",
        "census",
        "scene",
        "prove",
        "completions",
    ] {
        assert!(
            commands.iter().any(|command| command == expected),
            "{commands:?}"
        );
    }
    let options = options("contacts");
    assert!(
        options.iter().any(|option| option == "sin-phi"),
        "{options:?}"
    );
    for shell in SHELLS {
        let script = stdout(&format!("completions {shell}"));
        for name in commands.iter().chain(&options) {
            assert!(script.contains(name), "{shell}: no {name}");
        }
        assert!(!script.contains("sin-psi"), "{shell}");
    }
    assert!(refusal("completions tcsh").contains("'tcsh'"));
    assert!(refusal("completions").contains("bash"));
}

/// The shells that are installed accept the syntax of their scripts.
#[test]
fn shells_parse_their_scripts() {
    for shell in ["bash", "zsh"] {
        let mut command = Command::new(shell);
        command
            .arg("-n")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        // Without the user's files that a shell reads at its start, and in a locale that every system has.
        for variable in [
            "BASH_ENV",
            "ENV",
            "ZDOTDIR",
            "SHELLOPTS",
            "BASHOPTS",
            "HOME",
        ] {
            command.env_remove(variable);
        }
        command.env("LC_ALL", "C");
        let Ok(process) = Process::start(&mut command) else {
            left_out(&format!("the syntax of completions: there is no {shell}"));
            continue;
        };
        let script = stdout(&format!("completions {shell}"));
        let output = process.output_of(move |mut stdin| {
            stdin.write_all(script.as_bytes()).expect("written");
        });
        assert!(output.status.success(), "{shell}: {output:?}");
        assert!(output.stderr.is_empty(), "{shell}: {output:?}");
    }
}
