//! Tallies of ensembles by plain enumeration: every stacking is built as a pile, and each force is a separate query.

use std::collections::BTreeMap;

use cannonpile::Pile;
use cannonpile::lattice::{Sign, Site};
use cannonpile::shape::{Anchor, Selection};
use cannonpile::stacking::Stacking;
use cannonpile_disorder::{
    Distribution, Ensemble, Error, Extreme, FirstSign, Histogram, RandomStackings, Tally,
};
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive};

/// A force, and the signs of its stacking.
type Found = Option<(BigRational, String)>;

/// The contents of a distribution, from a plain enumeration.
#[derive(Debug, Default, PartialEq)]
pub struct Counted {
    /// The number of stackings that the base does not support.
    left_out: u64,
    stackings: u64,
    contacts: u64,
    sum: BigRational,
    sum_of_squares: BigRational,
    forces: BTreeMap<i64, u64>,
    least: Found,
    greatest: Found,
    normals: BTreeMap<i64, u64>,
    least_normal: Found,
    greatest_normal: Found,
}

impl Counted {
    /// Adds a pile. Its stacking must come after all earlier ones.
    pub fn add(&mut self, pile: &Pile, signs: &str, width: &BigRational) -> Result<(), Error> {
        let forces = pile.forces::<BigRational>();
        let bin = |x: &BigRational| (x / width).floor().to_integer().to_i64().unwrap();
        self.stackings += 1;
        for contact in forces.contacts(Selection::All)? {
            let force = contact?.force;
            *self.forces.entry(bin(&force)).or_default() += 1;
            self.contacts += 1;
            self.sum += &force;
            self.sum_of_squares += &force * &force;
            better(&mut self.least, &force, signs, |new, old| new < old);
            better(&mut self.greatest, &force, signs, |new, old| new > old);
        }
        for force in forces.base(Selection::Base)? {
            let normal = force?.normal;
            *self.normals.entry(bin(&normal)).or_default() += 1;
            better(&mut self.least_normal, &normal, signs, |new, old| new < old);
            better(&mut self.greatest_normal, &normal, signs, |new, old| {
                new > old
            });
        }
        Ok(())
    }

    /// The contents of a distribution of the library.
    fn of(distribution: &Distribution) -> Self {
        let bins = |histogram: &Histogram| {
            let counts = histogram.counts.iter().map(|n| n.to_u64().unwrap());
            let bins = (histogram.first..).zip(counts);
            bins.filter(|(_, count)| *count > 0).collect()
        };
        let found = |extreme: &Option<Extreme>| {
            let found = extreme.as_ref();
            found.map(|found| (found.force.clone(), text(found.stacking.signs())))
        };
        Self {
            left_out: 0,
            stackings: distribution.stackings.to_u64().unwrap(),
            contacts: distribution.contacts.to_u64().unwrap(),
            sum: distribution.sum.clone(),
            sum_of_squares: distribution.sum_of_squares.clone(),
            forces: bins(&distribution.forces),
            least: found(&distribution.least),
            greatest: found(&distribution.greatest),
            normals: bins(&distribution.normals),
            least_normal: found(&distribution.least_normal),
            greatest_normal: found(&distribution.greatest_normal),
        }
    }
}

fn better(
    best: &mut Found,
    force: &BigRational,
    signs: &str,
    is_better: impl Fn(&BigRational, &BigRational) -> bool,
) {
    if best.as_ref().is_none_or(|(old, _)| is_better(force, old)) {
        *best = Some((force.clone(), signs.to_owned()));
    }
}

/// The signs as text.
pub fn text(signs: impl Iterator<Item = Sign>) -> String {
    signs.map(Sign::symbol).collect()
}

/// All sequences of `steps` signs, in order.
pub fn all_signs(steps: u32, first: FirstSign) -> Vec<Vec<Sign>> {
    let all = (0..1_u32 << steps).map(|bits| {
        let signs = (0..steps).rev().map(|bit| match bits >> bit & 1 {
            0 => Sign::Plus,
            _ => Sign::Minus,
        });
        signs.collect::<Vec<_>>()
    });
    let begins = |signs: &Vec<Sign>| {
        signs
            .first()
            .is_none_or(|sign| first.signs().contains(sign))
    };
    all.filter(begins).collect()
}

