//! This file says what a resistance law remembers halfway, what it makes of no sense of motion, and which changes of a current are refused.

use rigproof_impl::plant::current::CurrentPath;
use rigproof_impl::plant::effect::{Instant, Law};
use rigproof_spec::effect::Mechanism;

#[test]
fn halfway_a_memory_is_where_half_the_time_leads() {
    for (mechanism, parameters) in [
        (Mechanism::Presliding, [0.31, 0.017].as_slice()),
        (Mechanism::AsymmetricPresliding, &[0.31, 0.12, 0.017]),
        (Mechanism::ReversalOvershoot, &[0.23, 0.019]),
        (Mechanism::Settling, &[0.29, 0.7]),
        (Mechanism::Hysteresis, &[0.41, 13.0, 5.3]),
    ] {
        let law = Law::new(mechanism, parameters).unwrap();
        for speed in [-1.9, -0.003, 0.71] {
            for memory in [-0.53, 0.0, 0.37] {
                let [end, halfway] = law.remember(memory, speed, 3.4e-3);
                let [expected, _] = law.remember(memory, speed, 1.7e-3);
                assert!(
                    (halfway - expected).abs() < 1e-15,
                    "{mechanism:?} {speed} {memory}"
                );
                assert!(end != halfway, "{mechanism:?} {speed} {memory}");
            }
        }
    }
}

#[test]
fn what_settles_does_not_act_where_motion_has_no_sense() {
    let law = Law::new(Mechanism::Settling, &[0.29, 0.7]).unwrap();
    let still = Instant {
        time_s: 0.3,
        position: 1.1,
        speed: 0.0,
        sense: 0.0,
        brake_nm: 0.0,
    };
    assert_eq!(law.smooth(&still, 0.31), 0.0);
}

#[test]
fn a_current_is_changed_by_what_can_be_only() {
    let with = |mechanism, parameter| {
        CurrentPath::default()
            .with(mechanism, &[parameter])
            .is_some()
    };
    assert!(
        with(Mechanism::Lag, 0.0)
            && with(Mechanism::Lag, 100.0)
            && with(Mechanism::GainError, -1.3)
    );
    for none in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(!with(Mechanism::Lag, none) && !with(Mechanism::GainError, none));
    }
    assert!(!with(Mechanism::Lag, -0.013) && !with(Mechanism::Lag, 100.3));
}
