//! `export`: a whole pile as files.

use std::io::{self, IsTerminal, Write};
use std::path::{self, Path, PathBuf};
use std::time::Instant;

use cannonpile::Packing;
use cannonpile_dem::scene::{Scene, State};
use cannonpile_dem::table::{NumberFormat, WriteError, write_aside};
use cannonpile_dem::{CardTitle, OtherFile, PileExport, PileFile, PileFormat, Written, files};
use cannonpile_figure::viewer::Page;
use clap::{Args, ValueEnum};
use num_traits::One;

use super::note_if_it_falls;
use crate::args::{Format, SceneOptions, agreed};
use crate::output::{Failure, complain, write_to};
use crate::progress::Progress;

const HELP: &str = "\
All numbers are in SI, for R = 1 m, m = 1 kg and g = 1 m/s² unless these are given. scene.toml describes it, for
--scene. Files are written under other names, and renamed when all are complete.

A card is a benchmark on a page: what the pile is, the exact answers, what springs may be off by, what a code must satisfy and
how that is checked, how to cite. Long lists are left to the files of csv. lammps-test and yade-check are to be put among the
tests of these codes: they hold the pile and its answers, and fail with the worst place.

A page is one file, which a browser opens without a network: the pile to be turned, cut and asked for its forces. With a
name that ends in .html it is written alone, and needs no folder; where neighbours of a layer touch, --state elastic shows
both states beside each other.

Examples:
  cannonpile export pile --to lammps --layers 10 --spacing 1.2
  cannonpile export pile --to csv,vtp --layers 40 --list files.csv
  cannonpile export C2 --case C2 --to csv,card
  cannonpile export checks --case C4 --to yade-check,lammps-test
  cannonpile export pile.html --to html --top hexagon:3 --stacking hcp --layers 4";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Export {
    /// The folder, created if it is missing; other files in it stay as they are. Of --to html alone also a file, FILE.html
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// What the files are for; several separated by commas, or the option repeated
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
    /// Write the list of the files to this file, not to stdout
    #[arg(
        long,
        value_name = "FILE",
        alias = "output",
        help_heading = "List of the files"
    )]
    list: Option<PathBuf>,
    /// How the list is written [default: by the ending of --list, .csv or .json; else table]
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
    /// spheres.csv, contacts.csv, base.csv: spheres by number; and columns.csv, which explains their columns
    Csv,
    /// For LAMMPS: pile.data, and pile.in, which relaxes it and writes forces.dump
    Lammps,
    /// For ParaView: spheres.vtp, contacts.vtp
    Vtp,
    /// For YADE: spheres.txt, and pile.py, which relaxes it and writes forces.csv
    Yade,
    /// A benchmark card: card.md for people, card.json for machines, with the exact answers and what a code must satisfy
    Card,
    /// For the suite of LAMMPS: dem-pile.yaml, in the style of unittest/granular; up to 2000 spheres that come to rest
    LammpsTest,
    /// For the suite of YADE: checkPile.py, in the style of scripts/checks-and-tests/checks; up to 2000 spheres
    YadeCheck,
    /// For a browser: pile.html, a page to look into the pile, or FILE.html alone; up to 100000 spheres
    Html,
    /// csv, lammps, vtp, yade and card; not the tests of suites and the page, which are of small piles
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
            Self::LammpsTest => &[PileFormat::LammpsTest],
            Self::YadeCheck => &[PileFormat::YadeCheck],
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

/// The file of [`Target::Html`].
const PAGE: &str = "pile.html";

/// From this many bytes on it is said before how much will be written.
const MUCH: u64 = 1_000_000_000;

