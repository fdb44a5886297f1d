//! The change of every force if one sphere is larger, to first order.
//!
//! Let the sphere p have the radius R(1 + δ). The centres of the bottom layer stay where they are, and so do all weights.
//!
//! 1. *Places.* A contact of p is longer by Rδ, and all others keep their length. So the displacements u satisfy
//!    ê·(u_upper − u_lower) = δ/2 or 0, in units of 2R. From the bottom up, each sphere has three such equations.
//! 2. *Directions.* A contact turns by dê = (u_upper − u_lower) − ê·e, with e its own elongation.
//! 3. *Forces.* The old forces along the turned contacts leave a force Σ f dê on each sphere. The change of the forces is
//!    the response to these forces as loads.
//!
//! All quantities are rational if (a/R)² is. For independent radii of relative standard deviation r, the variance of a
//! force is r² times the sum of the squares of its changes.

use alloc::vec::Vec;

use num_rational::BigRational;
use num_traits::Zero;

use crate::each::Each;
use crate::engine::check_interrupt;
use crate::error::{bug, refuse_beyond};
use crate::geometry::{Inclination, Load, Vector};
use crate::lattice::{Dimension, Direction, Sign, Site};
use crate::scalar::{Field, Ring, TWO};
use crate::shape::Selection;
use crate::sorted::Sorted;
use crate::{Error, Packing, Pile};

/// The greatest number of spheres of a pile whose forces are differentiated.
const MOST_SPHERES: u64 = 1_000_000;

/// The greatest number of spheres of a pile for [`Packing::spread`], which differentiates by each of them.
const MOST_VARIED: u64 = 10_000;

/// A contact force, and its change if one sphere is larger.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct ForceChange<T = BigRational> {
    /// The upper sphere of the contact.
    pub site: Site,
    /// The direction of the contact.
    pub direction: Direction,
    /// The force among equal spheres, in f₀.
    pub force: T,
    /// The change of the force per relative growth δ of the sphere, in f₀.
    pub change: T,
}

exact_surd::equality!(ForceChange<T>, T: Ring; |x| (x.site, x.direction, [&x.force, &x.change].map(Ring::comparison_key)));

/// The contact that independent deviations of the radii open first.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Spread<T = BigRational> {
    /// The upper sphere of the contact.
    pub site: Site,
    /// The direction of the contact.
    pub direction: Direction,
    /// The force among equal spheres, in f₀.
    pub force: T,
    /// The variance of the force for radii of relative standard deviation 1: the sum of the squares of its changes.
    pub variance: T,
}

exact_surd::equality!(Spread<T>, T: Ring; |x| (x.site, x.direction, [&x.force, &x.variance].map(Ring::comparison_key)));

impl<T: Field> Spread<T> {
    /// Returns the square of the relative standard deviation r of the radii at which the force is three standard
    /// deviations from zero: f²/(9·variance). `None` if the scalar cannot divide by the variance.
    ///
    /// # Examples
    /// See [`Packing::spread`].
    #[must_use]
    pub fn bearable_squared(&self) -> Option<T> {
        let nine = T::from_i128(9) * &self.variance;
        (self.force.clone() * &self.force).checked_div(&nine)
    }
}

