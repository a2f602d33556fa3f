//! This file attacks certificates as a forger with a text editor and a hash program does, and folders as a campaign that fails does.

use std::collections::BTreeSet;

use rigproof_certify::certificate::Certificate;
use serde_json::Value;

use crate::desk::Desk;

/// A campaign whose controller breaks its gap: a refused certificate in `out`.
const REFUSED: &str = "certify certify.toml --scenarios 64 --seconds 0.2 --out out";

fn refused() -> Desk {
    let desk = Desk::new();
    desk.put(
        "certify.toml",
        "[controller]\nnamed = \"proportional_low\"\n[limits]\ntip_force_n = 0.001\n",
    );
    let text = desk.prints(REFUSED, 1);
    assert!(text.starts_with("Must NOT go on the rig"), "{text}");
    desk
}

/// The certificate in `out` after a change, with everything computed anew that follows from it.
fn forge(desk: &Desk, change: impl FnOnce(&mut Certificate)) {
    let mut own: Certificate = serde_json::from_str(&desk.read("out/certificate.json")).unwrap();
    change(&mut own);
    let text = own.sealed().unwrap().to_json().unwrap();
    desk.put("out/certificate.json", &text);
}

#[test]
fn a_refused_certificate_whose_reasons_were_emptied_is_refused_and_not_signed() {
    let desk = refused();
    desk.prints("certify key lab.pem", 0);
    let proof = "certify --check out/certificate.json --sample 64";
    let text = desk.prints(proof, 0);
    assert!(
        text.contains("A proof of what its trials say: all 64"),
        "{text}"
    );
    assert!(
        text.ends_with("By its figures it must not go on the rig.\n"),
        "{text}"
    );
    forge(&desk, |own| {
        for metric in &mut own.metrics {
            for limit in &mut metric.limits {
                (limit.holds, limit.value) = (true, Some(0.0));
            }
            if let Some(own) = metric.controller.as_mut() {
                (own.q05, own.q50, own.q95, own.greatest) = (0.0, 0.0, 0.0, 0.0);
            }
        }
    });
    for line in [proof, "certify --check out/certificate.json --sample 8"] {
        let text = desk.prints(line, 1);
        assert!(text.starts_with("The certificate does NOT hold"), "{text}");
        assert!(
            text.contains("metric tip_force_n is not what its records say"),
            "{text}"
        );
        assert!(text.ends_with("it must not go on the rig.\n"), "{text}");
    }
    let json: Value = desk.json(&format!("{proof} --json"), 1);
    assert_eq!(
        (&json["holds"], &json["may_go_on_the_rig"]),
        (&false.into(), &false.into())
    );
    assert_eq!(
        (&json["is_proof"], &json["run_again"]),
        (&true.into(), &64.into())
    );
    let signed = desk.rigproof("certify sign out/certificate.json --key lab.pem");
    let message = String::from_utf8(signed.stderr).unwrap();
    assert_eq!(signed.status.code(), Some(3), "{message}");
    assert!(message.contains("is not signed"), "{message}");
    assert!(!desk.path("out/certificate.json.sig").exists());
}

#[test]
fn a_certificate_of_a_hundred_million_trials_has_their_records_or_is_none() {
    let desk = refused();
    forge(&desk, |own| own.plan.scenarios = 100_000_000);
    let answer = desk.rigproof("certify --check out/certificate.json");
    let message = String::from_utf8(answer.stderr).unwrap();
    assert!(message.contains("it has records of 8 chunks"), "{message}");
    assert_eq!(answer.status.code(), Some(3));
}

#[test]
fn a_check_says_whether_it_was_a_proof_a_sample_or_a_sample_without_records() {
    let desk = refused();
    let sample = "certify --check out/certificate.json --sample 8";
    let text = desk.prints(sample, 0);
    assert!(
        text.contains("A sample, no proof: 8 of 64") && text.contains("sees 12.5 %"),
        "{text}"
    );
    assert!(
        text.contains("built anew from the records that stand beside it"),
        "{text}"
    );
    std::fs::remove_file(desk.path("out/journal.jsonl")).unwrap();
    let text = desk.prints(sample, 0);
    assert!(text.contains("No records stand beside it"), "{text}");
    // Records of another campaign are not its own.
    desk.prints(&REFUSED.replace("--out out", "--seed 5 --out other"), 1);
    std::fs::copy(
        desk.path("other/journal.jsonl"),
        desk.path("out/journal.jsonl"),
    )
    .unwrap();
    let text = desk.prints(sample, 1);
    assert!(text.contains("is of another campaign"), "{text}");
}

#[test]
fn a_folder_shows_no_verdict_but_that_of_its_last_campaign() {
    let desk = Desk::new();
    desk.put(
        "certify.toml",
        "[controller]\nnamed = \"proportional_low\"\n",
    );
    let line = "certify certify.toml --scenarios 24 --seconds 0.5 --out out";
    desk.prints(line, 0);
    assert!(desk.path("out/certificate.json").exists());
    // Another campaign that is refused before it begins leaves the folder as it was.
    assert_eq!(
        desk.rigproof(&format!("{line} --seed 9")).status.code(),
        Some(3)
    );
    assert!(desk.path("out/certificate.json").exists());
    // One that begins and cannot end, since a folder is where a worst case goes, leaves no verdict.
    std::fs::remove_file(desk.path("out/journal.jsonl")).unwrap();
    std::fs::create_dir_all(desk.path("out/finding-gap.json/taken")).unwrap();
    assert_eq!(
        desk.rigproof(&format!("{line} --seed 9")).status.code(),
        Some(3)
    );
    for file in ["certificate.json", "certificate.html"] {
        assert!(!desk.path(&format!("out/{file}")).exists(), "{file}");
    }
}

