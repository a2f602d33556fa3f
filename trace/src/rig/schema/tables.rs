//! This file says what may stand in the tables that plants share.

use rigproof_spec::effect::{Mechanism, Motion, Range};
use rigproof_spec::joint::Joint;
use serde_json::{Map, Value, json};

use super::shape::{above_zero, defined, list, number, object, one_of, text, whole};
use crate::csv::{Decimal, Separator};
use crate::rig::protocol::Drive;

/// What a channel means.
pub fn channel() -> Value {
    let keys = vec![
        ("channel", text("The name of the column in the recording.")),
        (
            "unit",
            text(
                "The unit of the column and of the numbers here, such as `rad`, `deg`, `mm`, `N·m`.",
            ),
        ),
        (
            "column_unit",
            text("The unit that the column is in, whatever its header says."),
        ),
        ("offset", number("What is subtracted, in `unit`.")),
        (
            "scale",
            json!({ "type": "number", "not": { "const": 0 }, "description": "Factor after the offset is gone." }),
        ),
        (
            "sign",
            json!({ "enum": [1, -1], "description": "-1 for a channel that counts the other way." }),
        ),
        (
            "quantum",
            above_zero("The smallest step that the channel can show, in `unit`."),
        ),
        (
            "noise",
            above_zero("Standard deviation of a sample, in `unit`."),
        ),
        (
            "limit",
            above_zero("Magnitude at which the channel saturates, in `unit`."),
        ),
    ];
    object(
        Some("What a channel of a recording means: sign × scale × (recorded − offset)."),
        keys,
        &["channel", "unit"],
    )
}

/// A number with its unit.
pub fn value() -> Value {
    let keys = vec![
        ("value", number("The number, in `unit`.")),
        (
            "unit",
            text("Its unit; a unit with mass in it may leave out the radian."),
        ),
        (
            "status",
            one_of(
                "`known`: a fit leaves it alone. `uncertain`: known up to `sd`. `unknown`: a start for the fit.",
                ["known", "uncertain", "unknown"],
            ),
        ),
        (
            "sd",
            above_zero("Standard deviation, with the status `uncertain`, in `unit`."),
        ),
        (
            "low95",
            number("Lower end of the 95 % interval, in `unit`."),
        ),
        (
            "high95",
            number("Upper end of the 95 % interval, in `unit`."),
        ),
    ];
    let mut whole = object(
        Some("A number with its unit and how well it is known."),
        keys,
        &["value", "unit"],
    );
    whole["dependentRequired"] = json!({ "low95": ["high95"], "high95": ["low95"] });
    whole["if"] =
        json!({ "properties": { "status": { "const": "uncertain" } }, "required": ["status"] });
    whole["then"] = json!({ "required": ["sd"] });
    whole["else"] = json!({ "properties": { "sd": false } });
    whole
}

/// Where an effect may act, by plant.
const PLACES: [&str; 3] = ["joint", "axis", "of"];

/// Physics that a model has, a case a mechanism; the plant says where it may act.
pub fn effect() -> Value {
    let computed = Mechanism::ALL.into_iter();
    let computed = computed.filter(|mechanism| !mechanism.parameters().is_empty());
    let cases: Vec<Value> = computed
        .map(|mechanism| {
            let mut keys = vec![
                ("mechanism", json!({ "const": mechanism.name() })),
                ("onset", defined("value")),
            ];
            keys.extend(PLACES.map(|place| (place, json!(true))));
            let mut needed = vec!["mechanism"];
            for parameter in mechanism.parameters() {
                let [rotary, linear] = [Motion::Rotary, Motion::Linear]
                    .map(|motion| parameter.quantity.dimension(motion));
                let unit = match rotary == linear {
                    true => format!("In `{rotary}`."),
                    false => format!("In `{rotary}`, or `{linear}` of a linear motion."),
                };
                let share = parameter.quantity.dimension_of_share(Motion::Rotary);
                let unit = match share == rotary {
                    true => unit,
                    false => format!("{unit} A share of a torque in `{share}`."),
                };
                let mut what = defined("value");
                what["description"] = json!(unit);
                match parameter.range {
                    Range::Any | Range::Sign => {}
                    Range::AboveZero => {
                        what["properties"] = json!({ "value": { "exclusiveMinimum": 0 } })
                    }
                    Range::NotBelowZero => {
                        what["properties"] = json!({ "value": { "minimum": 0 } })
                    }
                    Range::Part => {
                        what["properties"] = json!({ "value": { "minimum": 0, "maximum": 1 } })
                    }
                }
                keys.push((parameter.name, what));
                if !parameter.is_optional {
                    needed.push(parameter.name);
                }
            }
            object(None, keys, &needed)
        })
        .collect();
    json!({ "oneOf": cases })
}

