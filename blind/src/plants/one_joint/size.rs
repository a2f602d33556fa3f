//! This file measures the hidden effects of an axis or a bench in averages of 80 ms.

use super::run::Run;
use super::setup::{Kind, Setup};
use crate::effect::Effect;
use crate::form::Form;
use crate::forms::Forms;
use crate::lab::Drawn;
use crate::size::{BLOCK_S, Sizes, measured, remainder};

/// Standard deviation of the equivalent effort noise in an 80 ms average, N or N·m.
///
/// Axis: the acceleration fitted to N = 80 ms·rate positions of standard deviation quantum/√12 has the standard
/// deviation √(720/N)·σ/T² (parabola on an even grid), times the inertia; the command adds gain·σ/√N. Bench: σ/√N.
pub fn block_noise(setup: &Setup) -> f64 {
    let count = BLOCK_S * setup.rate_hz;
    match &setup.kind {
        Kind::Axis(drive) => {
            let position = setup.quantum / 12_f64.sqrt();
            let acceleration = (720.0 / count).sqrt() * position / (BLOCK_S * BLOCK_S);
            let command = drive.gain * setup.noise / count.sqrt();
            (drive.inertia * acceleration).hypot(command)
        }
        Kind::Bench(_) => setup.noise / count.sqrt(),
    }
}

/// The sizes of all hidden effects of a run.
pub fn sizes(drawn: &Drawn<Setup>, run: &Run) -> Sizes {
    let Drawn {
        setup,
        known,
        hidden,
    } = drawn;
    let noise = block_noise(setup);
    let blocks = Blocks::new(run, setup.rate_hz);
    let forces: Vec<Vec<f64>> = run.hidden.iter().map(|f| blocks.means(f)).collect();
    let simple: Vec<(&str, Vec<f64>)> = blocks.simple_laws(run);
    let columns = |is: &dyn Fn(&str) -> bool| -> Vec<&[f64]> {
        let chosen = simple.iter().filter(|(name, _)| is(name));
        chosen.map(|(_, column)| column.as_slice()).collect()
    };
    let is_open = |name: &str| !setup.known && known.iter().any(|law| law.name() == name);
    let nominal = columns(&is_open);
    let ratio = (setup.forms == Forms::Other).then(|| {
        let count = forces.first().map_or(0, Vec::len);
        let all: Vec<f64> = (0..count)
            .map(|k| forces.iter().filter_map(|force| force.get(k)).sum())
            .collect();
        let power = remainder(&all, &nominal) / count.max(1) as f64;
        (1.0 + power / (noise * noise)).sqrt()
    });
    let each = hidden.iter().enumerate().map(|(own, effect)| {
        let imitations = columns(&|name| !is_own(effect, name));
        measured(own, &forces, &nominal, &imitations, noise)
    });
    let moving = run.moving.iter().filter(|moving| **moving).count();
    Sizes {
        sizes: each.collect(),
        block_noise: noise,
        sliding: moving as f64 / run.moving.len().max(1) as f64,
        left: 0.0,
        ratio,
    }
}

/// Whether a simple law is the effect itself, or physically the same as it.
fn is_own(effect: &Effect, simple: &str) -> bool {
    effect.name() == simple || (effect.form == Form::Asymmetric && simple == "constant_bias")
}

/// The 80 ms averages of a run.
struct Blocks {
    length: usize,
    moving: Vec<bool>,
}

impl Blocks {
    fn new(run: &Run, rate_hz: f64) -> Blocks {
        Blocks {
            length: (BLOCK_S * rate_hz).round() as usize,
            moving: run.moving.clone(),
        }
    }

    /// Means over the sliding samples of each block that slides for at least half its time.
    fn means(&self, signal: &[f64]) -> Vec<f64> {
        signal
            .chunks_exact(self.length)
            .zip(self.moving.chunks_exact(self.length))
            .filter_map(|(values, moving)| {
                let sliding = moving.iter().filter(|m| **m).count();
                let sum: f64 = values
                    .iter()
                    .zip(moving)
                    .filter(|(_, moving)| **moving)
                    .map(|(value, _)| value)
                    .sum();
                (2 * sliding >= self.length).then(|| sum / sliding as f64)
            })
            .collect()
    }

    fn simple_laws(&self, run: &Run) -> Vec<(&'static str, Vec<f64>)> {
        let column = |of: fn(f64, f64) -> f64| {
            let values: Vec<f64> = run
                .position
                .iter()
                .zip(&run.velocity)
                .map(|(q, v)| of(*q, *v))
                .collect();
            self.means(&values)
        };
        vec![
            ("dry_offset", column(|_, v| v.signum())),
            ("viscous", column(|_, v| v)),
            ("constant_bias", column(|_, _| 1.0)),
            ("spring", column(|q, _| q)),
        ]
    }
}
