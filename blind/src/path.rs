//! This file says how a lab moves a mechanism to excite it: a chain of movements that each begin and end at zero.

use crate::draw::Draw;
use std::f64::consts::TAU;

/// One movement. Lengths are fractions of the path's travel scale.
#[derive(Clone, Debug)]
enum Movement {
    /// A sine of constant amplitude.
    Sine { amplitude: f64, frequency_hz: f64 },
    /// A triangle with rounded corners: constant speed between reversals.
    Triangle { amplitude: f64, frequency_hz: f64 },
    /// A sine whose amplitude grows and falls again: a ramp of speed.
    SpeedRamp { amplitude: f64, frequency_hz: f64 },
    /// Sines of unrelated frequencies under a window.
    Multisine { lines: Vec<Line> },
    /// Out to the amplitude, rest, back and rest.
    Hold { amplitude: f64 },
}

#[derive(Clone, Copy, Debug)]
struct Line {
    amplitude: f64,
    frequency_hz: f64,
    phase: f64,
}

/// Position and velocity over time.
#[derive(Clone, Debug)]
pub struct Path {
    scale: f64,
    parts: Vec<(f64, Movement)>,
}

/// How the corners of a triangle are rounded; 1 would be sharp.
const CORNER: f64 = 0.99;

impl Path {
    /// A path of at least `duration_s` with every kind of movement, about `frequency_hz`, m or rad.
    ///
    /// Holds are left out on a bench: dry friction at rest is undetermined there.
    pub fn draw(
        draw: &mut Draw,
        scale: f64,
        frequency_hz: f64,
        duration_s: f64,
        holds: bool,
    ) -> Path {
        let mut kinds: Vec<usize> = if holds {
            vec![0, 1, 2, 3, 4, 5, 5]
        } else {
            vec![0, 1, 2, 3, 4]
        };
        let mut parts = Vec::new();
        let mut total_s = 0.0;
        while total_s < duration_s {
            if kinds.is_empty() {
                kinds = vec![0, 1, 2, 3];
            }
            let kind = kinds.swap_remove(draw.below(kinds.len()));
            let (length_s, movement) = movement(draw, kind, frequency_hz);
            total_s += length_s;
            parts.push((length_s, movement));
        }
        Path { scale, parts }
    }

    /// Position (m or rad) and velocity at a time; at rest at zero after the end.
    pub fn at(&self, time_s: f64) -> (f64, f64) {
        let mut local_s = time_s;
        for (length_s, movement) in &self.parts {
            if local_s < *length_s {
                let (position, velocity) = movement.at(local_s, *length_s);
                return (self.scale * position, self.scale * velocity);
            }
            local_s -= length_s;
        }
        (0.0, 0.0)
    }
}

fn movement(draw: &mut Draw, kind: usize, base_hz: f64) -> (f64, Movement) {
    let cycles =
        |frequency_hz: f64, seconds: f64| (seconds * frequency_hz).round().max(1.0) / frequency_hz;
    match kind {
        0 => {
            let frequency_hz = base_hz * draw.uniform(0.8, 1.2);
            let amplitude = draw.uniform(0.7, 1.0);
            (
                cycles(frequency_hz, 3.0),
                Movement::Sine {
                    amplitude,
                    frequency_hz,
                },
            )
        }
        1 => {
            let frequency_hz = base_hz * draw.uniform(1.0, 1.8);
            let amplitude = draw.uniform(0.15, 0.35);
            (
                cycles(frequency_hz, 2.0),
                Movement::Sine {
                    amplitude,
                    frequency_hz,
                },
            )
        }
        2 => {
            let frequency_hz = draw.uniform(0.12, 0.25);
            let amplitude = draw.uniform(0.6, 1.0);
            (
                cycles(frequency_hz, 5.0),
                Movement::Triangle {
                    amplitude,
                    frequency_hz,
                },
            )
        }
        3 => {
            let frequency_hz = base_hz * draw.uniform(0.7, 1.1);
            (
                cycles(frequency_hz, 4.0),
                Movement::SpeedRamp {
                    amplitude: draw.uniform(0.8, 1.1),
                    frequency_hz,
                },
            )
        }
        4 => {
            let lines = [0.23, 0.51, 0.83, 1.27, 1.71, 2.3].map(|ratio| Line {
                amplitude: 0.35 / (0.6 + ratio * ratio) * draw.uniform(0.8, 1.2),
                frequency_hz: base_hz * ratio * draw.uniform(0.92, 1.08),
                phase: draw.uniform(0.0, TAU),
            });
            (
                draw.uniform(4.0, 6.0),
                Movement::Multisine {
                    lines: lines.to_vec(),
                },
            )
        }
        _ => (
            draw.uniform(2.0, 3.2),
            Movement::Hold {
                amplitude: draw.sign() * draw.uniform(0.3, 0.8),
            },
        ),
    }
}

