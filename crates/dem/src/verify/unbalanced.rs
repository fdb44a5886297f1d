//! The residual force on each sphere.

use core::fmt;

use num_rational::BigRational;

use super::measured::{Measured, norm};
use super::refusal::Refusal;
use crate::Error;
use crate::error::bug;
use crate::numbered::rounded;
use crate::table::{Cell, Column, Table, indices, places};
use crate::vector::{minus, plus};
use crate::weights::{ordinary_weight, rounded_newtons};
use crate::{Each, NumberedContact, NumberedPile};
use cannonpile::lattice::Site;
use cannonpile::scalar::Surd;
use cannonpile::shape::Selection;
use cannonpile::{Load, Packing};

/// The sum of the measured forces, the weight and the load of each sphere. It is zero for a pile at rest.
///
/// For a sphere above the floor, **r** = Σ **F** + **W** + **P**, in N, with the weight **W** and the load **P**. Gravity may
/// lean. The sum covers all measured pairs, with or
/// without a contact in the pile. A force without a vector acts along the line between the exact centres.
///
/// # Examples
/// ```
/// use cannonpile::geometry::Spacing;
/// use cannonpile_dem::verify::Reader;
/// use cannonpile::{Packing, Pile};
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(2)?;
/// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
/// let table = "id1,id2,force\n1,2,0.46225\n1,3,0.46225\n1,4,0.46225\n";
/// let read = Reader::new().with_balance().compare(&packing, table.as_bytes())?;
/// let unbalanced = read.unbalanced.unwrap();
/// assert_eq!(unbalanced.forces().len(), 1);
/// assert!(unbalanced.greatest().unwrap().1 < 1e-6);
/// # Ok::<(), cannonpile_dem::verify::Refusal>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Unbalanced {
    forces: Vec<[f64; 3]>,
}

impl Unbalanced {
    /// Returns the residual force on each sphere above the floor, in N, in the order of the sphere numbers from 1.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::Reader;
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // No force supports the sphere.
    /// let read = Reader::new().with_balance().compare(&packing, &b"id1,id2,force\n1,2,0\n"[..])?;
    /// assert_eq!(read.unbalanced.unwrap().forces(), [[0.0, 0.0, -1.0]]);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn forces(&self) -> &[[f64; 3]] {
        &self.forces
    }

    /// Returns the number of the sphere with the greatest residual force, and its magnitude in N.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::Reader;
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let read = Reader::new().with_balance().compare(&packing, &b"id1,id2,force\n1,2,0\n"[..])?;
    /// assert_eq!(read.unbalanced.unwrap().greatest(), Some((1, 1.0)));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn greatest(&self) -> Option<(u64, f64)> {
        let norms = self.forces.iter().map(|force| norm(*force));
        (1..).zip(norms).max_by(|(_, a), (_, b)| a.total_cmp(b))
    }

    /// Returns a table with one row for each sphere above the floor: `id,k,i,j,x,y,z,unbalanced`, forces in N.
    ///
    /// # Errors
    /// None, if the packing is the compared one.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::table::{FileFormat, NumberFormat};
    /// # use cannonpile_dem::verify::Reader;
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let read = Reader::new().with_balance().compare(&packing, &b"id1,id2,force\n1,2,0\n"[..])?;
    /// let mut csv = Vec::new();
    /// read.unbalanced.unwrap().table(&packing)?.write(FileFormat::Csv, NumberFormat::F64, &mut csv)?;
    /// assert_eq!(String::from_utf8(csv)?, "id,k,i,j,x,y,z,unbalanced\n1,0,0,0,0.0,0.0,-1.0,1.0\n");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn table<'t>(&'t self, packing: &Packing<'t>) -> Result<Table<'t>, Error> {
        let pile = packing.pile();
        let mut columns = indices(pile, &["id", "k"]);
        let forces = ["x", "y", "z", "unbalanced"];
        columns.extend(forces.map(|name| Column::measured(name, "N")));
        let sites = pile.rows(Selection::All)?.flatten();
        let rows = (1_u64..).zip(sites.zip(&self.forces));
        let rows = rows.map(|(id, (site, force))| {
            let mut cells = vec![Cell::Integer(id.into()), site.k.into()];
            cells.extend(places(pile, site));
            let [x, y, z] = *force;
            cells.extend([x, y, z, norm(*force)].map(float));
            Ok(cells)
        });
        Ok(Table::of_rows(columns, "spheres", rows))
    }
}

impl fmt::Display for Unbalanced {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.greatest() {
            Some((id, force)) => write!(f, "{force:?} N at sphere {id}"),
            None => f.write_str("no sphere is above the floor"),
        }
    }
}

/// The residual forces, added up contact by contact.
pub(super) struct Balance<'p> {
    pile: NumberedPile<'p>,
    unbalanced: Unbalanced,
    /// The layer of the last contact, with the unit vectors of its contact directions from below.
    layer: Option<(i128, [Option<[f64; 3]>; 3])>,
}

