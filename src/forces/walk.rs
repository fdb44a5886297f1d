//! The forces of consecutive spheres, from the engine that a plan selects.

use alloc::vec::{IntoIter, Vec};
use core::iter::FusedIterator;

use super::{ContactForce, FloorForce, Forces};
use crate::Error;
use crate::each::Each;
use crate::engine::{Engine, LineForces, Meter, Plan, Quantity};
use crate::lattice::Row;
use crate::scalar::Algebra;
use crate::shape::{Rows, Selection, exact_hint};

/// The computation of forces for some rows of a pile, from the top down.
#[derive(Clone, Debug)]
pub(super) struct Source<'p, T: Algebra> {
    pub(super) lines: LineForces<'p, T>,
    pub(super) engine: Engine<'p, T>,
    pub(super) meter: Meter<'p>,
}

impl<'p, T: Algebra> Source<'p, T> {
    pub(super) fn new(forces: &Forces<'p, T>, rows: &Rows<'_>, plan: &Plan) -> Result<Self, Error> {
        Ok(Self {
            lines: forces.lines.clone(),
            engine: Engine::new(plan, rows, &forces.lines)?,
            meter: forces.meter,
        })
    }

    /// Returns the best number of spheres of a row to compute at once.
    fn sites_at_once(&self) -> i128 {
        self.engine.sites_at_once(&self.lines)
    }

    /// Returns the force on the floor of each sphere of a piece of a bottom row. A sweep must be at the bottom layer.
    pub(super) fn on_floor_in(&self, piece: &Row) -> Vec<Result<FloorForce<T>, Error>> {
        let above = self.engine.received_in(&self.lines, piece, self.meter);
        let floor = |(site, above): (_, Result<_, _>)| self.lines.floor(site, &above?);
        piece.clone().into_iter().zip(above).map(floor).collect()
    }

    /// Returns the contact forces of each sphere of a piece of a row with the spheres below it. A sweep must be at the
    /// layer of the row.
    pub(super) fn contacts_in(&self, piece: &Row) -> Vec<Result<ContactForce<T>, Error>> {
        let directions = self.lines.shape.dimension().directions();
        let below = self.engine.transmitted_in(&self.lines, piece, self.meter);
        let mut contacts = Vec::with_capacity(directions.len() * below.len());
        for (site, below) in piece.clone().into_iter().zip(below) {
            let forces = match below.and_then(|below| self.lines.contacts(below)) {
                Ok(forces) => forces.each(Ok),
                Err(error) => [(); 3].each(|()| Err(error.clone())),
            };
            contacts.extend(directions.iter().zip(forces).map(|(&direction, force)| {
                let force = force?;
                Ok(ContactForce {
                    site,
                    direction,
                    force,
                })
            }));
        }
        contacts
    }
}

impl<'p, T: Algebra> Forces<'p, T> {
    /// Iterates over the contact forces of a part of the pile in row order, in f₀. The contacts of a sphere are those
    /// with its supports, so a sphere on the floor has none.
    ///
    /// # Errors
    /// [`Error::SiteOutside`], [`Error::LayerOutside`]; [`Error::TooLarge`] if a layer does not fit in memory and
    /// depends on too many spheres at the sign changes above it.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let mut total = 0.0;
    /// for contact in pile.forces::<f64>().contacts(Selection::All)? {
    ///     total += contact?.force;
    /// }
    /// assert_eq!(total, 1485.0);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn contacts(&self, part: Selection) -> Result<Contacts<'p, T>, Error> {
        let rows = self.pile.rows(part)?.off_the_floor();
        let by_site = self.pile.dimension().directions().len();
        Answers::new(
            self,
            rows,
            (Quantity::Contacts, by_site),
            Source::contacts_in,
        )
    }

    /// Iterates over the forces of bottom spheres on the floor, in row order.
    ///
    /// # Errors
    /// [`Error::NotOnFloor`] for a part outside the bottom layer; otherwise as for [`contacts`](Self::contacts).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let base = pile.forces::<f64>().base(Selection::Base)?;
    /// let base: Result<Vec<_>, _> = base.collect();
    /// assert!(base?.iter().all(|force| force.normal == 4.0));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn base(&self, part: Selection) -> Result<FloorForces<'p, T>, Error> {
        let rows = self.pile.rows(part)?;
        Answers::new(self, rows, (Quantity::Floor, 1), Source::on_floor_in)
    }
}

