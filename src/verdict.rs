//! Stability of piles.
//!
//! Contacts transmit compressive forces only. If α, β and γ are the only contacts, the forces are unique. A negative
//! force then means that no frictionless equilibrium exists, so the pile is unstable ([`paper`](crate::paper#tension)).
//! A force of zero is allowed.
//!
//! At some spacings further spheres touch: at q = (a/R)² = 1, at q = 9/4 with a sign change, and at q = 8/3 without
//! one. At these spacings, nonnegative forces still prove stability, but a negative force proves nothing. At q = 1 the
//! function `equilibrium` of the crate `cannonpile-horizontal` decides.
//!
//! Within a run the force along a line grows by one increment a sphere. If no increment is negative, the smallest force
//! is where a line begins: at a surface or at a sign change. Only the layers at sign changes need a search. If gravity
//! leans so far that an increment is negative, the smallest force may also be at the end of a run. Loads with a negative
//! increment, and horizontal contacts, add single spheres to look at.

mod base;

pub use base::BaseExtremes;

use alloc::vec::Vec;

use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::each::Each;
use crate::engine::{
    Grid, LineForces, LineSelection, MAX_NUMBERS, Meter, Planes, SphereForces, Sweep,
    shortest_exact_sweep, trees_are_cheaper, unless_too_large,
};
use crate::error::{bug, named, refuse_beyond};
use crate::formula;
use crate::geometry::LayerGap;
use crate::lattice::{Dimension, Direction, Sign, Site};
use crate::scalar::ByValue;
use crate::shape::{Selection, Shape};
use crate::sorted::distinct;
use crate::{ContactForce, Error, Packing, Pile};

/// The verdict on the stability of a pile.
///
/// # Examples
/// ```
/// use cannonpile::{Pile, Verdict};
///
/// assert_eq!(Pile::triangular(10)?.stands()?, Verdict::Yes);
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Verdict {
    /// The pile is stable: no contact needs a tensile force.
    Yes,
    /// The pile is unstable: a contact needs a tensile force, and no other forces balance the pile. Prescribed
    /// horizontal forces are not changed.
    No,
    /// A contact needs a tensile force, but further contacts may replace it. For contacts between neighbours in a
    /// layer, a = R, the function `equilibrium` of the crate `cannonpile-horizontal` decides. Contacts across two or
    /// three layers are not analysed.
    Undetermined,
}

named!(
    Verdict,
    [Verdict::Yes, Verdict::No, Verdict::Undetermined],
    "a verdict: yes, no or undetermined"
);

impl Verdict {
    /// Returns the name: `yes`, `no`, `undetermined`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Verdict;
    ///
    /// assert_eq!(Verdict::Undetermined.name(), "undetermined");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Yes => "yes",
            Self::No => "no",
            Self::Undetermined => "undetermined",
        }
    }
}

/// The exact smallest contact force of a pile, and the first unstable layer.
///
/// # Examples
/// ```
/// use cannonpile::lattice::Region;
/// use cannonpile::Pile;
///
/// // Five layers of HCP are stable, six are not.
/// let pile = Pile::under(Region::SITE, "+-+-+".parse()?)?;
/// let standing = pile.standing()?;
/// let least = standing.least.unwrap();
/// assert_eq!((least.site.k, least.force.to_string()), (4, "-22/81".to_owned()));
/// assert_eq!(standing.first_failure, Some(4));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(::serde::Serialize, ::serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct Standing {
    /// The contact with the smallest force. Of several such contacts it is the first in the order of tables.
    ///
    /// It is `None` for a single layer. It is also `None` for a pile that is unstable near the top, if a search of the
    /// layers below would need more than 10⁹ numbers.
    pub least: Option<ContactForce<BigRational>>,
    /// The first layer, counted from 0 at the top, with a contact that would need a tensile force. The layers above
    /// it are stable on their own.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub first_failure: Option<i128>,
}

exact_surd::equality!(Standing; |Self { least, first_failure }| (least, first_failure));

