//! Loads and gravity of any direction, in every scalar: compared with the oracle, with each other, and as symbols.

use cannonpile::lattice::{Region, Site};
use cannonpile::scalar::{Algebra, DoubleDouble, FixedRational, Interval, Polynomial, Symbol};
use cannonpile::shape::Selection;
use cannonpile::{Error, Forces, Load, Method, Pile, ratio};
use cannonpile_testkit::cases::{Bounds, Case, Random, all_signs};
use cannonpile_testkit::compare::agrees;
use cannonpile_testkit::laws::{obeys_algebra, obeys_integers};
use cannonpile_testkit::real::Bounded;
use num_rational::BigRational;
use num_traits::Zero;

use crate::dual::Dual;

fn tilt(random: &mut Random) -> [BigRational; 2] {
    [(); 2].map(|()| random.signed())
}

#[test]
fn random_tilts_and_loads_on_random_tops() {
    let mut random = Random(31);
    for _ in 0..250 {
        let top = random.bounds(3);
        let (steps, loads, directed) = (random.below(8), random.below(5), random.below(5));
        let mut case = Case::under(&top, &random.signs(steps));
        if random.below(4) > 0 {
            case = case.with_tilt(tilt(&mut random));
        }
        let case = case.with_random_loads(loads, &mut random);
        agrees(&case.with_random_directed_loads(directed, &mut random)).unwrap();
    }
}

#[test]
fn random_tilts_and_loads_on_random_bases() {
    let mut random = Random(32);
    let mut compared = 0;
    while compared < 150 {
        let (base, steps, loads) = (random.bounds(9), random.below(6), random.below(4));
        if let Some(case) = Case::on(&base, &random.signs(steps)) {
            let case = case.with_tilt(tilt(&mut random));
            let case = case.with_random_loads(loads, &mut random);
            agrees(&case.with_random_directed_loads(2, &mut random)).unwrap();
            compared += 1;
        }
    }
}

/// Small tilts, under which most forces stay positive, and the smallest force lies anywhere.
#[test]
fn small_tilts_of_all_stackings() {
    let mut random = Random(33);
    for steps in 0..6 {
        for signs in all_signs(steps) {
            for top in [Bounds::SITE, Bounds::hexagon(2, 3)] {
                let small = [(); 2].map(|()| random.signed() / ratio!(12_345_678_901));
                let large = [ratio!(7 / 10), ratio!(-2 / 5)];
                for tilt in [small, large] {
                    agrees(&Case::under(&top, &signs).with_tilt(tilt)).unwrap();
                }
            }
        }
    }
}

/// A load that ends the fall of forces along a line. The least force may be above the loaded sphere.
#[test]
fn a_load_on_a_line_of_falling_forces() {
    let aims = [[1, 0], [-1, 0], [1, 1], [-1, -1], [1, -1], [-1, 1]];
    for signs in ["++++", "----"] {
        for [x, y] in aims.map(|aim| aim.map(|n| BigRational::from_integer(n.into()))) {
            let along = [ratio!(3 / 4) * &x, ratio!(1 / 5) * &y];
            let load = Load {
                down: ratio!(4),
                x: ratio!(-4) * x,
                y: ratio!(-1) * y,
            };
            let case = Case::under(&Bounds::SITE, signs).with_tilt(along);
            for (j, i) in case.balance.layers[3].clone() {
                agrees(&case.clone().with_directed_load((3, j, i), &load)).unwrap();
            }
        }
    }
}

#[test]
fn weightless_piles_with_directed_loads() {
    let mut random = Random(34);
    for _ in 0..100 {
        let (top, steps) = (random.bounds(3), random.below(7));
        let case = Case::under(&top, &random.signs(steps)).weightless();
        agrees(&case.with_random_directed_loads(3, &mut random)).unwrap();
    }
}

/// Long runs, below which trees replace the sweep.
#[test]
fn high_piles_under_tilt() {
    for (stacking, tilt) in [
        ("(3,9)", [ratio!(1 / 5), ratio!(0)]),
        ("(4,12)", [ratio!(3 / 5), ratio!(1 / 7)]),
        ("(1,2,14)", [ratio!(-9 / 10), ratio!(1 / 3)]),
    ] {
        let stacking: cannonpile::stacking::Stacking = stacking.parse().unwrap();
        let signs: String = stacking
            .signs()
            .map(cannonpile::lattice::Sign::symbol)
            .collect();
        agrees(&Case::under(&Bounds::SITE, &signs).with_tilt(tilt)).unwrap();
    }
}

