//! One generic body for each formula. Enclosures contain the exact answer, rounded scalars are close to it, and polynomials
//! evaluate to it.

use cannonpile::formula::{
    force, half_turn, increments, resultant, support_load, transmitted, tripled_apart,
    tripled_half_turn, unbalanced, weight,
};
use cannonpile::geometry::{Vector, directions, disc_directions, position, squared_distance};
use cannonpile::lattice::{Direction, Site, count};
use cannonpile::scalar::{Algebra, DoubleDouble, Exactness, Field, Interval, Polynomial, Symbol};
use cannonpile::shape::Selection;
use cannonpile::{Error, Pile};
use cannonpile_testkit::real::Bounded;
use num_bigint::BigInt;
use num_rational::BigRational as Q;
use num_traits::{One, Signed, Zero};

/// The growth of a quantity with the pile, which scales its rounding error.
#[derive(Clone, Copy, Debug)]
enum Growth {
    /// Forces and positions: a few times the depth.
    Linear,
    /// Squared distances.
    Square,
    /// Numbers of spheres.
    Cube,
}

/// Every formula at a site (i, j, k) of a pile of L layers, with s = sin φ and σ = sin²θ. `turn` is the half-turn of the
/// scalar.
fn formulas<T: Algebra>(
    [i, j, k, l, s, sin2]: &[T; 6],
    turn: fn(&[T; 3]) -> [T; 3],
) -> Vec<(&'static str, Growth, T)> {
    let above = count::above(i, j, k);
    let (e, w) = (directions(s), increments(s));
    let lines = || above.iter().cloned().zip(&w);
    let by_line = |each: &dyn Fn((T, &T)) -> T| {
        let forces: Vec<T> = lines().map(each).collect();
        <[T; 3]>::try_from(forces).expect("three lines")
    };
    let from_above = by_line(&|(n, w)| force(n, w));
    let to_below = by_line(&|(n, w)| transmitted(force(n, w), w));
    let mut all = Vec::new();
    let mut add = |name, growth, values: Vec<T>| {
        all.extend(values.into_iter().map(|value| (name, growth, value)));
    };
    add("increments", Growth::Linear, w.to_vec());
    add("weight", Growth::Linear, vec![weight(&w)]);
    add(
        "directions",
        Growth::Linear,
        e.clone().into_iter().flat_map(Vector::into_array).collect(),
    );
    let discs = disc_directions::<T>()
        .into_iter()
        .flat_map(Vector::into_array);
    add("disc_directions", Growth::Linear, discs.collect());
    add("above", Growth::Linear, above.to_vec());
    add("half_turn", Growth::Linear, turn(&above).to_vec());
    add("force", Growth::Linear, from_above.to_vec());
    add("transmitted", Growth::Linear, to_below.to_vec());
    add(
        "tripled_half_turn",
        Growth::Linear,
        tripled_half_turn(&above).to_vec(),
    );
    add(
        "tripled_apart",
        Growth::Linear,
        tripled_apart(&above).to_vec(),
    );
    add(
        "position",
        Growth::Linear,
        position(&above, &e).into_array().to_vec(),
    );
    add(
        "resultant",
        Growth::Linear,
        resultant(&from_above, &e).into_array().to_vec(),
    );
    let on_floor = support_load(&from_above, &e, &weight(&w));
    add(
        "support_load",
        Growth::Linear,
        on_floor.into_array().to_vec(),
    );
    add(
        "unbalanced",
        Growth::Linear,
        unbalanced(&to_below, &e, &from_above, &e, &weight(&w))
            .into_array()
            .to_vec(),
    );
    add(
        "squared_distance",
        Growth::Square,
        vec![squared_distance(&above, s, sin2)],
    );
    for d in [2, 3] {
        add("spheres", Growth::Cube, vec![count::spheres(l, d)]);
        add(
            "spheres_in_layer",
            Growth::Cube,
            vec![count::spheres_in_layer(k, d)],
        );
        add("contacts", Growth::Cube, vec![count::contacts(l, d)]);
        add(
            "contacts_of_strength",
            Growth::Cube,
            vec![count::contacts_of_strength(l, k, d)],
        );
    }
    all
}

