//! This file says how time runs in a recording: rate, jitter, gaps.

use rigproof_trace::clock::{Grid, is_even_but_for_gaps};
use serde_json::{Value, json};

use crate::text::number::significant;

/// A step this many times the usual one is a gap.
const GAP_STEPS: f64 = 1.5;
/// Jitter below this share of a step is made by the rounding of the printed digits.
const ROUNDING: f64 = 1e-8;

/// How time runs.
pub struct Pace {
    samples: usize,
    from_s: f64,
    to_s: f64,
    /// The mean step over the record where it is even, else the median, s.
    step_s: f64,
    /// Standard deviation of the steps that are no gaps, s.
    jitter_s: f64,
    /// Where each gap begins and ends, s.
    gaps: Vec<(f64, f64)>,
}

impl Pace {
    /// Of time stamps that grow.
    pub fn of(time_s: &[f64]) -> Pace {
        let steps: Vec<(f64, f64)> = time_s
            .windows(2)
            .filter_map(|pair| match pair {
                [from, to] => Some((*from, *to)),
                _ => None,
            })
            .collect();
        let mut sorted: Vec<f64> = steps.iter().map(|(from, to)| to - from).collect();
        sorted.sort_by(f64::total_cmp);
        let median_s = sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN);
        // Steps between rounded stamps are not those between samples.
        let step_s = match is_even_but_for_gaps(time_s) {
            true => median_s,
            false => Grid::of(time_s).map_or(median_s, |grid| grid.step_s),
        };
        let is_gap = |step: f64| step > GAP_STEPS * step_s;
        let regular: Vec<f64> = sorted.into_iter().filter(|step| !is_gap(*step)).collect();
        let count = regular.len().max(1) as f64;
        let mean = regular.iter().sum::<f64>() / count;
        let variance = regular
            .iter()
            .map(|step| (step - mean) * (step - mean))
            .sum::<f64>()
            / count;
        Pace {
            samples: time_s.len(),
            from_s: time_s.first().copied().unwrap_or(f64::NAN),
            to_s: time_s.last().copied().unwrap_or(f64::NAN),
            step_s,
            jitter_s: variance.sqrt(),
            gaps: steps
                .into_iter()
                .filter(|(from, to)| is_gap(to - from))
                .collect(),
        }
    }

    pub fn lines(&self) -> Vec<String> {
        let s = |value: f64| format!("{} s", significant(value, 4));
        let longest = self
            .gaps
            .iter()
            .max_by(|a, b| (a.1 - a.0).total_cmp(&(b.1 - b.0)));
        let gaps = match longest {
            None => "none".to_owned(),
            Some((from, to)) => format!(
                "{}, the longest {} from {}",
                self.gaps.len(),
                s(to - from),
                s(*from)
            ),
        };
        let jitter = match self.jitter_s / self.step_s {
            share if share < ROUNDING => "none".to_owned(),
            share => format!(
                "{} % of a step (standard deviation)",
                significant(100.0 * share, 2)
            ),
        };
        vec![
            format!("  from    {} to {}", s(self.from_s), s(self.to_s)),
            format!(
                "  rate    {} Hz, a step of {}",
                significant(1.0 / self.step_s, 4),
                s(self.step_s)
            ),
            format!("  jitter  {jitter}"),
            format!("  gaps    {gaps}"),
        ]
    }

    pub fn json(&self) -> Value {
        let gaps = self
            .gaps
            .iter()
            .map(|(from, to)| json!({ "from_s": from, "to_s": to }));
        json!({
            "samples": self.samples, "from_s": self.from_s, "to_s": self.to_s, "step_s": self.step_s,
            "rate_hz": 1.0 / self.step_s, "jitter_s": self.jitter_s, "gaps": gaps.collect::<Vec<_>>(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gap_is_told_from_jitter() {
        let mut time_s: Vec<f64> = (0..90)
            .map(|k| 4e-3 * f64::from(k) + if k % 2 == 0 { 1e-4 } else { 0.0 })
            .collect();
        time_s.drain(31..36);
        let pace = Pace::of(&time_s);
        let steps: Vec<f64> = pace.gaps.iter().map(|(from, to)| to - from).collect();
        assert_eq!(steps.len(), 1);
        assert!((steps[0] - 24e-3).abs() < 1e-12, "{steps:?}");
        assert!((pace.jitter_s - 1e-4).abs() < 2e-6, "{}", pace.jitter_s);
        assert!((pace.step_s - 4e-3).abs() < 1.1e-4);
    }
}
