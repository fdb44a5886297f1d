//! Which stackings stand, at spacings at which nothing touches beside the contacts.
//!
//! # Under one sphere
//! The forces above a layer do not depend on what lies below it, so a beginning that fails never recovers, and the
//! stackings that stand are found from the top, run by run, leaving off where a beginning fails. Of L layers there
//! stand, one of each mirror pair,
//!
//! | L | 1 | 2 | 3 | 4 | 5 | 6 and more |
//! |---|---|---|---|---|---|---|
//! | stackings | 1 | 1 | 2 | 4 | 8 | 11 |
//!
//! In Zhdanov's notation, with * for a last run of any length, the eleven are (*), (1,*), (2,*), (3,*), (1,1,*),
//! (1,2,*), (2,1,*), (3,1,*), (1,1,1,*), (1,2,1,*) and (2,1,1,*): the sign changes three times at most, within the first five
//! layers, and then the pile is straight for ever. HCP and DHCP stand up to five layers. The proof:
//!
//! 1. *A run before a change has at most four steps.* Let a run of + steps begin at a layer with the side s₀ ≤ i+j, and
//!    take a sphere on that side, and the one m steps straight along α below it. No β and no γ line within the run lies
//!    above the latter, and along α it receives f + m − 1, where f ≥ 0 is what the former passes on along α, itself
//!    included. If the sign changes there, it passes on 1 − (f + m − 1)/3 along α: negative if f + m > 4, hence for all
//!    m ≥ 5. (Proved for all f and m: theorem `edge` of [`theorem`](crate::theorem). Of − runs the mirror image.) This
//!    holds under any top.
//! 2. *The rest is a finite search*, in exact arithmetic: of runs of at most four steps no fourth change of sign
//!    stands ([`under_one_sphere`] carries it out).
//! 3. *A last run of any length stands* if its first step does, since within a run lines only grow.
//!
//! With horizontal contacts, at a = R, one more stands, by the same reasons: `horizontal::census`, of the feature
//! `horizontal`, has the table and the proof.
//!
//! # On a base
//! Counted from a base up nothing so simple holds: what fails with few layers on it may stand with more, and the other
//! way round. So every stacking is carried as high as it goes, and looked at there ([`on_base`]); nothing is pruned.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use core::marker::PhantomData;

use num_bigint::BigUint;
use num_traits::{One, Zero};

use crate::engine::check_interrupt;
use crate::lattice::{Region, Sign};
use crate::stacking::{Run, Stacking};
use crate::{Error, Pile, Standing};

/// A stacking, and whether it stands.
///
/// # Examples
/// ```
/// use cannonpile::census;
///
/// let entry = census::under_one_sphere(4, false)?.next().unwrap()?;
/// assert_eq!(entry.pile.layers(), 4);
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Entry {
    /// The pile of this stacking.
    pub pile: Pile,
    /// Its least contact force, and where it fails, if it does.
    pub standing: Standing,
}

/// A pile with a verdict on it: what a census lists. Another crate can search with a criterion of its own ([`search`]).
pub trait Judged: Sized {
    /// Why no verdict could be given.
    type Error: From<Error>;

    /// The numbers m and n of which m·L − n bounds the entries of a census of L ≥ 6 layers with those that fail.
    const ENTRIES: [i128; 2];

    /// Gives the verdict on a pile.
    ///
    /// # Errors
    /// Those of the criterion.
    fn judge(pile: Pile) -> Result<Self, Self::Error>;

    /// Returns whether the pile is stable.
    fn stands(&self) -> bool;
}

impl Judged for Entry {
    type Error = Error;

    const ENTRIES: [i128; 2] = [11, 50];

    fn judge(pile: Pile) -> Result<Self, Error> {
        let standing = pile.standing()?;
        Ok(Self { pile, standing })
    }

    fn stands(&self) -> bool {
        self.stands()
    }
}

