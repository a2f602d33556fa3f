//! This file says how the time constant of one current step is read off its transient.

/// Elapsed time over the time constant of a first-order step, 1 (3.4).
///
/// ```text
/// t/a = −ln((τ − τ1) / (τ2 − τ1))
/// ```
///
/// | symbol | here | unit |
/// |---|---|---|
/// | τ | `torque_nm` | N·m |
/// | τ1 | `final_nm` | N·m |
/// | τ2 | `initial_nm` | N·m |
///
/// # Differs from the thesis
///
/// The text calls τ1 the initial and τ2 the final torque, which is the other way round (erratum `step-labels`).
///
/// ```
/// use rigproof_model::brake::identify::elapsed_over_time_constant;
/// // Brake A from 0.22 towards 6.4448 N·m: 63.2 % of the way after one time constant.
/// let torque_nm = 6.4448 - (6.4448 - 0.22) * libm::exp(-1.0);
/// assert!((elapsed_over_time_constant(torque_nm, 0.22, 6.4448) - 1.0).abs() < 1e-12);
/// ```
//= thesis (3.4)
pub fn elapsed_over_time_constant(torque_nm: f64, initial_nm: f64, final_nm: f64) -> f64 {
    -libm::log((torque_nm - final_nm) / (initial_nm - final_nm))
}

/// What a step's transient says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepFit {
    /// Time constant, s.
    pub time_constant_s: f64,
    /// When the torque began to move, on the clock of the samples, s.
    pub start_s: f64,
    /// Samples that told it.
    pub samples: usize,
}

/// The transient region: the share of the step that is left where it begins and where it ends at the latest.
pub const TRANSIENT: [f64; 2] = [0.95, 0.05];
/// The region ends where less than this many standard deviations of the noise are left.
const LEAST_SIGNAL: f64 = 4.0;
/// Samples that a slope needs.
const LEAST_SAMPLES: usize = 3;

/// The time constant of one step: the inverse slope of (3.4) over the transient region, by least squares.
///
/// `time_s` and `torque_nm` begin at the step or a little before it; `noise_nm` is the standard deviation of the torque's
/// noise; `region` is [`TRANSIENT`], or less of it where the time constant changes on the way and only the start counts.
/// The logarithm magnifies the noise where little is left of the step; each sample is weighted accordingly. `None` when
/// fewer than three samples lie in the region, or when what is left does not fall.
pub fn fit_step(
    time_s: &[f64],
    torque_nm: &[f64],
    [initial_nm, final_nm]: [f64; 2],
    noise_nm: f64,
    [first, last]: [f64; 2],
) -> Option<StepFit> {
    let step_nm = initial_nm - final_nm;
    let last = last.max(LEAST_SIGNAL * noise_nm / step_nm.abs());
    let mut sums = [0.0; 5];
    let mut samples = 0;
    for (time_s, torque_nm) in time_s.iter().zip(torque_nm) {
        let left = (torque_nm - final_nm) / step_nm;
        if left < last {
            break;
        }
        if left >= first {
            // Before the step, or noise on the torque before it.
            sums = [0.0; 5];
            samples = 0;
            continue;
        }
        let elapsed = elapsed_over_time_constant(*torque_nm, initial_nm, final_nm);
        let weight = left * left;
        let [w, wt, wy, wtt, wty] = sums;
        sums = [
            w + weight,
            wt + weight * time_s,
            wy + weight * elapsed,
            wtt + weight * time_s * time_s,
            wty + weight * time_s * elapsed,
        ];
        samples += 1;
    }
    let [w, wt, wy, wtt, wty] = sums;
    let spread = wtt - wt * wt / w;
    let slope = (wty - wt * wy / w) / spread;
    if samples < LEAST_SAMPLES || !slope.is_finite() || slope <= 0.0 {
        return None;
    }
    let time_constant_s = 1.0 / slope;
    Some(StepFit {
        time_constant_s,
        start_s: (wt - wy * time_constant_s) / w,
        samples,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(a_s: f64, start_s: f64, [initial, last]: [f64; 2]) -> (Vec<f64>, Vec<f64>) {
        let time_s: Vec<f64> = (0..400).map(|k| 0.001 * f64::from(k)).collect();
        let torque = time_s.iter().map(|t| {
            if *t < start_s {
                initial
            } else {
                last + (initial - last) * libm::exp(-(t - start_s) / a_s)
            }
        });
        let torque = torque.collect();
        (time_s, torque)
    }

    //= thesis (3.4) test
    #[test]
    fn a_step_gives_back_its_time_constant_and_its_start() {
        for (a_s, start_s, ends) in [
            (0.0053, 0.0317, [0.23, 4.71]),
            (0.0071, 0.0122, [5.9, 0.24]),
            (0.047, 0.0081, [0.27, 6.6]),
        ] {
            let (time_s, torque_nm) = step(a_s, start_s, ends);
            let fit = fit_step(&time_s, &torque_nm, ends, 0.0, TRANSIENT).unwrap();
            assert!((fit.time_constant_s - a_s).abs() < 1e-12, "{fit:?}");
            assert!((fit.start_s - start_s).abs() < 1e-11, "{fit:?}");
            assert!(fit.samples > 10);
        }
    }

    #[test]
    fn a_step_without_a_transient_gives_nothing() {
        let (time_s, torque_nm) = step(0.0002, 0.0317, [0.23, 4.71]);
        assert_eq!(
            fit_step(&time_s, &torque_nm, [0.23, 4.71], 0.0, TRANSIENT),
            None
        );
        // Away from where the step ends: the share that is left grows.
        let (time_s, torque_nm) = step(0.0053, 0.0317, [0.23, 4.71]);
        assert_eq!(
            fit_step(&time_s, &torque_nm, [4.71, 0.23], 0.0, TRANSIENT),
            None
        );
        assert_eq!(fit_step(&[], &[], [0.3, 2.1], 0.01, TRANSIENT), None);
        assert_eq!(
            fit_step(&time_s, &torque_nm, [1.7, 1.7], 0.01, TRANSIENT),
            None
        );
    }
}
