//! This file holds the experiment that a diagnosis of the five-bar asks for, played by `simulate`.

use crate::desk::{Desk, assert_shape};

/// A rig with three brakes; channel names, units and signs of its own.
const RIG: &str = r#"
name = "display"
plant = "rig"
layout = "three_brake"
[channels]
theta_a = { channel = "qa", unit = "deg", sign = -1, quantum = 0.0036 }
theta_b = { channel = "qb", unit = "rad", quantum = 6.3e-5 }
force_x = { channel = "fx", unit = "N", scale = 2, noise = 0.018 }
force_y = { channel = "fy", unit = "N", noise = 0.036 }
current_a = { channel = "ia", unit = "mA" }
current_e = { channel = "ie", unit = "A" }
current_b = { channel = "ib", unit = "A" }
[protocol]
drive = "held"
"#;

/// What the rig is in truth.
const TRUTH: &str = "[[effect]]\nmechanism = \"gain_error\"\njoint = \"A\"\nfraction = { value = 0.131, unit = \"1\" }\n";

/// A winding path of 8 s, brake A always at 0.43 A.
fn path() -> String {
    let row = |k: usize| {
        let time_s = k as f64 * 1e-3;
        let sine = |rate: f64, phase: f64| libm::sin(rate * time_s + phase);
        let x = 0.02 + 0.056 * sine(2.31, 0.3) + 0.029 * sine(5.13, 1.1);
        let y = 0.40 + 0.041 * sine(3.07, 2.1) + 0.024 * sine(6.71, 0.7);
        format!("{time_s:.3},{x:.9},{y:.9},0.43\n")
    };
    let rows: String = (0..8000).map(row).collect();
    format!("time (s),hand_x (m),hand_y (m),current_a (A)\n{rows}")
}

#[test]
fn an_ambiguous_five_bar_is_given_an_experiment_that_simulate_plays() {
    let desk = Desk::new();
    desk.put("rig.toml", RIG);
    desk.put("truth.toml", &format!("{RIG}{TRUTH}"));
    desk.put("path.csv", &path());
    let play = "--rig rig.toml --calibration truth.toml --json --seed";
    let played = desk.json(&format!("simulate path.csv {play} 5 --out run.csv"), 0);
    assert_eq!(played["samples"], 8000);
    assert!(played["greatest_force_n"].as_f64().unwrap() < 19.5001);
    let report = desk.json("diagnose run.csv --rig rig.toml --out found --json", 0);
    assert_shape(&report);
    let next = &report["next_experiment"];
    assert_eq!(next["file"], "next-experiment.csv", "{next}");
    let pairs = next["separations"].as_array().unwrap();
    assert!(pairs.iter().any(|pair| pair["tellable"] == true), "{next}");
    let line = format!("simulate found/next-experiment.csv {play} 6 --out next.csv");
    let played = desk.json(&line, 0);
    assert_eq!(played["samples"], 12_000);
    let again = desk.prints(&line.replace(" --json", ""), 0);
    assert!(again.starts_with("played an experiment of"), "{again}");
    let recorded = rigproof_trace::csv::read(&desk.path("next.csv")).unwrap();
    let names: Vec<&str> = recorded.channels.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, ["qa", "qb", "fx", "fy", "ia", "ie", "ib"]);
}

#[test]
fn an_experiment_that_a_rig_cannot_do_is_refused() {
    let desk = Desk::new();
    desk.put("rig.toml", RIG);
    let hand = |k: usize| {
        format!(
            "{:.3},{:.5},0.40217",
            0.001 * k as f64,
            0.0113 + 1e-5 * k as f64
        )
    };
    let rows =
        |row: &dyn Fn(usize) -> String| -> String { (0..40).map(|k| row(k) + "\n").collect() };
    let plain = "time (s),hand_x (m),hand_y (m)\n";
    for (columns, row, expected) in [
        (
            ",current_c (A)",
            &(|k| hand(k) + ",0.17") as &dyn Fn(usize) -> String,
            "this rig has no brake for `current_c`",
        ),
        (
            "",
            &|k| hand(if k > 30 { k + 4 } else { k }),
            "needs a regular clock",
        ),
        (
            "",
            &|k| match k {
                7 => "0.007,,0.40217".to_owned(),
                _ => hand(k),
            },
            "`hand_x` has no value in sample 7",
        ),
        ("", &|k| hand(k).replace(",0.40", ",1.40"), "plan.csv"),
        (",current_a (A)", &|k| hand(k) + ",1.73", "1.73 A"),
    ] {
        let head = plain.replace('\n', columns);
        desk.put("plan.csv", &format!("{head}\n{}", rows(row)));
        let answer = desk.rigproof("simulate plan.csv --rig rig.toml");
        let message = String::from_utf8(answer.stderr).unwrap();
        assert_eq!(answer.status.code(), Some(3), "{message}");
        assert!(message.contains(expected), "{message} lacks {expected}");
        assert!(message.contains("plan.csv"), "{message}");
    }
}

/// A slide with viscous friction that its description lacks, to and fro at one speed.
fn to_and_fro() -> String {
    let row = |k: usize| {
        let time_s = k as f64 * 1e-3;
        let (sine, cosine) = libm::sincos(2.67 * time_s);
        let round = (1.0 - 0.9998 * sine * sine).sqrt();
        let hiss = libm::sin(8123.0 * time_s * time_s) * 0.02;
        let x = 0.0637 * libm::asin(0.9999 * sine);
        format!("{time_s:.3},{x:.7},{:.5}\n", 0.39 * cosine / round + hiss)
    };
    let rows: String = (0..9000).map(row).collect();
    format!("time (s),x (m),f (N)\n{rows}")
}

#[test]
fn an_ambiguous_bench_is_told_which_motion_to_repeat() {
    let desk = Desk::new();
    let rig = "name = \"slide\"\nplant = \"bench\"\nmotion = \"linear\"\n[channels]\n\
        position = { channel = \"x\", unit = \"m\", quantum = 1e-7 }\n\
        force = { channel = \"f\", unit = \"N\", noise = 0.015 }\n";
    desk.put("rig.toml", rig);
    desk.put("run.csv", &to_and_fro());
    let said = desk.prints("diagnose run.csv --rig rig.toml --out found", 0);
    let asked = said
        .lines()
        .find(|own| own.starts_with("  tell   repeat the recorded motion"));
    let file = "(next-experiment.csv), and diagnose both recordings together";
    assert!(asked.is_some_and(|own| own.ends_with(file)), "{said}");
    let plan = rigproof_trace::csv::read(&desk.path("found/next-experiment.csv")).unwrap();
    assert_eq!(plan.channels[0].name, "position");
    let all = desk.prints("diagnose run.csv --rig rig.toml --out again --verbose", 0);
    assert!(
        all.contains("s long; sample by sample in next-experiment.csv\n"),
        "{all}"
    );
    assert!(!all.contains("the hand"), "{all}");
}
