//! This file adds up many scores by stratum and prints them with their uncertainty and the protocol.

use crate::make::FINE_STEPS;
use crate::plant::Plant;
use crate::score::{Score, mechanism_of};
use crate::size::{BLOCK_S, CLEAR_DISTINCTNESS, CLEAR_SIZE, FAINT_STRENGTH};
use crate::stratum::Stratum;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;

/// Scores of one protocol.
#[derive(Clone, Debug, Default)]
pub struct Table {
    scores: Vec<(Plant, u64, Score)>,
}

/// A count with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Share {
    /// How many.
    pub count: usize,
    /// Wilson's lower limit of the share (Wilson 1927).
    pub low95: f64,
    /// Wilson's upper limit of the share.
    pub high95: f64,
}

/// One line of the table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The stratum's name, or `all`.
    pub stratum: &'static str,
    /// Cases.
    pub n: usize,
    /// The named set is the true set.
    pub exact: Share,
    /// The mechanisms are the true ones, at these joints or others.
    pub mechanism_exact: Share,
    /// The truth is named, ambiguous with a name or replaced by an equivalent.
    pub inside: Share,
    /// At least one false name.
    pub any_false_name: Share,
    /// The verdict refuses to name.
    pub flagged: Share,
    /// Mean number of mechanisms named or offered.
    pub mean_offered: f64,
    /// Median number of mechanisms named or offered.
    pub median_offered: f64,
    /// Median distance of the onset, s, where it is comparable.
    pub median_onset_error_s: Option<f64>,
    /// Median relative error of the comparable parameters.
    pub median_parameter_error: Option<f64>,
    /// Comparable parameters whose 95 % interval holds the truth.
    pub covered: Option<Share>,
    /// Median share of the achievable improvement on the held-out part, where one was held out.
    pub median_recovered_share: Option<f64>,
}

impl Table {
    /// Adds the score of one case.
    pub fn add(&mut self, plant: Plant, seed: u64, score: Score) {
        self.scores.push((plant, seed, score));
    }

    /// One row a stratum that occurs, then `all`.
    pub fn rows(&self) -> Vec<Row> {
        let of = |stratum: Stratum| -> Vec<&Score> {
            self.scores
                .iter()
                .map(|(_, _, score)| score)
                .filter(|score| score.stratum == stratum)
                .collect()
        };
        let all: Vec<&Score> = self.scores.iter().map(|(_, _, score)| score).collect();
        Stratum::ALL
            .into_iter()
            .map(|stratum| (stratum.name(), of(stratum)))
            .chain([("all", all)])
            .filter(|(_, scores)| !scores.is_empty())
            .map(|(name, scores)| Row::new(name, &scores))
            .collect()
    }

    /// What was named where at most one effect was hidden: for each hidden mechanism, how often which name was given. Several names
    /// are one entry, and so are a true mechanism at a wrong joint and a refusal.
    pub fn confusion(&self) -> BTreeMap<String, BTreeMap<String, usize>> {
        let mut matrix: BTreeMap<String, BTreeMap<String, usize>> = BTreeMap::new();
        for (_, _, score) in &self.scores {
            let hidden = match score.hidden.as_slice() {
                [] if score.stratum == Stratum::DataFault => "data fault".to_owned(),
                [] => "nothing".to_owned(),
                [only] => mechanism_of(only),
                _ => continue,
            };
            let named = match score.named.as_slice() {
                [] if score.flagged => score.verdict.replace('_', " "),
                [] => "nothing".to_owned(),
                [only] if score.hidden.contains(only) => mechanism_of(only),
                [only] if mechanism_of(only) == hidden => format!("{hidden} at another joint"),
                [only] => mechanism_of(only),
                _ => "several".to_owned(),
            };
            *matrix.entry(hidden).or_default().entry(named).or_default() += 1;
        }
        matrix
    }

    /// The confusion matrix, a line a hidden mechanism, without its zeros.
    pub fn confusion_lines(&self) -> Vec<String> {
        let line = |(hidden, named): (String, BTreeMap<String, usize>)| {
            let total: usize = named.values().sum();
            let mut named: Vec<(String, usize)> = named.into_iter().collect();
            named.sort_by_key(|(name, count)| (std::cmp::Reverse(*count), name.clone()));
            let named: Vec<String> = named
                .into_iter()
                .map(|(name, count)| format!("{name} {count}"))
                .collect();
            format!("  {hidden} ({total}): {}", named.join(", "))
        };
        self.confusion().into_iter().map(line).collect()
    }

    /// The protocol in one paragraph.
    pub fn protocol(&self) -> String {
        let plants: Vec<String> = Plant::ALL
            .into_iter()
            .filter_map(|plant| {
                let seeds = self
                    .scores
                    .iter()
                    .filter(|(p, _, _)| *p == plant)
                    .map(|(_, seed, _)| *seed);
                let (low, high) = (seeds.clone().min()?, seeds.clone().max()?);
                Some(format!(
                    "{}: {} cases, seeds {low} to {high}",
                    plant.name(),
                    seeds.count()
                ))
            })
            .collect();
        format!(
            "Cases: {}. Fine step: 1/{FINE_STEPS} of the sample. Size of an effect: root mean square of its force \
             that the nominal model cannot imitate, in 80 ms averages ({BLOCK_S} s), over the standard deviation of the \
             equivalent noise of such an average. Clearly detectable: size at least {CLEAR_SIZE}, and at least \
             {CLEAR_DISTINCTNESS} after dry friction, damping, bias and a spring have imitated it. Too small: size times \
             the root of the number of averages at most {FAINT_STRENGTH}. Brackets: Wilson 95 % intervals.",
            plants.join("; ")
        )
    }

