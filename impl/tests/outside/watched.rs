//! This file says what the monitor does with whatever it is told: an alarm stays, nothing leaves after it, and what it keeps stays finite.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use rigproof_impl::monitor::constants::Constants;
use rigproof_impl::monitor::{Alarm, Monitor};
use rigproof_impl::tick::{Sensed, Settings};
use rigproof_impl::vector::Vector;
use rigproof_spec::layout::Layout;

#[path = "../../c/tests/monitor/rigproof_monitor.rs"]
mod numbers;

const SETTINGS: [(Layout, Constants); 2] = [
    (Layout::ThreeBrake, numbers::THREE_BRAKE),
    (Layout::FourBrake, numbers::FOUR_BRAKE),
];

fn standing(number: u32, x_n: f64) -> Sensed<f64> {
    Sensed {
        number,
        counts: [33_421, 14_327],
        tip_force_n: Vector::new(x_n, -0.7),
    }
}

#[test]
fn a_force_beyond_every_trial_lets_go_after_the_samples_that_are_stated() {
    for (layout, of) in SETTINGS {
        let mut monitor = Monitor::new(&Settings::thesis(layout), &of).unwrap();
        let currents_a = [0.3, 0.0, 0.2, 0.0];
        let mut number = 0;
        let mut watch = |x_n: f64| {
            number += 1;
            monitor.watch(&standing(number, x_n), currents_a)
        };
        assert!((0..100).all(|_| watch(1.3).currents_a == currents_a));
        // One sample fewer raises nothing.
        assert!((1..of.hold).all(|_| watch(41.0).alarm.is_none()));
        assert_eq!(watch(1.3).currents_a, currents_a);
        assert!((1..of.hold).all(|_| watch(41.0).alarm.is_none()));
        let last = watch(41.0);
        assert_eq!(
            (last.alarm, last.currents_a),
            (Some(Alarm::Force), [0.0; 4])
        );
        assert!((0..100).all(|_| watch(1.3) == last));
    }
}

#[test]
fn a_command_that_no_amplifier_takes_lets_go_at_once() {
    for wrong in [f64::NAN, -0.02, 1.02, f64::INFINITY] {
        let (layout, of) = (Layout::ThreeBrake, numbers::THREE_BRAKE);
        let mut monitor = Monitor::new(&Settings::thesis(layout), &of).unwrap();
        monitor.watch(&standing(1, 1.3), [0.3; 4].map(|_| 0.0));
        let watched = monitor.watch(&standing(2, 1.3), [0.0, wrong, 0.0, 0.0]);
        assert_eq!(
            (watched.alarm, watched.currents_a),
            (Some(Alarm::Command), [0.0; 4])
        );
    }
    // No brake is at C.
    let settings = Settings::thesis(Layout::ThreeBrake);
    let mut monitor = Monitor::new(&settings, &numbers::THREE_BRAKE).unwrap();
    let watched = monitor.watch(&standing(1, 1.3), [0.0, 0.0, 0.0, 0.4]);
    assert_eq!(watched.alarm, Some(Alarm::Command));
}

#[test]
fn a_sensor_that_stays_wrong_raises_an_alarm_after_the_longest_fault_of_a_trial() {
    for (layout, of) in SETTINGS {
        let mut monitor = Monitor::new(&Settings::thesis(layout), &of).unwrap();
        for number in 0..20 {
            assert!(!monitor.watch(&standing(number, 1.3), [0.0; 4]).is_faulty);
        }
        for number in 20..20 + of.longest_fault {
            let watched = monitor.watch(&standing(number, f64::NAN), [0.3, 0.0, 0.0, 0.0]);
            assert_eq!((watched.alarm, watched.is_faulty), (None, true));
            assert_eq!(watched.currents_a, [0.0; 4]);
        }
        let watched = monitor.watch(&standing(20 + of.longest_fault, f64::NAN), [0.0; 4]);
        assert_eq!(watched.alarm, Some(Alarm::Sensor));
    }
}

#[test]
fn whatever_is_told_the_estimate_is_finite() {
    let mut random = Pcg64Mcg::seed_from_u64(20_031);
    let mut draw = || (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    for (layout, of) in SETTINGS {
        let mut monitor = Monitor::new(&Settings::thesis(layout), &of).unwrap();
        let (mut counts, mut rates, mut alarm) = ([33_421.0, 14_327.0], [0.0; 2], None);
        let mut asked = 0;
        for number in 0..40_000_u32 {
            for (count, rate) in counts.iter_mut().zip(&mut rates) {
                *rate = 0.99 * *rate + 3.1 * (draw() - 0.5);
                *count += *rate;
            }
            let odd = draw();
            let force_n = match odd {
                odd if odd < 0.001 => f64::NAN,
                odd if odd < 0.002 => 1e300,
                _ => 30.0 * (draw() - 0.5),
            };
            let sensed = Sensed {
                number: if odd > 0.999 { number + 3 } else { number },
                counts: counts.map(|count| count as i32),
                tip_force_n: Vector::new(force_n, 30.0 * (draw() - 0.5)),
            };
            let watched = monitor.watch(&sensed, [draw(), draw(), draw(), 0.0]);
            assert!(
                alarm.is_none() || watched.alarm == alarm,
                "{alarm:?} {watched:?}"
            );
            alarm = watched.alarm;
            for (number, spread) in monitor.estimate().numbers().iter().zip(of.spread) {
                assert!(number.now.is_finite() && number.variance > 0.0);
                asked += u32::from(number.variance < spread * spread);
            }
            assert!(monitor.estimate().surprise().is_finite());
        }
        assert!(alarm.is_some() && asked > 0);
    }
}
