//! Every method gives the same exact forces, and its work stays within its plan.

use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Dimension, Direction, Region, Site};
use cannonpile::scalar::{Algebra, FixedRational, Interval};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Counters, Error, Method, Packing, Pile, Quantity, Question};
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::Signed;

use cannonpile_testkit::cases::limbs;
use cannonpile_testkit::pair::Pair;
use cannonpile_testkit::rational::ratio;
use cannonpile_testkit::real::Bounded;

const METHODS: [Method; 3] = [Method::Closed, Method::Tree, Method::Sweep];

const QUANTITIES: [Quantity; 2] = [Quantity::Contacts, Quantity::Floor];

fn under(top: Region, signs: &str) -> Pile {
    Pile::under(top, signs.parse().unwrap()).unwrap()
}

/// Straight piles of every kind, and mixed ones with loads and weights.
fn piles() -> Vec<Pile> {
    let hexagon = Region::hexagon(3, 2).unwrap();
    let loaded = under(hexagon, "+-++-")
        .with_load(Site { i: 0, j: 0, k: 2 }, ratio(7, 5))
        .unwrap()
        .with_weight(Site { i: 1, j: 0, k: 3 }, ratio(1, 7))
        .unwrap();
    let response = under(Region::SITE, "+-+-")
        .weightless()
        .with_load(Site::APEX, ratio(1, 3))
        .unwrap();
    vec![
        Pile::triangular(1).unwrap(),
        Pile::triangular(7).unwrap(),
        Pile::isosceles(6, ratio(4, 5)).unwrap(),
        Pile::discs(6).unwrap(),
        under(hexagon, "++++"),
        under(Region::triangle(4).unwrap(), "----"),
        under(Region::SITE, "+"),
        under(Region::SITE, "+-"),
        under(Region::SITE, "+--+-++"),
        under(hexagon, "+-+-"),
        Pile::on(Region::hexagon(5, 4).unwrap(), "+-+".parse().unwrap()).unwrap(),
        loaded,
        response,
    ]
}

fn parts(pile: &Pile) -> Vec<Selection> {
    let middle = pile.layers() / 2;
    let mut parts = vec![Selection::All, Selection::Base, Selection::Layer(middle)];
    for part in [Selection::Layer(middle), Selection::Base] {
        let site = pile.rows(part).unwrap().flatten().next().unwrap();
        parts.push(Selection::One(site));
    }
    parts
}

/// The method that does not apply to a pile.
fn unsupported_method(pile: &Pile) -> Option<Method> {
    if pile.dimension() == Dimension::Two {
        Some(Method::Sweep)
    } else {
        (!pile.shape().stacking().is_straight()).then_some(Method::Closed)
    }
}

/// The piles that a sweep can handle.
fn spheres() -> impl Iterator<Item = Pile> {
    piles()
        .into_iter()
        .filter(|pile| pile.dimension() == Dimension::Three)
}

/// Answers the whole query, in pile units or in SI, and counts the work.
fn run(pile: &Pile, question: Question, si: bool) -> Result<Counters, Error> {
    let counters = Counters::default();
    // A spacing without overlap both for the isosceles pile and for sign changes.
    let spacing = Spacing::new(ratio(3, 2)).unwrap();
    let (mut forces, packing) = (pile.forces::<BigRational>(), Packing::new(pile, &spacing));
    let mut packing = packing.unwrap();
    if let Some(method) = question.method {
        (forces, packing) = (forces.with_method(method)?, packing.with_method(method)?);
    }
    let (forces, packing) = (
        forces.with_counters(&counters),
        packing.with_counters(&counters),
    );
    let part = question.part;
    match (question.quantity, si) {
        (Quantity::Contacts, false) => drop(all(forces.contacts(part)?)?),
        (Quantity::Contacts, true) => drop(all(packing.contacts(part)?)?),
        (Quantity::Floor, false) => drop(all(forces.base(part)?)?),
        (Quantity::Floor, true) => drop(all(packing.base(part)?)?),
        (other, _) => panic!("unexpected quantity {other}"),
    }
    Ok(counters)
}

