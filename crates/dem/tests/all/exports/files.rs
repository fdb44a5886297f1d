//! The files contain the numbers of the tables, each correctly rounded.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use cannonpile::lattice::{Axis, Dimension, Site};
use cannonpile::shape::Selection;
use cannonpile::{Load, Pile};
use cannonpile_dem::scene::State;
use cannonpile_dem::table::{self, FileFormat, NumberFormat, Table, Units};
use cannonpile_dem::{PileExport, PileFile};
use cannonpile_testkit::scenes::{bytes, columns, for_each_pile, packing, text};

fn ratio(n: i64) -> num_rational::BigRational {
    num_rational::BigRational::from_integer(n.into())
}

/// Returns the first columns of a csv text, as many as `table` has.
fn columns_of(table: &str, csv: &str) -> String {
    let count = table.lines().next().expect("headers").split(',').count();
    let lines = csv.lines().map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        assert!(cells.len() > count, "{line}");
        cells[..count].join(",") + "\n"
    });
    lines.collect()
}

fn csv_of(table: Table<'_>) -> String {
    let mut csv = Vec::new();
    table
        .write(FileFormat::Csv, NumberFormat::F64, &mut csv)
        .expect("a table");
    String::from_utf8(csv).expect("text")
}

#[test]
fn spheres_and_base_equal_the_tables() {
    for_each_pile(|scene, export| {
        let packing = export.packing();
        let spheres = table::spheres(packing, Selection::All).expect("a table");
        let written = text(export, PileFile::SpheresCsv);
        let spheres = csv_of(spheres);
        assert!(columns_of(&spheres, &written) == spheres, "{scene:?}");
        let units = Units::of_packing(packing.clone());
        let base = table::base(&units, Selection::Base).expect("a table");
        let written = text(export, PileFile::BaseCsv);
        let base = csv_of(base);
        assert!(columns_of(&base, &written) == base, "{scene:?}");
        let first = export.numbering().first_on_floor();
        for (id, line) in (first..).zip(written.lines().skip(1)) {
            assert!(line.ends_with(&format!(",{id}")), "{line}");
        }
    });
}

#[test]
fn contacts_equal_the_table_with_sphere_numbers() {
    for_each_pile(|scene, export| {
        let units = Units::of_packing(export.packing().clone());
        let table = table::contacts(&units, Selection::All).expect("a table");
        let flat = export.packing().pile().dimension() == Dimension::Two;
        let places = if flat { 3 } else { 4 };
        let wanted = csv_of(table);
        let wanted = wanted.lines().map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            [&cells[places..places + 4], &cells[..places]]
                .concat()
                .join(",")
        });
        let found = text(export, PileFile::ContactsCsv);
        let found = found.lines().map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            assert_eq!(cells.len(), 6 + places);
            cells[2..].join(",")
        });
        if scene.state == State::Isostatic {
            assert!(found.eq(wanted), "{scene:?}");
            return;
        }
        // In the file, horizontal contacts come last.
        let [mut found, mut wanted] = [found.collect::<Vec<_>>(), wanted.collect()];
        let is_horizontal = |line: &str| Axis::ALL.iter().any(|axis| line.ends_with(axis.name()));
        assert!(found.iter().any(|line| is_horizontal(line)));
        found.sort_unstable();
        wanted.sort_unstable();
        assert_eq!(found, wanted);
    });
}

#[test]
fn loads_are_in_the_csv() {
    let at = |i, j, k| Site { i, j, k };
    let pile = Pile::triangular(3).expect("a pile");
    let pile = pile.with_load(at(0, 0, 0), ratio(5)).expect("a sphere");
    let pile = pile.with_load(at(1, 1, 2), ratio(7)).expect("a sphere");
    let packing = packing(&pile);
    let export = PileExport::new(&packing).expect("files");
    let spheres = columns(&text(&export, PileFile::SpheresCsv));
    assert_eq!(
        spheres["load"],
        [5.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 7.0, 0.0]
    );
    assert!(
        spheres["mass"]
            .iter()
            .all(|mass| mass.to_bits() == 1.0_f64.to_bits())
    );
}