impl Standing {
    /// Returns the verdict for a spacing at which the spheres `touching` touch in addition to the contacts α, β, γ.
    /// Strictly between the bounds of [`Clearance`](crate::geometry::Clearance), no such spheres touch.
    ///
    /// The verdict considers the forces of α, β and γ only. For horizontal contacts, use the function `equilibrium` of
    /// the crate `cannonpile-horizontal`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::LayerGap;
    /// use cannonpile::lattice::Region;
    /// use cannonpile::{Pile, Verdict};
    ///
    /// let pile = Pile::under(Region::SITE, "+-+-+".parse()?)?;
    /// let touching = [LayerGap { layers: 2 }];
    /// assert_eq!(pile.standing()?.verdict(&touching), Verdict::Undetermined);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn verdict(&self, touching: &[LayerGap]) -> Verdict {
        match (self.first_failure, touching) {
            (None, _) => Verdict::Yes,
            (Some(_), []) => Verdict::No,
            (Some(_), _) => Verdict::Undetermined,
        }
    }

    /// Updates the result with a contact. The contact replaces the current one if its force is smaller, or equal and
    /// earlier in the order.
    fn update(&mut self, contact: ContactForce<BigRational>) {
        if contact.force.is_negative() {
            let k = contact.site.k;
            self.first_failure = Some(self.first_failure.map_or(k, |first| first.min(k)));
        }
        let place = |c: &ContactForce<BigRational>| (c.site, c.direction);
        let less = self.least.as_ref().is_none_or(|least| {
            (ByValue(&contact.force), place(&contact)) < (ByValue(&least.force), place(least))
        });
        if less {
            self.least = Some(contact);
        }
    }
}

