//! What a card says of a pile, each number exact and rounded.

use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::One;

use super::extremes::Extremes;
use super::lists::{Contact, Listed, OnFloor, Sphere, base, contact, contacts, spheres};
use super::value::{FORCE, Value};
use crate::Error;
use crate::numbered::{NumberedPile, nearest};
use crate::springs::Springs;
use crate::table::{Summary, Units};
use cannonpile::Verdict;
use cannonpile::scalar::{Ring, Surd};

/// The least and the greatest normal force, in N, and the greatest ratio of shear to normal force.
pub(super) struct Floor {
    pub(super) normal_min: Value,
    pub(super) normal_max: Value,
    pub(super) shear_ratio: Value,
}

/// Whether the pile stands.
#[derive(Clone)]
pub(super) enum Stands {
    Known(Verdict),
    /// Of spheres without weight it is not asked.
    NotAsked,
    /// It would take too long to find out, for this reason.
    TooLarge(String),
}

/// The stiffness of the springs in the scripts for LAMMPS and YADE.
pub(super) struct Stiffness {
    /// k, in N/m.
    pub(super) spring: f64,
    /// F/(kR), with the greatest contact force F.
    pub(super) compliance: f64,
}

/// All of it.
pub(super) struct Facts<'f, 'p> {
    pub(super) pile: &'f NumberedPile<'p>,
    pub(super) stands: Stands,
    pub(super) unit_force: Value,
    pub(super) radius: Value,
    pub(super) mass: Value,
    pub(super) gravity: Value,
    pub(super) spacing: Value,
    pub(super) sin_theta: Value,
    pub(super) cos_theta: Value,
    pub(super) weight: Value,
    pub(super) sphere_count: BigUint,
    pub(super) contact_count: BigUint,
    pub(super) base_count: BigUint,
    pub(super) bearing: BigUint,
    pub(super) idle: BigUint,
    pub(super) pulling: BigUint,
    pub(super) horizontal: usize,
    /// Whether neighbours of a layer touch, at a = R.
    pub(super) neighbours_touch: bool,
    pub(super) greatest: Option<Contact>,
    pub(super) least: Option<Contact>,
    /// Or why it is not known.
    pub(super) floor: Result<Floor, String>,
    /// None where floats have no such springs.
    pub(super) stiffness: Option<Stiffness>,
    /// The relative error that a code is allowed on such springs, a power of ten.
    pub(super) accept: String,
    /// None where there are too many to list.
    pub(super) spheres: Option<Vec<Sphere>>,
    pub(super) contacts: Option<Vec<Contact>>,
    pub(super) base: Option<Vec<OnFloor>>,
}

impl<'f, 'p> Facts<'f, 'p> {
    pub(super) fn of(numbered: &'f NumberedPile<'p>, listed: Listed) -> Result<Self, Error> {
        let (pile, packing) = (numbered.pile(), numbered.packing());
        let few = |count: &BigUint| *count <= BigUint::from(listed.most);
        let extremes = Extremes::of(pile)?;
        let greatest = extremes.greatest.map(|found| contact(numbered, found));
        let greatest = greatest.transpose()?;
        let weakest = extremes.weakest.map(|weakest| {
            let newtons = packing.unit_force().scaled(&weakest);
            nearest(&newtons, FORCE)
        });
        let weakest = weakest.transpose()?;
        let stiffness = stiffness(numbered, greatest.as_ref());
        let least = extremes.least.map(|found| contact(numbered, found));
        let (contact_count, sphere_count) = (numbered.contact_count(), pile.sphere_count());
        let inclination = packing.inclination();
        let weight = pile.weight() * packing.sphere_weight();
        Ok(Self {
            pile: numbered,
            stands: stands(numbered)?,
            unit_force: Value::new(&packing.unit_force(), FORCE)?,
            radius: Value::rational(packing.radius().clone(), "radius")?,
            mass: Value::rational(packing.mass().clone(), "mass")?,
            gravity: Value::rational(packing.gravity().clone(), "gravity")?,
            spacing: spacing(numbered)?,
            sin_theta: Value::new(&inclination.sin(), "sin θ")?,
            cos_theta: Value::new(&inclination.cos(), "cos θ")?,
            weight: Value::rational(weight, "the weight of all spheres")?,
            base_count: pile.base_sphere_count(),
            bearing: extremes.bearing,
            idle: extremes.idle,
            pulling: extremes.pulling,
            horizontal: pile.horizontal_forces().len(),
            neighbours_touch: packing.touching().iter().any(|apart| apart.layers == 0),
            accept: accept(stiffness.as_ref(), greatest.as_ref(), weakest),
            stiffness,
            greatest,
            least: least.transpose()?,
            floor: floor(numbered)?,
            spheres: few(&sphere_count).then(|| spheres(numbered)).transpose()?,
            contacts: few(&contact_count)
                .then(|| contacts(numbered))
                .transpose()?,
            base: few(&pile.base_sphere_count())
                .then(|| base(numbered))
                .transpose()?,
            sphere_count,
            contact_count,
        })
    }
}

