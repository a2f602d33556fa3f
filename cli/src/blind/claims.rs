//! This file is what the program claims of its diagnosis, and whether a trial bears it out.

use rigproof_blind::{ONSET_S, Share, Stratum};
use serde_json::{Value, json};

use super::trial::Tried;

/// A share that is promised.
pub struct Claim {
    words: &'static str,
    /// How many of a case are what is claimed, and of how many the claim is: of one, where the claim is about the case itself.
    counts: fn(&Tried) -> (usize, usize),
    bound: Bound,
}

enum Bound {
    AtMost(f64),
    AtLeast(f64),
    Between(f64, f64),
}

/// What is claimed of an axis and a bench.
pub const OF_A_JOINT: [Claim; 4] = [
    Claim {
        words: "a false name where nothing is hidden",
        counts: false_name,
        bound: Bound::AtMost(0.02),
    },
    Claim {
        words: "exactly the one effect that is hidden",
        counts: |tried| tried.of(&[Stratum::Single], tried.score.exact),
        bound: Bound::AtLeast(0.90),
    },
    Claim {
        words: "physics outside the library flagged and not named",
        counts: flagged_and_not_named,
        bound: Bound::AtLeast(0.95),
    },
    Claim {
        words: "the truth named or offered (single, masked, late_onset)",
        counts: |tried| {
            let strata = [Stratum::Single, Stratum::Masked, Stratum::LateOnset];
            tried.of(&strata, tried.score.inside)
        },
        bound: Bound::AtLeast(0.97),
    },
];

/// The strata in which effects are hidden that can be named.
const NAMEABLE: [Stratum; 7] = [
    Stratum::Single,
    Stratum::Masked,
    Stratum::LateOnset,
    Stratum::Noisy,
    Stratum::InLoop,
    Stratum::Unidentifiable,
    Stratum::WrongInertia,
];

/// What is claimed of the five-bar.
pub const OF_THE_RIG: [Claim; 14] = [
    Claim {
        words: "a false name where nothing is hidden",
        counts: false_name,
        bound: Bound::AtMost(0.01),
    },
    Claim {
        words: "mechanism and joint of the one effect that is hidden (single)",
        counts: |tried| tried.of(&[Stratum::Single], tried.score.exact),
        bound: Bound::AtLeast(0.95),
    },
    Claim {
        words: "its mechanism, wherever it is said to be",
        counts: |tried| tried.of(&[Stratum::Single], tried.score.mechanism_exact),
        bound: Bound::AtLeast(0.97),
    },
    Claim {
        words: "both of two effects that mask each other, and nothing else",
        counts: |tried| tried.of(&[Stratum::Masked], tried.score.exact),
        bound: Bound::AtLeast(0.85),
    },
    Claim {
        words: "the truth named or offered, wherever there is one in the library",
        counts: |tried| tried.of(&NAMEABLE, tried.score.inside),
        bound: Bound::AtLeast(0.98),
    },
    Claim {
        words: "there at most two mechanisms named or offered",
        counts: |tried| tried.of(&NAMEABLE, tried.score.offered <= 2),
        bound: Bound::AtLeast(0.5),
    },
    Claim {
        words: "physics outside the library flagged and not named",
        counts: flagged_and_not_named,
        bound: Bound::AtLeast(0.97),
    },
    Claim {
        words: "a fault of the data said to be one",
        counts: |tried| tried.of(&[Stratum::DataFault], tried.score.exact),
        bound: Bound::AtLeast(0.97),
    },
    Claim {
        words: "a named onset within 0.3 s",
        counts: |tried| onset_near(tried.score.onset_error_s),
        bound: Bound::AtLeast(0.95),
    },
    Claim {
        words: "the same, where the recording tells it to that",
        counts: |tried| {
            let told = tried.score.onset_told == Some(true);
            onset_near(tried.score.onset_error_s.filter(|_| told))
        },
        bound: Bound::AtLeast(0.95),
    },
    Claim {
        words: "95 % intervals that hold the true onset",
        counts: |tried| {
            let covered = tried.score.onset_covered;
            covered.map_or((0, 0), |covered| (usize::from(covered), 1))
        },
        bound: Bound::AtLeast(0.9),
    },
    Claim {
        words: "95 % intervals that hold the true number",
        counts: |tried| {
            let known = tried.score.parameters.iter().filter_map(|p| p.covered);
            (
                known.clone().filter(|covered| *covered).count(),
                known.count(),
            )
        },
        bound: Bound::Between(0.90, 0.99),
    },
    Claim {
        words: "ambiguity gone, and the truth named, after the experiment that was asked for",
        counts: |tried| {
            let then = tried.then.as_ref();
            then.map_or((0, 0), |then| (usize::from(then.is_told()), 1))
        },
        bound: Bound::AtLeast(0.9),
    },
    Claim {
        words: "0.95 of the achievable improvement of the held-out part",
        counts: |tried| {
            let share = tried.score.recovered_share;
            share.map_or((0, 0), |share| (usize::from(share >= 0.95), 1))
        },
        bound: Bound::AtLeast(0.5),
    },
];

