//! Tallies of ensembles are what plain enumeration counts, and all parts of one make it, however it is cut up.

use arbitrary::Unstructured;
use cannonpile::Error;
use cannonpile::disorder::{Choice, Ensemble, Shard, Tally};
use cannonpile::lattice::Sign;

use super::{Checked, Failure, demand, same};
use crate::generators::ensemble;
use crate::support::tally::{Scene, all_signs, counted};

/// Every count, sum and extreme, of all stackings or of samples.
pub(crate) fn counts(u: &mut Unstructured<'_>) -> Checked {
    let (scene, steps) = ensemble::scene(u)?;
    let choice = ensemble::choice(u)?;
    let tally = scene.ensemble(steps)?.run(&choice, Shard::WHOLE)?;
    is_as_enumerated(&scene, steps, &choice, &tally)
}

fn is_as_enumerated(scene: &Scene, steps: u32, choice: &Choice, tally: &Tally) -> Checked {
    let stackings = match choice {
        Choice::All => all_signs(steps, scene.first),
        Choice::Drawn(samples) => (0..samples.count())
            .map(|n| sample(&scene.ensemble(steps)?, choice, n, samples.count()))
            .collect::<Result<_, Failure>>()?,
    };
    let expected = scene.counted_of(steps, &stackings)?;
    let said = |of: &Tally| (counted(of), of.stackings());
    let all = stackings.len().into();
    same("a tally", &said(tally), &(expected, all))
}

/// The signs of a sample: it is the only one of its part. What stackings they are is tested elsewhere.
fn sample(ensemble: &Ensemble, choice: &Choice, n: u64, of: u64) -> Result<Vec<Sign>, Failure> {
    let tally = ensemble.run(choice, Shard::new(n + 1, of)?)?;
    let mut named = tally
        .faults
        .iter()
        .filter_map(|with| with.all.least_normal.as_ref());
    let named = named.next();
    let named = named.ok_or_else(|| Failure::Refuted("a sample without a base".to_owned()))?;
    Ok(named.stacking.signs().collect())
}

/// Cut into any number of parts, which are put together in any order.
pub(crate) fn parts(u: &mut Unstructured<'_>) -> Checked {
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
    make_the_whole(&parts, &whole)?;
    // One is missing, and one is there twice.
    let without = parts.pop();
    let refused = Tally::merge(&parts);
    demand(refused.is_err(), || format!("merged without {without:?}"))?;
    parts.extend(without.iter().cloned().chain(without.clone()));
    demand(Tally::merge(&parts).is_err(), || {
        format!("merged with {without:?} twice")
    })
}

fn make_the_whole(parts: &[Tally], whole: &Tally) -> Checked {
    match Tally::merge(parts) {
        Ok(merged) => same("what was merged", &merged, whole),
        Err(refused) => Err(Failure::Refuted(format!("{refused:?}: {parts:?}"))),
    }
}

/// A file is read back as it was written; with some letters exchanged it is a tally that a run could have written, or is
/// refused, alone and together with the other part.
#[cfg(all(feature = "export", feature = "serde"))]
pub(crate) fn damaged(u: &mut Unstructured<'_>) -> Checked {
    use cannonpile::serde::TallyRecord;

    let said = |what: &str| Failure::Refuted(what.to_owned());
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
    let read = TallyRecord::read(&*text).map_err(|error| said(&error.to_string()))?;
    same("what was read back", &read, &one)?;
    for _ in 0..u.int_in_range(1..=3)? {
        let place = u.choose_index(text.len())?;
        if let Some(letter) = text.get_mut(place) {
            *letter = *u.choose(b"0129-+/.,:\"{}[]ah")?;
        }
    }
    if let Ok(read) = TallyRecord::read(&*text) {
        let again = written(&read)?;
        let again = TallyRecord::read(&*again).map_err(|error| said(&error.to_string()))?;
        same("what was read back of a damaged file", &again, &read)?;
        let _ = TallyRecord::merge(&[other.clone(), read.clone()]);
        if let Ok(merged) = TallyRecord::merge(&[read, other]) {
            written(&merged)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod planted {
    use cannonpile::disorder::FirstSign;

    use super::*;
    use crate::generators::number;

    fn whole(scene: &Scene) -> Tally {
        let ensemble = scene.ensemble(4).unwrap();
        ensemble.run(&Choice::All, Shard::WHOLE).unwrap()
    }

    #[test]
    fn another_tally_is_caught() {
        let scene = Scene::of("hexagon:2", FirstSign::Plus);
        let holds = |of: &Scene| is_as_enumerated(&scene, 4, &Choice::All, &whole(of)).is_ok();
        assert!(holds(&scene));
        for other in [
            Scene::of("hexagon:2", FirstSign::Minus),
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
    fn a_part_of_another_whole_is_caught() {
        let scene = Scene::of("hexagon:1", FirstSign::Random);
        let (ensemble, whole) = (scene.ensemble(4).unwrap(), whole(&scene));
        let run = |index| {
            let shard = Shard::new(index, 2).unwrap();
            ensemble.run(&Choice::All, shard).unwrap()
        };
        assert!(make_the_whole(&[run(2), run(1)], &whole).is_ok());
        assert!(make_the_whole(&[run(1)], &whole).is_err());
        let mut other = whole.clone();
        other.faults[1].standing.sum += number::power(2, -60);
        assert!(make_the_whole(&[run(2), run(1)], &other).is_err());
    }
}
