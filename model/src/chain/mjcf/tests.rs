//! An arm in MJCF held to MuJoCo, to the same arm in a URDF, and to what it must not leave to a compiler.

use super::*;
use crate::chain::{Changes, Stated};
use std::collections::BTreeMap;

/// An arm in many of the ways that MJCF has.
const ARM: &str = r#"<mujoco model="made">
  <compiler angle="degree" eulerseq="zYx"/>
  <option gravity="0.7 -0.4 -9.6"/>
  <default>
    <joint damping="0.13"/>
    <default class="geared"><joint armature="0.017" frictionloss="0.21" pos="0.02 -0.01 0.03"/></default>
  </default>
  <worldbody>
    <geom type="plane" size="1 1 1"/>
    <body name="upper" pos="0.1 0.2 0.3" euler="20 -35 50" childclass="geared">
      <joint name="turn" axis="0.2 0.9 -0.1" ref="25"/>
      <joint name="lift" class="main" type="slide" axis="1 0.3 0.2" pos="0.01 0.02 0.07" ref="0.14" armature="0.4"/>
      <inertial pos="0.04 -0.02 0.13" mass="1.7" diaginertia="0.011 0.014 0.009" axisangle="1 2 -1 40"/>
      <frame pos="0.05 0 0.24" zaxis="0.3 -0.2 0.8">
        <body name="sensor" pos="0 0.03 0" quat="0.8 0.1 -0.3 0.2">
          <inertial pos="0.01 0 0" mass="0.23" diaginertia="0.0004 0.0005 0.0003"/>
          <geom size="0.02" mass="0"/>
        </body>
        <body name="fore" pos="0.03 0.01 0.05" xyaxes="0.9 0.1 0.2 -0.1 1 0.3">
          <joint name="bend" axis="0 -0.6 0.8"/>
          <inertial pos="0.08 0.01 0" mass="0.61" fullinertia="0.003 0.005 0.004 0.0004 -0.0003 0.0002"/>
          <site name="flange" pos="0.2 0.03 0.01"/>
        </body>
      </frame>
    </body>
  </worldbody>
</mujoco>"#;

const Q: [f64; 3] = [0.71, -0.13, 1.37];
const SPEED: [f64; 3] = [1.31, -0.83, 2.11];
const FASTER: [f64; 3] = [-3.1, 2.7, -4.3];
/// `mj_inverse` of MuJoCo 4.0.0 in that state, without constraints: damping is in it, Coulomb friction is not.
const MUJOCO: [f64; 3] = [5.386370094040545, 21.952962268511566, 0.13400943458893028];

fn efforts(arm: &Chain) -> Vec<f64> {
    let efforts = arm.efforts(&Q, &SPEED, &FASTER).into_iter();
    let each = efforts.zip(&arm.joints).zip(SPEED);
    each.map(|((own, joint), speed)| own + joint.damping * speed)
        .collect()
}

#[test]
fn an_arm_takes_the_efforts_that_it_takes_in_mujoco() {
    for tip in [None, Some("fore"), Some("flange")] {
        let arm = Chain::from_mjcf(ARM, tip).unwrap();
        for (own, theirs) in efforts(&arm).iter().zip(MUJOCO) {
            assert!(
                (own - theirs).abs() < 1e-12 * theirs.abs().max(1.0),
                "{own} {theirs}"
            );
        }
    }
    let arm = Chain::from_mjcf(ARM, Some("flange")).unwrap();
    let stated: Vec<[f64; 3]> = arm
        .joints
        .iter()
        .map(|own| [own.friction, own.damping, own.armature])
        .collect();
    assert_eq!(
        stated,
        [[0.21, 0.13, 0.017], [0.0, 0.13, 0.4], [0.21, 0.13, 0.017]]
    );
    // The site of MuJoCo in the same state, m.
    let last = arm.poses(&Q, &SPEED, &FASTER)[2];
    let tip = last.origin + last.rotation * arm.tip;
    let theirs = Vector3::new(0.03552916, -0.11115648, 0.5705975);
    assert!((tip - theirs).norm() < 1e-8, "{tip}");
}

/// The rotor is part of energy and of the matrix of masses, too.
#[test]
fn power_is_the_rate_of_the_energy_with_rotors() {
    let arm = Chain::from_mjcf(ARM, None).unwrap();
    let energy = |t: f64| {
        let q: [f64; 3] = core::array::from_fn(|k| Q[k] + SPEED[k] * t + 0.5 * FASTER[k] * t * t);
        let speed: [f64; 3] = core::array::from_fn(|k| SPEED[k] + FASTER[k] * t);
        arm.energy(&q, &speed).iter().sum::<f64>()
    };
    let rate = (energy(1e-5) - energy(-1e-5)) / 2e-5;
    let power: f64 = arm
        .efforts(&Q, &SPEED, &FASTER)
        .iter()
        .zip(SPEED)
        .map(|(e, v)| e * v)
        .sum();
    assert!((rate - power).abs() < 1e-6 * power.abs(), "{rate} {power}");
}

