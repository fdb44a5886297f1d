//! What can be asked of a pile, answered in any scalar, in pile units.
//!
//! Pile units: contact forces in f₀ = mg/(W cosθ), which is mg/(3 cosθ) on an equilateral base and
//! mg/(2 cosθ) for discs; forces on the floor in mg, mg·tanθ and 2cosφ·mg·tanθ. In them every answer
//! is rational, and neither spacing nor mass is needed. [`Packing`](crate::Packing) gives SI.

mod contacts;
mod floor;
mod source;

pub use contacts::ContactForce;
pub use floor::FloorForce;

use num_rational::BigRational;
use num_traits::Zero;

use crate::formula;
use crate::geometry::{Vector, position};
use crate::lattice::Sign;
use crate::lattice::{Direction, Site, count};
use crate::lines::{Above, Lines, Wanted};
use crate::meter::Meter;
use crate::plan::Method;
use crate::scalar::{Algebra, Ring};
use crate::{Error, Pile};

/// The forces of a pile in the scalar `T`: of a straight stacking each by closed form, O(1), whatever the number of
/// layers; of any other from the lines above a sphere, or for many spheres in a sweep ([`Pile::plan`]).
///
/// Exact scalars give exact answers. Of rounded ones, contact forces and normal forces of a straight stacking are a few
/// units in the last place off; shear, resultants and positions are differences, and a few units of the greatest term
/// off, max(N)·f₀, which is all there is where they cancel. A change of sign subtracts too, and amplifies nothing in the
/// sum of squares over a layer: [`Sweep::error_bound`](crate::Sweep::error_bound) says how far a force is off at most. A
/// number that the scalar cannot hold is [`Error::Overflow`], never a wrong value.
///
/// Inside, formulas run on the scalar's [numerators](Algebra::Numerator): for rationals on integers over a
/// denominator known beforehand, reduced once at the end.
///
/// # Examples
/// ```
/// use cannonpile::lattice::Site;
/// use cannonpile::{Pile, Statics};
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(10)?;
/// let statics: Statics<BigRational> = pile.statics();
/// assert_eq!(statics.on_floor(Site { i: 5, j: 2, k: 9 })?.shear_y.to_string(), "1/2");
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Statics<'p, T: Algebra, M = ()> {
    pile: &'p Pile,
    lines: Lines<'p, T>,
    /// W, over `sum_scale`.
    increment_sum: T::Numerator,
    sum_scale: T::Numerator,
    /// Numerators over `direction_scale`.
    directions: [Vector<T::Numerator>; 3],
    direction_scale: T::Numerator,
    /// The method asked for, if it is not the cheapest.
    method: Option<Method>,
    meter: M,
}

impl<'p, T: Algebra> Statics<'p, T> {
    pub(crate) fn new(pile: &'p Pile) -> Self {
        let increments: [BigRational; 3] = pile.increments();
        let ([increment_sum], sum_scale) = T::numerators(&[formula::weight(&increments)]);
        let [a, b, c] = pile.directions().map(Vector::into_array);
        let [ax, ay, az] = a;
        let [bx, by, bz] = b;
        let [cx, cy, cz] = c;
        let components = [ax, ay, az, bx, by, bz, cx, cy, cz];
        let ([ax, ay, az, bx, by, bz, cx, cy, cz], direction_scale) = T::numerators(&components);
        let directions =
            [[ax, ay, az], [bx, by, bz], [cx, cy, cz]].map(|[x, y, z]| Vector { x, y, z });
        Self {
            pile,
            lines: Lines::new(pile),
            increment_sum,
            sum_scale,
            directions,
            direction_scale,
            method: None,
            meter: (),
        }
    }
}

