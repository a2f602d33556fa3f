//! This file sets a command beside what the reference decides on the same sample, and says which differences are ties.

use std::cell::Cell;
use std::rc::Rc;

use nalgebra::Vector2;
use rigproof_model::ModelError;
use rigproof_model::control::path::{Arc, Line, Nearest, Path, Polyline, Spline};
use rigproof_model::control::{
    Actuation, Controller, Obstacle, Proportional, Sdof, Sensed, Side, Uncontrolled,
};
use rigproof_model::linkage::{forward, jacobian::jacobian};
use rigproof_model::motion::two_coordinate::two_coordinate;
use rigproof_spec::geometry::{Arms, arms};
use rigproof_spec::inertia::{Inertia, inertia};
use rigproof_spec::laws::Margin;
use rigproof_spec::layout::Layout;

use crate::built_in::{BuiltIn, Kind};
use crate::controller::Task;
use crate::declared::Solid;

/// Of so many samples one is set beside the reference.
pub const EVERY: u32 = 16;
/// Currents that count as equal, A (decision 0071).
const EQUAL_A: f64 = 1e-8;
/// How far from a nudged answer a current may lie, A.
const AMONG_A: f64 = 1e-7;
/// Nudges: shares of push and rates, rad of the base angles; far below what a sensor tells apart.
const NUDGES: [f64; 3] = [1e-14, 1e-12, 1e-10];

/// How near to the path a tip may count as on it, m: what two computations of a distance differ by.
const ON_PATH_M: f64 = 1e-11;

/// The reference's controller on the reference's path.
pub struct Reference {
    controller: Box<dyn Controller>,
    /// Whether what is all but on the path counts as on it.
    is_snapped: Rc<Cell<bool>>,
    arms: Arms,
    inertia: Inertia,
}

/// What both decide by.
#[derive(Clone, Copy)]
pub struct Told {
    /// θA and θB, rad.
    pub theta_rad: [f64; 2],
    /// Their rates, rad/s.
    pub rates_rad_s: [f64; 2],
    /// The push, N.
    pub force_n: [f64; 2],
}

impl Reference {
    /// The reference of a law of table 6.1; `None` for other laws, whose ties have exceptions of their own (decisions 0071, 0117).
    pub fn new(law: &BuiltIn, layout: Layout, task: &Task) -> Option<Reference> {
        let is_snapped = Rc::new(Cell::new(false));
        Some(Reference {
            controller: controller(law, layout, task, &is_snapped).ok()??,
            is_snapped,
            arms: arms(layout),
            inertia: inertia(layout),
        })
    }

    /// The reference's currents, A; `None` where it knows no pose.
    fn currents_a(&mut self, told: &Told) -> Option<[f64; 4]> {
        let [theta_a, theta_b] = told.theta_rad;
        let pose = forward::pose(&self.arms, theta_a, theta_b).ok()?;
        let form = two_coordinate(&self.arms, &self.inertia, &pose, told.rates_rad_s);
        let velocity = form.tip_velocity_m_s(told.rates_rad_s);
        let rows = jacobian(&self.arms, &pose).ok()?;
        let command = self.controller.command(&Sensed {
            pose,
            tip_velocity_m_s: velocity,
            omega_rad_s: (rows * Vector2::from(velocity)).into(),
            tip_force_n: told.force_n,
        });
        Some(command.currents_a)
    }

    /// How a command lies to the reference's; `None` where that knows no pose.
    ///
    /// A tie is a sample in which the reference itself takes the command when what it is told is nudged within rounding, or when a tip that
    /// is all but on the path counts as on it, which no nudge meets.
    pub fn margin(&mut self, told: &Told, currents_a: [f64; 4]) -> Option<Margin> {
        let apart_a = apart(self.currents_a(told)?, currents_a);
        if apart_a <= EQUAL_A {
            return Some(Margin(EQUAL_A - apart_a));
        }
        let is_tie = [false, true].into_iter().any(|is_snapped| {
            self.is_snapped.set(is_snapped);
            self.is_near(told, currents_a)
        });
        self.is_snapped.set(false);
        Some(Margin(if is_tie { 0.0 } else { -apart_a }))
    }

    /// Whether the reference takes a command when what it is told is nudged.
    fn is_near(&mut self, told: &Told, currents_a: [f64; 4]) -> bool {
        NUDGES.into_iter().any(|size| {
            (0..64).any(|signs| {
                let nudged = self.currents_a(&nudged(told, size, signs));
                nudged.is_some_and(|nudged| apart(nudged, currents_a) <= AMONG_A)
            })
        })
    }
}

