//! Preparation of a run: limits, integer widths and common denominators.

use core::ops::Range;

use cannonpile::engine::common_denominator;
use cannonpile::engine::{refuse_beyond, refuse_beyond_memory, threads};
use cannonpile::formula;
use cannonpile::lattice::{Region, Sign};
use cannonpile::shape::Anchor;
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};

use super::count::Level;
use super::layer::{Numerator, Planes};
use super::order::Order;
use super::sums::Sums;
use super::{Choice, Ensemble, Shard};
use crate::domain::check_height;
use crate::error::bug;
use crate::width::words_of_big;
use crate::{Each, Error};

/// The largest number of 64-bit words that a walk stores, for all layers of one stacking.
const MAX_WORDS: u64 = 50_000_000;

/// The largest number of bins of a histogram of contact forces.
pub(super) const MAX_BINS: u64 = 100_000;

/// The largest number of stackings that one run enumerates.
const MAX_STACKINGS: u64 = 1 << 24;

/// A run that is within the limits, with its bounds and common denominator.
pub(super) struct Task {
    pub(super) steps: usize,
    pub(super) order: Order,
    /// The indices of the stackings or samples of the shard.
    pub(super) range: Range<u64>,
    /// The common denominator of all forces and the width of the bins, without the factor 3^faults.
    scale: BigInt,
    /// The forces below the top layer, in f₀, one for each sphere. On a base they are all equal, and as many as the
    /// greatest top layer needs.
    top_own: Vec<BigRational>,
    /// The force that a sphere of another layer adds to each of its contacts, times the scale.
    own: BigInt,
    /// The width of the bins of contact forces, times the scale.
    width: BigInt,
    /// A bound on all numerators.
    bound: BigInt,
}

