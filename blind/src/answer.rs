//! This file is the answer to a case: what was hidden, how large it is and what no recording could tell from it.

use crate::law::{Effect, Law};
use crate::plant::Plant;
use crate::size::{CLEAR_SIZE, Size};
use crate::stratum::Stratum;
use rigproof_spec::effect::Motion;
use serde::{Deserialize, Serialize};

/// The truth of a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// The seed that makes the case again.
    pub seed: u64,
    /// The plant.
    pub plant: Plant,
    /// The kind of case.
    pub stratum: Stratum,
    /// What is hidden; empty when nothing is or when the data are at fault.
    pub effects: Vec<HiddenEffect>,
    /// What is wrong with the data, e.g. `stuck_position`.
    pub fault: Option<String>,
    /// Standard deviation of the equivalent effort noise in an 80 ms average, N or N·m: the unit of every size.
    pub block_noise: f64,
}

/// One hidden effect.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HiddenEffect {
    /// The vocabulary's name, or a name of this room for physics outside the vocabulary.
    pub mechanism: String,
    /// The joint of a five-bar it acts at: A, E, B or C; absent where it has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// When it begins, s; absent when it acts throughout.
    pub onset_s: Option<f64>,
    /// True parameters.
    pub parameters: Vec<TrueParameter>,
    /// Root mean square of its force that the nominal model cannot imitate, in `block_noise`.
    pub size: f64,
    /// The same after dry friction, damping, bias, a spring and the other hidden effect have imitated it too.
    pub distinctness: f64,
    /// Signal-to-noise ratio of a matched filter over the whole recording.
    pub strength: f64,
    /// On a five-bar the lesser of its strengths in the 0.3 s before its onset, had it begun by then, and in the 0.3 s after it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub onset_strength: Option<f64>,
    /// Sets of mechanisms that describe any recording of this kind equally well, from physics; a joint stands behind ` at `.
    pub equivalent: Vec<Vec<String>>,
}

/// One true parameter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrueParameter {
    /// The vocabulary's name of the parameter.
    pub name: String,
    /// Value in `unit`.
    pub value: f64,
    /// SI unit.
    pub unit: String,
}

impl HiddenEffect {
    /// Whether the recording tells the onset as well as it tells an effect that is called clearly detectable.
    pub fn tells_onset(&self) -> bool {
        self.onset_strength
            .is_some_and(|strength| strength >= CLEAR_SIZE)
    }

    /// Mechanism and joint, such as `viscous at E`; the mechanism alone where there is no joint.
    pub fn key(&self) -> String {
        key(&self.mechanism, self.joint.as_deref())
    }

    pub(crate) fn new(
        effect: &Effect,
        size: Size,
        plant: Plant,
        motion: Motion,
        dry_in_plant: bool,
    ) -> HiddenEffect {
        HiddenEffect {
            mechanism: effect.law.name().to_owned(),
            joint: None,
            onset_s: effect.onset_s,
            parameters: effect
                .law
                .parameters()
                .into_iter()
                .map(|(name, value, quantity)| TrueParameter {
                    name: name.to_owned(),
                    value,
                    unit: quantity.dimension(motion).to_string(),
                })
                .collect(),
            size: size.size,
            distinctness: size.distinctness,
            strength: size.strength,
            onset_strength: size.onset_strength,
            equivalent: equivalent(&effect.law, plant, dry_in_plant)
                .iter()
                .map(|set| set.iter().map(|name| (*name).to_owned()).collect())
                .collect(),
        }
    }
}

/// The name of a mechanism at a joint.
pub(crate) fn key(mechanism: &str, joint: Option<&str>) -> String {
    joint.map_or_else(
        || mechanism.to_owned(),
        |joint| format!("{mechanism} at {joint}"),
    )
}

/// Sets of mechanisms that no recording can tell from a law.
///
/// - A dry friction of F + D forward and F − D backward is the set [−F, F] shifted by D: a bias of D.
/// - Dahl's bristle is the Bouc–Wen law of order one with beta_delta zero.
/// - A drive gain k times too large with all friction and stiffness unknown is an inertia k times too small.
fn equivalent(law: &Law, plant: Plant, dry_in_plant: bool) -> &'static [&'static [&'static str]] {
    match law {
        Law::Asymmetry { viscous: 0.0, .. } => &[&["constant_bias"]],
        Law::Asymmetry { dry, .. } if *dry != 0.0 => &[&["constant_bias", "direction_asymmetry"]],
        Law::Bias { .. } if dry_in_plant => &[&["direction_asymmetry"]],
        Law::Dahl { .. } => &[&["hysteresis"]],
        Law::Gain { .. } if plant == Plant::Axis => &[&["inertia_error"]],
        _ => &[],
    }
}
