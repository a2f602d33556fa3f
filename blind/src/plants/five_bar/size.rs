//! This file measures a hidden effect of the five-bar against what the recording's noise allows anybody to see.
//!
//! As on axis and bench (`crate::size`), with two equations of motion: averages over 80 ms, whitened by the covariance of an average.

use super::linkage::{Pair, plus};
use super::mass::Dynamics;
use super::residual::{Seen, seen};
use super::run::Sample;
use super::setup::{RATE_HZ, Setup};
use crate::effect::{At, Effect};
use crate::form::Form;
use crate::score::ONSET_S;
use crate::size::{BLOCK_S, Size, Sizes, measured, remainder};
use rigproof_spec::geometry::arms;
use rigproof_spec::inertia::inertia;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;

/// A generalised force at a sample, N·m.
type Force = dyn Fn(&Seen, &Sample) -> Pair;

/// What somebody could take for a hidden effect: a name with a joint, and its generalised force.
struct Imitation {
    name: &'static str,
    joint: Joint,
    force: Box<Force>,
}

/// Measures all effects of a run.
pub fn sizes(setup: &Setup, hidden: &[Effect], samples: &[Sample]) -> Sizes {
    let seen = seen(setup, hidden, samples);
    let length = (BLOCK_S * RATE_HZ) as usize;
    let blocks: Vec<Block> = seen
        .chunks_exact(length)
        .zip(samples.chunks_exact(length))
        .enumerate()
        .filter_map(|(place, (seen, samples))| Block::new(setup, place, seen, samples))
        .collect();
    let column =
        |force: &Force| -> Vec<f64> { blocks.iter().flat_map(|block| block.mean(force)).collect() };
    let forces: Vec<Vec<f64>> = (0..hidden.len())
        .map(|k| column(&move |seen, _| seen.hidden_nm.get(k).copied().unwrap_or_default()))
        .collect();
    let imitations = imitations(setup);
    let imitating: Vec<Vec<f64>> = imitations
        .iter()
        .map(|imitation| column(&imitation.force))
        .collect();
    let of = hidden
        .iter()
        .zip(&forces)
        .enumerate()
        .map(|(own, (effect, force))| {
            let columns: Vec<&[f64]> = imitations
                .iter()
                .zip(&imitating)
                .filter(|(imitation, _)| !is_own(setup, effect, imitation))
                .map(|(_, column)| column.as_slice())
                .collect();
            let size = measured(own, &forces, &[], &columns, 1.0);
            Size {
                onset_strength: onset_strength(effect, size.size, &blocks, force),
                ..size
            }
        });
    let count = blocks.len().max(1) as f64;
    let left = column(&|seen, _| {
        let rest = seen.hidden_nm.iter();
        rest.fold(seen.lacking_nm, |rest, force| plus(rest, -1.0, *force))
    });
    Sizes {
        left: (remainder(&left, &[]) / (2.0 * count)).sqrt(),
        sizes: of.collect(),
        block_noise: blocks.iter().map(|block| block.noise).sum::<f64>() / count,
        sliding: blocks.len() as f64 * length as f64 / samples.len().max(1) as f64,
        ratio: Some(
            (1.0 + remainder(&column(&|seen, _| seen.lacking_nm), &[]) / (2.0 * count)).sqrt(),
        ),
    }
}

/// The lesser of an effect's strengths just before and just after its onset. Before it, where its joint slides, it is taken to be of its own size.
fn onset_strength(effect: &Effect, size: f64, blocks: &[Block], force: &[f64]) -> Option<f64> {
    let onset_s = effect.onset_s?;
    let pairs = || blocks.iter().zip(force.chunks_exact(2));
    let within = |from_s: f64, block: &Block| (from_s..from_s + ONSET_S).contains(&block.middle_s);
    let before = pairs().filter(|(block, _)| within(onset_s - ONSET_S, block));
    let would_act = before.filter(|(block, _)| block.slides(effect.at)).count();
    let after = pairs().filter(|(block, _)| within(onset_s, block));
    let after: f64 = after.flat_map(|(_, force)| force).map(|x| x * x).sum();
    Some((size * (2.0 * would_act as f64).sqrt()).min(after.sqrt()))
}

/// 80 ms in which something slides for at least half of the time.
struct Block<'a> {
    /// The middle of it, s.
    middle_s: f64,
    seen: Vec<(&'a Seen, &'a Sample)>,
    /// Cholesky factor of the covariance of an average, N·m: l11, l21, l22.
    factor: [f64; 3],
    noise: f64,
}

