//! All compressive states of a pile with horizontal contacts, and linear programs over them: exact, dense, slow.
//!
//! The forces are affine in the horizontal ones. [`Balance`] is solved once without horizontal forces, and once for a unit
//! force in each contact. The compressive states form a polytope, and the simplex method finds its corners. The method uses
//! no duality, no certificate and no float.

use core::iter::once;
use std::collections::{BTreeMap, BTreeSet};

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::balance::{Balance, Forces, Place, ratio};

/// b + Σ a x, stored as b followed by the coefficients a.
pub type Affine = Vec<BigRational>;

/// A horizontal contact: a sphere, and the offset (Δi, Δj) of its neighbour.
pub type Pair = (Place, [i128; 2]);

/// The forces of a pile, in f₀, as affine functions of the horizontal ones.
#[derive(Clone, Debug)]
pub struct States {
    /// The horizontal contacts above the bottom layer.
    pub contacts: Vec<Pair>,
    /// The forces of the sloping contacts.
    pub sloping: Vec<Affine>,
    /// The normal forces of the bottom spheres, in mg.
    pub normals: BTreeMap<Place, Affine>,
}

impl States {
    /// Collects the states of a pile. The function `forces` solves it: [`Balance::forces`] or [`of_discs`].
    pub fn of(pile: &Balance, forces: fn(&Balance) -> Forces) -> Self {
        let free = pile.places().filter(|place| pile.sign(place.0).is_some());
        let pairs = free.flat_map(|place| [[1, 0], [0, 1], [1, -1]].map(|step| (place, step)));
        let contacts: Vec<Pair> = pairs
            .filter(|((k, j, i), [di, dj])| pile.has((*k, j + dj, i + di)))
            .collect();
        let pushed = contacts.iter().map(|pair| forces(&pushed(pile, *pair)));
        let all: Vec<Forces> = once(forces(pile)).chain(pushed).collect();
        let sloping = all[0].below.keys().flat_map(|place| {
            [0, 1, 2].map(|m| affine(all.iter().map(|forces| &forces.below), place, m))
        });
        let normals = all[0].floor.keys().map(|place| {
            let normal = affine(all.iter().map(|forces| &forces.floor), place, 0);
            (*place, normal)
        });
        Self {
            sloping: sloping.collect(),
            normals: normals.collect(),
            contacts,
        }
    }

    /// A state without tension. `None` if all states have a tensile contact.
    pub fn compressive_corner(&self) -> Option<Corner> {
        Corner::first(self.contacts.len(), &self.sloping)
    }

    /// Tells whether no contact is tensile.
    pub fn is_compressive(&self, x: &[BigRational]) -> bool {
        let pulls = self.sloping.iter().any(|force| at(force, x).is_negative());
        !pulls && !x.iter().any(Signed::is_negative)
    }

    /// Σ f² + Σ X²/ratio, which is twice the energy of the springs.
    pub fn energy(&self, x: &[BigRational], stiffness_ratio: &BigRational) -> BigRational {
        let sloping = self.sloping.iter().map(|force| at(force, x));
        let sloping: BigRational = sloping.map(|force| &force * &force).sum();
        let horizontal: BigRational = x.iter().map(|force| force * force).sum();
        sloping + horizontal / stiffness_ratio
    }

    /// The derivative of [`energy`](Self::energy) at x along y, without a constant and a factor 2: Σ f(x) a y + Σ X y/ratio.
    pub fn slope(&self, x: &[BigRational], stiffness_ratio: &BigRational) -> Affine {
        let mut slope: Affine = once(BigRational::zero())
            .chain(x.iter().map(|force| force / stiffness_ratio))
            .collect();
        for affine in &self.sloping {
            let force = at(affine, x);
            for (slope, a) in slope[1..].iter_mut().zip(&affine[1..]) {
                *slope += &force * a;
            }
        }
        slope
    }
}

