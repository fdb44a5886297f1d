//! Samples: which stackings they are, and their dependence on the seed and the index only.

use cannonpile::lattice::{Region, Sign};
use cannonpile_disorder::{
    Choice, ContactSet, Ensemble, Error, FirstSign, RandomStackings, Samples, Shard, Tally,
};
use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::ratio;
use cannonpile_testkit::oracles::samples::sample;

fn big((a, b): (u64, u64)) -> BigRational {
    BigRational::new(a.into(), b.into())
}

/// Returns the signs of a sample of the library. It is the only one of its shard.
fn drawn(ensemble: &Ensemble, samples: &Samples, n: u64) -> Result<Vec<Sign>, Error> {
    let shard = Shard::new(n + 1, samples.count())?;
    let tally = ensemble.run(&Choice::Drawn(samples.clone()), shard)?;
    assert_eq!(tally.stackings(), 1_u32.into());
    let mut found = tally
        .faults
        .iter()
        .filter_map(|with| with.all.least.as_ref());
    let signs = found.next().unwrap().stacking.signs().collect();
    assert!(found.next().is_none());
    Ok(signs)
}

#[test]
fn samples_follow_the_documentation() -> Result<(), Error> {
    let cases = [
        (0, (1, 2), FirstSign::Random),
        (1, (1, 3), FirstSign::Plus),
        (u64::MAX, (5, 7), FirstSign::Minus),
        (77, (u64::MAX / 3, u64::MAX - 58), FirstSign::Random),
        // One word in four is discarded.
        (5, (1 << 62, (3 << 62) + 1), FirstSign::Random),
        (5, (0, 1), FirstSign::Random),
        (5, (1, 1), FirstSign::Random),
    ];
    for (seed, q, first) in cases {
        let ensemble = Ensemble::under(Region::SITE, RandomStackings::new(13, first)?)?;
        let samples = Samples::new(1 << 40, seed, big(q))?;
        let reduced = samples.fault_probability();
        let [a, b] = [reduced.numer(), reduced.denom()].map(|part| part.to_u64().unwrap());
        for n in [0, 1, 2, 3, 1000, (1 << 40) - 1] {
            let expected = sample(seed, n, (a, b), first, 12);
            assert_eq!(drawn(&ensemble, &samples, n)?, expected, "{seed} {n}");
        }
    }
    // The last possible sample.
    let ensemble = Ensemble::under(Region::SITE, RandomStackings::new(6, FirstSign::Random)?)?;
    let samples = Samples::new(u64::MAX, 3, big((1, 3)))?;
    for n in [u64::MAX - 1, u64::MAX - 8193] {
        let expected = sample(3, n, (1, 3), FirstSign::Random, 5);
        assert_eq!(drawn(&ensemble, &samples, n)?, expected, "{n}");
    }
    // Forty layers need more than one block of the keystream.
    let ensemble = Ensemble::under(Region::SITE, RandomStackings::new(40, FirstSign::Random)?)?;
    let samples = Samples::new(9, 4, big((1, 2)))?;
    assert_eq!(
        drawn(&ensemble, &samples, 8)?,
        sample(4, 8, (1, 2), FirstSign::Random, 39)
    );
    Ok(())
}

/// The tally of samples is the sum over the samples of the tallies of single stackings.
#[test]
fn repeated_samples_count_repeatedly() -> Result<(), Error> {
    let stackings = RandomStackings::new(6, FirstSign::Random)?;
    let ensemble = Ensemble::under("hexagon:2".parse()?, stackings)?;
    let samples = Samples::new(300, 9, ratio(1, 3))?;
    let choice = Choice::Drawn(samples.clone());
    let whole = ensemble.run(&choice, Shard::WHOLE)?;
    let single: Result<Vec<_>, Error> = (1..=300)
        .map(|n| ensemble.run(&choice, Shard::new(n, 300)?))
        .collect();
    assert_eq!(Tally::merge(&single?), Ok(whole.clone()));
    let mut faults = [0_u32; 5];
    let mut standing = 0_u32;
    for n in 0..300 {
        let signs = sample(9, n, (1, 3), FirstSign::Random, 5);
        faults[signs.windows(2).filter(|pair| pair[0] != pair[1]).count()] += 1;
        let stacking = cannonpile::stacking::Stacking::from_signs(signs)?;
        let stands = ensemble.pile(stacking)?.standing()?.first_failure.is_none();
        standing += u32::from(stands);
    }
    let found = whole.faults.iter().map(|with| with.all.stackings.clone());
    assert!(found.eq(faults.into_iter().map(Into::into)));
    assert_eq!(whole.standing(ContactSet::Sloping), Some(standing.into()));
    Ok(())
}

/// A few thousand samples approximate the exact value. The seed is fixed.
#[test]
fn intervals_contain_the_probability() -> Result<(), Error> {
    for (top, layers) in [("hexagon:1", 6), ("triangle:3", 7)] {
        let stackings = RandomStackings::new(layers, FirstSign::Random)?;
        let ensemble = Ensemble::under(top.parse()?, stackings)?;
        let all = ensemble.run(&Choice::All, Shard::WHOLE)?;
        for q in [ratio(1, 4), ratio(1, 2)] {
            let exact = all.standing_probability(ContactSet::Sloping, &q)?.unwrap();
            let drawn = Choice::Drawn(Samples::new(20_000, 3, q)?);
            let tally = ensemble.run(&drawn, Shard::WHOLE)?;
            let [lower, upper] = tally.standing_interval(ContactSet::Sloping).unwrap();
            let exact = exact.to_f64().unwrap();
            assert!(lower < exact && exact < upper, "{lower} {exact} {upper}");
            assert!(upper - lower < 0.02);
            assert_eq!(
                tally.standing_probability(ContactSet::Sloping, &ratio(1, 2))?,
                None
            );
            assert_eq!(all.standing_interval(ContactSet::Sloping), None);
        }
    }
    Ok(())
}

/// Numerators of 60 layers need 128 bits, and those of 90 layers need big integers.
#[test]
fn samples_of_high_piles() -> Result<(), Error> {
    for layers in [45, 60, 90] {
        let stackings = RandomStackings::new(layers, FirstSign::Plus)?;
        let ensemble = Ensemble::under(Region::SITE, stackings)?;
        let tally = ensemble.run(
            &Choice::Drawn(Samples::new(2, 1, ratio(1, 2))?),
            Shard::WHOLE,
        )?;
        for with in tally.faults.iter().filter(|with| with.all.least.is_some()) {
            let least = with.all.least.clone().unwrap();
            let pile = ensemble.pile(least.stacking)?;
            assert_eq!(pile.standing()?.least.unwrap().force, least.force);
        }
    }
    Ok(())
}
