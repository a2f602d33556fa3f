//! This file plants each fault that a tick is guarded against: in the tick of the fault no brake has current, and until it is over.

use rigproof_impl::actuation::Actuation;
use rigproof_impl::command::Command;
use rigproof_impl::guard::{MOST_REPEATS, RECOVERY_SAMPLES};
use rigproof_impl::law::{Law, Sdof, Situation};
use rigproof_impl::path::Line;
use rigproof_impl::tick::{Sensed, Settings, Tick};
use rigproof_impl::vector::Vector;
use rigproof_spec::command::Reason;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::BLEND_BOUNDARY_M;

type Subject = Tick<f64, Sdof<f64, Line<f64>>>;

const ZERO_COUNTS: [i32; 2] = [i32::MAX - 3_001, i32::MIN + 7_013];

fn settings() -> Settings {
    Settings {
        zero_counts: ZERO_COUNTS,
        ..Settings::thesis(Layout::ThreeBrake)
    }
}

fn subject() -> Subject {
    let line = Line::through([-0.113, 0.383], [0.107, 0.412]).unwrap();
    let actuation = Actuation::thesis(Layout::ThreeBrake);
    let law = Sdof::new(actuation, line, BLEND_BOUNDARY_M, 0.0).unwrap();
    Tick::new(&settings(), law).unwrap()
}

/// A good sample: the tip stands below the line, pushed along it and away from it.
fn good(number: u32) -> Sensed<f64> {
    // θA 128.7° and θB 49.3°, beyond the end of A's counter.
    let [zero_a, zero_b] = ZERO_COUNTS;
    Sensed {
        number,
        counts: [zero_a.wrapping_add(35_750), zero_b.wrapping_add(13_694)],
        tip_force_n: Vector::new(3.7, -1.9),
    }
}

/// A tick after 20 good samples, the last of number 19, and the command it gives.
fn running() -> (Subject, Command<f64>) {
    let mut subject = subject();
    let mut command = Command::none(Reason::Starting);
    for number in 0..20 {
        command = subject.tick(&good(number));
    }
    assert!(acts(&command), "{command:?}");
    (subject, command)
}

fn acts(command: &Command<f64>) -> bool {
    command.currents_a.iter().any(|current_a| *current_a > 0.0)
}

/// Plants a sample after 20 good ones and says what comes of it; then good samples of consecutive numbers must recover it in time.
#[track_caller]
fn plant(bad: Sensed<f64>, expected: Reason) {
    let (mut subject, before) = running();
    assert_eq!(subject.tick(&bad), Command::none(expected));
    let first = bad.number.wrapping_add(1);
    for i in 0..u32::from(RECOVERY_SAMPLES) - 1 {
        let command = subject.tick(&good(first.wrapping_add(i)));
        assert_eq!(command, Command::none(Reason::Starting));
    }
    let recovered = first.wrapping_add(u32::from(RECOVERY_SAMPLES) - 1);
    assert_eq!(subject.tick(&good(recovered)), before);
}

#[test]
fn the_first_ticks_give_no_current() {
    let mut subject = subject();
    for number in 0..u32::from(RECOVERY_SAMPLES) - 1 {
        let command = subject.tick(&good(number));
        assert_eq!(command, Command::none(Reason::Starting));
    }
    assert!(acts(&subject.tick(&good(u32::from(RECOVERY_SAMPLES) - 1))));
}

#[test]
fn a_force_that_is_no_number_lets_go() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 213.7, -1e300] {
        for tip_force_n in [Vector::new(bad, 1.3), Vector::new(1.3, bad)] {
            let bad = Sensed {
                tip_force_n,
                ..good(20)
            };
            plant(bad, Reason::UndefinedInput);
        }
    }
}

#[test]
fn counts_that_jump_let_go() {
    let good = good(20);
    let [a, b] = good.counts;
    // 478 counts in a sample are 30 rad/s.
    for counts in [
        [a.wrapping_add(479), b],
        [a, b.wrapping_sub(479)],
        [a ^ 0x4000, b],
    ] {
        plant(Sensed { counts, ..good }, Reason::JumpedCounts);
    }
    let fast = Sensed {
        counts: [a.wrapping_add(478), b.wrapping_sub(478)],
        ..good
    };
    let (mut subject, _) = running();
    assert!(subject.tick(&fast).reason != Reason::JumpedCounts);
}

#[test]
fn counts_that_were_lost_let_go_for_good() {
    let (mut subject, _) = running();
    let [a, b] = good(20).counts;
    for number in 20..3000 {
        let lost = Sensed {
            counts: [a.wrapping_sub(5_000), b],
            ..good(number)
        };
        assert_eq!(subject.tick(&lost), Command::none(Reason::JumpedCounts));
    }
}

#[test]
fn counts_of_more_than_a_turn_let_go() {
    let mut subject = subject();
    let [zero_a, zero_b] = ZERO_COUNTS;
    for number in 0..20 {
        let sensed = Sensed {
            counts: [zero_a.wrapping_add(100_001), zero_b.wrapping_add(13_694)],
            ..good(number)
        };
        assert_eq!(subject.tick(&sensed), Command::none(Reason::JumpedCounts));
    }
}

