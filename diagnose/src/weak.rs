//! This file is the weak form: the equations of motion multiplied by compact test functions and
//! summed. Summation by parts moves the derivatives to the test function, so that positions are not
//! differentiated.

use crate::regression::dot;
use crate::rules::{BUMP_ORDER, MOST_DOUBT, MOST_STEP};
use rigproof_model::effects::Instant;

/// The test function and the windows it is applied to.
#[derive(Clone, Debug)]
pub struct Windows {
    /// Weights of the test function: sum 1, odd length.
    pub bump: Vec<f64>,
    /// Discrete second difference of `bump` over the squared step, two samples longer. Summation by
    /// parts is exact with it, and it sums to zero.
    pub curvature: Vec<f64>,
    /// Samples between window centres.
    pub hop: usize,
    /// Number of equations: each window gives as many rows, one after another.
    pub outputs: usize,
    /// Centre sample of each row.
    pub centres: Vec<usize>,
    /// Whether the row may be used: all its samples were recorded, and the direction of motion is
    /// known.
    pub usable: Vec<bool>,
    /// For a row that combines all equations: the index of its combination. The window's other rows
    /// are then unused.
    pub combined: Vec<Option<usize>>,
    /// Weights of the equations, sample by sample, one equation after another.
    pub combinations: Vec<Vec<f64>>,
    /// Sample interval, s.
    pub step_s: f64,
    /// Time of the run's first sample, s.
    pub start_s: f64,
}

impl Windows {
    /// Windows of about `width_s`, a quarter of a width apart, all usable.
    ///
    /// `clock` is the sample interval and the time of the first sample, s. The plant has `outputs`
    /// equations.
    pub fn over(samples: usize, outputs: usize, clock: (f64, f64), width_s: f64) -> Windows {
        let (step_s, start_s) = clock;
        let half = ((0.5 * width_s / step_s).round() as usize).max(2);
        let bump = bump(half);
        let margin = half + 1;
        let hop = (half / 2).max(1);
        let centres: Vec<usize> = (margin..samples.saturating_sub(margin))
            .step_by(hop)
            .flat_map(|centre| core::iter::repeat_n(centre, outputs))
            .collect();
        Windows {
            curvature: second_difference(&bump, step_s),
            bump,
            hop,
            outputs,
            usable: vec![true; centres.len()],
            combined: vec![None; centres.len()],
            combinations: Vec::new(),
            centres,
            step_s,
            start_s,
        }
    }

    /// Samples that stand alone, as the rows of a static sweep do: each is a window of its own.
    pub fn alone(samples: usize, (step_s, start_s): (f64, f64)) -> Windows {
        Windows {
            bump: vec![1.0],
            curvature: vec![0.0; 3],
            hop: 1,
            outputs: 1,
            centres: (0..samples).collect(),
            usable: vec![true; samples],
            combined: vec![None; samples],
            combinations: Vec::new(),
            step_s,
            start_s,
        }
    }

    /// So many windows that overlap by three quarters, or as many that stand alone.
    pub fn as_many_as(&self, overlapping: usize) -> usize {
        match self.are_alone() {
            true => overlapping.div_ceil(4),
            false => overlapping,
        }
    }

    /// Whether each window is a single sample.
    pub fn are_alone(&self) -> bool {
        self.bump.len() == 1
    }

    /// Marks rows as unusable whose window fails a rule. The rule takes the window's centre and its
    /// weights.
    pub fn keep(&mut self, rule: impl Fn(usize, &[f64]) -> bool) {
        for (usable, &centre) in self.usable.iter_mut().zip(&self.centres) {
            *usable = *usable && rule(centre, &self.bump);
        }
    }

    /// `Σ φ·signal`, one value per row. With several outputs, a signal holds the samples of one
    /// output after those of another.
    pub fn average(&self, signal: &[f64]) -> Vec<f64> {
        self.apply(&self.bump, signal, &self.combinations)
    }

