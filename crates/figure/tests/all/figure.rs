//! The SVG of figures, compared with the exact forces.

use std::collections::{BTreeMap, BTreeSet};

use crate::svg::{corners, disc, exact, number, of_class, piles, site, spacing, subject};
use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::scalar::Surd;
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Packing, Pile};
use cannonpile_figure::{self as figure, Error, Figure, Layout, Subject};
use cannonpile_testkit::answers::ratio;
use num_rational::BigRational;
use num_traits::Zero;
use roxmltree::{Document, Node};

fn with_unit_load(pile: Pile) -> Pile {
    figure::with_load_on_top(pile, ratio(1, 1)).unwrap()
}

#[test]
fn spheres_are_drawn_once_from_back_to_front() {
    for pile in piles() {
        let svg = figure::pile(&subject(&pile)).unwrap().to_string();
        let document = Document::parse(&svg).unwrap();
        let drawn = of_class(&document, "sphere");
        let far = drawn.iter().map(|node| number(node, "data-distance"));
        assert!(far.is_sorted_by(|a, b| a >= b));
        let mut sites: Vec<Site> = drawn.iter().map(site).collect();
        sites.sort();
        assert!(sites.into_iter().eq(pile.shape().sites()));
        // There is one floor, and a shadow for each bottom sphere.
        assert_eq!(of_class(&document, "floor").len(), 1);
        let discs = pile.shape().dimension().number() == 2;
        let shadows = if discs {
            0_u32.into()
        } else {
            pile.base_sphere_count()
        };
        assert_eq!(
            of_class(&document, "shadow").len().to_string(),
            shadows.to_string()
        );
    }
    // In the pile of the paper, both the nearest and the farthest sphere are at corners of the base.
    let pile = Pile::triangular(4).unwrap();
    let svg = figure::pile(&subject(&pile)).unwrap().to_string();
    let document = Document::parse(&svg).unwrap();
    let drawn = of_class(&document, "sphere");
    let corners = [drawn.first(), drawn.last()].map(|sphere| site(sphere.unwrap()));
    assert_eq!(
        corners,
        [Site { i: 0, j: 3, k: 3 }, Site { i: 0, j: 0, k: 3 }]
    );
}

#[test]
fn perspective_scales_spheres_and_keeps_contacts() {
    let pile = Pile::triangular(5).unwrap();
    let svg = figure::pile(&subject(&pile)).unwrap().to_string();
    let document = Document::parse(&svg).unwrap();
    let drawn = of_class(&document, "sphere");
    let radii: Vec<f64> = drawn.iter().map(|node| disc(node).1).collect();
    assert!(radii.is_sorted_by(|a, b| *a <= b * 1.01));
    assert!(radii[0] < radii[34] * 0.95);
    let seen: BTreeMap<Site, _> = drawn.iter().map(|node| (site(node), disc(node))).collect();
    for (upper, ([x, y], radius)) in &seen {
        for direction in Direction::ALL {
            let Some(lower) = pile.shape().below(*upper, direction) else {
                continue;
            };
            // In a projection, spheres in contact are never farther apart than the sum of their radii.
            let ([u, v], other) = seen[&lower];
            assert!(
                (x - u).hypot(y - v) < (radius + other) * 1.02,
                "{upper} {direction}"
            );
        }
    }
    // The camera is at negative x, where the right-handed axes of the files have y on the left.
    let left = |i| seen[&Site { i, j: 0, k: 4 }].0[0];
    assert!(left(0) > left(2) && left(2) > left(4));
    let height = |k| seen[&Site { i: 0, j: 0, k }].0[1];
    assert!(height(0) < height(2) && height(2) < height(4));
}

#[test]
fn views_from_above_have_the_axes_of_the_files() {
    for pile in piles() {
        let packing = Packing::new(&pile, &spacing()).unwrap();
        let svg = figure::indexing(&subject(&pile), pile.layers() - 1)
            .unwrap()
            .to_string();
        let document = Document::parse(&svg).unwrap();
        let mut offset = None;
        for node in of_class(&document, "sphere") {
            let ([x, y], radius) = disc(&node);
            let place = packing.position(site(&node)).unwrap();
            let [u, v, _] = place.map(|part| part.nearest::<f64>().unwrap());
            // x points to the right and y upwards, with R = 1.
            let here = [x - u * radius, y + v * radius];
            let [a, b] = *offset.get_or_insert(here);
            assert!((here[0] - a).abs() < 1e-2 && (here[1] - b).abs() < 1e-2);
        }
    }
}

