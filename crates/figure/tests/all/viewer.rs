//! The viewer: data compared with the tables, escaping of markup, content security policy, and size limits.

use std::collections::BTreeMap;
use std::io;

use base64::Engine;
use base64::engine::general_purpose::STANDARD as BASE64;
use cannonpile::Pile;
use cannonpile::lattice::{Dimension, Region};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile_dem::scene::{Scene, State, parse};
use cannonpile_dem::table::{self, FileFormat, NumberFormat, Units, WriteError};
use cannonpile_dem::{CardTitle, OtherFile, PileExport, PileFile};
use cannonpile_figure::Error;
use cannonpile_figure::viewer::Page;
use cannonpile_testkit::scenes::{columns, for_each_pile, packing, text};
use num_bigint::BigInt;
use num_rational::BigRational;
use serde_json::Value;

/// Returns the content of the data script.
fn json_of(page: &str) -> &str {
    let data = page.split_once("<script type=\"application/json\" id=\"data\">");
    let (_, data) = data.expect("data");
    data.split_once("</script>").expect("an end").0
}

fn data(page: &str) -> Value {
    serde_json::from_str(json_of(page)).expect("JSON")
}

/// Returns the data of the viewer of a pile.
fn data_of(export: &PileExport<'_>) -> Value {
    let page = Page::new(export.packing()).expect("a page");
    data(&page.to_html().expect("a text"))
}

fn bytes(value: &Value) -> Vec<u8> {
    BASE64
        .decode(value.as_str().expect("base64"))
        .expect("base64")
}

fn floats(value: &Value) -> Vec<f64> {
    let bytes = bytes(value);
    let floats = bytes.chunks_exact(8);
    floats
        .map(|bytes| f64::from_le_bytes(bytes.try_into().expect("eight")))
        .collect()
}

fn indices(value: &Value) -> Vec<usize> {
    let width = usize::try_from(value["bytes"].as_u64().expect("a width")).expect("few");
    let bytes = bytes(&value["base64"]);
    let index = |bytes: &[u8]| {
        let digits = bytes.iter().rev();
        digits.fold(0, |index, byte| 256 * index + usize::from(*byte))
    };
    bytes.chunks_exact(width).map(index).collect()
}

fn numbers(value: &Value) -> Vec<i64> {
    let numbers = value.as_array().expect("a list").iter();
    numbers
        .map(|number| number.as_i64().expect("a number"))
        .collect()
}

/// The exact values of a quantity, with their floats.
struct Quantity {
    exact: Vec<BigRational>,
    multiples: Vec<f64>,
    newtons: Vec<f64>,
}

impl Quantity {
    fn of(value: &Value) -> Self {
        let integer = |text: &str| text.parse::<BigInt>().expect("an integer");
        let denominator = integer(value["denominator"].as_str().expect("a denominator"));
        let numerators = value["numerators"].as_str().expect("numerators");
        let exact = numerators.split_whitespace();
        Self {
            exact: exact
                .map(|text| BigRational::new(integer(text), denominator.clone()))
                .collect(),
            multiples: floats(&value["multiples"]),
            newtons: floats(&value["floats"]),
        }
    }
}

/// Returns both spheres of each contact between layers, from the rows of the viewer.
fn sloping(rows: &Value) -> Vec<[u64; 2]> {
    let (mut ends, mut first) = (Vec::new(), 1);
    let below = rows["below"].as_array().expect("spheres below");
    for (row, spheres) in numbers(&rows["spheres"]).into_iter().enumerate() {
        let spheres = u64::try_from(spheres).expect("some");
        for n in 0..spheres {
            // The rows of the bottom layer come last, and have no spheres below.
            let below = below.get(row).map(numbers).unwrap_or_default();
            let below = below
                .into_iter()
                .map(|id| u64::try_from(id).expect("an id"));
            ends.extend(below.map(|id| [first + n, id + n]));
        }
        first += spheres;
    }
    ends
}

fn exact_column(units: &Units<'_>, column: &str) -> Vec<BigRational> {
    let mut csv = Vec::new();
    let contacts = table::contacts(units, Selection::All).expect("a table");
    let written = contacts.write(FileFormat::Csv, NumberFormat::Exact, &mut csv);
    written.expect("a csv");
    let mut csv = csv::Reader::from_reader(&csv[..]);
    let place = csv
        .headers()
        .expect("heads")
        .iter()
        .position(|head| head == column);
    let cells = csv
        .records()
        .map(|row| row.expect("a row")[place.expect("a column")].parse());
    cells.collect::<Result<_, _>>().expect("rationals")
}

