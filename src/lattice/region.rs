//! Regions of the triangular lattice with up to six sides: the layers of piles.

mod lines;

pub(crate) use lines::{Along, Nearby, Slopes, Trapezoid, small};

use alloc::boxed::Box;
use core::fmt;
use core::ops::RangeInclusive;
use core::str::FromStr;

use exact_surd::layout::padded;
use num_bigint::{BigInt, BigUint};
use num_integer::Integer;

use super::Row;
use crate::Error;
use crate::each::Each;
use crate::lattice::Sign;
use crate::scalar::parse::integer;

/// The sites x₀ ≤ i ≤ x₁, y₀ ≤ j ≤ y₁, s₀ ≤ i+j ≤ s₁ of a layer: a triangle, trapezium, parallelogram, pentagon or
/// hexagon. A region is never empty. Its bounds are tight: some site attains each of them.
///
/// Dilation and erosion change each bound by one addition, so their cost does not depend on the size.
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Region, Sign};
///
/// let hexagon = Region::hexagon(3, 3)?;
/// assert_eq!(hexagon.site_count(), 19_u32.into());
/// // The layer below consists of all supports.
/// let below = hexagon.dilated(Sign::Plus)?;
/// assert_eq!(below.site_count(), 27_u32.into());
/// assert_eq!(below.eroded(Sign::Plus), Some(hexagon));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Region {
    /// (x₀, y₀, s₀).
    lower: [i128; 3],
    /// (x₁, y₁, s₁).
    upper: [i128; 3],
}

/// The greatest coordinate of a region. Sums of a few coordinates then fit in `i128`.
const LIMIT: i128 = super::MAX_LAYERS;

