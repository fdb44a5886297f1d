//! Stackings: sequences of Hägg signs, stored as runs, and their usual notations.
//!
//! Each step from one layer to the next has a Hägg sign. Under + the sphere (i, j) is supported by (i, j), (i+1, j),
//! (i, j+1) of the layer below, under − by (i, j), (i−1, j), (i, j−1). Two terms recur in this crate:
//!
//! * A *run* is a maximal sequence of steps with equal Hägg signs. Within a run the layers follow one another as in
//!   fcc.
//! * A *sign change* is the layer between two runs: a stacking fault in an fcc sequence.
//!
//! A stacking without a sign change is *straight*. The stacking with + only is the paper's pile and has the structure
//! fcc. Alternating signs give hcp, and ++−− repeated gives dhcp. Four notations describe the same stacking:
//!
//! | notation | for ++−+ | |
//! |---|---|---|
//! | Hägg | `++-+` | one sign per step |
//! | ABC | `ABCBC` | one letter per layer; A→B→C→A is + |
//! | Jagodzinski | `chh` | one letter per inner layer: h at a sign change, c elsewhere |
//! | Zhdanov | `(2,1,1)` | the lengths of the runs |
//!
//! The last two do not determine the first sign, which is then +.

mod notation;

pub use notation::Notation;

use alloc::vec::Vec;
use core::fmt;
use core::str::FromStr;

use crate::Error;
use crate::lattice::{MAX_LAYERS, Sign};

/// A run: consecutive steps with equal Hägg signs.
///
/// # Examples
/// ```
/// use cannonpile::lattice::Sign;
/// use cannonpile::stacking::{Run, Stacking};
///
/// let stacking: Stacking = "+++-".parse()?;
/// let first = stacking.runs().next();
/// assert_eq!(first, Some(Run { sign: Sign::Plus, steps: 3 }));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(::serde::Serialize, ::serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub struct Run {
    /// The sign of the steps.
    pub sign: Sign,
    /// The number of steps, at least 1.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub steps: i128,
}

/// The Hägg signs of the steps of a pile, from the top, stored as runs. Neighbouring runs have opposite signs.
///
/// A stacking of 10¹⁵ layers with three sign changes is stored as four runs.
///
/// # Examples
/// ```
/// use cannonpile::lattice::Sign;
/// use cannonpile::stacking::{Notation, Stacking};
///
/// let stacking: Stacking = "++-+".parse()?;
/// assert_eq!((stacking.layers(), stacking.changes()), (5, 2));
/// assert_eq!(stacking.in_notation(Notation::Abc).to_string(), "ABCBC");
/// assert_eq!(stacking.in_notation(Notation::Zhdanov).to_string(), "(2,1,1)");
/// assert_eq!(stacking.mirrored().in_notation(Notation::Hagg).to_string(), "--+-");
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Stacking {
    first: Sign,
    /// The positive lengths of the runs, whose signs alternate.
    lengths: Vec<i128>,
}

impl Stacking {
    /// Returns the stacking of one layer, without steps.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::stacking::Stacking;
    ///
    /// assert_eq!(Stacking::single_layer().layers(), 1);
    /// ```
    #[must_use]
    pub const fn single_layer() -> Self {
        Self {
            first: Sign::Plus,
            lengths: Vec::new(),
        }
    }

