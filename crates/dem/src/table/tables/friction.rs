//! Two layers with friction on a rough floor.

use super::base::floor_cells;
use super::contacts::contact_cells;
use super::{bounds, indices, narrower, refuse_beyond};
use crate::table::cell::Cell;
use crate::table::rows::{Column, RowIter, Table, boxed};
use crate::table::units::Units;
use crate::{Each, Error};
use cannonpile::lattice::Dimension;
use cannonpile::shape::Selection;
use cannonpile_stability::{RoughFloor, RoughPacking};
use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::Zero;

/// Returns the table of the contacts between spheres with friction on a rough floor: `k, i, j, direction, normal,
/// tangential`. In SI units the normal force on the upper sphere `nx, ny, nz`, the tangential one `tx, ty, tz` and the
/// contact point `x, y, z` follow. Discs have no `j`.
///
/// In pile units the normal force is in mg, and the tangential force in mg·tan(θ/2).
///
/// # Errors
/// As for [`contacts`](super::contacts), and [`RoughFloor`](cannonpile_stability::Error::RoughFloor).
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_dem::table;
/// use cannonpile_dem::table::{FileFormat, NumberFormat, Units};
/// use cannonpile::shape::Selection;
///
/// let pile = Pile::triangular(2)?;
/// let mut csv = Vec::new();
/// let table = table::rough_contacts(&Units::of_pile(&pile), Selection::All)?;
/// table.write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
/// assert!(csv.starts_with(b"k,i,j,direction,normal,tangential\n0,0,0,alpha,1/3,1/3\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn rough_contacts<'p>(units: &Units<'p>, selection: Selection) -> Result<Table<'p>, Error> {
    let pile = units.pile();
    let rough = Rough::of(units)?;
    let rows = pile.rows(selection)?.off_the_floor();
    let count = rows.site_count() * pile.dimension().directions().len();
    refuse_beyond(&count, narrower(selection))?;
    let mut columns = indices(pile, &["k"]);
    columns.push(Column::plain("direction"));
    columns.push(Column::measured("normal", units.normal()));
    columns.push(Column::measured("tangential", units.tangential()));
    if let Units::Si(_) = units {
        let vectors = ["nx", "ny", "nz", "tx", "ty", "tz"];
        columns.extend(vectors.map(|name| Column::measured(name, "N")));
        columns.extend(["x", "y", "z"].each(|name| Column::measured(name, "m")));
    }
    let bounds = bounds(&columns, units, selection);
    let rows = move |_| -> Result<RowIter<'p>, Error> {
        Ok(match rough {
            Rough::Pile(forces) => {
                let contacts = forces.contacts::<BigRational>(selection)?;
                boxed(contacts.map(move |contact| {
                    let contact = contact?;
                    let mut cells = contact_cells(pile, contact.site, contact.direction.into());
                    cells.extend([contact.force.clone().into(), contact.force.into()]);
                    Ok(cells)
                }))
            }
            Rough::Si(packing) => boxed(packing.contacts(selection)?.map(move |contact| {
                let contact = contact?;
                let mut cells = contact_cells(pile, contact.site, contact.direction.into());
                cells.extend([contact.normal.into(), contact.tangential.into()]);
                cells.extend(contact.normal_vector.each(Cell::from));
                cells.extend(contact.tangential_vector.each(Cell::from));
                cells.extend(contact.point.each(Cell::from));
                Ok(cells)
            })),
        })
    };
    Ok(Table::made_for(columns, "contacts", rows).bounded(count, bounds))
}

/// Returns the table of the forces of bottom spheres on a rough floor: `i, j, normal, friction_x, friction_y`; for discs
/// `i, normal, friction_x`.
///
/// In pile units the normal force is in mg, and the friction in mg·tan(θ/2) along x and 2cosφ·mg·tan(θ/2) along y.
///
/// # Errors
/// As for [`base`](super::base), and [`RoughFloor`](cannonpile_stability::Error::RoughFloor).
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_dem::table;
/// use cannonpile_dem::table::{FileFormat, NumberFormat, Units};
/// use cannonpile::shape::Selection;
///
/// let pile = Pile::triangular(2)?;
/// let mut csv = Vec::new();
/// let table = table::rough_base(&Units::of_pile(&pile), Selection::Base)?;
/// table.write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
/// assert!(csv.starts_with(b"i,j,normal,friction_x,friction_y\n0,0,4/3,-1/6,-1/6\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn rough_base<'p>(units: &Units<'p>, selection: Selection) -> Result<Table<'p>, Error> {
    let pile = units.pile();
    let rough = Rough::of(units)?;
    let count = pile.rows(selection)?.site_count();
    refuse_beyond(&count, "ask for one sphere")?;
    let mut columns = indices(pile, &[]);
    columns.push(Column::measured("normal", units.normal()));
    columns.push(Column::measured("friction_x", units.tangential()));
    if pile.dimension() == Dimension::Three {
        columns.push(Column::measured("friction_y", units.friction_y()));
    }
    let bounds = bounds(&columns, units, selection);
    let rows = move |_| -> Result<RowIter<'p>, Error> {
        Ok(match rough {
            Rough::Pile(forces) => {
                let forces = forces.base::<BigRational>(selection)?;
                boxed(forces.map(move |force| Ok(floor_cells(pile, force?))))
            }
            Rough::Si(packing) => {
                let forces = packing.base(selection)?;
                boxed(forces.map(move |force| Ok(floor_cells(pile, force?))))
            }
        })
    };
    Ok(Table::made_for(columns, "bottom spheres", rows).bounded(count, bounds))
}

