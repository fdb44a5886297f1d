//! The exhaustive and the fixed tests, one module a subject; shared are the answers of the library collected by pile,
//! the oracle, the judges of theorems and of roundings, and scalars that are flawed on purpose.

mod against_oracle;
mod answers;
mod clearance;
#[cfg(feature = "cli")]
mod cli;
mod counts;
mod double_double;
mod equilibrium;
mod errors;
mod extremes;
#[cfg(feature = "plot")]
mod figure;
mod fixed_width;
mod flawed;
mod flawed_scalars;
mod formula_is_what_answers;
mod geometry;
mod interval;
#[path = "../judge/mod.rs"]
mod judge;
mod laws;
mod methods;
mod nearest;
mod new_scalar_laws;
mod numbering;
mod one_body;
mod oracle;
mod pair;
#[cfg(feature = "export")]
mod pile_export;
mod planted_faults;
mod polynomial;
mod rounded;
#[path = "../rounding/mod.rs"]
mod rounding;
#[cfg(feature = "toml")]
mod scene_file;
#[cfg(feature = "serde")]
mod serialized;
mod strengths;
#[path = "../stress/mod.rs"]
mod stress;
mod stress_table;
mod sums;
mod surd;
mod symmetry;
mod theorem;
mod theorems;
#[cfg(feature = "export")]
mod verify;
mod wrong_verdicts;
