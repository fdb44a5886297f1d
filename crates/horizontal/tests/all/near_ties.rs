//! Piles that are almost unstable, or almost stable: stability, bounds, the elastic state and the margin agree.

use cannonpile::lattice::{Region, Site};
use cannonpile::shape::Selection;
use cannonpile::{Load, Pile, ratio};
use cannonpile_horizontal::certificate::Claim;
use cannonpile_horizontal::{Error, base_bounds, bounds, elastic, equilibrium, margin};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Signed;

fn number(text: &str) -> BigRational {
    text.parse().unwrap()
}

fn loaded(pile: Pile, [i, j, k]: [i128; 3], [down, x, y]: [&str; 3]) -> Pile {
    let [down, x, y] = [down, x, y].map(number);
    pile.with_load(Site { i, j, k }, Load { down, x, y })
        .unwrap()
}

fn under(top: Region, stacking: &str) -> Pile {
    Pile::under(top, stacking.parse().unwrap()).unwrap()
}

fn squared(pile: &Pile) -> BigRational {
    margin(pile).unwrap().unwrap().squared
}

/// Returns whether the pile is stable, after a comparison of all answers at the given bottom spheres.
fn stands(pile: &Pile, step: usize) -> bool {
    let certificate = equilibrium(pile).unwrap();
    assert_eq!(certificate.check(), Ok(()), "{pile}");
    let stands = certificate.claim == Claim::Stands;
    let state = elastic(pile, &ratio!(1));
    let upright = margin(pile).unwrap();
    assert_eq!(upright.is_some(), stands, "{pile}");
    if pile.first_failure().unwrap().is_none() {
        assert!(stands, "{pile}");
    }
    let sites = pile.rows(Selection::Base).unwrap().flatten();
    if !stands {
        assert_eq!(state, Err(Error::CannotStand), "{pile}");
        for site in sites.step_by(step) {
            assert_eq!(bounds(pile, site), Err(Error::CannotStand), "{pile} {site}");
        }
        return false;
    }
    let state = state.unwrap();
    assert_eq!(state.certificate().unwrap().check(), Ok(()), "{pile}");
    let forces = state.pile().forces::<BigRational>();
    for site in sites.step_by(step) {
        let range = bounds(pile, site).unwrap();
        let normal = forces.on_floor(site).unwrap().normal;
        assert!(
            range.least.normal <= normal && normal <= range.greatest.normal,
            "{pile} {site}"
        );
        for bound in [range.least, range.greatest] {
            assert!(bound.attained, "{pile} {site}");
            assert_eq!(bound.certificate.unwrap().check(), Ok(()), "{pile} {site}");
        }
    }
    true
}

#[test]
fn hardly_stable_piles_stand() {
    let pile = under(Region::triangle(3).unwrap(), "+-");
    let pile = loaded(pile, [0, 0, 0], ["10001/10000", "2", "1"]);
    assert!(stands(&pile, 1));
    let found = squared(&pile);
    assert!(
        found > ratio!(144 / 10_000) && found < ratio!(145 / 10_000),
        "{found}"
    );
    let whole = under(Region::triangle(3).unwrap(), "+-");
    assert_eq!(
        squared(&loaded(whole, [0, 0, 0], ["1", "2", "1"])),
        ratio!(25 / 1728)
    );

    let pile = under(Region::new(-3..=-1, 1..=2, -2..=-1).unwrap(), "-+");
    assert!(stands(
        &loaded(pile, [-4, 2, 1], ["200001/100000", "-3", "1/3"]),
        1
    ));

    let pile = under(Region::triangle(5).unwrap(), "-");
    assert!(stands(
        &loaded(pile, [2, 2, 0], ["30001/10000", "3", "-3"]),
        1
    ));
}

#[test]
fn hexagon_has_margin_with_horizontal_contacts() {
    let pile = under(Region::hexagon(3, 3).unwrap(), "-");
    let pile = loaded(pile, [2, 0, 0], ["2", "1000001/1000000", "-1/2"]);
    assert_eq!(squared(&pile), number("2249997000001/9000000000000"));
}