#[test]
fn base_cells_have_exact_forces_and_ordered_colours() {
    for pile in piles() {
        let svg = figure::base(&subject(&pile)).unwrap().to_string();
        let document = Document::parse(&svg).unwrap();
        let cells = of_class(&document, "cell");
        assert_eq!(
            cells.len().to_string(),
            pile.base_sphere_count().to_string()
        );
        let sites = pile.rows(Selection::Base).unwrap().flatten();
        assert!(cells.iter().map(site).eq(sites));
        let forces = pile.forces::<BigRational>();
        let mut colours: Vec<(f64, String)> = Vec::new();
        for cell in &cells {
            let normal = forces.on_floor(site(cell)).unwrap().normal;
            assert_eq!(exact(cell), normal);
            let value = number(cell, "data-value");
            assert_eq!(Some(value), Surd::from(normal).nearest());
            colours.push((value, cell.attribute("fill").unwrap().to_owned()));
        }
        colours.sort_by(|a, b| a.0.total_cmp(&b.0));
        for pair in colours.windows(2) {
            let [(a, left), (b, right)] = pair else {
                continue;
            };
            assert!(a < b || left == right);
            assert!(luminance(left) <= luminance(right) + 1e-9, "{left} {right}");
        }
    }
}

/// Returns the relative luminance of `#rrggbb`, an oracle for the function of the library.
fn luminance(colour: &str) -> f64 {
    let part = |n: usize| {
        let byte = u8::from_str_radix(&colour[n..n + 2], 16).unwrap();
        let part = f64::from(byte) / 255.0;
        if part <= 0.04045 {
            part / 12.92
        } else {
            ((part + 0.055) / 1.055).powf(2.4)
        }
    };
    0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5)
}

#[test]
fn cells_tile_the_base() {
    let pile = Pile::triangular(6).unwrap();
    let svg = figure::base(&subject(&pile)).unwrap().to_string();
    let document = Document::parse(&svg).unwrap();
    let cells: Vec<_> = of_class(&document, "cell").iter().map(corners).collect();
    let area = |corners: &[[f64; 2]]| {
        let turned = corners.iter().cycle().skip(1);
        let twice: f64 = corners
            .iter()
            .zip(turned)
            .map(|(a, b)| a[0] * b[1] - a[1] * b[0])
            .sum();
        (twice / 2.0).abs()
    };
    let one = area(&cells[0]);
    assert!(
        cells
            .iter()
            .all(|cell| (area(cell) - one).abs() < 1e-2 * one)
    );
    // An inner corner belongs to three cells, and a corner on the rim to one or two.
    let mut shared: BTreeMap<[i64; 2], usize> = BTreeMap::new();
    for [x, y] in cells.iter().flatten() {
        #[expect(clippy::cast_possible_truncation, reason = "pixels")]
        let place = [(x * 2.0).round() as i64, (y * 2.0).round() as i64];
        *shared.entry(place).or_default() += 1;
    }
    assert_eq!(shared.values().sum::<usize>(), 6 * 21);
    // Each triangle of neighbours has one inner corner: n² for a side of n = 5 steps.
    assert_eq!(shared.values().filter(|count| **count == 3).count(), 25);
}

/// Returns the contacts of a network: upper sphere, direction, force, and ends on the page.
fn links(document: &Document<'_>) -> Vec<(Site, Direction, f64, [f64; 4])> {
    let links = of_class(document, "contact");
    let link = |node: &Node<'_, '_>| {
        let direction = node.attribute("data-direction").unwrap();
        let named = |one: &&Direction| one.name() == direction;
        let direction = *Direction::ALL.iter().find(named).unwrap();
        let ends = ["x1", "y1", "x2", "y2"].map(|name| number(node, name));
        (site(node), direction, number(node, "data-force"), ends)
    };
    links.iter().map(link).collect()
}