/// The spheres that the force of a horizontal contact reaches, without weight and under a unit force in this contact.
fn pushed(pile: &Balance, (place, [di, dj]): Pair) -> Balance {
    let (k, j, i) = place;
    let mut pushed = Balance {
        signs: pile.signs.clone(),
        layers: vec![[].into(); pile.layers.len()],
        ordinary: ratio(0, 1),
        weights: [].into(),
        horizontal: [].into(),
    };
    pushed.add_horizontal_force(place, [di, dj], &ratio(1, 1));
    let mut reached: BTreeSet<Place> = [place, (k, j + dj, i + di)].into();
    while !reached.is_empty() {
        for (k, j, i) in &reached {
            pushed.layers[usize::try_from(*k).expect("a layer")].insert((*j, *i));
        }
        let below = |place: Place| (0..3).filter_map(move |m| pile.below(place, m));
        let below = reached.into_iter().flat_map(below);
        reached = below.filter(|place| pile.has(*place)).collect();
    }
    pushed
}

/// The coefficients of one force: its values in each of the solved piles. A pile without the sphere transmits no force.
fn affine<'a>(
    piles: impl Iterator<Item = &'a BTreeMap<Place, [BigRational; 3]>>,
    place: &Place,
    m: usize,
) -> Affine {
    let forces = piles.map(|forces| forces.get(place).map(|forces| forces[m].clone()));
    forces.map(Option::unwrap_or_default).collect()
}

/// The value at x.
pub fn at(affine: &Affine, x: &[BigRational]) -> BigRational {
    let terms = affine[1..].iter().zip(x).filter(|(a, _)| !a.is_zero());
    &affine[0] + terms.map(|(a, x)| a * x).sum::<BigRational>()
}

/// The forces of a straight pile of discs, where (0, i) has the supports i and i+1: Σ f = 2V and ½(f_β − f_α) = H. The
/// vertical part of the unit is mg/2.
pub fn of_discs(pile: &Balance) -> Forces {
    let (mut forces, two) = (Forces::default(), ratio(2, 1));
    for place in pile.places() {
        let above = [0, 1].map(|m| match pile.above(place, m) {
            Some(above) => forces.below[&above][m].clone(),
            None => BigRational::zero(),
        });
        let [alpha, beta] = &above;
        let down = (alpha + beta) / &two + pile.weight(place);
        let pushed = pile.horizontal.get(&place).map(|[along_i, _]| along_i);
        let across = (beta - alpha) / &two + pushed.unwrap_or(&BigRational::zero());
        if pile.sign(place.0).is_some() {
            let below = [&down - &across, &down + &across, BigRational::zero()];
            forces.below.insert(place, below);
        } else {
            let still = BigRational::zero();
            forces.floor.insert(place, [down, across, still]);
        }
    }
    forces
}

/// A corner of the set of x ≥ 0 with b + Σ a x ≥ 0 for every row. The `basic` unknowns are affine functions of the others,
/// which are zero there. Unknown 0 is auxiliary, unknowns 1 … n are x, and the rest are the rows times a positive factor.
///
/// All entries are integers over one denominator, so no fraction is ever reduced (Edmonds 1967, Bareiss 1968).
#[derive(Clone, Debug)]
pub struct Corner {
    unknowns: usize,
    basic: Vec<usize>,
    free: Vec<usize>,
    rows: Vec<Vec<BigInt>>,
    /// The common denominator of all entries; positive.
    denominator: BigInt,
}

impl Corner {
    /// Finds any corner. Unknown 0 lifts all rows and is then minimised. `None` if its minimum is not zero.
    pub fn first(unknowns: usize, rows: &[Affine]) -> Option<Self> {
        let mut corner = Self {
            unknowns,
            basic: (unknowns + 1..).take(rows.len()).collect(),
            free: (1..=unknowns).collect(),
            rows: rows.iter().map(integers).collect(),
            denominator: BigInt::one(),
        };
        let negative = |row: &usize| corner.rows[*row][0].is_negative();
        let below = (0..corner.rows.len()).filter(negative);
        let Some(lowest) = below.min_by_key(|row| &corner.rows[*row][0]) else {
            return Some(corner);
        };
        corner.free.push(0);
        for row in &mut corner.rows {
            row.push(BigInt::one());
        }
        corner.pivot(lowest, unknowns);
        corner.descend(|unknown| BigInt::from(u8::from(unknown == 0)));
        if let Some(row) = corner.basic.iter().position(|unknown| *unknown == 0) {
            if !corner.rows[row][0].is_zero() {
                return None;
            }
            let column = corner.rows[row][1..].iter().position(|a| !a.is_zero())?;
            corner.pivot(row, column);
        }
        let column = corner.free.iter().position(|unknown| *unknown == 0)?;
        corner.free.remove(column);
        for row in &mut corner.rows {
            row.remove(1 + column);
        }
        Some(corner)
    }

