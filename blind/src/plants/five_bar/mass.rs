//! This file weighs the five-bar in the coordinates (θA, θB): Lagrange's equations from the masses of the arms.

use super::linkage::{Pair, Pose, dot, plus, turned};
use rigproof_spec::geometry::Arms;
use rigproof_spec::inertia::Inertia;

/// The mass matrix and the velocity-dependent forces at one pose and rate: `M·q̈ + bias = Q`.
#[derive(Clone, Copy, Debug)]
pub struct Dynamics {
    /// Entries 11, 12 and 22, kg·m².
    pub mass: [f64; 3],
    /// N·m.
    pub bias: Pair,
}

/// A mass with an inertia at a distance along an arm that another arm may carry.
struct Body {
    mass_kg: f64,
    inertia_kg_m2: f64,
    /// Length of the carrying arm and distance along the own one, m.
    reach_m: [f64; 2],
    /// Which of AE, ED, BC, CD is the carrying arm and which the own one.
    arms: [usize; 2],
}

/// The four arms and the payload. A base arm is carried by itself at no distance.
fn bodies(arms: &Arms, inertia: &Inertia) -> [Body; 5] {
    let body = |arm: rigproof_spec::inertia::ArmInertia, carried_m: f64, arms: [usize; 2]| Body {
        mass_kg: arm.mass_kg,
        inertia_kg_m2: arm.inertia_kg_m2,
        reach_m: [carried_m, arm.centre_m],
        arms,
    };
    [
        body(inertia.ae, 0.0, [0, 0]),
        body(inertia.ed, arms.l_ae_m, [0, 1]),
        body(inertia.bc, 0.0, [2, 2]),
        body(inertia.cd, arms.l_bc_m, [2, 3]),
        Body {
            mass_kg: inertia.payload_kg,
            inertia_kg_m2: 0.0,
            reach_m: [arms.l_ae_m, arms.l_ed_m],
            arms: [0, 1],
        },
    ]
}

impl Dynamics {
    /// The form at a pose with rates of θA and θB, rad/s.
    #[expect(clippy::indexing_slicing, reason = "bodies name arms by 0 to 3")]
    pub fn new(arms: &Arms, inertia: &Inertia, pose: &Pose, rates: Pair) -> Dynamics {
        let speeds = pose.turns.map(|turns| dot(turns, rates));
        let drifts = drifts(arms, pose, speeds);
        let mut mass = [0.0; 3];
        let mut bias = [0.0; 2];
        for body in bodies(arms, inertia) {
            let [carrier, own] = body.arms;
            let [carried_m, own_m] = body.reach_m;
            let (g, h) = (pose.turns[carrier], pose.turns[own]);
            let (u, w) = (pose.along[carrier], pose.along[own]);
            let coupled = body.mass_kg * carried_m * own_m * dot(u, w);
            let first = body.mass_kg * carried_m * carried_m;
            let second = body.mass_kg * own_m * own_m + body.inertia_kg_m2;
            mass[0] += first * g[0] * g[0] + second * h[0] * h[0] + 2.0 * coupled * g[0] * h[0];
            mass[1] +=
                first * g[0] * g[1] + second * h[0] * h[1] + coupled * (g[0] * h[1] + g[1] * h[0]);
            mass[2] += first * g[1] * g[1] + second * h[1] * h[1] + 2.0 * coupled * g[1] * h[1];
            // The acceleration that the mass has without any of θA and θB; base arms have no drift.
            let inward = u.map(|x| -x * carried_m * speeds[carrier] * speeds[carrier]);
            let inward = plus(inward, -own_m * speeds[own] * speeds[own], w);
            let drift = plus(inward, own_m * drifts[own], turned(w));
            bias = plus(bias, body.mass_kg * carried_m * dot(turned(u), drift), g);
            bias = plus(
                bias,
                body.mass_kg * own_m * dot(turned(w), drift) + body.inertia_kg_m2 * drifts[own],
                h,
            );
        }
        Dynamics { mass, bias }
    }

    /// `M·x`.
    pub fn times(&self, [x, y]: Pair) -> Pair {
        let [m11, m12, m22] = self.mass;
        [m11 * x + m12 * y, m12 * x + m22 * y]
    }

    /// `M⁻¹·x`.
    pub fn solve(&self, [x, y]: Pair) -> Pair {
        let [m11, m12, m22] = self.mass;
        let determinant = m11 * m22 - m12 * m12;
        [
            (m22 * x - m12 * y) / determinant,
            (m11 * y - m12 * x) / determinant,
        ]
    }
}

