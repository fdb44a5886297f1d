//! Figures, read back from their SVG: what is drawn is what the exact answers say, and whole.

mod shear;
mod whole;

use std::collections::BTreeMap;

use cannonpile::Pile;
use cannonpile::figure::{
    BaseMap, Indexing, Network, Picture, Response, Scale, SphereForces, Subject, WorkPrecision,
};
use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::scalar::Surd;
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Error, Packing};
use num_rational::BigRational;
use roxmltree::{Document, Node};

use crate::support::answers::ratio;

fn spacing() -> Spacing {
    Spacing::new(ratio(6, 5)).unwrap()
}

fn subject(pile: &Pile) -> Subject<'_> {
    Subject::of_pile(pile, &spacing()).unwrap()
}

/// The paper's pile, HCP under one sphere and under a hexagon, on a base, discs, and an isosceles base.
fn piles() -> Vec<Pile> {
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

/// The elements of a class, in the order of the document.
fn of_class<'a>(document: &'a Document<'_>, class: &str) -> Vec<Node<'a, 'a>> {
    let elements = document.descendants();
    let class = class.to_owned();
    elements
        .filter(|node| node.attribute("class") == Some(&class))
        .collect()
}

fn number(node: &Node<'_, '_>, name: &str) -> f64 {
    let text = node.attribute(name).unwrap_or_else(|| panic!("{name}"));
    text.parse().unwrap_or_else(|_| panic!("{name}: {text}"))
}

fn site(node: &Node<'_, '_>) -> Site {
    let index = |name| node.attribute(name).unwrap().parse().unwrap();
    Site {
        i: index("data-i"),
        j: index("data-j"),
        k: index("data-k"),
    }
}

/// The corners of a polygon.
fn corners(node: &Node<'_, '_>) -> Vec<[f64; 2]> {
    let points = node.attribute("points").unwrap().split(' ');
    points
        .map(|point| {
            let (x, y) = point.split_once(',').unwrap();
            [x.parse().unwrap(), y.parse().unwrap()]
        })
        .collect()
}

#[test]
fn every_sphere_of_a_picture_is_drawn_once_and_hides_only_those_behind() {
    for pile in piles() {
        let picture = Picture::new(&subject(&pile)).unwrap();
        let svg = picture.drawing().to_string();
        let document = Document::parse(&svg).unwrap();
        let drawn: Vec<Site> = of_class(&document, "sphere").iter().map(site).collect();
        assert!(
            drawn
                .iter()
                .eq(picture.spheres.iter().map(|sphere| &sphere.site))
        );
        let mut sites = drawn;
        sites.sort();
        assert!(sites.into_iter().eq(pile.shape().sites()));
        assert!(
            picture
                .spheres
                .is_sorted_by(|a, b| a.distance >= b.distance)
        );
    }
    // The nearest sphere of the paper's pile is at a corner of the base, the farthest at another.
    let pile = Pile::triangular(4).unwrap();
    let picture = Picture::new(&subject(&pile)).unwrap();
    let ends = [picture.spheres.first(), picture.spheres.last()];
    let corners = ends.map(|sphere| sphere.unwrap().site);
    assert_eq!(
        corners,
        [Site { i: 0, j: 3, k: 3 }, Site { i: 3, j: 0, k: 3 }]
    );
}

#[test]
fn near_spheres_look_larger_and_touching_ones_touch() {
    let pile = Pile::triangular(5).unwrap();
    let picture = Picture::new(&subject(&pile)).unwrap();
    assert!(
        picture
            .spheres
            .is_sorted_by(|a, b| a.radius <= b.radius + 1e-2)
    );
    let seen: BTreeMap<Site, _> = picture.spheres.iter().map(|s| (s.site, s)).collect();
    for (upper, at) in &seen {
        for direction in Direction::ALL {
            let Some(lower) = pile
                .shape()
                .below(*upper, direction)
                .and_then(|s| seen.get(&s))
            else {
                continue;
            };
            // Seen across, two spheres in contact never look farther apart than their radii.
            let apart = (at.at[0] - lower.at[0]).hypot(at.at[1] - lower.at[1]);
            assert!(
                apart < (at.radius + lower.radius) * 1.02,
                "{upper} {direction}"
            );
        }
    }
}

