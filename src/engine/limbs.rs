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
//! A number is Σ x_p 2^(55p), one limb x_p in each of P planes, all of them `i64`. Passes are linear, so they act on
//! each plane by itself, in the same loop; only carries lead from one plane to the next, and they can wait.
//!
//! Lemma. Right after carrying the lower limbs lie in [−2^54, 2^54). Let M·2^55 bound them after some passes, M = 1/2 at
//! first. A pass adds an increment's limb, at most 2^54, and turns by 2(b + c) − a.
//!
//! | after | M | because |
//! |---|---|---|
//! | t + 1 passes | 5(M + 1/2) | \|2(b + c) − a\| ≤ 5 max(\|a\|, \|b\|, \|c\|), and no sum on the way is greater |
//! | 1, 2, 3 passes | 5, 27.5, 140 | |
//! | 3 passes | 140 | 140·2^55 + 2^54 < 2^8·2^55 = 2^63; the fourth would lead to 702.5 |
//!
//! So carries are due after every third pass. The top limb is the number over 2^(55(P−1)) less what the lower ones still
//! owe, which is below 2^8. P is the least for which 2√3·B·D·3^(d−1) < 2^62·2^(55(P−1)), and 2^62 + 2^8 < 2^63. Right
//! after carrying the lower limbs owe less than 1, and no force is greater than √3/2 of that bound: a top limb of 2^62 or
//! more is an error, and all of them are looked at whenever limbs carry. With one plane nothing is ever carried. d is
//! the number of changes so far, so there are few planes at the top of a pile and more further down.
//!
//! Limbs of 51 bits would bear five passes, of 58 two: for many layers there are as few planes as may be, and for few
//! layers there is as little to carry, where three passes wait.
//!
//! # Passes that wait
//! Between carries each plane is for itself. Passes wait until carries are due or a number is asked for; then they are
//! made together, row after row ([`make`]), and each row carries when the last of them has been over it.

use alloc::vec::Vec;
use core::cmp::Ordering::{Equal, Less};
use core::ops::Range;
use core::sync::atomic::{AtomicBool, Ordering};

use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::bands::make;
use super::grid::{Grid, Layer, Moves, Pass, none_wait};
use super::plane::{Plane, Ramps, row};
use crate::Error;
use crate::error::bug;
use crate::formula::{force, tripled_apart};
use crate::lattice::Direction;

/// The bits of a limb below the top one.
pub(super) const LIMB: u32 = 55;

/// How many passes the lower limbs bear between carries.
const TURNS: u32 = 3;