/// The arm of three joints that turn and one that slides, as `super::tests` has it in a URDF.
const AS_URDF: &str = r#"<mujoco><compiler angle="radian" eulerseq="XYZ"/><option gravity="0 0 -9.81"/><worldbody>
<body name="one" pos="0.01 0.02 0.31" euler="0.05 0 0.4"><joint name="j1"/><inertial pos="0.03 -0.02 0.11" mass="2.3" quat="1 0 0 0" diaginertia="1 1 1"/>
<body name="two" pos="0 0.05 0.12" euler="-1.5 0.2 0"><joint name="j2" axis="0 0.6 0.8" damping="0.3" frictionloss="0.2"/><inertial pos="0.13 0.01 0.02" mass="1.7" fullinertia="0.011 0.017 0.013 0.001 0.002 -0.001"/>
<body name="three" pos="0.27 0 0" euler="0.3 -0.7 0.2"><joint name="j3" type="slide" axis="1 0 0"/><inertial pos="0.02 0.03 0.07" mass="0.9" fullinertia="0.004 0.005 0.003 0 0.0003 0"/>
<body name="flange" pos="0 0.1 0.05" euler="0.9 0 0.4"><inertial pos="0.01 0 0.01" mass="0.4" diaginertia="0.001 0.0012 0.0009"/>
<body name="tool" pos="0.02 0 0.09" euler="0 1.1 0"><joint name="j4" axis="0 1 0"/><inertial pos="0 0.04 0.06" mass="0.6" fullinertia="0.002 0.0015 0.001 0.0001 0 0.0002"/>
</body></body></body></body></body></worldbody></mujoco>"#;

#[test]
fn the_same_arm_in_a_urdf_is_the_same_arm() {
    // An inertial of a URDF may be turned with all its moments, one of MJCF with its principal ones alone.
    let urdf = super::super::tests::ARM
        .replace("rpy=\"0.1 0.2 -0.3\"", "")
        .replace(
            "ixx=\"0.021\" ixy=\"0.002\" ixz=\"-0.001\" iyy=\"0.019\" iyz=\"0.0015\" izz=\"0.014\"",
            "ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"",
        );
    let [one, other] = [
        Chain::from_urdf(&urdf, None),
        Chain::from_mjcf(AS_URDF, None),
    ]
    .map(Result::unwrap);
    for (one, other) in one.joints.iter().zip(&other.joints) {
        assert_eq!(
            (&one.name, &one.link, one.kind),
            (&other.name, &other.link, other.kind)
        );
        assert_eq!((one.damping, one.friction), (other.damping, other.friction));
        for (a, b) in one.own.numbers().iter().zip(other.own.numbers()) {
            assert!((a - b).abs() < 1e-14, "{a} {b}");
        }
    }
    let state = (
        [0.71, -1.13, 0.21, 2.37],
        [1.31, -0.83, 0.47, 2.11],
        [-3.1, 2.7, 1.9, -4.3],
    );
    let [one, other] = [one, other].map(|own| own.efforts(&state.0, &state.1, &state.2));
    assert!(one.iter().any(|own| own.abs() > 1.0));
    for (a, b) in one.iter().zip(&other) {
        assert!((a - b).abs() < 1e-12 * a.abs().max(1.0), "{a} {b}");
    }
}

const INERTIAL_OF_FORE: &str = "<inertial pos=\"0.08 0.01 0\" mass=\"0.61\" fullinertia=\"0.003 0.005 0.004 0.0004 -0.0003 0.0002\"/>";
const BEND: &str = "<joint name=\"bend\"";
const END: &str = "</worldbody>";

