//! The error type of the crate. Each variant has the refused value and the data for a remedy.

mod display;
mod named;

pub(crate) use named::named;

use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;

use exact_surd::short::quoted;
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive};

use crate::engine::Method;
use crate::geometry::{LayerGap, Spacing};
use crate::lattice::{Dimension, Direction, Region, Site};
use crate::scalar::reduced;

/// An error about a pile, a site, a geometry or a number.
///
/// The message is one line. It names the given value and the accepted ones.
///
/// # Examples
/// ```
/// let error = cannonpile::Pile::triangular(0).unwrap_err();
/// assert_eq!(error.to_string(), "layers must be at least 1 and at most 10^36, not 0");
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Error {
    /// The number of layers is not between 1 and [`MAX_LAYERS`](crate::lattice::MAX_LAYERS).
    Layers {
        /// The given number.
        given: BigInt,
    },
    /// sin φ is not strictly between 0 and 1.
    SinPhi {
        /// The given value.
        given: BigRational,
    },
    /// The pile has no such site.
    SiteOutside {
        /// The given site.
        site: Site,
        /// The number of layers of the pile.
        layers: i128,
        /// Discs or spheres.
        dimension: Dimension,
        /// The sites of that layer. `None` if the pile has no such layer, or if it is straight and under one sphere.
        region: Option<Box<Region>>,
    },
    /// The pile has no such layer.
    LayerOutside {
        /// The given layer.
        layer: i128,
        /// The number of layers of the pile.
        layers: i128,
    },
    /// A contact below a sphere of the bottom layer, which is on the floor.
    OnFloor {
        /// The given sphere.
        site: Site,
    },
    /// A force on the floor from a sphere that does not touch it.
    NotOnFloor {
        /// The given sphere.
        site: Site,
        /// The bottom layer.
        floor: i128,
    },
    /// A direction without contacts in a pile of discs.
    NoSuchDirection {
        /// The given direction.
        direction: Direction,
    },
    /// A region of the lattice without a site.
    EmptyRegion {
        /// The given region.
        region: Box<Region>,
    },
    /// A region with coordinates beyond ±10³⁶.
    RegionTooLarge {
        /// The given region, or the region that would grow beyond the limit.
        region: Box<Region>,
    },
    /// The side of a triangle or hexagon is not between 1 and 10³⁶.
    RegionSide {
        /// The given side.
        given: i128,
    },
    /// A run of a stacking has a negative length.
    RunLength {
        /// The given length.
        given: i128,
    },
    /// A stacking has too many sign changes.
    TooManyRuns {
        /// The largest number of runs.
        limit: usize,
    },
    /// The given number of layers differs from that of the stacking.
    LayersOfStacking {
        /// The given number of layers.
        layers: i128,
        /// The number of layers of the stacking.
        spelled: i128,
    },
    /// A base does not support the given number of layers.
    TooHigh {
        /// The given number of layers.
        layers: i128,
        /// The largest number of layers on this base.
        greatest: i128,
        /// The base.
        base: Box<Region>,
    },
    /// A weight, load or horizontal force is negative.
    NegativeLoad {
        /// `load`, `weight` or `horizontal force`.
        quantity: &'static str,
        /// The sphere.
        site: Site,
        /// The given value.
        given: Box<BigRational>,
    },
    /// A force on discs that points out of their plane.
    OutOfPlane {
        /// `load` or `tilt`.
        quantity: &'static str,
    },
    /// A method that does not apply. Closed forms need a straight stacking, and sweeps need spheres instead of discs.
    NoSuchMethod {
        /// The given method.
        method: Method,
    },
    /// A sphere of another layer.
    OtherLayer {
        /// The layer of the sphere.
        layer: i128,
        /// The layer of the query.
        at: i128,
    },
    /// A slice whose length differs from the number of forces.
    Length {
        /// The number of forces.
        needed: usize,
        /// The length of the slice.
        given: usize,
    },
    /// A result that needs more memory than the limit.
    TooLarge {
        /// The quantity to compute.
        quantity: &'static str,
        /// The number of values to store.
        needed: BigUint,
        /// The largest number allowed. It is lower if the process cannot allocate the memory.
        limit: u64,
        /// A smaller request.
        remedy: &'static str,
    },
    /// A length, mass, gravity or spacing that is not positive.
    NotPositive {
        /// The name of the quantity.
        quantity: &'static str,
        /// The given value.
        given: BigRational,
    },
    /// Spheres would overlap at this spacing.
    Overlap {
        /// The given spacing.
        spacing: Box<Spacing>,
        /// The pairs of spheres that overlap.
        apart: LayerGap,
        /// The smallest and the largest spacing allowed, if they exist.
        allowed: Box<(Option<Spacing>, Option<Spacing>)>,
    },
    /// A spacing at which the contacts would be horizontal or the spheres would not touch.
    TooFlat {
        /// The given spacing.
        spacing: Box<Spacing>,
        /// The upper limit, which is excluded.
        limit: Box<Spacing>,
    },
    /// No spacing keeps the spheres of this pile from overlapping.
    NoSpacing {
        /// sin φ of the pile.
        sin_phi: BigRational,
        /// The number of layers of the pile.
        layers: i128,
    },
    /// A result does not fit in the requested number type.
    Overflow {
        /// The quantity that overflows.
        quantity: &'static str,
        /// The number type.
        scalar: &'static str,
    },
    /// An error about a single number.
    Number(exact_surd::Error),
    /// A text with a syntax error.
    Syntax {
        /// The text, shortened if it is long.
        text: String,
        /// The expected form, with an example.
        expected: &'static str,
    },
    /// A long stacking with a misplaced character.
    Misspelled {
        /// The stacking, shortened.
        text: String,
        /// The position of the character, counted from 1.
        position: usize,
        /// The character, or `None` if the stacking ends too early.
        found: Option<char>,
    },
    /// A table with too many rows.
    TooManyRows {
        /// The number of rows.
        rows: BigUint,
        /// The largest number allowed.
        limit: u64,
        /// A smaller request.
        remedy: &'static str,
    },
    /// Horizontal contacts in a pile whose neighbours in a layer do not all touch at a = R.
    NoHorizontalContacts {
        /// sin φ of the pile.
        sin_phi: BigRational,
    },
    /// A given spacing at which neighbours in a layer do not touch.
    NotTouching {
        /// The given spacing.
        spacing: Spacing,
    },
    /// The work was cancelled by an `Interrupt`.
    Interrupted,
    /// A broken invariant: a bug of this library.
    Bug {
        /// The broken invariant.
        invariant: &'static str,
    },
}

