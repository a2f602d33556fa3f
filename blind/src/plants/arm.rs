//! This file is a serial arm with made-up but possible links, or one that people have, led along sums of sines: positions and efforts of its joints are recorded.

mod body;
mod built;
mod describe;
mod dynamics;
mod hide;
mod run;
mod setup;
#[cfg(test)]
mod tests;
mod vector;

use crate::draw::Draw;
use crate::effect::{At, Effect};
use crate::fault::Names;
use crate::form::Form;
use crate::forms::Forms;
use crate::lab::{Drawn, Lab, Secret};
use crate::plant::Plant;
use crate::size::Sizes;
use crate::stratum::Stratum;
use body::Body;
use rigproof_spec::effect::Motion;
use rigproof_trace::{Channel, Trace};
use run::Run;
use setup::Setup;

/// The arm.
pub struct Arm;

impl Lab for Arm {
    type Setup = Setup;
    type Run = Run;

    fn plant(&self) -> Plant {
        Plant::Chain
    }

    /// It is judged as machines in other forms are: by the names that are right, missing or false.
    fn forms(&self) -> Forms {
        Forms::Other
    }

    fn draw(&self, seed: u64, stratum: Stratum, draw: &mut Draw) -> Option<Drawn<Setup>> {
        let body = built::of(seed).unwrap_or_else(|| Body::draw(draw));
        let setup = Setup::of(body, draw);
        let hidden = hide::draw(&setup, stratum, draw);
        Some(Drawn {
            known: Vec::new(),
            setup,
            hidden,
        })
    }

    fn run(&self, drawn: &Drawn<Setup>) -> Option<Run> {
        Some(run::run(&drawn.setup, &drawn.hidden))
    }

    fn sizes(&self, drawn: &Drawn<Setup>, run: &Run) -> Sizes {
        run::sizes(&drawn.setup, &drawn.hidden, run)
    }

    fn record(&self, case: &Secret<Setup, Run>, draw: &mut Draw) -> Trace {
        let (setup, run) = (&case.drawn.setup, &case.run);
        let time_s: Vec<f64> = (0..setup.samples())
            .map(|k| k as f64 / setup.rate_hz)
            .collect();
        let mut channels = Vec::new();
        let each = setup.body.joints.iter().zip(&setup.paths);
        let each = each.zip(&setup.sensors).zip(&run.efforts).enumerate();
        for (k, (((member, path), [count, noise]), efforts)) in each {
            let (travel, effort) = match member.slides {
                true => ("m", "N"),
                false => ("rad", "N·m"),
            };
            let counted = |time_s: &f64| {
                let [q, ..] = path.at(*time_s);
                (q / count).round() * count
            };
            channels.push(Channel {
                name: format!("q{}", k + 1),
                unit: travel.to_owned(),
                samples: time_s.iter().map(counted).collect(),
            });
            channels.push(Channel {
                name: format!("tau{}", k + 1),
                unit: effort.to_owned(),
                samples: efforts.iter().map(|e| e + draw.normal(*noise)).collect(),
            });
        }
        Trace { time_s, channels }
    }

    fn describe(&self, seed: u64, drawn: &Drawn<Setup>) -> String {
        describe::toml(seed, &drawn.setup)
    }

    fn channels(&self, _: &mut Draw) -> Names<'static> {
        Names {
            position: "q1",
            effort: "tau1",
            roles: ["position", "effort"],
            others: Some(["q2", "tau2"]),
        }
    }

    fn motion(&self, _: &Setup) -> Motion {
        Motion::Rotary
    }

    /// What masses of a link do shows in the numbers of that link and of all before it, and at the first joint as a rotor.
    fn twins(&self, _: &Drawn<Setup>, effect: &Effect) -> Vec<Vec<String>> {
        let At::Arm(joint) = effect.at else {
            return Vec::new();
        };
        let named = |mechanism: &str, k: usize| vec![format!("{mechanism} at joint{}", k + 1)];
        match effect.form {
            Form::LinkMass => {
                let before = (0..joint).map(|k| named("link_inertia", k));
                before.chain([named("added_inertia", 0)]).collect()
            }
            Form::Payload => {
                let all = (0..=joint).map(|k| named("link_inertia", k));
                all.chain([named("added_inertia", 0)]).collect()
            }
            // A rotor is a moment of the link about its own axis where nothing before it moves.
            Form::Rotor if joint == 0 => vec![named("link_inertia", 0)],
            _ => Vec::new(),
        }
    }
}
