//! The tested quantities of each pile, in any scalar: contact forces and forces on the floor, in pile units.

use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::scalar::Algebra;
use cannonpile::shape::Selection;
use cannonpile::{Error, Pile};

/// Three values for a sphere.
#[derive(Clone, Debug)]
pub(crate) struct OfSphere<T> {
    /// The sphere.
    pub(crate) site: Site,
    /// The values.
    pub(crate) values: [T; 3],
}

/// The answers in one scalar, sphere by sphere. The spheres are the same for each scalar.
#[derive(Clone, Debug)]
pub(crate) struct Forces<T> {
    /// The contact forces below a sphere along α, β and γ, in f₀.
    pub(crate) contacts: Vec<OfSphere<T>>,
    /// The normal force, and the shear along x and y.
    pub(crate) floor: Vec<OfSphere<T>>,
    /// The positions of the selected spheres above the bottom layer, in 2R and the symbolic basis.
    pub(crate) positions: Vec<OfSphere<T>>,
}

impl<T: Clone> Forces<T> {
    /// Applies a function to every value.
    pub(crate) fn map<U>(self, image: impl Fn(T) -> U) -> Forces<U> {
        let of = |spheres: Vec<OfSphere<T>>| {
            let mapped = spheres
                .into_iter()
                .map(|OfSphere { site, values }| OfSphere {
                    site,
                    values: values.map(&image),
                });
            mapped.collect()
        };
        Forces {
            contacts: of(self.contacts),
            floor: of(self.floor),
            positions: of(self.positions),
        }
    }
}

/// The maximal number of spheres selected in a swept layer.
const SAMPLE: usize = 120;

impl<T: Algebra> Forces<T> {
    /// Computes the forces. For a straight pile it uses the closed form at corners, midpoints and fixed sites of the
    /// top, middle and bottom layers. For any other pile it uses a sweep, at spheres of the middle row of the last two
    /// layers. The spheres may extend into the next row.
    pub(crate) fn of(pile: &Pile) -> Result<Self, Error> {
        if pile.shape().stacking().is_straight() {
            Self::one_by_one(pile)
        } else {
            Self::swept(pile)
        }
    }

    fn one_by_one(pile: &Pile) -> Result<Self, Error> {
        let forces = pile.forces::<T>();
        let floor = pile.layers() - 1;
        let mut layers = vec![0, floor / 3, floor / 2, floor - 1];
        layers.dedup();
        let mut contacts = Vec::new();
        for k in layers {
            for [i, j] in places(&pile.shape().layer(k)?) {
                let site = Site { i, j, k };
                let [a, b, c] = Direction::ALL.map(|along| forces.contact(site, along));
                contacts.push(OfSphere {
                    site,
                    values: [a?, b?, c?],
                });
            }
        }
        let places = places(&pile.shape().base());
        let on_floor = places.into_iter().map(|[i, j]| {
            let force = forces.on_floor(Site { i, j, k: floor })?;
            Ok(OfSphere {
                site: force.site,
                values: [force.normal, force.shear_x, force.shear_y],
            })
        });
        let floor = on_floor.collect::<Result<_, Error>>()?;
        Self::with_positions(&forces, contacts, floor)
    }

    fn swept(pile: &Pile) -> Result<Self, Error> {
        let forces = pile.forces::<T>();
        let part = Selection::Layer(pile.layers() - 2);
        let (before, stride) = middle_row(pile, part)?;
        let mut contacts = Vec::new();
        let mut below = forces.contacts(part)?.skip(3 * before);
        for n in 0..SAMPLE * stride {
            let (Some(a), Some(b), Some(c)) = (below.next(), below.next(), below.next()) else {
                break;
            };
            let (a, b, c) = (a?, b?, c?);
            if n.is_multiple_of(stride) {
                contacts.push(OfSphere {
                    site: a.site,
                    values: [a.force, b.force, c.force],
                });
            }
        }
        let (before, stride) = middle_row(pile, Selection::Base)?;
        let on_floor = forces.base(Selection::Base)?.skip(before);
        let on_floor = on_floor.step_by(stride).take(SAMPLE);
        let on_floor = on_floor.map(|force| {
            let force = force?;
            Ok(OfSphere {
                site: force.site,
                values: [force.normal, force.shear_x, force.shear_y],
            })
        });
        let floor = on_floor.collect::<Result<_, Error>>()?;
        Self::with_positions(&forces, contacts, floor)
    }

    fn with_positions(
        forces: &cannonpile::Forces<'_, T>,
        contacts: Vec<OfSphere<T>>,
        floor: Vec<OfSphere<T>>,
    ) -> Result<Self, Error> {
        let positions = contacts.iter().map(|OfSphere { site, .. }| {
            Ok(OfSphere {
                site: *site,
                values: forces.position(*site)?.into_array(),
            })
        });
        Ok(Self {
            positions: positions.collect::<Result<_, Error>>()?,
            contacts,
            floor,
        })
    }
}

/// The number of spheres in a layer before its middle row, and the stride in that row.
fn middle_row(pile: &Pile, layer: Selection) -> Result<(usize, usize), Error> {
    let lengths: Vec<usize> = pile
        .rows(layer)?
        .map(|row| usize::try_from(row.i.end - row.i.start).unwrap_or(0))
        .collect();
    let middle = lengths.len() / 2;
    let length = lengths.get(middle).copied().unwrap_or(0);
    Ok((lengths[..middle].iter().sum(), length / SAMPLE + 1))
}

/// The corners, the midpoints of all pairs, and some points between.
fn places(region: &Region) -> Vec<[i128; 2]> {
    let corners = region.corners();
    let mut places = Vec::from(corners);
    for [i, j] in corners {
        for [x, y] in corners {
            places.push([i.midpoint(x), j.midpoint(y)]);
            places.push([i + (x - i) / 7, j + (y - j) / 7]);
        }
    }
    places.retain(|[i, j]| region.contains(*i, *j));
    places.sort_unstable();
    places.dedup();
    places
}
