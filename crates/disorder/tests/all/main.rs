//! Fixed and exhaustive tests of random stackings, with a file for each subject.
//!
//! Random tests are in `tests/properties.rs`. The oracles are in `cannonpile_testkit`.

mod denominators;
mod ensemble_of_stackings;
mod enumeration;
mod errors;
mod few_faults;
mod mean_squares;
mod response_moments;
mod squares;
mod sums;
mod widths;

mod ensemble {
    mod altered;
    mod bases;
    mod enumeration;
    mod parts;
    mod samples;

    use cannonpile::Pile;
    use cannonpile_disorder::{Choice, Ensemble, Shard, Tally};
    use cannonpile_horizontal::certificate::Claim;
    use cannonpile_horizontal::equilibrium;
    use num_rational::BigRational;

    /// An error of any crate.
    type AnyError = Box<dyn std::error::Error + Send + Sync>;

    fn ratio(n: i64, d: i64) -> BigRational {
        BigRational::new(n.into(), d.into())
    }

    /// Returns the tally of an ensemble with horizontal contacts. A certificate decides the stability of each pile.
    fn held(ensemble: &Ensemble, choice: &Choice, shard: Shard) -> Result<Tally, AnyError> {
        let judge = |pile: &Pile| Ok(equilibrium(pile)?.claim == Claim::Stands);
        ensemble.run_judged(choice, shard, &|_| {}, &judge)
    }
}
