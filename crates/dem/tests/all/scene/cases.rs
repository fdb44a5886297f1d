//! The benchmark cases: published cases are unchanged, and have the published outcome.

use cannonpile::geometry::Load;
use cannonpile::scalar::{Algebra, Polynomial, Symbol};
use cannonpile::shape::Selection;
use cannonpile::{ContactForce, Forces, Verdict};
use cannonpile_dem::scene::{Case, Floor, Scene, SceneFile, State, cases};
use cannonpile_dem::{Component, Error, Parameter, derivatives};
use cannonpile_stability::{RoughPacking, sensitivity};
use cannonpile_testkit::answers::ratio;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive};

/// Returns the 64-bit hash of Fowler, Noll and Vo (FNV-1a).
fn hash(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// The published cases: name, hash of the file, and stability.
///
/// If a case differs, correct the case and not this list, because the numbers of the case have been quoted.
const PUBLISHED: &[(&str, u64, &str)] = &[
    ("C1", 0x24df_3656_8a52_6e45, "yes"),
    ("C2", 0xd4b1_374d_08e5_20ec, "yes"),
    ("C3", 0x7b10_6421_a9ac_1348, "yes"),
    ("C4", 0xbeeb_c738_ee61_0326, "yes"),
    ("C5", 0xf452_03d2_81fb_c0be, ""),
    ("C6", 0xf2ca_e33f_21e8_1cf5, "yes"),
    ("C7", 0x1f81_1dea_5d12_34f1, "yes"),
    ("C8", 0x6599_cbf7_d04a_83bd, "no"),
    ("C9", 0x9773_bc47_c3e1_4483, "yes"),
    ("C10", 0x96d0_a519_65cd_5937, "yes"),
    ("C11", 0xb952_fbd2_6931_db60, "yes"),
    ("C12", 0x5c41_fdca_1b1b_380b, "yes"),
    ("C13", 0x913e_1b0d_1822_45ce, "yes"),
    ("C14", 0x340a_b3ba_88cf_2c6b, "yes"),
    ("C15", 0x9f41_54c2_072e_280f, "yes"),
    ("C16", 0x0b09_104d_5fc7_7257, "no"),
    ("C17", 0x8644_cf90_7344_35d9, "yes"),
    ("C18", 0x1e7d_0bdc_3574_cd4a, "yes"),
    ("C19", 0x20ad_45b7_63da_7303, "no"),
    ("C20", 0xb7f9_6889_061d_012a, "no"),
    ("C21", 0x4683_9311_51b8_6c16, "yes"),
    ("C22", 0xa73d_4180_257c_e967, "yes"),
];

#[test]
fn published_cases_are_unchanged() {
    let found: Vec<_> = cases()
        .iter()
        .map(|case| (case.name(), hash(case.toml()), case.stands()))
        .collect();
    let published = PUBLISHED.iter().map(|(name, hash, stands)| {
        let stands = match *stands {
            "yes" => Some(Verdict::Yes),
            "no" => Some(Verdict::No),
            _ => None,
        };
        (*name, *hash, stands)
    });
    let published: Vec<_> = published.collect();
    let listing: Vec<String> = found
        .iter()
        .map(|(name, hash, _)| format!("(\"{name}\", {hash:#018x}, …)"))
        .collect();
    assert_eq!(found, published, "{}", listing.join("\n"));
    // The hash detects a change of one digit.
    let case = Case::named("C2").expect("a case");
    assert_ne!(hash(&case.toml().replace("10", "11")), hash(case.toml()));
}

#[test]
fn every_case_is_read_and_written() {
    for case in cases() {
        let scene = case.scene().expect("a scene");
        assert_eq!(scene.to_toml(), case.toml(), "{}", case.name());
        assert_eq!(Scene::from_toml(&scene.to_toml()), Ok(scene.clone()));
        let file: SceneFile = case.file().expect("a file");
        assert_eq!(file.scene(), &scene);
        assert_eq!(Case::named(case.name()), Ok(case));
        assert_eq!(Case::named(&case.name().to_lowercase()), Ok(case));
        for text in [case.title(), case.purpose()] {
            assert!(
                !text.is_empty() && text.is_ascii() || text.contains('²'),
                "{text}"
            );
            assert!(!text.contains(['|', '\n', '"']), "{text}");
        }
    }
}

#[test]
fn every_case_has_its_stated_stability() {
    for case in cases() {
        let scene = case.scene().expect("a scene");
        let pile = scene
            .in_state(scene.pile().expect("a pile"))
            .expect("a state");
        if scene.floor == Floor::Rough {
            // This test compares the friction at each contact with floats. The verdict is exact.
            let packing = scene.packing(&pile).expect("room");
            let rough = RoughPacking::new(&packing).expect("two layers");
            let slides = |friction: &Option<BigRational>, needed: f64| {
                let friction = friction.as_ref().and_then(ToPrimitive::to_f64);
                needed > friction.expect("a coefficient")
            };
            let mut falls = false;
            for contact in rough.contacts(Selection::All).expect("contacts") {
                let contact = contact.expect("a contact");
                let tangential: f64 = contact.tangential.nearest().expect("a float");
                let normal = contact.normal.to_f64().expect("a float");
                falls |= slides(&scene.friction, tangential / normal);
            }
            for force in rough.base(Selection::Base).expect("a base") {
                let force = force.expect("a force");
                let [x, y, normal] = [force.shear_x, force.shear_y, force.normal]
                    .map(|part| part.nearest::<f64>().expect("a float"));
                falls |= slides(&scene.floor_friction, x.hypot(y) / normal);
            }
            let verdict = if falls { Verdict::No } else { Verdict::Yes };
            assert_eq!(Some(verdict), case.stands(), "{}", case.name());
            assert_eq!(scene.stands_with_friction(&packing), Ok(Some(!falls)));
            continue;
        }
        // This test examines every force. The verdict examines few.
        let sloping = pile.forces::<BigRational>().contacts(Selection::All);
        let mut pulls = sloping
            .expect("contacts")
            .any(|contact| contact.expect("a contact").force.is_negative());
        pulls |= pile
            .horizontal_forces()
            .any(|(_, force)| force.is_negative());
        let stands = match (pile.is_weightless(), pulls) {
            (true, _) => None,
            (false, true) => Some(Verdict::No),
            (false, false) => Some(Verdict::Yes),
        };
        assert_eq!(stands, case.stands(), "{}", case.name());
        // In unstable cases no further contact could support the pile.
        let packing = scene.packing(&pile).expect("room");
        assert_eq!(
            packing.touching().is_empty(),
            scene.state == State::Isostatic,
            "{}",
            case.name()
        );
    }
}

/// The derivatives by loads and by the tilt are the coefficients of the forces under a load t, and under a tilt (t, t²). Those by
/// radii have their own test, in `cannonpile-stability`.
#[test]
fn derivatives_are_the_coefficients_of_a_symbol() {
    let t = || Polynomial::from(Symbol("t"));
    let constant = |x: &BigRational| Polynomial::constant(x);
    for name in ["C21", "C22", "C13"] {
        let scene = Case::named(name).and_then(Case::scene).expect("a scene");
        let pile = scene.pile().expect("a pile");
        let packing = scene.packing(&pile).expect("room");
        let mut found = derivatives(&packing).expect("derivatives");
        let mut next = |wanted: Parameter| {
            let record = found.next().expect("a parameter");
            let (parameter, derivatives) = record.expect("derivatives");
            assert_eq!(parameter, wanted, "{name}");
            derivatives
        };
        let axes = pile.dimension().directions().len();
        let exact: Vec<_> = all_contacts(&pile.forces::<BigRational>());
        for sphere in pile.sites(Selection::All).expect("spheres") {
            let changes = sensitivity::<BigRational>(&packing, sphere).expect("changes");
            let by_radius = next(Parameter::Radius(sphere));
            assert!(changes.iter().map(|contact| &contact.change).eq(&by_radius));
            let components = [Component::Z, Component::X, Component::Y];
            for (axis, unit) in components.into_iter().zip(Load::units()).take(axes) {
                let symbolic = Load {
                    down: t() * &constant(&unit.down),
                    x: t() * &constant(&unit.x),
                    y: t() * &constant(&unit.y),
                };
                let loaded = pile.forces().with_load(sphere, symbolic).expect("a load");
                let slopes = next(Parameter::Load(axis, sphere));
                for ((loaded, exact), slope) in
                    all_contacts(&loaded).iter().zip(&exact).zip(&slopes)
                {
                    let line = constant(&exact.force) + &(t() * &constant(slope));
                    assert_eq!(loaded.force, line, "{name} {sphere}");
                }
            }
        }
        let flat = axes == 2;
        let along_y = if flat {
            constant(&ratio(0, 1))
        } else {
            t() * &t()
        };
        let leaning = pile.forces().with_tilt([t(), along_y.clone()]);
        let by_x = next(Parameter::Tilt(Component::X));
        let by_y = if flat {
            by_x.clone()
        } else {
            next(Parameter::Tilt(Component::Y))
        };
        assert!(found.next().is_none());
        let leaning = all_contacts(&leaning.expect("a tilt"));
        for (((leaning, exact), x), y) in leaning.iter().zip(&exact).zip(by_x).zip(by_y) {
            let slopes = t() * &constant(&x) + &(along_y.clone() * &constant(&y));
            assert_eq!(leaning.force, constant(&exact.force) + &slopes, "{name}");
        }
    }
}

fn all_contacts<T: Algebra>(forces: &Forces<'_, T>) -> Vec<ContactForce<T>> {
    let contacts = forces.contacts(Selection::All).expect("contacts");
    contacts
        .map(|contact| contact.expect("a contact"))
        .collect()
}

#[test]
fn unknown_names_are_refused() {
    for (given, says) in [
        ("C23", "there is no case 'C23'; did you mean 'C2'?"),
        ("d3", "there is no case 'd3'; did you mean 'C3'?"),
        (
            "hcp",
            "there is no case 'hcp'; 'cannonpile cases' lists those there are",
        ),
        (
            "",
            "there is no case ''; 'cannonpile cases' lists those there are",
        ),
    ] {
        let refused = Case::named(given).expect_err("no case");
        assert_eq!(refused.to_string(), says);
        assert!(matches!(refused, Error::UnknownCase { .. }), "{refused:?}");
    }
}
