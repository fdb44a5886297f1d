//! Horizontal contacts in figures: closed and open ones, and the bounds of base normal forces.

use cannonpile::Pile;
use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Axis, Region, Site};
use cannonpile::shape::Selection;
use cannonpile_figure::{self as figure, Subject};
use roxmltree::Document;

use crate::svg::{corners, exact, of_class, site};
use cannonpile_testkit::answers::ratio;

fn touching() -> Spacing {
    Spacing::new(ratio(1, 1)).unwrap()
}

#[test]
fn open_horizontal_contacts_are_dashed() {
    let bare = Pile::under(Region::SITE, "+-+-+".parse().unwrap()).unwrap();
    let elastic = cannonpile_horizontal::elastic(&bare, &ratio(1, 1)).unwrap();
    let pile = elastic.pile();
    let subject = Subject::of_pile(pile, &touching()).unwrap();
    for (subject, all) in [
        (subject.clone(), false),
        (subject.with_horizontal_contacts(), true),
    ] {
        for k in 0..5 {
            let svg = figure::layer(&subject, k).unwrap().to_string();
            let document = Document::parse(&svg).unwrap();
            let drawn = of_class(&document, "contact")
                .into_iter()
                .filter_map(|line| {
                    let axis: Axis = line.attribute("data-direction").unwrap().parse().ok()?;
                    let is_dashed = line.attribute("stroke-dasharray").is_some();
                    Some((site(&line), axis, is_dashed))
                });
            let mut drawn: Vec<(Site, Axis, bool)> = drawn.collect();
            drawn.sort();
            let spheres = pile.rows(Selection::Layer(k)).unwrap().flatten();
            let contacts = spheres.flat_map(|site| pile.shape().horizontal_contacts(site));
            let expected = contacts.map(|contact| {
                let is_open = pile.horizontal_force(contact) == ratio(0, 1);
                (contact.site, contact.axis, is_open)
            });
            let expected: Vec<_> = expected.filter(|(.., is_open)| all || !is_open).collect();
            assert_eq!(drawn, expected, "layer {k}");
        }
    }
}

#[test]
fn halves_of_cells_have_both_bounds() {
    for pile in [
        Pile::triangular(6).unwrap(),
        Pile::discs(5).unwrap(),
        Pile::on(Region::hexagon(3, 4).unwrap(), "-+".parse().unwrap()).unwrap(),
    ] {
        let subject = Subject::of_pile(&pile, &touching()).unwrap();
        let svg = figure::bounds(&subject).unwrap().to_string();
        let document = Document::parse(&svg).unwrap();
        let cells = of_class(&document, "cell");
        let mut halves = cells.chunks(2);
        for found in cannonpile_horizontal::base_bounds(&pile, Selection::Base).unwrap() {
            let (at, bounds) = found.unwrap();
            let [greatest, least] = halves.next().unwrap() else {
                panic!("a cell without two halves");
            };
            assert_eq!([site(greatest), site(least)], [at, at]);
            assert_eq!(exact(greatest), bounds.greatest.normal);
            assert_eq!(exact(least), bounds.least.normal);
            // The halves meet in a line, with the largest force above. On the page y points down.
            let [upper, lower] = [greatest, least].map(|half| {
                let heights: Vec<f64> = corners(half).into_iter().map(|[_, y]| y).collect();
                let end = |most: fn(f64, f64) -> f64| heights.iter().copied().reduce(most).unwrap();
                [end(f64::min), end(f64::max)]
            });
            assert!((upper[1] - lower[0]).abs() < 0.02, "{upper:?} {lower:?}");
            assert!(upper[0] < upper[1] && lower[0] < lower[1]);
        }
        assert!(halves.next().is_none());
    }
}
