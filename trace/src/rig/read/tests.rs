//! This file holds what a rig description may say, and what it is told when it says something else.

use super::*;
use crate::csv::{Decimal, Hints, Separator};
use crate::rig::{Channels, Drive, Parameters};
use proptest::prelude::*;
use rigproof_spec::joint::Joint;

const AXIS: &str = r#"name = "slide"
plant = "axis"
motion = "linear"
[channels]
position = { channel = "x", unit = "mm" }
command = { channel = "u", unit = "V" }
[parameters]
inertia = { value = 1700, unit = "g", status = "uncertain", sd = 30 }
command_gain = { value = 35.5, unit = "N/V" }
[[effect]]
mechanism = "viscous"
coefficient = { value = 120.5, unit = "mN·s/mm", status = "unknown" }
onset = { value = 250, unit = "ms" }
"#;

const BRAKE: &str = r#"name = "brake A"
plant = "bench"
motion = "rotary"
[channels]
time = { channel = "stamp", unit = "ms" }
position = { channel = "angle", unit = "deg" }
torque = { channel = "torque", unit = "mNm" }
current = { channel = "current", unit = "A" }
[brake]
joint = "E"
"#;

fn parse(text: &str) -> Result<Rig, String> {
    Rig::parse(text, Path::new("rig.toml")).map_err(|error| error.to_string())
}

#[test]
fn values_become_si() {
    let rig = parse(AXIS).unwrap();
    let inertia = rig.parameters.unwrap().inertia;
    assert!((inertia.value - 1.7).abs() < 1e-15);
    assert!((inertia.sd.unwrap() - 0.03).abs() < 1e-15);
    let viscous = &rig.effects[0];
    assert!((viscous.parameter("coefficient").unwrap().value - 120.5).abs() < 1e-12);
    assert_eq!(viscous.parameter("level"), None);
    assert!((viscous.onset.unwrap().value - 0.25).abs() < 1e-15);
    assert_eq!(rig.command_gain_dimension().unwrap().to_string(), "N/V");
}

#[test]
fn a_brake_on_a_bench_is_read() {
    let rig = parse(BRAKE).unwrap();
    assert_eq!(
        (rig.plant, rig.motion, rig.brake.clone()),
        (
            Plant::Bench,
            Motion::Rotary,
            Some(Brake::of_thesis(Joint::E))
        )
    );
    assert_eq!(rig.channels.force.as_ref().unwrap().channel, "torque");
    assert_eq!(rig.channels.time.as_ref().unwrap().unit, "ms");
    assert_eq!(parse(&rig.to_toml()).unwrap(), rig);
}

#[test]
fn a_turning_plant_may_leave_out_the_radian_beside_a_mass() {
    let turning = |unit: &str| {
        AXIS.replace("linear", "rotary")
            .replace("\"mm\"", "\"deg\"")
            .replace("\"g\"", &format!("\"{unit}\""))
            .replace("N/V", "N·m/V")
            .replace("mN·s/mm", "N·m·s")
    };
    let rig = parse(&turning("kg·m^2")).unwrap();
    assert!(rig.to_toml().contains("kg·m^2/rad"));
    let message = parse(&turning("kg")).unwrap_err();
    assert!(
        message.contains("`kg` does not convert to `kg·m^2/rad`"),
        "{message}"
    );
    let message = parse(&turning("g").replace("\"deg\"", "\"1\"")).unwrap_err();
    assert!(
        message.contains("`1` does not convert to `rad`"),
        "{message}"
    );
}

const SWEEP: &str = include_str!("../../../../rigs/sweep.toml");

#[test]
fn a_static_sweep_has_rows_in_place_of_a_time() {
    let rig = parse(SWEEP).unwrap();
    assert!(rig.is_sweep());
    assert_eq!(
        (rig.channels.position.as_ref(), rig.parameters),
        (None, None)
    );
    assert_eq!(parse(&rig.to_toml()).unwrap(), rig);
    let desk = tempfile::tempdir().unwrap();
    let file = desk.path().join("sweep.csv");
    let rows = (0..20).map(|k| format!("{},{},{}\n", k % 7, 0.25 * f64::from(k), 3.5));
    std::fs::write(&file, "w,torque,I\n".to_owned() + &rows.collect::<String>()).unwrap();
    let recording = rig.read_recording(&file).unwrap();
    assert_eq!(recording.time_s[..3], [0.0, 1.0, 2.0]);
    assert_eq!(recording.speed.unwrap().samples[8], 1.0);
    assert_eq!(recording.position.samples, [0.0; 20]);
}

