//! Measured forces are read as they were written. Exact forces are accepted, and an injected fault is found.
//!
//! The oracle consists of the written list, the injected fault, and rationals that compute the error again.

use std::fmt::Write;

use arbitrary::Unstructured;
use cannonpile::geometry::Spacing;
use cannonpile::scalar::Surd;
use cannonpile::shape::Selection;
use cannonpile::{Packing, Pile};
use cannonpile_dem::verify;
use cannonpile_dem::verify::{
    Axes, Comparison, Coordinate, Frame, Measured, Preset, Reader, Refusal, TableAxis,
};
use num_traits::{Signed, ToPrimitive};

use super::{Checked, Failure, demand, one_line, same};
use crate::codes;
use crate::generators::number::{self, ratio};
use crate::generators::{pile, rarely, region, text};

impl From<Refusal> for Failure {
    fn from(refusal: Refusal) -> Self {
        Self::Refuted(format!("refused: {refusal}"))
    }
}

/// Any bytes are read or rejected in one line. The result of a successful read can be written and read again.
pub fn any_file(u: &mut Unstructured<'_>) -> Checked {
    let file = match u.int_in_range(0..=3)? {
        0 => u.arbitrary::<Vec<u8>>()?,
        1 => text::any(u)?.into_bytes(),
        _ => {
            let entries = entries(u)?;
            let whole = written(u, &entries)?;
            let mut file = text::damaged(u, &whole)?.into_bytes();
            if u.arbitrary()? {
                let cut = u.int_in_range(0..=file.len())?;
                file.truncate(cut);
            }
            file
        }
    };
    match verify::read(&*file) {
        Ok(entries) => {
            for one in &entries {
                let [x, y, z] = one.vector.unwrap_or_default();
                let numbers = [one.force, x, y, z].iter().all(|x| x.is_finite());
                demand(numbers, || format!("{one:?} was read"))?;
            }
            same(
                "the entries",
                &verify::read(csv(&entries).as_bytes())?,
                &entries,
            )
        }
        Err(refusal) => one_line(&refusal),
    }
}

/// Any bytes, read as the table of any code, are compared or rejected in one line. A code's table of the exact forces is
/// accepted.
pub fn any_table(u: &mut Unstructured<'_>) -> Checked {
    let pile = Pile::triangular(3)?;
    let packing = Packing::new(&pile, &Spacing::new(ratio(6, 5))?)?;
    let mut table = table(u, &packing)?;
    for _ in 0..u.int_in_range(0..=4)? {
        table.is_exact = false;
        damage(u, &mut table.file)?;
    }
    let Table {
        reader,
        file,
        is_exact,
    } = table;
    match reader.compare(&packing, &*file) {
        Ok(read) => {
            let counted = read.comparison.matched() + read.comparison.missing();
            let contacts = read.comparison.contacts();
            demand(counted <= contacts, || {
                format!("{counted} of {contacts} contacts")
            })?;
            let all = read.comparison.accepted(1e-10) && read.comparison.matched() == 12;
            demand(all || !is_exact, || format!("{}", read.comparison))
        }
        Err(refusal) => {
            one_line(&refusal)?;
            let is_short = refusal.to_string().len() < 1000;
            demand(is_short && !is_exact, || {
                format!("long, or the table is exact: {refusal}")
            })
        }
    }
}

/// A table and its reader.
struct Table {
    reader: Reader,
    file: Vec<u8>,
    /// Tells whether the table contains the exact forces.
    is_exact: bool,
}

