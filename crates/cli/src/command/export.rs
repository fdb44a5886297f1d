//! `export`: writes a pile as files.

use std::io::{self, IsTerminal, Write};
use std::path::{self, Path, PathBuf};
use std::time::Instant;

use cannonpile::Packing;
use cannonpile_dem::scene::{Scene, State};
use cannonpile_dem::table::{NumberFormat, WriteError, write_aside};
use cannonpile_dem::{
    CardTitle, Friction, OtherFile, PileExport, PileFile, PileFormat, Written, files,
};
use cannonpile_figure::viewer::Page;
use clap::{Args, ValueEnum};
use num_traits::One;

use super::note_instability;
use crate::args::{Format, SceneOptions, UnitSystem, in_state, resolve_format};
use crate::output::{Failure, creates_folder_of, print_message, write_around, write_to};
use crate::progress::Progress;

const HELP: &str = "\
All numbers but those of mtx are in SI. Each export also writes scene.toml, which --scene reads. All files appear together,
when all are complete.

A card is a benchmark on one page: the pile, the exact forces, the error of springs, the acceptance criteria, and how to
cite it.

mtx is a sparse linear system for any solver: equilibrium.mtx x = loads.mtx / denominator in the format of Matrix Market,
its exact solution, and its singular values. It is in f0 and integers, or with --units si in newtons and floats.

The HTML viewer is one file that a browser opens offline. It rotates and cuts the pile and shows the forces. If DIR ends in
.html, only this file is written. With --state elastic it shows the isostatic and the elastic state.

Examples:
  cannonpile export pile --to lammps --layers 10 --spacing 1.2
  cannonpile export pile --to csv,vtp --layers 40 --list files.csv
  cannonpile export C2 --case C2 --to csv,card
  cannonpile export four --layers 2 --floor rough --to lammps,yade --friction 0.41 --floor-friction 0.11
  cannonpile export matrix --to mtx --stacking hcp --layers 20
  cannonpile export pile.html --to html --top hexagon:3 --stacking hcp --layers 4";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Export {
    /// Folder for the files, created if it is missing; for --to html alone also a file, FILE.html
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Formats, separated by commas; repeatable
    #[arg(
        long,
        value_enum,
        value_delimiter = ',',
        value_name = "FORMAT",
        default_value = "csv"
    )]
    to: Vec<Target>,
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    /// Add the stress of each sphere times its volume to spheres.csv and spheres.vtp, in N·m
    #[arg(long)]
    stress: bool,
    /// Units of the mtx files: integers in f0, or floats in newtons [default: pile]
    #[arg(long, value_enum, value_name = "UNITS")]
    units: Option<UnitSystem>,
    /// File for the list of the written files [default: stdout]
    #[arg(
        long,
        value_name = "FILE",
        alias = "output",
        help_heading = "List of the files"
    )]
    list: Option<PathBuf>,
    /// Format of the list [default: csv or json if --list has this extension, otherwise table]
    #[arg(
        long,
        value_enum,
        value_name = "FORMAT",
        alias = "format",
        help_heading = "List of the files"
    )]
    list_format: Option<Format>,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Target {
    /// Tables: spheres.csv, contacts.csv, base.csv, and columns.csv, which explains their columns
    Csv,
    /// LAMMPS input: pile.data and pile.in, which relaxes the pile and writes forces.dump
    Lammps,
    /// ParaView geometry: spheres.vtp and contacts.vtp
    Vtp,
    /// YADE input: spheres.txt and pile.py, which relaxes the pile and writes forces.csv
    Yade,
    /// Benchmark card: card.md for people and card.json for programs
    Card,
    /// Linear system with known solution and singular values: equilibrium.mtx, loads.mtx, forces.mtx, forces_exact.txt,
    /// properties.json
    Mtx,
    /// HTML viewer: pile.html, or FILE.html alone; at most 100000 spheres
    Html,
    /// csv, lammps, vtp, yade and card
    All,
}

