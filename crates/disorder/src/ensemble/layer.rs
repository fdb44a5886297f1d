//! The contact forces below one layer, and their transfer to the next layer.

use cannonpile::formula;
use cannonpile::lattice::{Direction, Region, Sign};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::ToPrimitive;

use crate::error::bug;
use crate::number::Number;
use crate::{Each, Error};

/// An integer type. A bound computed beforehand ensures that it is wide enough, so plain operators do not overflow.
pub(super) trait Numerator:
    Number + Integer + ToPrimitive + TryFrom<BigInt> + Into<BigInt> + Send + Sync
{
}

impl Numerator for i64 {}
impl Numerator for i128 {}
impl Numerator for BigInt {}

/// Three numbers for each sphere of a layer, by direction. The spheres are stored row by row.
pub(super) type Planes<T> = [Vec<T>; 3];

/// The indices of the spheres of a layer in its [`Planes`].
#[derive(Clone, Debug)]
pub(super) struct Places {
    /// j of the first row.
    y: i128,
    /// For each row: its first i, and the number of spheres before it.
    rows: Vec<(i128, usize)>,
    spheres: usize,
}

impl Places {
    /// Returns the indices for a region, which must fit in memory.
    pub(super) fn of(region: &Region) -> Result<Self, Error> {
        let mut places = Self {
            y: *region.y().start(),
            rows: Vec::new(),
            spheres: 0,
        };
        for row in region.rows(0) {
            places.rows.push((row.i.start, places.spheres));
            places.spheres += row.length()?;
        }
        Ok(places)
    }

    pub(super) const fn spheres(&self) -> usize {
        self.spheres
    }

    /// Iterates over the rows: j, the first i, and the indices of the spheres.
    pub(super) fn rows(&self) -> impl Iterator<Item = (i128, i128, core::ops::Range<usize>)> + '_ {
        let ends = self.rows.iter().skip(1).map(|(_, before)| *before);
        let ends = ends.chain([self.spheres]);
        let rows = self.rows.iter().zip(ends);
        (self.y..)
            .zip(rows)
            .map(|(j, ((i, before), end))| (j, *i, *before..end))
    }

    /// Returns the index of site (i, j). It is wrong if the site lies beyond the end of its row.
    fn index(&self, i: i128, j: i128) -> Option<usize> {
        let row = usize::try_from(j - self.y).ok()?;
        let (first, before) = self.rows.get(row)?;
        before.checked_add(usize::try_from(i - first).ok()?)
    }
}

/// Moves the forces below a layer to the next layer: sphere (i, j) acts on the sphere (i, j) + σd. A sphere without contact
/// from above in some direction receives 0.
pub(super) fn move_down<T: Numerator>(
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
            let begin = to.index(i + di, j + dj);
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

/// Computes the forces below a layer from the forces on it, if the sign does not change. `own` is the force that the weight
/// of a sphere adds.
pub(super) fn transmit<T: Numerator>(received: &Planes<T>, own: &T, forces: &mut Planes<T>) {
    for (received, forces) in received.iter().zip(forces) {
        forces.clear();
        forces.extend(
            received
                .iter()
                .map(|g| formula::transmitted(g.clone(), own)),
        );
    }
}

/// Computes the forces below a layer from the forces on it, if the sign changes. The results have three times the
/// denominator of the received forces.
pub(super) fn transmit_turned<T: Numerator>(received: &Planes<T>, own: &T, forces: &mut Planes<T>) {
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
        *to_a = formula::transmitted(x, own);
        *to_b = formula::transmitted(y, own);
        *to_c = formula::transmitted(z, own);
    }
}

/// Returns the least and the greatest number, or `None` for an empty list.
pub(super) fn extremes<'t, T: Numerator + 't>(
    numbers: impl IntoIterator<Item = &'t T>,
) -> Option<[T; 2]> {
    let mut numbers = numbers.into_iter();
    let first = numbers.next()?;
    let ends = numbers.fold([first, first], |[least, greatest], x| {
        [least.min(x), greatest.max(x)]
    });
    Some(ends.each(Clone::clone))
}
