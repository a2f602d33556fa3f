//! This file shows recording, old model and new model, on held-out data where there are such.

use maud::{Markup, html};
use rigproof_diagnose::Curves;
use rigproof_diagnose::report::{FitReport, Report};

use super::place;
use crate::chart::{Axis, Chart, Curve, Span};
use crate::number::{significant, with_unit};
use crate::replay::Replay;
use crate::words::capital;

/// The plots and the replay; nothing where nothing was fitted.
pub fn body(
    report: &Report,
    curves: &Curves,
    replay: Option<&Replay>,
    charts: &mut Vec<Chart>,
) -> Option<Markup> {
    if curves.time_s.is_empty() && report.fit.is_none() {
        return None;
    }
    let mut figures = Vec::new();
    for (chart, caption) in outputs(curves) {
        figures.push(place(charts, chart, &caption));
    }
    // The headline has the error as a number; its course is for who doubts it.
    let mut figures = figures.into_iter();
    let first = figures.next();
    Some(html! {
        @if let Some(figure) = first { (figure) }
        @if let Some(replay) = replay { details { summary { "Watch it move" } (replay.figure()) } }
        @if report.fit.is_some() || figures.len() > 0 {
            details {
                summary { "The error, as numbers and over time" }
                @if let Some(fit) = &report.fit { (errors(fit)) }
                @for figure in figures { (figure) }
            }
        }
        @if let Some(drift) = report.fit.as_ref().and_then(|fit| fit.drift.as_ref()) { p { (drift) } }
    })
}

/// Time stamps, recorded output, before, after.
type Part<'a> = (&'a [f64], &'a [f64], &'a [f64], &'a [f64]);

fn outputs(curves: &Curves) -> Vec<(Chart, Markup)> {
    let fitted = &curves.fitted;
    let held: Part = (
        &curves.time_s,
        &curves.recorded,
        &curves.before,
        &curves.after,
    );
    let own: Part = (
        &fitted.time_s,
        &fitted.recorded,
        &fitted.before,
        &fitted.after,
    );
    let follows =
        matches!((own.0.last(), held.0.first()), (Some(last), Some(first)) if last < first);
    if follows {
        // A point without values between the parts: no line goes from the one to the other.
        let seam = own
            .0
            .last()
            .zip(held.0.first())
            .map_or(0.0, |(last, first)| 0.5 * (last + first));
        let join = |a: &[f64], b: &[f64], between: f64| [a, &[between], b].concat();
        let whole = [
            join(own.0, held.0, seam),
            join(own.1, held.1, f64::NAN),
            join(own.2, held.2, f64::NAN),
            join(own.3, held.3, f64::NAN),
        ];
        let [time, recorded, before, after] = &whole;
        return pair(
            (time, recorded, before, after),
            curves,
            ["output", "error"],
            Some(seam),
            "The blue part at the end was kept aside: no number was fitted to it.",
        );
    }
    let mut both = pair(
        held,
        curves,
        ["output", "error"],
        None,
        "All of it was kept aside: no number was fitted to it.",
    );
    // Another recording has a time of its own.
    both.iter_mut()
        .for_each(|(chart, _)| chart.sync = Some("held"));
    if !own.0.is_empty() {
        both.extend(pair(
            own,
            curves,
            ["fitted-output", "fitted-error"],
            None,
            "This is the recording that was fitted.",
        ));
    }
    both
}

/// The output and its error over time.
fn pair(
    (time, recorded, before, after): Part,
    curves: &Curves,
    [output, error]: [&'static str; 2],
    held_from: Option<f64>,
    remark: &str,
) -> Vec<(Chart, Markup)> {
    if time.is_empty() {
        return Vec::new();
    }
    let axis = |label: &str| Axis {
        label: label.to_owned(),
        unit: curves.unit.clone(),
    };
    let finite = || recorded.iter().copied().filter(|v| v.is_finite());
    let (low, high) = (
        finite().fold(f64::INFINITY, f64::min),
        finite().fold(f64::NEG_INFINITY, f64::max),
    );
    let room = (high - low).max(f64::MIN_POSITIVE);
    let spans = |chart: &mut Chart| {
        let last = time.last().copied().unwrap_or(0.0);
        chart.spans.extend(held_from.map(|from| Span {
            from,
            to: last,
            role: "held",
        }));
    };
    let lines = vec![
        Curve::line("recorded", "recorded", recorded),
        Curve::line("old model", "old", before),
        Curve::line("new model", "new", after),
    ];
    let mut shown = Chart::over_time(
        output,
        &capital(curves.output),
        axis(curves.output),
        time,
        lines,
    );
    // A model that runs away must not flatten what was recorded.
    shown.limits = Some([low - room, high + room]);
    shown.height = 260;
    spans(&mut shown);
    let off =
        |model: &[f64]| -> Vec<f64> { model.iter().zip(recorded).map(|(m, r)| m - r).collect() };
    let lines = vec![
        Curve::line("old model", "old", &off(before)),
        Curve::line("new model", "new", &off(after)),
    ];
    let mut errors = Chart::over_time(
        error,
        "Simulation less recording",
        axis("error"),
        time,
        lines,
    );
    errors.limits = Some([-2.0 * room, 2.0 * room]);
    errors.height = 220;
    spans(&mut errors);
    let caption = html! { "Recorded, and as the two models compute it. " (remark) };
    vec![
        (shown, caption),
        (
            errors,
            html! { "The closer to zero, the better. " (remark) },
        ),
    ]
}

fn errors(fit: &FitReport) -> Markup {
    let parts = [("fitted", Some(fit.train)), ("kept aside", fit.held_out)];
    html! {
        div.scroll { table.grid {
            caption { "Error of the simulation, root mean square; in brackets in per cent of how much the output varies." }
            thead { tr { th scope="col" { "part" } th.number scope="col" { "old model" } th.number scope="col" { "new model" } } }
            tbody { @for (name, errors) in parts { @if let Some(errors) = errors { tr {
                th scope="row" { (name) }
                td.number { (with_unit(errors.before, &fit.unit)) " (" (significant(errors.nrmse_before, 3)) " %)" }
                td.number { (with_unit(errors.after, &fit.unit)) " (" (significant(errors.nrmse_after, 3)) " %)" }
            } } } }
        } }
        @if !fit.horizon.is_empty() {
                div.scroll { table.grid {
                    caption { "Error some time after the simulation was let go from the recorded state." }
                    thead { tr { th.number scope="col" { "after" } th scope="col" { "part" } th.number scope="col" { "old model" } th.number scope="col" { "new model" } th.number scope="col" { "tip, old" } th.number scope="col" { "tip, new" } } }
                    tbody { @for own in &fit.horizon { tr {
                        td.number { (with_unit(own.horizon_s, "s")) } td { (own.part) } td.number { (with_unit(own.before, &own.unit)) } td.number { (with_unit(own.after, &own.unit)) }
                        td.number { (own.tip_before_mm.map_or_else(|| "–".to_owned(), |mm| with_unit(mm, "mm"))) } td.number { (own.tip_after_mm.map_or_else(|| "–".to_owned(), |mm| with_unit(mm, "mm"))) }
                    } } }
                } }
        }
    }
}
