//! The state of springs that only push.

use alloc::vec;
use alloc::vec::Vec;

use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::exact::{Equation, near};
use super::network::{Column, MOST_CERTIFIED, Network};
use super::program::{Aim, Closeness, Program, accepted, of_formulas};
use crate::certificate::{Certificate, Claim};
use crate::engine::check_interrupt;
use crate::lattice::{Site, count};
use crate::{Culprit, Error, Pile, formula};

/// The forces of a pile at a = R whose contacts are springs that only push: of all forces that balance it those of least
/// energy, Σ f²/2κ + Σ X²/2κ′, and there is only one such state.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Region;
/// use num_rational::BigRational;
///
/// let equal = BigRational::from_integer(1.into());
/// // The paper's forces: horizontal contacts open.
/// assert_eq!(Pile::triangular(100)?.elastic(&equal)?.pile().horizontal_forces().len(), 0);
///
/// // Six layers of HCP stand only with them.
/// let pile = Pile::under(Region::SITE, "+-+-+".parse()?)?;
/// let elastic = pile.elastic(&equal)?;
/// assert!(pile.first_failure()?.is_some() && elastic.pile().first_failure()?.is_none());
/// assert_eq!(elastic.certificate().map(|c| c.check()), Some(Ok(())));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ElasticState {
    pile: Pile,
    certificate: Option<Certificate>,
}

impl Pile {
    /// Returns the elastic state at a = R, κ′/κ being the stiffness of horizontal contacts over that of sloping ones.
    ///
    /// Straight piles of equal weights bear what they bear without horizontal contacts
    /// ([`paper`](crate::paper#elastic-state)), of any number of layers. For others it is tested whether they do, in time
    /// proportional to the number of spheres; if not, a quadratic program says which contacts push, and the forces that
    /// follow are exact. The horizontal forces that a pile was given are left out of it.
    ///
    /// # Errors
    /// [`Error::NotPositive`] of a stiffness ratio; [`Error::NoHorizontalContacts`]; [`Error::CannotStand`];
    /// [`Error::TooLarge`]; [`Error::NotSolved`] if the contacts that push were not found.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::{Direction, Site};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let elastic = pile.elastic(&BigRational::new(2.into(), 7.into()))?;
    /// let forces = elastic.pile().forces::<BigRational>();
    /// assert_eq!(forces.contact(Site { i: 1, j: 2, k: 5 }, Direction::Alpha)?.to_string(), "3");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn elastic(&self, stiffness_ratio: &BigRational) -> Result<ElasticState, Error> {
        let mut pile = self.clone().without_horizontal_forces();
        pile.check_horizontal()?;
        if !stiffness_ratio.is_positive() {
            return Err(Error::NotPositive {
                quantity: Culprit::StiffnessRatio,
                given: stiffness_ratio.clone(),
            });
        }
        let certificate = match elastic(&pile, stiffness_ratio) {
            Err(Error::TooLarge { .. })
                if pile.shape().stacking().is_straight() && pile.system().is_even() =>
            {
                None
            }
            // What fails early is known to, however large the pile is.
            Err(Error::TooLarge { .. }) if pile.cannot_stand() => return Err(Error::CannotStand),
            certificate => Some(certificate?),
        };
        for (contact, force) in certificate.iter().flat_map(|c| &c.horizontal) {
            pile = pile.with_horizontal_force(*contact, force.clone())?;
        }
        Ok(ElasticState { pile, certificate })
    }
}

impl ElasticState {
    /// Returns the pile with the horizontal forces of this state: its forces, of any scalar and in any units, are those of the
    /// state.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::under(Region::SITE, "+-+-+".parse()?)?;
    /// let elastic = pile.elastic(&BigRational::from_integer(1.into()))?;
    /// assert!(elastic.pile().horizontal_forces().all(|(contact, _)| contact.site.k < 5));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub const fn pile(&self) -> &Pile {
        &self.pile
    }

    /// Returns the certificate: the forces, and the displacements that they follow from. None where the pile is straight and
    /// has more than 10⁵ spheres off the floor: there it is a theorem.
    ///
    /// # Examples
    /// See [`ElasticState`].
    #[must_use]
    pub const fn certificate(&self) -> Option<&Certificate> {
        self.certificate.as_ref()
    }
}

