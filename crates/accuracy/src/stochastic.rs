//! A float that rounds stochastically.

use core::cmp::Ordering;
use core::num::NonZeroI64;
use core::ops::{Add, Mul, Sub};

use cannonpile::geometry::Load;
use cannonpile::lattice::{Row, Site};
use cannonpile::scalar::{Algebra, DoubleDouble, Exactness, Field, Ring};
use cannonpile::shape::Selection;
use cannonpile::{Error, Forces, Pile};
use num_rational::BigRational;
use num_traits::Zero;

/// A binary float of `P` bits that rounds stochastically: up with the probability (x − a)/(b − a), where a and b are the
/// floats below and above the exact result x. So the error has the mean 0, and |error| < 2u|x| with u = 2^−`P`.
///
/// `P` is between 3 and 53, and the exponents are those of `f64`.
///
/// # Random numbers
/// A value carries a state of 64 bits. Each operation mixes the states of its operands, and the new state gives the random number
/// of its rounding: a generator that is counted by the history of a value. So a result depends neither on time nor on
/// threads, and equal numbers at different places have different roundings. A value without a random operand in its history
/// has the state 0, and is rounded to nearest, ties to even. Values are equal if their numbers are.
///
/// The states come with [`stochastic_forces`], or by [`new`](Self::new).
///
/// # Examples
/// ```
/// use cannonpile::num_traits::One;
/// use cannonpile_accuracy::Stochastic;
///
/// // 1 + 1/512 in 8 bits is 1 or 1 + 1/128. The second one comes in a quarter of the cases.
/// let sum = |state| Stochastic::<8>::new(1.0 / 512.0, state) + &Stochastic::one();
/// let ups = (1..=1000).filter(|state| sum(*state).value() > 1.0).count();
/// assert!((200..300).contains(&ups), "{ups}");
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Stochastic<const P: u32> {
    value: f64,
    state: u64,
}

/// A bijection of the 64-bit integers, the last step of the generator SplitMix64.
const fn mixed(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The operations, as increments of the state.
const SUM: u64 = 0x9e37_79b9_7f4a_7c15;
const DIFFERENCE: u64 = 0x3c6e_f372_fe94_f82b;
const PRODUCT: u64 = 0xdaa6_6d2c_7ddf_743f;
const QUOTIENT: u64 = 0x78dd_e6e5_fd29_f054;

impl<const P: u32> Stochastic<P> {
    /// The number of bits of an `f64` that this format lacks.
    const LACKING: u32 = {
        assert!(P >= 3 && P <= 53, "the precision is between 3 and 53 bits");
        53 - P
    };

    /// Returns the value rounded to nearest, with a state of the random numbers.
    #[must_use]
    pub fn new(value: f64, state: u64) -> Self {
        Self {
            value: rounded(value, 0.0, Self::LACKING, 0),
            state,
        }
    }

    /// Returns the number.
    #[must_use]
    pub const fn value(self) -> f64 {
        self.value
    }

    /// Returns the history of a value as a number. Without random numbers it is that of a constant.
    const fn history(self) -> u64 {
        if self.state == 0 {
            mixed(self.value.to_bits() ^ SUM)
        } else {
            self.state
        }
    }

    /// Returns `high` + `low`, the exact result of an operation, rounded.
    fn result(self, other: Self, operation: u64, [high, low]: [f64; 2]) -> Self {
        let state = if self.state == 0 && other.state == 0 {
            0
        } else {
            // Sums and products commute.
            let own = if operation == QUOTIENT { QUOTIENT } else { 0 };
            let other = mixed(other.history() ^ own);
            // 0 is the state of constants.
            mixed(
                mixed(self.history())
                    .wrapping_add(other)
                    .wrapping_add(operation),
            ) | 1
        };
        Self {
            value: rounded(high, low, Self::LACKING, state),
            state,
        }
    }

    /// Returns `self` / (`divisor` + `rest`).
    fn quotient(self, divisor: Self, rest: f64) -> Self {
        let high = self.value / divisor.value;
        let remainder = (-high).mul_add(divisor.value, self.value) - high * rest;
        self.result(divisor, QUOTIENT, [high, remainder / divisor.value])
    }
}

/// Returns `high` + `low` rounded to 53 − `lacking` bits: to nearest for the state 0, else stochastically. `low` is at most half
/// a unit in the last place of `high`.
fn rounded(high: f64, low: f64, lacking: u32, state: u64) -> f64 {
    if high == 0.0 || !high.is_finite() {
        return high;
    }
    let (magnitude, low) = (high.abs(), low * high.signum());
    let step = 1_u64 << lacking;
    let mut bits = magnitude.to_bits() & !(step - 1);
    if f64::from_bits(bits).total_cmp(&magnitude) == Ordering::Equal && low < 0.0 {
        bits -= step;
    }
    let [below, above] = [bits, bits + step].map(f64::from_bits);
    let (gap, rest) = (above - below, magnitude - below);
    if rest + low == 0.0 {
        return high;
    }
    let goes_up = if above.is_infinite() {
        true
    } else if state == 0 {
        let over_half = (rest - gap / 2.0) + low;
        over_half > 0.0 || over_half == 0.0 && bits & step != 0
    } else {
        // 52 random bits, as a number from 1 to 2.
        let bits = mixed(state ^ QUOTIENT) >> 12 | 1_f64.to_bits();
        let random = f64::from_bits(bits) - 1.0;
        random * gap < rest + low
    };
    (if goes_up { above } else { below }).copysign(high)
}

/// Returns a + b as a float and its rounding error.
fn two_sum(a: f64, b: f64) -> [f64; 2] {
    let sum = a + b;
    let other = sum - a;
    [sum, (a - (sum - other)) + (b - other)]
}

impl<const P: u32> PartialEq for Stochastic<P> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<const P: u32> PartialOrd for Stochastic<P> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl<const P: u32> Add<&Self> for Stochastic<P> {
    type Output = Self;

    fn add(self, other: &Self) -> Self {
        self.result(*other, SUM, two_sum(self.value, other.value))
    }
}

impl<const P: u32> Sub<&Self> for Stochastic<P> {
    type Output = Self;

    fn sub(self, other: &Self) -> Self {
        let state = if other.state == 0 {
            0
        } else {
            mixed(other.state ^ DIFFERENCE) | 1
        };
        let negative = Self {
            value: -other.value,
            state,
        };
        // So that a − b is a + (−b), where −b is 0 − b.
        if self.state == 0 && self.value == 0.0 {
            return negative;
        }
        self + negative
    }
}

impl<const P: u32> Mul<&Self> for Stochastic<P> {
    type Output = Self;

    fn mul(self, other: &Self) -> Self {
        let high = self.value * other.value;
        let low = self.value.mul_add(other.value, -high);
        self.result(*other, PRODUCT, [high, low])
    }
}

cannonpile::ring!([const P: u32] Stochastic<P>);

impl<const P: u32> Ring for Stochastic<P> {
    fn from_integer(n: i128) -> Self {
        Self::from_rational(&BigRational::from_integer(n.into()))
    }
}

impl<const P: u32> Algebra for Stochastic<P> {
    const EXACTNESS: Exactness = Exactness::Rounded { bits: P - 1 };
    const NAME: &'static str = "Stochastic";
    type Numerator = Self;

    fn from_rational(r: &BigRational) -> Self {
        // The sign of the low part is exact, so that this rounds once.
        let nearest = DoubleDouble::from_rational(r);
        let value = rounded(nearest.high(), nearest.low(), Self::LACKING, 0);
        Self { value, state: 0 }
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        let n = DoubleDouble::from_integer(n.get().into());
        let (value, rest) = (n.high(), n.low());
        self.quotient(Self { value, state: 0 }, rest)
    }

    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        let divides = divisor.value != 0.0 && divisor.value.is_finite();
        divides.then(|| self.quotient(*divisor, 0.0))
    }

    fn is_defined(&self) -> bool {
        self.value.is_finite()
    }
}

