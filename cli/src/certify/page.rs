//! This file makes the page of a certificate, with the worst case run again.

use std::path::Path;

use rigproof_certify::certificate::Certificate;
use rigproof_certify::controller::Task;
use rigproof_certify::finding::Finding;
use rigproof_certify::journal::Chunks;
use rigproof_certify::metrics::Metric;
use rigproof_certify::plan::{Plan, Sources};
use rigproof_certify::scenario::Scenario;
use rigproof_certify::trial::{self, Ran};
use rigproof_certify::way::Way;
use rigproof_model::control::path::Path as _;
use rigproof_report::certificate::{Beside, Run, page};
use rigproof_spec::methods::SAMPLE_STEP_S;

use crate::outcome::Failure;
use crate::shell;

/// Points of a curved path between two that it is made of.
const BETWEEN: u32 = 24;

/// The page as HTML; `run` is what [`worst`] gave, `library` the compiled controller's, if it is one.
pub fn html(
    certificate: &Certificate,
    run: Option<&Run>,
    folder: &Path,
    library: Option<&Path>,
) -> String {
    let replay = |file: &str| {
        let file = folder.join(file);
        let mut words = vec![("--replay", file.as_path())];
        words.extend(library.map(|library| ("--controller", library)));
        shell::line(&["rigproof", "certify"], &words)
    };
    let replay = &replay;
    page(certificate, &Beside { run, replay })
}

/// What broke a law first, or the trial with the greatest path error; `None` where no trial has one.
///
/// # Errors
/// The scenario cannot be run.
pub fn worst(
    plan: &Plan,
    sources: &Sources<'_>,
    chunks: &Chunks,
    first: Option<&Finding>,
) -> Result<Option<Run>, Failure> {
    if let Some(finding) = first {
        let ran = finding.replayed(sources.controller)?;
        let again = ran.broken().find(|(law, _)| *law == finding.law);
        let at = again.and_then(|(_, fared)| fared.first);
        let words = format!(
            "What broke the law {} in trial {}, made as short and plain as it goes: {}.",
            finding.law.name(),
            finding.scenario_index,
            finding.words
        );
        let at_s = at.map(|tick| f64::from(tick) * SAMPLE_STEP_S);
        return Ok(Some(shown(words, &finding.scenario, &ran, at_s)));
    }
    let error = |record: &&rigproof_certify::record::Record| {
        let error = record.measured.get(Metric::PathError as usize);
        error.copied().flatten().filter(|error| error.is_finite())
    };
    let records = chunks.values().flatten();
    let greatest = records
        .filter_map(|record| Some((error(&record)?, record.index)))
        .max_by(|a, b| a.0.total_cmp(&b.0));
    let Some((error_m, index)) = greatest else {
        return Ok(None);
    };
    let scenario = plan.scenario(index);
    let declared = &plan.controller.declared;
    let words = format!(
        "The trial with the greatest path error, {:.1} mm in the mean: trial {index} of seed {}.",
        1e3 * error_m,
        plan.seed
    );
    let ran = trial::run(&scenario, sources.controller, declared, true);
    Ok(ran.map(|ran| shown(words, &scenario, &ran, None)))
}

fn shown(words: String, scenario: &Scenario, ran: &Ran, broken_at_s: Option<f64>) -> Run {
    let way = Way::new(&scenario.task);
    let offset = |tip: [f64; 2]| way.as_ref().map(|way| way.nearest(tip).offset_m);
    let tip_m: Vec<[f64; 2]> = ran.states.iter().map(|state| state.tip_m).collect();
    Run {
        words,
        step_s: SAMPLE_STEP_S,
        path_m: way
            .as_ref()
            .map_or_else(Vec::new, |way| points(&scenario.task, way)),
        offset_m: tip_m.iter().filter_map(|tip| offset(*tip)).collect(),
        tip_m,
        force_n: ran.states.iter().map(|state| state.force_n).collect(),
        currents_a: ran.told.iter().map(|(_, currents_a)| *currents_a).collect(),
        broken_at_s,
    }
}

/// Points along a path, m.
fn points(task: &Task, way: &Way) -> Vec<[f64; 2]> {
    let between = |k: u32| f64::from(k) / f64::from(BETWEEN);
    match task {
        Task::Chain(points) => points.clone(),
        Task::Arc {
            centre_m: [x, y],
            radius_m,
            from_rad,
            to_rad,
        } => (0..=BETWEEN)
            .map(|k| {
                let (sine, cosine) = libm::sincos(from_rad + between(k) * (to_rad - from_rad));
                [x + radius_m * cosine, y + radius_m * sine]
            })
            .collect(),
        // What lies on the chords is taken to the curve.
        Task::Spline(points) => points
            .windows(2)
            .filter_map(|pair| Some((*pair.first()?, *pair.last()?)))
            .flat_map(|([ax, ay], [bx, by])| {
                (0..=BETWEEN).map(move |k| {
                    let share = between(k);
                    [ax + share * (bx - ax), ay + share * (by - ay)]
                })
            })
            .map(|chord| way.nearest(chord).foot_m.into())
            .collect(),
    }
}