/// The invariant that the width of the numbers rests on.
const WIDE_ENOUGH: &str = "no force is wider than the bound on all forces";

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
            // Not a default: more planes than can be addressed are refused for their size.
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
    limbs: Vec<Plane<i64>>,
    /// Memory for moves, kept so that it grows in place.
    spare: Vec<i64>,
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
            limbs: alloc::vec![Plane::new(grid, &0); size.planes],
            spare: Vec::new(),
            bound,
            waiting: Vec::new(),
            passes: 0,
            changes: 0,
        }
    }

    /// Makes room for what the passes that wait lead to. What was the top limb is a lower one then, and carries on all lines
    /// that the first of them goes along; the others bear as many passes as before.
    fn grow(&mut self, grid: &Grid<'_>) -> Result<(), Error> {
        let had = self.limbs.len();
        let planes = Size::new(&self.bound, self.changes).planes;
        let Some((pass, _)) = self.waiting.first().filter(|_| planes > had) else {
            return Ok(());
        };
        self.limbs.resize(planes, Plane::new(grid, &0));
        let top_and_next = self.limbs[had - 1..=had].iter_mut();
        let mut top_and_next: Vec<_> = top_and_next.map(Plane::slices_mut).collect();
        for row in pass.part.rows(pass.k) {
            let cells = grid.row(row.j, &row.i, pass.shift)?;
            check(carry_rows(&mut top_and_next, &cells))?;
        }
        Ok(())
    }

    /// Makes the passes that wait, and carries if that is due.
    fn make_waiting(&mut self, grid: &Grid<'_>) -> Result<(), Error> {
        self.grow(grid)?;
        let planes = self.limbs.len();
        let waiting = core::mem::take(&mut self.waiting);
        let mut passes = Vec::with_capacity(waiting.len());
        for (pass, increments) in waiting {
            let ramps = Ramps::new(&pass, &increments, |w, n| {
                limbs(&force(n.into(), w), planes)
            });
            let of_plane = |p: usize| ramps.try_map(|limbs| limbs.as_ref().map(|limbs| limbs[p]));
            let ramps: Option<Vec<_>> = (0..planes).map(of_plane).collect();
            passes.push((pass, ramps.ok_or_else(|| bug(WIDE_ENOUGH))?));
        }
        if self.passes < TURNS {
            return make(&mut self.limbs, grid, &passes, tripled_apart, |_, _| ());
        }
        let fits = AtomicBool::new(true);
        make(
            &mut self.limbs,
            grid,
            &passes,
            tripled_apart,
            |planes, cells| {
                if !carry_rows(planes, cells) {
                    fits.store(false, Ordering::Relaxed);
                }
            },
        )?;
        self.passes = 0;
        check(fits.into_inner())
    }

    /// Returns what consecutive lines carry, by direction, from the top limbs down.
    pub(super) fn slices(&self, cells: &[Range<usize>; 3]) -> Vec<[&[i64]; 3]> {
        none_wait(&self.waiting);
        let top_down = self.limbs.iter().rev();
        top_down.map(|plane| plane.slices(cells.clone())).collect()
    }

    /// Whether the three lines of two spheres carry the same limbs, and so the same numbers.
    pub(super) fn are_alike(&self, [one, other]: [[usize; 3]; 2]) -> bool {
        let mut planes = self.limbs.iter();
        planes.all(|plane| plane.carried(one) == plane.carried(other))
    }

    /// Brings the lower limbs into [−2^54, 2^54).
    fn carry(&mut self) -> Result<(), Error> {
        self.passes = 0;
        let all = self
            .limbs
            .first()
            // Not a default: without planes there is nothing to carry.
            .map_or([0; 3], |plane| plane.0.each_ref().map(Vec::len));
        let mut planes: Vec<_> = self.limbs.iter_mut().map(Plane::slices_mut).collect();
        let fits = carry_rows(&mut planes, &all.map(|n| 0..n));
        check(fits)
    }

    /// Brings the lower limbs of the three lines of one sphere into [−2^54, 2^54).
    fn carry_at(&mut self, cells: [usize; 3]) -> Result<(), Error> {
        let mut planes: Vec<_> = self.limbs.iter_mut().map(Plane::slices_mut).collect();
        let fits = carry_rows(&mut planes, &cells.map(|cell| cell..cell + 1));
        check(fits)
    }

    /// Returns the least number on the lines of the layer that a pass led to, and the first place (i, j) and direction, in
    /// row order, that has it. Carries first.
    ///
    /// # Errors
    /// [`Error::Bug`].
    pub(crate) fn least(&mut self, grid: &Grid<'_>, pass: &Pass) -> Result<Least, Error> {
        none_wait(&self.waiting);
        self.carry()?;
        let mut least: Option<(Vec<i64>, (i128, i128, Direction))> = None;
        for row in pass.part.rows(pass.k) {
            let cells = grid.row(row.j, &row.i, pass.shift)?;
            let rows = self.slices(&cells);
            for (n, i) in row.i.enumerate() {
                for direction in Direction::ALL {
                    // From the top limb down, limbs in [−2^54, 2^54) compare like digits: what is below a limb is less
                    // than one of its units.
                    let limbs = rows.iter().map(|row| row[direction.index()][n]);
                    let order = match &least {
                        Some((least, ..)) => limbs.clone().cmp(least.iter().copied()),
                        None => Less,
                    };
                    // In row order the first of whole layers is met first; of a third its images may come before.
                    if order == Less || order == Equal && grid.corner.is_some() {
                        let first = grid.first_image([i, row.j], direction, pass.k)?;
                        match &mut least {
                            Some((_, place)) if order == Equal => *place = first.min(*place),
                            _ => least = Some((limbs.collect(), first)),
                        }
                    }
                }
            }
        }
        let least = least.map(|(limbs, (j, i, direction))| Least {
            numerator: value(limbs.iter()),
            place: [i, j],
            direction,
        });
        least.ok_or_else(|| bug("a layer has a sphere"))
    }
}

