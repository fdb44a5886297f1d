//! The change of every force if one sphere is larger, and the force that unequal spheres change most.

use cannonpile::each::Each;
use cannonpile::engine::{equality, refuse_beyond};
use cannonpile::lattice::{Direction, Site};
use cannonpile::scalar::{Field, Ring};
use cannonpile::shape::Selection;
use cannonpile::{Error, Packing, ratio};
use num_rational::BigRational;

use crate::{FirstOrder, ForceChange};

/// The greatest number of spheres of a pile whose forces are differentiated.
const MOST_SPHERES: u64 = 1_000_000;

/// The greatest number of spheres of a pile for [`spread`], which differentiates by each of them.
const MOST_VARIED: u64 = 10_000;

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

equality!(Spread<T>, T: Ring; |Self { site, direction, force, variance }|
    (site, direction, [force, variance].map(Ring::comparison_key)));

impl<T: Field> Spread<T> {
    /// Returns the square of the relative standard deviation r of the radii at which the force is three standard
    /// deviations from zero: f²/(9·variance). `None` if the scalar cannot divide by the variance.
    ///
    /// # Examples
    /// See [`spread`].
    #[must_use]
    pub fn bearable_squared(&self) -> Option<T> {
        let nine = T::from_integer(9) * &self.variance;
        (self.force.clone() * &self.force).checked_div(&nine)
    }
}

/// Returns the change of every contact force per relative growth δ of one sphere, in the order of tables. A bottom sphere
/// grows about its fixed centre.
///
/// The sphere has the radius R(1 + δ). Its contacts are longer by Rδ, and all others keep their length. [`FirstOrder`] has
/// the equations.
///
/// # Errors
/// [`Error::SiteOutside`]; [`Error::TooLarge`] for more than a million spheres; [`Error::Overflow`].
///
/// # Examples
/// ```
/// use cannonpile::lattice::Site;
/// use cannonpile::{Packing, Pile, ratio};
/// use cannonpile_stability::sensitivity;
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(2)?;
/// let packing = Packing::new(&pile, &"6/5".parse()?)?;
/// let changes = sensitivity::<BigRational>(&packing, Site { i: 0, j: 0, k: 1 })?;
/// // A larger support moves the apex towards the other two, which then carry more.
/// let changes: Vec<_> = changes.into_iter().map(|contact| contact.change).collect();
/// assert_eq!(changes, [ratio!(-283/234), ratio!(175/468), ratio!(175/468)]);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn sensitivity<T: Field>(
    packing: &Packing<'_>,
    site: Site,
) -> Result<Vec<ForceChange<T>>, Error> {
    let grown = packing.pile().numbering()?.id(site)? - 1;
    changes(&network(packing)?, grown)
}

/// Returns the contact that opens first under independent deviations of all radii: the one whose force is the least
/// multiple of its standard deviation. `None` if some contact needs tension, or if no radius changes a force.
///
/// For independent radii of relative standard deviation r, the variance of a force is r² times the sum of the squares of
/// its changes. The theory for equal spheres describes a pile of real ones only while this deviation is small: see
/// [`Spread::bearable_squared`].
///
/// # Errors
/// [`Error::TooLarge`] for more than ten thousand spheres. [`Error::Overflow`], also if the scalar cannot decide which
/// of two forces is weaker, as overlapping intervals cannot.
///
/// # Examples
/// ```
/// use cannonpile::{Packing, Pile};
/// use cannonpile_stability::spread;
///
/// let pile = Pile::triangular(4)?;
/// let packing = Packing::new(&pile, &"6/5".parse()?)?;
/// let spread = spread::<f64>(&packing)?.unwrap();
/// // For radii of relative standard deviation r, the force has the relative standard deviation 6.4 r.
/// let relative = spread.variance.sqrt() / spread.force;
/// assert!((relative - 6.4).abs() < 0.1);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn spread<T: Field + PartialOrd>(packing: &Packing<'_>) -> Result<Option<Spread<T>>, Error> {
    let spheres = packing.pile().sphere_count();
    let remedy = "ask for the changes by single spheres";
    refuse_beyond("the spread of this pile", spheres, MOST_VARIED, remedy)?;
    let network = network::<T>(packing)?;
    let mut contacts: Vec<Spread<T>> = Vec::new();
    for grown in 0..packing.pile().numbering()?.sphere_count() {
        let changes = changes(&network, grown)?;
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
    let undecided = || Error::overflow("the order of two variances", T::NAME);
    for Spread {
        force, variance, ..
    } in &contacts
    {
        let sign = force.partial_cmp(&T::zero()).ok_or_else(undecided)?;
        if !variance.is_defined() {
            return Err(Error::overflow("the variance of a force", T::NAME));
        }
        if sign.is_lt() {
            return Ok(None);
        }
    }
    // f/σ is less for the first contact if f²·σ′² < f′²·σ².
    let ratio =
        |one: &Spread<T>, other: &Spread<T>| one.force.clone() * &one.force * &other.variance;
    let mut weakest: Option<Spread<T>> = None;
    for next in contacts {
        if next.variance.is_zero() {
            continue;
        }
        let Some(first) = &weakest else {
            weakest = Some(next);
            continue;
        };
        let difference = ratio(&next, first) - &ratio(first, &next);
        let order = difference.partial_cmp(&T::zero());
        let order = order.filter(|_| difference.is_defined());
        if order.ok_or_else(undecided)?.is_lt() {
            weakest = Some(next);
        }
    }
    Ok(weakest)
}

/// Returns the pile of a packing with its forces.
fn network<T: Field>(packing: &Packing<'_>) -> Result<FirstOrder<T>, Error> {
    let spheres = packing.pile().sphere_count();
    let remedy = "take a pile with fewer layers";
    refuse_beyond("the change of all forces", spheres, MOST_SPHERES, remedy)?;
    let layers = packing.pile().forces::<T>().layers(Selection::All)?;
    let above_floor = layers.slice_len()?;
    let mut forces = [(); 3].each(|()| vec![T::zero(); above_floor]);
    layers.fill(forces.each_mut().each(Vec::as_mut_slice))?;
    FirstOrder::new(packing, forces)
}

/// Returns the change of every contact force per relative growth of one sphere.
fn changes<T: Field>(network: &FirstOrder<T>, grown: u64) -> Result<Vec<ForceChange<T>>, Error> {
    let half = T::from_rational(&ratio!(1 / 2));
    let elongation = |_: &T, ends: [usize; 2]| {
        if ends.into_iter().any(|end| end as u64 == grown) {
            half.clone()
        } else {
            T::zero()
        }
    };
    let mut changes = Vec::new();
    network.changes(elongation, |contact| -> Result<(), Error> {
        changes.push(contact);
        Ok(())
    })?;
    Ok(changes)
}
