//! Fixed-width rationals agree with arbitrary-precision ones or report an overflow.

use core::num::NonZeroI64;

use cannonpile::lattice::{Direction, MAX_LAYERS, Site};
use cannonpile::scalar::{Algebra, FixedInteger, FixedRational, Ring};
use cannonpile::{Error, Forces, Pile};
use cannonpile_testkit::answers::{Shape, ratio};
use cannonpile_testkit::real::Bounded;
use num_bigint::BigInt;
use num_rational::BigRational;

/// An answer as a list of values.
type Answer<T> = Result<Vec<T>, Error>;

/// Returns the answers to all queries about a sphere.
fn answers<T: Algebra>(forces: &Forces<T>, site: Site) -> Vec<Answer<T>> {
    let mut answers = vec![
        forces.increment_sum().map(|w| vec![w]),
        forces.from_above(site).map(Vec::from),
        forces.resultant_above(site).map(|v| v.into_array().into()),
        forces.position(site).map(|v| v.into_array().into()),
        forces.unbalanced(site).map(|v| v.into_array().into()),
        forces
            .on_floor(site)
            .map(|f| vec![f.normal, f.shear_x, f.shear_y]),
    ];
    for direction in Direction::ALL {
        answers.push(forces.direction(direction).map(|v| v.into_array().into()));
        answers.push(forces.contact(site, direction).map(|f| vec![f]));
        let vector = forces.contact_vector(site, direction);
        answers.push(vector.map(|v| v.into_array().into()));
    }
    answers
}

/// The number of answers that fit a width, and of those that overflow.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Tally {
    held: u32,
    overflowed: u32,
}

impl Tally {
    /// Compares the answers of one width with the exact ones.
    fn count<I: FixedInteger>(&mut self, pile: &Pile, site: Site, exact: &[Answer<BigRational>]) {
        let fixed = answers::<FixedRational<I>>(&pile.forces(), site);
        assert_eq!(fixed.len(), exact.len());
        for (fixed, exact) in fixed.into_iter().zip(exact) {
            let fixed = fixed.map(|numbers| numbers.iter().map(big).collect());
            if matches!(&fixed, Err(Error::Overflow { scalar, .. }) if *scalar == I::RATIONAL_NAME)
            {
                assert!(exact.is_ok(), "{site}: overflow instead of {exact:?}");
                self.overflowed += 1;
            } else {
                // The values agree, or both reject the query with the same error.
                assert_eq!(&fixed, exact, "{site} in {}", I::RATIONAL_NAME);
                self.held += u32::from(exact.is_ok());
            }
        }
    }
}

fn big<I: FixedInteger>(fixed: &FixedRational<I>) -> BigRational {
    fixed.to_rational().expect("an answer is a number")
}

/// Compares all widths, from 8 to 128 bits, for one sphere.
fn compare(pile: &Pile, site: Site, tallies: &mut [Tally; 5]) {
    let exact = answers(&pile.forces(), site);
    let [bits8, bits16, bits32, bits64, bits128] = tallies;
    bits8.count::<i8>(pile, site, &exact);
    bits16.count::<i16>(pile, site, &exact);
    bits32.count::<i32>(pile, site, &exact);
    bits64.count::<i64>(pile, site, &exact);
    bits128.count::<i128>(pile, site, &exact);
}

/// Asserts that in each width some answers fit, and some overflow.
fn assert_both(tallies: [Tally; 5]) {
    for Tally { held, overflowed } in tallies {
        assert!(held > 0 && overflowed > 0, "{tallies:?}");
    }
}

/// Returns values of sin φ with such long denominators that each width overflows within the first layers.
fn long_sines() -> Vec<BigRational> {
    let denominators = [5, 13, 181, 46_337, 3_037_000_493];
    let mut sines: Vec<_> = denominators.map(|d| ratio(2, d)).into();
    sines.push(BigRational::new(
        i128::MAX.into(),
        BigInt::from(i128::MAX) + 2,
    ));
    sines.push(BigRational::new(
        BigInt::from(1_u64 << 59),
        BigInt::from(1_u128 << 60) + 1,
    ));
    sines
}

#[test]
fn every_sphere_of_small_piles() {
    let shapes = long_sines().into_iter().map(Shape::Spheres);
    let mut tallies = [Tally::default(); 5];
    for shape in shapes {
        for layers in 1..=8 {
            let pile = shape.pile(layers);
            for site in shape.sites(layers) {
                compare(&pile, site, &mut tallies);
            }
        }
    }
    assert_both(tallies);
}

#[test]
fn every_sphere_of_regular_piles() {
    let mut tallies = [Tally::default(); 5];
    for shape in [Shape::equilateral(), Shape::Discs] {
        for layers in 1..=14 {
            let pile = shape.pile(layers);
            for site in shape.sites(layers) {
                compare(&pile, site, &mut tallies);
            }
        }
    }
    let [_, wider @ ..] = tallies;
    // No type wider than 8 bits overflows in these piles of up to 14 layers.
    assert!(
        wider.iter().all(|tally| tally.overflowed == 0),
        "{tallies:?}"
    );
}

