//! The range of base forces in a pile with horizontal contacts, by exact linear programs over all compressive states,
//! with certificates.
//!
//! The library returns the verdict on stability, the bounds of a bottom sphere, and the elastic state. The claim checks the
//! certificate of each answer and compares the answer with [`States`]. That oracle contains only the balance of a sphere and
//! the simplex method. Random compressive states lie between the bounds and have no less energy than the elastic state.

use arbitrary::Unstructured;
use cannonpile::Pile;
use cannonpile::lattice::{Axis, HorizontalContact, Site};
use cannonpile::shape::Selection;
use cannonpile_horizontal::certificate::{Certificate, Claim};
use cannonpile_horizontal::{Error, NormalBound};
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::reference::balance_of;
use super::{Checked, demand, same};
use crate::generators::number::ratio;
use crate::generators::rarely;
use crate::generators::region::{light, tiny};
use crate::oracles::admissible::{Affine, Corner, Pair, States, at, of_discs};
use crate::oracles::balance::{Balance, Forces, place, site};

/// A tiny pile for the library and for the oracle.
pub struct Drawn {
    /// The pile.
    pub pile: Pile,
    balance: Balance,
    /// The function that solves it.
    solve: fn(&Balance) -> Forces,
    /// All states that balance the pile, by the oracle.
    pub states: States,
    /// A compressive state, if one exists.
    pub corner: Option<Corner>,
    /// One bottom sphere of the pile.
    pub bottom: Site,
    /// The ratio of the stiffnesses of elastic contacts.
    pub stiffness_ratio: BigRational,
}

/// A random pile of spheres or discs, one of its bottom spheres, and some forces.
pub fn any_pile(u: &mut Unstructured<'_>) -> Checked {
    let drawn = drawn(u)?;
    agrees_with_the_programs(&drawn, u)
}

/// The claim of [`any_pile`], but only rarely on piles of spheres with four or five layers. A fuzz target reaches more code in
/// the same time with many small piles.
pub fn small_pile(u: &mut Unstructured<'_>) -> Checked {
    let layers = if !rarely(u, 10)? {
        3
    } else if rarely(u, 25)? {
        5
    } else {
        4
    };
    let drawn = up_to(u, layers)?;
    agrees_with_the_programs(&drawn, u)
}

/// Checks all claims about a pile, one of its bottom spheres, and a random state.
fn agrees_with_the_programs(drawn: &Drawn, u: &mut Unstructured<'_>) -> Checked {
    let Drawn {
        pile,
        states,
        corner,
        bottom,
        stiffness_ratio,
        ..
    } = drawn;
    let refused = |what: &str, error: Error| {
        let witness = format!("{what} of {pile:?} refused: {error}");
        super::Failure::Refuted(witness)
    };
    let verdict = cannonpile_horizontal::equilibrium(pile);
    let verdict = verdict.map_err(|error| refused("a verdict", error))?;
    is_proved(&verdict)?;
    let is_stable = verdict.claim == Claim::Stands;
    same("the verdict", &is_stable, &corner.is_some())?;
    let (bounds, elastic) = (
        cannonpile_horizontal::bounds(pile, *bottom),
        cannonpile_horizontal::elastic(pile, stiffness_ratio),
    );
    let Some(corner) = corner else {
        same("the elastic state", &elastic, &Err(Error::CannotStand))?;
        let refusal = if pile.is_weightless() {
            Error::Weightless
        } else {
            Error::CannotStand
        };
        return same("the bounds", &bounds, &Err(refusal));
    };
    let normal = &states.normals[&place(*bottom)];
    let least = corner.clone().lowest(normal).x();
    let greatest = corner.clone().lowest(&negative(normal)).x();
    if pile.is_weightless() {
        same("the bounds", &bounds, &Err(Error::Weightless))?;
    } else {
        let bounds = bounds.map_err(|error| refused("bounds", error))?;
        is_bound(&bounds.least, &at(normal, &least), false)?;
        is_bound(&bounds.greatest, &at(normal, &greatest), true)?;
    }
    let elastic = elastic.map_err(|error| refused("the elastic state", error))?;
    if let Some(certificate) = elastic.certificate() {
        is_proved(certificate)?;
    }
    let relaxed = horizontal(elastic.pile(), states);
    // A random state between the corners. More compression then moves it away from them.
    let aim: Affine = (0..=states.contacts.len())
        .map(|_| Ok(ratio(u.int_in_range(-2..=2)?, 1)))
        .collect::<Result<_, arbitrary::Error>>()?;
    let any = corner.clone().lowest(&aim).x();
    let mut x = mixed(u, &[&least, &greatest, &any, &relaxed])?;
    push_somewhere(u, states, &mut x)?;
    let [least, greatest] = [least, greatest].map(|x| at(normal, &x));
    is_between(drawn, &x, &least, &greatest)?;
    has_least_energy(states, stiffness_ratio, &relaxed, &x)
}

