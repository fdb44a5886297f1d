//! The forces of a pile, in any scalar and in pile units.
//!
//! Pile units measure contact forces in f₀ = mg/(W cosθ). This is mg/(3 cosθ) on an equilateral base and mg/(2 cosθ)
//! for discs. On the floor, normal forces are in mg, shears along x in mg·tanθ, and shears along y in 2cosφ·mg·tanθ. In
//! these units every force is rational and depends on neither spacing nor mass. [`Packing`](crate::Packing) returns
//! forces in SI units.

mod base;
mod contacts;
mod ends;
mod layers;
mod stress;
mod sums;
mod terms;
mod walk;

pub use base::FloorForce;
pub use contacts::ContactForce;
pub(crate) use layers::Units;
pub(crate) use layers::check_lengths;
pub use layers::{Integers, Layer, Layers, Nearest, Output};
pub use walk::{Answers, Contacts, FloorForces};

use alloc::vec::Vec;

use num_rational::BigRational;

use crate::each::Each;
use crate::engine::{
    Counters, LineForces, LineSelection, Meter, Method, Plan, Quantity, Question, SphereForces,
    to_scalar, to_scalars,
};
use crate::formula;
use crate::geometry::{Load, Vector, position};
use crate::lattice::{Direction, Site, count};
use crate::scalar::{Algebra, Ring};
use crate::shape::RunLayers;
use crate::{Error, Pile};

use terms::{horizontal, of_direction};

/// The forces of a pile in the scalar `T`, made by [`Pile::forces`].
///
/// | to get | use |
/// |---|---|
/// | the force of one contact | [`contact`](Self::contact) |
/// | the force of one sphere on the floor | [`on_floor`](Self::on_floor) |
/// | contact forces, one by one | [`contacts`](Self::contacts) |
/// | forces on the floor, one by one | [`base`](Self::base) |
/// | the stress of a sphere | [`stress`](Self::stress), [`stresses`](Self::stresses) |
/// | many forces into slices, fast | [`layers`](Self::layers) |
/// | any of these in newtons and metres | a [`Packing`](crate::Packing) |
///
/// A plan selects the method ([`Pile::plan`]). In a straight stacking, a closed form gives each force in O(1), whatever
/// the number of layers. In other stackings, a single force is computed along the lines above its sphere, and many
/// forces by a layer-by-layer sweep.
///
/// Exact scalars give exact results. With rounded scalars, contact forces and normal forces of a straight stacking of equal
/// spheres have errors of a few units in the last place. A weight w is added as 1 + (w − 1), in f₀, so a small one loses
/// digits. Shears, resultants and positions are differences. Their errors are a few
/// units in the last place of the largest term, max(N)·f₀, so all digits may be lost where the terms cancel. A sign
/// change also subtracts, but it does not amplify the sum of squared errors over a layer. [`Layer::error_bound`] bounds
/// the error of a force. A value that the scalar cannot hold is [`Error::Overflow`], never a wrong value.
///
/// Internally, the formulas run on numerators of the scalar. For rationals these are integers over a denominator known
/// in advance, and each result is reduced once at the end.
///
/// # Examples
/// ```
/// use cannonpile::lattice::Site;
/// use cannonpile::{Forces, Pile};
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(10)?;
/// let forces: Forces<BigRational> = pile.forces();
/// assert_eq!(forces.on_floor(Site { i: 5, j: 2, k: 9 })?.shear_y.to_string(), "1/2");
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Forces<'p, T: Algebra> {
    /// The given pile. The pile in `lines` also has the rational loads of these forces.
    pile: &'p Pile,
    lines: LineForces<'p, T>,
    /// The requested method, or `None` for the cheapest.
    method: Option<Method>,
    meter: Meter<'p>,
}

