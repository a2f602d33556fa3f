//! This file holds the verbs that hide causes and score what is found.

use crate::desk::Desk;
use serde_json::{Value, json};

#[test]
fn a_case_follows_from_its_seed_and_is_committed_to_first() {
    let desk = Desk::new();
    let line = "blind make --plant bench --seed 29 --stratum late_onset";
    let made = desk.json(&format!("{line} --out one --json"), 0);
    let text = desk.prints(&format!("{line} --out two"), 0);
    let commitment = made["commitment"].as_str().unwrap();
    assert!(text.lines().next().unwrap().ends_with(commitment), "{text}");
    for name in ["recording.csv", "rig.toml", "answer.sealed"] {
        let (one, two) = (
            desk.read(&format!("one/{name}")),
            desk.read(&format!("two/{name}")),
        );
        assert!(one == two && one.len() > 200, "{name}");
    }
    desk.prints("blind make --plant bench --seed 30 --out two", 0);
    assert_ne!(
        desk.read("one/recording.csv"),
        desk.read("two/recording.csv")
    );
}

#[test]
fn a_report_is_scored_against_the_sealed_answer() {
    let desk = Desk::new();
    desk.prints(
        "blind make --plant axis --seed 5 --stratum late_onset --out case",
        0,
    );
    desk.put(
        "report.json",
        &json!({ "verdict": "consistent", "effects": [] }).to_string(),
    );
    let scored = desk.json("blind score case/answer.sealed report.json --json", 0);
    let hidden = scored["answer"]["effects"][0]["mechanism"]
        .as_str()
        .unwrap();
    assert_eq!(scored["score"]["exact"], false);
    let right = json!({ "verdict": "explained", "effects": [{ "mechanism": hidden }] });
    desk.put("report.json", &right.to_string());
    let scored = desk.json("blind score case/answer.sealed report.json --json", 0);
    assert_eq!(scored["score"]["exact"], true);
    let text = desk.prints("blind score case/answer.sealed report.json", 0);
    assert!(
        text.contains("Hidden (late_onset)") && text.contains(hidden),
        "{text}"
    );
    assert!(text.contains("beginning at"), "{text}");
}

#[test]
fn a_changed_answer_or_another_file_is_refused() {
    let desk = Desk::new();
    desk.prints("blind make --plant axis --seed 5 --out case", 0);
    desk.put("report.json", "{}");
    let sealed = desk.read("case/answer.sealed");
    let key = "\"sealed\": \"";
    let (head, tail) = sealed.split_once(key).unwrap();
    let digit = if tail.starts_with('a') { "b" } else { "a" };
    desk.put(
        "changed.sealed",
        &format!("{head}{key}{digit}{}", &tail[1..]),
    );
    for (line, expected) in [
        (
            "changed.sealed report.json",
            "was changed after it was sealed",
        ),
        ("report.json report.json", "sealed answer, line 1"),
        (
            "case/answer.sealed case/rig.toml",
            "give the report.json that a diagnosis wrote",
        ),
        ("case/answer.sealed report.json", "the report has no"),
        ("case/answer.sealed none.json", "there is no such file"),
    ] {
        let answer = desk.rigproof(&format!("blind score {line}"));
        let message = String::from_utf8(answer.stderr).unwrap();
        assert_eq!(answer.status.code(), Some(3), "{message}");
        assert!(message.contains(expected), "{message} lacks {expected}");
    }
}

#[test]
fn a_trial_finds_what_the_command_finds_whatever_the_number_of_jobs() {
    let desk = Desk::new();
    let line = "blind trial --seeds 10..12 --details";
    let answer = desk.rigproof(&format!("{line} --json --jobs 1"));
    let trial: Value = serde_json::from_slice(&answer.stdout).unwrap();
    let cases = trial["cases"].as_array().unwrap();
    let plants: Vec<&Value> = cases.iter().map(|case| &case["plant"]).collect();
    assert_eq!(plants, ["axis", "bench"]);
    let claims = trial["claims"].as_array().unwrap();
    assert_eq!(claims.len(), 4);
    let broken = claims.iter().any(|claim| claim["holds"] == false);
    assert_eq!(answer.status.code(), Some(i32::from(broken)));

    let two = desk.rigproof(&format!("{line} --json --jobs 2 --html trial.html"));
    let page = desk.read("trial.html");
    assert!(page.contains("recordings with concealed causes exactly the cause was named"));
    assert_eq!(two.stdout, answer.stdout);

    // By hand, seed by seed: the same, and told in words.
    std::fs::create_dir(desk.path("reports")).unwrap();
    for (seed, plant) in [(10, "axis"), (11, "bench")] {
        let case = format!("blind make --seed {seed} --plant {plant} --out case{seed}");
        desk.prints(&case, 0);
        let by_hand = desk.rigproof(&format!(
            "diagnose case{seed}/recording.csv --rig case{seed}/rig.toml --out reports/{seed} --quiet"
        ));
        assert_eq!(by_hand.status.code(), Some(0), "{by_hand:?}");
    }
    let line = format!("{line} --reports reports");
    let scored = desk.rigproof(&format!("{line} --json"));
    assert_eq!(scored.stdout, answer.stdout);
    let text = String::from_utf8(desk.rigproof(&line).stdout).unwrap();
    assert!(
        text.starts_with("Seeds\n  10 axis ") && text.contains("\n  11 bench "),
        "{text}"
    );
    assert!(
        text.contains("Even seeds are on the axis") && text.contains("Wilson"),
        "{text}"
    );
    assert_eq!(
        text.matches(": no case").count(),
        claims.iter().filter(|c| c["holds"].is_null()).count()
    );
}

