//! What measured and exact forces show together, contact by contact.

use std::collections::BTreeMap;

use super::axes::Axes;
use super::finding::Finding;
use super::measured::{Measured, distance, norm};
use crate::NumberedContact;
use cannonpile::lattice::ContactKind;

/// How far off a turn of the axes may be and still be followed.
const FOLLOWED: f64 = 0.25;

/// What rounding may leave of a force along the surfaces, as a share of it.
const ROUNDED: f64 = 1e-14;

/// What the contacts with a force have shown so far.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Symptoms {
    /// The least and the greatest ratio of a measured to an exact force, and how many there are.
    ratios: Option<([f64; 2], u64)>,
    /// How many have vectors.
    vectors: u64,
    /// The axes in which the vectors may be right, with the greatest error in each.
    axes: Vec<(Axes, f64)>,
    /// The greatest share of a force along the surfaces.
    tangential: f64,
    /// For each layer how many contacts with a force it has with the one below, and how many of them are missing.
    layers: BTreeMap<i128, [u64; 2]>,
}

impl Default for Symptoms {
    fn default() -> Self {
        Self {
            ratios: None,
            vectors: 0,
            axes: Axes::all().map(|axes| (axes, 0.0)).collect(),
            tangential: 0.0,
            layers: BTreeMap::new(),
        }
    }
}

impl Symptoms {
    /// A contact with a force was not measured.
    pub(super) fn miss(&mut self, exact: &NumberedContact) {
        self.count(exact, 1);
    }

    /// A contact with a force was measured.
    pub(super) fn see(&mut self, exact: &NumberedContact, measured: &Measured) {
        self.count(exact, 0);
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
        let normal = exact.vector.map(|component| component / magnitude);
        let along: f64 = vector.iter().zip(normal).map(|(f, n)| f * n).sum();
        let across = [0, 1, 2].map(|axis: usize| match (vector.get(axis), normal.get(axis)) {
            (Some(f), Some(n)) => f - along * n,
            _ => 0.0,
        });
        self.tangential = self.tangential.max(norm(across) / magnitude);
    }

    /// Counts a contact with a force of a layer and the one below, with how many of it are missing: 0 or 1.
    fn count(&mut self, exact: &NumberedContact, missing: u64) {
        if let ContactKind::Sloping(_) = exact.direction {
            let [there, lost] = self.layers.entry(exact.site.k).or_default();
            *there += 1;
            *lost += missing;
        }
    }

    /// The one factor of all measured forces, if there is one other than 1.
    pub(super) fn factor(&self, tolerance: f64) -> Option<f64> {
        let ([least, greatest], count) = self.ratios?;
        let factor = least + (greatest - least) / 2.0;
        let alike = factor.is_finite() && (greatest - least) / 2.0 <= tolerance * factor.abs();
        let is_other = (factor - 1.0).abs() > tolerance;
        (count > 1 && alike && is_other).then_some(factor)
    }

    /// All that can be told at an accepted error.
    pub(super) fn findings(&self, tolerance: f64) -> Vec<Finding> {
        let factor = self.factor(tolerance);
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
        let lowest = self.layers.keys().next_back();
        let missing = self.layers.iter().filter_map(|(k, [there, missing])| {
            (missing == there).then_some(Finding::Layer {
                k: *k,
                contacts: *there,
                is_lowest: Some(k) == lowest,
            })
        });
        // A list with nothing in it has not lost a layer.
        let has_some = self.ratios.is_some();
        factor
            .map(Finding::Factor)
            .into_iter()
            .chain(turned)
            .chain(tangential)
            .chain(missing.filter(|_| has_some))
            .collect()
    }

    /// The axes in which all vectors are right, if they are not so as they are.
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
