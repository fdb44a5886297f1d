//! How accurate the forces of regular sphere piles are.
//!
//! The equations of a pile have a singular value decomposition in closed form, for every stacking, top and load. So a pile is
//! a linear system of any size with rational entries, an exact solution and a known condition number.
//!
//! | question | call |
//! |---|---|
//! | Which singular values does the equilibrium matrix have? | [`singular_values(pile.shape())`](singular_values) |
//! | What is its condition number? | [`condition_number(pile.shape())`](condition_number); in newtons at most [`condition_bound(&packing)`](condition_bound) |
//! | Which rounding errors does a float of p bits have, with a given probability? | [`probable_bounds(&pile, p, 0.01)`](probable_bounds) |
//! | How large are the errors of computed forces, backward and forward? | [`layer_errors`], [`residuals`] |
//! | How do they vary, if roundings are random? | [`stochastic_forces::<P>(&pile, seed)`](stochastic_forces), [`Stochastic`] |
//! | Does a number type keep its promise, and how large are its errors? | [`judge::<T>()`](judge()) |
//!
//! # Map
//! | module | contents |
//! |---|---|
//! | `singular` | singular values and condition numbers |
//! | `probable` | a bound of rounding errors that holds with a given probability |
//! | `errors` | residuals of spheres, and distances from exact forces |
//! | `stochastic` | a float that rounds stochastically |
//! | `value` | the exact value of a number, found by comparisons |
//! | `judgement` | what is found out about a number type |
//! | `judge` | the checks of a number type |

mod errors;
mod judge;
mod judgement;
mod probable;
mod singular;
mod stochastic;
mod value;

pub use errors::{LayerErrors, layer_errors, residuals};
pub use judge::judge;
pub use judgement::{Check, Finding, Growth, Judgement};
pub use probable::{ProbableBound, probable_bounds};
pub use singular::{SingularValue, condition_bound, condition_number, singular_values};
pub use stochastic::{Stochastic, stochastic_forces};

/// The example of README.md, compiled as a doc test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
