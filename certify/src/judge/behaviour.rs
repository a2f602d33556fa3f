//! This file holds a controller to what it declares of itself: how many brakes, where none, when all, and which.

use core::f64::consts::FRAC_PI_2;

use rigproof_impl::law::Situation;
use rigproof_impl::path::{Nearest, Path as _};
use rigproof_impl::vector::Vector;
use rigproof_model::brake::torque_gain;
use rigproof_spec::command::Command;
use rigproof_spec::joint::Joint;
use rigproof_spec::laws::{
    Margin, best_influence, brake_count, desired_force, free_side, gap, in_quarter_turn, lock,
};
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::{NO_INFLUENCE, greatest_desired_force_n};
use rigproof_spec::tables::GAIN_BREAK_A;

use crate::declared::{Choice, Declared, Solid};
use crate::law::{LAWS, Law};
use crate::way::Way;

/// What two computations of one place may differ by, m (decision 0124): far above rounding in single precision, far below a count.
const PLACE_SLACK_M: f64 = 1e-6;
/// What two estimates of one velocity may differ by, m/s (decision 0124): one count in one sample at the end of an arm.
const SPEED_SLACK_M_S: f64 = 0.02;
/// What two computations of one force may differ by, N: far below what a hand feels.
const FORCE_SLACK_N: f64 = 1e-6;
/// Share of its own length beside which a component's sign is certain.
const CERTAIN: f64 = 1e-6;

/// What is declared, and where.
pub struct Behaviour {
    layout: Layout,
    declared: Declared,
    way: Way,
    is_looked_at: [bool; LAWS],
}

/// The directions of §6.1.1 at a place.
struct Desired {
    direction: Vector<f64>,
    along: Vector<f64>,
    towards: Option<Vector<f64>>,
}

impl Behaviour {
    /// What a controller declares, on a layout and a path.
    pub fn new(layout: Layout, declared: &Declared, way: Way) -> Behaviour {
        Behaviour {
            layout,
            declared: *declared,
            way,
            is_looked_at: Law::ALL.map(|law| law.not_looked_at(declared).is_none()),
        }
    }

    fn looks_at(&self, law: Law) -> bool {
        self.is_looked_at.get(law as usize) == Some(&true)
    }

    /// Judges a command by what was sensed: the law, its margin, and whether its premise is met.
    #[inline]
    pub fn judge(
        &self,
        now: &Situation<f64>,
        command: &Command,
        mut add: impl FnMut(Law, Margin, bool),
    ) {
        let is_lock = self.is_lock(command);
        let nearest = self.way.path.nearest(now.linkage.tip_m);
        if let Some(gap_m) = self.declared.gap_m.filter(|_| self.looks_at(Law::Gap)) {
            let distance_m = nearest.distance_m() + PLACE_SLACK_M;
            let margin = gap(distance_m, gap_m, command);
            add(Law::Gap, margin, distance_m <= gap_m);
        }
        if let Some(solid) = self.declared.solid {
            let depth_m = match solid {
                Solid::Left => nearest.offset_m,
                Solid::Right => -nearest.offset_m,
            };
            let depth_m = depth_m + PLACE_SLACK_M;
            add(Law::FreeSide, free_side(depth_m, command), depth_m <= 0.0);
        }
        let (acting, others) = acting(command);
        if !is_lock && acting.is_none() {
            return;
        }
        let Some(boundary_m) = self.declared.boundary_m else {
            return self.tip_force(now, command, &mut add);
        };
        let desired = desired(&nearest, now.tip_force_n, boundary_m);
        if is_lock {
            if self.looks_at(Law::Lock) {
                add(Law::Lock, locked(&desired, now, command), true);
            }
            return;
        }
        self.tip_force(now, command, &mut add);
        match (acting, self.declared.choice) {
            // Neither rule chooses several.
            (_, Some(choice)) if others => add(
                match choice {
                    Choice::Influence => Law::Influence,
                    Choice::QuarterTurn => Law::QuarterTurn,
                },
                Margin(-1.0),
                true,
            ),
            (Some(joint), Some(Choice::Influence)) => {
                if let Some(margin) = influence(self.layout, joint, now, &desired) {
                    add(Law::Influence, margin, true);
                }
            }
            (Some(joint), Some(Choice::QuarterTurn)) => {
                if let Some(margin) = quarter_turn(joint, now, &desired) {
                    add(Law::QuarterTurn, margin, true);
                }
            }
            _ => {}
        }
    }

    /// Whether a command is a lock: only what is held to the lock condition counts as one.
    fn is_lock(&self, command: &Command) -> bool {
        command.reason.is_lock() && self.looks_at(Law::Lock)
    }

    /// How many brakes have current, if it is declared how many may, and whether that is met: while one acts, or always where none may.
    pub fn count(&self, command: &Command) -> Option<(Margin, bool)> {
        let unlocked = Command {
            reason: rigproof_spec::command::Reason::NothingToDo,
            ..*command
        };
        let of = match self.is_lock(command) {
            true => command,
            false => &unlocked,
        };
        let most = self.declared.most_brakes?;
        let acts = command.currents_a != [0.0; 4];
        Some((brake_count(of, most), acts || most == 0))
    }

