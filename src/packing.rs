//! A pile with radius, mass and gravity: exact results in SI units.

mod basis;
mod places;
mod rows;

pub use basis::SiBasis;
pub use places::Places;
pub use rows::PackedContact;

use alloc::vec::Vec;

use num_rational::BigRational;
use num_traits::One;

use crate::engine::{Counters, Method};
use crate::error::positive;
use crate::geometry::{Inclination, LayerGap, Spacing, Vector, square_across};
use crate::lattice::{Direction, Site};
use crate::scalar::{Surd, product};
use crate::{Error, FloorForce, Forces, Pile};

/// A pile whose spheres have a spacing, a radius and a mass, under a given gravity.
///
/// [`Packing::new`] checks that the spheres do not overlap. Every result is an exact [`Surd`], and [`Surd::nearest`]
/// rounds it correctly.
///
/// The axes x and y are those of the paper. The axis z points **up**, and z = 0 is the height of the centres of the
/// bottom layer. The origin of x and y is site (0, 0) of the top layer, which is the apex in a pile under one sphere.
/// In a pile grown from a base, it is site (0, 0) of the base.
///
/// Only z is reversed relative to the paper, so the frame has the opposite handedness. The reflection α ↔ β, y → −y
/// restores the handedness, and leaves all forces unchanged.
///
/// Lengths are in the unit of the radius, and forces in the unit of mass times gravity. With kg, m and m/s², forces are
/// in N.
///
/// # Examples
/// ```
/// use cannonpile::geometry::Spacing;
/// use cannonpile::lattice::{Direction, Site};
/// use cannonpile::{Packing, Pile, ratio};
///
/// let pile = Pile::triangular(10)?;
/// let packing = Packing::new(&pile, &Spacing::new(ratio!(6/5))?)?.with_mass(ratio!(1/10))?;
///
/// let force = packing.contact(Site::APEX, Direction::Alpha)?;
/// assert_eq!(force.to_string(), "1/78*sqrt(13)");
/// assert_eq!(force.nearest::<f64>(), Some(0.046225016352102424));
///
/// let [x, y, z] = packing.position(Site::APEX)?;
/// assert!(x == 0.0 && y == 0.0);
/// assert_eq!(z.to_string(), "18/5*sqrt(13)");
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Packing<'p> {
    forces: Forces<'p, BigRational>,
    inclination: Inclination,
    touching: Vec<LayerGap>,
    roots: Roots,
    /// W.
    increment_sum: BigRational,
    radius: BigRational,
    mass: BigRational,
    gravity: BigRational,
    /// mg/W, a factor of every force.
    weight_per_sum: BigRational,
    /// f₀.
    unit_force: Surd,
}

impl<'p> Packing<'p> {
    /// Returns the packing with R = m = g = 1.
    ///
    /// # Errors
    /// [`Error::Overlap`], [`Error::TooFlat`] or [`Error::NoSpacing`] if the spacing does not suit the spheres;
    /// [`Error::NotTouching`] if the pile has horizontal forces and neighbours in a layer do not touch.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Error, Packing, Pile, ratio};
    ///
    /// let pile = Pile::triangular(10)?;
    /// assert!(Packing::new(&pile, &Spacing::new(ratio!(6/5))?).is_ok());
    /// let refused = Packing::new(&pile, &Spacing::new(ratio!(9/10))?);
    /// assert!(matches!(refused, Err(Error::Overlap { .. })));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn new(pile: &'p Pile, spacing: &Spacing) -> Result<Self, Error> {
        let touching = pile.clearance().check(spacing)?;
        if pile.horizontal_forces().len() > 0 && !touching.contains(&LayerGap { layers: 0 }) {
            return Err(Error::NotTouching {
                spacing: spacing.clone(),
            });
        }
        let inclination = Inclination::new(spacing, pile.dimension())?;
        let forces = pile.forces::<BigRational>();
        let increment_sum = forces.increment_sum()?;
        let weight_per_sum = increment_sum.recip();
        let roots = Roots::new(&inclination, pile.sin_phi())?;
        Ok(Self {
            unit_force: roots.secant.scaled(&weight_per_sum),
            weight_per_sum,
            increment_sum,
            forces,
            touching,
            roots,
            inclination,
            radius: BigRational::one(),
            mass: BigRational::one(),
            gravity: BigRational::one(),
        })
    }
}

