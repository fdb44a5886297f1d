//! Files of any supported format.

use std::io::BufRead;

use super::columns::Columns;
use super::comparison::Comparison;
use super::csv_file::{Format, read_rows};
use super::dump::{ITEM, read_snapshots};
use super::entry::Sink;
use super::frame::Frame;
use super::gathering::Gathering;
use super::header::Identity;
use super::ledger::Ledger;
use super::lines::Lines;
use super::preset::Preset;
use super::reading::Reading;
use super::refusal::Refusal;
use super::unbalanced::Unbalanced;
use super::vtk_file;
use cannonpile::Packing;

/// Reads measured forces from a file: a LAMMPS dump if its first line begins with `ITEM:`, otherwise a csv table.
///
/// This function does not know the scene. A [`Reader`] compares while it reads, so it rejects rows that do not match
/// the pile earlier.
///
/// # Errors
/// Those of [`read_csv`](super::read_csv) and [`read_dump`](super::read_dump).
///
/// # Examples
/// ```
/// use cannonpile_dem::verify;
///
/// let reading = verify::read(&b"id1,id2,force\n1,2,0.5\n"[..])?;
/// assert_eq!((reading.entries().len(), reading.snapshots()), (1, 0));
/// # Ok::<(), cannonpile_dem::verify::Refusal>(())
/// ```
pub fn read(input: impl BufRead) -> Result<Reading, Refusal> {
    let mut reading = Reading::default();
    read_any(input, &Format::default(), &mut reading)?;
    Ok(reading)
}

/// A reader of a code's tables: the meaning of the columns, and the method that matches contacts.
///
/// # Examples
/// DEM-Engine numbers its spheres in its own way, and writes contact points:
/// ```
/// use cannonpile::geometry::Spacing;
/// use cannonpile_dem::verify::{Preset, Reader};
/// use cannonpile::{Packing, Pile};
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(2)?;
/// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(1.into(), 1.into()))?)?;
/// let table = "contact_type,A,B,f_x,f_y,f_z,X,Y,Z\n\
///              SS,7,9,0.2357,0,0.3333,-0.57735,0,0.8165\n\
///              SS,7,4,-0.11785,-0.204124,0.3333,0.288675,0.5,0.8165\n\
///              SS,7,5,-0.11785,0.204124,0.3333,0.288675,-0.5,0.8165\n";
/// let read = Reader::of(Preset::DemEngine).compare(&packing, table.as_bytes())?;
/// assert!(read.comparison.accepted(1e-3));
/// # Ok::<(), cannonpile_dem::verify::Refusal>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reader {
    columns: Columns,
    /// The largest distance of a sphere from its exact position, in radii, if contacts are matched by position.
    within: Option<f64>,
    with_balance: bool,
}

/// The result of reading and comparing a file.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Compared {
    /// The comparison with the exact forces.
    pub comparison: Comparison,
    /// The residual force on each sphere, if the reader was asked for it.
    pub unbalanced: Option<Unbalanced>,
    /// The number of snapshots of a dump; 0 for other files. The last snapshot was kept.
    pub snapshots: u64,
    /// The time step of the kept snapshot.
    pub timestep: Option<i64>,
    /// The number of rows that are contacts with walls.
    pub walls: u64,
    /// The frame of the table, if contacts were matched by position and the frame differs from that of the scene.
    pub frame: Option<Frame>,
}

impl Reader {
    /// The default for the largest distance of a sphere from its exact position, in radii.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Preset, Reader};
    ///
    /// let by_place = Reader::new().with_columns(Preset::Lethe.columns()).by_place(Reader::WITHIN)?;
    /// assert_eq!(by_place, Reader::of(Preset::Lethe));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    pub const WITHIN: f64 = 0.1;

