//! Shapes: the sites of a pile, layer by layer, and its stacking.

mod counts;
mod numbering;
mod rows;
mod runs;
mod sites;

pub use numbering::Numbering;
pub(crate) use rows::exact_hint;
pub use rows::{Rows, Selection};
pub use sites::Sites;

use alloc::boxed::Box;
use alloc::vec::Vec;

use num_bigint::BigUint;

use crate::Error;
use crate::each::Each;
use crate::lattice::{
    Axis, Dimension, Direction, HorizontalContact, MAX_LAYERS, Region, Sign, Site, Trapezoid,
};
use crate::stacking::{Pattern, Run, Stacking};

/// The sites of a pile: a [`Region`] for each layer, and the [`Stacking`] that relates them.
///
/// A shape is built downwards from a top layer or upwards from a base. Downwards, each layer consists of all supports
/// of the layer above (dilation). Upwards, each layer consists of all sites whose three supports exist (erosion). A
/// single sphere at the top and + steps only give the paper's pile, [`pyramid`](Self::pyramid).
///
/// The memory grows with the number of sign changes, not with the number of layers.
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Direction, Region, Site};
/// use cannonpile::shape::Shape;
///
/// let hcp = Shape::under(Region::SITE, "+-".parse()?)?;
/// assert_eq!(hcp.layer(2)?.to_string(), "-1..1,-1..1,-1..1");
/// assert_eq!(hcp.sphere_count(), 11_u32.into());
/// // Under a − step, γ leads to j−1.
/// let site = Site { i: 0, j: 0, k: 1 };
/// assert_eq!(hcp.below(site, Direction::Gamma), Some(Site { i: 0, j: -1, k: 2 }));
///
/// let on_a_hexagon = Shape::on(Region::hexagon(3, 3)?, "+-".parse()?)?;
/// assert_eq!(on_a_hexagon.layer(0)?, Region::hexagon(2, 2)?);
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Shape {
    dimension: Dimension,
    stacking: Stacking,
    /// The runs of the stacking, from the top.
    runs: Vec<RunLayers>,
    /// The total numbers of steps.
    whole: Steps,
    anchor: Anchor,
}

/// The numbers of + steps and of − steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
struct Steps {
    plus: i128,
    minus: i128,
}

impl Steps {
    /// Returns these steps with `steps` more of one sign.
    fn and(mut self, sign: Sign, steps: i128) -> Self {
        match sign {
            Sign::Plus => self.plus += steps,
            Sign::Minus => self.minus += steps,
        }
        self
    }
}

/// A [`Run`](crate::stacking::Run) with its first and last layer in a pile.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct RunLayers {
    /// The number of sign changes above the run.
    pub(crate) index: usize,
    pub(crate) sign: Sign,
    /// The layer above the first step.
    pub(crate) from: i128,
    /// The layer below the last step.
    pub(crate) to: i128,
    /// The steps from the top to `from`.
    above: Steps,
}

/// The layer that the other layers of a pile are built from.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Region;
/// use cannonpile::shape::Anchor;
///
/// let pile = Pile::on(Region::triangle(4)?, "++".parse()?)?;
/// assert_eq!(pile.shape().anchor(), Anchor::Base(Region::triangle(4)?));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(::serde::Serialize, ::serde::Deserialize),
    serde(rename_all = "lowercase")
)]
pub enum Anchor {
    /// The pile is built downwards from this top layer.
    Top(Region),
    /// The pile is built upwards from this base.
    Base(Region),
}

impl Anchor {
    /// Returns `top` or `base`, as in command-line options and in the keys of scene files.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Anchor;
    ///
    /// assert_eq!(Anchor::Top(Region::SITE).name(), "top");
    /// ```
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Top(_) => "top",
            Self::Base(_) => "base",
        }
    }
}