    /// x.
    pub fn x(&self) -> Vec<BigRational> {
        let mut x = vec![BigRational::zero(); self.unknowns];
        for (unknown, row) in self.basic.iter().zip(&self.rows) {
            if let Some(x) = unknown
                .checked_sub(1)
                .and_then(|unknown| x.get_mut(unknown))
            {
                *x = BigRational::new(row[0].clone(), self.denominator.clone());
            }
        }
        x
    }

    /// The corner that minimises b + Σ a x.
    #[must_use]
    pub fn lowest(mut self, affine: &Affine) -> Self {
        let costs = integers(affine);
        self.descend(|unknown| costs.get(unknown).cloned().unwrap_or_default());
        self
    }

    /// Moves to the minimum of Σ cost x along the steepest edge. After a step of length zero it follows Bland's rule: the
    /// first of the unknowns that may enter or leave. This avoids cycles.
    fn descend(&mut self, cost: impl Fn(usize) -> BigInt) {
        let free = self
            .free
            .iter()
            .map(|unknown| cost(*unknown) * &self.denominator);
        let mut objective: Vec<BigInt> = once(BigInt::zero()).chain(free).collect();
        for (unknown, row) in self.basic.iter().zip(&self.rows) {
            let cost = cost(*unknown);
            for (entry, what) in objective.iter_mut().zip(row).filter(|_| !cost.is_zero()) {
                *entry += &cost * what;
            }
        }
        let last = self.rows.len();
        self.rows.push(objective);
        let mut moved = true;
        loop {
            let slope = |column: &usize| &self.rows[last][1 + column];
            let entering = (0..self.free.len()).filter(|column| slope(column).is_negative());
            let entering = if moved {
                entering.min_by(|one, other| slope(one).cmp(slope(other)))
            } else {
                entering.min_by_key(|column| self.free[*column])
            };
            let Some(column) = entering else {
                break;
            };
            let falling = (0..last).filter(|row| self.rows[*row][1 + column].is_negative());
            let leaving = falling.min_by(|one, other| {
                let [first, second] = [one, other].map(|row| &self.rows[*row]);
                // Both slopes are negative.
                let reach =
                    (&second[0] * &first[1 + column]).cmp(&(&first[0] * &second[1 + column]));
                reach.then(self.basic[*one].cmp(&self.basic[*other]))
            });
            let leaving = leaving.expect("forces are bounded by the weight");
            moved = !self.rows[leaving][0].is_zero();
            self.pivot(leaving, column);
        }
        self.rows.pop();
    }

    /// Exchanges a basic unknown and a free one.
    fn pivot(&mut self, row: usize, column: usize) {
        core::mem::swap(&mut self.basic[row], &mut self.free[column]);
        let mut solved = core::mem::take(&mut self.rows[row]);
        let pivot = core::mem::replace(&mut solved[1 + column], -&self.denominator);
        // Keeps the new denominator positive.
        let flip = |entry: &mut BigInt, is_flipped| {
            if is_flipped {
                *entry = -core::mem::take(entry);
            }
        };
        for other in self.rows.iter_mut().filter(|other| !other.is_empty()) {
            let factor = core::mem::take(&mut other[1 + column]);
            for (entry, what) in other.iter_mut().zip(&solved) {
                let stays_zero = factor.is_zero() || what.is_zero();
                if entry.is_zero() && stays_zero {
                    continue;
                }
                *entry *= &pivot;
                if !stays_zero {
                    *entry -= &factor * what;
                }
                // The division is exact because entries are minors of the first rows.
                *entry /= &self.denominator;
                flip(entry, pivot.is_negative());
            }
        }
        for entry in &mut solved {
            flip(entry, pivot.is_positive());
        }
        self.rows[row] = solved;
        self.denominator = pivot.abs();
    }
}

/// The values times their least common denominator.
fn integers(affine: &Affine) -> Vec<BigInt> {
    let denominator = affine
        .iter()
        .fold(BigInt::one(), |least, entry| least.lcm(entry.denom()));
    let scaled = affine
        .iter()
        .map(|entry| entry.numer() * (&denominator / entry.denom()));
    scaled.collect()
}
