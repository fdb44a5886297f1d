//! The random stackings of a seed, by the definition, without a library of random numbers.

use cannonpile::lattice::Sign;
use cannonpile_disorder::FirstSign;

/// Words of 64 bits from ChaCha with eight rounds, in D. J. Bernstein's form: a counter and a nonce of 64 bits each.
struct ChaCha {
    key: [u32; 8],
    nonce: u64,
    counter: u64,
    words: Vec<u32>,
}

impl ChaCha {
    fn new(seed: u64, nonce: u64) -> Self {
        let halves = |x: u64| [x & 0xffff_ffff, x >> 32].map(|half| u32::try_from(half).unwrap());
        let [low, high] = halves(seed);
        Self {
            key: [low, high, 0, 0, 0, 0, 0, 0],
            nonce,
            counter: 0,
            words: Vec::new(),
        }
    }

    fn block(&mut self) {
        let halves = |x: u64| [x & 0xffff_ffff, x >> 32].map(|half| u32::try_from(half).unwrap());
        let mut state = vec![0x6170_7865_u32, 0x3320_646e, 0x7962_2d32, 0x6b20_6574];
        state.extend(self.key);
        state.extend(halves(self.counter));
        state.extend(halves(self.nonce));
        let begin = state.clone();
        let mut quarter = |a: usize, b: usize, c: usize, d: usize| {
            for (x, y, z, bits) in [(a, b, d, 16), (c, d, b, 12), (a, b, d, 8), (c, d, b, 7)] {
                state[x] = state[x].wrapping_add(state[y]);
                state[z] = (state[z] ^ state[x]).rotate_left(bits);
            }
        };
        for _ in 0..4 {
            for column in 0..4 {
                quarter(column, column + 4, column + 8, column + 12);
            }
            for column in 0..4 {
                let at = |row: usize| 4 * row + (column + row) % 4;
                quarter(at(0), at(1), at(2), at(3));
            }
        }
        let sums = state.iter().zip(begin).map(|(x, y)| x.wrapping_add(y));
        self.words = sums.rev().collect();
        self.counter += 1;
    }

    fn half(&mut self) -> u64 {
        if self.words.is_empty() {
            self.block();
        }
        self.words.pop().unwrap().into()
    }

    fn below(&mut self, of: u64) -> u64 {
        let most = (u128::from(u64::MAX) + 1) / u128::from(of) * u128::from(of);
        loop {
            let low = self.half();
            let word = self.half() << 32 | low;
            if u128::from(word) < most {
                return word % of;
            }
        }
    }
}

/// The signs of sample n of a seed with the fault probability a/b.
pub fn sample(seed: u64, n: u64, (a, b): (u64, u64), first: FirstSign, steps: usize) -> Vec<Sign> {
    let mut words = ChaCha::new(seed, n);
    let mut sign = match first {
        FirstSign::Plus => Sign::Plus,
        FirstSign::Minus => Sign::Minus,
        FirstSign::Random => [Sign::Plus, Sign::Minus][usize::try_from(words.below(2)).unwrap()],
    };
    let mut signs = vec![sign];
    while signs.len() < steps {
        if words.below(b) < a {
            sign = -sign;
        }
        signs.push(sign);
    }
    signs.truncate(steps);
    signs
}