#[test]
fn a_five_bar_is_diagnosed_at_its_joint_and_runs_closer_with_its_calibration() {
    let desk = Desk::new();
    desk.prints("blind make --plant rig --seed 9 --out case", 0);
    let found = "diagnose case/recording.csv --rig case/rig.toml --out found";
    let text = desk.prints(found, 0);
    assert!(text.contains("(gain_error) at B"), "{text}");
    let scored = desk.json("blind score case/answer.sealed found/report.json --json", 0);
    assert_eq!(scored["score"]["exact"], true);
    let calibration = desk.read("found/calibration.toml");
    assert!(calibration.contains("joint = \"B\""), "{calibration}");
    let simulated = "simulate case/recording.csv --rig case/rig.toml --json";
    let nominal = desk.json(simulated, 0);
    let found = "--calibration found/calibration.toml --out simulated.csv";
    let calibrated = desk.json(&format!("{simulated} {found}"), 0);
    for output in ["theta_a", "theta_b", "tip"] {
        let rms = |said: &Value| said["outputs"][output]["rms"].as_f64().unwrap();
        let (before, after) = (rms(&nominal), rms(&calibrated));
        // Measured: 0.022, 0.016 and 0.018 of it, from 8.4 mm of the tip to 0.15 mm.
        assert!(after < 0.04 * before, "{output}: {before} → {after}");
    }
    assert_eq!(calibrated["broken_off"], 0);
    let written = rigproof_trace::csv::read(&desk.path("simulated.csv")).unwrap();
    let of = |name: &str| written.channel(name).unwrap().samples.clone();
    let pairs = of("theta_a_recorded")
        .into_iter()
        .zip(of("theta_a_simulated"));
    let off = pairs.map(|(recorded, simulated)| (simulated - recorded).powi(2));
    let rms = (off.sum::<f64>() / written.len() as f64).sqrt();
    let said = calibrated["outputs"]["theta_a"]["rms"].as_f64().unwrap();
    assert!((rms / said - 1.0).abs() < 1e-6, "{rms} {said}");
    let text = desk.prints(
        "simulate case/recording.csv --rig case/rig.toml --restart-s 0.23",
        0,
    );
    assert!(text.contains("free runs of 0.23 s"), "{text}");
}

/// Seed 1006, below 10 000 where the rules were chosen, hides a spring at one joint.
#[test]
fn what_was_found_is_shown_on_a_second_recording_of_the_rig() {
    let desk = Desk::new();
    let line = "blind trial --plant rig --seeds 1006..1007 --held-out --details --json";
    let answer = desk.rigproof(line);
    let trial: Value = serde_json::from_slice(&answer.stdout).unwrap();
    let score = &trial["cases"][0]["score"];
    assert_eq!(score["exact"], true, "{score}");
    // Measured: 0.9995. One would be sensor noise alone.
    let share = score["recovered_share"].as_f64().unwrap();
    assert!((0.99..1.02).contains(&share), "{share}");
    let how = trial["plant"].as_str().unwrap();
    assert!(how.contains("a second one of the same rig"), "{how}");
    let claims = trial["claims"].as_array().unwrap();
    assert_eq!(claims.len(), 14);
    let said = desk.rigproof("blind trial --plant axis --seeds 4..5 --held-out");
    assert_eq!(said.status.code(), Some(2));
    let message = String::from_utf8(said.stderr).unwrap();
    assert!(message.contains("add --plant rig"), "{message}");
}

#[test]
fn an_experiment_is_done_on_the_concealed_rig_by_hand_and_by_the_trial() {
    let desk = Desk::new();
    let count = 2000;
    let rows = (0..count).map(|k| {
        let time_s = 1e-3 * f64::from(k);
        let x = 0.02 + 0.04 * libm::sin(2.0 * time_s);
        let current = if time_s < 1.0 { 0.0 } else { 0.3 };
        format!("{time_s},{x},0.4,{current}\n")
    });
    let rows: String = rows.collect();
    let head = "time (s),hand_x (m),hand_y (m),current_a (A)\n";
    desk.put("asked.csv", &format!("{head}{rows}"));
    let line = "blind make --plant rig --seed 1006 --experiment asked.csv --out case";
    desk.prints(line, 0);
    let recording = rigproof_trace::csv::read(&desk.path("case/recording.csv")).unwrap();
    // Half as long again: the hand reaches for where the experiment begins.
    assert_eq!(recording.len(), 3500);
    let current = &recording.channel("current_a").unwrap().samples;
    assert_eq!((current[2400], current[2600]), (0.0, 0.3));
    let axis = desk.rigproof("blind make --plant axis --seed 4 --experiment asked.csv --out axis");
    assert_eq!(axis.status.code(), Some(2));
    let trial = desk.rigproof("blind trial --plant axis --seeds 4..5 --experiments");
    assert_eq!(trial.status.code(), Some(2));
    let rows = (0..20).map(|k| format!("{},0.02\n", 0.1 * f64::from(k)));
    let rows: String = rows.collect();
    desk.put("asked.csv", &format!("time (s),hand_x (m)\n{rows}"));
    let bad = desk.rigproof("blind make --plant rig --seed 1006 --experiment asked.csv --out bad");
    assert_eq!(bad.status.code(), Some(3));
    let message = String::from_utf8(bad.stderr).unwrap();
    assert!(message.contains("no column `hand_y`"), "{message}");
    assert!(!desk.path("bad").join("recording.csv").exists());
}
