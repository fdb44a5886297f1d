//! The tilts of gravity that a pile bears.

use cannonpile::each::Each;
use cannonpile::engine::{bug, check_interrupt, equality};
use cannonpile::geometry::square_across;
use cannonpile::lattice::{Dimension, Direction, Site};
use cannonpile::scalar::{Algebra, ByValue};
use cannonpile::shape::{Anchor, Selection};
use cannonpile::stacking::{Run, Stacking};
use cannonpile::{ContactForce, Forces, Pile};
use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use crate::Error;

/// The greatest number of contacts for which [`margin`] computes all forces.
const MOST_EXAMINED: u64 = 20_000;

/// A tilt of gravity (x, y), in the units of [`Pile::with_tilt`].
pub type Tilt = [BigRational; 2];

/// A contact force as a function of the tilt, c + a·x + b·y in f₀, or another quantity that is negative for tilts that a
/// pile does not bear.
#[derive(Clone, Debug)]
pub struct Affine {
    /// The value under upright gravity.
    pub c: BigRational,
    /// The factor of x.
    pub a: BigRational,
    /// The factor of y.
    pub b: BigRational,
}

equality!(Affine; |Self { c, a, b }| [c, a, b].map(ByValue));

impl Affine {
    /// Returns the function with the values at the tilts (0, 0), (1, 0) and (0, 1).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::ratio;
    /// use cannonpile_stability::Affine;
    ///
    /// let force = Affine::through([ratio!(1), ratio!(0), ratio!(-2)]);
    /// assert_eq!(force.at(&[ratio!(1/2), ratio!(1/6)]), ratio!(0));
    /// ```
    #[must_use]
    pub fn through([c, at_x, at_y]: [BigRational; 3]) -> Self {
        Self {
            a: at_x - &c,
            b: at_y - &c,
            c,
        }
    }

    /// Returns the value at a tilt.
    #[must_use]
    pub fn at(&self, [x, y]: &Tilt) -> BigRational {
        &self.a * x + &self.b * y + &self.c
    }

    /// Returns the tilt of least |t| at which the function is zero, and |t|². `across` is 4cos²φ. `None` for a constant.
    fn nearest_zero(&self, across: &BigRational) -> Option<(BigRational, Tilt)> {
        // The gradient by the tilt, and its square a² + b²/4cos²φ.
        let gradient = [self.a.clone(), self.b.checked_div(across)?];
        let square = &gradient[0] * &self.a + &gradient[1] * &self.b;
        let along = (-&self.c).checked_div(&square)?;
        let tilt = gradient.each(|part| part * &along);
        Some((&self.c * &self.c / square, tilt))
    }
}

/// The tilts of gravity that a pile bears. Made by [`tilts`].
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Tilts<C = (Site, Direction)> {
    /// The least tilt at which a contact opens, or `None` if the pile does not stand upright.
    pub margin: Option<Margin<C>>,
    /// The corners of the polygon of tilts that the pile bears, counterclockwise. For discs these are the two ends of an
    /// interval along x. Empty if no tilt makes the pile stable.
    pub corners: Vec<Tilt>,
}

equality!(Tilts<C>, C: PartialEq; |Self { margin, corners }| (margin, corners.iter().map(by_value).collect::<Vec<_>>()));

/// The least tilt at which a contact opens.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Margin<C = (Site, Direction)> {
    /// t_c²: the square of tan(tilt)/tanθ.
    pub squared: BigRational,
    /// The tilt. Of several, it is one of them.
    pub tilt: Tilt,
    /// The contact that opens there.
    pub opens: C,
}

equality!(Margin<C>, C: PartialEq; |Self { squared, tilt, opens }| (ByValue(squared), by_value(tilt), opens));

fn by_value(tilt: &Tilt) -> [ByValue<'_>; 2] {
    tilt.each_ref().map(ByValue)
}

fn contains(tilts: &[Tilt], tilt: &Tilt) -> bool {
    tilts.iter().any(|known| by_value(known) == by_value(tilt))
}

