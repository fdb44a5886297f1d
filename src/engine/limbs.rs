//! The exact engine: integer numerators over 3^d, as wide as is proved to be enough.
//!
//! # Width
//! After d changes of sign every force is an integer over D·3^d, D the common denominator of weights and loads
//! ([`paper`](crate::paper#transfer)). A change of sign triples the half-turn, 3G g = 2Σg − 3g, and no division is left. Let layer κ have n_κ
//! spheres of weight u and loads e, in mg. G is orthogonal, and so is the way from layer to layer, so in ℓ² over a
//! layer ‖f‖ ≤ ‖g‖ + √3·‖w‖, and over K layers of N spheres in all, by Cauchy–Schwarz,
//!
//! ‖f‖ ≤ B = u√(3·K·N) + √3·Σ|e|.
//!
//! No sum on the way to 3G g is greater than 2√3·‖g‖: all numbers of a sweep with d changes stay within
//! 2√3·B·D·3^(d−1), and B·D without one.
//!
//! # Limbs and carries
//! A number is Σ x_p 2^(48p), one limb x_p in each of P planes, all of them `i64`. Passes are linear, so they act on
//! each plane by itself, in the same loop; only carries lead from one plane to the next, and they can wait. Right after
//! carrying, the lower limbs lie in [0, 2^48). Let M·2^48 bound them. A pass adds an increment's limb, below 2^48, and
//! turns: no sum on the way exceeds 6(M+1)·2^48, and the new bound is 5(M+1). From M = 1 that is 10, 55, 280, 1405,
//! 7030: five turns stay below 2^63, the sixth would not (6·7031 > 2^15), so carries are due after every fifth. The top
//! limb is the number over 2^(48(P−1)) less what the lower ones still owe, which is below 2^13, and below 2^16 in the
//! sums of a turn: P is the least for which 2√3·B·D·3^(d−1) < 2^62·2^(48(P−1)), and 2^62 + 2^16 < 2^63. With one plane
//! nothing is ever carried. d is the number of changes so far, so there are few planes at the top of a pile and more
//! further down.
//!
//! # Passes that wait
//! Between carries each plane is for itself. Passes wait until carries are due or a number is asked for; then each plane
//! takes all of them in turn, while it is in the cache, and planes are shared out to threads.

use alloc::vec::Vec;

use num_bigint::{BigInt, BigUint};
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};

use super::cells::{Cells, Ramps, WORTH_A_THREAD, bands};
use super::grid::{Grid, Layer, Pass};
use super::parallel;
use crate::formula::{force, tripled_half_turn};
use crate::lattice::Direction;

/// The bits of a limb below the top one.
const LIMB: u32 = 48;

/// How many turns the lower limbs bear between carries.
const TURNS: u32 = 5;

/// From so many planes for each thread on, a thread takes all passes that wait on one plane, which stays in its cache,
/// before it takes the next plane. Fewer are shared out by rows.
const PLANES_A_THREAD: usize = 1;

/// How wide the numbers of a sweep are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size {
    /// The bits that the proved bound asks for, without a sign.
    pub(crate) bits: u64,
    /// The planes of `i64` that hold them.
    pub(crate) planes: usize,
}

impl Size {
    /// After so many changes of sign, from a bound no less than 2√3·B·D ([`bound`]).
    pub(crate) fn new(bound: &BigInt, changes: usize) -> Self {
        let turned = bound * num_traits::pow(BigInt::from(3), changes.saturating_sub(1));
        let bits = turned.bits();
        let planes = match bits.checked_sub(62) {
            None | Some(0) => 1,
            Some(over) => 1 + usize::try_from(over.div_ceil(LIMB.into())).unwrap_or(usize::MAX - 1),
        };
        Self { bits, planes }
    }

    /// The bits that there are for them.
    pub(crate) fn reserved(self) -> u64 {
        62 + u64::from(LIMB) * (self.planes as u64 - 1)
    }
}

/// No less than 2√3·B·D, by 2√3·B ≤ √(36·K·N)·u + 6·Σ|e|, over K = `layers` layers of N = `spheres` spheres in all, with
/// numerators of `ordinary` for an ordinary sphere and extras that sum to `extras` without their signs.
pub(crate) fn bound(layers: i128, spheres: &BigUint, ordinary: &BigInt, extras: &BigInt) -> BigInt {
    let area = BigUint::from(layers.unsigned_abs()) * spheres * 36_u32;
    let root = BigInt::from(area.sqrt() + 1_u32);
    root * ordinary.abs() + extras.abs() * 6_u32
}

/// The numbers of a layer, plane by plane.
#[derive(Clone, Debug)]
pub(crate) struct Planes {
    /// The planes that the numbers fill by now, the lowest first; further down they are more.
    cells: Vec<Cells<i64>>,
    /// No less than 2√3·B·D.
    bound: BigInt,
    /// Passes that were asked for and not made yet.
    waiting: Vec<(Pass, [BigInt; 3])>,
    /// Passes since the last carry, those that wait among them.
    passes: u32,
    /// Changes of sign so far.
    changes: usize,
}

