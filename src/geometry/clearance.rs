//! The range of spacings without overlap.
//!
//! # Decisive pairs of spheres
//! Two spheres of a pile of L layers can differ by n = (n_a, n_b, n_c) if both the positive and the negative parts of n
//! sum to at most L−1. They overlap if the form [`squared_distance`] is below 1 at n. With σ = sin²θ this form is m² +
//! σ(h(n) − m²), linear in σ. Here m = n_a+n_b+n_c counts the layers between them, and σh(n) is the squared horizontal
//! distance. So every n gives one bound on σ, and the allowed spacings are an interval.
//!
//! Finitely many n suffice for every L. The neighbours (1,−1,0), (1,0,−1), (0,1,−1) in a layer give the lower bounds.
//! The differences with 1 ≤ m ≤ 3, |n_a−n_b| ≤ 1 and −1 ≤ n_a+n_b ≤ 4 give the upper bounds. No other pairs can touch.
//!
//! Other stackings have one upper bound, from spheres vertically above each other. At a sign change these spheres are
//! two layers apart, and q ≤ 9/4. In a straight stacking of at least four layers they are three layers apart, and q ≤
//! 8/3. The lemma and its proof are in [`paper`](crate::paper#overlap).

use alloc::vec::Vec;
use core::cmp::Ordering;
use core::fmt;

use exact_surd::layout::padded;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::{Inclination, Spacing, square_per_sin2, squared_distance};
use crate::Error;
use crate::each::Each;
use crate::lattice::Dimension;
use crate::scalar::ByValue;
use crate::shape::Shape;
use crate::sorted::distinct;

/// The difference of the layers of two spheres that touch or overlap.
///
/// # Examples
/// ```
/// use cannonpile::geometry::LayerGap;
///
/// assert_eq!(LayerGap { layers: 0 }.to_string(), "in one layer");
/// assert_eq!(LayerGap { layers: 3 }.to_string(), "3 layers apart");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(::serde::Serialize, ::serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub struct LayerGap {
    /// The difference of their layers. It is 0 for neighbours in one layer.
    pub layers: u8,
}

impl fmt::Display for LayerGap {
    /// Prints `in one layer` or, for example, `3 layers apart`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.layers {
            0 => padded(f, format_args!("in one layer")),
            1 => padded(f, format_args!("1 layer apart")),
            m => padded(f, format_args!("{m} layers apart")),
        }
    }
}

/// The value of q at which a pair of spheres touches, with the difference of their layers.
type Touch = (BigRational, LayerGap);

/// The spacings a/R at which no two spheres of a pile overlap.
///
/// [`Pile::clearance`](crate::Pile::clearance) returns it. For an equilateral base and L ≥ 4 layers the range is 1 ≤
/// a/R ≤ √(8/3). At these bounds further spheres touch.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
///
/// let clearance = Pile::triangular(10)?.clearance();
/// assert!(clearance.check(&"1.63".parse()?).is_ok());
/// assert!(clearance.check(&"1.64".parse()?).is_err());
/// // At a = R, the fcc pile, horizontal neighbours touch.
/// let touching = clearance.check(&"1".parse()?)?;
/// assert_eq!(touching[0].to_string(), "in one layer");
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Clearance {
    layers: i128,
    dimension: Dimension,
    s: BigRational,
    /// Pairs that overlap if q is too small.
    lower: Vec<Touch>,
    /// Pairs that overlap if q is too great.
    upper: Vec<Touch>,
}

impl Clearance {
    /// Returns the range for a pile with these sites and sin φ = `s`. For discs `s` must be 0.
    pub(crate) fn new(shape: &Shape, s: &BigRational) -> Self {
        if shape.is_pyramid() {
            Self::of_pyramid(shape, s)
        } else {
            Self::of_stacking(shape, s)
        }
    }

    /// Returns the range for any stacking on an equilateral base (see the module documentation).
    fn of_stacking(shape: &Shape, s: &BigRational) -> Self {
        let ratio = |n: i64, d: i64| BigRational::new(n.into(), d.into());
        let touch = |q, layers| (q, LayerGap { layers });
        let neighbours = shape.base().widths().iter().any(|width| *width > 0);
        let lower = neighbours.then(|| touch(ratio(1, 1), 0));
        let upper = match (shape.stacking().is_straight(), shape.layers()) {
            (false, _) => Some(touch(ratio(9, 4), 2)),
            (true, 4..) => Some(touch(ratio(8, 3), 3)),
            (true, _) => None,
        };
        Self {
            layers: shape.layers(),
            dimension: shape.dimension(),
            s: s.clone(),
            lower: lower.into_iter().collect(),
            upper: upper.into_iter().collect(),
        }
    }

