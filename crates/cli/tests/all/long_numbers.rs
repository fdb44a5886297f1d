//! Every operation on numbers, with numbers of up to 5000 digits, in a thread with a stack of 512 kB.
//!
//! The numbers are ratios of Fibonacci numbers. Their continued fractions have the most terms, and two neighbours differ in
//! the last one only. An operation that calls itself once for each term exhausts the stack, which kills the test.

use core::hash::{Hash, Hasher};
use core::num::NonZeroI64;
use std::hint::black_box;
use std::process::Command;
use std::thread::{Builder, scope};
use std::time::Instant;
use std::{fs, hash};

use cannonpile::engine::{common_denominator, product, sum_of};
use cannonpile::geometry::{Inclination, Spacing, Vector, square_across};
use cannonpile::lattice::{Axis, Dimension, Direction, HorizontalContact, Region, Site};
use cannonpile::num_bigint::BigInt;
use cannonpile::num_rational::BigRational;
use cannonpile::scalar::{
    Algebra, ByValue, CorrectlyRounded, DoubleDouble, FixedRational, Interval, Plain, Polynomial,
    Ring, Surd, SurdSum, laws, parse, reduced,
};
use cannonpile::shape::Selection;
use cannonpile::{Error, Load, Packing, Pile, ratio};
use cannonpile_accuracy::{Stochastic, layer_errors};
use cannonpile_dem::Friction;
use cannonpile_dem::scene::{self, Scene};
use cannonpile_dem::table::{self, Cell, FileFormat, NumberFormat, Table, Units};
use cannonpile_disorder::{
    Choice, ContactSet, Ensemble, FirstSign, ForceKind, RandomPiles, RandomStackings, Samples,
    Shard, TallyRecord, Wave, check_fault_probability,
};
use cannonpile_figure::Subject;
use cannonpile_stability::{Affine, RoughFloor, RoughPacking, margin, sensitivity, tilts};

/// The greatest stack of an operation. Reading the options of a command takes more than this, with any numbers.
const STACK: usize = 512 * 1024;
const STACK_OF_COMMANDS: usize = 2 * STACK;

/// The digits of a number. Sums of several of the longest numbers take minutes in debug. There 1,000 digits suffice: a
/// comparison that calls itself for each term exhausts the stack with them many times over.
const LONGEST: u32 = 4990;
const LONG: u32 = if cfg!(debug_assertions) {
    1000
} else {
    LONGEST
};

/// F(n+1)/F(n) and F(n+2)/F(n+1) for the first Fibonacci number F(n) of this many digits.
fn neighbours(digits: u32) -> [BigRational; 2] {
    let limit = BigInt::from(10).pow(digits - 1);
    let (mut a, mut b) = (BigInt::from(1), BigInt::from(1));
    while b < limit {
        (a, b) = (b.clone(), a + b);
    }
    let sum = &a + &b;
    [BigRational::new(b.clone(), a), BigRational::new(sum, b)]
}

/// Compares a value with itself and with another one. Equal numbers are compared at once. Only neighbours make a comparison
/// that calls itself exhaust the stack.
fn differ<T: PartialEq>([one, other]: &[T; 2]) {
    assert!(one.eq(one) && one.ne(other));
}

fn hashed(value: &impl Hash) -> u64 {
    let mut hasher = hash::DefaultHasher::new();
    value.hash(&mut hasher);
    hasher.finish()
}

/// The kilobytes of the stack of this thread that were used. `None` where the system does not tell.
fn used() -> Option<u64> {
    let marker = 0_u8;
    let address = (&raw const marker).addr();
    let maps = fs::read_to_string("/proc/self/smaps").ok()?;
    let is_here = |line: &str| {
        let [from, to] = [0, 1].map(|n| line.split(' ').next()?.split('-').nth(n));
        let end = |text: Option<&str>| usize::from_str_radix(text?, 16).ok();
        end(from)
            .zip(end(to))
            .is_some_and(|(from, to)| (from..to).contains(&address))
    };
    let mut lines = maps.lines().skip_while(|line| !is_here(line));
    let resident = lines.find_map(|line| line.strip_prefix("Rss:"))?;
    resident.trim().strip_suffix(" kB")?.parse().ok()
}

