//! This file tells both implementations the same sample.

use nalgebra::Vector2;
use rigproof_impl::actuation::Actuation as RigActuation;
use rigproof_impl::law::{AnyLaw, Situation};
use rigproof_impl::linkage::{Shape, linkage};
use rigproof_impl::number::Real;
use rigproof_impl::path::{self as rig_path, AnyPath};
use rigproof_impl::vector::Vector;
use rigproof_model::ModelError;
use rigproof_model::control::path::{Arc, Line, Nearest, Path, Polyline, Spline};
use rigproof_model::control::{
    Actuation, Controller, Impedance, Obstacle, Optimal, Proportional, Sdof, Sensed, Side,
    Uncontrolled, VelocityRatio, Virtual, Weights, tip_mass,
};
use rigproof_model::linkage::{Pose, forward, jacobian::jacobian};
use rigproof_model::motion::two_coordinate::two_coordinate;
use rigproof_model::rig::Parameters;
use rigproof_spec::command::Command;
use rigproof_spec::inertia::inertia;

use super::tick::{PathKind, Tick};
use crate::built_in::{BuiltIn, Kind};
use crate::declared::Solid;
use crate::way::MOST_PIECES;

/// How the reference is shown its path: as it is, or nudged, or as the rig's code sees it.
#[derive(Clone, Copy, Debug)]
pub enum View {
    /// As it is, further off and turned by so much.
    Nudged {
        /// Added to the distance, m.
        offset_m: f64,
        /// Added to the tangent's direction, rad.
        turn_rad: f64,
    },
    /// Whatever is asked, this.
    Given(Nearest),
}

impl View {
    /// As it is.
    pub const EXACT: View = View::Nudged {
        offset_m: 0.0,
        turn_rad: 0.0,
    };
}

/// A path of the reference, and how it is shown.
#[derive(Debug)]
pub struct Seen(pub Box<dyn Path>, pub View);

impl Path for Seen {
    fn nearest(&self, point_m: [f64; 2]) -> Nearest {
        match self.1 {
            View::Given(nearest) => nearest,
            View::Nudged { offset_m, turn_rad } => {
                let nearest = self.0.nearest(point_m);
                let left = Vector2::new(-nearest.tangent.y, nearest.tangent.x);
                Nearest {
                    offset_m: nearest.offset_m + offset_m,
                    tangent: nearest.tangent + left * turn_rad,
                    ..nearest
                }
            }
        }
    }
}

/// The reference's path.
///
/// # Errors
/// A point or a number outside what the reference takes.
pub fn reference_path(kind: &PathKind) -> Result<Box<dyn Path>, ModelError> {
    Ok(match kind {
        PathKind::Line([from_m, to_m]) => Box::new(Line::through(*from_m, *to_m)?),
        PathKind::Arc(centre_m, [radius_m, start_rad, sweep_rad]) => {
            Box::new(Arc::new(*centre_m, *radius_m, *start_rad, *sweep_rad)?)
        }
        PathKind::Polyline(corners_m, false) => Box::new(Polyline::open(corners_m)?),
        PathKind::Polyline(corners_m, true) => Box::new(Polyline::closed(corners_m)?),
        PathKind::Spline(points_m) => Box::new(Spline::through(points_m)?),
    })
}

/// What the reference is told; `None` where it knows no pose.
pub fn sensed(tick: &Tick) -> Option<Sensed> {
    at_pose(tick, pose(tick)?)
}

fn pose(tick: &Tick) -> Option<Pose> {
    let [theta_a_rad, theta_b_rad] = tick.base_rad;
    forward::pose(&tick.arms, theta_a_rad, theta_b_rad).ok()
}

fn at_pose(tick: &Tick, pose: Pose) -> Option<Sensed> {
    let j = jacobian(&tick.arms, &pose).ok()?;
    Some(Sensed {
        pose,
        tip_velocity_m_s: tick.velocity_m_s,
        omega_rad_s: (j * Vector2::from(tick.velocity_m_s)).into(),
        tip_force_n: tick.force_n,
    })
}

/// What the reference makes of a sample: pose, the tip's velocity by its Jacobian, push. The tick is told; `None` where there is no pose.
pub fn sense(
    tick: &mut Tick,
    base_rad: [f64; 2],
    rates_rad_s: [f64; 2],
    force_n: [f64; 2],
) -> Option<Sensed> {
    (tick.base_rad, tick.force_n) = (base_rad, force_n);
    let pose = pose(tick)?;
    let form = two_coordinate(&tick.arms, &inertia(tick.layout), &pose, rates_rad_s);
    tick.velocity_m_s = form.tip_velocity_m_s(rates_rad_s);
    at_pose(tick, pose)
}

/// Where the tip is, m.
pub fn reference_tip(tick: &Tick) -> Option<[f64; 2]> {
    sensed(tick).map(|sensed| sensed.pose.tip_m)
}

/// The rows of the Jacobian, 1/m.
pub fn reference_rows(tick: &Tick) -> Option<Vec<Vector2<f64>>> {
    let j = jacobian(&tick.arms, &sensed(tick)?.pose).ok()?;
    Some(j.row_iter().map(|row| row.transpose()).collect())
}

