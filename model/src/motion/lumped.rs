//! This file says which of three or four stuck brakes let go, by the thesis's lumped-actuator rule (§5.3.5).
#![expect(clippy::indexing_slicing, reason = "indices run over the four joints")]

use super::stick::{Joints, karnopp};

/// The torques that the stuck brakes A, E, B, C bore at the last time step, N·m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Memory {
    applied_nm: [f64; 4],
}

impl Memory {
    /// Remembers torques.
    pub fn of(applied_nm: [f64; 4]) -> Memory {
        Memory { applied_nm }
    }
}

/// The torques of three or four stuck brakes, of which the equations determine only two at a time.
///
/// All but two of the brakes are set to breakaway, in every choice of the two that are left, and these are asked for what
/// holds the linkage (5.68). If in any choice both are within their yield, all stay stuck and bear the mean of such choices. If all torques asked for exceed their yield, all slip. Otherwise all but one slip, those whose mean torque
/// at the last time step was closest to breakaway, and the last is asked again alone.
///
/// # Differs from the thesis
///
/// The print leaves the sign of a breakaway torque open, which torques the averages are, and how many of four slip (gap
/// `lumped-rule`).
pub fn lumped(
    joints: &Joints,
    stuck: &[usize],
    yields_nm: [f64; 4],
    memory: &mut Memory,
    torques_nm: &mut [f64; 4],
) {
    let breakaway_nm = [0, 1, 2, 3].map(|i| {
        let last = memory.applied_nm[i];
        let against = if last == 0.0 { -joints.free[i] } else { last };
        against.signum() * yields_nm[i]
    });
    let mut asked = [Mean::default(); 4];
    let mut borne = [Mean::default(); 4];
    let mut all_exceed = true;
    for (place, &i) in stuck.iter().enumerate() {
        for &j in &stuck[place + 1..] {
            let mut set = *torques_nm;
            for &k in stuck {
                set[k] = breakaway_nm[k];
            }
            let applied = joints.applied_on_two(set, [i, j]);
            if applied.iter().any(|torque| torque.is_nan()) {
                continue;
            }
            (set[i], set[j]) = (applied[0], applied[1]);
            let within = [i, j].map(|k| set[k].abs() <= yields_nm[k]);
            all_exceed &= within == [false, false];
            for k in [i, j] {
                asked[k].add(set[k]);
            }
            if within == [true, true] {
                for &k in stuck {
                    borne[k].add(set[k]);
                }
            }
        }
    }
    let last_nm = memory.applied_nm;
    *memory = Memory::of(asked.map(|mean| mean.value()));
    if stuck.iter().any(|&i| borne[i].count > 0.0) {
        for &i in stuck {
            torques_nm[i] = borne[i].value();
        }
        return;
    }
    for &i in stuck {
        torques_nm[i] = breakaway_nm[i];
    }
    if !all_exceed {
        let distance = |i: &usize| (last_nm[*i].abs() - yields_nm[*i]).abs();
        let last = stuck
            .iter()
            .copied()
            .max_by(|i, j| distance(i).total_cmp(&distance(j)));
        if let Some(last) = last {
            let applied_nm = joints.applied_on_one(*torques_nm, last);
            torques_nm[last] = karnopp(0.0, 1.0, applied_nm, yields_nm[last]);
        }
    }
}

/// A mean of torques as they come.
#[derive(Clone, Copy, Default)]
struct Mean {
    sum: f64,
    count: f64,
}

impl Mean {
    fn add(&mut self, value: f64) {
        self.sum += value;
        self.count += 1.0;
    }

    fn value(self) -> f64 {
        if self.count > 0.0 {
            self.sum / self.count
        } else {
            0.0
        }
    }
}
