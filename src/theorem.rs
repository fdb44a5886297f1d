//! The paper's theorems, which hold for every pile, and their proofs.
//!
//! The theorems of this module are about the paper's pile: counts, equilibrium, and the forces on the floor. The crate
//! `cannonpile-proof` has further theorems about the same formulas: on discs and other dimensions, on stackings, on
//! loads and leaning gravity, and on a rough floor. Its functions `all` and `find` list the theorems of all crates.
//!
//! # Kinds of proof
//! A test shows that an identity holds for the piles it tries. The formulas of this crate are polynomials in i, j, k, L
//! and s = sin φ, and they are generic over any [`Algebra`](crate::scalar::Algebra). Here the formulas run on
//! [`Polynomial`]s, so the same functions that engines call return polynomials. If the difference of the two sides of
//! an identity is the zero polynomial, the identity holds for **every** i, j, k, L and s at once. There are three kinds
//! of proof ([`ProofKind`]):
//!
//! * *identity*: on symbols, the two sides are the same polynomial.
//! * *sum*: one side is a sum over a layer or the pile. Sums of a polynomial between polynomial bounds are polynomials
//!   (Faulhaber). The proof computes the sum in closed form and compares it.
//! * *induction*: the base case and the step from k to k+1 are identities.
//!
//! A statement claims only what its steps prove. It marks arguments in words as such.
//!
//! # Scope
//! The theorems prove the results of the formulas *as implemented* over ℚ. With exact scalars, the equations hold for
//! every pile that satisfies the hypotheses. This relies on the polynomial arithmetic, which is tested against
//! evaluation at random points and by fuzzing. The theorems do not cover:
//!
//! * The float path. Each operation rounds, and tests compare the error with exact results.
//! * The choice of the equations. They are those of the paper, written out in each statement.
//! * Properties that are not polynomial. Overlap and rounding have their own exact tests.
//! * The conversion of the input to counts i, j, k. Exhaustive tests cover piles of up to 40 layers.
//! * The bookkeeping of the engines: the spheres on each line and the storage of the numbers. The engines pass their
//!   data to these functions. Tests compare the engines with each other and with an oracle.
//!
//! # Faults
//! A proof that cannot fail proves nothing. So every theorem takes the formulas as an argument ([`Formulas`]).
//! [`Formulas::LIBRARY`] has the formulas of the crate, and the tests replace each of them by a wrong one.
//!
//! # Examples
//! ```
//! use cannonpile::theorem;
//!
//! let weight = theorem::find("weight").unwrap();
//! let proof = weight.prove();
//! assert!(proof.holds());
//! for step in &proof.steps {
//!     println!("{}: {} = {}", step.claim, step.left, step.right);
//! }
//! ```
//! A new theorem: the spheres above any sphere on its three lines number k.
//! ```
//! use cannonpile::lattice::count;
//! use cannonpile::scalar::{Polynomial, Symbol};
//!
//! let [i, j, k] = ["i", "j", "k"].map(|name| Polynomial::from(Symbol(name)));
//! let [alpha, beta, gamma] = count::above(&i, &j, &k);
//! assert_eq!(alpha + &beta + &gamma, k);
//! ```

mod balance;
mod base;
mod counts;
mod display;
mod formulas;
#[doc(hidden)]
pub mod setting;

pub use display::Listing;
pub use formulas::{Formulas, Library};

use alloc::string::String;
use alloc::vec::Vec;

use num_traits::Zero;

use crate::scalar::Polynomial;

/// The kind of a proof.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ProofKind {
    /// Both sides are the same polynomial.
    Identity,
    /// Both sides are the same polynomial after a sum in closed form.
    Sum,
    /// A base case and a step, both identities.
    Induction,
}

impl ProofKind {
    /// Returns the name: `identity`, `sum`, `induction`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::theorem;
    /// use cannonpile::theorem::ProofKind;
    ///
    /// assert_eq!(ProofKind::Induction.name(), "induction");
    /// assert_eq!(theorem::find("spheres").unwrap().method.name(), "sum");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Identity => "identity",
            Self::Sum => "sum",
            Self::Induction => "induction",
        }
    }
}

/// A statement about every pile, with its proof.
#[derive(Clone, Copy, Debug)]
pub struct Theorem<F: 'static = Formulas> {
    /// The short name.
    pub name: &'static str,
    /// The statement, in words and formulas.
    pub statement: &'static str,
    /// The range of the symbols.
    pub hypotheses: &'static str,
    /// The kind of its proof.
    pub method: ProofKind,
    /// The symbols of the statement.
    pub symbols: &'static str,
    /// Derives the steps of the proof from the formulas.
    pub derive: fn(&F) -> Vec<Step>,
}

impl<F> Theorem<F> {
    /// Returns the proof for the formulas of the crate.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::theorem;
    ///
    /// let proof = theorem::find("contacts").unwrap().prove();
    /// assert!(proof.holds());
    /// // For every L at once: the contacts of one direction.
    /// assert_eq!(proof.steps[0].right.to_string(), "(L^3 - L)/6");
    /// ```
    #[must_use]
    pub fn prove(&self) -> Proof
    where
        F: Library,
    {
        self.prove_for(&F::LIBRARY)
    }