/// A sound description, a text in it, what replaces it, and a part of the message.
#[rustfmt::skip]
const FAULTS: &[(&str, &str, &str, &str)] = &[
    (AXIS, "= \"axis", "= axis", "rig.toml, line 2, column 9: the text is no TOML"),
    (AXIS, "plant = \"axis\"\n", "", "line 1, column 1: `plant` is missing in the file; add it"),
    (AXIS, "\"axis\"", "\"axes\"", "line 2, column 9: `axes` is no plant; did you mean `axis`?"),
    (AXIS, "\"axis\"", "\"robot\"", "`robot` is no plant; the words are `axis`, `bench`, `rig`, `chain`"),
    (AXIS, "\"axis\"", "\"chain\"", "`chain` is no plant of one joint; give `axis` or `bench` here"),
    (AXIS, "motion", "motoin", "line 3, column 1: `motoin` is no key of the file; did you mean `motion`?"),
    (AXIS, "channel = \"x\"", "chanel = \"x\"", "line 5, column 14: `chanel` is no key of `position`"),
    (AXIS, "command =", "force =", "line 6, column 1: `force` is no key of `channels`; the keys are"),
    (AXIS, "command = { channel = \"u\", unit = \"V\" }", "", "`command` is missing in `channels`"),
    (AXIS, "\"mm\"", "\"deg\"", "line 5, column 36: `deg` does not convert to `m`"),
    (AXIS, "\"mm\"", "\"furlong\"", "`furlong` is no known unit; give `m`"),
    (AXIS, "\"mm\"", "\"mm\", sign = 2", "`sign` is 2; it must be 1 or -1"),
    (AXIS, "\"mm\"", "\"mm\", scale = 0", "`scale` is 0"),
    (AXIS, "\"mm\"", "\"mm\", quantum = -1", "`quantum` is -1; it must be above 0"),
    (AXIS, "\"mm\"", "\"mm\", offset = inf", "`offset` is inf; give a finite number"),
    (AXIS, "1700,", "\"1700\",", "`value` is of type string; give a number"),
    (AXIS, "1700,", "-1700,", "`inertia` is -1.7 kg; it must be above 0"),
    (AXIS, "35.5", "0", "the command gain is 0"),
    (AXIS, "N/V", "N", "line 9, column 39: `N` does not convert to `N/V`"),
    (AXIS, ", sd = 30", "", "the status is uncertain; a standard deviation `sd`"),
    (AXIS, "sd = 30", "sd = 30, low95 = 1", "the 95 % interval needs"),
    (AXIS, "inertia =", "inertia = 4\ninert =", "`inert` is no key of `parameters`"),
    (AXIS, "\"viscous\"", "\"viscuos\"", "line 11, column 13: `viscuos` cannot be used; did you mean `viscous`?"),
    (AXIS, "\"viscous\"", "\"Damping\"", "`Damping` cannot be used; here it is called `viscous`"),
    (AXIS, "\"viscous\"", "\"coulomb\"", "here it is called `dry_offset`"),
    (AXIS, "\"viscous\"", "\"stiction\"", "here it is called `stribeck`"),
    (AXIS, "\"viscous\"", "\"deadband\"", "here it is called `backlash`"),
    (AXIS, "\"viscous\"", "\"friction\"", "did you mean `dry_offset` (Coulomb friction), or `viscous` (viscous friction), or"),
    (AXIS, "coefficient", "coeficient", "line 12, column 1: `coeficient` is no key of `[[effect]]`; did you mean `coefficient`?"),
    (AXIS, "coefficient", "# coefficient", "line 10, column 1: `coefficient` is missing in `[[effect]]`"),
    (AXIS, "\"ms\"", "\"mm\"", "`mm` does not convert to `s`"),
    (SWEEP, "speed =", "position =", "line 12, column 1: `position` is no key of `channels`; the keys are `speed`"),
    (SWEEP, "speed =", "enabled =", "`enabled` is no key of `channels`"),
    (SWEEP, "torque =", "# torque =", "`force` is missing in `channels`"),
    (SWEEP, "[characteristic]", "[brake]", "`characteristic` is missing in the file"),
    (SWEEP, "\"bench\"", "\"axis\"", "an axis has no static sweep"),
    (SWEEP, "\"static\"", "\"statik\"", "`statik` is no drive; did you mean `static`?"),
    (BRAKE, "\"E\"", "\"D\"", "`D` is no joint; the words are `A`, `E`, `B`, `C`"),
    (BRAKE, "current =", "# current =", "a brake belongs to a bench with rotary motion and a `current` channel"),
    (BRAKE, "current =", "force =", "`force` and `torque` are the same role"),
    (BRAKE, "[brake]", "[parameters]", "`joint` is no key of `parameters`; there are no keys"),
    (BRAKE, "\"ms\"", "\"A\"", "`A` does not convert to `s`"),
];

#[test]
fn every_fault_has_its_place_and_its_remedy() {
    for (text, from, to, expected) in FAULTS {
        let changed = text.replacen(from, to, 1);
        assert_ne!(changed, *text, "{from}");
        let message = parse(&changed).unwrap_err();
        assert!(message.contains(expected), "{message} lacks {expected}");
        let one_line = message.starts_with("rig.toml, line ") && !message.contains('\n');
        assert!(one_line, "{message}");
    }
}

