//! This file makes the page of a trial.

use rigproof_blind::{Share, Table};
use rigproof_report::trial::{Trial, page};

use super::claims::Measured;
use super::trial::Tried;

/// The page as HTML; `plants` says which seeds are on which plant.
pub fn html(table: &Table, plants: &str, claims: &[Measured<'_>], tried: &[Tried]) -> String {
    let rows = table.rows();
    let share = |share: &Share| {
        let (low, high) = (100.0 * share.low95, 100.0 * share.high95);
        format!("{} [{low:.0}–{high:.0} %]", share.count)
    };
    let strata = rows.iter().map(|row| {
        let shares = [
            &row.exact,
            &row.mechanism_exact,
            &row.inside,
            &row.any_false_name,
            &row.flagged,
        ];
        let mut cells = vec![row.stratum.replace('_', " "), row.n.to_string()];
        cells.extend(shares.map(share));
        cells.push(format!("{:.1}", row.mean_offered));
        cells
    });
    let head = vec![
        "kind",
        "recordings",
        "exact",
        "mechanism",
        "truth named or offered",
        "any false name",
        "flagged",
        "offered",
    ];
    let halves = |line: &str| {
        let line = line.trim();
        let (one, other) = line.split_once(": ").unwrap_or((line, ""));
        [one.to_owned(), other.to_owned()]
    };
    let confusion = table.confusion_lines();
    page(&Trial {
        cases: tried.len(),
        exact: tried.iter().filter(|tried| tried.score.exact).count(),
        protocol: format!("{} {plants}", table.protocol()),
        strata: (head, strata.collect()),
        claims: claims
            .iter()
            .map(|claim| (halves(&claim.line()), claim.holds()))
            .collect(),
        confusion: confusion.iter().map(|line| halves(line)).collect(),
        seeds: tried.iter().map(Tried::cells).collect(),
    })
}
