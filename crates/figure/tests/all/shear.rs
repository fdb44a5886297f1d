//! The arrows of the base shear forces.

use crate::svg::{corners, number, of_class, piles, site, subject};
use cannonpile::geometry::Spacing;
use cannonpile::lattice::Site;
use cannonpile::scalar::Surd;
use cannonpile::shape::Selection;
use cannonpile::{Packing, Pile};
use cannonpile_figure::{self as figure, Subject};
use num_rational::BigRational;
use roxmltree::{Document, Node};

/// Returns the vector from the tail to the tip of an arrow, y up.
fn vector(arrow: &Node<'_, '_>) -> [f64; 2] {
    let corners = corners(arrow);
    assert_eq!(corners.len(), 7);
    let (first, tip, last) = (corners[0], corners[3], corners[6]);
    let tail = [first[0].midpoint(last[0]), first[1].midpoint(last[1])];
    [tip[0] - tail[0], tail[1] - tip[1]]
}

/// Returns the length of a unit force in pixels, from the key.
fn scale(document: &Document<'_>) -> f64 {
    let keys = of_class(document, "key");
    let [key] = &keys[..] else {
        panic!("one key, not {}", keys.len());
    };
    let [x, y] = vector(key);
    assert!(y.abs() < 1e-9);
    x / number(key, "data-force")
}

/// Returns whether every arrow agrees with formula (14) of the paper for `layers` layers; an oracle in floats.
fn agrees_with_paper(svg: &str, layers: i32) -> bool {
    let document = Document::parse(svg).unwrap();
    let pixels = scale(&document);
    let arrows = of_class(&document, "arrow");
    let still = of_class(&document, "vanishing");
    let layers = f64::from(layers);
    arrows.iter().chain(&still).all(|mark| {
        let (i, j) = (number(mark, "data-i"), number(mark, "data-j"));
        let x = -(layers - 1.0 - 3.0 * j) / 6.0;
        let y = -(3.0_f64.sqrt() / 6.0) * (layers - 1.0 - 2.0 * i - j);
        let [right, up] = if mark.attribute("class") == Some("vanishing") {
            [0.0; 2]
        } else {
            vector(mark)
        };
        // Both coordinates are rounded to 1/10000 of a pixel.
        (right - x * pixels).abs() < 4e-4 && (up - y * pixels).abs() < 4e-4
    })
}

#[test]
fn arrows_agree_with_the_formula_of_the_paper() {
    for layers in [2, 3, 4, 7, 10, 19] {
        let pile = Pile::triangular(layers.into()).unwrap();
        let svg = figure::shear(&subject(&pile)).unwrap().to_string();
        assert!(agrees_with_paper(&svg, layers), "{layers} layers");
        // The oracle rejects the arrows of another pile.
        assert!(!agrees_with_paper(&svg, layers + 1));
        assert!(!agrees_with_paper(
            &svg.replacen(
                "class=\"arrow\" data-i=\"1\"",
                "class=\"arrow\" data-i=\"0\"",
                1
            ),
            layers
        ));
        let document = Document::parse(&svg).unwrap();
        let count = of_class(&document, "arrow").len() + of_class(&document, "vanishing").len();
        assert_eq!(count.to_string(), pile.base_sphere_count().to_string());
        // The force under the apex is zero. A sphere is there if L ≡ 1 (mod 3).
        let still = usize::from(layers % 3 == 1);
        assert_eq!(of_class(&document, "vanishing").len(), still);
    }
}

/// Returns the forces in a figure, by sphere.
fn forces(document: &Document<'_>) -> Vec<(Site, [f64; 2])> {
    let marks = document
        .descendants()
        .filter(|node| node.has_attribute("data-x"));
    let force = |node: Node<'_, '_>| {
        (
            site(&node),
            ["data-x", "data-y"].map(|name| number(&node, name)),
        )
    };
    marks.map(force).collect()
}

#[test]
fn arrows_equal_the_exact_forces() {
    for pile in piles() {
        let svg = figure::shear(&subject(&pile)).unwrap().to_string();
        let document = Document::parse(&svg).unwrap();
        let shown = forces(&document);
        let sites = pile.rows(Selection::Base).unwrap().flatten();
        assert!(shown.iter().map(|(site, _)| *site).eq(sites));
        let forces = pile.forces::<BigRational>();
        let cos2 = BigRational::from_integer(1.into()) - pile.sin_phi() * pile.sin_phi();
        let across = Surd::sqrt(cos2 * BigRational::from_integer(4.into())).unwrap();
        for (site, force) in &shown {
            let exact = forces.on_floor(*site).unwrap();
            let [x, y] = [Surd::from(exact.shear_x), across.scaled(&exact.shear_y)];
            assert_eq!(force.map(Some), [x, y].map(|part| part.nearest()));
        }
        let drawn = of_class(&document, "arrow");
        let acting = shown
            .iter()
            .filter(|(_, force)| force.iter().any(|part| *part != 0.0));
        assert_eq!(drawn.len(), acting.count());
        if drawn.is_empty() {
            assert!(of_class(&document, "key").is_empty());
            continue;
        }
        let pixels = scale(&document);
        for drawn in drawn {
            let [x, y] = ["data-x", "data-y"].map(|name| number(&drawn, name));
            let [right, up] = vector(&drawn);
            assert!((right - x * pixels).abs() < 4e-4);
            assert!((up - y * pixels).abs() < 4e-4);
        }
    }
}

#[test]
fn units_follow_the_subject() {
    let pile = Pile::triangular(10).unwrap();
    let spacing = Spacing::new(BigRational::new(6.into(), 5.into())).unwrap();
    let packing = Packing::new(&pile, &spacing).unwrap();
    let tan: f64 = packing.inclination().tan().nearest().unwrap();
    let svgs = [subject(&pile), Subject::of_packing(packing)]
        .map(|s| figure::shear(&s).unwrap().to_string());
    assert!(svgs[0].contains("greatest 3 mg·tanθ") && svgs[1].contains("greatest 2.882 N"));
    let [multiples, newtons] = svgs.map(|svg| forces(&Document::parse(&svg).unwrap()));
    assert_eq!(multiples.len(), 55);
    for ((_, a), (_, b)) in multiples.iter().zip(&newtons) {
        for (a, b) in a.iter().zip(b) {
            assert!((a * tan - b).abs() <= 1e-15 * b.abs());
        }
    }
}
