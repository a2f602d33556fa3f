//! This file holds single steps, and many of them, against the same scheme written with the reference's functions.

use nalgebra::Vector2;
use rigproof_impl::plant::motion::{Mechanism, Motion};
use rigproof_impl::plant::{Outcome, Scheme};
use rigproof_impl::vector::Vector;
use rigproof_model::linkage::forward;
use rigproof_model::motion::two_coordinate::{solve, two_coordinate};

use crate::budget::assert_within_budget;
use crate::impl_plant::rigs::{Draw, campaign};

#[test]
fn a_free_step_is_the_scheme_worked_with_the_references_functions() {
    let mut draw = Draw::new(6007);
    let (mut places, mut rates) = (Vec::new(), Vec::new());
    let mut kind = 0;
    while places.len() < campaign(20_000) {
        kind += 1;
        let (arms, inertia) = (draw.arms(kind), draw.inertia());
        let theta = Vector2::new(draw.between(1.1, 2.9), draw.between(-0.1, 1.9));
        let v = Vector2::new(draw.between(-3.1, 3.1), draw.between(-3.1, 3.1));
        let force = [draw.between(-31.0, 31.0), draw.between(-31.0, 31.0)];
        let step_s = draw.between(1e-4, 2e-3);
        let scheme = [Scheme::Midpoint, Scheme::SemiImplicitEuler][kind / 3 % 2];
        let lead_s = if scheme == Scheme::Midpoint {
            0.5 * step_s
        } else {
            0.0
        };
        let middle = theta + v * lead_s;
        let Ok(pose) = forward::pose(&arms, middle.x, middle.y) else {
            continue;
        };
        let sines =
            [pose.theta_e_rad, pose.theta_c_rad, pose.theta_d_rad].map(|a| libm::sin(a).abs());
        let own = Mechanism::<f64>::new(&arms, &inertia, scheme);
        let start = Motion::new(&own, Vector::new(theta.x, theta.y), Vector::new(v.x, v.y));
        let (Some(mut motion), false) = (start, sines.into_iter().any(|sine| sine < 0.17)) else {
            continue;
        };
        // Nothing foreseen on the first step: the bias is that of the old rates.
        let form = two_coordinate(&arms, &inertia, &pose, v.into());
        let after = v + solve(&form.mass, &form.drive(force)) * step_s;
        let end = middle + after * (step_s - lead_s);
        if motion.step_free(&own, force.into(), step_s) != Outcome::Moved {
            continue;
        }
        let off = motion.theta_rad - Vector::new(end.x, end.y);
        places.push(off.norm());
        let off = motion.rates_rad_s - Vector::new(after.x, after.y);
        rates.push(off.norm() / (v.norm() + (after - v).norm()));
        let (sine, cosine) = libm::sincos(end.x);
        assert!((motion.ae - Vector::new(cosine, sine)).norm() < 3e-15);
    }
    assert_within_budget("plant_step_place", places);
    assert_within_budget("plant_step_rate", rates);
}

#[test]
fn the_directions_follow_their_angles_through_a_million_steps() {
    let mut draw = Draw::new(719);
    let mut ae: Vector<f64> = Vector::new(libm::cos(2.17), libm::sin(2.17));
    let (mut theta_rad, mut apart_rad) = (2.17, 0.0);
    let mut seen_rad = 2.17;
    for _ in 0..1_000_000 {
        let angle_rad = draw.between(-4e-3, 4e-3);
        let before = ae;
        ae = rigproof_impl::plant::turn::renormalised(rigproof_impl::plant::turn::turned(
            ae, angle_rad,
        ));
        let [by_rad, _] = rigproof_impl::plant::turn::angles_between([before; 2], [ae; 2]);
        seen_rad += by_rad;
        theta_rad += angle_rad;
        let (sine, cosine) = libm::sincos(theta_rad);
        let off = ae.cross(Vector::new(cosine, sine));
        apart_rad = f64::max(apart_rad, off.abs());
    }
    let counted_rad = (seen_rad - theta_rad).abs();
    println!(
        "directions {apart_rad:e} rad, counted angle {counted_rad:e} rad from the sum of the angles"
    );
    assert!(
        apart_rad < 6e-13 && counted_rad < 6e-13,
        "{apart_rad:e} {counted_rad:e}"
    );
    assert!((ae.norm() - 1.0).abs() < 5e-16);
}
