//! Piles so high that only trees reach their floor: as small ones foretell.

use std::collections::BTreeMap;

use cannonpile::lattice::{Region, Sign};
use cannonpile::shape::Selection;
use cannonpile::stacking::{Run, Stacking};
use cannonpile::{Method, Pile};
use num_rational::BigRational;

use cannonpile_testkit::cases::{Bounds, Case};
use cannonpile_testkit::oracles::balance::{Forces, Place, ratio, site};

const HIGH: i128 = 10_i128.pow(30);

/// A pile of a few steps and a long last run, on a random or named top.
struct High {
    top: Bounds,
    head: &'static str,
    /// The sign of the last run.
    last: char,
    loads: Vec<(Place, BigRational)>,
}

impl High {
    fn oracle(&self, last: i128) -> Case {
        let run = self.last.to_string().repeat(usize::try_from(last).unwrap());
        self.with_loads(Case::under(&self.top, &format!("{}{run}", self.head)))
    }

    fn with_loads(&self, case: Case) -> Case {
        let loads = self.loads.iter();
        loads.fold(case, |case, (at, load)| case.with_load(*at, load))
    }

    fn pile(&self, last: i128) -> Pile {
        let sign = |sign| if sign == '+' { Sign::Plus } else { Sign::Minus };
        let head = self.head.chars().map(|c| Run {
            sign: sign(c),
            steps: 1,
        });
        let last = Run {
            sign: sign(self.last),
            steps: last,
        };
        let stacking = Stacking::from_runs(head.chain([last])).unwrap();
        let pile = Pile::under(self.top.region(), stacking).unwrap();
        let loads = self.loads.iter();
        loads.fold(pile, |pile, (at, load)| {
            pile.with_load(site(*at), load.clone()).unwrap()
        })
    }
}

/// Some bottom spheres that move evenly over the base as the last run grows: `start + t·along` below `t·steps` steps.
#[derive(Clone, Copy)]
struct Way {
    start: [i128; 2],
    along: [i128; 2],
    steps: i128,
}

impl Way {
    fn at(&self, high: &High, t: i128) -> Place {
        let head = i128::try_from(high.head.len()).unwrap();
        let sign = if high.last == '+' { 1 } else { -1 };
        let [i, j] = [0, 1].map(|axis| self.start[axis] + sign * self.along[axis] * t);
        (head + self.steps * t, j, i)
    }
}

/// t of the small piles: high enough for the head to be out of the way, but for lines that never leave it.
const SMALL: [i128; 3] = [7, 8, 9];

/// Lines count up: on such a way forces grow evenly. So two small piles of the oracle foretell a pile of any height; a
/// third checks it. False if the way leads outside.
fn grows_evenly(high: &High, small: &BTreeMap<i128, Forces>, way: Way) -> bool {
    let of_small = SMALL.map(|t| {
        let (known, at) = (&small[&(way.steps * t)], way.at(high, t));
        let both = known.above.get(&at).zip(known.floor.get(&at));
        both.map(|(above, floor)| [above.clone(), floor.clone()].concat())
    });
    let [Some(first), Some(second), Some(third)] = of_small else {
        return false;
    };
    let foretold = |t: i128| -> Vec<BigRational> {
        let growth = first.iter().zip(&second);
        let t = BigRational::from_integer((t - SMALL[0]).into());
        growth.map(|(a, b)| a + (b - a) * &t).collect()
    };
    assert_eq!(foretold(SMALL[2]), third, "{} {:?}", high.head, way.start);
    for t in [40, HIGH] {
        let (pile, at) = (high.pile(way.steps * t), site(way.at(high, t)));
        let forces = pile.forces::<BigRational>();
        let floor = forces.on_floor(at).unwrap();
        let floor = [floor.normal, floor.shear_x, floor.shear_y];
        let answers = [forces.from_above(at).unwrap(), floor].concat();
        assert_eq!(answers, foretold(t), "{} {at}", high.head);
    }
    true
}

