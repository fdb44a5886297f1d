//! The recursion for sums over all stackings, layer by layer.
//!
//! Let f_σ be the sum of the contact forces below a layer, by place and direction, over all beginnings of stackings
//! that continue with the sign σ. The weight of a beginning is its probability, or 1 for sums by the number of faults.
//! A step moves the forces along their contacts:
//!
//! g_σ(x + σu_l, l) = f_σ(x, l).
//!
//! This holds for every beginning, because places do not depend on the stacking. Then the next sign is chosen. With
//! probability 1 − q it is the same, and the forces continue. With probability q it changes, and the forces make a
//! [half-turn](cannonpile::formula::half_turn) G. Finally the weights of the spheres of the layer are added:
//!
//! f_σ ← (1 − q) g_σ + q G g_(−σ) + w·P(a sphere at x, next sign σ).
//!
//! *Proof.* Every stacking obeys its own equations, which are linear, and the next sign depends on the last one only. ∎
//!
//! To avoid thirds the second term is computed as (q/3)·3G. For d faults the recursion is f_(σ,d) ← g_(σ,d) + 3G g_(−σ,d−1),
//! in units of 3^(−d). It does not depend on q.
//!
//! On a base the spheres of a layer depend on the steps that are left. So the forces are also stored by the net number of
//! these steps. The recursion then starts with every number for which the top layer has a sphere.

mod bottom;
mod sources;
use core::ops::Range;

use cannonpile::engine::check_interrupt;
use cannonpile::formula;
use cannonpile::lattice::{Direction, Sign};
use cannonpile::scalar::Algebra;
use num_bigint::BigInt;
use num_rational::BigRational;

use super::domain::Domain;
use super::nets::{NetCounts, SIGNS};
use super::number::{Number, add, times};
use super::place::Place;
use super::width::Width;
use crate::error::bug;
use crate::{Each, Error};

/// The forces of one class and next sign: a plane of cells for each direction.
type Planes<T> = [Vec<T>; 3];

/// The forces of a layer, by the net number of steps that are left, class, and next sign. There is more than one net
/// number on a base only. `None` stands for zero everywhere.
type Layer<T> = Vec<Vec<[Option<Planes<T>>; 2]>>;

/// The recursion over a domain.
pub(super) struct Transfer<'f, T> {
    domain: &'f Domain<'f>,
    /// The number of classes: a class for each number of faults, or one class.
    classes: usize,
    /// The factors of g_σ and of 3G g_(−σ). `None` stands for 1, for sums by numbers of faults.
    factors: [Option<T>; 2],
    /// The force that a sphere adds to each of its contacts.
    weight: T,
    /// The force that each load adds to each contact of its sphere, by site of the top layer.
    loads: Vec<([i128; 2], T)>,
}

/// The result at one place of the bottom layer, summed over stackings.
#[derive(Clone, Debug)]
pub(super) struct Spot<T> {
    pub(super) place: Place,
    /// By class: the sum of the stackings that have a sphere there, and the sums of its normal force and both shears on
    /// the floor, times [`FLOOR_UNIT`](super::floor::FLOOR_UNIT).
    pub(super) classes: Vec<[T; 4]>,
}

/// Runs the recursion in integers of this width. `shares` are the numerators of the factors of both terms. With `None`
/// the sums are by the number of faults. The loads are multiplied by `denominator`.
pub(super) fn run_in_integers(
    width: Width,
    domain: &Domain<'_>,
    classes: usize,
    denominator: &BigInt,
    shares: Option<[BigInt; 2]>,
) -> Result<Vec<Spot<BigInt>>, Error> {
    match width {
        Width::Narrow => run_in::<i64>(domain, classes, denominator, shares),
        Width::Wide => run_in::<i128>(domain, classes, denominator, shares),
        Width::Big => run_in::<BigInt>(domain, classes, denominator, shares),
    }
}

