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

pub(crate) mod cases;
// Without optimisation even the exact forces of so many layers are slow.
#[cfg(not(debug_assertions))]
pub(crate) mod deep;
pub(crate) mod errors;
pub(crate) mod forces;
pub(crate) mod table;
