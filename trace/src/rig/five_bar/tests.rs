//! This file claims how the description of a five-bar reads, applies, writes and refuses.

use super::*;
use crate::series::Channel;

const RIG: &str = r#"
name = "bench of two"
plant = "rig"
layout = "three_brake"
[channels]
theta_a = { channel = "qa", unit = "rad", scale = 6.25e-5, quantum = 1, offset = -3 }
theta_b = { channel = "qb", unit = "deg", sign = -1, quantum = 0.0036 }
force_x = { channel = "fx", unit = "N", noise = 0.043 }
force_y = { channel = "fy", unit = "mN", noise = 51 }
current_a = { channel = "ia", unit = "A" }
current_e = { channel = "ie", unit = "mA" }
current_b = { channel = "ib", unit = "A" }
[[effect]]
mechanism = "viscous"
joint = "E"
coefficient = { value = 0.071, unit = "N·m·s/rad", low95 = 0.06, high95 = 0.08 }
onset = { value = 7.3, unit = "s" }
[[effect]]
mechanism = "constant_bias"
level = { value = 0.31, unit = "N·m" }
[protocol]
drive = "held"
[provenance]
recording = "a morning"
"#;

fn parse(text: &str) -> Result<FiveBar, String> {
    FiveBar::parse(text, Path::new("own.toml")).map_err(|error| error.to_string())
}

#[test]
fn a_description_reads_back_from_what_it_writes() {
    let read = parse(RIG).unwrap();
    assert_eq!(read.layout, Layout::ThreeBrake);
    assert_eq!(read.effects[0].joint, Some(Joint::E));
    assert_eq!(read.effects[1].joint, None);
    assert_eq!(read.channels.currents[3], None);
    assert_eq!(parse(&read.to_toml()).unwrap(), read);
    assert!(FiveBar::describes(RIG, Path::new("own.toml")).unwrap());
    let axis = RIG.replace("\"rig\"", "\"axis\"");
    assert!(!FiveBar::describes(&axis, Path::new("own.toml")).unwrap());
}

#[test]
fn counts_and_degrees_become_radians() {
    let channel = |name: &str, value| Channel {
        name: name.to_owned(),
        unit: String::new(),
        samples: vec![value, f64::NAN],
    };
    let trace = Trace {
        time_s: vec![0.1, 0.3],
        channels: vec![
            channel("ib", 0.7),
            channel("qa", 16_001.0),
            channel("qb", -31.7),
            channel("fx", 2.3),
            channel("fy", 417.0),
            channel("ia", 0.19),
            channel("ie", 530.0),
        ],
    };
    let recording = parse(RIG)
        .unwrap()
        .apply(&trace, Path::new("run.csv"))
        .unwrap();
    let near = |signal: &Signal, value: f64| (signal.samples[0] - value).abs() < 1e-12;
    let [theta_a, theta_b] = &recording.theta;
    assert!(near(theta_a, 16_004.0 * 6.25e-5) && theta_a.samples[1].is_nan());
    assert_eq!(theta_a.quantum, Some(6.25e-5));
    assert!(near(theta_b, 0.553_269_372_882_202_4));
    assert!(near(&recording.force[1], 0.417));
    assert!((recording.force[1].noise.unwrap() - 0.051).abs() < 1e-15);
    assert!(near(recording.currents[1].as_ref().unwrap(), 0.53));
    assert_eq!(recording.currents[3], None);
}

#[test]
fn what_is_wrong_is_named_with_its_place() {
    for (from, to, words) in [
        ("layout =", "lay =", "`lay` is no key of the file"),
        ("\"three_brake\"", "\"five\"", "`five` is no layout"),
        (
            "\"three_brake\"",
            "\"four_brake\"",
            "`current_c` is missing",
        ),
        (
            "current_b =",
            "current_c =",
            "`current_c` is no key of `channels`",
        ),
        ("\"deg\"", "\"mm\"", "`mm` does not convert to `rad`"),
        ("\"E\"", "\"D\"", "`D` is no joint"),
        ("\"rig\"", "\"axis\"", "`axis` is no plant"),
    ] {
        let message = parse(&RIG.replacen(from, to, 1)).unwrap_err();
        assert!(
            message.starts_with("own.toml, line") && message.contains(words),
            "{message}"
        );
    }
    let without = parse(RIG).unwrap().apply(
        &Trace {
            time_s: Vec::new(),
            channels: Vec::new(),
        },
        Path::new("run.csv"),
    );
    let message = without.unwrap_err().to_string();
    assert!(
        message.contains("`qa` of the rig `bench of two` is missing"),
        "{message}"
    );
}

#[test]
fn a_share_of_a_torque_is_a_number() {
    let share = "[[effect]]\nmechanism = \"stribeck\"\njoint = \"E\"\nof = \"torque\"\n\
                 peak = { value = 0.17, unit = \"1\" }\nspeed = { value = 0.31, unit = \"rad/s\" }\n\
                 exponent = { value = 2.0, unit = \"1\" }\n";
    let text = format!("{RIG}\n{share}");
    let read = parse(&text).unwrap();
    let written = read.to_toml();
    assert!(
        written.contains("peak = { value = 0.17, unit = \"1\""),
        "{written}"
    );
    assert_eq!(parse(&written), Ok(read));
    let message = parse(&text.replace("0.17, unit = \"1\"", "0.17, unit = \"N·m\"")).unwrap_err();
    assert!(message.contains("`N·m` does not convert to"), "{message}");
}
