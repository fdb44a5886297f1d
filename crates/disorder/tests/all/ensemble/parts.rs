//! Shards: any division merges into the whole, and errors name the tally that does not belong to the run.

use cannonpile_disorder::{
    Choice, Ensemble, Error, FirstSign, RandomStackings, Samples, Shard, Tally, Unmergeable,
};
use num_bigint::BigUint;
use num_rational::BigRational;

use super::{AnyError, held, ratio};

fn ensemble(top: &str, layers: i128) -> Result<Ensemble, Error> {
    Ensemble::under(
        top.parse()?,
        RandomStackings::new(layers, FirstSign::Random)?,
    )
}

fn drawn(count: u64, seed: u64, q: BigRational) -> Result<Choice, Error> {
    Ok(Choice::Drawn(Samples::new(count, seed, q)?))
}

#[test]
fn all_divisions_merge_into_the_whole() -> Result<(), Error> {
    let choices = [Choice::All, drawn(9000, 1, ratio(1, 3))?];
    for (top, layers) in [("hexagon:1", 10), ("triangle:2", 6), ("hexagon:1", 1)] {
        let ensemble = ensemble(top, layers)?;
        for choice in &choices {
            let whole = ensemble.run(choice, Shard::WHOLE)?;
            for of in [1, 2, 3, 5, 64, 700] {
                let parts = (1..=of).map(|index| ensemble.run(choice, Shard::new(index, of)?));
                let mut parts = parts.collect::<Result<Vec<_>, _>>()?;
                // Merging accepts the shards in any order.
                parts.sort_by_key(|part| part.shard.index() * 389 % of);
                assert_eq!(Tally::merge(&parts).as_ref(), Ok(&whole), "{top} {of}");
            }
        }
    }
    Ok(())
}

/// If there are more shards than samples, some shards are empty. A single layer works too.
#[test]
fn empty_shards_merge() -> Result<(), Error> {
    for layers in [1, 2, 4] {
        let ensemble = ensemble("hexagon:1", layers)?;
        for choice in [Choice::All, drawn(2, 1, ratio(1, 3))?] {
            let whole = ensemble.run(&choice, Shard::WHOLE)?;
            let parts = (1..=33).map(|index| ensemble.run(&choice, Shard::new(index, 33)?));
            let parts = parts.collect::<Result<Vec<_>, _>>()?;
            let nothing = parts.iter().filter(|part| part.stackings() == 0_u32.into());
            assert!(nothing.clone().count() >= 25);
            for with in nothing.flat_map(|part| &part.faults) {
                assert!(with.all.normals.counts.is_empty() && with.all.least_normal.is_none());
            }
            assert_eq!(Tally::merge(&parts), Ok(whole), "{layers}");
        }
    }
    Ok(())
}

#[test]
fn foreign_tallies_are_rejected() -> Result<(), Error> {
    let load = |ensemble: Ensemble| ensemble.with_load([0, 0], ratio(1, 2));
    let this = || load(ensemble("hexagon:2", 4)?);
    let choice = drawn(90, 7, ratio(1, 3))?;
    let first = Shard::new(1, 3)?;
    let second = Shard::new(2, 3)?;
    let begin = this()?.run(&choice, first)?;
    let others: [(Ensemble, Choice, Shard, [&str; 3]); 10] = [
        (
            load(ensemble("hexagon:2", 5)?)?,
            choice.clone(),
            second,
            ["number of layers", "5", "4"],
        ),
        (
            load(Ensemble::under(
                "hexagon:2".parse()?,
                RandomStackings::new(4, FirstSign::Minus)?,
            )?)?,
            choice.clone(),
            second,
            ["first sign", "-", "random"],
        ),
        (
            load(ensemble("hexagon:3", 4)?)?,
            choice.clone(),
            second,
            ["top", "hexagon:3", "hexagon:2"],
        ),
        (
            load(this()?)?,
            choice.clone(),
            second,
            ["load", "0,0=1", "0,0=1/2"],
        ),
        (
            this()?.weightless(),
            choice.clone(),
            second,
            ["weight of spheres", "0", "1"],
        ),
        (
            this()?.with_bin_width(ratio(1, 2))?,
            choice.clone(),
            second,
            ["width of bins", "1/2", "1/3"],
        ),
        (
            this()?,
            Choice::All,
            second,
            ["number of samples", "none", "90"],
        ),
        (
            this()?,
            drawn(90, 8, ratio(1, 3))?,
            second,
            ["seed", "8", "7"],
        ),
        (
            this()?,
            drawn(90, 7, ratio(1, 4))?,
            second,
            ["fault probability", "1/4", "1/3"],
        ),
        (
            this()?,
            choice.clone(),
            Shard::new(2, 4)?,
            ["number of parts", "4", "3"],
        ),
    ];
    for (ensemble, choice, shard, [name, has, of_first]) in others {
        let other = ensemble.run(&choice, shard)?;
        let refused = Tally::merge(&[begin.clone(), other]).unwrap_err();
        assert!(refused.to_string().contains(name), "{refused}");
        let Unmergeable::Other {
            place,
            what,
            found,
            expected,
        } = refused
        else {
            panic!("{refused}");
        };
        assert_eq!(
            (place, what, found.as_str(), expected.as_str()),
            (1, name, has, of_first)
        );
    }
    Ok(())
}

