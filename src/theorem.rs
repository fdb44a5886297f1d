//! What is proved for every pile, and how.
//!
//! # Kinds of proof
//! A test shows that an identity holds for the piles tried. The formulas of this crate are polynomials in
//! i, j, k, L and s = sin φ, and they are written over any [`Algebra`](crate::scalar::Algebra). So they are run
//! here with [`Polynomial`]s for their numbers: the very functions that engines and answers call return polynomials, and if
//! the difference of the two sides of an identity is the zero polynomial, it holds for **every** i, j, k, L
//! and s at once. There are three kinds of proof ([`ProofKind`]):
//!
//! * *identity*: the two sides, run on symbols, are the same polynomial;
//! * *sum*: one side is a sum over a layer or the pile. Sums of a polynomial between polynomial bounds are
//!   polynomials again (Faulhaber), so the sum is formed in closed form and compared;
//! * *induction*: the base case and the step from k to k+1 are identities.
//!
//! A statement says no more than its steps show; what is argued from them in words is marked so.
//!
//! # What that proves, and what not
//! Proved is what the formulas *as implemented* compute over ℚ: with exact scalars, the equations hold for every
//! pile within the hypotheses, as far as the polynomial arithmetic is right (which is tested against evaluation
//! at random points, by fuzzing too). Not proved here:
//!
//! * the float path. Each of its operations rounds; its error is bounded by tests against exact answers.
//! * that the equations are the right ones. They are the paper's, written out in each statement.
//! * what is not polynomial: overlap and rounding have their own exact tests.
//! * that the input was turned into counts i, j, k correctly: exhaustive tests of piles up to 40 layers see to it.
//! * the engines' bookkeeping, which spheres they find on which line and where they keep a number. With what they find they
//!   call these functions; tests compare them with each other and with an oracle.
//!
//! # Faults
//! A proof that cannot fail proves nothing. Every theorem takes the [`Formulas`] it is about as an argument:
//! [`Formulas::LIBRARY`] are the crate's own, and the tests put a wrong one in the place of each.
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
//! A theorem of your own: the spheres above any sphere on its three lines number k.
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
mod dimensions;

mod display;
mod formulas;
#[doc(hidden)]
pub mod setting;
mod stackings;

pub use display::Listing;
pub use formulas::{Formulas, Library};

use alloc::string::String;
use alloc::vec::Vec;

use num_traits::Zero;

use crate::scalar::Polynomial;

/// How a theorem is proved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ProofKind {
    /// Both sides are the same polynomial.
    Identity,
    /// As an identity, after summing in closed form.
    Sum,
    /// A base case and a step, each an identity.
    Induction,
}

impl ProofKind {
    /// Returns its name: `identity`, `sum`, `induction`.
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
    /// A short name.
    pub name: &'static str,
    /// What is proved, in words and formulas.
    pub statement: &'static str,
    /// For which values of the symbols it is meant.
    pub hypotheses: &'static str,
    /// How it is proved.
    pub method: ProofKind,
    /// The symbols in it.
    pub symbols: &'static str,
    /// The proof: its steps, with the formulas that it is about.
    pub derive: fn(&F) -> Vec<Step>,
}

impl<F> Theorem<F> {
    /// Returns the proof for the crate's own formulas.
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

    /// Returns the proof, or refutation, for formulas of any kind.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::theorem;
    /// use cannonpile::theorem::Formulas;
    ///
    /// // Sphere counts that leave out the floor.
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
    /// Each a claim of its own; all must hold.
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
    /// // Not with one wrong step, nor without any.
    /// proof.steps[0].relation = Relation::Different;
    /// assert!(!proof.holds());
    /// assert!(!Proof { steps: vec![] }.holds());
    /// ```
    #[must_use]
    pub fn holds(&self) -> bool {
        !self.steps.is_empty() && self.steps.iter().all(Step::holds)
    }
}

/// How the two sides of a step are related.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Relation {
    /// They are the same polynomial.
    Equal,
    /// They are not.
    Different,
}

/// One claim of a proof: two polynomials and their relation.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// What is claimed, in words and formulas.
    pub claim: String,
    /// What the formulas gave.
    pub left: Polynomial,
    /// What it is claimed to be.
    pub right: Polynomial,
    /// Whether they are claimed to be equal.
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

/// Returns every theorem, in the order in which one would read them.
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
    [
        counts::THEOREMS,
        balance::THEOREMS,
        base::THEOREMS,
        dimensions::THEOREMS,
        stackings::THEOREMS,
    ]
    .into_iter()
    .flatten()
}

/// Returns the theorem of this name.
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