/// Tests every base sphere of piles of discs, up to heights at which the counts overflow 8 bits.
#[test]
fn eight_bits_near_their_limit() {
    let mut tally = Tally::default();
    for layers in 1..=130 {
        let pile = Shape::Discs.pile(layers);
        for i in 0..layers {
            let site = Site {
                i,
                j: 0,
                k: layers - 1,
            };
            tally.count::<i8>(&pile, site, &answers(&pile.forces(), site));
        }
    }
    assert!(tally.held > 0 && tally.overflowed > 0, "{tally:?}");
}

/// Tests spheres at corners, on edges and in the middle, in piles whose heights are near the limits of a width.
#[test]
fn spheres_of_tall_piles() {
    let mut tallies = [Tally::default(); 5];
    let limits = [7_u32, 15, 31, 63].map(|bits| 1_i128 << bits);
    let heights = limits
        .into_iter()
        .flat_map(|n| [n / 6, n / 3, n / 2, n - 1, n, n + 1, 2 * n]);
    for layers in heights.chain([10_i128.pow(30), MAX_LAYERS]) {
        for shape in [
            Shape::equilateral(),
            Shape::Spheres(ratio(2, 5)),
            Shape::Discs,
        ] {
            let pile = shape.pile(layers);
            for k in [0, 1, layers / 2, layers - 2, layers - 1] {
                for j in [0, 1, k / 3, k - 1, k] {
                    for i in [0, 1, k / 3, k - j] {
                        compare(&pile, Site { i, j, k }, &mut tallies);
                    }
                }
            }
        }
    }
    let [narrower @ .., bits128] = tallies;
    assert!(
        narrower
            .iter()
            .all(|tally| tally.held > 0 && tally.overflowed > 0),
        "{tallies:?}"
    );
    // No height is chosen to overflow 128 bits.
    assert!(bits128.held > 0, "{tallies:?}");
}

/// The least integer of each width, such as −128, is not a valid numerator or denominator.
#[test]
fn least_integers_are_faults() {
    fn faults<I: FixedInteger>() {
        let (least, one) = (I::min_value(), I::one());
        let name = I::RATIONAL_NAME;
        for (n, d) in [(least, one), (one, least), (least, least), (one, I::zero())] {
            assert_eq!(FixedRational::new(n, d).parts(), None, "{name}");
        }
        let big: BigInt = least.into();
        let image = FixedRational::<I>::from_rational(&BigRational::from_integer(big.clone()));
        assert!(!image.is_defined() && image != image, "{name}");
        assert_eq!(image.enclosure(), None);
        let inverse = FixedRational::<I>::from_rational(&BigRational::new(1.into(), big));
        assert!(!inverse.is_defined(), "{name}");
        assert!(
            !FixedRational::<I>::from_integer(i128::MIN).is_defined(),
            "{name}"
        );
        // The greatest value and its negative are valid.
        let greatest = FixedRational::new(I::max_value(), one);
        assert!((-greatest).is_defined() && greatest.is_defined(), "{name}");
        // A fault remains a fault under every operation.
        let zero = FixedRational::new(I::zero(), one);
        assert!(
            !(image * zero).is_defined() && !(-image).is_defined(),
            "{name}"
        );
        assert!(
            !(image - image).is_defined() && !(zero + image).is_defined(),
            "{name}"
        );
    }
    faults::<i8>();
    faults::<i16>();
    faults::<i32>();
    faults::<i64>();
    faults::<i128>();
}

#[test]
fn division_by_the_least_integer() {
    let least = NonZeroI64::MIN;
    assert!(
        !FixedRational::<i64>::from_integer(1)
            .div_int(least)
            .is_defined()
    );
    let wide = FixedRational::<i128>::from_integer(1).div_int(least);
    assert_eq!(wide.parts(), Some((-1, 1 << 63)));
}

/// Every width rejects sites and layers at the ends of `i128` with the same error.
#[test]
fn queries_at_the_ends_of_the_integers() {
    let mut tallies = [Tally::default(); 5];
    for shape in [Shape::equilateral(), Shape::Discs] {
        for layers in [1, 5, MAX_LAYERS] {
            let pile = shape.pile(layers);
            for i in [i128::MIN, i128::from(i64::MIN), -1, i128::MAX] {
                for k in [i128::MIN, -1, layers, i128::MAX] {
                    for site in [
                        Site { i, j: 0, k },
                        Site { i: 0, j: i, k },
                        Site { i, j: i, k: 0 },
                    ] {
                        compare(&pile, site, &mut tallies);
                    }
                }
            }
        }
    }
    // Every site is outside its pile. So a query fails for this reason, or its answer does not depend on the site.
    assert!(
        tallies.iter().all(|tally| tally.overflowed == 0),
        "{tallies:?}"
    );
}

#[test]
fn written_as_fractions_in_lowest_terms() {
    for (n, d, text) in [
        (6, 2, "3"),
        (0, 5, "0"),
        (-4, 4, "-1"),
        (7, -14, "-1/2"),
        (-7, 3, "-7/3"),
        (1, 0, "overflow"),
    ] {
        let value = FixedRational::<i64>::new(n, d);
        assert_eq!(value.to_string(), text);
        assert_eq!(format!("{value:?}"), text);
    }
}
