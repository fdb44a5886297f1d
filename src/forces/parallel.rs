//! Parallel iterators of [rayon](https://docs.rs/rayon) over forces: [`Forces::contacts`] and [`Forces::base`] on all
//! cores.
//!
//! The items are those of the serial iterators, and `collect` keeps their order. Each thread takes a part of the rows.
//! A sweep advances layer by layer, and each thread takes a part of each layer. A cancellation by an
//! [`Interrupt`](crate::Interrupt) ends the work of all threads. [`Layers::fill`](crate::Layers::fill) writes many
//! forces into slices faster.
//!
//! # Examples
//! ```
//! use cannonpile::shape::Selection;
//! use cannonpile::{Error, Pile, parallel};
//! use num_rational::BigRational;
//! use rayon::iter::ParallelIterator;
//!
//! let pile = Pile::under("hexagon:3".parse()?, "+-+-".parse()?)?;
//! let forces = pile.forces::<BigRational>();
//! let contacts: Result<Vec<_>, Error> = parallel::contacts(&forces, Selection::All)?.collect();
//! let serial: Result<Vec<_>, Error> = forces.contacts(Selection::All)?.collect();
//! assert_eq!(contacts, serial);
//! # Ok::<(), Error>(())
//! ```

use alloc::vec::Vec;
use core::ops::Range;

use rayon::iter::plumbing::{Folder, Reducer, UnindexedConsumer};
use rayon::iter::{ParallelIterator, split};

use super::walk::Walk;
use super::{ContactForce, FloorForce, Forces};
use crate::Error;
use crate::engine::{Meter, Quantity, check_interrupt, current_request, within};
use crate::lattice::Row;
use crate::scalar::Algebra;
use crate::shape::{Part, Rows, Selection, Shape};

/// Returns a parallel iterator over the contact forces of a part of the pile, with the items of [`Forces::contacts`].
///
/// # Errors
/// As for [`Forces::contacts`].
///
/// # Examples
/// ```
/// use cannonpile::shape::Selection;
/// use cannonpile::{Pile, parallel};
/// use rayon::iter::ParallelIterator;
///
/// let pile = Pile::triangular(10)?;
/// let contacts = parallel::contacts(&pile.forces::<f64>(), Selection::All)?;
/// let total = contacts.map(|contact| Ok(contact?.force)).try_reduce(|| 0.0, |a, b| Ok(a + b));
/// assert_eq!(total, Ok::<_, cannonpile::Error>(1485.0));
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn contacts<'p, T: Algebra>(
    forces: &Forces<'p, T>,
    part: Selection,
) -> Result<impl ParallelIterator<Item = Result<ContactForce<T>, Error>> + use<'p, T>, Error> {
    let rows = forces.pile.rows(part)?.off_the_floor();
    Parallel::new(forces, &rows, Quantity::ContactMultiples, Walk::contacts_in)
}

/// Returns a parallel iterator over the forces of bottom spheres on the floor, with the items of [`Forces::base`].
///
/// # Errors
/// As for [`Forces::base`].
///
/// # Examples
/// ```
/// use cannonpile::shape::Selection;
/// use cannonpile::{Pile, parallel};
/// use rayon::iter::ParallelIterator;
///
/// let pile = Pile::triangular(10)?;
/// let base = parallel::base(&pile.forces::<f64>(), Selection::Base)?;
/// assert!(base.all(|force| force.is_ok_and(|force| force.normal == 4.0)));
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn base<'p, T: Algebra>(
    forces: &Forces<'p, T>,
    part: Selection,
) -> Result<impl ParallelIterator<Item = Result<FloorForce<T>, Error>> + use<'p, T>, Error> {
    let rows = forces.pile.rows(part)?;
    Parallel::new(forces, &rows, Quantity::FloorMultiples, Walk::on_floor_in)
}

/// The forces of some rows. `answer` computes them for one piece of a row at a time.
struct Parallel<'p, T: Algebra, A> {
    walk: Walk<'p, T>,
    part: Part<'p>,
    meter: Meter<'p>,
    answer: A,
}

