//! This file writes what a diagnosis leaves behind: report, calibration and pictures in one folder.

use rigproof_diagnose::Diagnosis;
use rigproof_trace::csv;
use rigproof_trace::store::Folder;

use crate::outcome::Failure;
use crate::page::{self, Beside};
use crate::picture;

/// The report's file.
pub const REPORT: &str = "report.json";
/// The page that a person looks at.
pub const PAGE: &str = "report.html";
/// The calibrated model's file.
pub const CALIBRATION: &str = "calibration.toml";
/// The file of the experiment that tells rival explanations apart.
pub const EXPERIMENT: &str = "next-experiment.csv";

/// Writes the files of a diagnosis, enters the calibration into the report, and gives their names.
///
/// After a fault there are only the report and its page: nothing was fitted and nothing can be drawn.
///
/// # Errors
/// The system refuses.
pub fn write(
    folder: &Folder,
    rig_name: &str,
    diagnosis: &mut Diagnosis,
    beside: Beside,
) -> Result<Vec<&'static str>, Failure> {
    let mut files = vec![PAGE, REPORT];
    if diagnosis.report.fit.is_some() {
        diagnosis.report.calibration_file = Some(CALIBRATION.to_owned());
        folder.write(CALIBRATION, diagnosis.calibration.to_toml().as_bytes())?;
        files.push(CALIBRATION);
        for (name, text) in diagnosis.calibration.beside() {
            folder.write(name, text.as_bytes())?;
            files.push(name);
        }
        let report = &diagnosis.report;
        let curves = &diagnosis.curves;
        for (name, drawn) in [
            (
                "before-after.svg",
                picture::before_after(rig_name, report, curves),
            ),
            ("residual.svg", picture::residual(rig_name, report, curves)),
        ] {
            folder.write(name, drawn.as_bytes())?;
            files.push(name);
        }
    }
    if let (Some(plan), Some(next)) = (&diagnosis.experiment, &mut diagnosis.report.next_experiment)
    {
        next.file = Some(EXPERIMENT.to_owned());
        let bytes = csv::to_bytes(plan).map_err(Failure::Input)?;
        folder.write(EXPERIMENT, &bytes)?;
        files.push(EXPERIMENT);
    }
    let page = page::diagnosis(rig_name, diagnosis, beside);
    folder.write(PAGE, page.as_bytes())?;
    folder.write(REPORT, (json(diagnosis)? + "\n").as_bytes())?;
    Ok(files)
}

/// The report as JSON.
///
/// # Errors
/// It cannot be written as JSON.
pub fn json(diagnosis: &Diagnosis) -> Result<String, Failure> {
    serde_json::to_string_pretty(&diagnosis.report)
        .map_err(|error| Failure::Input(format!("cannot write the report as JSON: {error}")))
}
