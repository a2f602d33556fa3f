//! This file lets a five-bar's model run freely along a recording and says how far the two lie apart.

use rigproof_diagnose::plants::five_bar::free_run::{Model, Simulated, simulated};
use rigproof_diagnose::plants::five_bar::from_rig::aligned;
use rigproof_diagnose::plants::five_bar::run::FiveBarRun;
use rigproof_diagnose::{Description, Measured};
use rigproof_trace::compare::{Comparison, compare};
use rigproof_trace::rig::five_bar::{FiveBar, layout_name};
use rigproof_trace::{Channel, Trace, csv};
use serde_json::{Value, json};

use super::{Args, experiment, measures, path, read_as, refusal};
use crate::input::{self, HowRead};
use crate::outcome::{Failure, Outcome, print};
use crate::progress;

/// The outputs that are compared, and their units.
const OUTPUTS: [(&str, &str); 3] = [("theta_a", "rad"), ("theta_b", "rad"), ("tip", "m")];

/// Simulates, compares, and writes both outputs.
pub fn run(args: &Args, rig: &FiveBar) -> Result<Outcome, Failure> {
    let source = &args.source;
    if let Some(plan) = experiment::plan(args, rig)? {
        return experiment::run(args, rig, &plan, &model(args, rig)?);
    }
    let description = Description::FiveBar(rig.clone());
    let read = input::measured(&description, &source.recording, source.cut, &source.reading)?;
    let (Measured::FiveBar(recording), how) = read else {
        let problem = "it is no recording of a five-bar".to_owned();
        return Err(Failure::unusable(&source.recording, problem));
    };
    let model = model(args, rig)?;
    let run = aligned(rig, &recording)
        .map_err(|fault| Failure::Input(refusal(&source.recording, &fault)))?;
    let mark = progress::spinner("simulating");
    let simulated = simulated(&Model::of(&model), &run, args.restart_s)
        .map_err(|error| Failure::unusable(file(args), error.to_string()))?;
    drop(mark);
    let off = compared(&run, &simulated)?;
    if let Some(out) = &args.out {
        let first_s = recording.time_s.first().copied().unwrap_or(0.0);
        csv::write(out, &trace(&run, &simulated, first_s))?;
    }
    say(args, &simulated, &off, &how)
}

/// The file whose numbers count.
pub fn file(args: &Args) -> &std::path::Path {
    args.calibration.as_ref().unwrap_or(&args.source.rig)
}

/// The description whose numbers count.
fn model(args: &Args, rig: &FiveBar) -> Result<FiveBar, Failure> {
    let Some(calibration) = &args.calibration else {
        return Ok(rig.clone());
    };
    match Description::read(calibration)? {
        Description::FiveBar(model) if model.layout == rig.layout => Ok(model),
        _ => {
            let problem = format!(
                "the rig is a five-bar, {}, the calibration is of another one; give the calibration of this rig",
                layout_name(rig.layout)
            );
            Err(Failure::unusable(calibration, problem))
        }
    }
}

/// How far the angles and the tip are off, where a sample was recorded and no run had broken off.
fn compared(run: &FiveBarRun, simulated: &Simulated) -> Result<[Comparison; 3], Failure> {
    let counted = |recorded: &[f64]| -> Vec<f64> {
        let pairs = recorded.iter().zip(&run.recorded);
        pairs
            .map(|(x, own)| if *own { *x } else { f64::NAN })
            .collect()
    };
    let [a, b] = &simulated.theta_rad;
    let [recorded_a, recorded_b] = &simulated.recorded_rad;
    let off = &simulated.tip_off_m;
    Ok([
        compare(&counted(recorded_a), a)?,
        compare(&counted(recorded_b), b)?,
        compare(&counted(&vec![0.0; off.len()]), off)?,
    ])
}

fn trace(run: &FiveBarRun, simulated: &Simulated, first_s: f64) -> Trace {
    let channel = |name: &str, unit: &str, samples: &[f64]| Channel {
        name: name.to_owned(),
        unit: unit.to_owned(),
        samples: samples.to_vec(),
    };
    let [a, b] = &simulated.theta_rad;
    let [recorded_a, recorded_b] = &simulated.recorded_rad;
    let times = (0..run.len()).map(|k| first_s + run.start_s + k as f64 * run.step_s);
    Trace {
        time_s: times.collect(),
        channels: vec![
            channel("theta_a_recorded", "rad", recorded_a),
            channel("theta_a_simulated", "rad", a),
            channel("theta_b_recorded", "rad", recorded_b),
            channel("theta_b_simulated", "rad", b),
            channel("tip_off", "m", &simulated.tip_off_m),
        ],
    }
}

fn say(
    args: &Args,
    simulated: &Simulated,
    off: &[Comparison; 3],
    how: &HowRead,
) -> Result<Outcome, Failure> {
    if args.json {
        let of = |((name, unit), off): (&(&str, &str), &Comparison)| {
            let value = json!({
                "unit": unit,
                "samples": off.pairs,
                "rms": off.rms,
                "maximum": off.maximum,
                "nrmse_percent": off.nrmse_percent,
            });
            ((*name).to_owned(), value)
        };
        let outputs: serde_json::Map<String, Value> = OUTPUTS.iter().zip(off).map(of).collect();
        let result = json!({
            "recording": args.source.recording.display().to_string(),
            "read_as": how.json(),
            "rig": args.source.rig.display().to_string(),
            "calibration": path(&args.calibration),
            "restart_s": args.restart_s,
            "runs": simulated.runs,
            "broken_off": simulated.broken_off,
            "outputs": outputs,
            "file": path(&args.out),
        });
        return print(&result.to_string());
    }
    let mut lines = vec![format!(
        "simulated less recorded in {} free runs of {} s, each from the recorded state",
        simulated.runs, args.restart_s,
    )];
    if simulated.broken_off > 0 {
        lines.push(format!(
            "  {} of them drove the linkage out of its assembly and count up to there",
            simulated.broken_off
        ));
    }
    for ((name, unit), off) in OUTPUTS.iter().zip(off) {
        lines.push(format!("{name}, {} samples", off.pairs));
        let measures = measures(off, unit);
        let shown = if *name == "tip" { 2 } else { 3 };
        lines.extend(measures.into_iter().take(shown));
    }
    lines.extend(read_as(how));
    lines.extend(path(&args.out).map(|file| format!("  file     {file}")));
    print(&lines.join("\n"))
}
