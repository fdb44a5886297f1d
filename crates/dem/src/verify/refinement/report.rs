//! A refinement study as tables and as json.

use crate::Each;
use std::io::Write;

use serde_json::{Value, json};

use super::{Fit, Level, Limit, NoOrder, Norm, Refinement, RefinementStudy};
use crate::table::{Cell, Column, FileFormat, NumberFormat, Table, WriteError};

/// The report of a refinement study.
///
/// The csv has one row for each level, from the coarsest: `stiffness` (or `timestep`), `contacts, matched, missing,
/// extra, largest_error, rms_error, order, predicted_error, place`. The column `order` is the observed order of the
/// largest errors of this level and the one before. The column `place` tells whether the level is
/// [above the floor](super::LevelPlace).
///
/// The text has the same rows. Two more rows follow, for the largest errors and for the root mean square errors:
/// `error, order, standard_error, constant, residual, extrapolated_error, extrapolated_standard_error, levels_used`. A
/// line gives the reason for each value that is not available.
///
/// The json is an array of one object with `refinement`, the array `levels`, and the objects `largest` and `rms`. Their
/// entries `no_order` and `no_limit` give the reason for a missing order or limit. An infinite number is `inf`, in json
/// `null`.
///
/// The extrapolation assumes order 1 for stiffnesses, as for linear springs. For time steps it uses the observed order.
///
/// # Examples
/// ```
/// use cannonpile_dem::table::FileFormat;
/// use cannonpile_dem::verify::{RefinementStudy, RefinementReport, Refinement, Level};
///
/// let levels = [1e4, 1e5, 1e6].map(|k| Level::of_errors(k, 30, 5.0 / k, 2.0 / k));
/// let study = RefinementStudy::new(Refinement::Stiffness, levels)?;
/// let mut csv = Vec::new();
/// RefinementReport::new(&study).write(FileFormat::Csv, &mut csv)?;
/// let csv = String::from_utf8(csv)?;
/// assert!(csv.starts_with("stiffness,contacts,matched,missing,extra,largest_error,"));
/// assert!(csv.lines().nth(1).unwrap().starts_with("10000.0,30,30,0,0,0.0005,0.0002,,,above"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct RefinementReport<'l>(&'l RefinementStudy);

