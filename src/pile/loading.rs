//! The weights of the spheres, their loads, and the forces of horizontal contacts.

use alloc::boxed::Box;
use alloc::collections::BTreeMap;

use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::Error;
use crate::formula;
use crate::geometry::Load;
use crate::lattice::{HorizontalContact, Sign, Site};

/// The weights of the spheres, in mg, the loads on them, and the forces of horizontal contacts, in f₀. No weight,
/// downward load or horizontal contact force is negative.
///
/// In the equations a load acts like additional weight of its sphere, but it does not change the mass of the sphere.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub(crate) struct Loading {
    weightless: bool,
    /// The horizontal part of gravity along x and y, per unit of its vertical part and tanθ.
    tilt: [BigRational; 2],
    /// The weights of the spheres whose weight is not mg.
    weights: BTreeMap<Site, BigRational>,
    loads: BTreeMap<Site, Load>,
    horizontal: BTreeMap<HorizontalContact, BigRational>,
    /// The forces that the horizontal contacts of a sphere add to its lines, −σ H, by direction. Their sum is 0.
    pushes: BTreeMap<Site, [BigRational; 3]>,
}

impl Loading {
    /// Sets the weight of every sphere to zero.
    pub(crate) fn set_weightless(&mut self) {
        self.weightless = true;
    }

    /// Adds to the tilt of gravity.
    pub(crate) fn add_tilt(&mut self, [x, y]: [BigRational; 2]) {
        self.tilt[0] += x;
        self.tilt[1] += y;
    }

    pub(crate) fn tilt(&self) -> &[BigRational; 2] {
        &self.tilt
    }

    /// Adds to the load on a sphere.
    pub(crate) fn add_load(&mut self, site: Site, load: &Load) {
        let sum = self.loads.entry(site).or_default();
        *sum = core::mem::take(sum) + load;
    }

    /// Sets the weight of a sphere.
    pub(crate) fn set_weight(&mut self, site: Site, weight: BigRational) -> Result<(), Error> {
        let weight = not_negative("weight", site, weight)?;
        self.weights.insert(site, weight);
        Ok(())
    }

    /// Adds to the force of a horizontal contact. `sign` is the step below its layer, and both spheres are above the
    /// floor.
    pub(crate) fn push(
        &mut self,
        contact: HorizontalContact,
        neighbour: Site,
        sign: Sign,
        force: BigRational,
    ) -> Result<(), Error> {
        let force = not_negative("horizontal force", contact.site, force)?;
        if force.is_zero() {
            return Ok(());
        }
        let push = &force * BigRational::from_integer(sign.factor().into());
        for (site, leads_away) in [(contact.site, true), (neighbour, false)] {
            let pushes = self.pushes.entry(site).or_default();
            let entries = formula::pushed(&push, contact.axis.ends(), leads_away);
            pushes
                .iter_mut()
                .zip(entries)
                .for_each(|(line, entry)| *line -= entry);
        }
        *self.horizontal.entry(contact).or_default() += force;
        Ok(())
    }

    /// Removes all forces of horizontal contacts.
    pub(crate) fn release(&mut self) {
        self.horizontal.clear();
        self.pushes.clear();
    }

    /// Returns the horizontal contacts with a force, in their order.
    pub(crate) fn horizontal(
        &self,
    ) -> impl ExactSizeIterator<Item = (HorizontalContact, &BigRational)> + '_ {
        self.horizontal
            .iter()
            .map(|(contact, force)| (*contact, force))
    }

    pub(crate) fn horizontal_force(&self, contact: HorizontalContact) -> BigRational {
        // A contact that is not in the list has no force.
        self.horizontal.get(&contact).cloned().unwrap_or_default()
    }

    /// Returns the forces that horizontal contacts add to the lines of spheres, by direction.
    pub(crate) fn pushes(&self) -> &BTreeMap<Site, [BigRational; 3]> {
        &self.pushes
    }

    /// Returns whether every sphere has the ordinary weight and carries no load or horizontal contact force.
    pub(crate) fn is_ordinary(&self) -> bool {
        self.pushes.is_empty() && self.extras().next().is_none()
    }

    /// Returns the weight of an ordinary sphere.
    pub(crate) fn ordinary_weight(&self) -> BigRational {
        if self.weightless {
            BigRational::zero()
        } else {
            BigRational::one()
        }
    }

    /// Returns the force of gravity, for a sphere of this weight.
    fn gravity_on(&self, weight: BigRational) -> Load {
        if self.tilt.iter().all(Zero::is_zero) {
            weight.into()
        } else {
            Load::leaning(weight, &self.tilt)
        }
    }

    /// Returns the force of gravity on an ordinary sphere.
    pub(crate) fn ordinary(&self) -> Load {
        self.gravity_on(self.ordinary_weight())
    }

    /// Returns the weight of a sphere.
    pub(crate) fn weight(&self, site: Site) -> BigRational {
        let special = self.special(site).cloned();
        special.unwrap_or_else(|| self.ordinary_weight())
    }

    /// Returns the weight that was set for a sphere, unless the pile is weightless.
    fn special(&self, site: Site) -> Option<&BigRational> {
        self.weights.get(&site).filter(|_| !self.weightless)
    }

    /// Returns the load on a sphere.
    pub(crate) fn load(&self, site: Site) -> Load {
        // A sphere that is not in the list has no load.
        self.loads.get(&site).cloned().unwrap_or_default()
    }

    /// Returns the sum of gravity and load on a sphere.
    pub(crate) fn total(&self, site: Site) -> Load {
        self.gravity_on(self.weight(site)) + &self.load(site)
    }

    /// Returns the spheres whose weight was set, in their order, with their weights.
    pub(crate) fn weights(&self) -> impl Iterator<Item = (Site, &BigRational)> + '_ {
        self.weights.iter().map(|(site, weight)| (*site, weight))
    }

    /// Returns the loaded spheres, in their order, with their loads.
    pub(crate) fn loads(&self) -> impl ExactSizeIterator<Item = (Site, &Load)> + '_ {
        self.loads.iter().map(|(site, load)| (*site, load))
    }

    pub(crate) fn is_weightless(&self) -> bool {
        self.weightless
    }

    /// Returns the weights that differ from that of an ordinary sphere, with the difference.
    pub(crate) fn extra_weights(&self) -> impl Iterator<Item = (Site, BigRational)> + '_ {
        self.weights.keys().filter_map(|site| {
            let extra = self.special(*site)? - self.ordinary_weight();
            (!extra.is_zero()).then_some((*site, extra))
        })
    }

    /// Returns the spheres on which the force differs from gravity on an ordinary sphere, with the difference.
    pub(crate) fn extras(&self) -> impl Iterator<Item = (Site, Load)> + '_ {
        let loaded = self.loads.keys();
        let others = self.weights.keys();
        let others = others.filter(|site| !self.loads.contains_key(site));
        let extra = |site: &Site| {
            let load = self.load(*site);
            let extra = match self.special(*site) {
                Some(weight) => self.gravity_on(weight - self.ordinary_weight()) + &load,
                None => load,
            };
            (*site, extra)
        };
        let extras = loaded.chain(others).map(extra);
        extras.filter(|(_, extra)| !extra.is_zero())
    }
}

pub(super) fn not_negative(
    quantity: &'static str,
    site: Site,
    given: BigRational,
) -> Result<BigRational, Error> {
    if given.is_negative() {
        return Err(Error::NegativeLoad {
            quantity,
            site,
            given: Box::new(given),
        });
    }
    Ok(given)
}
