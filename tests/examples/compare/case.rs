//! This file says what is run: two layouts, free, with dry joints twice, and with every brake locked.

use rigproof_model::linkage::{Pose, inverse};
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::tables::{GREATEST_CURRENT_A, torque_gain_fit};

/// Time under its currents and no force before a run, s: the yield torques have settled.
pub const SETTLING_S: f64 = 1.0;

/// What resists at the joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joints {
    /// Nothing.
    Free,
    /// The brakes without current: dry friction of their off-state torque.
    Dry,
    /// The same under forces that hold for 8 ms, so that every engine may step as far.
    Work,
    /// The brakes at their greatest current.
    Locked,
}

/// One run: a layout from rest at one place under forces that hold for a tick each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// The layout.
    pub layout: Layout,
    /// What resists.
    pub joints: Joints,
}

impl Case {
    /// Every case.
    pub fn all() -> Vec<Case> {
        let joints = [Joints::Free, Joints::Dry, Joints::Work, Joints::Locked];
        [Layout::ThreeBrake, Layout::FourBrake]
            .into_iter()
            .flat_map(|layout| joints.map(|joints| Case { layout, joints }))
            .collect()
    }

    /// A name for files.
    pub fn name(&self) -> String {
        let layout = match self.layout {
            Layout::ThreeBrake => "three",
            Layout::FourBrake => "four",
        };
        let joints = match self.joints {
            Joints::Free => "free",
            Joints::Dry => "dry",
            Joints::Work => "work",
            Joints::Locked => "locked",
        };
        format!("{layout}-{joints}")
    }

    /// Where the tip starts, m.
    pub fn start_m(&self) -> [f64; 2] {
        match self.layout {
            Layout::ThreeBrake => [0.031, 0.402],
            Layout::FourBrake => [0.043, 0.371],
        }
    }

    /// The pose at the start.
    pub fn start(&self) -> Pose {
        inverse::pose(&rigproof_spec::geometry::arms(self.layout), self.start_m()).unwrap()
    }

    /// Time for which the force on the tip holds, s.
    pub fn tick_s(&self) -> f64 {
        match self.joints {
            Joints::Work => 8e-3,
            Joints::Free | Joints::Dry | Joints::Locked => 1e-3,
        }
    }

    /// Ticks of the run.
    pub fn ticks(&self) -> usize {
        match self.joints {
            Joints::Locked => 5000,
            Joints::Work => 188,
            Joints::Free | Joints::Dry => 1500,
        }
    }

    /// The force on the tip in every tick, N.
    pub fn forces_n(&self) -> Vec<[f64; 2]> {
        (0..self.ticks()).map(|tick| self.force_n(tick)).collect()
    }

    fn force_n(&self, tick: usize) -> [f64; 2] {
        let t = tick as f64 * self.tick_s();
        match self.joints {
            Joints::Free => [
                4.3 * libm::cos(7.7 * t) + 7.9 * libm::cos(17.3 * t + 0.4),
                6.1 * libm::cos(9.1 * t + 0.3) - 5.3 * libm::cos(21.7 * t),
            ],
            Joints::Dry | Joints::Work => [
                9.7 * libm::cos(7.7 * t) + 5.9 * libm::cos(17.3 * t + 0.4),
                11.3 * libm::cos(9.1 * t + 0.3) - 6.7 * libm::cos(21.7 * t),
            ],
            Joints::Locked => [6.7, 8.723_531_395_025_755],
        }
    }

    /// The currents of A, E, B, C, A.
    pub fn currents_a(&self) -> [f64; 4] {
        Joint::ALL.map(|joint| {
            let locked = self.joints == Joints::Locked;
            if locked && self.layout.brakes().contains(&joint) {
                GREATEST_CURRENT_A
            } else {
                0.0
            }
        })
    }

    /// The dry friction of joints A, E, B, C that an engine without brakes is given, N·m.
    pub fn friction_nm(&self) -> [f64; 4] {
        Joint::ALL.map(|joint| {
            let fit = torque_gain_fit(joint);
            match self.joints {
                _ if !self.layout.brakes().contains(&joint) => 0.0,
                Joints::Free => 0.0,
                Joints::Dry | Joints::Work => fit.off_state_nm(),
                Joints::Locked => fit.greatest_nm(),
            }
        })
    }
}
