//! A theorem, and the steps of its proof.

use alloc::string::String;
use alloc::vec::Vec;

use num_traits::Zero;

use super::{Formulas, Library};
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
