//! What a bottom sphere can bear.

use alloc::collections::BTreeMap;
use alloc::vec;

use num_rational::BigRational;
use num_traits::{One, Zero};

use super::network::{MOST_CERTIFIED, MOST_EQUATIONS, Network};
use super::program::{Program, accepted, of_formulas};
use crate::certificate::{Certificate, Claim, Extreme};
use crate::lattice::{Axis, Dimension, Direction, HorizontalContact, Site, count};
use crate::{Error, Pile, formula};

/// The least and the greatest normal force of a bottom sphere on the floor, over all forces that balance the pile and
/// only push.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Site;
///
/// let corner = Site { i: 3, j: 0, k: 3 };
/// let bounds = Pile::triangular(4)?.bounds(corner)?;
/// // (L + 2)/3 and L − 2/3.
/// assert_eq!([bounds.least.normal, bounds.greatest.normal].map(|n| n.to_string()), ["2", "10/3"]);
/// # Ok::<(), cannonpile::Error>(())
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
///
/// let inner = Site { i: 1, j: 1, k: 3 };
/// let least = Pile::triangular(4)?.bounds(inner)?.least;
/// // An arch can take off everything but its own weight.
/// assert_eq!((least.normal.to_string(), least.attained), ("1".to_owned(), true));
/// assert_eq!(least.certificate.unwrap().check(), Ok(()));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct NormalBound {
    /// The normal force, in mg.
    pub normal: BigRational,
    /// Whether some forces attain it; if not, no forces pass it, and how close they come is not known.
    pub attained: bool,
    /// The proof; none where it would have a number for each of more than 10⁵ spheres, and the bound is that of a formula
    /// for all L ([`paper`](crate::paper#arching)), and of [`base_bounds`](Pile::base_bounds) that are said of an image.
    pub certificate: Option<Certificate>,
}

/// Which of the two.
#[derive(Clone, Copy)]
enum End {
    Least,
    Greatest,
}

impl Pile {
    /// Returns the least and the greatest normal force of a bottom sphere at a = R, horizontal contacts included.
    ///
    /// Straight piles of equal spheres under one sphere have formulas, for any number of layers: at a corner both
    /// bounds, elsewhere the least, and, of more than 31 layers, an upper bound that may not be attained. All else is a
    /// linear program over the forces of all contacts, whose solution is made exact and certified.
    ///
    /// The horizontal forces that a pile was given are left out.
    ///
    /// # Errors
    /// [`Error::NotOnFloor`] or [`Error::SiteOutside`] of a site that is no bottom sphere;
    /// [`Error::NoHorizontalContacts`]; [`Error::TooLarge`]; [`Error::CannotStand`] if there are no such forces;
    /// [`Error::Weightless`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::{Region, Site};
    ///
    /// let pile = Pile::under(Region::SITE, "++-".parse()?)?;
    /// let bounds = pile.bounds(Site { i: 0, j: 0, k: 3 })?;
    /// assert!(bounds.least.attained && bounds.greatest.attained);
    /// assert!(bounds.least.normal < bounds.greatest.normal);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn bounds(&self, site: Site) -> Result<NormalBounds, Error> {
        let site = self.shape().check(site)?;
        let floor = self.layers() - 1;
        if site.k < floor {
            return Err(Error::NotOnFloor { site, floor });
        }
        self.check_horizontal()?;
        if self.is_weightless() {
            return Err(Error::Weightless);
        }
        let pile = self.clone().without_horizontal_forces();
        let mut solver = Solver {
            pile: &pile,
            site,
            network: None,
        };
        Ok(NormalBounds {
            least: solver.bound(End::Least)?,
            greatest: solver.bound(End::Greatest)?,
        })
    }
}

struct Solver<'p> {
    pile: &'p Pile,
    site: Site,
    /// Made when a program is needed.
    network: Option<Network<'p>>,
}