/// Two layers under one sphere have no horizontal contacts above the floor. So the forces are unique.
#[test]
fn unique_forces_decide() {
    let pile = loaded(
        Pile::triangular(2).unwrap(),
        [0, 0, 0],
        ["2", "1/1000000", "-1"],
    );
    assert_eq!(
        pile.standing().unwrap().least.unwrap().force,
        ratio!(-1 / 1_000_000)
    );
    assert!(!stands(&pile, 1));
    let pile = loaded(
        Pile::triangular(2).unwrap(),
        [0, 0, 0],
        ["2", "-1/1000000", "-1"],
    );
    assert!(stands(&pile, 1));
}

#[test]
fn slight_tilt_leaves_all_bounds_attained() {
    let pile = Pile::triangular(5).unwrap();
    let pile = pile
        .with_tilt([ratio!(1 / 1_000_000), ratio!(1 / 1_000_000)])
        .unwrap();
    let found: Result<Vec<_>, _> = base_bounds(&pile, Selection::Base).unwrap().collect();
    let found = found.unwrap();
    assert_eq!(found.len(), 15);
    assert!(
        found
            .iter()
            .all(|(_, range)| range.least.attained && range.greatest.attained)
    );
}

/// Knuth's linear congruential generator. The upper bits are random enough.
struct Random(u64);

impl Random {
    fn below(&mut self, most: u64) -> i128 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        i128::from((self.0 >> 33) % most)
    }

    /// Returns a pile of at most 60 spheres, with whole numbers as loads, and with a change of one of them by 10⁻¹ … 10⁻⁹.
    fn pile(&mut self) -> Pile {
        loop {
            let top = match self.below(5) {
                0 => Region::SITE,
                1 => Region::triangle(2 + self.below(4)).unwrap(),
                2 => Region::hexagon(2 + self.below(2), 2).unwrap(),
                _ => {
                    let [x, y] = [self.below(4), self.below(3)];
                    Region::new(0..=x, 0..=y, 0..=x + y).unwrap()
                }
            };
            let steps = 1 + self.below(4);
            let signs: String = (0..steps)
                .map(|_| if self.below(2) == 0 { '+' } else { '-' })
                .collect();
            let mut pile = under(top, &signs);
            if pile.sphere_count() > 60_u8.into() {
                continue;
            }
            let above: Vec<Site> = pile.shape().sites().filter(|site| site.k < steps).collect();
            for _ in 0..=self.below(2) {
                let digits = u32::try_from(1 + self.below(9)).unwrap();
                let little = BigRational::new(1.into(), BigInt::from(10).pow(digits));
                let changed = self.below(3);
                let mut component = |number: i128, least: i128| {
                    let whole = BigRational::from_integer((self.below(9) + least).into());
                    let little = if self.below(2) == 0 {
                        little.clone()
                    } else {
                        -little.clone()
                    };
                    match changed == number {
                        true if least == 0 => whole + little.abs(),
                        true => whole + little,
                        false => whole,
                    }
                };
                let load = Load {
                    down: component(0, 0),
                    x: component(1, -4),
                    y: component(2, -4),
                };
                let site =
                    usize::try_from(self.below(u64::try_from(above.len()).unwrap())).unwrap();
                pile = pile.with_load(above[site], load).unwrap();
            }
            return pile;
        }
    }
}

/// `NEAR_TIES=all` tests 20,000 piles.
#[test]
fn answers_agree_near_ties() {
    let piles = match std::env::var("NEAR_TIES").as_deref() {
        Ok("all") => 20_000,
        _ if cfg!(debug_assertions) => 100,
        _ => 1_000,
    };
    let (mut random, mut stable) = (Random(53), 0);
    for _ in 0..piles {
        stable += usize::from(stands(&random.pile(), 4));
    }
    assert!(stable * 10 > piles && stable * 10 < 9 * piles, "{stable}");
}