exact_surd::equality!(Error);

/// Returns the error for a broken `invariant`. If debug assertions are on, it panics instead.
///
/// Use it where a default would be a wrong result: `value.ok_or_else(|| bug("a bottom sphere is on the floor"))?`.
#[cold]
#[track_caller]
#[must_use]
pub fn bug(invariant: &'static str) -> Error {
    debug_assert!(false, "broken invariant: {invariant}");
    Error::Bug { invariant }
}

/// Returns the value in lowest terms.
///
/// # Errors
/// [`Error::NotPositive`].
pub fn positive(quantity: &'static str, value: BigRational) -> Result<BigRational, Error> {
    let given = reduced(value);
    if given.is_positive() {
        return Ok(given);
    }
    Err(Error::NotPositive { quantity, given })
}

/// Returns the value for a sphere, in lowest terms.
///
/// # Errors
/// [`Error::NegativeLoad`].
pub fn not_negative(
    quantity: &'static str,
    site: Site,
    value: BigRational,
) -> Result<BigRational, Error> {
    let value = reduced(value);
    if !value.is_negative() {
        return Ok(value);
    }
    let given = Box::new(value);
    Err(Error::NegativeLoad {
        quantity,
        site,
        given,
    })
}

/// Returns an error if `needed` exceeds `limit`.
///
/// # Errors
/// [`Error::TooLarge`].
pub fn refuse_beyond(
    quantity: &'static str,
    needed: impl Into<BigUint>,
    limit: u64,
    remedy: &'static str,
) -> Result<(), Error> {
    let needed = needed.into();
    if needed > BigUint::from(limit) {
        return Err(Error::TooLarge {
            quantity,
            needed,
            limit,
            remedy,
        });
    }
    Ok(())
}

/// Returns an error if `needed` exceeds `limit`, or if the process cannot allocate `needed` numbers of `bytes` bytes
/// each.
///
/// The check allocates all the memory in one piece, and frees it without writing to it.
///
/// # Errors
/// [`Error::TooLarge`].
pub fn refuse_beyond_memory(
    quantity: &'static str,
    needed: &BigUint,
    (limit, bytes): (u64, usize),
    remedy: &'static str,
) -> Result<(), Error> {
    let refused = |limit| Error::TooLarge {
        quantity,
        needed: needed.clone(),
        limit,
        remedy,
    };
    let few = needed.to_u64().filter(|numbers| *numbers <= limit);
    let mut allowed = few.ok_or_else(|| refused(limit))?;
    while allowed > 0 && !is_available(allowed, bytes) {
        allowed /= 2;
    }
    if Some(allowed) < few {
        return Err(refused(allowed));
    }
    Ok(())
}

