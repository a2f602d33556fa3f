//! This file holds what `rigproof identify brake` makes of bench recordings, good and bad.

use std::fmt::Write;

use crate::desk::Desk;

pub const RIG: &str = r#"name = "bench"
plant = "bench"
motion = "rotary"
[channels]
position = { channel = "angle", unit = "deg" }
torque = { channel = "torque", unit = "Nm" }
current = { channel = "current", unit = "A" }
"#;

/// Settled torque of a made-up brake: 0.23 + 4.1·I below 0.2 A, −1.9·I² + 7.7·I − 0.41 from there.
fn torque(i: f64) -> f64 {
    if i < 0.2 {
        0.23 + 4.1 * i
    } else {
        -1.9 * i * i + 7.7 * i - 0.41
    }
}

/// Steps to each current and back at one speed; rises take 9 ms (20 ms below 4 rpm), falls 6 ms (8 ms below 2 rpm).
pub fn steps(rpm: f64) -> String {
    let mut text = String::from("time (s),angle (deg),torque (Nm),current (A)\n");
    let mut sample = 0_u32;
    let mut from = torque(0.0);
    let rise = if rpm < 4.0 { 0.020 } else { 0.009 };
    let fall = if rpm < 2.0 { 0.008 } else { 0.006 };
    for (turn, i) in [0.1, 0.3, 0.5, 0.7, 0.9]
        .into_iter()
        .flat_map(|i| [0.0, i, 0.0, i])
        .enumerate()
    {
        // A reproducible scatter of up to 3 %.
        let wobble = 1.0 + 0.03 * libm::sin(7.3 * turn as f64 + rpm);
        let to = if i > 0.0 {
            torque(i) * wobble
        } else {
            torque(0.0)
        };
        let a = if i > 0.0 { rise } else { fall } * wobble;
        for k in 1..=250 {
            let elapsed = 0.001 * f64::from(k) - 0.0004;
            let now = to + (from - to) * libm::exp(-elapsed / a);
            sample += 1;
            let time = 0.001 * f64::from(sample);
            writeln!(text, "{time:.3},{:.6},{now:.6},{i}", 6.0 * rpm * time).unwrap();
        }
        from = to;
    }
    text
}

/// Reversals at 0.7 A: a backlash of 1.3° and a lag of 6 ms.
fn reversals() -> String {
    let mut text = String::from("time (s),angle (deg),torque (Nm),current (A)\n");
    let (mut left, mut held): (f64, f64) = (-0.65, torque(0.0));
    for step in 0..120_000 {
        let phase = 2.0 * core::f64::consts::PI * 5e-5 * f64::from(step);
        let angle: f64 = -11.3 * libm::cos(phase);
        left = left.max(angle - 1.3).min(angle);
        let free = angle > left + 1e-12 && angle < left + 1.3 - 1e-12;
        let to = torque(if free { 0.0 } else { 0.7 });
        held = to + (held - to) * libm::exp(-5e-5 / 0.006);
        if step % 20 == 0 {
            let signed = held * libm::sin(phase).signum();
            writeln!(
                text,
                "{:.3},{angle:.6},{signed:.6},0.7",
                5e-5 * f64::from(step)
            )
            .unwrap();
        }
    }
    text
}

fn desk() -> Desk {
    let desk = Desk::new();
    desk.put("bench.toml", RIG);
    for rpm in [0.5, 1.0, 1.7, 2.5, 6.0, 20.0] {
        desk.put(&format!("s{rpm}.csv"), &steps(rpm));
    }
    desk.put("turn.csv", &reversals());
    desk
}

const ALL: &str =
    "identify brake s0.5.csv s1.csv s1.7.csv s2.5.csv s6.csv s20.csv turn.csv --rig bench.toml";

#[test]
fn recordings_become_a_brake_in_the_rig_file_that_the_program_takes() {
    let desk = desk();
    let printed = desk.prints(ALL, 0);
    assert!(printed.starts_with("90 steps"), "{printed}");
    let rig = rigproof_trace::rig::Rig::read(&desk.path("bench-brake.toml")).unwrap();
    let brake = rig.brake.clone().unwrap();
    let gain = brake.torque_gain.as_ref().unwrap();
    for (k, truth) in gain.k.iter().zip([4.1, 0.23, -1.9, 7.7, -0.41]) {
        let (low, high) = (k.low95.unwrap(), k.high95.unwrap());
        assert!(low - 1e-3 <= truth && truth <= high + 1e-3, "{k:?} {truth}");
    }
    let rising = brake.rising.as_ref().unwrap();
    assert!(
        (rising.average.value - 0.009).abs() < 0.0002,
        "{:?}",
        rising.average
    );
    let width_deg = brake.table().backlash_width_deg;
    assert!((width_deg - 1.3).abs() < 0.01, "{width_deg}");
    assert!(rig.provenance["brake"].contains("turn.csv"));
    // The command that it advises runs.
    let next = printed.lines().last().unwrap().trim();
    let answer = desk.rigproof(next.strip_prefix("rigproof ").unwrap());
    assert!(
        answer.status.code() < Some(2),
        "{}",
        String::from_utf8_lossy(&answer.stderr)
    );
}

