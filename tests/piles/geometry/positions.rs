//! Positions of spheres as lengths: contacts have the length of a diameter, and contact points are midpoints.

use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::scalar::Surd;
use cannonpile::{Packing, Pile};
use cannonpile_testkit::answers::{Shape, below, ratio};
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::overlap;

const LAYERS: i128 = 4;

/// Shapes with allowed values of q: between the bounds, and at them.
fn cases() -> impl Iterator<Item = (Shape, BigRational)> {
    let spheres = [
        ((1, 2), (1, 1)),
        ((1, 2), (36, 25)),
        ((1, 2), (2, 1)),
        ((1, 2), (8, 3)),
        ((2, 5), (5, 4)),
        ((1, 100), (3, 2)),
        ((3, 4), (2, 1)),
        ((5, 6), (27, 11)),
    ];
    let spheres = spheres
        .into_iter()
        .map(|((n, d), q)| (Shape::Spheres(ratio(n, d)), q));
    let discs = [(1, 1), (36, 25), (2, 1), (3, 1)].map(|q| (Shape::Discs, q));
    spheres
        .chain(discs)
        .map(|(shape, (n, d))| (shape, ratio(n, d)))
}

fn radius() -> BigRational {
    ratio(7, 3)
}

fn packing<'p>(pile: &'p Pile, q: &BigRational) -> Packing<'p> {
    let spacing = Spacing::from_square(q.clone()).unwrap();
    Packing::new(pile, &spacing)
        .unwrap()
        .with_radius(radius())
        .unwrap()
}

/// a − b for values along one axis. They have the same root unless one is zero.
fn minus(a: &Surd, b: &Surd) -> Surd {
    if *b == Surd::zero() {
        return a.clone();
    }
    if *a == Surd::zero() {
        return -b.clone();
    }
    assert_eq!(a.radicand(), b.radicand());
    let radicand = BigRational::from_integer(a.radicand().clone().into());
    Surd::new(a.coefficient() - b.coefficient(), radicand).unwrap()
}

fn squared_distance(a: &[Surd; 3], b: &[Surd; 3]) -> BigRational {
    let squares = a.iter().zip(b).map(|(a, b)| minus(a, b).square());
    squares.sum()
}

/// The distance from the brute-force search, by (k−i−j, i, j) steps along ê_a, ê_b, ê_c.
fn expected(shape: &Shape, q: &BigRational, from: Site, to: Site) -> BigRational {
    let steps = |s: Site| [s.k - s.i - s.j, s.i, s.j];
    let [[a, b, c], [x, y, z]] = [steps(from), steps(to)];
    let (n, d) = overlap::squared_distance(shape, [x - a, y - b, z - c], q);
    BigRational::new(n.into(), d.into()) * radius() * radius() * ratio(4, 1)
}

#[test]
fn all_distances() {
    for (shape, q) in cases() {
        let pile = shape.pile(LAYERS);
        let packing = packing(&pile, &q);
        let sites = shape.sites(LAYERS);
        let centres: Vec<_> = sites
            .iter()
            .map(|site| packing.position(*site).unwrap())
            .collect();
        for (from, a) in sites.iter().zip(&centres) {
            for (to, b) in sites.iter().zip(&centres) {
                let want = expected(&shape, &q, *from, *to);
                assert_eq!(
                    squared_distance(a, b),
                    want,
                    "{shape:?}, q = {q}: {from} {to}"
                );
            }
        }
    }
}

#[test]
fn contact_points_are_midpoints_of_the_centres() {
    let square = radius() * radius();
    for (shape, q) in cases() {
        let pile = shape.pile(LAYERS);
        let packing = packing(&pile, &q);
        for site in shape.sites(LAYERS - 1) {
            for direction in shape.directions() {
                let upper = packing.position(site).unwrap();
                let lower = packing.position(below(site, *direction)).unwrap();
                assert_eq!(squared_distance(&upper, &lower), &square * ratio(4, 1));
                // Only the midpoint has the distance R from both centres, which are 2R apart.
                let point = packing.contact_point(site, *direction).unwrap();
                assert_eq!(squared_distance(&upper, &point), square);
                assert_eq!(squared_distance(&lower, &point), square);
            }
        }
    }
}

/// z points up, and a/R is half the distance of two neighbours in a layer over R.
#[test]
fn the_frame() {
    for (shape, q) in cases() {
        let pile = shape.pile(LAYERS);
        let packing = packing(&pile, &q);
        let [x, y, top] = packing.position(Site::APEX).unwrap();
        assert!(x == Surd::zero() && y == Surd::zero());
        // Neighbouring layers have the distance 2R cosθ.
        let cos2 =
            BigRational::one() - &q / BigRational::from_integer(overlap::flat(&shape).into());
        let height = ratio(2, 1) * radius() * BigRational::from_integer((LAYERS - 1).into());
        assert_eq!(top.square(), &height * &height * cos2);
        assert!(top > Surd::zero());
        for site in shape.sites(LAYERS) {
            let [_, _, z] = packing.position(site).unwrap();
            assert_eq!(z == Surd::zero(), site.k == LAYERS - 1, "{site}");
            let share = BigRational::new((LAYERS - 1 - site.k).into(), (LAYERS - 1).into());
            assert_eq!(z, top.scaled(&share), "{site}");
        }
    }
}

