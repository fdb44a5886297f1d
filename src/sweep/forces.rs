//! All contact forces of a pile, layer after layer.

use core::fmt;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive};

use super::{Cells, Descent, Grid, Layer, Planes};
use crate::formula::{half_turn, passed_on};
use crate::lattice::Site;
use crate::lines::Lines;
use crate::scalar::{Algebra, Exactness, Ring};
use crate::{Error, Method, Pile};

/// A pile on its way down, in any scalar: the plain transfer (THEORY §3), with one layer in memory.
///
/// A run of steps without a change of sign is one addition for each line; a change of sign turns the forces on each
/// sphere. Straight stackings are swept too, though their forces are closed.
///
/// In floats every operation rounds, and nothing amplifies: see [`error_bound`](Self::error_bound). For an exact scalar
/// this is the plain way, in the scalar's own numerators; [`ExactSweep`] is much faster.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Region;
///
/// let pile = Pile::under(Region::SITE, "+-".parse()?)?;
/// let mut sweep = pile.sweep::<f64>()?;
/// sweep.advance(1)?;
/// let [mut alpha, mut beta, mut gamma] = [[0.0; 3]; 3];
/// sweep.fill([&mut alpha, &mut beta, &mut gamma])?;
/// // Below each of the three spheres that the apex rests on: 1 − 1/3 once, and 1 + 2/3 twice.
/// for (force, exact) in [(alpha[0], 2.0 / 3.0), (beta[0], 5.0 / 3.0), (gamma[0], 5.0 / 3.0)] {
///     assert!((force - exact).abs() < 1e-15_f64);
/// }
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub struct Sweep<'p, T: Algebra> {
    pile: &'p Pile,
    descent: Descent<'p, T, Cells<T::Numerator>>,
    /// How often it was told to go on.
    stops: usize,
}

/// The same in exact integers over 3^d·D, of a width that is proved to be enough: the exact engine.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::{Region, Site};
///
/// let pile = Pile::under(Region::SITE, "+-".parse()?)?;
/// let mut sweep = pile.exact_sweep()?;
/// sweep.advance(1)?;
/// let forces = sweep.passed_on(Site { i: 0, j: 0, k: 1 })?;
/// assert_eq!(forces.map(|force| force.to_string()), ["2/3", "5/3", "5/3"]);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub struct ExactSweep<'p> {
    pile: &'p Pile,
    descent: Descent<'p, BigRational, Planes>,
}

impl Pile {
    /// A sweep in the scalar `T`, at the top.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// let pile = Pile::triangular(3)?;
    /// let mut sweep = pile.sweep::<f32>()?;
    /// let mut forces = [(); 3].map(|()| Vec::new());
    /// for k in 0..2 {
    ///     sweep.advance(k)?;
    ///     let mut layer = [(); 3].map(|()| vec![0.0; sweep.spheres().unwrap()]);
    ///     let [alpha, beta, gamma] = layer.each_mut().map(Vec::as_mut_slice);
    ///     sweep.fill([alpha, beta, gamma])?;
    ///     forces.iter_mut().zip(layer).for_each(|(all, layer)| all.extend(layer));
    /// }
    /// assert_eq!(forces[0], [1.0, 2.0, 1.0, 1.0]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::TooLarge`] if a layer does not fit in memory; [`Error::NoSuchMethod`] for discs.
    pub fn sweep<T: Algebra>(&self) -> Result<Sweep<'_, T>, Error> {
        self.check_method(Method::Sweep)?;
        let last = last_with_contacts(self);
        let mut words = size_of::<T::Numerator>().div_ceil(size_of::<i64>());
        if T::EXACTNESS == Exactness::Exact {
            // Integers keep their digits elsewhere.
            words += self.size_of_sweep(last).planes;
        }
        let grid = Grid::new(self.shape(), last, words)?;
        let cells = Cells::new(&grid, &T::Numerator::from_i128(0));
        Ok(Sweep {
            pile: self,
            descent: Descent::new(Lines::new(self), grid, cells),
            stops: 0,
        })
    }

    /// A sweep of the exact engine, at the top.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if a layer does not fit in memory; [`Error::NoSuchMethod`] for discs.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Site;
    /// use cannonpile::{Error, Pile};
    ///
    /// let pile = Pile::triangular(10)?;
    /// let sweep = pile.exact_sweep()?;
    /// assert_eq!(sweep.passed_on(Site::APEX)?.map(|force| force.to_string()), ["1"; 3]);
    /// assert!(matches!(Pile::discs(10)?.exact_sweep(), Err(Error::NoSuchMethod { .. })));
    /// # Ok::<(), Error>(())
    /// ```
    pub fn exact_sweep(&self) -> Result<ExactSweep<'_>, Error> {
        self.check_method(Method::Sweep)?;
        let last = last_with_contacts(self);
        let size = self.size_of_sweep(last);
        let grid = Grid::new(self.shape(), last, size.planes)?;
        let planes = Planes::new(&grid, self.bound_of_sweep(last));
        Ok(ExactSweep {
            pile: self,
            descent: Descent::new(Lines::new(self), grid, planes),
        })
    }
}

