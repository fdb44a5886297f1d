//! The difference between the forces of spheres on springs and the exact forces.
//!
//! # The springs
//!
//! The bottom spheres are fixed. Each contact is a linear spring of stiffness κ, F = κδ, where δ is the overlap of the
//! two spheres. Spheres are frictionless and do not rotate, and weights stay vertical. For κ → ∞ the forces are
//!
//! F(κ) = F₀ + F₁/κ + O(1/κ²)
//!
//! with the exact forces F₀ of the rigid pile. [`FirstOrder`] gives F₁: the overlap F₀/κ makes each contact shorter, and the
//! contacts turn by τ/κ. Let ê be the unit vector of a contact from the lower sphere to the upper one. The force on the upper
//! sphere is F₀ê + (F₁ê + F₀τ)/κ + ….
//!
//! So the relative error of a contact force is F₁/(F₀κ), and that of its vector is |F₁ê + F₀τ|/(F₀κ).
//!
//! # Straight piles under one sphere
//!
//! Both errors are polynomials. Consider a contact in layer k with n spheres above it on its line, so that its force is
//! (n + 1) f₀. Its relative error is ε·f₀/(κR), with q = (a/R)² and
//!
//! * spheres: ε = [(4 − q)(5 − q) n − 2(5 − q) k + q(2L + q − 4)] / (2q(3 − q)), f₀ = mg/(3cosθ),
//! * discs: ε = [(4 − q)(6 − q) n − 4(4 − q) k + q(2L + q − 4)] / (2q(4 − q)), f₀ = mg/(2cosθ).
//!
//! ε is linear in n and k, so the largest error is at a corner of 0 ≤ n ≤ k ≤ L − 2. For 6/5 this is the lowest contact
//! of an edge, n = k = L − 2, with (0.5014 L − 0.7895) mg/(κR). This is 0.42 L mg/(κR) for 10 layers, and 0.48 L for
//! 40. For q ≥ 2 the corner is the apex, n = k = 0.
//!
//! # Limits
//!
//! Further touching neighbours also exert forces, so packings with such neighbours are rejected. Contacts without a
//! force are rejected too, because a spring without tension opens or closes them by a rule of its own.

use core::fmt;

use super::numbered::nearest;
use super::weights::checked;
use crate::{Each, Error};
use cannonpile::Packing;
use cannonpile::engine::copies;
use cannonpile::lattice::{Direction, Site};
use cannonpile::shape::Selection;
use cannonpile_stability::{FirstOrder, ForceChange};

/// The errors of contact forces on linear springs, to leading order in 1/κ.
///
/// A *coefficient* c means the error c·mg/(κR).
///
/// # Examples
/// ```
/// use cannonpile_dem::Compliance;
/// use cannonpile::{Packing, Pile};
///
/// let pile = Pile::triangular(10)?;
/// let packing = Packing::new(&pile, &"6/5".parse()?)?;
/// let compliance = Compliance::new(&packing)?;
/// // With k = 10⁷ mg/R; here R = m = g = 1.
/// assert!((compliance.largest_error(1e7) - 4.2248e-7).abs() < 1e-11);
/// # Ok::<(), cannonpile_dem::NoCompliance>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compliance {
    forces: Extremes,
    vectors: Extremes,
    contacts: f64,
    /// The unit of stiffness, mg/R.
    unit: f64,
}

/// The largest coefficient of many contacts, and the sum of their squares.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Extremes {
    largest: f64,
    sum_of_squares: f64,
}

/// The error of one contact on springs.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SoftContact {
    /// The numbers of the upper and of the lower sphere.
    pub ids: [u64; 2],
    /// The site of the upper sphere.
    pub site: Site,
    /// The direction from the upper sphere to the lower one.
    pub direction: Direction,
    /// The coefficient of the relative error of the force, with its sign.
    pub coefficient: f64,
    /// The coefficient of the relative error of the force vector, including its rotation.
    pub vector_coefficient: f64,
}

