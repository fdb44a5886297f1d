//! Scalars with rational bounds, so that a value can be compared with the exact one.

use cannonpile::num_rational::BigRational;
use cannonpile::scalar::{DoubleDouble, FixedInteger, FixedRational, Interval};

/// Rational bounds of a value x: `lower ≤ x ≤ upper`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Enclosure {
    /// The greatest known lower bound.
    pub lower: BigRational,
    /// The least known upper bound.
    pub upper: BigRational,
}

impl Enclosure {
    /// The enclosure of a value that is known exactly.
    pub fn point(value: BigRational) -> Self {
        Self {
            lower: value.clone(),
            upper: value,
        }
    }

    /// Whether a value lies within the bounds.
    pub fn contains(&self, value: &BigRational) -> bool {
        self.lower <= *value && *value <= self.upper
    }
}

/// A scalar type whose values can be compared with rationals. For a rounded scalar the bounds are those of the *stored*
/// value.
pub trait Bounded {
    /// The tightest known rational bounds, or `None` for a value without finite bounds.
    fn enclosure(&self) -> Option<Enclosure>;

    /// The bounds in the form that [`laws::embedding`](cannonpile::scalar::laws::embedding) takes.
    fn bounds(&self) -> Option<[BigRational; 2]> {
        self.enclosure()
            .map(|Enclosure { lower, upper }| [lower, upper])
    }
}

macro_rules! exactly_known {
    ($([$($generics:tt)*] $scalar:ty: |$value:ident| $rational:expr;)*) => {$(
        impl<$($generics)*> Bounded for $scalar {
            fn enclosure(&self) -> Option<Enclosure> {
                let $value = self;
                $rational.map(Enclosure::point)
            }
        }
    )*};
}

exactly_known! {
    [] f32: |x| BigRational::from_float(*x);
    [] f64: |x| BigRational::from_float(*x);
    [] BigRational: |x| Some(x.clone());
    [] DoubleDouble: |x| x.to_rational();
    [I: FixedInteger] FixedRational<I>: |x| x.to_rational();
}

impl Bounded for Interval {
    fn enclosure(&self) -> Option<Enclosure> {
        let lower = BigRational::from_float(self.lower())?;
        let upper = BigRational::from_float(self.upper())?;
        Some(Enclosure { lower, upper })
    }
}
