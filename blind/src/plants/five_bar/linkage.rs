//! This file closes the five-bar by intersecting two circles, and says how each arm and joint turns with θA and θB.

use rigproof_spec::geometry::{AngleRange, AngleRanges, Arms};
use rigproof_spec::units::RAD_PER_DEG;
use std::f64::consts::TAU;

/// A vector of the plane, or a pair of the coordinates (θA, θB).
pub type Pair = [f64; 2];

/// The scalar product.
pub fn dot([a, b]: Pair, [c, d]: Pair) -> f64 {
    a * c + b * d
}

/// The third component of the vector product.
pub fn cross([a, b]: Pair, [c, d]: Pair) -> f64 {
    a * d - b * c
}

/// The vector after a quarter turn to the left.
pub fn turned([a, b]: Pair) -> Pair {
    [-b, a]
}

/// `a + factor·b`.
pub fn plus([a, b]: Pair, factor: f64, [c, d]: Pair) -> Pair {
    [a + factor * c, b + factor * d]
}

/// Where the arms are.
#[derive(Clone, Copy, Debug)]
pub struct Pose {
    /// The tip D, m.
    pub tip_m: Pair,
    /// Unit vectors along AE, ED, BC and CD.
    pub along: [Pair; 4],
    /// Rates of these four arms per rate of θA and of θB.
    pub turns: [Pair; 4],
    /// Rates of the joints A, E, B, C per rate of θA and of θB.
    pub rows: [Pair; 4],
}

impl Pose {
    /// The pose at θA and θB, rad, the tip on the far side of the base; `None` where the arms do not meet.
    pub fn at(arms: &Arms, [theta_a, theta_b]: Pair) -> Option<Pose> {
        let (sine_a, cosine_a) = libm::sincos(theta_a);
        let (sine_b, cosine_b) = libm::sincos(theta_b);
        let (ae, bc) = ([cosine_a, sine_a], [cosine_b, sine_b]);
        let half = 0.5 * arms.l_ab_m;
        let e = plus([-half, 0.0], arms.l_ae_m, ae);
        let c = plus([half, 0.0], arms.l_bc_m, bc);
        // The circle of ED about E and that of CD about C.
        let base = plus(c, -1.0, e);
        let square = dot(base, base);
        let (ed_square, cd_square) = (arms.l_ed_m * arms.l_ed_m, arms.l_cd_m * arms.l_cd_m);
        let share = 0.5 * (1.0 + (ed_square - cd_square) / square);
        let height_square = ed_square / square - share * share;
        // The comparison is false for what is no number, too.
        let reaches = height_square > 0.0;
        if !reaches {
            return None;
        }
        let tip_m = plus(plus(e, share, base), height_square.sqrt(), turned(base));
        let ed = plus(tip_m, -1.0, e).map(|x| x / arms.l_ed_m);
        let cd = plus(tip_m, -1.0, c).map(|x| x / arms.l_cd_m);
        // The tip's velocity by either way round, along CD and along ED.
        let closing = cross(ed, cd);
        let (from_a, from_b) = (arms.l_ae_m, arms.l_bc_m);
        let ed_turns = [
            -from_a * cross(ae, cd) / (arms.l_ed_m * closing),
            from_b * cross(bc, cd) / (arms.l_ed_m * closing),
        ];
        let cd_turns = [
            -from_a * cross(ae, ed) / (arms.l_cd_m * closing),
            from_b * cross(bc, ed) / (arms.l_cd_m * closing),
        ];
        Some(Pose {
            tip_m,
            along: [ae, ed, bc, cd],
            turns: [[1.0, 0.0], ed_turns, [0.0, 1.0], cd_turns],
            rows: [
                [1.0, 0.0],
                plus(ed_turns, -1.0, [1.0, 0.0]),
                [0.0, 1.0],
                plus(cd_turns, -1.0, [0.0, 1.0]),
            ],
        })
    }

    /// θA, θE, θB and θC, rad; θE and θC between −π and π.
    pub fn joint_angles_rad(&self, [theta_a, theta_b]: Pair) -> [f64; 4] {
        let [ae, ed, bc, cd] = self.along;
        let angle = |from, to| libm::atan2(cross(from, to), dot(from, to));
        [theta_a, angle(ae, ed), theta_b, angle(bc, cd)]
    }

    /// Whether every angle is in its range of table 4.2, where no stop is touched.
    pub fn is_within(&self, ranges: &AngleRanges, theta: Pair) -> bool {
        let [_, ed, _, cd] = self.along;
        let [a, e, b, c] = self.joint_angles_rad(theta);
        let d = libm::atan2(cross(ed, cd), dot(ed, cd));
        let inside = |angle_rad: f64, range: AngleRange| {
            (range.least_deg..=range.greatest_deg).contains(&(angle_rad / RAD_PER_DEG))
        };
        // θE is counted from 0° to 360°.
        inside(a, ranges.a)
            && inside(e + TAU, ranges.e)
            && inside(b, ranges.b)
            && inside(c, ranges.c)
            && inside(d, ranges.d)
    }

