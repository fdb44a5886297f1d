//! Slices receive the solution of the equations of equilibrium. Slices of a wrong length are rejected.
//!
//! The slices hold exact values, numerators, correctly rounded floats, and floats. They cover all layers from some layer on,
//! and the base.

use crate::real::Bounded;
use arbitrary::Unstructured;
use cannonpile::scalar::{Algebra, CorrectlyRounded, DoubleDouble};
use cannonpile::shape::Selection;
use cannonpile::{Error, Forces, Layers};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::reference::{Contacts, Solved, contacts_of, floor_of};
use super::{Checked, demand, same};
use crate::generators::region;

/// Three values for each sphere: along α, β and γ, or on the floor.
type Slices<T> = [Vec<T>; 3];

/// Checks all contacts below some layer, and the base, in every scalar.
pub fn filled(u: &mut Unstructured<'_>) -> Checked {
    let described = region::described(u)?;
    let solved = Solved::of(&described);
    let pile = described.pile()?;
    let (contacts, floor) = (contacts_of(&solved), base_of(&solved));
    let passed = u.int_in_range(0..=3)?;
    let forces = pile.forces::<BigRational>();
    let wanted = Wanted::below(&contacts, passed, pile.layers());
    let layers = || after(&forces, passed);
    exact(&layers, &wanted)?;
    numerators::<BigInt>(&layers, &wanted)?;
    numerators::<i64>(&layers, &wanted)?;
    nearest::<f64>(&layers, &wanted)?;
    nearest::<f32>(&layers, &wanted)?;
    within_bounds::<f64>(&pile.forces(), &contacts)?;
    within_bounds::<f32>(&pile.forces(), &contacts)?;
    within_bounds::<DoubleDouble>(&pile.forces(), &contacts)?;
    exact_base(&forces, &floor)?;
    nearest_base::<f64>(&forces, &floor)
}

/// The expected contents: the forces below all remaining layers.
struct Wanted {
    forces: Slices<BigRational>,
    spheres: usize,
}

impl Wanted {
    fn below(contacts: &Contacts, passed: i128, layers: i128) -> Self {
        let first = passed.min(layers);
        let mut forces = [(); 3].map(|()| Vec::new());
        for contact in contacts.iter().filter(|contact| contact.site.k >= first) {
            forces[contact.direction.index()].push(contact.force.clone());
        }
        Self {
            spheres: forces[0].len(),
            forces,
        }
    }
}

fn base_of(solved: &Solved) -> Slices<BigRational> {
    let mut base = [(); 3].map(|()| Vec::new());
    for force in floor_of(solved) {
        let parts = [force.normal, force.shear_x, force.shear_y];
        for (slice, part) in base.iter_mut().zip(parts) {
            slice.push(part);
        }
    }
    base
}

/// The layers without the first `passed` ones.
fn after<'p>(
    forces: &Forces<'p, BigRational>,
    passed: i128,
) -> Result<Layers<'p, BigRational>, Error> {
    let mut layers = forces.layers(Selection::All)?;
    for _ in 0..passed {
        layers.next_layer()?;
    }
    Ok(layers)
}

/// Slices of `spheres` values are filled. Slices with one more or one less are rejected.
fn fill<T: Clone + Zero, R>(
    spheres: usize,
    fill: impl Fn([&mut [T]; 3]) -> Result<R, Error>,
) -> Result<(Slices<T>, Result<R, Error>), super::Failure> {
    let mut slices = [(); 3].map(|()| vec![T::zero(); spheres]);
    let done = fill(slices.each_mut().map(Vec::as_mut_slice));
    for (wrong, length) in (0..3).zip([spheres + 1, spheres + 2, spheres.saturating_sub(1)]) {
        let mut others = slices.clone();
        if let Some(slice) = others.get_mut(wrong) {
            slice.resize(length, T::zero());
        }
        let refused = fill(others.each_mut().map(Vec::as_mut_slice));
        let is_refused = matches!(refused, Err(Error::Length { .. }));
        demand(is_refused || length == spheres, || {
            format!("a slice of {length} numbers for {spheres} is filled")
        })?;
    }
    Ok((slices, done))
}

type Anew<'a, 'p> = &'a dyn Fn() -> Result<Layers<'p, BigRational>, Error>;

fn exact(layers: Anew<'_, '_>, wanted: &Wanted) -> Checked {
    let (got, done) = fill(wanted.spheres, |slices| layers()?.fill(slices))?;
    done?;
    same("exact slices", &got, &wanted.forces)
}

/// Integers over the common denominator, unless they overflow.
fn numerators<V>(layers: Anew<'_, '_>, wanted: &Wanted) -> Checked
where
    V: TryFrom<BigInt> + Into<BigInt> + Clone + Send + Sync + Zero,
{
    let (got, done) = fill::<V, _>(wanted.spheres, |slices| {
        layers()?.numerators()?.fill(slices)
    })?;
    let denominator = match done {
        Err(Error::Overflow { .. }) => return Ok(()),
        done => done?,
    };
    let over = |numerator: V| BigRational::new(numerator.into(), denominator.clone());
    let got = got.map(|slice| slice.into_iter().map(over).collect());
    same("numerators", &got, &wanted.forces)
}

