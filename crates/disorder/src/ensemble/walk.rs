//! All stackings of a part, beginning by beginning: what they have in common is computed once.
//!
//! The forces below layer k depend on the first k + 1 signs. So the walk goes down sign by sign, + before −, and counts the
//! forces below a layer once for all stackings that begin so. How many of them have how many faults is known beforehand
//! where every one of them belongs to the part: C(r, j) have j more, with r signs left. Of these beginnings the counts are
//! kept by layer and by faults so far, and spread at the end. Of others, and of those that stand, they are counted
//! as the walk comes back up.

use cannonpile::lattice::{Region, Sign};
use num_integer::binomial;

use super::count::{Counted, Forces, Level};
use super::layer::{Numerator, Places, Planes, extremes, hand_down, pass_on, turn};
use super::part::{Onward, Part, Walked, completed, signs_of};
use super::setup::Setup;
use super::survivors::Survivors;
use crate::Error;
use crate::error::bug;

/// What a walk has counted, by faults.
pub(super) struct Walk<T> {
    pub(super) all: Vec<Counted<T>>,
    pub(super) standing: Vec<Counted<T>>,
    /// How many stand with horizontal contacts, where that is asked.
    pub(super) held: Vec<u64>,
}

/// A layer of the beginning that the walk is at.
struct Frame<T> {
    region: Region,
    places: Places,
    level: Level,
    received: Planes<T>,
    forces: Planes<T>,
    onward: Onward,
    standing: Onward,
}

/// What is known of a beginning.
#[derive(Clone, Copy)]
struct State {
    faults: usize,
    /// No contact pulls.
    stands: bool,
    /// It stands with horizontal contacts.
    held: bool,
}

struct Walker<'s, T, E> {
    setup: &'s Setup<T>,
    survivors: Option<&'s Survivors<'s, E>>,
    walked: &'s Walked,
    frames: Vec<Frame<T>>,
    signs: Vec<Sign>,
    /// Of beginnings of which all stackings are walked: by layer, and by faults so far.
    whole: Vec<Vec<Forces<T>>>,
    one_layer: Forces<T>,
    normals: Vec<T>,
    walk: Walk<T>,
}

/// Walks stackings, and returns what was counted.
pub(super) fn walk<T: Numerator, E: From<Error>>(
    setup: &Setup<T>,
    survivors: Option<&Survivors<'_, E>>,
    walked: &Walked,
) -> Result<Walk<T>, E> {
    let kinds = setup.powers.len();
    let onward = Onward(vec![(0, 0); kinds]);
    let frame = || {
        Ok(Frame {
            region: setup.top,
            places: Places::of(&setup.top)?,
            level: Level::default(),
            received: [Vec::new(), Vec::new(), Vec::new()],
            forces: [Vec::new(), Vec::new(), Vec::new()],
            onward: onward.clone(),
            standing: onward.clone(),
        })
    };
    let frames: Result<Vec<_>, Error> = (0..=setup.steps).map(|_| frame()).collect();
    let layers = match walked {
        Walked::Range(_) => setup.steps,
        Walked::Listed(_) => 0,
    };
    let mut walker = Walker {
        setup,
        survivors,
        walked,
        frames: frames?,
        signs: Vec::with_capacity(setup.steps),
        whole: (0..layers).map(|k| vec![Forces::new(); k + 1]).collect(),
        one_layer: Forces::new(),
        normals: Vec::new(),
        walk: Walk {
            all: vec![Counted::new(); kinds],
            standing: vec![Counted::new(); kinds],
            held: vec![0; kinds],
        },
    };
    let part = match walked {
        Walked::Range(range) => Part::Range {
            base: 0,
            size: setup
                .order
                .total()
                .ok_or_else(|| bug("what is walked in order has places"))?,
            start: range.start,
            end: range.end,
        },
        Walked::Listed(list) => Part::Listed {
            from: 0,
            to: list.len(),
        },
    };
    let state = State {
        faults: 0,
        stands: true,
        held: true,
    };
    walker.visit(0, part, state)?;
    walker.spread()?;
    Ok(walker.walk)
}

