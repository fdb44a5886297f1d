//! The spacing a/R: the distance between neighbours in a layer over the diameter of a sphere.

use core::fmt;
use core::str::FromStr;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero;

use crate::Error;
use crate::error::positive;
use crate::scalar::{ByValue, Surd};

/// The spacing a/R: the distance 2a between horizontal neighbours over the diameter 2R. It is positive, and its square
/// q is rational.
///
/// The spacings without overlap depend on the pile: see [`Clearance`](super::Clearance).
///
/// # Examples
/// ```
/// use cannonpile::geometry::Spacing;
/// use cannonpile::ratio;
///
/// assert_eq!(Spacing::new(ratio!(6/5))?.square(), &ratio!(36/25));
/// // The bound √(8/3) of a tall pile is irrational, but its square is rational.
/// assert_eq!(Spacing::from_square(ratio!(8/3))?.to_string(), "2/3*sqrt(6)");
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Spacing {
    square: BigRational,
}

exact_surd::equality!(Hash for Spacing; |Self { square }| ByValue(square));

impl Spacing {
    /// Returns the spacing a/R.
    ///
    /// # Errors
    /// [`Error::NotPositive`] unless it is positive.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Error;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::ratio;
    ///
    /// assert_eq!(Spacing::new(ratio!(6/5))?.to_string(), "6/5");
    /// assert!(matches!(Spacing::new(ratio!(-6/5)), Err(Error::NotPositive { .. })));
    /// # Ok::<(), Error>(())
    /// ```
    pub fn new(ratio: BigRational) -> Result<Self, Error> {
        let ratio = positive("spacing", ratio)?;
        Ok(Self {
            square: &ratio * &ratio,
        })
    }

    /// Returns the spacing √q.
    ///
    /// # Errors
    /// [`Error::NotPositive`] unless q is positive.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Error;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::ratio;
    ///
    /// assert_eq!(Spacing::from_square(ratio!(36/25))?, Spacing::new(ratio!(6/5))?);
    /// assert_eq!(Spacing::from_square(ratio!(8/3))?.to_string(), "2/3*sqrt(6)");
    /// assert!(matches!(Spacing::from_square(ratio!(0)), Err(Error::NotPositive { .. })));
    /// # Ok::<(), Error>(())
    /// ```
    pub fn from_square(square: BigRational) -> Result<Self, Error> {
        let square = positive("spacing", square)?;
        Ok(Self { square })
    }

    /// Returns q = (a/R)².
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::ratio;
    ///
    /// assert_eq!(Spacing::new(ratio!(6/5))?.square(), &ratio!(36/25));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn square(&self) -> &BigRational {
        &self.square
    }

    /// Returns a/R.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::ratio;
    ///
    /// assert_eq!(Spacing::new(ratio!(6/5))?.ratio().to_rational(), Some(ratio!(6/5)));
    /// assert_eq!(Spacing::from_square(ratio!(2))?.ratio().to_string(), "sqrt(2)");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn ratio(&self) -> Surd {
        Surd::root_of(self.square.clone())
    }

    /// Returns a/R in millionths, rounded down, and whether this value is exact.
    pub(crate) fn millionths(&self) -> (BigInt, bool) {
        let scaled = &self.square * BigRational::from_integer(1_000_000_000_000_i64.into());
        let root = scaled.to_integer().sqrt();
        let exact = BigRational::from_integer(&root * &root) == scaled;
        (root, exact)
    }
}

impl fmt::Display for Spacing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.ratio().fmt(f)
    }
}

impl FromStr for Spacing {
    type Err = Error;

    /// Parses a/R: `6/5`, `1.2`, `2/3*sqrt(6)`.
    ///
    /// # Errors
    /// [`Error::Syntax`]; [`Error::NotPositive`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    ///
    /// let spacing: Spacing = "1.2".parse()?;
    /// assert_eq!(spacing.to_string(), "6/5");
    /// assert_eq!("2/3*sqrt(6)".parse::<Spacing>()?.square().to_string(), "8/3");
    /// assert!("0".parse::<Spacing>().is_err());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    fn from_str(text: &str) -> Result<Self, Error> {
        let ratio: Surd = text.parse()?;
        let spacing = match (ratio.to_rational(), ratio.sign()) {
            (Some(rational), _) => Self::new(rational),
            (None, num_bigint::Sign::Plus) => Self::from_square(ratio.square()),
            (None, _) => Err(Error::syntax(text, "a spacing: it must be positive")),
        }?;
        // The root is extracted again and may have another square factor, so its length is checked too.
        spacing.ratio().if_short(text)?;
        Ok(spacing)
    }
}

#[cfg(feature = "serde")]
crate::data::as_text!(Spacing);

/// A bound on the spacing, printed exactly and as a decimal, such as `2/3*sqrt(6) = 1.632993…` or `1`. The decimal
/// satisfies the bound too.
pub(crate) struct Bound<'a> {
    pub(crate) spacing: &'a Spacing,
    /// True for a lower bound, whose decimal is rounded up.
    pub(crate) up: bool,
}

impl fmt::Display for Bound<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (down, exact) = self.spacing.millionths();
        let decimal = down + u32::from(self.up && !exact);
        let million = BigInt::from(1_000_000);
        let (whole, rest) = (&decimal / &million, &decimal % &million);
        write!(f, "{}", self.spacing)?;
        match (exact, rest.is_zero()) {
            (true, true) => Ok(()),
            (true, false) => write!(f, " = {whole}.{rest:06}"),
            (false, _) if self.up => write!(f, ", just below {whole}.{rest:06}"),
            (false, _) => write!(f, " = {whole}.{rest:06}…"),
        }
    }
}

#[cfg(test)]
mod tests {
    use alloc::format;

    use super::*;
    use crate::geometry::LayerGap;
    use crate::ratio;

    #[test]
    fn width_fill_and_sign_are_honoured() {
        let spacing = Spacing::from_square(ratio!(8 / 3)).unwrap();
        assert_eq!(format!("{spacing:>13}|"), "  2/3*sqrt(6)|");
        assert_eq!(format!("{spacing:*<13}"), "2/3*sqrt(6)**");
        assert_eq!(format!("{spacing:+}"), "+2/3*sqrt(6)");
        assert_eq!(
            format!("{:^14}|", LayerGap { layers: 0 }),
            " in one layer |"
        );
        assert_eq!(format!("{:>15}", LayerGap { layers: 2 }), " 2 layers apart");
    }
}