    /// Returns the stacking with these runs, from the top. Adjacent runs of equal sign are joined, and empty runs are
    /// ignored.
    ///
    /// # Errors
    /// [`Error::RunLength`] for a negative length, [`Error::Layers`] beyond 10³⁶ layers, [`Error::TooManyRuns`] beyond
    /// a million runs.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Sign;
    /// use cannonpile::stacking::{Notation, Run, Stacking};
    ///
    /// let runs = [(Sign::Plus, 2), (Sign::Plus, 1), (Sign::Minus, 5)].map(|(sign, steps)| Run { sign, steps });
    /// assert_eq!(Stacking::from_runs(runs)?.in_notation(Notation::Zhdanov).to_string(), "(3,5)");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn from_runs(runs: impl IntoIterator<Item = Run>) -> Result<Self, Error> {
        let mut stacking = Self::single_layer();
        let mut last = None;
        let mut layers: i128 = 1;
        for Run { sign, steps } in runs {
            if steps < 0 {
                return Err(Error::RunLength { given: steps });
            }
            layers = layers.saturating_add(steps);
            if layers > MAX_LAYERS {
                return Err(Error::Layers {
                    given: layers.into(),
                });
            }
            if steps == 0 {
                continue;
            }
            match stacking.lengths.last_mut() {
                Some(length) if last == Some(sign) => *length += steps,
                _ => {
                    if last.is_none() {
                        stacking.first = sign;
                    }
                    if stacking.lengths.len() >= MAX_RUNS {
                        return Err(Error::TooManyRuns { limit: MAX_RUNS });
                    }
                    stacking.lengths.push(steps);
                }
            }
            last = Some(sign);
        }
        Ok(stacking)
    }

    /// Returns the stacking with these signs, from the top.
    ///
    /// # Errors
    /// As for [`from_runs`](Self::from_runs).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Sign;
    /// use cannonpile::stacking::{Notation, Stacking};
    ///
    /// let stacking = Stacking::from_signs([Sign::Minus, Sign::Plus])?;
    /// assert_eq!(stacking.in_notation(Notation::Hagg).to_string(), "-+");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn from_signs(signs: impl IntoIterator<Item = Sign>) -> Result<Self, Error> {
        Self::from_runs(signs.into_iter().map(|sign| Run { sign, steps: 1 }))
    }

    /// Returns the stacking with + steps only: fcc, the paper's pile.
    ///
    /// # Errors
    /// [`Error::Layers`] unless 1 ≤ `layers` ≤ 10³⁶.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::stacking::{Notation, Stacking};
    ///
    /// assert_eq!(Stacking::fcc(4)?.in_notation(Notation::Hagg).to_string(), "+++");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fcc(layers: i128) -> Result<Self, Error> {
        Self::periodic(layers, 0)
    }

    /// Returns the stacking + − + − …: hexagonal close packing (hcp).
    ///
    /// # Errors
    /// [`Error::Layers`] unless 1 ≤ `layers` ≤ 10³⁶; [`Error::TooManyRuns`] for more than [`MAX_RUNS`] runs.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::stacking::{Notation, Stacking};
    ///
    /// assert_eq!(Stacking::hcp(4)?.in_notation(Notation::Hagg).to_string(), "+-+");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn hcp(layers: i128) -> Result<Self, Error> {
        Self::periodic(layers, 1)
    }

    /// Returns the stacking + + − − …: double hexagonal close packing (dhcp).
    ///
    /// # Errors
    /// As for [`hcp`](Self::hcp).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::stacking::{Notation, Stacking};
    ///
    /// assert_eq!(Stacking::dhcp(4)?.in_notation(Notation::Hagg).to_string(), "++-");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn dhcp(layers: i128) -> Result<Self, Error> {
        Self::periodic(layers, 2)
    }

    /// Returns runs of `length` steps with alternating signs. The last run has the remaining steps. A `length` of 0
    /// gives a single run.
    fn periodic(layers: i128, length: i128) -> Result<Self, Error> {
        if !(1..=MAX_LAYERS).contains(&layers) {
            return Err(Error::Layers {
                given: layers.into(),
            });
        }
        let steps = layers - 1;
        let length = if length == 0 { steps.max(1) } else { length };
        let (whole, rest) = (steps / length, steps % length);
        let whole = usize::try_from(whole).ok();
        let whole = whole.filter(|whole| whole.saturating_add(usize::from(rest > 0)) <= MAX_RUNS);
        let whole = whole.ok_or(Error::TooManyRuns { limit: MAX_RUNS })?;
        let mut lengths = alloc::vec![length; whole];
        lengths.extend(Some(rest).filter(|rest| *rest > 0));
        Ok(Self {
            first: Sign::Plus,
            lengths,
        })
    }

    /// Returns the number L of layers, which is one more than the number of steps.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::stacking::Stacking;
    ///
    /// assert_eq!("++-".parse::<Stacking>()?.layers(), 4);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn layers(&self) -> i128 {
        // The sum is at most 10³⁶, as the constructors check.
        self.lengths.iter().sum::<i128>() + 1
    }

    /// Returns the number d of sign changes.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::stacking::Stacking;
    ///
    /// assert_eq!("++-+".parse::<Stacking>()?.changes(), 2);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn changes(&self) -> usize {
        self.lengths.len().saturating_sub(1)
    }

    /// Returns whether the stacking is straight: all its signs are equal.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::stacking::Stacking;
    ///
    /// assert!("---".parse::<Stacking>()?.is_straight());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn is_straight(&self) -> bool {
        self.changes() == 0
    }

    /// Returns the runs, from the top.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::stacking::Stacking;
    ///
    /// let stacking: Stacking = "++-+".parse()?;
    /// assert!(stacking.runs().map(|run| run.steps).eq([2, 1, 1]));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn runs(&self) -> impl DoubleEndedIterator<Item = Run> + ExactSizeIterator + '_ {
        let signs = [self.first, -self.first];
        self.lengths.iter().enumerate().map(move |(n, steps)| Run {
            sign: if n % 2 == 0 { signs[0] } else { signs[1] },
            steps: *steps,
        })
    }

    /// Returns the signs from the top, one for each step.
    ///
    /// The iterator has one item per step. For stackings of very many layers, use [`runs`](Self::runs).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Sign;
    /// use cannonpile::stacking::Stacking;
    ///
    /// let stacking: Stacking = "+-".parse()?;
    /// assert!(stacking.signs().eq([Sign::Plus, Sign::Minus]));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn signs(&self) -> impl Iterator<Item = Sign> + '_ {
        self.runs()
            .flat_map(|run| (0..run.steps).map(move |_| run.sign))
    }

    /// Returns `fcc`, `hcp` or `dhcp` if the steps follow this pattern from the first one on. A stacking of one or two
    /// layers is `fcc` unless its sign is −.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::stacking::Stacking;
    ///
    /// assert_eq!("+-+-".parse::<Stacking>()?.name(), Some("hcp"));
    /// assert_eq!("++--+".parse::<Stacking>()?.name(), Some("dhcp"));
    /// assert_eq!("-".parse::<Stacking>()?.name(), None);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn name(&self) -> Option<&'static str> {
        if self.first == Sign::Minus {
            return None;
        }
        if self.is_straight() {
            return Some("fcc");
        }
        let named = |length: i128| {
            let (last, whole) = self.lengths.split_last()?;
            let runs = whole.iter().all(|steps| *steps == length) && *last <= length;
            runs.then_some(())
        };
        match (named(1), named(2)) {
            (Some(()), _) => Some("hcp"),
            (None, Some(())) => Some("dhcp"),
            (None, None) => None,
        }
    }

    /// Returns the stacking with every sign reversed: its mirror image (i, j) → (−i, −j).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::stacking::{Notation, Stacking};
    ///
    /// let stacking: Stacking = "++-".parse()?;
    /// assert_eq!(stacking.mirrored().in_notation(Notation::Hagg).to_string(), "--+");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let first = if self.lengths.is_empty() {
            self.first
        } else {
            -self.first
        };
        Self {
            first,
            lengths: self.lengths.clone(),
        }
    }

    /// Returns the stacking with its steps in reverse order, as read from the bottom.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::stacking::{Notation, Stacking};
    ///
    /// let stacking: Stacking = "++-".parse()?;
    /// assert_eq!(stacking.reversed().in_notation(Notation::Hagg).to_string(), "-++");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn reversed(&self) -> Self {
        let first = self.runs().next_back().map_or(Sign::Plus, |run| run.sign);
        Self {
            first,
            lengths: self.lengths.iter().rev().copied().collect(),
        }
    }
}

