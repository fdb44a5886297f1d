//! The oracle's forces of a pile from the generators, under the library's names.

use std::collections::BTreeMap;

use cannonpile::lattice::{Direction, Site};
use cannonpile::{ContactForce, FloorForce};
use num_rational::BigRational;
use num_traits::Zero;

use crate::generators::region::Described;
use crate::oracles::balance::{Balance, Forces, Place, place, site};
use crate::oracles::sets::within;

/// A bound that lies outside every pile from the generators.
const REACH: i128 = 16;

/// A sphere as k and its position in row order.
pub type Sphere = (i128, (i128, i128));

/// Contacts as the library lists them.
pub type Contacts = Vec<ContactForce<BigRational>>;

/// Forces on the floor as the library lists them.
pub type Floor = Vec<FloorForce<BigRational>>;

/// A pile and its forces, solved by the oracle.
pub struct Solved {
    forces: Forces,
    /// The forces from above on each sphere along α, β, γ, in f₀.
    pub from_above: BTreeMap<Sphere, [BigRational; 3]>,
    /// The forces on each support of a sphere above the bottom layer, in f₀.
    pub to_below: BTreeMap<Sphere, [BigRational; 3]>,
    /// Weights and loads, in mg.
    pub acting: BTreeMap<Sphere, BigRational>,
}

impl Solved {
    /// Solves the described pile.
    pub fn of(described: &Described) -> Self {
        let pile = balance_of(described);
        let forces = pile.forces();
        let sphere = |(k, j, i): Place| (k, (j, i));
        let by_sphere = |forces: &BTreeMap<Place, [BigRational; 3]>| {
            let forces = forces.iter();
            forces
                .map(|(place, forces)| (sphere(*place), forces.clone()))
                .collect()
        };
        Self {
            from_above: by_sphere(&forces.above),
            to_below: by_sphere(&forces.below),
            acting: pile
                .places()
                .map(|place| (sphere(place), pile.weight(place).clone()))
                .collect(),
            forces,
        }
    }
}

/// The described pile in the oracle's form.
pub fn balance_of(described: &Described) -> Balance {
    let [x, y, s] = [
        described.region.x(),
        described.region.y(),
        described.region.s(),
    ];
    let bounds = [&x, &y, &s].map(|range| [*range.start(), *range.end()]);
    let [[x0, x1], [y0, y1], [s0, s1]] = bounds;
    let sites = within([x0, x1, y0, y1, s0, s1], REACH);
    let signs: String = described.signs.iter().map(ToString::to_string).collect();
    let mut pile = if described.from_base {
        Balance::on(&sites, &signs).expect("a base that supports its steps")
    } else {
        Balance::under(&sites, &signs)
    };
    for (site, weight) in &described.weights {
        pile.weights.insert(place(*site), weight.clone());
    }
    if described.weightless {
        pile.ordinary.set_zero();
        pile.weights.clear();
    }
    for (site, load) in &described.loads {
        let weight = pile.weight(place(*site)) + load;
        pile.weights.insert(place(*site), weight);
    }
    pile
}

/// The site of a sphere, in the library's type.
pub fn site_of((k, (j, i)): Sphere) -> Site {
    site((k, j, i))
}

/// The contacts of every sphere in row order, as the library lists them.
pub fn contacts_of(solved: &Solved) -> Contacts {
    let spheres = solved.to_below.iter();
    let contacts = spheres.flat_map(|(sphere, forces)| {
        let site = site_of(*sphere);
        Direction::ALL
            .into_iter()
            .zip(forces)
            .map(move |(direction, force)| ContactForce {
                site,
                direction,
                force: force.clone(),
            })
    });
    contacts.collect()
}

/// The forces on the floor in row order, as the library lists them.
pub fn floor_of(solved: &Solved) -> Floor {
    let floor = solved.forces.floor.iter();
    let force = |(at, [normal, shear_x, shear_y]): (&Place, &[BigRational; 3])| FloorForce {
        site: site(*at),
        normal: normal.clone(),
        shear_x: shear_x.clone(),
        shear_y: shear_y.clone(),
    };
    floor.map(force).collect()
}
