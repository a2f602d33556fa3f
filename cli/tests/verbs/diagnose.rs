//! This file holds what `rigproof diagnose` and `rigproof simulate` make of recordings.

use crate::desk::{Desk, assert_shape};

/// A desk with a bench recording that hides one effect, in two parts.
fn bench() -> Desk {
    let desk = Desk::new();
    desk.prints(
        "blind make --plant bench --seed 11 --stratum single --out case",
        0,
    );
    let recording = desk.read("case/recording.csv");
    let lines: Vec<&str> = recording.lines().collect();
    let (header, samples) = lines.split_first().unwrap();
    let (first, rest) = samples.split_at(samples.len() * 7 / 10);
    for (name, samples) in [("first.csv", first), ("rest.csv", rest)] {
        desk.put(name, &format!("{header}\n{}\n", samples.join("\n")));
    }
    desk
}

/// A scale of the angle, a gain of the drive and a wrong inertia are one where the friction is unknown too.
#[test]
fn what_cannot_be_told_apart_is_suspected_with_what_would_tell() {
    let desk = Desk::new();
    let make = "blind make --plant axis --forms other --seed 2538 --out case";
    desk.prints(make, 0);
    let text = desk.prints("diagnose case/recording.csv --rig case/rig.toml", 0);
    for said in [
        "Cause suspected: the model may leave out",
        "  doubt  this recording cannot rule out",
        "  tell   gain_error is refuted by the same effort error at small and at large command, added_inertia by the described inertia on a swing or a scale",
    ] {
        assert!(text.contains(said), "{text}");
    }
}

#[test]
fn a_hidden_cause_is_named_and_shown_on_another_recording() {
    let desk = bench();
    let text = desk.prints(
        "diagnose first.csv --rig case/rig.toml --hold-out rest.csv --verbose",
        0,
    );
    assert_eq!(
        desk.names("first-diagnosis"),
        [
            ".rigproof",
            "before-after.svg",
            "calibration.toml",
            "report.html",
            "report.json",
            "residual.svg"
        ]
    );
    let report: serde_json::Value =
        serde_json::from_str(&desk.read("first-diagnosis/report.json")).unwrap();
    assert_shape(&report);
    assert_eq!(report["calibration_file"], "calibration.toml");
    let inputs = report["inputs"].as_array().unwrap();
    let paths: Vec<&str> = inputs.iter().map(|i| i["path"].as_str().unwrap()).collect();
    assert_eq!(paths, ["first.csv", "rest.csv", "case/rig.toml"]);
    assert_eq!(report["fit"]["improved"], true);
    let summary = report["summary"].as_str().unwrap();
    assert!(text.starts_with(&format!(
        "{}: {summary}",
        report["verdict"].as_str().unwrap()
    )));
    // What was held out is another recording, and no part of the first one.
    let page = desk.read("first-diagnosis/report.html");
    for said in [
        "All of it was kept aside: no number was fitted to it.",
        "samples of another recording",
        "held out: another recording",
    ] {
        assert!(page.contains(said), "{said}");
    }
    assert!(!page.contains("The blue part at the end"));
    assert!(!page.contains("at the end of the recording"));
    let scored = desk.json(
        "blind score case/answer.sealed first-diagnosis/report.json --json",
        0,
    );
    assert_eq!(scored["score"]["exact"], true, "{text}");

    // The command that it advises runs, and gives the figure that it states.
    let next = text.lines().last().unwrap().trim();
    let simulated = desk.json(
        &format!("{} --json", next.strip_prefix("rigproof ").unwrap()),
        0,
    );
    let stated = report["fit"]["held_out"]["after"].as_f64().unwrap();
    let rms = simulated["rms"].as_f64().unwrap();
    assert!((rms - stated).abs() < 1e-6 * stated, "{rms} {stated}");
    let nominal = desk.json("simulate rest.csv --rig case/rig.toml --json", 0);
    assert!(rms < nominal["rms"].as_f64().unwrap());
    // Both errors stand side by side, and both models in a picture.
    let without = &simulated["without_calibration"]["effort"]["rms"];
    assert_eq!(without, &nominal["rms"]);
    let line = format!("{next} --picture overlay.svg");
    let said = desk.prints(line.strip_prefix("rigproof ").unwrap(), 0);
    assert!(said.contains(" N·m → "), "{said}");
    let picture = desk.read("overlay.svg");
    assert!(picture.contains("without the calibration") && !picture.contains("NaN"));
}