    /// The same of a signal that is zero before `first`, where `whole` are the averages of that
    /// which is not: only windows over `first` are computed.
    pub fn average_late(&self, late: &[f64], whole: &[f64], first: usize) -> Vec<f64> {
        let outputs = self.outputs_of(late);
        let reach = self.bump.len() / 2;
        let mut sum = vec![0.0; self.bump.len()];
        let rows = self.centres.iter().zip(whole).enumerate();
        rows.map(|(row, (&centre, &whole))| {
            if centre + reach < first {
                0.0
            } else if centre - reach >= first {
                whole
            } else {
                self.applied(row, &self.bump, &outputs, &self.combinations, &mut sum)
            }
        })
        .collect()
    }

    /// The same for other combinations of the equations.
    pub fn average_with(&self, signal: &[f64], combinations: &[Vec<f64>]) -> Vec<f64> {
        self.apply(&self.bump, signal, combinations)
    }

    /// A signal with the samples before `first` of each output set to zero.
    pub fn since(&self, signal: &[f64], first: usize) -> Vec<f64> {
        let mut late = signal.to_vec();
        for output in late.chunks_mut((signal.len() / self.outputs).max(1)) {
            output.iter_mut().take(first).for_each(|x| *x = 0.0);
        }
        late
    }

    /// Keeps windows in which the uncertainty of a predicted effort is small beside `floor`.
    pub fn keep_foreseen(&mut self, doubt: &[f64], floor: f64) {
        self.keep_below(doubt, MOST_DOUBT * floor);
    }

    /// Keeps windows in which a predicted effort hardly changes: those of a settled brake.
    pub fn keep_steady(&mut self, predicted: &[f64], floor: f64) {
        let next = predicted.iter().skip(1).chain(predicted.last());
        let steps: Vec<f64> = predicted
            .iter()
            .zip(next)
            .map(|(own, next)| (next - own).abs())
            .collect();
        self.keep_below(&steps, MOST_STEP * floor);
    }

    /// Keeps windows in which a signal is at most so much on average.
    fn keep_below(&mut self, signal: &[f64], most: f64) {
        let averages = self.average(signal);
        let pairs = self.usable.iter_mut().zip(averages);
        pairs.for_each(|(usable, average)| *usable &= average <= most);
    }

    fn apply(&self, weights: &[f64], signal: &[f64], combinations: &[Vec<f64>]) -> Vec<f64> {
        let outputs = self.outputs_of(signal);
        // A law at one joint of an arm has no effort at the others.
        let is_silent = |own: &&[f64]| own.iter().all(|x| *x == 0.0);
        let silent: Vec<bool> = outputs.iter().map(is_silent).collect();
        let mut sum = vec![0.0; weights.len()];
        let rows = 0..self.centres.len();
        rows.map(|row| {
            let is_zero = self.combined.get(row).is_none_or(Option::is_none)
                && silent.get(row % self.outputs) != Some(&false);
            match is_zero {
                true => 0.0,
                false => self.applied(row, weights, &outputs, combinations, &mut sum),
            }
        })
        .collect()
    }

