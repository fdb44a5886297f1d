//! Values c·√r, random and adversarial.

use cannonpile::scalar::{CorrectlyRounded, Surd};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;

use super::random::{Random, power};
use super::tally::Tally;

/// Rounds random roots of any length and scale.
pub fn random_roots(random: &mut Random, cases: u64) -> Tally {
    let mut tally = Tally::default();
    while tally.cases < cases {
        let root = surd(&BigRational::one(), random.ratio(64));
        for _ in 0..16 {
            let c = random.ratio(96) * random.scale() * sign(random);
            tally.check(&root.scaled(&c));
        }
    }
    tally
}

/// Rounds roots close to a critical value of either format.
pub fn critical_roots(random: &mut Random, cases: u64) -> Tally {
    let mut tally = Tally::default();
    while tally.cases < cases {
        if random.once_in(2) {
            near_ties_by_radicand::<f64>(random, &mut tally);
            near_ties_by_coefficient::<f64>(random, &mut tally);
        } else {
            near_ties_by_radicand::<f32>(random, &mut tally);
            near_ties_by_coefficient::<f32>(random, &mut tally);
        }
    }
    tally
}

/// Rounds √(M²(1 ± δ)), and roots of integers next to the square of 2^p + 1, at several scales. A factor that is a
/// power of two changes ties only among subnormals.
fn near_ties_by_radicand<F: CorrectlyRounded>(random: &mut Random, tally: &mut Tally) {
    let place = random.critical::<F>();
    let off = random.tiny() * sign(random);
    let square = &place * &place;
    let nearly = if random.once_in(3) {
        let middle = power(i64::from(F::PRECISION)) + BigRational::one();
        let step = BigRational::from_integer(random.within(1..4).into());
        &middle * &middle + step * sign(random)
    } else {
        &square * (BigRational::one() + off)
    };
    let root = surd(&sign(random), nearly);
    tally.check(&root);
    for _ in 0..4 {
        tally.check(&root.scaled(&power(random.within(-40..40))));
        tally.check(&root.scaled(&random.scale()));
    }
}

/// Rounds c·√r for a simple r. The value lies close to a critical value, or equals it if the root is rational.
fn near_ties_by_coefficient<F: CorrectlyRounded>(random: &mut Random, tally: &mut Tally) {
    let squares = random.of(&[1, 4, 9, 49]);
    let plain = [random.within(1..1000), squares, squares];
    let radicand = BigRational::new(random.of(&plain).into(), random.of(&[1, 4, 25]).into());
    let root = surd(&sign(random), radicand);
    for _ in 0..8 {
        tally.check(&root.scaled(&towards(&root, &random.critical::<F>(), random)));
    }
}

/// Rounds rationals: random ones, critical values, and values close to them. Each is rounded twice, as a rational and as a
/// surd.
pub fn rationals(random: &mut Random, cases: u64) -> Tally {
    let mut tally = Tally::default();
    while tally.cases < cases {
        tally.check_rational(&(random.ratio(96) * random.scale() * sign(random)));
        for place in [random.critical::<f64>(), random.critical::<f32>()] {
            tally.check_rational(&(&place * sign(random)));
            let off = random.tiny() * sign(random);
            tally.check_rational(&(place * (BigRational::one() + off)));
        }
    }
    tally
}

/// A positive factor that moves |`x`| ≠ 0 to `place` or close to it. The relative distance is about 2^−220, or the square
/// root or fourth root of that. The value is exact only if x is rational.
pub fn towards(x: &Surd, place: &BigRational, random: &mut Random) -> BigRational {
    let bits = random.of(&[60, 60, 60, 110, 110, 220]);
    let square = x.square();
    let (n, d) = (square.numer(), square.denom());
    // An even shift that keeps 2·`bits` bits.
    let excess = n.bits().cast_signed() - d.bits().cast_signed();
    let half = bits - excess.div_euclid(2);
    let scaled = if half > 0 {
        (n << (2 * half)) / d
    } else {
        n / (d << (-2 * half))
    };
    // x ≈ root / 2^half, from below or above.
    let root = scaled.sqrt() + BigInt::from(u8::from(random.once_in(3)));
    place * power(half) / BigRational::from_integer(root)
}

/// ±1.
fn sign(random: &mut Random) -> BigRational {
    BigRational::from_integer(random.of(&[1, -1]).into())
}

fn surd(coefficient: &BigRational, radicand: BigRational) -> Surd {
    Surd::new(coefficient.clone(), radicand).expect("no negative radicand")
}
