//! Every method gives the same exact forces, and takes no more than its plan says.

use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Dimension, Direction, Region, Site};
use cannonpile::scalar::{Algebra, FixedRational, Interval, Pair, RealEmbeddable};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Counters, Error, Method, Packing, Pile, Plan, Quantity, Question};
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::Signed;

const METHODS: [Method; 3] = [Method::Closed, Method::Tree, Method::Sweep];

const QUANTITIES: [Quantity; 6] = [
    Quantity::ContactMultiples,
    Quantity::ContactMagnitudes,
    Quantity::ContactVectors,
    Quantity::FloorMultiples,
    Quantity::FloorForces,
    Quantity::Positions,
];

fn ratio(n: i64, d: i64) -> BigRational {
    BigRational::new(n.into(), d.into())
}

fn under(top: Region, signs: &str) -> Pile {
    Pile::under(top, signs.parse().unwrap()).unwrap()
}

/// Straight ones of every kind, and others with loads and weights.
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

/// The method that does not apply.
fn unfit(pile: &Pile) -> Option<Method> {
    if pile.dimension() == Dimension::Two {
        Some(Method::Sweep)
    } else {
        (!pile.shape().stacking().is_straight()).then_some(Method::Closed)
    }
}

/// Those that can be swept.
fn spheres() -> impl Iterator<Item = Pile> {
    piles()
        .into_iter()
        .filter(|pile| pile.dimension() == Dimension::Three)
}

/// Puts a question, all of it, and counts.
fn run(pile: &Pile, question: Question) -> Result<Counters, Error> {
    let counters = Counters::default();
    // Wide enough for the isosceles one, narrow enough for changes of sign.
    let spacing = Spacing::new(ratio(3, 2)).unwrap();
    let (mut statics, packing) = (pile.statics::<BigRational>(), Packing::new(pile, &spacing));
    let mut packing = packing.unwrap();
    if let Some(method) = question.method {
        (statics, packing) = (statics.by(method)?, packing.by(method)?);
    }
    let (statics, packing) = (statics.metered(&counters), packing.metered(&counters));
    let rows = pile.rows(question.part)?;
    match question.quantity {
        Quantity::ContactMultiples => drop(all(statics.contacts(rows))?),
        Quantity::ContactMagnitudes => drop(all(packing.magnitudes(rows))?),
        Quantity::ContactVectors => drop(all(packing.contacts(rows))?),
        Quantity::FloorMultiples => drop(all(statics.base(rows))?),
        Quantity::FloorForces => drop(all(packing.base(rows))?),
        Quantity::Positions => drop(all(rows.flatten().map(|site| packing.position(site)))?),
        other => panic!("{other} is not asked here"),
    }
    Ok(counters)
}

fn all<A>(answers: impl Iterator<Item = Result<A, Error>>) -> Result<Vec<A>, Error> {
    answers.collect()
}

