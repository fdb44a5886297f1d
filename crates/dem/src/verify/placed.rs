//! The measured force of a contact that is known by its position.

use super::comparison::{Comparison, of_entry};
use super::entry::{Entry, Force, Place, Sink, Spheres};
use super::frame::Frame;
use super::gathering::Gathering;
use super::ledger::Ledger;
use super::read::checked_within;
use super::refusal::{Fault, Refusal};
use cannonpile::{Interrupt, Packing};

/// A measured force between two spheres that are known by position.
///
/// # Examples
/// ```
/// use cannonpile_dem::verify::{Force, Placed};
///
/// let push = Placed::at([-0.6, 0.0, 0.8], Force::Along(0.625));
/// assert_ne!(push, Placed::at([-0.6, 0.0, 0.8], Force::Along(-0.625)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    place: Place,
    force: Force,
}

impl Placed {
    /// Returns a measurement at a contact point, in m. A vector may be the force on either sphere.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Comparison, Force, Placed};
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::discs(2)?;
    /// let packing = Packing::new(&pile, &"1.2".parse()?)?;
    /// let measured = [-0.6, 0.6].map(|x| Placed::at([x, 0.0, 0.8], Force::Vector([-0.625 * x, 0.0, 0.5])));
    /// let (comparison, frame) = Comparison::of_places(&packing, measured, 0.1)?;
    /// assert!(comparison.accepted(1e-12) && frame.is_none());
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub const fn at(point: [f64; 3], force: Force) -> Self {
        let place = Place::Point(point);
        Self { place, force }
    }

    /// Returns a measurement between two centres, in m. A vector is the force on the first sphere.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Comparison, Force, Placed};
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::discs(2)?;
    /// let packing = Packing::new(&pile, &"1.2".parse()?)?;
    /// let centres = [-1.2, 1.2].map(|x| [[0.0, 0.0, 1.6], [x, 0.0, 0.0]]);
    /// let measured = centres.map(|centres| Placed::between(centres, Force::Along(0.625)));
    /// let (comparison, _) = Comparison::of_places(&packing, measured, 0.1)?;
    /// assert!(comparison.accepted(1e-12));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub const fn between(centres: [[f64; 3]; 2], force: Force) -> Self {
        let place = Place::Centres(centres);
        Self { place, force }
    }

    /// Returns the measurement as a row of a table, if all its numbers are finite.
    fn entry(&self) -> Result<Entry, Fault> {
        let mut coordinates = self.place.points().iter().flatten().copied();
        if let Some(value) = coordinates.find(|x| !x.is_finite()) {
            let column = "a coordinate";
            return Err(Fault::NotFinite { column, value });
        }
        self.force.refuse_infinite()?;
        Ok(Entry {
            spheres: Spheres::Places(self.place),
            force: self.force,
            tangential: None,
        })
    }
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
            let row = placed.entry().map_err(|fault| fault.at(entry));
            row.and_then(|row| gathering.take(&row, entry))
                .map_err(of_entry)?;
        }
        let (ledger, frame) = gathering.settle().map_err(of_entry)?;
        let (judged, _) = ledger.judge().map_err(of_entry)?;
        let frame = Some(frame).filter(|frame| *frame != Frame::OWN);
        Ok((Self::of(judged), frame))
    }
}
