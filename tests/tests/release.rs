//! This file runs appendix B and the thesis's own simulation rules beside the rig.

use rigproof_model::linkage::inverse;
use rigproof_model::motion::coordinates::{JOINTS, forces};
use rigproof_model::motion::stick::{KarnoppBrakes, joints};
use rigproof_model::motion::ten_coordinates::TenCoordinates;
use rigproof_model::rig::release::{FIGURES, Release};
use rigproof_model::rig::{Parameters, Rig};
use rigproof_spec::geometry::arms;
use rigproof_spec::inertia::inertia;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::tables::{backlash_width_deg, torque_gain_fit};
use rigproof_spec::units::RAD_PER_DEG;

#[test]
fn every_figure_of_appendix_b_runs() {
    for (number, layout, locked) in FIGURES {
        let release = Release::of(layout, locked);
        let run = release.run().unwrap();
        let (first, last) = (run[0], run[run.len() - 1]);
        let travel_m = apart_m(first.tip_m, last.tip_m);
        println!(
            "{number}: {:.3} s, {:.1} mm, held {:?}",
            last.time_s,
            travel_m * 1e3,
            last.stuck
        );
        assert!(apart_m(first.tip_m, release.start_m) < 1e-15, "{number}");
        assert!(travel_m > 0.03, "{number} does not move");
        let Some(joint) = locked else {
            assert!(
                apart_m(last.tip_m, release.cylinder_m) < 0.03,
                "{number} does not arrive"
            );
            continue;
        };
        // A locked joint runs through half its backlash, then slips until its brake, which rises again, holds it.
        let angles = run
            .iter()
            .map(|sample| sample.joint_angles_rad[joint as usize]);
        let turned_rad = angles.fold(0.0, |most: f64, angle| {
            most.max((angle - first.joint_angles_rad[joint as usize]).abs())
        });
        let turned_deg = turned_rad / RAD_PER_DEG;
        println!("  {} turned {turned_deg:.4}°", joint.letter());
        assert!(
            turned_deg <= backlash_width_deg(joint),
            "{number}: {turned_deg}°"
        );
        assert!(run.iter().any(|sample| sample.stuck[joint as usize]));
    }
}

fn apart_m(one: [f64; 2], other: [f64; 2]) -> f64 {
    libm::hypot(one[0] - other[0], one[1] - other[1])
}

/// The thesis's simulation: ten coordinates, Euler steps, Karnopp rules; the yields are constant.
fn thesis_run(
    release: &Release,
    yields_nm: [f64; 4],
    step_s: f64,
    dead_band: f64,
    times: &[f64],
) -> Vec<[f64; 2]> {
    let (arms, inertia) = (arms(release.layout), inertia(release.layout));
    let pose = inverse::pose(&arms, release.start_m).unwrap();
    let mut ten = TenCoordinates::new(&arms, &inertia, &pose, [0.0; 2]);
    let mut rule = KarnoppBrakes::new(dead_band);
    let mut tips = Vec::new();
    let mut step = 0_u32;
    for &time in times {
        while f64::from(step) * step_s < time - 0.5 * step_s {
            let pull = release.pull_n([ten.q[0], ten.q[1]]);
            let joints = joints(&ten.equations(), pull).unwrap();
            let (torques, _) = rule.torques_nm(&joints, JOINTS.map(|j| ten.q_dot[j]), yields_nm);
            ten.step_euler(&forces(pull, torques), step_s).unwrap();
            step += 1;
        }
        tips.push([ten.q[0], ten.q[1]]);
    }
    tips
}

/// Greatest distance of the tip of the thesis's simulation from the rig's, m.
fn thesis_against_rig_m(layout: Layout, locked: Option<Joint>, step_s: f64, dead_band: f64) -> f64 {
    let release = Release::of(layout, locked);
    let run = release.run().unwrap();
    let mut yields_nm = [0.0; 4];
    for joint in layout.brakes() {
        let fit = torque_gain_fit(*joint);
        let at_full_current = locked == Some(*joint);
        yields_nm[*joint as usize] = if at_full_current {
            fit.greatest_nm()
        } else {
            fit.off_state_nm()
        };
    }
    let samples: Vec<_> = run.iter().skip(20).step_by(20).collect();
    let times: Vec<f64> = samples.iter().map(|sample| sample.time_s).collect();
    thesis_run(&release, yields_nm, step_s, dead_band, &times)
        .into_iter()
        .zip(samples)
        .fold(0.0, |most: f64, (tip_m, sample)| {
            most.max(apart_m(tip_m, sample.tip_m))
        })
}

//= thesis (5.68) test
#[test]
fn the_thesis_simulation_converges_to_the_rig() {
    // Yields are constant where no brake but A, which has no backlash, has a current.
    for (layout, locked) in [
        (Layout::ThreeBrake, None),
        (Layout::ThreeBrake, Some(Joint::A)),
        (Layout::FourBrake, None),
        (Layout::FourBrake, Some(Joint::A)),
    ] {
        let [coarse_m, fine_m] = [(1e-3, 1e-3), (6.25e-5, 6.25e-5)]
            .map(|(step_s, dead_band)| thesis_against_rig_m(layout, locked, step_s, dead_band));
        println!(
            "{layout:?}, locked {locked:?}: {coarse_m:e} m at 1 ms and 1e-3 rad/s, {fine_m:e} m at a sixteenth of both"
        );
        assert!(coarse_m < 1e-3 && coarse_m > 1e-5, "{coarse_m:e} m");
        assert!(fine_m < coarse_m / 6.0, "{coarse_m:e} m, {fine_m:e} m");
    }
}

#[test]
fn a_dead_band_lets_a_stuck_joint_creep() {
    let layout = Layout::FourBrake;
    let (arms, inertia) = (arms(layout), inertia(layout));
    let pose = inverse::pose(&arms, [0.023, 0.391]).unwrap();
    let yields_nm = [7.53, 5.94, 6.13, 5.88];
    let (pull, dead_band) = ([3.7, 10.3], 0.01);
    // All four brakes locked under 11 N, the base joints left with 0.7 of the dead band.
    let mut ten = TenCoordinates::new(&arms, &inertia, &pose, [0.007, 0.007]);
    let mut rule = KarnoppBrakes::new(dead_band);
    let mut held = [false; 4];
    for _ in 0..5000 {
        let joints = joints(&ten.equations(), pull).unwrap();
        let rates = JOINTS.map(|j| ten.q_dot[j]);
        let torques;
        (torques, held) = rule.torques_nm(&joints, rates, yields_nm);
        ten.step_euler(&forces(pull, torques), 1e-3).unwrap();
    }
    let crept_m = apart_m([ten.q[0], ten.q[1]], pose.tip_m);
    println!("{:.1} mm in 5 s, held {held:?}", crept_m * 1e3);
    assert!(crept_m > 0.003, "{crept_m} m");

    let parameters = Parameters::of(layout);
    let mut rig = Rig::moving(
        parameters,
        [pose.theta_a_rad, pose.theta_b_rad],
        [0.007, 0.007],
    )
    .unwrap();
    let mut stops = Vec::new();
    for _ in 0..5000 {
        rig.step(pull, [1.0; 4], 1e-3).unwrap();
        stops.push(rig.tip_m());
    }
    assert_eq!(stops[4999], stops[2000], "a rig that stands moves");
    assert_eq!(rig.stuck(), [true; 4]);
}
