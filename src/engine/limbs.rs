//! The exact engine: integer numerators over 3^d, of a width that is proved to be sufficient.
//!
//! A `BigInt` for each line would allocate, and would propagate carries at every addition. Here all numbers of a sweep
//! have the same width, which follows from a bound on all forces. A number is a few limbs of 64 bits, in a redundant
//! (carry-save) representation: limbs are added without carries, and several passes share one carry propagation.
//!
//! # Width
//! After d sign changes every force is an integer over D·3^d, with D the common denominator of weights and loads
//! ([`paper`](crate::paper#transfer)). A sign change triples the numerators, 3G g = 2Σg − 3g, so nothing is divided.
//!
//! Let the spheres have the weight u and the loads e, in mg. If gravity leans or a load does, these are the largest
//! absolute values of what it adds to a line. Let w be the weights and loads in one layer, g the forces
//! that the layer receives, and f those that it transmits. G is orthogonal, and each line of a layer continues as one
//! line of the next. So in the ℓ² norm over a layer ‖f‖ ≤ ‖g‖ + √3·‖w‖. For K layers of N spheres in all, the
//! Cauchy–Schwarz inequality gives
//!
//! ‖f‖ ≤ B = u√(3·K·N) + √3·Σ|e|.
//!
//! No intermediate sum of 3G g exceeds 2√3·‖g‖. So all numbers of a sweep with d sign changes are at most
//! 2√3·B·D·3^(d−1), and at most B·D without a sign change.
//!
//! # Limbs and carries
//! A number is Σ x_p 2^(55p). The limb x_p is an `i64` in *limb plane* p, and there are P planes. Passes are linear, so
//! they act on each plane separately, in the same loop. Only carries connect a plane to the next one, and they can be
//! deferred.
//!
//! An example in base 10, with digits −5 … 4: let the low digits of a, b, c be 3, 4, 4. The transfer 2(b + c) − a gives
//! the value 13, which is valid in the low position until the carry. The carry then writes 3 there, and adds one to the
//! next digit.
//!
//! *Lemma.* A carry reduces the lower limbs to [−2^54, 2^54), and then adds the carries from below, at most 2^8. Let
//! M·2^55 bound the magnitudes of the lower limbs after some passes, with M = 1/2 + ε and ε = 2^−47 at first. A pass adds
//! a limb of an increment, at most 2^54, and may apply 2(b + c) − a.
//!
//! | after | M | reason |
//! |---|---|---|
//! | t + 1 passes | 5(M + 1/2), with M after t passes | \|2(b + c) − a\| ≤ 5 max(\|a\|, \|b\|, \|c\|), and no intermediate sum is greater |
//! | 1, 2, 3 passes | 5 + 5ε, 27.5 + 25ε, 140 + 125ε | |
//! | 3 passes | < 140.1 | 140.1·2^55 + 2^54 < 2^8·2^55 = 2^63; a fourth pass would give 702.5 |
//!
//! So the lower limbs are carried before every fourth pass. A former top limb below a new plane is carried at once: its
//! magnitude is less than 2^62 + 2^8.
//!
//! The top limb equals the number divided by 2^(55(P−1)), less the carries still deferred, which are below 2^8. P is
//! the least integer with 2√3·B·D·3^(d−1) < 2^62·2^(55(P−1)). Since 2^62 + 2^8 < 2^63, the top limb fits in 64 bits.
//!
//! Immediately after a carry the deferred part is below 1. No force exceeds √3/2 of the bound above. So a top limb of
//! 2^62 or more is an error, and every carry checks all top limbs. A single plane needs no carry. P depends on the sign
//! changes so far, so the layers near the top use few planes, and lower ones use more.
//!
//! The limb width is a compromise. Limbs of 51 bits would allow five passes between carries, and limbs of 58 bits two.
//! Wide limbs keep P small in high piles. Three passes between carries keep the cost of carrying small in low ones.
//!
//! # Deferred passes
//! Between carries the planes are independent. Passes are therefore deferred until a carry is required or a number is
//! read. Then they are made together, row after row ([`make`]), first in the top plane. Before the first pass processes a
//! row of a plane, it receives the carries from the plane below, which has not changed yet.

use alloc::vec::Vec;
use core::cmp::Ordering::{Equal, Less};
use core::ops::Range;
use core::sync::atomic::{AtomicBool, Ordering};

