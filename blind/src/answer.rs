//! This file is the answer to a case: what was hidden, how large it is and what no recording could tell from it.

use crate::effect::{At, Effect};
use crate::fault::Spoilt;
use crate::forms::{Forms, Names};
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
    /// The family of forms of what is hidden.
    #[serde(default, skip_serializing_if = "Forms::is_usual")]
    pub forms: Forms,
    /// The kind of case.
    pub stratum: Stratum,
    /// What is hidden; empty when nothing is or when the data are at fault.
    pub effects: Vec<HiddenEffect>,
    /// What is wrong with the data, e.g. `stuck_position`.
    pub fault: Option<String>,
    /// Where it is, and which channels may be said to be at fault.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spoilt: Option<Spoilt>,
    /// Standard deviation of the equivalent effort noise in an 80 ms average, N or N·m: the unit of every size.
    pub block_noise: f64,
    /// Root mean square of what the nominal model leaves, over what the noise of the sensors explains, from the plant's own knowledge.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub residual_ratio: Option<f64>,
}

/// One hidden effect.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HiddenEffect {
    /// The vocabulary's name, or a name of this room for physics outside the vocabulary.
    pub mechanism: String,
    /// The joint of a five-bar it acts at, A, E, B or C, or of an arm, joint1 and so on; absent where it has none.
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
    /// In other forms: the form.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub form: String,
    /// In other forms: the names any of which is right.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub right: Vec<String>,
    /// In other forms: names that are not false beside a right one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub companions: Vec<String>,
    /// In other forms: `every` joint with a brake, or the axis of the sensor, `x` or `y`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scope: Option<String>,
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
        motion: Motion,
        equivalent: Vec<Vec<String>>,
    ) -> HiddenEffect {
        let parameters = effect.parameters(motion).into_iter();
        let joint = match effect.at {
            At::Joint(joint) => Some(joint.letter().to_owned()),
            At::Arm(joint) => Some(format!("joint{}", joint + 1)),
            At::Whole | At::Every | At::Sensor(_) => None,
        };
        HiddenEffect {
            mechanism: effect.name().to_owned(),
            joint,
            onset_s: effect.onset_s,
            parameters: parameters
                .map(|(name, value, dimension)| TrueParameter {
                    name: name.to_owned(),
                    value,
                    unit: dimension.to_string(),
                })
                .collect(),
            size: size.size,
            distinctness: size.distinctness,
            strength: size.strength,
            onset_strength: size.onset_strength,
            equivalent,
            form: String::new(),
            right: Vec::new(),
            companions: Vec::new(),
            scope: None,
        }
    }

    /// The same with its form and the names that are right.
    pub(crate) fn named(self, effect: &Effect) -> HiddenEffect {
        let Names { right, companions } = Names::of(effect);
        let owned = |names: &[&str]| -> Vec<String> {
            names.iter().map(|name| (*name).to_owned()).collect()
        };
        let twins = self
            .equivalent
            .iter()
            .flatten()
            .filter(|name| !name.contains(" at "))
            .cloned();
        let scope = match effect.at {
            At::Every => Some("every"),
            At::Sensor(0) => Some("x"),
            At::Sensor(_) => Some("y"),
            At::Whole | At::Joint(_) | At::Arm(_) => None,
        };
        HiddenEffect {
            form: format!("{:?}", effect.form),
            right: owned(right).into_iter().chain(twins).collect(),
            companions: owned(companions),
            scope: scope.map(str::to_owned),
            ..self
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
