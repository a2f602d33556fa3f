//! This file says that the backlash, the reference's and the rig's, is a window that only a shaft at its edge moves.

use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;
use proptest_state_machine::{ReferenceStateMachine, StateMachineTest, prop_state_machine};
use rigproof_impl::plant::backlash as rig;
use rigproof_model::brake::Backlash;
use rigproof_spec::laws::{Window, backlash_travel, backlash_width, backlash_window};

/// What rounding may cost, rad.
const SLACK_RAD: f64 = 1e-14;
/// Degrees to radians, written out: the subjects convert for themselves.
const RAD: f64 = core::f64::consts::PI / 180.0;
/// Reverse travel after which a shaft is inside (decision 0004).
const ENTRY_RAD: f64 = 0.02 * RAD;

/// A window as a play operator: its lower edge is held within a width below the shaft.
#[derive(Clone, Debug)]
struct Play {
    width_deg: f64,
    start_rad: f64,
    low_rad: f64,
    shaft_rad: f64,
    inside: bool,
}

impl Play {
    fn new(width_deg: f64, start_rad: f64) -> Play {
        let width_rad = width_deg * RAD;
        Play {
            width_deg,
            start_rad,
            low_rad: start_rad - 0.5 * width_rad,
            shaft_rad: start_rad,
            inside: 0.5 * width_rad > ENTRY_RAD,
        }
    }

    /// Turned to an angle, or a hair further where rounding would decide.
    fn turned(mut self, to_rad: f64) -> Play {
        let width_rad = self.width_deg * RAD;
        let edges = [0.0, ENTRY_RAD, width_rad - ENTRY_RAD, width_rad];
        let tied = edges
            .iter()
            .any(|edge| (to_rad - self.low_rad - edge).abs() < 1e-12);
        let to_rad = if tied { to_rad + 1e-9 } else { to_rad };
        let above = to_rad - self.low_rad;
        if above < 0.0 || above > width_rad {
            self.low_rad = self.low_rad.clamp(to_rad - width_rad, to_rad);
            self.inside = false;
        } else if above > ENTRY_RAD && width_rad - above > ENTRY_RAD {
            self.inside = true;
        }
        self.shaft_rad = to_rad;
        self
    }
}

impl ReferenceStateMachine for Play {
    type State = Play;
    /// A turn of the shaft, rad.
    type Transition = f64;

    fn init_state() -> BoxedStrategy<Play> {
        let width = prop_oneof![Just(0.0), Just(1.7), 0.05..2.3_f64];
        (width, -3.1..3.1_f64)
            .prop_map(|(width, start)| Play::new(width, start))
            .boxed()
    }

    /// Small turns, turns across the window, and ones that end a hair beside an edge.
    fn transitions(state: &Play) -> BoxedStrategy<f64> {
        let width_rad = state.width_deg * RAD;
        let to_edge = state.low_rad - state.shaft_rad;
        let hair = (-1e-4..1e-4_f64).prop_map(move |beside| to_edge + beside);
        let other = (-1e-4..1e-4_f64).prop_map(move |beside| to_edge + width_rad + beside);
        prop_oneof![-0.004..0.004_f64, -0.07..0.07_f64, hair, other].boxed()
    }

    fn apply(state: Play, turn_rad: &f64) -> Play {
        let to_rad = state.shaft_rad + turn_rad;
        state.turned(to_rad)
    }
}

struct Both {
    model: Backlash,
    rig: rig::Backlash,
    shaft_rad: f64,
}

impl Both {
    fn windows(&self) -> [Window; 2] {
        let window = |(theta_1_rad, theta_2_rad), inside| Window {
            theta_1_rad,
            theta_2_rad,
            theta_rad: self.shaft_rad,
            inside,
        };
        let [low, high] = self.rig.boundaries_rad();
        [
            window(self.model.boundaries_rad(), self.model.is_inside()),
            window((low, high), self.rig.is_inside()),
        ]
    }
}

impl StateMachineTest for Both {
    type SystemUnderTest = Both;
    type Reference = Play;

    fn init_test(state: &Play) -> Both {
        Both {
            model: Backlash::of_width(state.width_deg, 0.02, state.start_rad),
            rig: rig::Backlash::new(state.width_deg, state.start_rad),
            shaft_rad: state.start_rad,
        }
    }

    fn apply(mut both: Both, state: &Play, _: f64) -> Both {
        let before = both.windows();
        both.model.update(state.shaft_rad);
        let crossing = both.rig.turn(both.shaft_rad, state.shaft_rad);
        both.shaft_rad = state.shaft_rad;
        for (before, after) in before.into_iter().zip(both.windows()) {
            assert!(
                backlash_travel(&before, &after, SLACK_RAD).holds(),
                "{before:?} {after:?}"
            );
        }
        if let Some(crossing) = crossing {
            assert_eq!(crossing.inside, both.rig.is_inside());
            assert!((0.0..=1.0).contains(&crossing.part));
        }
        both
    }

    fn check_invariants(both: &Both, state: &Play) {
        for window in both.windows() {
            assert!(backlash_width(&window, state.width_deg * RAD, SLACK_RAD).holds());
            assert!(backlash_window(&window, SLACK_RAD).holds(), "{window:?}");
            assert!(
                (window.theta_1_rad - state.low_rad).abs() < SLACK_RAD,
                "{window:?} {state:?}"
            );
            assert_eq!(window.inside, state.inside, "{window:?} {state:?}");
        }
    }
}

prop_state_machine! {
    #![proptest_config(ProptestConfig {
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))),
        ..ProptestConfig::default()
    })]

    #[test]
    fn a_backlash_is_a_window_that_its_shaft_pushes(sequential 1..80 => Both);
}