    fn outputs_of<'s>(&self, signal: &'s [f64]) -> Vec<&'s [f64]> {
        signal
            .chunks((signal.len() / self.outputs).max(1))
            .collect()
    }

    /// One row of `Σ φ·signal`; `sum` is as long as the weights, whatever it holds.
    fn applied(
        &self,
        row: usize,
        weights: &[f64],
        outputs: &[&[f64]],
        combinations: &[Vec<f64>],
        sum: &mut [f64],
    ) -> f64 {
        let centre = self.centres.get(row).copied().unwrap_or(0);
        let first = centre - weights.len() / 2;
        let window = first..first + weights.len();
        let within = |own| <[f64]>::get(own, window.clone()).unwrap_or_default();
        let combined = self.combined.get(row).copied().flatten();
        if let Some(shares) = combined.and_then(|which| combinations.get(which)) {
            let stretch = outputs.first().map_or(1, |own| own.len()).max(1);
            sum.fill(0.0);
            for (own, shares) in outputs.iter().zip(shares.chunks(stretch)) {
                let terms = within(own).iter().zip(within(shares));
                sum.iter_mut()
                    .zip(terms)
                    .for_each(|(sum, (x, share))| *sum += x * share);
            }
            return dot(weights, sum);
        }
        let own = outputs.get(row % self.outputs);
        own.map_or(0.0, |own| dot(weights, within(own)))
    }

    /// The weights of the equations in a row, at its window's centre.
    pub fn shares(&self, row: usize) -> Vec<f64> {
        let which = self.combined.get(row).copied().flatten();
        let Some(shares) = which.and_then(|which| self.combinations.get(which)) else {
            let own = row % self.outputs;
            return (0..self.outputs)
                .map(|k| f64::from(u8::from(k == own)))
                .collect();
        };
        let stretch = shares.len() / self.outputs;
        let centre = self.centres.get(row).copied().unwrap_or(0);
        (0..self.outputs)
            .map(|k| shares.get(k * stretch + centre).copied().unwrap_or(0.0))
            .collect()
    }

    /// The width of a window, s.
    pub fn width_s(&self) -> f64 {
        (self.bump.len() - 1) as f64 * self.step_s
    }

    /// Time of each row's window centre, s.
    pub fn times_s(&self) -> Vec<f64> {
        self.centres
            .iter()
            .map(|&c| self.start_s + c as f64 * self.step_s)
            .collect()
    }

    /// Autocovariance of a residual over windows: sensor noise through the test function, and white
    /// effort of variance `excess` through the same function.
    ///
    /// `curved` is the standard deviation of the signal that is differenced twice (an inertia times
    /// a position), `effort` that of an effort sample. There are `lags` values, one window hop
    /// apart.
    pub fn noise_covariance(
        &self,
        [curved, effort]: [f64; 2],
        excess: f64,
        lags: usize,
    ) -> Vec<f64> {
        let from_position = curved.powi(2);
        let from_effort = effort.powi(2) + excess / overlap(&self.bump, 0).max(1e-300);
        (0..lags)
            .map(|lag| {
                let shift = lag * self.hop;
                from_position * overlap(&self.curvature, shift)
                    + from_effort * overlap(&self.bump, shift)
            })
            .collect()
    }
}

/// Inner product of weights with themselves `shift` samples later.
pub fn overlap(weights: &[f64], shift: usize) -> f64 {
    weights
        .iter()
        .zip(weights.iter().skip(shift))
        .map(|(a, b)| a * b)
        .sum()
}

/// `(1 − x²)^4` at `2·half + 1` points strictly inside (−1, 1), scaled to sum 1.
fn bump(half: usize) -> Vec<f64> {
    let scale = (half + 1) as f64;
    let raw: Vec<f64> = (0..=2 * half)
        .map(|k| {
            let x = (k as f64 - half as f64) / scale;
            (1.0 - x * x).powi(BUMP_ORDER)
        })
        .collect();
    let sum: f64 = raw.iter().sum();
    raw.into_iter().map(|w| w / sum).collect()
}

fn second_difference(weights: &[f64], step_s: f64) -> Vec<f64> {
    let mut padded = vec![0.0; 2];
    padded.extend_from_slice(weights);
    padded.extend([0.0; 2]);
    let scale = 1.0 / (step_s * step_s);
    padded
        .windows(3)
        .map(|w| match w {
            [a, b, c] => (a - 2.0 * b + c) * scale,
            _ => 0.0,
        })
        .collect()
}

/// Whether all samples of a window were recorded.
pub fn is_recorded(recorded: &[bool], centre: usize, bump: &[f64]) -> bool {
    let reach = match bump.len() {
        1 => 0,
        own => own / 2 + 1,
    };
    let mut samples = recorded.iter().skip(centre - reach).take(2 * reach + 1);
    samples.all(|&r| r)
}