/// Forces in newtons are parallel to the line of centres, and their magnitudes agree with pile units.
#[test]
fn forces_point_from_centre_to_centre() {
    for (shape, q) in cases() {
        let pile = shape.pile(LAYERS);
        let packing = packing(&pile, &q).with_mass(ratio(3, 5)).unwrap();
        let packing = packing.with_gravity(ratio(49, 5)).unwrap();
        let diameter = ratio(2, 1) * radius();
        for site in shape.sites(LAYERS - 1) {
            for direction in shape.directions() {
                let force = packing.contact(site, *direction).unwrap();
                let multiple = pile
                    .forces::<BigRational>()
                    .contact(site, *direction)
                    .unwrap();
                assert_eq!(force, packing.unit_force().scaled(&multiple));
                let upper = packing.position(site).unwrap();
                let lower = packing.position(below(site, *direction)).unwrap();
                let vector = packing.contact_vector(site, *direction).unwrap();
                for ((u, l), component) in upper.iter().zip(&lower).zip(vector) {
                    assert_eq!(component.scaled(&diameter), force.clone() * &minus(u, l));
                }
            }
        }
    }
}

/// On the floor the normal force is in mg, and shear in mg·tanθ and 2cosφ·mg·tanθ.
#[test]
fn forces_on_the_floor_in_newtons() {
    for (shape, q) in cases() {
        let pile = shape.pile(LAYERS);
        let packing = packing(&pile, &q).with_mass(ratio(3, 5)).unwrap();
        let packing = packing.with_gravity(ratio(49, 5)).unwrap();
        let weight = ratio(147, 25);
        assert_eq!(packing.sphere_weight(), weight);
        let flat = BigRational::from_integer(overlap::flat(&shape).into());
        let tan = Surd::sqrt(&q / (flat - &q)).unwrap();
        let across = match &shape {
            Shape::Discs => Surd::zero(),
            Shape::Spheres(s) => Surd::sqrt(ratio(4, 1) * (BigRational::one() - s * s)).unwrap(),
        };
        for site in shape
            .sites(LAYERS)
            .into_iter()
            .filter(|site| site.k == LAYERS - 1)
        {
            let multiple = pile.forces::<BigRational>().on_floor(site).unwrap();
            let force = packing.on_floor(site).unwrap();
            assert_eq!(force.normal, Surd::from(&multiple.normal * &weight));
            assert_eq!(force.shear_x, tan.scaled(&(&multiple.shear_x * &weight)));
            let shear_y = tan.clone() * &across;
            assert_eq!(
                force.shear_y,
                shear_y.scaled(&(&multiple.shear_y * &weight))
            );
            assert!(shape != Shape::Discs || multiple.shear_y.is_zero());
        }
    }
}

/// For a pile on a base, the origin is above the site (0, 0) of the base, and the steps lead up from there.
#[test]
fn positions_on_a_base_are_relative_to_its_origin() {
    let base = Region::hexagon(4, 4).unwrap();
    let top = Region::hexagon(2, 2).unwrap();
    let spacing = Spacing::new(ratio(1, 1)).unwrap();
    for signs in ["+--", "++-", "-"] {
        let grown_up = Pile::on(base, signs.parse().unwrap()).unwrap();
        let grown_down = Pile::under(top, signs.parse().unwrap()).unwrap();
        let last = grown_up.layers() - 1;
        for (pile, k) in [(grown_up, last), (grown_down, 0)] {
            let origin = Site { i: 0, j: 0, k };
            let packing = Packing::new(&pile, &spacing).unwrap();
            let [x, y, _] = packing.position(origin).unwrap();
            assert_eq!([x, y], [Surd::zero(), Surd::zero()], "{signs}");
        }
    }
}

/// The three contact vectors span the lattice of the pile. Their scalar products determine the type of the lattice.
#[test]
fn three_spacings_make_cubic_lattices() {
    for (lattice, q, scalar_product) in [
        ("face-centred cubic", ratio(1, 1), ratio(1, 2)),
        ("simple cubic", ratio(2, 1), ratio(0, 1)),
        ("body-centred cubic", ratio(8, 3), ratio(-1, 3)),
    ] {
        let pile = Pile::triangular(LAYERS).unwrap();
        let packing = packing(&pile, &q);
        let apex = packing.position(Site::APEX).unwrap();
        let contacts = Direction::ALL.map(|direction| {
            let lower = packing.position(below(Site::APEX, direction)).unwrap();
            [0, 1, 2].map(|axis| minus(&lower[axis], &apex[axis]))
        });
        let square = radius() * radius() * ratio(4, 1);
        for (n, a) in contacts.iter().enumerate() {
            for (m, b) in contacts.iter().enumerate() {
                let products = a.iter().zip(b).map(|(a, b)| (a.clone() * b).to_rational());
                let sum: BigRational = products.map(Option::unwrap).sum();
                let want = if n == m {
                    ratio(1, 1)
                } else {
                    scalar_product.clone()
                };
                assert_eq!(sum / &square, want, "{lattice}");
            }
        }
    }
}
