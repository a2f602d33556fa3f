//! This file draws an arm from its description and goes through it joint by joint.

use maud::{Markup, html};
use rigproof_diagnose::report::{ArmReport, JointReport, Report, is_of_joint};

use crate::number::{percent, probability, with_unit};
use crate::table::table;
use crate::words::called;

/// Width and height of the drawing, px.
const SIZE: [f64; 2] = [560.0, 380.0];
/// The part of it that the arm has; the rest is for names.
const ARM: [f64; 2] = [290.0, 270.0];
/// Radius of the disc of a joint that has all of what is not explained, px.
const WHOLE: f64 = 55.0;

/// The drawing and the table.
pub fn body(arm: &ArmReport, report: &Report) -> Markup {
    html! {
        figure {
            figcaption { strong { "At which joint." } " The larger a disc, the greater the joint's share of what the old model does not explain. The arm stands as recorded at " (with_unit(arm.posture_s, "s")) ", " (seen_along(arm)) "." }
            (drawing(arm))
            div.tools { button type="button" data-save-drawing="arm" aria-label="Save SVG: at which joint" { "Save SVG" } }
        }
        (table("joints", &caption(arm), &["joint", "old model", "new model", "share, old", "what was left out"], &rows(arm, report)))
    }
}

/// The joint that has most of what is not explained, in a sentence.
pub fn worst(arm: &ArmReport) -> Option<String> {
    let worst = arm.worst()?;
    Some(format!(
        "The old model fails most at {}: {} of the effort that it cannot explain is there.",
        worst.joint,
        percent(worst.share)
    ))
}

fn caption(arm: &ArmReport) -> String {
    let part = match arm.part {
        "held_out" => "on held-out data",
        _ => "on the fitted data",
    };
    format!(
        "Joint by joint: the effort that inverse dynamics leaves over, root mean square, {part}; what was left out, with its probability."
    )
}

fn rows(arm: &ArmReport, report: &Report) -> Vec<Vec<String>> {
    let row = |own: &JointReport| {
        let here = report
            .effects
            .iter()
            .filter(|effect| is_at(arm, own, effect.joint));
        let named: Vec<String> = here
            .map(|effect| {
                let probability = probability(effect.probability);
                format!("{} ({probability})", called(effect.mechanism))
            })
            .collect();
        vec![
            own.joint.to_owned(),
            with_unit(own.before, &own.unit),
            with_unit(own.after, &own.unit),
            percent(own.share),
            named.join(", "),
        ]
    };
    arm.joints.iter().map(row).collect()
}

/// Whether an effect at a place is told in a row: the one with its name, or the first of its joint.
fn is_at(arm: &ArmReport, row: &JointReport, place: Option<&str>) -> bool {
    let Some(place) = place else {
        return false;
    };
    let rows = || arm.joints.iter();
    let own = rows().find(|own| own.joint == place);
    let own = own.or_else(|| rows().find(|own| is_of_joint(place, own.joint)));
    own.is_some_and(|own| own.joint == row.joint)
}

/// Between which places the arm stands along an axis of the base, m.
fn ends(arm: &ArmReport, axis: usize) -> [f64; 2] {
    let along = || {
        arm.line_m
            .iter()
            .filter_map(move |point| point.get(axis))
            .copied()
    };
    let low = along().fold(f64::INFINITY, f64::min);
    [low, along().fold(f64::NEG_INFINITY, f64::max)]
}

/// The axes of the base that go to the right and up in the drawing: those along which the arm reaches furthest.
fn axes(arm: &ArmReport) -> [usize; 2] {
    let extent = |axis: usize| {
        let [low, high] = ends(arm, axis);
        high - low
    };
    let [x, y, z] = [0, 1, 2].map(extent);
    match (z < x.min(y), x < y) {
        (true, _) => [0, 1],
        (false, true) => [1, 2],
        (false, false) => [0, 2],
    }
}

fn seen_along(arm: &ArmReport) -> &'static str {
    match axes(arm) {
        [0, 1] => "seen from above: x of the base to the right, y up",
        [1, 2] => "seen along x of the base: y to the right, z up",
        _ => "seen along y of the base: x to the right, z up",
    }
}

/// The points of the arm in the drawing.
fn points(arm: &ArmReport) -> Vec<[f64; 2]> {
    let axes = axes(arm);
    let [[left, right], [low, high]] = axes.map(|axis| ends(arm, axis));
    let [width, height] = ARM;
    let scale = (width / (right - left).max(1e-9)).min(height / (high - low).max(1e-9));
    let margin = 0.5 * (SIZE[1] - height);
    let beside = 0.5 * (width - scale * (right - left));
    let place = |[x, y]: [f64; 2]| {
        [
            margin + beside + scale * (x - left),
            margin + scale * (high - y),
        ]
    };
    let each = arm.line_m.iter();
    let flat = each.map(|point| axes.map(|axis| point.get(axis).copied().unwrap_or(0.0)));
    flat.map(place).collect()
}

