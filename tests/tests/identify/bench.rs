//! This file is a bench of its own: it records the brakes of tables 3.1 to 3.3, read from their CSV transcription, with
//! the scatter that §3.4 reports. It shares nothing with the model or with what identifies.

use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;
use rigproof_trace::rig::Rig;
use rigproof_trace::{Channel, Trace};

/// Standard deviation of a settled torque at 1 A, N·m (§3.4.1: grows with the current, to about 0.4).
const SCATTER_NM: f64 = 0.4;
/// Noise of the torquemeter, N·m; the text gives none.
const NOISE_NM: f64 = 0.005;
const SAMPLE_S: f64 = 0.001;
/// One count of the encoder behind the gear, degrees (§3.2).
const COUNT_DEG: f64 = 360.0 / 102_400.0;

/// The numbers of one brake, as printed.
#[derive(Clone, Debug)]
pub struct Printed {
    pub brake: String,
    pub width_deg: f64,
    /// k1 … k5 and R².
    pub gain: Vec<f64>,
    /// a_avg, a1 … a6 and R², rising and falling.
    pub times: [Vec<f64>; 2],
}

/// The four brakes of the thesis.
pub fn printed() -> Vec<Printed> {
    let table = |name: &str| -> Vec<Vec<String>> {
        let path = format!(
            "{}/../spec/thesis/tables/{name}.csv",
            env!("CARGO_MANIFEST_DIR")
        );
        let mut reader = csv::Reader::from_path(path).unwrap();
        let rows = reader.records().map(|row| row.unwrap());
        rows.map(|row| row.iter().map(str::to_owned).collect())
            .collect()
    };
    let numbers = |row: &[String]| -> Vec<f64> { row.iter().map(|c| c.parse().unwrap()).collect() };
    let widths = table("3.1");
    let (gains, times) = (table("3.2"), table("3.3"));
    let brakes = widths.iter().map(|row| {
        let of = |rows: &[Vec<String>], edge: &str, words: usize| {
            let row = rows
                .iter()
                .find(|r| r[words - 1] == row[0] && (words == 1 || r[0] == edge));
            numbers(&row.unwrap()[words..])
        };
        Printed {
            brake: row[0].clone(),
            width_deg: row[1].parse().unwrap(),
            gain: of(&gains, "", 1),
            times: [of(&times, "rising", 2), of(&times, "falling", 2)],
        }
    });
    brakes.collect()
}

impl Printed {
    pub fn torque(&self, i: f64) -> f64 {
        let k = &self.gain;
        if i < 0.2 {
            k[0] * i + k[1]
        } else {
            k[2] * i * i + k[3] * i + k[4]
        }
    }

    /// Time constant of the rising (0) or falling (1) edge, s.
    pub fn time(&self, edge: usize, i: f64, rpm: f64) -> f64 {
        let t = &self.times[edge];
        if rpm >= [4.0, 2.0][edge] {
            return t[0];
        }
        let (i, l) = (i.clamp(0.2, 1.0), libm::log2(rpm.max(0.5)));
        t[1] * i + t[2] * l + t[3] * i * l + t[4] * l * l + t[5] * i * l * l + t[6]
    }

    /// The scatter, in proportion, that gives the surface the R² of table 3.3 over the currents and low speeds tested.
    fn time_scatter(&self, edge: usize) -> f64 {
        let speeds: &[f64] = [&[0.5, 1.0, 2.0, 4.0][..], &[0.5, 1.0, 2.0]][edge];
        let mut values = Vec::new();
        for i in [0.2, 0.4, 0.6, 0.8, 1.0] {
            values.extend(speeds.iter().map(|rpm| self.time(edge, i, *rpm)));
        }
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let about: f64 = values.iter().map(|a| (a - mean) * (a - mean)).sum();
        let square: f64 = values.iter().map(|a| a * a).sum();
        let left = 1.0 - self.times[edge][7];
        libm::sqrt(left / (1.0 - left) * about / square)
    }
}

/// What a session on the bench records.
pub struct Session<'a> {
    brake: &'a Printed,
    random: Pcg64Mcg,
    current: Vec<f64>,
    position_deg: Vec<f64>,
    torque: Vec<f64>,
}

pub const SPEEDS_RPM: [f64; 8] = [0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0];

