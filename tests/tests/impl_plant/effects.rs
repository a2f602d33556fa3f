//! This file holds the plant's resistance laws against the library's, law by law.

use rigproof_impl::plant::current::CurrentPath;
use rigproof_impl::plant::effect::{Asked, Instant as OwnInstant, Law};
use rigproof_impl::plant::{Outcome, Parameters, Plant};
use rigproof_model::effects::{Form, Instant, LIBRARY, lagged_held, law};
use rigproof_spec::effect::Mechanism;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;

use crate::impl_plant::rigs::Draw;

#[test]
fn every_resistance_law_of_the_library_is_the_plants() {
    let mut draw = Draw::new(1213);
    for entry in LIBRARY {
        let names = entry.mechanism.parameters();
        let (Form::Resistance(_) | Form::ShareOfBrake(_)) = entry.form else {
            assert_eq!(Law::new(entry.mechanism, &vec![0.1; names.len()]), None);
            continue;
        };
        for run in 0..500 {
            let given = names
                .iter()
                .filter(|name| run % 2 == 0 || !name.is_optional);
            let parameters: Vec<f64> = given.map(|_| draw.between(0.03, 1.7)).collect();
            let expected = law(entry.mechanism, &parameters).unwrap();
            let own = Law::new(entry.mechanism, &parameters).unwrap();
            let (time_s, position) = (draw.between(0.0, 9.0), draw.between(-3.1, 3.1));
            let speed = draw.between(-2.3, 2.3);
            let (sense, memory) = (speed.signum(), draw.between(-0.9, 0.9));
            let now = Instant {
                time_s,
                position,
                speed,
                sense,
            };
            let brake_nm = draw.between(0.02, 3.1);
            let own_now = OwnInstant {
                time_s,
                position,
                speed,
                sense,
                brake_nm,
            };
            let [smooth, dry] = match entry.form {
                Form::ShareOfBrake(_) => {
                    let (smooth, dry) = expected.parts(&now, memory);
                    [smooth * brake_nm, dry * brake_nm]
                }
                _ => [expected.smooth(&now, memory), expected.dry(&now)],
            };
            let name = entry.mechanism.name();
            assert!(
                (own.smooth(&own_now, memory) - smooth).abs() <= 1e-15 * smooth.abs(),
                "{name}"
            );
            assert!(
                (own.dry(&own_now, memory) - dry).abs() <= 1e-15 * dry.abs(),
                "{name}"
            );
            // The memory, in a short time, against its rate by the Runge-Kutta formula.
            let step_s = 1e-4;
            let rate = |memory| expected.memory_rate(&now, memory);
            let memory = expected.memory_after(memory, 0.0, speed);
            let k_1 = rate(memory);
            let k_2 = rate(memory + 0.5 * step_s * k_1);
            let k_3 = rate(memory + 0.5 * step_s * k_2);
            let k_4 = rate(memory + step_s * k_3);
            let after = memory + step_s / 6.0 * (k_1 + 2.0 * k_2 + 2.0 * k_3 + k_4);
            let [own_after, _] = own.remember(memory, speed, step_s);
            let off = (own_after - after).abs();
            // Where the memory passes zero its law has a kink, which only the Runge-Kutta formula looks across.
            assert!(off < 2e-12 || memory * after < 0.0, "{name}: {off:e}");
        }
    }
}

#[test]
fn a_lag_of_the_current_ends_where_the_library_says() {
    let mut draw = Draw::new(433);
    let (time_constant_s, step_s) = (0.023, 1.7e-3);
    let signal: Vec<f64> = (0..300)
        .map(|k| if k == 0 { 0.0 } else { draw.between(0.0, 1.0) })
        .collect();
    let mut path = CurrentPath::default()
        .with(Mechanism::Lag, &[time_constant_s])
        .unwrap();
    let mut before = 0.0;
    for asked in signal.iter().skip(1) {
        // Halfway through the step.
        let [_, halfway] = lagged_held(before, *asked, 0.5 * step_s, time_constant_s);
        [_, before] = lagged_held(before, *asked, step_s, time_constant_s);
        assert!((path.step(*asked, step_s) - halfway).abs() < 1e-14);
    }
}

fn swung(effects: &[Asked<'_>]) -> Plant {
    let parameters = Parameters::of(Layout::FourBrake);
    let mut plant = Plant::new(&parameters, [2.17, 0.83], [0.0; 2], effects).unwrap();
    for k in 0..400_u32 {
        let time_s = f64::from(k) * 1e-3;
        let force_n = [
            9.0 * libm::sin(17.0 * time_s + 0.3),
            7.0 * libm::cos(13.0 * time_s),
        ];
        assert_eq!(
            plant.step(force_n, [0.07, 0.03, 0.09, 0.05], 1e-3),
            Outcome::Moved
        );
    }
    plant
}

#[test]
fn every_effect_changes_the_motion_on_every_joint_and_a_null_one_does_not() {
    let plain = swung(&[]);
    let asked = |joint, mechanism, parameters| Asked {
        joint,
        mechanism,
        parameters,
    };
    for joint in Joint::ALL {
        assert_eq!(
            swung(&[asked(joint, Mechanism::Viscous, &[0.0])]).tip_m(),
            plain.tip_m()
        );
        for (mechanism, parameters) in [
            (Mechanism::DryOffset, [0.13].as_slice()),
            (Mechanism::ConstantBias, &[0.07]),
            (Mechanism::Viscous, &[0.31]),
            (Mechanism::DirectionAsymmetry, &[0.11, 0.05]),
            (Mechanism::Stribeck, &[0.23, 0.19, 1.7]),
            (Mechanism::Presliding, &[0.17, 0.011]),
            (Mechanism::AsymmetricPresliding, &[0.07, 0.23, 0.011]),
            (Mechanism::Hysteresis, &[7.0, 13.0, 5.0]),
            (Mechanism::Ripple, &[0.11, 0.07, 0.29]),
            (Mechanism::UnevenFriction, &[0.07, 0.05, 0.29]),
            (Mechanism::Spring, &[0.37]),
            (Mechanism::NonlinearSpring, &[0.071]),
            (Mechanism::BiasDrift, &[0.41]),
            (Mechanism::BiasDrift, &[0.41, 0.9]),
            (Mechanism::Lag, &[0.031]),
            (Mechanism::GainError, &[-0.17]),
        ] {
            let changed = swung(&[asked(joint, mechanism, parameters)]);
            let moved_m = (changed.tip_m() - plain.tip_m()).norm();
            assert!(
                moved_m > 1e-6,
                "{} on {joint:?}: {moved_m:e} m",
                mechanism.name()
            );
            assert!(
                moved_m < 0.2,
                "{} on {joint:?}: {moved_m:e} m",
                mechanism.name()
            );
        }
    }
}