/// Draws a small pile, a bottom sphere of it and a stiffness ratio.
pub fn drawn(u: &mut Unstructured<'_>) -> Result<Drawn, super::Failure> {
    up_to(u, 5)
}

/// Draws a pile of at most `layers` layers of spheres, or of at most six of discs, a bottom sphere of it and a stiffness
/// ratio.
fn up_to(u: &mut Unstructured<'_>, layers: usize) -> Result<Drawn, super::Failure> {
    let stiffness_ratio = ratio(u.int_in_range(1..=9)?, u.int_in_range(1..=9)?);
    let (pile, balance, solve): (_, _, fn(&Balance) -> _) = if rarely(u, 8)? {
        let (pile, balance) = discs(u)?;
        (pile, balance, of_discs)
    } else {
        let described = tiny(u, layers)?;
        let pile = described.pile()?;
        (pile, balance_of(&described), Balance::forces)
    };
    let states = States::of(&balance, solve);
    let bottoms: Vec<Site> = states.normals.keys().map(|place| site(*place)).collect();
    Ok(Drawn {
        bottom: *u.choose(&bottoms)?,
        corner: states.compressive_corner(),
        pile,
        balance,
        solve,
        states,
        stiffness_ratio,
    })
}

impl Drawn {
    /// Returns the pile with one more load.
    pub fn loaded(&self, site: Site, load: BigRational) -> Result<Self, Error> {
        let mut balance = self.balance.clone();
        let weight = balance.weight(place(site)) + &load;
        balance.weights.insert(place(site), weight);
        let states = States::of(&balance, self.solve);
        Ok(Self {
            pile: self.pile.clone().with_load(site, load)?,
            balance,
            solve: self.solve,
            corner: states.compressive_corner(),
            states,
            bottom: self.bottom,
            stiffness_ratio: self.stiffness_ratio.clone(),
        })
    }
}

/// Up to six layers of discs, some with loads.
fn discs(u: &mut Unstructured<'_>) -> Result<(Pile, Balance), super::Failure> {
    let layers = u.int_in_range(1..=6)?;
    let mut pile = Pile::discs(layers)?;
    let row = |k: i128| (0..=k).map(|i| (0, i)).collect();
    let mut balance = Balance {
        signs: (1..layers).map(|_| '+').collect(),
        layers: (0..layers).map(row).collect(),
        ordinary: ratio(1, 1),
        weights: [].into(),
        horizontal: [].into(),
    };
    for _ in 0..u.int_in_range(0..=3)? {
        let k = u.int_in_range(0..=layers - 1)?;
        let (i, load) = (u.int_in_range(0..=k)?, light(u)?);
        pile = pile.with_load(Site { i, j: 0, k }, load.clone())?;
        let weight = balance.weight((k, 0, i)) + load;
        balance.weights.insert((k, 0, i), weight);
    }
    Ok((pile, balance))
}

/// The negative of an affine function.
pub fn negative(affine: &Affine) -> Affine {
    affine.iter().map(|entry| -entry).collect()
}

/// The contact in the library's type.
pub fn contact((place, step): Pair) -> HorizontalContact {
    let axis = match step {
        [1, 0] => Axis::AlphaBeta,
        [0, _] => Axis::AlphaGamma,
        _ => Axis::GammaBeta,
    };
    let site = site(place);
    HorizontalContact { site, axis }
}

/// The horizontal forces of a pile, in the order of the oracle.
pub fn horizontal(pile: &Pile, states: &States) -> Vec<BigRational> {
    let pairs = states.contacts.iter();
    pairs
        .map(|pair| pile.horizontal_force(contact(*pair)))
        .collect()
}

/// A mean of some states with random weights. The set of all states is convex.
fn mixed(
    u: &mut Unstructured<'_>,
    states: &[&Vec<BigRational>],
) -> arbitrary::Result<Vec<BigRational>> {
    let mut x = vec![BigRational::zero(); states[0].len()];
    let mut whole = 0;
    for (n, state) in states.iter().enumerate() {
        let last = n + 1 == states.len() && whole == 0;
        let weight = if last { 1 } else { u.int_in_range(0..=3)? };
        whole += weight;
        for (x, force) in x.iter_mut().zip(*state) {
            *x += force * ratio(weight, 1);
        }
    }
    Ok(x.into_iter().map(|x| x / ratio(whole, 1)).collect())
}

