//! Laws: what must hold on every rig, in every run, each a plain function that anybody may call.

mod axis;
mod backlash;
mod brake_count;
mod clamp;
mod current_limit;
mod desired_force;
mod dissipation;
mod influence;
mod local_path;
mod passivity;
mod power_balance;
mod quiet;
mod rolling;
mod time_constant;
mod torque_limit;
mod velocity_limits;

pub use axis::{effort_limit, reversals, spring_passivity, travel};
pub use backlash::{Window, backlash_torque, backlash_travel, backlash_width, backlash_window};
pub use brake_count::{brake_count, braked_joints};
pub use clamp::clamped;
pub use current_limit::current_limit;
pub use desired_force::{desired_force, opposition};
pub use dissipation::dissipation;
pub use influence::{best_influence, influence_rank};
pub use local_path::local_path;
pub use passivity::{in_quarter_turn, opposes};
pub use power_balance::power_balance;
pub use quiet::{free_side, gap, lock, undefined_input};
pub use rolling::{Castor, one_degree, rolls};
pub use time_constant::time_constant;
pub use torque_limit::{torque_limit, yield_limit};
pub use velocity_limits::{clutches_never_drive, velocity_limits};

/// How far a law is from failing, in the unit the law states.
///
/// A margin that is not a number holds for no law: an undefined value is a failure, never a pass.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Margin(pub f64);

impl Margin {
    /// Whether the law holds: the margin is zero or more.
    pub fn holds(self) -> bool {
        self.0 >= 0.0
    }

    /// The margin of two laws together: the smaller one, and undefined if either is.
    pub fn and(self, other: Margin) -> Margin {
        if self.0.is_nan() || self.0 < other.0 {
            self
        } else {
            other
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_laws_hold_together_when_both_hold() {
        let (wide, narrow, broken) = (Margin(2.6), Margin(0.3), Margin(-0.7));
        assert_eq!(wide.and(narrow), narrow);
        assert_eq!(narrow.and(broken), broken);
        assert_eq!(broken.and(wide), broken);
    }

    #[test]
    fn an_undefined_margin_holds_for_no_law() {
        let undefined = Margin(f64::NAN);
        assert!(!undefined.holds());
        assert!(!undefined.and(Margin(1.7)).holds());
        assert!(!Margin(1.7).and(undefined).holds());
    }
}
