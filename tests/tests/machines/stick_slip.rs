//! This file says when a joint of the plant sticks and slips, over any sequence of pushes, locks and releases: Coulomb's rules, and beside the reference.

use nalgebra::{SMatrix, Vector2};
use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;
use proptest_state_machine::{ReferenceStateMachine, StateMachineTest, prop_state_machine};
use rigproof_impl::plant::friction::Contact;
use rigproof_impl::plant::{Outcome, Parameters, Plant};
use rigproof_model::linkage::forward;
use rigproof_model::motion::friction::DryBrakes;
use rigproof_model::motion::two_coordinate::two_coordinate;
use rigproof_model::rig::Rig;
use rigproof_spec::geometry::arms;
use rigproof_spec::inertia::inertia;
use rigproof_spec::joint::Joint;
use rigproof_spec::laws::{dissipation, torque_limit};
use rigproof_spec::layout::Layout;

const STEP_S: f64 = 1e-3;
/// A hand is a spring to the middle of the workspace, N/m, beside what it pushes: the tip never comes near an edge.
const SPRING_N_PER_M: f64 = 150.0;
const MIDDLE_M: [f64; 2] = [0.015, 0.402];
/// How far two plants may part in one sequence, m: one step of one holds what the other lets slip for part of it.
const APART_M: f64 = 2e-3;
/// What the scheme's energy may be off by in a step, by the square of the tip's speed, kg.
const SLACK_KG: f64 = 1e-4;

/// What happens.
#[derive(Clone, Debug)]
enum Event {
    /// A push, N, for so many steps.
    Push([f64; 2], u8),
    /// Other currents, A.
    Drive([f64; 4]),
    /// Every brake gets the greatest current.
    Lock,
    /// No brake gets current.
    Release,
}

/// The reference rig under the same events.
#[derive(Clone, Debug)]
struct Bench {
    rig: Rig,
    push_n: [f64; 2],
    currents_a: [f64; 4],
    /// Steps of the last event, and the force on the tip in each, N.
    forces_n: Vec<[f64; 2]>,
}

impl Bench {
    fn layout(&self) -> Layout {
        self.rig.parameters().layout
    }

    fn go(&mut self, steps: u8) {
        self.forces_n.clear();
        for _ in 0..steps {
            let [x, y] = self.rig.tip_m();
            let force_n = [
                self.push_n[0] - SPRING_N_PER_M * (x - MIDDLE_M[0]),
                self.push_n[1] - SPRING_N_PER_M * (y - MIDDLE_M[1]),
            ];
            self.rig.step(force_n, self.currents_a, STEP_S).unwrap();
            self.forces_n.push(force_n);
        }
    }

    fn with_currents(mut self, mut currents_a: [f64; 4]) -> Bench {
        if self.layout() == Layout::ThreeBrake {
            currents_a[3] = 0.0;
        }
        self.currents_a = currents_a;
        self
    }
}

impl ReferenceStateMachine for Bench {
    type State = Bench;
    type Transition = Event;

    fn init_state() -> BoxedStrategy<Bench> {
        let layout = prop_oneof![Just(Layout::ThreeBrake), Just(Layout::FourBrake)];
        let beside = [-0.031..0.031_f64, -0.031..0.031_f64];
        (layout, beside)
            .prop_map(|(layout, [dx, dy])| Bench {
                rig: Rig::new(layout, [MIDDLE_M[0] + dx, MIDDLE_M[1] + dy]).unwrap(),
                push_n: [0.0; 2],
                currents_a: [0.0; 4],
                forces_n: Vec::new(),
            })
            .boxed()
    }

    fn transitions(_: &Bench) -> BoxedStrategy<Event> {
        let push = [-9.3..9.3_f64, -9.3..9.3_f64];
        let current = || prop_oneof![Just(0.0), 0.03..0.97_f64];
        prop_oneof![
            6 => (push, 1..30_u8).prop_map(|(push, steps)| Event::Push(push, steps)),
            2 => [current(), current(), current(), current()].prop_map(Event::Drive),
            1 => Just(Event::Lock),
            1 => Just(Event::Release),
        ]
        .boxed()
    }

    fn apply(mut bench: Bench, event: &Event) -> Bench {
        let steps = match event {
            Event::Push(push_n, steps) => {
                bench.push_n = *push_n;
                *steps
            }
            Event::Drive(currents_a) => {
                bench = bench.with_currents(*currents_a);
                7
            }
            Event::Lock => {
                bench = bench.with_currents([1.0; 4]);
                41
            }
            Event::Release => {
                bench = bench.with_currents([0.0; 4]);
                13
            }
        };
        bench.go(steps);
        bench
    }
}

/// The plant, checked after every step.
struct Checked {
    plant: Plant,
}

/// What a step began with.
struct Before {
    plant: Plant,
    force_n: [f64; 2],
}

impl Checked {
    fn step(&mut self, force_n: [f64; 2], currents_a: [f64; 4], layout: Layout) {
        let before = Before {
            plant: self.plant,
            force_n,
        };
        assert_eq!(self.plant.step(force_n, currents_a, STEP_S), Outcome::Moved);
        let after = &self.plant;
        before.check_torques(after);
        before.check_what_sticks(after);
        before.check_energy(after);
        before.check_rest(after, layout);
    }
}

impl Before {
    /// The greatest torque that each brake had in the step, N·m: it moves evenly from one yield to the next.
    fn bounds_nm(&self, after: &Plant) -> [f64; 4] {
        let (old, new) = (self.plant.yield_torques_nm(), after.yield_torques_nm());
        [0, 1, 2, 3].map(|i| f64::max(old[i], new[i]))
    }

