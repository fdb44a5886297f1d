//! All contact forces of a straight pile, written into slices.
//!
//! A straight pile has few distinct forces: along a line they are 1, 2, 3, … increments. They are rounded once, into a
//! table, and the rows of the pile are pieces of it: under one sphere, along a row of layer k, α runs down the table from
//! k−j+1 increments to one, β runs up it, and γ stays at j+1; under any other top each direction rises, is level, and
//! falls. Nothing else is computed and nothing allocated, and every row can be filled by itself.

use alloc::vec::Vec;
use core::ops::Range;

use num_rational::BigRational;

use crate::formula;
use crate::lattice::Sign;
use crate::lattice::{Along, Dimension, Direction, Region, Slopes};
use crate::scalar::{NearestFloat, Ring, Surd};
use crate::shape::Shape;
use crate::{Error, Packing, Pile, parallel};

/// The distinct contact forces of a straight pile, by direction: what 1, 2, 3, … increments come to.
///
/// `V` is `f64` or `f32`, each the float nearest to the exact force in SI ([`nearest`](Self::nearest)), or `i64` or `i32`,
/// the exact multiples of f₀ on an equilateral base ([`multiples`](Self::multiples)).
///
/// # Examples
/// ```
/// use cannonpile::{Pile, Strengths};
///
/// let pile = Pile::triangular(10)?;
/// let strengths = Strengths::<i64>::multiples(&pile)?;
/// // The contacts below row j = 1 of layer 3, along α, β and γ.
/// let [mut alpha, mut beta, mut gamma] = [[0; 3]; 3];
/// strengths.fill_row(3, 1, [&mut alpha, &mut beta, &mut gamma])?;
/// assert_eq!((alpha, beta, gamma), ([3, 2, 1], [1, 2, 3], [2, 2, 2]));
///
/// // All of them, layer by layer and row by row: a number for each sphere that is not on the floor.
/// let spheres = strengths.spheres()?;
/// assert_eq!(spheres, 165);
/// let mut forces = vec![[0; 3]; spheres];
/// strengths.fill_interleaved(&mut forces)?;
/// assert_eq!(forces[0], [1, 1, 1]);
/// assert_eq!(forces.as_flattened().iter().sum::<i64>(), 1485);
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Strengths<V> {
    /// By direction; the n-th is that of n+1 increments. As long as there are layers above the floor.
    tables: [Vec<V>; 3],
    shape: Shape,
    /// How many spheres lie above each of these layers and the floor.
    above: Vec<u128>,
}

impl<F: NearestFloat> Strengths<F> {
    /// The magnitudes in the units of a packing, each rounded once, to the nearest.
    ///
    /// # Errors
    /// [`Error::NotStraight`] for a pile with changes of sign or loads, of spheres that do not weigh mg, or of discs;
    /// [`Error::TooLarge`] for more layers than memory could hold the contacts of; [`Error::Overflow`] for a force beyond
    /// the floats.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::lattice::{Direction, Site};
    /// use cannonpile::{Packing, Pile, Strengths};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let strengths = Strengths::<f64>::nearest(&packing)?;
    /// let mut row = [[0.0; 5]; 3];
    /// let [alpha, beta, gamma] = &mut row;
    /// strengths.fill_row(5, 1, [alpha, beta, gamma])?;
    /// let exact = packing.contact(Site { i: 2, j: 1, k: 5 }, Direction::Alpha)?;
    /// assert_eq!(Some(row[0][2]), exact.nearest());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn nearest(packing: &Packing<'_>) -> Result<Self, Error> {
        let unit = packing.unit_force();
        Self::from_pile(packing.pile(), |multiple| {
            let force: Surd = unit.scaled(multiple);
            force.nearest().ok_or(Error::Overflow {
                quantity: "a contact force",
                scalar: core::any::type_name::<F>(),
            })
        })
    }
}

impl<V: TryFrom<i128>> Strengths<V> {
    /// The multiples of f₀, exactly.
    ///
    /// # Errors
    /// As for [`nearest`](Self::nearest); [`Error::Overflow`] too if a multiple is no integer, as on isosceles bases, or does
    /// not fit.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Error, Pile, Strengths};
    ///
    /// let strengths = Strengths::<i32>::multiples(&Pile::triangular(10)?)?;
    /// let [mut alpha, mut beta, mut gamma] = [[0; 2]; 3];
    /// strengths.fill_row(4, 3, [&mut alpha, &mut beta, &mut gamma])?;
    /// assert_eq!((alpha, beta, gamma), ([2, 1], [1, 2], [4, 4]));
    ///
    /// // A contact of 128 f₀ does not fit in an i8.
    /// assert!(Strengths::<i8>::multiples(&Pile::triangular(128)?).is_ok());
    /// let refused = Strengths::<i8>::multiples(&Pile::triangular(129)?);
    /// assert!(matches!(refused, Err(Error::Overflow { .. })));
    /// # Ok::<(), Error>(())
    /// ```
    pub fn multiples(pile: &Pile) -> Result<Self, Error> {
        Self::from_pile(pile, |multiple| {
            let whole = multiple
                .is_integer()
                .then(|| i128::try_from(multiple.numer()));
            let fitting = whole.and_then(Result::ok).and_then(|n| V::try_from(n).ok());
            fitting.ok_or(Error::Overflow {
                quantity: "a multiple of the unit force",
                scalar: core::any::type_name::<V>(),
            })
        })
    }
}