impl Solver<'_> {
    fn bound(&mut self, end: End) -> Result<NormalBound, Error> {
        if let Some(straight) = Straight::of(self.pile, self.site)
            && let Some(normal) = straight.bound(end)
        {
            let certificate = || {
                self.certificate(
                    end,
                    normal.clone(),
                    Some(straight.forces(end)),
                    straight.field(end),
                )
            };
            let is_small = self.pile.sphere_count() <= MOST_CERTIFIED.into();
            let certificate = is_small.then(|| of_formulas(certificate()));
            let certificate = certificate.transpose()?;
            return Ok(NormalBound {
                normal,
                attained: true,
                certificate,
            });
        }
        let network = match self.network.take() {
            Some(network) => Ok(network),
            None => Network::above(self.pile, self.pile.layers() - 1, MOST_EQUATIONS),
        };
        let network = match (network, Straight::of(self.pile, self.site)) {
            (Err(Error::TooLarge { .. }), Some(straight)) => return Ok(straight.outer_bound()),
            (network, _) => network?,
        };
        let network = self.network.insert(network);
        let sign = BigRational::from_integer(match end {
            End::Least => 1.into(),
            End::Greatest => (-1).into(),
        });
        let mut cost = vec![BigRational::zero(); network.columns.len()];
        for unknown in network.onto(self.site)? {
            cost[unknown] = sign.clone();
        }
        let program = Program {
            curvature: vec![0.0; cost.len()],
            columns: &network.columns,
            sums: network.weights.clone(),
            cost,
        };
        let (program, scale) = program.scaled();
        let Some(guess) = program.guess() else {
            // Bounded, so that only the forces can be missing.
            return Err(self.pile.unsolved(program.sums.len()));
        };
        let horizontal = program.exact_unknowns(&guess).map(|unknowns| {
            let horizontal = network.horizontal(&unknowns);
            horizontal
                .map(|(contact, force)| (contact, force * &scale))
                .collect()
        });
        let field = program.exact_multipliers(&guess).map(|multipliers| {
            let multipliers: Vec<_> = multipliers.into_iter().map(|y| y * &sign).collect();
            network.field(&multipliers).collect()
        });
        // Not a default: what it proves is a bound too, and said to be no more.
        let field = field.unwrap_or_else(|| trivial_field(network, end));
        let equations = program.sums.len();
        let normal = self.normal_of(&field);
        if let Some(horizontal) = horizontal {
            let both = self.certificate(end, normal.clone(), Some(horizontal), field.clone());
            if let Ok(certificate) = accepted(both, equations) {
                return Ok(NormalBound {
                    normal,
                    attained: true,
                    certificate: Some(certificate),
                });
            }
        }
        let certificate = self.certificate(end, normal.clone(), None, field);
        Ok(NormalBound {
            normal,
            attained: false,
            certificate: Some(accepted(certificate, equations)?),
        })
    }

    /// The normal force that a field proves.
    fn normal_of(&self, field: &BTreeMap<Site, [BigRational; 3]>) -> BigRational {
        let loading = self.pile.loading();
        let directions = self.pile.dimension().number();
        let work = field
            .iter()
            .map(|(site, [a, b, c])| loading.total(*site) * (a + b + c));
        let work: BigRational = work.sum();
        loading.total(self.site) + work / BigRational::from_integer(directions.into())
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

/// The straight pile of equal spheres under one sphere: a site is n = (k−i−j, i, j), of − steps (k+i+j, −i, −j), and K =
/// L−1.
#[derive(Clone, Copy)]
struct Straight {
    /// σ of all steps.
    sigma: i128,
    /// Of the bottom sphere.
    n: [i128; 3],
    k: i128,
}

impl Straight {
    fn of(pile: &Pile, Site { i, j, k }: Site) -> Option<Self> {
        let is_it = pile.is_paper_pile() && pile.dimension() == Dimension::Three;
        let sigma = pile.shape().straight_factor();
        is_it.then_some(Self {
            sigma,
            n: count::above(&(sigma * i), &(sigma * j), &k),
            k,
        })
    }

    /// The direction whose line ends in this corner.
    fn corner(self) -> Option<usize> {
        self.n.iter().position(|n| *n == self.k)
    }

    /// The bound that is proved and attained for any K.
    fn bound(self, end: End) -> Option<BigRational> {
        let k = BigRational::from_integer(self.k.into());
        let onto = match (self.corner(), end) {
            (Some(_), End::Least) => formula::least_on_corner(&k),
            (Some(_), End::Greatest) if self.k > 0 => formula::greatest_on_corner(&k),
            (Some(_), End::Greatest) | (None, End::Least) => BigRational::zero(),
            (None, End::Greatest) => return None,
        };
        Some(normal_below(onto))
    }

    /// What no forces pass on an edge or inside, for any K; it may not be attained.
    fn outer_bound(self) -> NormalBound {
        let n = self.sorted().map(|n| BigRational::from_integer(n.into()));
        let onto = match (self.sorted(), &n) {
            ([a, b, 0], [k, j, _]) => {
                let c = BigRational::from_integer(a.min(b + 1).into());
                formula::greatest_on_edge(k, j, &c)
            }
            _ => formula::greatest_inside(&n),
        };
        NormalBound {
            normal: normal_below(onto),
            attained: false,
            certificate: None,
        }
    }

    /// n_A ≥ n_B ≥ n_C.
    fn sorted(self) -> [i128; 3] {
        let mut sorted = self.n;
        sorted.sort_unstable_by(|one, other| other.cmp(one));
        sorted
    }

    /// X that attains the bound.
    fn forces(self, end: End) -> BTreeMap<HorizontalContact, BigRational> {
        match (self.corner(), end) {
            (Some(l), End::Greatest) => self.press(l),
            (Some(_), End::Least) => BTreeMap::new(),
            (None, _) => self.arch(),
        }
    }

    /// The spheres of the edge that leads to a corner are pressed by their neighbours, with X = 1.
    fn press(self, l: usize) -> BTreeMap<HorizontalContact, BigRational> {
        let pairs = (1..self.k).flat_map(|t| {
            [(l + 1) % 3, (l + 2) % 3].map(|other| {
                let on_edge = unit(l).map(|e| e * t);
                let mut beside = on_edge;
                beside[l] -= 1;
                beside[other] += 1;
                self.contact(on_edge, beside)
            })
        });
        pairs
            .flatten()
            .map(|contact| (contact, BigRational::one()))
            .collect()
    }

    /// The arch that takes everything off an inner sphere or one on an edge: of n_A ≥ n_B ≥ n_C, the spheres (t, n_B,
    /// n_C) push at (t+1, n_B−1, n_C) with X = 1, for t < n_A − r, r = min(n_A, n_B + n_C), and the three that rest on
    /// n push at each other.
    fn arch(self) -> BTreeMap<HorizontalContact, BigRational> {
        let mut order = [0, 1, 2];
        order.sort_by_key(|l| core::cmp::Reverse(self.n[*l]));
        let [a, b, c] = order;
        let [n_a, n_b, n_c] = order.map(|l| self.n[l]);
        let r = n_a.min(n_b + n_c);
        let flank = (0..n_a - r).filter_map(|t| {
            let mut one = self.n;
            one[a] = t;
            let mut other = one;
            other[a] += 1;
            other[b] -= 1;
            Some((self.contact(one, other)?, BigRational::one()))
        });
        let nu = [r, n_b, n_c].map(|n| BigRational::from_integer(n.into()));
        let above = [[b, c], [c, a], [a, b]].into_iter().zip(formula::arch(&nu));
        let above = above.filter(|(_, force)| !force.is_zero());
        let above = above.filter_map(|(ends, force)| {
            let [one, other] = ends.map(|l| {
                let mut site = self.n;
                site[l] -= 1;
                site
            });
            Some((self.contact(one, other)?, force))
        });
        let mut forces = BTreeMap::new();
        for (contact, force) in flank.chain(above) {
            *forces.entry(contact).or_insert_with(BigRational::zero) += force;
        }
        forces
    }

    /// φ that proves it.
    fn field(self, end: End) -> BTreeMap<Site, [BigRational; 3]> {
        let Some(l) = self.corner() else {
            return BTreeMap::new();
        };
        let edge = (0..self.k).map(|t| {
            let all = matches!(end, End::Greatest) && t > 0;
            let field = formula::corner_field(Direction::ALL[l], all);
            (self.site(unit(l).map(|e| e * t)), field)
        });
        edge.collect()
    }

    fn site(self, [a, i, j]: [i128; 3]) -> Site {
        let [i, j, k] = [self.sigma * i, self.sigma * j, a + i + j];
        Site { i, j, k }
    }

    /// The horizontal contact of two neighbours.
    fn contact(self, one: [i128; 3], other: [i128; 3]) -> Option<HorizontalContact> {
        let [one, other] = [one, other].map(|n| self.site(n));
        let both = [(one, other), (other, one)]
            .into_iter()
            .flat_map(|(from, to)| {
                Axis::ALL.map(|axis| (HorizontalContact { site: from, axis }, to))
            });
        let mut found = both.filter(|(contact, to)| contact.neighbour() == Some(*to));
        found.next().map(|(contact, _)| contact)
    }
}

/// 1 + G/3 in mg, of what rests on a bottom sphere in f₀.
fn normal_below(onto: BigRational) -> BigRational {
    BigRational::one() + onto / BigRational::from_integer(3.into())
}

fn unit(l: usize) -> [i128; 3] {
    core::array::from_fn(|direction| i128::from(direction == l))
}
