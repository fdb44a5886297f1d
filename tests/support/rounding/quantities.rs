//! The physical quantities of a pile.

use cannonpile::lattice::{Direction, Site};
use cannonpile::scalar::{RealSign, Surd};
use cannonpile::shape::Selection;
use cannonpile::{Error, Packing};

use super::piles::{self, Measure};
use super::random::Random;
use super::tally::Tally;
use crate::support::judge::Float;

/// What is asked of a packing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Quantity {
    /// The magnitude of a contact force.
    Contact,
    /// Its components.
    ContactVector,
    /// Where two spheres touch.
    ContactPoint,
    /// The centre of a sphere.
    Position,
    /// Normal and shears.
    OnFloor,
    /// f₀, the central constant, and those of the angle.
    UnitForce,
    /// Masses, weights and sizes, which are rationals.
    Weight,
    /// Contact forces filled into slices.
    Filled,
}

impl Quantity {
    /// All of them.
    pub(crate) const ALL: [Self; 8] = [
        Self::Contact,
        Self::ContactVector,
        Self::ContactPoint,
        Self::Position,
        Self::OnFloor,
        Self::UnitForce,
        Self::Weight,
        Self::Filled,
    ];

    /// What a table calls it.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Contact => "contact force",
            Self::ContactVector => "contact force, components",
            Self::ContactPoint => "contact point",
            Self::Position => "position",
            Self::OnFloor => "force on the floor",
            Self::UnitForce => "unit force, angles",
            Self::Weight => "mass, weight, sizes",
            Self::Filled => "contact forces filled in",
        }
    }

    const fn measure(self) -> Measure {
        match self {
            Self::ContactPoint | Self::Position => Measure::Length,
            _ => Measure::Force,
        }
    }

    /// Rounds this quantity at sites of random piles, each in many sizes.
    pub(crate) fn tally(self, random: &mut Random, cases: u64) -> Tally {
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
        let pile = if self == Self::Filled {
            piles::small(random)
        } else {
            piles::any(random)
        };
        let spacing = piles::spacing(&pile, random);
        let mut packing = Packing::new(&pile, &spacing)?;
        let floor = pile.layers() - 1;
        let places = [(); 8].map(|()| {
            let k = match self {
                Self::OnFloor => floor,
                // On the floor z is 0, and there are no contacts.
                _ => random.below(floor),
            };
            let site = piles::site_of(&pile, k, random);
            (site, piles::direction(&pile, random))
        });
        let mut targets = Vec::new();
        for place in places {
            targets.extend(self.surds(&packing, place)?);
        }
        let lasting = packing.inclination();
        if self == Self::UnitForce {
            for root in [lasting.sin(), lasting.cos(), lasting.tan(), spacing.ratio()] {
                tally.meet(&root);
            }
        }
        let nonzero: Vec<&Surd> = targets
            .iter()
            .filter(|x| x.sign() != RealSign::Zero)
            .collect();
        for _ in 0..64 {
            let target = (!nonzero.is_empty()).then(|| random.of(&nonzero));
            packing = piles::resized(packing, self.measure(), target, random)?;
            match self {
                Self::Weight => weights(&packing, places[0].0, tally)?,
                Self::Filled => filled(&packing, tally)?,
                _ => {
                    for place in places {
                        for exact in self.surds(&packing, place)? {
                            tally.meet(&exact);
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
            Self::Contact | Self::Filled => vec![packing.contact(site, direction)?],
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
        tally.meet_rational(&exact);
    }
    Ok(())
}

/// The contacts below the last layer that has any: along α in its first row, along γ of each row.
fn filled(packing: &Packing<'_>, tally: &mut Tally) -> Result<(), Error> {
    let k = packing.pile().layers() - 2;
    let mut exact = Vec::new();
    for i in 0..=k {
        exact.push(packing.contact(Site { i, j: 0, k }, Direction::Alpha)?);
    }
    for j in 0..=k {
        exact.push(packing.contact(Site { i: 0, j, k }, Direction::Gamma)?);
    }
    filled_as::<f64>(packing, &exact, tally)?;
    filled_as::<f32>(packing, &exact, tally)
}

fn filled_as<F: Float>(
    packing: &Packing<'_>,
    exact: &[Surd],
    tally: &mut Tally,
) -> Result<(), Error> {
    let k = packing.pile().layers() - 2;
    let mut layers = match packing.layers::<F>(Selection::Layer(k)) {
        Err(Error::Overflow { .. }) => {
            // Then one force is beyond the floats, and so is the greatest.
            let greatest = exact.iter().max().into_iter();
            greatest.for_each(|exact| tally.meet_float(None::<F>, exact));
            return Ok(());
        }
        layers => layers?,
    };
    let layer = layers.next_layer()?.expect("the layer asked for");
    let mut forces = [(); 3].map(|()| vec![F::zero(); layer.spheres()]);
    layer.fill(forces.each_mut().map(Vec::as_mut_slice))?;
    let [alpha, _, gamma] = forces;
    let row = usize::try_from(k + 1).unwrap_or(0);
    let mut rounded = alpha[..row].to_vec();
    // The first sphere of each row.
    let mut first = 0;
    for length in (1..=row).rev() {
        rounded.push(gamma[first]);
        first += length;
    }
    for (got, exact) in rounded.into_iter().zip(exact) {
        tally.meet_float(Some(got), exact);
    }
    Ok(())
}
