//! What is asked of each pile, in any scalar: contact forces and forces on the floor, in pile units.

use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::scalar::Algebra;
use cannonpile::shape::Selection;
use cannonpile::{Error, Pile};

/// Three numbers about a sphere.
#[derive(Clone, Debug)]
pub struct OfSphere<T> {
    /// The sphere.
    pub site: Site,
    /// The numbers.
    pub values: [T; 3],
}

/// The answers of one scalar, sphere by sphere, the same spheres for each.
#[derive(Clone, Debug)]
pub struct Forces<T> {
    /// Along α, β and γ below a sphere, in f₀.
    pub contacts: Vec<OfSphere<T>>,
    /// Normal, and the shears along x and y.
    pub floor: Vec<OfSphere<T>>,
    /// Of the spheres above the floor that are looked at, in 2R and the symbolic basis.
    pub positions: Vec<OfSphere<T>>,
}

impl<T: Clone> Forces<T> {
    /// Every number, changed in one way.
    pub fn map<U>(self, image: impl Fn(T) -> U) -> Forces<U> {
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

/// How many spheres of a swept layer are looked at, at most.
const SAMPLE: usize = 120;

impl<T: Algebra> Forces<T> {
    /// Of a straight pile in closed form, in corners, middles and fixed places of the top, the middle and the bottom;
    /// of any other by a sweep, all along the middle row of the last two layers and perhaps some way into the next.
    pub fn of(pile: &Pile) -> Result<Self, Error> {
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

/// How many spheres of a layer lie before its middle row, and how far apart to look in that row.
fn middle_row(pile: &Pile, layer: Selection) -> Result<(usize, usize), Error> {
    let lengths: Vec<usize> = pile
        .rows(layer)?
        .map(|row| usize::try_from(row.i.end - row.i.start).unwrap_or(0))
        .collect();
    let middle = lengths.len() / 2;
    let length = lengths.get(middle).copied().unwrap_or(0);
    Ok((lengths[..middle].iter().sum(), length / SAMPLE + 1))
}

/// Corners, the middles between them, and some places between.
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
