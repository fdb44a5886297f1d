//! Bounds of the normal force of a bottom sphere.

use std::collections::BTreeMap;

use cannonpile::Pile;
use cannonpile::engine::{bug, check_interrupt};
use cannonpile::lattice::{HorizontalContact, Site};
use num_rational::BigRational;
use num_traits::Zero;

use crate::Error;
use crate::certificate::{Certificate, Claim, Extreme, Refusal, work};
use crate::exact_simplex::{Program, Solution};
use crate::network::{MAX_CERTIFIED, MAX_EQUATIONS, Network};
use crate::program::{accepted, of_formulas};
use crate::straight::{End, Straight};
use crate::symmetry::Orbits;
use crate::upper::Upper;

/// The smallest and the largest normal force of a bottom sphere, over all admissible sets of contact forces.
///
/// A set of contact forces is admissible if it balances every sphere and no force is tensile.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Site;
/// use cannonpile_horizontal::bounds;
///
/// let corner = Site { i: 3, j: 0, k: 3 };
/// let bounds = bounds(&Pile::triangular(4)?, corner)?;
/// // (L + 2)/3 and L − 2/3.
/// assert_eq!([bounds.least.normal, bounds.greatest.normal].map(|n| n.to_string()), ["2", "10/3"]);
/// # Ok::<(), cannonpile_horizontal::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct NormalBounds {
    /// The lower bound.
    pub least: NormalBound,
    /// The upper bound.
    pub greatest: NormalBound,
}

/// A bound of the normal force of a bottom sphere.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Site;
/// use cannonpile_horizontal::bounds;
///
/// let inner = Site { i: 1, j: 1, k: 3 };
/// let least = bounds(&Pile::triangular(4)?, inner)?.least;
/// // Arching can unload the sphere down to its own weight.
/// assert_eq!((least.normal.to_string(), least.attained), ("1".to_owned(), true));
/// assert_eq!(least.certificate.unwrap().check(), Ok(()));
/// # Ok::<(), cannonpile_horizontal::Error>(())
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct NormalBound {
    /// The normal force, in mg.
    pub normal: BigRational,
    /// `true` if some admissible forces attain the bound. Otherwise the bound is still valid, but it may not be sharp.
    pub attained: bool,
    /// The proof of the bound.
    ///
    /// `None` if the pile has more than 10⁵ spheres and a formula proves the bound for every L
    /// ([`paper`](cannonpile::paper#arching)). It is also `None` for images of a sphere in
    /// [`base_bounds`](crate::base_bounds).
    pub certificate: Option<Certificate>,
}

cannonpile::engine::equality!(NormalBound);

/// Returns the smallest and the largest normal force of a bottom sphere at a = R, in mg, with horizontal contacts.
///
/// For a straight pile of equal spheres under one sphere, these bounds need no linear program:
/// * At a corner both bounds, and elsewhere the lower bound.
/// * On an edge the upper bound, attained and with a checked certificate, for up to 83 layers.
/// * Inside the base an upper bound with a checked certificate. For up to 31 layers it is used only if a search finds
///   forces that attain it. For 32 to 83 layers it may not be attained.
/// * Above 83 layers, on edges and inside the base, an upper bound by a formula. It may not be attained, and has no
///   certificate.
///
/// In all other cases, and if the search fails, a linear program over the forces of all contacts is solved. Its
/// solution is made exact and certified.
///
/// Horizontal forces that were assigned to the pile are ignored.
///
/// # Errors
/// * [`NotOnFloor`](cannonpile::Error::NotOnFloor) or [`SiteOutside`](cannonpile::Error::SiteOutside) if the site
///   is not a bottom sphere.
/// * [`NoHorizontalContacts`](cannonpile::Error::NoHorizontalContacts) if neighbours in a layer do not touch.
/// * [`TooLarge`](cannonpile::Error::TooLarge) if the linear program has too many equations.
/// * [`Error::CannotStand`] if no forces are admissible.
/// * [`Error::Weightless`] if the spheres are weightless.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::{Region, Site};
/// use cannonpile_horizontal::bounds;
///
/// let pile = Pile::under(Region::SITE, "++-".parse()?)?;
/// let bounds = bounds(&pile, Site { i: 0, j: 0, k: 3 })?;
/// assert!(bounds.least.attained && bounds.greatest.attained);
/// assert!(bounds.least.normal < bounds.greatest.normal);
/// # Ok::<(), cannonpile_horizontal::Error>(())
/// ```
pub fn bounds(pile: &Pile, site: Site) -> Result<NormalBounds, Error> {
    let site = pile.shape().check(site)?;
    let floor = pile.layers() - 1;
    if site.k < floor {
        return Err(cannonpile::Error::NotOnFloor { site, floor }.into());
    }
    pile.check_horizontal()?;
    if pile.is_weightless() {
        return Err(Error::Weightless);
    }
    let pile = pile.clone().without_horizontal_forces();
    let solver = Solver {
        straight: Straight::of(&pile, site),
        pile: &pile,
        site,
    };
    let (least, greatest) = (
        solver.by_formula(End::Least)?,
        solver.by_formula(End::Greatest)?,
    );
    let network = match (&least, &greatest) {
        (Some(_), Some(_)) => None,
        _ => Some(Network::above(&pile, floor, MAX_EQUATIONS)?),
    };
    let bound = |end, by_formula| match (by_formula, &network) {
        (Some(bound), _) => Ok(bound),
        (None, Some(network)) => solver.by_program(end, network),
        (None, None) => Err(bug("a formula or a program gives each bound").into()),
    };
    Ok(NormalBounds {
        least: bound(End::Least, least)?,
        greatest: bound(End::Greatest, greatest)?,
    })
}

