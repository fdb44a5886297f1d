//! Every figure of each test pile is a well-formed document, with all glyphs on the page and all numbers finite.

use cannonpile::lattice::{Region, Site};
use cannonpile::{Packing, Pile};
use cannonpile_figure::{self as figure, Figure, Layout, Subject};
use num_rational::BigRational;
use roxmltree::Document;

use crate::svg::{corners, number, piles, spacing, subject};
use cannonpile_testkit::answers::ratio;

/// Returns all figures of a pile.
fn figures(pile: &Pile, subject: &Subject<'_>) -> Vec<(&'static str, Figure)> {
    let last = pile.layers() - 1;
    let mut figures = vec![
        ("picture", figure::pile(subject).unwrap()),
        ("shear", figure::shear(subject).unwrap()),
        ("base", figure::base(subject).unwrap()),
        ("section", figure::section(subject).unwrap()),
        ("response", figure::response(subject, last).unwrap()),
        ("response of layer 0", figure::response(subject, 0).unwrap()),
        ("indexing", figure::indexing(subject, last.min(3)).unwrap()),
    ];
    let site = figure::example_site(pile).unwrap();
    figures.push(("sphere", figure::sphere(subject, site).unwrap()));
    if last > 0 {
        figures.push(("layer", figure::layer(subject, last - 1).unwrap()));
    }
    figures
}

/// Returns the first defect of an SVG document, if any.
fn defect(svg: &str) -> Option<String> {
    let document = match Document::parse(svg) {
        Ok(document) => document,
        Err(error) => return Some(error.to_string()),
    };
    let root = document.root_element();
    let page: Vec<f64> = root
        .attribute("viewBox")?
        .split(' ')
        .map(|x| x.parse().unwrap())
        .collect();
    let (top, width, height) = (page[1], page[2], page[3]);
    let [shown_width, shown_height] = ["width", "height"].map(|name| number(&root, name));
    if (shown_width - width).abs() + (shown_height - height).abs() > 0.0 {
        return Some("width and height differ from the viewBox".into());
    }
    let outside =
        |x: f64, y: f64| !(0.0..=width).contains(&x) || !(top..=top + height).contains(&y);
    for node in root.descendants().filter(roxmltree::Node::is_element) {
        for attribute in node.attributes() {
            if ["NaN", "inf"].iter().any(|word| attribute.value() == *word) {
                return Some(format!("{attribute:?}"));
            }
        }
        let places: Vec<[f64; 2]> = match node.tag_name().name() {
            "circle" => {
                let [x, y, r] = ["cx", "cy", "r"].map(|name| number(&node, name));
                vec![[x - r, y - r], [x + r, y + r]]
            }
            "line" => {
                let [x1, y1, x2, y2] = ["x1", "y1", "x2", "y2"].map(|name| number(&node, name));
                vec![[x1, y1], [x2, y2]]
            }
            "polygon" => corners(&node),
            "rect" if node.attribute("class") != Some("page") => {
                let [x, y, w, h] = ["x", "y", "width", "height"].map(|name| number(&node, name));
                vec![[x, y], [x + w, y + h]]
            }
            "text" => {
                // The ends of the text in a typical font. The library leaves room for a wider font.
                let [x, y, size] = ["x", "y", "font-size"].map(|name| number(&node, name));
                let letters =
                    f64::from(u32::try_from(node.text().unwrap().chars().count()).unwrap());
                let long = letters * size * 0.5;
                let [before, after] = match node.attribute("text-anchor") {
                    Some("start") => [0.0, long],
                    Some("end") => [long, 0.0],
                    _ => [long / 2.0, long / 2.0],
                };
                if node.attribute("transform").is_some() {
                    vec![[x, y - after], [x, y + before]]
                } else {
                    vec![[x - before, y - size / 2.0], [x + after, y + size / 2.0]]
                }
            }
            _ => Vec::new(),
        };
        if let Some([x, y]) = places.into_iter().find(|[x, y]| outside(*x, *y)) {
            return Some(format!(
                "{:?} {:?} reaches ({x}, {y})",
                node.tag_name(),
                node.text()
            ));
        }
    }
    let titles = root.children().filter(|node| node.has_tag_name("title"));
    (titles.count() != 1).then(|| "not exactly one title".into())
}

#[test]
fn glyphs_are_on_the_page() {
    for pile in piles() {
        for (name, figure) in figures(&pile, &subject(&pile)) {
            assert_eq!(
                defect(&figure.to_string()),
                None,
                "{name} of {} layers",
                pile.layers()
            );
            let bare = figure.laid_out(Layout {
                width: 800.0,
                title: false,
            });
            assert_eq!(
                defect(&bare.to_string()),
                None,
                "{name} of {} layers",
                pile.layers()
            );
        }
    }
}

#[test]
fn defects_are_found() {
    let pile = Pile::triangular(4).unwrap();
    let svg = figure::shear(&subject(&pile)).unwrap().to_string();
    assert_eq!(defect(&svg), None);
    for (from, to) in [
        ("</svg>", ""),
        ("<circle cx=\"", "<circle cx=\"9"),
        ("points=\"", "points=\"-1,5 "),
        ("font-size=\"20\"", "font-size=\"200\""),
        ("<title>", "<desc>"),
    ] {
        let faulty = svg.replacen(from, to, 1);
        assert_ne!(faulty, svg, "{from}");
        assert!(defect(&faulty).is_some(), "{from}");
    }
}

#[test]
fn figures_of_extreme_sizes() {
    let tiny = BigRational::new(1.into(), num_bigint::BigInt::from(10).pow(310));
    let great = BigRational::from_integer(num_bigint::BigInt::from(10).pow(300));
    let long = ratio(1_000_003, 999_983);
    let pile = Pile::under(Region::SITE, "+-".parse().unwrap()).unwrap();
    for size in [&tiny, &great, &long] {
        for weight in [&tiny, &great, &long] {
            let packing = Packing::new(&pile, &spacing()).unwrap();
            let packing = packing.with_radius(size.clone()).unwrap();
            let packing = packing.with_mass(weight.clone()).unwrap();
            for (name, figure) in figures(&pile, &Subject::of_packing(packing)) {
                assert_eq!(defect(&figure.to_string()), None, "{name}");
            }
        }
    }
}

#[test]
fn figures_of_long_and_many_loads() {
    let site = |i, k| Site { i, j: 0, k };
    let mut pile = Pile::triangular(6).unwrap().weightless();
    for n in 0..6 {
        pile = pile
            .with_load(
                site(n, 5),
                ratio(1_234_567 + i64::try_from(n).unwrap(), 7_654_321),
            )
            .unwrap();
    }
    let one = Pile::triangular(3)
        .unwrap()
        .with_load(site(0, 2), ratio(1_234_567_891, 7))
        .unwrap();
    for pile in [pile, one] {
        for (name, figure) in figures(&pile, &subject(&pile)) {
            assert_eq!(defect(&figure.to_string()), None, "{name}");
        }
    }
}