/// Returns the certificate of the elastic state.
fn elastic(pile: &Pile, stiffness_ratio: &BigRational) -> Result<Certificate, Error> {
    if pile.is_paper_pile() && pile.sphere_count() <= MOST_CERTIFIED.into() {
        return of_formulas(of_straight(pile, stiffness_ratio));
    }
    let most = u64::from(MOST_CERTIFIED * pile.dimension().number());
    let springs = Springs {
        network: Network::above(pile, pile.layers() - 1, most)?,
        stiffness_ratio,
    };
    let none = Pushing {
        horizontal: Vec::new(),
        open: Vec::new(),
    };
    let alone = springs.certificate(&none, &[]);
    if alone.check().is_ok() {
        return Ok(alone);
    }
    springs.network.check_size()?;
    springs.with_horizontal()
}

/// That the paper's pile bears what it bears without horizontal contacts.
fn of_straight(pile: &Pile, stiffness_ratio: &BigRational) -> Certificate {
    let directions = pile.dimension().directions();
    let (floor, sigma) = (pile.layers() - 1, pile.shape().straight_factor());
    let sites = pile.shape().sites().take_while(|site| site.k < floor);
    let field = sites.map(|site| {
        let Site { i, j, k } = site;
        let height = BigRational::from_integer((floor - k).into());
        let mut field = [(); 3].map(|()| BigRational::zero());
        for (direction, n) in directions
            .iter()
            .zip(count::above(&(sigma * i), &(sigma * j), &k))
        {
            let n = BigRational::from_integer(n.into());
            field[direction.index()] = formula::elastic_field(&n, &height);
        }
        (site, field)
    });
    Certificate {
        pile: pile.clone(),
        claim: Claim::Elastic {
            stiffness_ratio: stiffness_ratio.clone(),
        },
        horizontal: [].into(),
        field: field.collect(),
    }
}

/// A pile of springs: κ = 1, κ′ the stiffness ratio.
struct Springs<'p> {
    network: Network<'p>,
    stiffness_ratio: &'p BigRational,
}

/// Which horizontal contacts push, and which sloping ones are open: unknowns of the network.
struct Pushing {
    horizontal: Vec<usize>,
    open: Vec<usize>,
}

/// The answer of all springs to some force, or to a gap in a contact.
struct Answer {
    /// Of the sloping contacts, by unknown.
    forces: Vec<BigRational>,
    /// By equation.
    field: Vec<BigRational>,
}