/// A table as a code writes it. Sometimes it is one that no code writes, or arbitrary bytes.
fn table(u: &mut Unstructured<'_>, packing: &Packing<'_>) -> Result<Table, Failure> {
    let preset = *u.choose(&Preset::ALL)?;
    let (mut reader, file, mut is_exact) = match (preset, u.int_in_range(0..=7)?) {
        (_, 7) => (Reader::of(preset), u.arbitrary::<Vec<u8>>()?, false),
        (_, 6) => {
            let by_place = Reader::new().by_place(Reader::WITHIN)?;
            (
                by_place,
                placed(packing, &(own(), Axes::OWN), false)?.into_bytes(),
                true,
            )
        }
        (Preset::ExaDemVtp | Preset::Lethe, _) => {
            let picture = *u.choose(&PICTURES)?;
            // A grid contains the forces only in the form that Lethe writes.
            let is_read = preset == Preset::Lethe || LINES.contains(&picture);
            (Reader::of(preset), picture.to_vec(), is_read)
        }
        (_, dialect) => {
            let text = written_by(preset, packing, dialect == 1)?;
            let reader = match preset {
                // The user must give the stiffness.
                Preset::Mddem => {
                    let spring = "force=1024*overlap".parse();
                    let spring = spring.expect("columns of one sum");
                    Reader::new()
                        .with_columns(preset.columns().overridden(&spring))
                        .by_place(Reader::WITHIN)?
                }
                _ => Reader::of(preset),
            };
            (reader, text.into_bytes(), true)
        }
    };
    if rarely(u, 6)? {
        reader = Reader::of(*u.choose(&Preset::ALL)?);
        is_exact = false;
    }
    Ok(Table {
        reader,
        file,
        is_exact,
    })
}

/// The exact forces in a code's format, or for LAMMPS as a dump.
fn written_by(preset: Preset, packing: &Packing<'_>, as_dump: bool) -> Result<String, Failure> {
    let centres = codes::centres(packing)?;
    let measured = perfect(packing).unwrap_or_default();
    let head = codes::head(preset).unwrap_or_default();
    let rows = measured.iter().map(|one| codes::row(preset, one, &centres));
    let table = head.to_owned() + &rows.collect::<String>();
    Ok(if as_dump && preset == Preset::Lammps {
        dump(1, measured.len(), &table)
    } else {
        table
    })
}

/// Replaces a byte, removes it, or cuts the file off there.
pub(super) fn damage(u: &mut Unstructured<'_>, file: &mut Vec<u8>) -> arbitrary::Result<()> {
    let Some(last) = file.len().checked_sub(1) else {
        return Ok(());
    };
    let place = u.int_in_range(0..=last)?;
    match u.int_in_range(0..=3)? {
        0 => file.truncate(place),
        1 => drop(file.remove(place)),
        2 => {
            if let Some(byte) = file.get_mut(place) {
                *byte = *u.choose(b"0123456789.-+eE,; \n#\"<>")?;
            }
        }
        _ => {
            if let Some(byte) = file.get_mut(place) {
                *byte = u.arbitrary()?;
            }
        }
    }
    Ok(())
}

/// A reader that matches by position accepts the exact forces of a small pile, for any order, frame and size. One row
/// in ten or fewer is missing.
pub fn by_place(u: &mut Unstructured<'_>) -> Checked {
    let pile = any_pile(u)?;
    let spacing = pile::allowed_spacing(u, &pile)?;
    let mut size = || Ok::<_, Failure>(number::power(10, u.int_in_range(-12..=12)?));
    let packing = Packing::new(&pile, &spacing)?
        .with_radius(size()?)?
        .with_mass(size()?)?
        .with_gravity(size()?)?;
    let frame = any_frame(u, packing.radius().to_f64().unwrap_or(1.0))?;
    let table = placed(&packing, &frame, u.arbitrary()?)?;
    let mut rows: Vec<&str> = table.lines().skip(1).collect();
    if rows.is_empty() {
        return Ok(());
    }
    for place in (1..rows.len()).rev() {
        rows.swap(place, u.int_in_range(0..=place)?);
    }
    let missing = u.int_in_range(0..=rows.len() / 10)?;
    rows.truncate(rows.len() - missing);
    let head = table.lines().next().unwrap_or_default();
    let text = [&[head], &rows[..]].concat().join("\n");
    let within = f64::from(u.int_in_range(1_u8..=45)?) / 100.0;
    let reader = Reader::new().by_place(within)?;
    let read = match reader.compare(&packing, text.as_bytes()) {
        Err(Refusal::OutOfRange) => return Ok(()),
        read => read?,
    };
    // The comparison must accept the forces. The frame may differ by a symmetry of the pile. A nearly flat pile hardly
    // determines the turn about its line.
    let comparison = &read.comparison;
    let lost = u64::try_from(missing).unwrap_or(u64::MAX);
    let all = comparison.beyond(1e-5) == 0 && comparison.missing() <= lost;
    demand(all, || {
        format!("{frame:?} as {:?}: {comparison}", read.frame)
    })
}

