//! The stable stackings, for spacings at which α, β, γ are the only contacts.
//!
//! # Under one sphere
//! The forces above a layer do not depend on the layers below. Call the upper part of a stacking, down to some layer, a
//! prefix. If a prefix is unstable, the whole stacking is unstable. A search from the top, run by run, finds the stable
//! stackings and abandons each unstable prefix. The numbers of stable stackings with L layers are, counting one of each
//! mirror pair,
//!
//! | L | 1 | 2 | 3 | 4 | 5 | 6 and more |
//! |---|---|---|---|---|---|---|
//! | stackings | 1 | 1 | 2 | 4 | 8 | 11 |
//!
//! In Zhdanov's notation, with * for a last run of any length, the eleven are (*), (1,*), (2,*), (3,*), (1,1,*),
//! (1,2,*), (2,1,*), (3,1,*), (1,1,1,*), (1,2,1,*) and (2,1,1,*). The sign changes at most three times, within the
//! first five layers. Below them the stacking is straight. Hcp and dhcp are stable up to five layers. The proof:
//!
//! 1. *A run before a sign change has at most four steps.* Let a run of + steps begin at a layer with the side s₀ ≤
//!    i+j. Take a sphere on that side, and the sphere m steps below it along α. No β and no γ line within the run lies
//!    above the lower sphere. Along α it receives f + m − 1, where f ≥ 0 is the force that the upper sphere transmits
//!    along α. At a sign change it transmits 1 − (f + m − 1)/3 along α. This force is tensile (negative) if f + m > 4,
//!    hence for all m ≥ 5. The argument holds under any top, and for − runs by reflection. Theorem `edge` of
//!    the crate `cannonpile-proof` proves it for all f and m.
//! 2. *The rest is a finite search* in exact arithmetic, which [`under_one_sphere`] carries out. With runs of at most
//!    four steps, no stacking with a fourth sign change is stable.
//! 3. *A last run of any length is stable* if its first step is, since within a run the force on each line only grows.
//!
//! With horizontal contacts, at a = R, one more stacking is stable, for the same reasons. The module `census` of the
//! crate `cannonpile-horizontal` contains its table and proof.
//!
//! # On a base
//! For piles built upwards from a base, no such rule holds: a stacking that is unstable with few layers may be stable
//! with more, and conversely. So [`on_base`] continues every stacking to its greatest height and examines it there,
//! without pruning.

use std::collections::BTreeMap;
use std::iter;
use std::marker::PhantomData;

use cannonpile::engine::check_interrupt;
use cannonpile::lattice::{Region, Sign};
use cannonpile::stacking::{Run, Stacking};
use cannonpile::{Error, Pile, Standing};
use num_bigint::BigUint;
use num_traits::{One, Zero};

/// A pile in a census, with its stability.
///
/// # Examples
/// ```
/// use cannonpile_stability::census;
///
/// let entry = census::under_one_sphere(4, false)?.next().unwrap()?;
/// assert_eq!(entry.pile.layers(), 4);
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Entry {
    /// The pile.
    pub pile: Pile,
    /// Its least contact force, and its first unstable layer, if any.
    pub standing: Standing,
}

/// A criterion of stability: an entry of a census is a pile with its verdict. Implement this trait to [`search`] with
/// another criterion.
pub trait StabilityTest: Sized {
    /// The error of the criterion.
    type Error: From<Error>;

    /// The numbers m and n of the bound m·L − n on the number of entries with L ≥ 6 layers, unstable prefixes
    /// included.
    const ENTRIES: [i128; 2];

    /// Examines a pile.
    ///
    /// # Errors
    /// The errors of the criterion.
    fn test(pile: Pile) -> Result<Self, Self::Error>;

    /// Returns whether the pile is stable.
    fn stands(&self) -> bool;
}

impl StabilityTest for Entry {
    type Error = Error;

    const ENTRIES: [i128; 2] = [11, 50];

