//! Tests of exports that fail, and of the folder afterwards.

use std::fs;
use std::io::{self, Write};

use cannonpile::Pile;
use cannonpile_dem::scene::{Scene, parse};
use cannonpile_dem::table::WriteError;
use cannonpile_dem::{Error, PileExport, PileFile, PileFormat, Written};
use cannonpile_testkit::scenes::{bytes, packing};

/// A disk with a limited number of free bytes.
struct Full(usize);

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.0 == 0 {
            return Err(io::ErrorKind::StorageFull.into());
        }
        let written = bytes.len().min(self.0);
        self.0 -= written;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

fn files() -> impl Iterator<Item = &'static PileFile> {
    PileFormat::ALL.iter().flat_map(|format| format.files())
}

#[test]
fn a_full_disk_is_reported_at_every_position() {
    let pile = Pile::triangular(4).expect("a pile");
    let export = PileExport::new(&packing(&pile)).expect("files");
    for file in files() {
        let size = bytes(&export, *file).len();
        for room in (0..size).step_by(97).chain([size - 1]) {
            let written = export.write_file(*file, &mut Full(room), &mut |_| {});
            let Err(WriteError::Io(error)) = written else {
                panic!("{file:?} in {room} bytes: {written:?}");
            };
            assert_eq!(error.kind(), io::ErrorKind::StorageFull);
        }
        let whole = export.write_file(*file, &mut Full(size), &mut |_| {});
        assert!(whole.is_ok());
    }
}

#[test]
fn all_files_or_none() {
    let pile = Pile::triangular(4).expect("a pile");
    let export = PileExport::new(&packing(&pile)).expect("files");
    let folder = tempfile::tempdir().expect("a folder");
    let formats = [PileFormat::Yade, PileFormat::Csv, PileFormat::Yade];
    let inside = folder.path().join("new/and newer");
    let written = export.write(&formats, &inside, &mut |_| {}).expect("files");
    // Each format occurs once, in order.
    let names: Vec<&str> = written.iter().map(Written::name).collect();
    assert_eq!(
        names,
        [
            "spheres.csv",
            "contacts.csv",
            "base.csv",
            "columns.csv",
            "spheres.txt",
            "pile.py"
        ]
    );
    assert_eq!(fs::read_dir(&inside).expect("a folder").count(), 6);
    for written in written {
        let content = fs::read(&written.path).expect("a file");
        let file = written.file.expect("a file of the pile");
        assert_eq!(content, bytes(&export, file));
        assert_eq!(content.len() as u64, written.bytes);
        assert_eq!(export.rows(file), written.rows);
    }
    // A folder has one of the names: no new file remains, and existing files are unchanged.
    let taken = folder.path().join("taken");
    fs::create_dir_all(taken.join("contacts.csv")).expect("a folder");
    fs::write(taken.join("notes"), "mine").expect("a file");
    let refused = export.write(&[PileFormat::Csv], &taken, &mut |_| {});
    let Err(WriteError::File { path, .. }) = refused else {
        panic!("{refused:?}");
    };
    assert_eq!(path, taken.join("contacts.csv"));
    assert_eq!(fs::read_dir(&taken).expect("a folder").count(), 2);
    assert_eq!(
        fs::read_to_string(taken.join("notes")).expect("a file"),
        "mine"
    );
}

#[test]
fn a_name_taken_at_the_last_moment() {
    let pile = Pile::triangular(4).expect("a pile");
    let export = PileExport::new(&packing(&pile)).expect("files");
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("spheres.txt"), "mine").expect("a file");
    let taken = folder.path().join("contacts.csv");
    let mut reports = 0;
    // While the third file is written, a folder takes the name of the second one. So the rename of the second file
    // fails, after that of the first.
    let mut take = |_| {
        reports += 1;
        if reports == 3 {
            fs::create_dir_all(taken.join("inside")).expect("a folder");
        }
    };
    let refused = export.write(&[PileFormat::Csv], folder.path(), &mut take);
    assert!(matches!(refused, Err(WriteError::File { path, .. }) if path == taken));
    assert_eq!(reports, 3);
    assert!(!folder.path().join("spheres.csv").exists());
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 2);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_leaves_nothing() {
    let pile = Pile::triangular(4).expect("a pile");
    let export = PileExport::new(&packing(&pile)).expect("files");
    let folder = tempfile::tempdir().expect("a folder");
    for (format, full) in [
        (PileFormat::Csv, "base.csv"),
        (PileFormat::Vtp, "contacts.vtp"),
        (PileFormat::Lammps, "pile.in"),
    ] {
        let link = folder.path().join(full);
        std::os::unix::fs::symlink("/dev/full", &link).expect("a link");
        let refused = export.write(&[format], folder.path(), &mut |_| {});
        let Err(WriteError::File { path, error }) = refused else {
            panic!("{refused:?}");
        };
        assert_eq!(
            (path, error.kind()),
            (link.clone(), io::ErrorKind::StorageFull)
        );
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1);
        fs::remove_file(link).expect("removed");
    }
}

#[test]
fn a_folder_that_cannot_be_made() {
    let pile = Pile::triangular(2).expect("a pile");
    let export = PileExport::new(&packing(&pile)).expect("files");
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("file");
    fs::write(&file, "").expect("a file");
    let refused = export.write(&[PileFormat::Csv], &file.join("in"), &mut |_| {});
    assert!(
        matches!(refused, Err(WriteError::File { .. })),
        "{refused:?}"
    );
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1);
}

#[test]
fn numbers_beyond_floats_are_refused() {
    let pile = Pile::triangular(3).expect("a pile");
    let scene = |radius: &str, mass: &str| Scene {
        radius: parse::rational(radius).expect("a number"),
        mass: parse::rational(mass).expect("a number"),
        ..Scene::default()
    };
    let folder = tempfile::tempdir().expect("a folder");
    // The equations in f₀ have no radius and no mass.
    let all = PileFormat::ALL
        .into_iter()
        .filter(|format| *format != PileFormat::Mtx);
    let all: Vec<_> = all.collect();
    for (radius, mass, formats) in [
        ("1e400", "1", &all[..]),
        ("1", "1e400", &all),
        // The csv files contain 0, as the tables do; springs need a positive number.
        ("1", "1e-400", &[PileFormat::Lammps, PileFormat::Yade]),
        ("1e-120", "1", &[PileFormat::Lammps, PileFormat::Yade]),
        ("1e120", "1", &[PileFormat::Lammps, PileFormat::Yade]),
    ] {
        let scene = scene(radius, mass);
        let packing = scene.packing(&pile).expect("room");
        let export = PileExport::new(&packing).expect("files");
        for format in formats {
            let new = folder.path().join("new");
            let refused = export.write(&[*format], &new, &mut |_| {});
            let overflow = matches!(
                refused,
                Err(WriteError::Answer(Error::Core(
                    cannonpile::Error::Overflow { .. }
                )))
            );
            assert!(overflow, "{radius} {mass} {format:?}: {refused:?}");
            assert!(!new.exists());
        }
    }
}

#[test]
fn too_many_rows_are_refused() {
    let pile = Pile::triangular(10_000).expect("a pile");
    let refused = PileExport::new(&packing(&pile));
    assert!(matches!(
        refused,
        Err(Error::Core(cannonpile::Error::TooManyRows { .. }))
    ));
}
