//! This file says that a program in C gets from the library, bit for bit, what a program in Rust gets from the tick.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use rigproof_impl::actuation::Actuation;
use rigproof_impl::law::{Law, Proportional, Sdof};
use rigproof_impl::path::{Line, Polyline};
use rigproof_impl::tick::{Sensed, Settings, Tick};
use rigproof_impl::vector::Vector;
use rigproof_impl_c::RigproofTickCommand;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::BLEND_BOUNDARY_M;

const ROOM: &str = env!("CARGO_MANIFEST_DIR");

/// The static library that was built for this test: the newest beside it.
fn library() -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let beside = test.parent().unwrap();
    let libraries = beside
        .read_dir()
        .unwrap()
        .map(|entry| entry.unwrap().path());
    libraries
        .filter(|path| {
            let name = path.file_name().unwrap().to_str().unwrap();
            name.starts_with("librigproof_impl_c") && name.ends_with(".a")
        })
        .max_by_key(|path| path.metadata().unwrap().modified().unwrap())
        .expect("cargo builds the static library with the tests")
}

/// A program in C, compiled; `None` without a C compiler.
pub fn compiled(source: &str) -> Option<PathBuf> {
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    if Command::new(&compiler).arg("--version").output().is_err() {
        println!("no C compiler `{compiler}`: {source} was not built");
        return None;
    }
    let name = Path::new(source).file_stem().unwrap();
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let status = Command::new(compiler)
        .args([
            "-std=c11",
            "-Wall",
            "-Wextra",
            "-Werror",
            "-ffp-contract=off",
        ])
        .arg(format!("-I{ROOM}/include"))
        .arg(format!("-I{ROOM}/tests/monitor"))
        .arg("-o")
        .arg(&program)
        .arg(format!("{ROOM}/{source}"))
        .arg(library())
        .args(["-lm", "-lpthread", "-ldl"])
        .status()
        .unwrap();
    assert!(status.success());
    Some(program)
}

/// Samples of a tip that is led and pushed about, with every fault in between.
pub fn samples() -> Vec<Sensed<f64>> {
    // Numbers of a linear congruence, 0 to 1.
    let mut state = 20_031_107_u64;
    let mut draw = move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut counts = [33_421.0, 14_327.0];
    let mut rates = [0.0; 2];
    let mut force_n = [0.0; 2];
    (0..7000_u32)
        .map(|number| {
            for (count, rate) in counts.iter_mut().zip(&mut rates) {
                *rate = 0.995 * *rate + 1.3 * (draw() - 0.5);
                *count += *rate;
            }
            for component in &mut force_n {
                *component = 0.99 * *component + 1.7 * (draw() - 0.5);
            }
            let fault = draw();
            Sensed {
                // Now and then a sample repeats, is missed, jumps, or has no force.
                number: match number {
                    _ if fault < 0.004 => number.saturating_sub(1),
                    _ if fault < 0.005 => number + 17,
                    _ => number,
                },
                counts: counts.map(|count| count as i32 + if fault > 0.999 { 9_341 } else { 0 }),
                tip_force_n: if (0.5..0.501).contains(&fault) {
                    Vector::new(f64::NAN, 1.3)
                } else {
                    force_n.into()
                },
            }
        })
        .collect()
}

/// What the example prints for the samples.
fn replayed(program: &Path, arguments: &[String], samples: &[Sensed<f64>]) -> Vec<String> {
    let mut lines = String::new();
    for sensed in samples {
        lines += &line(sensed);
        lines.push('\n');
    }
    answered(program, arguments, lines)
}

/// A sample as the examples read it.
pub fn line(sensed: &Sensed<f64>) -> String {
    let [a, b] = sensed.counts;
    let Vector { x, y } = sensed.tip_force_n;
    // Rust's shortest decimal reads back to the same float.
    format!("{} {a} {b} {x:?} {y:?}", sensed.number)
}

/// What a program prints, a line each, that is told these lines.
pub fn answered(program: &Path, arguments: &[String], lines: String) -> Vec<String> {
    let mut child = Command::new(program)
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let writer = std::thread::spawn(move || stdin.write_all(lines.as_bytes()).unwrap());
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).unwrap();
    text.lines().map(str::to_owned).collect()
}