/// Adds compression to one contact: the largest tried part of a random force that leaves all contacts compressive.
fn push_somewhere(
    u: &mut Unstructured<'_>,
    states: &States,
    x: &mut [BigRational],
) -> arbitrary::Result<()> {
    if x.is_empty() {
        return Ok(());
    }
    let number = u.choose_index(x.len())?;
    let more = light(u)?;
    let before = x[number].clone();
    for part in [1, 2, 4, 16] {
        x[number] = &before + &more / ratio(part, 1);
        if states.is_compressive(x) {
            return Ok(());
        }
    }
    x[number] = before;
    Ok(())
}

fn is_proved(certificate: &Certificate) -> Checked {
    let checked = certificate.check();
    demand(checked.is_ok(), || {
        format!("{checked:?} of {certificate:?}")
    })
}

/// An attained bound equals the exact one. Any other bound lies outside. The certificate proves this bound.
fn is_bound(bound: &NormalBound, exact: &BigRational, above: bool) -> Checked {
    let certificate = bound.certificate.as_ref();
    demand(certificate.is_some(), || format!("no proof of {bound:?}"))?;
    if let Some(certificate) = certificate {
        is_proved(certificate)?;
        let proved = match &certificate.claim {
            Claim::Greatest(extreme) if above => Some(extreme),
            Claim::Least(extreme) if !above => Some(extreme),
            _ => None,
        };
        let proved = proved.map(|extreme| (&extreme.normal, extreme.attained));
        same("the proof", &proved, &Some((&bound.normal, bound.attained)))?;
    }
    let beyond = if above {
        &bound.normal - exact
    } else {
        exact - &bound.normal
    };
    let holds = beyond.is_zero() || beyond.is_positive() && !bound.attained;
    demand(holds, || format!("{bound:?} where {exact} is exact"))
}

/// The library and the oracle agree on the forces of a compressive state. The normal force of the bottom sphere lies between
/// its bounds.
fn is_between(
    drawn: &Drawn,
    x: &[BigRational],
    least: &BigRational,
    greatest: &BigRational,
) -> Checked {
    let Drawn {
        pile,
        states,
        bottom,
        ..
    } = drawn;
    demand(states.is_compressive(x), || {
        format!("{x:?} is tensile in {pile:?}")
    })?;
    let mut state = pile.clone();
    for (pair, force) in states.contacts.iter().zip(x) {
        state = state.with_horizontal_force(contact(*pair), force.clone())?;
    }
    same("the tensile contact", &state.first_failure(), &Ok(None))?;
    let forces = state.forces::<BigRational>();
    for row in forces.base(Selection::Base)? {
        let row = row?;
        let normal = at(&states.normals[&place(row.site)], x);
        same("a normal force", &row.normal, &normal)?;
    }
    let normal = forces.on_floor(*bottom)?.normal;
    demand((least..=greatest).contains(&&normal), || {
        format!("{bottom} has a normal force of {normal} in {state:?}, not {least} to {greatest}")
    })
}

/// No state has less energy than the elastic one, and no other state has as little.
fn has_least_energy(
    states: &States,
    stiffness_ratio: &BigRational,
    elastic: &[BigRational],
    other: &[BigRational],
) -> Checked {
    let [least, energy] = [elastic, other].map(|x| states.energy(x, stiffness_ratio));
    demand(least < energy || elastic == other, || {
        format!("{least} at {elastic:?}, but {energy} at {other:?}")
    })
}

#[cfg(test)]
mod injected_faults {
    use super::*;
    use cannonpile::lattice::Region;

    /// Four layers with a load next to the apex. The load presses spheres of the layer below outwards.
    fn loaded() -> Drawn {
        let (load, site) = (ratio(4, 1), Site { i: 0, j: 0, k: 1 });
        let mut balance = Balance::under(&[(0, 0)].into(), "+++");
        balance.weights.insert(place(site), ratio(5, 1));
        let states = States::of(&balance, Balance::forces);
        let pile = Pile::triangular(4).unwrap();
        Drawn {
            pile: pile.with_load(site, load).unwrap(),
            balance,
            solve: Balance::forces,
            corner: states.compressive_corner(),
            states,
            bottom: Site { i: 0, j: 0, k: 3 },
            stiffness_ratio: ratio(1, 1),
        }
    }

    fn affine(numbers: &[i64]) -> Affine {
        numbers.iter().map(|n| ratio(*n, 1)).collect()
    }

    /// x + y ≥ 2, x ≤ 3, y ≤ 3, 2x + y ≤ 7.
    fn rows() -> Vec<Affine> {
        let rows = [[-2, 1, 1], [3, -1, 0], [3, 0, -1], [7, -2, -1]];
        rows.iter().map(|row| affine(row)).collect()
    }