/// Below the floor nothing is passed on.
fn last_with_contacts(pile: &Pile) -> i128 {
    (pile.layers() - 2).max(0)
}

/// Goes down to layer `k`.
fn advance<T: Algebra, S: Layer<T>>(
    pile: &Pile,
    descent: &mut Descent<'_, T, S>,
    k: i128,
) -> Result<(), Error> {
    pile.shape().layer(k)?;
    if k < descent.k() || k > last_with_contacts(pile) {
        return Err(elsewhere(pile, descent.k(), k));
    }
    descent.advance(k, ());
    Ok(())
}

fn elsewhere(pile: &Pile, at: i128, layer: i128) -> Error {
    Error::SweepElsewhere {
        layer,
        at,
        last: last_with_contacts(pile),
    }
}

impl<T: Algebra> Sweep<'_, T> {
    /// The layer it is at.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let mut sweep = pile.sweep::<f64>()?;
    /// assert_eq!(sweep.layer(), 0);
    /// sweep.advance(5)?;
    /// assert_eq!(sweep.layer(), 5);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn layer(&self) -> i128 {
        self.descent.k()
    }

    /// Goes down to layer `k`, or stays there; not to the floor, below which there are no contacts.
    ///
    /// # Errors
    /// [`Error::LayerOutside`] for a layer that the pile does not have; [`Error::SweepElsewhere`] for one above this one, or
    /// the floor.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Error, Pile};
    ///
    /// let pile = Pile::triangular(10)?;
    /// let mut sweep = pile.sweep::<f64>()?;
    /// sweep.advance(8)?;
    /// assert_eq!((sweep.layer(), sweep.spheres()?), (8, 45));
    /// assert!(matches!(sweep.advance(7), Err(Error::SweepElsewhere { at: 8, .. })));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn advance(&mut self, k: i128) -> Result<(), Error> {
        advance(self.pile, &mut self.descent, k)?;
        self.stops += 1;
        Ok(())
    }

    /// How many spheres this layer has: the length of each slice to fill.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if no memory could hold as many.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let mut sweep = pile.sweep::<f64>()?;
    /// assert_eq!(sweep.spheres()?, 1);
    /// sweep.advance(8)?;
    /// assert_eq!(sweep.spheres()?, 45);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn spheres(&self) -> Result<usize, Error> {
        let sites = self.pile.shape().layer(self.layer())?.sites();
        sites.to_usize().ok_or(Error::TooLarge {
            quantity: "a layer",
            needed: sites,
            limit: usize::MAX as u64,
            remedy: "ask for one sphere",
        })
    }

    /// Writes the forces to the spheres below this layer in f₀, one slice for each direction, row after row.
    ///
    /// # Errors
    /// [`Error::Length`] for a slice that is not as long as [`spheres`](Self::spheres) says; [`Error::OnFloor`] for a pile of
    /// one layer; [`Error::Overflow`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// let pile = Pile::triangular(3)?;
    /// let mut sweep = pile.sweep::<f64>()?;
    /// sweep.advance(1)?;
    /// let [mut alpha, mut beta, mut gamma] = [[0.0; 3]; 3];
    /// sweep.fill([&mut alpha, &mut beta, &mut gamma])?;
    /// assert_eq!((alpha, beta, gamma), ([2.0, 1.0, 1.0], [1.0, 2.0, 1.0], [1.0, 1.0, 2.0]));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill(&self, slices: [&mut [T]; 3]) -> Result<(), Error> {
        let (k, needed) = (self.layer(), self.spheres()?);
        for slice in &slices {
            if slice.len() != needed {
                let given = slice.len();
                return Err(Error::Length { needed, given });
            }
        }
        let region = self.pile.shape().layer(k)?;
        if k == self.pile.layers() - 1 {
            let [[i, j], ..] = region.corners();
            return Err(Error::OnFloor {
                site: Site { i, j, k },
            });
        }
        let below = self.below();
        let [mut alpha, mut beta, mut gamma] = slices;
        let mut rest = [&mut *alpha, &mut *beta, &mut *gamma];
        let mut defined = true;
        let carried = self.descent.carried_by_rows();
        for row in region.rows(k) {
            let row = carried(&row);
            let n = row[0].len();
            let out = rest
                .each_mut()
                .map(|rest| rest.split_off_mut(..n).unwrap_or_default());
            defined &= below.write(row, out);
        }
        // What weighs more or less than the others.
        for site in self.descent.lines().extras_in(k..k + 1) {
            let (forces, _) = self.descent.passed_on(site, ());
            let place = region.sites_before(site.i, site.j).to_usize();
            let out = [&mut alpha, &mut beta, &mut gamma];
            for (force, out) in forces.into_iter().zip(out) {
                let value = T::from_ratio(force, &below.scale).filter(T::is_defined);
                defined &= value.is_some();
                if let (Some(value), Some(out)) =
                    (value, place.and_then(|place| out.get_mut(place)))
                {
                    *out = value;
                }
            }
        }
        if defined {
            Ok(())
        } else {
            Err(Error::Overflow {
                quantity: "a contact force",
                scalar: T::NAME,
            })
        }
    }

    fn below(&self) -> Below<T> {
        let lines = self.descent.lines();
        let run = self.pile.shape().stretch_to(self.layer() + 1);
        let changes = run.map_or(0, |run| run.index);
        Below {
            own: lines.increments_after(changes),
            scale: lines.scale(changes),
            turns: self.descent.turned_already() < changes,
        }
    }

    /// A bound on how far any force of this layer is from the exact one, in f₀, unless something underflows: 0 for an
    /// exact scalar, `None` for one that says it itself (intervals), or too long a way for its precision.
    ///
    /// With u = 2^(−p), P passes and E spheres of another weight so far, it is 13 u (P + E + 1) B, where
    /// B = √(3KN) + √3 Σ|e| bounds, in f₀, all forces of K layers of N spheres with extras e: the half-turn is orthogonal, so
    /// that no error is amplified on its way down (THEORY §3). For a pass the increments err by 3.1 u, the sum by u,
    /// and the turn, (2/3)(a+b+c) − x in floats, by 7.3 u times the norm of what it acts on.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    /// use cannonpile::stacking::Stacking;
    ///
    /// let pile = Pile::under(Region::SITE, Stacking::hcp(40)?)?;
    /// let mut sweep = pile.sweep::<f64>()?;
    /// sweep.advance(38)?;
    /// let bound = sweep.error_bound().unwrap();
    /// assert!(bound < num_rational::BigRational::new(1.into(), 100_000_000.into()));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn error_bound(&self) -> Option<BigRational> {
        let bits = match T::EXACTNESS {
            Exactness::Exact => return Some(BigRational::from_i128(0)),
            Exactness::Rounded { bits } => bits,
            _ => return None,
        };
        let k = self.layer();
        let lines = Lines::<BigRational>::new(self.pile);
        let extras = lines.extras_in(0..k + 1).count();
        let changes = self.descent.pass().map_or(0, |pass| pass.run.index + 1);
        // As many passes as runs, and as layers stopped at; one more for what a sphere adds itself.
        let steps = BigInt::from(self.stops + changes + extras + 1);
        let unit = BigRational::new(steps * 13, BigInt::one() << bits);
        // 2√3·B·D is at least 3·B·D.
        let greatest = BigRational::new(self.pile.bound_of_sweep(k), lines.scale(0) * 3);
        let little = unit < BigRational::new(1.into(), 100.into());
        little.then(|| unit * greatest)
    }
}