/// The share of a window's weight at samples with unknown direction of motion.
pub fn untold(motion: &[Instant], centre: usize, bump: &[f64]) -> f64 {
    let motion = motion.iter().skip(centre - bump.len() / 2);
    let weighted = bump.iter().zip(motion);
    weighted
        .filter(|(_, now)| now.sense.abs() < 1.0)
        .map(|(w, _)| w)
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::Run;
    use crate::plants::joint::align::align;
    use crate::plants::joint::recorded::{
        INERTIA, NOMINAL, Noise, exact_axis, exact_bench, signals,
    };
    use crate::whiten::{NOISE_ORDER, Whitener};
    use rigproof_spec::effect::Mechanism;

    #[test]
    fn summation_by_parts_is_exact_and_constants_and_ramps_have_no_acceleration() {
        let weights = bump(7);
        let curvature = second_difference(&weights, 0.01);
        let signal: Vec<f64> = (0..17).map(|k| libm::sin(0.7 * k as f64) + 3.1).collect();
        let by_curvature: f64 = curvature.iter().zip(&signal).map(|(w, x)| w * x).sum();
        let by_acceleration: f64 = weights
            .iter()
            .enumerate()
            .map(|(k, w)| w * (signal[k] - 2.0 * signal[k + 1] + signal[k + 2]) / 1e-4)
            .sum();
        assert!((by_curvature - by_acceleration).abs() < 1e-9 * by_acceleration.abs());
        let ramp: f64 = curvature
            .iter()
            .enumerate()
            .map(|(k, w)| w * (2.7 + 0.3 * k as f64))
            .sum();
        assert!(ramp.abs() < 1e-8, "{ramp}");
    }

    fn correlation(values: &[f64], lag: usize) -> f64 {
        let products = values
            .iter()
            .zip(values.iter().skip(lag))
            .map(|(a, b)| a * b);
        products.sum::<f64>() / (values.len() - lag) as f64
    }

    #[test]
    fn overlapping_windows_are_correlated_and_the_noise_model_undoes_it() {
        let mut run = exact_bench(&[(Mechanism::Viscous, &[2.3])], 60_000);
        run.position_noise = 1.1e-6;
        let mut noise = Noise::new(31);
        let position: Vec<f64> = (0..run.len())
            .map(|_| run.position_noise * noise.draw())
            .collect();
        let effort: Vec<f64> = (0..run.len())
            .map(|_| run.effort_noise * noise.draw())
            .collect();
        let windows = run.windows_of(0.077);
        let rows: Vec<f64> = windows
            .apply(&windows.curvature, &position, &[])
            .iter()
            .zip(windows.average(&effort))
            .map(|(a, e)| INERTIA * a + e)
            .collect();
        let sensors = [INERTIA * run.position_noise, run.effort_noise];
        let covariance = windows.noise_covariance(sensors, 0.0, NOISE_ORDER + 1);
        for lag in 0..3 {
            let seen = correlation(&rows, lag);
            assert!(
                (seen - covariance[lag]).abs() < 0.08 * covariance[0],
                "lag {lag}"
            );
        }
        let most = (1..=2)
            .map(|lag| correlation(&rows, lag).abs())
            .fold(0.0, f64::max);
        assert!(most > 0.3 * correlation(&rows, 0), "{most}");
        let white = Whitener::new(&covariance, &vec![true; rows.len()]).whiten(&rows);
        assert!(
            (correlation(&white, 0) - 1.0).abs() < 0.08,
            "{}",
            correlation(&white, 0)
        );
        for lag in 1..=4 {
            let left = correlation(&white, lag);
            assert!(left.abs() < 0.06, "lag {lag}: {left}");
        }
    }

    /// Weight of a window's end in which two samples of unknown direction are tolerated.
    const LAST_WEIGHT: f64 = 0.02;

    #[test]
    fn on_an_axis_a_usable_window_holds_no_reversal_and_no_rest() {
        let mut laws = NOMINAL.to_vec();
        // Enough dry friction that the joint sticks at some reversals.
        laws.push((Mechanism::DryOffset, &[4.7]));
        let exact = exact_axis(&laws, 9000, true);
        let rests = exact.motion.iter().filter(|now| now.sense == 0.0).count();
        assert!(rests > 50, "{rests} samples at rest");
        let run = align(&signals(&exact, 41)).unwrap();
        let windows = run.windows_of(0.077);
        let half = windows.bump.len() / 2;
        let mut touching = 0;
        for (&centre, &usable) in windows.centres.iter().zip(&windows.usable) {
            let here = exact.motion[centre].sense;
            let inside = &exact.motion[centre - half..=centre + half];
            let foreign: f64 = inside
                .iter()
                .zip(&windows.bump)
                .filter(|(now, _)| here == 0.0 || now.sense != here)
                .map(|(_, w)| w)
                .sum();
            touching += usize::from(foreign > LAST_WEIGHT);
            assert!(
                !usable || foreign <= LAST_WEIGHT,
                "window at sample {centre}: {foreign}"
            );
        }
        let usable = windows.usable.iter().filter(|u| **u).count();
        assert!(
            touching > 20 && usable > 200,
            "{touching} touching, {usable} usable"
        );
    }
}