impl Region {
    /// Returns the region of all sites with i in `x`, j in `y` and i+j in `s`.
    ///
    /// # Errors
    /// [`Error::EmptyRegion`] if no site satisfies the bounds; [`Error::RegionTooLarge`] for bounds beyond ±10³⁶.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    ///
    /// // `new` tightens the bounds: i+j ≤ 2 implies i ≤ 2.
    /// let triangle = Region::new(0..=9, 0..=9, 0..=2)?;
    /// assert_eq!(triangle, Region::triangle(3)?);
    /// assert!(Region::new(5..=9, 5..=9, 0..=2).is_err());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn new(
        x: RangeInclusive<i128>,
        y: RangeInclusive<i128>,
        s: RangeInclusive<i128>,
    ) -> Result<Self, Error> {
        let lower = [*x.start(), *y.start(), *s.start()];
        let upper = [*x.end(), *y.end(), *s.end()];
        let region = Self { lower, upper };
        if !region.is_within_limit() {
            return Err(Error::RegionTooLarge {
                region: Box::new(region),
            });
        }
        region.tightened().ok_or(Error::EmptyRegion {
            region: Box::new(region),
        })
    }

    /// The region of one site, (0, 0).
    pub const SITE: Self = Self {
        lower: [0; 3],
        upper: [0; 3],
    };

    /// Returns the hexagon with `p` and `q` spheres on alternate sides: −(q−1) ≤ i, j, i+j ≤ p−1.
    ///
    /// # Errors
    /// [`Error::RegionSide`] unless both sides are between 1 and 10³⁶.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    ///
    /// assert_eq!(Region::hexagon(3, 2)?.to_string(), "-1..2,-1..2,-1..2");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn hexagon(p: i128, q: i128) -> Result<Self, Error> {
        for side in [p, q] {
            if !(1..=LIMIT).contains(&side) {
                return Err(Error::RegionSide { given: side });
            }
        }
        let range = || 1 - q..=p - 1;
        Self::new(range(), range(), range())
    }

    /// Returns the triangle with `n` spheres on a side: 0 ≤ i, j, i+j ≤ n−1.
    ///
    /// # Errors
    /// [`Error::RegionSide`] unless 1 ≤ `n` ≤ 10³⁶.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    ///
    /// assert_eq!(Region::triangle(4)?.to_string(), "0..3,0..3,0..3");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn triangle(n: i128) -> Result<Self, Error> {
        Self::hexagon(n, 1)
    }

    /// Returns the range x₀ … x₁ of i.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    ///
    /// assert_eq!(Region::hexagon(3, 2)?.x(), -1..=2);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub const fn x(&self) -> RangeInclusive<i128> {
        self.lower[0]..=self.upper[0]
    }

    /// Returns the range y₀ … y₁ of j.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    ///
    /// assert_eq!(Region::hexagon(3, 2)?.y(), -1..=2);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub const fn y(&self) -> RangeInclusive<i128> {
        self.lower[1]..=self.upper[1]
    }

    /// Returns the range s₀ … s₁ of i+j.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    ///
    /// assert_eq!(Region::hexagon(3, 2)?.s(), -1..=2);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub const fn s(&self) -> RangeInclusive<i128> {
        self.lower[2]..=self.upper[2]
    }

    /// Returns whether the region contains the site (i, j).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    ///
    /// assert!(Region::hexagon(3, 2)?.contains(2, 0));
    /// assert!(!Region::hexagon(3, 2)?.contains(2, 1));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    #[inline]
    pub fn contains(&self, i: i128, j: i128) -> bool {
        // If i and j are within their bounds, the sum cannot overflow.
        self.x().contains(&i) && self.y().contains(&j) && self.s().contains(&(i + j))
    }

    /// Returns the layer below, which consists of all supports of all sites under a step of this sign.
    ///
    /// # Errors
    /// [`Error::RegionTooLarge`] beyond ±10³⁶.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    ///
    /// use cannonpile::lattice::Sign;
    ///
    /// assert_eq!(Region::SITE.dilated(Sign::Minus)?.to_string(), "-1..0,-1..0,-1..0");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn dilated(&self, sign: Sign) -> Result<Self, Error> {
        self.dilated_by(sign, 1)
    }

    /// Returns the layer that is `steps` steps of one sign further down.
    ///
    /// # Errors
    /// [`Error::RegionTooLarge`] beyond ±10³⁶; [`Error::RunLength`] for negative steps.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    ///
    /// use cannonpile::lattice::Sign;
    ///
    /// assert_eq!(Region::SITE.dilated_by(Sign::Plus, 9)?, Region::triangle(10)?);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn dilated_by(&self, sign: Sign, steps: i128) -> Result<Self, Error> {
        if steps < 0 {
            return Err(Error::RunLength { given: steps });
        }
        // More steps than this exceed the limit from every region, and this number does not overflow.
        let steps = steps.min(3 * LIMIT);
        let region = match sign {
            Sign::Plus => self.grown(steps, 0),
            Sign::Minus => self.grown(0, steps),
        };
        if region.is_within_limit() {
            return Ok(region);
        }
        Err(Error::RegionTooLarge {
            region: Box::new(*self),
        })
    }

    /// Returns the layer above, which consists of all sites whose three supports are in this region. Returns `None` if
    /// it is empty.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    ///
    /// use cannonpile::lattice::Sign;
    ///
    /// assert_eq!(Region::triangle(4)?.eroded(Sign::Plus), Some(Region::triangle(3)?));
    /// assert_eq!(Region::SITE.eroded(Sign::Plus), None);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn eroded(&self, sign: Sign) -> Option<Self> {
        match sign {
            Sign::Plus => self.shrunk(1, 0),
            Sign::Minus => self.shrunk(0, 1),
        }
    }

    /// Returns the mirror image (i, j) → (−i, −j).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    ///
    /// assert_eq!(Region::hexagon(3, 2)?.mirrored(), Region::hexagon(2, 3)?);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn mirrored(&self) -> Self {
        Self {
            lower: self.upper.each(|b| -b),
            upper: self.lower.each(|b| -b),
        }
    }

    /// Returns whether a translation maps the mirror image (i, j) → (−i, −j) onto this region.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    ///
    /// assert!(Region::hexagon(3, 3)?.is_its_own_mirror_image());
    /// assert!(!Region::triangle(3)?.is_its_own_mirror_image());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn is_its_own_mirror_image(&self) -> bool {
        let ([x0, y0, s0], [x1, y1, s1]) = (self.lower, self.upper);
        // If a translation makes x₀ and y₀ coincide, only the bounds of i+j can differ.
        s0 - x0 - y0 == x1 + y1 - s1
    }

    /// Returns the s for which the rotation by 120°, (i, j) → (j, s−i−j), maps the region onto itself, or `None` if no
    /// s does.
    pub(crate) fn sum_of_turn(&self) -> Option<i128> {
        let ([x0, y0, s0], [x1, y1, s1]) = (self.lower, self.upper);
        let (sum, alike) = (s0 + x1, [x0, x1] == [y0, y1]);
        (alike && s1 + x0 == sum).then_some(sum)
    }

    /// Returns the sites with i ≥ `x` and i+j ≥ `s`, or `None` if there are none.
    pub(crate) fn above(&self, [x, s]: [i128; 2]) -> Option<Self> {
        let [x0, y0, s0] = self.lower;
        let lower = [x0.max(x), y0, s0.max(s)];
        Self { lower, ..*self }.tightened()
    }

    /// Returns the number of sites, which may exceed any machine integer.
    ///
    /// It is the number of sites of the parallelogram x × y minus those of the two corner triangles that s cuts off.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    ///
    /// assert_eq!(Region::hexagon(3, 3)?.site_count(), 19_u32.into());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn site_count(&self) -> BigUint {
        let ([x0, y0, s0], [x1, y1, s1]) = (self.lower, self.upper);
        let (sides, corners) = ([x1 - x0 + 1, y1 - y0 + 1], [s0 - (x0 + y0), x1 + y1 - s1]);
        // Products of two numbers below 2^62 fit in `i128`.
        if sides.iter().chain(&corners).all(|side| *side < 1 << 62) {
            return sites(sides, corners).unsigned_abs().into();
        }
        // A count is not negative, so its magnitude is the value.
        sites(sides.each(BigInt::from), corners.each(BigInt::from))
            .into_parts()
            .1
    }

    /// Returns the number of sites before (i, j) in row order. The region must contain (i, j).
    pub(crate) fn sites_before(&self, i: i128, j: i128) -> BigUint {
        let start = self.row(j).start;
        let rows_before = Self {
            upper: [self.upper[0], j - 1, self.upper[2]],
            ..*self
        };
        let whole_rows = rows_before
            .tightened()
            .map_or_else(BigUint::default, |r| r.site_count());
        whole_rows + BigInt::from(i - start).into_parts().1
    }

    /// Returns the range of i in row j, which may be empty.
    #[inline]
    pub(crate) fn row(&self, j: i128) -> core::ops::Range<i128> {
        let ([x0, _, s0], [x1, _, s1]) = (self.lower, self.upper);
        x0.max(s0 - j)..x1.min(s1 - j) + 1
    }

    /// Returns the range of i in row j. It is empty for a row outside the region.
    pub(crate) fn row_within(&self, j: i128) -> core::ops::Range<i128> {
        let row = self.row(j);
        if self.y().contains(&j) {
            row
        } else {
            row.start..row.start
        }
    }

    /// Returns the six corners in cyclic order. Two corners coincide if the side between them has only one site.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    ///
    /// let corners = Region::triangle(4)?.corners();
    /// assert_eq!(corners, [[0, 0], [3, 0], [3, 0], [0, 3], [0, 3], [0, 0]]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub const fn corners(&self) -> [[i128; 2]; 6] {
        let ([x0, y0, s0], [x1, y1, s1]) = (self.lower, self.upper);
        [
            [s0 - y0, y0],
            [x1, y0],
            [x1, s1 - x1],
            [s1 - y1, y1],
            [x0, y1],
            [x0, s0 - x0],
        ]
    }

    /// Returns the differences between upper and lower bound of i, j and i+j.
    pub(crate) fn widths(&self) -> [i128; 3] {
        [0, 1, 2].each(|n| self.upper[n] - self.lower[n])
    }

    /// Returns the number of erosions of one sign after which each of the three sides that they shorten vanishes.
    pub(crate) const fn vanishing_sides(&self, sign: Sign) -> [i128; 3] {
        let ([x0, y0, s0], [x1, y1, s1]) = (self.lower, self.upper);
        match sign {
            Sign::Plus => [x0 + y1 - s0, y0 + x1 - s0, x1 + y1 - s1],
            Sign::Minus => [s1 - y0 - x1, s1 - x0 - y1, s0 - x0 - y0],
        }
    }

    /// Returns the layer that is this many + and − steps further down. The bounds must stay within `i128`.
    #[doc(hidden)]
    #[inline]
    #[must_use]
    pub fn grown(&self, plus: i128, minus: i128) -> Self {
        Self {
            lower: self.lower.each(|bound| bound - minus),
            upper: self.upper.each(|bound| bound + plus),
        }
    }

    /// Returns the layer that is this many + and − steps further up, or `None` if it is empty.
    #[doc(hidden)]
    #[must_use]
    pub fn shrunk(&self, plus: i128, minus: i128) -> Option<Self> {
        self.grown(-plus, -minus).tightened()
    }

    /// Returns the rows from y₀ to y₁, as rows of layer `k`. Each of them contains a site.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Region, Row};
    ///
    /// let mut rows = Region::triangle(3)?.rows(2);
    /// assert_eq!(rows.nth(1), Some(Row { k: 2, j: 1, i: 0..2 }));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn rows(&self, k: i128) -> impl Iterator<Item = Row> + use<> {
        let region = *self;
        self.y().map(move |j| {
            let i = region.row(j);
            Row { k, j, i }
        })
    }

    /// Tightens all six bounds once, each by the old values of the others. After this one round some site attains each
    /// bound. Returns `None` if the region is empty.
    fn tightened(&self) -> Option<Self> {
        let ([x0, y0, s0], [x1, y1, s1]) = (self.lower, self.upper);
        let tight = Self {
            lower: [x0.max(s0 - y1), y0.max(s0 - x1), s0.max(x0 + y0)],
            upper: [x1.min(s1 - y0), y1.min(s1 - x0), s1.min(x1 + y1)],
        };
        let holds = tight
            .lower
            .iter()
            .zip(&tight.upper)
            .all(|(lower, upper)| lower <= upper);
        holds.then_some(tight)
    }

    fn is_within_limit(&self) -> bool {
        let mut bounds = self.lower.iter().chain(&self.upper);
        bounds.all(|bound| (-LIMIT..=LIMIT).contains(bound))
    }
}

