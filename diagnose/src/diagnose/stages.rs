//! This file reports the selection stage by stage, with the inverse model of each stage.

use super::write::Stand;
use crate::plant::Plant;
use crate::report::{InverseReport, StageReport};
use crate::selection::Stage;
use rigproof_spec::effect::Mechanism;

/// A law with its shape and its onset, s.
type Law = (Mechanism, Vec<f64>, Option<f64>);

impl<P: Plant> Stand<'_, P> {
    pub(crate) fn stages(&self) -> Vec<StageReport> {
        let run = self.problem.run;
        let stages = self.selection.stages.iter();
        stages
            .map(|stage| StageReport {
                entered: stage.entered.mechanism.name(),
                joint: run.place_name(stage.entered.at),
                standing: stage.standing.iter().map(|c| run.cause_name(*c)).collect(),
                residual: stage.residual,
                inverse_error_percent: self
                    .inverse_model(&standing(stage))
                    .map(|model| model.nominal_error_percent),
            })
            .collect()
    }

    /// The inverse model with the nominal laws and some more; `None` if one has an onset.
    pub(crate) fn inverse_model(&self, more: &[Law]) -> Option<InverseReport> {
        let nominal = self.selection.nominal.iter();
        let nominal = nominal.map(|t| (t.cause.mechanism, t.shape.clone(), t.onset_s));
        let from_start = |(mechanism, shape, onset_s): Law| match onset_s {
            None => Some((mechanism, shape)),
            Some(_) => None,
        };
        let laws = nominal.chain(more.iter().cloned()).map(from_start);
        P::inverse_model(self.train, &laws.collect::<Option<Vec<_>>>()?)
    }
}

fn standing(stage: &Stage) -> Vec<Law> {
    let laws = stage.standing.iter().zip(&stage.shapes);
    laws.map(|(cause, (shape, onset_s))| (cause.mechanism, shape.clone(), *onset_s))
        .collect()
}
