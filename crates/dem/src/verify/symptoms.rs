//! Patterns in measured and exact forces, collected contact by contact.

use super::axes::Axes;
use super::digits::Digits;
use super::finding::{Finding, FindingKind, counted};
use super::measured::{Measured, distance, norm};
use crate::vector::minus;
use crate::{Each, NumberedContact};
use cannonpile::lattice::ContactKind;

/// The error above which a permutation of the axes is discarded.
const FOLLOWED: f64 = 0.25;

/// The rounding error of a tangential force, relative to the exact force.
const ROUNDED: f64 = 1e-14;

/// What is left of an error that a finding explains, as a share of it.
pub(super) const LEFT: f64 = 0.1;

/// The patterns in the contacts with a force so far.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Symptoms {
    /// The ratios of measured to exact forces: of the magnitudes, of the vertical parts of vectors, and of their horizontal
    /// parts. Contacts that were measured as 0 are left out, here and below.
    ratios: [Range; 3],
    /// The largest part of a horizontal force across the exact one, relative to the exact force.
    aside: f64,
    /// The number of contacts that were measured as 0.
    zeros: u64,
    /// The number of measured vectors.
    vectors: u64,
    /// The number of vectors that are exact less their tangential forces, and only so.
    whole: u64,
    /// The differences between a force and its vector that no rotation and no friction explains, relative to the exact
    /// force.
    disagreements: Vec<f64>,
    /// The greatest errors of the forces that have a vector, and of the vectors.
    separate_errors: [f64; 2],
    /// The permutations of the axes that may explain the vectors, each with its greatest error.
    axes: Vec<(Axes, f64)>,
    /// The greatest tangential force, relative to the exact force.
    pub(super) tangential: f64,
    /// For each layer from the top, the number of contacts with a force to the next layer, and the number of these that are missing.
    layers: Vec<(i128, [u64; 2])>,
    /// The numbers of contacts that need tension, of missing contacts, and of those that are both.
    tensile: [u64; 3],
    pub(super) digits: Digits,
}

/// A range of ratios.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Range {
    bounds: Option<[f64; 2]>,
    count: u64,
}

impl Range {
    fn add(&mut self, ratio: f64) {
        let [least, greatest] = self.bounds.unwrap_or([ratio; 2]);
        self.bounds = Some([least.min(ratio), greatest.max(ratio)]);
        self.count += 1;
    }

    /// Returns the middle of several ratios and half of their range, relative to the middle.
    fn middle(&self) -> Option<[f64; 2]> {
        let [least, greatest] = self.bounds.filter(|_| self.count > 1)?;
        let half = (greatest - least) / 2.0;
        Some([least + half, half / (least + half).abs()]).filter(|[middle, _]| middle.is_finite())
    }
}

impl Default for Symptoms {
    fn default() -> Self {
        Self {
            ratios: [Range::default(); 3],
            aside: 0.0,
            zeros: 0,
            vectors: 0,
            whole: 0,
            disagreements: Vec::new(),
            separate_errors: [0.0; 2],
            axes: Axes::all().map(|axes| (axes, 0.0)).collect(),
            tangential: 0.0,
            layers: Vec::new(),
            tensile: [0; 3],
            digits: Digits::default(),
        }
    }
}

impl Symptoms {
    /// Adds a contact with a force that was not measured.
    pub(super) fn miss(&mut self, exact: &NumberedContact) {
        self.count(exact, 1);
    }

    /// Adds a contact with a force that was measured.
    pub(super) fn see(&mut self, exact: &NumberedContact, measured: &Measured) {
        self.count(exact, 0);
        if measured.is_zero() {
            self.zeros += 1;
            return;
        }
        let [magnitudes, vertical, horizontal] = &mut self.ratios;
        magnitudes.add(measured.force / exact.force);
        let Some(vector) = measured.vector else {
            return;
        };
        self.vectors += 1;
        let magnitude = exact.force.abs();
        let ([x, y, z], [u, v, w]) = (vector, exact.vector);
        if w != 0.0 {
            vertical.add(z / w);
        }
        let square = u * u + v * v;
        if square > 0.0 {
            horizontal.add((x * u + y * v) / square);
            let aside = (x * v - y * u).abs() / square.sqrt();
            self.aside = self.aside.max(aside / magnitude);
        }
        self.axes.retain_mut(|(axes, greatest)| {
            let apart = distance(axes.turned(vector), exact.vector);
            *greatest = greatest.max(apart / magnitude);
            *greatest < FOLLOWED
        });
        let apart = distance(vector, exact.vector);
        if let Some(tangential) = measured.tangential {
            let less = distance(minus(vector, tangential), exact.vector);
            self.whole += u64::from(less < LEFT * apart);
        }
        let normal = exact.vector.each(|component| component / magnitude);
        let along: f64 = vector.iter().zip(normal).map(|(f, n)| f * n).sum();
        let across = distance(vector, normal.each(|n| along * n));
        self.tangential = self.tangential.max(across / magnitude);
        // The force may be the length of the vector, or its normal part.
        let lengths = (norm(vector) - measured.force.abs()).abs();
        let disagreement = lengths.min((along * exact.force.signum() - measured.force).abs());
        if disagreement > ROUNDED * magnitude {
            self.disagreements.push(disagreement / magnitude);
        }
        let errors = [(measured.force - exact.force).abs(), apart];
        for (greatest, error) in self.separate_errors.iter_mut().zip(errors) {
            *greatest = greatest.max(error / magnitude);
        }
    }

