//! Forces and places of a pile, of which each distinct one is made once: rounded, or as its text.
//!
//! A straight pile has few distinct forces, and in any other those of a layer repeat by symmetry. Along a row but one
//! coordinate changes, and all rows share its values.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::hash::{Hash, Hasher};

use num_rational::BigRational;

use crate::lattice::{Dimension, Direction, Sign, Site};
use crate::scalar::Surd;
use crate::{Error, Packing};

/// How many forces of one direction are kept.
const KEPT_FORCES: usize = 1 << 15;

/// How many coordinates along rows are kept: enough for 20,000 layers of spheres under one.
const KEPT_PLACES: usize = 1 << 16;

/// What is made of rationals, once of each.
pub(crate) struct Distinct<V>(HashMap<Multiple, V>);

impl<V> Distinct<V> {
    pub(crate) fn new() -> Self {
        Self(HashMap::new())
    }

    /// What `make` makes of a number, or made of it before.
    pub(crate) fn of(
        &mut self,
        number: BigRational,
        make: impl FnOnce(&BigRational) -> Result<V, Error>,
    ) -> Result<&V, Error> {
        if self.0.len() >= KEPT_FORCES {
            self.0.clear();
        }
        match self.0.entry(Multiple(number)) {
            Entry::Occupied(made) => Ok(made.into_mut()),
            Entry::Vacant(place) => {
                let made = make(&place.key().0)?;
                Ok(place.insert(made))
            }
        }
    }
}

/// A rational in lowest terms, hashed by its two integers: `Ratio` hashes by its continued fraction.
#[derive(PartialEq, Eq)]
struct Multiple(BigRational);

impl Hash for Multiple {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0.numer().hash(state);
        self.0.denom().hash(state);
    }
}

/// Contact forces in SI, each distinct one made into a `V` by `M` from its magnitude and its vector on the upper
/// sphere.
pub(crate) struct Forces<'p, V, M> {
    packing: Packing<'p>,
    make: M,
    /// By the sign of the step, and the direction.
    made: [[Distinct<V>; 3]; 2],
}

impl<'p, V, M: Fn(&Surd, &[Surd; 3]) -> Result<V, Error>> Forces<'p, V, M> {
    pub(crate) fn new(packing: &Packing<'p>, make: M) -> Self {
        Self {
            packing: packing.clone(),
            make,
            made: [(); 2].map(|()| [(); 3].map(|()| Distinct::new())),
        }
    }

    /// The force between a sphere and that below it, from its multiple of f₀.
    pub(crate) fn of(
        &mut self,
        site: Site,
        direction: Direction,
        multiple: BigRational,
    ) -> Result<&V, Error> {
        let Self {
            packing,
            make,
            made: [plus, minus],
        } = self;
        let made = match packing.pile().shape().sign_below(site.k) {
            Some(Sign::Minus) => minus,
            _ => plus,
        };
        by_direction(made, direction).of(multiple, |multiple| {
            let vector = packing.vector(site, direction, multiple)?;
            make(&packing.magnitude(multiple), &vector)
        })
    }
}

/// Centres of spheres, and points of contact below them, each distinct coordinate made into a `V` by `M`.
pub(crate) struct Places<'p, V, M> {
    packing: Packing<'p>,
    make: M,
    /// The coordinate that changes along rows: 0 or 1.
    along: usize,
    centres: Coordinates<V>,
    /// By direction.
    points: [Coordinates<V>; 3],
}

/// The coordinates of centres, or of the points of contact in one direction.
struct Coordinates<V> {
    row: Option<RowPlace<V>>,
    /// The coordinate along rows by the sign of the step below and 2i + j less the shift of the layer: in all of the pile
    /// it is the same multiple of the distance of two neighbours.
    along: HashMap<(bool, i128), V>,
}

/// What the spheres of a row have in common.
struct RowPlace<V> {
    k: i128,
    j: i128,
    /// The coordinates, of which that along the row counts for nothing.
    common: [V; 3],
    shift: i128,
}

impl<'p, V: Clone, M: Fn(&Surd) -> Result<V, Error>> Places<'p, V, M> {
    pub(crate) fn new(packing: &Packing<'p>, make: M) -> Self {
        Self {
            along: match packing.pile().dimension() {
                Dimension::Two => 0,
                Dimension::Three => 1,
            },
            packing: packing.clone(),
            make,
            centres: Coordinates::new(),
            points: [(); 3].map(|()| Coordinates::new()),
        }
    }

    /// The centre of a sphere. Spheres that follow each other in a row are found fastest.
    pub(crate) fn centre(&mut self, site: Site) -> Result<[V; 3], Error> {
        let packing = &self.packing;
        let exact = || packing.position(site);
        // Centres do not depend on the step below.
        let key = (false, site);
        self.centres.of(key, packing, self.along, &self.make, exact)
    }

    /// Where a sphere touches that below it.
    pub(crate) fn point(&mut self, site: Site, direction: Direction) -> Result<[V; 3], Error> {
        let packing = &self.packing;
        let exact = || packing.contact_point(site, direction);
        let minus = packing.pile().shape().sign_below(site.k) == Some(Sign::Minus);
        let points = by_direction(&mut self.points, direction);
        points.of((minus, site), packing, self.along, &self.make, exact)
    }
}

impl<V: Clone> Coordinates<V> {
    fn new() -> Self {
        Self {
            row: None,
            along: HashMap::new(),
        }
    }

    fn of(
        &mut self,
        (minus, Site { i, j, k }): (bool, Site),
        packing: &Packing<'_>,
        along: usize,
        make: impl Fn(&Surd) -> Result<V, Error>,
        exact: impl Fn() -> Result<[Surd; 3], Error>,
    ) -> Result<[V; 3], Error> {
        let reached = self.row.take().filter(|row| (row.k, row.j) == (k, j));
        let row = if let Some(row) = reached {
            row
        } else {
            let [x, y, z] = exact()?;
            RowPlace {
                k,
                j,
                common: [make(&x)?, make(&y)?, make(&z)?],
                shift: j - packing.pile().shape().shift_from_origin(k),
            }
        };
        let mut place = row.common.clone();
        let key = (minus, 2 * i + row.shift);
        self.row = Some(row);
        let coordinate = if let Some(made) = self.along.get(&key) {
            made.clone()
        } else {
            let [x, y, _] = exact()?;
            let made = make(if along == 0 { &x } else { &y })?;
            // One row may be as long as the pile has spheres.
            if self.along.len() >= KEPT_PLACES {
                self.along.clear();
            }
            self.along.insert(key, made.clone());
            made
        };
        if let Some(place) = place.get_mut(along) {
            *place = coordinate;
        }
        Ok(place)
    }
}

/// That of a direction.
fn by_direction<V>([alpha, beta, gamma]: &mut [V; 3], direction: Direction) -> &mut V {
    match direction {
        Direction::Alpha => alpha,
        Direction::Beta => beta,
        Direction::Gamma => gamma,
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
        let mut places = Places::new(&packing, |x| Ok(x.to_string()));
        // As after a row of so many spheres.
        let row = (1..).map(|place| ((false, -place), String::new()));
        places.centres.along = row.take(KEPT_PLACES).collect();
        let site = Site { i: 1, j: 0, k: 1 };
        assert_eq!(places.centre(site).unwrap()[1], "6/5");
        assert!(places.centres.along.len() <= KEPT_PLACES);
    }
}
