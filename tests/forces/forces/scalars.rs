//! Other scalars than `BigRational`, against the oracle: rounded ones within a bound that follows from their
//! precision, enclosing ones around it, bounded ones equal to it or refused.

use cannonpile::Error;
use cannonpile::scalar::{Algebra, DoubleDouble, FixedRational, Interval, Polynomial};
use cannonpile::shape::Selection;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Signed;

use cannonpile_testkit::cases::{Bounds, Case, Random, repeated};
use cannonpile_testkit::oracles::balance::{Forces, direction, ratio, site};

/// Every answer of a pile in one scalar with the true value, one by one and in rows.
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

/// Random piles: tops and stackings of all kinds, with and without loads; the last ones large.
fn piles() -> Vec<Case> {
    let mut random = Random(21);
    let mut piles = Vec::new();
    for round in 0..40 {
        let signs = random.signs(round % 9);
        let loads = random.below(3);
        piles.push(Case::under(&random.bounds(3), &signs).loaded(loads, &mut random));
    }
    for signs in [repeated("+-", 14), repeated("++--", 14), random.signs(14)] {
        piles.push(Case::under(&Bounds::SITE, &signs));
    }
    piles
}

/// What no error is greater than, in units of the rounding error.
///
/// G is orthogonal, so in ℓ² over a layer an error is passed on as large as it is. Every run adds a few roundings, each
/// of a number that is at most 2√3·‖f‖ < 4·Σ√3‖w‖; a load adds one or two. The sums that make a force on the floor of three
/// contacts are no greater. 16 roundings a layer, and as many for each load, are more than there are.
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
fn intervals_hold_every_force_and_little_more() {
    for case in piles() {
        // Bounds do not know that G is a rotation: they may grow by 5/3 at each change.
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

/// How many answers there are, and how many are refused: none is wrong.
fn equal_or_refused<T: Algebra>(exactly: impl Fn(&T) -> Option<BigRational>) -> [usize; 2] {
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
fn fixed_rationals_are_equal_or_refused() {
    let [equal, refused] = equal_or_refused(FixedRational::<i128>::to_rational);
    assert!(equal > 10 * refused, "{equal} {refused}");
    let [equal, refused] = equal_or_refused(FixedRational::<i64>::to_rational);
    assert!(equal > 10 * refused, "{equal} {refused}");
    let [equal, refused] = equal_or_refused(FixedRational::<i32>::to_rational);
    assert!(equal > 0 && refused > 0, "{equal} {refused}");
    let [equal, refused] = equal_or_refused(FixedRational::<i16>::to_rational);
    assert!(equal > 0 && refused > 0, "{equal} {refused}");
}

#[test]
fn the_statics_are_of_the_pile_that_was_asked() {
    let case = Case::under(&Bounds::triangle(2), "+-");
    let forces: cannonpile::Forces<f64> = case.pile.forces();
    assert_eq!(forces.pile(), &case.pile);
}
