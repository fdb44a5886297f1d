//! Tallies against plain enumeration: every stacking made as a pile, its forces asked for one by one, and counted.

use std::collections::BTreeMap;

use cannonpile::disorder::{
    By, Choice, Distribution, Ensemble, Extreme, FirstSign, Histogram, RandomStackings, Shard,
    Tally,
};
use cannonpile::lattice::{Region, Sign, Site};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Error, Pile, census};
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};

use super::ratio;

/// A force, and the signs of the stacking that has it.
type Found = Option<(BigRational, String)>;

/// What a distribution says, counted plainly.
#[derive(Debug, Default, PartialEq)]
struct Counted {
    stackings: u64,
    contacts: u64,
    sum: BigRational,
    sum_of_squares: BigRational,
    forces: BTreeMap<i64, u64>,
    least: Found,
    greatest: Found,
    normals: BTreeMap<i64, u64>,
    least_normal: Found,
    greatest_normal: Found,
}

impl Counted {
    /// Counts a pile, whose stacking comes after all those before.
    fn meet(&mut self, pile: &Pile, signs: &str, width: &BigRational) -> Result<(), Error> {
        let forces = pile.forces::<BigRational>();
        let bin = |x: &BigRational| (x / width).floor().to_integer().to_i64().unwrap();
        self.stackings += 1;
        for contact in forces.contacts(Selection::All)? {
            let force = contact?.force;
            *self.forces.entry(bin(&force)).or_default() += 1;
            self.contacts += 1;
            self.sum += &force;
            self.sum_of_squares += &force * &force;
            better(&mut self.least, &force, signs, |new, old| new < old);
            better(&mut self.greatest, &force, signs, |new, old| new > old);
        }
        for force in forces.base(Selection::Base)? {
            let normal = force?.normal;
            *self.normals.entry(bin(&normal)).or_default() += 1;
            better(&mut self.least_normal, &normal, signs, |new, old| new < old);
            better(&mut self.greatest_normal, &normal, signs, |new, old| {
                new > old
            });
        }
        Ok(())
    }

    /// What a distribution says.
    fn of(distribution: &Distribution) -> Self {
        let bins = |histogram: &Histogram| {
            let counts = histogram.counts.iter().map(|n| n.to_u64().unwrap());
            let bins = (histogram.first..).zip(counts);
            bins.filter(|(_, count)| *count > 0).collect()
        };
        let found = |extreme: &Option<Extreme>| {
            let found = extreme.as_ref();
            found.map(|found| (found.force.clone(), text(found.stacking.signs())))
        };
        Self {
            stackings: distribution.stackings.to_u64().unwrap(),
            contacts: distribution.contacts.to_u64().unwrap(),
            sum: distribution.sum.clone(),
            sum_of_squares: distribution.sum_of_squares.clone(),
            forces: bins(&distribution.forces),
            least: found(&distribution.least),
            greatest: found(&distribution.greatest),
            normals: bins(&distribution.normals),
            least_normal: found(&distribution.least_normal),
            greatest_normal: found(&distribution.greatest_normal),
        }
    }
}

fn better(
    best: &mut Found,
    force: &BigRational,
    signs: &str,
    is_better: impl Fn(&BigRational, &BigRational) -> bool,
) {
    if best.as_ref().is_none_or(|(old, _)| is_better(force, old)) {
        *best = Some((force.clone(), signs.to_owned()));
    }
}

fn text(signs: impl Iterator<Item = Sign>) -> String {
    signs.map(Sign::symbol).collect()
}

/// All signs of so many steps, in order.
pub(super) fn all_signs(steps: u32, first: FirstSign) -> Vec<Vec<Sign>> {
    let all = (0..1_u32 << steps).map(|bits| {
        let signs = (0..steps).rev().map(|bit| match bits >> bit & 1 {
            0 => Sign::Plus,
            _ => Sign::Minus,
        });
        signs.collect::<Vec<_>>()
    });
    let begins = |signs: &Vec<Sign>| {
        signs
            .first()
            .is_none_or(|sign| first.signs().contains(sign))
    };
    all.filter(begins).collect()
}

/// A scene: the top, its loads, and whether spheres weigh nothing.
#[derive(Clone)]
struct Case {
    top: Region,
    loads: Vec<([i128; 2], BigRational)>,
    weightless: bool,
    first: FirstSign,
    width: BigRational,
}

