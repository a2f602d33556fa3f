//! This file is the page of a certificate: may it go on the rig, why not, what was tested, what was proved and what nobody looked at.

pub mod axis;
mod change;
mod coverage;
mod run;

use maud::{Markup, html};
use rigproof_certify::certificate::Certificate;
use rigproof_certify::cluster::Cluster;
use rigproof_certify::search::NamedWorst;
use rigproof_certify::summary::{Change, LawSummary, MetricSummary, TieSummary, Word};

use crate::chart::Chart;
use crate::document::{Document, Headline, Section, Tone};
use crate::number::{grouped, significant};
use crate::table::table;
use crate::words::capital;

pub use run::Run;

/// What a page shows beside the certificate.
pub struct Beside<'a> {
    /// The worst case, run again.
    pub run: Option<&'a Run>,
    /// The command that runs a file of the certificate's folder again.
    pub replay: &'a dyn Fn(&str) -> String,
}

/// The page of a certificate as HTML.
pub fn page(certificate: &Certificate, beside: &Beside<'_>) -> String {
    let headline = headline(certificate);
    let mut charts = Vec::new();
    let sections = sections(certificate, beside, &mut charts);
    Document {
        title: format!("{} – {}", headline.sentence, certificate.name),
        kind: "Certificate",
        about: certificate.name.clone(),
        headline,
        sections,
        charts,
        replay: None,
        served: None,
        footer: format!(
            "Written by rigproof {} from certificate.json, which alone counts: check it with `rigproof certify --check`. This page is one file: it loads nothing and sends nothing.",
            certificate.tool.version
        ),
    }
    .to_html()
}

/// What broke a law is shown at once; where nothing did, the laws come first.
fn sections(
    certificate: &Certificate,
    beside: &Beside<'_>,
    charts: &mut Vec<Chart>,
) -> Vec<Section> {
    let section = |id: &str, heading: &str, body: Markup| Section {
        id: id.to_owned(),
        heading: heading.to_owned(),
        body,
    };
    let mut sections = Vec::new();
    if !certificate.findings.is_empty() {
        sections.push(section(
            "findings",
            "What broke a law",
            findings(certificate, beside.replay),
        ));
    }
    if !certificate.clusters.is_empty() {
        sections.push(section(
            "clusters",
            "What the failures have in common",
            clusters(certificate, beside.replay),
        ));
    }
    let run = beside.run.map(|run| {
        let heading = match certificate.findings.is_empty() {
            true => "The worst of the trials, run again",
            false => "What broke a law first, run again",
        };
        section("run", heading, run.body(charts))
    });
    let (first, last) = match certificate.findings.is_empty() {
        true => (None, run),
        false => (run, None),
    };
    sections.extend(first);
    sections.push(section("laws", "The laws", laws(&certificate.laws)));
    sections.push(section(
        "coverage",
        "How often each law was met, and where",
        coverage::coverage(certificate),
    ));
    if !certificate.ties.is_empty() {
        sections.push(section("ties", "Ties", ties(&certificate.ties)));
    }
    if !certificate.worst.is_empty() {
        sections.push(section(
            "worst",
            "What a search made worse",
            worst(certificate, beside.replay),
        ));
    }
    sections.push(section(
        "metrics",
        "How it feels and how well it guides",
        html! { (change::figure(&certificate.metrics)) (coverage::limits(&certificate.metrics)) (metrics(&certificate.metrics)) },
    ));
    sections.extend(last);
    sections.extend(of_the_plan(certificate));
    sections
}

/// What was asked for, proved, left out, and what all of it depends on.
fn of_the_plan(certificate: &Certificate) -> [Section; 4] {
    let section = |id: &str, heading: &str, body: Markup| Section {
        id: id.to_owned(),
        heading: heading.to_owned(),
        body,
    };
    [
        section(
            "requirements",
            "What is asked for, and what stands for it",
            coverage::requirements(&certificate.requirements),
        ),
        section("proved", "What was proved", proved(certificate)),
        section("not", "What nobody looked at", not_looked_at(certificate)),
        section("hashes", "What this depends on", hashes(certificate)),
    ]
}

