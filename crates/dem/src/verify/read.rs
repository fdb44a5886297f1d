//! Files of any supported format.

use std::collections::BTreeSet;
use std::io::Read;
use std::path::PathBuf;

use contact_tables::{
    Columns, Contact, Contacts, Dialect, DialectOptions, FileKind, Format, Identity, Preset,
    RowCounts, is_same_step,
};

use super::comparison::{Comparison, of_entry};
use super::frame::Frame;
use super::gathering::Gathering;
use super::ledger::{Ledger, numbers};
use super::measured::{MAX_ENTRIES, Measured};
use super::placed::Placed;
use super::refusal::{Fault, Refusal};
use super::unbalanced::Unbalanced;
use crate::scene::Floor;
use cannonpile::{Interrupt, Packing};

/// Reads measured forces from a file of any kind, without a pile to compare them with, in the order of the file.
///
/// # Errors
/// Those of [`Reader::compare`] that do not depend on a pile.
///
/// # Examples
/// ```
/// use cannonpile_dem::verify;
/// use cannonpile_dem::verify::Measured;
///
/// let measured = verify::read(&b"id1,id2,force\n3,1,0.25\n1,2,0.5\n"[..])?;
/// assert_eq!(measured, [Measured::new([3, 1], 0.25), Measured::new([1, 2], 0.5)]);
/// # Ok::<(), cannonpile_dem::verify::Refusal>(())
/// ```
pub fn read(input: impl Read) -> Result<Vec<Measured>, Refusal> {
    let mut all = Vec::new();
    read_each(input, &Format::default(), MAX_ENTRIES, |row| {
        let measured = Measured::of(unsigned(row)?, row);
        // The length of a vector may overflow.
        if !measured.force.is_finite() {
            let (column, value) = ("force", measured.force);
            return Err(Fault::NotFinite { column, value }.at(row.line));
        }
        all.push(measured);
        Ok(())
    })?;
    Ok(all)
}

/// Returns the numbers of the two spheres of a row, if none is negative.
fn unsigned(row: &Contact) -> Result<[u64; 2], Refusal> {
    let [one, other] = numbers(row)?;
    let unsigned = |column, id: i64| {
        u64::try_from(id).map_err(|_| contact_tables::Error::Line {
            line: row.line,
            reason: format!("{column} '{id}' is not a number of at least 0"),
        })
    };
    Ok([unsigned("id1", one)?, unsigned("id2", other)?])
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
    format: Format,
    /// The largest distance of a sphere from its exact position, in radii, if contacts are matched by position.
    within: Option<f64>,
    floor: Floor,
}

