//! `verify --refinement`: the observed order of accuracy.

use std::io::Write;

use cannonpile::Packing;
use cannonpile_dem::Compliance;
use cannonpile_dem::scene::Scene;
use cannonpile_dem::table::{FileFormat, WriteError};
use cannonpile_dem::verify::{
    Level, NoRefinement, Norm, Refinement, RefinementReport, RefinementStudy, Source,
};
use serde_json::{Map, Value, json};

use super::{LevelFile, Parameter, Verify, compare};
use crate::output::Failure;
use crate::progress::Progress;

impl Verify {
    /// Compares the files of a refinement study, and returns whether their errors show an order.
    pub(super) fn compare_refinement(
        &self,
        files: &[LevelFile],
        scene: &Scene,
        packing: &Packing<'_>,
    ) -> Result<bool, Failure> {
        let refinement = match self.parameter {
            None | Some(Parameter::Stiffness) => Refinement::Stiffness,
            Some(Parameter::TimeStep) => Refinement::TimeStep,
        };
        let study = |levels: Vec<Level>| {
            let blamed =
                |refusal: NoRefinement| Failure::Message(format!("--refinement: {refusal}"));
            RefinementStudy::new(refinement, levels).map_err(blamed)
        };
        // Wrong parameters are refused before the files are read.
        let unread = files.iter().map(|(parameter, _)| Level {
            parameter: *parameter,
            ..Level::default()
        });
        study(unread.collect())?;
        let (format, reader) = (self.output.format()?, self.reader()?);
        let progress = Progress::begin("reading the files of --refinement");
        let (mut levels, mut sources, mut with_vectors) = (Vec::new(), Vec::new(), false);
        for (parameter, path) in files {
            let read = compare(&reader, packing, (path, None), format);
            let (read, source) = read.map_err(|refusal| self.refused(refusal, path, scene))?;
            let worst = read.comparison.worst();
            with_vectors |= worst.is_some_and(|worst| worst.exact_vector.is_some());
            levels.push(Level::new(*parameter, &read.comparison, self.accept));
            sources.extend(source.map(|source| (*parameter, source)));
        }
        // The spring theory predicts the errors of some scenes only.
        if refinement == Refinement::Stiffness
            && let Ok(springs) = Compliance::new(packing)
        {
            for level in &mut levels {
                level.predicted_error = Some(if with_vectors {
                    springs.largest_vector_error(level.parameter)
                } else {
                    springs.largest_error(level.parameter)
                });
            }
        }
        let study = study(levels)?;
        let report = RefinementReport::new(&study);
        self.output.write(&progress, |out| match format.into() {
            FileFormat::Json => record(report.json(), &sources, scene, out),
            format => report.write(format, out),
        })?;
        drop(progress);
        Ok(study.fit(Norm::Largest).is_ok())
    }
}

/// Writes the JSON record: the refinement study with its files and the scene.
fn record(
    mut record: Map<String, Value>,
    sources: &[(f64, Source)],
    scene: &Scene,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let files: Vec<Value> = sources
        .iter()
        .map(|(parameter, source)| {
            json!({
                "parameter": parameter,
                "file": source.file,
                "bytes": source.bytes,
                "sha256": source.sha256,
            })
        })
        .collect();
    record.insert("version".into(), env!("CARGO_PKG_VERSION").into());
    record.insert("files".into(), files.into());
    record.insert("scene".into(), scene.to_toml().into());
    serde_json::to_writer_pretty(&mut *out, &record)?;
    Ok(writeln!(out)?)
}
