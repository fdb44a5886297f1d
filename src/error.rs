//! What can be wrong with a question: one enum, each variant with the numbers and the remedy.

mod display;
mod named;

pub(crate) use named::named;

use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;

use exact_surd::short::quoted;
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::ToPrimitive;

use crate::engine::Method;
use crate::geometry::{LayerGap, Spacing};
use crate::lattice::{Dimension, Direction, Region, Site};

/// Why a pile, a site, a geometry or a number was refused.
///
/// The message is one line, names the value and says what would be accepted.
///
/// # Examples
/// ```
/// let error = cannonpile::Pile::triangular(0).unwrap_err();
/// assert_eq!(error.to_string(), "layers must be at least 1 and at most 10^36, not 0");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// The number of layers is not between 1 and [`MAX_LAYERS`](crate::lattice::MAX_LAYERS).
    #[non_exhaustive]
    Layers {
        /// The number asked for.
        given: BigInt,
    },
    /// sin φ is not strictly between 0 and 1.
    #[non_exhaustive]
    SinPhi {
        /// The value asked for.
        given: BigRational,
    },
    /// The pile has no such site.
    #[non_exhaustive]
    SiteOutside {
        /// The site asked for.
        site: Site,
        /// The layers of the pile.
        layers: i128,
        /// Discs or spheres.
        dimension: Dimension,
        /// The sites of that layer, if the pile has it and is not a straight one under one sphere.
        region: Option<Box<Region>>,
    },
    /// The pile has no such layer.
    #[non_exhaustive]
    LayerOutside {
        /// The layer asked for.
        layer: i128,
        /// The layers of the pile.
        layers: i128,
    },
    /// A contact below a sphere of the bottom layer: it rests on the floor.
    #[non_exhaustive]
    OnFloor {
        /// The sphere asked for.
        site: Site,
    },
    /// A force on the floor from a sphere that does not touch it.
    #[non_exhaustive]
    NotOnFloor {
        /// The sphere asked for.
        site: Site,
        /// The bottom layer.
        floor: i128,
    },
    /// A pile of discs has no contacts in this direction.
    #[non_exhaustive]
    NoSuchDirection {
        /// The direction asked for.
        direction: Direction,
    },
    /// A region of the lattice without a site.
    #[non_exhaustive]
    EmptyRegion {
        /// The region as it was asked for.
        region: Box<Region>,
    },
    /// A region whose coordinates leave ±10³⁶.
    #[non_exhaustive]
    RegionTooLarge {
        /// The region, or the one that was to grow.
        region: Box<Region>,
    },
    /// The side of a triangle or hexagon is not between 1 and 10³⁶.
    #[non_exhaustive]
    RegionSide {
        /// The side asked for.
        given: i128,
    },
    /// A run of a stacking has a negative length.
    #[non_exhaustive]
    RunLength {
        /// The length asked for.
        given: i128,
    },
    /// A stacking changes its sign too often to be kept.
    #[non_exhaustive]
    TooManyRuns {
        /// The most runs.
        limit: usize,
    },
    /// A stacking that is spelled out, and another number of layers.
    #[non_exhaustive]
    LayersOfStacking {
        /// The number of layers asked for.
        layers: i128,
        /// The layers of the stacking.
        spelled: i128,
    },
    /// No site is left on a base before all layers are there.
    #[non_exhaustive]
    TooHigh {
        /// The layers asked for.
        layers: i128,
        /// The most there are.
        greatest: i128,
        /// The base.
        base: Box<Region>,
    },
    /// A weight or load that is negative.
    #[non_exhaustive]
    NegativeLoad {
        /// `load` or `weight`.
        quantity: &'static str,
        /// The sphere.
        site: Site,
        /// The value asked for.
        given: Box<BigRational>,
    },
    /// A method that does not apply: closed forms are of straight stackings, sweeps of spheres and not of discs.
    #[non_exhaustive]
    NoSuchMethod {
        /// The method asked for.
        method: Method,
    },
    /// A sphere that is not of the layer asked.
    #[non_exhaustive]
    OtherLayer {
        /// The layer of the sphere.
        layer: i128,
        /// The layer that was asked.
        at: i128,
    },
    /// A slice that does not have one place for each force.
    #[non_exhaustive]
    Length {
        /// How many forces there are.
        needed: usize,
        /// How many places.
        given: usize,
    },
    /// An answer that would take more memory than is sensible.
    #[non_exhaustive]
    TooLarge {
        /// What would be computed.
        quantity: &'static str,
        /// How many numbers it would keep.
        needed: BigUint,
        /// How many are allowed; fewer than in all where the process may not have the memory.
        limit: u64,
        /// The narrower question.
        remedy: &'static str,
    },
    /// A length, mass, gravity or spacing that is not positive.
    #[non_exhaustive]
    NotPositive {
        /// What it is.
        quantity: &'static str,
        /// The value asked for.
        given: BigRational,
    },
    /// Spheres would overlap at this spacing.
    #[non_exhaustive]
    Overlap {
        /// The spacing asked for.
        spacing: Box<Spacing>,
        /// Which spheres overlap.
        apart: LayerGap,
        /// The least and the greatest spacing allowed, where there is one.
        allowed: Box<(Option<Spacing>, Option<Spacing>)>,
    },
    /// The contacts would be horizontal, or no contacts at all.
    #[non_exhaustive]
    TooFlat {
        /// The spacing asked for.
        spacing: Box<Spacing>,
        /// What it must stay below.
        limit: Box<Spacing>,
    },
    /// No spacing at all keeps the spheres of this pile apart.
    #[non_exhaustive]
    NoSpacing {
        /// sin φ of the pile.
        sin_phi: BigRational,
        /// The layers of the pile.
        layers: i128,
    },
    /// An answer does not fit the number type asked for.
    #[non_exhaustive]
    Overflow {
        /// What was asked for.
        quantity: &'static str,
        /// The number type.
        scalar: &'static str,
    },
    /// What is wrong with a number by itself.
    Number(exact_surd::Error),
    /// A text that is not what was expected.
    #[non_exhaustive]
    Syntax {
        /// The text, shortened if it is long.
        text: String,
        /// What was expected, with an example.
        expected: &'static str,
    },
    /// A long stacking with a character that does not belong there.
    #[non_exhaustive]
    Misspelled {
        /// The stacking, shortened.
        text: String,
        /// The place of the character, counted from 1.
        position: usize,
        /// The character, or `None` if the stacking ends too early.
        found: Option<char>,
    },
    /// More rows than anybody can read.
    #[non_exhaustive]
    TooManyRows {
        /// How many there would be.
        rows: BigUint,
        /// How many are allowed.
        limit: u64,
        /// The narrower question.
        remedy: &'static str,
    },
    /// Horizontal contacts of a pile whose neighbours do not all touch at a = R.
    #[non_exhaustive]
    NoHorizontalContacts {
        /// sin φ of the pile.
        sin_phi: BigRational,
    },
    /// A spacing at which the neighbours of a layer do not touch, and that was given.
    #[non_exhaustive]
    NotTouching {
        /// The spacing.
        spacing: Spacing,
    },
    /// Work that was asked to end, by an `Interrupt`.
    Interrupted,
    /// Something that cannot be, by the named invariant: a fault of this library and of no input.
    #[non_exhaustive]
    Bug {
        /// What was to hold, and does not.
        invariant: &'static str,
    },
}