#[test]
fn sections_have_neighbours_and_mirror_images() {
    for pile in piles() {
        let packing = Packing::new(&pile, &spacing()).unwrap();
        let svg = figure::section(&subject(&pile)).unwrap().to_string();
        let document = Document::parse(&svg).unwrap();
        let links = links(&document);
        for (site, direction, force, _) in &links {
            let exact = packing.contact(*site, *direction).unwrap();
            assert_eq!(Some(*force), exact.nearest());
        }
        // A section of several layers contains contacts.
        if pile.layers() > 1 {
            assert!(!links.is_empty());
        }
    }
    // The reflection y → −y exchanges α and β and keeps γ. A symmetric pile has the same forces in the reflected section.
    let pile = Pile::under(Region::SITE, Stacking::hcp(9).unwrap()).unwrap();
    let svg = figure::section(&subject(&pile)).unwrap().to_string();
    let document = Document::parse(&svg).unwrap();
    let spheres = of_class(&document, "sphere");
    let apex = spheres
        .iter()
        .find(|node| site(node) == Site::APEX)
        .unwrap();
    let ([axis, _], radius) = disc(apex);
    let rounded = |x: f64| {
        #[expect(clippy::cast_possible_truncation, reason = "some R")]
        let thousandths = (x / radius * 1e3).round() as i64;
        thousandths
    };
    let links = links(&document);
    let place = |[a, b, c, d]: [f64; 4]| [a - axis, b, c - axis, d].map(rounded);
    let forces: BTreeMap<_, f64> = links
        .iter()
        .map(|(_, _, force, ends)| (place(*ends), *force))
        .collect();
    assert_eq!(forces.len(), links.len());
    for ([a, b, c, d], force) in &forces {
        assert_eq!(forces.get(&[-a, *b, -c, *d]), Some(force));
    }
}

#[test]
fn section_has_one_row_of_each_layer() {
    let pile = Pile::triangular(10).unwrap();
    let svg = figure::section(&subject(&pile)).unwrap().to_string();
    let document = Document::parse(&svg).unwrap();
    let spheres = of_class(&document, "sphere");
    let mut rows: Vec<(i128, i128)> = spheres.iter().map(site).map(|s| (s.k, s.j)).collect();
    rows.dedup();
    // The row under the apex has j = k/3, rounded.
    let expected: Vec<_> = (0..10).map(|k| (k, (k + 1) / 3)).collect();
    assert_eq!(rows, expected);
    // A row has k − j + 1 spheres. Above the floor each has two contacts below if j stays the same, one if j changes.
    let count: i128 = (0..9)
        .map(|k| {
            let j = (k + 1) / 3;
            (k - j + 1) * if (k + 2) / 3 == j { 2 } else { 1 }
        })
        .sum();
    let links = links(&document);
    assert_eq!(i128::try_from(links.len()), Ok(count));
    assert!(links.iter().all(|(_, _, force, _)| *force > 0.0));
}

#[test]
fn layers_have_every_contact_once() {
    for pile in piles() {
        let subject = subject(&pile);
        let packing = Packing::new(&pile, &spacing()).unwrap();
        for k in 0..pile.layers() {
            let network = figure::layer(&subject, k);
            if k == pile.layers() - 1 {
                assert!(matches!(
                    network,
                    Err(Error::Core(cannonpile::Error::OnFloor { .. }))
                ));
                continue;
            }
            let svg = network.unwrap().to_string();
            let document = Document::parse(&svg).unwrap();
            let links = links(&document);
            let part = Selection::Layer(k);
            let contacts = pile.forces::<BigRational>().contacts(part).unwrap();
            let exact: BTreeSet<_> = contacts
                .map(|c| c.map(|c| (c.site, c.direction)).unwrap())
                .collect();
            assert_eq!(links.len(), exact.len());
            let drawn: BTreeSet<_> = links
                .iter()
                .map(|(site, direction, ..)| (*site, *direction))
                .collect();
            assert_eq!(drawn, exact);
            let (_, radius) = disc(&of_class(&document, "sphere")[0]);
            let sin: f64 = packing.inclination().sin().nearest().unwrap();
            for (site, direction, force, [a, b, c, d]) in links {
                let exact = packing.contact(site, direction).unwrap();
                assert_eq!(Some(force), exact.nearest());
                // From above a contact has the length 2R sinθ.
                let length = (a - c).hypot(b - d);
                assert!(!pile.is_regular() || (length - 2.0 * sin * radius).abs() < 4e-4);
            }
        }
    }
}

