//! This file says what may stand in `certify.toml` as a JSON Schema, for editors that complete and check while somebody writes.
//!
//! A test holds it to the reader: both know the same keys and need the same ones (`cli/tests/verbs/schema.rs`).
#![expect(
    clippy::indexing_slicing,
    reason = "a member of a JSON object that was made here is set"
)]

use rigproof_spec::joint::Joint;
use rigproof_spec::tables::GREATEST_CURRENT_A;
use rigproof_trace::rig::schema::shape::{defined, list, number, object, one_of, text, whole};
use serde_json::{Value, json};

use super::{GREATEST_LIMIT, KINDS, LAYOUTS, MOST_EVERY, NAMED, range};
use crate::law::Law;
use crate::metrics::Metric;
use crate::way::MOST_PIECES;

/// The first line of a description that is written: where an editor finds what may stand in it, beside the file.
pub const SCHEMA_LINE: &str = "#:schema certify.schema.json";

/// A number inside a range.
fn within(about: &str, [least, most]: [f64; 2]) -> Value {
    json!({ "type": "number", "minimum": least, "maximum": most, "description": about })
}

fn flag(about: &str) -> Value {
    json!({ "type": "boolean", "description": about })
}

fn side() -> (&'static str, Value) {
    let about = "It acts on this side of the path only (§7.3).";
    ("obstacle", one_of(about, ["left", "right"]))
}

/// What a parameter of a law is.
fn parameter(key: &str) -> Value {
    let about = match key {
        "boundary_m" => {
            "Distance from the path at which the velocity field is blended (§6.1.1), m."
        }
        "gap_m" => "Distance from the path within which nothing brakes, m; at most `boundary_m`.",
        "gain_n_s_per_m" => "Force for a speed off the field, N·s/m.",
        "gain_nm_s_per_rad" => "Torque for a speed of a joint off the field, N·m·s/rad.",
        "weight_angle" => "What an angle between speed and field costs.",
        "weight_energy" => "What energy taken costs.",
        "horizon_s" => "How far ahead it looks, s.",
        "stiffness_n_per_m" => "Stiffness towards the path, N/m.",
        "damping_across_n_s_per_m" => "Damping across the path, N·s/m.",
        _ => "Damping along the path, N·s/m.",
    };
    within(about, range(key))
}

/// A law of the rig: by its name, or by its kind with its parameters.
fn law(about: &str) -> Value {
    let names = NAMED.map(|(name, _)| name);
    let named = vec![("named", one_of("A row of table 6.1.", names)), side()];
    let mut cases = vec![object(None, named, &["named"])];
    for (kind, parameters) in KINDS {
        let mut keys = vec![("kind", json!({ "const": kind })), side()];
        keys.extend(parameters.iter().map(|key| (*key, parameter(key))));
        let mut needed = vec!["kind"];
        needed.extend(parameters.iter().filter(|key| **key != "boundary_m"));
        cases.push(object(None, keys, &needed));
    }
    json!({ "description": about, "oneOf": cases })
}

/// What a controller that is brought promises.
fn declares() -> Value {
    let keys = vec![
        (
            "most_brakes",
            whole("Brakes with current at once when it does not lock.", 0, 4),
        ),
        (
            "locks",
            flag(
                "It gives every brake its greatest current where §6.2 and §6.3 lock; needs `boundary_m`.",
            ),
        ),
        ("boundary_m", parameter("boundary_m")),
        (
            "gap_m",
            within(
                "Distance from the path within which nothing brakes, m.",
                range("gap_m"),
            ),
        ),
        (
            "choice",
            one_of(
                "By which rule one brake is chosen; needs `boundary_m`.",
                ["influence", "quarter_turn"],
            ),
        ),
        (
            "within_force",
            flag("It keeps to the greatest force at the tip (§6.1.2)."),
        ),
        side(),
    ];
    let mut whole = object(
        Some(
            "What a controller promises that is named on the command line; what is not promised is not looked at.",
        ),
        keys,
        &[],
    );
    let locks = json!({ "properties": { "locks": { "const": true } }, "required": ["locks"] });
    whole["if"] = json!({ "anyOf": [locks, { "required": ["choice"] }] });
    whole["then"] = json!({ "required": ["boundary_m"] });
    whole
}

/// A table with a number for some of the metrics.
fn metrics(about: &str) -> Value {
    let keys = Metric::ALL.map(|metric| {
        let about = format!("{}, {}.", metric.words(), metric.unit());
        (metric.key(), within(&about, [0.0, GREATEST_LIMIT]))
    });
    object(Some(about), keys.to_vec(), &[])
}