/// Returns the number of sites of a parallelogram with these sides, without two triangles at its corners. `corners` are
/// the sides of these triangles.
fn sites<I: Integer + Clone>([width, height]: [I; 2], corners: [I; 2]) -> I {
    let two = I::one() + I::one();
    let triangle = |side: I| side.clone() * (side + I::one()) / two.clone();
    let [first, second] = corners.each(triangle);
    width * height - first - second
}

impl fmt::Display for Region {
    /// Prints the bounds, `x0..x1,y0..y1,s0..s1`. The format `{:#}` prints the shape by its sides, such as
    /// `triangle:4`, if it is a triangle or hexagon about (0, 0). Otherwise it prints `region:` before the bounds.
    /// [`FromStr`] reads both forms.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    ///
    /// let hexagon = Region::hexagon(3, 2)?;
    /// assert_eq!(format!("{hexagon}"), "-1..2,-1..2,-1..2");
    /// assert_eq!(format!("{hexagon:#}"), "hexagon:3,2");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([x0, y0, s0], [x1, y1, s1]) = (self.lower, self.upper);
        let mut kind = "";
        if f.alternate() {
            // The bounds are within ±10³⁶, so this cannot overflow.
            let (p, q) = (x1 + 1, 1 - x0);
            let about_zero = Self::hexagon(p, q).as_ref() == Ok(self);
            match (about_zero, p, q) {
                (true, 2.., 1) => return padded(f, format_args!("triangle:{p}")),
                (true, ..) if p == q => return padded(f, format_args!("hexagon:{p}")),
                (true, ..) => return padded(f, format_args!("hexagon:{p},{q}")),
                (false, ..) => kind = "region:",
            }
        }
        padded(f, format_args!("{kind}{x0}..{x1},{y0}..{y1},{s0}..{s1}"))
    }
}

