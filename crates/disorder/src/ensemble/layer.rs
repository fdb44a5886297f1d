//! The forces of one layer, and how they come down to the next.

use cannonpile::formula;
use cannonpile::lattice::{Direction, Region, Sign};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::ToPrimitive;

use crate::Error;
use crate::error::bug;

/// An integer that is wide enough for the numerators of an ensemble: that is decided beforehand, so that plain operators
/// serve.
pub(super) trait Numerator:
    Clone
    + Integer
    + ToPrimitive
    + TryFrom<BigInt>
    + Into<BigInt>
    + for<'a> core::ops::Add<&'a Self, Output = Self>
    + for<'a> core::ops::Sub<&'a Self, Output = Self>
    + for<'a> core::ops::Mul<&'a Self, Output = Self>
    + Send
    + Sync
{
}

impl Numerator for i64 {}
impl Numerator for i128 {}
impl Numerator for BigInt {}

/// Three numbers for each sphere of a layer, by direction; the spheres row after row.
pub(super) type Planes<T> = [Vec<T>; 3];

/// Where the spheres of a layer are in its planes.
#[derive(Clone, Debug)]
pub(super) struct Places {
    /// The first row.
    y: i128,
    /// Of each row its first i, and how many spheres come before it.
    rows: Vec<(i128, usize)>,
    spheres: usize,
}

impl Places {
    /// Those of a region, whose sites are fewer than memory holds.
    pub(super) fn of(region: &Region) -> Result<Self, Error> {
        let mut places = Self {
            y: *region.y().start(),
            rows: Vec::new(),
            spheres: 0,
        };
        places.become_those_of(region)?;
        Ok(places)
    }

    /// Takes another region, in the same memory.
    pub(super) fn become_those_of(&mut self, region: &Region) -> Result<(), Error> {
        self.y = *region.y().start();
        self.rows.clear();
        self.spheres = 0;
        for row in region.rows(0) {
            self.rows.push((row.i.start, self.spheres));
            self.spheres += row.length()?;
        }
        Ok(())
    }

    pub(super) const fn spheres(&self) -> usize {
        self.spheres
    }

    /// The rows in order: j, the first i, and the places of the row.
    pub(super) fn rows(&self) -> impl Iterator<Item = (i128, i128, core::ops::Range<usize>)> + '_ {
        let ends = self.rows.iter().skip(1).map(|(_, before)| *before);
        let ends = ends.chain([self.spheres]);
        let rows = self.rows.iter().zip(ends);
        (self.y..)
            .zip(rows)
            .map(|(j, ((i, before), end))| (j, *i, *before..end))
    }

    /// The place of site (i, j), which may lie beyond the end of its row.
    fn place(&self, i: i128, j: i128) -> Option<usize> {
        let row = usize::try_from(j - self.y).ok()?;
        let (first, before) = self.rows.get(row)?;
        before.checked_add(usize::try_from(i - first).ok()?)
    }
}

/// Hands the forces of a layer to the spheres below: sphere (i, j) of the one gives to (i, j) + σd of the other. What
/// nothing comes to receives 0.
pub(super) fn hand_down<T: Numerator>(
    forces: &Planes<T>,
    from: &Places,
    sign: Sign,
    to: &Places,
    received: &mut Planes<T>,
) -> Result<(), Error> {
    let planes = forces.iter().zip(received.iter_mut());
    for (direction, (forces, received)) in Direction::ALL.into_iter().zip(planes) {
        let [di, dj] = sign.descent(direction);
        received.clear();
        received.resize(to.spheres, T::zero());
        for (j, i, places) in from.rows() {
            let length = places.len();
            let begin = to.place(i + di, j + dj);
            let target = begin.and_then(|begin| received.get_mut(begin..begin + length));
            let source = forces.get(places);
            let (target, source) = target
                .zip(source)
                .ok_or_else(|| bug("every support of a layer is in the one below"))?;
            target.clone_from_slice(source);
        }
    }
    Ok(())
}

/// Passes on what a layer receives, its spheres' own included, where the sign stays as it is.
pub(super) fn pass_on<T: Numerator>(received: &Planes<T>, own: &T, forces: &mut Planes<T>) {
    for (received, forces) in received.iter().zip(forces) {
        forces.clear();
        forces.extend(received.iter().map(|g| formula::passed_on(g.clone(), own)));
    }
}

/// Passes on what a layer receives, its spheres' own included, where the sign changes: over three times the denominator.
pub(super) fn turn<T: Numerator>(received: &Planes<T>, own: &T, forces: &mut Planes<T>) {
    let spheres = received[0].len();
    for plane in forces.iter_mut() {
        plane.resize(spheres, T::zero());
    }
    let [a, b, c] = received;
    let [to_a, to_b, to_c] = forces;
    let above = a.iter().zip(b).zip(c);
    let below = to_a.iter_mut().zip(to_b).zip(to_c);
    for (((a, b), c), ((to_a, to_b), to_c)) in above.zip(below) {
        let [x, y, z] = formula::tripled_half_turn(&[a.clone(), b.clone(), c.clone()]);
        *to_a = formula::passed_on(x, own);
        *to_b = formula::passed_on(y, own);
        *to_c = formula::passed_on(z, own);
    }
}

/// The least and the greatest of some numbers; none of none.
pub(super) fn extremes<'t, T: Numerator + 't>(
    numbers: impl IntoIterator<Item = &'t T>,
) -> Option<[T; 2]> {
    let mut numbers = numbers.into_iter();
    let first = numbers.next()?;
    let ends = numbers.fold([first, first], |[least, greatest], x| {
        [least.min(x), greatest.max(x)]
    });
    Some(ends.map(Clone::clone))
}