fn all<A>(answers: impl Iterator<Item = Result<A, Error>>) -> Result<Vec<A>, Error> {
    answers.collect()
}

#[test]
fn work_stays_within_the_plan() {
    let mut kept = 0;
    for pile in piles() {
        for (part, quantity) in parts(&pile)
            .iter()
            .flat_map(|part| QUANTITIES.map(|q| (*part, q)))
        {
            for method in METHODS.map(Some).into_iter().chain([None]) {
                let mut question = Question::new(part, quantity);
                question.method = method;
                let Ok(plan) = pile.plan(question) else {
                    // The pile has no closed form, or the part is not on the floor.
                    assert!(
                        run(&pile, question, false).is_err(),
                        "{pile:?} {question:?}"
                    );
                    continue;
                };
                for si in [false, true] {
                    let counters = run(&pile, question, si).unwrap();
                    let (visited, most) = (BigUint::from(counters.visited()), &plan.visited);
                    assert!(visited <= *most, "{question:?}: {visited}, planned {most}");
                    assert_eq!(BigUint::from(counters.rows()), plan.rows, "{question:?}");
                    kept += 1;
                }
            }
        }
    }
    assert!(kept > 500, "{kept}");
}

/// A stress has one row. Its sphere is visited as often as for its contacts, or for its force on the floor.
#[test]
fn stresses_stay_within_their_plan() {
    for pile in piles() {
        for part in parts(&pile) {
            for method in METHODS.map(Some).into_iter().chain([None]) {
                let [counters, others] = [(); 2].map(|()| Counters::default());
                let forces = pile.forces::<BigRational>();
                let forces = match method.map(|method| forces.clone().with_method(method)) {
                    Some(Err(_)) => continue,
                    Some(Ok(forces)) => forces,
                    None => forces,
                };
                let stresses = forces.clone().with_counters(&counters).stresses(part);
                let stresses = stresses.unwrap();
                let plan = stresses.plan().clone();
                assert_eq!(plan.rows, stresses.count().into(), "{part:?} {method:?}");
                assert_eq!(plan.rows, counters.rows().into(), "{part:?} {method:?}");
                assert!(plan.visited >= counters.visited().into());

                let forces = forces.with_counters(&others);
                drop(all(forces.contacts(part).unwrap()).unwrap());
                let floor = match part {
                    Selection::All => Selection::Base,
                    _ => part,
                };
                if let Ok(floor) = forces.base(floor) {
                    drop(all(floor).unwrap());
                }
                let work = |counters: &Counters| (counters.visited(), counters.turned());
                if method == Some(Method::Tree) {
                    assert_eq!(work(&counters), work(&others), "{pile:?} {part:?}");
                }
                assert_eq!(counters.visited(), others.visited(), "{pile:?} {part:?}");
            }
        }
    }
}

#[test]
fn all_methods_agree() {
    for pile in piles() {
        let exact = pile.forces::<BigRational>();
        for part in parts(&pile) {
            let contacts = |method: Option<Method>| -> Option<Vec<_>> {
                let forces = exact.clone();
                let forces = method
                    .map_or(Ok(forces.clone()), |m| forces.with_method(m))
                    .ok()?;
                Some(all(forces.contacts(part).unwrap()).unwrap())
            };
            let cheapest = contacts(None).unwrap();
            let unsupported_method = unsupported_method(&pile);
            for method in METHODS {
                match contacts(Some(method)) {
                    Some(found) => assert_eq!(found, cheapest, "{method}"),
                    None => assert_eq!(method, unsupported_method.unwrap()),
                }
            }
            for contact in cheapest {
                for method in METHODS
                    .into_iter()
                    .filter(|method| Some(*method) != unsupported_method)
                {
                    let forces = exact.clone().with_method(method).unwrap();
                    let one = forces.contact(contact.site, contact.direction).unwrap();
                    assert_eq!(one, contact.force, "{method} {contact:?}");
                }
            }
        }
        for method in METHODS
            .into_iter()
            .filter(|m| Some(*m) != unsupported_method(&pile))
        {
            let base = |forces: cannonpile::Forces<'_, BigRational>| {
                all(forces.base(Selection::Base).unwrap()).unwrap()
            };
            assert_eq!(
                base(exact.clone().with_method(method).unwrap()),
                base(exact.clone())
            );
        }
    }
}