/// A function that computes the forces of a piece of a row, sphere by sphere.
type Compute<'p, T, A> = fn(&Source<'p, T>, &Row) -> Vec<Result<A, Error>>;

/// An iterator over the forces of a part of a pile, in row order: contact forces ([`Contacts`](crate::Contacts)) or
/// forces on the floor ([`FloorForces`](crate::FloorForces)).
///
/// An item is an error if the scalar overflows. The iterator computes several spheres of a row in one batch.
#[derive(Clone, Debug)]
#[must_use = "iterators are lazy and do nothing unless consumed"]
pub struct Answers<'p, T: Algebra, A> {
    plan: Plan,
    source: Source<'p, T>,
    rows: Rows<'p>,
    /// The rest of the current row.
    row: Option<Row>,
    /// The number of items for each sphere.
    by_site: usize,
    compute: Compute<'p, T, A>,
    computed: IntoIter<Result<A, Error>>,
}

/// An iterator over the contact forces of a part of a pile, by sphere in row order. The contacts of a sphere are those
/// with its supports.
///
/// Made by [`Forces::contacts`](crate::Forces::contacts). An item is an error if the scalar overflows.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::shape::Selection;
///
/// let pile = Pile::triangular(10)?;
/// let contacts = pile.forces::<f64>().contacts(Selection::All)?;
/// assert_eq!(contacts.plan().rows, 495_u32.into());
/// assert_eq!(contacts.count(), 495);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub type Contacts<'p, T> = Answers<'p, T, ContactForce<T>>;

/// An iterator over the forces of bottom spheres on the floor, in row order.
///
/// Made by [`Forces::base`](crate::Forces::base). An item is an error if the scalar overflows.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::shape::Selection;
///
/// let pile = Pile::triangular(10)?;
/// let base: Vec<_> = pile.forces::<f64>().base(Selection::Base)?.collect::<Result<_, _>>()?;
/// assert!(base.iter().all(|force| force.normal == 4.0));
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub type FloorForces<'p, T> = Answers<'p, T, FloorForce<T>>;

impl<'p, T: Algebra, A> Answers<'p, T, A> {
    pub(super) fn new(
        forces: &Forces<'p, T>,
        rows: Rows<'p>,
        (quantity, by_site): (Quantity, usize),
        compute: Compute<'p, T, A>,
    ) -> Result<Self, Error> {
        let mut plan = forces.lines.plan(&rows, quantity, forces.method)?;
        plan.rows = rows.site_count() * by_site;
        Ok(Self {
            source: Source::new(forces, &rows, &plan)?,
            plan,
            rows,
            row: None,
            by_site,
            compute,
            computed: Vec::new().into_iter(),
        })
    }

    /// Returns the plan of the forces: the method, and an upper bound on its cost.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Method, Pile};
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let contacts = pile.forces::<f64>().contacts(Selection::Layer(3))?;
    /// assert_eq!(contacts.plan().method, Method::Closed);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Returns the items of a piece of a row, or an error in place of each item.
    fn answers(&mut self, piece: &Row) -> Vec<Result<A, Error>> {
        let Source { engine, meter, .. } = &mut self.source;
        match engine.go_down_to(piece.k, *meter) {
            Ok(()) => (self.compute)(&self.source, piece),
            Err(error) => {
                let refused = |_| (0..self.by_site).map(|_| Err(error.clone()));
                piece.clone().into_iter().flat_map(refused).collect()
            }
        }
    }
}

impl<T: Algebra, A> Iterator for Answers<'_, T, A> {
    type Item = Result<A, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if let Some(answer) = self.computed.next() {
                self.source.meter.answer(1);
                return Some(answer);
            }
            let mut row = match self.row.take() {
                Some(row) => row,
                None => self.rows.next()?,
            };
            let end = row.i.end.min(row.i.start + self.source.sites_at_once());
            let i = row.i.start..end;
            row.i.start = end;
            self.computed = self.answers(&Row { i, ..row }).into_iter();
            self.row = Some(row).filter(|row| !row.i.is_empty());
        }
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let row = self.row.iter().map(|row| row.clone().into_iter());
        let in_row = row.map(|sites| sites.remaining());
        let sites = in_row.fold(self.rows.site_count(), |sites, row| sites + row);
        exact_hint(&(sites * self.by_site + self.computed.len()))
    }
}

impl<T: Algebra, A> FusedIterator for Answers<'_, T, A> {}
