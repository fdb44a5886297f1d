//! The paper's theorems, which hold for every pile, and their proofs.
//!
//! The theorems of this module are about the paper's pile: counts, equilibrium, and the forces on the floor. The crate
//! `cannonpile-proof` has all others: on discs and other dimensions, stackings, loads and leaning gravity, a rough floor,
//! horizontal contacts and random stackings. Its functions `all` and `find` list them together.
//!
//! # Kinds of proof
//! A test shows that an identity holds for the piles it tries. The formulas of this crate are polynomials in i, j, k, L
//! and s = sin φ, and they are generic over any [`Algebra`](crate::scalar::Algebra). Here the formulas run on
//! [`Polynomial`](crate::scalar::Polynomial)s, so the same functions that engines call return polynomials. If the
//! difference of the two sides of an identity is the zero polynomial, the identity holds for **every** i, j, k, L and s
//! at once. There are three kinds of proof ([`ProofKind`]):
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
mod proof;
#[doc(hidden)]
pub mod setting;

pub use display::Listing;
pub use formulas::{Formulas, Library};
pub use proof::{Proof, ProofKind, Relation, Step, Theorem};

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
