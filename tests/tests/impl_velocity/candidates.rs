//! This file holds the estimators of velocity from counts that were compared (decision 0073), counts in, counts a sample out.

use std::collections::VecDeque;

/// One of them with its parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Candidate {
    /// The last two counts.
    Difference,
    /// The last count and the one so many samples before.
    Window(usize),
    /// The difference through a low-pass that keeps this share of its last answer.
    LowPass(f64),
    /// A critically damped fading-memory tracker of position and velocity that keeps this share of the past.
    FadingMemory(f64),
    /// First-order adaptive windowing: the longest window, of at most so many samples, whose line passes every count within this
    /// many counts (Janabi-Sharifi, Hayward and Chen, IEEE Trans. Control Systems Technology 8, 2000, end-fit).
    AdaptiveWindow(usize, f64),
}

/// A candidate at work on one joint.
pub struct Estimator {
    candidate: Candidate,
    past: VecDeque<i64>,
    position: f64,
    velocity: f64,
}

impl Estimator {
    pub fn new(candidate: Candidate) -> Estimator {
        Estimator {
            candidate,
            past: VecDeque::new(),
            position: f64::NAN,
            velocity: 0.0,
        }
    }

    pub fn update(&mut self, count: i64) -> f64 {
        if self.past.is_empty() {
            self.past = VecDeque::from(vec![count; 65]);
            self.position = count as f64;
        }
        self.past.push_front(count);
        self.past.pop_back();
        let rate = |window: usize| (count - self.past[window]) as f64 / window as f64;
        self.velocity = match self.candidate {
            Candidate::Difference => rate(1),
            Candidate::Window(window) => rate(window),
            Candidate::LowPass(kept) => kept * self.velocity + (1.0 - kept) * rate(1),
            Candidate::FadingMemory(kept) => {
                let predicted = self.position + self.velocity;
                let surprise = count as f64 - predicted;
                self.position = predicted + (1.0 - kept * kept) * surprise;
                self.velocity + (1.0 - kept) * (1.0 - kept) * surprise
            }
            Candidate::AdaptiveWindow(longest, margin) => {
                let fits = |window: &usize| {
                    let slope = rate(*window);
                    (1..*window).all(|i| {
                        let line = count as f64 - slope * i as f64;
                        (self.past[i] as f64 - line).abs() <= margin + 1e-9
                    })
                };
                rate((2..=longest).take_while(fits).last().unwrap_or(1))
            }
        };
        self.velocity
    }
}
