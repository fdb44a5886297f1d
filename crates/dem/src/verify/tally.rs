//! A running count of the contacts, with their errors.

use super::difference::{Difference, Extra};
use super::floor::OnFloor;
use super::friction::WithFriction;
use super::loads::Loads;
use super::measured::{Measured, distance, relative, sort_decreasing};
use super::symptoms::Symptoms;
use crate::{Each, NumberedContact, NumberedPile};
use cannonpile::lattice::Dimension;
use cannonpile::shape::Numbering;

/// The number of missing contacts, and of extra pairs, that are kept. All of them are counted.
const KEPT: usize = 1000;

/// The result for the contacts so far.
pub(super) struct Tally {
    dimension: Dimension,
    with_vectors: bool,
    is_rough: bool,
    judged: Judged,
    /// The errors of contacts without a force. They are relative to the largest force, which is known only at the end.
    idle: Vec<f64>,
    /// The differences between two rows of one contact without a force.
    idle_contradictions: Vec<f64>,
    worst_idle: Option<Difference>,
}

/// The result of a comparison.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Judged {
    pub(super) contacts: u64,
    pub(super) missing: u64,
    pub(super) first_missing: Vec<Difference>,
    pub(super) fixed: u64,
    pub(super) largest_force: f64,
    /// The number of rows that list a contact again, and of rows that are shares of another row.
    pub(super) repeated: u64,
    pub(super) shares: u64,
    /// The relative errors of the measured contacts, in decreasing order.
    pub(super) errors: Vec<f64>,
    /// The forces of pairs without a contact, relative to the largest force, in decreasing order.
    pub(super) strays: Vec<f64>,
    pub(super) greatest_strays: Vec<Extra>,
    pub(super) worst: Option<Difference>,
    /// The differences between two rows of one contact, relative to its force, in decreasing order.
    pub(super) contradictions: Vec<f64>,
    /// The number of contacts with the floor that are judged, and the relative errors of the bottom spheres.
    pub(super) floor: u64,
    pub(super) floor_errors: Vec<f64>,
    /// The spheres above the bottom layer that touch the floor, with their forces relative to the largest one.
    pub(super) fallen: Vec<(u64, f64)>,
    /// The bottom spheres without a row in a table of the floor, and the first of them.
    pub(super) off_floor: Option<(u64, u64)>,
    /// The largest difference of a contact with a force, in N.
    pub(super) difference: f64,
    /// The patterns in the contacts with a force.
    pub(super) symptoms: Symptoms,
    /// The patterns in the loads of the spheres.
    pub(super) loads: Loads,
    /// The stiffness of springs that explains the errors, in N/m.
    pub(super) stiffness: Option<f64>,
    /// The result for tangential forces, if the floor is rough.
    pub(super) friction: Option<WithFriction>,
}

impl Tally {
    /// Begins a comparison. Bottom spheres on a rough floor are not fixed.
    pub(super) fn new(pile: &NumberedPile<'_>, with_vectors: bool, is_rough: bool) -> Self {
        Self {
            is_rough,
            dimension: pile.packing().pile().dimension(),
            with_vectors,
            judged: Judged::default(),
            idle: Vec::new(),
            idle_contradictions: Vec::new(),
            worst_idle: None,
        }
    }

    /// Returns the largest exact force so far.
    pub(super) fn largest_force(&self) -> f64 {
        self.judged.largest_force
    }

    /// Adds a contact of the pile with its measured force, and the different force of a second row. Returns the relative
    /// error of the worse one, if the contact has a force and was measured.
    pub(super) fn add(
        &mut self,
        exact: &NumberedContact,
        measured: Option<Measured>,
        second: Option<Measured>,
    ) -> Option<f64> {
        let judged = &mut self.judged;
        judged.contacts += 1;
        judged.largest_force = judged.largest_force.max(exact.force.abs());
        let difference = || Difference::missing(exact, self.with_vectors, self.dimension);
        let loaded = exact.force != 0.0;
        let Some(mut measured) = measured else {
            if loaded {
                judged.symptoms.miss(exact);
                judged.missing += 1;
                if judged.first_missing.len() < KEPT {
                    judged.first_missing.push(difference());
                }
            }
            return None;
        };
        let mut apart = difference_from(exact, &measured);
        if let Some(second) = second {
            let contradiction = measured.difference(&second);
            if loaded {
                let contradiction = relative(contradiction, exact.force.abs());
                judged.contradictions.push(contradiction);
            } else {
                self.idle_contradictions.push(contradiction);
            }
            let other = difference_from(exact, &second);
            if other > apart {
                (measured, apart) = (second, other);
            }
        }
        judged.symptoms.digits.see(&measured);
        let (error, worst) = if loaded {
            judged.difference = judged.difference.max(apart);
            judged.symptoms.see(exact, &measured);
            (relative(apart, exact.force.abs()), &mut judged.worst)
        } else {
            (apart, &mut self.worst_idle)
        };
        if worst.as_ref().is_none_or(|worst| worst.error < error) {
            *worst = Some(Difference {
                error,
                measured: Some(measured),
                ..difference()
            });
        }
        if loaded {
            return Some(error);
        }
        self.idle.push(error);
        None
    }

