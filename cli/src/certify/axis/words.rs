//! This file says the certificate of an axis in plain words.

use std::path::Path;

use rigproof_certify::axis::certificate::{Certificate, LawSummary};
use rigproof_certify::axis::metrics::MetricSummary;

use super::super::words::changed;
use crate::text::number::significant;
use crate::text::{join, section};

/// What a person reads after a campaign.
pub fn certificate(certificate: &Certificate, file: &Path) -> String {
    let plan = &certificate.plan;
    let ended = certificate.ended;
    let not = certificate.not_looked_at.iter();
    join([
        verdict(certificate),
        section(
            "Laws, on every sample that they are about",
            certificate.laws.iter().map(law),
        ),
        section(
            "How the trials ended",
            [format!(
                "  {} trials: {} when their time was over, {} at a stop, {} without an answer",
                plan.scenarios, ended.time_over, ended.at_stop, ended.no_answer
            )],
        ),
        section("Metrics", certificate.metrics.iter().map(metric)),
        section(
            "Not looked at",
            not.map(|own| format!("  {}: {}", own.what, own.why)),
        ),
        vec![format!("Written: {}", file.display())],
    ])
}

fn verdict(certificate: &Certificate) -> Vec<String> {
    let mut lines = vec![match certificate.may_go() {
        true => format!(
            "May go on the rig: no law was broken in {} trials, {} samples.",
            certificate.plan.scenarios, certificate.samples
        ),
        false => "Must NOT go on the rig:".to_owned(),
    }];
    let reasons = certificate.reasons.iter();
    lines.extend(reasons.map(|reason| format!("  {reason}")));
    let broke = certificate.first_failure.iter();
    lines.extend(broke.map(|how| format!("  It broke first so: {how}")));
    lines.push(certificate.plan.axis.words());
    lines
}

fn law(law: &LawSummary) -> String {
    let worst = law
        .worst_margin
        .map_or("–".to_owned(), |worst| significant(worst, 3));
    let fared = match law.broken_in {
        0 if law.met_in < law.least_met => "TOO RARE".to_owned(),
        0 => "holds".to_owned(),
        count => format!("BROKEN in {count}"),
    };
    format!(
        "  {:<14} {fared:<14} {} samples of {} trials (at least {}); least margin {worst} {}",
        law.law.name(),
        law.samples,
        law.met_in,
        law.least_met,
        law.unit
    )
}

fn metric(metric: &MetricSummary) -> String {
    let own = metric.controller.map_or("not measured".to_owned(), |own| {
        format!(
            "median {}, 95 % below {}",
            significant(own.q50, 3),
            significant(own.q95, 3)
        )
    });
    let beside = metric.change.map_or(String::new(), |change| {
        format!("; {}", changed(&change, &metric.unit))
    });
    format!(
        "  {:<14} {own} {}{beside}",
        metric.metric.key(),
        metric.unit
    )
}
