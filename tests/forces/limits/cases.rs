//! The piles of the stress tests: tall ones, spacings at every bound, extreme sizes, many sign changes, loads of 10⁻³⁰
//! next to 10³⁰, and sin φ near its limits.

use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Region, Site};
use cannonpile::stacking::Stacking;
use cannonpile::{Error, Packing, Pile};
use num_rational::BigRational;
use num_traits::{One, Pow};

use cannonpile_testkit::judge::exact;

pub(crate) use cannonpile_testkit::rational::ratio;

/// A pile and the sizes of its packing.
#[derive(Debug)]
pub(crate) struct Case {
    /// The name, which states the extreme property.
    pub(crate) name: String,
    /// The pile.
    pub(crate) pile: Pile,
    /// `None` if no spacing fits. Then the pile has no answers in SI units.
    pub(crate) spacing: Option<Spacing>,
    /// The radius of the spheres.
    pub(crate) radius: BigRational,
    /// The mass of a sphere.
    pub(crate) mass: BigRational,
    /// The gravity.
    pub(crate) gravity: BigRational,
}

impl Case {
    fn new(name: &str, pile: Result<Pile, Error>, a: Option<BigRational>) -> Self {
        Self {
            name: name.into(),
            pile: pile.expect("a pile"),
            spacing: a.map(|a| Spacing::new(a).expect("a spacing")),
            radius: ratio(1, 1000),
            mass: ratio(1, 1),
            gravity: ratio(981, 100),
        }
    }

    fn of_size(name: &str, mass: BigRational, gravity: BigRational, radius: BigRational) -> Self {
        Self {
            radius,
            mass,
            gravity,
            ..Self::new(name, Pile::triangular(10), Some(ratio(6, 5)))
        }
    }

    /// The packed pile, if a spacing fits.
    pub(crate) fn packing(&self) -> Result<Option<Packing<'_>>, Error> {
        let Some(spacing) = &self.spacing else {
            return Ok(None);
        };
        let packing = Packing::new(&self.pile, spacing)?
            .with_radius(self.radius.clone())?
            .with_mass(self.mass.clone())?;
        packing.with_gravity(self.gravity.clone()).map(Some)
    }

    /// Tells whether the pile rejects this spacing.
    pub(crate) fn is_refused(&self) -> bool {
        let clearance = self.pile.clearance();
        let refused = |spacing| clearance.check(spacing).is_err();
        self.spacing.as_ref().is_some_and(refused)
    }
}

/// All cases without the deep piles of many sign changes.
pub(crate) fn all() -> Vec<Case> {
    let mut cases = tall();
    cases.extend(at_bounds());
    cases.extend(sizes());
    cases.push(alternating(40, 40));
    cases.push(alternating(4, 100));
    cases.extend(loads());
    cases.extend(angles());
    cases
}

/// Piles with numbers of layers at the limits of floats and beyond.
pub(crate) fn tall() -> Vec<Case> {
    let float = 1_i128 << 53;
    [
        ("L = 2^53 - 1", float - 1),
        ("L = 2^53 + 1", float + 1),
        ("L = 10^18", 10_i128.pow(18)),
        ("L = 10^30", 10_i128.pow(30)),
    ]
    .map(|(name, layers)| Case::new(name, Pile::triangular(layers), Some(ratio(6, 5))))
    .into()
}