/// Sites in piles of up to 10⁶ layers, with sin φ and sin²θ. They have no pattern and are the same in every run.
fn places() -> impl Iterator<Item = [Q; 6]> {
    let next = |n: &u64| Some(n.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1));
    let mut numbers = core::iter::successors(Some(1998), next)
        .skip(1)
        .map(|n| i64::try_from(n >> 34).expect("30 bits"));
    let mut below = move |n: i64| numbers.next().expect("endless") % n;
    (0..1000).map(move |n| {
        let l = 1 + below([3, 20, 1000, 1_000_000][n % 4]);
        let k = below(l);
        let j = below(k + 1);
        let i = below(k - j + 1);
        let mut proper = |d: i64| Q::new((1 + below(d - 1)).into(), d.into());
        let (s, sin2) = (proper([2, 3, 10, 997][n % 4]), proper(1001));
        let [i, j, k, l] = [i, j, k, l].map(|n| Q::from_integer(n.into()));
        [i, j, k, l, s, sin2]
    })
}

/// The allowed rounding errors in units of 2^−p times the growth: a few, for any precision p.
const ROUNDINGS: i64 = 8;

/// Returns whether an answer is as close to the exact one as its scalar permits.
fn is_near<T: Algebra + Bounded>(got: &T, want: &Q, growth: &Q) -> bool {
    let Some(bounds) = got.enclosure() else {
        return false;
    };
    if let Exactness::Rounded { bits } = T::EXACTNESS {
        let unit = growth / (BigInt::one() << bits);
        (bounds.lower - want).abs() <= unit * BigInt::from(ROUNDINGS)
    } else {
        // An enclosure must contain the exact value and keep most digits.
        let unit = growth / (BigInt::one() << 53);
        let width = &bounds.upper - &bounds.lower;
        bounds.contains(want) && width <= unit * BigInt::from(2 * ROUNDINGS)
    }
}

/// G g for the exact scalar, whose numerators are integers.
fn exact_turn(g: &[Q; 3]) -> [Q; 3] {
    tripled_half_turn(g).map(|tripled| tripled / BigInt::from(3))
}

fn formulas_are_near<T: Field + Algebra<Numerator = T> + Bounded>() {
    for place in places() {
        let exact = formulas(&place, exact_turn);
        let [_, _, _, l, ..] = &place;
        for ((name, growth, got), (_, _, want)) in
            formulas(&place.clone().map(|x| T::from_rational(&x)), half_turn::<T>)
                .into_iter()
                .zip(exact)
        {
            let size = l + Q::from_integer(3.into());
            let growth = match growth {
                Growth::Linear => size,
                Growth::Square => &size * &size * BigInt::from(4),
                Growth::Cube => &size * &size * &size,
            };
            assert!(
                is_near(&got, &want, &growth),
                "{name} in {}: {got:?} for {want} at {place:?}",
                T::NAME
            );
        }
    }
}

#[test]
fn intervals_contain_the_exact_value() {
    formulas_are_near::<Interval>();
}

#[test]
fn double_doubles_are_near() {
    formulas_are_near::<DoubleDouble>();
}

#[test]
fn doubles_are_near() {
    formulas_are_near::<f64>();
}

#[test]
fn singles_are_near() {
    formulas_are_near::<f32>();
}

/// Computes with symbols and then evaluates. The result equals the computation with numbers.
#[test]
fn polynomials_evaluate_to_the_exact_value() {
    let symbols = ["i", "j", "k", "L", "s", "σ"].map(Symbol);
    let on_symbols = formulas(&symbols.map(Polynomial::from), half_turn::<Polynomial>);
    for place in places().step_by(3) {
        let values: Vec<_> = symbols.into_iter().zip(place.clone()).collect();
        let enclosed: Vec<_> = values
            .iter()
            .map(|(symbol, x)| (*symbol, Interval::from_rational(x)))
            .collect();
        for ((name, _, polynomial), (_, _, want)) in
            on_symbols.iter().zip(formulas(&place, exact_turn))
        {
            assert_eq!(
                polynomial.evaluate(&values).as_ref(),
                Some(&want),
                "{name}: {polynomial}"
            );
            let bounds = polynomial
                .evaluate(&enclosed)
                .expect("a value for every symbol");
            assert!(bounds.contains(&want), "{name}: {polynomial} in {bounds:?}");
        }
    }
}

