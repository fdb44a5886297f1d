//! The Rust examples of the guide, run as tests.

/// `docs/numbers.md`.
#[doc = include_str!("../../../docs/numbers.md")]
struct Numbers;

/// `docs/check-your-dem-code.md`, whose examples need another crate.
#[cfg(feature = "dem")]
#[doc = include_str!("../../../docs/check-your-dem-code.md")]
struct CheckYourDemCode;
