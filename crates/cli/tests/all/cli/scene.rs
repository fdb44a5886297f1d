//! Scene files: read by every command, overridden by options, written by `scene`.

use super::{Folder, command, output_of, refusal, stdout};

/// A scene in a temporary file with this name.
struct Scratch(Folder, String);

impl Scratch {
    fn new(name: &str, text: &str) -> Self {
        let name = format!("{name}.toml");
        Self(Folder::with(&name, text), name)
    }

    /// Returns stdout, and ignores notes on stderr.
    fn printed(&self, question: &str) -> String {
        printed_in(&self.0, &self.arguments(question))
    }

    /// Returns stdout of a command with this scene. There must be no note.
    fn output(&self, question: &str) -> String {
        self.0.stdout(&self.arguments(question))
    }

    fn refused(&self, question: &str) -> String {
        self.0.refusal(&self.arguments(question))
    }

    /// Writes other content to the file.
    fn write(&self, content: impl AsRef<[u8]>) {
        self.0.write(&self.1, content);
    }

    fn arguments(&self, question: &str) -> String {
        let (command, options) = question.split_once(' ').unwrap_or((question, ""));
        format!("{command} --scene {} {options}", self.1)
    }
}

fn printed(arguments: &str) -> String {
    printed_in(&Folder::new(), arguments)
}

fn printed_in(folder: &Folder, arguments: &str) -> String {
    let output = folder.cannonpile(arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments}: {output:?}");
    String::from_utf8(output.stdout).expect("text")
}

const PILE: &str = "layers = 4\nstacking = 'hcp'\ntop = 'hexagon:2'\nload = ['0,0,0=5/2']\nspacing = 1.2\nmass = 0.1\n";

const OPTIONS: &str =
    "--layers 4 --stacking hcp --top hexagon:2 --load 0,0,0=5/2 --spacing 6/5 --mass 1/10";

#[test]
fn file_equals_options() {
    let file = Scratch::new("good", PILE);
    for command in [
        "summary --units si",
        "base",
        "contacts --units si",
        "spheres",
        "explain",
        "scene",
    ] {
        let options = format!("{command} {OPTIONS}");
        assert_eq!(file.output(command), stdout(&options), "{command}");
    }
}

#[test]
fn options_override_the_file() {
    let file = Scratch::new("win", PILE);
    for (more, options) in [
        (
            "--layers 3",
            "--layers 3 --stacking hcp --top hexagon:2 --load 0,0,0=5/2",
        ),
        (
            "--stacking fcc",
            "--layers 4 --top hexagon:2 --load 0,0,0=5/2",
        ),
        (
            "--top triangle:2",
            "--layers 4 --stacking hcp --top triangle:2 --load 0,0,0=5/2",
        ),
        // The base replaces the top, and the loads replace those of the file.
        (
            "--base hexagon:6 --load 0,0,0=1 --load 3,0,0=2",
            "--layers 4 --stacking hcp --base hexagon:6 --load 0,0,0=1 --load 3,0,0=2",
        ),
        (
            "--load 0,0,0=0",
            "--layers 4 --stacking hcp --top hexagon:2",
        ),
        (
            "--weightless",
            "--layers 4 --stacking hcp --top hexagon:2 --load 0,0,0=5/2 --weightless",
        ),
    ] {
        let question = format!("contacts {more}");
        assert_eq!(
            file.printed(&question),
            printed(&format!("contacts {options}")),
            "{more}"
        );
    }
    let weightless = Scratch::new(
        "weightless",
        "weightless = true\nlayers = 2\nradius = 3\ngravity = 2\n",
    );
    assert_eq!(
        weightless.output("base --weightless=false"),
        stdout("base --layers 2")
    );
    assert_eq!(
        weightless.output("base"),
        stdout("base --layers 2 --weightless")
    );
    let sizes = "--radius 1 --gravity 5 --weightless=false --units si";
    assert_eq!(
        weightless.output(&format!("contacts {sizes}")),
        stdout("contacts --layers 2 --gravity 5 --units si")
    );
    let discs = Scratch::new("discs", "dimension = 2\nlayers = 3\nload = ['2=1']\n");
    assert_eq!(
        discs.output("base"),
        stdout("base --dimension 2 --layers 3 --load 2=1")
    );
}