/// Runs operations, one after the other, and prints the stack that each used.
macro_rules! run {
    ($($name:literal: $operation:expr;)*) => {
        // Each stack is larger than the last one, so no stack is used again.
        let mut size = STACK / 2;
        $(
        size += 4096;
        assert!(size <= STACK);
        let stack = scope(|threads| {
            let thread = Builder::new().stack_size(size).spawn_scoped(threads, || {
                let started = Instant::now();
                let _ = black_box($operation);
                (used(), started.elapsed())
            });
            thread.expect("a thread").join().expect($name)
        });
        let (stack, time) = (stack.0.map_or("?".into(), |kb| kb.to_string()), stack.1);
        println!("{stack:>4} kB {:7} ms  {}", time.as_millis(), $name);
        )*
    };
}

fn written(table: Result<Table<'_>, cannonpile_dem::Error>, numbers: NumberFormat) -> String {
    let mut text = Vec::new();
    table
        .unwrap()
        .write(FileFormat::Csv, numbers, &mut text)
        .unwrap();
    String::from_utf8(text).unwrap()
}

#[test]
fn numbers() {
    let [a, b] = neighbours(LONGEST);
    let [x, y] = [&a, &b].map(|number| Surd::from(number.clone()));
    let [root, other] = [&a, &b].map(|number| Surd::sqrt(number.clone()).unwrap());
    let sum = SurdSum::new(root.clone(), other.clone());
    let text = a.to_string();
    let (f64s, f32s) = (f64::nearest_to_rational, f32::nearest_to_rational);
    let raw = BigRational::new_raw(-a.numer() * 6, a.denom() * -6);
    run! {
        "parse::rational": parse::rational(&text).unwrap();
        "parse::rational, parse::tilt of a scene": (scene::parse::rational(&text).unwrap(), scene::parse::tilt(&text, Dimension::Two).unwrap());
        "rational: order and equality": assert!(ByValue(&a) != ByValue(&b) && ByValue(&a).max(ByValue(&b)) == ByValue(&b).max(ByValue(&a)));
        "rational: hash": assert_eq!(hashed(&ByValue(&a)), hashed(&ByValue(&raw)));
        "rational: reduced": assert!(ByValue(&reduced(raw.clone())) == ByValue(&a));
        "rational: nearest f64 and f32": (f64s(&a), f32s(&a), f64s(&raw));
        "DoubleDouble::from_rational": DoubleDouble::from_rational(&a);
        "rational: sums, products": (sum_of([a.clone(), b.clone()]), product(&a, &b), common_denominator([&a, &b]));
        "rational: as a scalar": (a.clone().div_int(NonZeroI64::MIN), a.is_defined(), a.checked_div(&b), a.clone() - <BigRational as Ring>::from_integer(7), <BigRational as Algebra>::half_turn(&[a.clone(), b.clone(), a.clone()]));
        "from_rational": (BigRational::from_rational(&a), f64::from_rational(&a), f32::from_rational(&a), Polynomial::from_rational(&a), Plain::<f64>::from_rational(&a), Stochastic::<24>::from_rational(&a));
        "rational: laws": (laws::embedding(&a, &b, |x: &BigRational| Some([x.clone(), x.clone()])).unwrap(), laws::numerators::<BigRational>(&a, &b).unwrap());
        "to_rational, to_constant": (Polynomial::constant(&a).to_constant().unwrap(), DoubleDouble::from_rational(&a).to_rational(), FixedRational::<i128>::from_rational(&a).to_rational(), x.to_rational());
        "Surd: from, order and equality": assert!(x != y && (x < y) == (y > x) && x == Surd::from(raw.clone()));
        "Surd: hash": assert_eq!(hashed(&x), hashed(&Surd::from(raw.clone())));
        "Surd: order of roots": assert!(root != other && (root < other) == (x < y));
        "Surd: hash of a root": hashed(&root);
        "Surd: product, reciprocal, square": (root.clone() * &other, root.checked_recip(), root.square());
        "Surd: sum, scaled, sign": (x.checked_add(&y), root.checked_add(&other), root.scaled(&b), root.sign());
        "Surd: nearest f64 and f32, order with f64": (root.nearest::<f64>(), root.nearest::<f32>(), x.nearest::<f64>(), root < 1.0);
        "Surd: parts, negation": (root.coefficient(), root.radicand(), root.to_f64(), -root.clone() == Surd::zero());
        "Surd::new": Surd::new(a.clone(), b.clone()).unwrap();
        "Surd: text": assert_eq!(x.to_string().parse::<Surd>().unwrap(), x);
        "SurdSum: sum, sign, order with f64": (SurdSum::new(root.clone(), -other.clone()).sign(), sum < 1.0);
        "SurdSum: to_surd, terms, from": (sum.to_surd(), sum.terms(), SurdSum::from(x.clone()));
        "Cell: from": (Cell::from(a.clone()), Cell::from(x.clone()), Cell::from(sum.clone()));
        "SurdSum: nearest, equality, hash, text": (sum.nearest::<f64>(), sum == sum.clone(), hashed(&sum), sum.to_string());
        "Interval: from, contains": assert!(Interval::from_rational(&a).contains(&a));
        "Polynomial: from, equality, text": assert!(Polynomial::constant(&a) != Polynomial::constant(&b) && !Polynomial::constant(&a).to_string().is_empty());
    }
}

