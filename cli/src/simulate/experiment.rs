//! This file plays an experiment on the reference rig and writes down what the rig would record.

use rigproof_diagnose::Description;
use rigproof_diagnose::plants::five_bar::experiment::plan::{MIDDLE_M, Plan};
use rigproof_diagnose::plants::five_bar::experiment::play::{Played, play, with_effects};
use rigproof_diagnose::plants::five_bar::free_run::Model;
use rigproof_trace::csv;
use rigproof_trace::rig::five_bar::FiveBar;
use serde_json::json;

use super::{Args, file, path};
use crate::outcome::{Failure, Outcome, print};
use crate::progress;
use crate::text::number::{significant, with_unit};

/// The experiment in the file that was given; `None` where it is a recording.
pub fn plan(args: &Args, rig: &Description) -> Result<Option<(FiveBar, Plan)>, Failure> {
    let Description::FiveBar(rig) = rig else {
        return Ok(None);
    };
    let source = &args.source.recording;
    // What cannot be read as an experiment is read as a recording, with all that was said about its dialect.
    let Ok(trace) = csv::read(source) else {
        return Ok(None);
    };
    let [theta_a, _] = &rig.channels.theta;
    if !Plan::is_in(&trace) || trace.channel(&theta_a.channel).is_some() {
        return Ok(None);
    }
    let plan = Plan::of(&trace, rig.layout);
    plan.map(|plan| Some((rig.clone(), plan)))
        .map_err(|problem| Failure::unusable(source, problem))
}

/// Plays a plan with a model, and writes what is recorded of it.
pub fn run(
    args: &Args,
    (rig, plan): &(FiveBar, Plan),
    model: &Description,
) -> Result<Outcome, Failure> {
    let Description::FiveBar(model) = model else {
        return Err(Failure::unusable(
            file(args),
            "it is of another plant".to_owned(),
        ));
    };
    let mark = progress::spinner("simulating");
    let own = Model::of(model);
    with_effects(&own, rig.layout, MIDDLE_M)
        .map_err(|error| Failure::unusable(file(args), error.to_string()))?;
    let played = play(&own, rig.layout, plan)
        .map_err(|error| Failure::unusable(&args.source.recording, error.to_string()))?;
    drop(mark);
    let said = say(args, &played)?;
    if let Some(out) = &args.out {
        let played = match args.seed {
            Some(seed) => played.sensed(rig, seed),
            None => played,
        };
        let recording = played.recording(rig.layout, Default::default());
        csv::write(out, &rig.trace(&recording, &args.source.rig)?)?;
    }
    print(&said)
}

fn say(args: &Args, played: &Played) -> Result<String, Failure> {
    let count = played.time_s.len();
    let duration_s = played.time_s.last().copied().unwrap_or(0.0);
    let [force_x, force_y] = &played.force_n;
    let forces = force_x.iter().zip(force_y);
    let greatest_n = forces.map(|(x, y)| libm::hypot(*x, *y)).fold(0.0, f64::max);
    let travels = played.theta_rad.each_ref().map(|theta| {
        let low = theta.iter().copied().fold(f64::INFINITY, f64::min);
        theta.iter().copied().fold(f64::NEG_INFINITY, f64::max) - low
    });
    let [travel_a, travel_b] = travels;
    if args.json {
        let result = json!({
            "experiment": args.source.recording.display().to_string(),
            "rig": args.source.rig.display().to_string(),
            "calibration": path(&args.calibration),
            "seed": args.seed,
            "samples": count,
            "duration_s": duration_s,
            "greatest_force_n": greatest_n,
            "travel_rad": { "theta_a": travel_a, "theta_b": travel_b },
            "file": path(&args.out),
        });
        return Ok(result.to_string());
    }
    let mut lines = vec![
        format!(
            "played an experiment of {} on the reference rig",
            with_unit(duration_s, "s")
        ),
        format!("  samples  {count}"),
        format!("  hand     at most {}", with_unit(greatest_n, "N")),
        format!(
            "  travel   {} and {} rad of θA and θB",
            significant(travel_a, 3),
            significant(travel_b, 3)
        ),
    ];
    lines.push(match path(&args.out) {
        Some(file) => format!("  file     {file}"),
        None => "  file     none; give --out to keep what the rig would record".to_owned(),
    });
    Ok(lines.join("\n"))
}
