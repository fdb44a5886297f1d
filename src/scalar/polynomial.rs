//! Polynomials over ℚ in named symbols: the scalar type for proofs.

mod display;
mod sum;

use alloc::vec::Vec;
use core::cmp::Ordering;
use core::num::NonZeroI64;
use core::ops::{Add, Mul, Neg, Sub};

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero, pow};

use super::{Algebra, Exactness, Ring, common_multiple};
use crate::sorted::{Sorted, distinct};

/// A symbol of a [`Polynomial`], identified by its name.
///
/// # Examples
/// ```
/// use cannonpile::scalar::{Polynomial, Symbol};
///
/// let x = Polynomial::from(Symbol("x"));
/// assert_eq!((x.clone() * &x).to_string(), "x^2");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Symbol(pub &'static str);

/// A product of powers of symbols: pairs in the order of the symbols, with positive exponents.
///
/// Monomials are ordered by total degree, then lexicographically. Multiplication preserves this order.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Default)]
struct Monomial(Vec<(Symbol, u32)>);

impl Monomial {
    fn degree(&self) -> u64 {
        // The sum cannot overflow: at most 2^32 symbols, with exponents below 2^32.
        self.0.iter().map(|(_, power)| u64::from(*power)).sum()
    }

    fn power(&self, symbol: Symbol) -> u32 {
        self.0
            .iter()
            .find(|(s, _)| *s == symbol)
            // The exponent of an absent symbol is 0.
            .map_or(0, |(_, power)| *power)
    }

    /// Returns the monomial without `symbol`.
    fn without(&self, symbol: Symbol) -> Self {
        Self(
            self.0
                .iter()
                .copied()
                .filter(|(s, _)| *s != symbol)
                .collect(),
        )
    }

    /// Returns the symbols of both monomials, sorted.
    fn symbols(&self, other: &Self) -> Vec<Symbol> {
        distinct(self.0.iter().chain(&other.0).map(|(s, _)| *s).collect())
    }

    /// Combines the exponents of each symbol, or returns `None` if one combination is `None`.
    fn combined(&self, other: &Self, combine: fn(u32, u32) -> Option<u32>) -> Option<Self> {
        let mut powers = Vec::new();
        for symbol in self.symbols(other) {
            match combine(self.power(symbol), other.power(symbol))? {
                0 => {}
                power => powers.push((symbol, power)),
            }
        }
        Some(Self(powers))
    }

    /// Returns the product, or `None` if an exponent exceeds `u32`.
    fn times(&self, other: &Self) -> Option<Self> {
        self.combined(other, u32::checked_add)
    }

    /// Returns the quotient `self` / `other`, or `None` if `other` does not divide `self`.
    fn over(&self, other: &Self) -> Option<Self> {
        self.combined(other, u32::checked_sub)
    }
}

impl Ord for Monomial {
    fn cmp(&self, other: &Self) -> Ordering {
        // The first symbol with different exponents decides: the monomial with the greater exponent is greater.
        let lexicographic = || {
            let powers = |s: Symbol| self.power(s).cmp(&other.power(s));
            let mut orders = self.symbols(other).into_iter().map(powers);
            // Equal powers of all symbols are equal monomials.
            orders.find(|o| o.is_ne()).unwrap_or(Ordering::Equal)
        };
        self.degree().cmp(&other.degree()).then_with(lexicographic)
    }
}

impl PartialOrd for Monomial {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// A polynomial in named symbols with rational coefficients, exact and in canonical form.
///
/// Two polynomials are equal if and only if they are the same function. So comparing the two sides proves an identity.
/// The coefficients are stored as integers over one common denominator. No operation divides by a symbol.
///
/// # Examples
/// This identity holds for every x and y:
/// ```
/// use cannonpile::scalar::{Polynomial, Symbol};
///
/// let [x, y] = ["x", "y"].map(|name| Polynomial::from(Symbol(name)));
/// let left = (x.clone() + &y) * &(x.clone() - &y);
/// let right = x.clone() * &x - &(y.clone() * &y);
/// assert_eq!(left, right);
/// assert_eq!(left.to_string(), "x^2 - y^2");
/// ```
///
/// An exponent beyond 2³²−1 gives a fault, as for [`FixedRational`]. Every operation on a fault gives a fault, and a
/// fault is unequal to every value.
///
/// [`FixedRational`]: super::FixedRational
#[derive(Clone, Debug)]
pub struct Polynomial {
    /// All coefficients are nonzero.
    terms: Sorted<Monomial, BigInt>,
    /// Positive and coprime to the coefficients. For the fault it is zero, and `terms` is empty.
    denominator: BigInt,
}

impl PartialEq for Polynomial {
    fn eq(&self, other: &Self) -> bool {
        let defined = self.is_defined() && other.is_defined();
        defined && self.denominator == other.denominator && self.terms == other.terms
    }
}

impl Polynomial {
    /// Returns a constant as a polynomial.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::{Polynomial, Symbol};
    /// use num_rational::BigRational;
    ///
    /// let half = Polynomial::constant(&BigRational::new(1.into(), 2.into()));
    /// assert_eq!((half.to_string(), half.degree()), ("1/2".into(), 0));
    /// assert_eq!((half * &Polynomial::from(Symbol("x"))).to_string(), "x/2");
    /// ```
    #[must_use]
    pub fn constant(value: &BigRational) -> Self {
        Self::term(Monomial::default(), value)
    }

