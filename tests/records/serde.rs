//! Data survives a round trip through serde, as JSON and in a format that does not describe itself. Invalid data is rejected
//! when it is read.

mod piles;

use cannonpile::geometry::{LayerGap, Spacing, Vector};
use cannonpile::lattice::{
    Axis, Dimension, Direction, HorizontalContact, MAX_LAYERS, Region, Row, Sign, Site,
};
use cannonpile::scalar::{DoubleDouble, FixedRational, Interval, Surd};
use cannonpile::shape::Selection;
use cannonpile::stacking::{Pattern, Run, Stacking};
use cannonpile::{
    BaseExtremes, ContactForce, Counters, FloorForce, Method, PackedContact, Packing, Pile, Plan,
    Quantity, Question, Standing, Verdict,
};
use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::json::{back, refusal};
use num_rational::BigRational;

const SITE: Site = Site {
    i: -1,
    j: 2,
    k: MAX_LAYERS,
};

#[test]
fn words() {
    for (direction, text) in Direction::ALL.iter().zip(["alpha", "beta", "gamma"]) {
        assert_eq!(back(direction), format!("\"{text}\""));
    }
    assert_eq!(back(&[Sign::Plus, Sign::Minus]), r#"["+","-"]"#);
    let verdicts = [Verdict::Yes, Verdict::No, Verdict::Undetermined];
    assert_eq!(back(&verdicts), r#"["yes","no","undetermined"]"#);
    let methods = [Method::Closed, Method::Tree, Method::Sweep];
    assert_eq!(back(&methods), r#"["closed","tree","sweep"]"#);
    back(&[Quantity::Contacts, Quantity::Floor]);
    assert_eq!(back(&[Dimension::Two, Dimension::Three]), "[2,3]");
    assert!(refusal::<Direction>("\"delta\"").contains("alpha, beta or gamma"));
    assert!(refusal::<Sign>("\"\"").contains("+ or -"));
    assert!(refusal::<Verdict>("\"maybe\"").contains("undetermined"));
    assert!(refusal::<Method>("\"guess\"").contains("closed, tree or sweep"));
    assert!(refusal::<Quantity>("\"mood\"").contains("contacts or floor"));
    assert!(refusal::<Dimension>("4").contains("2 (discs) or 3 (spheres)"));
    assert!(refusal::<Direction>("1").contains("a string"));
}

#[test]
fn lattices() {
    assert_eq!(
        back(&SITE),
        format!(r#"{{"i":-1,"j":2,"k":"{MAX_LAYERS}"}}"#)
    );
    let row = Row {
        k: 3,
        j: 1,
        i: 0..3,
    };
    assert_eq!(back(&row), r#"{"k":3,"j":1,"i":{"start":0,"end":3}}"#);
    let selections = [Selection::Base, Selection::All, Selection::Layer(3)];
    assert_eq!(back(&selections), r#"["base","all",{"layer":3}]"#);
    back(&Selection::One(SITE));
    for (shape, text) in [
        ("hexagon:3,2", "hexagon:3,2"),
        ("hexagon:1", "hexagon:1"),
        ("region:0..3,0..3,0..3", "triangle:4"),
        ("region:-2..5,1..1,-1..6", "region:-2..5,1..1,-1..6"),
    ] {
        assert_eq!(
            back(&shape.parse::<Region>().unwrap()),
            format!("\"{text}\"")
        );
    }
    back(&Region::new(-MAX_LAYERS..=MAX_LAYERS, 0..=5, -MAX_LAYERS..=7).unwrap());
    // Reading uses the checked constructor.
    assert!(refusal::<Region>("\"region:5..9,5..9,0..2\"").contains("no site"));
    assert!(refusal::<Region>("\"hexagon:0\"").contains("at least 1"));
    assert!(refusal::<Region>(&format!("\"triangle:{}\"", MAX_LAYERS + 1)).contains("10^36"));
    assert!(refusal::<Site>(r#"{"i":"0","j":"0"}"#).contains("`k`"));
    assert!(refusal::<Site>(r#"{"i":"0","j":"0","k":"0","l":"0"}"#).contains("`l`"));
    assert!(refusal::<Site>(r#"{"i":"0","j":"0","k":"1.5"}"#).contains("'1.5'"));
    assert!(refusal::<Selection>("\"top\"").contains("unknown variant"));
}

#[test]
fn stackings() {
    for (text, written) in [
        ("++-+", "++-+"),
        ("ABCBC", "++-+"),
        ("A", "A"),
        ("(100,3,100)", "(100,3,100)"),
        ("-(100,3,100)", "-(100,3,100)"),
    ] {
        let stacking: Stacking = text.parse().unwrap();
        assert_eq!(back(&stacking), format!("\"{written}\""));
        assert_eq!(back(&Pattern::Spelled(stacking)), format!("\"{written}\""));
    }
    assert_eq!(
        back(&[Pattern::Fcc, Pattern::Hcp, Pattern::Dhcp]),
        r#"["fcc","hcp","dhcp"]"#
    );
    let run = Run {
        sign: Sign::Minus,
        steps: 7,
    };
    assert_eq!(back(&run), r#"{"sign":"-","steps":7}"#);
    assert!(refusal::<Stacking>("\"++*\"").contains("such as ++-+"));
    assert!(refusal::<Stacking>("\"\"").contains("such as ++-+"));
    assert!(refusal::<Stacking>(&format!("\"({MAX_LAYERS})\"")).contains("10^36"));
    assert!(refusal::<Pattern>("\"bcc\"").contains("'bcc'"));
}

/// A record whose field uses the module `number`.
#[derive(Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(bound = "T: cannonpile::data::Number")]
struct Field<T> {
    #[serde(with = "cannonpile::data::number")]
    x: T,
}

#[test]
fn numbers() {
    let field = |x: BigRational| back(&Field { x });
    assert_eq!(field(ratio(-7, 3)), r#"{"x":"-7/3"}"#);
    assert_eq!(field(ratio(4, 2)), r#"{"x":"2"}"#);
    assert_eq!(
        back(&Field {
            x: Some(ratio(1, 3))
        }),
        r#"{"x":"1/3"}"#
    );
    assert_eq!(back(&Field { x: None::<i128> }), r#"{"x":null}"#);
    assert_eq!(
        back(&Field {
            x: vec![i128::MIN, 0]
        }),
        format!(r#"{{"x":["{}",0]}}"#, i128::MIN)
    );
    assert_eq!(back(&Field { x: 0.1 }), r#"{"x":0.1}"#);
    for (x, text) in [
        (Surd::from(ratio(7, 3)), "7/3"),
        (
            Surd::new(ratio(-7, 3), ratio(8, 17)).unwrap(),
            "-14/51*sqrt(34)",
        ),
        (Surd::sqrt(ratio(2, 1)).unwrap(), "sqrt(2)"),
        (-Surd::sqrt(ratio(2, 1)).unwrap(), "-sqrt(2)"),
        (Surd::zero(), "0"),
    ] {
        assert_eq!(back(&x), format!("\"{text}\""));
        back(&Field {
            x: [x.clone(), x.clone(), x],
        });
    }
    assert_eq!(back(&Spacing::new(ratio(6, 5)).unwrap()), "\"6/5\"");
    assert_eq!(
        back(&Spacing::from_square(ratio(8, 3)).unwrap()),
        "\"2/3*sqrt(6)\""
    );
    let fixed = |n, d| FixedRational::<i8>::new(n, d);
    assert_eq!(back(&fixed(6, -4)), "\"-3/2\"");
    assert!(serde_json::to_string(&FixedRational::<i8>::FAULT).is_err());
    for (text, part) in [
        ("\"1/0\"", "other than zero"),
        ("\"one\"", "6/5, 1.2 or 1e-3"),
        ("\"\"", "such as"),
        ("1", "a string"),
        ("null", "a string"),
    ] {
        let message = refusal::<Field<BigRational>>(&format!("{{\"x\":{text}}}"));
        assert!(message.contains(part), "{text}: {message}");
    }
    assert!(refusal::<Field<num_bigint::BigUint>>(r#"{"x":"-1"}"#).contains("not negative"));
    assert!(refusal::<Field<num_bigint::BigInt>>(r#"{"x":"1/2"}"#).contains("integer"));
    assert!(refusal::<Surd>("\"sqrt(-1)\"").contains("not real"));
    assert!(refusal::<Surd>("\"2sqrt(3)\"").contains("such as"));
    assert!(refusal::<Surd>("\"2*sqrt(3\"").contains("such as"));
    assert!(refusal::<Spacing>("\"0\"").contains("positive"));
    assert!(refusal::<Spacing>("\"-sqrt(2)\"").contains("positive"));
    assert!(refusal::<FixedRational<i8>>("\"128\"").contains("does not fit"));
    assert!(refusal::<FixedRational<i8>>("\"-128\"").contains("does not fit"));
}

#[test]
fn floats_keep_their_last_bit() {
    let third = Interval::new(1.0 / 3.0, (1.0_f64 / 3.0).next_up()).unwrap();
    assert_eq!(
        back(&third),
        r#"{"lower":"0.3333333333333333","upper":"0.33333333333333337"}"#
    );
    assert_eq!(back(&Interval::WHOLE), r#"{"lower":"-inf","upper":"inf"}"#);
    back(&Interval::point(f64::from_bits(1)));
    assert!(refusal::<Interval>(r#"{"lower":"1","upper":"0"}"#).contains("at most upper"));
    assert!(refusal::<Interval>(r#"{"lower":"NaN","upper":"0"}"#).contains("at most upper"));
    assert!(refusal::<Interval>(r#"{"lower":"inf","upper":"inf"}"#).contains("no real number"));
    assert!(refusal::<Interval>(r#"{"lower":"x","upper":"0"}"#).contains("a float"));
    let tenth = <DoubleDouble as cannonpile::scalar::Algebra>::from_rational(&ratio(1, 10));
    assert!(tenth.low() != 0.0);
    back(&tenth);
    back(&DoubleDouble::new(-0.0));
    back(&DoubleDouble::new(f64::INFINITY));
    for parts in [r#""1","low":"1e-16""#, r#""1e300","low":"-1e200""#] {
        serde_json::from_str::<DoubleDouble>(&format!("{{\"high\":{parts}}}")).expect(parts);
    }
    for parts in [
        r#""1","low":"0.5""#,
        r#""1","low":"NaN""#,
        r#""inf","low":"1""#,
        r#""0","low":"5e-324""#,
    ] {
        assert!(
            refusal::<DoubleDouble>(&format!("{{\"high\":{parts}}}")).contains("too large"),
            "{parts}"
        );
    }
}

#[test]
fn answers() {
    let region = Region::hexagon(2, 2).unwrap();
    let pile = Pile::under(region, "+-++-".parse().unwrap()).unwrap();
    let forces = pile.forces::<BigRational>();
    let contacts: Vec<ContactForce<BigRational>> = forces
        .contacts(Selection::All)
        .unwrap()
        .collect::<Result<_, _>>()
        .unwrap();
    back(&contacts);
    let floats = pile.forces::<f64>();
    back(
        &floats
            .contacts(Selection::All)
            .unwrap()
            .collect::<Result<Vec<ContactForce<f64>>, _>>()
            .unwrap()[0],
    );
    back(
        &forces
            .base(Selection::Base)
            .unwrap()
            .collect::<Result<Vec<FloorForce<BigRational>>, _>>()
            .unwrap(),
    );
    let contact = HorizontalContact {
        site: Site { i: 0, j: 1, k: 2 },
        axis: Axis::GammaBeta,
    };
    let pushed = pile
        .clone()
        .with_horizontal_force(contact, ratio(2, 7))
        .unwrap();
    let text = back(&pushed);
    assert!(text.contains(
        r#""horizontal":[{"site":{"i":0,"j":1,"k":2},"axis":"gamma-beta","force":"2/7"}]"#
    ));
    let touching = Packing::new(&pushed, &Spacing::new(ratio(1, 1)).unwrap()).unwrap();
    let packed = touching
        .horizontal_contact_in_si(contact, &ratio(2, 7))
        .unwrap();
    assert!(back(&packed).contains(r#""direction":"gamma-beta""#));
    let packing = Packing::new(&pile, &Spacing::new(ratio(6, 5)).unwrap()).unwrap();
    back(
        &packing
            .contacts(Selection::All)
            .unwrap()
            .collect::<Result<Vec<PackedContact>, _>>()
            .unwrap(),
    );
    back(
        &packing
            .base(Selection::Base)
            .unwrap()
            .collect::<Result<Vec<FloorForce<Surd>>, _>>()
            .unwrap(),
    );
    let vector = forces
        .contact_direction(Site::APEX, Direction::Beta)
        .unwrap();
    assert_eq!(back(&vector), r#"{"x":"1/2","y":"-1/2","z":"-1"}"#);
    let intervals = vector
        .into_array()
        .map(|x| <Interval as cannonpile::scalar::Algebra>::from_rational(&x));
    let [x, y, z] = intervals;
    back(&Vector { x, y, z });
    let standing: Standing = pile.standing().unwrap();
    assert!(standing.first_failure.is_some());
    back(&standing);
    let extremes: BaseExtremes = pile.base_extremes().unwrap();
    back(&extremes);
    let question = Question::new(Selection::Layer(3), Quantity::Contacts);
    let question = question.with_method(Method::Tree);
    back(&question);
    let plan: Plan = pile.plan(question).unwrap();
    back(&plan);
    let counters = Counters::default();
    let _ = packing
        .with_counters(&counters)
        .contacts(Selection::All)
        .unwrap()
        .count();
    assert!(counters.rows() > 0);
    // Counters are written but never read.
    let rows = counters.rows();
    let written = serde_json::to_value(&counters).unwrap();
    assert_eq!(written["rows"], rows);
    assert_eq!(back(&LayerGap { layers: 2 }), r#"{"layers":2}"#);
}