fn headline(certificate: &Certificate) -> Headline {
    let (may, plan) = (certificate.may_go(), &certificate.plan);
    let broken = certificate
        .laws
        .iter()
        .filter(|law| law.broken_in > 0)
        .count();
    let sentence = match may {
        true => format!(
            "“{}” may go on the rig, as far as {} simulated trials can say.",
            certificate.name, plan.scenarios
        ),
        false => format!("“{}” must not go on the rig.", certificate.name),
    };
    let mut paragraphs = match may {
        true => vec![
            html! { "No law was broken on any of " (grouped(certificate.samples)) " samples, and every limit holds. That is a test on a simulated rig with simulated hands: what nobody looked at stands below." },
        ],
        false => certificate
            .reasons
            .iter()
            .map(|reason| html! { (capital(reason)) "." })
            .collect(),
    };
    let cautions = certificate.cautions();
    paragraphs.extend(cautions.iter().map(|own| html! { (capital(own)) "." }));
    let calibration = plan.calibration.iter();
    paragraphs.extend(calibration.map(|found| html! { (found.words()) }));
    let endings = &certificate.ended.controller;
    Headline {
        tone: match may {
            true if cautions.is_empty() => Tone::Good,
            true => Tone::Doubt,
            false => Tone::Bad,
        },
        badge: match may {
            true if cautions.is_empty() => "May go on the rig",
            true => "May go on the rig: look at the worst trial",
            false => "Must not go on the rig",
        }
        .to_owned(),
        sentence,
        paragraphs,
        cards: vec![
            [
                "Laws broken".to_owned(),
                format!("{broken} of {}", certificate.laws.len()),
                looked_at(certificate),
            ],
            [
                "Trials".to_owned(),
                grouped(plan.scenarios),
                format!(
                    "{} came to the path's end, {} did and ended at the stops on the way back, {} ended at the stops, {} when their time was over, {} without an answer",
                    endings.finished,
                    endings.finished_then_stopped,
                    endings.stopped,
                    endings.time_over,
                    endings.no_answer
                ),
            ],
            [
                "Samples".to_owned(),
                grouped(certificate.samples),
                format!("seed {}", plan.seed),
            ],
        ],
    }
}

/// On which samples the laws were looked at.
fn looked_at(certificate: &Certificate) -> String {
    let all = "looked at on every sample they are about".to_owned();
    match certificate.plan.controller.declared.reference {
        Some(claim) if claim.every > 1 => {
            format!("{all}; beside the reference one of {}", claim.every)
        }
        _ => all,
    }
}

fn findings(certificate: &Certificate, replay: &dyn Fn(&str) -> String) -> Markup {
    let rows: Vec<Vec<String>> = certificate
        .findings
        .iter()
        .map(|found| {
            vec![
                found.law.name().to_owned(),
                match found.searched {
                    Some(target) => format!(
                        "from {} on, searching for a worse {}",
                        found.scenario,
                        target.name()
                    ),
                    None => found.scenario.to_string(),
                },
                significant(found.time_s, 3),
                replay(&found.file),
            ]
        })
        .collect();
    html! {
        p { "Each was made as small as it goes and can be played again; the file of the same name that ends in .mcap is the recording." }
        (table("findings-table", "What broke a law, shrunk.", &["law", "trial", "seconds until it breaks", "to see it"], &rows))
    }
}

/// Failures by what they have in common, the most frequent first, and one of each shrunk.
fn clusters(certificate: &Certificate, replay: &dyn Fn(&str) -> String) -> Markup {
    let row = |own: &Cluster| {
        let also = own.common.iter().map(|common| {
            let others = significant(100.0 * common.others, 2);
            format!("{} ({others} % of the others)", common.what)
        });
        let example = own.example.as_ref();
        vec![
            own.law.name().to_owned(),
            grouped(own.trials),
            format!("{} %", significant(100.0 * own.share, 2)),
            own.place.clone(),
            own.fault.clone(),
            also.collect::<Vec<_>>().join("; "),
            example.map_or_else(|| "–".to_owned(), |named| replay(&named.file)),
        ]
    };
    let rows: Vec<Vec<String>> = certificate.clusters.iter().map(row).collect();
    table(
        "clusters-table",
        "Trials that broke a law, gathered by law, place and fault, the most frequent first; what all of them have and few others do.",
        &[
            "law",
            "trials",
            "of all failures",
            "place",
            "fault",
            "all have",
            "to see one, shrunk",
        ],
        &rows,
    )
}

fn laws(laws: &[LawSummary]) -> Markup {
    let row = |law: &LawSummary| {
        let fared = match law.broken_in {
            0 if law.samples == 0 => "✘ held against no sample".to_owned(),
            0 if !law.is_met() => "✘ met too rarely".to_owned(),
            0 => "holds".to_owned(),
            count => format!(
                "✘ BROKEN in {count} trials, first in {}",
                law.first_broken
                    .map_or_else(|| "–".to_owned(), |first| first.to_string())
            ),
        };
        vec![
            law.law.name().to_owned(),
            fared,
            law.words.clone(),
            law.samples.to_string(),
            margin(law.worst_margin, &law.unit),
        ]
    };
    laws_table(&laws.iter().map(row).collect::<Vec<_>>())
}

/// A least margin in its unit.
fn margin(worst: Option<f64>, unit: &str) -> String {
    let shown = worst.map(|margin| format!("{} {unit}", significant(margin, 3)));
    shown.unwrap_or_else(|| "–".to_owned())
}

/// The table of the laws, a row each.
fn laws_table(rows: &[Vec<String>]) -> Markup {
    table(
        "laws-table",
        "A margin below zero breaks the law; the least one counts.",
        &["law", "fared", "what it says", "samples", "least margin"],
        rows,
    )
}