#[test]
fn every_column_is_described() {
    for_each_pile(|scene, export| {
        let described = text(export, PileFile::ColumnsCsv);
        let mut described = described.lines();
        assert_eq!(described.next(), Some("file,column,unit,meaning"));
        let files = [
            PileFile::SpheresCsv,
            PileFile::ContactsCsv,
            PileFile::BaseCsv,
        ];
        for file in files {
            let csv = text(export, file);
            for column in csv.lines().next().expect("a head").split(',') {
                let begin = format!("{},{column},", file.name());
                let line = described.next().expect("a line");
                assert!(line.starts_with(&begin), "{line} of {scene:?}");
            }
        }
        assert_eq!(described.next(), None);
    });
}

/// Returns the arrays of a ParaView file: name, components, numbers. Bytes become numbers too.
fn arrays(file: &[u8]) -> Vec<(String, Vec<f64>)> {
    let text = std::str::from_utf8(file).expect("text");
    let document = roxmltree::Document::parse(text).expect("XML");
    let element = |name: &str| {
        document
            .descendants()
            .filter(move |it| it.has_tag_name(name))
            .collect::<Vec<_>>()
    };
    let appended = element("AppendedData")[0];
    assert_eq!(appended.attribute("encoding"), Some("base64"));
    let encoded = appended.text().expect("data").trim();
    let encoded = encoded.strip_prefix('_').expect("an underscore");
    let decoded = |text: &str| STANDARD.decode(text).expect("base64");
    let mut arrays = Vec::new();
    let mut end = 0;
    for array in element("DataArray") {
        let attribute = |name: &str| array.attribute(name).expect("an attribute");
        let offset: usize = attribute("offset").parse().expect("an offset");
        // The arrays are contiguous.
        assert_eq!(offset, end);
        let rest = &encoded[offset..];
        let size = u64::from_le_bytes(decoded(&rest[..12])[..8].try_into().expect("eight bytes"));
        let size = usize::try_from(size).expect("a size");
        let length = (8 + size).div_ceil(3) * 4;
        let data = &decoded(&rest[..length])[8..];
        let eight = |n: &[u8]| <[u8; 8]>::try_from(n).expect("eight bytes");
        let numbers = match attribute("type") {
            "Float64" => data
                .chunks(8)
                .map(|n| f64::from_le_bytes(eight(n)))
                .collect(),
            #[expect(clippy::cast_precision_loss, reason = "numbers of few spheres")]
            "Int64" => data
                .chunks(8)
                .map(|n| i64::from_le_bytes(eight(n)) as f64)
                .collect(),
            "UInt8" => data.iter().map(|n| f64::from(*n)).collect(),
            other => panic!("{other}"),
        };
        arrays.push((attribute("Name").to_owned(), numbers));
        end += length;
    }
    assert_eq!(end, encoded.len());
    arrays
}

fn array<'a>(arrays: &'a [(String, Vec<f64>)], name: &str) -> &'a [f64] {
    let found = arrays.iter().rev().find(|(found, _)| found == name);
    &found.expect("an array").1
}

/// Exports contain the same numbers on request only.
#[test]
fn exports_contain_the_stress_of_the_table() {
    for_each_pile(|scene, export| {
        let plain = text(export, PileFile::SpheresCsv);
        assert!(
            !plain.contains("stress") && !text(export, PileFile::ColumnsCsv).contains("stress")
        );
        let export = export.clone().with_stress();
        let table = table::spheres_with_stress(export.packing(), true, Selection::All);
        let (table, written) = (
            columns(&csv_of(table.expect("a table"))),
            columns(&text(&export, PileFile::SpheresCsv)),
        );
        let points = arrays(&bytes(&export, PileFile::SpheresVtp));
        let tensors = array(&points, "stress");
        let explained = text(&export, PileFile::ColumnsCsv);
        let mut found = 0;
        for (name, column) in table.iter().filter(|(name, _)| name.starts_with("stress")) {
            assert_eq!(written[name], *column, "{scene:?} {name}");
            assert!(explained.contains(name));
            let axes = name
                .bytes()
                .rev()
                .take(2)
                .map(|axis| usize::from(axis - b'x'));
            let place = axes.fold(0, |place, axis| 3 * place + axis);
            let of_points = tensors.iter().skip(place).step_by(9);
            assert!(of_points.eq(column), "{scene:?} {name}");
            found += 1;
        }
        assert_eq!(found, written.len() - columns(&plain).len());
    });
}

