//! Whoever is asked for the forces of a mixed pile, the answer is the one of the equations of equilibrium.
//!
//! Sphere by sphere the library follows lines up a tree; layer after layer it sweeps, in limbs for exact numbers and in
//! the scalar itself for floats; rows of another pile that is the same go row by row. All must agree with
//! [`Solved`], exactly; and the forces on the floor with the weights that they come from.

use arbitrary::Unstructured;
use cannonpile::geometry::Vector;
use cannonpile::lattice::{Direction, Site};
use cannonpile::shape::Selection;
use cannonpile::{ContactForce, Error, FloorForce, Forces};
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::handed_on::{Contacts, Floor, Solved, contacts_of, floor_of, site_of};
use super::{Checked, demand, in_lowest_terms, same};
use crate::generators::number::ratio;
use crate::generators::region::{self, Described};

type Exact<'p> = Forces<'p, BigRational>;

/// Every sphere of a small pile of any stacking, with weights and loads.
pub fn every_way(u: &mut Unstructured<'_>) -> Checked {
    let described = region::described(u)?;
    let steps = i128::try_from(described.signs.len()).unwrap_or_default();
    let k = u.int_in_range(0..=steps)?;
    throughout(&described, k, u.int_in_range(0..=20)?)
}

/// All of the pile, the layer k alone, and what is left when some rows have been given.
pub fn throughout(described: &Described, k: i128, given: usize) -> Checked {
    let solved = Solved::of(described);
    let pile = described.pile()?;
    let spheres = solved.received.keys();
    let sites: Vec<Site> = spheres.map(|sphere| site_of(*sphere)).collect();
    demand(pile.shape().sites().eq(sites.iter().copied()), || {
        format!("{described:?}")
    })?;
    let (contacts, floor) = (contacts_of(&solved), floor_of(&solved));
    let forces = pile.forces();
    // A pile equal to another is the same pile: nothing depends on which of them is asked.
    let twin = pile.clone();
    for forces in [pile.forces(), twin.forces()] {
        let swept: Result<Contacts, Error> = forces.contacts(Selection::All)?.collect();
        agree(&swept?, &contacts)?;
        let swept: Result<Floor, Error> = forces.base(Selection::Base)?.collect();
        let swept = swept?;
        bears_what_acts(&swept, &solved)?;
        same("the base", &swept, &floor)?;
    }
    of_one_layer(&forces, k, &contacts)?;
    filled(&forces, i128::try_from(given).unwrap_or(0), &contacts)?;
    // A tree for every sphere would be slow where there are many.
    let stride = 1 + sites.len() / 24;
    for site in sites.iter().step_by(stride).chain(sites.last()) {
        one_sphere(&forces, *site, &solved)?;
    }
    same("the weight", &pile.weight(), &solved.acting.values().sum())
}