impl<'a> Block<'a> {
    fn new(
        setup: &Setup,
        place: usize,
        seen: &'a [Option<Seen>],
        samples: &'a [Sample],
    ) -> Option<Block<'a>> {
        let all = seen.len();
        let seen: Vec<(&Seen, &Sample)> = seen
            .iter()
            .zip(samples)
            .filter_map(|(seen, sample)| Some((seen.as_ref()?, sample)))
            .collect();
        let (middle, _) = seen.get(seen.len() / 2)?;
        if 2 * seen.len() < all {
            return None;
        }
        let [s11, s12, s22] = covariance(setup, middle);
        let l11 = s11.sqrt();
        let l21 = s12 / l11;
        Some(Block {
            middle_s: (place as f64 + 0.5) * BLOCK_S,
            seen,
            factor: [l11, l21, (s22 - l21 * l21).sqrt()],
            noise: (0.5 * (s11 + s22)).sqrt(),
        })
    }

    /// Whether a joint slides for half of it; without a joint whether anything does.
    fn slides(&self, at: At) -> bool {
        let place = Joint::ALL.into_iter().position(|own| at == At::Joint(own));
        let slides = |seen: &Seen| {
            place.is_none_or(|place| seen.joint_rates.get(place).is_some_and(|rate| *rate != 0.0))
        };
        2 * self.seen.iter().filter(|(seen, _)| slides(seen)).count() >= self.seen.len()
    }

    /// The whitened average of what stuck joints do not take.
    fn mean(&self, force: &Force) -> Pair {
        let sum = self.seen.iter().fold([0.0; 2], |sum, (seen, sample)| {
            plus(sum, 1.0, seen.told(force(seen, sample)))
        });
        let [a, b] = sum.map(|x| x / self.seen.len() as f64);
        let [l11, l21, l22] = self.factor;
        let first = a / l11;
        [first, (b - l21 * first) / l22]
    }
}

/// Covariance of an 80 ms average of generalised forces, (N·m)²: angles with quantisation noise through the second derivative of a
/// fitted parabola and the mass matrix, and the noise of the force sensor through the Jacobian.
fn covariance(setup: &Setup, seen: &Seen) -> [f64; 3] {
    let arms = arms(setup.layout);
    let count = BLOCK_S * RATE_HZ;
    let angle = setup.quantum_rad() / 12_f64.sqrt();
    let acceleration = (720.0 / count).sqrt() * angle / (BLOCK_S * BLOCK_S);
    let [m11, m12, m22] = Dynamics::new(&arms, &inertia(setup.layout), &seen.pose, [0.0; 2]).mass;
    let [xa, xb] = seen.pose.tip_force_along(&arms, [1.0, 0.0]);
    let [ya, yb] = seen.pose.tip_force_along(&arms, [0.0, 1.0]);
    let (a2, f2) = (
        acceleration * acceleration,
        setup.force_noise_n * setup.force_noise_n / count,
    );
    [
        a2 * (m11 * m11 + m12 * m12) + f2 * (xa * xa + ya * ya),
        a2 * m12 * (m11 + m22) + f2 * (xa * xb + ya * yb),
        a2 * (m12 * m12 + m22 * m22) + f2 * (xb * xb + yb * yb),
    ]
}

/// Dry friction, damping and gain at every joint, and a constant along θA and θB.
fn imitations(setup: &Setup) -> Vec<Imitation> {
    let mut all = Vec::new();
    for (k, joint) in Joint::ALL.into_iter().enumerate() {
        let braked = setup.layout.brakes().contains(&joint);
        let mut push = |name, torque: fn(f64, f64) -> f64| {
            all.push(Imitation {
                name,
                joint,
                force: Box::new(move |seen: &Seen, sample: &Sample| {
                    let rate = seen.joint_rates.get(k).copied().unwrap_or_default();
                    let row = seen.pose.rows.get(k).copied().unwrap_or_default();
                    let yield_nm = sample.nominal_yields_nm.get(k).copied().unwrap_or_default();
                    row.map(|x| x * torque(rate, yield_nm))
                }),
            });
        };
        push("dry_offset", |rate, _| sign(rate));
        push("viscous", |rate, _| rate);
        if braked {
            push("gain_error", |rate, yield_nm| sign(rate) * yield_nm);
        }
    }
    for (joint, force) in [(Joint::A, [1.0, 0.0]), (Joint::B, [0.0, 1.0])] {
        let force: Box<Force> = Box::new(move |_, _| force);
        all.push(Imitation {
            name: "constant_bias",
            joint,
            force,
        });
    }
    all
}

fn sign(rate: f64) -> f64 {
    if rate == 0.0 { 0.0 } else { rate.signum() }
}

/// Whether an imitation is the effect itself, or the same physics under another name.
fn is_own(setup: &Setup, effect: &Effect, imitation: &Imitation) -> bool {
    let either = |at: At| at == At::Joint(Joint::E) || at == At::Joint(Joint::C);
    let at = At::Joint(imitation.joint);
    // E and C of the 3-brake layout turn alike.
    let twins = setup.layout == Layout::ThreeBrake && either(effect.at) && either(at);
    let here = effect.is_at(imitation.joint) || twins;
    match effect.form {
        Form::Bearing => here,
        // At one current for ever a gain is dry friction.
        Form::Gain | Form::Coulomb if setup.is_constant() => {
            here && matches!(imitation.name, "gain_error" | "dry_offset")
        }
        _ => here && effect.name() == imitation.name,
    }
}

#[cfg(test)]
mod tests {
    use super::super::Rig;
    use crate::forms::Forms;
    use crate::make::secret;
    use crate::stratum::Stratum;

    #[test]
    fn an_onset_tells_where_its_joint_moves_and_not_where_it_rests() {
        let strength = |seed| {
            let secret = secret(&Rig(Forms::Usual), seed, Stratum::LateOnset).unwrap();
            secret.sizes.sizes[0].onset_strength.unwrap()
        };
        // Friction at E that begins at 12.18 s, when the arms are held from 12.10 to 12.65 s; a bristle at A that begins in motion.
        assert_eq!(strength(8517), 0.0);
        assert!(strength(8493) > 100.0);
    }
}