impl Shape {
    /// Returns the shape of a straight pile under one sphere: triangles of 1, 3, 6, … spheres, or rows of 1, 2, 3, …
    /// discs.
    ///
    /// # Errors
    /// [`Error::Layers`] unless 1 ≤ `layers` ≤ [`MAX_LAYERS`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Site};
    /// use cannonpile::shape::Shape;
    ///
    /// let pyramid = Shape::pyramid(10, Dimension::Three)?;
    /// assert!(pyramid.contains(Site { i: 4, j: 5, k: 9 }));
    /// assert!(!pyramid.contains(Site { i: 5, j: 5, k: 9 }));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn pyramid(layers: i128, dimension: Dimension) -> Result<Self, Error> {
        let stacking = Stacking::fcc(layers)?;
        Ok(Self::new(dimension, stacking, Anchor::Top(Region::SITE)))
    }

    /// Returns the shape that is built downwards from `top`: each layer consists of all supports of the layer above.
    ///
    /// # Errors
    /// [`Error::RegionTooLarge`] if a coordinate of a layer exceeds ±10³⁶.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Shape;
    /// use cannonpile::stacking::Stacking;
    ///
    /// // p plus and q minus steps give the hexagon −q ≤ i, j, i+j ≤ p.
    /// let shape = Shape::under(Region::SITE, Stacking::hcp(7)?)?;
    /// assert_eq!(shape.layer(6)?, Region::hexagon(4, 4)?);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn under(top: Region, stacking: Stacking) -> Result<Self, Error> {
        let shape = Self::new(Dimension::Three, stacking, Anchor::Top(top));
        let Steps { plus, minus } = shape.whole;
        top.dilated_by(Sign::Plus, plus)?
            .dilated_by(Sign::Minus, minus)?;
        Ok(shape)
    }

    /// Returns the shape that is built upwards from `base`: each layer consists of all sites whose three supports
    /// exist. The stacking is read from the top, as everywhere in the library.
    ///
    /// Some spheres may support no other sphere.
    ///
    /// # Errors
    /// [`Error::TooHigh`] if a layer is empty.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Shape;
    /// use cannonpile::Error;
    ///
    /// assert!(Shape::on(Region::triangle(3)?, "++".parse()?).is_ok());
    /// let too_high = Shape::on(Region::triangle(3)?, "+++".parse()?);
    /// assert!(matches!(too_high, Err(Error::TooHigh { greatest: 3, .. })));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn on(base: Region, stacking: Stacking) -> Result<Self, Error> {
        let shape = Self::new(Dimension::Three, stacking, Anchor::Base(base));
        let greatest = shape.height_above_base();
        if greatest < shape.layers() {
            let layers = shape.layers();
            return Err(Error::TooHigh {
                layers,
                greatest,
                base: Box::new(base),
            });
        }
        Ok(shape)
    }

    fn new(dimension: Dimension, stacking: Stacking, anchor: Anchor) -> Self {
        let (mut from, mut above) = (0, Steps::default());
        let run = |(index, Run { sign, steps }): (usize, Run)| {
            let run = RunLayers {
                index,
                sign,
                from,
                to: from + steps,
                above,
            };
            (from, above) = (run.to, above.and(sign, steps));
            run
        };
        let runs = stacking.runs().enumerate().map(run).collect();
        Self {
            dimension,
            stacking,
            runs,
            whole: above,
            anchor,
        }
    }

    /// Returns the number of layers, counted from the base, that are not empty. Bisection finds it, because all layers
    /// above an empty one are empty.
    fn height_above_base(&self) -> i128 {
        let layers = self.layers();
        if self.region(0).is_some() {
            return layers;
        }
        // Invariant: the layer `empty` is empty, and the layer `kept` is not.
        let (mut empty, mut kept) = (0, layers - 1);
        while kept - empty > 1 {
            let middle = empty + (kept - empty) / 2;
            if self.region(middle).is_some() {
                kept = middle;
            } else {
                empty = middle;
            }
        }
        layers - kept
    }

    /// Returns the number L of layers.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Shape;
    ///
    /// let shape = Shape::on(Region::hexagon(3, 3)?, "+-".parse()?)?;
    /// assert_eq!(shape.layers(), 3);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn layers(&self) -> i128 {
        self.whole.plus + self.whole.minus + 1
    }

    /// Returns whether the pile is of discs or of spheres.
    #[must_use]
    pub const fn dimension(&self) -> Dimension {
        self.dimension
    }

    /// Returns the stacking, from the top.
    #[must_use]
    pub const fn stacking(&self) -> &Stacking {
        &self.stacking
    }

    /// Returns whether this is a straight pile of + steps under one sphere, or a pile of discs.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Shape;
    ///
    /// let shape = Shape::on(Region::hexagon(3, 3)?, "+-".parse()?)?;
    /// assert!(!shape.is_pyramid());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn is_pyramid(&self) -> bool {
        self.anchor == Anchor::Top(Region::SITE) && self.whole.minus == 0
    }

    /// Returns whether this is the paper's pile, its mirror image, or a pile of discs.
    pub(crate) fn is_straight_under_one_sphere(&self) -> bool {
        self.anchor == Anchor::Top(Region::SITE) && self.stacking.is_straight()
    }

    /// Returns the layer that the other layers are built from.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Region};
    /// use cannonpile::shape::{Anchor, Shape};
    ///
    /// let shape = Shape::pyramid(10, Dimension::Three)?;
    /// assert_eq!(shape.anchor(), Anchor::Top(Region::SITE));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub const fn anchor(&self) -> Anchor {
        self.anchor
    }

    /// Returns whether the pile is built upwards from its base.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Shape;
    ///
    /// let shape = Shape::on(Region::hexagon(3, 3)?, "+-".parse()?)?;
    /// assert!(shape.is_grown_from_base());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub const fn is_grown_from_base(&self) -> bool {
        matches!(self.anchor, Anchor::Base(_))
    }

    /// Returns the region of layer k, counted from the top.
    ///
    /// # Errors
    /// [`Error::LayerOutside`] if the pile does not have layer k.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Region};
    /// use cannonpile::shape::Shape;
    ///
    /// let pyramid = Shape::pyramid(10, Dimension::Three)?;
    /// assert_eq!(pyramid.layer(9)?, Region::triangle(10)?);
    /// assert!(pyramid.layer(10).is_err());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn layer(&self, k: i128) -> Result<Region, Error> {
        self.region(k).ok_or(Error::LayerOutside {
            layer: k,
            layers: self.layers(),
        })
    }

    /// Returns the region of the bottom layer.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Shape;
    ///
    /// let shape = Shape::on(Region::hexagon(3, 3)?, "+-".parse()?)?;
    /// assert_eq!(shape.base(), Region::hexagon(3, 3)?);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn base(&self) -> Region {
        match self.anchor {
            Anchor::Base(base) => base,
            // A shape has at least one layer, so the last layer exists.
            Anchor::Top(top) => self.region(self.layers() - 1).unwrap_or(top),
        }
    }

    #[inline]
    fn region(&self, k: i128) -> Option<Region> {
        let whole = self.whole_region(k)?;
        match self.dimension {
            Dimension::Three => Some(whole),
            Dimension::Two => Region::new(whole.x(), 0..=0, whole.s()).ok(),
        }
    }

    /// Returns the region of a layer. For discs it is the region in the pile of spheres whose row j = 0 consists of the
    /// discs.
    #[inline]
    fn whole_region(&self, k: i128) -> Option<Region> {
        if !(0..self.layers()).contains(&k) {
            return None;
        }
        let Steps { plus, minus } = self.steps_to(k);
        match self.anchor {
            Anchor::Top(top) => Some(top.grown(plus, minus)),
            Anchor::Base(base) => base.shrunk(self.whole.plus - plus, self.whole.minus - minus),
        }
    }

    /// Returns the numbers of spheres above a site of layer k on its lines, within `run`, which must lead to this
    /// layer.
    #[inline]
    pub(crate) fn spheres_above(&self, run: &RunLayers, k: i128, [i, j]: [i128; 2]) -> [i128; 3] {
        let region = self.whole_region(k);
        // The counts are zero outside the pile.
        region.map_or([0; 3], |region| {
            region.spheres_above(i, j, run.sign, k - run.from)
        })
    }

    /// Returns the counts of [`spheres_above`](Self::spheres_above) along a row of layer k, from the site (i, j) on.
    pub(crate) fn row_counts(&self, run: &RunLayers, k: i128, site: [i128; 2]) -> [Trapezoid; 3] {
        let nothing = Trapezoid {
            cap: 0,
            rises: None,
            falls: None,
        };
        let region = self.whole_region(k);
        region.map_or([nothing; 3], |region| {
            region.row_counts(site, run.sign, k - run.from)
        })
    }

    /// Returns whether the pile contains this site.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Site};
    /// use cannonpile::shape::Shape;
    ///
    /// let discs = Shape::pyramid(10, Dimension::Two)?;
    /// assert!(discs.contains(Site { i: 9, j: 0, k: 9 }));
    /// assert!(!discs.contains(Site { i: 0, j: 1, k: 9 }));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    #[inline]
    pub fn contains(&self, site: Site) -> bool {
        let region = self.region(site.k);
        region.is_some_and(|region| region.contains(site.i, site.j))
    }

    /// Returns the other sphere of a horizontal contact.
    ///
    /// # Errors
    /// As for [`check`](Self::check), for either sphere.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Axis, Dimension, HorizontalContact, Site};
    /// use cannonpile::shape::Shape;
    ///
    /// let pyramid = Shape::pyramid(10, Dimension::Three)?;
    /// let contact = HorizontalContact { site: Site { i: 0, j: 1, k: 1 }, axis: Axis::GammaBeta };
    /// assert_eq!(pyramid.neighbour(contact)?, Site { i: 1, j: 0, k: 1 });
    /// let outside = HorizontalContact { axis: Axis::AlphaBeta, ..contact };
    /// assert!(pyramid.neighbour(outside).is_err());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn neighbour(&self, contact: HorizontalContact) -> Result<Site, Error> {
        let site = self.check(contact.site)?;
        // A neighbour outside `i128` is outside the pile too, and `check` rejects this substitute.
        let past = Site {
            i: i128::MAX,
            ..site
        };
        self.check(contact.neighbour().unwrap_or(past))
    }

    /// Returns the horizontal contacts of `site` with the next sphere along each axis, in the order of tables. So each
    /// contact belongs to exactly one site.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Axis, Dimension, Site};
    /// use cannonpile::shape::Shape;
    ///
    /// let pyramid = Shape::pyramid(10, Dimension::Three)?;
    /// let contacts = pyramid.horizontal_contacts(Site { i: 0, j: 0, k: 1 });
    /// assert!(contacts.map(|contact| contact.axis).eq([Axis::AlphaBeta, Axis::AlphaGamma]));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn horizontal_contacts(&self, site: Site) -> impl Iterator<Item = HorizontalContact> + '_ {
        let contacts = Axis::ALL.each(|axis| HorizontalContact { site, axis });
        contacts
            .into_iter()
            .filter(|contact| self.neighbour(*contact).is_ok())
    }

    /// Returns the number of horizontal contacts in a layer. Each line of neighbours has one contact less than spheres.
    #[doc(hidden)]
    #[must_use]
    pub fn horizontal_contacts_in(&self, k: i128) -> BigUint {
        let Some(region) = self.region(k) else {
            return BigUint::ZERO;
        };
        let [x, y, s] = region.widths().each(|width| width.unsigned_abs() + 1);
        let (axes, lines) = match self.dimension {
            Dimension::Two => (1_u32, y),
            Dimension::Three => (3, x + y + s),
        };
        region.site_count() * axes - BigUint::from(lines)
    }

    /// Checks that the pile contains this site, and returns it.
    ///
    /// # Errors
    /// [`Error::SiteOutside`] if the pile does not contain the site. If the pile does not have this layer either, the
    /// error is [`Error::LayerOutside`], except for the paper's pile and discs.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Site};
    /// use cannonpile::shape::Shape;
    ///
    /// let pyramid = Shape::pyramid(10, Dimension::Three)?;
    /// assert_eq!(pyramid.check(Site::APEX), Ok(Site::APEX));
    /// assert!(pyramid.check(Site { i: 1, j: 0, k: 0 }).is_err());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[inline]
    pub fn check(&self, site: Site) -> Result<Site, Error> {
        if self.contains(site) {
            return Ok(site);
        }
        if !self.is_pyramid() {
            // If the layer exists, the error lists its region instead.
            self.layer(site.k)?;
        }
        Err(Error::SiteOutside {
            site,
            layers: self.layers(),
            dimension: self.dimension,
            region: self
                .region(site.k)
                .filter(|_| !self.is_pyramid())
                .map(Box::new),
        })
    }

    /// Returns the support of `site` in a direction. Returns `None` for the bottom layer, and for γ in a pile of discs.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Direction, Site};
    /// use cannonpile::shape::Shape;
    ///
    /// let pyramid = Shape::pyramid(3, Dimension::Three)?;
    /// let below = pyramid.below(Site::APEX, Direction::Beta);
    /// assert_eq!(below, Some(Site { i: 1, j: 0, k: 1 }));
    /// assert_eq!(pyramid.below(Site { i: 0, j: 0, k: 2 }, Direction::Beta), None);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn below(&self, site: Site, direction: Direction) -> Option<Site> {
        self.next_to(site, direction, self.sign_below(site.k)?, 1)
    }

    /// Returns the sphere that `site` supports in a direction, or `None` at a surface.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Direction, Site};
    /// use cannonpile::shape::Shape;
    ///
    /// let pyramid = Shape::pyramid(3, Dimension::Three)?;
    /// let above = pyramid.above(Site { i: 1, j: 0, k: 1 }, Direction::Beta);
    /// assert_eq!(above, Some(Site::APEX));
    /// assert_eq!(pyramid.above(Site { i: 1, j: 0, k: 1 }, Direction::Alpha), None);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn above(&self, site: Site, direction: Direction) -> Option<Site> {
        let sign = self.sign_below(site.k.checked_sub(1)?)?;
        self.next_to(site, direction, sign, -1)
    }

    fn next_to(&self, site: Site, direction: Direction, sign: Sign, down: i128) -> Option<Site> {
        let from = self.contains(site).then_some(site)?;
        let to = from.step(sign, direction, down)?;
        self.contains(to).then_some(to)
    }

    /// Returns the greatest number of layers that a base supports with a pattern. The pattern is read upwards from the
    /// base.
    #[doc(hidden)]
    pub fn greatest_height(base: Region, pattern: &Pattern) -> Result<i128, Error> {
        // Each step reduces each width by at least one, and no width can be negative.
        let [x, y, s] = base.widths();
        let most = (x.min(y).min(s) + 1).min(MAX_LAYERS);
        let steps = pattern.stacking(most)?.reversed();
        Ok(Self::new(Dimension::Three, steps, Anchor::Base(base)).height_above_base())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_horizontal_contacts_of_a_layer_are_those_of_its_spheres() {
        let under = |top| Shape::under(top, "++-".parse().unwrap()).unwrap();
        for shape in [
            Shape::pyramid(5, Dimension::Three).unwrap(),
            Shape::pyramid(5, Dimension::Two).unwrap(),
            under(Region::hexagon(3, 2).unwrap()),
            under(Region::new(2..=5, 1..=1, 3..=6).unwrap()),
        ] {
            for k in 0..shape.layers() {
                let sites = shape.rows(Selection::Layer(k)).unwrap().flatten();
                let contacts = sites.flat_map(|site| shape.horizontal_contacts(site));
                let counted = shape.horizontal_contacts_in(k);
                assert_eq!(counted, contacts.count().into(), "{k}");
            }
            assert_eq!(shape.horizontal_contacts_in(-1), BigUint::ZERO);
        }
        // Layer 2 has rows of three, two and one sphere along each of three axes: 3·3 contacts.
        let pyramid = Shape::pyramid(5, Dimension::Three).unwrap();
        assert_eq!(pyramid.horizontal_contacts_in(2), 9_u32.into());
    }
}
