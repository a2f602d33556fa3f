//! This file makes the page of a trial.

use rigproof_blind::{Row, Share, Table};
use rigproof_report::trial::{self, Kind, Trial, page};

use super::claims::Measured;
use super::trial::Tried;

/// The page as HTML; `plants` says which seeds are on which plant.
pub fn html(table: &Table, plants: &str, claims: &[Measured<'_>], tried: &[Tried]) -> String {
    let rows = table.rows();
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
    let claim = |claim: &Measured<'_>| {
        let line = claim.line();
        let (what, measured) = line.trim().split_once(": ").unwrap_or((&line, ""));
        // Whether it holds has a column of its own.
        let measured = measured.split_once(", ").map_or(measured, |(own, _)| own);
        ([plain(what), plain(measured)], claim.holds())
    };
    let cells = |tried: &Tried| tried.cells().iter().map(|cell| plain(cell)).collect();
    page(&Trial {
        cases: tried.len(),
        exact: tried.iter().filter(|tried| tried.score.exact).count(),
        protocol: format!("{} {plants}", table.protocol()),
        strata: (head, rows.iter().map(stratum).collect()),
        kinds: rows.iter().map(kind).collect(),
        claims: claims.iter().map(claim).collect(),
        confusion: table.confusion(),
        seeds: tried.iter().map(cells).collect(),
    })
}

/// A name without what programs write between words.
fn plain(name: &str) -> String {
    name.replace('_', " ")
}

fn stratum(row: &Row) -> Vec<String> {
    let share = |share: &Share| {
        let (low, high) = (100.0 * share.low95, 100.0 * share.high95);
        format!("{} [{low:.0}–{high:.0} %]", share.count)
    };
    let shares = [
        &row.exact,
        &row.mechanism_exact,
        &row.inside,
        &row.any_false_name,
        &row.flagged,
    ];
    let mut cells = vec![plain(row.stratum), row.n.to_string()];
    cells.extend(shares.map(share));
    cells.push(format!("{:.1}", row.mean_offered));
    cells
}

fn kind(row: &Row) -> Kind {
    let share = |share: &Share| trial::Share {
        count: share.count,
        interval: [share.low95, share.high95],
    };
    Kind {
        name: plain(row.stratum),
        cases: row.n,
        exact: share(&row.exact),
        inside: share(&row.inside),
        false_name: share(&row.any_false_name),
    }
}
