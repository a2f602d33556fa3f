//! This file reads a `certify.toml` with `plant = "axis"`: the axis, its controllers, its targets and its limits. What it does not know it refuses.

use std::path::{Path, PathBuf};

use rigproof_trace::TraceError;
use rigproof_trace::rig::table::{Source, Table};
use rigproof_trace::suggest::advice;
use serde::{Deserialize, Serialize};

/// What a description says. Travel in m (N) or rad (N·m), as the axis slides or turns.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// What people call the change.
    pub name: String,
    /// The file of the axis, beside the description.
    pub rig: PathBuf,
    /// The library that is to be certified; `None` where the caller brings it.
    pub controller: Option<PathBuf>,
    /// The library that is on the axis now.
    pub baseline: Option<PathBuf>,
    /// What its trials are, and what is asked in them.
    pub asked: Asked,
}

/// What trials are, and what is asked in them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Asked {
    /// Time from one tick to the next, s.
    pub sample_s: f64,
    /// Samples over which the velocity is measured.
    pub velocity_samples: u32,
    /// Where the targets lie, and how they move.
    pub reference: Reference,
    /// What must not be exceeded.
    pub limits: Limits,
    /// By how much the mean may be worse than the baseline's, in the order of the metrics.
    pub regressions: [Option<f64>; 2],
    /// The stiffness of the spring that the controller declares to be, N/m or N·m/rad.
    pub stiffness: Option<f64>,
}

/// Targets of trials.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reference {
    /// The lowest target, m or rad.
    pub low: f64,
    /// The highest target.
    pub high: f64,
    /// The greatest step, and the greatest distance of a start from the first target.
    pub step: f64,
    /// The greatest speed of a ramp or a sine, m/s or rad/s.
    pub speed: f64,
    /// The highest frequency of a sine, Hz.
    pub frequency_hz: f64,
}

/// What must not be exceeded.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// Magnitude of a commanded effort, N or N·m.
    pub effort: f64,
    /// The lower stop, m or rad.
    pub low: f64,
    /// The upper stop.
    pub high: f64,
    /// How often a commanded effort may turn back in any second.
    pub reversals_per_s: f64,
    /// What 95 of 100 trials must not exceed, in the order of the metrics.
    pub trials: [Option<f64>; 2],
}

/// Above every number of a machine.
const GREATEST: f64 = 1e12;
/// Samples over which a velocity may be measured, at most.
pub const MOST_VELOCITY_SAMPLES: u32 = 64;
/// The times from one tick to the next that are simulated, s.
const SAMPLES_S: [f64; 2] = [1e-5, 0.1];

impl Description {
    /// Whether a text is one of an axis.
    ///
    /// # Errors
    /// It is no TOML, or of no plant that is known.
    pub fn describes(text: &str, origin: &Path) -> Result<bool, TraceError> {
        let source = Source { text, file: origin };
        let document = source.document()?;
        let root = Table::root(source, &document);
        match root.text("plant")? {
            None => Ok(false),
            Some("axis") => Ok(true),
            Some(other) => {
                let advice = advice(other, "words", &["axis"]);
                let problem = format!(
                    "`{other}` is no plant of a certification; {advice}; for a five-bar leave `plant` away"
                );
                Err(root.error_at("plant", problem))
            }
        }
    }

    /// Reads a description; `origin` is the file that messages name.
    ///
    /// # Errors
    /// The text is no TOML, a key is unknown or missing, or a number is out of its range; the message gives line and column.
    pub fn parse(text: &str, origin: &Path) -> Result<Description, TraceError> {
        let source = Source { text, file: origin };
        let document = source.document()?;
        let root = Table::root(source, &document);
        root.only(&[
            "name",
            "plant",
            "rig",
            "sample_s",
            "velocity_samples",
            "controller",
            "baseline",
            "reference",
            "limits",
            "regressions",
            "declares",
        ])?;
        let folder = origin.parent().unwrap_or(Path::new(""));
        let rig = root.need("rig", root.text("rig")?)?;
        let library = |key: &str| {
            root.table(key)?
                .map(|own| library(&own, folder))
                .transpose()
        };
        let baseline = library("baseline")?;
        let (reference, limits) = (need(&root, "reference")?, need(&root, "limits")?);
        let reference = self::reference(&reference)?;
        let regressions = root.table("regressions")?;
        let asked = Asked {
            sample_s: ranged(&root, "sample_s", SAMPLES_S)?,
            velocity_samples: velocity_samples(&root)?,
            limits: self::limits(&limits, &reference)?,
            reference,
            regressions: regressions.map_or(Ok([None; 2]), |own| {
                own.only(&METRIC_KEYS)?;
                of_metrics(&own)
            })?,
            stiffness: root
                .table("declares")?
                .map(|own| stiffness(&own))
                .transpose()?,
        };
        Ok(Description {
            name: root.text("name")?.unwrap_or("controller").to_owned(),
            rig: folder.join(rig),
            controller: library("controller")?,
            baseline,
            asked,
        })
    }
}

/// The keys of the metrics, in their order.
const METRIC_KEYS: [&str; 2] = ["error", "effort_rms"];

fn need<'a>(root: &Table<'a>, key: &str) -> Result<Table<'a>, TraceError> {
    root.need(key, root.table(key)?)
}

fn library(table: &Table<'_>, folder: &Path) -> Result<PathBuf, TraceError> {
    table.only(&["library"])?;
    let name = table.need("library", table.text("library")?)?;
    Ok(folder.join(name))
}