fn controller(
    law: &BuiltIn,
    layout: Layout,
    task: &Task,
    is_snapped: &Rc<Cell<bool>>,
) -> Result<Option<Box<dyn Controller>>, ModelError> {
    let actuation = Actuation::thesis(layout);
    let path = || -> Result<Snapping, ModelError> {
        Ok(Snapping {
            path: path(task)?,
            is_snapped: Rc::clone(is_snapped),
        })
    };
    let inner: Box<dyn Controller> = match law.law {
        Kind::Uncontrolled => Box::new(Uncontrolled),
        Kind::Sdof { gap_m } => Box::new(Sdof::new(actuation, path()?, law.boundary_m, gap_m)?),
        Kind::Proportional { gain_n_s_per_m } => Box::new(Proportional::new(
            actuation,
            path()?,
            law.boundary_m,
            gain_n_s_per_m,
        )?),
        _ => return Ok(None),
    };
    Ok(Some(match law.obstacle {
        None => inner,
        Some(Solid::Left) => Box::new(Obstacle::new(path()?, Side::Left, inner)),
        Some(Solid::Right) => Box::new(Obstacle::new(path()?, Side::Right, inner)),
    }))
}

/// A path on which a tip may count as standing that is all but on it.
#[derive(Debug)]
struct Snapping {
    path: Box<dyn Path>,
    is_snapped: Rc<Cell<bool>>,
}

impl Path for Snapping {
    fn nearest(&self, point_m: [f64; 2]) -> Nearest {
        let nearest = self.path.nearest(point_m);
        let is_on = self.is_snapped.get() && nearest.distance_m() <= ON_PATH_M;
        Nearest {
            offset_m: if is_on { 0.0 } else { nearest.offset_m },
            ..nearest
        }
    }
}

/// The path in the reference's own code.
fn path(task: &Task) -> Result<Box<dyn Path>, ModelError> {
    Ok(match task {
        Task::Chain(points) => match points.as_slice() {
            [from_m, to_m] => Box::new(Line::through(*from_m, *to_m)?),
            points => Box::new(Polyline::open(points)?),
        },
        Task::Arc {
            centre_m,
            radius_m,
            from_rad,
            to_rad,
        } => Box::new(Arc::new(
            *centre_m,
            *radius_m,
            *from_rad,
            to_rad - from_rad,
        )?),
        Task::Spline(points) => Box::new(Spline::through(points)?),
    })
}

/// What is told, each number nudged up or down.
fn nudged(told: &Told, size: f64, signs: u8) -> Told {
    let sign = |bit: u8| if signs & (1 << bit) == 0 { 1.0 } else { -1.0 };
    let [theta_a, theta_b] = told.theta_rad;
    let [rate_a, rate_b] = told.rates_rad_s;
    let [x, y] = told.force_n;
    let moved = |value: f64, bit: u8| value + size * sign(bit) * (value.abs() + 1e-3);
    Told {
        theta_rad: [theta_a + size * sign(0), theta_b + size * sign(1)],
        rates_rad_s: [moved(rate_a, 2), moved(rate_b, 3)],
        force_n: [moved(x, 4), moved(y, 5)],
    }
}

/// The greatest difference of two commands, A; that of what is no number is infinite.
fn apart(one_a: [f64; 4], other_a: [f64; 4]) -> f64 {
    one_a
        .into_iter()
        .zip(other_a)
        .map(|(one, other)| (one - other).abs())
        .fold(0.0, |greatest: f64, apart| {
            if apart <= greatest {
                greatest
            } else if apart.is_nan() {
                f64::INFINITY
            } else {
                apart
            }
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_spec::methods::Method;

    #[test]
    fn a_tip_on_the_path_is_a_tie_and_a_wrong_command_is_none() {
        let task = Task::Chain(vec![[0.0, 0.29], [0.0, 0.45]]);
        let law = BuiltIn::of(Method::Sdof);
        let mut reference = Reference::new(&law, Layout::FourBrake, &task).unwrap();
        let mut holds = |theta_rad: [f64; 2], currents_a: [f64; 4]| {
            let (rates_rad_s, force_n) = ([0.31, -0.23], [1.7, 2.9]);
            let told = Told {
                theta_rad,
                rates_rad_s,
                force_n,
            };
            let own_a = reference.currents_a(&told).unwrap();
            let is_own = reference.margin(&told, own_a).unwrap().holds();
            (is_own, reference.margin(&told, currents_a).unwrap().holds())
        };
        // The linkage is its own mirror image: the tip is on the path, where no brake acts.
        let mirrored = [2.17, core::f64::consts::PI - 2.17];
        assert_eq!(holds(mirrored, [0.0; 4]), (true, true));
        assert_eq!(holds(mirrored, [0.0, 0.31, 0.0, 0.0]), (true, false));
        let beside = [2.11, 0.93];
        assert_eq!(holds(beside, [0.0; 4]), (true, false));
        assert_eq!(holds(beside, [f64::NAN; 4]), (true, false));
    }

    #[test]
    fn only_laws_of_table_6_1_have_a_reference_here() {
        let task = Task::Spline(vec![[0.01, 0.31], [0.07, 0.37], [-0.03, 0.43]]);
        for method in Method::ALL {
            let law = BuiltIn::of(method);
            assert!(Reference::new(&law, Layout::ThreeBrake, &task).is_some());
        }
        let law = BuiltIn {
            law: Kind::VelocityRatio {
                gain_nm_s_per_rad: 1.7,
            },
            ..BuiltIn::of(Method::Sdof)
        };
        assert!(Reference::new(&law, Layout::ThreeBrake, &task).is_none());
    }
}