fn drawing(arm: &ArmReport) -> Markup {
    let points = points(arm);
    let path = points.iter().enumerate().map(|(k, [x, y])| {
        let letter = if k == 0 { 'M' } else { 'L' };
        format!("{letter}{x:.1} {y:.1}")
    });
    let path: String = path.collect();
    let at = |joint: &JointReport| points.get(joint.at).copied().unwrap_or_default();
    let base = points.first().copied().unwrap_or_default();
    let tip = points.last().copied().unwrap_or_default();
    let [width, height] = SIZE;
    html! {
        svg.drawing #arm viewBox={ "0 0 " (width) " " (height) } role="img" aria-label="The arm and the share of each joint: the numbers stand in the table below" {
            path d=(path) fill="none" stroke="var(--recorded)" stroke-width="7" stroke-linejoin="round" stroke-linecap="round" {}
            path d=(format!("M{:.1} {:.1}h60", base[0] - 30.0, base[1] + 4.0)) stroke="var(--line)" stroke-width="8" {}
            circle cx=(px(tip[0])) cy=(px(tip[1])) r="6" fill="var(--new)" {}
            @for joint in &arm.joints {
                @let [x, y] = at(joint);
                circle cx=(px(x)) cy=(px(y)) r=(px(WHOLE * joint.share.max(0.0).sqrt())) fill="var(--old)" fill-opacity="0.35" stroke="var(--old)" {}
                circle cx=(px(x)) cy=(px(y)) r="5" fill="var(--card)" stroke="var(--ink)" stroke-width="2" {}
            }
            @for (joint, y) in labels(arm, &points) {
                @let [from, height] = at(joint);
                path d=(format!("M{from:.1} {height:.1}L{:.1} {y:.1}", LABEL - 6.0)) fill="none" stroke="var(--line)" stroke-width="1" {}
                text x=(LABEL) y=(px(y + 5.0)) font-size="14" { (joint.joint) " " (percent(joint.share)) }
            }
        }
    }
}

/// Where the names begin, px.
const LABEL: f64 = 400.0;
/// The least distance of two names, px.
const APART: f64 = 20.0;

/// Each joint with the height of its name: beside the joint where there is room, the order kept.
fn labels<'a>(arm: &'a ArmReport, points: &[[f64; 2]]) -> Vec<(&'a JointReport, f64)> {
    let height = |joint: &JointReport| points.get(joint.at).map_or(0.0, |[_, y]| *y);
    let mut sorted: Vec<(&JointReport, f64)> =
        arm.joints.iter().map(|own| (own, height(own))).collect();
    sorted.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut least = APART;
    for (_, y) in &mut sorted {
        *y = y.max(least);
        least = *y + APART;
    }
    let mut most = SIZE[1] - APART;
    for (_, y) in sorted.iter_mut().rev() {
        *y = y.min(most);
        most = *y - APART;
    }
    sorted
}

fn px(length: f64) -> String {
    format!("{length:.1}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arm(names: &[&'static str], line_m: &[[f64; 3]]) -> ArmReport {
        let joint = |(at, joint): (usize, &&'static str)| JointReport {
            joint,
            unit: "N·m".to_owned(),
            before: 1.0,
            after: 0.5,
            share: 1.0 / names.len() as f64,
            at: 1 + at.min(1),
        };
        ArmReport {
            part: "held_out",
            joints: names.iter().enumerate().map(joint).collect(),
            posture_s: 2.5,
            line_m: line_m.to_vec(),
        }
    }

    #[test]
    fn an_arm_is_drawn_within_its_room_and_seen_from_where_it_reaches_furthest() {
        let planar = [[0.0, 0.0, 0.2], [0.3, 0.1, 0.2], [0.5, -0.6, 0.2]];
        let tall = [[0.0; 3], [0.0, 0.01, 0.7], [0.3, 0.0, 0.9]];
        let deep = [[0.0; 3], [0.0, 0.5, 0.7], [0.1, 0.9, 0.9]];
        for (line, seen) in [(planar, [0, 1]), (tall, [0, 2]), (deep, [1, 2])] {
            let arm = arm(&["one"], &line);
            assert_eq!(axes(&arm), seen);
            for [x, y] in points(&arm) {
                assert!((WHOLE - 1.0..SIZE[0]).contains(&x), "{x}");
                assert!((WHOLE - 1.0..SIZE[1] - WHOLE + 1.0).contains(&y), "{y}");
            }
        }
    }

    #[test]
    fn names_of_joints_at_one_place_do_not_cover_each_other() {
        let names = ["a", "b", "c", "d", "e", "f", "g", "h", "i"];
        let arm = arm(&names, &[[0.0; 3], [0.1, 0.0, 0.0], [0.1, 0.0, 0.5]]);
        let heights: Vec<f64> = labels(&arm, &points(&arm))
            .iter()
            .map(|own| own.1)
            .collect();
        assert!(
            heights
                .windows(2)
                .all(|pair| pair[1] - pair[0] > APART - 1e-9)
        );
        assert!(heights.iter().all(|y| (APART - 1e-9..SIZE[1]).contains(y)));
    }

    #[test]
    fn an_effect_in_a_gear_stands_in_the_row_of_its_joint() {
        let arm = arm(&["elbow", "elbow.motor"], &[[0.0; 3]; 3]);
        let rows = |place: &'static str| -> Vec<bool> {
            arm.joints
                .iter()
                .map(|row| is_at(&arm, row, Some(place)))
                .collect()
        };
        assert_eq!(rows("elbow"), [true, false]);
        assert_eq!(rows("elbow.motor"), [false, true]);
        assert_eq!(rows("elbow.transmission"), [true, false]);
        assert_eq!(rows("elbow2"), [false, false]);
    }
}