/// A turn about the vertical and a shift, and then any permutation of the axes with signs.
fn any_frame(u: &mut Unstructured<'_>, radius: f64) -> Result<(Frame, Axes), Failure> {
    let mut whole = |most: i32| Ok::<_, Failure>(f64::from(u.int_in_range(-most..=most)?));
    let shift = [whole(5000)?, whole(5000)?, whole(5000)?].map(|x| x / 100.0 * radius);
    let angle = whole(180)?.to_radians();
    let mut left = vec![Coordinate::X, Coordinate::Y, Coordinate::Z];
    let mut axis = || {
        let place = u.int_in_range(0..=left.len() - 1)?;
        let (coordinate, is_reversed) = (left.remove(place), u.arbitrary()?);
        Ok::<_, Failure>(TableAxis {
            coordinate,
            is_reversed,
        })
    };
    let axes = Axes::new([axis()?, axis()?, axis()?]).unwrap_or(Axes::OWN);
    let frame = Frame {
        angle,
        shift,
        ..own()
    };
    Ok((frame, axes))
}

/// A pile of any stacking, of discs, or of spheres on an isosceles base. Its weights and loads have similar magnitudes.
/// Magnitudes that differ by many powers of ten would hide a rotation.
pub(super) fn any_pile(u: &mut Unstructured<'_>) -> Result<Pile, Failure> {
    let layers = u.int_in_range(1..=6)?;
    Ok(match u.int_in_range(0..=3)? {
        0 => Pile::discs(layers)?,
        // These bases allow any number of layers.
        1 => Pile::isosceles(layers, ratio(u.int_in_range(1..=10)?, 12))?,
        _ => region::lightly(u)?.pile()?,
    })
}

/// The frame of the scene.
fn own() -> Frame {
    let (axes, angle, shift) = (Axes::OWN, 0.0, [0.0; 3]);
    Frame { axes, angle, shift }
}

/// A table of both centres of each contact, with its force on the first sphere, in a given frame. A table of contact
/// points has no vectors, because two points do not determine them.
fn placed(
    packing: &Packing<'_>,
    (frame, axes): &(Frame, Axes),
    by_point: bool,
) -> Result<String, Failure> {
    let mut table = String::from(if by_point {
        "x,y,z,force\n"
    } else {
        "x1,y1,z1,x2,y2,z2,fx,fy,fz,force\n"
    });
    let shape = packing.pile().shape();
    for contact in packing.contacts(Selection::All)? {
        let contact = contact?;
        let direction = contact.direction.direction();
        let below = direction.and_then(|direction| shape.below(contact.site, direction));
        let Some(below) = below else { continue };
        let float = |x: &Surd| x.nearest().unwrap_or(0.0);
        let [upper, lower] = [contact.site, below].map(|site| packing.position(site));
        let [upper, lower] = [upper?, lower?].map(|place| place.each_ref().map(float));
        let [a, b] = [upper, lower].map(|centre| axes.turned(frame.place(centre)));
        let numbers = if by_point {
            [0, 1, 2].map(|n: usize| a[n].midpoint(b[n])).to_vec()
        } else {
            let vector = axes.turned(frame.turned(contact.vector.each_ref().map(float)));
            [a, b, vector].concat()
        };
        for number in numbers {
            write!(table, "{number:?},").ok();
        }
        let force: f64 = contact.force.nearest().unwrap_or(0.0);
        writeln!(table, "{force:?}").ok();
    }
    Ok(table)
}

