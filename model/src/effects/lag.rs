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
        ..Facts::of(
            Family::Sensor,
            Asked {
                alone: Alone::WithDrive,
                five_bar: Where::Whole,
            },
            Words {
                what: "two recorded signals that are shifted in time",
                look_for: "how the logger stamps its channels",
            },
        )
    },
};

pub(super) const LIMIT_ENTRY: Entry = Entry {
    mechanism: Mechanism::DriveSaturation,
    form: Form::Drive(Drive::Limit),
    linear: 0,
    passive: false,
    refuted_by: "an effort that grows with the command beyond the limit",
    equation: "e = gain·u cut at ±limit",
    facts: Facts {
        in_sets: true,
        usual: Usual::Frequent,
        shapes: Shapes::EffortLimit,
        ..Facts::of(
            Family::Drive,
            Asked {
                alone: Alone::Driven,
                five_bar: Where::Nowhere,
            },
            Words {
                what: "a drive that gives no more than so much",
                look_for: "the amplifier's current limit, its supply voltage, a torque limit in a controller",
            },
        )
    },
};

/// First-order lag of a sampled signal held between samples, by the exact discrete update.
///
/// `signal` in any unit at `step_s` (s, > 0); `time_constant_s` ≥ 0. Starts in equilibrium with the first
/// sample.
pub fn first_order_lag(signal: &[f64], step_s: f64, time_constant_s: f64) -> Vec<f64> {
    let share = if time_constant_s > 0.0 {
        -libm::expm1(-step_s / time_constant_s)
    } else {
        1.0
    };
    let mut state = signal.first().copied().unwrap_or(0.0);
    signal
        .iter()
        .map(|&target| {
            state += share * (target - state);
            state
        })
        .collect()
}

/// First-order lag of a signal that runs straight between its samples, such as a torque, by the exact discrete update; held between
/// samples instead it would come half a sample early.
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
    use super::{first_order_lag, first_order_lag_straight};

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
        let mut signal = vec![1.7; 200];
        signal[0] = 0.3;
        let lagged = first_order_lag(&signal, 1e-3, 0.037);
        let expected = 0.3 + 1.4 * (1.0 - libm::exp(-1.0));
        assert!((lagged[37] - expected).abs() < 1e-12);
    }
}