/// The bits of a float that C printed with `%a`.
pub fn bits(text: &str) -> u64 {
    let body = text.strip_prefix("0x").unwrap();
    let (digits, exponent) = body.split_once('p').unwrap();
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let mantissa = u64::from_str_radix(&format!("{whole}{fraction}"), 16).unwrap();
    let exponent = exponent.parse::<i32>().unwrap() - 4 * fraction.len() as i32;
    (mantissa as f64 * 2.0_f64.powi(exponent)).to_bits()
}

/// Compares both on one law and path; how many ticks gave current.
fn agree<L: Law<f64>>(program: &Path, layout: Layout, law: L, arguments: &[&str]) -> usize {
    let samples = samples();
    let brakes = layout.brakes().len().to_string();
    let arguments: Vec<String> = [brakes.as_str()]
        .iter()
        .chain(arguments)
        .map(|argument| (*argument).to_owned())
        .collect();
    let lines = replayed(program, &arguments, &samples);
    assert_eq!(lines.len(), samples.len());
    let mut tick = Tick::new(&Settings::thesis(layout), law).unwrap();
    let mut acted = 0;
    for (sensed, line) in samples.iter().zip(lines) {
        let expected = RigproofTickCommand::from(tick.tick(sensed));
        let cells: Vec<&str> = line.split(' ').collect();
        let [a, e, b, c, reason, one, other] = cells.as_slice() else {
            panic!("{line}");
        };
        assert_eq!(
            [a, e, b, c].map(|cell| bits(cell)),
            expected.currents_a.map(f64::to_bits)
        );
        assert_eq!(reason.parse(), Ok(expected.reason));
        assert_eq!(
            [one, other].map(|cell| cell.parse::<i32>().unwrap()),
            expected.chosen
        );
        acted += usize::from(expected.currents_a.iter().any(|current_a| *current_a > 0.0));
    }
    acted
}

#[test]
fn the_example_in_c_agrees_bit_for_bit() {
    let Some(program) = compiled("examples/tick.c") else {
        return;
    };
    let (from_m, to_m) = ([-0.113, 0.383], [0.107, 0.412]);
    let corners_m = [from_m, [0.017, 0.391], to_m];
    let three = Actuation::thesis(Layout::ThreeBrake);
    let four = Actuation::thesis(Layout::FourBrake);
    let line = Line::through(from_m, to_m).unwrap();
    let chain = Polyline::<f64, 16>::closed(&corners_m).unwrap();
    let on_line = Proportional::new(four, line, BLEND_BOUNDARY_M, 497.0).unwrap();
    let on_chain = Sdof::new(three, chain, BLEND_BOUNDARY_M, 0.0043).unwrap();
    let two = ["2", "-0.113", "0.383", "0.107", "0.412"];
    let three = ["3", "-0.113", "0.383", "0.017", "0.391", "0.107", "0.412"];
    let line = [&["1", "497", "0", "0"], &two[..]].concat();
    let chain = [&["2", "0", "0.0043", "1"], &three[..]].concat();
    for acted in [
        agree(&program, Layout::FourBrake, on_line, &line),
        agree(&program, Layout::ThreeBrake, on_chain, &chain),
    ] {
        assert!(acted > 500, "only {acted} ticks gave current");
    }
}

#[test]
fn a_refused_tick_leaves_a_command_in_c_without_current() {
    let Some(program) = compiled("tests/refused.c") else {
        return;
    };
    let output = Command::new(program).output().unwrap();
    assert_eq!(String::from_utf8(output.stdout).unwrap(), "");
    assert!(output.status.success());
}

#[test]
fn the_header_is_what_cbindgen_makes() {
    let made = Path::new(env!("CARGO_TARGET_TMPDIR")).join("rigproof_tick.h");
    let cbindgen = Command::new("cbindgen")
        .args(["--quiet", "--config", "cbindgen.toml", "--output"])
        .arg(&made)
        .current_dir(ROOM)
        .status();
    let Ok(status) = cbindgen else {
        println!("no cbindgen: the header was not made again (cargo install cbindgen)");
        return;
    };
    assert!(status.success());
    let read = |path: &Path| std::fs::read_to_string(path).unwrap();
    let kept = Path::new(ROOM).join("include/rigproof_tick.h");
    assert!(read(&made) == read(&kept), "run `make header` in impl/c");
}
