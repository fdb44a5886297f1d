//! What is decided before stackings are walked: how wide numbers must be, and what they are multiples of.

use cannonpile::engine::common_denominator;
use cannonpile::engine::{refuse_beyond, refuse_beyond_memory};
use cannonpile::formula;
use cannonpile::lattice::Region;
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};

use super::count::Level;
use super::layer::{Numerator, Planes};
use super::order::Order;
use super::sums::Sums;
use super::{Choice, Ensemble, Shard};
use crate::Error;
use crate::error::bug;

/// The most words of 64 bits that a walk keeps: the numbers of a layer for each layer.
const MAX_WORDS: u64 = 50_000_000;

/// The most bins from the least force that there may be to the greatest.
pub(super) const MOST_BINS: u64 = 100_000;

/// The most stackings that one walk goes through, all of them.
const MOST_STACKINGS: u64 = 1 << 24;

/// What is asked of an ensemble, checked, and what it takes.
pub(super) struct Task {
    steps: usize,
    order: Order,
    /// Of stackings or samples, those of the part.
    pub(super) range: core::ops::Range<u64>,
    /// What all forces and the width of the bins are multiples of, times 3^faults.
    scale: BigInt,
    /// The forces below the top layer, in f₀: what its spheres add to their lines.
    top_own: Vec<BigRational>,
    /// What a sphere of another layer adds, times the scale.
    own: BigInt,
    width: BigInt,
    /// No numerator exceeds it.
    bound: BigInt,
}

impl Task {
    pub(super) fn new(ensemble: &Ensemble, choice: &Choice, shard: Shard) -> Result<Self, Error> {
        let spheres = sizes(ensemble)?;
        let steps = spheres.len() - 1;
        let order = Order::new(ensemble, choice, steps)?;
        let range = match choice {
            Choice::All => {
                let too_many = |stackings: BigUint| Error::TooManyStackings {
                    stackings,
                    limit: MOST_STACKINGS,
                };
                let total = order.total();
                let total = total.ok_or_else(|| too_many(BigUint::one() << order.free))?;
                let range = shard.range(total);
                if range.end - range.start > MOST_STACKINGS {
                    return Err(too_many((range.end - range.start).into()));
                }
                range
            }
            Choice::Drawn(samples) => shard.range(samples.count()),
        };
        let contacts = spheres.iter().sum::<u128>() * 3;
        let walked = u128::from(range.end - range.start) * u128::from(order.factor);
        // A multiple of three, so that none is 2⁶² itself, which counts of 64 bits do not hold.
        refuse_beyond(
            "the contact forces of all samples",
            BigUint::from(walked) * contacts,
            1 << 62,
            "take a smaller shard, or fewer samples",
        )?;
        Self::of(ensemble, &spheres, order, range)
    }

    /// Of layers with at most so many spheres.
    fn of(
        ensemble: &Ensemble,
        spheres: &[u128],
        order: Order,
        range: core::ops::Range<u64>,
    ) -> Result<Self, Error> {
        let steps = spheres.len() - 1;
        let half = BigRational::new(1.into(), 2.into());
        // On an equilateral base all three are one.
        let [increment, ..] = formula::increments(&half);
        let top_own = ensemble.own_of_top(&increment)?;
        let weight = ensemble.weight();
        let sums = Sums::of(&top_own, &weight);
        let level = spheres
            .iter()
            .skip(1)
            .fold(Level::default(), |level, spheres| level.next(*spheres));
        // A force is no greater than the root of the sum of squares of its layer, which grows on the way down.
        let greatest = sums.squares(1, &level).ceil().to_integer().sqrt() + 1_u32;
        let bins =
            (BigRational::from_integer(greatest.clone() + &greatest) / ensemble.bins()).ceil();
        refuse_beyond(
            "the histogram of contact forces",
            bins.to_integer().into_parts().1,
            MOST_BINS,
            "use wider bins, or fewer layers",
        )?;
        let own = formula::force(weight, &increment);
        let denominators = top_own.iter().chain([&own, ensemble.bins()]);
        let scale = common_denominator(denominators);
        let times = |number: &BigRational| (number * &scale).to_integer();
        let width = times(ensemble.bins());
        // Sums of three on the way, and their tripled half-turn; three widths for the normal forces.
        let bound = (greatest * &scale * 16_u32).max(width.clone() * 3_u32);
        let bound = bound * power_of_three(steps.saturating_sub(1));
        // Big integers have their words elsewhere.
        let words = match bound.bits() {
            0..64 => 1,
            64..128 => 2,
            bits => bits / 64 + 5,
        };
        let numbers = BigUint::from(spheres.iter().sum::<u128>() * NUMBERS);
        refuse_too_many(&(numbers * words))?;
        Ok(Self {
            steps,
            order,
            range,
            own: times(&own),
            top_own,
            bound,
            width,
            scale,
        })
    }

