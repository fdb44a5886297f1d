//! Random stackings.

use core::iter::successors;

use cannonpile::lattice::Sign;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use num_traits::ToPrimitive;

use super::choice::Samples;
use crate::FirstSign;
use crate::error::bug;
use crate::{Each, Error};

/// A generator of samples, for one seed.
pub(super) struct Sampler {
    key: [u8; 32],
    first: FirstSign,
    steps: usize,
    /// The fault probability is `faults`/`of`.
    faults: u64,
    of: u64,
}

impl Sampler {
    pub(super) fn new(samples: &Samples, first: FirstSign, steps: usize) -> Result<Self, Error> {
        let q = samples.fault_probability();
        let [faults, of] = [q.numer(), q.denom()].each(|part| {
            part.to_u64()
                .ok_or_else(|| bug("a sampled probability fits 64 bits"))
        });
        let mut key = [0; 32];
        key.iter_mut()
            .zip(samples.seed().to_le_bytes())
            .for_each(|(key, byte)| *key = byte);
        Ok(Self {
            key,
            first,
            steps,
            faults: faults?,
            of: of?,
        })
    }

    /// Returns the signs of sample n, from the top.
    pub(super) fn sample(&self, n: u64) -> Vec<Sign> {
        let mut words = ChaCha8Rng::from_seed(self.key);
        words.set_stream(n);
        let first = match self.first {
            FirstSign::Plus => Sign::Plus,
            FirstSign::Random if below(&mut words, 2) == 0 => Sign::Plus,
            FirstSign::Minus | FirstSign::Random => Sign::Minus,
        };
        let next = |sign: &Sign| {
            let changes = below(&mut words, self.of) < self.faults;
            Some(if changes { -*sign } else { *sign })
        };
        successors(Some(first), next).take(self.steps).collect()
    }
}

/// Returns a uniform random integer below `of`.
fn below(words: &mut impl Rng, of: u64) -> u64 {
    // A word beyond the greatest multiple of `of` would make small integers more likely. There are 2⁶⁴ mod `of` such
    // words.
    let beyond = (u64::MAX % of + 1) % of;
    loop {
        let word = words.next_u64();
        if word <= u64::MAX - beyond {
            return word % of;
        }
    }
}

#[cfg(test)]
mod tests {
    use num_rational::BigRational;

    use super::*;

    /// A generator that returns given words.
    struct Given(Vec<u64>);

    impl chacha20::rand_core::TryRng for Given {
        type Error = core::convert::Infallible;

        fn try_next_u32(&mut self) -> Result<u32, Self::Error> {
            unreachable!("words have 64 bits")
        }

        fn try_next_u64(&mut self) -> Result<u64, Self::Error> {
            Ok(self.0.remove(0))
        }

        fn try_fill_bytes(&mut self, _: &mut [u8]) -> Result<(), Self::Error> {
            unreachable!("words have 64 bits")
        }
    }

    #[test]
    fn biased_words_are_discarded() {
        // 2⁶⁴ = 3·(2⁶⁴−1)/3 + 1, so one word has to be discarded.
        assert_eq!(below(&mut Given([u64::MAX, 5].into()), 3), 2);
        assert_eq!(below(&mut Given([u64::MAX - 1].into()), 3), 2);
        assert_eq!(below(&mut Given([u64::MAX].into()), 4), 3);
        let most = u64::MAX;
        assert_eq!(below(&mut Given([most, 7].into()), most), 7);
        assert_eq!(below(&mut Given([most].into()), 1), 0);
    }

    #[test]
    fn samples_depend_on_index_and_seed() -> Result<(), Error> {
        let drawn = |seed, q: (i64, i64), n| {
            let samples = Samples::new(9, seed, BigRational::new(q.0.into(), q.1.into()))?;
            Ok::<_, Error>(Sampler::new(&samples, FirstSign::Random, 12)?.sample(n))
        };
        for n in 0..9 {
            let alike = |signs: &[Sign]| signs[0] == signs[1];
            assert!(drawn(1, (0, 1), n)?.windows(2).all(alike));
            assert!(!drawn(1, (1, 1), n)?.windows(2).any(alike));
        }
        assert_ne!(drawn(1, (1, 2), 0)?, drawn(1, (1, 2), 1)?);
        assert_ne!(drawn(1, (1, 2), 0)?, drawn(2, (1, 2), 0)?);
        Ok(())
    }
}