#[test]
fn base_cells_have_the_exact_forces_and_colours_in_their_order() {
    for pile in piles() {
        let subject = subject(&pile);
        let map = BaseMap::new(&subject).unwrap();
        let svg = map.drawing().to_string();
        let document = Document::parse(&svg).unwrap();
        let cells = of_class(&document, "cell");
        assert_eq!(cells.len().to_string(), pile.base_spheres().to_string());
        let statics = pile.forces::<BigRational>();
        let mut colours: Vec<(f64, String)> = Vec::new();
        for (cell, drawn) in map.cells.iter().zip(&cells) {
            assert_eq!(site(drawn), cell.site);
            let exact = statics.on_floor(cell.site).unwrap().normal;
            assert_eq!(cell.exact, Surd::from(exact));
            assert_eq!(Some(number(drawn, "data-value")), cell.exact.nearest());
            colours.push((cell.value, drawn.attribute("fill").unwrap().to_owned()));
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

/// How bright `#rrggbb` looks; an oracle for the library's own.
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
fn cells_tile_the_base_without_overlap() {
    let pile = Pile::triangular(6).unwrap();
    let svg = BaseMap::new(&subject(&pile)).unwrap().drawing().to_string();
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
    // A corner within belongs to three cells, one on the rim to one or two.
    let mut shared: BTreeMap<[i64; 2], usize> = BTreeMap::new();
    for [x, y] in cells.iter().flatten() {
        #[expect(clippy::cast_possible_truncation, reason = "pixels")]
        let place = [(x * 2.0).round() as i64, (y * 2.0).round() as i64];
        *shared.entry(place).or_default() += 1;
    }
    assert_eq!(shared.values().sum::<usize>(), 6 * 21);
    // One inner corner for each small triangle of neighbours: n² of them for a side of n = 5 steps.
    assert_eq!(shared.values().filter(|count| **count == 3).count(), 25);
}

#[test]
fn scales_are_monotone_and_even_about_zero() {
    let steps = |least: f64, most: f64| {
        (0..=100).map(move |n| least + (most - least) * f64::from(n) / 100.0)
    };
    let rising = Scale::of([2.0, 5.0]);
    let bright: Vec<f64> = steps(2.0, 5.0)
        .map(|x| rising.colour(x).luminance())
        .collect();
    assert!(bright.is_sorted() && bright[0] < 0.1 && bright[100] > 0.7);
    for scale in [
        Scale::around_zero([-3.0, 3.0]),
        Scale::of_lines([-3.0, 3.0]),
    ] {
        let bright = |x: f64| scale.colour(x).luminance();
        assert!(
            steps(0.0, 3.0)
                .map(bright)
                .collect::<Vec<_>>()
                .is_sorted_by(|a, b| a >= b)
        );
        assert!(
            steps(-3.0, 0.0)
                .map(bright)
                .collect::<Vec<_>>()
                .is_sorted_by(|a, b| a <= b)
        );
        // Told apart by more than brightness: blue on one side, red on the other.
        let [red, _, blue] = scale.colour(2.0).rgb;
        assert!(red > blue);
        let [red, _, blue] = scale.colour(-2.0).rgb;
        assert!(blue > red);
    }
    // Of one number, of none, and of the ends of the floats.
    for values in [
        vec![],
        vec![0.0],
        vec![7.0; 3],
        vec![-f64::MAX, f64::MAX],
        vec![5e-324, 0.0],
    ] {
        let scale = Scale::of(values.clone());
        for value in values {
            assert!(scale.colour(value).luminance().is_finite());
        }
    }
}

#[test]
fn sections_show_forces_between_neighbours_and_mirror_images() {
    for pile in piles() {
        let subject = subject(&pile);
        let network = Network::section(&subject).unwrap();
        let svg = network.drawing().to_string();
        let document = Document::parse(&svg).unwrap();
        assert_eq!(of_class(&document, "contact").len(), network.links.len());
        let packing = subject.packing();
        for link in &network.links {
            let exact = packing.contact(link.site, link.direction).unwrap();
            assert_eq!(Some(link.force), exact.nearest());
        }
        // Each sphere of a section is supported in it, unless it is on the floor or its row is a surface.
        if pile.layers() > 1 {
            assert!(!network.links.is_empty());
        }
    }
    // y → −y exchanges α and β, and leaves γ: in a pile of its own mirror image the forces of the section too.
    let pile = Pile::under(Region::SITE, Stacking::hcp(9).unwrap()).unwrap();
    let network = Network::section(&subject(&pile)).unwrap();
    let place = |[[a, b], [c, d]]: [[f64; 2]; 2]| {
        [a, b, c, d].map(|x| {
            #[expect(clippy::cast_possible_truncation, reason = "some R")]
            let thousandths = (x * 1e3).round() as i64;
            thousandths
        })
    };
    let forces: BTreeMap<_, f64> = network
        .links
        .iter()
        .map(|l| (place(l.ends), l.force))
        .collect();
    assert_eq!(forces.len(), network.links.len());
    for ([a, b, c, d], force) in &forces {
        assert_eq!(forces.get(&[-a, *b, -c, *d]), Some(force));
    }
}

#[test]
fn a_section_of_the_papers_pile_takes_one_row_a_layer() {
    let pile = Pile::triangular(10).unwrap();
    let network = Network::section(&subject(&pile)).unwrap();
    let mut rows: Vec<(i128, i128)> = network.spheres.iter().map(|(s, _)| (s.k, s.j)).collect();
    rows.dedup();
    // The row under the apex: j = k/3, rounded.
    let expected: Vec<_> = (0..10).map(|k| (k, (k + 1) / 3)).collect();
    assert_eq!(rows, expected);
    // Rows of k − j + 1 spheres; below each but the last two links where the row stays, one where it changes.
    let links: i128 = (0..9)
        .map(|k| {
            let j = (k + 1) / 3;
            (k - j + 1) * if (k + 2) / 3 == j { 2 } else { 1 }
        })
        .sum();
    assert_eq!(i128::try_from(network.links.len()), Ok(links));
}

#[test]
fn layers_show_every_contact_once() {
    for pile in piles() {
        let subject = subject(&pile);
        for k in 0..pile.layers() {
            let network = Network::layer(&subject, k);
            if k == pile.layers() - 1 {
                assert!(matches!(network, Err(Error::OnFloor { .. })));
                continue;
            }
            let network = network.unwrap();
            let contacts = pile
                .forces::<BigRational>()
                .contacts(Selection::Layer(k))
                .unwrap();
            let exact: Vec<_> = contacts
                .map(|c| c.map(|c| (c.site, c.direction)).unwrap())
                .collect();
            assert!(
                network
                    .links
                    .iter()
                    .map(|l| (l.site, l.direction))
                    .eq(exact)
            );
            // A contact is 2R long, and leans by θ: 2R sinθ seen from above.
            let sin: f64 = subject.packing().inclination().sin().nearest().unwrap();
            for link in network.links.iter().filter(|_| pile.is_regular()) {
                let [[a, b], [c, d]] = link.ends;
                assert!(((a - c).hypot(b - d) - 2.0 * sin).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn responses_add_up_to_the_load() {
    for stacking in [Stacking::fcc(6), Stacking::hcp(6), Stacking::dhcp(6)] {
        let top = Region::hexagon(3, 3).unwrap();
        let pile = Response::of_unit_load(Pile::under(top, stacking.unwrap()).unwrap()).unwrap();
        for k in 0..6 {
            let response = Response::new(&subject(&pile), k).unwrap();
            let sum = response
                .cells
                .iter()
                .map(|cell| cell.exact.to_rational().unwrap());
            assert_eq!(sum.sum::<BigRational>(), ratio(1, 1), "layer {k}");
            let svg = response.drawing().to_string();
            let document = Document::parse(&svg).unwrap();
            assert_eq!(of_class(&document, "cell").len(), response.cells.len());
            assert!(!of_class(&document, "cross").is_empty());
        }
    }
}

#[test]
fn a_responses_layer_is_the_floor_of_a_lower_pile() {
    let top = Region::hexagon(2, 2).unwrap();
    let pile = |layers| {
        let pile = Pile::under(top, Stacking::hcp(layers).unwrap()).unwrap();
        Response::of_unit_load(pile).unwrap()
    };
    let (whole, cut) = (pile(7), pile(4));
    let [within, below] =
        [&whole, &cut].map(|pile| Response::new(&subject(pile), 3).unwrap().cells);
    assert_eq!(within, below);
}

#[test]
fn forces_on_a_sphere_are_in_balance() {
    for pile in piles() {
        let pile = if pile.is_weightless() {
            pile
        } else {
            let first = pile.shape().sites().next().unwrap();
            pile.with_load(first, ratio(5, 3)).unwrap()
        };
        let subject = subject(&pile);
        for site in pile.shape().sites() {
            let sphere = SphereForces::new(&subject, site).unwrap();
            let mut sum = [0.0; 3];
            for force in &sphere.forces {
                for (sum, along) in sum.iter_mut().zip(force.along) {
                    *sum += force.magnitude * along;
                }
                let length = force.along.iter().map(|x| x * x).sum::<f64>();
                assert!((length - 1.0).abs() < 1e-12);
            }
            assert!(sum.iter().all(|part| part.abs() < 1e-10), "{site}: {sum:?}");
            let svg = sphere.drawing().to_string();
            let document = Document::parse(&svg).unwrap();
            let acting = sphere.forces.iter().filter(|force| force.magnitude != 0.0);
            assert_eq!(of_class(&document, "arrow").len(), acting.count());
        }
    }
}

#[test]
fn the_papers_names_of_forces() {
    let pile = Pile::triangular(10).unwrap();
    let site = Site { i: 1, j: 2, k: 5 };
    let sphere = SphereForces::new(&subject(&pile), site).unwrap();
    let cos = (13.0_f64 / 25.0).sqrt();
    // Eqs. (forces2): α′ = k−i−j, β′ = i, γ′ = j in mg/(3cosθ), and one more each below.
    let multiples = [
        ("a′", 2.0),
        ("b′", 1.0),
        ("c′", 2.0),
        ("a", 3.0),
        ("b", 2.0),
        ("c", 3.0),
    ];
    for (force, (name, multiple)) in sphere.forces.iter().zip(multiples) {
        assert_eq!(force.name, name);
        assert!((force.magnitude - multiple / (3.0 * cos)).abs() < 1e-15);
    }
}

#[test]
fn indices_are_those_of_the_paper() {
    let pile = Pile::triangular(10).unwrap();
    let svg = Indexing::new(&subject(&pile), 3)
        .unwrap()
        .drawing()
        .to_string();
    let document = Document::parse(&svg).unwrap();
    let spheres: BTreeMap<Site, [f64; 2]> = of_class(&document, "sphere")
        .iter()
        .map(|node| (site(node), [number(node, "cx"), number(node, "cy")]))
        .collect();
    assert_eq!(spheres.len(), 10);
    for (Site { i, j, k }, [x, y]) in &spheres {
        // i to the right; j to the right by half as much, and upwards.
        if let Some(next) = spheres.get(&Site {
            i: i + 1,
            j: *j,
            k: *k,
        }) {
            assert!(next[0] > *x && (next[1] - y).abs() < 1e-3);
        }
        if let Some(next) = spheres.get(&Site {
            i: *i,
            j: j + 1,
            k: *k,
        }) {
            assert!(next[0] > *x && next[1] < *y);
        }
        // Its own label, in its middle.
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
fn run_times_are_where_they_belong() {
    let table = include_str!("../../benches/work_precision/results.csv");
    let measured = WorkPrecision::read(table).unwrap();
    let svg = measured.drawing().to_string();
    let document = Document::parse(&svg).unwrap();
    let marks = of_class(&document, "mark");
    let rows = table.lines().skip(1);
    // Rows without numbers say why, and have no mark.
    assert!(measured.runs.len() > 100 && measured.runs.len() < rows.count());
    assert_eq!(marks.len(), measured.runs.len());
    // No error is clamped: as many exact ones are marked as there are, and all within the panels.
    let exact = marks
        .iter()
        .filter(|mark| number(mark, "data-error") == 0.0)
        .count();
    assert_eq!(
        exact,
        measured.runs.iter().filter(|run| run.error == 0.0).count()
    );
    assert_eq!(of_class(&document, "frame").len(), measured.piles().len());
}

#[test]
fn tables_that_are_none() {
    let heads = "pile,contacts,method,scalar,seconds,relative_error\n";
    for table in [
        "",
        "a,b\n1,2\n",
        heads,
        &format!("{heads}p,1,m,s,x,0\n"),
        &format!("{heads}p,1,m,s,0,0\n"),
        &format!("{heads}p,1,m,s,1,-1\n"),
        &format!("{heads}p,1,m,s,1,NaN\n"),
        &format!("{heads}p,1,m,s,inf,0\n"),
        &format!("{heads}p,1,m\n"),
        &format!("{heads}p,1,m,s,,\n"),
    ] {
        let refused = WorkPrecision::read(table);
        assert!(
            matches!(refused, Err(Error::Syntax { .. })),
            "{table:?}: {refused:?}"
        );
    }
    let many: Vec<String> = (0..25).map(|n| format!("p{n},1,m,s,1,0\n")).collect();
    let refused = WorkPrecision::read(&format!("{heads}{}", many.concat()));
    assert!(matches!(refused, Err(Error::TooManyMarks { .. })));
}

#[test]
fn too_many_marks_are_refused_before_they_are_computed() {
    let huge = Pile::triangular(10_i128.pow(30)).unwrap();
    let subject_of_huge = subject(&huge);
    let refusals = [
        Picture::new(&subject_of_huge).map(|_| ()),
        BaseMap::new(&subject_of_huge).map(|_| ()),
        cannonpile::figure::Shear::new(&subject_of_huge).map(|_| ()),
        Network::section(&subject_of_huge).map(|_| ()),
        Network::layer(&subject_of_huge, 10_i128.pow(20)).map(|_| ()),
        Response::new(&subject_of_huge, 10_i128.pow(29)).map(|_| ()),
        Indexing::new(&subject_of_huge, 1000).map(|_| ()),
    ];
    for refused in refusals {
        assert!(
            matches!(refused, Err(Error::TooManyMarks { .. })),
            "{refused:?}"
        );
    }
    // One sphere of it, or a layer near its top, is as good as of any other.
    let far = Site {
        i: 10_i128.pow(28),
        j: 17,
        k: 10_i128.pow(29),
    };
    let sphere = SphereForces::new(&subject_of_huge, far).unwrap();
    assert_eq!(sphere.forces.len(), 7);
    assert_eq!(
        Indexing::new(&subject_of_huge, 3)
            .unwrap()
            .drawing()
            .to_string()
            .matches("class=\"sphere\"")
            .count(),
        10
    );
    // Not a site away from where they belong, though 10³⁰ R from the apex.
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
            let svg = BaseMap::new(&subject(pile)).unwrap().drawing().to_string();
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
        BaseMap::new(&subject(&pile)),
        Err(Error::Overflow { .. })
    ));
    let pile = Pile::triangular(3).unwrap();
    let packing = Packing::new(&pile, &spacing())
        .unwrap()
        .with_radius(heavy)
        .unwrap();
    let wide = Subject::of_packing(packing);
    assert!(matches!(BaseMap::new(&wide), Err(Error::Overflow { .. })));
    // Where lengths are not shown they are not asked for.
    assert!(Picture::new(&wide).is_ok());
}
