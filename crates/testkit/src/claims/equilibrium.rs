//! Every sphere is in exact equilibrium, every action has its reaction, and the base supports the weight.
//!
//! These are the paper's equations of equilibrium with the missing terms restored (`paper`, "Errata"). The sums use the
//! library's answers for each sphere and never its formula.

use arbitrary::Unstructured;
use cannonpile::geometry::Vector;
use cannonpile::lattice::{Dimension, Direction, Site};
use cannonpile::shape::Selection;
use cannonpile::{Error, FloorForce, Forces, Pile};
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::{Checked, demand, in_lowest_terms, same};
use crate::generators::number::ratio;
use crate::generators::pile;

type Exact<'p> = Forces<'p, BigRational>;

/// Checks one sphere of any pile and all its contacts.
pub fn one_sphere(u: &mut Unstructured<'_>) -> Checked {
    let pile = pile::pile(u)?;
    let site = pile::site(u, &pile)?;
    sphere(&pile.forces(), site)
}

/// Checks every sphere of a small pile, and the totals over the base.
pub fn small_pile(u: &mut Unstructured<'_>) -> Checked {
    let pile = pile::small_pile(u)?;
    let forces = pile.forces();
    for site in pile.shape().sites() {
        sphere(&forces, site)?;
    }
    let base: Result<Vec<_>, _> = forces.base(Selection::Base)?.collect();
    base_supports_the_weight(
        &base?,
        &BigRational::from_integer(pile.sphere_count().into()),
    )
}

/// Checks the force of one bottom sphere on the floor against the paper's formulas.
pub fn on_floor(u: &mut Unstructured<'_>) -> Checked {
    let pile = pile::pile(u)?;
    let site = pile::bottom_site(u, &pile)?;
    let force = pile.forces().on_floor(site)?;
    same("the normal force", &force.normal, &normal(&pile, site))?;
    if pile.dimension() == Dimension::Three && pile.is_regular() {
        let [along_x, along_y] = equilateral_shear(&pile, site);
        same("the shear along x", &force.shear_x, &along_x)?;
        same("the shear along y", &force.shear_y, &along_y)?;
    }
    Ok(())
}

/// Checks the balance at `site`, and both views of each contact below it.
fn sphere(forces: &Exact<'_>, site: Site) -> Checked {
    let acting = forces_on(forces, site)?;
    for component in acting.iter().flat_map(|f| [&f.x, &f.y, &f.z]) {
        in_lowest_terms(component)?;
    }
    balance(&acting)?;
    for &direction in forces.pile().dimension().directions() {
        let pyramid = forces.pile().shape();
        if let Some(below) = pyramid.below(site, direction) {
            let on_site = forces.contact_vector(site, direction)?;
            balance(&[on_site, on_lower(forces, site, below, direction)?])?;
        }
        if pyramid.above(site, direction).is_none() {
            let force = &forces.from_above(site)?[direction.index()];
            same("a force at the surface", force, &BigRational::zero())?;
        }
    }
    Ok(())
}

/// The forces sum to zero.
fn balance(forces: &[Vector<BigRational>]) -> Checked {
    let sum = forces.iter().fold(Vector::zero(), |sum, f| sum + f);
    demand(sum == Vector::zero(), || {
        format!("{forces:?} leave {sum:?}")
    })
}

/// All forces on a sphere, in f₀: its weight, the forces of its supports or of the floor, and the reactions to the forces
/// that the spheres above transmit.
fn forces_on(forces: &Exact<'_>, site: Site) -> Result<Vec<Vector<BigRational>>, Error> {
    let pile = forces.pile();
    // W: the weight mg in units of mg/W. Discs have s = 0.
    let weight = (BigRational::one() + pile.sin_phi()) * ratio(2, 1);
    let mut acting = vec![Vector {
        z: weight.clone(),
        ..Vector::zero()
    }];
    for &direction in pile.dimension().directions() {
        if let Some(above) = pile.shape().above(site, direction) {
            acting.push(-forces.contact_vector(above, direction)?);
        }
        if pile.shape().below(site, direction).is_some() {
            acting.push(forces.contact_vector(site, direction)?);
        }
    }
    if site.k == pile.layers() - 1 {
        let FloorForce {
            normal,
            shear_x,
            shear_y,
            ..
        } = forces.on_floor(site)?;
        let on_floor = Vector {
            x: shear_x,
            y: shear_y,
            z: normal,
        };
        acting.push(-on_floor.scaled(&weight));
    }
    Ok(acting)
}

/// The contact force on the lower sphere, from the answer about the lower sphere, along the line of centres.
fn on_lower(
    forces: &Exact<'_>,
    upper: Site,
    lower: Site,
    direction: Direction,
) -> Result<Vector<BigRational>, Error> {
    let centres = forces.position(lower)? - &forces.position(upper)?;
    Ok(centres.scaled(&forces.from_above(lower)?[direction.index()]))
}

