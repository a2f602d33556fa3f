//! This file says whether place, speed and force are among those that the trials of a certificate covered.

use super::Alarm;
use super::constants::{CELLS, Constants};
use crate::number::Scalar;
use crate::vector::Vector;

/// Where a sample lay.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seen {
    /// The tip, m.
    pub tip_m: [f64; 2],
    /// The square of its speed, m²/s².
    pub speed_squared: f64,
    /// The square of the force, N².
    pub force_squared: f64,
    /// The cell, below [`CELLS`].
    pub cell: u32,
}

/// How many samples in a row were outside, of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Envelope {
    seen: Seen,
    place: u32,
    speed: u32,
    force: u32,
    cell: u32,
}

impl Envelope {
    /// Where the last sample lay.
    pub fn seen(&self) -> Seen {
        self.seen
    }

    /// Looks at a sample: tip, m, its velocity, m/s, the force, N. Returns what was outside for too long.
    pub fn look(
        &mut self,
        of: &Constants,
        tip_m: Vector<f64>,
        velocity_m_s: Vector<f64>,
        force_n: Vector<f64>,
    ) -> Option<Alarm> {
        let [from_x, to_x, from_y, to_y] = of.tip_m;
        let is_there =
            (tip_m.x >= from_x) & (tip_m.x <= to_x) & (tip_m.y >= from_y) & (tip_m.y <= to_y);
        let (speed, force) = (velocity_m_s.norm_squared(), force_n.norm_squared());
        let cell = cell(of, tip_m, speed, force);
        self.seen = Seen {
            tip_m: tip_m.into(),
            speed_squared: speed,
            force_squared: force,
            cell,
        };
        let counts = [
            (&mut self.place, is_there, Alarm::Place),
            (
                &mut self.speed,
                speed.is_within(of.speed_m_s * of.speed_m_s),
                Alarm::Speed,
            ),
            (
                &mut self.force,
                force.is_within(of.force_n * of.force_n),
                Alarm::Force,
            ),
            (&mut self.cell, of.cells >> cell & 1 == 1, Alarm::Cell),
        ];
        let mut alarm = None;
        for (count, is_inside, kind) in counts {
            *count = if is_inside {
                0
            } else {
                count.saturating_add(1)
            };
            if *count >= of.hold && alarm.is_none() {
                alarm = Some(kind);
            }
        }
        alarm
    }
}

/// The number of a cell, below [`CELLS`]; of squares of speed and force.
fn cell(of: &Constants, tip_m: Vector<f64>, speed: f64, force: f64) -> u32 {
    let part = |square: f64, [first, second]: [f64; 2]| {
        u32::from(square >= first * first) + u32::from(square >= second * second)
    };
    let place = 2 * u32::from(tip_m.x >= 0.0) + u32::from(tip_m.y >= of.far_m);
    let cell = (place * 3 + part(speed, of.speeds_m_s)) * 3 + part(force, of.forces_n);
    cell.min(CELLS - 1)
}
