//! Scalars other than `BigRational`, compared with the oracle. Rounded scalars stay within a bound for their precision.
//! Enclosures contain the exact value. Fixed-width scalars are exact or report an overflow.

use cannonpile::Error;
use cannonpile::scalar::{Algebra, DoubleDouble, FixedRational, Interval, Polynomial};
use cannonpile::shape::Selection;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Signed;

use cannonpile_testkit::cases::{Bounds, Case, Random, repeated};
use cannonpile_testkit::oracles::balance::{Forces, direction, ratio, site};

/// Every answer of a pile in one scalar with the exact value, from single queries and from rows.
fn answers<T: Algebra>(case: &Case, known: &Forces) -> Vec<(Result<T, Error>, BigRational)> {
    let forces = case.pile.forces::<T>();
    let mut answers = Vec::new();
    let mut contacts = forces.contacts(Selection::All).unwrap();
    for (at, expected) in &known.below {
        for (m, expected) in expected.iter().enumerate() {
            let one = forces.contact(site(*at), direction(m));
            let in_rows = contacts.next().expect("a contact");
            answers.push((one, expected.clone()));
            answers.push((in_rows.map(|contact| contact.force), expected.clone()));
        }
    }
    let mut base = forces.base(Selection::Base).unwrap();
    for (at, expected) in &known.floor {
        let one = forces.on_floor(site(*at));
        for force in [one, base.next().expect("a bottom sphere")] {
            let components = match force {
                Ok(force) => [force.normal, force.shear_x, force.shear_y].map(Ok),
                Err(error) => [(); 3].map(|()| Err(error.clone())),
            };
            answers.extend(components.into_iter().zip(expected.clone()));
        }
    }
    answers
}

/// Random piles: tops and stackings of all kinds, with and without loads. The last ones are large.
fn piles() -> Vec<Case> {
    let mut random = Random(21);
    let mut piles = Vec::new();
    for round in 0..40 {
        let signs = random.signs(round % 9);
        let loads = random.below(3);
        piles.push(Case::under(&random.bounds(3), &signs).with_random_loads(loads, &mut random));
    }
    for signs in [repeated("+-", 14), repeated("++--", 14), random.signs(14)] {
        piles.push(Case::under(&Bounds::SITE, &signs));
    }
    piles
}

/// A bound on all errors, in units of the rounding error.
///
/// G is orthogonal, so a half-turn preserves the ℓ² norm of an error over a layer. Every run adds a few roundings of values
/// that are at most 2√3·‖f‖ < 4·Σ√3‖w‖. A load adds one or two. The sums of three contacts in a force on the floor are not
/// greater. So 16 roundings for each layer and each load are a safe bound.
fn scale(case: &Case) -> BigRational {
    let balance = &case.balance;
    let mut norms = ratio(0, 1);
    for (k, layer) in (0..).zip(&balance.layers) {
        let squares = layer.iter().map(|&(j, i)| {
            let weight = balance.weight((k, j, i));
            weight * weight
        });
        let squares: BigRational = squares.sum::<BigRational>() * ratio(3, 1);
        norms += BigRational::from(squares.ceil().to_integer().sqrt() + 1_u32);
    }
    let roundings = 16 * (balance.layers.len() + balance.weights.len() + 1);
    norms * ratio(4, 1) * BigRational::from(BigInt::from(roundings))
}

fn within<T: Algebra>(bits: u32, exactly: impl Fn(&T) -> BigRational) {
    let unit = ratio(1, 1) / BigRational::from(BigInt::from(1) << bits);
    for case in piles() {
        let bound = scale(&case) * &unit;
        for (answer, expected) in answers::<T>(&case, &case.balance.forces()) {
            let answer = exactly(&answer.unwrap());
            let error = (&answer - &expected).abs();
            assert!(error <= bound, "{answer} {expected} {}", case.balance.signs);
        }
    }
}

#[test]
fn f64_within_its_rounding() {
    within::<f64>(53, |x| BigRational::from_float(*x).expect("finite"));
}

#[test]
fn f32_within_its_rounding() {
    within::<f32>(24, |x| BigRational::from_float(*x).expect("finite"));
}

#[test]
fn double_doubles_within_their_rounding() {
    let part = |x| BigRational::from_float(x).expect("finite");
    within::<DoubleDouble>(100, |x| part(x.high()) + part(x.low()));
}

#[test]
fn intervals_contain_every_force_and_stay_narrow() {
    for case in piles() {
        // Enclosures ignore that G is a rotation, so they may grow by 5/3 at each change.
        let growth =
            ratio(5, 3).pow(i32::try_from(case.pile.shape().stacking().changes()).unwrap());
        let bound = scale(&case) * growth / BigRational::from(BigInt::from(1) << 53);
        for (answer, expected) in answers::<Interval>(&case, &case.balance.forces()) {
            let answer = answer.unwrap();
            assert!(answer.contains(&expected), "{answer:?} {expected}");
            let [lower, upper] = [answer.lower(), answer.upper()].map(BigRational::from_float);
            let width = upper.expect("finite") - lower.expect("finite");
            assert!(width <= bound, "{answer:?} {expected}");
        }
    }
}

#[test]
fn polynomials_without_symbols_are_rationals() {
    for case in piles().into_iter().take(30) {
        for (answer, expected) in answers::<Polynomial>(&case, &case.balance.forces()) {
            assert_eq!(answer.unwrap().to_constant(), Some(expected));
        }
    }
}

/// The numbers of exact answers and of rejected ones. An answer is never wrong.
fn equal_or_overflow<T: Algebra>(exactly: impl Fn(&T) -> Option<BigRational>) -> [usize; 2] {
    let mut counts = [0, 0];
    for case in piles() {
        for (answer, expected) in answers::<T>(&case, &case.balance.forces()) {
            match answer {
                Ok(answer) => {
                    counts[0] += 1;
                    assert_eq!(exactly(&answer), Some(expected), "{}", case.balance.signs);
                }
                Err(Error::Overflow { .. }) => counts[1] += 1,
                Err(other) => panic!("{other}"),
            }
        }
    }
    counts
}

#[test]
fn fixed_rationals_are_equal_or_overflow() {
    let [equal, refused] = equal_or_overflow(FixedRational::<i128>::to_rational);
    assert!(equal > 10 * refused, "{equal} {refused}");
    let [equal, refused] = equal_or_overflow(FixedRational::<i64>::to_rational);
    assert!(equal > 10 * refused, "{equal} {refused}");
    let [equal, refused] = equal_or_overflow(FixedRational::<i32>::to_rational);
    assert!(equal > 0 && refused > 0, "{equal} {refused}");
    let [equal, refused] = equal_or_overflow(FixedRational::<i16>::to_rational);
    assert!(equal > 0 && refused > 0, "{equal} {refused}");
}

#[test]
fn forces_refer_to_their_own_pile() {
    let case = Case::under(&Bounds::triangle(2), "+-");
    let forces: cannonpile::Forces<f64> = case.pile.forces();
    assert_eq!(forces.pile(), &case.pile);
}