#[test]
fn a_missed_sample_lets_go() {
    for number in [21, 18, 4_000_000_000] {
        plant(good(number), Reason::StaleSample);
    }
}

#[test]
fn a_sample_that_repeats_holds_the_command_for_a_while_and_then_lets_go() {
    let (mut subject, before) = running();
    // Whatever else a repeated sample says, it is not looked at.
    let repeated = Sensed {
        tip_force_n: Vector::new(f64::NAN, f64::NAN),
        ..good(19)
    };
    for _ in 0..MOST_REPEATS {
        assert_eq!(subject.tick(&repeated), before);
    }
    for _ in 0..1000 {
        assert_eq!(subject.tick(&repeated), Command::none(Reason::StaleSample));
    }
    let (mut subject, before) = running();
    subject.tick(&repeated);
    assert_eq!(subject.tick(&good(20)), before);
}

#[test]
fn a_pose_that_cannot_be_lets_go() {
    let mut subject = subject();
    let [zero_a, zero_b] = ZERO_COUNTS;
    let mut reasons = Vec::new();
    for number in 0..20 {
        // θA 12.3° and θB 121°: the arms have crossed.
        let sensed = Sensed {
            counts: [zero_a.wrapping_add(3_417), zero_b.wrapping_add(33_611)],
            ..good(number)
        };
        let command = subject.tick(&sensed);
        assert!(!acts(&command));
        reasons.push(command.reason);
    }
    assert_eq!(reasons.last(), Some(&Reason::SingularPose));
}

/// A law gone mad: currents and reason as told.
#[derive(Clone, Copy)]
struct Mad(Command<f64>);

impl Law<f64> for Mad {
    fn actuation(&self) -> Option<&Actuation<f64>> {
        None
    }

    fn command(&mut self, _: &Situation<f64>) -> Command<f64> {
        self.0
    }
}

fn mad(currents_a: [f64; 4], reason: Reason) -> Command<f64> {
    let law = Mad(Command { currents_a, reason });
    let mut subject = Tick::new(&settings(), law).unwrap();
    let mut command = Command::none(Reason::Starting);
    for number in 0..20 {
        command = subject.tick(&good(number));
    }
    command
}

#[test]
fn a_law_that_asks_for_what_no_brake_may_be_given_is_let_go() {
    let refused = Command::none(Reason::RefusedCommand);
    for (currents_a, reason) in [
        ([f64::NAN, 0.0, 0.0, 0.0], Reason::Chosen(Joint::A)),
        ([0.0, 0.0, f64::INFINITY, 0.0], Reason::LockedPushedAway),
        ([0.0, 0.0, 0.0, 0.31], Reason::Chosen(Joint::C)),
        ([1.0, 1.0, 1.0, 1.0], Reason::LockedMovingBack),
        ([0.0, 0.31, 0.0, 0.0], Reason::Chosen(Joint::A)),
        ([0.31, 0.0, 0.0, 0.0], Reason::InsideGap),
        ([1.7, 0.41, 0.37, 0.0], Reason::LockedPushedAway),
        ([0.93, -0.3, 0.37, 0.0], Reason::LockedPushedAway),
    ] {
        assert_eq!(mad(currents_a, reason), refused);
    }
    let clamped = mad([1.007, -0.003, 0.37, 0.0], Reason::LockedPushedAway);
    assert_eq!(clamped.currents_a, [1.0, 0.0, 0.37, 0.0]);
}

#[test]
fn settings_of_no_rig_are_refused() {
    let law = Mad(Command::none(Reason::NothingToDo));
    assert!(Tick::new(&settings(), law).is_some());
    let changes: [fn(&mut Settings); 8] = [
        |settings| settings.arms.l_cd_m = 0.0,
        |settings| settings.arms.l_ae_m = f64::NAN,
        |settings| settings.arms.l_ab_m = -0.1,
        |settings| settings.counts_per_turn = [100_000, 0],
        |settings| settings.counts_per_turn = [u32::MAX, 100_000],
        |settings| settings.sample_s = f64::NAN,
        |settings| settings.greatest_rate_rad_s = f64::INFINITY,
        |settings| settings.greatest_force_n = 0.0,
    ];
    for change in changes {
        let mut settings = settings();
        change(&mut settings);
        assert!(Tick::new(&settings, law).is_none());
    }
}

#[test]
fn a_law_of_another_rig_is_refused() {
    let line = Line::through([-0.113, 0.383], [0.107, 0.412]).unwrap();
    let law = |actuation| Sdof::new(actuation, line, BLEND_BOUNDARY_M, 0.0).unwrap();
    let layout = Layout::ThreeBrake;
    let arms = rigproof_spec::geometry::arms(layout);
    let mut longer = arms;
    longer.l_cd_m += 1e-15;
    let rig = settings();
    let own = Actuation::new(layout, &arms, 11.3).unwrap();
    assert!(Tick::<f64, _>::new(&rig, law(own)).is_some());
    let with_c = Actuation::new(Layout::FourBrake, &arms, 11.3).unwrap();
    for other in [Actuation::new(layout, &longer, 11.3).unwrap(), with_c] {
        assert!(Tick::<f64, _>::new(&rig, law(other)).is_none());
    }
}
