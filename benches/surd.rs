//! Run times of `exact-surd` beside num-rational, dashu and malachite, for the same tasks in one run.
//!
//! `cargo bench --manifest-path benches/Cargo.toml --bench surd --features malachite`
//! multiplies and adds rationals, compares numbers c·√r, and rounds rationals and roots to `f64`. It asserts that all libraries
//! give the same results. It prints nanoseconds, and last lines `ratio NAME VALUE`: the time of another library relative to
//! `exact-surd`. With `-- --smoke` it only asserts the results. Malachite takes minutes to build: without `--features
//! malachite` it is left out.
//!
//! The other libraries have no type c·√r. They compare the squares c²·r, so their caller has to know the signs. Only
//! `exact-surd` rounds c·√r correctly. Dashu computes it to 120 bits here and rounds that to `f64`, which is wrong near ties.

use std::array;
use std::cmp::Ordering;
use std::env;
use std::hint::black_box;
use std::time::Instant;

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use dashu_int::IBig;
use dashu_ratio::RBig;
use exact_surd::num_bigint::{BigInt, BigUint};
use exact_surd::num_rational::BigRational;
use exact_surd::rational::{product, sum_of};
use exact_surd::{CorrectlyRounded, Surd};

/// A number c·√r in one library, with c > 0 and a prime r.
trait Number {
    const LIBRARY: &'static str;
    type Rational: ToString;

    /// Returns `numerator`/`denominator`·√`radicand`.
    fn new(numerator: &str, denominator: &str, radicand: u32) -> Self;
    /// Returns the product of two coefficients c.
    fn product(&self, other: &Self) -> Self::Rational;
    /// Returns the sum of two coefficients c.
    fn sum(&self, other: &Self) -> Self::Rational;
    /// Compares two numbers c·√r.
    fn compare(&self, other: &Self) -> Ordering;
    /// Returns the float nearest to c, if the library rounds correctly.
    fn round(&self) -> Option<f64>;
    /// Returns the float nearest to c·√r, if the library has square roots.
    fn root(&self) -> Option<f64>;
}

struct Own(BigRational, Surd);

impl Number for Own {
    const LIBRARY: &'static str = "exact_surd";
    type Rational = BigRational;

    fn new(numerator: &str, denominator: &str, radicand: u32) -> Self {
        let coefficient = BigRational::new(parsed(numerator), parsed(denominator));
        let root = Surd::sqrt(BigRational::from_integer(radicand.into()));
        let surd = root.expect("a positive radicand").scaled(&coefficient);
        Self(coefficient, surd)
    }

    fn product(&self, other: &Self) -> BigRational {
        product(&self.0, &other.0)
    }

    fn sum(&self, other: &Self) -> BigRational {
        sum_of([self.0.clone(), other.0.clone()])
    }

    fn compare(&self, other: &Self) -> Ordering {
        self.1.cmp(&other.1)
    }

    fn round(&self) -> Option<f64> {
        f64::nearest_to_rational(&self.0)
    }

    fn root(&self) -> Option<f64> {
        self.1.nearest()
    }
}

struct NumRational(BigRational, BigInt);

impl Number for NumRational {
    const LIBRARY: &'static str = "num_rational";
    type Rational = BigRational;

    fn new(numerator: &str, denominator: &str, radicand: u32) -> Self {
        let coefficient = BigRational::new(parsed(numerator), parsed(denominator));
        Self(coefficient, radicand.into())
    }

    fn product(&self, other: &Self) -> BigRational {
        &self.0 * &other.0
    }

    fn sum(&self, other: &Self) -> BigRational {
        &self.0 + &other.0
    }

    fn compare(&self, other: &Self) -> Ordering {
        let square = |x: &Self| &x.0 * &x.0 * &x.1;
        square(self).cmp(&square(other))
    }

    /// Its `to_f64` is not correctly rounded.
    fn round(&self) -> Option<f64> {
        None
    }

    fn root(&self) -> Option<f64> {
        None
    }
}

struct Dashu(RBig, IBig);