    /// Counts a contact with a force between a layer and the next one. The number of missing contacts increases by
    /// `missing`: 0 or 1.
    fn count(&mut self, exact: &NumberedContact, missing: u64) {
        let tensile = u64::from(exact.force < 0.0);
        for (count, more) in self
            .tensile
            .iter_mut()
            .zip([tensile, missing, tensile * missing])
        {
            *count += more;
        }
        if let ContactKind::Sloping(_) = exact.direction {
            match self.layers.last_mut() {
                Some((k, [there, lost])) if *k == exact.site.k => {
                    *there += 1;
                    *lost += missing;
                }
                _ => self.layers.push((exact.site.k, [1, missing])),
            }
        }
    }

    /// Returns the factor that takes away most of the error of all measured forces, and the error that is left. With vectors,
    /// it is that of their vertical parts.
    pub(super) fn factor(&self, tolerance: f64) -> Option<(f64, f64)> {
        let [magnitudes, vertical, _] = &self.ratios;
        let of_vectors = self.vectors == magnitudes.count && vertical.count > 0;
        let [factor, left] = if of_vectors { vertical } else { magnitudes }.middle()?;
        let error = (factor - 1.0).abs();
        (error > tolerance && left <= tolerance.max(LEFT * error)).then_some((factor, left))
    }

    /// Returns the ratio of the tangents of the angles of the contacts, if it is the same for all and differs from 1.
    pub(super) fn slope(&self, tolerance: f64) -> Option<f64> {
        let [_, vertical, horizontal] = &self.ratios;
        let ([up, left], [across, more]) = (vertical.middle()?, horizontal.middle()?);
        let (slope, left) = (across / up, left.max(more).max(self.aside));
        ((slope - 1.0).abs() > tolerance.max(left / LEFT)).then_some(slope)
    }

    /// Returns whether tangential parts exceed the errors of the normal forces.
    pub(super) fn is_rubbed(&self, tolerance: f64) -> bool {
        self.tangential > self.separate_errors[0].max(tolerance)
    }

    /// Returns the explanations that do not depend on the values of the forces, at an accepted error.
    pub(super) fn findings(&self, tolerance: f64) -> Vec<Finding> {
        let mut findings = Vec::new();
        let mut find = |is_there: bool, kind, text: String| {
            findings.extend(is_there.then(|| Finding::new(kind, text)));
        };
        // An empty list does not count as a missing layer.
        let (zeros, has_some) = (self.zeros, self.ratios[0].count > 0);
        let all = format!(
            "all measured forces are 0, at {zeros} of the contacts with a force: does the simulation store its forces?"
        );
        find(zeros > 0 && !has_some, FindingKind::AllZero, all);
        let some = format!("a force of 0 was measured at {zeros} of the contacts with a force");
        find(zeros > 0 && has_some, FindingKind::Zero, some);
        let disagree = |apart: &&f64| **apart > tolerance;
        let contacts = self.disagreements.iter().filter(disagree).count();
        let which = match self.separate_errors.each(|error| error <= tolerance) {
            [true, _] => "all forces are the exact ones",
            [_, true] => "all vectors are the exact ones",
            _ => "neither are the exact ones at all contacts",
        };
        let text = format!("force and vector disagree at {contacts} of the contacts: {which}");
        find(contacts > 0, FindingKind::Disagreement, text);
        let text = "fx, fy, fz are the whole forces: less tx, ty, tz they are the exact normal ones; use --columns fx=fx-tx,fy=fy-ty,fz=fz-tz";
        find(
            2 * self.whole > self.vectors,
            FindingKind::Whole,
            text.into(),
        );
        if let Some(axes) = self.turned(tolerance) {
            let is_second = axes == Axes::OWN.reversed();
            let text = "all vectors are the forces on the second sphere of each pair: reverse the vectors, or swap the two spheres";
            find(is_second, FindingKind::SecondSphere, text.into());
            find(!is_second, FindingKind::Axes, axes.to_string());
        }
        let lowest = self.layers.last().map(|(k, _)| k);
        for (k, [there, missing]) in &self.layers {
            let fixed = if Some(k) == lowest {
                ": are forces on fixed spheres left out?"
            } else {
                ""
            };
            let text = format!(
                "all {there} contacts of layer {k} with layer {} are missing{fixed}",
                k + 1
            );
            find(
                there == missing && (has_some || zeros > 0),
                FindingKind::Layer,
                text,
            );
        }
        let [tensile, missing, both] = self.tensile;
        let open = if [missing, both] == [tensile; 2] {
            ", and just these are open"
        } else {
            ""
        };
        let contacts = counted(tensile, "contact");
        let text = format!("the pile cannot stand: {contacts} would need tension{open}");
        find(both > 0, FindingKind::Unstable, text);
        findings
    }

    /// Returns the axes that take away most of the error of all vectors.
    fn turned(&self, tolerance: f64) -> Option<Axes> {
        let [_, error] = self.separate_errors;
        let right = |axes: &&(Axes, f64)| axes.1 <= tolerance.max(LEFT * error);
        let best = self.axes.iter().filter(right);
        let (axes, _) = best.min_by(|(_, one), (_, other)| one.total_cmp(other))?;
        (self.vectors > 2 && error > tolerance && *axes != Axes::OWN).then_some(*axes)
    }
}