impl Planes {
    /// For a sweep whose numbers are within a bound no less than 2√3·B·D ([`bound`]).
    pub(crate) fn new(grid: &Grid<'_>, bound: BigInt) -> Self {
        let size = Size::new(&bound, 0);
        Self {
            cells: alloc::vec![Cells::new(grid, &0); size.planes],
            bound,
            waiting: Vec::new(),
            passes: 0,
            changes: 0,
        }
    }

    /// Makes room for what the passes that wait lead to. What was the top limb is a lower one then, and carries.
    fn grow(&mut self, grid: &Grid<'_>) {
        let planes = Size::new(&self.bound, self.changes).planes;
        if planes > self.cells.len() {
            self.cells.resize(planes, Cells::new(grid, &0));
            self.carry();
            self.passes = u32::try_from(self.waiting.len()).unwrap_or(TURNS);
        }
    }

    /// Brings the lower limbs into [0, 2^48).
    fn carry(&mut self) {
        /// Numbers of which two planes stay in the nearest cache.
        const PIECE: usize = 1 << 10;
        self.passes = 0;
        let worth_threads = self.is_worth_threads();
        let mut pieces: Vec<Vec<&mut [i64]>> = Vec::new();
        let each = self.cells.first().map_or(0, |plane| plane.0[0].len());
        pieces.resize_with(3 * each.div_ceil(PIECE), Vec::new);
        for Cells(directions) in &mut self.cells {
            let numbers = directions
                .iter_mut()
                .flat_map(|cells| cells.chunks_mut(PIECE));
            for (piece, numbers) in pieces.iter_mut().zip(numbers) {
                piece.push(numbers);
            }
        }
        let work = |mut planes: Vec<&mut [i64]>| {
            for p in 1..planes.len() {
                let (lower, upper) = planes.split_at_mut(p);
                let (Some(lower), Some(upper)) = (lower.last_mut(), upper.first_mut()) else {
                    return;
                };
                for (x, next) in lower.iter_mut().zip(upper.iter_mut()) {
                    carry(x, next);
                }
            }
        };
        if worth_threads {
            parallel::for_each(pieces, work);
        } else {
            pieces.into_iter().for_each(work);
        }
    }

    /// Whether a step over all numbers takes longer than waking threads.
    fn is_worth_threads(&self) -> bool {
        let each = self.cells.first().map_or(0, |plane| plane.0[0].len());
        each * self.cells.len() > 2 * WORTH_A_THREAD
    }

    /// The same for the three lines of one sphere.
    fn carry_at(&mut self, cells: [usize; 3]) {
        for p in 1..self.cells.len() {
            let (lower, upper) = self.cells.split_at_mut(p);
            let (Some(lower), Some(upper)) = (lower.last_mut(), upper.first_mut()) else {
                return;
            };
            for ((lower, upper), cell) in lower.0.iter_mut().zip(&mut upper.0).zip(cells) {
                if let (Some(x), Some(next)) = (lower.get_mut(cell), upper.get_mut(cell)) {
                    carry(x, next);
                }
            }
        }
    }

    /// The least number on the lines of the layer that a pass led to, and the first place (i, j) and direction, in
    /// row order, that has it. Carries first.
    pub(crate) fn least(&mut self, grid: &Grid<'_>, pass: &Pass) -> Option<Least> {
        self.carry();
        let mut least: Option<(Vec<i64>, [i128; 2], Direction)> = None;
        for row in pass.region.rows(pass.k) {
            let top_down = self.cells.iter().rev();
            let rows: Vec<[&[i64]; 3]> =
                top_down.map(|plane| plane.row(grid, pass, row.j)).collect();
            for (n, i) in row.i.enumerate() {
                for direction in Direction::ALL {
                    // From the top limb down, limbs in [0, 2^48) compare like digits.
                    let limbs = rows.iter().map(|row| row[direction.index()][n]);
                    let less = match &least {
                        Some((least, ..)) => limbs.clone().lt(least.iter().copied()),
                        None => true,
                    };
                    if less {
                        least = Some((limbs.collect(), [i, row.j], direction));
                    }
                }
            }
        }
        least.map(|(limbs, place, direction)| Least {
            numerator: value(limbs.iter()),
            place,
            direction,
        })
    }
}

/// A least number, and where it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Least {
    pub(crate) numerator: BigInt,
    pub(crate) place: [i128; 2],
    pub(crate) direction: Direction,
}

impl Layer<BigRational> for Planes {
    fn pass(&mut self, grid: &Grid<'_>, pass: &Pass, increments: &[BigInt; 3]) {
        self.changes = pass.run.index + usize::from(pass.turns);
        self.waiting.push((*pass, increments.clone()));
        self.passes += 1;
        if self.passes == TURNS {
            self.catch_up(grid);
            self.carry();
        }
    }