impl<const P: u32> Field for Stochastic<P> {}

/// Returns the forces of a pile in [`Stochastic`], with the random numbers of a seed.
///
/// Loads of 0 bring the seed and the place of a sphere into the states: on each sphere that lacks a contact from above. All
/// other states follow from these. They change no force.
///
/// # Errors
/// [`Error::TooLarge`] for piles that do not fit in memory.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::{Direction, Region, Site};
/// use cannonpile_accuracy::stochastic_forces;
///
/// let pile = Pile::under(Region::SITE, "+-+-".parse()?)?;
/// let force = |seed| {
///     let forces = stochastic_forces::<11>(&pile, seed)?;
///     forces.contact(Site::new(0, 0, 3), Direction::Alpha).map(|force| force.value())
/// };
/// let exact = pile.forces::<f64>().contact(Site::new(0, 0, 3), Direction::Alpha)?;
/// let values = [force(1)?, force(2)?, force(3)?];
/// assert!(values.iter().all(|value| (value / exact - 1.0).abs() < 0.01));
/// assert_eq!(force(1)?, values[0]);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn stochastic_forces<const P: u32>(
    pile: &Pile,
    seed: u64,
) -> Result<Forces<'_, Stochastic<P>>, Error> {
    let shape = pile.shape();
    let directions = pile.dimension().directions();
    let is_inner = |site: &Site| {
        let mut above = directions
            .iter()
            .map(|direction| shape.above(*site, *direction));
        above.all(|above| above.is_some())
    };
    let mut loads = Vec::new();
    for row in pile.rows(Selection::All)? {
        // Layers are convex.
        let Row { k, j, i } = row;
        let site = |i| Site { i, j, k };
        let first = i.clone().map(site).take_while(|site| !is_inner(site));
        let last = i.rev().map(site).take_while(|site| !is_inner(site));
        loads.extend(first.chain(last).map(|site| (site, load(site, seed))));
    }
    loads.sort_by_key(|(site, _)| *site);
    loads.dedup_by_key(|(site, _)| *site);
    pile.forces().with_loads(loads)
}

/// Returns a load of 0 whose state is that of a place.
fn load<const P: u32>(Site { i, j, k }: Site, seed: u64) -> Load<Stochastic<P>> {
    let add = |state: u64, byte: u8| mixed(state.wrapping_add(SUM) ^ u64::from(byte));
    let bytes = [i, j, k].map(i128::to_le_bytes);
    let state = bytes
        .as_flattened()
        .iter()
        .copied()
        .fold(mixed(seed ^ PRODUCT), add)
        | 1;
    let down = Stochastic { value: 0.0, state };
    Load {
        down,
        x: Stochastic::zero(),
        y: Stochastic::zero(),
    }
}
