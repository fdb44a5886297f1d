//! `verify --refinement`: the observed order of accuracy.

use std::io::Write;

use cannonpile::Packing;
use cannonpile_dem::Compliance;
use cannonpile_dem::scene::Scene;
use cannonpile_dem::table::{FileFormat, WriteError};
use cannonpile_dem::verify::{
    Level, NoRefinement, Norm, Refinement, RefinementFiles, RefinementReport, RefinementStudy,
    Source,
};
use serde_json::{Value, json};

use super::{Parameter, Verify, compare};
use crate::output::Failure;
use crate::progress::Progress;

impl Verify {
    /// Compares the files of a refinement study, and returns whether their errors show an order.
    pub(super) fn compare_refinement(
        &self,
        RefinementFiles(files): &RefinementFiles,
        scene: &Scene,
        packing: &Packing<'_>,
    ) -> Result<bool, Failure> {
        let (format, reader) = (self.output.format()?, self.reader()?);
        let progress = Progress::begin("reading the files of --refinement");
        let (mut levels, mut sources, mut with_vectors) = (Vec::new(), Vec::new(), false);
        for file in files {
            let read = compare(&reader, packing, (&file.path, None), format);
            let (read, source) =
                read.map_err(|refusal| self.refused(refusal, &file.path, scene))?;
            let worst = read.comparison.worst();
            with_vectors |= worst.is_some_and(|worst| worst.exact_vector.is_some());
            levels.push(Level::new(file.parameter, &read.comparison, self.accept));
            sources.extend(source.map(|source| (file.parameter, source)));
        }
        let refinement = match self.parameter {
            None | Some(Parameter::Stiffness) => Refinement::Stiffness,
            Some(Parameter::TimeStep) => Refinement::TimeStep,
        };
        let blamed = |refusal: NoRefinement| Failure::Message(format!("--refinement: {refusal}"));
        let mut study = RefinementStudy::new(refinement, levels).map_err(blamed)?;
        // The spring theory predicts the errors of some scenes only.
        if refinement == Refinement::Stiffness
            && let Ok(springs) = Compliance::new(packing)
        {
            let error = |stiffness| {
                if with_vectors {
                    springs.largest_vector_error(stiffness)
                } else {
                    springs.largest_error(stiffness)
                }
            };
            study = study.predicted(error).map_err(blamed)?;
        }
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
    study: Value,
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
    let mut record = study;
    if let Value::Object(entries) = &mut record {
        entries.insert("version".into(), env!("CARGO_PKG_VERSION").into());
        entries.insert("files".into(), files.into());
        entries.insert("scene".into(), scene.to_toml().into());
    }
    serde_json::to_writer_pretty(&mut *out, &record)?;
    Ok(writeln!(out)?)
}