/// The path of recordings that are replayed.
fn path() -> Value {
    let lengths = ["centre_x_m", "centre_y_m", "radius_m", "from_rad", "to_rad"];
    let mut arc = vec![("kind", json!({ "const": "arc" }))];
    arc.extend(lengths.map(|key| (key, number("In the unit that its name ends in."))));
    let mut needed = vec!["kind"];
    needed.extend(lengths);
    let point = ["x_m", "y_m"].map(|key| (key, number("In m.")));
    let mut points = list(
        "Its points, in their order.",
        object(None, point.to_vec(), &["x_m", "y_m"]),
    );
    points["minItems"] = json!(2);
    points["maxItems"] = json!(MOST_PIECES + 1);
    let kinds = one_of(
        "Straight pieces, or a curve through the points.",
        ["chain", "spline"],
    );
    let through = vec![("kind", kinds), ("point", points)];
    json!({
        "description": "The path that the rig kept to in recordings that are replayed.",
        "oneOf": [object(None, arc, &needed), object(None, through, &["kind", "point"])],
    })
}

/// Which differences between two controllers are meant.
fn expected() -> Value {
    let letters: String = Joint::ALL.map(Joint::letter).concat();
    let brakes = json!({
        "type": "string",
        "pattern": format!("^[ ,{letters}]*$"),
        "description": "The brakes whose commands may differ, such as \"A E\".",
    });
    let keys = vec![
        ("brakes", brakes),
        (
            "most_a",
            within(
                "By how much a command may differ, A.",
                [0.0, GREATEST_CURRENT_A],
            ),
        ),
        (
            "most_share",
            within(
                "In which share of a recording's samples commands may differ.",
                [0.0, 1.0],
            ),
        ),
        (
            "same_brakes",
            flag("The same brakes have to act, each with another current."),
        ),
    ];
    let mut whole = object(
        Some(
            "Which differences of the commands on recordings are meant: every statement has to hold.",
        ),
        keys,
        &[],
    );
    whole["minProperties"] = json!(1);
    whole
}

/// In how many trials the premise of every law has to be met.
fn coverage() -> Value {
    let about = "In how many trials the premise of every law has to be met.";
    let least = vec![("least_trials", whole(about, 0, 100_000_000))];
    object(None, least, &[])
}

/// A sentence, and the law or the metric that stands for it.
fn requirement() -> Value {
    let keys = vec![
        ("says", text("The sentence.")),
        (
            "law",
            one_of("The law that stands for it.", Law::ALL.map(Law::name)),
        ),
        (
            "metric",
            one_of(
                "The metric that stands for it.",
                Metric::ALL.map(Metric::key),
            ),
        ),
    ];
    let mut own = object(None, keys, &["says"]);
    own["oneOf"] = json!([{ "required": ["law"] }, { "required": ["metric"] }]);
    own
}

/// The JSON Schema of `certify.toml`.
pub fn schema() -> Value {
    let keys = vec![
        ("name", text("What people call the change.")),
        (
            "layout",
            one_of("Which rigs: both where nothing is said.", LAYOUTS),
        ),
        (
            "reference_every",
            whole(
                "Of so many samples one is set beside the reference; 1 takes them all.",
                1,
                MOST_EVERY,
            ),
        ),
        ("controller", defined("law")),
        ("baseline", defined("law")),
        ("declares", declares()),
        ("limits", metrics("What 95 of 100 trials must not exceed.")),
        (
            "regressions",
            metrics("By how much the mean may be worse than the baseline's."),
        ),
        ("path", path()),
        ("expected", expected()),
        ("coverage", coverage()),
        (
            "requirement",
            list(
                "Sentences of the laboratory, in their order.",
                requirement(),
            ),
        ),
    ];
    let mut all = object(
        Some("A changed controller: what is certified, beside what, and within which limits."),
        keys,
        &[],
    );
    all["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    all["title"] = json!("rigproof certify");
    all["not"] = json!({ "required": ["controller", "declares"] });
    all["dependentRequired"] = json!({ "regressions": ["baseline"] });
    all["$defs"] = json!({ "law": law("A law of the rig: `named`, a row of table 6.1, or a `kind` with its parameters.") });
    all
}

/// The same as the text of a file.
pub fn schema_text() -> String {
    format!("{:#}\n", schema())
}
