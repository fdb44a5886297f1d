//! The texts of enums with named variants.

/// Implements `Display` and `FromStr` for an enum with a method `name`. With the feature `serde`, the enum is
/// serialised as its name.
macro_rules! named {
    ($type:ty, $all:expr, $expected:literal) => {
        impl core::fmt::Display for $type {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                f.pad(self.name())
            }
        }

        impl core::str::FromStr for $type {
            type Err = $crate::Error;

            fn from_str(text: &str) -> Result<Self, $crate::Error> {
                let found = $all.into_iter().find(|found| found.name() == text);
                found.ok_or_else(|| $crate::Error::syntax(text, $expected))
            }
        }

        #[cfg(feature = "serde")]
        $crate::data::as_text!($type);
    };
}

pub(crate) use named;
