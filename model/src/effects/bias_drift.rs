//! This file is a constant effort that drifts with the time since the start: in proportion to it, or ever slower to an end, as what warms does
//! (Newton's law of cooling, 1701).

use super::facts::{Alone, Asked, Facts, Family, Refit, Shapes, Usual, Where, Words};
use super::{Entry, Form, Instant, Law, parameter};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::BiasDrift,
    form: Form::Resistance(|p| {
        Box::new(Drift {
            rate: parameter(p, 0),
            settling: parameter(p, 1),
        })
    }),
    linear: 1,
    passive: false,
    refuted_by: "an offset that is the same at the start and at the end of the recording",
    equation: "rate·t, or rate·settling·(1 − exp(−t/settling)) where it settles",
    facts: Facts {
        usual: Usual::Exceptional,
        shapes: Shapes::Optional {
            low: 0.7,
            high: 30.0,
            count: 5,
        },
        refit: Refit {
            leads: false,
            sizes: &[0.1],
        },
        ..Facts::of(
            Family::Constant,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Brakes,
            },
            Words {
                what: "a pull to one side that changes with time",
                look_for: "a sensor's zero that drifts with temperature",
            },
        )
    },
};

struct Drift {
    rate: f64,
    /// 0 where it does not settle.
    settling: f64,
}

impl Law for Drift {
    fn smooth(&self, now: &Instant, _memory: f64) -> f64 {
        drifted(self.rate, self.settling, now.time_s)
    }
}

/// What has drifted by a time: at a rate that settles, or at the same one all the time where `settling` is 0.
pub(super) fn drifted(rate: f64, settling: f64, time_s: f64) -> f64 {
    match settling > 0.0 {
        true => -rate * settling * libm::expm1(-time_s / settling),
        false => rate * time_s,
    }
}

#[cfg(test)]
mod tests {
    use super::super::law;
    use super::*;

    fn at(parameters: &[f64], time_s: f64) -> f64 {
        let own = law(Mechanism::BiasDrift, parameters).unwrap();
        let now = Instant {
            time_s,
            position: 0.3,
            speed: -0.7,
            sense: -1.0,
        };
        own.smooth(&now, 0.0)
    }

    #[test]
    fn it_begins_with_its_rate_and_ends_at_rate_times_settling() {
        assert_eq!(at(&[0.31, 2.3], 0.0), 0.0);
        assert!((at(&[0.31, 2.3], 1e-6) - 0.31e-6).abs() < 1e-12);
        assert!((at(&[0.31, 2.3], 200.0) - 0.31 * 2.3).abs() < 1e-12);
        let half = 2.3 * core::f64::consts::LN_2;
        assert!((at(&[0.31, 2.3], half) - 0.5 * 0.31 * 2.3).abs() < 1e-12);
    }

    #[test]
    fn what_settles_very_late_grows_with_time() {
        assert!((at(&[0.31, 1e7], 4.1) - at(&[0.31], 4.1)).abs() < 1e-6);
    }
}
