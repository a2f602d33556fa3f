//! This file says that the five-bar of blind recordings is the five-bar of the nominal model: two programs of the same physics, so that
//! a recording with nothing hidden shows nothing.

use crate::budget::assert_within_budget;
use rigproof_blind::{RigStep, five_bar_motion};
use rigproof_model::rig::Rig;
use rigproof_spec::layout::Layout;
use std::f64::consts::TAU;

/// Steps of 1 ms: a force that turns and swells, held for each step, and brakes that go on and off one after another.
fn steps(layout: Layout, seconds: u32, phase: f64) -> Vec<RigStep> {
    let on = |time_s: f64, period_s: f64, level_a: f64| {
        if ((time_s + phase) / period_s).fract() < 0.45 {
            level_a
        } else {
            0.0
        }
    };
    (0..1000 * seconds)
        .map(|k| {
            let time_s = f64::from(k) * 1e-3;
            let (s, c) = libm::sincos(TAU * 0.83 * time_s + phase);
            let size = 6.3 + 3.1 * libm::sin(TAU * 0.37 * time_s);
            let fourth_a = if layout == Layout::FourBrake {
                0.19
            } else {
                0.0
            };
            RigStep {
                force_n: [size * c, size * s],
                currents_a: [
                    on(time_s, 1.31, 0.17),
                    on(time_s, 0.83, 0.13),
                    on(time_s, 1.07, 0.21),
                    on(time_s, 0.61, fourth_a),
                ],
            }
        })
        .collect()
}

#[test]
fn both_five_bars_move_alike() {
    let mut apart_rad = Vec::new();
    let mut apart_j = Vec::new();
    let (mut stuck, mut moved) = ([0; 4], 0);
    for layout in [Layout::ThreeBrake, Layout::FourBrake] {
        for phase in [0.13, 1.91, 3.77] {
            let tip_m = [0.021, 0.403];
            let steps = steps(layout, 3, phase);
            let states = five_bar_motion(layout, tip_m, &steps, 1e-3).unwrap();
            let model = Rig::new(layout, tip_m).unwrap();
            let mut model = model.with_longest_step_s(5e-5).unwrap();
            for (step, state) in steps.iter().zip(&states) {
                model.step(step.force_n, step.currents_a, 1e-3).unwrap();
                let theta = model.base_angles_rad();
                apart_rad.push((theta[0] - state.theta_rad[0]).abs());
                apart_rad.push((theta[1] - state.theta_rad[1]).abs());
                let kinetic_j = model.kinetic_energy_j();
                moved += usize::from(kinetic_j > 1e-3);
                for (count, (ours, theirs)) in
                    stuck.iter_mut().zip(state.stuck.iter().zip(model.stuck()))
                {
                    *count += usize::from(*ours && theirs);
                }
            }
            let last = states.last().unwrap();
            apart_j.push((last.work_j - model.work_j()).abs() / model.work_j());
            apart_j.push((last.dissipated_j - model.dissipated_j()).abs() / model.dissipated_j());
        }
    }
    assert!(moved > 3000, "{moved}");
    assert!(stuck.iter().all(|n| *n > 300), "{stuck:?}");
    assert_within_budget("rig_model_against_blind", apart_rad);
    assert_within_budget("rig_model_against_blind_energy", apart_j);
}