impl<'p, T: Algebra, M: Meter> Statics<'p, T, M> {
    /// The same, telling a meter what every answer takes.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Counters, Pile};
    ///
    /// let (pile, counters) = (Pile::triangular(4)?, Counters::default());
    /// let statics = pile.statics::<f64>().metered(&counters);
    /// assert_eq!(statics.contacts(pile.rows(Selection::All)?).count(), 30);
    /// assert_eq!(counters.to_string(), "10 visited, 0 turned, 0 passes, 0 roots, 30 rows");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn metered<N: Meter>(self, meter: N) -> Statics<'p, T, N> {
        Statics {
            pile: self.pile,
            lines: self.lines,
            increment_sum: self.increment_sum,
            sum_scale: self.sum_scale,
            directions: self.directions,
            direction_scale: self.direction_scale,
            method: self.method,
            meter,
        }
    }

    /// The same by this method, whether it is the cheapest or not: for comparison. Exact answers do not depend on it.
    ///
    /// # Errors
    /// [`Error::NoSuchMethod`] for a closed form of a stacking that is not straight, or a sweep of discs. What does not
    /// fit in memory is an error of the answers.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Method, Pile};
    ///
    /// let pile = Pile::triangular(10)?;
    /// let statics = pile.statics::<f64>();
    /// let swept = statics.clone().by(Method::Sweep)?;
    /// let base = |statics: &cannonpile::Statics<'_, f64>| {
    ///     statics.base(pile.rows(Selection::Base)?).collect::<Result<Vec<_>, _>>()
    /// };
    /// assert_eq!(base(&swept)?, base(&statics)?);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn by(self, method: Method) -> Result<Self, Error> {
        self.pile.check_method(method)?;
        Ok(Self {
            method: Some(method),
            ..self
        })
    }

    /// The method asked for, or `None` for the cheapest.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Method, Pile};
    ///
    /// let pile = Pile::triangular(4)?;
    /// let statics = pile.statics::<f64>();
    /// assert_eq!(statics.method(), None);
    /// assert_eq!(statics.by(Method::Tree)?.method(), Some(Method::Tree));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn method(&self) -> Option<Method> {
        self.method
    }

    pub(crate) fn meter(&self) -> M {
        self.meter
    }

    /// Whether forces are counted where nothing turns: unless another method is asked for.
    fn is_closed(&self) -> bool {
        matches!(self.method, None | Some(Method::Closed))
    }

    /// The pile that is asked.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// let pile = Pile::triangular(10)?;
    /// assert_eq!(pile.statics::<f64>().pile(), &pile);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn pile(&self) -> &'p Pile {
        self.pile
    }

    /// W, the unit mg/W in which a contact's vertical force is a sum of increments: 3 on an equilateral
    /// base, 2(1+s) on an isosceles one, 2 for discs.
    ///
    /// # Errors
    /// [`Error::Overflow`] if the scalar cannot hold it.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// assert_eq!(Pile::triangular(10)?.statics::<f64>().increment_sum()?, 3.0);
    /// assert_eq!(Pile::discs(10)?.statics::<f64>().increment_sum()?, 2.0);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn increment_sum(&self) -> Result<T, Error> {
        edge(
            "the sum of increments",
            self.increment_sum.clone(),
            &self.sum_scale,
        )
    }

    /// The forces from the spheres above on `site`, by direction, in f₀; zero where there is none.
    ///
    /// Paper, eq. (forces2): (k−i−j, i, j)·f₀ on an equilateral base.
    ///
    /// # Errors
    /// [`Error::SiteOutside`]; [`Error::Overflow`] if the scalar cannot hold the answer.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Site;
    ///
    /// let pile = Pile::triangular(10)?;
    /// assert_eq!(pile.statics::<f64>().from_above(Site { i: 1, j: 2, k: 5 })?, [2.0, 1.0, 2.0]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn from_above(&self, site: Site) -> Result<[T; 3], Error> {
        let site = self.pile.shape().check(site)?;
        let (forces, changes) = self.received(site, Wanted::All)?;
        edge_all("a contact force", forces, &self.lines.scale(changes))
    }

    /// The forces from above on a sphere of the pile as numerators, and the changes of sign down to it.
    fn received(&self, site: Site, wanted: Wanted) -> Result<([T::Numerator; 3], usize), Error> {
        if self.method == Some(Method::Sweep) {
            return source::received_by_sweep(self, site);
        }
        if self.is_closed()
            && let Some(forces) = self.lines.closed(site, wanted)
        {
            self.meter.visit(1);
            return Ok((forces, 0));
        }
        let above = match self.above(site.k, &[[site.i, site.j]], wanted) {
            // Too many changes of sign for a tree, perhaps on few enough spheres for a sweep.
            Err(too_large @ Error::TooLarge { .. }) if self.method.is_none() => {
                return source::received_by_sweep(self, site).map_err(|_| too_large);
            }
            above => above?,
        };
        let nothing = || core::array::from_fn(|_| T::Numerator::zero());
        let forces = above.forces.into_iter().next().unwrap_or_else(nothing);
        Ok((forces, above.changes))
    }

    /// The forces to the spheres below as numerators, and the changes of sign down to them.
    fn passed_on(&self, site: Site) -> Result<([T::Numerator; 3], usize), Error> {
        self.off_the_floor(site)?;
        let (above, changes) = self.received(site, Wanted::All)?;
        Ok(self.lines.to_below(site, above, changes, self.meter))
    }

    /// The forces from above on some spheres of layer `k`, from their trees.
    fn above(&self, k: i128, sites: &[[i128; 2]], wanted: Wanted) -> Result<Above<T>, Error> {
        let above = self.lines.forces_above(k, sites, wanted)?;
        self.meter.visit(above.nodes + sites.len());
        self.meter.turn(above.nodes);
        Ok(above)
    }

    /// The site, if the pile has it and it rests on spheres.
    fn off_the_floor(&self, site: Site) -> Result<Site, Error> {
        let site = self.pile.shape().check(site)?;
        if site.k == self.floor() {
            return Err(Error::OnFloor { site });
        }
        Ok(site)
    }

    /// The unit vectors along contacts under steps of one sign, over the scale of directions: under − the
    /// horizontal parts change sign.
    fn directions_under(&self, sign: Sign) -> [Vector<T::Numerator>; 3] {
        let directions = self.directions.clone();
        match sign {
            Sign::Plus => directions,
            Sign::Minus => directions.map(Vector::turned_about_z),
        }
    }

    /// The sign of the step down to layer k; + for the top, where nothing comes from above.
    fn sign_above(&self, k: i128) -> Sign {
        let sign = self.pile.shape().sign_below(k - 1);
        sign.unwrap_or(Sign::Plus)
    }

    /// ê of a direction under + steps, in the symbolic basis.
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
    /// let a = pile.statics::<f64>().direction(Direction::Alpha)?;
    /// assert_eq!(a, Vector { x: 0.5, y: 0.5, z: -1.0 });
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn direction(&self, direction: Direction) -> Result<Vector<T>, Error> {
        let numerators = self.directions[direction.index()].clone().into_array();
        let [x, y, z] = edge_all("a direction", numerators, &self.direction_scale)?;
        Ok(Vector { x, y, z })
    }

    /// The sum of the forces from above on `site`, in f₀ and the symbolic basis.
    ///
    /// On an equilateral base it is the central force mg/(6R cosθ)·r (THEORY §2).
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
    /// let (statics, site) = (pile.statics::<f64>(), Site { i: 1, j: 2, k: 5 });
    /// assert_eq!(statics.resultant_above(site)?, statics.position(site)?);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn resultant_above(&self, site: Site) -> Result<Vector<T>, Error> {
        let site = self.pile.shape().check(site)?;
        let (above, changes) = self.received(site, Wanted::All)?;
        let directions = self.directions_under(self.sign_above(site.k));
        let force = formula::resultant(&above, &directions);
        self.edge_vector("a resultant force", force, changes)
    }

    /// The position of a sphere, in 2R and the symbolic basis, z down from the top layer: from the apex; of a pile grown
    /// from a base, horizontally from site (0, 0) of the base, else from that of the top layer, occupied or not.
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
    /// let r = pile.statics::<f64>().position(Site { i: 1, j: 2, k: 5 })?;
    /// assert_eq!(r, Vector { x: 0.5, y: -0.5, z: 5.0 });
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn position(&self, site: Site) -> Result<Vector<T>, Error> {
        let Site { i, j, k } = self.pile.shape().check(site)?;
        let across = self.pile.shape().shift_from_origin(k);
        let counts = count::above(&i, &j, &across).map(T::Numerator::from_i128);
        let across = position(&counts, &self.directions);
        let z = T::Numerator::from_i128(k) * &self.direction_scale;
        let r = Vector { z, ..across };
        let [x, y, z] = edge_all("a position", r.into_array(), &self.direction_scale)?;
        Ok(Vector { x, y, z })
    }

    /// What is left over of all forces on a sphere, in f₀: the zero vector in an exact scalar. A bottom
    /// sphere is held by the floor, which pushes back with what it receives.
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
    /// assert_eq!(pile.statics::<BigRational>().unbalanced(site)?, Vector::zero());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn unbalanced(&self, site: Site) -> Result<Vector<T>, Error> {
        let (below, changes) = self.passed_on(site)?;
        let (above, changes_above) = self.received(site, Wanted::All)?;
        let sign = self.pile.shape().sign_below(site.k).unwrap_or(Sign::Plus);
        let above = above.map(|force| self.lines.rescaled(force, changes_above, changes));
        let left = formula::unbalanced(
            &below,
            &self.directions_under(sign),
            &above,
            &self.directions_under(self.sign_above(site.k)),
            &self.weight(site, changes),
        );
        self.edge_vector("a resultant force", left, changes)
    }

    /// The layer on the floor.
    fn floor(&self) -> i128 {
        self.pile.layers() - 1
    }

    /// Weight and load of a sphere, in the scale of forces along directions.
    fn weight(&self, site: Site, changes: usize) -> T::Numerator {
        self.lines.weight(site, changes) * &self.direction_scale
    }

    /// A force in f₀, from numerators of increments times directions.
    fn edge_vector(
        &self,
        quantity: &'static str,
        vector: Vector<T::Numerator>,
        changes: usize,
    ) -> Result<Vector<T>, Error> {
        let scale = self.lines.scale(changes) * &self.direction_scale;
        let [x, y, z] = edge_all(quantity, vector.into_array(), &scale)?;
        Ok(Vector { x, y, z })
    }
}

/// `n / d`, unless that is no number.
fn edge<T: Algebra>(quantity: &'static str, n: T::Numerator, d: &T::Numerator) -> Result<T, Error> {
    let value = T::from_ratio(n, d).filter(T::is_defined);
    value.ok_or(Error::Overflow {
        quantity,
        scalar: T::NAME,
    })
}

/// Each of `n` over `d`, unless one of them is no number.
fn edge_all<T: Algebra>(
    quantity: &'static str,
    n: [T::Numerator; 3],
    d: &T::Numerator,
) -> Result<[T; 3], Error> {
    let [x, y, z] = n;
    Ok([
        edge(quantity, x, d)?,
        edge(quantity, y, d)?,
        edge(quantity, z, d)?,
    ])
}
