//! Places and forces as the nearest floats, each distinct one rounded once.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::hash::{Hash, Hasher};

use num_rational::BigRational;

use crate::lattice::Sign;
use crate::lattice::{Dimension, Direction, Row, Site};
use crate::scalar::Surd;
use crate::shape::{Numbering, Rows, Selection};
use crate::{Error, Packing};

/// The nearest float; `quantity` is named if there is none.
pub(super) fn nearest(number: &Surd, quantity: &'static str) -> Result<f64, Error> {
    let scalar = "f64";
    number.nearest().ok_or(Error::Overflow { quantity, scalar })
}

/// The nearest float to a rational.
pub(super) fn nearest_rational(number: &BigRational, quantity: &'static str) -> Result<f64, Error> {
    nearest(&number.clone().into(), quantity)
}

/// How many coordinates along rows are kept: enough for 20,000 layers of spheres under one.
const KEPT_PLACES: usize = 1 << 16;

/// The centres of spheres.
///
/// Along a row but one coordinate changes: y, of discs x. In all of the pile it is the same multiple of the distance
/// between two neighbours, half of that and so on, wherever 2i + j less the shift of the layer is the same.
pub(super) struct Centres<'a, 'p> {
    packing: &'a Packing<'p>,
    /// The coordinate that changes along rows: 0 or 1.
    along: usize,
    row: Option<Line>,
    rounded: HashMap<i128, f64>,
}

/// What the spheres of a row have in common.
struct Line {
    k: i128,
    j: i128,
    /// The coordinates, of which that along the row counts for nothing.
    centre: [f64; 3],
    shift: i128,
}

impl<'a, 'p> Centres<'a, 'p> {
    pub(super) fn new(packing: &'a Packing<'p>) -> Self {
        let along = match packing.pile().dimension() {
            Dimension::Two => 0,
            Dimension::Three => 1,
        };
        Self {
            packing,
            along,
            row: None,
            rounded: HashMap::new(),
        }
    }

    /// The centre of a sphere: fastest along rows.
    pub(super) fn of(&mut self, site: Site) -> Result<[f64; 3], Error> {
        let Site { i, j, k } = site;
        let line = match self.row.take().filter(|line| (line.k, line.j) == (k, j)) {
            Some(line) => line,
            None => Line {
                k,
                j,
                centre: self.rounded(site)?,
                shift: j - self.packing.pile().shape().shift_from_origin(k),
            },
        };
        let place = 2 * i + line.shift;
        let mut centre = line.centre;
        self.row = Some(line);
        let along = if let Some(along) = self.rounded.get(&place) {
            *along
        } else {
            let [x, y, _] = self.rounded(site)?;
            let along = if self.along == 0 { x } else { y };
            // One row may be as long as the pile has spheres.
            if self.rounded.len() >= KEPT_PLACES {
                self.rounded.clear();
            }
            self.rounded.insert(place, along);
            along
        };
        if let Some(coordinate) = centre.get_mut(self.along) {
            *coordinate = along;
        }
        Ok(centre)
    }

    fn rounded(&self, site: Site) -> Result<[f64; 3], Error> {
        let [x, y, z] = self.packing.position(site)?;
        let nearest = |length| nearest(length, "a position");
        Ok([nearest(&x)?, nearest(&y)?, nearest(&z)?])
    }
}

/// A contact, with the numbers of its spheres.
pub(super) struct Touch {
    pub(super) upper: u64,
    pub(super) lower: u64,
    pub(super) site: Site,
    pub(super) direction: Direction,
}

/// The contacts of a pile with the numbers of their spheres, in the order of
/// [`Forces::contacts`](crate::Forces::contacts).
pub(super) struct Touches<'a, 'p> {
    numbering: &'a Numbering<'p>,
    directions: &'static [Direction],
    rows: Rows<'p>,
    row: Option<Strip>,
}

/// A row of spheres, and the rows that they stand on: along them numbers follow each other.
struct Strip {
    first: Site,
    spheres: u64,
    upper: u64,
    lower: [u64; 3],
    /// How many spheres are done, and how many contacts of the next.
    done: u64,
    contacts: usize,
}

impl<'a, 'p> Touches<'a, 'p> {
    pub(super) fn new(numbering: &'a Numbering<'p>) -> Result<Self, Error> {
        let shape = numbering.shape();
        Ok(Self {
            numbering,
            directions: shape.dimension().directions(),
            rows: shape.rows(Selection::All)?.off_the_floor(),
            row: None,
        })
    }

