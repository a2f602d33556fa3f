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
use crate::text::number::significant;

/// What a column is called that holds a position, and one that holds an effort.
const POSITION: [&str; 6] = ["q", "position", "pos", "theta", "angle", "joint"];
const EFFORT: [&str; 5] = ["tau", "effort", "torque", "trq", "force"];
/// What stands in the name of a column of the motor's side of a gear, and of a sensor behind it.
const MOTOR: [&str; 4] = ["motor", "rotor", "qm", "thetam"];
const SENSOR: [&str; 5] = ["sensor", "sensed", "measured", "meas", "jts"];
/// A motor that turns this many times as far as its joint, at least, has a gear ratio that can be read off.
const LEAST_RATIO: f64 = 1.5;

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
            let (position, motor) = sides(of(&POSITION, &EFFORT));
            let (effort, sensor) = sides(of(&EFFORT, &POSITION));
            let of_gear = [motor, sensor];
            let both = [position, effort].into_iter().chain(of_gear).flatten();
            used.extend(both.map(|own| own.name.as_str()));
            lines.push(channel("position", position, &joint.name, signals, units.0));
            lines.push(channel("effort", effort, &joint.name, signals, units.1));
            lines.extend(gear(of_gear, position, units));
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

/// The columns of a joint, by its name with one of the words, or by a word and its number from the base.
fn found<'a>(
    signals: &[&'a SignalView],
    (name, number): (&str, usize),
    words: &[&str],
    other: &[&str],
) -> Vec<&'a SignalView> {
    let own = parts(name);
    let number = number.to_string();
    let by_name = |view: &&&SignalView| {
        let all = parts(&view.name);
        let at = all.windows(own.len().max(1)).position(|part| part == own);
        let Some(at) = at else { return false };
        let outside = |k: usize| k < at || k >= at + own.len();
        let rest = || all.iter().enumerate().filter(|(k, _)| outside(*k));
        let has = |words: &[&str]| rest().any(|(_, part)| words.contains(&part.as_str()));
        let is_bare = rest().next().is_none() || has(&MOTOR);
        has(words) || is_bare && words == POSITION && !has(other)
    };
    let by_number = |view: &&&SignalView| match &parts(&view.name)[..] {
        [word, own] => {
            let is_motor = words == POSITION && MOTOR.contains(&word.as_str());
            (words.contains(&word.as_str()) || is_motor) && *own == number
        }
        [word, side, own] => {
            let is_side = MOTOR.contains(&side.as_str()) || SENSOR.contains(&side.as_str());
            words.contains(&word.as_str()) && is_side && *own == number
        }
        _ => false,
    };
    let all = signals.iter();
    let named: Vec<&SignalView> = all.clone().filter(by_name).copied().collect();
    match named.is_empty() {
        true => all.filter(by_number).copied().collect(),
        false => named,
    }
}

/// Of the columns of one kind of a joint, that of the joint itself, and that of the other side of its
/// gear: a motor's position, or what a sensor shows.
fn sides(found: Vec<&SignalView>) -> (Option<&SignalView>, Option<&SignalView>) {
    let is_other = |view: &&&SignalView| {
        let words = parts(&view.name);
        let has = |of: &[&str]| words.iter().any(|word| of.contains(&word.as_str()));
        let is_position = !has(&EFFORT);
        is_position && has(&MOTOR) || !is_position && has(&SENSOR)
    };
    let other = found.iter().find(is_other).copied();
    let own = found.iter().find(|view| !is_other(view)).copied();
    match own {
        Some(_) => (own, other),
        None => (other, None),
    }
}