impl<'l> RefinementReport<'l> {
    /// Returns the report of a refinement study.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::table::FileFormat;
    /// use cannonpile_dem::verify::{RefinementStudy, RefinementReport, Refinement, Level};
    ///
    /// let study = RefinementStudy::new(Refinement::TimeStep, [Level::of_errors(1e-3, 30, 0.1, 0.05)])?;
    /// let mut text = Vec::new();
    /// RefinementReport::new(&study).write(FileFormat::Text, &mut text)?;
    /// assert!(String::from_utf8(text)?.contains("no order of the largest errors: only 1 of the 2 levels needed"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub const fn new(study: &'l RefinementStudy) -> Self {
        Self(study)
    }

    /// Writes the report.
    ///
    /// # Errors
    /// [`WriteError::Io`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::table::FileFormat;
    /// use cannonpile_dem::verify::{RefinementStudy, RefinementReport, Refinement, Level};
    ///
    /// let levels = [1e4, 1e5, 1e6].map(|k| Level::of_errors(k, 30, 5.0 / k, 2.0 / k));
    /// let study = RefinementStudy::new(Refinement::Stiffness, levels)?;
    /// let mut json = Vec::new();
    /// RefinementReport::new(&study).write(FileFormat::Json, &mut json)?;
    /// let json: serde_json::Value = serde_json::from_slice(&json)?;
    /// assert_eq!(json[0]["largest"]["levels_used"], 3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn write(self, format: FileFormat, out: &mut dyn Write) -> Result<(), WriteError> {
        match format {
            FileFormat::Json => {
                serde_json::to_writer_pretty(&mut *out, &json!([self.json()]))?;
                Ok(writeln!(out)?)
            }
            FileFormat::Csv => self.levels().write(format, NumberFormat::F64, out),
            FileFormat::Text => {
                self.levels().write(format, NumberFormat::F64, out)?;
                writeln!(out)?;
                self.fits().write(format, NumberFormat::F64, out)?;
                for norm in Norm::ALL {
                    let Known { fit, limit } = self.known(norm);
                    let errors = of(norm);
                    if let Err(reason) = fit {
                        writeln!(out, "no order of {errors}: {reason}")?;
                    }
                    if let Some(Err(reason)) = limit {
                        writeln!(out, "no extrapolated error of {errors}: {reason}")?;
                    }
                }
                Ok(())
            }
        }
    }

    /// Returns the report as a json object, which can be kept in a larger record.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{RefinementStudy, RefinementReport, NoRefinement, Refinement, Level};
    ///
    /// let study = RefinementStudy::new(Refinement::TimeStep, [Level::of_errors(1e-3, 30, 0.1, 0.05)])?;
    /// let json = RefinementReport::new(&study).json();
    /// assert_eq!(json["refinement"], "timestep");
    /// assert_eq!(json["levels"][0]["largest_error"], 0.1);
    /// # Ok::<(), NoRefinement>(())
    /// ```
    #[must_use]
    pub fn json(self) -> Value {
        let refinement = self.0.refinement().name();
        let orders = self.0.orders(Norm::Largest);
        let places = self.0.places(Norm::Largest);
        let levels = self.0.levels().iter().zip(orders).zip(places);
        let levels = levels.map(|((level, order), place)| {
            json!({
                refinement: level.parameter,
                "contacts": level.contacts,
                "matched": level.matched,
                "missing": level.missing,
                "extra": level.extra,
                "largest_error": level.largest_error,
                "rms_error": level.rms_error,
                "order": order,
                "predicted_error": level.predicted_error,
                "place": place.name(),
            })
        });
        json!({
            "refinement": refinement,
            "levels": levels.collect::<Vec<_>>(),
            "largest": self.known(Norm::Largest).json(),
            "rms": self.known(Norm::Rms).json(),
        })
    }

    fn levels(self) -> Table<'static> {
        let measured = |name| Column::measured(name, "");
        let columns = vec![
            measured(self.0.refinement().name()),
            Column::plain("contacts"),
            Column::plain("matched"),
            Column::plain("missing"),
            Column::plain("extra"),
            measured("largest_error"),
            measured("rms_error"),
            measured("order"),
            measured("predicted_error"),
            Column::plain("place"),
        ];
        let orders = self.0.orders(Norm::Largest);
        let places = self.0.places(Norm::Largest);
        let row = |((level, order), place): ((&Level, Option<f64>), super::LevelPlace)| {
            let count = |count: u64| Cell::Integer(count.into());
            let has_errors = level.matched > 0;
            vec![
                Cell::F64(level.parameter),
                count(level.contacts),
                count(level.matched),
                count(level.missing),
                count(level.extra),
                number(has_errors.then_some(level.largest_error)),
                number(has_errors.then_some(level.rms_error)),
                number(order),
                number(level.predicted_error),
                place.name().into(),
            ]
        };
        let levels = self.0.levels().iter().zip(orders).zip(places);
        let rows: Vec<_> = levels.map(row).collect();
        Table::of_rows(columns, "levels", rows.into_iter().map(Ok))
    }

    fn fits(self) -> Table<'static> {
        let measured = |name| Column::measured(name, "");
        let columns = vec![
            Column::plain("error"),
            measured("order"),
            measured("standard_error"),
            measured("constant"),
            measured("residual"),
            measured("extrapolated_error"),
            measured("extrapolated_standard_error"),
            Column::plain("levels_used"),
        ];
        let rows = Norm::ALL.each(|norm| {
            let Known { fit, limit } = self.known(norm);
            let (fit, limit) = (fit.ok(), limit.and_then(Result::ok));
            let of_fit = |value: fn(&Fit) -> f64| number(fit.as_ref().map(value));
            let of_limit = |value: fn(&Limit) -> f64| number(limit.as_ref().map(value));
            Ok(vec![
                norm.name().into(),
                of_fit(|fit| fit.order),
                number(fit.as_ref().and_then(|fit| fit.standard_error)),
                of_fit(|fit| fit.constant),
                of_fit(|fit| fit.residual),
                of_limit(|limit| limit.error),
                of_limit(|limit| limit.standard_error),
                fit.map_or(Cell::Missing, |fit| Cell::Integer(fit.levels.into())),
            ])
        });
        Table::of_rows(columns, "orders", rows.into_iter())
    }

    fn known(self, norm: Norm) -> Known {
        let fit = self.0.fit(norm);
        let order = match self.0.refinement() {
            Refinement::Stiffness => Some(1.0),
            Refinement::TimeStep => fit.ok().map(|fit| fit.order),
        };
        Known {
            fit,
            limit: order.map(|order| self.0.limit(norm, order)),
        }
    }
}

/// The results for one norm. The limit is absent if time steps show no order.
struct Known {
    fit: Result<Fit, NoOrder>,
    limit: Option<Result<Limit, NoOrder>>,
}

impl Known {
    fn json(&self) -> Value {
        let fit = self.fit.as_ref().ok();
        let limit = self.limit.as_ref().and_then(|limit| limit.as_ref().ok());
        let no_limit = self.limit.as_ref().and_then(|limit| limit.as_ref().err());
        json!({
            "order": fit.map(|fit| fit.order),
            "standard_error": fit.and_then(|fit| fit.standard_error),
            "constant": fit.map(|fit| fit.constant),
            "residual": fit.map(|fit| fit.residual),
            "levels_used": fit.map(|fit| fit.levels),
            "no_order": self.fit.as_ref().err().map(ToString::to_string),
            "extrapolated_error": limit.map(|limit| limit.error),
            "extrapolated_standard_error": limit.map(|limit| limit.standard_error),
            "extrapolated_with_order": limit.map(|limit| limit.order),
            "extrapolated_levels": limit.map(|limit| limit.levels),
            "no_limit": no_limit.map(ToString::to_string),
        })
    }
}

fn of(norm: Norm) -> &'static str {
    match norm {
        Norm::Largest => "the largest errors",
        Norm::Rms => "the rms errors",
    }
}

fn number(value: Option<f64>) -> Cell {
    value.map_or(Cell::Missing, Cell::F64)
}