impl Task {
    pub(super) fn new(ensemble: &Ensemble, choice: &Choice, shard: Shard) -> Result<Self, Error> {
        let spheres = sizes(ensemble)?;
        let steps = spheres.len() - 1;
        let order = Order::new(ensemble, choice, steps)?;
        let too_many = |stackings: BigUint| Error::TooManyStackings {
            stackings,
            limit: MAX_STACKINGS,
        };
        let range = range_of(&order, choice, shard);
        let range = range.ok_or_else(|| too_many(BigUint::one() << order.free))?;
        let count = range.end - range.start;
        if *choice == Choice::All && count > MAX_STACKINGS {
            return Err(too_many(count.into()));
        }
        let total = spheres.iter().sum::<u128>();
        // At exactly 2⁶² forces 64-bit counters would overflow. But the number of forces is a multiple of three, so it
        // never equals the limit.
        refuse_beyond(
            "the contact forces of all samples",
            BigUint::from(u128::from(count) * u128::from(order.factor)) * (total * 3),
            1 << 62,
            "take a smaller shard, or fewer samples",
        )?;
        let half = BigRational::new(1.into(), 2.into());
        // On an equilateral base all three increments are 1.
        let [increment, ..] = formula::increments(&half);
        let weight = ensemble.weight();
        let own = formula::force(weight.clone(), &increment);
        let top_own = match ensemble.anchor() {
            Anchor::Top(_) => ensemble.own_of_top(&increment)?,
            Anchor::Base(_) => {
                let most = spheres.first().and_then(ToPrimitive::to_usize);
                vec![own.clone(); most.ok_or_else(|| bug("the limit fits the memory"))?]
            }
        };
        let sums = Sums::of(&top_own, &weight);
        let below = spheres.iter().skip(1);
        let level = below.fold(Level::top(0), |level, spheres| level.next(*spheres));
        // No force exceeds the root of the sum of squares of its layer, which grows from layer to layer.
        let greatest = sums.squares(&level).ceil().to_integer().sqrt() + 1_u32;
        let span = BigRational::from_integer(greatest.clone() + &greatest);
        refuse_beyond(
            "the histogram of contact forces",
            (span / ensemble.bin_width())
                .ceil()
                .to_integer()
                .into_parts()
                .1,
            MAX_BINS,
            "use wider bins, or fewer layers",
        )?;
        let scale = common_denominator(top_own.iter().chain([&own, ensemble.bin_width()]));
        let times = |number: &BigRational| (number * &scale).to_integer();
        let width = times(ensemble.bin_width());
        // The factor 16 covers sums of three forces and the tripled half-turn. The numerators of normal forces are
        // tripled, and so is the width of their bins.
        let bound = (greatest * &scale * 16_u32).max(width.clone() * 3_u32);
        let bound = bound * power_of_three(steps.saturating_sub(1));
        let words = match bound.bits() {
            0..64 => 1,
            64..128 => 2,
            bits => words_of_big(bits),
        };
        refuse_too_many(
            &(BigUint::from(total * NUMBERS) * words),
            &ensemble.anchor(),
        )?;
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

    /// Returns whether signed integers of this many bits suffice.
    pub(super) fn fits(&self, bits: u64) -> bool {
        self.bound.bits() < bits
    }

    /// Returns the constants of the walks, by [class](class_of). `None` for stackings that the base does not support.
    pub(super) fn setups<T: Numerator>(
        &self,
        ensemble: &Ensemble,
    ) -> Result<Vec<Option<Setup<T>>>, Error> {
        let base = match ensemble.anchor() {
            Anchor::Top(top) => return Ok(vec![Some(self.setup(ensemble, top, None)?)]),
            Anchor::Base(base) => base,
        };
        let setup = |plus: usize| {
            let steps = [plus, self.steps - plus].each(|steps| steps as i128);
            let top = base.shrunk(steps[0], steps[1]);
            let setup = top.map(|top| self.setup(ensemble, top, Some((base, steps))));
            setup.transpose()
        };
        (0..=self.steps).map(setup).collect()
    }

    /// Converts the numerators to integers that are wide enough. `base` is the base with the numbers of + and − steps.
    fn setup<T: Numerator>(
        &self,
        ensemble: &Ensemble,
        top: Region,
        base: Option<(Region, [i128; 2])>,
    ) -> Result<Setup<T>, Error> {
        let number =
            |big: BigInt| T::try_from(big).map_err(|_| bug("the bound holds for all numerators"));
        let units = |faults: usize| {
            let power = power_of_three(faults);
            Ok(Units {
                own: number(&self.own * &power)?,
                width: number(&self.width * &power)?,
                normal_width: number(&self.width * 3_u32 * &power)?,
                power: number(power)?,
            })
        };
        let by_faults = (0..self.steps.max(1)).map(units);
        let spheres = top.site_count().to_usize();
        let own = spheres.and_then(|spheres| self.top_own.get(..spheres));
        let own = own.ok_or_else(|| bug("no top layer exceeds the greatest one"))?;
        let top_own = own
            .iter()
            .map(|own| number((own * &self.scale).to_integer()));
        let top_own: Vec<T> = top_own.collect::<Result<_, Error>>()?;
        Ok(Setup {
            steps: self.steps,
            top,
            base,
            top_own: [top_own.clone(), top_own.clone(), top_own],
            by_faults: by_faults.collect::<Result<_, Error>>()?,
            factor: self.order.factor,
            scale: self.scale.clone(),
            sums: Sums::of(own, &ensemble.weight()),
        })
    }
}

/// The constants of a walk.
pub(super) struct Setup<T> {
    pub(super) steps: usize,
    pub(super) top: Region,
    /// The base, if it is given, with the numbers of + and − steps of all stackings of the walk.
    base: Option<(Region, [i128; 2])>,
    /// The forces below the top layer.
    pub(super) top_own: Planes<T>,
    pub(super) by_faults: Vec<Units<T>>,
    /// The number of stackings that each listed stacking represents.
    pub(super) factor: u32,
    pub(super) scale: BigInt,
    pub(super) sums: Sums,
}

/// The numerators of constants below a given number of faults. They have the factor 3^faults.
pub(super) struct Units<T> {
    /// The force that a sphere adds to each of its contacts.
    pub(super) own: T,
    /// The width of the bins of contact forces.
    pub(super) width: T,
    /// Three times the width of the bins of normal forces.
    pub(super) normal_width: T,
    /// 3^faults.
    pub(super) power: T,
}

impl<T> Setup<T> {
    pub(super) fn units(&self, faults: usize) -> Result<&Units<T>, Error> {
        self.by_faults.get(faults).ok_or_else(too_many_faults)
    }