/// Correctly rounded floats, unless one overflows.
fn nearest<F>(layers: Anew<'_, '_>, wanted: &Wanted) -> Checked
where
    F: CorrectlyRounded + Zero + PartialEq + core::fmt::Debug,
{
    let (got, done) = fill::<F, _>(wanted.spheres, |slices| layers()?.nearest()?.fill(slices))?;
    are_nearest(&got, done, &wanted.forces)
}

fn are_nearest<F: CorrectlyRounded + PartialEq + core::fmt::Debug>(
    got: &Slices<F>,
    done: Result<(), Error>,
    wanted: &Slices<BigRational>,
) -> Checked {
    let floats = wanted.each_ref().map(|slice| {
        let floats = slice.iter().map(F::nearest_to_rational);
        floats.collect::<Option<Vec<F>>>()
    });
    let [Some(a), Some(b), Some(c)] = floats else {
        let refused = matches!(done, Err(Error::Overflow { .. }));
        return demand(refused, || format!("{done:?}, but a value overflows"));
    };
    done?;
    same("correctly rounded forces", got, &[a, b, c])
}

/// No value exceeds the error bound of its layer. The claim ignores values that overflow.
fn within_bounds<T>(forces: &Forces<'_, T>, contacts: &Contacts) -> Checked
where
    T: Algebra + Bounded + Clone + Zero,
{
    let mut layers = forces.layers(Selection::All)?;
    while let Some(layer) = layers.next_layer()? {
        if layer.is_floor() {
            break;
        }
        let (got, done) = fill::<T, _>(layer.sphere_count(), |slices| layer.fill(slices))?;
        let (Some(bound), false) = (
            layer.error_bound(),
            matches!(done, Err(Error::Overflow { .. })),
        ) else {
            continue;
        };
        done?;
        let k = layer.k();
        let here = contacts.iter().filter(|contact| contact.site.k == k);
        for (n, contact) in here.enumerate() {
            let off = got[contact.direction.index()][n / 3].enclosure();
            let off = off.map(|got| (got.lower - &contact.force).abs());
            demand(off.as_ref().is_some_and(|off| *off <= bound), || {
                format!("{contact:?}: {off:?} off, not within {bound}")
            })?;
        }
    }
    Ok(())
}

fn exact_base(forces: &Forces<'_, BigRational>, floor: &Slices<BigRational>) -> Checked {
    let mut layers = forces.layers(Selection::Base)?;
    let base = layers.next_layer()?;
    let base = base.ok_or_else(|| super::Failure::Refuted("no base".to_owned()))?;
    let (got, done) = fill(floor[0].len(), |slices| base.fill_base(slices))?;
    done?;
    same("the base", &got, floor)
}

fn nearest_base<F>(forces: &Forces<'_, BigRational>, floor: &Slices<BigRational>) -> Checked
where
    F: CorrectlyRounded + Zero + PartialEq + core::fmt::Debug,
{
    let mut layers = forces.layers(Selection::Base)?.nearest::<F>()?;
    let base = layers.next_layer()?;
    let base = base.ok_or_else(|| super::Failure::Refuted("no base".to_owned()))?;
    let (got, done) = fill::<F, _>(floor[0].len(), |slices| base.fill_base(slices))?;
    are_nearest(&got, done, floor)
}

#[cfg(test)]
mod injected_faults {
    use super::*;
    use crate::generators::number::ratio;

    #[test]
    fn slices_of_a_wrong_length_are_caught() {
        let careless = |slices: [&mut [f64]; 3]| {
            for slice in slices {
                slice.fill(1.0);
            }
            Ok(())
        };
        assert!(fill(4, careless).is_err());
        let careful = |slices: [&mut [f64]; 3]| match slices.iter().find(|slice| slice.len() != 4) {
            Some(slice) => Err(Error::Length {
                needed: 4,
                given: slice.len(),
            }),
            None => Ok(()),
        };
        assert!(fill(4, careful).is_ok());
    }

    #[test]
    fn a_neighbouring_float_is_caught() {
        let wanted = [0, 1, 2].map(|n| vec![ratio(n, 3)]);
        let mut got = [0.0, 1.0 / 3.0, 2.0 / 3.0].map(|x| vec![x]);
        assert!(are_nearest::<f64>(&got, Ok(()), &wanted).is_ok());
        got[1][0] = got[1][0].next_up();
        assert!(are_nearest::<f64>(&got, Ok(()), &wanted).is_err());
        let wide = [0, 1, 2].map(|_| vec![crate::generators::number::power(10, 400)]);
        assert!(are_nearest::<f64>(&got, Ok(()), &wide).is_err());
    }
}
