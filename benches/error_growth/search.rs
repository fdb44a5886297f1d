//! A search for the stacking and the loads with the worst error.

use std::fmt;

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
    /// The error of the worst contact above the floor, in u of the greatest force.
    error: f64,
}

const SITES: [[i128; 2]; 7] = [[0, 0], [1, 0], [0, 1], [-1, 1], [3, 0], [0, 3], [0, -3]];

/// Prints the worst error of all periods of at most six signs, the worst to which a hill climbs from HCP, and the errors of both
/// piles with `more` layers. Each step changes one sign, or one load of at most four weights.
pub(crate) fn print<T: Format>(layers: i128, steps: i128, more: Option<i128>) {
    let label = T::LABEL;
    // The first sign is +. The others are mirror images.
    let periods = (1..=6).flat_map(|length| (0..1 << (length - 1)).map(move |bits| (length, bits)));
    let of_period = |(length, bits): (usize, usize)| {
        let sign = |k: usize| b"+-"[usize::from(k > 0 && bits >> (k - 1) & 1 == 1)];
        (0..length).map(sign).collect::<Vec<u8>>()
    };
    let periods = periods.map(of_period);
    let candidates = periods.map(|signs| (Candidate::new::<T>(signs.clone(), layers), signs));
    let (periodic, period) = candidates
        .max_by(|(a, _), (b, _)| a.error.total_cmp(&b.error))
        .expect("a period");
    println!("{label}, {layers} layers, the worst period: {periodic}");
    let mut random = Random(1);
    let mut best = Candidate::new::<T>(b"+-".to_vec(), layers);
    println!("{label}, {layers} layers, HCP: {:.2} u", best.error);
    let changes = u8::try_from(layers - 1).expect("few layers");
    for _ in 0..steps {
        let mut next = best.clone();
        if random.below(2) == 0 {
            let sign = &mut next.signs[usize::from(random.below(changes))];
            *sign = if *sign == b'+' { b'-' } else { b'+' };
        } else {
            next.loads[usize::from(random.below(7))] = random.below(33);
        }
        next.measure::<T>();
        if next.error >= best.error {
            best = next;
        }
    }
    println!("{label}, {layers} layers, after {steps} steps: {best}");
    if let Some(more) = more {
        let mut longer = Candidate::new::<T>(period, more);
        println!(
            "{label}, {more} layers, the worst period: {:.2} u",
            longer.error
        );
        // An even number of signs, so that HCP goes on as HCP.
        best.signs.truncate(best.signs.len() & !1);
        longer.signs = best.signs;
        longer.loads = best.loads;
        longer.repeat(more);
        longer.measure::<T>();
        println!(
            "{label}, {more} layers, the last pile repeated: {:.2} u",
            longer.error
        );
    }
}

impl fmt::Display for Candidate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (signs, loads) = (self.stacking(), self.loads);
        write!(f, "{:.2} u; {signs}, loads/8 {loads:?}", self.error)
    }
}

impl Candidate {
    fn new<T: Format>(signs: Vec<u8>, layers: i128) -> Self {
        let mut new = Self {
            signs,
            loads: [0; 7],
            error: 0.0,
        };
        new.repeat(layers);
        new.measure::<T>();
        new
    }

    /// Repeats the signs for a number of layers.
    fn repeat(&mut self, layers: i128) {
        let steps = usize::try_from(layers - 1).expect("few layers");
        self.signs = self.signs.iter().copied().cycle().take(steps).collect();
    }

    fn stacking(&self) -> String {
        self.signs.iter().copied().map(char::from).collect()
    }

    fn measure<T: Format>(&mut self) {
        let mut pile = under_a_hexagon(self.stacking().parse().expect("signs"));
        for ([i, j], eighths) in SITES.into_iter().zip(self.loads) {
            let load = BigRational::new(eighths.into(), 8.into());
            pile = pile.with_load(Site { i, j, k: 0 }, load).expect("a load");
        }
        let ([worst, _], _) = errors(&lowest::<T>(&pile).0, &lowest::<DoubleDouble>(&pile).0);
        self.error = worst;
    }
}