use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::bands::make;
use super::grid::{Grid, Layer, Moves, Pass, assert_none_deferred};
use super::plane::{Plane, Ramps, row};
use crate::Error;
use crate::each::Each;
use crate::error::bug;
use crate::formula::{force, tripled_apart};
use crate::lattice::Direction;

/// The bits of a limb below the top one.
pub(super) const LIMB: u32 = 55;

/// The number of passes that the lower limbs allow between two carries.
const PASSES_PER_CARRY: usize = 3;

/// The invariant behind the width of the numbers.
const WIDE_ENOUGH: &str = "no force is wider than the bound on all forces";

/// The width of the numbers of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size {
    /// The bits that the proved bound requires, without the sign.
    pub(crate) bits: u64,
    /// The number of `i64` planes that provide these bits.
    pub(crate) planes: usize,
}

impl Size {
    /// Returns the width after `changes` sign changes, from an upper bound of 2√3·B·D ([`bound`]).
    pub(crate) fn new(bound: &BigInt, changes: usize) -> Self {
        let turned = bound * num_traits::pow(BigInt::from(3), changes.saturating_sub(1));
        let bits = turned.bits();
        let planes = match bits.checked_sub(62) {
            None | Some(0) => 1,
            // A number of planes beyond the address space is refused later for its size.
            Some(over) => 1 + usize::try_from(over.div_ceil(LIMB.into())).unwrap_or(usize::MAX - 1),
        };
        Self { bits, planes }
    }
}

/// Returns an upper bound of 2√3·B·D, for K = `layers` layers of N = `spheres` spheres in all.
///
/// It follows from 2√3·B ≤ √(36·K·N)·u + 6·Σ|e|. The numerator of an ordinary weight is `ordinary`. The numerators of
/// the extra weights and loads, without signs, add up to `extras`.
pub(crate) fn bound(layers: i128, spheres: &BigUint, ordinary: &BigInt, extras: &BigInt) -> BigInt {
    let area = BigUint::from(layers.unsigned_abs()) * spheres * 36_u32;
    let root = BigInt::from(area.sqrt() + 1_u32);
    root * ordinary.abs() + extras.abs() * 6_u32
}

/// The numbers of a layer, one plane for each limb.
#[derive(Clone, Debug)]
pub(crate) struct Planes {
    /// The planes in use, the lowest first. Their number grows on the way down.
    limbs: Vec<Plane<i64>>,
    /// A buffer for moves between windows. It is reused, so that it grows in place.
    spare: Vec<i64>,
    /// An upper bound of 2√3·B·D.
    bound: BigInt,
    /// The deferred passes, with their increments.
    deferred: Vec<(Pass, [BigInt; 3])>,
    /// The passes since the last carry, without deferred ones.
    passes: usize,
    /// The number of sign changes so far.
    changes: usize,
}

impl Planes {
    /// Returns the planes for a sweep with an upper bound of 2√3·B·D ([`bound`]), all zero.
    pub(crate) fn new(grid: &Grid<'_>, bound: BigInt) -> Self {
        let size = Size::new(&bound, 0);
        Self {
            limbs: alloc::vec![Plane::new(grid, &0); size.planes],
            spare: Vec::new(),
            bound,
            deferred: Vec::new(),
            passes: 0,
            changes: 0,
        }
    }

    /// Makes the deferred passes. Before them, carries the lower limbs if they do not allow so many passes, or if a
    /// new plane makes the former top limbs lower ones.
    fn make_deferred(&mut self, grid: &Grid<'_>) -> Result<(), Error> {
        let planes = Size::new(&self.bound, self.changes)
            .planes
            .max(self.limbs.len());
        let deferred = core::mem::take(&mut self.deferred);
        let carries = planes > self.limbs.len() || self.passes + deferred.len() > PASSES_PER_CARRY;
        self.passes = deferred.len() + if carries { 0 } else { self.passes };
        self.limbs.resize_with(planes, || Plane::new(grid, &0));
        let mut passes = Vec::with_capacity(deferred.len());
        for (pass, increments) in deferred {
            let ramps = ramps_of_planes(&pass, &increments, planes);
            passes.push((pass, ramps.ok_or_else(|| bug(WIDE_ENOUGH))?));
        }
        let fits = AtomicBool::new(true);
        let begin = |up_to: &mut [[&mut [i64]; 3]], cells: &[Range<usize>; 3]| {
            if carries {
                carry_into_last(up_to, cells);
                if up_to.len() == planes && !are_last_within_2_62(up_to, cells) {
                    fits.store(false, Ordering::Relaxed);
                }
            }
        };
        make(&mut self.limbs, grid, &passes, begin, tripled_apart)?;
        check(fits.into_inner())
    }