#[test]
fn paraview_files_have_the_numbers_of_the_csv() {
    for_each_pile(|scene, export| {
        let spheres = columns(&text(export, PileFile::SpheresCsv));
        let points = arrays(&bytes(export, PileFile::SpheresVtp));
        for (name, column) in [("id", "id"), ("layer", "k"), ("radius", "radius")] {
            assert_eq!(array(&points, name), spheres[column], "{name} of {scene:?}");
        }
        let centre = |id: f64| {
            let row = spheres["id"]
                .iter()
                .position(|other| other.to_bits() == id.to_bits())
                .expect("a sphere");
            ["x", "y", "z"].map(|axis| spheres[axis][row])
        };
        let centres: Vec<f64> = spheres["id"].iter().flat_map(|id| centre(*id)).collect();
        assert!(array(&points, "centres") == centres, "{scene:?}");
        // The floor exerts the opposite of the force on the floor, and only on bottom spheres.
        let base = columns(&text(export, PileFile::BaseCsv));
        let felt = |name: &str, row: usize| base.get(name).map_or(0.0, |shear| shear[row]);
        let pushed = (0..base["normal"].len()).flat_map(|row| {
            [
                -felt("shear_x", row),
                -felt("shear_y", row),
                felt("normal", row),
            ]
        });
        let above = centres.len() - 3 * base["normal"].len();
        let reactions: Vec<f64> = std::iter::repeat_n(0.0, above).chain(pushed).collect();
        assert!(array(&points, "reaction") == reactions, "{scene:?}");

        let contacts = columns(&text(export, PileFile::ContactsCsv));
        let lines = arrays(&bytes(export, PileFile::ContactsVtp));
        for name in ["force", "id1", "id2"] {
            assert_eq!(array(&lines, name), contacts[name], "{name} of {scene:?}");
        }
        let ids = contacts["id1"].iter().zip(&contacts["id2"]);
        let ends: Vec<f64> = ids
            .flat_map(|(a, b)| [centre(*a), centre(*b)])
            .flatten()
            .collect();
        assert!(array(&lines, "centres") == ends, "{scene:?}");
        // Both ends of each line have its force.
        let (name, at_ends) = &lines[0];
        assert_eq!(name, "force");
        assert!(
            at_ends
                .chunks(2)
                .map(|two| two[0])
                .eq(contacts["force"].iter().copied())
        );
        assert!(
            at_ends
                .chunks(2)
                .all(|two| two[0].to_bits() == two[1].to_bits())
        );
    });
}

/// Returns the atoms of `pile.data`: id, type, diameter, density, x, y, z.
fn atoms(export: &PileExport<'_>) -> Vec<Vec<f64>> {
    let data = text(export, PileFile::LammpsData);
    let (_, atoms) = data.split_once("Atoms # sphere\n\n").expect("atoms");
    let rows = atoms.lines().map(|line| {
        let row: Vec<f64> = line
            .split(' ')
            .map(|cell| cell.parse().expect("a number"))
            .collect();
        assert_eq!(row.len(), 7);
        row
    });
    rows.collect()
}