/// The result of reading and comparing a file.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Compared {
    /// The comparison with the exact forces.
    pub comparison: Comparison,
    /// The residual force on each sphere above the floor.
    pub unbalanced: Unbalanced,
    /// The kind of the file.
    pub kind: FileKind,
    /// The dialect, if the file is a text table.
    pub dialect: Option<Dialect>,
    /// The number of rows that were compared, and of those that were left out.
    pub rows: RowCounts,
    /// The number of rows of the table of the floor, as in `rows`, if there was one.
    pub floor_rows: Option<RowCounts>,
    /// The number of steps of the file; 0 if it names none.
    pub steps: u64,
    /// The step that was read.
    pub step: Option<String>,
    /// The number of rows that are contacts with walls and are not judged.
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
    /// let wrong = [&b"id1,id2,force\n1,2,0.5\n1,1,0.5\n"[..], &[b'1'; 1 << 20]].concat();
    /// assert_eq!(
    ///     Reader::new().compare(&packing, &*wrong).unwrap_err().to_string(),
    ///     "line 3: sphere 1 is paired with itself: name two different spheres",
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
            format: preset.into(),
            within: preset.is_by_place().then_some(Self::WITHIN),
            floor: Floor::Glued,
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
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_columns(mut self, columns: Columns) -> Self {
        self.format.columns = columns;
        self
    }

    /// Returns this reader for text tables of a dialect. Without it, the first lines decide the dialect.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Packing, Pile};
    /// use cannonpile_dem::verify::{DialectOptions, Reader};
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?;
    /// let table = "id1,id2,force\n#1,2,0.46\n#1,3,0.46\n#1,4,0.46\n";
    /// let error = Reader::new().compare(&packing, table.as_bytes()).unwrap_err();
    /// assert!(error.to_string().ends_with("3 lines are comments that look like rows: set comment to none to read them"));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn with_dialect(mut self, dialect: DialectOptions) -> Self {
        self.format.dialect = dialect;
        self
    }

    /// Returns this reader for one step of a file with several. Without it, the last step is read.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Packing, Pile};
    /// use cannonpile_dem::verify::Reader;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?;
    /// let row = |step, id, force| format!("{step},1,{id},{force}\n");
    /// let rows = |step, force| [2, 3, 4].map(|id| row(step, id, force)).concat();
    /// let table = ["step,id1,id2,force\n".to_owned(), rows(100, 0.46), rows(200, 9.0)].concat();
    /// let read = |reader: Reader| reader.compare(&packing, table.as_bytes());
    /// assert!(!read(Reader::new())?.comparison.accepted(0.01));
    /// let early = read(Reader::new().with_step("100".into()))?;
    /// assert!(early.comparison.accepted(0.01));
    /// assert_eq!((early.steps, early.rows.other_steps), (2, 3));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn with_step(mut self, step: String) -> Self {
        self.format.step = Some(step);
        self
    }

    /// Returns this reader for tables with the positions of contacts: both centres, or the contact point. Each sphere
    /// must be closer to its exact position than `within` times the radius. The reader finds any rotation, mirror image and
    /// translation of the whole table, and returns it as the [`Frame`]. A row with one bottom sphere, and with a point
    /// straight below it, is a contact with the floor.
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
        self.format.identity = Identity::Places;
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
        self.format.identity = Identity::Numbers;
        self
    }

    /// Returns this reader for piles on a floor. A rough floor adds tangential forces, friction and moments to the comparison.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Packing, Pile};
    /// use cannonpile_dem::scene::Floor;
    /// use cannonpile_dem::verify::Reader;
    ///
    /// let pile = Pile::discs(2)?;
    /// let packing = Packing::new(&pile, &"1.2".parse()?)?;
    /// // N = 1/2 mg, and T = N·tan(θ/2) with tanθ = 3/4. The vectors are the forces on the upper disc.
    /// let table = "id1,id2,fx,fy,fz,tx,ty,tz\n1,2,0.3,0,0.4,-0.13333333333,0,0.1\n1,3,-0.3,0,0.4,0.13333333333,0,0.1\n\
    ///              2,0,0,0,1.5,0.16666666667,0,0\n3,0,0,0,1.5,-0.16666666667,0,0\n";
    /// let read = Reader::new().on_floor(Floor::Rough).compare(&packing, table.as_bytes())?;
    /// assert_eq!(read.comparison.tangential(), 2);
    /// assert!(read.comparison.accepted(1e-9));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn on_floor(mut self, floor: Floor) -> Self {
        self.format.tangential = floor == Floor::Rough;
        Self { floor, ..self }
    }

    /// Returns this reader for a file in this folder. Files of ParaView (`.pvtp`, `.pvtu`) name others beside them.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Packing, Pile};
    /// use cannonpile_dem::verify::Reader;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?;
    /// let whole = "<VTKFile type='PPolyData'><PPolyData><Piece Source='a.vtp'/></PPolyData></VTKFile>";
    /// let read = |reader: Reader| reader.compare(&packing, whole.as_bytes()).unwrap_err().to_string();
    /// assert!(read(Reader::new()).starts_with("the contacts are in other files: give 'a.vtp'"));
    /// assert!(read(Reader::new().in_folder("nowhere".into())).starts_with("a.vtp: "));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn in_folder(mut self, folder: PathBuf) -> Self {
        self.format.folder = Some(folder);
        self
    }

    /// Reads a file, and compares it with the exact forces of a packing. The first bytes determine its
    /// [kind](FileKind). It may be compressed by gzip.
    ///
    /// A text table may have cells between commas, semicolons, tabs, blanks or vertical bars, quotes, comments, lines
    /// above and below it, a row of units, and decimal commas: its [`Dialect`]. Columns that are not needed may hold
    /// anything.
    ///
    /// Memory is 17 bytes for each contact of the pile, and 24 more if there are vectors. It is 64 bytes for each sphere. On a rough floor, it is 24 more for
    /// tangential forces, and 48 for each sphere. It is twice as much if pairs
    /// are in two rows with different forces. Matching by position takes about 60 more bytes for each sphere. If the
    /// frame differs from that of the scene, it also takes eight bytes for each contact and for each number of a row. A
    /// text is read line by line, whatever its length. Of a dump, and of the last of several steps, the rows are kept: eight
    /// bytes for each number that is read. A VTK file is kept as a whole.
    ///
    /// # Errors
    /// * [`Refusal::Table`] for a file of another kind, such as a spreadsheet, for a VTK file without readable contacts, if the
    ///   wanted step is not there, and for errors of the input. [`Refusal::NoRows`] if no row is a contact of the pile.
    /// * [`Refusal::Line`] for a line that cannot be read, an unknown sphere number, or a position where no spheres touch.
    /// * [`Refusal::Line`] for a third row of a pair, or a second one in the same order with another force. Also for more
    ///   rows than two for each contact and eighty for each sphere.
    /// * [`Refusal::Elsewhere`] if no frame matches the positions to the pile.
    /// * [`Refusal::Scene`] with [`Error::TooLarge`](cannonpile::Error::TooLarge) for a pile with too many contacts.
    ///   [`Refusal::OutOfRange`] for exact forces outside the normal range of `f64`.
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
    pub fn compare(&self, packing: &Packing<'_>, input: impl Read) -> Result<Compared, Refusal> {
        let compared = self.compare_from_one(packing, input, None::<&[u8]>);
        compared.map_err(|refusal| refusal.renumbered(self.format.columns.first_id()))
    }

    /// Compares a file, and a second one with the force of the floor on each sphere: columns `id`, `fx`, `fy` and `fz`, and
    /// possibly `tx`, `ty` and `tz` as for contacts. Every bottom sphere needs a row. Spheres above them may be listed with a
    /// force of 0. The columns have these names, whatever the columns and the dialect of this reader.
    ///
    /// # Errors
    /// As for [`compare`](Self::compare), and [`Refusal::FloorTable`] for the second file. Contacts must be matched by numbers.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Packing, Pile};
    /// use cannonpile_dem::scene::Floor;
    /// use cannonpile_dem::verify::Reader;
    ///
    /// let pile = Pile::discs(2)?;
    /// let packing = Packing::new(&pile, &"1.2".parse()?)?;
    /// let contacts = "id1,id2,fx,fy,fz\n1,2,0.16666666667,0,0.5\n1,3,-0.16666666667,0,0.5\n";
    /// let floor = "id,fx,fy,fz\n1,0,0,0\n2,0.16666666667,0,1.5\n3,-0.16666666667,0,1.5\n";
    /// let reader = Reader::new().on_floor(Floor::Rough);
    /// let read = reader.compare_with_floor(&packing, contacts.as_bytes(), floor.as_bytes())?;
    /// assert!(read.comparison.floor_friction_error().unwrap() < 1e-9);
    /// assert!(read.comparison.accepted(1e-9));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    pub fn compare_with_floor(
        &self,
        packing: &Packing<'_>,
        input: impl Read,
        floor: impl Read,
    ) -> Result<Compared, Refusal> {
        let compared = self.compare_from_one(packing, input, Some(floor));
        compared.map_err(|refusal| refusal.renumbered(self.format.columns.first_id()))
    }

    /// Compares a file. An error numbers the spheres from 1.
    fn compare_from_one(
        &self,
        packing: &Packing<'_>,
        input: impl Read,
        floor: Option<impl Read>,
    ) -> Result<Compared, Refusal> {
        let mut ledger = match self.floor {
            Floor::Glued => Ledger::new(packing)?,
            Floor::Rough => Ledger::on_rough_floor(packing)?,
        };
        let mut frame = None;
        let format = &self.format;
        // The ledger refuses one row too many with a better reason than the reader of the file.
        let most = ledger.most_rows() + 1;
        let read = if let Some(within) = self.within {
            let mut gathering = Gathering::new(ledger, within)?;
            let read = read_each(input, format, most, |row| gathering.take(row))?;
            let (filled, fit) = gathering.settle()?;
            frame = Some(fit).filter(|frame| *frame != Frame::OWN);
            ledger = filled;
            read
        } else {
            read_each(input, format, most, |row| ledger.take(row))?
        };
        let floor_rows = floor.map(|floor| {
            let of_floor = self.read_floor(floor, read.step(), &mut ledger);
            of_floor.map_err(|refusal| Refusal::FloorTable(Box::new(refusal)))
        });
        let floor_rows = floor_rows.transpose()?;
        let rows = read.rows().clone();
        let walls = rows.other_kinds - rows.ghosts + ledger.unjudged_walls();
        let (judged, unbalanced) = ledger.judge()?;
        let comparison = Comparison::of(judged);
        let judged = comparison.matched() + comparison.floor();
        if comparison.contacts() > 0 && judged == 0 {
            let reason = self.why_none(&rows);
            return Err(Refusal::NoRows { reason });
        }
        Ok(Compared {
            comparison,
            unbalanced,
            kind: read.kind,
            dialect: read.dialect.clone(),
            rows,
            floor_rows,
            steps: read.steps(),
            step: read.step().map(str::to_owned),
            walls,
            frame,
        })
    }

    /// Reads a table with the force of the floor on each sphere, and returns the number of its rows. The columns have their
    /// usual names.
    fn read_floor(
        &self,
        input: impl Read,
        step: Option<&str>,
        ledger: &mut Ledger<'_>,
    ) -> Result<RowCounts, Refusal> {
        if self.within.is_some() {
            return Err(Refusal::FloorByPlace);
        }
        if ledger.has_floor() {
            return Err(Refusal::FloorTwice);
        }
        let format = Format {
            columns: Columns::default().with_first_id(self.format.columns.first_id()),
            identity: Identity::OneNumber,
            dialect: DialectOptions::default(),
            ..self.format.clone()
        };
        let mut seen = BTreeSet::new();
        let most = ledger.most_rows();
        let read = read_each(input, &format, most, |row| {
            ledger.take_of_floor(row, &mut seen)
        })?;
        if let (Some(wanted), Some(found)) = (step, read.step())
            && !is_same_step(wanted, found)
        {
            let (wanted, found) = (wanted.to_owned(), found.to_owned());
            return Err(contact_tables::Error::NoStep { wanted, found }.into());
        }
        if read.rows().used == 0 {
            let reason = read.rows().why_none();
            return Err(Refusal::NoRows { reason });
        }
        Ok(read.rows().clone())
    }

    /// Returns why no contact was matched, with the likeliest remedy.
    fn why_none(&self, rows: &RowCounts) -> String {
        let read = match rows.used {
            0 => return rows.why_none(),
            1 => "1 row was read".to_owned(),
            rows => format!("{rows} rows were read"),
        };
        let remedy = if self.within.is_some() {
            "is the table of this scene?"
        } else {
            "are the spheres numbered as in spheres.csv of the export? --first-id 0 counts from 0, and --match place \
             finds contacts by position"
        };
        format!("{read}, but none is a contact of the scene: {remedy}")
    }
}

