//! This file asks what the nominal equation lacks along a recording, in averages of 80 ms, against what the noise of its sensors explains.
//!
//! Each average is weighted by a smooth bump. Summed by parts, the bump carries the derivatives, so that positions are never differentiated.

use super::run::{FINE_HZ, Run, run};
use super::setup::Setup;
use crate::effect::Effect;
use crate::size::{BLOCK_S, Size, Sizes, remainder};

/// The sizes of the hidden effects: each alone in the machine, and all of them together.
pub fn sizes(setup: &Setup, hidden: &[Effect], all: &Run) -> Sizes {
    let bump = Bump::new(setup);
    let alone = |effect: &Effect| match hidden {
        [_] => lacking(setup, &bump, all),
        _ => run(setup, &[*effect], FINE_HZ)
            .map_or_else(Lacking::default, |run| lacking(setup, &bump, &run)),
    };
    let noise = bump.noise;
    let each = hidden.iter().map(|effect| {
        let lacking = alone(effect);
        let size = lacking.size(noise, false);
        Size {
            size,
            distinctness: lacking.size(noise, true),
            strength: size * (lacking.rest.len() as f64).sqrt(),
            onset_strength: None,
        }
    });
    let together = lacking(setup, &bump, all);
    let moving = all.sense.iter().flatten().count();
    let total = together.size(noise, false);
    Sizes {
        sizes: each.collect(),
        block_noise: noise,
        sliding: moving as f64 / all.sense.len().max(1) as f64,
        // What an undisturbed machine leaves is tested to be less than a quarter of the noise.
        left: 0.0,
        ratio: Some((1.0 + total * total).sqrt()),
    }
}

/// The weights of an average and of its derivatives.
struct Bump {
    weight: Vec<f64>,
    /// Of the held command: half of it acts before its sample's middle and half behind.
    held: Vec<f64>,
    slope: Vec<f64>,
    bend: Vec<f64>,
    /// Standard deviation of an average of nothing but noise, N·m.
    noise: f64,
}

impl Bump {
    fn new(setup: &Setup) -> Bump {
        let count = (BLOCK_S * setup.rate_hz).round().max(8.0);
        let raw = |k: f64| {
            let x = (k + 1.0) / (count + 1.0);
            let hill = x * (1.0 - x);
            hill * hill * hill
        };
        let sum: f64 = (0..count as usize).map(|k| raw(k as f64)).sum();
        let length = count as usize;
        let at = |k: isize| match usize::try_from(k) {
            Ok(k) if k < length => raw(k as f64) / sum,
            _ => 0.0,
        };
        // One more on either side, where the derivatives of the bump are not zero.
        let all =
            |f: &dyn Fn(isize) -> f64| -> Vec<f64> { (-1..=length as isize).map(f).collect() };
        let rate = setup.rate_hz;
        let bend = all(&|k| (at(k + 1) - 2.0 * at(k) + at(k - 1)) * rate * rate);
        let held = all(&|k| 0.5 * (at(k) + at(k + 1)));
        let power = |weights: &[f64]| weights.iter().map(|w| w * w).sum::<f64>().sqrt();
        let position = setup.inertia * setup.quantum() / 12_f64.sqrt() * power(&bend);
        let command = setup.gain * setup.command_noise * power(&held);
        Bump {
            noise: position.hypot(command),
            weight: all(&at),
            slope: all(&|k| -0.5 * (at(k + 1) - at(k - 1)) * rate),
            held,
            bend,
        }
    }
}

/// What the nominal equation lacks in each average that slides, and what could take it.
#[derive(Default)]
struct Lacking {
    rest: Vec<f64>,
    /// Of the numbers that the description leaves open.
    open: Vec<Vec<f64>>,
    /// Of dry friction, damping, a constant and a spring.
    plain: Vec<Vec<f64>>,
}

impl Lacking {
    fn size(&self, noise: f64, beside_the_plain: bool) -> f64 {
        let plain = self.plain.iter().filter(|_| beside_the_plain);
        let columns: Vec<&[f64]> = self.open.iter().chain(plain).map(Vec::as_slice).collect();
        let count = self.rest.len().max(1) as f64;
        (remainder(&self.rest, &columns) / count).sqrt() / noise
    }
}

fn lacking(setup: &Setup, bump: &Bump, run: &Run) -> Lacking {
    let mut found = Lacking::default();
    let (mut bends, mut slopes, mut senses, mut ones, mut places) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let length = bump.weight.len();
    let windows = run
        .position
        .chunks_exact(length)
        .zip(run.command.chunks_exact(length));
    for ((q, u), senses_of) in windows.zip(run.sense.chunks_exact(length)) {
        let Some(moves) = senses_of.iter().copied().collect::<Option<Vec<[f64; 2]>>>() else {
            continue;
        };
        let sum = |weights: &[f64], of: &mut dyn FnMut(usize) -> f64| -> f64 {
            let each = weights.iter().enumerate();
            each.map(|(k, weight)| weight * of(k)).sum()
        };
        let of = |values: &[f64], k: usize| values.get(k).copied().unwrap_or_default();
        let bend = sum(&bump.bend, &mut |k| of(q, k));
        let slope = sum(&bump.slope, &mut |k| of(q, k));
        // A second difference weighs what acts by a ramp up to its sample and a ramp down behind it.
        let ramps = |k: usize| {
            let [_, falling] = moves.get(k).copied().unwrap_or_default();
            let before = k.checked_sub(1).and_then(|k| moves.get(k));
            falling + before.map_or(0.0, |[rising, _]| *rising)
        };
        let sense = sum(&bump.weight, &mut |k| ramps(k));
        let effort = setup.gain * sum(&bump.held, &mut |k| of(u, k));
        found
            .rest
            .push(effort - setup.inertia * bend - setup.viscous * slope - setup.dry * sense);
        bends.push(bend);
        slopes.push(slope);
        senses.push(sense);
        ones.push(1.0);
        places.push(sum(&bump.weight, &mut |k| of(q, k)));
    }
    let stated = setup.stated;
    if !stated.inertia {
        found.open.push(bends);
    }
    if stated.viscous == Some(false) {
        found.open.push(slopes.clone());
    }
    if stated.dry == Some(false) {
        found.open.push(senses.clone());
    }
    found.plain = vec![senses, slopes, ones, places];
    found
}