impl<'a> Session<'a> {
    pub fn new(brake: &'a Printed, seed: u64) -> Session<'a> {
        let stream = brake.brake.bytes().next().unwrap();
        Session {
            brake,
            random: Pcg64Mcg::seed_from_u64(1000 * seed + u64::from(stream)),
            current: Vec::new(),
            position_deg: Vec::new(),
            torque: Vec::new(),
        }
    }

    fn normal(&mut self) -> f64 {
        StandardNormal.sample(&mut self.random)
    }

    /// Three consecutive steps to each current and back, at one speed.
    pub fn steps(mut self, currents: &[f64], rpm: f64) -> Trace {
        let off = self.brake.torque(0.0);
        self.hold(0.0, rpm, off, off, 0.006, 0.3);
        let spread = [0, 1].map(|edge| self.brake.time_scatter(edge));
        for &i in currents {
            let of_set = spread.map(|s| libm::exp(s * self.normal() - 0.5 * s * s));
            let times = [0, 1].map(|edge| self.brake.time(edge, i, rpm) * of_set[edge]);
            for _ in 0..3 {
                let torque = self.brake.torque(i) + SCATTER_NM * i * self.normal();
                self.hold(i, rpm, off, torque, times[0], (14.0 * times[0]).max(0.17));
                self.hold(0.0, rpm, torque, off, times[1], (14.0 * times[1]).max(0.17));
            }
        }
        self.trace()
    }

    fn hold(&mut self, i: f64, rpm: f64, from: f64, to: f64, a: f64, duration: f64) {
        // The step falls somewhere between two samples.
        let late = 0.5 * SAMPLE_S * (1.0 + libm::tanh(self.normal()));
        for sample in 1..=(duration / SAMPLE_S) as u32 {
            let elapsed = SAMPLE_S * f64::from(sample) - late;
            let torque = to + (from - to) * libm::exp(-elapsed / a);
            let travelled = 6.0 * rpm * SAMPLE_S * (1.0 + self.current.len() as f64);
            self.record(i, travelled, torque);
        }
    }

    /// Sinusoidal speed of 10 rpm at a constant current, four periods.
    pub fn sinusoid(mut self, i: f64, hertz: f64) -> Trace {
        let (width, off) = (self.brake.width_deg, self.brake.torque(0.0));
        let torque = self.brake.torque(i) + SCATTER_NM * i * self.normal();
        let omega = 2.0 * core::f64::consts::PI * hertz;
        let (mut left, mut held) = (-width / 2.0, off);
        // The window is entered and left between two samples: 20 steps to one sample.
        let step_s = SAMPLE_S / 20.0;
        for step in 0..(4.0 / hertz / step_s) as u32 {
            let phase = omega * step_s * f64::from(step) + 0.7;
            let (angle, rpm) = (-60.0 / omega * libm::cos(phase), 10.0 * libm::sin(phase));
            // The window of the backlash is pushed along by the shaft.
            left = left.max(angle - width).min(angle);
            let engaged = angle <= left + 1e-12 || angle >= left + width - 1e-12;
            let target = if engaged { torque } else { off };
            let edge = usize::from(target < held);
            let a = self.brake.time(edge, i, rpm.abs());
            held = target + (held - target) * libm::exp(-step_s / a);
            if step.is_multiple_of(20) {
                self.record(i, angle, held * rpm.signum());
            }
        }
        self.trace()
    }

    fn record(&mut self, i: f64, angle_deg: f64, torque: f64) {
        let noise = NOISE_NM * self.normal();
        self.current.push(i);
        self.position_deg
            .push((angle_deg / COUNT_DEG).floor() * COUNT_DEG);
        self.torque.push(torque + noise);
    }

    fn trace(self) -> Trace {
        let channel = |name: &str, unit: &str, samples| Channel {
            name: name.to_owned(),
            unit: unit.to_owned(),
            samples,
        };
        let count = self.current.len();
        Trace {
            time_s: (0..count).map(|k| SAMPLE_S * k as f64).collect(),
            channels: vec![
                channel("angle", "deg", self.position_deg),
                channel("torque", "Nm", self.torque),
                channel("current", "A", self.current),
            ],
        }
    }
}

/// The rig that these recordings come from.
pub fn rig() -> Rig {
    let text = r#"name = "bench"
plant = "bench"
motion = "rotary"
[channels]
position = { channel = "angle", unit = "deg" }
torque = { channel = "torque", unit = "Nm" }
current = { channel = "current", unit = "A" }
"#;
    Rig::parse(text, std::path::Path::new("bench.toml")).unwrap()
}