/// What is replaced in the arm by what, and the words that are said of it.
const WRONG: &[(&str, &str, [&str; 2])] = &[
    // What the compiler would infer.
    (
        INERTIAL_OF_FORE,
        "<geom size=\"0.1\"/>",
        ["line 21", "saveinertial"],
    ),
    (
        "angle=\"degree\"",
        "inertiafromgeom=\"true\"",
        ["line 2", "saveinertial"],
    ),
    (
        "<option",
        "<include file=\"a.xml\"/><option",
        ["line 3", "`include`"],
    ),
    (
        "angle=\"degree\"",
        "settotalmass=\"3\"",
        ["line 2", "`settotalmass`"],
    ),
    (
        BEND,
        "<replicate count=\"2\"/><joint name=\"bend\"",
        ["line 20", "`replicate`"],
    ),
    // Inertias that are missing or of no body.
    (INERTIAL_OF_FORE, "", ["line 19", "no `inertial`"]),
    ("mass=\"0.61\"", "mass=\"-0.61\"", ["line 21", "negative"]),
    (
        "fullinertia=\"0.003",
        "fullinertia=\"0.03",
        ["line 21", "triangle"],
    ),
    (
        "mass=\"0.61\" full",
        "mass=\"0.61\" diaginertia=\"1 1 1\" full",
        ["line 21", "one of `diaginertia`"],
    ),
    ("mass=\"0.61\"", "", ["line 21", "`mass` is missing"]),
    // Joints and what pulls at them.
    (
        BEND,
        "<joint type=\"ball\" name=\"bend\"",
        ["line 20", "`ball`"],
    ),
    (
        "<joint name=\"turn\"",
        "<freejoint/><joint name=\"turn\"",
        ["line 1:", "free"],
    ),
    (BEND, "<joint", ["line 20", "no name"]),
    (BEND, "<joint name=\"turn\"", ["line 20", "twice"]),
    (
        BEND,
        "<joint stiffness=\"3\" name=\"bend\"",
        ["line 20", "spring"],
    ),
    (
        BEND,
        "<joint damping=\"0.1 0.2\" name=\"bend\"",
        ["line 20", "`damping"],
    ),
    (
        BEND,
        "<joint armature=\"-1\" name=\"bend\"",
        ["line 20", "`armature"],
    ),
    (
        BEND,
        "<joint class=\"gared\" name=\"bend\"",
        ["line 20", "geared"],
    ),
    (
        "axis=\"0 -0.6 0.8\"",
        "axis=\"0 0 0\"",
        ["line 20", "direction"],
    ),
    (
        "<body name=\"sensor\"",
        "<body gravcomp=\"1\" name=\"sensor\"",
        ["line 15", "`gravcomp`"],
    ),
    (
        "<site ",
        "<body name=\"finger\"><joint name=\"f\"/></body><body name=\"thumb\"><joint name=\"t\"/></body><site ",
        ["branches", "finger, thumb"],
    ),
    (
        "<geom size=\"0.02\" mass=\"0\"/>",
        "<joint name=\"loose\"/>",
        ["branches", "sensor, fore"],
    ),
    (
        END,
        "</worldbody><equality><connect body1=\"fore\" anchor=\"0 0 0\"/></equality>",
        ["line 26", "loop"],
    ),
    (
        END,
        "</worldbody><equality><weld site1=\"flange\" site2=\"x\"/></equality>",
        ["line 26", "loop"],
    ),
    (
        END,
        "</worldbody><equality><joint name=\"both\" joint1=\"bend\" joint2=\"turn\"/></equality>",
        ["line 26", "both"],
    ),
    (
        END,
        "</worldbody><tendon><fixed name=\"wire\"><joint joint=\"bend\" coef=\"1\"/></fixed></tendon>",
        ["line 26", "wire"],
    ),
    (
        END,
        "</worldbody><actuator><motor name=\"m\" joint=\"bend\" armature=\"0.1\"/></actuator>",
        ["line 26", "square of the gear"],
    ),
    // Text.
    (
        "xyaxes=\"0.9 0.1 0.2 -0.1 1 0.3\"",
        "xyaxes=\"0.9 0.1 0.2\"",
        ["line 19", "6 numbers"],
    ),
    (
        "quat=\"0.8 0.1 -0.3 0.2\"",
        "quat=\"0.8 0.1 -0.3 0.2\" euler=\"1 2 3\"",
        ["line 15", "twice"],
    ),
    ("eulerseq=\"zYx\"", "eulerseq=\"zYw\"", ["line 2", "zYw"]),
    ("<option ", "<option viscosity=\"1\" ", ["line 3", "fluid"]),
    (
        "<option gravity=\"0.7 -0.4 -9.6\"/>",
        "<option><flag frictionloss=\"disable\"/></option>",
        ["line 3", "frictionloss"],
    ),
    ("</mujoco>", "", ["line", "XML"]),
    ("<mujoco", "<mujuco", ["line", "XML"]),
];