/// The straight pile of any φ, and discs: every sphere is in equilibrium, and the sums on the floor are the loads.
#[test]
fn isosceles_piles_and_discs_are_in_equilibrium() {
    let load = |y: BigRational| Load {
        down: ratio!(5 / 2),
        x: ratio!(-3 / 7),
        y,
    };
    let site = Site::new(1, 0, 2);
    let isosceles = Pile::isosceles(6, ratio!(2 / 7)).unwrap();
    let isosceles = isosceles
        .with_tilt([ratio!(1 / 3), ratio!(-2 / 9)])
        .unwrap();
    let isosceles = isosceles.with_load(site, load(ratio!(4 / 3))).unwrap();
    let discs = Pile::discs(6).unwrap();
    let discs = discs.with_tilt([ratio!(1 / 3), ratio!(0)]).unwrap();
    let discs = discs.with_load(site, load(ratio!(0))).unwrap();
    for pile in [isosceles, discs] {
        let forces = pile.forces::<BigRational>();
        for site in pile
            .sites(Selection::All)
            .unwrap()
            .filter(|site| site.k < 5)
        {
            assert!(forces.unbalanced(site).unwrap() == cannonpile::geometry::Vector::zero());
        }
        let [normal, x, y] = forces.sum_on_floor(Selection::Base).unwrap();
        let (weight, one) = (pile.sphere_count(), pile.load(site).unwrap());
        let weight = BigRational::from_integer(weight.into());
        let [tilt_x, tilt_y] = pile.tilt();
        assert_eq!(normal, &weight + &one.down);
        assert_eq!(x, &weight * tilt_x + one.x);
        assert_eq!(y, weight * tilt_y + one.y);
        let summed = forces.base(Selection::Base).unwrap().map(Result::unwrap);
        let summed = summed.fold(BigRational::zero(), |sum, force| sum + force.shear_x);
        assert_eq!(summed, x);
    }
}

/// The mirror image: the opposite stacking under the opposite tilt has the same forces at the mirrored sites.
#[test]
fn the_mirror_image_has_the_same_forces() {
    let top = Region::hexagon(2, 2).unwrap();
    let pile = |signs: &str, sign: i128| {
        let tilt = [ratio!(1 / 4), ratio!(1 / 9)]
            .map(|part| part * BigRational::from_integer(sign.into()));
        let pile = Pile::under(top, signs.parse().unwrap()).unwrap();
        pile.with_tilt(tilt).unwrap()
    };
    let (one, other) = (pile("+-++-", 1), pile("-+--+", -1));
    let [one, other] = [&one, &other].map(|pile| pile.forces::<BigRational>());
    for contact in one.contacts(Selection::All).unwrap().map(Result::unwrap) {
        let Site { i, j, k } = contact.site;
        let mirrored = other.contact(Site::new(-i, -j, k), contact.direction);
        assert_eq!(mirrored.unwrap(), contact.force);
    }
}

fn piles() -> Vec<Pile> {
    let hexagon = Region::hexagon(2, 3).unwrap();
    let under = |top, stacking: &str| Pile::under(top, stacking.parse().unwrap()).unwrap();
    vec![
        Pile::triangular(6).unwrap(),
        Pile::isosceles(5, ratio!(1 / 3)).unwrap(),
        Pile::discs(6).unwrap(),
        under(Region::SITE, "+-++-"),
        under(hexagon, "-+--"),
        under(hexagon, "++").weightless(),
    ]
}