impl Springs<'_> {
    /// The forces that these sums of the equations ask for without horizontal contacts, and the field for D = f.
    fn answer(&self, sums: Vec<BigRational>) -> Answer {
        let forces = self.network.sloping(sums);
        let field = self.network.field_of(forces.clone());
        Answer { forces, field }
    }

    /// κ′ c of a horizontal contact.
    fn compression(&self, unknown: usize, field: &[BigRational]) -> BigRational {
        self.stiffness_ratio * along(&self.network.columns[unknown], field)
    }

    /// The forces X of these contacts and the gaps μ = f − D of these, one after the other, for which κ′ c = X and f = 0.
    /// The forces are unique; gaps that are not, of open contacts of spheres that nothing presses, are such that nothing
    /// is compressed there.
    fn solved(&self, pushing: &Pushing, guess: &[f64]) -> Option<Vec<BigRational>> {
        let equations = self.network.weights.len();
        let zeros = || vec![BigRational::zero(); equations];
        let of_pushing = pushing.horizontal.iter().map(|unknown| {
            let mut sums = zeros();
            for (equation, coefficient) in &self.network.columns[*unknown] {
                sums[*equation] -= coefficient;
            }
            self.answer(sums)
        });
        let of_open = pushing.open.iter().map(|unknown| {
            let mut drops = zeros();
            drops[*unknown] = -BigRational::one();
            Answer {
                forces: zeros(),
                field: self.network.field_of(drops),
            }
        });
        let answers = of_pushing.chain(of_open).map(|answer| {
            check_interrupt().ok()?;
            Some(answer)
        });
        let answers: Vec<Answer> = answers.collect::<Option<_>>()?;
        let alone = self.answer(self.network.weights.clone());
        let mut system: Vec<Equation> = Vec::new();
        for (own, unknown) in pushing.horizontal.iter().enumerate() {
            check_interrupt().ok()?;
            let coefficients = answers.iter().enumerate().map(|(number, answer)| {
                let itself = BigRational::from_integer(i32::from(number == own).into());
                (number, self.compression(*unknown, &answer.field) - itself)
            });
            let coefficients = coefficients.filter(|(_, coefficient)| !coefficient.is_zero());
            system.push((
                coefficients.collect(),
                -self.compression(*unknown, &alone.field),
            ));
        }
        for unknown in &pushing.open {
            let coefficients = answers
                .iter()
                .map(|answer| answer.forces[*unknown].clone())
                .enumerate();
            let coefficients = coefficients.filter(|(_, coefficient)| !coefficient.is_zero());
            system.push((coefficients.collect(), -alone.forces[*unknown].clone()));
        }
        near(system, guess, |solution| {
            let is_signed = !solution.iter().any(Signed::is_negative);
            is_signed && self.certificate(pushing, solution).check().is_ok()
        })
    }

    /// The certificate of these X and μ.
    fn certificate(&self, pushing: &Pushing, solution: &[BigRational]) -> Certificate {
        let Network {
            weights,
            contacts,
            pile,
            ..
        } = &self.network;
        let (horizontal, gaps) = solution.split_at(pushing.horizontal.len());
        let unknowns = pushing.horizontal.iter().copied();
        let sums = self.network.sums_with(unknowns.zip(horizontal));
        let mut drops = self.network.sloping(sums);
        for (unknown, gap) in pushing.open.iter().zip(gaps) {
            drops[*unknown] -= gap;
        }
        let field = self.network.field_of(drops);
        let bearing = pushing
            .horizontal
            .iter()
            .zip(horizontal)
            .filter(|(_, force)| !force.is_zero());
        Certificate {
            pile: (*pile).clone(),
            claim: Claim::Elastic {
                stiffness_ratio: self.stiffness_ratio.clone(),
            },
            horizontal: bearing
                .map(|(unknown, force)| (contacts[unknown - weights.len()], force.clone()))
                .collect(),
            field: self.network.field(&field).collect(),
        }
    }

    /// The state in which horizontal contacts push, by a quadratic program.
    fn with_horizontal(&self) -> Result<Certificate, Error> {
        let network = &self.network;
        let equations = network.weights.len();
        let unsolved = || Error::NotSolved { equations };
        // In units of √(κ′/κ) horizontal forces are as soft as the others.
        // Not a default: what is too great for a float is too great for a guess.
        let ratio = self.stiffness_ratio.to_f64().unwrap_or(f64::INFINITY);
        // Not a default: beyond these ratios which forces push hardly changes, and what is guessed is made exact.
        let unit = ratio.clamp(1e-6, 1e6).sqrt();
        let exact_unit = BigRational::from_float(unit).ok_or_else(unsolved)?;
        let mut columns = network.columns.clone();
        for (_, coefficient) in columns.iter_mut().skip(equations).flatten() {
            *coefficient *= &exact_unit;
        }
        let program = Program {
            columns: columns.as_slice().into(),
            sums: network.weights.clone(),
            aim: Aim::Squares,
        };
        let (program, scale) = program.scaled();
        let Some(guess) = program.guess(Closeness::Tight) else {
            return Err(network.pile.unsolved(equations));
        };
        let positive = |unknown: &usize| guess.positive[*unknown];
        let pushing = Pushing {
            horizontal: (equations..network.columns.len())
                .filter(positive)
                .collect(),
            open: (0..equations)
                .filter(|unknown| !positive(unknown))
                .collect(),
        };
        let float_scale = scale.to_f64().ok_or_else(unsolved)?;
        let forces = pushing.horizontal.iter().map(|u| guess.unknowns[*u] * unit);
        let gaps = pushing.open.iter().map(|u| guess.slacks[*u]);
        let numbers = forces.chain(gaps).map(|number| number * float_scale);
        let numbers: Vec<f64> = numbers.collect();
        let solution = self.solved(&pushing, &numbers).ok_or_else(unsolved)?;
        accepted(self.certificate(&pushing, &solution), equations)
    }
}

fn along(column: &Column, field: &[BigRational]) -> BigRational {
    column
        .iter()
        .map(|(equation, coefficient)| coefficient * &field[*equation])
        .sum()
}
