//! One layer of a pile and its forces.

use alloc::vec::Vec;
use core::fmt;
use core::sync::atomic::{AtomicBool, Ordering};

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};

use super::below::Below;
use super::{Layers, check_lengths};
use crate::engine::{Cells, Engine, Meter, Sweep, Table, check_interrupt, fill_rows, split_front};
use crate::error::bug;
use crate::forces::walk::RowEngine;
use crate::lattice::{Region, Row, Site};
use crate::scalar::{Algebra, Exactness};
use crate::shape::Shape;
use crate::{Error, FloorForce};

/// One layer of a pile and its forces, from [`Layers::next_layer`].
pub struct Layer<'l, 'p, T: Algebra> {
    pub(in crate::forces) layers: &'l Layers<'p, T>,
    pub(super) k: i128,
    pub(in crate::forces) region: Region,
    pub(in crate::forces) spheres: usize,
}

impl<'p, T: Algebra> Layers<'p, T> {
    /// Advances to the next layer of the part and returns it, or `None` after the last layer.
    ///
    /// # Errors
    /// [`Error::TooLarge`] for a layer that does not fit in memory.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::triangular(4)?;
    /// let mut layers = pile.forces::<f64>().layers(Selection::All)?;
    /// let mut spheres = 0;
    /// while let Some(layer) = layers.next_layer()? {
    ///     spheres += layer.sphere_count();
    /// }
    /// assert_eq!(spheres, 20);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn next_layer(&mut self) -> Result<Option<Layer<'_, 'p, T>>, Error> {
        let Some(k) = self.ahead.clone().next() else {
            return Ok(None);
        };
        self.go_down_to(k)?;
        let region = self.shape().layer(k)?;
        let sites = region.site_count();
        let Some(spheres) = sites.to_usize() else {
            return Err(Error::TooLarge {
                quantity: "a layer",
                needed: sites,
                limit: usize::MAX as u64,
                remedy: "ask for one sphere",
            });
        };
        Ok(Some(Layer {
            layers: self,
            k,
            region,
            spheres,
        }))
    }

    /// Calls `fill` for each remaining layer above the floor, with its part of the slices.
    pub(in crate::forces) fn fill_each<V>(
        &mut self,
        slices: [&mut [V]; 3],
        fill: impl Fn(&Layer<'_, 'p, T>, [&mut [V]; 3]) -> Result<(), Error>,
    ) -> Result<(), Error> {
        check_lengths(self.slice_len()?, &slices)?;
        let mut rest = slices;
        self.ahead = self.above_the_floor();
        while let Some(layer) = self.next_layer()? {
            let front = split_front(&mut rest, layer.sphere_count())?;
            fill(&layer, front)?;
        }
        Ok(())
    }
}

impl Layer<'_, '_, BigRational> {
    /// Returns the denominator of the forces below the layer.
    pub(in crate::forces) fn denominator(&self) -> BigInt {
        self.layers
            .denominator(self.shape().changes_above(self.k + 1))
    }

    /// Applies `value` to the numerators of the forces below each sphere, and writes the results into slices.
    pub(in crate::forces) fn fill_numerators<V>(
        &self,
        slices: [&mut [V]; 3],
        value: impl Fn([BigInt; 3]) -> Result<[V; 3], Error>,
    ) -> Result<(), Error> {
        check_lengths(self.spheres, &slices)?;
        self.check_above_the_floor()?;
        let mut rest = slices;
        for row in self.region.rows(self.k) {
            check_interrupt()?;
            let below = self.layers.transmitted_in(&row)?;
            let [a, b, c] = split_front(&mut rest, below.len())?;
            for (forces, ((a, b), c)) in below.into_iter().zip(a.iter_mut().zip(b).zip(c)) {
                [*a, *b, *c] = value(forces.forces)?;
            }
        }
        Ok(())
    }
}

impl<T: Algebra> Layer<'_, '_, T> {
    /// Returns the number of the layer, counted from 0 at the top.
    #[must_use]
    pub fn k(&self) -> i128 {
        self.k
    }

    /// Returns the number of spheres in the layer, which is the length of each slice to fill.
    #[must_use]
    pub fn sphere_count(&self) -> usize {
        self.spheres
    }