/// What a field that accelerates every mass alike, m/s², does along θA and θB, N·m.
#[expect(clippy::indexing_slicing, reason = "bodies name arms by 0 to 3")]
pub fn weight(arms: &Arms, inertia: &Inertia, pose: &Pose, field: Pair) -> Pair {
    bodies(arms, inertia).iter().fold([0.0; 2], |sum, body| {
        let [carrier, own] = body.arms;
        let [carried_m, own_m] = body.reach_m;
        let along = |arm: usize| dot(turned(pose.along[arm]), field);
        let sum = plus(
            sum,
            body.mass_kg * carried_m * along(carrier),
            pose.turns[carrier],
        );
        plus(sum, body.mass_kg * own_m * along(own), pose.turns[own])
    })
}

/// Angular accelerations of the arms at constant rates of θA and θB: the tip accelerates alike by either way round.
fn drifts(arms: &Arms, pose: &Pose, speeds: [f64; 4]) -> [f64; 4] {
    let [ae, ed, bc, cd] = pose.along;
    let [ae_speed, ed_speed, bc_speed, cd_speed] = speeds.map(|x| x * x);
    let left = plus(
        ae.map(|x| x * arms.l_ae_m * ae_speed),
        arms.l_ed_m * ed_speed,
        ed,
    );
    let right = plus(
        bc.map(|x| x * arms.l_bc_m * bc_speed),
        arms.l_cd_m * cd_speed,
        cd,
    );
    // −left + l_ed·φ̈·⟂ed = −right + l_cd·φ̈·⟂cd, along cd and along ed.
    let difference = plus(left, -1.0, right);
    let closing = ed[0] * cd[1] - ed[1] * cd[0];
    [
        0.0,
        dot(difference, cd) / (arms.l_ed_m * closing),
        0.0,
        dot(difference, ed) / (arms.l_cd_m * closing),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_spec::geometry::arms;
    use rigproof_spec::inertia::inertia;
    use rigproof_spec::layout::Layout;

    /// The closed form of the 3-brake layout, a rhombus: the arms that carry the tip stay parallel to the base arms.
    #[test]
    fn three_brakes_weigh_what_the_parallelogram_does() {
        let (arms, inertia) = (arms(Layout::ThreeBrake), inertia(Layout::ThreeBrake));
        let [theta_a, theta_b] = [2.03, 0.77];
        let pose = Pose::at(&arms, [theta_a, theta_b]).unwrap();
        let rates = [0.9, -1.3];
        let form = Dynamics::new(&arms, &inertia, &pose, rates);
        // By hand from table 5.1: I + m·l² of the arms that turn with θA, and of those with θB.
        let first =
            0.0661 + 3.70 * 0.166 * 0.166 + 2.74 * 0.305 * 0.305 + 0.0355 + 2.59 * 0.188 * 0.188;
        let second =
            0.0336 + 2.74 * 0.096 * 0.096 + 0.0355 + 2.62 * 0.109 * 0.109 + 2.59 * 0.305 * 0.305;
        let coupling = 0.305 * (2.74 * 0.096 + 2.59 * 0.188);
        let (sine, cosine) = libm::sincos(theta_a - theta_b);
        assert!((form.mass[0] - first).abs() < 1e-12);
        assert!((form.mass[1] - coupling * cosine).abs() < 1e-12);
        assert!((form.mass[2] - second).abs() < 1e-12);
        assert!((form.bias[0] - coupling * sine * rates[1] * rates[1]).abs() < 1e-12);
        assert!((form.bias[1] + coupling * sine * rates[0] * rates[0]).abs() < 1e-12);
    }

    /// `bias = Ṁ·q̇ − ½·∂(q̇ᵀMq̇)/∂q`, by differences of the mass matrix.
    #[test]
    fn the_bias_is_lagranges() {
        let (arms, inertia) = (
            arms(Layout::FourBrake),
            Inertia {
                payload_kg: 0.37,
                ..inertia(Layout::FourBrake)
            },
        );
        let theta = [2.11, 1.02];
        let rates = [1.3, 0.7];
        let mass = |theta: Pair| {
            let pose = Pose::at(&arms, theta).unwrap();
            Dynamics::new(&arms, &inertia, &pose, rates)
        };
        let step = 1e-6;
        let along = |direction: Pair, x: Pair| {
            let ahead = mass(plus(theta, step, direction)).times(x);
            plus(ahead, -1.0, mass(plus(theta, -step, direction)).times(x))
                .map(|x| x / (2.0 * step))
        };
        let gradient = [[1.0, 0.0], [0.0, 1.0]].map(|axis| 0.5 * dot(rates, along(axis, rates)));
        let expected = plus(along(rates, rates), -1.0, gradient);
        let bias = mass(theta).bias;
        assert!(
            (bias[0] - expected[0]).abs() < 1e-8,
            "{bias:?} {expected:?}"
        );
        assert!(
            (bias[1] - expected[1]).abs() < 1e-8,
            "{bias:?} {expected:?}"
        );
    }
}
