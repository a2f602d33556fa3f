//! This file holds the design of linkages: what it draws, ranks and refuses.

use crate::desk::Desk;

/// Runs a line that must be refused, and gives its message.
fn refused(desk: &Desk, line: &str, code: i32) -> String {
    let answer = desk.rigproof(line);
    let message = String::from_utf8(answer.stderr).unwrap();
    assert_eq!(answer.status.code(), Some(code), "{line}: {message}");
    assert!(answer.stdout.is_empty(), "{line}");
    assert!(
        desk.names(".").iter().all(|name| name.ends_with(".toml")),
        "{line} left something"
    );
    message
}

#[test]
fn the_layouts_of_the_thesis_are_drawn_compared_and_ranked() {
    let desk = Desk::new();
    let report = desk.json("design --out d --json", 0);
    let linkages = report["linkages"].as_array().unwrap();
    let area = |index: usize| linkages[index]["figures"]["area_m2"].as_f64().unwrap();
    assert!((area(0) - 0.287_81).abs() < 6e-4 && (area(1) - 0.1563).abs() < 6e-4);
    assert_eq!(report["concepts"].as_array().unwrap().len(), 4);
    let displays = report["displays"].as_array().unwrap();
    let mean = |place: usize| displays[place]["figures"]["mean_deg"].as_f64().unwrap();
    // Four paths lie closer together than two.
    assert!(displays.len() == 3 && mean(0) < mean(1) && mean(0) < mean(2));
    let sweep = report["sweep"].as_array().unwrap();
    assert_eq!(sweep.len(), 420);
    let scores: Vec<f64> = sweep.iter().map(|c| c["score"].as_f64().unwrap()).collect();
    assert!(scores.windows(2).all(|pair| pair[0] >= pair[1]) && scores[0] > 0.0);
    let verdicts: Vec<&str> = report["statements"]
        .as_array()
        .unwrap()
        .iter()
        .map(|statement| statement["verdict"].as_str().unwrap())
        .collect();
    assert_eq!(
        verdicts,
        [
            "agrees",
            "agrees",
            "cannot be compared",
            "agrees",
            "disagrees"
        ]
    );

    let names = desk.names("d");
    for name in [
        "four-brake-angles.svg",
        "three-brake-paths.svg",
        "ninety-percent-paths.svg",
        "workspaces.svg",
        "sweep.svg",
    ] {
        assert!(names.contains(&name.to_owned()), "{name}");
        let drawn = desk.read(&format!("d/{name}"));
        assert!(
            drawn.starts_with("<svg") && !drawn.contains("NaN") && !drawn.contains("inf"),
            "{name}"
        );
    }
    let written: serde_json::Value = serde_json::from_str(&desk.read("d/report.json")).unwrap();
    assert_eq!(written, report);
    let boundary = desk.read("d/four-brake-boundary.csv");
    for limit in [
        "greatest angle at A,180",
        "least angle at B,0",
        "least angle at C,10",
        "greatest angle at E,350",
    ] {
        assert!(boundary.contains(limit), "{limit}");
    }
    let angles = desk.read("d/three-brake-angles.csv");
    let counted = angles.lines().count() as f64 - 1.0;
    let step = linkages[0]["step_m"].as_f64().unwrap();
    assert!((counted * step * step / area(0) - 1.0).abs() < 1e-9);
}

#[test]
fn the_result_does_not_depend_on_the_number_of_jobs() {
    let desk = Desk::new();
    desk.prints("design --out one --jobs 1 --ae 20cm --ed 31cm --ab 11cm", 0);
    desk.prints("design --out two --jobs 2 --ae 20cm --ed 31cm --ab 11cm", 0);
    for name in [
        "sweep.csv",
        "own-angles.csv",
        "own-boundary.csv",
        "report.json",
    ] {
        assert_eq!(
            desk.read(&format!("one/{name}")),
            desk.read(&format!("two/{name}")),
            "{name}"
        );
    }
}

#[test]
fn lengths_and_limits_of_ones_own_count() {
    let desk = Desk::new();
    let own = "name = \"My rig\"\n[lengths]\nae = { value = 264, unit = \"mm\" }\n\
        ed = { value = 30.5, unit = \"cm\" }\nab = { value = 0.267, unit = \"m\" }\n\
        [angles]\nd = { least = 51, unit = \"deg\" }\n";
    desk.put("own.toml", own);
    let area = |line: &str| {
        let report = desk.json(&format!("design --no-sweep --json {line}"), 0);
        report["linkages"][0]["figures"]["area_m2"]
            .as_f64()
            .unwrap()
    };
    let from_file = area("--linkage own.toml --out a");
    let from_flags = area("--ae 26.4cm --ed 30.5cm --ab 267mm --range D=51..170 --out b");
    assert_eq!(from_file, from_flags);
    assert!((from_file - 0.1563).abs() < 6e-4, "{from_file}");
    let narrow = area("--linkage own.toml --range A=60..140 --out c");
    assert!(narrow < 0.8 * from_file, "{narrow}");
    assert!(desk.path("a/my-rig-angles.svg").exists() && !desk.path("a/sweep.csv").exists());
    let text = desk.prints("design --linkage own.toml --no-sweep --out a", 0);
    assert!(
        text.contains("4-brake five-bar linkage") && text.contains("a/my-rig-paths.csv"),
        "{text}"
    );
}

#[test]
fn what_is_no_linkage_is_refused_by_name_value_and_range() {
    let desk = Desk::new();
    let own = "--ae 26.4cm --ed 30.5cm --ab 26.7cm";
    for (line, words) in [
        (
            "--ae -26.4cm --ed 30.5cm --ab 26.7cm".to_owned(),
            "L_AE is -0.264 m; it must be at least 0.000001 m",
        ),
        (
            "--ae NaNm --ed 30.5cm --ab 26.7cm".to_owned(),
            "L_AE is NaN m",
        ),
        (
            "--ae 26.4cm --ed 30.5cm --ab -2cm".to_owned(),
            "L_AB is -0.02 m; it must be 0 m or more",
        ),
        (
            "--ae 2640m --ed 30.5cm --ab 26.7cm".to_owned(),
            "at most 300 m",
        ),
        (
            "--ae 10cm --ed 12cm --ab 46cm".to_owned(),
            "has no workspace",
        ),
        (
            format!("{own} --range C=150..10"),
            "the angle at joint C runs from 150 ° to 10 °",
        ),
        (format!("{own} --range C=NaN..10"), "the angle at joint C"),
        (
            format!("{own} --step 4m"),
            "the step of the grid is 4 m; it must be between",
        ),
        (
            format!("{own} --step -1mm"),
            "the step of the grid is -0.001 m",
        ),
        (
            format!("{own} --range C=10..11 --range E=200..201"),
            "has no workspace on a grid",
        ),
        (
            "--range A=0..1 --range B=179..180".to_owned(),
            "no pair of lengths",
        ),
        ("--linkage missing.toml".to_owned(), "there is no such file"),
    ] {
        let message = refused(&desk, &format!("design {line}"), 3);
        assert!(message.contains(words), "{line}: {message}");
        assert_eq!(message.lines().count(), 1, "{message}");
    }
    for line in [
        "--ae 26.4cm",
        "--ae 26.4 --ed 30.5cm --ab 1cm",
        "--range F=1..2",
        "--brakes A",
        "--jobs x",
    ] {
        refused(&desk, &format!("design {line}"), 2);
    }
}
