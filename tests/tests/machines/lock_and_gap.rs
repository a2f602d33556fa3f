//! This file says when the rig's controller locks, leaves alone and chooses, over any sequence of good and bad samples.

use nalgebra::{Matrix4x2, Vector2};
use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;
use proptest_state_machine::{ReferenceStateMachine, StateMachineTest, prop_state_machine};
use rigproof_impl::actuation::Actuation;
use rigproof_impl::law::{PathLaw, Proportional, Sdof};
use rigproof_impl::path::Line as RigLine;
use rigproof_impl::tick::{Sensed, Settings, Tick};
use rigproof_model::control::desired_velocity::{Desired, desired_velocity};
use rigproof_model::control::path::{Line, Path};
use rigproof_model::encoder::Encoder;
use rigproof_model::linkage::jacobian::jacobian;
use rigproof_model::linkage::{forward, inverse};
use rigproof_model::velocity::AdaptiveWindow;
use rigproof_spec::command::{Command, Reason};
use rigproof_spec::geometry::arms;
use rigproof_spec::laws::{brake_count, braked_joints, current_limit, gap, lock, undefined_input};
use rigproof_spec::layout::Layout;

const FROM_M: [f64; 2] = [-0.043, 0.371];
const TO_M: [f64; 2] = [0.067, 0.403];
const BOUNDARY_M: f64 = 0.047;
const GAP_M: f64 = 0.0049;
const SAMPLE_S: f64 = 0.001;
/// Good samples in a row after which a law is asked, and ticks without a new sample that are let pass (decision 0074).
const WINDOW: u32 = 9;
const REPEATS: u32 = 2;
/// Most counts from one sample to the next: 30 rad/s (decision 0074).
const GREATEST_STEP: i64 = 478;
/// A component of a unit vector below which nothing is said about its sign.
const HAIR: f64 = 1e-6;
/// The share of a joint's greatest rate below which nothing is said about whether it stands: ten times what counts as standing (decision 0100).
const STANDING: f64 = 1e-3;

/// What happens in a tick.
#[derive(Clone, Debug)]
enum Event {
    /// The next sample, on the way to a point beside the path: place along it, distance from it, m; at most so many counts.
    Go([f64; 2], i64, [f64; 2]),
    /// The next sample at the same place.
    Stand([f64; 2]),
    /// The same sample again.
    Again,
    /// Samples were lost.
    Lost(u32),
    /// A counter jumps, for this sample.
    Jump(i64),
    /// A force that is no number, or beyond its sensor.
    Force([f64; 2]),
}

/// What came in so far and what a controller may make of it.
#[derive(Clone, Debug)]
struct Watch {
    layout: Layout,
    with_gap: bool,
    number: u32,
    counts: [i64; 2],
    force_n: [f64; 2],
    jump: i64,
    /// Good samples since the start or the last fault, and repeats since the last sample.
    good: u32,
    repeats: u32,
    windows: [AdaptiveWindow; 2],
    allowed: Allowed,
}

/// What the controller may answer.
#[derive(Clone, Debug)]
enum Allowed {
    /// What it said before.
    TheSame,
    /// No current, for this reason.
    Nothing(Reason),
    /// What the law says here.
    Law(Box<Scene>),
}

/// The tip, its path and its brakes where a law is asked.
#[derive(Clone, Debug)]
struct Scene {
    distance_m: f64,
    desired: Desired,
    force_n: Vector2<f64>,
    velocity_m_s: Vector2<f64>,
    rows: Matrix4x2<f64>,
}

/// How sure it is that something holds.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Sure {
    Yes,
    No,
    /// On a hair: rounding decides.
    Either,
}

impl Sure {
    fn above(value: f64, hair: f64) -> Sure {
        if value > hair {
            Sure::Yes
        } else if value < -hair {
            Sure::No
        } else {
            Sure::Either
        }
    }

    fn and(self, other: Sure) -> Sure {
        match (self, other) {
            (Sure::No, _) | (_, Sure::No) => Sure::No,
            (Sure::Yes, Sure::Yes) => Sure::Yes,
            _ => Sure::Either,
        }
    }

    fn or(self, other: Sure) -> Sure {
        match (self, other) {
            (Sure::Yes, _) | (_, Sure::Yes) => Sure::Yes,
            (Sure::No, Sure::No) => Sure::No,
            _ => Sure::Either,
        }
    }

    fn permits(self, said: bool) -> bool {
        match self {
            Sure::Yes => said,
            Sure::No => !said,
            Sure::Either => true,
        }
    }
}

