//! Manual pages: each command has one, with all its options.

use std::collections::BTreeSet;
use std::process::{Command, Stdio};
use std::{env, fs};

use cannonpile_testkit::processes::{Process, left_out};

use super::{Folder, completions};

#[test]
fn every_command_has_a_page() {
    let folder = Folder::new();
    let pages = folder.path("share/man1");
    fs::create_dir_all(&pages).expect("a folder");
    clap_mangen::generate_to(cannonpile_cli::command(), &pages).expect("pages");
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
        let page = folder.read(&format!("share/man1/{name}"));
        assert!(page.contains(".TH cannonpile"), "{name}: {page}");
        let text = page.replace('\\', "");
        for option in completions::options(command) {
            assert!(
                text.contains(&format!("--{option}")),
                "{name} lacks --{option}"
            );
        }
        names.insert(name);
    }
    let written = folder.names("share/man1");
    assert_eq!(BTreeSet::from_iter(written), names);

    // If groff is installed, it formats the pages without a warning.
    for name in &names {
        let mut groff = Command::new("groff");
        groff
            .args(["-man", "-Kutf8", "-Tutf8", "-ww", name])
            .current_dir(folder.path("share/man1"))
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        // Without PATH groff does not start its own programs. The other variables change what it does.
        groff.env(
            "PATH",
            env::var_os("PATH").unwrap_or("/usr/bin:/bin".into()),
        );
        for variable in ["GROFF_TYPESETTER", "GROFF_TMAC_PATH", "GROFF_ENCODING"] {
            groff.env_remove(variable);
        }
        let Ok(process) = Process::start(&mut groff) else {
            left_out("the format of the manual pages: there is no groff");
            return;
        };
        let output = process.output();
        assert!(output.status.success(), "{name}: {output:?}");
        assert!(output.stderr.is_empty(), "{name}: {output:?}");
    }
}
