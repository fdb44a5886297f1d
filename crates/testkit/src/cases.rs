//! The piles of the tests. Each is built twice: for the library and for the oracle.

use cannonpile::lattice::{Axis, HorizontalContact, Region, Sign};
use cannonpile::stacking::Stacking;
use cannonpile::{Load, Pile};
use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::oracles::balance::{Balance, Place, Sites, ratio, site};

/// The number of limbs of a number: 62 bits in the top one, 55 in each of the others.
pub fn limbs(bits: u64) -> u64 {
    1 + bits.saturating_sub(62).div_ceil(55)
}

/// The sites with x₀ ≤ i ≤ x₁, y₀ ≤ j ≤ y₁ and s₀ ≤ i+j ≤ s₁.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// Least and greatest i.
    pub x: (i128, i128),
    /// Least and greatest j.
    pub y: (i128, i128),
    /// Least and greatest i+j.
    pub s: (i128, i128),
}

impl Bounds {
    /// One site.
    pub const SITE: Self = Self::hexagon(1, 1);

    /// A hexagon whose sides have p and q sites alternately.
    pub const fn hexagon(p: i128, q: i128) -> Self {
        let range = (1 - q, p - 1);
        Self {
            x: range,
            y: range,
            s: range,
        }
    }

    /// A triangle with n sites on each side.
    pub const fn triangle(n: i128) -> Self {
        Self::hexagon(n, 1)
    }

    /// Returns the sites for the library.
    pub fn region(&self) -> Region {
        let Self { x, y, s } = *self;
        Region::new(x.0..=x.1, y.0..=y.1, s.0..=s.1).expect("a region with a site")
    }

    /// Returns the sites for the oracle.
    pub fn sites(&self) -> Sites {
        let Self { x, y, s } = *self;
        let rows = (y.0..=y.1).flat_map(|j| (x.0..=x.1).map(move |i| (j, i)));
        rows.filter(|(j, i)| (s.0..=s.1).contains(&(i + j)))
            .collect()
    }
}

/// One pile in two forms.
#[derive(Clone, Debug)]
pub struct Case {
    /// The form for the library.
    pub pile: Pile,
    /// The form for the oracle.
    pub balance: Balance,
    /// The tilt of gravity along x and y.
    pub tilt: [BigRational; 2],
}

impl Case {
    /// A pile that grows down from a top layer. The signs are listed from the top.
    pub fn under(top: &Bounds, signs: &str) -> Self {
        Self {
            pile: Pile::under(top.region(), stacking(signs)).expect("a small pile"),
            balance: Balance::under(&top.sites(), signs),
            tilt: Default::default(),
        }
    }

    /// A pile that grows up from a base. `None` if the oracle finds that the base does not support that many layers.
    pub fn on(base: &Bounds, signs: &str) -> Option<Self> {
        let balance = Balance::on(&base.sites(), signs)?;
        let pile = Pile::on(base.region(), stacking(signs)).expect("a pile that fits");
        Some(Self {
            pile,
            balance,
            tilt: Default::default(),
        })
    }

    /// Returns the pile under gravity that leans. It has no loads yet, and no weights of its own.
    #[must_use]
    pub fn with_tilt(mut self, tilt: [BigRational; 2]) -> Self {
        self.pile = self.pile.with_tilt(tilt.clone()).expect("spheres");
        let places: Vec<Place> = self.balance.places().collect();
        for place in places {
            let weight = self.balance.weight(place).clone();
            self.balance
                .push(place, tilt.each_ref().map(|t| t * &weight));
        }
        self.tilt = tilt;
        self
    }

    /// Returns the pile with one more load of any direction on a sphere.
    #[must_use]
    pub fn with_directed_load(mut self, place: Place, load: &Load) -> Self {
        self = self.with_load(place, &load.down);
        let along = Load {
            down: BigRational::zero(),
            ..load.clone()
        };
        self.pile = self.pile.with_load(site(place), along).expect("a sphere");
        self.balance.push(place, [load.x.clone(), load.y.clone()]);
        self
    }

    /// Returns the pile with `n` more loads of any direction on random spheres.
    #[must_use]
    pub fn with_random_directed_loads(mut self, n: usize, random: &mut Random) -> Self {
        let places: Vec<Place> = self.balance.places().collect();
        for _ in 0..n {
            let place = places[random.below(places.len())];
            let [x, y] = [(); 2].map(|()| random.signed());
            let down = random.rational();
            self = self.with_directed_load(place, &Load { down, x, y });
        }
        self
    }

    /// Returns the pile with weightless spheres.
    #[must_use]
    pub fn weightless(mut self) -> Self {
        assert!(
            self.balance.weights.is_empty() && self.balance.horizontal.is_empty(),
            "make the spheres weightless before adding loads"
        );
        self.balance.ordinary = BigRational::zero();
        self.pile = self.pile.weightless();
        self
    }

    /// Returns the pile with one more load on a sphere.
    #[must_use]
    pub fn with_load(mut self, place: Place, load: &BigRational) -> Self {
        let before = self.balance.weight(place).clone();
        self.balance.weights.insert(place, before + load);
        let pile = self.pile.with_load(site(place), load.clone());
        self.pile = pile.expect("a sphere");
        self
    }