/// How the tip lies to the path.
pub fn reference_nearest(tick: &Tick) -> Option<Nearest> {
    let tip_m = reference_tip(tick)?;
    Some(reference_path(&tick.path).ok()?.nearest(tip_m))
}

/// How far the tip is from the path, m.
pub fn reference_distance_m(tick: &Tick) -> Option<f64> {
    Some(reference_nearest(tick)?.distance_m())
}

/// The reference's controller, its path seen as told.
///
/// # Errors
/// A setting outside what the reference takes.
pub fn reference(tick: &Tick, view: View) -> Result<Box<dyn Controller>, ModelError> {
    let actuation = Actuation::new(tick.layout, tick.arms, tick.limit_n)?;
    let path = || Ok(Seen(reference_path(&tick.path)?, view));
    // A law without a path is not compared on one that is refused.
    path()?;
    let boundary_m = tick.boundary_m;
    let inner: Box<dyn Controller> = match tick.law {
        Kind::Uncontrolled => Box::new(Uncontrolled),
        Kind::Sdof { gap_m } => Box::new(Sdof::new(actuation, path()?, boundary_m, gap_m)?),
        Kind::Proportional { gain_n_s_per_m } => Box::new(Proportional::new(
            actuation,
            path()?,
            boundary_m,
            gain_n_s_per_m,
        )?),
        Kind::VelocityRatio { gain_nm_s_per_rad } => Box::new(VelocityRatio::new(
            actuation,
            path()?,
            boundary_m,
            gain_nm_s_per_rad,
        )?),
        Kind::Optimal {
            weight_angle,
            weight_energy,
            horizon_s,
        } => {
            let weights = Weights {
                angle: weight_angle,
                energy: weight_energy,
                horizon_s,
            };
            let parameters = parameters(tick);
            let mass = move |pose: &_| tip_mass(&parameters, pose);
            Box::new(Optimal::new(actuation, path()?, boundary_m, weights, mass)?)
        }
        Kind::Impedance {
            stiffness_n_per_m,
            damping_across_n_s_per_m,
            damping_along_n_s_per_m,
        } => {
            let elements = Virtual {
                stiffness_n_per_m,
                damping_across_n_s_per_m,
                damping_along_n_s_per_m,
            };
            Box::new(Impedance::new(actuation, path()?, elements)?)
        }
    };
    Ok(match tick.obstacle {
        None => inner,
        Some(Solid::Left) => Box::new(Obstacle::new(path()?, Side::Left, inner)),
        Some(Solid::Right) => Box::new(Obstacle::new(path()?, Side::Right, inner)),
    })
}

/// The bodies of the rig, for the reference.
pub fn parameters(tick: &Tick) -> Parameters {
    Parameters {
        layout: tick.layout,
        arms: tick.arms,
        inertia: inertia(tick.layout),
    }
}

/// What the reference asks for; `None` where it knows no pose, or takes no such settings.
pub fn reference_command(tick: &Tick, view: View) -> Option<Command> {
    Some(reference(tick, view).ok()?.command(&sensed(tick)?))
}

/// The rig's path.
pub fn rig_path<R: Real>(kind: &PathKind) -> Option<AnyPath<R, MOST_PIECES>> {
    Some(match kind {
        PathKind::Line([from_m, to_m]) => AnyPath::Line(rig_path::Line::through(*from_m, *to_m)?),
        PathKind::Arc(centre_m, [radius_m, start_rad, sweep_rad]) => AnyPath::Arc(
            rig_path::Arc::new(*centre_m, *radius_m, *start_rad, *sweep_rad)?,
        ),
        PathKind::Polyline(corners_m, false) => {
            AnyPath::Polyline(rig_path::Polyline::open(corners_m)?)
        }
        PathKind::Polyline(corners_m, true) => {
            AnyPath::Polyline(rig_path::Polyline::closed(corners_m)?)
        }
        PathKind::Spline(points_m) => AnyPath::Spline(rig_path::Spline::through(points_m)?),
    })
}

/// What the rig's code is told.
pub fn situation<R: Real>(tick: &Tick) -> Situation<R> {
    let shape = Shape::new(&tick.arms);
    let [ae, bc] = tick.base_rad.map(|angle_rad| {
        let (sine, cosine) = libm::sincos(angle_rad);
        Vector::new(R::of(cosine), R::of(sine))
    });
    let linkage = linkage(&shape, ae, bc);
    Situation {
        linkage,
        rows: linkage.rows(),
        tip_velocity_m_s: tick.velocity_m_s.map(R::of).into(),
        tip_force_n: tick.force_n.map(R::of).into(),
    }
}

/// The rig's law; `None` for settings it does not take.
pub fn rig_law<R: Real>(tick: &Tick) -> Option<AnyLaw<R, AnyPath<R, MOST_PIECES>>> {
    let law = BuiltIn {
        law: tick.law,
        boundary_m: tick.boundary_m,
        obstacle: tick.obstacle,
    };
    let actuation = RigActuation::new(tick.layout, &tick.arms, tick.limit_n)?;
    law.on(actuation, rig_path(&tick.path)?, &tick.arms, tick.layout)
}
