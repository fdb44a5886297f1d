//! A scalar that records its operations.

use core::fmt;
use core::num::NonZeroI64;
use core::ops::{Add, Mul, Neg, Sub};

use cannonpile::engine::bug;
use cannonpile::scalar::{Algebra, Exactness, Polynomial, Ring, Symbol};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::Error;

/// The operations on a scalar in the order of their execution. A generic formula that runs on symbols records
/// itself.
///
/// Nothing is simplified. Two expressions are equal if they are the same [polynomial](Self::to_polynomial). Common
/// parts are not shared, so the length of an expression is the number of its operations. It is suitable for
/// formulas, but not for sweeps over layers.
///
/// # Examples
/// ```
/// use cannonpile::formula::force;
/// use cannonpile::lattice::count;
/// use cannonpile_proof::Expression;
/// use cannonpile::scalar::Symbol;
///
/// let [n, w] = ["n", "w"].map(|name| Expression::from(Symbol(name)));
/// assert_eq!(force(n.clone(), &w).to_string(), "n * w");
/// let discs = count::spheres(&n, 2);
/// assert_eq!(discs.to_string(), "1 * (n + 1 - 0) / 1 * (n + 1 - 1) / 2");
/// assert_eq!(discs.evaluate(&[(Symbol("n"), 10.0)])?, Some(55.0));
/// # Ok::<(), cannonpile_proof::Error>(())
/// ```
#[derive(Clone)]
pub struct Expression(Vec<Step>);

/// An operation in postfix order: it pops its operands from a stack and pushes its result.
#[derive(Clone)]
enum Step {
    Symbol(Symbol),
    Number(BigRational),
    Negative,
    Sum,
    Difference,
    Product,
    Quotient(NonZeroI64),
}

/// An operation of an [`Expression`] on operands of any type, for example numbers for evaluation or texts for
/// printing.
#[derive(Clone, Debug)]
pub enum Operation<V> {
    /// A symbol.
    Symbol(Symbol),
    /// A rational number.
    Number(BigRational),
    /// −a.
    Negative(V),
    /// a + b.
    Sum(V, V),
    /// a − b.
    Difference(V, V),
    /// a b.
    Product(V, V),
    /// a / n.
    Quotient(V, NonZeroI64),
}

impl Expression {
    /// Evaluates the expression with `with`, which receives each operation with its evaluated operands.
    ///
    /// # Errors
    /// [`Bug`](cannonpile::Error::Bug) for a malformed expression. No operation produces one.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_proof::{Expression, Operation};
    /// use cannonpile::scalar::Symbol;
    ///
    /// let x = Expression::from(Symbol("x"));
    /// let cube = x.clone() * &x * &x;
    /// let products = cube.fold(|operation| match operation {
    ///     Operation::Product(a, b) => a + b + 1,
    ///     _ => 0,
    /// })?;
    /// assert_eq!(products, 2);
    /// # Ok::<(), cannonpile_proof::Error>(())
    /// ```
    pub fn fold<V>(&self, mut with: impl FnMut(Operation<V>) -> V) -> Result<V, Error> {
        let malformed = || bug("each operation of an expression has its operands");
        let mut left = Vec::new();
        for step in &self.0 {
            let operation = match step {
                Step::Symbol(symbol) => Operation::Symbol(*symbol),
                Step::Number(number) => Operation::Number(number.clone()),
                step => {
                    let last = left.pop().ok_or_else(malformed)?;
                    match step {
                        Step::Negative => Operation::Negative(last),
                        Step::Quotient(n) => Operation::Quotient(last, *n),
                        step => {
                            let first = left.pop().ok_or_else(malformed)?;
                            match step {
                                Step::Sum => Operation::Sum(first, last),
                                Step::Difference => Operation::Difference(first, last),
                                _ => Operation::Product(first, last),
                            }
                        }
                    }
                }
            };
            left.push(with(operation));
        }
        Ok(left.pop().ok_or_else(malformed)?)
    }

    /// Returns the value for given values of the symbols, in any scalar, or `None` if a symbol has no value.
    ///
    /// # Errors
    /// Returns the errors of [`fold`](Self::fold).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_proof::Expression;
    /// use cannonpile::scalar::Symbol;
    ///
    /// let x = Expression::from(Symbol("x"));
    /// let cube = x.clone() * &x * &x;
    /// assert_eq!(cube.evaluate(&[(Symbol("x"), 1.5)])?, Some(3.375));
    /// assert_eq!(cube.evaluate::<f64>(&[])?, None);
    /// # Ok::<(), cannonpile_proof::Error>(())
    /// ```
    pub fn evaluate<T: Algebra>(&self, values: &[(Symbol, T)]) -> Result<Option<T>, Error> {
        let value = |symbol| values.iter().find(|(of, _)| *of == symbol);
        self.fold(|operation: Operation<Option<T>>| {
            Some(match operation {
                Operation::Symbol(symbol) => value(symbol)?.1.clone(),
                Operation::Number(number) => T::from_rational(&number),
                Operation::Negative(a) => -a?,
                Operation::Sum(a, b) => a? + &b?,
                Operation::Difference(a, b) => a? - &b?,
                Operation::Product(a, b) => a? * &b?,
                Operation::Quotient(a, n) => a?.div_int(n),
            })
        })
    }

