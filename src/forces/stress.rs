//! The stress of each sphere, from its contact forces.

use alloc::vec::Vec;
use core::iter::zip;

use num_traits::Zero;

use super::walk::Source;
use super::{Answers, Forces};
use crate::Error;
use crate::each::Each;
use crate::engine::{LineForces, LineSelection, Quantity, numerators, to_scalar};
use crate::geometry::{Vector, square_across};
use crate::lattice::{Axis, Direction, HorizontalContact, Row, Site};
use crate::scalar::{Algebra, Numerators, Ring};
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
        let lines = &self.lines;
        let above = self.received(self.pile.shape().check(site)?, LineSelection::All)?;
        let below = (site.k != self.bottom()).then(|| {
            let above = above.clone();
            lines.contacts(lines.to_below(site, above, self.meter))
        });
        let above = lines.contacts(above)?;
        lines.stress(site, &lines.square_across(), above, below.transpose()?)
    }

    /// Iterates over the [`stress`](Self::stress) of the spheres of a part of the pile, in row order.
    ///
    /// By a sweep, the intervals of forces from above may be 25/9 as wide in a layer at which the sign changes, because
    /// the half-turn is undone there. They still contain the exact forces.
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
        Answers::new(self, rows, (Quantity::Contacts, 1), Source::stresses_in)
    }
}

impl<T: Algebra> Source<'_, T> {
    /// Returns the stress of each sphere of a piece of a row. A sweep must be at the layer of the row.
    fn stresses_in(&self, piece: &Row) -> Vec<Result<[T; 6], Error>> {
        let Self {
            lines,
            engine,
            meter,
        } = self;
        let across2 = lines.square_across();
        let of_site = |site, above, below: Option<_>| {
            let below = below.map(|below| lines.contacts(below?)).transpose()?;
            lines.stress(site, &across2, lines.contacts(above?)?, below)
        };
        if piece.k + 1 == lines.shape.layers() {
            let above = engine.received_in(lines, piece, *meter);
            let stress = |(site, above)| of_site(site, above, None);
            return zip(piece.clone(), above).map(stress).collect();
        }
        let [above, below] = engine.received_and_transmitted_in(lines, piece, *meter);
        let stress = |(site, (above, below))| of_site(site, above, Some(below));
        zip(piece.clone(), zip(above, below)).map(stress).collect()
    }
}

impl<T: Algebra> LineForces<'_, T> {
    /// Returns 4cos²φ and 1, over one denominator.
    fn square_across(&self) -> [T::Numerator; 2] {
        let ([across2], one) = T::Numerator::of(&[square_across(self.pile.sin_phi())]);
        [across2, one]
    }

    /// Returns the stress of a sphere, from its forces from above, and from those to below unless it is on the floor.
    fn stress(
        &self,
        site: Site,
        [across2, one]: &[T::Numerator; 2],
        above: [T; 3],
        below: Option<[T; 3]>,
    ) -> Result<[T; 6], Error> {
        let (pile, k) = (&self.pile, site.k);
        let below = below.into_iter().flatten();
        let sloping = zip(above, self.directions_above(k));
        let sloping = sloping.chain(zip(below, self.directions_below(k)));
        let horizontal = pile.loading.pushes(site).map(|_| horizontal_contacts(site));
        let horizontal = horizontal.into_iter().flatten().map(|contact| {
            let [a, b] = contact.axis.ends().each(Direction::index);
            let along = self.directions[b].clone() - &self.directions[a];
            (T::from_rational(&pile.horizontal_force(contact)), along)
        });
        // At most three contacts above, three below and six beside the sphere.
        let mut contacts = sloping.chain(horizontal);
        let mut along = Vec::with_capacity(12);
        let forces = [(); 12].map(|()| {
            let (force, direction) = contacts.next()?;
            along.push(dyad(&direction));
            Some(force)
        });
        // A place without a contact has no force, and no direction either.
        let forces = forces.map(|force| force.unwrap_or_else(T::zero));
        let (forces, scale) = numerators(forces);
        let mut sums = [(); 6].map(|()| T::Numerator::zero());
        for (force, along) in zip(&forces, along) {
            for (sum, part) in zip(&mut sums, along) {
                *sum = part * force + &*sum;
            }
        }
        let directions2 = self.direction_scale.clone() * &self.direction_scale;
        let unit = scale * &self.increment_sum * &directions2 * one;
        let part = |sum: T::Numerator, factor| {
            to_scalar("a stress", sum * &self.sum_scale * factor, &unit)
        };
        let [xx, yy, zz, xy, xz, yz] = sums;
        Ok([
            part(xx, one)?,
            part(yy, across2)?,
            part(zz, one)?,
            part(xy, one)?,
            part(xz, one)?,
            part(yz, one)?,
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
