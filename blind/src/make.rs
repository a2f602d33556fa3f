//! This file makes a case: a recording, its rig description and the sealed answer, from a seed alone.

use crate::answer::{Answer, HiddenEffect};
use crate::draw::Draw;
use crate::error::Error;
use crate::law::{Effect, Law};
use crate::plant::Plant;
use crate::run::Run;
use crate::seal;
use crate::setup::{Kind, Setup};
use crate::size::{FAINT_STRENGTH, Size, block_noise, sizes};
use crate::stratum::Stratum;
use crate::{axis, bench, fault, five_bar, hide, nominal, rig};
use rigproof_spec::effect::Quantity;
use rigproof_trace::{Channel, Trace};

/// Fine steps to a sample.
pub(crate) const FINE_STEPS: usize = 20;

/// A recording with a hidden cause.
#[derive(Clone, Debug)]
pub struct Case {
    /// The recording.
    pub trace: Trace,
    /// The rig description, TOML.
    pub rig_toml: String,
    /// The sealed answer, to be opened after the diagnosis.
    pub sealed: String,
    /// SHA-256 of the answer, published with the recording.
    pub commitment: String,
}

/// What a case is made of, before sensors and seals.
pub(crate) struct Secret {
    pub setup: Setup,
    pub known: Vec<Law>,
    pub hidden: Vec<Effect>,
    pub sizes: Vec<Size>,
    pub run: Run,
}

/// Another recording of the five-bar of a seed, with the same effects hidden: another hand and other currents, from the same start.
///
/// # Errors
/// [`Error::NoCase`] when no draw of the seed meets the stratum's rule of size, or moves enough.
pub fn again(seed: u64) -> Result<Trace, Error> {
    five_bar::again(seed, Stratum::of_seed(Plant::Rig, seed))
}

/// An experiment, as a diagnosis asks for it, on the five-bar of a seed: its recording, and the answer with what that tells; `None` lets the seed draw
/// the stratum.
///
/// # Errors
/// Those of [`make`]; [`Error::Experiment`] when it cannot be read or cannot be done.
pub fn under(seed: u64, stratum: Option<Stratum>, experiment: &Trace) -> Result<Case, Error> {
    let stratum = stratum.unwrap_or_else(|| Stratum::of_seed(Plant::Rig, seed));
    five_bar::under(seed, stratum, experiment)
}

/// Makes the case of a seed; `None` lets the seed draw the stratum.
///
/// # Errors
/// [`Error::NoCase`] when no draw of the seed meets the stratum's rule of size; [`Error::OtherPlant`] when the plant has no such
/// stratum.
pub fn make(plant: Plant, seed: u64, stratum: Option<Stratum>) -> Result<Case, Error> {
    let stratum = stratum.unwrap_or_else(|| Stratum::of_seed(plant, seed));
    if stratum.of_twenty(plant) == 0 {
        return Err(Error::OtherPlant {
            stratum: stratum.name(),
            plant: plant.name(),
        });
    }
    if plant == Plant::Rig {
        return five_bar::make(seed, stratum);
    }
    let secret = secret(plant, seed, stratum)?;
    let mut trace = record(&secret, &mut Draw::new(plant, seed, "sensors"));
    let fault = (stratum == Stratum::DataFault).then(|| {
        let effort = match plant {
            Plant::Axis => "command",
            _ => "torque",
        };
        let mut draw = Draw::new(plant, seed, "fault");
        fault::spoil("position", effort, &mut trace, &mut draw)
    });
    // A motor on a bench holds any bias; on an axis only dry friction can carry one off as an asymmetry.
    let dry_in_plant = plant == Plant::Bench
        || secret
            .known
            .iter()
            .chain(secret.hidden.iter().map(|effect| &effect.law))
            .any(|law| matches!(law, Law::Dry { .. }));
    let answer = Answer {
        seed,
        plant,
        stratum,
        effects: secret
            .hidden
            .iter()
            .zip(&secret.sizes)
            .map(|(effect, size)| {
                HiddenEffect::new(effect, *size, plant, secret.setup.motion, dry_in_plant)
            })
            .collect(),
        fault: fault.map(str::to_owned),
        block_noise: block_noise(&secret.setup),
    };
    let (sealed, commitment) = seal::seal(&answer)?;
    let mut values = Draw::new(plant, seed, "nominal values");
    Ok(Case {
        trace,
        rig_toml: rig::toml(plant, seed, &secret.setup, &secret.known, &mut values),
        sealed,
        commitment,
    })
}

/// Draws until the hidden effects have the size their stratum asks for.
pub(crate) fn secret(plant: Plant, seed: u64, stratum: Stratum) -> Result<Secret, Error> {
    const ATTEMPTS: usize = 24;
    let setup = Setup::draw(plant, &mut Draw::new(plant, seed, "setup"));
    let mut draw = Draw::new(plant, seed, stratum.name());
    for _ in 0..ATTEMPTS {
        let laws = hide::draw(&setup, stratum, &mut draw);
        let onset_s = (stratum == Stratum::LateOnset)
            .then(|| setup.duration_s * draw.uniform(1.0 / 3.0, 2.0 / 3.0));
        let known = nominal::draw(&setup, &laws, &mut draw);
        let hidden: Vec<Effect> = laws
            .into_iter()
            .map(|law| Effect { law, onset_s })
            .collect();
        let tried = Secret::new(&setup, known, hidden);
        let tried = if stratum == Stratum::TooSmall {
            let target = draw.uniform(0.2, 0.7);
            shrink(tried, target)
        } else {
            tried
        };
        if tried.fits(stratum) {
            return Ok(tried);
        }
    }
    Err(Error::NoCase {
        seed,
        plant: plant.name(),
        stratum: stratum.name(),
        attempts: ATTEMPTS,
    })
}

impl Secret {
    fn new(setup: &Setup, known: Vec<Law>, hidden: Vec<Effect>) -> Secret {
        let run = simulate(setup, &known, &hidden, FINE_STEPS);
        let laws: Vec<Law> = hidden.iter().map(|effect| effect.law).collect();
        Secret {
            sizes: sizes(setup, &run, &known, &laws),
            setup: setup.clone(),
            known,
            hidden,
            run,
        }
    }

    fn fits(&self, stratum: Stratum) -> bool {
        let moves = self.run.moving.iter().filter(|m| **m).count() * 2 > self.run.moving.len();
        moves && self.sizes.iter().all(|size| size.fits(stratum))
    }
}

/// Scales the one hidden effect until its strength is near the target.
fn shrink(mut secret: Secret, target: f64) -> Secret {
    for _ in 0..3 {
        let strength = secret.sizes.iter().fold(0.0_f64, |m, s| m.max(s.strength));
        if strength <= FAINT_STRENGTH {
            break;
        }
        let hidden = secret
            .hidden
            .iter()
            .map(|effect| Effect {
                law: effect.law.scaled(target / strength),
                ..*effect
            })
            .collect();
        secret = Secret::new(&secret.setup, secret.known, hidden);
    }
    secret
}

/// Runs the plant.
pub(crate) fn simulate(setup: &Setup, known: &[Law], hidden: &[Effect], fine_steps: usize) -> Run {
    match &setup.kind {
        Kind::Axis(drive) => axis::run(setup, drive, known, hidden, fine_steps),
        Kind::Bench(_) => bench::run(setup, known, hidden, fine_steps),
    }
}

/// What the sensors make of the run.
fn record(secret: &Secret, draw: &mut Draw) -> Trace {
    let Secret { setup, run, .. } = secret;
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
