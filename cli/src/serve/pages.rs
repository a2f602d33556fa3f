//! This file is the list of runs, what is under way, and the comparison of two.

use std::time::SystemTime;

use maud::{Markup, html};
use percent_encoding::{NON_ALPHANUMERIC, utf8_percent_encode};
use rigproof_report::document::{Document, Headline, Section, Served, Tone};
use rigproof_report::number::significant;
use rigproof_report::table::table;
use rigproof_report::words::{self, plain_at};
use serde_json::Value;

use super::answer::Site;
use super::listing::Run;
use super::watch::State;

fn section(id: &str, heading: &str, body: Markup) -> Section {
    Section {
        id: id.to_owned(),
        heading: heading.to_owned(),
        body,
    }
}

fn document(
    title: &str,
    about: String,
    headline: Headline,
    sections: Vec<Section>,
    served: Served,
) -> String {
    Document {
        title: title.to_owned(),
        kind: "Runs",
        about,
        headline,
        sections,
        charts: Vec::new(),
        replay: None,
        footer: "Served on this machine alone.".to_owned(),
        served: Some(served),
    }
    .to_html()
}

/// What is under way, in words.
pub fn now(state: &State, is_watching: bool) -> String {
    match (&state.now, is_watching) {
        (Some(now), _) => format!(
            "Diagnosing {now} for {} s; {} more wait.",
            state.since_s, state.waiting
        ),
        (None, true) => {
            "Watching for recordings: each is diagnosed as soon as it is whole.".to_owned()
        }
        (None, false) => "Recordings that come are not diagnosed: no --rig was given.".to_owned(),
    }
}

