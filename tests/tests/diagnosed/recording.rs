//! This file is a recording with the sensors' noise, written down, read again and diagnosed.

use core::f64::consts::TAU;
use std::fs;
use std::path::{Path, PathBuf};

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use rigproof_diagnose::Options;
use rigproof_diagnose::report::Report;
use rigproof_spec::joint::Joint;
use rigproof_trace::rig::Rig;
use rigproof_trace::rig::five_bar::{FiveBar, FiveBarRecording};
use rigproof_trace::{Channel, Trace, csv};

/// From one sample of a bench to the next, s.
pub const STEP_S: f64 = 1e-3;
/// Counts of the motor's encoder in a turn of the brake: 1024 through a gear of 100 to 1 (§3.2).
const COUNTS: f64 = 102_400.0;

/// What a brake did on the bench, a number a sample.
#[derive(Default)]
pub struct Turned {
    pub angles_rad: Vec<f64>,
    /// That acted until the sample.
    pub currents_a: Vec<f64>,
    pub torques_nm: Vec<f64>,
}

/// What a test makes and the diagnosis reads.
#[derive(Clone)]
pub struct Recording {
    /// Case, run, and who made it.
    pub name: String,
    /// The rig description.
    pub rig: String,
    pub trace: Trace,
}

impl Recording {
    /// A recording of columns of equal length, `step_s` between the samples.
    pub fn new(
        name: String,
        rig: String,
        step_s: f64,
        columns: Vec<(&str, &str, Vec<f64>)>,
    ) -> Recording {
        let count = columns[0].2.len();
        let channel = |(name, unit, samples): (&str, &str, Vec<f64>)| Channel {
            name: name.to_owned(),
            unit: unit.to_owned(),
            samples,
        };
        Recording {
            name,
            rig,
            trace: Trace {
                time_s: (0..count).map(|k| k as f64 * step_s).collect(),
                channels: columns.into_iter().map(channel).collect(),
            },
        }
    }

    /// The recording of a brake on the bench: counts, and a torquemeter with noise of a standard deviation, N·m.
    pub fn of_bench(
        name: String,
        joint: Joint,
        turned: Turned,
        mut noise: Noise,
        noise_nm: f64,
    ) -> Recording {
        let count_rad = TAU / COUNTS;
        let rig = format!(
            "name = \"{name}\"\nplant = \"bench\"\nmotion = \"rotary\"\n[channels]\n\
             position = {{ channel = \"angle\", unit = \"rad\", quantum = {count_rad:e} }}\n\
             torque = {{ channel = \"torque\", unit = \"N·m\", noise = {noise_nm} }}\n\
             current = {{ channel = \"current\", unit = \"A\" }}\n[brake]\njoint = \"{}\"\n[protocol]\ndrive = \"held\"\n",
            joint.letter()
        );
        // What is recorded is commanded, and acts from the sample on.
        let mut commanded_a = turned.currents_a;
        commanded_a.rotate_left(1);
        if let [.., before, last] = &mut commanded_a[..] {
            *last = *before;
        }
        let columns = vec![
            ("angle", "rad", counted(turned.angles_rad, count_rad)),
            ("current", "A", commanded_a),
            ("torque", "N·m", noise.on(turned.torques_nm, noise_nm)),
        ];
        Recording::new(name, rig, STEP_S, columns)
    }

    /// The report on the recording as it stands in its file.
    pub fn diagnosed(&self) -> Report {
        let desk = tempfile::tempdir().unwrap();
        let [recording, rig] = self.written(desk.path());
        let text = fs::read_to_string(&rig).unwrap();
        if FiveBar::describes(&text, &rig).unwrap() {
            return five_bar_reported(&rig, &[recording]);
        }
        let rig = Rig::read(&rig).unwrap();
        let recording = rig.read_recording(&recording).unwrap();
        rigproof_diagnose::diagnose(&rig, &[&recording], None, &options()).report
    }

    /// The files of the recording and of its rig description, in a folder unless another is asked for.
    fn written(&self, desk: &Path) -> [PathBuf; 2] {
        let folder = std::env::var("RIGPROOF_KEEP").map_or(desk.into(), PathBuf::from);
        fs::create_dir_all(&folder).unwrap();
        let [recording, rig] =
            ["csv", "toml"].map(|kind| folder.join(format!("{}.{kind}", self.name)));
        csv::write(&recording, &self.trace).unwrap();
        fs::write(&rig, &self.rig).unwrap();
        [recording, rig]
    }
}

/// One report on several recordings of a five-bar.
pub fn diagnosed_together(recordings: &[Recording]) -> Report {
    let desk = tempfile::tempdir().unwrap();
    let files = recordings.iter().map(|own| own.written(desk.path()));
    let (recordings, rigs): (Vec<PathBuf>, Vec<PathBuf>) = files.map(<(_, _)>::from).unzip();
    five_bar_reported(&rigs[0], &recordings)
}

fn five_bar_reported(rig: &Path, recordings: &[PathBuf]) -> Report {
    let rig = FiveBar::read(rig).unwrap();
    let recordings = recordings
        .iter()
        .map(|own| rig.read_recording(own).unwrap());
    let recordings: Vec<FiveBarRecording> = recordings.collect();
    let all: Vec<&FiveBarRecording> = recordings.iter().collect();
    rigproof_diagnose::diagnose(&rig, &all, None, &options()).report
}

/// The golden runs are short: most of each is needed. What is asserted is the search's, so that
/// nothing is fitted a second time.
fn options() -> Options {
    Options {
        hold_out_share: 0.05,
        refit: false,
        next_experiment: false,
        ..Options::default()
    }
}

/// What a sensor adds: close to Gaussian.
pub struct Noise(Pcg64Mcg);

impl Noise {
    pub fn new(seed: u64) -> Noise {
        Noise(Pcg64Mcg::seed_from_u64(seed))
    }

    /// Values with noise of a standard deviation.
    pub fn on(&mut self, values: impl IntoIterator<Item = f64>, deviation: f64) -> Vec<f64> {
        let values = values.into_iter();
        values
            .map(|value| value + deviation * self.draw())
            .collect()
    }

    /// From 0 to below 1, alike.
    pub fn uniform(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn draw(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }
}

/// Angles in whole counts, rad.
pub fn counted(angles_rad: impl IntoIterator<Item = f64>, count_rad: f64) -> Vec<f64> {
    let angles_rad = angles_rad.into_iter();
    angles_rad
        .map(|angle_rad| libm::round(angle_rad / count_rad) * count_rad)
        .collect()
}