    fn of_pyramid(pyramid: &Shape, s: &BigRational) -> Self {
        let lines = pyramid.dimension().directions().len();
        let flat = square_per_sin2(pyramid.dimension());
        let (mut lower, mut upper) = (Vec::new(), Vec::new());
        for (layers, n) in candidates() {
            if !occurs(n, pyramid.layers()) || n.iter().skip(lines).any(|c| *c != 0) {
                continue;
            }
            let vector = n.each(|n| BigRational::from_integer(n.into()));
            let at_zero = squared_distance(&vector, s, &BigRational::zero());
            let slope = squared_distance(&vector, s, &BigRational::one()) - &at_zero;
            if slope.is_zero() {
                continue;
            }
            // The condition is at_zero + σ·slope ≥ 1.
            let sin2 = (BigRational::one() - at_zero) / &slope;
            let apart = LayerGap { layers };
            if slope.is_positive() {
                lower.push((sin2 * &flat, apart));
            } else if sin2 < BigRational::one() {
                // The remaining bounds lie at θ ≥ 90°, which `check` excludes.
                upper.push((sin2 * &flat, apart));
            }
        }
        Self {
            layers: pyramid.layers(),
            dimension: pyramid.dimension(),
            s: s.clone(),
            lower,
            upper,
        }
    }

    /// Returns the least allowed spacing, or `None` if no two spheres are neighbours in a layer.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// let least = Pile::triangular(10)?.clearance().least();
    /// assert_eq!(least.map(|spacing| spacing.to_string()), Some("1".into()));
    /// assert_eq!(Pile::triangular(1)?.clearance().least(), None);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn least(&self) -> Option<Spacing> {
        let (bound, _) = self.lower.iter().max_by_key(|(bound, _)| ByValue(bound))?;
        Spacing::from_square(bound.clone()).ok()
    }

    /// Returns the greatest allowed spacing, or `None` if every spacing with θ < 90° is allowed. The latter holds for
    /// up to three layers on an equilateral base.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// let most = Pile::triangular(4)?.clearance().most();
    /// assert_eq!(most.map(|spacing| spacing.to_string()), Some("2/3*sqrt(6)".into()));
    /// assert_eq!(Pile::triangular(3)?.clearance().most(), None);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn most(&self) -> Option<Spacing> {
        let (bound, _) = self.upper.iter().min_by_key(|(bound, _)| ByValue(bound))?;
        Spacing::from_square(bound.clone()).ok()
    }

    /// Checks exactly that no spheres overlap at this spacing. Returns the layer differences of the spheres that touch
    /// in addition to the contacts α, β, γ. Such spheres exist only at the bounds.
    ///
    /// # Errors
    /// [`Error::NoSpacing`] if no spacing is possible for this sin φ; [`Error::Overlap`], with the allowed spacings;
    /// [`Error::TooFlat`] if θ would reach 90°.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::LayerGap;
    /// use cannonpile::{Error, Pile};
    ///
    /// let clearance = Pile::triangular(10)?.clearance();
    /// assert_eq!(clearance.check(&"2/3*sqrt(6)".parse()?)?, [LayerGap { layers: 3 }]);
    /// let wide = "sqrt(17/6)".parse()?;
    /// assert!(matches!(clearance.check(&wide), Err(Error::Overlap { .. })));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn check(&self, spacing: &Spacing) -> Result<Vec<LayerGap>, Error> {
        let (least, most) = (self.least(), self.most());
        if let Some(least) = &least {
            let room = match &most {
                Some(most) => ByValue(least.square()) <= ByValue(most.square()),
                None => *least.square() < square_per_sin2(self.dimension),
            };
            if !room {
                return Err(Error::NoSpacing {
                    sin_phi: self.s.clone(),
                    layers: self.layers,
                });
            }
        }
        let mut touching = Vec::new();
        for (bounds, wrong) in [
            (&self.lower, Ordering::Less),
            (&self.upper, Ordering::Greater),
        ] {
            for (bound, apart) in bounds {
                let order = ByValue(spacing.square()).cmp(&ByValue(bound));
                if order == wrong {
                    let bounds = (least, most);
                    return Err(Error::overlap(spacing, *apart, bounds));
                }
                if order.is_eq() {
                    touching.push(*apart);
                }
            }
        }
        Inclination::new(spacing, self.dimension)?;
        Ok(distinct(touching))
    }
}

/// Returns the decisive differences n (see the module documentation), one of each ±n, with the difference of the
/// layers.
fn candidates() -> impl Iterator<Item = (u8, [i128; 3])> {
    let neighbours = [[1, -1, 0], [1, 0, -1], [0, 1, -1]].each(|n| (0, n));
    let stacked = (1..=3_u8).flat_map(|m| {
        (-1..=4).flat_map(move |t: i128| {
            (-1..=1)
                .filter(move |d| (t + d) % 2 == 0)
                .map(move |d| t.midpoint(d))
                .map(move |a| (m, [a, t - a, i128::from(m) - t]))
        })
    });
    neighbours.into_iter().chain(stacked)
}

/// Returns whether two spheres of a pile of L layers can differ by n, for m ≥ 0. The negative parts of n then sum to at
/// most the positive parts.
fn occurs(n: [i128; 3], layers: i128) -> bool {
    let rise: i128 = n.iter().map(|c| (*c).max(0)).sum();
    rise < layers
}
