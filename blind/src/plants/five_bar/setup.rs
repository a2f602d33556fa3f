//! This file draws the laboratory of a five-bar recording: layout, sensors, hand and currents.

use super::drive::{Drive, constant, controller, programme};
use super::hand::Hand;
use super::linkage::{Pair, Pose, angles_of_tip};
use crate::draw::{Draw, rounded};
use crate::stratum::Stratum;
use rigproof_spec::geometry::arms;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use std::f64::consts::TAU;

/// Samples a second.
pub const RATE_HZ: f64 = 1000.0;

/// One laboratory.
#[derive(Clone, Debug)]
pub struct Setup {
    pub layout: Layout,
    pub duration_s: f64,
    pub hand: Hand,
    pub drive: Drive,
    /// θA and θB at the start, rad.
    pub start: Pair,
    pub counts_per_turn: f64,
    /// Whether the angles are recorded in counts.
    pub in_counts: bool,
    /// Standard deviation of the force channels, N.
    pub force_noise_n: f64,
}

/// How long the hand takes to where an experiment begins, s.
const REACH_S: f64 = 1.5;

/// An experiment that somebody asks for.
#[derive(Clone, Debug)]
pub struct Asked {
    pub step_s: f64,
    /// Where the hand is led, m.
    pub path_m: Vec<Pair>,
    /// Currents of A, E, B and C.
    pub currents_a: [Vec<f64>; 4],
}

impl Setup {
    /// The laboratory of a seed and a stratum; `None` where the tip cannot be.
    pub fn draw(stratum: Stratum, draw: &mut Draw) -> Option<Setup> {
        let layout = match draw.chance(0.5) {
            true => Layout::ThreeBrake,
            false => Layout::FourBrake,
        };
        let duration_s = draw.uniform(16.0, 30.0).floor();
        let (height_m, _) = reach_m(layout);
        let centre_m = [
            draw.uniform(-0.015, 0.015),
            height_m + draw.uniform(-0.015, 0.015),
        ];
        let (hand, drive) = experiment(stratum, layout, centre_m, duration_s, draw);
        let noise_n = draw.log_uniform(0.02, 0.1);
        let louder = if stratum == Stratum::Noisy { 5.0 } else { 1.0 };
        Some(Setup {
            layout,
            duration_s,
            start: angles_of_tip(&arms(layout), hand.goal.centre_m())?,
            hand,
            drive,
            counts_per_turn: draw.pick(&[1e5, 1e6]),
            in_counts: draw.chance(0.5),
            force_noise_n: rounded(louder * noise_n),
        })
    }

    /// The same laboratory with another hand and other currents, from the same start.
    pub fn again(&self, stratum: Stratum, draw: &mut Draw) -> Setup {
        let centre_m = self.hand.goal.centre_m();
        let (hand, drive) = experiment(stratum, self.layout, centre_m, self.duration_s, draw);
        Setup {
            hand,
            drive,
            ..self.clone()
        }
    }

    /// The same laboratory with an experiment that somebody asks for, after a reach to where it begins.
    pub fn under(&self, asked: Asked, draw: &mut Draw) -> Setup {
        let Asked {
            step_s,
            path_m,
            currents_a,
        } = asked;
        let centre_m = self.hand.goal.centre_m();
        Setup {
            duration_s: REACH_S + path_m.len() as f64 * step_s,
            hand: Hand::led(draw, centre_m, REACH_S, step_s, path_m),
            drive: Drive::Given {
                from_s: REACH_S,
                step_s,
                currents_a,
            },
            ..self.clone()
        }
    }

    /// Whether no current ever changes.
    pub fn is_constant(&self) -> bool {
        match &self.drive {
            Drive::Programme(pieces) => pieces.iter().all(|pieces| pieces.len() < 2),
            Drive::Loop(_) | Drive::Given { .. } => false,
        }
    }

    /// The angle of a joint at the start, rad: that of E, as the thesis has it, between π and 2π.
    pub fn start_angle_rad(&self, joint: Joint) -> f64 {
        let place = Joint::ALL.into_iter().position(|own| own == joint);
        let angles =
            Pose::at(&arms(self.layout), self.start).map(|pose| pose.joint_angles_rad(self.start));
        let angle_rad = angles
            .zip(place)
            .and_then(|(angles, place)| angles.get(place).copied())
            .unwrap_or_default();
        match joint {
            Joint::E => angle_rad.rem_euclid(TAU),
            _ => angle_rad,
        }
    }

    /// The angle of one count, rad.
    pub fn quantum_rad(&self) -> f64 {
        TAU / self.counts_per_turn
    }
}

/// Height of the middle of the workspace, and how far about it a hand reaches, m.
const fn reach_m(layout: Layout) -> (f64, f64) {
    match layout {
        Layout::ThreeBrake => (0.38, 0.1),
        Layout::FourBrake => (0.42, 0.085),
    }
}

/// A hand and what commands the brakes.
fn experiment(
    stratum: Stratum,
    layout: Layout,
    centre_m: Pair,
    duration_s: f64,
    draw: &mut Draw,
) -> (Hand, Drive) {
    let (_, radius_m) = reach_m(layout);
    let person = draw.chance(0.4);
    let hand = match person {
        true => Hand::person(draw, centre_m, radius_m, duration_s),
        false => Hand::experimenter(draw, centre_m, radius_m, duration_s),
    };
    let greatest_a = if person {
        draw.uniform(0.25, 0.45)
    } else {
        draw.uniform(0.4, 0.9)
    };
    let in_loop = draw.chance(0.25) || stratum == Stratum::InLoop;
    let drive = if stratum == Stratum::Unidentifiable {
        constant(draw, layout, duration_s, greatest_a)
    } else if in_loop {
        controller(draw, layout, centre_m, radius_m, greatest_a)
    } else {
        programme(draw, layout, duration_s, greatest_a)
    };
    (hand, drive)
}
