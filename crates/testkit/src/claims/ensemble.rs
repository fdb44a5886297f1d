//! A tally of an ensemble equals a plain enumeration. The tallies of all parts merge into the whole, for any partition.

use arbitrary::Unstructured;
use cannonpile::lattice::Sign;
use cannonpile_disorder::{Choice, Error, FirstSign, Samples, Shard, Tally};
use num_traits::ToPrimitive;

use super::{Checked, Failure, demand, same};
use crate::generators::ensemble;
use crate::oracles::samples;
use crate::tally::{Scene, all_signs, counted};

/// Compares every count, sum and extreme, for all stackings or for samples.
pub fn counts(u: &mut Unstructured<'_>) -> Checked {
    let (scene, steps) = ensemble::scene(u)?;
    let choice = ensemble::choice(u)?;
    let tally = scene.ensemble(steps)?.run(&choice, Shard::WHOLE)?;
    is_as_enumerated(&scene, steps, &choice, &tally)
}

fn is_as_enumerated(scene: &Scene, steps: u32, choice: &Choice, tally: &Tally) -> Checked {
    let stackings = match choice {
        Choice::All => all_signs(steps, scene.first),
        Choice::Drawn(samples) => drawn(samples, scene.first, steps),
    };
    let expected = scene.counted_of(steps, &stackings)?;
    let contents = |of: &Tally| {
        (
            counted(of),
            of.stackings() + of.left_out().unwrap_or_default(),
        )
    };
    let all = stackings.len().into();
    same("a tally", &contents(tally), &(expected, all))
}

/// The signs of each sample, by the definition.
fn drawn(samples: &Samples, first: FirstSign, steps: u32) -> Vec<Vec<Sign>> {
    let q = samples.fault_probability();
    let [a, b] = [q.numer(), q.denom()].map(|part| part.to_u64().expect("32 bits"));
    let signs = |n| samples::sample(samples.seed(), n, (a, b), first, steps as usize);
    (0..samples.count()).map(signs).collect()
}

/// Splits an ensemble into any number of parts and merges them in any order.
pub fn parts(u: &mut Unstructured<'_>) -> Checked {
    let (scene, steps) = ensemble::scene(u)?;
    let choice = ensemble::choice(u)?;
    let ensemble = scene.ensemble(steps)?;
    let of = u.int_in_range(1..=40)?;
    let run = |index| ensemble.run(&choice, Shard::new(index, of)?);
    let mut parts = (1..=of).map(run).collect::<Result<Vec<_>, Error>>()?;
    for last in (1..parts.len()).rev() {
        parts.swap(last, u.int_in_range(0..=last)?);
    }
    let whole = ensemble.run(&choice, Shard::WHOLE)?;
    merge_into(&parts, &whole)?;
    // First one part is missing, then one part occurs twice.
    let without = parts.pop();
    let refused = Tally::merge(&parts);
    demand(refused.is_err(), || format!("merged without {without:?}"))?;
    parts.extend(without.iter().cloned().chain(without.clone()));
    demand(Tally::merge(&parts).is_err(), || {
        format!("merged with {without:?} twice")
    })
}

fn merge_into(parts: &[Tally], whole: &Tally) -> Checked {
    match Tally::merge(parts) {
        Ok(merged) => same("the merged tally", &merged, whole),
        Err(refused) => Err(Failure::Refuted(format!("{refused:?}: {parts:?}"))),
    }
}

/// A written file reads back the same. After some letters are replaced, it is rejected, or it is a tally that a run
/// could have written. This holds for the file alone, and merged with the other part.
pub fn damaged(u: &mut Unstructured<'_>) -> Checked {
    use cannonpile_disorder::TallyRecord;

    let refuted = |what: &str| Failure::Refuted(what.to_owned());
    let (scene, steps) = ensemble::scene(u)?;
    let choice = ensemble::choice(u)?;
    let ensemble = scene.ensemble(steps)?;
    let q = crate::generators::number::ratio(1, 3);
    let part = |index| TallyRecord::new(ensemble.run(&choice, Shard::new(index, 2)?)?, q.clone());
    let (one, other) = (part(1)?, part(2)?);
    let written = |record: &TallyRecord| {
        let mut text = Vec::new();
        let done = record.write(&mut text);
        done.map_err(|error| Failure::Refuted(error.to_string()))?;
        Ok::<_, Failure>(text)
    };
    let mut text = written(&one)?;
    let read = TallyRecord::read(&*text).map_err(|error| refuted(&error.to_string()))?;
    same("the value read back", &read, &one)?;
    for _ in 0..u.int_in_range(1..=3)? {
        let place = u.choose_index(text.len())?;
        if let Some(letter) = text.get_mut(place) {
            *letter = *u.choose(b"0129-+/.,:\"{}[]ah")?;
        }
    }
    if let Ok(read) = TallyRecord::read(&*text) {
        let again = written(&read)?;
        let again = TallyRecord::read(&*again).map_err(|error| refuted(&error.to_string()))?;
        same("the value read back from a damaged file", &again, &read)?;
        let _ = TallyRecord::merge(&[other.clone(), read.clone()]);
        if let Ok(merged) = TallyRecord::merge(&[read, other]) {
            written(&merged)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod injected_faults {
    use super::*;
    use crate::generators::number;

    fn whole(scene: &Scene) -> Tally {
        let ensemble = scene.ensemble(4).unwrap();
        ensemble.run(&Choice::All, Shard::WHOLE).unwrap()
    }

    #[test]
    fn a_different_tally_is_caught() {
        let scene = Scene::of("hexagon:2", FirstSign::Plus);
        let holds = |of: &Scene| is_as_enumerated(&scene, 4, &Choice::All, &whole(of)).is_ok();
        assert!(holds(&scene));
        for other in [
            Scene::of("hexagon:2", FirstSign::Minus),
            Scene::on("hexagon:4", FirstSign::Plus),
            Scene {
                width: number::ratio(2, 7),
                ..scene.clone()
            },
            Scene {
                loads: vec![([0, 0], number::power(2, -60))],
                ..scene.clone()
            },
        ] {
            assert!(!holds(&other), "{other:?}");
        }
    }

    #[test]
    fn different_samples_are_caught() {
        let scene = Scene::of("hexagon:1", FirstSign::Random);
        let drawn =
            |count, seed, q| Choice::Drawn(Samples::new(count, seed, number::ratio(q, 7)).unwrap());
        let choice = drawn(9, 3, 2);
        let holds = |of: &Choice| {
            let tally = scene.ensemble(5).unwrap().run(of, Shard::WHOLE).unwrap();
            is_as_enumerated(&scene, 5, &choice, &tally).is_ok()
        };
        assert!(holds(&choice));
        for other in [drawn(9, 4, 2), drawn(9, 3, 6), drawn(8, 3, 2)] {
            assert!(!holds(&other), "{other:?}");
        }
    }

    #[test]
    fn a_part_of_another_ensemble_is_caught() {
        let scene = Scene::of("hexagon:1", FirstSign::Random);
        let (ensemble, whole) = (scene.ensemble(4).unwrap(), whole(&scene));
        let run = |index| {
            let shard = Shard::new(index, 2).unwrap();
            ensemble.run(&Choice::All, shard).unwrap()
        };
        assert!(merge_into(&[run(2), run(1)], &whole).is_ok());
        assert!(merge_into(&[run(1)], &whole).is_err());
        let mut other = whole.clone();
        other.faults[1].standing.sum += number::power(2, -60);
        assert!(merge_into(&[run(2), run(1)], &other).is_err());
    }
}
