//! The difference between a measured and an exact force, as numbers and as text.

use core::fmt;

use super::measured::{Measured, distance};
use crate::{Each, NumberedContact};
use cannonpile::lattice::{ContactKind, Dimension, Site};

/// A contact of the pile with its exact force and the measured one.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Difference {
    /// The numbers of the upper and the lower sphere.
    pub ids: [u64; 2],
    /// The upper sphere.
    pub site: Site,
    /// The direction from the upper to the lower sphere.
    pub direction: ContactKind,
    /// The exact force, correctly rounded, in N; compressive forces are positive.
    pub exact: f64,
    /// The exact force on the upper sphere, correctly rounded, in N; only if vectors were measured.
    pub exact_vector: Option<[f64; 3]>,
    /// The measured force, with its vector on the upper sphere; `None` for a missing contact.
    pub measured: Option<Measured>,
    /// The relative error; 1 for a missing contact.
    pub error: f64,
    /// The dimension: sites of discs have no j.
    pub(super) dimension: Dimension,
}

/// A pair of spheres that has a measured force, but no contact in the pile.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Extra {
    /// The numbers of the two spheres, the smaller first.
    pub ids: [u64; 2],
    /// The two spheres.
    pub sites: [Site; 2],
    /// The measured force in N, or the magnitude of its vector if that is greater.
    pub force: f64,
    /// The ratio of this force to the largest exact force of the pile.
    pub error: f64,
    pub(super) dimension: Dimension,
}

impl Difference {
    /// Returns the difference for a contact that was not measured.
    pub(super) fn missing(
        exact: &NumberedContact,
        with_vectors: bool,
        dimension: Dimension,
    ) -> Self {
        Self {
            ids: exact.ids,
            site: exact.site,
            direction: exact.direction,
            exact: exact.force,
            exact_vector: with_vectors.then_some(exact.vector),
            measured: None,
            error: 1.0,
            dimension,
        }
    }

    /// Returns the measured and the exact vector, if they differ by more than their magnitudes do.
    fn vectors(&self) -> Option<[(f64, f64, f64); 2]> {
        let measured = self.measured?;
        let (vector, exact) = measured.vector.zip(self.exact_vector)?;
        let differ = distance(vector, exact) > (measured.force - self.exact).abs();
        differ.then_some([vector, exact].each(Into::into))
    }
}

impl fmt::Display for Difference {
    /// Writes `contact of sphere 17 (k=3, i=1, j=0) with sphere 31 along alpha: measured 1.23 N, exact 1.27 N`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [upper, lower] = self.ids;
        let (place, direction) = (Place(self.site, self.dimension), self.direction);
        write!(
            f,
            "contact of sphere {upper} ({place}) with sphere {lower} along {direction}: "
        )?;
        let exact = self.exact;
        match (self.measured, self.vectors()) {
            (None, _) => write!(f, "not measured, exact {exact:?} N"),
            (Some(_), Some([measured, exact])) => write!(
                f,
                "measured {measured:?} N on the upper one, exact {exact:?} N"
            ),
            (Some(measured), None) => {
                write!(f, "measured {:?} N, exact {exact:?} N", measured.force)
            }
        }
    }
}

impl fmt::Display for Extra {
    /// Writes `spheres 17 (k=3, i=1, j=0) and 18 (k=3, i=2, j=0) have no contact: measured 0.5 N`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([first, second], [one, other]) = (self.ids, self.sites);
        let [one, other] = [one, other].each(|site| Place(site, self.dimension));
        write!(
            f,
            "spheres {first} ({one}) and {second} ({other}) have no contact: measured {:?} N",
            self.force
        )
    }
}

/// The indices of a site as text: `k=3, i=1, j=0`, without j for discs.
struct Place(Site, Dimension);

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Site { i, j, k } = self.0;
        write!(f, "k={k}, i={i}")?;
        match self.1 {
            Dimension::Two => Ok(()),
            Dimension::Three => write!(f, ", j={j}"),
        }
    }
}
