//! Piles so high that only trees can compute the forces at the base. Extrapolation from small piles predicts them.

use std::collections::BTreeMap;

use cannonpile::lattice::{Region, Sign};
use cannonpile::shape::Selection;
use cannonpile::stacking::{Run, Stacking};
use cannonpile::{Method, Pile};
use num_rational::BigRational;

use cannonpile_testkit::cases::{Bounds, Case};
use cannonpile_testkit::oracles::balance::{Forces, Place, ratio, site};

const HIGH: i128 = 10_i128.pow(30);

/// A pile of a few steps and a long last run, under a given top layer.
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

/// A path of bottom spheres while the last run grows: `start + t·along` after `t·steps` steps of that run.
#[derive(Clone, Copy)]
struct Path {
    start: [i128; 2],
    along: [i128; 2],
    steps: i128,
}

impl Path {
    fn at(&self, high: &High, t: i128) -> Place {
        let head = i128::try_from(high.head.len()).unwrap();
        let sign = if high.last == '+' { 1 } else { -1 };
        let [i, j] = [0, 1].map(|axis| self.start[axis] + sign * self.along[axis] * t);
        (head + self.steps * t, j, i)
    }
}

/// The values of t for the small piles. The head has no influence at these heights, except on lines that never leave it.
const SMALL: [i128; 3] = [7, 8, 9];

/// Checks the forces along a path. They are affine in t, because each sphere adds a constant increment to its lines. So
/// two small piles of the oracle predict a pile of any height, and a third checks the prediction. Returns false if the
/// path leaves the base.
fn grows_evenly(high: &High, small: &BTreeMap<i128, Forces>, path: Path) -> bool {
    let of_small = SMALL.map(|t| {
        let (known, at) = (&small[&(path.steps * t)], path.at(high, t));
        let both = known.above.get(&at).zip(known.floor.get(&at));
        both.map(|(above, floor)| [above.clone(), floor.clone()].concat())
    });
    let [Some(first), Some(second), Some(third)] = of_small else {
        return false;
    };
    let predicted = |t: i128| -> Vec<BigRational> {
        let growth = first.iter().zip(&second);
        let t = BigRational::from_integer((t - SMALL[0]).into());
        growth.map(|(a, b)| a + (b - a) * &t).collect()
    };
    assert_eq!(predicted(SMALL[2]), third, "{} {:?}", high.head, path.start);
    for t in [40, HIGH] {
        let (pile, at) = (high.pile(path.steps * t), site(path.at(high, t)));
        let forces = pile.forces::<BigRational>();
        let floor = forces.on_floor(at).unwrap();
        let floor = [floor.normal, floor.shear_x, floor.shear_y];
        let answers = [forces.from_above(at).unwrap(), floor].concat();
        assert_eq!(answers, predicted(t), "{} {at}", high.head);
    }
    true
}

#[test]
fn small_piles_predict_a_pile_of_a_nonillion_layers() {
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
            let paths = [
                ([0, 0], 1),
                ([1, 0], 1),
                ([0, 1], 1),
                ([1, 0], 2),
                ([0, 1], 2),
                ([1, 1], 2),
                ([1, 1], 3),
            ];
            for start in [[0, 0], [1, 0], [0, 1], [-1, 1], [1, -1]] {
                for (along, steps) in paths {
                    let path = Path {
                        start,
                        along,
                        steps,
                    };
                    compared += u32::from(grows_evenly(&high, &small, path));
                }
            }
        }
    }
    assert!(compared > 200, "{compared}");
}

#[test]
fn the_first_layers_decide_the_verdict_on_a_high_pile() {
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
fn a_sign_change_between_two_very_high_runs() {
    // The upper part by the paper's closed form, then a half-turn, then the increments of the lower part.
    let (upper, lower) = (HIGH, HIGH / 10);
    let pile = Pile::under(Region::SITE, format!("({upper},{lower})").parse().unwrap()).unwrap();
    assert_eq!(pile.plan(Selection::Base).unwrap().method, Method::Tree);
    let forces = pile.forces::<BigRational>();
    let big = |n: i128| BigRational::from_integer(n.into());
    let transmitted = |i: i128, j: i128, m: usize| {
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
            transmitted(i, j, m) + big(lower - 1)
        });
        assert_eq!(forces.from_above(bottom), Ok(expected));
    }
}

#[test]
fn long_rows_by_trees_equal_single_spheres() {
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