impl Target {
    const fn formats(self) -> &'static [PileFormat] {
        match self {
            Self::Csv => &[PileFormat::Csv],
            Self::Lammps => &[PileFormat::Lammps],
            Self::Vtp => &[PileFormat::Vtp],
            Self::Yade => &[PileFormat::Yade],
            Self::Card => &[PileFormat::Card],
            Self::Mtx => &[PileFormat::Mtx],
            Self::Html => &[],
            Self::All => &[
                PileFormat::Csv,
                PileFormat::Lammps,
                PileFormat::Vtp,
                PileFormat::Yade,
                PileFormat::Card,
            ],
        }
    }
}

/// The file name of [`Target::Html`].
const PAGE: &str = "pile.html";

/// From this number of bytes on, a note announces the size beforehand.
const LARGE_EXPORT: u64 = 1_000_000_000;

impl Export {
    /// Writes the files, and then their list.
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let (scene, pile) = self.scene.read_any()?;
        let pile = in_state(&scene, pile)?;
        let packing = scene.packing(&pile)?;
        let formats = self.formats();
        let export = PileExport::new(&packing)?
            .with_scene(scene.to_toml())
            .with_title(self.title(&scene));
        let export = match self.friction(&scene, &packing, &formats)? {
            None => export,
            Some(friction) => export.on_rough_floor(friction)?,
        };
        let export = if self.stress {
            check_stress(&formats)?;
            export.with_stress()
        } else {
            export
        };
        let export = match self.units {
            Some(_) if !formats.contains(&PileFormat::Mtx) => {
                return Err(Failure::Message(
                    "--units: files other than mtx are in SI: add mtx to --to, or leave it out"
                        .to_owned(),
                ));
            }
            Some(UnitSystem::Si) => export.with_equations_in_si(),
            _ => export,
        };
        check_springs(&scene, &formats)?;
        let page = self.page(&packing, &scene)?;
        self.check_list_path(&formats)?;
        let format = resolve_format(
            "list-format",
            self.list_format,
            "list",
            self.list.as_deref(),
        )?;
        self.check_free_space(&export, &formats)?;
        let begun = Instant::now();
        let (list, mut written) = (self.list.as_deref(), Vec::new());
        let failure = |error| match error {
            WriteError::Answer(error) => self.scene.overflow_failure(error.into(), &scene),
            error => Failure::of_writing(error, "list", list),
        };
        let write = || {
            let written = self.write(&export, &formats, page.as_ref());
            written.map_err(failure)
        };
        let list_of = |written: &[Written], out: &mut dyn Write| {
            files(written).write(format.into(), NumberFormat::Exact, out)
        };
        if list.is_some_and(|list| creates_folder_of(&self.folder, list)) {
            written = write()?;
            write_to("list", list, |out| list_of(&written, out))?;
        } else {
            write_around("list", list, |out| {
                written = write()?;
                list_of(&written, out).map_err(failure)
            })?;
        }
        note_instability(&pile);
        print_rate(&written, begun);
        Ok(true)
    }

    /// Writes the files.
    fn write(
        &self,
        export: &PileExport<'_>,
        formats: &[PileFormat],
        page: Option<&Page<'_>>,
    ) -> Result<Vec<Written>, WriteError> {
        let progress = Progress::of_rows("files", Some(rows(export, formats)));
        let advance = &mut |rows| progress.advance(rows);
        match page {
            Some(page) if self.is_viewer_only(formats) => {
                self.write_page(page).map(|written| vec![written])
            }
            Some(page) => {
                let (name, write) = (PAGE, &|out: &mut dyn Write| page.write(out));
                let page = [OtherFile { name, write }];
                export.write_with(formats, &page, &self.folder, advance)
            }
            None => export.write(formats, &self.folder, advance),
        }
    }

    /// Returns the coefficients of friction of a scene with a rough floor.
    fn friction(
        &self,
        scene: &Scene,
        packing: &Packing<'_>,
        formats: &[PileFormat],
    ) -> Result<Option<Friction>, Failure> {
        let friction = scene.friction(packing).map_err(|error| match error {
            cannonpile_dem::Error::Core(cannonpile::Error::Overflow { .. }) => Failure::Message(
                "--friction, --floor-friction: outside the range of f64: use a coefficient such as 0.5"
                    .to_owned(),
            ),
            error => error.into(),
        })?;
        let Some(friction) = friction else {
            return Ok(None);
        };
        let supported = [PileFormat::Lammps, PileFormat::Yade, PileFormat::Card];
        let is_other = |format: &PileFormat| !supported.contains(format);
        if self.to.contains(&Target::Html) || formats.iter().any(is_other) {
            return Err(Failure::Message(
                "--to: a rough floor supports lammps, yade and card: use --to lammps,yade,card"
                    .to_owned(),
            ));
        }
        Ok(Some(friction))
    }

    /// Returns whether the viewer is the only file, named by the user.
    fn is_viewer_only(&self, formats: &[PileFormat]) -> bool {
        let ending = self.folder.extension().and_then(|ending| ending.to_str());
        let is_html = ending.is_some_and(|ending| ending.eq_ignore_ascii_case("html"));
        self.to.contains(&Target::Html) && formats.is_empty() && is_html && !self.folder.is_dir()
    }

    /// Writes the viewer to the path that otherwise names the folder.
    fn write_page(&self, page: &Page<'_>) -> Result<Written, WriteError> {
        let (path, mut bytes) = (self.folder.clone(), 0);
        let written = write_aside(&path, |out| {
            let mut text = Vec::new();
            page.write(&mut text)?;
            bytes = text.len() as u64;
            Ok(out.write_all(&text)?)
        });
        match written {
            Ok(()) => Ok(Written {
                file: None,
                path,
                rows: None,
                bytes,
            }),
            Err(WriteError::Io(error)) => Err(WriteError::File { path, error }),
            Err(error) => Err(error),
        }
    }

    /// Returns the title of the benchmark card.
    fn title(&self, scene: &Scene) -> CardTitle {
        let ratio = (scene.state == State::Elastic).then(|| scene.stiffness_ratio.clone());
        let of_scene = CardTitle {
            state: scene.state,
            stiffness_ratio: ratio,
            ..CardTitle::default()
        };
        match self.scene.case(scene) {
            None => of_scene,
            Some(case) => CardTitle {
                case: case.name().into(),
                title: case.title().into(),
                purpose: case.purpose().into(),
                ..of_scene
            },
        }
    }

    /// Returns the viewer, if `--to` selects it. Fails before any file is written if the pile is too large for it.
    fn page<'p>(&self, packing: &Packing<'p>, scene: &Scene) -> Result<Option<Page<'p>>, Failure> {
        if !self.to.contains(&Target::Html) {
            return Ok(None);
        }
        let page = Page::new(packing)?;
        let page = page.with_title(self.title(scene));
        Ok(Some(page.with_scene(scene.to_toml())))
    }

    /// Returns the formats of `--to`, each once.
    fn formats(&self) -> Vec<PileFormat> {
        let asked: Vec<_> = self.to.iter().flat_map(|target| target.formats()).collect();
        let chosen = PileFormat::ALL.into_iter();
        chosen.filter(|format| asked.contains(&format)).collect()
    }

    /// Checks that `--list` does not overwrite one of the files of the export.
    fn check_list_path(&self, formats: &[PileFormat]) -> Result<(), Failure> {
        let Some(list) = &self.list else {
            return Ok(());
        };
        let place = |path: &Path| path::absolute(path).ok();
        let files = formats.iter().flat_map(|format| format.files());
        let page = self.to.contains(&Target::Html).then(|| {
            if self.is_viewer_only(formats) {
                self.folder.clone()
            } else {
                self.folder.join(PAGE)
            }
        });
        let mut paths = files.map(|file| self.folder.join(file.name())).chain(page);
        if paths.any(|path| place(&path) == place(list)) {
            let list = list.display();
            return Err(Failure::Message(format!(
                "--list: {list} is one of the exported files: give another file name"
            )));
        }
        if place(&self.folder)
            .zip(place(list))
            .is_some_and(|(folder, list)| folder.starts_with(list))
        {
            let list = list.display();
            return Err(Failure::Message(format!(
                "--list: {list} is the folder of the export: give a file name"
            )));
        }
        Ok(())
    }

    /// Prints a note about a large export, and fails if the disk has too little space.
    fn check_free_space(
        &self,
        files: &PileExport<'_>,
        formats: &[PileFormat],
    ) -> Result<(), Failure> {
        let all = formats.iter().flat_map(|format| format.files());
        let bytes: u64 = all.map(|file| bytes(files, *file)).sum();
        if bytes < LARGE_EXPORT {
            return Ok(());
        }
        let gigabytes = bytes / LARGE_EXPORT;
        let folder = self.folder.display();
        let there = path::absolute(&self.folder).unwrap_or_else(|_| self.folder.clone());
        let there = there.ancestors().find(|folder| folder.exists());
        // If the free space is unknown, a full disk is reported while writing.
        let room = there.and_then(free_space);
        if let Some(room) = room.filter(|room| *room < bytes) {
            return Err(Failure::Message(format!(
                "{folder} needs about {gigabytes} GB, but its disk has only {} MB free: use another disk, fewer formats or \
                 fewer layers",
                room / 1_000_000
            )));
        }
        print_message(&format!(
            "note: this export writes about {gigabytes} GB to {folder}"
        ));
        Ok(())
    }
}