impl Number for Dashu {
    const LIBRARY: &'static str = "dashu";
    type Rational = RBig;

    fn new(numerator: &str, denominator: &str, radicand: u32) -> Self {
        let coefficient = RBig::from_parts(parsed(numerator), parsed(denominator));
        Self(coefficient, radicand.into())
    }

    fn product(&self, other: &Self) -> RBig {
        &self.0 * &other.0
    }

    fn sum(&self, other: &Self) -> RBig {
        &self.0 + &other.0
    }

    fn compare(&self, other: &Self) -> Ordering {
        let square = |x: &Self| &x.0 * &x.0 * &x.1;
        square(self).cmp(&square(other))
    }

    fn round(&self) -> Option<f64> {
        Some(self.0.to_f64().value())
    }

    fn root(&self) -> Option<f64> {
        let float = |n: &IBig| {
            FBig::<HalfEven, 2>::from(n.clone())
                .with_precision(120)
                .value()
        };
        let denominator = IBig::from(self.0.denominator().clone());
        let root = float(self.0.numerator()) * float(&self.1).sqrt() / float(&denominator);
        Some(root.to_f64().value())
    }
}

#[cfg(feature = "malachite")]
mod malachite {
    use std::cmp::Ordering;

    use malachite_base::num::conversion::traits::RoundingFrom;
    use malachite_base::rounding_modes::RoundingMode;
    use malachite_nz::natural::Natural;
    use malachite_q::Rational;

    use super::{Number, parsed};

    pub struct Malachite(Rational, Rational);

    impl Number for Malachite {
        const LIBRARY: &'static str = "malachite";
        type Rational = Rational;

        fn new(numerator: &str, denominator: &str, radicand: u32) -> Self {
            let coefficient = Rational::from_naturals(parsed(numerator), parsed(denominator));
            Self(coefficient, Natural::from(radicand).into())
        }

        fn product(&self, other: &Self) -> Rational {
            &self.0 * &other.0
        }

        fn sum(&self, other: &Self) -> Rational {
            &self.0 + &other.0
        }

        fn compare(&self, other: &Self) -> Ordering {
            let square = |x: &Self| &x.0 * &x.0 * &x.1;
            square(self).cmp(&square(other))
        }

        fn round(&self) -> Option<f64> {
            Some(f64::rounding_from(&self.0, RoundingMode::Nearest).0)
        }

        fn root(&self) -> Option<f64> {
            None
        }
    }
}

fn parsed<T: std::str::FromStr<Err: std::fmt::Debug>>(digits: &str) -> T {
    digits.parse().expect("an integer")
}

const TASKS: [&str; 5] = ["product", "sum", "compare", "round", "root"];

/// Numerators, denominators and radicands of one size.
struct Inputs {
    name: &'static str,
    /// How often each task runs in a round. None for the results only.
    calls: Option<u32>,
    numbers: Vec<(String, String, u32)>,
}

/// The results of each task in one library, as text, and the nanoseconds for one of them.
struct Column {
    library: &'static str,
    results: [Option<Vec<String>>; 5],
    times: [Option<f64>; 5],
}

fn main() {
    let smoke = env::args().any(|argument| argument == "--smoke");
    let mut ratios = Vec::new();
    for inputs in inputs(smoke) {
        let columns = [
            column::<Own>(&inputs),
            column::<NumRational>(&inputs),
            column::<Dashu>(&inputs),
            #[cfg(feature = "malachite")]
            column::<malachite::Malachite>(&inputs),
        ];
        print!("\n{:24}", format!("nanoseconds, {}", inputs.name));
        for column in &columns {
            print!("  {:>12}", column.library);
        }
        println!();
        let [own, others @ ..] = &columns;
        for (n, task) in TASKS.iter().enumerate() {
            print!("{task:24}");
            for column in &columns {
                let time = column.times[n].map(|time| format!("{time:.0}"));
                print!("  {:>12}", time.unwrap_or("-".into()));
            }
            println!();
            for other in others {
                if other.results[n].is_some() {
                    assert_eq!(
                        other.results[n], own.results[n],
                        "{task}, {}",
                        other.library
                    );
                }
                if let (Some(own), Some(time)) = (own.times[n], other.times[n]) {
                    let name = format!("{task}_{}_{}_over_exact_surd", inputs.name, other.library);
                    ratios.push((name, time / own));
                }
            }
        }
    }
    println!();
    for (name, ratio) in ratios {
        println!("ratio {name} {ratio:.2}");
    }
}