    /// Returns Σ c_j · `symbol`^j / `denominator`, where c_j are the `coefficients`, or `None` for the `denominator` 0.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::{Polynomial, Symbol};
    ///
    /// let polynomial = Polynomial::in_powers(Symbol("q"), [2, 0, -4].map(Into::into), 6.into());
    /// assert_eq!(polynomial.unwrap().to_string(), "(-2 q^2 + 1)/3");
    /// ```
    #[must_use]
    pub fn in_powers(
        symbol: Symbol,
        coefficients: impl IntoIterator<Item = BigInt>,
        denominator: BigInt,
    ) -> Option<Self> {
        let sign = if denominator.is_negative() { -1 } else { 1 };
        let terms = coefficients
            .into_iter()
            .zip(0..)
            .map(|(coefficient, power)| {
                let powers = if power == 0 {
                    Vec::new()
                } else {
                    Vec::from([(symbol, power)])
                };
                (Monomial(powers), coefficient * sign)
            });
        let polynomial = Self::canonical(collect_terms(terms.collect()), denominator * sign);
        polynomial.is_defined().then_some(polynomial)
    }

    /// Returns the fault, which is the result of an operation with an exponent that does not fit.
    fn fault() -> Self {
        Self {
            terms: Sorted::new(),
            denominator: BigInt::zero(),
        }
    }

    /// Returns the value of a constant polynomial, or `None` if a symbol occurs.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::{Polynomial, Ring, Symbol};
    ///
    /// let x = Polynomial::from(Symbol("x"));
    /// assert_eq!(x.to_constant(), None);
    /// assert_eq!((x.clone() - &x).to_constant().unwrap(), num_traits::zero());
    /// ```
    #[must_use]
    pub fn to_constant(&self) -> Option<BigRational> {
        match self.terms.last() {
            None => self.is_defined().then(BigRational::zero),
            Some((greatest, numer)) => (greatest.degree() == 0)
                .then(|| BigRational::new(numer.clone(), self.denominator.clone())),
        }
    }

    /// Returns the total degree. It is 0 for constants, zero included, and for the fault.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::{Polynomial, Symbol};
    ///
    /// let [x, y] = ["x", "y"].map(|name| Polynomial::from(Symbol(name)));
    /// let p = x.clone() * &x * &y + &x;
    /// assert_eq!((p.degree(), p.degree_in(Symbol("x"))), (3, 2));
    /// ```
    #[must_use]
    pub fn degree(&self) -> u64 {
        let greatest = self.terms.last();
        // Zero and the fault have no terms, and their degree is 0 by definition.
        greatest.map_or(0, |(monomial, _)| monomial.degree())
    }

    /// Returns the degree in one symbol. It is 0 if the symbol does not occur.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::{Polynomial, Symbol};
    ///
    /// let [x, y] = ["x", "y"].map(|name| Polynomial::from(Symbol(name)));
    /// let p = x.clone() * &x * &y + &y;
    /// assert_eq!(["x", "y", "z"].map(|name| p.degree_in(Symbol(name))), [2, 1, 0]);
    /// ```
    #[must_use]
    pub fn degree_in(&self, symbol: Symbol) -> u32 {
        self.terms
            .iter()
            .map(|(monomial, _)| monomial.power(symbol))
            .max()
            // Zero and the fault have no terms, and their degree is 0 by definition.
            .unwrap_or(0)
    }

    /// Returns the symbols that occur, in order.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::{Polynomial, Symbol};
    ///
    /// let [x, y] = ["x", "y"].map(|name| Polynomial::from(Symbol(name)));
    /// let product = y.clone() * &x;
    /// assert_eq!(product.symbols(), [Symbol("x"), Symbol("y")]);
    /// // A symbol whose terms cancel does not occur.
    /// assert_eq!((product.clone() + &y - &product).symbols(), [Symbol("y")]);
    /// ```
    #[must_use]
    pub fn symbols(&self) -> Vec<Symbol> {
        let powers = self.terms.iter().flat_map(|(monomial, _)| &monomial.0);
        distinct(powers.map(|(symbol, _)| *symbol).collect())
    }

