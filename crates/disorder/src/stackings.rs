//! Random stackings of a number of layers: how many there are, and where their bottom layers lie.

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
use crate::{THREE, TWO};

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
    /// +, in every stacking.
    Plus,
    /// −, in every stacking.
    Minus,
    /// + or −, each with the probability ½.
    Random,
}

impl FirstSign {
    /// `+`, `-`, `random`.
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

    /// Returns the signs that the first step can have.
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
    /// `+`, `-`, `random`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for FirstSign {
    type Err = Error;

    /// Reads what [`name`](Self::name) prints.
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

/// All stackings of L layers, each with its probability.
///
/// Of the n = L − 1 signs the first is given, or + or − with probability ½; each later one differs from the one before
/// with the fault probability q, 0 ≤ q ≤ 1, independently. So a stacking with d changes of sign, its faults, has
/// the probability q^d (1−q)^(n−1−d), half of that if the first sign is random: q = 0 is FCC, q = 1 is HCP, and at q = ½
/// all stackings are equally likely. Read from the base up it is the same ensemble.
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

/// The most layers of which the probabilities of the registries are found: they take as many steps.
pub(super) const MOST_LAYERS: u64 = 10_000;

/// The most faults, or straight steps, with which stackings are counted: it takes as many products.
const MOST_FAULTS: u64 = 10_000;

impl RandomStackings {
    /// Returns the stackings of this many layers.
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
        // The core refuses a number of layers that no stacking has.
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

    /// Returns the greatest number of faults, n − 1; 0 of one layer.
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

    /// Returns how many stackings have `faults` changes of sign: C(n−1, faults), twice that with a random first sign.
    ///
    /// A single layer has no sign: it is one stacking, whatever the first sign. It takes as many steps as there are faults,
    /// or straight steps between them, if they are fewer.
    ///
    /// # Errors
    /// [`TooLarge`](cannonpile::Error::TooLarge) for more than 10⁴ of both, faults and straight steps between them: with 10³⁶ layers that is
    /// a number of a million bits.
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
        let straight = self.most_faults() - i128::from(faults);
        if straight < 0 {
            return Ok(BigUint::zero());
        }
        let fewer = straight.min(faults.into()).unsigned_abs();
        refuse_beyond(
            "the number of stackings with so many faults",
            fewer,
            MOST_FAULTS,
            "ask for fewer faults, or as many as leave few straight steps",
        )?;
        let of = self.most_faults().unsigned_abs();
        // C(of, t + 1) = C(of, t)·(of − t)/(t + 1).
        let next = |stackings: BigUint, t| stackings * (of - t) / (t + 1);
        Ok((0..fewer).fold(self.first_signs().len().into(), next))
    }

    /// Returns the signs that a stacking can begin with, each as likely: of a single layer there is one stacking.
    pub(super) const fn first_signs(&self) -> &'static [Sign] {
        if self.layers == 1 {
            FirstSign::Plus.signs()
        } else {
            self.first.signs()
        }
    }

    /// Returns the probabilities that the bottom layer has the registry 0, 1, 2 at the fault probability `q`: that s ≡ 0,
    /// 1, 2 (mod 3), with s the number of + steps less that of − steps.
    ///
    /// p_n − ⅓, with n the number of steps, obeys x_(n+1) = −(1−q) x_n − (1−2q) x_(n−1) in each registry
    /// ([`registry_excess`](formula::registry_excess)), by theorem `registry`. So it decays as the greater root λ of
    /// λ² + (1−q)λ + 1−2q: as √(1−2q), and oscillating, for 0 < q < 2√3 − 3.
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
    /// // The stacking ++ ends in the registry 2, and +- in 0.
    /// let stackings = RandomStackings::new(3, FirstSign::Plus)?;
    /// let registry = stackings.registry(&Polynomial::from(Symbol("q")))?;
    /// assert_eq!(registry.map(|p| p.to_string()), ["q", "0", "-q + 1"]);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn registry<T: Algebra>(&self, q: &T) -> Result<[T; 3], Error> {
        refuse_beyond(
            "the probabilities of the registries of random stackings",
            self.layers.unsigned_abs(),
            MOST_LAYERS,
            "ask for fewer layers",
        )?;
        let third = T::one().div_int(THREE);
        let [none, all, half] = [
            -third.clone(),
            T::one() - &third,
            T::one().div_int(TWO) - &third,
        ];
        // The deviations from ⅓ before and after the first step.
        let mut before = [all.clone(), none.clone(), none.clone()];
        let mut after = match self.first {
            FirstSign::Plus => [none.clone(), all, none],
            FirstSign::Minus => [none.clone(), none, all],
            FirstSign::Random => [none, half.clone(), half],
        };
        for _ in 0..self.steps() {
            let next = core::array::from_fn(|registry| {
                formula::registry_excess(&before[registry], &after[registry], q)
            });
            (before, after) = (after, next);
        }
        Ok(before.map(|deviation| deviation + &third))
    }
}

/// Refuses what is no probability, and so none of a change of sign: `q` outside of 0 ≤ q ≤ 1.
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