/// a/R, from sin²θ = (a/R)²(d−1)/(2d).
fn spacing(numbered: &NumberedPile<'_>) -> Result<Value, Error> {
    let d = BigRational::from_i128(numbered.pile().dimension().number().into());
    let square = numbered.packing().inclination().sin2() * (&d + &d) / (d - BigRational::one());
    let spacing = Surd::sqrt(square).map_err(cannonpile::Error::from)?;
    Value::new(&spacing, "the spacing")
}

fn stands(numbered: &NumberedPile<'_>) -> Result<Stands, Error> {
    let packing = numbered.packing();
    let units = Units::of_packing(packing.clone());
    match Summary::new(&units, Some(packing.touching().to_vec())) {
        Ok(summary) => Ok(summary.verdict().map_or(Stands::NotAsked, Stands::Known)),
        Err(error @ Error::Core(cannonpile::Error::TooLarge { .. })) => {
            Ok(Stands::TooLarge(error.to_string()))
        }
        Err(error) => Err(error),
    }
}

fn stiffness(numbered: &NumberedPile<'_>, greatest: Option<&Contact>) -> Option<Stiffness> {
    let springs = Springs::of(numbered).ok()?;
    let compliance = greatest?.force.float / (springs.stiffness * springs.radius);
    compliance.is_finite().then_some(Stiffness {
        spring: springs.stiffness,
        compliance,
    })
}

/// Ten times F/(kR), over what the weakest contact has of the greatest force; 10⁻⁵ at least, 10⁻¹ at most.
fn accept(
    stiffness: Option<&Stiffness>,
    greatest: Option<&Contact>,
    weakest: Option<f64>,
) -> String {
    let error = match (stiffness, greatest, weakest) {
        (Some(stiffness), Some(greatest), Some(weakest)) => {
            10.0 * stiffness.compliance * greatest.force.float / weakest
        }
        _ => 1e-5,
    };
    // Not a default: the steps of a scale, and no answer of the pile.
    let power = error.log10().ceil().clamp(-5.0, -1.0);
    format!("1e{power}")
}

fn floor(numbered: &NumberedPile<'_>) -> Result<Result<Floor, String>, Error> {
    let packing = numbered.packing();
    let extremes = match numbered.pile().base_extremes() {
        Err(error @ cannonpile::Error::TooLarge { .. }) => return Ok(Err(error.to_string())),
        extremes => extremes?,
    };
    let normal = |multiple: &BigRational| {
        Value::rational(multiple * packing.sphere_weight(), "a force on the floor")
    };
    let ratio = packing.inclination().tan() * &extremes.max_shear_ratio;
    Ok(Ok(Floor {
        normal_min: normal(&extremes.normal_min)?,
        normal_max: normal(&extremes.normal_max)?,
        shear_ratio: Value::new(&ratio, "a ratio of forces")?,
    }))
}
