//! The measured forces in a file, with their lines.

use super::comparison::Comparison;
use super::entry::{Entry, Sink};
use super::measured::{MAX_ENTRIES, Measured};
use super::refusal::{Fault, Refusal};
use cannonpile::Packing;

/// Measured forces read from a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading {
    entries: Vec<Measured>,
    /// The entries that are not on the line after the previous entry, with their lines.
    jumps: Vec<(usize, u64)>,
    snapshots: u64,
    timestep: Option<i64>,
}

impl Reading {
    /// Returns the measured forces, in the order of the file.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify;
    /// use cannonpile_dem::verify::Measured;
    ///
    /// let reading = verify::read(&b"id1,id2,force\n3,1,0.25\n1,2,0.5\n"[..])?;
    /// assert_eq!(reading.entries(), [Measured::new([3, 1], 0.25), Measured::new([1, 2], 0.5)]);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn entries(&self) -> &[Measured] {
        &self.entries
    }

    /// Returns the number of snapshots of a dump. Only the last one was kept. For csv it is 0.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify;
    ///
    /// let dump = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n1\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n\
    ///             ITEM: ENTRIES id1 id2 force\n1 2 0.5\n";
    /// let reading = verify::read(dump.repeat(3).as_bytes())?;
    /// assert_eq!((reading.snapshots(), reading.entries().len()), (3, 1));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn snapshots(&self) -> u64 {
        self.snapshots
    }

    /// Returns the time step of the kept snapshot.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify;
    ///
    /// let dump = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n1\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n\
    ///             ITEM: ENTRIES id1 id2 force\n1 2 0.5\n";
    /// let later = dump.replacen("\n0\n", "\n500\n", 1);
    /// assert_eq!(verify::read([dump, &later].concat().as_bytes())?.timestep(), Some(500));
    /// // A csv table has no time step.
    /// assert_eq!(verify::read(&b"id1,id2,force\n"[..])?.timestep(), None);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn timestep(&self) -> Option<i64> {
        self.timestep
    }

    /// Returns the line of an entry. Lines are counted from 1, and entries from 0.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify;
    ///
    /// // Empty lines count as lines, but not as entries.
    /// let reading = verify::read(&b"id1,id2,force\n1,2,0.5\n\n1,3,0.5\n"[..])?;
    /// assert_eq!([0, 1].map(|entry| reading.line(entry)), [2, 4]);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn line(&self, entry: usize) -> u64 {
        let after = self.jumps.partition_point(|(first, _)| *first <= entry);
        let jump = after.checked_sub(1).and_then(|last| self.jumps.get(last));
        let (first, line) = jump.copied().unwrap_or((0, 0));
        let below = u64::try_from(entry.saturating_sub(first)).unwrap_or(u64::MAX);
        line.saturating_add(below)
    }

    /// Compares the measured forces with the exact ones.
    ///
    /// # Errors
    /// Those of [`Comparison::new`], with the line in the file.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use cannonpile_dem::verify;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let reading = verify::read(&b"id1,id2,force\n1,2,0.46225\n\n1,5,0.46225\n"[..])?;
    /// assert_eq!(
    ///     reading.compare(&packing).unwrap_err().to_string(),
    ///     "line 4: no sphere 5: the spheres of this scene are numbered 1 to 4, from the top",
    /// );
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    pub fn compare(&self, packing: &Packing<'_>) -> Result<Comparison, Refusal> {
        let line = |entry: u64| {
            let entry = usize::try_from(entry.saturating_sub(1)).unwrap_or(usize::MAX);
            self.line(entry)
        };
        Comparison::new(packing, self.entries.iter().copied()).map_err(|refusal| match refusal {
            Refusal::Entry {
                entry,
                fault: Fault::Twice { ids, first },
            } => Fault::Twice {
                ids,
                first: first.map(line),
            }
            .at(line(entry)),
            Refusal::Entry { entry, fault } => fault.at(line(entry)),
            other => other,
        })
    }
}

impl Sink for Reading {
    fn begin_snapshot(&mut self, timestep: Option<i64>) {
        self.entries.clear();
        self.jumps.clear();
        self.snapshots += 1;
        self.timestep = timestep;
    }

    fn take(&mut self, entry: &Entry, line: u64) -> Result<(), Refusal> {
        let measured = entry.named()?;
        let place = self.entries.len();
        if place as u64 >= MAX_ENTRIES {
            let limit = MAX_ENTRIES;
            return Err(Fault::TooMany { limit }.at(line));
        }
        if place == 0 || self.line(place) != line {
            self.jumps.push((place, line));
        }
        self.entries.push(measured);
        Ok(())
    }

    fn pass_over(&mut self) {}
}