#[test]
fn responses_add_up_to_the_load() {
    for stacking in [Stacking::fcc(6), Stacking::hcp(6), Stacking::dhcp(6)] {
        let top = Region::hexagon(3, 3).unwrap();
        let pile = with_unit_load(Pile::under(top, stacking.unwrap()).unwrap());
        for k in 0..6 {
            let svg = figure::response(&subject(&pile), k).unwrap().to_string();
            let document = Document::parse(&svg).unwrap();
            let cells = of_class(&document, "cell");
            let sites = pile.rows(Selection::Layer(k)).unwrap().flatten();
            assert!(cells.iter().map(site).eq(sites));
            let sum: BigRational = cells.iter().map(exact).sum();
            assert_eq!(sum, ratio(1, 1), "layer {k}");
            for cell in &cells {
                let value = Surd::from(exact(cell)).nearest();
                assert_eq!(Some(number(cell, "data-value")), value);
            }
            assert!(!of_class(&document, "cross").is_empty());
        }
    }
}

#[test]
fn labels_of_cells_are_nonzero() {
    for layers in 2..9 {
        let top = Region::hexagon(5, 5).unwrap();
        let pile = Pile::under(top, Stacking::hcp(layers).unwrap()).unwrap();
        let pile = with_unit_load(pile);
        let svg = figure::response(&subject(&pile), layers - 1)
            .unwrap()
            .to_string();
        let document = Document::parse(&svg).unwrap();
        let texts = document
            .descendants()
            .filter(|node| node.has_tag_name("text"));
        for text in texts.filter_map(|node| node.text()) {
            let digits = text.trim_start_matches('−');
            let vanishes = digits.parse::<f64>().is_ok_and(|number| number == 0.0);
            // Ticks of axes and of the colour bar may be 0.
            assert!(!vanishes || text == "0", "{text}");
        }
        let shown = of_class(&document, "cell");
        let count = shown.iter().filter(|cell| !exact(cell).is_zero()).count();
        assert!(count >= 3);
    }
}

#[test]
fn response_of_a_layer_equals_base_of_a_lower_pile() {
    let top = Region::hexagon(2, 2).unwrap();
    let cells = |layers| {
        let pile = Pile::under(top, Stacking::hcp(layers).unwrap()).unwrap();
        let pile = with_unit_load(pile);
        let svg = figure::response(&subject(&pile), 3).unwrap().to_string();
        let document = Document::parse(&svg).unwrap();
        let cells = of_class(&document, "cell");
        let cell = |node: &Node<'_, '_>| (site(node), exact(node), number(node, "data-value"));
        cells.iter().map(cell).collect::<Vec<_>>()
    };
    let [within, below] = [7, 4].map(cells);
    assert_eq!(within, below);
    assert!(!below.is_empty());
}

/// Returns the arrows of the forces on a sphere: name, magnitude and vector.
fn arrows(svg: &str) -> Vec<(String, f64, [f64; 3])> {
    let document = Document::parse(svg).unwrap();
    let arrows = of_class(&document, "arrow");
    let arrow = |node: &Node<'_, '_>| {
        let vector = ["data-x", "data-y", "data-z"].map(|name| number(node, name));
        let name = node.attribute("data-name").unwrap();
        (name.to_owned(), number(node, "data-force"), vector)
    };
    arrows.iter().map(arrow).collect()
}