/// What the spheres of a layer add to what their lines carry.
struct Below<T: Algebra> {
    own: [T::Numerator; 3],
    scale: T::Numerator,
    /// Whether what the lines carry is still to be turned.
    turns: bool,
}

impl<T: Algebra> Below<T> {
    /// The forces below consecutive spheres of a row; whether all are defined.
    fn write(&self, carried: [&[T::Numerator]; 3], [a, b, c]: [&mut [T]; 3]) -> bool {
        if self.turns {
            return self.write_turned(carried, [a, b, c]);
        }
        let mut defined = true;
        for ((carried, out), own) in carried.into_iter().zip([a, b, c]).zip(&self.own) {
            for (force, out) in carried.iter().zip(out) {
                defined &= self.put(passed_on(force.clone(), own), out);
            }
        }
        defined
    }

    fn write_turned(&self, [a, b, c]: [&[T::Numerator]; 3], out: [&mut [T]; 3]) -> bool {
        let mut defined = true;
        let carried = a.iter().zip(b).zip(c);
        let [to_a, to_b, to_c] = out;
        for (((a, b), c), ((to_a, to_b), to_c)) in carried.zip(to_a.iter_mut().zip(to_b).zip(to_c))
        {
            let turned = half_turn::<T>(&[a.clone(), b.clone(), c.clone()]);
            for ((force, out), own) in turned.into_iter().zip([to_a, to_b, to_c]).zip(&self.own) {
                defined &= self.put(passed_on(force, own), out);
            }
        }
        defined
    }

