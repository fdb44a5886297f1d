//! Ensembles on a base: comparison with plain enumeration, where each stacking is built as a pile on the base.

use cannonpile::lattice::Region;
use cannonpile_disorder::{
    Choice, ContactSet, Ensemble, Error, FirstSign, RandomPiles, RandomStackings, Samples, Shard,
    Tally, TallyRecord, Unmergeable,
};
use cannonpile_horizontal::certificate::Claim;
use cannonpile_stability::census;
use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::{One, Zero, pow};

use super::{AnyError, held, ratio};
use cannonpile_testkit::oracles::samples::sample;
use cannonpile_testkit::tally::{Scene, all_signs, counted};

const FIRST: [FirstSign; 3] = [FirstSign::Plus, FirstSign::Minus, FirstSign::Random];

/// Bases. Most have spheres that no layer above needs.
const BASES: [&str; 8] = [
    "hexagon:1",
    "hexagon:4",
    "hexagon:3,2",
    "hexagon:2,5",
    "triangle:6",
    "hexagon:1,5",
    // This region does not contain the origin.
    "region:-1..4,3..6,2..9",
    // A parallelogram.
    "region:0..2,0..3,0..5",
];

fn whole(scene: &Scene, steps: u32) -> Result<Tally, Error> {
    scene.ensemble(steps)?.run(&Choice::All, Shard::WHOLE)
}

fn agrees_with_enumeration(scene: &Scene, steps: u32) -> Result<(), Error> {
    let all = all_signs(steps, scene.first);
    let expected = scene.counted_of(steps, &all)?;
    let tally = match whole(scene, steps) {
        Err(Error::NoStacking { greatest, .. }) => {
            assert!(greatest <= i128::from(steps), "{scene:?} {steps}");
            assert!(all.iter().all(|signs| scene.pile(signs).is_err()));
            return Ok(());
        }
        tally => tally?,
    };
    assert_eq!(counted(&tally), expected, "{scene:?} {steps}");
    let left_out = all.iter().filter(|signs| scene.pile(signs).is_err());
    assert_eq!(tally.left_out(), Some(left_out.count().into()));
    assert!(tally.stackings() > BigUint::zero());
    Ok(())
}

#[test]
fn tallies_agree() -> Result<(), Error> {
    for base in BASES {
        for first in FIRST {
            for steps in 0..=7 {
                agrees_with_enumeration(&Scene::on(base, first), steps)?;
            }
        }
    }
    Ok(())
}

#[test]
fn tallies_without_weight_and_in_wide_integers_agree() -> Result<(), Error> {
    let mut scene = Scene::on("hexagon:4", FirstSign::Random);
    scene.weightless = true;
    agrees_with_enumeration(&scene, 5)?;
    scene.weightless = false;
    // Widths with large denominators lead to 128-bit numerators and to big integers.
    for digits in [15, 60] {
        let great = pow(ratio(10, 1), digits);
        scene.width = (&great + ratio(1, 1)) / &great;
        agrees_with_enumeration(&scene, 5)?;
    }
    Ok(())
}

#[test]
fn tallies_of_shards_and_samples_agree() -> Result<(), Error> {
    let steps = 5;
    for first in [FirstSign::Plus, FirstSign::Minus] {
        let scene = Scene::on("hexagon:3,4", first);
        let ensemble = scene.ensemble(steps)?;
        let all = all_signs(steps, first);
        for of in [2, 3, 7] {
            for index in 1..=of {
                let tally = ensemble.run(&Choice::All, Shard::new(index, of)?)?;
                let ends = [index - 1, index].map(|part| all.len() as u64 * part / of);
                let [from, to] = ends.map(|end| usize::try_from(end).unwrap());
                let expected = scene.counted_of(steps, &all[from..to])?;
                assert_eq!(counted(&tally), expected, "{first}: {index} of {of}");
            }
        }
    }
    let scene = Scene::on("hexagon:3,4", FirstSign::Random);
    let choice = Choice::Drawn(Samples::new(90, 4, ratio(2, 5))?);
    let tally = scene.ensemble(steps)?.run(&choice, Shard::WHOLE)?;
    let drawn = (0..90).map(|n| sample(4, n, (2, 5), scene.first, steps as usize));
    let drawn: Vec<_> = drawn.collect();
    assert_eq!(counted(&tally), scene.counted_of(steps, &drawn)?);
    let left_out = tally.left_out().unwrap();
    assert!(left_out > BigUint::zero());
    assert_eq!(tally.stackings() + left_out, 90_u32.into());
    Ok(())
}

#[test]
fn standing_counts_agree_with_the_census() -> Result<(), Error> {
    for base in ["hexagon:4", "triangle:8", "hexagon:3,5"] {
        let base: Region = base.parse()?;
        let piles = census::on_base(base)?.collect::<Result<Vec<_>, _>>()?;
        let layers = piles.iter().map(|entry| entry.pile.layers());
        let most = layers.max().unwrap();
        // No stacking of the greatest height can be continued, so the census lists all of them.
        let highest = piles
            .iter()
            .filter(|entry| entry.pile.layers() == most && entry.stands());
        let stackings = RandomStackings::new(most, FirstSign::Random)?;
        let tally = Ensemble::on(base, stackings)?.run(&Choice::All, Shard::WHOLE)?;
        // Of two mirror images the census lists one.
        let images = if base.is_its_own_mirror_image() { 2 } else { 1 };
        let standing = tally.standing(ContactSet::Sloping);
        assert_eq!(standing, Some((highest.count() * images).into()), "{base}");
    }
    Ok(())
}

