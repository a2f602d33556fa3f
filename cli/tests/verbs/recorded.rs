//! This file replays recordings of a five-bar through an old and a new controller, as a laboratory does.

use serde_json::Value;

use crate::desk::Desk;

const PATH: &str = "[path]\nkind = \"chain\"\n[[path.point]]\nx_m = -0.12\ny_m = 0.37\n[[path.point]]\nx_m = 0.13\ny_m = 0.41\n";
const LINE: &str = "certify certify.toml --recordings runs --rig runs/rig.toml";

/// A description of a controller with a gain, beside one of 400 N·s/m.
fn description(gain_n_s_per_m: f64, more: &str) -> String {
    let law = |name: &str, gain: f64| {
        format!("[{name}]\nkind = \"proportional\"\ngain_n_s_per_m = {gain}\n")
    };
    law("controller", gain_n_s_per_m) + &law("baseline", 400.0) + PATH + more
}

/// Two recordings of a concealed rig in `runs`, 5 s each.
fn desk() -> Desk {
    let desk = Desk::new();
    desk.prints("blind make --plant rig --seed 34 --out case", 0);
    std::fs::create_dir(desk.path("runs")).unwrap();
    let text = desk.read("case/recording.csv");
    let (head, rows) = text.split_once('\n').unwrap();
    let rows: Vec<&str> = rows.lines().collect();
    for (name, part) in [("first", &rows[..5000]), ("second", &rows[9000..14_000])] {
        desk.put(
            &format!("runs/{name}.csv"),
            &format!("{head}\n{}\n", part.join("\n")),
        );
    }
    desk.put("runs/rig.toml", &desk.read("case/rig.toml"));
    desk
}

fn refused(desk: &Desk, line: &str, code: i32, why: &str) {
    let answer = desk.rigproof(line);
    let message = String::from_utf8(answer.stderr).unwrap();
    assert_eq!(answer.status.code(), Some(code), "{message}");
    assert!(message.contains(why), "{message}");
}