    fn test(pile: Pile) -> Result<Self, Error> {
        let standing = pile.standing()?;
        Ok(Self { pile, standing })
    }

    fn stands(&self) -> bool {
        self.stands()
    }
}

impl Entry {
    /// Returns whether the pile is stable.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_stability::census;
    ///
    /// let entries: Result<Vec<_>, _> = census::under_one_sphere(6, true)?.collect();
    /// assert_eq!(entries?.iter().filter(|entry| !entry.stands()).count(), 5);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn stands(&self) -> bool {
        self.standing.first_failure.is_none()
    }
}

/// Iterates over the stable stackings of `layers` layers under one sphere, one of each mirror pair: the one that begins
/// with +. With `failing` it also returns the shortest unstable prefixes. The entries are in lexicographic order of the
/// lengths of their runs, without the last run.
///
/// At most eleven stackings are stable (see the module documentation). With unstable prefixes there are 11L − 50
/// entries for L ≥ 6 layers, and the time for all of them grows as L³.
///
/// # Errors
/// [`Error::Layers`] unless 1 ≤ `layers` ≤ 10³⁶; [`Error::TooManyRows`] for more than [`MAX_ENTRIES`] entries with
/// unstable prefixes; in an entry, [`Error::TooLarge`] for unstable prefixes of thousands of layers.
///
/// # Examples
/// ```
/// use cannonpile_stability::census;
///
/// let standing: Result<Vec<_>, _> = census::under_one_sphere(6, false)?.collect();
/// let stackings: Vec<_> = standing?.iter().map(|e| e.pile.shape().stacking().to_string()).collect();
/// assert_eq!(
///     stackings,
///     [
///         "+++++", "+----", "+-+++", "+-+--", "+--++", "+--+-", "++---", "++-++", "++-+-", "+++--", "+++-+",
///     ],
/// );
/// // The number of stable stackings is eleven for every greater number of layers.
/// assert_eq!(census::under_one_sphere(10_i128.pow(36), false)?.count(), 11);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn under_one_sphere(
    layers: i128,
    failing: bool,
) -> Result<impl Iterator<Item = Result<Entry, Error>>, Error> {
    search(layers, failing)
}

/// Searches the stackings of `layers` layers under one sphere from the top, with the criterion of stability of `E`.
///
/// The criterion must satisfy three conditions. Every prefix of a stable stacking is stable. A stable stacking with
/// its last step repeated is stable. A stacking with more than four steps before a sign change is unstable.
///
/// # Errors
/// As for [`under_one_sphere`]. Each entry may have an error of its criterion.
///
/// # Examples
/// ```
/// use cannonpile_stability::census::{self, Entry};
///
/// assert_eq!(census::search::<Entry>(3, false)?.count(), 2);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn search<E: StabilityTest>(
    layers: i128,
    failing: bool,
) -> Result<impl Iterator<Item = Result<E, E::Error>>, Error> {
    // `fcc` checks the number of layers. A single layer has zero steps.
    let steps = Stacking::fcc(layers)?.layers() - 1;
    // An upper bound of the number of entries for six layers or more. With fewer layers the number is far below
    // `MAX_ENTRIES`.
    let [of_a_layer, less] = E::ENTRIES;
    let rows = of_a_layer * layers - less;
    if failing && rows > MAX_ENTRIES.into() {
        return Err(Error::TooManyRows {
            rows: rows.unsigned_abs().into(),
            limit: MAX_ENTRIES,
            remedy: "ask for fewer layers, or only for stable stackings",
        });
    }
    Ok(Search {
        steps,
        failing,
        pending: vec![Pending {
            prefix: Prefix::default(),
            next: None,
        }],
        criterion: PhantomData,
    })
}

/// The greatest number of entries of a census.
pub const MAX_ENTRIES: u64 = 100_000_000_000;

/// The greatest length of a run before a sign change in a stable stacking (see the module documentation, 1).
const LONGEST_RUN: i128 = 4;

