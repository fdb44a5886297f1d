//! The rows of the table.

use std::fmt;
use std::hint::black_box;
use std::time::Instant;

use astro_float::BigFloat;
use cannonpile::Error;
use cannonpile::num_bigint::BigInt;
use cannonpile::num_rational::{BigRational, Ratio};
use cannonpile::num_traits::{Pow, ToPrimitive, Zero};
use cannonpile::scalar::promise::{Exact, Rounded};
use cannonpile::scalar::{Algebra, DoubleDouble, Exactness, FixedRational, Interval, Plain};
use cannonpile::shape::Selection;
use dashu_ratio::RBig;
use fixed::types::I96F32;
use half::{bf16, f16};
use num_dual::Dual64;
use softposit::P32;
use twofloat::TwoFloat;

use crate::error::{Reference, Unit, below, pile};
use crate::newtypes::astro::Astro;
use crate::newtypes::enclosure::Enclosure;
use crate::newtypes::quad::Quad;
use crate::newtypes::residue::{PRIME, Residue};

const LAYERS: [i128; 3] = [10, 40, 160];

/// A row of the table of the page.
pub struct Row {
    /// The first columns: type, lines of glue, exactness, errors.
    pub columns: String,
    pub nanoseconds: Option<f64>,
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.nanoseconds {
            Some(time) if time < 10.0 => write!(f, "{} {time:.1} |", self.columns),
            Some(time) => write!(f, "{} {time:.0} |", self.columns),
            None => f.write_str(&self.columns),
        }
    }
}

/// Computes with each type.
struct Table {
    references: Vec<Reference>,
    rows: Vec<Row>,
    /// Whether all errors and the times are wanted.
    is_full: bool,
}

/// Returns the rows. Those that are not full have no times, and no errors of 160 layers of types beyond a word.
pub fn rows(is_full: bool) -> Result<Vec<Row>, Error> {
    let references: Result<_, _> = LAYERS.into_iter().map(Reference::new).collect();
    let mut table = Table {
        references: references?,
        rows: Vec::new(),
        is_full,
    };
    table.floats()?;
    table.others()?;
    table.own()?;
    Ok(table.rows)
}

impl Table {
    fn floats(&mut self) -> Result<(), Error> {
        let float = |x: f64| [BigRational::from_float(x).expect("a finite float")];
        self.row(
            "half `f16`",
            0,
            Unit::Roundoff(11),
            |x: &Plain<f16, Rounded>| float(x.0.into()),
        )?;
        self.row(
            "half `bf16`",
            0,
            Unit::Roundoff(8),
            |x: &Plain<bf16, Rounded>| float(x.0.into()),
        )?;
        self.row("`f32`", 0, Unit::Roundoff(24), |x: &Plain<f32, Rounded>| {
            float(x.0.into())
        })?;
        self.row("`f64`", 0, Unit::Roundoff(53), |x: &Plain<f64, Rounded>| {
            float(x.0)
        })?;
        self.row(
            "twofloat `TwoFloat`",
            0,
            Unit::Roundoff(106),
            |x: &Plain<TwoFloat>| {
                let [[high], [low]] = [x.0.hi(), x.0.lo()].map(float);
                [high + low]
            },
        )?;
        self.row(
            "num-dual `Dual64`",
            0,
            Unit::Roundoff(53),
            |x: &Plain<Dual64>| float(x.0.re),
        )?;
        self.row(
            "softposit `P32`",
            0,
            Unit::Roundoff(28),
            |x: &Plain<P32>| float(x.0.to_f64()),
        )?;
        self.row(
            "fixed `I96F32`",
            0,
            Unit::Resolution(32),
            |x: &Plain<I96F32>| {
                [BigRational::new(
                    x.0.to_bits().into(),
                    BigInt::from(1_u64 << 32),
                )]
            },
        )?;
        let lines = glue(include_str!("newtypes/quad.rs"));
        self.row(
            "dashu `FBig`, 113 bits",
            lines,
            Unit::Roundoff(113),
            |x: &Quad| {
                let (significand, exponent) = x.0.repr().clone().into_parts();
                let significand = i128::try_from(significand).expect("113 bits");
                [dyadic(
                    significand.into(),
                    exponent.try_into().expect("a small exponent"),
                )]
            },
        )?;
        let lines = glue(include_str!("newtypes/astro.rs"));
        self.row(
            "astro-float `BigFloat`, 128 bits",
            lines,
            Unit::Roundoff(128),
            |x: &Astro| [exactly(&x.0)],
        )
    }

