//! Scalars for number types that `Plain` does not fit: one file each, and nothing but glue in it.

pub mod astro;
pub mod enclosure;
#[cfg(feature = "malachite")]
pub mod malachite;
pub mod quad;
pub mod residue;
