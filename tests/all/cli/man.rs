//! Pages of the manual: every command has one, which says what its help says, and `man` shows it.

use std::collections::BTreeSet;
use std::fs;
use std::process::Command;

use super::{cannonpile, stdout};

/// The commands that the help of a command lists.
fn below(command: &str) -> Vec<String> {
    let help = stdout(&format!("{command} --help"));
    let list = help
        .lines()
        .skip_while(|line| *line != "Commands:")
        .skip(1)
        .take_while(|line| !line.is_empty())
        .filter_map(|line| line.split_whitespace().next());
    list.filter(|name| *name != "help")
        .map(str::to_owned)
        .collect()
}

/// Every option that the help of a command has at the beginning of a line.
fn options(command: &str) -> Vec<String> {
    let help = stdout(&format!("{command} --help"));
    let mut options = Vec::new();
    for line in help.lines().map(str::trim_start) {
        let line = line.strip_prefix("-h, ").unwrap_or(line);
        if let Some(name) = line.strip_prefix("--") {
            let name = name.split([' ', '[', '=']).next().unwrap_or(name);
            options.push(name.to_owned());
        }
    }
    options
}

#[test]
fn every_command_has_its_page() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path().join("share/man1");
    let listed = stdout(&format!("man {}", folder.display()));
    let mut commands = vec![String::new()];
    commands.extend(below(""));
    commands.extend(below("plot").iter().map(|figure| format!("plot {figure}")));
    assert!(commands.len() > 25, "{commands:?}");
    let mut names = BTreeSet::new();
    for command in &commands {
        let name = format!("cannonpile {command}").trim_end().replace(' ', "-") + ".1";
        let page = fs::read_to_string(folder.join(&name)).expect(&name);
        assert!(page.contains(".TH cannonpile"), "{name}: {page}");
        let text = page.replace('\\', "");
        for option in options(command) {
            assert!(
                text.contains(&format!("--{option}")),
                "{name} lacks --{option}"
            );
        }
        assert!(
            listed.lines().any(|line| line.ends_with(&name)),
            "{name}: {listed}"
        );
        names.insert(name);
    }
    let written = fs::read_dir(&folder).expect("it is there");
    let written = written.map(|file| {
        file.expect("a file")
            .file_name()
            .into_string()
            .expect("text")
    });
    assert_eq!(written.collect::<BTreeSet<_>>(), names);
    assert_eq!(listed.lines().count(), names.len());

    // Where there is groff, it has nothing to complain of, and examples keep their lines.
    for name in &names {
        let page = folder.join(name);
        let groff = Command::new("groff")
            .args(["-man", "-Kutf8", "-Tutf8", "-ww"])
            .arg(&page)
            .output();
        let Ok(output) = groff else { continue };
        assert!(output.status.success(), "{name}: {output:?}");
        assert!(output.stderr.is_empty(), "{name}: {output:?}");
    }
}

#[test]
fn a_folder_that_cannot_be_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("file");
    fs::write(&file, "here").expect("written");
    let output = cannonpile(&format!("man {}/man1", file.display()));
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(
        said.starts_with("error: cannot write ") && said.contains("/file/man1: "),
        "{said}"
    );
    assert_eq!(fs::read_to_string(&file).expect("it stays"), "here");
}
