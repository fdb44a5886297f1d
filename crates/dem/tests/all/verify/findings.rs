//! Findings name the cause of many differences: one fault of each kind is planted.

use std::fmt::Write;

use cannonpile::lattice::Region;
use cannonpile::stacking::Stacking;
use cannonpile::{Packing, Pile};
use cannonpile_dem::verify::{FindingKind, Measured, Reader};

use super::{compare, packing, perfect, ratio};

fn with_vectors(measured: &[Measured], turn: impl Fn([f64; 3]) -> [f64; 3]) -> Vec<Measured> {
    let turned =
        |one: &Measured| Measured::new(one.ids, one.force).with_vector(turn(one.vector.unwrap()));
    measured.iter().map(turned).collect()
}

fn findings(packing: &Packing<'_>, measured: &[Measured]) -> Vec<String> {
    let findings = compare(packing, measured).findings(1e-6);
    findings.iter().map(ToString::to_string).collect()
}

fn piles() -> [Pile; 3] {
    [
        Pile::triangular(6).unwrap(),
        Pile::under(Region::hexagon(3, 3).unwrap(), Stacking::hcp(4).unwrap()).unwrap(),
        Pile::triangular(40).unwrap(),
    ]
}

#[test]
fn correct_forces_have_no_findings() {
    for pile in piles() {
        let packing = packing(&pile, ratio(11, 10));
        let right = perfect(&packing);
        assert!(findings(&packing, &right).is_empty());
        let near = with_vectors(&right, |[x, y, z]| [x * (1.0 + 1e-9), y, z]);
        assert!(findings(&packing, &near).is_empty());
        // A single wrong force forms no pattern.
        let mut wrong = right;
        wrong[3].force *= 2.0;
        wrong[3].vector = None;
        assert!(findings(&packing, &wrong).is_empty());
        assert!(findings(&packing, &[]).is_empty());
    }
}

#[test]
fn a_common_factor_is_reported_with_its_likely_cause() {
    for pile in piles() {
        let packing = packing(&pile, ratio(11, 10));
        let right = perfect(&packing);
        for (factor, cause) in [
            (9.81, "gravity"),
            (1.0 / 9.81, "gravity"),
            (1e3, "units"),
            (1e-5, "units"),
            (-1.0, "tensile forces positive"),
            (2.0, "mass differ by a factor of 2"),
            (1.37, "mass, gravity or spacing differ"),
        ] {
            let scaled = right
                .iter()
                .map(|one| Measured::new(one.ids, one.force * factor));
            let [finding] = &findings(&packing, &scaled.collect::<Vec<_>>())[..] else {
                panic!("{factor}");
            };
            assert!(
                finding.starts_with("all forces are ") && finding.contains(cause),
                "{finding}"
            );
        }
    }
}

#[test]
fn swapped_axes_and_mirror_images_are_reported() {
    for pile in piles() {
        let packing = packing(&pile, ratio(11, 10));
        let right = perfect(&packing);
        let minus = with_vectors(&right, |vector| vector.map(|x| -x));
        let [second] = &compare(&packing, &minus).findings(1e-6)[..] else {
            panic!();
        };
        assert_eq!(second.kind, FindingKind::SecondSphere);
        for (turn, said) in [
            (
                (|[x, y, z]: [f64; 3]| [x, -y, z]) as fn([f64; 3]) -> [f64; 3],
                "x, y, z of the scene are x, -y, z of the table, a mirror image",
            ),
            (
                |[x, y, z]| [x, z, y],
                "x, y, z of the scene are x, z, y of the table, a mirror image",
            ),
            (
                |[x, y, z]| [z, x, y],
                "x, y, z of the scene are y, z, x of the table",
            ),
            (
                |[x, y, z]| [-x, -y, z],
                "x, y, z of the scene are -x, -y, z of the table",
            ),
        ] {
            assert_eq!(findings(&packing, &with_vectors(&right, turn)), [said]);
        }
    }
}

#[test]
fn a_missing_layer_is_reported() {
    for pile in piles() {
        let packing = packing(&pile, ratio(11, 10));
        let right = perfect(&packing);
        let layers = pile.layers();
        for (layer, said) in [
            (layers - 2, ": are forces on fixed spheres left out?"),
            (1, " are missing"),
        ] {
            let sites = |one: &Measured| pile.numbering().unwrap().site(one.ids[0]).unwrap();
            let mut kept = right.clone();
            kept.retain(|one| sites(one).k != layer);
            let [finding] = &findings(&packing, &kept)[..] else {
                panic!("{layer}");
            };
            assert!(
                finding.starts_with("all ") && finding.contains(&format!("layer {layer} ")),
                "{finding}"
            );
            assert!(finding.ends_with(said), "{finding}");
            // With one of its contacts present, no layer is missing.
            kept.extend(right.iter().find(|one| sites(one).k == layer));
            assert!(findings(&packing, &kept).is_empty());
        }
    }
}

#[test]
fn tangential_forces_are_reported() {
    for pile in piles() {
        let packing = packing(&pile, ratio(11, 10));
        // One contact has a force across its direction.
        let mut rubbed = perfect(&packing);
        let [x, y, z] = rubbed[4].vector.unwrap();
        let across = 0.05 * rubbed[4].force.abs() / x.hypot(y);
        rubbed[4].vector = Some([x - across * y, y + across * x, z]);
        let [finding] = &findings(&packing, &rubbed)[..] else {
            panic!();
        };
        assert!(
            finding.starts_with("forces have a tangential part, of up to 5.0e-2"),
            "{finding}"
        );
    }
}

#[test]
fn residual_forces_are_summed_on_each_sphere() {
    for pile in piles().into_iter().chain([Pile::discs(5).unwrap()]) {
        let packing = packing(&pile, ratio(11, 10));
        let reader = Reader::new();
        let mut table = String::from("id1,id2,force\n");
        for one in perfect(&packing) {
            let [a, b] = one.ids;
            writeln!(table, "{a},{b},{:?}", one.force).unwrap();
        }
        let read = reader.compare(&packing, table.as_bytes()).unwrap();
        let unbalanced = read.unbalanced;
        let (_, least) = unbalanced.greatest().unwrap();
        assert!(least < 1e-12 * read.comparison.largest_force(), "{least}");
        // The force between sphere 2 and one sphere below is half a newton greater.
        let more = table
            .lines()
            .position(|line| line.starts_with("2,"))
            .unwrap();
        let mut lines: Vec<String> = table.lines().map(str::to_owned).collect();
        let (pair, force) = lines[more].rsplit_once(',').unwrap();
        lines[more] = format!("{pair},{:?}", force.parse::<f64>().unwrap() + 0.5);
        let read = reader
            .compare(&packing, lines.join("\n").as_bytes())
            .unwrap();
        let forces = read.unbalanced;
        let norms = forces
            .forces()
            .iter()
            .map(|[x, y, z]| x.hypot(*y).hypot(*z));
        let moved: Vec<usize> = norms
            .enumerate()
            .filter(|(_, norm)| *norm > 0.49)
            .map(|(n, _)| n + 1)
            .collect();
        assert!(moved.contains(&2) && moved.len() <= 2, "{moved:?}");
    }
}
