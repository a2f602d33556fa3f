//! This file holds what `rigproof inspect` says of a recording, and the way from an unknown file to a diagnosis.

use approx::assert_relative_eq;

use crate::convert::public;
use crate::desk::{Desk, assert_shape};

/// A recording as a German spreadsheet saves it: `;`, decimal commas, a remark and a units row.
fn foreign(recording: &str) -> String {
    let mut lines = recording.lines();
    let names = lines.next().unwrap();
    let (names, units): (Vec<&str>, Vec<&str>) = names
        .split(',')
        .map(|cell| cell.strip_suffix(')').unwrap().split_once(" (").unwrap())
        .unzip();
    let rows: String = lines
        .map(|line| line.replace(',', ";").replace('.', ",") + "\r\n")
        .collect();
    let (names, units) = (names.join(";"), units.join(";"));
    format!("Recorder 1\r\n\r\n{names}\r\n{units}\r\n{rows}")
}

/// The first noise of a rig description.
fn noise(rig: &str) -> f64 {
    let number = rig.split("noise = ").nth(1).unwrap().split(' ').next();
    number.unwrap().parse().unwrap()
}

/// A begun description without the friction that it begins with.
fn without_physics(rig: &str) -> String {
    let end = rig.find("# The physics that your model has").unwrap();
    rig[..end].to_owned()
}

/// The mechanisms that a diagnosis names.
fn names(found: &serde_json::Value) -> Vec<&str> {
    let effects = found["effects"].as_array().unwrap();
    effects
        .iter()
        .map(|effect| effect["mechanism"].as_str().unwrap())
        .collect()
}

#[test]
fn three_commands_lead_from_an_unknown_file_to_a_diagnosis() {
    let desk = Desk::new();
    desk.prints(
        "blind make --plant bench --seed 11 --stratum single --out case",
        0,
    );
    desk.put("run.csv", &foreign(&desk.read("case/recording.csv")));
    let known = desk.json(
        "diagnose case/recording.csv --rig case/rig.toml --out known --json",
        0,
    );
    let own_rig = desk.read("case/rig.toml");
    std::fs::remove_dir_all(desk.path("case")).unwrap();

    let text = desk.prints("inspect run.csv", 0);
    let said = "read as: separator ';', decimal ',', 2 header lines, units row, UTF-8";
    assert!(text.contains(said), "{text}");
    assert!(
        text.contains("500.0 Hz") && text.contains("gaps    none"),
        "{text}"
    );
    let next = text.lines().last().unwrap().trim();
    assert_eq!(next, "rigproof inspect run.csv --write-rig rig.toml");
    desk.prints("inspect run.csv --write-rig rig.toml", 0);
    let rig = desk.read("rig.toml");
    assert!(rig.contains("plant = \"bench\"   # guess"), "{rig}");
    // The noise of the load cell is guessed to a tenth of what the maker of the recording put in.
    assert_relative_eq!(noise(&rig), noise(&own_rig), max_relative = 0.1);
    // As it was begun it diagnoses; what a person fills in is the physics that the model has.
    desk.json("diagnose run.csv --rig rig.toml --out begun --json", 0);
    let physics = own_rig.find("[[effect]]").unwrap();
    desk.put("rig.toml", &(without_physics(&rig) + &own_rig[physics..]));
    let found = desk.json("diagnose run.csv --rig rig.toml --json", 0);
    assert_shape(&found);
    assert_eq!(found["verdict"], known["verdict"]);
    assert_eq!(names(&found), ["stribeck"]);
    assert_eq!(names(&found), names(&known));
    assert_eq!(found["inputs"][0]["read_as"]["separator"], ";");
    assert_eq!(found["inputs"][0]["read_as"]["header_lines"], 2);
    assert!(found["inputs"][1]["read_as"].is_null());
    let protocol = found["protocol"].as_array().unwrap();
    assert!(
        protocol
            .iter()
            .any(|line| line.as_str().unwrap().ends_with(said)),
        "{protocol:?}"
    );
}

#[test]
fn what_is_not_known_is_filled_in_by_a_person() {
    let desk = Desk::new();
    desk.prints(
        "blind make --plant axis --seed 11 --stratum single --out case",
        0,
    );
    desk.prints("inspect case/recording.csv --write-rig rig.toml", 0);
    let noise = |name: &str| noise(&desk.read(name));
    assert_relative_eq!(
        noise("rig.toml"),
        noise("case/rig.toml"),
        max_relative = 0.1
    );
    let refused = |expected: &str| {
        let answer = desk.rigproof("diagnose case/recording.csv --rig rig.toml");
        let message = String::from_utf8(answer.stderr).unwrap();
        assert_eq!(answer.status.code(), Some(3), "{message}");
        assert!(message.contains(expected), "{message}");
        assert!(message.contains("rig.toml, line "), "{message}");
    };
    refused("`value` of `inertia` is still to be filled in; give a number");
    let rig = desk.read("rig.toml");
    let rig = rig.replacen("\"fill in\", unit = \"kg", "0.0176, unit = \"kg", 1);
    desk.put("rig.toml", &rig);
    refused("`value` of `command_gain` is still to be filled in");
    desk.put(
        "rig.toml",
        &rig.replacen("value = \"fill in\"", "value = 1.89", 1),
    );
    desk.prints("diagnose case/recording.csv --rig rig.toml", 0);

    // A description that somebody completed is not written over.
    let answer = desk.rigproof("inspect case/recording.csv --write-rig rig.toml");
    assert_eq!(answer.status.code(), Some(3));
    assert!(desk.read("rig.toml").contains("1.89"));
}

