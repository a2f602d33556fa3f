//! This file holds what a person may get wrong in the model of an arm: one line that names it, exit code 3, and nothing written.

use crate::desk::Desk;

const URDF: &str = include_str!("../../../rigs/arm.urdf");
const MJCF: &str = include_str!("../../../rigs/arm.xml");
const RIG: &str = include_str!("../../../rigs/arm.toml");

/// A desk with a recording, the arm in both formats, and a description of each.
fn desk() -> Desk {
    let desk = Desk::new();
    desk.put("run.csv", &recording(1.0));
    desk.put("urdf.toml", RIG);
    desk.put(
        "mjcf.toml",
        &RIG.replace("urdf = \"arm.urdf\"", "mjcf = \"arm.xml\""),
    );
    desk.put("arm.urdf", URDF);
    desk.put("arm.xml", MJCF);
    desk
}

/// Twelve seconds of both joints; `unit` is one radian as it is written.
fn recording(unit: f64) -> String {
    let rows = (0..1200).map(|k| {
        let t = 0.01 * f64::from(k);
        let [one, two] =
            [0.9 * libm::sin(1.3 * t), 0.8 * libm::sin(1.9 * t + 0.9)].map(|q| unit * q);
        format!(
            "{t},{one},{two},{},{}\n",
            0.3 * libm::cos(1.3 * t),
            0.1 * libm::cos(1.9 * t)
        )
    });
    format!("time (s),q1,q2,tau1,tau2\n{}", rows.collect::<String>())
}

fn refused(desk: &Desk, line: &str, words: &[&str]) {
    let before = desk.names(".");
    let answer = desk.rigproof(line);
    let message = String::from_utf8(answer.stderr).unwrap();
    assert_eq!(answer.status.code(), Some(3), "{line}: {message}");
    let is_one_line = message.starts_with("error: ") && message.lines().count() == 1;
    assert!(is_one_line, "{message}");
    for word in words {
        assert!(message.contains(word), "{message} lacks {word}");
    }
    assert_eq!(desk.names("."), before, "{line}");
}

const INERTIAL_OF_FORE: &str =
    "<inertial pos=\"0.09 0.004 0\" mass=\"0.37\" diaginertia=\"0.0003 0.0012 0.0011\"/>";
const INERTIAL_OF_URDF: &str = r#"<inertial>
      <origin xyz="0.09 0.004 0"/><mass value="0.37"/>
      <inertia ixx="0.0003" ixy="0" ixz="0" iyy="0.0012" iyz="0" izz="0.0011"/>
    </inertial>"#;

/// The format, what is replaced in the arm by what, and the words that are said of it.
const WRONG: &[(&str, &str, &str, [&str; 2])] = &[
    (
        "urdf",
        "<parent link=\"base\"/>",
        "<parent link=\"fore\"/>",
        ["arm.urdf: line", "loop"],
    ),
    (
        "urdf",
        INERTIAL_OF_URDF,
        "<visual/>",
        ["arm.urdf: line", "no `inertial`"],
    ),
    (
        "urdf",
        "<axis xyz=\"0 1 0\"/>\n    <limit lower=\"-2.6\" upper=\"2.6\" effort=\"6\"",
        "<mimic joint=\"shoulder\"/>\n    <limit effort=\"6\"",
        ["arm.urdf: line", "mimic"],
    ),
    (
        "urdf",
        "value=\"0.37\"",
        "value=\"-0.37\"",
        ["arm.urdf: line", "negative"],
    ),
    (
        "urdf",
        "name=\"elbow\"",
        "name=\"ellbow\"",
        ["`elbow` is no moving joint", "ellbow"],
    ),
    (
        "mjcf",
        "</worldbody>",
        "</worldbody><equality><connect body1=\"fore\" anchor=\"0 0 0\"/></equality>",
        ["arm.xml: line 17", "loop"],
    ),
    (
        "mjcf",
        INERTIAL_OF_FORE,
        "",
        ["arm.xml: line 12", "no `inertial`"],
    ),
    (
        "mjcf",
        INERTIAL_OF_FORE,
        "<geom size=\"0.1\"/>",
        ["arm.xml: line 14", "s.compiler.saveinertial = True"],
    ),
    (
        "mjcf",
        "<worldbody>",
        "<include file=\"more.xml\"/><worldbody>",
        ["arm.xml: line 8", "`include`"],
    ),
    (
        "mjcf",
        "mass=\"0.37\"",
        "mass=\"-0.37\"",
        ["arm.xml: line 14", "negative"],
    ),
    (
        "mjcf",
        "name=\"elbow\"",
        "name=\"ellbow\"",
        ["`elbow` is no moving joint", "ellbow"],
    ),
    (
        "mjcf",
        MJCF,
        URDF,
        ["arm.xml: line", "say `urdf` instead of `mjcf`"],
    ),
];

