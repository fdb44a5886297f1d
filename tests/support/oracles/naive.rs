//! A naive oracle: piles as sets of sites, the equilibrium of one sphere after the other.
//!
//! It knows who stands on whom (`paper`, "Stackings"), where the three supports of a sphere lie around it, and what a sphere
//! weighs. No regions, no runs, no transfer matrix, no common denominators: the three supporting forces are the
//! solution of the linear system of forces, from the geometry, in rationals. Of the library it has only the names of
//! sites and directions, for the comparison.
//!
//! Units: forces in f₀, whose vertical part is mg/3; a sphere weighs 3 of them.

use std::collections::{BTreeMap, BTreeSet};

use cannonpile::lattice::{Direction, Site};
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// (k, j, i): ordered as tables print sites, by layer, row, place in the row.
pub(crate) type Place = (i128, i128, i128);

/// The sites (j, i) of one layer.
pub(crate) type Sites = BTreeSet<(i128, i128)>;

pub(crate) fn ratio(n: i64, d: i64) -> BigRational {
    BigRational::new(n.into(), d.into())
}

/// A pile that nothing is known of but its sites, its steps and its weights.
#[derive(Clone, Debug)]
pub(crate) struct Naive {
    /// `+` or `-` for each step, from the top.
    pub(crate) signs: String,
    /// From the top.
    pub(crate) layers: Vec<Sites>,
    /// Of a sphere that is not in `weights`, in mg.
    pub(crate) ordinary: BigRational,
    /// Weight and load together of the others, in mg.
    pub(crate) weights: BTreeMap<Place, BigRational>,
}

/// The forces of a pile.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Forces {
    /// To the three spheres below, α, β, γ, in f₀; none of the last layer.
    pub(crate) below: BTreeMap<Place, [BigRational; 3]>,
    /// From the three spheres above; zero where there is none.
    pub(crate) above: BTreeMap<Place, [BigRational; 3]>,
    /// Normal force in mg, shear along x in mg·tanθ, along y in √3·mg·tanθ, of the last layer.
    pub(crate) floor: BTreeMap<Place, [BigRational; 3]>,
}

/// Where the three supports lie, in the order α, β, γ: (Δj, Δi).
fn supports(sign: char) -> [(i128, i128); 3] {
    match sign {
        '+' => [(0, 0), (0, 1), (1, 0)],
        _ => [(0, 0), (0, -1), (-1, 0)],
    }
}

/// The horizontal way from a sphere to its three supports, in thirds of the two lattice vectors of a layer: it sits
/// over the middle of the three.
fn ways(sign: char) -> [[BigRational; 2]; 3] {
    let sites = supports(sign);
    let middle = |pick: fn((i128, i128)) -> i128| sites.into_iter().map(pick).sum::<i128>();
    let middle = [middle(|site| site.1), middle(|site| site.0)];
    sites.map(|(j, i)| {
        [3 * i - middle[0], 3 * j - middle[1]].map(|way| BigRational::from_integer(way.into()))
    })
}

/// The place in the order of tables.
pub(crate) fn place(site: Site) -> Place {
    (site.k, site.j, site.i)
}

/// The library's name of a place.
pub(crate) fn site((k, j, i): Place) -> Site {
    Site { i, j, k }
}

/// The library's name of a direction.
pub(crate) fn direction(m: usize) -> Direction {
    [Direction::Alpha, Direction::Beta, Direction::Gamma][m]
}

impl Naive {
    /// Every layer all supports of the one above.
    pub(crate) fn under(top: &Sites, signs: &str) -> Self {
        let mut layers = vec![top.clone()];
        for sign in signs.chars() {
            let above = layers.last().expect("a top");
            let below = above.iter().flat_map(|&(j, i)| {
                supports(sign)
                    .into_iter()
                    .map(move |(dj, di)| (j + dj, i + di))
            });
            layers.push(below.collect());
        }
        Self::of(layers, signs)
    }

    /// Every layer all sites whose three supports are there; the signs are read from the top. `None` if a layer has no
    /// site.
    pub(crate) fn on(base: &Sites, signs: &str) -> Option<Self> {
        let mut layers = vec![base.clone()];
        for sign in signs.chars().rev() {
            let below = layers.last().expect("a base");
            // A sphere stands on its α support, whichever the sign.
            let carried = |&(j, i): &(i128, i128)| {
                let mut supports = supports(sign).into_iter();
                supports.all(|(dj, di)| below.contains(&(j + dj, i + di)))
            };
            let above: Sites = below.iter().copied().filter(carried).collect();
            if above.is_empty() {
                return None;
            }
            layers.push(above);
        }
        layers.reverse();
        Some(Self::of(layers, signs))
    }

    fn of(layers: Vec<Sites>, signs: &str) -> Self {
        Self {
            signs: signs.to_owned(),
            layers,
            ordinary: BigRational::one(),
            weights: BTreeMap::new(),
        }
    }

