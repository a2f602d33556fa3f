//! This file makes the same rig twice, as the reference and as the plant.

use rigproof_impl::plant::{Outcome, Parameters, Plant, Scheme};
use rigproof_model::rig::Rig;
use rigproof_spec::layout::Layout;

/// Both layouts.
pub const LAYOUTS: [Layout; 2] = [Layout::ThreeBrake, Layout::FourBrake];

/// A point near the middle of a layout's workspace, m.
pub fn middle_m(layout: Layout) -> [f64; 2] {
    match layout {
        Layout::ThreeBrake => [0.013, 0.417],
        Layout::FourBrake => [0.017, 0.389],
    }
}

/// The plant where a rig at rest stands.
pub fn plant_of(rig: &Rig, scheme: Scheme) -> Plant {
    let parameters = Parameters {
        scheme,
        ..Parameters::of(rig.parameters().layout)
    };
    Plant::new(
        &parameters,
        rig.base_angles_rad(),
        rig.base_rates_rad_s(),
        &[],
    )
    .unwrap()
}

/// Advances by a time in steps of a length, the force drawn anew at every step, s.
pub fn advance(
    plant: &mut Plant,
    force: impl Fn(f64) -> [f64; 2],
    currents_a: [f64; 4],
    [from_s, time_s, step_s]: [f64; 3],
) {
    let steps = libm::round(time_s / step_s) as u32;
    for k in 0..steps {
        let middle_s = from_s + (f64::from(k) + 0.5) * step_s;
        let outcome = plant.step(force(middle_s), currents_a, step_s);
        assert_eq!(outcome, Outcome::Moved);
    }
}

/// The greatest difference between joint angles, rad.
pub fn apart_rad(plant: &Plant, rig: &Rig) -> f64 {
    let pairs = plant
        .joint_angles_rad()
        .into_iter()
        .zip(rig.joint_angles_rad());
    pairs.fold(0.0, |most, (one, other)| {
        f64::max(most, (one - other).abs())
    })
}
