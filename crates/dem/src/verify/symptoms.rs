//! Patterns in measured and exact forces, collected contact by contact.

use super::axes::Axes;
use super::finding::Finding;
use super::measured::{Measured, distance, norm};
use crate::{Each, NumberedContact};
use cannonpile::lattice::ContactKind;

/// The error above which a permutation of the axes is discarded.
const FOLLOWED: f64 = 0.25;

/// The rounding error of a tangential force, relative to the exact force.
const ROUNDED: f64 = 1e-14;

/// The patterns in the contacts with a force so far.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Symptoms {
    /// The smallest and the greatest ratio of a measured to an exact force, and the number of ratios. Contacts that were
    /// measured as 0 are left out, here and below.
    ratios: Option<([f64; 2], u64)>,
    /// The number of contacts that were measured as 0.
    zeros: u64,
    /// The number of measured vectors.
    vectors: u64,
    /// The differences between a force and its vector that no rotation and no friction explains, relative to the exact
    /// force.
    disagreements: Vec<f64>,
    /// The greatest errors of the forces that have a vector, and of the vectors.
    separate_errors: [f64; 2],
    /// The permutations of the axes that may explain the vectors, each with its greatest error.
    axes: Vec<(Axes, f64)>,
    /// The greatest tangential force, relative to the exact force.
    tangential: f64,
    /// For each layer from the top, the number of contacts with a force to the next layer, and the number of these that are missing.
    layers: Vec<(i128, [u64; 2])>,
}

impl Default for Symptoms {
    fn default() -> Self {
        Self {
            ratios: None,
            zeros: 0,
            vectors: 0,
            disagreements: Vec::new(),
            separate_errors: [0.0; 2],
            axes: Axes::all().map(|axes| (axes, 0.0)).collect(),
            tangential: 0.0,
            layers: Vec::new(),
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
        let ratio = measured.force / exact.force;
        let ([least, greatest], count) = self.ratios.unwrap_or(([ratio; 2], 0));
        self.ratios = Some(([least.min(ratio), greatest.max(ratio)], count + 1));
        let Some(vector) = measured.vector else {
            return;
        };
        self.vectors += 1;
        let magnitude = exact.force.abs();
        self.axes.retain_mut(|(axes, greatest)| {
            let apart = distance(axes.turned(vector), exact.vector);
            *greatest = greatest.max(apart / magnitude);
            *greatest < FOLLOWED
        });
        let normal = exact.vector.each(|component| component / magnitude);
        let along: f64 = vector.iter().zip(normal).map(|(f, n)| f * n).sum();
        let across = [0, 1, 2].each(|axis: usize| match (vector.get(axis), normal.get(axis)) {
            (Some(f), Some(n)) => f - along * n,
            _ => 0.0,
        });
        self.tangential = self.tangential.max(norm(across) / magnitude);
        // The force may be the length of the vector, or its normal part.
        let lengths = (norm(vector) - measured.force.abs()).abs();
        let disagreement = lengths.min((along * exact.force.signum() - measured.force).abs());
        if disagreement > ROUNDED * magnitude {
            self.disagreements.push(disagreement / magnitude);
        }
        let errors = [
            (measured.force - exact.force).abs(),
            distance(vector, exact.vector),
        ];
        for (greatest, error) in self.separate_errors.iter_mut().zip(errors) {
            *greatest = greatest.max(error / magnitude);
        }
    }

    /// Counts a contact with a force between a layer and the next one. The number of missing contacts increases by
    /// `missing`: 0 or 1.
    fn count(&mut self, exact: &NumberedContact, missing: u64) {
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

    /// Returns the common factor of all measured forces other than 0, if it differs from 1.
    pub(super) fn factor(&self, tolerance: f64) -> Option<f64> {
        let ([least, greatest], count) = self.ratios?;
        let factor = least + (greatest - least) / 2.0;
        let alike = factor.is_finite() && (greatest - least) / 2.0 <= tolerance * factor.abs();
        let is_other = (factor - 1.0).abs() > tolerance;
        (count > 1 && alike && is_other).then_some(factor)
    }

    /// Returns all explanations at an accepted error.
    pub(super) fn findings(&self, tolerance: f64) -> Vec<Finding> {
        let zero = (self.zeros > 0).then_some(Finding::Zero {
            contacts: self.zeros,
            are_all: self.ratios.is_none(),
        });
        let disagreement = self.disagreement(tolerance);
        let factor = self.factor(tolerance).filter(|_| disagreement.is_none());
        let turned = self.turned(tolerance);
        let turned = turned.map(|axes| {
            if axes == Axes::OWN.reversed() {
                Finding::SecondSphere
            } else {
                Finding::Axes(axes)
            }
        });
        let is_straight = factor.is_none() && turned.is_none();
        let tangential = self.tangential > tolerance.max(ROUNDED) && is_straight;
        let tangential = tangential.then_some(Finding::Tangential(self.tangential));
        let lowest = self.layers.last().map(|(k, _)| k);
        let missing = self.layers.iter().filter_map(|(k, [there, missing])| {
            (missing == there).then_some(Finding::Layer {
                k: *k,
                contacts: *there,
                is_lowest: Some(k) == lowest,
            })
        });
        // An empty list does not count as a missing layer.
        let has_some = self.ratios.is_some() || self.zeros > 0;
        zero.into_iter()
            .chain(disagreement)
            .chain(factor.map(Finding::Factor))
            .chain(turned)
            .chain(tangential)
            .chain(missing.filter(|_| has_some))
            .collect()
    }

    /// Returns the contacts whose force and vector disagree.
    fn disagreement(&self, tolerance: f64) -> Option<Finding> {
        let disagree = |apart: &&f64| **apart > tolerance;
        let contacts = self.disagreements.iter().filter(disagree).count() as u64;
        let [forces, vectors] = self.separate_errors.each(|error| error <= tolerance);
        (contacts > 0).then_some(Finding::Disagreement {
            contacts,
            forces_are_exact: forces,
            vectors_are_exact: vectors,
        })
    }

    /// Returns the axes in which all vectors agree, if they disagree in the axes of the scene.
    fn turned(&self, tolerance: f64) -> Option<Axes> {
        let right = |axes: &&(Axes, f64)| axes.1 <= tolerance;
        let own = self.axes.iter().find(|(axes, _)| *axes == Axes::OWN);
        if self.vectors < 3 || own.as_ref().is_some_and(right) {
            return None;
        }
        let best = self.axes.iter().filter(right);
        let (axes, _) = best.min_by(|(_, one), (_, other)| one.total_cmp(other))?;
        Some(*axes)
    }
}