#[test]
fn a_model_that_is_no_arm_is_refused_in_one_line() {
    for (name, from, to, words) in WRONG {
        let desk = desk();
        let (file, text) = if *name == "urdf" {
            ("arm.urdf", URDF)
        } else {
            ("arm.xml", MJCF)
        };
        assert!(text.contains(from), "{from}");
        desk.put(file, &text.replacen(from, to, 1));
        refused(
            &desk,
            &format!("diagnose run.csv --rig {name}.toml --out found"),
            words,
        );
    }
    let desk = desk();
    desk.put(
        "both.toml",
        &RIG.replace("urdf =", "mjcf = \"arm.xml\"\nurdf ="),
    );
    refused(
        &desk,
        "diagnose run.csv --rig both.toml",
        &["both.toml, line", "keep one"],
    );
    desk.put("none.toml", &RIG.replace("urdf =", "source ="));
    refused(
        &desk,
        "diagnose run.csv --rig none.toml",
        &["none.toml, line", "no `urdf` and no `mjcf`"],
    );
}

#[test]
fn degrees_that_are_said_to_be_radians_are_asked_about() {
    let desk = desk();
    desk.put("run.csv", &recording(1f64.to_degrees()));
    for name in ["urdf", "mjcf"] {
        // What is made here is without noise.
        let file = format!("{name}.toml");
        let rig = desk.read(&file);
        desk.put(
            &file,
            &rig.replace(", noise = 0.02", "")
                .replace(", quantum = 0.0001", ""),
        );
        let answer = desk.rigproof(&format!("diagnose run.csv --rig {name}.toml --out {name}"));
        let said = String::from_utf8([answer.stdout, answer.stderr].concat()).unwrap();
        assert!(
            said.contains("are these degrees? say `unit = \"deg\"`"),
            "{said}"
        );
    }
}

#[test]
fn several_recordings_are_a_folder_of_them() {
    let desk = desk();
    std::fs::create_dir(desk.path("runs")).unwrap();
    // The recording has no noise.
    desk.put("quiet.toml", &RIG.replace(", noise = 0.02", ""));
    let slower = recording(0.6);
    desk.put("slower.csv", &slower);
    desk.put("runs/1.csv", &recording(1.0));
    desk.put("runs/2.csv", &slower);
    let told = |line: &str, out: &str| {
        let answer = desk.rigproof(&format!(
            "diagnose {line} --rig quiet.toml --out {out} --quiet"
        ));
        let report = desk.read(&format!("{out}/report.json"));
        let report: serde_json::Value = serde_json::from_str(&report).unwrap();
        (
            answer.status.code(),
            report["verdict"].clone(),
            report["effects"].clone(),
        )
    };
    let apart = told("run.csv slower.csv", "apart");
    assert_eq!(apart, told("runs", "together"));
    assert_ne!(apart.2, told("run.csv", "one").2);
    refused(
        &desk,
        "diagnose run.csv none.csv --rig quiet.toml",
        &["none.csv"],
    );
}
