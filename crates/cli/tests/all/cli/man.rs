//! Manual pages: each command has one, with all its options.

use std::collections::BTreeSet;
use std::fs;
use std::process::Command;

use super::{cannonpile, completions, stdout};

#[test]
fn every_command_has_a_page() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path().join("share/man1");
    let listed = stdout(&format!("man {}", folder.display()));
    let mut commands = vec![String::new()];
    let below = |above| {
        completions::commands(above)
            .into_iter()
            .filter(|name| name != "help")
    };
    commands.extend(below(""));
    commands.extend(below("plot").map(|figure| format!("plot {figure}")));
    assert!(commands.len() > 25, "{commands:?}");
    let mut names = BTreeSet::new();
    for command in &commands {
        let name = format!("cannonpile {command}").trim_end().replace(' ', "-") + ".1";
        let page = fs::read_to_string(folder.join(&name)).expect(&name);
        assert!(page.contains(".TH cannonpile"), "{name}: {page}");
        let text = page.replace('\\', "");
        for option in completions::options(command) {
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

    // If groff is installed, it formats the pages without a warning.
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
fn rejects_a_file_as_folder() {
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

#[test]
fn writes_all_pages_or_none() {
    let folder = tempfile::tempdir().expect("a folder");
    let taken = folder.path().join("cannonpile-verify.1");
    fs::create_dir(&taken).expect("made");
    let output = cannonpile(&format!("man {}", folder.path().display()));
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("cannonpile-verify.1: "), "{said}");
    assert_eq!(fs::read_dir(folder.path()).expect("there").count(), 1);
}
