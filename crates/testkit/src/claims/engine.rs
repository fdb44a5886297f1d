//! Every way to compute the forces of a mixed pile solves the equations of equilibrium.
//!
//! A single sphere uses a tree that follows contact lines. A whole layer uses a sweep: in limbs for exact values, in the
//! scalar itself for floats. An equal pile gives the same rows. All ways must agree with [`Solved`] exactly. The forces on the floor
//! must also agree with the weights and loads.

use arbitrary::Unstructured;
use cannonpile::geometry::Vector;
use cannonpile::lattice::{Direction, Site};
use cannonpile::shape::Selection;
use cannonpile::{ContactForce, Error, FloorForce, Forces};
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::reference::{Contacts, Floor, Solved, contacts_of, floor_of, site_of};
use super::{Checked, demand, in_lowest_terms, same};
use crate::generators::number::ratio;
use crate::generators::region::{self, Described};

type Exact<'p> = Forces<'p, BigRational>;

/// Checks every sphere of a small pile of any stacking, with weights and loads.
pub fn every_way(u: &mut Unstructured<'_>) -> Checked {
    let described = region::described(u)?;
    let steps = i128::try_from(described.signs.len()).unwrap_or_default();
    let k = u.int_in_range(0..=steps)?;
    all_ways_agree(&described, k)
}

/// Checks the whole pile, and layer k alone.
pub fn all_ways_agree(described: &Described, k: i128) -> Checked {
    let solved = Solved::of(described);
    let pile = described.pile()?;
    let spheres = solved.from_above.keys();
    let sites: Vec<Site> = spheres.map(|sphere| site_of(*sphere)).collect();
    demand(pile.shape().sites().eq(sites.iter().copied()), || {
        format!("{described:?}")
    })?;
    let (contacts, floor) = (contacts_of(&solved), floor_of(&solved));
    let forces = pile.forces();
    // Equal piles are interchangeable. The result depends only on the value.
    let twin = pile.clone();
    for forces in [pile.forces(), twin.forces()] {
        let swept: Result<Contacts, Error> = forces.contacts(Selection::All)?.collect();
        agree(&swept?, &contacts)?;
        let swept: Result<Floor, Error> = forces.base(Selection::Base)?.collect();
        same("the base", &swept?, &floor)?;
    }
    of_one_layer(&forces, k, &contacts)?;
    // A tree for every sphere would be slow in a large pile.
    let stride = 1 + sites.len() / 24;
    for site in sites.iter().step_by(stride).chain(sites.last()) {
        one_sphere(&forces, *site, &solved)?;
    }
    same("the weight", &pile.weight(), &solved.acting.values().sum())
}

/// A float answer differs from the exact one by rounding errors of the greatest possible force.
pub fn in_floats(u: &mut Unstructured<'_>) -> Checked {
    let described = region::described(u)?;
    let solved = Solved::of(&described);
    let acting: BigRational = solved.acting.values().sum();
    // Only compare when no force can underflow.
    if !acting.is_zero() && !(ratio(1, 1 << 60)..ratio(1 << 60, 1)).contains(&acting) {
        return Ok(());
    }
    let pile = described.pile()?;
    let forces = pile.forces::<f64>();
    let within = (&acting + ratio(1, 1)) * ratio(1, 1 << 40);
    let swept: Result<Vec<_>, Error> = forces.contacts(Selection::All)?.collect();
    contacts_near(&swept?, &contacts_of(&solved), &within)?;
    let swept: Result<Vec<_>, Error> = forces.base(Selection::Base)?.collect();
    floor_near(&swept?, &floor_of(&solved), &within)
}

/// Compares contact by contact, at the same sites.
fn contacts_near(got: &[ContactForce<f64>], want: &Contacts, within: &BigRational) -> Checked {
    same("the contacts", &got.len(), &want.len())?;
    for (got, want) in got.iter().zip(want) {
        let [at, of] = [(got.site, got.direction), (want.site, want.direction)];
        same("a contact", &at, &of)?;
        near(got.force, &want.force, within)?;
    }
    Ok(())
}

/// Compares bottom sphere by bottom sphere.
fn floor_near(got: &[FloorForce<f64>], want: &Floor, within: &BigRational) -> Checked {
    same("the bottom spheres", &got.len(), &want.len())?;
    for (got, want) in got.iter().zip(want) {
        same("a bottom sphere", &got.site, &want.site)?;
        near(got.normal, &want.normal, within)?;
        near(got.shear_x, &want.shear_x, within)?;
        near(got.shear_y, &want.shear_y, within)?;
    }
    Ok(())
}

/// Not-a-number is never near a value.
fn near(got: f64, want: &BigRational, within: &BigRational) -> Checked {
    let exact = BigRational::from_float(got);
    let holds = exact.is_some_and(|exact| (exact - want).abs() <= *within);
    demand(holds, || format!("{got} is not {want}"))
}

