//! This file is an aligned recording: regular samples, smoothed motion, known efforts, noise levels.

use crate::doubt::{greatest_change, jumps_late, turning};
use rigproof_model::brake::Brake;
use rigproof_model::effects::Instant;
use rigproof_spec::tables::BrakeTable;

/// Which plant's equations a recording obeys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlantKind {
    /// Driven joint: the residual is `gain·u − inertia·q̈ − resistance`.
    Axis,
    /// Imposed motion: the residual is the metered effort less the resistance.
    Bench,
}

/// An aligned recording in SI units, one value a sample in every vector.
#[derive(Clone, Debug)]
pub struct JointRun {
    /// The plant.
    pub plant: PlantKind,
    /// Sample interval, s.
    pub step_s: f64,
    /// Time of the first sample, s.
    pub start_s: f64,
    /// Whether the drive holds its value between samples, so that it acts half a sample late on average.
    pub held: bool,
    /// Recorded position, m or rad.
    pub position: Vec<f64>,
    /// Smoothed motion: what the laws are evaluated on.
    pub motion: Vec<Instant>,
    /// Axis: `gain·u`. Bench: the metered effort. N or N·m.
    pub effort: Vec<f64>,
    /// Bench: the effort that the nominal model already predicts (a brake, or somebody's simulation).
    pub predicted: Option<Vec<f64>>,
    /// Bench: the current, A.
    pub current: Option<Vec<f64>>,
    /// Bench: the brake whose torque is predicted.
    pub table: Option<BrakeTable>,
    /// Standard deviation of one position sample, m or rad.
    pub position_noise: f64,
    /// Standard deviation of one effort sample, N or N·m.
    pub effort_noise: f64,
    /// Samples that were recorded, not filled in.
    pub recorded: Vec<bool>,
    /// Speed below which the sense of motion cannot be told, m/s or rad/s.
    pub speed_floor: f64,
    /// By how much the speed may be mistaken, m/s or rad/s.
    pub untold_speed: Vec<f64>,
}

impl JointRun {
    /// The number of samples.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// What a bench with a brake and its current has: the predicted torque, N·m, and the current, A.
    pub fn brake(&self) -> Option<(&[f64], &[f64])> {
        Some((self.predicted.as_deref()?, self.current.as_deref()?))
    }

    /// The torque of the thesis's brake along the recorded motion under a current, A; `None` on a plant without one. N·m.
    pub fn braked(&self, current: &[f64]) -> Option<Vec<f64>> {
        self.braked_along(&self.motion, current)
    }

    /// By how much the brake's torque may be mistaken, N·m: because nothing is known of the time between two samples (when the shaft turns
    /// back, when a backlash begins and ends and, where the current is not held, when it jumps), and because its time constant jumps at speeds that noise may cross.
    pub fn brake_doubt(&self) -> Option<Vec<f64>> {
        let current = self.current.as_deref()?;
        let own = self.braked(current)?;
        let late = self.motion.iter().take(1).chain(&self.motion);
        let mut motions: Vec<Vec<Instant>> = vec![late.copied().take(self.len()).collect()];
        motions.extend([1.0, -1.0].map(|sign| turning(&self.motion, &self.untold_speed, sign)));
        let along = |motion: &Vec<Instant>| self.braked_along(motion, current);
        let mut others: Vec<Vec<f64>> = motions.iter().filter_map(along).collect();
        if !self.held {
            others.extend(self.braked(&jumps_late(current)));
        }
        Some(greatest_change(&own, &others))
    }

    fn braked_along(&self, motion: &[Instant], current: &[f64]) -> Option<Vec<f64>> {
        let mut brake = Brake::of(self.table?, motion.first()?.position);
        let mut yields = vec![brake.yield_torque()];
        let currents = current.iter().zip(current.iter().skip(1));
        for ((before, current), now) in currents.zip(motion.iter().skip(1)) {
            let acting = match self.held {
                true => *before,
                false => 0.5 * (before + current),
            };
            brake.step(acting, now.position, now.speed, self.step_s);
            yields.push(brake.yield_torque());
        }
        // Where the sense cannot be told the torque is spread over it, as for the dry laws.
        let torques = motion.iter().zip(yields);
        Some(torques.map(|(now, torque)| torque * now.sense).collect())
    }

    /// Whether there are no samples.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// The length of the recording, s.
    pub fn duration_s(&self) -> f64 {
        self.step_s * self.len().saturating_sub(1) as f64
    }

    /// The samples `from..to`, times kept.
    pub fn slice(&self, from: usize, to: usize) -> JointRun {
        let part = |values: &Vec<f64>| values.get(from..to).unwrap_or_default().to_vec();
        JointRun {
            plant: self.plant,
            step_s: self.step_s,
            start_s: self.start_s + from as f64 * self.step_s,
            held: self.held,
            position: part(&self.position),
            motion: self.motion.get(from..to).unwrap_or_default().to_vec(),
            effort: part(&self.effort),
            predicted: self.predicted.as_ref().map(part),
            current: self.current.as_ref().map(part),
            table: self.table,
            position_noise: self.position_noise,
            effort_noise: self.effort_noise,
            recorded: self.recorded.get(from..to).unwrap_or_default().to_vec(),
            speed_floor: self.speed_floor,
            untold_speed: part(&self.untold_speed),
        }
    }

    /// The first sample at or after a time, s.
    pub fn sample_at(&self, time_s: f64) -> usize {
        ((time_s - self.start_s) / self.step_s).ceil().max(0.0) as usize
    }

    /// The range of positions, m or rad.
    pub fn travel(&self) -> f64 {
        let low = self.position.iter().copied().fold(f64::INFINITY, f64::min);
        let high = self
            .position
            .iter()
            .copied()
            .fold(f64::NEG_INFINITY, f64::max);
        (high - low).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use crate::plants::joint::recorded::{NOMINAL, STEP_S, exact_axis};

    #[test]
    fn a_slice_keeps_its_times() {
        let run = exact_axis(NOMINAL, 500, true);
        let part = run.slice(113, 401);
        assert_eq!(part.len(), 288);
        assert_eq!(part.motion[0].time_s, run.motion[113].time_s);
        assert!((part.start_s - 113.0 * STEP_S).abs() < 1e-12);
        assert_eq!(part.sample_at(run.motion[117].time_s - 0.3 * STEP_S), 4);
        assert_eq!(part.effort, run.effort[113..401]);
    }
}
