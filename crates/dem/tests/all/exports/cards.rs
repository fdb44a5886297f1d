//! Tests of benchmark cards: oracles confirm every number, and parsers can read the files.

use std::collections::BTreeMap;
use std::fs;
use std::str::FromStr;

use cannonpile::Pile;
use cannonpile::lattice::{Direction, Site};
use cannonpile::scalar::Surd;
use cannonpile::shape::Selection;
use cannonpile_dem::scene::{Case, Scene, State, cases};
use cannonpile_dem::{CardTitle, PileExport, PileFile};
use cannonpile_testkit::answers::{Shape, ratio};
use cannonpile_testkit::cases::{Bounds, Case as Twice};
use cannonpile_testkit::oracles::balance::{Place, place};
use cannonpile_testkit::oracles::elimination;
use cannonpile_testkit::scenes::{for_each_pile, text};
use num_rational::BigRational;
use num_traits::{Signed, Zero};
use serde_json::Value;

/// Returns the JSON card and the Markdown card of a case.
fn cards(case: &Case) -> (Value, String) {
    let scene = case.scene().expect("a scene");
    let pile = scene
        .in_state(scene.pile().expect("a pile"))
        .expect("a state");
    let packing = scene.packing(&pile).expect("room");
    let title = CardTitle {
        case: case.name().into(),
        title: case.title().into(),
        purpose: case.purpose().into(),
        state: scene.state,
        stiffness_ratio: (scene.state == State::Elastic).then(|| scene.stiffness_ratio.clone()),
    };
    let export = PileExport::new(&packing).expect("files");
    let export = export.with_scene(scene.to_toml()).with_title(title);
    let json = text(&export, PileFile::CardJson);
    let json = serde_json::from_str(&json).expect("JSON");
    (json, text(&export, PileFile::CardMarkdown))
}

fn card(name: &str) -> Value {
    cards(Case::named(name).expect("a case")).0
}

fn rational(value: &Value) -> BigRational {
    let text = value.as_str().expect("an exact number");
    BigRational::from_str(text).expect("a rational")
}

fn surd(value: &Value) -> Surd {
    let text = value["exact"].as_str().expect("an exact number");
    text.parse().expect("a surd")
}

fn integer(value: &Value) -> i128 {
    value.to_string().parse().expect("an integer")
}

/// Collects all numbers that a card states both exactly and as floats.
fn pairs<'v>(value: &'v Value, found: &mut Vec<&'v Value>) {
    match value {
        Value::Object(entries) if entries.contains_key("exact") => found.push(value),
        Value::Object(entries) => entries.values().for_each(|value| pairs(value, found)),
        Value::Array(values) => values.iter().for_each(|value| pairs(value, found)),
        _ => {}
    }
}

/// Checks that each float is the correctly rounded exact number, and returns the number of floats.
fn judge_floats(card: &Value) -> Result<usize, String> {
    let mut found = Vec::new();
    pairs(card, &mut found);
    for pair in &found {
        let nearest: f64 = surd(pair).nearest().expect("a float");
        let float = pair["float"].as_f64().expect("a float");
        if nearest.to_bits() != float.to_bits() {
            return Err(format!("{pair}: {nearest:?}"));
        }
    }
    Ok(found.len())
}

#[test]
fn floats_are_correctly_rounded() {
    for case in cases() {
        let (card, _) = cards(case);
        let count = judge_floats(&card).expect("correctly rounded floats");
        assert!(count > 15, "{}: {count}", case.name());
    }
    // The check detects an error of 1 ulp.
    let mut planted = card("C1");
    let float = &mut planted["answers"]["greatest"]["force"]["float"];
    *float = float.as_f64().expect("a float").next_up().into();
    assert!(judge_floats(&planted).is_err());
}