    /// Every place, in the order of tables.
    pub(crate) fn places(&self) -> impl Iterator<Item = Place> + '_ {
        let layers = (0..).zip(&self.layers);
        layers.flat_map(|(k, layer)| layer.iter().map(move |&(j, i)| (k, j, i)))
    }

    /// Whether there is a sphere.
    pub(crate) fn has(&self, (k, j, i): Place) -> bool {
        let layer = usize::try_from(k).ok().and_then(|k| self.layers.get(k));
        layer.is_some_and(|layer| layer.contains(&(j, i)))
    }

    /// The sign of the step down from layer k.
    pub(crate) fn sign(&self, k: i128) -> Option<char> {
        let k = usize::try_from(k).ok()?;
        self.signs.chars().nth(k)
    }

    /// The place a sphere presses on, whether or not there is one.
    pub(crate) fn below(&self, (k, j, i): Place, m: usize) -> Option<Place> {
        let (dj, di) = supports(self.sign(k)?)[m];
        Some((k + 1, j + dj, i + di))
    }

    /// The sphere that presses on a place in a direction.
    pub(crate) fn above(&self, (k, j, i): Place, m: usize) -> Option<Place> {
        let (dj, di) = supports(self.sign(k - 1)?)[m];
        Some((k - 1, j - dj, i - di)).filter(|above| self.has(*above))
    }

    /// Weight and load of a sphere, in mg.
    pub(crate) fn weight(&self, place: Place) -> &BigRational {
        self.weights.get(&place).unwrap_or(&self.ordinary)
    }

    /// Weight and loads of all spheres, in mg.
    pub(crate) fn whole_weight(&self) -> BigRational {
        self.places().map(|place| self.weight(place)).sum()
    }

    /// Solves the pile, from the top down.
    pub(crate) fn forces(&self) -> Forces {
        let balances = ['+', '-'].map(|sign| (sign, inverse(&ways(sign))));
        let mut forces = Forces::default();
        for place in self.places() {
            let above = [0, 1, 2].map(|m| match self.above(place, m) {
                Some(above) => forces.below[&above][m].clone(),
                None => BigRational::zero(),
            });
            let sign_above = self.sign(place.0 - 1).unwrap_or('+');
            let across = across(&above, &ways(sign_above));
            let pressed: BigRational = above.iter().sum();
            let down = pressed + self.weight(place) * ratio(3, 1);
            if let Some(sign) = self.sign(place.0) {
                let (_, inverse) = &balances[usize::from(sign != '+')];
                let load = [down, across[0].clone(), across[1].clone()];
                let below = inverse.each_ref().map(|row| dot(row, &load));
                forces.below.insert(place, below);
            } else {
                forces.floor.insert(place, on_floor(&down, &across));
            }
            forces.above.insert(place, above);
        }
        forces
    }
}

impl Forces {
    /// The least contact force and the first place and direction that have it.
    pub(crate) fn least(&self) -> Option<(BigRational, Place, usize)> {
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
    pub(crate) fn first_failure(&self) -> Option<i128> {
        let mut pulled = self.below.iter();
        let (place, _) = pulled.find(|(_, forces)| forces.iter().any(Signed::is_negative))?;
        Some(place.0)
    }
}

/// The horizontal force of three contacts.
fn across(forces: &[BigRational; 3], ways: &[[BigRational; 2]; 3]) -> [BigRational; 2] {
    [0, 1].map(|axis| {
        let parts = forces
            .iter()
            .zip(ways)
            .map(|(force, way)| force * &way[axis]);
        parts.sum()
    })
}

/// Normal force and shears from forces down and across the two lattice vectors, in f₀cosθ and in thirds of
/// lattice vectors.
///
/// The lattice vectors are two spheres' distance 2a = 2√3·R sinθ long. By the paper's (1) β − α lies along ê_a − ê_b,
/// along +y, and γ − α along ê_a − ê_c, at 30° to +x: e₁ = (0, 1)·√3ℓ and e₂ = (3/2, √3/2)·ℓ, with ℓ = 2R sinθ. A third of
/// 1 along e₁ is √3/3 sinθ f₀ along y; f₀ sinθ = mg·tanθ/3.
fn on_floor(down: &BigRational, across: &[BigRational; 2]) -> [BigRational; 3] {
    let [along_i, along_j] = across;
    [
        down / ratio(3, 1).numer(),
        along_j * ratio(1, 2) * ratio(1, 3),
        (along_i + along_j * ratio(1, 2)) * ratio(1, 3) * ratio(1, 3),
    ]
}

/// The inverse of the system of a sphere's equilibrium: Σf = down, Σf·way = across. By Gauss's elimination.
fn inverse(ways: &[[BigRational; 2]; 3]) -> [[BigRational; 3]; 3] {
    let mut rows: Vec<Vec<BigRational>> = (0..3)
        .map(|row| {
            let coefficient = |way: &[BigRational; 2]| match row {
                0 => BigRational::one(),
                axis => way[axis - 1].clone(),
            };
            let unit = (0..3).map(|column| ratio((column == row).into(), 1));
            ways.iter().map(coefficient).chain(unit).collect()
        })
        .collect();
    for column in 0..3 {
        let pivot = (column..3).find(|row| !rows[*row][column].is_zero());
        rows.swap(column, pivot.expect("three supports around a sphere"));
        let scale = rows[column][column].clone();
        let pivot: Vec<_> = rows[column].iter().map(|c| c / &scale).collect();
        for row in &mut rows {
            let factor = row[column].clone();
            for (c, p) in row.iter_mut().zip(&pivot) {
                *c -= &factor * p;
            }
        }
        rows[column] = pivot;
    }
    [0, 1, 2].map(|row| [3, 4, 5].map(|column| rows[row][column].clone()))
}

fn dot(row: &[BigRational; 3], column: &[BigRational; 3]) -> BigRational {
    row.iter().zip(column).map(|(a, b)| a * b).sum()
}