#[test]
fn piles() -> Result<(), Error> {
    let [a, b] = neighbours(LONG);
    let loads = |first: &BigRational, second: &BigRational| -> Result<Pile, Error> {
        let pile =
            Pile::under(Region::SITE, "+-".parse()?)?.with_load(Site::APEX, first.clone())?;
        let load = Load {
            down: second.clone(),
            x: first.clone(),
            y: first.clone(),
        };
        pile.with_load(Site::new(0, 0, 1), load)
    };
    let (pile, other) = (loads(&a, &b)?, loads(&b, &a)?);
    // The corners of a polygon are quotients of long products.
    let [c, d] = neighbours(LONG / 2);
    let short = loads(&c, &d)?;
    let tilt = [a.clone() / ratio!(100), b.clone() / ratio!(1000)];
    let spacing = Spacing::from_square(b.recip() * ratio!(2))?;
    let packing = Packing::new(&pile, &spacing)?
        .with_mass(a.clone())?
        .with_radius(b.clone())?
        .with_gravity(a.clone())?;
    let (in_pile, in_si) = (Units::of_pile(&pile), Units::of_packing(packing.clone()));
    let forces = pile.forces::<BigRational>();
    let floor = Site::new(0, 0, 2);
    let contact = HorizontalContact {
        site: floor,
        axis: Axis::AlphaBeta,
    };
    let one = || forces.contact(Site::APEX, Direction::Alpha).unwrap();
    let base = |pile: &Pile| {
        let forces = pile.forces::<BigRational>().base(Selection::Base);
        forces.unwrap().collect::<Result<Vec<_>, _>>().unwrap()
    };
    let contacts = |pile: &Pile| {
        let forces = pile.forces::<BigRational>().contacts(Selection::All);
        forces.unwrap().collect::<Result<Vec<_>, _>>().unwrap()
    };
    let both = [&pile, &other];
    run! {
        "Pile: loads, weights, tilt": loads(&a, &b).unwrap().with_weight(floor, a.clone()).unwrap().with_tilt(tilt.clone()).unwrap();
        "Pile: equality": assert!(pile == loads(&a, &b).unwrap() && pile != other);
        "Pile: hash": assert_eq!(hashed(&pile), hashed(&loads(&a, &b).unwrap()));
        "Pile: text, weights, tilt": (pile.to_string(), pile.weight(), pile.weights().count(), pile.sphere_weight(floor).unwrap(), pile.tilt());
        "Pile: sin_phi, horizontal forces": (pile.sin_phi(), pile.horizontal_force(contact), pile.horizontal_forces().count());
        "Pile::isosceles": assert!(Pile::isosceles(3, b.recip()).unwrap() != Pile::isosceles(3, a.recip()).unwrap());
        "Load: equality, hash, text": { differ(&both.map(|pile| pile.load(Site::APEX).unwrap())); assert!(hashed(&pile.load(Site::APEX).unwrap()) == hashed(&pile.load(Site::APEX).unwrap()) && pile.load(floor).unwrap().to_string() == "0") };
        "Vector: equality": differ(&[&a, &b].map(|x| Vector { x: x.clone(), y: a.clone(), z: a.clone() }));
        "Spacing, Inclination: equality, hash, text": { differ(&[&a, &b].map(|x| Spacing::from_square(x.recip() * ratio!(2)).unwrap())); assert!(hashed(&spacing) == hashed(&spacing.clone()) && !spacing.to_string().is_empty() && Inclination::new(&spacing, pile.dimension()).unwrap() == packing.inclination().clone()) };
        "Inclination: sin, cos, tan": { let angle = packing.inclination(); ([angle.sin(), angle.cos(), angle.tan()], [angle.cos2(), angle.tan2()], angle.sin2()) };
        "Clearance: check": pile.clearance().check(&spacing);
        "Spacing: ratio, square": (spacing.ratio(), spacing.square());
        "Forces: one contact": one();
        "Forces: contacts, equality": differ(&both.map(contacts));
        "Forces: base, equality": differ(&both.map(base));
        "Forces: sums": (forces.sum_of_contacts(Selection::All).unwrap(), forces.sum_on_floor(Selection::Base).unwrap());
        "Forces<Interval>": pile.forces::<Interval>().contact(Site::APEX, Direction::Alpha);
        "layer_errors": layer_errors(&pile.forces::<BigRational>(), |x| Some(x.clone())).unwrap();
        "Forces<DoubleDouble>": pile.forces::<DoubleDouble>().contact(Site::APEX, Direction::Alpha);
        "Forces<f64>": pile.forces::<f64>().contact(Site::APEX, Direction::Alpha);
        "Forces<Polynomial>": pile.forces::<Polynomial>().contact(Site::APEX, Direction::Alpha);
        "Packing: contact, vectors, base": (packing.contact(Site::APEX, Direction::Alpha).unwrap(), packing.clone().mass_of(floor).unwrap(), packing.on_floor(floor).unwrap());
        "Packing: units": ([packing.radius(), packing.mass(), packing.gravity()], packing.sphere_weight(), [packing.unit_force(), packing.central_constant()]);
        "Packing: positions, vectors": (packing.position(floor).unwrap(), packing.contact_point(Site::APEX, Direction::Alpha).unwrap(), packing.contact_vector(Site::APEX, Direction::Alpha).unwrap(), packing.positions(Selection::All).unwrap().count());
        "Packing: contacts, contact_forces": (packing.contacts(Selection::All).unwrap().count(), packing.contact_forces(Selection::All).unwrap().count());
        "Packing: to SI": (packing.contact_in_si(contacts(&pile)[0].clone()).unwrap(), packing.floor_force_in_si(base(&pile)[0].clone()), packing.stress_in_si(&forces.stress(Site::APEX).unwrap()), packing.horizontal_contact_in_si(contact, &a).is_ok());
        "Layer: error_bound": { let mut layers = pile.forces::<f64>().layers(Selection::Base).unwrap(); layers.next_layer().unwrap().map(|layer| layer.error_bound()) };
        "Layers: numerators": forces.layers(Selection::All).unwrap().numerators::<BigInt>().unwrap();
        "Pile: standing, tensile_contact": (pile.standing().unwrap(), pile.tensile_contact().unwrap());
        "Pile: base_extremes": differ(&both.map(|pile| pile.base_extremes().unwrap()));
        "square_across, Affine": (square_across(&a), Affine::through([a.clone(), b.clone(), a.clone()]).at(&tilt));
        "Pile: margin": differ(&both.map(|pile| margin(pile).unwrap()));
        "Pile: stability, of half the digits": assert!(tilts(&short).unwrap() == tilts(&short).unwrap());
        "Packing: sensitivity, equality": differ(&both.map(|pile| sensitivity::<BigRational>(&Packing::new(pile, &spacing).unwrap(), Site::APEX).unwrap()));
        "derivatives": cannonpile_dem::derivatives(&packing).unwrap().last();
        "tables, exact": [table::base(&in_pile, Selection::Base), table::contacts(&in_pile, Selection::All), table::base(&in_si, Selection::Base), table::contacts(&in_si, Selection::All), table::spheres(&packing, Selection::All)].map(|table| written(table, NumberFormat::Exact));
        "tables, intervals": [table::base(&in_pile, Selection::Base), table::contacts(&in_pile, Selection::All)].map(|table| written(table, NumberFormat::Interval));
        "summary": written(Ok(table::Summary::new(&in_pile, None).unwrap().table()), NumberFormat::Exact);
        "figures": [cannonpile_figure::base, cannonpile_figure::section, cannonpile_figure::shear, cannonpile_figure::pile, cannonpile_figure::stability].map(|draw| draw(&Subject::of_pile(&pile, &Spacing::new(ratio!(6 / 5)).unwrap()).unwrap()).is_ok());
        "Scene: toml, equality": { let scene = Scene { mass: a.clone(), gravity: b.clone(), ..Scene::default() }; differ(&[scene.clone(), Scene { mass: b.clone(), ..scene.clone() }]); assert_eq!(Scene::from_toml(&scene.to_toml()).unwrap(), scene) };
        "RandomPiles: mean, equality": { let piles = RandomPiles::under(Region::SITE, RandomStackings::new(3, FirstSign::Plus).unwrap()).with_load(Site::APEX, a.clone()).unwrap(); differ(&[piles.clone(), piles.clone().with_load(Site::APEX, b.clone()).unwrap()]); differ(&[&a, &b].map(|q| piles.exact(&q.recip()).unwrap())); piles.by_faults().unwrap().at(&a.recip()).unwrap(); piles.mean(&0.5).unwrap() };
    }
    Ok(())
}