/// Line data in every encoding of VTK, for three layers.
const LINES: [&[u8]; 6] = [
    include_bytes!("../../../dem/tests/all/verify/vtk/ascii.vtp"),
    include_bytes!("../../../dem/tests/all/verify/vtk/based.vtp"),
    include_bytes!("../../../dem/tests/all/verify/vtk/packed.vtp"),
    include_bytes!("../../../dem/tests/all/verify/vtk/raw.vtp"),
    include_bytes!("../../../dem/tests/all/verify/vtk/raw_packed.vtp"),
    include_bytes!("../../../dem/tests/all/verify/vtk/appended.vtp"),
];

/// Six files with lines, and two grids.
const PICTURES: [&[u8]; 8] = [
    LINES[0],
    LINES[1],
    LINES[2],
    LINES[3],
    LINES[4],
    LINES[5],
    include_bytes!("../../../dem/tests/all/verify/vtk/lines.vtu"),
    include_bytes!("../../../dem/tests/all/verify/vtk/lines_ascii.vtu"),
];

/// A written file is read back.
pub fn a_file(u: &mut Unstructured<'_>) -> Checked {
    let entries = entries(u)?;
    let file = written(u, &entries)?;
    same("the entries", &verify::read(file.as_bytes())?, &entries)
}

/// The exact forces of a small pile are accepted in any order. One fault among them is found.
pub fn injected_fault(u: &mut Unstructured<'_>) -> Checked {
    let pile = region::described(u)?.pile()?;
    let packing = Packing::new(&pile, &Spacing::new(ratio(6, 5))?)?;
    let Some(exact) = perfect(&packing) else {
        return Ok(());
    };
    let mut measured = exact.clone();
    shuffle(u, &mut measured)?;
    let comparison = match Comparison::new(&packing, measured.iter().copied()) {
        Err(Refusal::OutOfRange) => return Ok(()),
        comparison => comparison?,
    };
    accepted(&comparison, exact.len())?;
    let Some(place) = measured
        .len()
        .checked_sub(1)
        .map(|last| u.int_in_range(0..=last))
    else {
        return Ok(());
    };
    let (place, fault) = (place?, u.int_in_range(0..=3)?);
    let Some(one) = measured.get(place).copied() else {
        return Ok(());
    };
    let mut wrong = one;
    match fault {
        0 => wrong.force = one.force.next_up(),
        1 => wrong.force = -one.force + number::float(u)? * 1e-3,
        2 => wrong.vector = one.vector.map(|[x, y, z]| [y, x, z.next_down()]),
        _ => wrong.ids = [1, 1],
    }
    if !wrong.force.is_finite() {
        return Ok(());
    }
    if fault == 3 {
        measured.remove(place);
        let comparison = Comparison::new(&packing, measured.iter().copied())?;
        return missed(&comparison, &one);
    }
    if let Some(place) = measured.get_mut(place) {
        *place = wrong;
    }
    let comparison = Comparison::new(&packing, measured)?;
    found(&comparison, &one, &wrong)
}

