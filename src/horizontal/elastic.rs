//! The state of springs that only push.

use alloc::collections::BTreeMap;
use alloc::vec;
use alloc::vec::Vec;

use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::exact::{Equation, near};
use super::network::{Column, MOST_CERTIFIED, Network, touches};
use super::program::{Program, accepted};
use crate::certificate::{Certificate, Claim};
use crate::geometry::Vector;
use crate::lattice::{Direction, HorizontalContact, Sign, Site, count};
use crate::{Culprit, Error, FloorForce, Pile, formula};

/// The forces of a pile at a = R whose contacts are springs that only push: of all forces that balance it those of
/// least energy, Σ f²/2κ + Σ X²/2κ′, and there is only one such state.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Region;
/// use num_rational::BigRational;
///
/// let equal = BigRational::from_integer(1.into());
/// // The paper's forces: horizontal contacts open.
/// assert!(Pile::triangular(100)?.elastic(&equal)?.horizontal().next().is_none());
///
/// // Six layers of HCP stand only with them.
/// let pile = Pile::under(Region::SITE, "+-+-+".parse()?)?;
/// let elastic = pile.elastic(&equal)?;
/// assert!(elastic.horizontal().count() > 0);
/// assert_eq!(elastic.certificate().map(|c| c.check()), Some(Ok(())));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ElasticState<'p> {
    pile: &'p Pile,
    /// None where the sloping forces are those without horizontal contacts.
    sloping: Option<BTreeMap<Site, [BigRational; 3]>>,
    certificate: Option<Certificate>,
}

impl Pile {
    /// Returns the elastic state at a = R, κ′/κ being the stiffness of horizontal contacts over that of sloping ones.
    ///
    /// Straight piles of equal weights bear what they bear without horizontal contacts
    /// ([`paper`](crate::paper#elastic-state)), of any number of layers. For others it is tested whether they do, in
    /// time proportional to the number of spheres; if not, a quadratic program says which contacts push, and the forces
    /// that follow are exact.
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
    /// assert_eq!(elastic.contact(Site { i: 1, j: 2, k: 5 }, Direction::Alpha)?.to_string(), "3");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn elastic(&self, stiffness_ratio: &BigRational) -> Result<ElasticState<'_>, Error> {
        touches(self)?;
        if !stiffness_ratio.is_positive() {
            return Err(Error::NotPositive {
                quantity: Culprit::StiffnessRatio,
                given: stiffness_ratio.clone(),
            });
        }
        let mut state = ElasticState {
            pile: self,
            sloping: None,
            certificate: None,
        };
        if self.is_paper_pile() {
            let is_small = self.sphere_count() <= MOST_CERTIFIED.into();
            state.certificate = is_small.then(|| of_straight(self, stiffness_ratio));
            return Ok(state);
        }
        let springs = Springs {
            network: Network::above(self, self.layers() - 1)?,
            stiffness_ratio,
        };
        let none = Pushing {
            horizontal: Vec::new(),
            open: Vec::new(),
        };
        let alone = springs.certificate(&none, &[]);
        if alone.check().is_ok() {
            state.certificate = Some(alone);
            return Ok(state);
        }
        let (certificate, sloping) = springs.with_horizontal()?;
        state.sloping = Some(sloping);
        state.certificate = Some(certificate);
        Ok(state)
    }
}