#[test]
fn friction() -> Result<(), cannonpile_stability::Error> {
    let [a, b] = neighbours(LONG);
    let pile = Pile::triangular(2)?.with_load(Site::APEX, a.clone())?;
    let packing = Packing::new(&pile, &Spacing::from_square(b.recip() * ratio!(2))?)?;
    let (in_pile, in_si) = (RoughFloor::new(&pile)?, RoughPacking::new(&packing)?);
    let contacts = |load: &BigRational| {
        let pile = Pile::triangular(2).unwrap();
        let pile = pile.with_load(Site::APEX, load.clone()).unwrap();
        let spacing = Spacing::from_square(b.recip() * ratio!(2)).unwrap();
        let packing = Packing::new(&pile, &spacing).unwrap();
        let contacts = RoughPacking::new(&packing)
            .unwrap()
            .contacts(Selection::All);
        contacts.unwrap().collect::<Result<Vec<_>, _>>().unwrap()
    };
    run! {
        "RoughFloor: contacts, base": (in_pile.contacts::<BigRational>(Selection::All).unwrap().count(), in_pile.base::<BigRational>(Selection::Base).unwrap().count());
        "RoughFloor: floor_friction": in_pile.floor_friction().unwrap();
        "RoughPacking: contact_friction, floor_friction": (in_si.contact_friction(), in_si.floor_friction().unwrap());
        "RoughPacking: holds": (in_si.contacts_hold_at(&a).unwrap(), in_si.floor_holds_at(&b.recip()).unwrap());
        "RoughPacking: contacts, equality": differ(&[&a, &b].map(contacts));
        "Friction: with_spheres, with_floor": Friction::sufficient(&packing).unwrap().with_spheres(&a).unwrap().with_floor(&b).unwrap();
        "NumberFormat: show": NumberFormat::Exact.show(&Surd::from(a.clone()), "a number").unwrap();
    }
    Ok(())
}

