//! Exact sums of two surds.

use alloc::format;
use core::cmp::Ordering;
use core::fmt;
use core::ops::Mul;

use num_bigint::{BigInt, Sign};
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use crate::rational::ByValue;
use crate::{CorrectlyRounded, Surd};

/// An exact sum a·√m + b·√n of two surds.
///
/// Example: tan(θ/2) = 1/sinθ − cosθ/sinθ, where sin²θ and cos²θ are rational.
///
/// Terms with the same root, apart from squares, are one term. The larger term comes first. So equal sums have equal
/// terms.
///
/// # Examples
/// ```
/// use exact_surd::{Surd, SurdSum};
///
/// let root = |text: &str| text.parse::<Surd>();
/// let sum = SurdSum::new(root("-1/6*sqrt(39)")?, root("5/6*sqrt(3)")?);
/// assert_eq!(sum.to_string(), "5/6*sqrt(3)-1/6*sqrt(39)");
/// assert_eq!(sum.nearest::<f64>(), Some(0.402542673240998));
/// assert_eq!(SurdSum::new(root("sqrt(3)")?, root("sqrt(12)")?).to_string(), "3*sqrt(3)");
/// # Ok::<(), exact_surd::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct SurdSum {
    /// In decreasing magnitude. The second one is zero if the sum is a surd. Otherwise no sum of the terms with rational
    /// factors is zero, so the sum is irrational.
    terms: [Surd; 2],
}

impl SurdSum {
    /// Returns the sum of two surds.
    ///
    /// # Examples
    /// See [`SurdSum`].
    #[must_use]
    pub fn new(a: Surd, b: Surd) -> Self {
        let terms = match a.checked_add(&b) {
            Some(sum) => [sum, Surd::zero()],
            None if ByValue(&a.square()) < ByValue(&b.square()) => [b, a],
            None => [a, b],
        };
        Self { terms }
    }

    /// Returns the two terms, the larger one first.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::{Surd, SurdSum};
    ///
    /// let sum = SurdSum::new("1".parse()?, "-sqrt(2)".parse()?);
    /// assert_eq!(sum.terms().clone().map(|term| term.to_string()), ["-sqrt(2)", "1"]);
    /// # Ok::<(), exact_surd::Error>(())
    /// ```
    #[must_use]
    pub const fn terms(&self) -> &[Surd; 2] {
        &self.terms
    }

    /// Returns the surd of this value; `None` if the sum is not a surd.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::{Surd, SurdSum};
    ///
    /// let root: Surd = "sqrt(2)".parse()?;
    /// assert_eq!(SurdSum::from(root.clone()).to_surd(), Some(&root));
    /// assert_eq!(SurdSum::new(root, "1".parse()?).to_surd(), None);
    /// # Ok::<(), exact_surd::Error>(())
    /// ```
    #[must_use]
    pub fn to_surd(&self) -> Option<&Surd> {
        let [first, second] = &self.terms;
        second.coefficient().is_zero().then_some(first)
    }

    /// Returns the sign.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::num_bigint::Sign;
    /// use exact_surd::{Surd, SurdSum};
    ///
    /// let sum = SurdSum::new("sqrt(50)".parse()?, "-sqrt(49)".parse()?);
    /// assert_eq!(sum.sign(), Sign::Plus);
    /// # Ok::<(), exact_surd::Error>(())
    /// ```
    #[must_use]
    pub fn sign(&self) -> Sign {
        // Irrational terms with different roots have different magnitudes.
        self.terms[0].sign()
    }

    /// Returns the correctly rounded value, ties to even; `None` if it overflows.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::{Surd, SurdSum};
    ///
    /// // Floats lose most digits of this difference.
    /// let sum = SurdSum::new("sqrt(1000000000001)".parse()?, "-1000000".parse()?);
    /// assert_eq!(sum.nearest::<f64>(), Some(4.999999999998750e-7));
    /// assert_eq!(1000000000001_f64.sqrt() - 1000000.0, 5.00003807246685e-7);
    /// # Ok::<(), exact_surd::Error>(())
    /// ```
    #[must_use]
    pub fn nearest<F: CorrectlyRounded + PartialEq>(&self) -> Option<F> {
        if let Some(surd) = self.to_surd() {
            return surd.nearest();
        }
        // The sum is irrational, so all numbers in a narrow enclosure round to one float.
        let decided = |[below, above]: [BigRational; 2]| {
            // A sum that rounds to zero keeps its sign.
            if below.is_negative() != above.is_negative() {
                return None;
            }
            let float = F::nearest_to_rational(&below);
            (float == F::nearest_to_rational(&above)).then_some(float)
        };
        self.decide(decided)
    }

    /// Returns the first answer to narrower and narrower enclosures. The sum must be irrational, and `decided` must answer
    /// every enclosure that is narrow enough.
    fn decide<A>(&self, decided: impl Fn([BigRational; 2]) -> Option<A>) -> A {
        debug_assert!(self.to_surd().is_none(), "{self} is rational or a surd");
        let mut bits = 128 + self.terms[0].coefficient().denom().bits();
        loop {
            let [a, b] = self.terms.each_ref().map(|term| floor(term, bits));
            let ulp = BigInt::from(1) << bits;
            let end = |more: u32| BigRational::new(&a + &b + more, ulp.clone());
            if let Some(answer) = decided([end(0), end(2)]) {
                return answer;
            }
            bits *= 2;
        }
    }
}

/// Returns an integer n with n ≤ x·2^`bits` ≤ n + 1.
fn floor(x: &Surd, bits: u64) -> BigInt {
    // ⌊√q⌋ = ⌊√⌊q⌋⌋
    let square = x.square();
    let root = ((square.numer() << (2 * bits)) / square.denom()).sqrt();
    if x.coefficient().is_negative() {
        -root - 1
    } else {
        root
    }
}

impl From<Surd> for SurdSum {
    fn from(surd: Surd) -> Self {
        Self::new(surd, Surd::zero())
    }
}

impl Mul<&Surd> for SurdSum {
    type Output = Self;

    fn mul(self, factor: &Surd) -> Self {
        let [a, b] = self.terms;
        Self::new(a * factor, b * factor)
    }
}

/// Compares exactly, with the rational value of the float.
impl PartialEq<f64> for SurdSum {
    fn eq(&self, other: &f64) -> bool {
        self.partial_cmp(other).is_some_and(Ordering::is_eq)
    }
}

/// Compares exactly, with the rational value of the float; `None` for not-a-number.
impl PartialOrd<f64> for SurdSum {
    fn partial_cmp(&self, other: &f64) -> Option<Ordering> {
        match (self.to_surd(), BigRational::from_float(*other)) {
            (Some(surd), _) => surd.partial_cmp(other),
            (None, None) => self.terms[0].partial_cmp(other),
            (None, Some(value)) => Some(self.decide(|[below, above]| {
                if ByValue(&value) <= ByValue(&below) {
                    Some(Ordering::Greater)
                } else if ByValue(&value) >= ByValue(&above) {
                    Some(Ordering::Less)
                } else {
                    None
                }
            })),
        }
    }
}

impl fmt::Display for SurdSum {
    /// Writes `5/6*sqrt(3)-1/6*sqrt(39)`, or the surd alone, with the width, fill, alignment and sign of the formatter.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [first, second] = &self.terms;
        if self.to_surd().is_some() {
            return first.fmt(f);
        }
        let is_negative = first.coefficient().is_negative();
        let magnitude = if is_negative {
            -first.clone()
        } else {
            first.clone()
        };
        f.pad_integral(!is_negative, "", &format!("{magnitude}{second:+}"))
    }
}