    /// Returns the polynomial with `value` substituted for `symbol`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::{Polynomial, Ring, Symbol};
    ///
    /// let [x, y] = ["x", "y"].map(|name| Polynomial::from(Symbol(name)));
    /// let square = x.clone() * &x;
    /// let shifted = square.substitute(Symbol("x"), &(y + &Polynomial::from_integer(1)));
    /// assert_eq!(shifted.to_string(), "y^2 + 2 y + 1");
    /// ```
    #[must_use]
    pub fn substitute(&self, symbol: Symbol, value: &Self) -> Self {
        if !value.is_defined() {
            return Self::fault();
        }
        // Zero times a power is zero, even if the exponent does not fit in `usize`.
        let times_power = |sum: Self, power: u32| match usize::try_from(power) {
            _ if sum.is_zero() => sum,
            Ok(power) => sum * &pow(value.clone(), power),
            Err(_) => Self::fault(),
        };
        // Horner scheme in `symbol`, with coefficients that are polynomials in the other symbols.
        let (mut sum, mut last) = (Self::zero(), self.degree_in(symbol));
        for (power, coefficient) in self.coefficients(symbol).into_iter().rev() {
            (sum, last) = (times_power(sum, last - power) + &coefficient, power);
        }
        times_power(sum, last)
    }

    /// Returns the value in any scalar type, for given values of the symbols. Returns `None` if a symbol has no value,
    /// and for the fault.
    ///
    /// Each term is computed as a product, factor by factor. Exponents above 64 use repeated squaring, and such a power
    /// may leave the range of the scalar although the whole term would not.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::{Polynomial, Symbol};
    ///
    /// let x = Polynomial::from(Symbol("x"));
    /// let cube = x.clone() * &x * &x;
    /// assert_eq!(cube.evaluate(&[(Symbol("x"), 1.5)]), Some(3.375));
    /// assert_eq!(cube.evaluate::<f64>(&[]), None);
    /// ```
    #[must_use]
    pub fn evaluate<T: Algebra>(&self, values: &[(Symbol, T)]) -> Option<T> {
        let value_of = |symbol| {
            values
                .iter()
                .find(|(s, _)| *s == symbol)
                .map(|(_, value)| value)
        };
        if !self.is_defined() {
            return None;
        }
        let mut sum = T::zero();
        for (monomial, numer) in self.terms.iter() {
            let coefficient = BigRational::new(numer.clone(), self.denominator.clone());
            let mut term = T::from_rational(&coefficient);
            for (symbol, power) in &monomial.0 {
                let value = value_of(*symbol)?;
                if *power <= 64 {
                    term = (0..*power).fold(term, |term, _| term * value);
                } else {
                    term = term * &pow(value.clone(), usize::try_from(*power).ok()?);
                }
            }
            sum = sum + &term;
        }
        Some(sum)
    }

    /// Returns the quotient `self` / `divisor`, or `None` if `divisor` does not divide this polynomial.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::{Polynomial, Symbol};
    ///
    /// let [x, y] = ["x", "y"].map(|name| Polynomial::from(Symbol(name)));
    /// let difference = x.clone() * &x - &(y.clone() * &y);
    /// let factor = x.clone() - &y;
    /// assert_eq!(difference.divide_exactly(&factor).unwrap().to_string(), "x + y");
    /// assert_eq!(difference.divide_exactly(&(x.clone() * &y)), None);
    /// ```
    #[must_use]
    pub fn divide_exactly(&self, divisor: &Self) -> Option<Self> {
        let (leading, coefficient) = divisor.terms.last()?;
        let coefficient = BigRational::new(coefficient.clone(), divisor.denominator.clone());
        if !self.is_defined() {
            return None;
        }
        let (mut rest, mut quotient) = (self.clone(), Self::zero());
        // Multiplication preserves the order of monomials. So a term that the leading term of the divisor does not
        // divide remains in the remainder.
        while let Some((monomial, numer)) = rest.terms.last() {
            let numer = BigRational::new(numer.clone(), rest.denominator.clone());
            let factor = Self::term(monomial.over(leading)?, &(numer / &coefficient));
            rest = rest - &(factor.clone() * divisor);
            quotient = quotient + &factor;
        }
        Some(quotient)
    }

    /// Returns the nonzero coefficients of the powers of `symbol`, as polynomials in the other symbols. For the fault
    /// it returns the fault as the only coefficient.
    #[doc(hidden)]
    #[must_use]
    pub fn coefficients(&self, symbol: Symbol) -> Vec<(u32, Self)> {
        if !self.is_defined() {
            return Vec::from([(0, Self::fault())]);
        }
        let mut by_power: Sorted<u32, Vec<(Monomial, BigInt)>> = Sorted::new();
        for (monomial, n) in self.terms.iter() {
            let terms = by_power.entry(monomial.power(symbol), Vec::new());
            terms.push((monomial.without(symbol), n.clone()));
        }
        let coefficient = |terms| Self::canonical(collect_terms(terms), self.denominator.clone());
        by_power
            .into_vec()
            .into_iter()
            .map(|(power, terms)| (power, coefficient(terms)))
            .collect()
    }

