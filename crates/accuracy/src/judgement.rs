//! What [`judge`](crate::judge) found out about a number type.

use core::fmt;

use core::any::type_name;

use cannonpile::scalar::{Algebra, Exactness};

/// The verdict on a number type, from [`judge`](crate::judge). It prints as ten lines.
///
/// Errors are in units of [`unit`](Self::unit). For forces they are relative to the largest force of the pile or layer.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Judgement {
    /// The name of the type, without paths.
    pub scalar: String,
    /// What the type promises.
    pub exactness: Exactness,
    /// The promises that it broke. For a type that promises nothing: what differs from a float that rounds to nearest.
    pub findings: Vec<Finding>,
    /// The number of laws that were checked, each on its operands.
    pub law_count: usize,
    /// The unit u of errors: 2^−p for a type that promises p bits, 0 for types that promise exact results or enclosures.
    /// For other types it is the largest relative error of a single operation.
    pub unit: f64,
    /// The largest relative error of a single operation, in u.
    pub largest_operation_error: f64,
    /// The number of forces that were compared with exact ones, on several piles.
    pub force_count: usize,
    /// The number of forces that the type refused, because it cannot hold them.
    pub refused_count: usize,
    /// The largest error of these forces, in u.
    pub largest_force_error: f64,
    /// The error below many sign changes.
    pub growth: Vec<Growth>,
    /// The largest e for which 2^e is defined, if it was found.
    pub largest_power: Option<i64>,
    /// The smallest e for which 2^e is defined and not zero, if it was found.
    pub smallest_power: Option<i64>,
    /// The smallest k for which 2^k + 1 = 2^k, if there is one.
    pub stagnation: Option<i64>,
    /// The time to compute a contact force of HCP of 40 layers, in seconds, if the type can hold them. It never decides
    /// anything.
    pub seconds_per_force: Option<f64>,
}

/// The largest error of all contact forces above the bottom layer, in HCP under a hexagon of side 4.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Growth {
    /// The number of layers L.
    pub layers: i128,
    /// The error in u times the largest of these forces, or `None` if the type cannot hold one of them.
    pub error: Option<f64>,
    /// The error over √L·u.
    pub error_per_root_of_layers: Option<f64>,
}

/// A promise that was broken.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Finding {
    /// The check that found it.
    pub check: Check,
    /// The operation with its operands, the result, and the true result.
    pub witness: String,
}

/// The checks of [`judge`](crate::judge).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Check {
    /// The laws of the core, [`cannonpile::scalar::laws`].
    Laws,
    /// Single operations against exact ones.
    Operations,
    /// Piles with exact answers.
    Piles,
    /// The growth of the error with the number of layers.
    Growth,
    /// Results beyond the largest number.
    Overflow,
    /// Results near the smallest positive number, subnormal ones included.
    Underflow,
    /// The first x with x + 1 = x.
    Stagnation,
}

impl Judgement {
    pub(crate) fn new<T: Algebra>() -> Self {
        Self {
            scalar: without_paths(type_name::<T>()),
            exactness: T::EXACTNESS,
            findings: Vec::new(),
            law_count: 0,
            unit: 0.0,
            largest_operation_error: 0.0,
            force_count: 0,
            refused_count: 0,
            largest_force_error: 0.0,
            growth: Vec::new(),
            largest_power: None,
            smallest_power: None,
            stagnation: None,
            seconds_per_force: None,
        }
    }

    /// Returns whether the type kept its promise. A type that promises nothing keeps it.
    #[must_use]
    pub fn keeps_promise(&self) -> bool {
        self.findings.is_empty() || promise(self.exactness).is_none()
    }
}

/// Returns a promise in words, or `None` if there is none.
fn promise(exactness: Exactness) -> Option<String> {
    match exactness {
        Exactness::Exact => Some("every result is exact".into()),
        Exactness::ExactOrFault => Some("every result is exact or a fault".into()),
        Exactness::Enclosure => Some("every result contains the true value".into()),
        Exactness::Rounded { bits } => Some(format!(
            "every result has a relative error of at most 2^-{bits}"
        )),
        _ => None,
    }
}

impl fmt::Display for Judgement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (scalar, found) = (&self.scalar, self.findings.len());
        match promise(self.exactness) {
            Some(promise) if found == 0 => writeln!(f, "{scalar} keeps its promise: {promise}")?,
            Some(promise) => writeln!(f, "{scalar} BREAKS its promise: {promise}")?,
            None => writeln!(f, "{scalar} promises nothing; {found} findings")?,
        }
        let growth = self.growth.iter().map(|row| error(row.error));
        let error_per_root_of_layers = self
            .growth
            .iter()
            .map(|row| error(row.error_per_root_of_layers));
        let layers = self.growth.iter().map(|row| row.layers.to_string());
        let [worst, largest_force_error] =
            [self.largest_operation_error, self.largest_force_error].map(|x| error(Some(x)));
        let (forces, refused) = (self.force_count, self.refused_count);
        let [largest, smallest, first] =
            [self.largest_power, self.smallest_power, self.stagnation].map(power);
        let rows = [
            (Check::Laws, format!("{} checked", self.law_count)),
            (
                Check::Operations,
                format!("error {worst}; {}", unit(self.unit)),
            ),
            (
                Check::Piles,
                format!("{forces} forces, {refused} refused; error {largest_force_error}"),
            ),
            (
                Check::Growth,
                format!("L = {}; error {}", joined(layers), joined(growth)),
            ),
            (Check::Overflow, format!("largest power of two {largest}")),
            (
                Check::Underflow,
                format!("smallest power of two {smallest}"),
            ),
            (Check::Stagnation, format!("x + 1 = x from {first}")),
        ];
        for (check, text) in rows {
            let finding = self.findings.iter().find(|finding| finding.check == check);
            write!(f, "{:12}{text}", format!("{check:?}").to_lowercase())?;
            match finding {
                Some(Finding { witness, .. }) => writeln!(f, "; WRONG: {witness}")?,
                None => writeln!(f)?,
            }
        }
        writeln!(f, "growth/√L   error {}", joined(error_per_root_of_layers))?;
        match self.seconds_per_force {
            Some(time) => write!(
                f,
                "time        {:.1} ns for each force, not judged",
                1e9 * time
            ),
            None => f.write_str("time        refused"),
        }
    }
}

fn joined(texts: impl Iterator<Item = String>) -> String {
    texts.collect::<Vec<_>>().join(", ")
}

fn error(error: Option<f64>) -> String {
    match error {
        Some(0.0) => "none".into(),
        Some(error) => format!("{error:.2} u"),
        None => "refused".into(),
    }
}

fn power(e: Option<i64>) -> String {
    e.map_or_else(|| "not found".into(), |e| format!("2^{e}"))
}

/// Returns the unit of errors in words.
fn unit(unit: f64) -> String {
    if unit == 0.0 {
        "no error is allowed".into()
    } else {
        format!("u = 2^{:.2}", unit.log2())
    }
}

/// Returns the name of a type without the paths of its parts: `Plain<bf16>`.
fn without_paths(name: &str) -> String {
    let parts = name.split_inclusive(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'));
    parts
        .map(|part| part.rsplit("::").next().map_or(part, |last| last))
        .collect()
}