    /// Returns the layer below a beginning with these signs, whose last step leads down from `above`.
    pub(super) fn layer_below(&self, above: &Region, signs: &[Sign]) -> Result<Region, Error> {
        let last = signs.last().ok_or_else(|| bug("a step has a sign"))?;
        let Some((base, [plus, minus])) = self.base else {
            return Ok(above.dilated(*last)?);
        };
        let taken = count_plus(signs);
        let [taken_plus, taken_minus] = [taken, signs.len() - taken].each(|steps| steps as i128);
        let layer = base.shrunk(plus - taken_plus, minus - taken_minus);
        layer.ok_or_else(|| bug("the layers below the top layer have spheres"))
    }
}

/// Returns the class of a stacking. The stackings of a class have the same top layer. On a base the class is the number of
/// + steps.
pub(super) fn class_of(ensemble: &Ensemble, signs: &[Sign]) -> usize {
    match ensemble.anchor() {
        Anchor::Top(_) => 0,
        Anchor::Base(_) => count_plus(signs),
    }
}

fn count_plus(signs: &[Sign]) -> usize {
    signs.iter().filter(|sign| **sign == Sign::Plus).count()
}

pub(super) fn too_many_faults() -> Error {
    bug("a stacking has no more faults than signs that can change")
}

fn power_of_three(exponent: usize) -> BigInt {
    num_traits::pow(BigInt::from(3_u32), exponent)
}

/// The numbers stored for each sphere of each layer: three forces from above, and three below.
const NUMBERS: u128 = 6;

fn refuse_too_many(words: &BigUint, anchor: &Anchor) -> Result<(), Error> {
    refuse_beyond_memory(
        "the layers of one stacking",
        words,
        // Each thread analyses a stacking.
        (MAX_WORDS, size_of::<u64>() * threads()),
        match anchor {
            Anchor::Top(_) => "use fewer layers, or a smaller top",
            Anchor::Base(_) => "use fewer layers, or a smaller base",
        },
    )?;
    Ok(())
}

/// Returns the greatest number of spheres that each layer has in any stacking.
fn sizes(ensemble: &Ensemble) -> Result<Vec<u128>, Error> {
    let (anchor, stackings) = (ensemble.anchor(), ensemble.stackings());
    if let Anchor::Base(base) = anchor {
        refuse_too_many(&(base.site_count() * NUMBERS), &anchor)?;
        check_height(&base, stackings)?;
    }
    let mut sizes = Vec::new();
    let mut numbers = BigUint::zero();
    for k in 0..stackings.layers() {
        let steps = match anchor {
            Anchor::Top(_) => k,
            Anchor::Base(_) => stackings.steps() - k,
        };
        let layers = (0..=steps).filter_map(|plus| match anchor {
            Anchor::Top(top) => Some(top.grown(plus, steps - plus)),
            Anchor::Base(base) => base.shrunk(plus, steps - plus),
        });
        let most = layers.map(|layer| layer.site_count()).max();
        let most = most.ok_or_else(|| bug("a layer has a region"))?;
        numbers += &most * NUMBERS;
        refuse_too_many(&numbers, &anchor)?;
        let most = most.to_u128();
        sizes.push(most.ok_or_else(|| bug("the limit fits 128 bits"))?);
    }
    Ok(sizes)
}

/// Returns the indices of the stackings or samples of a shard. `None` if their total number exceeds 62 bits.
fn range_of(order: &Order, choice: &Choice, shard: Shard) -> Option<Range<u64>> {
    let total = match choice {
        Choice::All => order.total()?,
        Choice::Drawn(samples) => samples.count(),
    };
    Some(shard.range(total))
}