impl Pile {
    /// Returns the smallest contact force of the pile, its contact, and the first unstable layer.
    ///
    /// The cost is that of an exact sweep from the top to the last sign change. After long runs it is lower: the forces
    /// are linear between a few spheres of each row, and only these spheres are computed.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if the layers above a sign change do not fit in memory, and the forces there depend on too
    /// many spheres.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    ///
    /// let pile = Pile::under(Region::SITE, "+-++".parse()?)?;
    /// assert_eq!(pile.standing()?.least.unwrap().force.to_string(), "4/9");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn standing(&self) -> Result<Standing, Error> {
        const MAX_WORK: u64 = 1_000_000_000;
        let layers = self.low_layers();
        let sites = layers.iter().filter_map(|k| self.shape().layer(*k).ok());
        let sites = sites.map(|region| region.site_count()).sum::<BigUint>();
        let planes = self.size_of_sweep(self.layers() - 1).planes;
        let whole = sites * planes * 3_u32 <= BigUint::from(MAX_WORK);
        let mut standing = self.standing_until(!whole)?;
        if !whole && standing.first_failure.is_some() {
            standing.least = None;
        }
        Ok(standing)
    }

    /// Returns whether the pile is stable at a spacing without contacts other than α, β and γ: `Yes` or `No`. For other
    /// spacings, use [`Packing::stands`](crate::Packing::stands).
    ///
    /// # Errors
    /// As for [`standing`](Self::standing).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    /// use cannonpile::{Pile, Verdict};
    ///
    /// // Five layers of HCP are stable, six are not.
    /// let hcp = |steps: &str| Pile::under(Region::SITE, steps.parse()?);
    /// assert_eq!(hcp("+-+-")?.stands()?, Verdict::Yes);
    /// assert_eq!(hcp("+-+-+")?.stands()?, Verdict::No);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn stands(&self) -> Result<Verdict, Error> {
        Ok(self.standing_until(true)?.verdict(&[]))
    }

    /// Returns the first layer, counted from 0 at the top, with a contact that would need a tensile force. The layers
    /// above it are stable on their own, and the layers below it are not computed.
    ///
    /// # Errors
    /// As for [`standing`](Self::standing).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    /// use cannonpile::stacking::Stacking;
    ///
    /// let pile = Pile::under(Region::SITE, Stacking::hcp(1_000_000)?)?;
    /// assert_eq!(pile.first_failure()?, Some(4));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn first_failure(&self) -> Result<Option<i128>, Error> {
        Ok(self.standing_until(true)?.first_failure)
    }

    /// Returns a contact that would need a tensile force, or `None` if the pile is stable. It is the one with the smallest
    /// force among the layers examined, which end soon after the first unstable one.
    ///
    /// # Errors
    /// As for [`standing`](Self::standing).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    ///
    /// let contact = Pile::under(Region::SITE, "+-+-+".parse()?)?.tensile_contact()?;
    /// assert_eq!(contact.unwrap().force.to_string(), "-22/81");
    /// assert_eq!(Pile::triangular(10)?.tensile_contact()?, None);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn tensile_contact(&self) -> Result<Option<ContactForce<BigRational>>, Error> {
        let least = self.standing_until(true)?.least;
        Ok(least.filter(|contact| contact.force.is_negative()))
    }

    /// Returns the layers below which the forces may be smallest: where the sign changes, and at the end of a run along
    /// which forces decrease.
    fn low_layers(&self) -> Vec<i128> {
        let shape = self.shape();
        let falls = |sign| self.ordinary(sign).iter().any(Signed::is_negative);
        let falls = [Sign::Plus, Sign::Minus].each(|sign| (sign, falls(sign)));
        let runs = (0..=shape.stacking().changes()).filter_map(|run| shape.run(run));
        let layers = runs.flat_map(|run| {
            let begin = (run.index > 0).then_some(run.from);
            let falls = falls.contains(&(run.sign, true)) && run.to - 1 > run.from;
            let end = falls.then_some(run.to - 1);
            begin.into_iter().chain(end)
        });
        layers.collect()
    }

    /// Returns the contact with the smallest force, of the whole pile or down to the first failure.
    fn standing_until(&self, failure: bool) -> Result<Standing, Error> {
        let mut standing = Standing {
            least: None,
            first_failure: None,
        };
        for contact in self.at_surfaces() {
            standing.update(contact);
        }
        for contact in self.at_special_spheres()? {
            standing.update(contact);
        }
        let layers = self.low_layers();
        let mut looked_at = 0;
        while looked_at < layers.len() && !(failure && standing.first_failure.is_some()) {
            // The range doubles each time. A failure near the top is found early, and a search of the whole pile costs
            // little more.
            let next = if failure {
                2 * looked_at + 4
            } else {
                layers.len()
            };
            let next = next.min(layers.len());
            for contact in self.below_layers(&layers[looked_at..next])? {
                standing.update(contact);
            }
            looked_at = next;
        }
        Ok(standing)
    }

    /// Returns the forces where lines begin at a surface: for each direction and sign one below an ordinary sphere, whose
    /// forces are all equal, and those below all spheres with extra weight.
    fn at_surfaces(&self) -> Vec<ContactForce<BigRational>> {
        let (shape, loading) = (self.shape(), &self.loading);
        let floor = shape.layers() - 1;
        let contact = |site: Site, direction: Direction| ContactForce {
            site,
            direction,
            force: self.own_increments(site)[direction.index()].clone(),
        };
        let special: Vec<Site> = loading.extras().map(|(site, ..)| site).collect();
        let directions = self.dimension().directions();
        // Every line through the top layer begins there, and some line of each direction begins in each layer inside a run.
        let layers = |sign| {
            let runs = (0..=shape.stacking().changes()).filter_map(|run| shape.run(run));
            let runs = runs.filter(move |run| run.sign == sign);
            let layers = runs.flat_map(|run| run.from + i128::from(run.index > 0)..run.to);
            layers.take_while(|k| *k < floor)
        };
        let mut least = Vec::new();
        for (direction, sign) in directions
            .iter()
            .flat_map(|direction| [Sign::Plus, Sign::Minus].each(|sign| (direction, sign)))
        {
            let fresh = layers(sign).find_map(|k| {
                first_beginning(shape, k, *direction, |site| {
                    special.binary_search(site).is_err()
                })
            });
            least.extend(fresh.map(|site| contact(site, *direction)));
        }
        let special = special
            .into_iter()
            .filter(|site| site.k < floor && loading.pushes(*site).is_none());
        let special = special.flat_map(|site| directions.iter().map(move |d| (site, *d)));
        let special = special.filter(|(site, direction)| begins(shape, *site, *direction));
        least.extend(special.map(|(site, direction)| contact(site, direction)));
        least
    }

    /// Returns the contacts below spheres with horizontal contact forces, and those around spheres with other loads or
    /// weights. Only there can a decrease along a line begin or end within a run.
    fn at_special_spheres(&self) -> Result<Vec<ContactForce<BigRational>>, Error> {
        let (shape, loading) = (self.shape(), &self.loading);
        let falls = |sign| self.ordinary(sign).iter().any(Signed::is_negative);
        let everywhere = falls(Sign::Plus) || falls(Sign::Minus);
        let mut sites = Vec::new();
        for (site, _, pushes) in loading.extras() {
            let own = self.own_increments(site);
            let lessens = own.iter().any(Signed::is_negative);
            if everywhere || lessens || pushes.is_some() {
                sites.push(site);
            }
            if everywhere {
                let above = Direction::ALL.each(|direction| shape.above(site, direction));
                sites.extend(above.into_iter().flatten());
            }
        }
        let sites = distinct(sites);
        let forces = self.forces::<BigRational>();
        let contacts = sites
            .into_iter()
            .map(|site| forces.contacts(Selection::One(site)));
        let contacts: Vec<_> = contacts.collect::<Result<_, _>>()?;
        contacts.into_iter().flatten().collect()
    }

    /// Returns the smallest force below each of these layers.
    fn below_layers(&self, layers: &[i128]) -> Result<Vec<ContactForce<BigRational>>, Error> {
        let shape = self.shape();
        let Some(last) = layers.last() else {
            return Ok(Vec::new());
        };
        let lines = LineForces::<BigRational>::new(self);
        let (mut ends, mut sites) = (BigUint::zero(), BigUint::zero());
        for k in layers {
            ends += lines.most_ends_of_pieces(*k)?;
            sites += shape.layer(*k)?.site_count();
        }
        // One layer more, so that the last sign change is included.
        let planes = self.size_of_sweep(last + 1).planes;
        let are_cheaper = trees_are_cheaper(&ends, &sites);
        let by_trees = || {
            refuse_beyond(
                "the verdict on this pile",
                ends,
                MAX_NUMBERS,
                "move the sign changes closer to the top",
            )?;
            let directions = self.dimension().directions();
            let least = layers.iter().map(|k| least_at_ends(&lines, directions, *k));
            least.collect()
        };
        // Sweeps are for spheres.
        if self.dimension() == Dimension::Two {
            return by_trees();
        }
        if Grid::numbers(shape, last + 1, planes).is_err() {
            return by_trees();
        }
        let by_sweep = || {
            let mut sweep = shortest_exact_sweep(&lines, last + 1)?;
            let least = layers.iter().map(|k| {
                sweep.advance(*k, Meter::NONE)?;
                least_transmitted(&mut sweep, &lines)
            });
            least.collect()
        };
        if are_cheaper {
            return unless_too_large(by_trees, by_sweep);
        }
        by_sweep()
    }
}