/// The contents of the slices of all layers, and the error bound of the last one.
fn filled<T: Algebra>(pile: &Pile) -> (Vec<[T; 3]>, Option<BigRational>) {
    let mut layers = pile.forces::<T>().layers(Selection::All).unwrap();
    let (mut forces, mut bound) = (Vec::new(), None);
    while let Some(layer) = layers.next_layer().unwrap() {
        if layer.is_floor() {
            break;
        }
        let n = layer.sphere_count();
        let [mut a, mut b, mut c] = [(); 3].map(|()| vec![T::from_rational(&ratio(77, 1)); n]);
        layer.fill([&mut a, &mut b, &mut c]).unwrap();
        bound = layer.error_bound();
        forces.extend(a.into_iter().zip(b).zip(c).map(|((a, b), c)| [a, b, c]));
    }
    (forces, bound)
}

#[test]
fn slices_receive_the_forces() {
    for pile in spheres() {
        let forces = pile
            .forces::<BigRational>()
            .with_method(Method::Tree)
            .unwrap();
        let contacts = all(forces.contacts(Selection::All).unwrap()).unwrap();
        let exact: Vec<&[_]> = contacts.chunks(3).collect();
        let (filled_exactly, _) = filled::<BigRational>(&pile);
        let (bounds, _) = filled::<Interval>(&pile);
        assert_eq!(filled_exactly.len(), exact.len());
        let mut layers = pile.forces::<BigRational>().layers(Selection::All).unwrap();
        let mut layer = layers.next_layer().unwrap().unwrap();
        for ((contacts, filled), bounds) in exact.iter().zip(&filled_exactly).zip(&bounds) {
            let site = contacts[0].site;
            while layer.k() < site.k {
                layer = layers.next_layer().unwrap().unwrap();
            }
            assert_eq!(layer.to_below(site).unwrap(), *filled);
            for ((contact, force), bound) in contacts.iter().zip(filled).zip(bounds) {
                assert_eq!(contact.force, *force, "{site:?}");
                let enclosure = bound.enclosure().unwrap();
                assert!(enclosure.contains(force), "{site:?}");
            }
        }
    }
}

/// The greatest error of the forces of all layers, and its bound.
fn error_and_bound<F: Algebra>(
    pile: &Pile,
    exact: &[[BigRational; 3]],
    value: fn(F) -> Option<BigRational>,
) -> [BigRational; 2] {
    let (forces, bound) = filled::<F>(pile);
    let forces = forces.into_iter().flatten();
    let errors = forces.zip(exact.iter().flatten()).map(|(force, exact)| {
        let error = value(force).unwrap() - exact;
        error.abs()
    });
    [errors.max().unwrap(), bound.unwrap()]
}

#[test]
fn floats_stay_within_their_bound() {
    let top = Region::hexagon(4, 4).unwrap();
    let hcp = Pile::under(top, Stacking::hcp(24).unwrap()).unwrap();
    let uneven = hcp
        .clone()
        .with_load(Site { i: 1, j: 1, k: 3 }, ratio(1_000_001, 3))
        .unwrap();
    for pile in spheres().skip(1).chain([hcp, uneven]) {
        let (exact, _) = filled::<BigRational>(&pile);
        let greatest = exact.iter().flatten().max().unwrap();
        let [single, bound] = error_and_bound::<f32>(&pile, &exact, BigRational::from_float);
        assert!(single <= bound, "{single} > {bound}");
        // The bound is small compared with the greatest force.
        assert!(bound < ratio(1, 20) * greatest, "{bound} of {greatest}");
        let [double, bound] = error_and_bound::<f64>(&pile, &exact, BigRational::from_float);
        assert!(double <= bound, "{double} > {bound}");
        assert!(bound < ratio(1, 10_000_000_000) * greatest);
    }
}