/// The lengths of the first runs of a stacking. The first run has the sign +, and another run follows the last.
#[derive(Clone, Debug, Default)]
struct Prefix(Vec<i128>);

impl Prefix {
    /// Returns the pile of these runs and a last run of `last` steps.
    fn pile(&self, last: i128) -> Result<Pile, Error> {
        let signs = [Sign::Plus, Sign::Minus].into_iter().cycle();
        let lengths = self.0.iter().copied().chain([last]);
        let runs = lengths.zip(signs).map(|(steps, sign)| Run { sign, steps });
        Pile::under(Region::SITE, Stacking::from_runs(runs)?)
    }

    fn followed_by(&self, run: i128) -> Self {
        let mut runs = self.0.clone();
        runs.push(run);
        Self(runs)
    }
}

/// A depth-first search over prefixes. The last element of `pending` comes next.
struct Search<E> {
    steps: i128,
    failing: bool,
    pending: Vec<Pending>,
    criterion: PhantomData<E>,
}

/// A prefix to visit if `next` is `None`. Otherwise the prefixes that continue it by one run, from the length
/// `next` on.
struct Pending {
    prefix: Prefix,
    next: Option<i128>,
}

impl<E: StabilityTest> Search<E> {
    /// Visits a prefix. If it is stable one step after its last sign change, returns its continuation to all layers
    /// and schedules the longer prefixes. Otherwise returns the unstable prefix, if `failing`.
    fn visit(&mut self, prefix: Prefix) -> Result<Option<E>, E::Error> {
        check_interrupt()?;
        if !prefix.0.is_empty() {
            let first_step = E::test(prefix.pile(1)?)?;
            if !first_step.stands() {
                return Ok(Some(first_step).filter(|_| self.failing));
            }
        }
        let entry = E::test(prefix.pile(self.left(&prefix))?)?;
        self.pending.push(Pending {
            prefix,
            next: Some(1),
        });
        Ok(Some(entry))
    }

    /// Returns the number of steps after a prefix.
    fn left(&self, prefix: &Prefix) -> i128 {
        self.steps - prefix.0.iter().sum::<i128>()
    }
}

impl<E: StabilityTest> Iterator for Search<E> {
    type Item = Result<E, E::Error>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let Pending { prefix, next } = self.pending.pop()?;
            let visited = match next {
                None => prefix,
                Some(run) => {
                    let left = self.left(&prefix) - 1;
                    let longest = if self.failing {
                        left
                    } else {
                        left.min(LONGEST_RUN)
                    };
                    if run > longest {
                        continue;
                    }
                    let longer = prefix.followed_by(run);
                    let next = Some(run + 1);
                    self.pending.push(Pending { prefix, next });
                    longer
                }
            };
            if let Some(entry) = self.visit(visited).transpose() {
                return Some(entry);
            }
        }
    }
}

/// Iterates over the stackings of a base, each continued upwards until both signs lead to an empty layer. If the base
/// is its own mirror image, it returns one of each mirror pair: the one whose first step at the base is +.
///
/// A base that supports L layers may have 2^(L−2) entries. They are computed one by one.
///
/// # Errors
/// [`Error::TooManyRows`] for a base with more than [`MAX_ENTRIES`] stackings. The error contains their number, or a
/// lower bound above 10⁴⁰.
///
/// # Examples
/// ```
/// use cannonpile_stability::census;
/// use cannonpile::lattice::Region;
///
/// let mut entries = census::on_base(Region::triangle(4)?)?;
/// let straight = entries.next().unwrap()?;
/// assert_eq!((straight.pile.layers(), straight.stands()), (4, true));
/// assert!(census::on_base(Region::hexagon(50, 50)?).is_err());
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn on_base(base: Region) -> Result<impl Iterator<Item = Result<Entry, Error>>, Error> {
    carried_up(base)
}