fn check(fits: bool) -> Result<(), Error> {
    if fits { Ok(()) } else { Err(bug(WIDE_ENOUGH)) }
}

/// A least number, and where it is.
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
        self.waiting.push((*pass, increments.clone()));
        self.passes += 1;
        if self.passes == TURNS {
            return self.make_waiting(grid);
        }
        Ok(())
    }

    fn catch_up(&mut self, grid: &Grid<'_>) -> Result<(), Error> {
        if self.waiting.is_empty() {
            return Ok(());
        }
        self.make_waiting(grid)
    }

    fn add_at(&mut self, cells: [usize; 3], values: &[BigInt; 3]) -> Result<(), Error> {
        none_wait(&self.waiting);
        let planes = self.limbs.len();
        let [Some(a), Some(b), Some(c)] = values.each_ref().map(|value| limbs(value, planes))
        else {
            return Err(bug(WIDE_ENOUGH));
        };
        for (p, plane) in self.limbs.iter_mut().enumerate() {
            plane.add_to(cells, &[a[p], b[p], c[p]]);
        }
        // Loads on one line may follow each other without a pass between them.
        self.carry_at(cells)
    }

    fn move_to(&mut self, next: &Grid<'_>, moves: &Moves) {
        none_wait(&self.waiting);
        for plane in &mut self.limbs {
            plane.move_to(&mut self.spare, next, moves, &0);
        }
    }

    fn at(&self, cells: [usize; 3]) -> [BigInt; 3] {
        none_wait(&self.waiting);
        let top_down = self.limbs.iter().rev();
        let limbs: Vec<[&i64; 3]> = top_down.map(|plane| plane.carried(cells)).collect();
        [0, 1, 2].map(|line| value(limbs.iter().map(|limbs| limbs[line])))
    }
}

/// Brings the lower limbs of some cells into [−2^54, 2^54), and returns whether the top limbs are as small as the width
/// of the numbers promises.
fn carry_rows(planes: &mut [[&mut [i64]; 3]], cells: &[Range<usize>; 3]) -> bool {
    for p in 1..planes.len() {
        let (below, above) = planes.split_at_mut(p);
        if let (Some(lower), Some(upper)) = (below.last_mut(), above.first_mut()) {
            let (lower, upper) = (row(lower, cells.clone()), row(upper, cells.clone()));
            for (lower, upper) in lower.into_iter().zip(upper) {
                carry(lower, upper);
            }
        }
    }
    let top = planes.last_mut().map(|top| row(top, cells.clone()));
    top.into_iter().flatten().all(|top| are_within_2_62(top))
}

/// Hands on to the next limbs what is beyond [−2^54, 2^54).
#[inline(never)]
fn carry(lower: &mut [i64], upper: &mut [i64]) {
    const HALF: i64 = 1 << (LIMB - 1);
    // x >> 55 rounded down, by way of x + 2^63: vectors of old processors shift no signed numbers.
    const OFFSET: u64 = 1 << 63;
    for (x, next) in lower.iter_mut().zip(upper) {
        let moved = (*x + HALF).cast_unsigned();
        *next += ((moved ^ OFFSET) >> LIMB).cast_signed() - (OFFSET >> LIMB).cast_signed();
        *x = (moved & ((1 << LIMB) - 1)).cast_signed() - HALF;
    }
}

/// Whether all of these are at least −2^62 and below 2^62: their two highest bits are alike.
fn are_within_2_62(limbs: &[i64]) -> bool {
    limbs.iter().fold(0, |unlike, x| unlike | (x ^ (x << 1))) >= 0
}

