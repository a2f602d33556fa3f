//! This file is one joint: an axis that a drive moves, or a brake or damper on a bench that a motor moves.

mod axis;
mod bench;
mod hide;
mod nominal;
mod other;
mod rig;
mod run;
mod setup;
mod size;
#[cfg(test)]
mod tests;

use crate::draw::Draw;
use crate::effect::Effect;
use crate::fault::Names;
use crate::form::Form;
use crate::forms::Forms;
use crate::lab::{Drawn, Lab, Secret};
use crate::make::FINE_STEPS;
use crate::plant::Plant;
use crate::size::Sizes;
use crate::stratum::Stratum;
pub use axis::Joint;
use rigproof_spec::effect::{Motion, Quantity};
use rigproof_trace::{Channel, Trace};
pub use run::Delay;
use run::Run;
use setup::{Kind, Setup};

/// An axis or a bench with physics in the usual forms, or a bench with others.
pub struct OneJoint(pub Plant, pub Forms);

impl Lab for OneJoint {
    type Setup = Setup;
    type Run = Run;

    fn plant(&self) -> Plant {
        self.0
    }

    fn forms(&self) -> Forms {
        self.1
    }

    fn draw(&self, seed: u64, stratum: Stratum, draw: &mut Draw) -> Option<Drawn<Setup>> {
        if self.1 == Forms::Other {
            return Some(other::draw(seed, stratum, draw));
        }
        let setup = Setup::draw(self.0, &mut Draw::new(self.0, seed, "setup"));
        let mut hidden = hide::draw(&setup, stratum, draw);
        let onset_s = (stratum == Stratum::LateOnset)
            .then(|| setup.duration_s * draw.uniform(1.0 / 3.0, 2.0 / 3.0));
        let known = nominal::draw(&setup, &hidden, draw);
        hidden
            .iter_mut()
            .for_each(|effect| effect.onset_s = onset_s);
        Some(Drawn {
            setup,
            known,
            hidden,
        })
    }

    fn run(&self, drawn: &Drawn<Setup>) -> Option<Run> {
        Some(simulate(drawn, FINE_STEPS))
    }

    fn sizes(&self, drawn: &Drawn<Setup>, run: &Run) -> Sizes {
        size::sizes(drawn, run)
    }

    fn record(&self, case: &Secret<Setup, Run>, draw: &mut Draw) -> Trace {
        let Secret { drawn, run, .. } = case;
        record(&drawn.setup, run, draw)
    }

    fn describe(&self, seed: u64, drawn: &Drawn<Setup>) -> String {
        let mut values = self.numbers(seed, "nominal values");
        rig::toml(self.0, seed, &drawn.setup, &drawn.known, &mut values)
    }

    fn channels(&self, _: &mut Draw) -> Names<'static> {
        Names {
            position: "position",
            effort: match self.0 {
                Plant::Axis => "command",
                _ => "torque",
            },
            roles: ["position", "effort"],
            others: None,
        }
    }

    fn motion(&self, setup: &Setup) -> Motion {
        setup.motion
    }

    fn twins(&self, drawn: &Drawn<Setup>, effect: &Effect) -> Vec<Vec<String>> {
        // A motor on a bench holds any bias; on an axis only dry friction can carry one off as an asymmetry.
        let mut laws = drawn.known.iter().chain(&drawn.hidden);
        let dry = self.0 == Plant::Bench || laws.any(|law| law.form == Form::Coulomb);
        let sets = equivalent(effect, self.0, dry).iter();
        let named = |names: &&[&str]| names.iter().map(|name| (*name).to_owned()).collect();
        sets.map(named).collect()
    }
}

/// Sets of mechanisms that no recording can tell from a law.
///
/// - A dry friction of F + D forward and F − D backward is the set [−F, F] shifted by D: a bias of D.
/// - Dahl's bristle is the Bouc–Wen law of order one with beta_delta zero.
/// - A drive gain k times too large with all friction and stiffness unknown is an inertia k times too small.
fn equivalent(
    effect: &Effect,
    plant: Plant,
    dry_in_plant: bool,
) -> &'static [&'static [&'static str]] {
    let [dry, viscous, ..] = effect.values;
    match effect.form {
        Form::Asymmetric if viscous == 0.0 => &[&["constant_bias"]],
        Form::Asymmetric if dry != 0.0 => &[&["constant_bias", "direction_asymmetry"]],
        Form::Bias if dry_in_plant => &[&["direction_asymmetry"]],
        Form::Dahl => &[&["hysteresis"]],
        Form::Gain if plant == Plant::Axis => &[&["inertia_error"]],
        _ => &[],
    }
}

/// Runs the plant, so many fine steps to a sample.
fn simulate(drawn: &Drawn<Setup>, fine_steps: usize) -> Run {
    let Drawn {
        setup,
        known,
        hidden,
    } = drawn;
    match &setup.kind {
        Kind::Axis(drive) => axis::run(setup, drive, known, hidden, fine_steps),
        Kind::Bench(_) => bench::run(setup, known, hidden, fine_steps),
    }
}

/// What the sensors make of the run.
fn record(setup: &Setup, run: &Run, draw: &mut Draw) -> Trace {
    let unit = |quantity: Quantity| quantity.dimension(setup.motion).to_string();
    let zero = setup.quantum * draw.uniform(0.0, 1.0);
    let mut noisy = |signal: &[f64]| -> Vec<f64> {
        signal
            .iter()
            .map(|x| x + draw.normal(setup.noise))
            .collect()
    };
    let mut channels = vec![Channel {
        name: "position".to_owned(),
        unit: unit(Quantity::Travel),
        samples: run
            .shown_position
            .iter()
            .map(|q| ((q + zero) / setup.quantum).floor() * setup.quantum)
            .collect(),
    }];
    match &setup.kind {
        Kind::Axis(_) => channels.push(Channel {
            name: "command".to_owned(),
            unit: "V".to_owned(),
            samples: noisy(&run.shown_input),
        }),
        Kind::Bench(brake) => {
            channels.push(Channel {
                name: rig::effort_channel(setup.motion).to_owned(),
                unit: unit(Quantity::Effort),
                samples: noisy(&run.shown_effort),
            });
            if brake.is_some() {
                channels.push(Channel {
                    name: "current".to_owned(),
                    unit: "A".to_owned(),
                    samples: run.shown_input.clone(),
                });
            }
        }
    }
    Trace {
        time_s: run.time_s.clone(),
        channels,
    }
}
