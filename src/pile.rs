//! A validated pile.

mod display;
mod loading;
mod system;

pub(crate) use loading::Loading;
pub(crate) use system::Extra;

use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::Error;
use crate::each::Each;
use crate::error::not_negative;
use crate::geometry::{Clearance, Load, Vector, directions, disc_directions};
use crate::lattice::{Dimension, HorizontalContact, Region, Sign, Site, count};
use crate::scalar::{Algebra, ByValue, Ring, reduced, sum_of};
use crate::shape::{Numbering, Rows, Selection, Shape, Sites};
use crate::stacking::Stacking;

/// A pile: its sites, its stacking, its weights and loads, and sin φ.
///
/// These data determine the forces in pile units. Spacing, radius, mass and gravity belong to a
/// [`Packing`](crate::Packing), which checks them.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Site;
/// use num_rational::BigRational;
///
/// // 10³⁰ layers cost as little as 10.
/// let pile = Pile::triangular(10_i128.pow(30))?;
/// let forces = pile.forces::<BigRational>();
/// let force = forces.on_floor(Site { i: 5, j: 7, k: pile.layers() - 1 })?;
/// assert_eq!(force.normal.to_string(), "333333333333333333333333333334");
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Pile {
    shape: Shape,
    /// sin φ. It is 0 for discs: the limit s → 0 of the isosceles pile, whose γ lines carry no force.
    sin_phi: BigRational,
    pub(crate) loading: Loading,
}

exact_surd::equality!(Hash for Pile; |Self { shape, sin_phi, loading }| (shape, ByValue(sin_phi), loading));

