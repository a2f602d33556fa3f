//! This file is a damper under a command in volts that is shaken and metered, with one thing about it other than its description says.

use core::f64::consts::TAU;

use rigproof_diagnose::report::Report;

use super::recording::{Noise, Recording, counted};

const EXAMPLE: &str = include_str!("../../../rigs/damper.toml");
const STEP_S: f64 = 1e-3;
const COUNT: usize = 16_000;
const FULL_V: f64 = 5.0;
// The numbers that the example states.
/// The settled force without and with the full command, N.
const FORCES_N: [f64; 2] = [20.0, 200.0];
/// Rising and falling, s.
const FOLLOWS_S: [f64; 2] = [0.03, 0.06];
const DRAG_N_S_PER_M: f64 = 400.0;
const NOISE_N: f64 = 0.3;
/// Speed about which the force changes its sense, m/s: oil and seals give way a little.
const TURNS_M_S: f64 = 1e-4;

/// What is other than described.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hidden {
    Nothing,
    /// The force of the field, by a share.
    Gain(f64),
    /// The field grows with the square of the command, by a share: the linear part and this end at the same force.
    Square(f64),
    /// The falling time constant, times so much.
    Falling(f64),
    /// The amplifier answers late, s.
    Late(f64),
    /// Iron that remembers: a share of the command goes through a play of a half width, V.
    Remembers(f64, f64),
    /// More drag, N·s/m.
    Drag(f64),
    /// The force builds up over a travel after every reversal, m.
    Bends(f64),
}

impl Hidden {
    /// The settled force under a command, N.
    fn settled_n(self, command_v: f64) -> f64 {
        let [off_n, full_n] = FORCES_N;
        let share = command_v / FULL_V;
        let field = match self {
            Hidden::Square(part) => (1.0 - part) * share + part * share * share,
            _ => share,
        };
        let gain = match self {
            Hidden::Gain(fraction) => 1.0 + fraction,
            _ => 1.0,
        };
        gain * (off_n + (full_n - off_n) * field)
    }

    /// The command that acts at each sample, V.
    fn acting_v(self, commands_v: &[f64]) -> Vec<f64> {
        match self {
            Hidden::Late(delay_s) => {
                let late = libm::round(delay_s / STEP_S) as usize;
                let before = core::iter::repeat_n(commands_v[0], late);
                before.chain(commands_v.iter().copied()).collect()
            }
            Hidden::Remembers(half_v, share) => {
                let mut played_v = 0.0_f64;
                let each = commands_v.iter().map(|command_v| {
                    played_v = played_v.clamp(command_v - half_v, command_v + half_v);
                    command_v + share * (played_v - command_v)
                });
                each.collect()
            }
            _ => commands_v.to_vec(),
        }
    }
}

/// Random levels of the command, held or reached along a ramp, V.
fn commands_v(noise: &mut Noise) -> Vec<f64> {
    let mut all = vec![0.0];
    while all.len() < COUNT {
        let from_v = all[all.len() - 1];
        let [level, length, kind] = [(); 3].map(|()| noise.uniform());
        let to_v = FULL_V * (1.25 * level - 0.25).max(0.0);
        let steps = 300 + (900.0 * length) as usize;
        all.extend((1..=steps).map(|k| match kind < 0.5 {
            true => to_v,
            false => from_v + (to_v - from_v) * k as f64 / steps as f64,
        }));
    }
    all.truncate(COUNT);
    all
}

/// The recording of the example, whose description says nothing of the noise of its force.
pub fn recording(hidden: Hidden, seed: u64) -> Recording {
    let mut noise = Noise::new(seed);
    let commands_v = commands_v(&mut noise);
    let [rising_s, falling_s] = match hidden {
        Hidden::Falling(times) => [FOLLOWS_S[0], times * FOLLOWS_S[1]],
        _ => FOLLOWS_S,
    };
    let drag = match hidden {
        Hidden::Drag(more) => DRAG_N_S_PER_M + more,
        _ => DRAG_N_S_PER_M,
    };
    let acting_v = hidden.acting_v(&commands_v);
    let mut bent_m = 0.0;
    let mut force_n = hidden.settled_n(acting_v[0]);
    let (mut positions_m, mut forces_n) = (Vec::new(), Vec::new());
    for (k, acting_v) in acting_v.iter().take(COUNT).enumerate() {
        let waves = [(0.020, 0.9, 0.0), (0.007, 2.3, 1.0)].map(|(size, hz, phase)| {
            let angle = TAU * hz * k as f64 * STEP_S + phase;
            [size * libm::sin(angle), size * TAU * hz * libm::cos(angle)]
        });
        let [position_m, speed_m_s]: [f64; 2] =
            [0, 1].map(|of| waves.iter().map(|wave| wave[of]).sum());
        positions_m.push(position_m);
        let sense = match hidden {
            Hidden::Bends(travel_m) => {
                bent_m = (bent_m + STEP_S * speed_m_s).clamp(-travel_m, travel_m);
                bent_m / travel_m
            }
            _ => libm::tanh(speed_m_s / TURNS_M_S),
        };
        forces_n.push(force_n * sense + drag * speed_m_s);
        let settled_n = hidden.settled_n(*acting_v);
        let follows_s = if settled_n > force_n {
            rising_s
        } else {
            falling_s
        };
        force_n += (settled_n - force_n) * -libm::expm1(-STEP_S / follows_s);
    }
    // The example, as a brake of two points.
    let rig = [
        ("unit = \"mm\"", "unit = \"m\", quantum = 1e-6"),
        ("[0, 1, 2, 5]", "[0, 5]"),
        ("[20, 70, 110, 200]", "[20, 200]"),
    ]
    .into_iter()
    .fold(EXAMPLE.to_owned(), |rig, (from, to)| {
        assert!(rig.contains(from), "{from}");
        rig.replace(from, to)
    });
    let columns = vec![
        ("x", "m", counted(positions_m, 1e-6)),
        ("f", "N", noise.on(forces_n, NOISE_N)),
        ("u", "V", commands_v),
    ];
    Recording::new("damper".to_owned(), rig, STEP_S, columns)
}

/// A number of an effect that was named, and its unit.
pub fn number<'a>(report: &'a Report, mechanism: &str, parameter: &str) -> Option<(f64, &'a str)> {
    let effect = report
        .effects
        .iter()
        .find(|own| own.mechanism == mechanism)?;
    let number = effect.parameters.get(parameter)?;
    Some((number.value, &number.unit))
}