impl Entry {
    /// Whether it stands.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::census;
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

/// The stackings of `layers` layers under one sphere that stand, one of each mirror pair (the one that begins with +);
/// with `failing`, also the shortest beginnings that fail. In order of their runs.
///
/// Of those that stand there are at most eleven (module documentation); with what fails there are 11L − 50 for six
/// layers or more, and the time for all of them grows like L³.
///
/// # Errors
/// [`Error::Layers`] unless 1 ≤ `layers` ≤ 10³⁶; [`Error::TooManyRows`] for more than [`MAX_ENTRIES`] with what fails;
/// in an entry, [`Error::TooLarge`] for failing beginnings of thousands of layers.
///
/// # Examples
/// ```
/// use cannonpile::census;
///
/// let standing: Result<Vec<_>, _> = census::under_one_sphere(6, false)?.collect();
/// let stackings: Vec<_> = standing?.iter().map(|e| e.pile.shape().stacking().to_string()).collect();
/// assert_eq!(
///     stackings,
///     [
///         "+++++", "+----", "+-+++", "+-+--", "+--++", "+--+-", "++---", "++-++", "++-+-", "+++--", "+++-+",
///     ],
/// );
/// // However many layers there are, no more than these stand.
/// assert_eq!(census::under_one_sphere(10_i128.pow(36), false)?.count(), 11);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn under_one_sphere(
    layers: i128,
    failing: bool,
) -> Result<impl Iterator<Item = Result<Entry, Error>>, Error> {
    search(layers, failing)
}

/// Searches the stackings of `layers` layers under one sphere from the top, by the criterion of `E`.
///
/// The criterion must be such that every beginning of a stable stacking is stable, so is a stable one with its last step
/// repeated, and no run of more than four steps before a sign change is.
///
/// # Errors
/// As for [`under_one_sphere`]; each entry has those of its criterion.
///
/// # Examples
/// ```
/// use cannonpile::census::{self, Entry};
///
/// assert_eq!(census::search::<Entry>(3, false)?.count(), 2);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn search<E: Judged>(
    layers: i128,
    failing: bool,
) -> Result<impl Iterator<Item = Result<E, E::Error>>, Error> {
    // The number is checked here; a single layer has no step.
    let steps = Stacking::fcc(layers)?.layers() - 1;
    // As many as are listed, and no fewer for less than six layers.
    let [of_a_layer, less] = E::ENTRIES;
    let rows = of_a_layer * layers - less;
    if failing && rows > MAX_ENTRIES.into() {
        return Err(Error::TooManyRows {
            rows: rows.unsigned_abs().into(),
            limit: MAX_ENTRIES,
            remedy: "ask for fewer layers, or only for those that stand",
        });
    }
    Ok(Search {
        steps,
        failing,
        waiting: alloc::vec![Waiting {
            beginning: Beginning::default(),
            next: None,
        }],
        judged: PhantomData,
    })
}

/// The most entries of a census.
pub const MAX_ENTRIES: u64 = 100_000_000_000;

/// The longest run before a change of sign that may stand (module documentation, 1).
const LONGEST_RUN: i128 = 4;

/// Runs of alternating signs, + first, each followed by another.
#[derive(Clone, Debug, Default)]
struct Beginning(Vec<i128>);

impl Beginning {
    /// The pile of these runs and one more of `last` steps.
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

/// Beginnings still to be looked at, the next one last.
struct Search<E> {
    steps: i128,
    failing: bool,
    waiting: Vec<Waiting>,
    judged: PhantomData<E>,
}

/// A beginning itself, or the beginnings that follow it with one run more, from the next length on.
struct Waiting {
    beginning: Beginning,
    next: Option<i128>,
}

impl<E: Judged> Search<E> {
    /// The entry of a beginning: itself carried to all layers, if its last change of sign stands, with the longer
    /// beginnings put in line; or its failure.
    fn visit(&mut self, beginning: Beginning) -> Result<Option<E>, E::Error> {
        check_interrupt()?;
        if !beginning.0.is_empty() {
            let first_step = E::judge(beginning.pile(1)?)?;
            if !first_step.stands() {
                return Ok(Some(first_step).filter(|_| self.failing));
            }
        }
        let entry = E::judge(beginning.pile(self.left(&beginning))?)?;
        self.waiting.push(Waiting {
            beginning,
            next: Some(1),
        });
        Ok(Some(entry))
    }