#[test]
fn random_stackings() -> Result<(), cannonpile_disorder::Error> {
    let [a, b] = neighbours(LONG);
    let q = a.recip();
    let stackings = RandomStackings::new(3, FirstSign::Plus)?;
    let ensemble = Ensemble::under(Region::SITE, stackings)?.with_bin_width(b.clone())?;
    let tally = ensemble.run(&Choice::All, Shard::WHOLE)?;
    let record = TallyRecord::new(tally.clone(), q.clone())?;
    run! {
        "Ensemble: bin_width": ensemble.bin_width();
        "Ensemble: equality": differ(&[ensemble.clone(), ensemble.clone().with_bin_width(a.clone()).unwrap()]);
        "Ensemble: run": ensemble.run(&Choice::All, Shard::WHOLE).unwrap();
        "Tally: standing_probability, weights": (tally.standing_probability(ContactSet::Sloping, &q).unwrap(), tally.weights(&q).unwrap());
        "TallyRecord: fault_probability, equality": { assert!(ByValue(record.fault_probability()) == ByValue(&q)); differ(&[record.clone(), TallyRecord::new(tally.clone(), b.recip()).unwrap()]) };
        "Samples: fault_probability, equality": { let samples = || Samples::new(3, 1, ratio!(1 / 3)).unwrap(); assert!(samples() == samples() && samples().fault_probability() == &ratio!(1 / 3)) };
        "check_fault_probability": check_fault_probability(&q).unwrap();
        "moments, equality": differ(&[&a, &b].map(|q| stackings.moments(&q.recip()).unwrap()));
        "Wave": { Wave::at(&q).unwrap().map(|wave| wave.squared_width(3)); differ(&[&a, &b].map(|q| Wave::at(&q.recip()).unwrap())) };
        "figures of means": (cannonpile_figure::mean_profile(3, core::slice::from_ref(&q)).is_ok(), cannonpile_figure::mean_response(3, core::slice::from_ref(&q)).is_ok(), cannonpile_figure::distribution(&tally, ForceKind::Contact, &q).is_ok());
    }
    Ok(())
}