impl Packing<'_> {
    /// Returns the change of every contact force if one sphere is larger, in the order of tables. A bottom sphere grows
    /// about its fixed centre. The forces of horizontal contacts act like loads, and do not change.
    ///
    /// # Errors
    /// [`Error::SiteOutside`]; [`Error::TooLarge`] for more than a million spheres; [`Error::Overflow`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Site;
    /// use cannonpile::{Packing, Pile, ratio};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?;
    /// let changes = packing.sensitivity::<BigRational>(Site { i: 0, j: 0, k: 1 })?;
    /// // A larger support moves the apex towards the other two, which then carry more.
    /// let changes: Vec<_> = changes.into_iter().map(|contact| contact.change).collect();
    /// assert_eq!(changes, [ratio!(-283/234), ratio!(175/468), ratio!(175/468)]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn sensitivity<T: Field>(&self, site: Site) -> Result<Vec<ForceChange<T>>, Error> {
        let network = Network::new(self.pile(), self.inclination())?;
        network.changes(self.pile().shape().check(site)?)
    }

    /// Returns the contact that opens first under independent deviations of all radii: the one whose force is the least
    /// multiple of its standard deviation. `None` if some contact needs tension, or if no radius changes a force.
    ///
    /// The theory for equal spheres describes a pile of real ones only while this deviation is small: see
    /// [`Spread::bearable_squared`].
    ///
    /// # Errors
    /// [`Error::TooLarge`] for more than ten thousand spheres; [`Error::Overflow`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::triangular(4)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?;
    /// let spread = packing.spread::<f64>()?.unwrap();
    /// // For radii of relative standard deviation r, the force has the relative standard deviation 6.4 r.
    /// let relative = spread.variance.sqrt() / spread.force;
    /// assert!((relative - 6.4).abs() < 0.1);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn spread<T: Field + PartialOrd>(&self) -> Result<Option<Spread<T>>, Error> {
        let pile = self.pile();
        let spheres = pile.sphere_count();
        let remedy = "ask for the changes by single spheres";
        refuse_beyond("the spread of this pile", spheres, MOST_VARIED, remedy)?;
        let network = Network::<T>::new(pile, self.inclination())?;
        let mut contacts: Vec<Spread<T>> = Vec::new();
        for site in pile.sites(Selection::All)? {
            let changes = network.changes(site)?;
            if contacts.is_empty() {
                contacts.extend(changes.iter().map(|contact| Spread {
                    site: contact.site,
                    direction: contact.direction,
                    force: contact.force.clone(),
                    variance: T::zero(),
                }));
            }
            for (contact, ForceChange { change, .. }) in contacts.iter_mut().zip(changes) {
                contact.variance = contact.variance.clone() + &(change.clone() * &change);
            }
        }
        if contacts.iter().any(|contact| contact.force < T::zero()) {
            return Ok(None);
        }
        // f/σ is less for the first contact if f²·σ′² < f′²·σ².
        let ratio =
            |one: &Spread<T>, other: &Spread<T>| one.force.clone() * &one.force * &other.variance;
        let varied = contacts
            .into_iter()
            .filter(|contact| !contact.variance.is_zero());
        Ok(varied.reduce(|first, next| {
            if ratio(&next, &first) - &ratio(&first, &next) < T::zero() {
                next
            } else {
                first
            }
        }))
    }
}

/// A pile with its forces, ready to be differentiated.
struct Network<'p, T> {
    pile: &'p Pile,
    /// The pile without weights and loads.
    bare: Pile,
    directions: [Vector<T>; 3],
    /// sin²θ, 4cos²φ·sin²θ and cos²θ: the squares of the units of the symbolic basis.
    squares: [T; 3],
    s: T,
    /// W.
    increment_sum: T,
    /// The forces below each sphere above the floor.
    forces: Sorted<Site, [T; 3]>,
}

impl<'p, T: Field> Network<'p, T> {
    fn new(pile: &'p Pile, inclination: &Inclination) -> Result<Self, Error> {
        let remedy = "take a pile with fewer layers";
        refuse_beyond(
            "the change of all forces",
            pile.sphere_count(),
            MOST_SPHERES,
            remedy,
        )?;
        let forces = pile.forces::<T>();
        let mut below: Sorted<Site, [T; 3]> = Sorted::new();
        for contact in forces.contacts(Selection::All)? {
            let contact = contact?;
            let forces = below.entry(contact.site, zeros());
            forces[contact.direction.index()] = contact.force;
        }
        let across = pile.across();
        let (sin2, cos2) = (inclination.sin2(), inclination.cos2());
        Ok(Self {
            pile,
            bare: pile.bare(),
            directions: pile.directions(),
            squares: [sin2.clone(), across * sin2, cos2].each(|square| T::from_rational(&square)),
            s: T::from_rational(pile.sin_phi()),
            increment_sum: forces.increment_sum()?,
            forces: below,
        })
    }

