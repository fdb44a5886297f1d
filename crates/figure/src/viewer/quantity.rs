//! The distinct exact values of a quantity, as multiples of a unit and as correctly rounded floats.

use std::collections::HashMap;

use cannonpile::engine::{bug, common_denominator, refuse_beyond};
use cannonpile::scalar::Surd;
use cannonpile_dem::Error;
use cannonpile_dem::numbered::nearest;
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use serde_json::{Value, json};

use super::encoding::floats;

/// The largest total number of decimal digits of the numerators of a quantity.
const MAX_DIGITS: u64 = 30_000_000;

/// The distinct values of a quantity.
pub(super) struct Quantity {
    /// The unit, as in tables.
    unit: &'static str,
    /// The unit in N.
    newtons: Surd,
    /// The name of the quantity in error messages.
    name: &'static str,
    numbers: Vec<BigRational>,
    /// The position of each value in the list, by numerator and denominator.
    places: HashMap<(BigInt, BigInt), u32>,
}

impl Quantity {
    pub(super) fn new(unit: &'static str, newtons: Surd, name: &'static str) -> Self {
        Self {
            unit,
            newtons,
            name,
            numbers: Vec::new(),
            places: HashMap::new(),
        }
    }

    /// Returns the position of a value in the list, and inserts it if it is new.
    pub(super) fn place(&mut self, number: BigRational) -> Result<u32, Error> {
        let key = (number.numer().clone(), number.denom().clone());
        if let Some(place) = self.places.get(&key) {
            return Ok(*place);
        }
        // Each number has a digit.
        self.refuse_beyond_limit(self.numbers.len() as u64)?;
        let new = u32::try_from(self.numbers.len())
            .map_err(|_| bug("the limit of digits fits in 32 bits"))?;
        self.places.insert(key, new);
        self.numbers.push(number);
        Ok(new)
    }

    fn refuse_beyond_limit(&self, digits: u64) -> Result<(), Error> {
        let remedy = "use fewer layers, or loads with one small denominator";
        Ok(refuse_beyond(self.name, digits, MAX_DIGITS, remedy)?)
    }

    /// Returns the list: numerators over a common denominator, and the correctly rounded multiples and forces in N.
    pub(super) fn to_json(&self) -> Result<Value, Error> {
        let denominator = common_denominator(&self.numbers);
        // A bit is about 0.302 decimal digits.
        let digits = self.numbers.iter();
        let bits = digits.map(|x| x.numer().bits() + denominator.bits() - x.denom().bits());
        let digits = bits.map(|bits| bits * 302 / 1000 + 1).sum();
        self.refuse_beyond_limit(digits)?;
        let numerators = self.numbers.iter();
        let numerators = numerators.map(|x| (x.numer() * (&denominator / x.denom())).to_string());
        let numerators: Vec<String> = numerators.collect();
        let multiples = self
            .numbers
            .iter()
            .map(|x| nearest(&x.clone().into(), self.name));
        let newtons = self
            .numbers
            .iter()
            .map(|x| nearest(&self.newtons.scaled(x), self.name));
        let [coefficient, radicand] = [
            self.newtons.coefficient().clone(),
            BigRational::from_integer(BigUint::clone(self.newtons.radicand()).into()),
        ];
        Ok(json!({
            "unit": self.unit,
            "newtons": {
                "numerator": coefficient.numer().to_string(),
                "denominator": coefficient.denom().to_string(),
                "radicand": radicand.to_string(),
            },
            "denominator": denominator.to_string(),
            "numerators": numerators.join(" "),
            "multiples": floats(multiples)?,
            "floats": floats(newtons)?,
        }))
    }
}

#[cfg(test)]
mod tests {
    use num_traits::One;

    use super::*;

    fn quantity(numbers: impl IntoIterator<Item = BigRational>) -> Quantity {
        let mut quantity = Quantity::new("mg", Surd::sqrt(BigRational::one()).unwrap(), "a force");
        for number in numbers {
            quantity.place(number).unwrap();
        }
        quantity
    }

    #[test]
    fn values_are_distinct_over_a_common_denominator() {
        let ratio = |n: i64, d: i64| BigRational::new(n.into(), d.into());
        let mut quantity = quantity([ratio(1, 2), ratio(-2, 3), ratio(1, 2), ratio(0, 1)]);
        assert_eq!(quantity.place(ratio(-4, 6)), Ok(1));
        let json = quantity.to_json().unwrap();
        assert_eq!(
            (&json["denominator"], &json["numerators"]),
            (&json!("6"), &json!("3 -4 0"))
        );
    }

    #[test]
    fn rejects_too_many_digits() {
        // Over the common denominator the numerator of 1 has 45 million digits.
        let long = BigRational::new(BigInt::one(), BigInt::one() << 150_000_000_u64);
        let refused = quantity([long, BigRational::one()]).to_json();
        assert!(
            matches!(
                refused,
                Err(Error::Core(cannonpile::Error::TooLarge { .. }))
            ),
            "{refused:?}"
        );
    }
}
