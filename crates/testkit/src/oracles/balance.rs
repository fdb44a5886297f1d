//! The forces of any stacking on any region. A pile is a set of sites, solved by the equilibrium of one sphere after the
//! other.
//!
//! A sphere receives a force from each sphere that it supports, along the line of centres, and its weight and load. It
//! transmits the sum to its three supports. All supports are equally far down. In lattice coordinates, support m has the
//! horizontal offset σ·o_m, where σ = ±1 is the sign of the step. The offsets are o_α = (−1/3, −1/3), o_β = (2/3, −1/3)
//! and o_γ = (−1/3, 2/3). Three forces f_m balance a vertical force V and a horizontal force H if Σ f_m = 3V and Σ σ f_m
//! o_m = H. The solution is f_β = V + σH_i, f_γ = V + σH_j, with the rest of 3V for f_α. The oracle uses no half-turn, no
//! line and no run. It takes only the names of sites, signs and directions from the library.
//!
//! Units: forces in f₀, whose vertical part is mg/3; weights and V in mg.

use std::collections::BTreeMap;

use cannonpile::lattice::{Direction, Sign, Site};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

pub use super::sets::Sites;
use super::sets::{on, supports, under};

pub use crate::rational::ratio;

/// (k, j, i): layer, row, position in the row. This is the order of sites in tables.
pub type Place = (i128, i128, i128);

/// A pile as plain data: its sites, steps and weights.
#[derive(Clone, Debug)]
pub struct Balance {
    /// `+` or `-` for each step, from the top.
    pub signs: String,
    /// The layers from the top.
    pub layers: Vec<Sites>,
    /// The weight of a sphere that is not in `weights`, in mg.
    pub ordinary: BigRational,
    /// Weight plus load of the other spheres, in mg.
    pub weights: BTreeMap<Place, BigRational>,
    /// The horizontal force on a sphere from neighbours in its layer, along i and j, in f₀.
    pub horizontal: BTreeMap<Place, [BigRational; 2]>,
}

/// The forces of a pile.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Forces {
    /// The forces on the three spheres below, along α, β, γ, in f₀. The last layer has none.
    pub below: BTreeMap<Place, [BigRational; 3]>,
    /// The forces from the three spheres above. Zero for a missing sphere.
    pub above: BTreeMap<Place, [BigRational; 3]>,
    /// For the last layer: normal force in mg, shear along x in mg·tanθ, along y in √3·mg·tanθ.
    pub floor: BTreeMap<Place, [BigRational; 3]>,
}

/// The position of a site in the order of tables.
pub fn place(site: Site) -> Place {
    (site.k, site.j, site.i)
}

/// The site in the library's type.
pub fn site((k, j, i): Place) -> Site {
    Site { i, j, k }
}

/// The direction in the library's type.
pub fn direction(m: usize) -> Direction {
    [Direction::Alpha, Direction::Beta, Direction::Gamma][m]
}

/// The sign in the library's type.
fn named(sign: char) -> Sign {
    match sign {
        '+' => Sign::Plus,
        _ => Sign::Minus,
    }
}

fn all_named(signs: &str) -> Vec<Sign> {
    signs.chars().map(named).collect()
}

/// σ·force.
fn signed(sign: Sign, force: BigRational) -> BigRational {
    match sign {
        Sign::Plus => force,
        Sign::Minus => -force,
    }
}

impl Balance {
    /// Grows a pile down. Each layer contains all supports of the layer above.
    pub fn under(top: &Sites, signs: &str) -> Self {
        Self::of(under(top.clone(), &all_named(signs)), signs)
    }

    /// Grows a pile up. Each layer contains all sites with three supports. The signs are read from the top. `None` if a
    /// layer is empty.
    pub fn on(base: &Sites, signs: &str) -> Option<Self> {
        let layers = on(base.clone(), &all_named(signs));
        let whole = layers.iter().all(|layer| !layer.is_empty());
        whole.then(|| Self::of(layers, signs))
    }

    fn of(layers: Vec<Sites>, signs: &str) -> Self {
        Self {
            signs: signs.to_owned(),
            layers,
            ordinary: BigRational::one(),
            weights: BTreeMap::new(),
            horizontal: BTreeMap::new(),
        }
    }

