//! The mean over random stackings equals the average over all stackings, enumerated one by one. Queries that are too large
//! are rejected.

use arbitrary::Unstructured;
use cannonpile::lattice::{Region, Site};
use cannonpile_disorder::{Error, FirstSign, Mean, RandomPiles, RandomStackings, Shard};
use num_rational::BigRational;
use num_traits::{One, Signed, Zero, pow};

use super::parsers::round_trips;
use super::{Checked, Failure, demand, one_line, same};
use crate::disorder::{Piles, agrees_at, faults};
use crate::generators::{disorder, number, rarely, region, text};

/// Small piles: compares all answers.
pub fn small(u: &mut Unstructured<'_>) -> Checked {
    let described = disorder::piles(u)?;
    let q = number::fraction(u)?;
    let sums = described.sums();
    agrees_at(&described, &sums, core::slice::from_ref(&q)).map_err(Failure::Refuted)?;
    let is_response = described.weightless && !described.loads.is_empty();
    if is_response {
        let squares = described.piles()?.mean_square(&q)?;
        same("the mean square", &squares, &mean_square(&described, &q))?;
    }
    Ok(())
}

/// The mean of the sum of squares. Each stacking counts with its probability.
fn mean_square(described: &Piles, q: &BigRational) -> BigRational {
    let choices = described.steps.saturating_sub(1);
    let two = described.first == FirstSign::Random && described.steps > 0;
    let mut mean = BigRational::zero();
    for signs in described.stackings() {
        let d = faults(&signs);
        let share = pow(q.clone(), d) * pow(BigRational::one() - q, choices - d);
        let squares = described
            .bottom(&signs)
            .into_values()
            .map(|[normal, _, _]| &normal * &normal);
        mean += squares.sum::<BigRational>() * share;
    }
    mean / number::ratio(if two { 2 } else { 1 }, 1)
}

/// Piles of any size: the reactions at the base add up to all weights and loads, and the fault probabilities are valid.
/// Otherwise the error is one line.
pub fn any_size(u: &mut Unstructured<'_>) -> Checked {
    let stackings = disorder::stackings(u)?;
    let region = region::region(u)?;
    let (mut piles, is_grown_down) = match u.int_in_range(0..=2)? {
        0 => (RandomPiles::under(region, stackings), true),
        1 => (RandomPiles::on(region, stackings), false),
        _ => (RandomPiles::plane(stackings), false),
    };
    if !rarely(u, 3)? {
        piles = piles.weightless();
    }
    let mut loads = BigRational::zero();
    for _ in 0..u.int_in_range(0..=3)? {
        let [i, j] = region::site_about(u, &region)?;
        let load = disorder::load(u)?;
        match piles.clone().with_load(Site { i, j, k: 0 }, load.clone()) {
            Ok(loaded) => (piles, loads) = (loaded, loads + load),
            Err(refusal) => one_line(&refusal)?,
        }
    }
    let q = number::fraction(u)?;
    // The library can answer for a region of a million sites, but a fuzz run has no time for it.
    let most = if stackings.layers() <= 8 { 40 } else { 6 };
    let is_small = [region.x(), region.y()]
        .iter()
        .all(|side| side.end() - side.start() <= most);
    if stackings.layers() < 2000 && !is_small {
        return Ok(());
    }
    match piles.exact(&q) {
        Ok(mean) => {
            let spheres = match (piles.is_weightless(), is_grown_down) {
                (true, _) => Some(BigRational::zero()),
                (false, true) if stackings.layers() <= 8 => {
                    Some(spheres_of(region, stackings, &q)?)
                }
                (false, _) => None,
            };
            base_supports_everything(&piles, &mean, spheres.map(|spheres| spheres + loads))
        }
        Err(refusal) => {
            one_line(&refusal)?;
            demand(
                !matches!(
                    refusal,
                    Error::Core(cannonpile::Error::Bug { .. } | cannonpile::Error::Overflow { .. })
                ),
                || format!("{piles:?}: {refusal}"),
            )
        }
    }
}