impl FromStr for Region {
    type Err = Error;

    /// Parses `hexagon:P,Q`, `hexagon:N`, `triangle:N` or `region:x0..x1,y0..y1,s0..s1` with bounds included. The
    /// prefix `region:` is optional.
    ///
    /// # Errors
    /// [`Error::Syntax`]; the errors of [`Region::new`] and [`Region::hexagon`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    ///
    /// assert_eq!("hexagon:3,2".parse(), Region::hexagon(3, 2));
    /// assert_eq!("hexagon:3".parse(), Region::hexagon(3, 3));
    /// assert_eq!("triangle:4".parse(), Region::triangle(4));
    /// assert_eq!("region:0..3,0..3,0..3".parse(), Region::triangle(4));
    /// assert_eq!("0..3,0..3,0..3".parse(), Region::triangle(4));
    /// assert!("circle:4".parse::<Region>().is_err());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    fn from_str(text: &str) -> Result<Self, Error> {
        let syntax = || {
            Error::syntax(
                text,
                "a shape: hexagon:P,Q, hexagon:N, triangle:N or region:x0..x1,y0..y1,s0..s1",
            )
        };
        let (kind, sizes) = text.split_once(':').unwrap_or(("region", text));
        match kind {
            "hexagon" => {
                let (p, q) = sizes.split_once(',').unwrap_or((sizes, sizes));
                Self::hexagon(integer(p)?, integer(q)?)
            }
            "triangle" => Self::triangle(integer(sizes)?),
            "region" => {
                let mut ranges = sizes.split(',').map(|range| {
                    let (from, to) = range.split_once("..").ok_or_else(syntax)?;
                    Ok(integer(from)?..=integer(to)?)
                });
                let mut next = || ranges.next().unwrap_or_else(|| Err(syntax()));
                let (x, y, s) = (next()?, next()?, next()?);
                match ranges.next() {
                    None => Self::new(x, y, s),
                    Some(_) => Err(syntax()),
                }
            }
            _ => Err(syntax()),
        }
    }
}

#[cfg(feature = "serde")]
crate::data::as_text!(Region: ":#");

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use super::*;

    #[test]
    fn above_keeps_sites_with_coordinates_at_least_those_given() {
        let region = Region::new(-2..=3, -1..=4, -2..=5).unwrap();
        let sites = |region: Region| region.rows(0).flatten();
        for (x, s) in (-3..=4).flat_map(|x| (-3..=7).map(move |s| (x, s))) {
            let wanted = sites(region).filter(|site| site.i >= x && site.i + site.j >= s);
            let above = region.above([x, s]).into_iter().flat_map(sites);
            assert_eq!(
                above.collect::<Vec<_>>(),
                wanted.collect::<Vec<_>>(),
                "{x} {s}"
            );
        }
    }
}
