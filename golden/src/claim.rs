//! This file says what a run must contain, so that a case cannot be vacuous.

use serde::Deserialize;

use crate::table::Table;

/// One claim about every run of a case, or about one.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// The claim in words.
    pub says: String,
    /// The run it is about; without one, each.
    pub run: Option<usize>,
    /// The column of `input.csv` or `expected.csv` it is about.
    pub column: String,
    /// What the column shows.
    pub shows: Shows,
}

/// What a column shows within one run.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shows {
    /// A value at least as great; if negative, one at least as low.
    Reaches(f64),
    /// A last value of at most this magnitude.
    EndsWithin(f64),
    /// A greatest and a least value at least this far apart.
    Spans(f64),
    /// A value that is not zero in at least so many rows.
    Lasts(usize),
    /// A sign that changes at least so often.
    SignChanges(usize),
    /// A cell that is not like the one before it, at least so often.
    Changes(usize),
    /// This word.
    Has(String),
}

impl Claim {
    /// A claim about each run.
    pub fn each(says: impl Into<String>, column: &str, shows: Shows) -> Claim {
        Claim {
            says: says.into(),
            run: None,
            column: column.to_owned(),
            shows,
        }
    }

    /// A claim about one run.
    pub fn of(run: usize, says: impl Into<String>, column: &str, shows: Shows) -> Claim {
        Claim {
            run: Some(run),
            ..Claim::each(says, column, shows)
        }
    }

    /// What is missing in the files of a case with so many runs; empty when the claim holds.
    pub fn missing(&self, runs: usize, input: &Table, expected: &Table) -> Vec<String> {
        let runs = match self.run {
            Some(run) => run..=run,
            None => 1..=runs,
        };
        let table = match expected.place(&self.column) {
            Some(_) => expected,
            None => input,
        };
        runs.filter_map(|run| {
            let found = self.unmet(run, table)?;
            Some(format!(
                "run {run} does not show that {}: {found}",
                self.says
            ))
        })
        .collect()
    }

    /// What is there instead.
    fn unmet(&self, run: usize, table: &Table) -> Option<String> {
        let column = &self.column;
        let words = match table.words(run, column) {
            Ok(words) => words,
            Err(error) => return Some(error.to_string()),
        };
        match &self.shows {
            Shows::Has(word) => {
                let has = words.contains(&word.as_str());
                return (!has).then(|| format!("the column `{column}` has no `{word}`"));
            }
            Shows::Changes(least) => {
                let changes = pairs(&words).filter(|(a, b)| a != b).count();
                let said = || format!("the column `{column}` changes {changes} times");
                return (changes < *least).then(said);
            }
            _ => {}
        }
        match table.numbers(run, column) {
            Ok(numbers) => self.shows.unmet(column, &numbers),
            Err(error) => Some(error.to_string()),
        }
    }
}

impl Shows {
    fn unmet(&self, column: &str, numbers: &[f64]) -> Option<String> {
        let Some(last) = numbers.last() else {
            return Some(format!("the column `{column}` is empty"));
        };
        if let Some(odd) = numbers.iter().find(|value| !value.is_finite()) {
            return Some(format!("the column `{column}` holds {odd}"));
        }
        let greatest = numbers.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let least = numbers.iter().copied().fold(f64::INFINITY, f64::min);
        let (holds, found) = match self {
            Shows::Reaches(value) if *value < 0.0 => {
                (least <= *value, format!("goes down to {least:?}"))
            }
            Shows::Reaches(value) => (greatest >= *value, format!("goes up to {greatest:?}")),
            Shows::EndsWithin(value) => (last.abs() <= *value, format!("ends at {last:?}")),
            Shows::Spans(value) => {
                let span = greatest - least;
                (span >= *value, format!("spans {span:?}"))
            }
            Shows::Lasts(least) => {
                let rows = numbers.iter().filter(|value| **value != 0.0).count();
                (rows >= *least, format!("is not zero in {rows} rows"))
            }
            Shows::SignChanges(least) => {
                let changes = pairs(numbers).filter(|(a, b)| **a * **b < 0.0).count();
                (changes >= *least, format!("changes sign {changes} times"))
            }
            Shows::Changes(_) | Shows::Has(_) => (true, String::new()),
        };
        (!holds).then(|| format!("the column `{column}` {found}"))
    }
}

fn pairs<T>(values: &[T]) -> impl Iterator<Item = (&T, &T)> {
    values.iter().zip(values.iter().skip(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One run: torque, whether the brake holds, and a reason.
    fn table(rows: &[(f64, u8, &str)]) -> Table {
        let columns = [("run", ""), ("torque", "N·m"), ("held", ""), ("reason", "")];
        let mut table = Table::new(&columns);
        for (torque_nm, held, reason) in rows {
            table.push(1, &[*torque_nm]);
            table.extend([held.to_string(), (*reason).to_owned()]);
        }
        table
    }

    fn claims() -> [Claim; 8] {
        [
            Claim::each("it reaches", "torque", Shows::Reaches(3.7)),
            Claim::each("it falls", "torque", Shows::Reaches(-1.9)),
            Claim::of(1, "it ends", "torque", Shows::EndsWithin(0.3)),
            Claim::each("it spans", "torque", Shows::Spans(5.5)),
            Claim::each("it lasts", "held", Shows::Lasts(2)),
            Claim::each("it turns", "torque", Shows::SignChanges(2)),
            Claim::each("it switches", "reason", Shows::Changes(2)),
            Claim::each("it locks", "reason", Shows::Has("locked".to_owned())),
        ]
    }

    #[test]
    fn a_lively_run_meets_every_claim() {
        let run = table(&[
            (3.8, 1, "chosen_a"),
            (-1.93, 1, "locked"),
            (0.21, 0, "chosen_a"),
        ]);
        for claim in claims() {
            assert!(claim.missing(1, &Table::default(), &run).is_empty());
        }
    }

    #[test]
    fn a_vacuous_run_meets_none() {
        let nothing = table(&[]);
        let flat = table(&[(1.3, 0, "chosen_a"); 3]);
        let unknown = table(&[(f64::NAN, 0, "chosen_a"); 3]);
        for run in [nothing, flat, unknown] {
            for claim in claims() {
                let missing = claim.missing(1, &Table::default(), &run);
                assert_eq!(missing.len(), 1, "{claim:?}");
            }
        }
    }

    #[test]
    fn a_claim_about_a_run_or_a_column_that_is_not_there_fails() {
        let run = table(&[(3.8, 1, "chosen_a"), (-1.93, 1, "locked")]);
        let claim = Claim::of(2, "it locks", "reason", Shows::Has("locked".to_owned()));
        assert_eq!(claim.missing(2, &Table::default(), &run).len(), 1);
        let claim = Claim::each("it moves", "speed", Shows::Spans(0.1));
        let missing = claim.missing(1, &Table::default(), &run);
        assert!(missing[0].contains("no column `speed`"), "{missing:?}");
    }
}