#[test]
fn counts_with_horizontal_contacts_agree() -> Result<(), AnyError> {
    // On the second base a pile is stable only with horizontal contacts.
    for (base, steps) in [("triangle:6", 4), ("hexagon:3,4", 5)] {
        let scene = Scene::on(base, FirstSign::Random);
        let ensemble = scene.ensemble(steps)?.with_horizontal_contacts()?;
        let tally = held(&ensemble, &Choice::All, Shard::WHOLE)?;
        let mut held = vec![0_u32; steps as usize];
        for signs in all_signs(steps, FirstSign::Random) {
            let Ok(pile) = scene.pile(&signs) else {
                continue;
            };
            if cannonpile_horizontal::equilibrium(&pile)?.claim == Claim::Stands {
                held[signs.windows(2).filter(|pair| pair[0] != pair[1]).count()] += 1;
            }
        }
        let found = tally.faults.iter().map(|with| with.held.clone());
        assert!(found.eq(held.into_iter().map(|held| Some(held.into()))));
        let [sloping, all] = [ContactSet::Sloping, ContactSet::WithHorizontal]
            .map(|set| tally.standing(set).unwrap());
        assert_eq!(sloping < all, base == "hexagon:3,4");
    }
    Ok(())
}

/// Probabilities are those of a stacking that the base supports.
#[test]
fn means_are_over_supported_stackings() -> Result<(), Error> {
    let (steps, base) = (4, "hexagon:2,5");
    let q = ratio(2, 7);
    for first in FIRST {
        let scene = Scene::on(base, first);
        let tally = whole(&scene, steps)?;
        let [mut supported, mut standing] = [BigRational::zero(), BigRational::zero()];
        for signs in all_signs(steps, first) {
            let Ok(pile) = scene.pile(&signs) else {
                continue;
            };
            let faults = signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
            let share = pow(q.clone(), faults) * pow(ratio(5, 7), steps as usize - 1 - faults);
            if pile.standing()?.first_failure.is_none() {
                standing += &share;
            }
            supported += share;
        }
        let found = tally.standing_probability(ContactSet::Sloping, &q)?;
        assert_eq!(found, Some(&standing / &supported), "{first}");
        let weights = tally.weights(&q)?.unwrap();
        let terms = weights.iter().zip(&tally.faults);
        let terms = terms.map(|(weight, with)| weight * integer(&with.all.stackings));
        assert_eq!(terms.sum::<BigRational>(), BigRational::one());
    }
    Ok(())
}

/// The recursion of the mean weighs the stackings that the base supports in the same way.
#[test]
fn supported_share_agrees_with_the_mean() -> Result<(), Error> {
    for base in ["hexagon:4", "triangle:6", "hexagon:2,5"] {
        for first in FIRST {
            let (base, q) = (base.parse()?, ratio(3, 8));
            let stackings = RandomStackings::new(5, first)?;
            let mean = RandomPiles::on(base, stackings).exact(&q)?;
            let tally = Ensemble::on(base, stackings)?.run(&Choice::All, Shard::WHOLE)?;
            let firsts = BigRational::from_integer(first.signs().len().into());
            let share = |d: usize| pow(q.clone(), d) * pow(ratio(5, 8), 3 - d) / &firsts;
            let over = |count: fn(&cannonpile_disorder::WithFaults) -> BigRational| {
                let terms = tally.faults.iter().enumerate();
                terms
                    .map(|(d, with)| share(d) * count(with))
                    .sum::<BigRational>()
            };
            let supported = over(|with| integer(&with.all.stackings));
            let rows = mean.rows();
            assert!(
                rows.iter().all(|row| row.probability == supported),
                "{base}"
            );
            // Each stacking has three contacts for each sphere that is not in the base.
            let spheres = over(|with| {
                let of_base = integer(&with.all.normals.total());
                integer(&with.all.contacts) / ratio(3, 1) + of_base
            });
            let weight = rows.iter().map(|row| row.normal.clone());
            assert_eq!(weight.sum::<BigRational>(), spheres, "{base} {first}");
        }
    }
    Ok(())
}

fn integer(count: &BigUint) -> BigRational {
    BigRational::from_integer(count.clone().into())
}