impl Case {
    fn of(top: &str, first: FirstSign) -> Self {
        Self {
            top: top.parse().unwrap(),
            loads: Vec::new(),
            weightless: false,
            first,
            width: ratio(1, 3),
        }
    }

    fn ensemble(&self, steps: u32) -> Result<Ensemble, Error> {
        let stackings = RandomStackings::new(i128::from(steps) + 1, self.first)?;
        let mut ensemble = Ensemble::under(self.top, stackings)?.with_bins(self.width.clone())?;
        for (at, load) in &self.loads {
            ensemble = ensemble.with_load(*at, load.clone())?;
        }
        Ok(if self.weightless {
            ensemble.weightless()
        } else {
            ensemble
        })
    }

    fn pile(&self, signs: &[Sign]) -> Result<Pile, Error> {
        let stacking = Stacking::from_signs(signs.iter().copied())?;
        let mut pile = Pile::under(self.top, stacking)?;
        for ([i, j], load) in &self.loads {
            let site = Site { i: *i, j: *j, k: 0 };
            pile = pile.with_load(site, load.clone())?;
        }
        Ok(if self.weightless {
            pile.weightless()
        } else {
            pile
        })
    }

    /// What is counted of all stackings and of those that stand, by faults.
    fn counted(&self, steps: u32) -> Result<Vec<[Counted; 2]>, Error> {
        let mut counted = Vec::new();
        counted.resize_with(steps.max(2) as usize - 1, <[Counted; 2]>::default);
        if steps == 1 {
            counted.truncate(1);
        }
        for signs in all_signs(steps, self.first) {
            let faults = signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
            let pile = self.pile(&signs)?;
            let signs = text(signs.into_iter());
            counted.resize_with(counted.len().max(faults + 1), Default::default);
            let [all, standing] = &mut counted[faults];
            all.meet(&pile, &signs, &self.width)?;
            let mut contacts = pile.forces::<BigRational>().contacts(Selection::All)?;
            if contacts.all(|contact| !contact.unwrap().force.is_negative()) {
                standing.meet(&pile, &signs, &self.width)?;
            }
        }
        Ok(counted)
    }
}

fn counted(tally: &Tally) -> Vec<[Counted; 2]> {
    let faults = tally.faults.iter().enumerate();
    let both = faults.map(|(d, with)| {
        assert_eq!(with.faults as usize, d);
        [&with.all, &with.standing].map(Counted::of)
    });
    both.collect()
}

fn is_as_enumerated(case: &Case, steps: u32) -> Result<(), Error> {
    let tally = case.ensemble(steps)?.run(&Choice::All, Shard::WHOLE)?;
    let expected = case.counted(steps)?;
    assert_eq!(counted(&tally), expected, "{} {steps}", case.top);
    Ok(())
}

const FIRST: [FirstSign; 3] = [FirstSign::Plus, FirstSign::Minus, FirstSign::Random];

#[test]
fn of_tops_under_their_weight() -> Result<(), Error> {
    for (top, most) in [("hexagon:1", 7), ("hexagon:3", 5), ("triangle:3", 6)] {
        for first in FIRST {
            for steps in 0..=most {
                is_as_enumerated(&Case::of(top, first), steps)?;
            }
        }
    }
    // Bounds of another corner, of no symmetry.
    for first in FIRST {
        is_as_enumerated(&Case::of("region:-2..1,3..5,2..5", first), 4)?;
    }
    Ok(())
}

#[test]
fn of_loads() -> Result<(), Error> {
    for first in FIRST {
        let mut case = Case::of("hexagon:2", first);
        // In the middle, where they are their own mirror image, and then not.
        case.loads.push(([0, 0], ratio(5, 7)));
        case.width = ratio(2, 5);
        is_as_enumerated(&case, 5)?;
        case.loads.push(([1, 0], ratio(1, 4)));
        is_as_enumerated(&case, 5)?;
        case.loads.push(([-1, 0], ratio(1, 4)));
        is_as_enumerated(&case, 4)?;
        case.weightless = true;
        case.width = ratio(1, 24);
        is_as_enumerated(&case, 5)?;
        // No turn leads these two to their mirror image.
        let mut case = Case::of("hexagon:2", first);
        case.loads = [[1, 0], [0, 1]].map(|at| (at, ratio(1, 4))).into();
        is_as_enumerated(&case, 4)?;
    }
    Ok(())
}

