//! This file says how far the names can be believed.

use maud::{Markup, html};
use rigproof_diagnose::Curves;
use rigproof_diagnose::report::{ExplanationReport, NamedRate, Report};

use super::left_over;
use crate::chart::Chart;
use crate::number::{percent, probability, rate, significant, with_unit};
use crate::what_if::WhatIf;
use crate::words::{at_rest, called_at, capital, plain_at, plain_cause};

/// Rivals, correlations, floor, trials on simulated recordings, and what could have been overlooked; nothing where nothing was concluded.
pub fn body(
    report: &Report,
    curves: &Curves,
    what_if: Option<&WhatIf>,
    charts: &mut Vec<Chart>,
) -> Option<Markup> {
    let floor = report.floor.as_ref()?;
    let alike = what_if.and_then(WhatIf::correlations);
    Some(html! {
        p { "From the noise of the sensors it is computed what a perfect model would leave over: " strong { (with_unit(floor.predicted, &floor.unit)) }
            ". The old model leaves " strong { (significant(floor.ratio_before, 3)) } " times as much, the new one " strong { (significant(floor.ratio_after, 3)) } " times." }
        (rivals(&report.explanations))
        @if let Some(alike) = alike { (alike) }
        (trials(report))
        (directions(report))
        (held(report))
        (effects(report))
        @if let Some(left) = left_over::body(curves, charts) { (left) }
        (not_seen(report))
    })
}

/// Explanations that are drawn; the report has all.
const DRAWN: usize = 5;
/// Below this probability an explanation is no rival.
const NO_RIVAL: f64 = 0.005;

/// From this probability on a second explanation is a rival that a reader has to see.
const RIVAL: f64 = 0.03;

/// The explanations that were weighed, as bars of their probabilities.
fn rivals(all: &[ExplanationReport]) -> Markup {
    let all = by_name(all);
    let drawn = all.iter().take(DRAWN).enumerate();
    let drawn: Vec<&(String, f64)> = drawn
        .filter(|(k, (_, probability))| *k < 2 || *probability >= NO_RIVAL)
        .map(|(_, own)| own)
        .collect();
    // One that stands alone is told by its names; its bars are for who doubts it.
    let is_open = all
        .get(1)
        .is_some_and(|(_, probability)| *probability >= RIVAL);
    html! { @if !drawn.is_empty() {
        details open[is_open] { summary { "The explanations that were weighed" } figure {
            div.scroll { table.bars #rivals {
                caption { "How probable each is beside the others." }
                thead { tr { th scope="col" { "explanation" } th scope="col" { "probability" } } }
                tbody { @for (names, share) in drawn { tr {
                    th scope="row" { (names) }
                    td style={ "--share: " (format!("{share:.3}")) } { (probability(*share)) }
                } } }
            } }
            div.tools { button type="button" data-save-table="rivals" aria-label="Save CSV: the explanations that were weighed" { "Save CSV" } }
        } }
    } }
}

/// Explanations in words with their probabilities, in their order. Two that name the same, in
/// absolute numbers and as a share of a torque for instance, are one.
fn by_name(all: &[ExplanationReport]) -> Vec<(String, f64)> {
    let mut named: Vec<(String, f64)> = Vec::new();
    for own in all {
        let names: Vec<String> = own.names.iter().map(|name| plain_cause(name)).collect();
        let words = match names.is_empty() {
            true => "Nothing is left out".to_owned(),
            false => capital(&names.join(" + ")),
        };
        match named.iter_mut().find(|(known, _)| *known == words) {
            Some((_, share)) => *share += own.probability,
            None => named.push((words, own.probability)),
        }
    }
    named
}

fn effects(report: &Report) -> Markup {
    html! { @if !report.effects.is_empty() {
        details { summary { "What stands behind the probabilities" }
            div.scroll { table.grid {
                caption { "Cross-validation: by how many standard errors blocks of time that were left out are predicted better with the name than without it. Resampling: the share of resampled recordings in which it is named again. Explained: the share of the misfit that goes with it." }
                thead { tr { th scope="col" { "name" } th.number scope="col" { "cross-validation" } th.number scope="col" { "resampling" } th.number scope="col" { "explained" } } }
                tbody { @for effect in &report.effects { tr {
                    th scope="row" { (called_at(effect.mechanism, effect.joint)) }
                    td.number { (format!("{:.1}", effect.z)) } td.number { (percent(effect.inclusion)) } td.number { (percent(effect.share_explained)) }
                } } }
            } }
        }
    } }
}