    /// The table and its protocol as JSON.
    pub fn to_json(&self) -> serde_json::Value {
        serde_json::json!({
            "protocol": self.protocol(),
            "rows": self.rows(),
            "confusion": self.confusion(),
        })
    }
}

impl Row {
    fn new(stratum: &'static str, scores: &[&Score]) -> Row {
        let n = scores.len();
        let share = |test: fn(&Score) -> bool| {
            Share::new(scores.iter().filter(|score| test(score)).count(), n)
        };
        let covered: Vec<bool> = scores
            .iter()
            .flat_map(|score| score.parameters.iter().filter_map(|p| p.covered))
            .collect();
        Row {
            stratum,
            n,
            exact: share(|score| score.exact),
            mechanism_exact: share(|score| score.mechanism_exact),
            inside: share(|score| score.inside),
            any_false_name: share(|score| !score.false_names.is_empty()),
            flagged: share(|score| score.flagged),
            mean_offered: scores.iter().map(|s| s.offered as f64).sum::<f64>() / n as f64,
            median_offered: median(scores.iter().map(|s| s.offered as f64)).unwrap_or_default(),
            median_recovered_share: median(scores.iter().filter_map(|s| s.recovered_share)),
            median_onset_error_s: median(scores.iter().filter_map(|s| s.onset_error_s)),
            median_parameter_error: median(
                scores
                    .iter()
                    .flat_map(|s| s.parameters.iter().map(|p| p.relative)),
            ),
            covered: (!covered.is_empty())
                .then(|| Share::new(covered.iter().filter(|c| **c).count(), covered.len())),
        }
    }
}

impl Share {
    /// The share of `count` in `n`, at least one, with Wilson's 95 % interval.
    pub fn new(count: usize, n: usize) -> Share {
        const Z: f64 = 1.959_963_984_540_054;
        let n = n.max(1) as f64;
        let p = count as f64 / n;
        let spread = Z * (p * (1.0 - p) / n + Z * Z / (4.0 * n * n)).sqrt();
        let (centre, scale) = (p + Z * Z / (2.0 * n), 1.0 + Z * Z / n);
        Share {
            count,
            low95: ((centre - spread) / scale).max(0.0),
            high95: ((centre + spread) / scale).min(1.0),
        }
    }
}

impl fmt::Display for Share {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = format!(
            "{} [{:.0}–{:.0} %]",
            self.count,
            100.0 * self.low95,
            100.0 * self.high95
        );
        f.pad(&text)
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{:<15}{:>5}  {:<17}{:<17}{:<17}{:<17}{:<17}{:>7}{:>11}{:>12}",
            "stratum",
            "n",
            "exact",
            "mechanism",
            "inside",
            "any false name",
            "flagged",
            "offered",
            "onset (s)",
            "parameter"
        )?;
        for row in self.rows() {
            writeln!(
                f,
                "{:<15}{:>5}  {:<17}{:<17}{:<17}{:<17}{:<17}{:>7.1}{:>11}{:>12}",
                row.stratum,
                row.n,
                row.exact,
                row.mechanism_exact,
                row.inside,
                row.any_false_name,
                row.flagged,
                row.mean_offered,
                row.median_onset_error_s
                    .map_or_else(|| "–".to_owned(), |x| format!("{x:.3}")),
                row.median_parameter_error
                    .map_or_else(|| "–".to_owned(), |x| format!("{:.1} %", 100.0 * x)),
            )?;
        }
        writeln!(f, "\n{}", self.protocol())
    }
}

fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    let upper = values.get(values.len() / 2)?;
    let lower = values.get((values.len() - 1) / 2)?;
    Some(0.5 * (lower + upper))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wilson_agrees_with_the_printed_example() {
        // 8 of 10: 0.490 to 0.943 (Newcombe 1998, method 3, to three digits).
        let share = Share::new(8, 10);
        assert!((share.low95 - 0.490).abs() < 5e-4 && (share.high95 - 0.943).abs() < 5e-4);
        assert_eq!(Share::new(0, 20).low95, 0.0);
        assert_eq!(Share::new(20, 20).high95, 1.0);
    }

    #[test]
    fn rows_add_up_and_print() {
        let score = |exact: bool, name: &[&str]| Score {
            stratum: Stratum::Single,
            verdict: "explained".to_owned(),
            exact,
            mechanism_exact: exact,
            hidden: vec!["viscous at E".to_owned()],
            named: name
                .iter()
                .chain(exact.then_some(&"viscous at E"))
                .map(|n| (*n).to_owned())
                .collect(),
            inside: true,
            false_names: name.iter().map(|n| (*n).to_owned()).collect(),
            flagged: false,
            offered: 1 + name.len(),
            open: 0,
            onset_error_s: None,
            onset_told: None,
            onset_covered: None,
            parameters: Vec::new(),
            recovered_share: Some(if exact { 0.9 } else { 0.1 }),
        };
        let mut table = Table::default();
        table.add(Plant::Axis, 7, score(true, &[]));
        table.add(Plant::Axis, 9, score(false, &["viscous at B"]));
        let rows = table.rows();
        assert_eq!(rows.len(), 2);
        assert_eq!((rows[0].n, rows[0].exact.count), (2, 1));
        assert_eq!(rows[1].any_false_name.count, 1);
        assert_eq!(rows[1].mean_offered, 1.5);
        assert_eq!(rows[1].median_offered, 1.5);
        assert_eq!(rows[1].median_recovered_share, Some(0.5));
        let text = table.to_string();
        assert!(text.contains("axis: 2 cases, seeds 7 to 9"), "{text}");
        assert_eq!(
            table.confusion_lines(),
            ["  viscous (2): viscous 1, viscous at another joint 1"]
        );
        assert_eq!(table.to_json()["rows"][0]["exact"]["count"], 1);
    }
}
