//! This file makes sound recordings of an axis, a bench and a five-bar, to be spoilt.

use rigproof_blind::{Plant, unspoilt};
use rigproof_diagnose::report::Report;
use rigproof_diagnose::{Description, Options};
use rigproof_trace::{Channel, Trace};
use std::path::Path;

/// A recording with its description.
#[derive(Clone)]
pub struct Made {
    pub trace: Trace,
    pub rig: String,
}

impl Made {
    /// The same with the samples of a channel changed.
    pub fn with(mut self, name: &str, change: impl FnOnce(&mut Vec<f64>)) -> Made {
        let mut channels = self.trace.channels.iter_mut();
        change(&mut channels.find(|own| own.name == name).unwrap().samples);
        self
    }

    /// The same with every channel changed.
    pub fn with_all(mut self, change: impl Fn(&mut Vec<f64>)) -> Made {
        self.trace
            .channels
            .iter_mut()
            .for_each(|own| change(&mut own.samples));
        self
    }

    /// The same with its time stamps changed.
    pub fn at(mut self, change: impl FnOnce(&mut Vec<f64>)) -> Made {
        change(&mut self.trace.time_s);
        self
    }

    /// The same with something else in its description.
    pub fn described(mut self, from: &str, to: &str) -> Made {
        assert!(self.rig.contains(from), "{}", self.rig);
        self.rig = self.rig.replace(from, to);
        self
    }

    pub fn samples(&self, name: &str) -> &[f64] {
        &self.trace.channel(name).unwrap().samples
    }
}

/// The report on a recording.
pub fn diagnosed(made: &Made) -> Report {
    let rig = Description::parse(&made.rig, Path::new("rig.toml")).unwrap();
    let recording = rig.apply(&made.trace, Path::new("recording.csv")).unwrap();
    let options = Options {
        refit: false,
        next_experiment: false,
        hold_out_share: 0.0,
        ..Options::default()
    };
    rig.diagnose(&[recording], None, &options).unwrap().report
}

/// Samples a second.
pub const RATE_HZ: f64 = 1000.0;
const COUNT: usize = 8000;
const COUNTS_RAD: f64 = 2e-5;

/// Even noise of a standard deviation.
pub struct Noise(u64);

impl Noise {
    pub const fn new() -> Noise {
        Noise(0x9e37_79b9_7f4a_7c15)
    }

    pub fn draw(&mut self, deviation: f64) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let unit = (self.0 >> 11) as f64 / (1_u64 << 53) as f64;
        deviation * 12f64.sqrt() * (unit - 0.5)
    }
}

fn counted(x: f64) -> f64 {
    (x / COUNTS_RAD).round() * COUNTS_RAD
}

fn trace(columns: [(&str, &str, Vec<f64>); 2]) -> Trace {
    Trace {
        time_s: (0..COUNT).map(|k| k as f64 / RATE_HZ).collect(),
        channels: columns
            .into_iter()
            .map(|(name, unit, samples)| Channel {
                name: name.to_owned(),
                unit: unit.to_owned(),
                samples,
            })
            .collect(),
    }
}

/// An axis with dry friction and drag under a held command of a given course, V.
pub fn axis_under(command: impl Fn(f64) -> f64) -> Made {
    const FINE: usize = 20;
    let (inertia, drag, dry, gain) = (0.012, 0.05, 0.08, 0.4);
    let h = 1.0 / RATE_HZ / FINE as f64;
    let (mut q, mut v) = (0.31, 0.0_f64);
    let mut noise = Noise::new();
    let (mut position, mut shown) = (Vec::new(), Vec::new());
    for k in 0..COUNT {
        let u = command(k as f64 / RATE_HZ);
        position.push(counted(q));
        shown.push(u + noise.draw(1e-3));
        for _ in 0..FINE {
            let free = v + h * (gain * u - drag * v) / inertia;
            let held = h * dry / inertia;
            v = if free.abs() <= held {
                0.0
            } else {
                free - held.copysign(free)
            };
            q += h * v;
        }
    }
    let rig = "name = \"axis\"\nplant = \"axis\"\nmotion = \"rotary\"\n[channels]\n\
         position = { channel = \"angle\", unit = \"rad\", quantum = 2e-5 }\n\
         command = { channel = \"u\", unit = \"V\", noise = 1e-3 }\n[parameters]\n\
         inertia = { value = 0.012, unit = \"kg·m^2/rad\", status = \"known\" }\n\
         command_gain = { value = 0.4, unit = \"N·m/V\", status = \"known\" }\n[[effect]]\n\
         mechanism = \"viscous\"\n\
         coefficient = { value = 0.04, unit = \"N·m·s/rad\", status = \"unknown\" }\n[[effect]]\n\
         mechanism = \"dry_offset\"\nlevel = { value = 0.1, unit = \"N·m\", status = \"unknown\" }\n[protocol]\ndrive = \"held\"\n";
    Made {
        trace: trace([("angle", "rad", position), ("u", "V", shown)]),
        rig: rig.to_owned(),
    }
}

pub fn axis() -> Made {
    axis_under(|t| {
        1.1 * libm::sin(7.3 * t) + 0.7 * libm::sin(17.9 * t + 0.4) + 0.5 * libm::sin(2.3 * t)
    })
}

/// A shaft with dry friction and drag that a motor moves.
pub fn bench() -> Made {
    let mut noise = Noise::new();
    let sine = |rate: f64, phase: f64, t: f64| {
        (
            libm::sin(rate * t + phase),
            rate * libm::cos(rate * t + phase),
        )
    };
    let motion = |t: f64| {
        let (slow, slow_rate) = sine(1.7, 0.2, t);
        let (fast, fast_rate) = sine(6.1, 1.3, t);
        (
            1.9 + 0.9 * slow + 0.3 * fast,
            0.9 * slow_rate + 0.3 * fast_rate,
        )
    };
    let times = || (0..COUNT).map(|k| k as f64 / RATE_HZ);
    let torque = times().map(|t| {
        let (_, speed) = motion(t);
        0.05 * speed + 0.4 * speed.signum() + noise.draw(5e-3)
    });
    let torque: Vec<f64> = torque.collect();
    let rig = "name = \"bench\"\nplant = \"bench\"\nmotion = \"rotary\"\n[channels]\n\
         position = { channel = \"angle\", unit = \"rad\", quantum = 2e-5 }\n\
         force = { channel = \"torque\", unit = \"N·m\", noise = 5e-3 }\n[[effect]]\n\
         mechanism = \"viscous\"\n\
         coefficient = { value = 0.05, unit = \"N·m·s/rad\", status = \"unknown\" }\n[[effect]]\n\
         mechanism = \"dry_offset\"\nlevel = { value = 0.3, unit = \"N·m\", status = \"unknown\" }\n";
    Made {
        trace: trace([
            (
                "angle",
                "rad",
                times().map(|t| counted(motion(t).0)).collect(),
            ),
            ("torque", "N·m", torque),
        ]),
        rig: rig.to_owned(),
    }
}

/// The first eight seconds of a five-bar of another program.
pub fn five_bar() -> Made {
    let case = unspoilt(Plant::Rig, 20_003).unwrap();
    let mut trace = case.trace;
    trace.time_s.truncate(COUNT);
    trace
        .channels
        .iter_mut()
        .for_each(|own| own.samples.truncate(COUNT));
    Made {
        trace,
        rig: case.rig_toml,
    }
}
