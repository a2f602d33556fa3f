//! This file is what can be wrong with the drive: a first-order lag, a wrong gain, a time shift.

use super::{Entry, Form};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::Lag,
    form: Form::Drive,
    linear: 0,
    passive: false,
    refuted_by: "an effort that follows a step of the command at once",
    equation: "time_constant·de/dt = gain·u − e",
};

pub(super) const GAIN_ENTRY: Entry = Entry {
    mechanism: Mechanism::GainError,
    form: Form::Drive,
    linear: 1,
    passive: false,
    refuted_by: "the same effort error at small and at large command",
    equation: "e = (1 + fraction)·gain·u",
};

pub(super) const SKEW_ENTRY: Entry = Entry {
    mechanism: Mechanism::ChannelSkew,
    form: Form::Drive,
    linear: 0,
    passive: false,
    refuted_by: "an effort error that does not follow the slope of the effort",
    equation: "e(t) = gain·u(t − delay)",
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

#[cfg(test)]
mod tests {
    use super::first_order_lag;

    #[test]
    fn a_step_reaches_one_minus_one_over_e_after_one_time_constant() {
        let mut signal = vec![1.7; 200];
        signal[0] = 0.3;
        let lagged = first_order_lag(&signal, 1e-3, 0.037);
        let expected = 0.3 + 1.4 * (1.0 - libm::exp(-1.0));
        assert!((lagged[37] - expected).abs() < 1e-12);
    }
}