/// What a plan promises, and what is counted.
fn promises(plan: &Plan, counters: &Counters) -> [(&'static str, BigUint, u64); 4] {
    [
        ("visited", plan.visited.clone(), counters.visited()),
        ("turned", plan.turned.clone(), counters.turned()),
        ("passes", plan.passes.clone(), counters.passes()),
        ("roots", plan.roots.into(), counters.roots()),
    ]
}

#[test]
fn nothing_takes_more_than_planned() {
    let mut kept = 0;
    for pile in piles() {
        for (part, quantity) in parts(&pile)
            .iter()
            .flat_map(|part| QUANTITIES.map(|q| (*part, q)))
        {
            for method in METHODS.map(Some).into_iter().chain([None]) {
                let question = Question {
                    part,
                    quantity,
                    method,
                };
                let Ok(plan) = pile.plan(question) else {
                    // No closed form, or not on the floor.
                    assert!(run(&pile, question).is_err(), "{pile:?} {question:?}");
                    continue;
                };
                let counters = run(&pile, question).unwrap();
                for (name, most, counted) in promises(&plan, &counters) {
                    let said = format!("{question:?}: {counted} {name}, planned {most}");
                    assert!(BigUint::from(counted) <= most, "{said}");
                }
                if quantity != Quantity::Positions {
                    assert_eq!(BigUint::from(counters.rows()), plan.rows, "{question:?}");
                }
                kept += 1;
            }
        }
    }
    assert!(kept > 500, "{kept}");
}

#[test]
fn all_methods_agree() {
    for pile in piles() {
        let exact = pile.statics::<BigRational>();
        for part in parts(&pile) {
            let contacts = |method: Option<Method>| -> Option<Vec<_>> {
                let statics = exact.clone();
                let statics = method.map_or(Ok(statics.clone()), |m| statics.by(m)).ok()?;
                Some(all(statics.contacts(pile.rows(part).unwrap())).unwrap())
            };
            let cheapest = contacts(None).unwrap();
            let unfit = unfit(&pile);
            for method in METHODS {
                match contacts(Some(method)) {
                    Some(found) => assert_eq!(found, cheapest, "{method}"),
                    None => assert_eq!(method, unfit.unwrap()),
                }
            }
            for contact in cheapest {
                for method in METHODS.into_iter().filter(|method| Some(*method) != unfit) {
                    let statics = exact.clone().by(method).unwrap();
                    let one = statics.contact(contact.site, contact.direction).unwrap();
                    assert_eq!(one, contact.force, "{method} {contact:?}");
                }
            }
        }
        for method in METHODS.into_iter().filter(|m| Some(*m) != unfit(&pile)) {
            let base = |statics: cannonpile::Statics<'_, BigRational>| {
                all(statics.base(pile.rows(Selection::Base).unwrap())).unwrap()
            };
            assert_eq!(base(exact.clone().by(method).unwrap()), base(exact.clone()));
        }
    }
}

/// All that a sweep writes, layer after layer.
fn swept<T: Algebra>(pile: &Pile) -> Vec<[T; 3]> {
    let mut sweep = pile.sweep::<T>().unwrap();
    let mut forces = Vec::new();
    for k in 0..pile.layers() - 1 {
        sweep.advance(k).unwrap();
        assert_eq!(sweep.layer(), k);
        let n = sweep.spheres().unwrap();
        let [mut a, mut b, mut c] = [(); 3].map(|()| vec![T::from_rational(&ratio(77, 1)); n]);
        sweep.fill([&mut a, &mut b, &mut c]).unwrap();
        let layer = a.into_iter().zip(b).zip(c);
        forces.extend(layer.map(|((a, b), c)| [a, b, c]));
    }
    forces
}

#[test]
fn a_sweep_writes_the_forces() {
    for pile in spheres() {
        let statics = pile.statics::<BigRational>();
        let rows = pile.rows(Selection::All).unwrap().off_the_floor();
        let per_sphere = pile.dimension().directions().len();
        let contacts = all(statics.contacts(rows.clone())).unwrap();
        let exact: Vec<&[_]> = contacts.chunks(per_sphere).collect();

        let swept_exactly = swept::<BigRational>(&pile);
        let bounds = swept::<Interval>(&pile);
        assert_eq!(swept_exactly.len(), exact.len());
        let mut engine = pile.exact_sweep().unwrap();
        for ((contacts, swept), bounds) in exact.iter().zip(&swept_exactly).zip(&bounds) {
            let site = contacts[0].site;
            engine.advance(site.k).unwrap();
            assert_eq!(engine.passed_on(site).unwrap(), *swept);
            for ((contact, force), bound) in contacts.iter().zip(swept).zip(bounds) {
                assert_eq!(contact.force, *force, "{site:?}");
                let enclosure = bound.enclosure().unwrap();
                assert!(enclosure.contains(force), "{site:?}");
            }
        }
    }
}