/// The list of effects of a plant: which of the places it has, and which it needs.
pub fn effects(about: &str, places: &[(&str, Value)], required: &[&str]) -> Value {
    let mut own = defined("effect");
    let of = |place: &str| places.iter().find(|(name, _)| *name == place);
    let all = PLACES.map(|place| {
        (
            place.to_owned(),
            of(place).map_or(json!(false), |(_, what)| what.clone()),
        )
    });
    own["properties"] = json!(Map::from_iter(all));
    own["required"] = json!(required);
    list(about, own)
}

/// The brake of a turning bench.
pub fn brake() -> Value {
    let values = |names: &[&'static str]| -> Vec<(&str, Value)> {
        names.iter().map(|name| (*name, defined("value"))).collect()
    };
    let measured = |mut keys: Vec<(&'static str, Value)>| {
        keys.push((
            "r_squared",
            number("How much of the scatter the fit explains."),
        ));
        keys
    };
    let gain = ["k_1", "k_2", "k_3", "k_4", "k_5", "greatest_current"];
    let surface = ["average", "least_speed", "greatest_speed", "least_current"];
    let coefficients = ["a_1", "a_2", "a_3", "a_4", "a_5", "a_6"];
    let every = |names: &[&str]| -> Map<String, Value> {
        names
            .iter()
            .map(|own| ((*own).to_owned(), json!(names)))
            .collect()
    };
    let mut edge = object(
        Some("Time constants at one edge of the current."),
        measured(values(&[&surface[..], &coefficients].concat())),
        &surface,
    );
    edge["dependentRequired"] = json!(every(&coefficients));
    let keys = vec![
        (
            "joint",
            one_of(
                "The brake of the thesis whose table stands in for what is left out.",
                Joint::ALL.map(Joint::letter),
            ),
        ),
        ("backlash_width", defined("value")),
        (
            "torque_gain",
            object(Some("Torque by current."), measured(values(&gain)), &gain),
        ),
        ("rising", edge.clone()),
        ("falling", edge),
    ];
    let mut whole = object(Some("The brake of a turning bench."), keys, &[]);
    whole["if"] = json!({ "not": { "required": ["joint"] } });
    whole["then"] = json!({ "required": ["backlash_width", "torque_gain", "rising", "falling"] });
    whole
}

/// The static characteristic of a brake or damper.
pub fn characteristic() -> Value {
    let numbers = |about: &str| {
        let points = list(about, json!({ "type": "number" }));
        object(
            None,
            vec![("points", points), ("unit", text("Their unit."))],
            &["points", "unit"],
        )
    };
    let keys = vec![
        ("command", numbers("Commands that grow, at least 2.")),
        (
            "effort",
            numbers("The effort at which the brake settles under each of them."),
        ),
        ("rising", defined("value")),
        ("falling", defined("value")),
    ];
    object(
        Some(
            "A brake or damper of any kind: its effort over its command, straight between the points, and the time constants with which it follows.",
        ),
        keys,
        &["command", "effort"],
    )
}

/// The channels of a plant.
pub fn channels(about: &str, roles: &[&'static str], required: &[&str]) -> Value {
    let time = object(
        Some("The time, where the header does not say it."),
        vec![
            ("channel", text("The name of the column.")),
            ("unit", text("`s`, `ms`, …")),
        ],
        &["channel"],
    );
    let mut keys = vec![("time", time)];
    keys.extend(roles.iter().map(|role| (*role, defined("channel"))));
    object(Some(about), keys, required)
}

/// What every description may have.
pub fn common(plant: &str) -> Vec<(&'static str, Value)> {
    let reading = vec![
        (
            "separator",
            one_of(
                "What stands between two cells.",
                Separator::ALL.map(Separator::name),
            ),
        ),
        (
            "decimal",
            one_of(
                "What stands before the fraction of a number.",
                Decimal::ALL.map(Decimal::name),
            ),
        ),
        (
            "header_lines",
            whole("Lines before the line with the names.", 0, 1_000_000),
        ),
    ];
    vec![
        ("name", text("What people call the rig.")),
        ("plant", json!({ "const": plant })),
        ("source", text("Where its recordings come from.")),
        (
            "text",
            object(
                Some("How recordings are written down, where that cannot be seen in them."),
                reading,
                &[],
            ),
        ),
        (
            "provenance",
            json!({ "type": "object", "additionalProperties": { "type": "string" }, "description": "Where a calibration came from." }),
        ),
    ]
}

/// How free runs are made.
pub fn protocol() -> Value {
    let keys = vec![
        (
            "drive",
            one_of(
                "What the drive does between two samples of its command.",
                Drive::ALL.map(Drive::name),
            ),
        ),
        (
            "start_samples",
            whole(
                "Samples that give the start state; 0 starts at rest.",
                0,
                1000,
            ),
        ),
        ("substeps", whole("Integration steps a sample.", 1, 100)),
        (
            "warm_up_periods",
            whole(
                "Repetitions of a periodic recording before the one that counts.",
                0,
                10,
            ),
        ),
    ];
    object(Some("How free runs are made."), keys, &[])
}
