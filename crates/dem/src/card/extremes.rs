//! The greatest and the least contact force, exactly, and how many contacts bear one.

use core::cmp::Ordering;

use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use crate::Error;
use crate::error::bug;
use cannonpile::Pile;
use cannonpile::lattice::{ContactKind, Direction, Site};
use cannonpile::shape::Selection;

/// A contact, and its force in f₀.
#[derive(Clone)]
pub(super) struct Extreme {
    /// The upper sphere; of two neighbours the one that names their contact.
    pub(super) site: Site,
    pub(super) link: ContactKind,
    pub(super) force: BigRational,
}

/// What there is to say of all contact forces of a pile.
#[derive(Default)]
pub(super) struct Extremes {
    /// The first of the greatest; none of a single layer.
    pub(super) greatest: Option<Extreme>,
    /// The first of the least.
    pub(super) least: Option<Extreme>,
    /// The least magnitude of a force that is not 0.
    pub(super) weakest: Option<BigRational>,
    /// Contacts with a force, a push or a pull.
    pub(super) bearing: BigUint,
    /// Contacts between layers without a force.
    pub(super) idle: BigUint,
    /// Contacts that would have to pull.
    pub(super) pulling: BigUint,
}

/// A numerator of a layer, and where it is: the sphere in the order of the layer, and the direction.
type Placed = (BigInt, usize, usize);

impl Extremes {
    /// Looks at every contact, layer by layer, in integers.
    pub(super) fn of(pile: &Pile) -> Result<Self, Error> {
        let mut extremes = Self::default();
        let directions = pile.dimension().directions();
        let layers = pile.forces::<BigRational>().layers(Selection::All)?;
        let mut layers = layers.numerators::<BigInt>()?;
        while let Some(layer) = layers.next_layer()? {
            if layer.is_floor() {
                break;
            }
            let mut slices = [(); 3].map(|()| vec![BigInt::ZERO; layer.sphere_count()]);
            let [alpha, beta, gamma] = &mut slices;
            layer.fill([alpha, beta, gamma])?;
            let (k, denominator) = (layer.k(), layer.denominator());
            let mut weakest = None::<BigUint>;
            let (mut greatest, mut least) = (None::<Placed>, None::<Placed>);
            // In the order of tables: sphere after sphere.
            for sphere in 0..slices[0].len() {
                for (line, forces) in slices.iter().take(directions.len()).enumerate() {
                    let force = &forces[sphere];
                    extremes.count(force);
                    let magnitude = force.magnitude();
                    if !force.is_zero() && weakest.as_ref().is_none_or(|least| magnitude < least) {
                        weakest = Some(magnitude.clone());
                    }
                    let beats = |found: &Option<Placed>, order| {
                        found
                            .as_ref()
                            .is_none_or(|(best, ..)| force.cmp(best) == order)
                    };
                    if beats(&greatest, Ordering::Greater) {
                        greatest = Some((force.clone(), sphere, line));
                    }
                    if beats(&least, Ordering::Less) {
                        least = Some((force.clone(), sphere, line));
                    }
                }
            }
            if let Some(weakest) = weakest {
                extremes.weaken(BigRational::new(weakest.into(), denominator.clone()));
            }
            let placed = |(numerator, sphere, line): Placed| {
                Ok::<_, Error>(Extreme {
                    site: nth(pile, k, sphere)?,
                    link: link(directions, line)?,
                    force: BigRational::new(numerator, denominator.clone()),
                })
            };
            if let Some(greatest) = greatest {
                extremes.meet(placed(greatest)?);
            }
            if let Some(least) = least {
                extremes.meet(placed(least)?);
            }
        }
        for (contact, force) in pile.horizontal_forces() {
            extremes.count(force.numer());
            if !force.is_zero() {
                extremes.weaken(force.abs());
            }
            extremes.meet(Extreme {
                site: contact.site,
                link: contact.axis.into(),
                force: force.clone(),
            });
        }
        Ok(extremes)
    }

    fn count(&mut self, force: &BigInt) {
        if force.is_zero() {
            self.idle += 1_u32;
            return;
        }
        self.bearing += 1_u32;
        if force.is_negative() {
            self.pulling += 1_u32;
        }
    }

    fn weaken(&mut self, magnitude: BigRational) {
        if self
            .weakest
            .as_ref()
            .is_none_or(|weakest| magnitude < *weakest)
        {
            self.weakest = Some(magnitude);
        }
    }

    fn meet(&mut self, met: Extreme) {
        let greatest = self.greatest.as_ref();
        if greatest.is_none_or(|greatest| met.force > greatest.force) {
            self.greatest = Some(met.clone());
        }
        if self
            .least
            .as_ref()
            .is_none_or(|least| met.force < least.force)
        {
            self.least = Some(met);
        }
    }
}

/// The sphere of a layer at this place in row order.
fn nth(pile: &Pile, k: i128, place: usize) -> Result<Site, Error> {
    let mut sites = pile.rows(Selection::Layer(k))?.flatten();
    sites
        .nth(place)
        .ok_or_else(|| bug("a layer has a sphere for each of its forces"))
}

fn link(directions: &[Direction], line: usize) -> Result<ContactKind, Error> {
    let direction = directions.get(line).copied().map(ContactKind::from);
    direction.ok_or_else(|| bug("each line of forces has its direction"))
}