/// A finding or a worst case that is replayed alone carries its own sum: what was edited is not run as if it had been found.
#[test]
fn a_finding_or_a_worst_case_that_was_edited_is_refused_when_it_is_replayed() {
    let desk = Desk::new();
    desk.put(
        "certify.toml",
        "[controller]\nnamed = \"proportional_low\"\n",
    );
    desk.prints(
        "certify certify.toml --scenarios 24 --seconds 0.5 --search 6 --out out",
        0,
    );
    let names = desk.names("out");
    let worst = names
        .iter()
        .find(|name| name.starts_with("worst-"))
        .unwrap();
    desk.prints(&format!("certify --replay out/{worst}"), 0);
    let text = desk.read(&format!("out/{worst}"));
    for (from, to) in [
        ("\"found\": ", "\"found\": 1"),
        ("\"trials\": ", "\"trials\":  "),
    ] {
        desk.put("edited.json", &text.replacen(from, to, 1));
        let answer = desk.rigproof("certify --replay edited.json");
        let message = String::from_utf8(answer.stderr).unwrap();
        assert_eq!(answer.status.code(), Some(3), "{message}");
    }
}

/// What a rig is called reaches neither the terminal nor a drawing as it stands there.
#[test]
fn an_escape_in_a_name_steers_no_terminal_and_breaks_no_drawing() {
    let desk = Desk::new();
    desk.prints(
        "blind make --plant bench --seed 11 --stratum single --out case",
        0,
    );
    let rig = desk.read("case/rig.toml");
    let line = rig
        .lines()
        .find(|line| line.starts_with("name = "))
        .unwrap();
    desk.put(
        "rig.toml",
        &rig.replace(line, "name = \"a \\u001b[31mred\\u0007 \\ufffe rig\""),
    );
    let answer = desk.rigproof("diagnose case/recording.csv --rig rig.toml --out found");
    assert!(
        answer.status.code().is_some_and(|code| code < 2),
        "{answer:?}"
    );
    for printed in [&answer.stdout, &answer.stderr] {
        assert!(!printed.contains(&0x1b) && !printed.contains(&7));
    }
    // What is harmless of the name is shown, so that the rest could have been.
    let mut shown = BTreeSet::new();
    for name in desk
        .names("found")
        .iter()
        .filter(|name| name.ends_with(".svg") || name.ends_with(".html"))
    {
        let text = desk.read(&format!("found/{name}"));
        let bad = text
            .chars()
            .find(|c| c.is_control() && !"\n\t\r".contains(*c) || *c == '\u{fffe}');
        assert_eq!(bad, None, "{name}");
        let ending = name.rsplit('.').next().unwrap().to_owned();
        shown.extend(text.contains("[31mred").then_some(ending));
    }
    assert_eq!(shown, ["html", "svg"].map(str::to_owned).into());
}

/// An edited file of an output folder is somebody's work.
#[test]
fn an_edited_rig_and_a_link_that_leads_nowhere_are_not_replaced() {
    let desk = Desk::new();
    let line = "blind make --plant axis --seed 3 --out case";
    desk.prints(line, 0);
    desk.prints(line, 0);
    desk.put("case/rig.toml", "# mine\n");
    let answer = desk.rigproof(line);
    let message = String::from_utf8(answer.stderr).unwrap();
    assert!(
        answer.status.code() == Some(3) && message.contains("was changed"),
        "{message}"
    );
    assert_eq!(desk.read("case/rig.toml"), "# mine\n");
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("gone.mcap", desk.path("link.mcap")).unwrap();
        let answer = desk.rigproof("convert case/recording.csv link.mcap");
        assert_eq!(answer.status.code(), Some(3), "{answer:?}");
        assert!(
            std::fs::symlink_metadata(desk.path("link.mcap"))
                .unwrap()
                .is_symlink()
        );
    }
}

/// A name of any length is shown cut, and seeds are a range that can be held.
#[test]
fn a_name_of_seventy_thousand_letters_and_all_seeds_there_are_break_nothing() {
    let desk = Desk::new();
    let rows = (0..60).map(|k| format!("{:.3},{}\n", 1e-3 * f64::from(k), k % 7));
    let rows: String = rows.collect();
    desk.put(
        "long.csv",
        &format!("time (s),{}\n{rows}", "x".repeat(70_000)),
    );
    let text = desk.prints("inspect long.csv", 0);
    assert!(text.contains("xxx…") && text.len() < 5000, "{}", text.len());
    desk.prints("inspect long.csv --write-rig rig.toml", 0);
    assert!(desk.rigproof("convert long.csv long.mcap").status.success());
    assert!(desk.rigproof("inspect long.mcap").status.success());
    let asked = desk.rigproof("convert long.csv other.csv --columns missing");
    assert!(
        asked.status.code().is_some_and(|code| code > 1),
        "{asked:?}"
    );
    assert!(asked.stderr.len() < 5000, "{}", asked.stderr.len());
    let seeds = desk.rigproof("blind trial --seeds 0..18446744073709551615");
    let message = String::from_utf8(seeds.stderr).unwrap();
    assert!(
        seeds.status.code() == Some(2) && message.contains("give at most"),
        "{message}"
    );
}
