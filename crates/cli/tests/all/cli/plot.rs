//! The command `plot`: figures on stdout and in files, errors.

use super::{Folder, cannonpile, refusal, stdout};

const KINDS: [&str; 7] = [
    "pile", "indexing", "sphere", "shear", "base", "network", "response",
];

#[test]
fn every_kind_prints_svg() {
    for kind in KINDS {
        for scene in [
            "",
            "--layers 1",
            "--dimension 2 --layers 3",
            "--top hexagon:2 --layers 3",
        ] {
            let svg = stdout(&format!("plot {kind} {scene}"));
            assert!(
                svg.starts_with("<svg ") && svg.ends_with("</svg>\n"),
                "{kind} {scene}"
            );
            assert!(roxmltree::Document::parse(&svg).is_ok(), "{kind} {scene}");
        }
    }
}

#[test]
fn defaults_are_the_figures_of_the_paper() {
    let pile = stdout("plot pile");
    assert!(pile.contains("4 layers, FCC, a/R = 6/5"));
    assert_eq!(pile.matches("class=\"sphere\"").count(), 20);
    assert_eq!(pile, stdout("plot pile --layers 4 --spacing 1.2"));
    assert!(stdout("plot indexing").contains("layer k = 3"));
    assert!(stdout("plot sphere").contains("k = 5, i = 2, j = 2"));
    let shear = stdout("plot shear");
    assert!(shear.contains("10 layers") && shear.contains("mg·tanθ"));
    assert!(stdout("plot shear --units si --gravity 9.81").contains(" N"));
    // A spelled-out stacking or a base determines the number of layers.
    assert!(stdout("plot pile --stacking ++-+-").contains("6 layers"));
    assert!(stdout("plot pile --base triangle:6").contains("6 layers"));
}

#[test]
fn file_equals_stdout() {
    let folder = Folder::new();
    let printed = folder.stdout("plot shear --output shear.svg");
    assert_eq!(printed, "");
    assert_eq!(folder.read("shear.svg"), stdout("plot shear"));
    // A failed command does not change the file.
    let refused = folder.refusal("plot shear --layers 9999 --output shear.svg");
    assert!(refused.contains("--layers"));
    assert_eq!(folder.read("shear.svg"), stdout("plot shear"));
    let refused = folder.refusal("plot shear --output missing/shear.svg");
    assert!(refused.contains("--output"));
}

#[test]
fn rejects_figures_with_too_many_glyphs() {
    let huge = "1000000000000000000000000000000";
    for kind in ["pile", "shear", "base", "network", "response"] {
        let line = refusal(&format!("plot {kind} --layers {huge}"));
        assert!(
            line.starts_with("error: --layer") && line.contains("too many for a figure"),
            "{line}"
        );
    }
    // Single layers and spheres of the same pile can be drawn.
    stdout(&format!("plot indexing --layers {huge}"));
    stdout(&format!("plot network --layers {huge} --layer 4"));
    stdout(&format!(
        "plot sphere --layers {huge} --at 100000000000000000000,7,5"
    ));
}

#[test]
fn errors_name_the_option() {
    for (arguments, option) in [
        ("pile --spacing 1/2", "--spacing"),
        ("pile --mass 0", "--mass"),
        ("indexing --layer 10", "--layer"),
        ("indexing --layers 40 --layer 30", "--layer"),
        ("network --layer 9", "--layer"),
        ("network --layer -1", "--layer"),
        ("response --layer 10", "--layer"),
        ("sphere --at 1,2,3", "--at"),
        ("sphere --at x", "--at"),
        ("base --load 0,0,0=-1", "--load"),
        ("base --load 0,0,0=1e400", "--load"),
        ("base --units si --radius 1e400", "--radius"),
        ("base --units si --mass 1e400", "--mass"),
        ("shear --output shear.png", "shear.svg"),
        ("network --layer 9", "--layer"),
        ("indexing --layer 1000 --layers 1001", "--layer"),
        ("shear --width 0", "--width"),
        ("work-precision", "work-precision"),
        ("shear --format csv", "--format"),
        ("cake", "cake"),
    ] {
        let line = refusal(&format!("plot {arguments}"));
        assert!(line.contains(option), "{arguments}: {line}");
    }
}

