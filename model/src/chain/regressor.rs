//! This file says how efforts and momenta of an arm hang on the inertial numbers of its links: linearly.

use super::inertial::cross;
use super::{Chain, INERTIAL, Kind, Pose};
use nalgebra::{DMatrix, Matrix3, SMatrix, Vector3};

/// How the joints' momenta, and what stands beside their rates of change, hang on the inertial numbers.
///
/// The effort is `d/dt(momentum·π) + rest·π`, π the numbers: with a test function only the first derivative of positions is needed.
#[derive(Clone, Debug)]
pub struct Momentum {
    /// Generalised momentum `∂T/∂q̇`: a row a joint, ten columns a link.
    pub momentum: DMatrix<f64>,
    /// `−∂T/∂q + ∂V/∂q`: the same shape.
    pub rest: DMatrix<f64>,
}

/// A force above a moment about the origin of the base, a column an inertial number.
type Wrenches = SMatrix<f64, 6, INERTIAL>;

/// The tensor times a vector, by its six numbers.
fn tensor_times(v: &Vector3<f64>) -> SMatrix<f64, 3, 6> {
    SMatrix::<f64, 3, 6>::new(
        v.x, v.y, v.z, 0.0, 0.0, 0.0, //
        0.0, v.x, 0.0, v.y, v.z, 0.0, //
        0.0, 0.0, v.x, 0.0, v.y, v.z,
    )
}

/// Columns given in a link's axes about its origin, in those of the base about the base's origin.
fn in_base(
    pose: &Pose,
    force: SMatrix<f64, 3, INERTIAL>,
    moment: SMatrix<f64, 3, INERTIAL>,
) -> Wrenches {
    let force = pose.rotation * force;
    let moment = pose.rotation * moment + cross(&pose.origin) * force;
    let mut both = Wrenches::zeros();
    both.fixed_view_mut::<3, INERTIAL>(0, 0).copy_from(&force);
    both.fixed_view_mut::<3, INERTIAL>(3, 0).copy_from(&moment);
    both
}

/// Force and moment columns from the factors of mass, first moments and tensor.
fn columns(
    mass: Vector3<f64>,
    first: [Matrix3<f64>; 2],
    tensor: SMatrix<f64, 3, 6>,
) -> (SMatrix<f64, 3, INERTIAL>, SMatrix<f64, 3, INERTIAL>) {
    let mut force = SMatrix::<f64, 3, INERTIAL>::zeros();
    let mut moment = SMatrix::<f64, 3, INERTIAL>::zeros();
    let [of_force, of_moment] = first;
    force.fixed_view_mut::<3, 1>(0, 0).copy_from(&mass);
    force.fixed_view_mut::<3, 3>(0, 1).copy_from(&of_force);
    moment.fixed_view_mut::<3, 3>(0, 1).copy_from(&of_moment);
    moment.fixed_view_mut::<3, 6>(0, 4).copy_from(&tensor);
    (force, moment)
}

fn momentum_of(pose: &Pose) -> Wrenches {
    let back = pose.rotation.transpose();
    let (w, v) = (back * pose.turning, back * pose.velocity);
    let (force, moment) = columns(v, [cross(&w), -cross(&v)], tensor_times(&w));
    in_base(pose, force, moment)
}

/// The rate of change of a body's momentum under this acceleration of its origin.
fn rate_of(pose: &Pose, acceleration: Vector3<f64>) -> Wrenches {
    let back = pose.rotation.transpose();
    let (w, dw, a) = (
        back * pose.turning,
        back * pose.turning_faster,
        back * acceleration,
    );
    let spin = cross(&w);
    let tensor = tensor_times(&dw) + spin * tensor_times(&w);
    let (force, moment) = columns(a, [cross(&dw) + spin * spin, -cross(&a)], tensor);
    in_base(pose, force, moment)
}

/// The row of a wrench that a joint feels.
fn felt(kind: Kind, axis: &Vector3<f64>, origin: &Vector3<f64>, own: &Wrenches) -> [f64; INERTIAL] {
    let force = own.fixed_view::<3, INERTIAL>(0, 0);
    let row = match kind {
        Kind::Prismatic => axis.transpose() * force,
        Kind::Revolute => {
            axis.transpose() * (own.fixed_view::<3, INERTIAL>(3, 0) - cross(origin) * force)
        }
    };
    core::array::from_fn(|k| row[k])
}

impl Chain {
    /// How the efforts of a motion hang on the inertial numbers: a row a joint, ten columns a link.
    pub fn regressor(&self, q: &[f64], speed: &[f64], acceleration: &[f64]) -> DMatrix<f64> {
        let poses = self.poses(q, speed, acceleration);
        let each = poses
            .iter()
            .map(|pose| rate_of(pose, pose.acceleration - self.gravity));
        let each: Vec<Wrenches> = each.collect();
        self.projected(&each, |joint, own| {
            felt(
                self.kind(joint),
                &poses[joint].axis,
                &poses[joint].origin,
                own,
            )
        })
    }

    /// How momenta and what stands beside them hang on the inertial numbers.
    pub fn momentum(&self, q: &[f64], speed: &[f64]) -> Momentum {
        let poses = self.poses(q, speed, &[]);
        let momenta: Vec<Wrenches> = poses.iter().map(momentum_of).collect();
        let weights = poses.iter().map(|pose| {
            let down = -(pose.rotation.transpose() * self.gravity);
            let (force, moment) =
                columns(down, [Matrix3::zeros(), -cross(&down)], SMatrix::zeros());
            in_base(pose, force, moment)
        });
        let weights: Vec<Wrenches> = weights.collect();
        let momentum = self.projected(&momenta, |joint, own| {
            felt(
                self.kind(joint),
                &poses[joint].axis,
                &poses[joint].origin,
                own,
            )
        });
        // The axis turns with the link before, and its origin moves: d/dt(s·P) = s·dP/dt + ds/dt·P.
        let of_axis = self.projected(&momenta, |joint, own| {
            let (kind, pose) = (self.kind(joint), &poses[joint]);
            let turned = felt(kind, &pose.carried.cross(&pose.axis), &pose.origin, own);
            if kind == Kind::Prismatic {
                return turned;
            }
            let force = own.fixed_view::<3, INERTIAL>(0, 0);
            let moved = pose.axis.transpose() * (cross(&pose.velocity) * force);
            core::array::from_fn(|k| turned[k] - moved[k])
        });
        let weight = self.projected(&weights, |joint, own| {
            felt(
                self.kind(joint),
                &poses[joint].axis,
                &poses[joint].origin,
                own,
            )
        });
        Momentum {
            momentum,
            rest: weight - of_axis,
        }
    }

    fn kind(&self, joint: usize) -> Kind {
        self.joints[joint].kind
    }

    /// A row a joint: what it feels of its own link and of those beyond.
    fn projected(
        &self,
        each: &[Wrenches],
        row: impl Fn(usize, &Wrenches) -> [f64; INERTIAL],
    ) -> DMatrix<f64> {
        let count = self.joints.len();
        let mut all = DMatrix::zeros(count, INERTIAL * count);
        for joint in 0..count {
            for (link, own) in each.iter().enumerate().skip(joint) {
                for (k, value) in row(joint, own).into_iter().enumerate() {
                    all[(joint, INERTIAL * link + k)] = value;
                }
            }
        }
        all
    }
}