    /// The tip's velocity, m/s, at rates of θA and θB.
    pub fn tip_velocity(&self, arms: &Arms, rates: Pair) -> Pair {
        let [ae, ed, _, _] = self.along;
        let [ae_turns, ed_turns, _, _] = self.turns;
        plus(
            turned(ae).map(|x| x * arms.l_ae_m * dot(ae_turns, rates)),
            arms.l_ed_m * dot(ed_turns, rates),
            turned(ed),
        )
    }

    /// What a force on the tip, N, does along θA and θB, N·m.
    pub fn tip_force_along(&self, arms: &Arms, force_n: Pair) -> Pair {
        let [ae, ed, _, _] = self.along;
        let [ae_turns, ed_turns, _, _] = self.turns;
        plus(
            ae_turns.map(|x| x * arms.l_ae_m * dot(turned(ae), force_n)),
            arms.l_ed_m * dot(turned(ed), force_n),
            ed_turns,
        )
    }

    /// The force on the tip, N, that does the same as generalised forces along θA and θB, N·m.
    pub fn tip_force_of(&self, arms: &Arms, generalised_nm: Pair) -> Pair {
        let [xa, xb] = self.tip_force_along(arms, [1.0, 0.0]);
        let [ya, yb] = self.tip_force_along(arms, [0.0, 1.0]);
        let [a, b] = generalised_nm;
        let determinant = xa * yb - xb * ya;
        [
            (a * yb - b * ya) / determinant,
            (b * xa - a * xb) / determinant,
        ]
    }
}

/// θA and θB of a tip position, rad, arm AE to the left and arm BC to the right; `None` out of reach.
pub fn angles_of_tip(arms: &Arms, tip_m: Pair) -> Option<Pair> {
    let half = 0.5 * arms.l_ab_m;
    let arm = |base: f64, first: f64, second: f64, side: f64| {
        let [x, y] = plus(tip_m, -1.0, [base, 0.0]);
        let reach = x.hypot(y);
        let cosine = (first * first + reach * reach - second * second) / (2.0 * first * reach);
        (cosine.abs() < 1.0).then(|| libm::atan2(y, x) + side * libm::acos(cosine))
    };
    Some([
        arm(-half, arms.l_ae_m, arms.l_ed_m, 1.0)?,
        arm(half, arms.l_bc_m, arms.l_cd_m, -1.0)?,
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_spec::geometry::arms;
    use rigproof_spec::layout::Layout;

    #[test]
    fn the_tip_is_where_it_was_asked_for_and_every_rate_is_a_derivative() {
        for layout in [Layout::ThreeBrake, Layout::FourBrake] {
            let arms = arms(layout);
            for tip_m in [[0.031, 0.417], [-0.073, 0.352], [0.094, 0.463]] {
                let theta = angles_of_tip(&arms, tip_m).unwrap();
                let pose = Pose::at(&arms, theta).unwrap();
                assert!((pose.tip_m[0] - tip_m[0]).hypot(pose.tip_m[1] - tip_m[1]) < 1e-14);
                let rates = [0.83, -0.57];
                let step_s = 1e-6;
                let at = |time_s: f64| {
                    let theta = plus(theta, time_s, rates);
                    let pose = Pose::at(&arms, theta).unwrap();
                    (pose.tip_m, pose.joint_angles_rad(theta))
                };
                let ((tip_0, angles_0), (tip_1, angles_1)) = (at(-step_s), at(step_s));
                let moved = plus(tip_1, -1.0, tip_0).map(|x| x / (2.0 * step_s));
                let velocity = pose.tip_velocity(&arms, rates);
                assert!((moved[0] - velocity[0]).hypot(moved[1] - velocity[1]) < 1e-8);
                for (k, row) in pose.rows.iter().enumerate() {
                    let rate = (angles_1[k] - angles_0[k]) / (2.0 * step_s);
                    assert!((rate - dot(*row, rates)).abs() < 1e-8, "joint {k}");
                }
                let force = [3.7, -5.9];
                let work = dot(pose.tip_force_along(&arms, force), rates);
                assert!((work - dot(force, velocity)).abs() < 1e-12);
                let back = pose.tip_force_of(&arms, pose.tip_force_along(&arms, force));
                assert!((back[0] - force[0]).hypot(back[1] - force[1]) < 1e-10);
            }
        }
    }

    #[test]
    fn where_the_arms_do_not_meet_there_is_no_pose() {
        let arms = arms(Layout::FourBrake);
        assert!(Pose::at(&arms, [3.1, 0.04]).is_none());
        assert!(angles_of_tip(&arms, [0.3, 0.71]).is_none());
    }

    #[test]
    fn on_three_brakes_joints_e_and_c_turn_alike() {
        let arms = arms(Layout::ThreeBrake);
        let pose = Pose::at(&arms, [2.07, 0.81]).unwrap();
        let [_, e, _, c] = pose.rows;
        assert!((e[0] + c[0]).abs() < 1e-12 && (e[1] + c[1]).abs() < 1e-12);
    }
}
