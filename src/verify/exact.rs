//! The exact contacts of a pile, rounded, by the numbers of their spheres.

use std::collections::HashMap;

use num_rational::BigRational;

use super::Refusal;
use crate::lattice::{Direction, Sign, Site};
use crate::scalar::{RealSign, Surd};
use crate::shape::{Numbering, Selection};
use crate::{ContactForce, Error, Packing};

/// A contact of the pile.
pub(super) struct Exact {
    /// The upper sphere, and the lower one: the lesser number and the greater.
    pub(super) ids: [u64; 2],
    /// The upper sphere.
    pub(super) site: Site,
    /// Where the lower one lies.
    pub(super) direction: Direction,
    /// The force rounded to the nearest float, which is 0 just if it is.
    pub(super) force: f64,
    /// The force on the upper sphere, if it was asked for.
    pub(super) vector: Option<[f64; 3]>,
}

/// All contacts of a pile, from the top.
pub(super) fn contacts<'p>(
    packing: &Packing<'p>,
    numbering: &Numbering<'p>,
    with_vectors: bool,
) -> Result<impl Iterator<Item = Result<Exact, Refusal>>, Error> {
    let mut ids = Ids::new(numbering);
    let mut rounded = Rounded::new(packing, with_vectors);
    let contacts = packing.forces().contacts(Selection::All)?;
    Ok(contacts.map(move |contact| {
        let contact = contact?;
        let (site, direction) = (contact.site, contact.direction);
        let (force, vector) = rounded.of(contact)?;
        Ok(Exact {
            ids: ids.of(site, direction)?,
            site,
            direction,
            force,
            vector,
        })
    }))
}

/// How many forces are kept: a straight pile has as many as layers, in each direction.
const KNOWN: usize = 1 << 15;

/// What a force depends on: the way it points, and its multiple of f₀.
type Key = (Option<Sign>, Direction, BigRational);

/// Forces rounded to floats, each once while it is remembered.
struct Rounded<'r, 'p> {
    packing: &'r Packing<'p>,
    unit: Surd,
    with_vectors: bool,
    known: HashMap<Key, (f64, Option<[f64; 3]>)>,
}

impl<'r, 'p> Rounded<'r, 'p> {
    fn new(packing: &'r Packing<'p>, with_vectors: bool) -> Self {
        Self {
            packing,
            unit: packing.unit_force(),
            with_vectors,
            known: HashMap::new(),
        }
    }

    /// A force, and as a vector on the upper sphere if that was asked for.
    fn of(
        &mut self,
        contact: ContactForce<BigRational>,
    ) -> Result<(f64, Option<[f64; 3]>), Refusal> {
        let (site, direction) = (contact.site, contact.direction);
        let sign = self.packing.pile().shape().sign_below(site.k);
        let key = (sign, direction, contact.force);
        if let Some(known) = self.known.get(&key) {
            return Ok(*known);
        }
        let force = rounded(&self.unit.scaled(&key.2))?;
        let vector = if self.with_vectors {
            Some(components(&self.packing.vector(site, direction, &key.2)?)?)
        } else {
            None
        };
        if self.known.len() >= KNOWN {
            self.known.clear();
        }
        self.known.insert(key, (force, vector));
        Ok((force, vector))
    }
}

/// A force as the nearest float, of full precision.
fn rounded(force: &Surd) -> Result<f64, Refusal> {
    match (force.nearest::<f64>(), force.sign()) {
        (Some(float), RealSign::Zero) => Ok(float),
        (Some(float), _) if float.is_normal() => Ok(float),
        _ => Err(Refusal::OutOfRange),
    }
}

/// Components may be as small as they like.
fn components(vector: &[Surd; 3]) -> Result<[f64; 3], Refusal> {
    let [x, y, z] = vector.each_ref().map(Surd::nearest::<f64>);
    let whole = x.zip(y).zip(z).map(|((x, y), z)| [x, y, z]);
    whole.ok_or(Refusal::OutOfRange)
}

/// The numbers of the spheres of contacts that come in rows.
struct Ids<'n, 'p> {
    numbering: &'n Numbering<'p>,
    /// The layer and the row of the upper sphere before.
    row: Option<(i128, i128)>,
    /// What is to be added to i in this row, for the upper sphere and for the lower one by direction.
    offsets: [Option<i128>; 4],
}

impl<'n, 'p> Ids<'n, 'p> {
    fn new(numbering: &'n Numbering<'p>) -> Self {
        Self {
            numbering,
            row: None,
            offsets: [None; 4],
        }
    }

    fn of(&mut self, site: Site, direction: Direction) -> Result<[u64; 2], Error> {
        if self.row != Some((site.k, site.j)) {
            self.row = Some((site.k, site.j));
            self.offsets = [None; 4];
        }
        let upper = self.id(0, site, site)?;
        let shape = self.numbering.shape();
        // Every sphere off the floor has one below it.
        let lower = shape.below(site, direction).unwrap_or(site);
        Ok([upper, self.id(1 + direction.index(), site, lower)?])
    }

    /// The number of `sphere`, which is as far along its row as `site` is along its own.
    fn id(&mut self, place: usize, site: Site, sphere: Site) -> Result<u64, Error> {
        let offset = self.offsets.get(place).copied().flatten();
        let offset = match offset {
            Some(offset) => offset,
            None => i128::from(self.numbering.id(sphere)?) - site.i,
        };
        if let Some(kept) = self.offsets.get_mut(place) {
            *kept = Some(offset);
        }
        Ok(u64::try_from(site.i + offset).unwrap_or_default())
    }
}