fn run_in<T: Number + TryFrom<BigInt> + Into<BigInt>>(
    domain: &Domain<'_>,
    classes: usize,
    denominator: &BigInt,
    shares: Option<[BigInt; 2]>,
) -> Result<Vec<Spot<BigInt>>, Error> {
    let number = |n: BigInt| T::try_from(n).map_err(|_| bug("the bound holds for all numerators"));
    let scalar = |x: &BigRational| number(x.numer() * (denominator / x.denom()));
    let factors = match shares {
        None => [None, None],
        Some([same, change]) => [Some(number(same)?), Some(number(change)?)],
    };
    let spots = Transfer::new(domain, classes, factors, scalar)?.run()?;
    let widened = spots.into_iter().map(|Spot { place, classes }| {
        let classes = classes
            .into_iter()
            .map(|[spheres, normal, x, y]| [spheres.into(), normal.into(), x.into(), y.into()]);
        let classes = classes.collect();
        Spot { place, classes }
    });
    Ok(widened.collect())
}

impl<'f, T: Number> Transfer<'f, T> {
    /// Returns the recursion over a domain. `scalar` converts the loads and the weight of a sphere, in mg.
    pub(super) fn new(
        domain: &'f Domain<'f>,
        classes: usize,
        factors: [Option<T>; 2],
        scalar: impl Fn(&BigRational) -> Result<T, Error>,
    ) -> Result<Self, Error> {
        let mut loads = Vec::new();
        for (site, load) in domain.piles.loads() {
            loads.push((*site, scalar(load)?));
        }
        Ok(Self {
            domain,
            classes,
            factors,
            weight: scalar(&domain.piles.weight())?,
            loads,
        })
    }

    /// Returns the result for each place of the bottom layer.
    ///
    /// # Errors
    /// [`Bug`](cannonpile::Error::Bug).
    pub(super) fn run(&self) -> Result<Vec<Spot<T>>, Error> {
        let domain = self.domain;
        let mut counts = NetCounts::new(
            self.classes,
            domain.steps,
            domain.plus(),
            domain.piles.stackings.first_signs(),
            domain.starts(),
        )?;
        let mut layer = self.empty();
        if domain.steps > 0 {
            self.add_loads(&mut layer, &counts)?;
            self.add_weights(&mut layer, &counts, 0)?;
        }
        let mut below = self.empty();
        for k in 1..domain.steps {
            counts.step();
            counts.choose(self.factors.each_ref().each(Option::as_ref), |class| {
                self.before(class)
            });
            self.transmit(&layer, &mut below, k)?;
            core::mem::swap(&mut layer, &mut below);
            self.add_weights(&mut layer, &counts, k)?;
        }
        if domain.steps > 0 {
            counts.step();
        }
        self.bottom(&layer, &counts)
    }

    /// Returns the class that a fault turns into `class`.
    fn before(&self, class: usize) -> Option<usize> {
        if self.classes == 1 {
            Some(class)
        } else {
            class.checked_sub(1)
        }
    }

    fn empty(&self) -> Layer<T> {
        let classes = || (0..self.classes).map(|_| [None, None]).collect();
        self.domain.nets().map(|_| classes()).collect()
    }

    fn planes(&self) -> Planes<T> {
        [(); 3].each(|()| vec![T::zero(); self.domain.grid.cells()])
    }

    /// Returns the index in a [`Layer`] of a net number of steps that are left.
    fn net_index(&self, net: isize) -> Option<usize> {
        if self.domain.base().is_some() {
            self.domain.steps.checked_add_signed(net)
        } else {
            Some(0)
        }
    }

    /// Returns the index of the net number that a step of this sign changes to `net`.
    fn left_before(&self, net: isize, sign: Sign) -> Option<usize> {
        let step = if sign == Sign::Plus {
            self.domain.plus()
        } else {
            -self.domain.plus()
        };
        self.net_index(net - step)
    }

