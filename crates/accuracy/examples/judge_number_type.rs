//! Judges number types: the laws, piles with exact answers, the growth of errors, and the ends of the range.
//!
//! The exit status is 1 if a type broke its promise. Run it with
//! `cargo run --release -p cannonpile-accuracy --example judge_number_type`. For a type of your own, replace one of the types in
//! `main`.

use std::process::ExitCode;

use cannonpile::num_rational::BigRational;
use cannonpile_accuracy::{Judgement, judge};

fn main() -> ExitCode {
    let judgements = [judge::<f32>(), judge::<f64>(), judge::<BigRational>()];
    for judgement in &judgements {
        println!("{judgement}\n");
    }
    // The errors of floats grow like √L·u.
    for row in &judgements[0].growth {
        assert!(
            row.error_per_root_of_layers
                .is_some_and(|error| error < 1.5)
        );
    }
    let all_kept = judgements.iter().all(Judgement::keeps_promise);
    ExitCode::from(u8::from(!all_kept))
}