/// Compares contact by contact. Every force is in lowest terms.
fn agree(got: &Contacts, want: &Contacts) -> Checked {
    for (got, want) in got.iter().zip(want) {
        same("a contact", got, want)?;
        in_lowest_terms(&got.force)?;
    }
    same("the contacts", &got.len(), &want.len())
}

fn of_one_layer(forces: &Exact<'_>, k: i128, contacts: &Contacts) -> Checked {
    let swept: Result<Contacts, Error> = forces.contacts(Selection::Layer(k))?.collect();
    let here = contacts.iter().filter(|contact| contact.site.k == k);
    agree(&swept?, &here.cloned().collect())
}

/// Compares the answers about one sphere, which the library finds from the lines above it.
fn one_sphere(forces: &Exact<'_>, site: Site, solved: &Solved) -> Checked {
    let sphere = (site.k, (site.j, site.i));
    same(
        "the forces from above",
        &forces.from_above(site)?,
        &solved.from_above[&sphere],
    )?;
    let Some(transmitted) = solved.to_below.get(&sphere) else {
        let floor = floor_of(solved);
        let want = floor.iter().find(|force| force.site == site).cloned();
        return same(
            "the force on the floor",
            &Some(forces.on_floor(site)?),
            &want,
        );
    };
    for (direction, force) in Direction::ALL.into_iter().zip(transmitted) {
        same("a force", &forces.contact(site, direction)?, force)?;
    }
    let one: Result<Contacts, Error> = forces.contacts(Selection::One(site))?.collect();
    let one = one?.into_iter().map(|contact| contact.force);
    demand(one.eq(transmitted.iter().cloned()), || {
        format!("the rows of {site} give other forces")
    })?;
    same(
        "the unbalanced force",
        &forces.unbalanced(site)?,
        &Vector::zero(),
    )
}

#[cfg(test)]
mod injected_faults {
    use super::*;
    use crate::generators::number::power;
    use cannonpile::Pile;
    use cannonpile::lattice::Region;
    use cannonpile::lattice::Sign::{Minus, Plus};

    /// A pile with one sign change of each kind, a heavy sphere and a load.
    fn described() -> Described {
        Described {
            region: Region::triangle(2).unwrap(),
            from_base: false,
            signs: vec![Plus, Plus, Minus, Plus],
            weightless: false,
            weights: vec![(Site { i: 1, j: 0, k: 1 }, ratio(5, 2))],
            loads: vec![(Site { i: 0, j: 1, k: 3 }, ratio(7, 3))],
        }
    }

    #[test]
    fn a_tiny_error_of_a_contact_is_caught() {
        let right = contacts_of(&Solved::of(&described()));
        assert!(agree(&right, &right).is_ok());
        for fault in [
            (|contacts: &mut Contacts| contacts[20].force += power(10, -60)) as fn(&mut Contacts),
            |contacts| contacts.swap(20, 21),
            |contacts| contacts.truncate(20),
            |contacts| contacts[20].direction = Direction::Alpha,
        ] {
            let mut wrong = right.clone();
            fault(&mut wrong);
            assert!(agree(&wrong, &right).is_err());
        }
    }

    #[test]
    fn nan_or_a_missing_float_is_caught() {
        let solved = Solved::of(&described());
        let (want, trace) = (floor_of(&solved), power(2, -40));
        let pile = described().pile().unwrap();
        let floor = pile.forces::<f64>().base(Selection::Base).unwrap();
        let right: Vec<_> = floor.collect::<Result<_, _>>().unwrap();
        assert!(floor_near(&right, &want, &trace).is_ok());
        let faults: [fn(&mut Vec<FloorForce<f64>>); 4] = [
            |floor| floor[0].normal = f64::NAN,
            |floor| floor[1].shear_x = f64::INFINITY,
            |floor| floor[2].shear_y += 1e-9,
            |floor| floor.truncate(2),
        ];
        for fault in faults {
            let mut wrong = right.clone();
            fault(&mut wrong);
            assert!(floor_near(&wrong, &want, &trace).is_err());
        }
    }

    /// The library's answers about a pile that differs in one way.
    #[test]
    fn a_different_pile_is_caught() {
        let solved = Solved::of(&described());
        let judge = |described: &Described| {
            let pile: Pile = described.pile().unwrap();
            let forces = pile.forces();
            let low = Site { i: 0, j: 1, k: 4 };
            one_sphere(&forces, low, &solved).is_ok()
                && of_one_layer(&forces, 3, &contacts_of(&solved)).is_ok()
        };
        assert!(judge(&described()));
        let faults: [fn(&mut Described); 5] = [
            |pile| pile.signs[2] = Plus,
            |pile| pile.signs.swap(1, 2),
            |pile| pile.weightless = true,
            |pile| pile.weights.clear(),
            |pile| pile.loads[0].0.i += 1,
        ];
        for (n, fault) in faults.into_iter().enumerate() {
            let mut wrong = described();
            fault(&mut wrong);
            assert!(!judge(&wrong), "fault {n}");
        }
    }
}
