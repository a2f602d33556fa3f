//! This file is what the program claims of its diagnosis, and whether a trial bears it out.

use rigproof_blind::{Share, Stratum};
use serde_json::{Value, json};

use super::trial::Tried;

/// A share of cases that is promised.
pub struct Claim {
    words: &'static str,
    /// Which cases it is about.
    about: fn(&Tried) -> bool,
    /// What is counted in them.
    counts: fn(&Tried) -> bool,
    bound: Bound,
}

enum Bound {
    AtMost(f64),
    AtLeast(f64),
}

/// Everything that is claimed.
pub const CLAIMS: [Claim; 4] = [
    Claim {
        words: "a false name where nothing is hidden",
        about: |tried| tried.answer.stratum == Stratum::Nothing,
        counts: |tried| !tried.score.false_names.is_empty(),
        bound: Bound::AtMost(0.02),
    },
    Claim {
        words: "exactly the one effect that is hidden",
        about: |tried| tried.answer.stratum == Stratum::Single,
        counts: |tried| tried.score.exact,
        bound: Bound::AtLeast(0.90),
    },
    Claim {
        words: "physics outside the library flagged and not named",
        about: |tried| tried.answer.stratum == Stratum::NotInLibrary,
        counts: |tried| tried.score.flagged && tried.named().is_empty(),
        bound: Bound::AtLeast(0.95),
    },
    Claim {
        words: "the truth named or offered (single, masked, late_onset)",
        about: |tried| {
            [Stratum::Single, Stratum::Masked, Stratum::LateOnset].contains(&tried.answer.stratum)
        },
        counts: |tried| tried.score.inside,
        bound: Bound::AtLeast(0.97),
    },
];

/// A claim against the cases of a trial.
pub struct Measured<'a> {
    claim: &'a Claim,
    cases: usize,
    share: Share,
}

impl Claim {
    /// Measures the claim.
    pub fn measure(&self, tried: &[Tried]) -> Measured<'_> {
        let about = || tried.iter().filter(|tried| (self.about)(tried));
        let cases = about().count();
        Measured {
            claim: self,
            cases,
            share: Share::new(about().filter(|tried| (self.counts)(tried)).count(), cases),
        }
    }
}

impl Measured<'_> {
    /// Whether the claim holds; `None` when no case is about it.
    pub fn holds(&self) -> Option<bool> {
        let share = self.share.count as f64 / self.cases as f64;
        (self.cases > 0).then_some(match self.claim.bound {
            Bound::AtMost(bound) => share <= bound,
            Bound::AtLeast(bound) => share >= bound,
        })
    }

    /// The claim, its figure and whether it holds, in one line.
    pub fn line(&self) -> String {
        let (word, bound) = match self.claim.bound {
            Bound::AtMost(bound) => ("at most", bound),
            Bound::AtLeast(bound) => ("at least", bound),
        };
        let figure = match self.holds() {
            None => "no case".to_owned(),
            Some(holds) => format!(
                "{} of {} [{:.0}–{:.0} %], {}",
                self.share.count,
                self.cases,
                100.0 * self.share.low95,
                100.0 * self.share.high95,
                if holds { "holds" } else { "does not hold" }
            ),
        };
        format!(
            "  {} in {word} {:.0} %: {figure}",
            self.claim.words,
            100.0 * bound
        )
    }

    /// The same as JSON.
    pub fn json(&self) -> Value {
        let (at_most, at_least) = match self.claim.bound {
            Bound::AtMost(bound) => (Some(bound), None),
            Bound::AtLeast(bound) => (None, Some(bound)),
        };
        json!({
            "claim": self.claim.words, "at_most": at_most, "at_least": at_least,
            "cases": self.cases, "measured": self.share, "holds": self.holds(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_blind::{Answer, Plant, Score};

    fn tried(stratum: Stratum, false_name: bool) -> Tried {
        Tried {
            answer: Answer {
                seed: 7,
                plant: Plant::Bench,
                stratum,
                effects: Vec::new(),
                fault: None,
                block_noise: 0.3,
            },
            report: json!({ "effects": [] }),
            score: Score {
                stratum,
                verdict: "consistent".to_owned(),
                exact: false,
                mechanism_exact: false,
                hidden: Vec::new(),
                named: Vec::new(),
                inside: false,
                false_names: false_name.then(|| "lag".to_owned()).into_iter().collect(),
                flagged: false,
                offered: 0,
                onset_error_s: None,
                parameters: Vec::new(),
            },
        }
    }

    #[test]
    fn a_claim_breaks_just_beyond_its_bound() {
        let [false_name, ..] = CLAIMS;
        let mut cases: Vec<Tried> = (0..49).map(|_| tried(Stratum::Nothing, false)).collect();
        cases.push(tried(Stratum::Nothing, true));
        assert_eq!(false_name.measure(&cases).holds(), Some(true));
        cases.pop();
        cases.pop();
        cases.push(tried(Stratum::Nothing, true));
        let measured = false_name.measure(&cases);
        assert_eq!(measured.holds(), Some(false));
        assert!(
            measured.line().ends_with("does not hold"),
            "{}",
            measured.line()
        );
    }

    #[test]
    fn a_claim_without_a_case_is_neither_kept_nor_broken() {
        let cases = [tried(Stratum::Masked, true)];
        let [false_name, .., offered] = CLAIMS;
        assert_eq!(false_name.measure(&cases).holds(), None);
        assert_eq!(offered.measure(&cases).holds(), Some(false));
    }
}
