//! The exported linear systems have the exported solutions, exactly, and singular values that agree with the entries.

use std::collections::BTreeSet;

use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Region, Site};
use cannonpile::scalar::Surd;
use cannonpile::shape::Selection;
use cannonpile::{Load, Packing, Pile, ratio};
use cannonpile_dem::scene::{Scene, State};
use cannonpile_dem::{Error, PileExport, PileFile};
use cannonpile_testkit::scenes::{for_each_pile, packing, text};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Pow, Zero};
use serde_json::Value;

/// The files of a system, as read back.
#[derive(Clone)]
struct System {
    size: usize,
    field: String,
    /// Row, column and entry, counted from 0.
    entries: Vec<(usize, usize, BigRational)>,
    denominator: BigRational,
    loads: Vec<BigRational>,
    floats: Vec<f64>,
    exact: Vec<String>,
    properties: Value,
}

fn number(text: &str) -> BigRational {
    text.parse::<Surd>()
        .expect("a number")
        .coefficient()
        .clone()
}

/// Returns the header, the comment, the sizes and the numbers of a file in the format of Matrix Market.
fn market(text: &str) -> (&str, &str, Vec<usize>, Vec<&str>) {
    let mut lines = text.lines();
    let header = lines.next().expect("a header");
    let header = header
        .strip_prefix("%%MatrixMarket matrix ")
        .expect("a header");
    let comment = lines
        .next()
        .and_then(|line| line.strip_prefix("% "))
        .expect("a comment");
    let sizes = lines.next().expect("sizes").split(' ');
    let sizes = sizes.map(|size| size.parse().expect("a size")).collect();
    (header, comment, sizes, lines.collect())
}

impl System {
    fn of(export: &PileExport<'_>) -> Self {
        let matrix = text(export, PileFile::EquilibriumMtx);
        let (header, _, sizes, lines) = market(&matrix);
        let field = header
            .strip_prefix("coordinate ")
            .and_then(|rest| rest.strip_suffix(" general"));
        let [size, columns, count] = sizes[..] else {
            panic!("{sizes:?}")
        };
        assert_eq!((size, count), (columns, lines.len()));
        assert_eq!(export.rows(PileFile::EquilibriumMtx), Some(count as u64));
        let entry = |line: &str| {
            let cells: Vec<&str> = line.split(' ').collect();
            let index = |n: usize| cells[n].parse::<usize>().expect("an index") - 1;
            (index(0), index(1), number(cells[2]))
        };
        let array = |file, header: &str| {
            let text = text(export, file);
            let (found, comment, sizes, lines) = market(&text);
            assert_eq!((found, &sizes[..]), (header, &[size, 1][..]));
            let lines: Vec<String> = lines.iter().map(ToString::to_string).collect();
            (comment.to_owned(), lines)
        };
        let field = field.expect("a field").to_owned();
        let (comment, loads) = array(PileFile::LoadsMtx, &format!("array {field} general"));
        let (_, floats) = array(PileFile::ForcesMtx, "array real general");
        let denominator = comment.split([' ', ';']).nth(2).expect("a denominator");
        let properties: Value =
            serde_json::from_str(&text(export, PileFile::PropertiesJson)).expect("JSON");
        assert_eq!(properties["unknowns"], size);
        assert_eq!(properties["entries"], count);
        assert_eq!(properties["denominator"], denominator);
        Self {
            size,
            field,
            entries: lines.into_iter().map(entry).collect(),
            denominator: number(denominator),
            loads: loads.iter().map(|load| number(load)).collect(),
            floats: floats
                .iter()
                .map(|force| force.parse().expect("a float"))
                .collect(),
            exact: text(export, PileFile::ForcesExact)
                .lines()
                .map(str::to_owned)
                .collect(),
            properties,
        }
    }

    /// Returns A x − b/D.
    fn residual(&self, solution: &[BigRational]) -> Vec<BigRational> {
        let loads = self.loads.iter().map(|load| -(load / &self.denominator));
        let mut residual: Vec<_> = loads.collect();
        for (row, column, entry) in &self.entries {
            residual[*row] += entry * &solution[*column];
        }
        residual
    }

