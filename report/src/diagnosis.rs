//! This file is the page of a diagnosis: what is wrong, where, what it is, how sure that is, before and after, and what to do next.

mod after;
mod arm;
mod drawing;
mod headline;
mod left_over;
mod moving;
mod next;
mod sure;
mod what;
mod when;
mod wherein;

use maud::{Markup, html};
use rigproof_diagnose::Curves;
use rigproof_diagnose::report::Report;

use crate::chart::Chart;
use crate::document::{Document, Section};
use crate::replay::Replay;

/// A diagnosis as the page needs it.
pub struct Diagnosed<'a> {
    /// What people call the rig.
    pub rig: &'a str,
    /// What was found.
    pub report: &'a Report,
    /// Its curves.
    pub curves: &'a Curves,
    /// The linkage that moves, of a five-bar; an axis moves by its curves.
    pub replay: Option<Replay>,
    /// What to do now: a command, or words.
    pub next: Option<&'a str>,
}

/// The page of a diagnosis as HTML.
pub fn page(diagnosed: Diagnosed) -> String {
    let (report, curves) = (diagnosed.report, diagnosed.curves);
    let mut charts = Vec::new();
    let mut sections = Vec::new();
    let mut section = |id: &str, heading: &str, body: Option<Markup>| {
        if let Some(body) = body {
            let (id, heading) = (String::from(id), heading.to_owned());
            sections.push(Section { id, heading, body });
        }
    };
    let replay = diagnosed.replay.or_else(|| moving::joint(curves));
    section(
        "before-and-after",
        "Before and after, on held-out data",
        after::body(report, curves, replay.as_ref(), &mut charts),
    );
    // Where something is named, the time line answers what its absence would cost. Where nothing
    // goes wrong and nothing is named there is no line to show.
    let what_if = when::what_if(curves);
    let is_named = report.changes_the_model();
    let is_shown = is_named || !report.agrees();
    let line = is_shown.then(|| when::body(curves, what_if.as_ref(), &mut charts));
    let (if_off, when) = match (line.flatten(), is_named) {
        (line, true) => (line, None),
        (line, false) => (None, line),
    };
    section("what", "What it is", what::body(report, if_off));
    // Where nothing goes wrong there is no place to show.
    if !report.agrees() {
        section("where", "Where it goes wrong", wherein::body(report, when));
    }
    section(
        "sure",
        "How sure this is",
        sure::body(report, curves, what_if.as_ref(), &mut charts),
    );
    section(
        "next",
        "What would settle it",
        next::body(report, &made(report)),
    );
    let headline = headline::headline(report, diagnosed.next);
    Document {
        title: format!("{} – {}", headline.sentence, diagnosed.rig),
        kind: "Diagnosis",
        about: diagnosed.rig.to_owned(),
        headline,
        sections,
        charts,
        replay,
        served: None,
        footer: format!(
            "Written by {}. This page is one file: it loads nothing and sends nothing.",
            report.tool
        ),
    }
    .to_html()
}

/// Adds a chart to the page and gives its place.
fn place(charts: &mut Vec<Chart>, chart: Chart, caption: &Markup) -> Markup {
    let figure = chart.figure(caption);
    charts.push(chart);
    figure
}

/// A residual of the windows that count; not a number elsewhere.
fn counted(curves: &Curves, residual: &[f64]) -> Vec<f64> {
    let pairs = residual.iter().zip(&curves.window_counts);
    pairs
        .map(|(r, counts)| if *counts { *r } else { f64::NAN })
        .collect()
}

/// How it was measured, folded up.
fn made(report: &Report) -> Markup {
    html! {
        details #made { summary { "How it was measured" }
        @if !report.inputs.is_empty() {
            div.scroll { table.grid {
                caption { "The files that were read." }
                thead { tr { th scope="col" { "file" } th scope="col" { "SHA-256" } } }
                tbody { @for input in &report.inputs { tr { th scope="row" { (input.path) } td.sha { (input.sha256) } } } }
            } }
        }
        ul { @for line in &report.protocol { li { (line) } } }
        p.soft { "The plant is: " (report.plant) ". The verdict in the report is " code { (report.verdict.name()) } ": " (report.summary) "." }
        }
    }
}