    /// Whether a joint came out of its backlash or into it: what the last step's mean missed by that is in this step's (decision 0077).
    fn crossed(&self, after: &Plant, i: usize) -> bool {
        let inside = |plant: &Plant| plant.brakes()[i].backlash().is_inside();
        inside(&self.plant) != inside(after)
    }

    /// No brake drives, and none resists with more than it has.
    fn check_torques(&self, after: &Plant) {
        let (torques_nm, rates) = (after.brake_torques_nm(), after.joint_rates_rad_s());
        for (i, joint) in Joint::ALL.into_iter().enumerate() {
            let (torque_nm, bound_nm) = (torques_nm[i], self.bounds_nm(after)[i]);
            assert!(torque_limit(joint, torque_nm).holds());
            assert!(
                torque_nm.abs() <= bound_nm * (1.0 + 1e-9) || self.crossed(after, i),
                "{torque_nm} {bound_nm}"
            );
            assert!(
                dissipation(torque_nm, rates[i]).holds(),
                "{torque_nm} {rates:?}"
            );
        }
    }

    /// A joint that sticks stands; where all brakes stick nothing moves, to the bit; what slips has the sign of its slip.
    fn check_what_sticks(&self, after: &Plant) {
        let (stuck, rates) = (after.stuck(), after.joint_rates_rad_s());
        for (stuck, rate) in stuck.into_iter().zip(rates) {
            assert!(!stuck || rate == 0.0);
        }
        match after.contact() {
            Contact::Rest => {
                assert_eq!(after.base_rates_rad_s(), [0.0; 2]);
                assert_eq!(after.tip_velocity_m_s().norm(), 0.0);
                if self.plant.contact() == Contact::Rest
                    && self.plant.base_rates_rad_s() == [0.0; 2]
                {
                    assert_eq!(after.base_angles_rad(), self.plant.base_angles_rad());
                    assert_eq!(after.joint_angles_rad(), self.plant.joint_angles_rad());
                    assert_eq!(after.tip_m(), self.plant.tip_m());
                }
            }
            Contact::Along { held, .. } => assert!(stuck[held]),
            Contact::Slipping(_) => assert_eq!(stuck, [false; 4]),
        }
    }

    /// Brakes take energy: what a step adds is at most what the hand adds at the velocity of its start or its end, to the order of the scheme.
    ///
    /// A brake's impulse opposes its joint's rate at the end, so that ½v'·M·v' − ½v·M·v ≤ h·F·v'; where a joint turns back the step is two.
    fn check_energy(&self, after: &Plant) {
        let power_w = |plant: &Plant| plant.tip_velocity_m_s().dot(self.force_n.into());
        let work_j = STEP_S * f64::max(power_w(&self.plant), power_w(after));
        let added_j = after.kinetic_energy_j() - self.plant.kinetic_energy_j();
        let speed_m_s = f64::max(
            self.plant.tip_velocity_m_s().norm(),
            after.tip_velocity_m_s().norm(),
        );
        let slack_j = SLACK_KG * speed_m_s * speed_m_s;
        assert!(
            added_j <= work_j + slack_j,
            "{added_j} J of {work_j} J at {speed_m_s} m/s"
        );
    }

    /// From rest the plant moves if the brakes cannot hold the load, and only then.
    fn check_rest(&self, after: &Plant, layout: Layout) {
        if self.plant.contact() != Contact::Rest || self.plant.base_rates_rad_s() != [0.0; 2] {
            return;
        }
        let [theta_a, theta_b] = self.plant.base_angles_rad();
        let (arms, inertia) = (arms(layout), inertia(layout));
        let pose = forward::pose(&arms, theta_a, theta_b).unwrap();
        let form = two_coordinate(&arms, &inertia, &pose, [0.0; 2]);
        let share = |yields_nm: [f64; 4]| {
            let rows: SMatrix<f64, 4, 2> = form.joints;
            let brakes = DryBrakes {
                rows,
                bounds_nm: yields_nm,
            };
            let drive: Vector2<f64> = form.drive(self.force_n);
            brakes.hold(&drive).share
        };
        let (old, new) = (self.plant.yield_torques_nm(), after.yield_torques_nm());
        let least = [0, 1, 2, 3].map(|i| f64::min(old[i], new[i]));
        let stays = after.contact() == Contact::Rest;
        assert!(stays || share(least) > 1.0 - 1e-9, "let go of what it held");
        assert!(
            !stays || share(self.bounds_nm(after)) < 1.0 + 1e-9,
            "held more than it can"
        );
    }
}

impl StateMachineTest for Checked {
    type SystemUnderTest = Checked;
    type Reference = Bench;

    fn init_test(bench: &Bench) -> Checked {
        let parameters = Parameters::of(bench.layout());
        let rates = [0.0; 2];
        Checked {
            plant: Plant::new(&parameters, bench.rig.base_angles_rad(), rates, &[]).unwrap(),
        }
    }

    fn apply(mut checked: Checked, bench: &Bench, _: Event) -> Checked {
        for force_n in &bench.forces_n {
            checked.step(*force_n, bench.currents_a, bench.layout());
        }
        checked
    }

    fn check_invariants(checked: &Checked, bench: &Bench) {
        let (own, [x, y]) = (checked.plant.tip_m(), bench.rig.tip_m());
        let apart_m = libm::hypot(own.x - x, own.y - y);
        assert!(apart_m < APART_M, "{apart_m} m");
    }
}

prop_state_machine! {
    #![proptest_config(ProptestConfig {
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))),
        ..ProptestConfig::default()
    })]

    #[test]
    fn the_plants_joints_stick_and_slip_by_coulombs_rules(sequential 1..25 => Checked);
}
