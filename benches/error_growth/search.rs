//! A search for the stacking and the loads with the worst error.

use cannonpile::lattice::Site;
use cannonpile::num_rational::BigRational;
use cannonpile::scalar::DoubleDouble;

use crate::format::Format;
use crate::growth::{errors, lowest, under_a_hexagon};
use crate::random::Random;

/// Signs, and loads on seven spheres of the top, in eighths of the weight of a sphere.
#[derive(Clone)]
struct Candidate {
    signs: Vec<u8>,
    loads: [u8; 7],
}

const SITES: [[i128; 2]; 7] = [[0, 0], [1, 0], [0, 1], [-1, 1], [3, 0], [0, 3], [0, -3]];

/// Prints the worst error to which a hill climbs. The start is HCP without loads, and each step changes one sign or one load
/// of at most four weights.
pub(crate) fn print<T: Format>(layers: i128, steps: i128) {
    let changes = u8::try_from(layers - 1).expect("few layers");
    let mut random = Random(1);
    let mut best = Candidate {
        signs: (0..changes).map(|k| b"+-"[usize::from(k % 2)]).collect(),
        loads: [0; 7],
    };
    let start = best.error::<T>();
    let mut error = start;
    for _ in 0..steps {
        let mut next = best.clone();
        if random.below(2) == 0 {
            let sign = &mut next.signs[usize::from(random.below(changes))];
            *sign = if *sign == b'+' { b'-' } else { b'+' };
        } else {
            next.loads[usize::from(random.below(7))] = random.below(33);
        }
        let found = next.error::<T>();
        if found >= error {
            (best, error) = (next, found);
        }
    }
    let (label, stacking, loads) = (T::LABEL, best.stacking(), best.loads);
    println!(
        "{label}, {layers} layers, {steps} steps: {start:.2} to {error:.2} u; {stacking}, loads/8 {loads:?}"
    );
}

impl Candidate {
    fn stacking(&self) -> String {
        self.signs.iter().copied().map(char::from).collect()
    }

    fn error<T: Format>(&self) -> f64 {
        let mut pile = under_a_hexagon(self.stacking().parse().expect("signs"));
        for ([i, j], eighths) in SITES.into_iter().zip(self.loads) {
            let load = BigRational::new(eighths.into(), 8.into());
            pile = pile.with_load(Site { i, j, k: 0 }, load).expect("a load");
        }
        let ([worst, _], _) = errors(&lowest::<T>(&pile).0, &lowest::<DoubleDouble>(&pile).0);
        worst
    }
}