    /// Returns the limbs of consecutive lines, by direction. The top limbs come first.
    pub(super) fn slices(&self, cells: &[Range<usize>; 3]) -> Vec<[&[i64]; 3]> {
        assert_none_deferred(&self.deferred);
        let top_down = self.limbs.iter().rev();
        top_down.map(|plane| plane.slices(cells.clone())).collect()
    }

    /// Returns the limbs of some lines, for three columns of lines. The top limbs come first. Each line is given by its
    /// direction and its cell.
    pub(super) fn gathered(&self, columns: &[Vec<(usize, usize)>; 3]) -> Vec<[Vec<i64>; 3]> {
        assert_none_deferred(&self.deferred);
        let limbs = |Plane(lines): &Plane<i64>, column: &Vec<(usize, usize)>| {
            let cells = column.iter();
            cells.map(|(line, cell)| lines[*line][*cell]).collect()
        };
        let top_down = self.limbs.iter().rev();
        let of_plane = |plane| columns.each_ref().each(|column| limbs(plane, column));
        top_down.map(of_plane).collect()
    }

    /// Returns whether the lines of two spheres have equal limbs. If so, their forces are equal.
    pub(super) fn are_alike(&self, [one, other]: [[usize; 3]; 2]) -> bool {
        let mut planes = self.limbs.iter();
        planes.all(|plane| plane.carried(one) == plane.carried(other))
    }

    /// Reduces all lower limbs to [−2^54, 2^54).
    fn carry(&mut self) -> Result<(), Error> {
        self.passes = 0;
        let all = self
            .limbs
            .first()
            // Without planes there is nothing to carry.
            .map_or([0; 3], |plane| plane.0.each_ref().each(Vec::len));
        let mut planes: Vec<_> = self.limbs.iter_mut().map(Plane::slices_mut).collect();
        let fits = carry_rows(&mut planes, &all.each(|n| 0..n));
        check(fits)
    }

    /// Reduces the lower limbs of the three lines of one sphere to [−2^54, 2^54).
    fn carry_at(&mut self, cells: [usize; 3]) -> Result<(), Error> {
        let mut planes: Vec<_> = self.limbs.iter_mut().map(Plane::slices_mut).collect();
        let fits = carry_rows(&mut planes, &cells.each(|cell| cell..cell + 1));
        check(fits)
    }

    /// Returns the smallest number of a layer along each direction, and its first position in row order. If only a third
    /// of the layer is stored, it is the first position among the images, whose direction may differ.
    ///
    /// # Errors
    /// [`Error::Bug`].
    pub(crate) fn least(&mut self, grid: &Grid<'_>, pass: &Pass) -> Result<[Least; 3], Error> {
        assert_none_deferred(&self.deferred);
        self.carry()?;
        let mut least: [Option<(Vec<i64>, Place)>; 3] = [None, None, None];
        for row in pass.stored.part.rows(pass.k) {
            let cells = grid.row(row.j, &row.i, pass.stored.shift)?;
            let rows = self.slices(&cells);
            for (n, i) in row.i.enumerate() {
                for (direction, least) in Direction::ALL.into_iter().zip(&mut least) {
                    // Limbs in [−2^54, 2^54) compare like digits, from the top limb down: the lower limbs together are
                    // less than one unit of the limb above.
                    let limbs = rows.iter().map(|row| row[direction.index()][n]);
                    let order = match least {
                        Some((least, ..)) => limbs.clone().cmp(least.iter().copied()),
                        None => Less,
                    };
                    // In a whole layer, row order finds the first position first. If only a third is stored, images may
                    // precede the stored line.
                    if order == Less || order == Equal && grid.corner.is_some() {
                        let first = pass.stored.first_image([i, row.j], direction)?;
                        match least {
                            Some((_, place)) if order == Equal => *place = first.min(*place),
                            _ => *least = Some((limbs.collect(), first)),
                        }
                    }
                }
            }
        }
        let one = |least: Option<(Vec<i64>, _)>| -> Result<Least, Error> {
            let (limbs, (j, i, direction)) = least.ok_or_else(|| bug("a layer has a sphere"))?;
            Ok(Least {
                numerator: value(limbs.iter()),
                place: [i, j],
                direction,
            })
        };
        let [alpha, beta, gamma] = least;
        Ok([one(alpha)?, one(beta)?, one(gamma)?])
    }
}

