//! Any stacking on any region, against a naive oracle that knows nothing of the library.
//!
//! | module | what it holds |
//! |---|---|
//! | `oracle` | piles as sets of sites, the equilibrium of one sphere after the other |
//! | `cases` | which piles: all, and random ones, made twice: for the library and for the oracle |
//! | `compare` | every answer of the library beside that of the oracle |
//! | `agreement` | all stackings under one sphere and on small bases |
//! | `loads` | random tops, weights and loads |
//! | `shapes` | sites, neighbours, counts |
//! | `scalars` | rounded, enclosing and bounded scalars |
//! | `invariants`, `response`, `mirrors` | what THEORY §3 says of all of them |
//! | `widths` | the limbs of the exact engine, on both sides of every switch |
//! | `trees` | how much a tree visits, and piles too high for anything else |
//! | `brute`, `census` | the census against all stackings, by integers |
//! | `planted` | what the comparisons catch |

mod agreement;
mod brute;
mod cases;
mod census;
mod compare;
mod invariants;
mod loads;
mod mirrors;
mod oracle;
//TMP mod planted;
mod response;
mod scalars;
mod shapes;
mod trees;
mod widths;