/// A table of the exact forces is accepted, though some pairs are in two rows, and the floor is in the table. One fault
/// among them is found.
pub fn repeated_pairs(u: &mut Unstructured<'_>) -> Checked {
    let pile = region::described(u)?.pile()?;
    let packing = Packing::new(&pile, &Spacing::new(ratio(6, 5))?)?;
    let (Some(exact), Some(floor)) = (perfect(&packing), on_floor(&packing)) else {
        return Ok(());
    };
    let (mut measured, mut repeated) = (exact.clone(), 0);
    for one in &exact {
        if rarely(u, 3)? {
            measured.push(*one);
            repeated += 1;
        }
    }
    let wall = *u.choose(&[0, pile.numbering()?.sphere_count() + 1, u64::MAX])?;
    let floor = if u.arbitrary()? { floor } else { Vec::new() };
    let on_floor = floor
        .iter()
        .map(|(id, normal)| Measured::new([*id, wall], *normal));
    measured.extend(on_floor);
    shuffle(u, &mut measured)?;
    let comparison = match Comparison::new(&packing, measured.iter().copied()) {
        Err(Refusal::OutOfRange) => return Ok(()),
        comparison => comparison?,
    };
    accepted(&comparison, exact.len())?;
    same("repeated rows", &comparison.repeated(), &repeated)?;
    same("floor rows", &comparison.floor(), &(floor.len() as u64))?;
    let Some(last) = measured.len().checked_sub(1) else {
        return Ok(());
    };
    let place = u.int_in_range(0..=last)?;
    let one = measured.get(place).copied();
    let Some(one) = one.filter(|one| one.force != 0.0) else {
        return Ok(());
    };
    let (mut wrong, is_on_floor) = (one, one.ids.contains(&wall));
    match u.int_in_range(0..=3)? {
        0 => {
            wrong.force *= 1.25;
            wrong.vector = one.vector.map(|vector| vector.map(|x| 1.25 * x));
        }
        1 => {
            wrong.force = 0.0;
            wrong.vector = one.vector.map(|_| [0.0; 3]);
        }
        2 if !is_on_floor => {
            // The upper sphere keeps its number: pairs of two bottom spheres are not judged.
            let [first, second] = one.ids;
            let other = u.int_in_range(1..=pile.numbering()?.sphere_count())?;
            wrong.ids = if first < second {
                [first, other]
            } else {
                [other, second]
            };
        }
        _ if !is_on_floor => {
            measured.retain(|other| sorted(other.ids) != sorted(one.ids));
            let comparison = Comparison::new(&packing, measured)?;
            return missed(&comparison, &one);
        }
        _ => {
            measured.remove(place);
            let accepted = Comparison::new(&packing, measured)?.accepted(0.5);
            return same(
                "a table without a row of the floor",
                &accepted,
                &(floor.len() == 1),
            );
        }
    }
    if wrong == one {
        return Ok(());
    }
    if let Some(place) = measured.get_mut(place) {
        *place = wrong;
    }
    match Comparison::new(&packing, measured) {
        Err(Refusal::Entry { .. }) => Ok(()),
        comparison => {
            let comparison = comparison?;
            let tolerance = if wrong.ids == one.ids { 0.2 } else { 0.0 };
            demand(!comparison.accepted(tolerance), || {
                format!("{wrong:?} in place of {one:?}: {comparison}")
            })
        }
    }
}

/// Puts rows in a random order, and reverses some of them.
pub(super) fn shuffle(
    u: &mut Unstructured<'_>,
    measured: &mut [Measured],
) -> arbitrary::Result<()> {
    for place in (1..measured.len()).rev() {
        measured.swap(place, u.int_in_range(0..=place)?);
        if let (Some(one), true) = (measured.get_mut(place), u.arbitrary()?) {
            *one = one.reversed();
        }
    }
    Ok(())
}

/// The number of each bottom sphere with the correctly rounded normal force of the floor.
fn on_floor(packing: &Packing<'_>) -> Option<Vec<(u64, f64)>> {
    let numbering = packing.pile().numbering().ok()?;
    let base = packing.base(Selection::Base).ok()?;
    let forces = base.map(|force| {
        let force = force.ok()?;
        Some((numbering.id(force.site).ok()?, force.normal.nearest()?))
    });
    forces.collect()
}