/// Returns the tilts of gravity that a pile bears in addition to its own, and the least one at which a contact opens.
///
/// The answer applies to spacings without contacts other than α, β and γ. The cost is that of some ten verdicts
/// ([`Pile::stands`]) on tilted piles.
///
/// Under gravity that leans by the tilt t = (x, y), every contact force is an affine function c + a·x + b·y with rational
/// c, a and b. A pile bears a tilt if no force is negative. So the tilts that it bears are a convex polygon with rational
/// corners. A side of it is the line on which a contact opens. In real units the square of the tilt is |t|² = x² +
/// 4cos²φ·y², times tan²θ, so this line is at the distance t_c with t_c² = c²/(a² + b²/(4cos²φ)) from upright gravity.
///
/// # Search
/// The polygon is found by its corners. The search begins with a square. It asks for the smallest contact force at each
/// corner. If this force is negative, the line on which it is zero cuts the corner off. The search ends when the pile
/// bears every corner, because then it bears the whole polygon. There are finitely many contacts, and each cuts at most
/// once.
///
/// # Known margins
/// A straight pile under any top bears the triangle of tilts that one sphere alone bears, so t_c = ½. This is theorem
/// `tilt` of the crate `cannonpile-proof`. Of the eleven stackings that are stable under one sphere, two have the margin
/// 0.
///
/// # Errors
/// [`Error::NoWeight`] for a pile that no tilt affects; otherwise as for [`Pile::stands`].
///
/// # Examples
/// ```
/// use cannonpile::lattice::Region;
/// use cannonpile::{Pile, ratio};
/// use cannonpile_stability::tilts;
///
/// // tan(tilt) = ½ tanθ, for every number of layers.
/// let pile = Pile::triangular(10_i128.pow(30))?;
/// assert_eq!(tilts(&pile)?.margin.unwrap().squared, ratio!(1/4));
///
/// let pile = Pile::under(Region::SITE, "+-+++".parse()?)?;
/// let tilts = tilts(&pile)?;
/// assert_eq!(tilts.margin.unwrap().squared, ratio!(1/43));
/// // Gravity may lean further in other directions.
/// assert!(tilts.corners.len() >= 3);
/// # Ok::<(), cannonpile_stability::Error>(())
/// ```
pub fn tilts(pile: &Pile) -> Result<Tilts, Error> {
    tilts_by_oracle(pile, |tilt| {
        let leaning = pile.clone().with_tilt(tilt.clone())?;
        let Some(contact) = leaning.tensile_contact()? else {
            return Ok(None);
        };
        let (site, direction) = (contact.site, contact.direction);
        let force = force_by_tilt(pile, site, direction)?;
        Ok(Some((force, (site, direction))))
    })
}

/// Returns the margin of [`tilts`]. Up to 20,000 contacts, all forces are computed. Then the contact is the first in the
/// order of tables, if several open at the least tilt.
///
/// A pile of spheres of weight mg under a top is cut off one step below its last sign change. No further layer changes the
/// margin, because at the tilt ½, at which the top spheres alone roll off, no increment is negative.
///
/// # Errors
/// As for [`tilts`].
pub fn margin(pile: &Pile) -> Result<Option<Margin>, Error> {
    let short = above_last_run(pile)?;
    let pile = short.as_ref().unwrap_or(pile);
    if pile.contact_count() > MOST_EXAMINED.into() {
        return Ok(tilts(pile)?.margin);
    }
    check_weight(pile)?;
    let all = |forces: &Forces<'_, BigRational>| forces.contacts(Selection::All)?.collect();
    let [upright, along_x, along_y]: [Vec<ContactForce<_>>; 3] = under_three_tilts(pile, all)?;
    let contacts = upright.into_iter().zip(along_x.into_iter().zip(along_y));
    let forces = contacts.map(|(upright, (along_x, along_y))| {
        let force = Affine::through([upright.force, along_x.force, along_y.force]);
        (force, (upright.site, upright.direction))
    });
    Ok(least_margin(pile, forces))
}

/// Returns the upper part of the pile, to one step below the last sign change, if the margin depends on it alone.
#[doc(hidden)]
pub fn above_last_run(pile: &Pile) -> Result<Option<Pile>, Error> {
    let (Anchor::Top(top), true) = (pile.shape().anchor(), pile.is_uniform()) else {
        return Ok(None);
    };
    if pile.dimension() == Dimension::Two || !pile.is_regular() {
        return Ok(None);
    }
    let mut runs: Vec<Run> = pile.shape().stacking().runs().collect();
    if let Some(last) = runs.last_mut() {
        last.steps = 1;
    }
    Ok(Some(Pile::under(top, Stacking::from_runs(runs)?)?))
}

/// Returns the force of a contact as a function of a further tilt.
///
/// # Errors
/// As for [`Forces::contact`].
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Direction, Site};
/// use cannonpile::{Pile, ratio};
/// use cannonpile_stability::force_by_tilt;
///
/// let force = force_by_tilt(&Pile::triangular(10)?, Site::APEX, Direction::Alpha)?;
/// assert_eq!([force.c, force.a, force.b], [ratio!(1), ratio!(-1), ratio!(-3)]);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn force_by_tilt(
    pile: &Pile,
    site: Site,
    direction: Direction,
) -> Result<Affine, cannonpile::Error> {
    let values = under_three_tilts(pile, |forces| forces.contact(site, direction))?;
    Ok(Affine::through(values))
}

