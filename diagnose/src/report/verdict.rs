//! This file is the verdict of a diagnosis, and what it says of the model.

use super::{EffectReport, Report};
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
        let mut remarks = self.remarks.iter();
        let own = remarks.find(|own| own.what == "likest")?;
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
