//! Which spacings leave room for the spheres.
//!
//! # Which pairs of spheres decide
//! Two spheres of a pile of L layers differ by n = (n_a, n_b, n_c) if both the positive and the negative
//! parts of n sum to at most L−1. They overlap if the form [`squared_distance`] is below 1 at n. With
//! σ = sin²θ it is m² + σ(h(n) − m²), linear in σ, where m = n_a+n_b+n_c counts the layers between them
//! and σh(n) is the squared horizontal distance. So every n sets one bound on σ, and the allowed
//! spacings are an interval.
//!
//! Finitely many n suffice, whatever L is: the neighbours (1,−1,0), (1,0,−1), (0,1,−1) of a layer, which give the lower
//! bounds, and those with 1 ≤ m ≤ 3, |n_a−n_b| ≤ 1 and −1 ≤ n_a+n_b ≤ 4, which give the upper ones; the same n are all that
//! touch. Other stackings have one upper bound, from spheres straight above each other: two layers apart at a change
//! of sign, q ≤ 9/4, else three, q ≤ 8/3. The lemma and its reason are in [`paper`](crate::paper#overlap).

use alloc::vec::Vec;
use core::cmp::Ordering;
use core::fmt;

use exact_surd::layout::padded;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::{Inclination, Spacing, square_per_sin2, squared_distance};
use crate::Error;
use crate::lattice::Dimension;
use crate::scalar::Ring;
use crate::shape::Shape;

/// How far apart two spheres are that touch, or would overlap.
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
    /// The number of layers between them, 0 for neighbours of one layer.
    pub layers: u8,
}

impl fmt::Display for LayerGap {
    /// Prints `in one layer`, `3 layers apart`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.layers {
            0 => padded(f, format_args!("in one layer")),
            1 => padded(f, format_args!("1 layer apart")),
            m => padded(f, format_args!("{m} layers apart")),
        }
    }
}

/// A pair of spheres that may come too close, with the q at which it touches.
type Touch = (BigRational, LayerGap);

/// The spacings a pile allows: those at which no two of its spheres overlap.
///
/// [`Pile::clearance`](crate::Pile::clearance) makes it. On an equilateral base of L ≥ 4 layers 1 ≤ a/R ≤ √(8/3); at the
/// bounds further spheres touch.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
///
/// let clearance = Pile::triangular(10)?.clearance();
/// assert!(clearance.check(&"1.63".parse()?).is_ok());
/// assert!(clearance.check(&"1.64".parse()?).is_err());
/// // a = R is the FCC stack: horizontal neighbours touch.
/// let touching = clearance.check(&"1".parse()?)?;
/// assert_eq!(touching[0].to_string(), "in one layer");
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Clearance {
    layers: i128,
    dimension: Dimension,
    s: BigRational,
    /// Pairs that come too close when q is too small.
    lower: Vec<Touch>,
    /// Pairs that come too close when q is too great.
    upper: Vec<Touch>,
}

impl Clearance {
    /// Returns the bounds for a pile of these sites with sin φ = `s`; for discs `s` must be 0.
    pub(crate) fn new(shape: &Shape, s: &BigRational) -> Self {
        if shape.is_pyramid() {
            Self::of_pyramid(shape, s)
        } else {
            Self::of_stacking(shape, s)
        }
    }

    /// On an equilateral base, of any stacking (module documentation).
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
            let vector = n.map(BigRational::from_i128);
            let at_zero = squared_distance(&vector, s, &BigRational::zero());
            let slope = squared_distance(&vector, s, &BigRational::one()) - &at_zero;
            if slope.is_zero() {
                continue;
            }
            // at_zero + σ·slope ≥ 1
            let sin2 = (BigRational::one() - at_zero) / &slope;
            let apart = LayerGap { layers };
            if slope.is_positive() {
                lower.push((sin2 * &flat, apart));
            } else if sin2 < BigRational::one() {
                // Other bounds are not reached before the contacts are horizontal.
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

    /// Returns the least allowed spacing, or `None` for one sphere, which sets no lower bound.
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
        let (bound, _) = self.lower.iter().max_by(|a, b| a.0.cmp(&b.0))?;
        Spacing::from_square(bound.clone()).ok()
    }

    /// Returns the greatest allowed spacing, or `None` where any with θ < 90° is allowed (up to three layers on an
    /// equilateral base).
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
        let (bound, _) = self.upper.iter().min_by(|a, b| a.0.cmp(&b.0))?;
        Spacing::from_square(bound.clone()).ok()
    }

    /// Checks, exactly, that the spheres have room. Returns which of them touch, other than at the contacts α, β, γ:
    /// none in general, some at the bounds.
    ///
    /// # Errors
    /// [`Error::NoSpacing`] if no spacing at all fits this sin φ, [`Error::Overlap`] with the allowed
    /// spacings, [`Error::TooFlat`] if θ would reach 90°.
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
                Some(most) => least.square() <= most.square(),
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
                let order = spacing.square().cmp(bound);
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
        touching.sort_unstable();
        touching.dedup();
        Ok(touching)
    }
}

/// The differences that may overlap (module documentation), one of each ±n, with the layers between.
fn candidates() -> impl Iterator<Item = (u8, [i128; 3])> {
    let neighbours = [[1, -1, 0], [1, 0, -1], [0, 1, -1]].map(|n| (0, n));
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

/// Whether two spheres of a pile of L layers are n apart, for m ≥ 0: the negative parts of n sum to no more than the positive.
fn occurs(n: [i128; 3], layers: i128) -> bool {
    let rise: i128 = n.iter().map(|c| (*c).max(0)).sum();
    rise < layers
}
