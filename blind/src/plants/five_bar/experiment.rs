//! This file records the rig of a seed a second time: with another hand, or as somebody's experiment asks.

use super::Rig;
use super::record::current_name;
use super::setup::Asked;
use crate::draw::Draw;
use crate::effect::Effect;
use crate::error::Error;
use crate::forms::Forms;
use crate::lab::{Drawn, Lab};
use crate::make::{ATTEMPTS, Case, no_case, sealed, secret};
use crate::plant::Plant;
use crate::stratum::Stratum;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_trace::Trace;

/// The rig whose seeds have second recordings.
const RIG: Rig = Rig(Forms::Usual);

/// Another recording of a seed's rig, with the same hidden effects on the same clock: another hand, other currents.
pub fn again(seed: u64, stratum: Stratum) -> Result<Trace, Error> {
    let first = secret(&RIG, seed, stratum)?;
    let mut draw = Draw::new(Plant::Rig, seed, "again");
    for _ in 0..ATTEMPTS {
        let setup = first.drawn.setup.again(stratum, &mut draw);
        let other = RIG.tried(Drawn {
            setup,
            ..first.drawn.clone()
        });
        if let Some(other) = other.filter(|other| other.sizes.moves()) {
            return Ok(RIG.record(&other, &mut draw));
        }
    }
    Err(no_case(Plant::Rig, seed, stratum))
}

/// An experiment on a seed's rig as a case of its own: the same hidden effects, what began in the first recording now from the start.
pub fn under(seed: u64, stratum: Stratum, experiment: &Trace) -> Result<Case, Error> {
    let first = secret(&RIG, seed, stratum)?;
    let mut draw = Draw::new(Plant::Rig, seed, "experiment");
    let Drawn { setup, hidden, .. } = first.drawn;
    let asked = asked(experiment, setup.layout)?;
    let setup = setup.under(asked, &mut draw);
    let begun = |effect: Effect| Effect {
        onset_s: None,
        ..effect
    };
    let drawn = Drawn {
        setup,
        known: Vec::new(),
        hidden: hidden.into_iter().map(begun).collect(),
    };
    let other = RIG.tried(drawn).ok_or(Error::Experiment(
        "it leads the arms out of their ranges (table 4.2)".to_owned(),
    ))?;
    let trace = RIG.record(&other, &mut draw);
    sealed(&RIG, seed, stratum, &other, trace, None)
}

/// What an experiment's file asks for: `hand_x` and `hand_y`, m, and the currents of the brakes, A.
fn asked(experiment: &Trace, layout: Layout) -> Result<Asked, Error> {
    let column = |name: &str| {
        let channel = experiment.channel(name);
        channel.map(|channel| channel.samples.clone())
    };
    let needed = |name: &str| {
        column(name).ok_or_else(|| Error::Experiment(format!("there is no column `{name}`")))
    };
    let [x, y] = [needed("hand_x")?, needed("hand_y")?];
    let (Some(first_s), Some(last_s)) = (experiment.time_s.first(), experiment.time_s.last())
    else {
        return Err(Error::Experiment("it is empty".to_owned()));
    };
    let step_s = (last_s - first_s) / x.len().saturating_sub(1).max(1) as f64;
    if step_s <= 0.0 || x.iter().chain(&y).any(|x| !x.is_finite()) {
        return Err(Error::Experiment(
            "it needs two samples or more, a clock that grows and a hand in each sample".to_owned(),
        ));
    }
    let current = |joint: Joint| {
        let braked = layout.brakes().contains(&joint);
        column(current_name(joint))
            .filter(|_| braked)
            .unwrap_or_default()
    };
    Ok(Asked {
        step_s,
        path_m: x.into_iter().zip(y).map(|(x, y)| [x, y]).collect(),
        currents_a: Joint::ALL.map(current),
    })
}
