//! This file sends recordings of the rig through an old and a new controller: an unchanged one passes bit for bit, and every planted change is found with its field and its time.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use rigproof_certify::built_in::{BuiltIn, Kind};
use rigproof_certify::controller::{Source, Task};
use rigproof_certify::declared::Declared;
use rigproof_certify::law::Law;
use rigproof_certify::recordings::answered;
use rigproof_certify::recordings::compare::Compared;
use rigproof_certify::recordings::expected::{Expected, Unmeant};
use rigproof_certify::recordings::looks::Looks;
use rigproof_certify::recordings::taken::Taken;
use rigproof_certify::scenario::{Rig, Scenario};
use rigproof_certify::trial::run;
use rigproof_impl::tick::Sensed;
use rigproof_impl::vector::Vector;
use rigproof_spec::methods::Method;
use rigproof_trace::rig::five_bar::FiveBar;

use crate::bent::{after, before};

/// The rig's description, as a laboratory writes it.
const RIG: &str = r#"name = "the rig"
plant = "rig"
layout = "four_brake"
[channels]
theta_a = { channel = "theta_A", unit = "rad", quantum = 6.283185307179586e-5 }
theta_b = { channel = "theta_B", unit = "rad", quantum = 6.283185307179586e-5 }
force_x = { channel = "F_x", unit = "N" }
force_y = { channel = "F_y", unit = "N" }
current_a = { channel = "I_A", unit = "A" }
current_e = { channel = "I_E", unit = "A" }
current_b = { channel = "I_B", unit = "A" }
current_c = { channel = "I_C", unit = "A" }
"#;

/// How many recordings.
const COUNT: u64 = 10;

fn low(gain_n_s_per_m: f64) -> BuiltIn {
    BuiltIn {
        law: Kind::Proportional { gain_n_s_per_m },
        ..BuiltIn::of(Method::ProportionalLow)
    }
}

const GAIN_N_S_PER_M: f64 = 430.0;

/// A law with a gain that is 3 % greater.
fn stronger() -> BuiltIn {
    low(1.03 * GAIN_N_S_PER_M)
}

/// What is changed: its name and the controller.
fn changes() -> Vec<(&'static str, Box<dyn Source>)> {
    let law = low(GAIN_N_S_PER_M);
    vec![
        ("gain", Box::new(stronger())),
        (
            "sign of one brake",
            // No current has no sign.
            after(law, (), |(), _, [a, e, b, c]| {
                Ok([a, if e == 0.0 { e } else { -e }, b, c])
            }),
        ),
        (
            "stale sample",
            before(law, None, |last: &mut Option<Sensed<f64>>, sensed| {
                last.replace(*sensed).unwrap_or(*sensed)
            }),
        ),
        (
            "swapped channels",
            before(law, (), |(), sensed| Sensed {
                tip_force_n: Vector::new(sensed.tip_force_n.y, sensed.tip_force_n.x),
                ..*sensed
            }),
        ),
        (
            "a filter's delay",
            before(law, None, |filtered: &mut Option<Vector<f64>>, sensed| {
                let force_n = sensed.tip_force_n;
                let from = filtered.unwrap_or(force_n);
                let now = from + (force_n - from) * 0.2;
                // A filter forgets what is no number.
                *filtered = now.norm_squared().is_finite().then_some(now);
                Sensed {
                    tip_force_n: filtered.unwrap_or(force_n),
                    ..*sensed
                }
            }),
        ),
    ]
}

/// A trial as a laboratory's recorder writes it: a row for every new sample, an empty cell for what is no number.
fn written(told: &[(Sensed<f64>, [f64; 4])]) -> String {
    let mut text = String::from(
        "t (s),theta_A (rad),theta_B (rad),F_x (N),F_y (N),I_A (A),I_E (A),I_B (A),I_C (A)\n",
    );
    let mut last = None;
    for (sensed, currents_a) in told {
        if last.replace(sensed.number) == Some(sensed.number) {
            continue;
        }
        write!(text, "{:.3}", 1e-3 * f64::from(sensed.number)).unwrap();
        for count in sensed.counts {
            write!(text, ",{:.9}", f64::from(count) * 6.283185307179586e-5).unwrap();
        }
        let force_n: [f64; 2] = sensed.tip_force_n.into();
        for value in force_n.into_iter().chain(*currents_a) {
            match value.is_finite() {
                true => write!(text, ",{value}").unwrap(),
                false => text.push(','),
            }
        }
        text.push('\n');
    }
    text
}