/// Adds the same loads to a pile, as rationals, and to its forces, as scalars.
fn loaded<T: Algebra>(pile: &Pile) -> (Pile, Forces<'_, T>) {
    let flat = pile.sin_phi().is_zero();
    let y = |y: BigRational| if flat { ratio!(0) } else { y };
    let tilt = [ratio!(1 / 8), y(ratio!(-3 / 16))];
    let load = Load {
        down: ratio!(3 / 2),
        x: ratio!(-5 / 4),
        y: y(ratio!(7 / 8)),
    };
    let own = |value: &BigRational| T::from_rational(value);
    let mut forces = pile
        .forces::<T>()
        .with_tilt(tilt.each_ref().map(own))
        .unwrap();
    let mut rational = pile.clone().with_tilt(tilt).unwrap();
    // Each of these spheres has two loads.
    for part in [Selection::Layer(1), Selection::Base] {
        let site = pile.sites(part).unwrap().next().unwrap();
        for times in [1, 2] {
            let load = load
                .clone()
                .map(|part| part * BigRational::from_integer(times.into()));
            let same = load.clone().map(|part| own(&part));
            forces = forces.with_load(site, same).unwrap();
            rational = rational.with_load(site, load).unwrap();
        }
    }
    (rational, forces)
}

/// Compares every way to ask, in one scalar, with the exact forces.
fn every_way<T: Algebra>(agree: impl Fn(&T, &BigRational) -> bool) {
    for pile in &piles() {
        let (rational, forces) = loaded::<T>(pile);
        let exact = rational.forces::<BigRational>();
        for method in [
            None,
            Some(Method::Closed),
            Some(Method::Tree),
            Some(Method::Sweep),
        ] {
            let forces = match method.map(|method| forces.clone().with_method(method)) {
                None => forces.clone(),
                Some(Ok(forces)) => forces,
                Some(Err(_)) => continue,
            };
            let contacts = forces.contacts(Selection::All).unwrap();
            let known = exact.contacts(Selection::All).unwrap();
            for (contact, known) in contacts.zip(known) {
                let (contact, known) = (contact.unwrap(), known.unwrap());
                assert!(
                    agree(&contact.force, &known.force),
                    "{pile} {contact:?} {known:?}"
                );
                let one = forces.contact(known.site, known.direction).unwrap();
                assert!(agree(&one, &known.force), "{pile}");
            }
            let base = forces.base(Selection::Base).unwrap();
            for (force, known) in base.zip(exact.base(Selection::Base).unwrap()) {
                let (force, known) = (force.unwrap(), known.unwrap());
                assert!(agree(&force.normal, &known.normal), "{pile} {force:?}");
                assert!(
                    agree(&force.shear_x, &known.shear_x),
                    "{pile} {force:?} {known:?}"
                );
                assert!(agree(&force.shear_y, &known.shear_y), "{pile} {force:?}");
            }
            let mut layers = forces.layers(Selection::All).unwrap();
            while let Some(layer) = layers
                .next_layer()
                .unwrap()
                .filter(|layer| !layer.is_floor())
            {
                let mut slices = [(); 3].map(|()| vec![T::zero(); layer.sphere_count()]);
                layer
                    .fill(slices.each_mut().map(Vec::as_mut_slice))
                    .unwrap();
                let sites = pile.sites(Selection::Layer(layer.k())).unwrap();
                for (place, site) in sites.enumerate() {
                    for (slice, known) in slices.iter().zip(exact.to_below(site).unwrap()) {
                        assert!(agree(&slice[place], &known), "{pile} {site}");
                    }
                }
            }
        }
    }
}

#[test]
fn scalars_take_loads_of_their_own() {
    let close = |value: f64, known: &BigRational| {
        let known = f64::from_rational(known);
        (value - known).abs() <= 1e-13 * (10.0 + known.abs())
    };
    every_way::<f64>(|value, known| close(*value, known));
    every_way::<f32>(|value, known| (value - f32::from_rational(known)).abs() < 1e-4);
    every_way::<DoubleDouble>(|value, known| close(value.high(), known));
    every_way::<BigRational>(|value, known| value == known);
    every_way::<FixedRational<i128>>(|value, known| *value == FixedRational::from_rational(known));
    every_way::<Interval>(|value, known| {
        value
            .enclosure()
            .is_some_and(|bounds| bounds.contains(known))
    });
    every_way::<Polynomial>(|value, known| *value == Polynomial::from_rational(known));
    every_way::<Dual<BigRational>>(|value, known| *value == Dual::from_rational(known));
}

