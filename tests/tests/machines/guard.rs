//! This file says that the rig's guard lets samples through only after a whole window of good ones, whatever came before.

use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;
use proptest_state_machine::{ReferenceStateMachine, StateMachineTest, prop_state_machine};
use rigproof_impl::guard::{Guard, Verdict};
use rigproof_spec::command::Reason;

/// Most counts a sample, A and B.
const GREATEST_STEP: [u32; 2] = [479, 97];
const GREATEST_FORCE_N: f64 = 200.0;
/// Good samples in a row after which a law is asked (decision 0074).
const WINDOW: usize = 9;
/// Ticks without a new sample that are let pass.
const REPEATS: usize = 2;

/// What happens in a tick.
#[derive(Clone, Debug)]
enum Event {
    /// The next sample, moved by counts that a joint can move.
    Next([i32; 2]),
    /// The same sample again.
    Again,
    /// So many samples were lost.
    Lost(u32),
    /// A joint moved further than it can.
    Jump(i32),
    /// The counts are where they were last believed.
    Back,
    /// A joint stands where it cannot.
    Unreached,
    /// A force that is no number or beyond its sensor.
    Force(f64),
}

/// What came in so far, kept whole: the reference judges by reading it back.
#[derive(Clone, Debug, Default)]
struct Record {
    number: u32,
    travels: [i32; 2],
    started: bool,
    /// The last travels that were possible.
    believed: Option<[i32; 2]>,
    jumped: bool,
    /// `true` for a good sample, `false` for a fault, in the order of the ticks.
    good: Vec<bool>,
    repeats: usize,
    event: Option<Event>,
}

impl Record {
    fn verdict(&self) -> Verdict {
        match &self.event {
            Some(Event::Again) if self.started && self.repeats <= REPEATS => Verdict::Repeated,
            Some(Event::Again) if self.started => Verdict::Fault(Reason::StaleSample),
            _ if self.jumped => Verdict::Fault(Reason::JumpedCounts),
            Some(Event::Lost(_)) if self.started => Verdict::Fault(Reason::StaleSample),
            Some(Event::Force(_)) => Verdict::Fault(Reason::UndefinedInput),
            _ if self.good.iter().rev().take_while(|good| **good).count() < WINDOW => {
                Verdict::Early
            }
            _ => Verdict::Good,
        }
    }
}

impl ReferenceStateMachine for Record {
    type State = Record;
    type Transition = Event;

    fn init_state() -> BoxedStrategy<Record> {
        let number = prop_oneof![any::<u32>(), Just(u32::MAX - 3)];
        let record = |number| Record {
            number,
            ..Record::default()
        };
        number.prop_map(record).boxed()
    }

    fn transitions(_: &Record) -> BoxedStrategy<Event> {
        let force = prop_oneof![
            Just(f64::NAN),
            Just(f64::INFINITY),
            Just(-1e300),
            200.1..1e4_f64
        ];
        prop_oneof![
            12 => (-479..480_i32, -97..98_i32).prop_map(|(a, b)| Event::Next([a, b])),
            2 => Just(Event::Again),
            1 => (1..u32::MAX - 1).prop_map(Event::Lost),
            1 => prop_oneof![480..9000_i32, -9000..-479_i32].prop_map(Event::Jump),
            1 => Just(Event::Back),
            1 => Just(Event::Unreached),
            1 => force.prop_map(Event::Force),
        ]
        .boxed()
    }

    fn apply(mut record: Record, event: &Event) -> Record {
        record.event = Some(event.clone());
        if matches!(event, Event::Again) && record.started {
            record.repeats += 1;
            if record.repeats > REPEATS {
                record.good.push(false);
            }
            return record;
        }
        record.repeats = 0;
        let skipped = if let Event::Lost(lost) = event {
            *lost
        } else {
            0
        };
        record.number = record.number.wrapping_add(1).wrapping_add(skipped);
        let [a, b] = match event {
            Event::Next(moved) => *moved,
            Event::Jump(moved) => [*moved, 0],
            Event::Back => {
                let [to_a, to_b] = record.believed.unwrap_or(record.travels);
                [to_a - record.travels[0], to_b - record.travels[1]]
            }
            _ => [0, 0],
        };
        record.travels = [record.travels[0] + a, record.travels[1] + b];
        let far = |believed: [i32; 2]| {
            let apart = [0, 1].map(|i| record.travels[i].abs_diff(believed[i]));
            apart[0] > GREATEST_STEP[0] || apart[1] > GREATEST_STEP[1]
        };
        record.jumped = matches!(event, Event::Unreached) || record.believed.is_some_and(far);
        if !record.jumped {
            record.believed = Some(record.travels);
        }
        let good = !record.jumped
            && match event {
                Event::Unreached | Event::Force(_) => false,
                Event::Lost(_) => !record.started,
                Event::Jump(_) | Event::Back | Event::Next(_) | Event::Again => true,
            };
        record.good.push(good);
        // What came before the first sample cannot have been missed.
        if !record.started && good {
            record.event = Some(Event::Next([0, 0]));
        }
        record.started = true;
        record
    }
}

/// The guard, and what it said last.
struct Watched {
    guard: Guard<f64>,
    verdict: Option<Verdict>,
}

impl StateMachineTest for Watched {
    type SystemUnderTest = Watched;
    type Reference = Record;

    fn init_test(_: &Record) -> Watched {
        Watched {
            guard: Guard::new(GREATEST_STEP, GREATEST_FORCE_N),
            verdict: None,
        }
    }

    fn apply(mut watched: Watched, record: &Record, event: Event) -> Watched {
        let force_n = match event {
            Event::Force(bad) => [3.7, bad],
            _ => [3.7, -1.9],
        };
        let reached = !matches!(event, Event::Unreached);
        let judged = watched
            .guard
            .judge(record.number, record.travels, reached, force_n);
        watched.verdict = Some(judged);
        watched
    }

    fn check_invariants(watched: &Watched, record: &Record) {
        let Some(verdict) = watched.verdict else {
            return;
        };
        assert_eq!(verdict, record.verdict(), "{record:?}");
        if verdict == Verdict::Good {
            assert!(record.good.iter().rev().take(WINDOW).all(|good| *good));
        }
    }
}

prop_state_machine! {
    #![proptest_config(ProptestConfig {
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))),
        ..ProptestConfig::default()
    })]

    #[test]
    fn a_sample_is_good_only_after_a_window_of_good_ones(sequential 1..120 => Watched);
}
