//! The residual force on each sphere.

use core::fmt;

use num_rational::BigRational;

use super::loads::{Loads, Sphere};
use super::measured::{Measured, norm, opposite, relative};
use super::refusal::Refusal;
use crate::Error;
use crate::error::bug;
use crate::numbered::nearest;
use crate::table::{Cell, Column, Table, indices, places};
use crate::vector::{cross, dot, minus, plus};
use crate::weights::{ordinary_weight, rounded_newtons};
use crate::{Each, NumberedContact, NumberedPile};
use cannonpile::lattice::Site;
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
/// let read = Reader::new().compare(&packing, table.as_bytes())?;
/// let unbalanced = read.unbalanced;
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
    /// let read = Reader::new().compare(&packing, &b"id1,id2,force\n1,2,0\n"[..])?;
    /// assert_eq!(read.unbalanced.forces(), [[0.0, 0.0, -1.0]]);
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
    /// let read = Reader::new().compare(&packing, &b"id1,id2,force\n1,2,0\n"[..])?;
    /// assert_eq!(read.unbalanced.greatest(), Some((1, 1.0)));
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
    /// let read = Reader::new().compare(&packing, &b"id1,id2,force\n1,2,0\n"[..])?;
    /// let mut csv = Vec::new();
    /// read.unbalanced.table(&packing)?.write(FileFormat::Csv, NumberFormat::F64, &mut csv)?;
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
    directions: Directions,
    /// The spheres above the floor; on a rough floor all spheres.
    spheres: Vec<Sphere>,
    above: usize,
    is_rough: bool,
    /// The weight of an ordinary sphere, or 1 without weights, in N.
    unit: f64,
}

/// For each layer, the unit vectors from the lower to the upper sphere of its contacts, in the order of the directions.
#[derive(Clone)]
pub(super) struct Directions(Vec<Vec<[f64; 3]>>);

impl Directions {
    pub(super) fn of(numbered: &NumberedPile<'_>) -> Result<Self, Error> {
        let (packing, pile) = (numbered.packing(), numbered.pile());
        let shape = pile.shape();
        let layers = (0..pile.layers() - 1).map(|k| {
            let [i, j] = shape.layer(k)?.corners()[0];
            let top = Site { i, j, k };
            let directions = pile.dimension().directions().iter().map(|direction| {
                let below = shape.below(top, *direction);
                between(packing, top, below.ok_or_else(|| Error::on_floor(top))?)
            });
            directions.collect()
        });
        Ok(Self(layers.collect::<Result<_, Error>>()?))
    }

    fn get(&self, layer: usize, direction: usize) -> Result<[f64; 3], Error> {
        let found = self.0.get(layer).and_then(|layer| layer.get(direction));
        found
            .copied()
            .ok_or_else(|| bug("a contact has a direction"))
    }

    /// Returns the measurement of the n-th contact of two layers with its normal and its tangential force. If the latter is not
    /// listed, the vector is the whole force. The upper sphere is the first.
    pub(super) fn split(&self, n: usize, measured: Measured) -> Result<Measured, Error> {
        let (Some(vector), None) = (measured.vector, measured.tangential) else {
            return Ok(measured);
        };
        let up = self.get(0, n % self.0.first().map_or(1, Vec::len))?;
        let along = dot(vector, up);
        let normal = up.each(|component| component * along);
        Ok(Measured {
            force: if measured.is_length {
                along
            } else {
                measured.force
            },
            vector: Some(normal),
            tangential: Some(minus(vector, normal)),
            ..measured
        })
    }
}

/// The net moment on a sphere, with the horizontal net force on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct NetMoment {
    pub(super) sphere: u64,
    /// The moment, over R times the largest exact tangential force.
    pub(super) moment: f64,
    /// The force, over the largest exact tangential force.
    pub(super) force: f64,
}