    /// Returns the pile with another weight for a sphere that has no load.
    #[must_use]
    pub fn with_weight(mut self, place: Place, weight: &BigRational) -> Self {
        let extra = weight - self.balance.weight(place);
        let along = self.tilt.each_ref().map(|t| t * &extra);
        self.balance.push(place, along);
        self.balance.weights.insert(place, weight.clone());
        let pile = self.pile.with_weight(site(place), weight.clone());
        self.pile = pile.expect("a sphere");
        self
    }

    /// Adds random forces in at most `n` random horizontal contacts above the bottom layer.
    #[must_use]
    pub fn with_random_horizontal_forces(mut self, n: usize, random: &mut Random) -> Self {
        let steps = [
            (Axis::AlphaBeta, [1, 0]),
            (Axis::AlphaGamma, [0, 1]),
            (Axis::GammaBeta, [1, -1]),
        ];
        let floor = self.pile.layers() - 1;
        let both = |(k, j, i): Place, [di, dj]: [i128; 2]| {
            k < floor && self.balance.has((k, j + dj, i + di))
        };
        let contacts = self.balance.places();
        let contacts = contacts.flat_map(|place| steps.map(|(axis, step)| (place, axis, step)));
        let contacts: Vec<_> = contacts
            .filter(|(place, _, step)| both(*place, *step))
            .collect();
        for _ in 0..n.min(contacts.len()) {
            let (place, axis, step) = contacts[random.below(contacts.len())];
            let (site, force) = (site(place), random.rational());
            let contact = HorizontalContact { site, axis };
            let pile = self.pile.with_horizontal_force(contact, force.clone());
            self.pile = pile.expect("two spheres off the floor");
            self.balance.add_horizontal_force(place, step, &force);
        }
        self
    }

    /// Adds random weights and loads on `n` random spheres.
    #[must_use]
    pub fn with_random_loads(mut self, n: usize, random: &mut Random) -> Self {
        let places: Vec<Place> = self.balance.places().collect();
        for _ in 0..n {
            let place = places[random.below(places.len())];
            let given = random.rational();
            let weighs = !self.balance.weights.contains_key(&place) && random.below(2) == 0;
            self = if weighs && self.balance.ordinary == BigRational::one() {
                self.with_weight(place, &given)
            } else {
                self.with_load(place, &given)
            };
        }
        self
    }
}

/// A stacking from its signs, + and −.
pub fn stacking(signs: &str) -> Stacking {
    let signs = signs.chars().map(|sign| match sign {
        '+' => Sign::Plus,
        _ => Sign::Minus,
    });
    Stacking::from_signs(signs).expect("a few layers")
}

/// All sign strings of one length, in the order of binary numbers.
pub fn all_signs(steps: usize) -> impl Iterator<Item = String> {
    (0..1_u32 << steps).map(move |bits| {
        let sign = |step| if bits >> step & 1 == 0 { '+' } else { '-' };
        (0..steps).map(sign).collect()
    })
}

/// Repeats `period` and cuts it to `steps` signs.
pub fn repeated(period: &str, steps: usize) -> String {
    period.chars().cycle().take(steps).collect()
}

/// All stackings of every height that a base supports, read from the top.
pub fn all_on(base: &Bounds) -> Vec<String> {
    let sites = base.sites();
    let mut found = vec![String::new()];
    let mut next = 0;
    while let Some(signs) = found.get(next).cloned() {
        for sign in ["+", "-"] {
            let higher = format!("{sign}{signs}");
            if Balance::on(&sites, &higher).is_some() {
                found.push(higher);
            }
        }
        next += 1;
    }
    found
}

/// Pseudorandom numbers that are the same in every run, from Knuth's linear congruential generator.
pub struct Random(pub u64);

impl Random {
    /// The next 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }

    /// A number from 0 to n − 1.
    pub fn below(&mut self, n: usize) -> usize {
        usize::try_from(self.bits()).expect("31 bits") % n
    }

    /// A number from 0 to n.
    pub fn up_to(&mut self, n: i128) -> i128 {
        i128::from(self.bits()) % (n + 1)
    }

    /// Random signs, `steps` of them.
    pub fn signs(&mut self, steps: usize) -> String {
        // Long runs and a change at every step are about equally likely.
        let change = 1 + self.below(4);
        let mut plus = self.below(2) == 0;
        let sign = |_| {
            plus ^= self.below(4) < change;
            if plus { '+' } else { '-' }
        };
        (0..steps).map(sign).collect()
    }

    /// A nonnegative rational: zero, small, or with a denominator that may contain a factor of 3.
    pub fn rational(&mut self) -> BigRational {
        let numer = [0, 1, 2, 7, 100, 12_345_678_901][self.below(6)];
        let denom = [1, 2, 3, 9, 10, 35, 1_000_003][self.below(7)];
        ratio(numer, denom)
    }

    /// A rational of either sign.
    pub fn signed(&mut self) -> BigRational {
        self.rational() * ratio([-1, 1][self.below(2)], 1)
    }

    /// A nonempty region of any form. Its bounds need not be tight.
    pub fn bounds(&mut self, size: i128) -> Bounds {
        loop {
            let [x0, y0] = [0; 2].map(|_: i32| self.up_to(4) - 2);
            let [x1, y1] = [x0, y0].map(|start| start + self.up_to(size));
            let s0 = x0 + y0 - 1 + self.up_to(size / 2 + 1);
            let s1 = s0 + self.up_to(2 * size);
            let bounds = Bounds {
                x: (x0, x1),
                y: (y0, y1),
                s: (s0, s1),
            };
            if !bounds.sites().is_empty() {
                return bounds;
            }
        }
    }
}
