//! What a bottom sphere can bear.

use std::collections::BTreeMap;

use cannonpile::Pile;
use cannonpile::engine::{bug, check_interrupt};
use cannonpile::lattice::{HorizontalContact, Site};
use num_rational::BigRational;
use num_traits::Zero;

use crate::Error;
use crate::certificate::{Certificate, Claim, Extreme};
use crate::edge::Edge;
use crate::network::{MOST_CERTIFIED, MOST_EQUATIONS, Network};
use crate::program::{Aim, Closeness, Program, accepted, of_formulas};
use crate::stand::unsolved;
use crate::straight::{End, Straight};
use crate::symmetry::Orbits;

/// The least and the greatest normal force of a bottom sphere on the floor, over all forces that balance the pile and
/// only push.
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
    /// The least.
    pub least: NormalBound,
    /// The greatest.
    pub greatest: NormalBound,
}

/// One of the two bounds of a bottom sphere.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Site;
/// use cannonpile_horizontal::bounds;
///
/// let inner = Site { i: 1, j: 1, k: 3 };
/// let least = bounds(&Pile::triangular(4)?, inner)?.least;
/// // An arch can take off everything but its own weight.
/// assert_eq!((least.normal.to_string(), least.attained), ("1".to_owned(), true));
/// assert_eq!(least.certificate.unwrap().check(), Ok(()));
/// # Ok::<(), cannonpile_horizontal::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct NormalBound {
    /// The normal force, in mg.
    pub normal: BigRational,
    /// Whether some forces attain it; if not, no forces pass it, and how close they come is not known.
    pub attained: bool,
    /// The proof; none where it would have a number for each of more than 10⁵ spheres, and the bound is that of a formula
    /// for all L ([`paper`](cannonpile::paper#arching)), and of [`base_bounds`](crate::base_bounds) that are said of an image.
    pub certificate: Option<Certificate>,
}

/// Returns the least and the greatest normal force of a bottom sphere at a = R, horizontal contacts included.
///
/// Straight piles of equal spheres under one sphere have formulas, for any number of layers: at a corner both
/// bounds, elsewhere the least; on an edge of up to 82 layers the greatest, by forces that are written down and checked;
/// and, of more than 31 layers, an upper bound that may not be attained. All else is a linear program over the forces of
/// all contacts, whose solution is made exact and certified.
///
/// The horizontal forces that a pile was given are left out.
///
/// # Errors
/// [`NotOnFloor`](cannonpile::Error::NotOnFloor) or [`SiteOutside`](cannonpile::Error::SiteOutside) of a site that is no
/// bottom sphere; [`NoHorizontalContacts`](cannonpile::Error::NoHorizontalContacts);
/// [`TooLarge`](cannonpile::Error::TooLarge); [`Error::CannotStand`] if there are no such forces; [`Error::Weightless`].
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
        return Err(cannonpile::Error::not_on_floor(site, floor).into());
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
        _ => solver.network()?,
    };
    let network = network.as_ref();
    Ok(NormalBounds {
        least: solver.bound(End::Least, least, network)?,
        greatest: solver.bound(End::Greatest, greatest, network)?,
    })
}

struct Solver<'p> {
    pile: &'p Pile,
    site: Site,
    straight: Option<Straight>,
}

impl<'p> Solver<'p> {
    /// The bound that is proved and attained for any number of layers.
    fn by_formula(&self, end: End) -> Result<Option<NormalBound>, Error> {
        if let (End::Greatest, Some(edge)) = (end, self.straight.and_then(Edge::of)) {
            return Ok(self.on_edge(&edge));
        }
        let Some((straight, normal)) = self.straight.and_then(|s| Some((s, s.bound(end)?))) else {
            return Ok(None);
        };
        let is_small = self.pile.sphere_count() <= MOST_CERTIFIED.into();
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

    /// The greatest bound on an edge, if its certificate is accepted.
    fn on_edge(&self, edge: &Edge) -> Option<NormalBound> {
        if self.pile.sphere_count() > MOST_CERTIFIED.into() {
            return None;
        }
        let normal = edge.bound();
        let (forces, field) = (edge.forces(), edge.field());
        let certificate = self.certificate(End::Greatest, normal.clone(), Some(forces), field);
        certificate.check().is_ok().then_some(NormalBound {
            normal,
            attained: true,
            certificate: Some(certificate),
        })
    }

    /// The equations of all forces; `None` where they are too many, and a formula has an outer bound.
    fn network(&self) -> Result<Option<Network<'p>>, Error> {
        match Network::above(self.pile, self.pile.layers() - 1, MOST_EQUATIONS) {
            Err(cannonpile::Error::TooLarge { .. }) if self.straight.is_some() => Ok(None),
            network => Ok(Some(network?)),
        }
    }