#[test]
fn what_cannot_be_meant_is_said_in_one_line_with_its_number() {
    for (from, to, words) in WRONG {
        assert_ne!(ARM.replacen(from, to, 1), ARM, "{from}");
        let said = Chain::from_mjcf(&ARM.replacen(from, to, 1), None).map(|own| own.name);
        let said = said.expect_err(to).to_string();
        let is_said = words.iter().all(|own| said.contains(own));
        assert!(is_said && !said.contains('\n'), "{to}: {said}");
    }
    let says = |tip: &str| Chain::from_mjcf(ARM, Some(tip)).unwrap_err().to_string();
    assert!(says("hand").contains("no body or site `hand`; the last bodies are fore"));
    let urdf = Chain::from_mjcf("<robot name=\"a\"/>", None)
        .unwrap_err()
        .to_string();
    assert!(urdf.contains("say `urdf`"), "{urdf}");
    let mjcf = Chain::from_urdf(ARM, None).unwrap_err().to_string();
    assert!(mjcf.contains("say `mjcf`"), "{mjcf}");
}

/// What hangs beyond the body that is the tip, stands in the world, or is switched off does not concern the arm.
#[test]
fn what_does_not_concern_the_arm_is_passed_over() {
    let hand = "<body name=\"hand\"><joint type=\"ball\"/><geom size=\"1\"/></body><site ";
    let text = ARM.replacen("<site ", hand, 1).replacen(
        "</worldbody>",
        "<body name=\"cup\"><freejoint/><geom size=\"1\"/></body></worldbody><equality><weld body1=\"cup\"/><weld active=\"false\" body1=\"fore\"/></equality>",
        1,
    );
    let arm = Chain::from_mjcf(&text, Some("fore")).unwrap();
    assert_eq!(arm, Chain::from_mjcf(ARM, Some("fore")).unwrap());
    let deep = format!("<mujoco><worldbody>{}", "<body>".repeat(400))
        + &"</body>".repeat(400)
        + "</worldbody></mujoco>";
    assert!(
        Chain::from_mjcf(&deep, None)
            .unwrap_err()
            .to_string()
            .contains("256 bodies")
    );
}

#[test]
fn what_is_written_is_read_again_and_the_rest_stays() {
    let arm = Chain::from_mjcf(ARM, Some("flange")).unwrap();
    let mut own = arm.joints[2].own;
    own.mass *= 1.3;
    let upper = arm.joints[1].own.with(&own);
    let stated = |friction, damping, armature| Stated {
        friction,
        damping,
        armature,
    };
    let changes = Changes {
        links: BTreeMap::from([("fore".to_owned(), own), ("upper".to_owned(), upper)]),
        joints: BTreeMap::from([
            ("turn".to_owned(), stated(0.3, 0.13, 0.017)),
            ("lift".to_owned(), stated(0.07, 0.0, 0.0)),
        ]),
        said: vec!["made by a test -- of rounding".to_owned()],
    };
    let read_again = |text: &str| {
        let again = Chain::from_mjcf(text, Some("flange")).unwrap();
        for (joint, wanted) in [(1, upper), (2, own)] {
            let numbers = again.joints[joint].own.numbers().into_iter();
            let pairs = numbers.zip(wanted.numbers());
            pairs.for_each(|(a, b)| assert!((a - b).abs() < 1e-12, "{a} {b}"));
        }
        again
    };
    let text = changes.in_mjcf(ARM).unwrap();
    let again = read_again(&text);
    let stated = again
        .joints
        .iter()
        .map(|own| [own.friction, own.damping, own.armature]);
    let stated: Vec<[f64; 3]> = stated.collect();
    assert_eq!(
        stated,
        [[0.3, 0.13, 0.017], [0.07, 0.0, 0.0], [0.21, 0.13, 0.017]]
    );
    assert!(
        text.contains(
            "<joint frictionloss=\"0.3\" name=\"turn\" axis=\"0.2 0.9 -0.1\" ref=\"25\"/>"
        ),
        "{text}"
    );
    assert!(text.contains("armature=\"0\"/>"), "{text}");
    // A body without an inertial gets one, and one in a frame stands in the body then.
    let framed = ARM
        .replacen("<inertial pos=\"0.08", "<frame euler=\"0 0 90\"><inertial pos=\"0.08", 1)
        .replacen("0.0002\"/>", "0.0002\"/></frame>", 1)
        .replacen("<inertial pos=\"0.04 -0.02 0.13\" mass=\"1.7\" diaginertia=\"0.011 0.014 0.009\" axisangle=\"1 2 -1 40\"/>", "", 1);
    read_again(&changes.in_mjcf(&framed).unwrap());
    assert_eq!(Changes::default().in_mjcf(ARM).unwrap(), ARM);
}