/// Numerators of a load with a great denominator take 128 bits, and of a greater one any number.
#[test]
fn in_wide_numbers() -> Result<(), Error> {
    for digits in [9, 18, 60] {
        let mut case = Case::of("triangle:2", FirstSign::Random);
        let great = num_traits::pow(ratio(10, 1), digits) + ratio(1, 1);
        case.loads.push(([1, 0], ratio(3, 1) / great));
        is_as_enumerated(&case, 5)?;
    }
    Ok(())
}

/// Of long stackings: some of the shard are enough.
#[test]
fn of_parts() -> Result<(), Error> {
    let case = Case::of("hexagon:1", FirstSign::Plus);
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
            expected[faults][0].meet(&pile, &signs, &case.width)?;
            if pile.standing()?.first_failure.is_none() {
                expected[faults][1].meet(&pile, &signs, &case.width)?;
            }
        }
        assert_eq!(counted(&tally), expected, "{index}");
        from = to;
    }
    Ok(())
}

#[test]
fn as_many_stand_as_in_the_census() -> Result<(), Error> {
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
            assert_eq!(tally.standing(By::Sloping), Some((census * pairs).into()));
            for (d, with) in (0..).zip(&tally.faults) {
                assert_eq!(with.all.stackings, stackings.count_with(d));
            }
            // At q = ½ all are equally likely.
            let probability = tally.standing_probability(By::Sloping, &ratio(1, 2))?;
            let standing = BigRational::from_integer((census * pairs).into());
            let all = BigRational::from_integer(tally.stackings().into());
            assert_eq!(probability, Some(standing / all));
        }
    }
    Ok(())
}

#[test]
fn probabilities_are_sums_over_stackings() -> Result<(), Error> {
    let q = ratio(2, 7);
    for first in FIRST {
        let case = Case::of("triangle:3", first);
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
        let found = tally.standing_probability(By::Sloping, &q)?;
        assert_eq!(found, Some(expected), "{first}");
    }
    Ok(())
}

#[cfg(feature = "horizontal")]
#[test]
fn as_many_stand_with_horizontal_contacts() -> Result<(), Error> {
    use cannonpile::horizontal;

    for layers in 1..=9 {
        let stackings = RandomStackings::new(layers, FirstSign::Random)?;
        let ensemble = Ensemble::under(Region::SITE, stackings)?.with_horizontal_contacts()?;
        let tally = ensemble.run(&Choice::All, Shard::WHOLE)?;
        let census = horizontal::census::under_one_sphere(layers, false)?.count();
        let pairs = if layers > 1 { 2 } else { 1 };
        assert_eq!(
            tally.standing(By::Horizontal),
            Some((census * pairs).into())
        );
    }
    // Another top, each pile for itself; a load that is not its own mirror image.
    let mut case = Case::of("triangle:2", FirstSign::Random);
    case.loads.push(([0, 0], ratio(1, 2)));
    let ensemble = case.ensemble(5)?.with_horizontal_contacts()?;
    let tally = ensemble.run(&Choice::All, Shard::WHOLE)?;
    let mut held = vec![0_u32; 5];
    for signs in all_signs(5, FirstSign::Random) {
        let certificate = case.pile(&signs)?.equilibrium()?;
        if certificate.claim == cannonpile::certificate::Claim::Stands {
            held[signs.windows(2).filter(|pair| pair[0] != pair[1]).count()] += 1;
        }
    }
    let found = tally.faults.iter().map(|with| with.held.clone());
    assert!(found.eq(held.into_iter().map(|held| Some(held.into()))));
    Ok(())
}

#[test]
fn what_is_too_much_is_refused() -> Result<(), Error> {
    let run = |top: &str, layers, width, shard| {
        let stackings = RandomStackings::new(layers, FirstSign::Plus)?;
        let ensemble = Ensemble::under(top.parse()?, stackings)?.with_bins(width)?;
        ensemble.run(&Choice::All, shard)
    };
    for (top, layers, width, expected) in [
        (
            "hexagon:1",
            27,
            ratio(1, 3),
            "33554432 stackings are too many to go through at a time, at most 16777216: draw samples, take a smaller shard, or fewer layers",
        ),
        ("hexagon:1", 200, ratio(1, 3), "stackings are too many"),
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
    // A part of them is no more than the whole of fewer layers.
    let part = run("hexagon:1", 30, ratio(1, 3), Shard::new(1, 1 << 22)?)?;
    assert_eq!(part.stackings(), 64_u32.into());
    assert_eq!(part.standing_probability(By::Sloping, &ratio(1, 2))?, None);
    Ok(())
}