#[test]
fn unstable_pile_is_drawn_with_a_note() {
    for kind in ["shear", "base", "network"] {
        let output = cannonpile(&format!("plot {kind} --stacking hcp"));
        assert_eq!(output.status.code(), Some(0));
        let note = String::from_utf8(output.stderr).unwrap();
        assert!(
            note.starts_with("note: ") && note.lines().count() == 1,
            "{note}"
        );
    }
    // A response uses spheres without weight, so there is no note about stability.
    assert!(stdout("plot response --stacking hcp").contains("spheres without weight"));
}

#[test]
fn width_and_title_options() {
    let whole = stdout("plot shear");
    assert_eq!(whole, stdout("plot shear --width 800"));
    assert!(whole.contains("width=\"800\"") && whole.contains("font-weight=\"bold\""));
    let bare = stdout("plot shear --width 1200 --no-title");
    assert!(bare.contains("width=\"1200\"") && !bare.contains("font-weight=\"bold\""));
}

#[test]
fn the_figures_of_the_pages_are_those_of_the_commands() {
    for (command, figure) in [
        (
            "plot pile",
            include_str!("../../../../../examples/figures/pile.svg"),
        ),
        (
            "plot shear",
            include_str!("../../../../../examples/figures/shear.svg"),
        ),
        (
            "plot response --stacking hcp --top hexagon:5 --layers 6",
            include_str!("../../../../../examples/figures/response.svg"),
        ),
        (
            "plot bounds --layers 7",
            include_str!("../../../../../examples/figures/bounds.svg"),
        ),
        (
            "plot response --fault-probability 0,1/4,1/2,1 --layers 13",
            include_str!("../../../../../examples/figures/mean.svg"),
        ),
    ] {
        assert!(stdout(command) == figure, "draw it again: {command}");
    }
}

#[test]
fn mean_responses_are_maps_and_curves() {
    let maps = stdout("plot response --fault-probability 0,1/4,0.5,1 --layers 5");
    assert!(maps.contains("q = 1/4") && maps.contains("q = 1/2"));
    assert_eq!(maps.matches("class=\"front\"").count(), 4);
    let curves = stdout("plot response --fault-probability 1/4,1/2 --layers 9 --profile");
    assert_eq!(curves.matches("class=\"curve\"").count(), 2);
    // Two steps, a fault, three steps: six spheres with force 2/9 and three with −1/9.
    let spots = stdout("plot response --faults 2,3");
    assert_eq!(spots, stdout("plot response --stacking ++---"));
    assert_eq!(spots.matches("data-exact=\"2/9\"").count(), 6);
    assert_eq!(spots.matches("data-exact=\"-1/9\"").count(), 3);
    for (what, option) in [
        ("--fault-probability 3/2", "--fault-probability"),
        ("--fault-probability 1/2 --stacking hcp", "--stacking"),
        ("--fault-probability 1/2 --top hexagon:2", "--top"),
        ("--fault-probability 1/2 --load 0,0,0=2", "--load"),
        ("--fault-probability 1/2 --layers 500", "--layers"),
        ("--faults 2,0", "--faults"),
        ("--faults 2,3 --stacking hcp", "--stacking"),
        ("--faults 2,3 --layers 7", "--layers"),
        ("--profile", "--fault-probability"),
    ] {
        let refused = refusal(&format!("plot response {what}"));
        assert!(refused.contains(option), "{what}: {refused}");
    }
}

#[test]
fn distribution_of_a_record() {
    let folder = Folder::new();
    folder.stdout("ensemble --layers 5 --all --output whole.json");
    folder.stdout("ensemble --layers 5 --all --shard 1/2 --output part.json");
    let svg = folder.stdout("plot distribution whole.json");
    assert!(svg.contains("stable stackings") && svg.contains("q = 1/2"));
    let normals =
        folder.stdout("plot distribution whole.json --histogram normals --fault-probability 1/4");
    assert!(normals.contains("q = 1/4") && normals.contains("on the floor"));
    let refused = folder.refusal("plot distribution part.json");
    assert!(refused.contains("merge"), "{refused}");
    assert!(refusal("plot distribution nowhere.json").contains("nowhere.json"));
}
