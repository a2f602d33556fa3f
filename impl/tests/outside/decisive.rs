//! This file says where laws begin to decide: a tip that stands, links of which one is too fast, arms close to one line, arms of different length.

use rigproof_impl::actuation::Actuation;
use rigproof_impl::law::{Law, Situation, VelocityRatio};
use rigproof_impl::linkage::{Linkage, Shape, linkage};
use rigproof_impl::path::Line;
use rigproof_impl::vector::Vector;
use rigproof_spec::geometry::arms;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::STANDING_TIP_M_S;

const LAYOUT: Layout = Layout::FourBrake;

fn unit(angle_rad: f64) -> Vector<f64> {
    Vector::new(libm::cos(angle_rad), libm::sin(angle_rad))
}

/// The tip in the middle of the workspace, at a velocity, m/s.
fn moving(tip_velocity_m_s: Vector<f64>) -> Situation<f64> {
    let linkage = linkage(&Shape::new(&arms(LAYOUT)), unit(2.17), unit(0.83));
    Situation {
        linkage,
        rows: linkage.rows(),
        tip_velocity_m_s,
        tip_force_n: Vector::new(1.9, 2.3),
    }
}

#[test]
fn a_tip_stands_below_the_least_velocity_and_nowhere_else() {
    let decisive = |speed_m_s: f64| {
        moving(Vector::new(0.0, -speed_m_s))
            .decisive_velocity_m_s()
            .norm()
    };
    for below in [0.0, 0.1 * STANDING_TIP_M_S, 0.999 * STANDING_TIP_M_S] {
        assert_eq!(decisive(below), 0.0);
    }
    for from in [STANDING_TIP_M_S, 1.001 * STANDING_TIP_M_S, 1e-9, 0.1] {
        assert_eq!(decisive(from), from);
    }
}

/// Whether a brake at a joint slows one link and speeds up the other; `rows` are the joint's, the fast link's and the other's.
fn couples([own, fast, other]: [Vector<f64>; 3], velocity_m_s: Vector<f64>) -> bool {
    // The joint's rate is so much of the one link's and so much of the other's; a brake is against it.
    let of_fast = own.cross(other) / fast.cross(other);
    let of_other = fast.cross(own) / fast.cross(other);
    let torque = -own.dot(velocity_m_s).signum();
    torque * of_fast * fast.dot(velocity_m_s) < -1e-9
        && torque * of_other * other.dot(velocity_m_s) > 1e-9
}

#[test]
fn one_link_that_is_too_fast_is_slowed_alone_only_where_no_coupling_brake_helps() {
    let line = Line::through([-0.113, 0.383], [0.107, 0.412]).unwrap();
    let mut law = VelocityRatio::new(Actuation::thesis(LAYOUT), line, 0.023, 1.7).unwrap();
    let (mut coupled, mut alone) = (0, 0);
    for step in 0..360 {
        let now = moving(unit(f64::from(step) * 0.01745 + 0.003) * 0.13);
        let [of_a, of_e, of_b, of_c] = now.rows;
        let acts = law.command(&now).currents_a.map(|current| current > 0.0);
        let (fast, other) = match acts {
            [true, false, false, false] => (of_a, of_b),
            [false, false, true, false] => (of_b, of_a),
            [false, e, false, c] => {
                coupled += usize::from(e != c);
                continue;
            }
            _ => continue,
        };
        alone += 1;
        for own in [of_e, of_c] {
            assert!(
                !couples([own, fast, other], now.tip_velocity_m_s),
                "{now:?}"
            );
        }
    }
    assert!(coupled > 20 && alone > 20, "{coupled} {alone}");
}

#[test]
fn arms_of_different_length_keep_their_lengths() {
    let mut own = arms(LAYOUT);
    own.l_ed_m += 0.031;
    let closed = linkage(&Shape::new(&own), unit(2.17), unit(0.83));
    assert!((closed.ed.norm() - own.l_ed_m).abs() < 1e-15);
    assert!((closed.cd.norm() - own.l_cd_m).abs() < 1e-15);
}

#[test]
fn arms_ae_and_ed_on_one_line_are_a_singularity_on_both_sides_of_it() {
    let (arms, shape) = (arms(LAYOUT), Shape::new(&arms(LAYOUT)));
    let sine = |closed: &Linkage<f64>| closed.ae.cross(closed.ed) / (arms.l_ae_m * arms.l_ed_m);
    let mut met = 0;
    for of_bc in (0..50).map(|step| 0.05 * f64::from(step)) {
        let at = |of_ae: f64| linkage(&shape, unit(of_ae), unit(of_bc));
        // A hundredth of a radian, either way, in which AE and ED, sound before, go through one line.
        let crosses = |[from, to]: &[f64; 2]| {
            at(*from).is_sound(&shape) && sine(&at(*from)) < -1e-3 && sine(&at(*to)) > 1e-3
        };
        let steps = (0..600).map(|step| 0.01 * f64::from(step));
        let steps = steps.flat_map(|from| [[from, from + 0.01], [from, from - 0.01]]);
        for [from, to] in steps.filter(crosses) {
            met += 1;
            for (wanted, is_sound) in [(-1e-3, true), (-2e-5, true), (-5e-6, false), (5e-6, false)]
            {
                let (mut before, mut beyond) = (from, to);
                for _ in 0..60 {
                    let middle = 0.5 * (before + beyond);
                    if sine(&at(middle)) < wanted {
                        before = middle;
                    } else {
                        beyond = middle;
                    }
                }
                assert_eq!(at(before).is_sound(&shape), is_sound, "{wanted}");
            }
        }
    }
    assert!(met > 0);
}