/// Returns what `read` finds in the forces under the further tilts (0, 0), (1, 0) and (0, 1). For discs the last one is
/// (0, 0).
fn under_three_tilts<V>(
    pile: &Pile,
    read: impl Fn(&Forces<'_, BigRational>) -> Result<V, cannonpile::Error>,
) -> Result<[V; 3], cannonpile::Error> {
    let along_y = i128::from(pile.dimension() == Dimension::Three);
    let at = |tilt: [i128; 2]| {
        let forces = pile.forces::<BigRational>();
        read(&forces.with_tilt(tilt.each(|n| BigRational::from_integer(n.into())))?)
    };
    Ok([at([0, 0])?, at([1, 0])?, at([0, along_y])?])
}

/// Returns the tilts that a pile bears, by an oracle. For a tilt that it does not bear, the oracle returns a function
/// that is negative there and nowhere in the polygon, and what the function belongs to.
///
/// # Errors
/// [`Error::NoWeight`] if no sphere above the floor has a weight; those of the oracle.
pub fn tilts_by_oracle<C: Clone, E: From<Error>>(
    pile: &Pile,
    mut refute: impl FnMut(&Tilt) -> Result<Option<(Affine, C)>, E>,
) -> Result<Tilts<C>, E> {
    check_weight(pile)?;
    let (mut cuts, mut accepted): (Vec<(Affine, C)>, Vec<Tilt>) = (Vec::new(), Vec::new());
    let mut reach = BigRational::from_integer(4.into());
    let corners = loop {
        let mut corners = square(&reach, pile.dimension());
        for (force, _) in &cuts {
            corners = cut(&corners, force);
        }
        while let Some(corner) = corners.iter().find(|corner| !contains(&accepted, corner)) {
            check_interrupt().map_err(Error::from)?;
            let corner = corner.clone();
            match refute(&corner)? {
                None => accepted.push(corner),
                Some((force, label)) if force.at(&corner).is_negative() => {
                    corners = cut(&corners, &force);
                    cuts.push((force, label));
                }
                Some(_) => {
                    return Err(
                        Error::from(bug("a force that refutes a tilt is negative there")).into(),
                    );
                }
            }
        }
        // A pile with a weight bears no tilt beyond some square.
        let is_inside = |tilt: &Tilt| tilt.iter().all(|part| (part.abs() - &reach).is_negative());
        if corners.iter().all(is_inside) {
            break corners;
        }
        reach *= BigRational::from_integer((1 << 16).into());
    };
    Ok(Tilts {
        margin: least_margin(pile, cuts),
        corners,
    })
}

/// Returns the least tilt at which a function is zero, and the first of the functions that are zero there. `None` if a
/// function is negative under upright gravity.
fn least_margin<C>(
    pile: &Pile,
    forces: impl IntoIterator<Item = (Affine, C)>,
) -> Option<Margin<C>> {
    let across = square_across(pile.sin_phi());
    let mut least: Option<Margin<C>> = None;
    for (force, opens) in forces {
        if force.c.is_negative() {
            return None;
        }
        let Some((squared, tilt)) = force.nearest_zero(&across) else {
            continue;
        };
        let is_less = |least: &Margin<C>| ByValue(&squared) < ByValue(&least.squared);
        if least.as_ref().is_none_or(is_less) {
            least = Some(Margin {
                squared,
                tilt,
                opens,
            });
        }
    }
    least
}

/// Returns an error for a pile on which a tilt of gravity has no effect.
fn check_weight(pile: &Pile) -> Result<(), Error> {
    let floor = pile.layers() - 1;
    let above = || pile.weights().filter(|(site, _)| site.k < floor);
    let without = above().filter(|(_, weight)| weight.is_zero()).count();
    let spheres = pile.sphere_count() - pile.base_sphere_count();
    if pile.is_weightless() || BigUint::from(without) == spheres {
        return Err(Error::NoWeight);
    }
    Ok(())
}

/// Returns the corners of the square |x|, |y| ≤ `reach`, counterclockwise. For discs, the ends of an interval along x.
fn square(reach: &BigRational, dimension: Dimension) -> Vec<Tilt> {
    let corner =
        |x: i128, y: i128| [x, y].each(|sign| reach * BigRational::from_integer(sign.into()));
    match dimension {
        Dimension::Two => Vec::from([corner(-1, 0), corner(1, 0)]),
        Dimension::Three => Vec::from([corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)]),
    }
}

/// Returns the corners of the part of a convex polygon in which a function is not negative.
fn cut(corners: &[Tilt], force: &Affine) -> Vec<Tilt> {
    let mut kept: Vec<Tilt> = Vec::new();
    let next = corners.iter().cycle().skip(1);
    for (here, next) in corners.iter().zip(next) {
        let [value, beyond] = [force.at(here), force.at(next)];
        if !value.is_negative() {
            kept.push(here.clone());
        }
        if (&value * &beyond).is_negative() {
            let share = &value / (&value - beyond);
            let [x, y] = [0, 1].each(|axis| &here[axis] + (&next[axis] - &here[axis]) * &share);
            kept.push([x, y]);
        }
    }
    kept.dedup_by(|here, before| by_value(here) == by_value(before));
    if let [first, .., last] = &kept[..]
        && by_value(first) == by_value(last)
    {
        kept.pop();
    }
    kept
}