#[test]
fn layers_reject_invalid_queries() {
    let pile = under(Region::SITE, "+-+");
    let forces = pile.forces::<f64>();
    let refused = forces.layers(Selection::Layer(4)).err();
    assert!(matches!(refused, Some(Error::LayerOutside { .. })));
    let mut layers = forces.layers(Selection::Layer(2)).unwrap();
    let layer = layers.next_layer().unwrap().unwrap();
    let refused = layer.fill([&mut [], &mut [], &mut []]);
    let needed = layer.sphere_count();
    assert_eq!(refused, Err(Error::Length { needed, given: 0 }));
    let elsewhere = layer.to_below(Site::APEX);
    assert!(matches!(
        elsewhere,
        Err(Error::OtherLayer {
            layer: 0,
            at: 2,
            ..
        })
    ));
    assert!(matches!(
        layer.on_floor(Site { i: 0, j: 0, k: 2 }),
        Err(Error::NotOnFloor { .. })
    ));
    assert!(layers.next_layer().unwrap().is_none());

    let discs = Pile::discs(4).unwrap();
    let by_sweep = discs.forces::<f64>().with_method(Method::Sweep);
    assert!(matches!(
        by_sweep.err(),
        Some(Error::NoSuchMethod {
            method: Method::Sweep,
            ..
        })
    ));
    // Each disc has two contacts below it.
    let (forces, _) = filled::<f64>(&discs);
    assert_eq!(
        forces[..3],
        [[1.0, 1.0, 0.0], [2.0, 1.0, 0.0], [1.0, 2.0, 0.0]]
    );

    let one = Pile::triangular(1).unwrap();
    let mut alone = one.forces::<f64>().layers(Selection::All).unwrap();
    let floor = alone.next_layer().unwrap().unwrap();
    let on_floor = Err(Error::OnFloor { site: Site::APEX });
    assert_eq!(floor.fill([&mut [0.0], &mut [0.0], &mut [0.0]]), on_floor);
    assert_eq!(floor.to_below(Site::APEX).map(|_| ()), on_floor);
    assert!((floor.on_floor(Site::APEX).unwrap().normal - 1.0).abs() < 1e-15);
}

#[test]
fn one_contact_of_a_million_layers_visits_no_other_sphere() {
    let pile = Pile::triangular(1_000_000).unwrap();
    let counters = Counters::default();
    let forces = pile.forces::<f64>().with_counters(&counters);
    let site = Site {
        i: 123_456,
        j: 7,
        k: 700_000,
    };
    let force = forces.contact(site, Direction::Beta).unwrap();
    assert!((force - 123_457.0).abs() < 0.5);
    assert_eq!((counters.visited(), counters.turned()), (1, 0));
}

/// The rows of the first pile start at a negative index, those of the second at 0.
#[test]
fn wide_layers_use_bands_of_rows() {
    check_bands(Region::hexagon(70, 60).unwrap(), -5);
    check_bands(Region::triangle(150).unwrap(), 5);
}

fn check_bands(top: Region, loaded: i128) {
    let loaded = Site {
        i: 3,
        j: loaded,
        k: 1,
    };
    let pile = under(top, "+-++-").with_load(loaded, ratio(22, 7)).unwrap();
    let lines = pile
        .forces::<BigRational>()
        .with_method(Method::Tree)
        .unwrap();
    for k in [1, 2, 4] {
        let mut floats = pile.forces::<f64>().layers(Selection::Layer(k)).unwrap();
        let floats = floats.next_layer().unwrap().unwrap();
        let mut exact = pile
            .forces::<BigRational>()
            .layers(Selection::Layer(k))
            .unwrap();
        let exact = exact.next_layer().unwrap().unwrap();
        let n = floats.sphere_count();
        assert!(n > 10_000);
        let mut forces = [(); 3].map(|()| vec![0.0; n]);
        floats
            .fill(forces.each_mut().map(Vec::as_mut_slice))
            .unwrap();
        let bound = floats.error_bound().unwrap();
        let sites = pile.rows(Selection::Layer(k)).unwrap().flatten();
        for (place, site) in sites.enumerate().step_by(101) {
            let below = exact.to_below(site).unwrap();
            for (direction, force) in Direction::ALL.into_iter().zip(below) {
                assert_eq!(lines.contact(site, direction).unwrap(), force, "{site}");
                let float = forces[direction.index()][place];
                let error = (BigRational::from_float(float).unwrap() - force).abs();
                assert!(error <= bound, "{site} {direction}: {error} > {bound}");
            }
        }
    }
}

