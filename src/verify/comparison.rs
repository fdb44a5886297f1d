//! Measured forces against exact ones.

use core::fmt;

use super::difference::{Difference, Extra, distance};
use super::exact::{self, Exact};
use super::pairs::Pairs;
use super::{MAX_ENTRIES, Measured, Refusal};
use crate::lattice::{Dimension, Numbering};
use crate::{Error, Packing};

/// How many missing and how many extra contacts are kept; all of them are counted.
const KEPT: usize = 1000;

/// What was measured, compared with the exact forces of a pile: see [`verify`](super) for what that means.
///
/// # Examples
/// ```
/// use cannonpile::geometry::Spacing;
/// use cannonpile::verify::{Comparison, Measured};
/// use cannonpile::{Packing, Pile};
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(2)?;
/// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
/// let measured = [([1, 2], 0.46225016352102427), ([3, 1], 0.5)];
/// let measured = measured.map(|(ids, force)| Measured::new(ids, force));
/// let comparison = Comparison::new(&packing, measured)?;
///
/// assert_eq!((comparison.matched(), comparison.missing(), comparison.extra(0.0)), (2, 1, 0));
/// assert!((0.08..0.09).contains(&comparison.largest_error()));
/// assert_eq!(
///     comparison.worst().unwrap().to_string(),
///     "contact of sphere 1 (k=0, i=0, j=0) with sphere 3 along beta: measured 0.5 N, exact 0.46225016352102427 N",
/// );
/// assert!(!comparison.accepted(0.1));
/// # Ok::<(), cannonpile::verify::Refusal>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    contacts: u64,
    matched: u64,
    missing: u64,
    first_missing: Vec<Difference>,
    fixed: u64,
    largest_force: f64,
    /// What pairs without a contact carry, over the largest force, from the greatest down.
    strays: Vec<f64>,
    greatest_strays: Vec<Extra>,
    worst: Option<Difference>,
    rms: f64,
}

impl Comparison {
    /// Compares measured forces with those of a packing. Their order does not matter, nor which sphere of a pair is named
    /// first.
    ///
    /// Memory grows with what was measured; the exact forces are made row by row.
    ///
    /// # Errors
    /// [`Refusal::Entry`] for a number that no sphere has, a sphere paired with itself, a pair that is there twice, and a
    /// force that is not finite. [`Refusal::Scene`] with [`Error::TooLarge`] for more than [`MAX_ENTRIES`] contacts;
    /// [`Refusal::OutOfRange`] for exact forces beyond the normal `f64`.
    pub fn new(
        packing: &Packing<'_>,
        measured: impl IntoIterator<Item = Measured>,
    ) -> Result<Self, Refusal> {
        let pile = packing.pile();
        let contacts = pile.contacts();
        let count = u64::try_from(&contacts).ok();
        let Some(count) = count.filter(|count| *count <= MAX_ENTRIES) else {
            return Err(Refusal::Scene(Error::TooLarge {
                quantity: "a comparison of all contacts",
                needed: contacts,
                limit: MAX_ENTRIES,
                remedy: "use fewer layers, or a smaller top or base",
            }));
        };
        let numbering = pile.numbering()?;
        let mut pairs = Pairs::new(measured, &numbering)?;
        let mut tally = Tally::new(pile.dimension());
        for exact in exact::contacts(packing, &numbering, pairs.has_vectors())? {
            let exact = exact?;
            let measured = pairs.meet(exact.ids);
            tally.add(&exact, measured);
        }
        Ok(tally.close(count, &pairs, &numbering))
    }

    /// How many contacts the pile has.
    #[must_use]
    pub fn contacts(&self) -> u64 {
        self.contacts
    }

    /// How many of them were measured.
    #[must_use]
    pub fn matched(&self) -> u64 {
        self.matched
    }

    /// How many have a force and were not measured.
    #[must_use]
    pub fn missing(&self) -> u64 {
        self.missing
    }

    /// The first thousand of the missing contacts, from the top.
    #[must_use]
    pub fn missing_contacts(&self) -> &[Difference] {
        &self.first_missing
    }