/// Of T stackings the shard I of N ends before the index ⌊TI/N⌋. T is 128 if mirror images have the same forces,
/// because one of each pair is computed. All samples are computed.
#[test]
fn sizes_of_shards() -> Result<(), Error> {
    let sizes = |top: &str, choice: &Choice, of: u64| -> Result<Vec<u64>, Error> {
        let ensemble = ensemble(top, 9)?;
        let size = |index| ensemble.size(choice, Shard::new(index, of)?);
        (1..=of).map(size).collect()
    };
    let drawn = drawn(100, 1, ratio(1, 3))?;
    for (top, choice, of, expected) in [
        ("hexagon:1", &Choice::All, 3, vec![42, 43, 43]),
        ("hexagon:1", &Choice::All, 4, vec![32; 4]),
        ("triangle:2", &Choice::All, 3, vec![85, 85, 86]),
        ("hexagon:1", &drawn, 3, vec![33, 33, 34]),
    ] {
        assert_eq!(sizes(top, choice, of)?, expected, "{top}");
    }
    Ok(())
}

/// For each list of sites with a load: whether the top layer is its own mirror image. Then 8 of 16 stackings are
/// computed.
#[test]
fn mirror_symmetry_of_loads() -> Result<(), Error> {
    let hexagon = "hexagon:2";
    let elsewhere = "region:1..3,-6..-4,-4..-2";
    let same: [(&str, &[[i128; 2]]); 6] = [
        (hexagon, &[]),
        (hexagon, &[[0, 0]]),
        (hexagon, &[[1, 0], [-1, 0]]),
        (hexagon, &[[0, 1], [0, -1], [1, -1], [-1, 1]]),
        (elsewhere, &[[2, -5]]),
        (elsewhere, &[[3, -5], [1, -5], [2, -4], [2, -6]]),
    ];
    let other: [(&str, &[[i128; 2]]); 7] = [
        (hexagon, &[[1, 0]]),
        (hexagon, &[[0, 1]]),
        (hexagon, &[[1, 0], [0, 1], [-1, 0]]),
        (hexagon, &[[0, 1], [1, 0], [0, -1]]),
        (elsewhere, &[[3, -5]]),
        (elsewhere, &[[2, -4]]),
        ("triangle:2", &[]),
    ];
    let looked_at = |(top, sites): (&str, &[[i128; 2]]), last: BigRational| -> Result<u64, Error> {
        let mut ensemble = ensemble(top, 5)?;
        for (n, site) in sites.iter().enumerate() {
            let is_last = n + 1 == sites.len();
            let load = if is_last { last.clone() } else { ratio(1, 2) };
            ensemble = ensemble.with_load(*site, load)?;
        }
        ensemble.size(&Choice::All, Shard::WHOLE)
    };
    for (top, sites) in same {
        assert_eq!(looked_at((top, sites), ratio(1, 2))?, 8, "{top} {sites:?}");
        // The same number of loads, but one load differs.
        let expected = if sites.len() > 1 { 16 } else { 8 };
        let found = looked_at((top, sites), ratio(1, 3))?;
        assert_eq!(found, expected, "{top} {sites:?}");
    }
    for (top, sites) in other {
        assert_eq!(looked_at((top, sites), ratio(1, 2))?, 16, "{top} {sites:?}");
    }
    Ok(())
}