/// Returns rationals of 60, 500 and 4000 bits with any denominators, and rationals with powers of three as denominators.
fn inputs(smoke: bool) -> Vec<Inputs> {
    let mut random = Random(1998);
    let sizes = [
        ("60_bits", 60, 2000),
        ("500_bits", 500, 500),
        ("4000_bits", 4000, 20),
        ("powers_of_3", 60, 2000),
    ];
    let mut all = Vec::new();
    for (name, bits, calls) in sizes {
        let numbers = (20..36).map(|power| {
            let denominator = match name {
                "powers_of_3" => BigUint::from(3_u32).pow(power),
                _ => random.integer(bits) | BigUint::from(1_u32),
            };
            let radicand = [2, 3, 5, 7, 11, 13][random.below(6)];
            let numerator = random.integer(bits);
            (numerator.to_string(), denominator.to_string(), radicand)
        });
        all.push(Inputs {
            name,
            numbers: numbers.collect(),
            calls: (!smoke).then_some(calls),
        });
    }
    all
}

/// Runs all tasks in one library.
fn column<N: Number>(inputs: &Inputs) -> Column {
    let numbers = inputs.numbers.iter();
    let numbers: Vec<N> = numbers.map(|(n, d, r)| N::new(n, d, *r)).collect();
    let all = |task: &dyn Fn(&N, &N) -> Option<String>| {
        let pairs = numbers
            .iter()
            .flat_map(|x| numbers.iter().map(move |y| (x, y)));
        pairs.map(|(x, y)| task(x, y)).collect()
    };
    let float = |float: Option<f64>| float.map(|float| format!("{float:?}"));
    Column {
        library: N::LIBRARY,
        results: [
            all(&|x, y| Some(x.product(y).to_string())),
            all(&|x, y| Some(x.sum(y).to_string())),
            all(&|x, y| Some(format!("{:?}", x.compare(y)))),
            all(&|x, _| float(x.round())),
            all(&|x, _| float(x.root())),
        ],
        times: inputs.calls.map_or([None; 5], |calls| {
            let times = [
                time(&numbers, calls, N::product),
                time(&numbers, calls, N::sum),
                time(&numbers, calls, N::compare),
                time(&numbers, calls, |x, _| x.round()),
                time(&numbers, calls, |x, _| x.root()),
            ];
            let has = [
                true,
                true,
                true,
                numbers[0].round().is_some(),
                numbers[0].root().is_some(),
            ];
            array::from_fn(|n| has[n].then_some(times[n]))
        }),
    }
}

/// Returns the nanoseconds of a task for each number and its successor: the smallest time of seven rounds.
fn time<N, A>(numbers: &[N], calls: u32, task: impl Fn(&N, &N) -> A) -> f64 {
    let round = || {
        let start = Instant::now();
        for _ in 0..calls {
            for (x, y) in numbers.iter().zip(numbers.iter().cycle().skip(1)) {
                black_box(task(black_box(x), black_box(y)));
            }
        }
        start.elapsed().as_secs_f64() * 1e9 / f64::from(calls) / 16.0
    };
    (0..7).map(|_| round()).fold(f64::INFINITY, f64::min)
}

/// Pseudo-random bits, the same in every run (xorshift).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, n: usize) -> usize {
        usize::try_from(self.bits() >> 40).expect("24 bits") % n
    }

    /// Returns an integer with this number of bits.
    fn integer(&mut self, bits: u32) -> BigUint {
        let digits = (0..=bits / 32).map(|_| u32::try_from(self.bits() >> 32).expect("32 bits"));
        let any = BigUint::new(digits.collect());
        let top = BigUint::from(1_u32) << (bits - 1);
        any % &top + top
    }
}
