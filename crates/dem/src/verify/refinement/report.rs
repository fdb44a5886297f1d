//! A refinement study as tables and as json.

use std::io::Write;

use serde_json::{Map, Value, json};

use super::{Norm, RefinementStudy};
use crate::table::{FileFormat, NumberFormat, WriteError};
use crate::verify::shown::{Entries, Shown, object, table};

/// The report of a refinement study.
///
/// The csv has one row for each level, from the coarsest: `stiffness` (or `timestep`), `contacts, matched, missing,
/// extra, largest_error, rms_error, order, predicted_error, place`. The column `order` is the observed order of the
/// largest errors of this level and the one before. The column `place` tells whether the level is
/// [above the floor](super::LevelPlace).
///
/// The text has the same rows. Two more rows follow, for the largest errors and for the root mean square errors:
/// `error, order, standard_error, constant, levels_used`. A line gives the reason for an order that is not available.
///
/// The json is an array of one object with `refinement`, the array `levels`, and the objects `largest` and `rms`. Their
/// entry `no_order` gives the reason for a missing order. An infinite number is `inf`, in json `null`.
///
/// # Examples
/// ```
/// use cannonpile_dem::table::FileFormat;
/// use cannonpile_dem::verify::{RefinementStudy, RefinementReport, Refinement, Level};
///
/// let levels = [1e4, 1e5, 1e6].map(|parameter| {
///     let (contacts, error) = (30, 5.0 / parameter);
///     Level { parameter, contacts, matched: contacts, largest_error: error, rms_error: error / 2.0, ..Level::default() }
/// });
/// let study = RefinementStudy::new(Refinement::Stiffness, levels)?;
/// let mut csv = Vec::new();
/// RefinementReport::new(&study).write(FileFormat::Csv, &mut csv)?;
/// let csv = String::from_utf8(csv)?;
/// assert!(csv.starts_with("stiffness,contacts,matched,missing,extra,largest_error,"));
/// assert!(csv.lines().nth(1).unwrap().starts_with("10000.0,30,30,0,0,0.0005,0.00025,,,above"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct RefinementReport<'l>(&'l RefinementStudy);

impl<'l> RefinementReport<'l> {
    /// Returns the report of a refinement study.
    #[must_use]
    pub const fn new(study: &'l RefinementStudy) -> Self {
        Self(study)
    }

    /// Writes the report.
    ///
    /// # Errors
    /// [`WriteError::Io`].
    pub fn write(self, format: FileFormat, out: &mut dyn Write) -> Result<(), WriteError> {
        let levels = || table("levels", self.levels());
        match format {
            FileFormat::Json => {
                serde_json::to_writer_pretty(&mut *out, &json!([self.json()]))?;
                return Ok(writeln!(out)?);
            }
            FileFormat::Csv => return levels().write(format, NumberFormat::F64, out),
            FileFormat::Text => levels().write(format, NumberFormat::F64, out)?,
        }
        writeln!(out)?;
        let fits = Norm::ALL.map(|norm| {
            let error = ("error", Shown::text(name(norm).to_owned()));
            [error].into_iter().chain(self.fit(norm)).collect()
        });
        table("orders", fits.into()).write(format, NumberFormat::F64, out)?;
        for norm in Norm::ALL {
            if let Err(reason) = self.0.fit(norm) {
                writeln!(out, "no order of the {} errors: {reason}", name(norm))?;
            }
        }
        Ok(())
    }

    /// Returns the report as a json object, which can be kept in a larger record.
    #[must_use]
    pub fn json(self) -> Map<String, Value> {
        let [largest, rms] = Norm::ALL.map(|norm| object(self.fit(norm)));
        let levels: Value = self.levels().into_iter().map(object).collect();
        let entries = [
            ("refinement", self.0.refinement.name().into()),
            ("levels", levels),
            ("largest", largest.into()),
            ("rms", rms.into()),
        ];
        entries
            .into_iter()
            .map(|(key, value)| (key.to_owned(), value))
            .collect()
    }

    fn levels(self) -> Vec<Entries> {
        let orders = self.0.orders(Norm::Largest);
        let places = self.0.places(Norm::Largest);
        let levels = self.0.levels.iter().zip(orders).zip(places);
        let levels = levels.map(|((level, order), place)| {
            let error = |error| Shown::number(Some(error).filter(|_| level.matched > 0));
            vec![
                (self.0.refinement.name(), Shown::number(level.parameter)),
                ("contacts", Shown::count(level.contacts)),
                ("matched", Shown::count(level.matched)),
                ("missing", Shown::count(level.missing)),
                ("extra", Shown::count(level.extra)),
                ("largest_error", error(level.largest_error)),
                ("rms_error", error(level.rms_error)),
                ("order", Shown::number(order)),
                ("predicted_error", Shown::number(level.predicted_error)),
                ("place", Shown::text(place.name().to_owned())),
            ]
        });
        levels.collect()
    }

    fn fit(self, norm: Norm) -> Entries {
        let fit = self.0.fit(norm);
        let no_order = fit.err().map(|reason| reason.to_string());
        let fit = fit.ok();
        let standard_error = fit.and_then(|fit| fit.standard_error);
        vec![
            ("order", Shown::number(fit.map(|fit| fit.order))),
            ("standard_error", Shown::number(standard_error)),
            ("constant", Shown::number(fit.map(|fit| fit.constant))),
            (
                "levels_used",
                Shown::count(fit.map(|fit| fit.levels as u64)),
            ),
            ("no_order", Shown::new(None, no_order.into())),
        ]
    }
}

fn name(norm: Norm) -> &'static str {
    match norm {
        Norm::Largest => "largest",
        Norm::Rms => "rms",
    }
}