/// All contacts are present, and every bit agrees.
fn accepted(comparison: &Comparison, contacts: usize) -> Checked {
    let all = u64::try_from(contacts).unwrap_or(u64::MAX);
    let holds = comparison.accepted(0.0) && comparison.matched() == all;
    demand(holds, || format!("not accepted: {comparison}"))
}

/// A removed contact counts as missing exactly if its force is not zero.
fn missed(comparison: &Comparison, gone: &Measured) -> Checked {
    let ids = comparison
        .missing_contacts()
        .first()
        .map(|first| sorted(first.ids));
    let want = (gone.force != 0.0).then(|| sorted(gone.ids));
    same("the missing contact", &ids, &want)?;
    same("the verdict", &comparison.accepted(0.5), &want.is_none())
}

/// The one wrong contact is the worst. Its error agrees with that in rationals.
fn found(comparison: &Comparison, exact: &Measured, wrong: &Measured) -> Checked {
    let differs = exact != wrong;
    same("accepted", &comparison.accepted(0.0), &!differs)?;
    if !differs {
        return Ok(());
    }
    let worst = comparison.worst().map(|worst| sorted(worst.ids));
    same("the worst contact", &worst, &Some(sorted(exact.ids)))?;
    if wrong.vector != exact.vector {
        return Ok(());
    }
    let unit = if exact.force == 0.0 {
        comparison.largest_force()
    } else {
        exact.force
    };
    if unit == 0.0 {
        let is_infinite = comparison.largest_error().is_some_and(f64::is_infinite);
        return demand(is_infinite, || format!("{comparison}"));
    }
    let apart = (number::exactly(wrong.force) - number::exactly(exact.force)).abs();
    let error = apart / number::exactly(unit).abs();
    let Some(got) = comparison.largest_error() else {
        return demand(false, || format!("no error in {comparison}"));
    };
    let near = match error.to_f64() {
        Some(error) if error.is_normal() && got.is_finite() => (got - error).abs() <= 1e-15 * error,
        // The value overflows or is subnormal.
        _ => got > 0.0,
    };
    demand(near, || format!("an error of {got:e}, not {error}"))
}

fn sorted([a, b]: [u64; 2]) -> [u64; 2] {
    [a.min(b), a.max(b)]
}

/// Each contact with its upper sphere, as correctly rounded floats. `None` if a force overflows.
pub(super) fn perfect(packing: &Packing<'_>) -> Option<Vec<Measured>> {
    let pile: &Pile = packing.pile();
    let id = |site| {
        u64::try_from(pile.shape().before(site).ok()?)
            .ok()
            .map(|n| n + 1)
    };
    let contacts = packing.contacts(Selection::All).ok()?;
    let measured = contacts.map(|contact| {
        let contact = contact.ok()?;
        let below = pile
            .shape()
            .below(contact.site, contact.direction.direction()?)?;
        let [x, y, z] = contact.vector.each_ref().map(Surd::nearest::<f64>);
        let force = contact.force.nearest::<f64>()?;
        let ids = [id(contact.site)?, id(below)?];
        Some(Measured::new(ids, force).with_vector([x?, y?, z?]))
    });
    measured.collect()
}

/// Up to six entries with arbitrary finite forces. Either all have vectors or none has.
fn entries(u: &mut Unstructured<'_>) -> arbitrary::Result<Vec<Measured>> {
    let with_vectors = u.arbitrary()?;
    let count = u.int_in_range(0..=6)?;
    let mut entries = Vec::new();
    for _ in 0..count {
        let greatest = [9, i64::MAX.unsigned_abs()][u.choose_index(2)?];
        let ids = [u.int_in_range(1..=greatest)?, u.int_in_range(1..=greatest)?];
        let one = Measured::new(ids, number::float(u)?);
        entries.push(if with_vectors {
            one.with_vector([number::float(u)?, number::float(u)?, number::float(u)?])
        } else {
            one
        });
    }
    Ok(entries)
}