impl<'p, T, I, A> Parallel<'p, T, A>
where
    T: Algebra,
    I: Send,
    A: Fn(&Walk<'p, T>, &Row, Meter<'_>) -> Vec<Result<I, Error>> + Send + Sync,
{
    fn new(
        forces: &Forces<'p, T>,
        rows: &Rows<'p>,
        asked: Quantity,
        answer: A,
    ) -> Result<Self, Error> {
        let plan = forces.plan(rows, asked)?;
        let walk = Walk::new(&plan, rows, &forces.terms)?;
        Ok(Self {
            walk,
            part: Part::of(rows)?,
            meter: forces.meter,
            answer,
        })
    }

    /// Computes the forces of a part. A sweep must be at the layer of the part.
    fn share<C: UnindexedConsumer<Result<I, Error>>>(
        &self,
        part: Part<'p>,
        consumer: C,
    ) -> C::Result {
        let (request, sites) = (current_request(), self.walk.sites_at_once());
        let answers = |piece: &Row| match check_interrupt() {
            Ok(()) => {
                let answers = (self.answer)(&self.walk, piece, self.meter);
                self.meter.answer(answers.len());
                answers
            }
            Err(error) => Vec::from([Err(error)]),
        };
        let parts = split(part, Part::halves).flat_map_iter(|part| {
            let pieces = part.rows().flat_map(|row| row.pieces(sites));
            pieces.flat_map(|piece| within(request.as_ref(), || answers(&piece)))
        });
        parts.drive_unindexed(consumer)
    }

    /// Advances to layer `k`, and computes the forces of a part of it.
    fn layer<C>(&mut self, k: i128, part: Part<'p>, consumer: C) -> C::Result
    where
        C: UnindexedConsumer<Result<I, Error>>,
    {
        match self.walk.go_down_to(k, self.meter) {
            Ok(()) => self.share(part, consumer),
            Err(error) => consumer.into_folder().consume(Err(error)).complete(),
        }
    }

    /// Computes the forces layer after layer. The consumer is split in halves recursively, so the depth of the splits
    /// is logarithmic in the number of layers.
    fn layers<C>(&mut self, shape: &'p Shape, layers: Range<i128>, consumer: C) -> C::Result
    where
        C: UnindexedConsumer<Result<I, Error>>,
    {
        let Range { start, end } = layers;
        if start >= end || consumer.full() {
            return consumer.into_folder().complete();
        }
        if end - start == 1 {
            return self.layer(start, Part::Layers(shape, start..end), consumer);
        }
        let middle = start + (end - start) / 2;
        let (left, reducer) = (consumer.split_off_left(), consumer.to_reducer());
        let before = self.layers(shape, start..middle, left);
        reducer.reduce(before, self.layers(shape, middle..end, consumer))
    }
}

impl<'p, T, I, A> ParallelIterator for Parallel<'p, T, A>
where
    T: Algebra,
    I: Send,
    A: Fn(&Walk<'p, T>, &Row, Meter<'_>) -> Vec<Result<I, Error>> + Send + Sync,
{
    type Item = Result<I, Error>;

    fn drive_unindexed<C: UnindexedConsumer<Self::Item>>(mut self, consumer: C) -> C::Result {
        let part = self.part.clone();
        if !self.walk.is_sweep() {
            return self.share(part, consumer);
        }
        match part {
            Part::Layer(k, _) => self.layer(k, part, consumer),
            Part::Layers(shape, layers) => self.layers(shape, layers, consumer),
        }
    }
}

#[cfg(test)]
mod tests {
    use num_rational::BigRational;

    use super::*;
    use crate::lattice::Site;
    use crate::scalar::{FixedRational, Interval, Polynomial};
    use crate::{Counters, Interrupt, Method, Pile};

    fn piles() -> Vec<Pile> {
        let under = |top: &str, stacking: &str| {
            Pile::under(top.parse().unwrap(), stacking.parse().unwrap()).unwrap()
        };
        let five = || BigRational::from_integer(5.into());
        let loaded = under("hexagon:12,9", "+-++--+-").with_load(Site::new(3, 2, 1), five());
        Vec::from([
            Pile::triangular(25).unwrap(),
            Pile::discs(60).unwrap(),
            under("hexagon:9", "--"),
            loaded.unwrap(),
        ])
    }

    /// Compares the items of the serial and the parallel iterator, for each method that applies, in the current thread
    /// pool.
    fn compare<T: Algebra>() {
        for pile in &piles() {
            let floor = pile.layers() - 1;
            let site = pile.shape().sites().nth(40).unwrap();
            for method in [Method::Closed, Method::Tree, Method::Sweep].map(Some) {
                let forces = pile.forces::<T>();
                let Ok(forces) = forces.with_method(method.unwrap()) else {
                    continue;
                };
                let parts = [Selection::All, Selection::Layer(2), Selection::One(site)];
                for part in parts {
                    let serial: Vec<_> = forces.contacts(part).unwrap().collect();
                    let together: Vec<_> = contacts(&forces, part).unwrap().collect();
                    assert!(together == serial, "{method:?} {part:?}");
                }
                let bottom = pile.sites(Selection::Base).unwrap().last().unwrap();
                let parts = [
                    Selection::Base,
                    Selection::Layer(floor),
                    Selection::One(bottom),
                ];
                for part in parts {
                    let serial: Vec<_> = forces.base(part).unwrap().collect();
                    let together: Vec<_> = base(&forces, part).unwrap().collect();
                    assert!(together == serial, "{method:?} {part:?}");
                }
            }
        }
    }

    fn pool(threads: usize) -> rayon::ThreadPool {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().unwrap()
    }

    #[test]
    fn items_are_the_serial_ones_in_their_order() {
        compare::<f64>();
        for threads in [1, 2, 5] {
            pool(threads).install(|| {
                compare::<f64>();
                compare::<BigRational>();
                compare::<Interval>();
                compare::<FixedRational<i64>>();
            });
        }
    }

    #[test]
    fn a_scalar_of_symbols_is_shared_too() {
        let pile = Pile::triangular(8).unwrap();
        let forces = pile.forces::<Polynomial>();
        let together: Result<Vec<_>, _> = contacts(&forces, Selection::All).unwrap().collect();
        let serial: Result<Vec<_>, _> = forces.contacts(Selection::All).unwrap().collect();
        assert_eq!(together, serial);
    }

    #[test]
    fn refusals_and_overflows_are_the_serial_ones() {
        let pile = Pile::triangular(200).unwrap();
        let forces = pile.forces::<FixedRational<i8>>();
        let together: Vec<_> = contacts(&forces, Selection::All).unwrap().collect();
        let serial: Vec<_> = forces.contacts(Selection::All).unwrap().collect();
        assert!(serial.iter().any(Result::is_err) && together == serial);
        for part in [Selection::Layer(200), Selection::Layer(-1)] {
            assert_eq!(contacts(&forces, part).err(), forces.contacts(part).err());
        }
        assert!(base(&forces, Selection::All).is_err());
        let floor = contacts(&forces, Selection::Base).unwrap();
        assert_eq!(floor.count(), 0);
    }

    /// The pile has 121 layers, too many for a split of the consumer at each layer in turn.
    #[test]
    fn a_first_item_of_a_sweep_is_found() {
        let pile = Pile::under(
            "hexagon:2".parse().unwrap(),
            "+-".repeat(60).parse().unwrap(),
        );
        let pile = pile.unwrap();
        let forces = pile.forces::<f64>().with_method(Method::Sweep).unwrap();
        let is_low = |contact: &Result<ContactForce<f64>, Error>| {
            contact.as_ref().is_ok_and(|contact| contact.site.k >= 110)
        };
        let together = contacts(&forces, Selection::All).unwrap();
        let mut serial = forces.contacts(Selection::All).unwrap();
        assert_eq!(together.find_first(is_low), serial.find(is_low));
    }

    #[test]
    fn all_work_is_counted() {
        let pile = Pile::triangular(30).unwrap();
        let [one, other] = [Counters::default(), Counters::default()];
        let serial = pile.forces::<f64>().with_counters(&one);
        let together = pile.forces::<f64>().with_counters(&other);
        let items = serial.contacts(Selection::All).unwrap().count();
        assert_eq!(contacts(&together, Selection::All).unwrap().count(), items);
        assert_eq!(one.to_string(), other.to_string());
    }

    #[test]
    fn a_request_ends_them_in_every_method() {
        let interrupt = Interrupt::new();
        interrupt.request();
        for pile in &piles() {
            let forces = pile.forces::<BigRational>();
            let all =
                || contacts(&forces, Selection::All)?.try_for_each(|contact| contact.map(drop));
            let bottom = || base(&forces, Selection::Base)?.try_for_each(|force| force.map(drop));
            assert_eq!((all(), bottom()), (Ok(()), Ok(())));
            assert_eq!(interrupt.during(all), Err(Error::Interrupted));
            assert_eq!(interrupt.during(bottom), Err(Error::Interrupted));
        }
        // The request is made while items are computed.
        let (pile, interrupt) = (Pile::triangular(10_i128.pow(30)).unwrap(), Interrupt::new());
        let forces = pile.forces::<f64>();
        let asked = interrupt.during(|| {
            contacts(&forces, Selection::All)?.try_for_each(|contact| {
                interrupt.request();
                contact.map(drop)
            })
        });
        assert_eq!(asked, Err(Error::Interrupted));
    }
}
