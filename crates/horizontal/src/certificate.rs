//! Certificates: claims about the forces of a pile, with data that anybody can check.
//!
//! At a = R the spheres of a layer touch, and the contact forces are not unique
//! ([`paper`](cannonpile::paper#horizontal-contacts)). The results come from solvers with rounding errors. So each
//! result comes with a certificate. It has horizontal forces X (a primal solution), a field φ on the spheres (a dual
//! solution), or both. [`Certificate::check`] uses only these numbers and the balance of a sphere. It shares only the
//! formulas with the solvers ([`formula`](crate::formula) here and in the [core](cannonpile::formula)); the theorems
//! `horizontal-balance` and `virtual-work` are about these formulas. `check_certificate.py`, in the folder of this
//! crate, is an independent checker in Python, written from this page. A third one is extracted from a proof in Coq: the
//! folder `checker` of the crate `cannonpile-proof`. The command `check` reads the same files.
//!
//! # Balance
//! Forces are in units of f₀ = mg/(3cosθ). X ≥ 0 are the forces of horizontal contacts. The forces f_l of sloping
//! contacts follow layer by layer from the balance of each sphere:
//!
//! f_l = (T g)_l + w − σ H_l.
//!
//! * g: the forces that the sphere receives from above.
//! * T: the identity, or the [half-turn](cannonpile::formula::half_turn) at a sign change.
//! * w: the weight of the sphere and the load on it, in mg.
//! * σ = ±1: the sign of the step below.
//! * H_l: the sum over the horizontal contacts of the sphere, with −X for a contact that leads from l and +X for
//!   one that leads to l. For the other sphere of each contact the signs are exchanged.
//!
//! # Virtual work
//! The field φ is a virtual displacement: φ_l(p) is the displacement of sphere p along its contact direction l. On
//! the floor φ = 0. With q_l the sphere below p in direction l:
//!
//! * drop, the approach of p and q_l: D_l(p) = φ_l(p) − (T φ(q_l))_l,
//! * compression, the approach of two neighbours: c(p; a→b) = σ((φ_b − φ_a)(p) − (φ_b − φ_a)(p′)),
//!   p′ = p + d_b − d_a,
//! * virtual work: Σ f_l D_l + Σ X c = Σ w φ_l for **every** solution of the balance equations.
//!
//! The last equation is an identity: the sum of all balance equations, each multiplied by its φ_l. It is weak
//! duality of linear programming. A field with suitable signs thus proves a statement about all compressive forces:
//!
//! | claim | X | φ |
//! |---|---|---|
//! | [stable](Claim::Stands) | all f ≥ 0 | |
//! | [unstable](Claim::CannotStand) (Farkas certificate) | | D ≤ 0, c ≤ 0, Σ w φ > 0 |
//! | [smallest normal force](Claim::Least) N of a bottom sphere n | attains N | D ≤ 1 at the contacts with n, D ≤ 0 at others, c ≤ 0, and N = w + Σ w φ / 3 |
//! | [largest normal force](Claim::Greatest) | attains N | D ≥ 1 at the contacts with n, D ≥ 0 at others, c ≥ 0, and the same N |
//! | [all forces](Claim::Forces), f and those on the floor | f is the given force, within the given bound | |
//! | [elastic state](Claim::Elastic) with stiffness κ, and κ′ for horizontal contacts | all f ≥ 0 | D ≤ f, D = f where f > 0; κ′/κ · c ≤ X, equal where X > 0 |
//!
//! # Example
//! Three layers of discs have one horizontal contact above the floor, between the two discs of the middle layer.
//! Each disc weighs 1 mg. The top disc transmits f = 1 to each disc of the middle layer. By balance, each of these
//! transmits 2 + X outwards and 1 − X to the central bottom disc. So 0 ≤ X ≤ 1, and the central normal force is
//! N = 1 + 2(1 − X)/2 = 2 − X.
//!
//! * X = 0 attains N = 2. Proof that N is at most 2: let φ = 1 on the left and the right disc, in the direction of
//!   the central bottom disc, and φ = 0 otherwise. Then D = 1 at the two contacts with that disc, D = 0 at all
//!   others, and c = 2. So N ≤ w + Σ w φ / 2 = 1 + 2/2. (Check of the identity: Σ f D + Σ X
//!   c = 2(1 − X) + 2X = 2 = Σ w φ.)
//! * X = 1 attains N = 1. Proof that N is at least 1: let φ = 0.

mod check;
mod computed;
mod file;
mod forces;
mod refusal;
mod text;

pub(crate) use check::work;
pub use file::{
    MAX_BYTES, read_certificate, read_certificates, write_certificate, write_certificates,
};
pub use forces::AllForces;
pub use refusal::{Condition, Refusal};