/// In `contacts.csv` and in the viewer horizontal contacts come last. In tables they follow their sphere.
#[test]
fn contacts_equal_the_csv() {
    for_each_pile(|scene, export| {
        let page = data_of(export);
        let csv = columns(&text(export, PileFile::ContactsCsv));
        let states = page["states"].as_array().expect("states");
        let state = states.last().expect("a state");
        let quantity = Quantity::of(&page["quantities"]["contact"]);
        let mut places = indices(&state["contacts"]);
        let mut ends = sloping(&page["rows"]);
        assert_eq!(places.len(), ends.len(), "{scene:?}");

        let horizontal = &state["horizontal"];
        places.extend(
            numbers(&horizontal["forces"])
                .into_iter()
                .map(|n| usize::try_from(n).expect("a place")),
        );
        let pile = export.packing().pile();
        for (contact, _) in pile.horizontal_forces() {
            let neighbour = pile.shape().neighbour(contact).expect("a neighbour");
            let ids =
                [contact.site, neighbour].map(|site| export.numbering().id(site).expect("an id"));
            ends.push(ids);
        }
        let named: Vec<_> = numbers(&horizontal["ids"])
            .into_iter()
            .map(|id| u64::try_from(id).expect("an id"))
            .collect();
        let wanted = &ends[ends.len() - named.len()..];
        assert!(wanted.iter().map(|ids| ids[0]).eq(named), "{scene:?}");

        #[expect(clippy::cast_precision_loss, reason = "numbers of few spheres")]
        for (n, name) in ["id1", "id2"].into_iter().enumerate() {
            let ids = ends.iter().map(|ids| ids[n] as f64);
            assert!(ids.eq(csv[name].iter().copied()), "{scene:?}");
        }
        let newtons = places.iter().map(|place| quantity.newtons[*place]);
        assert!(newtons.eq(csv["force"].iter().copied()), "{scene:?}");

        let units = Units::of_pile(pile);
        let mut wanted = exact_column(&units, "force");
        let mut found: Vec<_> = places
            .iter()
            .map(|place| quantity.exact[*place].clone())
            .collect();
        if pile.horizontal_forces().len() > 0 {
            wanted.sort();
            found.sort();
        }
        assert_eq!(found, wanted, "{scene:?}");
        for (exact, multiple) in quantity.exact.iter().zip(&quantity.multiples) {
            let nearest = cannonpile::scalar::Surd::from(exact.clone()).nearest::<f64>();
            assert_eq!(nearest, Some(*multiple));
        }
    });
}

/// The transmitted loads follow from the vertical forces in `contacts.csv`, and the base forces from `base.csv`.
#[test]
fn loads_and_shears_equal_the_csv() {
    for_each_pile(|scene, export| {
        let page = data_of(export);
        let contacts = columns(&text(export, PileFile::ContactsCsv));
        let base = columns(&text(export, PileFile::BaseCsv));
        let states = page["states"].as_array().expect("states");
        let state = states.last().expect("a state");
        let quantity = Quantity::of(&page["quantities"]["load"]);
        let loads: Vec<_> = indices(&state["loads"])
            .into_iter()
            .map(|place| quantity.newtons[place])
            .collect();
        let above = loads.len() - base["normal"].len();
        assert_eq!(loads[above..], base["normal"], "{scene:?}");
        let mut passed = vec![0.0; above];
        for (id, up) in contacts["id1"].iter().zip(&contacts["fz"]) {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a number of a sphere"
            )]
            let sphere = *id as usize - 1;
            passed[sphere] += up;
        }
        let greatest = loads
            .iter()
            .fold(0.0, |greatest: f64, load| greatest.max(load.abs()));
        for (load, passed) in loads.iter().zip(&passed) {
            assert!(
                (load - passed).abs() <= 1e-12 * greatest,
                "{scene:?}: {load} {passed}"
            );
        }
        for axis in ["shear_x", "shear_y"] {
            let quantity = Quantity::of(&page["quantities"][axis]);
            let shears: Vec<_> = indices(&state[axis])
                .into_iter()
                .map(|place| quantity.newtons[place])
                .collect();
            if let Some(wanted) = base.get(axis) {
                // The sign of −0 is not kept.
                let unsigned = |shears: &[f64]| shears.iter().map(|x| x + 0.0).collect::<Vec<_>>();
                assert_eq!(unsigned(&shears), unsigned(wanted), "{scene:?}");
            }
        }
    });
}