/// The most layers: the contacts of as many take 10¹⁹ bytes.
const MOST_LAYERS: u32 = 1_000_000;

impl<V> Strengths<V> {
    fn from_pile(
        pile: &Pile,
        value: impl Fn(&BigRational) -> Result<V, Error>,
    ) -> Result<Self, Error> {
        if !pile.is_straight_and_even() || pile.dimension() == Dimension::Two {
            return Err(Error::NotStraight);
        }
        if pile.layers() > MOST_LAYERS.into() {
            return Err(Error::TooLarge {
                quantity: "a table of forces",
                needed: pile.layers().unsigned_abs().into(),
                limit: MOST_LAYERS.into(),
                remedy: "ask for single rows of the pile",
            });
        }
        let increments = pile.increments::<BigRational>();
        let table = |direction: Direction| {
            let w = &increments[direction.index()];
            (1..pile.layers())
                .map(|n| value(&formula::force(BigRational::from_i128(n), w)))
                .collect::<Result<Vec<V>, Error>>()
        };
        let [alpha, beta, gamma] = Direction::ALL.map(table);
        let shape = pile.shape().clone();
        let mut sum = 0_u128;
        let above = (0..pile.layers()).map(|k| {
            let above = sum;
            let spheres = shape.layer(k).map_or(0_u32.into(), |layer| layer.sites());
            sum = sum.saturating_add(u128::try_from(spheres).unwrap_or(u128::MAX));
            above
        });
        Ok(Self {
            above: above.collect(),
            tables: [alpha?, beta?, gamma?],
            shape,
        })
    }
}