impl Compliance {
    /// Returns the compliance of a packing.
    ///
    /// # Errors
    /// [`NoCompliance::Touching`] if further neighbours touch, [`NoCompliance::Slack`] if a contact has no force or a
    /// tensile one. [`NoCompliance::Scene`] if the spheres do not fit in memory, or a force is outside the range of
    /// `f64`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::{Compliance, NoCompliance};
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::triangular(10)?;
    /// // Neighbours of a layer touch.
    /// let packing = Packing::new(&pile, &"1".parse()?)?;
    /// assert!(matches!(Compliance::new(&packing), Err(NoCompliance::Touching)));
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn new(packing: &Packing<'_>) -> Result<Self, NoCompliance> {
        Self::inspected(packing, |_| {})
    }

    /// Returns the compliance of a packing, and calls `look` with each contact, from the top.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::Compliance;
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::triangular(4)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?;
    /// let mut coefficients = Vec::new();
    /// Compliance::inspected(&packing, |contact| coefficients.push(contact.coefficient))?;
    /// assert_eq!(coefficients.len(), 30);
    /// // The pile sinks: the contacts of the apex become flatter, and press more.
    /// assert!((coefficients[0] - 0.806).abs() < 1e-3);
    /// # Ok::<(), cannonpile_dem::NoCompliance>(())
    /// ```
    pub fn inspected(
        packing: &Packing<'_>,
        mut look: impl FnMut(&SoftContact),
    ) -> Result<Self, NoCompliance> {
        if packing.pile().horizontal_forces().len() > 0 || !packing.touching().is_empty() {
            return Err(NoCompliance::Touching);
        }
        let weight = packing.mass() * packing.gravity();
        let unit_force = packing.unit_force().scaled(&weight.recip());
        let unit_force = nearest(&unit_force, "f₀ in mg")?;
        let unit = (weight / packing.radius()).into();
        let mut compliance = Self {
            forces: Extremes::default(),
            vectors: Extremes::default(),
            contacts: 0.0,
            unit: checked(nearest(&unit, UNIT)?, UNIT)?,
        };
        let layers = packing.forces().layers(Selection::All)?.nearest()?;
        let resting = layers.slice_len()?;
        let mut forces = [Vec::new(), Vec::new(), Vec::new()];
        for line in &mut forces {
            *line = copies(0.0, resting, "the contact forces of all spheres")?;
        }
        layers.fill(forces.each_mut().each(Vec::as_mut_slice))?;
        let network = FirstOrder::new(packing, forces)?;
        // The unit of elongation is f₀/(2Rκ), so that of changes is f₀²/(2Rκ). A coefficient is in mg instead of f₀.
        let unit = unit_force / 2.0;
        network.changes(
            |force, _| -force,
            |contact| {
                let ForceChange {
                    site,
                    direction,
                    force,
                    change,
                    ..
                } = contact;
                if force <= 0.0 {
                    return Err(NoCompliance::Slack { site, direction });
                }
                let relative: f64 = change / force;
                let vector = relative.hypot(f64::sqrt(network.square(&contact.turn)));
                let contact = SoftContact {
                    ids: contact.spheres.map(|number| number as u64 + 1),
                    site,
                    direction,
                    coefficient: relative * unit,
                    vector_coefficient: vector * unit,
                };
                compliance.contacts += 1.0;
                compliance.forces.add(contact.coefficient);
                compliance.vectors.add(contact.vector_coefficient);
                look(&contact);
                Ok(())
            },
        )?;
        let sums = [compliance.forces, compliance.vectors].each(|of| of.sum_of_squares);
        if sums.iter().all(|sum| sum.is_finite()) {
            Ok(compliance)
        } else {
            let (quantity, scalar) = ("an error of springs", "f64");
            Err(NoCompliance::Scene(Error::overflow(quantity, scalar)))
        }
    }

    /// Returns the largest coefficient of forces, c. No contact has a relative error above c·mg/(κR).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::Compliance;
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::discs(10)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?;
    /// assert!((Compliance::new(&packing)?.coefficient() - 4.8155).abs() < 1e-4);
    /// # Ok::<(), cannonpile_dem::NoCompliance>(())
    /// ```
    #[must_use]
    pub const fn coefficient(&self) -> f64 {
        self.forces.largest
    }

    /// Returns the largest coefficient of force vectors.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::Compliance;
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?;
    /// let compliance = Compliance::new(&packing)?;
    /// assert!((compliance.vector_coefficient() - 4.2507).abs() < 1e-4);
    /// # Ok::<(), cannonpile_dem::NoCompliance>(())
    /// ```
    #[must_use]
    pub const fn vector_coefficient(&self) -> f64 {
        self.vectors.largest
    }