/// A pattern of Hägg signs that extends to any number of layers, or a stacking that is spelled out.
///
/// # Examples
/// ```
/// use cannonpile::stacking::{Pattern, Stacking};
///
/// assert_eq!(Pattern::Dhcp.stacking(6)?.to_string(), "++--+");
/// let spelled = Pattern::Spelled("++-".parse()?);
/// assert_eq!(spelled.layers(), Some(4));
/// assert!(spelled.stacking(5).is_err());
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Pattern {
    /// The signs `+ + + …`: face-centred cubic.
    Fcc,
    /// The signs `+ − + − …`: hexagonal close packing.
    Hcp,
    /// The signs `+ + − − …`: double hexagonal close packing.
    Dhcp,
    /// The steps of a given stacking.
    Spelled(Stacking),
}

impl Pattern {
    /// Returns the number of layers of a stacking that is spelled out, or `None` for a pattern.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::stacking::Pattern;
    ///
    /// assert_eq!(Pattern::Hcp.layers(), None);
    /// assert_eq!(Pattern::Spelled("++-".parse()?).layers(), Some(4));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn layers(&self) -> Option<i128> {
        match self {
            Self::Spelled(stacking) => Some(stacking.layers()),
            _ => None,
        }
    }

    /// Returns the stacking with `layers` layers.
    ///
    /// # Errors
    /// [`Error::Layers`] and [`Error::TooManyRuns`], as for [`Stacking::hcp`]; [`Error::LayersOfStacking`] if the
    /// stacking is spelled out and has another number of layers.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Error;
    /// use cannonpile::stacking::Pattern;
    ///
    /// assert_eq!(Pattern::Hcp.stacking(4)?.to_string(), "+-+");
    /// let spelled = Pattern::Spelled("++-".parse()?);
    /// assert_eq!(spelled.stacking(4)?.to_string(), "++-");
    /// assert!(matches!(spelled.stacking(5), Err(Error::LayersOfStacking { layers: 5, spelled: 4, .. })));
    /// # Ok::<(), Error>(())
    /// ```
    pub fn stacking(&self, layers: i128) -> Result<Stacking, Error> {
        match self {
            Self::Fcc => Stacking::fcc(layers),
            Self::Hcp => Stacking::hcp(layers),
            Self::Dhcp => Stacking::dhcp(layers),
            Self::Spelled(stacking) if stacking.layers() == layers => Ok(stacking.clone()),
            Self::Spelled(stacking) => Err(Error::LayersOfStacking {
                layers,
                spelled: stacking.layers(),
            }),
        }
    }
}