impl Scene {
    /// Whether a brake may act under SDOF control: its joint's local path, one way or the other, lies in the quarter turn (§6.2).
    fn leads(&self, joint: usize) -> Sure {
        let row = self.rows.row(joint).transpose().normalize();
        let Some(towards) = self.desired.towards else {
            return Sure::No;
        };
        let (along, across) = (row.perp(&self.desired.along), row.perp(&towards));
        let one = Sure::above(along, HAIR).and(Sure::above(across, HAIR));
        one.or(Sure::above(-along, HAIR).and(Sure::above(-across, HAIR)))
    }

    /// Whether a brake may act under proportional control: its force takes from the unwanted component of the velocity (6.12).
    fn helps(&self, joint: usize) -> Sure {
        let speed_m_s = self.velocity_m_s.norm();
        if speed_m_s == 0.0 {
            return Sure::No;
        }
        let (row, velocity) = (
            self.rows.row(joint).transpose().normalize(),
            self.velocity_m_s / speed_m_s,
        );
        let rate = row.dot(&velocity);
        let across = self.desired.direction.perp(&row);
        let unwanted = self.desired.direction.perp(&velocity);
        // The force is the row against its joint's rate; it has to point against the unwanted component.
        let clear = rate.abs() > STANDING && across.abs() > HAIR && unwanted.abs() > HAIR;
        if clear {
            Sure::above(rate * across * unwanted, 0.0)
        } else {
            Sure::Either
        }
    }

    fn moves_back(&self) -> Sure {
        let speed_m_s = self.velocity_m_s.norm();
        if speed_m_s == 0.0 {
            return Sure::No;
        }
        let along = self.desired.direction.dot(&self.velocity_m_s);
        Sure::above(-along, HAIR * speed_m_s)
    }

    fn pushes_away(&self) -> Sure {
        let towards = self.desired.towards_path(self.force_n);
        Sure::above(-towards, HAIR * self.force_n.norm())
    }

    /// Whether a controller may say this.
    fn check(&self, reason: Reason, braked: &[usize], with_gap: bool) -> Result<(), String> {
        let of = |joint: usize| {
            if with_gap {
                self.leads(joint)
            } else {
                self.helps(joint)
            }
        };
        let (quiet, first) = if with_gap {
            let inside = Sure::above(GAP_M - self.distance_m, 1e-12);
            (inside, Reason::InsideGap)
        } else {
            (self.moves_back(), Reason::LockedMovingBack)
        };
        let none = braked.iter().fold(Sure::Yes, |none, joint| {
            none.and(match of(*joint) {
                Sure::Yes => Sure::No,
                Sure::No => Sure::Yes,
                Sure::Either => Sure::Either,
            })
        });
        let away = self.pushes_away();
        let checks = [
            ("gap or motion back", quiet.permits(reason == first)),
            (
                "a brake that may act",
                reason == first
                    || match reason {
                        Reason::Chosen(joint) => {
                            braked.contains(&(joint as usize)) && of(joint as usize) != Sure::No
                        }
                        Reason::LockedPushedAway => none != Sure::No && away != Sure::No,
                        Reason::NoneHelps => none != Sure::No && away != Sure::Yes,
                        _ => false,
                    },
            ),
        ];
        match checks.into_iter().find(|(_, holds)| !holds) {
            Some((what, _)) => Err(format!("{reason:?} against {what}: {self:?}")),
            None => Ok(()),
        }
    }
}

impl Watch {
    fn new(layout: Layout, with_gap: bool, number: u32) -> Watch {
        let encoder = Encoder::default();
        let pose = inverse::pose(&arms(layout), [0.011, 0.389]).unwrap();
        let counts = [pose.theta_a_rad, pose.theta_b_rad].map(|angle| encoder.count(angle));
        Watch {
            layout,
            with_gap,
            number,
            counts,
            force_n: [1.3, -0.7],
            jump: 0,
            good: 0,
            repeats: 0,
            windows: counts.map(|count| AdaptiveWindow::new(encoder, SAMPLE_S, count)),
            allowed: Allowed::Nothing(Reason::Starting),
        }
    }

    fn sample(&self) -> Sensed<f64> {
        let [a, b] = self.counts;
        Sensed {
            number: self.number,
            counts: [a + self.jump, b].map(|count| i32::try_from(count).unwrap()),
            tip_force_n: self.force_n.into(),
        }
    }

