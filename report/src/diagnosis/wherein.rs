//! This file shows where the model goes wrong: when, at which joint, and in which kind of motion.

use maud::{Markup, html};
use rigproof_diagnose::report::{Located, Report};

use super::{arm, drawing};
use crate::number::{percent, significant};

/// Drawing, heat map and time line; nothing where nothing was concluded.
pub fn body(report: &Report, when: Option<Markup>) -> Option<Markup> {
    if report.located.is_empty() && when.is_none() {
        return None;
    }
    Some(html! {
        p.lead { (report.arm.as_ref().and_then(arm::worst).unwrap_or_else(|| worst(report))) }
        @if let Some(arm) = &report.arm { (arm::body(arm, report)) }
        // Where something is named the names are what to act on; else the place is.
        details open[report.effects.is_empty()] { summary { "Place by place" }
            @if report.plant == "rig" { (drawing::figure(report)) }
            (heat(report))
        }
        @if let Some(when) = when { (when) }
    })
}

/// Below this ratio no kind of motion stands out.
const EVEN: f64 = 1.3;

/// Whether a regime is where the motion turns back: a resistance can have any size up to its level there, so little can be judged.
fn is_reversal(regime: &str) -> bool {
    regime.ends_with("of a reversal")
}

/// The regime that stands first where the model can be judged, in a sentence, and how much lies at reversals.
fn worst(report: &Report) -> String {
    let mut judged = report
        .located
        .iter()
        .filter(|own| !is_reversal(&own.regime));
    let Some(first) = judged.next() else {
        return "Nothing could be told apart by place.".to_owned();
    };
    let share = |own: &Located| {
        format!(
            "{} of what it cannot explain lies there, in {} of the time.",
            percent(own.share),
            percent(own.share_of_time)
        )
    };
    let most = if ratio(first) < EVEN {
        "The old model fails about alike in every kind of motion: none stands out.".to_owned()
    } else {
        let joint = first
            .joint
            .map_or_else(String::new, |joint| format!(" at joint {joint}"));
        format!(
            "The old model fails most{joint} in this kind of motion: {}. {}",
            first.regime,
            share(first)
        )
    };
    let turning = report.located.iter().find(|own| is_reversal(&own.regime));
    match turning {
        Some(own) => format!("{most} At reversals: {}", share(own)),
        None => most,
    }
}

/// Kinds of motion that are shown; the rest is folded up.
const ROWS: usize = 4;

/// The heat map: a row a regime, the culprit first, and a column a joint where there are several; reversals stand apart.
fn heat(report: &Report) -> Markup {
    let mut joints: Vec<Option<&str>> = Vec::new();
    let mut regimes: Vec<(&str, f64)> = Vec::new();
    for place in &report.located {
        if !joints.contains(&place.joint) {
            joints.push(place.joint);
        }
        let own = ratio(place);
        match regimes.iter_mut().find(|(name, _)| *name == place.regime) {
            Some((_, most)) => *most = own.max(*most),
            None => regimes.push((&place.regime, own)),
        }
    }
    joints.sort_unstable_by_key(|joint| joint.map_or(9, |joint| "AEBC".find(joint).unwrap_or(8)));
    regimes.sort_by(|a, b| b.1.total_cmp(&a.1));
    let names = regimes.into_iter().map(|(name, _)| name);
    let (turning, mut judged): (Vec<&str>, Vec<&str>) = names.partition(|name| is_reversal(name));
    // Beside its counterpart it is a row twice.
    judged.retain(|name| turning.is_empty() || *name != "away from reversals");
    let (first, rest) = judged.split_at(judged.len().min(ROWS));
    let mut groups = vec![("", first)];
    if !turning.is_empty() {
        groups = vec![
            ("Where the model can be judged", first),
            ("At reversals, where little can be told", &turning),
        ];
    }
    html! {
        figure {
            (regime_table("heat-map", report, &joints, &groups))
            @if !rest.is_empty() { details { summary { "Other kinds of motion" } (regime_table("heat-map-rest", report, &joints, &[("", rest)])) } }
            div.tools { button type="button" data-save-table="heat-map" aria-label="Save CSV: in which motion" { "Save CSV" } }
        }
    }
}

/// Regimes in groups, each with its name where there are several.
fn regime_table(
    id: &str,
    report: &Report,
    joints: &[Option<&str>],
    groups: &[(&str, &[&str])],
) -> Markup {
    let at = |regime: &str, joint: Option<&str>| {
        let mut all = report.located.iter();
        all.find(|p| p.regime == regime && p.joint == joint)
    };
    html! {
        div.scroll { table.heat #(id) {
            caption { strong { "In which motion." } " Share of what the old model does not explain, and how many times its share of the time that is. The darker a cell, the greater that ratio." }
            thead { tr {
                th scope="col" { "kind of motion" }
                @for joint in joints { th scope="col" { @match joint { Some(joint) => { "joint " (joint) } None if joints.len() > 1 => "whole rig", None => "share" } } }
            } }
            @for (group, regimes) in groups { tbody {
                @if !group.is_empty() { tr.group { th scope="rowgroup" colspan=(joints.len() + 1) { (group) } } }
                @for regime in *regimes { tr {
                    th scope="row" { (regime) }
                    @for joint in joints { @match at(regime, *joint) {
                        Some(place) => td.cell style={ "--share: " (format!("{:.2}", shade(place))) } { (percent(place.share)) " " small { "×" (significant(ratio(place), 2)) } },
                        None => td { "–" },
                    } }
                } }
            } }
        } }
    }
}

/// How many times its share of the time a regime holds of what is not explained.
fn ratio(place: &Located) -> f64 {
    let ratio = place.share / place.share_of_time.max(1e-9);
    if ratio.is_finite() {
        ratio.max(0.0)
    } else {
        0.0
    }
}

/// The ratio that is darkest.
const DARKEST: f64 = 8.0;

/// From 0 where a regime holds its share of the time or less, to 1 where it holds eight times as much, by equal steps of the ratio's logarithm.
fn shade(place: &Located) -> f64 {
    (libm::log(ratio(place).max(1.0)) / libm::log(DARKEST)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_is_the_darker_the_more_than_its_share_of_the_time_it_holds() {
        let at = |share: f64, share_of_time: f64| {
            shade(&Located {
                output: "effort",
                joint: None,
                from_s: 0.0,
                to_s: 9.5,
                regime: "fast".to_owned(),
                share,
                share_low95: share,
                share_high95: share,
                share_after: 0.0,
                share_of_time,
            })
        };
        assert_eq!(at(0.3, 0.6), 0.0);
        assert!(at(0.02, 0.01) > at(0.7, 0.5));
        assert_eq!(at(0.9, 0.1), 1.0);
        assert_eq!(at(0.0, 0.0), 0.0);
    }
}
