//! The derivatives of all contact forces, for tests of differentiable simulators.

use core::fmt::{self, Display, Formatter};
use std::iter::{once, zip};

use num_rational::BigRational;

use cannonpile::geometry::Load;
use cannonpile::lattice::Site;
use cannonpile::shape::Selection;
use cannonpile::{Error, Forces, Packing};
use cannonpile_stability::sensitivity;

/// A component of a load, in the order of [`Load::units`]. Here z points down.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
#[expect(missing_docs, reason = "the names of axes")]
pub enum Component {
    Z,
    X,
    Y,
}

/// A parameter of a pile, on which its contact forces depend.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
#[non_exhaustive]
pub enum Parameter {
    /// δ of a sphere with the radius R(1 + δ). All masses, the centres of the bottom spheres and f₀ stay.
    Radius(Site),
    /// The component of a load along z in mg, x in mg·tanθ or y in 2cosφ·mg·tanθ, as in [`Load`].
    Load(Component, Site),
    /// The tilt of gravity along x in tanθ or y in 2cosφ·tanθ, as in [`Pile::with_tilt`](cannonpile::Pile::with_tilt).
    Tilt(Component),
}

/// Writes `radius K I J`, `load z K I J` or `tilt x`.
impl Display for Parameter {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let name = |component: &Component| ["z", "x", "y"][*component as usize];
        match self {
            Self::Radius(Site { k, i, j }) => write!(f, "radius {k} {i} {j}"),
            Self::Load(component, Site { k, i, j }) => {
                write!(f, "load {} {k} {i} {j}", name(component))
            }
            Self::Tilt(component) => write!(f, "tilt {}", name(component)),
        }
    }
}

/// Returns the derivatives of all contact forces between layers, in f₀ and in the order of tables, one parameter after the
/// other. Forces of horizontal contacts stay as they are. A parameter takes about the time of all forces.
///
/// # Errors
/// As for [`sensitivity`].
///
/// # Examples
/// ```
/// use cannonpile::lattice::Site;
/// use cannonpile::{Packing, Pile, ratio};
/// use cannonpile_dem::{Component, Parameter, derivatives};
///
/// let pile = Pile::triangular(2)?;
/// let packing = Packing::new(&pile, &"6/5".parse()?)?;
/// let all = derivatives(&packing)?.collect::<Result<Vec<_>, _>>()?;
/// // A load on the apex along x is carried by the third contact, at the cost of the others.
/// let load = Parameter::Load(Component::X, Site::APEX);
/// let by_load = all.iter().find(|(parameter, _)| *parameter == load);
/// assert_eq!(by_load.unwrap().1, [ratio!(-1), ratio!(-1), ratio!(2)]);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn derivatives<'p>(
    packing: &'p Packing<'_>,
) -> Result<impl Iterator<Item = Result<(Parameter, Vec<BigRational>), Error>> + 'p, Error> {
    let pile = packing.pile();
    let axes = pile.dimension().directions().len();
    let of_spheres = pile.sites(Selection::All)?.flat_map(move |site| {
        let loads = [Component::Z, Component::X, Component::Y].into_iter();
        let loads = loads
            .take(axes)
            .map(move |component| Parameter::Load(component, site));
        once(Parameter::Radius(site)).chain(loads)
    });
    let tilts = [Component::X, Component::Y].into_iter().take(axes - 1);
    let all = of_spheres.chain(tilts.map(Parameter::Tilt));
    Ok(all.map(|parameter| Ok((parameter, by(packing, parameter)?))))
}

fn by(packing: &Packing<'_>, parameter: Parameter) -> Result<Vec<BigRational>, Error> {
    let pile = packing.pile();
    match parameter {
        Parameter::Radius(site) => {
            let contacts = sensitivity(packing, site)?.into_iter();
            Ok(contacts.map(|contact| contact.change).collect())
        }
        Parameter::Load(component, site) => {
            let [z, x, y] = Load::units();
            let load = match component {
                Component::Z => z,
                Component::X => x,
                Component::Y => y,
            };
            contact_forces(&pile.bare().with_load(site, load)?.forces())
        }
        Parameter::Tilt(component) => {
            let along = |other| BigRational::from_integer(i32::from(component == other).into());
            let tilt = [along(Component::X), along(Component::Y)];
            let tilted = contact_forces(&pile.forces().with_tilt(tilt)?)?;
            let own = contact_forces(&pile.forces())?;
            Ok(zip(tilted, own).map(|(tilted, own)| tilted - own).collect())
        }
    }
}

fn contact_forces(forces: &Forces<'_, BigRational>) -> Result<Vec<BigRational>, Error> {
    let contacts = forces.contacts(Selection::All)?;
    contacts.map(|contact| Ok(contact?.force)).collect()
}
