//! This file holds a hand's force for a while, so that it can be written down and repeated.

use rigproof_model::control::path::Line;
use rigproof_model::operator::{Hand, Operator};
use rigproof_spec::methods::SAMPLE_STEP_S;

use super::ROWS_TICKS;

/// An operator whose force is drawn once in a while and held.
pub struct Held {
    operator: Operator<Line>,
    tick: usize,
    /// The forces drawn so far, x and y, N.
    pub forces_n: Vec<[f64; 2]>,
}

impl Held {
    /// A hand that has not pushed yet.
    pub const fn new(operator: Operator<Line>) -> Held {
        Held {
            operator,
            tick: 0,
            forces_n: Vec::new(),
        }
    }
}

impl Hand for Held {
    fn push(&mut self, tip_m: [f64; 2], tip_velocity_m_s: [f64; 2], _: f64) -> [f64; 2] {
        if self.tick.is_multiple_of(ROWS_TICKS) {
            let held_s = ROWS_TICKS as f64 * SAMPLE_STEP_S;
            let force_n = self.operator.push(tip_m, tip_velocity_m_s, held_s);
            self.forces_n.push(force_n);
        }
        self.tick += 1;
        self.forces_n.last().copied().unwrap_or_default()
    }
}

/// Forces that were written down.
pub struct Replayed {
    forces_n: Vec<[f64; 2]>,
    tick: usize,
}

impl Replayed {
    /// A hand that pushes with one force after the other.
    pub const fn new(forces_n: Vec<[f64; 2]>) -> Replayed {
        Replayed { forces_n, tick: 0 }
    }
}

impl Hand for Replayed {
    fn push(&mut self, _: [f64; 2], _: [f64; 2], _: f64) -> [f64; 2] {
        let place = self.tick / ROWS_TICKS;
        self.tick += 1;
        self.forces_n.get(place).copied().unwrap_or_default()
    }
}