/// Returns the free space of the disk of a folder, in bytes, where the system tells it.
#[cfg(unix)]
fn free_space(folder: &Path) -> Option<u64> {
    let disk = rustix::fs::statvfs(folder).ok()?;
    disk.f_bavail.checked_mul(disk.f_frsize)
}

#[cfg(not(unix))]
fn free_space(_: &Path) -> Option<u64> {
    None
}

/// Checks that an exported file can contain the stress.
fn check_stress(formats: &[PileFormat]) -> Result<(), Failure> {
    if formats.contains(&PileFormat::Csv) || formats.contains(&PileFormat::Vtp) {
        return Ok(());
    }
    Err(Failure::Message(
        "--stress: only csv and vtp files contain the stress: add csv or vtp to --to, or leave it out".to_owned(),
    ))
}

/// Checks that scripts for DEM codes, which have a single spring stiffness, can represent the scene.
fn check_springs(scene: &Scene, formats: &[PileFormat]) -> Result<(), Failure> {
    let scripts = [PileFormat::Lammps, PileFormat::Yade];
    let is_alike = scene.state == State::Isostatic || scene.stiffness_ratio == One::one();
    if is_alike || !formats.iter().any(|format| scripts.contains(format)) {
        return Ok(());
    }
    Err(Failure::Message(format!(
        "--stiffness-ratio: the scripts for LAMMPS and YADE have one stiffness for all contacts, not the ratio {}: use 1, or \
         --to csv,vtp",
        scene.stiffness_ratio
    )))
}

