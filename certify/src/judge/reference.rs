//! This file sets a command beside what the reference decides on the same sample, and counts which differences are ties.

use rigproof_model::control::Controller;
use rigproof_spec::laws::Margin;
use rigproof_spec::layout::Layout;

use crate::controller::Task;
use crate::declared::Claim;
use crate::differential::answer::Answer;
use crate::differential::both::{View, reference, sense};
use crate::differential::nudger::Nudger;
use crate::differential::permitted::{EQUAL_A, Permitted, permitted};
use crate::differential::tick::Tick;
use crate::differential::tie::Ties;

/// The reference's controller on the reference's path.
pub struct Reference {
    controller: Box<dyn Controller>,
    /// What both are told.
    tick: Tick,
    every: u32,
    /// The samples that were ties.
    pub ties: Ties,
    is_broken: bool,
}

/// What both decide by.
#[derive(Clone, Copy)]
pub struct Told {
    /// θA and θB, rad.
    pub theta_rad: [f64; 2],
    /// Their rates, rad/s.
    pub rates_rad_s: [f64; 2],
    /// The push, N.
    pub force_n: [f64; 2],
}

impl Reference {
    /// The reference of the law that a controller claims to be; `None` for settings that it does not take.
    pub fn new(claim: &Claim, layout: Layout, task: &Task) -> Option<Reference> {
        let tick = Tick::of(&claim.law, layout, task);
        Some(Reference {
            controller: reference(&tick, View::EXACT).ok()?,
            tick,
            every: claim.every,
            ties: Ties::default(),
            is_broken: false,
        })
    }

    /// How the currents of a sample, A, lie to the reference's; `None` of a sample that is not set beside it.
    ///
    /// What a controller gives no reason for may mean any. After the first difference that is no tie nothing is judged any more: to say that there is
    /// no tie takes a thousand nudges.
    pub fn margin(&mut self, number: u32, told: &Told, currents_a: [f64; 4]) -> Option<Margin> {
        if self.is_broken || !number.is_multiple_of(self.every) {
            return None;
        }
        let sensed = sense(
            &mut self.tick,
            told.theta_rad,
            told.rates_rad_s,
            told.force_n,
        );
        let command = sensed.map(|sensed| self.controller.command(&sensed));
        let answer = Answer::unexplained(currents_a);
        let apart_a = command.map_or(f64::INFINITY, |command| answer.apart_a(&command));
        if apart_a <= EQUAL_A {
            return Some(Margin(EQUAL_A - apart_a));
        }
        // The verdict on a sample hangs on nothing before it.
        let mut nudger = Nudger::new(u64::from(number));
        let found = permitted(&self.tick, command, answer, &mut nudger);
        if let Ok(Permitted::Tie(tie)) = found {
            self.ties.add(tie);
        }
        self.is_broken = found.is_err();
        Some(Margin(if self.is_broken { -apart_a } else { 0.0 }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::built_in::{BuiltIn, Kind};
    use rigproof_spec::methods::Method;

    /// How the reference of a law judges its own answer, and another one, where the base joints stand so, rad.
    fn holds(law: BuiltIn, theta_rad: [f64; 2], currents_a: [f64; 4]) -> [bool; 2] {
        let task = Task::Chain(vec![[0.0, 0.29], [0.0, 0.45]]);
        let claim = Claim { law, every: 1 };
        let mut reference = Reference::new(&claim, Layout::FourBrake, &task).unwrap();
        let told = Told {
            theta_rad,
            rates_rad_s: [0.31, -0.23],
            force_n: [1.7, 2.9],
        };
        let Told {
            rates_rad_s,
            force_n,
            ..
        } = told;
        let sensed = sense(&mut reference.tick, theta_rad, rates_rad_s, force_n).unwrap();
        let own_a = reference.controller.command(&sensed).currents_a;
        [own_a, currents_a].map(|a| reference.margin(3, &told, a).unwrap().holds())
    }

    #[test]
    fn a_tip_on_the_path_is_a_tie_and_a_wrong_command_is_none() {
        let law = BuiltIn::of(Method::Sdof);
        // The linkage is its own mirror image: the tip is on the path, where no brake acts.
        let mirrored = [2.17, core::f64::consts::PI - 2.17];
        assert_eq!(holds(law, mirrored, [0.0; 4]), [true, true]);
        assert_eq!(holds(law, mirrored, [0.0, 0.31, 0.0, 0.0]), [true, false]);
        let beside = [2.11, 0.93];
        assert_eq!(holds(law, beside, [0.0; 4]), [true, false]);
        assert_eq!(holds(law, beside, [f64::NAN; 4]), [true, false]);
    }

    #[test]
    fn every_law_of_the_rig_has_a_reference_that_refuses_other_currents() {
        let kinds = [
            Kind::Sdof { gap_m: 0.001 },
            Kind::Proportional {
                gain_n_s_per_m: 310.0,
            },
            Kind::VelocityRatio {
                gain_nm_s_per_rad: 1.7,
            },
            Kind::Optimal {
                weight_angle: 1.3,
                weight_energy: 0.4,
                horizon_s: 0.02,
            },
            Kind::Impedance {
                stiffness_n_per_m: 310.0,
                damping_across_n_s_per_m: 23.0,
                damping_along_n_s_per_m: 3.1,
            },
        ];
        for law in kinds {
            let law = BuiltIn {
                law,
                ..BuiltIn::of(Method::Sdof)
            };
            for wrong_a in [[0.31, 0.0, 0.0, 0.0], [0.0, 0.31, 0.0, 0.0], [0.1; 4]] {
                assert_eq!(
                    holds(law, [2.11, 0.93], wrong_a),
                    [true, false],
                    "{law:?} {wrong_a:?}"
                );
            }
        }
    }
}
