//! Piles at the limits of floats, and how far off each way to compute is there.
//!
//! | file | what it has |
//! |---|---|
//! | `cases` | the piles |
//! | `forces` | what is asked of each, in any scalar |
//! | `errors` | errors in units in the last place, exactly |
//! | `deep`, `deep.md` | 250 and a thousand changes of sign, apart because they take long; as they were measured last |
//! | `table` | the table and what every row must keep |
//! | `table.md` | the table as it was measured last |

pub mod cases;
pub mod deep;
pub mod errors;
pub mod forces;
pub mod table;