impl<'p> Packing<'p> {
    /// Counts the work of every query with `counters`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Counters, Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let counters = Counters::default();
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let packing = Packing::new(&pile, &spacing)?.with_counters(&counters);
    /// assert_eq!(packing.base(Selection::Base)?.count(), 55);
    /// assert_eq!(counters.rows(), 55);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn with_counters<'c>(self, counters: &'c Counters) -> Packing<'c>
    where
        'p: 'c,
    {
        Packing {
            forces: self.forces.with_counters(counters),
            ..self
        }
    }

    /// Selects the method that computes the forces, for a comparison of methods.
    ///
    /// # Errors
    /// As for [`Forces::with_method`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::lattice::{Direction, Site};
    /// use cannonpile::{Method, Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let swept = packing.clone().with_method(Method::Sweep)?;
    /// let (site, along) = (Site { i: 1, j: 2, k: 5 }, Direction::Alpha);
    /// assert_eq!(swept.contact(site, along)?, packing.contact(site, along)?);
    /// assert_eq!((packing.method(), swept.method()), (None, Some(Method::Sweep)));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn with_method(self, method: Method) -> Result<Self, Error> {
        let forces = self.forces.with_method(method)?;
        Ok(Self { forces, ..self })
    }

    /// Returns the packing with spheres of this radius.
    ///
    /// # Errors
    /// [`Error::NotPositive`] unless the radius is positive.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::lattice::Site;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let half = BigRational::new(1.into(), 2.into());
    /// let [_, _, z] = Packing::new(&pile, &spacing)?.with_radius(half)?.position(Site::APEX)?;
    /// assert_eq!(z.to_string(), "9/5*sqrt(13)");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn with_radius(self, radius: BigRational) -> Result<Self, Error> {
        let radius = positive("radius", radius)?;
        Ok(Self { radius, ..self })
    }

    /// Returns the packing with spheres of this mass.
    ///
    /// # Errors
    /// [`Error::NotPositive`] unless the mass is positive.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let packing = Packing::new(&pile, &spacing)?.with_mass(BigRational::new(1.into(), 10.into()))?;
    /// assert_eq!(packing.unit_force().to_string(), "1/78*sqrt(13)");
    /// assert!(packing.with_mass(BigRational::from_integer(0.into())).is_err());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn with_mass(self, mass: BigRational) -> Result<Self, Error> {
        let mass = positive("mass", mass)?;
        Ok(Self { mass, ..self }.weighed())
    }

    /// Returns the packing with this gravity.
    ///
    /// # Errors
    /// [`Error::NotPositive`] unless the gravity is positive.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let gravity = BigRational::new(981.into(), 100.into());
    /// let packing = Packing::new(&pile, &spacing)?.with_gravity(gravity)?;
    /// assert_eq!(packing.sphere_weight().to_string(), "981/100");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn with_gravity(self, gravity: BigRational) -> Result<Self, Error> {
        let gravity = positive("gravity", gravity)?;
        Ok(Self { gravity, ..self }.weighed())
    }

    /// Returns the requested method, or `None` for the cheapest.
    #[must_use]
    pub fn method(&self) -> Option<Method> {
        self.forces.method()
    }

    /// Returns the exact forces in pile units.
    #[must_use]
    pub fn forces(&self) -> &Forces<'p, BigRational> {
        &self.forces
    }

    /// Returns the pile of this packing.
    #[must_use]
    pub fn pile(&self) -> &'p Pile {
        self.forces.pile()
    }

    /// Returns the radius R.
    #[must_use]
    pub fn radius(&self) -> &BigRational {
        &self.radius
    }

    /// Returns the mass of a sphere. It is m, unless [`Pile::with_weight`] changed the weight of the sphere.
    ///
    /// # Errors
    /// [`Error::SiteOutside`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::lattice::Site;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?.with_weight(Site::APEX, BigRational::from_integer(5.into()))?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let packing = Packing::new(&pile, &spacing)?.with_mass(BigRational::new(1.into(), 10.into()))?;
    /// assert_eq!(packing.mass_of(Site::APEX)?.to_string(), "1/2");
    /// assert_eq!(packing.mass_of(Site { i: 0, j: 0, k: 1 })?.to_string(), "1/10");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn mass_of(&self, site: Site) -> Result<BigRational, Error> {
        Ok(self.pile().sphere_weight(site)? * &self.mass)
    }

    /// Returns the mass m of an ordinary sphere.
    #[must_use]
    pub fn mass(&self) -> &BigRational {
        &self.mass
    }

    /// Returns the gravity g.
    #[must_use]
    pub fn gravity(&self) -> &BigRational {
        &self.gravity
    }

    /// Returns the angle θ between the contacts and the vertical.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let packing = Packing::new(&pile, &spacing)?;
    /// assert_eq!(packing.inclination().cos().to_string(), "1/5*sqrt(13)");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn inclination(&self) -> &Inclination {
        &self.inclination
    }

    /// Returns the pairs of spheres that touch in addition to the contacts α, β, γ. The forces between them are
    /// unknown. Strictly between the bounds of [`Clearance`](crate::geometry::Clearance) no such pairs touch.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::from_integer(1.into()))?;
    /// let packing = Packing::new(&pile, &spacing)?;
    /// assert_eq!(packing.touching()[0].to_string(), "in one layer");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn touching(&self) -> &[LayerGap] {
        &self.touching
    }

    /// Returns the weight mg of an ordinary sphere.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let packing = Packing::new(&pile, &spacing)?
    ///     .with_mass(BigRational::new(1.into(), 2.into()))?
    ///     .with_gravity(BigRational::new(49.into(), 5.into()))?;
    /// assert_eq!(packing.sphere_weight().to_string(), "49/10");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn sphere_weight(&self) -> BigRational {
        &self.mass * &self.gravity
    }

    /// Returns the unit of contact forces, f₀ = mg/(W cosθ). It is mg/(3 cosθ) on an equilateral base.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let packing = Packing::new(&pile, &spacing)?;
    /// assert_eq!(packing.unit_force().to_string(), "5/39*sqrt(13)");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn unit_force(&self) -> Surd {
        self.unit_force.clone()
    }

    /// Returns the constant of the central force, f₀/(2R). It is mg/(6R cosθ) on an equilateral base.
    ///
    /// On an equilateral base, the three forces from above on a sphere sum to this constant times the position from the
    /// apex ([`paper`](crate::paper#closed-form)). On other bases the sum is not a central force.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let packing = Packing::new(&pile, &spacing)?;
    /// assert_eq!(packing.central_constant().to_string(), "5/78*sqrt(13)");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn central_constant(&self) -> Surd {
        self.unit_force.scaled(&self.diameter().recip())
    }

    /// Returns the force between the sphere at `site` and the one below it along `direction`. The force is positive in
    /// compression. It is negative if the contact would be tensile.
    ///
    /// # Errors
    /// As for [`Forces::contact`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::lattice::{Direction, Site};
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let site = Site { i: 1, j: 2, k: 5 };
    /// let force = Packing::new(&pile, &spacing)?.contact(site, Direction::Alpha)?;
    /// assert_eq!(force.to_string(), "5/13*sqrt(13)");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn contact(&self, site: Site, direction: Direction) -> Result<Surd, Error> {
        Ok(self.magnitude(&self.forces.contact(site, direction)?))
    }

    /// Returns the contact force on the upper sphere as a vector (x, y, z), with z up.
    ///
    /// # Errors
    /// As for [`Forces::contact`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::lattice::{Direction, Site};
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let [x, _, z] = Packing::new(&pile, &spacing)?.contact_vector(Site::APEX, Direction::Gamma)?;
    /// assert_eq!((x.to_string(), z.to_string()), ("-2/39*sqrt(39)".into(), "1/3".into()));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn contact_vector(&self, site: Site, direction: Direction) -> Result<[Surd; 3], Error> {
        let multiple = self.forces.contact(site, direction)?;
        self.vector(site, direction, &multiple)
    }

    /// Returns the point where `site` touches the sphere below it, halfway between the centres.
    ///
    /// # Errors
    /// As for [`Forces::contact`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::lattice::{Direction, Site};
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let [x, y, z] = Packing::new(&pile, &spacing)?.contact_point(Site::APEX, Direction::Gamma)?;
    /// assert_eq!((x.to_string(), z.to_string()), ("2/5*sqrt(3)".into(), "17/5*sqrt(13)".into()));
    /// assert!(y == 0.0);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn contact_point(&self, site: Site, direction: Direction) -> Result<[Surd; 3], Error> {
        let point = self.point(site, direction)?;
        Ok(on_basis(self.roots.lengths(), &point, &self.diameter()))
    }

    /// Returns the centre of a sphere.
    ///
    /// # Errors
    /// [`Error::SiteOutside`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::lattice::Site;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let [x, y, z] = Packing::new(&pile, &spacing)?.position(Site { i: 0, j: 0, k: 9 })?;
    /// assert_eq!((x.to_string(), y.to_string()), ("-18/5*sqrt(3)".into(), "-54/5".into()));
    /// assert!(z == 0.0);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn position(&self, site: Site) -> Result<[Surd; 3], Error> {
        Ok(on_basis(
            self.roots.lengths(),
            &self.centre(site)?,
            &self.diameter(),
        ))
    }

    /// Returns the force of a bottom sphere on the floor: normal downwards, shear along x and y.
    ///
    /// # Errors
    /// As for [`Forces::on_floor`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::lattice::Site;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let force = Packing::new(&pile, &spacing)?.on_floor(Site { i: 0, j: 0, k: 9 })?;
    /// assert_eq!(force.normal.to_string(), "4");
    /// assert_eq!(force.shear_x.to_string(), "-3/13*sqrt(39)");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn on_floor(&self, site: Site) -> Result<FloorForce<Surd>, Error> {
        Ok(self.floor_force_in_si(self.forces.on_floor(site)?))
    }

    /// Returns a force on the floor in SI units, from its multiples of mg and mg·tanθ.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::lattice::Site;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let site = Site { i: 0, j: 0, k: 9 };
    /// let multiples = packing.forces().on_floor(site)?;
    /// assert_eq!(packing.floor_force_in_si(multiples), packing.on_floor(site)?);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn floor_force_in_si(&self, force: FloorForce<BigRational>) -> FloorForce<Surd> {
        let site = force.site;
        let force = Vector {
            x: force.shear_x,
            y: force.shear_y,
            z: force.normal,
        };
        let [shear_x, shear_y, normal] =
            on_basis(self.roots.forces(), &force, &self.sphere_weight());
        FloorForce {
            site,
            normal,
            shear_x,
            shear_y,
        }
    }

    /// Returns the stress of a sphere times its volume V = 4πR³/3, in N·m: xx, yy, zz, xy, xz, yz, positive in
    /// compression. Divide by V for the stress in Pa. [`Forces::stress`] has the definition.
    ///
    /// # Errors
    /// As for [`Forces::stress`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Site;
    /// use cannonpile::{Packing, Pile, ratio};
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?.with_radius(ratio!(1/100))?;
    /// let [xx, _, zz, ..] = packing.stress(Site::APEX)?;
    /// assert_eq!((xx.to_string(), zz.to_string()), ("3/3250*sqrt(13)".into(), "1/500*sqrt(13)".into()));
    /// let volume = 4e-6 / 3.0 * core::f64::consts::PI;
    /// let pressure = (2.0 * xx.to_f64() + zz.to_f64()) / volume / 3.0;
    /// assert!((pressure - 1103.5).abs() < 0.1);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn stress(&self, site: Site) -> Result<[Surd; 6], Error> {
        Ok(self.stress_in_si(&self.forces.stress(site)?))
    }

    /// Returns a stress times volume in N·m, from its multiples in [`Forces::stress`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::triangular(3)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?;
    /// let stresses = packing.forces().stresses(Selection::All)?;
    /// for (stress, site) in stresses.zip(pile.sites(Selection::All)?) {
    ///     assert_eq!(packing.stress_in_si(&stress?), packing.stress(site)?);
    /// }
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn stress_in_si(&self, stress: &[BigRational; 6]) -> [Surd; 6] {
        let unit = self.sphere_weight() * &self.radius;
        let roots = &self.roots.stress;
        core::array::from_fn(|n| roots[n].scaled(&product(&stress[n], &unit)))
    }

    /// Returns a contact force in SI units, from its multiple of f₀.
    pub(crate) fn magnitude(&self, multiple: &BigRational) -> Surd {
        self.unit_force.scaled(multiple)
    }

    /// Returns a contact force as a vector on the upper sphere, from its multiple of f₀.
    pub(crate) fn vector(
        &self,
        site: Site,
        direction: Direction,
        multiple: &BigRational,
    ) -> Result<[Surd; 3], Error> {
        let along = upwards(self.forces.contact_direction(site, direction)?);
        let unit = product(multiple, &self.weight_per_sum);
        Ok(on_basis(self.roots.forces(), &along, &unit))
    }

    /// Returns the centre of a sphere, in 2R and the symbolic basis, with z up from the bottom layer.
    fn centre(&self, site: Site) -> Result<Vector<BigRational>, Error> {
        let mut centre = upwards(self.forces.position(site)?);
        centre.z += BigRational::from_integer((self.pile().layers() - 1).into());
        Ok(centre)
    }

    fn diameter(&self) -> BigRational {
        &self.radius + &self.radius
    }

    /// Returns the packing with forces that match its mass and gravity.
    fn weighed(mut self) -> Self {
        self.weight_per_sum = self.sphere_weight() / &self.increment_sum;
        self.unit_force = self.roots.secant.scaled(&self.weight_per_sum);
        self
    }
}

