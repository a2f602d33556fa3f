//! This file is the measure of a plant's interface: a pendulum in sixty lines, whose recordings are diagnosed from end to end.

use rigproof_diagnose::cause::{Cause, Place};
use rigproof_diagnose::plant::{Columns, Fault, Plant, Run, numerov, second_difference};
use rigproof_diagnose::{Options, diagnose};
use rigproof_model::axis::{Axis, Transmission};
use rigproof_model::effects::{Instant, Law, law};
use rigproof_spec::effect::Mechanism::{self, *};

/// A pendulum: its moment of inertia, and its mass times the distance of its centre. Of gravity it knows nothing.
#[derive(Clone, Copy, Debug)]
struct Pendulum {
    inertia_kgm2: f64,
    moment_kgm: f64,
}

/// Its motion under a torque, and the angle as recorded.
#[derive(Clone, Debug)]
struct Swing {
    own: Pendulum,
    motion: Vec<Instant>,
    angle_rad: Vec<f64>,
    torque_nm: Vec<f64>,
}

impl Run for Swing {
    fn motion(&self, _: Place) -> &[Instant] {
        &self.motion
    }
    fn effort(&self) -> Vec<f64> {
        self.torque_nm.clone()
    }
    fn known(&self) -> Vec<f64> {
        let bent = second_difference(&self.angle_rad, STEP_S);
        bent.iter().map(|x| self.own.inertia_kgm2 * x).collect()
    }
    fn sensors(&self) -> [f64; 2] {
        [self.own.inertia_kgm2 * COUNT_RAD / 12f64.sqrt(), NOISE_NM]
    }
    fn causes(&self) -> Vec<Cause> {
        let all = [DryOffset, Viscous, ConstantBias, Spring, Gravity];
        all.map(Cause::of).into()
    }
    fn columns(&self, cause: Cause, shape: &[f64], _: Option<&[f64]>) -> Option<Columns> {
        if cause.mechanism != Gravity {
            return self.resistances(cause, shape);
        }
        let pull = |now: &Instant| self.own.moment_kgm * libm::sin(now.position);
        let side = |now: &Instant| self.own.moment_kgm * libm::cos(now.position);
        let [pull, side]: [Vec<f64>; 2] = [
            self.motion.iter().map(pull).collect(),
            self.motion.iter().map(side).collect(),
        ];
        Some(Columns::Free(vec![numerov(&side), numerov(&pull)]))
    }
}

impl Plant for Pendulum {
    type Recording = Swing;
    type Run = Swing;
    fn plant_name(&self) -> &'static str {
        "pendulum"
    }
    fn aligned(&self, recording: &Swing, _: f64) -> Result<Swing, Fault> {
        Ok(recording.clone())
    }
    fn part(run: &Swing, from: usize, to: usize) -> Swing {
        Swing {
            own: run.own,
            motion: run.motion[from..to].to_vec(),
            angle_rad: run.angle_rad[from..to].to_vec(),
            torque_nm: run.torque_nm[from..to].to_vec(),
        }
    }
}

const STEP_S: f64 = 1e-3;
const COUNT_RAD: f64 = 1e-6;
const NOISE_NM: f64 = 1e-4;
const GRAVITY_M_S2: f64 = 9.81;
const PENDULUM: Pendulum = Pendulum {
    inertia_kgm2: 0.043,
    moment_kgm: 0.071,
};

/// The weight of the pendulum as a law, N·m.
struct Weight;

impl Law for Weight {
    fn smooth(&self, now: &Instant, _: f64) -> f64 {
        PENDULUM.moment_kgm * GRAVITY_M_S2 * libm::sin(now.position)
    }
}

/// How the pendulum swings with some friction, N·m.
fn swung(dry_nm: f64) -> Swing {
    let axis = Axis {
        inertia: PENDULUM.inertia_kgm2,
        laws: vec![
            Box::new(Weight),
            law(Mechanism::DryOffset, &[dry_nm]).unwrap(),
        ],
        transmission: Transmission::default(),
    };
    let torque = |t: f64| {
        0.61 * libm::sin(2.3 * t) + 0.43 * libm::sin(7.1 * t + 0.4) + 0.17 * libm::cos(12.7 * t)
    };
    let mut state = axis.state(0.0, 0.31, 0.0);
    let mut swing = Swing {
        own: PENDULUM,
        motion: Vec::new(),
        angle_rad: Vec::new(),
        torque_nm: Vec::new(),
    };
    for k in 0..16_000_i32 {
        let time_s = f64::from(k) * STEP_S;
        swing.motion.push(Instant {
            time_s,
            position: state.position,
            speed: state.speed,
            sense: (state.speed / 2e-3).clamp(-1.0, 1.0),
        });
        swing
            .angle_rad
            .push((state.position / COUNT_RAD).round() * COUNT_RAD);
        // A ripple of some counts stands for the noise of the sensor.
        let noise = NOISE_NM * libm::sin(2.7 * f64::from(k * k % 7919));
        swing.torque_nm.push(torque(time_s) + noise);
        for part in 0..8 {
            let at = |part: i32| torque(time_s + f64::from(part) * STEP_S / 8.0);
            axis.step(&mut state, at(part), at(part + 1), STEP_S / 8.0);
        }
    }
    swing
}

/// What is named, each with its greatest number.
fn named(dry_nm: f64) -> Vec<(&'static str, f64)> {
    let report = diagnose(&PENDULUM, &[&swung(dry_nm)], None, &Options::default()).report;
    println!("{}\n{:?}", report.summary, report.floor);
    let effects = report.effects.iter();
    let mut named: Vec<(&'static str, f64)> = effects
        .map(|own| {
            let sizes = own.parameters.values().map(|number| number.value.abs());
            (own.mechanism, sizes.fold(0.0, f64::max))
        })
        .collect();
    named.sort_by_key(|(name, _)| *name);
    named
}

#[test]
fn the_dry_friction_of_a_pendulum_is_named_and_so_is_gravity() {
    let [("gravity", gravity)] = named(0.0)[..] else {
        panic!("without friction")
    };
    assert!((gravity / GRAVITY_M_S2 - 1.0).abs() < 0.01, "{gravity}");
    let [("dry_offset", level), ("gravity", gravity)] = named(0.053)[..] else {
        panic!("with friction")
    };
    assert!((level / 0.053 - 1.0).abs() < 0.02, "{level}");
    assert!((gravity / GRAVITY_M_S2 - 1.0).abs() < 0.01, "{gravity}");
}
