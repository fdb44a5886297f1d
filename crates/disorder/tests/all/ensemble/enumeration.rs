//! Comparison of tallies with plain enumeration: each stacking is built as a pile, and its forces are computed one by
//! one.

use cannonpile::lattice::Region;
use cannonpile_disorder::{
    Choice, ContactSet, Ensemble, Error, FirstSign, RandomStackings, Samples, Shard,
};
use cannonpile_horizontal::certificate::Claim;
use cannonpile_stability::census;
use num_rational::BigRational;
use num_traits::Zero;

use super::{AnyError, held, ratio};
use cannonpile_testkit::tally::{Counted, Scene, all_signs, counted, text};

fn agrees_with_enumeration(case: &Scene, steps: u32) -> Result<(), Error> {
    let tally = case.ensemble(steps)?.run(&Choice::All, Shard::WHOLE)?;
    let expected = case.counted(steps)?;
    assert_eq!(counted(&tally), expected, "{:?} {steps}", case.anchor);
    Ok(())
}

const FIRST: [FirstSign; 3] = [FirstSign::Plus, FirstSign::Minus, FirstSign::Random];

#[test]
fn tallies_under_gravity_agree() -> Result<(), Error> {
    for (top, most) in [("hexagon:1", 7), ("hexagon:3", 5), ("triangle:3", 6)] {
        for first in FIRST {
            for steps in 0..=most {
                agrees_with_enumeration(&Scene::of(top, first), steps)?;
            }
        }
    }
    // This region does not contain the origin.
    for first in FIRST {
        agrees_with_enumeration(&Scene::of("region:-2..1,3..5,2..5", first), 4)?;
    }
    Ok(())
}

#[test]
fn tallies_with_loads_agree() -> Result<(), Error> {
    for first in FIRST {
        let mut case = Scene::of("hexagon:2", first);
        // A load in the middle is its own mirror image, and other loads are not.
        case.loads.push(([0, 0], ratio(5, 7)));
        case.width = ratio(2, 5);
        agrees_with_enumeration(&case, 5)?;
        case.loads.push(([1, 0], ratio(1, 4)));
        agrees_with_enumeration(&case, 5)?;
        case.loads.push(([-1, 0], ratio(1, 4)));
        agrees_with_enumeration(&case, 4)?;
        case.weightless = true;
        case.width = ratio(1, 24);
        agrees_with_enumeration(&case, 5)?;
        // No rotation maps these two to their mirror image.
        let mut case = Scene::of("hexagon:2", first);
        case.loads = [[1, 0], [0, 1]].map(|at| (at, ratio(1, 4))).into();
        agrees_with_enumeration(&case, 4)?;
    }
    Ok(())
}

/// A load with a large denominator leads to 128-bit numerators, and a larger one to big integers.
#[test]
fn tallies_in_wide_integers_agree() -> Result<(), Error> {
    for digits in [9, 18, 60] {
        let mut case = Scene::of("triangle:2", FirstSign::Random);
        let great = num_traits::pow(ratio(10, 1), digits) + ratio(1, 1);
        case.loads.push(([1, 0], ratio(3, 1) / great));
        agrees_with_enumeration(&case, 5)?;
    }
    Ok(())
}

/// For long stackings some stackings of the shard are checked.
#[test]
fn tallies_of_shards_agree() -> Result<(), Error> {
    let case = Scene::of("hexagon:1", FirstSign::Plus);
    let ensemble = case.ensemble(9)?;
    let (mut from, of) = (0, 7);
    let all = all_signs(9, FirstSign::Plus);
    for index in 1..=of {
        let tally = ensemble.run(&Choice::All, Shard::new(index, of)?)?;
        let to = all.len() * usize::try_from(index).unwrap() / 7;
        let mut expected: Vec<[Counted; 2]> = Vec::new();
        expected.resize_with(9, Default::default);
        for signs in &all[from..to] {
            let faults = signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
            let pile = case.pile(signs)?;
            let signs = text(signs.iter().copied());
            expected[faults][0].add(&pile, &signs, &case.width)?;
            if pile.standing()?.first_failure.is_none() {
                expected[faults][1].add(&pile, &signs, &case.width)?;
            }
        }
        assert_eq!(counted(&tally), expected, "{index}");
        from = to;
    }
    Ok(())
}

