//! The stiffness of linear springs that explains the errors of a simulation.

use crate::Compliance;
use cannonpile::Packing;

/// The square of the errors that are left, as a share of that of all errors.
const LEFT: f64 = 0.05;

/// Returns the stiffness in N/m, if the [errors of springs](Compliance) explain the relative errors of all contacts, in their
/// order from the top.
pub(super) fn stiffness(packing: &Packing<'_>, errors: &[f64], with_vectors: bool) -> Option<f64> {
    let (mut both, mut squares, mut coefficients) = (0.0, 0.0, 0.0);
    let mut errors = errors.iter();
    let compliance = Compliance::inspected(packing, |contact| {
        let coefficient = if with_vectors {
            contact.vector_coefficient
        } else {
            contact.coefficient.abs()
        };
        let error = errors.next().unwrap_or(&f64::NAN);
        both += coefficient * error;
        squares += error * error;
        coefficients += coefficient * coefficient;
    });
    let is_explained = squares - both * both / coefficients <= LEFT * squares;
    // The error is the coefficient times the unit over the stiffness.
    let stiffness = compliance.ok()?.unit() * coefficients / both;
    (is_explained && stiffness.is_finite()).then_some(stiffness)
}
