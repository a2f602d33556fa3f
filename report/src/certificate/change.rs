//! This file draws by how much a controller is better or worse than the baseline.

use maud::{Markup, html};
use rigproof_certify::summary::{MetricSummary, Word};

use crate::forest::{Forest, Mark};

/// Shares of the baseline's mean beyond which nothing is drawn, %: a metric does not get better by more than all of it.
const LIMITS: [f64; 2] = [-100.0, 200.0];

/// The changes with their intervals; nothing where none was measured.
pub fn figure(metrics: &[MetricSummary]) -> Markup {
    let rows = metrics.iter().filter_map(|metric| {
        let (change, mean) = (metric.change?, metric.baseline?.mean);
        let share = |value: f64| 100.0 * value / mean;
        let (what, role) = match change.word {
            Word::Better => ("better", "noise"),
            Word::Worse => ("worse", "old"),
            Word::NoDifference => ("no difference", "recorded"),
        };
        let mark = Mark {
            what,
            role,
            value: share(change.mean),
            interval: change.interval.map(share),
            remark: change.pairs.to_string(),
        };
        (mean > 0.0).then(|| (metric.words.clone(), vec![mark]))
    });
    let forest = Forest {
        id: "changes",
        title: "Against what is on the rig now",
        scale: "change, % of the baseline's mean",
        remark: "pairs of trials",
        rows: rows.collect(),
        limits: LIMITS,
    };
    forest.figure(&html! { "Less is better in every line: left of the upright line the controller is better than the baseline, right of it worse. A bar that touches the line says that these trials show no difference." })
}
