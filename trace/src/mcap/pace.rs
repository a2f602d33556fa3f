//! This file measures how evenly the messages of a channel come.

/// A step longer than this many usual steps is a gap.
pub const GAP_STEPS: f64 = 3.5;
/// Steps from which the usual one is taken.
const FIRST_STEPS: usize = 4096;

/// How evenly something comes, in nanoseconds of log time.
#[derive(Clone, Debug, Default)]
pub(super) struct Pace {
    first_ns: Option<u64>,
    last_ns: u64,
    steps_ns: Vec<u64>,
    /// Steps after those kept that were longer than the limit.
    late_gaps: u64,
    longest_ns: u64,
    backward: u64,
}

impl Pace {
    pub(super) fn add(&mut self, time_ns: u64) {
        if self.first_ns.is_none() {
            self.first_ns = Some(time_ns);
        } else if time_ns < self.last_ns {
            self.backward += 1;
        } else {
            let step_ns = time_ns - self.last_ns;
            self.longest_ns = self.longest_ns.max(step_ns);
            if self.steps_ns.len() < FIRST_STEPS {
                self.steps_ns.push(step_ns);
                if self.steps_ns.len() == FIRST_STEPS {
                    self.steps_ns.sort_unstable();
                }
            } else if step_ns as f64 > GAP_STEPS * self.usual_ns() {
                self.late_gaps += 1;
            }
        }
        self.last_ns = self.last_ns.max(time_ns);
    }

    pub(super) fn settle(&mut self) {
        self.steps_ns.sort_unstable();
    }

    /// The median of the sorted steps.
    pub(super) fn usual_ns(&self) -> f64 {
        let middle = self.steps_ns.get(self.steps_ns.len() / 2);
        middle.map_or(f64::NAN, |step| *step as f64)
    }

    /// The step that a share of the sorted steps does not exceed.
    pub(super) fn quantile_ns(&self, share: f64) -> f64 {
        let last = self.steps_ns.len().saturating_sub(1) as f64;
        let at = self.steps_ns.get((share * last).round() as usize);
        at.map_or(f64::NAN, |step| *step as f64)
    }

    pub(super) fn gaps(&self) -> u64 {
        let limit_ns = GAP_STEPS * self.usual_ns();
        let among = self.steps_ns.iter().filter(|step| **step as f64 > limit_ns);
        among.count() as u64 + self.late_gaps
    }

    pub(super) fn first_ns(&self) -> u64 {
        self.first_ns.unwrap_or(0)
    }

    pub(super) fn last_ns(&self) -> u64 {
        self.last_ns
    }

    pub(super) fn longest_ns(&self) -> u64 {
        self.longest_ns
    }

    pub(super) fn backward(&self) -> u64 {
        self.backward
    }
}

/// The median of finite values; NaN when there are none.
pub(super) fn median(mut values: Vec<f64>) -> f64 {
    let middle = values.len() / 2;
    if values.is_empty() {
        return f64::NAN;
    }
    let (_, median, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    *median
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pause_is_a_gap_and_a_late_message_is_none() {
        let mut pace = Pace::default();
        let mut time_ns = 7_100_003;
        for step_ns in [
            1_000_210, 999_870, 1_000_040, 3_400_000, 1_000_100, 3_600_050,
        ] {
            pace.add(time_ns);
            time_ns += step_ns;
        }
        pace.add(time_ns);
        pace.add(time_ns - 5);
        pace.settle();
        assert_eq!((pace.gaps(), pace.backward()), (1, 1));
        assert_eq!(pace.longest_ns(), 3_600_050);
        assert_eq!(pace.usual_ns(), 1_000_210.0);
    }

    #[test]
    fn gaps_after_the_first_steps_count_too() {
        let mut pace = Pace::default();
        for k in 0..6007_u64 {
            pace.add(k * 2003 + if k > 5003 { 40_017 } else { 0 });
        }
        pace.settle();
        assert_eq!(pace.gaps(), 1);
    }
}