/// The forces of a pile from an independent computation: in f₀ below each sphere by direction, and on the floor in mg,
/// mg·tanθ and √3·mg·tanθ (for discs mg·tanθ).
struct Oracle {
    below: BTreeMap<(Place, &'static str), BigRational>,
    floor: BTreeMap<Place, [BigRational; 3]>,
    weight: BigRational,
}

const NAMES: [&str; 3] = ["alpha", "beta", "gamma"];

impl Oracle {
    fn of(twice: &Twice) -> Self {
        let forces = twice.balance.forces();
        let below = forces.below.iter().flat_map(|(place, forces)| {
            let named = NAMES.into_iter().zip(forces);
            named.map(|(name, force)| ((*place, name), force.clone()))
        });
        Self {
            below: below.collect(),
            weight: twice.balance.whole_weight(),
            floor: forces.floor,
        }
    }

    fn of_discs(layers: i128) -> Self {
        let answers = elimination::solve(&Shape::Discs, layers);
        let name = |direction| match direction {
            Direction::Alpha => "alpha",
            Direction::Beta => "beta",
            Direction::Gamma => "gamma",
        };
        let below = answers.contacts.iter().map(|((site, direction), contact)| {
            ((place(*site), name(*direction)), contact.force.clone())
        });
        // The oracle's downward forces are positive here.
        let floor = answers.floor.iter().map(|(site, force)| {
            let (normal, x) = (force.z.abs(), force.x.clone());
            (place(*site), [normal, x, BigRational::zero()])
        });
        Self {
            below: below.collect(),
            floor: floor.collect(),
            weight: ratio(i64::try_from(layers * (layers + 1) / 2).expect("few"), 1),
        }
    }
}

/// Returns the oracle of a case. Its pile is defined here, independently of the scene.
fn oracle(name: &str) -> Option<Oracle> {
    let straight = |layers: usize| Twice::under(&Bounds::SITE, &"+".repeat(layers - 1));
    let hexagon = Bounds::hexagon(3, 3);
    Some(Oracle::of(&match name {
        "C1" => straight(4),
        "C2" => straight(10),
        "C3" | "C10" => straight(8),
        // (k, j, i)
        "C4" => straight(8).with_load((2, 1, 0), &ratio(3, 1)),
        "C5" => straight(8).weightless().with_load((0, 0, 0), &ratio(1, 1)),
        "C6" => Twice::under(&hexagon, "++++"),
        "C7" => Twice::under(&hexagon, "+-+"),
        "C8" => Twice::under(&Bounds::SITE, "+-+-+-"),
        "C9" => Twice::under(&Bounds::SITE, "+-++++"),
        "C12" => {
            Twice::on(&Bounds::hexagon(5, 4), "+++").expect("a base large enough for the stacking")
        }
        "C13" => return Some(Oracle::of_discs(8)),
        _ => return None,
    }))
}

/// Returns the site of a record as (k, j, i).
fn named(record: &Value) -> Place {
    let j = record.get("j").map_or(0, integer);
    (integer(&record["k"]), j, integer(&record["i"]))
}

/// Checks that the answers of a card equal those of an oracle.
fn judge(card: &Value, oracle: &Oracle) -> Result<(), String> {
    let pile = &card["pile"];
    let flat = integer(&pile["dimension"]) == 2;
    let square = |value: &Value| surd(value).square();
    let q = square(&pile["spacing"]);
    let sin2 = &q / ratio(if flat { 4 } else { 3 }, 1);
    let cos2 = ratio(1, 1) - &sin2;
    let weight = surd(&pile["mass"]).to_rational().expect("m")
        * surd(&pile["gravity"]).to_rational().expect("g");
    let unit = &weight / ratio(if flat { 2 } else { 3 }, 1);
    let wrong = |what: &str| Err(format!("{what} of {}", card["title"]));
    if square(&pile["sin_theta"]) != sin2 || square(&pile["cos_theta"]) != cos2 {
        return wrong("θ");
    }
    let answers = &card["answers"];
    // Each force is its multiple of mg/(W cosθ), with its sign.
    let is_force = |record: &Value, multiple: &BigRational| {
        let (force, given) = (surd(&record["force"]), rational(&record["multiple"]));
        let size = &unit * &unit / &cos2 * multiple * multiple;
        given == *multiple
            && force.square() == size
            && force.coefficient().is_negative() == multiple.is_negative()
    };
    let force = |record: &Value| {
        let direction = record["direction"].as_str().expect("a direction");
        let found = oracle
            .below
            .iter()
            .find(|((place, name), _)| *place == named(record) && *name == direction);
        found.map(|(_, force)| force.clone())
    };
    let all: Vec<&BigRational> = oracle.below.values().collect();
    let extremes = [("greatest", all.iter().max()), ("least", all.iter().min())];
    for (name, extreme) in extremes {
        let extreme = extreme.expect("a contact");
        if !is_force(&answers[name], extreme) || force(&answers[name]).as_ref() != Some(extreme) {
            return wrong(name);
        }
    }
    let bearing = all.iter().filter(|force| !force.is_zero()).count();
    let pulling = all.iter().filter(|force| force.is_negative()).count();
    for (name, count) in [
        ("bearing", bearing),
        ("idle", all.len() - bearing),
        ("pulling", pulling),
    ] {
        if answers[name].as_u64() != Some(count as u64) {
            return wrong(name);
        }
    }
    if surd(&answers["total_on_floor"]).to_rational() != Some(&oracle.weight * &weight) {
        return wrong("the weight");
    }
    let contacts = answers["contacts"].as_array().expect("a list of contacts");
    if contacts.len() != all.len() {
        return wrong("contacts");
    }
    for record in contacts {
        if !force(record).is_some_and(|multiple| is_force(record, &multiple)) {
            return wrong(&record.to_string());
        }
    }
    let tan2 = &sin2 / &cos2;
    let base = answers["base"]
        .as_array()
        .expect("a list of bottom spheres");
    if base.len() != oracle.floor.len() {
        return wrong("the floor");
    }
    for record in base {
        let [normal, x, y] = &oracle.floor[&named(record)];
        let shear = |name: &str, multiple: &BigRational, square: &BigRational| {
            let given = surd(&record[name]);
            let wanted = multiple * multiple * &weight * &weight * square;
            given.square() == wanted && given.coefficient().is_negative() == multiple.is_negative()
        };
        let holds = surd(&record["normal"]).to_rational() == Some(normal * &weight)
            && shear("shear_x", x, &tan2)
            && shear("shear_y", y, &(&tan2 * ratio(3, 1)));
        if !holds {
            return wrong(&record.to_string());
        }
    }
    let normals: Vec<BigRational> = oracle
        .floor
        .values()
        .map(|force| &force[0] * &weight)
        .collect();
    for (name, extreme) in [
        ("normal_min", normals.iter().min()),
        ("normal_max", normals.iter().max()),
    ] {
        if surd(&answers[name]).to_rational().as_ref() != extreme {
            return wrong(name);
        }
    }
    // The greatest ratio over all spheres with a normal force.
    let ratios = oracle.floor.values().filter(|force| !force[0].is_zero());
    let ratios = ratios.map(|[n, x, y]| (x * x + y * y * ratio(3, 1)) / (n * n) * &tan2);
    if ratios.max() != Some(square(&answers["max_shear_ratio"])) {
        return wrong("the ratio of shear");
    }
    Ok(())
}

/// A change that plants a fault in a card.
type Plant = fn(&mut Value);

#[test]
fn answers_equal_those_of_an_oracle() {
    let mut judged = 0;
    for case in cases() {
        let Some(oracle) = oracle(case.name()) else {
            continue;
        };
        judge(&cards(case).0, &oracle).expect("answers of the oracle");
        judged += 1;
    }
    assert_eq!(judged, 12);
    // The check detects the oracle of another pile, and each planted fault.
    let right = oracle("C2").expect("an oracle");
    assert!(judge(&card("C3"), &right).is_err());
    let planted: [(&str, Plant); 6] = [
        ("a contact", |card| {
            card["answers"]["contacts"][3]["multiple"] = "8".into();
        }),
        ("a force", |card| {
            card["answers"]["contacts"][3]["force"]["exact"] = "5/39*sqrt(17)".into();
        }),
        ("a sign", |card| {
            card["answers"]["base"][0]["shear_x"]["exact"] = "3/13*sqrt(39)".into();
        }),
        ("the greatest", |card| {
            card["answers"]["greatest"] = card["answers"]["least"].clone();
        }),
        ("a count", |card| {
            card["answers"]["bearing"] = 494.into();
        }),
        ("a normal force", |card| {
            card["answers"]["normal_max"]["exact"] = "5".into();
        }),
    ];
    for (what, plant) in planted {
        let mut card = card("C2");
        judge(&card, &right).expect("right before");
        plant(&mut card);
        assert!(judge(&card, &right).is_err(), "{what}");
    }
}

#[test]
fn elastic_cards_equal_the_elastic_state() {
    let scene = Case::named("C11").and_then(Case::scene).expect("a scene");
    let pile = scene
        .in_state(scene.pile().expect("a pile"))
        .expect("a state");
    let card = card("C11");
    let contacts = card["answers"]["contacts"].as_array().expect("contacts");
    assert_eq!(contacts.len(), 126 + 3);
    assert_eq!(card["answers"]["bearing_horizontal"], 3);
    let mut multiples = Vec::new();
    for record in contacts {
        let multiple = rational(&record["multiple"]);
        let (k, j, i) = named(record);
        let site = Site { i, j, k };
        let name = record["direction"].as_str().expect("a direction");
        let horizontal = pile
            .horizontal_forces()
            .find(|(contact, _)| contact.site == site && contact.axis.name() == name)
            .map(|(_, force)| force.clone());
        let sloping = NAMES.iter().position(|other| *other == name).map(|line| {
            let below = pile.forces::<BigRational>().to_below(site);
            below.expect("off the floor")[line].clone()
        });
        assert_eq!(horizontal.or(sloping).as_ref(), Some(&multiple), "{record}");
        multiples.push(multiple);
    }
    let greatest = rational(&card["answers"]["greatest"]["multiple"]);
    let least = rational(&card["answers"]["least"]["multiple"]);
    assert_eq!(
        (multiples.iter().max(), multiples.iter().min()),
        (Some(&greatest), Some(&least))
    );
}

#[test]
fn a_large_case_refers_to_its_tables() {
    let (card, page) = cards(Case::named("C14").expect("a case"));
    let answers = &card["answers"];
    for list in ["contacts", "base"] {
        let file = answers[format!("{list}_file")].as_str();
        assert!(answers[list].is_null() == (list == "contacts") && file.is_some());
    }
    // A straight pile: the greatest force is L−1 f₀, the least is 1 f₀, and each bottom sphere bears (L+2)/3 mg.
    assert_eq!(answers["greatest"]["multiple"], "39");
    assert_eq!(answers["least"]["multiple"], "1");
    assert_eq!(surd(&answers["normal_min"]), surd(&answers["normal_max"]));
    assert_eq!(
        surd(&answers["normal_max"]).to_rational(),
        Some(ratio(14, 1))
    );
    assert_eq!(answers["bearing"], 31_980);
    assert!(answers["derivatives"].is_null());
    for file in ["spheres.csv", "contacts.csv", "base.csv"] {
        assert!(page.contains(&format!("`{file}`")), "{file}");
    }
    assert!(page.len() < 10_000, "{}", page.len());
}

/// Returns the multiples of f₀ of all contacts of the card of a scene, and the derivatives by parameter, if it has any.
fn derivatives(scene: &str) -> (Vec<BigRational>, Option<BTreeMap<String, Vec<BigRational>>>) {
    let scene = Scene::from_toml(scene).expect("a scene");
    let pile = scene.in_state(scene.pile().expect("a pile"));
    let pile = pile.expect("a state");
    let packing = scene.packing(&pile).expect("room");
    let export = PileExport::new(&packing).expect("files");
    let card: Value = serde_json::from_str(&text(&export, PileFile::CardJson)).expect("JSON");
    let page = text(&export, PileFile::CardMarkdown);
    let answers = &card["answers"];
    let contacts = answers["contacts"].as_array().expect("contacts").iter();
    let records = answers["derivatives"].as_array();
    assert_eq!(page.contains("derivatives"), records.is_some());
    let by_parameter = records.map(|records| {
        let records = records.iter().map(|record| {
            let parameter = record["parameter"].as_str().expect("a parameter");
            let all = record["of_contacts"].as_array().expect("numbers").iter();
            (parameter.to_owned(), all.map(rational).collect())
        });
        records.collect()
    });
    (
        contacts
            .map(|contact| rational(&contact["multiple"]))
            .collect(),
        by_parameter,
    )
}

/// Forces are linear in loads and tilts, so difference quotients are exact.
#[test]
fn cards_list_derivatives_unless_other_spheres_touch() {
    let scene = "stacking = '+-+'\nspacing = '6/5'\n";
    let (before, by_parameter) = derivatives(scene);
    let by_parameter = by_parameter.expect("derivatives");
    assert_eq!(by_parameter.len(), 23 * 4 + 2);
    for (parameter, key, change) in [
        ("load z 1 1 0", "load = ['1,1,0=7']", ratio(7, 1)),
        ("load x 2 0 1", "load = ['2,0,1=0,7,0']", ratio(7, 1)),
        ("load y 0 0 0", "load = ['0,0,0=0,0,-1/2']", ratio(-1, 2)),
        ("tilt x", "tilt = '1/9,0'", ratio(1, 9)),
        ("tilt y", "tilt = '0,-2/3'", ratio(-2, 3)),
    ] {
        let (after, _) = derivatives(&format!("{scene}{key}"));
        let quotients = after.iter().zip(&before);
        let quotients = quotients.map(|(after, before)| (after - before) / &change);
        assert_eq!(
            quotients.collect::<Vec<_>>(),
            by_parameter[parameter],
            "{key}"
        );
    }
    for scene in [
        "layers = 3\nstacking = 'hcp'\nstate = 'elastic'",
        "layers = 3\nspacing = 1",
        "layers = 1\nspacing = '6/5'",
    ] {
        assert_eq!(derivatives(scene).1, None, "{scene}");
    }
}

/// Returns the tables of a page, each as rows of cells.
fn tables(page: &str) -> Result<Vec<Vec<Vec<String>>>, String> {
    let mut tables: Vec<Vec<Vec<String>>> = Vec::new();
    let (mut code, mut before) = (false, "");
    for line in page.lines() {
        if line.starts_with("```") {
            code = !code;
        }
        if code || !line.starts_with('|') {
            before = line;
            continue;
        }
        let inside = line
            .strip_prefix('|')
            .and_then(|line| line.strip_suffix('|'));
        let inside = inside.ok_or_else(|| format!("a row without an end: {line}"))?;
        let cells: Vec<String> = inside
            .split('|')
            .map(|cell| cell.trim().to_owned())
            .collect();
        match tables.last_mut() {
            Some(table) if before.starts_with('|') => {
                if table[0].len() != cells.len() {
                    return Err(format!(
                        "{} cells, not {}: {line}",
                        cells.len(),
                        table[0].len()
                    ));
                }
                table.push(cells);
            }
            _ if before.is_empty() => tables.push(vec![cells]),
            _ => return Err(format!("no empty line before {line}")),
        }
        before = line;
    }
    for table in &tables {
        let rules = table
            .get(1)
            .is_some_and(|row| row.iter().all(|cell| cell == "---"));
        if !rules || table.len() < 3 {
            return Err(format!("no table: {:?}", table[0]));
        }
    }
    (!code)
        .then_some(tables)
        .ok_or_else(|| "code without an end".into())
}

/// Selects the numbers of a record that its row contains.
type Values = fn(&Value) -> Vec<&Value>;

/// The Markdown card contains the numbers of the JSON card.
#[test]
fn pages_have_whole_tables_with_the_same_numbers() {
    for case in cases() {
        let (card, page) = cards(case);
        assert!(page.starts_with(&format!("# {}: {}\n", case.name(), case.title())));
        assert!(page.contains(case.purpose()) && page.ends_with("```\n"));
        let tables = tables(&page).expect("whole tables");
        let code = |value: &Value| format!("`{}`", value["exact"].as_str().expect("exact"));
        let float = |value: &Value| format!("`{:?}`", value["float"].as_f64().expect("a float"));
        let lists: [(&str, &Value, Values); 3] = [
            ("direction", &card["answers"]["contacts"], |record| {
                vec![&record["force"]]
            }),
            ("normal (N)", &card["answers"]["base"], |record| {
                vec![&record["normal"], &record["shear_x"], &record["shear_y"]]
            }),
            ("x", &card["pile"]["list_of_spheres"], |record| {
                vec![&record["x"], &record["y"], &record["z"]]
            }),
        ];
        for (head, list, values) in lists {
            let found = tables
                .iter()
                .find(|table| table[0].contains(&head.to_owned()));
            let records = list.as_array().filter(|records| records.len() <= 130);
            assert_eq!(
                found.is_some(),
                records.is_some(),
                "{}: {head}",
                case.name()
            );
            let (Some(table), Some(records)) = (found, records) else {
                continue;
            };
            assert_eq!(table.len() - 2, records.len());
            for (row, record) in table[2..].iter().zip(records) {
                let first = record.get("id1").or(record.get("id"));
                assert_eq!(row[0], first.expect("a number").to_string());
                for value in values(record) {
                    assert!(row.contains(&code(value)), "{row:?}: {value}");
                }
                if head == "direction" {
                    assert!(row.contains(&float(&record["force"])), "{row:?}");
                }
            }
        }
        for name in ["greatest", "least"] {
            let row = format!("{name} contact force");
            let row = page
                .lines()
                .find(|line| line.starts_with(&format!("| {row}")));
            let force = &card["answers"][name]["force"];
            let row = row.expect("a row");
            assert!(
                row.contains(&code(force)) && row.contains(&float(force)),
                "{row}"
            );
        }
    }
    for (broken, why) in [
        ("\n| a | b |\n|---|---|\n| 1 |\n", "a cell is missing"),
        ("text\n| a |\n|---|\n| 1 |\n", "text runs into it"),
        ("\n| a |\n| 1 |\n| 2 |\n", "no rule"),
        ("```\n", "code goes on"),
    ] {
        assert!(tables(broken).is_err(), "{why}");
    }
}

/// A card has the same references as README and CITATION.cff.
#[test]
fn there_is_one_way_to_cite() {
    let cases = cases();
    let (card, _) = cards(cases.first().expect("a case"));
    let cite = card["cite"].as_str().expect("text");
    let file = |name: &str| {
        let path = format!("{}/../../{name}", env!("CARGO_MANIFEST_DIR"));
        fs::read_to_string(path).expect("a file")
    };
    let (readme, citation) = (file("README.md"), file("CITATION.cff"));
    let entries: Vec<&str> = cite.split_inclusive("\n}").map(str::trim).collect();
    assert_eq!(entries.len(), 2, "{cite}");
    let paper = "Contact forces in regular {3D} granular pile";
    assert!(entries[0].contains(paper) && readme.contains(&paper.replace(['{', '}'], "")));
    assert!(readme.contains(entries[1]), "{}", entries[1]);
    let fields = entries[1].lines().filter_map(|line| line.split_once(" = "));
    for (key, value) in fields.filter(|(key, _)| key.trim() != "year") {
        let value = value.trim_matches(['{', '}', ',']);
        assert!(citation.contains(value), "{key}: {value}");
    }
}

/// Every pile has a card, with a generated title.
#[test]
fn every_kind_of_pile_has_a_card() {
    for_each_pile(|scene, export| {
        let card: Value = serde_json::from_str(&text(export, PileFile::CardJson)).expect("JSON");
        judge_floats(&card).expect("correctly rounded floats");
        assert_eq!(card["schema"], "cannonpile-card");
        assert_eq!(card["schema_version"], 1);
        assert_eq!(card["cannonpile"], env!("CARGO_PKG_VERSION"));
        assert!(card["case"].is_null() && card["scene"].is_null());
        let page = text(export, PileFile::CardMarkdown);
        tables(&page).expect("whole tables");
        assert!(page.starts_with("# A pile of "), "{scene:?}");
        let packing = export.packing();
        let greatest = packing.contact_forces(Selection::All).expect("forces");
        let greatest = greatest
            .map(|contact| contact.expect("a force").force)
            .max();
        let horizontal = packing.pile().horizontal_forces();
        let horizontal = horizontal
            .map(|(_, force)| packing.unit_force().scaled(force))
            .max();
        match greatest.max(horizontal) {
            None => assert!(card["answers"]["greatest"].is_null()),
            Some(greatest) => assert_eq!(surd(&card["answers"]["greatest"]["force"]), greatest),
        }
    });
}

#[test]
fn unstable_piles_have_other_criteria() {
    let names = |card: &Value| -> Vec<String> {
        let criteria = card["criteria"].as_array().expect("criteria");
        let names = criteria
            .iter()
            .map(|one| one["name"].as_str().expect("a name").to_owned());
        names.collect()
    };
    let falls = card("C8");
    assert_eq!(falls["answers"]["stands"], "no");
    assert_eq!(
        names(&falls),
        ["contacts are lost", "no equilibrium in this shape"]
    );
    assert!(
        falls["outcome"]
            .as_str()
            .is_some_and(|text| text.contains("490/9477*sqrt(13) N"))
    );
    assert_eq!(names(&card("C2")), ["contacts", "forces", "floor", "order"]);
    assert!(names(&card("C5")).contains(&"contacts without a force".to_owned()));
    assert!(card("C5")["answers"]["stands"].is_null());
    // Without contacts only the forces on the floor can be checked.
    let pile = Pile::triangular(1).expect("a pile");
    let packing = Scene::default().packing(&pile).expect("room");
    let export = PileExport::new(&packing).expect("files");
    let alone: Value = serde_json::from_str(&text(&export, PileFile::CardJson)).expect("JSON");
    assert_eq!(names(&alone), ["floor"]);
}

#[test]
fn a_title_cannot_break_a_file() {
    let pile = Pile::triangular(3).expect("a pile");
    let packing = Scene::default().packing(&pile).expect("room");
    let title = CardTitle {
        title: "two\nlines {spheres} {positions}".into(),
        ..CardTitle::default()
    };
    let export = PileExport::new(&packing).expect("files").with_title(title);
    let text = text(&export, PileFile::CardMarkdown);
    let is_title =
        |line: &str| line.starts_with('#') && line.ends_with("two lines {spheres} {positions}");
    assert!(text.lines().any(is_title), "{text}");
}

#[test]
fn cards_with_friction_state_the_exact_verdict() {
    use cannonpile::{Packing, Pile, ratio};
    use cannonpile_dem::{Friction, PileExport, PileFile};

    // tan(θ/2) = 1/3, and the floor needs 1/9. No float has these values.
    let pile = Pile::discs(2).expect("a pile");
    let packing = Packing::new(&pile, &"6/5".parse().expect("a spacing")).expect("a packing");
    let card = |spheres, floor| {
        let friction =
            Friction::sufficient(&packing).and_then(|friction| friction.with_spheres(&spheres));
        let friction = friction
            .and_then(|friction| friction.with_floor(&floor))
            .expect("coefficients");
        let export = PileExport::new(&packing).and_then(|export| export.on_rough_floor(friction));
        let mut card = Vec::new();
        let written =
            export
                .expect("an export")
                .write_file(PileFile::CardMarkdown, &mut card, &mut |_| {});
        written.expect("a card");
        String::from_utf8(card).expect("a text")
    };
    let stands = card(ratio!(1 / 3), ratio!(1 / 9));
    assert!(stands.contains("| stands | yes |") && stands.contains("The pile stands"));
    assert!(stands.contains("reports `accepted yes`, exit status 0."));
    for (spheres, floor) in [
        (ratio!(333 / 1000), ratio!(1 / 9)),
        (ratio!(1 / 3), ratio!(111 / 1000)),
    ] {
        let falls = card(spheres, floor);
        assert!(falls.contains("| stands | no |") && falls.contains("The pile falls"));
        assert!(!falls.contains("accepted yes"));
    }
}