impl ElasticState<'_> {
    /// Returns the force of a sloping contact, in f₀.
    ///
    /// # Errors
    /// As for [`Forces::contact`](crate::Forces::contact).
    ///
    /// # Examples
    /// See [`Pile::elastic`].
    pub fn contact(&self, site: Site, direction: Direction) -> Result<BigRational, Error> {
        let forces = self.pile.forces::<BigRational>();
        match &self.sloping {
            None => forces.contact(site, direction),
            Some(sloping) => match sloping.get(&self.pile.shape().check(site)?) {
                Some(forces) if self.pile.shape().below(site, direction).is_some() => {
                    Ok(forces[direction.index()].clone())
                }
                // What is refused is refused in the same words.
                _ => forces.contact(site, direction),
            },
        }
    }

    /// Returns the horizontal contacts that bear a force, with it, in f₀; in the order of tables.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::under(Region::SITE, "+-+-+".parse()?)?;
    /// let elastic = pile.elastic(&BigRational::from_integer(1.into()))?;
    /// assert!(elastic.horizontal().all(|(contact, _)| contact.site.k < 5));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn horizontal(&self) -> impl Iterator<Item = (HorizontalContact, &BigRational)> {
        let certificate = self.certificate.iter();
        certificate
            .flat_map(|certificate| &certificate.horizontal)
            .map(|(contact, force)| (*contact, force))
    }

    /// Returns what the pile presses with on the floor below a bottom sphere, as
    /// [`Forces::on_floor`](crate::Forces::on_floor) does.
    ///
    /// # Errors
    /// As there.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Site;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(4)?;
    /// let elastic = pile.elastic(&BigRational::from_integer(1.into()))?;
    /// assert_eq!(elastic.on_floor(Site { i: 1, j: 1, k: 3 })?.normal.to_string(), "2");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn on_floor(&self, site: Site) -> Result<FloorForce<BigRational>, Error> {
        let forces = self.pile.forces::<BigRational>();
        let Some(sloping) = &self.sloping else {
            return forces.on_floor(site);
        };
        // What it is without horizontal contacts; refused if there is no such sphere.
        let alone = forces.on_floor(site)?;
        let from_above = Direction::ALL.map(|direction| {
            let above = self.pile.shape().above(site, direction);
            let above = above.and_then(|above| sloping.get(&above));
            above.map_or_else(BigRational::zero, |forces| {
                forces[direction.index()].clone()
            })
        });
        let directions = self.pile.directions::<BigRational>();
        let directions = match self.pile.shape().sign_below(site.k - 1) {
            Some(Sign::Minus) => directions.map(Vector::turned_about_z),
            _ => directions,
        };
        let weight = self.pile.sphere_weight(site)? + self.pile.load(site)?;
        let number = BigRational::from_integer(self.pile.dimension().number().into());
        let force = formula::handed_on(&from_above, &directions, &(weight * &number));
        let [shear_x, shear_y, normal] = force.into_array().map(|component| component / &number);
        Ok(FloorForce {
            normal,
            shear_x,
            shear_y,
            ..alone
        })
    }

    /// Returns the certificate: the forces, and the displacements that they follow from. None where the pile is straight and
    /// has more than 10⁵ spheres: there it is a theorem.
    ///
    /// # Examples
    /// See [`ElasticState`].
    #[must_use]
    pub fn certificate(&self) -> Option<&Certificate> {
        self.certificate.as_ref()
    }
}

/// That the paper's pile bears what it bears without horizontal contacts.
fn of_straight(pile: &Pile, stiffness_ratio: &BigRational) -> Certificate {
    let directions = pile.dimension().directions();
    let floor = pile.layers() - 1;
    let sites = pile.shape().sites().take_while(|site| site.k < floor);
    let field = sites.map(|site| {
        let Site { i, j, k } = site;
        let height = BigRational::from_integer((floor - k).into());
        let mut field = [(); 3].map(|()| BigRational::zero());
        for (direction, n) in directions.iter().zip(count::above(&i, &j, &k)) {
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
        horizontal: BTreeMap::new(),
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

    /// The forces X of these contacts and the gaps μ = f − D of these, one after the other, for which κ′ c = X and f =
    /// 0: as exact as they are unique.
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
        let answers: Vec<Answer> = of_pushing.chain(of_open).collect();
        let alone = self.answer(self.network.weights.clone());
        let mut system: Vec<Equation> = Vec::new();
        for (own, unknown) in pushing.horizontal.iter().enumerate() {
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
            !solution.iter().any(Signed::is_negative)
        })
    }

    /// The sloping forces with these X.
    fn sloping(&self, pushing: &Pushing, horizontal: &[BigRational]) -> Vec<BigRational> {
        let unknowns = pushing.horizontal.iter().copied();
        let sums = self.network.sums_with(unknowns.zip(horizontal));
        self.network.sloping(sums)
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
        let mut drops = self.sloping(pushing, horizontal);
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
    fn with_horizontal(&self) -> Result<(Certificate, BTreeMap<Site, [BigRational; 3]>), Error> {
        let network = &self.network;
        let equations = network.weights.len();
        let unsolved = || Error::NotSolved { equations };
        let ratio = self
            .stiffness_ratio
            .to_f64()
            .filter(|ratio| ratio.is_normal());
        let softness = ratio.ok_or_else(unsolved)?.recip();
        let curvature =
            (0..network.columns.len()).map(|u| if u < equations { 1.0 } else { softness });
        let program = Program {
            curvature: curvature.collect(),
            columns: &network.columns,
            sums: network.weights.clone(),
            cost: vec![BigRational::zero(); network.columns.len()],
        };
        let (program, scale) = program.scaled();
        let Some(guess) = program.guess() else {
            return Err(match network.pile.equilibrium()?.claim {
                Claim::CannotStand => Error::CannotStand,
                _ => unsolved(),
            });
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
        let forces = pushing
            .horizontal
            .iter()
            .map(|unknown| guess.unknowns[*unknown] * float_scale);
        let numbers: Vec<f64> = forces.chain(pushing.open.iter().map(|_| 0.0)).collect();
        let solution = self.solved(&pushing, &numbers).ok_or_else(unsolved)?;
        let certificate = accepted(Some(self.certificate(&pushing, &solution)), equations)?;
        let sloping = self.sloping(&pushing, &solution);
        Ok((certificate, network.by_sphere(&sloping).collect()))
    }
}

fn along(column: &Column, field: &[BigRational]) -> BigRational {
    column
        .iter()
        .map(|(equation, coefficient)| coefficient * &field[*equation])
        .sum()
}
