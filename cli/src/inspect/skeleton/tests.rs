//! This file holds what a begun rig description proposes.

use rigproof_trace::Channel;

use super::*;

/// A swing in steps of `quantum`, with noise if it is above zero.
fn view(name: &str, unit: &str, quantum: f64, noise: f64) -> SignalView {
    let sample = |k: u32| {
        let own = 0.7 * libm::sin(4.1e-3 * f64::from(k))
            + 1.7 * noise * libm::sin(f64::from(k * k % 7919));
        (own / quantum).round() * quantum
    };
    SignalView::of(Channel {
        name: name.into(),
        unit: unit.into(),
        samples: (0..4000).map(sample).collect(),
    })
}

fn begun(signals: &[SignalView]) -> String {
    let signals: Vec<&SignalView> = signals.iter().collect();
    toml(Path::new("run.csv"), None, &Hints::default(), &signals)
}

#[test]
fn a_torque_or_a_current_that_is_told_drives_an_axis() {
    for (name, unit, command) in [
        ("torque_cmd", "N·m", "torque_cmd"),
        ("tau_set", "N·m", "tau_set"),
        ("motor current", "A", "motor current"),
        ("u", "V", "u"),
    ] {
        let rig = begun(&[view("angle", "rad", 1e-3, 0.0), view(name, unit, 1e-3, 0.0)]);
        assert!(rig.contains("plant = \"axis\"   # guess"), "{rig}");
        assert!(
            rig.contains(&format!("command = {{ channel = {command:?}")),
            "{rig}"
        );
    }
    for name in ["torque", "tau_meas", "load torque"] {
        let rig = begun(&[
            view("angle", "rad", 1e-3, 0.0),
            view(name, "N·m", 1e-3, 0.0),
        ]);
        assert!(
            rig.contains("plant = \"bench\"   # guess")
                && rig.contains("Is it what a motor is told?"),
            "{rig}"
        );
        assert!(
            rig.contains("\n[[effect]]\nmechanism = \"dry_offset\""),
            "{rig}"
        );
    }
    let braked = begun(&[
        view("angle", "rad", 1e-3, 0.0),
        view("torque", "N·m", 1e-3, 0.0),
        view("i", "A", 1e-3, 0.0),
    ]);
    assert!(braked.contains("rigproof identify brake"), "{braked}");
}

#[test]
fn what_is_measured_comes_before_what_is_computed_or_wanted() {
    for (derived, measured, unit) in [
        ("volts_calc", "volts_meas", "V"),
        ("u_model", "u", "V"),
        ("angle_ref", "angle", "rad"),
        ("torque_est", "torque", "N·m"),
    ] {
        let mut signals = vec![
            view(derived, unit, 1e-3, 0.0),
            view(measured, unit, 1e-3, 0.0),
        ];
        if unit != "rad" {
            signals.push(view("x", "rad", 1e-3, 0.0));
        }
        let rig = begun(&signals);
        assert!(rig.contains(&format!("channel = {measured:?}")), "{rig}");
        assert!(!rig.contains(&format!("channel = {derived:?}")), "{rig}");
    }
}

#[test]
fn noise_is_that_of_the_samples_and_stands_beside_the_quantum() {
    for (quantum, noise, stated) in [
        (1e-3, 0.0, false),
        (1e-3, 0.02, true),
        (5e-3, 0.1, true),
        (0.02, 1e-3, false),
    ] {
        let rig = begun(&[view("angle", "rad", quantum, noise)]);
        assert!(
            rig.contains(&format!("quantum = {}", significant(quantum, 4))),
            "{rig}"
        );
        assert_eq!(rig.contains(", noise = "), stated, "{rig}");
        let said = rig
            .split(", noise = ")
            .nth(1)
            .and_then(|rest| rest.split(' ').next());
        let said: Option<f64> = said.map(|text| text.parse().unwrap());
        assert!(
            said.is_none_or(|said| said > 0.5 * noise && said < 3.0 * noise),
            "{rig}"
        );
    }
}

#[test]
fn a_metered_damper_under_volts_is_begun_with_its_characteristic() {
    let signals = [
        view("x", "m", 1e-3, 0.0),
        view("force", "N", 1e-3, 0.0),
        view("u", "V", 1e-3, 0.0),
    ];
    let rig = begun(&signals);
    assert!(
        rig.contains("\ncommand = { channel = \"u\", unit = \"V\""),
        "{rig}"
    );
    let refused = |text: &str| rigproof_trace::rig::Rig::parse(text, Path::new("begun.toml"));
    let message = refused(&rig).unwrap_err().to_string();
    assert!(
        message.contains("`points` of `command` is still to be filled in"),
        "{message}"
    );
    let filled = rig
        .replacen("points = \"fill in\"", "points = [0, 2, 5]", 1)
        .replacen("points = \"fill in\"", "points = [10, 120, 180]", 1);
    let own = refused(&filled).unwrap().characteristic.unwrap();
    assert_eq!(own.points, [[0.0, 10.0], [2.0, 120.0], [5.0, 180.0]]);
}