#[test]
fn forces_on_a_sphere_are_in_equilibrium() {
    for pile in piles() {
        let pile = if pile.is_weightless() {
            pile
        } else {
            let first = pile.shape().sites().next().unwrap();
            pile.with_load(first, ratio(5, 3)).unwrap()
        };
        let subject = subject(&pile);
        let forces = pile.forces::<BigRational>();
        for site in pile.shape().sites() {
            let svg = figure::sphere(&subject, site).unwrap().to_string();
            let shown = arrows(&svg);
            let mut sum = [0.0; 3];
            for (name, magnitude, vector) in &shown {
                let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
                assert!((length - magnitude.abs()).abs() < 1e-12 * length, "{name}");
                for (sum, part) in sum.iter_mut().zip(vector) {
                    *sum += part;
                }
            }
            assert!(sum.iter().all(|part| part.abs() < 1e-10), "{site}: {sum:?}");
            // Each nonzero force has an arrow.
            let acts = |force: &BigRational| usize::from(!force.is_zero());
            let above = forces.from_above(site).unwrap();
            let mut acting: usize = above.iter().map(acts).sum();
            if site.k == pile.layers() - 1 {
                acting += acts(&forces.on_floor(site).unwrap().normal);
            } else {
                let below = forces.contacts(Selection::One(site)).unwrap();
                acting += below
                    .map(|contact| acts(&contact.unwrap().force))
                    .sum::<usize>();
            }
            acting += acts(&pile.sphere_weight(site).unwrap());
            let loaded = !pile.is_weightless() && Some(site) == pile.shape().sites().next();
            acting += usize::from(loaded);
            assert_eq!(shown.len(), acting, "{site}");
        }
    }
}

#[test]
fn forces_have_the_names_of_the_paper() {
    let pile = Pile::triangular(10).unwrap();
    let site = Site { i: 1, j: 2, k: 5 };
    let svg = figure::sphere(&subject(&pile), site).unwrap().to_string();
    let forces = arrows(&svg);
    assert_eq!(forces.len(), 7);
    let cos = (13.0_f64 / 25.0).sqrt();
    // Paper, (10): α′ = k−i−j, β′ = i, γ′ = j in mg/(3cosθ), and one more for each contact below.
    let multiples = [
        ("a′", 2.0),
        ("b′", 1.0),
        ("c′", 2.0),
        ("a", 3.0),
        ("b", 2.0),
        ("c", 3.0),
    ];
    for (name, multiple) in multiples {
        let (_, magnitude, [x, _, z]) = forces.iter().find(|force| force.0 == name).unwrap();
        assert!((magnitude - multiple / (3.0 * cos)).abs() < 1e-15);
        // Forces from above point down, those from below up. α and β have the same sign of x, γ the opposite one.
        assert_eq!(*z < 0.0, name.ends_with('′'));
        assert_eq!(*x < 0.0, name.starts_with('c') != name.ends_with('′'));
    }
}

#[test]
fn tensile_contacts_are_visible_and_noted() {
    let pile = Pile::under(Region::SITE, Stacking::hcp(7).unwrap()).unwrap();
    let site = Site { i: 1, j: -2, k: 4 };
    let sphere = figure::sphere(&subject(&pile), site).unwrap();
    let svg = sphere.to_string();
    let pulling: Vec<_> = arrows(&svg)
        .into_iter()
        .filter(|force| force.1 < 0.0)
        .collect();
    assert_eq!(pulling.len(), 1);
    // The arrow is too short, so there is a ring, which the table explains.
    let document = Document::parse(&svg).unwrap();
    assert_eq!(of_class(&document, "small").len(), 1);
    assert!(svg.contains("− is tension") && svg.contains("○ is too small for an arrow"));
    // The figures note that the pile is unstable, and the section states the number of tensile contacts.
    for figure in [
        sphere,
        figure::shear(&subject(&pile)).unwrap(),
        figure::base(&subject(&pile)).unwrap(),
    ] {
        assert!(figure.note().is_some_and(|note| note.contains("unstable")));
        assert!(
            figure
                .to_string()
                .contains(">This pile is unstable without further contacts: ")
        );
    }
    let forces = pile.forces::<BigRational>();
    let all = forces.contacts(Selection::All).unwrap();
    let zero = BigRational::zero();
    let pulling = all
        .filter(|contact| contact.as_ref().unwrap().force < zero)
        .count();
    let svg = figure::section(&subject(&pile)).unwrap().to_string();
    let shown = links(&Document::parse(&svg).unwrap())
        .iter()
        .filter(|link| link.2 < 0.0)
        .count();
    assert!(svg.contains(&format!("{pulling} contacts in tension,")) && svg.contains("unstable"));
    assert!(svg.contains(&if shown == 0 {
        "none of them here".into()
    } else {
        format!("{shown} of them here")
    }));
    // A stable pile and spheres without weight have no note.
    let stable = Pile::triangular(7).unwrap();
    assert_eq!(figure::section(&subject(&stable)).unwrap().note(), None);
    let response = with_unit_load(pile);
    assert_eq!(
        figure::response(&subject(&response), 6).unwrap().note(),
        None
    );
}

