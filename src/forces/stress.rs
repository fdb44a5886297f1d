//! The stress of each sphere, from its contact forces.

use alloc::vec::Vec;
use core::iter::zip;

use num_traits::Zero;

use super::terms::{Terms, to_scalar};
use super::walk::RowEngine;
use super::{Answers, Forces};
use crate::Error;
use crate::each::Each;
use crate::engine::{Engine, Layer, LineSelection, Meter, Quantity, SphereForces};
use crate::geometry::{Vector, square_across};
use crate::lattice::{Axis, Direction, HorizontalContact, Row, Site};
use crate::scalar::{Algebra, Ring};
use crate::shape::Selection;

impl<'p, T: Algebra> Forces<'p, T> {
    /// Returns the stress of a sphere times its volume: Vσ = R Σ f ê⊗ê over its contacts, with the normal force f and
    /// the unit vector ê of each contact. Compression is positive, and z points up.
    ///
    /// The components are xx, yy, zz, xy, xz, yz, in units that make them rational:
    ///
    /// | component | unit |
    /// |---|---|
    /// | xx, yy | mgR·sinθ·tanθ |
    /// | zz | mgR·cosθ |
    /// | xy | 2cosφ·mgR·sinθ·tanθ, which is √3·mgR·sinθ·tanθ on an equilateral base |
    /// | xz | mgR·sinθ |
    /// | yz | 2cosφ·mgR·sinθ |
    ///
    /// Horizontal contacts with a [given force](crate::Pile::with_horizontal_force) are included. The floor, weights and
    /// loads are not. The volume V = 4πR³/3 is irrational, so the caller divides by it. LAMMPS' `compute stress/atom` is
    /// −Vσ.
    ///
    /// # Errors
    /// [`Error::SiteOutside`]; [`Error::Overflow`] if the scalar cannot hold a component.
    ///
    /// # Examples
    /// Each of the three contacts of the apex adds mgR·cosθ/3 to zz:
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Site;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let [xx, yy, zz, xy, xz, yz] = pile.forces::<f64>().stress(Site::APEX)?;
    /// assert_eq!([xx, yy, zz], [0.5, 0.5, 1.0]);
    /// assert_eq!([xy, xz, yz], [0.0; 3]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn stress(&self, site: Site) -> Result<[T; 6], Error> {
        let above = self.received(self.pile.shape().check(site)?, LineSelection::All)?;
        let below = (site.k != self.floor()).then(|| {
            let above = above.clone();
            self.terms.lines.to_below(site, above, self.meter)
        });
        self.terms.stress(site, &above, below.as_ref())
    }

    /// Iterates over the [`stress`](Self::stress) of the spheres of a part of the pile, in row order.
    ///
    /// # Errors
    /// As for [`contacts`](Self::contacts).
    ///
    /// # Examples
    /// The contacts below a layer carry the weight of all spheres above, and each contact belongs to two spheres:
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::under(Region::SITE, "+-".parse()?)?;
    /// let mut zz = 0.0;
    /// for stress in pile.forces::<f64>().stresses(Selection::All)? {
    ///     zz += stress?[2];
    /// }
    /// assert!((zz - 2.0 * (1.0 + 4.0)).abs() < 1e-12);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn stresses(&self, part: Selection) -> Result<Answers<'p, T, [T; 6]>, Error> {
        let rows = self.pile.rows(part)?;
        Answers::new(
            self,
            rows,
            (Quantity::ContactMultiples, 1),
            RowEngine::stresses_in,
        )
    }
}

impl<T: Algebra> RowEngine<'_, T> {
    /// Returns the stress of each sphere of a piece of a row. A sweep must be at the layer of the row.
    fn stresses_in(&self, piece: &Row, meter: Meter<'_>) -> Vec<Result<[T; 6], Error>> {
        match self {
            Self::Plain(terms, engine) => terms.stresses_in(engine, piece, meter),
            Self::Exact(terms, engine) => {
                let exact = terms.stresses_in(engine, piece, meter).into_iter();
                exact
                    .map(|stress| Ok(stress?.map(|part| T::from_rational(&part))))
                    .collect()
            }
        }
    }
}

