//! The library's answers about one pile as plain data. Tests can compare them and corrupt them.
//!
//! The sites follow the definition in `paper`, "Notation". This file lists them without the library.

use std::collections::BTreeMap;

use cannonpile::geometry::Vector;
use cannonpile::lattice::{Dimension, Direction, Site};
use cannonpile::{FloorForce, Pile};
use num_rational::BigRational;
use num_traits::Zero;

pub use crate::rational::ratio;

/// The form of a straight pile, without its number of layers.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// The plane pile, with two contacts below each disc.
    Discs,
    /// A pile on a triangle with this sin φ.
    Spheres(BigRational),
}

impl Shape {
    /// The base of the paper, φ = π/6.
    pub fn equilateral() -> Self {
        Self::Spheres(ratio(1, 2))
    }

    /// Isosceles bases from a narrow to a nearly flat triangle, with sin φ = ½ and 5/6 among them. Beyond 5/6 tall
    /// piles have no possible spacing.
    pub fn isosceles() -> impl Iterator<Item = Self> {
        let sines = [
            (1, 1000),
            (1, 100),
            (1, 10),
            (1, 7),
            (1, 5),
            (1, 4),
            (2, 7),
            (1, 3),
            (2, 5),
            (499, 1000),
            (1, 2),
            (501, 1000),
            (5, 9),
            (3, 5),
            (2, 3),
            (5, 7),
            (3, 4),
            (5, 6),
            (7, 8),
            (9, 10),
            (99, 100),
            (999, 1000),
        ];
        sines.into_iter().map(|(n, d)| Self::Spheres(ratio(n, d)))
    }

    /// Returns the pile of this shape with `layers` layers.
    pub fn pile(&self, layers: i128) -> Pile {
        let pile = match self {
            Self::Discs => Pile::discs(layers),
            Self::Spheres(sin_phi) => Pile::isosceles(layers, sin_phi.clone()),
        };
        pile.unwrap()
    }

    /// The dimension of the pile, in the library's type.
    pub fn dimension(&self) -> Dimension {
        match self {
            Self::Discs => Dimension::Two,
            Self::Spheres(_) => Dimension::Three,
        }
    }

    /// The directions of the contacts.
    pub fn directions(&self) -> &'static [Direction] {
        match self {
            Self::Discs => &[Direction::Alpha, Direction::Beta],
            Self::Spheres(_) => &[Direction::Alpha, Direction::Beta, Direction::Gamma],
        }
    }

    /// The sites by `paper`, "Notation": 0 ≤ k ≤ L−1, 0 ≤ j ≤ k, 0 ≤ i ≤ k−j. A pile of discs has only those with j = 0.
    pub fn sites(&self, layers: i128) -> Vec<Site> {
        let mut sites = Vec::new();
        for k in 0..layers {
            for j in 0..=k {
                for i in 0..=k - j {
                    if j == 0 || *self != Self::Discs {
                        sites.push(Site { i, j, k });
                    }
                }
            }
        }
        sites
    }
}

/// The site below (i, j, k) in a direction, in an infinite pile: A, B or C of the paper.
pub fn below(site: Site, direction: Direction) -> Site {
    let Site { i, j, k } = site;
    match direction {
        Direction::Alpha => Site { i, j, k: k + 1 },
        Direction::Beta => Site {
            i: i + 1,
            j,
            k: k + 1,
        },
        Direction::Gamma => Site {
            i,
            j: j + 1,
            k: k + 1,
        },
    }
}

/// The site above (i, j, k) in a direction, in an infinite pile: A′, B′ or C′ of the paper.
pub fn above(site: Site, direction: Direction) -> Site {
    let Site { i, j, k } = site;
    match direction {
        Direction::Alpha => Site { i, j, k: k - 1 },
        Direction::Beta => Site {
            i: i - 1,
            j,
            k: k - 1,
        },
        Direction::Gamma => Site {
            i,
            j: j - 1,
            k: k - 1,
        },
    }
}

/// The answers about the contact of a sphere with a sphere below it.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// The magnitude, in f₀.
    pub force: BigRational,
    /// The force on the upper sphere, in f₀ and the symbolic basis.
    pub vector: Vector<BigRational>,
}

/// The answers about one sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct Sphere {
    /// The position relative to the apex, in units of 2R and the symbolic basis.
    pub position: Vector<BigRational>,
    /// The forces from above by direction, in f₀.
    pub from_above: [BigRational; 3],
    /// The sum of the forces from above.
    pub resultant_above: Vector<BigRational>,
}

/// A pile and the answers about it, from the library ([`Answers::of`]) or from the oracle.
#[derive(Clone, Debug, PartialEq)]
pub struct Answers {
    /// The shape of the pile.
    pub shape: Shape,
    /// The number of layers.
    pub layers: i128,
    /// The weight of a sphere, in f₀ cosθ.
    pub weight: BigRational,
    /// The answers by sphere.
    pub spheres: BTreeMap<Site, Sphere>,
    /// The answers by upper sphere and direction.
    pub contacts: BTreeMap<(Site, Direction), Contact>,
    /// The forces on the floor: shear along x and y, and the normal force as z. They are in mg times (tanθ, 2cosφ·tanθ, 1).
    pub floor: BTreeMap<Site, Vector<BigRational>>,
}

impl Answers {
    /// Collects the library's answers about every sphere and every contact.
    pub fn of(shape: &Shape, layers: i128) -> Self {
        let pile = shape.pile(layers);
        let forces = pile.forces::<BigRational>();
        let mut answers = Self::none(shape, layers, forces.increment_sum().unwrap());
        for site in shape.sites(layers) {
            let sphere = Sphere {
                position: forces.position(site).unwrap(),
                from_above: forces.from_above(site).unwrap(),
                resultant_above: forces.resultant_above(site).unwrap(),
            };
            answers.spheres.insert(site, sphere);
            if site.k == layers - 1 {
                let FloorForce {
                    normal,
                    shear_x,
                    shear_y,
                    ..
                } = forces.on_floor(site).unwrap();
                let force = Vector {
                    x: shear_x,
                    y: shear_y,
                    z: normal,
                };
                answers.floor.insert(site, force);
                continue;
            }
            for direction in shape.directions() {
                let contact = Contact {
                    force: forces.contact(site, *direction).unwrap(),
                    vector: forces.contact_vector(site, *direction).unwrap(),
                };
                answers.contacts.insert((site, *direction), contact);
            }
        }
        answers
    }

    /// A pile without any answers.
    pub fn none(shape: &Shape, layers: i128, weight: BigRational) -> Self {
        Self {
            shape: shape.clone(),
            layers,
            weight,
            spheres: BTreeMap::new(),
            contacts: BTreeMap::new(),
            floor: BTreeMap::new(),
        }
    }

    /// The contact of `site` with the sphere above it. `None` if that sphere does not exist.
    pub fn contact_above(&self, site: Site, direction: Direction) -> Option<&Contact> {
        self.contacts.get(&(above(site, direction), direction))
    }

    /// The weight of one sphere as a vector, in f₀ and the symbolic basis.
    pub fn weight_vector(&self) -> Vector<BigRational> {
        let zero = BigRational::zero;
        Vector {
            x: zero(),
            y: zero(),
            z: self.weight.clone(),
        }
    }
}
