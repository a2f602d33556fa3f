//! This file does what five newcomers want, by the commands of README and guide alone, each in an empty folder.

use std::fmt::Write;
use std::time::Instant;

use crate::desk::Desk;

/// Prints how long a task took, when it ends.
struct Timed(&'static str, Instant);

impl Timed {
    fn task(task: &'static str) -> Timed {
        Timed(task, Instant::now())
    }
}

impl Drop for Timed {
    fn drop(&mut self) {
        println!("{}: {:.1} s", self.0, self.1.elapsed().as_secs_f64());
    }
}

/// The mechanisms of a diagnosis with their joints.
fn names(desk: &Desk, folder: &str) -> Vec<String> {
    let report = desk.read(&format!("{folder}/report.json"));
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    let effects = report["effects"].as_array().unwrap().iter();
    let names = effects.map(|own| {
        let name = own["mechanism"].as_str().unwrap();
        match own["joint"].as_str() {
            Some(joint) => format!("{name} at {joint}"),
            None => name.to_owned(),
        }
    });
    names.collect()
}

#[test]
fn the_first_sees_the_demonstration() {
    let _timed = Timed::task("demo");
    let desk = Desk::new();
    let said = desk.prints("demo", 0);
    assert!(said.contains("Cause found") && said.lines().count() <= 18);
    let again = "diagnose rigproof-demo/recording.csv --rig rigproof-demo/rig.toml --out first";
    let said = desk.prints(again, 0);
    assert!(said.lines().count() <= 14, "{said}");
    assert!(
        desk.read("first/report.html")
            .starts_with("<!DOCTYPE html>")
    );
}

/// A number of a rig description by its key.
fn value<'a>(rig: &'a str, key: &str) -> &'a str {
    let (_, rest) = rig.split_once(&format!("{key} = {{ value = ")).unwrap();
    rest.split(',').next().unwrap()
}

#[test]
fn the_second_brings_a_csv_of_a_motor_and_gets_a_right_name() {
    let _timed = Timed::task("a CSV of a motor to a right name");
    let desk = Desk::new();
    desk.prints(
        "blind make --plant axis --seed 10 --stratum single --out case",
        0,
    );
    let own = desk.read("case/rig.toml");
    let recording = desk.read("case/recording.csv");
    let (_, samples) = recording.split_once('\n').unwrap();
    desk.put(
        "motor.csv",
        &format!("t [ms],shaft angle [rad],drive [V]\n{}", in_ms(samples)),
    );
    std::fs::remove_dir_all(desk.path("case")).unwrap();

    desk.prints("inspect motor.csv", 0);
    desk.prints("inspect motor.csv --write-rig rig.toml", 0);
    let begun = desk.read("rig.toml");
    let refused = desk.rigproof("diagnose motor.csv --rig rig.toml");
    let said = String::from_utf8(refused.stderr).unwrap();
    assert!(
        said.contains("still to be filled in") && said.contains("so are"),
        "{said}"
    );
    // What a person knows of the motor goes where the file says so, and the friction of the model below it.
    let filled = begun.lines().map(|line| {
        let key = line.split(" = ").next().unwrap_or_default();
        match key {
            "inertia" | "command_gain" => line.replace("\"fill in\"", value(&own, key)),
            "position" => line.replace(
                "\"fill in\", unit = \"fill in\"",
                "\"shaft angle\", unit = \"rad\"",
            ),
            "command" => line.replace("\"fill in\", unit = \"fill in\"", "\"drive\", unit = \"V\""),
            "motion" => line.replace("\"fill in\"", "\"rotary\""),
            "plant" => line.replace("\"fill in\"", "\"axis\""),
            _ => line.to_owned(),
        }
    });
    let filled: Vec<String> = filled.collect();
    let physics = own.find("[[effect]]").unwrap();
    desk.put(
        "rig.toml",
        &format!("{}\n{}", filled.join("\n"), &own[physics..]),
    );
    let said = desk.prints("diagnose motor.csv --rig rig.toml", 0);
    assert_eq!(names(&desk, "motor-diagnosis"), ["dry_offset"], "{said}");
    assert!(
        said.contains("Coulomb friction (dry_offset): level"),
        "{said}"
    );
}

/// The same samples with their time stamps in milliseconds.
fn in_ms(samples: &str) -> String {
    let mut text = String::new();
    for line in samples.lines() {
        let (time, rest) = line.split_once(',').unwrap();
        let time_ms = 1e3 * time.parse::<f64>().unwrap();
        writeln!(text, "{time_ms:.4},{rest}").unwrap();
    }
    text
}

