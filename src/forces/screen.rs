//! A screen for extreme bottom spheres. Correctly rounded floats exclude most spheres, and exact integers compare the
//! rest.
//!
//! Correct rounding is monotonic. So the smallest normal force is among the forces with the smallest float, and the
//! largest force among those with the largest float.
//!
//! Let r = (x² + c·y²)/n² be the squared ratio of shear to normal force, with c = 4cos²φ. Ten rounding errors enter its
//! float r′, where those of a repeated factor count twice. With u = 2^−53, |r′ − r| ≤ 11u·r + 2^−796. This needs 2^−100
//! ≤ |n| < 2^200, |x| and |y| < 2^200, and 2^−100 ≤ c ≤ 4. The second term is the loss of squares below 2^−1000,
//! divided by n² ≥ 2^−200.
//!
//! Let r be the largest ratio and m the largest float. Then r′ ≥ (1 − 11u)/(1 + 11u)·m − 2^−795, which exceeds
//! (1 − 32u)·m for m ≥ 2^−700. Values beyond these bounds are compared as exact integers, and so are spheres with extra
//! weight. The same inequalities hold with the extremes found so far in place of the extremes of all.

use alloc::vec::Vec;

use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::terms::Terms;
use crate::Error;
use crate::each::Each;
use crate::engine::{Descent, Planes, Readout, Unit};
use crate::error::bug;
use crate::lattice::{Row, Site};
use crate::scalar::{Ring, Surd};

/// The bounds 2^−700, 2^−100 and 2^200.
const TINY: f64 = f64::from_bits(323 << 52);
const SMALL: f64 = f64::from_bits(923 << 52);
const GREAT: f64 = f64::from_bits(1223 << 52);

/// The extremes of the floats found so far, for comparison with the floats of each sphere.
pub(super) struct Screen<'s, 'p> {
    sweep: &'s Descent<'p, BigRational, Planes>,
    readout: Readout,
    units: [Unit; 3],
    /// 4cos²φ.
    across: f64,
    /// The spheres with loads or with a weight of their own.
    extras: Vec<Site>,
    least: f64,
    most: f64,
    /// The largest squared ratio so far.
    ratio: f64,
}

/// The float of a normal force, and the squared ratio if its error is bounded.
type Floats = (f64, Option<f64>);

impl<'s, 'p> Screen<'s, 'p> {
    /// Returns the screen for the base that a sweep has reached, or `None` if its floats are not available.
    pub(super) fn new(
        (terms, sweep): (
            &Terms<'_, BigRational>,
            &'s Descent<'p, BigRational, Planes>,
        ),
        across: &BigRational,
    ) -> Option<Self> {
        let one = || Surd::from(BigRational::from_i128(1));
        let across = Surd::from(across.clone()).nearest::<f64>();
        Some(Self {
            sweep,
            readout: terms.floor_readout()?,
            units: terms.floor_units(&[one(), one(), one()]),
            across: across.filter(|c| *c >= SMALL)?,
            extras: terms.lines.extras_in(sweep.k()..sweep.k() + 1).collect(),
            least: f64::INFINITY,
            most: f64::NEG_INFINITY,
            ratio: 0.0,
        })
    }

    /// Returns the spheres of a row that may be extreme among all spheres so far.
    ///
    /// # Errors
    /// [`Error::Bug`].
    pub(super) fn candidates(&mut self, row: Row) -> Result<Vec<Site>, Error> {
        let Some(floats) = self.floats(&row)? else {
            return Ok(row.into_iter().collect());
        };
        let spheres = || row.clone().into_iter().zip(&floats);
        for (_, (normal, ratio)) in
            spheres().filter(|(site, _)| self.extras.binary_search(site).is_err())
        {
            self.least = self.least.min(*normal);
            self.most = self.most.max(*normal);
            self.ratio = ratio.map_or(self.ratio, |ratio| self.ratio.max(ratio));
        }
        let greatest = if self.ratio < TINY {
            0.0
        } else {
            self.ratio * (1.0 - 16.0 * f64::EPSILON)
        };
        let can_be = |(site, (normal, ratio)): &(Site, &Floats)| {
            *normal <= self.least
                || *normal >= self.most
                || ratio.is_none_or(|ratio| ratio >= greatest)
                || self.extras.binary_search(site).is_ok()
        };
        Ok(spheres().filter(can_be).map(|(site, _)| site).collect())
    }

    fn floats(&self, row: &Row) -> Result<Option<Vec<Floats>>, Error> {
        let spheres = (row.i.end - row.i.start).to_usize();
        let spheres = spheres.ok_or_else(|| bug("a row of a sweep fits in memory"))?;
        let mut floats = [(); 3].each(|()| alloc::vec![0.0_f64; spheres]);
        let out = floats.each_mut().each(Vec::as_mut_slice);
        if !self
            .sweep
            .nearest_row(row, (&self.readout, &self.units), out)?
        {
            return Ok(None);
        }
        let [normal, x, y] = floats;
        let floats = normal.into_iter().zip(x.into_iter().zip(y));
        let floats = floats.map(|(n, (x, y))| {
            let known = (SMALL..GREAT).contains(&n.abs()) && x.abs().max(y.abs()) < GREAT;
            (n, known.then(|| (x * x + self.across * (y * y)) / (n * n)))
        });
        Ok(Some(floats.collect()))
    }
}