fn check(fits: bool) -> Result<(), Error> {
    if fits { Ok(()) } else { Err(bug(WIDE_ENOUGH)) }
}

/// The place of a line in a layer, in row order: j, i and the direction.
type Place = (i128, i128, Direction);

/// The smallest number of a layer along a direction, with its position.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Least {
    pub(crate) numerator: BigInt,
    pub(crate) place: [i128; 2],
    pub(crate) direction: Direction,
}

impl Layer<BigRational> for Planes {
    fn pass(
        &mut self,
        grid: &Grid<'_>,
        pass: &Pass,
        increments: &[BigInt; 3],
    ) -> Result<(), Error> {
        self.changes = pass.run.index + usize::from(pass.turns);
        self.deferred.push((*pass, increments.clone()));
        if self.deferred.len() == PASSES_PER_CARRY {
            return self.make_deferred(grid);
        }
        Ok(())
    }

    fn catch_up(&mut self, grid: &Grid<'_>) -> Result<(), Error> {
        if self.deferred.is_empty() {
            return Ok(());
        }
        self.make_deferred(grid)
    }

    fn add_at(&mut self, cells: [usize; 3], values: &[BigInt; 3]) -> Result<(), Error> {
        assert_none_deferred(&self.deferred);
        let planes = self.limbs.len();
        let [Some(a), Some(b), Some(c)] = values.each_ref().each(|value| limbs(value, planes))
        else {
            return Err(bug(WIDE_ENOUGH));
        };
        for (p, plane) in self.limbs.iter_mut().enumerate() {
            plane.add_to(cells, &[a[p], b[p], c[p]]);
        }
        // Several loads may act on one line without a pass between them, so each is carried at once.
        self.carry_at(cells)
    }

    fn move_to(&mut self, next: &Grid<'_>, moves: &Moves) {
        assert_none_deferred(&self.deferred);
        for plane in &mut self.limbs {
            plane.move_to(&mut self.spare, next, moves, &0);
        }
    }

    fn at(&self, cells: [usize; 3]) -> [BigInt; 3] {
        assert_none_deferred(&self.deferred);
        let top_down = self.limbs.iter().rev();
        let limbs: Vec<[&i64; 3]> = top_down.map(|plane| plane.carried(cells)).collect();
        [0, 1, 2].each(|line| value(limbs.iter().map(|limbs| limbs[line])))
    }
}

/// Returns the ramps of a pass in every plane. Returns `None` if a value exceeds the planes.
fn ramps_of_planes(
    pass: &Pass,
    increments: &[BigInt; 3],
    planes: usize,
) -> Option<Vec<Ramps<i64>>> {
    let mut by_plane = Vec::with_capacity(planes);
    by_plane.resize_with(planes, || Ramps([const { Vec::new() }; 3]));
    for (line, w) in increments.iter().enumerate() {
        if let Some(same) = increments[..line].iter().position(|other| other == w) {
            for Ramps(lines) in &mut by_plane {
                let copied = lines[same].clone();
                lines[line] = copied;
            }
            continue;
        }
        for n in 0..=pass.greatest_count() {
            let limbs = limbs(&force(n.into(), w), planes)?;
            for (Ramps(lines), limb) in by_plane.iter_mut().zip(limbs) {
                lines[line].push(limb);
            }
        }
    }
    Some(by_plane)
}

/// Reduces the lower limbs of some cells to [−2^54, 2^54). Returns whether the top limbs are within the proved width.
fn carry_rows(planes: &mut [[&mut [i64]; 3]], cells: &[Range<usize>; 3]) -> bool {
    for p in 1..planes.len() {
        carry_into_last(&mut planes[..=p], cells);
    }
    are_last_within_2_62(planes, cells)
}

/// Reduces the limbs of some cells in the last plane but one, and adds the carries to the last plane.
fn carry_into_last(planes: &mut [[&mut [i64]; 3]], cells: &[Range<usize>; 3]) {
    if let [.., lower, upper] = planes {
        let (lower, upper) = (row(lower, cells.clone()), row(upper, cells.clone()));
        for (lower, upper) in lower.into_iter().zip(upper) {
            carry(lower, upper);
        }
    }
}