impl fmt::Display for Pattern {
    /// Prints the name of the pattern, or the stacking. [`FromStr`] reads both.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fcc => f.pad("fcc"),
            Self::Hcp => f.pad("hcp"),
            Self::Dhcp => f.pad("dhcp"),
            Self::Spelled(stacking) => stacking.fmt(f),
        }
    }
}

impl FromStr for Pattern {
    type Err = Error;

    /// Parses `fcc`, `hcp`, `dhcp`, or a stacking that is spelled out in one of the four notations.
    ///
    /// # Errors
    /// As for parsing a [`Stacking`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::stacking::Pattern;
    ///
    /// assert_eq!("hcp".parse::<Pattern>()?, Pattern::Hcp);
    /// assert_eq!("HCP".parse::<Pattern>()?, Pattern::Hcp);
    /// assert_eq!("ABCB".parse::<Pattern>()?, Pattern::Spelled("++-".parse()?));
    /// assert!("bcc".parse::<Pattern>().is_err());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    fn from_str(text: &str) -> Result<Self, Error> {
        Ok(match text.to_ascii_lowercase().as_str() {
            "fcc" => Self::Fcc,
            "hcp" => Self::Hcp,
            "dhcp" => Self::Dhcp,
            _ => Self::Spelled(text.parse()?),
        })
    }
}

/// The greatest number of runs in a stacking.
pub const MAX_RUNS: usize = 1_000_000;

#[cfg(feature = "serde")]
crate::data::as_text!(Stacking, Pattern);
