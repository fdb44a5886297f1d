//! The derivatives of all contact forces, for tests of differentiable simulators.

use core::fmt::{self, Display, Formatter};
use std::iter::zip;

use num_rational::BigRational;

use cannonpile::geometry::Load;
use cannonpile::lattice::Site;
use cannonpile::shape::Selection;
use cannonpile::{Error, Forces, Packing, ratio};
use cannonpile_stability::sensitivity;

/// A parameter of a pile, on which its contact forces depend.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
#[non_exhaustive]
pub enum Parameter {
    /// δ of a sphere with the radius R(1 + δ). All masses, the centres of the bottom spheres and f₀ stay.
    Radius(Site),
    /// The component of a load along `'z'` in mg, `'x'` in mg·tanθ or `'y'` in 2cosφ·mg·tanθ, as in [`Load`]. Here z points
    /// down.
    Load(char, Site),
    /// The tilt of gravity along `'x'` in tanθ or `'y'` in 2cosφ·tanθ, as in [`Pile::with_tilt`](cannonpile::Pile::with_tilt).
    Tilt(char),
}

/// Writes `radius K I J`, `load z K I J` or `tilt x`.
impl Display for Parameter {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Radius(Site { k, i, j }) => write!(f, "radius {k} {i} {j}"),
            Self::Load(axis, Site { k, i, j }) => write!(f, "load {axis} {k} {i} {j}"),
            Self::Tilt(axis) => write!(f, "tilt {axis}"),
        }
    }
}

/// Returns the derivatives of all contact forces between layers, in f₀ and in the order of tables, by each parameter. Forces of
/// horizontal contacts stay as they are. The time is that of four computations of all forces for each sphere.
///
/// # Errors
/// As for [`sensitivity`].
///
/// # Examples
/// ```
/// use cannonpile::lattice::Site;
/// use cannonpile::{Packing, Pile, ratio};
/// use cannonpile_dem::{Parameter, derivatives};
///
/// let pile = Pile::triangular(2)?;
/// let packing = Packing::new(&pile, &"6/5".parse()?)?;
/// let all = derivatives(&packing)?;
/// // A load on the apex along x is carried by the third contact, at the cost of the others.
/// let by_load = all.iter().find(|(by, _)| *by == Parameter::Load('x', Site::APEX));
/// assert_eq!(by_load.unwrap().1, [ratio!(-1), ratio!(-1), ratio!(2)]);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn derivatives(packing: &Packing<'_>) -> Result<Vec<(Parameter, Vec<BigRational>)>, Error> {
    let (pile, mut all) = (packing.pile(), Vec::new());
    let axes = pile.dimension().directions().len();
    for site in pile.sites(Selection::All)? {
        let contacts = sensitivity(packing, site)?.into_iter();
        let changes = contacts.map(|contact| contact.change);
        all.push((Parameter::Radius(site), changes.collect()));
        for (axis, load) in zip(['z', 'x', 'y'], Load::units()).take(axes) {
            let response = pile.bare().with_load(site, load)?;
            let response = contact_forces(&response.forces())?;
            all.push((Parameter::Load(axis, site), response));
        }
    }
    let own = contact_forces(&pile.forces())?;
    let tilts = [[ratio!(1), ratio!(0)], [ratio!(0), ratio!(1)]];
    for (axis, tilt) in zip(['x', 'y'], tilts).take(axes - 1) {
        let tilted = contact_forces(&pile.forces().with_tilt(tilt)?)?;
        let changes = zip(tilted, &own).map(|(tilted, own)| tilted - own);
        all.push((Parameter::Tilt(axis), changes.collect()));
    }
    Ok(all)
}

fn contact_forces(forces: &Forces<'_, BigRational>) -> Result<Vec<BigRational>, Error> {
    let contacts = forces.contacts(Selection::All)?;
    contacts.map(|contact| Ok(contact?.force)).collect()
}
