//! This file reads what a laboratory asks for: sentences of its own, and how often the premise of every law has to be met.

use rigproof_trace::TraceError;
use rigproof_trace::rig::table::Table;

use super::{ranged, unknown};
use crate::law::Law;
use crate::metrics::Metric;
use crate::requirement::Asked;
use crate::search::Target;

/// In how many trials the premise of every law has to be met: the table `coverage`.
pub(super) fn least_met(root: &Table<'_>) -> Result<Option<u64>, TraceError> {
    let Some(table) = root.table("coverage")? else {
        return Ok(None);
    };
    table.only(&["least_trials"])?;
    let least = ranged(&table, "least_trials", [0.0, 1e8])?;
    if least.fract() != 0.0 {
        let problem = format!("`least_trials` is {least}; give a whole number from 0 to 100000000");
        return Err(table.error_at("least_trials", problem));
    }
    Ok(Some(least as u64))
}

/// The tables `requirement`: a sentence each, and the law or the metric that stands for it.
pub(super) fn requirements(root: &Table<'_>) -> Result<Vec<Asked>, TraceError> {
    let mut all = Vec::new();
    for table in root.tables("requirement")? {
        table.only(&["says", "law", "metric"])?;
        let says = table.need("says", table.text("says")?)?.to_owned();
        let by = match (table.text("law")?, table.text("metric")?) {
            (Some(name), None) => {
                let found = Law::ALL.into_iter().find(|law| law.name() == name);
                let names = Law::ALL.map(Law::name);
                Target::Law(found.ok_or_else(|| unknown(&table, "law", name, &names))?)
            }
            (None, Some(key)) => {
                let found = Metric::ALL.into_iter().find(|metric| metric.key() == key);
                let keys = Metric::ALL.map(Metric::key);
                Target::Metric(found.ok_or_else(|| unknown(&table, "metric", key, &keys))?)
            }
            _ => {
                return Err(
                    table.error("say what stands for it: give `law` or `metric`, and not both")
                );
            }
        };
        all.push(Asked { says, by });
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::super::Description;
    use super::*;

    fn parse(text: &str) -> Result<Description, String> {
        Description::parse(text, Path::new("certify.toml")).map_err(|error| error.to_string())
    }

    #[test]
    fn what_a_laboratory_asks_for_is_read() {
        let read = parse(
            "[coverage]\nleast_trials = 7\n[[requirement]]\nsays = \"no push back\"\nlaw = \"passivity\"\n\
             [[requirement]]\nsays = \"light\"\nmetric = \"tip_force_n\"\n",
        )
        .unwrap();
        assert_eq!(read.least_met, Some(7));
        let by: Vec<Target> = read.requirements.iter().map(|asked| asked.by).collect();
        assert_eq!(
            by,
            [
                Target::Law(Law::Passivity),
                Target::Metric(Metric::TipForce)
            ]
        );
        assert_eq!(parse("").unwrap().least_met, None);
    }

    #[test]
    fn what_stands_for_nothing_is_refused() {
        for (text, words) in [
            ("[[requirement]]\nsays = \"x\"\n", "give `law` or `metric`"),
            (
                "[[requirement]]\nsays = \"x\"\nlaw = \"gap\"\nmetric = \"finish_s\"\n",
                "and not both",
            ),
            ("[[requirement]]\nlaw = \"gap\"\n", "`says` is missing"),
            (
                "[[requirement]]\nsays = \"x\"\nlaw = \"gaps\"\n",
                "did you mean `gap`",
            ),
            ("[coverage]\nleast_trials = 1.5\n", "whole number"),
        ] {
            let message = parse(text).unwrap_err();
            assert!(message.contains(words), "{message}");
        }
    }
}
