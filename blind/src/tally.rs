//! This file adds up many judgements: outcomes by stratum, calibration of the probabilities, Brier score and coverage.

use crate::judge::{DETECTABLE_RATIO, Judgement, Outcome};
use crate::plant::Plant;
use crate::stratum::Stratum;
use crate::table::Share;
use serde::Serialize;
use std::fmt;

/// Judgements of one protocol.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    judged: Vec<(Plant, u64, Judgement)>,
}

/// One line: a stratum with its outcomes.
#[derive(Clone, Debug, Serialize)]
pub struct Outcomes {
    /// The stratum's name, or `all`.
    pub stratum: &'static str,
    /// Cases.
    pub n: usize,
    /// How many of each outcome, in the order of [`Outcome::ALL`].
    pub counts: Vec<Share>,
}

/// Names that were given with a probability in a range.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Bin {
    /// The least probability; the next bin's is the end.
    pub from: f64,
    /// Names.
    pub n: usize,
    /// Their mean probability.
    pub said: f64,
    /// How many of them are right.
    pub right: Share,
}

/// Where the bins of the calibration begin.
const BINS: [f64; 5] = [0.0, 0.5, 0.7, 0.9, 0.97];

impl Tally {
    /// Adds the judgement of one case.
    pub fn add(&mut self, plant: Plant, seed: u64, judgement: Judgement) {
        self.judged.push((plant, seed, judgement));
    }

    /// Whether there is anything to add up.
    pub fn is_empty(&self) -> bool {
        self.judged.is_empty()
    }

    /// One row a stratum that occurs, then `all`.
    pub fn rows(&self) -> Vec<Outcomes> {
        let of = |stratum: Option<Stratum>| -> Vec<&Judgement> {
            let each = self.judged.iter().map(|(_, _, judgement)| judgement);
            each.filter(|judged| stratum.is_none_or(|own| own == judged.stratum))
                .collect()
        };
        let row = |name, judged: Vec<&Judgement>| {
            let n = judged.len();
            let count = |outcome| {
                judged
                    .iter()
                    .filter(|judged| judged.outcome == outcome)
                    .count()
            };
            (n > 0).then(|| Outcomes {
                stratum: name,
                n,
                counts: Outcome::ALL
                    .map(|outcome| Share::new(count(outcome), n))
                    .to_vec(),
            })
        };
        let each = Stratum::ALL
            .into_iter()
            .map(|stratum| (stratum.name(), of(Some(stratum))));
        each.chain([("all", of(None))])
            .filter_map(|(name, judged)| row(name, judged))
            .collect()
    }

    fn names(&self) -> Vec<(f64, bool)> {
        let each = self.judged.iter().flat_map(|(_, _, judged)| &judged.names);
        each.map(|(_, probability, right)| (*probability, *right))
            .collect()
    }

    /// How often a name is right, by the probability it was given with.
    pub fn calibration(&self) -> Vec<Bin> {
        let ends = BINS.into_iter().skip(1).chain([f64::INFINITY]);
        let bin = |(from, end): (f64, f64)| {
            let names = self
                .names()
                .into_iter()
                .filter(|(p, _)| (from..end).contains(p));
            let names: Vec<(f64, bool)> = names.collect();
            let n = names.len();
            (n > 0).then(|| Bin {
                from,
                n,
                said: names.iter().map(|(p, _)| p).sum::<f64>() / n as f64,
                right: Share::new(names.iter().filter(|(_, right)| *right).count(), n),
            })
        };
        BINS.into_iter().zip(ends).filter_map(bin).collect()
    }

    /// Mean squared distance of a name's probability from 1 where it is right and 0 where it is false (Brier 1950), and the same if every
    /// name were given with the share of right ones; `None` without names.
    pub fn brier(&self) -> Option<[f64; 2]> {
        let names = self.names();
        let n = names.len() as f64;
        let truth = |right: bool| f64::from(u8::from(right));
        let base = names.iter().map(|(_, right)| truth(*right)).sum::<f64>() / n;
        let mean = |of: &dyn Fn(f64) -> f64| {
            let each = names.iter().map(|(p, right)| of(*p) - truth(*right));
            each.map(|x| x * x).sum::<f64>() / n
        };
        (n > 0.0).then(|| [mean(&|p| p), mean(&|_| base)])
    }