/// A file of either kind, with the variations that each kind allows.
fn written(u: &mut Unstructured<'_>, entries: &[Measured]) -> arbitrary::Result<String> {
    let end = ["\n", "\r\n"][u.choose_index(2)?];
    if u.arbitrary()? {
        let text = csv(entries);
        let text = if u.arbitrary()? {
            text.replace(',', "\" , \"").replace('\n', "\"\n\"")
        } else {
            return Ok(text.replace('\n', end));
        };
        // The text must not end with an opening quote.
        let text = format!("\"{}", text.trim_end_matches('"'));
        return Ok(text.replace('\n', end));
    }
    let mut whole = String::new();
    let snapshots = u.int_in_range(1..=2)?;
    for snapshot in 1..=snapshots {
        let entries = if snapshot == snapshots {
            entries
        } else {
            entries.get(1..).unwrap_or_default()
        };
        whole += &dump(snapshot, entries.len(), &csv(entries));
    }
    Ok(whole.replace('\n', end))
}

/// A snapshot of a LAMMPS dump.
fn dump(snapshot: u8, entries: usize, table: &str) -> String {
    let table = table.replace(',', " ").replace('\n', " \n");
    format!(
        "ITEM: TIMESTEP\n{snapshot}\nITEM: NUMBER OF ENTRIES\n{entries}\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\nITEM: \
         ENTRIES {table}"
    )
}

/// The table in this program's own format, with the columns that were measured.
fn csv(entries: &[Measured]) -> String {
    let has = |column: fn(&Measured) -> bool| entries.iter().any(column);
    let mut csv = "id1,id2".to_owned();
    for (is_listed, names) in [
        (!has(|one| one.is_length), ",force"),
        (has(|one| one.vector.is_some()), ",fx,fy,fz"),
        (has(|one| one.tangential.is_some()), ",tx,ty,tz"),
    ] {
        csv += if is_listed { names } else { "" };
    }
    csv.push('\n');
    for one in entries {
        let [first, second] = one.ids;
        let force = (!one.is_length).then_some([one.force]);
        let forces = force.iter().flatten();
        let vectors = [one.vector, one.tangential].into_iter().flatten().flatten();
        let _ = write!(csv, "{first},{second}");
        for x in forces.copied().chain(vectors) {
            let _ = write!(csv, ",{x:?}");
        }
        csv.push('\n');
    }
    csv
}

#[cfg(test)]
mod injected_faults {
    use super::*;

    fn compare(measured: &[Measured]) -> Comparison {
        let pile = Pile::triangular(2).unwrap();
        let packing = Packing::new(&pile, &Spacing::new(ratio(6, 5)).unwrap()).unwrap();
        Comparison::new(&packing, measured.iter().copied()).unwrap()
    }

    #[test]
    fn an_incomplete_comparison_is_caught() {
        let force = 0.462_250_163_521_024_27;
        let right = [2, 3, 4].map(|id| Measured::new([1, id], force));
        let mut wrong = right;
        wrong[1].force = force.next_up();
        let (blind, seeing) = (compare(&right), compare(&wrong));
        assert!(accepted(&blind, 3).is_ok());
        assert!(accepted(&seeing, 3).is_err());
        assert!(accepted(&compare(&right[1..]), 3).is_err());
        assert!(found(&seeing, &right[1], &wrong[1]).is_ok());
        // These comparisons miss the fault, blame the wrong contact, or err in the last digits.
        assert!(found(&blind, &right[1], &wrong[1]).is_err());
        assert!(found(&seeing, &right[2], &wrong[1]).is_err());
        let mut other = wrong[1];
        other.force = other.force.next_up();
        assert!(found(&seeing, &right[1], &other).is_err());
        assert!(missed(&compare(&right[1..]), &right[0]).is_ok());
        assert!(missed(&compare(&right[1..]), &right[1]).is_err());
        assert!(missed(&blind, &right[1]).is_err());
    }
}