#[test]
fn positions_equal_the_csv() {
    for_each_pile(|scene, export| {
        let page = data_of(export);
        let csv = columns(&text(export, PileFile::SpheresCsv));
        let rows = &page["rows"];
        let step = floats(&rows["step"]);
        let flat = export.packing().pile().dimension() == Dimension::Two;
        let mut found: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
        let [x, y, z] = ["x", "y", "z"].map(|axis| floats(&rows[axis]));
        let [k, i, j, spheres] = ["k", "i", "j", "spheres"].map(|name| numbers(&rows[name]));
        let origin = ["i", "j"].map(|name| {
            rows["origin"][name]
                .as_str()
                .expect("text")
                .parse::<i64>()
                .expect("an index")
        });
        #[expect(clippy::cast_precision_loss, reason = "few spheres")]
        for row in 0..k.len() {
            for n in 0..spheres[row] {
                let mut push = |name, value| found.entry(name).or_default().push(value);
                push("k", k[row] as f64);
                push("i", (origin[0] + i[row] + n) as f64);
                push("j", (origin[1] + j[row]) as f64);
                push("x", x[row] + n as f64 * step[0]);
                push("y", y[row] + n as f64 * step[1]);
                push("z", z[row] + n as f64 * step[2]);
            }
        }
        for (name, found) in found {
            if flat && name == "j" {
                continue;
            }
            let wanted = &csv[name];
            assert_eq!(found.len(), wanted.len(), "{scene:?}");
            let from = if ["x", "y", "z"].contains(&name) {
                wanted[0]
            } else {
                0.0
            };
            let size = csv["radius"][0] * 1e-12;
            let near =
                |(found, wanted): (&f64, &f64)| (found - (wanted - from)).abs() <= size.max(0.0);
            assert!(found.iter().zip(wanted).all(near), "{scene:?} {name}");
        }
    });
}

fn page(pile: &Pile) -> Page<'_> {
    Page::new(&packing(pile)).expect("a page")
}

#[test]
fn texts_are_never_markup() {
    const MARKUP: &str = "</script><script>alert(1)</script> <!-- <b>&amp; \u{2028} \" \\";
    let pile = Pile::triangular(3).expect("a pile");
    let title = CardTitle {
        case: MARKUP.into(),
        title: MARKUP.into(),
        purpose: MARKUP.into(),
        ..CardTitle::default()
    };
    let named = page(&pile).with_title(title).with_scene(MARKUP.into());
    let named = named.to_html().expect("a page");
    let plain = page(&pile).to_html().expect("a page");
    for markup in ["<", "</script", "<script", "<!--"] {
        let count = |page: &str| page.matches(markup).count();
        assert_eq!(count(&named), count(&plain), "{markup}");
    }
    assert_eq!(named.matches("alert(1)").count(), 4);
    let (said, json) = (data(&named), json_of(&named));
    assert!(!json.contains(['<', '\u{2028}', '\u{2029}']));
    assert_eq!(said["scene"], MARKUP);
    assert_eq!(said["purpose"], MARKUP);
    // Apart from the data, the file is the same for every pile.
    assert_eq!(named.replace(json, ""), plain.replace(json_of(&plain), ""));
}

#[test]
fn viewer_loads_nothing() {
    let pile = Pile::triangular(3).expect("a pile");
    let page = page(&pile).to_html().expect("a page");
    assert_eq!(page.matches("http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'sha256-").count(), 1);
    let page = page.replace("http-equiv", "");
    for asks in [
        "http",
        "src=",
        "href=",
        "url(",
        "@import",
        "import ",
        "fetch(",
        "eval(",
        "Function(",
        "innerHTML",
        "document.write",
    ] {
        assert!(!page.contains(asks), "{asks}");
    }
}

#[test]
fn viewer_has_both_states() {
    let states = |page: &Page<'_>| {
        let data = data(&page.to_html().expect("a page"));
        let states = data["states"].as_array().expect("states");
        let names = states
            .iter()
            .map(|state| state["name"].as_str().expect("a name").to_owned());
        (names.collect::<Vec<_>>(), data)
    };
    let elastic = |stacking: &str| Scene {
        stacking: Some(stacking.parse().expect("a stacking")),
        state: State::Elastic,
        ..Scene::default()
    };
    let title = CardTitle {
        state: State::Elastic,
        ..CardTitle::default()
    };

    let scene = elastic("+-+-+");
    let given = scene.pile().expect("a pile");
    let pile = scene.in_state(given.clone()).expect("a state");
    let packing = scene.packing(&pile).expect("room");
    let shown = Page::new(&packing)
        .expect("a page")
        .with_title(title.clone());
    let (names, both) = states(&shown);
    assert_eq!(names, ["isostatic", "elastic"]);
    assert_eq!(both["touching"], true);
    let forces = |state: &Value| {
        let quantity = Quantity::of(&both["quantities"]["contact"]);
        let places = indices(&state["contacts"]).into_iter();
        places
            .map(|place| quantity.exact[place].clone())
            .collect::<Vec<_>>()
    };
    let of_pile = |pile: &Pile| {
        let contacts = pile.forces().contacts(Selection::All).expect("contacts");
        contacts
            .map(|contact| contact.expect("a force").force)
            .collect::<Vec<BigRational>>()
    };
    assert_eq!(forces(&both["states"][0]), of_pile(&given));
    assert_eq!(forces(&both["states"][1]), of_pile(&pile));
    assert_ne!(of_pile(&given), of_pile(&pile));
    assert_eq!(
        both["states"][0]["horizontal"]["ids"]
            .as_array()
            .map(Vec::len),
        Some(0)
    );
    assert_eq!(
        both["states"][1]["horizontal"]["ids"]
            .as_array()
            .map(Vec::len),
        Some(3)
    );

    // All horizontal contacts are open here, and the viewer must contain them.
    let scene = elastic("+++");
    let pile = scene
        .pile()
        .and_then(|pile| scene.in_state(pile))
        .expect("a state");
    let packing = scene.packing(&pile).expect("room");
    let shown = Page::new(&packing).expect("a page");
    assert_eq!(states(&shown).0, ["isostatic"]);
    assert_eq!(states(&shown.with_title(title)).0, ["isostatic", "elastic"]);

    let pile = Pile::triangular(4).expect("a pile");
    let (names, alone) = states(&page(&pile));
    assert_eq!(names, ["isostatic"]);
    assert_eq!(alone["touching"], false);
}

