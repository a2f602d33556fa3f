//! This file says what was left out: words, equation, numbers with units and intervals, rivals and how the names entered.

use maud::{Markup, html};
use rigproof_diagnose::report::{EffectReport, Number, Report};
use std::collections::BTreeMap;

use crate::number::{percent, probability, significant, told, told_of};
use crate::words::{called_at, capital, look_for, plain_at, plain_cause};

/// The named mechanisms, what is left unknown, and the nominal model's numbers; nothing where nothing was concluded. `if_off` says what their absence costs.
pub fn body(report: &Report, if_off: Option<Markup>) -> Option<Markup> {
    report.floor.as_ref()?;
    let none: &[String] = &[];
    let rivals = report
        .ambiguous_with
        .iter()
        .map(Vec::as_slice)
        .chain(std::iter::repeat(none));
    let mut effects: Vec<(&EffectReport, &[String])> = report.effects.iter().zip(rivals).collect();
    effects.sort_by_key(|(own, _)| own.status != "named");
    Some(html! {
        @if report.effects.is_empty() { p { "No effect is named." } }
        @for (effect, rivals) in effects { (one(effect, rivals)) }
        @if let Some(if_off) = if_off { details #what-if { summary { "What if a name is switched off?" } (if_off) } }
        (unknown(report))
        (stages(report))
        @if !report.nominal.is_empty() { details { summary { "The model's own numbers, after the fit" } (numbers("Numbers of the nominal model.", &report.nominal)) } }
        (not_named(report))
    })
}

fn one(effect: &EffectReport, rivals: &[String]) -> Markup {
    html! {
        div.effect {
            h3 { (capital(&plain_at(effect.mechanism, effect.joint))) }
            p { strong { (capital(&probability(effect.probability))) } " probable. " span.soft { (capital(&called_at(effect.mechanism, effect.joint)))
                @if let Some(look) = look_for(effect.mechanism) { ". On the rig, look at: " (look) } "." } }
            (numbers("Its numbers.", &effect.parameters))
            @if let Some(onset_s) = effect.onset_s { (onset(onset_s, effect.onset_low95_s.zip(effect.onset_high95_s))) }
            @if !rivals.is_empty() { p { "Would explain this recording as well in its place: " @for (k, rival) in rivals.iter().enumerate() { @if k > 0 { "; " } (plain_cause(rival)) " (" code { (rival) } ")" } "." } }
            details { summary { "Its equation, and what would refute it" }
                div.equation role="math" { (effect.equation) }
                p.soft { "In files it is called " code { (effect.mechanism) } ". What would refute it: " (effect.refuted_by) "."
                    @if rivals.is_empty() { " Everything else in the library that was tried in its place explains less." } }
            }
        }
    }
}

/// When an effect begins, and the interval in which it does.
fn onset(onset_s: f64, interval: Option<(f64, f64)>) -> Markup {
    let (begins, interval) = told(onset_s, interval.map(<[f64; 2]>::from), 4, significant);
    html! { p { "It begins " strong { (begins) " s" } " after the first sample"
    @if let Some([low, high]) = interval { ", in 95 % of cases between " (low) " and " (high) " s" } "." } }
}

fn numbers(caption: &str, all: &BTreeMap<String, Number>) -> Markup {
    html! { @if !all.is_empty() {
        div.scroll { table.grid aria-label=(caption) {
            thead { tr { th scope="col" { "number" } th.number scope="col" { "value" } th scope="col" { "unit" } th scope="col" { "95 % interval" } } }
            tbody { @for (name, number) in all { @let (value, interval) = told_of(number); tr {
                th scope="row" { (name.replace('_', " ")) }
                td.number { (value) }
                td { (if number.unit == "1" { "–".to_owned() } else { number.unit.replace("^2", "²").replace("^3", "³") }) }
                td { @match interval { Some([low, high]) => { (low) " to " (high) } None => "not determined" } }
            } } }
        } }
    } }
}

/// How the residual fell as the names entered: the rivals lost here.
fn stages(report: &Report) -> Markup {
    let Some(floor) = report.floor.as_ref().filter(|_| !report.stages.is_empty()) else {
        return html! {};
    };
    html! {
        details { summary { "How it was named, step by step" }
        div.scroll { table.grid {
            caption { "What was left over as the names entered, one after another (root mean square, " (floor.unit) "). Each had to help on blocks of time that the fit had not seen." }
            thead { tr { th scope="col" { "model" } th.number scope="col" { "left over" } th.number scope="col" { "÷ noise" } th scope="col" { "with" } } }
            tbody {
                (stage("the old model", floor.measured_before, floor.predicted, ""))
                @for own in &report.stages { (stage(&format!("+ {}", plain_at(own.entered, own.joint)), own.residual, floor.predicted, &own.standing.join(", "))) }
                (stage("what is named in the end", floor.measured_after, floor.predicted, ""))
                (stage("sensor noise alone", floor.predicted, floor.predicted, ""))
            }
        } }
        }
    }
}

fn stage(name: &str, residual: f64, noise: f64, standing: &str) -> Markup {
    html! { tr { th scope="row" { (name) } td.number { (significant(residual, 4)) } td.number { (significant(residual / noise, 3)) } td { (standing) } } }
}

fn unknown(report: &Report) -> Markup {
    let Some(unknown) = &report.unknown else {
        return html! {};
    };
    html! {
        h3 { "What is left has a shape" }
        p { "Ordered by " strong { (unknown.variable) } @if let Some(joint) = unknown.joint { " of joint " (joint) } ", a curve takes away " (percent(unknown.share)) " of what is still unexplained"
            @if unknown.memory { "; the way up differs from the way down: it has a memory" } ". " (capital(&unknown.suggestion)) "." }
        details { summary { "The curve as numbers" }
            div.scroll { table.grid #unknown-shape {
                caption { "What is left against " (unknown.variable) "." }
                thead { tr { th.number scope="col" { (unknown.variable) " (" (unknown.variable_unit) ")" } th.number scope="col" { "left over" } } }
                tbody { @for (x, y) in &unknown.shape { tr { td.number { (significant(*x, 4)) } td.number { (significant(*y, 4)) } } } }
            } }
            div.tools { button type="button" data-save-table="unknown-shape" { "Save CSV" } }
        }
    }
}

fn not_named(report: &Report) -> Markup {
    let names = &report.withdrawn;
    html! { @if !names.is_empty() {
        p { "Were named on the way and taken back, because nothing real comes to such a size: " @for (k, name) in names.iter().enumerate() { @if k > 0 { "; " } (plain_cause(name)) } "." }
    } }
}
