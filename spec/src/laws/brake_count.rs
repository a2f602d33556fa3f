//! This file says how many brakes a controller may use, and which.

use super::Margin;
use crate::command::Command;
use crate::joint::Joint;
use crate::layout::Layout;

/// Whether a controller energises at most `most` brakes when it does not lock; the margin is how many it could still
/// use.
///
/// Source: §6.1.2, "actuate only one brake at a time. However, they may act to immobilize the system by applying full
/// current to all brakes if a locking condition is met"; §2.2.2, "at most two clutches" for torque translation.
pub fn brake_count(command: &Command, most: u8) -> Margin {
    let used: u8 = command
        .currents_a
        .iter()
        .map(|current_a| u8::from(*current_a != 0.0))
        .sum();
    if command.reason.is_lock() {
        Margin(0.0)
    } else {
        Margin(f64::from(most) - f64::from(used))
    }
}

/// Whether only joints with a brake get current; the margin is minus the greatest current elsewhere, A.
///
/// Source: chapter 4: the 3-brake layout has no brake at C.
pub fn braked_joints(layout: Layout, command: &Command) -> Margin {
    Joint::ALL
        .into_iter()
        .zip(command.currents_a)
        .filter(|(joint, _)| !layout.brakes().contains(joint))
        .fold(Margin(0.0), |margin, (_, current_a)| {
            margin.and(Margin(-current_a.abs()))
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::command::Reason;

    fn command(currents_a: [f64; 4], reason: Reason) -> Command {
        Command { currents_a, reason }
    }

    #[test]
    fn a_second_brake_breaks_the_law_unless_the_rig_is_locked() {
        let two = [0.31, 0.0, 0.72, 0.0];
        assert!(!brake_count(&command(two, Reason::Chosen(Joint::A)), 1).holds());
        let one = [0.0, 0.0, 0.72, 0.0];
        assert!(brake_count(&command(one, Reason::Chosen(Joint::B)), 1).holds());
        assert!(brake_count(&command(two, Reason::ChosenPair(Joint::A, Joint::B)), 2).holds());
        assert!(brake_count(&command([1.0; 4], Reason::LockedMovingBack), 1).holds());
        let undefined = [f64::NAN, 0.41, 0.0, 0.0];
        assert!(!brake_count(&command(undefined, Reason::Chosen(Joint::E)), 1).holds());
    }

    #[test]
    fn only_the_four_brake_layout_has_a_brake_at_c() {
        let at_c = command([0.0, 0.0, 0.0, 0.37], Reason::Chosen(Joint::C));
        assert!(!braked_joints(Layout::ThreeBrake, &at_c).holds());
        assert!(braked_joints(Layout::FourBrake, &at_c).holds());
        let at_a = command([0.37, 0.0, 0.0, 0.0], Reason::Chosen(Joint::A));
        assert!(braked_joints(Layout::ThreeBrake, &at_a).holds());
    }
}
