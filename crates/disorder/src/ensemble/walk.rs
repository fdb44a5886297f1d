//! Enumeration of stackings as a tree, so that common beginnings are computed once.
//!
//! The forces below layer k depend on the first k + 1 signs only. So the walk descends sign by sign, with + before −, through
//! a sorted list of stackings. On its way back it adds the forces below the layer for all listed stackings that continue the
//! beginning.

use core::ops::Range;

use cannonpile::lattice::{Region, Sign};

use super::continuations::{Continuations, split};
use super::count::{Counted, LayerForces, Level};
use super::layer::{Numerator, Places, Planes, extremes, move_down, transmit, transmit_turned};
use super::setup::{Setup, too_many_faults};
use super::verdicts::Verdicts;
use crate::Error;
use crate::error::bug;

/// The result of a walk, by number of faults.
pub(super) struct Walk<T> {
    pub(super) all: Vec<Counted<T>>,
    pub(super) standing: Vec<Counted<T>>,
    /// The numbers of stackings that are stable with horizontal contacts, if they are requested.
    pub(super) held: Vec<u64>,
}

/// A layer of the current beginning.
struct Frame<T> {
    region: Region,
    places: Places,
    level: Level,
    received: Planes<T>,
    forces: Planes<T>,
    all: Continuations,
    standing: Continuations,
}

/// The properties of a beginning.
#[derive(Clone, Copy)]
struct State {
    faults: usize,
    /// Whether no contact is in tension.
    stands: bool,
    /// Whether the beginning is stable with horizontal contacts.
    held: bool,
}

struct Walker<'s, T, E> {
    setup: &'s Setup<T>,
    verdicts: Option<&'s Verdicts<'s, E>>,
    list: &'s [Vec<Sign>],
    frames: Vec<Frame<T>>,
    signs: Vec<Sign>,
    normals: Vec<T>,
    walk: Walk<T>,
}

/// Counts the forces of a sorted list of stackings of one class, which may contain a stacking several times.
pub(super) fn walk<T: Numerator, E: From<Error>>(
    setup: &Setup<T>,
    verdicts: Option<&Verdicts<'_, E>>,
    list: &[Vec<Sign>],
) -> Result<Walk<T>, E> {
    let fault_numbers = setup.by_faults.len();
    let frame = || {
        let places = Places::of(&setup.top)?;
        Ok(Frame {
            region: setup.top,
            level: Level::top(places.spheres() as u128),
            places,
            received: [Vec::new(), Vec::new(), Vec::new()],
            forces: [Vec::new(), Vec::new(), Vec::new()],
            all: Continuations::none(fault_numbers),
            standing: Continuations::none(fault_numbers),
        })
    };
    let frames: Result<Vec<_>, Error> = (0..=setup.steps).map(|_| frame()).collect();
    let counted = || (0..fault_numbers).map(|_| Counted::new()).collect();
    let mut walker = Walker {
        setup,
        verdicts,
        list,
        frames: frames?,
        signs: Vec::with_capacity(setup.steps),
        normals: Vec::new(),
        walk: Walk {
            all: counted(),
            standing: counted(),
            held: vec![0; fault_numbers],
        },
    };
    let state = State {
        faults: 0,
        stands: true,
        held: true,
    };
    walker.visit(0, 0..list.len(), state)?;
    Ok(walker.walk)
}