#[test]
fn rejects_piles_that_are_too_large() {
    let most = usize::try_from(Page::MAX_SPHERES).expect("few");
    let row = |spheres: usize| {
        let pile = Pile::under(
            format!("region:0..{},0..0,0..{}", spheres - 1, spheres - 1).parse::<Region>()?,
            Stacking::fcc(1)?,
        )?;
        let page = Page::new(&packing(&pile))?;
        Ok::<usize, Error>(page.to_html()?.len())
    };
    assert!(row(most).is_ok_and(|bytes| bytes < 3_000_000));
    let refused = row(most + 1).expect_err("too many");
    assert!(
        matches!(&refused, Error::TooManyGlyphs { glyphs, .. } if *glyphs == (most + 1).into())
    );
    assert!(refused.to_string().contains("--to vtp"));
    // The viewer also rejects a pile that other exports support.
    let pile = Pile::triangular(84).expect("a pile");
    let packing = packing(&pile);
    assert!(PileExport::new(&packing).is_ok());
    assert!(Page::new(&packing).is_err());
}

#[test]
fn full_output_is_an_error() {
    let pile = Pile::triangular(4).expect("a pile");
    let page = page(&pile);
    let size = page.to_html().expect("a page").len();
    for room in (0..size).step_by(97).chain([size - 1]) {
        let mut bytes = vec![0; room];
        let written = page.write(&mut &mut bytes[..]);
        let Err(WriteError::Io(error)) = written else {
            panic!("{room} bytes: {written:?}");
        };
        assert_eq!(error.kind(), io::ErrorKind::WriteZero);
    }
    assert!(page.write(&mut &mut vec![0; size][..]).is_ok());
}

/// A failed export leaves no file.
#[test]
fn overflow_is_an_error() {
    let pile = Pile::triangular(3).expect("a pile");
    let folder = tempfile::tempdir().expect("a folder");
    for (radius, mass) in [("1e400", "1"), ("1", "1e400")] {
        let scene = Scene {
            radius: parse::rational(radius).expect("a number"),
            mass: parse::rational(mass).expect("a number"),
            ..Scene::default()
        };
        let packing = scene.packing(&pile).expect("room");
        let page = Page::new(&packing).expect("a page");
        let file = OtherFile {
            name: "pile.html",
            write: &|out| page.write(out),
        };
        let new = folder.path().join("new");
        let export = PileExport::new(&packing).expect("files");
        let refused = export.write_with(&[], &[file], &new, &mut |_| {});
        let overflow = matches!(
            refused,
            Err(WriteError::Answer(cannonpile_dem::Error::Core(
                cannonpile::Error::Overflow { .. }
            )))
        );
        assert!(overflow, "{radius} {mass}: {refused:?}");
        assert!(!new.exists());
    }
}

/// At a distance of 10³⁰ R from the apex, absolute positions of all spheres round to the same float.
#[test]
fn distant_spheres_are_distinct() {
    let far = 10_i128.pow(30);
    let shape = format!("region:{far}..{},0..2,{far}..{}", far + 2, far + 4);
    let pile = Pile::under(
        shape.parse().expect("a region"),
        "+-".parse().expect("a stacking"),
    )
    .expect("a pile");
    let page = data(&page(&pile).to_html().expect("a page"));
    let rows = &page["rows"];
    assert_eq!(rows["origin"]["i"], far.to_string());
    assert!(numbers(&rows["i"]).iter().all(|i| i.abs() < 5));
    let places: Vec<_> = floats(&rows["x"]);
    assert!(places.iter().all(|x| x.abs() < 20.0) && places.iter().any(|x| *x > 1.0));
    assert!((floats(&rows["step"])[1] - 2.4).abs() < 1e-12);
}