    fn term(monomial: Monomial, coefficient: &BigRational) -> Self {
        let sign = coefficient.denom().signum();
        let terms = Vec::from([(monomial, coefficient.numer() * &sign)]);
        Self::canonical(collect_terms(terms), coefficient.denom() * sign)
    }

    /// Removes zero coefficients and reduces the fraction. `denominator` must not be negative.
    fn canonical(mut terms: Sorted<Monomial, BigInt>, denominator: BigInt) -> Self {
        if denominator.is_zero() {
            return Self::fault();
        }
        terms.retain(|coefficient| !coefficient.is_zero());
        let mut common = denominator.clone();
        for (_, coefficient) in terms.iter() {
            if common.is_one() {
                break;
            }
            common = common.gcd(coefficient);
        }
        if common.is_one() {
            return Self { terms, denominator };
        }
        for coefficient in terms.values_mut() {
            *coefficient /= &common;
        }
        Self {
            terms,
            denominator: denominator / common,
        }
    }

    /// Adds `sign` times `other`.
    fn accumulate(mut self, other: &Self, sign: i8) -> Self {
        if !(self.is_defined() && other.is_defined()) {
            return Self::fault();
        }
        let denominator = common_multiple(self.denominator.clone(), &other.denominator);
        let own = &denominator / &self.denominator;
        let theirs = &denominator / &other.denominator * sign;
        if !own.is_one() {
            self.terms
                .values_mut()
                .for_each(|coefficient| *coefficient *= &own);
        }
        let others = other.terms.iter();
        let others = others.map(|(monomial, n)| (monomial.clone(), n * &theirs));
        self.terms.merge(others.collect(), |sum, n| *sum += n);
        Self::canonical(self.terms, denominator)
    }
}

/// Returns the sum of terms in any order.
fn collect_terms(entries: Vec<(Monomial, BigInt)>) -> Sorted<Monomial, BigInt> {
    let mut terms = Sorted::new();
    terms.merge(entries, |sum: &mut BigInt, n| *sum += n);
    terms
}

impl From<Symbol> for Polynomial {
    fn from(symbol: Symbol) -> Self {
        Self::term(
            Monomial([(symbol, 1)].into_iter().collect()),
            &BigRational::one(),
        )
    }
}

impl Add<&Self> for Polynomial {
    type Output = Self;

    fn add(self, rhs: &Self) -> Self {
        self.accumulate(rhs, 1)
    }
}

impl Sub<&Self> for Polynomial {
    type Output = Self;

    fn sub(self, rhs: &Self) -> Self {
        self.accumulate(rhs, -1)
    }
}

impl Mul<&Self> for Polynomial {
    type Output = Self;

    fn mul(self, rhs: &Self) -> Self {
        let mut terms = Vec::new();
        for (a, x) in self.terms.iter() {
            for (b, y) in rhs.terms.iter() {
                let Some(monomial) = a.times(b) else {
                    return Self::fault();
                };
                terms.push((monomial, x * y));
            }
        }
        Self::canonical(collect_terms(terms), self.denominator * &rhs.denominator)
    }
}

crate::by_value!(Polynomial);

impl Neg for Polynomial {
    type Output = Self;

    fn neg(mut self) -> Self {
        self.terms
            .values_mut()
            .for_each(|coefficient| *coefficient *= -1);
        self
    }
}

impl Zero for Polynomial {
    fn zero() -> Self {
        Self {
            terms: Sorted::new(),
            denominator: BigInt::one(),
        }
    }

    fn is_zero(&self) -> bool {
        self.terms.is_empty() && self.is_defined()
    }
}

impl One for Polynomial {
    fn one() -> Self {
        Self::constant(&BigRational::one())
    }
}

impl Ring for Polynomial {
    fn from_integer(n: i128) -> Self {
        Self::constant(&BigRational::from_integer(n.into()))
    }
}

impl Algebra for Polynomial {
    const EXACTNESS: Exactness = Exactness::ExactOrFault;
    const NAME: &'static str = "Polynomial";
    type Numerator = Self;

    fn from_rational(r: &BigRational) -> Self {
        Self::constant(r)
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        let sign = BigInt::from(n.get().signum());
        let mut terms = self.terms;
        for coefficient in terms.values_mut() {
            *coefficient *= &sign;
        }
        Self::canonical(terms, self.denominator * BigInt::from(n.get()).abs())
    }

    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        self.divide_exactly(divisor)
    }

    fn is_defined(&self) -> bool {
        !self.denominator.is_zero()
    }
}
