//! Fixed and exhaustive tests of verdicts: which piles stand, which stackings do, and what is proved for every pile.

#![cfg(feature = "std")]

mod standing {
    mod least;
}

mod census {
    mod all_stackings;
}

mod theorem;
