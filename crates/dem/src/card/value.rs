//! A number of a card.

use num_rational::BigRational;

use crate::Error;
use crate::numbered::nearest;
use cannonpile::scalar::Surd;

pub(super) const FORCE: &str = "a contact force";

/// An exact number, and the float nearest to it.
#[derive(Clone)]
pub(super) struct Value {
    pub(super) exact: String,
    pub(super) float: f64,
}

impl Value {
    pub(super) fn new(number: &Surd, quantity: &'static str) -> Result<Self, Error> {
        Ok(Self {
            exact: number.to_string(),
            // Not −0.
            float: nearest(number, quantity)? + 0.0,
        })
    }

    pub(super) fn rational(number: BigRational, quantity: &'static str) -> Result<Self, Error> {
        Self::new(&number.into(), quantity)
    }
}
