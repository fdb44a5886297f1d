//! Random stackings: their number, and the registry of their bottom layers.

use core::fmt;
use core::str::FromStr;

use cannonpile::engine::refuse_beyond;
use cannonpile::lattice::Sign;
use cannonpile::scalar::Algebra;
use cannonpile::stacking::Stacking;
use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::Error;
use crate::formula;
use crate::{Each, THREE, TWO};

/// The sign of the first step, from the top layer to the one below.
///
/// # Examples
/// ```
/// use cannonpile_disorder::FirstSign;
///
/// assert_eq!("random".parse(), Ok(FirstSign::Random));
/// assert_eq!(FirstSign::Minus.to_string(), "-");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FirstSign {
    /// + in every stacking.
    Plus,
    /// − in every stacking.
    Minus,
    /// + or −, each with probability ½.
    Random,
}

impl FirstSign {
    /// Returns `+`, `-` or `random`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::FirstSign;
    ///
    /// assert_eq!(FirstSign::Random.name(), "random");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Plus => "+",
            Self::Minus => "-",
            Self::Random => "random",
        }
    }

    /// Returns the possible first signs.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::FirstSign;
    /// use cannonpile::lattice::Sign;
    ///
    /// assert_eq!(FirstSign::Minus.signs(), [Sign::Minus]);
    /// assert_eq!(FirstSign::Random.signs(), [Sign::Plus, Sign::Minus]);
    /// ```
    #[must_use]
    pub const fn signs(self) -> &'static [Sign] {
        match self {
            Self::Plus => &[Sign::Plus],
            Self::Minus => &[Sign::Minus],
            Self::Random => &[Sign::Plus, Sign::Minus],
        }
    }
}

impl fmt::Display for FirstSign {
    /// Prints `+`, `-` or `random`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for FirstSign {
    type Err = Error;

    /// Parses the output of [`name`](Self::name).
    ///
    /// # Errors
    /// [`Syntax`](cannonpile::Error::Syntax).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::FirstSign;
    ///
    /// assert_eq!("+".parse::<FirstSign>()?, FirstSign::Plus);
    /// assert!("?".parse::<FirstSign>().is_err());
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    fn from_str(text: &str) -> Result<Self, Error> {
        let all = [Self::Plus, Self::Minus, Self::Random];
        let found = all.into_iter().find(|found| found.name() == text);
        found.ok_or_else(|| Error::syntax(text, "the first sign: +, - or random"))
    }
}

/// All stackings of L layers, with their probabilities.
///
/// A stacking has n = L − 1 signs. The first is given, or is + or − with probability ½. Each later sign differs from
/// the previous one with the fault probability q, 0 ≤ q ≤ 1, independently. A sign change is a fault. So a stacking
/// with d faults has the probability q^d (1−q)^(n−1−d), or half of it for a random first sign. FCC has q = 0 and HCP
/// has q = 1. At q = ½ all stackings are equally likely. Reading the signs from the base upwards yields the same
/// ensemble.
///
/// # Examples
/// ```
/// use cannonpile_disorder::{FirstSign, RandomStackings};
///
/// let stackings = RandomStackings::new(5, FirstSign::Plus)?;
/// assert_eq!((stackings.layers(), stackings.first()), (5, FirstSign::Plus));
/// # Ok::<(), cannonpile_disorder::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct RandomStackings {
    layers: i128,
    first: FirstSign,
}

/// The largest number of layers for probabilities of registries and for moments. The cost is proportional to the number
/// of layers.
pub(super) const MAX_RANDOM_LAYERS: u64 = 10_000;

/// The limit of the smaller of two numbers, faults and unchanged signs, in a count of stackings. The cost of a count is
/// proportional to the smaller number.
const MAX_FAULTS: u64 = 10_000;

impl RandomStackings {
    /// Returns the stackings of this number of layers.
    ///
    /// # Errors
    /// [`Layers`](cannonpile::Error::Layers) unless 1 ≤ `layers` ≤ [`MAX_LAYERS`](cannonpile::lattice::MAX_LAYERS).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomStackings};
    ///
    /// assert!(RandomStackings::new(10_i128.pow(36), FirstSign::Random).is_ok());
    /// assert!(RandomStackings::new(0, FirstSign::Random).is_err());
    /// ```
    pub fn new(layers: i128, first: FirstSign) -> Result<Self, Error> {
        // `Stacking::fcc` rejects an invalid number of layers.
        Stacking::fcc(layers)?;
        Ok(Self { layers, first })
    }

