//! A refinement study recovers a given order of accuracy, for any constant and any steps. Every study survives a round trip
//! through its record.

use arbitrary::Unstructured;
use cannonpile_dem::table::FileFormat;
use cannonpile_dem::verify::{Ladder, LadderFiles, LadderReport, NoLadder, Norm, Refinement, Rung};

use super::{Checked, Failure, demand, same};
use crate::generators::text;

impl From<NoLadder> for Failure {
    fn from(refusal: NoLadder) -> Self {
        Self::Refuted(format!("refused: {refusal}"))
    }
}

/// A number from 0 to 1.
fn part(u: &mut Unstructured<'_>) -> arbitrary::Result<f64> {
    Ok(f64::from(u.arbitrary::<u16>()?) / f64::from(u16::MAX))
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
    let mut rungs = Vec::new();
    for _ in 0..u.int_in_range(3..=9)? {
        let error = constant * h.powf(order);
        // A stiffness k corresponds to h = 1/k, so k = 1/h.
        let parameter = refinement.h(h);
        rungs.push(Rung::of_errors(parameter, 30, error, 0.25 * error));
        h /= 1.5 + 8.5 * part(u)?;
    }
    let ladder = Ladder::new(refinement, rungs.iter().copied())?;
    let other_way = Ladder::new(refinement, rungs.iter().rev().copied())?;
    same("the study in reverse", &other_way, &ladder)?;
    found(&ladder, order)?;
    for norm in Norm::ALL {
        let limit = ladder.limit(norm, order);
        let limit = limit.map_err(|error| Failure::Refuted(error.to_string()))?;
        let least = ladder.rungs().iter().map(|rung| rung.error(norm));
        let least = least.fold(f64::INFINITY, f64::min);
        demand(limit.error.abs() < 1e-6 * least, || {
            format!("{limit:?} of {ladder:?}")
        })?;
    }
    Ok(())
}

/// All levels lie on a line of this order.
fn found(ladder: &Ladder, order: f64) -> Checked {
    for norm in Norm::ALL {
        let fit = ladder
            .fit(norm)
            .map_err(|error| Failure::Refuted(error.to_string()))?;
        let near = (fit.order - order).abs() < 1e-9 && fit.residual < 1e-9;
        let whole = fit.rungs == ladder.rungs().len();
        demand(near && whole, || {
            format!("{fit:?}, not {order}, of {ladder:?}")
        })?;
        let between = ladder.orders(norm);
        let near = between
            .iter()
            .skip(1)
            .all(|found| found.is_some_and(|found| (found - order).abs() < 1e-8));
        demand(near, || format!("{between:?}, not {order}"))?;
    }
    Ok(())
}

/// Random values form a refinement study or are rejected in one line. Every result of a study is finite, and its record is
/// read back.
pub fn any_rungs(u: &mut Unstructured<'_>) -> Checked {
    let refinement = refinement(u)?;
    let count = u.int_in_range(0..=8)?;
    let mut rungs = Vec::new();
    for _ in 0..count {
        let mut rung = Rung::of_errors(f64::from_bits(u.arbitrary()?), 30, 0.0, 0.0);
        let sizes = [
            f64::from_bits(u.arbitrary()?),
            f64::from_bits(u.arbitrary()?),
        ];
        [rung.largest_error, rung.rms_error] = sizes;
        if u.arbitrary()? {
            // Most bit patterns do not form a study.
            rung.parameter = 2_f64.powi(u.int_in_range(-40..=40)?);
            rung.largest_error = part(u)?;
            rung.rms_error = rung.largest_error / 2.0;
        }
        rung.missing = u.int_in_range(0..=3)? / 3;
        rungs.push(rung);
    }
    match Ladder::new(refinement, rungs) {
        Ok(ladder) => round_trips(&ladder),
        Err(error) => one_line(&error.to_string()),
    }
}

