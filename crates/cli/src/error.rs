//! The errors of all crates, in one type.

use core::fmt;

/// The exit status of a usage error, with one line on stderr and nothing on stdout.
pub(crate) const USAGE_ERROR: u8 = 2;

/// Defines the error of all crates: a variant for each crate, and the variants of its own error that wrap another crate's.
macro_rules! errors {
    ($($name:ident: $of:ident wraps $($inner:ident)*;)*) => {
        /// An error of one of the crates below the command line.
        ///
        /// The conversions unwrap nested errors: an error of the crate `cannonpile` is always [`Core`](Self::Core), whatever
        /// crate returned it.
        #[derive(Clone, Debug, PartialEq, Eq)]
        pub(crate) enum Error {
            $($name($of::Error),)*
        }

        impl fmt::Display for Error {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                match self {
                    $(Self::$name(error) => error.fmt(f),)*
                }
            }
        }

        $(impl From<$of::Error> for Error {
            fn from(error: $of::Error) -> Self {
                match error {
                    $($of::Error::$inner(error) => error.into(),)*
                    error => Self::$name(error),
                }
            }
        })*
    };
}

errors! {
    Core: cannonpile wraps;
    Stability: cannonpile_stability wraps Core;
    Horizontal: cannonpile_horizontal wraps Core Stability;
    Disorder: cannonpile_disorder wraps Core;
    Dem: cannonpile_dem wraps Core Stability Horizontal;
    Figure: cannonpile_figure wraps Core Stability Horizontal Disorder Dem;
    Proof: cannonpile_proof wraps Core;
}

impl core::error::Error for Error {}
