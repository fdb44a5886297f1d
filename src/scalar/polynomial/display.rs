//! Display of polynomials in common notation: `(L^3 + 3 L^2 + 2 L)/6`.

use alloc::string::ToString;
use core::fmt;

use num_traits::{One, Signed};

use super::{Monomial, Polynomial};
use crate::scalar::Algebra;

impl fmt::Display for Monomial {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (position, (symbol, power)) in self.0.iter().enumerate() {
            if position > 0 {
                f.write_str(" ")?;
            }
            f.write_str(symbol.0)?;
            if *power > 1 {
                write!(f, "^{power}")?;
            }
        }
        Ok(())
    }
}

impl fmt::Display for Polynomial {
    /// Writes the terms by decreasing degree, over the common denominator.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.is_defined() {
            return f.pad("overflow");
        }
        let text = Terms(self).to_string();
        // A minus sign inside parentheses is not the sign of the whole fraction.
        match text.strip_prefix('-') {
            Some(magnitude) => f.pad_integral(false, "", magnitude),
            None => f.pad_integral(true, "", &text),
        }
    }
}

/// The terms of a polynomial, without padding.
struct Terms<'p>(&'p Polynomial);

impl fmt::Display for Terms<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(Polynomial {
            terms, denominator, ..
        }) = self;
        if terms.is_empty() {
            return f.write_str("0");
        }
        let fraction = !denominator.is_one();
        let bracketed = fraction && terms.len() > 1;
        if bracketed {
            f.write_str("(")?;
        }
        for (position, (monomial, coefficient)) in terms.iter().rev().enumerate() {
            f.write_str(match (position, coefficient.is_negative()) {
                (0, false) => "",
                (0, true) => "-",
                (_, false) => " + ",
                (_, true) => " - ",
            })?;
            let magnitude = coefficient.abs();
            match (magnitude.is_one(), monomial.0.is_empty()) {
                (_, true) => write!(f, "{magnitude}")?,
                (true, false) => write!(f, "{monomial}")?,
                (false, false) => write!(f, "{magnitude} {monomial}")?,
            }
        }
        if bracketed {
            f.write_str(")")?;
        }
        if fraction {
            write!(f, "/{denominator}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use alloc::format;

    use super::super::Symbol;
    use super::*;
    use crate::scalar::Ring;

    #[test]
    fn uses_common_notation() {
        let l = Polynomial::from(Symbol("L"));
        let n = Polynomial::from_integer;
        let six = 6.try_into().unwrap();
        let tetrahedral = l.clone() * &(l.clone() + &n(1)) * &(l.clone() + &n(2));
        let divided = tetrahedral.div_int(six);
        assert_eq!(divided.to_string(), "(L^3 + 3 L^2 + 2 L)/6");
        assert_eq!((-l.clone()).to_string(), "-L");
        assert_eq!((n(-1) - &l).to_string(), "-L - 1");
        assert_eq!(n(0).to_string(), "0");
        assert_eq!(l.div_int(six).to_string(), "L/6");
        assert_eq!(n(-3).div_int(six).to_string(), "-1/2");
    }

    #[test]
    fn width_fill_and_sign_are_honoured() {
        let l = Polynomial::from(Symbol("L"));
        let next = l.clone() + &Polynomial::from_integer(1);
        assert_eq!(format!("{next:>9}|{next:<9}|"), "    L + 1|L + 1    |");
        assert_eq!(format!("{:*^9}", -next.clone()), "*-L - 1**");
        assert_eq!(format!("{next:+}"), "+L + 1");
        let halved = (-next.clone()).div_int(2.try_into().unwrap());
        assert_eq!(format!("{halved:+.1}"), "+(-L - 1)/2");
        assert_eq!(format!("{:>4}", Polynomial::from_integer(0)), "   0");
    }
}