    /// Checks that the exact forces are the solution.
    fn is_solved(&self) -> Result<(), String> {
        let exact: Vec<_> = self.exact.iter().map(|force| number(force)).collect();
        if (self.loads.len(), exact.len(), self.floats.len()) != (self.size, self.size, self.size) {
            return Err("a number of rows".into());
        }
        match self
            .residual(&exact)
            .iter()
            .position(|part| !part.is_zero())
        {
            Some(row) => Err(format!("equation {}", row + 1)),
            None => Ok(()),
        }
    }

    /// Checks the matrix: triangular with `scale` on the diagonal, so that its solution is the only one.
    fn is_triangular(&self, scale: &BigRational) {
        let places: BTreeSet<_> = self
            .entries
            .iter()
            .map(|(row, column, _)| (*row, *column))
            .collect();
        assert_eq!(places.len(), self.entries.len());
        let diagonal = self.entries.iter().filter(|(row, column, _)| row == column);
        assert_eq!(diagonal.clone().count(), self.size);
        assert!(diagonal.into_iter().all(|(.., entry)| entry == scale));
        assert!(
            self.entries
                .iter()
                .all(|(row, column, entry)| row >= column && !entry.is_zero())
        );
    }

    /// Checks the listed singular values by their number, their product and the sum of their squares.
    fn has_singular_values(&self, scale: f64) {
        let list = self.properties["singular_values"]["list"]
            .as_array()
            .expect("a list");
        let [mut count, mut product, mut squares, mut largest] = [0.0; 4];
        let mut smallest = f64::INFINITY;
        for value in list {
            let [float, times] =
                ["float", "multiplicity"].map(|key| value[key].as_f64().expect("a float"));
            count += times;
            largest = float.max(largest);
            smallest = float.min(smallest);
            product += times * (float / scale).ln();
            squares += times * float * float;
        }
        assert!((count - self.properties["unknowns"].as_f64().expect("a size")).abs() < 0.5);
        assert!(product.abs() < 1e-11 * count, "{product}");
        let of_entries = |(.., entry): &(usize, usize, BigRational)| {
            Surd::from(entry * entry).nearest::<f64>().expect("a float")
        };
        let norm: f64 = self.entries.iter().map(of_entries).sum();
        assert!((squares / norm - 1.0).abs() < 1e-12, "{squares} {norm}");
        let condition = self.properties["condition_number"]["float"]
            .as_f64()
            .expect("a number");
        let quotient = largest / smallest;
        assert!((quotient / condition - 1.0).abs() < 1e-14);
    }
}

fn has_equations(scene: &Scene, export: &PileExport<'_>) -> bool {
    scene.state == State::Isostatic && export.packing().pile().layers() > 1
}

fn is_integer_system(system: &System, pile: &Pile) {
    let scale = if pile.is_regular() && pile.dimension().number() == 3 {
        3
    } else {
        1
    };
    assert_eq!(
        (&*system.field, &system.properties["scale"]),
        ("integer", &scale.into())
    );
    system.is_triangular(&BigRational::from_integer(scale.into()));
    assert_eq!(system.is_solved(), Ok(()));
    system.has_singular_values(f64::from(scale));
    assert!(system.entries.iter().all(|(.., entry)| entry.is_integer()));
    assert!(system.loads.iter().all(BigRational::is_integer));
    for (float, exact) in system.floats.iter().zip(&system.exact) {
        assert_eq!(Some(*float), Surd::from(number(exact)).nearest());
    }
}

#[test]
fn the_exact_forces_solve_the_integer_system() {
    for_each_pile(|scene, export| {
        if has_equations(scene, export) {
            is_integer_system(&System::of(export), export.packing().pile());
        }
    });
    for steps in 1..=6_u32 {
        for bits in 0..1_u32 << steps {
            let signs: String = (0..steps)
                .map(|n| if bits >> n & 1 == 0 { '+' } else { '-' })
                .collect();
            let pile = Pile::under(Region::SITE, signs.parse().expect("signs")).expect("a pile");
            let pile = pile
                .with_load(Site { i: 0, j: 0, k: 0 }, ratio!(1 / 7))
                .expect("a load");
            let packing = packing(&pile);
            is_integer_system(
                &System::of(&PileExport::new(&packing).expect("files")),
                &pile,
            );
        }
    }
}

