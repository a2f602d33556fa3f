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
    /// The force is no number.
    NoNumber,
    /// The force is infinite.
    Infinite,
    /// The force is beyond what the sensor can give: N.
    Beyond(f64),
}

impl FaultKind {
    /// One of each kind.
    pub const EXAMPLES: [FaultKind; 6] = [
        FaultKind::Missed(3),
        FaultKind::Stale,
        FaultKind::Jumped([2003, 0]),
        FaultKind::NoNumber,
        FaultKind::Infinite,
        FaultKind::Beyond(1e7),
    ];

    /// The force that is told instead of a true one, N.
    pub fn force_n(self, force_n: Vector<f64>) -> Vector<f64> {
        match self {
            FaultKind::NoNumber => Vector::new(f64::NAN, force_n.y),
            FaultKind::Infinite => Vector::new(force_n.x, f64::NEG_INFINITY),
            FaultKind::Beyond(magnitude_n) => Vector::new(-magnitude_n, force_n.y),
            _ => force_n,
        }
    }
}

/// Samples at the start that are whole, and at least between two faults.
const WHOLE: u32 = 60;

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
                let counts = if draw.one_in(2) {
                    [jump(draw), 0]
                } else {
                    [0, jump(draw)]
                };
                (FaultKind::Jumped(counts), 1 + draw.below(40))
            }
            3 => (FaultKind::NoNumber, 1 + draw.below(40)),
            4 => (FaultKind::Infinite, 1 + draw.below(10)),
            _ => (
                FaultKind::Beyond(draw.between(300.0, 1e6)),
                1 + draw.below(10),
            ),
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