    /// Returns the proof, or the refutation, for any formulas.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::theorem;
    /// use cannonpile::theorem::Formulas;
    ///
    /// // Sphere counts without the bottom layer.
    /// let wrong: Formulas = Formulas {
    ///     spheres: |layers, d| (Formulas::LIBRARY.spheres)(&(layers.clone() - &num_traits::one()), d),
    ///     ..Formulas::LIBRARY
    /// };
    /// assert!(!theorem::find("weight").unwrap().prove_for(&wrong).holds());
    /// ```
    #[must_use]
    pub fn prove_for(&self, formulas: &F) -> Proof {
        Proof {
            steps: (self.derive)(formulas),
        }
    }
}

/// The steps of a proof.
#[derive(Clone, Debug, PartialEq)]
pub struct Proof {
    /// The steps, each with its own claim. All claims must hold.
    pub steps: Vec<Step>,
}

impl Proof {
    /// Returns whether every step holds.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::theorem;
    /// use cannonpile::theorem::{Proof, Relation};
    ///
    /// let mut proof = theorem::find("counts").unwrap().prove();
    /// assert!(proof.holds());
    /// // A proof fails with one wrong step, and without steps.
    /// proof.steps[0].relation = Relation::Different;
    /// assert!(!proof.holds());
    /// assert!(!Proof { steps: vec![] }.holds());
    /// ```
    #[must_use]
    pub fn holds(&self) -> bool {
        !self.steps.is_empty() && self.steps.iter().all(Step::holds)
    }
}

/// The relation between the two sides of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Relation {
    /// The sides are the same polynomial.
    Equal,
    /// The sides are different polynomials.
    Different,
}

/// One claim of a proof: two polynomials and their relation.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// The claim, in words and formulas.
    pub claim: String,
    /// The result of the formulas.
    pub left: Polynomial,
    /// The claimed result.
    pub right: Polynomial,
    /// The claimed relation.
    pub relation: Relation,
}

impl Step {
    /// Returns the claim that two polynomials are the same.
    #[must_use]
    pub fn equal(claim: impl Into<String>, left: Polynomial, right: Polynomial) -> Self {
        Self {
            claim: claim.into(),
            left,
            right,
            relation: Relation::Equal,
        }
    }

    /// Returns the claim that two polynomials differ.
    #[must_use]
    pub fn different(claim: impl Into<String>, left: Polynomial, right: Polynomial) -> Self {
        Self {
            relation: Relation::Different,
            ..Self::equal(claim, left, right)
        }
    }

    /// Returns `left` − `right`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::{Polynomial, Symbol};
    /// use cannonpile::theorem::{Relation, Step};
    ///
    /// let [x, y] = ["x", "y"].map(|name| Polynomial::from(Symbol(name)));
    /// let sum = x.clone() + &y;
    /// let (left, right) = (sum.clone() * &sum, x.clone() * &x + &(y.clone() * &y));
    /// let step = Step { claim: "(x+y)² = x² + y²".into(), left, right, relation: Relation::Equal };
    /// assert_eq!(step.difference().to_string(), "2 x y");
    /// ```
    #[must_use]
    pub fn difference(&self) -> Polynomial {
        self.left.clone() - &self.right
    }

    /// Returns whether the claim holds.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::{Polynomial, Symbol};
    /// use cannonpile::theorem::{Relation, Step};
    ///
    /// let x = Polynomial::from(Symbol("x"));
    /// let (left, right) = (x.clone() + &x, x);
    /// let step = Step { claim: "2x ≠ x".into(), left, right, relation: Relation::Different };
    /// assert!(step.holds());
    /// assert!(!Step { relation: Relation::Equal, ..step }.holds());
    /// ```
    #[must_use]
    pub fn holds(&self) -> bool {
        self.difference().is_zero() == (self.relation == Relation::Equal)
    }
}

/// Returns the theorems of this crate, in reading order.
///
/// # Examples
/// ```
/// use cannonpile::theorem;
///
/// assert!(theorem::all().any(|theorem| theorem.name == "weight"));
/// for theorem in theorem::all() {
///     assert!(theorem.prove().holds(), "{}", theorem.name);
/// }
/// ```
pub fn all() -> impl Iterator<Item = &'static Theorem> {
    [counts::THEOREMS, balance::THEOREMS, base::THEOREMS]
        .into_iter()
        .flatten()
}

/// Returns the theorem of this crate with this name.
///
/// # Examples
/// ```
/// use cannonpile::theorem;
///
/// assert!(theorem::find("equilibrium").is_some());
/// assert!(theorem::find("fermat").is_none());
/// ```
#[must_use]
pub fn find(name: &str) -> Option<&'static Theorem> {
    all().find(|theorem| theorem.name == name)
}