/// Returns the table of one pile on a rough floor, in one row: `layers, spheres, contacts, weight, base_spheres,
/// normal_min, normal_max, friction_needed, floor_friction_needed, stands`.
///
/// `stands` is the verdict for given coefficients of friction, as of
/// [`Scene::stands_with_friction`](crate::scene::Scene::stands_with_friction). The two before it are the least coefficients of friction for equilibrium, of a contact with a force between spheres and of
/// the floor. In pile units they are multiples of tan(θ/2).
///
/// # Errors
/// [`RoughFloor`](cannonpile_stability::Error::RoughFloor), and the errors of [`Pile::base_extremes`](cannonpile::Pile::base_extremes).
///
/// # Examples
/// ```
/// use cannonpile::{Packing, Pile};
/// use cannonpile_dem::table;
/// use cannonpile_dem::table::{FileFormat, NumberFormat, Units};
///
/// let pile = Pile::triangular(2)?;
/// let units = Units::of_packing(Packing::new(&pile, &"6/5".parse()?)?);
/// let mut text = Vec::new();
/// table::rough_summary(&units, None)?.write(FileFormat::Text, NumberFormat::F64, &mut text)?;
/// let text = String::from_utf8(text)?;
/// assert!(text.contains("floor_friction_needed  0.1006356683102495"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn rough_summary(units: &Units<'_>, stands: Option<bool>) -> Result<Table<'static>, Error> {
    let pile = units.pile();
    let [contacts, floor]: [Cell; 2] = match Rough::of(units)? {
        Rough::Pile(forces) => [
            BigRational::from_integer(1.into()).into(),
            forces.floor_friction()?.into(),
        ],
        Rough::Si(packing) => [
            packing.contact_friction().into(),
            packing.floor_friction()?.into(),
        ],
    };
    let base = pile.base_extremes()?;
    // Without friction on the floor, no contact has a force.
    let contacts = if base.max_shear_ratio.square().is_zero() {
        BigRational::zero().into()
    } else {
        contacts
    };
    let in_units = |force: BigRational| -> Cell {
        match units {
            Units::Pile(_) => force.into(),
            Units::Si(packing) => (force * packing.sphere_weight()).into(),
        }
    };
    let force = |name, force| (Column::measured(name, units.normal()), in_units(force));
    let count = |name, count: BigUint| (Column::plain(name), Cell::Integer(count.into()));
    let coefficient = |name, cell| (Column::measured(name, units.half_angle()), cell);
    let verdict = stands.map(|stands| if stands { "yes" } else { "no" });
    Ok(Table::record(vec![
        (Column::plain("layers"), pile.layers().into()),
        count("spheres", pile.sphere_count()),
        count("contacts", pile.contact_count()),
        force("weight", pile.weight()),
        count("base_spheres", pile.base_sphere_count()),
        force("normal_min", base.normal_min),
        force("normal_max", base.normal_max),
        coefficient("friction_needed", contacts),
        coefficient("floor_friction_needed", floor),
        (
            Column::plain("stands"),
            verdict.map_or(Cell::Missing, Cell::from),
        ),
    ]))
}

/// Forces with friction, in the units of a table.
#[derive(Clone)]
enum Rough<'p> {
    Pile(RoughFloor<'p>),
    Si(Box<RoughPacking<'p>>),
}

impl<'p> Rough<'p> {
    fn of(units: &Units<'p>) -> Result<Self, Error> {
        Ok(match units {
            Units::Pile(_) => Self::Pile(RoughFloor::new(units.pile())?),
            Units::Si(packing) => Self::Si(Box::new(RoughPacking::new(packing)?)),
        })
    }
}
