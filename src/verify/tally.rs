//! Contacts counted, and errors summed, while they go by.

use super::difference::{Difference, Extra, distance};
use super::exact::Exact;
use super::pairs::Pairs;
use super::{Comparison, Measured};
use crate::lattice::Dimension;
use crate::shape::Numbering;

/// How many missing and how many extra contacts are kept; all of them are counted.
const KEPT: usize = 1000;

/// What is known while contacts go by.
pub(super) struct Tally {
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
    pub(super) fn new(dimension: Dimension) -> Self {
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

    /// One more contact of the pile, with what was measured of it.
    pub(super) fn add(&mut self, exact: &Exact, measured: Option<Measured>) {
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
    pub(super) fn close(
        self,
        contacts: u64,
        pairs: &Pairs,
        numbering: &Numbering<'_>,
    ) -> Comparison {
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
