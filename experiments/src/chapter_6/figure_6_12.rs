//! Figure 6.12: one run of a simulated operator with the low gain on the 3-brake configuration.

use rigproof_model::control::GainUnit;
use rigproof_model::control::path::Line;
use rigproof_model::metrics::acceleration;
use rigproof_model::operator::Abilities;
use rigproof_model::trial::{LINES, Metrics, Record, trial};
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::{Method, SAMPLE_STEP_S};
use rigproof_spec::trials::{Averages, OPERATORS, averages};

use super::sample;
use crate::outline::cm;
use crate::{Curve, Error, Experiment, Finding, Outcome, Panel, Picture};

/// The sample.
pub const EXPERIMENT: Experiment = Experiment {
    id: "6.12",
    title: "Sample of human subject data using low gain proportional velocity control in the 3-brake configuration",
    what: "One run of the simulated operator along line 1 with the low gain of table 6.1 in N·s/cm and as printed; the person's run is lost.",
    run,
};

const LAYOUT: Layout = Layout::ThreeBrake;
/// The run that is shown: the operator's aim and tremor.
const SEED: u64 = 1071;

fn run() -> Result<Outcome, Error> {
    let refused = |error| Error::model("a trial of the simulated operator", error);
    let segment = LINES[0];
    let line = Line::through(segment.from_m, segment.to_m).map_err(refused)?;
    let of = |method, unit| -> Result<(Record, Metrics), Error> {
        let record = trial(LAYOUT, method, unit, segment, Abilities::CAREFUL, SEED);
        let record = record.map_err(refused)?;
        let metrics = record.metrics(&line).map_err(refused)?;
        Ok((record, metrics))
    };
    let (none, uncontrolled) = of(Method::Uncontrolled, GainUnit::PerCentimetre)?;
    let (low, ours) = of(Method::ProportionalLow, GainUnit::PerCentimetre)?;
    let (printed, as_printed) = of(Method::ProportionalLow, GainUnit::PerMetre)?;
    let runs = [
        ("no control", &none),
        ("5 N·s/cm", &low),
        ("5 N·s/m as printed", &printed),
    ];
    let [from, to] = [segment.from_m, segment.to_m].map(|end| end.map(cm));
    let ways = runs.iter().map(|(name, record)| sample::way(name, record));
    let mut map: Vec<Curve> = ways.collect();
    map.push(Curve::thin(
        "desired path",
        &[from[0], to[0]],
        &[from[1], to[1]],
    ));
    Ok(Outcome {
        tables: vec![
            sample::table("no-control", &none, &line, LAYOUT),
            sample::table("low-gain", &low, &line, LAYOUT),
            sample::table("low-gain-as-printed", &printed, &line, LAYOUT),
        ],
        pictures: vec![Picture {
            name: "sample".to_owned(),
            title: "A simulated operator with low gain proportional control, 3-brake configuration"
                .to_owned(),
            subtitle: "line 1; the person's run is lost; currents: 5 N·s/cm, each brake 1.25 A above the one before"
                .to_owned(),
            panels: vec![
                Panel::new(("x", "cm"), ("y", "cm"), map).map(),
                sample::distances(&runs, &line),
                sample::forces(&runs),
                sample::commands(&low, LAYOUT),
            ],
        }],
        findings: vec![
            shown("no control", &uncontrolled),
            shown("5 N·s/cm", &ours),
            shown("5 N·s/m as printed", &as_printed),
            vibration(&none, &low)?,
            beside("average path error", "cm", cm(ours.path_error_m), |cell| {
                cell.path_error_cm
            }),
            beside("average tip force", "N", ours.tip_force_n, |cell| {
                cell.tip_force_n
            }),
        ],
    })
}

fn shown(name: &str, metrics: &Metrics) -> Finding {
    Finding::lost(
        "figure 6.12",
        format!("one run, {name}"),
        format!(
            "{:.3} cm, {:.2} N, {:.2e} m/s³",
            cm(metrics.path_error_m),
            metrics.tip_force_n,
            metrics.dft_sum_m_s3
        ),
        "the person's run is lost; path error, tip force and DFT sum of the one shown here",
    )
}

/// "The low gain was chosen such that there was no detectable vibration."
fn vibration(none: &Record, low: &Record) -> Result<Finding, Error> {
    let rms = |record: &Record| -> Result<f64, Error> {
        let acceleration = acceleration(&record.tips_m, SAMPLE_STEP_S)
            .map_err(|error| Error::model("the acceleration of the tip", error))?;
        let squares: f64 = acceleration.iter().map(|[x, y]| x * x + y * y).sum();
        Ok(libm::sqrt(squares / acceleration.len() as f64))
    };
    let (without, with) = (rms(none)?, rms(low)?);
    Ok(Finding {
        stated: "none detectable".to_owned(),
        ..Finding::lost(
            "§6.5.1",
            "the low gain was chosen such that there was no detectable vibration",
            format!(
                "acceleration below 25 Hz {with:.2} m/s² rms, without control {without:.2} m/s²"
            ),
            "the text gives no limit of detection",
        )
    })
}

/// Whether the run lies within a factor of two of what the three people had under the same conditions.
fn beside(name: &str, unit: &str, ours: f64, of: fn(&Averages) -> f64) -> Finding {
    let cells = OPERATORS.map(|operator| averages(operator, LAYOUT, Method::ProportionalLow, 1));
    let people: Vec<f64> = cells.iter().flatten().map(of).collect();
    let least = people.iter().copied().fold(f64::INFINITY, f64::min);
    let most = people.iter().copied().fold(0.0, f64::max);
    Finding::claim(
        "tables C.1 to C.3",
        format!("line 1, low gain: the {name}"),
        format!("{least} to {most} {unit}"),
        (
            format!("{ours:.3} {unit}"),
            (0.5 * least..=2.0 * most).contains(&ours),
        ),
        "within a factor of two of the three people's means",
    )
}