    fn others(&mut self) -> Result<(), Error> {
        let lines = glue(include_str!("newtypes/enclosure.rs"));
        self.row(
            "puremp `Interval`, 53 bits",
            lines,
            Unit::Roundoff(53),
            |x: &Enclosure| {
                [x.0.lower(), x.0.upper()]
                    .map(|end| BigRational::from_float(end.to_f64()).expect("a finite float"))
            },
        )?;
        self.row("dashu `RBig`", 0, Unit::None, |x: &Plain<RBig, Exact>| {
            let sign = BigInt::from_signed_bytes_le(&x.0.numerator().to_le_bytes());
            [BigRational::new_raw(
                sign,
                BigInt::from_bytes_le(num_bigint::Sign::Plus, &x.0.denominator().to_le_bytes()),
            )]
        })?;
        #[cfg(feature = "malachite")]
        {
            use crate::newtypes::malachite::Malachite;
            let lines = glue(include_str!("newtypes/malachite.rs"));
            self.row(
                "malachite `Rational`",
                lines,
                Unit::None,
                |x: &Malachite| [x.0.to_string().parse().expect("a fraction")],
            )?;
        }
        self.residues()?;
        let refused = self.references[0].pile.forces::<Plain<Ratio<i64>>>();
        assert!(matches!(below(&refused, 8), Err(Error::Overflow { .. })));
        self.rows.push(Row {
            columns: "| num `Ratio<i64>` | 0 | refused | – | – | – | – |".to_owned(),
            nanoseconds: None,
        });
        Ok(())
    }

    /// The scalars of the library.
    fn own(&mut self) -> Result<(), Error> {
        let float = |x: f64| [BigRational::from_float(x).expect("a finite float")];
        self.row("own `f32`", 0, Unit::Roundoff(24), |&x: &f32| {
            float(x.into())
        })?;
        self.row("own `f64`", 0, Unit::Roundoff(53), |&x: &f64| float(x))?;
        self.row(
            "own `DoubleDouble`",
            0,
            Unit::Roundoff(106),
            |x: &DoubleDouble| {
                let [[high], [low]] = [x.high(), x.low()].map(float);
                [high + low]
            },
        )?;
        self.row("own `Interval`", 0, Unit::Roundoff(53), |x: &Interval| {
            [x.lower(), x.upper()].map(|end| BigRational::from_float(end).expect("a finite float"))
        })?;
        self.row(
            "own `FixedRational<i128>`",
            0,
            Unit::None,
            |x: &FixedRational<i128>| [x.to_rational().expect("no fault")],
        )?;
        self.row("own `BigRational`", 0, Unit::None, |x: &BigRational| {
            [x.clone()]
        })
    }

    fn residues(&mut self) -> Result<(), Error> {
        let lines = glue(include_str!("newtypes/residue.rs"));
        for reference in &self.references[..self.sizes::<Residue>()] {
            let residue = |n: &BigInt| Residue::from_rational(&n.clone().into());
            let denominator = residue(&reference.denominator);
            let forces = below(
                &reference.pile.forces::<Residue>(),
                reference.pile.layers() - 2,
            )?;
            for (force, exact) in forces.into_iter().zip(&reference.numerators) {
                assert_eq!(force * denominator, residue(exact), "modulo {PRIME}");
            }
        }
        self.push::<Residue>(
            "residues modulo 2⁶¹ − 1",
            lines,
            "exact modulo p",
            &vec!["0".to_owned(); self.sizes::<Residue>()],
        )
    }