impl<T: Numerator, E: From<Error>> Walker<'_, T, E> {
    /// Walks what goes on from a beginning of k signs.
    fn visit(&mut self, k: usize, part: Part, state: State) -> Result<(), E> {
        let frame = frame(&mut self.frames, k)?;
        frame.onward.clear();
        frame.standing.clear();
        if k == self.setup.steps {
            return Ok(self.base(k, part, state)?);
        }
        for sign in [Sign::Plus, Sign::Minus] {
            let next = part.going_on(self.walked, &self.setup.order, k, sign)?;
            if let Some(next) = next {
                self.step(k, sign, next, state)?;
            }
        }
        Ok(())
    }

    /// Takes one step more, and walks what goes on from there.
    fn step(&mut self, k: usize, sign: Sign, part: Part, state: State) -> Result<(), E> {
        self.signs.truncate(k);
        let last = self.signs.last().copied();
        self.signs.push(sign);
        let changes = last.is_some_and(|last| last != sign);
        let faults = state.faults + usize::from(changes);
        let setup = self.setup;
        let above = frame(&mut self.frames, k)?;
        match last {
            None => above.forces.clone_from(&setup.top_own),
            Some(_) if changes => turn(&above.received, setup.own(faults)?, &mut above.forces),
            Some(_) => pass_on(&above.received, setup.own(faults)?, &mut above.forces),
        }
        let ends = extremes(above.forces.iter().flatten());
        let ends = ends.ok_or_else(|| bug("a layer has a sphere"))?;
        let stands = state.stands && ends[0] >= T::zero();
        // The signs do not stand without horizontal contacts, where this is called.
        let is_held = || match self.survivors {
            Some(survivors) => survivors.contains(&self.signs),
            None => Ok(false),
        };
        // What stands does so with its last step repeated, and only if its beginnings do.
        let held = state.held && (stands || last == Some(sign) || is_held()?);
        let width = setup.width(faults)?;
        let is_whole = part.is_whole();
        if is_whole {
            let by_faults = self.whole.get_mut(k);
            let forces = by_faults.and_then(|by_faults| by_faults.get_mut(faults));
            let forces = forces.ok_or_else(|| bug("no more faults than steps"))?;
            forces.meet_layer(&above.forces, width, &ends, &above.level, &self.signs)?;
        }
        self.hand_down(k, sign)?;
        let state = State {
            faults,
            stands,
            held,
        };
        self.visit(k + 1, part, state)?;
        self.signs.truncate(k + 1);

        let (frames, below) = self.frames.split_at_mut(k + 1);
        let pair = frames.last_mut().zip(below.first());
        let (above, below) = pair.ok_or_else(missing_frame)?;
        if !is_whole || stands {
            let one = &mut self.one_layer;
            one.clear();
            one.meet_layer(&above.forces, width, &ends, &above.level, &self.signs)?;
        }
        let kinds = [
            (!is_whole, &below.onward, &mut self.walk.all),
            (stands, &below.standing, &mut self.walk.standing),
        ];
        for (is_wanted, onward, counted) in kinds {
            if !is_wanted {
                continue;
            }
            for (total, count, first) in onward.entries() {
                let counted = counted.get_mut(total).ok_or_else(too_many_faults)?;
                let scale = setup.power(total - faults)?;
                let signs = signs_of(&setup.order, self.walked, first)?;
                let complete = |_: &[Sign]| signs.clone();
                counted
                    .forces
                    .absorb(&self.one_layer, count, scale, complete)?;
            }
        }
        above.onward.add(&below.onward);
        above.standing.add(&below.standing);
        Ok(())
    }

    /// Hands the forces below layer k to the next layer.
    fn hand_down(&mut self, k: usize, sign: Sign) -> Result<(), Error> {
        let (frames, rest) = self.frames.split_at_mut(k + 1);
        let pair = frames.last().zip(rest.first_mut());
        let (above, below) = pair.ok_or_else(missing_frame)?;
        below.region = above.region.dilated(sign)?;
        below.places.become_those_of(&below.region)?;
        below.level = above.level.next(below.places.spheres() as u128);
        hand_down(
            &above.forces,
            &above.places,
            sign,
            &below.places,
            &mut below.received,
        )
    }

    /// Counts the base of a stacking.
    fn base(&mut self, k: usize, part: Part, state: State) -> Result<(), Error> {
        let setup = self.setup;
        let State { faults, stands, .. } = state;
        let frame = frame(&mut self.frames, k)?;
        // Paper, (13): three times the normal force in mg is what comes down and three times the weight.
        self.normals.clear();
        if k == 0 {
            let [a, b, c] = &setup.top_own;
            let sums = a.iter().zip(b).zip(c).map(|((a, b), c)| a.clone() + b + c);
            self.normals.extend(sums);
        } else {
            let own = setup.own(faults)?;
            let weight = own.clone() + own + own;
            let [a, b, c] = &frame.received;
            let above = a.iter().zip(b).zip(c).map(|((a, b), c)| a.clone() + b + c);
            self.normals.extend(above.map(|above| above + &weight));
        }
        let ends = extremes(&self.normals).ok_or_else(|| bug("a layer has a sphere"))?;
        let width = setup.normal_width(faults)?;
        let (count, first) = part.entry();
        let meet = |counted: &mut Vec<Counted<T>>, onward: &mut Onward| {
            let counted = counted.get_mut(faults).zip(onward.0.get_mut(faults));
            let (counted, entry) = counted.ok_or_else(too_many_faults)?;
            *entry = (count, first);
            counted.meet_base(&self.normals, width, &ends, count, &self.signs)
        };
        meet(&mut self.walk.all, &mut frame.onward)?;
        if stands {
            meet(&mut self.walk.standing, &mut frame.standing)?;
        }
        if state.held {
            let held = self.walk.held.get_mut(faults);
            *held.ok_or_else(too_many_faults)? += count;
        }
        Ok(())
    }

    /// Spreads what was counted of whole beginnings over the stackings that go on from them.
    fn spread(&mut self) -> Result<(), Error> {
        let setup = self.setup;
        for (k, by_faults) in self.whole.iter().enumerate() {
            let left = setup.steps - 1 - k;
            for (faults, forces) in by_faults.iter().enumerate() {
                if forces.layers == 0 {
                    continue;
                }
                for more in 0..=left {
                    let counted = self.walk.all.get_mut(faults + more);
                    let counted = counted.ok_or_else(too_many_faults)?;
                    // Below 2⁶²: it is at most the number of stackings.
                    let count = binomial(left as u64, more as u64);
                    let complete = |signs: &[Sign]| completed(signs, left, more);
                    let scale = setup.power(more)?;
                    counted.forces.absorb(forces, count, scale, complete)?;
                }
            }
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

fn too_many_faults() -> Error {
    bug("a stacking has no more faults than signs that can change")
}
