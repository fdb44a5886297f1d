//! The mean over random stackings is that of all stackings, looked at one by one; and what is too large is refused.

use arbitrary::Unstructured;
use cannonpile::Error;
use cannonpile::disorder::{FirstSign, Mean, RandomPiles};
use cannonpile::lattice::Site;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero, pow};

use super::{Checked, Failure, demand, one_line, same};
use crate::generators::{disorder, number, region};
use crate::support::disorder::{Piles, agrees_at};
use crate::support::oracles::one_by_one::faults;

/// Small piles: all that is said of them.
pub(crate) fn small(u: &mut Unstructured<'_>) -> Checked {
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

/// The mean of the sum of squares: each stacking with its probability.
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

/// Piles of any size: the floor bears all loads, with probabilities that are some, or a line says why there is no answer.
pub(crate) fn any_size(u: &mut Unstructured<'_>) -> Checked {
    let stackings = disorder::stackings(u)?;
    let region = region::region(u)?;
    let piles = match u.int_in_range(0..=2)? {
        0 => RandomPiles::under(region, stackings),
        1 => RandomPiles::on(region, stackings),
        _ => RandomPiles::plane(stackings),
    };
    let piles = piles.weightless();
    let [i, j] = region::site_about(u, &region)?;
    let piles = match piles
        .clone()
        .with_load(Site { i, j, k: 0 }, number::ratio(1, 1))
    {
        Ok(loaded) => loaded,
        Err(refusal) => {
            one_line(&refusal)?;
            piles
        }
    };
    let q = number::fraction(u)?;
    // A region of a million sites is answered, but not in a fuzz run.
    let is_small = [region.x(), region.y()]
        .iter()
        .all(|side| side.end() - side.start() <= 40);
    if stackings.layers() <= 8 && !is_small {
        return Ok(());
    }
    match piles.exact(&q) {
        Ok(mean) => bears_its_loads(&piles, &mean),
        Err(refusal) => {
            one_line(&refusal)?;
            demand(
                !matches!(refusal, Error::Bug { .. } | Error::Overflow { .. }),
                || format!("{piles:?}: {refusal}"),
            )
        }
    }
}

fn bears_its_loads(piles: &RandomPiles, mean: &Mean<BigRational>) -> Checked {
    let normals = mean.rows().iter().map(|row| row.normal.clone());
    let sum: BigRational = normals.sum();
    demand(sum.is_zero() || sum.is_one(), || {
        format!("{sum} of {piles:?}")
    })?;
    let is_share = |p: &BigRational| !p.is_negative() && *p <= BigRational::one();
    demand(
        mean.rows().iter().all(|row| is_share(&row.probability)),
        || format!("a probability of {piles:?}"),
    )
}

#[cfg(test)]
mod planted {
    use super::*;
    use crate::support::disorder::Anchor;

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
    fn another_square_is_caught() {
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
    fn a_load_that_is_lost_is_caught() {
        let piles = Piles::response(3, FirstSign::Plus).piles().unwrap();
        let mean = piles.exact(&number::ratio(1, 3)).unwrap();
        assert!(bears_its_loads(&piles, &mean).is_ok());
        assert!(bears_its_loads(&piles, &mean.given_sphere()).is_err());
    }
}