impl<'p> Balance<'p> {
    /// Starts with the weights and loads of all spheres.
    pub(super) fn new(numbered: &NumberedPile<'p>, is_rough: bool) -> Result<Self, Refusal> {
        let packing = numbered.packing();
        let pile = packing.pile();
        let in_newtons =
            |load| rounded_newtons(packing, load, "a load").map_err(|_| Refusal::OutOfRange);
        let leaning = |weight| Load::leaning(weight, pile.tilt());
        let ordinary = in_newtons(leaning(ordinary_weight(pile)))?;
        let numbering = numbered.numbering();
        let above = numbering.first_on_floor() - 1;
        let all = if is_rough {
            numbering.sphere_count()
        } else {
            above
        };
        let [above, all] = [above, all].each(|count| usize::try_from(count).unwrap_or(usize::MAX));
        let sphere = Sphere {
            force: ordinary,
            moment: [0.0; 3],
            turn: 0.0,
            is_open: false,
        };
        let mut spheres = vec![sphere; all];
        let loaded = pile.loads().map(|(site, _)| site);
        for site in loaded.chain(pile.weights().map(|(site, _)| site)) {
            let total = leaning(pile.sphere_weight(site)?) + &pile.load(site)?;
            if let Some(sphere) = place(&mut spheres, numbered.numbering().id(site)?) {
                sphere.force = in_newtons(total)?;
            }
        }
        let weight = norm(ordinary);
        Ok(Self {
            pile: numbered.clone(),
            spheres,
            directions: Directions::of(numbered)?,
            above,
            is_rough,
            unit: if weight > 0.0 { weight } else { 1.0 },
        })
    }

    /// Adds the measured force of a contact of the pile.
    pub(super) fn add(
        &mut self,
        contact: &NumberedContact,
        measured: Option<&Measured>,
    ) -> Result<(), Error> {
        let is_known = |measured: &&Measured| !self.is_rough || measured.tangential.is_some();
        let Some(measured) = measured.filter(is_known) else {
            for id in contact.ids.into_iter().filter(|_| contact.force != 0.0) {
                self.open(id);
            }
            return Ok(());
        };
        let direction = match contact.direction.direction() {
            Some(direction) => {
                let layer = usize::try_from(contact.site.k).unwrap_or(usize::MAX);
                self.directions.get(layer, direction.index())?
            }
            None => self.between(contact.ids)?,
        };
        let along = direction.each(|component| component * measured.force);
        let vector = whole(measured.vector.unwrap_or(along), measured);
        // Force and arm change their signs together, so both moments are equal.
        let moment = cross(direction, vector);
        self.act(contact.ids, vector, moment);
        let turn = norm(moment) / norm(vector);
        if let Some(upper) = place(&mut self.spheres, contact.ids[0]) {
            upper.turn = upper.turn.max(turn);
        }
        Ok(())
    }

    fn open(&mut self, id: u64) {
        if let Some(sphere) = place(&mut self.spheres, id) {
            sphere.is_open = true;
        }
    }

    /// Adds the force of the floor on a sphere, if it is known.
    pub(super) fn add_floor(&mut self, id: u64, force: Option<[f64; 3]>) {
        match force {
            Some(force) => self.act([id, 0], force, cross([0.0, 0.0, 1.0], force)),
            None => self.open(id),
        }
    }

    /// Returns the net moments on all spheres whose forces are known, for the largest exact tangential force.
    pub(super) fn moments(&self, largest: f64) -> Vec<NetMoment> {
        let known = (1..)
            .zip(&self.spheres)
            .filter(|(_, sphere)| !sphere.is_open);
        let nets = known.map(|(id, sphere)| {
            let [x, y, _] = sphere.force;
            NetMoment {
                sphere: id,
                moment: relative(norm(sphere.moment), largest),
                force: relative(norm([x, y, 0.0]), largest),
            }
        });
        nets.collect()
    }