impl<V: Copy + Send + Sync> Strengths<V> {
    /// How many spheres have spheres below them: the length of each slice for the whole pile.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if no memory could hold as many.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Pile, Strengths};
    ///
    /// let pile = Pile::triangular(10)?;
    /// // Of the 220 spheres 55 are on the floor.
    /// assert_eq!(Strengths::<i32>::multiples(&pile)?.spheres()?, 220 - 55);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn spheres(&self) -> Result<usize, Error> {
        let needed = self.above.last().copied().unwrap_or(0);
        usize::try_from(needed).map_err(|_| Error::TooLarge {
            quantity: "all contact forces",
            needed: needed.into(),
            limit: u64::MAX,
            remedy: "fill layer by layer",
        })
    }

    /// The forces below row j of layer k, one slice for each direction, of as many numbers as the row has spheres.
    ///
    /// # Errors
    /// [`Error::NoSuchRow`] if the pile has no such row above the floor; [`Error::Length`] for a slice of another length.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    /// use cannonpile::stacking::Stacking;
    /// use cannonpile::{Pile, Strengths};
    ///
    /// let strengths = Strengths::<i32>::multiples(&Pile::triangular(10)?)?;
    /// let [mut alpha, mut beta, mut gamma] = [[0; 4]; 3];
    /// strengths.fill_row(8, 5, [&mut alpha, &mut beta, &mut gamma])?;
    /// assert_eq!((alpha, beta, gamma), ([4, 3, 2, 1], [1, 2, 3, 4], [6; 4]));
    ///
    /// // Below the middle of a wide top all lines are as long.
    /// let wide = Pile::under(Region::hexagon(4, 4)?, Stacking::fcc(5)?)?;
    /// let [mut alpha, mut beta, mut gamma] = [[0; 9]; 3];
    /// Strengths::<i32>::multiples(&wide)?.fill_row(2, 0, [&mut alpha, &mut beta, &mut gamma])?;
    /// assert_eq!((alpha, beta), ([3, 3, 3, 3, 3, 3, 3, 2, 1], [1, 2, 3, 3, 3, 3, 3, 3, 3]));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill_row(&self, k: i128, j: i128, slices: [&mut [V]; 3]) -> Result<(), Error> {
        let layer = self.layer_above_the_floor(k);
        let layer = layer.filter(|layer| layer.y().contains(&j));
        let layer = layer.ok_or(Error::NoSuchRow { k, j })?;
        let row = layer.row(j);
        let spheres = usize::try_from(row.end - row.start).unwrap_or(usize::MAX);
        for slice in &slices {
            check_length(slice.len(), spheres)?;
        }
        self.row(k, j, &layer, slices);
        Ok(())
    }

    /// The forces below layer k, one slice for each direction, row after row.
    ///
    /// # Errors
    /// As for [`fill_row`](Self::fill_row).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Pile, Strengths};
    ///
    /// let strengths = Strengths::<i32>::multiples(&Pile::triangular(10)?)?;
    /// let [mut alpha, mut beta, mut gamma] = [[0; 6]; 3];
    /// strengths.fill_layer(2, [&mut alpha, &mut beta, &mut gamma])?;
    /// assert_eq!(alpha, [3, 2, 1, 2, 1, 1]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill_layer(&self, k: i128, slices: [&mut [V]; 3]) -> Result<(), Error> {
        let layer = self.layer_above_the_floor(k);
        let layer = layer.ok_or(Error::NoSuchRow { k, j: 0 })?;
        let spheres = usize::try_from(layer.sites()).unwrap_or(usize::MAX);
        for slice in &slices {
            check_length(slice.len(), spheres)?;
        }
        self.layer(k, slices);
        Ok(())
    }

    /// All forces, one slice for each direction, layer after layer from the top; on all cores with the feature `rayon`.
    ///
    /// # Errors
    /// [`Error::Length`] for a slice that is not as long as [`spheres`](Self::spheres) says.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Pile, Strengths};
    ///
    /// let strengths = Strengths::<i32>::multiples(&Pile::triangular(3)?)?;
    /// let [mut alpha, mut beta, mut gamma] = [[0; 4]; 3];
    /// strengths.fill([&mut alpha, &mut beta, &mut gamma])?;
    /// assert_eq!((alpha, beta, gamma), ([1, 2, 1, 1], [1, 1, 2, 1], [1, 1, 1, 2]));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill(&self, slices: [&mut [V]; 3]) -> Result<(), Error> {
        let spheres = self.spheres()?;
        for slice in &slices {
            check_length(slice.len(), spheres)?;
        }
        self.layers(0..self.tables[0].len(), slices);
        Ok(())
    }

    /// All forces, three to a sphere, layer after layer from the top.
    ///
    /// # Errors
    /// As for [`fill`](Self::fill).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Pile, Strengths};
    ///
    /// let strengths = Strengths::<i32>::multiples(&Pile::triangular(3)?)?;
    /// let mut forces = [[0; 3]; 4];
    /// strengths.fill_interleaved(&mut forces)?;
    /// assert_eq!(forces, [[1, 1, 1], [2, 1, 1], [1, 2, 1], [1, 1, 2]]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill_interleaved(&self, forces: &mut [[V; 3]]) -> Result<(), Error> {
        check_length(forces.len(), self.spheres()?)?;
        self.layers_interleaved(0..self.tables[0].len(), forces);
        Ok(())
    }

    fn layer_above_the_floor(&self, k: i128) -> Option<Region> {
        let above = k < self.shape.layers() - 1;
        self.shape.layer(k).ok().filter(|_| above)
    }

    /// How many spheres these layers have; they fit in memory.
    fn spheres_in(&self, layers: &Range<usize>) -> usize {
        let above = |k: usize| self.above.get(k).copied().unwrap_or(0);
        usize::try_from(above(layers.end) - above(layers.start)).unwrap_or(0)
    }

    /// Two parts of some layers with about as many spheres, where that is worth a thread.
    fn halves(&self, layers: &Range<usize>) -> Option<(Range<usize>, Range<usize>)> {
        const WORTH_A_THREAD: usize = 1 << 15;
        let spheres = self.spheres_in(layers);
        if !parallel::HAS_THREADS || spheres < 2 * WORTH_A_THREAD {
            return None;
        }
        let inside = layers.start + 1..layers.end;
        let middle = inside
            .clone()
            .find(|k| 2 * self.spheres_in(&(layers.start..*k)) >= spheres)?;
        Some((layers.start..middle, middle..layers.end))
    }

    /// Some layers, in two halves at once where there are threads.
    fn layers(&self, layers: Range<usize>, mut slices: [&mut [V]; 3]) {
        let Some((upper, lower)) = self.halves(&layers) else {
            for k in layers {
                let spheres = self.spheres_in(&(k..k + 1));
                self.layer(k as i128, first(&mut slices, spheres));
            }
            return;
        };
        let above = first(&mut slices, self.spheres_in(&upper));
        parallel::join(|| self.layers(upper, above), || self.layers(lower, slices));
    }

    fn layers_interleaved(&self, layers: Range<usize>, forces: &mut [[V; 3]]) {
        if let Some((upper, lower)) = self.halves(&layers) {
            let (above, below) = forces.split_at_mut(self.spheres_in(&upper));
            parallel::join(
                || self.layers_interleaved(upper, above),
                || self.layers_interleaved(lower, below),
            );
            return;
        }
        let [alpha, beta, gamma] = &self.tables;
        let mut rest = forces;
        for k in layers {
            if !self.shape.is_pyramid() {
                rest = self.layer_interleaved(k as i128, rest);
                continue;
            }
            for (j, c) in gamma[..=k].iter().enumerate() {
                let n = k - j + 1;
                let row = rest.split_off_mut(..n).unwrap_or_default();
                let values = alpha[..n].iter().rev().zip(&beta[..n]);
                for (force, (a, b)) in row.iter_mut().zip(values) {
                    *force = [*a, *b, *c];
                }
            }
        }
    }

    /// A layer of any straight pile; returns what lies below it.
    fn layer_interleaved<'f>(&self, k: i128, forces: &'f mut [[V; 3]]) -> &'f mut [[V; 3]] {
        let mut rest = forces;
        let Some(region) = self.layer_above_the_floor(k) else {
            return rest;
        };
        for j in region.y() {
            let counts = self.counts(k, j, &region);
            let n = counts.iter().map(|(_, n)| *n).max().unwrap_or(0);
            let row = rest.split_off_mut(..n).unwrap_or_default();
            for ((direction, table), (slopes, n)) in self.tables.iter().enumerate().zip(counts) {
                let values = in_turn(&slopes.along(0..n, table), n);
                for (force, value) in row.iter_mut().zip(values) {
                    force[direction] = value;
                }
            }
        }
        rest
    }

    fn layer(&self, k: i128, slices: [&mut [V]; 3]) {
        let Some(region) = self.layer_above_the_floor(k) else {
            return;
        };
        let mut rest = slices;
        for j in region.y() {
            let row = region.row(j);
            let spheres = usize::try_from(row.end - row.start).unwrap_or(0);
            self.row(k, j, &region, first(&mut rest, spheres));
        }
    }

    fn row(&self, k: i128, j: i128, region: &Region, [a, b, c]: [&mut [V]; 3]) {
        if !self.shape.is_pyramid() {
            let rows = [a, b, c].into_iter().zip(&self.tables);
            for ((row, table), (slopes, n)) in rows.zip(self.counts(k, j, region)) {
                write(&slopes.along(0..n, table), row);
            }
            return;
        }
        let [alpha, beta, gamma] = &self.tables;
        let n = a.len();
        // In one loop: two of them, or a copy, take half as long again on rows this short.
        let values = alpha[..n].iter().rev().zip(&beta[..n]);
        for ((a, b), (down, up)) in a.iter_mut().zip(b).zip(values) {
            (*a, *b) = (*down, *up);
        }
        let same = usize::try_from(j).ok().and_then(|j| gamma.get(j));
        if let Some(same) = same {
            for force in c {
                *force = *same;
            }
        }
    }

    /// How many spheres lie above those of a row, by direction, and how long the row is.
    fn counts(&self, k: i128, j: i128, region: &Region) -> [(Slopes, usize); 3] {
        let row = region.row(j);
        let spheres = usize::try_from(row.end - row.start).unwrap_or(0);
        let sign = self.shape.sign_below(k).unwrap_or(Sign::Plus);
        let counts = region.row_counts(j, sign, k);
        counts.map(|count| (Slopes::new(count, row.start, spheres), spheres))
    }
}

