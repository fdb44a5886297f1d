//! The forces of a small pile, sphere by sphere, from the three equations of equilibrium: the oracle of the engines.
//!
//! A sphere receives a push from each sphere that stands on it, along the line of their centres, and its weight and
//! load. It hands all that on to its three supports. In f₀, and in lattice coordinates, the support m lies
//! σ·o_m across, with o_α = (−1/3, −1/3), o_β = (2/3, −1/3), o_γ = (−1/3, 2/3), and the same way down; so three pushes
//! f_m with the sum V and Σ σ f_m o_m = H balance a vertical force V and a horizontal one H. They are f_β = V/3 + σH_i,
//! f_γ = V/3 + σH_j, and what is left of V for f_α. No half-turn, no line, no run comes in.

use std::collections::BTreeMap;

use cannonpile::lattice::{Direction, Sign, Site};
use cannonpile::{ContactForce, FloorForce};
use num_rational::BigRational;
use num_traits::Zero;

use crate::generators::number::ratio;
use crate::generators::region::Described;
use crate::support::oracles::sets::{Sites, on, supports, under, within};

/// Beyond the sites of every pile that is described.
const REACH: i128 = 16;

/// A sphere as k and its place in row order.
pub(crate) type Sphere = (i128, (i128, i128));

/// What a sphere hands on: in mg down, in f₀ across.
#[derive(Clone, Debug, Default)]
pub(crate) struct Handed {
    pub(crate) down: BigRational,
    /// Along i and j.
    pub(crate) across: [BigRational; 2],
}

/// Contacts as the library lists them.
pub(crate) type Contacts = Vec<ContactForce<BigRational>>;

/// Forces on the floor as the library lists them.
pub(crate) type Floor = Vec<FloorForce<BigRational>>;

/// A pile and its forces.
pub(crate) struct Balance {
    pub(crate) layers: Vec<Sites>,
    pub(crate) signs: Vec<Sign>,
    /// From above on each sphere along α, β, γ, in f₀.
    pub(crate) received: BTreeMap<Sphere, [BigRational; 3]>,
    /// To its supports, or to the floor.
    pub(crate) handed: BTreeMap<Sphere, Handed>,
    /// To each support of a sphere off the floor, in f₀.
    pub(crate) passed_on: BTreeMap<Sphere, [BigRational; 3]>,
    /// Weights and loads, in mg.
    pub(crate) acting: BTreeMap<Sphere, BigRational>,
}

impl Balance {
    pub(crate) fn of(described: &Described) -> Self {
        let region = described.region;
        let [x, y, s] = [region.x(), region.y(), region.s()];
        let bounds = [
            *x.start(),
            *x.end(),
            *y.start(),
            *y.end(),
            *s.start(),
            *s.end(),
        ];
        let (sites, signs) = (within(bounds, REACH), described.signs.clone());
        let layers = if described.from_base {
            on(sites, &signs)
        } else {
            under(sites, &signs)
        };
        let mut balance = Self {
            acting: acting(described, &layers),
            received: BTreeMap::new(),
            handed: BTreeMap::new(),
            passed_on: BTreeMap::new(),
            layers,
            signs,
        };
        for (k, layer) in (0..).zip(balance.layers.clone()) {
            for site in layer {
                balance.hand_on((k, site));
            }
        }
        balance
    }

    /// The sign of the step down from layer k.
    fn sign_below(&self, k: i128) -> Option<Sign> {
        self.signs.get(usize::try_from(k).ok()?).copied()
    }

    /// Spheres above have handed on already.
    fn hand_on(&mut self, sphere: Sphere) {
        let (k, site) = sphere;
        let received = self.received.entry(sphere).or_default().clone();
        let sum: BigRational = received.iter().sum();
        let mut handed = Handed {
            down: &sum / ratio(3, 1) + &self.acting[&sphere],
            across: [BigRational::zero(), BigRational::zero()],
        };
        if let Some(sign) = self.sign_below(k - 1) {
            let [_, beta, gamma] = received;
            handed.across = [beta, gamma].map(|f| (f - &sum / ratio(3, 1)) * sigma(sign));
        }
        if let Some(sign) = self.sign_below(k) {
            let [beta, gamma] = handed
                .across
                .each_ref()
                .map(|across| &handed.down + across * sigma(sign));
            let alpha = &handed.down * ratio(3, 1) - &beta - &gamma;
            let forces = [alpha, beta, gamma];
            for (m, support) in supports(site, sign).into_iter().enumerate() {
                self.received.entry((k + 1, support)).or_default()[m] = forces[m].clone();
            }
            self.passed_on.insert(sphere, forces);
        }
        self.handed.insert(sphere, handed);
    }

    /// The bottom spheres.
    pub(crate) fn base(&self) -> impl Iterator<Item = Sphere> + '_ {
        let floor = i128::try_from(self.signs.len()).expect("few layers");
        let base = self.layers.last().into_iter().flatten();
        base.map(move |site| (floor, *site))
    }

    /// Where a sphere is across from the top's (0, 0), along i and j: a + step moves the support α by o_α.
    pub(crate) fn place(&self, (k, (j, i)): Sphere) -> [BigRational; 2] {
        let above = self
            .signs
            .iter()
            .take(usize::try_from(k).expect("few layers"));
        let shift = above.fold(ratio(0, 1), |sum, sign| sum + sigma(*sign)) / ratio(3, 1);
        [i, j].map(|n| BigRational::from_integer(n.into()) - &shift)
    }
}

fn sigma(sign: Sign) -> BigRational {
    match sign {
        Sign::Plus => ratio(1, 1),
        Sign::Minus => ratio(-1, 1),
    }
}

/// Weight and load of every sphere.
fn acting(described: &Described, layers: &[Sites]) -> BTreeMap<Sphere, BigRational> {
    let spheres = (0..).zip(layers);
    let spheres = spheres.flat_map(|(k, layer)| layer.iter().map(move |site| (k, *site)));
    let mut acting: BTreeMap<Sphere, BigRational> =
        spheres.map(|sphere| (sphere, ratio(1, 1))).collect();
    for (site, weight) in &described.weights {
        acting.insert((site.k, (site.j, site.i)), weight.clone());
    }
    if described.weightless {
        acting.values_mut().for_each(Zero::set_zero);
    }
    for (site, load) in &described.loads {
        *acting.entry((site.k, (site.j, site.i))).or_default() += load;
    }
    acting
}

/// As the library names it.
pub(crate) fn site_of((k, (j, i)): Sphere) -> Site {
    Site { i, j, k }
}

/// The contacts of every sphere in row order, as the library lists them.
pub(crate) fn contacts_of(balance: &Balance) -> Contacts {
    let spheres = balance.passed_on.iter();
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

/// What bottom spheres hand on, in the units of the library: along x it is H_j/2, along y (H_i + H_j/2)/3.
pub(crate) fn floor_of(balance: &Balance) -> Floor {
    let force = |sphere: Sphere| {
        let handed = &balance.handed[&sphere];
        let [i, j] = &handed.across;
        let half = j / ratio(2, 1);
        FloorForce {
            site: site_of(sphere),
            normal: handed.down.clone(),
            shear_y: (i + &half) / ratio(3, 1),
            shear_x: half,
        }
    };
    balance.base().map(force).collect()
}