    /// 95 % intervals that hold the true number.
    pub fn coverage(&self) -> Option<(Share, usize)> {
        let all = self
            .judged
            .iter()
            .flat_map(|(_, _, judged)| &judged.parameters);
        let known: Vec<bool> = all.filter_map(|parameter| parameter.covered).collect();
        let count = known.iter().filter(|covered| **covered).count();
        (!known.is_empty()).then(|| (Share::new(count, known.len()), known.len()))
    }

    /// The protocol in one paragraph.
    pub fn protocol(&self) -> String {
        let plants = Plant::ALL.into_iter().filter_map(|plant| {
            let seeds = self
                .judged
                .iter()
                .filter(|(own, _, _)| *own == plant)
                .map(|(_, seed, _)| seed);
            let (low, high) = (seeds.clone().min()?, seeds.clone().max()?);
            Some(format!(
                "{}: {} cases, seeds {low} to {high}",
                plant.name(),
                seeds.count()
            ))
        });
        let plants: Vec<String> = plants.collect();
        format!(
            "Other forms. Cases: {}. An effect is detectable if alone it leaves at least {DETECTABLE_RATIO} times the residual that the noise of \
             the sensors explains, by the plant's own knowledge. Right: every detectable effect has one of its right names at its place, \
             and no name is false. A name is false if it is neither right nor an acceptable companion. Unseen: nothing named, nothing detectable. \
             Brackets: Wilson 95 % intervals.",
            plants.join("; ")
        )
    }

    /// The table and its protocol as JSON.
    pub fn to_json(&self) -> serde_json::Value {
        let coverage = self
            .coverage()
            .map(|(share, of)| serde_json::json!({ "of": of, "covered": share }));
        serde_json::json!({
            "protocol": self.protocol(),
            "outcomes": Outcome::ALL.map(Outcome::words),
            "rows": self.rows(),
            "calibration": self.calibration(),
            "brier": self.brier().map(|[brier, base]| serde_json::json!({ "brier": brier, "base_rate": base })),
            "coverage": coverage,
        })
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:<15}{:>5}  ", "stratum", "n")?;
        for outcome in Outcome::ALL {
            write!(f, "{:<17}", outcome.words())?;
        }
        writeln!(f)?;
        for row in self.rows() {
            write!(f, "{:<15}{:>5}  ", row.stratum, row.n)?;
            for count in row.counts {
                write!(f, "{count:<17}")?;
            }
            writeln!(f)?;
        }
        for bin in self.calibration() {
            writeln!(
                f,
                "probability from {:.2} ({:.2} on average): {} of {} names are right",
                bin.from, bin.said, bin.right, bin.n
            )?;
        }
        if let Some([brier, base]) = self.brier() {
            writeln!(
                f,
                "Brier score {brier:.3}; with the share of right names for all {base:.3}"
            )?;
        }
        if let Some((share, of)) = self.coverage() {
            writeln!(
                f,
                "95 % intervals that hold the true number: {share} of {of}"
            )?;
        }
        writeln!(f, "\n{}", self.protocol())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn judged(outcome: Outcome, names: &[(f64, bool)]) -> Judgement {
        Judgement {
            stratum: Stratum::Single,
            outcome,
            hidden: Vec::new(),
            names: names
                .iter()
                .map(|(p, right)| ("x".to_owned(), *p, *right))
                .collect(),
            parameters: Vec::new(),
        }
    }

    #[test]
    fn outcomes_and_probabilities_add_up() {
        let mut tally = Tally::default();
        assert!(tally.brier().is_none() && tally.is_empty());
        tally.add(Plant::Axis, 4, judged(Outcome::Right, &[(0.8, true)]));
        tally.add(
            Plant::Axis,
            9,
            judged(Outcome::FalseName, &[(0.6, false), (1.0, true)]),
        );
        let rows = tally.rows();
        assert_eq!((rows.len(), rows[0].n, rows[0].counts[0].count), (2, 2, 1));
        assert_eq!(rows[1].counts[2].count, 1);
        // (0.04 + 0.36 + 0)/3 and 2/3·1/3 by hand.
        let [brier, base] = tally.brier().unwrap();
        assert!((brier - 0.4 / 3.0).abs() < 1e-12 && (base - 2.0 / 9.0).abs() < 1e-12);
        let bins = tally.calibration();
        assert_eq!(bins.len(), 3);
        assert_eq!((bins[0].from, bins[0].right.count), (0.5, 0));
        let text = tally.to_string();
        assert!(
            text.contains("seeds 4 to 9") && text.contains("Brier score 0.133"),
            "{text}"
        );
    }
}
