//! The shear field, arrow by arrow.

use super::{corners, number, of_class, piles, site, subject};
use cannonpile::Pile;
use cannonpile::figure::{Shear, Subject};
use cannonpile::scalar::Surd;
use num_rational::BigRational;
use roxmltree::{Document, Node};

/// From the tail to the tip of an arrow, y up.
fn vector(arrow: &Node<'_, '_>) -> [f64; 2] {
    let corners = corners(arrow);
    assert_eq!(corners.len(), 7);
    let (first, tip, last) = (corners[0], corners[3], corners[6]);
    let tail = [first[0].midpoint(last[0]), first[1].midpoint(last[1])];
    [tip[0] - tail[0], tail[1] - tip[1]]
}

/// Pixels to a unit of force, by the key.
fn scale(document: &Document<'_>) -> f64 {
    let keys = of_class(document, "key");
    let [key] = &keys[..] else {
        panic!("one key, not {}", keys.len());
    };
    let [x, y] = vector(key);
    assert!(y.abs() < 1e-9);
    x / number(key, "data-force")
}

/// Whether every arrow of a document is as long and leads where the paper says, eq. (result-shear), for `layers` layers;
/// an oracle in floats.
fn is_the_papers(svg: &str, layers: i32) -> bool {
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
        // Two coordinates, each rounded to a ten thousandth of a pixel.
        (right - y * pixels).abs() < 4e-4 && (up - x * pixels).abs() < 4e-4
    })
}

#[test]
fn arrows_are_as_long_as_the_papers_formula_says() {
    for layers in [2, 3, 4, 7, 10, 19] {
        let pile = Pile::triangular(layers.into()).unwrap();
        let svg = Shear::new(&subject(&pile)).unwrap().drawing().to_string();
        assert!(is_the_papers(&svg, layers), "{layers} layers");
        // A test that could not fail would be none.
        assert!(!is_the_papers(&svg, layers + 1));
        assert!(!is_the_papers(
            &svg.replacen(
                "class=\"arrow\" data-i=\"1\"",
                "class=\"arrow\" data-i=\"0\"",
                1
            ),
            layers
        ));
        let document = Document::parse(&svg).unwrap();
        let count = of_class(&document, "arrow").len() + of_class(&document, "vanishing").len();
        assert_eq!(count.to_string(), pile.base_spheres().to_string());
        // Under the apex the force vanishes: a sphere is there if L ≡ 1 (mod 3).
        let still = usize::from(layers % 3 == 1);
        assert_eq!(of_class(&document, "vanishing").len(), still);
    }
}

#[test]
fn arrows_of_any_pile_are_the_exact_forces() {
    for pile in piles() {
        let subject = subject(&pile);
        let shear = Shear::new(&subject).unwrap();
        let statics = pile.forces::<BigRational>();
        let cos2 = BigRational::from_integer(1.into()) - pile.sin_phi() * pile.sin_phi();
        let across = Surd::sqrt(cos2 * BigRational::from_integer(4.into())).unwrap();
        for arrow in &shear.arrows {
            let exact = statics.on_floor(arrow.site).unwrap();
            let y = across.scaled(&exact.shear_y);
            assert_eq!(
                Some(arrow.force),
                Some([
                    Surd::from(exact.shear_x).nearest().unwrap(),
                    y.nearest().unwrap()
                ])
            );
        }
        let svg = shear.drawing().to_string();
        let document = Document::parse(&svg).unwrap();
        if shear.greatest() == 0.0 {
            assert!(
                of_class(&document, "key").is_empty() && of_class(&document, "arrow").is_empty()
            );
            continue;
        }
        let pixels = scale(&document);
        let discs = pile.shape().dimension().number() == 2;
        let forces = shear
            .arrows
            .iter()
            .filter(|arrow| arrow.force.iter().any(|part| *part != 0.0));
        let drawn = of_class(&document, "arrow");
        assert_eq!(drawn.len(), forces.clone().count());
        for (arrow, drawn) in forces.zip(drawn) {
            assert_eq!(site(&drawn), arrow.site);
            let [x, y] = arrow.force;
            let expected = if discs { [x, 0.0] } else { [y, x] };
            let [right, up] = vector(&drawn);
            assert!((right - expected[0] * pixels).abs() < 4e-4);
            assert!((up - expected[1] * pixels).abs() < 4e-4);
        }
    }
}

#[test]
fn units_are_newtons_if_they_are_asked_for() {
    let pile = Pile::triangular(10).unwrap();
    let packing = subject(&pile).packing().clone();
    let tan: f64 = packing.inclination().tan().nearest().unwrap();
    let [multiples, newtons] =
        [subject(&pile), Subject::of_packing(packing)].map(|s| Shear::new(&s).unwrap());
    assert_eq!((multiples.unit, newtons.unit), ("mg·tanθ", "N"));
    for (a, b) in multiples.arrows.iter().zip(&newtons.arrows) {
        for (a, b) in a.force.iter().zip(b.force) {
            assert!((a * tan - b).abs() <= 1e-15 * b.abs());
        }
    }
}