/// The worst error of a sweep that stops at each layer, and the bound on it.
fn error_and_bound<F: Algebra>(
    pile: &Pile,
    exact: &[[BigRational; 3]],
    value: fn(F) -> Option<BigRational>,
) -> [BigRational; 2] {
    let forces = swept::<F>(pile).into_iter().flatten();
    let errors = forces.zip(exact.iter().flatten()).map(|(force, exact)| {
        let error = value(force).unwrap() - exact;
        error.abs()
    });
    let mut sweep = pile.sweep::<F>().unwrap();
    for k in 0..pile.layers() - 1 {
        sweep.advance(k).unwrap();
    }
    [errors.max().unwrap(), sweep.error_bound().unwrap()]
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
        let exact = swept::<BigRational>(&pile);
        let greatest = exact.iter().flatten().max().unwrap();
        let [single, bound] = error_and_bound::<f32>(&pile, &exact, BigRational::from_float);
        assert!(single <= bound, "{single} > {bound}");
        // And it is of use.
        assert!(bound < ratio(1, 20) * greatest, "{bound} of {greatest}");
        let [double, bound] = error_and_bound::<f64>(&pile, &exact, BigRational::from_float);
        assert!(double <= bound, "{double} > {bound}");
        assert!(bound < ratio(1, 10_000_000_000) * greatest);
    }
}

#[test]
fn a_sweep_says_what_it_does_not_do() {
    let pile = under(Region::SITE, "+-+");
    let mut sweep = pile.sweep::<f64>().unwrap();
    assert!(matches!(sweep.advance(4), Err(Error::LayerOutside { .. })));
    let elsewhere = |layer, at| Err(Error::SweepElsewhere { layer, at, last: 2 });
    assert_eq!(sweep.advance(3), elsewhere(3, 0));
    sweep.advance(2).unwrap();
    assert_eq!(sweep.advance(1), elsewhere(1, 2));
    let refused = sweep.fill([&mut [], &mut [], &mut []]);
    let needed = sweep.spheres().unwrap();
    assert_eq!(refused, Err(Error::Length { needed, given: 0 }));
    let discs = Pile::discs(4).unwrap();
    let method = Method::Sweep;
    assert_eq!(
        discs.sweep::<f64>().err(),
        Some(Error::NoSuchMethod { method })
    );
    let one = Pile::triangular(1).unwrap();
    let alone = one.sweep::<f64>().unwrap();
    let refused = alone.fill([&mut [0.0], &mut [0.0], &mut [0.0]]);
    assert_eq!(refused, Err(Error::OnFloor { site: Site::APEX }));
    let below = one.exact_sweep().unwrap().passed_on(Site::APEX);
    assert_eq!(below, Err(Error::OnFloor { site: Site::APEX }));
}

#[test]
fn one_contact_of_a_million_layers_visits_no_other_sphere() {
    let pile = Pile::triangular(1_000_000).unwrap();
    let counters = Counters::default();
    let statics = pile.statics::<f64>().metered(&counters);
    let site = Site {
        i: 123_456,
        j: 7,
        k: 700_000,
    };
    let force = statics.contact(site, Direction::Beta).unwrap();
    assert!((force - 123_457.0).abs() < 0.5);
    assert_eq!((counters.visited(), counters.turned()), (1, 0));
}

#[test]
fn roots_are_taken_once_and_only_where_needed() {
    let pile = Pile::triangular(12).unwrap();
    let counters = Counters::default();
    let spacing = Spacing::new(ratio(6, 5)).unwrap();
    let packing = Packing::new(&pile, &spacing).unwrap().metered(&counters);
    assert_eq!(counters.roots(), 0);
    let base = || all(packing.base(pile.rows(Selection::Base).unwrap())).unwrap();
    base();
    assert_eq!(counters.roots(), 2);
    base();
    packing.on_floor(Site { i: 1, j: 1, k: 11 }).unwrap();
    assert_eq!(counters.roots(), 2);
    all(packing.contacts(pile.rows(Selection::All).unwrap())).unwrap();
    assert_eq!(counters.roots(), 5);
    // Multiples need none, and a straight stacking no transfer.
    let counters = Counters::default();
    let statics = pile.statics::<BigRational>().metered(&counters);
    all(statics.contacts(pile.rows(Selection::All).unwrap())).unwrap();
    assert_eq!(
        (counters.roots(), counters.turned(), counters.passes()),
        (0, 0, 0)
    );
}