impl Packing<'_> {
    /// Returns whether the pile is stable at this spacing. The verdict is [`Verdict::Undetermined`] if a contact α, β
    /// or γ needs a tensile force, but [other spheres touch](Packing::touching) and may support the pile.
    ///
    /// # Errors
    /// As for [`Pile::standing`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    /// use cannonpile::{Packing, Pile, Verdict};
    ///
    /// let pile = Pile::under(Region::SITE, "+-+-+".parse()?)?;
    /// assert_eq!(Packing::new(&pile, &"6/5".parse()?)?.stands()?, Verdict::No);
    /// assert_eq!(Packing::new(&pile, &"1".parse()?)?.stands()?, Verdict::Undetermined);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn stands(&self) -> Result<Verdict, Error> {
        let standing = self.pile().standing_until(true)?;
        Ok(standing.verdict(self.touching()))
    }
}

/// Returns the smallest force below a layer, among the spheres between which the forces are linear.
fn least_at_ends(
    lines: &LineForces<'_, BigRational>,
    directions: &[Direction],
    k: i128,
) -> Result<ContactForce<BigRational>, Error> {
    let mut least: Option<(BigInt, Site, Direction)> = None;
    let mut denominator = BigInt::one();
    for (_, row) in lines.ends_of_pieces(k)? {
        let above = lines.forces_above(k, &row, LineSelection::All, Meter::NONE)?;
        for ([i, j], above) in row.into_iter().zip(above) {
            let site = Site { i, j, k };
            let SphereForces { forces, changes } = lines.to_below(site, above, Meter::NONE);
            denominator = lines.scale(changes);
            for (force, direction) in forces.into_iter().zip(directions.iter().copied()) {
                if least.as_ref().is_none_or(|(least, ..)| force < *least) {
                    least = Some((force, site, direction));
                }
            }
        }
    }
    let least = least.ok_or_else(|| bug("a layer has a sphere"))?;
    let (force, site, direction) = least;
    Ok(ContactForce {
        site,
        direction,
        force: BigRational::new(force, denominator),
    })
}

