//! The accuracy and the cost of intervals and double-doubles, on millions of operands.
//!
//! `cargo bench --manifest-path benches/Cargo.toml --bench scalars`
//! applies each operation to two million pairs. It asserts that every interval contains the exact result and is at most one
//! float too wide at each end, and that every double-double is within 2^−100 of the result. It prints the worst cases,
//! nanoseconds, and lines `ratio NAME VALUE` relative to `f64`. With `-- --smoke` it uses some thousand pairs.
//!
//! The exact result is an unreduced fraction of integers, because a finite float is an integer times 2^−1074.

use std::env;
use std::hint::black_box;
use std::time::Instant;

use cannonpile::scalar::{Algebra, DoubleDouble, Field, Interval};
use num_bigint::{BigInt, BigUint};
use num_traits::{Signed, ToPrimitive, Zero};

fn main() {
    let smoke = env::args().any(|argument| argument == "--smoke");
    let pairs = if smoke { 4_000 } else { 2_000_000 };

    println!("{pairs} pairs   interval: floats wider   double-double: worst error");
    for (name, operation) in OPERATIONS {
        let mut random = Random(1998);
        let mut worst = Worst::default();
        for _ in 0..pairs {
            worst.of_intervals(operation, random.pair());
            worst.of_double_doubles(operation, random.numbers());
        }
        println!("{name:15} {:23}   2^{:.2}", worst.wider, worst.error.log2());
    }

    println!("operation       f64 (ns)  double-double (ns)  interval (ns)");
    let calls = if smoke { 10 } else { 20_000 };
    let mut ratios = Vec::new();
    for (name, operation) in OPERATIONS {
        let [float, double, interval] = times(operation, calls);
        println!("{name:12} {float:11.2} {double:19.2} {interval:14.2}");
        ratios.push((format!("double_double_{name}_over_f64"), double / float));
        ratios.push((format!("interval_{name}_over_f64"), interval / float));
    }
    for (name, ratio) in ratios {
        println!("ratio {name} {ratio:.1}");
    }
}

#[derive(Clone, Copy)]
enum Operation {
    Sum,
    Difference,
    Product,
    Quotient,
}

const OPERATIONS: [(&str, Operation); 4] = [
    ("sum", Operation::Sum),
    ("difference", Operation::Difference),
    ("product", Operation::Product),
    ("quotient", Operation::Quotient),
];

impl Operation {
    fn apply<T: Field>(self, a: T, b: &T) -> Option<T> {
        match self {
            Self::Sum => Some(a + b),
            Self::Difference => Some(a - b),
            Self::Product => Some(a * b),
            Self::Quotient => a.checked_div(b),
        }
    }

    /// Returns the result for x/2^1074 and y/2^1074, in units of 2^−1074, as a fraction with a positive denominator.
    fn exactly(self, x: &BigInt, y: &BigInt) -> (BigInt, BigInt) {
        match self {
            Self::Sum => (x + y, 1.into()),
            Self::Difference => (x - y, 1.into()),
            Self::Product => (x * y, BigInt::from(1) << 1074),
            Self::Quotient => ((x << 1074) * y.signum(), y.abs()),
        }
    }
}

/// The worst cases.
#[derive(Default)]
struct Worst {
    /// The largest excess width of an end, as a number of floats.
    wider: u32,
    /// The relative error of double-doubles, for results between 2^−900 and 2^1023.
    error: f64,
}

impl Worst {
    fn of_intervals(&mut self, operation: Operation, (x, y): (f64, f64)) {
        let Some(got) = operation.apply(Interval::point(x), &Interval::point(y)) else {
            assert!(y.abs().is_zero(), "no quotient by {y:e}");
            return;
        };
        let (n, d) = operation.exactly(&scaled(x), &scaled(y));
        // An upper end is the lower end of the negated interval.
        for (end, n) in [(got.lower(), n.clone()), (-got.upper(), -n)] {
            let is_below = |end: f64| {
                let infinite = end.is_infinite();
                if infinite {
                    end < 0.0
                } else {
                    scaled(end) * &d <= n
                }
            };
            assert!(is_below(end), "{x:e} and {y:e} gave {got:?}");
            let mut end = end.next_up();
            let mut wider = 0;
            while is_below(end) {
                (end, wider) = (end.next_up(), wider + 1);
                assert!(wider < 2, "{x:e} and {y:e} gave {got:?}");
            }
            self.wider = self.wider.max(wider);
        }
    }