    fn tip_force(
        &self,
        now: &Situation<f64>,
        command: &Command,
        add: &mut impl FnMut(Law, Margin, bool),
    ) {
        if !self.looks_at(Law::TipForce) {
            return;
        }
        let each = Joint::ALL.into_iter().zip(command.currents_a);
        let each = each.filter(|(_, current_a)| *current_a != 0.0);
        let margins = each.map(|(joint, current_a)| force(self.layout, joint, current_a, now));
        if let Some(margin) = margins.reduce(Margin::and) {
            add(Law::TipForce, margin, true);
        }
    }
}

/// A brake that has current, and whether others have too.
fn acting(command: &Command) -> (Option<Joint>, bool) {
    let pairs = Joint::ALL.into_iter().zip(command.currents_a);
    let mut acting = pairs.filter(|(_, current_a)| *current_a != 0.0);
    (
        acting.next().map(|(joint, _)| joint),
        acting.next().is_some(),
    )
}

/// The velocity field (§6.1.1).
fn desired(nearest: &Nearest<f64>, force_n: Vector<f64>, boundary_m: f64) -> Desired {
    let along = if nearest.tangent.dot(force_n) < 0.0 {
        -nearest.tangent
    } else {
        nearest.tangent
    };
    let towards = nearest.towards();
    let share = (nearest.distance_m() / boundary_m).min(1.0);
    let direction = towards.map_or(along, |towards| {
        let (sine, cosine) = libm::sincos(FRAC_PI_2 * share);
        along * cosine + towards * sine
    });
    Desired {
        direction,
        along,
        towards,
    }
}

/// Whether a lock was called for, or nearly so.
fn locked(desired: &Desired, now: &Situation<f64>, command: &Command) -> Margin {
    // On the path nothing is pushed away from it.
    let force_n = desired
        .towards
        .map_or(f64::MAX, |towards| towards.dot(now.tip_force_n));
    let speed_m_s = desired.direction.dot(now.tip_velocity_m_s);
    // A tip of which no count was seen stands for every estimator.
    let slack_m_s = match now.tip_velocity_m_s == Vector::zero() {
        true => 0.0,
        false => SPEED_SLACK_M_S,
    };
    lock(force_n, speed_m_s - slack_m_s, command)
}

/// Whether the torque that a brake is asked for is within the greatest force at the tip (6.3).
fn force(layout: Layout, joint: Joint, current_a: f64, now: &Situation<f64>) -> Margin {
    let torque_nm = torque_gain(joint, current_a);
    // Where (3.3) steps, its smaller side counts.
    let torque_nm = if current_a == GAIN_BREAK_A {
        torque_nm.min(torque_gain(joint, current_a.next_down()))
    } else {
        torque_nm
    };
    let force_n = torque_nm * row_of(joint, now).norm();
    let greatest_n = greatest_desired_force_n(layout);
    let slack_n = FORCE_SLACK_N + 1e-9 * greatest_n;
    desired_force(layout, force_n - slack_n)
}

/// Whether the brake that acts has the best influence of those whose influence is certain; `None` where nothing is certain.
//= thesis (6.12)
fn influence(
    layout: Layout,
    acting: Joint,
    now: &Situation<f64>,
    desired: &Desired,
) -> Option<Margin> {
    let velocity = now.tip_velocity_m_s;
    let (along, across) = (
        desired.direction.dot(velocity),
        desired.direction.cross(velocity),
    );
    if across.abs() < SPEED_SLACK_M_S || along.abs() < SPEED_SLACK_M_S {
        return None;
    }
    let coefficients = |joint: Joint| {
        let row = row_of(joint, now);
        let rate_rad_s = row.dot(velocity);
        if rate_rad_s.abs() < SPEED_SLACK_M_S * row.norm() {
            return None;
        }
        let force = row * -rate_rad_s.signum();
        let of = |component: f64, speed: f64| {
            let share = component.abs() / row.norm();
            if share < NO_INFLUENCE {
                return Some(0);
            }
            let agrees = if component * speed > 0.0 { 1 } else { -1 };
            (share > CERTAIN).then_some(agrees)
        };
        Some([
            of(desired.direction.dot(force), along)?,
            of(desired.direction.cross(force), across)?,
        ])
    };
    let chosen = coefficients(acting)?;
    let mut available = [chosen; 4];
    for (joint, place) in layout.brakes().iter().zip(&mut available) {
        *place = coefficients(*joint).unwrap_or(chosen);
    }
    Some(best_influence(Some(chosen), &available))
}

/// Whether the brake that acts leads along a local path in the quarter turn; `None` on its edges and on the path.
fn quarter_turn(acting: Joint, now: &Situation<f64>, desired: &Desired) -> Option<Margin> {
    let towards = desired.towards?;
    let row = row_of(acting, now);
    let path = row.left();
    let certain = CERTAIN * row.norm();
    if path.dot(desired.along).abs() < certain || path.dot(towards).abs() < certain {
        return None;
    }
    let leads =
        |path: Vector<f64>| in_quarter_turn(path.into(), desired.along.into(), towards.into());
    Some(Margin(if leads(path) || leads(-path) {
        0.0
    } else {
        -1.0
    }))
}

/// A joint's row of the Jacobian, 1/m.
fn row_of(joint: Joint, now: &Situation<f64>) -> Vector<f64> {
    let [a, e, b, c] = now.rows;
    match joint {
        Joint::A => a,
        Joint::E => e,
        Joint::B => b,
        Joint::C => c,
    }
}