    fn catch_up(&mut self, grid: &Grid<'_>) {
        if self.waiting.is_empty() {
            return;
        }
        self.grow(grid);
        let planes = self.cells.len();
        let waiting = core::mem::take(&mut self.waiting);
        let waiting = waiting.iter().map(|(pass, increments)| {
            let ramps = Ramps::new(pass, increments, |w, n| limbs(&force(n.into(), w), planes));
            let ramps: Vec<_> = (0..planes).map(|p| ramps.map(|limbs| limbs[p])).collect();
            (pass, ramps)
        });
        if planes < PLANES_A_THREAD * parallel::threads() || !self.is_worth_threads() {
            for (pass, ramps) in waiting {
                parallel::for_each(bands(&mut self.cells, grid, pass), |mut band| {
                    band.add_and_turn(grid, pass, &ramps, tripled_half_turn);
                });
            }
            return;
        }
        let waiting: Vec<_> = waiting.collect();
        let planes = self.cells.iter_mut().enumerate().collect();
        parallel::for_each(planes, |(p, plane): (usize, &mut Cells<i64>)| {
            for (pass, ramps) in &waiting {
                let mut whole = plane.whole(pass);
                whole.add_and_turn(grid, pass, &ramps[p..=p], tripled_half_turn);
            }
        });
    }

    fn add_at(&mut self, cells: [usize; 3], values: &[BigInt; 3]) {
        let values = values
            .each_ref()
            .map(|value| limbs(value, self.cells.len()));
        for (p, plane) in self.cells.iter_mut().enumerate() {
            plane.add_to(cells, &values.each_ref().map(|limbs| limbs[p]));
        }
        debug_assert!(
            self.waiting.is_empty(),
            "passes come before what they lead to"
        );
        // Loads on one line may follow each other without a pass between them.
        self.carry_at(cells);
    }

    fn at(&self, cells: [usize; 3]) -> [BigInt; 3] {
        let top_down = self.cells.iter().rev();
        let limbs: Vec<[&i64; 3]> = top_down.map(|plane| plane.carried(cells)).collect();
        [0, 1, 2].map(|line| value(limbs.iter().map(|limbs| limbs[line])))
    }
}

/// Hands on to the next limb what is beyond [0, 2^48).
fn carry(x: &mut i64, next: &mut i64) {
    // x >> 48 rounded down, by way of x + 2^63: vectors of old processors shift no signed numbers.
    const OFFSET: u64 = 1 << 63;
    let above = (x.cast_unsigned() ^ OFFSET) >> LIMB;
    *next += above.cast_signed() - (OFFSET >> LIMB).cast_signed();
    *x &= (1 << LIMB) - 1;
}

/// The number of these limbs, from the top one down.
fn value<'a>(top_down: impl Iterator<Item = &'a i64>) -> BigInt {
    top_down.fold(BigInt::zero(), |value, limb| (value << LIMB) + *limb)
}

/// An integer as limbs, from the lowest up: all but the top one in [0, 2^48).
fn limbs(value: &BigInt, planes: usize) -> Vec<i64> {
    let base = BigInt::from(1_u64 << LIMB);
    let mut rest = value.clone();
    let mut limbs = Vec::with_capacity(planes);
    for _ in 1..planes {
        let (next, limb) = rest.div_mod_floor(&base);
        limbs.push(limb.to_i64().unwrap_or(0));
        rest = next;
    }
    // The planes are as many as the bound on all numbers asks for.
    debug_assert!(rest.to_i64().is_some(), "{value} in {planes} planes");
    limbs.push(rest.to_i64().unwrap_or(0));
    limbs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Dimension;
    use crate::shape::Shape;

    fn two_planes(grid: &Grid<'_>) -> Planes {
        let planes = Planes::new(grid, BigInt::from(1) << 100);
        assert_eq!(planes.cells.len(), 2);
        planes
    }

    /// As many loads on one line as a limb would not bear without carrying: 2^16 times nearly 2^48.
    #[test]
    fn loads_that_follow_each_other_do_not_fill_a_limb() {
        let shape = Shape::pyramid(2, Dimension::Three).unwrap();
        let grid = Grid::new(&shape, 1, 2).unwrap();
        let (mut planes, cells) = (two_planes(&grid), grid.site(0, 0, 0));
        let load = BigInt::from((1_u64 << LIMB) - 1);
        let loads = 1_u32 << 16;
        for _ in 0..loads {
            planes.add_at(cells, &[load.clone(), BigInt::zero(), -load.clone()]);
        }
        let sum = load * loads;
        assert_eq!(planes.at(cells), [sum.clone(), BigInt::zero(), -sum]);
    }

    #[test]
    fn limbs_are_digits_of_the_number() {
        for power in 0..94 {
            for sign in [1, -1] {
                let number = (BigInt::from(1) << power) * sign - 1;
                let limbs = limbs(&number, 2);
                assert!((0..1 << LIMB).contains(&limbs[0]), "{number}");
                assert_eq!(value(limbs.iter().rev()), number);
            }
        }
    }
}
