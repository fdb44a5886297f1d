//! The one recursion: what the forces of all stackings add up to, layer after layer.
//!
//! Let f_σ be the sum, over all beginnings of stackings whose next sign is σ, of what the spheres of a layer pass on, by
//! place and direction: each stacking with its share of probability, or each of those with d faults alike. One step leads
//! the forces along their contacts,
//!
//! g_σ(x + σu_l, l) = f_σ(x, l),
//!
//! whichever beginning they come of, since a place is the same for all. There the next sign is chosen: the same one, with
//! 1 − q, where forces go on straight, or the other, with q, where they make a [half-turn](cannonpile::formula::half_turn); and the
//! spheres of the layer add what they weigh:
//!
//! f_σ ← (1 − q) g_σ + q G g_(−σ) + w·P(a sphere at x, next sign σ).
//!
//! *Proof.* Each stacking obeys its own equations, which are linear, and the choice depends on the sign before alone. ∎
//! In numbers without thirds the second share is (q/3)·3G. By faults the shares are all of g_(σ,d) and all of 3G g_(−σ,d−1), over
//! 3^d, and nothing is said of q.
//!
//! On a base the spheres of a layer depend on the steps that are left. So the net number of these is kept too, and the
//! recursion starts with every number at which the base carries a top layer.

mod bottom;
mod sources;
use core::ops::Range;

use cannonpile::engine::check_interrupt;
use cannonpile::formula;
use cannonpile::lattice::{Direction, Sign};
use cannonpile::scalar::Algebra;

use super::floor::Floor;
use super::frame::Frame;
use super::number::{Number, Share, add};
use super::place::Place;
use super::walk::{SIGNS, Walk};
use crate::Error;
use crate::error::bug;

/// The forces of one class and next sign: a plane of cells for each direction.
type Planes<T> = [Vec<T>; 3];

/// Forces by the net number of steps left (one number only, but on a base), class, and next sign; `None` where there are none.
type Layer<T> = Vec<Vec<[Option<Planes<T>>; 2]>>;

/// What is run over a frame.
pub(super) struct Transfer<'f, T, S> {
    pub(super) frame: &'f Frame<'f>,
    /// How many classes there are: numbers of faults, or one.
    pub(super) classes: usize,
    /// Of what goes on straight.
    pub(super) same: S,
    /// Of three times what makes a half-turn.
    pub(super) change: S,
    /// What a sphere adds to each line, in the unit of forces.
    pub(super) weight: T,
    /// What loads add, by site of the top layer.
    pub(super) loads: Vec<([i128; 2], T)>,
}

/// What the bottom sphere at a place bears, summed over stackings.
#[derive(Clone, Debug)]
pub(super) struct Spot<T> {
    pub(super) place: Place,
    /// By class: the share of stackings that have a sphere there, and the force on the floor.
    pub(super) classes: Vec<(T, Floor<T>)>,
}

