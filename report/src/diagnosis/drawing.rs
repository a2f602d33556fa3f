//! This file draws the rig as a sketch and marks the joint that is to blame.

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

/// The sketch of the plant.
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
        ([], true) if report.plant == "rig" => {
            "What is named acts on the whole linkage or its sensors, at no single joint.".to_owned()
        }
        ([], true) => "There is one moving part; what is named acts on it.".to_owned(),
        ([], false) => "Nothing is marked: no place stands out.".to_owned(),
        (joints, _) => format!("Marked: joint {}.", joints.join(", joint ")),
    };
    html! {
        figure {
            figcaption { strong { "At which place." } " " (words) }
            @match report.plant {
                "rig" => (five_bar(&marked)),
                "bench" => (bench(whole)),
                _ => (axis(whole)),
            }
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

fn axis(is_marked: bool) -> Markup {
    html! {
        svg.drawing #sketch viewBox="40 60 480 170" role="img" aria-label="One driven axis: a drive moves a load along a guide" {
            path d="M70 200H490" stroke="var(--line)" stroke-width="10" {}
            rect x="70" y="120" width="90" height="76" rx="8" fill="var(--card)" stroke="var(--ink)" stroke-width="3" {}
            text x="115" y="164" font-size="16" text-anchor="middle" { "drive" }
            path d="M160 158H290" stroke="var(--recorded)" stroke-width="8" {}
            rect x="290" y="110" width="120" height="80" rx="8" fill="var(--card)" stroke=(if is_marked { "var(--old)" } else { "var(--ink)" }) stroke-width=(if is_marked { "6" } else { "3" }) {}
            text x="350" y="156" font-size="16" text-anchor="middle" { "load" }
            path d="M300 92H400M388 84L400 92L388 100M312 84L300 92L312 100" fill="none" stroke="var(--ink)" stroke-width="2.5" {}
            text x="420" y="97" font-size="15" { "position" }
        }
    }
}

fn bench(is_marked: bool) -> Markup {
    html! {
        svg.drawing #sketch viewBox="40 60 480 170" role="img" aria-label="A bench: a motor turns a brake or damper, a sensor meters its torque" {
            path d="M70 200H490" stroke="var(--line)" stroke-width="10" {}
            rect x="70" y="120" width="96" height="76" rx="8" fill="var(--card)" stroke="var(--ink)" stroke-width="3" {}
            text x="118" y="164" font-size="16" text-anchor="middle" { "motion" }
            path d="M166 158H222M286 158H336" stroke="var(--recorded)" stroke-width="8" {}
            circle cx="254" cy="158" r="32" fill="var(--card)" stroke="var(--ink)" stroke-width="3" {}
            text x="254" y="163" font-size="14" text-anchor="middle" { "sensor" }
            rect x="336" y="110" width="152" height="86" rx="8" fill="var(--card)" stroke=(if is_marked { "var(--old)" } else { "var(--ink)" }) stroke-width=(if is_marked { "6" } else { "3" }) {}
            text x="412" y="158" font-size="15" text-anchor="middle" { "brake or damper" }
        }
    }
}