/// Layers wide enough to be swept in several bands, each on a thread of its own where there are threads.
#[test]
fn wide_layers_are_swept_in_bands() {
    let top = Region::hexagon(70, 60).unwrap();
    let pile = under(top, "+-++-")
        .with_load(Site { i: 3, j: -5, k: 1 }, ratio(22, 7))
        .unwrap();
    let lines = pile.statics::<BigRational>().by(Method::Tree).unwrap();
    let mut floats = pile.sweep::<f64>().unwrap();
    let mut exact = pile.exact_sweep().unwrap();
    floats.advance(1).unwrap();
    for k in [2, 4] {
        floats.advance(k).unwrap();
        exact.advance(k).unwrap();
        let n = floats.spheres().unwrap();
        assert!(n > 10_000);
        let mut forces = [(); 3].map(|()| vec![0.0; n]);
        let [a, b, c] = forces.each_mut().map(Vec::as_mut_slice);
        floats.fill([a, b, c]).unwrap();
        let bound = floats.error_bound().unwrap();
        let sites = pile.rows(Selection::Layer(k)).unwrap().flatten();
        for (place, site) in sites.enumerate().step_by(101) {
            let passed_on = exact.passed_on(site).unwrap();
            for (direction, force) in Direction::ALL.into_iter().zip(passed_on) {
                assert_eq!(lines.contact(site, direction).unwrap(), force, "{site}");
                let float = forces[direction.index()][place];
                let error = (BigRational::from_float(float).unwrap() - force).abs();
                assert!(error <= bound, "{site} {direction}: {error} > {bound}");
            }
        }
    }
}

/// So many spheres that they are filled in several parts.
#[test]
fn large_piles_are_filled_in_parts() {
    let layers = 90;
    let pile = Pile::triangular(layers).unwrap();
    let strengths = cannonpile::Strengths::<i32>::multiples(&pile).unwrap();
    let n = strengths.spheres().unwrap();
    assert!(n > 1 << 16);
    let [mut a, mut b, mut c] = [(); 3].map(|()| vec![0; n]);
    strengths.fill([&mut a, &mut b, &mut c]).unwrap();
    let mut interleaved = vec![[0; 3]; n];
    strengths.fill_interleaved(&mut interleaved).unwrap();
    let sites = pile.rows(Selection::All).unwrap().off_the_floor().flatten();
    for (place, Site { i, j, k }) in sites.enumerate() {
        // The paper's counts, and the sphere itself.
        let counts = [k - i - j + 1, i + 1, j + 1];
        assert_eq!([a[place], b[place], c[place]].map(i128::from), counts);
        assert_eq!(interleaved[place].map(i128::from), counts);
    }
}

/// A scalar that rounds and overflows too: numbers it does not hold are an error, never left in the slices unsaid.
#[test]
fn what_overflows_in_a_sweep_is_an_error() {
    let pile = Pile::under(Region::SITE, Stacking::hcp(50).unwrap()).unwrap();
    let mut sweep = pile.sweep::<Pair<f64, FixedRational<i64>>>().unwrap();
    sweep.advance(48).unwrap();
    let n = sweep.spheres().unwrap();
    let mut forces = [(); 3].map(|()| vec![Pair::from_rational(&ratio(0, 1)); n]);
    let [a, b, c] = forces.each_mut().map(Vec::as_mut_slice);
    assert!(matches!(sweep.fill([a, b, c]), Err(Error::Overflow { .. })));
}

