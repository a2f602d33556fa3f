//! This file tells both implementations the same tick.

use nalgebra::Vector2;
use rigproof_impl::actuation::Actuation as RigActuation;
use rigproof_impl::law::{self as rig_law, AnyLaw, PathLaw, Situation};
use rigproof_impl::linkage::{Shape, linkage};
use rigproof_impl::number::Real;
use rigproof_impl::path::{self as rig_path, AnyPath};
use rigproof_impl::tip_mass::Bodies;
use rigproof_impl::vector::Vector;
use rigproof_model::ModelError;
use rigproof_model::control::path::{Arc, Line, Nearest, Path, Polyline, Spline};
use rigproof_model::control::{
    Actuation, Controller, Impedance, Obstacle, Optimal, Proportional, Sdof, Sensed, Side,
    Uncontrolled, VelocityRatio, Virtual, Weights, tip_mass,
};
use rigproof_model::linkage::{forward, jacobian::jacobian};
use rigproof_model::rig::Parameters;
use rigproof_spec::command::Command;
use rigproof_spec::inertia::inertia;

use crate::impl_laws::sample::{LawKind, PathKind, Tick};

/// How the reference is shown its path: as it is, or nudged, or as the rig's code sees it.
#[derive(Clone, Copy, Debug)]
pub enum View {
    Nudged { offset_m: f64, turn_rad: f64 },
    Given(Nearest),
}

impl View {
    pub const EXACT: View = View::Nudged {
        offset_m: 0.0,
        turn_rad: 0.0,
    };
}

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
    let [theta_a_rad, theta_b_rad] = tick.base_rad;
    let pose = forward::pose(&tick.arms, theta_a_rad, theta_b_rad).ok()?;
    let j = jacobian(&tick.arms, &pose).ok()?;
    Some(Sensed {
        pose,
        tip_velocity_m_s: tick.velocity_m_s,
        omega_rad_s: (j * Vector2::from(tick.velocity_m_s)).into(),
        tip_force_n: tick.force_n,
    })
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
pub fn reference(tick: &Tick, view: View) -> Result<Box<dyn Controller>, ModelError> {
    let actuation = Actuation::new(tick.layout, tick.arms, tick.limit_n)?;
    let path = || Ok(Seen(reference_path(&tick.path)?, view));
    // A law without a path is not compared on one that is refused.
    path()?;
    let boundary_m = tick.boundary_m;
    let parameters = Parameters {
        layout: tick.layout,
        arms: tick.arms,
        inertia: inertia(tick.layout),
    };
    let inner: Box<dyn Controller> = match tick.law {
        LawKind::Uncontrolled => Box::new(Uncontrolled),
        LawKind::Sdof(gap_m) => Box::new(Sdof::new(actuation, path()?, boundary_m, gap_m)?),
        LawKind::Proportional(gain) => {
            Box::new(Proportional::new(actuation, path()?, boundary_m, gain)?)
        }
        LawKind::Ratio(gain) => Box::new(VelocityRatio::new(actuation, path()?, boundary_m, gain)?),
        LawKind::Optimal([angle, energy, horizon_s]) => {
            let weights = Weights {
                angle,
                energy,
                horizon_s,
            };
            let mass = move |pose: &_| tip_mass(&parameters, pose);
            Box::new(Optimal::new(actuation, path()?, boundary_m, weights, mass)?)
        }
        LawKind::Impedance([stiffness, across, along]) => {
            let elements = Virtual {
                stiffness_n_per_m: stiffness,
                damping_across_n_s_per_m: across,
                damping_along_n_s_per_m: along,
            };
            Box::new(Impedance::new(actuation, path()?, elements)?)
        }
    };
    Ok(match tick.obstacle_left {
        None => inner,
        Some(true) => Box::new(Obstacle::new(path()?, Side::Left, inner)),
        Some(false) => Box::new(Obstacle::new(path()?, Side::Right, inner)),
    })
}

/// What the reference asks for; `None` where it knows no pose, or takes no such settings.
pub fn reference_command(tick: &Tick, view: View) -> Option<Command> {
    Some(reference(tick, view).ok()?.command(&sensed(tick)?))
}

/// The rig's path.
pub fn rig_path<R: Real>(kind: &PathKind) -> Option<AnyPath<R, 8>> {
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
pub fn rig_law<R: Real>(tick: &Tick) -> Option<AnyLaw<R, AnyPath<R, 8>>> {
    let actuation = RigActuation::new(tick.layout, &tick.arms, tick.limit_n)?;
    let path = rig_path(&tick.path)?;
    let boundary_m = tick.boundary_m;
    let inner = match tick.law {
        LawKind::Uncontrolled => PathLaw::Uncontrolled(rig_law::Uncontrolled),
        LawKind::Sdof(gap_m) => {
            PathLaw::Sdof(rig_law::Sdof::new(actuation, path, boundary_m, gap_m)?)
        }
        LawKind::Proportional(gain) => PathLaw::Proportional(rig_law::Proportional::new(
            actuation, path, boundary_m, gain,
        )?),
        LawKind::Ratio(gain) => PathLaw::VelocityRatio(rig_law::VelocityRatio::new(
            actuation, path, boundary_m, gain,
        )?),
        LawKind::Optimal([angle, energy, horizon_s]) => {
            let weights = rig_law::Weights {
                angle,
                energy,
                horizon_s,
            };
            let bodies = Bodies::new(&tick.arms, &inertia(tick.layout));
            PathLaw::Optimal(rig_law::Optimal::new(
                actuation, path, boundary_m, weights, bodies,
            )?)
        }
        LawKind::Impedance([stiffness, across, along]) => {
            let elements = rig_law::Virtual {
                stiffness_n_per_m: stiffness,
                damping_across_n_s_per_m: across,
                damping_along_n_s_per_m: along,
            };
            PathLaw::Impedance(rig_law::Impedance::new(actuation, path, elements)?)
        }
    };
    Some(match tick.obstacle_left {
        None => AnyLaw::Path(inner),
        Some(left) => {
            let side = if left {
                rig_law::Side::Left
            } else {
                rig_law::Side::Right
            };
            AnyLaw::Obstacle(rig_law::Obstacle::new(path, side, inner))
        }
    })
}
