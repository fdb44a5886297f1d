//! Fixed-width rationals are correct or report an overflow. They never return a wrong value.

use arbitrary::Unstructured;
use cannonpile::geometry::Vector;
use cannonpile::lattice::Site;
use cannonpile::scalar::{Algebra, FixedInteger, FixedRational};
use cannonpile::{Error, FloorForce, Pile};
use num_rational::BigRational;

use super::{Checked, demand};
use crate::generators::pile;

/// Checks every width for one sphere of any pile.
pub fn any_pile(u: &mut Unstructured<'_>) -> Checked {
    let pile = pile::pile(u)?;
    let site = pile::site(u, &pile)?;
    every_answer::<i8>(&pile, site)?;
    every_answer::<i16>(&pile, site)?;
    every_answer::<i32>(&pile, site)?;
    every_answer::<i64>(&pile, site)?;
    every_answer::<i128>(&pile, site)
}

/// 128 bits never overflow in a small pile if sin φ has a short denominator.
pub fn small_pile(u: &mut Unstructured<'_>) -> Checked {
    let (layers, d) = (u.int_in_range(1..=1_000_000)?, u.int_in_range(2..=1000)?);
    let s = BigRational::new(u.int_in_range(1..=d - 1)?.into(), d.into());
    let pile = Pile::isosceles(layers, s)?;
    let site = pile::site(u, &pile)?;
    let narrow = pile.forces::<FixedRational<i128>>();
    narrow.resultant_above(site)?;
    if site.k == layers - 1 {
        narrow.on_floor(site)?;
    } else {
        narrow.unbalanced(site)?;
    }
    every_answer::<i128>(&pile, site)
}

/// Results lie within ±MAX, so every result has a negative.
pub fn results_can_be_negated(u: &mut Unstructured<'_>) -> Checked {
    let (x, y) = (narrow(u)?, narrow(u)?);
    for result in [
        Some(x),
        Some(x + y),
        Some(x - y),
        Some(x * y),
        x.checked_div(&y),
    ] {
        let Some(parts) = result.and_then(|result| result.parts()) else {
            continue;
        };
        is_symmetric(parts)?;
    }
    Ok(())
}

/// A rational whose sums and products often reach the limits of the type.
fn narrow(u: &mut Unstructured<'_>) -> arbitrary::Result<FixedRational<i8>> {
    const PARTS: [i8; 9] = [1, 2, 64, 126, 127, -1, -2, -64, -127];
    let (numer, denom) = (*u.choose(&PARTS)?, *u.choose(&PARTS)?);
    Ok(FixedRational::new(numer, denom))
}

/// Neither part is the minimum of the type, which has no negative.
fn is_symmetric((numer, denom): (i8, i8)) -> Checked {
    demand(numer > i8::MIN && denom > 0, || {
        format!("{numer}/{denom} is not within ±127")
    })
}

/// Checks all answers about one sphere.
fn every_answer<I: FixedInteger>(pile: &Pile, site: Site) -> Checked {
    let (narrow, exact) = (
        pile.forces::<FixedRational<I>>(),
        pile.forces::<BigRational>(),
    );
    right_or_overflow(narrow.from_above(site), &exact.from_above(site)?)?;
    right_or_overflow(
        narrow.position(site).map(Vector::into_array),
        &exact.position(site)?.into_array(),
    )?;
    right_or_overflow(
        narrow.resultant_above(site).map(Vector::into_array),
        &exact.resultant_above(site)?.into_array(),
    )?;
    if site.k == pile.layers() - 1 {
        return right_or_overflow(
            narrow.on_floor(site).map(parts),
            &parts(exact.on_floor(site)?),
        );
    }
    for &direction in pile.dimension().directions() {
        right_or_overflow(
            narrow.contact(site, direction).map(|force| [force]),
            &[exact.contact(site, direction)?],
        )?;
        right_or_overflow(
            narrow
                .contact_vector(site, direction)
                .map(Vector::into_array),
            &exact.contact_vector(site, direction)?.into_array(),
        )?;
    }
    right_or_overflow(
        narrow.unbalanced(site).map(Vector::into_array),
        &exact.unbalanced(site)?.into_array(),
    )
}

fn parts<T>(force: FloorForce<T>) -> [T; 3] {
    [force.shear_x, force.shear_y, force.normal]
}

/// The expected values, or [`Error::Overflow`].
fn right_or_overflow<I: FixedInteger, const N: usize>(
    got: Result<[FixedRational<I>; N], Error>,
    want: &[BigRational; N],
) -> Checked {
    match got {
        Err(Error::Overflow { .. }) => Ok(()),
        Err(other) => Err(other.into()),
        Ok(got) => {
            let stored = got.map(|x| x.to_rational());
            demand(stored == want.clone().map(Some), || {
                format!("{got:?} of {} bits is not {want:?}", 8 * size_of::<I>())
            })
        }
    }
}

#[cfg(test)]
mod injected_faults {
    use super::*;
    use crate::generators::number::ratio;

    #[test]
    fn wrong_values_and_other_errors_are_caught() {
        let judge = |got| right_or_overflow(got, &[ratio(300, 1)]);
        assert!(judge(Ok([FixedRational::new(300_i64, 1)])).is_ok());
        // 300 wraps to this value in 8 bits.
        assert!(right_or_overflow(Ok([FixedRational::new(44_i8, 1)]), &[ratio(300, 1)]).is_err());
        assert!(judge(Ok([FixedRational::FAULT])).is_err());
        let overflow = Error::overflow("a force", "FixedRational<i64>");
        assert!(judge(Err(overflow)).is_ok());
        assert!(judge(Err(Error::Interrupted)).is_err());
    }

    #[test]
    fn a_value_without_a_negative_is_caught() {
        assert!(is_symmetric((i8::MAX, 1)).is_ok());
        assert!(is_symmetric((i8::MIN, 1)).is_err());
        assert!(is_symmetric((1, i8::MIN)).is_err());
    }
}