struct Solver<'p> {
    pile: &'p Pile,
    site: Site,
    straight: Option<Straight>,
}

impl Solver<'_> {
    /// Returns a bound that needs no linear program, if there is one.
    fn by_formula(&self, end: End) -> Result<Option<NormalBound>, Error> {
        let Some(straight) = self.straight else {
            return Ok(None);
        };
        let Some(normal) = straight.bound(end) else {
            return self.by_field(straight);
        };
        let is_small = self.pile.sphere_count() <= MAX_CERTIFIED.into();
        let certificate = is_small.then(|| {
            let (forces, field) = (straight.forces(end), straight.field(end));
            of_formulas(self.certificate(end, normal.clone(), Some(forces), field))
        });
        let certificate = certificate.transpose()?;
        Ok(Some(NormalBound {
            normal,
            attained: true,
            certificate,
        }))
    }

    /// Returns the upper bound of a sphere that is not at a corner.
    ///
    /// `None` if the checker rejects its certificate, or if a linear program may give a smaller bound.
    fn by_field(&self, straight: Straight) -> Result<Option<NormalBound>, Error> {
        if self.pile.sphere_count() > MAX_CERTIFIED.into() {
            return Ok(Some(NormalBound {
                normal: straight.outer_bound(),
                attained: false,
                certificate: None,
            }));
        }
        check_interrupt()?;
        let upper = Upper::of(straight);
        let forces = upper.forces();
        let attained = forces.is_some();
        if !attained && !upper.is_large() {
            return Ok(None);
        }
        let normal = upper.bound();
        let certificate = self.certificate(End::Greatest, normal.clone(), forces, upper.field());
        match certificate.check() {
            Ok(()) => Ok(Some(NormalBound {
                normal,
                attained,
                certificate: Some(certificate),
            })),
            Err(Refusal::Pile(error)) => Err(error.into()),
            Err(Refusal::Violated(..)) => Ok(None),
        }
    }

    /// Computes the bound by the linear program over all forces.
    fn by_program(&self, end: End, network: &Network<'_>) -> Result<NormalBound, Error> {
        let sign = BigRational::from_integer(match end {
            End::Least => 1.into(),
            End::Greatest => (-1).into(),
        });
        let mut cost = vec![BigRational::zero(); network.columns.len()];
        for unknown in network.onto(self.site)? {
            cost[unknown] = sign.clone();
        }
        let orbits = Orbits::of(network, self.site)?;
        let program = match &orbits {
            Some(orbits) => orbits.quotient(network, &cost),
            None => Program {
                columns: network.columns.as_slice().into(),
                sums: network.weights.clone(),
                cost,
            },
        };
        let (mut unknowns, mut multipliers) = match program.solve()? {
            Solution::Optimal {
                unknowns,
                multipliers,
            } => (unknowns, multipliers),
            Solution::Infeasible => return Err(Error::CannotStand),
        };
        if let Some(orbits) = &orbits {
            unknowns = orbits.unknowns(&unknowns);
            multipliers = orbits.multipliers(&multipliers);
        }
        for multiplier in &mut multipliers {
            *multiplier *= &sign;
        }
        let field = network.field(&multipliers);
        let normal = self.normal_of(&field);
        let certified = |horizontal: Option<_>| {
            let attained = horizontal.is_some();
            let certificate = self.certificate(end, normal.clone(), horizontal, field.clone());
            accepted(certificate).map(|certificate| NormalBound {
                normal: normal.clone(),
                attained,
                certificate: Some(certificate),
            })
        };
        match certified(Some(network.horizontal(&unknowns))) {
            // The checker can need too much memory for forces and field together. The field alone needs less.
            Err(Error::Core(cannonpile::Error::TooLarge { .. })) => certified(None),
            bound => bound,
        }
    }

    /// Returns the normal force that a field proves as a bound, in mg.
    fn normal_of(&self, field: &BTreeMap<Site, [BigRational; 3]>) -> BigRational {
        let directions = self.pile.dimension().number();
        let work = work(self.pile, field);
        self.pile.total_load(self.site).down + work / BigRational::from_integer(directions.into())
    }

    /// Returns a certificate that the field proves the bound and that the horizontal forces, if given, attain it.
    fn certificate(
        &self,
        end: End,
        normal: BigRational,
        horizontal: Option<BTreeMap<HorizontalContact, BigRational>>,
        field: BTreeMap<Site, [BigRational; 3]>,
    ) -> Certificate {
        let extreme = Extreme {
            site: self.site,
            normal,
            attained: horizontal.is_some(),
        };
        let claim = match end {
            End::Least => Claim::Least(extreme),
            End::Greatest => Claim::Greatest(extreme),
        };
        Certificate {
            pile: self.pile.clone(),
            claim,
            // Without forces the claim does not state that the bound is attained, so the list can be empty.
            horizontal: horizontal.unwrap_or_default(),
            field,
        }
    }
}
