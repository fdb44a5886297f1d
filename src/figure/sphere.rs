//! The forces on one sphere: the paper's fig. 3.

mod drawing;

use num_rational::BigRational;
use num_traits::Zero;

use super::Subject;
use super::response::middle;
use super::subject::nearest;
use super::view::{Vector, norm};
use crate::lattice::Site;
use crate::scalar::Surd;
use crate::{Error, Pile};

/// The forces that act on one sphere, and the spheres it touches.
///
/// Paper, fig. 3: **a**, **b** and **c** from the three spheres below, **a**′, **b**′ and **c**′ from those above, and
/// the weight **w**. A load is a force of its own; under a bottom sphere is the floor, with its force **n**.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::figure::{SphereForces, Subject};
/// use cannonpile::geometry::Spacing;
/// use cannonpile::lattice::Site;
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(10)?;
/// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
/// let subject = Subject::of_pile(&pile, &spacing)?;
/// let sphere = SphereForces::new(&subject, Site { i: 1, j: 2, k: 5 })?;
/// let names: Vec<&str> = sphere.forces.iter().map(|force| force.name).collect();
/// assert_eq!(names, ["a′", "b′", "c′", "a", "b", "c", "w"]);
/// // In equilibrium.
/// let vertical: f64 = sphere.forces.iter().map(|force| force.magnitude * force.along[2]).sum();
/// assert!(vertical.abs() < 1e-12);
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct SphereForces {
    /// The sphere.
    pub site: Site,
    /// What acts on it.
    pub forces: Vec<SphereForce>,
    /// The unit of the forces.
    pub unit: &'static str,
    /// From its centre to those of the spheres that it touches, in R.
    neighbours: Vec<Vector>,
    /// f₀ in that unit, and what it is.
    unit_force: (f64, &'static str),
    caption: String,
    discs: bool,
}

/// A force on a sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereForce {
    /// `a`, `b`, `c` from below, `a′`, `b′`, `c′` from above, `w` for the weight, `p` for a load, `n` for the floor.
    pub name: &'static str,
    /// Its magnitude, rounded once; negative is pull.
    pub magnitude: f64,
    /// The unit vector along it: x and y the paper's, z up.
    pub along: [f64; 3],
    /// Where it acts, from the centre, in R.
    pub at: [f64; 3],
    /// A contact force in f₀.
    multiple: Option<BigRational>,
}

impl SphereForces {
    /// From the exact forces, each rounded once.
    ///
    /// # Errors
    /// [`Error::SiteOutside`]; [`Error::Overflow`] for forces beyond floats.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::figure::{SphereForces, Subject};
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::lattice::Site;
    /// use num_rational::BigRational;
    ///
    /// // A sphere alone: its weight, and the floor against it.
    /// let pile = Pile::triangular(1)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let sphere = SphereForces::new(&Subject::of_pile(&pile, &spacing)?, Site::APEX)?;
    /// let forces: Vec<_> = sphere.forces.iter().map(|force| (force.name, force.magnitude, force.along[2])).collect();
    /// assert_eq!(forces, [("n", 1.0, 1.0), ("w", 1.0, -1.0)]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn new(subject: &Subject<'_>, site: Site) -> Result<Self, Error> {
        let pile = subject.pile();
        let (packing, statics) = (subject.packing(), subject.packing().forces());
        let site = pile.shape().check(site)?;
        let mut neighbours = Vec::new();
        let mut forces = Vec::new();
        let contact = |name, multiple: BigRational, along: Vector| {
            let force = packing.unit_force().scaled(&multiple);
            Ok::<_, Error>(SphereForce {
                name,
                magnitude: nearest(&force, "a contact force")?,
                along,
                at: scaled(-1.0, along),
                multiple: Some(multiple),
            })
        };
        let names = ["a′", "b′", "c′"];
        let above = statics.from_above(site)?;
        for ((&direction, force), name) in
            pile.dimension().directions().iter().zip(above).zip(names)
        {
            let Some(upper) = pile.shape().above(site, direction) else {
                continue;
            };
            let down = scaled(-1.0, subject.contact(upper, direction)?);
            neighbours.push(scaled(-2.0, down));
            forces.push(contact(name, force, down)?);
        }
        if site.k == pile.layers() - 1 {
            forces.push(floor(subject, site)?);
        } else {
            let directions = pile.dimension().directions().iter();
            for (&direction, name) in directions.zip(["a", "b", "c"]) {
                let up = subject.contact(site, direction)?;
                neighbours.push(scaled(-2.0, up));
                forces.push(contact(name, statics.contact(site, direction)?, up)?);
            }
        }
        let loading = pile.loading();
        let mg = packing.sphere_weight();
        let down = |name, multiple: BigRational, at| {
            Ok::<_, Error>(SphereForce {
                name,
                magnitude: nearest(&Surd::from(multiple * &mg), "a weight")?,
                along: [0.0, 0.0, -1.0],
                at,
                multiple: None,
            })
        };
        forces.push(down("w", loading.weight(site), [0.0; 3])?);
        let load = loading.load(site);
        if !load.is_zero() {
            forces.push(down("p", load, [0.0, 0.0, 1.0])?);
        }
        Ok(Self {
            site,
            forces,
            unit: subject.force_unit(),
            neighbours,
            unit_force: (
                nearest(&packing.unit_force(), "the unit of forces")?,
                subject.unit_force(),
            ),
            caption: subject.caption(),
            discs: subject.is_of_discs(),
        })
    }

    /// The sphere that is shown where none is chosen: one near the middle of the layer in the middle.
    ///
    /// # Errors
    /// None: every pile has such a sphere.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::figure::SphereForces;
    /// use cannonpile::lattice::Site;
    ///
    /// let site = SphereForces::example(&Pile::triangular(10)?)?;
    /// assert_eq!(site, Site { i: 2, j: 2, k: 5 });
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn example(pile: &Pile) -> Result<Site, Error> {
        middle(pile, pile.layers() / 2)
    }
}

fn scaled(t: f64, vector: Vector) -> Vector {
    vector.map(|part| t * part)
}

/// What the floor does to a bottom sphere: the opposite of what it feels.
fn floor(subject: &Subject<'_>, site: Site) -> Result<SphereForce, Error> {
    let force = subject.packing().on_floor(site)?;
    let vector = [
        -nearest(&force.shear_x, "a shear")?,
        -nearest(&force.shear_y, "a shear")?,
        nearest(&force.normal, "a normal force")?,
    ];
    // Divided first, for the greatest and the least of floats.
    let greatest = vector
        .iter()
        .fold(0.0_f64, |most, part| most.max(part.abs()));
    let part = if greatest > 0.0 {
        vector.map(|part| part / greatest)
    } else {
        [0.0, 0.0, 1.0]
    };
    let length = norm(part);
    Ok(SphereForce {
        name: "n",
        magnitude: greatest * length,
        along: part.map(|part| part / length),
        at: [0.0, 0.0, -1.0],
        multiple: None,
    })
}