    fn of_double_doubles(&mut self, operation: Operation, [a, b]: [DoubleDouble; 2]) {
        if !(a.is_defined() && b.is_defined()) {
            return;
        }
        let parts = |a: &DoubleDouble| scaled(a.high()) + scaled(a.low());
        let (n, d) = operation.exactly(&parts(&a), &parts(&b));
        // n/d is in units of 2^−1074, so the magnitude of the result lies between 2^(bits−1) and 2^(bits+1).
        let bits = n.bits().cast_signed() - d.bits().cast_signed() - 1074;
        let Some(got) = operation
            .apply(a, &b)
            .filter(|_| (-899..=1022).contains(&bits))
        else {
            return;
        };
        let error = (parts(&got) * d - &n).into_parts().1;
        let error = quotient(&error, n.magnitude());
        assert!(
            error <= 2.0_f64.powi(-100),
            "{a:?} and {b:?} gave {got:?}, off by {error:e}"
        );
        self.error = self.error.max(error);
    }
}

/// Returns the integer x·2^1074.
fn scaled(x: f64) -> BigInt {
    let bits = x.abs().to_bits();
    let (exponent, mantissa) = (bits >> 52, bits & ((1 << 52) - 1));
    let integer = match exponent {
        0 => BigInt::from(mantissa),
        _ => BigInt::from(mantissa | (1 << 52)) << (exponent - 1),
    };
    if x.is_sign_negative() {
        -integer
    } else {
        integer
    }
}

/// Returns n/d as a float, with a small error.
fn quotient(n: &BigUint, d: &BigUint) -> f64 {
    let shift = d.bits().saturating_sub(64);
    let top = |n: &BigUint| (n >> shift).to_f64().unwrap_or(f64::INFINITY);
    // The numerator is scaled first, so that it keeps its digits even if it is much smaller than d.
    top(&(n << 160_u32)) / top(d) * 2.0_f64.powi(-160)
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

    fn of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[usize::try_from(self.bits() >> 40).unwrap_or(0) % choices.len()]
    }

    /// Returns any finite float, a moderate one, or one at a limit of f64 or of the algorithms.
    fn float(&mut self) -> f64 {
        let limit = self.of(&[0, 1, 122, 123, 222, 572, 1534, 1982, 1983, 2045, 2046]);
        let moderate = 990 + (self.bits() >> 58);
        let any = self.bits() % 2047;
        let exponent = self.of(&[limit, moderate, moderate, any]);
        let mantissa = self.bits() >> 12;
        let mantissa = self.of(&[mantissa, mantissa, mantissa, 0, 1, (1 << 52) - 1]);
        f64::from_bits((exponent << 52) | mantissa) * self.of(&[1.0, -1.0])
    }

    /// Returns two floats: independent, cancelling, or with a product at a limit.
    fn pair(&mut self) -> (f64, f64) {
        let (x, y) = (self.float(), self.float());
        let most = f64::MAX * (1.0 - 1e-7 / (1.0 + self.float().abs()));
        let partner = self.of(&[
            y,
            y,
            y,
            -x,
            (-x).next_up(),
            most / x,
            2.0_f64.powi(-900) / x,
        ]);
        (x, if partner.is_finite() { partner } else { y })
    }

    /// Returns two double-doubles. The lower part is sometimes zero, or 2^−53 of the higher part.
    fn numbers(&mut self) -> [DoubleDouble; 2] {
        let (x, y) = self.pair();
        [x, y].map(|high| {
            let unit = high * f64::EPSILON / 2.0;
            let any = unit * (f64::from_bits((1023 << 52) | (self.bits() >> 12)) - 1.0);
            let low = self.of(&[any, any, -any, unit, 0.0]);
            DoubleDouble::new(high) + DoubleDouble::new(low)
        })
    }
}

/// Returns the nanoseconds of an operation in `f64`, double-double and interval.
fn times(operation: Operation, calls: u32) -> [f64; 3] {
    let mut random = Random(1998);
    let mut moderate = || f64::from_bits((1023 << 52) | (random.bits() >> 12));
    let floats: Vec<[f64; 2]> = (0..64).map(|_| [moderate(), moderate()]).collect();
    [
        time(operation, calls, &floats),
        time(
            operation,
            calls,
            &taken(&floats, |x| {
                DoubleDouble::new(x) + DoubleDouble::new(x * 1e-17)
            }),
        ),
        time(operation, calls, &taken(&floats, Interval::point)),
    ]
}

fn taken<T>(floats: &[[f64; 2]], image: impl Fn(f64) -> T) -> Vec<[T; 2]> {
    floats.iter().map(|pair| pair.map(&image)).collect()
}

/// Returns the smallest time of five rounds, which has the least disturbance.
fn time<T: Field>(operation: Operation, calls: u32, pairs: &[[T; 2]]) -> f64 {
    let round = || {
        let start = Instant::now();
        for _ in 0..calls {
            for [a, b] in black_box(pairs) {
                black_box(operation.apply(a.clone(), b));
            }
        }
        start.elapsed().as_secs_f64() * 1e9 / f64::from(calls) / 64.0
    };
    (0..5).map(|_| round()).fold(f64::INFINITY, f64::min)
}
