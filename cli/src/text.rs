//! This file is the report as text: what somebody at the rig reads.

mod fit;
pub mod found;
mod limits;
mod next;
pub mod summary;
mod trust;

use rigproof_diagnose::report::{Report, Verdict};
pub use rigproof_report::number;

/// The report in sections; one that has nothing to say is left out.
pub fn report(report: &Report) -> String {
    let head = format!("{}: {}", report.verdict.name(), report.summary);
    let sections = [
        vec![head],
        found::place(report),
        found::naming(report),
        found::inverse(report),
        found::effects(report),
        found::nominal(report),
        fit::before_after(report),
        limits::left_over(report),
        next::experiment(report),
        limits::held(report),
        limits::not_seen(report),
        trust::simulated(report),
        section("How it was measured", report.protocol.iter().map(indented)),
    ];
    join(sections)
}

/// Whether everything holds that a diagnosis promises: exit code 0, or 1.
pub fn holds(report: &Report) -> bool {
    let usable = !matches!(report.verdict, Verdict::DataFault | Verdict::NotExcited);
    let named = report.changes_the_model();
    let improved = report.fit.as_ref().is_some_and(|fit| fit.improved);
    usable && (!named || improved)
}

/// A heading and its lines, or nothing where there is no line.
pub fn section(heading: &str, lines: impl IntoIterator<Item = String>) -> Vec<String> {
    let mut section: Vec<String> = lines.into_iter().collect();
    if !section.is_empty() {
        section.insert(0, heading.to_owned());
    }
    section
}

/// Sections with an empty line between them.
pub fn join(sections: impl IntoIterator<Item = Vec<String>>) -> String {
    let filled = sections.into_iter().filter(|section| !section.is_empty());
    let sections: Vec<String> = filled.map(|section| section.join("\n")).collect();
    sections.join("\n\n")
}

fn indented(line: impl AsRef<str>) -> String {
    format!("  {}", line.as_ref())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_section_without_lines_is_left_out() {
        let filled = section("Files", ["  a.csv".to_owned()]);
        let text = join([filled, section("Nothing", []), vec!["end".to_owned()]]);
        assert_eq!(text, "Files\n  a.csv\n\nend");
    }
}
