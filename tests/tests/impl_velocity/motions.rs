//! This file makes motions to estimate the velocity of: trials with a simulated operator, and free motions of the reference rig.

use nalgebra::Vector2;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigproof_model::control::path::{Line, Path};
use rigproof_model::control::{Actuation, GainUnit, Sensed, controller};
use rigproof_model::operator::{Abilities, Hand, Operator};
use rigproof_model::rig::{Parameters, Rig};
use rigproof_model::trial::LINES;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::Method;

pub const SAMPLE_S: f64 = 0.001;

/// One sample of a motion.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// θA and θB, rad.
    pub theta_rad: [f64; 2],
    /// Their rates, rad/s.
    pub rates_rad_s: [f64; 2],
    /// What the rates of A, E, B, C are made of, as rows over the rates of θA and θB.
    pub joints: [[f64; 2]; 4],
}

pub type Motion = Vec<Sample>;

/// What stands between the rig and its controller: from the true angles of a sample to the rates that the controller is told.
pub type Estimate<'a> = &'a mut dyn FnMut([f64; 2], [f64; 2]) -> [f64; 2];

/// The motions of one seed: every method on both lines and layouts, and as many free motions.
pub fn motions(seed: u64) -> Vec<Motion> {
    let mut motions = Vec::new();
    for layout in [Layout::ThreeBrake, Layout::FourBrake] {
        for line in 0..LINES.len() {
            for method in Method::ALL {
                motions.push(trial(layout, line, method, seed, &mut |_, rates| rates));
            }
        }
        for number in 0..3 {
            motions.push(free(layout, seed * 3 + number));
        }
    }
    motions
}

/// A trial in which the controller is told the rates that `estimate` makes of the angles.
pub fn trial(layout: Layout, line: usize, method: Method, seed: u64, estimate: Estimate) -> Motion {
    let segment = LINES[line];
    let line = Line::through(segment.from_m, segment.to_m).unwrap();
    let actuation = Actuation::thesis(layout);
    let mut controller = controller(method, GainUnit::PerCentimetre, actuation, line).unwrap();
    let mut operator = Operator::new(line, Abilities::CAREFUL, seed).unwrap();
    let mut rig = Rig::new(layout, segment.from_m).unwrap();
    let (from_m, to_m) = (Vector2::from(segment.from_m), Vector2::from(segment.to_m));
    let mut motion = Motion::new();
    for _ in 0..8000 {
        let tip_m = rig.tip_m();
        if (Vector2::from(tip_m) - to_m).dot(&(to_m - from_m)) >= 0.0
            || !line.nearest(tip_m).is_defined()
        {
            break;
        }
        motion.push(sample(&rig));
        let rates_rad_s = estimate(rig.base_angles_rad(), rig.base_rates_rad_s());
        let force_n = operator.push(tip_m, rig.tip_velocity_m_s(), SAMPLE_S);
        let sensed = Sensed {
            pose: *rig.pose(),
            tip_velocity_m_s: rig.form().tip_velocity_m_s(rates_rad_s),
            omega_rad_s: rig.form().joint_rates_rad_s(rates_rad_s),
            tip_force_n: force_n,
        };
        let command = controller.command(&sensed);
        rig.step(force_n, command.currents_a, SAMPLE_S).unwrap();
    }
    motion
}

/// A motion without current from a random state until it comes to rest, and a moment longer; at most 2 s.
fn free(layout: Layout, seed: u64) -> Motion {
    let mut draw = Pcg64::seed_from_u64(seed);
    let parameters = Parameters::of(layout);
    loop {
        let theta_rad = [draw.random_range(1.7..2.9), draw.random_range(0.3..1.4)];
        let rates = [0, 1].map(|_| draw.random_range(-3.1..3.1));
        let Ok(mut rig) = Rig::moving(parameters, theta_rad, rates) else {
            continue;
        };
        let mut motion = Motion::new();
        let push_n = [0, 1].map(|_| draw.random_range(-2.3..2.3));
        for tick in 0..2000 {
            motion.push(sample(&rig));
            let push_n = if tick < 700 { push_n } else { [0.0; 2] };
            if rig.step(push_n, [0.0; 4], SAMPLE_S).is_err() {
                break;
            }
        }
        if motion.len() > 300 {
            return motion;
        }
    }
}

fn sample(rig: &Rig) -> Sample {
    let of = |rates| rig.form().joint_rates_rad_s(rates);
    let (by_a, by_b) = (of([1.0, 0.0]), of([0.0, 1.0]));
    Sample {
        theta_rad: rig.base_angles_rad(),
        rates_rad_s: rig.base_rates_rad_s(),
        joints: [0, 1, 2, 3].map(|joint| [by_a[joint], by_b[joint]]),
    }
}