    fn bound(
        &self,
        end: End,
        by_formula: Option<NormalBound>,
        network: Option<&Network<'_>>,
    ) -> Result<NormalBound, Error> {
        match (by_formula, network, self.straight) {
            (Some(bound), _, _) => Ok(bound),
            (None, Some(network), _) => self.by_program(end, network),
            (None, None, Some(straight)) => Ok(NormalBound {
                normal: straight.outer_bound(),
                attained: false,
                certificate: None,
            }),
            (None, None, None) => Err(bug("a bound is that of a formula or of a program").into()),
        }
    }

    /// The bound of the linear program over all forces.
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
                aim: Aim::Cost(cost),
            },
        };
        let (program, scale) = program.scaled();
        let equations = network.weights.len();
        let not_solved = || Error::NotSolved { equations };
        let mut outer = None;
        // No closer than it takes.
        for closeness in [Closeness::Loose, Closeness::Tight] {
            let Some(guess) = program.guess(closeness) else {
                // Bounded, so that only the forces can be missing.
                return Err(unsolved(self.pile, equations));
            };
            let mut unknowns = program.exact_unknowns(&guess);
            let mut multipliers = program.exact_multipliers(&guess);
            if let Some(orbits) = &orbits {
                unknowns = unknowns.map(|unknowns| orbits.unknowns(&unknowns));
                multipliers = multipliers.map(|multipliers| orbits.multipliers(&multipliers));
            }
            let horizontal = unknowns.map(|unknowns| {
                let forces = network.horizontal(&unknowns);
                forces.map(|(contact, x)| (contact, x * &scale)).collect()
            });
            let field = multipliers.map(|multipliers| {
                let multipliers: Vec<_> = multipliers.into_iter().map(|y| y * &sign).collect();
                network.field(&multipliers).collect()
            });
            match (horizontal, field) {
                (Some(horizontal), Some(field)) => {
                    let normal = self.normal_of(&field);
                    let both =
                        self.certificate(end, normal.clone(), Some(horizontal), field.clone());
                    match accepted(both, not_solved) {
                        // One side takes less memory.
                        Err(
                            Error::NotSolved { .. }
                            | Error::Core(cannonpile::Error::TooLarge { .. }),
                        ) => {
                            outer = Some(field);
                        }
                        accepted => {
                            return Ok(NormalBound {
                                normal,
                                attained: true,
                                certificate: Some(accepted?),
                            });
                        }
                    }
                }
                (None, field) => outer = field.or(outer),
                (Some(_), None) => {}
            }
        }
        // An interrupted search has found nothing, and that says nothing of the bound.
        check_interrupt()?;
        // Not a default: what it proves is a bound too, and said to be no more.
        let field = outer.unwrap_or_else(|| trivial_field(network, end));
        let normal = self.normal_of(&field);
        let certificate = self.certificate(end, normal.clone(), None, field);
        Ok(NormalBound {
            normal,
            attained: false,
            certificate: Some(accepted(certificate, not_solved)?),
        })
    }

    /// The normal force that a field proves.
    fn normal_of(&self, field: &BTreeMap<Site, [BigRational; 3]>) -> BigRational {
        let directions = self.pile.dimension().number();
        let work = field
            .iter()
            .map(|(site, [a, b, c])| self.pile.total_load(*site) * (a + b + c));
        let work: BigRational = work.sum();
        self.pile.total_load(self.site) + work / BigRational::from_integer(directions.into())
    }

    /// That a bound holds, by this field; and that it is attained, by these forces if there are any.
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
            // Not a default: without forces the bound is not called attained.
            horizontal: horizontal.unwrap_or_default(),
            field,
        }
    }
}

/// A field that is right for every pile: no sphere bears less than its own weight, none more than that and all others.
fn trivial_field(network: &Network<'_>, end: End) -> BTreeMap<Site, [BigRational; 3]> {
    let directions = network.pile.dimension().directions().len();
    let one = |l: usize| BigRational::from_integer(i32::from(l < directions).into());
    match end {
        End::Least => BTreeMap::new(),
        End::Greatest => network
            .spheres
            .iter()
            .map(|site| (*site, [one(0), one(1), one(2)]))
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The spheres above the floor bear down on one at most, each with its weight, whatever the dimension.
    #[test]
    fn what_is_said_without_a_solution_is_proved() {
        for (pile, i, most) in [
            (Pile::triangular(4), 1, 1 + 10),
            (Pile::triangular(1), 0, 1),
            (Pile::discs(4), 1, 1 + 6),
        ] {
            let pile = pile.unwrap();
            let k = pile.layers() - 1;
            let solver = Solver {
                pile: &pile,
                site: Site { i, j: 0, k },
                straight: None,
            };
            let network = Network::above(&pile, k, MOST_EQUATIONS).unwrap();
            for (end, normal) in [(End::Least, 1), (End::Greatest, most)] {
                let field = trivial_field(&network, end);
                let bound = solver.normal_of(&field);
                assert_eq!(bound, BigRational::from_integer(normal.into()));
                assert_eq!(solver.certificate(end, bound, None, field).check(), Ok(()));
            }
        }
    }
}
