//! This file makes a case on any plant: draws until the hidden effects have the size their stratum asks for, records, and seals the answer.

use crate::answer::{Answer, HiddenEffect};
use crate::effect::Effect;
use crate::error::Error;
use crate::fault::{self, Spoilt};
use crate::forms::Forms;
use crate::lab::{Drawn, Lab, Secret};
use crate::plant::Plant;
use crate::plants::{self, five_bar};
use crate::seal;
use crate::size::FAINT_STRENGTH;
use crate::stratum::Stratum;
use rigproof_trace::Trace;

/// Fine steps to a sample.
pub(crate) const FINE_STEPS: usize = 20;
/// Draws that are tried.
pub(crate) const ATTEMPTS: usize = 24;

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

/// Makes the case of a seed; `None` lets the seed draw the stratum.
///
/// # Errors
/// [`Error::NoCase`] when no draw of the seed meets the stratum's rule of size; [`Error::OtherPlant`] when the plant has no such
/// stratum.
pub fn make(plant: Plant, seed: u64, stratum: Option<Stratum>) -> Result<Case, Error> {
    make_in(Forms::Usual, plant, seed, stratum)
}

/// Makes the case of a seed with physics in a family of forms.
///
/// # Errors
/// Those of [`make`].
pub fn make_in(
    forms: Forms,
    plant: Plant,
    seed: u64,
    stratum: Option<Stratum>,
) -> Result<Case, Error> {
    // An arm has one family.
    let forms = if plant == Plant::Chain {
        Forms::Other
    } else {
        forms
    };
    let stratum = stratum.unwrap_or_else(|| Stratum::of_seed_in(forms, plant, seed));
    if stratum.of_twenty_in(forms, plant) == 0 {
        return Err(Error::OtherPlant {
            stratum: stratum.name(),
            plant: plant.name(),
        });
    }
    plants::make(forms, plant, seed, stratum)
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

/// The recording of a seed's data fault as it was before it was spoilt: the same machine, the same noise.
///
/// # Errors
/// Those of [`make`].
pub fn unspoilt(plant: Plant, seed: u64) -> Result<Case, Error> {
    plants::unspoilt(plant, seed)
}

/// The case of a data fault without the fault.
pub(crate) fn clean<L: Lab>(lab: &L, seed: u64) -> Result<Case, Error> {
    let secret = secret(lab, seed, Stratum::DataFault)?;
    let trace = lab.record(&secret, &mut lab.numbers(seed, "sensors"));
    sealed(lab, seed, Stratum::Nothing, &secret, trace, None)
}

/// The case of a seed and a stratum.
pub(crate) fn case<L: Lab>(lab: &L, seed: u64, stratum: Stratum) -> Result<Case, Error> {
    let secret = secret(lab, seed, stratum)?;
    let mut trace = lab.record(&secret, &mut lab.numbers(seed, "sensors"));
    let spoilt = (stratum == Stratum::DataFault).then(|| {
        let mut draw = lab.numbers(seed, "fault");
        let names = lab.channels(&mut draw);
        fault::spoil(names, &mut trace, &mut draw)
    });
    sealed(lab, seed, stratum, &secret, trace, spoilt)
}

/// A recording with its description and its sealed answer.
pub(crate) fn sealed<L: Lab>(
    lab: &L,
    seed: u64,
    stratum: Stratum,
    secret: &Secret<L::Setup, L::Run>,
    trace: Trace,
    spoilt: Option<Spoilt>,
) -> Result<Case, Error> {
    let Secret { drawn, sizes, .. } = secret;
    let effects = drawn.hidden.iter().zip(&sizes.sizes).map(|(effect, size)| {
        let told = lab.told(&drawn.setup, effect);
        let twins = lab.twins(drawn, effect);
        let told = HiddenEffect::new(&told, *size, lab.motion(&drawn.setup), twins);
        match lab.forms() {
            Forms::Usual => told,
            Forms::Other => told.named(effect),
        }
    });
    let answer = Answer {
        seed,
        plant: lab.plant(),
        forms: lab.forms(),
        stratum,
        effects: effects.collect(),
        fault: spoilt.as_ref().map(|own| own.fault.clone()),
        spoilt,
        block_noise: sizes.block_noise,
        residual_ratio: sizes.ratio.filter(|_| lab.forms() == Forms::Other),
    };
    let (sealed, commitment) = seal::seal(&answer)?;
    Ok(Case {
        trace,
        rig_toml: lab.describe(seed, drawn),
        sealed,
        commitment,
    })
}

/// Draws until the rule of size is met.
pub(crate) fn secret<L: Lab>(
    lab: &L,
    seed: u64,
    stratum: Stratum,
) -> Result<Secret<L::Setup, L::Run>, Error> {
    let mut draw = lab.numbers(seed, stratum.name());
    for _ in 0..ATTEMPTS {
        let drawn = lab.draw(seed, stratum, &mut draw);
        let Some(mut tried) = drawn.and_then(|drawn| lab.tried(drawn)) else {
            continue;
        };
        if stratum == Stratum::TooSmall {
            match shrunk(lab, tried, draw.uniform(0.2, 0.7)) {
                Some(smaller) => tried = smaller,
                None => continue,
            }
        }
        if tried.sizes.fit(lab.forms(), stratum) {
            return Ok(tried);
        }
    }
    Err(no_case(lab.plant(), seed, stratum))
}

pub(crate) fn no_case(plant: Plant, seed: u64, stratum: Stratum) -> Error {
    Error::NoCase {
        seed,
        plant: plant.name(),
        stratum: stratum.name(),
        attempts: ATTEMPTS,
    }
}

/// The same case with its effect scaled until its strength is near the target.
fn shrunk<L: Lab>(
    lab: &L,
    mut secret: Secret<L::Setup, L::Run>,
    target: f64,
) -> Option<Secret<L::Setup, L::Run>> {
    for _ in 0..3 {
        let strengths = secret.sizes.sizes.iter().map(|size| size.strength);
        let strength = strengths.fold(0.0, f64::max);
        if strength <= FAINT_STRENGTH {
            break;
        }
        let scaled = |effect: &Effect| effect.scaled(target / strength);
        let hidden = secret.drawn.hidden.iter().map(scaled).collect();
        secret = lab.tried(Drawn {
            hidden,
            ..secret.drawn
        })?;
    }
    Some(secret)
}