    fn strip(&self, row: &Row) -> Result<Strip, Error> {
        let first = Site {
            i: row.i.start,
            j: row.j,
            k: row.k,
        };
        let mut lower = [0; 3];
        for direction in self.directions {
            let below = self.numbering.shape().below(first, *direction);
            let below = below.ok_or(Error::OnFloor { site: first })?;
            if let Some(lower) = lower.get_mut(direction.index()) {
                *lower = self.numbering.id(below)?;
            }
        }
        Ok(Strip {
            first,
            // Numbered spheres are few enough.
            spheres: u64::try_from(row.i.end - row.i.start).unwrap_or_default(),
            upper: self.numbering.id(first)?,
            lower,
            done: 0,
            contacts: 0,
        })
    }
}

impl Iterator for Touches<'_, '_> {
    type Item = Result<Touch, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let Some(row) = self.row.as_mut().filter(|row| row.done < row.spheres) else {
                let row = self.rows.next()?;
                match self.strip(&row) {
                    Ok(strip) => self.row = Some(strip),
                    Err(error) => return Some(Err(error)),
                }
                continue;
            };
            let Some(direction) = self.directions.get(row.contacts) else {
                (row.done, row.contacts) = (row.done + 1, 0);
                continue;
            };
            row.contacts += 1;
            let lower = row.lower.get(direction.index())?;
            return Some(Ok(Touch {
                upper: row.upper + row.done,
                lower: lower + row.done,
                site: Site {
                    i: row.first.i + i128::from(row.done),
                    ..row.first
                },
                direction: *direction,
            }));
        }
    }
}

/// The contacts of a pile with their forces in f₀, exactly.
pub(super) fn contacts<'a>(
    packing: &Packing<'a>,
    numbering: &'a Numbering<'a>,
) -> Result<impl Iterator<Item = Result<(Touch, BigRational), Error>> + use<'a>, Error> {
    let forces = packing.forces().contacts(Selection::All)?;
    let contacts = Touches::new(numbering)?.zip(forces);
    Ok(contacts.map(|(touch, force)| Ok((touch?, force?.force))))
}

/// How many distinct forces are kept.
const KEPT: usize = 1 << 15;

/// Contact forces, each distinct one made into a `V` once: of a straight pile there are few, of any other those of a
/// layer repeat by symmetry.
pub(super) struct Forces<'a, 'p, V> {
    packing: &'a Packing<'p>,
    make: fn(force: f64, on_upper: [f64; 3]) -> V,
    /// By the sign of the step, and the direction.
    made: [[HashMap<Multiple, V>; 3]; 2],
}

impl<'a, 'p, V> Forces<'a, 'p, V> {
    pub(super) fn new(packing: &'a Packing<'p>, make: fn(f64, [f64; 3]) -> V) -> Self {
        let made = [(); 2].map(|()| [(); 3].map(|()| HashMap::new()));
        Self {
            packing,
            make,
            made,
        }
    }

    /// The force of a contact, from its multiple of f₀.
    pub(super) fn of(&mut self, touch: &Touch, multiple: BigRational) -> Result<&V, Error> {
        let sign = self.packing.pile().shape().sign_below(touch.site.k);
        let [plus, minus] = &mut self.made;
        let of_sign = if sign == Some(Sign::Minus) {
            minus
        } else {
            plus
        };
        let [alpha, beta, gamma] = of_sign;
        let made = match touch.direction {
            Direction::Alpha => alpha,
            Direction::Beta => beta,
            Direction::Gamma => gamma,
        };
        if made.len() >= KEPT {
            made.clear();
        }
        match made.entry(Multiple(multiple)) {
            Entry::Occupied(made) => Ok(made.into_mut()),
            Entry::Vacant(place) => {
                let packing = self.packing;
                let multiple = &place.key().0;
                let quantity = "a contact force";
                let force = nearest(&packing.magnitude(multiple), quantity)?;
                let [x, y, z] = packing.vector(touch.site, touch.direction, multiple)?;
                let vector = [
                    nearest(&x, quantity)?,
                    nearest(&y, quantity)?,
                    nearest(&z, quantity)?,
                ];
                Ok(place.insert((self.make)(force, vector)))
            }
        }
    }
}

/// A rational in lowest terms, hashed as it is written: `Ratio` hashes by its continued fraction.
#[derive(PartialEq, Eq)]
struct Multiple(BigRational);

impl Hash for Multiple {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0.numer().hash(state);
        self.0.denom().hash(state);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Pile;
    use crate::geometry::Spacing;

    #[test]
    fn a_long_row_takes_no_more_memory() {
        let pile = Pile::triangular(2).unwrap();
        let spacing = Spacing::new(BigRational::new(6.into(), 5.into())).unwrap();
        let packing = Packing::new(&pile, &spacing).unwrap();
        let mut centres = Centres::new(&packing);
        // As after a row of so many spheres.
        centres.rounded = (1..).map(|place| (-place, 0.0)).take(KEPT_PLACES).collect();
        let site = Site { i: 1, j: 0, k: 1 };
        assert_eq!(centres.of(site).unwrap()[1].to_string(), "1.2");
        assert!(centres.rounded.len() <= KEPT_PLACES);
    }
}