/// Returns `count` copies of a value, or an error if they do not fit in memory.
///
/// # Errors
/// [`Error::TooLarge`].
pub fn copies<T: Clone>(value: T, count: usize, quantity: &'static str) -> Result<Vec<T>, Error> {
    let bytes = size_of::<T>().max(1);
    refuse_beyond_memory(
        quantity,
        &count.into(),
        (isize::MAX as u64 / bytes as u64, bytes),
        "use fewer layers, or a smaller top or base",
    )?;
    Ok(alloc::vec![value; count])
}

/// Returns whether the allocator provides the memory for `numbers` numbers of `bytes` bytes each.
fn is_available(numbers: u64, bytes: usize) -> bool {
    let mut memory = Vec::<u8>::new();
    let bytes = usize::try_from(numbers)
        .ok()
        .and_then(|numbers| numbers.checked_mul(bytes));
    let available = bytes.is_some_and(|bytes| memory.try_reserve_exact(bytes).is_ok());
    // Without this use, the optimiser may remove the allocation.
    core::hint::black_box(&memory);
    available
}

impl Error {
    pub(crate) fn overlap(
        spacing: &Spacing,
        apart: LayerGap,
        allowed: (Option<Spacing>, Option<Spacing>),
    ) -> Self {
        Self::Overlap {
            spacing: Box::new(spacing.clone()),
            apart,
            allowed: Box::new(allowed),
        }
    }

    /// Returns the error for a result that does not fit in a number type.
    #[doc(hidden)]
    #[must_use]
    pub fn overflow(quantity: &'static str, scalar: &'static str) -> Self {
        Self::Overflow { quantity, scalar }
    }

    /// Returns a syntax error that quotes `text`, shortened if it is long.
    #[doc(hidden)]
    #[must_use]
    pub fn syntax(text: &str, expected: &'static str) -> Self {
        Self::Syntax {
            text: quoted(text),
            expected,
        }
    }
}

impl From<exact_surd::Error> for Error {
    fn from(error: exact_surd::Error) -> Self {
        Self::Number(error)
    }
}

impl core::error::Error for Error {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_beyond_a_limit_is_refused() {
        let refused = |needed: u64| refuse_beyond("spheres", needed, 10, "use fewer");
        assert_eq!([refused(0), refused(10)], [Ok(()), Ok(())]);
        for needed in [11, u64::MAX] {
            assert_eq!(
                refused(needed),
                Err(Error::TooLarge {
                    quantity: "spheres",
                    needed: needed.into(),
                    limit: 10,
                    remedy: "use fewer",
                })
            );
        }
    }

    /// Requests beyond the address space are refused, and so are some within it. The reported limit is available.
    #[test]
    fn what_no_memory_holds_is_refused() {
        let refused = |needed: u64, bytes| {
            let needed = BigUint::from(needed);
            refuse_beyond_memory("numbers", &needed, (u64::MAX, bytes), "use fewer")
        };
        for (needed, bytes) in [(1 << 62, 1), (1 << 59, 8), (1 << 63, 16)] {
            let Err(Error::TooLarge { limit, .. }) = refused(needed, bytes) else {
                panic!("{needed} of {bytes} bytes are not available");
            };
            assert!(0 < limit && limit < needed, "{limit}");
            // Other processes may take some of the memory in the meantime.
            assert_eq!(refused(limit / 2, bytes), Ok(()));
        }
        assert_eq!(refused(0, 8), Ok(()));
        assert_eq!(refused(1000, 8), Ok(()));
        assert_eq!(copies(7_u64, 3, "numbers"), Ok(alloc::vec![7; 3]));
        // With 32-bit addresses, a process may have room for every byte that it can address.
        let addressable = cfg!(target_pointer_width = "64").then_some(isize::MAX as usize / 8);
        for many in [usize::MAX].into_iter().chain(addressable) {
            let none = copies(7_u64, many, "numbers");
            assert!(matches!(none, Err(Error::TooLarge { .. })), "{many}");
        }
    }
}