#[test]
fn no_supported_stacking_occurs() -> Result<(), Error> {
    // Of two stackings the triangle supports ++ only, which does not occur in HCP.
    let ensemble = Ensemble::on(
        Region::triangle(3)?,
        RandomStackings::new(3, FirstSign::Plus)?,
    )?;
    let tally = ensemble.run(&Choice::All, Shard::WHOLE)?;
    assert_eq!(tally.weights(&ratio(1, 1))?, None);
    let probability = |q| tally.standing_probability(ContactSet::Sloping, &q);
    assert_eq!(probability(ratio(1, 1))?, None);
    assert_eq!(probability(ratio(999, 1000))?, Some(ratio(1, 1)));
    let drawn = Choice::Drawn(Samples::new(5, 1, ratio(1, 1))?);
    let tally = ensemble.run(&drawn, Shard::WHOLE)?;
    assert_eq!(tally.left_out(), Some(5_u32.into()));
    assert_eq!(tally.stackings(), BigUint::zero());
    assert_eq!(tally.weights(&ratio(1, 1))?, None);
    assert_eq!(tally.standing_interval(ContactSet::Sloping), None);
    Ok(())
}

#[test]
fn parts_merge_into_the_whole_and_other_layers_are_rejected() -> Result<(), Error> {
    let of = |base: &str, first| Scene::on(base, first).ensemble(4);
    let ensemble = of("hexagon:4", FirstSign::Random)?;
    let drawn = Choice::Drawn(Samples::new(9000, 1, ratio(1, 3))?);
    for choice in [Choice::All, drawn] {
        let whole = ensemble.run(&choice, Shard::WHOLE)?;
        for parts in [1, 3, 64] {
            let parts = (1..=parts).rev().map(|part| {
                let tally = ensemble.run(&choice, Shard::new(part, parts)?)?;
                TallyRecord::new(tally, ratio(1, 3))
            });
            let parts = parts.collect::<Result<Vec<_>, _>>()?;
            let whole = TallyRecord::new(whole.clone(), ratio(1, 3))?;
            assert_eq!(TallyRecord::merge(&parts), Ok(whole));
        }
    }
    let run = |ensemble: Ensemble, part| ensemble.run(&Choice::All, Shard::new(part, 2)?);
    let begin = run(ensemble, 1)?;
    let under = Scene::of("hexagon:4", FirstSign::Random).ensemble(4)?;
    for (other, expected) in [
        (under, ["top", "hexagon:4", "none"]),
        (
            of("hexagon:3", FirstSign::Random)?,
            ["base", "hexagon:3", "hexagon:4"],
        ),
    ] {
        let refused = Tally::merge(&[begin.clone(), run(other, 2)?]).unwrap_err();
        let Unmergeable::Other {
            what,
            found,
            expected: of_first,
            ..
        } = refused
        else {
            panic!("{refused}");
        };
        assert_eq!([what, &found, &of_first], expected);
    }
    Ok(())
}

#[test]
fn a_record_names_one_layer() -> Result<(), Box<dyn std::error::Error>> {
    let ensemble = Scene::on("hexagon:3,2", FirstSign::Plus).ensemble(3)?;
    let text = serde_json::to_string(&ensemble)?;
    assert!(text.contains(r#""base":"hexagon:3,2""#) && !text.contains("top"));
    assert_eq!(serde_json::from_str::<Ensemble>(&text)?, ensemble);
    for (changed, expected) in [
        (
            r#""base":"hexagon:3,2","top":"hexagon:1""#,
            "either a top or a base",
        ),
        (r#""base":null"#, "either a top or a base"),
        (r#""base":"hexagon""#, "hexagon"),
        (r#""floor":"hexagon:3,2""#, "unknown field `floor`"),
    ] {
        let changed = text.replace(r#""base":"hexagon:3,2""#, changed);
        let refused = serde_json::from_str::<Ensemble>(&changed).unwrap_err();
        assert!(refused.to_string().contains(expected), "{refused}");
    }
    Ok(())
}

#[test]
fn unsuitable_bases_are_rejected() -> Result<(), Error> {
    let run = |base: &str, layers, first| {
        let stackings = RandomStackings::new(layers, first)?;
        Ensemble::on(base.parse()?, stackings)?.run(&Choice::All, Shard::WHOLE)
    };
    for (base, layers, first, expected) in [
        (
            "hexagon:3",
            6,
            FirstSign::Random,
            "supports at most 5 layers, not 6",
        ),
        // On this triangle all four-layer stackings begin with +.
        (
            "triangle:4",
            4,
            FirstSign::Minus,
            "supports at most 3 layers, not 4",
        ),
        (
            "hexagon:3",
            10_i128.pow(36),
            FirstSign::Plus,
            "supports at most 5 layers, not 10",
        ),
        (
            "hexagon:1e30",
            3,
            FirstSign::Plus,
            "use fewer layers, or a smaller base",
        ),
        (
            "hexagon:500",
            400,
            FirstSign::Plus,
            "use fewer layers, or a smaller base",
        ),
    ] {
        let error = run(base, layers, first).unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
    }
    // The limit of stackings holds for supported ones and others together.
    let error = run("hexagon:40", 30, FirstSign::Plus).unwrap_err();
    assert!(matches!(error, Error::TooManyStackings { .. }), "{error}");
    let loaded = Ensemble::on(
        Region::hexagon(3, 3)?,
        RandomStackings::new(3, FirstSign::Plus)?,
    )?
    .with_load([0, 0], ratio(1, 1));
    assert!(matches!(
        loaded,
        Err(Error::PlaceOfLoad { on_base: true, .. })
    ));
    Ok(())
}
