//! What a pile with horizontal contacts can bear, as something that anybody can check.
//!
//! At a = R the spheres of a layer touch, and the forces are no longer unique
//! ([`paper`](cannonpile::paper#horizontal-contacts)). What is found there is found by programs that round. So nothing is
//! answered but with a certificate: forces X of horizontal contacts, a field φ on the spheres, or both.
//! [`Certificate::check`] needs nothing but these and the balance of a sphere, and shares with what found them only its
//! formulas ([`formula`](crate::formula) here and in the [core](cannonpile::formula)), which theorems
//! `horizontal-balance` and `virtual-work` are about.
//! `check_certificate.py` in this crate's folder is a second checker, in Python, written from this page; the command
//! `check` reads the same files.
//!
//! # What is checked
//! The forces are f₀ = mg/(3cosθ) times: X ≥ 0 of the horizontal contacts, and f_l of the sloping ones, which follow
//! layer by layer from the balance of each sphere,
//!
//! f_l = (T g)_l + w − σ H_l,
//!
//! g what the sphere receives from above, T the identity or, where the sign changes, the
//! [half-turn](cannonpile::formula::half_turn), w its weight, σ = ±1 the step below, and H_l the sum of −X over its
//! horizontal contacts that lead from l, of +X over those that lead to l (of the other sphere of each with the signs
//! swapped). The field has three numbers φ_l for each sphere off the floor, and there φ = 0. With q_l the support of p,
//!
//! * drop: D_l(p) = φ_l(p) − (T φ(q_l))_l,
//! * compression: c(p; a→b) = σ((φ_b − φ_a)(p) − (φ_b − φ_a)(p′)), p′ = p + d_b − d_a,
//! * virtual work: Σ f_l D_l + Σ X c = Σ w φ_l, for **every** solution of the equations of balance.
//!
//! The last is an identity: each equation times φ, summed. It turns a field with the right signs into a proof about
//! all forces that only push:
//!
//! | claim | X | φ |
//! |---|---|---|
//! | [stands](Claim::Stands) | all f ≥ 0 | |
//! | [cannot stand](Claim::CannotStand) | | D ≤ 0, c ≤ 0, Σ w φ > 0 |
//! | [least normal force](Claim::Least) N of a bottom sphere n | attains it | D ≤ 1 at the contacts with n, D ≤ 0 at others, c ≤ 0, and N = w + Σ w φ / 3 |
//! | [greatest normal force](Claim::Greatest) | attains it | D ≥ 1 at the contacts with n, D ≥ 0 at others, c ≥ 0, and the same N |
//! | [elastic state](Claim::Elastic), with springs κ, and κ′ for horizontal contacts | all f ≥ 0 | D ≤ f, D = f where f > 0; κ′/κ · c ≤ X, equal where X > 0 |

mod check;
mod file;
mod record;
mod refusal;

pub use file::{
    MOST_BYTES, read_certificate, read_certificates, write_certificate, write_certificates,
};
pub use refusal::{Refusal, Relation};

use core::fmt;
use std::collections::BTreeMap;

use cannonpile::Pile;
use cannonpile::data::number;
use cannonpile::lattice::{HorizontalContact, Site};
use num_rational::BigRational;
use serde::{Deserialize, Serialize};

/// A claim about a pile at a = R, and all that is needed to check it.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_horizontal::certificate::{Certificate, Claim};
///
/// // Without any force between the spheres of a layer the straight pile stands.
/// let mut certificate = Certificate {
///     pile: Pile::triangular(4)?,
///     claim: Claim::Stands,
///     horizontal: [].into(),
///     field: [].into(),
/// };
/// assert_eq!(certificate.check(), Ok(()));
///
/// // HCP does not, of six layers.
/// certificate.pile = Pile::under(cannonpile::lattice::Region::SITE, "+-+-+".parse()?)?;
/// let refusal = certificate.check().unwrap_err();
/// assert!(refusal.to_string().contains("would have to pull"));
/// # Ok::<(), cannonpile_horizontal::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Certificate {
    /// The pile.
    pub pile: Pile,
    /// What is claimed of it.
    pub claim: Claim,
    /// The forces X of horizontal contacts, in f₀; none bears a force that is not here.
    pub horizontal: BTreeMap<HorizontalContact, BigRational>,
    /// The field φ by direction; zero on spheres that are not here.
    pub field: BTreeMap<Site, [BigRational; 3]>,
}

/// What a certificate claims of the forces that balance a pile at a = R and only push.
///
/// # Examples
/// ```
/// use cannonpile_horizontal::certificate::Claim;
///
/// assert_eq!(Claim::CannotStand.to_string(), "no forces that only push balance the pile: it cannot stand");
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
#[non_exhaustive]
pub enum Claim {
    /// There are such forces.
    Stands,
    /// There are none.
    CannotStand,
    /// No less is the normal force of a bottom sphere on the floor.
    Least(Extreme),
    /// No more is it.
    Greatest(Extreme),
    /// The forces are those of springs that only push: of all such forces, those of least energy.
    Elastic {
        /// κ′/κ: the stiffness of horizontal contacts over that of sloping ones.
        #[serde(with = "number")]
        stiffness_ratio: BigRational,
    },
}

/// The least or the greatest normal force of a bottom sphere.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_horizontal::certificate::{Certificate, Claim, Extreme};
/// use cannonpile::lattice::Site;
/// use num_rational::BigRational;
///
/// // No sphere can bear less than its own weight.
/// let normal = BigRational::from_integer(1.into());
/// let extreme = Extreme { site: Site { i: 1, j: 1, k: 3 }, normal, attained: false };
/// let certificate = Certificate {
///     pile: Pile::triangular(4)?,
///     claim: Claim::Least(extreme),
///     horizontal: [].into(),
///     field: [].into(),
/// };
/// assert_eq!(certificate.check(), Ok(()));
/// # Ok::<(), cannonpile_horizontal::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Extreme {
    /// The bottom sphere.
    pub site: Site,
    /// Its normal force, in mg.
    #[serde(with = "number")]
    pub normal: BigRational,
    /// Whether the forces of the certificate attain it; if not, it is a bound only.
    pub attained: bool,
}

impl fmt::Display for Claim {
    /// Prints it in words.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let extreme = |f: &mut fmt::Formatter<'_>, extreme: &Extreme, bound| {
            let Extreme {
                site,
                normal,
                attained,
            } = extreme;
            let attained = if *attained {
                "and forces attain it"
            } else {
                "whether attained or not"
            };
            write!(
                f,
                "the floor under the sphere {site} bears {bound} {normal} mg, {attained}"
            )
        };
        match self {
            Self::Stands => f.write_str("forces that only push balance the pile: it stands"),
            Self::CannotStand => {
                f.write_str("no forces that only push balance the pile: it cannot stand")
            }
            Self::Least(least) => extreme(f, least, "at least"),
            Self::Greatest(greatest) => extreme(f, greatest, "at most"),
            Self::Elastic { stiffness_ratio } => write!(
                f,
                "these are the forces of springs that only push, horizontal ones {stiffness_ratio} times as stiff as others"
            ),
        }
    }
}