impl<T: Number, S: Share<T>> Transfer<'_, T, S> {
    /// Returns what each place of the bottom layer bears.
    ///
    /// # Errors
    /// [`Error::Bug`].
    pub(super) fn run(&self) -> Result<Vec<Spot<T>>, Error> {
        let frame = self.frame;
        let mut walk = Walk::new(
            self.classes,
            frame.steps,
            frame.plus(),
            frame.piles.stackings.first_signs(),
            frame.starts(),
        )?;
        let mut layer = self.empty();
        if frame.steps > 0 {
            self.load(&mut layer, &walk)?;
            self.add_weights(&mut layer, &walk, 0)?;
        }
        let mut below = self.empty();
        for k in 1..frame.steps {
            walk.step();
            walk.choose(&self.same, &self.change, |class| self.before(class));
            self.pass_on(&mut layer, &mut below, k)?;
            core::mem::swap(&mut layer, &mut below);
            self.add_weights(&mut layer, &walk, k)?;
        }
        if frame.steps > 0 {
            walk.step();
        }
        self.bottom(&layer, &walk)
    }

    /// The class from which a fault leads to this one.
    fn before(&self, class: usize) -> Option<usize> {
        if self.classes == 1 {
            Some(class)
        } else {
            class.checked_sub(1)
        }
    }

    fn empty(&self) -> Layer<T> {
        let left = if self.frame.base().is_some() {
            2 * self.frame.steps + 1
        } else {
            1
        };
        let class = || (0..self.classes).map(|_| [None, None]).collect();
        (0..left).map(|_| class()).collect()
    }

    fn planes(&self) -> Planes<T> {
        [(); 3].map(|()| vec![T::zero(); self.frame.grid.cells()])
    }

    /// The index of a number of net steps that are left; 0 of what is not on a base.
    fn of_net(&self, net: isize) -> Option<usize> {
        if self.frame.base().is_some() {
            self.frame.steps.checked_add_signed(net)
        } else {
            Some(0)
        }
    }

    /// The net numbers of steps left, in the order of layers: −n to n on a base, else one.
    fn nets(&self) -> core::ops::RangeInclusive<isize> {
        // As many as there are cells in memory.
        let steps = self.frame.steps.cast_signed();
        if self.frame.base().is_some() {
            -steps..=steps
        } else {
            0..=0
        }
    }

    /// The number of net steps left before a step that leaves this one; itself where it is not on a base.
    fn left_before(&self, net: isize, sign: Sign) -> Option<usize> {
        let step = if sign == Sign::Plus {
            self.frame.plus()
        } else {
            -self.frame.plus()
        };
        self.of_net(net - step)
    }

    /// Leads the forces of a layer to layer `k` and across it, without its weights.
    fn pass_on(&self, from: &mut Layer<T>, to: &mut Layer<T>, k: usize) -> Result<(), Error> {
        for (net, classes) in self.nets().zip(to) {
            // What cannot come to the base in the steps that are left does not matter.
            let reaches = net.unsigned_abs() <= self.frame.steps - k;
            for (class, signs) in classes.iter_mut().enumerate() {
                for (at, planes) in signs.iter_mut().enumerate() {
                    let of = |sign: usize, class: Option<usize>| {
                        let net = self.left_before(net, SIGNS[sign])?;
                        from.get(net)?.get(class?)?.get(sign)?.as_ref()
                    };
                    let straight = of(at, Some(class)).map(|planes| (SIGNS[at], planes));
                    let turned =
                        of(1 - at, self.before(class)).map(|planes| (SIGNS[1 - at], planes));
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

    /// What goes on straight and what makes a half-turn, together.
    fn combine(
        &self,
        planes: &mut Planes<T>,
        straight: Option<(Sign, &Planes<T>)>,
        turned: Option<(Sign, &Planes<T>)>,
        k: usize,
    ) -> Result<(), Error> {
        for cells in self.frame.grid.window(k)? {
            check_interrupt()?;
            let [a, b, c] = rows_mut(planes, &cells)?;
            if let Some((sign, from)) = straight {
                let [ga, gb, gc] = self.above(from, &cells, sign)?;
                carry(a, ga, &self.same);
                carry(b, gb, &self.same);
                carry(c, gc, &self.same);
            } else {
                for row in [&mut *a, &mut *b, &mut *c] {
                    row.fill(T::zero());
                }
            }
            if let Some((sign, from)) = turned {
                let from = self.above(from, &cells, sign)?;
                turn([a, b, c], from, &self.change);
            }
        }
        Ok(())
    }

    /// The forces that come to these cells along each direction.
    fn above<'l>(
        &self,
        planes: &'l Planes<T>,
        cells: &Range<usize>,
        sign: Sign,
    ) -> Result<[&'l [T]; 3], Error> {
        let [a, b, c] = planes;
        let along = |plane: &'l [T], direction| {
            let cells = self.frame.grid.above(cells, sign, direction)?;
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
    let rows = (
        a.get_mut(cells.clone()),
        b.get_mut(cells.clone()),
        c.get_mut(cells.clone()),
    );
    let (Some(a), Some(b), Some(c)) = rows else {
        return Err(bug(FREE));
    };
    Ok([a, b, c])
}

/// The share that goes on straight.
#[inline]
fn carry<T: Number>(to: &mut [T], from: &[T], same: &impl Share<T>) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = same.of(from.clone());
    }
}

/// Adds the share that makes a half-turn.
#[inline]
fn turn<T: Number>([a, b, c]: [&mut [T]; 3], from: [&[T]; 3], change: &impl Share<T>) {
    let [ga, gb, gc] = from;
    let to = a.iter_mut().zip(b).zip(c);
    for (((a, b), c), ((ga, gb), gc)) in to.zip(ga.iter().zip(gb).zip(gc)) {
        let [ta, tb, tc] = formula::tripled_half_turn(&[ga.clone(), gb.clone(), gc.clone()]);
        add(a, &change.of(ta));
        add(b, &change.of(tb));
        add(c, &change.of(tc));
    }
}

/// Returns the shares 1 − q and q/3 of a fault probability.
pub(super) fn shares<T: Algebra>(q: &T) -> [T; 2] {
    let same = T::one() - q;
    [same, q.clone().div_int(crate::THREE)]
}
