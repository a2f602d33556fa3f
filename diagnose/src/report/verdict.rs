//! This file is the verdict of a diagnosis, and what it says of the model.

use super::{EffectReport, FitReport, HELD_OUT_PART, Report};
use crate::rules::NAMED;
use rigproof_spec::effect::Mechanism;
use serde::Serialize;

/// The seven verdicts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The nominal model explains the recording.
    Consistent,
    /// The named mechanisms explain the recording down to its noise.
    Explained,
    /// Mechanisms are named, and something beyond noise is left.
    PartlyExplained,
    /// Another set of mechanisms explains it as well.
    Ambiguous,
    /// The unexplained part matches nothing in the library.
    NoneOfLibrary,
    /// The recording moves too little for a conclusion.
    NotExcited,
    /// The recording is faulty.
    DataFault,
}

impl Verdict {
    /// The name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Verdict::Consistent => "consistent",
            Verdict::Explained => "explained",
            Verdict::PartlyExplained => "partly_explained",
            Verdict::Ambiguous => "ambiguous",
            Verdict::NoneOfLibrary => "none_of_library",
            Verdict::NotExcited => "not_excited",
            Verdict::DataFault => "data_fault",
        }
    }
}

impl Report {
    /// The effects that are named, and those that are suspected at most.
    pub fn by_status(&self) -> [Vec<&EffectReport>; 2] {
        let (named, suspected) = self
            .effects
            .iter()
            .partition(|own| own.probability >= NAMED);
        [named, suspected]
    }

    /// Whether a named cause changes the model. The scatter of the time stamps does not: alignment
    /// mends it in the recording.
    pub fn changes_the_model(&self) -> bool {
        let mended = Mechanism::ClockJitter.name();
        self.effects.iter().any(|own| own.mechanism != mended)
    }

    /// What is most like what is left where nothing is named, in words.
    pub fn likest(&self) -> Option<&str> {
        self.said("likest")
    }

    /// Whether an unknown inertia was taken as it is stated.
    pub fn has_inertia_as_stated(&self) -> bool {
        self.said("inertia_as_stated").is_some()
    }

    /// The words of a remark.
    fn said(&self, what: &str) -> Option<&str> {
        let mut remarks = self.remarks.iter();
        let own = remarks.find(|own| own.what == what)?;
        Some(&own.words)
    }

    /// Whether the described model agrees with the recording, once alignment has mended it.
    pub fn agrees(&self) -> bool {
        match self.verdict {
            Verdict::Consistent => true,
            Verdict::Explained => !self.changes_the_model(),
            _ => false,
        }
    }
}

impl FitReport {
    /// Whether the held-out part is predicted worse with what is named than without it: as a whole,
    /// and from states within it over every horizon. Such a state does not hold how far a part has
    /// bent, so that over horizons alone a compliance is refuted too.
    pub fn is_refuted(&self) -> bool {
        let held_out = self.horizon.iter().filter(|own| own.part == HELD_OUT_PART);
        let mut worse = held_out.map(|own| own.after.is_nan() || own.after > own.before);
        !self.improved && worse.clone().count() > 0 && worse.all(|own| own)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{BeforeAfter, Horizon};

    /// A report whose held-out error grows by `whole` times, and over each horizon by these.
    fn fit(whole: f64, horizons: &[f64]) -> FitReport {
        let errors = |times: f64| BeforeAfter {
            before: 1.0,
            after: times,
            nrmse_before: 1.0,
            nrmse_after: times,
        };
        let horizon = |times: &f64| Horizon {
            horizon_s: 0.1,
            part: HELD_OUT_PART,
            unit: "rad".to_owned(),
            before: 1.0,
            after: *times,
            tip_before_mm: None,
            tip_after_mm: None,
        };
        FitReport {
            protocol: String::new(),
            unit: "rad".to_owned(),
            train: errors(0.1),
            held_out: Some(errors(whole)),
            held_out_without_refit: None,
            held_out_from_rest: None,
            horizon: horizons.iter().map(horizon).collect(),
            recovered_share: 0.0,
            improved: whole < 1.0,
            agreement: None,
            drift: None,
        }
    }

    #[test]
    fn names_are_refuted_where_every_prediction_is_worse() {
        assert!(fit(500.0, &[5.0, 84.0]).is_refuted());
        assert!(fit(f64::NAN, &[f64::NAN]).is_refuted());
        assert!(!fit(0.3, &[5.0, 84.0]).is_refuted());
        assert!(!fit(2.0, &[1.5, 0.7]).is_refuted());
        assert!(!fit(2.0, &[]).is_refuted());
    }
}