impl Pile {
    /// Returns the forces of the pile, in the scalar `T`.
    ///
    /// Name the scalar, as in `pile.forces::<f64>()`, or annotate the type of a result. Otherwise rustc reports E0283,
    /// "type annotations needed".
    ///
    /// # Examples
    /// One pile in two scalars:
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::{Direction, Site};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let site = Site { i: 1, j: 2, k: 5 };
    /// let exact: BigRational = pile.forces().contact(site, Direction::Alpha)?;
    /// let float: f64 = pile.forces().contact(site, Direction::Alpha)?;
    /// assert_eq!((exact.to_string().as_str(), float), ("3", 3.0));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn forces<T: Algebra>(&self) -> Forces<'_, T> {
        Forces {
            pile: self,
            lines: LineForces::new(self),
            method: None,
            meter: Meter::NONE,
        }
    }

    /// Returns the method that answers `question` exactly, with an upper bound on its cost.
    ///
    /// Straight stackings use closed forms. In other stackings, a single sphere uses the lines above it, and a layer or
    /// more uses a sweep. If the sweep does not fit in memory, the rows are computed one by one. A
    /// [`Counters`](crate::Counters) counts the actual work.
    ///
    /// # Errors
    /// [`Error::SiteOutside`] or [`Error::LayerOutside`]; [`Error::NotOnFloor`] for forces on the floor of spheres
    /// above the bottom layer; [`Error::TooLarge`] if a layer does not fit in memory and depends on too many spheres at
    /// the sign changes above it; [`Error::NoSuchMethod`] if the requested method does not apply.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Method, Pile, Question};
    ///
    /// let pile = Pile::under(Region::SITE, "+-+".parse()?)?;
    /// let plan = pile.plan(Selection::Base)?;
    /// assert_eq!((plan.method, plan.rows), (Method::Sweep, 12_u32.into()));
    ///
    /// let by_trees = Question::from(Selection::Base).with_method(Method::Tree);
    /// assert_eq!(pile.plan(by_trees)?.method, Method::Tree);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn plan(&self, question: impl Into<Question>) -> Result<Plan, Error> {
        let Question {
            part,
            quantity,
            method,
        } = question.into();
        let rows = match quantity {
            Quantity::Contacts => self.rows(part)?.off_the_floor(),
            Quantity::Floor => self.rows(part)?,
        };
        LineForces::<BigRational>::new(self).plan(&rows, quantity, method)
    }
}

