//! The fixed and the exhaustive tests of random stackings, a file for each subject.
//!
//! Random tests are in `tests/properties.rs`. The oracles are those of `cannonpile_testkit`.

mod denominators;
mod ensemble_of_stackings;
mod enumeration;
mod few_faults;
mod moments;
mod refused;
mod spread;
mod squares;
mod sums;
mod widths;

mod ensemble {
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

    /// The tally of an ensemble with horizontal contacts: for each pile a certificate says whether they hold it.
    fn held(ensemble: &Ensemble, choice: &Choice, shard: Shard) -> Result<Tally, AnyError> {
        let judge = |pile: &Pile| Ok(equilibrium(pile)?.claim == Claim::Stands);
        ensemble.run_judged(choice, shard, &|_| {}, &judge)
    }
}

mod theorem;
