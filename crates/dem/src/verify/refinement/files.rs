//! The files of a refinement study, as a user names them.

use core::fmt;
use core::str::FromStr;
use std::path::PathBuf;

use super::{MAX_LEVELS, NoRefinement, check_parameter, repeated};
use crate::error::quoted;

/// A file with the forces of one simulation, and its stiffness or time step.
#[derive(Clone, Debug, PartialEq)]
pub struct RefinementFile {
    /// The stiffness or the time step, positive.
    pub parameter: f64,
    /// The path of the file.
    pub path: PathBuf,
}

/// The files of a refinement study, parsed from `K1=FILE1,K2=FILE2`: each file with its stiffness or time step. A file
/// name begins after the first `=` and ends at a comma.
///
/// # Examples
/// ```
/// use cannonpile_dem::verify::RefinementFiles;
///
/// let RefinementFiles(files) = "1e5=soft.csv,1e6=stiff=2.csv".parse()?;
/// assert_eq!(files.iter().map(|file| file.parameter).collect::<Vec<_>>(), [1e5, 1e6]);
/// assert_eq!(files[1].path, std::path::Path::new("stiff=2.csv"));
///
/// let refused = "1e5=soft.csv,stiff.csv".parse::<RefinementFiles>().unwrap_err();
/// assert_eq!(refused.to_string(), "'stiff.csv' has no =: write each file as PARAMETER=FILE, as in 1e6=stiff.csv");
/// # Ok::<(), cannonpile_dem::verify::NoRefinementFiles>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RefinementFiles(pub Vec<RefinementFile>);

/// The reason why a list names no files of a refinement study: one line with the remedy.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum NoRefinementFiles {
    /// An entry without a `=`.
    NoEquals {
        /// The entry, shortened if it is long.
        entry: String,
    },
    /// An entry without a file after the `=`.
    NoFile {
        /// The entry, shortened if it is long.
        entry: String,
    },
    /// An entry without a number before the `=`.
    NoNumber {
        /// The text before the `=`, shortened if it is long.
        text: String,
    },
    /// The parameters do not form a refinement study.
    RefinementStudy(NoRefinement),
}

impl fmt::Display for NoRefinementFiles {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoEquals { entry } => write!(
                f,
                "'{entry}' has no =: write each file as PARAMETER=FILE, as in 1e6=stiff.csv"
            ),
            Self::NoFile { entry } => {
                write!(
                    f,
                    "'{entry}' names no file: give one after the =, as in 1e6=stiff.csv"
                )
            }
            Self::NoNumber { text } => write!(
                f,
                "'{text}' is not a number: give the stiffness or the time step before the =, as in 1e6=stiff.csv"
            ),
            Self::RefinementStudy(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for NoRefinementFiles {}

impl FromStr for RefinementFiles {
    type Err = NoRefinementFiles;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let mut files = Vec::new();
        for entry in text.split(',') {
            let shown = || quoted(entry);
            let (parameter, path) = entry
                .split_once('=')
                .ok_or_else(|| NoRefinementFiles::NoEquals { entry: shown() })?;
            if path.is_empty() {
                return Err(NoRefinementFiles::NoFile { entry: shown() });
            }
            let parameter = parameter.trim();
            let parameter = parameter.parse().map_err(|_| NoRefinementFiles::NoNumber {
                text: quoted(parameter),
            })?;
            check_parameter(parameter).map_err(NoRefinementFiles::RefinementStudy)?;
            if files.len() == MAX_LEVELS {
                let many = NoRefinement::TooMany { limit: MAX_LEVELS };
                return Err(NoRefinementFiles::RefinementStudy(many));
            }
            let path = path.into();
            files.push(RefinementFile { parameter, path });
        }
        let mut parameters: Vec<f64> = files.iter().map(|file| file.parameter).collect();
        parameters.sort_by(f64::total_cmp);
        match repeated(parameters.into_iter()) {
            Some(parameter) => Err(NoRefinementFiles::RefinementStudy(NoRefinement::Twice {
                parameter,
            })),
            None => Ok(Self(files)),
        }
    }
}