    /// All positions in the order of tables.
    pub fn places(&self) -> impl Iterator<Item = Place> + '_ {
        let layers = (0..).zip(&self.layers);
        layers.flat_map(|(k, layer)| layer.iter().map(move |&(j, i)| (k, j, i)))
    }

    /// Adds a horizontal force between a sphere at `place` and its neighbour at the offset (Δi, Δj).
    pub fn add_horizontal_force(&mut self, place: Place, [di, dj]: [i128; 2], force: &BigRational) {
        let (k, j, i) = place;
        for (place, side) in [(place, -1), ((k, j + dj, i + di), 1)] {
            let horizontal = self.horizontal.entry(place).or_default();
            horizontal[0] += force * ratio(side, 1) * BigRational::from_integer(di.into());
            horizontal[1] += force * ratio(side, 1) * BigRational::from_integer(dj.into());
        }
    }

    /// Adds a horizontal force on a sphere: x·mg·tanθ along x and y·√3·mg·tanθ along y.
    ///
    /// By [`on_floor`], a force f₀ along e₁ has y = 1/3, and along e₂ it has x = 1/2 and y = 1/6.
    pub fn push(&mut self, place: Place, [x, y]: [BigRational; 2]) {
        let horizontal = self.horizontal.entry(place).or_default();
        let along_j = &x * ratio(2, 1);
        horizontal[0] += y * ratio(3, 1) - &along_j / ratio(2, 1);
        horizontal[1] += along_j;
    }

    /// Tells whether the pile has this sphere.
    pub fn has(&self, (k, j, i): Place) -> bool {
        let layer = usize::try_from(k).ok().and_then(|k| self.layers.get(k));
        layer.is_some_and(|layer| layer.contains(&(j, i)))
    }

    /// The sign of the step down from layer k.
    pub fn sign(&self, k: i128) -> Option<char> {
        let k = usize::try_from(k).ok()?;
        self.signs.chars().nth(k)
    }

    /// The support of a sphere in direction m. It need not exist.
    pub fn below(&self, (k, j, i): Place, m: usize) -> Option<Place> {
        let (j, i) = supports((j, i), named(self.sign(k)?))[m];
        Some((k + 1, j, i))
    }

    /// The sphere above a position in direction m, if it exists.
    pub fn above(&self, (k, j, i): Place, m: usize) -> Option<Place> {
        let (dj, di) = supports((0, 0), named(self.sign(k - 1)?))[m];
        Some((k - 1, j - dj, i - di)).filter(|above| self.has(*above))
    }

    /// Weight plus load of a sphere, in mg.
    pub fn weight(&self, place: Place) -> &BigRational {
        self.weights.get(&place).unwrap_or(&self.ordinary)
    }

    /// Weight and loads of all spheres, in mg.
    pub fn whole_weight(&self) -> BigRational {
        self.places().map(|place| self.weight(place)).sum()
    }

    /// The horizontal position in thirds of lattice vectors, relative to (0, 0) of the top layer.
    ///
    /// A + step moves the origin of the next layer back by a third of both vectors. There, a sphere lies above the centre of
    /// (0, 0), (1, 0) and (0, 1).
    pub fn position(&self, (k, j, i): Place) -> [BigInt; 2] {
        let steps = self
            .signs
            .chars()
            .take(usize::try_from(k).expect("a layer"));
        let back: i128 = steps.map(|sign| if sign == '+' { 1 } else { -1 }).sum();
        [3 * i - back, 3 * j - back].map(BigInt::from)
    }

    /// Solves the pile from the top down.
    pub fn forces(&self) -> Forces {
        let mut forces = Forces::default();
        for place in self.places() {
            let above = [0, 1, 2].map(|m| match self.above(place, m) {
                Some(above) => forces.below[&above][m].clone(),
                None => BigRational::zero(),
            });
            let third = above.iter().sum::<BigRational>() / ratio(3, 1);
            let down = &third + self.weight(place);
            let across = match self.sign(place.0 - 1) {
                Some(sign) => {
                    let [_, beta, gamma] = &above;
                    [beta, gamma].map(|force| signed(named(sign), force - &third))
                }
                None => [0, 0].map(|_| BigRational::zero()),
            };
            let pushed = self.horizontal.get(&place).cloned().unwrap_or_default();
            let [along_i, along_j] = across;
            let across = [along_i + &pushed[0], along_j + &pushed[1]];
            if let Some(sign) = self.sign(place.0) {
                let [beta, gamma] = across.map(|across| &down + signed(named(sign), across));
                let alpha = &down * ratio(3, 1) - &beta - &gamma;
                forces.below.insert(place, [alpha, beta, gamma]);
            } else {
                forces.floor.insert(place, on_floor(down, &across));
            }
            forces.above.insert(place, above);
        }
        forces
    }
}

impl Forces {
    /// The least contact force, with the first position and direction that have it.
    pub fn least(&self) -> Option<(BigRational, Place, usize)> {
        let mut least: Option<(BigRational, Place, usize)> = None;
        for (place, forces) in &self.below {
            for (m, force) in forces.iter().enumerate() {
                if least.as_ref().is_none_or(|(least, ..)| force < least) {
                    least = Some((force.clone(), *place, m));
                }
            }
        }
        least
    }

    /// The first layer with a tensile force.
    pub fn first_failure(&self) -> Option<i128> {
        let mut pulled = self.below.iter();
        let (place, _) = pulled.find(|(_, forces)| forces.iter().any(Signed::is_negative))?;
        Some(place.0)
    }
}

/// Normal force and shears from V and H.
///
/// The lattice vectors have length 2a = 2√3·R sinθ. By the paper, (1), β − α lies along ê_a − ê_b, which is +y. γ − α lies
/// along ê_a − ê_c, at 30° to +x. So e₁ = (0, 1)·√3ℓ and e₂ = (3/2, √3/2)·ℓ with ℓ = 2R sinθ. A force f₀ spans 2R along its
/// line and ℓ horizontally. So 1 along e₁ is √3 sinθ f₀ along y, and f₀ sinθ = mg·tanθ/3.
fn on_floor(down: BigRational, [along_i, along_j]: &[BigRational; 2]) -> [BigRational; 3] {
    let half = along_j * ratio(1, 2);
    let along_y = (along_i + &half) * ratio(1, 3);
    [down, half, along_y]
}
