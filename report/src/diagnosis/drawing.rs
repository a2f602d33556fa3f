//! This file draws the five-bar as a sketch and marks the joint that is to blame.

use std::collections::BTreeSet;

use maud::{Markup, html};
use rigproof_diagnose::report::Report;

/// Joints of the sketch: name, and place.
const JOINTS: [(&str, f64, f64); 4] = [
    ("A", 210.0, 250.0),
    ("E", 130.0, 130.0),
    ("B", 350.0, 250.0),
    ("C", 430.0, 130.0),
];
const TIP: (f64, f64) = (280.0, 50.0);

/// The sketch of the linkage.
pub fn figure(report: &Report) -> Markup {
    // Two may be named at one joint.
    let named: BTreeSet<&str> = report.effects.iter().filter_map(|e| e.joint).collect();
    // Where nothing is named, the place that the old model explains worst.
    let worst = report.located.first().and_then(|place| place.joint);
    let marked = if named.is_empty() && report.effects.is_empty() {
        worst.into_iter().collect()
    } else {
        Vec::from_iter(named)
    };
    let whole = marked.is_empty() && !report.effects.is_empty();
    let words = match (marked.as_slice(), whole) {
        ([], true) => {
            "What is named acts on the whole linkage or its sensors, at no single joint.".to_owned()
        }
        ([], false) => "Nothing is marked: no place stands out.".to_owned(),
        (joints, _) => format!("Marked: joint {}.", joints.join(", joint ")),
    };
    html! {
        figure {
            figcaption { strong { "At which place." } " " (words) }
            (five_bar(&marked))
            div.tools { button type="button" data-save-drawing="sketch" aria-label="Save SVG: at which place" { "Save SVG" } }
        }
    }
}

fn five_bar(marked: &[&str]) -> Markup {
    let [(_, ax, ay), (_, ex, ey), (_, bx, by), (_, cx, cy)] = JOINTS;
    let (tx, ty) = TIP;
    html! {
        svg.drawing #sketch viewBox="40 10 480 290" role="img" aria-label={ "Five-bar linkage with joints A, E, B and C; marked: " (marked.join(", ")) } {
            path d={ "M" (ax) " " (ay) "L" (ex) " " (ey) "L" (tx) " " (ty) "L" (cx) " " (cy) "L" (bx) " " (by) } fill="none" stroke="var(--recorded)" stroke-width="9" stroke-linejoin="round" {}
            path d={ "M" (ax - 60.0) " " (ay + 14.0) "H" (bx + 60.0) } stroke="var(--line)" stroke-width="10" {}
            circle cx=(tx) cy=(ty) r="10" fill="var(--new)" {}
            text x=(tx) y=(ty - 18.0) font-size="15" text-anchor="middle" { "tip (the hand)" }
            @for (name, x, y) in JOINTS {
                @let is_marked = marked.contains(&name);
                @if is_marked { circle cx=(x) cy=(y) r="27" fill="none" stroke="var(--old)" stroke-width="5" {} }
                circle cx=(x) cy=(y) r="14" fill=(if is_marked { "var(--old)" } else { "var(--card)" }) stroke="var(--ink)" stroke-width="3" {}
                text x=(if x < TIP.0 { x - 48.0 } else { x + 48.0 }) y=(y + 6.0) font-size="18" font-weight=(if is_marked { "bold" } else { "normal" }) text-anchor="middle" { (name) }
            }
        }
    }
}
