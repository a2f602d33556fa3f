//! This file runs the reference: the rig with its brakes, or its equations of motion alone where nothing resists.

use rigproof_model::linkage::forward;
use rigproof_model::motion::two_coordinate::two_coordinate;
use rigproof_model::rig::{Parameters, Rig};

use crate::case::{Case, Joints, TICK_S};
use crate::output::{Engine, Folder, Sample};
use crate::timing::cost;

/// Step of the converged solution, s.
pub const CONVERGED_STEP_S: f64 = TICK_S / 16.0;

/// Time under full current before a locked run, s: the yield torques have settled.
const SETTLING_S: f64 = 1.0;

/// The run with steps of at most `step_s`, a sample a tick.
pub fn run(case: &Case, step_s: f64) -> Vec<Sample> {
    match case.joints {
        Joints::Free => free(case, step_s),
        Joints::Dry | Joints::Locked => braked(case, step_s),
    }
}

/// The reference at 1 ms: its run and what a step costs.
pub fn engine(case: &Case, folder: &Folder, repeats: usize) -> Engine {
    let run_of = run(case, TICK_S);
    let scheme = match case.joints {
        Joints::Free => "two coordinates, RK4",
        Joints::Dry | Joints::Locked => "rig with brakes, RK4 with events",
    };
    Engine {
        engine: "reference model",
        settings: scheme.to_owned(),
        cost: cost(repeats, case.ticks(), || run(case, TICK_S)),
        run: Some(folder.write_run(&format!("{}-reference", case.name()), case, &run_of)),
    }
}

fn braked(case: &Case, step_s: f64) -> Vec<Sample> {
    let rig = Rig::new(case.layout, case.start_m()).unwrap();
    // Without an edge of the backlash to enter from, a brake holds from where it is.
    let mut rig = rig.with_longest_step_s(step_s).unwrap();
    let currents_a = case.currents_a();
    if case.joints == Joints::Locked {
        rig.step([0.0; 2], currents_a, SETTLING_S).unwrap();
    }
    let mut samples = vec![of(&rig)];
    for tick in 0..case.ticks() {
        rig.step(case.force_n(tick), currents_a, TICK_S).unwrap();
        samples.push(of(&rig));
    }
    samples
}

fn of(rig: &Rig) -> Sample {
    Sample {
        base_rad: rig.base_angles_rad(),
        rates_rad_s: rig.base_rates_rad_s(),
        tip_m: rig.tip_m(),
    }
}

/// θA, θB and their rates.
type State = [f64; 4];

fn free(case: &Case, step_s: f64) -> Vec<Sample> {
    let start = case.start();
    let mut state = [start.theta_a_rad, start.theta_b_rad, 0.0, 0.0];
    let steps = libm::round(TICK_S / step_s) as usize;
    let mut samples = vec![at(case, state)];
    for tick in 0..case.ticks() {
        for _ in 0..steps {
            state = runge_kutta(case, state, case.force_n(tick), TICK_S / steps as f64);
        }
        samples.push(at(case, state));
    }
    samples
}

fn at(case: &Case, [a, b, rate_a, rate_b]: State) -> Sample {
    let arms = Parameters::of(case.layout).arms;
    Sample {
        base_rad: [a, b],
        rates_rad_s: [rate_a, rate_b],
        tip_m: forward::pose(&arms, a, b).unwrap().tip_m,
    }
}

fn runge_kutta(case: &Case, y: State, force_n: [f64; 2], h: f64) -> State {
    let rate = |[a, b, rate_a, rate_b]: State| {
        let Parameters { arms, inertia, .. } = Parameters::of(case.layout);
        let pose = forward::pose(&arms, a, b).unwrap();
        let form = two_coordinate(&arms, &inertia, &pose, [rate_a, rate_b]);
        let [a_2, b_2] = form.acceleration_rad_s2(force_n, [0.0; 4]);
        [rate_a, rate_b, a_2, b_2]
    };
    let plus = |k: State, h: f64| [0, 1, 2, 3].map(|i| y[i] + h * k[i]);
    let k_1 = rate(y);
    let k_2 = rate(plus(k_1, h / 2.0));
    let k_3 = rate(plus(k_2, h / 2.0));
    let k_4 = rate(plus(k_3, h));
    [0, 1, 2, 3].map(|i| y[i] + h / 6.0 * (k_1[i] + 2.0 * k_2[i] + 2.0 * k_3[i] + k_4[i]))
}
