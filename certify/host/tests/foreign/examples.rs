//! This file says that the examples are controllers, and that a tick behind the header answers as it does without.

use std::path::{Path, PathBuf};

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigproof_certify::controller::{Failure, Source, Task};
use rigproof_certify::foreign::MOST_POINTS;
use rigproof_impl::actuation::Actuation;
use rigproof_impl::law::Proportional;
use rigproof_impl::path::{AnyPath, Arc, Line, Polyline, Spline};
use rigproof_impl::tick::{Sensed, Settings, Tick};
use rigproof_impl::vector::Vector;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::{BLEND_BOUNDARY_M, greatest_desired_force_n};

use crate::bench::{ROOM, compiled, compiler, foreign, limits, line, named, running};

type AnyOf = AnyPath<f64, MOST_POINTS>;

/// The newest file beside this test, or in a folder beside it, whose name begins and ends so.
pub fn built(folder: &str, begins: &str, ends: &str) -> Option<PathBuf> {
    let test = std::env::current_exe().unwrap();
    let files = test.parent().unwrap().join(folder).read_dir().ok()?;
    let files = files.map(|entry| entry.unwrap().path());
    files
        .filter(|path| {
            let name = path.file_name().unwrap().to_str().unwrap();
            name.starts_with(begins) && name.ends_with(ends)
        })
        .max_by_key(|path| path.metadata().unwrap().modified().unwrap())
}

/// Ten thousand samples of a tip that is led about, with sensor faults in between.
fn samples(seed: u64) -> Vec<Sensed<f64>> {
    let mut draw = Pcg64::seed_from_u64(seed);
    let mut counts = [33_421.0_f64, 14_327.0];
    let mut rates = [0.0_f64; 2];
    let samples = (0..10_000_u32).map(|number| {
        for (count, rate) in counts.iter_mut().zip(&mut rates) {
            *rate = 0.99 * *rate + draw.random_range(-0.9..0.9);
            *count += *rate;
        }
        let mut sensed = Sensed {
            number,
            counts: counts.map(|count| count as i32),
            tip_force_n: Vector::new(draw.random_range(-9.3..9.3), draw.random_range(-9.3..9.3)),
        };
        match draw.random_range(0..400) {
            0 => sensed.number = number.saturating_sub(1),
            1 => sensed.counts[1] += 7_919,
            2 => sensed.tip_force_n.x = f64::NAN,
            _ => {}
        }
        sensed
    });
    samples.collect()
}

fn path(task: &Task) -> AnyOf {
    match task {
        Task::Chain(points_m) if points_m.len() == 2 => {
            AnyPath::Line(Line::through(points_m[0], points_m[1]).unwrap())
        }
        Task::Chain(points_m) => AnyPath::Polyline(Polyline::open(points_m).unwrap()),
        Task::Spline(points_m) => AnyPath::Spline(Spline::through(points_m).unwrap()),
        Task::Arc {
            centre_m,
            radius_m,
            from_rad,
            to_rad,
        } => AnyPath::Arc(Arc::new(*centre_m, *radius_m, *from_rad, to_rad - from_rad).unwrap()),
    }
}

/// Compares a library and the tick in this process, sample by sample.
fn agrees(library: &Path, layout: Layout, task: &Task, gain_n_s_per_m: f64, seed: u64) {
    let settings = Settings::thesis(layout);
    let actuation = Actuation::new(layout, &settings.arms, greatest_desired_force_n(layout));
    let law = Proportional::new(
        actuation.unwrap(),
        path(task),
        BLEND_BOUNDARY_M,
        gain_n_s_per_m,
    );
    let mut here = Tick::<f64, _>::new(&settings, law.unwrap()).unwrap();
    let source = foreign(library, limits());
    let mut there = source.begin(&settings, task).unwrap();
    let mut acted = 0;
    for sensed in samples(seed) {
        let currents_a = there.tick(&sensed).unwrap();
        let expected_a = here.tick(&sensed).currents_a;
        assert_eq!(currents_a.map(f64::to_bits), expected_a.map(f64::to_bits));
        acted += usize::from(expected_a.iter().any(|current_a| *current_a > 0.0));
    }
    assert!(acted > 1000, "only {acted} ticks gave current");
}

fn chain() -> Task {
    Task::Chain(vec![[-0.113, 0.383], [0.017, 0.391], [0.107, 0.412]])
}