    /// Adds the measured force of a pair without a contact.
    pub(super) fn add_stray(&mut self, stray: &Measured) -> Result<(), Error> {
        let vector = match stray.vector {
            Some(vector) => vector,
            None => self
                .between(stray.ids)?
                .each(|component| component * stray.force),
        };
        self.act(stray.ids, whole(vector, stray), [0.0; 3]);
        Ok(())
    }

    /// Returns the residual forces, and what they have in common.
    pub(super) fn close(self) -> Result<(Unbalanced, Loads), Error> {
        let spheres = self.spheres.get(..self.above);
        let spheres = spheres.ok_or_else(|| bug("every sphere above the floor has a sum"))?;
        let loads = Loads::of(&self.pile, spheres, self.unit)?;
        let forces = spheres.iter().map(|sphere| sphere.force);
        let forces = forces.collect();
        Ok((Unbalanced { forces }, loads))
    }

    /// Adds a force to the first of two spheres and its reaction to the second, and a moment to both.
    fn act(&mut self, [first, second]: [u64; 2], vector: [f64; 3], moment: [f64; 3]) {
        for (id, force) in [(first, vector), (second, opposite(vector))] {
            if let Some(sphere) = place(&mut self.spheres, id) {
                sphere.force = plus(sphere.force, force);
                sphere.moment = plus(sphere.moment, moment);
            }
        }
    }

    /// Returns the unit vector from the second to the first of two spheres.
    fn between(&self, ids: [u64; 2]) -> Result<[f64; 3], Error> {
        let numbering = self.pile.numbering();
        let [Some(one), Some(other)] = ids.each(|id| numbering.site(id)) else {
            return Err(bug("a contact has spheres with numbers"));
        };
        between(self.pile.packing(), one, other)
    }
}

/// Returns the force with its tangential part, if that is listed apart.
fn whole(vector: [f64; 3], measured: &Measured) -> [f64; 3] {
    measured
        .tangential
        .map_or(vector, |part| plus(vector, part))
}

/// Returns the unit vector from one site to another.
fn between(packing: &Packing<'_>, to: Site, from: Site) -> Result<[f64; 3], Error> {
    let (to, from) = (packing.position(to)?, packing.position(from)?);
    let mut apart = [0.0; 3];
    for (apart, (to, from)) in apart.iter_mut().zip(to.iter().zip(&from)) {
        let exact = to.checked_add(&-from.clone());
        let exact = exact.ok_or_else(|| bug("coordinates along one axis have one root"))?;
        *apart = nearest(&exact, "a distance")?;
    }
    let length = norm(apart);
    Ok(apart.each(|component| component / length))
}

/// Returns the sums of a sphere above the floor, or `None` for other spheres.
fn place(spheres: &mut [Sphere], id: u64) -> Option<&mut Sphere> {
    spheres.get_mut(usize::try_from(id.checked_sub(1)?).ok()?)
}

/// Returns the exact value of a float. A sum of large forces may be infinite, or not a number.
fn float(x: f64) -> Cell {
    let exact = BigRational::from_float(x);
    exact.map_or_else(|| Cell::Word(x.to_string().into()), Cell::from)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::{FileFormat, NumberFormat};

    #[test]
    fn infinite_sums_keep_their_sign() {
        let pile = cannonpile::Pile::triangular(2).unwrap();
        let packing = Packing::new(&pile, &"1.2".parse().unwrap()).unwrap();
        let forces = vec![[f64::NEG_INFINITY, f64::NAN, 0.5]];
        let (unbalanced, mut csv) = (Unbalanced { forces }, Vec::new());
        let table = unbalanced.table(&packing).unwrap();
        table
            .write(FileFormat::Csv, NumberFormat::F64, &mut csv)
            .unwrap();
        let csv = String::from_utf8(csv).unwrap();
        assert!(csv.ends_with("\n1,0,0,0,-inf,NaN,0.5,NaN\n"), "{csv}");
    }
}
