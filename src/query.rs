//! What can be asked of a pile, answered in any scalar, in pile units.
//!
//! Pile units: contact forces in f₀ = mg/(W cosθ), which is mg/(3 cosθ) on an equilateral base and
//! mg/(2 cosθ) for discs; forces on the floor in mg, mg·tanθ and 2cosφ·mg·tanθ. In them every answer
//! is rational, and neither spacing nor mass is needed. [`Packing`](crate::Packing) gives SI.

use crate::closed_form::{self, Increments};
use crate::geometry::{Vector, position};
use crate::lattice::{Direction, Rows, Site, count};
use crate::scalar::{Algebra, Field};
use crate::{Error, Pile};

/// The forces of a pile in the scalar `T`, each by closed form: O(1), whatever the number of layers.
///
/// Exact scalars give exact answers. Of rounded ones, each answer is a few roundings away from the
/// true one. A number that the scalar cannot hold is [`Error::Overflow`], never a wrong value.
#[derive(Clone, Debug)]
pub struct Statics<'p, T> {
    pile: &'p Pile,
    increments: Increments<T, 3>,
    directions: [Vector<T>; 3],
}

/// The force of contact between a sphere and the one below it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ContactForce<T> {
    /// The upper sphere.
    pub site: Site,
    /// The direction in which the lower one lies.
    pub direction: Direction,
    /// The magnitude, in f₀; positive is push.
    pub force: T,
}

/// The force of one bottom sphere on the floor.
///
/// Paper, eqs. (result-normal) and (result-shear).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FloorForce<T> {
    /// The bottom sphere.
    pub site: Site,
    /// The normal force, in mg, downwards.
    pub normal: T,
    /// The shear along x, in mg·tanθ.
    pub shear_x: T,
    /// The shear along y, in 2cosφ·mg·tanθ (√3·mg·tanθ on an equilateral base); zero for discs.
    pub shear_y: T,
}

impl<'p, T: Algebra> Statics<'p, T> {
    pub(crate) fn new(pile: &'p Pile) -> Self {
        Self {
            pile,
            increments: pile.increments(),
            directions: pile.directions(),
        }
    }

    /// The pile that is asked.
    #[must_use]
    pub fn pile(&self) -> &'p Pile {
        self.pile
    }

    /// W, the unit mg/W in which a contact's vertical force is a sum of increments: 3 on an equilateral
    /// base, 2(1+s) on an isosceles one, 2 for discs.
    #[must_use]
    pub fn increment_sum(&self) -> &T {
        self.increments.sum()
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
        let forces = self.increments.from_above(&self.counts(site)?);
        defined_all("a contact force", forces)
    }

    /// The magnitude of the contact force between `site` and the sphere below it, in f₀.
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
    /// assert_eq!(pile.statics::<f64>().contact(Site::APEX, Direction::Gamma)?, 1.0);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn contact(&self, site: Site, direction: Direction) -> Result<T, Error> {
        let above = self.counts(site)?;
        if site.k == self.floor() {
            return Err(Error::OnFloor { site });
        }
        if !self.pile.dimension().directions().contains(&direction) {
            return Err(Error::NoSuchDirection { direction });
        }
        let [alpha, beta, gamma] = self.increments.to_below(&above);
        defined(
            "a contact force",
            match direction {
                Direction::Alpha => alpha,
                Direction::Beta => beta,
                Direction::Gamma => gamma,
            },
        )
    }

    /// The same force as a vector, on the upper sphere, in f₀ and the symbolic basis: f·ê.
    ///
    /// The lower sphere feels the opposite.
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
    /// let force = pile.statics::<f64>().contact_vector(Site { i: 1, j: 0, k: 1 }, Direction::Beta)?;
    /// assert_eq!(force, Vector { x: 1.0, y: -1.0, z: -2.0 });
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn contact_vector(&self, site: Site, direction: Direction) -> Result<Vector<T>, Error> {
        let force = self.contact(site, direction)?;
        let [x, y, z] = self
            .direction(direction)
            .clone()
            .scaled(&force)
            .into_array();
        let [x, y, z] = defined_all("a contact force", [x, y, z])?;
        Ok(Vector { x, y, z })
    }

    /// ê of a direction, in the symbolic basis.
    #[must_use]
    pub fn direction(&self, direction: Direction) -> &Vector<T> {
        &self.directions[direction.index()]
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
        let above = self.counts(site)?;
        let force = closed_form::resultant_above(&above, &self.increments, &self.directions);
        let [x, y, z] = defined_all("a resultant force", force.into_array())?;
        Ok(Vector { x, y, z })
    }

    /// The position of a sphere from the apex, in 2R and the symbolic basis, z down.
    ///
    /// # Errors
    /// [`Error::SiteOutside`], [`Error::Overflow`].
    pub fn position(&self, site: Site) -> Result<Vector<T>, Error> {
        let r = position(&self.counts(site)?, &self.directions);
        let [x, y, z] = defined_all("a position", r.into_array())?;
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
        let above = self.counts(site)?;
        if site.k == self.floor() {
            return Err(Error::OnFloor { site });
        }
        let left = closed_form::unbalanced(&above, &self.increments, &self.directions);
        let [x, y, z] = defined_all("a resultant force", left.into_array())?;
        Ok(Vector { x, y, z })
    }

    /// The contact forces of the spheres in `rows`, each with the spheres below it, lazily.
    ///
    /// Spheres on the floor have none. Each item is an error only if the scalar overflows.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Selection;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let statics = pile.statics::<f64>();
    /// let mut total = 0.0;
    /// for contact in statics.contacts(pile.rows(Selection::All)?) {
    ///     total += contact?.force;
    /// }
    /// assert_eq!(total, 1485.0);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn contacts(&self, rows: Rows) -> impl Iterator<Item = Result<ContactForce<T>, Error>> {
        let directions = self.pile.dimension().directions();
        let spheres = rows.off_the_floor(self.pile.pyramid()).flatten();
        spheres.flat_map(move |site| {
            directions.iter().map(move |&direction| {
                let force = self.contact(site, direction)?;
                Ok(ContactForce {
                    site,
                    direction,
                    force,
                })
            })
        })
    }

    /// The layer on the floor.
    fn floor(&self) -> i128 {
        self.pile.layers() - 1
    }

    /// (N_α, N_β, N_γ) of a site, counted in integers, then taken into the scalar.
    fn counts(&self, site: Site) -> Result<[T; 3], Error> {
        let Site { i, j, k } = self.pile.pyramid().check(site)?;
        Ok(count::above(&i, &j, &k).map(T::from_i128))
    }
}