    /// The steps after a beginning.
    fn left(&self, beginning: &Beginning) -> i128 {
        self.steps - beginning.0.iter().sum::<i128>()
    }
}

impl<E: Judged> Iterator for Search<E> {
    type Item = Result<E, E::Error>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let Waiting { beginning, next } = self.waiting.pop()?;
            let visited = match next {
                None => beginning,
                Some(run) => {
                    let left = self.left(&beginning) - 1;
                    let longest = if self.failing {
                        left
                    } else {
                        left.min(LONGEST_RUN)
                    };
                    if run > longest {
                        continue;
                    }
                    let longer = beginning.followed_by(run);
                    let next = Some(run + 1);
                    self.waiting.push(Waiting { beginning, next });
                    longer
                }
            };
            if let Some(entry) = self.visit(visited).transpose() {
                return Some(entry);
            }
        }
    }
}

/// Every stacking of a base, carried up until no site is left whichever sign comes next; of two that are mirror images
/// of each other only the one that begins, at the base, with +, if the base is its own mirror image.
///
/// As many as 2^(L−2) for a base that carries L layers, made one by one.
///
/// # Errors
/// [`Error::TooManyRows`] for a base of more than [`MAX_ENTRIES`] stackings, with their number, or with one that they
/// exceed if they are more than 10⁴⁰.
///
/// # Examples
/// ```
/// use cannonpile::census;
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

/// Carries every stacking of a base as high as it goes, and judges it by the criterion of `E`.
///
/// # Errors
/// As for [`on_base`]; each entry has those of its criterion.
///
/// # Examples
/// ```
/// use cannonpile::census::{self, Entry};
/// use cannonpile::lattice::Region;
///
/// assert!(census::carried_up::<Entry>(Region::triangle(4)?)?.count() > 1);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn carried_up<E: Judged>(
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
    // The steps up to a layer, from the base, and the layers still to be visited, each with the last step to it.
    let mut signs: Vec<Sign> = Vec::new();
    let mut waiting: Vec<(usize, Option<Sign>, Region)> = alloc::vec![(0, None, base)];
    Ok(core::iter::from_fn(move || {
        loop {
            let (height, last, top) = waiting.pop()?;
            signs.truncate(height.saturating_sub(1));
            signs.extend(last);
            let mut higher = false;
            for sign in [Sign::Minus, Sign::Plus] {
                let Some(above) = top.eroded(sign) else {
                    continue;
                };
                higher = true;
                if height > 0 || !one_of_two || sign == Sign::Plus {
                    waiting.push((height + 1, Some(sign), above));
                }
            }
            if !higher {
                let from_top = Stacking::from_signs(signs.iter().rev().copied());
                let pile = from_top.and_then(|stacking| Pile::on(base, stacking));
                return Some(pile.map_err(E::Error::from).and_then(E::judge));
            }
        }
    }))
}

/// Returns the number of entries of a base, or one above 10⁴⁰ that it is not less than.
///
/// What is left after some steps depends on how many of them are + and how many −, and not on their order. So the ways to
/// every such remainder are counted, height by height.
fn stackings_of(base: Region) -> BigUint {
    let enough = BigUint::from(10_u32).pow(40);
    let mut stackings = BigUint::zero();
    let mut one_of_two = base.is_its_own_mirror_image();
    let ways_of = |remainders: &BTreeMap<usize, (Region, BigUint)>| {
        remainders.values().map(|(_, ways)| ways).sum::<BigUint>()
    };
    // By the number of + steps: what is left, and the ways to it.
    let mut remainders = BTreeMap::from([(0_usize, (base, BigUint::one()))]);
    // Every way leads on to a stacking of its own.
    while ways_of(&remainders) <= enough && !remainders.is_empty() {
        let mut above: BTreeMap<usize, (Region, BigUint)> = BTreeMap::new();
        for (plus, (region, ways)) in remainders {
            let mut higher = false;
            for (sign, plus) in [(Sign::Plus, plus + 1), (Sign::Minus, plus)] {
                let Some(left) = region.eroded(sign) else {
                    continue;
                };
                higher = true;
                // Of mirror images one is listed.
                if one_of_two && sign == Sign::Minus {
                    continue;
                }
                above
                    .entry(plus)
                    .or_insert_with(|| (left, BigUint::zero()))
                    .1 += &ways;
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
