//! Where a measured force is not the exact one, in numbers and in words.

use core::fmt;

use super::measured::{Measured, distance};
use crate::NumberedContact;
use cannonpile::lattice::{ContactKind, Dimension, Site};

/// A contact of the pile, what its force is, and what was measured.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Difference {
    /// The numbers of the upper sphere and of the lower one.
    pub ids: [u64; 2],
    /// The upper sphere.
    pub site: Site,
    /// The direction in which the lower one lies.
    pub direction: ContactKind,
    /// The nearest float to the exact force; positive is push.
    pub exact: f64,
    /// The nearest floats to the force on the upper sphere, where vectors were measured.
    pub exact_vector: Option<[f64; 3]>,
    /// What was measured, with the force on the upper sphere; nothing for a missing contact.
    pub measured: Option<Measured>,
    /// The relative error; 1 for a missing contact.
    pub error: f64,
    /// Of discs or of spheres, which have a j.
    pub(super) dimension: Dimension,
}

/// A pair of spheres with a force, but no contact of the pile.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Extra {
    /// The numbers of the two, the lesser first.
    pub ids: [u64; 2],
    /// The two spheres.
    pub sites: [Site; 2],
    /// The force that was measured: the magnitude of the vector, if that is the greater.
    pub force: f64,
    /// That force over the largest exact one of the pile.
    pub error: f64,
    pub(super) dimension: Dimension,
}

impl Difference {
    /// A contact that was not measured.
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

    /// The vectors, measured and exact, if they differ by more than the magnitudes do.
    fn vectors(&self) -> Option<[(f64, f64, f64); 2]> {
        let measured = self.measured?;
        let (vector, exact) = measured.vector.zip(self.exact_vector)?;
        let differ = distance(vector, exact) > (measured.force - self.exact).abs();
        differ.then_some([vector, exact].map(Into::into))
    }
}

impl fmt::Display for Difference {
    /// `contact of sphere 17 (k=3, i=1, j=0) with sphere 31 along alpha: measured 1.23 N, exact 1.27 N`.
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
    /// `spheres 17 (k=3, i=1, j=0) and 18 (k=3, i=2, j=0) have no contact: measured 0.5 N`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([first, second], [one, other]) = (self.ids, self.sites);
        let [one, other] = [one, other].map(|site| Place(site, self.dimension));
        write!(
            f,
            "spheres {first} ({one}) and {second} ({other}) have no contact: measured {:?} N",
            self.force
        )
    }
}

/// `k=3, i=1, j=0`; no j for discs.
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