/// The list of runs; `revision` says what it was made from.
pub fn list(runs: &[Run], site: &Site, revision: &str) -> String {
    let state = site.watch.state();
    let folder = site.folder.display().to_string();
    let headline = Headline {
        tone: if state.now.is_some() {
            Tone::Doubt
        } else {
            Tone::Found
        },
        badge: folder.clone(),
        sentence: match runs.len() {
            1 => "One run in this folder.".to_owned(),
            count => format!("{count} runs in this folder."),
        },
        paragraphs: vec![
            html! { span #now data-revision=(revision) { (now(&state, site.is_watching)) } },
            html! { span #news role="status" {} noscript { a href="/" { "Look again" } } },
        ],
        cards: Vec::new(),
    };
    let mut sections = vec![section("runs", "Runs, the latest first", all(runs))];
    if runs.len() > 1 {
        sections.push(section("compare", "Compare two", chooser(runs)));
    }
    if !state.failed.is_empty() {
        let failed = state.failed.iter();
        let rows: Vec<Vec<String>> = failed
            .map(|(file, why)| vec![file.clone(), why.clone()])
            .collect();
        let caption = "Recordings that could not be diagnosed, and why.";
        let head = ["recording", "why"];
        let body = table("failed-table", caption, &head, &rows);
        sections.push(section("failed", "Not diagnosed", body));
    }
    document("Runs", folder, headline, sections, Served::Live)
}

fn address(run: &Run, file: &str) -> String {
    format!(
        "/run/{}/{file}",
        utf8_percent_encode(&run.name, NON_ALPHANUMERIC)
    )
}

fn all(runs: &[Run]) -> Markup {
    html! {
        @if runs.is_empty() { p { "None yet: they are the folders that " code { "rigproof diagnose" } " and " code { "rigproof certify" } " write here." } } @else {
            div.scroll tabindex="0" role="region" aria-label="Runs" { table.grid.stacks {
                caption { "Diagnoses and certificates." }
                thead { tr { th scope="col" { "run" } th scope="col" { "written" } th scope="col" { "result" } th scope="col" { "in words" } } }
                tbody { @for run in runs { tr {
                    th scope="row" { a href=(address(run, Run::page(run.is_certificate()))) { (run.name) } }
                    td data-head="written" { (written(run)) }
                    @if run.is_certificate() {
                        td data-head="result" { (verdict(run)) } td data-head="in words" { (run.text("/name")) }
                    } @else { td data-head="result" { (run.text("/verdict").replace('_', " ")) } td.words data-head="in words" { (found(run)) } }
                } } }
            } }
        }
    }
}

/// What follows from a certificate.
fn verdict(run: &Run) -> &'static str {
    match run.text("/may_go_on_the_rig").as_str() {
        "yes" => "may go on the rig",
        "no" => "must not go on the rig",
        _ => "no verdict: it was changed, or is another program's",
    }
}

/// What a diagnosis found, as a mechanic says it, and how much that helped.
fn found(run: &Run) -> String {
    let effects = run.result.get("effects").and_then(Value::as_array);
    let name = |effect: &Value| {
        let joint = effect.get("joint").and_then(Value::as_str);
        Some(plain_at(effect.get("mechanism")?.as_str()?, joint))
    };
    let names: Vec<String> = effects.into_iter().flatten().filter_map(name).collect();
    if names.is_empty() {
        return run.text("/summary");
    }
    let error = |which: &str| {
        let error = run.result.pointer(&format!("/fit/held_out/nrmse_{which}"));
        error.and_then(Value::as_f64)
    };
    let errors = error("before").zip(error("after"));
    let errors = errors.map_or_else(String::new, |(before, after)| {
        let (before, after) = (significant(before, 3), significant(after, 3));
        format!("; error on data kept aside: {before} % → {after} %")
    });
    words::list(&names) + &errors
}

/// When a run was written: for whom no script runs, how long ago; a script makes local time of it.
fn written(run: &Run) -> Markup {
    let since = |from: SystemTime| from.elapsed().unwrap_or_default().as_secs();
    let ms = run
        .written
        .duration_since(SystemTime::UNIX_EPOCH)
        .unwrap_or_default()
        .as_millis();
    let ago = match since(run.written) {
        seconds @ 0..120 => format!("{seconds} s ago"),
        seconds @ 120..7200 => format!("{} min ago", seconds / 60),
        seconds @ 7200..172_800 => format!("{} h ago", seconds / 3600),
        seconds => format!("{} days ago", seconds / 86_400),
    };
    html! { time data-ms=(ms) { (ago) } }
}

fn chooser(runs: &[Run]) -> Markup {
    let options = |second: usize| html! { @for (k, run) in runs.iter().enumerate() { option value=(run.name) selected[k == second] { (run.name) } } };
    html! {
        form method="get" action="/compare" {
            p { label for="one" { "This " } select #one name="one" { (options(1)) } " " label for="other" { "with " } select #other name="other" { (options(0)) } " " button type="submit" { "Compare" } }
        }
    }
}

/// What stands side by side: words, and where it is in the result.
const ROWS: [(&str, &str); 14] = [
    ("verdict", "/verdict"),
    ("in words", "/summary"),
    ("left over ÷ noise, old model", "/floor/ratio_before"),
    ("left over ÷ noise, new model", "/floor/ratio_after"),
    (
        "error kept aside, old model (%)",
        "/fit/held_out/nrmse_before",
    ),
    (
        "error kept aside, new model (%)",
        "/fit/held_out/nrmse_after",
    ),
    ("may go on the rig", "/may_go_on_the_rig"),
    ("samples", "/samples"),
    ("plan (SHA-256)", "/sha256/plan"),
    ("controller (SHA-256)", "/sha256/controller"),
    ("first file", "/inputs/0/path"),
    ("first file (SHA-256)", "/inputs/0/sha256"),
    ("program", "/tool"),
    ("program (version)", "/tool/version"),
];

/// Two runs side by side.
pub fn compared(one: &Run, other: &Run) -> String {
    let mut rows: Vec<Vec<String>> = ROWS
        .into_iter()
        .map(|(words, pointer)| vec![words.to_owned(), one.text(pointer), other.text(pointer)])
        .filter(|row| row.iter().skip(1).any(|cell| cell != "–"))
        .collect();
    let (own, others) = (effects(one), effects(other));
    let mut names: Vec<&String> = own.iter().chain(&others).map(|(name, _)| name).collect();
    names.sort();
    names.dedup();
    for name in names {
        let value = |all: &[(String, String)]| {
            all.iter()
                .find(|(own, _)| own == name)
                .map_or_else(|| "–".to_owned(), |(_, value)| value.clone())
        };
        rows.push(vec![name.clone(), value(&own), value(&others)]);
    }
    let differ: Vec<&str> = rows
        .iter()
        .filter(|row| row.get(1) != row.get(2))
        .filter_map(|row| row.first().map(String::as_str))
        .collect();
    let headline = Headline {
        tone: Tone::Found,
        badge: "Two runs".to_owned(),
        sentence: format!("{} and {}, side by side", one.name, other.name),
        paragraphs: vec![
            html! { @if differ.is_empty() { "They say the same." } @else { "They differ in: " (differ.join("; ")) "." } },
            html! { a href="/" { "All runs" } " · " a href=(address(one, Run::page(one.is_certificate()))) { (one.name) } " · " a href=(address(other, Run::page(other.is_certificate()))) { (other.name) } },
        ],
        cards: Vec::new(),
    };
    let head = ["what", one.name.as_str(), other.name.as_str()];
    let body = section(
        "side-by-side",
        "Side by side",
        table("side-by-side-table", "What the two runs say.", &head, &rows),
    );
    let about = format!("{} and {}", one.name, other.name);
    document("Two runs", about, headline, vec![body], Served::Still)
}

/// The named numbers of a diagnosis, and the laws that a certificate found broken.
fn effects(run: &Run) -> Vec<(String, String)> {
    let list = |key: &str| {
        run.result
            .get(key)
            .and_then(|all| all.as_array())
            .cloned()
            .unwrap_or_default()
    };
    let mut all = Vec::new();
    for effect in list("effects") {
        let mechanism = effect
            .get("mechanism")
            .and_then(|name| name.as_str())
            .unwrap_or_default();
        let joint = effect
            .get("joint")
            .and_then(|joint| joint.as_str())
            .map_or_else(String::new, |joint| format!(" at {joint}"));
        for (name, number) in effect
            .get("parameters")
            .and_then(|all| all.as_object())
            .into_iter()
            .flatten()
        {
            let value = number
                .get("value")
                .and_then(Value::as_f64)
                .unwrap_or(f64::NAN);
            let unit = number
                .get("unit")
                .and_then(|unit| unit.as_str())
                .unwrap_or_default();
            all.push((
                format!("{mechanism}{joint}: {name}"),
                crate::text::number::stated(value, unit),
            ));
        }
    }
    for law in list("laws") {
        let name = law
            .get("law")
            .and_then(|law| law.as_str())
            .unwrap_or_default();
        let broken = law.get("broken_in").and_then(Value::as_u64).unwrap_or(0);
        all.push((format!("law {name}: broken in"), broken.to_string()));
    }
    all
}