/// Returns the error for a case that `invariant` rules out; where debug assertions are on, it panics instead.
///
/// It stands where a default would be a wrong answer: `value.ok_or_else(|| bug("a bottom sphere rests on the floor"))?`.
#[cold]
#[track_caller]
#[must_use]
pub fn bug(invariant: &'static str) -> Error {
    debug_assert!(false, "broken invariant: {invariant}");
    Error::Bug { invariant }
}

/// Refuses more than a limit.
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

/// Refuses to keep more than `limit` numbers, and numbers of so many bytes each that this process may not have the memory:
/// the allocator is asked for all of it at once, beforehand, and gets it back untouched.
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
    while allowed > 0 && !is_to_be_had(allowed, bytes) {
        allowed /= 2;
    }
    if Some(allowed) < few {
        return Err(refused(allowed));
    }
    Ok(())
}

/// So many copies of a value, where there is room for them.
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

/// Whether the allocator gives so many numbers of so many bytes.
fn is_to_be_had(numbers: u64, bytes: usize) -> bool {
    let mut memory = Vec::<u8>::new();
    let bytes = usize::try_from(numbers)
        .ok()
        .and_then(|numbers| numbers.checked_mul(bytes));
    let had = bytes.is_some_and(|bytes| memory.try_reserve_exact(bytes).is_ok());
    // What nobody looks at is not asked for by optimised code.
    core::hint::black_box(&memory);
    had
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

    /// A syntax error that quotes `text`, shortened if it is long.
    #[doc(hidden)]
    #[must_use]
    pub fn syntax(text: &str, expected: &'static str) -> Self {
        Self::Syntax {
            text: quoted(text),
            expected,
        }
    }
}

