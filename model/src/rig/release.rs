//! This file runs the experiments of appendix B: the tip is held, a spring of constant force pulls at it, and it is let go.

use rigproof_spec::geometry::{Angle, AngleRanges, angle_ranges};
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::tables::GREATEST_CURRENT_A;
use rigproof_spec::units::RAD_PER_DEG;

use super::Rig;
use crate::error::ModelError;

/// One experiment: which brake is locked and how the tip is pulled (§5.4).
///
/// # Differs from the thesis
///
/// Force, cylinder, handle positions and duration are in figures that are lost (gap `release-setup`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Release {
    /// The layout.
    pub layout: Layout,
    /// The brake that gets full current; none in free motion, where every brake has its off-state torque.
    pub locked: Option<Joint>,
    /// Where the tip is let go, m.
    pub start_m: [f64; 2],
    /// The cylinder that the spring winds on, m.
    pub cylinder_m: [f64; 2],
    /// Its radius, m: the run ends where the tip reaches it.
    pub radius_m: f64,
    /// The force of the spring towards the cylinder, N.
    pub force_n: f64,
    /// Longest duration, s.
    pub duration_s: f64,
    /// Time between samples, s.
    pub sample_s: f64,
}

/// What is recorded at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Time since the release, s.
    pub time_s: f64,
    /// The tip, m.
    pub tip_m: [f64; 2],
    /// The angles of A, E, B, C, rad.
    pub joint_angles_rad: [f64; 4],
    /// Their rates, rad/s.
    pub joint_rates_rad_s: [f64; 4],
    /// What the brakes exert on them, N·m.
    pub torques_nm: [f64; 4],
    /// Which of them their brake holds.
    pub stuck: [bool; 4],
}

/// The nine figures of appendix B: number, layout and locked brake. B.1, B.2, B.5 and B.6 are figures 5.7 and 5.8 again.
pub const FIGURES: [(&str, Layout, Option<Joint>); 9] = [
    ("B.1", Layout::ThreeBrake, None),
    ("B.2", Layout::ThreeBrake, Some(Joint::A)),
    ("B.3", Layout::ThreeBrake, Some(Joint::E)),
    ("B.4", Layout::ThreeBrake, Some(Joint::B)),
    ("B.5", Layout::FourBrake, None),
    ("B.6", Layout::FourBrake, Some(Joint::A)),
    ("B.7", Layout::FourBrake, Some(Joint::E)),
    ("B.8", Layout::FourBrake, Some(Joint::B)),
    ("B.9", Layout::FourBrake, Some(Joint::C)),
];

impl Release {
    /// The experiment of a figure, with what is lost chosen: 9 N from the left towards the right of the workspace.
    pub fn of(layout: Layout, locked: Option<Joint>) -> Release {
        let (start_m, cylinder_m) = match layout {
            Layout::ThreeBrake => ([-0.05, 0.47], [0.13, 0.43]),
            Layout::FourBrake => ([-0.13, 0.37], [0.19, 0.41]),
        };
        Release {
            layout,
            locked,
            start_m,
            cylinder_m,
            radius_m: 0.02,
            force_n: 9.0,
            duration_s: 2.0,
            sample_s: 1e-3,
        }
    }

    /// The rig at the release: at rest, its brakes without current, in the middle of their backlash.
    ///
    /// # Errors
    /// Those of [`Rig::new`].
    pub fn rig(&self) -> Result<Rig, ModelError> {
        Rig::new(self.layout, self.start_m)
    }

    /// Lets the tip go and returns what happens until it reaches the cylinder, an angle leaves its range of table 4.2 or the
    /// duration is over; the first sample is the release.
    ///
    /// The locked brake has had its full current for a second before, so that its yield torque has settled; in its backlash it
    /// resists with its off-state torque only.
    ///
    /// # Errors
    /// Those of [`Rig::new`] and [`Rig::step_under`]; [`ModelError::NotFinite`] for a force that is no number.
    pub fn run(&self) -> Result<Vec<Sample>, ModelError> {
        let mut rig = self.rig()?;
        let mut currents_a = [0.0; 4];
        for (joint, current_a) in Joint::ALL.into_iter().zip(&mut currents_a) {
            if self.locked == Some(joint) {
                *current_a = GREATEST_CURRENT_A;
            }
        }
        rig.step([0.0; 2], currents_a, 1.0)?;
        let ranges = angle_ranges(self.layout);
        let mut samples = vec![sample(&rig, 0.0)];
        loop {
            let time_s = samples.len() as f64 * self.sample_s;
            if time_s > self.duration_s * (1.0 + 1e-12) {
                break;
            }
            rig.step_under(&|tip_m, _| self.pull_n(tip_m), currents_a, self.sample_s)?;
            if self.distance_m(rig.tip_m()) < self.radius_m || !inside(&ranges, &rig) {
                break;
            }
            samples.push(sample(&rig, time_s));
        }
        Ok(samples)
    }

    /// The spring's force on the tip, N: towards the cylinder's axis; none closer than half its radius, where it has no direction.
    pub fn pull_n(&self, tip_m: [f64; 2]) -> [f64; 2] {
        let distance_m = self.distance_m(tip_m);
        if distance_m < 0.5 * self.radius_m {
            return [0.0; 2];
        }
        let [x, y] = tip_m;
        let [to_x, to_y] = self.cylinder_m;
        [to_x - x, to_y - y].map(|part| part / distance_m * self.force_n)
    }

    fn distance_m(&self, [x, y]: [f64; 2]) -> f64 {
        let [to_x, to_y] = self.cylinder_m;
        libm::hypot(to_x - x, to_y - y)
    }
}

fn sample(rig: &Rig, time_s: f64) -> Sample {
    Sample {
        time_s,
        tip_m: rig.tip_m(),
        joint_angles_rad: rig.joint_angles_rad(),
        joint_rates_rad_s: rig.joint_rates_rad_s(),
        torques_nm: rig.brake_torques_nm(),
        stuck: rig.stuck(),
    }
}

fn inside(ranges: &AngleRanges, rig: &Rig) -> bool {
    Angle::ALL.into_iter().all(|angle| {
        let range = ranges.of(angle);
        let angle_deg = rig.pose().angle_rad(angle) / RAD_PER_DEG;
        (range.least_deg..=range.greatest_deg).contains(&angle_deg)
    })
}