/// A number that must be there, inside a range.
fn ranged(table: &Table<'_>, key: &str, [least, most]: [f64; 2]) -> Result<f64, TraceError> {
    let value = table.need(key, table.number(key)?)?;
    if (least..=most).contains(&value) {
        return Ok(value);
    }
    let problem = format!("`{key}` is {value}; give a number from {least} to {most}");
    Err(table.error_at(key, problem))
}

/// A number above zero that must be there.
fn positive(table: &Table<'_>, key: &str) -> Result<f64, TraceError> {
    table.need(key, table.positive(key)?)
}

fn velocity_samples(root: &Table<'_>) -> Result<u32, TraceError> {
    let key = "velocity_samples";
    if !root.has(key) {
        return Ok(1);
    }
    let count = ranged(root, key, [1.0, f64::from(MOST_VELOCITY_SAMPLES)])?;
    match count.fract() == 0.0 {
        true => Ok(count as u32),
        false => {
            let problem = format!(
                "`{key}` is {count}; give a whole number from 1 to {MOST_VELOCITY_SAMPLES}"
            );
            Err(root.error_at(key, problem))
        }
    }
}

/// Two ends, the second above the first.
fn ends(table: &Table<'_>) -> Result<[f64; 2], TraceError> {
    let low = ranged(table, "low", [-GREATEST, GREATEST])?;
    let high = ranged(table, "high", [-GREATEST, GREATEST])?;
    match low < high {
        true => Ok([low, high]),
        false => {
            let problem = format!("`high` is {high}; give a number above `low`, which is {low}");
            Err(table.error_at("high", problem))
        }
    }
}

fn reference(table: &Table<'_>) -> Result<Reference, TraceError> {
    table.only(&["low", "high", "step", "speed", "frequency_hz"])?;
    let [low, high] = ends(table)?;
    Ok(Reference {
        low,
        high,
        step: ranged(table, "step", [0.0, high - low])?,
        speed: positive(table, "speed")?,
        frequency_hz: positive(table, "frequency_hz")?,
    })
}

fn limits(table: &Table<'_>, reference: &Reference) -> Result<Limits, TraceError> {
    let mut known = vec!["effort", "low", "high", "reversals_per_s"];
    known.extend(METRIC_KEYS);
    table.only(&known)?;
    let [low, high] = ends(table)?;
    for (key, end, is_inside) in [
        ("low", low, low <= reference.low - reference.step),
        ("high", high, high >= reference.high + reference.step),
    ] {
        if !is_inside {
            let problem = format!(
                "`{key}` is {end}; give a stop beyond the targets, {} to {}, by `step`, {}: starts lie that far off",
                reference.low, reference.high, reference.step
            );
            return Err(table.error_at(key, problem));
        }
    }
    Ok(Limits {
        effort: positive(table, "effort")?,
        low,
        high,
        reversals_per_s: ranged(table, "reversals_per_s", [0.0, GREATEST])?,
        trials: of_metrics(table)?,
    })
}

fn of_metrics(table: &Table<'_>) -> Result<[Option<f64>; 2], TraceError> {
    let mut all = [None; 2];
    for (own, key) in all.iter_mut().zip(METRIC_KEYS) {
        if table.has(key) {
            *own = Some(ranged(table, key, [0.0, GREATEST])?);
        }
    }
    Ok(all)
}

fn stiffness(table: &Table<'_>) -> Result<f64, TraceError> {
    table.only(&["stiffness"])?;
    positive(table, "stiffness")
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHOLE: &str = "plant = \"axis\"\nrig = \"found/calibration.toml\"\nsample_s = 0.002\n\
        [reference]\nlow = -0.3\nhigh = 0.7\nstep = 0.1\nspeed = 1.3\nfrequency_hz = 2\n\
        [limits]\neffort = 9.5\nlow = -0.5\nhigh = 0.9\nreversals_per_s = 31\nerror = 0.02\n\
        [declares]\nstiffness = 41\n";

    fn parse(text: &str) -> Result<Description, String> {
        let file = Path::new("lab/certify.toml");
        Description::parse(text, file).map_err(|error| error.to_string())
    }

    #[test]
    fn a_description_is_read_and_its_files_lie_beside_it() {
        let read = parse(WHOLE).unwrap();
        assert_eq!(read.rig, Path::new("lab/found/calibration.toml"));
        assert_eq!(read.asked.limits.trials, [Some(0.02), None]);
        assert_eq!(
            (read.asked.stiffness, read.asked.velocity_samples),
            (Some(41.0), 1)
        );
    }

    #[test]
    fn what_is_wrong_is_refused_with_its_place_and_what_is_allowed() {
        for (from, to, place, words) in [
            (
                "sample_s = 0.002",
                "sample_s = 2",
                "line 3, column 12",
                "from 0.00001 to 0.1",
            ),
            (
                "speed = 1.3",
                "sped = 1.3",
                "line 8",
                "did you mean `speed`",
            ),
            (
                "high = 0.9",
                "high = 0.75",
                "line 13",
                "beyond the targets, -0.3 to 0.7",
            ),
            (
                "high = 0.7",
                "high = -0.7",
                "line 6",
                "above `low`, which is -0.3",
            ),
            (
                "effort = 9.5",
                "effort = -9.5",
                "line 11",
                "`effort` is -9.5",
            ),
            ("stiffness = 41", "stiff = 41", "line 17", "`stiffness`"),
        ] {
            let message = parse(&WHOLE.replace(from, to)).unwrap_err();
            assert!(
                message.contains(place) && message.contains(words),
                "{message}"
            );
        }
        let other = Description::describes("plant = \"arm\"\n", Path::new("certify.toml"));
        assert!(
            other
                .unwrap_err()
                .to_string()
                .contains("leave `plant` away")
        );
    }
}