/// Ten recordings that this project's own plant makes under the old controller, faults included, and the path; made once for all tests.
fn simulated() -> (Vec<Taken>, Task) {
    static MADE: OnceLock<(Vec<Taken>, Task)> = OnceLock::new();
    MADE.get_or_init(made).clone()
}

fn made() -> (Vec<Taken>, Task) {
    let rig = FiveBar::parse(RIG, Path::new("rig.toml")).unwrap();
    let declared = Declared::default();
    let base = Scenario::drawn(31, 4, &[Rig::FourBrake], 3000);
    let one = |index: u64| {
        let scenario = Scenario {
            task: base.task.clone(),
            theta_rad: base.theta_rad,
            zero_counts: [0; 2],
            first_number: 0,
            ..Scenario::drawn(31, index, &[Rig::FourBrake], 3000)
        };
        let ran = run(&scenario, &low(GAIN_N_S_PER_M), &declared, false).unwrap();
        let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("recorded_{index}.csv"));
        std::fs::write(&file, written(&ran.told)).unwrap();
        let recording = rig.read_recording(&file).unwrap();
        let taken = Taken::of(rig.layout, &recording).unwrap();
        is_what_was_told(&taken, &ran.told);
        taken
    };
    ((100..100 + COUNT).map(one).collect(), base.task)
}

/// What is taken from the file is what the controller was told, but for samples that were told again and forces that were no number.
fn is_what_was_told(taken: &Taken, told: &[(Sensed<f64>, [f64; 4])]) {
    let mut new: Vec<&(Sensed<f64>, [f64; 4])> = told.iter().collect();
    new.dedup_by_key(|(sensed, _)| sensed.number);
    assert_eq!(taken.told.len(), new.len());
    for (k, (own, (sensed, currents_a))) in taken.told.iter().zip(new).enumerate() {
        assert_eq!(
            (own.number, own.counts),
            (sensed.number, sensed.counts),
            "{k}"
        );
        assert_eq!(taken.recorded_a[k], *currents_a);
        let pairs = [
            (own.tip_force_n.x, sensed.tip_force_n.x),
            (own.tip_force_n.y, sensed.tip_force_n.y),
        ];
        assert!(
            pairs
                .into_iter()
                .all(|(own, n)| own == n || own.is_nan() && !n.is_finite())
        );
    }
}

/// Ten recordings that an independent simulation made, each with its own description; `None` where they are not at hand.
fn independent() -> Option<(Vec<Taken>, Task)> {
    let near = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data");
    let data = std::env::var_os("RIGPROOF_DATA").map_or_else(near, PathBuf::from);
    if !data.join("rigs").is_dir() {
        println!(
            "passed over: no recordings of the rig at {}",
            data.display()
        );
        return None;
    }
    let all = (1..=16).filter_map(|number| {
        let rig = FiveBar::read(&data.join(format!("rigs/rig_{number:02}.toml"))).ok()?;
        let file = data.join(format!("rigs/rig_{number:02}.csv"));
        let recording = rig.read_recording(&file).unwrap();
        Some(Taken::of(rig.layout, &recording).unwrap())
    });
    let path = Task::Chain(vec![[-0.12, 0.37], [0.02, 0.43], [0.13, 0.39]]);
    Some((all.take(COUNT as usize).collect(), path))
}

