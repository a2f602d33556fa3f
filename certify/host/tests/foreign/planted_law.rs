//! This file plants bugs around a law of the rig in C, and says which law refuses each; without a bug it passes, beside the reference too.
//!
//! With `RIGPROOF_CAMPAIGN` all of them are planted; without it the first few are.

use std::fs;
use std::path::{Path, PathBuf};

use rigproof_certify::built_in::BuiltIn;
use rigproof_certify::controller::Task;
use rigproof_certify::law::Law;
use rigproof_certify::scenario::{Rig, Scenario};
use rigproof_certify::trial::run;
use rigproof_spec::methods::Method;

use crate::bench::{ROOM, compiled, foreign, limits};
use crate::examples::built;
use crate::planted::refused;

/// A bug: its name, what it is beside, what is put where, and the law that it breaks.
type Planted = (&'static str, Method, &'static [(Place, &'static str)], Law);

/// Where code is put in the example.
#[derive(Clone, Copy)]
enum Place {
    /// Beside the controller's memory.
    Memory,
    /// At the end of the settings.
    Begin,
    /// After the counts are told.
    Told,
    /// After the currents are written.
    Answered,
}

impl Place {
    /// The line behind which the code is put.
    fn line(self) -> &'static str {
        match self {
            Place::Memory => "static RigproofTick controller;",
            Place::Begin => "settings.gain_n_s_per_m = GAIN_N_S_PER_M;",
            Place::Told => "memcpy(sensed.counts, told->counts, sizeof sensed.counts);",
            Place::Answered => {
                "memcpy(commanded->currents_a, command.currents_a, sizeof commanded->currents_a);"
            }
        }
    }
}

use Place::{Answered, Begin, Memory, Told};

const GAP: &str = "settings.law = RIGPROOF_TICK_LAW_SDOF; settings.gap_m = 0.005;";

const PLANTED: [Planted; 11] = [
    (
        "swapped brakes",
        Method::ProportionalLow,
        &[(
            Answered,
            "double e = commanded->currents_a[1]; commanded->currents_a[1] = commanded->currents_a[2]; commanded->currents_a[2] = e;",
        )],
        Law::Influence,
    ),
    (
        "gap off by a factor",
        Method::SdofWithGap,
        &[(Begin, GAP), (Begin, "settings.gap_m = 0.0025;")],
        Law::Gap,
    ),
    (
        "no number on a line through the origin",
        Method::ProportionalLow,
        &[
            (Memory, "static double off_m2;"),
            (
                Begin,
                "const double (*p)[2] = told->points_m; off_m2 = told->points == 2 ? p[0][0] * p[1][1] - p[0][1] * p[1][0] : 1.0;",
            ),
            (
                Answered,
                "for (int i = 0; i < 4; i++) commanded->currents_a[i] *= off_m2 / off_m2;",
            ),
        ],
        Law::CurrentLimit,
    ),
    (
        "stale sample",
        Method::SdofWithGap,
        &[
            (Memory, "static int32_t last[2]; static int known;"),
            (Begin, GAP),
            (Begin, "known = 0;"),
            (
                Told,
                "if (known) memcpy(sensed.counts, last, sizeof last); memcpy(last, told->counts, sizeof last); known = 1;",
            ),
        ],
        Law::Gap,
    ),
    (
        "wrong lock condition",
        Method::ProportionalLow,
        &[
            (Memory, "static uint32_t brakes;"),
            (Begin, "brakes = told->brakes;"),
            (
                Answered,
                "if (command.reason == RIGPROOF_TICK_REASON_NONE_HELPS) for (uint32_t i = 0; i < brakes; i++) commanded->currents_a[i] = 1.0;",
            ),
        ],
        Law::Lock,
    ),
    (
        "integrator windup",
        Method::SdofWithGap,
        &[
            (Memory, "static double sum_a;"),
            (Begin, GAP),
            (Begin, "sum_a = 0.0;"),
            (
                Answered,
                "double *a = commanded->currents_a; sum_a += 2e-4 * (a[0] + a[2] - 0.1); sum_a = sum_a < 0.0 ? 0.0 : sum_a > 0.3 ? 0.3 : sum_a; a[1] = a[1] + sum_a > 1.0 ? 1.0 : a[1] + sum_a;",
            ),
        ],
        Law::BrakeCount,
    ),
    (
        "sense of one encoder",
        Method::ProportionalLow,
        &[
            (Memory, "static int32_t zero;"),
            (Begin, "zero = told->zero_counts[1];"),
            (Told, "sensed.counts[1] = 2 * zero - sensed.counts[1];"),
        ],
        Law::Influence,
    ),
    (
        "missing normalisation",
        Method::ProportionalLow,
        &[(
            Begin,
            "const double (*to)[2] = told->points_m; double x = to[1][0] - to[0][0], y = to[1][1] - to[0][1]; settings.gain_n_s_per_m *= x * x + y * y;",
        )],
        Law::Reference,
    ),
    (
        "chatter",
        Method::ProportionalLow,
        &[(
            Answered,
            "if (told->number % 3 == 0) memset(commanded->currents_a, 0, sizeof commanded->currents_a);",
        )],
        Law::Reference,
    ),
    (
        "out-of-range current",
        Method::ProportionalLow,
        &[(
            Answered,
            "for (int i = 0; i < 4; i++) commanded->currents_a[i] *= 1.2;",
        )],
        Law::CurrentLimit,
    ),
    (
        "a glitch in 10⁶ samples",
        Method::ProportionalLow,
        &[(
            Answered,
            "if (told->number % 1000003 == 17) commanded->currents_a[1] = 1.01;",
        )],
        Law::CurrentLimit,
    ),
];

/// The example with code put in; `None` without a C compiler.
fn planted(name: &str, code: &[(Place, &str)]) -> Option<PathBuf> {
    let tick = built("", "librigproof_impl_c", ".a").expect("cargo builds the static library");
    let mut source =
        fs::read_to_string(Path::new(ROOM).join("../c/examples/proportional.c")).unwrap();
    // What is put behind one line stands in the order in which it is told.
    for (place, code) in code.iter().rev() {
        let line = place.line();
        assert_eq!(source.matches(line).count(), 1, "{line}");
        source = source.replace(line, &format!("{line} {code}"));
    }
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.c"));
    fs::write(&file, source).unwrap();
    let told = [tick.to_str().unwrap(), "-w", "-lpthread", "-ldl"];
    let file = file.canonicalize().unwrap();
    let up = "../".repeat(Path::new(ROOM).canonicalize().unwrap().components().count());
    compiled(name, &format!("{up}{}", file.display()), &told)
}

fn drawn(index: u64) -> Scenario {
    Scenario::drawn(5, index, &[Rig::ThreeBrake, Rig::FourBrake], 2000)
}

/// The scenarios that the example takes: it knows chains only.
fn chains() -> impl Iterator<Item = u64> {
    (0..4000).filter(|index| matches!(drawn(*index).task, Task::Chain(_)))
}

#[test]
fn every_bug_planted_around_a_law_in_c_is_refused_by_its_law_and_shrunk() {
    let Some(sound) = planted("law_sound", &[]) else {
        return;
    };
    let (source, declared) = (
        foreign(&sound, limits()),
        BuiltIn::of(Method::ProportionalLow).declared(),
    );
    for index in chains().take(2) {
        let ran = run(&drawn(index), &source, &declared, false).unwrap();
        assert!(ran.fared[Law::Reference as usize].samples > 0);
        let broken: Vec<_> = ran.broken().collect();
        assert!(broken.is_empty(), "{index}: {broken:?}");
    }
    let all = std::env::var("RIGPROOF_CAMPAIGN").is_ok();
    let count = if all { PLANTED.len() } else { 2 };
    for (number, (name, method, code, law)) in PLANTED.into_iter().take(count).enumerate() {
        let library = planted(&format!("law_{number}"), code).unwrap();
        let has_met = |index: &u64| {
            let mut numbers = (0..2000).map(|tick| drawn(*index).first_number.wrapping_add(tick));
            !name.contains("glitch") || numbers.any(|number| number % 1_000_003 == 17)
        };
        let source = foreign(&library, limits());
        let declared = BuiltIn::of(method).declared();
        refused(
            name,
            &source,
            &declared,
            law,
            drawn,
            chains().filter(has_met),
        );
    }
}