/// Viscous friction of the made arm's elbow that its description lacks, N·m·s/rad.
const HIDDEN: f64 = 0.083;

/// A recording of the arm in `rigs/arm.urdf` on a motion of three sines a joint: torques from Lagrange's equations of two links in a plane, with
/// the friction that the file states at the shoulder, drag at the elbow, and noise.
fn arm() -> String {
    let mut text = String::from("time (s),q1 (rad),q2 (rad),tau1 (N·m),tau2 (N·m)\n");
    let mut state = 0x5eed_u64;
    let mut noise = || {
        // The sum of four even numbers is nearly normal; its standard deviation here is 0.02 N·m.
        let even = (0..4).map(|_| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        });
        0.02 * libm::sqrt(3.0) * even.sum::<f64>()
    };
    let sines = [
        [(0.9, 1.3, 0.2), (0.35, 3.1, 1.1), (0.12, 7.7, 0.4)],
        [(0.8, 1.9, 0.9), (0.3, 4.3, 0.1), (0.1, 8.9, 2.0)],
    ];
    for k in 0..12_000 {
        let t = 0.002 * f64::from(k);
        let motion = sines.map(|own| {
            own.iter().fold([0.0; 3], |[q, w, a], (size, rate, phase)| {
                let (sine, cosine) = (libm::sin(rate * t + phase), libm::cos(rate * t + phase));
                [
                    q + size * sine,
                    w + size * rate * cosine,
                    a - size * rate * rate * sine,
                ]
            })
        });
        let [one, two] = torques(motion);
        let [[q1, ..], [q2, ..]] = motion;
        let count = |q: f64| (q / 1e-4).round() * 1e-4;
        writeln!(
            text,
            "{t:.4},{:.4},{:.4},{:.5},{:.5}",
            count(q1),
            count(q2),
            one + noise(),
            two + noise()
        )
        .unwrap();
    }
    text
}

/// Torques of both joints; the joints turn about y, and weight points along −z.
fn torques([[q1, w1, a1], [q2, w2, a2]]: [[f64; 3]; 2]) -> [f64; 2] {
    let (m1, m2, g, upper) = (0.83, 0.37, 9.806_65, 0.24);
    let ([x1, z1], x2) = ([0.11, 0.005], 0.09);
    let shoulder = 0.0041 + m1 * (x1 * x1 + z1 * z1) + m2 * upper * upper;
    let elbow = 0.0012 + m2 * x2 * x2;
    let (across, along) = (
        m2 * upper * x2 * libm::cos(q2),
        m2 * upper * x2 * libm::sin(q2),
    );
    let both = -m2 * g * x2 * libm::cos(q1 + q2);
    let weight =
        -m1 * g * (x1 * libm::cos(q1) + z1 * libm::sin(q1)) - m2 * g * upper * libm::cos(q1) + both;
    [
        (shoulder + elbow + 2.0 * across) * a1 + (elbow + across) * a2
            - along * (2.0 * w1 * w2 + w2 * w2)
            + weight
            + 0.05 * w1
            + 0.1 * w1.signum(),
        (elbow + across) * a1 + elbow * a2 + along * w1 * w1 + both + HIDDEN * w2,
    ]
}

#[test]
fn the_third_brings_an_arm_and_its_urdf() {
    let _timed = Timed::task("an arm and its URDF");
    let desk = Desk::new();
    desk.put("arm.urdf", include_str!("../../../rigs/arm.urdf"));
    desk.put("arm.toml", include_str!("../../../rigs/arm.toml"));
    desk.put("run.csv", &arm());
    let answer = desk.rigproof("diagnose run.csv --rig arm.toml");
    let said = String::from_utf8([answer.stdout, answer.stderr].concat()).unwrap();
    assert_eq!(answer.status.code(), Some(0), "{said}");
    let names = names(&desk, "run-diagnosis");
    assert!(
        names.contains(&"viscous at elbow".to_owned()),
        "{names:?}: {said}"
    );
    let report: serde_json::Value =
        serde_json::from_str(&desk.read("run-diagnosis/report.json")).unwrap();
    let effects = report["effects"].as_array().unwrap().iter();
    let mut own = effects.filter(|own| own["mechanism"] == "viscous" && own["joint"] == "elbow");
    let found = own.next().unwrap()["parameters"]["coefficient"]["value"]
        .as_f64()
        .unwrap();
    assert!((found - HIDDEN).abs() < 0.1 * HIDDEN, "{found}");
}

