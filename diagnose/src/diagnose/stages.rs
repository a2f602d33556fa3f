//! This file says how the mechanisms were named, stage by stage, with the inverse model of each stage.

use super::write::Stand;
use crate::plants::joint::inverse::{CUTOFF_HZ, DECIMATION, FILTER_ORDER, inverse_model, protocol};
use crate::report::{InverseReport, StageReport};
use crate::select::Stage;

impl Stand<'_> {
    pub(crate) fn stages(&self) -> Vec<StageReport> {
        let stages = self.selection.stages.iter();
        stages
            .map(|stage| StageReport {
                entered: stage.entered.mechanism.name(),
                joint: None,
                standing: stage
                    .standing
                    .iter()
                    .map(|c| self.problem.name(*c))
                    .collect(),
                residual: stage.residual,
                inverse_error_percent: self.inverse_error_percent(Some(stage)),
            })
            .collect()
    }

    /// The inverse model with the nominal laws alone.
    pub(crate) fn inverse_model(&self) -> Option<InverseReport> {
        Some(InverseReport {
            protocol: protocol(),
            filter_order: FILTER_ORDER,
            cutoff_hz: CUTOFF_HZ,
            decimation: DECIMATION,
            nominal_error_percent: self.inverse_error_percent(None)?,
        })
    }

    fn inverse_error_percent(&self, stage: Option<&Stage>) -> Option<f64> {
        let nominal = self.selection.nominal.iter();
        let mut laws: Vec<_> = nominal
            .map(|t| (t.cause.mechanism, t.shape.clone(), t.onset_s))
            .collect();
        if let Some(stage) = stage {
            let shapes = stage.shapes.iter().cloned();
            let standing = stage.standing.iter().copied().zip(shapes);
            laws.extend(
                standing.map(|(cause, (shape, onset_s))| (cause.mechanism, shape, onset_s)),
            );
        }
        let from_start = |(mechanism, shape, onset_s)| match onset_s {
            None => Some((mechanism, shape)),
            Some(_) => None,
        };
        let laws: Option<Vec<_>> = laws.into_iter().map(from_start).collect();
        Some(inverse_model(self.train, &laws?)?.error_percent)
    }
}