#[test]
fn a_pile_of_a_nonillion_layers_is_as_small_ones_foretell() {
    let mut compared = 0;
    for (head, last) in [("++-", '+'), ("+-", '+'), ("--+", '-'), ("-+-+", '-')] {
        let loads = vec![((1, 0, 0), ratio(7, 3)), ((2, 0, 0), ratio(1, 5))];
        for (top, loads) in [(Bounds::SITE, Vec::new()), (Bounds::hexagon(2, 2), loads)] {
            let high = High {
                top,
                head,
                last,
                loads,
            };
            let runs = [1, 2, 3]
                .into_iter()
                .flat_map(|steps| SMALL.map(|t| steps * t));
            let small = runs
                .map(|run| (run, high.oracle(run).balance.forces()))
                .collect();
            let ways = [
                ([0, 0], 1),
                ([1, 0], 1),
                ([0, 1], 1),
                ([1, 0], 2),
                ([0, 1], 2),
                ([1, 1], 2),
                ([1, 1], 3),
            ];
            for start in [[0, 0], [1, 0], [0, 1], [-1, 1], [1, -1]] {
                for (along, steps) in ways {
                    let way = Way {
                        start,
                        along,
                        steps,
                    };
                    compared += u32::from(grows_evenly(&high, &small, way));
                }
            }
        }
    }
    assert!(compared > 200, "{compared}");
}

#[test]
fn the_verdict_of_a_high_pile_is_that_of_its_first_layers() {
    for (head, last) in [
        ("++-", '+'),
        ("+-+", '-'),
        ("+-+-", '+'),
        ("++--", '+'),
        ("+++", '-'),
    ] {
        let high = High {
            top: Bounds::SITE,
            head,
            last,
            loads: Vec::new(),
        };
        let (pile, small) = (high.pile(HIGH), high.oracle(2));
        cannonpile_testkit::compare::standing(&pile, &small.balance.forces()).unwrap();
    }
}

#[test]
fn a_straight_pile_of_a_nonillion_layers_upon_one_as_high() {
    // Of the upper part by the paper's closed form; turned; and counted on.
    let (upper, lower) = (HIGH, HIGH / 10);
    let pile = Pile::under(Region::SITE, format!("({upper},{lower})").parse().unwrap()).unwrap();
    assert_eq!(pile.plan(Selection::Base).unwrap().method, Method::Tree);
    let forces = pile.forces::<BigRational>();
    let big = |n: i128| BigRational::from_integer(n.into());
    let passed_on = |i: i128, j: i128, m: usize| {
        let g = [upper - i - j, i, j];
        let sum: i128 = g.iter().sum();
        big(1) + big(2 * sum - 3 * g[m]) / big(3)
    };
    for (i, j) in [
        (0, 0),
        (HIGH / 3, HIGH / 3),
        (HIGH / 2, 17),
        (12_345, HIGH / 7),
    ] {
        let bottom = site((upper + lower, j, i));
        let starts = [(i, j), (i + lower, j), (i, j + lower)];
        let expected = [0, 1, 2].map(|m| {
            let (i, j) = starts[m];
            passed_on(i, j, m) + big(lower - 1)
        });
        assert_eq!(forces.from_above(bottom), Ok(expected));
    }
}

#[test]
fn rows_longer_than_one_tree_are_those_of_single_spheres() {
    let pile = Pile::under(Region::SITE, format!("(2,1,{HIGH})").parse().unwrap()).unwrap();
    let forces = pile.forces::<BigRational>();
    assert_eq!(pile.plan(Selection::Base).unwrap().method, Method::Tree);
    for force in forces.base(Selection::Base).unwrap().take(2500) {
        let force = force.unwrap();
        assert_eq!(forces.on_floor(force.site), Ok(force));
    }
    let contacts = forces.contacts(Selection::Layer(HIGH / 2)).unwrap();
    for contact in contacts.take(3 * 2500) {
        let contact = contact.unwrap();
        assert_eq!(
            forces.contact(contact.site, contact.direction),
            Ok(contact.force)
        );
    }
}
