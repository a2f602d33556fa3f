//! This file is what can be wrong with the drive: a first-order lag, a wrong gain, a time shift.

use super::facts::{Alone, Asked, AtRest, Facts, Family, Shapes, Usual, Where, Words, first};
use super::{Drive, Entry, Form};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::Lag,
    form: Form::Drive(Drive::Lag),
    linear: 0,
    passive: false,
    refuted_by: "an effort that follows a step of the command at once",
    equation: "time_constant·de/dt = gain·u − e",
    facts: Facts {
        usual: Usual::Frequent,
        turn: 4,
        shapes: Shapes::Lag,
        // A delay, as a shift in time is.
        form_of: Some(Mechanism::ChannelSkew),
        nothing: Some(0.0),
        ..Facts::of(
            Family::Drive,
            Asked {
                alone: Alone::WithDrive,
                five_bar: Where::Brakes,
            },
            Words {
                what: "a drive or brake that answers slowly",
                look_for: "the coil's inductance, the amplifier, a filter",
            },
        )
    },
};

pub(super) const GAIN_ENTRY: Entry = Entry {
    mechanism: Mechanism::GainError,
    form: Form::Drive(Drive::Gain),
    linear: 1,
    passive: false,
    refuted_by: "the same effort error at small and at large command",
    equation: "e = (1 + fraction)·gain·u",
    facts: Facts {
        in_a_sweep: true,
        at_arm: true,
        usual: Usual::Frequent,
        turn: 1,
        at_rest: AtRest::OfBrake(first),
        ..Facts::of(
            Family::Drive,
            Asked {
                alone: Alone::WithKnown,
                five_bar: Where::Brakes,
            },
            Words {
                what: "a drive or brake that is stronger or weaker than its table says",
                look_for: "the amplifier's scale, the brake's age, its gap and its fluid",
            },
        )
    },
};

pub(super) const SKEW_ENTRY: Entry = Entry {
    mechanism: Mechanism::ChannelSkew,
    form: Form::Drive(Drive::Skew),
    linear: 0,
    passive: false,
    refuted_by: "an effort error that does not follow the slope of the effort",
    equation: "e(t) = gain·u(t − delay)",
    facts: Facts {
        at_arm: true,
        usual: Usual::Frequent,
        turn: 4,
        shapes: Shapes::Shift,
        nothing: Some(0.0),
        ..Facts::of(
            Family::Sensor,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Whole,
            },
            Words {
                what: "two recorded signals that are shifted in time",
                look_for: "how the logger stamps its channels",
            },
        )
    },
};

/// First-order lag of a drive that holds each sample until the next one. What comes out is the mean until the next sample, which is
/// held in its place: the state there would come half a sample early.
///
/// `signal` in any unit at `step_s` (s, > 0); `time_constant_s` ≥ 0. Starts in equilibrium with the first
/// sample.
pub fn first_order_lag_held(signal: &[f64], step_s: f64, time_constant_s: f64) -> Vec<f64> {
    let mut state = signal.first().copied().unwrap_or(0.0);
    let held = signal.iter().map(|&target| {
        let [mean, end] = lagged_held(state, target, step_s, time_constant_s);
        state = end;
        mean
    });
    held.collect()
}

/// What lags by `time_constant_s`, s, in a step of `step_s` in which what it follows is held: its mean, and its end.
pub fn lagged_held(state: f64, target: f64, step_s: f64, time_constant_s: f64) -> [f64; 2] {
    if time_constant_s <= 0.0 {
        return [target; 2];
    }
    let ratio = step_s / time_constant_s;
    let mean = -libm::expm1(-ratio) / ratio;
    [mean, libm::exp(-ratio)].map(|kept| target + kept * (state - target))
}

/// First-order lag of a signal that runs straight between its samples, such as a torque, by the exact discrete update.
///
/// `signal` in any unit at `step_s` (s, > 0); `time_constant_s` ≥ 0. Starts in equilibrium with the first sample.
pub fn first_order_lag_straight(signal: &[f64], step_s: f64, time_constant_s: f64) -> Vec<f64> {
    let mut before = signal.first().copied().unwrap_or(0.0);
    let mut state = before;
    signal
        .iter()
        .map(|&now| {
            state = lagged(state, [before, now], step_s, time_constant_s);
            before = now;
            state
        })
        .collect()
}

/// What lags by `time_constant_s`, s, after a step of `step_s` in which what it follows ran straight from one value to the other.
pub fn lagged(state: f64, [before, now]: [f64; 2], step_s: f64, time_constant_s: f64) -> f64 {
    if time_constant_s <= 0.0 {
        return now;
    }
    let ratio = step_s / time_constant_s;
    let kept = libm::exp(-ratio);
    let mean = -libm::expm1(-ratio) / ratio;
    kept * state + (mean - kept) * before + (1.0 - mean) * now
}

#[cfg(test)]
mod tests {
    use super::{first_order_lag_held, first_order_lag_straight, lagged_held};

    #[test]
    fn a_ramp_is_followed_one_time_constant_late() {
        let (step_s, time_constant_s) = (1e-3, 0.0123);
        let ramp: Vec<f64> = (0..400).map(|k| 3.1 * f64::from(k) * step_s).collect();
        let lagged = first_order_lag_straight(&ramp, step_s, time_constant_s);
        for (k, lagged) in lagged.iter().enumerate() {
            let t = k as f64 * step_s;
            // 3.1·(t − T + T·exp(−t/T)), the answer to a ramp from rest.
            let late = time_constant_s * -libm::expm1(-t / time_constant_s);
            assert!((lagged - 3.1 * (t - late)).abs() < 1e-12, "{k}");
        }
        assert_eq!(first_order_lag_straight(&ramp, step_s, 0.0), ramp);
    }

    #[test]
    fn a_step_reaches_one_minus_one_over_e_after_one_time_constant() {
        let mut state = 0.3;
        for _ in 0..37 {
            [_, state] = lagged_held(state, 1.7, 1e-3, 0.037);
        }
        let expected = 0.3 + 1.4 * (1.0 - libm::exp(-1.0));
        assert!((state - expected).abs() < 1e-12);
    }

    #[test]
    fn what_is_held_is_late_by_one_time_constant_in_the_mean() {
        // A pulse of one sample: its centre of gravity is half a sample after its time stamp, as that of every held sample.
        let (step_s, time_constant_s) = (2e-3, 0.0051);
        let mut pulse = vec![0.0; 400];
        pulse[3] = 1.3;
        let held = first_order_lag_held(&pulse, step_s, time_constant_s);
        let sum: f64 = held.iter().sum();
        let moments = held.iter().enumerate().map(|(k, own)| k as f64 * own);
        let late_s = (moments.sum::<f64>() / sum - 3.0) * step_s;
        assert!((sum - 1.3).abs() < 1e-12, "{sum}");
        assert!((late_s - time_constant_s).abs() < 1e-9, "{late_s}");
        assert_eq!(first_order_lag_held(&pulse, step_s, 0.0), pulse);
    }
}
