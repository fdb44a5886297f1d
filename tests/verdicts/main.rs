//! Fixed and exhaustive tests of verdicts: stable piles, and theorems for every pile.

#![cfg(feature = "std")]

mod standing {
    mod least;
}

mod theorem;
