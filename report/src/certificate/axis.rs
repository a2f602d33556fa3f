//! This file is the page of the certificate of an axis: may it go on the rig, why not, how it fared, and what nobody looked at.

use maud::{Markup, html};
use rigproof_certify::axis::certificate::{Certificate, LawSummary};
use rigproof_certify::axis::metrics::MetricSummary;

use super::{changed, laws_table, margin};
use crate::chart::{Axis, Chart, Curve};
use crate::document::{Document, Headline, Section, Tone};
use crate::number::{grouped, significant};
use crate::table::table;
use crate::words::capital;

/// A trial that was run again, for the page; positions in m or rad, efforts in N or N·m.
pub struct Run {
    /// Which, as a sentence.
    pub words: String,
    /// Time, s.
    pub time_s: Vec<f64>,
    /// Where the axis was to be.
    pub target: Vec<f64>,
    /// Where it was.
    pub position: Vec<f64>,
    /// What was commanded.
    pub effort: Vec<f64>,
}

/// The page of a certificate as HTML.
pub fn page(certificate: &Certificate, run: Option<&Run>) -> String {
    let headline = headline(certificate);
    let units = certificate.plan.axis.units();
    let charts = run.map_or(Vec::new(), |run| run.charts(units));
    let mut sections = vec![
        section("laws", "The laws", laws(&certificate.laws)),
        section(
            "metrics",
            "How well it follows, and with how much effort",
            metrics(&certificate.metrics),
        ),
    ];
    if let Some(run) = run {
        let body = html! { p { (run.words) } @for chart in &charts { (chart.figure(&html! {})) } };
        sections.push(section("run", "The worst of the trials, run again", body));
    }
    let not = &certificate.not_looked_at;
    let not = html! { ul { @for own in not { li { strong { (own.what) } ": " (own.why) } } } };
    sections.push(section("not", "What nobody looked at", not));
    sections.push(section(
        "hashes",
        "What this depends on",
        hashes(certificate),
    ));
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

fn section(id: &str, heading: &str, body: Markup) -> Section {
    Section {
        id: id.to_owned(),
        heading: heading.to_owned(),
        body,
    }
}

impl Run {
    fn charts(&self, [travel, effort]: [&str; 2]) -> Vec<Chart> {
        let axis = |label: &str, unit: &str| Axis {
            label: label.to_owned(),
            unit: unit.to_owned(),
        };
        vec![
            Chart::over_time(
                "position",
                "Target and position",
                axis("position", travel),
                &self.time_s,
                vec![
                    Curve::line("target", "recorded", &self.target),
                    Curve::line("position", "new", &self.position),
                ],
            ),
            Chart::over_time(
                "effort",
                "Commanded effort",
                axis("effort", effort),
                &self.time_s,
                vec![Curve::line("effort", "new", &self.effort)],
            ),
        ]
    }
}

fn headline(certificate: &Certificate) -> Headline {
    let (may, plan) = (certificate.may_go(), &certificate.plan);
    let name = &certificate.name;
    let mut paragraphs: Vec<Markup> = match may {
        true => vec![
            html! { "No law was broken on any of " (grouped(certificate.samples)) " samples, and every limit holds. That is a test on a simulated axis: what nobody looked at stands below." },
        ],
        false => {
            let reasons = certificate.reasons.iter();
            reasons.map(|own| html! { (capital(own)) "." }).collect()
        }
    };
    let broke = certificate.first_failure.iter();
    paragraphs.extend(broke.map(|how| html! { "It broke first so: " (how) "." }));
    paragraphs.push(html! { (plan.axis.words()) });
    let broken = certificate.laws.iter().filter(|law| law.broken_in > 0);
    let ended = certificate.ended;
    Headline {
        tone: if may { Tone::Good } else { Tone::Bad },
        badge: match may {
            true => "May go on the rig",
            false => "Must not go on the rig",
        }
        .to_owned(),
        sentence: match may {
            true => format!(
                "“{name}” may go on the rig, as far as {} simulated trials can say.",
                plan.scenarios
            ),
            false => format!("“{name}” must not go on the rig."),
        },
        paragraphs,
        cards: vec![
            [
                "Laws broken".to_owned(),
                format!("{} of {}", broken.count(), certificate.laws.len()),
                "looked at on every sample they are about".to_owned(),
            ],
            [
                "Trials".to_owned(),
                grouped(plan.scenarios),
                format!(
                    "{} ended when their time was over, {} at a stop, {} without an answer",
                    ended.time_over, ended.at_stop, ended.no_answer
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

fn laws(laws: &[LawSummary]) -> Markup {
    let row = |law: &LawSummary| {
        let fared = match law.first_broken {
            Some(first) => format!("✘ BROKEN in {} trials, first in {first}", law.broken_in),
            None if law.met_in < law.least_met => "✘ met too rarely".to_owned(),
            None => "holds".to_owned(),
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

fn metrics(metrics: &[MetricSummary]) -> Markup {
    let row = |metric: &MetricSummary| {
        let number =
            |own: Option<f64>| own.map_or_else(|| "–".to_owned(), |own| significant(own, 3));
        let (own, baseline) = (metric.controller, metric.baseline);
        let reasons = metric.reasons();
        vec![
            format!("{} ({})", metric.words, metric.unit),
            number(own.map(|own| own.q50)),
            number(own.map(|own| own.q95)),
            number(baseline.map(|own| own.q50)),
            changed(metric.change.as_ref()),
            match (reasons.is_empty(), metric.limit.or(metric.regression)) {
                (true, None) => "no limit given".to_owned(),
                (true, Some(_)) => "holds".to_owned(),
                (false, _) => format!("✘ BEYOND: {}", reasons.join("; ")),
            },
        ]
    };
    let rows: Vec<Vec<String>> = metrics.iter().map(row).collect();
    let head = [
        "metric",
        "median",
        "95 % below",
        "baseline's median",
        "against the baseline, paired",
        "fared",
    ];
    let words = "What was measured in every trial, beside what is on the axis now: the same target, axis and noise.";
    table("metrics-table", words, &head, &rows)
}

fn hashes(certificate: &Certificate) -> Markup {
    let own = &certificate.sha256;
    let axis = &certificate.plan.axis;
    let mut rows = vec![
        vec!["controller".to_owned(), own.controller.clone()],
        vec![
            format!("file of the axis, {}", axis.name),
            axis.sha256.clone(),
        ],
        vec!["axis".to_owned(), own.rig.clone()],
        vec!["plan".to_owned(), own.plan.clone()],
        vec!["records of all trials".to_owned(), own.records.clone()],
        vec!["program".to_owned(), certificate.tool.sha256.clone()],
        vec!["this certificate".to_owned(), certificate.digest.clone()],
    ];
    let baseline = own.baseline.iter();
    rows.extend(baseline.map(|baseline| vec!["baseline".to_owned(), baseline.clone()]));
    let words = "SHA-256 of everything it depends on.";
    html! { details { summary { "The hashes" } (table("hashes-table", words, &["of", "SHA-256"], &rows)) } }
}
