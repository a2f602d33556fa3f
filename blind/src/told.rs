//! This file says whether a report tells a fault of the data and where it is, from the report's JSON alone.

use crate::answer::Answer;
use crate::error::Error;
use crate::found::found_effects;
use serde::Serialize;
use serde_json::Value;

/// How far beside its place a fault may be said to be, s.
pub const PLACE_S: f64 = 0.1;

/// What a report says of a recording whose data are at fault.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Told {
    /// The fault.
    pub fault: String,
    /// The report's verdict.
    pub verdict: String,
    /// Mechanisms that are named although the data are at fault. Jitter of the clock is the fault
    /// itself where the stamps jitter.
    pub names: Vec<String>,
    /// Whether a fault, or something mended, is said of a right channel and at a right time.
    pub is_right: bool,
    /// Whether the report calls the recording explained and says nothing right of the fault.
    pub is_silent: bool,
}

/// Compares a report with the fault of an answer; an answer without a fault has nothing to tell.
///
/// # Errors
/// [`Error::Report`] when `verdict` or `effects` is missing.
pub fn told(answer: &Answer, report: &Value) -> Result<Told, Error> {
    let text = |value: &Value, key: &str| value.get(key).and_then(Value::as_str).map(str::to_owned);
    let verdict = text(report, "verdict").ok_or(Error::Report("string \"verdict\""))?;
    let names = found_effects(answer.plant, report)?;
    let mended = report.get("remarks").and_then(Value::as_array);
    let said = report
        .get("fault")
        .into_iter()
        .chain(mended.into_iter().flatten());
    let spoilt = answer.spoilt.as_ref();
    let is_there = |said: &Value| {
        let (Some(spoilt), Some(channel)) = (spoilt, text(said, "channel")) else {
            return false;
        };
        let number = |key| said.get(key).and_then(Value::as_f64).unwrap_or(f64::NAN);
        spoilt.channels.contains(&channel)
            && number("from_s") <= spoilt.to_s + PLACE_S
            && number("to_s") >= spoilt.from_s - PLACE_S
    };
    let is_right = said.into_iter().any(is_there);
    let is_the_fault =
        |name: &str| name == "clock_jitter" && answer.fault.as_deref() == Some("jitter");
    Ok(Told {
        fault: answer.fault.clone().unwrap_or_default(),
        is_silent: !is_right && matches!(verdict.as_str(), "consistent" | "explained"),
        names: names
            .into_iter()
            .map(|own| own.name)
            .filter(|name| !is_the_fault(name))
            .collect(),
        verdict,
        is_right,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fault::Spoilt;
    use crate::forms::Forms;
    use crate::plant::Plant;
    use crate::stratum::Stratum;
    use serde_json::json;

    #[test]
    fn a_fault_is_right_in_its_channel_at_its_time_also_where_it_is_mended() {
        let answer = Answer {
            seed: 1,
            plant: Plant::Axis,
            forms: Forms::Usual,
            stratum: Stratum::DataFault,
            effects: Vec::new(),
            fault: Some("dropouts".to_owned()),
            spoilt: Some(Spoilt {
                fault: "dropouts".to_owned(),
                channels: vec!["position".to_owned()],
                from_s: 2.0,
                to_s: 3.0,
            }),
            block_noise: 1.0,
            residual_ratio: None,
        };
        let said = |channel: &str, from_s: f64| json!({ "channel": channel, "from_s": from_s, "to_s": from_s + 0.5 });
        let judged = |report: Value| told(&answer, &report).unwrap();
        let fault = |said: Value| json!({ "verdict": "data_fault", "effects": [], "fault": said });
        assert!(judged(fault(said("position", 2.9))).is_right);
        assert!(!judged(fault(said("effort", 2.9))).is_right);
        assert!(!judged(fault(said("position", 3.2))).is_right);
        let mended = json!({ "verdict": "consistent", "effects": [], "fault": null, "remarks": [said("position", 2.1)] });
        assert!(judged(mended.clone()).is_right && !judged(mended).is_silent);
        let silent =
            json!({ "verdict": "explained", "effects": [{ "mechanism": "lag" }], "remarks": [] });
        let silent = judged(silent);
        assert!(silent.is_silent && silent.names == ["lag"]);
        let named = json!({ "verdict": "explained", "effects": [{ "mechanism": "lag" }, { "mechanism": "clock_jitter" }] });
        let jitter = Answer {
            fault: Some("jitter".to_owned()),
            ..answer.clone()
        };
        assert_eq!(told(&jitter, &named).unwrap().names, ["lag"]);
        assert_eq!(told(&answer, &named).unwrap().names.len(), 2);
    }
}
