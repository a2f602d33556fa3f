//! This file makes of a five-bar's recording what its controller was told: encoder counts, force and sample numbers by the clock, faults included.

use core::f64::consts::TAU;

use rigproof_impl::encoder::{COUNTS_PER_TURN, MOST_COUNTS_PER_TURN};
use rigproof_impl::tick::{Sensed, Settings};
use rigproof_impl::vector::Vector;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::SAMPLE_STEP_S;
use rigproof_trace::rig::Signal;
use rigproof_trace::rig::five_bar::FiveBarRecording;

/// Beside which share of the thesis's interval a recording's own median counts as that interval: clocks of recorders run fast or slow by less.
const SAME_RATE: f64 = 0.01;
/// How far from a whole count an angle may lie, counts: beyond it was not written from counts of this resolution.
const ON_A_COUNT: f64 = 0.25;

/// A recording as its controller was told it.
#[derive(Clone, Debug, PartialEq)]
pub struct Taken {
    /// What the controller is told of the rig: resolution and interval are the recording's.
    pub settings: Settings,
    /// Time stamps, s.
    pub time_s: Vec<f64>,
    /// What was told.
    pub told: Vec<Sensed<f64>>,
    /// Whether a sensor or the clock failed in a sample.
    pub is_faulty: Vec<bool>,
    /// The currents that were commanded when it was recorded, A; no number where none was written.
    pub recorded_a: Vec<[f64; 4]>,
    /// Rows without an angle: samples that never came.
    pub lost: usize,
    /// Angles that lie between two counts.
    pub between_counts: usize,
}

impl Taken {
    /// What a rig of this layout was told.
    ///
    /// # Errors
    /// The resolution is none of an encoder, or too little is left.
    pub fn of(layout: Layout, recording: &FiveBarRecording) -> Result<Taken, String> {
        let [theta_a, theta_b] = &recording.theta;
        let counts_per_turn = [resolution(theta_a)?, resolution(theta_b)?];
        let samples_of = |signal: &Signal, k: usize| signal.samples.get(k).copied();
        let number = |signal: &Signal, k: usize| samples_of(signal, k).unwrap_or(f64::NAN);
        let mut taken = Taken {
            settings: Settings {
                counts_per_turn,
                sample_s: interval_s(&recording.time_s),
                ..Settings::thesis(layout)
            },
            time_s: Vec::new(),
            told: Vec::new(),
            is_faulty: Vec::new(),
            recorded_a: Vec::new(),
            lost: 0,
            between_counts: 0,
        };
        let (mut last_s, mut next) = (None, 0_u32);
        for (k, &time_s) in recording.time_s.iter().enumerate() {
            // By the clock: a gap is samples that never came, a stamp that stands still a sample that is told again.
            if let Some(last_s) = last_s.replace(time_s) {
                let steps = libm::round((time_s - last_s) / taken.settings.sample_s);
                next = next.wrapping_add(steps as u32);
            }
            let angles_rad = [number(theta_a, k), number(theta_b, k)];
            if angles_rad.into_iter().any(f64::is_nan) {
                taken.lost += 1;
                continue;
            }
            let counts = taken.counts(angles_rad);
            let [x, y] = recording.force.each_ref().map(|force| number(force, k));
            taken.time_s.push(time_s);
            taken.told.push(Sensed {
                number: next,
                counts,
                tip_force_n: Vector::new(x, y),
            });
            let currents = recording.currents.each_ref();
            let current = |own: Option<&Signal>| own.map_or(0.0, |own| number(own, k));
            taken
                .recorded_a
                .push(currents.map(|own| current(own.as_ref())));
        }
        if taken.told.len() < 2 {
            return Err(format!(
                "{} samples have both angles, at least 2 are needed",
                taken.told.len()
            ));
        }
        taken.is_faulty = faulty(&taken.settings, &taken.told);
        Ok(taken)
    }

    /// The counts that angles, rad, were written from.
    fn counts(&mut self, angles_rad: [f64; 2]) -> [i32; 2] {
        let mut counts = [0; 2];
        let of = self.settings.counts_per_turn;
        let pairs = angles_rad.into_iter().zip(of);
        for (count, (angle_rad, per_turn)) in counts.iter_mut().zip(pairs) {
            let exact = angle_rad / TAU * f64::from(per_turn);
            let whole = libm::round(exact);
            self.between_counts += usize::from((exact - whole).abs() > ON_A_COUNT);
            // What is infinite becomes the greatest count, which no joint reaches.
            *count = whole as i32;
        }
        counts
    }

    /// Samples in which a sensor or the clock failed.
    pub fn faults(&self) -> usize {
        self.is_faulty
            .iter()
            .filter(|is_faulty| **is_faulty)
            .count()
    }
}

/// Counts a turn of the encoder that an angle was written from; the thesis's where the description does not say it.
fn resolution(theta: &Signal) -> Result<u32, String> {
    let Some(quantum_rad) = theta.quantum else {
        return Ok(COUNTS_PER_TURN);
    };
    let counts = libm::round(TAU / quantum_rad);
    match (1.0..=f64::from(MOST_COUNTS_PER_TURN)).contains(&counts) {
        true => Ok(counts as u32),
        false => Err(format!(
            "channel `{}` has a quantum of {quantum_rad} rad, which is {counts} counts a turn; an encoder has 1 to {MOST_COUNTS_PER_TURN}",
            theta.channel
        )),
    }
}