fn ties(ties: &[TieSummary]) -> Markup {
    let row = |tie: &TieSummary| {
        vec![
            tie.tie.name().to_owned(),
            tie.words.clone(),
            tie.samples.to_string(),
            tie.trials.to_string(),
            tie.most.to_string(),
        ]
    };
    let rows: Vec<Vec<String>> = ties.iter().map(row).collect();
    let head = ["kind", "what turns", "samples", "trials", "trials at most"];
    let words = "Samples in which the reference may decide otherwise, each checked to be one.";
    html! { details { summary { "Which, and how many" } (table("ties-table", words, &head, &rows)) } }
}

fn metrics(metrics: &[MetricSummary]) -> Markup {
    let row = |metric: &MetricSummary| {
        let own = |pick: fn(&rigproof_certify::summary::Quantiles) -> f64,
                   of: &Option<rigproof_certify::summary::Quantiles>| {
            of.as_ref().map_or_else(
                || "–".to_owned(),
                |quantiles| significant(pick(quantiles), 3),
            )
        };
        let change = changed(metric.change.as_ref());
        vec![
            format!("{} ({})", metric.words, metric.unit),
            own(|q| q.q50, &metric.controller),
            own(|q| q.q95, &metric.controller),
            own(|q| q.q50, &metric.baseline),
            change,
            own(|q| q.greatest, &metric.controller),
            fared(metric),
        ]
    };
    let rows: Vec<Vec<String>> = metrics.iter().map(row).collect();
    let head = [
        "metric",
        "median",
        "95 % below",
        "baseline's median",
        "against the baseline, paired",
        "worst trial",
        "fared",
    ];
    table(
        "metrics-table",
        "What was measured in every trial, beside what is on the rig now: the same hand, plant and noise. p is that of the exact sign test over the pairs.",
        &head,
        &rows,
    )
}

/// A change from the baseline, in words.
fn changed(change: Option<&Change>) -> String {
    let Some(change) = change else {
        return "–".to_owned();
    };
    let [low, high] = change.interval;
    let word = match change.word {
        Word::Better => "better",
        Word::Worse => "worse",
        Word::NoDifference => "no difference",
    };
    let own = &change.exact;
    format!(
        "{word}: {} [{} to {}]; better in {}, worse in {}, p = {}",
        significant(change.mean, 3),
        significant(low, 3),
        significant(high, 3),
        own.better,
        own.worse,
        significant(own.p, 2)
    )
}

/// Whether a metric's limits hold, and which does not by how much.
fn fared(metric: &MetricSummary) -> String {
    let beyond = metric.limits.iter().filter(|limit| !limit.holds);
    let beyond: Vec<&str> = beyond.map(|own| own.words.as_str()).collect();
    match beyond.as_slice() {
        [] if metric.limits.is_empty() => "no limit given".to_owned(),
        [] => "holds".to_owned(),
        beyond => format!("✘ BEYOND: {}", beyond.join("; ")),
    }
}

fn proved(certificate: &Certificate) -> Markup {
    let proved = &certificate.proved;
    let row = |claim: &rigproof_certify::proved::Claim| {
        vec![
            claim.claim.clone(),
            claim.statement.clone(),
            claim.by.join(", "),
        ]
    };
    let rows: Vec<Vec<String>> = proved.claims.iter().map(row).collect();
    html! {
        p { (proved.words) }
        @if !rows.is_empty() {
            details { summary { (rows.len()) " claims, each within what it assumes" } (table("proved-table", "Proved, not tested.", &["claim", "what it says", "by"], &rows)) }
        }
    }
}

fn worst(certificate: &Certificate, replay: &dyn Fn(&str) -> String) -> Markup {
    let row = |worst: &NamedWorst| {
        vec![
            worst.target.name().to_owned(),
            significant(worst.drawn, 3),
            significant(worst.found, 3),
            worst.unit.clone(),
            replay(&worst.file),
        ]
    };
    let rows: Vec<Vec<String>> = certificate.worst.iter().map(row).collect();
    html! {
        p { "An optimiser went on from the worst drawn trials of each law and metric, and towards cells in which no drawn trial met a law. It finds, and proves nothing." }
        (table("worst-table", "The worst that was drawn and the worst that was found.", &["of", "drawn", "found", "unit", "to see it"], &rows))
    }
}

fn not_looked_at(certificate: &Certificate) -> Markup {
    html! { ul { @for not in &certificate.not_looked_at { li { strong { (not.what) } ": " (not.why) } } } }
}

fn hashes(certificate: &Certificate) -> Markup {
    let own = &certificate.sha256;
    let mut rows = vec![
        vec!["controller".to_owned(), own.controller.clone()],
        vec!["rigs".to_owned(), own.rig.clone()],
        vec!["plan".to_owned(), own.plan.clone()],
        vec!["records of all trials".to_owned(), own.records.clone()],
        vec!["program".to_owned(), certificate.tool.sha256.clone()],
        vec!["this certificate".to_owned(), certificate.digest.clone()],
    ];
    rows.extend(
        own.baseline
            .iter()
            .map(|baseline| vec!["baseline".to_owned(), baseline.clone()]),
    );
    let words = "SHA-256 of everything it depends on.";
    html! { details { summary { "The hashes" } (table("hashes-table", words, &["of", "SHA-256"], &rows)) } }
}