    #[inline]
    fn put(&self, force: T::Numerator, out: &mut T) -> bool {
        match T::from_ratio(force, &self.scale) {
            Some(value) => {
                let defined = value.is_defined();
                *out = value;
                defined
            }
            None => false,
        }
    }
}

impl ExactSweep<'_> {
    /// The layer it is at.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let mut sweep = pile.exact_sweep()?;
    /// assert_eq!(sweep.layer(), 0);
    /// sweep.advance(5)?;
    /// assert_eq!(sweep.layer(), 5);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn layer(&self) -> i128 {
        self.descent.k()
    }

    /// Goes down to layer `k`, or stays there; not to the floor, below which there are no contacts.
    ///
    /// # Errors
    /// As for [`Sweep::advance`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Site;
    /// use cannonpile::{Error, Pile};
    ///
    /// let pile = Pile::triangular(10)?;
    /// let mut sweep = pile.exact_sweep()?;
    /// sweep.advance(5)?;
    /// let forces = sweep.passed_on(Site { i: 1, j: 2, k: 5 })?;
    /// assert_eq!(forces.map(|force| force.to_string()), ["3", "2", "3"]);
    /// // Neither back nor to the floor.
    /// assert!(matches!(sweep.advance(4), Err(Error::SweepElsewhere { at: 5, .. })));
    /// assert!(matches!(sweep.advance(9), Err(Error::SweepElsewhere { last: 8, .. })));
    /// # Ok::<(), Error>(())
    /// ```
    pub fn advance(&mut self, k: i128) -> Result<(), Error> {
        advance(self.pile, &mut self.descent, k)
    }

    /// The forces to the spheres below one of this layer, in f₀.
    ///
    /// # Errors
    /// [`Error::SiteOutside`]; [`Error::SweepElsewhere`] for a sphere of another layer; [`Error::OnFloor`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::{Region, Site};
    ///
    /// let pile = Pile::under(Region::SITE, "+-+".parse()?)?;
    /// let mut sweep = pile.exact_sweep()?;
    /// sweep.advance(2)?;
    /// let forces = sweep.passed_on(Site { i: 0, j: -1, k: 2 })?;
    /// assert_eq!(forces.map(|force| force.to_string()), ["19/9", "19/9", "4/9"]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn passed_on(&self, site: Site) -> Result<[BigRational; 3], Error> {
        let site = self.pile.shape().check(site)?;
        if site.k == self.pile.layers() - 1 {
            return Err(Error::OnFloor { site });
        }
        if site.k != self.layer() {
            return Err(elsewhere(self.pile, self.layer(), site.k));
        }
        let (forces, changes) = self.descent.passed_on(site, ());
        let scale = self.descent.lines().scale(changes);
        Ok(forces.map(|force| BigRational::new(force, scale.clone())))
    }
}

impl<T: Algebra> fmt::Debug for Sweep<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Sweep")
            .field("layer", &self.layer())
            .finish_non_exhaustive()
    }
}

impl fmt::Debug for ExactSweep<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ExactSweep")
            .field("layer", &self.layer())
            .finish_non_exhaustive()
    }
}
