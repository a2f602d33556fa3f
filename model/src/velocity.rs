//! This file says how a joint's velocity is formed from the counts of its encoder, where §5.3.2 is lost.

use crate::encoder::Encoder;

/// Longest window, samples (decision 0073).
pub const LONGEST_WINDOW: usize = 8;

/// First-order adaptive windowing (Janabi-Sharifi, Hayward and Chen, IEEE Trans. Control Systems Technology 8, 2000, "end-fit"): the
/// slope of the line through the newest count and the one `window` samples before, over the longest window of which every line of
/// it and of the shorter ones passes each count between within one count.
///
/// Two ends that are each rounded by half a count leave a line within half a count of the truth, and a count between lies within
/// half a count of it too: a line that misses by more than one count is no line.
///
/// # Differs from the thesis
///
/// The page is lost (gap `missing-page`).
#[derive(Clone, Debug, PartialEq)]
pub struct AdaptiveWindow {
    encoder: Encoder,
    sample_s: f64,
    /// The newest first.
    counts: Vec<i64>,
}

impl AdaptiveWindow {
    /// The estimator of a joint that stands at a count, sampled every `sample_s`, s.
    pub fn new(encoder: Encoder, sample_s: f64, count: i64) -> AdaptiveWindow {
        AdaptiveWindow {
            encoder,
            sample_s,
            counts: vec![count; LONGEST_WINDOW + 1],
        }
    }

    /// The joint's rate at its next count, rad/s.
    pub fn update(&mut self, count: i64) -> f64 {
        self.counts.insert(0, count);
        self.counts.truncate(LONGEST_WINDOW + 1);
        let window = (2..=LONGEST_WINDOW)
            .take_while(|window| self.is_straight(*window))
            .last()
            .unwrap_or(1);
        let counts = self.moved(window) as f64 / window as f64;
        counts * self.encoder.one_count_speed_rad_s(self.sample_s)
    }

    /// Counts from so many samples ago to now.
    fn moved(&self, samples: usize) -> i64 {
        match (self.counts.first(), self.counts.get(samples)) {
            (Some(newest), Some(oldest)) => newest - oldest,
            _ => 0,
        }
    }

    /// Whether the line over a window passes each count between its ends within one count: |moved(i) − i·moved(w)/w| ≤ 1, times w.
    fn is_straight(&self, window: usize) -> bool {
        let whole = window as i64;
        (1..window).all(|i| (whole * self.moved(i) - i as i64 * self.moved(window)).abs() <= whole)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_of_counts_is_told_over_the_window_that_looks_straight() {
        // k²/4 counts, rounded down: 0 0 1 2 4 6 9 12 16 20 25; back from 25 the line of three samples, (25 − 12)/3, still passes
        // 20 and 16 within one count; that of five, (25 − 6)/5, misses 20 by 1.2.
        let mut velocity = AdaptiveWindow::new(Encoder::default(), 0.001, 0);
        let mut rate = 0.0;
        for k in 1..=10_i64 {
            rate = velocity.update(k * k / 4);
        }
        let one = Encoder::default().one_count_speed_rad_s(0.001);
        assert!((rate / one - 4.0).abs() < 1e-12, "{}", rate / one);
    }
}