/// The first sample in which two controllers differ, found by asking them both and nothing else.
fn first_by_hand(
    taken: &Taken,
    task: &Task,
    one: &dyn Source,
    other: &dyn Source,
) -> Option<usize> {
    let mut one = one.begin(&taken.settings, task).unwrap();
    let mut other = other.begin(&taken.settings, task).unwrap();
    taken.told.iter().position(|sensed| {
        let bits = |a: [f64; 4]| a.map(f64::to_bits);
        bits(one.tick(sensed).unwrap()) != bits(other.tick(sensed).unwrap())
    })
}

fn compared(taken: &Taken, task: &Task, new: &dyn Source, expected: Option<&Expected>) -> Compared {
    let old = low(GAIN_N_S_PER_M);
    let through =
        |source: &dyn Source, declared: &Declared| answered(taken, task, source, declared).unwrap();
    // Which law of the rig it is, only the old one claims: `reference` looks at it alone.
    let claims = old.declared();
    let promises = Declared {
        reference: None,
        ..claims
    };
    let (before, now) = (through(&old, &claims), through(new, &promises));
    Compared::of(taken, task, [&before, &now], expected)
}

/// Holds ten recordings to what a replay has to show, and prints it.
fn shows(name: &str, recordings: &[Taken], task: &Task) {
    assert_eq!(recordings.len() as u64, COUNT);
    let samples: usize = recordings.iter().map(|own| own.told.len()).sum();
    let faults: usize = recordings.iter().map(Taken::faults).sum();
    println!("{name}: {COUNT} recordings, {samples} samples, {faults} with a fault");
    for taken in recordings {
        let same = compared(taken, task, &low(GAIN_N_S_PER_M), None);
        assert_eq!((same.differing, same.holds()), (0, true));
        assert_eq!(same.samples, taken.told.len());
    }
    println!(
        "  {:<20} found in  first at (brakes)       differ  most    laws more broken",
        "change"
    );
    for (change, source) in changes() {
        let mut found = 0;
        let mut shown = String::new();
        let (mut differing, mut most_a) = (0, 0.0_f64);
        let mut laws: Vec<&str> = Vec::new();
        for taken in recordings {
            let own = compared(taken, task, source.as_ref(), None);
            let by_hand = first_by_hand(taken, task, &low(GAIN_N_S_PER_M), source.as_ref());
            let first = own.first.as_ref();
            assert_eq!(first.map(|own| own.sample), by_hand, "{change}");
            let Some(first) = first else { continue };
            assert_eq!(first.time_s, taken.time_s[first.sample]);
            assert!(!first.brakes.is_empty() && !own.holds(), "{change}");
            assert_eq!(first.state.counts, taken.told[first.sample].counts);
            if change == "sign of one brake" {
                assert_eq!(first.brakes, ["E"]);
                assert!(own.broken.iter().any(|own| own.law == Law::CurrentLimit));
            }
            if change == "stale sample" {
                assert_eq!(own.looks, [Looks::Later(1)]);
            }
            found += 1;
            differing += own.differing;
            let fields = own.brakes.iter().filter_map(|field| field.greatest_a);
            most_a = fields.fold(most_a, |most, a| most.max(a.abs()));
            laws.extend(own.broken.iter().map(|own| own.law.name()));
            if shown.is_empty() {
                shown = format!("{:.3} s ({})", first.time_s, first.brakes.join(" "));
            }
        }
        laws.sort_unstable();
        laws.dedup();
        println!(
            "  {change:<20} {found:>8}  {shown:<22} {differing:>7}  {most_a:.4} A  {}",
            laws.join(" ")
        );
        // Where a change makes no difference there is none to be found: asked by hand, the controllers command the same.
        assert!(2 * found >= COUNT, "{change} is found in {found}");
    }
}

#[test]
fn five_planted_changes_are_found_in_ten_recordings_with_field_and_time() {
    let (recordings, task) = simulated();
    assert!(recordings.iter().map(Taken::faults).sum::<usize>() > 20);
    shows("the project's own plant", &recordings, &task);
}

