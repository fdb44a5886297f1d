//! The weights of the spheres, their loads, and the forces of horizontal contacts.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;

use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::Error;
use crate::error::not_negative;
use crate::formula;
use crate::geometry::Load;
use crate::lattice::{Axis, HorizontalContact, Sign, Site};
use crate::scalar::ByValue;

/// The weights of the spheres, in mg, the loads on them, and the forces of horizontal contacts, in f₀. In a
/// `Pile` no weight, downward load or horizontal contact force is negative. Loads of `Forces::with_load` may be.
///
/// In the equations a load acts like additional weight of its sphere, but it does not change the mass of the sphere.
#[derive(Clone, Debug, Default)]
pub(crate) struct Loading {
    weightless: bool,
    /// The horizontal part of gravity along x and y, per unit of its vertical part and tanθ.
    tilt: [BigRational; 2],
    /// The spheres with a weight, a load or a horizontal contact force of their own. None of these is an ordinary weight
    /// or zero, so that equal piles have equal entries.
    spheres: BTreeMap<Site, Acting>,
}

exact_surd::equality!(Hash for Loading; |Self { weightless, tilt, spheres }|
    (weightless, tilt.each_ref().map(ByValue), spheres));
exact_surd::equality!(Hash for Acting; |Self { weight, load, horizontal, pushes }|
    (weight.as_ref().map(ByValue), load, horizontal.each_ref().map(|force| force.as_ref().map(ByValue)),
        pushes.as_ref().map(|pushes| pushes.each_ref().map(ByValue))));

/// What acts on a sphere besides ordinary gravity.
#[derive(Clone, Debug, Default)]
struct Acting {
    /// The weight, if it is not the ordinary one.
    weight: Option<BigRational>,
    load: Option<Load>,
    /// The forces of the horizontal contacts that stand with this sphere, by axis.
    horizontal: [Option<BigRational>; 3],
    /// The forces that its horizontal contacts add to its lines, −σ H, by direction. Their sum is 0.
    pushes: Option<[BigRational; 3]>,
}

impl Acting {
    fn is_ordinary(&self) -> bool {
        let acts = self.weight.is_some() || self.load.is_some() || self.pushes.is_some();
        !acts && self.horizontal.iter().all(Option::is_none)
    }
}

impl Loading {
    /// Sets the weight of every sphere to zero.
    pub(crate) fn set_weightless(&mut self) {
        self.weightless = true;
        self.change_all(|sphere| sphere.weight = None);
    }

    fn change_all(&mut self, change: impl Fn(&mut Acting)) {
        for (site, mut sphere) in core::mem::take(&mut self.spheres) {
            change(&mut sphere);
            if !sphere.is_ordinary() {
                self.spheres.insert(site, sphere);
            }
        }
    }

    /// Adds to the tilt of gravity.
    pub(crate) fn add_tilt(&mut self, [x, y]: [BigRational; 2]) {
        self.tilt[0] += x;
        self.tilt[1] += y;
    }

    pub(crate) fn tilt(&self) -> &[BigRational; 2] {
        &self.tilt
    }

    fn change(&mut self, site: Site, change: impl FnOnce(&mut Acting)) {
        let sphere = self.spheres.entry(site).or_default();
        change(sphere);
        if sphere.is_ordinary() {
            self.change_all(|_| ());
        }
    }

    /// Adds to the load on a sphere.
    pub(crate) fn add_load(&mut self, site: Site, load: &Load) {
        if load.is_zero() {
            return;
        }
        self.change(site, |sphere| {
            // A sphere without a load has none.
            let sum = sphere.load.take().unwrap_or_default() + load;
            sphere.load = Some(sum).filter(|sum| !sum.is_zero());
        });
    }