/// Returns whether all limbs of some cells in the last plane are at least −2^62 and below 2^62. Then their two highest
/// bits are equal.
fn are_last_within_2_62(planes: &mut [[&mut [i64]; 3]], cells: &[Range<usize>; 3]) -> bool {
    let rows = planes.last_mut().map(|last| row(last, cells.clone()));
    let limbs = rows.iter().flatten();
    let unlike = |row: &[i64]| row.iter().fold(0, |unlike, x| unlike | (x ^ (x << 1)));
    limbs.fold(0, |all, row| all | unlike(row)) >= 0
}

/// Reduces limbs to [−2^54, 2^54), and adds the carries to the next limbs.
#[inline(never)]
fn carry(lower: &mut [i64], upper: &mut [i64]) {
    const HALF: i64 = 1 << (LIMB - 1);
    // The arithmetic shift x >> 55 is computed as a logical shift of x + 2^63, because old processors have no vector
    // instruction for an arithmetic shift of 64 bits.
    const OFFSET: u64 = 1 << 63;
    for (x, next) in lower.iter_mut().zip(upper) {
        let moved = (*x + HALF).cast_unsigned();
        *next += ((moved ^ OFFSET) >> LIMB).cast_signed() - (OFFSET >> LIMB).cast_signed();
        *x = (moved & ((1 << LIMB) - 1)).cast_signed() - HALF;
    }
}

/// Returns the number with these limbs, the top one first.
fn value<'a>(top_down: impl Iterator<Item = &'a i64>) -> BigInt {
    top_down.fold(BigInt::zero(), |value, limb| (value << LIMB) + *limb)
}