#[test]
fn the_tick_of_the_rig_in_c_answers_bit_for_bit() {
    let tick = built("", "librigproof_impl_c", ".a").expect("cargo builds the static library");
    let told = [
        tick.to_str().unwrap(),
        "-Wall",
        "-Wextra",
        "-Werror",
        "-lpthread",
        "-ldl",
    ];
    let Some(library) = compiled("proportional", "../c/examples/proportional.c", &told) else {
        return;
    };
    agrees(&library, Layout::FourBrake, &line(), 500.0, 71);
    agrees(&library, Layout::ThreeBrake, &chain(), 500.0, 72);
    let source = foreign(&library, limits());
    let spline = Task::Spline(vec![[-0.113, 0.383], [0.017, 0.391], [0.107, 0.412]]);
    let refused = source.begin(&Settings::thesis(Layout::FourBrake), &spline);
    let expected = Failure::Refused("init answered with status 2".to_owned());
    assert_eq!(refused.err(), Some(expected));
}

#[test]
fn a_controller_in_rust_answers_bit_for_bit_on_every_path() {
    let Some(library) = built("../examples", "libproportional", ".so") else {
        println!("the examples were not built: run the tests of the whole package");
        return;
    };
    let arc = Task::Arc {
        centre_m: [0.011, 0.379],
        radius_m: 0.083,
        from_rad: 0.7,
        to_rad: -2.3,
    };
    let spline = Task::Spline(vec![
        [-0.113, 0.383],
        [-0.021, 0.431],
        [0.017, 0.391],
        [0.107, 0.412],
    ]);
    for (seed, task) in (81..).zip([line(), chain(), arc, spline]) {
        agrees(&library, Layout::FourBrake, &task, 500.0, seed);
        agrees(&library, Layout::ThreeBrake, &task, 500.0, seed + 10);
    }
}

#[test]
fn the_damper_brakes_the_faster_joint_and_lets_go_at_a_fault() {
    let strict = ["-Wall", "-Wextra", "-Werror"];
    let Some(library) = compiled("damper", "../c/examples/damper.c", &strict) else {
        return;
    };
    let source = foreign(&library, limits());
    let settings = Settings::thesis(Layout::FourBrake);
    // B turns at 2 rad/s, three times as fast as A.
    let turned = |number: u32, rad_s: f64| {
        let turns = rad_s * settings.sample_s * f64::from(number) / std::f64::consts::TAU;
        (turns * 100_000.0) as i32
    };
    let sensed = |number: u32| Sensed {
        number,
        counts: [turned(number, 2.0 / 3.0), -turned(number, 2.0)],
        tip_force_n: Vector::new(1.3, -2.7),
    };
    for _ in 0..2 {
        let mut controller = source.begin(&settings, &line()).unwrap();
        let mut at = |sensed: &Sensed<f64>| controller.tick(sensed).unwrap();
        for number in 0..16 {
            assert_eq!(at(&sensed(number)), [0.0; 4]);
        }
        let [a, e, b, c] = at(&sensed(16));
        assert!((b - 0.6).abs() < 0.01, "{b} A");
        assert_eq!([a, e, c], [0.0; 3]);
        // The same sample again.
        assert_eq!(at(&sensed(16)), [0.0, 0.0, b, 0.0]);
        // A sample is missed, then a force is no number, then a count jumps.
        assert_eq!(at(&sensed(18)), [0.0; 4]);
        let mut broken = sensed(19);
        broken.tip_force_n.y = f64::NAN;
        assert_eq!(at(&broken), [0.0; 4]);
        let mut jumped = sensed(20);
        jumped.counts[0] += 9_341;
        assert_eq!(at(&jumped), [0.0; 4]);
        // Sample 21 jumps back; from there on the window fills again.
        for number in 21..37 {
            assert_eq!(at(&sensed(number)), [0.0; 4]);
        }
        let [_, _, b, _] = at(&sensed(37));
        assert!((b - 0.6).abs() < 0.01, "{b} A");
    }
    assert_eq!(source.between_trials(), []);
    drop(source);
    assert_eq!(running(&named(&library)), [0_u32; 0]);
}

/// Whether make can do the least that there is to do.
fn makes_anything() -> bool {
    let least = Path::new(env!("CARGO_TARGET_TMPDIR")).join("least.mk");
    std::fs::write(&least, "all:\n\ttrue\n").unwrap();
    let made = std::process::Command::new("make")
        .arg("-f")
        .arg(&least)
        .output();
    made.is_ok_and(|made| made.status.success())
}

#[test]
fn the_makefile_builds_the_damper() {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("made");
    let library = target.join("controllers/damper.so");
    let make = std::process::Command::new("make")
        .args(["-B", "-C", &format!("{ROOM}/../c")])
        .arg(&library)
        .env("CARGO_TARGET_DIR", &target)
        .output();
    let (Ok(output), Some(_)) = (make, compiler()) else {
        println!("no make or no C compiler: the Makefile was not run");
        return;
    };
    // In a user namespace that maps nobody, make starts no program at all.
    if !makes_anything() {
        println!("make does nothing here: the Makefile was not run");
        return;
    }
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    assert_eq!(foreign(&library, limits()).check(), Ok(()));
}