/// In floats the answer is off by roundings of the greatest force there may be.
pub fn in_floats(u: &mut Unstructured<'_>) -> Checked {
    let described = region::described(u)?;
    let solved = Solved::of(&described);
    let acting: BigRational = solved.acting.values().sum();
    // Where it cannot underflow either.
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

/// Contact by contact, at the same sites.
fn contacts_near(got: &[ContactForce<f64>], want: &Contacts, within: &BigRational) -> Checked {
    same("the contacts", &got.len(), &want.len())?;
    for (got, want) in got.iter().zip(want) {
        let [at, of] = [(got.site, got.direction), (want.site, want.direction)];
        same("a contact", &at, &of)?;
        near(got.force, &want.force, within)?;
    }
    Ok(())
}

/// Bottom sphere by bottom sphere.
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

/// What is no number is near none.
fn near(got: f64, want: &BigRational, within: &BigRational) -> Checked {
    let exact = BigRational::from_float(got);
    let holds = exact.is_some_and(|exact| (exact - want).abs() <= *within);
    demand(holds, || format!("{got} is not {want}"))
}

/// Contact by contact; in lowest terms.
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

/// Layers filled into slices, from one in the middle of the pile on.
fn filled(forces: &Exact<'_>, from: i128, contacts: &Contacts) -> Checked {
    let mut layers = forces.layers(Selection::All)?;
    while let Some(layer) = layers.next_layer()? {
        if layer.is_floor() || layer.k() < from {
            continue;
        }
        let mut slices = [(); 3].map(|()| vec![BigRational::zero(); layer.sphere_count()]);
        layer.fill(slices.each_mut().map(Vec::as_mut_slice))?;
        let here = contacts
            .iter()
            .filter(|contact| contact.site.k == layer.k());
        for (n, contact) in here.enumerate() {
            let force = &slices[contact.direction.index()][n / 3];
            same("a force in a slice", force, &contact.force)?;
        }
    }
    Ok(())
}

/// What the library says of one sphere, by the lines above it.
fn one_sphere(forces: &Exact<'_>, site: Site, solved: &Solved) -> Checked {
    let sphere = (site.k, (site.j, site.i));
    same(
        "the forces from above",
        &forces.from_above(site)?,
        &solved.received[&sphere],
    )?;
    let Some(passed_on) = solved.passed_on.get(&sphere) else {
        let floor = floor_of(solved);
        let want = floor.iter().find(|force| force.site == site).cloned();
        return same(
            "the force on the floor",
            &Some(forces.on_floor(site)?),
            &want,
        );
    };
    for (direction, force) in Direction::ALL.into_iter().zip(passed_on) {
        same("a force", &forces.contact(site, direction)?, force)?;
    }
    let one: Result<Contacts, Error> = forces.contacts(Selection::One(site))?.collect();
    let one = one?.into_iter().map(|contact| contact.force);
    demand(one.eq(passed_on.iter().cloned()), || {
        format!("the rows of {site} give others")
    })?;
    same(
        "what is left over",
        &forces.unbalanced(site)?,
        &Vector::zero(),
    )
}

/// The floor bears what acts, where it acts, and is not pushed sideways on the whole.
fn bears_what_acts(floor: &[FloorForce<BigRational>], solved: &Solved) -> Checked {
    let normals = || solved.base().zip(floor.iter().map(|force| &force.normal));
    let borne: BigRational = normals().map(|(_, normal)| normal).sum();
    same(
        "what the floor bears",
        &borne,
        &solved.acting.values().sum(),
    )?;
    for (axis, name) in [(0, "the moment along i"), (1, "the moment along j")] {
        let moment = |sphere, force: &BigRational| &solved.place(sphere)[axis] * force;
        let borne: BigRational = normals()
            .map(|(sphere, normal)| moment(sphere, normal))
            .sum();
        let acting = solved.acting.iter();
        let acting: BigRational = acting.map(|(sphere, weight)| moment(*sphere, weight)).sum();
        same(name, &borne, &acting)?;
    }
    let sideways = |part: fn(&FloorForce<BigRational>) -> &BigRational| -> BigRational {
        floor.iter().map(part).sum()
    };
    let shears = [
        sideways(|force| &force.shear_x),
        sideways(|force| &force.shear_y),
    ];
    same(
        "the shears",
        &shears,
        &[BigRational::zero(), BigRational::zero()],
    )
}

#[cfg(test)]
mod planted {
    use super::*;
    use crate::generators::number::power;
    use cannonpile::Pile;
    use cannonpile::lattice::Region;
    use cannonpile::lattice::Sign::{Minus, Plus};

    /// A pile with one change of each kind, a heavy sphere and a load.
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
    fn a_contact_off_by_a_trace_is_caught() {
        let right = contacts_of(&Solved::of(&described()));
        assert!(agree(&right, &right).is_ok());
        for spoil in [
            (|contacts: &mut Contacts| contacts[20].force += power(10, -60)) as fn(&mut Contacts),
            |contacts| contacts.swap(20, 21),
            |contacts| contacts.truncate(20),
            |contacts| contacts[20].direction = Direction::Alpha,
        ] {
            let mut wrong = right.clone();
            spoil(&mut wrong);
            assert!(agree(&wrong, &right).is_err());
        }
    }

    #[test]
    fn a_float_that_is_no_number_or_missing_is_caught() {
        let solved = Solved::of(&described());
        let (want, trace) = (floor_of(&solved), power(2, -40));
        let pile = described().pile().unwrap();
        let floor = pile.forces::<f64>().base(Selection::Base).unwrap();
        let right: Vec<_> = floor.collect::<Result<_, _>>().unwrap();
        assert!(floor_near(&right, &want, &trace).is_ok());
        let spoils: [fn(&mut Vec<FloorForce<f64>>); 4] = [
            |floor| floor[0].normal = f64::NAN,
            |floor| floor[1].shear_x = f64::INFINITY,
            |floor| floor[2].shear_y += 1e-9,
            |floor| floor.truncate(2),
        ];
        for spoil in spoils {
            let mut wrong = right.clone();
            spoil(&mut wrong);
            assert!(floor_near(&wrong, &want, &trace).is_err());
        }
    }

    /// The library's answers about a pile that differs in one thing.
    #[test]
    fn a_pile_that_differs_is_caught() {
        let solved = Solved::of(&described());
        let judge = |described: &Described| {
            let pile: Pile = described.pile().unwrap();
            let forces = pile.forces();
            let low = Site { i: 0, j: 1, k: 4 };
            one_sphere(&forces, low, &solved).is_ok()
                && of_one_layer(&forces, 3, &contacts_of(&solved)).is_ok()
        };
        assert!(judge(&described()));
        let spoils: [fn(&mut Described); 5] = [
            |pile| pile.signs[2] = Plus,
            |pile| pile.signs.swap(1, 2),
            |pile| pile.weightless = true,
            |pile| pile.weights.clear(),
            |pile| pile.loads[0].0.i += 1,
        ];
        for (n, spoil) in spoils.into_iter().enumerate() {
            let mut wrong = described();
            spoil(&mut wrong);
            assert!(!judge(&wrong), "spoil {n}");
        }
    }

    #[test]
    fn a_floor_that_bears_it_elsewhere_is_caught() {
        let solved = Solved::of(&described());
        let right = floor_of(&solved);
        assert!(bears_what_acts(&right, &solved).is_ok());
        let spoils: [fn(&mut Floor); 4] = [
            |floor| floor[0].normal += power(10, -60),
            |floor| {
                floor[0].normal += ratio(1, 1);
                floor[1].normal -= ratio(1, 1);
            },
            |floor| floor[3].shear_x += power(10, -60),
            |floor| floor[3].shear_y += power(10, -60),
        ];
        for spoil in spoils {
            let mut wrong = right.clone();
            spoil(&mut wrong);
            assert!(bears_what_acts(&wrong, &solved).is_err());
        }
    }
}