#[test]
fn lammps_and_yade_files_have_the_same_spheres() {
    for_each_pile(|scene, export| {
        let spheres = columns(&text(export, PileFile::SpheresCsv));
        let atoms = atoms(export);
        let column = |n: usize| atoms.iter().map(|row| row[n]).collect::<Vec<_>>();
        for (place, name) in [(0, "id"), (4, "x"), (5, "y"), (6, "z")] {
            assert_eq!(column(place), spheres[name], "{name} of {scene:?}");
        }
        for (atom, (radius, fixed)) in atoms
            .iter()
            .zip(spheres["radius"].iter().zip(&spheres["fixed"]))
        {
            assert_eq!((atom[1], atom[2]), (1.0 + fixed, 2.0 * radius));
            // Weightless spheres have their mass too, but the scripts omit gravity.
            let mass = std::f64::consts::PI / 6.0 * atom[2].powi(3) * atom[3];
            let wanted = export.packing().mass();
            let wanted: f64 = cannonpile::scalar::Surd::from(wanted.clone())
                .nearest()
                .expect("a float");
            assert!((mass / wanted - 1.0).abs() < 1e-15, "{mass} {wanted}");
        }
        let data = text(export, PileFile::LammpsData);
        for (axis, place) in [("x", 4), ("y", 5), ("z", 6)] {
            let line = data
                .lines()
                .find(|line| line.ends_with(&format!("{axis}hi")))
                .expect("a bound");
            let bounds: Vec<f64> = line
                .split(' ')
                .take(2)
                .map(|cell| cell.parse().expect("a number"))
                .collect();
            for atom in &atoms {
                assert!(bounds[0] < atom[place] - atom[2] && atom[place] + atom[2] < bounds[1]);
            }
        }
        let yade = text(export, PileFile::YadeSpheres);
        for (line, atom) in yade.lines().zip(&atoms) {
            let row: Vec<f64> = line
                .split(' ')
                .map(|cell| cell.parse().expect("a number"))
                .collect();
            assert_eq!(row, [atom[4], atom[5], atom[6], atom[2] / 2.0]);
        }
        assert_eq!(yade.lines().count(), atoms.len());
    });
}

#[test]
fn scripts_contain_loads_weight_and_plane() {
    let (mut loaded, mut weightless, mut flat) = (0, 0, 0);
    for_each_pile(|scene, export| {
        let input = text(export, PileFile::LammpsInput);
        let script = text(export, PileFile::YadeScript);
        let pile = export.packing().pile();
        let numbering = export.numbering();
        for (at, load) in &scene.loads {
            let site = at.site(pile.layers());
            let on_floor = site.k + 1 == pile.layers();
            let id = numbering.id(site).expect("a number");
            // Bottom spheres are frozen, so their loads are omitted.
            let name = format!("set             atom {id} d_load");
            assert_eq!(input.contains(&name), !on_floor);
            assert_eq!(script.contains(&format!("    {id}: (")), !on_floor);
            if on_floor || !load.is_vertical() {
                continue;
            }
            let load = &load.down * export.packing().sphere_weight();
            let load: f64 = cannonpile::scalar::Surd::from(load)
                .nearest()
                .expect("a float");
            assert!(input.contains(&format!("{name} -{load:?}\n")));
            assert!(script.contains(&format!("    {id}: (0.0, 0.0, -{load:?}),\n")));
            loaded += 1;
        }
        assert_eq!(input.contains("addforce"), !scene.loads.is_empty());
        assert_eq!(input.contains("gravity"), !scene.weightless);
        assert_eq!(
            input.contains("setforce"),
            pile.dimension() == Dimension::Two
        );
        assert_eq!(
            script.contains("'yXYZ'"),
            pile.dimension() == Dimension::Two
        );
        weightless += i32::from(scene.weightless);
        flat += i32::from(pile.dimension() == Dimension::Two);
        let first = numbering.first_on_floor();
        assert!(script.contains(&format!("FIRST_ON_FLOOR = {first} ")));
    });
    assert!(loaded > 3 && weightless > 0 && flat > 1);
}

