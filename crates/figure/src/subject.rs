//! The subject of a figure: a pile with a spacing, and the units of forces and lengths.

use cannonpile::engine::bug;
use cannonpile::geometry;
use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Dimension, Direction, HorizontalContact, Site};
use cannonpile::scalar::Surd;
use cannonpile::shape::Selection;
use cannonpile::{FloorForce, Forces, Load, Packing, Pile};
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::glyph::Point;
use super::view::Vector;
use crate::Error;

/// A pile with a spacing, and the units of a figure.
///
/// # Examples
/// ```
/// use cannonpile_figure::Subject;
/// use cannonpile::geometry::Spacing;
/// use cannonpile::{Packing, Pile};
/// use num_rational::BigRational;
///
/// let (pile, spacing) = (Pile::triangular(10)?, Spacing::new(BigRational::new(6.into(), 5.into()))?);
/// let in_mg = cannonpile_figure::base(&Subject::of_pile(&pile, &spacing)?)?.to_string();
/// assert!(in_mg.contains("in mg") && in_mg.contains("data-value=\"4.0\""));
///
/// let packing = Packing::new(&pile, &spacing)?.with_gravity(BigRational::new(981.into(), 100.into()))?;
/// let in_newtons = cannonpile_figure::base(&Subject::of_packing(packing))?.to_string();
/// assert!(in_newtons.contains("in N") && in_newtons.contains("data-value=\"39.24\""));
/// # Ok::<(), cannonpile_figure::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Subject<'p> {
    packing: Packing<'p>,
    si: bool,
    /// True if open horizontal contacts are drawn too.
    horizontal: bool,
}

impl<'p> Subject<'p> {
    /// Returns a subject with lengths in R, forces in mg and shear forces in mg·tanθ.
    ///
    /// # Errors
    /// The errors of [`Packing::new`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile_figure::Subject;
    /// use cannonpile::geometry::Spacing;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let svg = cannonpile_figure::shear(&Subject::of_pile(&pile, &spacing)?)?.to_string();
    /// assert!(svg.contains("greatest 3 mg·tanθ"));
    /// # Ok::<(), cannonpile_figure::Error>(())
    /// ```
    pub fn of_pile(pile: &'p Pile, spacing: &Spacing) -> Result<Self, Error> {
        let packing = Packing::new(pile, spacing)?;
        Ok(Self {
            packing,
            si: false,
            horizontal: false,
        })
    }

    /// Returns a subject with lengths in metres and forces in newtons.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_figure::Subject;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let svg = cannonpile_figure::shear(&Subject::of_packing(packing))?.to_string();
    /// assert!(svg.contains("greatest 2.882 N") && svg.contains("x in m"));
    /// # Ok::<(), cannonpile_figure::Error>(())
    /// ```
    #[must_use]
    pub fn of_packing(packing: Packing<'p>) -> Self {
        Self {
            packing,
            si: true,
            horizontal: false,
        }
    }