/// All answers about a pile.
fn answers<T: Algebra>(pile: &Pile) -> Result<Vec<T>, Error> {
    let forces = pile.forces::<T>();
    let mut all = vec![forces.increment_sum()?];
    for direction in Direction::ALL {
        all.extend(forces.direction(direction)?.into_array());
    }
    for site @ Site { k, .. } in pile.shape().sites() {
        all.extend(forces.from_above(site)?);
        all.extend(forces.position(site)?.into_array());
        all.extend(forces.resultant_above(site)?.into_array());
        if k < pile.layers() - 1 {
            all.extend(forces.unbalanced(site)?.into_array());
            for direction in pile.dimension().directions() {
                all.push(forces.contact(site, *direction)?);
                all.extend(forces.contact_vector(site, *direction)?.into_array());
            }
        }
    }
    for force in forces.base(Selection::Base)? {
        let force = force?;
        all.extend([force.normal, force.shear_x, force.shear_y]);
    }
    Ok(all)
}

fn piles() -> impl Iterator<Item = Pile> {
    let ratio = |n: i64, d: i64| Q::new(n.into(), d.into());
    (1..=12).flat_map(move |layers| {
        let sines = [ratio(1, 2), ratio(1, 3), ratio(6, 7), ratio(1, 1_000_003)];
        let isosceles = sines.map(|s| Pile::isosceles(layers, s));
        isosceles
            .into_iter()
            .chain([Pile::discs(layers)])
            .map(|pile| pile.expect("a pile"))
    })
}

fn statics_are_near<T: Field + Bounded>(layers: i128) {
    for pile in piles().filter(|pile| pile.layers() <= layers) {
        let growth = Q::from_integer((pile.layers() + 3).into());
        let exact = answers::<Q>(&pile).expect("exact answers");
        let got = answers::<T>(&pile).expect("answers");
        assert_eq!(got.len(), exact.len());
        for (got, want) in got.iter().zip(&exact) {
            assert!(
                is_near(got, want, &growth),
                "{got:?} for {want} in {pile:?}"
            );
        }
    }
}

#[test]
fn statics_in_intervals_contain_the_exact_answer() {
    statics_are_near::<Interval>(12);
}

#[test]
fn statics_in_rounded_scalars_are_near() {
    statics_are_near::<DoubleDouble>(8);
    statics_are_near::<f64>(8);
    statics_are_near::<f32>(8);
}

#[test]
fn statics_in_polynomials_are_exact() {
    for pile in piles().filter(|pile| pile.layers() <= 4) {
        let exact = answers::<Q>(&pile).expect("exact answers");
        let constants = answers::<Polynomial>(&pile).expect("constants");
        assert!(
            constants
                .iter()
                .map(Polynomial::to_constant)
                .eq(exact.into_iter().map(Some))
        );
    }
}

/// Enclosures that miss the value, and values that are too far off, are detected.
#[test]
fn wrong_answers_are_caught() {
    let (third, one) = (Q::new(1.into(), 3.into()), Q::one());
    assert!(is_near(&Interval::from_rational(&third), &third, &one));
    assert!(!is_near(&Interval::point(1.0 / 3.0), &third, &one));
    assert!(!is_near(
        &Interval::new(0.0, 1.0).expect("an interval"),
        &third,
        &one
    ));
    assert!(!is_near(&Interval::WHOLE, &third, &one));
    assert!(is_near(&(1.0 / 3.0), &third, &one) && !is_near(&0.333_333_333_333, &third, &one));
    assert!(!is_near(&DoubleDouble::new(1.0 / 3.0), &third, &one));
    assert!(!is_near(&f64::NAN, &Q::zero(), &one));
}