/// The lines of a joint whose gear is seen: by a second encoder, a torque sensor, or both.
fn gear(
    [motor, sensor]: [Option<&SignalView>; 2],
    position: Option<&SignalView>,
    units: (Dimension, Dimension),
) -> Vec<String> {
    let mut lines = Vec::new();
    if let Some(motor) = motor {
        let ratio = position.and_then(|joint| ratio(motor, joint));
        lines.push(match ratio {
            Some(ratio) => format!(
                "motor = {{ channel = {}, unit = {}, scale = {} }}   # guess; it turns {ratio} times as far as its joint",
                string(&motor.name),
                string(&unit_of(motor, units.0)),
                significant(1.0 / ratio, 6),
            ),
            None => format!(
                "motor = {{ channel = {}, unit = {} }}   # guess; `scale` is one by the gear ratio",
                string(&motor.name),
                string(&unit_of(motor, units.0)),
            ),
        });
    }
    if let Some(sensor) = sensor {
        lines.push(format!(
            "torque = {{ channel = {}, unit = {} }}   # guess; what passes the gear",
            string(&sensor.name),
            string(&unit_of(sensor, units.1)),
        ));
    }
    if motor.is_some() {
        lines.push(format!(
            "stiffness = {{ value = {FILL_IN:?}, unit = {} }}   # of the gear, as you know it; `rotor` is the motor's inertia at the joint",
            string(&units.1.per(units.0).to_string()),
        ));
    }
    lines
}

/// How many times as far as its joint a motor turns, a whole number; `None` where it turns as far, or the samples do not tell.
fn ratio(motor: &SignalView, joint: &SignalView) -> Option<f64> {
    let turned = |view: &SignalView| {
        let to_si = Unit::parse(&view.unit).map_or(1.0, |unit| unit.to_si);
        Some(to_si * view.span()?)
    };
    let times = turned(motor)? / turned(joint)?;
    (times.is_finite() && times >= LEAST_RATIO).then(|| times.round())
}

/// The unit of a column, or that of its kind: a unit of something else is the joint's business, and `diagnose` says so.
fn unit_of(view: &SignalView, dimension: Dimension) -> String {
    match Unit::parse(&view.unit) {
        Some(_) if !view.unit.is_empty() => view.unit.clone(),
        _ => dimension.to_string(),
    }
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
        (Some(own), _) => (own.name.clone(), unit_of(own, dimension)),
        (None, Some((topic, _))) => (
            format!("{topic}.{key}[name={joint}]"),
            dimension.to_string(),
        ),
        (None, None) => (FILL_IN.to_owned(), dimension.to_string()),
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

    #[test]
    fn a_second_encoder_and_a_torque_sensor_are_those_of_the_gear() {
        let both = begun(&[
            ("q_motor_1", "rad"),
            ("q1", "rad"),
            ("tau_sensor1", "N·m"),
            ("tau1", "N·m"),
            ("elbow_pos", "rad"),
            ("elbow_motor", "rad"),
            ("elbow_torque", "N·m"),
        ]);
        for line in [
            "position = { channel = \"q1\", unit = \"rad\" }",
            "effort = { channel = \"tau1\", unit = \"N·m\" }",
            "motor = { channel = \"q_motor_1\", unit = \"rad\" }   # guess; `scale`",
            "torque = { channel = \"tau_sensor1\", unit = \"N·m\" }   # guess",
            "position = { channel = \"elbow_pos\", unit = \"rad\" }",
            "motor = { channel = \"elbow_motor\"",
            "stiffness = { value = \"fill in\", unit = \"N·m/rad\" }",
        ] {
            assert!(both.contains(line), "{line}\n{both}");
        }
        let gear = |name: &str, times: f64| {
            SignalView::of(Channel {
                name: name.to_owned(),
                unit: "rad".to_owned(),
                samples: (0..40)
                    .map(|k| times * libm::sin(0.3 * f64::from(k)))
                    .collect(),
            })
        };
        assert_eq!(
            ratio(&gear("motor", 100.3), &gear("joint", 1.0)),
            Some(100.0)
        );
        assert_eq!(ratio(&gear("motor", 1.02), &gear("joint", 1.0)), None);
        // The only one that a motor has is the joint's.
        let alone = begun(&[("elbow_motor_pos", "rad"), ("elbow_torque_sensor", "N·m")]);
        assert!(
            alone.contains("position = { channel = \"elbow_motor_pos\"")
                && alone.contains("effort = { channel = \"elbow_torque_sensor\""),
            "{alone}"
        );
    }
}