#[test]
fn numbers_beyond_64_bits_are_whole() {
    let denominator = BigRational::from_integer(BigInt::from(10).pow(30_u32) + 57);
    let load = Load {
        down: denominator.recip(),
        x: ratio!(1 / 7),
        y: denominator.recip(),
    };
    let top = Region::hexagon(2, 1).expect("a region");
    let pile = Pile::under(top, "+-+-".parse().expect("signs")).expect("a pile");
    let pile = pile
        .with_load(Site { i: 0, j: 0, k: 0 }, load)
        .expect("a load");
    let pile = pile
        .with_weight(Site { i: 1, j: 0, k: 1 }, ratio!(5 / 11))
        .expect("a weight");
    let packing = packing(&pile);
    let system = System::of(&PileExport::new(&packing).expect("files"));
    is_integer_system(&system, &pile);
    assert!(system.exact.iter().any(|force| force.len() > 40));
    assert!(
        system
            .loads
            .iter()
            .any(|load| load.to_integer().bits() > 100)
    );
}

#[test]
fn the_system_in_newtons_has_the_forces_of_the_tables() {
    for_each_pile(|scene, export| {
        if !has_equations(scene, export) {
            return;
        }
        let export = export.clone().with_equations_in_si();
        let system = System::of(&export);
        assert_eq!(
            (&*system.field, &system.denominator),
            ("real", &BigRational::one())
        );
        let float =
            |exact: &BigRational| Surd::from(exact.clone()).nearest::<f64>().expect("a float");
        let rounded: Vec<_> = system
            .floats
            .iter()
            .map(|force| number(&format!("{force:?}")))
            .collect();
        let largest = system
            .loads
            .iter()
            .chain(&rounded)
            .map(|part| float(part).abs())
            .fold(0.0, f64::max);
        for part in system.residual(&rounded) {
            assert!(float(&part).abs() < 1e-14 * largest, "{scene:?}");
        }
        let exact = export
            .packing()
            .forces()
            .contacts(Selection::All)
            .expect("contacts");
        let exact = exact.map(|contact| {
            export
                .packing()
                .unit_force()
                .scaled(&contact.expect("a force").force)
        });
        for ((text, float), exact) in system.exact.iter().zip(&system.floats).zip(exact) {
            assert_eq!(text, &exact.to_string());
            assert_eq!(Some(*float), exact.nearest());
        }
        assert!(system.properties["condition_number"].is_null());
        assert!(system.properties["singular_values"]["formula"].is_null());
    });
}

#[test]
fn orthogonal_directions_keep_the_singular_values_in_newtons() {
    let spacing: Spacing = "sqrt(2)".parse().expect("a spacing");
    let piles = [
        Pile::discs(5).expect("a pile"),
        Pile::under(Region::SITE, "+-++".parse().expect("signs")).expect("a pile"),
    ];
    for pile in piles {
        let packing = Packing::new(&pile, &spacing).expect("a packing");
        let system = System::of(
            &PileExport::new(&packing)
                .expect("files")
                .with_equations_in_si(),
        );
        system.has_singular_values(1.0);
        assert!(system.properties["determinant"].is_null());
    }
}

#[test]
fn a_wrong_number_in_a_file_is_noticed() {
    let pile = Pile::under(Region::SITE, "+-+".parse().expect("signs")).expect("a pile");
    let packing = packing(&pile);
    let system = System::of(&PileExport::new(&packing).expect("files"));
    assert_eq!(system.is_solved(), Ok(()));
    let mut wrong = system.clone();
    wrong.entries[5].2 += BigRational::one();
    assert!(wrong.is_solved().is_err());
    let mut wrong = system.clone();
    wrong.loads[7] += BigRational::one();
    assert_eq!(wrong.is_solved(), Err("equation 8".into()));
    let mut wrong = system;
    wrong.exact.swap(3, 4);
    assert!(wrong.is_solved().is_err());
}

#[test]
fn piles_without_equations_are_refused_before_a_file_is_written() {
    let mut refused = 0;
    for_each_pile(|scene, export| {
        if has_equations(scene, export) {
            return;
        }
        let folder = tempfile::tempdir().expect("a folder");
        let written = export.write(
            &[cannonpile_dem::PileFormat::Mtx],
            folder.path(),
            &mut |_| {},
        );
        let Err(cannonpile_dem::table::WriteError::Answer(error)) = written else {
            panic!("{written:?}");
        };
        assert!(matches!(error, Error::NoEquations { .. }), "{error:?}");
        assert_eq!(folder.path().read_dir().expect("a folder").count(), 0);
        refused += 1;
    });
    assert_eq!(refused, 3);
}