/// The time from one sample to the next, s: the thesis's, or the recording's median where that is another.
fn interval_s(time_s: &[f64]) -> f64 {
    let later = time_s.get(1..).unwrap_or_default();
    let mut steps: Vec<f64> = time_s.iter().zip(later).map(|(a, b)| b - a).collect();
    steps.sort_unstable_by(f64::total_cmp);
    match steps.get(steps.len() / 2) {
        Some(own) if *own > 0.0 && (own / SAMPLE_STEP_S - 1.0).abs() > SAME_RATE => *own,
        _ => SAMPLE_STEP_S,
    }
}

/// In which samples a sensor or the clock failed (decision 0074): a number that is not the next one, a force that no sensor gives, counts further from where
/// a joint was last believed than it can turn in one sample.
fn faulty(settings: &Settings, told: &[Sensed<f64>]) -> Vec<bool> {
    let most = settings.counts_per_turn.map(|per_turn| {
        let turns = settings.greatest_rate_rad_s * settings.sample_s / TAU;
        libm::ceil(turns * f64::from(per_turn))
    });
    let mut last: Option<u32> = None;
    let mut believed: Option<[i32; 2]> = None;
    let mut faulty = Vec::with_capacity(told.len());
    for sensed in told {
        let is_next = last.is_none_or(|last| sensed.number == last.wrapping_add(1));
        let is_repeated = last == Some(sensed.number);
        let force_n: [f64; 2] = sensed.tip_force_n.into();
        let is_force = force_n
            .into_iter()
            .all(|n| n.is_finite() && n.abs() <= settings.greatest_force_n);
        let from = believed.unwrap_or(sensed.counts);
        let pairs = sensed.counts.into_iter().zip(from);
        let limits = most.into_iter().zip(settings.counts_per_turn);
        let can_be = pairs.zip(limits).all(|((now, from), (most, per_turn))| {
            f64::from(now.abs_diff(from)) <= most && now.unsigned_abs() <= per_turn
        });
        // A sample that is told again says nothing new of the joints.
        if can_be && !is_repeated {
            believed = Some(sensed.counts);
        }
        last = Some(sensed.number);
        faulty.push(!is_next || !is_force || !can_be);
    }
    faulty
}

#[cfg(test)]
mod tests {
    use rigproof_spec::units::Dimension;

    use super::*;

    fn signal(samples: Vec<f64>, quantum: Option<f64>) -> Signal {
        Signal {
            channel: "x".to_owned(),
            dimension: Dimension::ANGLE,
            samples,
            quantum,
            noise: None,
            limit: None,
        }
    }

    fn recording(time_s: &[f64], counts_a: &[f64], force_x: &[f64]) -> FiveBarRecording {
        let quantum = TAU / 20_000.0;
        let all = |value: f64| vec![value; time_s.len()];
        let angles = counts_a.iter().map(|count| count * quantum).collect();
        FiveBarRecording {
            time_s: time_s.to_vec(),
            theta: [
                signal(angles, Some(quantum)),
                signal(all(1234.0 * quantum), Some(quantum)),
            ],
            force: [signal(force_x.to_vec(), None), signal(all(-1.7), None)],
            currents: [0.1, 0.2, 0.3, 0.4].map(|a| Some(signal(all(a), None))),
        }
    }

    #[test]
    fn counts_forces_and_numbers_are_those_that_were_told() {
        let nan = f64::NAN;
        // A sample that never came, a stamp that stands still, a row without an angle, a force that is no number, a count that jumped and came back.
        let time_s = [0.0, 0.001, 0.004, 0.004, 0.005, 0.006, 0.007, 0.008, 0.009];
        let counts = [
            7013.0, 7014.0, 7017.0, 7017.0, nan, 7019.0, 7020.0, 9023.0, 7021.0,
        ];
        let force = [2.3, 2.2, 2.1, 2.0, 1.9, nan, 1.7, 1.6, 1.5];
        let taken = Taken::of(Layout::FourBrake, &recording(&time_s, &counts, &force)).unwrap();
        let numbers: Vec<u32> = taken.told.iter().map(|own| own.number).collect();
        assert_eq!(numbers, [0, 1, 4, 4, 6, 7, 8, 9]);
        let of_a: Vec<i32> = taken.told.iter().map(|own| own.counts[0]).collect();
        assert_eq!(of_a, [7013, 7014, 7017, 7017, 7019, 7020, 9023, 7021]);
        assert!(taken.told.iter().all(|own| own.counts[1] == 1234));
        assert_eq!(
            taken.is_faulty,
            [false, false, true, true, true, false, true, false]
        );
        assert!(taken.told[4].tip_force_n.x.is_nan());
        assert_eq!((taken.lost, taken.between_counts), (1, 0));
        assert_eq!(taken.settings.counts_per_turn, [20_000; 2]);
        assert_eq!(taken.recorded_a[0], [0.1, 0.2, 0.3, 0.4]);
    }

    #[test]
    fn a_slower_recording_has_its_own_interval_and_angles_between_counts_are_counted() {
        let time_s: Vec<f64> = (0..9).map(|k| 0.002 * f64::from(k)).collect();
        let counts: Vec<f64> = (0..9).map(|k| 7013.4 + f64::from(k)).collect();
        let taken = Taken::of(Layout::ThreeBrake, &recording(&time_s, &counts, &[0.0; 9])).unwrap();
        assert!((taken.settings.sample_s - 0.002).abs() < 1e-12);
        assert_eq!(taken.between_counts, 9);
        assert_eq!(taken.faults(), 0);
        let few = recording(&[0.0], &[1.0], &[0.0]);
        assert!(Taken::of(Layout::FourBrake, &few).is_err());
        let mut coarse = recording(&time_s, &counts, &[0.0; 9]);
        coarse.theta[0].quantum = Some(40.0);
        assert!(
            Taken::of(Layout::FourBrake, &coarse)
                .unwrap_err()
                .contains("0 counts")
        );
    }
}