fn round_trips(ladder: &Ladder) -> Checked {
    for norm in Norm::ALL {
        for order in ladder.orders(norm).into_iter().flatten() {
            demand(order.is_finite(), || format!("{order} of {ladder:?}"))?;
        }
        let fit = ladder.fit(norm);
        if let Ok(fit) = fit {
            let finite = fit.order.is_finite() && fit.residual.is_finite();
            let sure = fit.standard_error.is_none_or(f64::is_finite);
            demand(finite && sure && !fit.constant.is_nan(), || {
                format!("{fit:?} of {ladder:?}")
            })?;
        }
        match ladder.limit(norm, 1.0) {
            Ok(limit) => {
                let finite = limit.error.is_finite() && limit.standard_error >= 0.0;
                demand(finite && limit.rungs >= 3, || {
                    format!("{limit:?} of {ladder:?}")
                })?;
            }
            Err(error) => one_line(&error.to_string())?,
        }
    }
    for format in [FileFormat::Text, FileFormat::Csv] {
        written(ladder, format)?;
    }
    let json = written(ladder, FileFormat::Json)?;
    let read = Ladder::read(&*json).map_err(|error| Failure::Refuted(error.to_string()))?;
    same("the value read back", &read, ladder)
}

fn written(ladder: &Ladder, format: FileFormat) -> Result<Vec<u8>, Failure> {
    let mut out = Vec::new();
    let written = LadderReport::new(ladder).write(format, &mut out);
    written.map_err(|error| Failure::Refuted(error.to_string()))?;
    Ok(out)
}

fn one_line(message: &str) -> Checked {
    let printable = !message.is_empty() && !message.contains(char::is_control);
    demand(printable, || format!("not one line: {message:?}"))
}

/// A damaged record, or any text, is a study that survives a round trip, or is rejected. So is a list of files.
pub fn any_record(u: &mut Unstructured<'_>) -> Checked {
    let rungs = [1e3, 1e4, 1e5].map(|k| Rung::of_errors(k, 30, 5.0 / k, 2.0 / k));
    let whole = written(
        &Ladder::new(Refinement::Stiffness, rungs)?,
        FileFormat::Json,
    )?;
    let whole = String::from_utf8_lossy(&whole).into_owned();
    let record = if u.arbitrary()? {
        text::damaged(u, &whole)?
    } else {
        text::any(u)?
    };
    match Ladder::read(record.as_bytes()) {
        Ok(ladder) => round_trips(&ladder)?,
        Err(error) => one_line(&error.to_string())?,
    }
    let list = text::damaged(u, "1e5=soft.csv,1e6=stiff.csv")?;
    match list.parse::<LadderFiles>() {
        Ok(LadderFiles(files)) => {
            let again = files
                .iter()
                .map(|file| format!("{:e}={}", file.parameter, file.path.display()));
            let again = again.collect::<Vec<_>>().join(",");
            same("the list again", &again.parse(), &Ok(LadderFiles(files)))
        }
        Err(error) => one_line(&error.to_string()),
    }
}

#[cfg(test)]
mod injected_faults {
    use super::*;

    #[test]
    fn a_wrong_order_is_caught() {
        let ladder = |refinement, errors: [f64; 4]| {
            let rungs = [1.0, 2.0, 4.0, 8.0].into_iter().zip(errors);
            let rungs = rungs.map(|(of, error)| Rung::of_errors(of, 30, error, error));
            Ladder::new(refinement, rungs).unwrap()
        };
        let squares = [1.0, 4.0, 16.0, 64.0];
        assert!(found(&ladder(Refinement::TimeStep, squares), 2.0).is_ok());
        assert!(found(&ladder(Refinement::TimeStep, squares), 2.001).is_err());
        // A stiffness in place of a time step.
        assert!(found(&ladder(Refinement::Stiffness, squares), 2.0).is_err());
        // An error that stops decreasing, and one off the line.
        assert!(found(&ladder(Refinement::TimeStep, [4.0, 4.0, 16.0, 64.0]), 2.0).is_err());
        assert!(found(&ladder(Refinement::TimeStep, [1.0, 4.001, 16.0, 64.0]), 2.0).is_err());
    }
}
