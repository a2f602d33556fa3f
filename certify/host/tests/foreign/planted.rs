//! This file plants bugs into the example in C that keeps its laws, and says which law refuses each.

use std::fs;
use std::path::Path;
use std::time::Instant;

use rigproof_certify::controller::Source;
use rigproof_certify::declared::Declared;
use rigproof_certify::law::Law;
use rigproof_certify::scenario::{Rig, Scenario};
use rigproof_certify::shrink::shrink;
use rigproof_certify::trial::run;

use crate::bench::{ROOM, compiled, foreign, limits};

/// A bug: its name, what of the example is replaced by what, and the law that it breaks.
type Planted = (&'static str, &'static str, &'static str, Law);

const PLANTED: [Planted; 10] = [
    (
        "force that is no number believed",
        "if (!(fabs(sensed->tip_force_n[i]) <= rig.greatest_force_n))",
        "if (fabs(sensed->tip_force_n[i]) > rig.greatest_force_n)",
        Law::Safe,
    ),
    (
        "missed and stale samples believed",
        "if (sensed->number != (uint32_t)(last_number + 1))",
        "if (0)",
        Law::Safe,
    ),
    (
        "back too early after a jump",
        "#define QUIET 64",
        "#define QUIET 24",
        Law::Safe,
    ),
    (
        "unsaturated gain",
        "fmin(GAIN_A_S_PER_RAD * faster_rad_s, rig.greatest_current_a)",
        "4.0 * GAIN_A_S_PER_RAD * faster_rad_s",
        Law::CurrentLimit,
    ),
    (
        "degrees for radians, one sense taken for the other",
        "fmin(GAIN_A_S_PER_RAD * faster_rad_s, rig.greatest_current_a)",
        "fmin(GAIN_A_S_PER_RAD * 57.3 * turned_rad(brake / 2, oldest[brake / 2], counts[brake / 2]), 1.0)",
        Law::CurrentLimit,
    ),
    (
        "ignored layout",
        "int brake = a_rad_s >= b_rad_s ? 0 : 2;",
        "int brake = a_rad_s >= b_rad_s ? 0 : 3;",
        Law::BrakedJoints,
    ),
    (
        "two brakes at once",
        "currents_a[brake] =",
        "currents_a[1] = 0.1; currents_a[brake] =",
        Law::BrakeCount,
    ),
    (
        "a current that is not written",
        "memset(commanded->currents_a, 0, sizeof commanded->currents_a);",
        "memset(commanded->currents_a, 0, 3 * sizeof(double));",
        Law::CurrentLimit,
    ),
    (
        "dependence on the call count",
        "believed = is_believed(sensed) ? believed + 1 : 0;",
        "static unsigned calls; believed = is_believed(sensed) && ++calls % 997 != 0 ? believed + 1 : 0;",
        Law::Repeats,
    ),
    (
        "a write behind the window",
        "newest = (newest + 1) % WINDOW;",
        "newest = (newest + 1) % WINDOW; if (sensed->number % 512 == 0) commanded->currents_a[4] = 0.0;",
        Law::Answers,
    ),
];

/// Most scenarios that are tried for a bug.
const MOST: u64 = 60;

fn planted(number: usize, from: &str, to: &str) -> Option<std::path::PathBuf> {
    let text =
        |name: &str| fs::read_to_string(Path::new(ROOM).join("../c/examples").join(name)).unwrap();
    // In one text: a bug may be in what both dampers share.
    let include = "#include \"damping.h\"";
    let guarded = text("guarded.c");
    assert!(guarded.contains(include));
    let source = guarded.replace(include, &text("damping.h"));
    assert_eq!(source.matches(from).count(), 1, "{from}");
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("planted_{number}.c"));
    fs::write(&file, source.replace(from, to)).unwrap();
    // The compiler is told sources in the room; this one is beside it.
    let file = file.canonicalize().unwrap();
    let up = "../".repeat(Path::new(ROOM).canonicalize().unwrap().components().count());
    compiled(
        &format!("planted_{number}"),
        &format!("{up}{}", file.display()),
        &["-w"],
    )
}

#[test]
fn every_bug_planted_in_c_is_refused_by_its_law_and_shrunk() {
    let declared = Declared {
        most_brakes: Some(1),
        locks: Some(false),
        ..Declared::default()
    };
    let drawn = |index: u64| Scenario::drawn(5, index, &[Rig::ThreeBrake, Rig::FourBrake], 1500);
    println!(
        "{:<52} {:<14} scenarios  seconds  shrunk to",
        "bug in C", "law"
    );
    let sound = planted(99, "#define WINDOW 16", "#define WINDOW 16");
    let Some(sound) = sound else { return };
    let source = foreign(&sound, limits());
    for index in 0..6 {
        let ran = run(&drawn(index), &source, &declared, false).unwrap();
        assert_eq!(
            ran.broken().count(),
            0,
            "{index}: {:?}",
            ran.broken().collect::<Vec<_>>()
        );
    }
    for (number, (name, from, to, law)) in PLANTED.into_iter().enumerate() {
        let library = planted(number, from, to).unwrap();
        let source = foreign(&library, limits());
        refused(name, &source, &declared, law, drawn, 0..MOST);
    }
}

/// Says that a bug is refused by its law in one of these scenarios, and shrunk; prints where and when.
pub fn refused(
    name: &str,
    source: &dyn Source,
    declared: &Declared,
    law: Law,
    drawn: impl Fn(u64) -> Scenario,
    mut indices: impl Iterator<Item = u64>,
) {
    let begun = Instant::now();
    let first = indices.find(|index| {
        let ran = run(&drawn(*index), source, declared, false).unwrap();
        ran.broken().any(|(broken, _)| broken == law)
    });
    let found_s = begun.elapsed().as_secs_f64();
    let first = first.unwrap_or_else(|| panic!("{name} is not refused by {}", law.name()));
    let shrunk = shrink(&drawn(first), law, source, declared).map(|shrunk| shrunk.tick + 1);
    let time = shrunk.map_or("not shown again".to_owned(), |ticks| format!("{ticks} ms"));
    println!(
        "{name:<52} {:<14} {:>9}  {found_s:>7.2}  {time}",
        law.name(),
        first + 1
    );
    // What hangs on the number of calls need not come again.
    assert!(
        name.contains("call count") || shrunk.is_some_and(|ticks| ticks <= 500),
        "{name}: {time}"
    );
}