#[test]
fn errors_name_the_line_of_the_file_or_the_option() {
    let file = Scratch::new("refusal", PILE);
    for (question, parts) in [
        (
            "base --sin-phi 1/3",
            &["error: --sin-phi: ", "with top", "line 3, top"][..],
        ),
        (
            "base --dimension 2",
            &[
                "error: --scene",
                "line 3, top: top has no meaning with dimension 2",
            ],
        ),
        (
            "base --stacking=++",
            &["error: --scene", "line 1, layers: ", "3 layers, not 4"],
        ),
        (
            "base --layers 6 --stacking=++",
            &["error: --layers: ", "3 layers, not 6"],
        ),
        (
            "base --layers 9 --base hexagon:2",
            &["error: --layers: ", "at most 3"],
        ),
        (
            "base --base hexagon:2",
            &["error: --scene", "line 1, layers: ", "at most 3"],
        ),
        ("base --spacing 9/10", &["error: --spacing: "]),
        ("base --top hexagon:1 --load 0,1,0=1", &["error: --load: "]),
        (
            "base --top region:5..6,5..6,10..12",
            &["error: --scene", "line 4, load: no sphere"],
        ),
        ("base --mass -1", &["error: --mass: "]),
    ] {
        let line = file.refused(question);
        for part in parts {
            assert!(line.contains(part), "{question}: no '{part}' in {line}");
        }
        assert_eq!(
            line.contains(&file.1),
            line.contains("--scene"),
            "{question}: {line}"
        );
    }
    for (text, parts) in [
        ("spcaing = 1", ["line 1", "did you mean 'spacing'?"]),
        ("\nmass = -1", ["line 2, mass", "positive"]),
        ("\n\nsin-phi = 9/10", ["line 3", "TOML"]),
        ("spacing = 0.9", ["line 1, spacing", "at least 1"]),
        ("sin-phi = 2", ["line 1, sin-phi", "between 0 and 1"]),
        (
            "dimension = 2\nsin-phi = 0.5",
            ["line 2, sin-phi: ", "line 1, dimension)"],
        ),
    ] {
        let file = Scratch::new("text", text);
        let line = file.refused("summary");
        assert!(line.contains(&file.1), "{line}");
        for part in parts {
            assert!(line.contains(part), "{text}: no '{part}' in {line}");
        }
    }
    let nowhere = refusal("summary --scene nowhere/pile.toml");
    assert!(
        nowhere.contains("nowhere/pile.toml") && nowhere.contains("no such file"),
        "{nowhere}"
    );
    let file = Scratch::new("bytes", "");
    file.write(b"mass = '\xff'");
    assert!(file.refused("summary").contains("invalid"));
}

#[test]
fn scene_is_written_and_read() {
    for options in [
        "",
        OPTIONS,
        "--layers 1000000000000000000000000000000 --sin-phi 1/3",
        "--dimension 2 --layers 5 --load 4=1/3 --load 0,0=2 --weightless",
        "--base region:0..5,0..5,0..7 --stacking (2,1) --gravity 9.81 --radius 1e-3",
    ] {
        let text = stdout(&format!("scene {options}"));
        let file = Scratch::new("again", &text);
        assert_eq!(file.output("scene"), text, "{options}");
        assert_eq!(
            file.output("summary --units si"),
            stdout(&format!("summary --units si {options}")),
            "{options}"
        );
        assert!(file.output("scene --output again.out").is_empty());
        assert_eq!(file.0.read("again.out"), text);
    }
    // An invalid scene is not written.
    assert!(refusal("scene --spacing 3").contains("--spacing"));
    assert!(refusal("scene --output nowhere/pile.toml").contains("--output"));
}

#[test]
fn rejects_files_that_are_not_utf8() {
    let file = Scratch::new("bytes", "");
    file.write(b"layers = 3 # \xff\n");
    assert!(file.refused("base").contains("not text in UTF-8"));
    // After the first byte each letter has two bytes, so the cut at an even length splits a letter.
    file.write(format!("#{}", "é".repeat(17 << 20)));
    assert!(file.refused("base").contains("longer than 16777216 bytes"));
}

#[test]
fn stdin_is_read_once() {
    let told = refusal("verify - --scene -");
    assert!(told.contains("FILE and --scene are both -"), "{told}");
}

#[test]
fn scene_from_a_pipe() {
    let mut command = command();
    let output = output_of(command.args(["base", "--scene", "-"]), PILE.to_owned());
    assert_eq!(
        String::from_utf8_lossy(&output.stdout),
        stdout(&format!("base {OPTIONS}"))
    );
}

#[test]
fn a_spacing_may_be_a_root() {
    let file = Scratch::new("root", "layers = 4\nspacing = '2*sqrt(2/3)'\n");
    for command in ["summary --units si", "contacts --units si", "scene"] {
        let options = format!("{command} --layers 4 --spacing sqrt(8/3)");
        assert_eq!(file.output(command), stdout(&options), "{command}");
    }
    assert!(
        file.output("scene")
            .contains("\nspacing = \"2/3*sqrt(6)\"\n")
    );
    // A root may be rational.
    let spheres = |spacing| stdout(&format!("spheres --layers 3 --spacing {spacing}"));
    assert_eq!(spheres("sqrt(1.44)"), spheres("1.2"));
    for (spacing, reason) in [
        ("sqrt(-2)", "the root of -2 is not real"),
        ("sqrt(x)", "'x' is not a number"),
        ("sqrt(2", "'sqrt(2' is not a number"),
        ("-sqrt(2)", "it must be positive"),
        ("sqrt(0)", "spacing must be positive, not 0"),
    ] {
        let text = refusal(&format!("base --spacing={spacing}"));
        assert!(
            text.contains("--spacing") && text.contains(reason),
            "{text}"
        );
    }
}
