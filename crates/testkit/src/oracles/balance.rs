//! The forces of any stacking on any region: piles as sets of sites, the equilibrium of one sphere after the other.
//!
//! A sphere receives a push from each sphere that stands on it, along the line of their centres, and its weight and
//! load. It hands all that on to its three supports. In lattice coordinates, the support m lies σ·o_m across, with
//! o_α = (−1/3, −1/3), o_β = (2/3, −1/3), o_γ = (−1/3, 2/3) and σ = ±1 the sign of the step, and the same way down; so
//! three forces f_m with Σ f_m = 3V and Σ σ f_m o_m = H balance a vertical force V and a horizontal one H. They are
//! f_β = V + σH_i, f_γ = V + σH_j, and the rest of 3V for f_α. No half-turn, no line, no run comes in, and of the library
//! no more than the names of sites, signs and directions.
//!
//! Units: forces in f₀, whose vertical part is mg/3; weights and V in mg.

use std::collections::BTreeMap;

use cannonpile::lattice::{Direction, Sign, Site};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

pub use super::sets::Sites;
use super::sets::{dilated, eroded, supports};

/// (k, j, i): ordered as tables print sites, by layer, row, place in the row.
pub type Place = (i128, i128, i128);

/// n/d.
pub fn ratio(n: i64, d: i64) -> BigRational {
    BigRational::new(n.into(), d.into())
}

/// A pile of which nothing is known but its sites, its steps and its weights.
#[derive(Clone, Debug)]
pub struct Balance {
    /// `+` or `-` for each step, from the top.
    pub signs: String,
    /// From the top.
    pub layers: Vec<Sites>,
    /// Of a sphere that is not in `weights`, in mg.
    pub ordinary: BigRational,
    /// Weight and load together of the others, in mg.
    pub weights: BTreeMap<Place, BigRational>,
    /// What neighbours of its layer push a sphere with, along i and j, in f₀.
    pub pushes: BTreeMap<Place, [BigRational; 2]>,
}

/// The forces of a pile.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Forces {
    /// To the three spheres below, α, β, γ, in f₀; none of the last layer.
    pub below: BTreeMap<Place, [BigRational; 3]>,
    /// From the three spheres above; zero where there is none.
    pub above: BTreeMap<Place, [BigRational; 3]>,
    /// Normal force in mg, shear along x in mg·tanθ, along y in √3·mg·tanθ, of the last layer.
    pub floor: BTreeMap<Place, [BigRational; 3]>,
}

/// The place in the order of tables.
pub fn place(site: Site) -> Place {
    (site.k, site.j, site.i)
}

/// The library's name of a place.
pub fn site((k, j, i): Place) -> Site {
    Site { i, j, k }
}

/// The library's name of a direction.
pub fn direction(m: usize) -> Direction {
    [Direction::Alpha, Direction::Beta, Direction::Gamma][m]
}

/// The library's name of a sign.
fn named(sign: char) -> Sign {
    match sign {
        '+' => Sign::Plus,
        _ => Sign::Minus,
    }
}

/// σ·force.
fn signed(sign: Sign, force: BigRational) -> BigRational {
    match sign {
        Sign::Plus => force,
        Sign::Minus => -force,
    }
}

impl Balance {
    /// Every layer all supports of the one above.
    pub fn under(top: &Sites, signs: &str) -> Self {
        let mut layers = vec![top.clone()];
        for (k, sign) in signs.chars().enumerate() {
            layers.push(dilated(&layers[k], named(sign)));
        }
        Self::of(layers, signs)
    }

    /// Every layer all sites whose three supports are there; the signs are read from the top. `None` if a layer has no
    /// site.
    pub fn on(base: &Sites, signs: &str) -> Option<Self> {
        let mut layers = vec![base.clone()];
        for (n, sign) in signs.chars().rev().enumerate() {
            layers.push(eroded(&layers[n], named(sign)));
        }
        layers.reverse();
        let whole = layers.iter().all(|layer| !layer.is_empty());
        whole.then(|| Self::of(layers, signs))
    }

    fn of(layers: Vec<Sites>, signs: &str) -> Self {
        Self {
            signs: signs.to_owned(),
            layers,
            ordinary: BigRational::one(),
            weights: BTreeMap::new(),
            pushes: BTreeMap::new(),
        }
    }