#[test]
fn five_planted_changes_are_found_in_ten_recordings_of_another_simulation() {
    let Some((recordings, task)) = independent() else {
        return;
    };
    shows("an independent simulation", &recordings, &task);
}

#[test]
fn the_old_controller_commands_what_was_recorded() {
    let (recordings, task) = simulated();
    for taken in &recordings {
        let own = compared(taken, &task, &low(GAIN_N_S_PER_M), None);
        // What was told again is not in the file; everything else is.
        assert_eq!(own.recorded.samples, taken.told.len());
        assert!(
            own.recorded.same as f64 > 0.98 * own.recorded.samples as f64,
            "{own:?}"
        );
        // With another path it does not.
        let other = Task::Chain(vec![[-0.2, 0.31], [0.2, 0.33]]);
        let old = low(GAIN_N_S_PER_M);
        let elsewhere = answered(taken, &other, &old, &old.declared()).unwrap();
        let elsewhere = Compared::of(taken, &other, [&elsewhere, &elsewhere], None);
        assert!(elsewhere.recorded.same < own.recorded.same);
    }
}

/// What a replay says of each recording, of a controller and what is expected.
fn all(
    recordings: &[Taken],
    task: &Task,
    source: &dyn Source,
    expected: &Expected,
) -> Vec<Compared> {
    let each = recordings.iter();
    each.map(|taken| compared(taken, task, source, Some(expected)))
        .collect()
}

/// A gain of 3 % more changes no command by as much as this, A.
const MEANT: Expected = Expected {
    brakes: None,
    most_a: Some(0.05),
    most_share: None,
    same_brakes: false,
};

#[test]
fn what_is_meant_passes_and_nothing_else_does() {
    let (recordings, task) = simulated();
    let all = |source: &dyn Source, expected: &Expected| all(&recordings, &task, source, expected);
    let meant = MEANT;
    let gain = stronger();
    for own in all(&gain, &meant) {
        assert!(own.holds() && own.differing > 0, "{own:?}");
    }
    let too_narrow = Expected {
        most_a: Some(1e-6),
        ..meant
    };
    for own in all(&gain, &too_narrow) {
        let (first, why) = own.first_unmeant.clone().unwrap();
        assert_eq!(why, Unmeant::TooMuch);
        assert!(first.sample >= own.first.as_ref().unwrap().sample && !own.holds());
    }
    let seldom = Expected {
        most_share: Some(1e-4),
        ..meant
    };
    assert!(
        all(&gain, &seldom)
            .iter()
            .all(|own| own.is_too_often && !own.holds())
    );
    let of_a = Expected {
        brakes: Some([true, false, false, false]),
        ..meant
    };
    let others = all(&gain, &of_a);
    assert!(others.iter().any(|own| {
        own.first_unmeant.as_ref().is_some_and(|(first, why)| {
            *why == Unmeant::AnotherBrake && first.brakes.iter().any(|brake| *brake != "A")
        })
    }));
    for (change, source) in changes().iter().skip(1) {
        let found = all(source.as_ref(), &meant);
        let differ = found.iter().filter(|own| own.differing > 0);
        assert!(
            differ.clone().count() > 4 && differ.clone().all(|own| !own.holds()),
            "{change}"
        );
    }
}

#[test]
fn a_brake_that_did_not_act_before_is_unmeant_where_the_same_ones_have_to() {
    let (recordings, task) = simulated();
    let same = Expected {
        same_brakes: true,
        ..MEANT
    };
    // A greater gain lets brakes act that did not.
    let found = all(&recordings, &task, &stronger(), &same);
    let unmeant: Vec<_> = found
        .into_iter()
        .filter_map(|own| own.first_unmeant)
        .collect();
    assert!(!unmeant.is_empty());
    for (first, why) in unmeant {
        let pairs = first.old_a.unwrap().into_iter().zip(first.new_a.unwrap());
        assert_eq!(why, Unmeant::OtherBrakesAct);
        assert!(
            pairs
                .into_iter()
                .any(|(old, new)| (old == 0.0) != (new == 0.0))
        );
    }
}
