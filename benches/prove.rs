//! Measures the time of the proof of each theorem.
//!
//! `cargo bench --manifest-path benches/Cargo.toml --bench prove --features all`
//! asserts that all theorems hold, and prints milliseconds. With `-- --smoke` it proves each theorem once.

use std::env;
use std::hint::black_box;
use std::time::Instant;

use cannonpile::theorem::Proof;
use cannonpile_proof::Theorem;

fn main() {
    let smoke = env::args().any(|argument| argument == "--smoke");
    let repetitions = if smoke { 1 } else { 15 };

    println!("theorem          method     steps  terms   median (ms)");
    let mut all = 0.0;
    let mut slowest: Option<(f64, &str)> = None;
    for theorem in cannonpile_proof::all() {
        let (median, proof) = measure(&theorem, repetitions);
        let (name, method) = (theorem.name, theorem.method.name());
        println!(
            "{name:16} {method:9}  {:5}  {:5}  {median:12.3}",
            proof.steps.len(),
            terms(&proof)
        );
        all += median;
        if slowest.is_none_or(|(most, _)| median > most) {
            slowest = Some((median, name));
        }
    }
    println!("all              {all:39.3}");
    if let Some((most, name)) = slowest {
        println!("ratio {name}_over_all_proofs {:.2}", most / all);
    }
}

/// Returns the median time of a proof in milliseconds, and the proof.
fn measure(theorem: &Theorem, repetitions: usize) -> (f64, Proof) {
    let mut proof = theorem.prove();
    let mut times: Vec<f64> = (0..repetitions)
        .map(|_| {
            let start = Instant::now();
            proof = black_box(theorem).prove();
            let holds = black_box(&proof).holds();
            let time = start.elapsed().as_secs_f64() * 1e3;
            assert!(holds, "{} does not hold", theorem.name);
            time
        })
        .collect();
    times.sort_unstable_by(f64::total_cmp);
    (times[times.len() / 2], proof)
}

/// Returns the number of terms of all sides of the equations.
fn terms(proof: &Proof) -> usize {
    let sides = proof
        .steps
        .iter()
        .flat_map(|step| [&step.left, &step.right]);
    let signs = |text: &str| 1 + text.matches(" + ").count() + text.matches(" - ").count();
    sides.map(|side| signs(&side.to_string())).sum()
}