    /// Whether numbers of so many bits suffice, their sign included.
    pub(super) fn fits(&self, bits: u64) -> bool {
        self.bound.bits() < bits
    }

    /// In numbers that are wide enough.
    pub(super) fn setup<T: Numerator>(&self, ensemble: &Ensemble) -> Result<Setup<T>, Error> {
        let number = |big: BigInt| T::try_from(big).map_err(|_| bug("the bound holds for all"));
        let kinds = self.steps.saturating_sub(1) + 1;
        let powers: Result<Vec<T>, Error> = (0..kinds)
            .map(|faults| number(power_of_three(faults)))
            .collect();
        let powers = powers?;
        let times_powers = |of: &BigInt| -> Result<Vec<T>, Error> {
            let of = number(of.clone())?;
            Ok(powers.iter().map(|power| of.clone() * power).collect())
        };
        let top_own = self.top_own.iter();
        let top_own: Result<Vec<T>, Error> = top_own
            .map(|own| number((own * &self.scale).to_integer()))
            .collect();
        let top_own = top_own?;
        Ok(Setup {
            steps: self.steps,
            order: self.order,
            top: ensemble.region(),
            top_own: [top_own.clone(), top_own.clone(), top_own],
            own: times_powers(&self.own)?,
            widths: times_powers(&self.width)?,
            normal_widths: times_powers(&(self.width.clone() * 3_u32))?,
            powers,
            scale: self.scale.clone(),
            sums: Sums::of(&self.top_own, &ensemble.weight()),
        })
    }
}

/// What a walk works with.
pub(super) struct Setup<T> {
    pub(super) steps: usize,
    pub(super) order: Order,
    pub(super) top: Region,
    /// The forces below the top layer.
    pub(super) top_own: Planes<T>,
    /// By faults, from here on: what a sphere adds to its lines.
    own: Vec<T>,
    widths: Vec<T>,
    normal_widths: Vec<T>,
    /// 3^faults.
    pub(super) powers: Vec<T>,
    pub(super) scale: BigInt,
    pub(super) sums: Sums,
}

impl<T> Setup<T> {
    pub(super) fn own(&self, faults: usize) -> Result<&T, Error> {
        self.own.get(faults).ok_or_else(too_many_faults)
    }

    /// The width of bins of forces.
    pub(super) fn width(&self, faults: usize) -> Result<&T, Error> {
        self.widths.get(faults).ok_or_else(too_many_faults)
    }

    /// That of three times a normal force.
    pub(super) fn normal_width(&self, faults: usize) -> Result<&T, Error> {
        self.normal_widths.get(faults).ok_or_else(too_many_faults)
    }

    pub(super) fn power(&self, faults: usize) -> Result<&T, Error> {
        self.powers.get(faults).ok_or_else(too_many_faults)
    }
}

fn too_many_faults() -> Error {
    bug("a stacking has no more faults than signs that can change")
}

fn power_of_three(exponent: usize) -> BigInt {
    num_traits::pow(BigInt::from(3_u32), exponent)
}

/// What is kept for each sphere of each layer: what comes down to it and what it passes on, three numbers each.
const NUMBERS: u128 = 6;

fn refuse_too_many(words: &BigUint) -> Result<(), Error> {
    refuse_beyond_memory(
        "the layers of one stacking",
        words,
        (MAX_WORDS, size_of::<u64>()),
        "use fewer layers, or a smaller top",
    )?;
    Ok(())
}

/// The most spheres of each layer, whatever the stacking.
fn sizes(ensemble: &Ensemble) -> Result<Vec<u128>, Error> {
    let top = ensemble.region();
    let mut sizes = Vec::new();
    let mut numbers = BigUint::zero();
    for k in 0..ensemble.stackings().layers() {
        let layers = (0..=k).map(|plus| top.grown(plus, k - plus).site_count());
        let most = layers.max().ok_or_else(|| bug("a layer has a region"))?;
        numbers += &most * NUMBERS;
        refuse_too_many(&numbers)?;
        sizes.push(
            most.to_u128()
                .ok_or_else(|| bug("what is below the limit fits"))?,
        );
    }
    Ok(sizes)
}

/// How many stackings a part has; `None` of an ensemble of which no part is walked.
pub(super) fn stackings_of(
    ensemble: &Ensemble,
    choice: &Choice,
    shard: Shard,
) -> Result<Option<BigUint>, Error> {
    let (total, factor) = match choice {
        Choice::All => {
            let Ok(steps) = usize::try_from(ensemble.stackings().steps()) else {
                return Ok(None);
            };
            let order = Order::new(ensemble, choice, steps)?;
            (order.total(), order.factor)
        }
        Choice::Drawn(samples) => (Some(samples.count()), 1),
    };
    let range = total.map(|total| shard.range(total));
    Ok(range.map(|range| BigUint::from(range.end - range.start) * factor))
}