    /// Returns the change of every contact force per relative growth of one sphere.
    fn changes(&self, grown: Site) -> Result<Vec<ForceChange<T>>, Error> {
        let moved = self.displacements(grown)?;
        let mut forces_on = Vec::new();
        for (site, forces) in self.forces.iter() {
            check_interrupt()?;
            for direction in self.pile.dimension().directions() {
                let support = self.support(*site, *direction)?;
                let along = self.along(site.k, *direction);
                let longer = elongation::<T>(grown, [*site, support]);
                let of = |site: &Site| {
                    let moved = self
                        .forces
                        .place(site)
                        .ok()
                        .map(|place| moved[place].clone());
                    // The bottom spheres do not move.
                    moved.unwrap_or_else(Vector::zero)
                };
                let turned = of(site) - &of(&support) - &along.scaled(&longer);
                let force = turned.scaled(&forces[direction.index()]);
                forces_on.extend([(support, -force.clone()), (*site, force)]);
            }
        }
        let in_mg = |part: T| {
            let share = part.checked_div(&self.increment_sum);
            share.ok_or_else(|| bug("the increments have a sum"))
        };
        let mut loads = Sorted::new();
        loads.merge(forces_on, |sum: &mut Vector<T>, force| {
            *sum = sum.clone() + force;
        });
        let mut directed = Vec::new();
        for (site, Vector { x, y, z }) in loads.into_vec() {
            let (down, x, y) = (in_mg(z)?, in_mg(x)?, in_mg(y)?);
            directed.push((site, Load { down, x, y }));
        }
        let response = self.bare.forces::<T>().with_loads(directed)?;
        let changes = response.contacts(Selection::All)?.map(|contact| {
            let contact = contact?;
            let forces = self.forces.get(&contact.site);
            let forces = forces.ok_or_else(|| bug("a contact has a force"))?;
            Ok(ForceChange {
                site: contact.site,
                direction: contact.direction,
                force: forces[contact.direction.index()].clone(),
                change: contact.force,
            })
        });
        changes.collect()
    }

    /// Returns the displacements of the spheres above the floor, in the order of `forces`, in units of 2Rδ.
    fn displacements(&self, grown: Site) -> Result<Vec<Vector<T>>, Error> {
        let forces = &self.forces;
        let mut moved = alloc::vec![Vector::zero(); forces.len()];
        // From the bottom up.
        for (place, (site, _)) in forces.iter().enumerate().rev() {
            check_interrupt()?;
            let mut along = zeros();
            for direction in self.pile.dimension().directions() {
                let support = self.support(*site, *direction)?;
                let below = self.forces.place(&support).ok().map(|place| {
                    let direction = self.along(site.k, *direction);
                    self.product(&direction, &moved[place])
                });
                let longer = elongation::<T>(grown, [*site, support]);
                // The bottom spheres do not move.
                along[direction.index()] = below.unwrap_or_else(T::zero) + &longer;
            }
            moved[place] = self.solve(site.k, along)?;
        }
        Ok(moved)
    }

    /// Returns the vector u with the given values of ê·u along the contacts below layer `k`.
    fn solve(&self, k: i128, [a, b, c]: [T; 3]) -> Result<Vector<T>, Error> {
        let halved = |value: T| value.div_int(TWO);
        let sum = halved(a.clone() + &b);
        let difference = a - &b;
        // The components times the squares of their units, under a + step.
        let (x, y, up) = match self.pile.dimension() {
            Dimension::Two => (halved(difference), T::zero(), sum),
            Dimension::Three => {
                let x = (sum - &c).checked_div(&(T::one() + &self.s));
                let x = x.ok_or_else(|| bug("1 + s is positive"))?;
                let up = c + &x;
                (x, difference, up)
            }
        };
        let [x, y] = match self.pile.shape().sign_below(k) {
            Some(Sign::Minus) => [-x, -y],
            _ => [x, y],
        };
        let [sin2, across, cos2] = &self.squares;
        let over = |n: T, d: &T| {
            n.checked_div(d)
                .ok_or(Error::overflow("a displacement", T::NAME))
        };
        Ok(Vector {
            x: over(x, sin2)?,
            y: if y.is_zero() { y } else { over(y, across)? },
            z: over(-up, cos2)?,
        })
    }

    /// Returns the scalar product in real units.
    fn product(&self, one: &Vector<T>, other: &Vector<T>) -> T {
        let [x, y, z] = &self.squares;
        one.x.clone() * &other.x * x
            + &(one.y.clone() * &other.y * y)
            + &(one.z.clone() * &other.z * z)
    }

    fn along(&self, k: i128, direction: Direction) -> Vector<T> {
        let along = self.directions[direction.index()].clone();
        match self.pile.shape().sign_below(k) {
            Some(Sign::Minus) => along.turned_about_z(),
            _ => along,
        }
    }

    fn support(&self, site: Site, direction: Direction) -> Result<Site, Error> {
        let support = self.pile.shape().below(site, direction);
        support.ok_or_else(|| bug("a sphere above the floor has its supports"))
    }
}

fn zeros<T: Zero>() -> [T; 3] {
    [T::zero(), T::zero(), T::zero()]
}

/// Returns the elongation of a contact per growth of one sphere, in units of 2R: ½ if the sphere is one of its ends.
fn elongation<T: Field>(grown: Site, ends: [Site; 2]) -> T {
    if ends.contains(&grown) {
        T::one().div_int(TWO)
    } else {
        T::zero()
    }
}