    /// Moves towards a point beside the path.
    fn go(&mut self, [place, off_m]: [f64; 2], most: i64) {
        let [dx, dy] = [TO_M[0] - FROM_M[0], TO_M[1] - FROM_M[1]];
        let length_m = libm::hypot(dx, dy);
        let point_m = [
            FROM_M[0] + place * dx - off_m * dy / length_m,
            FROM_M[1] + place * dy + off_m * dx / length_m,
        ];
        let Ok(pose) = inverse::pose(&arms(self.layout), point_m) else {
            return;
        };
        let goal =
            [pose.theta_a_rad, pose.theta_b_rad].map(|angle| Encoder::default().count(angle));
        for (count, goal) in self.counts.iter_mut().zip(goal) {
            *count += (goal - *count).clamp(-most, most);
        }
    }

    /// What a law sees now.
    fn scene(&mut self) -> Scene {
        let encoder = Encoder::default();
        let [a, b] = &mut self.windows;
        let rates = [a.update(self.counts[0]), b.update(self.counts[1])];
        let [theta_a, theta_b] = self
            .counts
            .map(|count| count as f64 * encoder.resolution_rad());
        let pose = forward::pose(&arms(self.layout), theta_a, theta_b).unwrap();
        let rows = jacobian(&arms(self.layout), &pose).unwrap();
        // The tip moves so that A and B turn as they do: θ̇ = J·ẋ (5.33).
        let base = nalgebra::Matrix2::from_rows(&[rows.row(0), rows.row(2)]);
        let velocity_m_s = base.try_inverse().unwrap() * Vector2::from(rates);
        let nearest = Line::through(FROM_M, TO_M).unwrap().nearest(pose.tip_m);
        let force_n = Vector2::from(self.force_n);
        Scene {
            distance_m: nearest.distance_m(),
            desired: desired_velocity(&nearest, force_n, BOUNDARY_M),
            force_n,
            velocity_m_s,
            rows,
        }
    }

    fn fault(&mut self, reason: Reason) {
        self.good = 0;
        self.allowed = Allowed::Nothing(reason);
        let encoder = Encoder::default();
        let [a, b] = self.counts;
        self.windows =
            [a + self.jump, b].map(|count| AdaptiveWindow::new(encoder, SAMPLE_S, count));
    }
}

impl ReferenceStateMachine for Watch {
    type State = Watch;
    type Transition = Event;

    fn init_state() -> BoxedStrategy<Watch> {
        let layout = prop_oneof![Just(Layout::ThreeBrake), Just(Layout::FourBrake)];
        let number = prop_oneof![any::<u32>(), Just(u32::MAX - 17)];
        (layout, any::<bool>(), number)
            .prop_map(|(layout, with_gap, number)| {
                let mut watch = Watch::new(layout, with_gap, number);
                for _ in 0..WINDOW {
                    watch = Watch::apply(watch, &Event::Stand([1.3, -0.7]));
                }
                watch
            })
            .boxed()
    }

    fn transitions(_: &Watch) -> BoxedStrategy<Event> {
        let force = || [-7.1..7.1_f64, -7.1..7.1_f64];
        let off = prop_oneof![-0.083..0.083_f64, -0.0071..0.0071_f64];
        let speed = prop_oneof![1..5_i64, 20..90_i64, Just(400_i64)];
        let bad = prop_oneof![
            Just(f64::NAN),
            Just(f64::NEG_INFINITY),
            Just(200.1),
            Just(-1e300)
        ];
        let bad = (bad, any::<bool>()).prop_map(
            |(bad, first)| {
                if first { [bad, 1.3] } else { [1.3, bad] }
            },
        );
        prop_oneof![
            60 => ((0.1..0.9_f64, off), speed, force())
                .prop_map(|((place, off), most, force)| Event::Go([place, off], most, force)),
            20 => force().prop_map(Event::Stand),
            3 => Just(Event::Again),
            1 => (1..u32::MAX - 1).prop_map(Event::Lost),
            1 => prop_oneof![2 * GREATEST_STEP..9000, -9000..-2 * GREATEST_STEP].prop_map(Event::Jump),
            1 => bad.prop_map(Event::Force),
        ]
        .boxed()
    }

