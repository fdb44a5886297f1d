//! Fixed and exhaustive tests of verdicts: stable piles, stable stackings, and theorems for every pile.

#![cfg(feature = "std")]

mod standing {
    mod least;
}

mod census {
    mod all_stackings;
}

mod stability;
mod theorem;