/// Indices of stackings are limited to 62 bits. Beyond that even a small shard is rejected.
#[test]
fn size_of_shards_is_limited() {
    let size = |layers, of| {
        let stackings = RandomStackings::new(layers, FirstSign::Plus)?;
        let ensemble = Ensemble::under("hexagon:1".parse()?, stackings)?;
        ensemble.size(&Choice::All, Shard::new(1, of)?)
    };
    assert_eq!(size(63, 1 << 45), Ok(1 << 16));
    let refused = |layers, of, expected: u128| {
        let refused = size(layers, of).unwrap_err();
        let Error::TooManyStackings {
            stackings, limit, ..
        } = refused
        else {
            panic!("{refused:?}");
        };
        assert_eq!((stackings, limit), (BigUint::from(expected), 1 << 24));
    };
    refused(64, 1 << 45, 1 << 62);
    refused(80, 1 << 63, 1 << 78);
    // The largest possible shard, and one that is larger by one.
    assert_eq!(size(26, 1), Ok(1 << 24));
    assert_eq!(size(27, 2), Ok(1 << 24));
    refused(27, 1, 1 << 25);
    refused(31, 31, (1 << 29) / 31);
}

/// The message names the first twenty missing shards.
#[test]
fn errors_name_twenty_missing_parts() -> Result<(), Error> {
    for (of, names) in [(2, 1), (3, 2), (21, 20), (22, 20), (40, 20)] {
        let part = ensemble("hexagon:1", 3)?.run(&Choice::All, Shard::new(1, of)?)?;
        let missing = Tally::merge(&[part]).unwrap_err();
        let named: Vec<_> = (2..names + 2)
            .map(|index| format!("{index}/{of}"))
            .collect();
        let (count, more) = (of - 1, if of > 21 { ", …" } else { "" });
        let parts = if count == 1 { "part is" } else { "parts are" };
        let expected = format!(
            "{count} {parts} missing, {}{more}: run ensemble with --shard for each, and add its file",
            named.join(", ")
        );
        assert_eq!(missing.to_string(), expected);
    }
    Ok(())
}

#[test]
fn missing_and_repeated_parts_are_named() -> Result<(), Error> {
    let part = |index| ensemble("hexagon:2", 4)?.run(&Choice::All, Shard::new(index, 3)?);
    let begin = part(1)?;
    let third = part(3)?;
    let missing = Tally::merge(&[third.clone(), begin.clone()]).unwrap_err();
    assert_eq!(
        missing,
        Unmergeable::Missing {
            shards: vec![Shard::new(2, 3)?],
            count: 1
        }
    );
    assert!(
        missing
            .to_string()
            .starts_with("1 part is missing, 2/3: run ensemble with --shard")
    );
    let twice = Tally::merge(&[third.clone(), begin.clone(), third.clone()]).unwrap_err();
    assert_eq!(
        twice,
        Unmergeable::Twice {
            place: 2,
            shard: third.shard
        }
    );
    assert_eq!(Tally::merge(&[]), Err(Unmergeable::Nothing));
    Ok(())
}

/// A histogram with impossible bins can be read without overflow.
#[test]
fn bins_at_the_integer_limits() -> Result<(), Error> {
    let mut tally = ensemble("triangle:1", 2)?.run(&Choice::All, Shard::WHOLE)?;
    let bins = &mut tally.faults[0].all.forces;
    bins.first = i64::MAX;
    bins.counts = vec![4_u32.into(); 2];
    let last = i128::from(i64::MAX) + 1;
    let counts = [last - 2, last - 1, last, last + 1].map(|bin| bins.count(bin));
    assert_eq!(counts, [0_u32, 4, 4, 0].map(Into::into));
    Ok(())
}

#[test]
fn another_spacing_is_rejected() -> Result<(), AnyError> {
    let part = |index| -> Result<_, Error> {
        ensemble("hexagon:1", 5)?.run(&Choice::All, Shard::new(index, 2)?)
    };
    let touching = ensemble("hexagon:1", 5)?.with_horizontal_contacts()?;
    let other = held(&touching, &Choice::All, Shard::new(2, 2)?)?;
    let refused = Tally::merge(&[part(1)?, other]).unwrap_err();
    assert!(
        refused
            .to_string()
            .starts_with("the spacing is 1, but above 1 in the first part;")
    );
    let parts =
        [1, 2].map(|index| held(&touching, &Choice::All, Shard::new(index, 2).unwrap()).unwrap());
    assert_eq!(
        Tally::merge(&parts),
        Ok(held(&touching, &Choice::All, Shard::WHOLE)?)
    );
    Ok(())
}