/// Errors of the core that the crates beside it report too.
#[doc(hidden)]
impl Error {
    #[must_use]
    pub fn layers(given: BigInt) -> Self {
        Self::Layers { given }
    }

    #[must_use]
    pub fn layer_outside(layer: i128, layers: i128) -> Self {
        Self::LayerOutside { layer, layers }
    }

    #[must_use]
    pub fn site_outside(
        site: Site,
        layers: i128,
        dimension: Dimension,
        region: Option<Region>,
    ) -> Self {
        Self::SiteOutside {
            site,
            layers,
            dimension,
            region: region.map(Box::new),
        }
    }

    #[must_use]
    pub fn on_floor(site: Site) -> Self {
        Self::OnFloor { site }
    }

    #[must_use]
    pub fn not_on_floor(site: Site, floor: i128) -> Self {
        Self::NotOnFloor { site, floor }
    }

    #[must_use]
    pub fn negative_load(quantity: &'static str, site: Site, given: BigRational) -> Self {
        Self::NegativeLoad {
            quantity,
            site,
            given: Box::new(given),
        }
    }

    #[must_use]
    pub fn not_positive(quantity: &'static str, given: BigRational) -> Self {
        Self::NotPositive { quantity, given }
    }

    #[must_use]
    pub fn not_touching(spacing: Spacing) -> Self {
        Self::NotTouching { spacing }
    }

    #[must_use]
    pub fn length(needed: usize, given: usize) -> Self {
        Self::Length { needed, given }
    }

    #[must_use]
    pub fn overflow(quantity: &'static str, scalar: &'static str) -> Self {
        Self::Overflow { quantity, scalar }
    }

    #[must_use]
    pub fn too_large(
        quantity: &'static str,
        needed: BigUint,
        limit: u64,
        remedy: &'static str,
    ) -> Self {
        Self::TooLarge {
            quantity,
            needed,
            limit,
            remedy,
        }
    }

    #[must_use]
    pub fn too_many_rows(rows: BigUint, limit: u64, remedy: &'static str) -> Self {
        Self::TooManyRows {
            rows,
            limit,
            remedy,
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

    /// More bytes than addresses, and some that are to be had: the limit that is named has room.
    #[test]
    fn what_no_memory_holds_is_refused() {
        let refused = |needed: u64, bytes| {
            let needed = BigUint::from(needed);
            refuse_beyond_memory("numbers", &needed, (u64::MAX, bytes), "use fewer")
        };
        for (needed, bytes) in [(1 << 62, 1), (1 << 59, 8), (1 << 63, 16)] {
            let Err(Error::TooLarge { limit, .. }) = refused(needed, bytes) else {
                panic!("{needed} of {bytes} bytes are not to be had");
            };
            assert!(0 < limit && limit < needed, "{limit}");
            // Others may take some meanwhile.
            assert_eq!(refused(limit / 2, bytes), Ok(()));
        }
        assert_eq!(refused(0, 8), Ok(()));
        assert_eq!(refused(1000, 8), Ok(()));
        assert_eq!(copies(7_u64, 3, "numbers"), Ok(alloc::vec![7; 3]));
        // A process with 32-bit addresses may have room for every byte that it can address.
        let addressable = cfg!(target_pointer_width = "64").then_some(isize::MAX as usize / 8);
        for many in [usize::MAX].into_iter().chain(addressable) {
            let none = copies(7_u64, many, "numbers");
            assert!(matches!(none, Err(Error::TooLarge { .. })), "{many}");
        }
    }
}
