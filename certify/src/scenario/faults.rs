//! This file says how sensors fail, and draws it.

use rigproof_impl::vector::Vector;
use serde::{Deserialize, Serialize};

use super::Draw;

/// What goes wrong with the samples for a while.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fault {
    /// The first sample that is wrong.
    pub from_tick: u32,
    /// How many are.
    pub ticks: u32,
    /// How.
    pub kind: FaultKind,
}

/// A way to be wrong.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FaultKind {
    /// So many samples in between never came.
    Missed(u32),
    /// The sample before is told again.
    Stale,
    /// The counts of A and B are off by so many.
    Jumped([i32; 2]),
    /// The force is no number, in x, in y or in both.
    NoNumber([bool; 2]),
    /// The force is infinite: the sign in x and in y, 0 where it is as it is.
    Infinite([i8; 2]),
    /// The force is beyond what the sensor can give: N in x and in y, 0 where it is as it is.
    Beyond([f64; 2]),
}

impl FaultKind {
    /// One of each kind.
    pub const EXAMPLES: [FaultKind; 6] = [
        FaultKind::Missed(3),
        FaultKind::Stale,
        FaultKind::Jumped([2003, 0]),
        FaultKind::NoNumber([true, false]),
        FaultKind::Infinite([0, -1]),
        FaultKind::Beyond([-1e7, 0.0]),
    ];

    /// The force that is told instead of a true one, N.
    pub fn force_n(self, force_n: Vector<f64>) -> Vector<f64> {
        let told = match self {
            FaultKind::NoNumber(at) => at.map(|at| at.then_some(f64::NAN)),
            FaultKind::Infinite(signs) => {
                signs.map(|sign| (sign != 0).then_some(f64::from(sign) * f64::INFINITY))
            }
            FaultKind::Beyond(values_n) => values_n.map(|n| (n != 0.0).then_some(n)),
            _ => [None; 2],
        };
        let [x, y] = told;
        Vector::new(x.unwrap_or(force_n.x), y.unwrap_or(force_n.y))
    }
}

/// Samples at the start that are whole, and at least between two faults.
const WHOLE: u32 = 60;

/// Signs of x and y of which one may be 0.
fn components(draw: &mut Draw) -> [f64; 2] {
    let (x, y) = (draw.sign(), draw.sign());
    match draw.below(3) {
        0 => [x, 0.0],
        1 => [0.0, y],
        _ => [x, y],
    }
}

/// The faults of a trial: none in every third, up to four otherwise.
pub fn drawn(draw: &mut Draw, ticks: u32) -> Vec<Fault> {
    let count = if draw.one_in(3) { 0 } else { 1 + draw.below(4) };
    let mut faults = Vec::new();
    let mut after = WHOLE;
    for _ in 0..count {
        let span = ticks.saturating_sub(after) / 2;
        if span == 0 {
            break;
        }
        let from_tick = after + draw.below(span);
        let jump = |draw: &mut Draw| draw.sign() as i32 * draw.whole(1_000, 30_000);
        let (kind, ticks) = match draw.below(6) {
            0 => (FaultKind::Missed(1 + draw.below(5)), 1),
            1 => (FaultKind::Stale, 1 + draw.below(8)),
            2 => {
                let (a, b) = (jump(draw), jump(draw));
                let counts = match draw.below(3) {
                    0 => [a, 0],
                    1 => [0, b],
                    _ => [a, b],
                };
                (FaultKind::Jumped(counts), 1 + draw.below(40))
            }
            3 => {
                let at = components(draw).map(|sign| sign != 0.0);
                (FaultKind::NoNumber(at), 1 + draw.below(40))
            }
            4 => {
                let [x, y] = components(draw);
                (FaultKind::Infinite([x as i8, y as i8]), 1 + draw.below(10))
            }
            _ => {
                let size_n = draw.between(300.0, 1e6);
                let signs = components(draw);
                (
                    FaultKind::Beyond(signs.map(|sign| sign * size_n)),
                    1 + draw.below(10),
                )
            }
        };
        faults.push(Fault {
            from_tick,
            ticks,
            kind,
        });
        after = from_tick + ticks + WHOLE;
    }
    faults
}