/// A load and a tilt as symbols, in every stacking of up to seven layers: the polynomials, evaluated, are the rational
/// forces.
#[test]
fn symbols_evaluate_to_the_rational_forces() {
    let symbols = ["x", "y", "w", "u", "v"].map(Symbol);
    let [x, y, w, u, v] = symbols.map(Polynomial::from);
    let values = [
        ratio!(-2 / 7),
        ratio!(1 / 9),
        ratio!(5 / 3),
        ratio!(3 / 4),
        ratio!(-8 / 5),
    ];
    for steps in 1..=6 {
        for signs in all_signs(steps) {
            let pile = Pile::under(Region::SITE, signs.parse().unwrap()).unwrap();
            let site = Site::new(0, 0, 1);
            let forces = pile.forces::<Polynomial>();
            let forces = forces.with_tilt([x.clone(), y.clone()]).unwrap();
            let load = Load {
                down: w.clone(),
                x: u.clone(),
                y: v.clone(),
            };
            let forces = forces.with_load(site, load).unwrap();
            let [x, y, w, u, v] = values.clone();
            let rational = pile.clone().with_tilt([x, y]).unwrap();
            let load = Load {
                down: w,
                x: u,
                y: v,
            };
            let rational = rational.with_load(site, load).unwrap();
            let known = rational.forces::<BigRational>();
            let known = known.contacts(Selection::All).unwrap();
            for (contact, known) in forces.contacts(Selection::All).unwrap().zip(known) {
                let values: Vec<_> = symbols.into_iter().zip(values.clone()).collect();
                let force = contact.unwrap().force.evaluate(&values);
                assert_eq!(force, Some(known.unwrap().force), "{signs}");
            }
        }
    }
}

/// Forces are affine in the loads. So the derivative is the exact difference.
#[test]
fn derivatives_are_exact_differences() {
    for pile in &piles() {
        let site = pile.sites(Selection::Layer(1)).unwrap().last().unwrap();
        let at = |x: BigRational| Load {
            down: ratio!(1),
            x,
            y: ratio!(0),
        };
        let dual = Load {
            x: Dual::variable(ratio!(2 / 3)),
            ..at(ratio!(0)).map(Dual::constant)
        };
        let forces = pile
            .forces::<Dual<BigRational>>()
            .with_load(site, dual)
            .unwrap();
        let [low, high] =
            [ratio!(2 / 3), ratio!(5 / 3)].map(|x| pile.clone().with_load(site, at(x)).unwrap());
        let [low, high] = [&low, &high].map(|pile| pile.forces::<BigRational>());
        for contact in forces.contacts(Selection::All).unwrap().map(Result::unwrap) {
            let ask = |forces: &Forces<'_, BigRational>| {
                forces.contact(contact.site, contact.direction).unwrap()
            };
            assert_eq!(contact.force.value, ask(&low));
            assert_eq!(contact.force.slope, ask(&high) - ask(&low));
        }
    }
}

#[test]
fn dual_numbers_obey_the_laws() {
    let dual = |value, slope| Dual { value, slope };
    obeys_algebra(&[
        dual(ratio!(0), ratio!(0)),
        dual(ratio!(1), ratio!(-2 / 3)),
        dual(ratio!(-5 / 7), ratio!(4)),
        dual(ratio!(0), ratio!(1)),
    ]);
    obeys_integers::<Dual<BigRational>>();
}

#[test]
fn impossible_loads_are_refused() {
    let discs = Pile::discs(3).unwrap();
    let across = Load {
        down: ratio!(1),
        x: ratio!(0),
        y: ratio!(1),
    };
    let refused = discs
        .clone()
        .with_load(Site::APEX, across.clone())
        .unwrap_err();
    assert_eq!(
        refused.to_string(),
        "the load of a pile of discs has no component along y: set it to 0"
    );
    assert!(matches!(
        discs.clone().with_tilt([ratio!(0), ratio!(1)]),
        Err(Error::OutOfPlane { .. })
    ));
    let forces = discs.forces::<f64>();
    assert!(forces.clone().with_tilt([0.0, 0.5]).is_err());
    assert!(forces.with_load(Site::new(9, 9, 9), 1.0).is_err());
    let upwards = Load {
        down: ratio!(-1),
        ..across
    };
    let pile = Pile::triangular(3).unwrap();
    assert!(matches!(
        pile.clone().with_load(Site::APEX, upwards.clone()),
        Err(Error::NegativeLoad { .. })
    ));
    // Forces alone give no verdict, so a load may pull.
    assert!(pile.forces().with_load(Site::APEX, upwards).is_ok());
}