#[test]
fn horizontal_contacts() -> Result<(), Box<dyn core::error::Error + Send + Sync>> {
    use cannonpile_horizontal::certificate::{Certificate, read_certificate, write_certificate};

    let [a, b] = neighbours(LONG / 2);
    let loads = |first: &BigRational, second: &BigRational| {
        let pile = Pile::triangular(3)?.with_load(Site::APEX, first.clone())?;
        pile.with_load(Site::new(1, 0, 1), second.clone())
    };
    let (pile, other) = (loads(&a, &b)?, loads(&b, &a)?);
    let corner = Site::new(0, 0, 2);
    let stiffness = a.clone();
    let certificate = cannonpile_horizontal::equilibrium(&pile)?;
    let forces = Certificate::of_forces(&pile)?;
    let contact = HorizontalContact {
        site: Site::new(0, 0, 1),
        axis: Axis::AlphaBeta,
    };
    run! {
        "horizontal: equilibrium, equality": differ(&[certificate.clone(), cannonpile_horizontal::equilibrium(&other).unwrap()]);
        "horizontal: check": certificate.check().unwrap();
        "horizontal: bounds": cannonpile_horizontal::bounds(&pile, corner).unwrap();
        "horizontal: elastic": cannonpile_horizontal::elastic(&pile, &stiffness).unwrap();
        "horizontal: margin": cannonpile_horizontal::margin(&pile).unwrap();
        "certificate of forces: equality, check": { differ(&[forces.clone(), Certificate::of_forces(&other).unwrap()]); forces.check().unwrap() };
        "certificate of forces: rounded": forces.clone().rounded().unwrap().check().unwrap();
        "certificate: file": { let mut text = Vec::new(); write_certificate(&forces, &mut text).unwrap(); assert!(read_certificate(text.as_slice()).unwrap() == forces) };
        "Pile: horizontal force": pile.clone().with_horizontal_force(contact, a.clone()).is_ok();
    }
    Ok(())
}

/// The commands, in a process whose main thread has this stack, and whose other threads have it too.
#[cfg(unix)]
#[test]
fn commands() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, digits) in [("long.toml", LONG), ("short.toml", 800)] {
        let [a, b] = neighbours(digits);
        let scene = format!("layers = 3\nload = [\"0,0,0={a}\", \"1,0,1={b}\"]\n");
        fs::write(folder.path().join(name), scene).expect("a scene");
    }
    for command in [
        "summary --scene long.toml",
        "base --scene long.toml",
        "contacts --number interval --scene long.toml",
        "spheres --stress --scene long.toml",
        "stability --scene long.toml",
        "sensitivity --at 0,0,0 --scene long.toml",
        "response --at 0,0,0 --scene long.toml",
        "explain --scene long.toml",
        "scene --scene long.toml",
        "plot base --scene long.toml",
        "plot network --scene long.toml",
        "export lammps --to lammps --scene long.toml",
        "export yade --to yade --scene long.toml",
        "export card --to card --scene long.toml",
        "export csv --to csv,vtp --scene long.toml",
        "stability --spacing 1 --scene short.toml",
        "bounds --scene short.toml",
        "plot bounds --scene short.toml",
    ] {
        let mut shell = Command::new("/bin/sh");
        let script = format!(
            "ulimit -s {}; exec \"$0\" {command}",
            STACK_OF_COMMANDS / 1024
        );
        shell.args(["-c", &script, env!("CARGO_BIN_EXE_cannonpile")]);
        let output = shell
            .current_dir(folder.path())
            .env("RUST_MIN_STACK", STACK.to_string())
            .output();
        let output = output.expect("a shell");
        let message = String::from_utf8_lossy(&output.stderr);
        assert!(
            matches!(output.status.code(), Some(0..=2)),
            "{command}: {:?} {message}",
            output.status
        );
        assert!(message.lines().count() <= 1, "{command}: {message}");
    }
}