use core::fmt;
use std::collections::BTreeMap;

use cannonpile::Pile;
use cannonpile::data::{listed, number};
use cannonpile::lattice::{HorizontalContact, Site};
use num_rational::BigRational;
use num_traits::Zero;
use serde::{Deserialize, Serialize};

/// A claim about a pile at a = R, with the data for its check.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_horizontal::certificate::{Certificate, Claim};
///
/// // The straight pile is stable without horizontal forces.
/// let mut certificate = Certificate {
///     pile: Pile::triangular(4)?,
///     claim: Claim::Stands,
///     horizontal: [].into(),
///     field: [].into(),
/// };
/// assert_eq!(certificate.check(), Ok(()));
///
/// // Six layers of HCP are not.
/// certificate.pile = Pile::under(cannonpile::lattice::Region::SITE, "+-+-+".parse()?)?;
/// let refusal = certificate.check().unwrap_err();
/// assert!(refusal.to_string().contains("is tensile"));
/// # Ok::<(), cannonpile_horizontal::Error>(())
/// ```
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// The pile.
    #[serde(deserialize_with = "file::pile")]
    pub pile: Pile,
    /// The claim.
    pub claim: Claim,
    /// The forces X of horizontal contacts, in f₀. Contacts that are not listed carry no force.
    #[serde(with = "listed")]
    pub horizontal: BTreeMap<HorizontalContact, BigRational>,
    /// The field φ by direction. It is zero on spheres that are not listed.
    #[serde(with = "listed")]
    pub field: BTreeMap<Site, [BigRational; 3]>,
}

cannonpile::engine::equality!(Certificate);

/// A claim about the admissible forces of a pile at a = R: those that balance every sphere and are not tensile.
///
/// # Examples
/// ```
/// use cannonpile_horizontal::certificate::Claim;
///
/// assert_eq!(Claim::CannotStand.to_string(), "no compressive forces balance the pile: it is unstable");
/// ```
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
#[non_exhaustive]
pub enum Claim {
    /// Admissible forces exist: the pile is stable.
    Stands,
    /// No forces are admissible: the pile is unstable.
    CannotStand,
    /// A lower bound of the normal force of a bottom sphere.
    Least(Extreme),
    /// An upper bound of the normal force of a bottom sphere.
    Greatest(Extreme),
    /// The forces are those of unilateral springs: they have the least elastic energy of all admissible forces.
    Elastic {
        /// κ′/κ: the stiffness of horizontal contacts divided by that of sloping ones.
        #[serde(with = "number")]
        stiffness_ratio: BigRational,
    },
    /// All forces of the pile, exactly or within a bound. The pile may have any sin φ, and may be unstable.
    Forces(Box<AllForces>),
}

cannonpile::engine::equality!(Claim);

/// A bound of the normal force of a bottom sphere.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_horizontal::certificate::{Certificate, Claim, Extreme};
/// use cannonpile::lattice::Site;
/// use num_rational::BigRational;
///
/// // No sphere carries less than its own weight.
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
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Extreme {
    /// The bottom sphere.
    pub site: Site,
    /// The bound, in mg.
    #[serde(with = "number")]
    pub normal: BigRational,
    /// `true` if the forces of the certificate attain the bound. Otherwise it may not be sharp.
    pub attained: bool,
}

cannonpile::engine::equality!(Extreme);

impl fmt::Display for Claim {
    /// Writes the claim as a sentence.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let extreme = |f: &mut fmt::Formatter<'_>, extreme: &Extreme, bound| {
            let Extreme {
                site,
                normal,
                attained,
            } = extreme;
            let attained = if *attained {
                "and some admissible forces attain it"
            } else {
                "a bound that may not be attained"
            };
            write!(
                f,
                "the normal force of the bottom sphere {site} is {bound} {normal} mg, {attained}"
            )
        };
        match self {
            Self::Stands => f.write_str("compressive forces balance the pile: it is stable"),
            Self::CannotStand => {
                f.write_str("no compressive forces balance the pile: it is unstable")
            }
            Self::Least(least) => extreme(f, least, "at least"),
            Self::Greatest(greatest) => extreme(f, greatest, "at most"),
            Self::Elastic { stiffness_ratio } => write!(
                f,
                "these are the forces of unilateral springs, horizontal ones {stiffness_ratio} times as stiff as others"
            ),
            Self::Forces(forces) => {
                let AllForces {
                    within,
                    compressive,
                    ..
                } = &**forces;
                let tension = if *compressive {
                    "no contact is tensile"
                } else {
                    "some contacts are tensile"
                };
                if within.is_zero() {
                    write!(f, "these are all forces; {tension}")
                } else {
                    write!(f, "these are all forces, within {within}; {tension}")
                }
            }
        }
    }
}