impl<T: Numerator, E: From<Error>> Walker<'_, T, E> {
    /// Visits the listed stackings that continue a beginning of k signs.
    fn visit(&mut self, k: usize, listed: Range<usize>, state: State) -> Result<(), E> {
        let frame = frame(&mut self.frames, k)?;
        frame.all.clear();
        frame.standing.clear();
        if k == self.setup.steps {
            return Ok(self.base(k, listed, state)?);
        }
        for (sign, listed) in split(self.list, listed, k)? {
            if !listed.is_empty() {
                self.step(k, sign, listed, state)?;
            }
        }
        Ok(())
    }

    /// Appends a sign to a beginning of k signs, and visits the listed stackings that continue it.
    fn step(&mut self, k: usize, sign: Sign, listed: Range<usize>, state: State) -> Result<(), E> {
        self.signs.truncate(k);
        let last = self.signs.last().copied();
        self.signs.push(sign);
        let changes = last.is_some_and(|last| last != sign);
        let faults = state.faults + usize::from(changes);
        let setup = self.setup;
        let units = setup.units(faults)?;
        let above = frame(&mut self.frames, k)?;
        match last {
            None => above.forces.clone_from(&setup.top_own),
            Some(_) if changes => transmit_turned(&above.received, &units.own, &mut above.forces),
            Some(_) => transmit(&above.received, &units.own, &mut above.forces),
        }
        let ends = extremes(above.forces.iter().flatten());
        let ends = ends.ok_or_else(|| bug("a layer has a sphere"))?;
        let stands = state.stands && ends[0] >= T::zero();
        let region = setup.layer_below(&above.region, &self.signs)?;
        // The verdict is requested only if some contact is in tension without horizontal contacts.
        let is_held = || match self.verdicts {
            Some(verdicts) => verdicts.is_stable(&self.signs, region),
            None => Ok(false),
        };
        // A stable stacking stays stable if its last step is repeated, and all its beginnings are stable.
        let held = state.held && (stands || last == Some(sign) || is_held()?);
        self.move_down(k, sign, region)?;
        let state = State {
            faults,
            stands,
            held,
        };
        self.visit(k + 1, listed, state)?;

        let (frames, below) = self.frames.split_at_mut(k + 1);
        let pair = frames.last_mut().zip(below.first());
        let (above, below) = pair.ok_or_else(missing_frame)?;
        let layer = LayerForces::new(&above.forces, &units.width, ends, above.level)?;
        let kinds = [
            (&below.all, &mut self.walk.all),
            (&below.standing, &mut self.walk.standing),
        ];
        for (continuations, counted) in kinds {
            for (total, count, first) in continuations.entries() {
                let counted = counted.get_mut(total).ok_or_else(too_many_faults)?;
                let scale = &setup.units(total - faults)?.power;
                let signs = self.list.get(first);
                let signs = signs.ok_or_else(|| bug("indices of a list are in it"))?;
                counted.add_layer(&layer, count, scale, signs)?;
            }
        }
        above.all.add_all(&below.all)?;
        above.standing.add_all(&below.standing)?;
        Ok(())
    }

    /// Moves the forces below layer k to the next layer, which has this region.
    fn move_down(&mut self, k: usize, sign: Sign, region: Region) -> Result<(), Error> {
        let (frames, rest) = self.frames.split_at_mut(k + 1);
        let pair = frames.last().zip(rest.first_mut());
        let (above, below) = pair.ok_or_else(missing_frame)?;
        below.region = region;
        below.places = Places::of(&region)?;
        below.level = above.level.next(below.places.spheres() as u128);
        let received = &mut below.received;
        move_down(&above.forces, &above.places, sign, &below.places, received)
    }

    /// Counts the bottom layer of the listed stackings with the current signs.
    fn base(&mut self, k: usize, listed: Range<usize>, state: State) -> Result<(), Error> {
        let units = self.setup.units(state.faults)?;
        let frame = frame(&mut self.frames, k)?;
        // By (13) of the paper, three times the normal force in mg is the sum of the forces from above plus three times
        // the weight. The forces of a single layer contain its weight already.
        let (planes, own) = if k == 0 {
            (&self.setup.top_own, T::zero())
        } else {
            (&frame.received, units.own.clone())
        };
        let weight = own.clone() + &own + own;
        let [a, b, c] = planes;
        let sums = a.iter().zip(b).zip(c);
        let sums = sums.map(|((a, b), c)| a.clone() + b + c + &weight);
        self.normals.clear();
        self.normals.extend(sums);
        let ends = extremes(&self.normals).ok_or_else(|| bug("a layer has a sphere"))?;
        let count = listed.len() as u64;
        let kinds = [
            (true, &mut self.walk.all, &mut frame.all),
            (state.stands, &mut self.walk.standing, &mut frame.standing),
        ];
        for (_, counted, continuations) in kinds.into_iter().filter(|(is_counted, ..)| *is_counted)
        {
            let counted = counted.get_mut(state.faults).ok_or_else(too_many_faults)?;
            continuations.add(state.faults, count, listed.start)?;
            counted.add_base(
                &self.normals,
                &units.normal_width,
                &ends,
                count,
                &self.signs,
            )?;
        }
        if state.held {
            let held = self.walk.held.get_mut(state.faults);
            *held.ok_or_else(too_many_faults)? += count;
        }
        Ok(())
    }
}

fn frame<T>(frames: &mut [Frame<T>], k: usize) -> Result<&mut Frame<T>, Error> {
    frames.get_mut(k).ok_or_else(missing_frame)
}

fn missing_frame() -> Error {
    bug("there is a frame for each layer")
}