/// The average number of spheres under a top layer. It is the sum of the average numbers of spheres in the bottom
/// layers of all piles up to this height.
fn spheres_of(
    top: Region,
    stackings: RandomStackings,
    q: &BigRational,
) -> Result<BigRational, Failure> {
    let mut spheres = BigRational::zero();
    for layers in 1..=stackings.layers() {
        let stackings = RandomStackings::new(layers, stackings.first())?;
        let mean = RandomPiles::under(top, stackings).exact(q)?;
        spheres += mean
            .rows()
            .iter()
            .map(|row| &row.probability)
            .sum::<BigRational>();
    }
    Ok(spheres)
}

/// The base normal forces add up to the external force, if that is known. No pile weighs less than its bottom layer.
fn base_supports_everything(
    piles: &RandomPiles,
    mean: &Mean<BigRational>,
    acting: Option<BigRational>,
) -> Checked {
    let rows = mean.rows();
    let total: BigRational = rows.iter().map(|row| &row.normal).sum();
    let bottom: BigRational = rows.iter().map(|row| &row.probability).sum();
    demand(
        acting.map_or(total >= bottom, |acting| total == acting),
        || format!("{total} of {piles:?}"),
    )?;
    let is_share = |p: &BigRational| !p.is_negative() && *p <= BigRational::one();
    demand(rows.iter().all(|row| is_share(&row.probability)), || {
        format!("a probability of {piles:?}")
    })
}

/// A parser reads a word. Its value is printed in a form that the parser reads as the same value.
pub fn any_word(u: &mut Unstructured<'_>) -> Checked {
    let text = text::word(u)?;
    round_trips::<FirstSign>(&text)?;
    round_trips::<Shard>(&text)
}

#[cfg(test)]
mod injected_faults {
    use super::*;
    use crate::disorder::Anchor;

    #[test]
    fn another_pile_is_caught() {
        let described = Piles::heavy(
            Anchor::Top(cannonpile::lattice::Region::SITE),
            3,
            FirstSign::Plus,
        );
        let q = [number::ratio(1, 3)];
        assert!(agrees_at(&described, &described.sums(), &q).is_ok());
        for other in [
            Piles {
                steps: 2,
                ..described.clone()
            },
            Piles {
                first: FirstSign::Minus,
                ..described.clone()
            },
            Piles {
                loads: vec![([0, 0], number::power(2, -60))],
                ..described.clone()
            },
        ] {
            assert!(
                agrees_at(&described, &other.sums(), &q).is_err(),
                "{other:?}"
            );
        }
    }

    #[test]
    fn a_wrong_mean_square_is_caught() {
        let described = Piles::response(4, FirstSign::Random);
        let squares = described
            .piles()
            .unwrap()
            .mean_square(&number::ratio(1, 3))
            .unwrap();
        assert_eq!(mean_square(&described, &number::ratio(1, 3)), squares);
        assert_ne!(mean_square(&described, &number::ratio(1, 2)), squares);
    }

    #[test]
    fn a_lost_load_is_caught() {
        let described = Piles::response(3, FirstSign::Plus);
        let holds = |of: &Piles, acting: i64| {
            let piles = of.piles().unwrap();
            let mean = piles.exact(&number::ratio(1, 3)).unwrap();
            let acting = number::ratio(acting, 1);
            let judge =
                |mean: &_| base_supports_everything(&piles, mean, Some(acting.clone())).is_ok();
            assert!(!judge(&mean.given_sphere()));
            judge(&mean)
        };
        assert!(holds(&described, 1));
        let mut other = described;
        other.loads.push(([1, 0], number::ratio(1, 1)));
        assert!(holds(&other, 2));
        assert!(!holds(&other, 1));
    }

    #[test]
    fn a_lost_sphere_is_caught() {
        let described = Piles::heavy(Anchor::Top(Region::SITE), 3, FirstSign::Plus);
        let (piles, q) = (described.piles().unwrap(), number::ratio(1, 3));
        let mean = piles.exact(&q).unwrap();
        let spheres = spheres_of(Region::SITE, piles.stackings(), &q).unwrap();
        let judge = |acting: BigRational| base_supports_everything(&piles, &mean, Some(acting));
        assert!(judge(spheres.clone()).is_ok());
        assert!(judge(spheres - number::power(2, -60)).is_err());
    }
}