impl Pile {
    /// Returns the paper's pile: an equilateral base, φ = π/6.
    ///
    /// # Errors
    /// [`Error::Layers`] unless 1 ≤ `layers` ≤ [`MAX_LAYERS`](crate::lattice::MAX_LAYERS).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Error, Pile};
    ///
    /// assert_eq!(Pile::triangular(10)?.sin_phi().to_string(), "1/2");
    /// assert!(matches!(Pile::triangular(0), Err(Error::Layers { .. })));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    /// Layers are counted in an `i128`. Convert a `u32` or an `i64` with `layers.into()`. A `usize` needs `try_into`,
    /// which does not fail on today's machines:
    /// ```
    /// use cannonpile::Pile;
    ///
    /// let layers: usize = 3;
    /// assert_eq!(Pile::triangular(layers.try_into().unwrap())?.layers(), 3);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn triangular(layers: i128) -> Result<Self, Error> {
        Self::isosceles(layers, BigRational::new(1.into(), 2.into()))
    }

    /// Returns the pile on an isosceles base triangle of general φ, from sin φ.
    ///
    /// # Errors
    /// [`Error::SinPhi`] unless 0 < sin φ < 1; [`Error::Layers`] as for [`triangular`](Self::triangular).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Error, Pile, ratio};
    ///
    /// assert!(Pile::isosceles(10, ratio!(2/5)).is_ok());
    /// assert!(matches!(Pile::isosceles(10, ratio!(1)), Err(Error::SinPhi { .. })));
    /// # Ok::<(), Error>(())
    /// ```
    pub fn isosceles(layers: i128, sin_phi: BigRational) -> Result<Self, Error> {
        let (shape, sin_phi) = (Shape::pyramid(layers, Dimension::Three)?, reduced(sin_phi));
        if BigRational::zero() < sin_phi && sin_phi < BigRational::one() {
            Ok(Self::new(shape, sin_phi))
        } else {
            Err(Error::SinPhi { given: sin_phi })
        }
    }

    /// Returns the pile of discs (the paper's ref. hong93): layers of 1, 2, 3, … in a plane.
    ///
    /// # Errors
    /// [`Error::Layers`] as for [`triangular`](Self::triangular).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// assert_eq!(Pile::discs(10)?.sphere_count(), 55_u32.into());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn discs(layers: i128) -> Result<Self, Error> {
        let shape = Shape::pyramid(layers, Dimension::Two)?;
        Ok(Self::new(shape, BigRational::zero()))
    }

    /// Returns the pile of any stacking grown down from a top layer. Each layer has all sites that support the layer
    /// above.
    ///
    /// # Errors
    /// [`Error::RegionTooLarge`] if a coordinate of a layer is beyond ±10³⁶.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::{Region, Site};
    /// use cannonpile::stacking::Stacking;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::under(Region::SITE, Stacking::hcp(4)?)?;
    /// // In the third layer of HCP a sphere lies vertically below the apex.
    /// let below = Site { i: 0, j: 0, k: 2 };
    /// let forces = pile.forces::<BigRational>().from_above(below)?;
    /// assert_eq!(forces.map(|force| force.to_string()), ["2/3"; 3]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn under(top: Region, stacking: Stacking) -> Result<Self, Error> {
        Ok(Self::new(Shape::under(top, stacking)?, half()))
    }

    /// Returns the pile of any stacking grown up from a base. Each layer has all sites whose three supports exist. The
    /// stacking is read from the top.
    ///
    /// # Errors
    /// [`Error::TooHigh`] if the base does not support that many layers.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    /// use cannonpile::stacking::Stacking;
    ///
    /// let pile = Pile::on(Region::hexagon(3, 3)?, Stacking::fcc(3)?)?;
    /// assert_eq!(pile.sphere_count(), 37_u32.into());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn on(base: Region, stacking: Stacking) -> Result<Self, Error> {
        Ok(Self::new(Shape::on(base, stacking)?, half()))
    }

    /// Returns the pile without weights, loads, tilt and forces of horizontal contacts. Its forces under one load are the
    /// response to this load.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Direction, Site};
    /// use cannonpile::{Load, Pile, ratio};
    /// use num_rational::BigRational;
    ///
    /// let bare = Pile::triangular(10)?.bare();
    /// // The forces below the apex per unit of a load downwards, along x and along y.
    /// let [down, x, y] = Load::units().map(|load| {
    ///     let forces = bare.forces::<BigRational>().with_load(Site::APEX, load)?;
    ///     forces.contact(Site::APEX, Direction::Alpha)
    /// });
    /// assert_eq!([down?, x?, y?], [ratio!(1), ratio!(-1), ratio!(-3)]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn bare(&self) -> Self {
        Self::new(self.shape.clone(), self.sin_phi.clone()).weightless()
    }

    fn new(shape: Shape, sin_phi: BigRational) -> Self {
        Self {
            shape,
            sin_phi,
            loading: Loading::default(),
        }
    }

    /// Returns the pile with a further load on one sphere: a rational for a vertical load in mg, or a [`Load`] of any
    /// direction.
    ///
    /// # Errors
    /// [`Error::SiteOutside`]; [`Error::NegativeLoad`] for an upward load; [`Error::OutOfPlane`] for a load on a disc
    /// along y.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Direction, Site};
    /// use cannonpile::{Pile, ratio};
    ///
    /// let pile = Pile::triangular(10)?.with_load(Site::APEX, ratio!(2))?;
    /// // Each support carries a third of 3 mg, along a contact force of 3 f₀.
    /// assert_eq!(pile.forces::<f64>().contact(Site::APEX, Direction::Alpha)?, 3.0);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn with_load(mut self, site: Site, load: impl Into<Load>) -> Result<Self, Error> {
        let (site, load) = (self.shape.check(site)?, load.into().map(reduced));
        not_negative("load", site, load.down.clone())?;
        self.check_in_plane("load", &load.y)?;
        self.loading.add_load(site, &load);
        Ok(self)
    }

    /// Returns the pile under gravity that leans further, by the tilt (x, y).
    ///
    /// The horizontal part of gravity is x·tanθ along x and y·2cosφ·tanθ along y, times the vertical part. So a sphere
    /// of weight mg has the [`Load`] (1, x, y). Masses stay as they are, and so does the vertical part of gravity. The
    /// same data describe a pile on a floor that accelerates horizontally.
    ///
    /// # Errors
    /// [`Error::OutOfPlane`] for discs with y ≠ 0.
    ///
    /// # Examples
    /// A straight pile bears a tilt of up to ½ towards the middle of a side, where tan(tilt) = ½ tanθ:
    /// ```
    /// use cannonpile::{Pile, Verdict, ratio};
    ///
    /// let pile = |x| Pile::triangular(10)?.with_tilt([x, ratio!(0)]);
    /// assert_eq!(pile(ratio!(-1/2))?.stands()?, Verdict::Yes);
    /// assert_eq!(pile(ratio!(-51/100))?.stands()?, Verdict::No);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn with_tilt(mut self, tilt: [BigRational; 2]) -> Result<Self, Error> {
        self.check_in_plane("tilt", &tilt[1])?;
        self.loading.add_tilt(tilt.map(reduced));
        Ok(self)
    }

    /// Returns an error for a force on discs that points out of their plane.
    pub(crate) fn check_in_plane<T: Ring>(
        &self,
        quantity: &'static str,
        y: &T,
    ) -> Result<(), Error> {
        if self.dimension() == Dimension::Two && !y.is_zero() {
            return Err(Error::OutOfPlane { quantity });
        }
        Ok(())
    }

    /// Returns the pile with a new weight of one sphere, in mg. In a [`weightless`](Self::weightless) pile only these spheres
    /// have a weight.
    ///
    /// # Errors
    /// [`Error::SiteOutside`]; [`Error::NegativeLoad`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Site;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?.with_weight(Site::APEX, BigRational::from_integer(5.into()))?;
    /// assert_eq!(pile.weight().to_string(), "224");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn with_weight(mut self, site: Site, weight: BigRational) -> Result<Self, Error> {
        self.loading.set_weight(self.shape.check(site)?, weight)?;
        Ok(self)
    }

    /// Returns the pile with spheres without weight, whatever it was before. Its forces are the response to its loads alone.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::{Direction, Site};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?.weightless();
    /// let pile = pile.with_load(Site::APEX, BigRational::from_integer(1.into()))?;
    /// // The load of 1 mg stays on the three lines of the apex, with 1 f₀ each.
    /// let forces = pile.forces::<f64>();
    /// assert_eq!(forces.contact(Site { i: 0, j: 0, k: 5 }, Direction::Alpha)?, 1.0);
    /// assert_eq!(forces.contact(Site { i: 1, j: 1, k: 5 }, Direction::Alpha)?, 0.0);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn weightless(mut self) -> Self {
        self.loading.set_weightless();
        self
    }

    /// Returns the sites of the pile and its stacking.
    #[must_use]
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// Returns the number L of layers.
    #[must_use]
    pub fn layers(&self) -> i128 {
        self.shape.layers()
    }

    /// Returns the dimension: discs or spheres.
    #[must_use]
    pub fn dimension(&self) -> Dimension {
        self.shape.dimension()
    }

    /// Returns sin φ: ½ on an equilateral base, 0 for discs.
    #[must_use]
    pub fn sin_phi(&self) -> &BigRational {
        &self.sin_phi
    }

    /// Returns whether all contact directions are equivalent by symmetry: on an equilateral base, or in a pile of
    /// discs.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use num_rational::BigRational;
    ///
    /// assert!(Pile::triangular(10)?.is_regular());
    /// assert!(!Pile::isosceles(10, BigRational::new(2.into(), 5.into()))?.is_regular());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn is_regular(&self) -> bool {
        self.dimension() == Dimension::Two || self.sin_phi == BigRational::new(1.into(), 2.into())
    }

    /// Returns the number of spheres.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// assert_eq!(Pile::triangular(10)?.sphere_count(), 220_u32.into());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn sphere_count(&self) -> BigUint {
        if self.shape.is_pyramid() {
            return self.count(|layers, d| count::spheres(&layers, d));
        }
        self.shape.sphere_count()
    }

    /// Returns the weight of all spheres and the downward loads on them, in mg. This is the total normal force on the
    /// floor.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// assert_eq!(Pile::triangular(10)?.weight().to_string(), "220");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn weight(&self) -> BigRational {
        let ordinary =
            self.loading.ordinary_weight() * BigRational::from_integer(self.sphere_count().into());
        let extras = self.loading.extras().map(|(_, extra, _)| extra.down);
        ordinary + sum_of(extras)
    }

    /// Returns the weight of one sphere without its load, in mg. It is 1 unless [`with_weight`](Self::with_weight)
    /// changed it.
    ///
    /// # Errors
    /// [`Error::SiteOutside`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Site;
    ///
    /// let pile = Pile::triangular(10)?;
    /// assert_eq!(pile.sphere_weight(Site::APEX)?.to_string(), "1");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn sphere_weight(&self, site: Site) -> Result<BigRational, Error> {
        Ok(self.loading.weight(self.shape.check(site)?))
    }

    /// Returns whether spheres have no weight, except those that [`with_weight`](Self::with_weight) gave one later.
    #[must_use]
    pub fn is_weightless(&self) -> bool {
        self.loading.is_weightless()
    }

    /// Returns the number of contacts between spheres. Contacts with the floor are not counted.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// assert_eq!(Pile::triangular(10)?.contact_count(), 495_u32.into());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn contact_count(&self) -> BigUint {
        if self.shape.is_pyramid() {
            return self.count(|layers, d| count::contacts(&layers, d));
        }
        self.shape.spheres_in(0..self.layers() - 1) * self.dimension().number()
    }

    /// Returns the number of spheres in the bottom layer.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// assert_eq!(Pile::triangular(10)?.base_sphere_count(), 55_u32.into());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn base_sphere_count(&self) -> BigUint {
        self.shape.base().site_count()
    }

    /// Returns the number of contacts of one direction with a force of `n` increments. In a straight pile under one
    /// sphere without loads, it is (L−n)(L−n+1)/2 for spheres.
    ///
    /// The number is zero unless 1 ≤ `n` < L. It is also zero for any other pile.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// let pile = Pile::triangular(10)?;
    /// assert_eq!(pile.contact_count_of_strength(9), 1_u32.into());
    /// assert_eq!(pile.contact_count_of_strength(10), 0_u32.into());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn contact_count_of_strength(&self, n: i128) -> BigUint {
        if !(1..self.layers()).contains(&n) || !self.is_paper_pile() {
            return BigUint::zero();
        }
        let n = BigRational::from_integer(n.into());
        self.count(|layers, d| count::contacts_of_strength(&layers, &n, d))
    }

    fn count(&self, formula: impl FnOnce(BigRational, u32) -> BigRational) -> BigUint {
        // The formula counts objects, so its value is a non-negative integer.
        let layers = BigRational::from_integer(self.layers().into());
        formula(layers, self.dimension().number())
            .to_integer()
            .into_parts()
            .1
    }

    /// Returns the range of spacings at which the spheres of this pile do not overlap.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// let least = Pile::triangular(10)?.clearance().least();
    /// assert_eq!(least.map(|spacing| spacing.to_string()), Some("1".into()));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn clearance(&self) -> Clearance {
        Clearance::new(&self.shape, &self.sin_phi)
    }

    /// Returns the rows of a part of the pile, from the top.
    ///
    /// # Errors
    /// [`Error::SiteOutside`] or [`Error::LayerOutside`] if the pile does not have the selected site or layer.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::triangular(10)?;
    /// assert_eq!(pile.rows(Selection::Layer(2))?.site_count(), 6_u32.into());
    /// assert!(pile.rows(Selection::Layer(10)).is_err());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn rows(&self, selection: Selection) -> Result<Rows<'_>, Error> {
        self.shape.rows(selection)
    }

    /// Returns the sites of a part of the pile, from the top, row by row.
    ///
    /// # Errors
    /// As for [`rows`](Self::rows).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Site;
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let base: Vec<Site> = pile.sites(Selection::Base)?.collect();
    /// assert_eq!(base.len(), 55);
    /// assert_eq!(base[0], Site::new(0, 0, 9));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn sites(&self, selection: Selection) -> Result<Sites<'_>, Error> {
        Ok(self.rows(selection)?.sites())
    }

    /// Returns the numbering of all spheres, which converts sites to numbers and back: [`Shape::numbering`].
    ///
    /// # Errors
    /// [`Error::TooLarge`] for more than 10¹¹ spheres.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// assert_eq!(Pile::discs(10)?.numbering()?.sphere_count(), 55);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn numbering(&self) -> Result<Numbering<'_>, Error> {
        self.shape.numbering()
    }

    /// Returns ê_a, ê_b, ê_c in the symbolic basis, from the lower sphere to the upper one, under a + step. Under a −
    /// step, their horizontal parts have the opposite sign.
    ///
    /// Paper, (1). The vectors are [`directions`] of sin φ for spheres, and [`disc_directions`] for discs.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use num_rational::BigRational;
    ///
    /// let [_, _, c] = Pile::triangular(10)?.directions::<BigRational>();
    /// assert_eq!(c.into_array().map(|x| x.to_string()), ["-1", "0", "-1"]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn directions<T: Algebra>(&self) -> [Vector<T>; 3] {
        match self.dimension() {
            Dimension::Two => disc_directions(),
            Dimension::Three => directions(&T::from_rational(&self.sin_phi)),
        }
    }

    /// Returns the tilt of gravity along x and y: (0, 0) unless [`with_tilt`](Self::with_tilt) changed it.
    #[must_use]
    pub fn tilt(&self) -> &[BigRational; 2] {
        self.loading.tilt()
    }

    /// Returns the spheres with a load, and the loads.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Site;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?.with_load(Site::APEX, BigRational::from_integer(2.into()))?;
    /// let loads: Vec<_> = pile.loads().map(|(site, load)| (site, load.to_string())).collect();
    /// assert_eq!(loads, [(Site::APEX, "2".to_string())]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn loads(&self) -> impl ExactSizeIterator<Item = (Site, &Load)> + '_ {
        self.loading.loads().into_iter()
    }

    /// Returns the spheres whose weight is not that of the others, with their weights, in mg. The others weigh 1, or 0 in a
    /// [`weightless`](Self::weightless) pile.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Site;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?.with_weight(Site::APEX, BigRational::from_integer(5.into()))?;
    /// assert_eq!(pile.weights().count(), 1);
    /// assert_eq!(pile.weightless().weights().count(), 0);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn weights(&self) -> impl Iterator<Item = (Site, &BigRational)> + '_ {
        self.loading.weights()
    }

    /// Returns the load on a sphere. It is 0 unless [`with_load`](Self::with_load) set it.
    ///
    /// # Errors
    /// [`Error::SiteOutside`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Site;
    ///
    /// assert_eq!(Pile::triangular(10)?.load(Site::APEX)?.to_string(), "0");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn load(&self, site: Site) -> Result<Load, Error> {
        Ok(self.loading.load(self.shape.check(site)?))
    }

    /// Returns the pile with an additional force in a horizontal contact, in f₀. The sloping contacts balance it.
    ///
    /// If neighbours in a layer touch, at a = R, a pile has many states of equilibrium, one for each choice of these
    /// forces: [`paper`](crate::paper#horizontal-contacts). A force between bottom spheres has no effect and is
    /// refused.
    ///
    /// # Errors
    /// [`Error::SiteOutside`] for either sphere; [`Error::OnFloor`]; [`Error::NegativeLoad`] for a tensile force;
    /// [`Error::NoHorizontalContacts`] unless sin φ = 1/2.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::{Axis, Direction, HorizontalContact, Site};
    /// use num_rational::BigRational;
    ///
    /// let site = Site { i: 0, j: 0, k: 1 };
    /// let contact = HorizontalContact { site, axis: Axis::AlphaBeta };
    /// let pile = Pile::triangular(3)?.with_horizontal_force(contact, BigRational::from_integer(1.into()))?;
    /// let forces = pile.forces::<BigRational>();
    /// // The contact force grows on the side away from the neighbour, and shrinks on the side of the neighbour.
    /// assert_eq!(forces.contact(site, Direction::Alpha)?.to_string(), "3");
    /// assert_eq!(forces.contact(site, Direction::Beta)?.to_string(), "0");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn with_horizontal_force(
        mut self,
        contact: HorizontalContact,
        force: BigRational,
    ) -> Result<Self, Error> {
        self.check_horizontal()?;
        let site = self.shape.check(contact.site)?;
        let neighbour = self.shape.neighbour(contact)?;
        let sign = self.shape.sign_below(site.k);
        let sign = sign.ok_or(Error::OnFloor { site })?;
        self.loading.push(contact, neighbour, sign, force)?;
        Ok(self)
    }

    /// Returns the horizontal contacts with prescribed forces, in their order, and these forces in f₀.
    ///
    /// # Examples
    /// See [`with_horizontal_force`](Self::with_horizontal_force).
    /// ```
    /// use cannonpile::Pile;
    ///
    /// assert_eq!(Pile::triangular(3)?.horizontal_forces().len(), 0);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn horizontal_forces(
        &self,
    ) -> impl ExactSizeIterator<Item = (HorizontalContact, &BigRational)> + '_ {
        self.loading.horizontal().into_iter()
    }

    /// Returns the prescribed force of a horizontal contact, in f₀. It is 0 unless it was set.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::{Axis, HorizontalContact, Site};
    ///
    /// let contact = HorizontalContact { site: Site { i: 0, j: 0, k: 1 }, axis: Axis::AlphaBeta };
    /// assert_eq!(Pile::triangular(3)?.horizontal_force(contact).to_string(), "0");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn horizontal_force(&self, contact: HorizontalContact) -> BigRational {
        self.loading.horizontal_force(contact)
    }

    /// Returns the pile without prescribed forces of horizontal contacts.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// let pile = Pile::triangular(3)?;
    /// assert_eq!(pile.clone().without_horizontal_forces(), pile);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn without_horizontal_forces(mut self) -> Self {
        self.loading.release();
        self
    }

    /// Checks that all neighbours in a layer touch at a = R.
    ///
    /// # Errors
    /// [`Error::NoHorizontalContacts`].
    #[doc(hidden)]
    pub fn check_horizontal(&self) -> Result<(), Error> {
        if self.is_regular() {
            Ok(())
        } else {
            Err(Error::NoHorizontalContacts {
                sin_phi: self.sin_phi.clone(),
            })
        }
    }

    /// Returns whether every sphere has the weight mg under vertical gravity, and carries no load or horizontal contact
    /// force.
    #[doc(hidden)]
    #[must_use]
    pub fn is_uniform(&self) -> bool {
        self.has_unit_weights() && self.gravity_is_vertical()
    }

    /// Returns the sum of gravity and load on a sphere.
    #[doc(hidden)]
    #[must_use]
    pub fn total_load(&self, site: Site) -> Load {
        self.loading.total(site)
    }

    /// Returns what gravity and the load on a sphere add to its lines, in f₀, by direction. For a sphere on the floor these
    /// are the forces above a + step.
    #[doc(hidden)]
    #[must_use]
    pub fn own_increments(&self, site: Site) -> [BigRational; 3] {
        let sign = self.shape.sign_below(site.k).unwrap_or(Sign::Plus);
        self.load_increments(&self.loading.total(site), sign)
    }

    /// Returns whether no sphere has a negative increment, so that forces grow along every line of a run.
    #[doc(hidden)]
    #[must_use]
    pub fn forces_grow(&self) -> bool {
        let ordinary = [Sign::Plus, Sign::Minus].each(|sign| self.ordinary(sign));
        let extras = self.loading.extras();
        let extras = extras.map(|(site, ..)| self.own_increments(site));
        let mut all = ordinary.into_iter().chain(extras).flatten();
        !all.any(|increment| increment.is_negative())
    }

    /// Returns whether this is the paper's pile: straight, under one sphere, every sphere of weight mg.
    #[doc(hidden)]
    #[must_use]
    pub fn is_paper_pile(&self) -> bool {
        self.shape.is_straight_under_one_sphere() && self.is_uniform()
    }
}

fn half() -> BigRational {
    BigRational::new(1.into(), 2.into())
}
