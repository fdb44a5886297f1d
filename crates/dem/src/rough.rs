//! Scripts for two layers on a rough floor, for LAMMPS and YADE.

use std::io::Write;

use num_rational::BigRational;

use super::lammps::script_texts;
use super::numbered::NumberedPile;
use super::template::fill;
use super::weights::{burdens_of_all, normal};
use super::yade::{by_id, texts, with_vector};
use crate::table::WriteError;
use crate::{Each, Error};
use cannonpile::Packing;
use cannonpile::engine::positive;
use cannonpile::lattice::Dimension;
use cannonpile::scalar::ByValue;
use cannonpile_stability::RoughPacking;

/// The coefficients of friction of a simulated pile on a rough floor.
///
/// # Examples
/// ```
/// use cannonpile::{Packing, Pile};
/// use cannonpile_dem::Friction;
///
/// let pile = Pile::triangular(2)?;
/// let packing = Packing::new(&pile, &"6/5".parse()?)?;
/// let friction = Friction::sufficient(&packing)?;
/// assert!(friction.spheres() > 0.8 && friction.floor() > 0.2);
/// # Ok::<(), cannonpile_dem::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Friction {
    spheres: Coefficient,
    floor: Coefficient,
}

/// A coefficient of friction.
#[derive(Clone, Debug)]
struct Coefficient {
    rounded: f64,
    /// The exact value. `None` for twice the needed one.
    exact: Option<BigRational>,
}

cannonpile::engine::equality!(Coefficient; |Self { rounded, exact }| (rounded, exact.as_ref().map(ByValue)));

impl Friction {
    /// Returns twice the coefficients that the pile needs.
    ///
    /// # Errors
    /// [`RoughFloor`](cannonpile_stability::Error::RoughFloor), and the errors of
    /// [`Pile::base_extremes`](cannonpile::Pile::base_extremes).
    ///
    /// # Examples
    /// See [`Friction`].
    pub fn sufficient(packing: &Packing<'_>) -> Result<Self, Error> {
        let rough = RoughPacking::new(packing)?;
        let twice = |needed: Option<f64>| {
            let rounded = needed.map(|needed| 2.0 * needed);
            let rounded = rounded.ok_or_else(|| Error::overflow("friction", "f64"))?;
            Ok::<_, Error>(Coefficient {
                rounded,
                exact: None,
            })
        };
        Ok(Self {
            spheres: twice(rough.contact_friction().nearest())?,
            floor: twice(rough.floor_friction()?.nearest())?,
        })
    }

    /// Returns these coefficients with another one between spheres.
    ///
    /// # Errors
    /// [`Error::Core`] for zero, a negative number, or a number outside the normal range of `f64`.
    ///
    /// # Examples
    /// See [`with_floor`](Self::with_floor).
    pub fn with_spheres(self, coefficient: &BigRational) -> Result<Self, Error> {
        let spheres = Coefficient::of(coefficient)?;
        Ok(Self { spheres, ..self })
    }

    /// Returns these coefficients with another one of the floor.
    ///
    /// # Errors
    /// As for [`with_spheres`](Self::with_spheres).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Packing, Pile, ratio};
    /// use cannonpile_dem::Friction;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?;
    /// let friction = Friction::sufficient(&packing)?.with_floor(&ratio!(1/10))?;
    /// assert_eq!(friction.floor(), 0.1);
    /// assert!(friction.with_floor(&ratio!(-1/10)).is_err());
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn with_floor(self, coefficient: &BigRational) -> Result<Self, Error> {
        let floor = Coefficient::of(coefficient)?;
        Ok(Self { floor, ..self })
    }

    /// Returns the coefficient between spheres.
    ///
    /// # Examples
    /// See [`Friction`].
    #[must_use]
    pub const fn spheres(&self) -> f64 {
        self.spheres.rounded
    }

    /// Returns the coefficient between spheres and floor.
    ///
    /// # Examples
    /// See [`Friction`].
    #[must_use]
    pub const fn floor(&self) -> f64 {
        self.floor.rounded
    }

    /// Returns whether contacts between spheres hold, and whether the floor does.
    pub(super) fn holds(&self, rough: &RoughPacking<'_>) -> Result<[bool; 2], Error> {
        hold(
            rough,
            [&self.spheres, &self.floor].each(|given| given.exact.as_ref()),
        )
    }
}

/// Returns whether contacts between spheres hold, and whether the floor does, with coefficients of friction. One that is not
/// given is large enough. The comparison is exact.
pub(super) fn hold(
    rough: &RoughPacking<'_>,
    [spheres, floor]: [Option<&BigRational>; 2],
) -> Result<[bool; 2], Error> {
    let contacts = spheres.map_or(Ok(true), |friction| rough.contacts_hold_at(friction))?;
    let floor = floor.map_or(Ok(true), |friction| rough.floor_holds_at(friction))?;
    Ok([contacts, floor])
}

impl Coefficient {
    fn of(exact: &BigRational) -> Result<Self, Error> {
        let exact = positive("friction", exact.clone())?;
        Ok(Self {
            rounded: normal(&exact, "friction")?,
            exact: Some(exact),
        })
    }
}

/// Writes a script for LAMMPS that raises gravity slowly, and writes the forces of the final state.
pub(super) fn write_lammps(
    pile: &NumberedPile<'_>,
    friction: &Friction,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let number = |x: f64| format!("{x:?}");
    let radius = normal(pile.packing().radius(), "radius")?;
    let mut texts = script_texts(pile)?;
    texts.extend([
        ("friction", number(friction.spheres())),
        ("floor_friction", number(friction.floor())),
        ("table", number(-radius)),
        ("loads", loads(pile)?),
    ]);
    Ok(out.write_all(fill(include_str!("rough.in"), &texts).as_bytes())?)
}

/// Writes a script for YADE that raises gravity slowly, and writes the forces of the final state.
pub(super) fn write_yade(
    pile: &NumberedPile<'_>,
    friction: &Friction,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let mut texts = texts(pile)?;
    // Discs turn in their plane.
    let blocked = match pile.pile().dimension() {
        Dimension::Two => "yXZ",
        Dimension::Three => "",
    };
    texts.retain(|(name, _)| !["blocked", "loads"].contains(name));
    let loads = burdens_of_all(pile)?.into_iter().map(with_vector);
    texts.extend([
        ("blocked", blocked.to_owned()),
        ("loads", by_id(loads)),
        ("friction", format!("{:?}", friction.spheres())),
        ("floor_friction", format!("{:?}", friction.floor())),
    ]);
    Ok(out.write_all(fill(include_str!("rough.py"), &texts).as_bytes())?)
}

/// Returns the commands that raise vertical loads with gravity, or an empty text without loads.
fn loads(pile: &NumberedPile<'_>) -> Result<String, Error> {
    let burdens = burdens_of_all(pile)?;
    if burdens.is_empty() {
        return Ok(String::new());
    }
    let sets = burdens
        .iter()
        .map(|(id, [_, _, z])| format!("set             atom {id} d_load {z:?}\n"));
    Ok(format!(
        "# Loads, in N.\nfix             load all property/atom d_load\n{}variable        push atom v_part*d_load\n\
         fix             push all addforce 0.0 0.0 v_push\n",
        sets.collect::<String>()
    ))
}