    /// Finishes the comparison after the last contact, and judges the pairs without a contact. Each pair has the
    /// difference between its two rows.
    pub(super) fn close(
        self,
        errors: Vec<f64>,
        pairs: &[(Measured, f64)],
        numbering: &Numbering<'_>,
    ) -> Judged {
        let mut judged = self.judged;
        judged.errors = errors;
        let largest = judged.largest_force;
        let idle = self.idle.into_iter();
        judged
            .errors
            .extend(idle.map(|error| relative(error, largest)));
        sort_decreasing(&mut judged.errors);
        let worst_idle = self.worst_idle.map(|worst| Difference {
            error: relative(worst.error, largest),
            ..worst
        });
        judged.worst = match (judged.worst, worst_idle) {
            (Some(a), Some(b)) => Some(if b.error > a.error { b } else { a }),
            (a, b) => a.or(b),
        };
        let first_fixed = numbering.first_on_floor();
        let is_fixed =
            |stray: &Measured| !self.is_rough && stray.ids.iter().all(|id| *id >= first_fixed);
        let mut strays = Vec::new();
        let mut contradictions = self.idle_contradictions;
        for (stray, contradiction) in pairs {
            if is_fixed(stray) {
                judged.fixed += 1;
            } else if !stray.is_zero() {
                strays.push((relative(stray.magnitude(), largest), stray));
                contradictions.extend(Some(*contradiction).filter(|apart| *apart > 0.0));
            }
        }
        let contradictions = contradictions.into_iter();
        let contradictions = contradictions.map(|apart| relative(apart, largest));
        judged.contradictions.extend(contradictions);
        sort_decreasing(&mut judged.contradictions);
        // Decreasing forces. Among equals, the pair with the smaller numbers comes first.
        strays.sort_by(|(a, one), (b, other)| b.total_cmp(a).then(one.ids.cmp(&other.ids)));
        let kept = strays.iter().take(KEPT);
        let greatest_strays = kept.filter_map(|(error, stray)| {
            let [one, other] = stray.ids.each(|id| numbering.site(id));
            Some(Extra {
                ids: stray.ids,
                sites: [one?, other?],
                force: stray.magnitude(),
                error: *error,
                dimension: self.dimension,
            })
        });
        judged.greatest_strays = greatest_strays.collect();
        judged.strays = strays.into_iter().map(|(error, _)| error).collect();
        judged
    }
}

impl Judged {
    /// Adds the result for the floor.
    pub(super) fn add_floor(&mut self, floor: OnFloor) {
        self.floor = floor.judged;
        self.floor_errors = floor.errors;
        self.contradictions.extend(floor.contradictions);
        sort_decreasing(&mut self.contradictions);
    }

    /// Returns the spheres above the bottom layer whose force on the floor is not noise.
    pub(super) fn fallen(&self, tolerance: f64) -> impl Iterator<Item = u64> {
        let over = self
            .fallen
            .iter()
            .filter(move |(_, force)| *force > tolerance);
        over.map(|(id, _)| *id)
    }

    pub(super) fn matched(&self) -> u64 {
        self.errors.len() as u64
    }

    /// Returns the root mean square of the errors.
    #[expect(clippy::cast_precision_loss, reason = "a count below 2^53")]
    pub(super) fn rms_error(&self) -> Option<f64> {
        // Errors are divided by the greatest one, so that no square overflows.
        let greatest = *self.errors.first()?;
        if greatest == 0.0 || greatest.is_infinite() {
            return Some(greatest);
        }
        let squares = self.errors.iter().map(|x| (x / greatest) * (x / greatest));
        Some(greatest * (squares.sum::<f64>() / self.errors.len() as f64).sqrt())
    }
}

/// Returns the absolute error of a measured force. If nothing was measured but 0, it is the exact force.
fn difference_from(exact: &NumberedContact, measured: &Measured) -> f64 {
    let along = (measured.force - exact.force).abs();
    match measured.vector {
        Some(vector) if !measured.is_zero() => along.max(distance(vector, exact.vector)),
        _ => along,
    }
}