#[test]
fn captions_name_top_and_base() {
    let hcp = || Stacking::hcp(4).unwrap();
    let region = Region::new(0..=1, 0..=4, 0..=4).unwrap();
    for (pile, words) in [
        (Pile::triangular(4).unwrap(), "4 layers, FCC, a/R = 6/5"),
        (
            Pile::under(Region::SITE, hcp()).unwrap(),
            "4 layers, HCP, a/R = 6/5",
        ),
        (
            Pile::under(Region::hexagon(5, 5).unwrap(), hcp()).unwrap(),
            "4 layers, HCP, top hexagon:5, a/R",
        ),
        (
            Pile::under(Region::hexagon(5, 3).unwrap(), hcp()).unwrap(),
            "HCP, top hexagon:5,3, a/R",
        ),
        (
            Pile::under(Region::triangle(2).unwrap(), hcp()).unwrap(),
            "HCP, top triangle:2, a/R",
        ),
        (
            Pile::under(region, hcp()).unwrap(),
            "HCP, top region:0..1,0..4,0..4, a/R",
        ),
        (
            Pile::on(Region::hexagon(4, 4).unwrap(), hcp()).unwrap(),
            "HCP, base hexagon:4, a/R",
        ),
    ] {
        let svg = figure::shear(&subject(&pile)).unwrap().to_string();
        assert!(svg.contains(words), "{words}");
    }
}

#[test]
fn layouts_keep_the_glyphs() {
    let pile = Pile::triangular(5).unwrap();
    let figure = || figure::base(&subject(&pile)).unwrap();
    let page = |figure: Figure| {
        let svg = figure.to_string();
        let document = Document::parse(&svg).unwrap();
        let root = document.root_element();
        let cells = of_class(&document, "cell");
        let cells: Vec<_> = cells.iter().map(corners).collect();
        let size = ["width", "height"].map(|name| number(&root, name));
        let titles = of_tag(&document, "title") + of_tag(&document, "desc");
        let shown = svg
            .matches(">Normal force of the pile on the floor</text>")
            .count();
        (size, cells, titles, shown)
    };
    let (size, cells, titles, shown) = page(figure());
    assert_eq!((size[0], titles, shown), (800.0, 2, 1));
    let wide = page(figure().laid_out(Layout {
        width: 400.0,
        title: true,
    }));
    assert_eq!(
        (wide.0, wide.1 == cells),
        ([size[0] / 2.0, size[1] / 2.0], true)
    );
    let bare = page(figure().laid_out(Layout {
        width: 800.0,
        title: false,
    }));
    assert_eq!((bare.0, bare.1 == cells), ([size[0], size[1] - 52.0], true));
    assert_eq!((bare.2, bare.3), (2, 0));
}

fn of_tag(document: &Document<'_>, name: &str) -> usize {
    document
        .descendants()
        .filter(|node| node.has_tag_name(name))
        .count()
}