/// Reads a file with at most so many rows in a step, and calls a function with each row.
fn read_each<'r>(
    input: impl Read + 'r,
    format: &Format,
    most_rows: u64,
    mut take: impl FnMut(&Contact) -> Result<(), Refusal>,
) -> Result<Contacts<'r>, Refusal> {
    let format = Format {
        most_rows: Some(most_rows),
        ..format.clone()
    };
    let mut contacts = contact_tables::read(input, &format)?;
    for contact in contacts.by_ref() {
        take(&contact?)?;
    }
    Ok(contacts)
}

/// Returns this fraction of the radius, if it is small enough to distinguish spheres.
fn checked_within(within: f64) -> Result<f64, Refusal> {
    if within > 0.0 && within < 0.5 {
        return Ok(within);
    }
    Err(Refusal::Within(within))
}

impl Comparison {
    /// Compares measured forces with those of a packing, and matches contacts by position. Each sphere must be closer
    /// to its exact position than `within` times the radius. Also returns the frame of the positions, if it differs
    /// from that of the packing.
    ///
    /// # Errors
    /// Those of [`new`](Self::new). [`Refusal::Within`] unless 0 < `within` < 1/2. [`Refusal::Elsewhere`] if no frame
    /// matches the positions to the pile. [`Refusal::Entry`] for a force at a position without a contact.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Comparison, Force, Placed};
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::discs(2)?;
    /// let packing = Packing::new(&pile, &"1.2".parse()?)?;
    /// // These positions are eight metres higher than in the pile.
    /// let measured = [-0.6, 0.6].map(|x| Placed::at([x, 0.0, 8.8], Force::Along(0.625)));
    /// let (comparison, frame) = Comparison::of_places(&packing, measured, 0.1)?;
    /// assert_eq!(comparison.matched(), 2);
    /// assert_eq!(frame.unwrap().shift, [0.0, 0.0, -8.0]);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    pub fn of_places(
        packing: &Packing<'_>,
        measured: impl IntoIterator<Item = Placed>,
        within: f64,
    ) -> Result<(Self, Option<Frame>), Refusal> {
        let within = checked_within(within)?;
        let mut gathering = Gathering::new(Ledger::new(packing)?, within)?;
        for (entry, placed) in (1..).zip(measured) {
            Interrupt::check()?;
            let row = placed.row(entry).map_err(|fault| fault.at(entry));
            row.and_then(|row| gathering.take(&row)).map_err(of_entry)?;
        }
        let (ledger, frame) = gathering.settle().map_err(of_entry)?;
        let (judged, _) = ledger.judge().map_err(of_entry)?;
        let frame = Some(frame).filter(|frame| *frame != Frame::OWN);
        Ok((Self::of(judged), frame))
    }
}
