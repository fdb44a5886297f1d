//! Unequal spheres, against piles that are built again.

use std::collections::BTreeMap;
use std::ops::{Add, Mul, Sub};

use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::scalar::{FixedRational, Interval, Surd};
use cannonpile::shape::Selection;
use cannonpile::{Error, Packing, Pile, ratio};
use cannonpile_stability::{sensitivity, spread};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};

/// A number with 60 decimal places.
#[derive(Clone, Debug, Default)]
struct Fixed(BigInt);

impl Fixed {
    fn scale() -> BigInt {
        BigInt::from(10).pow(60)
    }

    fn of(x: &BigRational) -> Self {
        Self(x.numer() * Self::scale() / x.denom())
    }

    /// Rounds c√r.
    fn of_surd(x: &Surd) -> Self {
        let root = Self::of(&x.square()).root();
        Self(root.0 * x.coefficient().signum().to_integer())
    }

    fn root(&self) -> Self {
        Self((&self.0 * Self::scale()).sqrt())
    }

    fn over(&self, divisor: &Self) -> Self {
        Self(&self.0 * Self::scale() / &divisor.0)
    }
}

impl Add for &Fixed {
    type Output = Fixed;
    fn add(self, other: Self) -> Fixed {
        Fixed(&self.0 + &other.0)
    }
}

impl Sub for &Fixed {
    type Output = Fixed;
    fn sub(self, other: Self) -> Fixed {
        Fixed(&self.0 - &other.0)
    }
}

impl Mul for &Fixed {
    type Output = Fixed;
    fn mul(self, other: Self) -> Fixed {
        Fixed(&self.0 * &other.0 / Fixed::scale())
    }
}

type V = [Fixed; 3];

fn plus(a: &V, b: &V) -> V {
    [0, 1, 2].map(|n: usize| &a[n] + &b[n])
}

fn minus(a: &V, b: &V) -> V {
    [0, 1, 2].map(|n: usize| &a[n] - &b[n])
}

fn times(a: &V, factor: &Fixed) -> V {
    [0, 1, 2].map(|n: usize| &a[n] * factor)
}

fn dot(a: &V, b: &V) -> Fixed {
    (0..3).fold(Fixed::default(), |sum, n| &sum + &(&a[n] * &b[n]))
}

fn cross(a: &V, b: &V) -> V {
    [(1, 2), (2, 0), (0, 1)].map(|(m, n): (usize, usize)| &(&a[m] * &b[n]) - &(&a[n] * &b[m]))
}

/// The solution of three equations row·x = value.
fn solve([a, b, c]: &[V; 3], values: &V) -> V {
    let determinant = dot(a, &cross(b, c));
    let parts = [cross(b, c), cross(c, a), cross(a, b)];
    let terms = (0..3).map(|m| times(&parts[m], &values[m]));
    let sum = terms.fold(V::default(), |sum, term| plus(&sum, &term));
    sum.map(|x| x.over(&determinant))
}

/// Returns the contact forces of a pile in which one sphere has another radius, in newtons for mg = 1 and R = 1.
///
/// Newton's method places each sphere on its three supports, from the bottom up. Then each sphere is balanced, from the
/// top down.
fn rebuilt(
    packing: &Packing<'_>,
    grown: Site,
    delta: &BigRational,
) -> BTreeMap<(Site, Direction), Fixed> {
    let pile = packing.pile();
    let (shape, floor) = (pile.shape(), pile.layers() - 1);
    let radius = |site: Site| {
        Fixed::of(&if site == grown {
            ratio!(1) + delta
        } else {
            ratio!(1)
        })
    };
    let sites: Vec<Site> = pile.sites(Selection::All).unwrap().collect();
    let mut places: BTreeMap<Site, V> = BTreeMap::new();
    for site in sites.iter().rev() {
        let mut place = packing.position(*site).unwrap().map(|x| Fixed::of_surd(&x));
        if site.k < floor {
            // Each step doubles the number of right digits.
            for _ in 0..8 {
                let supports =
                    Direction::ALL.map(|direction| shape.below(*site, direction).unwrap());
                let arms = supports.map(|support| minus(&place, &places[&support]));
                let gaps = [0, 1, 2].map(|n: usize| {
                    let length = &radius(*site) + &radius(supports[n]);
                    &(&length * &length) - &dot(&arms[n], &arms[n])
                });
                let step = solve(&arms.map(|arm| plus(&arm, &arm)), &gaps);
                place = plus(&place, &step);
            }
        }
        places.insert(*site, place);
    }
    // tanθ and √3 tanθ at a = 6/5 R.
    let horizontal = [ratio!(12 / 13), ratio!(36 / 13)].map(|square| Fixed::of(&square).root());
    let mut forces = BTreeMap::new();
    for site in sites.iter().filter(|site| site.k < floor) {
        let load = pile.total_load(*site);
        let mut acting = [Fixed::default(), Fixed::default(), Fixed::of(&-load.down)];
        for (n, part) in [load.x, load.y].into_iter().enumerate() {
            acting[n] = &Fixed::of(&part) * &horizontal[n];
        }
        let unit = |upper: Site, lower: Site| {
            let arm = minus(&places[&upper], &places[&lower]);
            let length = dot(&arm, &arm).root();
            arm.map(|x| x.over(&length))
        };
        for direction in Direction::ALL {
            if let Some(above) = shape.above(*site, direction) {
                let pushed = times(&unit(above, *site), &forces[&(above, direction)]);
                acting = minus(&acting, &pushed);
            }
        }
        let below =
            Direction::ALL.map(|direction| unit(*site, shape.below(*site, direction).unwrap()));
        // Σ f_m e_m = −acting, by components.
        let rows = [0, 1, 2].map(|n: usize| [0, 1, 2].map(|m: usize| below[m][n].clone()));
        let found = solve(&rows, &acting.map(|x| &Fixed::default() - &x));
        for (direction, force) in Direction::ALL.into_iter().zip(found) {
            forces.insert((*site, direction), force);
        }
    }
    forces
}