/// The base supports the weight, in mg. The shear forces sum to zero.
fn base_supports_the_weight(base: &[FloorForce<BigRational>], weight: &BigRational) -> Checked {
    let total = |part: fn(&FloorForce<BigRational>) -> &BigRational| {
        base.iter()
            .fold(BigRational::zero(), |sum, force| sum + part(force))
    };
    same("the normal forces' sum", &total(|f| &f.normal), weight)?;
    let zero = BigRational::zero();
    same("the shears' sum along x", &total(|f| &f.shear_x), &zero)?;
    same("the shears' sum along y", &total(|f| &f.shear_y), &zero)
}

/// The base normal force in mg: (L+2)/3 on an equilateral base (paper, (13)), (L+1)/2 for discs, and 1 + ((L−1−j) +
/// 2sj)/(2(1+s)) in general.
fn normal(pile: &Pile, site: Site) -> BigRational {
    let integer = |n: i128| BigRational::from_integer(n.into());
    let (layers, j, s) = (pile.layers(), integer(site.j), pile.sin_phi());
    match (pile.dimension(), pile.is_regular()) {
        (Dimension::Two, _) => integer(layers + 1) / integer(2),
        (Dimension::Three, true) => integer(layers + 2) / integer(3),
        (Dimension::Three, false) => {
            let shared = integer(layers - 1) - &j + integer(2) * s * &j;
            integer(1) + shared / (integer(2) * (integer(1) + s))
        }
    }
}

/// The base shear force on an equilateral base, in mg·tanθ and √3·mg·tanθ: −(L−1−3j)/6 and −(L−1−2i−j)/6 (paper, eq. (14)).
fn equilateral_shear(pile: &Pile, site: Site) -> [BigRational; 2] {
    let steps = pile.layers() - 1;
    [steps - 3 * site.j, steps - 2 * site.i - site.j]
        .map(|lean| BigRational::new((-lean).into(), 6.into()))
}

#[cfg(test)]
mod injected_faults {
    use super::*;
    use crate::generators::number::power;

    /// A sphere inside a tall pile.
    const SITE: Site = Site {
        i: 5,
        j: 7,
        k: 1 << 100,
    };

    fn tall() -> Pile {
        Pile::isosceles(10_i128.pow(36), ratio(2, 5)).unwrap()
    }

    #[test]
    fn a_tiny_error_of_a_force_is_caught() {
        let pile = tall();
        let forces = forces_on(&pile.forces(), SITE).unwrap();
        assert_eq!(forces.len(), 7, "weight, three supports, three above");
        for component in 0..3 {
            let mut wrong = forces.clone();
            let mut parts = wrong[4].clone().into_array();
            parts[component] += power(10, -60);
            let [x, y, z] = parts;
            wrong[4] = Vector { x, y, z };
            assert!(balance(&wrong).is_err());
        }
        for left_out in 0..forces.len() {
            let mut wrong = forces.clone();
            wrong.remove(left_out);
            assert!(balance(&wrong).is_err(), "without force {left_out}");
        }
    }

    #[test]
    fn a_swapped_contact_is_caught() {
        let pile = tall();
        let forces = pile.forces();
        let below = pile.shape().below(SITE, Direction::Beta).unwrap();
        let seen = on_lower(&forces, SITE, below, Direction::Beta).unwrap();
        for (direction, same) in [(Direction::Beta, true), (Direction::Alpha, false)] {
            let views = [
                forces.contact_vector(SITE, direction).unwrap(),
                seen.clone(),
            ];
            assert_eq!(balance(&views).is_ok(), same);
        }
    }

    fn shear_x(force: &mut FloorForce<BigRational>) -> &mut BigRational {
        &mut force.shear_x
    }

    fn shear_y(force: &mut FloorForce<BigRational>) -> &mut BigRational {
        &mut force.shear_y
    }

    #[test]
    fn a_wrong_total_of_the_base_is_caught() {
        let pile = Pile::triangular(4).unwrap();
        let base: Result<Vec<_>, _> = pile.forces().base(Selection::Base).unwrap().collect();
        let (base, weight) = (base.unwrap(), ratio(20, 1));
        assert!(base_supports_the_weight(&base, &weight).is_ok());
        assert!(base_supports_the_weight(&base[1..], &weight).is_err());
        for shear in [shear_x, shear_y] {
            let mut wrong = base.clone();
            *shear(&mut wrong[3]) += power(10, -60);
            assert!(base_supports_the_weight(&wrong, &weight).is_err());
        }
    }

    #[test]
    fn a_normal_force_of_another_pile_is_caught() {
        let (pile, taller) = (tall(), Pile::isosceles(10_i128.pow(36) - 1, ratio(2, 5)));
        let site = Site {
            k: pile.layers() - 1,
            ..SITE
        };
        let force = pile.forces::<BigRational>().on_floor(site).unwrap();
        assert!(same("normal", &force.normal, &normal(&pile, site)).is_ok());
        assert!(same("normal", &force.normal, &normal(&taller.unwrap(), site)).is_err());
    }
}
