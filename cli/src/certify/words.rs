//! This file says a certificate in plain words.

use std::path::Path;

use rigproof_certify::calibration::Calibration;
use rigproof_certify::certificate::Certificate;
use rigproof_certify::finding::Named;
use rigproof_certify::search::NamedWorst;
use rigproof_certify::summary::{
    Change, Ended, Endings, LawSummary, MetricSummary, TieSummary, Word,
};

use super::campaign::CERTIFICATE;
use crate::shell;
use crate::text::number::significant;
use crate::text::{join, section};

/// What a person reads after a campaign; `library` is the compiled controller's, if it is one.
pub fn certificate(certificate: &Certificate, folder: &Path, library: Option<&Path>) -> String {
    let verdict = match certificate.may_go() {
        true => format!(
            "May go on the rig: no law was broken in {} scenarios, {} samples.",
            certificate.plan.scenarios, certificate.samples
        ),
        false => "Must NOT go on the rig:".to_owned(),
    };
    let mut first = vec![verdict];
    first.extend(
        certificate
            .reasons
            .iter()
            .map(|reason| format!("  {reason}")),
    );
    let calibration = certificate.plan.calibration.iter();
    first.extend(calibration.map(Calibration::words));
    let findings = certificate.findings.iter();
    let findings = findings.map(|found| finding(found, folder, library));
    let laws = certificate.laws.iter().map(law);
    let not = certificate
        .not_looked_at
        .iter()
        .map(|not| format!("  {}: {}", not.what, not.why));
    let file = folder.join(CERTIFICATE);
    let proved = format!(
        "  {} claims. {}",
        certificate.proved.claims.len(),
        certificate.proved.words
    );
    join([
        first,
        section("Findings", findings),
        section(&of_laws(certificate), laws),
        section(
            "Ties: samples in which the reference may decide otherwise",
            certificate.ties.iter().map(tie),
        ),
        section("How the trials ended", ended(&certificate.ended)),
        section("Metrics", certificate.metrics.iter().map(metric)),
        section(
            "Worse cases that a search found; it proves nothing",
            certificate
                .worst
                .iter()
                .map(|worst| worse(worst, folder, library)),
        ),
        section("Proved", [proved]),
        section("Not looked at", not),
        vec![format!("Written: {}", file.display())],
    ])
}

/// A finding, how it is run again, and how the controller broke.
fn finding(found: &Named, folder: &Path, library: Option<&Path>) -> String {
    let file = folder.join(&found.file);
    let mut words = vec![("--replay", file.as_path())];
    words.extend(library.map(|library| ("--controller", library)));
    let replay = shell::line(&["rigproof", "certify"], &words);
    let broke = found.failure.as_ref();
    let broke = broke.map_or_else(String::new, |how| format!("\n    {how}"));
    format!(
        "  {}: scenario {}, shrunk to {} s: {replay}{broke}",
        found.law.name(),
        found.scenario,
        significant(found.time_s, 3)
    )
}

fn worse(worst: &NamedWorst, folder: &Path, library: Option<&Path>) -> String {
    let file = folder.join(&worst.file);
    let mut words = vec![("--replay", file.as_path())];
    words.extend(library.map(|library| ("--controller", library)));
    format!(
        "  {:<16} drawn {}, found {} {} in {} trials: {}",
        worst.target.name(),
        significant(worst.drawn, 3),
        significant(worst.found, 3),
        worst.unit,
        worst.trials,
        shell::line(&["rigproof", "certify"], &words)
    )
}

/// On which samples the laws were looked at.
fn of_laws(certificate: &Certificate) -> String {
    let claim = certificate.plan.controller.declared.reference;
    let beside = claim.map_or(0, |claim| claim.every);
    match beside {
        0 | 1 => "Laws, on every sample they are about".to_owned(),
        every => format!(
            "Laws, on every sample they are about; beside the reference one sample of {every}"
        ),
    }
}

fn tie(tie: &TieSummary) -> String {
    format!(
        "  {:<14} in {} trials of at most {}, {} samples: {}",
        tie.tie.name(),
        tie.trials,
        tie.most,
        tie.samples,
        tie.words
    )
}

fn law(law: &LawSummary) -> String {
    let worst = law
        .worst_margin
        .map_or("–".to_owned(), |worst| significant(worst, 3));
    let broken = match law.broken_in {
        _ if law.samples == 0 => "NOT HELD".to_owned(),
        0 => "holds".to_owned(),
        count => format!("BROKEN in {count}"),
    };
    format!(
        "  {:<14} {broken:<14} {:>12} samples, worst margin {worst} {}",
        law.law.name(),
        law.samples,
        law.unit
    )
}

fn ended(ended: &Ended) -> Vec<String> {
    let of = |whose: &str, endings: &Endings| {
        let Endings {
            finished,
            time,
            left_workspace,
            no_answer,
        } = endings;
        format!(
            "  {whose:<16} {finished} of {} came to the path's end; {left_workspace} ended at the stops, {no_answer} without an answer",
            time + left_workspace + no_answer
        )
    };
    let mut lines = vec![of("the controller", &ended.controller)];
    lines.extend(ended.baseline.iter().map(|own| of("the baseline", own)));
    let changes = [
        ("unfinished", &ended.unfinished),
        ("at the stops", &ended.stopped),
    ];
    lines.extend(changes.into_iter().filter_map(|(what, change)| {
        let change = change.as_ref()?;
        Some(format!("  {what:<16} share: {}", changed(change, "")))
    }));
    lines
}

/// A change from the baseline.
fn changed(change: &Change, unit: &str) -> String {
    let word = match change.word {
        Word::Better => "better than the baseline",
        Word::Worse => "worse than the baseline",
        Word::NoDifference => "no difference from the baseline",
    };
    let [low, high] = change.interval;
    format!(
        "{word}: {} [{} to {}] {unit}",
        significant(change.mean, 3),
        significant(low, 3),
        significant(high, 3),
    )
    .trim_end()
    .to_owned()
}

fn metric(metric: &MetricSummary) -> String {
    let quantiles = metric.controller.map_or("not measured".to_owned(), |own| {
        format!(
            "median {}, 95 % below {} {}",
            significant(own.q50, 3),
            significant(own.q95, 3),
            metric.unit
        )
    });
    let change = metric.change.map_or_else(String::new, |change| {
        format!("; {}", changed(&change, &metric.unit))
    });
    let beyond: String = metric
        .beyond
        .iter()
        .map(|beyond| format!("\n    BEYOND ITS LIMIT: {}", beyond.words))
        .collect();
    format!("  {:<16} {quantiles}{change}{beyond}", metric.metric.key())
}
