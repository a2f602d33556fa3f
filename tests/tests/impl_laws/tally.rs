//! This file counts what became of the rig's answers beside the reference's.

use std::collections::BTreeMap;

use rigproof_certify::differential::both::{View, reference_command};
use rigproof_certify::differential::nudger::Nudger;
use rigproof_certify::differential::permitted::{Permitted, permitted};
use rigproof_certify::differential::tick::Tick;
use rigproof_certify::differential::tie::Ties;
use rigproof_spec::command::Command;

/// What became of many answers.
#[derive(Default)]
pub struct Answers {
    /// Ticks with settings that both refuse.
    pub refused: u64,
    pub same: u64,
    pub rounding_a: Vec<f64>,
    /// The greatest of them, A, and where.
    furthest: (f64, String),
    pub ties: Ties,
    pub reasons: BTreeMap<String, u64>,
    pub wrong: Vec<String>,
}

impl Answers {
    /// Holds the rig's answer to the reference's; what is wrong is told with its place.
    pub fn add(&mut self, tick: &Tick, rig: Command, nudger: &mut Nudger, place: &str) {
        *self.reasons.entry(format!("{:?}", rig.reason)).or_default() += 1;
        match permitted(tick, reference_command(tick, View::EXACT), rig, nudger) {
            Ok(Permitted::Same) => self.same += 1,
            Ok(Permitted::Rounding(current_a)) => {
                self.rounding_a.push(current_a);
                if current_a > self.furthest.0 {
                    self.furthest = (current_a, place.to_owned());
                }
            }
            Ok(Permitted::Tie(tie)) => self.ties.add(tie),
            Err(wrong) => self.wrong.push(format!("{place}: {wrong}")),
        }
    }

    pub fn join(&mut self, other: Answers) {
        self.refused += other.refused;
        self.same += other.same;
        self.rounding_a.extend(other.rounding_a);
        if other.furthest.0 > self.furthest.0 {
            self.furthest = other.furthest;
        }
        self.ties.join(&other.ties);
        for (reason, count) in other.reasons {
            *self.reasons.entry(reason).or_default() += count;
        }
        self.wrong.extend(other.wrong);
    }

    /// The counts in a line.
    pub fn counts(&self) -> String {
        format!(
            "{} refused by both, {} the same, {} within rounding ({:e} A at {}), ties {:?}, reasons {:?}",
            self.refused,
            self.same,
            self.rounding_a.len(),
            self.furthest.0,
            self.furthest.1,
            self.ties.met().collect::<Vec<_>>(),
            self.reasons
        )
    }

    pub fn assert_none_wrong(&self) {
        let shown: Vec<_> = self.wrong.iter().take(5).cloned().collect();
        let count = self.wrong.len();
        assert!(count == 0, "{count} wrong: {}", shown.join("\n"));
    }
}

/// The quantiles that a budget has, printed.
pub fn quantiles(values: &[f64]) -> String {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let [q75, q99, max] = [0.75, 0.99, 1.0].map(|rank| {
        let place = sorted.len().saturating_sub(1) as f64 * rank;
        sorted.get(place as usize).copied().unwrap_or(f64::NAN)
    });
    format!("q75 {q75:e}, q99 {q99:e}, max {max:e}")
}