#[test]
fn all_that_is_to_be_filled_in_is_said_at_once() {
    let begun = AXIS
        .replacen("1700,", "\"fill in\",", 1)
        .replacen("\"u\"", "\"fill in\"", 1)
        .replacen("\"N/V\"", "\"fill in\"", 1);
    let message = parse(&begun).unwrap_err();
    let expected = "line 6, column 23: `channel` of `command` is still to be filled in; give text in quotes; so are `parameters.inertia.value` in line 8, `parameters.command_gain.unit` in line 9";
    assert!(message.contains(expected), "{message}");
    let one = parse(&AXIS.replacen("1700,", "\"fill in\",", 1)).unwrap_err();
    assert!(one.ends_with("give a number"), "{one}");
}

fn number() -> impl Strategy<Value = f64> {
    prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO
}

prop_compose! {
    fn any_value(above_zero: bool)(
        value in number(), sd in number(), ends in (number(), number()), status in 0..3_usize, interval: bool,
    ) -> Value {
        let value = if above_zero { value.abs() + f64::MIN_POSITIVE } else { value };
        let (low, high) = (ends.0.min(ends.1), ends.0.max(ends.1));
        Value {
            value,
            status: [Status::Known, Status::Uncertain, Status::Unknown][status],
            sd: (status == 1).then(|| sd.abs() + f64::MIN_POSITIVE),
            low95: interval.then_some(low),
            high95: interval.then_some(high),
        }
    }
}

prop_compose! {
    fn any_channel(unit: &'static str)(
        channel in ".*", offset in number(), scale in number(), sign: bool,
        magnitudes in prop::array::uniform3(prop::option::of(1e-300..1e300_f64)),
        stated: bool,
    ) -> ChannelMap {
        let [quantum, noise, limit] = magnitudes;
        let (scale, sign) = (if scale == 0.0 { 1.5 } else { scale }, if sign { 1.0 } else { -1.0 });
        ChannelMap { channel, unit: unit.into(), column_unit: stated.then(|| unit.into()), offset, scale, sign, quantum, noise, limit }
    }
}

fn any_effect() -> impl Strategy<Value = RigEffect> {
    let computed: Vec<Mechanism> = Mechanism::ALL
        .into_iter()
        .filter(|m| !m.parameters().is_empty())
        .collect();
    let values = prop::collection::vec(any_value(true), 10);
    (
        prop::sample::select(computed),
        values,
        prop::option::of(any_value(false)),
        any::<bool>(),
    )
        .prop_map(|(mechanism, values, onset, whole)| {
            let parameters = mechanism.parameters().iter();
            let given = parameters.filter(|parameter| whole || !parameter.is_optional);
            let values = given
                .zip(values)
                .map(|(parameter, value)| match parameter.range {
                    Range::Part => Value::known(1.0 / (1.0 + value.value)),
                    _ => value,
                });
            RigEffect {
                mechanism,
                values: values.collect(),
                onset,
                of_torque: false,
            }
        })
}

prop_compose! {
    fn any_text()(
        separator in prop::option::of(prop::sample::select(Separator::ALL.to_vec())),
        decimal in prop::option::of(prop::sample::select(Decimal::ALL.to_vec())),
        header_lines in prop::option::of(1_usize..90),
    ) -> Hints {
        Hints { separator, decimal, header_lines }
    }
}

prop_compose! {
    fn any_axis()(
        drive in prop::sample::select(&[Drive::Held, Drive::Straight, Drive::Periodic][..]),
        (start_samples, substeps, warm_up_periods) in (0..1000_usize, 1..100_usize, 0..10_usize),
        words in prop::array::uniform2(".*"),
        rotary: bool,
        position in any_channel("m"),
        command in any_channel("V"),
        inertia in any_value(true),
        command_gain in any_value(true),
        effects in prop::collection::vec(any_effect(), 0..4),
        provenance in prop::collection::btree_map(".*", ".*", 0..3),
        text in any_text(),
    ) -> Rig {
        let [name, source] = words;
        let motion = if rotary { Motion::Rotary } else { Motion::Linear };
        let unit = if rotary { "deg" } else { "mm" }.to_string();
        Rig {
            name, motion, effects, provenance,
            source: Some(source),
            plant: Plant::Axis,
            channels: Channels {
                time: None,
                position: Some(ChannelMap { column_unit: position.column_unit.as_ref().map(|_| unit.clone()), unit, ..position }),
                speed: None,
                command: Some(command),
                enabled: None,
                force: None,
                current: None,
                simulated: None,
            },
            protocol: Protocol { drive, start_samples, substeps, warm_up_periods },
            parameters: Some(Parameters { inertia, command_gain }),
            brake: None,
            characteristic: None,
            servo: None,
            recordings: Vec::new(),
            text,
        }
    }
}

proptest! {
    #[test]
    fn a_description_reads_back_bit_for_bit(rig in any_axis()) {
        let text = rig.to_toml();
        let back = parse(&text).unwrap();
        prop_assert_eq!(back.to_toml(), text);
        prop_assert_eq!(back, rig);
    }
}