impl Export {
    /// Writes the files, and then what they are.
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let (scene, pile) = self.scene.read_state()?;
        let packing = scene.packing(&pile)?;
        let export = PileExport::new(&packing)?
            .with_scene(scene.to_toml())
            .with_title(self.title(&scene));
        let formats = self.formats();
        check_springs(&scene, &formats)?;
        let page = self.page(&packing, &scene)?;
        self.keep_apart(&formats)?;
        let format = agreed(
            "list-format",
            self.list_format,
            "list",
            self.list.as_deref(),
        )?;
        self.check_room(&export, &formats)?;
        let begun = Instant::now();
        let progress = Progress::of_rows("files", Some(rows(&export, &formats)));
        let advance = &mut |rows| progress.advance(rows);
        let written = match &page {
            Some(page) if self.is_of_page(&formats) => {
                self.write_page(page).map(|written| vec![written])
            }
            Some(page) => {
                let (name, write) = (PAGE, &|out: &mut dyn Write| page.write(out));
                let page = [OtherFile { name, write }];
                export.write_with(&formats, &page, &self.folder, advance)
            }
            None => export.write(&formats, &self.folder, advance),
        };
        drop(progress);
        let written = written.map_err(|error| match error {
            WriteError::Answer(error) => self.scene.beyond_floats(error.into(), &scene),
            error => Failure::of_writing(error, "list", self.list.as_deref()),
        })?;
        write_to("list", self.list.as_deref(), |out| {
            files(&written).write(format.into(), NumberFormat::Exact, out)
        })?;
        note_if_it_falls(&pile);
        tell_rate(&written, begun);
        Ok(true)
    }

    /// Returns whether the page is asked for alone, by the name of a file.
    fn is_of_page(&self, formats: &[PileFormat]) -> bool {
        let ending = self.folder.extension().and_then(|ending| ending.to_str());
        let is_html = ending.is_some_and(|ending| ending.eq_ignore_ascii_case("html"));
        self.to.contains(&Target::Html) && formats.is_empty() && is_html && !self.folder.is_dir()
    }

    /// Writes the page where the folder would be.
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

    /// Returns what a card says of the scene.
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

    /// Returns the page, if it is asked for. A pile that is too large for it is refused before anything is written.
    fn page<'p>(&self, packing: &Packing<'p>, scene: &Scene) -> Result<Option<Page<'p>>, Failure> {
        if !self.to.contains(&Target::Html) {
            return Ok(None);
        }
        let page = Page::new(packing)?;
        let page = page.with_title(self.title(scene));
        Ok(Some(page.with_scene(scene.to_toml())))
    }

    /// Returns the formats asked for, each once.
    fn formats(&self) -> Vec<PileFormat> {
        let asked: Vec<_> = self.to.iter().flat_map(|target| target.formats()).collect();
        let chosen = PileFormat::ALL.into_iter();
        chosen.filter(|format| asked.contains(&format)).collect()
    }

    /// The list must not take the place of one of the files that it lists.
    fn keep_apart(&self, formats: &[PileFormat]) -> Result<(), Failure> {
        let Some(list) = &self.list else {
            return Ok(());
        };
        let place = |path: &Path| path::absolute(path).ok();
        let files = formats.iter().flat_map(|format| format.files());
        let page = self.to.contains(&Target::Html).then(|| {
            if self.is_of_page(formats) {
                self.folder.clone()
            } else {
                self.folder.join(PAGE)
            }
        });
        let mut paths = files.map(|file| self.folder.join(file.name())).chain(page);
        if paths.any(|path| place(&path) == place(list)) {
            let list = list.display();
            return Err(Failure::Message(format!(
                "--list: {list} is one of the files of the export: name another file for the list"
            )));
        }
        Ok(())
    }

    /// Says how much will be written, if it is much, and refuses what the disk has no room for.
    fn check_room(&self, files: &PileExport<'_>, formats: &[PileFormat]) -> Result<(), Failure> {
        let all = formats.iter().flat_map(|format| format.files());
        let bytes: u64 = all.map(|file| bytes(files, *file)).sum();
        if bytes < MUCH {
            return Ok(());
        }
        let gigabytes = bytes / MUCH;
        let folder = self.folder.display();
        let there = path::absolute(&self.folder).unwrap_or_else(|_| self.folder.clone());
        let there = there.ancestors().find(|folder| folder.exists());
        // Where this is not known, the disk will say it.
        let room = there.and_then(|folder| fs4::available_space(folder).ok());
        if let Some(room) = room.filter(|room| *room < bytes) {
            return Err(Failure::Message(format!(
                "DIR: {folder} would take about {gigabytes} GB, and its disk has room for {}: choose another disk, fewer \
                 formats or fewer layers",
                indicatif::DecimalBytes(room)
            )));
        }
        complain(&format!(
            "note: about {gigabytes} GB will be written into {folder}"
        ));
        Ok(())
    }
}

/// Scripts have one stiffness for all springs.
fn check_springs(scene: &Scene, formats: &[PileFormat]) -> Result<(), Failure> {
    let scripts = [
        PileFormat::Lammps,
        PileFormat::Yade,
        PileFormat::LammpsTest,
        PileFormat::YadeCheck,
    ];
    let is_alike = scene.state == State::Isostatic || scene.stiffness_ratio == One::one();
    if is_alike || !formats.iter().any(|format| scripts.contains(format)) {
        return Ok(());
    }
    Err(Failure::Message(format!(
        "--stiffness-ratio: the springs of LAMMPS and YADE are alike here, not {} times as stiff in horizontal contacts: use \
         1, or --to csv,vtp",
        scene.stiffness_ratio
    )))
}

/// Returns about how many bytes a file will have, rather too few than too many.
fn bytes(files: &PileExport<'_>, file: PileFile) -> u64 {
    // Measured for 100 layers.
    let a_row = match file {
        PileFile::ContactsVtp => 137,
        PileFile::SpheresVtp => 104,
        PileFile::ContactsCsv => 78,
        PileFile::LammpsData => 74,
        PileFile::SpheresCsv => 67,
        _ => 46,
    };
    files.rows(file).unwrap_or(0) * a_row
}

/// Returns the rows of all files.
fn rows(files: &PileExport<'_>, formats: &[PileFormat]) -> u64 {
    let rows = formats.iter().flat_map(|format| format.files());
    rows.filter_map(|file| files.rows(*file)).sum()
}

/// Says in one line on stderr how fast it was, at a terminal, or if it took more than a second.
fn tell_rate(written: &[Written], begun: Instant) {
    let seconds = begun.elapsed().as_secs_f64();
    if seconds < 1.0 && !io::stderr().is_terminal() {
        return;
    }
    let rows: u64 = written.iter().filter_map(|file| file.rows).sum();
    let bytes: u64 = written.iter().map(|file| file.bytes).sum();
    #[expect(
        clippy::cast_precision_loss,
        reason = "rows that fit on a disk are exact enough as floats"
    )]
    let rate = rows as f64 / seconds;
    let files = written.len();
    complain(&format!(
        "{rows} rows and {bytes} bytes in {files} files in {seconds:.1} s: {rate:.0} rows/s"
    ));
}