#[test]
fn what_is_missing_of_an_mcap_recording_is_said() {
    let desk = desk();
    desk.prints("convert s6.csv s6.mcap", 0);
    let mut bytes = std::fs::read(desk.path("s6.mcap")).unwrap();
    bytes.truncate(bytes.len() - 5);
    std::fs::write(desk.path("s6.mcap"), bytes).unwrap();
    let printed = desk.prints("identify brake s6.mcap s20.csv --rig bench.toml", 1);
    for expected in [
        "s6.mcap: check sums: chunks verified",
        "s6.mcap: the file's last bytes are not those of MCAP",
        "s20.csv read as:",
    ] {
        assert!(printed.contains(expected), "{printed}");
    }
    let result = desk.json("identify brake s6.mcap s20.csv --rig bench.toml --json", 1);
    assert!(result["read_as"][0].is_array() && result["read_as"][1].is_object());
}

#[test]
fn what_is_not_in_the_recordings_is_said_and_no_half_table_is_written() {
    let desk = desk();
    let result = desk.json("identify brake s6.csv s20.csv --rig bench.toml --json", 1);
    assert_eq!(result["missing"].as_array().unwrap().len(), 3, "{result}");
    assert!(
        result["refused"]
            .as_str()
            .unwrap()
            .contains("no `backlash_width`"),
        "{result}"
    );
    assert!(result["torque_gain"]["k"][3]["value"].as_f64().unwrap() > 7.0);
    assert!(!desk.path("bench-brake.toml").exists());
    // A joint of the thesis stands in for the rest.
    desk.put("joint.toml", &format!("{RIG}[brake]\njoint = \"E\"\n"));
    desk.prints(
        "identify brake s6.csv s20.csv --rig joint.toml --out own.toml",
        1,
    );
    let rig = rigproof_trace::rig::Rig::read(&desk.path("own.toml")).unwrap();
    assert!((rig.brake.unwrap().table().backlash_width_deg - 1.7).abs() < 1e-12);
}

#[test]
fn recordings_that_tell_nothing_of_a_brake_are_refused_in_one_line() {
    let desk = desk();
    let still = "time (s),angle (deg),torque (Nm),current (A)\n".to_owned()
        + &(0..400)
            .map(|k| {
                format!(
                    "{:.3},{:.3},1.3,0.4\n",
                    0.001 * f64::from(k),
                    0.03 * f64::from(k)
                )
            })
            .collect::<String>();
    desk.put("still.csv", &still);
    desk.put(
        "short.csv",
        &steps(6.0).lines().take(50).collect::<Vec<_>>().join("\n"),
    );
    desk.put("signed.toml", &RIG.replace("\"Nm\"", "\"Nm\", sign = -1"));
    desk.put("deaf.toml", &RIG.replace("current =", "# current ="));
    for (line, expected) in [
        (
            "still.csv --rig bench.toml",
            "no recording holds a step of current",
        ),
        (
            "short.csv --rig bench.toml",
            "49 samples have position, torque and current, at least 100",
        ),
        (
            "s6.csv --rig signed.toml",
            "the torque drives the shaft in 100 % of the moving samples",
        ),
        ("s6.csv --rig deaf.toml", "the rig has no `current` channel"),
        ("gone.csv --rig bench.toml", "cannot read gone.csv"),
    ] {
        let answer = desk.rigproof(&format!("identify brake {line}"));
        let message = String::from_utf8(answer.stderr).unwrap();
        assert_eq!(answer.status.code(), Some(3), "{line}: {message}");
        assert!(
            message.starts_with("error: ") && message.lines().count() == 1,
            "{message}"
        );
        assert!(message.contains(expected), "{message} lacks {expected}");
    }
    assert!(!desk.path("bench-brake.toml").exists());
}
