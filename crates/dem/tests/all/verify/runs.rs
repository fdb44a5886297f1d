//! Tables of real runs with one fault each: the finding names the fault, and nothing else.

use std::fs;
use std::path::Path;

use cannonpile::lattice::Region;
use cannonpile::stacking::Stacking;
use cannonpile::{Packing, Pile};
use cannonpile_dem::scene::Floor;
use cannonpile_dem::verify::{Compared, Finding, FindingKind, Reader};

use super::{packing, ratio};

fn table(name: &str) -> Vec<u8> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    fs::read(folder.join(name)).unwrap()
}

fn read(packing: &Packing<'_>, name: &str) -> Compared {
    Reader::new().compare(packing, &*table(name)).unwrap()
}

/// Returns the only finding.
fn finding(compared: &Compared, tolerance: f64) -> Finding {
    assert!(!compared.comparison.accepted(tolerance));
    let mut findings = compared.comparison.findings(tolerance);
    assert_eq!(findings.len(), 1, "{findings:?}");
    findings.remove(0)
}

/// Asserts the kind and the text of a finding. Each # in the text stands for a number near the next of `numbers`.
fn says(finding: &Finding, kind: FindingKind, text: &str, numbers: &[f64]) {
    assert_eq!(finding.kind, kind, "{finding}");
    let mut rest = finding.text.as_str();
    let mut numbers = numbers.iter();
    for part in text.split_inclusive('#') {
        let fixed = part.trim_end_matches('#');
        rest = rest
            .strip_prefix(fixed)
            .unwrap_or_else(|| panic!("{finding}"));
        if part.ends_with('#') {
            let end = rest.find([' ', ',', ';', ':', ')']).unwrap();
            let number: f64 = rest[..end].parse().unwrap();
            let right = numbers.next().unwrap();
            assert!((number - right).abs() <= 1e-6 * right, "{finding}");
            rest = &rest[end..];
        }
    }
}

#[test]
fn a_run_without_a_fault_is_accepted() {
    let pile = Pile::triangular(4).unwrap();
    let compared = read(&packing(&pile, ratio(6, 5)), "right.dump");
    assert!(compared.comparison.accepted(1e-6));
    assert!(compared.comparison.findings(1e-6).is_empty());
    // Its springs explain the error that is left.
    assert_eq!(finding(&compared, 1e-8).kind, FindingKind::Springs);
}

#[test]
fn each_fault_of_a_pile_on_fixed_spheres_is_named() {
    use FindingKind::{
        Axes, Factor, Layer, Lean, Motion, Rubbing, SecondSphere, Size, Spacing, Springs,
        Tangential, Weight,
    };
    let pile = Pile::triangular(4).unwrap();
    for (name, kind, text, numbers) in [
        (
            "gravity.dump",
            Factor,
            "all forces are # times the exact ones, to 1e-6: is gravity 9.81",
            &[9.81][..],
        ),
        (
            "springs.dump",
            Springs,
            "springs of # N/m explain the errors",
            &[7.7e4],
        ),
        (
            "diameter.dump",
            Size,
            "forces balance, but lines of contacts are turned by up to 1.1e-4: does the diameter of sphere 6 differ",
            &[],
        ),
        (
            "diameters.dump",
            Spacing,
            "all diameters are # times those of the scene, at the same density",
            &[1.0001],
        ),
        (
            "spacing.dump",
            Spacing,
            "vertical forces fit the scene, horizontal ones do not: a/R is # times that of the scene",
            &[1.25 / 1.2],
        ),
        (
            "mass.dump",
            Factor,
            "all forces are # times the exact ones, to 7e-8: does the mass differ by a factor of 2?",
            &[0.5],
        ),
        (
            "stopped.dump",
            Motion,
            "the forces on 10 spheres do not balance, by up to 1.3e-2 of a weight: is the pile at rest?",
            &[],
        ),
        (
            "friction.dump",
            Rubbing,
            "normal forces do not carry 1.8e-1 of each weight, in all layers: does friction carry it?",
            &[],
        ),
        (
            "whole.csv",
            Tangential,
            "forces have a tangential part, of up to 4.3e-1 of the exact force: is there friction?",
            &[],
        ),
        (
            "axes.dump",
            Axes,
            "x, y, z of the scene are x, z, y of the table, a mirror image",
            &[],
        ),
        (
            "second.dump",
            SecondSphere,
            "all vectors are the forces on the second sphere of each pair",
            &[],
        ),
        (
            "layer.dump",
            Layer,
            "all 18 contacts of layer 2 with layer 3 are missing: are forces on fixed spheres left out?",
            &[],
        ),
        (
            "leaning.dump",
            Lean,
            "all weights lean by (#, 0.0) of their vertical part",
            &[0.05],
        ),
        (
            "double.dump",
            Weight,
            "the contacts of sphere 6 carry # times its weight",
            &[2.0],
        ),
    ] {
        let compared = read(&packing(&pile, ratio(6, 5)), name);
        says(&finding(&compared, 1e-6), kind, text, numbers);
    }
}

#[test]
fn six_digits_are_named() {
    let pile = Pile::triangular(4).unwrap();
    let compared = read(&packing(&pile, ratio(13, 10)), "digits.dump");
    says(
        &finding(&compared, 1e-6),
        FindingKind::Digits,
        "the numbers have only 6 significant digits",
        &[],
    );
}

#[test]
fn a_pile_that_cannot_stand_opens_the_contacts_in_tension() {
    let pile = Pile::under(Region::SITE, Stacking::hcp(6).unwrap()).unwrap();
    let compared = read(&packing(&pile, ratio(6, 5)), "unstable.dump");
    let text = "the pile cannot stand: 3 contacts would need tension, and just these are open";
    says(&finding(&compared, 1e-6), FindingKind::Unstable, text, &[]);
}

#[test]
fn each_fault_on_a_rough_floor_is_named() {
    let pile = Pile::triangular(2).unwrap();
    let of = |name: &str| {
        let [contacts, floor] = ["", "-floor"].map(|end| table(&format!("{name}{end}.dump")));
        let reader = Reader::new().on_floor(Floor::Rough);
        let packing = packing(&pile, ratio(6, 5));
        let compared = reader.compare_with_floor(&packing, &*contacts, &*floor);
        finding(&compared.unwrap(), 1e-5)
    };
    let lost = "the force of the floor is missing below 1 bottom sphere, first sphere 4";
    says(&of("floor"), FindingKind::OffFloor, lost, &[]);
    let turns = "the horizontal forces on sphere 4 balance, but the moments do not";
    says(&of("rotation"), FindingKind::Moment, turns, &[]);
}
