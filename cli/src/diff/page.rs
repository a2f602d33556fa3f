//! This file is the page of a comparison: what changed, and the curves of both diagnoses on one chart.

use std::path::Path;

use maud::html;
use rigproof_report::chart::{Axis, Chart, Curve};
use rigproof_report::document::{Document, Headline, Section, Tone};
use rigproof_report::table::table;
use rigproof_trace::store::read_text;
use serde_json::Value;

use super::change::Change;
use super::side::Side;

/// Changes that are said at the top; the table has all.
const FIRST: usize = 4;

/// The page as HTML.
pub fn page((one, other): (&Side, &Side), changes: &[Change]) -> String {
    let rows: Vec<Vec<String>> = changes.iter().map(Change::cells).collect();
    let head = ["what", one.name.as_str(), other.name.as_str()];
    let mut sections = Vec::new();
    let mut charts = Vec::new();
    if let Some(chart) = overlaid(one, other) {
        let body = chart.figure(&html! { "Held-out data, and what the calibrated model of each diagnosis makes of them." });
        charts.push(chart);
        sections.push(section("curves", "Both models on one chart", body));
    }
    if !rows.is_empty() {
        let body = table(
            "changes-table",
            "What the two say differently.",
            &head,
            &rows,
        );
        sections.push(section("changes", "What changed", body));
    }
    let sentence = match changes.len() {
        0 => format!("{} and {} say the same.", one.name, other.name),
        1 => format!("One thing changed from {} to {}.", one.name, other.name),
        count => format!(
            "{count} things changed from {} to {}.",
            one.name, other.name
        ),
    };
    Document {
        title: format!("{} and {}", one.name, other.name),
        kind: "Comparison",
        about: format!("{} and {}", one.name, other.name),
        headline: Headline {
            tone: if changes.is_empty() {
                Tone::Good
            } else {
                Tone::Found
            },
            badge: "Two compared".to_owned(),
            sentence,
            paragraphs: changes
                .iter()
                .take(FIRST)
                .map(|change| html! { (change.words()) "." })
                .collect(),
            cards: Vec::new(),
        },
        sections,
        charts,
        replay: None,
        served: None,
        footer: "This page is one file: it loads nothing and sends nothing.".to_owned(),
    }
    .to_html()
}

fn section(id: &str, heading: &str, body: maud::Markup) -> Section {
    Section {
        id: id.to_owned(),
        heading: heading.to_owned(),
        body,
    }
}

/// The new models of both over the recording; nothing unless both pages show the same recording.
fn overlaid(one: &Side, other: &Side) -> Option<Chart> {
    let (own, new) = (
        Shown::read(one.page.as_ref()?)?,
        Shown::read(other.page.as_ref()?)?,
    );
    // Gaps are not numbers, which equal nothing: the bits do.
    let bits = |all: &[f64]| all.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    if own.time != new.time || bits(&own.recorded) != bits(&new.recorded) {
        return None;
    }
    let curves = vec![
        Curve::line("recorded", "recorded", &own.recorded),
        Curve::line(&one.name, "old", &own.model),
        Curve::line(&other.name, "new", &new.model),
    ];
    let y = Axis {
        label: own.label,
        unit: own.unit,
    };
    Some(Chart::over_time(
        "overlaid",
        "Recorded, and both models",
        y,
        &own.time,
        curves,
    ))
}

/// What the page of a diagnosis shows over time; values that are missing are not numbers.
struct Shown {
    time: Vec<f64>,
    label: String,
    unit: String,
    recorded: Vec<f64>,
    model: Vec<f64>,
}

impl Shown {
    /// The page holds its curves as JSON; nothing where it holds none.
    fn read(page: &Path) -> Option<Shown> {
        let text = read_text(page).ok()?;
        let (_, rest) = text.split_once("<script id=\"data\" type=\"application/json\">")?;
        let (data, _) = rest.split_once("</script>")?;
        let data: Value = serde_json::from_str(data).ok()?;
        let charts = data.get("charts")?.as_array()?;
        let chart = charts
            .iter()
            .find(|own| own.get("id").and_then(Value::as_str) == Some("output"))?;
        let all = chart.get("series")?.as_array()?;
        let curve = |name: &str| {
            let own = all
                .iter()
                .find(|own| own.get("name").and_then(Value::as_str) == Some(name))?;
            numbers(own.get("v")?)
        };
        let word = |pointer: &str| {
            let word = chart.pointer(pointer).and_then(Value::as_str);
            word.unwrap_or_default().to_owned()
        };
        Some(Shown {
            time: numbers(chart.get("t")?)?,
            label: word("/y/label"),
            unit: word("/y/unit"),
            recorded: curve("recorded")?,
            model: curve("new model")?,
        })
    }
}

fn numbers(all: &Value) -> Option<Vec<f64>> {
    let all = all.as_array()?.iter();
    Some(all.map(|own| own.as_f64().unwrap_or(f64::NAN)).collect())
}