/// Iterates over the stackings of a base, each continued to its greatest height, with the criterion of stability of
/// `E`.
///
/// # Errors
/// As for [`on_base`]. Each entry may have an error of its criterion.
///
/// # Examples
/// ```
/// use cannonpile_stability::census::{self, Entry};
/// use cannonpile::lattice::Region;
///
/// assert!(census::carried_up::<Entry>(Region::triangle(4)?)?.count() > 1);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn carried_up<E: StabilityTest>(
    base: Region,
) -> Result<impl Iterator<Item = Result<E, E::Error>>, Error> {
    let rows = stackings_of(base);
    if rows > BigUint::from(MAX_ENTRIES) {
        return Err(Error::TooManyRows {
            rows,
            limit: MAX_ENTRIES,
            remedy: "ask for a smaller base",
        });
    }
    let one_of_two = base.is_its_own_mirror_image();
    // `signs` contains the steps from the base to the current layer. `pending` contains the layers still to visit, each
    // with its height and the step that leads to it.
    let mut signs: Vec<Sign> = Vec::new();
    let mut pending: Vec<(usize, Option<Sign>, Region)> = vec![(0, None, base)];
    Ok(iter::from_fn(move || {
        loop {
            let (height, last, top) = pending.pop()?;
            signs.truncate(height.saturating_sub(1));
            signs.extend(last);
            let mut higher = false;
            for sign in [Sign::Minus, Sign::Plus] {
                let Some(above) = top.eroded(sign) else {
                    continue;
                };
                higher = true;
                if height > 0 || !one_of_two || sign == Sign::Plus {
                    pending.push((height + 1, Some(sign), above));
                }
            }
            if !higher {
                let from_top = Stacking::from_signs(signs.iter().rev().copied());
                let pile = from_top.and_then(|stacking| Pile::on(base, stacking));
                return Some(pile.map_err(E::Error::from).and_then(E::test));
            }
        }
    }))
}

/// Returns the number of entries of a base. If it exceeds 10⁴⁰, returns a lower bound above 10⁴⁰.
///
/// The region after some steps depends on the numbers of + and − steps, but not on their order. So this function counts
/// the ways to every such region, height by height.
fn stackings_of(base: Region) -> BigUint {
    let enough = BigUint::from(10_u32).pow(40);
    let mut stackings = BigUint::zero();
    let mut one_of_two = base.is_its_own_mirror_image();
    let ways_of = |remainders: &BTreeMap<usize, (Region, BigUint)>| {
        let ways = remainders.values().map(|(_, ways)| ways);
        ways.sum::<BigUint>()
    };
    // The remaining region and the number of ways to it, by the number of + steps.
    let mut remainders = BTreeMap::from([(0, (base, BigUint::one()))]);
    // Every way continues to at least one stacking of its own.
    while ways_of(&remainders) <= enough && !remainders.is_empty() {
        let mut above: BTreeMap<usize, (Region, BigUint)> = BTreeMap::new();
        for (plus, (region, ways)) in remainders {
            let mut higher = false;
            for (sign, plus) in [(Sign::Plus, plus + 1), (Sign::Minus, plus)] {
                let Some(left) = region.eroded(sign) else {
                    continue;
                };
                higher = true;
                // Only one of two mirror images is an entry.
                if one_of_two && sign == Sign::Minus {
                    continue;
                }
                above.entry(plus).or_insert((left, BigUint::ZERO)).1 += &ways;
            }
            if !higher {
                stackings += ways;
            }
        }
        one_of_two = false;
        remainders = above;
    }
    stackings + ways_of(&remainders)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_counted_before_they_are_made() -> Result<(), Error> {
        let triangles = (1..=7).map(Region::triangle);
        let hexagons = [(2, 2), (3, 2), (2, 3), (4, 2)].map(|(p, q)| Region::hexagon(p, q));
        for base in triangles.chain(hexagons) {
            let base = base?;
            assert_eq!(stackings_of(base), on_base(base)?.count().into(), "{base}");
        }
        Ok(())
    }
}
