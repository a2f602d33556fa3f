//! This file says a certificate in plain words.

use std::path::Path;

use rigproof_certify::calibration::Calibration;
use rigproof_certify::certificate::Certificate;
use rigproof_certify::cluster::Cluster;
use rigproof_certify::finding::Named;
use rigproof_certify::requirement::Requirement;
use rigproof_certify::search::NamedWorst;
use rigproof_certify::summary::{
    Change, Ended, Endings, LawSummary, Limited, MetricSummary, TieSummary, Visited, Word,
};

use super::campaign::CERTIFICATE;
use crate::shell;
use crate::text::number::significant;
use crate::text::{join, section};

/// What a person reads after a campaign; `library` is the compiled controller's, if it is one.
pub fn certificate(certificate: &Certificate, folder: &Path, library: Option<&Path>) -> String {
    let first = verdict(certificate);
    let findings = certificate.findings.iter();
    let findings = findings.map(|found| finding(found, folder, library));
    let scenarios = certificate.plan.scenarios;
    let laws = certificate.laws.iter().map(|own| law(own, scenarios));
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
        section(
            "What the failures have in common, the most frequent first",
            certificate
                .clusters
                .iter()
                .map(|own| cluster(own, folder, library)),
        ),
        section(&of_laws(certificate), laws),
        section(
            "What the laboratory asks for",
            certificate
                .requirements
                .iter()
                .filter(|own| own.is_own())
                .map(requirement),
        ),
        section(
            "Where the trials were: workspace × speed × force × fault",
            visited(&certificate.visited),
        ),
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

/// Whether it may go on the rig, why not, and what to look at.
fn verdict(certificate: &Certificate) -> Vec<String> {
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
    let cautions = certificate.cautions();
    let joined = if certificate.may_go() { "But" } else { "Also," };
    first.extend(
        cautions
            .iter()
            .map(|caution| format!("  {joined} {caution}.")),
    );
    let calibration = certificate.plan.calibration.iter();
    first.extend(calibration.map(Calibration::words));
    first
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

/// Trials that broke a law and have something in common, and one of them shrunk.
fn cluster(own: &Cluster, folder: &Path, library: Option<&Path>) -> String {
    let also: String = own
        .common
        .iter()
        .map(|common| {
            let others = significant(100.0 * common.others, 2);
            format!("; all with {} ({others} % of the others)", common.what)
        })
        .collect();
    let replay = own.example.as_ref().map(|example| {
        let file = folder.join(&example.file);
        let mut words = vec![("--replay", file.as_path())];
        words.extend(library.map(|library| ("--controller", library)));
        format!("\n    {}", shell::line(&["rigproof", "certify"], &words))
    });
    format!(
        "  {:<14} trials: {}, {} % of all failures: {}, {}{also}{}",
        own.law.name(),
        own.trials,
        significant(100.0 * own.share, 2),
        own.place,
        own.fault,
        replay.unwrap_or_default()
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

fn law(law: &LawSummary, scenarios: u64) -> String {
    let worst = law
        .worst_margin
        .map_or("–".to_owned(), |worst| significant(worst, 3));
    let broken = match law.broken_in {
        _ if law.samples == 0 => "NOT HELD".to_owned(),
        0 if !law.is_met() => "TOO RARE".to_owned(),
        0 => "holds".to_owned(),
        count => format!("BROKEN in {count}"),
    };
    format!(
        "  {:<14} {broken:<14} met in {:>9} of {:>9} samples, {} of {scenarios} trials (at least {}), {} of {} cells; least margin {worst} {}",
        law.law.name(),
        law.met.samples,
        law.samples,
        law.met.trials,
        law.met.least_trials,
        law.met.cells,
        law.met.of_cells,
        law.unit
    )
}

/// A sentence that is asked for, and how it fared.
fn requirement(own: &Requirement) -> String {
    let margin = own.margin.map_or_else(
        || "–".to_owned(),
        |margin| format!("{} {}", significant(margin, 3), own.unit),
    );
    format!(
        "  {} “{}”: {}, {} trials, margin {margin}",
        if own.holds { "✔" } else { "✘" },
        own.says,
        own.by.name(),
        own.trials
    )
}

/// How many cells a sample lay in, and the first of the others.
fn visited(visited: &Visited) -> Vec<String> {
    const SHOWN: usize = 5;
    let mut lines = vec![format!(
        "  {} of {} cells visited",
        visited.visited, visited.cells
    )];
    let never = &visited.never;
    lines.extend(
        never
            .iter()
            .take(SHOWN)
            .map(|cell| format!("  never: {cell}")),
    );
    if never.len() > SHOWN {
        let more = never.len() - SHOWN;
        lines.push(format!("  and {more} more, in {CERTIFICATE}"));
    }
    lines
}

fn ended(ended: &Ended) -> Vec<String> {
    let of = |whose: &str, endings: &Endings| {
        let Endings {
            finished,
            finished_then_stopped,
            stopped,
            time_over,
            no_answer,
        } = endings;
        format!(
            "  {whose:<16} {} trials: {finished} came to the path's end, {finished_then_stopped} did and ended at the stops on the way back, {stopped} ended at the stops, {time_over} when their time was over, {no_answer} without an answer",
            endings.each().iter().sum::<u64>()
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
pub fn changed(change: &Change, unit: &str) -> String {
    let word = match change.word {
        Word::Better => "better than the baseline",
        Word::Worse => "worse than the baseline",
        Word::NoDifference => "no difference from the baseline",
    };
    let [low, high] = change.interval;
    let own = &change.exact;
    let mean = format!(
        "{word}: {} [{} to {}] {unit}",
        significant(change.mean, 3),
        significant(low, 3),
        significant(high, 3),
    );
    format!(
        "{}; better in {} of {} pairs, worse in {} (exact sign test: p = {})",
        mean.trim_end(),
        own.better,
        change.pairs,
        own.worse,
        significant(own.p, 2)
    )
}

fn metric(metric: &MetricSummary) -> String {
    let quantiles = metric.controller.map_or("not measured".to_owned(), |own| {
        format!(
            "median {}, 95 % below {}, greatest {} {}{}",
            significant(own.q50, 3),
            significant(own.q95, 3),
            significant(own.greatest, 3),
            metric.unit,
            metric
                .worst_scenario
                .map_or_else(String::new, |index| format!(" in trial {index}"))
        )
    });
    let change = metric.change.map_or_else(String::new, |change| {
        format!("; {}", changed(&change, &metric.unit))
    });
    let limit = |limit: &Limited| {
        let word = if limit.holds {
            "within its limit"
        } else {
            "BEYOND ITS LIMIT"
        };
        format!("\n    {word}: {}", limit.words)
    };
    let limits: String = metric.limits.iter().map(limit).collect();
    format!("  {:<16} {quantiles}{change}{limits}", metric.metric.key())
}