    /// Sets the weight of a sphere.
    pub(crate) fn set_weight(&mut self, site: Site, weight: BigRational) -> Result<(), Error> {
        let weight = not_negative("weight", site, weight)?;
        let ordinary = self.ordinary_weight();
        let weight = Some(weight).filter(|weight| ByValue(weight) != ByValue(&ordinary));
        if weight.is_some() || self.spheres.contains_key(&site) {
            self.change(site, |sphere| sphere.weight = weight);
        }
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
            let sphere = self.spheres.entry(site).or_default();
            let pushes = sphere.pushes.get_or_insert_default();
            let entries = formula::pushed(&push, contact.axis.ends(), leads_away);
            for (line, entry) in pushes.iter_mut().zip(entries) {
                *line -= entry;
            }
        }
        let horizontal = &mut self.spheres.entry(contact.site).or_default().horizontal;
        *horizontal[contact.axis as usize].get_or_insert_default() += force;
        Ok(())
    }

    /// Removes all forces of horizontal contacts.
    pub(crate) fn release(&mut self) {
        self.change_all(|sphere| (sphere.horizontal, sphere.pushes) = Default::default());
    }

    /// Returns the horizontal contacts with a force, in their order.
    pub(crate) fn horizontal(&self) -> Vec<(HorizontalContact, &BigRational)> {
        let mut forces = Vec::new();
        for (site, sphere) in &self.spheres {
            for (axis, force) in Axis::ALL.into_iter().zip(&sphere.horizontal) {
                let contact = HorizontalContact { site: *site, axis };
                forces.extend(force.iter().map(|force| (contact, force)));
            }
        }
        forces
    }

    pub(crate) fn horizontal_force(&self, contact: HorizontalContact) -> BigRational {
        let sphere = self.spheres.get(&contact.site);
        let force = sphere.and_then(|sphere| sphere.horizontal[contact.axis as usize].clone());
        // A contact that is not in the list has no force.
        force.unwrap_or_default()
    }

    /// Returns the forces that the horizontal contacts of a sphere add to its lines, by direction, if it has any.
    pub(crate) fn pushes(&self, site: Site) -> Option<&[BigRational; 3]> {
        self.spheres.get(&site)?.pushes.as_ref()
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
        let sphere = self.spheres.get(&site);
        let weight = sphere.and_then(|sphere| sphere.weight.clone());
        weight.unwrap_or_else(|| self.ordinary_weight())
    }

    /// Returns the load on a sphere.
    pub(crate) fn load(&self, site: Site) -> Load {
        let load = self
            .spheres
            .get(&site)
            .and_then(|sphere| sphere.load.clone());
        // A sphere that is not in the list has no load.
        load.unwrap_or_default()
    }

    /// Returns the sum of gravity and load on a sphere.
    pub(crate) fn total(&self, site: Site) -> Load {
        self.gravity_on(self.weight(site)) + &self.load(site)
    }

    /// Returns the spheres whose weight is not the ordinary one, in their order, with their weights.
    pub(crate) fn weights(&self) -> impl Iterator<Item = (Site, &BigRational)> + '_ {
        let spheres = self.spheres.iter();
        spheres.filter_map(|(site, sphere)| Some((*site, sphere.weight.as_ref()?)))
    }

    /// Returns the loaded spheres, in their order, with their loads.
    pub(crate) fn loads(&self) -> Vec<(Site, &Load)> {
        let spheres = self.spheres.iter();
        let loads = spheres.filter_map(|(site, sphere)| Some((*site, sphere.load.as_ref()?)));
        loads.collect()
    }

    pub(crate) fn is_weightless(&self) -> bool {
        self.weightless
    }

    /// Returns the weights that differ from that of an ordinary sphere, with the difference.
    pub(crate) fn extra_weights(&self) -> impl Iterator<Item = (Site, BigRational)> + '_ {
        let ordinary = self.ordinary_weight();
        self.weights()
            .map(move |(site, weight)| (site, weight - &ordinary))
    }

    /// Returns the spheres on which a force acts besides gravity on an ordinary sphere, in their order: that force, and
    /// the forces that horizontal contacts add to the lines of the sphere, if it has any.
    pub(crate) fn extras(
        &self,
    ) -> impl Iterator<Item = (Site, Load, Option<&[BigRational; 3]>)> + '_ {
        self.spheres.iter().filter_map(|(site, sphere)| {
            // A sphere without a load has none.
            let mut extra = sphere.load.clone().unwrap_or_default();
            if let Some(weight) = &sphere.weight {
                extra = self.gravity_on(weight - self.ordinary_weight()) + &extra;
            }
            let pushes = sphere.pushes.as_ref();
            (pushes.is_some() || !extra.is_zero()).then_some((*site, extra, pushes))
        })
    }
}