    /// How many pairs that are no contacts of the pile carry more than `tolerance` times the largest exact force.
    #[must_use]
    pub fn extra(&self, tolerance: f64) -> u64 {
        let extra = self.strays.partition_point(|stray| *stray > tolerance);
        u64::try_from(extra).unwrap_or(u64::MAX)
    }

    /// How many pairs that are no contacts of the pile carry something, but no more than that.
    #[must_use]
    pub fn noise(&self, tolerance: f64) -> u64 {
        let all = u64::try_from(self.strays.len()).unwrap_or(u64::MAX);
        all - self.extra(tolerance)
    }

    /// The thousand pairs that carry the most without being contacts, from the greatest down, noise included.
    #[must_use]
    pub fn extra_pairs(&self) -> &[Extra] {
        &self.greatest_strays
    }

    /// How many pairs of spheres of the bottom layer were left out.
    #[must_use]
    pub fn fixed(&self) -> u64 {
        self.fixed
    }

    /// The largest exact force, by magnitude.
    #[must_use]
    pub fn largest_force(&self) -> f64 {
        self.largest_force
    }

    /// The largest relative error of a contact that was measured; infinite if there is a force where the whole pile has
    /// none.
    #[must_use]
    pub fn largest_error(&self) -> f64 {
        self.worst.as_ref().map_or(0.0, |worst| worst.error)
    }

    /// The root of the mean square of the relative errors of the contacts that were measured, to some 1e-8 of itself.
    #[must_use]
    pub fn rms_error(&self) -> f64 {
        self.rms
    }

    /// The contact with the largest relative error, the first of several; none if there was no contact measured.
    #[must_use]
    pub fn worst(&self) -> Option<&Difference> {
        self.worst.as_ref()
    }

    /// Whether nothing is missing, nothing extra, and no error over `tolerance`.
    #[must_use]
    pub fn accepted(&self, tolerance: f64) -> bool {
        self.missing == 0 && self.extra(tolerance) == 0 && self.largest_error() <= tolerance
    }
}

impl fmt::Display for Comparison {
    /// One line, for the message of an assertion.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            contacts,
            matched,
            missing,
            rms,
            ..
        } = self;
        let (extra, largest) = (self.strays.len(), self.largest_error());
        write!(
            f,
            "{matched} of {contacts} contacts measured, {missing} missing, {extra} extra; largest error {largest:e}, rms \
             {rms:e}"
        )?;
        if let Some(worst) = self.worst() {
            write!(f, "; worst: {worst}")?;
        }
        if let Some(missing) = self.first_missing.first() {
            write!(f, "; missing: {missing}")?;
        }
        if let Some(extra) = self.greatest_strays.first() {
            write!(f, "; extra: {extra}")?;
        }
        Ok(())
    }
}

/// What is known while contacts go by.
struct Tally {
    dimension: Dimension,
    matched: u64,
    missing: u64,
    first_missing: Vec<Difference>,
    largest_force: f64,
    /// The worst of those with a force, and the worst of those without: their errors have the largest force below, which
    /// is known at the end only.
    worst: [Option<Difference>; 2],
    squares: [Squares; 2],
}

impl Tally {
    fn new(dimension: Dimension) -> Self {
        Self {
            dimension,
            matched: 0,
            missing: 0,
            first_missing: Vec::new(),
            largest_force: 0.0,
            worst: [None, None],
            squares: [Squares::default(), Squares::default()],
        }
    }

    fn add(&mut self, exact: &Exact, measured: Option<Measured>) {
        self.largest_force = self.largest_force.max(exact.force.abs());
        let loaded = exact.force != 0.0;
        let Some(measured) = measured.filter(|measured| !(loaded && measured.is_zero())) else {
            if loaded {
                self.missing += 1;
                if self.first_missing.len() < KEPT {
                    let missing = Difference::new(exact, None, self.dimension);
                    self.first_missing.push(missing);
                }
            }
            return;
        };
        self.matched += 1;
        let vectors = measured.vector.zip(exact.vector);
        let apart = vectors.map_or(0.0, |(measured, exact)| distance(measured, exact));
        let apart = apart.max((measured.force - exact.force).abs());
        let [of_loaded, of_others] = &mut self.worst;
        let [squares, other_squares] = &mut self.squares;
        let (error, worst, squares) = if loaded {
            (relative(apart, exact.force.abs()), of_loaded, squares)
        } else {
            (apart, of_others, other_squares)
        };
        squares.add(error);
        if worst.as_ref().is_none_or(|worst| worst.error < error) {
            *worst = Some(Difference {
                error,
                ..Difference::new(exact, Some(measured), self.dimension)
            });
        }
    }