    /// Returns whether the layer is the bottom layer, which has no contacts below it.
    #[must_use]
    pub fn is_floor(&self) -> bool {
        self.k == self.shape().layers() - 1
    }

    /// Returns the forces of a sphere of this layer on the spheres below, by direction, in f₀. The force along γ is
    /// zero for discs.
    ///
    /// # Errors
    /// [`Error::SiteOutside`]; [`Error::OtherLayer`] for a sphere of another layer; [`Error::OnFloor`];
    /// [`Error::Overflow`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::{Region, Site};
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::under(Region::SITE, "+-+".parse()?)?;
    /// let mut layers = pile.forces::<BigRational>().layers(Selection::Layer(2))?;
    /// let layer = layers.next_layer()?.expect("layer 2 is asked for");
    /// let forces = layer.to_below(Site { i: 0, j: 0, k: 2 })?;
    /// assert_eq!(forces.map(|force| force.to_string()), ["5/3"; 3]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn to_below(&self, site: Site) -> Result<[T; 3], Error> {
        self.check(site)?;
        if self.is_floor() {
            return Err(Error::OnFloor { site });
        }
        self.transmitted(site)
    }

    /// Returns the force on the floor of a sphere of this layer, which must be the bottom layer.
    ///
    /// # Errors
    /// [`Error::SiteOutside`]; [`Error::NotOnFloor`]; [`Error::Overflow`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Site;
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let mut layers = pile.forces::<f64>().layers(Selection::Base)?;
    /// let floor = layers.next_layer()?.expect("every pile has a floor");
    /// assert_eq!(floor.on_floor(Site { i: 0, j: 0, k: 9 })?.normal, 4.0);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn on_floor(&self, site: Site) -> Result<FloorForce<T>, Error> {
        self.check(site)?;
        if !self.is_floor() {
            let floor = self.shape().layers() - 1;
            return Err(Error::NotOnFloor { site, floor });
        }
        let Layers { walk, meter, .. } = self.layers;
        one(walk.on_floor_in(&row_of(site), *meter))
    }

    /// Writes the forces below the layer into slices, one slice for each direction, row after row, in f₀. The forces
    /// along γ are zero for discs.
    ///
    /// # Errors
    /// [`Error::Length`] for a slice whose length is not [`sphere_count`](Self::sphere_count); [`Error::OnFloor`];
    /// [`Error::Overflow`] if the scalar cannot hold a force. After an overflow the slices may be partly written.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::under(Region::SITE, "+-+".parse()?)?;
    /// let mut layers = pile.forces::<f64>().layers(Selection::Layer(1))?;
    /// let layer = layers.next_layer()?.expect("layer 1 is asked for");
    /// let [mut alpha, mut beta, mut gamma] = [[0.0; 3]; 3];
    /// layer.fill([&mut alpha, &mut beta, &mut gamma])?;
    /// // Each of the three spheres transmits the 1 f₀ from the apex as 2/3, 2/3 and −1/3 f₀, and adds 1 f₀ to each
    /// // line.
    /// assert!((alpha[0] - 2.0 / 3.0).abs() < 1e-15);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill(&self, slices: [&mut [T]; 3]) -> Result<(), Error> {
        check_lengths(self.spheres, &slices)?;
        self.check_above_the_floor()?;
        let Layers {
            table, walk, meter, ..
        } = self.layers;
        if let Some(table) = table {
            return table.fill(self.k..self.k + 1, slices);
        }
        if let RowEngine::Plain(_, Engine::Sweep(sweep)) = walk {
            return self.fill_from(sweep, slices);
        }
        self.fill_by_rows(slices, |row| walk.transmitted_in(row, *meter))
    }

    /// Writes the forces of each row, from `answers`, into slices.
    fn fill_by_rows(
        &self,
        [a, b, c]: [&mut [T]; 3],
        answers: impl Fn(&Row) -> Vec<Result<[T; 3], Error>>,
    ) -> Result<(), Error> {
        let mut out = a.iter_mut().zip(b).zip(c);
        for row in self.region.rows(self.k) {
            check_interrupt()?;
            for (values, ((a, b), c)) in answers(&row).into_iter().zip(&mut out) {
                [*a, *b, *c] = values?;
            }
        }
        Ok(())
    }

    /// Writes the values of one sphere into slices that hold the whole layer.
    pub(in crate::forces) fn put_at<V>(
        &self,
        site: Site,
        values: [V; 3],
        slices: [&mut [V]; 3],
    ) -> Result<(), Error> {
        let place = self.region.sites_before(site.i, site.j).to_usize();
        let place = place.filter(|place| *place < self.spheres);
        let place = place.ok_or_else(|| bug("a loaded sphere has a place in its layer"))?;
        for (slice, value) in slices.into_iter().zip(values) {
            // In bounds, because the slices are as long as the layer.
            slice[place] = value;
        }
        Ok(())
    }

    /// Writes the forces of the layer into slices, from a table.
    pub(in crate::forces) fn fill_from_table<V: Clone + Send + Sync>(
        &self,
        table: &Table<V>,
        slices: [&mut [V]; 3],
    ) -> Result<(), Error> {
        check_lengths(self.spheres, &slices)?;
        self.check_above_the_floor()?;
        table.fill(self.k..self.k + 1, slices)
    }

    /// Writes the forces of the bottom layer on the floor into slices, row after row: normal in mg, shear_x in mg·tanθ
    /// and shear_y in 2cosφ·mg·tanθ.
    ///
    /// # Errors
    /// [`Error::Length`]; [`Error::NotOnFloor`] for another layer; [`Error::Overflow`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let mut layers = pile.forces::<f64>().layers(Selection::Base)?;
    /// let floor = layers.next_layer()?.expect("every pile has a floor");
    /// let [mut normal, mut shear_x, mut shear_y] = [[0.0; 55]; 3];
    /// floor.fill_base([&mut normal, &mut shear_x, &mut shear_y])?;
    /// assert_eq!((normal, shear_x[0], shear_y[0]), ([4.0; 55], -1.5, -1.5));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill_base(&self, slices: [&mut [T]; 3]) -> Result<(), Error> {
        check_lengths(self.spheres, &slices)?;
        self.check_on_the_floor()?;
        let Layers { walk, meter, .. } = self.layers;
        self.fill_by_rows(slices, |row| {
            let forces = walk.on_floor_in(row, *meter).into_iter();
            let components = |force: Result<FloorForce<T>, Error>| {
                let force = force?;
                Ok([force.normal, force.shear_x, force.shear_y])
            };
            forces.map(components).collect()
        })
    }

    /// Returns a bound on the rounding error of the contact forces below the layer, in f₀. The bound is 0 in an exact
    /// scalar.
    ///
    /// Returns `None` if the scalar promises no precision, or if the bound would be 1 % of the bound on all forces or
    /// more. It also returns `None` for forces so small that errors from underflow are as large as errors from
    /// rounding, and for loads in the scalar itself, whose size is not known.
    ///
    /// Each operation of a sweep has an error of at most one unit in the last place. No partial sum of 3G g exceeds
    /// 2√3·‖g‖, and the transfer does not amplify errors. For n passes and sums, the error is at most 13·n units in the
    /// last place of the bound on all forces. A 64th of this is added for losses by underflow. This suffices, because
    /// 2⁻¹⁶ of such a unit is not zero in the scalar, so the smallest positive value of the scalar is at most twice as
    /// large.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Selection;
    /// use num_traits::ToPrimitive;
    ///
    /// let pile = Pile::under(Region::SITE, "+-+-+-".parse()?)?;
    /// let mut layers = pile.forces::<f64>().layers(Selection::Layer(5))?;
    /// let layer = layers.next_layer()?.expect("layer 5 is asked for");
    /// let bound = layer.error_bound().and_then(|bound| bound.to_f64());
    /// assert!(bound < Some(1e-12));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn error_bound(&self) -> Option<BigRational> {
        let bits = match T::EXACTNESS {
            Exactness::Exact => return Some(BigRational::zero()),
            Exactness::Rounded { bits } => bits,
            _ => return None,
        };
        let system = &self.layers.terms.system;
        if system.has_scalar_loads {
            return None;
        }
        let changes = self.shape().changes_above(self.k + 1) + 1;
        let extras = self.layers.terms.lines.extras_in(0..self.k + 1).count();
        // The passes of the runs, the stops and the extras, and one more for the increments of the sphere itself.
        let steps = BigInt::from(self.layers.stops + changes + extras + 1);
        let unit = BigRational::new(steps * 13, BigInt::one() << bits);
        // `bound_of_sweep` is at least 2√3·B·D, and so at least 3·B·D.
        let greatest = BigRational::new(system.bound_of_sweep(self.k), system.denominator() * 3);
        let little = unit < BigRational::new(1.into(), 100.into());
        let below = &greatest / (BigInt::one() << (bits + 16));
        let underflows = !greatest.is_zero() && T::from_rational(&below).is_zero();
        (little && !underflows).then(|| unit * greatest * BigRational::new(65.into(), 64.into()))
    }

    fn shape(&self) -> &Shape {
        self.layers.shape()
    }

    /// Returns an error for the bottom layer.
    pub(in crate::forces) fn check_above_the_floor(&self) -> Result<(), Error> {
        if self.is_floor() {
            return Err(Error::OnFloor { site: self.first() });
        }
        Ok(())
    }

    /// Returns an error for a layer above the bottom layer.
    pub(in crate::forces) fn check_on_the_floor(&self) -> Result<(), Error> {
        if self.is_floor() {
            return Ok(());
        }
        let floor = self.shape().layers() - 1;
        Err(Error::NotOnFloor {
            site: self.first(),
            floor,
        })
    }

    fn first(&self) -> Site {
        let [[i, j], ..] = self.region.corners();
        Site { i, j, k: self.k }
    }

    fn check(&self, site: Site) -> Result<(), Error> {
        self.shape().check(site)?;
        if site.k == self.k {
            Ok(())
        } else {
            Err(Error::OtherLayer {
                layer: site.k,
                at: self.k,
            })
        }
    }

    /// Returns the forces that a sphere of this layer, above the floor, transmits to the spheres below.
    fn transmitted(&self, site: Site) -> Result<[T; 3], Error> {
        let Layers { walk, meter, .. } = self.layers;
        one(walk.transmitted_in(&row_of(site), *meter))
    }

    /// Fills slices row by row from the cells of a sweep.
    fn fill_from(
        &self,
        sweep: &Sweep<'_, T, Cells<T::Numerator>>,
        slices: [&mut [T]; 3],
    ) -> Result<(), Error> {
        let lines = &self.layers.terms.lines;
        let changes = self.shape().changes_above(self.k + 1);
        let below = Below::<T> {
            own: lines.increments_after(changes),
            scale: lines.scale(changes),
            turns: sweep.turned_already() < changes,
            may_overflow: self.layers.may_overflow,
        };
        let [alpha, beta, gamma] = slices;
        let defined = AtomicBool::new(true);
        let carried = sweep.carried_by_rows();
        let out = [&mut *alpha, &mut *beta, &mut *gamma];
        fill_rows(&self.region, self.k, out, |row, out| {
            if !below.write(carried(row)?, out) {
                defined.store(false, Ordering::Relaxed);
            }
            Ok(())
        })?;
        // Spheres with loads or with a weight of their own are written once more.
        for site in lines.extras_in(self.k..self.k + 1) {
            check_interrupt()?;
            let below = sweep.transmitted(&below.own, site, Meter::NONE)?;
            let forces = self.layers.terms.contacts(below)?;
            self.put_at(site, forces, [&mut *alpha, &mut *beta, &mut *gamma])?;
        }
        if defined.into_inner() {
            Ok(())
        } else {
            Err(Error::overflow("a contact force", T::NAME))
        }
    }
}

/// Returns the row of one sphere.
fn row_of(Site { i, j, k }: Site) -> Row {
    Row { k, j, i: i..i + 1 }
}

/// Returns the single result of a row of one sphere.
fn one<A>(mut answers: Vec<Result<A, Error>>) -> Result<A, Error> {
    let answer = answers.pop();
    answer.unwrap_or_else(|| Err(bug("a row of one sphere has an answer")))
}

impl<T: Algebra> fmt::Debug for Layer<'_, '_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Layer")
            .field("k", &self.k)
            .finish_non_exhaustive()
    }
}