/// A pile so large that several chunks fill its slices.
#[test]
fn chunks_fill_the_slices_of_large_piles() {
    let layers = 90;
    let pile = Pile::triangular(layers).unwrap();
    let layers = || pile.forces::<BigRational>().layers(Selection::All).unwrap();
    let numerators = layers().numerators::<i32>().unwrap();
    let n = numerators.slice_len().unwrap();
    assert!(n > 1 << 16);
    let [mut a, mut b, mut c] = [(); 3].map(|()| vec![0; n]);
    assert_eq!(numerators.fill([&mut a, &mut b, &mut c]), Ok(1.into()));
    let sites = pile.rows(Selection::All).unwrap().off_the_floor().flatten();
    for (place, Site { i, j, k }) in sites.enumerate() {
        // The paper's counts plus the sphere itself.
        let counts = [k - i - j + 1, i + 1, j + 1];
        assert_eq!([a[place], b[place], c[place]].map(i128::from), counts);
    }
}

/// The scalar rounds and can overflow. A value that it cannot represent is an error and never stays in a slice.
#[test]
fn an_overflow_in_a_sweep_is_an_error() {
    let pile = Pile::under(Region::SITE, Stacking::hcp(50).unwrap()).unwrap();
    let forces = pile.forces::<Pair<f64, FixedRational<i64>>>();
    let layers = forces.layers(Selection::Layer(48)).unwrap();
    let n = layers.slice_len().unwrap();
    let mut forces = [(); 3].map(|()| vec![Pair::from_rational(&ratio(0, 1)); n]);
    let filled = layers.fill(forces.each_mut().map(Vec::as_mut_slice));
    assert!(matches!(filled, Err(Error::Overflow { .. })));
}

/// A sphere with too many sign changes above it for a tree. The plan chooses a sweep, and both queries follow it: for rows
/// and for one sphere.
#[test]
fn a_sweep_replaces_a_tree_that_is_too_large_for_one_sphere() {
    let layers = 420;
    let pile = Pile::under(Region::SITE, Stacking::hcp(layers).unwrap()).unwrap();
    let site = Site {
        i: 0,
        j: 0,
        k: layers - 2,
    };
    let plan = pile.plan(Selection::One(site)).unwrap();
    assert_eq!(plan.method, Method::Sweep);
    // Each exact value takes the words of its `BigInt` and of its digits.
    let words = limbs(plan.bits) + size_of::<BigInt>().div_ceil(8) as u64;
    let spheres = pile.shape().layer(site.k).unwrap().site_count();
    assert_eq!(plan.bytes, spheres * 3_u32 * words * 8_u32);
    // Release builds run the sweep too. It takes debug builds eight seconds.
    if cfg!(debug_assertions) {
        return;
    }
    let counters = Counters::default();
    let forces = pile.forces::<f64>().with_counters(&counters);
    let three = all(forces.contacts(Selection::One(site)).unwrap()).unwrap();
    assert_eq!(three.len(), 3);
    assert!(BigUint::from(counters.visited()) <= plan.visited);
    assert!(counters.passes() > 400);
}

