//! All contact forces of a straight pile, written into slices.
//!
//! A straight pile under one sphere has few distinct forces: along a line they are 1, 2, 3, … increments. They are
//! rounded once, into a table, and the rows of the pile are pieces of it: along a row of layer k, α runs down the table
//! from k−j+1 increments to one, β runs up it, and γ stays at j+1. Nothing else is computed and nothing allocated, and
//! every row can be filled by itself.

use alloc::vec::Vec;
use core::ops::Range;

use num_rational::BigRational;

use crate::lattice::{Dimension, Direction};
use crate::scalar::{NearestFloat, Ring, Surd};
use crate::{Error, Packing, Pile, parallel};

/// The distinct contact forces of a straight pile under one sphere, by direction: what 1, 2, 3, … increments come to.
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
}

impl<F: NearestFloat> Strengths<F> {
    /// The magnitudes in the units of a packing, each rounded once, to the nearest.
    ///
    /// # Errors
    /// [`Error::NotStraight`] for a pile that is not the paper's: straight, under one sphere, of spheres that weigh mg;
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
        if !pile.is_paper_pile() || pile.dimension() == Dimension::Two {
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
            let w = &increments.per_line()[direction.index()];
            (1..pile.layers())
                .map(|n| value(&(BigRational::from_i128(n) * w)))
                .collect::<Result<Vec<V>, Error>>()
        };
        let [alpha, beta, gamma] = Direction::ALL.map(table);
        Ok(Self {
            tables: [alpha?, beta?, gamma?],
        })
    }
}

impl<V: Copy + Send + Sync> Strengths<V> {
    /// How many spheres have spheres below them: the length of each slice for the whole pile.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if no memory could hold as many.
    pub fn spheres(&self) -> Result<usize, Error> {
        let layers = self.tables[0].len();
        let spheres = |n: u128| n * (n + 1) * (n + 2) / 6;
        let needed = spheres(layers as u128);
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
    /// use cannonpile::{Pile, Strengths};
    ///
    /// let strengths = Strengths::<i32>::multiples(&Pile::triangular(10)?)?;
    /// let [mut alpha, mut beta, mut gamma] = [[0; 4]; 3];
    /// strengths.fill_row(8, 5, [&mut alpha, &mut beta, &mut gamma])?;
    /// assert_eq!((alpha, beta, gamma), ([4, 3, 2, 1], [1, 2, 3, 4], [6; 4]));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill_row(&self, k: usize, j: usize, slices: [&mut [V]; 3]) -> Result<(), Error> {
        if k >= self.tables[0].len() || j > k {
            return Err(Error::NoSuchRow { k, j });
        }
        for slice in &slices {
            check_length(slice.len(), k - j + 1)?;
        }
        self.row(k, j, slices);
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
    pub fn fill_layer(&self, k: usize, slices: [&mut [V]; 3]) -> Result<(), Error> {
        if k >= self.tables[0].len() {
            return Err(Error::NoSuchRow { k, j: 0 });
        }
        for slice in &slices {
            check_length(slice.len(), (k + 1) * (k + 2) / 2)?;
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
    pub fn fill_interleaved(&self, forces: &mut [[V; 3]]) -> Result<(), Error> {
        check_length(forces.len(), self.spheres()?)?;
        self.layers_interleaved(0..self.tables[0].len(), forces);
        Ok(())
    }

    /// Some layers, in two halves at once where there are threads.
    fn layers(&self, layers: Range<usize>, mut slices: [&mut [V]; 3]) {
        let Some((upper, lower)) = halves(&layers) else {
            for k in layers {
                self.layer(k, first(&mut slices, spheres_in(&(k..k + 1))));
            }
            return;
        };
        let above = first(&mut slices, spheres_in(&upper));
        parallel::join(|| self.layers(upper, above), || self.layers(lower, slices));
    }

    fn layers_interleaved(&self, layers: Range<usize>, forces: &mut [[V; 3]]) {
        if let Some((upper, lower)) = halves(&layers) {
            let (above, below) = forces.split_at_mut(spheres_in(&upper));
            parallel::join(
                || self.layers_interleaved(upper, above),
                || self.layers_interleaved(lower, below),
            );
            return;
        }
        let [alpha, beta, gamma] = &self.tables;
        let mut rest = forces;
        for k in layers {
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

    fn layer(&self, k: usize, slices: [&mut [V]; 3]) {
        let mut rest = slices;
        for j in 0..=k {
            self.row(k, j, first(&mut rest, k - j + 1));
        }
    }

    fn row(&self, k: usize, j: usize, [a, b, c]: [&mut [V]; 3]) {
        let [alpha, beta, gamma] = &self.tables;
        let n = k - j + 1;
        // In one loop: two of them, or a copy, take half as long again on rows this short.
        let values = alpha[..n].iter().rev().zip(&beta[..n]);
        for ((a, b), (down, up)) in a.iter_mut().zip(b).zip(values) {
            (*a, *b) = (*down, *up);
        }
        for force in c {
            *force = gamma[j];
        }
    }
}

/// How many spheres these layers have.
fn spheres_in(layers: &Range<usize>) -> usize {
    let down_to = |n: usize| n * (n + 1) * (n + 2) / 6;
    down_to(layers.end) - down_to(layers.start)
}

/// Two parts of some layers with about as many spheres, where that is worth a thread.
fn halves(layers: &Range<usize>) -> Option<(Range<usize>, Range<usize>)> {
    const WORTH_A_THREAD: usize = 1 << 15;
    let spheres = spheres_in(layers);
    if !parallel::HAS_THREADS || spheres < 2 * WORTH_A_THREAD {
        return None;
    }
    let inside = layers.start + 1..layers.end;
    let middle = inside
        .clone()
        .find(|k| 2 * spheres_in(&(layers.start..*k)) >= spheres)?;
    Some((layers.start..middle, middle..layers.end))
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