/// The number of these limbs, from the top one down.
fn value<'a>(top_down: impl Iterator<Item = &'a i64>) -> BigInt {
    top_down.fold(BigInt::zero(), |value, limb| (value << LIMB) + *limb)
}

/// An integer as limbs, from the lowest up: all but the top one in [−2^54, 2^54). `None` if the top one is none.
pub(super) fn limbs(value: &BigInt, planes: usize) -> Option<Vec<i64>> {
    const BASE: i64 = 1 << LIMB;
    let sign = if value.is_negative() { -1 } else { 1 };
    let mut words = value.iter_u64_digits();
    // The next bits of the magnitude, of at most two words, and what the limb below hands on.
    let (mut bits, mut held, mut carried) = (0_u128, 0, 0);
    let mut limbs = Vec::with_capacity(planes);
    for _ in 1..planes {
        if held < LIMB {
            // Not a default: above the highest word there are zeros.
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
    use crate::engine::rows::exact_sweep;
    use crate::engine::single::plain_sweep;
    use crate::engine::{Cells, Descent, Lines};
    use crate::lattice::{Dimension, Region, Site};
    use crate::shape::Shape;

    fn two_planes(grid: &Grid<'_>) -> Planes {
        let planes = Planes::new(grid, BigInt::from(1) << 100);
        assert_eq!(planes.limbs.len(), 2);
        planes
    }

    /// As many loads on one line as a limb would not bear without carrying: 2^16 times nearly 2^54.
    #[test]
    fn loads_that_follow_each_other_do_not_fill_a_limb() {
        let shape = Shape::pyramid(2, Dimension::Three).unwrap();
        let grid = Grid::new(&shape, 1, 2).unwrap();
        let (mut planes, cells) = (two_planes(&grid), grid.site(0, 0, 0).unwrap());
        let load = BigInt::from((1_u64 << (LIMB - 1)) - 1);
        let loads = 1_u32 << 16;
        for _ in 0..loads {
            let values = [load.clone(), BigInt::zero(), -load.clone()];
            planes.add_at(cells, &values).unwrap();
        }
        let sum = load * loads;
        assert_eq!(planes.at(cells), [sum.clone(), BigInt::zero(), -sum]);
    }

    /// 2^55 + 10 in the lower limb alone, before it is carried, and 2^55 + 5 in both: by the top limbs the first would be the less.
    #[test]
    fn the_least_is_looked_for_among_what_is_carried() {
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
            let cells = grid.site(i, j, 1).unwrap();
            planes.limbs[0].add_to(cells, &lower);
            planes.limbs[1].add_to(cells, &top);
        }
        let least = planes.least(&grid, &pass).unwrap();
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

    /// 2√3·B·D ≤ the bound < 2√3·B·D + 7, for B = u√(3KN) + √3·Σ|e|: squared, and so in integers.
    #[test]
    fn the_bound_is_what_is_proved_and_hardly_more() {
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

    /// The table of the lemma: M in halves, and the fourth pass that would be too much.
    #[test]
    fn lower_limbs_bear_three_passes_and_no_more() {
        let half = 1_i128 << (LIMB - 1);
        let bounds = |passes| (0..passes).fold(1, |halves, _| 5 * (halves + 1));
        assert_eq!(bounds(TURNS), 280);
        assert!((bounds(TURNS) + 1) * half < 1 << 63);
        assert!(bounds(TURNS + 1) * half >= 1 << 63);
    }

    /// Three turns of limbs that are as great as limbs can be, each with increments that are, too: 3^3 times as great at
    /// least. Overflow is noticed in a checked run.
    #[test]
    fn great_limbs_do_not_overflow() {
        let half = 1_i64 << (LIMB - 1);
        for mut limbs in [
            [-half, half - 1, half - 1],
            [half - 1; 3],
            [-half, -half, 0],
        ] {
            for _ in 0..TURNS {
                limbs = tripled_apart(&limbs.map(|x| x + x.signum() * (half - 1)));
            }
            let greatest = limbs.iter().map(|x| x.unsigned_abs()).max();
            assert!(greatest > Some(1 << 58), "{limbs:?}");
        }
    }

    #[test]
    fn a_top_limb_that_is_too_great_is_noticed() {
        let within = 1_i64 << 62;
        assert!(are_within_2_62(&[0, -1, within - 1, -within]));
        assert!(!are_within_2_62(&[0, within]));
        assert!(!are_within_2_62(&[-within - 1, 0]));
        assert!(!are_within_2_62(&[within, within, 0]));
    }

    /// All lines of all layers, in limbs and in big integers, down to many planes.
    fn compare(pile: &Pile) {
        let (system, last) = (pile.system(), pile.layers() - 1);
        let lines = Lines::<BigRational>::new(&system);
        let mut exact: Descent<'_, BigRational, Planes> =
            exact_sweep(&lines, &system, last).unwrap();
        let mut plain: Descent<'_, BigRational, Cells<BigInt>> =
            plain_sweep(&lines, &system, last).unwrap();
        // Far, so that passes wait, and then one by one.
        for k in (0..=last).filter(|k| *k % 13 == 7 || last - *k < 4) {
            exact.advance(k, crate::engine::Meter::NONE).unwrap();
            plain.advance(k, crate::engine::Meter::NONE).unwrap();
            for site in pile.shape().layer(k).unwrap().rows(k).flatten() {
                let [exact, plain] = [exact.received(site), plain.received(site)];
                assert_eq!(exact.unwrap().forces, plain.unwrap().forces, "{site}");
            }
        }
    }

    /// Numbers that grow from one limb to two on the way.
    #[test]
    fn the_first_numbers_of_two_limbs_are_what_big_integers_are() {
        let pile = Pile::under(Region::SITE, "+-".repeat(21).parse().unwrap()).unwrap();
        let system = pile.system();
        let planes = |last| system.size_of_sweep(last).planes;
        assert_eq!([planes(20), planes(pile.layers() - 1)], [1, 2]);
        compare(&pile);
    }

    /// Lines that begin within a run, with a load, before the pass through it makes room for another limb.
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
            let system = pile.system();
            let planes = |last| system.size_of_sweep(last).planes;
            grown += usize::from(planes(6) < planes(8));
            compare(&pile);
        }
        assert!(grown > 0);
    }

    #[test]
    fn passes_wait_until_carries_are_due() {
        let shape = Shape::under(Region::SITE, "+-+-+-+-".parse().unwrap()).unwrap();
        let grid = Grid::new(&shape, 8, 2).unwrap();
        let mut planes = two_planes(&grid);
        let one = [1, 1, 1].map(BigInt::from);
        for (k, waiting) in (0..8).zip([1, 2, 0, 1, 2, 0, 1, 2]) {
            let pass = grid.pass(k, k + 1).unwrap().unwrap();
            planes.pass(&grid, &pass, &one).unwrap();
            assert_eq!(planes.waiting.len(), waiting, "{k}");
            assert_eq!(planes.passes as usize, waiting, "{k}");
        }
    }

    /// Two changes of sign need a bit more than there is in one limb, which the pass to the second makes room for.
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
    fn a_number_that_is_wider_than_was_proved_is_a_bug() {
        let shape = Shape::pyramid(2, Dimension::Three).unwrap();
        let grid = Grid::new(&shape, 1, 1).unwrap();
        let (mut planes, cells) = (Planes::new(&grid, 1.into()), grid.site(0, 0, 0).unwrap());
        let wide = [1, 0, 0].map(|n| BigInt::from(n) << 62);
        let added = planes.add_at(cells, &wide);
        assert!(matches!(added, Err(Error::Bug { .. })));
    }

    /// Into [−2^54, 2^54), and no further.
    #[test]
    fn no_more_is_carried_than_must_be() {
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

    /// From the least to the greatest number that so many limbs are, and no further.
    #[test]
    fn what_is_wider_than_its_limbs_is_none() {
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
            // The last two with every bit of two words above the limbs that are cut off, and half a limb below.
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
    fn limbs_are_what_big_integers_are() {
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