fn false_name(tried: &Tried) -> (usize, usize) {
    tried.of(&[Stratum::Nothing], !tried.score.false_names.is_empty())
}

fn onset_near(error_s: Option<f64>) -> (usize, usize) {
    error_s.map_or((0, 0), |error_s| (usize::from(error_s <= ONSET_S), 1))
}

/// Cogging with two periods is in the library since it holds several: it is right if it is named.
fn flagged_and_not_named(tried: &Tried) -> (usize, usize) {
    let refused = tried.score.flagged && tried.named().is_empty();
    tried.of(&[Stratum::NotInLibrary], refused || tried.score.exact)
}

impl Tried {
    /// One of one if it is so, in these strata; none of none elsewhere.
    fn of(&self, strata: &[Stratum], is_so: bool) -> (usize, usize) {
        match strata.contains(&self.answer.stratum) {
            true => (usize::from(is_so), 1),
            false => (0, 0),
        }
    }
}

/// A claim against the cases of a trial.
pub struct Measured<'a> {
    claim: &'a Claim,
    of: usize,
    share: Share,
}

impl Claim {
    /// Measures the claim.
    pub fn measure(&self, tried: &[Tried]) -> Measured<'_> {
        let each = tried.iter().map(self.counts);
        let (count, of) = each.fold((0, 0), |sum, case| (sum.0 + case.0, sum.1 + case.1));
        Measured {
            claim: self,
            of,
            share: Share::new(count, of),
        }
    }
}

impl Measured<'_> {
    /// Whether the claim holds; `None` when no case is about it.
    pub fn holds(&self) -> Option<bool> {
        let share = self.share.count as f64 / self.of as f64;
        (self.of > 0).then_some(match self.claim.bound {
            Bound::AtMost(bound) => share <= bound,
            Bound::AtLeast(bound) => share >= bound,
            Bound::Between(least, most) => (least..=most).contains(&share),
        })
    }

    /// The claim, its figure and whether it holds, in one line.
    pub fn line(&self) -> String {
        let percent = |share: f64| format!("{:.0} %", 100.0 * share);
        let bound = match self.claim.bound {
            Bound::AtMost(bound) => format!("at most {}", percent(bound)),
            Bound::AtLeast(bound) => format!("at least {}", percent(bound)),
            Bound::Between(least, most) => format!("{:.0} to {}", 100.0 * least, percent(most)),
        };
        let figure = match self.holds() {
            None => "no case".to_owned(),
            Some(holds) => format!(
                "{} of {} [{:.0}–{:.0} %], {}",
                self.share.count,
                self.of,
                100.0 * self.share.low95,
                100.0 * self.share.high95,
                if holds { "holds" } else { "does not hold" }
            ),
        };
        format!("  {} in {bound}: {figure}", self.claim.words)
    }

    /// The same as JSON.
    pub fn json(&self) -> Value {
        let (at_most, at_least) = match self.claim.bound {
            Bound::AtMost(bound) => (Some(bound), None),
            Bound::AtLeast(bound) => (None, Some(bound)),
            Bound::Between(least, most) => (Some(most), Some(least)),
        };
        json!({
            "claim": self.claim.words, "at_most": at_most, "at_least": at_least,
            "cases": self.of, "measured": self.share, "holds": self.holds(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_blind::{Answer, ParameterError, Plant, Score};

    fn tried(stratum: Stratum, false_name: bool) -> Tried {
        Tried {
            answer: Answer {
                seed: 7,
                plant: Plant::Bench,
                stratum,
                effects: Vec::new(),
                fault: None,
                spoilt: None,
                block_noise: 0.3,
                residual_ratio: None,
                forms: Default::default(),
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
                open: 0,
                onset_error_s: None,
                onset_told: None,
                onset_covered: None,
                parameters: Vec::new(),
                recovered_share: None,
            },
            judgement: None,
            then: None,
        }
    }

    #[test]
    fn a_claim_breaks_just_beyond_its_bound() {
        let [false_name, ..] = OF_A_JOINT;
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
        let [false_name, .., offered] = OF_A_JOINT;
        assert_eq!(false_name.measure(&cases).holds(), None);
        assert_eq!(offered.measure(&cases).holds(), Some(false));
    }

    #[test]
    fn intervals_are_counted_one_by_one_and_may_not_be_too_wide() {
        let [.., covered, _, _] = OF_THE_RIG;
        let parameter = |covered| ParameterError {
            mechanism: "viscous".to_owned(),
            name: "coefficient".to_owned(),
            relative: 0.1,
            covered,
        };
        let with = |hits: usize| {
            let mut case = tried(Stratum::Single, false);
            case.score.parameters = (0..100).map(|k| parameter(Some(k < hits))).collect();
            case.score.parameters.push(parameter(None));
            covered.measure(&[case]).holds()
        };
        assert_eq!(with(89), Some(false));
        assert_eq!(with(95), Some(true));
        assert_eq!(with(100), Some(false));
    }
}