/// In the response to a load the greatest force is directly below the top layer, and it occurs only in stackings with
/// that beginning. So its first stacking is the first one of the shard with that beginning.
#[test]
fn tallies_of_shards_of_a_response_agree() -> Result<(), Error> {
    let mut scene = Scene::of("hexagon:1", FirstSign::Plus);
    scene.loads.push(([0, 0], ratio(1, 1)));
    scene.weightless = true;
    let steps = 6;
    let all = all_signs(steps, scene.first);
    for of in [2, 3, 5, 7] {
        for index in 1..=of {
            let shard = Shard::new(index, of)?;
            let tally = scene.ensemble(steps)?.run(&Choice::All, shard)?;
            let [from, to] = [index - 1, index].map(|part| all.len() as u64 * part / of);
            let [from, to] = [from, to].map(|end| usize::try_from(end).unwrap());
            let expected = scene.counted_of(steps, &all[from..to])?;
            assert_eq!(counted(&tally), expected, "{index} of {of}");
        }
    }
    Ok(())
}

#[test]
fn standing_counts_agree_with_the_census() -> Result<(), Error> {
    for layers in 1..=12 {
        let census = census::under_one_sphere(layers, false)?.count();
        for (first, pairs) in [
            (FirstSign::Plus, 1),
            (FirstSign::Minus, 1),
            (FirstSign::Random, if layers > 1 { 2 } else { 1 }),
        ] {
            let stackings = RandomStackings::new(layers, first)?;
            let tally =
                Ensemble::under(Region::SITE, stackings)?.run(&Choice::All, Shard::WHOLE)?;
            assert_eq!(
                tally.standing(ContactSet::Sloping),
                Some((census * pairs).into())
            );
            for (d, with) in (0..).zip(&tally.faults) {
                assert_eq!(with.all.stackings, stackings.count_with(d)?);
            }
            // At q = ½ all stackings are equally likely.
            let probability = tally.standing_probability(ContactSet::Sloping, &ratio(1, 2))?;
            let standing = BigRational::from_integer((census * pairs).into());
            let all = BigRational::from_integer(tally.stackings().into());
            assert_eq!(probability, Some(standing / all));
        }
    }
    Ok(())
}

#[test]
fn standing_probabilities_agree() -> Result<(), Error> {
    let q = ratio(2, 7);
    for first in FIRST {
        let case = Scene::of("triangle:3", first);
        let tally = case.ensemble(5)?.run(&Choice::All, Shard::WHOLE)?;
        let mut expected = BigRational::zero();
        for signs in all_signs(5, first) {
            if case.pile(&signs)?.standing()?.first_failure.is_none() {
                let factors = signs.windows(2).map(|pair| {
                    if pair[0] == pair[1] {
                        ratio(1, 1) - &q
                    } else {
                        q.clone()
                    }
                });
                expected += factors.product::<BigRational>();
            }
        }
        expected /= BigRational::from_integer(first.signs().len().into());
        let found = tally.standing_probability(ContactSet::Sloping, &q)?;
        assert_eq!(found, Some(expected), "{first}");
    }
    Ok(())
}