/// One sphere below more changes of sign than a tree may have nodes: the plan says a sweep, and so it is, asked for in
/// rows or alone.
#[test]
fn one_sphere_is_left_to_a_sweep_where_its_tree_is_too_large() {
    let layers = 420;
    let pile = Pile::under(Region::SITE, Stacking::hcp(layers).unwrap()).unwrap();
    let site = Site {
        i: 0,
        j: 0,
        k: layers - 2,
    };
    let plan = pile.plan(Selection::One(site)).unwrap();
    assert_eq!(plan.method, Method::Sweep);
    let counters = Counters::default();
    let statics = pile.statics::<f64>().metered(&counters);
    let rows = pile.rows(Selection::One(site)).unwrap();
    let forces = all(statics.contacts(rows)).unwrap();
    assert_eq!(forces.len(), 3);
    for (name, most, counted) in promises(&plan, &counters) {
        assert!(BigUint::from(counted) <= most, "{counted} {name}");
    }
    assert!(counters.passes() > 400);
}

/// Loads with long denominators, so that numbers have as many limbs as threads share out.
#[test]
fn wide_numbers_are_swept_limb_by_limb() {
    let long = |power: u32, at: Site, pile: Pile| {
        let load = BigRational::new(1.into(), BigInt::from(10).pow(power));
        pile.with_load(at, load).unwrap()
    };
    let pile = under(Region::hexagon(3, 2).unwrap(), "+-++-+--+-+-+-+");
    let pile = long(200, Site { i: 0, j: 1, k: 0 }, pile);
    let pile = long(117, Site { i: 1, j: 0, k: 7 }, pile);
    let by_sweep = Question {
        method: Some(Method::Sweep),
        ..Selection::All.into()
    };
    assert!(pile.plan(by_sweep).unwrap().planes > 12);
    let mut plain = pile.sweep::<BigRational>().unwrap();
    for k in 0..pile.layers() - 1 {
        plain.advance(k).unwrap();
        let mut forces = [(); 3].map(|()| vec![BigRational::default(); plain.spheres().unwrap()]);
        plain
            .fill(forces.each_mut().map(Vec::as_mut_slice))
            .unwrap();
        // In one go, so that passes wait for each other.
        let mut engine = pile.exact_sweep().unwrap();
        engine.advance(k).unwrap();
        for (place, site) in pile
            .rows(Selection::Layer(k))
            .unwrap()
            .flatten()
            .enumerate()
        {
            let expected = forces.each_ref().map(|forces| forces[place].clone());
            assert_eq!(engine.passed_on(site).unwrap(), expected, "{site}");
        }
    }
}

/// Numbers outgrow one limb after another; what is asked on the way changes nothing.
#[test]
fn numbers_grow_limb_by_limb() {
    let pile = Pile::under(Region::SITE, Stacking::hcp(160).unwrap()).unwrap();
    let last = pile.layers() - 2;
    let mut straight_down = pile.exact_sweep().unwrap();
    straight_down.advance(last).unwrap();
    let mut in_steps = pile.exact_sweep().unwrap();
    for k in [1, 2, 9, 11, 40, 41, 43, 90, 131, last] {
        in_steps.advance(k).unwrap();
    }
    let mut sum = BigRational::default();
    for site in pile.rows(Selection::Layer(last)).unwrap().flatten() {
        let forces = straight_down.passed_on(site).unwrap();
        assert_eq!(in_steps.passed_on(site).unwrap(), forces, "{site}");
        sum += forces.into_iter().sum::<BigRational>();
    }
    // f cosθ of each contact together carry all layers above: f is in mg/(3 cosθ).
    let floor = pile.shape().base().sites();
    let above = BigInt::from(pile.spheres() - floor);
    assert_eq!(sum, BigRational::from_integer(above * 3));
}