/// The irrational factors of results, from the geometry.
#[derive(Clone, Debug)]
struct Roots {
    /// 1/cosθ.
    secant: Surd,
    /// (sinθ, 2cosφ·sinθ, cosθ): the symbolic basis.
    lengths: [Surd; 3],
    /// (tanθ, 2cosφ·tanθ, 1): the symbolic basis over cosθ.
    forces: [Surd; 3],
    /// The units of [`Forces::stress`], over mgR.
    stress: [Surd; 6],
}

impl Roots {
    fn new(inclination: &Inclination, sin_phi: &BigRational) -> Result<Self, Error> {
        let across = Surd::sqrt(square_across(sin_phi))?;
        let (sin, cos, tan) = (inclination.sin(), inclination.cos(), inclination.tan());
        let (y, xx) = (sin.clone() * &across, sin.clone() * &tan);
        let xy = xx.clone() * &across;
        Ok(Self {
            secant: Surd::sqrt(inclination.cos2().recip())?,
            stress: [xx.clone(), xx, cos.clone(), xy, sin.clone(), y.clone()],
            lengths: [sin, y, cos],
            forces: [tan.clone(), tan * &across, BigRational::one().into()],
        })
    }

    fn lengths(&self) -> [&Surd; 3] {
        self.lengths.each_ref()
    }

    fn forces(&self) -> [&Surd; 3] {
        self.forces.each_ref()
    }
}

/// Returns the vector with the sign of z reversed.
fn upwards(v: Vector<BigRational>) -> Vector<BigRational> {
    Vector { z: -v.z, ..v }
}

/// Returns the components of a vector in the symbolic basis, times a rational unit, as exact numbers.
fn on_basis(basis: [&Surd; 3], v: &Vector<BigRational>, unit: &BigRational) -> [Surd; 3] {
    let [sin, across, cos] = basis;
    [
        sin.scaled(&product(&v.x, unit)),
        across.scaled(&product(&v.y, unit)),
        cos.scaled(&product(&v.z, unit)),
    ]
}