#[test]
fn pictures_are_light_and_hold_what_their_titles_say() {
    let desk = bench();
    let report = desk.json(
        "diagnose case/recording.csv --rig case/rig.toml --out found --json",
        0,
    );
    assert_shape(&report);
    for (name, words) in [
        (
            "before-after.svg",
            [
                "metered effort (N·m)",
                "error (",
                "time from the first sample (s)",
            ],
        ),
        (
            "residual.svg",
            [
                "residual effort (",
                "95 % of sensor noise alone",
                "within 0.1 s of a reversal",
            ],
        ),
    ] {
        let picture = desk.read(&format!("found/{name}"));
        assert!(picture.len() < 200_000, "{name}: {} bytes", picture.len());
        assert!(picture.contains(r#"fill="white""#), "{name}");
        assert!(
            !picture.contains("NaN") && !picture.contains("inf"),
            "{name}"
        );
        let verdict = report["verdict"].as_str().unwrap().replace('_', " ");
        assert!(picture.contains(&format!("Verdict: {verdict}")), "{name}");
        for words in words {
            assert!(picture.contains(words), "{name}: {words}");
        }
    }
}

#[test]
fn a_simulation_is_written_with_its_units_and_times() {
    let desk = bench();
    desk.prints(
        "simulate rest.csv --rig case/rig.toml --out simulated.csv",
        0,
    );
    let simulated = rigproof_trace::csv::read(&desk.path("simulated.csv")).unwrap();
    let recorded = rigproof_trace::csv::read(&desk.path("rest.csv")).unwrap();
    assert_eq!(simulated.len(), recorded.len());
    for (a, b) in simulated.time_s.iter().zip(&recorded.time_s) {
        assert!((a - b).abs() < 1e-6, "{a} {b}");
    }
    for name in ["effort_recorded", "effort_simulated"] {
        assert_eq!(simulated.channel(name).unwrap().unit, "N·m");
    }
    assert_eq!(
        simulated.channel("effort_recorded").unwrap().samples[77],
        recorded.channel("torque").unwrap().samples[77]
    );
}

#[test]
fn a_faulty_recording_ends_in_a_report_and_nothing_else() {
    let desk = Desk::new();
    desk.prints(
        "blind make --plant axis --seed 10 --stratum data_fault --out case",
        0,
    );
    let text = desk.prints(
        "diagnose case/recording.csv --rig case/rig.toml --out found",
        1,
    );
    assert!(text.starts_with("The recording cannot be used: "), "{text}");
    assert!(
        text.contains("cut the fault away with --from-s and --to-s"),
        "{text}"
    );
    assert_eq!(
        desk.names("found"),
        [".rigproof", "report.html", "report.json"]
    );
    let report: serde_json::Value = serde_json::from_str(&desk.read("found/report.json")).unwrap();
    assert_shape(&report);
    let fault = &report["fault"];
    assert!(fault["reason"].as_str().unwrap().len() > 10);

    // Cut before the fault, the recording can be diagnosed.
    let end_s = fault["from_s"].as_f64().unwrap() - 0.1;
    let line = format!("diagnose case/recording.csv --rig case/rig.toml --to-s {end_s} --json");
    let answer = desk.rigproof(&line);
    let report: serde_json::Value = serde_json::from_slice(&answer.stdout).unwrap();
    assert_ne!(report["verdict"], "data_fault");
}

#[test]
fn a_diagnosis_is_printed_on_one_screen_and_quiet_prints_nothing() {
    let desk = bench();
    let line = "diagnose first.csv --rig case/rig.toml --hold-out rest.csv";
    let text = desk.prints(line, 0);
    assert!((5..=14).contains(&text.lines().count()), "{text}");
    assert!(!text.contains('\u{1b}'), "colour in a pipe: {text}");
    let report: serde_json::Value =
        serde_json::from_str(&desk.read("first-diagnosis/report.json")).unwrap();
    let name = report["effects"][0]["mechanism"].as_str().unwrap();
    assert!(text.to_lowercase().contains(name), "{name}: {text}");
    for words in [
        "Cause found",
        " on held-out data",
        "probability",
        "report.html",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    assert!(desk.prints(&format!("{line} --verbose"), 0).lines().count() > 14);
    assert_eq!(desk.prints(&format!("{line} --quiet"), 0), "");
    // Without --out no diagnosis replaces another.
    let own = desk.names(".");
    let own = own.iter().filter(|name| name.starts_with("first-"));
    let own: Vec<&String> = own.collect();
    let expected = ["first-diagnosis", "first-diagnosis-2", "first-diagnosis-3"];
    assert_eq!(own, expected);
    assert!(text.contains("first-diagnosis/report.html"));
}

#[test]
fn a_calibration_of_another_plant_is_refused() {
    let desk = bench();
    desk.prints("blind make --plant axis --seed 10 --out axis", 0);
    let answer = desk.rigproof("simulate rest.csv --rig case/rig.toml --calibration axis/rig.toml");
    let message = String::from_utf8(answer.stderr).unwrap();
    assert_eq!(answer.status.code(), Some(3));
    assert!(
        message.contains("give the calibration of this rig"),
        "{message}"
    );
}

#[test]
fn a_name_is_found_again_where_it_is_there_and_not_where_nothing_is() {
    let desk = Desk::new();
    desk.prints(
        "blind make --plant bench --seed 17 --stratum single --out case",
        0,
    );
    let diagnosed = |jobs: usize| {
        let line = format!(
            "diagnose case/recording.csv --rig case/rig.toml --calibrate 3 --jobs {jobs} --out out-{jobs} --json"
        );
        let report = desk.json(&line, 0);
        assert_shape(&report);
        report["self_calibration"].clone()
    };
    let own = diagnosed(1);
    assert_eq!(own, diagnosed(2));
    assert_eq!(own["false_alarms"]["of"], 3);
    assert_eq!(own["false_alarms"]["count"], 0, "{own}");
    assert_eq!(own["exact"]["count"], 3, "{own}");
    let again = &own["found_again"][0];
    assert_eq!(again["name"], "dry_offset");
    assert_eq!(again["count"], 3, "{own}");
    // (0.025)^(1/3): Clopper and Pearson where all of three came out.
    assert!((again["low95"].as_f64().unwrap() - 0.292_402).abs() < 1e-6);
}