impl<'p> Balance<'p> {
    /// Starts with the weights and loads of all spheres above the floor.
    pub(super) fn new(numbered: &NumberedPile<'p>) -> Result<Self, Refusal> {
        let packing = numbered.packing();
        let pile = packing.pile();
        let in_newtons =
            |load| rounded_newtons(packing, load, "a load").map_err(|_| Refusal::OutOfRange);
        let leaning = |weight| Load::leaning(weight, pile.tilt());
        let ordinary = in_newtons(leaning(ordinary_weight(pile)))?;
        let above = usize::try_from(numbered.numbering().first_on_floor() - 1)
            .map_err(|_| bug("contacts that are compared fit in memory"))?;
        let mut forces = vec![ordinary; above];
        let loaded = pile.loads().map(|(site, _)| site);
        for site in loaded.chain(pile.weights().map(|(site, _)| site)) {
            let total = leaning(pile.sphere_weight(site)?) + &pile.load(site)?;
            if let Some(force) = place(&mut forces, numbered.numbering().id(site)?) {
                *force = in_newtons(total)?;
            }
        }
        Ok(Self {
            pile: numbered.clone(),
            unbalanced: Unbalanced { forces },
            layer: None,
        })
    }

    /// Adds the measured force of a contact of the pile.
    pub(super) fn add(
        &mut self,
        contact: &NumberedContact,
        measured: &Measured,
    ) -> Result<(), Error> {
        let vector = if let Some(vector) = measured.vector {
            vector
        } else {
            let direction = self.direction(contact)?;
            direction.each(|component| component * measured.force)
        };
        self.act(contact.ids, whole(vector, measured));
        Ok(())
    }

    /// Adds the measured force of a pair without a contact.
    pub(super) fn add_stray(&mut self, stray: &Measured) -> Result<(), Error> {
        let vector = if let Some(vector) = stray.vector {
            vector
        } else {
            let numbering = self.pile.numbering();
            let [Some(one), Some(other)] = stray.ids.each(|id| numbering.site(id)) else {
                return Ok(());
            };
            let direction = between(self.pile.packing(), one, other)?;
            direction.each(|component| component * stray.force)
        };
        self.act(stray.ids, whole(vector, stray));
        Ok(())
    }

    pub(super) fn close(self) -> Unbalanced {
        self.unbalanced
    }

    /// Adds a force to the first of two spheres, and its reaction to the second.
    fn act(&mut self, [first, second]: [u64; 2], vector: [f64; 3]) {
        let forces = &mut self.unbalanced.forces;
        if let Some([x, y, z]) = place(forces, first) {
            let [a, b, c] = vector;
            (*x, *y, *z) = (*x + a, *y + b, *z + c);
        }
        if let Some(force) = place(forces, second) {
            *force = minus(*force, vector);
        }
    }

    /// Returns the unit vector from the second to the first sphere of a contact. It is the same for all contacts of one
    /// direction in a layer.
    fn direction(&mut self, contact: &NumberedContact) -> Result<[f64; 3], Error> {
        let Some(direction) = contact.direction.direction() else {
            let numbering = self.pile.numbering();
            let [Some(one), Some(other)] = contact.ids.each(|id| numbering.site(id)) else {
                return Err(bug("a contact has spheres with numbers"));
            };
            return between(self.pile.packing(), one, other);
        };
        let Site { k, .. } = contact.site;
        if self.layer.as_ref().is_none_or(|(layer, _)| *layer != k) {
            self.layer = Some((k, [None; 3]));
        }
        let known = self.layer.as_mut().map(|(_, known)| known);
        let known = known.ok_or_else(|| bug("a layer is being added up"))?;
        let known = &mut known[direction.index()];
        if let Some(direction) = known {
            return Ok(*direction);
        }
        let packing = self.pile.packing();
        let below = packing.pile().shape().below(contact.site, direction);
        let below = below.ok_or_else(|| Error::on_floor(contact.site))?;
        let made = between(packing, contact.site, below)?;
        Ok(*known.insert(made))
    }
}

/// Returns the force with its tangential part, if that is listed apart.
fn whole(vector: [f64; 3], measured: &Measured) -> [f64; 3] {
    measured
        .tangential
        .map_or(vector, |part| plus(vector, part))
}

/// Returns the unit vector from one site to another.
pub(super) fn between(packing: &Packing<'_>, to: Site, from: Site) -> Result<[f64; 3], Error> {
    let (to, from) = (packing.position(to)?, packing.position(from)?);
    let apart: Vec<Surd> = {
        let parts = to.iter().zip(&from);
        let parts = parts.map(|(to, from)| to.checked_add(&-from.clone()));
        let apart: Option<_> = parts.collect();
        apart.ok_or_else(|| bug("coordinates along one axis have one root"))?
    };
    let apart = <[Surd; 3]>::try_from(apart).map_err(|_| bug("a vector has three components"))?;
    let apart = rounded(&apart, "a distance")?;
    let length = norm(apart);
    Ok(apart.each(|component| component / length))
}

/// Returns the force on a sphere above the floor, or `None` for other spheres.
fn place(forces: &mut [[f64; 3]], id: u64) -> Option<&mut [f64; 3]> {
    forces.get_mut(usize::try_from(id.checked_sub(1)?).ok()?)
}

/// Returns the exact value of a float.
pub(super) fn float(x: f64) -> Cell {
    let exact = BigRational::from_float(x);
    exact.map_or(Cell::Word("inf".into()), Cell::from)
}
