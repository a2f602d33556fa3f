//! This file says that a plant is made of what a rig can be made of, and of nothing else.

use rigproof_impl::plant::{Parameters, Plant};
use rigproof_spec::layout::Layout;
use rigproof_spec::tables::BrakeTable;

fn is_made(change: impl FnOnce(&mut Parameters)) -> bool {
    let mut parameters = Parameters::of(Layout::FourBrake);
    change(&mut parameters);
    Plant::new(&parameters, [2.17, 0.83], [0.31, -0.17], &[]).is_some()
}

fn of_a_brake(place: usize, change: impl FnOnce(&mut BrakeTable)) -> bool {
    is_made(|parameters| change(parameters.brakes[place].as_mut().unwrap()))
}

#[test]
fn lengths_and_masses_of_no_linkage_are_refused() {
    assert!(is_made(|_| {}));
    for bad in [f64::NAN, f64::INFINITY, -0.37] {
        assert!(!is_made(|of| of.arms.l_ae_m = bad), "{bad}");
        assert!(!is_made(|of| of.arms.l_cd_m = bad), "{bad}");
        assert!(!is_made(|of| of.arms.l_ab_m = bad), "{bad}");
        assert!(!is_made(|of| of.inertia.payload_kg = bad), "{bad}");
        assert!(!is_made(|of| of.inertia.ae.mass_kg = bad), "{bad}");
        assert!(!is_made(|of| of.inertia.cd.mass_kg = bad), "{bad}");
        assert!(!is_made(|of| of.inertia.ed.inertia_kg_m2 = bad), "{bad}");
        assert!(!is_made(|of| of.inertia.bc.inertia_kg_m2 = bad), "{bad}");
    }
    for bad in [f64::NAN, f64::INFINITY] {
        assert!(!is_made(|of| of.inertia.ed.centre_m = bad), "{bad}");
    }
    assert!(!is_made(|of| of.inertia.ae.inertia_kg_m2 = 0.0));
    // Without a base arm all sines are still there.
    assert!(!is_made(|of| of.arms.l_ae_m = 0.0));
    assert!(!is_made(|of| of.arms.l_ed_m = 0.0));
    assert!(!is_made(|of| of.arms.l_bc_m = 0.0));
    assert!(!is_made(|of| of.arms.l_cd_m = 0.0));
    assert!(is_made(|of| {
        of.inertia.ed.mass_kg = 0.0;
        of.inertia.payload_kg = 0.0;
        of.inertia.bc.centre_m = -0.11;
    }));
}

#[test]
fn brakes_that_drive_or_have_no_range_are_refused() {
    for place in 0..4 {
        assert!(of_a_brake(place, |table| table.backlash_width_deg = 0.0));
        for bad in [f64::NAN, f64::INFINITY, -0.13] {
            assert!(!of_a_brake(place, |table| table.torque_gain.k_2 = bad));
            assert!(!of_a_brake(place, |table| table.backlash_width_deg = bad));
            assert!(!of_a_brake(place, |table| table.current_range_a[0] = bad));
            assert!(!of_a_brake(place, |table| table.speed_range_rpm[0] = bad));
            assert!(!of_a_brake(place, |table| table.speed_range_rpm[1] = bad));
        }
        assert!(!of_a_brake(place, |table| table.backlash_width_deg = 361.0));
        // An off-state torque beyond the greatest one; no greatest one.
        assert!(!of_a_brake(place, |table| table.torque_gain.k_2 = 9.7));
        assert!(!of_a_brake(place, |table| table.torque_gain.k_3 = f64::INFINITY));
        assert!(!of_a_brake(place, |table| table.current_range_a = [0.0, 1.0]));
        assert!(!of_a_brake(place, |table| table.current_range_a = [1.1, 1.0]));
        assert!(!of_a_brake(place, |table| table.speed_range_rpm[0] = 0.0));
    }
}
