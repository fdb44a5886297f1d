//! The memory limit of a check.

use cannonpile::Error;
use cannonpile::Pile;
use cannonpile::lattice::Site;
use cannonpile_horizontal::certificate::{Certificate, Claim, Refusal};
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::One;

use super::{bare, whole};
use cannonpile_testkit::answers::ratio;

/// The limit for the total size of the numbers, in words.
const MOST: u64 = 4_000_000;

/// Returns 2^−`power`.
fn small(power: u64) -> BigRational {
    BigRational::new(1.into(), BigInt::one() << power)
}

/// Returns a certificate about a single sphere under a load.
fn under(load: BigRational) -> Certificate {
    let pile = Pile::triangular(1).unwrap();
    bare(pile.with_load(Site::APEX, load).unwrap(), Claim::Stands)
}

fn needed(certificate: &Certificate) -> BigUint {
    match certificate.check() {
        Err(Refusal::Pile(Error::TooLarge { needed, limit, .. })) => {
            assert_eq!(limit, MOST);
            needed
        }
        checked => panic!("{:?}", checked.map_err(|refusal| refusal.to_string())),
    }
}

/// For one sphere: the common denominator 2^p has p + 1 bits, the numerator one bit, so ⌊(p + 2)/64⌋ + 1 words.
#[test]
fn word_limit_is_exact() {
    let most = 64 * MOST - 3;
    assert_eq!(under(small(most)).check(), Ok(()));
    assert_eq!(needed(&under(small(most + 1))), BigUint::from(MOST + 1));
    // A numerator 2^p over 1 has the same size.
    let long = |power: u64| BigRational::from_integer(BigInt::one() << power);
    assert_eq!(under(long(most)).check(), Ok(()));
    assert_eq!(needed(&under(long(most + 1))), BigUint::from(MOST + 1));
}

/// Each sphere counts with the same number of words. Each sign change adds two bits.
#[test]
fn words_are_counted_for_each_sphere() {
    let of = |pile: Pile, power| {
        let pile = pile.with_load(Site::APEX, small(power)).unwrap();
        needed(&bare(pile, Claim::Stands))
    };
    // 20 spheres and one run: p + 1, 1 and 2 bits.
    let power = 64 * MOST / 20 - 4;
    let straight = of(Pile::triangular(4).unwrap(), power);
    assert_eq!(straight, BigUint::from(MOST + 20));
    // 1, 3 and 7 spheres and two runs: two bits more.
    let top = cannonpile::lattice::Region::SITE;
    let twin = || Pile::under(top, "+-".parse().unwrap()).unwrap();
    let power = 64 * 400_000 - 6;
    assert_eq!(of(twin(), power), BigUint::from(11 * 400_001_u64));
    // For a claim of instability only the spheres of the field count, with 2 bits for one sign change.
    let mut light = bare(twin(), Claim::CannotStand);
    light.pile = light.pile.with_load(Site::APEX, small(power)).unwrap();
    light.field.insert(Site::APEX, whole([1, 0, 0]));
    assert!(!matches!(light.check().unwrap_err(), Refusal::Pile(_)));
    light
        .field
        .insert(Site::APEX, [small(64 * MOST), ratio(0, 1), ratio(0, 1)]);
    assert!(needed(&light) > BigUint::from(MOST));
}
