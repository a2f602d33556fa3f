//! This file shows what is asked for, how often the premise of every law was met and where, and which limits were given.

use maud::{Markup, html};
use rigproof_certify::certificate::Certificate;
use rigproof_certify::requirement::Requirement;
use rigproof_certify::summary::{Bound, LawSummary, Limited, MetSummary, MetricSummary};

use crate::number::{grouped, significant};
use crate::table::table;

/// What is asked for: sentence, who says it, what stands for it, trials, margin.
pub fn requirements(all: &[Requirement]) -> Markup {
    let row = |own: &Requirement| {
        vec![
            own.says.clone(),
            own.source.clone(),
            own.by.name().to_owned(),
            grouped(own.trials),
            margin(own.margin, &own.unit),
            if own.holds {
                "holds"
            } else {
                "✘ does not hold"
            }
            .to_owned(),
        ]
    };
    let rows: Vec<Vec<String>> = all.iter().map(row).collect();
    table(
        "requirements-table",
        "A margin below zero breaks it; trials are those in which its premise was met, or the metric measured.",
        &[
            "what is asked for",
            "by",
            "stands for it",
            "trials",
            "least margin",
            "fared",
        ],
        &rows,
    )
}

fn margin(margin: Option<f64>, unit: &str) -> String {
    margin.map_or_else(
        || "–".to_owned(),
        |margin| format!("{} {unit}", significant(margin, 3)),
    )
}

/// Where the trials were, and where every law was met.
pub fn coverage(certificate: &Certificate) -> Markup {
    let visited = &certificate.visited;
    html! {
        p { "Workspace, speed of the tip, push and fault of a sensor make " (visited.cells) " cells. Samples lay in " (visited.visited) " of them. A law is met where what it is about happens: inside the gap, while a brake acts, on a fault." }
        (met(&certificate.laws))
        @if !visited.never.is_empty() {
            details { summary { (visited.never.len()) " cells that no trial visited" } ul { @for cell in &visited.never { li { (cell) } } } }
        }
        @for law in &certificate.laws {
            details { summary { "Where " code { (law.law.name()) } " was met" } (parts(law)) (never(&law.met)) }
        }
    }
}

fn met(laws: &[LawSummary]) -> Markup {
    let row = |law: &LawSummary| {
        let met = &law.met;
        let few = if law.is_met() { "" } else { "✘ too few: " };
        vec![
            law.law.name().to_owned(),
            grouped(met.samples),
            format!(
                "{few}{}, at least {}",
                grouped(met.trials),
                met.least_trials
            ),
            format!("{} of {}", met.cells, met.of_cells),
            margin(law.worst_margin, &law.unit),
        ]
    };
    let rows: Vec<Vec<String>> = laws.iter().map(row).collect();
    table(
        "coverage-table",
        "How often the premise of every law was met. Cells are counted that were visited and in which the law can be met.",
        &["law", "samples", "trials", "cells", "least margin"],
        &rows,
    )
}

fn parts(law: &LawSummary) -> Markup {
    let row = |part: &rigproof_certify::summary::PartSummary| {
        vec![
            part.axis.clone(),
            part.part.clone(),
            grouped(part.samples),
            margin(part.least_margin, &law.unit),
        ]
    };
    let rows: Vec<Vec<String>> = law.met.parts.iter().map(row).collect();
    table(
        &format!("coverage-{}", law.law.name()),
        &format!(
            "Samples in which the premise of {} was met, and the least margin in them.",
            law.law.name()
        ),
        &["axis", "part", "samples", "least margin"],
        &rows,
    )
}

fn never(met: &MetSummary) -> Markup {
    html! {
        @if !met.never.is_empty() {
            p { "Visited, and never met there:" }
            ul { @for cell in &met.never { li { (cell) } } }
        }
    }
}

/// Every limit that was given, with the worst that stands beside it.
pub fn limits(metrics: &[MetricSummary]) -> Markup {
    let all = metrics
        .iter()
        .flat_map(|metric| metric.limits.iter().map(move |limit| (metric, limit)));
    let row = |(metric, limit): (&MetricSummary, &Limited)| {
        let number = |value: Option<f64>| margin(value, &metric.unit);
        let worst = metric.controller.map(|own| own.greatest);
        let of = metric.worst_scenario;
        let of = of.map_or_else(String::new, |index| format!(", trial {index}"));
        vec![
            metric.words.clone(),
            match limit.bound {
                Bound::Trials => "95 of 100 trials",
                Bound::Mean => "mean, beside the baseline",
            }
            .to_owned(),
            number(Some(limit.most)),
            number(limit.value),
            format!("{}{of}", number(worst)),
            if limit.holds { "holds" } else { "✘ BEYOND" }.to_owned(),
        ]
    };
    let rows: Vec<Vec<String>> = all.map(row).collect();
    html! {
        @if rows.is_empty() {
            p { "No limit was given: certify.toml has neither [limits] nor [regressions]." }
        } @else {
            (table(
                "limits-table",
                "Every limit that was given, what is set beside it, and the worst single trial.",
                &["metric", "of", "limit", "comes to", "worst trial", "fared"],
                &rows,
            ))
        }
    }
}
