//! This file says with what force each joint's bearing holds its arms together, which load-dependent friction follows.

use rigproof_spec::inertia::{ArmInertia, Inertia};

use super::acceleration::Acceleration;
use super::coordinates::Ten;

/// The forces of the bearings A, E, B, C on the arm beyond each joint, x and y, N.
///
/// | symbol | here | unit |
/// |---|---|---|
/// | q, q̇, q̈, λ | `q`, `q_dot`, `acceleration`, as (5.42) and (5.52) | m, rad and per s, per s²; N |
///
/// By (5.52) the multipliers of C₁ and C₂ are the force of the tip on arm ED, those of C₅ and C₆ minus what moves its mass; Newton's law
/// for the arms gives the rest.
pub fn reactions_n(
    inertia: &Inertia,
    q: &Ten,
    q_dot: &Ten,
    acceleration: &Acceleration,
) -> [[f64; 2]; 4] {
    let [[_, _, theta_a, _, _, _, theta_b, ..]] = q.data.0;
    let [[_, _, rate_a, _, _, _, rate_b, ..]] = q_dot.data.0;
    let [[_, _, change_a, _, _, _, change_b, ..]] = acceleration.q_ddot.data.0;
    let [[l_1, l_2, l_3, l_4, l_5, l_6, l_7, l_8]] = acceleration.lambda.data.0;
    let at_e = [-l_1 - l_5, -l_2 - l_6];
    let at_c = [-l_3 - l_7, -l_4 - l_8];
    let at_base = |arm: &ArmInertia, [theta, rate, change]: [f64; 3], [x, y]: [f64; 2]| {
        let (sin, cos) = libm::sincos(theta);
        let reach = arm.mass_kg * arm.centre_m;
        [
            x + reach * (-change * sin - rate * rate * cos),
            y + reach * (change * cos - rate * rate * sin),
        ]
    };
    [
        at_base(&inertia.ae, [theta_a, rate_a, change_a], at_e),
        at_e,
        at_base(&inertia.bc, [theta_b, rate_b, change_b], at_c),
        at_c,
    ]
}

#[cfg(test)]
mod tests {
    use super::super::acceleration::equations;
    use super::super::coordinates::{coordinates, forces, rates};
    use super::super::two_coordinate::two_coordinate;
    use super::*;
    use crate::linkage::forward;
    use rigproof_spec::geometry::arms;
    use rigproof_spec::inertia::inertia;
    use rigproof_spec::layout::Layout;

    fn cross([a_x, a_y]: [f64; 2], [b_x, b_y]: [f64; 2]) -> f64 {
        a_x * b_y - a_y * b_x
    }

    #[test]
    fn the_reactions_turn_the_first_arms_and_hold_the_whole() {
        for layout in [Layout::ThreeBrake, Layout::FourBrake] {
            let (arms, own) = (arms(layout), inertia(layout));
            let pose = forward::pose(&arms, 2.07, 1.13).unwrap();
            let turning = [0.83, -1.37];
            let form = two_coordinate(&arms, &own, &pose, turning);
            let (q, q_dot) = (coordinates(&arms, &own, &pose), rates(&form, turning));
            let (tip_n, torques_nm) = ([7.3, -11.9], [-0.41, 0.73, -1.31, 0.57]);
            let result = equations(&arms, &own, &q, &q_dot)
                .acceleration(&forces(tip_n, torques_nm))
                .unwrap();
            let reactions = reactions_n(&own, &q, &q_dot, &result);
            let [[x, y, theta_a, _, x_ed, y_ed, theta_b, _, x_cd, y_cd]] = result.q_ddot.data.0;
            // An arm turns about its pin by its brake's torque less that of the next, and by what it gives to the next arm.
            let [at_a, at_e, at_b, at_c] = reactions;
            for (arm, length, angle, change, next, torque) in [
                (
                    own.ae,
                    arms.l_ae_m,
                    2.07,
                    theta_a,
                    at_e,
                    torques_nm[0] - torques_nm[1],
                ),
                (
                    own.bc,
                    arms.l_bc_m,
                    1.13,
                    theta_b,
                    at_c,
                    torques_nm[2] - torques_nm[3],
                ),
            ] {
                let to_next = [length * libm::cos(angle), length * libm::sin(angle)];
                let moment = arm.inertia_kg_m2 + arm.mass_kg * arm.centre_m * arm.centre_m;
                let off = torque - cross(to_next, next) - moment * change;
                assert!(off.abs() < 1e-12, "{layout:?}: {off} N·m");
            }
            // The bearings of the base and the tip force move every mass.
            let centre = |arm: &ArmInertia, angle: f64, rate: f64, change: f64| {
                let (sin, cos) = libm::sincos(angle);
                [
                    arm.mass_kg * arm.centre_m * (-change * sin - rate * rate * cos),
                    arm.mass_kg * arm.centre_m * (change * cos - rate * rate * sin),
                ]
            };
            let ae = centre(&own.ae, 2.07, turning[0], theta_a);
            let bc = centre(&own.bc, 1.13, turning[1], theta_b);
            let far = [[x_ed, x_cd, x], [y_ed, y_cd, y]];
            for axis in 0..2 {
                let [ed, cd, tip] = far[axis];
                let masses = own.ed.mass_kg * ed + own.cd.mass_kg * cd + own.payload_kg * tip;
                let off = at_a[axis] + at_b[axis] + tip_n[axis] - masses - ae[axis] - bc[axis];
                assert!(off.abs() < 1e-12, "{layout:?}: {off} N");
            }
        }
    }
}