#[test]
fn channels_that_look_alike_are_left_to_a_person() {
    let desk = Desk::new();
    let rows: String = (0..40)
        .map(|k| {
            format!(
                "{},{},{},{}\n",
                4 * k + k / 30 * 90,
                (k * k) % 7,
                3 * k,
                if k % 9 == 3 { "" } else { "1.5" }
            )
        })
        .collect();
    desk.put("run.csv", &format!("t (ms),a (mm),b (mm),spare\n{rows}"));
    desk.prints("inspect run.csv --write-rig rig.toml", 0);
    let rig = desk.read("rig.toml");
    assert!(
        rig.contains("position = { channel = \"fill in\", unit = \"fill in\" }   # which of a, b?"),
        "{rig}"
    );
    assert!(rig.contains("plant = \"fill in\""), "{rig}");
    let said = desk.json("inspect run.csv --ascii --json", 0);
    assert_eq!(said["gaps"].as_array().unwrap().len(), 1);
    assert!((said["step_s"].as_f64().unwrap() - 4e-3).abs() < 1e-12);
    let [a, _, spare] = [0, 1, 2].map(|k| &said["channels"][k]);
    assert_eq!(
        (a["quantum"].as_f64(), a["on_grid"].as_bool()),
        (Some(1.0), Some(true))
    );
    assert_eq!(
        (spare["missing"].as_u64(), spare["quantum"].as_f64()),
        (Some(5), None)
    );
    assert_eq!(a["sparkline"].as_str().unwrap().len(), 32);
    let picture = desk.prints("inspect run.csv", 0);
    assert!(
        picture.contains('█') && picture.contains("5 missing"),
        "{picture}"
    );
}

#[test]
fn a_dialect_can_be_said_and_every_verb_says_how_it_read() {
    let desk = Desk::new();
    desk.prints(
        "blind make --plant bench --seed 11 --stratum single --out case",
        0,
    );
    let text = "made by hand\n".to_owned() + &desk.read("case/recording.csv");
    desk.put("run.csv", &text);
    let line = "convert run.csv out.csv --header-lines 1 --separator , --json";
    let said = desk.json(line, 0);
    let read_as = serde_json::json!({
        "separator": ",", "decimal": ".", "header_lines": 1, "units_row": false, "encoding": "UTF-8" });
    assert_eq!(said["read_as"], read_as);
    assert_eq!(
        desk.read("out.csv").lines().count() + 1,
        text.lines().count()
    );
    let rig = desk.read("case/rig.toml") + "\n[text]\nheader_lines = 1\n";
    desk.put("rig.toml", &rig);
    let said = desk.json("simulate run.csv --rig rig.toml --json", 0);
    assert_eq!(said["read_as"], read_as);
    for wrong in ["--separator |", "--decimal ;", "--header-lines -1"] {
        let answer = desk.rigproof(&format!("inspect run.csv {wrong}"));
        assert_eq!(answer.status.code(), Some(2), "{wrong}");
    }
    let answer = desk.rigproof("inspect run.csv --separator tab");
    assert_eq!(answer.status.code(), Some(3));
}

#[test]
fn an_mcap_file_is_looked_into() {
    let desk = Desk::new();
    desk.prints(
        "blind make --plant bench --seed 11 --stratum single --out case",
        0,
    );
    desk.prints("convert case/recording.csv run.mcap", 0);
    let said = desk.json("inspect run.mcap --json --write-rig rig.toml", 0);
    assert_eq!(said["whole"], true);
    let topics = said["topics"].as_array().unwrap();
    let run = topics
        .iter()
        .find(|topic| topic["name"] == "/rigproof/run")
        .unwrap();
    assert_eq!(run["messages"], 8500);
    assert!((run["rate_hz"].as_f64().unwrap() - 500.0).abs() < 1e-6);
    let channels = run["channels"].as_array().unwrap();
    assert!(
        channels
            .iter()
            .any(|c| c["name"].as_str().unwrap().contains("torque")),
        "{run}"
    );
    assert!(channels.iter().all(|c| c["missing"] == 0));
    let rig = desk.read("rig.toml");
    assert!(
        rig.contains("name = \"run\"") && rig.contains("\ntorque = {"),
        "{rig}"
    );
    // What was guessed of the CSV is guessed of the messages: the median of 266 runs scatters by 7 %. A person fills in
    // the physics.
    let own_rig = desk.read("case/rig.toml");
    assert_relative_eq!(noise(&rig), noise(&own_rig), max_relative = 0.2);
    let physics = own_rig.find("[[effect]]").unwrap();
    desk.put("rig.toml", &(without_physics(&rig) + &own_rig[physics..]));
    let found = desk.json("diagnose run.mcap --rig rig.toml --json", 0);
    assert_eq!(names(&found), ["stribeck"]);
    let protocol = found["protocol"].to_string();
    assert!(
        protocol.contains("run.mcap: check sums: chunks verified"),
        "{protocol}"
    );
    let text = desk.prints("inspect run.mcap", 0);
    assert!(
        text.contains("check sums: chunks verified") && text.contains("rate 500.0 Hz"),
        "{text}"
    );
}