/// The floats on both sides of every bound of a/R. The pile rejects one of them.
fn at_bounds() -> Vec<Case> {
    let root = |n: i64, d: i64| {
        let root = Spacing::from_square(ratio(n, d)).expect("positive").ratio();
        let near = root.nearest::<f64>().expect("a small number");
        // The float below the bound.
        if root < near { near.next_down() } else { near }
    };
    let mixed = || Pile::under(Region::SITE, Stacking::hcp(10)?);
    let mut cases = Vec::new();
    for (name, pile, bound) in [
        ("1", Pile::triangular(10), 1.0_f64.next_down()),
        ("3/2, hcp", mixed(), 1.5_f64.next_down()),
        ("sqrt(8/3)", Pile::triangular(10), root(8, 3)),
        ("sqrt(3), L = 3", Pile::triangular(3), root(3, 1)),
    ] {
        let below = Case::new(
            &format!("a/R below {name}"),
            pile.clone(),
            Some(exact(bound)),
        );
        let above = Case::new(
            &format!("a/R above {name}"),
            pile,
            Some(exact(above(bound))),
        );
        cases.extend([below, above]);
    }
    let nearly = BigRational::one() - BigRational::from_integer(2.into()).pow(-52_i32);
    let square = ratio(3, 1) * &nearly * &nearly;
    let mut flattest = Case::new("a/R = sqrt(3)(1 - 2^-52)", Pile::triangular(3), None);
    flattest.spacing = Spacing::from_square(square).ok();
    cases.push(flattest);
    cases
}

/// The next float that is not a bound itself.
fn above(below: f64) -> f64 {
    let next = below.next_up();
    let is_bound = [1.0, 1.5].contains(&next);
    if is_bound { next.next_up() } else { next }
}

fn sizes() -> Vec<Case> {
    let ten = |exponent: i32| ratio(10, 1).pow(exponent);
    let one = || ratio(1, 1);
    let least = || exact(f64::from_bits(1));
    vec![
        Case::of_size("m = R = 10^300", ten(300), one(), ten(300)),
        Case::of_size("m = R = 10^-300", ten(-300), one(), ten(-300)),
        Case::of_size("m = 10^-300, g = 10^300", ten(-300), ten(300), one()),
        Case::of_size("m g = 10^-320, subnormal", ten(-160), ten(-160), ten(-320)),
        Case::of_size("m = R = 5e-324", least(), one(), least()),
    ]
}

/// A pile with a sign change at every layer, under a hexagon.
pub(crate) fn alternating(side: i128, layers: i128) -> Case {
    let top = Region::hexagon(side, side).expect("a hexagon");
    let pile = Stacking::hcp(layers).and_then(|stacking| Pile::under(top, stacking));
    let name = format!("{layers} layers +-+-, hexagon of {side}");
    Case::new(&name, pile, Some(ratio(6, 5)))
}

/// Large loads next to small ones, on spheres of the top layer, for a straight stacking and a mixed one.
fn loads() -> Vec<Case> {
    let ten = |exponent: i32| ratio(10, 1).pow(exponent);
    let stackings = [("straight", "+++++++"), ("mixed", "+--+-++")];
    let case = |(name, signs): (&str, &str)| {
        let top = Region::hexagon(3, 3).expect("a hexagon");
        let pile = signs
            .parse()
            .and_then(|stacking| Pile::under(top, stacking))
            .and_then(|pile| pile.with_load(Site { i: 0, j: 0, k: 0 }, ten(30)))
            .and_then(|pile| pile.with_load(Site { i: 1, j: 0, k: 0 }, ten(-30)))
            .map(Pile::weightless);
        let name = format!("loads of 10^30 and 10^-30, {name}");
        Case::new(&name, pile, Some(ratio(6, 5)))
    };
    stackings.map(case).into()
}

fn angles() -> Vec<Case> {
    let two = |exponent: i32| ratio(2, 1).pow(exponent);
    let one = BigRational::one;
    vec![
        Case::new(
            "sin phi = 2^-60",
            Pile::isosceles(1000, two(-60)),
            Some(ratio(5, 4)),
        ),
        Case::new(
            "sin phi = 1/2 + 2^-53",
            Pile::isosceles(1000, ratio(1, 2) + two(-53)),
            Some(ratio(6, 5)),
        ),
        Case::new(
            "sin phi = 1 - 2^-53",
            Pile::isosceles(1000, one() - two(-53)),
            None,
        ),
        Case::new(
            "sin phi = 1 - 2^-200",
            Pile::isosceles(1000, one() - two(-200)),
            None,
        ),
    ]
}
