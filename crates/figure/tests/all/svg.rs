//! The piles of the tests, and functions that read the SVG of a figure.

use cannonpile::Pile;
use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Region, Site};
use cannonpile::stacking::Stacking;
use cannonpile_figure::Subject;
use cannonpile_testkit::answers::ratio;
use num_rational::BigRational;
use roxmltree::{Document, Node};

pub(crate) fn spacing() -> Spacing {
    Spacing::new(ratio(6, 5)).unwrap()
}

pub(crate) fn subject(pile: &Pile) -> Subject<'_> {
    Subject::of_pile(pile, &spacing()).unwrap()
}

/// Returns the pile of the paper, HCP under one sphere and under a hexagon, a pile on a base, discs, and an isosceles base.
pub(crate) fn piles() -> Vec<Pile> {
    let hexagon = Region::hexagon(3, 2).unwrap();
    vec![
        Pile::triangular(1).unwrap(),
        Pile::triangular(2).unwrap(),
        Pile::triangular(7).unwrap(),
        Pile::under(Region::SITE, Stacking::hcp(6).unwrap()).unwrap(),
        Pile::under(hexagon, Stacking::dhcp(5).unwrap()).unwrap(),
        Pile::on(Region::triangle(6).unwrap(), "-+".parse().unwrap()).unwrap(),
        Pile::discs(6).unwrap(),
        Pile::isosceles(5, ratio(2, 5)).unwrap(),
        Pile::triangular(4).unwrap().weightless(),
    ]
}

/// Returns the elements of a class, in the order of the document.
pub(crate) fn of_class<'a>(document: &'a Document<'_>, class: &str) -> Vec<Node<'a, 'a>> {
    let elements = document.descendants();
    let class = class.to_owned();
    elements
        .filter(|node| node.attribute("class") == Some(&class))
        .collect()
}

pub(crate) fn number(node: &Node<'_, '_>, name: &str) -> f64 {
    let text = node.attribute(name).unwrap_or_else(|| panic!("{name}"));
    text.parse().unwrap_or_else(|_| panic!("{name}: {text}"))
}

pub(crate) fn site(node: &Node<'_, '_>) -> Site {
    let index = |name| node.attribute(name).unwrap().parse().unwrap();
    Site {
        i: index("data-i"),
        j: index("data-j"),
        k: index("data-k"),
    }
}

/// Returns the centre of a circle, y down, and its radius.
pub(crate) fn disc(node: &Node<'_, '_>) -> ([f64; 2], f64) {
    let [x, y, radius] = ["cx", "cy", "r"].map(|name| number(node, name));
    ([x, y], radius)
}

/// Returns the exact number of a cell.
pub(crate) fn exact(node: &Node<'_, '_>) -> BigRational {
    node.attribute("data-exact").unwrap().parse().unwrap()
}

/// Returns the corners of a polygon.
pub(crate) fn corners(node: &Node<'_, '_>) -> Vec<[f64; 2]> {
    let points = node.attribute("points").unwrap().split(' ');
    points
        .map(|point| {
            let (x, y) = point.split_once(',').unwrap();
            [x.parse().unwrap(), y.parse().unwrap()]
        })
        .collect()
}