/// The loads have long denominators, so the values have more than twelve limbs.
#[test]
fn wide_values_sweep_limb_by_limb() {
    let long = |power: u32, at: Site, pile: Pile| {
        let load = BigRational::new(1.into(), BigInt::from(10).pow(power));
        pile.with_load(at, load).unwrap()
    };
    let pile = under(Region::hexagon(3, 2).unwrap(), "+-++-+--+-+-+-+");
    let pile = long(200, Site { i: 0, j: 1, k: 0 }, pile);
    let pile = long(117, Site { i: 1, j: 0, k: 7 }, pile);
    let by_sweep = Question::from(Selection::All).with_method(Method::Sweep);
    assert!(limbs(pile.plan(by_sweep).unwrap().bits) > 12);
    let trees = pile
        .forces::<BigRational>()
        .with_method(Method::Tree)
        .unwrap();
    // Reads the layers in order, and then each layer directly, with deferred passes.
    let mut in_order = pile.forces::<BigRational>().layers(Selection::All).unwrap();
    for k in 0..pile.layers() - 1 {
        let next = in_order.next_layer().unwrap().unwrap();
        let mut at_once = pile
            .forces::<BigRational>()
            .layers(Selection::Layer(k))
            .unwrap();
        let at_once = at_once.next_layer().unwrap().unwrap();
        for site in pile.rows(Selection::Layer(k)).unwrap().flatten() {
            let expected = trees.to_below(site).unwrap();
            assert_eq!(next.to_below(site).unwrap(), expected, "{site}");
            assert_eq!(at_once.to_below(site).unwrap(), expected, "{site}");
        }
    }
}

/// Values gradually need more limbs. Queries on the way do not change the result.
#[test]
fn values_grow_limb_by_limb() {
    let pile = Pile::under(Region::SITE, Stacking::hcp(160).unwrap()).unwrap();
    let last = pile.layers() - 2;
    let forces = pile.forces::<BigRational>();
    let mut direct = forces.layers(Selection::Layer(last)).unwrap();
    let direct = direct.next_layer().unwrap().unwrap();
    let mut stepwise = forces.layers(Selection::All).unwrap();
    let stepwise = loop {
        let layer = stepwise.next_layer().unwrap().unwrap();
        if [1, 2, 9, 11, 40, 41, 43, 90, 131].contains(&layer.k()) {
            let [[i, j], ..] = pile.shape().layer(layer.k()).unwrap().corners();
            layer.to_below(Site { i, j, k: layer.k() }).unwrap();
        }
        if layer.k() == last {
            break layer;
        }
    };
    let mut sum = BigRational::default();
    for site in pile.rows(Selection::Layer(last)).unwrap().flatten() {
        let forces = direct.to_below(site).unwrap();
        assert_eq!(stepwise.to_below(site).unwrap(), forces, "{site}");
        sum += forces.into_iter().sum::<BigRational>();
    }
    // The vertical parts f cosθ of all contacts support all layers above. f is in mg/(3 cosθ).
    let floor = pile.shape().base().site_count();
    let above = BigInt::from(pile.sphere_count() - floor);
    assert_eq!(sum, BigRational::from_integer(above * 3));
}

/// `f64` cannot represent 1 + 2^53. So the spheres on the line must be counted before the load is added.
#[test]
fn a_closed_force_is_rounded_once() {
    let load = BigRational::from_integer(BigInt::from(1_i64 << 53));
    let pile = Pile::triangular(3).unwrap();
    let pile = pile.with_load(Site::APEX, load).unwrap();
    let below = Site { i: 0, j: 0, k: 1 };
    let force = pile.forces::<f64>().contact(below, Direction::Alpha);
    assert_eq!(force, Ok(9_007_199_254_740_994.0));
}

/// Several spheres of a row share lines. The tree visits each line once.
#[test]
fn a_row_by_trees_visits_each_line_once() {
    let pile = under(Region::SITE, "+-+");
    let counters = Counters::default();
    let forces = pile
        .forces::<BigRational>()
        .with_method(Method::Tree)
        .unwrap();
    let layers = forces
        .with_counters(&counters)
        .layers(Selection::Base)
        .unwrap();
    let mut layers = layers.nearest::<f64>().unwrap();
    let row = pile.rows(Selection::Base).unwrap().nth(1).unwrap();
    assert_eq!(row.i, -1..3);
    let [mut normal, mut x, mut y] = [[0.0; 4]; 3];
    layers
        .fill_row_of_base(&row, [&mut normal, &mut x, &mut y])
        .unwrap();
    assert_eq!(counters.visited(), 12);
}
