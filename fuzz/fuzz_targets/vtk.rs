//! Fuzzes [`cannonpile_fuzz::vtk`].

#![no_main]

use libfuzzer_sys::{Corpus, fuzz_target};

fuzz_target!(|bytes: &[u8]| -> Corpus { cannonpile_fuzz::vtk(bytes) });