    /// Returns a reader of tables with the column names of this crate or of LAMMPS. It matches contacts by the numbers
    /// of the spheres.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile_dem::verify::Reader;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let repeated = [&b"id1,id2,force\n1,2,0.5\n2,1,0.5\n"[..], &[b'1'; 1 << 20]].concat();
    /// assert_eq!(
    ///     Reader::new().compare(&packing, &*repeated).unwrap_err().to_string(),
    ///     "line 3: spheres 1 and 2 are already on line 2: list each pair once",
    /// );
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Returns a reader of the tables of a known code.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Preset, Reader};
    ///
    /// assert_eq!(Reader::of(Preset::Lammps), Reader::new());
    /// ```
    #[must_use]
    pub fn of(preset: Preset) -> Self {
        Self {
            columns: preset.columns(),
            within: preset.is_by_place().then_some(Self::WITHIN),
            with_balance: false,
        }
    }

    /// Returns this reader with other columns.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile_dem::verify::Reader;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let reader = Reader::new().with_columns("id1=A,id2=B,force=-Fn".parse()?);
    /// let read = reader.compare(&packing, &b"A B Fn\n1 2 -0.46\n1 3 -0.46\n1 4 -0.46\n"[..])?;
    /// assert!(read.comparison.accepted(0.01));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn with_columns(self, columns: Columns) -> Self {
        Self { columns, ..self }
    }

    /// Returns this reader for tables with the positions of contacts: both centres, or the contact point. Each sphere
    /// must be closer to its exact position than `within` times the radius. The reader finds translations and rotations
    /// of the whole table, renamed axes and mirror images, and returns them as the [`Frame`].
    ///
    /// # Errors
    /// [`Refusal::Within`] unless 0 < `within` < 1/2.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Reader;
    ///
    /// assert!(Reader::new().by_place(0.1).is_ok());
    /// assert!(Reader::new().by_place(1.0).is_err());
    /// ```
    pub fn by_place(mut self, within: f64) -> Result<Self, Refusal> {
        self.within = Some(checked_within(within)?);
        Ok(self)
    }

    /// Returns this reader for tables with the numbers of the spheres.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Preset, Reader};
    ///
    /// let reader = Reader::of(Preset::Mddem);
    /// assert_ne!(reader.clone().by_numbers(), reader);
    /// ```
    #[must_use]
    pub fn by_numbers(mut self) -> Self {
        self.within = None;
        self
    }

    /// Returns this reader with a sum of the forces on each sphere, for 24 bytes per sphere.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile_dem::verify::Reader;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let table = "id1,id2,fx,fy,fz\n1,2,0,0,0.25\n1,3,0,0,0.25\n1,4,0,0,0.5\n";
    /// let read = Reader::new().with_balance().compare(&packing, table.as_bytes())?;
    /// assert_eq!(read.unbalanced.unwrap().to_string(), "0.0 N at sphere 1");
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn with_balance(self) -> Self {
        Self {
            with_balance: true,
            ..self
        }
    }

    /// Reads a file, and compares it with the exact forces of a packing. The first line determines the format: `ITEM:`
    /// begins a LAMMPS dump, and `<` begins an XML file of VTK with lines and data. Any other file is a table with
    /// commas, semicolons, tabs or blanks as separators.
    ///
    /// Memory is eight bytes for each contact of the pile, and 24 more if there are vectors. Matching by position takes
    /// about 60 more bytes for each sphere. If the frame differs from that of the scene, it also takes 250 bytes for each
    /// row. A table is read line by line, whatever its length, but a VTK file is kept in memory as a whole.
    ///
    /// # Errors
    /// [`Refusal::Line`] for a line that cannot be read, an unknown sphere number, a repeated pair, or a position where
    /// no spheres touch. [`Refusal::Elsewhere`] if no frame matches the positions to the pile. [`Refusal::Scene`] with
    /// [`Error::TooLarge`](cannonpile::Error::TooLarge) for a pile with too many contacts. [`Refusal::OutOfRange`] for
    /// exact forces outside the normal range of `f64`. [`Refusal::Io`] for errors of the input.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile_dem::verify::Reader;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let read = Reader::new().compare(&packing, &b"id1;id2;force\n1;2;0.462\n1;3;0.462\n1;4;0.46\n"[..])?;
    /// assert_eq!(read.comparison.beyond(1e-3), 1);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    pub fn compare(&self, packing: &Packing<'_>, input: impl BufRead) -> Result<Compared, Refusal> {
        let format = Format {
            columns: self.columns.clone(),
            identity: match self.within {
                Some(_) => Identity::Places,
                None => Identity::Numbers,
            },
        };
        let mut ledger = Ledger::new(packing)?;
        let mut frame = None;
        if let Some(within) = self.within {
            let mut gathering = Gathering::new(ledger, within)?;
            read_any(input, &format, &mut gathering)?;
            let (filled, found) = gathering.settle()?;
            frame = Some(found).filter(|frame| *frame != Frame::OWN);
            ledger = filled;
        } else {
            read_any(input, &format, &mut ledger)?;
        }
        let (snapshots, timestep) = (ledger.snapshots(), ledger.timestep());
        let walls = ledger.walls();
        let (judged, unbalanced) = ledger.judge(self.with_balance)?;
        Ok(Compared {
            comparison: Comparison::of(judged),
            unbalanced,
            snapshots,
            timestep,
            walls,
            frame,
        })
    }
}

fn read_any(mut input: impl BufRead, format: &Format, sink: &mut impl Sink) -> Result<(), Refusal> {
    if input.fill_buf()?.first() == Some(&b'<') {
        let mut bytes = Vec::new();
        input.read_to_end(&mut bytes)?;
        return vtk_file::read_lines(&bytes, format, sink);
    }
    let mut lines = Lines::new(input);
    let first = lines.next()?;
    let is_dump = first.is_some_and(|line| line.text.starts_with(ITEM));
    lines.put_back();
    if is_dump {
        read_snapshots(lines, format, sink)
    } else {
        read_rows(lines, format, sink)
    }
}

/// Returns this fraction of the radius, if it is small enough to distinguish spheres.
pub(super) fn checked_within(within: f64) -> Result<f64, Refusal> {
    if within > 0.0 && within < 0.5 {
        return Ok(within);
    }
    Err(Refusal::Within(within))
}