/// Returns the limbs of an integer, the lowest first. All but the top one lie in [−2^54, 2^54). Returns `None` if the
/// top limb exceeds an `i64`.
pub(super) fn limbs(value: &BigInt, planes: usize) -> Option<Vec<i64>> {
    const BASE: i64 = 1 << LIMB;
    let sign = if value.is_negative() { -1 } else { 1 };
    let mut words = value.iter_u64_digits();
    // `bits` holds the next bits of the magnitude, at most two words. `carried` is the carry from the limb below.
    let (mut bits, mut held, mut carried) = (0_u128, 0, 0);
    let mut limbs = Vec::with_capacity(planes);
    for _ in 1..planes {
        if held < LIMB {
            // Above the highest word all bits are zero.
            bits |= u128::from(words.next().unwrap_or(0)) << held;
            held += u64::BITS;
        }
        #[expect(clippy::cast_possible_truncation, reason = "the bits of a limb")]
        let digit = sign * (bits as i64 & (BASE - 1)) + carried;
        (bits, held) = (bits >> LIMB, held - LIMB);
        carried = i64::from(digit >= BASE / 2) - i64::from(digit < -BASE / 2);
        limbs.push(digit - carried * BASE);
    }
    if let Some(word) = words.next() {
        bits |= u128::from(word) << held;
    }
    let top = i128::try_from(bits).ok()? * i128::from(sign);
    let top = top.checked_add(carried.into())?;
    limbs.push(i64::try_from(top).ok().filter(|_| words.next().is_none())?);
    Some(limbs)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Pile;
    use crate::engine::rows::{exact_sweep, plain_sweep};
    use crate::engine::{Cells, LineForces, Sweep};
    use crate::lattice::{Dimension, Region, Site};
    use crate::shape::Shape;

    fn two_planes(grid: &Grid<'_>) -> Planes {
        let planes = Planes::new(grid, BigInt::from(1) << 100);
        assert_eq!(planes.limbs.len(), 2);
        planes
    }

    /// Without carries a limb would overflow: 2^16 loads of nearly 2^54 act on one line.
    #[test]
    fn loads_that_follow_each_other_do_not_fill_a_limb() {
        let shape = Shape::pyramid(2, Dimension::Three).unwrap();
        let grid = Grid::new(&shape, 1, 2).unwrap();
        let (mut planes, cells) = (two_planes(&grid), grid.site([0, 0], 1).unwrap());
        let load = BigInt::from((1_u64 << (LIMB - 1)) - 1);
        let loads = 1_u32 << 16;
        for _ in 0..loads {
            let values = [load.clone(), BigInt::zero(), -load.clone()];
            planes.add_at(cells, &values).unwrap();
        }
        let sum = load * loads;
        assert_eq!(planes.at(cells), [sum.clone(), BigInt::zero(), -sum]);
    }

    /// One number is 2^55 + 10, all of it in the lower limb. Another is 2^55 + 5, carried into both limbs. Judged by
    /// the top limbs before the carry, the first would be smaller.
    #[test]
    fn the_smallest_number_is_found_after_a_carry() {
        let shape = Shape::pyramid(2, Dimension::Three).unwrap();
        let grid = Grid::new(&shape, 1, 2).unwrap();
        let pass = grid.pass(0, 1).unwrap().unwrap();
        let mut planes = two_planes(&grid);
        let one = 1_i64 << LIMB;
        for (i, j, [lower, top]) in [
            (0, 0, [[one + 10, 0, 0], [0, 2, 2]]),
            (1, 0, [[0, 5, 0], [2, 1, 2]]),
            (0, 1, [[0; 3], [2; 3]]),
        ] {
            let cells = grid.site([i, j], 0).unwrap();
            planes.limbs[0].add_to(cells, &lower);
            planes.limbs[1].add_to(cells, &top);
        }
        let [_, least, _] = planes.least(&grid, &pass).unwrap();
        assert_eq!(least.numerator, BigInt::from(one + 5));
        assert_eq!((least.place, least.direction), ([1, 0], Direction::Beta));
    }

    #[test]
    fn limbs_are_digits_of_the_number() {
        for power in 0..98 {
            for sign in [1, -1] {
                let number = (BigInt::from(1) << power) * sign - 1;
                let limbs = limbs(&number, 2).unwrap();
                let half = 1 << (LIMB - 1);
                assert!((-half..half).contains(&limbs[0]), "{number}");
                assert_eq!(value(limbs.iter().rev()), number);
            }
        }
    }

    /// Checks 2√3·B ≤ bound ≤ 2√3·B + u for D = 1 and B = u√(3KN) + √3·Σ|e|. Squares keep the comparison in integers.
    #[test]
    fn the_bound_is_close_to_the_proved_one() {
        for (layers, spheres, ordinary, extras) in [
            (1, 1_i128, 1, 0),
            (2, 4, 1, 0),
            (7, 84, 5, 3),
            (400, 16_100_200, 2, 1_000_000),
        ] {
            let bound = bound(
                layers,
                &BigUint::from(spheres.unsigned_abs()),
                &ordinary.into(),
                &extras.into(),
            );
            let own = bound.clone() - 6 * extras;
            let exact = BigInt::from(36 * layers * spheres * ordinary * ordinary);
            assert!(&own * &own >= exact, "{bound}");
            let less = own - ordinary;
            assert!(&less * &less <= exact, "{bound}");
        }
    }

    /// Checks the table of the lemma, and that a fourth pass would overflow.
    #[test]
    fn lower_limbs_allow_three_passes_and_no_more() {
        let half = 1_i128 << (LIMB - 1);
        let carried = half + (1 << 8);
        let bound = |passes| (0..passes).fold(carried, |bound, _| 5 * (bound + half));
        assert_eq!(bound(PASSES_PER_CARRY), 280 * half + 125 * (1 << 8));
        assert!(bound(PASSES_PER_CARRY) + half < 1 << 63);
        assert!((bound(PASSES_PER_CARRY) + half) >> LIMB < 1 << 8);
        assert!(bound(PASSES_PER_CARRY + 1) >= 1 << 63);
    }

    /// Turns the largest limbs three times, each time after adding increments of the same size. The largest limb grows
    /// more than 16-fold. A build with overflow checks detects an overflow.
    #[test]
    fn great_limbs_do_not_overflow() {
        let half = 1_i64 << (LIMB - 1);
        for mut limbs in [
            [-half, half - 1, half - 1],
            [half - 1; 3],
            [-half, -half, 0],
        ] {
            for _ in 0..PASSES_PER_CARRY {
                limbs = tripled_apart(&limbs.map(|x| x + x.signum() * (half - 1)));
            }
            let greatest = limbs.iter().map(|x| x.unsigned_abs()).max();
            assert!(greatest > Some(1 << 58), "{limbs:?}");
        }
    }

    #[test]
    fn a_top_limb_that_is_too_great_is_noticed() {
        let within = 1_i64 << 62;
        // The lower plane, and numbers outside the cells, do not count.
        let is_within = |limbs: [i64; 4]| {
            [0, 1, 2].map(|line| {
                let (mut lower, mut top) = ([[i64::MIN; 5]; 3], [[0, 0, 0, 0, i64::MAX]; 3]);
                top[line][..4].copy_from_slice(&limbs);
                let mut planes = [&mut lower, &mut top].map(|p| p.each_mut().map(|p| &mut p[..]));
                are_last_within_2_62(&mut planes, &[0..4, 0..4, 0..4])
            })
        };
        assert_eq!(is_within([0, -1, within - 1, -within]), [true; 3]);
        for limbs in [
            [0, within, 0, 0],
            [-within - 1, 0, 0, 0],
            [within, within, 0, 0],
        ] {
            assert_eq!(is_within(limbs), [false; 3], "{limbs:?}");
        }
    }

    /// Compares the forces on all lines of some layers, in limbs and in big integers.
    fn compare(pile: &Pile) {
        let last = pile.layers() - 1;
        let lines = LineForces::<BigRational>::new(pile);
        let mut exact: Sweep<'_, BigRational, Planes> = exact_sweep(&lines, last).unwrap();
        let mut plain: Sweep<'_, BigRational, Cells<BigInt>> = plain_sweep(&lines, last).unwrap();
        // The first steps cross 13 layers, so that passes are deferred. The last steps cross single layers.
        for k in (0..=last).filter(|k| *k % 13 == 7 || last - *k < 4) {
            exact.advance(k, crate::engine::Meter::NONE).unwrap();
            plain.advance(k, crate::engine::Meter::NONE).unwrap();
            for site in pile.shape().layer(k).unwrap().rows(k).flatten() {
                let [exact, plain] = [exact.received(site), plain.received(site)];
                assert_eq!(exact.unwrap().forces, plain.unwrap().forces, "{site}");
            }
        }
    }

    /// The numbers grow from one limb to two within the pile.
    #[test]
    fn numbers_that_grow_to_two_limbs_equal_big_integers() {
        let pile = Pile::under(Region::SITE, "+-".repeat(21).parse().unwrap()).unwrap();
        let planes = |last| pile.size_of_sweep(last).planes;
        assert_eq!([planes(20), planes(pile.layers() - 1)], [1, 2]);
        compare(&pile);
    }

    /// Lines begin within a run and carry a load, before the pass through that run adds a plane.
    #[test]
    fn loads_of_a_run_are_carried_into_a_new_limb() {
        let stacking = "-+-----+-+-+".parse().unwrap();
        let pile = Pile::under(Region::SITE, stacking).unwrap();
        let corners = pile.shape().layer(4).unwrap().corners();
        let mut grown = 0;
        for bits in 40..62 {
            let load = BigRational::from(BigInt::from(1_i64 << bits));
            let [i, j] = corners[0];
            let pile = pile.clone().with_load(Site { i, j, k: 4 }, load).unwrap();
            let planes = |last| pile.size_of_sweep(last).planes;
            grown += usize::from(planes(6) < planes(8));
            compare(&pile);
        }
        assert!(grown > 0);
    }

    #[test]
    fn passes_are_deferred_until_a_carry_is_required() {
        let shape = Shape::under(Region::SITE, "+-+-+-+-".parse().unwrap()).unwrap();
        let grid = Grid::new(&shape, 8, 2).unwrap();
        let mut planes = two_planes(&grid);
        let one = [1, 1, 1].map(BigInt::from);
        for (k, deferred) in (0..8).zip([1, 2, 0, 1, 2, 0, 1, 2]) {
            let pass = grid.pass(k, k + 1).unwrap().unwrap();
            planes.pass(&grid, &pass, &one).unwrap();
            assert_eq!(planes.deferred.len(), deferred, "{k}");
        }
    }

    #[test]
    fn limbs_are_carried_before_every_fourth_pass() {
        let shape = Shape::under(Region::SITE, "+-+-+-+-".parse().unwrap()).unwrap();
        let grid = Grid::new(&shape, 8, 2).unwrap();
        let mut planes = two_planes(&grid);
        let one = [1, 1, 1].map(BigInt::from);
        for (k, passes) in (0..8).zip([1, 2, 3, 1, 2, 3, 1, 2]) {
            let pass = grid.pass(k, k + 1).unwrap().unwrap();
            planes.pass(&grid, &pass, &one).unwrap();
            planes.catch_up(&grid).unwrap();
            assert_eq!(planes.passes, passes, "{k}");
        }
    }

    /// After two sign changes the numbers need slightly more bits than one limb has. The pass to the second one adds a
    /// plane.
    #[test]
    fn limbs_grow_with_the_pass_that_turns() {
        let shape = Shape::under(Region::SITE, "+-++-".parse().unwrap()).unwrap();
        let grid = Grid::new(&shape, 5, 2).unwrap();
        let mut planes = Planes::new(&grid, BigInt::from(1) << 61);
        let one = [1, 1, 1].map(BigInt::from);
        for (to, limbs) in [(1, 1), (2, 2), (3, 2), (4, 2)] {
            let pass = grid.pass(to - 1, to).unwrap().unwrap();
            planes.pass(&grid, &pass, &one).unwrap();
            planes.catch_up(&grid).unwrap();
            assert_eq!(planes.limbs.len(), limbs, "{to}");
        }
    }

    #[test]
    #[cfg_attr(debug_assertions, should_panic(expected = "no force is wider"))]
    fn a_number_wider_than_its_bound_is_a_bug() {
        let shape = Shape::pyramid(2, Dimension::Three).unwrap();
        let grid = Grid::new(&shape, 1, 1).unwrap();
        let (mut planes, cells) = (Planes::new(&grid, 1.into()), grid.site([0, 0], 1).unwrap());
        let wide = [1, 0, 0].map(|n| BigInt::from(n) << 62);
        let added = planes.add_at(cells, &wide);
        assert!(matches!(added, Err(Error::Bug { .. })));
    }

    /// A carry reduces limbs to [−2^54, 2^54), and not further.
    #[test]
    fn a_carry_leaves_limbs_within_their_range() {
        let half = 1_i64 << (LIMB - 1);
        let mut lower = [half, -half, half - 1, -half - 1, 0, -1, 3 * half];
        let mut upper = [0; 7];
        carry(&mut lower, &mut upper);
        assert_eq!(lower, [-half, -half, half - 1, half - 1, 0, -1, -half]);
        assert_eq!(upper, [1, 0, 0, -1, 0, 0, 2]);
    }

    #[test]
    fn half_a_limb_is_carried() {
        let half = 1_i64 << (LIMB - 1);
        assert_eq!(limbs(&half.into(), 2), Some(alloc::vec![-half, 1]));
        assert_eq!(limbs(&(-half).into(), 2), Some(alloc::vec![-half, 0]));
        assert_eq!(limbs(&(half - 1).into(), 2), Some(alloc::vec![half - 1, 0]));
    }

    /// Converts the smallest and the largest number that fit in some limbs, and refuses wider ones.
    #[test]
    fn a_number_wider_than_its_limbs_is_refused() {
        let half = 1_i64 << (LIMB - 1);
        for below in 0..9 {
            let ends = [(-half, i64::MIN), (half - 1, i64::MAX)].map(|(limb, top)| {
                let mut limbs = alloc::vec![limb; below];
                limbs.push(top);
                limbs
            });
            let [least, greatest] = ends.each_ref().map(|limbs| value(limbs.iter().rev()));
            let of = |number: &BigInt| limbs(number, below + 1);
            assert_eq!([of(&least), of(&greatest)], ends.map(Some));
            // The magnitude of the last two is (2^128 − 1)/2 units of the top limb, rounded down.
            let bits: BigInt = (BigInt::from(1) << 127) - 1;
            let bits: BigInt = ((bits * 2 + 1) << (LIMB as usize * below)) / 2;
            let wider: [BigInt; 4] = [least - 1, greatest + 1, bits.clone(), -bits];
            for wider in &wider {
                for more in [0, 64, 65, 128, 640] {
                    assert_eq!(of(&(wider << more)), None, "{below} {more}");
                }
            }
        }
    }

    #[test]
    fn limbs_equal_big_integers() {
        let alternating = "+-".repeat(40);
        let mixed = "+-++---+".repeat(6);
        for (top, stacking) in [
            (Region::SITE, alternating.as_str()),
            (Region::hexagon(3, 2).unwrap(), mixed.as_str()),
            (Region::triangle(4).unwrap(), "-+-+-+-+-++++++++-"),
        ] {
            let pile = Pile::under(top, stacking.parse().unwrap()).unwrap();
            compare(&pile);
        }
    }
}