#[test]
fn structures_of_a_matlab_file_are_shown_one_by_one() {
    let desk = Desk::new();
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../trace/fuzz/corpus/arrays/structures.mat"
    );
    let said = desk.json(&format!("inspect {file} --json"), 0);
    let names: Vec<&str> = said["channels"]
        .as_array()
        .unwrap()
        .iter()
        .map(|c| c["name"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["n", "run[0].Data", "run[1].Data"]);
    let data = &said["channels"][1];
    assert_eq!(
        (data["minimum"].as_f64(), data["maximum"].as_f64()),
        (Some(0.5), Some(4.5))
    );
    assert_eq!(
        (data["quantum"].as_f64(), data["on_grid"].as_bool()),
        (Some(0.25), Some(true))
    );
    let text = desk.prints(&format!("inspect {file}"), 0);
    assert!(
        text.contains("run[1].Data") && text.contains("rigproof convert"),
        "{text}"
    );
    let answer = desk.rigproof(&format!("inspect {file} --write-rig rig.toml"));
    assert_eq!(answer.status.code(), Some(2));
}

#[test]
fn one_topic_is_shown_where_it_is_asked_for() {
    let desk = Desk::new();
    desk.prints(
        "blind make --plant bench --seed 11 --stratum single --out case",
        0,
    );
    desk.prints("convert case/recording.csv run.mcap", 0);
    let one = desk.prints("inspect run.mcap --topic /joint_states", 0);
    assert!(
        one.contains("/joint_states") && !one.contains("/rigproof/run"),
        "{one}"
    );
    let wrong = desk.rigproof("inspect run.mcap --topic /joint_state");
    let said = String::from_utf8(wrong.stderr).unwrap();
    assert!(said.contains("did you mean `/joint_states`?"), "{said}");
    let text = desk.rigproof("inspect case/recording.csv --topic /joint_states");
    assert_eq!(text.status.code(), Some(2));
}

/// Of many topics each is one line; the public bag holds 94.
#[test]
fn many_topics_are_a_line_each() {
    let Some(bag) = public("mcap/test_bag_mcap.mcap") else {
        return;
    };
    let desk = Desk::new();
    let bag = bag.display().to_string();
    let answer = desk.runs(&["inspect", &bag]);
    let text = String::from_utf8(answer.stdout).unwrap();
    assert!(text.contains("188 messages on 94 topics"), "{text}");
    assert!((94..94 + 20).contains(&text.lines().count()), "{text}");
    assert_eq!(
        text.lines()
            .filter(|line| line.contains(" channels  "))
            .count(),
        94
    );
    assert!(text.contains("--topic "), "{text}");
}

#[test]
fn the_rows_of_a_sweep_need_no_time_and_its_law_is_found_from_nothing() {
    let desk = Desk::new();
    // A force that grows with the square of the command, with a little scatter.
    let rows = (0..60).map(|k| {
        let volts = 0.25 * f64::from(k % 20);
        let scatter = 0.4 * libm::sin(f64::from(k * k));
        format!("{volts},{:.3}\n", 12.0 + 4.0 * volts * volts + scatter)
    });
    desk.put(
        "sweep.csv",
        &("u (V),force (N)\n".to_owned() + &rows.collect::<String>()),
    );
    let answer = desk.rigproof("inspect sweep.csv");
    let message = String::from_utf8(answer.stderr).unwrap();
    assert!(message.contains("`inspect --sweep`"), "{message}");
    let said = desk.prints("inspect sweep.csv --sweep --write-rig rig.toml", 0);
    assert!(!said.contains("Time"), "{said}");
    let report = desk.json("diagnose sweep.csv --rig rig.toml --json", 0);
    let effects = report["effects"].as_array().unwrap();
    let names: Vec<&str> = effects
        .iter()
        .map(|own| own["mechanism"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["command_exponent"], "{}", report["summary"]);
    let exponent = &effects[0]["parameters"]["exponent"]["value"];
    assert_relative_eq!(exponent.as_f64().unwrap(), 2.0, max_relative = 0.05);
    desk.prints("simulate sweep.csv --rig rig.toml", 0);
}
