//! This file writes what a design found for a person to read.

use std::path::Path;

use rigproof_model::linkage::workspace::Figures;

use super::tables::{deg, statements};
use super::{Design, Drawn};
use crate::text::{join, section};

/// How many pairs of a sweep are listed.
const LISTED: usize = 10;

/// The report in sections.
pub fn report(design: &Design, out: &Path, files: &[String]) -> String {
    let linkages = design.drawn.iter().map(linkage);
    let concepts = design.concepts.iter().filter_map(|compared| {
        let name = compared.concept.name();
        compared.figures.map(|figures| line(name, &figures))
    });
    let displays = design
        .displays
        .iter()
        .filter_map(|(name, figures)| figures.as_ref().map(|figures| line(name, figures)));
    let statements = statements(design);
    let statements = statements.iter().flat_map(|statement| {
        [
            format!(
                "  {}: {}: {}",
                statement.place, statement.statement, statement.stated
            ),
            format!("    {}: {}", statement.verdict.name(), statement.ours),
        ]
    });
    let paths = files
        .iter()
        .map(|name| format!("  {}", out.join(name).display()));
    join([
        section("Linkages", std::iter::once(head()).chain(linkages)),
        section(
            "Concepts of §4.2 (size of the table, and arms of the PTER, are assumed)",
            std::iter::once(head()).chain(concepts),
        ),
        section(
            "Displays of §2.2 (arms are assumed; Scooter steers anywhere and has no local paths)",
            std::iter::once(head()).chain(displays),
        ),
        sweep(design),
        section("What the thesis says, and what was computed", statements),
        section("Files", paths),
    ])
}

fn head() -> String {
    format!(
        "  {:26} {:>10} {:>12} {:>8} {:>8} {:>8}",
        "", "area (m²)", "≤ 90° apart", "least", "mean", "greatest"
    )
}

fn line(name: &str, figures: &Figures) -> String {
    format!(
        "  {name:26} {:>10.4} {:>10.1} % {:>7.1}° {:>7.1}° {:>7.1}°",
        figures.area_m2,
        100.0 * figures.well_spaced_m2 / figures.area_m2,
        deg(figures.least_rad),
        deg(figures.mean_rad),
        deg(figures.greatest_rad),
    )
}

fn linkage(drawn: &Drawn) -> String {
    line(&drawn.shape.name, &drawn.figures)
}

fn sweep(design: &Design) -> Vec<String> {
    let Some(best) = design.ranked.first() else {
        return Vec::new();
    };
    let best = best.score();
    let rows = design
        .ranked
        .iter()
        .take(LISTED)
        .enumerate()
        .map(|(place, candidate)| {
            let figures = candidate.figures;
            format!(
                "  {:>4} {:>6} {:>6} {:>8.1} % {:>10.3} {:>14.3} {:>8.2}",
                place + 1,
                candidate.l_ae,
                candidate.l_ab,
                100.0 * candidate.score() / best,
                figures.map_or(0.0, |f| f.area_m2),
                figures.map_or(0.0, |f| f.well_spaced_m2),
                figures.map_or(0.0, |f| f.fill),
            )
        });
    let head = format!(
        "  {:>4} {:>6} {:>6} {:>10} {:>10} {:>14} {:>8}",
        "", "L_AE", "L_AB", "score", "area", "well spaced", "fill"
    );
    section(
        "Sweep, lengths in units of L_ED: well-spaced area / (L_AE + L_ED)² × share of its rectangle, per cent of the best",
        std::iter::once(head).chain(rows),
    )
}