impl<T: Field> Statics<'_, T> {
    /// The force of a bottom sphere on the floor.
    ///
    /// Normal mg(L+2)/3 under every sphere on an equilateral base (paper, eq. (result-normal)), and
    /// mg[1 + ((L−1−j) + 2sj)/(2(1+s))] in general. Shear −mg·tanθ/3·((L−1−3j)/2, √3/2·(L−1−2i−j)) on an
    /// equilateral base (eq. (result-shear)).
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
    /// let force = pile.statics::<f64>().on_floor(Site { i: 0, j: 0, k: 9 })?;
    /// assert_eq!((force.normal, force.shear_x, force.shear_y), (4.0, -1.5, -1.5));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn on_floor(&self, site: Site) -> Result<FloorForce<T>, Error> {
        let above = self.counts(site)?;
        if site.k != self.floor() {
            return Err(Error::NotOnFloor {
                site,
                floor: self.floor(),
            });
        }
        let force = closed_form::force_on_floor(&above, &self.increments, &self.directions);
        let overflow = || overflow::<T>("a force on the floor");
        let in_mg = force.map(|c| c.checked_div(self.increments.sum()));
        let [x, y, z] = in_mg.into_array();
        let parts = [
            x.ok_or_else(overflow)?,
            y.ok_or_else(overflow)?,
            z.ok_or_else(overflow)?,
        ];
        let [shear_x, shear_y, normal] = defined_all("a force on the floor", parts)?;
        Ok(FloorForce {
            site,
            normal,
            shear_x,
            shear_y,
        })
    }

    /// The forces of the bottom spheres in `rows` on the floor, lazily.
    ///
    /// Each item is an error if the row is not of the bottom layer, or the scalar overflows.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Selection;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let statics = pile.statics::<f64>();
    /// let base: Result<Vec<_>, _> = statics.base(pile.rows(Selection::Base)?).collect();
    /// assert!(base?.iter().all(|force| force.normal == 4.0));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn base(&self, rows: Rows) -> impl Iterator<Item = Result<FloorForce<T>, Error>> {
        rows.flatten().map(|site| self.on_floor(site))
    }
}

/// `value`, unless it stands for no number.
fn defined<T: Algebra>(quantity: &'static str, value: T) -> Result<T, Error> {
    if value.is_defined() {
        Ok(value)
    } else {
        Err(overflow::<T>(quantity))
    }
}

/// `values`, unless one of them stands for no number.
fn defined_all<T: Algebra, const N: usize>(
    quantity: &'static str,
    values: [T; N],
) -> Result<[T; N], Error> {
    if values.iter().all(T::is_defined) {
        Ok(values)
    } else {
        Err(overflow::<T>(quantity))
    }
}

fn overflow<T: Algebra>(quantity: &'static str) -> Error {
    Error::Overflow {
        quantity,
        scalar: T::NAME,
    }
}
