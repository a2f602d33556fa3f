//! This file draws states and hands for displays: where the tip starts, what it is asked to do, and how it is pushed.

use core::f64::consts::PI;

use proptest::prelude::*;
use rigproof_model::control::Side;
use rigproof_model::control::path::Line;
use rigproof_model::displays::{Aim, Display, Plant};
use rigproof_spec::methods::SAMPLE_STEP_S;

/// A start, a line near it, and a push that changes every 40 ms.
#[derive(Clone, Debug)]
pub struct Hand {
    pub tip_m: [f64; 2],
    pub line: Line,
    pub aim: u8,
    pub pushes_n: Vec<[f64; 2]>,
}

/// Any hand whose display stays inside the workspace of the 3-brake arms as a rule.
pub fn hand() -> impl Strategy<Value = Hand> {
    let tip = (-0.09..0.09_f64, 0.29..0.41_f64);
    let line = (-0.013..0.013_f64, -PI..PI);
    let push = (0.3..17.0_f64, -PI..PI);
    (tip, line, 0_u8..3, prop::collection::vec(push, 7)).prop_map(
        |((x, y), (aside, angle), aim, pushes)| {
            let polar = |r: f64, angle: f64| [r * libm::cos(angle), r * libm::sin(angle)];
            let [dx, dy] = polar(1.0, angle);
            let from = [x - aside * dy, y + aside * dx];
            Hand {
                tip_m: [x, y],
                line: Line::through(from, [from[0] + dx, from[1] + dy]).unwrap(),
                aim,
                pushes_n: pushes
                    .into_iter()
                    .map(|(r, angle)| polar(r, angle))
                    .collect(),
            }
        },
    )
}

impl Hand {
    /// What the display is to do: nothing, a wall, or the line.
    pub fn aim(&self) -> Aim<'_> {
        match self.aim {
            0 => Aim::Free,
            1 => Aim::Wall(&self.line, Side::Left),
            _ => Aim::Path(&self.line),
        }
    }

    /// Moves a display as this hand does and shows every step; a display that is driven out of its assembly stays where it is.
    pub fn moves(&self, display: &mut Display, mut seen: impl FnMut(&Plant)) {
        let aim = self.aim();
        for push in &self.pushes_n {
            for _ in 0..40 {
                if display.tick(&aim, *push, SAMPLE_STEP_S, &mut seen).is_err() {
                    return;
                }
            }
        }
    }
}