    /// Returns the expression as a polynomial.
    ///
    /// # Errors
    /// Returns the errors of [`fold`](Self::fold).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_proof::Expression;
    /// use cannonpile::scalar::Symbol;
    ///
    /// let x = Expression::from(Symbol("x"));
    /// let difference = (x.clone() + &x) * &x - &x;
    /// assert_eq!(difference.to_polynomial()?.to_string(), "2 x^2 - x");
    /// # Ok::<(), cannonpile_proof::Error>(())
    /// ```
    pub fn to_polynomial(&self) -> Result<Polynomial, Error> {
        self.fold(|operation: Operation<Polynomial>| match operation {
            Operation::Symbol(symbol) => symbol.into(),
            Operation::Number(number) => Polynomial::constant(&number),
            Operation::Negative(a) => -a,
            Operation::Sum(a, b) => a + &b,
            Operation::Difference(a, b) => a - &b,
            Operation::Product(a, b) => a * &b,
            Operation::Quotient(a, n) => a.div_int(n),
        })
    }

    fn then(mut self, rhs: &Self, step: Step) -> Self {
        self.0.extend_from_slice(&rhs.0);
        self.after(step)
    }

    fn after(mut self, step: Step) -> Self {
        self.0.push(step);
        self
    }
}

impl From<Symbol> for Expression {
    fn from(symbol: Symbol) -> Self {
        Self([Step::Symbol(symbol)].into())
    }
}

impl fmt::Display for Expression {
    /// Writes the expression from left to right, as it was recorded, with brackets only where they are needed.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        /// Binding strengths of an expression: sum, product, atom.
        const SUM: u8 = 0;
        const PRODUCT: u8 = 1;
        const ATOM: u8 = 2;
        let within = |(text, strength): (String, u8), least: u8| {
            if strength < least {
                format!("({text})")
            } else {
                text
            }
        };
        let joined = |a, sign, b, strength| {
            (
                format!("{} {sign} {}", within(a, strength), within(b, strength + 1)),
                strength,
            )
        };
        let written = self.fold(|operation| match operation {
            Operation::Symbol(symbol) => (symbol.0.to_string(), ATOM),
            Operation::Number(number) => {
                let strength = if number.is_integer() { ATOM } else { PRODUCT };
                let strength = if number.is_negative() { SUM } else { strength };
                (number.to_string(), strength)
            }
            Operation::Negative(a) => (format!("-{}", within(a, ATOM)), SUM),
            Operation::Sum(a, b) => joined(a, '+', b, SUM),
            Operation::Difference(a, b) => joined(a, '-', b, SUM),
            Operation::Product(a, b) => joined(a, '*', b, PRODUCT),
            Operation::Quotient(a, n) => {
                let divisor = (n.to_string(), if n.is_negative() { SUM } else { ATOM });
                joined(a, '/', divisor, PRODUCT)
            }
        });
        f.write_str(&written.map_err(|_| fmt::Error)?.0)
    }
}

impl fmt::Debug for Expression {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl PartialEq for Expression {
    fn eq(&self, other: &Self) -> bool {
        match (self.to_polynomial(), other.to_polynomial()) {
            (Ok(a), Ok(b)) => a == b,
            _ => false,
        }
    }
}

impl Add<&Self> for Expression {
    type Output = Self;

    fn add(self, rhs: &Self) -> Self {
        self.then(rhs, Step::Sum)
    }
}

impl Sub<&Self> for Expression {
    type Output = Self;

    fn sub(self, rhs: &Self) -> Self {
        self.then(rhs, Step::Difference)
    }
}

impl Mul<&Self> for Expression {
    type Output = Self;

    fn mul(self, rhs: &Self) -> Self {
        self.then(rhs, Step::Product)
    }
}

cannonpile::by_value!(Expression);

impl Neg for Expression {
    type Output = Self;

    fn neg(self) -> Self {
        self.after(Step::Negative)
    }
}

impl Zero for Expression {
    fn zero() -> Self {
        Self::from_rational(&BigRational::zero())
    }

    fn is_zero(&self) -> bool {
        self.to_polynomial().is_ok_and(|p| p.is_zero())
    }
}

impl One for Expression {
    fn one() -> Self {
        Self::from_rational(&BigRational::one())
    }
}

impl Ring for Expression {
    fn from_integer(n: i128) -> Self {
        Self::from_rational(&BigRational::from_integer(BigInt::from(n)))
    }
}

impl Algebra for Expression {
    const EXACTNESS: Exactness = Exactness::ExactOrFault;
    const NAME: &'static str = "Expression";
    type Numerator = Self;

    fn from_rational(r: &BigRational) -> Self {
        Self([Step::Number(r.clone())].into())
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        self.after(Step::Quotient(n))
    }

    /// `None` if the divisor is zero or contains symbols.
    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        let divisor = divisor.to_polynomial().ok()?.to_constant()?;
        if divisor.is_zero() {
            return None;
        }
        if divisor.is_one() {
            return Some(self.clone());
        }
        Some(self.clone() * &Self::from_rational(&divisor.recip()))
    }

    fn is_defined(&self) -> bool {
        self.to_polynomial().is_ok_and(|p| p.is_defined())
    }
}