#[test]
fn counts_with_horizontal_contacts_agree() -> Result<(), AnyError> {
    for layers in 1..=9 {
        let stackings = RandomStackings::new(layers, FirstSign::Random)?;
        let ensemble = Ensemble::under(Region::SITE, stackings)?.with_horizontal_contacts()?;
        let tally = held(&ensemble, &Choice::All, Shard::WHOLE)?;
        let census = cannonpile_horizontal::census::under_one_sphere(layers, false)?.count();
        let pairs = if layers > 1 { 2 } else { 1 };
        assert_eq!(
            tally.standing(ContactSet::WithHorizontal),
            Some((census * pairs).into())
        );
    }
    // For another top layer each pile is computed on its own. The load is not its own mirror image.
    let mut case = Scene::of("triangle:2", FirstSign::Random);
    case.loads.push(([0, 0], ratio(1, 2)));
    let ensemble = case.ensemble(5)?.with_horizontal_contacts()?;
    let tally = held(&ensemble, &Choice::All, Shard::WHOLE)?;
    let mut held = vec![0_u32; 5];
    for signs in all_signs(5, FirstSign::Random) {
        let certificate = cannonpile_horizontal::equilibrium(&case.pile(&signs)?)?;
        if certificate.claim == Claim::Stands {
            held[signs.windows(2).filter(|pair| pair[0] != pair[1]).count()] += 1;
        }
    }
    let found = tally.faults.iter().map(|with| with.held.clone());
    assert!(found.eq(held.into_iter().map(|held| Some(held.into()))));
    Ok(())
}

/// Two layers have three contact forces of 1 and three normal forces of 4/3, all in bin 0. Three widths have to fit in
/// an integer.
#[test]
fn widths_of_bins_at_the_integer_limits() -> Result<(), Error> {
    for (width, exponent) in [
        (3, 18),
        (4, 18),
        (6, 18),
        (5, 37),
        (6, 37),
        (9, 37),
        (1, 60),
    ] {
        let width = num_traits::pow(ratio(10, 1), exponent) * ratio(width, 1);
        let stackings = RandomStackings::new(2, FirstSign::Plus)?;
        let ensemble = Ensemble::under(Region::SITE, stackings)?.with_bin_width(width.clone())?;
        let tally = ensemble.run(&Choice::All, Shard::WHOLE)?;
        let all = &tally.faults[0].all;
        for histogram in [&all.forces, &all.normals] {
            assert_eq!(histogram.first, 0, "{width}");
            assert_eq!(histogram.counts, [3_u32.into()], "{width}");
        }
    }
    Ok(())
}

/// The normal force of a single sphere has the numerator of three forces.
#[test]
fn loads_at_the_integer_limits() -> Result<(), Error> {
    for (load, exponent) in [(29, 17), (32, 17), (5, 37), (6, 37)] {
        let unit = num_traits::pow(ratio(10, 1), exponent);
        let stackings = RandomStackings::new(1, FirstSign::Plus)?;
        let ensemble = Ensemble::under(Region::SITE, stackings)?.weightless();
        let ensemble = ensemble.with_load([0, 0], &unit * ratio(load, 1))?;
        let tally = ensemble
            .with_bin_width(unit)?
            .run(&Choice::All, Shard::WHOLE)?;
        let normals = &tally.faults[0].all.normals;
        assert_eq!((normals.first, normals.counts.len()), (load, 1));
    }
    Ok(())
}

/// In units of its denominator the force exceeds a machine integer.
#[test]
fn load_with_a_large_denominator() -> Result<(), Error> {
    let stackings = RandomStackings::new(1, FirstSign::Plus)?;
    let ensemble = Ensemble::under(Region::SITE, stackings)?.weightless();
    let load = ratio(3_000_000_000, 1) + ratio(1, 10_000_000_019);
    let ensemble = ensemble.with_load([0, 0], load)?;
    let bins = ensemble.with_bin_width(ratio(1_000_000, 1))?;
    let tally = bins.run(&Choice::All, Shard::WHOLE)?;
    let normals = &tally.faults[0].all.normals;
    assert_eq!((normals.first, normals.counts.len()), (3_000, 1));
    Ok(())
}

/// No force of a single sphere exceeds 2. So 10⁵ bins from −2 to 2 have the width 1/25000. The normal force is 1.
#[test]
fn bins_are_limited() -> Result<(), Error> {
    let of = |width| {
        let stackings = RandomStackings::new(1, FirstSign::Plus)?;
        let ensemble = Ensemble::under(Region::SITE, stackings)?.with_bin_width(width)?;
        ensemble.run(&Choice::All, Shard::WHOLE)
    };
    let tally = of(ratio(1, 25_000))?;
    let normals = &tally.faults[0].all.normals;
    assert_eq!((normals.first, normals.counts.len()), (25_000, 1));
    let refused = of(ratio(1, 25_001)).unwrap_err();
    let Error::Core(cannonpile::Error::TooLarge { needed, limit, .. }) = refused else {
        panic!("there are too many bins");
    };
    assert_eq!((needed, limit), (100_004_u32.into(), 100_000));
    Ok(())
}

