//! This file is a driven joint as laboratories have it: a held command, an encoder of few counts, numbers that are stated or not, and physics in other forms than the usual ones.

mod chain;
mod hide;
mod residual;
mod rig;
mod run;
mod setup;
#[cfg(test)]
mod tests;

use crate::draw::Draw;
use crate::effect::Effect;
use crate::fault::Names;
use crate::form::Form;
use crate::forms::Forms;
use crate::lab::{Drawn, Lab, Secret};
use crate::plant::Plant;
use crate::size::Sizes;
use crate::stratum::Stratum;
use rigproof_spec::effect::Motion;
use rigproof_trace::{Channel, Trace};
use run::Run;
use setup::Setup;

/// The driven joint.
pub struct DrivenJoint;

impl Lab for DrivenJoint {
    type Setup = Setup;
    type Run = Run;

    fn plant(&self) -> Plant {
        Plant::Axis
    }

    fn forms(&self) -> Forms {
        Forms::Other
    }

    fn draw(&self, _: u64, stratum: Stratum, draw: &mut Draw) -> Option<Drawn<Setup>> {
        let setup = Setup::draw(draw);
        let mut hidden = hide::draw(&setup, stratum, draw);
        if stratum == Stratum::LateOnset {
            let onset_s = setup.duration_s * draw.uniform(1.0 / 3.0, 2.0 / 3.0);
            hidden
                .iter_mut()
                .for_each(|effect| effect.onset_s = Some(onset_s));
        }
        Some(Drawn {
            known: setup.friction(),
            setup,
            hidden,
        })
    }

    fn run(&self, drawn: &Drawn<Setup>) -> Option<Run> {
        run::run(&drawn.setup, &drawn.hidden, run::FINE_HZ)
    }

    fn sizes(&self, drawn: &Drawn<Setup>, run: &Run) -> Sizes {
        residual::sizes(&drawn.setup, &drawn.hidden, run)
    }

    fn record(&self, case: &Secret<Setup, Run>, draw: &mut Draw) -> Trace {
        let (setup, run) = (&case.drawn.setup, &case.run);
        let channel = |name: &str, unit: &str, samples: Vec<f64>| Channel {
            name: name.to_owned(),
            unit: unit.to_owned(),
            samples,
        };
        let position = run.position.iter().map(|q| setup.counted(*q)).collect();
        let noise = setup.command_noise;
        let command = run.command.iter().map(|u| u + draw.normal(noise)).collect();
        Trace {
            time_s: (0..run.position.len())
                .map(|k| k as f64 / setup.rate_hz)
                .collect(),
            channels: vec![
                channel("position", "rad", position),
                channel("command", setup.command_unit(), command),
            ],
        }
    }

    fn describe(&self, seed: u64, drawn: &Drawn<Setup>) -> String {
        rig::toml(seed, &drawn.setup)
    }

    fn channels(&self, _: &mut Draw) -> Names<'static> {
        Names {
            position: "position",
            effort: "command",
            roles: ["position", "effort"],
            others: None,
        }
    }

    fn motion(&self, _: &Setup) -> Motion {
        Motion::Rotary
    }

    fn twins(&self, drawn: &Drawn<Setup>, effect: &Effect) -> Vec<Vec<String>> {
        let free = drawn.setup.stated.is_free();
        let names: &[&str] = match effect.form {
            // With every number unknown a scale of the efforts is one of all the others.
            Form::Gain if free => &["inertia_error", "payload"],
            Form::Inertia if free => &["gain_error"],
            Form::EncoderScale => &["gain_error", "inertia_error"],
            Form::Asymmetric if effect.values.get(1) == Some(&0.0) => &["constant_bias"],
            Form::Bias if drawn.setup.dry > 0.0 => &["direction_asymmetry"],
            _ => &[],
        };
        names.iter().map(|name| vec![(*name).to_owned()]).collect()
    }
}
