//! Files of any kind.

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

/// Reads measured forces from a file of either kind: a LAMMPS dump if its first line begins with `ITEM:`, else csv.
///
/// Of what scene they are is not known yet: a [`Reader`] compares while it reads, and refuses sooner what does not fit.
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

/// How a code's table is read: which columns hold what, and how its contacts are those of a pile.
///
/// # Examples
/// DEM-Engine has numbers of its own, and says where spheres touch:
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
    /// How far off a sphere may be that is known by where it is, in radii; none if it is known by its number.
    within: Option<f64>,
    with_balance: bool,
}

/// A file that was read and compared.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Compared {
    /// What it says of the forces.
    pub comparison: Comparison,
    /// What the forces on each sphere add up to, if that was asked for.
    pub unbalanced: Option<Unbalanced>,
    /// How many snapshots a dump had, the last of which was kept; 0 for other files.
    pub snapshots: u64,
    /// The time step of the snapshot that was kept.
    pub timestep: Option<i64>,
    /// How many rows are contacts with walls.
    pub walls: u64,
    /// Where the table's origin and axes are, if contacts were found by place in a frame other than that of the scene.
    pub frame: Option<Frame>,
}

impl Reader {
    /// The distance in radii within which a sphere is found at a place, unless another is named.
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

    /// A reader of tables with this crate's or LAMMPS' names, by the numbers of the spheres.
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
    ///     "line 3: spheres 1 and 2 again, after line 2: list each pair once",
    /// );
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The reader of a known code's tables.
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

    /// Returns it for other columns.
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

    /// Returns it for tables that say where contacts are: by both centres, or by the point where they touch. A sphere is
    /// found within a share of its radius; a shift or a turn of the whole table, axes with other names and a mirror image
    /// are found, and told as the [`Frame`].
    ///
    /// # Errors
    /// [`Refusal::Within`] unless the share is positive and below a half.
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

    /// Returns it for tables with the numbers of the spheres.
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

    /// Returns it to add up the forces on each sphere besides: 24 bytes a sphere.
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

    /// Reads a file, and compares it with the exact forces of a packing: a LAMMPS dump if its first line begins with
    /// `ITEM:`, lines with data in VTK's XML if it begins with `<`, else a table whose columns are separated by commas,
    /// semicolons, tabs or blanks.
    ///
    /// Memory is eight bytes a contact of the pile, 24 more where there are vectors. By place it is some 60 a sphere more for
    /// the search, and where the frame is another one, 250 a row. VTK's XML is kept whole besides; a table is read line by
    /// line, however long.
    ///
    /// # Errors
    /// [`Refusal::Line`] for what cannot be read, the number of a sphere that the pile has not got, a pair that is there
    /// twice, and a place where no spheres touch; [`Refusal::Elsewhere`] if there is no frame for the places.
    /// [`Refusal::Scene`] with [`Error::TooLarge`](cannonpile::Error::TooLarge) for more contacts than are compared;
    /// [`Refusal::OutOfRange`] for exact forces beyond the normal `f64`; [`Refusal::Io`].
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

/// The distance, as a share of the radius, if spheres can be told apart by it.
pub(super) fn checked_within(within: f64) -> Result<f64, Refusal> {
    if within > 0.0 && within < 0.5 {
        return Ok(within);
    }
    Err(Refusal::Within(within))
}