    /// Returns the number L of layers.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomStackings};
    ///
    /// assert_eq!(RandomStackings::new(3, FirstSign::Plus)?.layers(), 3);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub const fn layers(&self) -> i128 {
        self.layers
    }

    /// Returns the sign of the first step.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomStackings};
    ///
    /// assert_eq!(RandomStackings::new(3, FirstSign::Minus)?.first(), FirstSign::Minus);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub const fn first(&self) -> FirstSign {
        self.first
    }

    /// Returns the number of steps, n = L − 1.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomStackings};
    ///
    /// assert_eq!(RandomStackings::new(3, FirstSign::Plus)?.steps(), 2);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub const fn steps(&self) -> i128 {
        self.layers - 1
    }

    /// Returns the greatest number of faults: n − 1, or 0 for one layer.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomStackings};
    ///
    /// let most = |layers| RandomStackings::new(layers, FirstSign::Plus).map(|all| all.most_faults());
    /// assert_eq!([most(5)?, most(2)?, most(1)?], [3, 0, 0]);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub const fn most_faults(&self) -> i128 {
        if self.layers > 2 { self.layers - 2 } else { 0 }
    }

    /// Returns the number of stackings with `faults` sign changes: C(n−1, faults), or twice that for a random first
    /// sign.
    ///
    /// A single layer has no sign, and counts as one stacking. The cost is proportional to the smaller of two numbers:
    /// the faults and the unchanged signs.
    ///
    /// # Errors
    /// [`TooLarge`](cannonpile::Error::TooLarge) if both numbers exceed 10⁴. With 10³⁶ layers the result would have
    /// more than a million bits.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomStackings};
    ///
    /// let stackings = RandomStackings::new(6, FirstSign::Plus)?;
    /// for (faults, count) in (0..).zip([1_u32, 4, 6, 4, 1, 0]) {
    ///     assert_eq!(stackings.count_with(faults)?, count.into());
    /// }
    /// let random = RandomStackings::new(6, FirstSign::Random)?;
    /// assert_eq!(random.count_with(2)?, 12_u32.into());
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn count_with(&self, faults: u32) -> Result<BigUint, Error> {
        let unchanged = self.most_faults() - i128::from(faults);
        if unchanged < 0 {
            return Ok(BigUint::zero());
        }
        let fewer = unchanged.min(faults.into()).unsigned_abs();
        refuse_beyond(
            "the number of stackings with so many faults",
            fewer,
            MAX_FAULTS,
            "use fewer faults, or so many that few signs stay unchanged",
        )?;
        let of = self.most_faults().unsigned_abs();
        // C(of, t + 1) = C(of, t)·(of − t)/(t + 1).
        let next = |stackings: BigUint, t| stackings * (of - t) / (t + 1);
        Ok((0..fewer).fold(self.first_signs().len().into(), next))
    }

    /// Returns the possible first signs, which are equally likely. A single layer counts as one stacking.
    pub(super) const fn first_signs(&self) -> &'static [Sign] {
        if self.layers == 1 {
            FirstSign::Plus.signs()
        } else {
            self.first.signs()
        }
    }

    /// Returns the probabilities of the registries 0, 1 and 2 of the bottom layer at the fault probability `q`. The
    /// registry is s modulo 3, with s the number of + steps minus the number of − steps.
    ///
    /// In each registry the excess x_n of the probability over ⅓ obeys x_(n+1) = −(1−q) x_n − (1−2q) x_(n−1), with n
    /// the number of steps ([`registry_excess`](formula::registry_excess), theorem `registry`). So it decays like λⁿ,
    /// with λ the root of λ² + (1−q)λ + 1−2q of larger modulus. For 0 < q < 2√3 − 3 the roots are complex, and |λ| =
    /// √(1−2q).
    ///
    /// # Errors
    /// [`TooLarge`](cannonpile::Error::TooLarge) for more than 10⁴ layers.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomStackings};
    ///
    /// use cannonpile::scalar::{Polynomial, Symbol};
    ///
    /// // The stacking ++ ends in registry 2, and +- in registry 0.
    /// let stackings = RandomStackings::new(3, FirstSign::Plus)?;
    /// let registry = stackings.registry(&Polynomial::from(Symbol("q")))?;
    /// assert_eq!(registry.map(|p| p.to_string()), ["q", "0", "-q + 1"]);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn registry<T: Algebra>(&self, q: &T) -> Result<[T; 3], Error> {
        refuse_beyond(
            "the probabilities of the registries of random stackings",
            self.layers.unsigned_abs(),
            MAX_RANDOM_LAYERS,
            "use fewer layers",
        )?;
        let third = T::one().div_int(THREE);
        let [none, all, half] = [
            -third.clone(),
            T::one() - &third,
            T::one().div_int(TWO) - &third,
        ];
        // The excess over ⅓ before and after the first step.
        let mut before = [all.clone(), none.clone(), none.clone()];
        let mut after = match self.first {
            FirstSign::Plus => [none.clone(), all, none],
            FirstSign::Minus => [none.clone(), none, all],
            FirstSign::Random => [none, half.clone(), half],
        };
        for _ in 0..self.steps() {
            let next = [0, 1, 2].each(|registry: usize| {
                formula::registry_excess(&before[registry], &after[registry], q)
            });
            (before, after) = (after, next);
        }
        Ok(before.each(|deviation| deviation + &third))
    }
}

/// Returns an error unless `q` is a probability, 0 ≤ `q` ≤ 1.
///
/// # Errors
/// [`Error::FaultProbability`].
///
/// # Examples
/// ```
/// use cannonpile_disorder::check_fault_probability;
/// use num_rational::BigRational;
///
/// let ratio = |n: i32, d: i32| BigRational::new(n.into(), d.into());
/// assert!(check_fault_probability(&ratio(1, 3)).is_ok());
/// let refused = check_fault_probability(&ratio(4, 3)).unwrap_err();
/// assert_eq!(refused.to_string(), "the fault probability must be at least 0 and at most 1, not 4/3");
/// ```
pub fn check_fault_probability(q: &BigRational) -> Result<(), Error> {
    if q.is_negative() || *q > BigRational::one() {
        return Err(Error::FaultProbability { given: q.clone() });
    }
    Ok(())
}
