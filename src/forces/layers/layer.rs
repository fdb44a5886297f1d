//! One layer of a pile and its forces.

use core::fmt;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};

use super::{Layers, Output, Quantities, check_lengths};
use crate::engine::{Engine, fill_rows};
use crate::lattice::{Region, Site};
use crate::scalar::{Algebra, Exactness};
use crate::shape::Shape;
use crate::{Error, FloorForce};

/// One layer of a pile and its forces, from [`Layers::next_layer`].
pub struct Layer<'l, 'p, O: Output> {
    pub(super) layers: &'l Layers<'p, O>,
    pub(super) k: i128,
    pub(super) region: Region,
    pub(super) spheres: usize,
}

impl<'p, O: Output> Layers<'p, O> {
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
    pub fn next_layer(&mut self) -> Result<Option<Layer<'_, 'p, O>>, Error> {
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
}

impl<O: Output> Layer<'_, '_, O> {
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
    pub fn to_below(&self, site: Site) -> Result<[O::Value; 3], Error> {
        self.at(Quantities::Contacts, site)
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
    pub fn fill(&self, slices: [&mut [O::Value]; 3]) -> Result<(), Error> {
        self.fill_with(Quantities::Contacts, slices)
    }

    /// Writes a quantity into slices over the layer, row after row.
    fn fill_with(&self, asked: Quantities, slices: [&mut [O::Value]; 3]) -> Result<(), Error> {
        let (layers, k) = (self.layers, self.k);
        check_lengths(self.spheres, &slices)?;
        layers.check_part(asked, self.first())?;
        if let (Quantities::Contacts, Some(table)) = (asked, &layers.table) {
            return table.fill(k..k + 1, slices);
        }
        let conversion = O::conversion(layers, asked, k)?;
        let [a, b, c] = slices;
        let out = [&mut *a, &mut *b, &mut *c];
        // The images of a contact force are equal to it, so the spheres that a sweep stores are enough.
        let Engine::Limbs(sweep) = &layers.source.engine else {
            return fill_rows(&self.region, k, out, |row, out| {
                layers.write_row((asked, &conversion), row, out, || {
                    layers.numbers(asked, row)
                })
            });
        };
        let by_images = asked == Quantities::Contacts;
        fill_rows(&self.region, k, out, |row, out| {
            let (row, out) = if by_images {
                sweep.stored_piece(row, out)?
            } else {
                (row.clone(), out)
            };
            layers.write_row((asked, &conversion), &row, out, || {
                layers.numbers(asked, &row)
            })
        })?;
        if by_images {
            sweep.copy_to_images(&mut [a, b, c])?;
        }
        Ok(())
    }

    /// Returns a quantity of one sphere of the layer.
    fn at(&self, asked: Quantities, site: Site) -> Result<[O::Value; 3], Error> {
        self.shape().check(site)?;
        if site.k != self.k {
            return Err(Error::OtherLayer {
                layer: site.k,
                at: self.k,
            });
        }
        self.layers.check_part(asked, site)?;
        let conversion = O::conversion(self.layers, asked, self.k)?;
        self.layers.at((asked, &conversion), site)
    }

    pub(super) fn shape(&self) -> &Shape {
        self.layers.shape()
    }

    fn first(&self) -> Site {
        let [[i, j], ..] = self.region.corners();
        Site { i, j, k: self.k }
    }
}

impl<O: Output<Whole = ()>> Layer<'_, '_, O> {
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
    pub fn on_floor(&self, site: Site) -> Result<FloorForce<O::Value>, Error> {
        let [normal, shear_x, shear_y] = self.at(Quantities::Floor, site)?;
        Ok(FloorForce {
            site,
            normal,
            shear_x,
            shear_y,
        })
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
    pub fn fill_base(&self, slices: [&mut [O::Value]; 3]) -> Result<(), Error> {
        self.fill_with(Quantities::Floor, slices)
    }
}

impl<T: Algebra> Layer<'_, '_, T> {
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
        let lines = &self.layers.source.lines;
        if lines.has_scalar_loads {
            return None;
        }
        let changes = self.shape().changes_above(self.k + 1) + 1;
        let extras = lines.extras_in(0..self.k + 1).count();
        // The passes of the runs, the stops and the extras, and one more for the increments of the sphere itself.
        let steps = BigInt::from(self.layers.stops + changes + extras + 1);
        let unit = BigRational::new(steps * 13, BigInt::one() << bits);
        let pile = &lines.pile;
        // `bound_of_sweep` is at least 2√3·B·D, and so at least 3·B·D.
        let greatest = BigRational::new(pile.bound_of_sweep(self.k), pile.denominator() * 3);
        let little = unit < BigRational::new(1.into(), 100.into());
        let below = &greatest / (BigInt::one() << (bits + 16));
        let underflows = !greatest.is_zero() && T::from_rational(&below).is_zero();
        (little && !underflows).then(|| unit * greatest * BigRational::new(65.into(), 64.into()))
    }
}

impl<O: Output> fmt::Debug for Layer<'_, '_, O> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Layer")
            .field("k", &self.k)
            .finish_non_exhaustive()
    }
}