#[test]
fn changes_of_forces_are_those_of_piles_built_again() {
    let delta = BigRational::new(1.into(), BigInt::from(10).pow(15));
    let small = BigRational::new(1.into(), BigInt::from(10).pow(20));
    for (top, stacking) in [
        (Region::SITE, "+++++"),
        (Region::SITE, "+-+"),
        (Region::hexagon(2, 1).unwrap(), "-++-"),
    ] {
        let pile = Pile::under(top, stacking.parse().unwrap()).unwrap();
        let pile = pile.with_load(Site::new(0, 0, 1), ratio!(1)).unwrap();
        let leaning = pile
            .clone()
            .with_tilt([ratio!(1 / 20), ratio!(-1 / 30)])
            .unwrap();
        for pile in [pile, leaning] {
            let packing = Packing::new(&pile, &"6/5".parse().unwrap()).unwrap();
            let unit = Fixed::of_surd(&packing.unit_force());
            for grown in pile.sites(Selection::All).unwrap().step_by(7) {
                let [more, less] =
                    [delta.clone(), -&delta].map(|delta| rebuilt(&packing, grown, &delta));
                let exact = sensitivity::<BigRational>(&packing, grown).unwrap();
                let floats = sensitivity::<f64>(&packing, grown).unwrap();
                for (exact, float) in exact.into_iter().zip(floats) {
                    let contact = (exact.site, exact.direction);
                    let difference = (&more[&contact] - &less[&contact]).over(&unit);
                    let slope =
                        BigRational::new(difference.0, Fixed::scale()) / (ratio!(2) * &delta);
                    let bound = &small * (ratio!(1) + exact.change.abs());
                    assert!((slope - &exact.change).abs() < bound, "{grown} {contact:?}");
                    let change = exact.change.to_f64().unwrap();
                    assert!((float.change - change).abs() < 1e-10 * (1.0 + change.abs()));
                }
            }
        }
    }
}

/// The largest standard deviation over force of straight piles at a = 1.2 R.
#[test]
fn spreads_of_straight_piles() {
    for (layers, known) in [(4, 6.4), (6, 13.0), (8, 21.0)] {
        let pile = Pile::triangular(layers).unwrap();
        let packing = Packing::new(&pile, &"6/5".parse().unwrap()).unwrap();
        let spread = spread::<f64>(&packing).unwrap().unwrap();
        let relative = spread.variance.sqrt() / spread.force;
        assert!((relative - known).abs() < 0.5, "{layers} {relative}");
        let bearable = spread.bearable_squared().unwrap().sqrt();
        assert!((bearable * 3.0 * relative - 1.0).abs() < 1e-12);
    }
    let pile = Pile::triangular(3).unwrap();
    let packing = Packing::new(&pile, &"6/5".parse().unwrap()).unwrap();
    let exact = spread::<BigRational>(&packing).unwrap().unwrap().variance;
    assert!(!exact.is_zero());
    let rounded = spread::<f64>(&packing).unwrap().unwrap().variance;
    assert!((exact.to_f64().unwrap() - rounded).abs() < 1e-9);
}

/// The sums of squares exceed the scalar, or the intervals of equal ratios overlap. None of them names a contact.
#[test]
fn a_scalar_that_cannot_compare_gives_no_spread() {
    let pile = Pile::triangular(6).unwrap();
    let packing = Packing::new(&pile, &"6/5".parse().unwrap()).unwrap();
    let fixed = spread::<FixedRational<i32>>(&packing);
    assert!(matches!(fixed, Err(Error::Overflow { .. })), "{fixed:?}");
    let interval = spread::<Interval>(&packing);
    assert!(
        matches!(interval, Err(Error::Overflow { .. })),
        "{interval:?}"
    );
}

/// A contact whose force no radius changes is not the one that opens first, and an unstable pile has no such contact.
#[test]
fn spreads_of_other_piles() {
    let spread_of = |pile: Pile| {
        let packing = Packing::new(&pile, &"6/5".parse().unwrap()).unwrap();
        spread::<BigRational>(&packing).unwrap()
    };
    let load = |pile: Pile| {
        pile.with_load(Site { i: 0, j: 0, k: 1 }, ratio!(1))
            .unwrap()
    };
    let below = spread_of(load(Pile::triangular(3).unwrap().weightless())).unwrap();
    assert_eq!((below.site.k, below.force), (1, ratio!(1)));
    let hcp = Pile::under(Region::SITE, "+-+-+".parse().unwrap()).unwrap();
    assert_eq!(spread_of(hcp), None);
    assert_eq!(spread_of(Pile::triangular(1).unwrap()), None);
    assert_eq!(spread_of(Pile::triangular(3).unwrap().weightless()), None);
}

/// If all spheres grow alike, the pile keeps its shape only if the floor grows too. In a pile of discs every force has a
/// change of zero for a sphere that it does not depend on.
#[test]
fn discs_change_by_their_own_rule() {
    let pile = Pile::discs(4).unwrap();
    let packing = Packing::new(&pile, &"6/5".parse().unwrap()).unwrap();
    let changes = sensitivity::<BigRational>(&packing, Site::APEX).unwrap();
    // A larger apex is lifted straight up, so its two contacts steepen alike.
    let apex: Vec<_> = changes
        .iter()
        .filter(|change| change.site == Site::APEX)
        .collect();
    assert_eq!(apex.len(), 2);
    assert_eq!(apex[0].change, apex[1].change);
    assert!(apex[0].change < ratio!(0));
}