#[test]
fn an_unchanged_controller_passes_and_a_changed_gain_is_found_with_field_and_time() {
    let desk = desk();
    desk.put("certify.toml", &description(400.0, ""));
    let same = desk.prints(LINE, 0);
    assert!(
        same.starts_with(
            "The new controller commands bit for bit what the old one does in all 2 recordings"
        ),
        "{same}"
    );
    assert_eq!(same.matches("the same bit for bit").count(), 2, "{same}");
    desk.put("certify.toml", &description(440.0, ""));
    let text = desk.prints(LINE, 1);
    assert!(
        text.starts_with("The new controller does NOT do what is expected in 2 of 2 recordings."),
        "{text}"
    );
    for words in [
        "first.csv",
        "second.csv",
        "no difference is expected",
        "left of the path",
        "counts A, B",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    let json = desk.json(&format!("{LINE} --json"), 1);
    assert_eq!(
        (&json["holds"], &json["expected"]),
        (&false.into(), &Value::Null)
    );
    for own in json["recordings"].as_array().unwrap() {
        let [first, why] = [0, 1].map(|k| &own["compared"]["first_unmeant"][k]);
        assert_eq!(why, "nothing_expected");
        let (time_s, sample) = (
            first["time_s"].as_f64().unwrap(),
            first["sample"].as_u64().unwrap(),
        );
        assert!(time_s > 0.0 && sample > 0 && !first["brakes"].as_array().unwrap().is_empty());
        assert_ne!(first["old_a"], first["new_a"]);
    }
    // One of them alone.
    let alone = desk.json(
        &format!("{LINE} --json").replace("--recordings runs", "--recordings runs/second.csv"),
        1,
    );
    assert_eq!(alone["recordings"].as_array().unwrap().len(), 1);
    assert_eq!(
        alone["recordings"][0]["compared"],
        json["recordings"][1]["compared"]
    );
}

#[test]
fn what_is_expected_passes_and_what_is_expected_and_not_seen_does_not() {
    let desk = desk();
    let meant = "[expected]\nmost_a = 0.2\n";
    desk.put("certify.toml", &description(440.0, meant));
    let text = desk.prints(LINE, 0);
    assert!(
        text.starts_with("The new controller differs as expected, and in nothing else"),
        "{text}"
    );
    desk.put("certify.toml", &description(400.0, meant));
    let text = desk.prints(LINE, 1);
    assert!(
        text.starts_with("The change that certify.toml expects was NOT seen"),
        "{text}"
    );
    desk.put(
        "certify.toml",
        &description(440.0, "[expected]\nmost_a = 0.00001\n"),
    );
    let text = desk.prints(LINE, 1);
    assert!(
        text.contains("a command differs by more than `most_a`"),
        "{text}"
    );
    desk.put(
        "certify.toml",
        &description(440.0, "[expected]\nmost_share = 0.0001\n"),
    );
    let text = desk.prints(LINE, 1);
    assert!(text.contains("more than `most_share` allows"), "{text}");
}

#[test]
fn what_cannot_be_replayed_is_refused_and_says_why() {
    let desk = desk();
    desk.put("certify.toml", &description(440.0, ""));
    refused(&desk, "certify certify.toml --recordings runs", 2, "--rig");
    refused(
        &desk,
        "certify --recordings runs --rig runs/rig.toml",
        2,
        "CERTIFY.TOML",
    );
    refused(
        &desk,
        &format!("{LINE} --search 3"),
        2,
        "cannot be used with",
    );
    for (text, why) in [
        (description(440.0, "[expected]\n"), "it states nothing"),
        (
            description(440.0, "[expected]\nbrakes = \"A D\"\n"),
            "`D` is no brake",
        ),
        (
            description(440.0, "[expected]\nmost_a = 2\n"),
            "from 0 to 1",
        ),
        (
            description(440.0, "").replace("chain", "circle"),
            "no kind of path",
        ),
        (
            description(440.0, "").replace(PATH, ""),
            "add a table [path]",
        ),
        (
            description(440.0, "").replace(
                "[baseline]\nkind = \"proportional\"\ngain_n_s_per_m = 400\n",
                "",
            ),
            "the old controller",
        ),
        (
            format!("layout = \"three_brake\"\n{}", description(440.0, "")),
            "not the rig's, which is four_brake",
        ),
        (
            description(440.0, "")
                .replace("y_m = 0.41", "y_m = 0.37")
                .replace("x_m = 0.13", "x_m = -0.12"),
            "no path comes of it",
        ),
    ] {
        desk.put("certify.toml", &text);
        refused(&desk, LINE, 3, why);
    }
}

/// Two compiled controllers: the damper, and one with another gain.
#[cfg(target_os = "linux")]
#[test]
fn a_compiled_controller_is_replayed_beside_the_compiled_one_before_it() {
    use crate::controller::{ROOM, compiled};
    let desk = desk();
    let text = |name: &str| std::fs::read_to_string(format!("{ROOM}/examples/{name}")).unwrap();
    let source = text("guarded.c").replace("#include \"damping.h\"", &text("damping.h"));
    for (name, gain) in [("old", "0.3"), ("new", "0.33")] {
        let line = "#define GAIN_A_S_PER_RAD 0.3\n";
        assert!(source.contains(line));
        let changed = source.replace(line, &format!("#define GAIN_A_S_PER_RAD {gain}\n"));
        desk.put(&format!("{name}.c"), &changed);
        if compiled(
            &desk.path(&format!("{name}.c")),
            &desk.path(&format!("{name}.so")),
        )
        .is_none()
        {
            return;
        }
    }
    desk.put(
        "certify.toml",
        &format!("[declares]\nmost_brakes = 1\nlocks = false\n{PATH}"),
    );
    let same = desk.prints(&format!("{LINE} --old old.so --controller old.so"), 0);
    assert!(same.contains("bit for bit"), "{same}");
    let text = desk.prints(&format!("{LINE} --old old.so --controller new.so"), 1);
    assert!(
        text.contains("it looks like a factor: 1.100 times the old currents"),
        "{text}"
    );
}