/// Returns a lower estimate of the size of a file, in bytes.
fn bytes(files: &PileExport<'_>, file: PileFile) -> u64 {
    // Bytes a row, measured for 100 layers.
    let a_row = match file {
        PileFile::ContactsVtp => 182,
        PileFile::SpheresVtp => 138,
        PileFile::ContactsCsv => 78,
        PileFile::LammpsData => 74,
        PileFile::SpheresCsv => 67,
        PileFile::EquilibriumMtx => 12,
        PileFile::LoadsMtx | PileFile::ForcesMtx | PileFile::ForcesExact => 2,
        _ => 46,
    };
    files.rows(file).unwrap_or(0) * a_row
}

/// Returns the number of rows of all files.
fn rows(files: &PileExport<'_>, formats: &[PileFormat]) -> u64 {
    let rows = formats.iter().flat_map(|format| format.files());
    rows.filter_map(|file| files.rows(*file)).sum()
}

/// Prints the rows per second on stderr, if stderr is a terminal or the export took more than a second.
fn print_rate(written: &[Written], begun: Instant) {
    let seconds = begun.elapsed().as_secs_f64();
    if seconds < 1.0 && !io::stderr().is_terminal() {
        return;
    }
    let rows: u64 = written.iter().filter_map(|file| file.rows).sum();
    let bytes: u64 = written.iter().map(|file| file.bytes).sum();
    #[expect(
        clippy::cast_precision_loss,
        reason = "the number of rows that fit on a disk is exact enough as a float"
    )]
    let rate = rows as f64 / seconds;
    let files = written.len();
    print_message(&format!(
        "{rows} rows and {bytes} bytes in {files} files in {seconds:.1} s: {rate:.0} rows/s"
    ));
}
