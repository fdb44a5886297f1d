//! The stiffness of linear springs that explains the errors of a simulation.

use crate::error::bug;
use crate::{Compliance, Error};
use cannonpile::Packing;

/// The square of the errors that are left, as a share of that of all errors.
const LEFT: f64 = 0.05;

/// Returns the stiffness in N/m, if the [errors of springs](Compliance) are known and explain the relative errors of all
/// contacts, in their order from the top.
pub(super) fn stiffness(
    packing: &Packing<'_>,
    errors: &[f64],
    with_vectors: bool,
) -> Result<Option<f64>, Error> {
    let mut coefficients = Vec::with_capacity(errors.len());
    let compliance = Compliance::inspected(packing, |contact| {
        coefficients.push(if with_vectors {
            contact.vector_coefficient
        } else {
            contact.coefficient.abs()
        });
    });
    let Ok(compliance) = compliance else {
        return Ok(None);
    };
    if coefficients.len() != errors.len() {
        return Err(bug("each contact has one error"));
    }
    let (mut both, mut squares, mut of_coefficients) = (0.0, 0.0, 0.0);
    for (coefficient, error) in coefficients.iter().zip(errors) {
        both += coefficient * error;
        squares += error * error;
        of_coefficients += coefficient * coefficient;
    }
    let is_explained = squares - both * both / of_coefficients <= LEFT * squares;
    // The error is the coefficient times the unit over the stiffness.
    let stiffness = compliance.unit() * of_coefficients / both;
    Ok((is_explained && stiffness.is_finite()).then_some(stiffness))
}
