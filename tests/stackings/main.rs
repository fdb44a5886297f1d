//! Any stacking on any region, against a naive oracle that knows nothing of the library.
//!
//! | module | what it holds |
//! |---|---|
//! | `oracle` | piles as sets of sites, the equilibrium of one sphere after the other |
//! | `cases` | which piles: all, and random ones, made twice: for the library and for the oracle |
//! | `compare` | every answer of the library beside that of the oracle |
//! | `agreement` | all stackings under one sphere and on small bases |
//! | `loads` | random tops, weights and loads |
//! | `notations` | stackings as they are written |
//! | `regions` | six-sided regions as sets of sites |
//! | `shapes` | sites, neighbours, counts |
//! | `parts` | rows begun in the middle, of one sphere, of another pile; loads on other straight piles |
//! | `vectors` | forces as vectors, positions |
//! | `scalars` | rounded, enclosing and bounded scalars |
//! | `invariants`, `response`, `mirrors` | what THEORY §3 says of all of them |
//! | `widths` | the limbs of the exact engine, on both sides of every switch |
//! | `trees`, `high` | how much a tree visits, and piles too high for anything else |
//! | `brute`, `census` | the census against all stackings, by integers |
//! | `contracts` | what the documentation promises at the edges |
//! | `planted` | what the comparisons catch |

mod agreement;
mod brute;
mod cases;
mod census;
mod compare;
mod contracts;
mod high;
mod invariants;
mod loads;
mod mirrors;
mod notations;
mod oracle;
mod parts;
mod planted;
mod regions;
mod response;
mod scalars;
mod shapes;
mod trees;
mod vectors;
mod widths;
