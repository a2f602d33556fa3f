//! This file begins the description of a serial arm from its URDF or MJCF and the columns of a recording.

use std::path::{Path, PathBuf};

use rigproof_model::chain::{Chain, Kind, is_mjcf};
use rigproof_spec::units::{Dimension, Unit};
use rigproof_trace::csv::{Hints, TimeColumn};
use rigproof_trace::rig::FILL_IN;
use rigproof_trace::rig::chain::ModelFormat;
use rigproof_trace::store::read_text;

use super::signal::SignalView;
use super::skeleton::{hinted, plain, string};
use crate::outcome::Failure;

/// What a column is called that holds a position, and one that holds an effort.
const POSITION: [&str; 6] = ["q", "position", "pos", "theta", "angle", "joint"];
const EFFORT: [&str; 5] = ["tau", "effort", "torque", "trq", "force"];

/// The model that an arm is described by.
#[derive(Clone, clap::Args)]
pub struct Model {
    /// With --write-rig: the URDF or MJCF of a serial arm; its joints are looked for among the columns by their names, or as q1 … qn and tau1 … taun
    #[arg(long, value_name = "FILE", requires = "write_rig")]
    model: Option<PathBuf>,
    /// With --model: the link (of MJCF a body or site) beyond which nothing is attached, where the arm branches
    #[arg(long, value_name = "LINK", requires = "model")]
    tip: Option<String>,
}

impl Model {
    /// The beginning of a description; `None` without a model.
    ///
    /// # Errors
    /// The model describes no arm.
    pub fn toml(
        &self,
        (recording, rig): (&Path, &Path),
        time: Option<&TimeColumn>,
        hints: &Hints,
        signals: &[&SignalView],
    ) -> Result<Option<String>, Failure> {
        let Some(file) = &self.model else {
            return Ok(None);
        };
        let text = read_text(file)?;
        let format = match is_mjcf(&text) {
            true => ModelFormat::Mjcf,
            false => ModelFormat::Urdf,
        };
        let chain = Chain::from_model(&text, self.tip.as_deref())
            .map_err(|error| Failure::unusable(file, error.to_string()))?;
        let stem = recording.file_stem().unwrap_or_default().to_string_lossy();
        let mut lines = vec![
            format!(
                "# Begun by `rigproof inspect` from {} and a recording: check that each joint has its own columns.",
                format.name()
            ),
            format!("name = {}", string(&stem)),
            "plant = \"chain\"".to_owned(),
            format!("{} = {}", format.key(), string(&seen_from(file, rig))),
        ];
        let tip = self.tip.iter();
        lines.extend(tip.map(|tip| format!("tip = {}", string(tip))));
        let time = time.map(|time| format!("time = {{ channel = {} }}", string(&time.name)));
        lines.extend(
            time.into_iter()
                .flat_map(|time| ["\n[channels]".to_owned(), time]),
        );
        lines.extend(hinted(hints));
        let mut used: Vec<&str> = Vec::new();
        for (k, joint) in chain.joints.iter().enumerate() {
            let units = match joint.kind {
                Kind::Revolute => (Dimension::ANGLE, Dimension::TORQUE),
                Kind::Prismatic => (Dimension::LENGTH, Dimension::FORCE),
            };
            lines.push(format!("\n[[joint]]\nname = {}", string(&joint.name)));
            if joint.kind == Kind::Prismatic {
                lines.push("motion = \"linear\"".to_owned());
            }
            let of =
                |words: &[&str], other: &[&str]| found(signals, (&joint.name, k + 1), words, other);
            let position = of(&POSITION, &EFFORT);
            let effort = of(&EFFORT, &POSITION);
            used.extend(position.iter().chain(&effort).map(|own| own.name.as_str()));
            lines.push(channel("position", position, &joint.name, signals, units.0));
            lines.push(channel("effort", effort, &joint.name, signals, units.1));
        }
        let unused: Vec<&str> = signals.iter().map(|own| own.name.as_str()).collect();
        let unused: Vec<&str> = unused
            .into_iter()
            .filter(|name| !used.contains(name))
            .collect();
        if !unused.is_empty() {
            lines.push(format!("\n# not used: {}", plain(&unused.join(", "))));
            lines.push("# A second encoder or a torque sensor of a joint is `motor` or `torque` in its block, with `stiffness` and `rotor`.".to_owned());
        }
        Ok(Some(lines.join("\n") + "\n"))
    }
}

/// The model as a description names it: beside itself by its name, elsewhere by its whole path.
fn seen_from(model: &Path, rig: &Path) -> String {
    let whole = |path: &Path| std::path::absolute(path).unwrap_or(path.to_owned());
    let (own, rig) = (whole(model), whole(rig));
    match own.parent() == rig.parent() {
        true => own.file_name().map_or(own.clone(), PathBuf::from),
        false => own,
    }
    .display()
    .to_string()
}

