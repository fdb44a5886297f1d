//! Piles at the limits of floats, and the errors of each scalar there.
//!
//! | file | contents |
//! |---|---|
//! | `cases` | the piles |
//! | `forces` | the tested quantities, in any scalar |
//! | `errors` | exact errors in units in the last place |
//! | `deep`, `deep.md` | 250 and 1,000 sign changes, separate because they take long, and their last measurements |
//! | `table` | the table, and the bounds of every row |
//! | `table.md` | the table of the last measurements |

pub mod cases;
pub mod deep;
pub mod errors;
pub mod forces;
pub mod table;