    /// With all contacts seen, and what is left of the pairs.
    fn close(self, contacts: u64, pairs: &Pairs, numbering: &Numbering<'_>) -> Comparison {
        let Self {
            largest_force,
            dimension,
            matched,
            ..
        } = self;
        let [of_loaded, of_others] = self.worst;
        let of_others = of_others.map(|worst| Difference {
            error: relative(worst.error, largest_force),
            ..worst
        });
        let worst = match (of_loaded, of_others) {
            (Some(a), Some(b)) => Some(if b.error > a.error { b } else { a }),
            (a, b) => a.or(b),
        };
        let [squares, others] = self.squares;
        let rms = squares
            .with(others.over(largest_force))
            .root_of_mean(matched);
        let first_fixed = numbering.first_on_floor();
        let is_fixed = |stray: &&Measured| stray.ids.iter().all(|id| *id >= first_fixed);
        let fixed = pairs.left().filter(is_fixed).count();
        let free = pairs.left().filter(|stray| !is_fixed(stray));
        let mut strays: Vec<(f64, &Measured)> = free
            .filter(|stray| !stray.is_zero())
            .map(|stray| (relative(stray.magnitude(), largest_force), stray))
            .collect();
        // The greatest first, of equals the one with the lesser numbers.
        strays.sort_by(|(a, one), (b, other)| b.total_cmp(a).then(one.ids.cmp(&other.ids)));
        let kept = strays.iter().take(KEPT);
        let greatest_strays = kept.filter_map(|(error, stray)| {
            let [one, other] = stray.ids.map(|id| numbering.site(id));
            Some(Extra {
                ids: stray.ids,
                sites: [one?, other?],
                force: stray.magnitude(),
                error: *error,
                dimension,
            })
        });
        Comparison {
            contacts,
            matched,
            missing: self.missing,
            first_missing: self.first_missing,
            fixed: u64::try_from(fixed).unwrap_or(u64::MAX),
            largest_force,
            greatest_strays: greatest_strays.collect(),
            strays: strays.into_iter().map(|(error, _)| error).collect(),
            worst,
            rms,
        }
    }
}

/// A difference over a force. Only a difference of 0 gives 0.
fn relative(difference: f64, force: f64) -> f64 {
    if difference == 0.0 {
        0.0
    } else {
        (difference / force).max(f64::from_bits(1))
    }
}

/// A sum of squares, as sum·scale², so that none leaves the floats.
#[derive(Clone, Copy, Default)]
struct Squares {
    scale: f64,
    sum: f64,
}

impl Squares {
    fn add(&mut self, x: f64) {
        *self = self.with(Self { scale: x, sum: 1.0 });
    }

    fn with(self, other: Self) -> Self {
        let scale = self.scale.max(other.scale);
        if scale == 0.0 || scale.is_infinite() {
            return Self { scale, sum: 1.0 };
        }
        let part = |part: Self| part.sum * (part.scale / scale) * (part.scale / scale);
        Self {
            scale,
            sum: part(self) + part(other),
        }
    }

    /// Each number over a force.
    fn over(self, force: f64) -> Self {
        Self {
            scale: relative(self.scale, force),
            ..self
        }
    }

    #[expect(clippy::cast_precision_loss, reason = "a count below 2^53")]
    fn root_of_mean(self, count: u64) -> f64 {
        if self.scale == 0.0 || count == 0 {
            return 0.0;
        }
        self.scale * (self.sum / count as f64).sqrt()
    }
}