    /// Adds the horizontal contacts of the pile. Those without a force are drawn as open.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile_figure::Subject;
    /// use cannonpile::geometry::Spacing;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(4)?;
    /// let spacing = Spacing::new(BigRational::from_integer(1.into()))?;
    /// let subject = Subject::of_pile(&pile, &spacing)?.with_horizontal_contacts();
    /// let mut svg = Vec::new();
    /// cannonpile_figure::layer(&subject, 2)?.write(&mut svg)?;
    /// assert_eq!(String::from_utf8(svg)?.matches("gamma-beta").count(), 3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_horizontal_contacts(self) -> Self {
        Self {
            horizontal: true,
            ..self
        }
    }

    pub(super) const fn packing(&self) -> &Packing<'p> {
        &self.packing
    }

    /// Returns the part of the caption about horizontal contacts, if the pile or the figure has them.
    pub(super) fn horizontal_state(&self) -> Option<String> {
        match self.pile().horizontal_forces().len() {
            0 => self.horizontal.then(|| "horizontal contacts open".into()),
            1 => Some("1 closed horizontal contact".into()),
            closed => Some(format!("{closed} closed horizontal contacts")),
        }
    }

    /// Returns the part of the caption about open horizontal contacts.
    pub(super) fn sight(&self) -> &'static str {
        if self.horizontal {
            "; dashed: open"
        } else {
            ""
        }
    }

    /// Returns the visible horizontal contacts of a part of the pile, with their forces.
    pub(super) fn horizontal(
        &self,
        part: Selection,
    ) -> Result<impl Iterator<Item = (HorizontalContact, BigRational)> + use<'p>, Error> {
        let (pile, all) = (self.pile(), self.horizontal);
        let spheres = pile.rows(part)?.off_the_floor().flatten();
        let contacts = spheres.flat_map(move |site| pile.shape().horizontal_contacts(site));
        let forces = contacts.map(move |contact| (contact, pile.horizontal_force(contact)));
        Ok(forces.filter(move |(_, force)| all || !force.is_zero()))
    }

    pub(super) fn pile(&self) -> &'p Pile {
        self.packing.pile()
    }

    pub(super) fn is_of_discs(&self) -> bool {
        self.pile().dimension() == Dimension::Two
    }

    /// Returns the unit of forces.
    pub(super) fn force_unit(&self) -> &'static str {
        if self.si { "N" } else { "mg" }
    }

    /// Returns the unit of shear forces.
    pub(super) fn shear_unit(&self) -> &'static str {
        if self.si { "N" } else { "mg·tanθ" }
    }

    /// Returns the unit of lengths.
    pub(super) fn length_unit(&self) -> &'static str {
        if self.si { "m" } else { "R" }
    }

    /// Returns f₀ in the unit of forces, and its formula.
    pub(super) fn unit_force(&self) -> Result<(f64, &'static str), Error> {
        let formula = match (self.is_of_discs(), self.pile().is_regular()) {
            (true, _) => "mg/(2 cosθ)",
            (false, true) => "mg/(3 cosθ)",
            (false, false) => "mg/(2(1+sinφ) cosθ)",
        };
        Ok((
            nearest(&self.packing.unit_force(), "the unit of forces")?,
            formula,
        ))
    }

    /// Returns R in the unit of lengths.
    pub(super) fn radius(&self) -> Result<f64, Error> {
        nearest(&self.packing.radius().clone().into(), "the radius")
    }

    /// Returns the position of a sphere, in the unit of lengths.
    pub(super) fn position(&self, site: Site) -> Result<Vector, Error> {
        rounded(&self.packing.position(site)?)
    }

    /// Returns the position of a sphere relative to another, in R. The exact difference is rounded, so the result is
    /// accurate even at a distance of 10³⁰ R from the apex.
    pub(super) fn from(&self, origin: Site, site: Site) -> Result<Vector, Error> {
        let radii = self.packing.radius().recip();
        let [origin, site] = [self.packing.position(origin)?, self.packing.position(site)?];
        let mut apart = [0.0; 3];
        for (apart, (from, to)) in apart.iter_mut().zip(origin.iter().zip(&site)) {
            *apart = difference(&to.scaled(&radii), &from.scaled(&radii))?;
        }
        Ok(apart)
    }

    /// Returns the distance of a sphere from the plane x = 0, in rows (steps j → j+1).
    pub(super) fn rows(&self, site: Site) -> Result<BigRational, Error> {
        let x = self.packing.forces().position(site)?.x;
        Ok(x / (BigRational::one() + self.pile().sin_phi()))
    }

    /// Returns the unit vectors from the spheres below to a sphere above a + step, up to rounding.
    pub(super) fn directions(&self) -> Result<[Vector; 3], Error> {
        let sin = nearest(&self.packing.inclination().sin(), "an angle")?;
        let cos = nearest(&self.packing.inclination().cos(), "an angle")?;
        let s = nearest(&self.pile().sin_phi().clone().into(), "an angle")?;
        let directions = if self.is_of_discs() {
            geometry::disc_directions()
        } else {
            geometry::directions(&s)
        };
        let basis = [sin, 2.0 * (1.0 - s * s).sqrt() * sin, -cos];
        Ok(directions.map(|direction| direction.on(&basis)))
    }

    /// Returns the steps i → i+1 and j → j+1 in a layer, in R. For discs the second step is across their plane.
    pub(super) fn steps(&self) -> Result<[Point; 2], Error> {
        let [a, b, c] = self.directions()?;
        let step = |to: Vector| [2.0 * (a[0] - to[0]), 2.0 * (a[1] - to[1])];
        let [i, j] = [step(b), step(c)];
        Ok([i, if self.is_of_discs() { [0.0, i[0]] } else { j }])
    }

    /// Returns `i,j` of a sphere, or `i` of a disc.
    pub(super) fn indices(&self, Site { i, j, .. }: Site) -> String {
        if self.is_of_discs() {
            format!("{i}")
        } else {
            format!("{i},{j}")
        }
    }

    /// Returns the contact forces, in f₀.
    pub(super) fn forces(&self) -> &Forces<'p, BigRational> {
        self.packing.forces()
    }

    /// Returns a contact force, in the unit of the figure.
    pub(super) fn force(&self, multiple: &BigRational) -> Result<f64, Error> {
        nearest(
            &self.packing.unit_force().scaled(multiple),
            "a contact force",
        )
    }

    /// Returns the vertical part of a contact force, in the unit of the figure: f·mg/W.
    pub(super) fn vertical(&self, multiple: &BigRational) -> Result<Surd, Error> {
        let sum = self.packing.forces().increment_sum()?;
        Ok((multiple * self.packing.sphere_weight() / sum).into())
    }

    /// Returns a load as a vector, in the unit of the figure: x, y and z (up).
    pub(super) fn load(&self, load: Load) -> Result<Vector, Error> {
        let force = FloorForce {
            site: Site::APEX,
            normal: load.down,
            shear_x: load.x,
            shear_y: load.y,
        };
        let force = self.packing.floor_force_in_si(force);
        let [x, y, z] = [&force.shear_x, &force.shear_y, &force.normal];
        let part = |part| nearest(part, "a load");
        Ok([part(x)?, part(y)?, -part(z)?])
    }

    /// Returns a base normal force, in the unit of the figure.
    pub(super) fn normal(&self, multiple: BigRational) -> Surd {
        (multiple * self.packing.sphere_weight()).into()
    }

    pub(super) fn on_floor(&self, site: Site) -> Result<Vector, Error> {
        let force = self.packing.on_floor(site)?;
        rounded(&[force.shear_x, force.shear_y, force.normal])
    }

    /// Returns the base forces, in the units of the figure.
    pub(super) fn base(
        &self,
    ) -> Result<impl Iterator<Item = Result<FloorForce<Surd>, Error>> + '_, Error> {
        let cot = self.packing.inclination().tan().checked_recip();
        let cot = cot.ok_or_else(|| bug("θ is positive"))?;
        let in_units = move |force: FloorForce<Surd>| {
            if self.si {
                return force;
            }
            FloorForce {
                shear_x: force.shear_x * &cot,
                shear_y: force.shear_y * &cot,
                ..force
            }
        };
        let forces = self.packing.base(Selection::Base)?;
        Ok(forces.map(move |force| Ok(in_units(force?))))
    }

    /// Returns tanθ.
    pub(super) fn tan(&self) -> Result<f64, Error> {
        nearest(&self.packing.inclination().tan(), "an angle")
    }

    /// Returns the angle of a tilt in degrees, from |t|².
    pub(super) fn angle(&self, squared: &BigRational) -> Result<f64, Error> {
        Ok(cannonpile_dem::angle::of_tilt(&self.packing, squared)?)
    }

    /// Returns the note of a figure of a part of the pile, if a contact in it is tensile.
    pub(super) fn note_of_part(&self, is_tensile: bool) -> Option<String> {
        (is_tensile && !self.pile().is_weightless()).then(|| {
            "this pile is unstable without further contacts: some contact here needs tension; these forces are the only ones \
             in equilibrium"
                .into()
        })
    }

    /// Returns the note of a figure of the whole pile, if the pile is unstable.
    pub(super) fn note(&self) -> Option<String> {
        if self.pile().is_weightless() {
            return None;
        }
        match self.pile().first_failure() {
            Ok(failure) => failure.map(|k| {
                format!("this pile is unstable without further contacts: below layer k = {k} some contact needs tension")
            }),
            Err(error) => Some(format!("the stability of this pile is unknown: {error}")),
        }
    }
}

