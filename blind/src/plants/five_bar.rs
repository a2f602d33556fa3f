//! This file is the five-bar rig with three or four brakes: its plant, its operators, its recordings and what they hide.

mod drive;
mod experiment;
mod hand;
mod hide;
mod linkage;
mod mass;
mod other;
mod plant;
mod record;
mod residual;
mod run;
mod setup;
mod size;
mod stick;
mod told;

pub use experiment::{again, under};

use crate::draw::Draw;
use crate::effect::Effect;
use crate::fault::Names;
use crate::forms::Forms;
use crate::lab::{Drawn, Lab, Secret};
use crate::plant::Plant;
use crate::size::Sizes;
use crate::stratum::Stratum;
use linkage::angles_of_tip;
use plant::FiveBar;
use rigproof_spec::effect::Motion;
use rigproof_spec::geometry::arms;
use rigproof_spec::layout::Layout;
use rigproof_trace::Trace;
use run::Sample;
use setup::Setup;

pub(crate) use crate::make::FINE_STEPS;

/// The five-bar as a plant, with physics in a family of forms.
pub struct Rig(pub Forms);

impl Lab for Rig {
    type Setup = Setup;
    type Run = Vec<Sample>;

    fn plant(&self) -> Plant {
        Plant::Rig
    }

    fn forms(&self) -> Forms {
        self.0
    }

    fn draw(&self, _: u64, stratum: Stratum, draw: &mut Draw) -> Option<Drawn<Setup>> {
        let setup = Setup::draw(stratum, draw)?;
        Some(Drawn {
            hidden: match self.0 {
                Forms::Usual => hide::draw(&setup, stratum, draw),
                Forms::Other => other::draw(&setup, stratum, draw),
            },
            known: Vec::new(),
            setup,
        })
    }

    fn run(&self, drawn: &Drawn<Setup>) -> Option<Vec<Sample>> {
        run::run(&drawn.setup, &drawn.hidden)
    }

    fn sizes(&self, drawn: &Drawn<Setup>, run: &Vec<Sample>) -> Sizes {
        size::sizes(&drawn.setup, &drawn.hidden, run)
    }

    fn record(&self, case: &Secret<Setup, Vec<Sample>>, draw: &mut Draw) -> Trace {
        let Drawn { setup, hidden, .. } = &case.drawn;
        record::record(setup, hidden, &case.run, draw)
    }

    fn describe(&self, seed: u64, drawn: &Drawn<Setup>) -> String {
        record::describe(seed, &drawn.setup).to_toml()
    }

    fn channels(&self, draw: &mut Draw) -> Names<'static> {
        let mut either = |[one, other]: [&'static str; 2]| match draw.chance(0.5) {
            true => [one, other],
            false => [other, one],
        };
        let [position, other_position] = either(["theta_a", "theta_b"]);
        let [effort, other_effort] = either(["force_x", "force_y"]);
        Names {
            position,
            effort,
            roles: [position, effort],
            others: Some([other_position, other_effort]),
        }
    }

    fn motion(&self, _: &Setup) -> Motion {
        Motion::Rotary
    }

    fn told(&self, setup: &Setup, effect: &Effect) -> Effect {
        told::in_the_vocabulary(setup, effect)
    }

    fn twins(&self, drawn: &Drawn<Setup>, effect: &Effect) -> Vec<Vec<String>> {
        told::sets(&drawn.setup, effect)
    }
}

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
