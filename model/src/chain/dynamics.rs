//! This file says where the links of an arm are, how they move, and what efforts that takes, by the recursive Newton-Euler method (Luh, Walker and Paul 1980).

use super::{Chain, Joint, Kind};
use nalgebra::{DMatrix, Matrix3, Vector3};

/// Where a joint's frame is and how it moves, everything in the axes of the base.
#[derive(Clone, Copy, Debug)]
pub struct Pose {
    /// The axes of the frame.
    pub rotation: Matrix3<f64>,
    /// Its origin, m.
    pub origin: Vector3<f64>,
    /// The joint's axis.
    pub axis: Vector3<f64>,
    /// Rate of turning, rad/s.
    pub turning: Vector3<f64>,
    /// Velocity of the origin, m/s.
    pub velocity: Vector3<f64>,
    /// Acceleration of turning, rad/s².
    pub turning_faster: Vector3<f64>,
    /// Acceleration of the origin, m/s².
    pub acceleration: Vector3<f64>,
    /// Rate of turning of the link before: the axis turns with it.
    pub carried: Vector3<f64>,
}

/// A rotation by an angle about an axis of length 1, rad.
pub(super) fn turned(axis: &Vector3<f64>, angle: f64) -> Matrix3<f64> {
    let (sin, cos) = libm::sincos(angle);
    let arm = super::inertial::cross(axis);
    Matrix3::identity() + sin * arm + (1.0 - cos) * arm * arm
}

impl Joint {
    fn next(&self, before: &Pose, [q, speed, acceleration]: [f64; 3]) -> Pose {
        let frame = before.rotation * self.rotation;
        let axis = frame * self.axis;
        let (turn, slide) = match self.kind {
            Kind::Revolute => (q, 0.0),
            Kind::Prismatic => (0.0, q),
        };
        let arm = before.rotation * self.origin + slide * axis;
        let (w, dw) = (before.turning, before.turning_faster);
        let velocity = before.velocity + w.cross(&arm);
        let moved = before.acceleration + dw.cross(&arm) + w.cross(&w.cross(&arm));
        let mut pose = Pose {
            rotation: frame * turned(&self.axis, turn),
            origin: before.origin + arm,
            axis,
            turning: w,
            velocity,
            turning_faster: dw,
            acceleration: moved,
            carried: w,
        };
        match self.kind {
            Kind::Revolute => {
                pose.turning += speed * axis;
                pose.turning_faster += acceleration * axis + speed * w.cross(&axis);
            }
            Kind::Prismatic => {
                pose.velocity += speed * axis;
                pose.acceleration += acceleration * axis + 2.0 * speed * w.cross(&axis);
            }
        }
        pose
    }
}

impl Chain {
    /// Where each joint's frame is and how it moves, from positions, speeds and accelerations of the joints; one that is missing is 0.
    pub fn poses(&self, q: &[f64], speed: &[f64], acceleration: &[f64]) -> Vec<Pose> {
        let zero = Vector3::zeros();
        let mut before = Pose {
            rotation: Matrix3::identity(),
            origin: zero,
            axis: zero,
            turning: zero,
            velocity: zero,
            turning_faster: zero,
            acceleration: zero,
            carried: zero,
        };
        let of = |values: &[f64], k: usize| values.get(k).copied().unwrap_or(0.0);
        let each = self.joints.iter().enumerate().map(|(k, joint)| {
            before = joint.next(&before, [of(q, k), of(speed, k), of(acceleration, k)]);
            before
        });
        each.collect()
    }

    /// The efforts of the joints that a motion takes, without friction: N·m or N.
    pub fn efforts(&self, q: &[f64], speed: &[f64], acceleration: &[f64]) -> Vec<f64> {
        let poses = self.poses(q, speed, acceleration);
        let mut force = Vector3::zeros();
        let mut moment = Vector3::zeros();
        let mut efforts = Vec::with_capacity(poses.len());
        let mut further: Option<Vector3<f64>> = None;
        for (k, (joint, pose)) in self.joints.iter().zip(&poses).enumerate().rev() {
            if let Some(next) = further {
                // What the further links take, about this origin.
                moment += (next - pose.origin).cross(&force);
            }
            let own = &joint.inertial;
            let first = pose.rotation * own.first;
            let second = pose.rotation * own.second * pose.rotation.transpose();
            let (w, dw) = (pose.turning, pose.turning_faster);
            let fall = pose.acceleration - self.gravity;
            force += own.mass * fall + dw.cross(&first) + w.cross(&w.cross(&first));
            moment += second * dw + w.cross(&(second * w)) + first.cross(&fall);
            let rotor = joint.armature * acceleration.get(k).copied().unwrap_or(0.0);
            efforts.push(match joint.kind {
                Kind::Revolute => pose.axis.dot(&moment) + rotor,
                Kind::Prismatic => pose.axis.dot(&force) + rotor,
            });
            further = Some(pose.origin);
        }
        efforts.reverse();
        efforts
    }

    /// The matrix of masses: a column is what one joint's acceleration alone takes, at rest and without weight.
    pub fn mass_matrix(&self, q: &[f64]) -> DMatrix<f64> {
        let count = self.joints.len();
        let mut weightless = self.clone();
        weightless.gravity = Vector3::zeros();
        let mut masses = DMatrix::zeros(count, count);
        for k in 0..count {
            let mut one = vec![0.0; count];
            if let Some(slot) = one.get_mut(k) {
                *slot = 1.0;
            }
            let column = weightless.efforts(q, &vec![0.0; count], &one);
            masses.column_mut(k).copy_from_slice(&column);
        }
        masses
    }

    /// Kinetic and potential energy, J.
    pub fn energy(&self, q: &[f64], speed: &[f64]) -> [f64; 2] {
        let (mut kinetic, mut potential) = (0.0, 0.0);
        let poses = self.poses(q, speed, &[]).into_iter();
        for (k, (joint, pose)) in self.joints.iter().zip(poses).enumerate() {
            let spin = speed.get(k).copied().unwrap_or(0.0);
            kinetic += 0.5 * joint.armature * spin * spin;
            let own = &joint.inertial;
            let first = pose.rotation * own.first;
            let second = pose.rotation * own.second * pose.rotation.transpose();
            let (v, w) = (pose.velocity, pose.turning);
            kinetic +=
                0.5 * own.mass * v.dot(&v) + v.dot(&w.cross(&first)) + 0.5 * w.dot(&(second * w));
            potential -= self.gravity.dot(&(first + own.mass * pose.origin));
        }
        [kinetic, potential]
    }
}