impl Movement {
    /// The windowed wave and its rate: every movement begins and ends at rest at zero.
    fn at(&self, time_s: f64, length_s: f64) -> (f64, f64) {
        let (wave, wave_rate) = self.wave(time_s, length_s);
        let (window, window_rate) = match self {
            Movement::SpeedRamp { .. } => bell(time_s, length_s),
            Movement::Hold { .. } => (1.0, 0.0),
            _ => flat_top(time_s, length_s),
        };
        (window * wave, window * wave_rate + window_rate * wave)
    }

    fn wave(&self, time_s: f64, length_s: f64) -> (f64, f64) {
        match self {
            Movement::Sine {
                amplitude,
                frequency_hz,
            }
            | Movement::SpeedRamp {
                amplitude,
                frequency_hz,
            } => {
                let omega = TAU * frequency_hz;
                let (s, c) = libm::sincos(omega * time_s);
                (amplitude * s, amplitude * omega * c)
            }
            Movement::Triangle {
                amplitude,
                frequency_hz,
            } => {
                let omega = TAU * frequency_hz;
                let (s, c) = libm::sincos(omega * time_s);
                let norm = amplitude / libm::asin(CORNER);
                let slope = CORNER * omega * c / (1.0 - CORNER * CORNER * s * s).sqrt();
                (norm * libm::asin(CORNER * s), norm * slope)
            }
            Movement::Multisine { lines } => {
                let (mut position, mut velocity) = (0.0, 0.0);
                for line in lines {
                    let omega = TAU * line.frequency_hz;
                    let (s, c) = libm::sincos(omega * time_s + line.phase);
                    position += line.amplitude * s;
                    velocity += line.amplitude * omega * c;
                }
                (position, velocity)
            }
            Movement::Hold { amplitude } => {
                let rise_s = 0.2 * length_s;
                let (out, out_rate) = smooth_step(time_s / rise_s);
                let (back, back_rate) = smooth_step((time_s - 0.6 * length_s) / rise_s);
                (
                    amplitude * (out - back),
                    amplitude * (out_rate - back_rate) / rise_s,
                )
            }
        }
    }
}

/// `sin²` over the whole length, with its rate.
fn bell(time_s: f64, length_s: f64) -> (f64, f64) {
    let rate = 0.5 * TAU / length_s;
    let (s, c) = libm::sincos(rate * time_s);
    (s * s, 2.0 * rate * s * c)
}

/// One between two smooth edges of 0.3 s, with its rate.
fn flat_top(time_s: f64, length_s: f64) -> (f64, f64) {
    const EDGE_S: f64 = 0.3;
    let (up, up_rate) = smooth_step(time_s / EDGE_S);
    let (down, down_rate) = smooth_step((length_s - time_s) / EDGE_S);
    (up * down, (up_rate * down - up * down_rate) / EDGE_S)
}

/// The quintic from 0 to 1 with zero rate and acceleration at both ends, and its rate.
fn smooth_step(x: f64) -> (f64, f64) {
    let x = x.clamp(0.0, 1.0);
    (
        x * x * x * (10.0 + x * (-15.0 + 6.0 * x)),
        30.0 * x * x * (1.0 - x) * (1.0 - x),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::Plant;

    #[test]
    fn velocity_is_the_rate_of_position_across_every_seam() {
        for seed in 0..6 {
            let mut draw = Draw::new(Plant::Axis, seed, "path");
            let path = Path::draw(&mut draw, 0.73, 0.9, 19.0, seed % 2 == 0);
            let step_s = 1e-5;
            let mut largest = 0.0_f64;
            for k in 1..1900 {
                let time_s = 0.01 * f64::from(k) + 3.3e-4;
                let (before, v) = path.at(time_s - step_s);
                let (after, w) = path.at(time_s + step_s);
                let mean = 0.5 * (v + w);
                let rate = (after - before) / (2.0 * step_s);
                assert!(
                    (rate - mean).abs() < 1e-4 * (1.0 + mean.abs()),
                    "{time_s} s"
                );
                largest = largest.max(after.abs());
            }
            assert!(largest > 0.3, "seed {seed} moves only {largest} rad");
        }
    }
}
