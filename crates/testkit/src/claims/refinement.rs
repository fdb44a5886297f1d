//! A refinement study recovers a given order of accuracy, for any constant and any steps.

use arbitrary::Unstructured;
use cannonpile_dem::table::FileFormat;
use cannonpile_dem::verify::{
    Level, NoRefinement, Norm, Refinement, RefinementReport, RefinementStudy,
};

use super::{Checked, Failure, demand, same};

impl From<NoRefinement> for Failure {
    fn from(refusal: NoRefinement) -> Self {
        Self::Refuted(format!("refused: {refusal}"))
    }
}

/// A number from 0 to 1.
fn part(u: &mut Unstructured<'_>) -> arbitrary::Result<f64> {
    Ok(f64::from(u.arbitrary::<u16>()?) / f64::from(u16::MAX))
}

/// A level of 30 contacts, all of them measured.
fn level(parameter: f64, largest_error: f64, rms_error: f64) -> Level {
    Level {
        parameter,
        contacts: 30,
        matched: 30,
        largest_error,
        rms_error,
        ..Level::default()
    }
}

fn refinement(u: &mut Unstructured<'_>) -> arbitrary::Result<Refinement> {
    Ok(*u.choose(&[Refinement::Stiffness, Refinement::TimeStep])?)
}

/// Errors C hᵖ at irregular steps.
pub fn given_order(u: &mut Unstructured<'_>) -> Checked {
    let refinement = refinement(u)?;
    let order = 0.6 + 3.4 * part(u)?;
    let constant = 10_f64.powf(20.0 * part(u)? - 10.0);
    let mut h = 10_f64.powf(20.0 * part(u)? - 10.0);
    let mut levels = Vec::new();
    for _ in 0..u.int_in_range(3..=9)? {
        let error = constant * h.powf(order);
        // A stiffness k corresponds to h = 1/k, so k = 1/h.
        let parameter = match refinement {
            Refinement::Stiffness => 1.0 / h,
            Refinement::TimeStep => h,
        };
        levels.push(level(parameter, error, 0.25 * error));
        h /= 1.5 + 8.5 * part(u)?;
    }
    let study = RefinementStudy::new(refinement, levels.iter().copied())?;
    let other_way = RefinementStudy::new(refinement, levels.iter().rev().copied())?;
    same("the study in reverse", &other_way, &study)?;
    found(&study, order)
}

/// All levels lie on a line of this order.
fn found(study: &RefinementStudy, order: f64) -> Checked {
    for norm in Norm::ALL {
        let fit = study
            .fit(norm)
            .map_err(|error| Failure::Refuted(error.to_string()))?;
        let sure = fit.standard_error.is_none_or(|error| error < 1e-9);
        let near = (fit.order - order).abs() < 1e-9 && sure;
        let whole = fit.levels == study.levels().len();
        demand(near && whole, || {
            format!("{fit:?}, not {order}, of {study:?}")
        })?;
        let between = study.orders(norm);
        let near = between
            .iter()
            .skip(1)
            .all(|found| found.is_some_and(|found| (found - order).abs() < 1e-8));
        demand(near, || format!("{between:?}, not {order}"))?;
    }
    Ok(())
}

/// Random values form a refinement study or are rejected in one line. Every result of a study is finite.
pub fn any_levels(u: &mut Unstructured<'_>) -> Checked {
    let refinement = refinement(u)?;
    let count = u.int_in_range(0..=8)?;
    let mut levels = Vec::new();
    for _ in 0..count {
        let mut level = level(f64::from_bits(u.arbitrary()?), 0.0, 0.0);
        let sizes = [
            f64::from_bits(u.arbitrary()?),
            f64::from_bits(u.arbitrary()?),
        ];
        [level.largest_error, level.rms_error] = sizes;
        if u.arbitrary()? {
            // Most bit patterns do not form a study.
            level.parameter = 2_f64.powi(u.int_in_range(-40..=40)?);
            level.largest_error = part(u)?;
            level.rms_error = level.largest_error / 2.0;
        }
        level.missing = u.int_in_range(0..=3)? / 3;
        levels.push(level);
    }
    match RefinementStudy::new(refinement, levels) {
        Ok(study) => is_reported(&study),
        Err(error) => one_line(&error.to_string()),
    }
}

fn is_reported(study: &RefinementStudy) -> Checked {
    for norm in Norm::ALL {
        for order in study.orders(norm).into_iter().flatten() {
            demand(order.is_finite(), || format!("{order} of {study:?}"))?;
        }
        let fit = study.fit(norm);
        if let Ok(fit) = fit {
            let finite = fit.order.is_finite();
            let sure = fit.standard_error.is_none_or(f64::is_finite);
            demand(finite && sure && !fit.constant.is_nan(), || {
                format!("{fit:?} of {study:?}")
            })?;
        }
    }
    for format in [FileFormat::Text, FileFormat::Csv, FileFormat::Json] {
        let written = RefinementReport::new(study).write(format, &mut Vec::new());
        written.map_err(|error| Failure::Refuted(error.to_string()))?;
    }
    Ok(())
}

fn one_line(message: &str) -> Checked {
    let printable = !message.is_empty() && !message.contains(char::is_control);
    demand(printable, || format!("not one line: {message:?}"))
}

#[cfg(test)]
mod injected_faults {
    use super::*;

    #[test]
    fn a_wrong_order_is_caught() {
        let study = |refinement, errors: [f64; 4]| {
            let levels = [1.0, 2.0, 4.0, 8.0].into_iter().zip(errors);
            let levels = levels.map(|(of, error)| level(of, error, error));
            RefinementStudy::new(refinement, levels).unwrap()
        };
        let squares = [1.0, 4.0, 16.0, 64.0];
        assert!(found(&study(Refinement::TimeStep, squares), 2.0).is_ok());
        assert!(found(&study(Refinement::TimeStep, squares), 2.001).is_err());
        // A stiffness in place of a time step.
        assert!(found(&study(Refinement::Stiffness, squares), 2.0).is_err());
        // An error that stops decreasing, and one off the line.
        assert!(found(&study(Refinement::TimeStep, [4.0, 4.0, 16.0, 64.0]), 2.0).is_err());
        assert!(found(&study(Refinement::TimeStep, [1.0, 4.001, 16.0, 64.0]), 2.0).is_err());
    }
}
