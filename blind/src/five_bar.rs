//! This file is the five-bar rig with three or four brakes: its plant, its operators, its recordings and what they hide.

mod braked;
mod drive;
mod element;
mod hand;
mod hide;
mod law;
mod linkage;
mod make;
mod mass;
mod plant;
mod preisach;
mod residual;
mod run;
mod setup;
mod size;
mod stick;

pub use make::{again, make, under};

use linkage::angles_of_tip;
use plant::FiveBar;
use rigproof_spec::geometry::arms;
use rigproof_spec::layout::Layout;

/// Fine steps to a sample of 1 ms: 20 kHz.
pub(crate) const FINE_STEPS: usize = 20;

/// What acts on the rig over a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigStep {
    /// Force on the tip, x and y, N.
    pub force_n: [f64; 2],
    /// Currents of A, E, B, C, A.
    pub currents_a: [f64; 4],
}

/// Where the rig is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigState {
    /// θA and θB, rad.
    pub theta_rad: [f64; 2],
    /// Their rates, rad/s.
    pub rates_rad_s: [f64; 2],
    /// Which of the joints A, E, B, C stick.
    pub stuck: [bool; 4],
    /// Work of the force on the tip since the start, J.
    pub work_j: f64,
    /// What the brakes took of it, J.
    pub dissipated_j: f64,
}

/// The motion of this room's five-bar with nothing hidden from rest at a tip position, m: its state after each step of
/// `step_s`, or `None` where the arms do not meet.
///
/// Recordings are made with the same code, so that another implementation can be compared with it.
pub fn five_bar_motion(
    layout: Layout,
    tip_m: [f64; 2],
    steps: &[RigStep],
    step_s: f64,
) -> Option<Vec<RigState>> {
    let theta = angles_of_tip(&arms(layout), tip_m)?;
    let mut rig = FiveBar::new(layout, theta, &[])?;
    let fine_s = step_s / FINE_STEPS as f64;
    let mut fine = 0;
    let states = steps.iter().map(|step| {
        for _ in 0..FINE_STEPS {
            let time_s = f64::from(fine) * fine_s;
            rig.step(time_s, fine_s, step.currents_a, &mut |_, _, _| step.force_n)?;
            fine += 1;
        }
        Some(RigState {
            theta_rad: rig.theta,
            rates_rad_s: rig.rates,
            stuck: rig.stuck(),
            work_j: rig.work_j,
            dissipated_j: rig.taken_j,
        })
    });
    states.collect()
}

#[cfg(test)]
mod tests;