/// The vectors of gravity and of a load follow from the angle of the contacts: here tan θ = √12/√13, as sin θ = 1.2/√3.
#[test]
fn scripts_lean_gravity_and_loads() {
    let ratio = |n: i64, d: i64| num_rational::BigRational::new(n.into(), d.into());
    let site = Site { i: 0, j: 0, k: 1 };
    let push = Load {
        down: ratio(1, 2),
        x: ratio(1, 4),
        y: ratio(0, 1),
    };
    let pile = Pile::triangular(3).expect("a pile");
    let pile = pile
        .with_tilt([ratio(1, 8), ratio(-1, 16)])
        .and_then(|pile| pile.with_load(site, push))
        .expect("a sphere");
    let packing = packing(&pile);
    let export = PileExport::new(&packing).expect("files");
    let tan = (0.48_f64 / 0.52).sqrt();
    let (x, y) = (tan / 8.0, -(3.0_f64.sqrt()) * tan / 16.0);
    let input = text(&export, PileFile::LammpsInput);
    let numbers = |line: &str| -> Vec<f64> {
        let words = line.split([' ', '(', ')', ',', '=', '{', '}', ':']);
        words.filter_map(|word| word.parse().ok()).collect()
    };
    let near = |found: &[f64], expected: &[f64]| {
        found.len() == expected.len()
            && found
                .iter()
                .zip(expected)
                .all(|(a, b)| (a - b).abs() < 1e-15)
    };
    let line = |text: &str, word: &str| {
        let found = text.lines().find(|line| line.contains(word));
        found.expect("a line").to_owned()
    };
    let magnitude = (x * x + y * y + 1.0).sqrt();
    let gravity = numbers(&line(&input, "gravity"));
    assert!(near(&gravity, &[magnitude, x, y, -1.0]), "{gravity:?}");
    let load = line(&input, "set  ");
    assert!(load.contains("d_load_x") && load.contains("d_load_z") && !load.contains("d_load_y"));
    assert!(near(&numbers(&load), &[2.0, tan / 4.0, -0.5]), "{load}");
    assert!(input.contains("addforce v_load_x 0.0 v_load_z\n"));
    let script = text(&export, PileFile::YadeScript);
    let gravity = numbers(&line(&script, "gravity"));
    assert!(near(&gravity[..3], &[x, y, -1.0]), "{gravity:?}");
    let load = numbers(&line(&script, "    2: ("));
    assert!(near(&load, &[2.0, tan / 4.0, 0.0, -0.5]), "{load:?}");
    let spheres = columns(&text(&export, PileFile::SpheresCsv));
    assert!(near(&spheres["load_x"][..3], &[0.0, tan / 4.0, 0.0]));
    assert_eq!(spheres["load_y"], [0.0; 10]);
    assert!(text(&export, PileFile::ColumnsCsv).contains("spheres.csv,load_x,N,"));
}

#[test]
fn individual_weights_become_masses_or_loads() {
    let weight = |n: i64, d: i64| num_rational::BigRational::new(n.into(), d.into());
    let at = |i, j, k| Site { i, j, k };
    let pile = Pile::triangular(4).expect("a pile");
    let pile = pile
        .with_weight(at(0, 0, 0), weight(3, 1))
        .expect("a sphere");
    let pile = pile
        .with_weight(at(1, 0, 1), weight(0, 1))
        .expect("a sphere");
    // Weight and load together equal the ordinary weight.
    let pile = pile
        .with_weight(at(0, 1, 1), weight(1, 2))
        .expect("a sphere");
    let pile = pile.with_load(at(0, 1, 1), weight(1, 2)).expect("a sphere");
    let packing = packing(&pile);
    let export = PileExport::new(&packing).expect("files");
    let density = |id: usize| atoms(&export)[id - 1][3];
    assert!((density(1) / density(2) - 3.0).abs() < 1e-15);
    assert!((density(3) / density(2) - 1.0).abs() < 1e-15);
    assert!((density(4) / density(2) - 0.5).abs() < 1e-15);
    let input = text(&export, PileFile::LammpsInput);
    let loads: Vec<&str> = input
        .lines()
        .filter(|line| line.starts_with("set "))
        .collect();
    // Gravity acts on the substitute mass, so an equal upward load compensates it.
    let [third, fourth] = [
        "set             atom 3 d_load 1.0",
        "set             atom 4 d_load -0.5",
    ];
    assert!(
        loads.len() == 2 && loads.contains(&third) && loads.contains(&fourth),
        "{loads:?}"
    );
    let script = text(&export, PileFile::YadeScript);
    for line in [
        "    3: (0.0, 0.0, 1.0),",
        "    4: (0.0, 0.0, -0.5),",
        "    1: 3.0,",
    ] {
        assert!(script.lines().any(|other| other == line), "{line}");
    }
    let points = arrays(&bytes(&export, PileFile::SpheresVtp));
    assert_eq!(array(&points, "weight")[..5], [3.0, 1.0, 0.0, 0.5, 1.0]);
    assert_eq!(array(&points, "load")[..5], [0.0, 0.0, 0.0, 0.5, 0.0]);
}