    fn apply(mut watch: Watch, event: &Event) -> Watch {
        watch.jump = 0;
        if let Event::Again = event {
            watch.repeats += 1;
            if watch.repeats > REPEATS {
                watch.fault(Reason::StaleSample);
            } else {
                watch.allowed = Allowed::TheSame;
            }
            return watch;
        }
        watch.repeats = 0;
        watch.number = watch.number.wrapping_add(1);
        watch.force_n = [1.3, -0.7];
        match event {
            Event::Go(to, most, force_n) => {
                watch.go(*to, *most);
                watch.force_n = *force_n;
            }
            Event::Stand(force_n) => watch.force_n = *force_n,
            Event::Lost(lost) => {
                watch.number = watch.number.wrapping_add(*lost);
                watch.fault(Reason::StaleSample);
                return watch;
            }
            Event::Jump(by) => {
                watch.jump = *by;
                watch.fault(Reason::JumpedCounts);
                return watch;
            }
            Event::Force(bad) => {
                watch.force_n = *bad;
                watch.fault(Reason::UndefinedInput);
                return watch;
            }
            Event::Again => {}
        }
        watch.good += 1;
        // The velocity's window goes on in every good sample.
        let scene = watch.scene();
        watch.allowed = if watch.good < WINDOW {
            Allowed::Nothing(Reason::Starting)
        } else {
            Allowed::Law(Box::new(scene))
        };
        watch
    }
}

/// The controller, and what it said last and before.
struct Controller {
    tick: Tick<f64, PathLaw<f64, RigLine<f64>>>,
    said: Command,
    before: Command,
}

impl Controller {
    fn told(mut self, sample: &Sensed<f64>) -> Controller {
        self.before = self.said;
        self.said = self.tick.tick(sample).into();
        self
    }
}

impl StateMachineTest for Controller {
    type SystemUnderTest = Controller;
    type Reference = Watch;

    fn init_test(watch: &Watch) -> Controller {
        let actuation = Actuation::thesis(watch.layout);
        let line = RigLine::through(FROM_M, TO_M).unwrap();
        let law = if watch.with_gap {
            PathLaw::Sdof(Sdof::new(actuation, line, BOUNDARY_M, GAP_M).unwrap())
        } else {
            let gain = 497.0;
            PathLaw::Proportional(Proportional::new(actuation, line, BOUNDARY_M, gain).unwrap())
        };
        let nothing = Command::none(Reason::Starting);
        let mut controller = Controller {
            tick: Tick::new(&Settings::thesis(watch.layout), law).unwrap(),
            said: nothing,
            before: nothing,
        };
        for back in (0..WINDOW).rev() {
            let number = watch.number.wrapping_sub(back);
            controller = controller.told(&Sensed {
                number,
                ..watch.sample()
            });
        }
        controller
    }

    fn apply(controller: Controller, watch: &Watch, _: Event) -> Controller {
        controller.told(&watch.sample())
    }

    fn check_invariants(controller: &Controller, watch: &Watch) {
        let said = &controller.said;
        assert!(brake_count(said, 1).holds(), "{said:?}");
        assert!(braked_joints(watch.layout, said).holds(), "{said:?}");
        for current_a in said.currents_a {
            assert!(current_limit(current_a).holds(), "{said:?}");
        }
        match &watch.allowed {
            Allowed::TheSame => assert_eq!(*said, controller.before),
            Allowed::Nothing(reason) => assert_eq!(*said, Command::none(*reason)),
            Allowed::Law(scene) => {
                assert!(undefined_input(&watch.force_n, said).holds(), "{said:?}");
                let braked: Vec<usize> = watch
                    .layout
                    .brakes()
                    .iter()
                    .map(|joint| *joint as usize)
                    .collect();
                if let Err(why) = scene.check(said.reason, &braked, watch.with_gap) {
                    panic!("{why}");
                }
                if watch.with_gap && (scene.distance_m - GAP_M).abs() > 1e-12 {
                    assert!(
                        gap(scene.distance_m, GAP_M, said).holds(),
                        "{said:?} {scene:?}"
                    );
                }
                let towards_n = scene.desired.towards_path(scene.force_n);
                let along_m_s = scene.desired.direction.dot(&scene.velocity_m_s);
                let sure =
                    scene.pushes_away() != Sure::Either && scene.moves_back() != Sure::Either;
                assert!(
                    !sure || lock(towards_n, along_m_s, said).holds(),
                    "{said:?} {scene:?}"
                );
            }
        }
    }
}

prop_state_machine! {
    #![proptest_config(ProptestConfig {
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))),
        ..ProptestConfig::default()
    })]

    #[test]
    fn a_controller_locks_and_leaves_alone_where_it_may(sequential 1..120 => Controller);
}