    /// Returns the number of sizes of piles.
    fn sizes<T>(&self) -> usize {
        let is_word = size_of::<T>() <= size_of::<u64>();
        if self.is_full || is_word { 3 } else { 2 }
    }

    fn row<T: Algebra, const N: usize>(
        &mut self,
        name: &str,
        glue: usize,
        unit: Unit,
        ends: impl Fn(&T) -> [BigRational; N],
    ) -> Result<(), Error> {
        let exactness = match T::EXACTNESS {
            Exactness::Exact => "exact".to_owned(),
            Exactness::ExactOrFault => "exact or error".to_owned(),
            Exactness::Enclosure => "bounds".to_owned(),
            Exactness::Rounded { bits } => format!("rounded, {bits} bits"),
            _ => "unknown".to_owned(),
        };
        let mut errors = Vec::new();
        for reference in &self.references[..self.sizes::<T>()] {
            let k = reference.pile.layers() - 2;
            errors.push(match below(&reference.pile.forces::<T>(), k) {
                Ok(forces) => text(reference.worst_error(&forces, unit, &ends), unit),
                Err(Error::Overflow { .. }) => "overflow".to_owned(),
                Err(error) => return Err(error),
            });
        }
        self.push::<T>(name, glue, &exactness, &errors)
    }

    fn push<T: Algebra>(
        &mut self,
        name: &str,
        glue: usize,
        exactness: &str,
        errors: &[String],
    ) -> Result<(), Error> {
        let columns = format!("| {name} | {glue} | {exactness} | {} |", errors.join(" | "));
        let nanoseconds = self.is_full.then(time::<T>).transpose()?;
        self.rows.push(Row {
            columns,
            nanoseconds,
        });
        Ok(())
    }
}

/// Returns an error as the page prints it.
fn text(error: f64, unit: Unit) -> String {
    match unit {
        Unit::None => {
            assert!(error.is_zero(), "an exact type is off by {error:e}");
            "0".to_owned()
        }
        _ if error < 10_000.0 => format!("{error:.1}"),
        _ => format!("{error:.0e}"),
    }
}

/// Returns the lines of code of a file, without comments and blank lines.
fn glue(file: &str) -> usize {
    let is_code = |line: &&str| !line.is_empty() && !line.trim_start().starts_with("//");
    file.lines().filter(is_code).count()
}

/// Returns n·2^e.
fn dyadic(n: BigInt, e: i32) -> BigRational {
    let power = BigRational::from_integer(2.into()).pow(e);
    power * n
}

fn exactly(x: &BigFloat) -> BigRational {
    let Some((words, _, sign, exponent, _)) = x.as_raw_parts().filter(|_| !x.is_zero()) else {
        return BigRational::zero();
    };
    let words = words.iter().rev();
    let n = words.fold(BigInt::ZERO, |n, word| (n << 64) + *word);
    let bits: i32 = n.bits().try_into().expect("128 bits");
    let n = if sign == astro_float::Sign::Neg {
        -n
    } else {
        n
    };
    dyadic(n, exponent - bits)
}

/// Returns the nanoseconds of each contact force of 40 layers, on one thread: the smallest of three rounds.
fn time<T: Algebra>() -> Result<f64, Error> {
    let pile = pile(40)?;
    let forces = pile.forces::<T>();
    let round = || -> Result<f64, Error> {
        let start = Instant::now();
        let layers = forces.layers(Selection::All)?;
        let length = layers.slice_len()?;
        let mut slices = [(); 3].map(|()| vec![T::zero(); length]);
        let [alpha, beta, gamma] = &mut slices;
        layers.fill([alpha, beta, gamma])?;
        black_box(&slices);
        let contacts = 3.0 * length.to_f64().unwrap_or(f64::NAN);
        Ok(start.elapsed().as_secs_f64() * 1e9 / contacts)
    };
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let rounds = || (0..3).try_fold(f64::INFINITY, |least, _| Ok(round()?.min(least)));
    one.expect("a thread").install(rounds)
}