/// The same arm in MJCF, from an empty folder to the model with what was found.
#[test]
fn the_third_brings_the_arm_in_mjcf_as_well() {
    let _timed = Timed::task("an arm and its MJCF");
    let desk = Desk::new();
    desk.put("arm.xml", include_str!("../../../rigs/arm.xml"));
    desk.put("run.csv", &arm());
    desk.prints("inspect run.csv --model arm.xml --write-rig begun.toml", 0);
    let begun = desk.read("begun.toml");
    assert!(begun.contains("mjcf = \"arm.xml\""), "{begun}");
    let answer = desk.rigproof("diagnose run.csv --rig begun.toml --out found");
    let said = String::from_utf8([answer.stdout, answer.stderr].concat()).unwrap();
    assert_eq!(answer.status.code(), Some(0), "{said}");
    assert!(
        names(&desk, "found").contains(&"viscous at elbow".to_owned()),
        "{said}"
    );
    assert!(said.contains("take found/calibrated.xml"), "{said}");
    let written = desk.read("found/calibrated.xml");
    let (_, found) = written.split_once("<joint damping=\"").unwrap();
    let found: f64 = found.split('"').next().unwrap().parse().unwrap();
    assert!((found - HIDDEN).abs() < 0.1 * HIDDEN, "{written}");
    // The calibrated model lacks that no more.
    desk.put(
        "again.toml",
        &begun.replace("arm.xml", "found/calibrated.xml"),
    );
    desk.rigproof("diagnose run.csv --rig again.toml --out again");
    let again = names(&desk, "again");
    assert!(!again.contains(&"viscous at elbow".to_owned()), "{again:?}");
}

#[test]
fn the_fourth_changes_a_controller_that_must_not_go_on_the_rig() {
    let _timed = Timed::task("a changed controller refused");
    let desk = Desk::new();
    desk.prints("new lab --plant rig", 0);
    let plan = desk.read("lab/certify.toml");
    desk.put(
        "lab/strict.toml",
        &format!("{plan}\n[limits]\nswitching_per_s = 0.1\n"),
    );
    let line =
        |plan: &str| format!("certify lab/{plan}.toml --scenarios 8 --seconds 0.5 --out {plan}");
    let said = desk.prints(&line("strict"), 1);
    assert!(said.starts_with("Must NOT go on the rig"), "{said}");
    assert!(said.contains("  switching_per_s: "), "{said}");
    let page = desk.read("strict/certificate.html");
    assert!(page.contains("ust not go on the rig"));
    // Without the limit nothing is said of it.
    let lenient = desk.rigproof(&line("certify")).stdout;
    let lenient = String::from_utf8(lenient).unwrap();
    assert!(!lenient.contains("  switching_per_s: "), "{lenient}");
}

#[test]
fn the_fifth_compares_two_diagnoses() {
    let _timed = Timed::task("two diagnoses compared");
    let desk = Desk::new();
    desk.prints(
        "blind make --plant bench --seed 11 --stratum single --out case",
        0,
    );
    let line = "diagnose case/recording.csv --rig case/rig.toml";
    desk.prints(line, 0);
    desk.prints(&format!("{line} --to-s 9"), 0);
    let [one, other] = ["recording-diagnosis", "recording-diagnosis-2"];
    let same = desk.prints(&format!("diff {one} {one}"), 0);
    assert!(same.ends_with("say the same.\n"), "{same}");
    let said = desk.prints(&format!("diff {one} {other} --html changed.html"), 0);
    assert!(
        said.contains("changed from recording-diagnosis to"),
        "{said}"
    );
    assert!(said.contains("error on held-out data, after:"), "{said}");
    let page = desk.read("changed.html");
    assert!(page.contains("What changed") && page.contains("error on held-out data"));
    let json = desk.json(
        &format!("diff {one}/calibration.toml {other}/calibration.toml --json"),
        0,
    );
    assert_eq!(json["same"], false);
    let changes = json["changes"].as_array().unwrap();
    let peak = changes.iter().find(|own| own["name"] == "peak").unwrap();
    assert!(peak["beyond_intervals"].is_boolean(), "{peak}");
    // One of each kind is no pair.
    let mixed = desk.rigproof(&format!("diff {one} {other}/calibration.toml"));
    assert_eq!(mixed.status.code(), Some(2));
    assert_eq!(
        desk.rigproof("diff case/rig.toml case/recording.csv")
            .status
            .code(),
        Some(3)
    );
}
