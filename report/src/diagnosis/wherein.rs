//! This file shows where the model goes wrong: when, at which joint, and in which kind of motion.

use maud::{Markup, html};
use rigproof_diagnose::Curves;
use rigproof_diagnose::report::{Located, Report};

use super::{counted, drawing, place};
use crate::chart::{Axis, Chart, Curve, Span};
use crate::number::{percent, significant};

/// Stretches of the time line.
const STRETCHES: usize = 120;
/// A stretch is unexplained when its residual is so many times the noise.
const UNEXPLAINED: f64 = 2.0;

/// Time line, drawing and heat map; nothing where nothing was concluded.
pub fn body(report: &Report, curves: &Curves, charts: &mut Vec<Chart>) -> Option<Markup> {
    if report.located.is_empty() && curves.window_time_s.is_empty() {
        return None;
    }
    let line = (!curves.window_time_s.is_empty()).then(|| time_line(curves));
    Some(html! {
        p.lead { (worst(report)) }
        @if report.plant == "rig" { (drawing::figure(report)) }
        @if let Some((chart, caption)) = line { (place(charts, chart, &caption)) }
        (heat(report))
    })
}

/// Below this ratio no kind of motion stands out.
const EVEN: f64 = 1.3;

/// The regime that the report puts first in a sentence.
fn worst(report: &Report) -> String {
    let Some(first) = report.located.first() else {
        return "Nothing could be told apart by place.".to_owned();
    };
    if ratio(first) < EVEN {
        return "The old model fails about alike in every kind of motion: none stands out."
            .to_owned();
    }
    let joint = first
        .joint
        .map_or_else(String::new, |joint| format!(" at joint {joint}"));
    format!(
        "The old model fails most{joint} in this kind of motion: {}. {} of what it cannot explain lies there, in {} of the time.",
        first.regime,
        percent(first.share),
        percent(first.share_of_time),
    )
}

/// How many times the noise the residual is, stretch by stretch.
fn time_line(curves: &Curves) -> (Chart, Markup) {
    let size = curves.window_time_s.len().div_ceil(STRETCHES).max(1);
    let over = |values: &[f64]| -> Vec<f64> {
        let rms = |part: &[f64]| {
            let finite = part.iter().filter(|v| v.is_finite());
            let (count, sum) =
                finite.fold((0.0, 0.0), |(count, sum), v| (count + 1.0, sum + v * v));
            if count > 0.0 {
                (sum / count).sqrt() / curves.floor
            } else {
                f64::NAN
            }
        };
        values.chunks(size).map(rms).collect()
    };
    let begins: Vec<f64> = curves
        .window_time_s
        .chunks(size)
        .filter_map(|part| part.first().copied())
        .collect();
    let (before, after) = (
        over(&counted(curves, &curves.residual_before)),
        over(&counted(curves, &curves.residual_after)),
    );
    let last = curves.window_time_s.last().copied().unwrap_or(0.0);
    let y = Axis {
        label: "left over ÷ noise".to_owned(),
        unit: "1".to_owned(),
    };
    let spans = unexplained(&begins, last, &before);
    let marked = spans.iter().map(|span| span.to - span.from).sum::<f64>();
    let whole = last - begins.first().copied().unwrap_or(0.0);
    let curves = vec![
        Curve::line("old model", "old", &before),
        Curve::line("new model", "new", &after),
    ];
    let mut chart = Chart::over_time("time-line", "When", y, &begins, curves);
    chart.spans = spans;
    chart.height = 220;
    chart.log_y = true;
    chart.band = Some([0.0, 1.0]);
    let caption = html! {
        "What is left over, in units of what the sensors' noise alone would leave (green up to 1), on a logarithmic scale. Marked in yellow: stretches that the old model does not explain, "
        (percent(if whole > 0.0 { marked / whole } else { 0.0 })) " of the fitted part. Gaps: at rest and where the motion turns back nothing can be told."
    };
    (chart, caption)
}

/// Neighbouring stretches that are unexplained, joined.
fn unexplained(begins: &[f64], last: f64, ratios: &[f64]) -> Vec<Span> {
    let mut spans: Vec<Span> = Vec::new();
    let ends = begins.iter().skip(1).copied().chain([last]);
    for ((from, to), ratio) in begins.iter().copied().zip(ends).zip(ratios) {
        if ratio.is_nan() || *ratio <= UNEXPLAINED {
            continue;
        }
        match spans.last_mut() {
            Some(span) if span.to >= from => span.to = to,
            _ => spans.push(Span {
                from,
                to,
                role: "mark",
            }),
        }
    }
    spans
}

/// Kinds of motion that are shown; the rest is folded up.
const ROWS: usize = 6;

/// The heat map: a row a regime, the culprit first, and a column a joint where there are several.
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
    let regimes: Vec<&str> = regimes.into_iter().map(|(name, _)| name).collect();
    let (first, rest) = regimes.split_at(regimes.len().min(ROWS));
    html! {
        figure {
            (regime_table("heat-map", report, &joints, first))
            @if !rest.is_empty() { details { summary { "Other kinds of motion" } (regime_table("heat-map-rest", report, &joints, rest)) } }
            div.tools { button type="button" data-save-table="heat-map" aria-label="Save CSV: in which motion" { "Save CSV" } }
        }
    }
}

fn regime_table(id: &str, report: &Report, joints: &[Option<&str>], regimes: &[&str]) -> Markup {
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
            tbody { @for regime in regimes { tr {
                th scope="row" { (regime) }
                @for joint in joints { @match at(regime, *joint) {
                    Some(place) => td.cell style={ "--share: " (format!("{:.2}", shade(place))) } { (percent(place.share)) " " small { "×" (significant(ratio(place), 2)) } },
                    None => td { "–" },
                } }
            } } }
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

    #[test]
    fn neighbouring_stretches_are_one() {
        let spans = unexplained(&[0.0, 1.5, 2.5, 4.0], 5.25, &[2.5, 3.1, 0.9, f64::NAN]);
        assert_eq!(
            spans,
            [Span {
                from: 0.0,
                to: 2.5,
                role: "mark"
            }]
        );
        let last = unexplained(&[0.0, 1.5], 5.25, &[0.7, 2.6]);
        assert_eq!(last[0].to, 5.25);
    }
}