    /// Transmits the forces of a layer to layer `k` and through its spheres, without their weights.
    fn transmit(&self, from: &Layer<T>, to: &mut Layer<T>, k: usize) -> Result<(), Error> {
        for (net, classes) in self.domain.nets().zip(to) {
            // Other numbers cannot lead to the base in the steps that are left.
            let reaches = net.unsigned_abs() <= self.domain.steps - k;
            for (class, signs) in classes.iter_mut().enumerate() {
                for (at, planes) in signs.iter_mut().enumerate() {
                    let of = |sign: usize, class: Option<usize>| {
                        let net = self.left_before(net, SIGNS[sign])?;
                        let planes = from.get(net)?.get(class?)?.get(sign)?.as_ref()?;
                        Some((SIGNS[sign], planes))
                    };
                    let straight = of(at, Some(class));
                    let turned = of(1 - at, self.before(class));
                    if !reaches || (straight.is_none() && turned.is_none()) {
                        *planes = None;
                        continue;
                    }
                    let planes = planes.get_or_insert_with(|| self.planes());
                    self.combine(planes, straight, turned, k)?;
                }
            }
        }
        Ok(())
    }

    /// Sets the forces of layer `k` to the sum of both terms of the recursion.
    fn combine(
        &self,
        planes: &mut Planes<T>,
        straight: Option<(Sign, &Planes<T>)>,
        turned: Option<(Sign, &Planes<T>)>,
        k: usize,
    ) -> Result<(), Error> {
        for cells in self.domain.grid.window(k)? {
            check_interrupt()?;
            let mut rows = rows_mut(planes, &cells)?;
            if let Some((sign, from)) = straight {
                let from = self.above(from, &cells, sign)?;
                for (row, from) in rows.iter_mut().zip(from) {
                    carry(row, from, self.factors[0].as_ref());
                }
            } else {
                for row in &mut rows {
                    row.fill(T::zero());
                }
            }
            if let Some((sign, from)) = turned {
                let from = self.above(from, &cells, sign)?;
                turn(rows, from, self.factors[1].as_ref());
            }
        }
        Ok(())
    }

    /// Returns the forces that arrive in these cells, by direction.
    fn above<'l>(
        &self,
        planes: &'l Planes<T>,
        cells: &Range<usize>,
        sign: Sign,
    ) -> Result<[&'l [T]; 3], Error> {
        let [a, b, c] = planes;
        let along = |plane: &'l [T], direction| {
            let cells = self.domain.grid.above(cells, sign, direction)?;
            plane.get(cells).ok_or_else(|| bug(FREE))
        };
        Ok([
            along(a, Direction::Alpha)?,
            along(b, Direction::Beta)?,
            along(c, Direction::Gamma)?,
        ])
    }
}

const FREE: &str = "there is a free cell all around";

fn rows_mut<'l, T>(
    [a, b, c]: &'l mut Planes<T>,
    cells: &Range<usize>,
) -> Result<[&'l mut [T]; 3], Error> {
    let row = |plane: &'l mut Vec<T>| plane.get_mut(cells.clone()).ok_or_else(|| bug(FREE));
    Ok([row(a)?, row(b)?, row(c)?])
}

/// Sets `to` to the term of an unchanged sign.
#[inline]
fn carry<T: Number>(to: &mut [T], from: &[T], same: Option<&T>) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = times(from.clone(), same);
    }
}

/// Adds the term of a changed sign.
#[inline]
fn turn<T: Number>([a, b, c]: [&mut [T]; 3], from: [&[T]; 3], change: Option<&T>) {
    let [ga, gb, gc] = from;
    let to = a.iter_mut().zip(b).zip(c);
    for (((a, b), c), ((ga, gb), gc)) in to.zip(ga.iter().zip(gb).zip(gc)) {
        let [ta, tb, tc] = formula::tripled_half_turn(&[ga.clone(), gb.clone(), gc.clone()]);
        add(a, &times(ta, change));
        add(b, &times(tb, change));
        add(c, &times(tc, change));
    }
}

/// Returns the factors 1 − q and q/3 of both terms.
pub(super) fn shares<T: Algebra>(q: &T) -> [T; 2] {
    let same = T::one() - q;
    [same, q.clone().div_int(crate::THREE)]
}