impl<'p, T: Algebra> Terms<'p, T> {
    fn stresses_in<S: Layer<T>>(
        &self,
        engine: &Engine<'p, T, S>,
        piece: &Row,
        meter: Meter<'_>,
    ) -> Vec<Result<[T; 6], Error>> {
        let pile = (&self.lines, &self.system);
        let above = engine.received_in(pile, piece, meter);
        let is_floor = piece.k + 1 == self.system.shape.layers();
        let below: Vec<_> = if is_floor {
            above.iter().map(|_| Ok(None)).collect()
        } else {
            // The work of these spheres is already counted.
            let below = engine.transmitted_in(pile, piece, Meter::NONE);
            below.into_iter().map(|below| below.map(Some)).collect()
        };
        let stress = |(site, (above, below)): (Site, (Result<_, _>, Result<Option<_>, _>))| {
            self.stress(site, &above?, below?.as_ref())
        };
        zip(piece.clone(), zip(above, below)).map(stress).collect()
    }

    /// Returns the stress of a sphere, from its forces from above, and from those to below unless it is on the floor.
    fn stress(
        &self,
        site: Site,
        above: &SphereForces<T>,
        below: Option<&SphereForces<T>>,
    ) -> Result<[T; 6], Error> {
        let Self { lines, system, .. } = self;
        let changes = below.map(|below| below.changes);
        let changes = changes.into_iter().fold(above.changes, Ord::max);
        let mut sums = [(); 6].map(|()| T::Numerator::zero());
        let mut add = |force: T::Numerator, along: &Vector<T::Numerator>| {
            let parts = zip(&mut sums, dyad(along));
            parts.for_each(|(sum, part)| *sum = part * &force + &*sum);
        };
        let above = (above, self.directions_above(site.k));
        let below = below.map(|below| (below, self.directions_below(site.k)));
        for (received, directions) in [above].into_iter().chain(below) {
            for (force, along) in zip(&received.forces, &directions) {
                add(
                    lines.rescaled(force.clone(), received.changes, changes),
                    along,
                );
            }
        }
        if system.loading.pushes(site).is_some() {
            for contact in horizontal_contacts(site) {
                let force = lines.numerator(system.loading.horizontal_force(contact), changes);
                let [a, b] = contact.axis.ends().each(Direction::index);
                add(force, &(self.directions[b].clone() - &self.directions[a]));
            }
        }
        let ([across2], one) = T::numerators(&[square_across(system.sin_phi)]);
        let unit = self.floor_unit(changes) * &self.direction_scale * &one;
        let part = |sum, factor| {
            let sum: T::Numerator = sum * &self.sum_scale * factor;
            to_scalar("a stress", sum, &unit)
        };
        let [xx, yy, zz, xy, xz, yz] = sums;
        Ok([
            part(xx, &one)?,
            part(yy, &across2)?,
            part(zz, &one)?,
            part(xy, &one)?,
            part(xz, &one)?,
            part(yz, &one)?,
        ])
    }
}

/// Returns the products xx, yy, zz, xy, xz, yz of the components of a vector, with z up.
fn dyad<N: Ring>(Vector { x, y, z }: &Vector<N>) -> [N; 6] {
    let product = |a: &N, b: &N| a.clone() * b;
    [
        product(x, x),
        product(y, y),
        product(z, z),
        product(x, y),
        -product(x, z),
        -product(y, z),
    ]
}

/// Returns the contacts of a sphere with its neighbours in a layer: those that it names, and those that name it.
fn horizontal_contacts(site: Site) -> impl Iterator<Item = HorizontalContact> {
    Axis::ALL.into_iter().flat_map(move |axis| {
        let named = HorizontalContact { site, axis };
        let before = named.neighbour().and_then(|next| {
            let [i, j] = [(site.i, next.i), (site.j, next.j)]
                .each(|(own, next)| own.checked_add(own - next));
            Some(Site {
                i: i?,
                j: j?,
                ..site
            })
        });
        let naming = before.map(|site| HorizontalContact { site, axis });
        [named].into_iter().chain(naming)
    })
}