impl<'p, T: Algebra> Forces<'p, T> {
    /// Returns the forces with a further load on one sphere, in the scalar `T`: a value of `T` for a vertical load in mg,
    /// or a [`Load`] of any direction and sign.
    ///
    /// So a load can be a symbol, or carry a derivative. No verdict depends on these loads.
    ///
    /// # Errors
    /// [`Error::SiteOutside`]; [`Error::OutOfPlane`] for a load on a disc along y.
    ///
    /// # Examples
    /// The force on a contact as a function of a load p on the apex:
    /// ```
    /// use cannonpile::lattice::{Direction, Region, Site};
    /// use cannonpile::scalar::{Polynomial, Symbol};
    /// use cannonpile::Pile;
    ///
    /// let pile = Pile::under(Region::SITE, "+-+".parse()?)?;
    /// let forces = pile.forces::<Polynomial>().with_load(Site::APEX, Polynomial::from(Symbol("p")))?;
    /// let force = forces.contact(Site { i: 0, j: 0, k: 1 }, Direction::Beta)?;
    /// assert_eq!(force.to_string(), "(2 p + 5)/3");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn with_load(self, site: Site, load: impl Into<Load<T>>) -> Result<Self, Error> {
        self.with_loads([(site, load.into())])
    }

    /// Returns the forces with further loads, as [`with_load`](Self::with_load) does, for many loads at once.
    ///
    /// # Errors
    /// As for [`with_load`](Self::with_load).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Direction, Site};
    /// use cannonpile::{Load, Pile};
    ///
    /// let pile = Pile::triangular(3)?.weightless();
    /// let loads = [(Site::APEX, Load::from(1.0)), (Site::new(0, 0, 1), Load::from(2.0))];
    /// let forces = pile.forces::<f64>().with_loads(loads)?;
    /// assert_eq!(forces.contact(Site::new(0, 0, 1), Direction::Alpha)?, 3.0);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn with_loads(
        mut self,
        loads: impl IntoIterator<Item = (Site, Load<T>)>,
    ) -> Result<Self, Error> {
        let check = |(site, load): (Site, Load<T>)| {
            self.pile.check_in_plane("load", &load.y)?;
            Ok((self.pile.shape().check(site)?, load))
        };
        let loads: Result<Vec<_>, Error> = loads.into_iter().map(check).collect();
        self.lines.add_loads(loads?);
        Ok(self)
    }

    /// Returns the forces under gravity that leans further, by the tilt (x, y) in the scalar `T`. The units are those of
    /// [`Pile::with_tilt`].
    ///
    /// # Errors
    /// [`Error::OutOfPlane`] for discs with y ≠ 0.
    ///
    /// # Examples
    /// Every force is an affine function of the tilt:
    /// ```
    /// use cannonpile::lattice::{Direction, Site};
    /// use cannonpile::scalar::{Polynomial, Symbol};
    /// use cannonpile::Pile;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let tilt = ["x", "y"].map(|name| Polynomial::from(Symbol(name)));
    /// let forces = pile.forces::<Polynomial>().with_tilt(tilt)?;
    /// let force = forces.contact(Site { i: 0, j: 0, k: 4 }, Direction::Alpha)?;
    /// assert_eq!(force.to_string(), "-5 x - 15 y + 5");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn with_tilt(mut self, tilt: [T; 2]) -> Result<Self, Error> {
        self.pile.check_in_plane("tilt", &tilt[1])?;
        self.lines.add_tilt(tilt);
        Ok(self)
    }

    /// Counts the work of every query with `counters`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Counters, Pile};
    ///
    /// let (pile, counters) = (Pile::triangular(4)?, Counters::default());
    /// let forces = pile.forces::<f64>().with_counters(&counters);
    /// assert_eq!(forces.contacts(Selection::All)?.count(), 30);
    /// assert_eq!(counters.to_string(), "10 visited, 0 turned, 0 passes, 30 rows");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn with_counters<'c>(self, counters: &'c Counters) -> Forces<'c, T>
    where
        'p: 'c,
    {
        Forces {
            meter: Meter::of(counters),
            ..self
        }
    }

    /// Selects the method that computes the forces, for a comparison of methods. Exact results do not depend on the
    /// method.
    ///
    /// # Errors
    /// [`Error::NoSuchMethod`] for a closed form of a stacking with sign changes, or for a sweep of discs. A query that
    /// does not fit in memory fails later, when it is made.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Method, Pile};
    ///
    /// let pile = Pile::triangular(10)?;
    /// let forces = pile.forces::<f64>();
    /// let swept = forces.clone().with_method(Method::Sweep)?;
    /// let base = |forces: &cannonpile::Forces<'_, f64>| {
    ///     forces.base(Selection::Base)?.collect::<Result<Vec<_>, _>>()
    /// };
    /// assert_eq!(base(&swept)?, base(&forces)?);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn with_method(self, method: Method) -> Result<Self, Error> {
        self.pile.check_method(method)?;
        Ok(Self {
            method: Some(method),
            ..self
        })
    }

    /// Returns the requested method, or `None` for the cheapest.
    #[must_use]
    pub fn method(&self) -> Option<Method> {
        self.method
    }

    pub(crate) fn meter(&self) -> Meter<'p> {
        self.meter
    }

    /// Returns the pile of these forces.
    #[must_use]
    pub fn pile(&self) -> &'p Pile {
        self.pile
    }

    /// Returns W, the sum of the increments along the three directions: 3 on an equilateral base, 2(1+s) on an
    /// isosceles one, 2 for discs. In the unit mg/W, the vertical force of a contact is a sum of increments.
    ///
    /// # Errors
    /// [`Error::Overflow`] if the scalar cannot hold it.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// assert_eq!(Pile::triangular(10)?.forces::<f64>().increment_sum()?, 3.0);
    /// assert_eq!(Pile::discs(10)?.forces::<f64>().increment_sum()?, 2.0);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn increment_sum(&self) -> Result<T, Error> {
        self.lines.increment_sum()
    }

    /// Returns the forces on `site` from the spheres above, by direction, in f₀. The force is zero where no sphere lies
    /// above.
    ///
    /// Paper, (10): (k−i−j, i, j)·f₀ on an equilateral base.
    ///
    /// # Errors
    /// [`Error::SiteOutside`]; [`Error::Overflow`] if the scalar cannot hold a force.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Site;
    ///
    /// let pile = Pile::triangular(10)?;
    /// assert_eq!(pile.forces::<f64>().from_above(Site { i: 1, j: 2, k: 5 })?, [2.0, 1.0, 2.0]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn from_above(&self, site: Site) -> Result<[T; 3], Error> {
        let site = self.pile.shape().check(site)?;
        self.lines
            .contacts(self.received(site, LineSelection::All)?)
    }

    /// Returns the forces from `site` on the spheres below, by direction, in f₀. The force along γ is zero for discs.
    ///
    /// Paper, (8): where the sign does not change at the sphere, the force below exceeds the force above by one
    /// increment on each line.
    ///
    /// # Errors
    /// [`Error::SiteOutside`]; [`Error::OnFloor`]; [`Error::Overflow`] if the scalar cannot hold a force.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Site;
    ///
    /// let pile = Pile::triangular(10)?;
    /// assert_eq!(pile.forces::<f64>().to_below(Site { i: 1, j: 2, k: 5 })?, [3.0, 2.0, 3.0]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn to_below(&self, site: Site) -> Result<[T; 3], Error> {
        self.lines.contacts(self.transmitted(site)?)
    }

    /// Returns the force of a bottom sphere on the floor.
    ///
    /// In a straight pile under one sphere, the normal force is mg[1 + ((L−1−j) + 2sj)/(2(1+s))]. On an equilateral
    /// base this is mg(L+2)/3 under every sphere (paper, (13)), and the shear is −mg·tanθ/3·((L−1−3j)/2,
    /// √3/2·(L−1−2i−j)) (paper, (14)).
    ///
    /// # Errors
    /// [`Error::SiteOutside`]; [`Error::NotOnFloor`] for a sphere of another layer; [`Error::Overflow`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Site;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let force = pile.forces::<f64>().on_floor(Site { i: 0, j: 0, k: 9 })?;
    /// assert_eq!((force.normal, force.shear_x, force.shear_y), (4.0, -1.5, -1.5));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn on_floor(&self, site: Site) -> Result<FloorForce<T>, Error> {
        let site = self.pile.shape().check(site)?;
        let floor = self.bottom();
        if site.k != floor {
            return Err(Error::NotOnFloor { site, floor });
        }
        self.lines
            .floor(site, &self.received(site, LineSelection::All)?)
    }

    /// Returns the force between the sphere at `site` and the one below it along `direction`, in units of f₀ =
    /// mg/(3 cos θ).
    ///
    /// The force is positive in compression. It is negative if the contact would be tensile, and then the pile is
    /// unstable. The unit is mg/(2(1+s) cos θ) on an isosceles base and mg/(2 cos θ) for discs.
    ///
    /// # Errors
    /// [`Error::SiteOutside`]; [`Error::OnFloor`] for a sphere of the bottom layer;
    /// [`Error::NoSuchDirection`] for γ in a pile of discs; [`Error::Overflow`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::{Direction, Site};
    ///
    /// let pile = Pile::triangular(10)?;
    /// assert_eq!(pile.forces::<f64>().contact(Site::APEX, Direction::Gamma)?, 1.0);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn contact(&self, site: Site, direction: Direction) -> Result<T, Error> {
        let (force, changes) = self.contact_numerator(site, direction)?;
        to_scalar("a contact force", force, &self.lines.scale(changes))
    }

    /// Returns the contact force on the upper sphere as a vector, f·ê, in f₀ and the symbolic basis. The force on the
    /// lower sphere is the opposite vector.
    ///
    /// # Errors
    /// As for [`contact`](Self::contact).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::geometry::Vector;
    /// use cannonpile::lattice::{Direction, Site};
    ///
    /// let pile = Pile::triangular(10)?;
    /// let force = pile.forces::<f64>().contact_vector(Site { i: 1, j: 0, k: 1 }, Direction::Beta)?;
    /// assert_eq!(force, Vector { x: 1.0, y: -1.0, z: -2.0 });
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn contact_vector(&self, site: Site, direction: Direction) -> Result<Vector<T>, Error> {
        let (force, changes) = self.contact_numerator(site, direction)?;
        let along = of_direction(self.lines.directions_below(site.k), direction);
        self.lines
            .vector("a contact force", along.scaled(&force), changes)
    }

    /// Returns the direction of the contact between `site` and the sphere below it, in the symbolic basis. It points
    /// from the lower sphere to the upper one. It is ê under a + step, and ê turned by half a turn about the vertical
    /// under a − step.
    ///
    /// # Errors
    /// As for [`contact`](Self::contact).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::geometry::Vector;
    /// use cannonpile::lattice::{Direction, Region, Site};
    ///
    /// let pile = Pile::under(Region::SITE, "-".parse()?)?;
    /// let a = pile.forces::<f64>().contact_direction(Site::APEX, Direction::Alpha)?;
    /// assert_eq!(a, Vector { x: -0.5, y: -0.5, z: -1.0 });
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn contact_direction(&self, site: Site, direction: Direction) -> Result<Vector<T>, Error> {
        let along = self
            .contact_direction_numerators(site, direction)?
            .into_array();
        let [x, y, z] = to_scalars("a direction", along, self.direction_scale())?;
        Ok(Vector { x, y, z })
    }

    /// Returns a contact force as a numerator, and the number of sign changes down to the contact.
    fn contact_numerator(
        &self,
        site: Site,
        direction: Direction,
    ) -> Result<(T::Numerator, usize), Error> {
        let run = self.check_contact(site, direction)?;
        if run.index == 0 && self.method != Some(Method::Sweep) {
            self.meter.visit(1);
            return Ok((self.lines.closed(&run, site, direction), 0));
        }
        // A sign change at the sphere mixes its three lines.
        let wanted = if run.index > 0 && run.from == site.k {
            LineSelection::All
        } else {
            LineSelection::One(direction)
        };
        let above = self.received(site, wanted)?;
        let SphereForces { forces, changes } = self.lines.to_below(site, above, self.meter);
        Ok((of_direction(forces, direction), changes))
    }

    /// Returns the forces on a sphere from above, along the wanted lines.
    fn received(&self, site: Site, wanted: LineSelection) -> Result<SphereForces<T>, Error> {
        self.lines.received((site, wanted), self.method, self.meter)
    }

    /// Returns the forces of a sphere on the spheres below.
    fn transmitted(&self, site: Site) -> Result<SphereForces<T>, Error> {
        self.check_off_the_floor(site)?;
        let above = self.received(site, LineSelection::All)?;
        Ok(self.lines.to_below(site, above, self.meter))
    }

    /// Returns the run of the step below the site, or an error unless the pile has the site above its bottom layer.
    #[inline]
    fn check_off_the_floor(&self, site: Site) -> Result<RunLayers, Error> {
        let shape = self.lines.shape;
        let Site { k, .. } = shape.check(site)?;
        shape.run_below(k).ok_or(Error::OnFloor { site })
    }

    /// Returns the run of the step below the site, or an error unless a sphere lies below it in `direction`.
    #[inline]
    fn check_contact(&self, site: Site, direction: Direction) -> Result<RunLayers, Error> {
        let run = self.check_off_the_floor(site)?;
        if self
            .lines
            .shape
            .dimension()
            .directions()
            .contains(&direction)
        {
            Ok(run)
        } else {
            Err(Error::NoSuchDirection { direction })
        }
    }

    /// Returns the unit vector ê of a direction under + steps, in the symbolic basis.
    ///
    /// # Errors
    /// [`Error::Overflow`] if the scalar cannot hold it.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::geometry::Vector;
    /// use cannonpile::lattice::Direction;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let a = pile.forces::<f64>().direction(Direction::Alpha)?;
    /// assert_eq!(a, Vector { x: 0.5, y: 0.5, z: -1.0 });
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn direction(&self, direction: Direction) -> Result<Vector<T>, Error> {
        let numerators = of_direction(self.lines.directions.clone(), direction).into_array();
        let [x, y, z] = to_scalars("a direction", numerators, &self.lines.direction_scale)?;
        Ok(Vector { x, y, z })
    }

    /// Returns the sum of the forces from above on `site`, in f₀ and the symbolic basis.
    ///
    /// On an equilateral base the sum is the central force mg/(6R cosθ)·r, see [`paper`](crate::paper#closed-form).
    ///
    /// # Errors
    /// [`Error::SiteOutside`], [`Error::Overflow`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Site;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let (forces, site) = (pile.forces::<f64>(), Site { i: 1, j: 2, k: 5 });
    /// assert_eq!(forces.resultant_above(site)?, forces.position(site)?);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn resultant_above(&self, site: Site) -> Result<Vector<T>, Error> {
        let site = self.pile.shape().check(site)?;
        let SphereForces { forces, changes } = self.received(site, LineSelection::All)?;
        let force = formula::resultant(&forces, &self.lines.directions_above(site.k));
        self.lines.vector("a resultant force", force, changes)
    }

    /// Returns the position of a sphere, in 2R and the symbolic basis, with z down from the top layer.
    ///
    /// The horizontal origin is site (0, 0) of the top layer, which is the apex in a pile under one sphere. In a pile
    /// grown from a base, it is site (0, 0) of the base. This site need not be occupied.
    ///
    /// # Errors
    /// [`Error::SiteOutside`], [`Error::Overflow`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::geometry::Vector;
    /// use cannonpile::lattice::Site;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let r = pile.forces::<f64>().position(Site { i: 1, j: 2, k: 5 })?;
    /// assert_eq!(r, Vector { x: 0.5, y: -0.5, z: 5.0 });
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn position(&self, site: Site) -> Result<Vector<T>, Error> {
        let r = self.position_numerators(site)?.into_array();
        let [x, y, z] = to_scalars("a position", r, self.direction_scale())?;
        Ok(Vector { x, y, z })
    }

    /// Returns [`position`](Self::position) as numerators over the scale of directions.
    pub(crate) fn position_numerators(&self, site: Site) -> Result<Vector<T::Numerator>, Error> {
        let Site { i, j, k } = self.pile.shape().check(site)?;
        let across = self.pile.shape().shift_from_origin(k);
        let counts = count::above(&i, &j, &across).each(T::Numerator::from_integer);
        let z = T::Numerator::from_integer(k) * self.direction_scale();
        Ok(Vector {
            z,
            ..position(&counts, &self.lines.directions)
        })
    }

    /// Returns [`contact_direction`](Self::contact_direction) as numerators over the scale of directions.
    pub(crate) fn contact_direction_numerators(
        &self,
        site: Site,
        direction: Direction,
    ) -> Result<Vector<T::Numerator>, Error> {
        self.check_contact(site, direction)?;
        Ok(of_direction(self.lines.directions_below(site.k), direction))
    }

    /// Returns the denominator of the numerators of directions and positions.
    pub(crate) fn direction_scale(&self) -> &T::Numerator {
        &self.lines.direction_scale
    }

    /// Returns the sum of all forces on a sphere, its weight included, in f₀. It is the zero vector in an exact scalar.
    ///
    /// A bottom sphere is refused, because the floor balances the forces on it.
    ///
    /// # Errors
    /// [`Error::SiteOutside`], [`Error::OnFloor`], [`Error::Overflow`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::geometry::Vector;
    /// use cannonpile::lattice::Site;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10_i128.pow(36))?;
    /// let site = Site { i: 123, j: 10_i128.pow(20), k: 10_i128.pow(35) };
    /// assert_eq!(pile.forces::<BigRational>().unbalanced(site)?, Vector::zero());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn unbalanced(&self, site: Site) -> Result<Vector<T>, Error> {
        self.check_off_the_floor(site)?;
        let above = self.received(site, LineSelection::All)?;
        let below = self.lines.to_below(site, above.clone(), self.meter);
        let (lines, changes) = (&self.lines, below.changes);
        let rescaled = |force| lines.scaled(force, changes.saturating_sub(above.changes));
        let received = above.forces.each(rescaled);
        let load = lines.load_vector(site, changes);
        let unbalanced = formula::unbalanced(
            &below.forces,
            &lines.directions_below(site.k),
            &received,
            &lines.directions_above(site.k),
            &load.z,
        ) + &horizontal(&load);
        lines.vector("a resultant force", unbalanced, changes)
    }

    /// Returns the index of the bottom layer.
    fn bottom(&self) -> i128 {
        self.pile.layers() - 1
    }
}