fn trials(report: &Report) -> Markup {
    let Some(own) = &report.self_calibration else {
        return html! {};
    };
    let named = |all: &[NamedRate]| {
        html! { @for own in all { li { (plain_cause(&own.name)) ": " (rate(own.rate))
        @if 2 * own.rate.count < own.rate.of { strong { " – it stands in for something else: do not believe it" } } } } }
    };
    html! {
        h3 { "Tried on simulated recordings like this one" }
        p { "With nothing left out, something was named in " (rate(own.false_alarms)) "." }
        @if let Some(exact) = own.exact { p { "With what was found left out, exactly that was named in " (rate(exact)) ". One by one:" } ul { (named(&own.found_again)) } }
        @if !own.false_names.is_empty() { p { "Named without being there:" } ul { @for own in &own.false_names { li { (plain_cause(&own.name)) ": " (rate(own.rate)) } } } }
        p.soft { (own.protocol) }
    }
}

fn directions(report: &Report) -> Markup {
    html! { @if !report.null_directions.is_empty() {
        h3 { "Numbers that this recording does not tell apart" }
        ul { @for own in &report.null_directions { li { (plain_at(own.mechanism, None)) ": " (own.meaning) } } }
    } }
}

fn held(report: &Report) -> Markup {
    let Some(held) = &report.held else {
        return html! {};
    };
    let torque = |size: f64| with_unit(size, &held.unit);
    html! {
        @if !held.joints.is_empty() {
            details { summary { "Pushed and did not move" }
            div.scroll { table.grid {
                caption { "Where one brake alone was at rest, it held what it was pushed with. The equation that tells this was not fitted, so it is evidence of its own. Each row is the moment that says most; up to five standard deviations of the push are noise." }
                thead { tr { th scope="col" { "joint" } th.number scope="col" { "seen at rest" } th.number scope="col" { "pushed with" } th.number scope="col" { "old model holds up to" } th.number scope="col" { "new model holds up to" } th scope="col" { "verdict" } } }
                tbody { @for own in &held.joints { tr {
                    th scope="row" { (own.joint) }
                    td.number { (with_unit(own.seen_s, "s")) } td.number { (significant(own.pushed, 3)) " ± " (torque(own.pushed_deviation)) } td.number { (torque(own.holds_nominal)) } td.number { (torque(own.holds)) }
                    td { (at_rest(own, &held.unit)) }
                } } }
            } }
            }
        }
        @if held.all_seen_s > 0.0 { p { "For " (with_unit(held.all_seen_s, "s")) " all brakes were at rest. What each of them held then cannot be told; nothing is attributed to any." } }
    }
}

fn not_seen(report: &Report) -> Markup {
    html! { @if !report.not_seen.is_empty() {
        details {
            summary { "What was not seen, and how large it could be" }
            div.scroll { table.grid #not-seen {
                caption { "An effect smaller than this could hide in this recording." }
                thead { tr { th scope="col" { "effect" } th scope="col" { "joint" } th scope="col" { "number" } th.number scope="col" { "least visible" } th scope="col" { "unit" } } }
                tbody { @for own in &report.not_seen { tr {
                    th scope="row" { (plain_at(own.mechanism, None)) } td { (own.joint.unwrap_or("–")) } td { (own.parameter.replace('_', " ")) }
                    td.number { (significant(own.minimum_detectable, 3)) } td { (if own.unit == "1" { "–" } else { &own.unit }) }
                } } }
            } }
            div.tools { button type="button" data-save-table="not-seen" { "Save CSV" } }
        }
    } }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn explanations_that_name_the_same_are_one_bar() {
        let of = |names: &[&str], probability| ExplanationReport {
            names: names.iter().map(|name| (*name).to_owned()).collect(),
            probability,
            leaves: 1.9,
        };
        let all = [
            of(&["viscous at C"], 0.75),
            of(&[], 0.125),
            of(&["viscous at C"], 0.0625),
        ];
        let shown = by_name(&all);
        assert_eq!(shown.len(), 2);
        assert_eq!(shown[0].1, 0.8125);
        assert_eq!(shown[1], ("Nothing is left out".to_owned(), 0.125));
    }
}