    /// An HCP pile of six layers is stable only with horizontal contacts.
    #[test]
    fn a_pile_that_needs_compression_passes() {
        let balance = Balance::under(&[(0, 0)].into(), "+-+-+");
        let states = States::of(&balance, Balance::forces);
        let pile = Pile::under(Region::SITE, "+-+-+".parse().unwrap()).unwrap();
        assert!(!states.is_compressive(&vec![ratio(0, 1); states.contacts.len()]));
        let drawn = Drawn {
            pile,
            balance,
            solve: Balance::forces,
            corner: states.compressive_corner(),
            states,
            bottom: Site { i: 1, j: 0, k: 5 },
            stiffness_ratio: ratio(2, 3),
        };
        let bytes = [7, 1, 200, 3, 90, 14, 5, 77];
        agrees_with_the_programs(&drawn, &mut Unstructured::new(&bytes)).unwrap();
    }

    #[test]
    fn the_simplex_finds_the_corners() {
        let first = Corner::first(2, &rows()).unwrap();
        for (cost, x) in [
            ([0, -1, -1], [2, 3]),
            ([0, -3, -1], [3, 1]),
            ([0, 1, 2], [2, 0]),
            ([0, 2, 1], [0, 2]),
        ] {
            assert_eq!(first.clone().lowest(&affine(&cost)).x(), affine(&x));
        }
        let mut none = rows();
        none.push(affine(&[1, -1, -1]));
        assert!(Corner::first(2, &none).is_none());
        // x + y = 2: the interior is empty.
        let mut thin = rows();
        thin.push(affine(&[2, -1, -1]));
        let corner = Corner::first(2, &thin).unwrap();
        assert_eq!(corner.lowest(&affine(&[0, -1, 0])).x(), affine(&[2, 0]));
    }

    #[test]
    fn a_wrong_bound_is_caught() {
        let Drawn {
            pile,
            states,
            corner,
            bottom,
            ..
        } = loaded();
        let normal = &states.normals[&place(bottom)];
        let greatest = at(normal, &corner.unwrap().lowest(&negative(normal)).x());
        let bound = cannonpile_horizontal::bounds(&pile, bottom)
            .unwrap()
            .greatest;
        assert!(bound.attained && is_bound(&bound, &greatest, true).is_ok());
        // Changes, in this order: the bound in both directions, the exact value, the proof, and the choice of the bound.
        for shift in [ratio(1, 7), ratio(-1, 7)] {
            let mut wrong = bound.clone();
            wrong.normal += &shift;
            assert!(is_bound(&wrong, &greatest, true).is_err());
            assert!(is_bound(&bound, &(&greatest + &shift), true).is_err());
            let mut wrong = bound.clone();
            let certificate = wrong.certificate.as_mut().unwrap();
            let field = certificate.field.values_mut().next().unwrap();
            field[0] += &shift;
            assert!(is_bound(&wrong, &greatest, true).is_err());
        }
        assert!(is_bound(&bound, &greatest, false).is_err());
        let mut unproved = bound;
        unproved.certificate = None;
        assert!(is_bound(&unproved, &greatest, true).is_err());
    }

    #[test]
    fn a_normal_force_outside_the_bounds_is_caught() {
        let drawn = loaded();
        let x = drawn.corner.as_ref().unwrap().x();
        let normal = at(&drawn.states.normals[&place(drawn.bottom)], &x);
        assert!(is_between(&drawn, &x, &normal, &normal).is_ok());
        let off = ratio(1, 7);
        assert!(is_between(&drawn, &x, &(&normal + &off), &(&normal + &off)).is_err());
        assert!(is_between(&drawn, &x, &(&normal - &off), &(&normal - &off)).is_err());
        // Under too much compression some contacts become tensile.
        let pressed = vec![ratio(99, 1); x.len()];
        assert!(is_between(&drawn, &pressed, &ratio(0, 1), &ratio(99, 1)).is_err());
    }

    #[test]
    fn a_state_of_higher_energy_is_caught() {
        let Drawn {
            pile,
            states,
            corner,
            stiffness_ratio,
            ..
        } = loaded();
        let cost = vec![ratio(-1, 1); states.contacts.len() + 1];
        let other = corner.unwrap().lowest(&cost).x();
        let elastic = cannonpile_horizontal::elastic(&pile, &stiffness_ratio).unwrap();
        let relaxed = horizontal(elastic.pile(), &states);
        let judge = |elastic: &[_], other: &[_]| {
            has_least_energy(&states, &stiffness_ratio, elastic, other).is_ok()
        };
        assert!(judge(&relaxed, &other) && judge(&relaxed, &relaxed));
        assert!(!judge(&other, &relaxed));
        // Springs of another stiffness, and a state without horizontal forces.
        assert!(relaxed.iter().any(Signed::is_positive));
        let stiff = cannonpile_horizontal::elastic(&pile, &ratio(8, 7)).unwrap();
        let stiff = horizontal(stiff.pile(), &states);
        let none = vec![ratio(0, 1); other.len()];
        assert!(!judge(&stiff, &relaxed) && !judge(&none, &relaxed));
    }
}
