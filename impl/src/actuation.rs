//! This file turns a force wanted at the tip into the current of the brake that gives it.

use rigproof_spec::command::Reason;
use rigproof_spec::geometry::{Arms, arms};
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::greatest_desired_force_n;
use rigproof_spec::settings::{FORCE_LIMIT_RANGE_N, LONGEST_ARM_M, SHORTEST_ARM_M};
use rigproof_spec::tables::{GREATEST_CURRENT_A, brake_table};

use crate::command::Command;
use crate::current::CurrentGain;
use crate::law::Situation;
use crate::linkage::Shape;
use crate::number::Real;
use crate::path::{Nearest, Path};
use crate::select::{Decision, Rows, bounded, sound_row};
use crate::setting::setting;
use crate::vector::Vector;

/// Which brakes a law has, on which arms, and the force it may ask of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Actuation<R> {
    shape: Shape<R>,
    /// The current gains of the brakes, in the order A, E, B, C; `None` for a joint without a brake.
    gains: [Option<CurrentGain<R>>; 4],
    greatest_force_n: R,
}

impl<R: Real> Actuation<R> {
    /// The thesis's arms (table 4.1) and force limit (§6.1.2).
    pub fn thesis(layout: Layout) -> Actuation<R> {
        Actuation {
            shape: Shape::new(&arms(layout)),
            gains: Joint::ALL.map(|joint| {
                let braked = layout.brakes().contains(&joint);
                braked.then(|| CurrentGain::new(&brake_table(joint)))
            }),
            greatest_force_n: R::of(greatest_desired_force_n(layout)),
        }
    }

    /// Other arms and another force limit, N, inside the ranges of [`rigproof_spec::settings`].
    pub fn new(layout: Layout, arms: &Arms, greatest_force_n: f64) -> Option<Actuation<R>> {
        let lengths = [arms.l_ae_m, arms.l_ed_m, arms.l_bc_m, arms.l_cd_m];
        let closes = lengths
            .iter()
            .all(|length_m| (SHORTEST_ARM_M..=LONGEST_ARM_M).contains(length_m))
            && (0.0..=LONGEST_ARM_M).contains(&arms.l_ab_m);
        closes.then_some(())?;
        Some(Actuation {
            shape: Shape::new(arms),
            greatest_force_n: setting(greatest_force_n, FORCE_LIMIT_RANGE_N)?,
            ..Actuation::thesis(layout)
        })
    }

    /// The arms.
    pub const fn shape(&self) -> &Shape<R> {
        &self.shape
    }

    /// Whether these are the arms, and the joints with a brake, of a rig.
    pub(crate) fn is_of(&self, shape: &Shape<R>, braked: [bool; 4]) -> bool {
        self.shape == *shape && self.gains.map(|gain| gain.is_some()) == braked
    }

    /// The greatest force asked for at the tip, N.
    pub const fn greatest_force_n(&self) -> R {
        self.greatest_force_n
    }

    /// As [`Actuation::situation`], for a law whose selection does not refuse rows itself.
    pub(crate) fn situation_of_sound_rows(
        &self,
        path: &impl Path<R>,
        now: &Situation<R>,
    ) -> Result<(Rows<R>, Nearest<R>), Reason> {
        let situation = self.situation(path, now)?;
        if now.rows.iter().all(sound_row) {
            Ok(situation)
        } else {
            Err(Reason::UndefinedInput)
        }
    }

    /// The brakes' rows of the Jacobian, 1/m, and how the tip lies to a path; or the reason for which no brake may act.
    #[inline]
    pub(crate) fn situation(
        &self,
        path: &impl Path<R>,
        now: &Situation<R>,
    ) -> Result<(Rows<R>, Nearest<R>), Reason> {
        if !is_defined(now) {
            return Err(Reason::UndefinedInput);
        }
        if !now.linkage.is_sound(&self.shape) {
            return Err(Reason::SingularPose);
        }
        let nearest = path.nearest(now.linkage.tip_m);
        if nearest.is_defined() {
            Ok((self.rows(now), nearest))
        } else {
            Err(Reason::UndefinedInput)
        }
    }

    fn rows(&self, now: &Situation<R>) -> Rows<R> {
        let [a, e, b, c] = now.rows;
        let [of_a, of_e, of_b, of_c] = &self.gains;
        [
            of_a.map(|_| a),
            of_e.map(|_| e),
            of_b.map(|_| b),
            of_c.map(|_| c),
        ]
    }

    /// A selection's decision as a command; the brake that acts gets the current for `force_n` at the tip.
    #[inline]
    pub(crate) fn carry_out(&self, decision: Decision, rows: &Rows<R>, force_n: R) -> Command<R> {
        match decision {
            Decision::Act(joint) => self.one(joint, self.torque_nm(of(joint, rows), force_n)),
            Decision::Lock(reason) => Command {
                currents_a: self.gains.map(|gain| match gain {
                    Some(_) => R::of(GREATEST_CURRENT_A),
                    None => R::zero(),
                }),
                reason,
            },
            Decision::Rest(reason) => Command::none(reason),
        }
    }

    /// The torque with which a brake gives a force at the tip, N·m: the inverse of (6.3) for a force within the limit.
    //= thesis (6.3)
    pub(crate) fn torque_nm(&self, row: &Option<Vector<R>>, force_n: R) -> R {
        match row {
            Some(row) if force_n > self.greatest_force_n => self.greatest_force_n / row.norm(),
            Some(row) => force_n / row.norm(),
            None => R::zero(),
        }
    }

    /// A command for a torque of one brake, N·m.
    #[inline]
    pub(crate) fn one(&self, joint: Joint, torque_nm: R) -> Command<R> {
        let mut command = Command::none(Reason::Chosen(joint));
        self.give(&mut command, joint, torque_nm);
        command
    }

    /// A command for the torques of two brakes, N·m.
    pub(crate) fn two(&self, first: (Joint, R), second: (Joint, R)) -> Command<R> {
        let mut command = Command::none(Reason::ChosenPair(first.0, second.0));
        self.give(&mut command, first.0, first.1);
        self.give(&mut command, second.0, second.1);
        command
    }

    /// The greatest torque of a brake, N·m; none of a joint without one.
    pub(crate) fn greatest_nm(&self, joint: Joint) -> R {
        of(joint, &self.gains).map_or(R::zero(), |gain| gain.greatest_nm())
    }

    #[inline]
    fn give(&self, command: &mut Command<R>, joint: Joint, torque_nm: R) {
        if let Some(gain) = of(joint, &self.gains) {
            *of_mut(joint, &mut command.currents_a) = gain.current_a(torque_nm);
        }
    }
}

/// Whether tip, velocity and push are numbers that a law takes, as [`crate::select::is_sound`] does.
#[inline]
pub(crate) fn is_defined<R: Real>(now: &Situation<R>) -> bool {
    bounded(&now.linkage.tip_m) && bounded(&now.tip_velocity_m_s) && bounded(&now.tip_force_n)
}

/// What belongs to a joint.
fn of<T>(joint: Joint, all: &[T; 4]) -> &T {
    match joint {
        Joint::A => &all[0],
        Joint::E => &all[1],
        Joint::B => &all[2],
        Joint::C => &all[3],
    }
}

fn of_mut<T>(joint: Joint, all: &mut [T; 4]) -> &mut T {
    match joint {
        Joint::A => &mut all[0],
        Joint::E => &mut all[1],
        Joint::B => &mut all[2],
        Joint::C => &mut all[3],
    }
}