/// The words and numbers of a name, in small letters: `Joint_2.pos` is `joint`, `2` and `pos`.
fn parts(name: &str) -> Vec<String> {
    let mut parts: Vec<String> = Vec::new();
    let mut before = None;
    for c in name.chars().flat_map(char::to_lowercase) {
        let kind = (c.is_alphabetic(), c.is_numeric());
        match (before == Some(kind), kind) {
            (_, (false, false)) => {}
            (true, _) => parts.last_mut().into_iter().for_each(|own| own.push(c)),
            (false, _) => parts.push(c.to_string()),
        }
        before = Some(kind);
    }
    parts
}

/// The column of a joint, by its name with one of the words, or by a word and its number from the base.
fn found<'a>(
    signals: &[&'a SignalView],
    (name, number): (&str, usize),
    words: &[&str],
    other: &[&str],
) -> Option<&'a SignalView> {
    let own = parts(name);
    let number = number.to_string();
    let by_name = |view: &&&SignalView| {
        let all = parts(&view.name);
        let at = all.windows(own.len().max(1)).position(|part| part == own);
        let Some(at) = at else { return false };
        let outside = |k: usize| k < at || k >= at + own.len();
        let rest = || all.iter().enumerate().filter(|(k, _)| outside(*k));
        let has = |words: &[&str]| rest().any(|(_, part)| words.contains(&part.as_str()));
        has(words) || rest().next().is_none() && words == POSITION && !has(other)
    };
    let by_number = |view: &&&SignalView| match &parts(&view.name)[..] {
        [word, own] => words.contains(&word.as_str()) && *own == number,
        _ => false,
    };
    let mut all = signals.iter();
    let named = all.clone().find(by_name);
    named.or_else(|| all.find(by_number)).copied()
}

/// A line of a joint; a message with names has its joints by their names.
fn channel(
    key: &str,
    found: Option<&SignalView>,
    joint: &str,
    signals: &[&SignalView],
    dimension: Dimension,
) -> String {
    let field = format!(".{key}[");
    let topic = signals.iter().find_map(|own| own.name.split_once(&field));
    let (name, unit) = match (found, topic) {
        (Some(own), _) => (own.name.clone(), own.unit.clone()),
        (None, Some((topic, _))) => (format!("{topic}.{key}[name={joint}]"), String::new()),
        (None, None) => (FILL_IN.to_owned(), String::new()),
    };
    // A unit of something else is the joint's business: `diagnose` says so.
    let unit = match Unit::parse(&unit) {
        Some(_) if !unit.is_empty() => unit,
        _ => dimension.to_string(),
    };
    format!(
        "{key} = {{ channel = {}, unit = {} }}",
        string(&name),
        string(&unit)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_trace::Channel;

    fn view(name: &str, unit: &str) -> SignalView {
        SignalView::of(Channel {
            name: name.to_owned(),
            unit: unit.to_owned(),
            samples: vec![0.1, 0.7, -0.3],
        })
    }

    fn begun(columns: &[(&str, &str)]) -> String {
        let of = |file: &str| begun_with(file, columns);
        let (urdf, mjcf) = (of("arm.urdf"), of("arm.xml"));
        assert_eq!(
            mjcf.replace("MJCF", "URDF")
                .replace("mjcf", "urdf")
                .replace(".xml", ".urdf"),
            urdf
        );
        urdf
    }

    fn begun_with(file: &str, columns: &[(&str, &str)]) -> String {
        let views: Vec<SignalView> = columns
            .iter()
            .map(|(name, unit)| view(name, unit))
            .collect();
        let urdf = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../rigs")
            .join(file);
        let model = Model {
            model: Some(urdf),
            tip: Some("fore".to_owned()),
        };
        let files = (Path::new("run.csv"), Path::new("rig.toml"));
        let views: Vec<&SignalView> = views.iter().collect();
        model
            .toml(files, None, &Hints::default(), &views)
            .unwrap()
            .unwrap()
    }

    #[test]
    fn joints_find_their_columns_by_name_or_by_number() {
        let named = begun(&[
            ("elbow_torque", "Nm"),
            ("elbow", "deg"),
            ("shoulder_pos", "rad"),
            ("shoulder_effort", "N·m"),
            ("temperature", ""),
        ]);
        assert!(
            named.contains("position = { channel = \"elbow\", unit = \"deg\" }"),
            "{named}"
        );
        assert!(
            named.contains("effort = { channel = \"shoulder_effort\", unit = \"N·m\" }"),
            "{named}"
        );
        assert!(named.contains("# not used: temperature"), "{named}");
        let numbered = begun(&[("q1", ""), ("q2", ""), ("tau1", ""), ("tau2", "")]);
        assert!(
            numbered.contains("position = { channel = \"q2\", unit = \"rad\" }"),
            "{numbered}"
        );
        assert!(
            numbered.contains("effort = { channel = \"tau1\", unit = "),
            "{numbered}"
        );
        assert!(!numbered.contains(FILL_IN), "{numbered}");
        let messages = begun(&[
            ("/joint_states.position[0]", "rad"),
            ("/joint_states.effort[0]", ""),
        ]);
        assert!(
            messages.contains("/joint_states.effort[name=elbow]"),
            "{messages}"
        );
        assert!(begun(&[("q1", ""), ("tau1", "")]).contains(FILL_IN));
    }
}