/// A scene: the top layer with its loads or the base, and the weight.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The top layer, or the base.
    pub anchor: Anchor,
    /// Loads on sites of the top layer.
    pub loads: Vec<([i128; 2], BigRational)>,
    /// True if the spheres are weightless.
    pub weightless: bool,
    /// The first sign.
    pub first: FirstSign,
    /// The width of the bins.
    pub width: BigRational,
}

impl Scene {
    /// A scene under a top layer, with weight, without loads, and with bins of width 1/3.
    pub fn of(top: &str, first: FirstSign) -> Self {
        Self {
            anchor: Anchor::Top(top.parse().unwrap()),
            loads: Vec::new(),
            weightless: false,
            first,
            width: BigRational::new(1.into(), 3.into()),
        }
    }

    /// A scene on a base, with weight, without loads, and with bins of width 1/3.
    pub fn on(base: &str, first: FirstSign) -> Self {
        Self {
            anchor: Anchor::Base(base.parse().unwrap()),
            ..Self::of("hexagon:1", first)
        }
    }

    /// The ensemble in the library's type.
    pub fn ensemble(&self, steps: u32) -> Result<Ensemble, Error> {
        let stackings = RandomStackings::new(i128::from(steps) + 1, self.first)?;
        let ensemble = match self.anchor {
            Anchor::Top(top) => Ensemble::under(top, stackings)?,
            Anchor::Base(base) => Ensemble::on(base, stackings)?,
        };
        let mut ensemble = ensemble.with_bin_width(self.width.clone())?;
        for (at, load) in &self.loads {
            ensemble = ensemble.with_load(*at, load.clone())?;
        }
        Ok(if self.weightless {
            ensemble.weightless()
        } else {
            ensemble
        })
    }

    /// The pile of one stacking.
    pub fn pile(&self, signs: &[Sign]) -> Result<Pile, Error> {
        let stacking = Stacking::from_signs(signs.iter().copied())?;
        let mut pile = match self.anchor {
            Anchor::Top(top) => Pile::under(top, stacking)?,
            Anchor::Base(base) => Pile::on(base, stacking)?,
        };
        for ([i, j], load) in &self.loads {
            let site = Site { i: *i, j: *j, k: 0 };
            pile = pile.with_load(site, load.clone())?;
        }
        Ok(if self.weightless {
            pile.weightless()
        } else {
            pile
        })
    }

    /// The counts of all stackings and of the stable ones, by number of faults.
    pub fn counted(&self, steps: u32) -> Result<Vec<[Counted; 2]>, Error> {
        self.counted_of(steps, &all_signs(steps, self.first))
    }

    /// The counts of these stackings and of the stable ones among them, by number of faults.
    pub fn counted_of(
        &self,
        steps: u32,
        stackings: &[Vec<Sign>],
    ) -> Result<Vec<[Counted; 2]>, Error> {
        // The tally names the first stacking with an extreme force.
        let mut stackings = stackings.to_vec();
        stackings.sort_unstable();
        let mut counted = Vec::new();
        counted.resize_with(steps.max(1) as usize, <[Counted; 2]>::default);
        for signs in stackings {
            let faults = signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
            let [all, standing] = &mut counted[faults];
            let pile = match self.pile(&signs) {
                Err(Error::Core(cannonpile::Error::TooHigh { .. })) => {
                    all.left_out += 1;
                    continue;
                }
                pile => pile?,
            };
            let signs = text(signs.into_iter());
            all.add(&pile, &signs, &self.width)?;
            let mut contacts = pile.forces::<BigRational>().contacts(Selection::All)?;
            if contacts.all(|contact| !contact.unwrap().force.is_negative()) {
                standing.add(&pile, &signs, &self.width)?;
            }
        }
        Ok(counted)
    }
}

/// The counts of a tally for all stackings and for the stable ones, by number of faults.
pub fn counted(tally: &Tally) -> Vec<[Counted; 2]> {
    let faults = tally.faults.iter().enumerate();
    let both = faults.map(|(d, with)| {
        assert_eq!(with.faults as usize, d);
        let [mut all, standing] = [&with.all, &with.standing].map(Counted::of);
        all.left_out = with.left_out.as_ref().map_or(0, |n| n.to_u64().unwrap());
        [all, standing]
    });
    both.collect()
}