    /// Every place, in the order of tables.
    pub fn places(&self) -> impl Iterator<Item = Place> + '_ {
        let layers = (0..).zip(&self.layers);
        layers.flat_map(|(k, layer)| layer.iter().map(move |&(j, i)| (k, j, i)))
    }

    /// Lets two neighbours push each other: a sphere at `place`, and another (Δi, Δj) further.
    pub fn push(&mut self, place: Place, [di, dj]: [i128; 2], force: &BigRational) {
        let (k, j, i) = place;
        for (place, side) in [(place, -1), ((k, j + dj, i + di), 1)] {
            let pushes = self.pushes.entry(place).or_default();
            pushes[0] += force * ratio(side, 1) * BigRational::from_integer(di.into());
            pushes[1] += force * ratio(side, 1) * BigRational::from_integer(dj.into());
        }
    }

    /// Whether there is a sphere.
    pub fn has(&self, (k, j, i): Place) -> bool {
        let layer = usize::try_from(k).ok().and_then(|k| self.layers.get(k));
        layer.is_some_and(|layer| layer.contains(&(j, i)))
    }

    /// The sign of the step down from layer k.
    pub fn sign(&self, k: i128) -> Option<char> {
        let k = usize::try_from(k).ok()?;
        self.signs.chars().nth(k)
    }

    /// The place a sphere presses on, whether or not there is one.
    pub fn below(&self, (k, j, i): Place, m: usize) -> Option<Place> {
        let (j, i) = supports((j, i), named(self.sign(k)?))[m];
        Some((k + 1, j, i))
    }

    /// The sphere that presses on a place in a direction.
    pub fn above(&self, (k, j, i): Place, m: usize) -> Option<Place> {
        let (dj, di) = supports((0, 0), named(self.sign(k - 1)?))[m];
        Some((k - 1, j - dj, i - di)).filter(|above| self.has(*above))
    }

    /// Weight and load of a sphere, in mg.
    pub fn weight(&self, place: Place) -> &BigRational {
        self.weights.get(&place).unwrap_or(&self.ordinary)
    }

    /// Weight and loads of all spheres, in mg.
    pub fn whole_weight(&self) -> BigRational {
        self.places().map(|place| self.weight(place)).sum()
    }

    /// Horizontal position in thirds of lattice vectors, from the place (0, 0) of the top layer.
    ///
    /// A + step leads to a layer whose (0, 0) lies a third of both vectors back: a sphere is over the middle of (0, 0),
    /// (1, 0) and (0, 1).
    pub fn position(&self, (k, j, i): Place) -> [BigInt; 2] {
        let steps = self
            .signs
            .chars()
            .take(usize::try_from(k).expect("a layer"));
        let back: i128 = steps.map(|sign| if sign == '+' { 1 } else { -1 }).sum();
        [3 * i - back, 3 * j - back].map(BigInt::from)
    }

    /// Solves the pile, from the top down.
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
            let pushed = self.pushes.get(&place).cloned().unwrap_or_default();
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
    /// The least contact force and the first place and direction that have it.
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

    /// The first layer with a force that pulls.
    pub fn first_failure(&self) -> Option<i128> {
        let mut pulled = self.below.iter();
        let (place, _) = pulled.find(|(_, forces)| forces.iter().any(Signed::is_negative))?;
        Some(place.0)
    }
}

/// Normal force and shears from V and H.
///
/// The lattice vectors are two spheres' distance 2a = 2√3·R sinθ long. By the paper, (1), β − α lies along ê_a − ê_b,
/// along +y, and γ − α along ê_a − ê_c, at 30° to +x: e₁ = (0, 1)·√3ℓ and e₂ = (3/2, √3/2)·ℓ, with ℓ = 2R sinθ. A force
/// f₀ goes 2R down its line, ℓ of them across: 1 along e₁ is √3 sinθ f₀ along y, and f₀ sinθ = mg·tanθ/3.
fn on_floor(down: BigRational, [along_i, along_j]: &[BigRational; 2]) -> [BigRational; 3] {
    let half = along_j * ratio(1, 2);
    let along_y = (along_i + &half) * ratio(1, 3);
    [down, half, along_y]
}
