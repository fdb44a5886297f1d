//! The forces of a pile, in one or two states.

use cannonpile::lattice::Axis;
use cannonpile::shape::Selection;
use cannonpile::{FloorForce, Pile};
use cannonpile_dem::scene::State;
use cannonpile_dem::{CardTitle, Error, NumberedPile};
use num_rational::BigRational;
use num_traits::One;
use serde_json::{Value, json};

use super::encoding::indices;
use super::quantity::Quantity;

/// The values of all states.
pub(super) struct Quantities {
    /// Contact forces.
    contact: Quantity,
    /// The vertical forces that spheres transmit downwards.
    load: Quantity,
    /// Base shear forces along x and y.
    shear: [Quantity; 2],
}

impl Quantities {
    pub(super) fn of(pile: &NumberedPile<'_>) -> Self {
        let packing = pile.packing();
        let one = FloorForce {
            site: cannonpile::lattice::Site::APEX,
            normal: BigRational::one(),
            shear_x: BigRational::one(),
            shear_y: BigRational::one(),
        };
        let unit = packing.floor_force_in_si(one);
        let units = cannonpile_dem::table::Units::of_pile(pile.pile());
        Self {
            contact: Quantity::new(units.force(), packing.unit_force(), "a contact force"),
            load: Quantity::new(units.normal(), unit.normal, "a vertical force"),
            shear: [
                Quantity::new(units.shear_x(), unit.shear_x, "a shear force"),
                Quantity::new(units.shear_y(), unit.shear_y, "a shear force"),
            ],
        }
    }

    pub(super) fn to_json(&self) -> Result<Value, Error> {
        let [x, y] = &self.shear;
        Ok(json!({
            "contact": self.contact.to_json()?,
            "load": self.load.to_json()?,
            "shear_x": x.to_json()?,
            "shear_y": y.to_json()?,
        }))
    }
}

/// Returns the isostatic state. A second state follows if the pile has horizontal forces or the title names the elastic
/// state.
pub(super) fn states(
    pile: &NumberedPile<'_>,
    title: &CardTitle,
    quantities: &mut Quantities,
) -> Result<Vec<Value>, Error> {
    let given = pile.pile();
    if title.state == State::Isostatic && given.horizontal_forces().len() == 0 {
        return Ok(vec![state("isostatic", given, pile, quantities)?]);
    }
    let isostatic = given.clone().without_horizontal_forces();
    let name = if title.state == State::Elastic {
        "elastic"
    } else {
        "with horizontal forces"
    };
    Ok(vec![
        state("isostatic", &isostatic, pile, quantities)?,
        state(name, given, pile, quantities)?,
    ])
}

/// Returns the forces of one state, as positions in the lists of [`Quantities`].
///
/// Contact forces are in the order of `contacts.csv`, transmitted loads in the order of the sphere numbers, and base shear
/// forces in the order of the bottom spheres.
fn state(
    name: &str,
    pile: &Pile,
    numbered: &NumberedPile<'_>,
    quantities: &mut Quantities,
) -> Result<Value, Error> {
    let forces = pile.forces::<BigRational>();
    let (below, unit) = (pile.dimension().directions().len(), forces.increment_sum()?);
    let (mut contacts, mut loads, mut transmitted) =
        (Vec::new(), Vec::new(), BigRational::default());
    for contact in forces.contacts(Selection::All)? {
        let force = contact?.force;
        transmitted += &force;
        contacts.push(quantities.contact.place(force)?);
        if contacts.len() % below == 0 {
            let transmitted = std::mem::take(&mut transmitted) / &unit;
            loads.push(quantities.load.place(transmitted)?);
        }
    }
    let mut shears = [Vec::new(), Vec::new()];
    for force in forces.base(Selection::Base)? {
        let force = force?;
        loads.push(quantities.load.place(force.normal)?);
        let components = [force.shear_x, force.shear_y];
        let along = shears.iter_mut().zip(&mut quantities.shear).zip(components);
        for ((places, quantity), component) in along {
            places.push(quantity.place(component)?);
        }
    }
    let (mut ids, mut axes, mut pushes) = (Vec::new(), Vec::new(), Vec::new());
    for (contact, force) in pile.horizontal_forces() {
        ids.push(numbered.numbering().id(contact.site)?);
        let axis = Axis::ALL.iter().position(|axis| *axis == contact.axis);
        axes.push(axis);
        pushes.push(quantities.contact.place(force.clone())?);
    }
    let [shear_x, shear_y] = shears.map(|places| indices(&places));
    Ok(json!({
        "name": name,
        "contacts": indices(&contacts),
        "loads": indices(&loads),
        "shear_x": shear_x,
        "shear_y": shear_y,
        "horizontal": { "ids": ids, "axes": axes, "forces": pushes },
    }))
}