/// Returns the smallest force below the current layer of a sweep.
fn least_transmitted(
    sweep: &mut Sweep<'_, BigRational, Planes>,
    lines: &LineForces<'_, BigRational>,
) -> Result<ContactForce<BigRational>, Error> {
    sweep.add_extras_here()?;
    let (k, changes) = (sweep.k(), sweep.turned_already());
    let own = lines.increments_after(changes);
    let transmitted = sweep.least()?.into_iter().zip(&own).map(|(least, own)| {
        let [i, j] = least.place;
        let force = formula::transmitted(least.numerator, own);
        (force, Site { i, j, k }, least.direction)
    });
    let least = transmitted.min_by(|one, other| {
        // The first in the order of tables, of equal forces.
        let place = |(_, Site { i, j, .. }, direction): &(_, _, _)| (*j, *i, *direction);
        one.0
            .cmp(&other.0)
            .then_with(|| place(one).cmp(&place(other)))
    });
    let (force, site, direction) = least.ok_or_else(|| bug("there are three directions"))?;
    Ok(ContactForce {
        site,
        direction,
        force: BigRational::new(force, lines.scale(changes)),
    })
}

/// Returns whether the line below a site in a direction begins at the site: in the top layer, or at a surface within a
/// run.
fn begins(shape: &Shape, site: Site, direction: Direction) -> bool {
    let changes = shape.sign_below(site.k) != shape.sign_below(site.k - 1);
    site.k == 0 || (!changes && shape.above(site, direction).is_none())
}

/// Returns the first `wanted` site of a layer at which the line below it in a direction begins.
///
/// Rows may be long and many. So the sites visited are the unwanted ones and one more, and the rows are searched by halving.
fn first_beginning(
    shape: &Shape,
    k: i128,
    direction: Direction,
    wanted: impl Fn(&Site) -> bool,
) -> Option<Site> {
    let layer = shape.layer(k).ok()?;
    let above = shape.sign_below(k - 1).and_then(|sign| {
        let up = Site::new(0, 0, k).step(sign, direction, -1)?;
        Some((shape.layer(k - 1).ok()?, up))
    });
    // Lines begin at both ends of a row, where there is no sphere above.
    let begin = |j: i128| {
        let row = layer.row(j);
        let Some((above, up)) = above else {
            return [row.clone(), row.end..row.end];
        };
        let covered = above.row_within(j + up.j);
        // Sites beyond the row do not count.
        let within = |i: i128| i.clamp(row.start, row.end);
        let [start, end] = [covered.start, covered.end].each(|i| within(i - up.i));
        [row.start..start, end..row.end]
    };
    let begins = |j: &i128| begin(*j).iter().any(|sites| !sites.is_empty());
    let (first, last) = layer.y().into_inner();
    // The rows in which lines begin are consecutive: the first ones, the last ones, or all.
    let (mut without, mut with) = (first - 1, if begins(&first) { first } else { last });
    while with - without > 1 {
        let middle = without + (with - without) / 2;
        *(if begins(&middle) {
            &mut with
        } else {
            &mut without
        }) = middle;
    }
    let mut sites = (with..=last).take_while(begins).flat_map(|j| {
        let row = begin(j).into_iter().flatten();
        row.map(move |i| Site { i, j, k })
    });
    sites.find(wanted)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn beginnings_are_those_of_a_search_of_all_sites() {
        let mut found = 0;
        for top in [
            "0..0,0..0,0..0",
            "0..3,0..2,2..4",
            "0..2,0..4,0..2",
            "0..3,0..3,3..6",
            "0..5,0..1,0..6",
        ] {
            for stacking in ["++++", "----", "++--+--", "-++"] {
                let top = top.parse().unwrap();
                let shape = Shape::under(top, stacking.parse().unwrap()).unwrap();
                for run in (0..=shape.stacking().changes()).filter_map(|run| shape.run(run)) {
                    for k in run.from + i128::from(run.index > 0)..run.to {
                        for direction in Direction::ALL {
                            let sites = shape.rows(Selection::Layer(k)).unwrap().flatten();
                            let all: Vec<_> = sites
                                .filter(|site| begins(&shape, *site, direction))
                                .collect();
                            for least in 0..=all.len() {
                                let wanted = |site: &Site| !all[..least].contains(site);
                                let first = first_beginning(&shape, k, direction, wanted);
                                assert_eq!(
                                    first.as_ref(),
                                    all.get(least),
                                    "{shape:?} {k} {direction}"
                                );
                                found += 1;
                            }
                        }
                    }
                }
            }
        }
        assert!(found > 1000, "{found}");
    }
}
