//! This file simulates a release as the thesis did: ten coordinates, Euler steps of 1 ms, and the rules (5.66) to (5.68).

use rigproof_model::ModelError;
use rigproof_model::linkage::inverse;
use rigproof_model::motion::coordinates::{JOINTS, forces};
use rigproof_model::motion::stick::{KarnoppBrakes, joints};
use rigproof_model::motion::ten_coordinates::TenCoordinates;
use rigproof_model::rig::release::Release;
use rigproof_spec::geometry::arms;
use rigproof_spec::inertia::inertia;
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::torque_gain_fit;

/// The "very small angular velocity" of (5.67), rad/s; the text gives none.
const DEAD_BAND_RAD_S: f64 = 1e-3;

/// Whether the yield torques of a release are constant, so that these rules need no model of the brake: no brake with
/// backlash has a current.
pub fn applies(release: &Release) -> bool {
    matches!(release.locked, None | Some(Joint::A))
}

/// The tip at the release and after each sample, m.
pub fn tips_m(release: &Release, samples: usize) -> Result<Vec<[f64; 2]>, ModelError> {
    let (arms, inertia) = (arms(release.layout), inertia(release.layout));
    let pose = inverse::pose(&arms, release.start_m)?;
    let mut ten = TenCoordinates::new(&arms, &inertia, &pose, [0.0; 2]);
    let mut rule = KarnoppBrakes::new(DEAD_BAND_RAD_S);
    let yields_nm = Joint::ALL.map(|joint| {
        let fit = torque_gain_fit(joint);
        match release.layout.brakes().contains(&joint) {
            false => 0.0,
            true if release.locked == Some(joint) => fit.greatest_nm(),
            true => fit.off_state_nm(),
        }
    });
    let mut tips_m = vec![pose.tip_m];
    while tips_m.len() < samples {
        let rates = JOINTS.map(|j| ten.q_dot.get(j).copied().unwrap_or(f64::NAN));
        let pull_n = release.pull_n(tip_m(&ten));
        let joints = joints(&ten.equations(), pull_n)?;
        let (torques_nm, _) = rule.torques_nm(&joints, rates, yields_nm);
        ten.step_euler(&forces(pull_n, torques_nm), release.sample_s)?;
        tips_m.push(tip_m(&ten));
    }
    Ok(tips_m)
}

fn tip_m(ten: &TenCoordinates) -> [f64; 2] {
    [0, 1].map(|i| ten.q.get(i).copied().unwrap_or(f64::NAN))
}