/// The values along a row of `n` places.
fn in_turn<'v, V: Copy>(along: &Along<'v, V>, n: usize) -> impl Iterator<Item = V> + use<'v, V> {
    let Along { up, level, down } = *along;
    let same = n - up.len() - down.len();
    let level = level
        .into_iter()
        .flat_map(move |value| core::iter::repeat_n(value, same));
    up.iter().chain(level).chain(down.iter().rev()).copied()
}

fn write<V: Copy>(along: &Along<'_, V>, row: &mut [V]) {
    let Along { up, level, down } = *along;
    let (rising, rest) = row.split_at_mut(up.len());
    let (same, falling) = rest.split_at_mut(rest.len() - down.len());
    for (force, value) in rising.iter_mut().zip(up) {
        *force = *value;
    }
    if let Some(value) = level {
        same.fill(*value);
    }
    for (force, value) in falling.iter_mut().zip(down.iter().rev()) {
        *force = *value;
    }
}

/// The first `n` of what is left of each slice, which is left without them; lengths have been checked.
fn first<'a, V>(rest: &mut [&'a mut [V]; 3], n: usize) -> [&'a mut [V]; 3] {
    rest.each_mut()
        .map(|rest| rest.split_off_mut(..n).unwrap_or_default())
}

fn check_length(given: usize, needed: usize) -> Result<(), Error> {
    if given == needed {
        Ok(())
    } else {
        Err(Error::Length { needed, given })
    }
}