#[test]
fn labels_have_the_indices_of_the_paper() {
    let pile = Pile::triangular(10).unwrap();
    let svg = figure::indexing(&subject(&pile), 3).unwrap().to_string();
    let document = Document::parse(&svg).unwrap();
    let spheres = of_class(&document, "sphere");
    let spheres: BTreeMap<Site, [f64; 2]> = spheres
        .iter()
        .map(|node| (site(node), disc(node).0))
        .collect();
    assert_eq!(spheres.len(), 10);
    for (Site { i, j, k }, [x, y]) in &spheres {
        let (i, j, k) = (*i, *j, *k);
        // i increases upwards, and j to the right and half as much upwards.
        if let Some(next) = spheres.get(&Site { i: i + 1, j, k }) {
            assert!((next[0] - x).abs() < 1e-3 && next[1] < *y);
        }
        if let Some(next) = spheres.get(&Site { i, j: j + 1, k }) {
            assert!(next[0] > *x && next[1] < *y);
        }
        // Each sphere has its label in the middle.
        let labels = document
            .descendants()
            .filter(|node| node.tag_name().name() == "text");
        let here = |node: &Node<'_, '_>| {
            (number(node, "x") - x).abs() + (number(node, "y") - y).abs() < 1e-3
        };
        let label: Vec<_> = labels
            .filter(here)
            .map(|node| node.text().unwrap())
            .collect();
        assert_eq!(label, [format!("{i},{j}")]);
    }
}

#[test]
fn too_many_glyphs_fail_before_the_computation() {
    let huge = Pile::triangular(10_i128.pow(30)).unwrap();
    let subject_of_huge = subject(&huge);
    let refusals = [
        figure::pile(&subject_of_huge).map(|_| ()),
        figure::base(&subject_of_huge).map(|_| ()),
        figure::shear(&subject_of_huge).map(|_| ()),
        figure::section(&subject_of_huge).map(|_| ()),
        figure::layer(&subject_of_huge, 10_i128.pow(20)).map(|_| ()),
        figure::response(&subject_of_huge, 10_i128.pow(29)).map(|_| ()),
        figure::indexing(&subject_of_huge, 1000).map(|_| ()),
    ];
    for refused in refusals {
        assert!(
            matches!(refused, Err(Error::TooManyGlyphs { .. })),
            "{refused:?}"
        );
    }
    // A single sphere and a layer near the top of the same pile can be drawn.
    let far = Site {
        i: 10_i128.pow(28),
        j: 17,
        k: 10_i128.pow(29),
    };
    let sphere = figure::sphere(&subject_of_huge, far).unwrap();
    assert_eq!(arrows(&sphere.to_string()).len(), 7);
    assert_eq!(
        figure::indexing(&subject_of_huge, 3)
            .unwrap()
            .to_string()
            .matches("class=\"sphere\"")
            .count(),
        10
    );
    // The positions are exact at a distance of 10³⁰ R from the apex.
    let base = Region::new(
        10_i128.pow(30)..=10_i128.pow(30) + 2,
        0..=2,
        i128::MIN / 4..=i128::MAX / 4,
    );
    if let Ok(base) = base {
        let pile = Pile::on(base, Stacking::single_layer()).unwrap();
        let near = Pile::on(
            Region::new(0..=2, 0..=2, 0..=4).unwrap(),
            Stacking::single_layer(),
        )
        .unwrap();
        let [far, near] = [&pile, &near].map(|pile| {
            let svg = figure::base(&subject(pile)).unwrap().to_string();
            let document = Document::parse(&svg).unwrap();
            of_class(&document, "cell")
                .iter()
                .map(corners)
                .collect::<Vec<_>>()
        });
        assert_eq!(far, near);
    }
}

#[test]
fn numbers_beyond_floats_are_errors() {
    let heavy = BigRational::from_integer(num_bigint::BigInt::from(10).pow(400));
    let pile = Pile::triangular(3)
        .unwrap()
        .with_load(Site::APEX, heavy.clone())
        .unwrap();
    assert!(matches!(
        figure::base(&subject(&pile)),
        Err(Error::Core(cannonpile::Error::Overflow { .. }))
    ));
    let pile = Pile::triangular(3).unwrap();
    let packing = Packing::new(&pile, &spacing())
        .unwrap()
        .with_radius(heavy)
        .unwrap();
    let wide = Subject::of_packing(packing);
    assert!(matches!(
        figure::base(&wide),
        Err(Error::Core(cannonpile::Error::Overflow { .. }))
    ));
    // A figure without lengths does not need the radius.
    assert!(figure::pile(&wide).is_ok());
}