    /// Returns the largest relative error of a force at the stiffness κ, in units of mg/R (N/m in SI).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::Compliance;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?.with_mass(BigRational::from_integer(3.into()))?;
    /// let compliance = Compliance::new(&packing)?;
    /// // c·mg/(κR) with mg/R = 3.
    /// assert_eq!(compliance.largest_error(1e7), compliance.coefficient() * (3.0 / 1e7));
    /// # Ok::<(), cannonpile_dem::NoCompliance>(())
    /// ```
    #[must_use]
    pub fn largest_error(&self, stiffness: f64) -> f64 {
        self.forces.largest * (self.unit / stiffness)
    }

    /// Returns the largest relative error of a force vector at the stiffness κ.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::Compliance;
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::triangular(10)?;
    /// let compliance = Compliance::new(&Packing::new(&pile, &"6/5".parse()?)?)?;
    /// assert!(compliance.largest_vector_error(1e7) > compliance.largest_error(1e7));
    /// # Ok::<(), cannonpile_dem::NoCompliance>(())
    /// ```
    #[must_use]
    pub fn largest_vector_error(&self, stiffness: f64) -> f64 {
        self.vectors.largest * (self.unit / stiffness)
    }

    /// Returns the root mean square of the relative errors of all forces at the stiffness κ; 0 without contacts.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::Compliance;
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::triangular(10)?;
    /// let compliance = Compliance::new(&Packing::new(&pile, &"6/5".parse()?)?)?;
    /// assert!((compliance.rms_error(1e7) - 1.8581e-7).abs() < 1e-11);
    /// # Ok::<(), cannonpile_dem::NoCompliance>(())
    /// ```
    #[must_use]
    pub fn rms_error(&self, stiffness: f64) -> f64 {
        self.forces.rms(self.contacts) * (self.unit / stiffness)
    }

    /// Returns the root mean square of the relative errors of all force vectors at the stiffness κ; 0 without contacts.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::Compliance;
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::triangular(10)?;
    /// let compliance = Compliance::new(&Packing::new(&pile, &"6/5".parse()?)?)?;
    /// assert!((compliance.rms_vector_error(1e7) - 2.4162e-7).abs() < 1e-11);
    /// # Ok::<(), cannonpile_dem::NoCompliance>(())
    /// ```
    #[must_use]
    pub fn rms_vector_error(&self, stiffness: f64) -> f64 {
        self.vectors.rms(self.contacts) * (self.unit / stiffness)
    }

    /// Returns the unit of stiffness, mg/R in N/m.
    pub(crate) const fn unit(&self) -> f64 {
        self.unit
    }
}

const UNIT: &str = "mg/R";

impl Extremes {
    fn add(&mut self, coefficient: f64) {
        self.largest = self.largest.max(coefficient.abs());
        self.sum_of_squares += coefficient * coefficient;
    }

    fn rms(self, contacts: f64) -> f64 {
        if contacts > 0.0 {
            (self.sum_of_squares / contacts).sqrt()
        } else {
            0.0
        }
    }
}

/// The reason why the errors of springs are unknown for a packing, in one line.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum NoCompliance {
    /// Neighbours touch in addition to the contacts.
    Touching,
    /// A contact has no force, or a tensile one.
    Slack {
        /// The site of the upper sphere.
        site: Site,
        /// The direction from the upper sphere to the lower one.
        direction: Direction,
    },
    /// The exact forces are unknown.
    Scene(Error),
}

impl fmt::Display for NoCompliance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Touching => f.write_str(
                "further neighbours touch, and springs would press them: choose a spacing at which they do not",
            ),
            Self::Slack {
                site: Site { i, j, k },
                direction,
            } => write!(
                f,
                "the contact of sphere (k={k}, i={i}, j={j}) along {} has no force or a tensile one: \
                 its spring may open",
                direction.name()
            ),
            Self::Scene(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for NoCompliance {}

impl From<cannonpile::Error> for NoCompliance {
    fn from(error: cannonpile::Error) -> Self {
        Self::Scene(error.into())
    }
}

impl From<Error> for NoCompliance {
    fn from(error: Error) -> Self {
        Self::Scene(error)
    }
}
