//! The physical quantities of a pile.

use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Direction, Site};
use cannonpile::scalar::Surd;
use cannonpile::shape::Selection;
use cannonpile::{Error, Packing};
use num_bigint::Sign;
use num_rational::BigRational;
use num_traits::One;

use super::piles::{self, Measure};
use super::random::Random;
use super::tally::Tally;
use crate::judge::Float;

/// A physical quantity of a packing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Quantity {
    /// The magnitude of a contact force.
    Contact,
    /// The components of a contact force.
    ContactVector,
    /// The contact point of two spheres.
    ContactPoint,
    /// The centre of a sphere.
    Position,
    /// Normal and shear forces on the floor.
    OnFloor,
    /// f₀, the constant of the central force, and the functions of the angle.
    UnitForce,
    /// Masses, weights and sizes, which are rational.
    Weight,
    /// Contact forces of straight piles, written into slices.
    Filled,
    /// Contact forces of any stacking with weights and loads, written into slices.
    FilledStacking,
    /// The horizontal and the sloping contact forces of elastic states, and their contact points.
    #[cfg(feature = "horizontal")]
    Elastic,
}

impl Quantity {
    /// All quantities.
    pub const ALL: &'static [Self] = &[
        Self::Contact,
        Self::ContactVector,
        Self::ContactPoint,
        Self::Position,
        Self::OnFloor,
        Self::UnitForce,
        Self::Weight,
        Self::Filled,
        Self::FilledStacking,
        #[cfg(feature = "horizontal")]
        Self::Elastic,
    ];

    /// The name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Contact => "contact force",
            Self::ContactVector => "contact force, components",
            Self::ContactPoint => "contact point",
            Self::Position => "position",
            Self::OnFloor => "force on the floor",
            Self::UnitForce => "unit force, angles",
            Self::Weight => "mass, weight, sizes",
            Self::Filled => "contact forces in slices",
            Self::FilledStacking => "stackings in slices",
            #[cfg(feature = "horizontal")]
            Self::Elastic => "elastic states",
        }
    }

    const fn measure(self) -> Measure {
        match self {
            Self::ContactPoint | Self::Position => Measure::Length,
            _ => Measure::Force,
        }
    }

    /// Rounds this quantity at sites of random piles. Each pile has many sizes.
    pub fn tally(self, random: &mut Random, cases: u64) -> Tally {
        let mut tally = Tally::default();
        while tally.cases < cases {
            if let Err(error) = self.one_pile(random, &mut tally) {
                tally.cases += 1;
                tally.wrong += 1;
                tally.witness.get_or_insert(error.to_string());
            }
        }
        tally
    }

    fn one_pile(self, random: &mut Random, tally: &mut Tally) -> Result<(), Error> {
        let pile = match self {
            Self::Filled => piles::small(random),
            Self::FilledStacking => piles::loaded(random),
            #[cfg(feature = "horizontal")]
            Self::Elastic => piles::elastic(random),
            _ => piles::any(random),
        };
        let spacing = match pile.horizontal_forces().len() {
            0 => piles::spacing(&pile, random),
            _ => Spacing::new(BigRational::one())?,
        };
        let mut packing = Packing::new(&pile, &spacing)?;
        let floor = pile.layers() - 1;
        let pushing: Vec<_> = pile.horizontal_forces().collect();
        let places = [(); 8].map(|()| {
            let k = match self {
                Self::OnFloor => floor,
                // On the floor z is 0, and there are no contacts.
                _ => random.below(floor),
            };
            let site = if pushing.is_empty() || random.once_in(2) {
                piles::site_of(&pile, k, random)
            } else {
                random.of(&pushing).0.site
            };
            (site, piles::direction(&pile, random))
        });
        let mut targets = Vec::new();
        for place in places {
            targets.extend(self.surds(&packing, place)?);
        }
        let lasting = packing.inclination();
        if self == Self::UnitForce {
            for root in [lasting.sin(), lasting.cos(), lasting.tan(), spacing.ratio()] {
                tally.check(&root);
            }
        }
        let nonzero: Vec<&Surd> = targets
            .iter()
            .filter(|x| x.sign() != Sign::NoSign)
            .collect();
        for _ in 0..64 {
            let target = (!nonzero.is_empty()).then(|| random.of(&nonzero));
            packing = piles::resized(packing, self.measure(), target, random)?;
            match self {
                Self::Weight => weights(&packing, places[0].0, tally)?,
                Self::Filled | Self::FilledStacking => filled(&packing, places[0].0.k, tally)?,
                _ => {
                    for place in places {
                        for exact in self.surds(&packing, place)? {
                            tally.check(&exact);
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// The values at a site, below it, or of the whole packing.
    fn surds(
        self,
        packing: &Packing<'_>,
        (site, direction): (Site, Direction),
    ) -> Result<Vec<Surd>, Error> {
        Ok(match self {
            Self::Contact | Self::Filled | Self::FilledStacking => {
                vec![packing.contact(site, direction)?]
            }
            #[cfg(feature = "horizontal")]
            Self::Elastic => elastic(packing, (site, direction))?,
            Self::ContactVector => packing.contact_vector(site, direction)?.into(),
            Self::ContactPoint => packing.contact_point(site, direction)?.into(),
            Self::Position => packing.position(site)?.into(),
            Self::OnFloor => {
                let force = packing.on_floor(site)?;
                vec![force.normal, force.shear_x, force.shear_y]
            }
            Self::UnitForce => vec![packing.unit_force(), packing.central_constant()],
            Self::Weight => vec![packing.sphere_weight().into()],
        })
    }
}

fn weights(packing: &Packing<'_>, site: Site, tally: &mut Tally) -> Result<(), Error> {
    for exact in [
        packing.sphere_weight(),
        packing.mass_of(site)?,
        packing.mass().clone(),
        packing.radius().clone(),
        packing.gravity().clone(),
    ] {
        tally.check_rational(&exact);
    }
    Ok(())
}

/// The sloping contact, except in the bottom layer, and the compressive horizontal contacts of a site.
#[cfg(feature = "horizontal")]
fn elastic(
    packing: &Packing<'_>,
    (site, direction): (Site, Direction),
) -> Result<Vec<Surd>, Error> {
    let mut surds = Vec::new();
    if site.k + 1 < packing.pile().layers() {
        surds.push(packing.contact(site, direction)?);
        surds.extend(packing.contact_vector(site, direction)?);
    }
    let horizontal = packing.pile().horizontal_forces();
    for (contact, force) in horizontal.filter(|(contact, _)| contact.site == site) {
        let packed = packing.horizontal_contact_in_si(contact, force)?;
        surds.push(packed.force);
        surds.extend(packed.vector);
        surds.extend(packed.point);
    }
    Ok(surds)
}

/// The contacts of a layer to check: along α in its first row, along γ at the first sphere of each row, and along β at the
/// last.
fn judged(packing: &Packing<'_>, k: i128) -> Result<Vec<(usize, Site, Direction)>, Error> {
    let mut judged = Vec::new();
    let mut place = 0;
    for row in packing.pile().rows(Selection::Layer(k))? {
        let sites: Vec<Site> = row.into_iter().collect();
        if place == 0 {
            let first = sites.iter().enumerate();
            judged.extend(first.map(|(place, site)| (place, *site, Direction::Alpha)));
        }
        let last = place + sites.len() - 1;
        judged.push((place, sites[0], Direction::Gamma));
        judged.push((last, sites[sites.len() - 1], Direction::Beta));
        place = last + 1;
    }
    Ok(judged)
}

/// Checks the contacts below a layer.
fn filled(packing: &Packing<'_>, k: i128, tally: &mut Tally) -> Result<(), Error> {
    let judged = judged(packing, k)?;
    let exact = judged
        .into_iter()
        .map(|(place, site, direction)| Ok((place, direction, packing.contact(site, direction)?)))
        .collect::<Result<Vec<_>, Error>>()?;
    filled_as::<f64>(packing, k, &exact, tally)?;
    filled_as::<f32>(packing, k, &exact, tally)
}

fn filled_as<F: Float>(
    packing: &Packing<'_>,
    k: i128,
    exact: &[(usize, Direction, Surd)],
    tally: &mut Tally,
) -> Result<(), Error> {
    match forces_of_layer::<F>(packing, k) {
        // If one force overflows, so does the greatest.
        Err(Error::Overflow { .. }) => {
            let all = packing.contact_forces(Selection::Layer(k))?;
            let all = all.map(|contact| Ok(contact?.force));
            let all = all.collect::<Result<Vec<_>, Error>>()?;
            let greatest = all.iter().max_by_key(|force| force.square());
            tally.check_float(None::<F>, greatest.expect("a contact"));
        }
        forces => {
            let forces = forces?;
            for (place, direction, exact) in exact {
                tally.check_float(Some(forces[direction.index()][*place]), exact);
            }
        }
    }
    Ok(())
}

/// All forces between a layer and the next, by direction.
fn forces_of_layer<F: Float>(packing: &Packing<'_>, k: i128) -> Result<[Vec<F>; 3], Error> {
    let mut layers = packing.layers::<F>(Selection::Layer(k))?;
    let layer = layers.next_layer()?.expect("the requested layer");
    let mut forces = [(); 3].map(|()| vec![F::zero(); layer.sphere_count()]);
    layer.fill(forces.each_mut().map(Vec::as_mut_slice))?;
    Ok(forces)
}