/// Returns the greatest number of spheres of each layer under one sphere. After p + steps and m − steps the layer is a
/// hexagon with sides of p + 1 and m + 1 spheres.
fn spheres(layers: u64) -> u64 {
    let hexagon = |p: u64, q: u64| (p * p + q * q + 4 * p * q + 2 - 3 * p - 3 * q) / 2;
    let most = |k: u64| (0..=k).map(|plus| hexagon(plus + 1, k - plus + 1)).max();
    (0..layers).map(|k| most(k).unwrap()).sum()
}

/// Each sphere stores six numbers, each as long as the bound of the forces.
#[test]
fn size_errors_state_the_size() -> Result<(), Error> {
    let one = Choice::Drawn(Samples::new(1, 1, ratio(1, 2))?);
    let needed = |ensemble: &Ensemble| match ensemble.size(&one, Shard::WHOLE) {
        Err(Error::Core(cannonpile::Error::TooLarge { needed, limit, .. })) => {
            assert_eq!(limit, 50_000_000);
            u64::try_from(needed).unwrap()
        }
        other => panic!("{other:?}"),
    };
    // A hexagon of side 4000 has 3·4000·3999 + 1 spheres.
    let stackings = RandomStackings::new(3, FirstSign::Plus)?;
    let wide = Ensemble::under("hexagon:4000".parse()?, stackings)?;
    assert_eq!(needed(&wide), 6 * (3 * 4000 * 3999 + 1));
    // The load is 2^−1640, the forces have 17 bits, and the sign changes need a factor of 3^108. This makes 28.5 words.
    // A list of them may have twice this length, and ten more words are needed to store it.
    let stackings = RandomStackings::new(110, FirstSign::Plus)?;
    let load = num_traits::pow(ratio(1, 2), 1640);
    let fine = Ensemble::under(Region::SITE, stackings)?.with_load([0, 0], load)?;
    assert_eq!(needed(&fine), 6 * spheres(110) * 66);
    Ok(())
}

#[test]
fn large_ensembles_are_rejected() -> Result<(), Error> {
    let run = |top: &str, layers, width, shard| {
        let stackings = RandomStackings::new(layers, FirstSign::Plus)?;
        let ensemble = Ensemble::under(top.parse()?, stackings)?.with_bin_width(width)?;
        ensemble.run(&Choice::All, shard)
    };
    for (top, layers, width, expected) in [
        (
            "hexagon:1",
            27,
            ratio(1, 3),
            "33554432 stackings exceed the limit of 16777216 for one run; draw samples, or use a smaller shard or fewer layers",
        ),
        ("hexagon:1", 200, ratio(1, 3), "stackings exceed the limit"),
        (
            "hexagon:1",
            10_i128.pow(30),
            ratio(1, 3),
            "use fewer layers, or a smaller top",
        ),
        (
            "hexagon:1e30",
            3,
            ratio(1, 3),
            "use fewer layers, or a smaller top",
        ),
        (
            "hexagon:1",
            9,
            ratio(1, 10_000),
            "use wider bins, or fewer layers",
        ),
    ] {
        let error = run(top, layers, width, Shard::WHOLE)
            .unwrap_err()
            .to_string();
        assert!(error.contains(expected), "{error}");
    }
    // A shard has the same limit as the whole of fewer layers.
    let part = run("hexagon:1", 30, ratio(1, 3), Shard::new(1, 1 << 22)?)?;
    assert_eq!(part.stackings(), 64_u32.into());
    assert_eq!(
        part.standing_probability(ContactSet::Sloping, &ratio(1, 2))?,
        None
    );
    Ok(())
}