/// Returns the sphere below another in a direction.
pub(super) fn below(pile: &Pile, site: Site, direction: Direction) -> Result<Site, Error> {
    let below = pile.shape().below(site, direction);
    below.ok_or_else(|| cannonpile::Error::OnFloor { site }.into())
}

/// Returns a/R, from sin²θ = (a/R)²(d−1)/(2d) in d dimensions.
pub(super) fn spacing(packing: &Packing<'_>) -> Result<Spacing, cannonpile::Error> {
    let factor = match packing.pile().dimension() {
        Dimension::Two => 4,
        Dimension::Three => 3,
    };
    let factor = BigRational::from_integer(factor.into());
    Spacing::from_square(packing.inclination().sin2() * factor)
}

/// Returns the difference of two coordinates of one axis, rounded once.
pub(super) fn difference(to: &Surd, from: &Surd) -> Result<f64, cannonpile::Error> {
    let apart = to.checked_add(&from.scaled(&-BigRational::one()));
    let apart = apart.ok_or_else(|| bug("coordinates of one axis are multiples of one root"))?;
    let float = apart.nearest::<f64>();
    float.ok_or_else(|| cannonpile::Error::overflow("a position", "f64"))
}

/// Returns a number, correctly rounded to `f64`.
pub(super) fn nearest(number: &Surd, quantity: &'static str) -> Result<f64, Error> {
    let float = number.nearest::<f64>();
    float.ok_or_else(|| cannonpile::Error::overflow(quantity, "f64").into())
}

fn rounded([x, y, z]: &[Surd; 3]) -> Result<Vector, Error> {
    let nearest = |part| nearest(part, "a coordinate");
    Ok([nearest(x)?, nearest(y)?, nearest(z)?])
}
